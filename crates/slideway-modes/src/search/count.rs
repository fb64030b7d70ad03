//! Numbers of solutions of any size.

use std::fmt;

/// Nine decimal digits per limb.
const BASE: u64 = 1_000_000_000;

/// A number of any size.
///
/// ```
/// use slideway_modes::BigCount;
/// let mut count = BigCount::from(1);
/// (0..100).for_each(|_| count = count.times(&BigCount::from(2)));
/// assert_eq!(count.to_string(), "1267650600228229401496703205376");
/// assert_eq!(count.to_u64(), None);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct BigCount {
    /// Limbs below [`BASE`], the least significant first, without leading zeros.
    limbs: Vec<u64>,
}

impl From<u64> for BigCount {
    fn from(number: u64) -> Self {
        let mut count = Self { limbs: vec![number % BASE, number / BASE % BASE, number / BASE / BASE] };
        count.trim();
        count
    }
}

impl BigCount {
    /// The sum of two numbers.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let length = self.limbs.len().max(other.limbs.len());
        let limb = |number: &Self, at: usize| number.limbs.get(at).copied().unwrap_or(0);
        let mut sum = Self { limbs: Vec::with_capacity(length + 1) };
        let mut carry = 0;
        for at in 0..=length {
            let total = limb(self, at) + limb(other, at) + carry;
            sum.limbs.push(total % BASE);
            carry = total / BASE;
        }
        sum.trim();
        sum
    }

    /// The product of two numbers.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut limbs = vec![0; self.limbs.len() + other.limbs.len() + 1];
        for (at, &one) in self.limbs.iter().enumerate() {
            let mut carry = 0;
            for (offset, limb) in limbs[at..].iter_mut().enumerate() {
                let total = *limb + one * other.limbs.get(offset).copied().unwrap_or(0) + carry;
                *limb = total % BASE;
                carry = total / BASE;
            }
        }
        let mut product = Self { limbs };
        product.trim();
        product
    }

    /// The difference from a number that is not larger; zero if it is larger.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        let mut difference = Self { limbs: Vec::with_capacity(self.limbs.len()) };
        let mut borrowed = 0;
        for (at, &limb) in self.limbs.iter().enumerate() {
            let taken = other.limbs.get(at).copied().unwrap_or(0) + borrowed;
            borrowed = u64::from(limb < taken);
            difference.limbs.push(limb + borrowed * BASE - taken);
        }
        if borrowed == 1 || other.limbs.len() > self.limbs.len() {
            return Self::default();
        }
        difference.trim();
        difference
    }

    /// Whether the number is zero.
    pub fn is_zero(&self) -> bool {
        self.limbs.is_empty()
    }

    /// The number, if it fits.
    pub fn to_u64(&self) -> Option<u64> {
        let add = |number: u64, &limb: &u64| number.checked_mul(BASE)?.checked_add(limb);
        self.limbs.iter().rev().try_fold(0, add)
    }

    fn trim(&mut self) {
        while self.limbs.last() == Some(&0) {
            self.limbs.pop();
        }
    }
}

impl fmt::Display for BigCount {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut limbs = self.limbs.iter().rev();
        let first = limbs.next().map_or_else(|| "0".to_owned(), ToString::to_string);
        let digits = limbs.fold(first, |digits, limb| format!("{digits}{limb:09}"));
        formatter.pad(&digits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_machine_integers() {
        let numbers = [0, 1, 999_999_999, 1_000_000_000, 18_446_744_073, 4_294_967_295];
        for one in numbers {
            for other in numbers {
                let (a, b) = (BigCount::from(one), BigCount::from(other));
                assert_eq!(a.plus(&b).to_string(), (one + other).to_string());
                assert_eq!(a.plus(&b).minus(&b), a);
                let product = u128::from(one) * u128::from(other);
                assert_eq!(a.times(&b).to_string(), product.to_string());
                assert_eq!(a.times(&b).to_u64(), u64::try_from(product).ok());
                assert_eq!(a.minus(&b).to_string(), one.saturating_sub(other).to_string());
            }
        }
        assert_eq!(BigCount::from(u64::MAX).to_u64(), Some(u64::MAX));
    }
}
