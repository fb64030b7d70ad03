//! Pads at the ends of travels, against closed forms.

use super::models::{block, stacked, with_stop};
use crate::fault::FaultKind;
use crate::limits::{LimitsOptions, limits};
use crate::model::{Model, Settings};
use crate::motion::{Cause, End, History, JointPhase, SimulateOptions, simulate};
use crate::report::{Report, Style};
use crate::solve::solve;
use crate::standstill::{HoldOptions, hold};

fn run(text: &str, duration: f64) -> History {
    let options = SimulateOptions { tolerance: 1e-11, ..SimulateOptions::new(duration) };
    simulate(&Model::parse(text).unwrap(), &options).unwrap()
}

fn words(history: &History) -> Vec<String> {
    history.events.iter().map(|event| format!("{} {}", event.time, event.words)).collect()
}

/// When the block meets a pad, and when it leaves it.
fn contacts(history: &History) -> [Vec<f64>; 2] {
    let times = |wanted: &dyn Fn(&Cause) -> bool| {
        let events = history.events.iter().filter(|event| event.causes.iter().any(wanted));
        events.map(|event| event.time).collect()
    };
    [
        times(&|cause| matches!(cause, Cause::MeetsPad { .. })),
        times(&|cause| matches!(cause, Cause::LeavesPad { .. })),
    ]
}

/// A block of 2 kg at 2 m/s meets a pad of 2e4 N/m at 1 m without friction: it is in it for half a period, pi
/// sqrt(m/k), and comes back as fast as it came; to the other pad it is 2 m.
#[test]
fn an_undamped_pad_gives_everything_back() {
    let history = run(&with_stop(&block("0", "rate = 2", ""), "{ stiffness = 2e4 }"), 3.0);
    assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
    let half = std::f64::consts::PI / 100.0;
    let [meets, leaves] = contacts(&history);
    let expected = [0.5, 0.5 + half + 1.0, 0.5 + 2.0 * (half + 1.0)];
    assert_eq!((meets.len(), leaves.len()), (3, 3), "{:#?}", words(&history));
    for ((meets, leaves), expected) in meets.iter().zip(&leaves).zip(expected) {
        assert!(
            (meets - expected).abs() < 1e-8 && (leaves - expected - half).abs() < 1e-8,
            "{meets} {leaves}"
        );
    }
    assert_eq!(history.events[1].words, "block meets the pad at its greatest displacement");
    assert_eq!(history.events[2].words, "block leaves the pad at its greatest displacement");
    assert!(history.events[3].words.starts_with("block meets the pad at its least displacement"));
    // In the middle of the pad all of the energy of 4 J is in its spring.
    let mut reader = history.reader();
    let middle = reader.at(0.5 + half / 2.0).unwrap().energy;
    assert!((middle.potential - 4.0).abs() < 1e-7 && middle.kinetic < 1e-7, "{middle:?}");
    assert!((reader.at(1.0).unwrap().configuration.rates[0] + 2.0).abs() < 1e-8);
    assert!(history.energy_error < 1e-7, "{:e}", history.energy_error);
}

/// With friction f = mu g = 1 m/s^2 and w^2 = k/m the block that meets the pad with v is at d = -f/w^2 +
/// (f/w^2 + D) cos(w t - ..), where the deepest place is D = sqrt((v/w)^2 + (f/w^2)^2) - f/w^2, reached after
/// atan(v w/f)/w. From there d = f/w^2 + (D - f/w^2) cos(w t): it leaves where cos(w t) = -(f/w^2)/(D -
/// f/w^2).
#[test]
fn friction_shifts_the_middle_of_an_undamped_pad() {
    let (w, f) = (10.0_f64, 1.0_f64);
    let history = run(&with_stop(&block("0.1", "value = 0.5\nrate = 2", ""), "{ stiffness = 200 }"), 2.0);
    assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
    // v^2 = 4 - 2 f 0.5 = 3, after (2 - sqrt(3))/f.
    let v = 3.0_f64.sqrt();
    let met = (2.0 - v) / f;
    let shift = f / (w * w);
    let deepest = (v / w).hypot(shift) - shift;
    let back = met + (v * w / f).atan() / w;
    let left = back + (-shift / (deepest - shift)).acos() / w;
    let [meets, leaves] = contacts(&history);
    assert!((meets[0] - met).abs() < 1e-9 && (leaves[0] - left).abs() < 1e-8, "{:#?}", words(&history));
    let stops =
        history.events.iter().find(|event| event.causes.iter().any(|cause| matches!(cause, Cause::Stops(_))));
    assert!((stops.unwrap().time - back).abs() < 1e-8);
    let mut reader = history.reader();
    let found = reader.at(back).unwrap().configuration.coordinates[0];
    assert!((found - 1.0 - deepest).abs() < 1e-9, "{found}");
    assert!(history.energy_error < 1e-8, "{:e}", history.energy_error);
}

/// A critically damped pad, c = 2 m w: d = v t e^(-w t), and k d + c d' = m w v (2 - w t) e^(-w t) lets go at
/// t = 2/w, with the velocity -v e^-2 still 2 v e^-2/w deep. What the spring has then is lost: it takes (1 -
/// e^-4) m v^2/2 in all.
#[test]
fn a_critically_damped_pad_lets_go_before_its_place() {
    let (w, v) = (50.0, 2.0);
    let (stiffness, damping) = (2.0 * w * w, 2.0 * 2.0 * w);
    let stop = format!("{{ stiffness = {stiffness}, damping = {damping} }}");
    let history = run(&with_stop(&block("0", "rate = 2", ""), &stop), 1.5);
    assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
    let [meets, leaves] = contacts(&history);
    let left = 0.5 + 2.0 / w;
    assert!((meets[0] - 0.5).abs() < 1e-9 && (leaves[0] - left).abs() < 1e-8, "{meets:?} {leaves:?}");
    let mut reader = history.reader();
    let deep = reader.at(left).unwrap();
    let back = v * (-2.0_f64).exp();
    let place = deep.configuration.coordinates[0];
    assert!((place - 1.0 - 2.0 * back / w).abs() < 1e-9, "{place}");
    let last = reader.at(1.5).unwrap();
    assert!((last.configuration.rates[0] + back).abs() < 1e-8, "{:?}", last.configuration.rates);
    let taken = -last.energy.loads.iter().sum::<f64>();
    assert!((taken - (1.0 - (-4.0_f64).exp()) * v * v).abs() < 1e-7, "{taken}");
    assert!(last.energy.potential.abs() < 1e-12, "{}", last.energy.potential);
    assert!(history.energy_error < 1e-7, "{:e}", history.energy_error);
}

/// Pushed with 50 N into a pad of 5000 N/m the block comes to rest where |50 N - k d| is within the static
/// friction of 2 N; it stays there.
#[test]
fn a_block_rests_inside_a_preloaded_pad() {
    let push = "[loads.push]\ntype = \"force\"\nat = \"block.C\"\ncomponents = [50, 0]\n";
    let text = with_stop(&block("0.1", "value = 0.9", push), "{ stiffness = 5000, damping = 100 }");
    let history = run(&text, 3.0);
    assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
    assert_eq!(history.phases.last().unwrap().phase.joints, [JointPhase::Sticking], "{:#?}", words(&history));
    let last = history.reader().at(3.0).unwrap();
    let depth = last.configuration.coordinates[0] - 1.0;
    assert!((50.0 - 5000.0 * depth).abs() <= 2.0 && last.configuration.rates == [0.0], "{depth}");
    assert!((last.energy.potential - 2500.0 * depth * depth).abs() < 1e-9);
    assert!(history.energy_error < 1e-7, "{:e}", history.energy_error);
    // Nothing but the pad stores energy here; what its damper takes has a line of its own.
    let report = crate::motion::report(&history, &SimulateOptions::new(3.0));
    let [_, stored] = &report.energy.pads[..] else { panic!("{:?}", report.energy.pads) };
    assert_eq!((&*stored.name, stored.value), ("guide.greatest_pad", report.energy.potential[1]));
    let shown = report.text(Style::PLAIN);
    for told in ["of which stored in guide.greatest_pad", "dissipated by the damper of guide.greatest_pad"] {
        assert!(shown.contains(told), "{shown}");
    }
    assert!(!shown.contains("work of guide."), "{shown}");
    // `hold` knows the pad: between 9.6 and 10.4 mm friction holds, beyond it moves.
    for (depth, holds) in [(0.0097, true), (0.0103, true), (0.0095, false), (0.0105, false)] {
        let model = Model::parse(&text).unwrap();
        let settings = Settings::default().position("x", format!("{} m", 1.0 + depth));
        let report = hold(&model.with(&settings).unwrap(), &HoldOptions::default()).unwrap();
        assert_eq!(report.holds, holds, "{depth}");
    }
}

/// `solve` inside the pad: m x'' = -(k d + c d') - mu m g, where that is positive; at d = 10 mm and d' = -2
/// m/s a pad of 100 N s/m has let go.
#[test]
fn solve_knows_the_pad() {
    for (depth, rate, force) in
        [(0.01, 0.5, 100.0), (0.01, -0.25, 25.0), (0.01, -2.0, 0.0), (-0.01, 0.5, 0.0)]
    {
        let start = format!("value = {}\nrate = {rate}", 1.0 + depth);
        let text = with_stop(&block("0.1", &start, ""), "{ stiffness = 5000, damping = 100 }");
        let report = solve(&Model::parse(&text).unwrap()).unwrap();
        let expected = -(force / 2.0) - f64::signum(rate);
        let found = report.solutions[0].coordinates[0].acceleration;
        assert!(
            report.solutions.len() == 1 && (found - expected).abs() < 1e-12,
            "{depth} {rate} {found} {expected}"
        );
        // The other pad is far away, the least displacement is permitted.
        let other = text.replace(&format!("value = {}", 1.0 + depth), &format!("value = {}", -1.0 - depth));
        let report = solve(
            &Model::parse(&other.replace(&format!("rate = {rate}"), &format!("rate = {}", -rate))).unwrap(),
        )
        .unwrap();
        assert!((report.solutions[0].coordinates[0].acceleration + expected).abs() < 1e-12);
    }
}

/// A block of 2 kg on a slab of 3 kg, both without friction, a pad between them: it pushes both. In the frame
/// of the common mass centre the reduced mass 1.2 kg meets it at 1 m/s; without damping the relative velocity
/// is reversed after pi sqrt(1.2 kg/k).
#[test]
fn a_pad_between_moving_bodies_keeps_the_momentum() {
    let between = "mu = 0\ntravel = [\"-2 m\", \"0.5 m\"]\nstop = { greatest = { stiffness = 1.2e4 } }";
    let history = run(&stacked(["mu = 0", between], ["0 m/s", "1 m/s"], ""), 1.0);
    assert_eq!(history.end, End::Finished);
    let [meets, leaves] = contacts(&history);
    let half = std::f64::consts::PI / 100.0;
    assert!((meets[0] - 0.5).abs() < 1e-9 && (leaves[0] - 0.5 - half).abs() < 1e-8, "{:#?}", words(&history));
    // 2 kg come at 1 m/s: the slab takes 2*2/5 = 0.8 m/s, the block keeps 0.8 - 1.
    let rates = history.reader().at(1.0).unwrap().configuration.rates;
    assert!((rates[0] - 0.8).abs() < 1e-8 && (rates[1] + 1.0).abs() < 1e-8, "{rates:?}");
    assert!(history.energy_error < 1e-8, "{:e}", history.energy_error);
}

#[test]
fn pads_without_sense_are_refused() {
    let kind = |stop: &str| {
        let faults = Model::parse(&with_stop(&block("0", "", ""), stop)).unwrap_err();
        faults.sorted()[0].kind.clone()
    };
    assert!(matches!(kind("{ stiffness = -1 }"), FaultKind::OutOfRange { .. }));
    assert!(matches!(kind("{ stiffness = 0 }"), FaultKind::OutOfRange { .. }));
    assert!(matches!(kind("{ stiffness = 1, damping = -1 }"), FaultKind::OutOfRange { .. }));
    assert!(matches!(kind("{ stiffness = \"1 N\" }"), FaultKind::WrongDimension { .. }));
    assert!(matches!(kind("{ damping = 1 }"), FaultKind::MissingKey { key, .. } if key == "stiffness"));
    assert!(
        matches!(kind("{ least = { damping = 1 } }"), FaultKind::MissingKey { key, .. } if key == "stiffness")
    );
    assert!(matches!(kind("{ least = {} }"), FaultKind::NoneOf { .. }));
    let both = "{ restitution = 0.5, stiffness = 1 }";
    assert!(matches!(kind(both), FaultKind::Both { first: "restitution", second: "stiffness", .. }));
    let both = "{ greatest = { restitution = 0.5, damping = 1 } }";
    assert!(matches!(kind(both), FaultKind::Both { first: "restitution", second: "damping", .. }));
    let text = with_stop(&block("0", "", ""), "{ stiffness = 1 }").replace("travel = [", "preload = 0 # [");
    let faults = Model::parse(&text).unwrap_err();
    assert!(matches!(&faults.sorted()[0].kind, FaultKind::MissingKey { key, .. } if key == "travel"));
}

/// A pad is a load that only pushes: k d + c d' beyond x = 1 m while that is positive. With a = c/(2 m) and
/// w^2 = k/m - a^2 the block of 2 kg that comes at v = 2 m/s is at d = (v/w) e^(-a t) sin(w t), and the pad
/// lets go where k d + c d' = 0: at w t = atan2(c w, c a - k), still with d > 0.
#[test]
fn a_pad_is_the_load_that_only_pushes() {
    let (mass, stiffness, damping, speed) = (2.0, 2e4, 80.0, 2.0);
    let pad = "[loads.pad]\ntype = \"force\"\nat = \"block.C\"\ncomponents = [\
        \"-step(x - 1 m)*max(0 N, (2e4 N/m)*(x - 1 m) + (80 N s/m)*rate(x))\", 0]\n";
    let as_a_load = run(&block("0", "rate = 2", pad), 0.75);
    let as_a_stop = run(&with_stop(&block("0", "rate = 2", ""), "{ stiffness = 2e4, damping = 80 }"), 0.75);
    let decay = damping / (2.0 * mass);
    let frequency = f64::sqrt(stiffness / mass - decay * decay);
    let angle = f64::atan2(damping * frequency, damping * decay - stiffness);
    let (lasts, (sin, cos)) = (angle / frequency, angle.sin_cos());
    let back = speed * (-decay * lasts).exp() * (cos - decay / frequency * sin);
    assert!(back < 0.0 && back > -speed);
    let place = 1.0 + speed / frequency * (-decay * lasts).exp() * sin;
    let expected = place + back * (0.75 - 0.5 - lasts);
    for history in [as_a_load, as_a_stop] {
        assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
        let found = history.reader().at(0.75).unwrap().configuration;
        assert!((found.rates[0] - back).abs() < 1e-7, "{} {back} {:#?}", found.rates[0], words(&history));
        assert!((found.coordinates[0] - expected).abs() < 1e-8, "{} {expected}", found.coordinates[0]);
    }
}

/// The gallery's drawer comes into its pad with v^2 = v_0^2 + 2 (F/m - mu g) x_0. With F' = F - mu m g, a =
/// c/(2 m), w^2 = k/m - a^2 and e = d - F'/k: e = e^(-a t) (-F'/k cos w t + (v - a F'/k)/w sin w t), which
/// stops first where tan w t = w v/(a v - F'/m), in the second quadrant, and stays there. Without damping it
/// comes back.
#[test]
fn the_gallery_drawer_closes_softly() {
    let model = Model::parse(crate::gallery::find("soft-closing-drawer").unwrap().text).unwrap();
    let options = SimulateOptions { tolerance: 1e-11, ..SimulateOptions::new(1.0) };
    let history = simulate(&model, &options).unwrap();
    assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
    let (mass, force, friction, stiffness, damping) = (5.0, 20.0, 0.05 * 9.81, 200.0, 60.0);
    let acceleration = force / mass - friction;
    let speed = (0.09_f64 + 2.0 * acceleration * 0.2).sqrt();
    let met = (speed - 0.3) / acceleration;
    let (decay, rest) = (damping / (2.0 * mass), mass * acceleration / stiffness);
    let frequency = f64::sqrt(stiffness / mass - decay * decay);
    let angle = f64::atan2(frequency * speed, decay * speed - acceleration);
    let stops = met + angle / frequency;
    let wave = -rest * angle.cos() + (speed - decay * rest) / frequency * angle.sin();
    let deepest = rest + (-decay * angle / frequency).exp() * wave;
    assert!((contacts(&history)[0][0] - met).abs() < 1e-9, "{met} {:#?}", words(&history));
    let stop = |cause: &Cause| matches!(cause, Cause::Stops(_));
    let found = history.events.iter().rfind(|event| event.causes.iter().any(stop));
    let (time, place) = (found.unwrap().time, history.reader().at(1.0).unwrap().configuration.coordinates[0]);
    assert!(
        (time - stops).abs() < 1e-7 && (place + deepest).abs() < 1e-9,
        "{time} {stops} {place} {deepest}"
    );
    assert_eq!(history.phases.last().unwrap().phase.joints, [JointPhase::Sticking]);
    let bounces = model.with(&Settings::default().parameter("c", "0 N s/m")).unwrap();
    let [_, leaves] = contacts(&simulate(&bounces, &options).unwrap());
    assert!(!leaves.is_empty());
}

/// A block of 2.4 kg is pushed out of its damped pad and meets it again before it is out of its depth: where
/// k d + c d' passes zero with d > 0 and d' < 0, d'' > 0. A second block, which rests far away, changes
/// nothing: what has just left its piece has left it, although velocities alone would take it back.
#[test]
fn a_pad_that_is_met_within_its_depth_is_met_once() {
    let text = r#"
gravity = "9.81 m/s^2"
[bodies.a]
mass = 1
centre_of_mass = [0, 0]
moment_of_inertia = 1
[bodies.b]
points = ["B"]
mass = 2.4
centre_of_mass = "B"
moment_of_inertia = 1
[points]
B = [1, 0]
[joints.ga]
type = "block_slider"
block = "a"
at = [0, 0]
along = 0
length = 0.2
mu = 0.6
[joints.gb]
type = "block_slider"
block = "b"
at = "B"
along = 0
length = 0.2
mu = 0.1
travel = [0, 1]
stop = { stiffness = 2000, damping = 30 }
[loads.push]
type = "force"
at = "b.B"
components = ["-2.9 N", 0]
[coordinates.xa]
slide = "ga"
[coordinates.xb]
slide = "gb"
value = "-0.13 mm"
rate = "14.8 mm/s"
"#;
    for duration in [0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 3.0] {
        let history = simulate(&Model::parse(text).unwrap(), &SimulateOptions::new(duration)).unwrap();
        assert_eq!(history.end, End::Finished, "{duration}: {:#?}", words(&history));
        let [meets, _] = contacts(&history);
        // Outside of the pad the force is -2.9 N - 0.1 m g, so that d = 0.13 mm - 14.8 mm/s t + a t^2/2, and
        // k d + c d' = 0.
        let acceleration = (2.9 + 0.1 * 2.4 * 9.81) / 2.4;
        let depth = |t: f64| 0.13e-3 - 14.8e-3 * t + acceleration * t * t / 2.0;
        let rate = |t: f64| -14.8e-3 + acceleration * t;
        assert!(meets.len() <= 1 || meets[1] - meets[0] > 1e-6, "{duration}: {meets:?}");
        let at = meets[0];
        assert!((2000.0 * depth(at) + 30.0 * rate(at)).abs() < 1e-6, "{duration}: {at}");
    }
}

/// Without friction a joint has no mode: nothing is told where the block turns round inside the pad.
#[test]
fn a_reversal_without_friction_is_not_told() {
    let history = run(&with_stop(&block("0", "rate = 2", ""), "{ stiffness = 2e4 }"), 3.0);
    let told = words(&history).join("\n");
    assert!(told.contains("block leaves the pad at its greatest displacement"), "{told}");
    assert!(!told.contains("revers"), "{told}");
}

/// A block of 2 kg whose mass centre is c = L = 0.2 m above its guide slides into a pad of k = 5000 N/m and
/// damping b at 1 m/s. The balance of moments about the middle of the guide is
/// `(N_front - N_rear) L/2 = m a c` with the deceleration `m a = k d + b d' + mu m g` while both are pressed
/// down, so that the rear end changes side where `m a = m g L/(2 c)`, that is
/// `k d + b d' = m g (1/2 - mu) = 8 N`.
#[test]
fn limits_know_where_a_pad_tips_a_block() {
    let text = |damping: f64| {
        let stop = format!("{{ greatest = {{ stiffness = \"k\", damping = {damping:?} }} }}");
        with_stop(&block("0.1", "rate = 1", ""), &stop)
            .replace("W = [-3, 0]", "W = [0, 0.2]\n[parameters]\nk = \"5000 N/m\"")
            .replace("centre_of_mass = \"C\"", "centre_of_mass = \"W\"")
            .replace("points = [\"C\"]", "points = [\"C\", \"W\"]")
    };
    let changes = |model: &Model, vary: &str| {
        let options = LimitsOptions::new(vary.parse().unwrap()).effort(0);
        let report = limits(model, &options).unwrap();
        let counts: Vec<usize> = report.counts.iter().map(|count| count.solutions).collect();
        assert_eq!(counts, [1], "{vary}");
        let modes: Vec<&str> = report.modes.iter().map(|mode| mode.pattern.as_str()).collect();
        assert_eq!(modes, ["++", "+-"], "{vary}");
        report.modes[0].to.unwrap()
    };
    // 1.6 mm deep; with damping b d' = 2 N it is 1.2 mm, with 20 N where the force jumps.
    for (damping, place) in [(0.0, 1.0016), (2.0, 1.0012), (20.0, 1.0)] {
        let model = Model::parse(&text(damping)).unwrap();
        let found = changes(&model, "x=0.9..1.01");
        assert!((found - place).abs() < 1e-12, "{damping} {found}");
    }
    // At 2 mm of depth it is a stiffness of 4 kN/m, or of 3 kN/m with 2 N of damping.
    for (damping, stiffness) in [(0.0, 4000.0), (2.0, 3000.0)] {
        let model = Model::parse(&text(damping)).unwrap();
        let there = model.with(&Settings::default().position("x", "1.002 m")).unwrap();
        let found = changes(&there, "k=100 N/m..10000 N/m");
        assert!((found - stiffness).abs() < 1e-6, "{damping} {found}");
    }
}

/// At rest in the pad friction mu m g = 2 N holds it against k d: at 0.5 mm against 0.8 times 2.5 N, at 0.2
/// mm against twice 1 N.
#[test]
fn hold_knows_by_which_factor_a_pad_is_held() {
    let text = with_stop(&block("0.1", "", ""), "{ greatest = { stiffness = 5000, damping = 10 } }");
    for (depth, factor) in [(5e-4, 0.8), (2e-4, 2.0)] {
        let settings = Settings::default().position("x", format!("{} m", 1.0 + depth));
        let model = Model::parse(&text).unwrap().with(&settings).unwrap();
        let options = HoldOptions { load: Some("guide.greatest_pad".to_owned()), ..HoldOptions::default() };
        let report = hold(&model, &options).unwrap();
        assert_eq!(report.holds, factor > 1.0);
        let held = &report.load.unwrap().held;
        assert_eq!(held.len(), 1, "{held:?}");
        let [from, to] = [held[0].least, held[0].greatest].map(Option::unwrap);
        assert!((from + factor).abs() < 1e-9 && (to - factor).abs() < 1e-9, "{from} {to}");
    }
}
