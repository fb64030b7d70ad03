//! Klepp's example with springs in place of guides, written from scratch: a bar and a light block as rigid
//! bodies in the plane, small time steps. Nothing of the library enters.

/// The state: place of the hinge A, angle of the bar, angle of the block; then their rates.
type State = [f64; 8];

/// The example with its guides, of stiffness `kappa`: N = -kappa (gap + delta gap').
#[derive(Debug, Clone, Copy)]
pub(crate) struct StiffGuides {
    pub(crate) mu: [f64; 3],
    pub(crate) preload: [f64; 3],
    pub(crate) kappa: f64,
    pub(crate) delta: f64,
}

/// How a simulation ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum End {
    /// With these normal forces.
    Steady([f64; 3]),
    /// With a reaction of more than a thousand weights, or standing still.
    Jammed,
}

const MASS: f64 = 1.0;
const GRAVITY: f64 = 9.81;
const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.2;
const HEIGHT: f64 = 0.1;
const ALPHA: f64 = 80.0;
/// The block's moment of inertia; none in the model, but the springs turn the block.
const BLOCK: f64 = 2e-4;
/// Sliding velocity at the start: no load or coefficient of the example depends on it or on the place.
const VELOCITY: f64 = 100.0;
const STEP: f64 = 4e-7;
const STEPS: usize = 200_000;

impl StiffGuides {
    /// The end after a start with these normal forces in the springs, sliding to the right.
    pub(crate) fn end(&self, start: [f64; 3]) -> End {
        let alpha = ALPHA.to_radians();
        let gaps = start.map(|force| -force / self.kappa);
        // Gaps of the block's ends, and of the upper end of the bar, whose height follows from its angle.
        let (y, tilt) = (f64::midpoint(gaps[1], gaps[2]), (gaps[1] - gaps[2]) / WIDTH);
        let angle = ((LENGTH * alpha.sin() + gaps[0] - y) / LENGTH).asin();
        let mut state: State = [0.0, y, angle, tilt, VELOCITY, 0.0, 0.0, 0.0];
        let mut history = [[0.0; 3]; 2];
        for step in 0..STEPS {
            let forces = self.normal_forces(&state);
            if forces.iter().any(|force| force.abs() > 1e3 * MASS * GRAVITY) || state[4] <= 0.0 {
                return End::Jammed;
            }
            if step % (STEPS / 40) == 0 {
                history = [history[1], forces];
                let change = (0..3).map(|k| (history[0][k] - history[1][k]).abs()).fold(0.0, f64::max);
                if step > 0 && change < 1e-2 {
                    return End::Steady(forces);
                }
            }
            state = self.advanced(&state);
        }
        End::Steady(self.normal_forces(&state))
    }

    /// A step of Runge and Kutta.
    fn advanced(&self, state: &State) -> State {
        let moved = |rate: &State, by: f64| -> State { std::array::from_fn(|i| state[i] + by * rate[i]) };
        let one = self.rates(state);
        let two = self.rates(&moved(&one, STEP / 2.0));
        let three = self.rates(&moved(&two, STEP / 2.0));
        let four = self.rates(&moved(&three, STEP));
        std::array::from_fn(|i| state[i] + STEP / 6.0 * (one[i] + 2.0 * (two[i] + three[i]) + four[i]))
    }

    fn normal_forces(&self, state: &State) -> [f64; 3] {
        let [_, y, angle, tilt, _, y_rate, turning, tilting] = *state;
        let upper = y + LENGTH * angle.sin() - LENGTH * ALPHA.to_radians().sin();
        let upper_rate = y_rate + LENGTH * angle.cos() * turning;
        let end = |half: f64| (y + half * tilt.sin(), y_rate + half * tilt.cos() * tilting);
        let [right, left] = [end(WIDTH / 2.0), end(-WIDTH / 2.0)];
        [(upper, upper_rate), right, left].map(|(gap, rate)| -self.kappa * (gap + self.delta * rate))
    }

    fn rates(&self, state: &State) -> State {
        let [_, _, angle, _, x_rate, y_rate, turning, tilting] = *state;
        let normal = self.normal_forces(state);
        let friction: [f64; 3] = std::array::from_fn(|k| -(self.mu[k] * normal[k].abs() + self.preload[k]));
        let (sin, cos) = (angle.sin(), angle.cos());
        let half = LENGTH / 2.0;
        // Forces for x and y of A, moments about A for the bar and for the block.
        let force_x = friction.iter().sum::<f64>() + MASS * half * cos * turning * turning;
        let force_y = normal.iter().sum::<f64>() - MASS * GRAVITY + MASS * half * sin * turning * turning;
        let on_bar = LENGTH * (cos * normal[0] - sin * friction[0]) - MASS * GRAVITY * half * cos;
        let on_block: f64 = [(1, WIDTH / 2.0), (2, -WIDTH / 2.0)]
            .iter()
            .map(|&(k, x)| x * normal[k] + normal[k].signum() * HEIGHT / 2.0 * friction[k])
            .sum();
        // m x'' - m l/2 sin a'' = X, m y'' + m l/2 cos a'' = Y,
        // m l/2 (cos y'' - sin x'') + m l^2/3 a'' = moment
        let coupling = MASS * half;
        let inertia = MASS * LENGTH * LENGTH / 3.0 - coupling * coupling / MASS;
        let turn = (on_bar - coupling / MASS * (cos * force_y - sin * force_x)) / inertia;
        let x = (force_x + coupling * sin * turn) / MASS;
        let y = (force_y - coupling * cos * turn) / MASS;
        [x_rate, y_rate, turning, tilting, x, y, turn, on_block / BLOCK]
    }
}
