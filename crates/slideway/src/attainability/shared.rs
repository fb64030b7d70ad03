//! Elastic guides in excess: which gaps move, and which follow from them.
//!
//! With `Z` the self-stresses, identity in the rows of the cut contacts, the gaps of all contacts follow from
//! those that are not cut, `gap = E gap_kept` with `gap_cut = -Z_kept^T gap_kept`, and
//!
//! ```text
//! Y gap_kept'' = -(C S)_kept K E gap_kept,     p(sigma) = det((C S)_kept K E) / det((C S)_kept K E without friction)
//! ```
//!
//! with stiffness 0 for open contacts: `p` is the mean of the oriented determinants of the determinate
//! sub-mechanisms, weighted by stiffness (theory of redundant guides, R4).

use crate::ids::ContactId;
use crate::kinetics::{KineticEquations, Reaction};
use crate::mechanism::Mechanism;
use crate::modes::ContactState;
use crate::sharing::{shared_load, stress_force};
use nalgebra::{DMatrix, DVector};

/// The gaps of redundant contacts.
#[derive(Debug, Clone)]
pub(super) struct SharedGaps {
    /// The contacts that are not cut, and behind all contacts both components of each elastic hinge.
    pub(super) kept: Vec<usize>,
    /// E: all gaps from those that are kept (all x kept).
    pub(super) gaps: DMatrix<f64>,
    /// The deflections of all contacts where the gaps of the kept ones are closed: misalignment (m).
    pub(super) offset: DVector<f64>,
    /// Half of the play of all contacts (m).
    pub(super) clearance: DVector<f64>,
    /// Whether faces are rigid, so that there is no fast motion.
    pub(super) rigid: bool,
    /// The faces of press fits, the positive one first.
    pub(super) press_fits: Vec<[usize; 2]>,
    /// By how much the line of the guide is displaced for each face of a press fit (m).
    pub(super) interference: DVector<f64>,
    /// (C S)_kept without friction, all contacts pressed.
    frictionless: DMatrix<f64>,
}

impl SharedGaps {
    /// Those of a mechanism in which these hinges are elastic, too; none if nothing is in excess.
    pub(super) fn of(
        mechanism: &Mechanism,
        equations: &KineticEquations,
        hinges: &[Reaction],
    ) -> Option<Self> {
        let contacts = mechanism.contacts.len();
        let cut: Vec<usize> = mechanism.excess.contacts.iter().map(|contact| contact.index()).collect();
        if cut.is_empty() {
            return None;
        }
        let normals = (0..contacts).map(|contact| Reaction::Normal(ContactId(contact)));
        let all: Vec<Reaction> = normals.chain(hinges.iter().copied()).collect();
        let stresses = equations.self_stresses();
        let stress = |force: usize, stress: usize| {
            stress_force(equations.layout.reaction(all[force]).map_or(0.0, |row| stresses[stress][row]))
        };
        let kept: Vec<usize> = (0..all.len()).filter(|force| !cut.contains(force)).collect();
        let position = |contact: usize| cut.iter().position(|other| *other == contact);
        let gaps = DMatrix::from_fn(all.len(), kept.len(), |force, column| match position(force) {
            Some(number) => -stress(kept[column], number),
            None => f64::from(u8::from(kept[column] == force)),
        });
        let forces = DMatrix::from_fn(contacts, cut.len(), stress);
        let shared = shared_load(mechanism, forces.clone()).ok().flatten()?;
        // Z^T (d + e) = 0 with d = 0 at the kept contacts.
        let open = forces.transpose() * &shared.misalignment;
        let offset = DVector::from_fn(contacts, |k, _| position(k).map_or(0.0, |number| -open[number]));
        let clearance = |k: usize, _| if shared.shares(k) { shared.clearance[k] } else { 0.0 };
        Some(Self {
            offset,
            clearance: DVector::from_fn(contacts, clearance),
            interference: DVector::from_fn(contacts, |k, _| mechanism.contacts[k].interference()),
            press_fits: shared.press_fits,
            rigid: shared.compliance.iter().all(|compliance| *compliance == 0.0),
            // sigma e_k, and -sigma Z of a cut contact, times sigma: E^T.
            frictionless: gaps.transpose(),
            kept,
            gaps,
        })
    }

    /// The states of contacts that a pattern of the mode problem stands for: where both faces of a press fit have one
    /// sign, one of them is open.
    pub(super) fn closed(&self, pattern: &[ContactState]) -> Vec<ContactState> {
        let mut states = pattern.to_vec();
        for &[positive, negative] in &self.press_fits {
            match [pattern[positive], pattern[negative]] {
                [ContactState::Positive, ContactState::Positive] => states[negative] = ContactState::Gap,
                [ContactState::Negative, ContactState::Negative] => states[positive] = ContactState::Gap,
                _ => {}
            }
        }
        states
    }

    /// The only side on which a contact can be pressed, that of a face of a press fit.
    pub(super) fn only_side(&self, contact: usize) -> Option<ContactState> {
        self.press_fits.iter().find_map(|&[positive, negative]| match contact {
            k if k == positive => Some(ContactState::Positive),
            k if k == negative => Some(ContactState::Negative),
            _ => None,
        })
    }

    /// The stiffness matrix of a mode, `(C S)_kept K E`, from `C S`.
    pub(super) fn stiff(&self, mode: &DMatrix<f64>, stiffness: &[f64]) -> DMatrix<f64> {
        let mut gaps = self.gaps.clone();
        for (mut row, stiffness) in gaps.row_iter_mut().zip(stiffness) {
            row *= *stiffness;
        }
        mode * gaps
    }

    /// Oriented determinant p: 1 without friction.
    pub(super) fn oriented(&self, mode: &DMatrix<f64>, states: &[ContactState], stiffness: &[f64]) -> f64 {
        let is_open = |force: usize| states.get(force) == Some(&ContactState::Gap);
        let stiffness = stiffness.iter().enumerate();
        let closed: Vec<f64> =
            stiffness.map(|(force, stiffness)| if is_open(force) { 0.0 } else { *stiffness }).collect();
        let [with, without] = [mode, &self.frictionless].map(|mode| self.stiff(mode, &closed).determinant());
        if without == 0.0 { 0.0 } else { with / without }
    }
}
