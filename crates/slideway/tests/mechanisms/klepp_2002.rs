//! The example of Klepp (2002), sections 6 and 7, from its model file: every printed number, every count, the
//! exact intervals. The paper counts the normal force of contact 3 positive downwards, the model file
//! upwards.

use crate::answers::{assert_close, coordinate_acceleration, mode, model, only, report, report_with};
use nalgebra::DVector;
use proptest::prelude::*;
use rstest::rstest;
use slideway::configuration::Configuration;
use slideway::influence::Influence;
use slideway::kinetics::KineticEquations;
use slideway::mechanism::Mechanism;
use slideway::model::Settings;
use slideway::report::{Proof, Solution, SolveReport, Status};

#[path = "../../../slideway-modes/tests/klepp_example/reference.rs"]
mod numbers;

use numbers::{Interval, Intervals, Parameters, Reference};

/// Mass, gravity and length of the bar; the conclusions do not depend on them.
#[derive(Debug, Clone, Copy)]
struct Scale {
    mass: f64,
    gravity: f64,
    length: f64,
}

const EARTH: Scale = Scale { mass: 1.0, gravity: 9.81, length: 1.0 };

fn reference() -> Reference {
    numbers::reference().unwrap()
}

/// The settings of a case: friction of contact 1, preloads in units of m g, sign of the velocity.
fn settings(scale: Scale, mu_1: f64, preload: [f64; 3], velocity: f64) -> Settings {
    let Parameters { alpha_deg, b_over_l, h_over_l, mu_2, mu_3 } = reference().parameters;
    Settings::default()
        .parameter("alpha", format!("{alpha_deg} deg"))
        .parameter("b", format!("{b_over_l}*l"))
        .parameter("h", format!("{h_over_l}*l"))
        .parameter("m", format!("{} kg", scale.mass))
        .parameter("g", format!("{} m/s^2", scale.gravity))
        .parameter("l", format!("{} m", scale.length))
        .parameter("mu_1", mu_1.to_string())
        .parameter("mu_2", mu_2.to_string())
        .parameter("mu_3", mu_3.to_string())
        .parameter("F_10", format!("{}*m*g", preload[0]))
        .parameter("F_20", format!("{}*m*g", preload[1]))
        .parameter("F_30", format!("{}*m*g", preload[2]))
        .parameter("direction", velocity.to_string())
}

fn solved(scale: Scale, mu_1: f64, preload: [f64; 3], velocity: f64) -> SolveReport {
    let report = report_with(&model("klepp-2002"), &settings(scale, mu_1, preload, velocity));
    assert_eq!(report.complete, Proof::Proven);
    assert_eq!(report.patterns.unwrap().total, 8);
    report
}

/// Normal forces in the paper's convention, in units of m g.
fn reactions(solution: &Solution, scale: Scale) -> [f64; 3] {
    let weight = scale.mass * scale.gravity;
    let [upper, front, rear] = &solution.contacts[..] else { panic!("three contacts") };
    [upper.normal_force / weight, front.normal_force / weight, -rear.normal_force / weight]
}

/// Signs of the normal forces in the paper's convention.
fn signs(solution: &Solution) -> String {
    reactions(solution, EARTH).iter().map(|n| if *n > 0.0 { '+' } else { '-' }).collect()
}

fn expected_status(solutions: usize) -> Status {
    match solutions {
        0 => Status::None,
        1 => Status::One,
        _ => Status::Several,
    }
}

#[rstest]
#[case(EARTH)]
#[case(Scale { mass: 3.7, gravity: 1.62, length: 0.25 })]
#[case(Scale { mass: 1.2e4, gravity: 24.79, length: 43.0 })]
fn every_printed_number_is_reproduced(#[case] scale: Scale) {
    let weight = scale.mass * scale.gravity;
    for printed in reference().printed {
        let report = solved(scale, printed.mu_1, printed.preload, printed.velocity);
        assert_eq!(report.solutions.len(), printed.solutions.len());
        for expected in &printed.solutions {
            let found = report.solutions.iter().find(|solution| {
                let found = reactions(solution, scale);
                found.iter().zip(expected.n).all(|(found, printed)| found * printed > 0.0)
            });
            let found = found.expect("a solution with the printed signs");
            let friction = [0, 1, 2].map(|k| found.contacts[k].friction_force / weight);
            // All four decimals, as the paper rounds them.
            for (found, printed) in reactions(found, scale).iter().zip(expected.n) {
                assert_eq!(format!("{found:.4}"), format!("{printed:.4}"));
            }
            for (found, printed) in friction.iter().zip(expected.f) {
                assert_eq!(format!("{:.4}", found * printed.signum()), format!("{:.4}", printed.abs()));
            }
            let total: f64 = friction.iter().sum();
            assert_eq!(format!("{total:.4}"), format!("{:.4}", expected.f_total));
            // F = P - k q - c qd - m qdd with P = k = c = 0.
            assert_close(-coordinate_acceleration(found, "q") / scale.gravity, total, 1.0, 1e-12);
            assert!(found.residual < 1e-12);
        }
    }
}

#[rstest]
fn the_friction_is_what_the_applied_forces_and_inertia_leave(#[values(1.0, -1.0)] velocity: f64) {
    // F_1 + F_2 + F_3 = P - k q - c qd - m qdd
    let (force, stiffness, damping, position, mass) = (2.5, 40.0, 3.0, 0.1, 1.0);
    let settings = settings(EARTH, 0.2, [0.1, 0.2, 0.0], velocity)
        .parameter("P", format!("{force} N"))
        .parameter("k", format!("{stiffness} N/m"))
        .parameter("c", format!("{damping} N s/m"))
        .position("q", format!("{position} m"));
    let report = report_with(&model("klepp-2002"), &settings);
    assert!(!report.solutions.is_empty());
    for solution in &report.solutions {
        let total: f64 = solution.contacts.iter().map(|contact| contact.friction_force).sum();
        let inertia = mass * coordinate_acceleration(solution, "q");
        assert_close(total, force - stiffness * position - damping * velocity - inertia, 10.0, 1e-12);
    }
}

/// The sign patterns of the solutions, sorted.
fn found_signs(report: &SolveReport) -> Vec<String> {
    let mut found: Vec<String> = report.solutions.iter().map(signs).collect();
    found.sort_unstable();
    found
}

fn expected_signs(intervals: &Intervals, mu_1: f64) -> Vec<&str> {
    let exists = |mode: &&Interval| mode.from < mu_1 + 1e-12 && mu_1 < mode.to + 1e-12;
    let mut expected: Vec<&str> =
        intervals.modes.iter().filter(exists).map(|mode| mode.signs.as_str()).collect();
    expected.sort_unstable();
    expected
}

#[rstest]
#[case(EARTH)]
#[case(Scale { mass: 0.02, gravity: 274.0, length: 7.0 })]
fn modes_exist_exactly_in_their_intervals(#[case] scale: Scale) {
    for intervals in reference().intervals {
        let mut ends: Vec<f64> = intervals.modes.iter().flat_map(|mode| [mode.from, mode.to]).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let beside = ends.iter().flat_map(|end| [end - 1e-7, end + 1e-7]);
        let between = ends
            .windows(2)
            .flat_map(|ends| [0.01, 0.3, 0.5, 0.9, 0.99].map(|share| ends[0] + share * (ends[1] - ends[0])));
        for mu_1 in beside.chain(between).filter(|mu_1| (0.0..=0.8).contains(mu_1)) {
            let report = solved(scale, mu_1, intervals.preload, intervals.velocity);
            let expected = expected_signs(&intervals, mu_1);
            assert_eq!(found_signs(&report), expected, "mu_1 = {mu_1}, {:?}", intervals.preload);
            assert_eq!(report.status, expected_status(expected.len()));
        }
    }
}

#[test]
fn signs_and_counts_over_the_whole_range_of_friction() {
    for intervals in reference().intervals {
        for step in 0..=80 {
            let mu_1 = f64::from(step) / 100.0;
            let report = solved(EARTH, mu_1, intervals.preload, intervals.velocity);
            assert_eq!(found_signs(&report), expected_signs(&intervals, mu_1), "mu_1 = {mu_1}");
            assert!(report.solutions.iter().all(|solution| solution.residual < 1e-12));
        }
    }
}

/// The counts that section 7 states, at its own bounds (the last one corrected: theory, section 9).
#[rstest]
#[case([0.0; 3], 1.0, &[(0.0, 1), (0.4526, 1), (0.4527, 2), (0.8, 2)])]
#[case([0.0; 3], -1.0, &[(0.0, 1), (0.1763, 1), (0.1764, 1), (0.4526, 1), (0.4527, 0), (0.8, 0)])]
#[case([0.0, 1.0, 0.0], 1.0, &[(0.0, 1), (0.4526, 1), (0.4527, 2), (0.4675, 2), (0.4764, 2), (0.4765, 3), (0.8, 3)])]
#[case([0.0, 1.0, 0.0], -1.0, &[(0.0, 1), (0.4526, 1), (0.4527, 2), (0.8, 2)])]
fn counts_of_section_7(#[case] preload: [f64; 3], #[case] velocity: f64, #[case] counts: &[(f64, usize)]) {
    for &(mu_1, count) in counts {
        let report = solved(EARTH, mu_1, preload, velocity);
        assert_eq!(report.solutions.len(), count, "mu_1 = {mu_1}");
        assert_eq!(report.status, expected_status(count));
    }
}

#[rstest]
#[case(80.0, 0.2, 0.1, 0.1)]
#[case(70.0, 0.3, 0.05, 0.2)]
#[case(60.0, 0.25, 0.1, 0.15)]
fn the_locking_value_in_closed_form(#[case] alpha: f64, #[case] b: f64, #[case] h: f64, #[case] mu_2: f64) {
    // Without preload, on the lower (or upper) face with both ends of the lower block: its friction is
    // mu_2 (|N_2| + |N_3|) = mu_2 |N_A|, N_A = m g - N_1, whatever b and h. About A, with F = F_1 + F_A:
    //     (F_1 - F/2) tan(alpha) + N_1 - m g/2 = 0.
    // For qd < 0, N_1 > m g > N_A: F_1 = -mu_1 N_1, F_A = -mu_2 (N_1 - m g), so
    //     N_1 (1 - (mu_1 - mu_2) tan(alpha)/2) = m g (1 + mu_2 tan(alpha))/2,
    // which locks at mu_1 = 2 cot(alpha) + mu_2.
    let locking = 2.0 / f64::to_radians(alpha).tan() + mu_2;
    let count = |mu_1: f64, velocity: f64| {
        let settings = settings(EARTH, mu_1, [0.0; 3], velocity)
            .parameter("alpha", format!("{alpha} deg"))
            .parameter("b", format!("{b}*l"))
            .parameter("h", format!("{h}*l"))
            .parameter("mu_2", mu_2.to_string())
            .parameter("mu_3", mu_2.to_string());
        report_with(&model("klepp-2002"), &settings).solutions.len()
    };
    assert_eq!(count(locking - 1e-9, -1.0), 1);
    assert_eq!(count(locking + 1e-9, -1.0), 0);
    assert_eq!(count(locking - 1e-9, 1.0), 1);
    assert_eq!(count(locking + 1e-9, 1.0), 2);
}

#[test]
fn two_contacts_change_side_together() {
    // At mu_1 = cot(alpha), qd < 0, F_0 = 0: contacts 2 and 3 vanish, four patterns give one solution.
    let settings = settings(EARTH, 0.0, [0.0; 3], -1.0).parameter("mu_1", "1/tan(alpha)");
    let report = report_with(&model("klepp-2002"), &settings);
    let solution = only(&report);
    assert!(solution.on_boundary);
    assert_eq!(solution.signs, [1, 0, 0]);
    assert_eq!(solution.patterns.len(), 4);
    assert!(solution.patterns.iter().all(|pattern| pattern.starts_with('+')));
    assert_eq!(report.patterns.unwrap().boundary, 4);
    assert_eq!(report.patterns.unwrap().no_solution, 4);
    assert_eq!([1, 2].map(|k| solution.contacts[k].normal_force), [0.0; 2]);
    assert_close(solution.contacts[0].normal_force, 9.81, 0.0, 1e-12);
    assert_eq!(mode(solution, "lower"), "no contact force");
}

#[rstest]
#[case(0.4527)]
#[case(0.6)]
#[case(0.8)]
fn no_solution_is_a_result(#[case] mu_1: f64) {
    let report = solved(EARTH, mu_1, [0.0; 3], -1.0);
    assert_eq!(report.status, Status::None);
    assert!(report.solutions.is_empty() && report.preload_gap_states.is_empty());
    assert!(report.continua.is_empty() && report.rejected.is_empty());
    assert_eq!(report.patterns.unwrap().no_solution, 8);
    let closest = &report.closest_modes;
    assert_eq!(closest.len(), 4);
    assert!(closest.is_sorted_by(|one, other| one.determinant.abs() <= other.determinant.abs()));
    for mode in closest {
        assert!(mode.determinant.is_finite() && mode.determinant != 0.0);
        assert!(mode.absolute_normal_forces.iter().any(|n| *n < 0.0));
    }
}

#[test]
fn influence_coefficients_of_section_6() {
    let mass = 2.5;
    for (alpha, b, h) in [(80.0, 0.2, 0.1), (35.0, 0.4, 0.07), (110.0, 0.15, 0.3)] {
        let tangent = f64::to_radians(alpha).tan();
        let arm = h / (2.0 * b);
        let settings = settings(Scale { mass, ..EARTH }, 0.3, [0.0; 3], 1.0)
            .parameter("alpha", format!("{alpha} deg"))
            .parameter("b", format!("{b}*l"))
            .parameter("h", format!("{h}*l"));
        let model = model("klepp-2002").with(&settings).unwrap();
        let influence = report_with(&model, &Settings::default()).influence;
        for (k, found) in influence.normal_forces.iter().enumerate() {
            let expected = [0.5, 0.25, 0.25][k] * mass * 9.81;
            assert_close(*found, expected, 0.0, 1e-12);
        }
        // The paper's eta with sign(F_N3) turned and its third row, that of F_N3, turned.
        for (side, found) in [(1.0, &influence.eta_positive), (-1.0, &influence.eta_negative)] {
            let (two, three) = (side, -side);
            let paper = [
                [-tangent / 2.0, tangent / 2.0, tangent / 2.0],
                [tangent / 4.0, arm * two - tangent / 4.0, -arm * three - tangent / 4.0],
                [-tangent / 4.0, arm * two + tangent / 4.0, -arm * three + tangent / 4.0],
            ];
            for j in 0..3 {
                let turned = if j == 2 { -1.0 } else { 1.0 };
                for k in 0..3 {
                    assert_close(found[j][k], turned * paper[j][k], 1.0, 1e-12);
                }
            }
        }
        assert_eq!(influence.coordinate_accelerations.len(), 1);
        assert_close(influence.coordinate_accelerations[0], 0.0, 1.0, 1e-12);
        for kappa in kappa(&Mechanism::new(&model).unwrap()) {
            assert_close(kappa, -1.0 / mass, 0.0, 1e-12);
        }
    }
}

/// Change of the coordinate's acceleration per unit friction of each contact, on both faces.
fn kappa(mechanism: &Mechanism) -> Vec<f64> {
    let configuration = Configuration::new(mechanism).unwrap();
    let equations = KineticEquations::new(mechanism, &configuration).unwrap();
    let influence = Influence::new(&equations);
    let acceleration = |unknowns: &DVector<f64>| equations.coordinate_accelerations(unknowns)[0];
    let frictionless = acceleration(&influence.frictionless);
    influence
        .columns
        .iter()
        .flatten()
        .map(|column| acceleration(&(&influence.frictionless + column)) - frictionless)
        .collect()
}

#[test]
fn the_words_of_section_7() {
    // mu_1 = 0.6: "the upper and the lower sliders are in contact with the corresponding lower guiding
    // surfaces", then "the upper slider is in contact with the upper guiding surface and the lower slider
    // touches the lower".
    let report = solved(EARTH, 0.6, [0.0; 3], 1.0);
    let modes =
        |solution: &Solution| [mode(solution, "upper").to_owned(), mode(solution, "lower").to_owned()];
    assert_eq!(modes(&report.solutions[0]), ["on the lower side of the slot", "flat on the lower guide"]);
    assert_eq!(modes(&report.solutions[1]), ["on the upper side of the slot", "flat on the lower guide"]);
    // mu_1 = 0.5, F_20 = m g: "right below and left above", "right above and left below", lower guiding
    // surface.
    let report = solved(EARTH, 0.5, [0.0, 1.0, 0.0], 1.0);
    let word_of = |pattern: &str| {
        let found = report.solutions.iter().find(|solution| signs(solution) == pattern);
        modes(found.expect("a solution of this pattern"))
    };
    assert_eq!(word_of("+++"), ["on the lower side of the slot", "touching at lower right and upper left"]);
    assert_eq!(word_of("+--"), ["on the lower side of the slot", "touching at upper right and lower left"]);
    assert_eq!(word_of("-+-"), ["on the upper side of the slot", "flat on the lower guide"]);
}

#[test]
fn the_file_as_it_stands_is_the_case_with_three_solutions() {
    let report = report("klepp-2002", &[]);
    assert_eq!(report.status, Status::Several);
    assert_eq!(report, solved_as_printed());
}

fn solved_as_printed() -> SolveReport {
    report_with(&model("klepp-2002"), &Settings::default().parameter("F_20", "m*g").parameter("mu_1", "0.5"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// The paper's own equilibrium conditions (section 7) hold for every solution at any values.
    #[test]
    fn equilibrium_conditions_of_section_7(
        mu in prop::array::uniform3(0.0..1.2_f64),
        preload in prop::array::uniform3(0.0..1.5_f64),
        alpha in 20.0..160.0_f64,
        forwards in any::<bool>(),
    ) {
        prop_assume!((alpha - 90.0).abs() > 2.0);
        let velocity = if forwards { 1.0 } else { -1.0 };
        let settings = settings(EARTH, mu[0], preload, velocity)
            .parameter("mu_2", mu[1].to_string())
            .parameter("mu_3", mu[2].to_string())
            .parameter("alpha", format!("{alpha} deg"));
        let report = report_with(&model("klepp-2002"), &settings);
        let (sin, cos) = f64::to_radians(alpha).sin_cos();
        for solution in &report.solutions {
            let n = reactions(solution, EARTH);
            let f = [0, 1, 2].map(|k| solution.contacts[k].friction_force / 9.81);
            let total: f64 = f.iter().sum();
            let scale = n.iter().chain(&f).fold(1.0, |scale: f64, value| scale.max(value.abs()));
            let near_zero = |value: f64| value.abs() < 1e-10 * scale;
            prop_assert!(near_zero(n[0] + n[1] - n[2] - 1.0));
            prop_assert!(near_zero((f[0] - total / 2.0) * sin + (n[0] - 0.5) * cos));
            let tipping = (f[1] * n[1].signum() - f[2] * n[2].signum()) * 0.1;
            prop_assert!(near_zero((n[1] + n[2]) * 0.2 - tipping));
            for k in 0..3 {
                prop_assert!(near_zero(f[k] - velocity * (mu[k] * n[k].abs() + preload[k])));
            }
        }
    }
}

#[test]
fn at_rest_the_direction_of_friction_is_undefined() {
    let at_rest = model("klepp-2002").with(&Settings::default().rate("q", "0")).unwrap();
    let faults = slideway::solve::solve(&at_rest).unwrap_err();
    let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
    let slideway::fault::FaultKind::ZeroSlidingVelocity { contacts, .. } = &fault.kind else {
        panic!("{faults}")
    };
    assert_eq!(*contacts, ["upper", "lower.front", "lower.rear"]);
}
