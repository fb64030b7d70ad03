//! What the elastic guides move: the inertia that the gaps of the contacts feel, and the motions without any.

use crate::configuration::null_space;
use crate::kinetics::{KineticEquations, MasslessMotions, Reaction};
use nalgebra::{DMatrix, LU};

/// Columns that depend on one another to within this are dependent.
const DEPENDENT: f64 = 1e-10;

/// The matrix Y of `Y gap'' = N - N(friction)`, and its null spaces.
///
/// `Y = left right^T` with as many columns as there are gaps with inertia. The other gaps, `massless[0]`, and
/// the directions in which nothing resists, `massless[1]`, are orthonormal; `Y massless[0] = 0`,
/// `massless[1]^T Y = 0`.
#[derive(Debug, Clone)]
pub(super) struct Inertia {
    pub(super) matrix: DMatrix<f64>,
    pub(super) left: DMatrix<f64>,
    pub(super) right: DMatrix<f64>,
    pub(super) massless: [DMatrix<f64>; 2],
    /// The motions of the massless bodies that open the gaps `massless`.
    motions: [DMatrix<f64>; 2],
    /// For each massless acceleration the factor that makes it a translation: 1, or a length for rotations.
    lengths: Vec<f64>,
}

impl Inertia {
    /// The inertia of the gaps of a mechanism whose size is `length`; none if the motions that carry no mass
    /// and the directions in which nothing resists differ in number or are dependent, which only drives can
    /// bring about.
    /// These hinges are elastic, too; the others are rigid.
    pub(super) fn new(equations: &KineticEquations, hinges: &[Reaction], length: f64) -> Option<Self> {
        let matrix = equations.contact_inertia(hinges);
        let lengths: Vec<f64> = equations
            .massless_accelerations()
            .iter()
            .map(|index| if equations.layout.is_rotation(*index) { length } else { 1.0 })
            .collect();
        let [motions, tests] = equations.massless_motions(hinges);
        let [(right_gaps, motions), (left_gaps, tests)] = [orthonormal(motions)?, orthonormal(tests)?];
        if right_gaps.ncols() != left_gaps.ncols() {
            return None;
        }
        let [right, left] = [&right_gaps, &left_gaps].map(complement);
        let core = left.transpose() * &matrix * &right;
        // Without drives Y is symmetric, and its root keeps the eigenvalue problem symmetric where friction
        // vanishes.
        let symmetric =
            (&core - core.transpose()).amax() <= DEPENDENT * core.amax() && left_gaps == right_gaps;
        let root = if symmetric { core.clone().cholesky() } else { None };
        let (left, right) = match root {
            Some(root) => (left * root.l(), right * root.l()),
            None => (left * core, right),
        };
        let massless = [right_gaps, left_gaps];
        Some(Self { matrix, left, right, massless, motions: [motions, tests], lengths })
    }

    /// That of gaps of which none is without inertia.
    pub(super) fn of_matrix(matrix: DMatrix<f64>) -> Self {
        let none = || [DMatrix::zeros(matrix.nrows(), 0), DMatrix::zeros(matrix.nrows(), 0)];
        Self {
            left: matrix.clone(),
            right: DMatrix::identity(matrix.nrows(), matrix.nrows()),
            massless: none(),
            motions: none(),
            lengths: Vec::new(),
            matrix,
        }
    }

    /// Number of gaps without inertia.
    pub(super) fn massless_gaps(&self) -> usize {
        self.massless[0].ncols()
    }

    /// Number of masses and moments of inertia that vanish.
    pub(super) fn vanishing_masses(&self) -> usize {
        self.lengths.len()
    }

    /// The inertia of the gaps `massless` when the masses are small: these ratios, moments of inertia being
    /// ratio x length^2.
    pub(super) fn vanishing(&self, ratios: &[f64]) -> DMatrix<f64> {
        let mut moved = self.motions[0].clone();
        for (index, mut row) in moved.row_iter_mut().enumerate() {
            row *= ratios[index] * self.lengths[index] * self.lengths[index];
        }
        self.motions[1].transpose() * moved
    }

    /// The inverse of Y, whose massless gaps have `share` of the inertia of the others.
    pub(super) fn inverse(&self, share: f64) -> Option<DMatrix<f64>> {
        if self.massless_gaps() == 0 {
            return LU::new(self.matrix.clone()).try_inverse();
        }
        let vanishing = self.vanishing(&vec![1.0; self.vanishing_masses()]);
        let factor = match (self.matrix.amax(), vanishing.amax()) {
            (inertia, small) if inertia > 0.0 && small > 0.0 => share * inertia / small,
            _ => 1.0,
        };
        let added = &self.massless[1] * vanishing * self.massless[0].transpose() * factor;
        LU::new(&self.matrix + added).try_inverse()
    }
}

/// The directions at right angles to some gaps.
fn complement(gaps: &DMatrix<f64>) -> DMatrix<f64> {
    if gaps.is_empty() {
        DMatrix::identity(gaps.nrows(), gaps.nrows())
    } else {
        null_space(&gaps.transpose())
    }
}

/// Orthonormal gaps, and the motions that open them; none if different motions open the same gaps.
fn orthonormal(massless: MasslessMotions) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let MasslessMotions { mut motions, mut gaps } = massless;
    for column in 0..gaps.ncols() {
        let before = gaps.column(column).norm();
        // Twice is enough (Gram and Schmidt).
        for _ in 0..2 {
            for other in 0..column {
                let part = gaps.column(other).dot(&gaps.column(column));
                let [gap, motion] = [&gaps, &motions].map(|matrix| matrix.column(other) * part);
                gaps.column_mut(column).axpy(-1.0, &gap, 1.0);
                motions.column_mut(column).axpy(-1.0, &motion, 1.0);
            }
        }
        let length = gaps.column(column).norm();
        if length.is_nan() || length <= DEPENDENT * before {
            return None;
        }
        gaps.column_mut(column).unscale_mut(length);
        motions.column_mut(column).unscale_mut(length);
    }
    Some((gaps, motions))
}

#[cfg(test)]
mod tests {
    use super::super::spectrum::{Pencil, Stability};
    use super::Inertia;
    use nalgebra::DMatrix;

    /// Of two motions without mass that react to each other, with the stiffness [[1, -3], [1, 2]]: equal
    /// masses flutter, (1 + 2)^2 < 4 x 5, masses of 0.1 and 10 do not, (10 + 0.2)^2 > 4 x 5.
    #[test]
    fn ratios_of_vanishing_masses_can_decide() {
        let both = || [DMatrix::identity(2, 2), DMatrix::identity(2, 2)];
        let inertia = Inertia {
            matrix: DMatrix::zeros(2, 2),
            left: DMatrix::zeros(2, 0),
            right: DMatrix::zeros(2, 0),
            massless: both(),
            motions: both(),
            lengths: vec![1.0; 2],
        };
        let mode = DMatrix::from_row_slice(2, 2, &[1.0, -3.0, 1.0, 2.0]);
        let pencil = Pencil::new(&inertia, mode, None).expect("regular");
        let stability = |ratios: &[f64]| pencil.spectrum(&[1.0; 2], ratios).expect("computed").stability;
        assert!(matches!(stability(&[1.0, 1.0]), Stability::Flutter(damping) if damping.time == 0.0));
        assert_eq!(stability(&[0.1, 10.0]), Stability::Attainable);
    }
}
