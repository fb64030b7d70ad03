//! End stops: impacts, bouncing that comes to rest, rest at a stop and its end, against closed forms.

use super::models::{block, stacked, with_stop};
use crate::configuration::Configuration;
use crate::fault::FaultKind;
use crate::mechanism::Mechanism;
use crate::model::{Model, Settings};
use crate::motion::decision::{Blow, impact};
use crate::motion::{Cause, End, History, JointPhase, SimulateOptions, simulate};

const G: f64 = 10.0;

fn run(text: &str, duration: f64) -> History {
    simulate(&Model::parse(text).unwrap(), &SimulateOptions::new(duration)).unwrap()
}

fn hits(history: &History) -> Vec<(f64, f64)> {
    let lost = |cause: &Cause| match cause {
        Cause::Hits { energy_lost, .. } => *energy_lost,
        _ => None,
    };
    let events = history.events.iter();
    events.flat_map(|event| event.causes.iter().filter_map(lost).map(|lost| (event.time, lost))).collect()
}

fn words(history: &History) -> Vec<String> {
    history.events.iter().map(|event| format!("{} {}", event.time, event.words)).collect()
}

/// Down an incline of 30 deg with mu = 0.2, g = 10 m/s^2, from rest 0.5 m above the stop: a_d = g (sin - mu
/// cos) downwards, a_u = g (sin + mu cos) upwards. It hits with v_0 = sqrt(2 a_d 0.5); each bounce goes up
/// with e v and comes back with q v, q = e sqrt(a_d/a_u), after e v/a_u + q v/a_d. So it rests after sqrt(2
/// 0.5/a_d) + v_0 (e/a_u + q/a_d)/(1 - q).
#[test]
fn a_mass_that_bounces_on_a_rough_incline_comes_to_rest_at_the_stop() {
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let (down, up) = (G * (sin - 0.2 * cos), G * (sin + 0.2 * cos));
    for e in [0.3_f64, 0.6, 0.9] {
        let text = with_stop(&block("0.2", "value = -0.5", ""), &format!("{{ restitution = {e} }}"))
            .replace("along = \"0 deg\"", "along = \"30 deg\"");
        let history = run(&text, 20.0);
        assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
        let fall = (2.0 * 0.5 / down).sqrt();
        let first = down * fall;
        let q = e * (down / up).sqrt();
        let hits = hits(&history);
        let (mut time, mut velocity) = (fall, first);
        for (index, (found, lost)) in hits.iter().take(8).enumerate() {
            assert!((found - time).abs() < 1e-7, "{e} {index} {found} {time}");
            let energy = velocity.powi(2) * (1.0 - e * e);
            assert!((lost - energy).abs() < 1e-7 * energy.max(1e-3), "{e} {index} {lost} {energy}");
            time += e * velocity / up + q * velocity / down;
            velocity *= q;
        }
        let rests = fall + first * (e / up + q / down) / (1.0 - q);
        let last = hits.last().unwrap().0;
        // The flights that are left are within 1e-11 of the size of 3.2 m: shorter than 4e-6 s each, in
        // proportion to 1, q, q^2 ...
        assert!((last - rests).abs() < 8e-6 / (1.0 - q) && last < rests + 1e-7, "{e} {last} {rests}");
        assert_eq!(history.phases.last().unwrap().phase.joints, [JointPhase::Sticking]);
        let end = history.reader().at(20.0).unwrap();
        assert!((end.configuration.coordinates[0] + 1.0).abs() < 1e-10);
        assert_eq!(end.configuration.rates[0], 0.0);
        // The potential energy of 0.5 m is lost in the impacts and by friction.
        let total = 2.0 * G * 0.5 * sin;
        let taken = end.energy.impulses + end.energy.friction.iter().sum::<f64>();
        assert!((taken - total).abs() < 1e-8, "{e} {taken} {total}");
        assert!(history.energy_error < 1e-8, "{:e}", history.energy_error);
    }
}

/// Without friction and with e = 1 nothing is lost: it goes to and fro between both ends, 2 m apart, at 4
/// m/s.
#[test]
fn perfect_restitution_keeps_the_energy() {
    let history = run(&with_stop(&block("0", "rate = 4", ""), "{ restitution = 1 }"), 5.0);
    assert_eq!(history.end, End::Finished);
    let hits = hits(&history);
    assert_eq!(hits.len(), 10);
    for (index, (time, lost)) in hits.iter().enumerate() {
        assert!((time - 0.25 - 0.5 * index as f64).abs() < 1e-9 && lost.abs() < 1e-12);
    }
    assert!(history.events[1].words.starts_with(
        "block hits the stop at its greatest displacement with 4 m/s and bounces back with 4 m/s ("
    ));
}

/// Two ends: one that gives back the half, and one at which the motion ends. From 0 at 2 m/s it hits after
/// 0.5 s, comes back at 1 m/s and reaches the other end after another 2 s.
#[test]
fn one_end_may_have_a_stop_and_the_other_end_the_motion() {
    let text = with_stop(&block("0", "rate = 2", ""), "{ greatest = { restitution = 0.5 } }");
    let history = run(&text, 9.0);
    assert!(matches!(history.end, End::TravelLimit(_)));
    assert!((history.phases.last().unwrap().to - 2.5).abs() < 1e-9);
    let text =
        with_stop(&block("0", "rate = 2", ""), "{ restitution = 0, greatest = { restitution = 0.5 } }");
    let history = run(&text, 9.0);
    assert_eq!(history.end, End::Finished);
    let hits = hits(&history);
    assert_eq!(hits.len(), 2);
    assert!((hits[0].1 - (4.0 - 1.0)).abs() < 1e-9 && (hits[1].1 - 1.0).abs() < 1e-9, "{hits:?}");
    assert_eq!(history.reader().at(9.0).unwrap().configuration.rates[0], 0.0);
}

/// A drawer is pushed against its stop with 5 N, which its static friction of 0.1 * 20 N = 2 N would not
/// hold, and rests there; the force turns round as 5 N cos(2 t): it leaves when the pull reaches 2 N, cos(2
/// t) = -0.4.
#[test]
fn a_drawer_rests_at_its_stop_until_it_is_pulled_away() {
    let push = "[loads.push]\ntype = \"force\"\nat = \"block.C\"\ncomponents = [\"5*cos(2*t/(1 s))\", 0]\n";
    let text = with_stop(&block("0.1", "value = 1", push), "{ restitution = 0.3 }");
    let history = run(&text, 2.0);
    assert_eq!(history.phases[0].phase.joints, [JointPhase::Sticking], "{:#?}", words(&history));
    assert!(hits(&history).is_empty());
    let leaves = (-0.4_f64).acos() / 2.0;
    assert!((history.events[1].time - leaves).abs() < 1e-7, "{:#?}", words(&history));
    assert!(history.events[1].causes.contains(&Cause::Slips));
    let after = history.reader().at(leaves + 0.3).unwrap().configuration;
    assert!(after.rates[0] < 0.0 && after.coordinates[0] < 1.0);
    // Without friction it leaves when the force vanishes.
    let text = with_stop(&block("0", "value = 1", push), "{ restitution = 0.3 }");
    let history = run(&text, 1.0);
    assert!((history.events[1].time - std::f64::consts::FRAC_PI_4).abs() < 1e-7, "{:#?}", words(&history));
}

/// A stop on the line of the guide, the mass centre c = 0.1 m above it, L = 0.2 m, m = 2 kg. The moment about
/// the mass centre is balanced by normal impulses m |dv| c/L at both ends, whose frictions 2 mu c/L m |dv| =
/// k m |dv| help to stop the block and hinder it afterwards: the stop's impulse is m v (1 - k) + e m v (1 +
/// k).
#[test]
fn friction_of_an_impact_turns_round_with_the_block() {
    let text = with_stop(&block("0.4", "value = 1\nrate = 3", ""), "{ restitution = 0.5 }")
        .replace("C = [0, 0]", "C = [0, 0.1]\nA = [0, 0]")
        .replace("at = \"C\"", "at = \"A\"");
    let mechanism = Mechanism::new(&Model::parse(&text).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let joint = mechanism.contacts[0].joint;
    let found = impact(&mechanism, &configuration, &[(joint, 0.5)]).unwrap();
    let k = 2.0 * 0.4 * 0.1 / 0.2;
    let expected = 2.0 * 3.0 * ((1.0 - k) + 0.5 * (1.0 + k));
    let [Blow { stops, energy_lost }] = &found.blows[..] else { panic!("one group") };
    assert!((stops[0].1 - expected).abs() < 1e-10, "{stops:?} {expected}");
    assert!((found.after.rates[0] + 1.5).abs() < 1e-12);
    assert!((energy_lost - 9.0 * 0.75).abs() < 1e-10);
    // With k > 1 friction wedges the block before the stop pushes: it stops dead.
    let text = text.replace("mu = 0.4", "mu = 1.1");
    let mechanism = Mechanism::new(&Model::parse(&text).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let found = impact(&mechanism, &configuration, &[(joint, 0.5)]).unwrap();
    assert!(found.after.rates[0].abs() < 1e-12, "{:?}", found.after.rates);
    assert!((found.blows[0].energy_lost - 9.0).abs() < 1e-10);
}

/// A block of 2 kg on a slab of 3 kg, both without friction, the stop between them: with restitution e = 0.5
/// the relative velocity of 1 m/s turns into -0.5 m/s, and the momentum stays: 2 v + 3 w = 2, v - w = -0.5
/// give w = 0.6 and v = 0.1 m/s.
#[test]
fn an_impact_between_moving_bodies_keeps_the_momentum() {
    let between = "mu = 0\ntravel = [\"-2 m\", \"0.5 m\"]\nstop = { restitution = \"e\" }";
    let text = stacked(["mu = 0", between], ["0 m/s", "1 m/s"], "[parameters]\ne = 0.5\n");
    let model = Model::parse(&text).unwrap();
    let history = simulate(&model, &SimulateOptions::new(1.0)).unwrap();
    assert_eq!(history.end, End::Finished);
    assert!((hits(&history)[0].0 - 0.5).abs() < 1e-9);
    let rates = history.reader().at(1.0).unwrap().configuration.rates;
    assert!((rates[0] - 0.6).abs() < 1e-10 && (rates[1] + 0.5).abs() < 1e-10, "{rates:?}");
    // Without restitution both go on together.
    let history =
        simulate(&model.with(&Settings::default().parameter("e", "0")).unwrap(), &SimulateOptions::new(1.0));
    let rates = history.unwrap().reader().at(1.0).unwrap().configuration.rates;
    assert!((rates[0] - 0.4).abs() < 1e-10 && rates[1].abs() < 1e-10, "{rates:?}");
}

#[test]
fn stops_without_sense_are_refused() {
    let kind = |stop: &str| {
        let faults =
            Model::parse(&with_stop(&block("0", "", ""), stop)).and_then(|model| Mechanism::new(&model));
        faults.unwrap_err().sorted()[0].kind.clone()
    };
    assert!(matches!(kind("{ restitution = 1.5 }"), FaultKind::OutOfRange { .. }));
    assert!(matches!(kind("{ restitution = -0.5 }"), FaultKind::OutOfRange { .. }));
    assert!(matches!(kind("{ restitution = \"0.5 m\" }"), FaultKind::WrongDimension { .. }));
    assert!(matches!(kind("{}"), FaultKind::NoneOf { .. }));
    let without_travel =
        with_stop(&block("0", "", ""), "{ restitution = 0.5 }").replace("travel = [", "preload = 0 # [");
    let faults = Model::parse(&without_travel).unwrap_err();
    assert!(matches!(&faults.sorted()[0].kind, FaultKind::MissingKey { key, .. } if key == "travel"));
}

/// A slab of 3 kg with a block of 2 kg that sticks on it runs into its stop at 2 m/s, after 0.5 m. Nothing
/// presses the block on the slab during the impact, so that no friction takes it along: the slab comes back
/// at -1 m/s, the block goes on at 2 m/s, and mu = 0.5 brings them together from there: -1 + 10/3 t and 2 - 5
/// t, g = 10 m/s^2, meet after 3/(25/3) = 0.36 s at 0.2 m/s. A second block beside them, which static
/// friction holds, stays at rest.
#[test]
fn an_impact_takes_along_what_friction_can_and_leaves_what_rests() {
    let below = "mu = 0\ntravel = [\"-3 m\", \"0.5 m\"]\nstop = { restitution = 0.5 }";
    let aside = r#"
[bodies.aside]
points = ["D"]
mass = "1 kg"
centre_of_mass = "D"
moment_of_inertia = "1 kg m^2"
[joints.aside]
type = "block_slider"
block = "aside"
at = "D"
along = "0 deg"
length = "1 m"
mu = 0.1
mu_static = 0.3
[loads.pull]
type = "force"
at = "aside.D"
components = ["2 N", 0]
[coordinates.y]
slide = "aside"
"#;
    let text = stacked([below, "mu = 0.5"], ["2 m/s", "0 m/s"], aside)
        .replace("C = [0, 0]", "C = [0, 0]\nD = [0, -2]");
    let history = run(&text, 0.9);
    assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
    let (time, lost) = hits(&history)[0];
    assert!((time - 0.25).abs() < 1e-9 && (lost - 0.5 * 3.0 * (4.0 - 1.0)).abs() < 1e-9, "{time} {lost}");
    let mut reader = history.reader();
    let after = reader.at(0.25 + 0.1).unwrap().configuration.rates;
    assert!(
        (after[0] + 1.0 - 1.0 / 3.0).abs() < 1e-9 && (after[1] - 3.0 + 2.5 / 3.0).abs() < 1e-9,
        "{after:?}"
    );
    let together = reader.at(0.8).unwrap().configuration;
    assert!(
        (together.rates[0] - 0.2).abs() < 1e-9 && together.rates[1].abs() < 1e-12,
        "{:?}",
        together.rates
    );
    assert_eq!((together.coordinates[2], together.rates[2]), (0.0, 0.0));
    assert!(history.energy_error < 1e-9, "{:e}", history.energy_error);
}
