//! Farkas vectors with short integer entries, for proof files.

use super::relaxation::{Relaxation, sum_of_sizes};
use super::states::StateSet;
use crate::simplex::{Basis, add_multiple, dot};
use crate::solutions::ContactSet;

/// Rounding to multiples of the unit changes products by at most half the sum of sizes of a column's entries;
/// slightly more, for the rounding of the estimate.
const HALF_AND_MORE: f64 = 0.51;
/// The largest of the integers with given ratios.
const LARGEST_INTEGER: f64 = (1_u64 << 21) as f64;
/// Multiples of ratios that are integers may be off by this; those of other numbers up to the largest one are off by more.
const FRACTION_ERROR: f64 = 1e-7;
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
        if self.slacks() > 0 {
            return self.rounded(farkas, allowed);
        }
        let (shift, shifts) = basis.sum_of_inverse_rows(&self.program);
        let products = self.program.row_combination(farkas);
        let sides: Vec<usize> = self.variables_of_sides(allowed).collect();
        let (right, shares) = (self.load(), self.shares(states));
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
        self.in_units(&moved, HALF_AND_MORE * largest / step, allowed)
    }

    /// Returns a vector in integers that excludes a node, as `short` does, from one whose products with the
    /// columns of all sides are negative.
    fn rounded(&self, farkas: &[f64], allowed: &ContactSet) -> Option<(Vec<f64>, ContactSet)> {
        let products = self.program.row_combination(farkas);
        let ratio = |variable: usize| self.column_sum(variable) / -products[variable];
        // Those of slacks are entries of the vector, whose signs do not change.
        let ratios = self.variables_of_sides(allowed).filter(|&variable| !self.is_slack(variable)).map(ratio);
        let largest = ratios.fold(sum_of_sizes(self.load()) / self.load_product(farkas), f64::max);
        self.in_units(farkas, HALF_AND_MORE * largest, allowed)
    }

    /// A vector times a factor in integers, if it excludes all allowed sides, and the columns that it does not exclude.
    fn in_units(&self, vector: &[f64], factor: f64, allowed: &ContactSet) -> Option<(Vec<f64>, ContactSet)> {
        // No negative zeros.
        let rounded: Vec<f64> = vector.iter().map(|entry| (entry * factor).round() + 0.0).collect();
        if !rounded.iter().all(|entry| entry.abs() <= GREATEST_ENTRY) {
            return None;
        }
        let left = self.not_excluded_by(&rounded)?;
        left.is_disjoint(allowed).then_some((rounded, left))
    }
}

/// An integer that is exact in floating point, of at most 63 bits.
#[expect(clippy::cast_possible_truncation, reason = "nothing is lost of such an integer")]
pub(super) fn integer(entry: f64) -> i64 {
    entry as i64
}

/// The integers whose ratios are those of the entries of a vector, up to rounding, if they are short: those of the
/// basis of a problem with integers. They prove something only once verified.
pub(super) fn small_integers(vector: &[f64]) -> Option<Vec<f64>> {
    let largest = vector.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
    let mut factor = 1.0;
    for entry in vector {
        factor *= denominator(factor * entry / largest)?;
    }
    // No negative zeros.
    (factor <= LARGEST_INTEGER)
        .then(|| vector.iter().map(|entry| (factor * entry / largest).round() + 0.0).collect())
}

/// The denominator of the simplest fraction that a number is within rounding, by continued fractions.
fn denominator(number: f64) -> Option<f64> {
    let (mut before, mut denominator, mut rest) = (0.0, 1.0, number.abs().fract());
    while denominator <= LARGEST_INTEGER {
        let multiple = denominator * number;
        if (multiple - multiple.round()).abs() <= FRACTION_ERROR {
            return Some(denominator);
        }
        let inverse = rest.recip();
        (before, denominator) = (denominator, inverse.floor() * denominator + before);
        rest = inverse.fract();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_are_found_from_their_ratios() {
        let ratios = [1.0 / 3.0, 0.0, -2.0 / 7.0, 1.0];
        assert_eq!(small_integers(&ratios), Some(vec![7.0, 0.0, -6.0, 21.0]));
        // Weights of a subset-sum problem, divided by one of them.
        let weights = [50_021.0, -31_337.0, 99_991.0, 131_072.0];
        let divided: Vec<f64> = weights.iter().map(|weight| weight / weights[1]).collect();
        let found =
            small_integers(&divided).map(|found| found.iter().map(|entry| entry.abs()).collect::<Vec<_>>());
        assert_eq!(found, Some(weights.map(f64::abs).to_vec()));
        assert_eq!(small_integers(&[1.0, std::f64::consts::SQRT_2]), None);
        assert_eq!(small_integers(&[1.0, 1e-9 * std::f64::consts::PI]), Some(vec![1.0, 0.0]));
    }
}
