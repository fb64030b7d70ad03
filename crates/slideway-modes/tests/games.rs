//! All equilibria of bimatrix games against an independent method in rational numbers, and against games whose
//! equilibria are known.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use dashu_ratio::RBig;
use nalgebra::{DMatrix, dmatrix};
use proptest::prelude::*;
use slideway_modes::raw_problem::{RawProblem, RawReport, Unknowns, solve};
use slideway_modes::{Proof, SearchOptions, Status};

fn solved(a: &DMatrix<f64>, b: &DMatrix<f64>) -> RawReport {
    let game = RawProblem::Game { a: a.clone(), b: b.clone() };
    solve(&game, &SearchOptions::default(), 10_000, &mut |_| ControlFlow::Continue(())).expect("finite")
}

/// Strategies with the payoff that they give the other player, each rounded: vertices of one player's part.
type Strategies = Vec<Vec<f64>>;

/// The sets of a report: of each, the vertices of both players' parts.
fn sets(report: &RawReport) -> Vec<[Strategies; 2]> {
    let points = report.solutions.iter().map(|solution| {
        let Unknowns::Strategies { x, y, payoff_1, payoff_2 } = &solution.unknowns else { panic!("a game") };
        let with = |strategy: &[f64], payoff: &Option<f64>| [strategy, payoff.as_slice()].concat();
        [vec![with(x, payoff_2)], vec![with(y, payoff_1)]]
    });
    let continua = report.continua.iter().map(|continuum| {
        let [rows, columns] = continuum.parts.as_slice() else { panic!("two players") };
        [rows, columns].map(|part| {
            assert!(part.directions.is_empty() && part.vertex_count == part.vertices.len());
            let named = |vertex: &Unknowns| {
                vertex.named().into_iter().flat_map(|(_, values)| values).copied().collect()
            };
            part.vertices.iter().map(named).collect()
        })
    });
    points.chain(continua).collect()
}

/// A vertex of the polyhedron of a player's strategies and the best payoffs against them, and its labels: bit
/// `k` of pure strategy `k` that is not played, or is a best response.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Vertex {
    strategy: Vec<RBig>,
    payoff: RBig,
    labels: u32,
}

fn rational(value: f64) -> RBig {
    RBig::try_from(value).expect("finite")
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

/// All vertices of `{(x, v): x >= 0, sum x = 1, payoffs^T x <= v}`, by every choice of tight constraints. The
/// labels of `x` begin at `own`, those of the other player's pure strategies at `other`.
fn vertices(payoffs: &DMatrix<f64>, (own, other): (usize, usize)) -> Vec<Vertex> {
    let (m, n) = payoffs.shape();
    let unit = |at: usize| (0..=m).map(move |k| if k == at { RBig::ONE } else { RBig::ZERO });
    // Constraints are coefficients of (x, v) with the right-hand side zero.
    let constraint = |at: usize| -> Vec<RBig> {
        if at < m {
            return unit(at).collect();
        }
        let column = payoffs.column(at - m);
        column.iter().map(|&entry| -rational(entry)).chain([RBig::ONE]).collect()
    };
    let mut found = BTreeSet::new();
    for tight in (0_u32..1 << (m + n)).filter(|tight| tight.count_ones() as usize == m) {
        let chosen = (0..m + n).filter(|at| tight >> at & 1 == 1);
        let mut rows: Vec<Vec<RBig>> =
            chosen.map(|at| constraint(at).into_iter().chain([RBig::ZERO]).collect()).collect();
        let sum = (0..=m).map(|at| if at < m { RBig::ONE } else { RBig::ZERO });
        rows.push(sum.chain([RBig::ONE]).collect());
        let Some(point) = unique_solution(rows) else { continue };
        let slack = |at: usize| {
            constraint(at).iter().zip(&point).map(|(c, p)| c * p).fold(RBig::ZERO, |sum, term| sum + term)
        };
        let slacks: Vec<RBig> = (0..m + n).map(slack).collect();
        if slacks.iter().all(|slack| *slack >= RBig::ZERO) {
            let zero = (0..m + n).filter(|&at| slacks[at].is_zero());
            let labels = zero.map(|at| 1 << if at < m { own + at } else { other + at - m }).sum();
            found.insert(Vertex { strategy: point[..m].to_vec(), payoff: point[m].clone(), labels });
        }
    }
    found.into_iter().collect()
}

/// All maximal sets of equilibria, as pairs of vertices: the maximal complete bipartite subgraphs of the graph
/// of extreme equilibria, whose edges are pairs of vertices that together have every label (Winkels, 1979;
/// Avis, Rosenberg, Savani and von Stengel, Economic Theory 42 (2010)).
fn maximal_sets(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Vec<[Vec<Vertex>; 2]> {
    let (m, n) = a.shape();
    let rows = vertices(b, (0, m));
    let columns = vertices(&a.transpose(), (m, 0));
    let all = (1_u32 << (m + n)) - 1;
    let beside = |row: &Vertex| -> BTreeSet<usize> {
        (0..columns.len()).filter(|&at| row.labels | columns[at].labels == all).collect()
    };
    let neighbours: Vec<BTreeSet<usize>> = rows.iter().map(beside).collect();
    // Closed sets of neighbours: all intersections.
    let mut closed: BTreeSet<BTreeSet<usize>> = BTreeSet::new();
    for own in &neighbours {
        let met: Vec<BTreeSet<usize>> = closed.iter().map(|one| one & own).chain([own.clone()]).collect();
        closed.extend(met.into_iter().filter(|one| !one.is_empty()));
    }
    let set = |shared: BTreeSet<usize>| {
        let with_all = (0..rows.len()).filter(|&at| shared.is_subset(&neighbours[at]));
        let own: Vec<Vertex> = with_all.map(|at| rows[at].clone()).collect();
        [own, shared.into_iter().map(|at| columns[at].clone()).collect()]
    };
    closed.into_iter().map(set).collect()
}

/// Whether vertices are the same in some order, up to rounding: those of the games below differ by far more.
fn same(told: &Strategies, expected: &[Vertex]) -> bool {
    let near = |told: &[f64], expected: &Vertex| {
        let values = expected.strategy.iter().chain([&expected.payoff]);
        told.iter().zip(values).all(|(told, exact)| (told - exact.to_f64().value()).abs() <= 1e-13)
    };
    told.len() == expected.len() && expected.iter().all(|vertex| told.iter().any(|one| near(one, vertex)))
}

fn check(a: &DMatrix<f64>, b: &DMatrix<f64>) -> usize {
    let report = solved(a, b);
    assert_eq!(report.complete, Proof::Proven);
    let (told, expected) = (sets(&report), maximal_sets(a, b));
    assert_eq!(told.len(), expected.len(), "A {a} B {b} {told:?} {expected:?}");
    for [rows, columns] in &expected {
        let is_it = |set: &[Strategies; 2]| same(&set[0], rows) && same(&set[1], columns);
        assert!(told.iter().any(is_it), "A {a} B {b} {told:?} {expected:?}");
    }
    for solution in &report.solutions {
        assert!(solution.residual.is_some_and(|residual| residual <= 1e-15));
        assert!(solution.enclosure_radius.is_none_or(|radius| radius <= 1e-12));
    }
    expected.len()
}

/// Games of up to three pure strategies each, with few different payoffs: most of them are degenerate.
fn degenerate_games() -> impl Strategy<Value = (DMatrix<f64>, DMatrix<f64>)> {
    (1_usize..=3, 1_usize..=3).prop_flat_map(|(m, n)| {
        let payoffs = move || prop::collection::vec(-1..=2_i8, m * n);
        let matrix = move |entries: Vec<i8>| DMatrix::from_iterator(m, n, entries.into_iter().map(f64::from));
        (payoffs(), payoffs()).prop_map(move |(a, b)| (matrix(a), matrix(b)))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn all_equilibria_of_degenerate_games_are_found((a, b) in degenerate_games()) {
        check(&a, &b);
    }

    /// The sets of equilibria of a zero-sum game are one: the product of the optimal strategies.
    #[test]
    fn zero_sum_games_have_one_set_of_equilibria((a, _) in degenerate_games()) {
        prop_assert_eq!(check(&a, &-&a), 1);
    }
}

/// Avis, Rosenberg, Savani and von Stengel (2010), section 2: three equilibria; with 3 instead of 2 in the first row of
/// B, the game is degenerate and has a segment and a point.
#[test]
fn the_example_of_the_survey() {
    let a = dmatrix![3.0, 3.0; 2.0, 5.0; 0.0, 6.0];
    let b = dmatrix![3.0, 2.0; 2.0, 6.0; 3.0, 1.0];
    let report = solved(&a, &b);
    let expected = [
        ([1.0, 0.0, 0.0], [1.0, 0.0]),
        ([0.8, 0.2, 0.0], [2.0 / 3.0, 1.0 / 3.0]),
        ([0.0, 1.0 / 3.0, 2.0 / 3.0], [1.0 / 3.0, 2.0 / 3.0]),
    ];
    assert_eq!((report.status, report.count.as_str()), (Status::Several, "3"));
    for (x, y) in expected {
        let near = |one: &[f64], other: &[f64]| {
            one.iter().zip(other).all(|(one, other)| (one - other).abs() < 1e-15)
        };
        let is_it = |unknowns: &Unknowns| match unknowns {
            Unknowns::Strategies { x: told_x, y: told_y, .. } => near(told_x, &x) && near(told_y, &y),
            _ => false,
        };
        assert!(report.solutions.iter().any(|solution| is_it(&solution.unknowns)), "{report:?}");
    }
    let degenerate = dmatrix![3.0, 3.0; 2.0, 6.0; 3.0, 1.0];
    let report = solved(&a, &degenerate);
    assert_eq!((report.count.as_str(), report.continuum_count.as_str()), ("1", "1"));
    check(&a, &degenerate);
}

/// Games of `reference/games.toml`.
#[test]
fn games_with_many_equilibria() {
    #[derive(serde::Deserialize)]
    struct Games {
        game: Vec<Game>,
    }
    #[derive(serde::Deserialize)]
    struct Game {
        equilibria: usize,
        #[serde(rename = "A")]
        a: Vec<Vec<f64>>,
        #[serde(rename = "B")]
        b: Vec<Vec<f64>>,
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../reference/games.toml");
    let games: Games = toml::from_str(&std::fs::read_to_string(path).expect("a file")).expect("games");
    for Game { equilibria, a, b } in games.game {
        let matrix = |rows: Vec<Vec<f64>>| {
            DMatrix::from_fn(rows.len(), rows[0].len(), |row, column| rows[row][column])
        };
        let report = solved(&matrix(a), &matrix(b));
        assert_eq!((report.count, report.complete), (equilibria.to_string(), Proof::Proven));
        assert!(report.continua.is_empty());
    }
}

/// Every nonempty set of pure strategies is the support of one equilibrium (Quint and Shubik, 1997).
#[test]
fn coordination_games_have_an_equilibrium_for_every_support() {
    for n in 1..=6 {
        let identity = DMatrix::identity(n, n);
        let report = solved(&identity, &identity);
        assert_eq!((report.count.clone(), report.complete), (((1 << n) - 1).to_string(), Proof::Proven));
    }
}

/// Every pair of strategies is an equilibrium if all payoffs are equal.
#[test]
fn equal_payoffs_make_one_product_of_simplices() {
    for (payoff, m, n) in [(0.0, 2, 3), (-7.5, 1, 1), (1e300, 2, 2), (f64::MAX, 2, 2), (f64::MIN, 2, 1)] {
        let equal = DMatrix::from_element(m, n, payoff);
        let report = solved(&equal, &equal);
        assert_eq!((report.complete, report.partial), (Proof::Proven, false));
        let [[rows, columns]] = &sets(&report)[..] else { panic!("one set") };
        assert_eq!((rows.len(), columns.len()), (m, n));
        assert!(
            rows.iter().chain(columns).all(|vertex| vertex.last() == Some(&payoff)),
            "{payoff}: {rows:?}"
        );
    }
}

/// What a strategy that is not played falls short by depends on the other player's strategy: of two equilibria that differ in
/// the row player's strategy (by enumeration of vertices), each has its own payoff.
#[test]
fn ends_of_sets_have_their_own_payoffs() {
    check(&dmatrix![2.0, 0.0, 0.0; 2.0, 0.0, 0.0], &dmatrix![0.0, 1.0, -1.0; 2.0, 0.0, 2.0]);
    let a = dmatrix![-1.0, 0.0, 0.0; -1.0, 1.0, 0.0; 1.0, 0.0, -1.0];
    check(&a, &dmatrix![2.0, -1.0, 1.0; -1.0, 2.0, -1.0; 0.0, 1.0, 1.0]);
}
