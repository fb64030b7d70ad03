//! Nodes whose solutions are one set: a face of the lifted polyhedron without contradiction.
//!
//! The solutions of the relaxation of a node are a face. If the states of all contacts agree with its
//! inside, where as many unknowns are positive as possible, the whole face consists of solutions, all of
//! one pattern. That all other unknowns vanish is proven by vectors in integers ([`separate`]), so the node is
//! settled with this pattern, however many others the node has.

use std::sync::Arc;

use dashu_int::IBig;
use nalgebra::DVector;

use super::separation::{Separated, separate};
use super::states::StateSet;
use crate::certificate::LiftedSystem;
use crate::problem::{ContactState, ProblemView, ScaledProblem};
use crate::solutions::ContactSet;

/// Faces of the relaxation of an exact problem.
#[derive(Clone)]
pub(super) struct Faces {
    system: Arc<LiftedSystem>,
    /// The patterns that are examined, with the columns that a node may have to be settled by them.
    known: Vec<(ContactSet, Vec<ContactState>)>,
    /// Whether nodes are settled with the columns of the positive unknowns, not with all of a pattern, if
    /// possible.
    to_support: bool,
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
pub(super) struct Settled {
    /// All its solutions are those of this pattern.
    pub(super) pattern: Vec<ContactState>,
    /// Whether the pattern is examined already.
    pub(super) is_known: bool,
    /// Proves that the unknowns of all other columns than those left vanish; empty if there are no others.
    pub(super) vector: Vec<IBig>,
    /// Columns of the pattern that contain all its solutions in the node.
    pub(super) left: ContactSet,
}

impl Faces {
    pub(super) fn new(problem: ProblemView<'_>) -> Self {
        Self { system: Arc::new(LiftedSystem::new(problem)), known: Vec::new(), to_support: false }
    }

    /// The same, with nodes settled by as few columns as possible, for the cells of a proof.
    pub(super) fn with_supports(self) -> Self {
        Self { to_support: true, ..self }
    }

    /// A vector in integers that proves that a node has no solution, if one is found; for a proof, whatever the length of
    /// its integers.
    pub(super) fn excluding(
        &self,
        states: &[StateSet],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<IBig>> {
        let columns: Vec<usize> = self.allowed(states).iter().collect();
        match separate(&self.system, (&columns, &[]), Separated::Infeasible, proceed) {
            None if self.to_support => self.system.farkas(&columns, proceed),
            vector => vector,
        }
    }

    /// A vector in integers that proves that only the unknowns of some columns, all of which are positive in
    /// some solution, are positive where the allowed columns are, if one is found.
    pub(super) fn reducing(
        &self,
        allowed: &ContactSet,
        support: &ContactSet,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<IBig>> {
        self.vanish(allowed, support, support, proceed)
    }

    /// The lifted equations.
    pub(super) fn system(&self) -> &LiftedSystem {
        &self.system
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
        let known = self.known.iter().find(|(columns, _)| support.is_within(columns));
        if let Some((columns, pattern)) = known
            && let Some(vector) = self.vanish(&allowed, &support, columns, proceed)
        {
            let left = columns.clone();
            return Some(Settled { pattern: pattern.clone(), is_known: true, vector, left });
        }
        let pattern = independent_pattern(problem, states, positive)?;
        let reduced = if self.to_support { self.reducing(&allowed, &support, proceed) } else { None };
        let (vector, left) = if let Some(vector) = reduced {
            (vector, support)
        } else {
            let own: Vec<StateSet> = pattern.iter().map(|&state| StateSet::only(state)).collect();
            let own = self.allowed(&own);
            (self.vanish(&allowed, &support, &own, proceed)?, own)
        };
        self.known.push((left.clone(), pattern.clone()));
        Some(Settled { pattern, is_known: false, vector, left })
    }

    /// A vector which proves that, in all solutions with the allowed columns, the unknowns of all others than
    /// the given ones vanish: empty if there are no others; `None` if none was found.
    fn vanish(
        &self,
        allowed: &ContactSet,
        support: &ContactSet,
        columns: &ContactSet,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<IBig>> {
        let rest: Vec<usize> = allowed.iter().filter(|&column| !columns.contains(column)).collect();
        if rest.is_empty() {
            return Some(Vec::new());
        }
        let (allowed, support): (Vec<usize>, Vec<usize>) =
            (allowed.iter().collect(), support.iter().collect());
        separate(&self.system, (&allowed, &support), Separated::Vanishing(&rest), proceed)
    }

    /// The columns of all states that a node allows.
    pub(super) fn allowed(&self, states: &[StateSet]) -> ContactSet {
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
