//! Linear equations along a line of parameters, and where inequalities of their solution hold.

use crate::dense::solution;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// Relative rounding errors up to which an inequality counts as satisfied.
pub(super) const TOLERANCE: f64 = 1e-11;
/// How close to a singular end limits are evaluated, as a fraction of the interval.
const NEAR: [f64; 2] = [1e-5, 1e-7];
/// Growth between these two places beyond which an unknown is taken to grow without bound.
const GROWTH: f64 = 30.0;

/// `A(t) z = b(t)` with `A(t) = A_0 + t A_1` and `b(t) = b_0 + t b_1`.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub(super) matrix: [DMatrix<f64>; 2],
    pub(super) right_hand_side: [DVector<f64>; 2],
}

/// An inequality `w . z + offset >= 0` of one or two unknowns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Condition {
    /// Unknowns and their weights.
    pub(super) weights: [(usize, f64); 2],
    pub(super) offset: f64,
}

impl Condition {
    /// `w . column`.
    pub(super) fn times(&self, column: &[f64]) -> f64 {
        self.weights.iter().map(|&(unknown, weight)| weight * column[unknown]).sum()
    }

    /// `|w| . |column|`.
    pub(super) fn magnitude(&self, column: &[f64]) -> f64 {
        self.weights.iter().map(|&(unknown, weight)| (weight * column[unknown]).abs()).sum()
    }
}

/// Why a part of the line ends.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cause {
    /// The range ends.
    Range,
    /// `det A(t) = 0`.
    Singular,
    /// These conditions become equalities.
    Conditions(Vec<usize>),
}

/// An end of a part of the line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct End {
    pub(super) at: f64,
    pub(super) cause: Cause,
}

/// A part of the line with `det A(t) != 0` and all conditions satisfied inside.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    pub(super) from: End,
    pub(super) to: End,
}

/// The behaviour of an unknown as the parameter approaches an end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// It has this limit.
    Finite(f64),
    /// It grows without bound, with this sign (1 or -1).
    Infinite(f64),
}

impl Limit {
    /// The limit of a multiple of the unknown.
    #[must_use]
    pub(super) fn times(self, factor: f64) -> Self {
        match self {
            Self::Finite(value) => Self::Finite(value * factor),
            Self::Infinite(_) if factor == 0.0 => Self::Finite(0.0),
            Self::Infinite(sign) => Self::Infinite(sign * factor.signum()),
        }
    }
}

impl Line {
    /// Returns the equations and conditions with unknowns in units in which the columns have entries of order
    /// one: a friction coefficient may be very large. The units are powers of two, so that nothing is
    /// rounded.
    pub(super) fn in_units(&self, conditions: &[Condition], range: [f64; 2]) -> (Self, Vec<Condition>) {
        let reach = range[0].abs().max(range[1].abs());
        let unit = |column: usize| {
            let [constant, slope] = [0, 1].map(|power| self.matrix[power].column(column).amax());
            let size = constant.max(if slope == 0.0 { 0.0 } else { slope * reach });
            if size > 0.0 && size.is_finite() { (-size.log2().round()).exp2() } else { 1.0 }
        };
        let units: Vec<f64> = (0..self.right_hand_side[0].len()).map(unit).collect();
        let mut line = self.clone();
        for matrix in &mut line.matrix {
            for (mut column, unit) in matrix.column_iter_mut().zip(&units) {
                column *= *unit;
            }
        }
        let conditions = conditions.iter().map(|condition| Condition {
            weights: condition.weights.map(|(unknown, weight)| (unknown, weight * units[unknown])),
            ..*condition
        });
        (line, conditions.collect())
    }

    /// Returns the equations in the parameter `1 / t`, multiplied by it.
    pub(super) fn reversed(&self) -> Self {
        let [m0, m1] = self.matrix.clone();
        let [b0, b1] = self.right_hand_side.clone();
        Self { matrix: [m1, m0], right_hand_side: [b1, b0] }
    }

    /// The equations in the parameter `u = 1 / t`, with the same signs of these conditions for `u > 0`.
    ///
    /// If the load does not vary, unknowns of columns that do are divided by `u`: `(c_0 + t c_1) z = (u c_0 + c_1) z / u`,
    /// and as few columns vary as before. That keeps the sign of a condition without offset on such unknowns alone, and
    /// every condition on others. Otherwise the equations are [`Self::reversed`].
    pub(super) fn reciprocal(&self, conditions: &[Condition]) -> Self {
        let varies: Vec<bool> =
            self.matrix[1].column_iter().map(|column| column.iter().any(|entry| *entry != 0.0)).collect();
        let keeps_its_sign = |condition: &Condition| {
            let mut unknowns = condition.weights.iter().filter(|(_, weight)| *weight != 0.0);
            let scaled = unknowns.clone().filter(|(unknown, _)| varies[*unknown]).count();
            scaled == 0 || condition.offset == 0.0 && unknowns.all(|(unknown, _)| varies[*unknown])
        };
        let is_constant = self.right_hand_side[1].iter().all(|entry| *entry == 0.0);
        if !is_constant || !conditions.iter().all(keeps_its_sign) {
            return self.reversed();
        }
        let mut line = self.clone();
        let [constant, slope] = &mut line.matrix;
        for column in (0..varies.len()).filter(|&column| varies[column]) {
            constant.set_column(column, &self.matrix[1].column(column));
            slope.set_column(column, &self.matrix[0].column(column));
        }
        line
    }

    pub(super) fn matrix_at(&self, at: f64) -> DMatrix<f64> {
        &self.matrix[0] + &self.matrix[1] * at
    }

    pub(super) fn right_hand_side_at(&self, at: f64) -> DVector<f64> {
        &self.right_hand_side[0] + &self.right_hand_side[1] * at
    }

    /// The solution at a parameter; `None` if the equations are singular.
    pub(super) fn solution(&self, at: f64) -> Option<DVector<f64>> {
        solution(self.matrix_at(at), &self.right_hand_side_at(at))
    }

    /// Which unknowns are zero within rounding, at a parameter where the equations are regular: not greater
    /// than the tolerance times [`Self::sizes`].
    pub(super) fn vanishes(&self, at: f64) -> Option<Vec<bool>> {
        let (solution, sizes) = self.sizes(at)?;
        Some(solution.iter().zip(&sizes).map(|(value, size)| value.abs() <= TOLERANCE * size).collect())
    }

    /// The solution at a parameter, and `|A^-1| (|A| |z| + |b|)`, the size of the terms that it is composed of.
    fn sizes(&self, at: f64) -> Option<(DVector<f64>, DVector<f64>)> {
        let (matrix, right) = (self.matrix_at(at), self.right_hand_side_at(at));
        let solution = self.solution(at)?;
        let terms = matrix.abs() * solution.abs() + right.abs();
        Some((solution, matrix.try_inverse()?.abs() * terms))
    }

    /// Which conditions are equalities for all parameters of a range, within rounding: the numerator of a value has at
    /// most one degree more than there are columns that vary, and vanishes throughout if it does at one place more.
    pub(super) fn equalities(&self, conditions: &[Condition], [from, to]: [f64; 2]) -> Vec<bool> {
        let varying = self.matrix[1].column_iter().filter(|column| column.amax() > 0.0).count();
        let places = varying + 2;
        let mut found = vec![true; conditions.len()];
        for index in 0..places {
            let at = from + (to - from) * (index as f64 + 0.5) / places as f64;
            let Some((solution, sizes)) = self.sizes(at) else { return vec![false; conditions.len()] };
            for (is_equality, condition) in found.iter_mut().zip(conditions) {
                let value = condition.times(solution.as_slice()) + condition.offset;
                let magnitude = condition.magnitude(sizes.as_slice()) + condition.offset.abs();
                *is_equality &= Value { value, magnitude }.vanishes();
            }
            if !found.contains(&true) {
                break;
            }
        }
        found
    }

    /// The behaviour of every unknown towards the end of a part, whose other end is given.
    pub(super) fn limits(&self, end: &End, other: f64) -> Option<Vec<Limit>> {
        if end.at.is_infinite() {
            // Columns that do not vary vanish there.
            let end = End { at: 0.0, cause: Cause::Singular };
            return self.reversed().limits(&end, other.recip());
        }
        if other.is_infinite() {
            let end = End { at: end.at.recip(), ..end.clone() };
            return self.reversed().limits(&end, 0.0);
        }
        // What is zero within rounding is zero.
        let at = |place: f64| {
            let (solution, vanishes) = (self.solution(place)?, self.vanishes(place)?);
            let value = |(&value, vanishes)| if vanishes { 0.0 } else { value };
            Some(DVector::from_iterator(solution.len(), solution.iter().zip(vanishes).map(value)))
        };
        if end.cause != Cause::Singular {
            return Some(at(end.at)?.iter().map(|&value| Limit::Finite(value)).collect());
        }
        let near = |fraction: f64| at(end.at + fraction * (other - end.at));
        let (far, close) = (near(NEAR[0])?, near(NEAR[1])?);
        let limit = |(&far, &close): (&f64, &f64)| {
            let grows = close.abs() > GROWTH * far.abs();
            if grows { Limit::Infinite(close.signum()) } else { Limit::Finite(close) }
        };
        Some(far.iter().zip(close.iter()).map(limit).collect())
    }
}

/// The smallest pivot divided by the greatest; 1 without equations.
pub(super) fn pivot_ratio(lu: &LU<f64, Dyn, Dyn>) -> f64 {
    let pivots = lu.lu_internal().diagonal();
    if pivots.is_empty() { 1.0 } else { pivots.amin() / pivots.amax() }
}

/// The value of an inequality, and its possible rounding error.
#[derive(Debug, Clone, Copy)]
pub(super) struct Value {
    pub(super) value: f64,
    pub(super) magnitude: f64,
}

impl Value {
    /// Whether the inequality holds, apart from rounding.
    pub(super) fn is_met(self) -> bool {
        self.value >= -TOLERANCE * self.magnitude
    }

    /// Whether it is an equality, apart from rounding.
    pub(super) fn vanishes(self) -> bool {
        self.value.abs() <= 10.0 * TOLERANCE * self.magnitude
    }
}

impl Part {
    pub(super) fn middle(&self) -> f64 {
        f64::midpoint(self.from.at, self.to.at)
    }
}
