//! What the search proves of problems with exact numbers, against the decision of every pattern.

use crate::search_support::{Random, patterns, run, switches};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::certificate::{Decision, ExactSet, decide};
use slideway_modes::{
    Arguments, Certificate, Completeness, ContactState, Limits, Method, ModeProblem, ModeProblemError,
    SearchOptions, SolutionSet, StateLists, enumerate,
};

type Outcome = Result<(), ModeProblemError>;

const ALL: usize = 1_000_000;

/// The patterns of each state's list, and whether it is strictly inside.
fn listed(lists: &StateLists) -> Vec<(Vec<ContactState>, &Certificate)> {
    let mut all = Vec::new();
    for solution in &lists.solutions {
        for pattern in &solution.patterns {
            all.push((pattern.iter().map(|&side| side.into()).collect(), &solution.certificate));
        }
    }
    for gap in &lists.gaps {
        all.extend(gap.patterns.iter().map(|pattern| (pattern.clone(), &gap.certificate)));
    }
    for mode in &lists.singular {
        all.extend(mode.patterns.iter().map(|pattern| (pattern.clone(), &mode.certificate)));
    }
    all
}

/// The list is that of all patterns decided one by one. On a boundary some of the patterns may be missing
/// from the list, but not the state.
fn assert_decided(problem: &ModeProblem, options: &SearchOptions, seed: usize) {
    let result = run(problem, options);
    let context = format!("seed {seed}, {options:?}, {problem:?}");
    assert_eq!(result.completeness, Completeness::Proven, "{context}");
    let lists = result.lists(ALL, ALL);
    assert!(lists.all_listed && lists.undecided.is_empty(), "{context}");
    let listed = listed(&lists);
    let mut strict = 0;
    for pattern in patterns(problem) {
        let entry = listed.iter().find(|(other, _)| *other == pattern).map(|(_, certificate)| *certificate);
        match decide(problem, &pattern).decision {
            Decision::Solution { unknowns, .. } => {
                strict += 1;
                let Some(Certificate::Proven { unknowns: found }) = entry else {
                    panic!("{context}: {pattern:?}")
                };
                assert!(found.iter().zip(unknowns).all(|(one, other)| one.intersection(other).is_some()));
            }
            Decision::Boundary { unknowns, .. } => {
                let signed =
                    unknowns.iter().zip(&pattern).map(|(value, state)| value.middle() * state.sign());
                let force = DVector::from_iterator(pattern.len(), signed);
                let close = |other: &DVector<f64>| (other - &force).amax() <= 1e-12 * (1.0 + force.amax());
                let known = lists.solutions.iter().any(|solution| close(&solution.normal_force))
                    || lists.gaps.iter().any(|gap| close(&gap.normal_force))
                    || lists.singular.iter().any(|mode| mode.set.vertices().into_iter().any(close));
                assert!(known, "{context}: {pattern:?}");
                assert!(matches!(entry, None | Some(Certificate::Boundary { .. })), "{context}: {pattern:?}");
            }
            Decision::NoSolution { .. } | Decision::Singular { set: ExactSet::Empty } => {
                assert_eq!(entry, None, "{context}: {pattern:?}");
            }
            Decision::Singular { .. } => {
                assert!(matches!(entry, None | Some(Certificate::Singular)), "{context}: {pattern:?}");
            }
            Decision::Undecided { .. } => panic!("exact numbers"),
        }
    }
    let inside = |certificate: &Certificate| matches!(certificate, Certificate::Proven { .. });
    assert_eq!(listed.iter().filter(|(_, certificate)| inside(certificate)).count(), strict, "{context}");
}

fn compare(count: usize, contacts: usize, problem: impl Fn(&mut Random, usize) -> ModeProblem) {
    for seed in 0..count {
        let mut random = Random::new(1000 + seed as u64);
        let size = 1 + random.below(contacts);
        assert_decided(&problem(&mut random, size), &switches()[seed % switches().len()], seed);
    }
}

#[test]
fn dense_problems() {
    compare(300, 7, |random, size| {
        ModeProblem::from_linear_complementarity(&random.matrix(size, size), random.vector(size))
            .expect("shapes fit")
    });
}

#[test]
fn sparse_problems_with_jumps() {
    compare(400, 6, |random, size| {
        let [positive, negative] =
            [1.0, -1.0].map(|sign| DMatrix::identity(size, size) * sign + random.sparse_matrix(size, 0.25));
        let jumps =
            if random.below(2) == 0 { random.sparse_matrix(size, 0.1) } else { DMatrix::zeros(size, size) };
        let none = DMatrix::zeros(size, size);
        ModeProblem::new(positive, negative, jumps, none, random.vector(size)).expect("shapes fit")
    });
}

#[test]
fn degenerate_problems_of_small_integers() {
    compare(600, 5, |random, size| {
        let density = [0.3, 0.6, 1.0][random.below(3)];
        let mut small = |sign: f64| {
            let shape = random.sparse_matrix(size, density);
            shape.map_with_location(|row, column, value| {
                let entry = if value == 0.0 { 0.0 } else { (3.0 * value).round() };
                entry + if row == column { 2.0 * sign } else { 0.0 }
            })
        };
        let (positive, negative) = (small(1.0), small(-1.0));
        let load = DVector::from_fn(size, |_, _| random.integer(1));
        let none = DMatrix::zeros(size, size);
        ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit")
    });
}

#[test]
fn degenerate_problems_with_jumps() {
    compare(300, 4, |random, size| {
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

/// Like degenerate problems, but for a number far below tolerances here and there.
#[test]
fn problems_within_rounding_of_degenerate_ones() {
    compare(400, 5, |random, size| {
        let mut near =
            |whole: f64| if random.below(3) == 0 { whole + random.number() * 1e-14 } else { whole };
        let m = DMatrix::from_fn(size, size, |row, column| near(if row == column { -1.0 } else { 0.5 }));
        let q = DVector::from_fn(size, |row, _| near([1.0, 0.0, -0.5][row % 3]));
        ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit")
    });
}

#[test]
fn solutions_closer_than_tolerances_are_told_apart() -> Outcome {
    // w = -z + q: z = 0 and z = q for each of three contacts, however small q is.
    let m = -DMatrix::identity(3, 3);
    let problem = ModeProblem::from_linear_complementarity(&m, dvector![1e-20, 1.0, 1e-14])?;
    let merged = enumerate(&problem, &Limits::default()).expect("few patterns").solutions.len();
    assert!(merged < 8, "tolerances merge some of them");
    for options in switches() {
        let result = run(&problem, &options);
        assert_eq!(result.completeness, Completeness::Proven);
        assert_eq!(result.counts().solutions.to_u64(), Some(8));
        let inside = |certificate: &Certificate| matches!(certificate, Certificate::Proven { .. });
        assert!(result.lists(ALL, ALL).solutions.iter().all(|solution| inside(&solution.certificate)));
    }
    Ok(())
}

#[test]
fn a_nearly_singular_pattern_is_decided() -> Outcome {
    // D = 2^-50: z = (1, 2) in exact numbers, singular within tolerances.
    let tiny = f64::EPSILON * 4.0;
    let m = dmatrix![1.0, 1.0; 1.0, 1.0 + tiny];
    let problem = ModeProblem::from_linear_complementarity(&m, dvector![-3.0, -3.0 - 2.0 * tiny])?;
    let within_tolerances = enumerate(&problem, &Limits::default()).expect("few patterns");
    assert!(within_tolerances.counts.singular_continuum > 0);
    for options in switches() {
        let result = run(&problem, &options);
        assert_eq!(result.completeness, Completeness::Proven, "{options:?}");
        let lists = result.lists(ALL, ALL);
        let [solution] = lists.solutions.as_slice() else { panic!("one solution: {options:?}") };
        assert!(lists.singular.is_empty());
        assert!((&solution.normal_force - dvector![1.0, 2.0]).amax() < 1e-15);
    }
    Ok(())
}

#[test]
fn boundaries_are_exact_even_behind_rounded_loads() -> Outcome {
    // 3 N_1 = 1 and N_2 = 1 - 3 |N_1| = 0: the load of the second contact has a rounding error.
    let pairs = 4;
    let block = |own: [f64; 2], coupling: f64| {
        DMatrix::from_fn(2 * pairs, 2 * pairs, |row, column| match (row, column) {
            _ if row == column => own[row % 2],
            _ if row == column + 1 && row % 2 == 1 => coupling,
            _ => 0.0,
        })
    };
    let none = DMatrix::zeros(2 * pairs, 2 * pairs);
    let ones = DVector::from_element(2 * pairs, 1.0);
    let (positive, negative) = (block([3.0, 1.0], 3.0), block([-3.0, -1.0], 3.0));
    let problem = ModeProblem::new(positive, negative, none.clone(), none, ones)?;
    let tree = Arguments { every_pattern: false, uniqueness: false, ..Arguments::default() };
    for arguments in [Arguments::default(), tree] {
        let result = run(&problem, &SearchOptions { arguments, ..SearchOptions::default() });
        assert_eq!(result.completeness, Completeness::Proven);
        assert!(result.groups.len() > 1);
        let lists = result.lists(ALL, ALL);
        let [solution] = lists.solutions.as_slice() else { panic!("one solution") };
        assert_eq!(solution.pattern_count, 1 << pairs);
        assert_eq!(solution.patterns.len(), 1 << pairs);
        assert_eq!(solution.on_boundary, [1, 3, 5, 7]);
        let Certificate::Boundary { zero, .. } = &solution.certificate else { panic!("on the boundary") };
        assert_eq!(zero, &[1, 3, 5, 7]);
        assert_eq!(solution.determinant, 81.0);
    }
    Ok(())
}

#[test]
fn known_degenerate_answers() -> Outcome {
    let unloaded = ModeProblem::from_linear_complementarity(&DMatrix::identity(3, 3), DVector::zeros(3))?;
    let ray = ModeProblem::from_linear_complementarity(&dmatrix![1.0, -1.0; -1.0, 1.0], dvector![-1.0, 1.0])?;
    for options in switches() {
        let lists = run(&unloaded, &options).lists(ALL, ALL);
        assert_eq!(lists.solutions.len(), 1);
        assert!(
            matches!(&lists.solutions[0].certificate, Certificate::Boundary { zero, .. } if zero.len() == 3)
        );
        let result = run(&ray, &options);
        assert_eq!(result.completeness, Completeness::Proven);
        let lists = result.lists(ALL, ALL);
        let [mode] = lists.singular.as_slice() else { panic!("one ray") };
        let SolutionSet::Ray { from, direction } = &mode.set else { panic!("a ray") };
        assert_eq!((from, direction), (&dvector![1.0, 0.0], &dvector![1.0, 1.0]));
        assert_eq!(mode.certificate, Certificate::Singular);
    }
    Ok(())
}

#[test]
fn every_pattern_of_a_small_problem_is_counted_as_by_enumeration() {
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let size = 1 + random.below(5);
        let [positive, negative] =
            [1.0, -1.0].map(|sign| DMatrix::identity(size, size) * sign + random.matrix(size, size) * 1.5);
        let jumps = if seed % 2 == 0 { DMatrix::zeros(size, size) } else { random.some_columns(size) };
        let none = DMatrix::zeros(size, size);
        let problem =
            ModeProblem::new(positive, negative, jumps, none, random.vector(size)).expect("shapes fit");
        let arguments = Arguments { groups: false, ..Arguments::default() };
        let result = run(&problem, &SearchOptions { arguments, ..SearchOptions::default() });
        if result.groups[0].log2_patterns > 8.0 {
            continue;
        }
        let expected = enumerate(&problem, &Limits::default()).expect("few patterns");
        assert_eq!(result.groups[0].method, Method::EveryPattern);
        let outcomes = result.outcomes().expect("every pattern was tried");
        assert_eq!(outcomes.counts, expected.counts);
        assert_eq!(outcomes.gap_counts, expected.gap_counts);
        assert_eq!(outcomes.closest, expected.closest);
        assert_eq!(result.lists(ALL, ALL).solutions.len(), expected.solutions.len());
    }
}

#[test]
fn a_group_that_admits_nothing_is_named() -> Outcome {
    // |x_k| = -1 for the seventh contact alone; w = -z + 1 for the others.
    let (mut positive, mut negative) = (DMatrix::identity(8, 8), DMatrix::identity(8, 8));
    let mut load = DVector::from_element(8, 1.0);
    (positive[(6, 6)], negative[(6, 6)], load[6]) = (1.0, 1.0, -1.0);
    let none = DMatrix::zeros(8, 8);
    let problem = ModeProblem::new(positive, negative, none.clone(), none, load)?;
    let result = run(&problem, &SearchOptions::default());
    assert!(result.counts().solutions.is_zero());
    let barren: Vec<_> = result.barren_groups().map(|group| group.contacts.clone()).collect();
    assert_eq!(barren, [[6]]);
    let outcomes = result.barren_groups().next().and_then(|group| group.outcomes.as_ref());
    assert_eq!(outcomes.map(|outcomes| outcomes.closest.len()), Some(2));
    Ok(())
}
