//! Monotone problems: one pattern has all solutions, found in one node.

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::{
    Arguments, BigCount, CombinedState, Completeness, GroupState, Method, ModeProblem, SearchOptions,
    SearchResult,
};

use crate::search_support::{Random, run};

/// Without every pattern of small groups, so that the rule is tried first.
fn arguments(uniqueness: bool) -> SearchOptions {
    let arguments = Arguments { groups: false, every_pattern: false, uniqueness, ..Arguments::default() };
    SearchOptions { arguments, ..SearchOptions::default() }
}

fn integers(random: &mut Random, rows: usize, columns: usize, most: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.integer(most))
}

/// A market equilibrium: `x` maximises `c x - x^T Q x / 2` for prices `p` of the goods `A x <= b`,
/// `M = [[Q, A^T], [-A, 0]]`, `Q` of half the rank of its size: a linear complementarity problem with a
/// positive semidefinite matrix (Cottle, Pang and Stone (1992), section 1.2).
fn market(random: &mut Random, size: usize) -> (DMatrix<f64>, DVector<f64>) {
    let goods = size / 2;
    let activities = size - goods;
    let factor = integers(random, activities / 2 + 1, activities, 3);
    let use_of_goods = DMatrix::from_fn(goods, activities, |_, _| random.below(5) as f64);
    let mut m = DMatrix::zeros(size, size);
    m.view_mut((0, 0), (activities, activities)).copy_from(&(factor.transpose() * &factor));
    m.view_mut((0, activities), (activities, goods)).copy_from(&use_of_goods.transpose());
    m.view_mut((activities, 0), (goods, activities)).copy_from(&-&use_of_goods);
    let q = DVector::from_fn(size, |at, _| {
        if at < activities { -1.0 - random.below(20) as f64 } else { 5.0 + random.below(20) as f64 }
    });
    (m, q)
}

/// Points and directions of a state, in order.
fn corners(state: &CombinedState<'_>) -> Vec<DVector<f64>> {
    let [(_, part)] = state.parts.as_slice() else { panic!("one group") };
    let mut corners: Vec<DVector<f64>> = match part {
        GroupState::Singular(mode) => {
            mode.set.vertices().into_iter().chain(mode.set.directions()).cloned().collect()
        }
        part => part.normal_force().into_iter().cloned().collect(),
    };
    let order = |one: &f64, other: &f64| {
        if (one - other).abs() < 1e-9 { std::cmp::Ordering::Equal } else { one.total_cmp(other) }
    };
    corners.sort_by(|one, other| {
        let mut orders = one.iter().zip(other.iter()).map(|(one, other)| order(one, other));
        orders.find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    corners
}

fn maximal(result: &SearchResult) -> Vec<Vec<DVector<f64>>> {
    result.product.states().filter(CombinedState::is_maximal).map(|state| corners(&state)).collect()
}

/// Both searches find the same set; returns whether the rule applied, and the number of corners.
fn assert_same_as_tree(problem: &ModeProblem, context: &str) -> (bool, usize) {
    let [by_rule, by_tree] = [true, false].map(|uniqueness| run(problem, &arguments(uniqueness)));
    assert_eq!((by_rule.completeness, by_tree.completeness), (Completeness::Proven, Completeness::Proven));
    let (found, expected) = (maximal(&by_rule), maximal(&by_tree));
    assert_eq!(found.len(), expected.len(), "{context} {problem:?}");
    for (one, other) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert!((one - other).amax() < 1e-9 * (1.0 + one.amax()), "{context} {found:?} {expected:?}");
    }
    let lengths = |sets: &[Vec<DVector<f64>>]| sets.iter().map(Vec::len).collect::<Vec<_>>();
    assert_eq!(lengths(&found), lengths(&expected), "{context} {problem:?}");
    let applied = matches!(by_rule.groups[0].method, Method::Monotone { .. });
    assert!(!applied || found.len() == 1, "one convex set");
    (applied, found.first().map_or(0, Vec::len))
}

/// `M = F^T F + K` with integers, `K` skew-symmetric, and a planted solution, often degenerate.
fn planted(random: &mut Random, size: usize) -> (DMatrix<f64>, DVector<f64>) {
    let rank = random.below(size + 1);
    let factor = integers(random, rank.max(1), size, 1) * if rank == 0 { 0.0 } else { 1.0 };
    let skew = integers(random, size, size, 1) * random.below(2) as f64;
    let m = factor.transpose() * factor + &skew - skew.transpose();
    let sides = integers(random, size, 1, 1).column(0).into_owned();
    let (z, w) = (sides.map(|side| side.max(0.0)), sides.map(|side| (-side).max(0.0)));
    let q = w - &m * z;
    (m, q)
}

#[test]
fn sets_of_monotone_problems_are_those_of_the_tree() {
    let (mut points, mut sets) = (0, 0);
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let size = 2 + random.below(4);
        let (m, q) = planted(&mut random, size);
        let problem = ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit");
        let (applied, corners) = assert_same_as_tree(&problem, &format!("seed {seed}"));
        assert!(applied, "seed {seed} {problem:?}");
        points += usize::from(corners == 1);
        sets += usize::from(corners > 1);
    }
    assert!(points > 50 && sets > 50, "{points} {sets}");
}

#[test]
fn equations_with_gain_one_are_monotone() {
    // x + B |x| = b with a signed permutation B: no singular value is above 1. Rows are combined, which changes nothing.
    let mut sets = 0;
    for seed in 0..100 {
        let mut random = Random::new(seed);
        let size = 3 + random.below(2);
        let shift = random.below(size);
        let b = DMatrix::from_fn(size, size, |row, column| {
            if (row + shift) % size == column { 2.0 * random.below(2) as f64 - 1.0 } else { 0.0 }
        });
        let mut rows = DMatrix::<f64>::identity(size, size);
        rows[(0, size - 1)] = random.integer(2);
        rows[(1, 0)] = random.integer(2);
        let x = integers(&mut random, size, 1, 1).column(0).into_owned();
        let load = &rows * (&x + &b * x.abs());
        let problem =
            ModeProblem::from_absolute_value_equation(&rows, &(&rows * b), load).expect("shapes fit");
        let (applied, corners) = assert_same_as_tree(&problem, &format!("seed {seed}"));
        assert!(applied, "seed {seed}");
        sets += usize::from(corners > 1);
    }
    assert!(sets > 30, "{sets}");
}

#[test]
fn problems_beyond_the_rule_are_left_to_the_tree() {
    // A negative eigenvalue of M + M^T, by one unit in the last place, and a semidefinite matrix.
    let ones = dmatrix![1.0, 1.0; 1.0, 1.0];
    let mut beyond = ones.clone();
    beyond[(0, 0)] = 1.0_f64.next_down();
    for (m, expected) in [(ones, true), (beyond, false), (dmatrix![0.0, 1.0; 1.0, 0.0], false)] {
        let problem = ModeProblem::from_linear_complementarity(&m, dvector![-1.0, -1.0]).expect("shapes fit");
        let result = run(&problem, &arguments(true));
        let applied = matches!(result.groups[0].method, Method::Monotone { strictly: false });
        assert_eq!(applied, expected, "{m}");
    }
    // No solution: w_1 = -1 + z_2 and w_2 = -1 - z_1.
    let problem =
        ModeProblem::from_linear_complementarity(&dmatrix![0.0, 1.0; -1.0, 0.0], dvector![-1.0, -1.0]);
    let result = run(&problem.expect("shapes fit"), &arguments(true));
    assert_eq!((result.completeness, result.product.states().count()), (Completeness::Proven, 0));
}

#[test]
fn markets_take_one_node() {
    for size in [20, 30, 40] {
        let (m, q) = market(&mut Random::new(size as u64), size);
        let problem = ModeProblem::from_linear_complementarity(&m, q.clone()).expect("shapes fit");
        let result = run(&problem, &SearchOptions::default());
        assert_eq!(result.completeness, Completeness::Proven);
        assert_eq!(
            (result.groups[0].method, result.groups[0].nodes),
            (Method::Monotone { strictly: false }, 1)
        );
        let counts = result.counts();
        assert!(!counts.solutions.is_zero() || counts.singular != BigCount::default(), "{size}");
        for state in result.product.states().take(1) {
            let signed = &corners(&state)[0];
            let residual =
                &m * signed.map(|value| value.max(0.0)) + q.clone() - signed.map(|value| (-value).max(0.0));
            assert!(residual.amax() < 1e-9 * q.amax(), "{size} {residual}");
        }
    }
}
