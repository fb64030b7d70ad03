//! Random problems of several kinds.

use nalgebra::{DMatrix, DVector};
use slideway::modes::ModeProblem;
use slideway::raw_problem::RawProblem;

/// A family of problems, by name.
pub(crate) struct Family {
    pub(crate) name: &'static str,
    pub(crate) problem: fn(&mut Random) -> RawProblem,
}

pub(crate) const FAMILIES: &[Family] = &[
    Family { name: "nearly equal jumps", problem: nearly_equal_jumps },
    Family { name: "extreme scales", problem: |random| any_kind(random, 1, extreme) },
    Family { name: "triangular, extreme scales", problem: triangular },
    Family { name: "sums that round", problem: sums_that_round },
    Family { name: "small whole numbers", problem: |random| any_kind(random, 1, |random| random.integer(2)) },
    Family { name: "random numbers", problem: |random| any_kind(random, 3, Random::number) },
];

/// SplitMix64 (Steele, Lea and Flood, 2014).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0xd134_2543_de82_ef95))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, most: u64) -> u64 {
        self.next() % most
    }

    /// From -1 to 1.
    fn number(&mut self) -> f64 {
        (self.next() >> 11) as f64 * 2.0_f64.powi(-52) - 1.0
    }

    /// A whole number of at most this size.
    fn integer(&mut self, most: u64) -> f64 {
        self.below(2 * most + 1) as f64 - most as f64
    }

    fn matrix(&mut self, n: usize, entry: fn(&mut Self) -> f64) -> DMatrix<f64> {
        DMatrix::from_fn(n, n, |_, _| entry(self))
    }

    fn vector(&mut self, n: usize, entry: fn(&mut Self) -> f64) -> DVector<f64> {
        DVector::from_fn(n, |_, _| entry(self))
    }
}

/// A size up to 6, mostly smaller: the oracle takes 2^n or 3^n patterns.
fn size(random: &mut Random, least: u64) -> usize {
    let most = if random.below(12) == 0 { 6 } else { 4 };
    usize::try_from(least + random.below(most - least + 1)).unwrap_or(1)
}

/// A problem of any type with such entries.
fn any_kind(random: &mut Random, least: u64, entry: fn(&mut Random) -> f64) -> RawProblem {
    let n = size(random, least);
    let (a, b) = (random.matrix(n, entry), random.matrix(n, entry));
    let q = random.vector(n, entry);
    match random.below(4) {
        0 => RawProblem::LinearComplementarity { m: a, q },
        // The halves of a sum that must not overflow.
        1 => RawProblem::AbsoluteValue { a: a * 0.25, b: b * 0.25, right_hand_side: q },
        2 => RawProblem::HorizontalComplementarity { a, b, q },
        _ => {
            let n = n.min(4);
            let (a, b) = (a.view((0, 0), (n, n)).into_owned(), b.view((0, 0), (n, n)).into_owned());
            let q = q.rows(0, n).into_owned();
            let (mut up, mut down) = (random.matrix(n, entry), random.matrix(n, entry));
            for k in 0..n {
                if random.below(2) == 0 {
                    down.set_column(k, &up.column(k).clone_owned());
                } else if random.below(4) == 0 {
                    up.column_mut(k).fill(0.0);
                }
            }
            RawProblem::Modes(ModeProblem::new(a, b, up, down, q).expect("finite numbers"))
        }
    }
}

/// Zero, or a small whole number times a power of two of any size.
fn extreme(random: &mut Random) -> f64 {
    if random.below(4) == 0 {
        return 0.0;
    }
    // Often of a few sizes only, so that quotients of them meet again.
    let exponent = match random.below(3) {
        0 => random.integer(1015),
        1 => 1000.0 * random.integer(1),
        _ => 520.0 * random.integer(1),
    };
    let half = (exponent / 2.0).trunc();
    random.integer(5) * half.exp2() * (exponent - half).exp2()
}

/// Jumps that differ by a few units in the last place, and loads near them, so that some unknowns are in
/// between.
fn nearly_equal_jumps(random: &mut Random) -> RawProblem {
    let n = usize::try_from(1 + random.below(3)).unwrap_or(1);
    let eighths: fn(&mut Random) -> f64 = |random| random.integer(16) / 8.0;
    let any = eighths(random);
    let columns = DMatrix::from_fn(n, n, |row, k| if row == k { 1.0 } else { any * random.integer(1) / 4.0 });
    let up = random.matrix(n, |random| 1.0 + random.integer(8) / 8.0 + 0.1 * random.integer(1));
    let mut down = up.clone();
    for entry in down.iter_mut() {
        let steps = random.integer(400);
        *entry += steps * 2.0_f64.powi(-52 - i32::try_from(random.below(30)).unwrap_or(0) / 10);
    }
    // Between the sums of the jumps of both sides, so that N is about zero.
    let share = random.below(5) as f64 / 4.0;
    let load = -(up.column_sum() * share + down.column_sum() * (1.0 - share));
    let negative = -&columns;
    RawProblem::Modes(ModeProblem::new(columns, negative, up, down, load).expect("finite numbers"))
}

/// Absolute value equations whose `A + B` and `B - A` are no floating-point numbers, often with whole
/// solutions.
fn sums_that_round(random: &mut Random) -> RawProblem {
    let n = size(random, 1);
    let large = 2.0_f64.powi(i32::try_from(40 + random.below(80)).unwrap_or(60));
    // Whole multiples of a large power of two, and small numbers that get lost beside them.
    let a = DMatrix::from_fn(n, n, |_, _| {
        if random.below(3) == 0 { random.integer(3) } else { large * random.integer(2) }
    });
    let b = random.matrix(n, |random| if random.below(3) == 0 { 0.0 } else { random.integer(3) });
    let b = if random.below(3) == 0 { b * (1.0 / 3.0) } else { b };
    let x = random.vector(n, |random| random.integer(2));
    // With zeros in A x the load is what B adds; else something near.
    let load = if random.below(3) == 0 {
        random.vector(n, |random| random.integer(3))
    } else {
        &a * &x + &b * x.abs()
    };
    RawProblem::AbsoluteValue { a, b, right_hand_side: load }
}

/// Complementarity problems of 7 unknowns, each acting on later ones only, so that they are solved one after
/// the other.
fn triangular(random: &mut Random) -> RawProblem {
    let n = 7;
    let m = DMatrix::from_fn(n, n, |row, k| match row.cmp(&k) {
        std::cmp::Ordering::Less => 0.0,
        std::cmp::Ordering::Equal => 2.0_f64.powf(random.integer(600)) * (1.0 + random.below(3) as f64),
        std::cmp::Ordering::Greater if random.below(2) == 0 => 0.0,
        std::cmp::Ordering::Greater => extreme(random),
    });
    let q = random.vector(n, extreme);
    RawProblem::LinearComplementarity { m, q }
}
