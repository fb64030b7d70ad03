//! All solutions at values of the parameter.

use super::conditions::{are_met, conditions};
use super::family::Instance;
use super::place::{Equations, Place};
use crate::blocks::{BlockSolution, search};
use crate::interval::Sign;
use crate::problem::ContactState;
use crate::progress::Callback;
use crate::search::SearchOptions;
use crate::status::Proof;

/// One solution.
#[derive(Debug, Clone)]
pub(super) struct Found {
    pub(super) place: Place,
    pub(super) equations: Equations,
    pub(super) states: Vec<ContactState>,
    pub(super) orientation: Sign,
}

/// All solutions at a value: what is listed is proven complete for the rounded numbers there.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    pub(super) at: f64,
    pub(super) found: Vec<Found>,
    /// Contacts and hinges without force in some solution.
    pub(super) without_force: Vec<usize>,
}

/// What has one branch in each of its neighbours, unless some branch ends between them.
pub(super) type Class = (Vec<Option<ContactState>>, Sign);

impl Found {
    pub(super) fn class(&self) -> Class {
        (self.equations.states.clone(), self.orientation)
    }
}

impl Sample {
    /// The classes of all solutions, sorted.
    pub(super) fn classes(&self) -> Vec<Class> {
        let mut classes: Vec<Class> = self.found.iter().map(Found::class).collect();
        classes.sort();
        classes
    }

    /// All solutions at a value, with forces in this unit and normal forces up to `greatest`; none if their list is
    /// not proven complete.
    pub(super) fn new(
        at: f64,
        instance: &Instance,
        (unit, greatest): (f64, Option<f64>),
        options: &SearchOptions,
        progress: &mut Callback<'_>,
    ) -> Option<Self> {
        let result = search(&instance.problem, options, progress);
        if result.complete != Proof::Proven {
            return None;
        }
        let contacts = instance.problem.contacts();
        let mut without_force: Vec<usize> = Vec::new();
        let mut found = Vec::new();
        for solution in &result.solutions {
            let without = solution.on_boundary.iter().copied();
            without_force.extend(without.chain(solution.unloaded.iter().map(|hinge| contacts + hinge)));
            let one = Found::of(solution, at, instance);
            if one.meets_conditions(instance, greatest) {
                found.push(one.in_unit(unit));
            }
        }
        without_force.sort_unstable();
        without_force.dedup();
        Some(Self { at, found, without_force })
    }
}

impl Found {
    /// A solution at a value, in the unit of the problem.
    pub(super) fn of(solution: &BlockSolution, at: f64, instance: &Instance) -> Self {
        let state = |contact: usize| {
            let is_zero = solution.on_boundary.contains(&contact);
            (!is_zero).then_some(solution.states[contact])
        };
        let states = (0..solution.states.len()).map(state).collect();
        let equations = Equations { states, unit: instance.unit() };
        let place = Place::of(solution, at, equations.unit);
        let orientation = equations.orientation(instance, &place.z);
        Self { place, equations, states: solution.states.clone(), orientation }
    }

    /// Whether it keeps the bounds of outputs, and normal forces up to `greatest`.
    pub(super) fn meets_conditions(&self, instance: &Instance, greatest: Option<f64>) -> bool {
        are_met(&conditions(&self.equations, instance, &self.place, greatest))
    }

    /// The same in another unit of forces.
    fn in_unit(self, unit: f64) -> Self {
        let equations = self.equations.with_unit(unit);
        Self { place: self.equations.converted(&self.place, &equations), equations, ..self }
    }
}
