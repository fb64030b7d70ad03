//! The relaxation of nodes without free unknowns.
//!
//! While a free contact may be on both sides, it takes whatever value its equations ask for. What is left for the others is
//! the mode problem of the Schur complement ([`WithoutFree::others`]), with as many equations as unknowns. Its integers are
//! rounded within bounds, for which the relaxation accounts.

use nalgebra::DVector;

use super::relaxation::{Positive, Relaxation, Relaxed, RelaxedContact};
use super::states::StateSet;
use crate::problem::{IntervalModeProblem, ProblemView, ScaledProblem};
use crate::simplex::Basis;

/// The relaxation of the contacts that are not free.
pub(super) struct ReducedRelaxation {
    relaxation: Relaxation,
    is_free: Vec<bool>,
}

impl ReducedRelaxation {
    /// Of the problem of the other contacts, in their order.
    pub(super) fn new(others: &IntervalModeProblem, is_free: &[bool]) -> Self {
        let view = ProblemView::from(others);
        let scaled = ScaledProblem::within(view);
        let radius =
            view.load().radius.map_or_else(|| DVector::zeros(view.contacts()), DVector::from_column_slice);
        let unbounded = vec![f64::INFINITY; view.contacts()];
        let relaxation = Relaxation::new(&scaled, &scaled.scaled_load_radius(&radius), unbounded);
        Self { relaxation, is_free: is_free.to_vec() }
    }

    /// The relaxation of the other contacts alone.
    pub(super) fn of_others(&self) -> &Relaxation {
        &self.relaxation
    }

    /// [`Relaxation::solve`] for the states of all contacts; a vector that excludes is one of the equations without free
    /// unknowns, and free contacts do not press.
    pub(super) fn solve(
        &self,
        states: &[StateSet],
        basis: Basis,
        iterations: &mut u64,
        proceed: &mut dyn FnMut() -> bool,
    ) -> (Relaxed, Basis) {
        let (relaxed, basis) = self.relaxation.solve(&self.others(states), basis, iterations, proceed);
        let nothing = RelaxedContact { positive: 0.0, negative: 0.0, share: 0.0, cost_without: [0.0; 2] };
        let relaxed = match relaxed {
            Relaxed::Feasible(others) => Relaxed::Feasible(self.with_free(others, nothing)),
            relaxed => relaxed,
        };
        (relaxed, basis)
    }

    /// [`Relaxation::inside`] for the states of all contacts; free contacts agree with any state.
    pub(super) fn inside(
        &self,
        states: &[StateSet],
        basis: &Basis,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<Positive>> {
        let others = self.relaxation.inside(&self.others(states), basis, proceed)?;
        Some(self.with_free(others, Positive { sides: [false; 2], shares: [false; 2] }))
    }

    fn others(&self, states: &[StateSet]) -> Vec<StateSet> {
        states.iter().zip(&self.is_free).filter(|(_, is_free)| !**is_free).map(|(set, _)| *set).collect()
    }

    /// Returns one value for each contact: `free` for free ones, `others` in their order for the rest.
    fn with_free<T: Copy>(&self, others: Vec<T>, free: T) -> Vec<T> {
        let mut others = others.into_iter();
        let of_contact = |&is_free: &bool| if is_free { Some(free) } else { others.next() };
        self.is_free.iter().filter_map(of_contact).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::relaxation::Relaxed;
    use super::super::states::all_states;
    use super::super::test_problems::{Numbers, admitted, holds};
    use super::super::without_free::WithoutFree;
    use super::*;
    use crate::certificate::LiftedSystem;

    /// Every node of the others with all free contacts open: what is excluded admits nothing, and a node is excluded or has
    /// a relaxed solution.
    #[test]
    fn nodes_are_decided_without_free_contacts() {
        let (mut excluded, mut feasible) = (0, 0);
        for seed in 0..100_usize {
            let mut numbers = Numbers::new(seed as u64);
            let is_free: Vec<bool> = (0..5).map(|contact| contact == seed % 5 || contact == 3).collect();
            let problem = numbers.problem_with_free(&is_free);
            let admitted = admitted(&problem);
            let system = Arc::new(LiftedSystem::new((&problem).into()));
            let others =
                WithoutFree::new(&system, &is_free).others(&mut || true).expect("independent columns");
            let reduced = ReducedRelaxation::new(&others, &is_free);
            for pattern in 0..1_usize << is_free.len() {
                let mut states = all_states(&ScaledProblem::new(&problem));
                for contact in (0..is_free.len()).filter(|&contact| !is_free[contact]) {
                    states[contact] =
                        StateSet::only(crate::problem::ContactState::PRESSED[(pattern >> contact) & 1]);
                }
                let first = reduced.of_others().first_basis();
                let has_any = admitted.iter().any(|(pattern, _)| holds(&states, pattern));
                match reduced.solve(&states, first, &mut 0, &mut || true).0 {
                    Relaxed::Excluded(_) => {
                        excluded += 1;
                        assert!(!has_any, "{problem:?} {states:?}");
                    }
                    Relaxed::Feasible(contacts) => {
                        feasible += 1;
                        assert!(has_any && contacts.len() == is_free.len(), "{problem:?} {states:?}");
                    }
                    Relaxed::Undecided => {}
                }
            }
        }
        assert!(excluded > 1000 && feasible > 50, "{excluded} {feasible}");
    }
}
