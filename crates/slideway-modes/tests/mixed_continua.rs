//! Continua of mixed problems: faces of polyhedra with free unknowns, against elimination in rational numbers.
//!
//! With the states of the pairs chosen, the solutions are a polyhedron whose free unknowns have no bounds. If the
//! columns of the free unknowns have a null space of dimension `l`, its smallest faces are the sets `T` of other columns
//! such that `T` and the free columns have no more, and that a solution has positive values in all of `T`; its directions,
//! up to the null space, are those `T` with one dimension more and a null vector that is positive in all of `T`.

use crate::mixed_problems::pair;
use std::collections::BTreeSet;
use std::ops::ControlFlow;

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use slideway_modes::raw_problem::{RawContinuum, RawProblem, Unknowns, solve};
use slideway_modes::{Proof, SearchOptions};

/// The sort of an unknown `z_k`.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sort {
    /// `w_k = 0`.
    Free,
    /// `z_k >= 0`, `w_k >= 0`.
    Above,
    /// `z_k = 1`, `w_k` of either sign.
    Fixed,
}

/// A column of the equations `w - M z = q`: of `z_k` or of `w_k`.
type Name = (bool, usize);

/// A maximal set of solutions.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Face {
    /// The columns that are not free, and positive somewhere.
    positive: BTreeSet<Name>,
    /// The positive columns, with their values in billionths, of a point of each smallest face.
    points: BTreeSet<Vec<(Name, i64)>>,
    /// The columns of each direction that are not free.
    directions: BTreeSet<Vec<Name>>,
    /// The dimension of the null space of the free columns.
    lines: usize,
}

impl Face {
    fn is_continuum(&self) -> bool {
        self.lines > 0 || self.points.len() > 1 || !self.directions.is_empty()
    }
}

struct Equations {
    m: DMatrix<f64>,
    q: DVector<f64>,
    sorts: Vec<Sort>,
}

impl Equations {
    fn column(&self, (is_w, at): Name) -> Vec<RBig> {
        let entry = |row: usize| if is_w { f64::from(u8::from(row == at)) } else { -self.m[(row, at)] };
        (0..self.q.len()).map(|row| rational(entry(row))).collect()
    }

    fn right(&self) -> Vec<RBig> {
        let fixed = (0..self.q.len()).filter(|&at| self.sorts[at] == Sort::Fixed);
        let fixed: Vec<usize> = fixed.collect();
        let row = |row: usize| self.q[row] + fixed.iter().map(|&at| self.m[(row, at)]).sum::<f64>();
        (0..self.q.len()).map(|at| rational(row(at))).collect()
    }

    /// The columns that are free.
    fn free(&self) -> Vec<Name> {
        let name = |(at, sort): (usize, &Sort)| match sort {
            Sort::Free => Some((false, at)),
            Sort::Fixed => Some((true, at)),
            Sort::Above => None,
        };
        self.sorts.iter().enumerate().filter_map(name).collect()
    }

    /// All faces whose sides are compatible and that are not part of others.
    fn faces(&self) -> Vec<Face> {
        let pairs: Vec<usize> = (0..self.q.len()).filter(|&at| self.sorts[at] == Sort::Above).collect();
        let choices = (0..1_usize << pairs.len()).map(|choice| {
            pairs.iter().enumerate().map(|(place, &at)| (choice >> place & 1 == 1, at)).collect::<Vec<Name>>()
        });
        let all: BTreeSet<Face> = choices.filter_map(|columns| self.face(&columns)).collect();
        let is_largest = |face: &&Face| {
            !all.iter().any(|other| other != *face && face.positive.is_subset(&other.positive))
        };
        all.iter().filter(is_largest).cloned().collect()
    }

    /// The solutions in which these columns and the free ones are positive at most; `None` if there are none.
    fn face(&self, columns: &[Name]) -> Option<Face> {
        let free = self.free();
        let lines = self.solved(&free).1.len();
        let mut face =
            Face { positive: BTreeSet::new(), points: BTreeSet::new(), directions: BTreeSet::new(), lines };
        for choice in 0..1_usize << columns.len() {
            let own: Vec<Name> =
                (0..columns.len()).filter(|at| choice >> at & 1 == 1).map(|at| columns[at]).collect();
            let (point, null) = self.solved(&[own.clone(), free.clone()].concat());
            let is_positive = |values: &[RBig]| values[..own.len()].iter().all(|value| *value > RBig::ZERO);
            if null.len() == lines
                && let Some(point) = point.filter(|point| is_positive(point))
            {
                let values = point.iter().map(|value| billionths(value.to_f64().value()));
                face.points.insert(own.iter().copied().zip(values).collect());
            } else if null.len() == lines + 1 && !own.is_empty() {
                let varies = |vector: &&Vec<RBig>| vector[..own.len()].iter().any(|value| !value.is_zero());
                let vector = null.iter().find(varies);
                let signs = vector.map(|one| [one.clone(), one.iter().map(|value| -value.clone()).collect()]);
                if signs.is_some_and(|signs| signs.iter().any(|vector| is_positive(vector))) {
                    face.directions.insert(own);
                }
            }
        }
        let of_points = face.points.iter().flatten().map(|(name, _)| *name);
        face.positive = of_points.chain(face.directions.iter().flatten().copied()).collect();
        (!face.points.is_empty()).then_some(face)
    }

    /// A solution in some columns, if there is one, and a basis of the null space of these columns.
    fn solved(&self, names: &[Name]) -> (Option<Vec<RBig>>, Vec<Vec<RBig>>) {
        let columns: Vec<Vec<RBig>> = names.iter().map(|&name| self.column(name)).collect();
        let mut rows: Vec<Vec<RBig>> = self
            .right()
            .into_iter()
            .enumerate()
            .map(|(row, right)| columns.iter().map(|column| column[row].clone()).chain([right]).collect())
            .collect();
        let mut pivots: Vec<usize> = Vec::new();
        for column in 0..names.len() {
            let done = pivots.len();
            let Some(pivot) = (done..rows.len()).find(|&row| !rows[row][column].is_zero()) else { continue };
            rows.swap(done, pivot);
            let leading: Vec<RBig> = rows[done].iter().map(|entry| entry / &rows[done][column]).collect();
            for (at, row) in rows.iter_mut().enumerate() {
                let factor = if at == done { &row[column] - RBig::ONE } else { row[column].clone() };
                row.iter_mut().zip(&leading).for_each(|(entry, other)| *entry = &*entry - &factor * other);
            }
            pivots.push(column);
        }
        let with = |of: &dyn Fn(usize) -> RBig, one: Option<usize>| {
            let mut values = vec![RBig::ZERO; names.len()];
            one.into_iter().for_each(|column| values[column] = RBig::ONE);
            pivots.iter().enumerate().for_each(|(row, &column)| values[column] = of(row));
            values
        };
        let solvable = rows[pivots.len()..].iter().all(|row| row[names.len()].is_zero());
        let point = solvable.then(|| with(&|row| rows[row][names.len()].clone(), None));
        let null = (0..names.len()).filter(|column| !pivots.contains(column));
        let null = null.map(|column| with(&|row| -rows[row][column].clone(), Some(column))).collect();
        (point, null)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "small")]
fn billionths(value: f64) -> i64 {
    (1e9 * value).round() as i64
}

fn rational(value: f64) -> RBig {
    RBig::try_from(value).expect("finite")
}

/// The face that a continuum tells: parts vary independently.
fn told(continuum: &RawContinuum, equations: &Equations) -> Face {
    let mut face = Face {
        positive: BTreeSet::new(),
        points: BTreeSet::from([Vec::new()]),
        directions: BTreeSet::new(),
        lines: 0,
    };
    for part in &continuum.parts {
        let positive = |one: &Unknowns| {
            let (z, w) = pair(one);
            let mut own: Vec<(Name, i64)> = Vec::new();
            for (place, &at) in part.indices.iter().enumerate() {
                let both = [((false, at), z[place]), ((true, at), w[place])];
                let not_zero = both.into_iter().filter(|(_, value)| *value != 0.0);
                own.extend(not_zero.map(|(name, value)| (name, billionths(value))));
            }
            own.retain(|((_, at), _)| equations.sorts[*at] == Sort::Above);
            own
        };
        let vertices: Vec<Vec<(Name, i64)>> = part.vertices.iter().map(positive).collect();
        let with = |point: &Vec<(Name, i64)>| {
            let points = vertices.iter().map(|own| [point.clone(), own.clone()].concat());
            points.collect::<Vec<_>>()
        };
        face.points = face.points.iter().flat_map(with).collect();
        for direction in &part.directions {
            let own: Vec<Name> = positive(direction).into_iter().map(|(name, _)| name).collect();
            if own.is_empty() {
                face.lines += 1;
            } else {
                face.directions.insert(own);
            }
        }
    }
    assert_eq!(face.lines % 2, 0, "both directions of each line");
    face.lines /= 2;
    face.points = face.points.into_iter().map(sorted).collect();
    face.directions = face.directions.into_iter().map(sorted).collect();
    let of_points = face.points.iter().flatten().map(|(name, _)| *name);
    face.positive = of_points.chain(face.directions.iter().flatten().copied()).collect();
    face
}

fn sorted<T: Ord>(mut list: Vec<T>) -> Vec<T> {
    list.sort();
    list
}

/// The continua of a problem are the faces that are not points.
fn check(problem: &RawProblem, equations: &Equations) {
    let report = solve(problem, &SearchOptions::default(), 10_000, &mut |_| ControlFlow::Continue(()));
    let report = report.expect("finite");
    assert_eq!((report.complete, report.partial), (Proof::Proven, false));
    let sort = |mut face: Face| {
        face.points = face.points.into_iter().map(sorted).collect();
        face.directions = face.directions.into_iter().map(sorted).collect();
        face
    };
    let (continua, points): (Vec<Face>, Vec<Face>) =
        equations.faces().into_iter().map(sort).partition(Face::is_continuum);
    let told: BTreeSet<Face> = report.continua.iter().map(|continuum| told(continuum, equations)).collect();
    let context = || format!("{problem:?}\n{report:#?}\n{continua:#?}");
    assert_eq!(report.continuum_count, continua.len().to_string(), "{}", context());
    assert_eq!(told, continua.iter().cloned().collect(), "{}", context());
    assert_eq!(report.count, points.len().to_string(), "{}", context());
}

fn numbers(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec((-1..=1_i8).prop_map(f64::from), count)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn continua_with_free_unknowns_are_whole(
        (n, m, q) in (1_usize..=5).prop_flat_map(|n| (Just(n), numbers(n * n), numbers(n))),
        free in 0_usize..4,
    ) {
        let free = free.min(n);
        let sorts = (0..n).map(|at| if at < free { Sort::Free } else { Sort::Above }).collect();
        let (m, q) = (DMatrix::from_vec(n, n, m), DVector::from_vec(q));
        let problem = RawProblem::MixedLinearComplementarity { m: m.clone(), q: q.clone(), free };
        check(&problem, &Equations { m, q, sorts });
    }

    #[test]
    fn continua_with_fixed_unknowns_are_whole(
        (n, m, q) in (1_usize..=4).prop_flat_map(|n| (Just(n), numbers(n * n), numbers(n))),
        sorts in prop::collection::vec(prop::sample::select(vec![Sort::Free, Sort::Above, Sort::Above, Sort::Fixed]), 4),
    ) {
        let sorts = sorts[..n].to_vec();
        let (m, q) = (DMatrix::from_vec(n, n, m), DVector::from_vec(q));
        let bound = |free: f64, at_most: f64| {
            let bound = |sort: &Sort| match sort {
                Sort::Free => free,
                Sort::Above => at_most,
                Sort::Fixed => 1.0,
            };
            DVector::from_iterator(n, sorts.iter().map(bound))
        };
        let (lower, upper) = (bound(f64::NEG_INFINITY, 0.0), bound(f64::INFINITY, f64::INFINITY));
        let problem = RawProblem::MixedComplementarity { m: m.clone(), q: q.clone(), lower, upper };
        check(&problem, &Equations { m, q, sorts });
    }
}
