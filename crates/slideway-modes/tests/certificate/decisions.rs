//! `decide` against rational numbers.

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use slideway_modes::certificate::{
    Decision, ExactOutcome, ExactSet, Interval, IntervalModeProblem, IntervalModeProblemError, Precision,
    ProvenDecision, Sign, decide, solve_exactly,
};
use slideway_modes::{
    BySide, ContactState, InfluenceCoefficients, Limits, ModeProblem, ModeProblemError, Side, enumerate,
};

use crate::oracle::{self, Digits, STATES, patterns, rational};

/// How many patterns were decided in which arithmetic, and how many were not.
#[derive(Debug, Default)]
struct DecisionCounts {
    double: u64,
    double_double: u64,
    rational: u64,
    undecided: u64,
}

impl DecisionCounts {
    fn record(&mut self, verdict: &ProvenDecision) {
        *match (&verdict.decision, verdict.precision) {
            (Decision::Undecided { .. }, _) => &mut self.undecided,
            (_, Precision::Double) => &mut self.double,
            (_, Precision::DoubleDouble) => &mut self.double_double,
            (_, Precision::Rational) => &mut self.rational,
        } += 1;
    }
}

fn holds(interval: Interval, value: &RBig) -> bool {
    rational(interval.lower()) <= *value && *value <= rational(interval.upper())
}

/// Checks one pattern's decision by rational numbers, and returns its arithmetic.
fn check(problem: &ModeProblem, pattern: &[ContactState], counts: &mut DecisionCounts) {
    let verdict = decide(problem, pattern);
    counts.record(&verdict);
    let Some(exact) = oracle::unknowns(problem, pattern) else {
        let Decision::Singular { set } = &verdict.decision else { panic!("singular, not {verdict:?}") };
        return check_set(problem, pattern, set);
    };
    let in_gap = |k: usize| pattern[k] == ContactState::Gap;
    let outside = |k: usize| exact[k] < RBig::ZERO || in_gap(k) && exact[k] > RBig::ONE;
    let zeros: Vec<usize> = (0..exact.len()).filter(|&k| exact[k].is_zero()).collect();
    let ones: Vec<usize> = (0..exact.len()).filter(|&k| in_gap(k) && exact[k] == RBig::ONE).collect();
    let on_boundary = !zeros.is_empty() || !ones.is_empty();
    match &verdict.decision {
        Decision::Solution { unknowns, determinant } => {
            let largest = unknowns.iter().fold(0.0, |most: f64, value| most.max(value.upper()));
            assert!(unknowns.iter().all(|value| value.width() <= 1e-9 * largest));
            assert!(!on_boundary && !(0..exact.len()).any(outside));
            assert!(unknowns.iter().zip(&exact).all(|(interval, value)| holds(*interval, value)));
            assert_ne!(*determinant, Sign::Zero);
        }
        Decision::NoSolution { contact } => assert!(outside(*contact)),
        Decision::Boundary { unknowns, zero, full_share, determinant } => {
            assert!(!(0..exact.len()).any(outside) && on_boundary);
            assert_eq!((zero, full_share), (&zeros, &ones));
            assert!(unknowns.iter().zip(&exact).all(|(interval, value)| holds(*interval, value)));
            assert_ne!(*determinant, Sign::Zero);
        }
        other => panic!("regular, not {other:?}"),
    }
    if let Decision::Solution { determinant: found, .. } | Decision::Boundary { determinant: found, .. } =
        verdict.decision
    {
        let ExactOutcome::Regular { determinant, unknowns } = solve_exactly(problem, pattern, 0) else {
            panic!("regular");
        };
        assert_eq!((found, unknowns), (determinant, exact));
    }
}

fn check_set(problem: &ModeProblem, pattern: &[ContactState], set: &ExactSet) {
    let expected = oracle::vertices(problem, pattern);
    let found = set.vertices();
    assert_eq!(found.len(), expected.len(), "{set:?}");
    assert!(expected.iter().all(|point| found.contains(&point)));
    let zero_load = ModeProblem::new(
        problem.columns(Side::Positive).clone(),
        problem.columns(Side::Negative).clone(),
        problem.jumps(Side::Positive) * 0.0,
        problem.jumps(Side::Negative) * 0.0,
        problem.right_hand_side() * 0.0,
    )
    .expect("finite");
    if !pattern.contains(&ContactState::Gap) {
        // With no load, a direction is one more solution of the same pattern.
        let unbounded = !matches!(
            decide(&zero_load, pattern).decision,
            Decision::Singular { set: ExactSet::Point(_) | ExactSet::Empty }
        );
        assert_eq!(unbounded && !expected.is_empty(), !set.directions().is_empty());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(250))]

    #[test]
    fn all_patterns_of_generic_problems(
        problem in (1..=4_usize, any::<bool>())
            .prop_flat_map(|(contacts, jumps)| oracle::problem(contacts, Digits::Many, jumps, None)),
    ) {
        let mut counts = DecisionCounts::default();
        for pattern in patterns(problem.contacts(), &STATES) {
            check(&problem, &pattern, &mut counts);
        }
        prop_assert_eq!(counts.undecided, 0);
    }

    #[test]
    fn all_patterns_of_degenerate_problems(
        problem in (1..=3_usize, any::<bool>())
            .prop_flat_map(|(contacts, jumps)| oracle::problem(contacts, Digits::Few, jumps, None)),
    ) {
        for pattern in patterns(problem.contacts(), &STATES) {
            check(&problem, &pattern, &mut DecisionCounts::default());
        }
    }

    #[test]
    fn some_patterns_of_larger_problems(
        (problem, choices) in (5..=7_usize, any::<bool>(), any::<bool>()).prop_flat_map(|(contacts, jumps, few)| {
            let digits = if few { Digits::Few } else { Digits::Many };
            let pattern = prop::collection::vec(prop::sample::select(STATES.to_vec()), contacts);
            (oracle::problem(contacts, digits, jumps, Some(0.5)), prop::collection::vec(pattern, 12))
        }),
    ) {
        for pattern in choices {
            if oracle::unknowns(&problem, &pattern).is_some() {
                check(&problem, &pattern, &mut DecisionCounts::default());
            }
        }
    }

    #[test]
    fn counts_are_those_of_the_enumeration(
        problem in (1..=7_usize, any::<bool>())
            .prop_flat_map(|(contacts, jumps)| oracle::problem(contacts, Digits::Many, jumps, Some(0.8))),
    ) {
        let found = enumerate(&problem, &Limits::default()).expect("few contacts");
        let mut solutions = 0;
        for pattern in patterns(problem.contacts(), &STATES[..2]) {
            solutions += u64::from(matches!(decide(&problem, &pattern).decision, Decision::Solution { .. }));
        }
        prop_assert_eq!(solutions, found.counts.solution);
    }

    #[test]
    fn decisions_within_bounds_hold_for_every_problem_in_them(
        (problem, steps) in (1..=4_usize, any::<bool>()).prop_flat_map(|(contacts, jumps)| {
            let numbers = 4 * contacts * contacts + contacts;
            (
                oracle::problem(contacts, Digits::Many, jumps, Some(0.8)),
                prop::collection::vec(prop::collection::vec(-1..=1_i32, numbers), 3),
            )
        }),
        width in prop::sample::select(vec![1e-12, 1e-6, 1e-2, 0.2]),
    ) {
        let within = IntervalModeProblem::widened(&problem, width).expect("a moderate width");
        for pattern in patterns(problem.contacts(), &STATES) {
            let decision = decide(&within, &pattern).decision;
            for steps in &steps {
                check_member(&shifted(&problem, steps, width), &pattern, &decision);
            }
        }
    }
}

/// The problem with every number changed by -1, 0 or 1 times nearly the width.
fn shifted(problem: &ModeProblem, steps: &[i32], width: f64) -> ModeProblem {
    let mut steps = steps.iter();
    let mut shift =
        |value: f64| value * (1.0 + 0.999 * width * f64::from(*steps.next().expect("one step per number")));
    let [plus, minus] = Side::BOTH.map(|side| problem.columns(side).map(&mut shift));
    let [jump_plus, jump_minus] = Side::BOTH.map(|side| problem.jumps(side).map(&mut shift));
    let right = problem.right_hand_side().map(&mut shift);
    ModeProblem::new(plus, minus, jump_plus, jump_minus, right).expect("finite")
}

fn check_member(member: &ModeProblem, pattern: &[ContactState], decision: &Decision) {
    let exact = oracle::unknowns(member, pattern);
    let in_gap = |k: usize| pattern[k] == ContactState::Gap;
    match decision {
        Decision::Solution { unknowns, .. } => {
            let exact = exact.expect("regular");
            assert!(unknowns.iter().zip(&exact).all(|(interval, value)| holds(*interval, value)));
            assert!((0..exact.len()).all(|k| exact[k] > RBig::ZERO && (!in_gap(k) || exact[k] < RBig::ONE)));
        }
        Decision::NoSolution { contact } => {
            let value = &exact.expect("regular")[*contact];
            assert!(*value < RBig::ZERO || in_gap(*contact) && *value > RBig::ONE);
        }
        Decision::Undecided { unknowns: Some(unknowns), in_doubt } => {
            let exact = exact.expect("regular");
            assert!(unknowns.iter().zip(&exact).all(|(interval, value)| holds(*interval, value)));
            assert!(!in_doubt.is_empty());
        }
        Decision::Undecided { unknowns: None, in_doubt } => assert!(in_doubt.is_empty()),
        other => panic!("needs exact numbers: {other:?}"),
    }
}

#[test]
fn most_patterns_take_plain_arithmetic() {
    let mut counts = DecisionCounts::default();
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    for _ in 0..40 {
        let tree =
            oracle::problem(6, Digits::Many, false, Some(0.8)).new_tree(&mut runner).expect("a problem");
        for pattern in patterns(6, &STATES[..2]) {
            let verdict = decide(&tree.current(), &pattern);
            counts.record(&verdict);
            assert!(verdict.precision <= Precision::DoubleDouble);
        }
    }
    assert_eq!(counts.double + counts.double_double + counts.rational, 40 * 64);
    assert!(counts.double > 40 * 63 && counts.rational == 0, "{counts:?}");
}

#[test]
fn bounds_of_influence_coefficients_hold_the_rounded_problem() {
    let (eta, mu) = (DMatrix::from_element(2, 2, 0.3), 0.1);
    let exact = |matrix: &DMatrix<f64>| BySide::same(matrix.map(Interval::point));
    let vector = |value: f64| DVector::from_element(2, Interval::point(value));
    let influence = InfluenceCoefficients {
        eta: exact(&eta),
        eta_preload: exact(&eta),
        mu: BySide::same(vector(mu)),
        preload: BySide::same(vector(0.7)),
        velocity_signs: DVector::from_vec(vec![1.0, -1.0]),
        frictionless: vector(1.0),
        shared: None,
        one_sided: vec![],
        turning: vec![],
    };
    let problem = IntervalModeProblem::from_influence(&influence).expect("it fits");
    let rounded = ModeProblem::from_influence(&InfluenceCoefficients {
        eta: BySide::same(eta.clone()),
        eta_preload: BySide::same(eta),
        mu: BySide::same(DVector::from_element(2, mu)),
        preload: BySide::same(DVector::from_element(2, 0.7)),
        velocity_signs: influence.velocity_signs.clone(),
        frictionless: DVector::from_element(2, 1.0),
        shared: None,
        one_sided: vec![],
        turning: vec![],
    })
    .expect("it fits");
    for pattern in patterns(2, &STATES[..2]) {
        let (within, single) = (decide(&problem, &pattern).decision, decide(&rounded, &pattern).decision);
        let (Decision::Solution { unknowns: wide, .. }, Decision::Solution { unknowns: narrow, .. }) =
            (&within, &single)
        else {
            assert_eq!(within, single);
            continue;
        };
        assert!(wide.iter().zip(narrow).all(|(wide, narrow)| wide.intersection(*narrow).is_some()));
        assert!(wide.iter().all(|interval| interval.width() < 1e-13));
    }
    let misfit =
        InfluenceCoefficients { mu: BySide::same(vector(0.0).push(Interval::ZERO)), ..influence.clone() };
    assert!(matches!(
        IntervalModeProblem::from_influence(&misfit),
        Err(IntervalModeProblemError::Problem(ModeProblemError::Shape { found: (3, 1), .. }))
    ));
    let skew =
        InfluenceCoefficients { velocity_signs: DVector::from_vec(vec![1.0, 0.5]), ..influence.clone() };
    assert!(matches!(
        IntervalModeProblem::from_influence(&skew),
        Err(IntervalModeProblemError::Problem(ModeProblemError::VelocitySign { contact: 1, .. }))
    ));
    let huge = InfluenceCoefficients {
        preload: BySide::same(vector(1e308)),
        eta_preload: exact(&DMatrix::from_element(2, 2, 1e9)),
        ..influence
    };
    assert!(matches!(
        IntervalModeProblem::from_influence(&huge),
        Err(IntervalModeProblemError::Radius { .. })
    ));
    assert!(IntervalModeProblem::widened(&rounded, -1.0).is_err());
    assert!(IntervalModeProblem::widened(&rounded, f64::MAX).is_err());
}

#[test]
fn enclosures_of_solutions_are_narrow() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut solutions = 0;
    for _ in 0..20 {
        let problem =
            oracle::problem(6, Digits::Many, true, Some(0.2)).new_tree(&mut runner).expect("a problem");
        for pattern in patterns(6, &STATES[..2]) {
            if let Decision::Solution { unknowns, .. } = decide(&problem.current(), &pattern).decision {
                solutions += 1;
                assert!(unknowns.iter().all(|value| value.width() <= 2.0 * f64::EPSILON * value.upper()));
            }
        }
    }
    assert!(solutions > 10);
}
