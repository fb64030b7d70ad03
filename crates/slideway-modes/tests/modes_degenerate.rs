//! Degenerate mode problems with known answers: boundaries, singular patterns, preload gaps.

use std::error::Error;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::{ContactState, Limits, ModeProblem, Side, SolutionSet, Solutions, enumerate};

fn solve(problem: &ModeProblem) -> Solutions {
    let solutions = enumerate(problem, &Limits::default()).expect("a small problem");
    assert_eq!(solutions.counts.total(), 1 << problem.contacts());
    solutions
}

fn assert_close(one: &DVector<f64>, other: &DVector<f64>, tolerance: f64) {
    assert!((one - other).amax() <= tolerance * other.amax(), "{one} is not {other}");
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
fn a_jump_is_any_difference() -> Result<(), Box<dyn Error>> {
    let jumps = |other: f64| {
        ModeProblem::new(dmatrix![1.0], dmatrix![-1.0], dmatrix![0.3], dmatrix![other], dvector![1.0])
    };
    assert!(!jumps(0.3)?.has_jump(0));
    assert_eq!(solve(&jumps(0.3)?).gap_counts.total(), 0);
    let smallest = jumps(0.3_f64.next_up())?;
    assert!(smallest.has_jump(0));
    assert_eq!(solve(&smallest).gap_counts.total(), 1);
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
fn neighbours_just_off_the_boundary_are_merged() -> Result<(), Box<dyn Error>> {
    // N_0 is 1.5e-15 on one side, which counts as zero, and -1.5e-12 on the other, which does not.
    let none = DMatrix::zeros(2, 2);
    let (positive, negative) = (dmatrix![1000.0, 0.0; 0.0, 1.0], dmatrix![1.0, 0.0; 0.0, -1.0]);
    let problem = ModeProblem::new(positive, negative, none.clone(), none, dvector![1.5e-12, 1.0])?;
    let found = solve(&problem);
    assert_eq!((found.counts.solution, found.counts.boundary), (1, 1));
    assert_eq!(found.solutions.len(), 1);
    assert_eq!(found.solutions[0].pattern_count, 2);
    assert_eq!(found.solutions[0].on_boundary, [0]);
    Ok(())
}

#[test]
fn complete_pivoting_decides_where_a_pattern_becomes_singular() {
    for (difference, singular) in [(1e-10, false), (1e-14, true)] {
        let m = dmatrix![1.0, 1.0; 1.0, 1.0 + difference];
        let found = complementarity(&m, dvector![-2.0, -2.0 - difference]);
        assert_eq!(!found.singular.is_empty(), singular, "{difference}");
    }
}

#[test]
fn each_orthant_is_a_set_of_its_own() {
    let found = complementarity(&DMatrix::zeros(8, 8), DVector::zeros(8));
    assert_eq!(found.counts.total(), 1 << 8);
    assert_eq!(found.counts.singular_continuum, (1 << 8) - 1);
    assert_eq!(found.counts.boundary, 1);
    assert_eq!(found.solutions.len(), 1);
}
