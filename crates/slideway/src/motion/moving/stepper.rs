//! One step of an explicit Runge-Kutta method with an estimate of its error, and the solution within the
//! step.
//!
//! J. R. Dormand and P. J. Prince, A family of embedded Runge-Kutta formulae, Journal of Computational and
//! Applied Mathematics 6, 1980: order 5, seven stages of which the last is the first of the next step, error
//! estimated by a formula of order 4. Within the step: the continuous extension of order 4 of L. F. Shampine,
//! as E. Hairer, S. P. Norsett and G. Wanner print it (Solving Ordinary Differential Equations I, 2nd
//! edition, section II.6).

/// A system of differential equations y' = f(t, y).
pub(in crate::motion) trait Derivative {
    /// Why it has no value.
    type Failure;

    /// Writes f(t, y) into `rate`.
    fn derivative(&mut self, time: f64, state: &[f64], rate: &mut [f64]) -> Result<(), Self::Failure>;
}

const STAGES: usize = 7;
const NODES: [f64; STAGES] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
const COEFFICIENTS: [&[f64]; STAGES] = [
    &[],
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// Difference of the formulae of orders 5 and 4.
const ERROR: [f64; STAGES] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];
/// The last term of the solution within the step.
const WITHIN: [f64; STAGES] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];
/// Fractions of a step at which what is watched is evaluated: its ends and two places inside.
pub(in crate::motion) const SAMPLES: [f64; 4] = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];
/// Vectors that describe the solution within a step.
pub(in crate::motion) const DENSE: usize = 5;

/// The stages of a step and its result.
#[derive(Debug, Clone)]
pub(in crate::motion) struct Stepper {
    stages: [Vec<f64>; STAGES],
    trial: Vec<f64>,
    /// State at the end of the last step that was tried.
    pub(in crate::motion) end: Vec<f64>,
    dense: Vec<f64>,
}

impl Stepper {
    /// Memory for states of this many components.
    pub(in crate::motion) fn new(size: usize) -> Self {
        Self {
            stages: std::array::from_fn(|_| vec![0.0; size]),
            trial: vec![0.0; size],
            end: vec![0.0; size],
            dense: Vec::new(),
        }
    }

    /// The derivative at the start of the next step, to be written after every change of state or equations.
    pub(in crate::motion) fn start(&mut self) -> &mut [f64] {
        &mut self.stages[0]
    }

    /// Tries a step from `state`; returns its estimated error: the root mean square of the components' errors
    /// divided by `scale`, to be compared with 1.
    pub(in crate::motion) fn attempt<S: Derivative>(
        &mut self,
        system: &mut S,
        [time, step]: [f64; 2],
        state: &[f64],
        scale: &[f64],
    ) -> Result<f64, S::Failure> {
        for stage in 1..STAGES {
            let (known, later) = self.stages.split_at_mut(stage);
            let target = if stage + 1 == STAGES { &mut self.end } else { &mut self.trial };
            for (index, value) in target.iter_mut().enumerate() {
                let terms = COEFFICIENTS[stage].iter().zip(known.iter());
                let sum: f64 = terms.map(|(coefficient, rate)| coefficient * rate[index]).sum();
                *value = state[index] + step * sum;
            }
            system.derivative(time + NODES[stage] * step, target, &mut later[0])?;
        }
        let squares = scale.iter().enumerate().map(|(index, scale)| {
            let terms = ERROR.iter().zip(&self.stages);
            let error: f64 = terms.map(|(coefficient, rate)| coefficient * rate[index]).sum();
            (step * error / scale).powi(2)
        });
        Ok((squares.sum::<f64>() / scale.len().max(1) as f64).sqrt())
    }

    /// Appends the solution within the step to `dense`: [`DENSE`] vectors, for [`within`].
    pub(in crate::motion) fn describe(&self, step: f64, state: &[f64], dense: &mut Vec<f64>) {
        let first = dense.len();
        let size = state.len();
        dense.resize(first + DENSE * size, 0.0);
        let dense = &mut dense[first..];
        for index in 0..size {
            let change = self.end[index] - state[index];
            let start = step * self.stages[0][index] - change;
            let terms = WITHIN.iter().zip(&self.stages);
            let last: f64 = terms.map(|(coefficient, rate)| coefficient * rate[index]).sum();
            dense[index] = state[index];
            dense[size + index] = change;
            dense[2 * size + index] = start;
            dense[3 * size + index] = change - step * self.stages[STAGES - 1][index] - start;
            dense[4 * size + index] = step * last;
        }
    }

    /// Moves the end of a step from `state` that was tried by a small part of its length, along the solution
    /// within it; to be [finished](Self::finish).
    pub(in crate::motion) fn prolong(&mut self, step: f64, change: f64, state: &[f64]) {
        let mut dense = std::mem::take(&mut self.dense);
        dense.clear();
        self.describe(step, state, &mut dense);
        within(&dense, 1.0 + change / step, &mut self.end);
        self.dense = dense;
    }

    /// Evaluates the derivative at the end of the step where that was moved.
    pub(in crate::motion) fn finish<S: Derivative>(
        &mut self,
        system: &mut S,
        time: f64,
    ) -> Result<(), S::Failure> {
        system.derivative(time, &self.end, &mut self.stages[STAGES - 1])
    }

    /// Makes the end of the step the start of the next one, whose first stage is known.
    pub(in crate::motion) fn advance(&mut self, state: &mut [f64]) {
        state.copy_from_slice(&self.end);
        self.stages.swap(0, STAGES - 1);
    }
}

/// The state at a fraction of a step, from the vectors that describe the solution within it.
pub(in crate::motion) fn within(dense: &[f64], fraction: f64, state: &mut [f64]) {
    let size = state.len();
    let rest = 1.0 - fraction;
    for (index, value) in state.iter_mut().enumerate() {
        let part = |vector: usize| dense[vector * size + index];
        // y = r1 + f (r2 + (1 - f) (r3 + f (r4 + (1 - f) r5)))
        let inner = part(2) + fraction * (part(3) + rest * part(4));
        *value = part(0) + fraction * (part(1) + rest * inner);
    }
}

/// Chooses the length of the next step from the errors of the last ones.
#[derive(Debug, Clone, Copy)]
pub(in crate::motion) struct StepControl {
    last_error: f64,
    rejected: bool,
}

impl StepControl {
    /// Nothing known yet.
    pub(in crate::motion) fn new() -> Self {
        Self { last_error: 1e-4, rejected: false }
    }

    /// The factor for the step after one that was accepted with this error: proportional-integral control
    /// (Hairer, Norsett, Wanner, section II.4) with beta = 0.04, between 0.2 and 5.
    pub(in crate::motion) fn accepted(&mut self, error: f64) -> f64 {
        const BETA: f64 = 0.04;
        let error = error.max(1e-10);
        let factor = 0.9 * error.powf(-(0.2 - 0.75 * BETA)) * self.last_error.powf(BETA);
        let greatest = if self.rejected { 1.0 } else { 5.0 };
        self.rejected = false;
        self.last_error = error.max(1e-4);
        factor.clamp(0.2, greatest)
    }

    /// The factor after one that was rejected.
    pub(in crate::motion) fn rejected(&mut self, error: f64) -> f64 {
        self.rejected = true;
        if error.is_finite() { (0.9 * error.powf(-0.2)).clamp(0.1, 0.9) } else { 0.1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// y'' = -y, and y3' = 5 t^4 to test the weights of the quadrature alone.
    struct Oscillator;

    impl Derivative for Oscillator {
        type Failure = Infallible;

        fn derivative(&mut self, time: f64, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            rate.copy_from_slice(&[state[1], -state[0], 5.0 * time.powi(4)]);
            Ok(())
        }
    }

    fn run(steps: usize, end: f64) -> ([f64; 3], f64) {
        let mut state = [1.0, 0.0, 0.0];
        let mut stepper = Stepper::new(3);
        let step = end / steps as f64;
        let mut worst: f64 = 0.0;
        for index in 0..steps {
            let time = index as f64 * step;
            let Ok(()) = Oscillator.derivative(time, &state, stepper.start());
            let Ok(_) = stepper.attempt(&mut Oscillator, [time, step], &state, &[1.0; 3]);
            let mut dense = Vec::new();
            stepper.describe(step, &state, &mut dense);
            for fraction in [0.0, 0.2, 0.37, 0.5, 0.81, 1.0] {
                let mut inside = [0.0; 3];
                within(&dense, fraction, &mut inside);
                let t = time + fraction * step;
                worst = worst.max((inside[0] - t.cos()).abs()).max((inside[1] + t.sin()).abs());
            }
            stepper.advance(&mut state);
        }
        (state, worst)
    }

    /// Halved steps: 2^5 at the ends, and at least 2^4 within.
    #[test]
    fn has_order_five_and_order_four_within() {
        let error = |steps: usize| {
            let (state, within) = run(steps, 3.0);
            ((state[0] - 3.0_f64.cos()).hypot(state[1] + 3.0_f64.sin()), within)
        };
        let (coarse, fine) = (error(20), error(40));
        let orders = [(coarse.0 / fine.0).log2(), (coarse.1 / fine.1).log2()];
        assert!((4.8..5.6).contains(&orders[0]) && orders[1] > 3.9, "{orders:?}");
    }

    #[test]
    fn integrates_powers_of_time_exactly() {
        // The integral of 5 t^4 from 0 to 2 is 32.
        let (state, _) = run(1, 2.0);
        assert!((state[2] - 32.0).abs() < 1e-13, "{}", state[2]);
    }

    /// The estimate is that of the difference of orders 5 and 4: it falls with the fifth power of the step.
    #[test]
    fn the_estimate_has_the_order_of_the_error() {
        let estimate = |step: f64| {
            let mut stepper = Stepper::new(3);
            let state = [1.0, 0.0, 0.0];
            let Ok(()) = Oscillator.derivative(0.0, &state, stepper.start());
            let Ok(error) = stepper.attempt(&mut Oscillator, [0.0, step], &state, &[1.0, 1.0, 1e9]);
            error
        };
        let order = (estimate(0.2) / estimate(0.1)).log2();
        assert!((4.8..6.2).contains(&order), "{order}");
    }
}
