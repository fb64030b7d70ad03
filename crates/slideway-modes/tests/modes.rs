//! The mode problem against brute force, its symmetries and its limits.

use std::error::Error;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;
use slideway_modes::{
    BySide, ContactState, EnumerationError, InfluenceCoefficients, Limits, ModeProblem, ModeProblemError,
    ProblemPart, Side, Solutions, enumerate,
};

const STATES: [ContactState; 3] = [ContactState::Positive, ContactState::Negative, ContactState::Gap];

/// Normal forces and determinant of every pattern of the given states that is a solution, each
/// from a factorization of its own.
fn brute_force(
    problem: &ModeProblem,
    states: &[ContactState],
) -> Vec<(Vec<ContactState>, DVector<f64>, f64)> {
    let contacts = problem.contacts();
    let mut solutions = Vec::new();
    for number in 0..states.len().pow(u32::try_from(contacts).expect("few contacts")) {
        let mut rest = number;
        let mut pattern = vec![ContactState::Positive; contacts];
        for state in pattern.iter_mut().rev() {
            *state = states[rest % states.len()];
            rest /= states.len();
        }
        let mut matrix = DMatrix::zeros(contacts, contacts);
        let mut right_hand_side = problem.right_hand_side().clone();
        for (k, state) in pattern.iter().enumerate() {
            let jump = |side| problem.jumps(side).column(k);
            if let Some(side) = state.side() {
                matrix.set_column(k, &problem.columns(side).column(k));
                right_hand_side += jump(side);
            } else {
                matrix.set_column(k, &(jump(Side::Negative) - jump(Side::Positive)));
                right_hand_side += jump(Side::Negative);
            }
        }
        let determinant = matrix.determinant();
        let Some(unknowns) = matrix.full_piv_lu().solve(&right_hand_side) else { continue };
        let admissible = |(unknown, state): (&f64, &ContactState)| {
            *unknown >= 0.0 && (*state != ContactState::Gap || *unknown <= 1.0)
        };
        if unknowns.iter().zip(&pattern).all(admissible) {
            let normal_force = DVector::from_fn(contacts, |k, _| pattern[k].sign() * unknowns[k]);
            solutions.push((pattern, normal_force, determinant));
        }
    }
    solutions
}

fn assert_close(one: &DVector<f64>, other: &DVector<f64>, tolerance: f64) {
    assert!((one - other).amax() <= tolerance * other.amax(), "{one} is not {other}");
}

fn solve(problem: &ModeProblem) -> Solutions {
    let solutions = enumerate(problem, &Limits::default()).expect("a small problem");
    let contacts = u32::try_from(problem.contacts()).expect("few contacts");
    let with_jump = (0..problem.contacts()).filter(|&k| problem.has_jump(k)).count();
    let all = 3_u64.pow(u32::try_from(with_jump).expect("few")) << (problem.contacts() - with_jump);
    assert_eq!(solutions.counts.total(), 2_u64.pow(contacts));
    assert_eq!(solutions.counts.total() + solutions.gap_counts.total(), all);
    solutions
}

fn assert_same_as_brute_force(problem: &ModeProblem) {
    let found = solve(problem);
    let expected = brute_force(problem, &STATES[..2]);
    assert_eq!(found.solutions.len(), expected.len());
    assert_eq!(found.counts.solution, expected.len() as u64);
    assert_eq!(found.counts.no_solution, found.counts.total() - expected.len() as u64);
    for (solution, (pattern, normal_force, determinant)) in found.solutions.iter().zip(&expected) {
        let states: Vec<ContactState> = solution.pattern.iter().map(|&side| side.into()).collect();
        assert_eq!(&states, pattern);
        assert_close(&solution.normal_force, normal_force, 1e-6);
        assert!((solution.determinant - determinant).abs() <= 1e-8 * determinant.abs() + 1e-13);
        let product: f64 = pattern.iter().map(|state| state.sign()).product();
        assert_eq!(solution.oriented_determinant(), solution.determinant * product);
        assert_eq!(solution.pattern_count, 1);
        assert!(
            solution.signs.iter().zip(&solution.normal_force).all(|(&sign, n)| f64::from(sign) == n.signum())
        );
    }
    if (0..problem.contacts()).all(|k| problem.has_jump(k)) {
        let mut expected = brute_force(problem, &STATES);
        expected.retain(|(pattern, ..)| pattern.contains(&ContactState::Gap));
        assert_eq!(found.gaps.len(), expected.len());
        for (gap, (pattern, normal_force, determinant)) in found.gaps.iter().zip(&expected) {
            assert_eq!(&gap.pattern, pattern);
            assert_close(&gap.normal_force, normal_force, 1e-6);
            assert!((gap.determinant - determinant).abs() <= 1e-8 * determinant.abs() + 1e-13);
        }
    } else {
        assert!(found.gaps.is_empty());
    }
}

fn matrices(contacts: usize, count: usize) -> impl Strategy<Value = Vec<DMatrix<f64>>> {
    let entries = proptest::collection::vec(-1.0..1.0, contacts * contacts);
    let matrix = entries.prop_map(move |entries| DMatrix::from_vec(contacts, contacts, entries));
    proptest::collection::vec(matrix, count)
}

/// Random columns near `sigma e_k` or far from it, both versions different; jumps on request.
fn problems(
    contacts: std::ops::RangeInclusive<usize>,
    with_jumps: bool,
) -> impl Strategy<Value = ModeProblem> {
    let data = contacts.prop_flat_map(|contacts| (matrices(contacts, 5), 0.0..2.0_f64));
    data.prop_map(move |(parts, weight)| {
        let contacts = parts[0].nrows();
        let identity = DMatrix::identity(contacts, contacts) * weight;
        let jumps = if with_jumps { 1.0 } else { 0.0 };
        let right_hand_side = parts[4].column(0).into_owned();
        let (positive, negative) = (&parts[0] + &identity, &parts[1] - &identity);
        ModeProblem::new(positive, negative, &parts[2] * jumps, &parts[3] * jumps, right_hand_side)
            .expect("finite numbers")
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn few_contacts_agree_with_brute_force(problem in problems(1..=4, false)) {
        assert_same_as_brute_force(&problem);
    }

    #[test]
    fn few_contacts_with_jumps_agree_with_brute_force(problem in problems(1..=3, true)) {
        assert_same_as_brute_force(&problem);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(40) })]

    #[test]
    fn many_contacts_agree_with_brute_force(problem in problems(5..=8, false)) {
        assert_same_as_brute_force(&problem);
    }

    #[test]
    fn many_contacts_with_jumps_agree_with_brute_force(problem in problems(4..=5, true)) {
        assert_same_as_brute_force(&problem);
    }

    #[test]
    fn units_of_load_change_nothing(problem in problems(1..=4, true), exponent in -12..=12) {
        let factor = 10.0_f64.powi(exponent);
        let other = ModeProblem::new(
            problem.columns(Side::Positive).clone(),
            problem.columns(Side::Negative).clone(),
            problem.jumps(Side::Positive) * factor,
            problem.jumps(Side::Negative) * factor,
            problem.right_hand_side() * factor,
        ).expect("finite numbers");
        let (one, other) = (solve(&problem), solve(&other));
        prop_assert_eq!(one.counts, other.counts);
        prop_assert_eq!(one.gap_counts, other.gap_counts);
        for (one, other) in one.gaps.iter().zip(&other.gaps) {
            prop_assert!((one.shares[0].lambda - other.shares[0].lambda).abs() < 1e-9);
        }
        for (one, other) in one.solutions.iter().zip(&other.solutions) {
            assert_close(&(&one.normal_force * factor), &other.normal_force, 1e-9);
        }
    }

    #[test]
    fn scaled_rows_change_only_determinants(problem in problems(2..=4, true), exponent in -9..=9) {
        let factor = 10.0_f64.powi(exponent);
        let scale = |mut matrix: DMatrix<f64>| { matrix.row_mut(0).scale_mut(factor); matrix };
        let mut right_hand_side = problem.right_hand_side().clone();
        right_hand_side[0] *= factor;
        let [positive, negative] = Side::BOTH.map(|side| scale(problem.columns(side).clone()));
        let [jumps_positive, jumps_negative] = Side::BOTH.map(|side| scale(problem.jumps(side).clone()));
        let other = ModeProblem::new(positive, negative, jumps_positive, jumps_negative, right_hand_side)
            .expect("finite numbers");
        let (one, other) = (solve(&problem), solve(&other));
        prop_assert_eq!(one.counts, other.counts);
        prop_assert_eq!(one.gap_counts, other.gap_counts);
        for (one, other) in one.solutions.iter().zip(&other.solutions) {
            assert_close(&one.normal_force, &other.normal_force, 1e-7);
            let relative = other.determinant / (one.determinant * factor);
            prop_assert!((relative - 1.0).abs() < 1e-7);
        }
    }

    #[test]
    fn numbering_does_not_matter(problem in problems(2..=5, false)) {
        let contacts = problem.contacts();
        let reversed = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(contacts, contacts, |row, column| matrix[(contacts - 1 - row, contacts - 1 - column)])
        };
        let [positive, negative] = Side::BOTH.map(|side| reversed(problem.columns(side)));
        let none = DMatrix::zeros(contacts, contacts);
        let load = problem.right_hand_side();
        let load = DVector::from_fn(contacts, |row, _| load[contacts - 1 - row]);
        let other = ModeProblem::new(positive, negative, none.clone(), none, load).expect("finite numbers");
        let (one, other) = (solve(&problem), solve(&other));
        prop_assert_eq!(one.solutions.len(), other.solutions.len());
        for solution in &one.solutions {
            let pattern: Vec<Side> = solution.pattern.iter().rev().copied().collect();
            let twin = other.solutions.iter().find(|other| other.pattern == pattern);
            let twin = twin.expect("the same pattern, reversed");
            let turned = DVector::from_fn(contacts, |row, _| twin.normal_force[contacts - 1 - row]);
            assert_close(&solution.normal_force, &turned, 1e-8);
            prop_assert!((twin.determinant - solution.determinant).abs() <= 1e-9 * solution.determinant.abs() + 1e-13);
        }
    }

    #[test]
    fn planted_solution_is_found(
        parts in matrices(6, 2),
        signs in proptest::collection::vec(prop::bool::ANY, 6),
    ) {
        // A x + B |x| = b with a chosen x.
        let x = DVector::from_fn(6, |k, _| {
            let size = 0.1 + parts[1][(k, 0)].abs();
            if signs[k] { size } else { -size }
        });
        let load = &parts[0] * &x + &parts[1] * x.abs();
        let problem = ModeProblem::from_absolute_value_equation(&parts[0], &parts[1], load).expect("finite numbers");
        let found = solve(&problem);
        prop_assert!(found.solutions.iter().any(|solution| (&solution.normal_force - &x).amax() < 1e-6));
        for solution in &found.solutions {
            let n = &solution.normal_force;
            let residual = (&parts[0] * n + &parts[1] * n.abs() - problem.right_hand_side()).amax();
            prop_assert!(residual <= 1e-14 * n.amax().max(1.0) * 6.0);
        }
    }
}

#[test]
fn no_contacts_have_one_trivial_solution() -> Result<(), Box<dyn Error>> {
    let none = DMatrix::zeros(0, 0);
    let problem = ModeProblem::new(none.clone(), none.clone(), none.clone(), none, DVector::zeros(0))?;
    let found = solve(&problem);
    assert_eq!(found.solutions.len(), 1);
    assert_eq!(found.counts.solution, 1);
    assert_eq!(found.solutions[0].determinant, 1.0);
    assert!(found.solutions[0].pattern.is_empty());
    Ok(())
}

#[test]
fn limits_are_errors_with_their_values() -> Result<(), Box<dyn Error>> {
    let minus = ModeProblem::from_linear_complementarity(&-DMatrix::identity(3, 3), DVector::repeat(3, 1.0))?;
    let few = Limits { contacts: 2, ..Limits::default() };
    assert_eq!(enumerate(&minus, &few), Err(EnumerationError::TooManyContacts { contacts: 3, limit: 2 }));
    let few = Limits { solutions: 7, ..Limits::default() };
    assert_eq!(enumerate(&minus, &few), Err(EnumerationError::TooManySolutions { limit: 7 }));
    assert!(enumerate(&minus, &Limits { solutions: 8, contacts: 3, patterns: 8, ..few }).is_ok());
    let jumps = DMatrix::identity(3, 3);
    let jumping = ModeProblem::new(jumps.clone(), -&jumps, jumps.clone(), -&jumps, DVector::zeros(3))?;
    let few = Limits { patterns: 26, ..Limits::default() };
    let expected = EnumerationError::TooManyPatterns { contacts: 3, with_jump: 3, patterns: 27, limit: 26 };
    assert_eq!(enumerate(&jumping, &few), Err(expected));
    Ok(())
}

#[test]
fn faulty_data_are_named() {
    let good = DMatrix::<f64>::identity(2, 2);
    let mut bad = good.clone();
    bad[(1, 0)] = f64::NAN;
    let wide = DMatrix::<f64>::zeros(2, 3);
    let load = dvector![1.0, 2.0];
    let error = ModeProblem::new(good.clone(), wide, good.clone(), good.clone(), load.clone());
    let part = ProblemPart::Columns(Side::Negative);
    assert_eq!(error, Err(ModeProblemError::Shape { part, expected: (2, 2), found: (2, 3) }));
    let error = ModeProblem::new(good.clone(), good.clone(), bad, good.clone(), load);
    let Err(
        error @ ModeProblemError::NotFinite {
            part: ProblemPart::Jumps(Side::Positive),
            row: 1,
            column: 0,
            ..
        },
    ) = error
    else {
        panic!("unexpected: {error:?}");
    };
    assert_eq!(
        error.to_string(),
        "jumps of the positive side: entry in row 1, column 0 (counted from 0) is NaN"
    );
    let error =
        ModeProblem::new(good.clone(), good.clone(), good.clone(), good, dvector![1.0, f64::INFINITY]);
    assert!(matches!(
        error,
        Err(ModeProblemError::NotFinite { part: ProblemPart::RightHandSide, row: 1, .. })
    ));
}

#[test]
fn faulty_influence_coefficients_are_named() -> Result<(), Box<dyn Error>> {
    let eta = BySide::same(dmatrix![0.1, 0.2; 0.3, 0.4]);
    let good = InfluenceCoefficients {
        eta_preload: eta.clone(),
        eta,
        mu: BySide::same(dvector![0.1, 0.2]),
        preload: BySide { positive: dvector![1.0, 0.0], negative: dvector![2.0, 0.0] },
        velocity_signs: dvector![1.0, -1.0],
        frictionless: dvector![1.0, 2.0],
        shared: None,
        one_sided: vec![],
        turning: vec![],
    };
    let problem = ModeProblem::from_influence(&good)?;
    assert_close(&problem.columns(Side::Negative).column(1).into_owned(), &dvector![0.04, -0.92], 1e-15);
    assert_close(&problem.jumps(Side::Negative).column(0).into_owned(), &dvector![0.2, 0.6], 1e-15);
    assert!(problem.has_jump(0) && !problem.has_jump(1));

    let bad = InfluenceCoefficients { velocity_signs: dvector![1.0, 0.5], ..good.clone() };
    let expected = ModeProblemError::VelocitySign { contact: 1, value: 0.5 };
    assert_eq!(ModeProblem::from_influence(&bad), Err(expected));
    let resting = InfluenceCoefficients { velocity_signs: dvector![0.0, 0.0], ..good.clone() };
    assert_eq!(ModeProblem::from_influence(&resting)?.columns(Side::Positive), &DMatrix::identity(2, 2));
    let bad = InfluenceCoefficients { mu: BySide::same(dvector![0.1]), ..good };
    let part = ProblemPart::Friction(Side::Positive);
    let expected = ModeProblemError::Shape { part, expected: (2, 1), found: (1, 1) };
    assert_eq!(ModeProblem::from_influence(&bad), Err(expected));
    Ok(())
}
