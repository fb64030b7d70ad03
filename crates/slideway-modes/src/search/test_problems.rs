//! Random problems with everything that they admit, by proof, for tests of individual arguments.

use nalgebra::{DMatrix, DVector};

use super::states::StateSet;
use crate::certificate::{Decision, ExactSet, decide};
use crate::problem::{ContactState, ModeProblem, Side, patterns};

/// Numbers from a linear congruential generator (Knuth's MMIX constants).
pub(super) struct Numbers {
    state: u64,
}

impl Numbers {
    pub(super) fn new(seed: u64) -> Self {
        let mut numbers = Self { state: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1 };
        numbers.number();
        numbers
    }

    /// From -1 to 1.
    pub(super) fn number(&mut self) -> f64 {
        self.state =
            self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// From 0 to less than `count`.
    pub(super) fn below(&mut self, count: usize) -> usize {
        (0..count).rfind(|&at| f64::midpoint(self.number(), 1.0) < 1.0 / (at + 1) as f64).unwrap_or(0)
    }

    /// Two different versions of the columns, and jumps of all contacts except the first, or of none.
    pub(super) fn problem(&mut self, contacts: usize, strength: f64, jumps: bool) -> ModeProblem {
        let mut part = |strength: f64| DMatrix::from_fn(contacts, contacts, |_, _| strength * self.number());
        let [positive, negative] =
            [1.0, -1.0].map(|sign| DMatrix::identity(contacts, contacts) * sign + part(strength));
        let [up, down] = [0, 1].map(|_| {
            let mut jumps = part(if jumps { 1.0 } else { 0.0 });
            jumps.column_mut(0).fill(0.0);
            jumps
        });
        let load = DVector::from_fn(contacts, |_, _| self.number());
        ModeProblem::new(positive, negative, up, down, load).expect("shapes fit")
    }

    /// A problem in which these contacts are free.
    pub(super) fn problem_with_free(&mut self, is_free: &[bool]) -> ModeProblem {
        let problem = self.problem(is_free.len(), 1.5, false);
        let [positive, mut negative] = Side::BOTH.map(|side| problem.columns(side).clone());
        for contact in (0..is_free.len()).filter(|&contact| is_free[contact]) {
            negative.set_column(contact, &-positive.column(contact));
        }
        let none = DMatrix::zeros(is_free.len(), is_free.len());
        ModeProblem::new(positive, negative, none.clone(), none, problem.right_hand_side().clone())
            .expect("shapes fit")
    }

    /// The problem with a load changed within a radius.
    pub(super) fn with_load_off_by(&mut self, problem: &ModeProblem, radius: f64) -> ModeProblem {
        let load = problem.right_hand_side().map(|value| value + radius * self.number().signum());
        let [positive, negative] = Side::BOTH.map(|side| problem.columns(side).clone());
        let [up, down] = Side::BOTH.map(|side| problem.jumps(side).clone());
        ModeProblem::new(positive, negative, up, down, load).expect("shapes fit")
    }
}

/// Every pattern that has a solution, with the midpoints of its bounds.
pub(super) fn admitted(problem: &ModeProblem) -> Vec<(Vec<ContactState>, Vec<f64>)> {
    let mut admitted = Vec::new();
    for pattern in patterns(&problem.jumps_of_contacts(), u64::MAX).expect("no limit") {
        match decide(problem, &pattern).decision {
            Decision::Solution { unknowns, .. } | Decision::Boundary { unknowns, .. } => {
                admitted.push((pattern, unknowns.iter().map(|value| value.middle()).collect()));
            }
            Decision::Singular { set } => assert_eq!(set, ExactSet::Empty, "a generic problem"),
            Decision::NoSolution { .. } | Decision::Undecided { .. } => {}
        }
    }
    admitted
}

/// Whether a node contains a pattern.
pub(super) fn holds(states: &[StateSet], pattern: &[ContactState]) -> bool {
    states.iter().zip(pattern).all(|(set, &state)| set.contains(state))
}
