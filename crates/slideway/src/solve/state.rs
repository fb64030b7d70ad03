//! A solution of the mode problem as the answer sees it: what every contact does, and the normal forces.

use crate::influence::{ContactFriction, HingeState};
use crate::modes::{Certificate, ContactState, GapState, ModeSolution, Side, SingularMode, SolutionSet};
use nalgebra::DVector;

/// A state of all contacts: a solution of the mode problem, or a vertex of a continuum.
pub(super) struct State<'s> {
    pub(super) pattern: &'s [ContactState],
    pub(super) patterns: Vec<String>,
    pub(super) normal_force: &'s DVector<f64>,
    /// For each contact in its gap, the share of the positive face.
    pub(super) shares: Vec<Option<f64>>,
    pub(super) signs: Vec<i8>,
    pub(super) on_boundary: bool,
    pub(super) determinant: f64,
    pub(super) certificate: &'s Certificate,
    /// The hinges with friction.
    pub(super) hinges: &'s [HingeState],
    /// The friction of contacts that stand still while the rest moves.
    pub(super) held: &'s [Held],
}

/// Friction of a contact that stands still.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held {
    pub(super) contact: usize,
    pub(super) friction: ContactFriction,
}

pub(super) fn pressed(pattern: &[Side]) -> Vec<ContactState> {
    pattern.iter().map(|side| ContactState::from(*side)).collect()
}

pub(super) fn regular<'s>(solution: &'s ModeSolution, pattern: &'s [ContactState]) -> State<'s> {
    State {
        pattern,
        patterns: solution.patterns.iter().map(|sides| self::pattern(&pressed(sides))).collect(),
        normal_force: &solution.normal_force,
        shares: vec![None; pattern.len()],
        signs: solution.signs.clone(),
        on_boundary: !solution.on_boundary.is_empty(),
        determinant: solution.determinant,
        certificate: &solution.certificate,
        hinges: &[],
        held: &[],
    }
}

pub(super) fn in_gap(gap: &GapState) -> State<'_> {
    let mut shares = vec![None; gap.pattern.len()];
    for share in &gap.shares {
        shares[share.contact] = Some(share.lambda);
    }
    State {
        pattern: &gap.pattern,
        patterns: gap.patterns.iter().map(|states| pattern(states)).collect(),
        normal_force: &gap.normal_force,
        shares,
        signs: gap.signs.clone(),
        on_boundary: !gap.on_boundary.is_empty(),
        determinant: gap.determinant,
        certificate: &gap.certificate,
        hinges: &[],
        held: &[],
    }
}

/// The single solution that a singular mode admits, unless a regular mode shares it.
pub(super) fn point(mode: &SingularMode) -> Option<State<'_>> {
    let SolutionSet::Point(normal_force) = &mode.set else { return None };
    let has_gap = mode.pattern.contains(&ContactState::Gap);
    (mode.contains.is_empty() && !has_gap).then(|| State {
        pattern: &mode.pattern,
        patterns: mode.patterns.iter().map(|states| pattern(states)).collect(),
        normal_force,
        shares: vec![None; mode.pattern.len()],
        signs: normal_force
            .iter()
            .map(|n| {
                if *n == 0.0 {
                    0
                } else if *n > 0.0 {
                    1
                } else {
                    -1
                }
            })
            .collect(),
        on_boundary: true,
        determinant: 0.0,
        certificate: &mode.certificate,
        hinges: &[],
        held: &[],
    })
}

/// The sign of every normal force, 0 in a gap.
pub(crate) fn signs(pattern: &[ContactState]) -> Vec<i8> {
    pattern
        .iter()
        .map(|state| match state {
            ContactState::Positive => 1,
            ContactState::Negative => -1,
            ContactState::Gap => 0,
        })
        .collect()
}

/// One character for each contact: "+", "-", or "0" in a gap.
pub(crate) fn pattern(states: &[ContactState]) -> String {
    let sign = |state: &ContactState| match state {
        ContactState::Positive => '+',
        ContactState::Negative => '-',
        ContactState::Gap => '0',
    };
    states.iter().map(sign).collect()
}

/// The states with these signs of the normal forces, in a gap where there is none.
pub(super) fn states_of(signs: &[i8]) -> Vec<ContactState> {
    let state = |sign: &i8| match sign {
        1 => ContactState::Positive,
        -1 => ContactState::Negative,
        _ => ContactState::Gap,
    };
    signs.iter().map(state).collect()
}

/// The states of a pattern that is written as [`pattern`] writes it.
pub(crate) fn states(pattern: &str) -> Vec<ContactState> {
    let state = |sign: char| match sign {
        '+' => ContactState::Positive,
        '-' => ContactState::Negative,
        _ => ContactState::Gap,
    };
    pattern.chars().map(state).collect()
}
