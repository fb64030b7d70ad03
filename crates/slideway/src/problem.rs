//! The problem of a mechanism in numbers, from its influence coefficients: the same code for rounded ones and
//! for bounds.
//!
//! [`ProblemCoefficients`] in; out come those of the contacts, which eq. (6) needs, or the numbers of the
//! block mode problem `x = b + d^sigma + H^sigma w`, of contacts and of hinges that turn with friction
//! (theory of hinges, section 1).

use crate::ids::JointId;
use crate::interval::{Interval, Real};
use crate::mechanism::{FrictionCircle, Mechanism};
use crate::model::SliderKind;
use crate::modes::blocks::BlockProblem;
use crate::modes::certificate::IntervalMatrix;
use crate::modes::{BySide, InfluenceCoefficients, ModeProblemError};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

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
    /// The couple on its first body by its force: -r sgn(omega).
    pub(crate) fn leverage<T: Real>(&self, circle: &FrictionCircle<T>) -> T {
        -circle.radius * T::exactly(self.sense)
    }
}

/// Influence coefficients and friction of the contacts and of the hinges that turn. Rows are the normal
/// forces, then both components of the force of each hinge, then outputs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ProblemCoefficients<T: Real = f64> {
    /// Those of the contacts, in all rows.
    pub(crate) contacts: InfluenceCoefficients<T>,
    /// Changes of each row per unit couple on the first body of each hinge.
    pub(crate) couples: DMatrix<T>,
    /// The hinges, each with its friction circle.
    pub(crate) hinges: Vec<(TurningHinge, FrictionCircle<T>)>,
}

/// The numbers of a problem.
#[derive(Debug, Clone)]
pub(crate) struct BlockNumbers<T: Real = f64> {
    /// `H^sigma`, a column for each contact and hinge.
    pub(crate) response: BySide<DMatrix<T>>,
    /// `d^sigma`, a column for each contact.
    pub(crate) jumps: BySide<DMatrix<T>>,
    /// `b`.
    pub(crate) load: DVector<T>,
}

impl<T: Real> ProblemCoefficients<T> {
    /// With all friction multiplied by a factor.
    pub(crate) fn rougher(&self, factor: T) -> Self {
        let mut rougher = self.clone();
        rougher.contacts.mu = self.contacts.mu.map(|mu| mu.map(|mu| mu * factor));
        rougher.hinges.iter_mut().for_each(|(_, circle)| *circle = circle.times(factor));
        rougher
    }

    /// The numbers of the block mode problem.
    pub(crate) fn numbers(&self) -> BlockNumbers<T> {
        let (rows, contacts) = self.contacts.eta.positive.shape();
        let response = BySide::of(|side| {
            DMatrix::from_fn(rows, contacts + self.hinges.len(), |row, block| {
                match block.checked_sub(contacts) {
                    None => self.contacts.response(side, row, block),
                    Some(hinge) => self.response_to_hinge(row, hinge),
                }
            })
        });
        BlockNumbers { response, jumps: self.contacts.jumps(), load: self.contacts.right_hand_side() }
    }

    /// `-r_j sgn(omega_j)` times the answer to a unit couple; compatibility of deflections knows no couples.
    fn response_to_hinge(&self, row: usize, hinge: usize) -> T {
        let is_cut = self.contacts.shared.as_ref().is_some_and(|shared| shared.cut.contains(&row));
        let (turning, circle) = &self.hinges[hinge];
        if is_cut { T::zero() } else { self.couples[(row, hinge)] * turning.leverage(circle) }
    }
}

impl<T: Real> BlockNumbers<T> {
    /// Those in some rows.
    pub(crate) fn rows(&self, rows: Range<usize>) -> Self {
        let part = |matrix: &DMatrix<T>| matrix.rows_range(rows.clone()).into_owned();
        Self {
            response: self.response.map(part),
            jumps: self.jumps.map(part),
            load: self.load.rows_range(rows.clone()).into_owned(),
        }
    }

    /// Whether no number is infinite or undefined.
    pub(crate) fn are_finite(&self) -> bool {
        let sides = [&self.response, &self.jumps].map(|both| both.positive.iter().chain(&both.negative));
        sides.into_iter().flatten().chain(&self.load).all(|number| number.is_finite())
    }
}

impl BlockNumbers {
    /// The problem of exact numbers.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub(crate) fn problem(self) -> Result<BlockProblem, ModeProblemError> {
        BlockProblem::new(self.response, self.jumps, self.load)
    }
}

impl BlockNumbers<Interval> {
    /// The problem of numbers within bounds. Returns `None` if one has none.
    pub(crate) fn problem(&self) -> Option<BlockProblem> {
        let bounded = |matrix: &DMatrix<Interval>| IntervalMatrix::from_intervals(matrix).ok_or(());
        let both = |sides: &BySide<DMatrix<Interval>>| sides.try_map(|_, side| bounded(side)).ok();
        let load = DMatrix::from_columns(std::slice::from_ref(&self.load));
        let load = bounded(&load).ok()?;
        BlockProblem::within_bounds(both(&self.response)?, both(&self.jumps)?, load).ok()
    }
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
pub(crate) fn preload_columns(mechanism: &Mechanism, eta: &BySide<DMatrix<f64>>) -> BySide<DMatrix<f64>> {
    let mut preload = eta.clone();
    for (k, contact) in mechanism.contacts.iter().enumerate() {
        for row in 0..eta.positive.nrows() {
            let faces = [eta.positive[(row, k)], eta.negative[(row, k)]];
            [preload.positive[(row, k)], preload.negative[(row, k)]] = contact.preload_line.of_faces(faces);
        }
    }
    preload
}
