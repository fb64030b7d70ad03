//! Arithmetic modulo primes below `2^62`: eliminations whose numbers do not grow.

use dashu_int::{IBig, Sign, UBig, Word};
use std::sync::{PoisonError, RwLock};

/// So many primes are known when the program is compiled; further ones are sought when they are needed first.
const KNOWN: usize = 16;
const PRIMES: [u64; KNOWN] = known_primes();
static FURTHER: RwLock<Vec<u64>> = RwLock::new(Vec::new());

/// Residues modulo a prime.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field {
    prime: u64,
}

/// A residue by which many others are multiplied.
#[derive(Clone, Copy)]
pub(super) struct Multiplier {
    factor: u64,
    /// `floor(2^64 factor / prime)`, which replaces the division by the prime (Shoup).
    quotient: u64,
    prime: u64,
}

/// What Gauss-Jordan elimination found in some columns.
pub(super) struct Reduced {
    /// The columns that do not depend on those before: column `pivots[i]` is zero except for a 1 in row `i`.
    pub(super) pivots: Vec<usize>,
    /// The place of each row before.
    pub(super) order: Vec<usize>,
    /// The determinant of the first rows in these columns, in the order of all rows before.
    pub(super) determinant: u64,
}

impl Field {
    /// The fields of all primes below `2^62`, from the largest.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        (0..).map(|index| Self { prime: prime(index) })
    }

    /// The residue of an integer.
    pub(super) fn residue(self, value: &IBig) -> u64 {
        let (sign, words) = value.as_sign_words();
        let size = self.residue_of_words(words);
        if sign == Sign::Negative { self.minus(0, size) } else { size }
    }

    /// The residue of a natural number.
    pub(super) fn residue_of_size(self, value: &UBig) -> u64 {
        self.residue_of_words(value.as_words())
    }

    fn residue_of_words(self, words: &[Word]) -> u64 {
        let Some((&last, others)) = words.split_last() else { return 0 };
        let shift = self.multiplier(remainder(1_u128 << Word::BITS, self.prime));
        // Words have 32 bits on some machines.
        let of_word = |word: Word| low(u128::from(word)) % self.prime;
        others.iter().rev().fold(of_word(last), |rest, &word| self.plus(shift.times(rest), of_word(word)))
    }

    fn plus(self, one: u64, other: u64) -> u64 {
        // Both are below 2^62.
        let sum = one + other;
        if sum >= self.prime { sum - self.prime } else { sum }
    }

    pub(super) fn minus(self, one: u64, other: u64) -> u64 {
        if one >= other { one - other } else { one + self.prime - other }
    }

    pub(super) fn times(self, one: u64, other: u64) -> u64 {
        remainder(u128::from(one) * u128::from(other), self.prime)
    }

    /// The inverse of a residue other than 0, by Euclid's algorithm.
    pub(super) fn inverse(self, residue: u64) -> u64 {
        let prime = self.prime.cast_signed();
        let (mut last, mut next) = (prime, residue.cast_signed());
        let (mut factor, mut next_factor) = (0, 1);
        while next != 0 {
            let quotient = last / next;
            (last, next) = (next, last - quotient * next);
            (factor, next_factor) = (next_factor, factor - quotient * next_factor);
        }
        factor.rem_euclid(prime).cast_unsigned()
    }

    pub(super) fn multiplier(self, factor: u64) -> Multiplier {
        let quotient = (u128::from(factor) << 64) / u128::from(self.prime);
        Multiplier { factor, quotient: low(quotient), prime: self.prime }
    }

    /// Gauss-Jordan elimination of the first `unknowns` columns of a matrix; the others are transformed with them.
    pub(super) fn reduce(self, rows: &mut [Vec<u64>], unknowns: usize) -> Reduced {
        let mut order: Vec<usize> = (0..rows.len()).collect();
        let (mut pivots, mut determinant) = (Vec::with_capacity(unknowns), 1);
        for column in 0..unknowns {
            let rank = pivots.len();
            let Some(found) = (rank..rows.len()).find(|&row| rows[row][column] != 0) else { continue };
            if found != rank {
                rows.swap(found, rank);
                order.swap(found, rank);
                determinant = self.minus(0, determinant);
            }
            let pivot = rows[rank][column];
            determinant = self.times(determinant, pivot);
            let inverse = self.multiplier(self.inverse(pivot));
            // Zeros at the end of a row change nothing in others.
            let end = rows[rank].iter().rposition(|entry| *entry != 0).map_or(0, |last| last + 1);
            rows[rank][column..end].iter_mut().for_each(|entry| *entry = inverse.times(*entry));
            let (above, rest) = rows.split_at_mut(rank);
            let Some((pivot_row, below)) = rest.split_first_mut() else { break };
            for row in above.iter_mut().chain(below).filter(|row| row[column] != 0) {
                let factor = self.multiplier(row[column]);
                for (entry, eliminated) in row[column..end].iter_mut().zip(&pivot_row[column..end]) {
                    *entry = self.minus(*entry, factor.times(*eliminated));
                }
            }
            pivots.push(column);
        }
        Reduced { pivots, order, determinant }
    }
}

impl Multiplier {
    pub(super) fn times(self, residue: u64) -> u64 {
        let quotient = low((u128::from(self.quotient) * u128::from(residue)) >> 64);
        // Below twice the prime, so that nothing is lost modulo 2^64.
        let product = self.factor.wrapping_mul(residue).wrapping_sub(quotient.wrapping_mul(self.prime));
        if product >= self.prime { product - self.prime } else { product }
    }
}

/// Integers of any length, known modulo a product of primes.
pub(super) struct Combined {
    modulus: UBig,
    values: Vec<UBig>,
}

impl Combined {
    /// So many integers of which nothing is known.
    pub(super) fn new(integers: usize) -> Self {
        Self { modulus: UBig::ONE, values: vec![UBig::ZERO; integers] }
    }

    /// Adds their residues modulo another prime (Chinese remainder theorem).
    pub(super) fn add(&mut self, field: Field, residues: &[u64]) {
        let inverse = field.multiplier(field.inverse(field.residue_of_size(&self.modulus)));
        for (value, &residue) in self.values.iter_mut().zip(residues) {
            let multiple = inverse.times(field.minus(residue, field.residue_of_size(value)));
            *value += &self.modulus * multiple;
        }
        self.modulus *= field.prime;
    }

    /// The integers, if twice the size of each is below the product of the primes.
    pub(super) fn integers(self) -> Vec<IBig> {
        let half = &self.modulus >> 1;
        let modulus = IBig::from(self.modulus);
        let signed = |value: UBig| {
            if value > half { IBig::from(value) - &modulus } else { IBig::from(value) }
        };
        self.values.into_iter().map(signed).collect()
    }
}

/// The prime below `2^62` of this place, from the largest.
fn prime(index: usize) -> u64 {
    if let Some(prime) = PRIMES.get(index) {
        return *prime;
    }
    let index = index - KNOWN;
    let known = FURTHER.read().unwrap_or_else(PoisonError::into_inner).get(index).copied();
    known.unwrap_or_else(|| {
        let mut further = FURTHER.write().unwrap_or_else(PoisonError::into_inner);
        while further.len() <= index {
            let last = further.last().copied().unwrap_or(PRIMES[KNOWN - 1]);
            further.push(prime_below(last));
        }
        further[index]
    })
}

const fn known_primes() -> [u64; KNOWN] {
    let mut primes = [0; KNOWN];
    let (mut at, mut below) = (0, 1 << 62);
    while at < KNOWN {
        below = prime_below(below);
        primes[at] = below;
        at += 1;
    }
    primes
}

/// The largest prime below a number greater than 100.
const fn prime_below(number: u64) -> u64 {
    let mut candidate = if number.is_multiple_of(2) { number - 1 } else { number - 2 };
    while !is_prime(candidate) {
        candidate -= 2;
    }
    candidate
}

/// Whether an odd number greater than 100 is prime: Miller and Rabin's test with bases that decide all numbers below `2^64`
/// (Sinclair 2011).
const fn is_prime(number: u64) -> bool {
    const SMALL: [u64; 15] = [3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];
    const BASES: [u64; 7] = [2, 325, 9375, 28178, 450_775, 9_780_504, 1_795_265_022];
    let mut at = 0;
    while at < SMALL.len() {
        if number.is_multiple_of(SMALL[at]) {
            return false;
        }
        at += 1;
    }
    at = 0;
    while at < BASES.len() {
        if !is_strong_probable_prime(number, BASES[at] % number) {
            return false;
        }
        at += 1;
    }
    true
}

const fn is_strong_probable_prime(number: u64, base: u64) -> bool {
    let halvings = (number - 1).trailing_zeros();
    let mut exponent = (number - 1) >> halvings;
    let (mut power, mut square) = (1, base);
    while exponent > 0 {
        if exponent % 2 == 1 {
            power = remainder(power as u128 * square as u128, number);
        }
        square = remainder(square as u128 * square as u128, number);
        exponent /= 2;
    }
    if power == 1 || power == number - 1 {
        return true;
    }
    let mut squarings = 1;
    while squarings < halvings {
        power = remainder(power as u128 * power as u128, number);
        if power == number - 1 {
            return true;
        }
        squarings += 1;
    }
    false
}

const fn remainder(value: u128, modulus: u64) -> u64 {
    low(value % modulus as u128)
}

/// A number that is known to have 64 bits.
#[expect(clippy::cast_possible_truncation, reason = "nothing is lost of such a number")]
const fn low(value: u128) -> u64 {
    value as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By SymPy's `prevprime`.
    #[test]
    fn primes_are_the_largest_ones() {
        let distances = [57, 87, 117, 143, 153, 167, 171, 195, 203, 273, 287, 317, 443, 483, 495, 575, 581];
        let primes: Vec<u64> = Field::all().take(distances.len()).map(|field| field.prime).collect();
        assert_eq!(primes, distances.map(|distance| (1 << 62) - distance));
    }

    #[test]
    fn residues_of_products_are_products_of_residues() {
        let numbers = [0, 1, -1, 3, -(1 << 40), i64::MAX, i64::MIN].map(IBig::from);
        for field in Field::all().take(3) {
            for (one, other) in numbers.iter().flat_map(|one| numbers.iter().map(move |other| (one, other))) {
                let [left, right] = [one, other].map(|number| field.residue(number));
                let product = field.residue(&(one * other));
                assert_eq!(field.times(left, right), product);
                assert_eq!(field.multiplier(left).times(right), product);
                assert_eq!(field.residue(&(one - other)), field.minus(left, right));
                assert!(right == 0 || field.times(field.inverse(right), right) == 1);
            }
        }
    }

    #[test]
    fn integers_follow_from_their_residues() {
        let numbers = [IBig::from(-7), (IBig::ONE << 180) + IBig::from(5), -(IBig::ONE << 183)];
        let mut combined = Combined::new(numbers.len());
        for field in Field::all().take(3) {
            combined.add(field, &numbers.each_ref().map(|number| field.residue(number)));
        }
        assert_eq!(combined.integers(), numbers);
    }

    #[test]
    fn elimination_finds_the_columns_that_do_not_depend_on_those_before() {
        let field = Field::all().next().expect("there are primes");
        let rows = [[0, 2, 4, 1], [1, 1, 2, 0], [1, 3, 6, 1]];
        let mut residues = rows.map(|row| row.to_vec());
        let reduced = field.reduce(&mut residues, 4);
        assert_eq!((reduced.pivots, &reduced.order[..]), (vec![0, 1], &[1, 0, 2][..]));
        // Of [0 2; 1 1].
        assert_eq!(reduced.determinant, field.minus(0, 2));
        assert_eq!(residues[2], [0; 4]);
    }
}
