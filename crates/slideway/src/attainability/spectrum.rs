//! Eigenvalues of the fast motion of one mode, and what they mean.

use super::inertia::Inertia;
use super::shared::SharedGaps;
use nalgebra::{Complex, DMatrix, LU, Schur};

/// Imaginary parts below this multiple of an eigenvalue are rounding: double eigenvalues lose half of the
/// digits.
const REAL: f64 = 1e-7;
/// Inverse eigenvalues below this multiple of the greatest are zero within rounding.
const ZERO: f64 = 1e-13;
/// Sizes of eigenvalues with which everything that follows stays within the range of floating point.
const USUAL: std::ops::RangeInclusive<f64> = 1e-100..=1e100;
/// Steps of the QR algorithm.
const STEPS: usize = 1000;

/// What the eigenvalues of a fast motion mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stability {
    /// All are real and positive.
    Attainable,
    /// Some are complex with positive real part; the damping that suppresses it.
    Flutter(Damping),
    /// Some have no positive real part.
    Unattainable,
    /// Some are zero or infinite within rounding.
    Unclear,
}

/// Least damping of the contacts that suppresses flutter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Damping {
    /// delta (s), zero where only motions without mass flutter.
    pub(super) time: f64,
    /// zeta = delta sqrt|lambda| / 2.
    pub(super) ratio: f64,
}

impl Stability {
    /// Whether both are of the same kind.
    pub(super) fn agrees(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }

    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Unattainable, _) | (_, Self::Unattainable) => Self::Unattainable,
            (Self::Unclear, _) | (_, Self::Unclear) => Self::Unclear,
            (Self::Flutter(one), Self::Flutter(other)) => {
                let greater = one.time > other.time || (one.time == other.time && one.ratio > other.ratio);
                Self::Flutter(if greater { one } else { other })
            }
            (Self::Flutter(damping), Self::Attainable) | (Self::Attainable, Self::Flutter(damping)) => {
                Self::Flutter(damping)
            }
            (Self::Attainable, Self::Attainable) => Self::Attainable,
        }
    }

    /// Of one eigenvalue. With `x'' + lambda (x + delta x') = 0`, `lambda = a + i b`, a solution
    /// `exp(i omega t)` has `omega^2 = |lambda|^2 / a` and `delta = |b| / (sqrt(a) |lambda|)`: for `a > 0`
    /// the motion is stable above this damping, for `a <= 0` never.
    fn of(lambda: Complex<f64>) -> Self {
        let (a, b) = (lambda.re, lambda.im);
        if !(a > 0.0 && a.is_finite()) {
            return Self::Unattainable;
        }
        if is_real(lambda) {
            return Self::Attainable;
        }
        let size = lambda.norm();
        let time = b.abs() / (a.sqrt() * size);
        Self::Flutter(Damping { time, ratio: time * size.sqrt() / 2.0 })
    }
}

pub(super) fn is_real(lambda: Complex<f64>) -> bool {
    lambda.im.abs() <= REAL * lambda.norm()
}

/// Eigenvalues of the fast motion `lambda Y gap = C S K gap` of one mode, with `C S = [c_k sigma_k]` of eq.
/// (6) and the stiffnesses `K`.
#[derive(Debug, Clone)]
pub(super) struct Spectrum {
    /// Those of motions with mass, ascending by real part.
    pub(super) finite: Vec<Complex<f64>>,
    /// Number of negative eigenvalues, those of motions without mass included.
    pub(super) negative: usize,
    pub(super) stability: Stability,
}

impl Spectrum {
    /// Whether both have the same eigenvalues within rounding.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let greatest = self.finite.iter().map(|lambda| lambda.norm()).fold(0.0, f64::max);
        let has = |all: &[Complex<f64>], one: &Complex<f64>| {
            all.iter().any(|other| (one - other).norm() <= REAL * greatest)
        };
        self.finite.len() == other.finite.len()
            && self.negative == other.negative
            && self.finite.iter().all(|one| has(&other.finite, one))
            && other.finite.iter().all(|one| has(&self.finite, one))
    }
}

/// One mode with its factors, for any stiffnesses and ratios of vanishing masses.
pub(super) struct Pencil<'i> {
    inertia: &'i Inertia,
    mode: DMatrix<f64>,
    /// (C S)^-1 Y_left; none if redundant guides share their load: then stiffnesses count in it.
    compliance: Option<DMatrix<f64>>,
    shared: Option<&'i SharedGaps>,
}

impl<'i> Pencil<'i> {
    /// The pencil of a mode with the matrix `C S`; none if that is singular.
    pub(super) fn new(
        inertia: &'i Inertia,
        mode: DMatrix<f64>,
        shared: Option<&'i SharedGaps>,
    ) -> Option<Self> {
        if shared.is_some() {
            return Some(Self { inertia, mode, compliance: None, shared });
        }
        let compliance = LU::new(mode.clone()).solve(&inertia.left)?;
        compliance.iter().all(|entry| entry.is_finite()).then_some(Self {
            inertia,
            mode,
            compliance: Some(compliance),
            shared,
        })
    }

    pub(super) fn inertia(&self) -> &'i Inertia {
        self.inertia
    }

    /// `K^-1 (C S)^-1 left`, or for redundant guides `((C S)_kept K E)^-1 left`.
    fn compliance(&self, stiffness: &[f64]) -> Option<DMatrix<f64>> {
        match (&self.compliance, self.shared) {
            (Some(compliance), _) => {
                let mut compliance = compliance.clone();
                for (mut row, stiffness) in compliance.row_iter_mut().zip(stiffness) {
                    row /= *stiffness;
                }
                Some(compliance)
            }
            (None, Some(shared)) => LU::new(shared.stiff(&self.mode, stiffness)).solve(&self.inertia.left),
            (None, None) => None,
        }
    }

    /// The eigenvalues for these stiffnesses and vanishing masses; none if they cannot be computed.
    ///
    /// The finite ones are the inverse eigenvalues of `right^T K^-1 (C S)^-1 left`, where motions without
    /// mass do not enter.
    pub(super) fn spectrum(&self, stiffness: &[f64], ratios: &[f64]) -> Option<Spectrum> {
        let compliance = self.compliance(stiffness)?;
        let inverse = eigenvalues(&(self.inertia.right.transpose() * compliance))?;
        let greatest = inverse.iter().map(|value| value.norm()).fold(0.0, f64::max);
        let clear = inverse.iter().all(|value| value.norm() > ZERO * greatest);
        let mut finite: Vec<Complex<f64>> = inverse
            .into_iter()
            .filter(|value| value.norm() > ZERO * greatest)
            .map(|value| value.inv())
            .collect();
        finite.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
        if !finite.iter().all(|value| USUAL.contains(&value.norm())) {
            return None;
        }
        let massless = self.massless(stiffness, ratios)?;
        let mut stability = if clear { Stability::Attainable } else { Stability::Unclear };
        stability = finite.iter().fold(stability, |all, lambda| all.and(Stability::of(*lambda)));
        // Motions without mass are infinitely fast: any damping suppresses their flutter.
        stability = massless.iter().fold(stability, |all, lambda| {
            all.and(match Stability::of(*lambda) {
                Stability::Flutter(Damping { ratio, .. }) => Stability::Flutter(Damping { time: 0.0, ratio }),
                other => other,
            })
        });
        let is_negative = |lambda: &&Complex<f64>| is_real(**lambda) && lambda.re < 0.0;
        let negative = finite.iter().chain(&massless).filter(is_negative).count();
        Some(Spectrum { finite, negative, stability })
    }

    /// Eigenvalues of the motions without mass, times their vanishing mass: `lambda E = left^T C S K right`.
    fn massless(&self, stiffness: &[f64], ratios: &[f64]) -> Option<Vec<Complex<f64>>> {
        let [right, left] = &self.inertia.massless;
        if right.ncols() == 0 {
            return Some(Vec::new());
        }
        let block = if let Some(shared) = self.shared {
            left.transpose() * shared.stiff(&self.mode, stiffness) * right
        } else {
            let mut stiff = right.clone();
            for (mut row, stiffness) in stiff.row_iter_mut().zip(stiffness) {
                row *= *stiffness;
            }
            left.transpose() * &self.mode * stiff
        };
        eigenvalues(&LU::new(self.inertia.vanishing(ratios)).solve(&block)?)
    }
}

/// The eigenvalues of a small matrix; none if they do not converge or are not finite.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let values = match matrix.nrows() {
        0 => Vec::new(),
        1 => vec![Complex::new(matrix[(0, 0)], 0.0)],
        2 => quadratic(matrix).to_vec(),
        _ => {
            let schur = Schur::try_new(matrix.clone(), f64::EPSILON, STEPS)?;
            schur.complex_eigenvalues().iter().copied().collect()
        }
    };
    values.iter().all(|value| value.re.is_finite() && value.im.is_finite()).then_some(values)
}

/// Both eigenvalues of a matrix of two rows: mean +- sqrt(difference^2 + product of the others).
fn quadratic(matrix: &DMatrix<f64>) -> [Complex<f64>; 2] {
    let [a, b, c, d] = [matrix[(0, 0)], matrix[(0, 1)], matrix[(1, 0)], matrix[(1, 1)]];
    let (mean, half) = (f64::midpoint(a, d), (a - d) / 2.0);
    let discriminant = half * half + b * c;
    if discriminant < 0.0 {
        let imaginary = (-discriminant).sqrt();
        return [Complex::new(mean, imaginary), Complex::new(mean, -imaginary)];
    }
    let far = mean + discriminant.sqrt().copysign(mean);
    let determinant = a * d - b * c;
    let near = if far == 0.0 { 0.0 } else { determinant / far };
    [Complex::new(far, 0.0), Complex::new(near, 0.0)]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

    use super::{Stability, eigenvalues};
    use nalgebra::{Complex, DMatrix};

    /// Roots of s^2 + lambda (1 + delta s) = 0 lie on the left above the damping, and not below.
    #[test]
    fn flutter_ends_at_the_computed_damping() {
        for (re, im) in [(1.0, 0.3), (2.0, -5.0), (0.01, 1.0), (300.0, 1.0)] {
            let lambda = Complex::new(re, im);
            // A real matrix with this pair of eigenvalues.
            let values = eigenvalues(&DMatrix::from_row_slice(2, 2, &[re, im, -im, re])).unwrap();
            assert!(values.iter().all(|value| (value.im.abs() - im.abs()).abs() < 1e-12));
            let Stability::Flutter(damping) = Stability::of(lambda) else { panic!("{lambda} is complex") };
            assert!(
                (damping.ratio - damping.time * lambda.norm().sqrt() / 2.0).abs() < 1e-12 * damping.ratio
            );
            for (factor, grows) in [(0.999, true), (1.001, false)] {
                let damped = lambda * (factor * damping.time);
                let root = (damped * damped - lambda * 4.0).sqrt();
                let greatest = ((-damped + root) / 2.0).re.max(((-damped - root) / 2.0).re);
                assert_eq!(greatest > 0.0, grows, "{lambda} {factor}");
            }
        }
        assert_eq!(Stability::of(Complex::new(-1.0, 2.0)), Stability::Unattainable);
    }
}
