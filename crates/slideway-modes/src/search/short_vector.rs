//! Farkas vectors with short integer entries, for proof files.

use super::relaxation::{Relaxation, sum_of_sizes};
use super::states::StateSet;
use crate::simplex::{Basis, add_multiple, dot};
use crate::solutions::ContactSet;

/// Rounding to multiples of the unit changes products by at most half the sum of sizes of a column's entries;
/// slightly more, for the rounding of the estimate.
const HALF_AND_MORE: f64 = 0.51;
/// Ratios of entries may be off by this.
const RATIO_ERROR: f64 = 1e-9;
/// The largest of the smallest entries of integers with given ratios.
const LARGEST_LEAST: u8 = 6;
/// Entries up to this are exact, and so are their sums.
const GREATEST_ENTRY: f64 = 9.0e15;

impl Relaxation {
    /// A vector in integers that excludes a node, from one in floating point and the basis that led to it, and the
    /// columns of sides that it does not exclude. `None` if the products with some of the allowed columns leave no
    /// room for rounding. With jumps, entries for the equations of shares are still to be added.
    ///
    /// At the basis most products `v . C_j` are zero. Moving `v` by a multiple of `-sum_i B^-T e_i` makes all
    /// those of basic columns negative at once; how far is limited by the other columns and by what `v . b` exceeds.
    /// The larger the resulting margin, the fewer digits are needed.
    pub(super) fn short(
        &self,
        farkas: &[f64],
        states: &[StateSet],
        allowed: &ContactSet,
        basis: &Basis,
    ) -> Option<(Vec<f64>, ContactSet)> {
        let (shift, shifts) = basis.sum_of_inverse_rows(&self.program);
        let products = self.program.row_combination(farkas);
        let sides: Vec<usize> = self.variables_of_sides(allowed).collect();
        let (right, shares) = (self.program.right_hand_side(), self.shares(states));
        let load_size = right.iter().fold(f64::MIN_POSITIVE, |most: f64, entry| most.max(entry.abs()));
        // What the shares take of `v . b` at most, for `v` and for the shift, and the sum of all terms.
        let (mut excess, mut loss) = (dot(farkas, right), dot(&shift, right) + load_size);
        let mut terms = sum_of_sizes(right);
        for &(variable, least, most) in &shares {
            let (product, shift) = (products[variable], shifts[variable].unwrap_or(1.0));
            excess -= (least * product).max(most * product);
            loss += (-least * shift).max(-most * shift);
            terms += most * self.column_sum(variable);
        }
        let mut step = excess / loss.max(f64::MIN_POSITIVE);
        for &variable in &sides {
            if let Some(slope) = shifts[variable].map(|shift| 1.0 - shift).filter(|&slope| slope > 0.0) {
                step = step.min(-products[variable] / slope);
            }
        }
        if !(step > 0.0 && step.is_finite()) {
            return None;
        }
        let mut moved = farkas.to_vec();
        add_multiple(&mut moved, -step, &shift);
        let columns = sides.iter().map(|&variable| self.column_sum(variable));
        let largest = columns.fold(terms / load_size, f64::max);
        let scale = HALF_AND_MORE * largest / step;
        // No negative zeros.
        let rounded: Vec<f64> = moved.iter().map(|entry| (entry * scale).round() + 0.0).collect();
        if !rounded.iter().all(|entry| entry.abs() <= GREATEST_ENTRY) {
            return None;
        }
        let left = self.not_excluded_by(&rounded)?;
        left.is_disjoint(allowed).then_some((rounded, left))
    }
}

/// The integers whose ratios are those of the entries of a vector, up to rounding, if the smallest of them is at
/// most 6: those of the basis of a problem with small integers. They prove something only once verified.
pub(super) fn small_integers(vector: &[f64]) -> Option<Vec<f64>> {
    let largest = vector.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
    let sizes = vector.iter().map(|entry| entry.abs()).filter(|&size| size > RATIO_ERROR * largest);
    let least = sizes.fold(f64::INFINITY, f64::min);
    (1..=LARGEST_LEAST).map(f64::from).find_map(|factor| {
        let scaled = || vector.iter().map(|entry| entry / least * factor);
        let is_whole = |entry: f64| (entry - entry.round()).abs() <= RATIO_ERROR * entry.abs().max(1.0);
        // No negative zeros.
        scaled().all(is_whole).then(|| scaled().map(|entry| entry.round() + 0.0).collect())
    })
}
