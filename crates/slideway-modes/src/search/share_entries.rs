//! Entries of vectors for the equations `lambda + lambda' = 1`, for proof files.

use dashu_int::IBig;

use super::short_vector::integer;
use crate::certificate::LiftedSystem;
use crate::solutions::ContactSet;

/// Entries of columns are smaller than 2 to this power, and those of vectors than 2 to the second one, so that sums
/// over all rows, and of as many of them, are exact.
const COLUMN_BITS: u32 = 72;
const VECTOR_BITS: u32 = 42;
const MOST_ROWS: usize = 1 << 6;
/// The rows of the file differ from those of the columns by at most 2 to this power.
const MOST_BITS_APART: u32 = 80;

/// The columns of shares and the right-hand side, without the equations of shares.
#[derive(Clone)]
pub(super) struct ShareEntries {
    columns: Vec<Vec<i128>>,
    right: Vec<i128>,
    /// In vectors for the rows of the file, the other entries or those of shares are multiplied by 2 to these powers.
    factors: [u32; 2],
    /// The number of the first column.
    first: usize,
}

impl ShareEntries {
    /// For vectors whose rows are those of the lifted equations times 2 to the given powers. `None` if there are no
    /// shares, or the numbers are too long.
    pub(super) fn new(system: &LiftedSystem, rows: &[i32]) -> Option<Self> {
        let (contacts, first) = (system.contacts(), 2 * system.contacts());
        let exponents = rows.iter().zip(system.exponents()).map(|(rows, own)| rows - own);
        let exponents: Vec<i32> = exponents.take(contacts).collect();
        let least = exponents.iter().min()?;
        let shifts: Option<Vec<usize>> =
            exponents.iter().map(|exponent| usize::try_from(exponent - least).ok()).collect();
        let shifts = shifts?;
        let short = |column: &[IBig]| -> Option<Vec<i128>> {
            let entry = |(entry, &shift): (&IBig, &usize)| {
                let entry = i128::try_from(&(entry << shift)).ok()?;
                (entry.unsigned_abs() >> COLUMN_BITS == 0).then_some(entry)
            };
            column.iter().zip(&shifts).map(entry).collect()
        };
        let columns: Option<Vec<Vec<i128>>> =
            (first..system.width()).map(|column| short(system.column(column))).collect();
        let right = short(system.right())?;
        let fits = system.rows() > contacts && contacts <= MOST_ROWS;
        // The rows of the file are these times 2^least, and times 2^rows for shares.
        let apart = rows.get(contacts)? - least;
        let factors = [apart, -apart].map(|power| u32::try_from(power).unwrap_or(0));
        let fits = fits && factors.iter().all(|&power| power <= MOST_BITS_APART);
        fits.then_some(Self { columns: columns?, right, factors, first })
    }

    /// The vector for the rows of the file, with the largest entries for the equations of shares that make no product
    /// with an allowed column positive; rounded down as far as `v . b > 0` permits. Columns of shares that it does
    /// not exclude are added to those left. `None` if `v . b` is not positive.
    pub(super) fn completed(
        &self,
        vector: &[f64],
        allowed: &ContactSet,
        left: &mut ContactSet,
    ) -> Option<Vec<i128>> {
        let vector: Vec<i128> = vector.iter().map(|&entry| i128::from(integer(entry))).collect();
        if vector.iter().any(|entry| entry.unsigned_abs() >> VECTOR_BITS != 0) {
            return None;
        }
        let product = |column: &Vec<i128>| -> i128 { vector.iter().zip(column).map(|(a, b)| a * b).sum() };
        let products: Vec<i128> = self.columns.iter().map(product).collect();
        let largest = |(at, pair): (usize, &[i128])| {
            let allowed = (0..2).filter(|side| allowed.contains(self.first + 2 * at + side));
            allowed.map(|side| pair[side]).max().unwrap_or_default()
        };
        let entries: Vec<i128> = products.chunks(2).enumerate().map(|pair| -largest(pair)).collect();
        let excess = product(&self.right) + entries.iter().sum::<i128>();
        if excess <= 0 {
            return None;
        }
        // Fewer bits take less than half of the excess from all entries together.
        let spare = (excess.ilog2()).saturating_sub(2 + entries.len().ilog2());
        let entries: Vec<i128> = entries.into_iter().map(|entry| entry >> spare << spare).collect();
        for (at, product) in products.iter().enumerate() {
            if product + entries[at / 2] > 0 {
                left.insert(self.first + at);
            }
        }
        let [own, shares] = self.factors;
        if entries.iter().any(|entry| entry.unsigned_abs().leading_zeros() <= shares + 1) {
            return None;
        }
        let scaled =
            vector.iter().map(|entry| entry << own).chain(entries.iter().map(|entry| entry << shares));
        let mut scaled: Vec<i128> = scaled.collect();
        let common = scaled.iter().fold(0, |bits, entry| bits | entry).trailing_zeros();
        scaled.iter_mut().for_each(|entry| *entry >>= common.min(127));
        Some(scaled)
    }
}
