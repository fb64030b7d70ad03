//! The pruned search against the enumeration of all patterns, on random instances of many kinds.

use crate::search_support::{self, Random, assert_same_as_enumeration, run, switches};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::{
    Arguments, Completeness, Limits, ModeProblem, ModeProblemError, SearchOptions, StopReason, enumerate,
    search,
};
use std::ops::ControlFlow;

type Outcome = Result<(), ModeProblemError>;

/// Compares a number of random instances with 1 to `contacts` contacts, with all arguments and
/// with each of them switched off.
fn compare(count: usize, contacts: usize, problem: impl Fn(&mut Random, usize) -> ModeProblem) {
    for seed in 0..count {
        let mut random = Random::new(seed as u64);
        let size = 1 + random.below(contacts);
        let problem = problem(&mut random, size);
        let options = switches()[seed % switches().len()];
        assert_same_as_enumeration(&problem, &options, seed);
    }
}

#[test]
fn dense_absolute_value_equations() {
    compare(400, 8, |random, size| {
        let strength = [0.3, 1.0, 1.5, 3.0][random.below(4)] * (3.0 / size as f64).sqrt();
        let b = random.matrix(size, size) * strength;
        let x = random.vector(size);
        let load = &x - &b * x.abs();
        ModeProblem::from_absolute_value_equation(&DMatrix::identity(size, size), &-b, load)
            .expect("shapes fit")
    });
}

#[test]
fn linear_complementarity_problems() {
    compare(400, 8, |random, size| {
        let (m, q) = (random.matrix(size, size), random.vector(size));
        ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit")
    });
}

#[test]
fn two_versions_of_every_column() {
    compare(400, 8, |random, size| {
        let [positive, negative] = [1.0, -1.0].map(|sign| {
            DMatrix::identity(size, size) * sign + random.matrix(size, size) * (1.5 / (size as f64).sqrt())
        });
        let none = DMatrix::zeros(size, size);
        ModeProblem::new(positive, negative, none.clone(), none, random.vector(size)).expect("shapes fit")
    });
}

#[test]
fn jumps_with_gap_states() {
    compare(500, 5, |random, size| {
        let [positive, negative] = [1.0, -1.0].map(|sign| {
            DMatrix::identity(size, size) * sign + random.matrix(size, size) * (1.0 / (size as f64).sqrt())
        });
        let [up, down] = [0, 1].map(|_| random.some_columns(size));
        ModeProblem::new(positive, negative, up, down, random.vector(size)).expect("shapes fit")
    });
}

#[test]
fn sparse_and_block_triangular_problems() {
    compare(600, 8, |random, size| {
        let density = [0.1, 0.2, 0.3][random.below(3)];
        let [positive, negative] = [1.0, -1.0]
            .map(|sign| DMatrix::identity(size, size) * sign + random.sparse_matrix(size, density) * 1.5);
        let jumps =
            if random.below(3) == 0 { random.sparse_matrix(size, 0.05) } else { DMatrix::zeros(size, size) };
        let none = DMatrix::zeros(size, size);
        ModeProblem::new(positive, negative, jumps, none, random.vector(size)).expect("shapes fit")
    });
}

#[test]
fn degenerate_problems_of_small_integers() {
    compare(800, 5, |random, size| {
        let mut small = || DMatrix::from_fn(size, size, |_, _| random.integer(1));
        let (positive, negative) = (small(), small());
        let load = DVector::from_fn(size, |_, _| random.integer(1));
        let none = DMatrix::zeros(size, size);
        ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit")
    });
}

#[test]
fn degenerate_complementarity_problems_of_small_integers() {
    compare(800, 5, |random, size| {
        let m = DMatrix::from_fn(size, size, |_, _| random.integer(2));
        let q = DVector::from_fn(size, |_, _| random.integer(2));
        ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit")
    });
}

#[test]
fn degenerate_problems_with_jumps() {
    compare(500, 4, |random, size| {
        let mut small = |sign: f64| {
            DMatrix::from_fn(size, size, |row, column| {
                random.integer(1) * 0.5 + if row == column { sign } else { 0.0 }
            })
        };
        let (positive, negative) = (small(1.0), small(-1.0));
        let jumps = DMatrix::from_fn(size, size, |_, _| random.integer(1));
        let load = DVector::from_fn(size, |_, _| random.integer(2));
        ModeProblem::new(positive, negative, jumps.clone(), -jumps, load).expect("shapes fit")
    });
}

#[test]
fn coupling_of_low_rank() {
    for seed in 0..9 {
        let mut random = Random::new(seed);
        let (size, rank) = (13 + random.below(2), 1 + random.below(3));
        let problem = search_support::low_rank(&mut random, size, rank, 2.0);
        assert_same_as_enumeration(&problem, &SearchOptions::default(), 0);
    }
}

#[test]
fn negative_identity_has_all_solutions() -> Outcome {
    for contacts in [1, 5, 12] {
        let m = -DMatrix::identity(contacts, contacts);
        let problem = ModeProblem::from_linear_complementarity(&m, DVector::from_element(contacts, 1.0))?;
        for options in switches() {
            let result = run(&problem, &options);
            assert_eq!(result.counts().solutions.to_u64(), Some(1 << contacts));
            assert_eq!(result.product.states().count(), 1 << contacts);
        }
    }
    Ok(())
}

#[test]
fn none_is_an_answer() -> Outcome {
    // |x| = -1 for every contact.
    let problem = ModeProblem::from_absolute_value_equation(
        &DMatrix::zeros(6, 6),
        &DMatrix::identity(6, 6),
        DVector::from_element(6, -1.0),
    )?;
    for options in switches() {
        let result = run(&problem, &options);
        assert!(result.counts().solutions.is_zero());
        assert_eq!(result.product.states().count(), 0);
    }
    Ok(())
}

#[test]
fn known_degenerate_answers() -> Outcome {
    let unloaded = ModeProblem::from_linear_complementarity(&DMatrix::identity(3, 3), DVector::zeros(3))?;
    assert_eq!(run(&unloaded, &SearchOptions::default()).counts().solutions.to_u64(), Some(1));
    let ray = ModeProblem::from_linear_complementarity(&dmatrix![1.0, -1.0; -1.0, 1.0], dvector![-1.0, 1.0])?;
    let result = run(&ray, &SearchOptions::default());
    assert_eq!(result.counts().singular.to_u64(), Some(1));
    Ok(())
}

#[test]
fn no_contacts_have_one_trivial_solution() -> Outcome {
    let none = DMatrix::zeros(0, 0);
    let problem = ModeProblem::new(none.clone(), none.clone(), none.clone(), none, DVector::zeros(0))?;
    let result = run(&problem, &SearchOptions::default());
    assert_eq!(result.counts().solutions.to_u64(), Some(1));
    assert_eq!(result.product.states().count(), 1);
    Ok(())
}

#[test]
fn limits_and_cancellation_give_partial_answers() -> Outcome {
    let mut random = Random::new(7);
    let m = random.matrix(14, 14);
    let problem = ModeProblem::from_linear_complementarity(&m, random.vector(14).abs())?;
    let all = enumerate(&problem, &Limits::default()).expect("within the limits").solutions.len();
    assert!(all > 2);

    let few_nodes = SearchOptions { nodes: 20, ..SearchOptions::default() };
    let result = run(&problem, &few_nodes);
    assert_eq!(result.completeness, Completeness::Partial(StopReason::NodeLimit));
    assert!(result.groups[0].shares.unexplored > 0.0);
    assert_eq!(result.nodes(), 20);

    let limits = Limits { solutions: 2, ..Limits::default() };
    let result = run(&problem, &SearchOptions { limits, ..SearchOptions::default() });
    assert_eq!(result.completeness, Completeness::Partial(StopReason::SolutionLimit));
    assert_eq!(result.counts().solutions.to_u64(), Some(2));

    let mut fractions = Vec::new();
    let result = search(&problem, &SearchOptions::default(), &mut |progress| {
        fractions.extend(progress.fraction);
        if progress.done < 30 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert_eq!(result.completeness, Completeness::Partial(StopReason::Cancelled));
    assert!(fractions.len() >= 30);
    assert!(fractions.is_sorted() && fractions[0] == 0.0 && fractions[fractions.len() - 1] < 1.0);
    assert!(result.completeness.to_string().starts_with("partial"));
    Ok(())
}

#[test]
fn shares_of_patterns_add_up() {
    let mut random = Random::new(3);
    for size in 1..10 {
        let problem =
            ModeProblem::from_linear_complementarity(&random.matrix(size, size), random.vector(size))
                .expect("shapes fit");
        for group in run(&problem, &SearchOptions::default()).groups {
            assert!((group.shares.done() + group.shares.unexplored - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn any_number_of_threads_visits_the_same_nodes() {
    let mut random = Random::new(8);
    let b = random.matrix(30, 30) * (3.0_f64 / 30.0).sqrt();
    let x = random.vector(30);
    let identity = DMatrix::identity(30, 30);
    let problem = ModeProblem::from_absolute_value_equation(&identity, &-&b, &x - &b * x.abs());
    let problem = problem.expect("shapes fit");
    let with = |threads: usize, nodes: u64, solutions: usize| {
        let limits = Limits { solutions, ..Limits::default() };
        run(&problem, &SearchOptions { threads, nodes, limits, ..SearchOptions::default() })
    };
    // Not so few that no subtrees are made.
    let alone = with(1, u64::MAX, 1000);
    assert!(alone.nodes() > 1500 && alone.completeness == Completeness::Proven, "{}", alone.nodes());
    for threads in [2, 3, 8] {
        assert_eq!(with(threads, u64::MAX, 1000), alone);
    }
    for nodes in [1100, 1300, alone.nodes()] {
        let limited = with(1, nodes, 1000);
        assert!(limited.nodes() <= nodes);
        assert_eq!(with(3, nodes, 1000), limited);
    }
}

/// w = -z + 1: each of `z = 0` and `z = 1` is a solution; and `z_1 + z_2 = 1`, of which every point is one. With a limit
/// of 1, the first solution or set ends the search; what is proven without looking further is complete.
#[test]
fn a_limit_of_one_ends_the_search_at_the_first_solution() {
    let one = SearchOptions::within(None, Some(1));
    let arguments = Arguments { every_pattern: false, uniqueness: false, ..Arguments::default() };
    let partial = Completeness::Partial(StopReason::SolutionLimit);
    let several =
        ModeProblem::from_linear_complementarity(&dmatrix![-1.0], dvector![1.0]).expect("a valid problem");
    let set = ModeProblem::from_linear_complementarity(&dmatrix![1.0, 1.0; 1.0, 1.0], dvector![-1.0, -1.0])
        .expect("a valid problem");
    for options in [one, SearchOptions { arguments, ..one }] {
        let first = run(&several, &options);
        assert_eq!((first.counts().solutions.to_u64(), first.completeness), (Some(1), partial));
        let all = run(&several, &SearchOptions::default());
        assert!(first.nodes() < all.nodes() || options.arguments == arguments, "{}", first.nodes());
        assert_eq!(run(&set, &options).product.states().count(), 1, "{:?}", run(&set, &options).product);
        assert_eq!(run(&set, &options).completeness, partial);
    }
    let only =
        ModeProblem::from_linear_complementarity(&DMatrix::identity(9, 9), DVector::from_element(9, -1.0));
    let result = run(
        &only.expect("a valid problem"),
        &SearchOptions { arguments: Arguments { groups: false, ..Arguments::default() }, ..one },
    );
    assert_eq!((result.counts().solutions.to_u64(), result.completeness), (Some(1), Completeness::Proven));
}
