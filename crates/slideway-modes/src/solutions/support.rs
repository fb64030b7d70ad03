//! The positive unknowns of a solution, or of a set of solutions, which decide which set is part of which.
//!
//! Give each contact an unknown `y_k^+, y_k^- >= 0` for each side, and the shares `lambda_k` and
//! `1 - lambda_k >= 0` if the right-hand side jumps. Then what a pattern admits is a face of one polyhedron,
//! that of the relaxation (theory, section 4 (b)): the face in which all unknowns of other states vanish. It
//! is therefore part of what another pattern admits exactly if every unknown that is positive somewhere in
//! it is also positive somewhere in the other.

use dashu_ratio::RBig;
use nalgebra::DVector;

use crate::certificate::ExactSet;
use crate::problem::ContactState;
use crate::solutions::contact_set::ContactSet;

/// Unknowns of one contact.
const UNKNOWNS: usize = 4;

/// The unknowns that are positive somewhere in a set: for each contact `y^+` and `y^-`, and `lambda` and
/// `1 - lambda` if the right-hand side jumps.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Support {
    unknowns: ContactSet,
}

impl Support {
    pub(crate) fn none_of(contacts: usize) -> Self {
        Self { unknowns: ContactSet::none_of(UNKNOWNS * contacts) }
    }

    /// The support of one solution or gap state: `y_k` or `lambda_k`, the contacts with `y_k = 0`, and those
    /// with a share of 0 or 1.
    pub(crate) fn of_point(
        pattern: &[ContactState],
        unknowns: &DVector<f64>,
        [zero, at_end]: [&ContactSet; 2],
        has_jump: &[bool],
    ) -> Self {
        let mut support = Self::none_of(pattern.len());
        for (contact, &state) in pattern.iter().enumerate() {
            let (value, at_end) = (unknowns[contact], at_end.contains(contact));
            let vanishes = zero.contains(contact) || at_end && value == 0.0;
            support.add(contact, state, has_jump[contact], (vanishes, at_end && value == 1.0));
        }
        support
    }

    /// The support of what a singular pattern admits, exactly.
    pub(crate) fn of_exact_set(pattern: &[ContactState], set: &ExactSet, has_jump: &[bool]) -> Self {
        let mut support = Self::none_of(pattern.len());
        let mut add = |contact: usize, value: &RBig| {
            let ends = (value.is_zero(), *value == RBig::ONE);
            support.add(contact, pattern[contact], has_jump[contact], ends);
        };
        for point in set.vertices() {
            point.iter().enumerate().for_each(|(contact, value)| add(contact, value));
        }
        if let ExactSet::Product(parts) = set {
            for part in parts {
                part.contacts.iter().zip(&part.inside).for_each(|(&contact, value)| add(contact, value));
            }
        }
        for direction in set.directions() {
            support.add_direction(pattern, |contact| !direction[contact].is_zero());
        }
        support
    }

    /// The support of what a singular pattern admits, within tolerances: its vertices and directions with
    /// `y_k`, or the share of a contact in its gap, followed by `1 - lambda` for the contacts in their gaps.
    /// Vanishing values are exactly zero.
    pub(crate) fn of_corners(
        pattern: &[ContactState],
        (vertices, directions): (&[DVector<f64>], &[DVector<f64>]),
        has_jump: &[bool],
    ) -> Self {
        let mut support = Self::none_of(pattern.len());
        for point in vertices {
            let mut complements = point.iter().skip(pattern.len());
            for (contact, &state) in pattern.iter().enumerate() {
                let is_full =
                    state == ContactState::Gap && complements.next().is_some_and(|rest| *rest == 0.0);
                support.add(contact, state, has_jump[contact], (point[contact] == 0.0, is_full));
            }
        }
        for direction in directions {
            support.add_direction(pattern, |contact| direction[contact] != 0.0);
        }
        support
    }

    /// Adds one contact of a point, given whether its unknown is 0, and whether it is 1.
    fn add(&mut self, contact: usize, state: ContactState, jumps: bool, (zero, one): (bool, bool)) {
        let [positive, negative, share, rest] = std::array::from_fn(|at| UNKNOWNS * contact + at);
        let is_positive = match state {
            ContactState::Positive => [(positive, !zero), (share, jumps)],
            ContactState::Negative => [(negative, !zero), (rest, jumps)],
            ContactState::Gap => [(share, !zero), (rest, !one)],
        };
        is_positive.iter().filter(|(_, is)| *is).for_each(|&(unknown, _)| self.unknowns.insert(unknown));
    }

    /// Adds a direction, in which shares do not change.
    fn add_direction(&mut self, pattern: &[ContactState], grows: impl Fn(usize) -> bool) {
        for (contact, &state) in pattern.iter().enumerate().filter(|(contact, _)| grows(*contact)) {
            if state != ContactState::Gap {
                self.add(contact, state, false, (false, false));
            }
        }
    }

    /// Adds the support of some of the contacts, with the given numbers.
    pub(crate) fn add_part(&mut self, contacts: &[usize], part: &Self) {
        for (at, &contact) in contacts.iter().enumerate() {
            for unknown in (0..UNKNOWNS).filter(|unknown| part.unknowns.contains(UNKNOWNS * at + unknown)) {
                self.unknowns.insert(UNKNOWNS * contact + unknown);
            }
        }
    }

    /// The unknowns of one contact: `y^+`, `y^-`, `lambda`, `1 - lambda`.
    pub(crate) fn of_contact(&self, contact: usize) -> [bool; UNKNOWNS] {
        std::array::from_fn(|at| self.unknowns.contains(UNKNOWNS * contact + at))
    }

    /// The number of unknowns.
    pub(crate) fn len(&self) -> usize {
        self.unknowns.len()
    }

    /// Whether a set with this support is part of one with the other support, or equal to it.
    pub(crate) fn is_within(&self, other: &Self) -> bool {
        self.unknowns.is_within(&other.unknowns)
    }

    /// Whether a set with this support is part of a larger one with the other support.
    pub(crate) fn is_part_of(&self, other: &Self) -> bool {
        self != other && self.is_within(other)
    }
}
