//! Contacts without normal force whose preload rubs on a face that the mode problem does not tell.
//!
//! Where the friction of a preload changes no normal force, both sides of its contact are the same solution
//! of the mode problem once `N = 0`. In the mechanism they are not, and between them lie the states of a
//! preload gap. A guided slider in such a gap transmits no couple, `|C| <= |N| L/2 = 0`: that is the equation
//! of its share,
//!
//! ```text
//! C_j(lambda) = C_j(0) + sum_k (C_j(e_k) - C_j(0)) lambda_k = 0
//! ```
//!
//! for all guided sliders `j`, `k` without normal force together. For other joints nothing tells the share,
//! and the ends of its range are two states.

use super::answer::Answer;
use super::mode_problem::ProblemData;
use super::state::{State, pattern};
use crate::ids::{ContactId, JointId};
use crate::interval::Interval;
use crate::kinetics::Reaction;
use crate::mechanism::Contact;
use crate::modes::{Certificate, ContactState};
use crate::problem::SAME_COLUMN;
use nalgebra::{DMatrix, DVector};

/// Shares closer to 0 or 1 than this are at the face.
const AT_FACE: f64 = 1e-9;
/// Changes of a couple below this multiple of the preload and the size of the mechanism are rounding.
const NO_COUPLE: f64 = 1e-12;
/// So many contacts whose share nothing tells take either face each; others keep theirs.
const MOST_FREE: usize = 10;

/// What tells at which face the preload of a contact without normal force rubs, where it jumps with the side
/// of the contact and no normal force does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum FreeFace {
    /// Nothing, and no force or acceleration depends on it.
    NoEffect,
    /// Nothing: either face is a state.
    Nothing,
    /// The couple of its guided slider, which vanishes.
    Couple,
}

impl ProblemData<'_> {
    /// Of a contact whose preload rubs on a face that the mode problem does not tell, what does; none for
    /// others. `has_jump` says of each contact whether the right-hand side of the mode problem jumps with its
    /// side.
    pub(crate) fn free_face(self, has_jump: &[bool], contact: usize) -> Option<FreeFace> {
        if !self.mechanism.preload_jumps(ContactId(contact)) || has_jump[contact] {
            return None;
        }
        Some(if self.couple_tells_share(contact) {
            FreeFace::Couple
        } else if self.has_effect(contact) {
            FreeFace::Nothing
        } else {
            FreeFace::NoEffect
        })
    }

    /// Whether the friction of the contact's preload changes the couple of its guided slider when it changes
    /// the face.
    fn couple_tells_share(self, contact: usize) -> bool {
        let Some(row) = self.couple_of(contact) else { return false };
        let of_unit = [0, 1].map(|side| self.influence.columns[contact][side][row]);
        let Contact { preload, preload_line, .. } = &self.mechanism.contacts[contact];
        let [positive, negative] = preload_line.of_faces(of_unit);
        (preload[0] * positive - preload[1] * negative).abs()
            > NO_COUPLE * preload[0].max(preload[1]) * self.mechanism.size
    }

    /// Whether the friction of the contact's preload, or an unknown with it, changes with the face.
    fn has_effect(self, contact: usize) -> bool {
        let [positive, negative] = &self.influence.columns[contact];
        let [at_positive, at_negative] = self.mechanism.contacts[contact].preload;
        at_positive != at_negative || (positive - negative).amax() > SAME_COLUMN * positive.amax()
    }

    /// The couple of the guided slider that a contact belongs to, among the unknowns.
    fn couple_of(self, contact: usize) -> Option<usize> {
        let joint: JointId = self.mechanism.contacts[contact].joint;
        self.influence.layout().reaction(Reaction::Couple(joint))
    }
}

/// A pattern with either side of each of these contacts, as long as they are not too many.
pub(super) fn with_either_side(pattern: &[ContactState], contacts: &[usize]) -> Vec<Vec<ContactState>> {
    let contacts = &contacts[..contacts.len().min(MOST_FREE)];
    let with_sides = |number: usize| {
        let mut states = pattern.to_vec();
        for (place, &k) in contacts.iter().enumerate() {
            let negative = number >> place & 1 == 1;
            states[k] = if negative { ContactState::Negative } else { ContactState::Positive };
        }
        states
    };
    (0..1_usize << contacts.len()).map(with_sides).collect()
}

/// At which faces the preloads rub in one state.
pub(super) struct Faces {
    states: Vec<ContactState>,
    shares: Vec<Option<f64>>,
    certificate: Certificate,
    patterns: Vec<String>,
}

impl Faces {
    /// The states of all contacts.
    pub(super) fn states(&self) -> &[ContactState] {
        &self.states
    }

    /// The state of which these are the faces.
    pub(super) fn state<'s>(&'s self, of: &State<'s>) -> State<'s> {
        State {
            pattern: &self.states,
            patterns: self.patterns.clone(),
            shares: self.shares.clone(),
            certificate: &self.certificate,
            signs: of.signs.clone(),
            ..*of
        }
    }
}

impl Answer<'_> {
    pub(super) fn data(&self) -> ProblemData<'_> {
        let Self { mechanism, influence, velocity_signs, .. } = *self;
        ProblemData { mechanism, influence, velocity_signs }
    }

    /// Of a contact whose preload rubs on a face that the mode problem does not tell, what does.
    pub(super) fn free_face(&self, contact: usize) -> Option<FreeFace> {
        self.data().free_face(&self.jumps, contact)
    }

    /// The states of the mechanism that a solution of the mode problem stands for, by the faces at which
    /// preloads rub.
    pub(super) fn faces(&self, state: &State<'_>) -> Vec<Faces> {
        let is_free = |&k: &usize| {
            state.signs[k] == 0 && state.pattern[k] != ContactState::Gap && self.free_face(k).is_some()
        };
        let free: Vec<usize> = (0..state.pattern.len()).filter(is_free).collect();
        let (guided, others): (Vec<usize>, Vec<usize>) =
            free.iter().partition(|&&k| self.free_face(k) == Some(FreeFace::Couple));
        let on_faces = |mut states: Vec<ContactState>| {
            let mut shares = state.shares.clone();
            let mut certificate = state.certificate.clone();
            for (&k, share) in guided.iter().zip(self.shares_without_couple(state, &states, &guided)) {
                states[k] = if share < AT_FACE {
                    ContactState::Negative
                } else if share > 1.0 - AT_FACE {
                    ContactState::Positive
                } else {
                    shares[k] = Some(share);
                    certificate.set_bounds(k, Interval::ZERO.hull(Interval::ONE));
                    ContactState::Gap
                };
            }
            let written = |other: &String| {
                free.iter().all(|&k| other.as_bytes().get(k) == pattern(&states).as_bytes().get(k))
            };
            let mut patterns: Vec<String> =
                state.patterns.iter().filter(|other| written(other)).cloned().collect();
            if patterns.is_empty() {
                patterns.push(pattern(&states));
            }
            Faces { states, shares, certificate, patterns }
        };
        with_either_side(state.pattern, &others).into_iter().map(on_faces).collect()
    }

    /// The shares with which these guided sliders, in their gaps, transmit no couple; beyond 0 to 1 where
    /// there are none. Where nothing tells them they are 1.
    fn shares_without_couple(
        &self,
        state: &State<'_>,
        states: &[ContactState],
        guided: &[usize],
    ) -> Vec<f64> {
        let mut in_gap = states.to_vec();
        guided.iter().for_each(|&k| in_gap[k] = ContactState::Gap);
        let rows: Vec<usize> = guided.iter().filter_map(|&k| self.data().couple_of(k)).collect();
        let couples = |at_positive: Option<usize>| {
            let mut shares = state.shares.clone();
            guided.iter().for_each(|&k| shares[k] = Some(if Some(k) == at_positive { 1.0 } else { 0.0 }));
            let state = State { pattern: &in_gap, shares, signs: Vec::new(), patterns: Vec::new(), ..*state };
            let unknowns = self.influence.unknowns(&self.friction(&state), state.normal_force);
            DVector::from_iterator(rows.len(), rows.iter().map(|&row| unknowns[row]))
        };
        let none = couples(None);
        let changes: Vec<DVector<f64>> = guided.iter().map(|&k| couples(Some(k)) - &none).collect();
        if changes.is_empty() {
            return Vec::new();
        }
        let shares = DMatrix::from_columns(&changes).lu().solve(&-none);
        shares.map_or_else(|| vec![1.0; guided.len()], |shares| shares.iter().copied().collect())
    }
}
