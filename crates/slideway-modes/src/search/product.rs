//! Solutions in product form: the solutions of independent groups of contacts multiply.

use std::sync::Arc;

use nalgebra::DVector;

use super::count::BigCount;
use crate::interval::Interval;
use crate::problem::{ContactState, SolutionSet};
use crate::solutions::{
    Certificate, GapShare, GapState, ModeSolution, SingularMode, Support, UndecidedPattern,
};

/// All solutions of a set of contacts: one alternative of every factor, in any combination.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SolutionProduct {
    /// Independent factors; without factors, there is exactly one (empty) solution.
    pub factors: Vec<Factor>,
}

/// A group of contacts and its alternatives; no alternatives mean that there is no solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Factor {
    /// The contacts of the group, from 0, in increasing order.
    pub contacts: Vec<usize>,
    /// The alternatives that the group admits.
    pub alternatives: Vec<Alternative>,
}

/// One solution of a group, with the solutions of the groups that depend on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternative {
    /// The state of the group's own contacts; shared if it occurs beside several states of other groups.
    pub state: Arc<GroupState>,
    /// The solutions of the contacts on which this group acts.
    pub dependents: SolutionProduct,
}

/// A solution of one group, in the numbering of its factor's contacts.
#[derive(Debug, Clone, PartialEq)]
pub enum GroupState {
    /// Every contact is pressed on a side, or about to change it.
    Solution(ModeSolution),
    /// Some contact rests in its gap.
    Gap(GapState),
    /// The set that a singular pattern admits; not empty.
    Singular(SingularMode),
    /// For data within bounds only: no solution at the midpoint of the bounds, but perhaps for other values.
    Undecided(UndecidedPattern),
}

/// The number of solutions of each kind.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct StateCounts {
    /// Solutions with every contact pressed on a side or on a boundary.
    pub solutions: BigCount,
    /// States with some contact in its gap.
    pub gap_states: BigCount,
    /// Combinations with the set of a singular pattern.
    pub singular: BigCount,
    /// Combinations that may be solutions only for some values within bounds.
    pub undecided: BigCount,
}

/// A combination of solutions of all groups.
#[derive(Debug, Clone, PartialEq)]
pub struct CombinedState<'a> {
    /// The contacts of each group, with their state.
    pub parts: Vec<(&'a [usize], &'a GroupState)>,
}

impl GroupState {
    /// The kind of the state.
    pub fn kind(&self) -> StateKind {
        match self {
            Self::Solution(_) => StateKind::Solution,
            Self::Gap(_) => StateKind::Gap,
            Self::Singular(_) => StateKind::Singular,
            Self::Undecided(_) => StateKind::Undecided,
        }
    }

    /// The state of each contact of the group.
    pub fn pattern(&self) -> Vec<ContactState> {
        match self {
            Self::Solution(solution) => solution.pattern.iter().map(|&side| side.into()).collect(),
            Self::Gap(gap) => gap.pattern.clone(),
            Self::Singular(mode) => mode.pattern.clone(),
            Self::Undecided(undecided) => undecided.pattern.clone(),
        }
    }

    /// Returns the statement that is proven about the state. Returns `None` for an undecided pattern.
    pub fn certificate(&self) -> Option<&Certificate> {
        match self {
            Self::Solution(solution) => Some(&solution.certificate),
            Self::Gap(gap) => Some(&gap.certificate),
            Self::Singular(mode) => Some(&mode.certificate),
            Self::Undecided(_) => None,
        }
    }

    /// Proven bounds of its unknowns: `y_k`, or the share `lambda_k` of a contact in its gap.
    pub fn unknowns(&self) -> Option<&[Interval]> {
        match self {
            Self::Undecided(undecided) => undecided.unknowns.as_deref(),
            state => state.certificate().and_then(Certificate::unknowns),
        }
    }

    /// Whether it is not part of a larger continuum that the group admits.
    pub fn is_maximal(&self) -> bool {
        match self {
            Self::Solution(solution) => solution.maximal,
            Self::Gap(gap) => gap.maximal,
            Self::Singular(mode) => mode.maximal,
            Self::Undecided(_) => true,
        }
    }

    fn support(&self) -> Option<&Support> {
        match self {
            Self::Solution(solution) => Some(&solution.support),
            Self::Gap(gap) => Some(&gap.support),
            Self::Singular(mode) => Some(&mode.support),
            Self::Undecided(_) => None,
        }
    }

    /// The signed normal forces of the group; `None` for a continuum and for an undecided pattern.
    pub fn normal_force(&self) -> Option<&DVector<f64>> {
        match self {
            Self::Solution(solution) => Some(&solution.normal_force),
            Self::Gap(gap) => Some(&gap.normal_force),
            Self::Singular(SingularMode { set: SolutionSet::Point(point), .. }) => Some(point),
            Self::Singular(_) | Self::Undecided(_) => None,
        }
    }
}

/// The kind of a state, ordered by how much must be said about it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum StateKind {
    /// Every contact is pressed on a side, or about to change it.
    #[default]
    Solution,
    /// Some contact rests in its gap.
    Gap,
    /// Some group is in a singular pattern.
    Singular,
    /// Some group is in a pattern that is not decided within the bounds of the data.
    Undecided,
}

/// Cumulated counts: solutions; with gap states; with singular sets; with undecided patterns.
type Cumulated = [BigCount; 4];

impl SolutionProduct {
    /// The numbers of solutions, gap states and combinations with singular sets.
    pub fn counts(&self) -> StateCounts {
        let [solutions, with_gaps, with_sets, all] = self.cumulated();
        StateCounts {
            gap_states: with_gaps.minus(&solutions),
            singular: with_sets.minus(&with_gaps),
            undecided: all.minus(&with_sets),
            solutions,
        }
    }

    /// All combinations one after the other. There may be very many: take only as many as needed.
    pub fn states(&self) -> impl Iterator<Item = CombinedState<'_>> {
        Combinations { product: self, choices: Vec::new(), state: Walk::Start }
    }

    /// The combinations that are at most of this kind; those of exactly this kind come early.
    #[must_use]
    pub fn up_to(&self, kind: StateKind) -> Self {
        let mut product = self.clone();
        product.restrict(kind, &|state| Some(state.kind()));
        product
    }

    /// Drops what is beyond a sort or has none, puts what is of the last sorts first, and returns the last sort of the
    /// remaining combinations; `None` if there are no combinations. `sort` is that of a state of a group.
    pub(crate) fn restrict<S: Copy + Ord + Default>(
        &mut self,
        most: S,
        sort: &impl Fn(&GroupState) -> Option<S>,
    ) -> Option<S> {
        let mut last = Some(S::default());
        for factor in &mut self.factors {
            let mut sorted = Vec::new();
            for mut alternative in std::mem::take(&mut factor.alternatives) {
                if let Some(own) = sort(&alternative.state).filter(|own| *own <= most)
                    && let Some(dependents) = alternative.dependents.restrict(most, sort)
                {
                    sorted.push((own.max(dependents), alternative));
                }
            }
            // The order within one sort is kept.
            sorted.sort_by_key(|(sort, _)| std::cmp::Reverse(*sort));
            let first = sorted.first().map(|(sort, _)| *sort);
            last = last.zip(first).map(|(one, other)| one.max(other));
            factor.alternatives = sorted.into_iter().map(|(_, alternative)| alternative).collect();
        }
        last
    }

    fn cumulated(&self) -> Cumulated {
        let mut product = [1; 4].map(BigCount::from);
        for factor in &self.factors {
            let mut sums = Cumulated::default();
            for alternative in &factor.alternatives {
                let counts = alternative.dependents.cumulated();
                for kind in alternative.state.kind() as usize..4 {
                    sums[kind] = sums[kind].plus(&counts[kind]);
                }
            }
            product = [0, 1, 2, 3].map(|kind| product[kind].times(&sums[kind]));
        }
        product
    }

    /// Whether some factor has no alternatives.
    pub(super) fn is_empty(&self) -> bool {
        self.factors.iter().any(|factor| factor.alternatives.is_empty())
    }
}

impl CombinedState<'_> {
    /// The shares of contacts in their gaps; those of one state if they vary.
    pub fn shares(&self) -> Vec<GapShare> {
        let mut all: Vec<GapShare> = Vec::new();
        for (members, state) in &self.parts {
            let own = match state {
                GroupState::Gap(gap) => gap.shares.as_slice(),
                GroupState::Singular(mode) => mode.shares.as_slice(),
                GroupState::Solution(_) | GroupState::Undecided(_) => &[],
            };
            all.extend(own.iter().map(|share| GapShare { contact: members[share.contact], ..*share }));
        }
        all.sort_by_key(|share| share.contact);
        all
    }

    /// Whether there are several states with the same normal forces but different shares.
    pub fn shares_vary(&self) -> bool {
        self.parts.iter().any(|(_, state)| matches!(state, GroupState::Singular(mode) if mode.shares_vary))
    }

    /// The kind of the combination: the greatest kind of its parts.
    pub fn kind(&self) -> StateKind {
        self.parts.iter().map(|(_, state)| state.kind()).max().unwrap_or(StateKind::Solution)
    }

    /// Whether it is not part of a larger continuum: none of its parts is.
    pub fn is_maximal(&self) -> bool {
        self.parts.iter().all(|(_, state)| state.is_maximal())
    }

    /// Which unknowns of each contact are positive somewhere in the state, given the number of contacts: `y^+` and
    /// `y^-`, and, if the right-hand side jumps, the shares `lambda` and `1 - lambda`; none for undecided patterns.
    ///
    /// States with the same positive unknowns are the same set; of two sets, one is part of the other if its
    /// positive unknowns are.
    pub fn positive_unknowns(&self, contacts: usize) -> Vec<[bool; 4]> {
        let support = self.support(contacts);
        (0..contacts).map(|contact| support.of_contact(contact)).collect()
    }

    /// The positive unknowns of all contacts, given their number; none for undecided patterns.
    pub(crate) fn support(&self, contacts: usize) -> Support {
        let mut support = Support::none_of(contacts);
        for (members, state) in &self.parts {
            if let Some(part) = state.support() {
                support.add_part(members, part);
            }
        }
        support
    }

    /// The state of every contact, given their number.
    pub fn pattern(&self, contacts: usize) -> Vec<ContactState> {
        let mut pattern = vec![ContactState::Positive; contacts];
        for (members, state) in &self.parts {
            for (&contact, state) in members.iter().zip(state.pattern()) {
                pattern[contact] = state;
            }
        }
        pattern
    }

    /// The signed normal forces of all contacts, given their number; `None` if a group has a continuum of
    /// them.
    pub fn normal_force(&self, contacts: usize) -> Option<DVector<f64>> {
        let mut force = DVector::zeros(contacts);
        for (members, state) in &self.parts {
            for (&contact, &value) in members.iter().zip(state.normal_force()?) {
                force[contact] = value;
            }
        }
        Some(force)
    }
}

enum Walk {
    Start,
    Under,
    End,
}

/// Combinations in the order of the alternatives, with the last group changing fastest.
struct Combinations<'a> {
    product: &'a SolutionProduct,
    /// The factors in the order in which they are encountered, with the alternative taken.
    choices: Vec<(&'a Factor, usize)>,
    state: Walk,
}

impl<'a> Combinations<'a> {
    /// Extends the choices by the first alternative of every remaining factor; `false` if some factor has
    /// none.
    fn complete(&mut self) -> bool {
        let mut pending: Vec<&'a Factor> = self.product.factors.iter().rev().collect();
        let mut known = 0;
        while let Some(factor) = pending.pop() {
            if known == self.choices.len() {
                self.choices.push((factor, 0));
            }
            let taken = self.choices[known].1;
            let Some(alternative) = factor.alternatives.get(taken) else { return false };
            pending.extend(alternative.dependents.factors.iter().rev());
            known += 1;
        }
        true
    }

    /// Takes the next alternative of the last factor that has one; `false` if none has.
    fn advance(&mut self) -> bool {
        while let Some((factor, taken)) = self.choices.pop() {
            if taken + 1 < factor.alternatives.len() {
                self.choices.push((factor, taken + 1));
                return true;
            }
        }
        false
    }
}

impl<'a> Iterator for Combinations<'a> {
    type Item = CombinedState<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        let more = match self.state {
            Walk::Start => true,
            Walk::Under => self.advance(),
            Walk::End => false,
        };
        if !more || !self.complete() {
            self.state = Walk::End;
            return None;
        }
        self.state = Walk::Under;
        let part = |&(factor, taken): &(&'a Factor, usize)| {
            (factor.contacts.as_slice(), factor.alternatives[taken].state.as_ref())
        };
        Some(CombinedState { parts: self.choices.iter().map(part).collect() })
    }
}
