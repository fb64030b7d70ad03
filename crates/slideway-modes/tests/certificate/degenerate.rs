//! Degenerate and nearly degenerate problems with known answers.

use std::error::Error;

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::certificate::{
    Decision, ExactOutcome, ExactSet, Interval, IntervalMatrix, IntervalModeProblem, Precision, Sign, decide,
    enclose_solution, enclose_solution_while, solve_exactly,
};
use slideway_modes::{
    BySide, ContactState, InfluenceCoefficients, Limits, ModeProblem, Side, SolutionSet, enumerate,
};

use crate::oracle::{STATES, forces, patterns, rational};

const POSITIVE: ContactState = ContactState::Positive;
const NEGATIVE: ContactState = ContactState::Negative;
const GAP: ContactState = ContactState::Gap;

fn complementarity(m: &DMatrix<f64>, q: DVector<f64>) -> ModeProblem {
    ModeProblem::from_linear_complementarity(m, q).expect("finite numbers")
}

/// The different solutions of a problem whose singular patterns admit at most single points, exactly.
fn solutions(problem: &ModeProblem) -> Vec<Vec<RBig>> {
    let mut found: Vec<Vec<RBig>> = Vec::new();
    for pattern in patterns(problem.contacts(), &STATES[..2]) {
        let points = match decide(problem, &pattern).decision {
            Decision::NoSolution { .. } => continue,
            Decision::Singular { set } => {
                assert!(matches!(set, ExactSet::Empty | ExactSet::Point(_)));
                set.vertices().into_iter().cloned().collect()
            }
            Decision::Solution { .. } | Decision::Boundary { .. } => {
                let ExactOutcome::Regular { unknowns, .. } = solve_exactly(problem, &pattern, 0) else {
                    panic!("regular");
                };
                vec![unknowns]
            }
            Decision::Undecided { .. } => panic!("exact numbers are always decided"),
        };
        for point in points {
            let forces = forces(&point, &pattern);
            if !found.contains(&forces) {
                found.push(forces);
            }
        }
    }
    found
}

#[test]
fn unloaded_identity_is_one_boundary_solution() {
    let problem = complementarity(&DMatrix::identity(3, 3), DVector::zeros(3));
    for pattern in patterns(3, &STATES[..2]) {
        let Decision::Boundary { zero, full_share, .. } = decide(&problem, &pattern).decision else {
            panic!("on the boundary");
        };
        assert_eq!((zero, full_share), (vec![0, 1, 2], vec![]));
    }
    assert_eq!(solutions(&problem).len(), 1);
}

#[test]
fn negative_identity_has_all_solutions() {
    let problem = complementarity(&-DMatrix::identity(3, 3), DVector::repeat(3, 1.0));
    for pattern in patterns(3, &STATES[..2]) {
        let verdict = decide(&problem, &pattern);
        assert_eq!(verdict.precision, Precision::Double);
        let Decision::Solution { determinant, .. } = verdict.decision else { panic!("a solution") };
        assert_eq!(determinant, Sign::Positive);
    }
    assert_eq!(solutions(&problem).len(), 8);
}

#[test]
fn ray_is_exact() {
    let problem = complementarity(&dmatrix![1.0, -1.0; -1.0, 1.0], dvector![-1.0, 1.0]);
    let Decision::Singular { set } = decide(&problem, &[POSITIVE; 2]).decision else { panic!("singular") };
    let (one, none) = (RBig::ONE, RBig::ZERO);
    assert_eq!(set, ExactSet::Ray { from: vec![one.clone(), none], direction: vec![one.clone(), one] });
    assert_eq!(
        set.normal_forces(&[POSITIVE; 2]),
        SolutionSet::Ray { from: dvector![1.0, 0.0], direction: dvector![1.0, 1.0] }
    );
    assert_eq!(decide(&problem, &[NEGATIVE; 2]).decision, Decision::NoSolution { contact: 0 });
    let Decision::Boundary { zero, .. } = decide(&problem, &[POSITIVE, NEGATIVE]).decision else {
        panic!("the end of the ray");
    };
    assert_eq!(zero, [1]);
}

#[test]
fn locked_segment_and_polytope() {
    // z1 + z2 = 1 twice, or 1 and 2 (locked).
    let ones = DMatrix::repeat(2, 2, 1.0);
    let Decision::Singular { set } =
        decide(&complementarity(&ones, dvector![-1.0, -1.0]), &[POSITIVE; 2]).decision
    else {
        panic!("singular");
    };
    assert!(matches!(set, ExactSet::Segment { .. }));
    let locked = complementarity(&ones, dvector![-1.0, -2.0]);
    assert_eq!(decide(&locked, &[POSITIVE; 2]).decision, Decision::Singular { set: ExactSet::Empty });
    // z1 + z2 + z3 = 1: a triangle; z1 + z2 - z3 = 1: two vertices, two directions.
    let triangle = complementarity(&DMatrix::repeat(3, 3, 1.0), DVector::repeat(3, -1.0));
    let Decision::Singular { set } = decide(&triangle, &[POSITIVE; 3]).decision else { panic!("singular") };
    assert_eq!((set.vertices().len(), set.directions().len()), (3, 0));
    let row = dmatrix![1.0, 1.0, -1.0];
    let open = complementarity(&DMatrix::from_fn(3, 3, |_, column| row[column]), DVector::repeat(3, -1.0));
    let Decision::Singular { set } = decide(&open, &[POSITIVE; 3]).decision else { panic!("singular") };
    assert_eq!((set.vertices().len(), set.directions().len()), (2, 2));
    assert!(matches!(set.normal_forces(&[POSITIVE; 3]), SolutionSet::Polytope { .. }));
    let ExactOutcome::Singular(set) = solve_exactly(&open, &[POSITIVE; 3], 3) else { panic!("singular") };
    // Too many corners: one part of dimension 2, and a point inside it.
    let ExactSet::Product(parts) = &set else { panic!("not listed: {set:?}") };
    let [part] = parts.as_slice() else { panic!("one part: {parts:?}") };
    assert_eq!(
        (&part.contacts, part.dimension, &part.set),
        (&vec![0, 1, 2], Some(2), &ExactSet::NotComputed)
    );
    let [z1, z2, z3] = part.inside.as_slice() else { panic!("three unknowns") };
    assert!(part.inside.iter().all(|value| *value > RBig::ZERO) && z1 + z2 - z3 == RBig::ONE);
    assert!(set.vertices().is_empty() && set.is_continuum());
    let SolutionSet::Product(forces) = set.normal_forces(&[POSITIVE; 3]) else { panic!("not listed") };
    let bounds = Interval::around_ratio(z1);
    assert!((bounds.lower()..=bounds.upper()).contains(&forces[0].inside[0]));
}

#[test]
fn gap_without_a_jump_is_a_segment_of_shares() {
    let none = DMatrix::zeros(1, 1);
    let unloaded = ModeProblem::new(dmatrix![1.0], dmatrix![-1.0], none.clone(), none, dvector![0.0]);
    let unloaded = unloaded.expect("finite");
    let Decision::Singular { set } = decide(&unloaded, &[GAP]).decision else { panic!("singular") };
    assert_eq!(set, ExactSet::Segment { from: vec![RBig::ZERO], to: vec![RBig::ONE] });
    assert_eq!(set.normal_forces(&[GAP]), SolutionSet::Point(dvector![0.0]));
}

#[test]
fn gap_shares_at_their_ends() {
    let gap = |load: f64| {
        let (plus, minus) = (dmatrix![0.5], dmatrix![-0.25]);
        let problem = ModeProblem::new(dmatrix![1.0], dmatrix![-1.0], plus, minus, dvector![load]);
        decide(&problem.expect("finite"), &[GAP]).decision
    };
    // N(0) + 0.75 lambda - 0.25 = 0
    assert!(matches!(gap(0.0), Decision::Solution { .. }));
    assert!(matches!(gap(0.25), Decision::Boundary { zero, full_share, .. }
        if zero == [0] && full_share.is_empty()));
    assert!(matches!(gap(-0.5), Decision::Boundary { zero, full_share, .. }
        if zero.is_empty() && full_share == [0]));
    assert_eq!(gap(0.25_f64.next_up()), Decision::NoSolution { contact: 0 });
    assert_eq!(gap((-0.5_f64).next_down()), Decision::NoSolution { contact: 0 });
}

/// The example of Klepp (2002) with `tan(alpha) = 4`, `h / 2 b = 1/4`, `mu_2 = mu_3 = 1/8`: all
/// coefficients are exact in `f64`.
fn klepp_with_exact_numbers(mu_1: f64, velocity: f64) -> ModeProblem {
    let eta = |sign: f64| {
        let (two, three) = (0.25 * sign, -0.25 * sign);
        dmatrix![-2.0, 2.0, 2.0; 1.0, two - 1.0, three - 1.0; -1.0, two + 1.0, three + 1.0]
    };
    let eta = BySide { positive: eta(1.0), negative: eta(-1.0) };
    ModeProblem::from_influence(&InfluenceCoefficients {
        eta_preload: eta.clone(),
        eta,
        mu: BySide::same(dvector![mu_1, 0.125, 0.125]),
        preload: BySide::same(DVector::zeros(3)),
        velocity_signs: DVector::repeat(3, velocity),
        frictionless: dvector![0.5, 0.25, -0.25],
        shared: None,
        one_sided: vec![],
        turning: vec![],
    })
    .expect("finite numbers")
}

#[test]
fn double_boundary_of_the_paper_is_exact() {
    // mu_1 = cot(alpha) = 1/4: N_2 and N_3 vanish together.
    let problem = klepp_with_exact_numbers(0.25, -1.0);
    let mut boundary = 0;
    for pattern in patterns(3, &STATES[..2]) {
        match decide(&problem, &pattern).decision {
            Decision::Boundary { zero, unknowns, .. } => {
                assert_eq!(zero, [1, 2]);
                assert_eq!(unknowns[0].lower(), 1.0);
                assert_eq!(unknowns[0].width(), 0.0);
                boundary += 1;
            }
            other => assert!(matches!(other, Decision::NoSolution { .. }), "{other:?}"),
        }
    }
    assert_eq!(boundary, 4);
    assert_eq!(solutions(&problem), [vec![RBig::ONE, RBig::ZERO, RBig::ZERO]]);
    // One unit in the last place to either side there is one solution off the boundary, and its
    // contacts have changed their sides.
    for (mu_1, expected) in [
        (0.25_f64.next_down(), [POSITIVE, POSITIVE, NEGATIVE]),
        (0.25_f64.next_up(), [POSITIVE, NEGATIVE, POSITIVE]),
    ] {
        let problem = klepp_with_exact_numbers(mu_1, -1.0);
        let is_solution = |pattern: &Vec<ContactState>| {
            matches!(decide(&problem, pattern).decision, Decision::Solution { .. })
        };
        let found: Vec<_> = patterns(3, &STATES[..2]).into_iter().filter(is_solution).collect();
        assert_eq!(found, [expected.to_vec()]);
    }
}

#[test]
fn double_boundary_within_bounds_is_undecided() -> Result<(), Box<dyn Error>> {
    let problem = IntervalModeProblem::widened(&klepp_with_exact_numbers(0.25, -1.0), 1e-15)?;
    for pattern in patterns(3, &STATES[..2]) {
        match decide(&problem, &pattern).decision {
            Decision::Undecided { unknowns: Some(unknowns), in_doubt } => {
                assert_eq!(in_doubt, [1, 2]);
                assert!(unknowns[0].contains(1.0) && unknowns[0].width() < 1e-13);
            }
            other => assert!(matches!(other, Decision::NoSolution { .. }), "{other:?}"),
        }
    }
    Ok(())
}

#[test]
fn tiny_forces_beside_large_ones_are_counted_right() {
    // Contact 2 alone: w = -z + q, with two solutions for q > 0, none for q < 0; f64 with any
    // sensible tolerance sees one on the boundary.
    for (load, expected) in [(1e-14, 2), (-1e-14, 0), (0.0, 1)] {
        let problem = complementarity(&dmatrix![1.0, 0.0; 0.0, -1.0], dvector![-1.0, load]);
        assert_eq!(solutions(&problem).len(), expected);
        let plain = enumerate(&problem, &Limits::default()).expect("small");
        assert_eq!(plain.solutions.len(), 1, "f64 alone cannot tell");
    }
}

#[test]
fn matrix_singular_but_for_one_unit_in_the_last_place() {
    let above = 1.0_f64.next_up();
    // D = eps, and y = (1/2, 1/2); f64 alone takes it for singular.
    let half = 0.5 + 0.5 * above;
    let problem = complementarity(&dmatrix![-1.0, -1.0; -1.0, -above], dvector![1.0, half]);
    let ExactOutcome::Regular { unknowns, determinant } = solve_exactly(&problem, &[POSITIVE; 2], 0) else {
        panic!("regular");
    };
    assert_eq!(determinant, Sign::Positive);
    assert!(unknowns.iter().all(|value| *value >= RBig::ZERO));
    let plain = enumerate(&problem, &Limits::default()).expect("small");
    assert_eq!(plain.counts.singular_continuum, 1, "f64 alone sees a segment");
    let decision = decide(&problem, &[POSITIVE; 2]);
    assert_eq!(decision.precision, Precision::Rational);
    assert!(matches!(decision.decision, Decision::Solution { .. } | Decision::Boundary { .. }));
}

/// The Hilbert matrix times a number that makes all entries integers: condition number about
/// `e^(3.5 n)`.
fn hilbert(size: usize, multiple: f64) -> DMatrix<f64> {
    DMatrix::from_fn(size, size, |row, column| multiple / (row + column + 1) as f64)
}

#[test]
fn hilbert_complementarity_has_exactly_one_solution() {
    // Positive definite in exact arithmetic: all patterns are regular and one gives the solution. The
    // multiple is the least common one of 1 to 23, so that all numbers are exact.
    let m = hilbert(12, 5_354_228_880.0);
    let z = DVector::from_fn(12, |row, _| if row % 5 == 0 || row % 5 == 3 { 1.0 } else { 0.0 });
    let w = z.map(|z| if z == 0.0 { 1.0 / 1024.0 } else { 0.0 });
    let problem = complementarity(&m, w - &m * z);
    let plain = enumerate(&problem, &Limits::default()).expect("small");
    assert!(
        plain.counts.singular_continuum > 0 && plain.counts.singular_empty > 0,
        "f64 alone sees continua"
    );
    for mode in &plain.singular {
        let verdict = decide(&problem, &mode.pattern);
        assert!(!matches!(verdict.decision, Decision::Singular { .. }));
    }
    assert_eq!(solutions(&problem).len(), 1);
}

#[test]
fn enclosure_of_a_hilbert_system_holds_the_exact_solution() {
    let (m, ones) = (hilbert(8, 360_360.0), DMatrix::repeat(8, 2, 1.0));
    let right = &m * &ones;
    let enclosure =
        enclose_solution(&IntervalMatrix::exact(m.clone()), &IntervalMatrix::exact(right.clone()))
            .expect("condition number 1e10");
    assert_eq!(enclosure.determinant, Sign::Positive);
    for entry in 0..8 {
        assert!(enclosure.solution.entry(entry, 1).contains(1.0));
        assert!(enclosure.solution.entry(entry, 0).width() < 1e-3);
    }
    // Too ill-conditioned, singular, or of the wrong shape: no enclosure.
    assert_eq!(
        enclose_solution(
            &IntervalMatrix::exact(hilbert(14, 360_360.0)),
            &IntervalMatrix::exact(DMatrix::repeat(14, 1, 1.0))
        ),
        None
    );
    assert_eq!(
        enclose_solution(&IntervalMatrix::exact(DMatrix::zeros(8, 8)), &IntervalMatrix::exact(right)),
        None
    );
    assert_eq!(
        enclose_solution(&IntervalMatrix::exact(m), &IntervalMatrix::exact(DMatrix::zeros(3, 1))),
        None
    );
}

/// A system of 300 unknowns takes some 10^8 multiplications: wherever it is told to end, it does, and asks no more.
#[test]
fn an_enclosure_ends_where_it_is_told_to() {
    let matrix = IntervalMatrix::exact(DMatrix::from_fn(300, 300, |row, column| {
        if row == column { 2.0 } else { 1.0 / (1.0 + row.abs_diff(column) as f64).powi(2) }
    }));
    let right = IntervalMatrix::exact(DMatrix::repeat(300, 1, 1.0));
    let asked = |most: usize| {
        let mut calls = 0;
        let mut proceed = || {
            calls += 1;
            calls < most
        };
        let ended = enclose_solution_while(&matrix, &right, &mut proceed).is_none();
        (calls, ended)
    };
    let (all, ended) = asked(usize::MAX);
    assert!(all >= 5 && !ended, "{all}");
    for most in 1..=all {
        assert_eq!(asked(most), (most, true));
    }
}

#[test]
fn wide_matrices_that_hold_a_singular_one_are_not_enclosed() {
    let bounds = |matrix: DMatrix<f64>, radius: f64| {
        IntervalMatrix::around(matrix, DMatrix::repeat(2, 2, radius)).expect("finite")
    };
    let right = IntervalMatrix::exact(dmatrix![1.0; 1.0]);
    assert!(enclose_solution(&bounds(DMatrix::identity(2, 2), 0.45), &right).is_some());
    assert!(enclose_solution(&bounds(DMatrix::identity(2, 2), 0.5), &right).is_none());
}

#[test]
fn extreme_sizes_are_decided() {
    for unit in [5e-324, 1e-300, 1e300] {
        let problem = complementarity(&DMatrix::identity(2, 2), dvector![-unit, unit]);
        assert_eq!(solutions(&problem).len(), 1);
        let problem = complementarity(&(DMatrix::identity(2, 2) * unit), dvector![-1.0, -1e-300]);
        let Decision::Solution { unknowns, .. } = decide(&problem, &[POSITIVE; 2]).decision else {
            panic!("a solution");
        };
        assert!(unknowns.iter().all(|y| y.lower() > 0.0 || y.upper() < f64::MIN_POSITIVE));
    }
    let empty = ModeProblem::from_linear_complementarity(&DMatrix::zeros(0, 0), DVector::zeros(0));
    assert!(matches!(decide(&empty.expect("empty"), &[]).decision, Decision::Solution { .. }));
}

#[test]
fn friction_within_bounds_tells_what_persists() -> Result<(), Box<dyn Error>> {
    // mu_1 = 0.1..0.2 keeps the first solution, 0.2..0.3 crosses the double boundary at 1/4.
    let range = |low: f64, high: f64| {
        let [low, high] = [low, high].map(|mu| klepp_with_exact_numbers(mu, -1.0));
        let columns = |side| {
            let (one, other) = (low.columns(side), high.columns(side));
            IntervalMatrix::from_bounds(&one.inf(other), &one.sup(other)).expect("in order")
        };
        let columns = BySide { positive: columns(Side::Positive), negative: columns(Side::Negative) };
        let load = DMatrix::from_column_slice(3, 1, low.right_hand_side().as_slice());
        let jumps = BySide::same(IntervalMatrix::exact(DMatrix::zeros(3, 3)));
        IntervalModeProblem::new(&columns, &jumps, &IntervalMatrix::exact(load))
    };
    let pattern = [POSITIVE, POSITIVE, NEGATIVE];
    assert!(matches!(decide(&range(0.1, 0.2)?, &pattern).decision, Decision::Solution { .. }));
    let Decision::Undecided { in_doubt, .. } = decide(&range(0.2, 0.3)?, &pattern).decision else {
        panic!("crosses the boundary");
    };
    assert_eq!(in_doubt, [1, 2]);
    Ok(())
}

#[test]
fn exact_rational_of_a_float() {
    assert_eq!(rational(0.75), RBig::from_parts(3.into(), 4_u8.into()));
}

/// Uncoupled contacts with `N_1 = load + sum jumps`, and all others well pressed.
fn with_cancelling_jumps(load: f64, jumps: &[f64]) -> ModeProblem {
    let contacts = jumps.len();
    let mut jump_matrix = DMatrix::zeros(contacts, contacts);
    jump_matrix.set_row(0, &DVector::from_column_slice(jumps).transpose());
    let identity = DMatrix::identity(contacts, contacts);
    let mut right = DVector::repeat(contacts, 1.0);
    right[0] = load;
    ModeProblem::new(identity.clone(), -identity, jump_matrix.clone(), jump_matrix, right).expect("finite")
}

#[test]
fn sums_that_cancel_are_decided_by_more_digits() {
    // In f64 the sum is -2^-58, in fact it is +2^-58.
    let problem = with_cancelling_jumps(2.0_f64.powi(-57), &[1.0, -1.0, -(2.0_f64.powi(-58))]);
    let verdict = decide(&problem, &[POSITIVE; 3]);
    assert!(matches!(verdict.decision, Decision::Solution { .. }));
    assert_eq!(verdict.precision, Precision::DoubleDouble);
    // Even with twice the digits the sum is -2^-113, in fact it is +2^-113.
    let small = 2.0_f64.powi(-56);
    let jumps = [small, 2.0_f64.powi(-112), -small, -1.0, -(2.0_f64.powi(-113))];
    let verdict = decide(&with_cancelling_jumps(1.0, &jumps), &[POSITIVE; 5]);
    assert!(matches!(verdict.decision, Decision::Solution { .. }));
    assert_eq!(verdict.precision, Precision::Rational);
}
