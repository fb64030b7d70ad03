//! One problem for each argument of the pruned search that loses solutions if the argument is wrong,
//! and what the search says of its own work.

use crate::search_support::{self, Random, run, switches};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::certificate::proves_empty;
use slideway_modes::{
    Arguments, Certificate, Completeness, ContactState, ExclusionArgument, Method, ModeProblem,
    ModeProblemError, SearchOptions,
};

type Outcome = Result<(), ModeProblemError>;

fn counts(problem: &ModeProblem, options: &SearchOptions) -> (Option<u64>, Option<u64>) {
    let counts = run(problem, options).counts();
    (counts.solutions.to_u64(), counts.gap_states.to_u64())
}

/// `count` copies of a problem of one contact.
fn copies(count: usize, columns: [f64; 2], jumps: [f64; 2], load: f64) -> ModeProblem {
    let diagonal = |value: f64| DMatrix::from_diagonal_element(count, count, value);
    let [positive, negative] = columns.map(diagonal);
    let [up, down] = jumps.map(diagonal);
    ModeProblem::new(positive, negative, up, down, DVector::from_element(count, load)).expect("shapes fit")
}

#[test]
fn both_versions_of_a_column_bound_the_coupling() {
    // The positive version alone looks like a contraction with one solution.
    let problem = copies(3, [0.9, 1.0], [0.0, 0.0], 1.0);
    let mirrored = copies(3, [-1.0, -0.9], [0.0, 0.0], -1.0);
    for options in switches() {
        assert_eq!(counts(&problem, &options), (Some(8), Some(0)));
        assert_eq!(counts(&mirrored, &options), (Some(8), Some(0)));
    }
}

#[test]
fn either_version_may_be_the_steep_one() -> Outcome {
    // Contact 1 changes its side with the force of contact 0, which only one version brings about.
    for (up, down, load) in [(0.0, -3.0, -1.0), (-3.0, 0.0, 1.0)] {
        let positive = dmatrix![1.0, 0.0; up, 1.0];
        let negative = dmatrix![-1.0, 0.0; down, -1.0];
        let none = DMatrix::zeros(2, 2);
        let problem = ModeProblem::new(positive, negative, none.clone(), none, dvector![load, -1.0])?;
        for options in switches() {
            let result = run(&problem, &options);
            let states: Vec<_> = result.product.states().collect();
            assert_eq!(states.len(), 1);
            let force = states[0].normal_force(2).expect("an isolated solution");
            assert!((force - dvector![load, 2.0]).amax() < 1e-12);
        }
    }
    Ok(())
}

#[test]
fn jumps_bring_solutions_on_both_sides() {
    // N = -1 + 2 lambda: -1, 1, and lambda = 1/2 between the faces.
    for options in switches() {
        assert_eq!(counts(&copies(1, [1.0, -1.0], [2.0, 0.0], -1.0), &options), (Some(2), Some(1)));
        assert_eq!(counts(&copies(1, [1.0, -1.0], [0.0, -2.0], 1.0), &options), (Some(2), Some(1)));
    }
}

#[test]
fn a_gap_may_hold_the_only_state() {
    // N = 1 - 2 lambda: neither 1 on the negative side nor -1 on the positive one.
    for options in switches() {
        assert_eq!(counts(&copies(1, [1.0, -1.0], [-2.0, 0.0], 1.0), &options), (Some(0), Some(1)));
        assert_eq!(counts(&copies(3, [1.0, -1.0], [-2.0, 0.0], 1.0), &options), (Some(0), Some(1)));
    }
}

#[test]
fn a_jump_downstream_keeps_groups_together() -> Outcome {
    // The jump of contact 0 acts on contact 1 alone, where its share decides.
    let columns = DMatrix::identity(2, 2);
    let jumps = dmatrix![0.0, 0.0; 2.0, 0.0];
    let problem =
        ModeProblem::new(columns.clone(), -columns, jumps, DMatrix::zeros(2, 2), dvector![0.0, -1.0])?;
    for options in switches() {
        search_support::assert_same_as_enumeration(&problem, &options, 0);
    }
    Ok(())
}

#[test]
fn solutions_far_along_a_ray_are_kept() -> Outcome {
    // The relaxation is unbounded; y is 1e6 and more.
    let m = dmatrix![0.0, 1e-6; -1e-6, 0.0];
    let problem = ModeProblem::from_linear_complementarity(&m, dvector![-1.0, 2.0])?;
    for options in switches() {
        search_support::assert_same_as_enumeration(&problem, &options, 0);
    }
    Ok(())
}

#[test]
fn singular_values_prove_one_solution() -> Outcome {
    let mut random = Random::new(5);
    let size = 40;
    let b = random.matrix(size, size) * (0.3 * (3.0 / size as f64).sqrt());
    let load = random.vector(size);
    let problem = ModeProblem::from_absolute_value_equation(&DMatrix::identity(size, size), &-b, load)?;
    let result = run(&problem, &SearchOptions::default());
    assert_eq!(result.groups[0].method, Method::Monotone { strictly: true });
    assert_eq!(result.completeness, Completeness::Proven);
    let arguments = Arguments { uniqueness: false, ..Arguments::default() };
    let other = run(&problem, &SearchOptions { arguments, ..SearchOptions::default() });
    assert_eq!(other.completeness, Completeness::Proven);
    let force = |result: &slideway_modes::SearchResult| {
        result.product.states().next().and_then(|state| state.normal_force(size)).expect("one solution")
    };
    assert!((force(&result) - force(&other)).amax() < 1e-12);
    Ok(())
}

#[test]
fn exclusions_carry_proofs_that_others_can_verify() -> Outcome {
    let mut random = Random::new(11);
    let arguments = Arguments {
        groups: false,
        propagation: false,
        uniqueness: false,
        low_rank: false,
        faces: false,
        every_pattern: false,
    };
    let options = SearchOptions { arguments, keep_exclusions: true, ..SearchOptions::default() };
    let mut verified = 0;
    for size in [4, 8, 12] {
        let problem =
            ModeProblem::from_linear_complementarity(&random.matrix(size, size), random.vector(size))?;
        let result = run(&problem, &options);
        assert_eq!(result.completeness, Completeness::Proven);
        for exclusion in &result.groups[0].exclusions {
            let ExclusionArgument::Farkas(farkas) = &exclusion.argument else { continue };
            let weights: Vec<f64> = farkas.iter().map(|entry| -entry).collect();
            let partial: Vec<Option<ContactState>> =
                exclusion.states.iter().map(|states| states.decided()).collect();
            assert!(proves_empty(&problem, &partial, &weights));
            verified += 1;
        }
    }
    assert!(verified > 20);
    Ok(())
}

/// Blocks of 10 contacts; with `chained`, the first of each acts on the first of the next.
fn blocks(count: usize, strength: f64, chained: bool) -> ModeProblem {
    let mut random = Random::new(17);
    let size = 10 * count;
    let mut columns = |sign: f64| {
        DMatrix::from_fn(size, size, |row, column| {
            let within = row / 10 == column / 10;
            let onward = chained && row % 10 == 0 && row / 10 == column / 10 + 1;
            let identity = if row == column { sign } else { 0.0 };
            identity + if within || onward { random.number() * strength } else { 0.0 }
        })
    };
    let (positive, negative) = (columns(1.0), columns(-1.0));
    let none = DMatrix::zeros(size, size);
    ModeProblem::new(positive, negative, none.clone(), none, random.vector(size)).expect("shapes fit")
}

#[test]
fn chained_groups_are_proven() {
    let result = run(&blocks(12, 0.12, true), &SearchOptions::default());
    assert_eq!(result.groups.len(), 12);
    assert_eq!(result.completeness, Completeness::Proven);
    let whole = Arguments { groups: false, ..Arguments::default() };
    let small = blocks(2, 0.25, true);
    let together = run(&small, &SearchOptions { arguments: whole, ..SearchOptions::default() });
    let apart = run(&small, &SearchOptions::default());
    assert_eq!(apart.counts(), together.counts());
    assert!(apart.groups.len() > together.groups.len());
}

#[test]
fn independent_groups_multiply_and_are_listed_on_demand() -> Outcome {
    let m = -DMatrix::identity(300, 300);
    let problem = ModeProblem::from_linear_complementarity(&m, DVector::from_element(300, 1.0))?;
    let result = run(&problem, &SearchOptions::default());
    let expected =
        "2037035976334486086268445688409378161051468393665936250636140449354381299763336706183397376";
    assert_eq!(result.counts().solutions.to_string(), expected);
    assert_eq!(result.completeness, Completeness::Proven);
    let listed: Vec<_> = result.product.states().take(1000).collect();
    assert_eq!(listed.len(), 1000);
    let force = listed[999].normal_force(300).expect("an isolated solution");
    assert!(force.iter().all(|force| force.abs() == 1.0));
    assert_ne!(listed[998], listed[999]);
    Ok(())
}

#[test]
fn the_strategy_is_told_in_words() {
    let result = run(&blocks(3, 0.12, true), &SearchOptions::default());
    assert!(result.strategy().contains("groups of up to 10 contacts"), "{}", result.strategy());
}

/// Contact 1 rests in its gap with the share 1/2, the others are unloaded: on the positive sides, `C` is regular; on the
/// negative ones, whose columns are equal, it is singular and admits `y_2 + y_3 = 0` only. It is one state, with bounds.
#[test]
fn a_state_of_a_regular_and_of_a_singular_pattern_is_listed_as_that_of_the_regular_one() {
    let positive = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 1.0];
    let negative = dmatrix![-1.0, 0.0, 0.0; 0.0, -1.0, -1.0; 0.0, -1.0, -1.0];
    let jump = dmatrix![1.0, 0.0, 0.0; 1.0, 0.0, 0.0; 0.0, 0.0, 0.0];
    let problem = ModeProblem::new(positive, negative, -&jump, jump, DVector::zeros(3)).expect("finite");
    for every_pattern in [true, false] {
        let arguments = Arguments { every_pattern, ..Arguments::default() };
        let options = SearchOptions { arguments, ..SearchOptions::default() };
        let result = run(&problem, &options);
        assert_eq!(result.completeness, Completeness::Proven);
        let lists = result.lists(10, 10);
        assert_eq!((lists.solutions.len(), lists.gaps.len(), lists.singular.len()), (0, 1, 0), "{lists:?}");
        assert_eq!((lists.gaps[0].shares[0].lambda, lists.gaps[0].y.amax()), (0.5, 0.0));
        assert!(matches!(lists.gaps[0].certificate, Certificate::Boundary { .. }));
    }
}

/// `M > 0` and `q >= 0`: only `z = 0`, since `w_k >= M_kk z_k`. The columns differ so little that linear programs in
/// floating point cannot tell what is positive.
#[test]
fn signs_of_equations_decide_nearly_dependent_columns() -> Outcome {
    for (size, spread) in [(30, 1e-6), (30, 1e-12), (60, 1e-6)] {
        let mut random = Random::new(30);
        let m = random.matrix(size, size).map(|value| 1.0 + spread * value);
        for q in [DVector::zeros(size), DVector::from_fn(size, |row, _| (row % 3) as f64)] {
            let problem = ModeProblem::from_linear_complementarity(&m, q.clone())?;
            let result = run(&problem, &SearchOptions::default());
            assert_eq!(result.completeness, Completeness::Proven);
            assert!(result.nodes() <= 2, "{}", result.nodes());
            let states: Vec<_> = result.product.states().collect();
            let [state] = states.as_slice() else { panic!("one solution") };
            assert_eq!(state.normal_force(size).expect("a point"), -q);
        }
    }
    Ok(())
}
