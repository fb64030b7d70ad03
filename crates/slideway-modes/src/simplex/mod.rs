//! A dual simplex method for dense linear programs with bounded variables and warm starts.
//!
//! ```text
//! minimise cost . x   subject to   A x = b,   lower <= x <= upper
//! ```
//!
//! with `A` of `rows x columns`. The tableau `B^-1 N` of the nonbasic columns is kept, row after row, so that
//! a pivot row, an exact measure of each row's length and the immediate cost of any branching can be read
//! directly. Every row has an artificial variable that is fixed to zero, so that the artificial basis is a
//! valid start for any data as long as `cost >= 0`; the tableau's columns of artificial variables are those
//! of `B^-1`, which provides Farkas vectors at no cost. Variables that are fixed to zero from some node on
//! are dropped from the tableaus below it.
//!
//! Costs only steer the search; infeasibility of a program is judged by its Farkas vector.

mod inside;

use std::ops::Range;

use nalgebra::DMatrix;

use crate::dense::{Pace, inverse, product};

/// Bounds may be violated by this fraction of the largest basic variable (or of 1).
const FEASIBLE: f64 = 1e-9;
/// Entries of a pivot row below this count as zero.
const ZERO_PIVOT: f64 = 1e-9;
/// Wrong signs of reduced costs up to this are accepted in exchange for a larger pivot.
const DUAL_SLACK: f64 = 1e-9;
/// Equations may be violated by this fraction of the largest variable (or of 1).
const RESIDUAL: f64 = 1e-7;
/// The tableau is recomputed after this many updates.
const UPDATES: usize = 120;

/// The data that all nodes of a search share.
#[derive(Debug, Clone)]
pub(crate) struct LinearProgram {
    rows: usize,
    columns: usize,
    /// `A`, row after row.
    by_row: Vec<f64>,
    /// `A`, column after column.
    by_column: Vec<f64>,
    right_hand_side: Vec<f64>,
    cost: Vec<f64>,
}

/// Lower and upper bounds of all variables.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) lower: Vec<f64>,
    pub(crate) upper: Vec<f64>,
}

/// A nonbasic variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Nonbasic {
    variable: usize,
    at_upper: bool,
}

/// A basis with its tableau: everything that a child inherits from its parent.
#[derive(Debug, Clone)]
pub(crate) struct Basis {
    /// The variable of each row; `columns + i` is the artificial one of row `i`.
    basic: Vec<usize>,
    /// The variable of each column of the tableau.
    nonbasic: Vec<Nonbasic>,
    /// `B^-1 N`, row after row.
    tableau: Vec<f64>,
    /// Reduced costs of the nonbasic variables.
    reduced_cost: Vec<f64>,
    /// The direction in which each nonbasic variable may move: up (1), down (-1), or not at all (0).
    way: Vec<f64>,
    /// Values of the basic variables.
    value: Vec<f64>,
    updates: usize,
}

/// The outcome of a program.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LinearOutcome {
    /// The values of the variables.
    Feasible(Vec<f64>),
    /// A vector `v` with `v . A x < v . b` for every `x` within the bounds, up to rounding.
    Infeasible(Vec<f64>),
    /// The numbers are too ill-conditioned, or the iteration limit is reached.
    Undecided,
}

enum Pivoting {
    /// The column of the tableau that enters.
    Pivot(usize),
    Infeasible,
}

impl LinearProgram {
    /// A program from the columns of `A`, `b` and the costs.
    pub(crate) fn new(columns: &[Vec<f64>], right_hand_side: Vec<f64>, cost: Vec<f64>) -> Self {
        let rows = right_hand_side.len();
        let by_column = columns.concat();
        let mut by_row = Vec::with_capacity(by_column.len());
        (0..rows).for_each(|row| by_row.extend(columns.iter().map(|column| column[row])));
        Self { rows, columns: columns.len(), by_row, by_column, right_hand_side, cost }
    }

    /// Multiplies a column by a factor.
    pub(crate) fn with_multiple_of_column(mut self, column: usize, factor: f64) -> Self {
        for row in 0..self.rows {
            self.by_column[column * self.rows + row] *= factor;
            self.by_row[row * self.columns + column] *= factor;
        }
        self
    }

    /// Replaces the right-hand side.
    pub(crate) fn with_right_hand_side(self, right_hand_side: Vec<f64>) -> Self {
        Self { right_hand_side, ..self }
    }

    pub(crate) fn column(&self, column: usize) -> &[f64] {
        &self.by_column[column * self.rows..][..self.rows]
    }

    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    /// `v^T A`.
    pub(crate) fn row_combination(&self, multipliers: &[f64]) -> Vec<f64> {
        let mut combined = vec![0.0; self.columns];
        for (&multiplier, row) in self.combined_rows(multipliers) {
            add_multiple(&mut combined, multiplier, row);
        }
        combined
    }

    /// `|v|^T |A|`: the sums of the sizes of the terms of `v^T A`.
    pub(crate) fn sizes_of_terms(&self, multipliers: &[f64]) -> Vec<f64> {
        let mut sizes = vec![0.0; self.columns];
        for (multiplier, row) in self.combined_rows(multipliers) {
            for (size, entry) in sizes.iter_mut().zip(row) {
                *size += (multiplier * entry).abs();
            }
        }
        sizes
    }

    /// The rows of `A` with multipliers other than zero, with these.
    fn combined_rows<'a>(&'a self, multipliers: &'a [f64]) -> impl Iterator<Item = (&'a f64, &'a [f64])> {
        let rows = self.by_row.chunks_exact(self.columns.max(1));
        multipliers.iter().zip(rows).filter(|(multiplier, _)| **multiplier != 0.0)
    }

    /// The basis of artificial variables.
    pub(crate) fn artificial_basis(&self) -> Basis {
        Basis {
            basic: (self.columns..self.columns + self.rows).collect(),
            nonbasic: (0..self.columns).map(|variable| Nonbasic { variable, at_upper: false }).collect(),
            tableau: self.by_row.clone(),
            reduced_cost: self.cost.clone(),
            way: vec![0.0; self.columns],
            value: vec![0.0; self.rows],
            updates: 0,
        }
    }

    /// Solves the program from a basis left by a program with wider bounds; `iterations` counts the pivots.
    /// The result is undecided once `proceed` is `false`.
    pub(crate) fn solve(
        &self,
        basis: &mut Basis,
        bounds: &Bounds,
        iterations: &mut u64,
        proceed: &mut dyn FnMut() -> bool,
    ) -> LinearOutcome {
        let limit = 50 + 20 * self.rows;
        basis.compute_values(self, bounds);
        let mut pace = Pace::new(proceed);
        for _ in 0..limit {
            if !pace.allows(3 * basis.tableau.len()) {
                break;
            }
            let Some((row, direction)) = basis.worst_row(self, bounds) else {
                let outcome = self.accept(basis, bounds);
                if outcome != LinearOutcome::Undecided
                    || basis.updates == 0
                    || !basis.refactor(self, bounds, pace.proceed())
                {
                    return outcome;
                }
                continue;
            };
            match basis.entering(row, direction) {
                Pivoting::Infeasible => {
                    let edge = basis.inverse_row(self, row);
                    return LinearOutcome::Infeasible(edge.iter().map(|entry| direction * entry).collect());
                }
                Pivoting::Pivot(column) => {
                    *iterations += 1;
                    basis.pivot(self, bounds, row, column, direction);
                    if basis.updates > UPDATES && !basis.refactor(self, bounds, pace.proceed()) {
                        return LinearOutcome::Undecided;
                    }
                }
            }
        }
        LinearOutcome::Undecided
    }

    /// The solution of a feasible basis, provided that it satisfies the equations.
    fn accept(&self, basis: &Basis, bounds: &Bounds) -> LinearOutcome {
        let values = basis.all_values(self, bounds);
        let mut residual = self.right_hand_side.clone();
        for (column, &value) in values.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            add_multiple(&mut residual, -value, self.column(column));
        }
        let size = values.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        if residual.iter().all(|rest| rest.abs() <= RESIDUAL * size) {
            LinearOutcome::Feasible(values)
        } else {
            LinearOutcome::Undecided
        }
    }
}

impl Basis {
    /// The number of equations.
    pub(crate) fn size(&self) -> usize {
        self.basic.len()
    }

    /// Drops the nonbasic variables that `bounds` fix to zero.
    pub(crate) fn restrict(&mut self, bounds: &Bounds) {
        let is_kept = |nonbasic: &Nonbasic| {
            let at = nonbasic.variable;
            at >= bounds.upper.len() || bounds.upper[at] != 0.0 || bounds.lower[at] != 0.0
        };
        let columns = self.nonbasic.len();
        let dropped = (0..columns).filter(|&at| !is_kept(&self.nonbasic[at]));
        // The columns between those that are dropped.
        let ends: Vec<usize> = dropped.collect();
        let starts = std::iter::once(0).chain(ends.iter().map(|end| end + 1));
        let kept: Vec<Range<usize>> =
            starts.zip(ends.iter().copied().chain([columns])).map(|(start, end)| start..end).collect();
        retain(&mut self.tableau, columns, &kept);
        retain(&mut self.reduced_cost, columns, &kept);
        retain(&mut self.way, columns, &kept);
        retain(&mut self.nonbasic, columns, &kept);
    }

    /// The row of `B^-1` that belongs to a basic variable.
    pub(crate) fn row_of(&self, program: &LinearProgram, variable: usize) -> Option<Vec<f64>> {
        let row = self.basic.iter().position(|&basic| basic == variable)?;
        Some(self.inverse_row(program, row))
    }

    /// A lower bound on how much the least cost grows if a variable is fixed to zero: infinite if that is
    /// impossible, zero for a variable that is not in the basis.
    pub(crate) fn cost_of_zero(&self, variable: usize) -> f64 {
        let row = self.basic.iter().position(|&basic| basic == variable);
        row.map_or(0.0, |row| self.value[row] * self.longest_step(row, 1.0, 0.0))
    }

    /// The sum of the rows of `B^-1` that belong to variables of the program, and its products with the columns of
    /// the nonbasic variables; `None` for all others that the bounds do not fix to zero, for which it is 1.
    pub(crate) fn sum_of_inverse_rows(&self, program: &LinearProgram) -> (Vec<f64>, Vec<Option<f64>>) {
        let mut total = vec![0.0; self.nonbasic.len()];
        for (_, row) in self.basic.iter().zip(self.rows()).filter(|(basic, _)| **basic < program.columns) {
            add_multiple(&mut total, 1.0, row);
        }
        let (mut sum, mut products) = (vec![0.0; program.rows], vec![None; program.columns]);
        for (nonbasic, total) in self.nonbasic.iter().zip(total) {
            match nonbasic.variable.checked_sub(program.columns) {
                // Those in the basis have a column of the unit matrix, in a row that is left out.
                Some(artificial) => sum[artificial] = total,
                None => products[nonbasic.variable] = Some(total),
            }
        }
        (sum, products)
    }

    /// The multipliers of the equations: the dual solution, if the program is solved.
    pub(crate) fn multipliers(&self, program: &LinearProgram) -> Vec<f64> {
        let mut multipliers = vec![0.0; program.rows];
        for (nonbasic, cost) in self.nonbasic.iter().zip(&self.reduced_cost) {
            if let Some(artificial) = nonbasic.variable.checked_sub(program.columns) {
                multipliers[artificial] = -cost;
            }
        }
        multipliers
    }

    fn rows(&self) -> std::slice::ChunksExact<'_, f64> {
        self.tableau.chunks_exact(self.nonbasic.len().max(1))
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.tableau[row * self.nonbasic.len()..][..self.nonbasic.len()]
    }

    fn inverse_row(&self, program: &LinearProgram, row: usize) -> Vec<f64> {
        let mut inverse = vec![0.0; program.rows];
        if let Some(artificial) = self.basic[row].checked_sub(program.columns) {
            inverse[artificial] = 1.0;
        }
        for (nonbasic, &entry) in self.nonbasic.iter().zip(self.row(row)) {
            if let Some(artificial) = nonbasic.variable.checked_sub(program.columns) {
                inverse[artificial] = entry;
            }
        }
        inverse
    }

    fn all_values(&self, program: &LinearProgram, bounds: &Bounds) -> Vec<f64> {
        let mut values = vec![0.0; program.columns];
        for nonbasic in self.nonbasic.iter().filter(|nonbasic| nonbasic.variable < program.columns) {
            values[nonbasic.variable] = nonbasic.value(program, bounds);
        }
        for (&variable, &value) in self.basic.iter().zip(&self.value) {
            if variable < program.columns {
                values[variable] = value;
            }
        }
        values
    }

    /// `x_B = B^-1 b - B^-1 N x_N`.
    fn compute_values(&mut self, program: &LinearProgram, bounds: &Bounds) {
        for nonbasic in &mut self.nonbasic {
            // A bound that became infinite cannot hold a variable.
            if !nonbasic.value(program, bounds).is_finite() {
                nonbasic.at_upper = false;
            }
        }
        self.way = self.nonbasic.iter().map(|at| at.way(program, bounds)).collect();
        let load =
            |variable: usize| variable.checked_sub(program.columns).map(|at| program.right_hand_side[at]);
        let factor = |at: &Nonbasic| load(at.variable).unwrap_or_else(|| -at.value(program, bounds));
        let factors: Vec<f64> = self.nonbasic.iter().map(factor).collect();
        for row in 0..self.basic.len() {
            self.value[row] = load(self.basic[row]).unwrap_or(0.0) + dot(self.row(row), &factors);
        }
    }

    /// The row whose basic variable violates its bounds most, measured along the edge, and whether it is
    /// above (1) or below (-1).
    fn worst_row(&self, program: &LinearProgram, bounds: &Bounds) -> Option<(usize, f64)> {
        let size = self.value.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        let mut worst = None;
        let mut most = 0.0;
        for (row, (&variable, &value)) in self.basic.iter().zip(&self.value).enumerate() {
            let (lower, upper) = variable_bounds(program, bounds, variable);
            let (missed, direction) =
                if value > upper { (value - upper, 1.0) } else { (lower - value, -1.0) };
            if missed > FEASIBLE * size {
                let edge = self.row(row);
                let measure = missed * missed / (1.0 + dot(edge, edge));
                if measure > most {
                    most = measure;
                    worst = Some((row, direction));
                }
            }
        }
        worst
    }

    /// How far the dual variable of a row can move before a reduced cost has the wrong sign by more than a
    /// slack.
    fn longest_step(&self, row: usize, direction: f64, slack: f64) -> f64 {
        let mut step = f64::INFINITY;
        for ((&entry, &way), cost) in self.row(row).iter().zip(&self.way).zip(&self.reduced_cost) {
            let pivot = direction * entry * way;
            let ratio = if pivot > ZERO_PIVOT { (cost.abs() + slack) / pivot } else { f64::INFINITY };
            step = if ratio < step { ratio } else { step };
        }
        step
    }

    /// Ratio test in two passes (Harris): among all variables whose reduced cost bounds the step, up to a
    /// slack, the one with the largest pivot.
    fn entering(&self, row: usize, direction: f64) -> Pivoting {
        let step = self.longest_step(row, direction, DUAL_SLACK);
        let (mut best, mut largest) = (None, ZERO_PIVOT);
        for (column, (&entry, &way)) in self.row(row).iter().zip(&self.way).enumerate() {
            let pivot = direction * entry * way;
            if pivot > largest && self.reduced_cost[column].abs() <= step * pivot {
                (best, largest) = (Some(column), pivot);
            }
        }
        best.map_or(Pivoting::Infeasible, Pivoting::Pivot)
    }

    /// Exchanges the basic variable of a row with the nonbasic variable of a column.
    fn pivot(&mut self, program: &LinearProgram, bounds: &Bounds, row: usize, column: usize, direction: f64) {
        let width = self.nonbasic.len();
        let mut pivot_row = self.row(row).to_vec();
        let pivot = pivot_row[column];
        let leaving = self.basic[row];
        let (lower, upper) = variable_bounds(program, bounds, leaving);
        let target = if direction > 0.0 { upper } else { lower };
        let step = (self.value[row] - target) / pivot;
        let entered = self.nonbasic[column].value(program, bounds) + step;

        pivot_row[column] = 1.0;
        for entry in &mut pivot_row {
            *entry /= pivot;
        }
        for (at, target) in self.tableau.chunks_exact_mut(width).enumerate() {
            if at == row {
                target.copy_from_slice(&pivot_row);
                continue;
            }
            let factor = std::mem::take(&mut target[column]);
            if factor != 0.0 {
                self.value[at] -= factor * step;
                add_multiple(target, -factor, &pivot_row);
            }
        }
        let factor = std::mem::take(&mut self.reduced_cost[column]);
        add_multiple(&mut self.reduced_cost, -factor, &pivot_row);
        self.value[row] = entered;
        self.basic[row] = self.nonbasic[column].variable;
        self.nonbasic[column] = Nonbasic { variable: leaving, at_upper: direction > 0.0 };
        self.way[column] = self.nonbasic[column].way(program, bounds);
        self.updates += 1;
    }

    /// Recomputes tableau, values and reduced costs; `false` if the basis is singular, or once `proceed` is
    /// `false`.
    fn refactor(
        &mut self,
        program: &LinearProgram,
        bounds: &Bounds,
        proceed: &mut dyn FnMut() -> bool,
    ) -> bool {
        let rows = program.rows;
        let column = |variable: usize, row: usize| match variable.checked_sub(program.columns) {
            Some(artificial) => f64::from(u8::from(artificial == row)),
            None => program.column(variable)[row],
        };
        let cost = |variable: usize| program.cost.get(variable).copied().unwrap_or(0.0);
        let basis = DMatrix::from_fn(rows, rows, |row, at| column(self.basic[at], row));
        let Some(inverse) = inverse(basis, proceed) else { return false };
        let nonbasic =
            DMatrix::from_fn(rows, self.nonbasic.len(), |row, at| column(self.nonbasic[at].variable, row));
        let Some(tableau) = product(&inverse, &nonbasic, proceed) else { return false };
        self.tableau = tableau.transpose().as_slice().to_vec();
        self.updates = 0;
        // Reduced costs c_N - c_B B^-1 N.
        let mut reduced_cost: Vec<f64> = self.nonbasic.iter().map(|at| cost(at.variable)).collect();
        for (&variable, row) in self.basic.iter().zip(self.rows()) {
            add_multiple(&mut reduced_cost, -cost(variable), row);
        }
        self.reduced_cost = reduced_cost;
        self.compute_values(program, bounds);
        true
    }
}

impl Nonbasic {
    fn value(self, program: &LinearProgram, bounds: &Bounds) -> f64 {
        let (lower, upper) = variable_bounds(program, bounds, self.variable);
        if self.at_upper { upper } else { lower }
    }

    fn way(self, program: &LinearProgram, bounds: &Bounds) -> f64 {
        let (lower, upper) = variable_bounds(program, bounds, self.variable);
        match (lower < upper, self.at_upper) {
            (false, _) => 0.0,
            (true, false) => 1.0,
            (true, true) => -1.0,
        }
    }
}

fn variable_bounds(program: &LinearProgram, bounds: &Bounds, variable: usize) -> (f64, f64) {
    if variable < program.columns { (bounds.lower[variable], bounds.upper[variable]) } else { (0.0, 0.0) }
}

/// Keeps some columns of a matrix with so many of them, row after row.
fn retain<T: Copy>(rows: &mut Vec<T>, columns: usize, kept: &[Range<usize>]) {
    let mut length = 0;
    for first in (0..rows.len()).step_by(columns.max(1)) {
        for Range { start, end } in kept {
            rows.copy_within(first + start..first + end, length);
            length += end - start;
        }
    }
    rows.truncate(length);
}

/// `target += factor * source`.
pub(crate) fn add_multiple(target: &mut [f64], factor: f64, source: &[f64]) {
    for (target, &source) in target.iter_mut().zip(source) {
        *target += factor * source;
    }
}

/// The scalar product, in eight partial sums that are added at the end.
pub(crate) fn dot(one: &[f64], other: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (ones, others) = (one.chunks_exact(8), other.chunks_exact(8));
    let rest: f64 = ones.remainder().iter().zip(others.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in ones.zip(others) {
        for at in 0..8 {
            sums[at] += a[at] * b[at];
        }
    }
    sums.iter().sum::<f64>() + rest
}
