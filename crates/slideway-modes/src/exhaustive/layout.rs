//! The order in which the tree decides contacts, and the scaled equations at its root.

use super::double_double::{DoubleDouble, UNIT};
use super::instructions::Instructions;
use super::lanes::LANES;
use super::pattern::Pattern;
use crate::problem::{Column, ContactState, ProblemView, Side};

/// The maximum number of places that the kernel decides.
pub(super) const LEVELS: usize = 12;
/// Number of places that are solved together by Cramer's rule.
pub(super) const CRAMER: usize = 3;
/// Number of places whose unknowns are found as multiples of the determinant.
pub(super) const SOLVED: usize = 6;

/// Places of contacts in the tree; the last place is decided first.
///
/// Places `0..padding` hold contacts with the equation `sigma y = 1`, so that there are as many contacts
/// without a jump as the leaves need. The contacts without a jump follow, then those with one.
#[derive(Debug)]
pub(super) struct Layout {
    padding: usize,
    /// The contact at each place from `padding` on.
    order: Vec<usize>,
    /// Places of contacts without a jump, including padding.
    pub(super) plain: usize,
    /// The vector instructions to use.
    pub(super) instructions: Instructions,
}

impl Layout {
    pub(super) fn new(problem: ProblemView<'_>, instructions: Instructions) -> Self {
        let contacts = 0..problem.contacts();
        let (jumping, mut order): (Vec<usize>, Vec<usize>) = contacts.partition(|&k| problem.has_jump(k));
        let padding = SOLVED.saturating_sub(order.len());
        let plain = order.len() + padding;
        order.extend(jumping);
        Self { padding, order, plain, instructions }
    }

    /// Places below those of the problem's own contacts.
    pub(super) fn padding(&self) -> usize {
        self.padding
    }

    pub(super) fn places(&self) -> usize {
        self.padding + self.order.len()
    }

    /// Number of places left to the kernel: few enough that there are nodes for all of its lanes.
    pub(super) fn kernel_places(&self) -> usize {
        let levels = LANES.ilog2() as usize;
        self.plain.min(self.places().saturating_sub(levels)).clamp(SOLVED, LEVELS)
    }

    pub(super) fn states(&self, place: usize) -> &'static [ContactState] {
        if place < self.plain { &ContactState::PRESSED } else { &ContactState::ALL }
    }

    /// Number of patterns of the places below this one; `None` if it exceeds `u64`.
    pub(super) fn patterns_below(&self, place: usize) -> Option<u64> {
        let states = |place| self.states(place).len() as u64;
        (self.padding..place).try_fold(1_u64, |count, place| count.checked_mul(states(place)))
    }

    /// The column of the positive side of the contact at a place. Column 0 is the right-hand side; a contact
    /// has the columns `c^+, c^-`, and also `d^+, d^-` if there is a jump.
    pub(super) fn column(&self, place: usize) -> usize {
        1 + 2 * place + 2 * place.saturating_sub(self.plain)
    }

    /// Translates places to contacts. `None` if a padding contact is on its negative side, where it has no
    /// solution.
    pub(super) fn pattern(&self, places: Pattern) -> Option<Pattern> {
        if places.negative & ((1 << self.padding) - 1) != 0 {
            return None;
        }
        let at = |pattern: Pattern, (place, &contact): (usize, &usize)| {
            pattern.with(contact, places.state(self.padding + place))
        };
        Some(self.order.iter().enumerate().fold(Pattern::default(), at))
    }
}

/// The scaled equations: columns as in [`Layout::column`].
pub(super) struct ScaledEquations {
    pub(super) rows: Vec<Vec<DoubleDouble>>,
    /// Bound on the error of every entry.
    pub(super) bound: f64,
}

impl ScaledEquations {
    /// Rows and loads are scaled by powers of two. This changes neither the sign of a `y` nor a share.
    pub(super) fn new(problem: ProblemView<'_>, layout: &Layout) -> Self {
        let scales: Vec<f64> = (0..problem.contacts()).map(|row| row_scale(problem, row)).collect();
        let loads = Loads::new(problem, layout, &scales);
        // Scaling may round numbers near the least normal ones, and loads are scaled twice.
        let mut bound = 4.0 * f64::MIN_POSITIVE * loads.scale.max(1.0);
        let mut rows = Vec::new();
        for row in 0..layout.padding {
            rows.push(padding_row(row, layout));
        }
        for (row, &scale) in scales.iter().enumerate() {
            let mut entries = vec![DoubleDouble::default(); layout.column(layout.places())];
            let (load, error) = loads.constant(problem, layout, row);
            entries[0] = load;
            bound = bound.max(error + 4.0 * f64::MIN_POSITIVE * loads.scale.max(1.0));
            for (at, &contact) in layout.order.iter().enumerate() {
                let place = layout.padding + at;
                for (index, side) in Side::BOTH.into_iter().enumerate() {
                    let mut put = |column: usize, of: Column<'_>, scale: f64, more: f64| {
                        for (centre, radius) in of.terms().map(|term| term.centre_and_radius(row)) {
                            // Two terms are a sum and its rounding error: exact as one number.
                            entries[column] = entries[column].plus(DoubleDouble::from(centre * scale * more));
                            let rounded = 4.0 * f64::MIN_POSITIVE * loads.scale.max(1.0);
                            bound = bound.max(radius * scale * more * (1.0 + 1e-10) + rounded);
                        }
                    };
                    let column = layout.column(place) + index;
                    put(column, problem.column(contact, side), scale, 1.0);
                    if place >= layout.plain {
                        put(column + 2, problem.jump(contact, side), scale, loads.scale);
                    }
                }
            }
            rows.push(entries);
        }
        Self { rows, bound }
    }
}

/// `sigma y = 1`.
fn padding_row(row: usize, layout: &Layout) -> Vec<DoubleDouble> {
    let mut entries = vec![DoubleDouble::default(); layout.column(layout.places())];
    entries[0] = 1.0.into();
    entries[layout.column(row)] = 1.0.into();
    entries[layout.column(row) + 1] = (-1.0).into();
    entries
}

fn row_scale(problem: ProblemView<'_>, row: usize) -> f64 {
    let entries = (0..problem.contacts())
        .flat_map(|contact| Side::BOTH.map(|side| problem.column(contact, side).centre[row].abs()));
    scale_to_one(entries.fold(0.0, f64::max))
}

/// The power of two that brings a number near 1.
fn scale_to_one(size: f64) -> f64 {
    if size == 0.0 { 1.0 } else { (-size.log2().round()).clamp(-1000.0, 1000.0).exp2() }
}

/// Right-hand sides in units of the largest.
struct Loads<'a> {
    row_scales: &'a [f64],
    scale: f64,
}

impl<'a> Loads<'a> {
    fn new(problem: ProblemView<'_>, layout: &Layout, row_scales: &'a [f64]) -> Self {
        let mut largest = 0.0_f64;
        for (row, scale) in row_scales.iter().enumerate() {
            largest = largest.max((problem.load().centre[row] * scale).abs());
            for &contact in &layout.order {
                for side in Side::BOTH {
                    largest = largest.max((problem.jump(contact, side).centre[row] * scale).abs());
                }
            }
        }
        Self { row_scales, scale: scale_to_one(largest) }
    }

    /// `N(0) + sum_k d_k` over the contacts without a jump, and a bound on its error.
    fn constant(&self, problem: ProblemView<'_>, layout: &Layout, row: usize) -> (DoubleDouble, f64) {
        let scaled = |value: f64| value * self.row_scales[row] * self.scale;
        let (centre, radius) = problem.load().centre_and_radius(row);
        let (mut sum, mut size) = (DoubleDouble::from(scaled(centre)), scaled(centre).abs());
        let mut terms = 1.0;
        for &contact in &layout.order[..layout.plain - layout.padding] {
            let term = scaled(problem.jump(contact, Side::Positive).centre[row]);
            sum = sum.plus(term.into());
            size += term.abs();
            terms += 1.0;
        }
        let least = f64::MIN_POSITIVE * self.scale.max(1.0);
        (sum, scaled(radius) * (1.0 + 1e-10) + 2.0 * terms * UNIT * size + 4.0 * terms * least)
    }
}
