//! Dynamic jamming with several degrees of freedom, and where it does not arise.

use crate::set_up::{State, assert_close};
use slideway::configuration::Configuration;
use slideway::motion::decision::{Impulse, Jam, jam};

/// The Painleve-Klein apparatus above its threshold, mu = 4 > 2 cot(30 deg), which jams to the right.
fn klein(parameters: &[(&str, &str)]) -> State {
    State::gallery("painleve-klein", parameters)
}

#[test]
fn the_apparatus_of_klein_stops() {
    let state = klein(&[("mu", "4")]);
    assert!(state.successors(&[false, false], None).list.is_empty());
    let Jam::Stops(impulses) = jam(&state.mechanism, &state.configuration).unwrap() else {
        panic!("it stops")
    };
    // Only the upper guide is rough: T sin(phi) = N and mu N - T cos(phi) = m_1 dv for the upper slider, T
    // cos(phi) = m_2 dv for the lower one give N = m_2 v tan(phi) and a friction impulse (m_1 + m_2) v within
    // mu N.
    let [impulse] = &impulses[..] else { panic!("one: {}", impulses.len()) };
    assert_close(impulse.normal_impulses[0].abs(), f64::to_radians(30.0).tan(), 0.0, 1e-10);
    assert_close(impulse.friction_impulses[0].total(), 2.0, 0.0, 1e-10);
    assert_close(impulse.energy_lost, 1.0, 0.0, 1e-10);
}

#[test]
fn below_the_threshold_friction_is_not_great_enough_for_an_impulse() {
    let state = klein(&[("mu", "3.4")]);
    assert_eq!(state.successors(&[false, false], None).list.len(), 1);
    let found = jam(&state.mechanism, &state.configuration).unwrap();
    assert!(matches!(found, Jam::NoImpulse { unsolved: 0 }), "{found:?}");
    let state = klein(&[("mu", "4"), ("direction", "0")]);
    assert!(matches!(jam(&state.mechanism, &state.configuration).unwrap(), Jam::AtRest));
}

/// The apparatus of Klein whose upper slider carries a block of 0.5 kg that slides on it with little
/// friction.
fn carrying(velocity: f64, mu_block: f64) -> State {
    let text = slideway::gallery::find("painleve-klein").unwrap().text;
    let text = text.replace(
        "[joints.A]",
        &format!(
            r#"
[bodies.load]
mass = 0.5
centre_of_mass = [0, 1]
moment_of_inertia = 0.01
[joints.carried]
type = "block_slider"
block = "load"
guide = "upper_slider"
at = [0, 1]
along = "0 deg"
length = 0.2
height = 0.02
mu = {mu_block}
[coordinates.s]
slide = "carried"
rate = {velocity}
[joints.A]"#
        ),
    );
    State::text(&text, &[("mu", "5")])
}

#[test]
fn with_two_degrees_of_freedom_what_is_not_jammed_slides_on() {
    // The carried block has neither weight nor normal impulse: it keeps its own velocity, 1.5 m/s, while the
    // apparatus stops, and slides with that.
    let state = carrying(0.5, 0.1);
    assert!(state.successors(&[false; 3], None).list.is_empty());
    let impulse = the_impulse(&state);
    assert_close(impulse.sliding_velocities[2], 1.5, 0.0, 1e-10);
    assert_eq!(impulse.sliding_velocities[..2], [0.0, 0.0]);
    assert_close(impulse.energy_lost, 1.0, 0.0, 1e-10);
    balanced(&state, &impulse);
}

#[test]
fn the_impulse_ends_at_the_first_velocity_that_reaches_zero() {
    // The carried block has 0.5 m/s; the apparatus is as fast when it has lost half of its velocity.
    let state = carrying(-0.5, 0.1);
    let impulse = the_impulse(&state);
    assert_close(impulse.sliding_velocities[0], 0.5, 0.0, 1e-10);
    assert_eq!(impulse.sliding_velocities[2], 0.0);
    assert_close(impulse.energy_lost, 1.0 - 0.25, 0.0, 1e-10);
    balanced(&state, &impulse);
    // It is still jammed. In the second impulse the apparatus stops and the block slides on.
    let after = State { mechanism: state.mechanism, configuration: impulse.after };
    assert!(after.successors(&[false, false, true], None).list.is_empty());
    let second = the_impulse(&after);
    assert_eq!(second.sliding_velocities[..2], [0.0, 0.0]);
    assert_close(second.sliding_velocities[2], 0.5, 0.0, 1e-10);
    assert_close(second.energy_lost, 0.25, 0.0, 1e-10);
    balanced(&after, &second);
}

/// The only impulse, given up to the sides of what has no impulse.
fn the_impulse(state: &State) -> Impulse {
    let found = jam(&state.mechanism, &state.configuration).unwrap();
    let Jam::Stops(impulses) = found else { panic!("it stops: {found:?}") };
    let first = &impulses[0];
    for other in &impulses {
        let pairs = first.sliding_velocities.iter().zip(&other.sliding_velocities);
        assert!(pairs.into_iter().all(|(one, other)| (one - other).abs() < 1e-10), "{impulses:?}");
    }
    first.clone()
}

/// Momentum of the whole along the guides, and that friction takes energy from every joint.
fn balanced(state: &State, impulse: &Impulse) {
    let momentum = |configuration: &Configuration| -> f64 {
        let bodies = state.mechanism.bodies.iter().zip(&configuration.velocities);
        bodies.map(|(body, velocity)| body.mass * velocity.linear.x).sum()
    };
    // Friction of the joints on ground, -u on the block.
    let ground: f64 = impulse.friction_impulses[..2].iter().map(|friction| friction.total()).sum();
    let lost = momentum(&state.configuration) - momentum(&impulse.after);
    assert_close(ground, lost, 0.0, 1e-10);
    assert!(impulse.energy_lost > 0.0);
}
