//! The parts of a line in which a pattern has a solution.

use nalgebra::{Dyn, LU};

use super::line::{Cause, Condition, End, Line, Part, Value, pivot_ratio};
use super::roots::{Reduced, Root};

/// Equations whose pivots differ by more than this are not used as a base point for the others.
const SMALLEST_PIVOT: f64 = 1e-9;
/// Fractions of the range that are tried as base points.
const BASE_POINTS: [f64; 6] = [0.0, 0.381_966, 0.763_932, 0.145_898, 0.527_864, 0.909_83];
/// How often a bracket is widened: from 1e-13 to 1e-3 of a distance by factors of 8.
const FARTHER: i32 = 12;
/// Places closer than this fraction of the range count as the same.
const SAME_PLACE: f64 = 1e-14;

/// Where the conditions hold.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Extent {
    /// In these parts, in increasing order.
    Parts(Vec<Part>),
    /// `det A(t)` vanishes for all parameters, or is too close to zero to tell.
    SingularThroughout,
    /// Eigenvalues could not be computed.
    NotComputed,
}

impl Line {
    /// The parts of a range in which all conditions hold.
    ///
    /// A determinant and a Cramer numerator of equations that are linear in `t` are polynomials whose zeros
    /// are eigenvalues (theory, section 6), so no scanning is needed: the range is cut at the zeros of the
    /// determinant, then at those of one condition after the other.
    pub(super) fn extent(&self, conditions: &[Condition], range: [f64; 2]) -> Extent {
        let end = |at| End { at, cause: Cause::Range };
        if self.right_hand_side[0].is_empty() {
            return Extent::Parts(vec![Part { from: end(range[0]), to: end(range[1]) }]);
        }
        let (line, conditions) = self.in_units(conditions, range);
        let Some(mut reduced) = line.reduced(&conditions, range) else { return Extent::SingularThroughout };
        reduced.equalities = line.equalities(&conditions, range);
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

    /// Where a condition may become an equality inside a range, each place to machine precision where it
    /// changes its sign; none if eigenvalues could not be computed, or the determinant vanishes throughout.
    pub(super) fn zeros(&self, condition: Condition, range: [f64; 2]) -> Option<Vec<f64>> {
        let (line, conditions) = self.in_units(&[condition], range);
        let reduced = line.reduced(&conditions, range)?;
        let value = |at| reduced.value(0, at).map_or(f64::NAN, |value| value.value);
        let farther = |at: f64| if at - range[0] > range[1] - at { range[0] } else { range[1] };
        let inside = reduced.zeros(0)?.into_iter().filter(|root| range[0] < root.0 && root.0 < range[1]);
        Some(inside.map(|Root(at)| bisect(at, farther(at), value).unwrap_or(at)).collect())
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
}

/// The parts of a range in which all conditions hold; `None` if eigenvalues could not be computed.
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

/// Cuts parts at roots inside them, that is, not within `room` of an end.
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

/// Moves an end to where its condition changes sign, to machine precision, and lists all conditions that
/// vanish there.
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
            *conditions = reduced.inequalities().filter(vanishes).collect();
        }
    }
}

/// The zero of a function close to `root`; `None` if it does not change sign there.
fn bisect(root: f64, inside: f64, function: impl Fn(f64) -> f64) -> Option<f64> {
    let way = (inside - root).abs();
    let nearest = 1e-13 * way.max(root.abs());
    let reaches = (0..FARTHER).map(|step| nearest * 8.0_f64.powi(step));
    let mut brackets = reaches
        .take_while(|reach| *reach <= nearest.max(1e-3 * way))
        .map(|reach| (root - reach, root + reach));
    let (mut low, mut high) = brackets.find(|&(low, high)| function(low) * function(high) <= 0.0)?;
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
