//! Branches: which state of a point continues which state of its neighbour.
//!
//! A state continues another one if it has the same pattern and its determinant the same sign. Where contacts
//! have changed side in between, it does if the oriented determinants `D prod sigma` have the same sign
//! (theory, section 8) and the forces differ little. A normal force that is zero goes with either side.

use super::rows::{RowKind, Rows};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// States of neighbours differ by less than this part of their forces, unless their patterns are the same.
const NEAR: f64 = 0.5;

/// Numbers branches along the axes of a grid, from point to point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Branches {
    /// The last branch that was numbered.
    last: u32,
    /// For each axis the states of the last point at which all later axes were at their first value.
    neighbours: Vec<Vec<Tracked>>,
    /// The places of the forces of hinges with friction in a row.
    #[serde(default)]
    hinge_forces: Vec<usize>,
}

/// A state that may be continued.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Tracked {
    branch: u32,
    pattern: Vec<u8>,
    normal_forces: Vec<f64>,
    /// Forces of hinges with friction.
    #[serde(default)]
    hinge_forces: Vec<f64>,
    kind: RowKind,
    negative_determinant: Option<bool>,
}

/// A state of the next point.
struct Next<'r> {
    pattern: &'r [u8],
    normal_forces: &'r [f64],
    hinge_forces: Vec<f64>,
    kind: RowKind,
    negative_determinant: Option<bool>,
}

/// How well a state continues another one: least is best.
type Cost = (usize, f64);

impl Branches {
    /// No branch yet; for so many axes. The forces of hinges with friction are at these places of a row.
    pub(super) fn new(axes: usize, hinge_forces: Vec<usize>) -> Self {
        Self { last: 0, neighbours: vec![Vec::new(); axes], hinge_forces }
    }

    /// How many branches there are.
    pub fn count(&self) -> u32 {
        self.last
    }

    /// Numbers the states of all rows of points that follow one another along a single axis. Only where
    /// something else than the numbers changes from one point to the next is it looked at what continues
    /// what.
    pub(super) fn number_line(&mut self, rows: &mut Rows) {
        let mut before: Option<Range<usize>> = None;
        let mut first = 0;
        while first < rows.len() {
            let range = first..first + rows.states_from(first);
            match &before {
                Some(before) if self.is_same(rows, before, &range) => {
                    for (row, known) in range.clone().zip(before.clone()) {
                        rows.heads[row].branch = rows.heads[known].branch;
                    }
                }
                _ => {
                    if let Some(before) = before {
                        self.remember(0, rows, before);
                    }
                    let place = rows.heads[first].point;
                    self.number(rows, range.clone(), &[place]);
                }
            }
            first = range.end;
            before = Some(range);
        }
        if let Some(before) = before {
            self.remember(0, rows, before);
        }
    }

    /// Numbers the states of a point: `rows` are its rows, `varied` numbers stand before the normal forces.
    /// `place` is that of the point on each axis.
    pub(super) fn number(&mut self, rows: &mut Rows, range: Range<usize>, place: &[u64]) {
        // The neighbour on the last axis on which the point is not the first.
        let moved = place.iter().rposition(|&index| index > 0);
        let mut taken: Vec<bool> = Vec::new();
        if let Some(axis) = moved {
            taken.resize(self.neighbours[axis].len(), false);
            self.continue_states(rows, range.clone(), axis, &mut taken);
        }
        for row in range.clone() {
            if rows.heads[row].branch == 0 && is_state(rows.heads[row].kind) {
                self.last += 1;
                rows.heads[row].branch = self.last;
            }
        }
        let first = moved.unwrap_or(0);
        for axis in first..self.neighbours.len() {
            self.remember(axis, rows, range.clone());
        }
    }

    fn continue_states(&self, rows: &mut Rows, range: Range<usize>, axis: usize, taken: &mut [bool]) {
        let known = &self.neighbours[axis];
        // Nearly always nothing has changed but the numbers.
        let same = known.len() == range.len()
            && !self.has_alike(rows, &range)
            && range.clone().zip(known).all(|(row, known)| {
                let next = self.next(rows, row);
                known.kind == next.kind
                    && known.pattern == next.pattern
                    && known.negative_determinant == next.negative_determinant
                    && is_state(next.kind)
            });
        if same {
            range.zip(known).for_each(|(row, known)| rows.heads[row].branch = known.branch);
            return;
        }
        let mut pairs: Vec<(Cost, usize, usize)> = Vec::new();
        for (at, tracked) in known.iter().enumerate() {
            for row in range.clone() {
                if let Some(cost) = cost(tracked, &self.next(rows, row)) {
                    pairs.push((cost, at, row));
                }
            }
        }
        pairs.sort_by(|one, other| {
            let ((differing, distance), at, row) = one;
            let ((others, other_distance), other_at, other_row) = other;
            differing
                .cmp(others)
                .then(distance.total_cmp(other_distance))
                .then((at, row).cmp(&(other_at, other_row)))
        });
        for (_, at, row) in pairs {
            if !taken[at] && rows.heads[row].branch == 0 {
                taken[at] = true;
                rows.heads[row].branch = known[at].branch;
            }
        }
    }

    /// Whether the rows of a point have the kinds, patterns and signs of another one's, all of them states.
    fn is_same(&self, rows: &Rows, known: &Range<usize>, range: &Range<usize>) -> bool {
        known.len() == range.len()
            && !self.has_alike(rows, range)
            && known.clone().zip(range.clone()).all(|(known, row)| {
                let (one, other) = (&rows.heads[known], &rows.heads[row]);
                is_state(other.kind)
                    && one.kind == other.kind
                    && one.negative_determinant == other.negative_determinant
                    && rows.pattern(known) == rows.pattern(row)
            })
    }

    /// Whether a mode of a point has several solutions of the same sign, as it may with friction in hinges.
    fn has_alike(&self, rows: &Rows, range: &Range<usize>) -> bool {
        let alike = |one: usize, other: usize| {
            rows.heads[one].negative_determinant == rows.heads[other].negative_determinant
                && rows.pattern(one) == rows.pattern(other)
        };
        !self.hinge_forces.is_empty()
            && range.clone().any(|row| (range.start..row).any(|other| alike(row, other)))
    }

    fn next<'r>(&self, rows: &'r Rows, row: usize) -> Next<'r> {
        let head = &rows.heads[row];
        let numbers = rows.numbers(row);
        Next {
            pattern: rows.pattern(row),
            normal_forces: &numbers[rows.varied..rows.varied + rows.contacts],
            hinge_forces: self.hinge_forces.iter().map(|&place| numbers[place]).collect(),
            kind: head.kind,
            negative_determinant: head.negative_determinant,
        }
    }

    /// Keeps the states of a point for the next one along an axis.
    fn remember(&mut self, axis: usize, rows: &Rows, range: Range<usize>) {
        let mut count = 0;
        for row in range.filter(|&row| is_state(rows.heads[row].kind)) {
            let next = self.next(rows, row);
            let branch = rows.heads[row].branch;
            let list = &mut self.neighbours[axis];
            if let Some(place) = list.get_mut(count) {
                place.branch = branch;
                place.pattern.clear();
                place.pattern.extend_from_slice(next.pattern);
                place.normal_forces.clear();
                place.normal_forces.extend_from_slice(next.normal_forces);
                place.hinge_forces = next.hinge_forces;
                place.kind = next.kind;
                place.negative_determinant = next.negative_determinant;
            } else {
                list.push(Tracked {
                    branch,
                    pattern: next.pattern.to_vec(),
                    normal_forces: next.normal_forces.to_vec(),
                    hinge_forces: next.hinge_forces,
                    kind: next.kind,
                    negative_determinant: next.negative_determinant,
                });
            }
            count += 1;
        }
        self.neighbours[axis].truncate(count);
    }
}

fn is_state(kind: RowKind) -> bool {
    matches!(kind, RowKind::Solution | RowKind::Boundary | RowKind::PreloadGap | RowKind::Rest)
}

/// Number of contacts with opposite sides, and distance of the forces; none if the one cannot continue the
/// other.
fn cost(known: &Tracked, next: &Next<'_>) -> Option<Cost> {
    if !is_state(next.kind) {
        return None;
    }
    let of_hinges = known.hinge_forces.iter().zip(&next.hinge_forces);
    let pairs = known.normal_forces.iter().zip(next.normal_forces);
    let all = pairs.clone().chain(of_hinges);
    let scale = all.clone().map(|(one, other)| one.abs().max(other.abs())).fold(0.0, f64::max);
    let distance = all.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
    let distance = if scale > 0.0 { distance / scale } else { 0.0 };
    let opposite = pairs.filter(|(one, other)| *one * *other < 0.0).count();
    let signs = match (known.negative_determinant, next.negative_determinant) {
        (Some(one), Some(other)) => Some((one, other)),
        _ => None,
    };
    if known.pattern == next.pattern {
        // The same mode on the other side of a pole is another branch.
        let same = signs.is_none_or(|(one, other)| one == other);
        return same.then_some((0, distance));
    }
    let in_gap = |pattern: &[u8]| pattern.contains(&b'0');
    let orientation = |pattern: &[u8], negative: bool| {
        pattern.iter().fold(negative, |negative, side| negative ^ (*side == b'-'))
    };
    let continues = match signs {
        Some((one, other)) if !in_gap(&known.pattern) && !in_gap(next.pattern) => {
            orientation(&known.pattern, one) == orientation(next.pattern, other)
        }
        _ => true,
    };
    (continues && distance <= NEAR).then_some((1 + opposite, distance))
}
