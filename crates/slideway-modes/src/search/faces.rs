//! Nodes whose solutions are one set: a face of the lifted polyhedron without contradiction.
//!
//! The solutions of the relaxation of a node are a face. If the states of all contacts agree with its
//! inside, where as many unknowns are positive as possible, the whole face consists of solutions, all of
//! one pattern. That all other unknowns vanish is proven by vectors in integers ([`WithoutFree::separate`]), so the node is
//! settled with this pattern, however many others the node has.

use std::sync::{Arc, OnceLock};

use dashu_int::IBig;
use nalgebra::DVector;

use super::leaf::Leaves;
use super::monitor::Monitor;
use super::reduced::ReducedRelaxation;
use super::relaxation::Positive;
use super::separation::Separated;
use super::signs::RowSigns;
use super::states::StateSet;
use super::without_free::WithoutFree;
use crate::certificate::{Decision, LiftedSystem, Sign};
use crate::problem::{ContactState, ProblemView, ScaledProblem};
use crate::solutions::ContactSet;

/// Faces of the relaxation of an exact problem.
#[derive(Clone)]
pub(super) struct Faces {
    system: Arc<LiftedSystem>,
    signs: Arc<RowSigns>,
    /// Contacts whose columns are opposite, without jumps: `y^+ - y^-` may have any sign.
    free: Arc<Vec<bool>>,
    without_free: Arc<WithoutFree>,
    /// The relaxation without free contacts, computed when it is first needed; nothing if there is none.
    reduced: Arc<OnceLock<Option<Arc<ReducedRelaxation>>>>,
    /// The patterns that are examined, with the columns that a node may have to be settled by them.
    known: Vec<(ContactSet, Vec<ContactState>)>,
    /// Whether nodes are settled with the columns of the positive unknowns, not with all of a pattern, if
    /// possible.
    to_support: bool,
}

/// How a node is settled by a face.
pub(super) struct Settled {
    /// All its solutions are those of this pattern.
    pub(super) pattern: Vec<ContactState>,
    /// Whether the pattern is examined already.
    pub(super) is_known: bool,
    /// Proves that the unknowns of all other columns than those left vanish; empty if there are no others.
    pub(super) vector: Vec<IBig>,
    /// Columns of the pattern that contain all its solutions in the node, besides those of free contacts.
    pub(super) left: ContactSet,
    /// The outcome of the pattern, if it is known.
    pub(super) decision: Option<Decision>,
}

impl Faces {
    pub(super) fn new(problem: ProblemView<'_>) -> Self {
        let system = LiftedSystem::new(problem);
        let opposite = |contact: usize| {
            let [one, other] = [contact, system.contacts() + contact].map(|column| system.column(column));
            !problem.has_jump(contact) && one.iter().zip(other).all(|(one, other)| *one == -other)
        };
        let free: Vec<bool> = (0..system.contacts()).map(opposite).collect();
        let signs = Arc::new(RowSigns::new(&system));
        let system = Arc::new(system);
        let without_free = Arc::new(WithoutFree::new(&system, &free));
        let reduced = Arc::new(OnceLock::new());
        Self {
            system,
            signs,
            free: Arc::new(free),
            without_free,
            reduced,
            known: Vec::new(),
            to_support: false,
        }
    }

    /// The same, with nodes settled by as few columns as possible, for the cells of a proof.
    pub(super) fn with_supports(self) -> Self {
        Self { to_support: true, without_free: Arc::new(self.without_free.for_all()), ..self }
    }

    /// The signs of the equations.
    pub(super) fn signs(&self) -> &RowSigns {
        &self.signs
    }

    /// The contacts whose columns are opposite: they have the sides of the solution that the others determine.
    pub(super) fn free(&self) -> &[bool] {
        &self.free
    }

    /// The free contacts that are open when a node is settled. A cell of a proof has one side of each contact, so that a
    /// proof branches on them.
    pub(super) fn open_free(&self, states: &[StateSet]) -> Vec<usize> {
        let is_open = |&contact: &usize| self.free[contact] && states[contact].decided().is_none();
        if self.to_support { Vec::new() } else { (0..states.len()).filter(is_open).collect() }
    }

    /// The relaxation of nodes in which all free contacts are open.
    pub(super) fn reduced(
        &self,
        states: &[StateSet],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Arc<ReducedRelaxation>> {
        let open = self.open_free(states).len();
        if open == 0 || open < self.free.iter().filter(|is_free| **is_free).count() {
            return None;
        }
        let computed = || {
            let others = self.without_free.others(proceed)?;
            Some(Arc::new(ReducedRelaxation::new(&others, &self.free)))
        };
        self.reduced.get_or_init(computed).clone()
    }

    /// A vector in integers that proves that a node has no solution, if one is found; for a proof, whatever the length of
    /// its integers.
    pub(super) fn excluding(
        &self,
        states: &[StateSet],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<IBig>> {
        let allowed = self.allowed(states);
        let none = ContactSet::none_of(self.system.width());
        match self.without_free.separate((&allowed, &none), Separated::Infeasible, proceed) {
            None if self.to_support => self.system.farkas(&allowed.iter().collect::<Vec<_>>(), proceed),
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
    /// its relaxation, all of which belong to one state of each contact that is not free; `None` if that could not be
    /// proven.
    pub(super) fn settle(
        &mut self,
        problem: &ScaledProblem,
        (states, positive): (&[StateSet], &[Positive]),
        (leaves, monitor): (&mut Leaves<'_>, &mut Monitor<'_>),
    ) -> Option<Settled> {
        let proceed = &mut || monitor.goes_on();
        let support = self.support(positive);
        let allowed = self.allowed(states);
        let known = self.known.iter().find(|(columns, _)| support.is_within(columns));
        if let Some((columns, pattern)) = known
            && let Some(vector) = self.vanish(&allowed, &support, columns, proceed)
        {
            let (pattern, left) = (pattern.clone(), columns.clone());
            return Some(Settled { pattern, is_known: true, vector, left, decision: None });
        }
        let free = self.open_free(states);
        let mut pattern = independent_pattern(problem, states, positive, &free)?;
        let reduced = if self.to_support { self.reducing(&allowed, &support, proceed) } else { None };
        let (vector, left) = if let Some(vector) = reduced {
            (vector, support)
        } else {
            let own: Vec<StateSet> = pattern.iter().map(|&state| StateSet::only(state)).collect();
            let mut own = self.allowed(&own);
            for side in ContactState::PRESSED {
                let columns = free.iter().flat_map(|&contact| self.system.columns_of(contact, side));
                columns.for_each(|column| own.insert(column));
            }
            (self.vanish(&allowed, &support, &own, proceed)?, own)
        };
        let decision = if free.is_empty() {
            None
        } else {
            Some(self.with_sides_of_free(&mut pattern, &free, (leaves, monitor))?)
        };
        self.known.push((left.clone(), pattern.clone()));
        Some(Settled { pattern, is_known: false, vector, left, decision })
    }

    /// Gives the free contacts of a pattern the sides of its only solution, if its matrix is regular, which does not depend on
    /// these sides; returns what the pattern then admits. `None` if there is no such solution, or no time.
    fn with_sides_of_free(
        &self,
        pattern: &mut [ContactState],
        free: &[usize],
        (leaves, monitor): (&Leaves<'_>, &mut Monitor<'_>),
    ) -> Option<Decision> {
        let solution = self.without_free.solve(pattern, &mut || monitor.goes_on());
        let mut solution = solution.or_else(|| leaves.solve_exactly(pattern, monitor))?;
        for &contact in free {
            if solution.sign(contact) == Sign::Negative {
                turn(&mut pattern[contact]);
                solution.turn(contact);
            }
        }
        match solution.decide(pattern) {
            decision @ (Decision::Solution { .. } | Decision::Boundary { .. }) => Some(decision),
            _ => None,
        }
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
        self.without_free.separate((allowed, support), Separated::Vanishing(&rest), proceed)
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

/// To the other side.
fn turn(side: &mut ContactState) {
    *side = match side {
        ContactState::Positive => ContactState::Negative,
        _ => ContactState::Positive,
    };
}

/// A pattern of a node that agrees with the positive unknowns, and whose columns are independent if that is
/// easily possible: where several states agree, it is the one whose column is furthest from the span of those
/// chosen before. `None` if no state of some contact agrees. With free contacts, any side agrees.
fn independent_pattern(
    problem: &ScaledProblem,
    states: &[StateSet],
    positive: &[Positive],
    free: &[usize],
) -> Option<Vec<ContactState>> {
    let choices = states.iter().zip(positive).enumerate().map(|(contact, (set, at))| {
        if free.contains(&contact) { vec![ContactState::Positive] } else { agreeing(*set, *at) }
    });
    let choices: Vec<Vec<ContactState>> = choices.collect();
    let mut order: Vec<usize> = (0..states.len()).collect();
    order.sort_by_key(|&contact| choices[contact].len());
    let mut pattern: Vec<ContactState> =
        choices.iter().map(|states| states.first().copied()).collect::<Option<_>>()?;
    if choices.iter().all(|states| states.len() == 1) {
        return Some(pattern);
    }
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
