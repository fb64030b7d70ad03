//! The example of Klepp (2002) between its guides at rest: when it wedges itself, and when it is set going.
//!
//! Pulled to the left by Q at its middle and pressed up by its upper slot with n, the bar presses its slider
//! against the upper face of the lower slot with n - m g. The frictions F at the top and H at the foot act to
//! the right: F + H = Q, and moments about the middle give F - H = (2 n - m g) cot(alpha). Both stay within
//! their limits, F <= mu_1 n and -H <= mu_2 (n - m g), if
//!
//! ```text
//! 2 (cot(alpha) - mu_2) n - m g (cot(alpha) - 2 mu_2)  <=  Q  <=  2 (mu_1 - cot(alpha)) n + m g cot(alpha)
//! ```
//!
//! For mu_1 >= 2 cot(alpha) - mu_2 there is such an n for every Q that is great enough; below it the greatest
//! Q belongs to the n at which both bounds are equal.

use crate::model;
use slideway::motion::{Cause, History, JointPhase, SimulateOptions, simulate};
use slideway::standstill::{HoldOptions, hold};

const G: f64 = 9.81;
const MU_2: f64 = 0.1;

fn cot() -> f64 {
    1.0 / 80_f64.to_radians().tan()
}

/// The greatest pull to the left that is held (N).
fn greatest_pull(mu_1: f64) -> f64 {
    let normal = G * (cot() - MU_2) / (2.0 * cot() - MU_2 - mu_1);
    assert!(normal > G);
    2.0 * (mu_1 - cot()) * normal + G * cot()
}

#[test]
fn statics_hold_what_the_derivation_says() {
    let options = HoldOptions::default().load("P").vary("mu_1");
    for mu_1 in [0.2, 0.24, 0.25] {
        let settings = [("F_20", "0"), ("mu_1", &*mu_1.to_string()), ("P", "-10 N")];
        let report = hold(&model("klepp-2002", &settings), &options).unwrap();
        let load = report.load.unwrap();
        let threshold = load.threshold.value.unwrap();
        assert!((threshold - (2.0 * cot() - MU_2)).abs() < 1e-9, "{threshold}");
        let greatest = load.held.iter().filter_map(|range| range.greatest).fold(0.0, f64::max);
        let expected = greatest_pull(mu_1) / 10.0;
        assert!((greatest - expected).abs() < 1e-9 * expected, "{mu_1} {greatest} {expected}");
    }
}

/// The bar is sent to the right; a pull to the left grows as a sine of period 4 s.
fn pulled(mu_1: f64, pull: f64) -> History {
    let (mu_1, pull) = (mu_1.to_string(), format!("{} N", -pull));
    let settings = [("mu_1", &*mu_1), ("P", &*pull), ("f", "0.25 Hz"), ("k", "1 N/m")];
    simulate(&model("klepp-2002-spring", &settings), &SimulateOptions::new(1.0)).unwrap()
}

/// It stops, wedges itself, and slides back when the pull has grown to what it can hold.
#[test]
fn below_self_locking_the_wedged_bar_gives_way() {
    let threshold = 2.0 * cot() - MU_2;
    for (mu_1, pull) in [(0.24, 20.0), (0.25, 100.0), (threshold - 1e-4, 2000.0)] {
        let history = pulled(mu_1, pull);
        let [_, stops, slips, ..] = &history.events[..] else { panic!("{:#?}", history.events) };
        assert!(stops.causes.iter().any(|cause| matches!(cause, Cause::Stops(_))), "{mu_1} {}", stops.words);
        assert_eq!(stops.phase.as_ref().unwrap().joints, [JointPhase::Sticking; 2]);
        assert_eq!(slips.causes, [Cause::Slips], "{mu_1} {}", slips.words);
        assert_eq!(slips.phase.as_ref().unwrap().joints, [JointPhase::Sliding(-1.0); 2]);
        let place = history.reader().configuration(slips.time).unwrap().coordinates[0];
        let load = pull * (std::f64::consts::FRAC_PI_2 * slips.time).sin() + place;
        let expected = greatest_pull(mu_1);
        assert!((load - expected).abs() < 1e-6 * expected, "{mu_1} {load} {expected}");
    }
}

/// Just above it wedges itself whatever pulls.
#[test]
fn beyond_self_locking_the_wedged_bar_stays() {
    for mu_1 in [2.0 * cot() - MU_2 + 1e-4, 0.3, 0.45] {
        for pull in [20.0, 2000.0, 1e6] {
            let history = pulled(mu_1, pull);
            let last = history.events.last().unwrap();
            assert!(
                last.causes.iter().any(|cause| matches!(cause, Cause::Stops(_))),
                "{mu_1} {pull} {}",
                last.words
            );
            assert_eq!(last.phase.as_ref().unwrap().joints, [JointPhase::Sticking; 2], "{mu_1} {pull}");
            assert_eq!(history.stop(), 1.0);
        }
    }
}
