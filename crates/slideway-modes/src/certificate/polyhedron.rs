//! The exact set of solutions that a singular pattern admits.

use std::collections::HashSet;

use dashu_ratio::RBig;
use nalgebra::DVector;

use super::elimination::Echelon;
use crate::combinations::{binomial, combinations};
use crate::interval::Interval;
use crate::problem::{ContactState, SolutionSet};

/// All admissible solutions of a singular pattern's equations: `y_k >= 0`, and `0 <= lambda_k <= 1` for a
/// contact in its gap. Points and directions have one entry per contact, `y_k` or `lambda_k`.
pub type ExactSet = SolutionSet<Vec<RBig>>;

impl ExactSet {
    /// The signed normal forces `N_k = sigma_k y_k` of the set, rounded; shares are omitted, so points that
    /// differ only in them coincide.
    ///
    /// For a pattern with several contacts in their gaps, the vertices may include points that are not
    /// corners once the shares are omitted.
    pub fn normal_forces(&self, pattern: &[ContactState]) -> SolutionSet {
        if *self == Self::NotComputed {
            return SolutionSet::NotComputed;
        }
        let vertices = distinct(self.vertices().into_iter().map(|point| signed_forces(point, pattern)));
        let directions = distinct(self.directions().into_iter().filter_map(|direction| {
            let forces = signed_forces(direction, pattern);
            scaled_to_one(forces)
        }));
        SolutionSet::from_corners(vertices, directions)
            .map(|point| DVector::from_iterator(point.len(), point.iter().map(nearest)))
    }

    /// The set for equations in echelon form. It is not computed if that takes more than `bases` trials, or
    /// once `proceed` is `false`.
    pub(super) fn of_echelon(
        echelon: &Echelon,
        pattern: &[ContactState],
        bases: u64,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Self {
        if !echelon.is_consistent() {
            return Self::Empty;
        }
        let limits = WorkLimits::new(echelon, pattern);
        // The set contains no line, so it is empty exactly if it has no vertex.
        let corners = limits.corners(bases, proceed);
        corners.map_or(Self::NotComputed, |corners| Self::from_corners(corners.vertices, corners.directions))
    }
}

/// Vertices and extreme directions.
struct Corners {
    vertices: Vec<Vec<RBig>>,
    directions: Vec<Vec<RBig>>,
}

/// The solutions of the independent equations, `z_k = constant_k + sum_f coefficient_kf t_f`, where
/// the parameters `t` are the unknowns without a pivot, and the limits `z_k >= 0`, `lambda_k <= 1`.
struct WorkLimits {
    parameters: usize,
    /// Constant first, then the coefficients of the parameters; one row per unknown.
    unknowns: Vec<Vec<RBig>>,
    /// Rows that must not be negative: all unknowns, and `1 - lambda_k`.
    rows: Vec<Vec<RBig>>,
}

impl WorkLimits {
    fn new(echelon: &Echelon, pattern: &[ContactState]) -> Self {
        let contacts = pattern.len();
        let free: Vec<usize> = (0..contacts).filter(|column| !echelon.pivots().contains(column)).collect();
        let mut unknowns = vec![vec![RBig::ZERO; free.len() + 1]; contacts];
        for (value, &contact) in echelon.solve_reduced(contacts).into_iter().zip(echelon.pivots()) {
            unknowns[contact][0] = value;
        }
        for (parameter, &column) in free.iter().enumerate() {
            unknowns[column][parameter + 1] = RBig::ONE;
            for (value, &contact) in echelon.solve_reduced(column).into_iter().zip(echelon.pivots()) {
                unknowns[contact][parameter + 1] = -value;
            }
        }
        let mut rows = unknowns.clone();
        for (share, _) in unknowns.iter().zip(pattern).filter(|(_, state)| **state == ContactState::Gap) {
            let mut complement: Vec<RBig> = share.iter().map(|value| -value.clone()).collect();
            complement[0] += RBig::ONE;
            rows.push(complement);
        }
        Self { parameters: free.len(), unknowns, rows }
    }

    /// Vertices and extreme directions; `None` if that takes more than `bases` trials, or once `proceed` is
    /// `false`.
    fn corners(&self, bases: u64, proceed: &mut dyn FnMut() -> bool) -> Option<Corners> {
        let (rows, parameters) = (self.rows.len(), self.parameters);
        let work = binomial(rows, parameters).saturating_add(binomial(rows, parameters - 1));
        if work > bases {
            return None;
        }
        let (mut vertices, mut directions) = (Vec::new(), Vec::new());
        for tight in combinations(rows, parameters) {
            vertices.extend(proceed().then(|| self.vertex(&tight))?);
        }
        for tight in combinations(rows, parameters - 1) {
            directions.extend(proceed().then(|| self.direction(&tight))?);
        }
        Some(Corners {
            vertices: distinct(vertices.into_iter()),
            directions: distinct(directions.into_iter()),
        })
    }

    /// The point at which the given limits are reached, if it is a single point and within all other limits.
    fn vertex(&self, tight: &[usize]) -> Option<Vec<RBig>> {
        let equations = tight.iter().map(|&row| self.rows[row].clone()).collect();
        let reduced = SolvedRows::new(equations, self.parameters);
        if reduced.columns.len() < self.parameters {
            return None;
        }
        let parameters: Vec<RBig> = reduced.rows.iter().map(|row| -row[0].clone()).collect();
        let admissible = self.rows.iter().all(|row| evaluate(row, &RBig::ONE, &parameters) >= RBig::ZERO);
        admissible.then(|| self.unknowns.iter().map(|row| evaluate(row, &RBig::ONE, &parameters)).collect())
    }

    /// The direction along which the given limits remain reached, if there is a single one and it violates no
    /// limit.
    fn direction(&self, tight: &[usize]) -> Option<Vec<RBig>> {
        let equations = tight.iter().map(|&row| self.rows[row].clone()).collect();
        let reduced = SolvedRows::new(equations, self.parameters);
        if reduced.columns.len() + 1 < self.parameters {
            return None;
        }
        let free = (0..self.parameters).find(|column| !reduced.columns.contains(column))?;
        let mut parameters = vec![RBig::ZERO; self.parameters];
        parameters[free] = RBig::ONE;
        for (row, &column) in reduced.rows.iter().zip(&reduced.columns) {
            parameters[column] = -row[free + 1].clone();
        }
        for _ in 0..2 {
            if self.rows.iter().all(|row| evaluate(row, &RBig::ZERO, &parameters) >= RBig::ZERO) {
                let direction =
                    self.unknowns.iter().map(|row| evaluate(row, &RBig::ZERO, &parameters)).collect();
                return scaled_to_one(direction);
            }
            parameters = parameters.into_iter().map(|value| -value).collect();
        }
        None
    }
}

/// Equations `row[0] + sum row[f + 1] t_f = 0` after Gauss-Jordan elimination; row `i` determines
/// parameter `columns[i]`.
struct SolvedRows {
    rows: Vec<Vec<RBig>>,
    columns: Vec<usize>,
}

impl SolvedRows {
    fn new(mut rows: Vec<Vec<RBig>>, parameters: usize) -> Self {
        let mut columns = Vec::new();
        for column in 0..parameters {
            let rank = columns.len();
            let Some(found) = (rank..rows.len()).find(|&row| !rows[row][column + 1].is_zero()) else {
                continue;
            };
            rows.swap(found, rank);
            let pivot = rows[rank][column + 1].clone();
            for value in &mut rows[rank] {
                *value /= &pivot;
            }
            let pivot_row = rows[rank].clone();
            for (_, row) in rows.iter_mut().enumerate().filter(|(at, _)| *at != rank) {
                let factor = row[column + 1].clone();
                if !factor.is_zero() {
                    row.iter_mut()
                        .zip(&pivot_row)
                        .for_each(|(value, eliminated)| *value -= &factor * eliminated);
                }
            }
            columns.push(column);
        }
        rows.truncate(columns.len());
        Self { rows, columns }
    }
}

fn evaluate(row: &[RBig], constant_factor: &RBig, parameters: &[RBig]) -> RBig {
    let terms = row[1..].iter().zip(parameters).filter(|(a, b)| !a.is_zero() && !b.is_zero());
    terms.fold(&row[0] * constant_factor, |sum, (coefficient, parameter)| sum + coefficient * parameter)
}

fn signed_forces(point: &[RBig], pattern: &[ContactState]) -> Vec<RBig> {
    let signed = |(value, state): (&RBig, &ContactState)| match state {
        ContactState::Positive => value.clone(),
        ContactState::Negative => -value.clone(),
        ContactState::Gap => RBig::ZERO,
    };
    point.iter().zip(pattern).map(signed).collect()
}

/// Divided by the size of the largest component; `None` if all are zero.
fn scaled_to_one(direction: Vec<RBig>) -> Option<Vec<RBig>> {
    let size = |value: &RBig| if *value < RBig::ZERO { -value.clone() } else { value.clone() };
    let largest = direction.iter().map(size).max().filter(|largest| !largest.is_zero())?;
    Some(direction.into_iter().map(|value| value / &largest).collect())
}

fn nearest(value: &RBig) -> f64 {
    Interval::around_ratio(value).nonzero_middle()
}

fn distinct(points: impl Iterator<Item = Vec<RBig>>) -> Vec<Vec<RBig>> {
    let mut known = HashSet::new();
    points.filter(|point| known.insert(point.clone())).collect()
}
