//! The states that are still open for each contact of a node.

use crate::problem::{ContactState, ScaledProblem};

/// The states that a contact may still take: a subset of positive, negative and gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StateSet(u8);

impl StateSet {
    /// The states in the order of enumeration.
    const STATES: [ContactState; 3] = ContactState::ALL;

    /// The set with only this state.
    pub fn only(state: ContactState) -> Self {
        Self(Self::bit(state))
    }

    /// Both sides, and the gap if `with_gap`.
    pub fn undecided(with_gap: bool) -> Self {
        Self(if with_gap { 0b111 } else { 0b011 })
    }

    /// Whether the set contains a state.
    pub fn contains(self, state: ContactState) -> bool {
        self.0 & Self::bit(state) != 0
    }

    /// The set without the given state.
    #[must_use]
    pub fn without(self, state: ContactState) -> Self {
        Self(self.0 & !Self::bit(state))
    }

    /// The number of states.
    pub fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether no state is left.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The states in the order of enumeration.
    pub fn iter(self) -> impl Iterator<Item = ContactState> {
        Self::STATES.into_iter().filter(move |&state| self.contains(state))
    }

    /// The state, if only one is left.
    pub fn decided(self) -> Option<ContactState> {
        if self.len() == 1 { self.iter().next() } else { None }
    }

    /// The least and the largest share `lambda` of `d^+` among the states.
    pub(super) fn share(self) -> (f64, f64) {
        if self.contains(ContactState::Gap) {
            return (0.0, 1.0);
        }
        let positive = self.contains(ContactState::Positive);
        let negative = self.contains(ContactState::Negative);
        (if negative { 0.0 } else { 1.0 }, if positive { 1.0 } else { 0.0 })
    }

    fn bit(state: ContactState) -> u8 {
        match state {
            ContactState::Positive => 0b001,
            ContactState::Negative => 0b010,
            ContactState::Gap => 0b100,
        }
    }
}

/// Every contact with all its states.
pub(super) fn all_states(problem: &ScaledProblem) -> Vec<StateSet> {
    problem.has_jump.iter().map(|&jump| StateSet::undecided(jump)).collect()
}

/// The fraction of all patterns of a problem that a node contains.
pub(super) fn fraction_of_patterns(problem: &ScaledProblem, states: &[StateSet]) -> f64 {
    let fraction = |(set, &jump): (&StateSet, &bool)| set.len() as f64 / if jump { 3.0 } else { 2.0 };
    states.iter().zip(&problem.has_jump).map(fraction).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_follow_the_states() {
        let both = StateSet::undecided(false);
        assert_eq!(both.share(), (0.0, 1.0));
        assert_eq!(both.without(ContactState::Negative).share(), (1.0, 1.0));
        assert_eq!(both.without(ContactState::Positive).share(), (0.0, 0.0));
        assert_eq!(StateSet::only(ContactState::Gap).share(), (0.0, 1.0));
        assert_eq!(StateSet::undecided(true).without(ContactState::Gap), both);
    }
}
