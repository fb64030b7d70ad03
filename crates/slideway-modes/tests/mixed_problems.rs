//! Mixed complementarity problems: against elimination in rational numbers, state by state.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;
use slideway_modes::raw_problem::{EveryAnswer, RawProblem, RawReport, Unknowns, solve};
use slideway_modes::{Proof, SearchOptions, Status};

/// The free unknowns and `z`.
type Pair = (Vec<RBig>, Vec<RBig>);

const NONE: f64 = f64::INFINITY;

fn solved(problem: &RawProblem) -> RawReport {
    solve(problem, &SearchOptions::default(), 10_000, &mut |_| ControlFlow::Continue(())).expect("finite")
}

fn rational(value: f64) -> RBig {
    RBig::try_from(value).expect("finite")
}

/// Where an unknown is: at its lower bound, between its bounds, or at its upper bound.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Lower,
    Between,
    Upper,
}

/// Solutions `z` and `w` of `w = M z + q` with each unknown in its place, for all places that determine them
/// uniquely, and whether some places do not.
fn brute_force(m: &DMatrix<f64>, q: &DVector<f64>, bounds: &[(f64, f64)]) -> (BTreeSet<Pair>, bool) {
    let n = q.len();
    let (mut found, mut singular) = (BTreeSet::new(), false);
    for number in 0..3_usize.pow(u32::try_from(n).expect("few")) {
        let place = |k: usize| {
            [Place::Lower, Place::Between, Place::Upper]
                [number / 3_usize.pow(u32::try_from(k).expect("few")) % 3]
        };
        let exists = |k: usize| match place(k) {
            Place::Lower => bounds[k].0.is_finite(),
            Place::Upper => bounds[k].1.is_finite() && bounds[k].0 < bounds[k].1,
            // Between equal bounds, only w varies.
            Place::Between => bounds[k].0 < bounds[k].1,
        };
        if !(0..n).all(exists) {
            continue;
        }
        // z at its bound, or w = 0.
        let rows = (0..n).map(|k| {
            let unit = |value: f64| {
                (0..n)
                    .map(|at| if at == k { RBig::ONE } else { RBig::ZERO })
                    .chain([rational(value)])
                    .collect()
            };
            match place(k) {
                Place::Lower => unit(bounds[k].0),
                Place::Upper => unit(bounds[k].1),
                Place::Between => {
                    m.row(k).iter().map(|&entry| rational(entry)).chain([-rational(q[k])]).collect()
                }
            }
        });
        let Some(z) = unique_solution(rows.collect()) else {
            singular = true;
            continue;
        };
        let w: Vec<RBig> = (0..n)
            .map(|k| (0..n).fold(rational(q[k]), |sum, at| sum + rational(m[(k, at)]) * &z[at]))
            .collect();
        let holds = |k: usize| {
            let (lower, upper) = bounds[k];
            let above = lower.is_infinite() || z[k] >= rational(lower);
            let below = upper.is_infinite() || z[k] <= rational(upper);
            let at_lower = lower.is_finite() && z[k] == rational(lower);
            let at_upper = upper.is_finite() && z[k] == rational(upper);
            above && below && (w[k] <= RBig::ZERO || at_lower) && (w[k] >= RBig::ZERO || at_upper)
        };
        if (0..n).all(holds) {
            found.insert((z, w));
        }
    }
    (found, singular)
}

/// The solution of a square system, if there is exactly one.
fn unique_solution(mut rows: Vec<Vec<RBig>>) -> Option<Vec<RBig>> {
    let n = rows.len();
    for column in 0..n {
        let pivot = (column..n).find(|&row| !rows[row][column].is_zero())?;
        rows.swap(column, pivot);
        let leading = rows[column].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(at, _)| *at != column) {
            let factor = &row[column] / &leading[column];
            row.iter_mut().zip(&leading).for_each(|(entry, other)| *entry = &*entry - &factor * other);
        }
    }
    Some((0..n).map(|at| &rows[at][n] / &rows[at][at]).collect())
}

/// All `z` and `w` of a report's solutions, and of the vertices of its continua that have one part.
fn points(report: &RawReport) -> Vec<(Vec<f64>, Vec<f64>)> {
    let vertices = report.continua.iter().flat_map(|continuum| {
        let mut all = vec![(vec![0.0; report.size], vec![0.0; report.size])];
        for part in &continuum.parts {
            let with = |(z, w): &(Vec<f64>, Vec<f64>), vertex: &Unknowns| {
                let (mut z, mut w) = (z.clone(), w.clone());
                let (own_z, own_w) = pair(vertex);
                for (place, &index) in part.indices.iter().enumerate() {
                    (z[index], w[index]) = (own_z[place], own_w[place]);
                }
                (z, w)
            };
            all = all
                .iter()
                .flat_map(|one| part.vertices.iter().map(move |vertex| with(one, vertex)))
                .collect();
        }
        all
    });
    report.solutions.iter().map(|solution| pair(&solution.unknowns)).chain(vertices).collect()
}

/// `z` and `w`; free unknowns come first and have `w = 0`.
pub(crate) fn pair(unknowns: &Unknowns) -> (Vec<f64>, Vec<f64>) {
    match unknowns {
        Unknowns::Complementary { z, w } => (z.clone(), w.clone()),
        Unknowns::Mixed { u, z, w } => {
            ([u.clone(), z.clone()].concat(), [vec![0.0; u.len()], w.clone()].concat())
        }
        _ => panic!("z and w"),
    }
}

/// Compares a report with all places: every solution that is the only one of some places is told, as a solution
/// or as a vertex; if no place is singular, nothing else is. What singular places admit (a set, or one point, such as
/// 0 of x >= 0 and -x - z >= 0 with x free) is told besides, and satisfies the equations.
fn check(problem: &RawProblem, m: &DMatrix<f64>, q: &DVector<f64>, bounds: &[(f64, f64)]) {
    let report = solved(problem);
    assert_eq!((report.complete, report.partial), (Proof::Proven, false));
    let (expected, singular) = brute_force(m, q, bounds);
    let told = points(&report);
    let context = || format!("{problem:?} {report:#?} {expected:?}");
    let near = |told: &[f64], exact: &[RBig]| {
        let size = told.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
        told.iter().zip(exact).all(|(told, exact)| (told - exact.to_f64().value()).abs() <= 1e-13 * size)
    };
    for (z, w) in &expected {
        assert!(told.iter().any(|(told_z, told_w)| near(told_z, z) && near(told_w, w)), "{}", context());
    }
    if !singular {
        assert!(report.continua.is_empty(), "{}", context());
        assert_eq!(report.count, expected.len().to_string(), "{}", context());
        assert_eq!(report.solutions.len(), expected.len(), "{}", context());
    }
    for solution in &report.solutions {
        assert!(solution.residual.is_some_and(|residual| residual <= 1e-15), "{}", context());
        let (z, w) = pair(&solution.unknowns);
        // w, and the distance of z from a finite bound, are rounded once each.
        let distances =
            |at: usize| [bounds[at].0, bounds[at].1].into_iter().filter(|bound| bound.is_finite());
        let row = |k: usize| {
            let terms = (0..q.len()).map(|at| m[(k, at)] * z[at]).chain([q[k], -w[k]]);
            let (sum, size) =
                terms.fold((0.0, 0.0), |(sum, size), term: f64| (sum + term, size + term.abs()));
            let of_bounds =
                |at| distances(at).map(|bound| m[(k, at)].abs() * bound.abs()).fold(0.0, f64::max);
            (sum, size + (0..q.len()).map(of_bounds).sum::<f64>())
        };
        assert!((0..q.len()).map(row).all(|(left, size)| left.abs() <= 1e-14 * size), "{}", context());
        for (value, (lower, upper)) in z.iter().zip(bounds) {
            assert!(lower <= value && value <= upper, "{}", context());
        }
    }
}

/// Bounds of every sort, some of them no sums of few bits.
fn bound() -> impl Strategy<Value = (f64, f64)> {
    let (zero, free) = ((0.0, NONE), (-NONE, NONE));
    let one_sided = [zero, zero, zero, free, free, (-NONE, 1.0), (1.0 / 3.0, 1e17)];
    let two_sided = [(-1.0, 2.0), (0.1, 0.3), (-0.7, -0.1), (1.0, 1.0), (-0.1, -0.1)];
    prop::sample::select([&one_sided[..], &two_sided[..]].concat())
}

type Problem = (DMatrix<f64>, DVector<f64>, Vec<(f64, f64)>);

fn problems(entry: impl Strategy<Value = f64> + Clone + 'static) -> impl Strategy<Value = Problem> {
    (1_usize..=3).prop_flat_map(move |n| {
        let entries = |count| prop::collection::vec(entry.clone(), count);
        let matrix = entries(n * n).prop_map(move |all| DMatrix::from_vec(n, n, all));
        (matrix, entries(n).prop_map(DVector::from_vec), prop::collection::vec(bound(), n))
    })
}

fn mcp((m, q, bounds): &Problem) -> RawProblem {
    RawProblem::MixedComplementarity {
        m: m.clone(),
        q: q.clone(),
        lower: DVector::from_iterator(q.len(), bounds.iter().map(|bound| bound.0)),
        upper: DVector::from_iterator(q.len(), bounds.iter().map(|bound| bound.1)),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn all_solutions_within_bounds_are_found(problem in problems(-3.0..3.0_f64)) {
        check(&mcp(&problem), &problem.0, &problem.1, &problem.2);
    }

    #[test]
    fn all_solutions_of_degenerate_problems_are_found(problem in problems((-1..=1_i8).prop_map(f64::from))) {
        check(&mcp(&problem), &problem.0, &problem.1, &problem.2);
    }

    /// A mixed linear complementarity problem is one with bounds.
    #[test]
    fn all_solutions_with_free_unknowns_are_found((m, q, _) in problems((-1..=1_i8).prop_map(f64::from)), free in 0_usize..3) {
        let free = free.min(q.len());
        let bounds: Vec<(f64, f64)> = (0..q.len()).map(|at| (if at < free { -NONE } else { 0.0 }, NONE)).collect();
        let problem = RawProblem::MixedLinearComplementarity { m: m.clone(), q: q.clone(), free };
        check(&problem, &m, &q, &bounds);
    }
}

/// Minimise (x - 2)^2 / 2 + y^2 / 2 with x + y = 1, x >= 0, y >= 0: its conditions of optimality are
/// -u + (x - 2) = w_1, -u + y = w_2 and x + y - 1 = 0. By hand x = 1, y = 0, u = -1, w = (0, 1).
#[test]
fn the_conditions_of_a_quadratic_program() {
    let m = dmatrix![0.0, 1.0, 1.0; -1.0, 1.0, 0.0; -1.0, 0.0, 1.0];
    let problem = RawProblem::MixedLinearComplementarity { m, q: dvector![-1.0, -2.0, 0.0], free: 1 };
    let report = solved(&problem);
    assert_eq!((report.status, report.complete), (Status::One, Proof::Proven));
    let expected = Unknowns::Mixed { u: vec![-1.0], z: vec![1.0, 0.0], w: vec![0.0, 1.0] };
    assert_eq!(report.solutions[0].unknowns, expected);
}

/// The same constraint twice: only the sum of its multipliers is determined. The line u_1 + u_2 = -1 is one set, though
/// both signs change along it.
#[test]
fn multipliers_of_dependent_constraints_are_a_line() {
    let m = dmatrix![
        0.0, 0.0, 1.0, 1.0;
        0.0, 0.0, 1.0, 1.0;
        -1.0, -1.0, 1.0, 0.0;
        -1.0, -1.0, 0.0, 1.0];
    let problem = RawProblem::MixedLinearComplementarity { m, q: dvector![-1.0, -1.0, -2.0, 0.0], free: 2 };
    let report = solved(&problem);
    assert_eq!((report.status, report.complete), (Status::Continuum, Proof::Proven));
    let [continuum] = report.continua.as_slice() else { panic!("one continuum") };
    assert_eq!(continuum.pattern, "**+-");
    let [part] = continuum.parts.as_slice() else { panic!("one part") };
    let [Unknowns::Mixed { u, z, w }] = part.vertices.as_slice() else { panic!("one point") };
    assert_eq!((u[0] + u[1], z.as_slice(), w.as_slice()), (-1.0, &[1.0, 0.0][..], &[0.0, 1.0][..]));
    let directions: Vec<&Unknowns> = part.directions.iter().collect();
    let direction = |sign: f64| Unknowns::Mixed { u: vec![sign, -sign], z: vec![0.0; 2], w: vec![0.0; 2] };
    assert!(
        directions == [&direction(1.0), &direction(-1.0)]
            || directions == [&direction(-1.0), &direction(1.0)]
    );
    assert_eq!((report.continuum_count.as_str(), report.count.as_str()), ("1", "0"));
}

/// w = z - 5 on 0 <= z <= 3: at the upper bound, w = -2. On 0.1 <= z <= 0.3, w = z - 0.2 has its zero
/// between the bounds: the numbers are not rounded, so that z is exactly the number 0.2.
#[test]
fn bounds_hold_and_are_not_rounded() {
    let one = |m: f64, q: f64, bounds: (f64, f64)| solved(&mcp(&(dmatrix![m], dvector![q], vec![bounds])));
    let report = one(1.0, -5.0, (0.0, 3.0));
    assert_eq!(report.solutions[0].unknowns, Unknowns::Complementary { z: vec![3.0], w: vec![-2.0] });
    assert_eq!(report.solutions[0].signs, [1]);
    let report = one(1.0, -0.2, (0.1, 0.3));
    assert_eq!(report.solutions[0].unknowns, Unknowns::Complementary { z: vec![0.2], w: vec![0.0] });
    // 3 (1/3) is 1 only after rounding: w = 3 z - 1 is not zero at the bound.
    let third = 1.0 / 3.0;
    let report = one(3.0, -1.0, (third, third));
    assert_eq!((report.status, report.solutions[0].on_boundary), (Status::One, false));
    let report = one(3.0, -1.0, (third, NONE));
    assert!(!report.solutions[0].on_boundary);
}

/// Principal minors: [[2, 1], [1, 2]] is a P-matrix, [[1, 2], [2, 1]] is not. Without bounds only the whole
/// determinant counts, and between equal bounds none.
#[test]
fn uniqueness_for_every_q_depends_on_which_unknowns_have_bounds() {
    let answer = |m: DMatrix<f64>, bounds: [(f64, f64); 2]| {
        let problem = mcp(&(m, dvector![1.0, 1.0], bounds.to_vec()));
        problem.every_right_hand_side(&mut |_| ControlFlow::Continue(())).expect("finite").answer
    };
    let (p, not_p) = (dmatrix![2.0, 1.0; 1.0, 2.0], dmatrix![1.0, 2.0; 2.0, 1.0]);
    let (boxed, free, fixed) = ((-1.0, 1.0), (-NONE, NONE), (2.0, 2.0));
    assert_eq!(answer(p, [boxed, (0.0, NONE)]), EveryAnswer::One);
    assert_eq!(answer(not_p.clone(), [boxed, boxed]), EveryAnswer::NotOne);
    assert_eq!(answer(not_p.clone(), [free, free]), EveryAnswer::One);
    assert_eq!(answer(not_p, [boxed, fixed]), EveryAnswer::One);
}

/// How far `z` is from `z = median(l, z - w, u)` with `w = M z + q`, which exactly the solutions satisfy.
fn natural_residual(
    (m, q): (&DMatrix<f64>, &DVector<f64>),
    (lower, upper): (&DVector<f64>, &DVector<f64>),
    z: &[f64],
) -> f64 {
    let z = DVector::from_column_slice(z);
    let moved = &z - (m * &z + q);
    let clamped = moved.zip_zip_map(lower, upper, |value, lower, upper| value.max(lower).min(upper));
    (z - clamped).amax()
}

/// `M_ij = 1 / (1 + |i - j|)`, positive definite, rounded, with bounds at which nothing is exact: from an independent
/// review. It is monotone whatever the constants of its rows are, so that one pattern has its only solution.
#[test]
fn bounds_in_rounded_numbers_leave_a_problem_monotone() {
    for size in [10, 24] {
        let m = DMatrix::from_fn(size, size, |row, column| 1.0 / (1.0 + row.abs_diff(column) as f64));
        let q = DVector::from_fn(size, |at, _| [0.3, -0.6, 0.899_999_999_999_999_9, -1.2][at % 4]);
        let (lower, upper) = (DVector::repeat(size, -1.0), DVector::repeat(size, 1.0));
        let problem = RawProblem::MixedComplementarity {
            m: m.clone(),
            q: q.clone(),
            lower: lower.clone(),
            upper: upper.clone(),
        };
        let report = solved(&problem);
        assert_eq!((report.complete, report.status), (Proof::Proven, Status::One));
        // One for each constant, and one for all else.
        assert!(report.nodes <= 2 * size as u64 + 1, "{}", report.nodes);
        let [solution] = report.solutions.as_slice() else { panic!("one solution") };
        let Unknowns::Complementary { z, .. } = &solution.unknowns else { panic!("z and w") };
        assert!(natural_residual((&m, &q), (&lower, &upper), z) < 1e-13);
    }
}

/// `A` is unimodular, so that `u = -A^-1 (C z + a)` leaves a linear complementarity problem in whole numbers: it has the
/// same `z`, and free unknowns add hardly any nodes.
#[test]
fn free_unknowns_are_not_branched_on() {
    let size = 9;
    let mut nodes = [0, 0];
    for seed in 0..12_u64 {
        let mut random = crate::search_support::Random::new(seed);
        let free = 3 + random.below(12);
        let mut lower = DMatrix::<f64>::identity(free, free);
        let mut upper = lower.clone();
        for row in 0..free {
            for column in 0..row {
                lower[(row, column)] = random.integer(1);
                upper[(column, row)] = random.integer(1);
            }
        }
        let a = &lower * &upper;
        let integers = |random: &mut crate::search_support::Random, rows: usize, columns: usize| {
            DMatrix::from_fn(rows, columns, |_, _| random.integer(2))
        };
        let c = integers(&mut random, free, size);
        let d = integers(&mut random, size, free);
        let b = integers(&mut random, size, size);
        let (first, second) = (integers(&mut random, free, 1), integers(&mut random, size, 1));
        let mut m = DMatrix::zeros(free + size, free + size);
        m.view_mut((0, 0), (free, free)).copy_from(&a);
        m.view_mut((0, free), (free, size)).copy_from(&c);
        m.view_mut((free, 0), (size, free)).copy_from(&d);
        m.view_mut((free, free), (size, size)).copy_from(&b);
        let q = DVector::from_iterator(free + size, first.iter().chain(second.iter()).copied());
        let mixed = solved(&RawProblem::MixedLinearComplementarity { m, q, free });
        // Substitution in whole numbers: L U x = right.
        let solve_a = |right: &DMatrix<f64>| {
            let forward = lower.solve_lower_triangular(right).expect("unit diagonal");
            upper.solve_upper_triangular(&forward).expect("unit diagonal")
        };
        let reduced = RawProblem::LinearComplementarity {
            m: &b - &d * solve_a(&c),
            q: (&second - &d * solve_a(&first)).column(0).into_owned(),
        };
        let reduced = solved(&reduced);
        assert_eq!((mixed.complete, reduced.complete), (Proof::Proven, Proof::Proven), "{seed}");
        let counts = |report: &RawReport| (report.count.clone(), report.continuum_count.clone());
        assert_eq!(counts(&mixed), counts(&reduced), "{seed}");
        let z = |report: &RawReport| -> BTreeSet<Vec<String>> {
            let of = |unknowns: &Unknowns| match unknowns {
                Unknowns::Complementary { z, .. } | Unknowns::Mixed { z, .. } => {
                    z.iter().map(|value| format!("{value:.8}")).collect()
                }
                other => panic!("{other:?}"),
            };
            report.solutions.iter().map(|solution| of(&solution.unknowns)).collect()
        };
        assert_eq!(z(&mixed), z(&reduced), "{seed}");
        nodes[0] += mixed.nodes;
        nodes[1] += reduced.nodes;
    }
    assert!(nodes[0] <= 2 * nodes[1], "{nodes:?}");
}

fn solved_json(json: &str) -> RawReport {
    solved(&RawProblem::from_json(json.as_bytes()).expect("a problem"))
}

/// A bound of -1e9 is subtracted and added again, and numbers of very different size make a pattern nearly singular.
/// Elimination in fractions (Python's) gives these values for these very numbers.
#[test]
fn values_beside_sums_that_lose_digits_are_as_accurate_as_others() {
    let report = solved_json(
        r#"{"type": "mcp", "M": [[-1.0000000000000002, -5e-324, -5e-324, 1], [-1.0000000000000002, 2, -5e-324, 1.000000001],
            [-5e-324, 1, 0.9999999999999999, 0], [-1, 0, 0.9999999999999999, -1.0000000000000002]],
            "q": [5e-324, 1, 0.9999999999999999, 1], "l": [-1, 0, -1, -1e9], "u": [1, 2, 2, 0]}"#,
    );
    let between =
        report.solutions.iter().find(|solution| solution.signs == [1, 0, -1, 0]).expect("a solution");
    let Unknowns::Complementary { z, w } = &between.unknowns else { panic!("z and w") };
    assert_eq!((z[1], z[3], w[0]), (0.500_000_000_499_999_9, -0.999_999_999_999_999_7, -2.0));
    assert!(between.enclosure_radius.is_some_and(|radius| radius <= f64::EPSILON), "{between:?}");
    let report = solved_json(
        r#"{"type": "mlcp", "A": [[0, -1e16], [0, -1000]], "C": [[2, -0.003, 0], [1, 1e16, -3.0000000000000004e-8]],
            "D": [[1, 1], [2e8, 2e16], [0, -3000]], "B": [[0, -3000, -3000], [-1000, 1e-16, -1], [1, -3e8, 2e-16]],
            "a": [2e16, -99998000], "b": [4.99803, -4.00000000004e16, 6003]}"#,
    );
    let zero =
        report.solutions.iter().find(|solution| solution.signs[2..] == [-1, 1, 1]).expect("a solution");
    let Unknowns::Mixed { u, z, w } = &zero.unknowns else { panic!("u, z and w") };
    let told = [u[0], z[2], w[0]];
    assert_eq!(told, [0.002_000_000_000_000_064_7, 1.285_714_298_571_428_3e-8, 6.999_961_428_571_042_5]);
    assert!(zero.enclosure_radius.is_some_and(|radius| radius < 1e-15), "{zero:?}");
}

/// z = l, whatever its size.
#[test]
fn a_bound_has_its_number() {
    let report = solved_json(r#"{"type": "mcp", "M": [[1]], "q": [1e-9], "l": [5e-324], "u": [1]}"#);
    let [solution] = report.solutions.as_slice() else { panic!("one solution") };
    let Unknowns::Complementary { z, .. } = &solution.unknowns else { panic!("z and w") };
    assert_eq!((z.as_slice(), solution.beyond_range.len()), (&[5e-324][..], 0));
}
