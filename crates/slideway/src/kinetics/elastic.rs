//! Inertia and massless motions that the contacts of slightly elastic guides feel (theory, section 7).

use super::{KineticEquations, Reaction};
use crate::configuration::null_space;
use crate::ids::ContactId;
use nalgebra::{DMatrix, DVector};

/// Motions of massless bodies that the elastic guides allow and the other joints, too, one in each column.
#[derive(Debug, Clone)]
pub(crate) struct MasslessMotions {
    /// Accelerations without mass that such a motion has: rows are the massless ones among the 3 of each
    /// body.
    pub(crate) motions: DMatrix<f64>,
    /// The gaps of the contacts that they open.
    pub(crate) gaps: DMatrix<f64>,
}

impl KineticEquations {
    /// Y: the normal forces that unit accelerations of the gaps of the contacts need, `N = Y gap''` (kg).
    /// Of the contacts that are not cut: the gaps of the others follow from theirs. Square; with `M` symmetric and positive definite on the motions `G_r x = 0` it is the inverse of
    /// `G_c M^-1 G_c^T` there.
    ///
    /// Of these hinges, which are elastic, too, both components of their gaps follow.
    pub(crate) fn contact_inertia(&self, hinges: &[Reaction]) -> DMatrix<f64> {
        let (rows, answers) = (self.elastic_rows(hinges), self.answers_to_gaps(hinges));
        DMatrix::from_fn(rows.len(), rows.len(), |row, column| answers[column][rows[row]])
    }

    /// What a unit acceleration of each gap of [`Self::contact_inertia`] adds to all unknowns.
    pub(crate) fn answers_to_gaps(&self, hinges: &[Reaction]) -> Vec<DVector<f64>> {
        let answer = |row: usize| {
            let mut unit = DVector::zeros(self.layout.len());
            unit[row] = 1.0;
            self.factorization.solve(&[&unit]).remove(0)
        };
        self.elastic_rows(hinges).into_iter().map(answer).collect()
    }

    /// The massless accelerations: indices of bodies' accelerations whose mass or moment of inertia is zero.
    pub(crate) fn massless_accelerations(&self) -> Vec<usize> {
        let matrix = self.factorization.matrix();
        (0..self.layout.accelerations).filter(|&index| matrix[(index, index)] == 0.0).collect()
    }

    /// The motions without mass on which the elastic guides act: of `[G_r; C] x = 0`, and of the test motions
    /// `[G_r; B^T] x = 0`, which are the same without drives.
    pub(crate) fn massless_motions(&self, hinges: &[Reaction]) -> [MasslessMotions; 2] {
        let massless = self.massless_accelerations();
        let matrix = self.factorization.matrix();
        let normal = self.elastic_rows(hinges);
        let first = self.layout.accelerations;
        let efforts = first + self.layout.reactions.len();
        let rigid: Vec<usize> = (first..efforts).filter(|row| !normal.contains(row)).collect();
        [false, true].map(|test| {
            let entry = |row: usize, column: usize| {
                if test && row >= efforts { matrix[(column, row)] } else { matrix[(row, column)] }
            };
            let rows: Vec<usize> = rigid.iter().copied().chain(efforts..self.layout.len()).collect();
            let joints = DMatrix::from_fn(rows.len(), massless.len(), |i, j| entry(rows[i], massless[j]));
            let gaps = DMatrix::from_fn(normal.len(), massless.len(), |i, j| entry(normal[i], massless[j]));
            let motions = scaled_null_space(&joints);
            MasslessMotions { gaps: gaps * &motions, motions }
        })
    }

    /// The rows of the normal forces of contacts that are not cut, and of the forces of these hinges.
    fn elastic_rows(&self, hinges: &[Reaction]) -> Vec<usize> {
        let contacts = (0..self.contacts.len()).map(|k| Reaction::Normal(ContactId(k)));
        let kept = contacts.filter(|normal| !self.layout.is_cut(*normal));
        kept.chain(hinges.iter().copied()).filter_map(|reaction| self.layout.reaction(reaction)).collect()
    }
}

/// The null space of a matrix whose rows and columns have different units.
fn scaled_null_space(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    if matrix.is_empty() {
        return DMatrix::identity(matrix.ncols(), matrix.ncols());
    }
    let (rows, columns) = super::equilibration(matrix);
    let mut motions = null_space(&super::scaled(matrix, &rows, &columns));
    for (index, mut row) in motions.row_iter_mut().enumerate() {
        row *= columns[index];
    }
    motions
}
