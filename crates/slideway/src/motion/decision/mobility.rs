//! How joints accelerate under forces along their guides: whether other joints hold them, and in which
//! directions they can begin to slide.

use super::instant::Instant;
use nalgebra::{DMatrix, DVector};

/// Mobilities that cancel to within this multiple of themselves count as zero.
const DEPENDENT: f64 = 1e-10;
/// Accelerations below this, in units, count as zero.
const NO_ACCELERATION: f64 = 1e-10;

/// A joint that only a force greater than this, in units, could keep from sliding cannot stick.
const GREATEST_FORCE: f64 = 1e8;

impl Instant<'_> {
    /// The sign of the acceleration of a joint that has no sliding velocity but only passes through this
    /// state: near a dead centre its acceleration comes from the geometry of the motion (or from a drive),
    /// and no realistic force along its guide would change it.
    pub(super) fn passes(&self, joint: usize) -> Option<f64> {
        let acceleration = self.outputs.base[self.acceleration_output(joint)];
        let holding_force = acceleration.abs() / self.mobility(joint, joint).abs();
        (acceleration.abs() > NO_ACCELERATION && holding_force > GREATEST_FORCE)
            .then(|| acceleration.signum())
    }

    /// Whether a joint does not accelerate while others are held, whatever forces act.
    ///
    /// With `A_ij` the acceleration of joint i under a unit force along the guide of joint j (in the middle
    /// of the block) and `a` the accelerations without friction, this is `A_jj - A_jH A_HH^-1 A_Hj = 0` and
    /// `a_j - A_jH A_HH^-1 a_H = 0`, by elimination with complete pivoting among the held joints H.
    pub(super) fn is_held(&self, joint: usize, held: &[usize]) -> bool {
        let (is_movable, acceleration) = self.beside(joint, held);
        !is_movable && acceleration.abs() <= NO_ACCELERATION
    }

    /// Whether a force at a joint accelerates it while others are held.
    pub(super) fn is_movable(&self, joint: usize, held: &[usize]) -> bool {
        self.beside(joint, held).0
    }

    /// Whether a force at a joint accelerates it while others are held, and how it accelerates without one.
    fn beside(&self, joint: usize, held: &[usize]) -> (bool, f64) {
        let joints: Vec<usize> = held.iter().copied().chain([joint]).collect();
        let last = held.len();
        let mut matrix = self.mobilities(&joints);
        let greatest = matrix.columns(0, joints.len()).amax();
        let own = matrix[(last, last)].abs();
        eliminate(&mut matrix, held.len(), DEPENDENT * greatest);
        let rest = matrix[(last, last)].abs();
        (rest > DEPENDENT * own.max(DEPENDENT * greatest), matrix[(last, last + 1)])
    }

    /// The number of these joints whose motion depends on that of the others.
    pub(super) fn dependent(&self, joints: &[usize]) -> usize {
        let mut matrix = self.mobilities(joints);
        let greatest = matrix.columns(0, joints.len()).amax();
        joints.len() - eliminate(&mut matrix, joints.len(), DEPENDENT * greatest)
    }

    /// Whether two joints can begin to slide with these signs: if the motion of one depends on that of the
    /// other, the signs must agree.
    pub(super) fn can_begin_together(&self, [one, other]: [(usize, f64); 2]) -> bool {
        let ratio = self.mobility(other.0, one.0) * self.mobility(one.0, one.0);
        !self.is_held(other.0, &[one.0]) || ratio * one.1 * other.1 >= 0.0
    }

    /// The index of the acceleration of one of the sliding joints and hinges with friction among the outputs.
    pub(super) fn acceleration_output(&self, joint: usize) -> usize {
        match joint.checked_sub(self.joints.len()) {
            None => self.sliding_output(joint),
            Some(hinge) => self.turning_output(hinge),
        }
    }

    /// Mobilities between joints and, in the last column, their accelerations without friction.
    fn mobilities(&self, joints: &[usize]) -> DMatrix<f64> {
        DMatrix::from_fn(joints.len(), joints.len() + 1, |i, j| match joints.get(j) {
            Some(pushed) => self.mobility(joints[i], *pushed),
            None => self.outputs.base[self.acceleration_output(joints[i])],
        })
    }

    /// Acceleration of a sliding joint or hinge under a unit force along the guide of another joint, or a unit couple of
    /// another hinge, in units.
    fn mobility(&self, joint: usize, pushed: usize) -> f64 {
        let row = self.acceleration_output(joint);
        let Some(pushed_joint) = self.joints.get(pushed) else {
            return self.outputs.couples[(row, pushed - self.joints.len())];
        };
        let Some(&k) = pushed_joint.contacts.first() else { return 0.0 };
        let [plus, minus] = [0, 1].map(|face| self.outputs.columns[face][(row, k)]);
        -f64::midpoint(plus, minus)
    }

    /// All outputs under a unit force along the guide of a joint, in the middle of the block, or a unit couple of a hinge.
    pub(super) fn response_to_force(&self, pushed: usize) -> DVector<f64> {
        let [plus, minus] = &self.outputs.columns;
        match self.joints.get(pushed).map(|joint| joint.contacts.first()) {
            None => self.outputs.couples.column(pushed - self.joints.len()).into_owned(),
            Some(Some(&k)) => (plus.column(k) + minus.column(k)) * -0.5,
            Some(None) => DVector::zeros(plus.nrows()),
        }
    }
}

/// Eliminates a leading square block of this size from all rows, with complete pivoting; returns its rank.
fn eliminate(matrix: &mut DMatrix<f64>, block: usize, zero: f64) -> usize {
    for step in 0..block {
        let rest = matrix.view((step, step), (block - step, block - step));
        let (row, column) = rest.iamax_full();
        if rest[(row, column)].abs() <= zero {
            return step;
        }
        matrix.swap_rows(step, step + row);
        matrix.swap_columns(step, step + column);
        for other in step + 1..matrix.nrows() {
            let factor = matrix[(other, step)] / matrix[(step, step)];
            for k in step..matrix.ncols() {
                matrix[(other, k)] -= factor * matrix[(step, k)];
            }
        }
    }
    block
}
