//! The upper part of the tree: few nodes, in double-double arithmetic.

use std::sync::Arc;

use super::double_double::{DoubleDouble, UNIT};
use super::instructions::{Instructions, Set};
use super::layout::{Layout, ScaledEquations};
use super::level::{ROUNDED_UP, bound_below};
use super::pattern::Pattern;
use crate::problem::ContactState;

/// The equations that remain once the contacts at the last places have been decided.
#[derive(Clone)]
pub(super) struct Node {
    /// Number of undecided places.
    pub(super) places: usize,
    /// Leading and trailing parts of the entries, row after row.
    high: Vec<f64>,
    low: Vec<f64>,
    /// Bound on the error of every entry.
    pub(super) bound: f64,
    /// Bound on the size of every entry.
    pub(super) size: f64,
    /// The pivot rows of the decided places, in the order of decision.
    pivots: Vec<Arc<PivotRow>>,
    /// States of the decided places.
    pub(super) pattern: Pattern,
    /// Whether some pivot on the way was too small to continue: nothing below can be excluded.
    pub(super) irregular: bool,
}

/// The equation that gives the unknown of a decided place once those below are known.
struct PivotRow {
    /// Right-hand side and columns of the places below.
    entries: Vec<f64>,
    pivot: f64,
    bound: f64,
}

/// A pivot row whose right-hand side includes the jumps below, with one column for each decided place.
#[derive(Clone, Default)]
pub(super) struct ResolvedRow {
    /// Right-hand side, both columns of the undecided places, one column of the decided places below.
    pub(super) entries: Vec<f64>,
    pub(super) pivot: f64,
    /// Bound on the error of every entry, and of the pivot.
    pub(super) bound: f64,
}

fn largest(entries: &[f64]) -> f64 {
    entries.iter().fold(0.0, |largest, entry| largest.max(entry.abs()))
}

impl Node {
    pub(super) fn root(root: &ScaledEquations, layout: &Layout) -> Self {
        let entries = || root.rows.iter().flatten();
        let high: Vec<f64> = entries().map(|entry| entry.high).collect();
        Self {
            places: layout.places(),
            size: largest(&high),
            high,
            low: entries().map(|entry| entry.low).collect(),
            bound: root.bound,
            pivots: Vec::new(),
            pattern: Pattern::default(),
            irregular: false,
        }
    }

    /// Leading parts of the equations.
    pub(super) fn rows(&self, layout: &Layout) -> std::slice::ChunksExact<'_, f64> {
        self.high.chunks_exact(layout.column(self.places))
    }

    /// All children, in the order of their states.
    pub(super) fn children<'a>(&'a self, layout: &'a Layout) -> impl Iterator<Item = Self> + 'a {
        layout.states(self.places - 1).iter().map(|&state| self.decide(layout, state))
    }

    /// The node below, with the contact at the last undecided place in the given state.
    fn decide(&self, layout: &Layout, state: ContactState) -> Self {
        let place = self.places - 1;
        let width = layout.column(place);
        let mut child = Self {
            places: place,
            high: Vec::new(),
            low: Vec::new(),
            bound: self.bound,
            size: self.size,
            pivots: self.pivots.clone(),
            pattern: self.pattern.with(place, state),
            irregular: self.irregular,
        };
        if self.irregular {
            return child;
        }
        let column = width + usize::from(state == ContactState::Negative);
        if place < layout.plain {
            let stride = layout.column(self.places);
            let step = Elimination::new(&self.high, &self.low, [column, width, stride]);
            child.eliminate(&step, layout.instructions);
        } else {
            let (mut high, mut low) = (self.high.clone(), self.low.clone());
            let stride = layout.column(self.places);
            for (high, low) in high.chunks_exact_mut(stride).zip(low.chunks_exact_mut(stride)) {
                apply_jump(high, low, width, state);
            }
            // A sum of two entries.
            child.bound = 2.0 * self.bound + 4.0 * UNIT * self.size;
            child.size = 2.0 * self.size;
            child.eliminate(&Elimination::new(&high, &low, [column, width, stride]), layout.instructions);
        }
        child
    }

    /// One elimination step on equations within the bounds of this node, which yields the child.
    fn eliminate(&mut self, step: &Elimination<'_>, instructions: Instructions) {
        let &Elimination { high, at, column, width, stride, .. } = step;
        let pivot = high[at * stride + column].abs();
        if pivot <= 2.0 * self.bound || pivot == 0.0 || !self.size.is_finite() {
            self.irregular = true;
            return;
        }
        let entries = (high.len() / stride - 1) * width;
        (self.high, self.low) = (vec![0.0; entries], vec![0.0; entries]);
        step.run(instructions, &mut self.high, &mut self.low);
        let pivot_row = &high[at * stride..at * stride + width];
        let row = largest(pivot_row);
        self.pivots.push(Arc::new(PivotRow {
            entries: pivot_row.to_vec(),
            pivot: high[at * stride + column],
            // The loss from keeping only the leading parts.
            bound: self.bound + f64::EPSILON * row.max(pivot),
        }));
        self.bound = bound_below(self.bound, 1.0, ROUNDED_UP / (pivot - self.bound), row, self.size, UNIT);
        self.size = largest(&self.high);
    }

    /// The pivot rows of all decided places, the lowest first.
    pub(super) fn resolved<'a>(&'a self, layout: &'a Layout) -> impl Iterator<Item = ResolvedRow> + 'a {
        let pivots = self.pivots.iter().rev().enumerate();
        pivots.map(|(index, row)| self.resolve(row, self.places + index, layout))
    }

    fn resolve(&self, row: &PivotRow, place: usize, layout: &Layout) -> ResolvedRow {
        let mut entries = row.entries[..layout.column(self.places)].to_vec();
        let mut jumps = 0.0;
        for below in self.places..place {
            let column = layout.column(below);
            let state = self.pattern.state(below);
            let [c_plus, c_minus] = [row.entries[column], row.entries[column + 1]];
            let jump = (below >= layout.plain).then(|| [row.entries[column + 2], row.entries[column + 3]]);
            jumps += f64::from(u8::from(jump.is_some()));
            let [d_plus, d_minus] = jump.unwrap_or_default();
            let (coefficient, jump) = match state {
                ContactState::Positive => (c_plus, d_plus),
                ContactState::Negative => (c_minus, d_minus),
                ContactState::Gap => (d_minus - d_plus, d_minus),
            };
            entries[0] += jump;
            entries.push(coefficient);
        }
        // Sums of 1 + jumps entries: their errors, and as many rounding errors.
        let terms = 1.0 + jumps;
        let rounding = if jumps > 0.0 { terms * terms * f64::EPSILON * largest(&row.entries) } else { 0.0 };
        ResolvedRow { entries, pivot: row.pivot, bound: terms * row.bound + rounding }
    }
}

/// Moves the jump of the contact whose columns begin at `column` to the right-hand side. For a contact in its
/// gap, `-(d^+ - d^-)` becomes the column of its share.
fn apply_jump(high: &mut [f64], low: &mut [f64], column: usize, state: ContactState) {
    let entry = |at: usize| DoubleDouble { high: high[at], low: low[at] };
    let (d_plus, d_minus) = (entry(column + 2), entry(column + 3));
    let load = entry(0).plus(if state == ContactState::Positive { d_plus } else { d_minus });
    let share = d_minus.minus(d_plus);
    (high[0], low[0]) = (load.high, load.low);
    if state == ContactState::Gap {
        (high[column], low[column]) = (share.high, share.low);
    }
}

/// Equations, and the pivot for their elimination.
struct Elimination<'a> {
    high: &'a [f64],
    low: &'a [f64],
    at: usize,
    column: usize,
    width: usize,
    stride: usize,
}

impl<'a> Elimination<'a> {
    /// The pivot is the largest entry of its column.
    fn new(high: &'a [f64], low: &'a [f64], [column, width, stride]: [usize; 3]) -> Self {
        let size = |row: &usize| high[row * stride + column].abs();
        let at = (0..high.len() / stride).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or_default();
        Self { high, low, at, column, width, stride }
    }

    /// All rows except the pivot's, minus their multiple of it.
    #[inline(always)]
    fn rows<const FUSED: bool>(&self, high: &mut [f64], low: &mut [f64]) {
        let entry = |at: usize| DoubleDouble { high: self.high[at], low: self.low[at] };
        let first = self.at * self.stride;
        let pivot = entry(first + self.column);
        let pivot_high = &self.high[first..first + self.width];
        let pivot_low = &self.low[first..first + self.width];
        let rows = (0..self.high.len() / self.stride).filter(|row| *row != self.at);
        let targets = high.chunks_exact_mut(self.width).zip(low.chunks_exact_mut(self.width));
        for (row, (high, low)) in rows.zip(targets) {
            let first = row * self.stride;
            let factor = entry(first + self.column).over::<FUSED>(pivot);
            let row_high = &self.high[first..first + self.width];
            let row_low = &self.low[first..first + self.width];
            for j in 0..self.width {
                let product = factor.times::<FUSED>(DoubleDouble { high: pivot_high[j], low: pivot_low[j] });
                let entry = DoubleDouble { high: row_high[j], low: row_low[j] }.minus(product);
                (high[j], low[j]) = (entry.high, entry.low);
            }
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn rows_avx2(&self, high: &mut [f64], low: &mut [f64]) {
        self.rows::<true>(high, low);
    }

    fn run(&self, instructions: Instructions, high: &mut [f64], low: &mut [f64]) {
        match instructions.set() {
            #[cfg(target_arch = "x86_64")]
            #[expect(unsafe_code, reason = "three times as fast as generic x86-64, chosen at run time")]
            // SAFETY: `Instructions` contains only those that the processor has, and AVX-512 is reported only
            // together with AVX2.
            Set::Avx512 | Set::Avx2 => unsafe { self.rows_avx2(high, low) },
            Set::Generic => self.rows::<false>(high, low),
        }
    }
}
