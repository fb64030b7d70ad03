//! Uniqueness for every load against the determinants of all patterns, and known answers.

use std::error::Error;
use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;
use slideway_modes::{
    BySide, InfluenceCoefficients, ModeProblem, Side, Unfinished, Uniqueness, UniquenessLimits, uniqueness,
    uniqueness_with,
};

fn decide(problem: &ModeProblem) -> Uniqueness {
    uniqueness(problem, &UniquenessLimits::default())
}

/// `p(sigma)` by an LU factorization.
fn oriented_determinant(problem: &ModeProblem, pattern: &[Side]) -> f64 {
    let contacts = problem.contacts();
    let column = |k: usize| problem.columns(pattern[k]).column(k) * pattern[k].sign();
    DMatrix::from_fn(contacts, contacts, |row, k| column(k)[row]).determinant()
}

fn patterns(contacts: usize) -> impl Iterator<Item = Vec<Side>> {
    (0..1_usize << contacts).map(move |bits| (0..contacts).map(|k| Side::BOTH[bits >> k & 1]).collect())
}

fn equation(b: &DMatrix<f64>) -> ModeProblem {
    let contacts = b.nrows();
    let identity = DMatrix::identity(contacts, contacts);
    ModeProblem::from_absolute_value_equation(&identity, b, DVector::zeros(contacts)).expect("finite numbers")
}

fn complementarity(m: &DMatrix<f64>) -> ModeProblem {
    ModeProblem::from_linear_complementarity(m, DVector::zeros(m.nrows())).expect("finite numbers")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn agrees_with_all_determinants(
        contacts in 1..=8_usize,
        strength in 0.05..1.5_f64,
        mirrored in any::<bool>(),
        numbers in prop::collection::vec(-1.0..1.0_f64, 2 * 64),
    ) {
        let size = strength / (contacts as f64).sqrt();
        let square = contacts * contacts;
        let part = |at: usize| DMatrix::from_column_slice(contacts, contacts, &numbers[at * square..][..square]);
        let identity = DMatrix::<f64>::identity(contacts, contacts) * if mirrored { -1.0 } else { 1.0 };
        let none = DMatrix::zeros(contacts, contacts);
        let problem = ModeProblem::new(
            &identity + part(0) * size,
            -&identity + part(1) * size,
            none.clone(),
            none,
            DVector::zeros(contacts),
        )?;
        let determinants: Vec<f64> =
            patterns(contacts).map(|pattern| oriented_determinant(&problem, &pattern)).collect();
        prop_assume!(determinants.iter().all(|p| p.abs() > 1e-9));
        match decide(&problem) {
            Uniqueness::Unique { sign } => {
                prop_assert!(determinants.iter().all(|p| p.signum() == f64::from(sign)));
            }
            Uniqueness::NotUnique { positive, negative } => {
                prop_assert!(oriented_determinant(&problem, &positive) > 0.0);
                prop_assert!(oriented_determinant(&problem, &negative) < 0.0);
            }
            other => prop_assert!(false, "{other:?}"),
        }
    }

    #[test]
    fn integers_are_decided_exactly(
        contacts in 1..=4_usize,
        numbers in prop::collection::vec(-2..=2_i32, 2 * 16),
        shift in 0..4_usize,
    ) {
        // A third of these matrices is singular in some pattern; factors of 0.1 keep eliminations from being
        // exact.
        let square = contacts * contacts;
        let part = |at: usize| {
            DMatrix::from_fn(contacts, contacts, |row, column| {
                let diagonal = if row == column { f64::from(u8::try_from(shift).unwrap_or(0)) } else { 0.0 };
                f64::from(numbers[at * square + column * contacts + row]) + diagonal
            })
        };
        let none = DMatrix::zeros(contacts, contacts);
        let problem =
            ModeProblem::new(part(0) * 3.0, part(1) * -3.0, none.clone(), none, DVector::zeros(contacts))?;
        let signs: Vec<f64> = patterns(contacts)
            .map(|pattern| oriented_determinant(&problem, &pattern).round())
            .map(|p| if p == 0.0 { 0.0 } else { p.signum() })
            .collect();
        let unique = signs[0] != 0.0 && signs.iter().all(|sign| *sign == signs[0]);
        match decide(&problem) {
            Uniqueness::Unique { sign } => prop_assert!(unique && signs[0] == f64::from(sign)),
            Uniqueness::NotUnique { positive, negative } => {
                prop_assert!(oriented_determinant(&problem, &positive).round() > 0.0);
                prop_assert!(oriented_determinant(&problem, &negative).round() < 0.0);
            }
            Uniqueness::Singular { pattern } => {
                prop_assert_eq!(oriented_determinant(&problem, &pattern).round(), 0.0);
            }
            other => prop_assert!(false, "{other:?}"),
        }
    }
}

#[test]
fn p_matrices_and_others() {
    // p = (-1)^r times a principal minor of M: w = M z + q.
    let unique =
        [dmatrix![2.0], dmatrix![1.0, -3.0; 0.0, 1.0], dmatrix![1.0, 2.0, 0.0; 0.0, 1.0, 2.0; 2.0, 0.0, 1.0]];
    for m in &unique {
        let sign = if m.nrows() % 2 == 0 { 1 } else { -1 };
        assert_eq!(decide(&complementarity(m)), Uniqueness::Unique { sign }, "{m}");
    }
    let others = [dmatrix![-1.0, 0.0; 0.0, 1.0], dmatrix![1.0, 2.0; 1.0, 1.0]];
    for m in &others {
        assert!(matches!(decide(&complementarity(m)), Uniqueness::NotUnique { .. }), "{m}");
    }
    let singular = decide(&complementarity(&dmatrix![1.0, -1.0; -1.0, 1.0]));
    assert_eq!(singular, Uniqueness::Singular { pattern: vec![Side::Positive; 2] });
    // A zero on the diagonal.
    assert!(matches!(decide(&complementarity(&dmatrix![0.0, 1.0; -1.0, 1.0])), Uniqueness::Singular { .. }));
}

#[test]
fn all_negative_counts_as_well() {
    // -x = b.
    let none = DMatrix::zeros(1, 1);
    let problem = ModeProblem::from_absolute_value_equation(&dmatrix![-1.0], &none, dvector![0.0]);
    assert_eq!(decide(&problem.expect("one number")), Uniqueness::Unique { sign: -1 });
    let nothing = DMatrix::zeros(0, 0);
    let problem = ModeProblem::from_absolute_value_equation(&nothing, &nothing, DVector::zeros(0));
    assert_eq!(decide(&problem.expect("no number")), Uniqueness::Unique { sign: 1 });
}

/// The example of Klepp (2002), section 6, in the paper's convention.
fn example(mu_1: f64, preload: f64) -> ModeProblem {
    let tangent = 80.0_f64.to_radians().tan();
    let eta = |side: Side| {
        let (two, three) = (0.25 * side.sign(), -0.25 * side.sign());
        dmatrix![
            -tangent / 2.0, tangent / 2.0, tangent / 2.0;
            tangent / 4.0, two - tangent / 4.0, three - tangent / 4.0;
            -tangent / 4.0, two + tangent / 4.0, three + tangent / 4.0
        ]
    };
    let eta = BySide { positive: eta(Side::Positive), negative: eta(Side::Negative) };
    ModeProblem::from_influence(&InfluenceCoefficients {
        eta_preload: eta.clone(),
        eta,
        mu: BySide::same(dvector![mu_1, 0.1, 0.1]),
        preload: BySide::same(dvector![0.0, preload, 0.0]),
        velocity_signs: dvector![1.0, 1.0, 1.0],
        frictionless: dvector![0.5, 0.25, -0.25],
        shared: None,
        one_sided: vec![],
        turning: vec![],
    })
    .expect("finite numbers")
}

#[test]
fn the_papers_example_is_unique_up_to_its_first_locking_value() {
    // D of the patterns vanishes at 2 cot(alpha) -+ 0.1 and -+ 0.005 (mu_2 = mu_3 = 0.1). The printed
    // mu_1* = 0.45265396 is the largest of these, that of the mode which the given load takes; for
    // every load uniqueness is lost at the smallest one.
    let first = 2.0 / 80.0_f64.to_radians().tan() - 0.1;
    for mu_1 in [0.0, 0.1, 0.2, first - 1e-9] {
        assert_eq!(decide(&example(mu_1, 0.0)), Uniqueness::Unique { sign: 1 }, "mu_1 = {mu_1}");
    }
    for mu_1 in [first + 1e-9, 0.3, 0.452_653_95, 0.452_653_97, 0.8] {
        assert!(matches!(decide(&example(mu_1, 0.0)), Uniqueness::NotUnique { .. }), "mu_1 = {mu_1}");
    }
    let (minus, plus) = (Side::Negative, Side::Positive);
    let expected = Uniqueness::NotUnique { positive: vec![plus; 3], negative: vec![minus, minus, plus] };
    assert_eq!(decide(&example(first + 1e-9, 0.0)), expected);
    assert_eq!(decide(&example(0.2, 1.0)), Uniqueness::JumpsPresent { contact: 1 });
}

/// Numbers from -1 to 1.
fn random_matrix(size: usize, mut state: u64) -> DMatrix<f64> {
    DMatrix::from_fn(size, size, |_, _| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    })
}

#[test]
fn large_problems_are_proven_without_the_tree() {
    let limits = UniquenessLimits { nodes: 200, exact: 0, ..UniquenessLimits::default() };
    // sigma_max < 1, though the spectral radius of |B| is above it.
    let b = random_matrix(100, 7) * 0.3 * (3.0 / 100.0_f64).sqrt();
    assert!(b.abs().complex_eigenvalues().iter().any(|value| value.norm() > 1.5));
    assert_eq!(uniqueness(&equation(&b), &limits), Uniqueness::Unique { sign: 1 });
    // Spectral radius of |B| below 1, though sigma_max is far above.
    let mut b = DMatrix::zeros(40, 40);
    (0..39).for_each(|k| b[(k, k + 1)] = 30.0);
    assert_eq!(uniqueness(&equation(&b), &limits), Uniqueness::Unique { sign: 1 });
}

#[test]
fn limits_are_kept() -> Result<(), Box<dyn Error>> {
    // Unique, but neither proof applies: a large cycle of contacts.
    let mut m = DMatrix::identity(5, 5);
    (0..5).for_each(|k| m[(k, (k + 1) % 5)] = 1.9);
    let problem = complementarity(&m);
    assert_eq!(decide(&problem), Uniqueness::Unique { sign: -1 });
    let limits = UniquenessLimits { nodes: 10, exact: 10, contacts: 5 };
    assert_eq!(uniqueness(&problem, &limits), Uniqueness::NotComputed(Unfinished::Nodes(10)));
    let limits = UniquenessLimits { contacts: 4, ..limits };
    assert_eq!(uniqueness(&problem, &limits), Uniqueness::NotComputed(Unfinished::Contacts(4)));
    let mut calls = 0;
    let cancelled = uniqueness_with(&problem, &UniquenessLimits::default(), &mut |progress| {
        calls += 1;
        assert_eq!(progress.done, calls);
        if calls == 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!((cancelled, calls), (Uniqueness::NotComputed(Unfinished::Cancelled), 7));
    // A determinant that is zero but for rounding, without exact arithmetic.
    let m = dmatrix![0.1, 0.3; 0.7, 2.1];
    let limits = UniquenessLimits { nodes: 100, exact: 0, contacts: 2 };
    let problem = complementarity(&m);
    let pattern = vec![Side::Positive; 2];
    assert_eq!(uniqueness(&problem, &limits), Uniqueness::InDoubt { pattern: pattern.clone() });
    // 0.1 * 2.1 - 0.3 * 0.7 of these doubles, by their exact fractions, is positive or negative: not zero.
    #[expect(clippy::cast_possible_truncation, reason = "these are integers below 2^62")]
    let exact = |value: f64| (value * 2.0_f64.powi(60)) as i128;
    let difference = (exact(0.1) * exact(2.1)).cmp(&(exact(0.3) * exact(0.7)));
    match decide(&problem) {
        Uniqueness::Unique { sign: 1 } => assert_eq!(difference, std::cmp::Ordering::Greater),
        Uniqueness::NotUnique { negative, .. } => {
            assert_eq!(difference, std::cmp::Ordering::Less);
            assert_eq!(negative, pattern);
        }
        other => return Err(format!("{other:?}").into()),
    }
    Ok(())
}

/// `D` is 2^53 and 2^-1022 or its opposite; the ratio of the two columns is below the range of floating
/// point. `p` of the negative side is `-D`.
#[test]
fn a_column_that_scaling_loses_is_decided_exactly() {
    let (one, none) = (dmatrix![9_007_199_254_740_992.0], DMatrix::zeros(1, 1));
    for (tiny, unique) in [(f64::MIN_POSITIVE, false), (-f64::MIN_POSITIVE, true)] {
        let columns = (one.clone(), dmatrix![tiny]);
        let problem = ModeProblem::new(columns.0, columns.1, none.clone(), none.clone(), dvector![3.0]);
        let answer = uniqueness(&problem.expect("shapes fit"), &UniquenessLimits::default());
        let [positive, negative] = Side::BOTH.map(|side| vec![side]);
        let expected = if unique {
            Uniqueness::Unique { sign: 1 }
        } else {
            Uniqueness::NotUnique { positive, negative }
        };
        assert_eq!(answer, expected);
    }
}

/// `D(++) = D(-+) = 1e-20` and `D(+-) = D(--) = -1e-20`, which rounding `1 + 1e-20` makes zero.
#[test]
fn sums_are_not_rounded() -> Result<(), Box<dyn Error>> {
    let (a, b) = (dmatrix![1.0, 1.0; 1.0, 1.0], dmatrix![1e-20, 0.0; 0.0, 0.0]);
    let problem = ModeProblem::from_absolute_value_equation(&a, &b, dvector![1.0, 1.0])?;
    let (positive, negative) = (vec![Side::Positive; 2], vec![Side::Negative, Side::Positive]);
    assert_eq!(decide(&problem), Uniqueness::NotUnique { positive, negative });
    Ok(())
}
