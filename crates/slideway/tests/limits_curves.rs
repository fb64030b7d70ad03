//! Quantities along the modes of limits: against the paper's numbers and against the solutions of single
//! states.

use slideway::gallery;
use slideway::limits::{Curve, LimitsOptions, ModeLimits, Quantity, Vary, limits_with_curves};
use slideway::model::{Model, Settings};
use slideway::report::{Solution, Verdict};
use slideway::solve::solve;

fn model(name: &str, settings: &[(&str, &str)]) -> Model {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(gallery::find(name).expect("in the gallery").text)
        .and_then(|model| model.with(&settings))
        .expect("a sound model")
}

/// Klepp (2002), section 7: both sets of solutions at mu_1 = 0.6, in units of m g; N_3 is counted positive
/// downwards there.
#[test]
fn the_paper_s_reactions() {
    let klepp = model("klepp-2002", &[("F_20", "0")]);
    let (report, curves) = limits_with_curves(
        &klepp,
        &LimitsOptions::new(Vary::between("mu_1", 0.0, 0.8)).effort(0),
        Quantity::NormalForce,
    )
    .expect("solvable");
    let printed = [
        ("+++", [0.2625, 0.3872, 0.3503], Verdict::Attainable),
        ("-++", [-1.8754, 1.5096, 1.3658], Verdict::Unattainable),
    ];
    assert_eq!(report.modes.len(), 2);
    for (pattern, forces, verdict) in printed {
        let index =
            report.modes.iter().position(|mode| mode.pattern == pattern).expect("a mode of the paper");
        let points = &curves.forwards[index].points;
        assert!(points.iter().all(|point| point.verdict == verdict));
        let after = points.iter().position(|point| point.at >= 0.6).expect("beyond 0.6");
        for (k, force) in forces.iter().enumerate() {
            // Between two samples, whose values differ by less than a percent: linearly.
            let [one, two] = [&points[after - 1], &points[after]];
            let share = (0.6 - one.at) / (two.at - one.at);
            let value = (one.values[k] + share * (two.values[k] - one.values[k])) / 9.81;
            // Four decimals in print, and what a line between samples leaves.
            assert!((value - force).abs() < 1e-4 + 5e-5, "{pattern} {k}: {value}");
        }
    }
    // Beyond the locking value, it comes from infinity.
    let first = &curves.forwards[report.modes.iter().position(|mode| mode.pattern == "-++").expect("there")]
        .points[0];
    assert!(first.at > 0.452_653_96 && first.at < 0.452_654_5 && first.values[0] < -1e5, "{first:?}");
}

fn of_pattern<'s>(solutions: &'s [Solution], mode: &ModeLimits) -> &'s Solution {
    solutions.iter().find(|solution| solution.pattern == mode.pattern).expect("a solution of this mode")
}

/// A few points within each curve, away from its ends.
fn samples(curve: &Curve) -> impl Iterator<Item = &slideway::limits::CurvePoint> {
    let count = curve.points.len();
    [5, 3, 2].into_iter().map(move |part| &curve.points[count / part])
}

/// A quantity of a solution, in the order of its curves.
type Values = fn(&Solution) -> Vec<f64>;

#[test]
fn points_are_the_solutions_of_their_states() {
    let klepp = model("klepp-2002", &[]);
    let options = LimitsOptions::new(Vary::between("mu_1", 0.0, 0.8)).both_directions(true).effort(0);
    let quantities: [(Quantity, Values); 3] = [
        (Quantity::NormalForce, |solution| {
            solution.contacts.iter().map(|contact| contact.normal_force).collect()
        }),
        (Quantity::Friction, |solution| {
            solution.contacts.iter().map(|contact| contact.friction_force).collect()
        }),
        (Quantity::Acceleration, |solution| {
            solution.coordinates.iter().map(|coordinate| coordinate.acceleration).collect()
        }),
    ];
    for (quantity, values) in quantities {
        let (report, curves) = limits_with_curves(&klepp, &options, quantity).expect("solvable");
        let opposite = report.reversed.as_ref().expect("asked for");
        let reversed = curves.reversed.as_ref().expect("asked for");
        for (direction, modes, found) in
            [(1, &report.modes, &curves.forwards), (-1, &opposite.modes, reversed)]
        {
            assert_eq!(modes.len(), found.len());
            for (mode, curve) in modes.iter().zip(found) {
                for point in samples(curve) {
                    let settings = Settings::default()
                        .parameter("mu_1", format!("{:e}", point.at))
                        .parameter("direction", direction.to_string());
                    let answer = solve(&klepp.with(&settings).expect("sound")).expect("solvable");
                    let states =
                        if mode.preload_gap { &answer.preload_gap_states } else { &answer.solutions };
                    let solution = of_pattern(states, mode);
                    let expected = values(solution);
                    let scale = expected.iter().fold(0.0_f64, |scale, value| scale.max(value.abs()));
                    for (one, other) in point.values.iter().zip(&expected) {
                        assert!(
                            (one - other).abs() < 1e-9 * scale,
                            "{quantity:?} {}: {one} {other}",
                            mode.pattern
                        );
                    }
                    assert_eq!(point.verdict, solution.attainability.verdict);
                }
            }
        }
    }
}

/// docs/src/limits.md: N (L - 2 mu a) = Q a and P = Q + 2 mu N for the drawer's push.
#[test]
fn the_effort_of_a_drawer() {
    let drawer = model("drawer", &[]);
    let (_, curves) = limits_with_curves(
        &drawer,
        &LimitsOptions::new(Vary::between("mu", 0.0, 0.5)).effort(0),
        Quantity::Effort,
    )
    .expect("driven");
    assert_eq!(curves.series[0].unit, "N");
    for point in samples(&curves.forwards[0]) {
        let normal_force = 20.0 * 0.3 / (0.4 - 2.0 * point.at * 0.3);
        let push = 20.0 + 2.0 * point.at * normal_force;
        assert!((point.values[0].abs() - push).abs() < 1e-9 * push, "{point:?}: {push}");
    }
    let klepp = model("klepp-2002", &[]);
    assert!(
        limits_with_curves(&klepp, &LimitsOptions::new(Vary::usual("mu_1")).effort(0), Quantity::Effort)
            .is_err()
    );
}
