//! The search on problems whose numbers lie within bounds, against samples from within the bounds.

use std::ops::ControlFlow;

use crate::search_support::{self, Random, patterns};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::certificate::{Decision, ExactSet, Interval, IntervalModeProblem, decide};
use slideway_modes::{
    Arguments, Certificate, Completeness, ContactState, Method, ModeProblem, SearchOptions, SearchResult,
    Side, StateLists, search,
};

const ALL: usize = 1_000_000;

fn run(problem: &IntervalModeProblem, options: &SearchOptions) -> (SearchResult, StateLists) {
    let result = search(problem, options, &mut |_| ControlFlow::Continue(()));
    let lists = result.lists(ALL, ALL);
    assert!(lists.all_listed);
    (result, lists)
}

/// Every number is moved by up to `relative` times its size; by that very much where `to_the_ends`.
fn sample(problem: &ModeProblem, relative: f64, to_the_ends: bool, random: &mut Random) -> ModeProblem {
    let mut moved = |value: f64| {
        let share = if to_the_ends { random.number().signum() } else { random.number() };
        value + 0.999 * relative * share * value
    };
    let [columns_up, columns_down] = Side::BOTH.map(|side| problem.columns(side).map(&mut moved));
    let [up, down] = Side::BOTH.map(|side| problem.jumps(side).map(&mut moved));
    ModeProblem::new(columns_up, columns_down, up, down, problem.right_hand_side().map(&mut moved))
        .expect("finite numbers")
}

/// Every listed pattern, and the bounds that it is proven to keep to.
fn listed(lists: &StateLists) -> Vec<(Vec<ContactState>, Option<Vec<Interval>>)> {
    let proven = |certificate: &Certificate| match certificate {
        Certificate::Proven { unknowns } => Some(unknowns.clone()),
        Certificate::OnBoundaryWithinBounds { .. } => None,
        other => panic!("{other:?} within bounds"),
    };
    let mut all = Vec::new();
    for solution in &lists.solutions {
        let bounds = proven(&solution.certificate);
        for pattern in &solution.patterns {
            all.push((pattern.iter().map(|&side| side.into()).collect(), bounds.clone()));
        }
    }
    for gap in &lists.gaps {
        let bounds = proven(&gap.certificate);
        all.extend(gap.patterns.iter().map(|pattern| (pattern.clone(), bounds.clone())));
    }
    for mode in &lists.singular {
        assert_eq!(proven(&mode.certificate), None);
        all.extend(mode.patterns.iter().map(|pattern| (pattern.clone(), None)));
    }
    let undecided = lists.undecided.iter().flat_map(|undecided| &undecided.patterns);
    all.extend(undecided.map(|pattern| (pattern.clone(), None)));
    all
}

/// Whatever a sample has for solutions is listed, and what is proven holds in it.
fn check_sample(problem: &ModeProblem, lists: &StateLists, context: &str) {
    let listed = listed(lists);
    for pattern in patterns(problem) {
        let entry = listed.iter().find(|(other, _)| *other == pattern);
        let admits = match decide(problem, &pattern).decision {
            Decision::NoSolution { .. } | Decision::Singular { set: ExactSet::Empty } => false,
            Decision::Solution { unknowns, .. } => {
                if let Some((_, Some(bounds))) = entry {
                    let within =
                        unknowns.iter().zip(bounds).all(|(one, bound)| one.intersection(*bound).is_some());
                    assert!(within, "{context}: {pattern:?}");
                }
                true
            }
            _ => true,
        };
        assert!(!admits || entry.is_some(), "{context}: {pattern:?} of a sample is not listed");
        let promised = matches!(entry, Some((_, Some(_))));
        assert!(admits || !promised, "{context}: {pattern:?} is said to exist for all values");
    }
}

fn options() -> [SearchOptions; 4] {
    let all = Arguments::default();
    [
        all,
        Arguments { every_pattern: false, ..all },
        Arguments { every_pattern: false, groups: false, ..all },
        Arguments { every_pattern: false, uniqueness: false, propagation: false, ..all },
    ]
    .map(|arguments| SearchOptions { arguments, ..SearchOptions::default() })
}

/// Compares a number of random instances with 1 to `contacts` contacts with samples from within bounds.
fn compare(count: usize, contacts: usize, problem: impl Fn(&mut Random, usize) -> ModeProblem) {
    let mut proven = 0;
    let mut in_doubt = 0;
    for seed in 0..count {
        let mut random = Random::new(seed as u64);
        let size = 1 + random.below(contacts);
        let problem = problem(&mut random, size);
        let relative = [1e-15, 1e-6, 0.01, 0.1, 0.3][seed % 5];
        let options = options()[seed / 5 % 4];
        let within = IntervalModeProblem::widened(&problem, relative).expect("a sensible radius");
        let (result, lists) = run(&within, &options);
        let context = format!("seed {seed}, relative {relative}, {options:?}, {problem:?}");
        assert_eq!(result.completeness, Completeness::Proven, "{context}");
        for number in 0..4 {
            check_sample(&sample(&problem, relative, number < 2, &mut random), &lists, &context);
        }
        let is_proven = |certificate: &Certificate| matches!(certificate, Certificate::Proven { .. });
        proven += lists.solutions.iter().filter(|state| is_proven(&state.certificate)).count();
        in_doubt += lists.undecided.len();
    }
    assert!(proven > 0 && in_doubt > 0, "both kinds were met: {proven}, {in_doubt}");
}

#[test]
fn absolute_value_equations() {
    compare(300, 6, |random, size| {
        let b = random.matrix(size, size) * [0.3, 1.0, 2.0][random.below(3)];
        let load = random.vector(size);
        ModeProblem::from_absolute_value_equation(&DMatrix::identity(size, size), &-b, load)
            .expect("shapes fit")
    });
}

#[test]
fn complementarity_problems() {
    compare(300, 7, |random, size| {
        ModeProblem::from_linear_complementarity(&random.matrix(size, size), random.vector(size))
            .expect("shapes fit")
    });
}

#[test]
fn groups_and_chains_of_groups() {
    compare(400, 8, |random, size| {
        let density = [0.1, 0.2, 0.3][random.below(3)];
        let [positive, negative] = [1.0, -1.0]
            .map(|sign| DMatrix::identity(size, size) * sign + random.sparse_matrix(size, density) * 1.5);
        let none = DMatrix::zeros(size, size);
        ModeProblem::new(positive, negative, none.clone(), none, random.vector(size)).expect("shapes fit")
    });
}

#[test]
fn jumps_with_gap_states() {
    compare(300, 4, |random, size| {
        let [positive, negative] = [1.0, -1.0].map(|sign| {
            DMatrix::identity(size, size) * sign + random.matrix(size, size) * (1.0 / (size as f64).sqrt())
        });
        let [up, down] = [0, 1].map(|_| random.some_columns(size));
        ModeProblem::new(positive, negative, up, down, random.vector(size)).expect("shapes fit")
    });
}

#[test]
fn degenerate_problems_of_small_integers() {
    compare(400, 4, |random, size| {
        let mut small = |sign: f64| {
            DMatrix::from_fn(size, size, |row, column| {
                random.integer(1) * 0.5 + if row == column { sign } else { 0.0 }
            })
        };
        let (positive, negative) = (small(1.0), small(-1.0));
        let jumps = match random.below(2) {
            0 => DMatrix::zeros(size, size),
            _ => DMatrix::from_fn(size, size, |_, _| random.integer(1)),
        };
        let load = DVector::from_fn(size, |_, _| random.integer(2));
        ModeProblem::new(positive, negative, jumps.clone(), -jumps, load).expect("shapes fit")
    });
}

/// `w = m z + q` with one pair of unknowns.
fn one_pair(m: f64, q: f64, relative: f64) -> StateLists {
    let problem = ModeProblem::from_linear_complementarity(&dmatrix![m], dvector![q]).expect("shapes fit");
    run(
        &IntervalModeProblem::widened(&problem, relative).expect("a sensible radius"),
        &SearchOptions::default(),
    )
    .1
}

#[test]
fn a_boundary_within_bounds_is_labelled() {
    // x + y = 1, y = -x |...|: z_1 = 1 and w_2 = 1 - z_1, which is zero up to the bounds.
    let m = dmatrix![1.0, 0.0; -1.0, 1.0];
    let problem = ModeProblem::from_linear_complementarity(&m, dvector![-1.0, 1.0]).expect("shapes fit");
    let within = IntervalModeProblem::widened(&problem, 1e-15).expect("a sensible radius");
    let (result, lists) = run(&within, &SearchOptions::default());
    assert_eq!(result.completeness, Completeness::Proven);
    let [solution] = lists.solutions.as_slice() else { panic!("one solution") };
    assert_eq!(solution.pattern_count, 2);
    let Certificate::OnBoundaryWithinBounds { unknowns: Some(unknowns), in_doubt } = &solution.certificate
    else {
        panic!("on the boundary")
    };
    assert_eq!(in_doubt, &[1]);
    assert!(unknowns[0].contains(1.0) && unknowns[1].contains(0.0));
    assert!(lists.undecided.is_empty());
}

#[test]
fn a_solution_that_exists_for_some_of_the_values_only_is_told() {
    // w = -z + q: z = 0 and z = q for q > 0.
    let lists = one_pair(-1.0, 1.0, 0.1);
    assert_eq!(lists.solutions.len(), 2);
    assert!(lists.solutions.iter().all(|state| matches!(state.certificate, Certificate::Proven { .. })));
    // x - 1.05 |x| = 1: x = -1 / 2.05, and x = -20 is no solution; with 0.95 in place of 1.05 x = 20 is one.
    let problem = ModeProblem::from_absolute_value_equation(&dmatrix![1.0], &dmatrix![-1.05], dvector![1.0]);
    let within = IntervalModeProblem::widened(&problem.expect("shapes fit"), 0.0).expect("a radius");
    assert_eq!(run_exact(&within).solutions.len(), 0);
    let problem =
        ModeProblem::new(dmatrix![-0.05], dmatrix![-2.05], dmatrix![0.0], dmatrix![0.0], dvector![1.0]);
    let within = IntervalModeProblem::widened(&problem.expect("shapes fit"), 2.0).expect("a radius");
    let (_, lists) = run(&within, &SearchOptions::default());
    assert!(lists.solutions.is_empty());
    assert_eq!(lists.undecided.len(), 2);
    assert!(lists.undecided.iter().all(|undecided| undecided.unknowns.is_none()));
}

/// Bounds of radius zero are exact numbers.
fn run_exact(problem: &IntervalModeProblem) -> StateLists {
    let result = search(problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
    let lists = result.lists(ALL, ALL);
    assert!(lists.undecided.is_empty());
    lists
}

#[test]
fn large_problems_within_rounding_are_proven() {
    let mut random = Random::new(5);
    for size in [12, 16] {
        let (m, q) = (random.matrix(size, size), random.vector(size));
        let problem = ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit");
        let exact = search_support::run(&problem, &SearchOptions::default());
        let within = IntervalModeProblem::widened(&problem, 1e-14).expect("a sensible radius");
        let (result, lists) = run(&within, &SearchOptions::default());
        assert_eq!(result.completeness, Completeness::Proven);
        assert_eq!(result.counts(), exact.counts());
        assert!(lists.solutions.iter().all(|state| matches!(state.certificate, Certificate::Proven { .. })));
    }
}

/// A diagonal and a coupling of low rank, and a solution planted in it.
fn planted_low_rank(contacts: usize, rank: usize, seed: u64) -> (ModeProblem, Vec<ContactState>) {
    let mut random = Random::new(seed);
    let plain = search_support::low_rank(&mut random, contacts, rank, 3.0);
    let [positive, negative] = Side::BOTH.map(|side| plain.columns(side).clone());
    let forces = random.vector(contacts);
    let columns = DMatrix::from_fn(contacts, contacts, |row, contact| {
        (if forces[contact] > 0.0 { &positive } else { &negative })[(row, contact)]
    });
    let pattern =
        forces.map(|force| if force > 0.0 { ContactState::Positive } else { ContactState::Negative });
    let (load, none) = (columns * forces.abs(), DMatrix::zeros(contacts, contacts));
    let problem = ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit");
    (problem, pattern.as_slice().to_vec())
}

fn without_uniqueness(low_rank: bool) -> SearchOptions {
    let arguments = Arguments { uniqueness: false, low_rank, ..Arguments::default() };
    SearchOptions { arguments, ..SearchOptions::default() }
}

#[test]
fn cells_within_bounds_hold_what_samples_admit() {
    for seed in 0..6_usize {
        // Wide bounds: forces of many contacts are in doubt.
        let relative = [1e-9, 1e-4, 3e-3][seed % 3];
        let (problem, _) = planted_low_rank(13, 1 + seed % 2, 50 + seed as u64);
        let bounded = IntervalModeProblem::widened(&problem, relative).expect("a sensible radius");
        let (cells, lists) = run(&bounded, &without_uniqueness(true));
        assert!(matches!(cells.groups[0].method, Method::Cells { .. }), "{seed}");
        let (tree, tree_lists) = run(&bounded, &without_uniqueness(false));
        assert_eq!(cells.completeness, tree.completeness);
        let patterns = |lists: &StateLists, proven: bool| -> Vec<Vec<ContactState>> {
            let kept = listed(lists).into_iter().filter(|(_, bounds)| !proven || bounds.is_some());
            kept.map(|(pattern, _)| pattern).collect()
        };
        let all = patterns(&lists, false);
        assert!(patterns(&tree_lists, true).iter().all(|pattern| all.contains(pattern)), "{seed}");
        let mut random = Random::new(seed as u64);
        for at in 0..2 {
            let sample = sample(&problem, relative, at == 0, &mut random);
            let admitted = search(&sample, &without_uniqueness(false), &mut |_| ControlFlow::Continue(()));
            for state in admitted.product.states() {
                assert!(all.contains(&state.pattern(13)), "{seed}");
            }
        }
    }
}

#[test]
fn many_contacts_of_few_freedoms_within_bounds() {
    for rank in 1..=3 {
        let (problem, pattern) = planted_low_rank(100, rank, rank as u64);
        let bounded = IntervalModeProblem::widened(&problem, 1e-13).expect("a sensible radius");
        let (result, lists) = run(&bounded, &without_uniqueness(true));
        assert_eq!(result.groups[0].method, Method::Cells { rank });
        assert_eq!(result.completeness, Completeness::Proven);
        assert!(listed(&lists).iter().any(|(other, _)| *other == pattern));
    }
}

/// Row 2: `N_2 = -1 + lambda_2 + lambda_3`; `N_3 = 0`; and the first contact, whose column on its positive
/// side is zero, has any force. With both others in their gaps it is `lambda_2 + lambda_3 = 1`. One end of
/// that, `lambda = (1, 0)`, is what the others admit on a positive and a negative side: the same forces, but
/// a smaller set. With the second contact in its gap and the third on its negative side it is the same end.
#[test]
fn sets_with_the_same_forces_and_other_shares_are_two() {
    let columns = [dmatrix![0.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 1.0], -DMatrix::identity(3, 3)];
    let [positive, negative] = columns;
    let jumps = dmatrix![0.0, 0.0, 0.0; 0.0, 1.0, 1.0; 0.0, 0.0, 0.0];
    let problem = ModeProblem::new(positive, negative, jumps, DMatrix::zeros(3, 3), dvector![0.0, -1.0, 0.0]);
    let bounded =
        IntervalModeProblem::widened(&problem.expect("shapes fit"), 1e-12).expect("a sensible radius");
    let exact = IntervalModeProblem::widened(bounded.centre(), 0.0).expect("a sensible radius");
    for problem in [bounded, exact] {
        let lists = run(&problem, &SearchOptions::default()).1;
        let is_maximal = |pattern: [ContactState; 3]| {
            let mode = lists.singular.iter().find(|mode| mode.pattern == pattern);
            mode.map(|mode| (mode.maximal, mode.pattern_count))
        };
        let (up, down, gap) = (ContactState::Positive, ContactState::Negative, ContactState::Gap);
        assert_eq!(is_maximal([up, gap, gap]), Some((true, 1)));
        assert_eq!(is_maximal([up, up, down]), Some((false, 2)));
    }
}
