//! Influence coefficients of a mechanism, from which [`InfluenceCoefficients`] makes the
//! numbers of its problem: the same code for rounded ones and for bounds.

use crate::ids::JointId;
use crate::interval::Real;
use crate::mechanism::{FrictionCircle, Mechanism};
use crate::model::SliderKind;
use crate::modes::{BySide, InfluenceCoefficients};
use nalgebra::{DMatrix, DVector};

/// Versions of an influence column that differ by less than this multiple of it are the same.
pub(crate) const SAME_COLUMN: f64 = 1e-12;
/// Influence coefficients (force for force) below this are rounding: the friction has no influence there.
pub(crate) const NO_INFLUENCE: f64 = 1e-13;

/// A hinge with friction that turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TurningHinge {
    /// Its friction circle among those of the mechanism.
    pub(crate) circle: usize,
    /// The hinge.
    pub(crate) joint: JointId,
    /// Sense in which its first body turns against the second: 1 or -1.
    pub(crate) sense: f64,
}

impl TurningHinge {
    /// The couple on its first body by a unit of its force: `-r sgn(omega)` (theory of hinges, section 1).
    pub(crate) fn leverage<T: Real>(&self, circle: &FrictionCircle<T>) -> T {
        -circle.radius * T::exactly(self.sense)
    }
}

/// With all coefficients of friction multiplied by a factor, those of these turning hinges as their circles have it, and the
/// radii that are given.
pub(crate) fn rougher<T: Real>(
    coefficients: &InfluenceCoefficients<T>,
    hinges: &[(TurningHinge, FrictionCircle<T>)],
    factor: T,
) -> InfluenceCoefficients<T> {
    let mut rougher = coefficients.clone();
    rougher.mu = coefficients.mu.map(|mu| mu.map(|mu| mu * factor));
    for ((_, leverage), (hinge, circle)) in rougher.turning.iter_mut().zip(hinges) {
        *leverage = hinge.leverage(&circle.times(factor));
    }
    rougher
}

/// These hinges with their friction circles.
pub(crate) fn with_circles<T: Real>(
    hinges: &[TurningHinge],
    mechanism: &Mechanism<T>,
) -> Vec<(TurningHinge, FrictionCircle<T>)> {
    hinges.iter().map(|hinge| (*hinge, mechanism.friction_circles[hinge.circle])).collect()
}

/// The friction coefficients and the preloads of contacts, zero where they have no part.
pub(crate) fn friction_of_contacts<T: Real>(
    mechanism: &Mechanism<T>,
    has_part: &dyn Fn(usize) -> bool,
) -> [BySide<DVector<T>>; 2] {
    let contacts = &mechanism.contacts;
    let of = |value: &dyn Fn(usize) -> [T; 2]| {
        let faces = |k: usize| if has_part(k) { value(k) } else { [T::zero(); 2] };
        let side = |face: usize| DVector::from_fn(contacts.len(), |k, _| faces(k)[face]);
        BySide { positive: side(0), negative: side(1) }
    };
    [of(&|k| contacts[k].mu), of(&|k| contacts[k].preload)]
}

/// Both versions of the influence coefficients of rows, a column for each contact, without the rounding that would stand
/// where friction has no influence; equal where the theory says so, which rounding would hide: for guided sliders, whose
/// couple takes up the moment of friction, and wherever the moment of friction has no influence.
pub(crate) fn without_rounding(mechanism: &Mechanism, eta: [DMatrix<f64>; 2]) -> BySide<DMatrix<f64>> {
    let without_rounding = |eta: f64| if eta.abs() <= NO_INFLUENCE { 0.0 } else { eta };
    let [positive, mut negative] = eta.map(|eta| eta.map(without_rounding));
    for (k, contact) in mechanism.contacts.iter().enumerate() {
        let guided = mechanism.slider(contact.joint).is_some_and(|slider| slider.kind == SliderKind::Guided);
        let difference = (positive.column(k) - negative.column(k)).amax();
        if guided || difference <= SAME_COLUMN * positive.column(k).amax() {
            negative.set_column(k, &positive.column(k));
        }
    }
    BySide { positive, negative }
}

/// The columns of the preload's friction: at the pressed face, or in the middle between both.
pub(crate) fn preload_columns<T: Real>(
    mechanism: &Mechanism<T>,
    eta: &BySide<DMatrix<T>>,
) -> BySide<DMatrix<T>> {
    let mut preload = eta.clone();
    for (k, contact) in mechanism.contacts.iter().enumerate() {
        for row in 0..eta.positive.nrows() {
            let faces = [eta.positive[(row, k)], eta.negative[(row, k)]];
            [preload.positive[(row, k)], preload.negative[(row, k)]] = contact.preload_line.of_faces(faces);
        }
    }
    preload
}
