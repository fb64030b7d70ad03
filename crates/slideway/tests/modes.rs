//! The mode problem against brute force and known answers.

use std::error::Error;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;
use slideway::modes::{
    ContactState, EnumerationError, Limits, ModeProblem, ModeProblemError, ProblemPart, Side, SolutionSet,
    Solutions, enumerate,
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
        assert_eq!(solution.oriented_determinant, solution.determinant * product);
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

fn complementarity(m: &DMatrix<f64>, q: DVector<f64>) -> Solutions {
    solve(&ModeProblem::from_linear_complementarity(m, q).expect("finite numbers"))
}

#[test]
fn unloaded_identity_has_one_solution_from_all_patterns() {
    let found = complementarity(&DMatrix::identity(3, 3), DVector::zeros(3));
    assert_eq!(found.solutions.len(), 1);
    let solution = &found.solutions[0];
    assert_eq!(solution.pattern_count, 8);
    assert_eq!(solution.on_boundary, [0, 1, 2]);
    assert_eq!(solution.signs, [0, 0, 0]);
    assert_eq!(found.counts.boundary, 8);
    assert!(found.singular.is_empty());
}

#[test]
fn listed_patterns_are_limited_but_counted() -> Result<(), Box<dyn Error>> {
    let problem = ModeProblem::from_linear_complementarity(&DMatrix::identity(3, 3), DVector::zeros(3))?;
    let found = enumerate(&problem, &Limits { listed: 3, ..Limits::default() })?;
    assert_eq!(found.solutions[0].patterns.len(), 3);
    assert_eq!(found.solutions[0].pattern_count, 8);
    Ok(())
}

#[test]
fn negative_identity_has_all_solutions() {
    let found = complementarity(&-DMatrix::identity(3, 3), DVector::repeat(3, 1.0));
    assert_eq!(found.solutions.len(), 8);
    assert_eq!(found.counts.solution, 8);
    assert!(found.solutions.is_sorted_by_key(|solution| solution.pattern.clone()));
    assert!(found.closest.is_empty());
}

#[test]
fn ray_starts_at_the_boundary_solution() {
    let found = complementarity(&dmatrix![1.0, -1.0; -1.0, 1.0], dvector![-1.0, 1.0]);
    assert_eq!(found.counts.singular_continuum, 1);
    assert_eq!(found.singular.len(), 1);
    let SolutionSet::Ray { from, direction } = &found.singular[0].set else {
        panic!("not a ray: {:?}", found.singular[0].set);
    };
    assert_close(from, &dvector![1.0, 0.0], 1e-12);
    assert_close(direction, &dvector![1.0, 1.0], 1e-12);
    assert_eq!(found.solutions.len(), 1);
    assert_eq!(found.singular[0].contains, [0]);
    assert_close(&found.solutions[0].normal_force, from, 1e-12);
    assert!(found.singular[0].set.is_continuum());
}

#[test]
fn segment_between_two_boundary_solutions() {
    // w = z1 + z2 - 1 in both rows: z1 + z2 = 1.
    let found = complementarity(&dmatrix![1.0, 1.0; 1.0, 1.0], dvector![-1.0, -1.0]);
    assert_eq!(found.singular.len(), 1);
    assert!(matches!(found.singular[0].set, SolutionSet::Segment { .. }));
    assert_eq!(found.singular[0].set.vertices().len(), 2);
    assert!(found.singular[0].set.directions().is_empty());
    assert_eq!(found.solutions.len(), 2);
    assert_eq!(found.singular[0].contains, [0, 1]);
}

#[test]
fn locking_is_an_empty_set() {
    // As above, but the two rows contradict each other.
    let found = complementarity(&dmatrix![1.0, 1.0; 1.0, 1.0], dvector![-1.0, -2.0]);
    assert_eq!(found.counts.singular_empty, 1);
    assert_eq!(found.singular[0].set, SolutionSet::Empty);
    assert_eq!(found.solutions.len(), 1);
    // Consistent, but z1 + z2 = -1 has no z >= 0.
    let found = complementarity(&dmatrix![1.0, 1.0; 1.0, 1.0], dvector![1.0, 1.0]);
    assert_eq!(found.counts.singular_empty, 1);
    assert_eq!(found.solutions.len(), 1);
}

#[test]
fn single_point_of_a_singular_pattern() {
    // z1 + z2 = 0 twice: only z = 0, which the other patterns give as well.
    let found = complementarity(&dmatrix![1.0, 1.0; 1.0, 1.0], dvector![0.0, 0.0]);
    assert_eq!(found.counts.singular_point, 1);
    assert!(matches!(found.singular[0].set, SolutionSet::Point(_)));
    assert_eq!(found.singular[0].contains, [0]);
    assert_eq!(found.solutions.len(), 1);
    assert_eq!(found.counts.boundary, 3);
}

#[test]
fn polytopes_of_higher_dimension() {
    // z1 + z2 + z3 = 1 in three equal rows: a triangle.
    let found = complementarity(&DMatrix::repeat(3, 3, 1.0), DVector::repeat(3, -1.0));
    let SolutionSet::Polytope { vertices, directions } = &found.singular[0].set else {
        panic!("not a polytope: {:?}", found.singular[0].set);
    };
    assert_eq!((vertices.len(), directions.len()), (3, 0));
    // Its edges belong to the patterns with two columns.
    assert_eq!(found.counts.singular_continuum, 4);
    assert_eq!(found.singular.len(), 4);
    // M = 0, q = 0: every z >= 0 is a solution; with w >= 0 as well, the rest is in these sets.
    let found = complementarity(&DMatrix::zeros(2, 2), DVector::zeros(2));
    let SolutionSet::Polytope { vertices, directions } = &found.singular[0].set else {
        panic!("not a cone: {:?}", found.singular[0].set);
    };
    assert_eq!((vertices.len(), directions.len()), (1, 2));
    assert_eq!(found.counts.singular_continuum, 3);
    assert_eq!(found.counts.boundary, 1);
}

#[test]
fn equal_sets_are_reported_once() {
    // z1 + z2 = 1 in two rows, and y3 = 0 on either side of the third contact.
    let m = dmatrix![1.0, 1.0, 0.0; 1.0, 1.0, 0.0; 0.0, 0.0, 1.0];
    let found = complementarity(&m, dvector![-1.0, -1.0, 0.0]);
    assert_eq!(found.counts.singular_continuum, 2);
    assert_eq!(found.singular.len(), 1);
    assert_eq!(found.singular[0].pattern_count, 2);
    assert_eq!(found.singular[0].patterns.len(), 2);
}

#[test]
fn zero_columns_are_counted_beyond_the_limit() -> Result<(), Box<dyn Error>> {
    let none = DMatrix::zeros(4, 4);
    let load = DVector::repeat(4, 1.0);
    let problem = ModeProblem::new(none.clone(), none.clone(), none.clone(), none, load)?;
    let found = enumerate(&problem, &Limits { singular: 5, ..Limits::default() })?;
    assert_eq!(found.counts.singular_empty, 5);
    assert_eq!(found.counts.not_examined, 11);
    assert_eq!(found.singular.len(), 5);
    assert!(!found.is_complete());
    assert!(!found.is_jammed());
    assert!(solve(&problem).is_jammed());
    Ok(())
}

#[test]
fn polytopes_beyond_the_work_limit_are_not_computed() -> Result<(), Box<dyn Error>> {
    let problem =
        ModeProblem::from_linear_complementarity(&DMatrix::repeat(3, 3, 1.0), DVector::repeat(3, -1.0))?;
    let found = enumerate(&problem, &Limits { bases: 5, ..Limits::default() })?;
    assert_eq!(found.singular[0].set, SolutionSet::NotComputed);
    assert!(found.counts.not_examined > 0);
    assert_eq!(found.counts.total(), 8);
    Ok(())
}

#[test]
fn nearly_dependent_columns_are_regular() {
    // det = 1e-9 only: suspect for the tree, regular for complete pivoting.
    let found = complementarity(&dmatrix![1.0, 1.0; 1.0, 1.000_000_001], dvector![-2.0, -2.000_000_001]);
    assert!(found.singular.is_empty());
    assert_eq!(found.counts.solution, 1);
    let solution = &found.solutions[0];
    assert!((solution.normal_force[1] - 1.0).abs() < 1e-6);
}

#[test]
fn a_jump_keeps_boundary_solutions_apart() -> Result<(), Box<dyn Error>> {
    // y = 0 + 0 on the positive side, -y = 0 + 1 on the negative side.
    let problem =
        ModeProblem::new(dmatrix![1.0], dmatrix![-1.0], dmatrix![0.0], dmatrix![1.0], dvector![0.0])?;
    assert!(problem.has_jump(0));
    let found = solve(&problem);
    assert_eq!(found.solutions.len(), 1);
    assert_eq!(found.solutions[0].pattern, [Side::Positive]);
    assert_eq!(found.solutions[0].on_boundary, [0]);
    // The gap state with lambda = 1 is this solution.
    assert!(found.gaps.is_empty());
    assert_eq!(found.gap_counts.boundary, 1);
    Ok(())
}

#[test]
fn both_faces_may_have_their_own_boundary_solution() -> Result<(), Box<dyn Error>> {
    // Two contacts; the second one has N = 0 on both sides, the first one differs by the jump.
    let columns = |sign: f64| dmatrix![1.0, 0.0; 0.0, sign];
    let jumps = |size: f64| dmatrix![0.0, size; 0.0, 0.0];
    let first_negative = dmatrix![-1.0, 0.0; 0.0, -1.0];
    let problem = ModeProblem::new(columns(1.0), first_negative, jumps(1.0), jumps(2.0), dvector![1.0, 0.0])?;
    let found = solve(&problem);
    let forces: Vec<f64> = found.solutions.iter().map(|solution| solution.normal_force[0]).collect();
    assert_eq!(forces, [2.0, 3.0]);
    assert!(found.solutions.iter().all(|solution| solution.pattern_count == 1));
    // Between them the gap column has no component in the second row: a segment of states.
    assert_eq!(found.gap_counts.singular_continuum, 1);
    let segment = found.singular.iter().find(|mode| mode.set.is_continuum()).ok_or("no segment")?;
    assert_eq!(segment.contains, [0, 1]);
    assert_eq!(segment.pattern, [ContactState::Positive, ContactState::Gap]);
    Ok(())
}

#[test]
fn gap_share_is_where_the_friction_balances() -> Result<(), Box<dyn Error>> {
    // y = 1 - 2 and -y = 1 + 6: no pattern; 0 = 1 - 2 lambda + 6 (1 - lambda) at lambda = 7/8.
    let problem =
        ModeProblem::new(dmatrix![1.0], dmatrix![-1.0], dmatrix![-2.0], dmatrix![6.0], dvector![1.0])?;
    let found = solve(&problem);
    assert!(found.solutions.is_empty());
    assert_eq!(found.gaps.len(), 1);
    assert!((found.gaps[0].shares[0].lambda - 0.875).abs() < 1e-15);
    assert_eq!(found.gaps[0].signs, [0]);
    assert_eq!(found.gaps[0].determinant, 8.0);
    Ok(())
}

#[test]
fn gap_states_merge_on_the_boundary_of_others() -> Result<(), Box<dyn Error>> {
    // The gap of above beside a contact with N = 0.
    let problem = ModeProblem::new(
        DMatrix::identity(2, 2),
        -DMatrix::identity(2, 2),
        dmatrix![-2.0, 0.0; 0.0, 0.0],
        dmatrix![6.0, 0.0; 0.0, 0.0],
        dvector![1.0, 0.0],
    )?;
    let found = solve(&problem);
    assert_eq!(found.gaps.len(), 1);
    assert_eq!(found.gaps[0].pattern_count, 2);
    assert_eq!(found.gaps[0].on_boundary, [1]);
    assert_eq!(found.gap_counts.boundary, 2);
    Ok(())
}

#[test]
fn rounding_does_not_make_a_jump() -> Result<(), Box<dyn Error>> {
    let d = 0.3;
    let problem = ModeProblem::new(
        dmatrix![1.0],
        dmatrix![-1.0],
        dmatrix![d],
        dmatrix![d + f64::EPSILON],
        dvector![1.0],
    )?;
    assert!(!problem.has_jump(0));
    assert_eq!(solve(&problem).gap_counts.total(), 0);
    Ok(())
}

#[test]
fn almost_zero_counts_as_boundary_only_within_rounding() {
    for (load, boundary) in [(1e-13, true), (-1e-13, true), (1e-10, false), (-1e-10, false)] {
        let found = complementarity(&DMatrix::identity(2, 2), dvector![-1.0, load]);
        assert_eq!(found.solutions.len(), 1, "{load}");
        assert_eq!(found.solutions[0].on_boundary.is_empty(), !boundary, "{load}");
        assert_eq!(found.solutions[0].pattern_count, if boundary { 2 } else { 1 });
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
