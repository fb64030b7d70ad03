//! Which solutions a mechanism with slightly elastic guides takes (theory, section 7).

use crate::answers::{assert_close, normal_forces, parameters, report, report_on, report_with};
use crate::brute_force::Solved;
use crate::random_mechanisms::{cases, mechanisms};
use crate::stiff_guides::{End, StiffGuides};
use proptest::prelude::*;
use rstest::rstest;
use slideway::gallery;
use slideway::model::Model;
use slideway::report::{EigenvalueUnit, Fate, Solution, SolveReport, Verdict};

const WEIGHT: f64 = 9.81;

fn eigenvalues(solution: &Solution) -> Vec<f64> {
    assert!(solution.attainability.eigenvalues.iter().all(|[_, imaginary]| *imaginary == 0.0));
    solution.attainability.eigenvalues.iter().map(|[real, _]| *real).collect()
}

fn klepp(mu_1: &str, preload: &str) -> SolveReport {
    report("klepp-2002", &[("mu_1", mu_1), ("F_20", preload)])
}

/// The numbers of the theory, section 7, in units of kappa/m.
#[test]
fn klepp_without_preload_has_a_threshold_to_jamming() {
    let report = klepp("0.6", "0");
    let [sliding, threshold] = &report.solutions[..] else { panic!("two solutions") };
    assert_close(sliding.contacts[0].normal_force, 0.2625 * WEIGHT, WEIGHT, 1e-4);
    assert_close(threshold.contacts[0].normal_force, -1.8754 * WEIGHT, WEIGHT, 1e-4);
    for (solution, verdict, expected) in
        [(sliding, Verdict::Attainable, [0.732, 2.949]), (threshold, Verdict::Unattainable, [-0.0956, 3.162])]
    {
        assert_eq!(solution.attainability.verdict, verdict);
        assert_eq!(solution.attainability.massless_motions, 1);
        assert_eq!(solution.attainability.depends_on_stiffness, Some(false));
        for (found, expected) in eigenvalues(solution).iter().zip(expected) {
            assert!((found - expected).abs() < 5e-4, "{found} is not {expected}");
        }
    }
    let mut fates = threshold.attainability.separates.unwrap();
    fates.sort_by_key(|fate| *fate == Fate::Jamming);
    assert_eq!(fates, [Fate::Solution(1), Fate::Jamming]);
    assert_eq!(sliding.attainability.separates, None);
}

/// The paper's case of three solutions: two attainable ones and a threshold.
#[test]
fn klepp_with_preload_has_two_attainable_solutions() {
    let report = klepp("0.5", "m*g");
    let verdicts: Vec<Verdict> =
        report.solutions.iter().map(|solution| solution.attainability.verdict).collect();
    assert_eq!(verdicts, [Verdict::Attainable, Verdict::Attainable, Verdict::Unattainable]);
    let fates = report.solutions[2].attainability.separates.unwrap();
    assert!(fates.contains(&Fate::Jamming) && fates.iter().any(|fate| matches!(fate, Fate::Solution(1 | 2))));
}

/// Without approximations of small motions or separated masses: bodies on springs, small steps. One per cent
/// to either side of the threshold its fate is the one that is reported.
#[rstest]
#[case("0.6", "0", 0.0)]
#[case("0.5", "0", 0.0)]
#[case("0.5", "m*g", 1.0)]
fn a_stiff_simulation_has_the_same_fates(#[case] mu_1: &str, #[case] preload: &str, #[case] preload_2: f64) {
    let report = klepp(mu_1, preload);
    let kappa = 1e8;
    let guides = StiffGuides {
        mu: [mu_1.parse().unwrap(), 0.1, 0.1],
        preload: [0.0, preload_2 * WEIGHT, 0.0],
        kappa,
        delta: 1.0 / (0.6 * kappa).sqrt(),
    };
    let forces = |solution: &Solution| -> [f64; 3] { normal_forces(solution).try_into().unwrap() };
    for solution in &report.solutions {
        let at = forces(solution);
        if solution.attainability.verdict == Verdict::Attainable {
            let End::Steady(end) = guides.end(at.map(|force| 1.01 * force)) else { panic!("it settles") };
            for (found, expected) in end.iter().zip(at) {
                assert_close(*found, expected, WEIGHT, 2e-2);
            }
            continue;
        }
        let mut ends = [0.99, 1.01].map(|factor| guides.end(at.map(|force| factor * force)));
        ends.sort_by_key(|end| *end == End::Jammed);
        let mut fates = solution.attainability.separates.unwrap();
        fates.sort_by_key(|fate| *fate == Fate::Jamming);
        for (end, fate) in ends.iter().zip(fates) {
            match (end, fate) {
                (End::Jammed, Fate::Jamming) => {}
                (End::Steady(end), Fate::Solution(number)) => {
                    for (found, expected) in end.iter().zip(forces(&report.solutions[number - 1])) {
                        assert_close(*found, expected, WEIGHT, 2e-2);
                    }
                }
                _ => panic!("{end:?} is not {fate:?}"),
            }
        }
    }
}

/// Two equal sliders without rotation, friction above: their sum has the eigenvalue 1, the rod's rotation
/// cos^2 phi + mu s sigma sin phi cos phi / 2, in units of kappa/m.
#[rstest]
#[case(0.5, 1)]
#[case(3.0, -1)]
#[case(4.0, -1)]
fn painleve_klein(#[case] mu: f64, #[case] direction: i8) {
    let list = [("mu", mu.to_string()), ("direction", direction.to_string())];
    let list: Vec<(&str, &str)> = list.iter().map(|(name, value)| (*name, value.as_str())).collect();
    let report = report("painleve-klein", &list);
    assert!(!report.solutions.is_empty());
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    for solution in &report.solutions {
        let side = f64::from(solution.contacts[0].side * direction);
        let rotation = cos * cos + mu * side * sin * cos / 2.0;
        let mut expected = [rotation, 1.0];
        expected.sort_by(f64::total_cmp);
        for (found, expected) in eigenvalues(solution).iter().zip(expected) {
            assert_close(*found, expected, 1.0, 1e-12);
        }
        let unattainable = solution.attainability.verdict == Verdict::Unattainable;
        assert_eq!(unattainable, rotation < 0.0);
        let fates = solution.attainability.separates;
        assert_eq!(fates.is_some_and(|fates| fates.contains(&Fate::Jamming)), unattainable);
    }
}

/// The example with stiffnesses in its joints.
fn klepp_with_stiffness(kappa: [f64; 3]) -> SolveReport {
    let text = gallery::find("klepp-2002").unwrap().text;
    let [upper, front, rear] = kappa;
    let text = text
        .replace("preload = \"F_10\"", &format!("preload = \"F_10\"\nstiffness = \"{upper} N/m\""))
        .replace("preload = \"F_20\" }", &format!("preload = \"F_20\", stiffness = \"{front} N/m\" }}"))
        .replace("preload = \"F_30\" }", &format!("preload = \"F_30\", stiffness = \"{rear} N/m\" }}"));
    report_with(&Model::parse(&text).unwrap(), &parameters(&[("F_20", "0"), ("mu_1", "0.6")]))
}

#[test]
fn eigenvalues_grow_with_the_stiffness() {
    let unit = klepp("0.6", "0");
    let stiff = klepp_with_stiffness([2e7; 3]);
    let uneven = klepp_with_stiffness([1e7, 2e7, 3e7]);
    for ((unit, stiff), uneven) in unit.solutions.iter().zip(&stiff.solutions).zip(&uneven.solutions) {
        assert_eq!(unit.attainability.eigenvalue_unit, EigenvalueUnit::PerKilogram);
        assert_eq!(stiff.attainability.eigenvalue_unit, EigenvalueUnit::PerSecondSquared);
        assert_eq!(unit.attainability.separates, stiff.attainability.separates);
        assert_eq!(unit.attainability.verdict, uneven.attainability.verdict);
        for (unit, stiff) in eigenvalues(unit).iter().zip(eigenvalues(stiff)) {
            assert_close(stiff, 2e7 * unit, 0.0, 1e-12);
        }
        assert!(
            eigenvalues(unit).iter().zip(eigenvalues(uneven)).any(|(a, b)| (b / a / 2e7 - 1.0).abs() > 1e-2)
        );
    }
}

#[test]
fn boundaries_and_gaps_are_not_examined() {
    let report = klepp("0.5", "m*g");
    for state in &report.preload_gap_states {
        assert_eq!(state.attainability.verdict, Verdict::NotComputed);
        assert!(state.attainability.reason.is_some());
    }
    let cot = "1/tan(alpha)";
    let report = crate::answers::report("klepp-2002", &[("mu_1", cot), ("F_20", "0"), ("direction", "-1")]);
    for solution in report.solutions.iter().filter(|solution| solution.on_boundary) {
        assert_eq!(solution.attainability.verdict, Verdict::NotComputed);
    }
}

/// A bracket without mass that a drive moves: its gaps react statically.
#[test]
fn a_driven_mechanism_without_mass() {
    let text = gallery::find("bracket-on-pole").unwrap().text;
    let drive = "[drives.lower]\ncoordinate = \"z\"\nacceleration = 0\nforce = { at = \"bracket.centre\", direction = \"90 deg\" }";
    let report = report_on(&format!("{text}\n{drive}\n"));
    assert!(!report.solutions.is_empty());
    for solution in &report.solutions {
        assert_eq!(solution.attainability.massless_motions, 2);
        assert!(solution.attainability.eigenvalues.is_empty());
        assert_eq!(solution.attainability.verdict, Verdict::Attainable);
    }
}

proptest! {
    #![proptest_config(cases(250))]

    /// p < 0 exactly if the number of negative eigenvalues is odd; such a solution is never attained.
    #[test]
    fn the_oriented_determinant_tells_the_parity(drawing in mechanisms()) {
        let Some(Solved { drawing, report, .. }) = Solved::new(drawing) else {
            return Err(TestCaseError::reject("state"))
        };
        for solution in report.solutions.iter().filter(|solution| !solution.on_boundary) {
            let found = &solution.attainability;
            prop_assert!(found.verdict != Verdict::NotComputed, "{:?}", found);
            prop_assert!(found.verdict != Verdict::Undecided || !drawing.drives.is_empty(), "{:?}", found);
            prop_assert_eq!(found.reason.is_some(), found.verdict == Verdict::Undecided);
            prop_assert_eq!(found.flutter_damping.is_some(), found.verdict == Verdict::Flutter);
            if found.verdict == Verdict::Undecided {
                continue;
            }
            prop_assert_eq!(found.eigenvalues.len() + found.massless_motions, solution.contacts.len());
            if found.massless_motions == 0 {
                let negative = found.eigenvalues.iter().filter(|[re, im]| *re < 0.0 && im.abs() <= 1e-7 * re.abs());
                prop_assert_eq!(negative.count() % 2 == 1, solution.oriented_determinant < 0.0);
            }
            if solution.oriented_determinant < 0.0 {
                prop_assert_eq!(found.verdict, Verdict::Unattainable);
                prop_assert_eq!(found.depends_on_stiffness, Some(false));
            }
            for fate in found.separates.iter().flatten() {
                if let Fate::Solution(number) = fate {
                    let verdict = report.solutions[number - 1].attainability.verdict;
                    prop_assert!(matches!(verdict, Verdict::Attainable | Verdict::Flutter));
                }
            }
        }
    }
}

/// A carriage of mass m, J = m (L^2 + c^2) / 12, is pulled at the height a above its rail, its centre of mass at c.
/// While the bearings give way and it tilts by theta, moments about the pulled point, in which the pull has no
/// part, are `(J + m (c - a)^2) theta''` if the drive holds that point, and `(J + m c (c - a)) theta''` if it holds
/// the displacement in the bearings, at the height 0: with c = 10 mm, a = 100 mm and L = 60 mm an inertia of
/// `m (308 - 900) mm^2`, below zero, so that any tilt grows.
#[test]
fn the_coordinate_that_a_drive_holds_decides_and_is_told() {
    let template = slideway::template::find("carriage").unwrap();
    let at_the_belt = template.text.replace("c = \"150 mm\"", "c = \"10 mm\"");
    let in_the_bearings = at_the_belt.replace("x = \"carriage.belt\"", "slide = \"bearings\"");
    assert!(at_the_belt != template.text && in_the_bearings != at_the_belt);
    let attainability = |text: &str| {
        let report = report_on(text);
        let [solution] = &report.solutions[..] else { panic!("{}", report.solutions.len()) };
        solution.attainability.clone()
    };
    assert_eq!(attainability(&at_the_belt).verdict, Verdict::Attainable);
    let undecided = attainability(&in_the_bearings);
    assert_eq!(undecided.verdict, Verdict::Undecided);
    let words = undecided.in_words();
    assert!(
        words.contains("in another place or direction than pull acts")
            && words.contains("`x = \"carriage.belt\"` in [coordinates.x]"),
        "{words}"
    );
    // (c - a) c > -J / m: the carriage as the template has it does not mind.
    assert_eq!(
        attainability(&template.text.replace("x = \"carriage.belt\"", "slide = \"bearings\"")).verdict,
        Verdict::Attainable
    );
}
