//! Jams, joints that stick together, tipping, accumulations, and changes of mode at places that are known
//! otherwise.

use super::models::{self, block};
use super::{both, model_of, run};
use crate::limits::{LimitsOptions, Vary, limits};
use crate::model::{Model, Settings};
use crate::motion::{Cause, End, History, JointPhase, SimulateOptions, simulate};

const SLIDES: JointPhase = JointPhase::Sliding(1.0);
const STICKS: JointPhase = JointPhase::Sticking;

fn joints(history: &History) -> Vec<&[JointPhase]> {
    history.phases.iter().map(|interval| &interval.phase.joints[..]).collect()
}

/// Klepp (2002), section 7: sent to the left with 1 m/s and mu_1 above 0.45265396 the example has no
/// solution. An impulse takes its kinetic energy m v^2/2 = 0.5 J, and without a load nothing moves it
/// afterwards.
#[test]
fn the_example_jams_and_stands_still() {
    let settings = [("F_20", "0"), ("mu_1", "0.46"), ("direction", "-1")];
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let model = model_of("klepp-2002").with(&settings).unwrap();
    let history = simulate(&model, &SimulateOptions::new(2.0)).unwrap();
    assert_eq!(history.end, End::Finished);
    let lost = history.events.iter().flat_map(|event| &event.causes).find_map(|cause| match cause {
        Cause::Jams { energy_lost } => Some(*energy_lost),
        _ => None,
    });
    assert!((lost.unwrap() - 0.5).abs() < 1e-12, "{lost:?}");
    assert_eq!(history.events[0].time, 0.0);
    assert_eq!(joints(&history), [[STICKS, STICKS]]);
    let last = history.reader().at(2.0).unwrap();
    assert_eq!(last.configuration.rates[0], 0.0);
    assert_eq!(last.configuration.coordinates[0], 0.0);
    assert!(history.energy_error < 1e-12, "{:e}", history.energy_error);
}

/// mu = 0.1 below and 0.4 between, and a force on the upper block.
fn stacked(rate: &str, force: &str) -> String {
    let force = format!("[loads.force]\ntype = \"force\"\nat = \"top.C\"\ncomponents = [\"{force}\", 0]\n");
    models::stacked(["mu = 0.1", "mu = 0.4"], [rate, "0 m/s"], &force)
}

/// Both bodies slow down by mu g = 1 m/s^2, which the friction between them (2 N of 8 N) can pass on: they
/// stop after 2 s, 2 m further.
#[test]
fn a_block_rides_on_a_slab_until_both_stop() {
    let history = run(&stacked("2 m/s", "0 N"), &SimulateOptions::new(3.0));
    assert_eq!(history.end, End::Finished);
    assert_eq!(joints(&history), [[SLIDES, STICKS], [STICKS, STICKS]]);
    assert!((history.events[1].time - 2.0).abs() < 1e-11, "{}", history.events[1].time);
    let last = history.reader().at(3.0).unwrap().configuration;
    assert!((last.coordinates[0] - 2.0).abs() < 1e-11 && last.coordinates[1].abs() < 1e-12);
    assert_eq!(last.rates, [0.0, 0.0]);
}

/// A force of 4 N/s t on the upper block. Both stick up to mu (m_1 + m_2) g = 5 N, t = 1.25 s. Then a = (F -
/// 5 N)/5 kg, and the upper block sticks as long as F - 2 kg a <= 8 N, up to F = 10 N, t = 2.5 s: x = 0.8
/// tau^3/6 and v = 0.4 tau^2 with tau = 1.25 s. From there the slab has (8 - 5) N/3 kg, and the block against
/// it (F - 8 N)/2 kg - 1 m/s^2 = 2 (t - 2.5 s).
#[test]
fn a_growing_force_lets_joints_slip_one_after_the_other() {
    let history = run(&stacked("0 m/s", "4 N/s * t"), &SimulateOptions::new(3.0));
    assert_eq!(history.end, End::Finished);
    assert_eq!(joints(&history), [[STICKS, STICKS], [SLIDES, STICKS], [SLIDES, SLIDES]]);
    // Decisions take slacks below 1e-8 of the greatest force, the weight of 30 N, as zero: 4 N/s pass them in
    // 7.5e-8 s.
    for (event, time) in history.events[1..].iter().zip([1.25, 2.5]) {
        assert!((event.time - time).abs() < 1e-7, "{} {time}", event.time);
        assert_eq!(event.causes, [Cause::Slips]);
    }
    let mut reader = history.reader();
    let (x, v) = (0.8 * 1.25_f64.powi(3) / 6.0, 0.4 * 1.25_f64.powi(2));
    let slipping = reader.at(2.5).unwrap().configuration;
    assert!((slipping.coordinates[0] - x).abs() < 1e-7 && slipping.coordinates[1].abs() < 1e-12);
    let last = reader.at(3.0).unwrap().configuration;
    assert!((last.coordinates[0] - (x + v * 0.5 + 0.125)).abs() < 2e-7, "{:?}", last.coordinates);
    assert!((last.coordinates[1] - 0.125 / 3.0).abs() < 1e-7, "{:?}", last.coordinates);
}

/// A guided block of 2 kg, 0.2 m long, without friction: its weight of 20 N takes up a couple of 20 N * 0.1
/// m = 2 N m. A force of 8 N/s t that acts 0.5 m above its mass centre needs that at t = 0.5 s. A slider that
/// tips has no state in which it could go on.
#[test]
fn a_guided_slider_that_tips_ends_the_motion() {
    for mu in ["0", "0.1"] {
        let text = block(mu, "rate = 1", "").replace("block_slider", "guided_slider");
        let text =
            text.replace("C = [0, 0]", "C = [0, 0]\nH = [0, 0.5]").replace("[\"C\"]", "[\"C\", \"H\"]");
        let force = "
[loads.force]
type = \"force\"
at = \"block.H\"
components = [\"8 N/s * t\", 0]
";
        let history = simulate(&Model::parse(&(text + force)).unwrap(), &SimulateOptions::new(1.0)).unwrap();
        assert!(matches!(history.end, End::Tips(_)), "{:?}", history.end);
        assert!((history.stop() - 0.5).abs() < 1e-9, "{}", history.stop());
        let last = history.events.last().unwrap();
        assert!(matches!(last.causes[..], [Cause::Tips(_)]), "{:?}", last.causes);
        assert!(last.words.contains("block begins to tip in its guide"), "{}", last.words);
    }
}

/// A force of 10 N cos(40 ln|1 - t|) swings faster and faster: with tau = 1 s - t the velocity without
/// friction is -(5 m/s^2) tau (cos(40 ln tau) + 40 sin(40 ln tau))/1601, so that the block reverses
/// infinitely often before 1 s, at intervals that shrink by exp(-pi/40) each. The friction of 1 N delays the
/// reversals, which stay in a geometric sequence.
fn swinging_ever_faster(options: &SimulateOptions) -> History {
    let force = "
[parameters]
second = \"1 s\"
[loads.force]
type = \"force\"
at = \"block.C\"
components = [\"10 N * cos(40*ln(abs(1 - t/second)))\", 0]
";
    let [history, other] = both(&block("0.05", "", force), options);
    // Two ways to decide lead to one motion; nearer to the limit velocities are no greater than the errors of
    // the steps, which decide what happens there.
    assert_eq!(history.end, other.end);
    let resolved = |history: &History| -> Vec<(f64, Vec<Cause>)> {
        let events = history.events.iter().take_while(|event| 1.0 - event.time > RESOLVED);
        events.map(|event| (event.time, event.causes.clone())).collect()
    };
    let (events, others) = (resolved(&history), resolved(&other));
    assert_eq!(events.len(), others.len());
    for ((time, causes), (other, same)) in events.iter().zip(&others) {
        assert!((time - other).abs() < 1e-9 && causes == same, "{time} {other} {causes:?} {same:?}");
    }
    history
}

/// So long before the limit (s) velocities are above the errors of steps.
const RESOLVED: f64 = 5e-6;

/// Times from the stops to 1 s.
fn before_the_limit(history: &History) -> Vec<f64> {
    let stops = history.events.iter().filter(|event| matches!(event.causes[..], [Cause::Stops(_)]));
    stops.map(|event| 1.0 - event.time).collect()
}

#[test]
fn stops_that_accumulate_end_the_motion() {
    // Events within 5e-5 of the time in which it moves through its own size, of which the errors of the steps
    // must be a small part.
    let mut options = SimulateOptions::new(50.0);
    (options.tolerance, options.longest_step) = (1e-12, Some(0.01));
    let history = swinging_ever_faster(&options);
    assert_eq!(history.end, End::Accumulation);
    let stops = before_the_limit(&history);
    assert!(stops.len() > 150, "{}", stops.len());
    // Once the influence of the start has died away, and before rounding of the time matters.
    let ratio = (-std::f64::consts::PI / 40.0).exp();
    for pair in stops[60..100].windows(2) {
        assert!((pair[1] / pair[0] - ratio).abs() < 1e-4, "{} {ratio}", pair[1] / pair[0]);
    }
    assert!(*stops.last().unwrap() < 1e-6, "{:?}", stops.last());
}

/// At default options, too: over 50 s the stops are followed until 40 of them lie within 1e-5 s, where
/// velocities are still above the errors of steps.
#[test]
fn accumulating_stops_are_followed_at_default_options() {
    let history = swinging_ever_faster(&SimulateOptions::new(50.0));
    assert_eq!(history.end, End::Accumulation);
    assert!((history.stop() - 1.0).abs() < 1e-6, "{}", history.stop());
    let ratio = (-std::f64::consts::PI / 40.0).exp();
    let stops = before_the_limit(&history);
    let followed: Vec<f64> = stops.into_iter().take_while(|before| *before > RESOLVED).collect();
    assert!(*followed.last().unwrap() < RESOLVED / ratio.powi(2), "{followed:?}");
    // An error of the velocity delays one stop and hastens the next.
    for stops in followed[60..].windows(3) {
        assert!((stops[2] / stops[0] - ratio * ratio).abs() < 0.01, "{stops:?}");
    }
    assert!(history.energy_error < 1e-5 * history.energy_scale, "{:e}", history.energy_error);
}

/// A force of 1 N + 4 N/s (t - 1 s) against 1 N of friction: v = (t - 1 s)^2 m/s^3 - v_1 is zero at 1 s -
/// sqrt(v_1/(m/s^3)). There the force is less than friction: the block sticks until 1 s, 0.02 s later. Steps
/// have up to 0.37 s.
#[test]
fn a_stop_within_a_third_of_a_step_is_found() {
    let force = "
[loads.force]
type = \"force\"
at = \"block.C\"
components = [\"4 N/s * t - 3 N\", 0]
";
    for longest in [0.3, 0.31, 0.33, 0.35, 0.37] {
        let options = SimulateOptions::new(3.0).longest_step(longest);
        let history = run(&block("0.05", "rate = 0.9996", force), &options);
        assert_eq!(joints(&history), [[SLIDES], [STICKS], [SLIDES]], "{longest}");
        for (event, time) in history.events[1..].iter().zip([0.98, 1.0]) {
            assert!((event.time - time).abs() < 1e-7, "{longest} {}", event.time);
        }
    }
}

/// The example moves to the right while a horizontal force at its lower end grows from 0 N by 10 N/s: normal
/// forces vanish at the forces at which `limits`, which knows nothing of time, says that a mode ends.
#[test]
fn changes_of_mode_are_where_the_limits_are() {
    let settings = Settings::default().parameter("F_20", "0").parameter("mu_1", "0.3");
    let text = crate::gallery::find("klepp-2002").unwrap().text;
    let text = text.replacen("at = \"bar.S\"\ncomponents", "at = \"bar.A\"\ncomponents", 1);
    let still = Model::parse(&text).unwrap().with(&settings).unwrap();
    let report = limits(&still, &LimitsOptions::new(Vary::between("P", "0 N", "40 N")).effort(0)).unwrap();
    let mut ends: Vec<f64> =
        report.modes.iter().filter_map(|mode| mode.to).filter(|end| *end < 40.0).collect();
    ends.sort_by(f64::total_cmp);
    assert!(!ends.is_empty());
    let text = text.replace("[\"P\", 0]", "[\"10 N/s * t\", 0]");
    let growing = Model::parse(&text).unwrap().with(&settings.rate("q", "5 m/s")).unwrap();
    let history = simulate(&growing, &SimulateOptions::new(4.0)).unwrap();
    assert_eq!(history.end, End::Finished);
    let changes = history
        .events
        .iter()
        .filter(|event| event.causes.iter().any(|cause| matches!(cause, Cause::NormalForceZero(_))));
    let times: Vec<f64> = changes.map(|event| event.time).collect();
    assert_eq!(times.len(), ends.len(), "{times:?} {ends:?}");
    for (time, end) in times.iter().zip(&ends) {
        assert!((10.0 * time - end).abs() < 1e-9 * end, "{time} {end}");
    }
}
