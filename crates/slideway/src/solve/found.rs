//! What the search found, with what is proven of it.

use crate::enclosure::NotEnclosed;
use crate::modes::{BigCount, Completeness, SearchResult, StateLists, StopReason};

/// The most patterns that are told of one solution.
const PATTERNS: usize = 1024;

/// A search, and whether it was one for bounds of the exact numbers.
pub(super) struct SearchFound<'f> {
    pub(super) result: &'f SearchResult,
    /// Why the proof refers to the rounded numbers only.
    pub(super) rounded: Option<&'f NotEnclosed>,
    /// The most states of each kind that are listed.
    pub(super) most: usize,
}

impl SearchFound<'_> {
    pub(super) fn lists(&self) -> StateLists {
        self.result.lists(self.most, PATTERNS)
    }

    /// Whether something was left that the search did not deal with.
    pub(super) fn is_partial(&self) -> bool {
        matches!(self.result.completeness, Completeness::Partial(_) | Completeness::Unexamined)
    }

    /// What keeps the list of solutions from being proven complete.
    pub(super) fn open(&self) -> Vec<String> {
        let search = match self.result.completeness {
            Completeness::Proven => None,
            Completeness::NotProven => Some("not every exclusion or outcome is proven".to_owned()),
            Completeness::Unexamined => {
                Some("singular modes were not examined, because there are too many of them".to_owned())
            }
            Completeness::Partial(StopReason::Cancelled) => {
                Some("the search was stopped by a time limit or on request".to_owned())
            }
            Completeness::Partial(reason) => Some(reason.to_string()),
        };
        let rounded =
            self.rounded.map(|reason| format!("what is proven holds for rounded numbers only: {reason}"));
        search.into_iter().chain(rounded).collect()
    }

    /// The numbers of solutions and of gap states: those that are left of the lists if they are complete,
    /// else those that were found.
    pub(super) fn counts(&self, lists: &StateLists, left: [usize; 2]) -> [String; 2] {
        if lists.all_listed {
            return left.map(|count| count.to_string());
        }
        let counts = self.result.counts();
        [counts.solutions, counts.gap_states].map(|count: BigCount| count.to_string())
    }
}
