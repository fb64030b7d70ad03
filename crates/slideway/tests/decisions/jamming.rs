//! Dynamic jamming with several degrees of freedom, and where it does not arise.

use crate::set_up::{State, assert_close};
use slideway::configuration::Configuration;
use slideway::motion::JointPhase;
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
    // Only the upper guide is rough: T sin(phi) = N and mu N - T cos(phi) = m_1 dv for the upper slider, T cos(phi) = m_2 dv
    // for the lower one give N = m_2 v tan(phi) and a friction impulse (m_1 + m_2) v within mu N.
    let [impulse] = &impulses[..] else { panic!("one: {}", impulses.len()) };
    assert_close(impulse.normal_impulses[0].abs(), f64::to_radians(30.0).tan(), 0.0, 1e-10);
    assert_close(impulse.friction_impulses[0].total(), 2.0, 0.0, 1e-10);
    assert_close(impulse.energy_lost, 1.0, 0.0, 1e-10);
}

#[test]
fn below_the_threshold_friction_is_not_great_enough_for_an_impulse() {
    let state = klein(&[("mu", "3.4")]);
    assert_eq!(state.successors(&[false, false], None).list.len(), 1);
    let Jam::NoImpulse { reversing, unsolved } = jam(&state.mechanism, &state.configuration).unwrap() else {
        panic!("no impulse")
    };
    assert_eq!((reversing, unsolved), (0, 0));
    let state = klein(&[("mu", "4"), ("direction", "0")]);
    assert!(matches!(jam(&state.mechanism, &state.configuration).unwrap(), Jam::AtRest));
}

/// The apparatus of Klein whose upper slider carries a block of 0.5 kg that slides on it with little friction.
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
    // The carried block is not loaded across by the impulse (no weight, no normal impulse): it keeps its own velocity.
    for velocity in [0.5, -0.5] {
        let state = carrying(velocity, 0.1);
        let found = jam(&state.mechanism, &state.configuration).unwrap();
        let Jam::Stops(impulses) = found else {
            panic!(
                "it stops: {found:?} {:?} {:?}",
                state.configuration,
                state.successors(&[false; 3], None).list.len()
            )
        };
        let upper = impulses.iter().find(|impulse| impulse.at_rest.len() == 2).expect("the apparatus stops");
        // Before: 1 m/s of the apparatus and 1 + velocity of the block; afterwards the block slides with that.
        assert_close(upper.sliding_velocities[2], 1.0 + velocity, 0.0, 1e-10);
        assert_close(upper.energy_lost, 1.0, 0.0, 1e-10);
        balanced(&state, upper);
    }
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
    let _ = JointPhase::Sticking;
}
