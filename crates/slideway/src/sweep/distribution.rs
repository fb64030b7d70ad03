//! Distributions by their quantiles, and the points of the unit cube at which samples are drawn.

use crate::choice::Choice;
use serde::{Deserialize, Serialize};

/// Constants of the pseudo-random numbers: G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom
/// number generators, OOPSLA 2014 (SplitMix64).
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// How samples are spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spread {
    /// Independent of one another.
    #[default]
    Random,
    /// The sequence of J. H. Halton (Numerische Mathematik 2, 1960), shifted by a random vector: it fills the
    /// ranges more evenly, so that mean values converge faster.
    Halton,
}

impl Choice for Spread {
    const CHOICES: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Random, "random", "Independent of one another"),
        (
            Self::Halton,
            "halton",
            "A randomly shifted Halton sequence: more even, so that shares converge faster",
        ),
    ];
}

/// How many samples there are, and which.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sampling {
    /// Number of samples.
    pub count: u64,
    /// How they are spread.
    pub spread: Spread,
    /// Another seed gives other samples, the same one the same.
    pub seed: u64,
}

impl Sampling {
    /// The coordinate of a sample in one dimension of the unit cube, strictly between 0 and 1.
    pub(super) fn at(self, index: u64, dimension: usize, dimensions: usize) -> f64 {
        match self.spread {
            Spread::Random => {
                let number = index.wrapping_mul(dimensions as u64).wrapping_add(dimension as u64);
                inside(random(self.seed, number))
            }
            Spread::Halton => {
                // The shift of each dimension is a random number of another stream.
                let shift = inside(random(!self.seed, dimension as u64));
                let place = radical_inverse(index + 1, prime(dimension)) + shift;
                (place - place.floor()).clamp(f64::EPSILON, 1.0 - f64::EPSILON)
            }
        }
    }
}

/// The number with this place in the sequence of a seed.
fn random(seed: u64, number: u64) -> u64 {
    let mut z = mix(seed).wrapping_add(number.wrapping_add(1).wrapping_mul(GOLDEN));
    z = mix(z);
    z
}

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// 53 bits as a number strictly between 0 and 1.
fn inside(bits: u64) -> f64 {
    ((bits >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
}

/// The digits of a number mirrored at the point.
fn radical_inverse(mut number: u64, base: u64) -> f64 {
    let (mut inverse, mut unit) = (0.0, 1.0);
    while number > 0 {
        unit /= base as f64;
        inverse += (number % base) as f64 * unit;
        number /= base;
    }
    inverse
}

/// The prime with this number, from 0.
fn prime(index: usize) -> u64 {
    let is_prime = |n: &u64| (2..=n.isqrt()).all(|d| !n.is_multiple_of(d));
    (2..).filter(is_prime).nth(index).unwrap_or(2)
}

/// A distribution of one quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Distribution {
    shape: Shape,
    /// The part of the distribution that is left out at its lower end.
    below: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Uniform { from: f64, to: f64 },
    Normal { mean: f64, deviation: f64 },
    LogNormal { median: f64, deviation: f64 },
}

impl Distribution {
    pub(super) fn uniform(from: f64, to: f64) -> Self {
        Self { shape: Shape::Uniform { from, to }, below: 0.0 }
    }

    pub(super) fn normal(mean: f64, deviation: f64) -> Self {
        Self { shape: Shape::Normal { mean, deviation }, below: 0.0 }
    }

    pub(super) fn lognormal(median: f64, deviation: f64) -> Self {
        Self { shape: Shape::LogNormal { median, deviation }, below: 0.0 }
    }

    /// The distribution under the condition that the quantity is not negative; none if it always is.
    pub(super) fn not_negative(self) -> Option<Self> {
        let below = match self.shape {
            Shape::Uniform { from, to } => (-from / (to - from)).max(0.0),
            Shape::Normal { mean, deviation } => normal_probability(-mean / deviation),
            Shape::LogNormal { .. } => 0.0,
        };
        (below < 1.0).then_some(Self { below, ..self })
    }

    /// The part that [`Self::not_negative`] left out.
    pub(super) fn left_out(&self) -> f64 {
        self.below
    }

    /// The value below which this part of the distribution lies, for parts strictly between 0 and 1.
    pub(super) fn quantile(&self, part: f64) -> f64 {
        let part = self.below + part * (1.0 - self.below);
        let value = match self.shape {
            Shape::Uniform { from, to } => from + part * (to - from),
            Shape::Normal { mean, deviation } => mean + deviation * normal_quantile(part),
            Shape::LogNormal { median, deviation } => median * (deviation * normal_quantile(part)).exp(),
        };
        // Rounding must not take it beyond the end that was cut off.
        if self.below > 0.0 { value.max(0.0) } else { value }
    }
}

/// The probability that a standard normal variable is below `x`.
pub(super) fn normal_probability(x: f64) -> f64 {
    0.5 * libm::erfc(-x / std::f64::consts::SQRT_2)
}

/// The inverse of [`normal_probability`], to about 16 digits: M. J. Wichura, Algorithm AS 241, Applied
/// Statistics 37 (1988), routine PPND16.
pub(super) fn normal_quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(0.180_625 - q * q, &CENTRE);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let r = (-tail.max(f64::MIN_POSITIVE).ln()).sqrt();
    let value = if r <= 5.0 { ratio(r - 1.6, &MIDDLE) } else { ratio(r - 5.0, &TAIL) };
    if q < 0.0 { -value } else { value }
}

/// Numerator and denominator, from the constant on.
type Rational = [[f64; 8]; 2];

fn ratio(x: f64, [above, below]: &Rational) -> f64 {
    let polynomial = |coefficients: &[f64; 8]| coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
    polynomial(above) / polynomial(below)
}

#[rustfmt::skip]
const CENTRE: Rational = [
    [3.387_132_872_796_366_5, 1.331_416_678_917_843_8e2, 1.971_590_950_306_551_3e3, 1.373_169_376_550_946e4,
     4.592_195_393_154_987e4, 6.726_577_092_700_87e4, 3.343_057_558_358_813e4, 2.509_080_928_730_122_7e3],
    [1.0, 4.231_333_070_160_091e1, 6.871_870_074_920_579e2, 5.394_196_021_424_751e3,
     2.121_379_430_158_659_7e4, 3.930_789_580_009_271e4, 2.872_908_573_572_194_3e4, 5.226_495_278_852_545e3],
];
#[rustfmt::skip]
const MIDDLE: Rational = [
    [1.423_437_110_749_683_5, 4.630_337_846_156_546, 5.769_497_221_460_691, 3.647_848_324_763_204_5,
     1.270_458_252_452_368_4, 2.417_807_251_774_506e-1, 2.272_384_498_926_918_4e-2, 7.745_450_142_783_414e-4],
    [1.0, 2.053_191_626_637_759, 1.676_384_830_183_803_8, 6.897_673_349_851e-1,
     1.481_039_764_274_800_8e-1, 1.519_866_656_361_645_7e-2, 5.475_938_084_995_345e-4, 1.050_750_071_644_416_9e-9],
];
#[rustfmt::skip]
const TAIL: Rational = [
    [6.657_904_643_501_103, 5.463_784_911_164_114, 1.784_826_539_917_291_3, 2.965_605_718_285_048_7e-1,
     2.653_218_952_657_612_4e-2, 1.242_660_947_388_078_4e-3, 2.711_555_568_743_487_6e-5, 2.010_334_399_292_288_1e-7],
    [1.0, 5.998_322_065_558_88e-1, 1.369_298_809_227_358e-1, 1.487_536_129_085_061_5e-2,
     7.868_691_311_456_133e-4, 1.846_318_317_510_054_8e-5, 1.421_511_758_316_446e-7, 2.044_263_103_389_939_8e-15],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the standard normal distribution from tables (Abramowitz and Stegun, table 26.1 and 26.5).
    #[test]
    fn the_normal_distribution_is_that_of_the_tables() {
        for (x, p) in [
            (0.0, 0.5),
            (1.0, 0.841_344_746_068_543),
            (2.0, 0.977_249_868_051_821),
            (-3.0, 0.001_349_898_031_630),
        ] {
            assert!((normal_probability(x) - p).abs() < 1e-14, "{x}");
        }
        assert!((normal_quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-14);
        assert!((normal_quantile(0.995) - 2.575_829_303_548_901).abs() < 1e-14);
    }

    #[test]
    fn quantiles_invert_probabilities() {
        for step in 1..400 {
            let x = -8.0 + 0.04 * f64::from(step);
            let p = normal_probability(x);
            if p < 0.999 {
                let back = normal_quantile(p);
                assert!((back - x).abs() <= 2e-13 * x.abs().max(1.0), "{x}: {back}");
            }
        }
    }

    #[test]
    fn friction_is_never_negative() {
        let cut = Distribution::normal(0.1, 0.1).not_negative().expect("most of it is positive");
        assert!((cut.left_out() - normal_probability(-1.0)).abs() < 1e-15);
        assert!(cut.quantile(1e-12) >= 0.0 && cut.quantile(1e-12) < 1e-6);
        // Its median divides the positive part into halves.
        let half = 0.5 * (normal_probability(-1.0) + 1.0);
        assert!((cut.quantile(0.5) - (0.1 + 0.1 * normal_quantile(half))).abs() < 1e-15);
        let uniform = Distribution::uniform(-0.2, 0.2).not_negative().expect("half of it is positive");
        assert!((uniform.quantile(0.5) - 0.1).abs() < 1e-15);
        assert!(Distribution::uniform(-0.2, -0.1).not_negative().is_none());
    }

    #[test]
    fn samples_fill_the_unit_square() {
        for spread in [Spread::Random, Spread::Halton] {
            let sampling = Sampling { count: 4000, spread, seed: 1 };
            let mut cells = [0; 16];
            for index in 0..sampling.count {
                let [x, y] = [0, 1].map(|dimension| sampling.at(index, dimension, 2));
                assert!(0.0 < x && x < 1.0 && 0.0 < y && y < 1.0);
                let quarter = |share: f64| [0.25, 0.5, 0.75].iter().filter(|end| share >= **end).count();
                cells[quarter(x) + 4 * quarter(y)] += 1;
            }
            // 250 each; the standard deviation of independent ones is 15.
            let limit = if spread == Spread::Random { 60 } else { 12 };
            assert!(cells.iter().all(|count: &i32| (count - 250).abs() <= limit), "{spread:?}: {cells:?}");
        }
    }

    /// The first numbers of SplitMix64 for the state 0 (as published with the algorithm) are those of the
    /// mixer.
    #[test]
    fn the_generator_is_the_published_one() {
        assert_eq!(mix(GOLDEN), 0xE220_A839_7B1D_CDAF);
        assert_eq!(mix(GOLDEN.wrapping_mul(2)), 0x6E78_9E6A_A1B9_65F4);
    }
}
