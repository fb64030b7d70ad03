//! The example of Klepp (2002), sections 6 and 7, as raw mode problems in the paper's convention
//! (reactions in units of m g, `N_3` positive downwards).

use std::error::Error;
use std::ops::ControlFlow;

use crate::klepp_example::{example, reference};
use nalgebra::DMatrix;
use slideway_modes::certificate::{IntervalMatrix, IntervalModeProblem};
use slideway_modes::{
    BySide, Certificate, Completeness, ContactState, Limits, ModeSolution, SearchOptions, Side, Solutions,
    enumerate, search,
};

fn solve(mu_1: f64, preload: [f64; 3], velocity: f64) -> Result<Solutions, Box<dyn Error>> {
    let problem = example(&reference()?.parameters, mu_1, preload, velocity);
    let solutions = enumerate(&problem, &Limits::default())?;
    assert_eq!(solutions.counts.total(), 8);
    Ok(solutions)
}

fn signs(solution: &ModeSolution) -> String {
    solution.signs.iter().map(|sign| if *sign > 0 { '+' } else { '-' }).collect()
}

#[test]
fn every_printed_number_is_reproduced() -> Result<(), Box<dyn Error>> {
    let reference = reference()?;
    for printed in &reference.printed {
        let found = solve(printed.mu_1, printed.preload, printed.velocity)?;
        assert_eq!(found.solutions.len(), printed.solutions.len());
        for expected in &printed.solutions {
            let close = |solution: &&ModeSolution| {
                (0..3).all(|k| (solution.normal_force[k] - expected.n[k]).abs() < 0.6e-4)
            };
            let solution = found.solutions.iter().find(close).ok_or("a printed solution is missing")?;
            let mu = [printed.mu_1, reference.parameters.mu_2, reference.parameters.mu_3];
            let friction: Vec<f64> = (0..3).map(|k| mu[k] * solution.y[k] + printed.preload[k]).collect();
            assert!(
                friction.iter().zip(&expected.f).all(|(found, printed)| (found - printed).abs() < 0.6e-4)
            );
            assert!((friction.iter().sum::<f64>() - expected.f_total).abs() < 0.6e-4);
        }
    }
    Ok(())
}

#[test]
fn modes_exist_exactly_in_their_intervals() -> Result<(), Box<dyn Error>> {
    for intervals in reference()?.intervals {
        let ends = intervals.modes.iter().flat_map(|mode| [mode.from, mode.to]);
        // Just inside and outside of every end.
        for mu_1 in ends.flat_map(|end| [end - 2e-8, end + 2e-8]).filter(|mu_1| (0.0..=0.8).contains(mu_1)) {
            let mut expected: Vec<&str> = intervals
                .modes
                .iter()
                .filter(|mode| mode.from < mu_1 && mu_1 < mode.to)
                .map(|mode| mode.signs.as_str())
                .collect();
            expected.sort_unstable();
            let found = solve(mu_1, intervals.preload, intervals.velocity)?;
            let mut found: Vec<String> = found.solutions.iter().map(signs).collect();
            found.sort_unstable();
            assert_eq!(found, expected, "mu_1 = {mu_1}, velocity {}", intervals.velocity);
        }
    }
    Ok(())
}

#[test]
fn nothing_is_left_beyond_the_locking_value() -> Result<(), Box<dyn Error>> {
    let found = solve(0.6, [0.0; 3], -1.0)?;
    assert!(found.is_jammed());
    assert_eq!(found.counts.no_solution, 8);
    assert_eq!(found.closest.len(), 4);
    assert!(found.closest.is_sorted_by(|one, other| one.determinant.abs() <= other.determinant.abs()));
    assert!(found.closest.iter().all(|mode| mode.y.min() < 0.0));
    Ok(())
}

#[test]
fn two_contacts_change_side_together() -> Result<(), Box<dyn Error>> {
    let change = reference()?.parameters.alpha_deg.to_radians().tan().recip();
    let found = solve(change, [0.0; 3], -1.0)?;
    assert_eq!(found.solutions.len(), 1);
    let solution = &found.solutions[0];
    assert_eq!(solution.on_boundary, [1, 2]);
    assert_eq!(solution.signs, [1, 0, 0]);
    assert_eq!(solution.pattern_count, 4);
    assert_eq!(solution.patterns.len(), 4);
    assert_eq!(found.counts.boundary, 4);
    assert_eq!(found.counts.no_solution, 4);
    assert_eq!(solution.y[1], 0.0);
    assert!((solution.y[0] - 1.0).abs() < 1e-12);
    Ok(())
}

#[test]
fn preload_gap_instead_of_a_pattern() -> Result<(), Box<dyn Error>> {
    let found = solve(0.24, [0.0, 0.0, 0.5], 1.0)?;
    assert!(found.solutions.is_empty());
    assert_eq!(found.counts.no_solution, 8);
    assert_eq!(found.gap_counts.total(), 4);
    assert_eq!(found.gap_counts.solution, 1);
    assert_eq!(found.gaps.len(), 1);
    let gap = &found.gaps[0];
    assert_eq!(gap.pattern[2], ContactState::Gap);
    assert_eq!(gap.shares.len(), 1);
    assert_eq!(gap.shares[0].contact, 2);
    assert!((0.0..=1.0).contains(&gap.shares[0].lambda));
    assert_eq!(gap.normal_force[2], 0.0);
    // All determinants of the patterns have one sign: nothing locks.
    assert!(found.closest.iter().all(|mode| mode.oriented_determinant > 0.0));
    assert!(!found.is_jammed());
    Ok(())
}

#[test]
fn preload_gap_beside_the_three_printed_solutions() -> Result<(), Box<dyn Error>> {
    // The paper does not look for it: between its first and its second solution lies a state with
    // N_2 = 0. The other reactions balance the weight: N_1 + N_2 - N_3 = m g.
    let found = solve(0.5, [0.0, 1.0, 0.0], 1.0)?;
    assert_eq!(found.gaps.len(), 1);
    let gap = &found.gaps[0];
    assert_eq!(gap.pattern, [ContactState::Positive, ContactState::Gap, ContactState::Positive]);
    assert!(0.0 < gap.shares[0].lambda && gap.shares[0].lambda < 1.0);
    assert!((gap.normal_force[0] - gap.normal_force[2] - 1.0).abs() < 1e-14);
    // Without preload there is no jump, and so no gap to look into.
    assert_eq!(solve(0.6, [0.0; 3], 1.0)?.gap_counts.total(), 0);
    Ok(())
}

/// Moving to the left the mode changes at mu_1 = cot(alpha), where N_2 and N_3 vanish together.
#[test]
fn a_double_boundary_is_labelled_within_rounding() -> Result<(), Box<dyn Error>> {
    let parameters = reference()?.parameters;
    let change = parameters.alpha_deg.to_radians().tan().recip();
    let problem = example(&parameters, change, [0.0; 3], -1.0);
    let within = IntervalModeProblem::widened(&problem, 1e-14)?;
    let result = search(&within, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
    assert_eq!(result.completeness, Completeness::Proven);
    let lists = result.lists(10, 10);
    let [solution] = lists.solutions.as_slice() else { panic!("one solution") };
    assert_eq!((solution.on_boundary.as_slice(), solution.pattern_count), (&[1, 2][..], 4));
    let Certificate::OnBoundaryWithinBounds { in_doubt, .. } = &solution.certificate else {
        panic!("on the boundary within rounding")
    };
    assert_eq!(in_doubt, &[1, 2]);
    assert!(lists.undecided.is_empty());
    // The numbers as rounded are decided one way or the other.
    let exact = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
    assert_eq!(exact.completeness, Completeness::Proven);
    assert!(exact.lists(10, 10).undecided.is_empty());
    Ok(())
}

/// With a coefficient of friction that is known within bounds, some solutions exist for all its values and
/// some for a part of them.
#[test]
fn solutions_for_some_values_of_friction_are_told_apart() -> Result<(), Box<dyn Error>> {
    let parameters = reference()?.parameters;
    let between = |low: f64, high: f64| -> Result<_, Box<dyn Error>> {
        let [one, other] = [low, high].map(|mu_1| example(&parameters, mu_1, [0.0; 3], 1.0));
        let range = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
            IntervalMatrix::from_bounds(&a.zip_map(b, f64::min), &a.zip_map(b, f64::max))
                .ok_or("bounds in order")
        };
        let columns = |side| range(one.columns(side), other.columns(side));
        let columns = BySide { positive: columns(Side::Positive)?, negative: columns(Side::Negative)? };
        let none = BySide::same(IntervalMatrix::exact(DMatrix::zeros(3, 3)));
        let load = IntervalMatrix::exact(DMatrix::from_column_slice(3, 1, one.right_hand_side().as_slice()));
        let problem = IntervalModeProblem::new(&columns, &none, &load)?;
        Ok(search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(())).lists(10, 10))
    };
    let proven = |state: &ModeSolution| matches!(state.certificate, Certificate::Proven { .. });
    // Two solutions from 0.4527 on, one below.
    let (below, above, across) = (between(0.3, 0.31)?, between(0.6, 0.61)?, between(0.44, 0.46)?);
    assert!(below.solutions.len() == 1 && below.undecided.is_empty() && proven(&below.solutions[0]));
    assert!(above.solutions.len() == 2 && above.undecided.is_empty() && above.solutions.iter().all(proven));
    assert!(!across.undecided.is_empty() || !across.solutions.iter().all(proven));
    Ok(())
}
