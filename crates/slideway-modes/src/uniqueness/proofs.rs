//! Sufficient conditions for all determinants to have one sign, each requiring a few matrix operations.

use crate::dense::solution;
use nalgebra::{DMatrix, DVector};

/// By how much the spectral radius must be below 1.
const MARGIN: f64 = 1e-8;

/// Matrices `P^+` and `P^-`, each known up to an error: each column `k` of a pattern is taken from one of
/// them.
pub(super) struct Family {
    pub(super) sides: [DMatrix<f64>; 2],
    /// Sum of the error bounds of both sides, entry by entry.
    pub(super) errors: DMatrix<f64>,
}

impl Family {
    /// Whether it is proven that all determinants are nonzero and of one sign.
    ///
    /// With `A = (P^+ + P^-) / 2` and `B = (P^+ - P^-) / 2`, a pattern's matrix is `A + B S`,
    /// `S = diag(sigma)`. If, for some `R`, `R (A + B S)` is regular for all diagonal `|S| <= 1`, then
    /// `det (A + B S)` does not change sign. This is the case if
    ///
    /// - `T v < v` for some `v > 0` with `T = |I - R A| + |R B|`: the spectral radius of `T` is below 1; or
    /// - `||I - R A|| + sigma_max(R B) < 1`.
    ///
    /// `R` is an approximate inverse of `A`; errors of `A` and `B` and all rounding are added to `T`.
    pub(super) fn has_one_sign(&self) -> bool {
        let size = self.errors.nrows();
        let [positive, negative] = &self.sides;
        let (a, b) = ((positive + negative) * 0.5, (positive - negative) * 0.5);
        let Some(inverse) = a.clone().try_inverse() else { return false };
        let deviation = (DMatrix::identity(size, size) - &inverse * &a).abs();
        let preconditioned = &inverse * &b;
        // Products of r terms each, and the rounding of A and B.
        let rounding = (size + 4) as f64 * f64::EPSILON;
        let sizes = (a.abs() + b.abs()) * rounding + &self.errors;
        let doubt = (inverse.abs() * sizes + DMatrix::identity(size, size) * rounding) * (1.0 + 1e-10);
        let uncertain = deviation + doubt;
        dominates(&(&uncertain + preconditioned.abs())) || contracts(&preconditioned, uncertain.norm())
    }
}

/// Whether `T v < v` for a positive `v`: then the spectral radius of `T >= 0` is below 1.
///
/// `v = (I - (1 + margin) T)^-1 1` is positive exactly if the spectral radius is below `1 / (1 + margin)`,
/// and then `T v <= v / (1 + margin)`. However `v` was computed, only the last inequality counts.
fn dominates(t: &DMatrix<f64>) -> bool {
    let size = t.nrows();
    let matrix = DMatrix::identity(size, size) - t * (1.0 + MARGIN);
    let Some(v) = solution(matrix, &DVector::repeat(size, 1.0)) else { return false };
    let image = t * &v;
    // Sums of nonnegative numbers: rounding is far below the margin.
    v.iter().zip(&image).all(|(v, image)| *v > 0.0 && v.is_finite() && *image < *v * (1.0 - MARGIN / 2.0))
}

/// Whether `sigma_max(G) < 1 - deviation`: the Cholesky factorization of `t^2 I - G^T G` succeeds, with its
/// own rounding errors subtracted.
fn contracts(g: &DMatrix<f64>, deviation: f64) -> bool {
    let size = g.nrows();
    let limit = 1.0 - deviation * (1.0 + 1e-9);
    let rounding = 8.0 * (size + 4) as f64 * f64::EPSILON * (g.norm_squared() + size as f64);
    let room = limit * limit - rounding;
    // Written so that NaN proves nothing.
    if !(limit > 0.0 && room > 0.0) {
        return false;
    }
    (DMatrix::identity(size, size) * room - g.transpose() * g).cholesky().is_some()
}
