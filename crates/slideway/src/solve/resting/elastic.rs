//! Whether a state persists in which some joints stick, if contacts are slightly elastic along n where they are closed, and along u
//! where they stick (theory, section 12).
//!
//! With the gaps `g` of the closed contacts and the slips `xi` of what sticks, `N = -K g` and `T = -K xi`,
//!
//! ```text
//! [ Y  0 ] [g ]''   [C S  E] [N]
//! [-B  I] [xi]   = [ F   D] [T]
//! ```
//!
//! where `Y` and `C S` are those of contacts that slide (section 7), `B` tells how the slips accelerate with the gaps, `E` what a
//! unit of T adds to the normal forces, `F` and `D` what units of N with its friction and of T add to the accelerations of the slips.

use super::patterns::{Stuck, System, face_of};
use super::{Point, Resting};
use crate::attainability::ElasticJoints;
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::kinetics::Reaction;
use crate::mechanism::Mechanism;
use crate::modes::ContactState;
use crate::report::Attainability;
use crate::solve::attainability::{Left, NOT_DRIVEN, not_computed};
use crate::solve::friction::friction;
use crate::solve::mode_problem::ProblemData;
use nalgebra::{DMatrix, DVector};

impl Resting<'_> {
    /// The attainability of a state in which joints stick.
    pub(super) fn with_springs(&self, point: &Point) -> Attainability {
        self.examined(point).unwrap_or_else(|_| not_computed(NOT_DRIVEN))
    }

    fn examined(&self, point: &Point) -> Result<Attainability, Faults> {
        let super::Answer { mechanism, configuration, influence, equations, .. } = *self.answer;
        let signs = self.signs(&point.pattern);
        let open: Vec<usize> = mechanism.opening(&point.pattern.states).collect();
        let data = ProblemData { mechanism, influence, velocity_signs: &signs };
        let left = Left::new(data, (configuration, equations), &open)?;
        let system = self.system(point.pattern.clone(), mechanism);
        let springs = Springs { resting: self, system: &system, left: &left };
        let joints =
            ElasticJoints::with_sticking(mechanism, &left.equations, springs.inertia(), springs.smooth());
        Ok(joints.of(springs.mode(&left.mechanism), &left.states(&point.pattern.states)))
    }
}

/// The springs of the closed contacts, then of what sticks.
struct Springs<'s> {
    resting: &'s Resting<'s>,
    system: &'s System,
    left: &'s Left<'s>,
}

impl Springs<'_> {
    fn stuck(&self) -> impl Iterator<Item = &Stuck> {
        self.system.sticking.iter()
    }

    /// A part of all unknowns: the normal forces, then the accelerations of the slips.
    fn part(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        let layout = self.left.influence.layout();
        let normal =
            |k: usize| layout.reaction(Reaction::Normal(ContactId(k))).map_or(0.0, |place| unknowns[place]);
        let slips = self.stuck().map(|stuck| self.resting.joints[stuck.joint].row.change(unknowns));
        let all: Vec<f64> = (0..self.left.kept.len()).map(normal).chain(slips).collect();
        DVector::from_vec(all)
    }

    fn of_columns(&self, columns: &[DVector<f64>]) -> DMatrix<f64> {
        let parts: Vec<DVector<f64>> = columns.iter().map(|column| self.part(column)).collect();
        DMatrix::from_columns(&parts)
    }

    /// `[Y 0; -B I]`
    fn inertia(&self) -> DMatrix<f64> {
        let contacts = self.left.kept.len();
        let mut inertia = self.of_columns(&self.left.equations.answers_to_gaps(&[]));
        inertia.rows_mut(contacts, inertia.nrows() - contacts).neg_mut();
        let size = inertia.nrows();
        let mut inertia = inertia.resize_horizontally(size, 0.0);
        (contacts..size).for_each(|slip| inertia[(slip, slip)] = 1.0);
        inertia
    }

    /// `[C S  E; F  D]` with the friction of a mechanism.
    fn mode(&self, mechanism: &Mechanism) -> DMatrix<f64> {
        let Left { kept, influence, velocity_signs, .. } = self.left;
        let states: Vec<ContactState> = self.left.states(&self.system.pattern.states);
        let shares = vec![None; states.len()];
        let of_forces = |forces: &DVector<f64>| {
            influence.of_friction(&friction(mechanism, velocity_signs, &states, forces, &shares))
        };
        let without = of_forces(&DVector::zeros(states.len()));
        let of_contact = |k: usize| {
            let mut forces = DVector::zeros(states.len());
            forces[k] = 1.0;
            (of_forces(&forces) - &without) * states[k].sign()
        };
        let of_stuck = |stuck: &Stuck| {
            let k = kept.iter().position(|k| *k == stuck.contacts[0]).unwrap_or_default();
            // Friction counts against the slip.
            -&influence.columns[k][face_of(states[k])]
        };
        let columns = (0..states.len()).map(of_contact).chain(self.stuck().map(of_stuck));
        let mut mode = self.of_columns(&columns.collect::<Vec<_>>());
        // N stands on the left of its row, what friction adds on the right.
        mode.rows_mut(0, states.len()).neg_mut();
        (0..states.len()).for_each(|k| mode[(k, k)] += 1.0);
        mode
    }

    /// The mode without the friction of what slides.
    fn smooth(&self) -> DMatrix<f64> {
        let mut smooth = Mechanism::clone(&self.left.mechanism);
        smooth.multiply_friction_of_contacts(|_| 0.0);
        self.mode(&smooth)
    }
}
