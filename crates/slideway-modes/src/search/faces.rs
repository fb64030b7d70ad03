//! Nodes whose solutions are one set: a face of the lifted polyhedron without contradiction.
//!
//! The solutions of the relaxation of a node are a face. If the states of all contacts agree with its
//! inside, where as many unknowns are positive as possible, the whole face consists of solutions, all of
//! one pattern. That all other unknowns vanish is proven by vectors in integers ([`separate`]), so the node is
//! settled with this pattern, however many others the node has.

use nalgebra::DVector;

use super::separation::{Separated, separate};
use super::states::StateSet;
use crate::certificate::LiftedSystem;
use crate::problem::{ContactState, ProblemView, ScaledProblem};
use crate::solutions::ContactSet;

/// Faces of the relaxation of an exact problem.
pub(super) struct Faces {
    system: LiftedSystem,
    /// The columns of the patterns that are examined.
    known: Vec<ContactSet>,
}

/// The unknowns of one contact that are positive inside a face: `y^+`, `y^-`, `lambda`, `1 - lambda`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Positive {
    pub(super) sides: [bool; 2],
    pub(super) shares: [bool; 2],
}

impl Positive {
    /// Whether all positive unknowns belong to this state.
    pub(super) fn agrees_with(self, state: ContactState) -> bool {
        let [positive, negative] = self.sides;
        let [share, rest] = self.shares;
        match state {
            ContactState::Positive => !negative && !rest,
            ContactState::Negative => !positive && !share,
            ContactState::Gap => !positive && !negative,
        }
    }
}

/// How a node is settled by a face.
pub(super) enum Settled {
    /// All its solutions are those of a pattern that is examined already.
    Known,
    /// All its solutions are those of this pattern.
    Pattern(Vec<ContactState>),
}

impl Faces {
    pub(super) fn new(problem: ProblemView<'_>) -> Self {
        Self { system: LiftedSystem::new(problem), known: Vec::new() }
    }

    /// Whether a node has no solution, proven in integers.
    pub(super) fn excludes(&self, states: &[StateSet], proceed: &mut dyn FnMut() -> bool) -> bool {
        let allowed = self.allowed(states);
        let columns: Vec<usize> = allowed.iter().collect();
        separate(&self.system, (&columns, &[]), Separated::Infeasible, proceed).is_some()
    }

    /// The pattern that has all solutions of a node, given the unknowns that are positive inside the face of
    /// its relaxation, all of which belong to one state of each contact; `None` if that could not be proven.
    pub(super) fn settle(
        &mut self,
        problem: &ScaledProblem,
        states: &[StateSet],
        positive: &[Positive],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Settled> {
        let support = self.support(positive);
        let allowed = self.allowed(states);
        if let Some(known) = self.known.iter().position(|known| support.is_within(known)) {
            let rest = without(&allowed, &self.known[known]);
            if self.vanish(&allowed, &support, &rest, proceed) {
                return Some(Settled::Known);
            }
        }
        let pattern = independent_pattern(problem, states, positive)?;
        let own: Vec<StateSet> = pattern.iter().map(|&state| StateSet::only(state)).collect();
        let own = self.allowed(&own);
        let rest = without(&allowed, &own);
        if !self.vanish(&allowed, &support, &rest, proceed) {
            return None;
        }
        self.known.push(own);
        Some(Settled::Pattern(pattern))
    }

    /// Whether the unknowns of some columns vanish in all solutions with the allowed columns.
    fn vanish(
        &self,
        allowed: &ContactSet,
        support: &ContactSet,
        rest: &[usize],
        proceed: &mut dyn FnMut() -> bool,
    ) -> bool {
        if rest.is_empty() {
            return true;
        }
        let (allowed, support): (Vec<usize>, Vec<usize>) =
            (allowed.iter().collect(), support.iter().collect());
        separate(&self.system, (&allowed, &support), Separated::Vanishing(rest), proceed).is_some()
    }

    /// The columns of all states that a node allows.
    fn allowed(&self, states: &[StateSet]) -> ContactSet {
        let mut allowed = ContactSet::none_of(self.system.width());
        for (contact, set) in states.iter().enumerate() {
            for state in set.iter() {
                self.system.columns_of(contact, state).for_each(|column| allowed.insert(column));
            }
        }
        allowed
    }

    /// The columns of the positive unknowns.
    fn support(&self, positive: &[Positive]) -> ContactSet {
        let mut support = ContactSet::none_of(self.system.width());
        for (contact, positive) in positive.iter().enumerate() {
            for (side, state) in ContactState::PRESSED.into_iter().enumerate() {
                // The side's own unknown comes first, then the share of its friction.
                let columns = self.system.columns_of(contact, state);
                let is_positive = [positive.sides[side], positive.shares[side]];
                columns.zip(is_positive).filter(|(_, is)| *is).for_each(|(column, _)| support.insert(column));
            }
        }
        support
    }
}

fn without(one: &ContactSet, other: &ContactSet) -> Vec<usize> {
    one.iter().filter(|&column| !other.contains(column)).collect()
}

/// A pattern of a node that agrees with the positive unknowns, and whose columns are independent if that is
/// easily possible: where several states agree, it is the one whose column is furthest from the span of those
/// chosen before. `None` if no state of some contact agrees.
fn independent_pattern(
    problem: &ScaledProblem,
    states: &[StateSet],
    positive: &[Positive],
) -> Option<Vec<ContactState>> {
    let choices: Vec<Vec<ContactState>> =
        states.iter().zip(positive).map(|(set, at)| agreeing(*set, *at)).collect();
    let mut order: Vec<usize> = (0..states.len()).collect();
    order.sort_by_key(|&contact| choices[contact].len());
    let mut pattern: Vec<ContactState> =
        choices.iter().map(|states| states.first().copied()).collect::<Option<_>>()?;
    let mut directions: Vec<DVector<f64>> = Vec::new();
    for contact in order {
        let mut best: Option<(f64, DVector<f64>)> = None;
        for &state in &choices[contact] {
            let mut column = problem.column(contact, state);
            let size = column.norm();
            // Twice, for the sake of rounding.
            for direction in directions.iter().chain(&directions) {
                column -= direction * direction.dot(&column);
            }
            let left = column.norm() / size.max(f64::MIN_POSITIVE);
            if best.as_ref().is_none_or(|(most, _)| left > 2.0 * most) {
                pattern[contact] = state;
                best = Some((left, column));
            }
        }
        directions.extend(best.and_then(|(_, column)| column.try_normalize(f64::MIN_POSITIVE)));
    }
    Some(pattern)
}

/// The states of a contact that agree with its positive unknowns; gaps only where no side agrees.
fn agreeing(set: StateSet, positive: Positive) -> Vec<ContactState> {
    let agreeing = |state: &ContactState| set.contains(*state) && positive.agrees_with(*state);
    let sides: Vec<ContactState> = ContactState::PRESSED.into_iter().filter(agreeing).collect();
    if sides.is_empty() { [ContactState::Gap].into_iter().filter(agreeing).collect() } else { sides }
}
