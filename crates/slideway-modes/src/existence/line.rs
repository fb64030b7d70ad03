//! Linear equations along a line of parameters, and where inequalities of their solution hold.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::roots::{Reduced, Root};

/// Relative rounding errors up to which an inequality counts as met.
pub(super) const TOLERANCE: f64 = 1e-11;
/// Equations whose pivots differ by more than this are no base point for the others.
const SMALLEST_PIVOT: f64 = 1e-9;
/// Fractions of the range that are tried as base points.
const BASE_POINTS: [f64; 6] = [0.0, 0.381_966, 0.763_932, 0.145_898, 0.527_864, 0.909_83];
/// Places closer than this share of the range are the same.
const SAME_PLACE: f64 = 1e-14;
/// How near to a singular end limits are taken, as a fraction of the interval.
const NEAR: [f64; 2] = [1e-5, 1e-7];
/// Growth between these two places beyond which an unknown grows without bound.
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

/// A part of the line with `det A(t) != 0` and all conditions met inside.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    pub(super) from: End,
    pub(super) to: End,
}

/// What an unknown does as the parameter approaches an end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// It has this limit.
    Finite(f64),
    /// It grows beyond all bounds, with this sign (1 or -1).
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

/// Where the conditions hold.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Extent {
    /// In these parts, in increasing order.
    Parts(Vec<Part>),
    /// `det A(t)` vanishes, or is too close to it to tell, for all parameters.
    SingularThroughout,
    /// Eigenvalues could not be computed.
    NotComputed,
}

impl Line {
    /// The parts of a range in which all conditions hold.
    ///
    /// A determinant and a Cramer numerator of equations that are linear in `t` are polynomials whose zeros are
    /// eigenvalues (theory, section 6), so nothing is scanned: the range is cut at the zeros of the determinant,
    /// then at those of one condition after the other.
    pub(super) fn extent(&self, conditions: &[Condition], range: [f64; 2]) -> Extent {
        let end = |at| End { at, cause: Cause::Range };
        if self.right_hand_side[0].is_empty() {
            return Extent::Parts(vec![Part { from: end(range[0]), to: end(range[1]) }]);
        }
        let (line, conditions) = self.in_units(conditions, range);
        let Some(reduced) = line.reduced(&conditions, range) else { return Extent::SingularThroughout };
        match parts(&reduced, range) {
            Some(parts) => Extent::Parts(parts),
            None => Extent::NotComputed,
        }
    }

    /// Where `det A(t)` vanishes, with base points in a range; empty if it vanishes throughout.
    pub(super) fn determinant_zeros(&self, range: [f64; 2]) -> Vec<f64> {
        if self.right_hand_side[0].is_empty() {
            return Vec::new();
        }
        let zeros = self.reduced(&[], range).and_then(|reduced| reduced.poles());
        zeros.unwrap_or_default().into_iter().map(|Root(at)| at).collect()
    }

    /// The same equations and conditions with unknowns in units (powers of two, so that nothing is rounded) in which the
    /// columns have entries of order one: a coefficient of friction may be very great.
    fn in_units(&self, conditions: &[Condition], range: [f64; 2]) -> (Self, Vec<Condition>) {
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

    /// The equations at the base point with the best pivots.
    fn reduced(&self, conditions: &[Condition], range: [f64; 2]) -> Option<Reduced> {
        let mut best: Option<(f64, f64, LU<f64, Dyn, Dyn>)> = None;
        for fraction in BASE_POINTS {
            let at = range[0] + fraction * (range[1] - range[0]);
            let lu = self.matrix_at(at).lu();
            let ratio = pivot_ratio(&lu);
            if ratio.is_finite() && best.as_ref().is_none_or(|(known, ..)| ratio > *known) {
                best = Some((ratio, at, lu));
            }
            if ratio > 1e-3 {
                break;
            }
        }
        let (_, at, lu) = best.filter(|(ratio, ..)| *ratio > SMALLEST_PIVOT)?;
        Reduced::new(self, conditions, at, &lu)
    }

    /// The same equations in the parameter `1 / t`, multiplied by it.
    pub(super) fn reversed(&self) -> Self {
        let [m0, m1] = self.matrix.clone();
        let [b0, b1] = self.right_hand_side.clone();
        Self { matrix: [m1, m0], right_hand_side: [b1, b0] }
    }

    pub(super) fn matrix_at(&self, at: f64) -> DMatrix<f64> {
        &self.matrix[0] + &self.matrix[1] * at
    }

    pub(super) fn right_hand_side_at(&self, at: f64) -> DVector<f64> {
        &self.right_hand_side[0] + &self.right_hand_side[1] * at
    }

    /// The solution at a parameter; none where the equations are singular.
    pub(super) fn solution(&self, at: f64) -> Option<DVector<f64>> {
        if self.right_hand_side[0].is_empty() {
            return Some(DVector::zeros(0));
        }
        self.matrix_at(at).lu().solve(&self.right_hand_side_at(at))
    }

    /// Which unknowns are zero within rounding, at a parameter where the equations are regular: no greater than the tolerance
    /// times `|A^-1| (|A| |z| + |b|)`, the size of what they are the sum of.
    pub(super) fn vanishes(&self, at: f64) -> Option<Vec<bool>> {
        let (matrix, right) = (self.matrix_at(at), self.right_hand_side_at(at));
        let solution = self.solution(at)?;
        let terms = matrix.abs() * solution.abs() + right.abs();
        let size = matrix.try_inverse()?.abs() * terms;
        Some(solution.iter().zip(&size).map(|(value, size)| value.abs() <= TOLERANCE * size).collect())
    }

    /// What every unknown does towards the end of a part, whose other end is given.
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
        if end.cause != Cause::Singular {
            return Some(self.solution(end.at)?.iter().map(|&value| Limit::Finite(value)).collect());
        }
        let near = |fraction: f64| self.solution(end.at + fraction * (other - end.at));
        let (far, close) = (near(NEAR[0])?, near(NEAR[1])?);
        let limit = |(&far, &close): (&f64, &f64)| {
            let grows = close.abs() > GROWTH * far.abs();
            if grows { Limit::Infinite(close.signum()) } else { Limit::Finite(close) }
        };
        Some(far.iter().zip(close.iter()).map(limit).collect())
    }
}

/// The smallest pivot over the greatest; 1 without equations.
pub(super) fn pivot_ratio(lu: &LU<f64, Dyn, Dyn>) -> f64 {
    let pivots = lu.lu_internal().diagonal();
    if pivots.is_empty() { 1.0 } else { pivots.amin() / pivots.amax() }
}

/// The parts of a range in which all conditions hold; none if eigenvalues could not be computed.
fn parts(reduced: &Reduced, range: [f64; 2]) -> Option<Vec<Part>> {
    let signs = reduced.signs(range);
    if signs.exclude() {
        return Some(Vec::new());
    }
    let end = |at| End { at, cause: Cause::Range };
    let mut parts = vec![Part { from: end(range[0]), to: end(range[1]) }];
    let room = SAME_PLACE * (range[1] - range[0]);
    if signs.determinant.is_none() {
        cut(&mut parts, &reduced.poles()?, &Cause::Singular, room);
    }
    for condition in reduced.order(range) {
        let cause = Cause::Conditions(vec![condition]);
        if signs.numerators[condition].is_none() {
            cut(&mut parts, &reduced.zeros(condition)?, &cause, room);
        }
        parts.retain(|part| reduced.value(condition, part.middle()).is_some_and(Value::is_met));
        merge(&mut parts, &cause);
        if parts.is_empty() {
            break;
        }
    }
    for part in &mut parts {
        let middle = part.middle();
        polish(reduced, &mut part.from, middle);
        polish(reduced, &mut part.to, middle);
    }
    Some(parts)
}

/// The value of an inequality, and the rounding errors it may have.
#[derive(Debug, Clone, Copy)]
pub(super) struct Value {
    pub(super) value: f64,
    pub(super) magnitude: f64,
}

impl Value {
    /// Whether the inequality holds, rounding aside.
    pub(super) fn is_met(self) -> bool {
        self.value >= -TOLERANCE * self.magnitude
    }

    /// Whether it is an equality, rounding aside.
    pub(super) fn vanishes(self) -> bool {
        self.value.abs() <= 10.0 * TOLERANCE * self.magnitude
    }
}

impl Part {
    pub(super) fn middle(&self) -> f64 {
        f64::midpoint(self.from.at, self.to.at)
    }
}

/// Cuts parts at roots inside them, that is not within `room` of an end.
fn cut(parts: &mut Vec<Part>, roots: &[Root], cause: &Cause, room: f64) {
    for &Root(at) in roots {
        let inside = |part: &Part| at > part.from.at + room && at < part.to.at - room;
        let Some(index) = parts.iter().position(inside) else { continue };
        let end = End { at, cause: cause.clone() };
        let rest = Part { from: end.clone(), to: parts[index].to.clone() };
        parts[index].to = end;
        parts.insert(index + 1, rest);
    }
}

/// Joins neighbours that were cut by a condition that holds on both sides.
fn merge(parts: &mut Vec<Part>, cause: &Cause) {
    let mut joined: Vec<Part> = Vec::with_capacity(parts.len());
    for part in parts.drain(..) {
        match joined.last_mut() {
            Some(last) if last.to == part.from && last.to.cause == *cause => last.to = part.to,
            _ => joined.push(part),
        }
    }
    *parts = joined;
}

/// Moves an end to where its condition changes sign, to machine precision, and lists all conditions that vanish
/// there.
fn polish(reduced: &Reduced, end: &mut End, inside: f64) {
    match &mut end.cause {
        Cause::Range => {}
        Cause::Singular => {
            end.at = bisect(end.at, inside, |at| reduced.determinant(at)).unwrap_or(end.at);
        }
        Cause::Conditions(conditions) => {
            let first = conditions[0];
            let value = |at| reduced.value(first, at).map_or(f64::NAN, |value| value.value);
            end.at = bisect(end.at, inside, value).unwrap_or(end.at);
            let at = end.at;
            let vanishes = |&condition: &usize| {
                condition == first || reduced.value(condition, at).is_some_and(Value::vanishes)
            };
            *conditions = (0..reduced.conditions()).filter(vanishes).collect();
        }
    }
}

/// The zero of a function close to `root`; none if it does not change its sign there.
fn bisect(root: f64, inside: f64, function: impl Fn(f64) -> f64) -> Option<f64> {
    let mut reach = 1e-13 * (inside - root).abs().max(root.abs());
    let (mut low, mut high) = loop {
        let (low, high) = (root - reach, root + reach);
        if function(low) * function(high) <= 0.0 {
            break (low, high);
        }
        reach *= 8.0;
        if reach > 1e-3 * (inside - root).abs() {
            return None;
        }
    };
    let sign = function(low);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        if function(middle) * sign > 0.0 { low = middle } else { high = middle }
    }
    Some(f64::midpoint(low, high))
}
