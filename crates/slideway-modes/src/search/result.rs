//! The result of a search.

use std::collections::BTreeMap;

use super::count::BigCount;
use super::product::{GroupState, SolutionProduct, StateCounts, StateKind};
use super::report::{Completeness, GroupReport, PatternOutcomes};
use crate::solutions::{GapState, ModeSolution, SingularMode, UndecidedPattern};

/// Everything that a search found, and how it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchResult {
    /// All solutions, gap states, singular sets and undecided patterns, in product form.
    pub product: SolutionProduct,
    /// Whether the list is complete.
    pub completeness: Completeness,
    /// How each group of contacts was searched. A group that depends on others is searched once for each of
    /// their solutions; the reports are added up.
    pub groups: Vec<GroupReport>,
    /// Nodes of attempts with other groups, which were given up.
    pub abandoned_nodes: u64,
    /// Number `r` of contacts.
    pub contacts: usize,
}

/// The states of all contacts, as lists in the order of the groups' alternatives.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StateLists {
    /// Every contact is pressed on a side, or about to change it.
    pub solutions: Vec<ModeSolution>,
    /// Some contact rests in its gap.
    pub gaps: Vec<GapState>,
    /// The sets that singular patterns admit; none is empty. A point that is a solution as well is listed
    /// only in `solutions`.
    pub singular: Vec<SingularMode>,
    /// For data within bounds only: patterns with no solution at the midpoint of the bounds, but perhaps for
    /// other values.
    pub undecided: Vec<UndecidedPattern>,
    /// Whether the lists are complete.
    pub all_listed: bool,
}

impl SearchResult {
    /// The numbers of solutions, gap states, combinations with singular sets, and undecided patterns.
    pub fn counts(&self) -> StateCounts {
        self.product.counts()
    }

    /// All states of all contacts, one after the other: see [`CombinedState::joined`]. There may be very
    /// many: take only as many as needed.
    ///
    /// [`CombinedState::joined`]: super::CombinedState::joined
    pub fn states(&self, listed: usize) -> impl Iterator<Item = GroupState> {
        self.product.states().map(move |state| state.joined(self.contacts, listed))
    }

    /// Up to `most` states of each kind, each with up to `listed` patterns.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use nalgebra::{DMatrix, DVector};
    /// use slideway_modes::{Certificate, ModeProblem, SearchOptions, search};
    /// // w = z: only z = 0, w = 0, on the boundary between all patterns.
    /// let problem = ModeProblem::from_linear_complementarity(&DMatrix::identity(3, 3), DVector::zeros(3))?;
    /// let result = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
    /// let lists = result.lists(100, 1024);
    /// assert!(lists.all_listed);
    /// assert_eq!(lists.solutions[0].pattern_count, 8);
    /// assert!(matches!(lists.solutions[0].certificate, Certificate::Boundary { .. }));
    /// # Ok::<(), slideway_modes::ModeProblemError>(())
    /// ```
    pub fn lists(&self, most: usize, listed: usize) -> StateLists {
        let counts = self.counts();
        let wanted = |count: &BigCount| -> usize {
            count.to_u64().and_then(|count| usize::try_from(count).ok()).map_or(most, |count| count.min(most))
        };
        let mut lists = StateLists { all_listed: true, ..StateLists::default() };
        let kinds = [
            (StateKind::Solution, &counts.solutions),
            (StateKind::Gap, &counts.gap_states),
            (StateKind::Singular, &counts.singular),
            (StateKind::Undecided, &counts.undecided),
        ];
        for (kind, count) in kinds {
            let wanted = wanted(count);
            lists.all_listed &= count.to_u64() == Some(wanted as u64);
            // Kind by kind, so that no state has to be found among many of other kinds.
            let product = self.product.up_to(kind);
            let states = product.states().filter(|state| state.kind() == kind);
            for state in states.take(wanted) {
                match state.joined(self.contacts, listed) {
                    GroupState::Solution(solution) => lists.solutions.push(solution),
                    GroupState::Gap(gap) => lists.gaps.push(gap),
                    GroupState::Singular(mode) => lists.singular.push(mode),
                    GroupState::Undecided(undecided) => lists.undecided.push(undecided),
                }
            }
        }
        lists
    }

    /// The outcome of every pattern of all contacts; `None` if they were searched in several groups, or if
    /// not every pattern was tried. See [`GroupReport::outcomes`] for those of each group.
    pub fn outcomes(&self) -> Option<&PatternOutcomes> {
        match self.groups.as_slice() {
            [only] if only.contacts.len() == self.contacts => only.outcomes.as_ref(),
            _ => None,
        }
    }

    /// Groups that admit nothing, whatever the solution of the groups that act on them; they are the reason
    /// why there is no solution.
    pub fn barren_groups(&self) -> impl Iterator<Item = &GroupReport> {
        self.groups.iter().filter(|group| group.barren_loads == group.loads)
    }

    /// Nodes visited, those of attempts that were given up included.
    pub fn nodes(&self) -> u64 {
        self.groups.iter().map(|group| group.nodes).sum::<u64>() + self.abandoned_nodes
    }

    /// The strategy in words: how many groups were solved by which method.
    pub fn strategy(&self) -> String {
        let mut methods: BTreeMap<String, (usize, usize)> = BTreeMap::new();
        for group in &self.groups {
            let (groups, largest) = methods.entry(group.method.to_string()).or_default();
            *groups += 1;
            *largest = (*largest).max(group.contacts.len());
        }
        let words = methods.iter().map(|(method, (groups, largest))| match groups {
            1 => format!("a group of {largest} contacts: {method}"),
            _ => format!("{groups} groups of up to {largest} contacts: {method}"),
        });
        words.collect::<Vec<_>>().join("; ")
    }
}
