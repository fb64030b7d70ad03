//! Signs of determinants in exact arithmetic, with sums of floating-point numbers.
//!
//! A number is held as a sum of `f64` that do not overlap, smallest first (J. R. Shewchuk, Adaptive
//! precision floating-point arithmetic, 1997): sums and products are exact as long as nothing
//! overflows or underflows.

/// Largest matrix; its `2^r` minors are held at a time.
const LARGEST: usize = 14;

/// The sign of a determinant (-1, 0, 1) whose entries are at most 1 in size; none if the matrix is
/// too large, or its entries range too widely for products to be exact.
pub(super) fn determinant_sign(columns: &[Vec<f64>]) -> Option<i8> {
    let size = columns.len();
    if size == 0 {
        return Some(1);
    }
    if size > LARGEST {
        return None;
    }
    // 2^shift is as large as r! 2^(r shift) allows without overflow.
    let shift = 960 / i32::try_from(size).ok()?;
    let lowest =
        columns.iter().flatten().filter(|entry| **entry != 0.0).map(|entry| lowest_bit(*entry)).min();
    let Some(lowest) = lowest else { return Some(0) };
    if (lowest + shift).saturating_mul(i32::try_from(size).ok()?) < -1000 {
        return None;
    }
    let unit = f64::from(shift).exp2();
    let mut minors: Vec<Vec<f64>> = vec![Vec::new(); 1 << size];
    minors[0].push(1.0);
    for rows in 1..1_usize << size {
        let column = &columns[rows.count_ones() as usize - 1];
        let mut sum = Vec::new();
        let mut sign = 1.0;
        for row in (0..size).rev().filter(|row| rows >> row & 1 == 1) {
            add_product(&mut sum, &minors[rows & !(1 << row)], sign * column[row] * unit);
            sign = -sign;
        }
        minors[rows] = sum;
    }
    let largest = minors[(1 << size) - 1].last().copied().unwrap_or(0.0);
    Some(if largest > 0.0 { 1 } else { -i8::from(largest < 0.0) })
}

/// The exponent of the last bit that is set.
fn lowest_bit(value: f64) -> i32 {
    let bits = value.to_bits();
    let exponent = i32::try_from(bits >> 52 & 0x7ff).unwrap_or(0);
    let fraction = bits & ((1 << 52) - 1);
    let (significand, exponent) = if exponent == 0 { (fraction, 1) } else { (fraction | 1 << 52, exponent) };
    exponent - 1075 + i32::try_from(significand.trailing_zeros()).unwrap_or(0)
}

/// `sum += number factor`
fn add_product(sum: &mut Vec<f64>, number: &[f64], factor: f64) {
    if factor == 0.0 {
        return;
    }
    for &part in number {
        let product = part * factor;
        let rest = part.mul_add(factor, -product);
        add(sum, rest);
        add(sum, product);
    }
}

/// `sum += value`
fn add(sum: &mut Vec<f64>, value: f64) {
    let mut carried = value;
    let mut kept = 0;
    for at in 0..sum.len() {
        let part = sum[at];
        // Knuth's sum without error.
        let total = carried + part;
        let of_part = total - carried;
        let rest = (carried - (total - of_part)) + (part - of_part);
        carried = total;
        if rest != 0.0 {
            sum[kept] = rest;
            kept += 1;
        }
    }
    sum.truncate(kept);
    if carried != 0.0 {
        sum.push(carried);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_of_the_last_bit_are_seen() {
        let tiny = f64::EPSILON;
        for (entry, expected) in [(1.0 - tiny, -1), (1.0, 0), (1.0 + tiny, 1)] {
            // [[entry, 1, 1], [1, 1, 1], [1, 1, 3]] / 4
            let columns: Vec<Vec<f64>> = [[entry, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 3.0]]
                .iter()
                .map(|column| column.iter().map(|entry| entry / 4.0).collect())
                .collect();
            assert_eq!(determinant_sign(&columns), Some(expected));
        }
        // 3 x 3 of rank 2 whose products round: rows (0.1, 0.2, 0.3), (0.7, 0.5, 0.4) and their sum over 2.
        let (one, two) = ([0.1, 0.2, 0.3], [0.7, 0.5, 0.4]);
        let columns: Vec<Vec<f64>> = (0..3).map(|k| vec![one[k], two[k], one[k]]).collect();
        assert_eq!(determinant_sign(&columns), Some(0));
    }

    #[test]
    fn what_would_not_be_exact_is_refused() {
        assert_eq!(determinant_sign(&[vec![1e-300]]), Some(1));
        assert_eq!(determinant_sign(&[vec![-1e-200, 1.0], vec![1.0, 0.0]]), Some(-1));
        let mut columns = vec![vec![1.0; 4]; 4];
        columns[0][0] = 1e-200;
        assert_eq!(determinant_sign(&columns), None);
        assert_eq!(determinant_sign(&vec![vec![1.0; 15]; 15]), None);
        assert_eq!(determinant_sign(&[vec![0.0]]), Some(0));
    }
}
