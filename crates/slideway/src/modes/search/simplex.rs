//! A dual simplex method for dense linear programs with bounded variables and warm starts.
//!
//! ```text
//! minimise cost . x   subject to   A x = b,   lower <= x <= upper
//! ```
//!
//! with `A` of `rows x columns`. The explicit inverse of the basis is kept: the problems have as
//! many rows as contacts, and an explicit inverse makes exact steepest-edge pricing and Farkas
//! vectors free. Every row has an artificial variable that is fixed to zero, so that the artificial
//! basis starts from any data as long as `cost >= 0`.
//!
//! Costs only steer the search; whether a program is infeasible is judged by its Farkas vector.

use nalgebra::DMatrix;

/// Bounds may be missed by this fraction of the largest basic variable (or of 1).
const FEASIBLE: f64 = 1e-9;
/// Entries of a pivot row below this are zero.
const ZERO_PIVOT: f64 = 1e-9;
/// Wrong signs of reduced costs up to this are traded for a larger pivot.
const DUAL_SLACK: f64 = 1e-9;
/// Row and column computation of a pivot may differ by this fraction.
const PIVOT_ACCURACY: f64 = 1e-7;
/// The inverse is computed afresh after so many updates.
const UPDATES: usize = 120;

/// The data that all nodes of a search share.
#[derive(Debug)]
pub(super) struct LinearProgram {
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
pub(super) struct Bounds {
    pub(super) lower: Vec<f64>,
    pub(super) upper: Vec<f64>,
}

/// Where a variable is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Basic(usize),
    Lower,
    Upper,
}

/// A basis with its inverse: all that a child inherits from its parent.
#[derive(Debug, Clone)]
pub(super) struct Basis {
    /// The variable of each row; `columns + i` is the artificial one of row `i`.
    basic: Vec<usize>,
    place: Vec<Place>,
    /// `B^-1`, row after row.
    inverse: Vec<f64>,
    reduced_cost: Vec<f64>,
    /// Values of the basic variables.
    value: Vec<f64>,
    updates: usize,
}

/// What became of a program.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum LinearOutcome {
    /// The values of the variables.
    Feasible(Vec<f64>),
    /// A vector `v` with `v . A x < v . b` for every `x` within the bounds, up to rounding.
    Infeasible(Vec<f64>),
    /// Numbers are too bad, or the limit of iterations is reached.
    Undecided,
}

enum Step {
    Pivot { entering: usize },
    Infeasible,
}

impl LinearProgram {
    /// A program from the columns of `A`, `b` and the costs.
    pub(super) fn new(columns: &[Vec<f64>], right_hand_side: Vec<f64>, cost: Vec<f64>) -> Self {
        let rows = right_hand_side.len();
        let by_column: Vec<f64> = columns.iter().flatten().copied().collect();
        let by_row = (0..rows).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
        Self { rows, columns: columns.len(), by_row, by_column, right_hand_side, cost }
    }

    pub(super) fn column(&self, column: usize) -> &[f64] {
        &self.by_column[column * self.rows..][..self.rows]
    }

    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    pub(super) fn right_hand_side(&self) -> &[f64] {
        &self.right_hand_side
    }

    /// `v^T A`.
    pub(super) fn row_combination(&self, multipliers: &[f64], combined: &mut Vec<f64>) {
        combined.clear();
        combined.resize(self.columns, 0.0);
        for (&multiplier, row) in multipliers.iter().zip(self.by_row.chunks_exact(self.columns.max(1))) {
            if multiplier != 0.0 {
                add_multiple(combined, multiplier, row);
            }
        }
    }

    /// The basis of artificial variables.
    pub(super) fn artificial_basis(&self) -> Basis {
        let rows = self.rows;
        let mut inverse = vec![0.0; rows * rows];
        inverse.iter_mut().step_by(rows + 1).for_each(|entry| *entry = 1.0);
        let mut place = vec![Place::Lower; self.columns + rows];
        (0..rows).for_each(|row| place[self.columns + row] = Place::Basic(row));
        Basis {
            basic: (self.columns..self.columns + rows).collect(),
            place,
            inverse,
            reduced_cost: self.cost.clone(),
            value: vec![0.0; rows],
            updates: 0,
        }
    }

    /// Solves the program from a basis that a program with wider bounds left behind; `iterations`
    /// counts the pivots.
    pub(super) fn solve(&self, basis: &mut Basis, bounds: &Bounds, iterations: &mut u64) -> LinearOutcome {
        let limit = 50 + 20 * self.rows;
        let mut combined = Vec::with_capacity(self.columns);
        basis.compute_values(self, bounds);
        for _ in 0..limit {
            let Some((row, direction)) = basis.worst_row(self, bounds) else {
                return self.accept(basis, bounds);
            };
            let pivot_row = basis.inverse[row * self.rows..][..self.rows].to_vec();
            self.row_combination(&pivot_row, &mut combined);
            match basis.entering(self, bounds, &combined, direction) {
                Step::Infeasible => {
                    let farkas = pivot_row.iter().map(|entry| direction * entry).collect();
                    return LinearOutcome::Infeasible(farkas);
                }
                Step::Pivot { entering } => {
                    *iterations += 1;
                    let sound = basis.pivot(self, bounds, row, entering, direction, &combined);
                    if (!sound || basis.updates > UPDATES) && !basis.refactor(self, bounds) {
                        return LinearOutcome::Undecided;
                    }
                }
            }
        }
        LinearOutcome::Undecided
    }

    /// The solution of a feasible basis, provided that it solves the equations.
    fn accept(&self, basis: &mut Basis, bounds: &Bounds) -> LinearOutcome {
        let values = basis.all_values(self, bounds);
        let mut residual = self.right_hand_side.clone();
        for (column, &value) in values.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            add_multiple(&mut residual, -value, self.column(column));
        }
        let size = values.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        if residual.iter().all(|rest| rest.abs() <= 1e-7 * size) {
            LinearOutcome::Feasible(values)
        } else {
            LinearOutcome::Undecided
        }
    }
}

impl Basis {
    /// The rows of the inverse that belong to the variables of the program in the basis.
    pub(super) fn row_of(&self, variable: usize) -> Option<&[f64]> {
        let rows = self.basic.len();
        match self.place[variable] {
            Place::Basic(row) => Some(&self.inverse[row * rows..][..rows]),
            Place::Lower | Place::Upper => None,
        }
    }

    fn nonbasic_value(&self, variable: usize, bounds: &Bounds) -> f64 {
        match self.place[variable] {
            Place::Lower => bounds.lower[variable],
            Place::Upper => bounds.upper[variable],
            Place::Basic(row) => self.value[row],
        }
    }

    fn all_values(&self, program: &LinearProgram, bounds: &Bounds) -> Vec<f64> {
        (0..program.columns).map(|variable| self.nonbasic_value(variable, bounds)).collect()
    }

    /// `x_B = B^-1 (b - sum of the nonbasic columns)`.
    fn compute_values(&mut self, program: &LinearProgram, bounds: &Bounds) {
        let mut rest = program.right_hand_side.clone();
        for variable in 0..program.columns {
            if matches!(self.place[variable], Place::Basic(_)) {
                continue;
            }
            // A bound that went to infinity cannot hold a variable.
            if !self.nonbasic_value(variable, bounds).is_finite() {
                self.place[variable] = Place::Lower;
            }
            let value = self.nonbasic_value(variable, bounds);
            if value != 0.0 {
                add_multiple(&mut rest, -value, program.column(variable));
            }
        }
        for (value, row) in self.value.iter_mut().zip(self.inverse.chunks_exact(program.rows.max(1))) {
            *value = dot(row, &rest);
        }
    }

    /// The row whose basic variable misses its bounds most, measured along the edge, and whether it
    /// is above (1) or below (-1).
    fn worst_row(&self, program: &LinearProgram, bounds: &Bounds) -> Option<(usize, f64)> {
        let size = self.value.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        let mut worst = None;
        let mut most = 0.0;
        for (row, (&variable, &value)) in self.basic.iter().zip(&self.value).enumerate() {
            let (lower, upper) = variable_bounds(program, bounds, variable);
            let (missed, direction) =
                if value > upper { (value - upper, 1.0) } else { (lower - value, -1.0) };
            if missed > FEASIBLE * size {
                let edge = &self.inverse[row * program.rows..][..program.rows];
                let measure = missed * missed / dot(edge, edge);
                if measure > most {
                    most = measure;
                    worst = Some((row, direction));
                }
            }
        }
        worst
    }

    /// Ratio test in two passes (Harris): of all variables whose reduced cost bounds the step, up to
    /// a slack, the one with the largest pivot.
    fn entering(&self, program: &LinearProgram, bounds: &Bounds, combined: &[f64], direction: f64) -> Step {
        let eligible = |variable: usize| {
            let entry = direction * combined[variable];
            let can_move = bounds.lower[variable] < bounds.upper[variable];
            can_move
                && match self.place[variable] {
                    Place::Basic(_) => false,
                    Place::Lower => entry > ZERO_PIVOT,
                    Place::Upper => entry < -ZERO_PIVOT,
                }
        };
        let mut step = f64::INFINITY;
        for variable in (0..program.columns).filter(|&variable| eligible(variable)) {
            let ratio = (self.reduced_cost[variable].abs() + DUAL_SLACK) / combined[variable].abs();
            step = step.min(ratio);
        }
        let mut best: Option<usize> = None;
        for variable in (0..program.columns).filter(|&variable| eligible(variable)) {
            let size = combined[variable].abs();
            if self.reduced_cost[variable].abs() <= step * size
                && best.is_none_or(|best| size > combined[best].abs())
            {
                best = Some(variable);
            }
        }
        best.map_or(Step::Infeasible, |entering| Step::Pivot { entering })
    }

    /// Exchanges the basic variable of a row; false if rounding has spoiled the inverse.
    fn pivot(
        &mut self,
        program: &LinearProgram,
        bounds: &Bounds,
        row: usize,
        entering: usize,
        direction: f64,
        combined: &[f64],
    ) -> bool {
        let rows = program.rows;
        let column = program.column(entering);
        let change: Vec<f64> = self.inverse.chunks_exact(rows).map(|row| dot(row, column)).collect();
        let pivot = change[row];
        if (pivot - combined[entering]).abs() > PIVOT_ACCURACY * combined[entering].abs() {
            return false;
        }
        let leaving = self.basic[row];
        let (lower, upper) = variable_bounds(program, bounds, leaving);
        let target = if direction > 0.0 { upper } else { lower };
        let step = (self.value[row] - target) / pivot;
        let entered = self.nonbasic_value(entering, bounds) + step;

        self.update_costs(program, entering, leaving, self.reduced_cost[entering] / pivot, combined);
        add_multiple(&mut self.value, -step, &change);
        self.value[row] = entered;
        // B^-1 of the new basis: the pivot row divided by the pivot, and eliminated from the others.
        let mut pivot_row = self.inverse[row * rows..][..rows].to_vec();
        for entry in &mut pivot_row {
            *entry /= pivot;
        }
        for ((at, target), &factor) in self.inverse.chunks_exact_mut(rows).enumerate().zip(&change) {
            if at == row {
                target.copy_from_slice(&pivot_row);
            } else if factor != 0.0 {
                add_multiple(target, -factor, &pivot_row);
            }
        }
        self.place[leaving] = if direction > 0.0 { Place::Upper } else { Place::Lower };
        self.place[entering] = Place::Basic(row);
        self.basic[row] = entering;
        self.updates += 1;
        true
    }

    fn update_costs(
        &mut self,
        program: &LinearProgram,
        entering: usize,
        leaving: usize,
        step: f64,
        combined: &[f64],
    ) {
        add_multiple(&mut self.reduced_cost, -step, combined);
        self.reduced_cost[entering] = 0.0;
        if leaving < program.columns {
            self.reduced_cost[leaving] = -step;
        }
    }

    /// Computes inverse, values and reduced costs afresh; false if the basis is singular.
    pub(super) fn refactor(&mut self, program: &LinearProgram, bounds: &Bounds) -> bool {
        let rows = program.rows;
        let basis =
            DMatrix::from_fn(rows, rows, |row, at| match self.basic[at].checked_sub(program.columns) {
                Some(artificial) => f64::from(u8::from(artificial == row)),
                None => program.column(self.basic[at])[row],
            });
        let Some(inverse) = basis.try_inverse() else { return false };
        self.inverse = inverse.transpose().as_slice().to_vec();
        self.updates = 0;
        // Reduced costs c - c_B B^-1 A.
        let mut multipliers = vec![0.0; rows];
        for (&variable, row) in self.basic.iter().zip(self.inverse.chunks_exact(rows)) {
            if variable < program.columns {
                add_multiple(&mut multipliers, -program.cost[variable], row);
            }
        }
        let mut combined = Vec::new();
        program.row_combination(&multipliers, &mut combined);
        self.reduced_cost = combined.iter().zip(&program.cost).map(|(a, b)| a + b).collect();
        self.compute_values(program, bounds);
        true
    }
}

fn variable_bounds(program: &LinearProgram, bounds: &Bounds, variable: usize) -> (f64, f64) {
    if variable < program.columns { (bounds.lower[variable], bounds.upper[variable]) } else { (0.0, 0.0) }
}

/// `target += factor * source`.
pub(super) fn add_multiple(target: &mut [f64], factor: f64, source: &[f64]) {
    for (target, &source) in target.iter_mut().zip(source) {
        *target += factor * source;
    }
}

/// The scalar product, in eight sums that are added last.
pub(super) fn dot(one: &[f64], other: &[f64]) -> f64 {
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
