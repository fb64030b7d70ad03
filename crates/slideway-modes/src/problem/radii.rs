//! Maximum errors of the numbers of a problem.

use nalgebra::{DMatrix, DVector};

use crate::problem::side::{BySide, ProblemPart, Side};

/// The maximum distances of the numbers of a problem from its midpoint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Radii {
    pub(crate) columns: BySide<DMatrix<f64>>,
    pub(crate) jumps: BySide<DMatrix<f64>>,
    pub(crate) right_hand_side: DVector<f64>,
}

impl Radii {
    /// The radii of exact numbers.
    pub(crate) fn zero(contacts: usize) -> Self {
        let none = BySide::same(DMatrix::zeros(contacts, contacts));
        Self { columns: none.clone(), jumps: none, right_hand_side: DVector::zeros(contacts) }
    }

    /// Whether all numbers are exact.
    pub(crate) fn are_zero(&self) -> bool {
        let parts = [&self.columns, &self.jumps].map(|part| part.positive.iter().chain(&part.negative));
        parts.into_iter().flatten().chain(&self.right_hand_side).all(|&radius| radius == 0.0)
    }

    pub(crate) fn first_not_finite(&self) -> Option<(ProblemPart, f64)> {
        let mut parts = vec![(ProblemPart::RightHandSide, self.right_hand_side.as_slice())];
        for side in Side::BOTH {
            parts.push((ProblemPart::Columns(side), self.columns.get(side).as_slice()));
            parts.push((ProblemPart::Jumps(side), self.jumps.get(side).as_slice()));
        }
        let faults = |(part, values): (ProblemPart, &[f64])| {
            values.iter().find(|value| !value.is_finite()).map(|&value| (part, value))
        };
        parts.into_iter().find_map(faults)
    }
}
