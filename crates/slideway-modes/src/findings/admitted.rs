//! The set of solutions that a singular pattern admits, as it is recorded.

use dashu_ratio::RBig;

use crate::certificate::ExactSet;
use crate::problem::{ContactState, SolutionSet};
use crate::solutions::{GapShare, Support};

/// The set of solutions that a singular pattern admits.
#[derive(Debug, Clone)]
pub(crate) struct Admitted {
    pub(crate) set: SolutionSet,
    pub(crate) support: Support,
    /// If all states have the same normal forces: the mean of the shares at the vertices, which is one of the
    /// states.
    pub(crate) shares: Vec<GapShare>,
    /// Whether states with the same normal forces differ in their shares.
    pub(crate) shares_vary: bool,
}

impl Admitted {
    /// From the normal forces, the number of vertices with their shares, and the mean share of a contact at
    /// these vertices.
    pub(crate) fn new(
        pattern: &[ContactState],
        (set, support): (SolutionSet, Support),
        (vertices, mean_share): (usize, &dyn Fn(usize) -> f64),
    ) -> Self {
        let is_point = matches!(set, SolutionSet::Point(_));
        let in_gap = (0..pattern.len()).filter(|&contact| is_point && pattern[contact] == ContactState::Gap);
        let shares = in_gap.map(|contact| GapShare { contact, lambda: mean_share(contact) }).collect();
        Self { set, support, shares, shares_vary: is_point && vertices > 1 }
    }

    /// Nothing is known about it.
    pub(crate) fn not_computed(contacts: usize) -> Self {
        let (set, support) = (SolutionSet::NotComputed, Support::none_of(contacts));
        Self { set, support, shares: Vec::new(), shares_vary: false }
    }

    /// From all exact solutions of the equations.
    pub(crate) fn exactly(pattern: &[ContactState], set: &ExactSet, has_jump: &[bool]) -> Self {
        let support = Support::of_exact_set(pattern, set, has_jump);
        let vertices = set.vertices();
        let mean_share = |contact: usize| {
            let sum = vertices.iter().fold(RBig::ZERO, |sum, vertex| sum + &vertex[contact]);
            (sum / RBig::from(vertices.len())).to_f64().value()
        };
        Self::new(pattern, (set.normal_forces(pattern), support), (vertices.len(), &mean_share))
    }
}
