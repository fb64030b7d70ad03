//! Pads at the ends of travels: loads that only push.

use crate::expression::{Expression, ExpressionFault, Names, Piece, Values, parse};
use crate::ids::{FormulaId, JointId};
use crate::interval::Real;
use std::sync::LazyLock;

/// The force of a pad over its depth `d`, without and with damping. Without, there is one kink; with it the
/// force jumps to `c d'` where the block arrives, and has a kink where the pad lets go, before `d` is zero
/// again.
static LAWS: LazyLock<[Expression; 2]> = LazyLock::new(|| {
    let mut names = Names::new();
    names.parameter("k");
    names.parameter("c");
    names.coordinate("d");
    ["max(0, k*d)", "step(d)*max(0, k*d + c*rate(d))"].map(|law| parse(law, &names).unwrap_or_default())
});

/// A pad at an end of the travel of a sliding joint: at the depth d beyond it the block is pushed back along
/// the centre line of the guide with max(0, k d + c d'), and the guide the other way.
#[derive(Debug, Clone, Copy)]
pub struct Pad<T = f64> {
    /// The joint.
    pub joint: JointId,
    /// Whether it is the pad at the greatest displacement.
    pub greatest: bool,
    /// The displacement at which it begins (m).
    pub place: T,
    /// Its stiffness k (N/m) and its damping coefficient c (N s/m).
    pub constants: [T; 2],
    /// The number of its force among the formulas: beyond those of the model.
    pub(crate) formula: FormulaId,
}

impl<T: Real> Pad<T> {
    /// 1 at the greatest displacement, -1 at the least: the sense in which the depth grows with the
    /// displacement.
    pub fn sense(&self) -> T {
        T::exactly(if self.greatest { 1.0 } else { -1.0 })
    }

    /// Its force over depth and rate.
    pub(crate) fn law(&self) -> &'static Expression {
        &LAWS[usize::from(!self.constants[1].is_zero())]
    }

    /// Returns the values for which the names in its law stand.
    pub(crate) fn values<'a>(&'a self, depth: &'a [T; 2]) -> Values<'a, T> {
        let (coordinates, rates) = depth.split_at(1);
        Values { coordinates, rates, ..Values::of_parameters(&self.constants) }
    }

    /// Its force (N), with every relation on its piece, if there are pieces.
    ///
    /// # Errors
    /// A force that is not finite.
    pub(crate) fn force(&self, depth: &[T; 2], pieces: &[Piece]) -> Result<T, ExpressionFault> {
        self.law().evaluate_on(&self.values(depth), pieces)
    }
}

impl Pad {
    /// The energy that its spring has stored, k d^2/2 (J), and the power with which it grows, k d d' (W).
    pub(crate) fn elastic(&self, [depth, rate]: [f64; 2]) -> [f64; 2] {
        let [stiffness, _] = self.constants;
        let depth = depth.max(0.0);
        [stiffness * depth * depth / 2.0, stiffness * depth * rate]
    }
}
