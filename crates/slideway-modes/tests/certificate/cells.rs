//! Corners of polyhedra: known polytopes, and random ones against every choice of columns.

use dashu_int::IBig;
use dashu_ratio::RBig;
use proptest::prelude::*;
use slideway_modes::certificate::{Cell, ExactSet};

use crate::oracle::basic_solutions;

/// `{y >= 0, A y = b}` from the rows of `[A | b]`.
fn cell(rows: &[Vec<i64>], most: usize) -> Cell {
    cell_while(rows, most, &mut || true).expect("nothing stops it")
}

fn cell_while(rows: &[Vec<i64>], most: usize, proceed: &mut dyn FnMut() -> bool) -> Option<Cell> {
    let width = rows.first().expect("an equation").len() - 1;
    let column = |at: usize| -> Vec<IBig> { rows.iter().map(|row| IBig::from(row[at])).collect() };
    let columns: Vec<Vec<IBig>> = (0..width).map(column).collect();
    Cell::of_columns(&columns, &column(width), most, proceed)
}

fn corners(set: &ExactSet) -> (usize, usize) {
    (set.vertices().len(), set.directions().len())
}

fn unit(width: usize, entries: &[(usize, i64)]) -> Vec<i64> {
    let mut row = vec![0; width + 1];
    entries.iter().for_each(|&(at, value)| row[at] = value);
    row
}

/// `y_k + y_{d+k} = 1`.
fn cube(dimension: usize) -> Vec<Vec<i64>> {
    let width = 2 * dimension;
    (0..dimension).map(|at| unit(width, &[(at, 1), (dimension + at, 1), (width, 1)])).collect()
}

/// Doubly stochastic matrices, row by row (Birkhoff): `size!` vertices, dimension `(size - 1)^2`.
fn doubly_stochastic(size: usize) -> Vec<Vec<i64>> {
    let width = size * size;
    let sum = |entries: Vec<usize>| {
        let ones = entries.into_iter().chain([width]).map(|at| (at, 1)).collect::<Vec<_>>();
        unit(width, &ones)
    };
    let rows = (0..size).map(|row| sum((0..size).map(|at| row * size + at).collect()));
    let columns = (0..size).map(|column| sum((0..size).map(|at| at * size + column).collect()));
    rows.chain(columns).collect()
}

/// Values `y_t >= 0`, `t = 0..points`, of polynomials of degree `d`: their differences of order `d + 1` vanish.
/// The cone is dual to that over the cyclic polytope `C(points, d)`, so its extreme rays are the facets of
/// that.
fn nonnegative_polynomials(points: usize, degree: usize) -> Vec<Vec<i64>> {
    let order = degree + 1;
    let binomial = |k: usize| (0..k).fold(1, |product, at| product * (order - at) / (at + 1));
    let sign = |k: usize| if k.is_multiple_of(2) { 1 } else { -1 };
    let difference = |from: usize| {
        let entries: Vec<(usize, i64)> =
            (0..=order).map(|k| (from + k, sign(k) * i64::try_from(binomial(k)).expect("small"))).collect();
        unit(points, &entries)
    };
    (0..points - order).map(difference).collect()
}

#[test]
fn cubes_are_products_of_segments() {
    for dimension in [1, 2, 6, 9] {
        let mut rows = cube(dimension);
        // The same cube, with equations that connect all unknowns.
        for at in 1..dimension {
            let before = rows[at - 1].clone();
            rows[at].iter_mut().zip(before).for_each(|(value, other)| *value = 2 * *value - 3 * other);
        }
        let cell = cell(&rows, 512);
        assert_eq!((cell.dimension(), cell.support().len()), (Some(dimension), 2 * dimension));
        assert_eq!(cell.parts().len(), dimension);
        for (at, part) in cell.parts().iter().enumerate() {
            assert_eq!((&part.unknowns, part.dimension), (&vec![at, dimension + at], 1));
            assert!(matches!(part.set, ExactSet::Segment { .. }));
        }
        assert_eq!(corners(&cell.set(512)), (1 << dimension, 0));
        assert_eq!(cell.set((1 << dimension) - 1), ExactSet::NotComputed);
    }
}

#[test]
fn simplices_and_cross_polytopes() {
    for dimension in [1, 2, 5, 12] {
        let simplex = cell(&[vec![1; dimension + 2]], 100);
        assert_eq!(simplex.dimension(), Some(dimension));
        assert_eq!(corners(&simplex.set(100)), (dimension + 1, 0));
    }
    // sum_k s_k (x_k - 1) + y_s = 1 for all signs s: 2^d facets, 2 d vertices; x_k >= 0 touches one of them.
    for dimension in [2, 3, 5] {
        let width = dimension + (1 << dimension);
        let facet = |signs: usize| {
            let sign = |at: usize| if signs >> at & 1 == 1 { 1 } else { -1 };
            let mut entries: Vec<(usize, i64)> = (0..dimension).map(|at| (at, sign(at))).collect();
            entries.push((width, 1 + entries.iter().map(|(_, sign)| sign).sum::<i64>()));
            entries.push((dimension + signs, 1));
            unit(width, &entries)
        };
        let rows: Vec<Vec<i64>> = (0..1 << dimension).map(facet).collect();
        let cell = cell(&rows, 1000);
        assert_eq!((cell.dimension(), cell.parts().len()), (Some(dimension), 1));
        assert_eq!(corners(&cell.set(1000)), (2 * dimension, 0), "{dimension}");
    }
}

#[test]
fn facets_of_cyclic_polytopes() {
    // n / (n - m) binomial(n - m, m) for d = 2 m (upper bound theorem; Ziegler, Lectures on Polytopes,
    // chapter 8; by Gale's evenness condition).
    for (points, degree, facets) in [(8, 4, 20), (9, 4, 27), (10, 2, 10), (12, 6, 112)] {
        let mut rows = nonnegative_polynomials(points, degree);
        let cone = cell(&rows, 1000);
        assert_eq!((cone.dimension(), cone.support().len()), (Some(degree + 1), points));
        assert_eq!(corners(&cone.set(1000)), (1, facets));
        rows.push(vec![1; points + 1]);
        let polytope = cell(&rows, 1000);
        assert_eq!(polytope.dimension(), Some(degree));
        assert_eq!(corners(&polytope.set(1000)), (facets, 0));
    }
}

#[test]
fn doubly_stochastic_matrices_have_permutations_as_vertices() {
    for (size, factorial) in [(2, 2), (3, 6), (4, 24), (5, 120)] {
        let cell = cell(&doubly_stochastic(size), 400);
        assert_eq!((cell.dimension(), cell.parts().len()), (Some((size - 1).pow(2)), 1));
        let set = cell.set(400);
        assert_eq!(corners(&set), (factorial, 0));
        assert!(set.vertices().iter().all(|vertex| vertex.iter().all(|x| x.is_zero() || *x == RBig::ONE)));
    }
}

#[test]
fn too_many_corners_leave_dimension_support_and_a_vertex() {
    let cell = cell(&doubly_stochastic(5), 100);
    assert_eq!((cell.dimension(), cell.support()), (Some(16), (0..25).collect()));
    assert_eq!((cell.parts().len(), cell.set(1000)), (1, ExactSet::NotComputed));
    let vertex = &cell.parts()[0].vertex;
    assert_eq!(vertex.iter().filter(|value| **value == RBig::ONE).count(), 5);
    assert_eq!(vertex.iter().filter(|value| value.is_zero()).count(), 20);
    let inside = cell.inside().expect("not empty");
    assert!(inside.iter().all(|value| *value > RBig::ZERO));
    assert_eq!(inside[..5].iter().fold(RBig::ZERO, |sum, value| sum + value), RBig::ONE);
}

#[test]
fn unbounded_flat_and_empty_cells() {
    // No equation between them: an orthant.
    let orthant = Cell::of_columns(&[vec![], vec![], vec![]], &[], 10, &mut || true).expect("small");
    assert_eq!((orthant.dimension(), orthant.parts().len()), (Some(3), 3));
    assert_eq!(corners(&orthant.set(10)), (1, 3));
    // y_0 = y_1 + 1, y_2 fixed.
    let ray = cell(&[vec![1, -1, 0, 1], vec![0, 0, 2, 3]], 10);
    let fixed = RBig::from_parts(3.into(), 2_u8.into());
    let (one, none) = (RBig::ONE, RBig::ZERO);
    let (from, direction) = (vec![one.clone(), none.clone(), fixed], vec![one.clone(), one, none]);
    assert_eq!(ray.set(10), ExactSet::Ray { from, direction });
    assert_eq!((ray.dimension(), ray.parts().len()), (Some(1), 2));
    // y_0 + y_1 = y_2 and y_2 + y_3 = 0: only y_4 and y_5 vary.
    let flat = cell(&[vec![1, 1, -1, 0, 0, 0, 0], vec![0, 0, 1, 1, 0, 0, 0], vec![3, 0, 0, 1, 1, 2, 2]], 10);
    assert_eq!((flat.dimension(), flat.support()), (Some(1), vec![4, 5]));
    // Contradictory equations, and signs that do not fit.
    for rows in [vec![vec![1, 1, 1], vec![2, 2, 3]], vec![vec![1, 2, -1]], vec![vec![0, 0, 1]]] {
        let empty = cell(&rows, 10);
        assert_eq!((empty.is_empty(), empty.dimension(), empty.set(10)), (true, None, ExactSet::Empty));
    }
}

#[test]
fn work_ends_when_it_is_told_to() {
    let rows = doubly_stochastic(4);
    let mut calls = 0;
    let mut count = || {
        calls += 1;
        true
    };
    assert!(cell_while(&rows, 100, &mut count).is_some());
    for most in [0, 1, 10, calls / 2, calls - 1] {
        let mut asked = 0;
        let mut proceed = || {
            asked += 1;
            asked <= most
        };
        assert_eq!(cell_while(&rows, 100, &mut proceed), None);
        assert!(asked <= most + 20, "{asked} {most}");
    }
}

/// Vertices and extreme directions by trying every choice of columns, in order.
fn by_trying_all(rows: &[Vec<i64>]) -> [Vec<Vec<RBig>>; 2] {
    let rational = |row: &Vec<i64>| row.iter().map(|&value| RBig::from(value)).collect::<Vec<_>>();
    let equations: Vec<Vec<RBig>> = rows.iter().map(rational).collect();
    let width = equations[0].len() - 1;
    // Extreme directions are the vertices of {y >= 0, A y = 0, sum y = 1}.
    let mut homogeneous = equations.clone();
    homogeneous.iter_mut().for_each(|row| row[width] = RBig::ZERO);
    homogeneous.push(vec![RBig::ONE; width + 1]);
    let directions = basic_solutions(&homogeneous).into_iter().map(|direction| {
        let largest = direction.iter().max().expect("an unknown").clone();
        direction.into_iter().map(|value| value / &largest).collect()
    });
    let mut all = [basic_solutions(&equations), directions.collect::<Vec<Vec<RBig>>>()];
    all.iter_mut().for_each(|points| points.sort());
    all
}

/// The dimension of the affine hull.
fn dimension([vertices, directions]: &[Vec<Vec<RBig>>; 2]) -> usize {
    let base = &vertices[0];
    let edges =
        vertices[1..].iter().map(|vertex| vertex.iter().zip(base).map(|(one, other)| one - other).collect());
    let mut rows: Vec<Vec<RBig>> = edges.chain(directions.iter().cloned()).collect();
    let mut rank = 0;
    for column in 0..base.len() {
        let Some(found) = (rank..rows.len()).find(|&row| !rows[row][column].is_zero()) else { continue };
        rows.swap(rank, found);
        let pivot = rows[rank].clone();
        for row in &mut rows[rank + 1..] {
            let factor = &row[column] / &pivot[column];
            row.iter_mut().zip(&pivot).for_each(|(value, other)| *value -= &factor * other);
        }
        rank += 1;
    }
    rank
}

fn equations() -> impl Strategy<Value = Vec<Vec<i64>>> {
    (1..=4_usize, 1..=7_usize).prop_flat_map(|(count, width)| {
        let row =
            prop::collection::vec(prop_oneof![3 => Just(0_i64), 4 => -1..=1_i64, 1 => -9..=9_i64], width + 1);
        prop::collection::vec(row, count)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn corners_are_those_found_by_trying_every_choice(rows in equations()) {
        let cell = cell(&rows, 1000);
        let expected = by_trying_all(&rows);
        prop_assert_eq!(cell.is_empty(), expected[0].is_empty());
        if cell.is_empty() {
            return Ok(());
        }
        let set = cell.set(1000);
        let mut found = [set.vertices(), set.directions()].map(|points| points.into_iter().cloned().collect::<Vec<_>>());
        found.iter_mut().for_each(|points| points.sort());
        prop_assert_eq!(&found, &expected);
        prop_assert_eq!(cell.dimension(), Some(dimension(&expected)));
        let grows = |at: &usize| expected.iter().flatten().any(|point| !point[*at].is_zero());
        prop_assert_eq!(cell.support(), (0..rows[0].len() - 1).filter(grows).collect::<Vec<_>>());
        let inside = cell.inside().expect("not empty");
        let solves = |row: &Vec<i64>| {
            let (right, row) = row.split_last().expect("a right-hand side");
            let sum = row.iter().zip(&inside).fold(RBig::ZERO, |sum, (&at, x)| sum + x * RBig::from(at));
            sum == RBig::from(*right)
        };
        prop_assert!(rows.iter().all(solves));
        let positive = |at: &usize| inside[*at] > RBig::ZERO;
        prop_assert_eq!(cell.support(), (0..inside.len()).filter(positive).collect::<Vec<_>>());
        prop_assert!(inside.iter().all(|value| *value >= RBig::ZERO));
        for part in cell.parts() {
            prop_assert!(part.set.vertices().contains(&&part.vertex));
        }
    }
}
