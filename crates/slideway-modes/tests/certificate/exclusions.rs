//! Pruning arguments never exclude a solution, and often apply.

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;
use slideway_modes::certificate::{
    Interval, IntervalMatrix, IntervalModeProblem, Propagation, Sign, propagate, proves_empty,
};
use slideway_modes::{BySide, ContactState, ModeProblem};

use crate::oracle::{self, Digits, STATES, agrees, forces, patterns, rational};

/// A pattern and the vertices of what it admits.
type Admitted = (Vec<ContactState>, Vec<Vec<RBig>>);

fn all_solutions(problem: &ModeProblem) -> Vec<Admitted> {
    let admitted = |pattern: Vec<ContactState>| (pattern.clone(), oracle::vertices(problem, &pattern));
    patterns(problem.contacts(), &STATES)
        .into_iter()
        .map(admitted)
        .filter(|(_, found)| !found.is_empty())
        .collect()
}

/// All lists of a state or `None` per contact.
fn partial_patterns(contacts: usize) -> Vec<Vec<Option<ContactState>>> {
    let mut all = vec![Vec::new()];
    for _ in 0..contacts {
        let choices = [None, Some(STATES[0]), Some(STATES[1]), Some(STATES[2])];
        all = all
            .iter()
            .flat_map(|start: &Vec<_>| choices.map(|choice| start.iter().copied().chain([choice]).collect()))
            .collect();
    }
    all
}

/// The row of the inverse of a pattern's matrix that gives the most negative unknown: a Farkas vector
/// of that pattern, in plain arithmetic.
fn farkas_vector(problem: &ModeProblem, pattern: &[ContactState]) -> Option<(DVector<f64>, f64)> {
    let contacts = pattern.len();
    let mut matrix = DMatrix::zeros(contacts, contacts);
    let mut right = problem.right_hand_side().clone();
    for (k, state) in pattern.iter().enumerate() {
        let side = state.side()?;
        matrix.set_column(k, &problem.columns(side).column(k));
        right += problem.jumps(side).column(k);
    }
    let inverse = matrix.try_inverse()?;
    let unknowns = &inverse * &right;
    let worst = unknowns.imin();
    (unknowns[worst] < 0.0).then(|| (inverse.row(worst).transpose(), unknowns[worst]))
}

fn problems(contacts: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = ModeProblem> {
    let coupling = prop::sample::select(vec![None, Some(0.2), Some(0.8)]);
    (contacts, any::<bool>(), prop::bool::weighted(0.7), coupling).prop_flat_map(
        |(contacts, jumps, many, coupling)| {
            let digits = if many { Digits::Many } else { Digits::Few };
            oracle::problem(contacts, digits, jumps, coupling)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn accepted_weights_exclude_no_solution(
        problem in problems(1..=3),
        random in prop::collection::vec(-1.0..1.0_f64, 3),
        noise in prop::sample::select(vec![0.0, 1e-16, 1e-9, 1e-3, 0.1]),
    ) {
        let contacts = problem.contacts();
        let solutions = all_solutions(&problem);
        let within = IntervalModeProblem::widened(&problem, 1e-9).expect("a small width");
        let pressed = patterns(contacts, &STATES[..2]);
        let mut candidates: Vec<DVector<f64>> =
            pressed.iter().filter_map(|pattern| farkas_vector(&problem, pattern)).map(|(w, _)| w).collect();
        candidates.push(DVector::zeros(contacts));
        for weights in candidates {
            let noisy = DVector::from_fn(contacts, |row, _| weights[row] + noise * random[row]);
            for partial in partial_patterns(contacts) {
                let excluded = proves_empty(&problem, &partial, noisy.as_slice());
                prop_assert!(!(excluded && solutions.iter().any(|(pattern, _)| agrees(pattern, &partial))));
                // What holds within bounds holds in the middle of them.
                let always = proves_empty(&within, &partial, noisy.as_slice());
                prop_assert!(!(always && solutions.iter().any(|(pattern, _)| agrees(pattern, &partial))));
            }
        }
    }

    #[test]
    fn bounds_hold_for_all_solutions(problem in problems(1..=3)) {
        let solutions = all_solutions(&problem);
        let within = IntervalModeProblem::widened(&problem, 1e-3).expect("a small width");
        for partial in partial_patterns(problem.contacts()) {
            for propagation in [propagate(&problem, &partial), propagate(&within, &partial)] {
                let remaining = solutions.iter().filter(|(pattern, _)| agrees(pattern, &partial));
                match propagation {
                    Propagation::Unknown => {}
                    Propagation::Empty => prop_assert_eq!(remaining.count(), 0),
                    Propagation::Bounds(bounds) => {
                        for (pattern, vertices) in remaining {
                            prop_assert!(vertices.iter().all(|point| are_within(&bounds, point, pattern, &partial)));
                        }
                    }
                }
            }
        }
    }
}

fn are_within(
    bounds: &[Interval],
    point: &[RBig],
    pattern: &[ContactState],
    partial: &[Option<ContactState>],
) -> bool {
    let signed = forces(point, pattern);
    (0..point.len()).all(|k| {
        let value = if partial[k].is_none() { &signed[k] } else { &point[k] };
        rational(bounds[k].lower()) <= *value && *value <= rational(bounds[k].upper())
    })
}

#[test]
fn inaccurate_weights_of_infeasible_patterns_are_accepted() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let (mut tried, mut accepted, mut accepted_within) = (0, 0, 0);
    for _ in 0..60 {
        let strategy = oracle::problem(6, Digits::Many, true, Some(0.6));
        let problem = strategy.new_tree(&mut runner).expect("a problem").current();
        let within = IntervalModeProblem::widened(&problem, 1e-9).expect("a small width");
        for pattern in patterns(6, &STATES[..2]) {
            let Some((weights, worst)) = farkas_vector(&problem, &pattern) else { continue };
            // A proof of the size of rounding errors is not asked for.
            if worst < -1e-4 && weights.amax() < 1e3 {
                let partial: Vec<_> = pattern.iter().copied().map(Some).collect();
                tried += 1;
                accepted += u32::from(proves_empty(&problem, &partial, weights.as_slice()));
                accepted_within += u32::from(proves_empty(&within, &partial, weights.as_slice()));
                // With the sign turned round they prove nothing.
                assert!(!proves_empty(&problem, &partial, (-weights).as_slice()));
            }
        }
    }
    assert!(tried > 2000 && accepted == tried, "{accepted} of {tried}");
    assert!(f64::from(accepted_within) > 0.999 * f64::from(tried), "{accepted_within} of {tried}");
}

#[test]
fn both_versions_of_columns_and_jumps_are_asked_for() {
    let pressed = |state| [Some(state)];
    let one = |plus: f64, minus: f64, jump_plus: f64, jump_minus: f64| {
        let column = |value: f64| dmatrix![value];
        ModeProblem::new(column(plus), column(minus), column(jump_plus), column(jump_minus), dvector![-1.0])
            .expect("finite")
    };
    // Only the positive column has w . c >= 0.
    let problem = one(1.0, -1.0, 0.0, 0.0);
    assert!(proves_empty(&problem, &pressed(ContactState::Positive), &[1.0]));
    assert!(!proves_empty(&problem, &[None], &[1.0]));
    // In its gap the contact has no column.
    assert!(proves_empty(&problem, &pressed(ContactState::Gap), &[1.0]));
    // One of the jumps outweighs the load.
    for (jump_plus, jump_minus) in [(2.0, 0.0), (0.0, 2.0)] {
        let problem = one(1.0, 1.0, jump_plus, jump_minus);
        let side = if jump_plus == 0.0 { ContactState::Positive } else { ContactState::Negative };
        assert!(proves_empty(&problem, &pressed(side), &[1.0]));
        assert!(!proves_empty(&problem, &pressed(ContactState::Gap), &[1.0]));
        assert!(!proves_empty(&problem, &[None], &[1.0]));
    }
    // Both ends of an inequality that holds as an equation: no proof.
    assert!(!proves_empty(&one(1.0, 1.0, 1.0, 1.0), &[None], &[1.0]));
    assert!(proves_empty(&one(0.0, 0.0, 0.0, 0.0), &[None], &[1.0]));
    assert!(!proves_empty(&one(1.0, 1.0, 0.0, 0.0), &[None], &[f64::NAN]));
    assert!(!proves_empty(&one(1.0, 1.0, 0.0, 0.0), &[None], &[f64::INFINITY]));
}

#[test]
fn weak_coupling_fixes_every_side() {
    let contacts = 20;
    let b = DMatrix::from_fn(contacts, contacts, |row, column| {
        0.4 / contacts as f64 * ((row * 7 + column * 3) % 5) as f64 / 2.0
            * if column % 2 == 0 { 1.0 } else { -1.0 }
    });
    let load = DVector::from_fn(contacts, |row, _| if row % 3 == 0 { -1.0 } else { 2.0 });
    let problem = ModeProblem::from_absolute_value_equation(&DMatrix::identity(contacts, contacts), &b, load)
        .expect("finite");
    let Propagation::Bounds(bounds) = propagate(&problem, &vec![None; contacts]) else { panic!("bounds") };
    assert!(
        (0..contacts)
            .all(|k| bounds[k].sign() == Some(if k % 3 == 0 { Sign::Negative } else { Sign::Positive }))
    );
    // With the sides known all that is left is a linear system.
    let state = |bound: &Interval| {
        bound.sign().map(|sign| if sign == Sign::Positive { STATES[0] } else { STATES[1] })
    };
    let decided: Vec<_> = bounds.iter().map(state).collect();
    let Propagation::Bounds(bounds) = propagate(&problem, &decided) else { panic!("bounds") };
    assert!(bounds.iter().all(|bound| bound.width() < 1e-13));
    let mut wrong = vec![None; contacts];
    wrong[1] = Some(ContactState::Negative);
    assert_eq!(propagate(&problem, &wrong), Propagation::Empty);
}

#[test]
fn bounds_cover_wide_coefficients() {
    // y between 2/3 and 2 on the positive side; N between 1 / 1.5 and 1 / 0.5 with the side open.
    let wide = |centre: f64| IntervalMatrix::around(dmatrix![centre], dmatrix![0.5]).expect("finite");
    let columns = BySide { positive: wide(1.0), negative: wide(-1.0) };
    let jumps = BySide::same(IntervalMatrix::exact(dmatrix![0.0]));
    let problem =
        IntervalModeProblem::new(&columns, &jumps, &IntervalMatrix::exact(dmatrix![1.0])).expect("it fits");
    let Propagation::Bounds(bounds) = propagate(&problem, &[Some(ContactState::Positive)]) else {
        panic!("bounds");
    };
    assert!(bounds[0].contains(2.0 / 3.0) && bounds[0].contains(2.0) && bounds[0].upper() < 2.1);
    assert_eq!(propagate(&problem, &[None]), Propagation::Unknown);
}
