//! Solutions of linear equations in integers by Cramer's rule, from their residues modulo primes.
//!
//! Every determinant is known from its residues modulo primes whose product is more than twice its size, which Hadamard's
//! inequality bounds. No number grows in between, as those of an elimination in integers do.

use dashu_int::IBig;
use dashu_int::ops::BitTest;

use super::residues::{Combined, Field};

/// Primes are so little below 2 to this power that a product of some million of them has lost less than one bit.
const BITS_OF_PRIME: usize = 62;

/// Solutions of `A x = b` for some `b`: the unknowns are these numerators over the determinant.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cramer {
    /// `det A`, not zero.
    pub(crate) determinant: IBig,
    /// One list of unknowns for each right-hand side.
    pub(crate) numerators: Vec<Vec<IBig>>,
}

/// Solves `A X = B`, given the rows of `[A | B]`, for so many unknowns. There may be further equations, which are then ignored:
/// `A` consists of the first independent ones. Returns `None` if the columns of `A` are dependent, or once `proceed` is
/// `false`.
pub(super) fn solve(
    rows: &[Vec<IBig>],
    unknowns: usize,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Cramer> {
    let primes = primes_for(rows.iter().map(|row| row.iter()));
    if rows.len() > unknowns {
        let square: Vec<Vec<IBig>> =
            independent(rows, unknowns, primes, proceed)?.into_iter().map(|row| rows[row].clone()).collect();
        return solve(&square, unknowns, proceed);
    }
    let sides = rows.first().map_or(0, |row| row.len() - unknowns);
    let mut combined = Combined::new(1 + sides * unknowns);
    let (mut used, mut vanishing) = (0, 0);
    for field in Field::all() {
        if used == primes || vanishing > primes {
            break;
        }
        if !proceed() {
            return None;
        }
        let mut residues = residues_of(field, rows);
        let reduced = field.reduce(&mut residues, unknowns);
        if reduced.pivots.len() < unknowns {
            // Only so many primes divide a determinant of this size, unless it is zero.
            vanishing += 1;
            continue;
        }
        used += 1;
        let factor = field.multiplier(reduced.determinant);
        let numerators = (unknowns..unknowns + sides)
            .flat_map(|side| residues.iter().map(move |row| factor.times(row[side])));
        let all: Vec<u64> = std::iter::once(reduced.determinant).chain(numerators).collect();
        combined.add(field, &all);
    }
    if used < primes {
        return None;
    }
    let mut integers = combined.integers().into_iter();
    let determinant = integers.next()?;
    let numerators = (0..sides).map(|_| integers.by_ref().take(unknowns).collect()).collect();
    Some(Cramer { determinant, numerators })
}

/// The first independent rows, as many as there are unknowns; `None` if there are fewer.
fn independent(
    rows: &[Vec<IBig>],
    unknowns: usize,
    primes: usize,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<usize>> {
    for field in Field::all().take(primes + 1) {
        if !proceed() {
            return None;
        }
        let reduced = field.reduce(&mut residues_of(field, rows), unknowns);
        if reduced.pivots.len() == unknowns {
            return Some(reduced.order[..unknowns].to_vec());
        }
    }
    None
}

pub(super) fn residues_of(field: Field, rows: &[Vec<IBig>]) -> Vec<Vec<u64>> {
    rows.iter().map(|row| row.iter().map(|entry| field.residue(entry)).collect()).collect()
}

/// How many primes determine the determinants of all square matrices of some columns of a matrix, by Hadamard's inequality
/// for its rows.
pub(super) fn primes_for<'e>(rows: impl Iterator<Item = impl Iterator<Item = &'e IBig>>) -> usize {
    // The product of the squares of their norms, which no zero row makes smaller.
    let squares = rows.map(|row| row.fold(IBig::ZERO, |sum, entry| sum + entry * entry));
    let product = squares.filter(|square| !square.is_zero()).fold(IBig::ONE, |all, square| all * square);
    // The size of a determinant is below 2 to this power; one more for the sign, and one for what primes have lost.
    let bits = product.bit_len().div_ceil(2);
    (bits + 2).div_ceil(BITS_OF_PRIME)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integers(rows: &[&[i64]]) -> Vec<Vec<IBig>> {
        rows.iter().map(|row| row.iter().map(|&entry| IBig::from(entry)).collect()).collect()
    }

    #[test]
    fn equations_are_solved_by_determinants() {
        let rows = integers(&[&[0, 2, 1, 4], &[3, -1, 0, 2]]);
        let solved = solve(&rows, 2, &mut || true).expect("regular");
        // det [0 2; 3 -1] = -6; x = (1/6, 1/2) and (4/3, 2).
        assert_eq!(solved.determinant, IBig::from(-6));
        assert_eq!(solved.numerators, integers(&[&[-1, -3], &[-8, -12]]));
        assert_eq!(solve(&integers(&[&[2, 4, 1], &[1, 2, 1]]), 2, &mut || true), None);
    }

    /// Hilbert's matrix times the common denominator of its entries: the entries of its inverse are integers that are known
    /// (Choi 1983), and the first column of that of size 12 sums up to -12.
    #[test]
    fn great_determinants_are_exact() {
        let size = 12;
        let common = (1..2 * size as u64).fold(IBig::ONE, |all, number| {
            use dashu_int::ops::Gcd;
            let divisor = IBig::from((&all).gcd(&IBig::from(number)));
            all * IBig::from(number) / divisor
        });
        let row = |row: usize| {
            let entry = |column: usize| &common / IBig::from(row + column + 1);
            (0..size).map(entry).chain([IBig::from(u8::from(row == 0)) * &common]).collect()
        };
        let rows: Vec<Vec<IBig>> = (0..size).map(row).collect();
        let solved = solve(&rows, size, &mut || true).expect("regular");
        let inverse: Vec<IBig> =
            solved.numerators[0].iter().map(|numerator| numerator / &solved.determinant).collect();
        assert_eq!(inverse[0], IBig::from(144));
        assert_eq!(inverse[1], IBig::from(-10_296));
        assert_eq!(inverse.into_iter().sum::<IBig>(), IBig::from(-12));
    }

    /// Where equations are left over, those are taken that determine the unknowns.
    #[test]
    fn further_equations_tell_unknowns_apart() {
        let rows = integers(&[&[1, 1, 3], &[2, 2, 6], &[1, -1, 1]]);
        let solved = solve(&rows, 2, &mut || true).expect("independent columns");
        assert_eq!(solved.numerators[0], [&solved.determinant * IBig::from(2), solved.determinant.clone()]);
    }
}
