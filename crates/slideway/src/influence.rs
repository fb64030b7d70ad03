//! Influence coefficients: how every unknown answers to a unit friction force of each contact, eqs. (3)-(5).
//!
//! Fifth stage of the pipeline: [`KineticEquations`] in, [`Influence`] out. All unknowns are affine in the
//! friction forces,
//!
//! ```text
//! N_j = N_j(0) + sum_k eta_jk^side F_k       and likewise the accelerations, couples, hinge forces and efforts
//! ```
//!
//! and come from the one factorization of the kinetic equations. Since the side of contact `k` decides at
//! which face its friction acts, column `k` has two versions; they are equal where the height is zero.

use crate::ids::{ContactId, JointId};
use crate::kinetics::{Influences, KineticEquations, Layout, Opening, Reaction};
use crate::mechanism::{FrictionCircle, Mechanism};
use crate::units::number::beside;
use nalgebra::{DMatrix, DVector};

/// The unknowns without friction, and what each contact's friction adds to them.
#[derive(Debug, Clone)]
pub struct Influence {
    layout: Layout,
    /// All unknowns without friction.
    pub frictionless: DVector<f64>,
    /// For each contact: what a unit friction force adds, at the face where the normal force is positive and
    /// at the one where it is negative.
    pub columns: Vec<[DVector<f64>; 2]>,
    /// For each friction circle: what a unit couple on the first body of its hinge, and its opposite on the second, add.
    pub(crate) couples: Vec<DVector<f64>>,
    /// For each contact that is cut because redundant guides share a load: what a unit normal force of it adds to
    /// all unknowns, a self-stress. Its own normal force is 1, every acceleration 0.
    pub(crate) self_stresses: Vec<DVector<f64>>,
    /// Those of the contacts that may lift off.
    pub(crate) openings: Vec<Opening>,
    /// Index of each contact's normal force among the unknowns.
    normal: Vec<usize>,
}

/// Friction of one contact, split by where it acts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactFriction {
    /// At the face that is pressed when the normal force is positive (N).
    pub positive_face: f64,
    /// At the face that is pressed when the normal force is negative (N).
    pub negative_face: f64,
}

impl ContactFriction {
    /// The whole friction force (N).
    pub fn total(self) -> f64 {
        self.positive_face + self.negative_face
    }

    /// So many times this friction.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self { positive_face: self.positive_face * factor, negative_face: self.negative_face * factor }
    }
}

/// A hinge with friction in a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HingeState {
    /// Its friction circle, among those of the mechanism.
    pub(crate) circle: usize,
    /// The hinge.
    pub(crate) joint: JointId,
    /// Its force on the first body (N).
    pub(crate) force: [f64; 2],
    /// Its friction couple on the first body (N m).
    pub(crate) couple: f64,
}

impl Mechanism {
    /// The friction forces of round ends, positive against positive sliding, each with the contact along n at which it is told.
    pub(crate) fn friction_of_ends(&self, states: &[HingeState]) -> impl Iterator<Item = (usize, f64)> {
        states.iter().filter_map(|state| {
            let [along_n, _] = self.friction_circles[state.circle].end?;
            Some((along_n.index(), -state.couple))
        })
    }
}

impl Influence {
    /// The influence coefficients of factored kinetic equations.
    pub fn new(equations: &KineticEquations) -> Self {
        Self::of(equations.influences())
    }

    /// The influence coefficients that these are.
    pub(crate) fn of(influences: Influences) -> Self {
        let Influences { layout, frictionless, columns, couples, self_stresses, openings, .. } = influences;
        let normal = (0..columns.len())
            .map(|k| {
                layout.reaction(Reaction::Normal(ContactId(k))).expect("every contact has a normal force")
            })
            .collect();
        Self { layout, frictionless, columns, couples, self_stresses, openings, normal }
    }

    /// Where the unknowns stand.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Normal forces without friction, N(0): one for each contact (N).
    pub fn normal_forces(&self) -> DVector<f64> {
        self.normal_part(&self.frictionless)
    }

    /// eta_jk: what a unit friction force of contact k adds to the normal force of contact j, for friction at
    /// the faces of positive normal force (`side` 0) or of negative (`side` 1). Square, dimensionless, eq.
    /// (4).
    pub fn eta(&self, side: usize) -> DMatrix<f64> {
        let contacts = self.columns.len();
        DMatrix::from_fn(contacts, contacts, |j, k| self.columns[k][side][self.normal[j]])
    }

    /// The normal forces among all unknowns.
    pub fn normal_part(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.normal.len(), self.normal.iter().map(|&index| unknowns[index]))
    }

    /// The efforts of all drives among the unknowns.
    pub(crate) fn efforts(&self, unknowns: &DVector<f64>) -> Vec<f64> {
        // Adding zero turns -0 into 0.
        self.layout.efforts().map(|effort| unknowns[effort] + 0.0).collect()
    }

    /// All unknowns for given friction forces, eqs. (3)-(5), and these normal forces of the contacts, of which
    /// only those that are cut are needed, and the negative ones of contacts that lift off. What cancels is 0, not its
    /// rounding error.
    pub fn unknowns(&self, friction: &[ContactFriction], normal_forces: &DVector<f64>) -> DVector<f64> {
        let of_forces = self.of_forces(friction, normal_forces);
        self.frictionless.zip_map(&of_forces, |own, more| beside(own + more, own.abs()))
    }

    /// Returns the contribution of these forces of the contacts alone to all unknowns, without any load.
    pub fn of_forces(&self, friction: &[ContactFriction], normal_forces: &DVector<f64>) -> DVector<f64> {
        let mut unknowns = self.of_friction(friction);
        for (contact, self_stress) in self.layout.cut().iter().zip(&self.self_stresses) {
            unknowns.axpy(normal_forces[contact.index()], self_stress, 1.0);
        }
        for Opening { contact, answer, .. } in &self.openings {
            unknowns.axpy((-normal_forces[*contact]).max(0.0), answer, 1.0);
        }
        unknowns
    }

    /// The contacts that may lift off, each with a part of what the acceleration of its gap adds to all unknowns.
    pub(crate) fn one_sided<R>(&self, part: impl Fn(&DVector<f64>) -> R) -> Vec<(usize, R)> {
        self.openings.iter().map(|Opening { contact, answer, .. }| (*contact, part(answer))).collect()
    }

    /// Places among all unknowns: of the normal forces, then of both components of the forces of these friction circles.
    pub(crate) fn block_rows(&self, circles: &[&FrictionCircle]) -> Vec<usize> {
        let component = |circle: &&FrictionCircle| {
            circle.reactions().map(|force| self.layout.reaction(force).expect("every circle has a force"))
        };
        self.normal.iter().copied().chain(circles.iter().flat_map(component)).collect()
    }

    /// Returns the contribution of the friction couples of hinges to all unknowns.
    pub fn of_couples(&self, hinges: &[HingeState]) -> DVector<f64> {
        let mut unknowns = DVector::zeros(self.frictionless.len());
        hinges.iter().for_each(|hinge| unknowns.axpy(hinge.couple, &self.couples[hinge.circle], 1.0));
        unknowns
    }

    /// Returns the contribution of given friction forces to all unknowns; for friction impulses the jumps of
    /// the velocities and the impulses of the reactions.
    pub fn of_friction(&self, friction: &[ContactFriction]) -> DVector<f64> {
        let mut unknowns = DVector::zeros(self.frictionless.len());
        for (column, friction) in self.columns.iter().zip(friction) {
            unknowns.axpy(friction.positive_face, &column[0], 1.0);
            unknowns.axpy(friction.negative_face, &column[1], 1.0);
        }
        unknowns
    }
}
