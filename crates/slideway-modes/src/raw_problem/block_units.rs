//! Units of the blocks of an equation: powers of two, in which its numbers are of similar sizes.
//!
//! With `x_j = 2^(s_j) x'_j` the problem `x = b + H |x|` is one of the same kind, with `H_ij 2^(s_j - s_i)` and
//! `b_i 2^(-s_i)`. The largest numbers in the row of a block, other than its own, are made as large as those in its column
//! (Osborne, Journal of the ACM 7 (1960)); the load is part of the rows.

use dashu_int::UBig;
use dashu_int::ops::BitTest;
use dashu_ratio::RBig;
use nalgebra::DMatrix;

use crate::blocks::{BlockProblem, rows_of_block};
use crate::interval::Interval;
use crate::interval_matrix::IntervalMatrix;
use crate::problem::{BySide, Side};

/// Exponents of all numbers fit in about 11 bits, and each sweep halves what is left.
const SWEEPS: usize = 24;
/// Powers of two up to this exponent are numbers.
const LARGEST_POWER: i32 = 1000;

/// The units of all blocks, and the problem in these units; as it is if numbers overflow in them.
pub(super) fn in_own_units(problem: BlockProblem) -> (Vec<i32>, BlockProblem) {
    let units = units_of(&problem);
    let rows_of = |(block, &unit): (usize, &i32)| problem.rows_of(block).map(move |_| unit);
    let of_rows: Vec<i32> = units.iter().enumerate().flat_map(rows_of).collect();
    let scaled = |part: &IntervalMatrix, units: &[i32]| {
        let scaled = DMatrix::from_fn(part.shape().0, part.shape().1, |row, column| {
            let entry = (part.centre()[(row, column)], part.radius()[(row, column)]);
            entry_times_power(entry, units[column] - of_rows[row])
        });
        IntervalMatrix::around(scaled.map(|(centre, _)| centre), scaled.map(|(_, radius)| radius))
    };
    let within = || {
        let response = BySide::same(scaled(problem.response(Side::Positive), &units)?);
        let jumps = BySide::same(problem.jumps(Side::Positive).clone());
        BlockProblem::within_bounds(response, jumps, scaled(problem.load(), &[0])?).ok()
    };
    match within() {
        Some(scaled) => (units, scaled),
        None => (vec![0; units.len()], problem),
    }
}

/// The units of all blocks, and the problem in these units, from exact numbers of any size: the columns of the blocks and
/// that of the load, whose rows are those of [`BlockProblem`]. `None` if numbers overflow in these units, too.
pub(super) fn exactly_in_own_units(columns: &[Vec<RBig>]) -> Option<(Vec<i32>, BlockProblem)> {
    let (blocks, rows) = (columns.len() - 1, columns[0].len());
    let contacts = 2 * blocks - rows;
    let rows_of = |block: usize| rows_of_block(contacts, block);
    let size = |block: usize, column: usize| {
        rows_of(block).map(|row| exponent(&columns[column][row])).fold(f64::NEG_INFINITY, f64::max)
    };
    let units = units(blocks, size);
    let of_rows: Vec<i32> =
        units.iter().enumerate().flat_map(|(block, &unit)| rows_of(block).map(move |_| unit)).collect();
    let scaled = |columns: &[Vec<RBig>], units: &[i32]| {
        IntervalMatrix::from_intervals(&DMatrix::from_fn(rows, columns.len(), |row, column| {
            Interval::around_ratio(&ratio_times_power(&columns[column][row], units[column] - of_rows[row]))
        }))
    };
    let (response, load) = columns.split_at(blocks);
    let no_jumps = BySide::same(IntervalMatrix::exact(DMatrix::zeros(rows, contacts)));
    let response = BySide::same(scaled(response, &units)?);
    let problem = BlockProblem::within_bounds(response, no_jumps, scaled(load, &[0])?).ok()?;
    Some((units, problem))
}

/// Exponents of the units of all blocks of a problem.
fn units_of(problem: &BlockProblem) -> Vec<i32> {
    // A number that may be zero, within its error, has no size.
    let size = |part: &IntervalMatrix, block: usize, column: usize| {
        let entry = |row: usize| (part.centre()[(row, column)].abs(), part.radius()[(row, column)]);
        let certain = |(centre, radius): &(f64, f64)| centre > radius;
        let sizes = problem.rows_of(block).map(entry).filter(certain).map(|(centre, _)| centre);
        sizes.fold(0.0, f64::max).log2()
    };
    let blocks = problem.blocks();
    units(blocks, |block, column| {
        if column < blocks {
            size(problem.response(Side::Positive), block, column)
        } else {
            size(problem.load(), block, 0)
        }
    })
}

/// Exponents of the units of so many blocks, from the exponent of the largest number in the rows of a block, of each
/// column: those of the blocks, and that of the load.
fn units(blocks: usize, size: impl Fn(usize, usize) -> f64) -> Vec<i32> {
    let sizes = DMatrix::from_fn(blocks, blocks + 1, size);
    let mut units = vec![0.0_f64; blocks];
    for _ in 0..SWEEPS {
        for block in 0..blocks {
            let others = (0..blocks).filter(|&other| other != block);
            let in_row = others.clone().map(|other| sizes[(block, other)] + units[other]);
            let row = in_row.fold(sizes[(block, blocks)], f64::max);
            let column =
                others.map(|other| sizes[(other, block)] - units[other]).fold(f64::NEG_INFINITY, f64::max);
            units[block] = match (row.is_finite(), column.is_finite()) {
                (true, true) => 0.5 * (row - column),
                (true, false) => row,
                (false, true) => -column,
                (false, false) => 0.0,
            };
        }
    }
    #[expect(clippy::cast_possible_truncation, reason = "sums of some exponents of floating-point numbers")]
    let exponents = units.into_iter().map(|unit| unit.round() as i32);
    exponents.collect()
}

/// The exponent of a number within one; of zero, that of nothing.
fn exponent(value: &RBig) -> f64 {
    let bits = |length: usize| length as f64;
    if value.is_zero() {
        f64::NEG_INFINITY
    } else {
        bits(value.numerator().bit_len()) - bits(value.denominator().bit_len())
    }
}

/// Returns `value 2^exponent`.
fn ratio_times_power(value: &RBig, exponent: i32) -> RBig {
    let power = RBig::from(UBig::ONE << exponent.unsigned_abs() as usize);
    if exponent < 0 { value / power } else { value * power }
}

/// `value 2^exponent`, rounded only if the result is subnormal or overflows.
pub(super) fn times_power(value: f64, exponent: i32) -> f64 {
    let (mut value, mut rest) = (value, exponent);
    while rest != 0 && value != 0.0 && value.is_finite() {
        let step = rest.clamp(-LARGEST_POWER, LARGEST_POWER);
        value *= 2.0_f64.powi(step);
        rest -= step;
    }
    value
}

/// Returns `value 2^exponent` for bounds, rounded outwards.
pub(super) fn interval_times_power(value: Interval, exponent: i32) -> Interval {
    let is_exact = |bound: f64| times_power(times_power(bound, exponent), -exponent) == bound;
    let [lower, upper] = [value.lower(), value.upper()].map(|bound| times_power(bound, exponent));
    let lower = if is_exact(value.lower()) { lower } else { lower.next_down() };
    let upper = if is_exact(value.upper()) { upper } else { upper.next_up() };
    Interval::new(lower, upper).unwrap_or(Interval::REAL_LINE)
}

/// Returns `value 2^exponent` for a number and its maximum error, which grows by what rounding loses.
fn entry_times_power((centre, radius): (f64, f64), exponent: i32) -> (f64, f64) {
    let scaled = [centre, radius].map(|value| times_power(value, exponent));
    let is_exact = scaled.map(|value| times_power(value, -exponent)) == [centre, radius];
    // Both are rounded by less than the least number, as they are subnormal.
    let lost = if is_exact { 0.0 } else { f64::MIN_POSITIVE };
    (scaled[0], if lost == 0.0 { scaled[1] } else { (scaled[1] + lost).next_up() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    /// The second block acts on the first with 2^1000, the first on none: with its load 4 as its unit, the effect on the first
    /// is the unit of that.
    #[test]
    fn units_balance_rows_and_columns() {
        let response = dmatrix![0.5, 2.0_f64.powi(1000); 0.0, 0.25];
        let none = BySide::same(DMatrix::zeros(2, 2));
        let problem = BlockProblem::new(BySide::same(response), none, dvector![1.0, 4.0]).expect("finite");
        let (units, scaled) = in_own_units(problem);
        assert_eq!(units, [1002, 2]);
        assert_eq!(scaled.response(Side::Positive).centre(), &dmatrix![0.5, 1.0; 0.0, 0.25]);
        assert_eq!(scaled.response(Side::Positive).radius().amax(), 0.0);
    }

    /// What blocks do to one another is zero but for rounding errors: their loads alone are their units.
    #[test]
    fn errors_of_zeros_have_no_size() {
        let none = BySide::same(IntervalMatrix::exact(DMatrix::zeros(2, 2)));
        let rounded =
            IntervalMatrix::around(dmatrix![0.5, 1e-17; -1e-17, 2.0], dmatrix![0.0, 2e-17; 1e-17, 0.0]);
        let response = BySide::same(rounded.expect("finite"));
        let load = IntervalMatrix::exact(dmatrix![0.5; -1.0]);
        let problem = BlockProblem::within_bounds(response, none, load).expect("finite");
        assert_eq!(units_of(&problem), [-1, 0]);
    }

    #[test]
    fn powers_of_two_round_only_beyond_the_range() {
        assert_eq!(times_power(1.5, 2000), f64::INFINITY);
        assert_eq!(times_power(f64::MAX, -1000) * 2.0_f64.powi(1000), f64::MAX);
        let tiny = interval_times_power(Interval::point(1.0 + f64::EPSILON), -1040);
        assert!(tiny.lower() < tiny.upper() && tiny.lower() > 0.0);
        let (centre, radius) = entry_times_power((1.0 + f64::EPSILON, 0.0), -1040);
        assert!(radius > 0.0 && centre > 0.0);
        assert_eq!(entry_times_power((3.0, 0.5), -900).1, 2.0_f64.powi(-901));
    }
}
