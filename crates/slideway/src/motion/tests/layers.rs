//! Blocks on one another, and blocks that have nothing to do with one another, against an exact solution in
//! other coordinates.

use super::mechanism_of;
use crate::configuration::Configuration;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::motion::decision::{ASSESSED, continuations, successors};
use crate::motion::{End, EventInstant, JointPhase, SimulateOptions, simulate};
use std::fmt::Write as _;

/// A sequence of numbers between 0 and 1 (D. E. Knuth's MMIX generator).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, greatest: f64) -> f64 {
        least + (greatest - least) * self.next()
    }
}

/// A level block of constant load. It lies on the one before it in a pile, or on the ground.
#[derive(Debug, Clone, Copy)]
struct Layer {
    mass: f64,
    mu: f64,
    mu_static: f64,
    pull: f64,
    /// Velocity against what it lies on.
    rate: f64,
    /// Whether it lies on the one before.
    on_last: bool,
}

/// All joints have their line at one height, so that no moment acts and blocks stay flat.
fn text(layers: &[Layer]) -> String {
    let mut text = "gravity = 10\n[points]\nP = [0, 0]\n".to_owned();
    for (index, layer) in layers.iter().enumerate() {
        let Layer { mass, mu, mu_static, pull, rate, on_last } = layer;
        let guide = if *on_last { format!("b{}", index - 1) } else { "ground".to_owned() };
        write!(
            text,
            "
[bodies.b{index}]
points = [\"P\"]
mass = {mass}
centre_of_mass = \"P\"
moment_of_inertia = 1
[joints.j{index}]
type = \"block_slider\"
block = \"b{index}\"
guide = \"{guide}\"
at = \"P\"
along = \"0 deg\"
length = 200
mu = {mu}
mu_static = {mu_static}
[loads.f{index}]
type = \"force\"
at = \"b{index}.P\"
components = [{pull}, 0]
[coordinates.s{index}]
slide = \"j{index}\"
rate = {rate}
"
        )
        .unwrap();
    }
    text
}

/// What each layer does against what it lies on: 0 sticks, else the sign of sliding.
type State = Vec<f64>;

/// The exact motion: weights press, so that all normal forces are constant, and so are accelerations between
/// events.
struct Exact<'l> {
    layers: &'l [Layer],
    /// Relative displacements and velocities.
    places: Vec<f64>,
    rates: Vec<f64>,
    state: State,
}

impl Exact<'_> {
    fn normal(&self, index: usize) -> f64 {
        let above = self.layers[index + 1..].iter().take_while(|layer| layer.on_last);
        10.0 * (self.layers[index].mass + above.map(|layer| layer.mass).sum::<f64>())
    }

    fn is_below(&self, index: usize) -> bool {
        self.layers.get(index + 1).is_some_and(|next| next.on_last)
    }

    /// Absolute accelerations in a state, and the friction on each layer by what it lies on: from the top
    /// downwards what sticks together is one body.
    fn solve(&self, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let count = self.layers.len();
        let kinetic = |index: usize| -state[index] * self.layers[index].mu * self.normal(index);
        let mut accelerations = vec![0.0; count];
        let mut index = 0;
        while index < count {
            let mut end = index + 1;
            while end < count && self.layers[end].on_last && state[end] == 0.0 {
                end += 1;
            }
            let is_held = state[index] == 0.0 && !self.layers[index].on_last;
            if !is_held {
                let mass: f64 = self.layers[index..end].iter().map(|layer| layer.mass).sum();
                let pull: f64 = self.layers[index..end].iter().map(|layer| layer.pull).sum();
                let reaction = if self.is_below(end - 1) { kinetic(end) } else { 0.0 };
                let acceleration = (pull + kinetic(index) - reaction) / mass;
                accelerations[index..end].fill(acceleration);
            }
            index = end;
        }
        // Friction on each layer from below: m a - pull + friction on the one above.
        let mut friction = vec![0.0; count];
        for index in (0..count).rev() {
            let reaction = if self.is_below(index) { friction[index + 1] } else { 0.0 };
            let layer = &self.layers[index];
            friction[index] = layer.mass * accelerations[index] - layer.pull + reaction;
        }
        (accelerations, friction)
    }

    fn relative(&self, absolute: &[f64]) -> Vec<f64> {
        let below = |index: usize| if self.layers[index].on_last { absolute[index - 1] } else { 0.0 };
        (0..absolute.len()).map(|index| absolute[index] - below(index)).collect()
    }

    /// By how much a state misses an inequality, or is inside of all.
    fn slack(&self, state: &[f64]) -> f64 {
        let (accelerations, friction) = self.solve(state);
        let relative = self.relative(&accelerations);
        let one = |index: usize| {
            let layer = &self.layers[index];
            if state[index] == 0.0 {
                1.0 - friction[index].abs() / (layer.mu_static * self.normal(index))
            } else if self.rates[index] == 0.0 {
                state[index] * relative[index]
            } else {
                f64::INFINITY
            }
        };
        (0..state.len()).map(one).fold(f64::INFINITY, f64::min)
    }

    /// Among the admissible states the one in which most joints stick, those that stuck before first; false
    /// if rounding decides.
    fn decide(&mut self) -> bool {
        let options = |index: usize| match self.rates[index] {
            0.0 => vec![0.0, 1.0, -1.0],
            rate => vec![rate.signum()],
        };
        let mut states = vec![State::new()];
        for index in 0..self.layers.len() {
            states = states
                .iter()
                .flat_map(|state| options(index).into_iter().map(move |next| [&state[..], &[next]].concat()))
                .collect();
        }
        let slacks: Vec<f64> = states.iter().map(|state| self.slack(state)).collect();
        if slacks.iter().any(|slack| slack.abs() < 1e-4) {
            return false;
        }
        let kept = |state: &State| {
            state.iter().zip(&self.state).filter(|(now, before)| **now == 0.0 && **before == 0.0).count()
        };
        let sticking = |state: &State| state.iter().filter(|joint| **joint == 0.0).count();
        let admissible = states.iter().zip(&slacks).filter(|(_, slack)| **slack > 0.0);
        let mut ranked: Vec<_> =
            admissible.map(|(state, _)| ((kept(state), sticking(state)), state)).collect();
        ranked.sort_by_key(|(rank, _)| *rank);
        match &ranked[..] {
            [.., (second, _), (first, _)] if first == second => false,
            [.., (_, state)] => {
                self.state = (*state).clone();
                true
            }
            [] => panic!("piles of level blocks always move or stay"),
        }
    }

    /// Follows the motion; the times of its events, or nothing where rounding decides.
    fn follow(&mut self, duration: f64) -> Option<Vec<f64>> {
        let (mut time, mut events) = (0.0, Vec::new());
        loop {
            if !self.decide() {
                return None;
            }
            let relative = self.relative(&self.solve(&self.state).0);
            let stop = |index: usize| {
                let time = -self.rates[index] / relative[index];
                if self.rates[index] != 0.0 && time > 0.0 { time } else { f64::INFINITY }
            };
            let stops: Vec<f64> = (0..relative.len()).map(stop).collect();
            let first = stops.iter().fold(f64::INFINITY, |least, stop| least.min(*stop));
            let step = first.min(duration - time);
            for index in 0..relative.len() {
                self.places[index] += step * (self.rates[index] + step * relative[index] / 2.0);
                self.rates[index] =
                    if stops[index] == step { 0.0 } else { self.rates[index] + step * relative[index] };
            }
            time += step;
            if first > step {
                return Some(events);
            }
            if stops.iter().any(|stop| *stop != step && (stop - step).abs() < 1e-4) {
                return None;
            }
            events.push(time);
        }
    }
}

/// Compares a motion with the exact one; whether it could be compared, and its number of events.
fn compare(layers: &[Layer]) -> Option<usize> {
    let rates: Vec<f64> = layers.iter().map(|layer| layer.rate).collect();
    let state = rates.iter().map(|rate| if *rate == 0.0 { 0.0 } else { rate.signum() }).collect();
    let mut exact = Exact { layers, places: vec![0.0; layers.len()], rates, state };
    let expected = exact.follow(3.0)?;
    let mut options = SimulateOptions::new(3.0);
    options.longest_step = Some(0.3);
    let history = simulate(&Model::parse(&text(layers)).unwrap(), &options).unwrap();
    assert_eq!(history.end, End::Finished, "{layers:?}");
    let times: Vec<f64> = history.events[1..].iter().map(|event| event.time).collect();
    assert_eq!(times.len(), expected.len(), "{times:?} {expected:?} {layers:?}");
    for (found, expected) in times.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-8, "{found} {expected} {layers:?}");
    }
    let last = history.reader().configuration(3.0).unwrap().clone();
    for (index, expected) in exact.places.iter().enumerate() {
        assert!((last.coordinates[index] - expected).abs() < 1e-7, "{layers:?}");
        assert!((last.rates[index] - exact.rates[index]).abs() < 1e-7, "{layers:?}");
    }
    Some(expected.len())
}

fn random(numbers: &mut Numbers, count: usize, on_last: f64) -> Vec<Layer> {
    let layer = |index: usize| {
        let mu = numbers.between(0.05, 0.5);
        Layer {
            mass: numbers.between(0.5, 3.0),
            mu,
            mu_static: mu * numbers.between(1.05, 2.0),
            pull: numbers.between(-6.0, 6.0),
            rate: if numbers.next() < 0.4 { 0.0 } else { numbers.between(-3.0, 3.0) },
            on_last: index > 0 && numbers.next() < on_last,
        }
    };
    (0..count).map(layer).collect()
}

/// Piles of two or three, and several blocks of which some lie on others.
#[test]
fn blocks_and_piles_of_blocks_stop_stick_and_slip_as_the_exact_solution_says() {
    let mut numbers = Numbers(1781);
    let (mut compared, mut events) = (0, 0);
    for (count, on_last) in [(2, 1.0), (3, 1.0), (2, 0.0), (4, 0.5)] {
        for _ in 0..60 {
            if let Some(found) = compare(&random(&mut numbers, count, on_last)) {
                compared += 1;
                events += found;
            }
        }
    }
    assert!(compared > 200 && events > 300, "{compared} {events}");
}

/// What happens far away changes nothing: also among forces that are a million times as great.
#[test]
fn independent_blocks_move_as_if_each_were_alone() {
    let mut numbers = Numbers(2002);
    let mut events = 0;
    for _ in 0..20 {
        let mut layers = random(&mut numbers, 5, 0.0);
        (layers[2].mass, layers[2].pull) = (layers[2].mass * 1e6, layers[2].pull * 1e6);
        events += compare(&layers).unwrap_or(0);
    }
    assert!(events > 40, "{events}");
}

/// A pile of ten, each at rest on the one before, under loads that hold: 12^10 states of joints and contacts.
#[test]
fn ten_blocks_on_one_another_at_rest_are_decided() {
    let mut numbers = Numbers(10);
    let mut layers = random(&mut numbers, 10, 1.0);
    for layer in &mut layers {
        (layer.rate, layer.pull, layer.mu, layer.mu_static) = (0.0, 0.1 * layer.pull, 0.3, 0.4);
    }
    let mechanism = Mechanism::new(&Model::parse(&text(&layers)).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let before = ASSESSED.get();
    let found = successors(&mechanism, &configuration, &[true; 10], None).unwrap();
    // Weights press whatever friction does, so that the sides are known: one linear program.
    assert_eq!(ASSESSED.get() - before, 1);
    // Others, in which fewer would stick, were not looked for, and that is told.
    assert!(found.list.len() == 1 && !found.complete);
    assert!(found.list[0].phase.joints.iter().all(|joint| *joint == JointPhase::Sticking));
    assert!(found.unsolved.is_empty());
    let history = simulate(&Model::parse(&text(&layers)).unwrap(), &SimulateOptions::new(1e-3)).unwrap();
    assert!(history.events[0].left_out);
    let told = crate::motion::report(&history, &SimulateOptions::new(1e-3));
    assert!(told.events[0].branches_left_out);
}

/// Ten stages of a telescope at rest, each 0.8 m out of the one before and guided over 0.4 m: weights turn
/// what is outside about each guide, so that its ends are pressed on opposite sides. While blocks are not
/// high that is so whatever friction does, and the decision asks one linear program; between faces 0.4 m
/// apart friction could turn normal forces round at ten contacts, and the search for sides with a margin that
/// is enough asks 344 of 2^10 (no more than that, whoever makes it quicker).
#[test]
fn ten_stages_of_a_telescope_at_rest_are_decided() {
    for (height, most) in [(0.0, 1), (0.1, 1), (0.4, 344)] {
        let mut text = "gravity = 10\n[points]\n".to_owned();
        for index in 0..10 {
            let inner = 0.8 * f64::from(index);
            writeln!(text, "P{index} = [{inner}, 0]\nS{index} = [{}, 0]", inner + 0.4).unwrap();
        }
        for index in 0..10 {
            let guide = if index > 0 { format!("b{}", index - 1) } else { "ground".to_owned() };
            write!(
                text,
                "
[bodies.b{index}]
points = [\"P{index}\", \"S{index}\"]
mass = 1
centre_of_mass = \"S{index}\"
moment_of_inertia = 1
[joints.j{index}]
type = \"block_slider\"
block = \"b{index}\"
guide = \"{guide}\"
at = \"P{index}\"
along = \"5 deg\"
length = 0.4
height = {height}
mu = 0.3
[coordinates.s{index}]
slide = \"j{index}\"
"
            )
            .unwrap();
        }
        let mechanism = mechanism_of(&text);
        let configuration = Configuration::new(&mechanism).unwrap();
        let event = EventInstant::new((&mechanism, &configuration), &[0.0; 10], None);
        let before = ASSESSED.get();
        let found = continuations(&event).unwrap();
        let work = ASSESSED.get() - before;
        assert!((1..=most).contains(&work), "{height} {work}");
        assert_eq!(found.list.len(), 1);
        assert!(found.list[0].phase.joints.iter().all(|joint| *joint == JointPhase::Sticking));
    }
}
