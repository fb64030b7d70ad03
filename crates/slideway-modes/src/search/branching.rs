//! The contact on which a node is divided.

use super::relaxation::RelaxedContact;
use super::states::StateSet;
use crate::problem::ContactState;

/// Costs of forbidding a side are limited to this range for comparison.
const LEAST_COST: f64 = 1e-6;
const MOST_COST: f64 = 1e9;

/// The contacts to branch on: those that contradict inside the face of all relaxed solutions, if that is known. Free
/// contacts come last: the sides of the others determine theirs.
pub(super) fn candidates(states: &[StateSet], contradicting: Option<&[usize]>, free: &[bool]) -> Vec<usize> {
    let is_open = |contact: &usize| states[*contact].decided().is_none();
    let mut open: Vec<usize> = contradicting.unwrap_or(&[]).iter().copied().filter(is_open).collect();
    if open.is_empty() {
        open = (0..states.len()).filter(is_open).collect();
    }
    let is_free = |contact: &usize| free.get(*contact).copied().unwrap_or(false);
    let others: Vec<usize> = open.iter().copied().filter(|contact| !is_free(contact)).collect();
    if others.is_empty() { open } else { others }
}

/// The contact to branch on and the state to examine first. Among the candidates that press on both sides, it
/// is the one for which forbidding either side costs most, as a product; if there are none, the one that
/// presses most, because its other states are furthest from the present solution.
pub(super) fn branching(
    states: &[StateSet],
    relaxed: Option<&[RelaxedContact]>,
    candidates: &[usize],
) -> (usize, ContactState) {
    let Some(relaxed) = relaxed else {
        return (candidates.first().copied().unwrap_or(0), ContactState::Positive);
    };
    let mut best: Option<(usize, (f64, f64))> = None;
    for &contact in candidates {
        let RelaxedContact { positive, negative, cost_without, .. } = relaxed[contact];
        let cost: f64 = cost_without.iter().map(|cost| cost.clamp(LEAST_COST, MOST_COST)).product();
        let violation = relaxed[contact].violation(states[contact]);
        let score = (if violation > 0.0 { cost } else { 0.0 }, positive.max(negative));
        if best.is_none_or(|(_, most)| score > most) {
            best = Some((contact, score));
        }
    }
    let contact = best.map_or(0, |(contact, _)| contact);
    let at = relaxed[contact];
    let preferred = if at.positive >= at.negative { ContactState::Positive } else { ContactState::Negative };
    (contact, preferred)
}
