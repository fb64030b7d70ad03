//! Ways along which a mechanism is followed from its drawing: of the coordinates, or of open residuals to
//! zero.

use crate::mechanism::Mechanism;
use nalgebra::DVector;

/// A straight way of the coordinates, or the way of residuals to zero.
#[derive(Debug, Clone)]
pub(super) struct Leg {
    /// Values of the coordinates at its beginning.
    from: Vec<f64>,
    /// Their change for each unit of the way; the way is counted in sizes of the mechanism or rad.
    direction: Vec<f64>,
    /// Residuals that are left open at the beginning, and closed at the place 1.
    open: Option<DVector<f64>>,
    /// By how much the values may differ from those of the leg, in the same unit.
    spread: Vec<f64>,
}

impl Leg {
    /// From the drawing as it is to the closed one.
    pub(super) fn closing(mechanism: &Mechanism, open: DVector<f64>) -> Self {
        let coordinates = mechanism.coordinates.len();
        let zeros = vec![0.0; coordinates];
        Self { from: drawn(mechanism), direction: zeros.clone(), open: Some(open), spread: zeros }
    }

    /// From the drawing to these values, with what is shown beside it; and the length of the way.
    pub(super) fn to(mechanism: &Mechanism, values: &[f64], spread: Vec<f64>) -> (Self, f64) {
        let from = drawn(mechanism);
        let length = way(mechanism, &from, values);
        let direction = from.iter().zip(values).map(|(from, to)| (to - from) / length).collect();
        (Self { from, direction, open: None, spread }, length)
    }

    /// From the drawing along one coordinate, in both directions.
    pub(super) fn along(mechanism: &Mechanism, coordinate: usize) -> Self {
        let from = drawn(mechanism);
        let mut direction = vec![0.0; from.len()];
        direction[coordinate] = scale(mechanism, coordinate);
        Self { spread: vec![0.0; from.len()], from, direction, open: None }
    }

    /// The values of the coordinates at a place.
    pub(super) fn values(&self, place: f64) -> Vec<f64> {
        self.from.iter().zip(&self.direction).map(|(from, change)| from + place * change).collect()
    }

    /// The place on a leg along one coordinate at which these values are; none if others have left the
    /// drawing, too.
    pub(super) fn place(&self, mechanism: &Mechanism, coordinate: usize, values: &[f64]) -> Option<f64> {
        let stays = |index: usize| index == coordinate || values[index] == self.from[index];
        let moved = (values[coordinate] - self.from[coordinate]) / scale(mechanism, coordinate);
        (0..values.len()).all(stays).then_some(moved)
    }

    /// Whether values differ from those at the end of this leg by no more than what is shown beside it.
    pub(super) fn is_beside(&self, mechanism: &Mechanism, end: &[f64], values: &[f64]) -> bool {
        (0..values.len())
            .all(|index| (values[index] - end[index]).abs() <= self.spread[index] * scale(mechanism, index))
    }

    /// F(x; s), from the joint equations with the values of a place.
    pub(super) fn residual(&self, equations: DVector<f64>, place: f64) -> DVector<f64> {
        match &self.open {
            Some(open) => equations - open * (1.0 - place),
            None => equations,
        }
    }

    /// dF/ds
    pub(super) fn slope(&self, mechanism: &Mechanism) -> DVector<f64> {
        let mut slope =
            self.coordinate_rows(mechanism, |index| -self.direction[index] / scale(mechanism, index));
        if let Some(open) = &self.open {
            slope += open;
        }
        slope
    }

    /// By how much each equation may differ from that of the leg.
    pub(super) fn beside(&self, mechanism: &Mechanism) -> DVector<f64> {
        self.coordinate_rows(mechanism, |index| self.spread[index])
    }

    fn coordinate_rows(&self, mechanism: &Mechanism, entry: impl Fn(usize) -> f64) -> DVector<f64> {
        let rows = 3 * mechanism.bodies.len();
        let first = rows - self.from.len();
        DVector::from_fn(rows, |row, _| if row < first { 0.0 } else { entry(row - first) })
    }
}

/// Values of the coordinates in the drawing.
pub(super) fn drawn(mechanism: &Mechanism) -> Vec<f64> {
    mechanism.coordinates.iter().map(|coordinate| coordinate.drawn_at).collect()
}

/// The unit in which changes of a coordinate are counted: the size of the mechanism, or rad.
pub(super) fn scale(mechanism: &Mechanism, coordinate: usize) -> f64 {
    if mechanism.coordinates[coordinate].kind.is_angle() { 1.0 } else { mechanism.size }
}

/// The greatest change of a coordinate, in sizes of the mechanism or rad.
fn way(mechanism: &Mechanism, from: &[f64], to: &[f64]) -> f64 {
    (0..to.len()).map(|index| (to[index] - from[index]).abs() / scale(mechanism, index)).fold(0.0, f64::max)
}
