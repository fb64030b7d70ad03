//! The states of a pattern in a few bits.

use crate::problem::ContactState;

/// The states of all contacts. They are ordered by the contacts in their gap, then by those on their negative
/// side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Pattern {
    /// Bit `k` is set where contact `k` is in its gap.
    pub gap: u64,
    /// Bit `k` is set where contact `k` is on its negative side.
    pub negative: u64,
}

impl Pattern {
    /// The state of a contact, counted from 0.
    pub fn state(self, contact: usize) -> ContactState {
        match (self.gap >> contact & 1, self.negative >> contact & 1) {
            (1, _) => ContactState::Gap,
            (_, 1) => ContactState::Negative,
            _ => ContactState::Positive,
        }
    }

    /// The states of the first `contacts` contacts.
    pub fn states(self, contacts: usize) -> Vec<ContactState> {
        (0..contacts).map(|contact| self.state(contact)).collect()
    }

    /// The same pattern with one more contact in the given state.
    pub(super) fn with(self, contact: usize, state: ContactState) -> Self {
        match state {
            ContactState::Positive => self,
            ContactState::Negative => Self { negative: self.negative | 1 << contact, ..self },
            ContactState::Gap => Self { gap: self.gap | 1 << contact, ..self },
        }
    }
}

impl FromIterator<ContactState> for Pattern {
    fn from_iter<I: IntoIterator<Item = ContactState>>(states: I) -> Self {
        let with = |pattern: Self, (contact, state)| pattern.with(contact, state);
        states.into_iter().enumerate().fold(Self::default(), with)
    }
}
