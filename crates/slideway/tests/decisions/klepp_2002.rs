//! The example of Klepp (2002): which phases follow, and where they change.

use crate::set_up::{PLUS, State, assert_close, joints, phase, sides};
use slideway::motion::ContactPhase;
use slideway::motion::JointPhase::Sliding;
use slideway::motion::decision::{Jam, jam};
use slideway::report::Verdict;

fn example(parameters: &[(&str, &str)]) -> State {
    State::gallery("klepp-2002", parameters)
}

#[test]
fn moving_to_the_left_it_jams_above_the_locking_value() {
    // mu_1* = 0.45265396 (theory, section 9).
    let below = example(&[("F_20", "0"), ("direction", "-1"), ("mu_1", "0.45265395")]);
    assert_eq!(below.successors(&[false, false], None).list.len(), 1);
    let above = example(&[("F_20", "0"), ("direction", "-1"), ("mu_1", "0.45265397")]);
    let found = above.successors(&[false, false], None);
    assert!(found.list.is_empty() && found.tipping.is_empty() && found.unsolved.is_empty());
    let Jam::Stops(impulses) = jam(&above.mechanism, &above.configuration).unwrap() else {
        panic!("it stops")
    };
    for impulse in &impulses {
        // One degree of freedom: everything stops, and the kinetic energy m v^2 / 2 is lost.
        assert_eq!(impulse.at_rest.len(), 2);
        assert!(impulse.sliding_velocities.iter().all(|velocity| *velocity == 0.0));
        assert!(impulse.after.rates.iter().all(|rate| *rate == 0.0));
        assert_close(impulse.energy_lost, 0.5, 0.0, 1e-12);
        balanced(impulse);
    }
}

/// The impulses stop a bar of 1 kg that moves with -1 m/s: forces along and across, moments about the bar's
/// middle and about the middle of the massless lower block.
fn balanced(impulse: &slideway::motion::decision::Impulse) {
    let [one, two, three] = impulse.normal_impulses[..] else { panic!("three contacts") };
    let frictions: Vec<f64> = impulse.friction_impulses.iter().map(|friction| friction.total()).collect();
    let total: f64 = frictions.iter().sum();
    let scale = one.abs().max(two.abs());
    // Positive along -u: to the right is negative.
    assert_close(total, -1.0, scale, 1e-10);
    assert_close(one + two + three, 0.0, scale, 1e-10);
    let (sin, cos) = f64::to_radians(80.0).sin_cos();
    let (x, y) = (cos / 2.0, sin / 2.0);
    // Upper end: (x, y), force (-F_1, N_1); lower end: (-x, -y), force (-F_2 - F_3, N_2 + N_3).
    let upper = x * one + y * frictions[0];
    let lower = -x * (two + three) - y * (frictions[1] + frictions[2]);
    assert_close(upper + lower, 0.0, scale, 1e-10);
    let faces = |k: usize| {
        let friction = impulse.friction_impulses[k];
        (friction.positive_face - friction.negative_face) * 0.05
    };
    // Friction -F at the height -h/2 (positive face) turns by -(-h/2)(-F) = -F h/2.
    assert_close((two - three) * 0.1, faces(1) + faces(2), scale, 1e-10);
}

#[test]
fn after_the_jam_it_rests() {
    let state = example(&[("F_20", "0"), ("direction", "-1"), ("mu_1", "0.6")]);
    let Jam::Stops(impulses) = jam(&state.mechanism, &state.configuration).unwrap() else {
        panic!("it stops")
    };
    let after = State { mechanism: state.mechanism, configuration: impulses[0].after.clone() };
    let found = after.successors(&[true, true], None);
    assert_eq!(joints(&found)[0], "oo");
    assert!(found.list[0].state.margin.unwrap() > 0.0);
}

#[test]
fn it_cannot_start_its_return_stroke_above_the_locking_value() {
    // A force P at the mass centre has no influence on the reactions, so that a great enough one overcomes
    // the friction of the weight: at mu_1 = 0.45 that is about 0.5/(1 - 0.45/mu_1*) times mu_1 m g, 38 m g.
    // At mu_1 > mu_1* none does: self-locking. (It may also hold below, with friction that acts against each
    // other at rest.)
    for (mu, starts) in [("0.45", true), ("0.46", false)] {
        for pull in ["-100*m*g", "-1000*m*g"] {
            let state = example(&[("F_20", "0"), ("direction", "0"), ("mu_1", mu), ("P", pull)]);
            let found = joints(&state.successors(&[true, true], None));
            assert_eq!(found.contains(&"--".to_owned()), starts, "{mu} {pull}");
            assert!(starts || found == ["oo"], "{mu} {pull}");
        }
    }
}

#[test]
fn of_two_phases_the_attainable_one_comes_first() {
    // Theory, section 7: N_1 = 0.2625 m g is attainable, N_1 = -1.8754 m g is not.
    let state = example(&[("F_20", "0"), ("mu_1", "0.6")]);
    let found = state.successors(&[false, false], None);
    let [first, second] = &found.list[..] else { panic!("two") };
    assert_close(first.state.normal_forces[0] / 9.81, 0.2625, 1.0, 5e-5);
    assert_eq!(first.attainability.verdict, Verdict::Attainable);
    assert_close(second.state.normal_forces[0] / 9.81, -1.8754, 1.0, 5e-5);
    assert_eq!(second.attainability.verdict, Verdict::Unattainable);
    // The present phase comes first even so.
    let found = state.successors(&[false, false], Some(&second.phase));
    assert!(found.list[0].is_present);
    assert_eq!(found.list[0].attainability.verdict, Verdict::Unattainable);
}

#[test]
fn a_preload_gap_is_followed() {
    // Theory, section 3: mu_1 = 0.24, F_30 = 0.5 m g, moving to the right.
    let state = example(&[("mu_1", "0.24"), ("F_20", "0"), ("F_30", "0.5*m*g")]);
    let found = state.successors(&[false, false], None);
    let [only] = &found.list[..] else { panic!("exactly one") };
    assert_eq!(only.phase.contacts[2], ContactPhase::PreloadGap);
    let share = only.state.shares[2].unwrap();
    assert!(0.0 < share && share < 1.0);
    assert_eq!(only.state.normal_forces[2], 0.0);
    // It goes on as it is.
    let again = state.successors(&[false, false], Some(&only.phase));
    assert!(again.list.len() == 1 && again.list[0].is_present && again.list[0].continues);
}

#[test]
fn both_lower_contacts_change_at_the_double_boundary() {
    // At mu_1 = cot(alpha) = 0.17632698 N_2 and N_3 vanish together (theory, section 9): below it the block
    // lies on the lower side of its guide, above it on the upper one (reference/klepp-2002.toml, N_3
    // upwards).
    for (mu, expected) in [("0.1763269", "+++"), ("0.1763271", "+--")] {
        let state = example(&[("F_20", "0"), ("direction", "-1"), ("mu_1", mu)]);
        let found = state.successors(&[false, false], None);
        let patterns: Vec<String> = found.list.iter().map(|one| sides(&one.phase)).collect();
        assert_eq!(patterns, [expected], "{mu}");
    }
    let at = format!("{:e}", 1.0 / f64::to_radians(80.0).tan());
    let state = example(&[("F_20", "0"), ("direction", "-1"), ("mu_1", &at)]);
    let before = phase(&[Sliding(-1.0), Sliding(-1.0)], &[PLUS; 3]);
    let found = state.successors(&[false, false], Some(&before));
    // Nothing changes with time: all that differ by these two contacts are the same state, the present one
    // first.
    assert!(found.list[0].is_present);
    for one in &found.list {
        assert_close(one.state.normal_forces[0], 9.81, 0.0, 1e-9);
        assert!(one.state.normal_forces[1].abs() < 1e-9 && one.state.normal_forces[2].abs() < 1e-9);
    }
}
