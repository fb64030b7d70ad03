//! Hinges that turn with friction: all solutions for their forces and for the normal forces of the contacts that slide, by
//! the block mode problem of a group (theory of hinges, section 1).
//!
//! ```text
//! x = b + d^sigma + H^sigma w      w = |N_k| of the contacts that slide, |R_j| of the hinges that turn
//! ```
//!
//! What sticks is held by a force or couple of its own, as far as no other holds it already.

use super::BOUNDARY;
use super::instant::Instant;
use super::outputs::Group;
use super::system::Question;
use crate::modes::blocks::{self, BlockProblem, BlockSolution};
use crate::modes::{BlockNumbers, BySide, ContactState, SearchOptions, Side};
use crate::pattern::{ContactPhase, JointPhase, Phase, direction};
use crate::progress::Work;
use nalgebra::{DMatrix, DVector};

/// The block mode problem of what slides and turns in a group.
pub(super) struct Turning<'t> {
    instant: &'t Instant<'t>,
    question: &'t Question<'t>,
    phase: &'t Phase,
    /// The contacts that slide, each with the sign of its sliding velocity.
    contacts: Vec<(usize, f64)>,
    /// The hinges that turn, likewise.
    hinges: Vec<(usize, f64)>,
    /// The outputs of these without friction, then by unit friction at either face, then by unit couples.
    base: DVector<f64>,
    columns: [DMatrix<f64>; 2],
    couples: DMatrix<f64>,
}

impl<'t> Turning<'t> {
    /// The problem of a group with the joints and hinges of a phase; `None` if what holds the ones that stick is singular, or
    /// the work is to end.
    pub(super) fn new(
        instant: &'t Instant<'t>,
        question: &'t Question<'t>,
        (phase, group): (&'t Phase, &Group),
        work: Work<'_>,
    ) -> Option<Self> {
        let sign = |k: usize| instant.joint_of(k).map_or(0.0, |joint| phase.joints[joint].sign());
        let moving = |(_, sign): &(usize, f64)| *sign != 0.0;
        let contacts: Vec<(usize, f64)> =
            group.contacts.iter().map(|&k| (k, sign(k))).filter(moving).collect();
        let turns = |hinge: &usize| (*hinge, phase.hinges[*hinge].state.sign());
        let hinges: Vec<(usize, f64)> = group.hinges.iter().map(turns).filter(moving).collect();
        let of_hinge = |&(hinge, _): &(usize, f64)| [1, 2].map(|part| instant.turning_output(hinge) + part);
        let rows: Vec<usize> =
            contacts.iter().map(|(k, _)| *k).chain(hinges.iter().flat_map(of_hinge)).collect();
        let held = Held::new(instant, question, (phase, group), work)?;
        let outputs = question.outputs;
        let answers = |columns: Vec<DVector<f64>>| {
            let answers: Vec<DVector<f64>> =
                columns.into_iter().map(|column| held.answer(column, 0.0).select_rows(&rows)).collect();
            DMatrix::from_fn(rows.len(), answers.len(), |row, column| answers[column][row])
        };
        let friction = |face: usize| {
            answers(contacts.iter().map(|(k, _)| outputs.columns[face].column(*k).into_owned()).collect())
        };
        let turning = hinges.iter().map(|(hinge, _)| outputs.couples.column(*hinge).into_owned());
        Some(Self {
            base: held.answer(outputs.base.clone(), 1.0).select_rows(&rows),
            columns: [0, 1].map(friction),
            couples: answers(turning.collect()),
            instant,
            question,
            phase,
            contacts,
            hinges,
        })
    }

    /// What the friction of a contact at a side adds: by its normal force, and by its preload.
    fn friction(&self, index: usize, side: Side) -> [DVector<f64>; 2] {
        let (k, sign) = self.contacts[index];
        let [plus, minus] = self.instant.law(k, self.question.has_preload).kinetic(side, sign);
        let [at_plus, at_minus] = self.columns.each_ref().map(|columns| columns.column(index));
        [0, 1].map(|part| at_plus * plus[part] + at_minus * minus[part])
    }

    /// What the couple of a hinge adds by its force.
    fn couple(&self, index: usize) -> DVector<f64> {
        let (hinge, sign) = self.hinges[index];
        let rough = &self.instant.hinges[hinge];
        self.couples.column(index) * (-sign * rough.radii[0] / rough.units.length)
    }

    fn problem(&self) -> Option<BlockProblem> {
        let matrix = |columns: Vec<DVector<f64>>| {
            DMatrix::from_fn(self.base.len(), columns.len(), |row, column| columns[column][row])
        };
        let contacts = |side: Side| (0..self.contacts.len()).map(move |index| self.friction(index, side));
        let hinges = || (0..self.hinges.len()).map(|index| self.couple(index));
        let numbers = BlockNumbers {
            response: BySide::of(|side| {
                matrix(contacts(side).map(|[response, _]| response).chain(hinges()).collect())
            }),
            jumps: BySide::of(|side| matrix(contacts(side).map(|[_, jump]| jump).collect())),
            load: self.base.clone(),
        };
        numbers.problem().ok()
    }

    /// The phases of all solutions, those without a normal force at a contact on either side, and whether these are all.
    pub(super) fn phases(&self, work: Work<'_>) -> (Vec<Phase>, bool) {
        let Some(problem) = self.problem() else { return (Vec::new(), false) };
        let result = blocks::search(&problem, &SearchOptions::default(), &mut |_| work.flow());
        let phases = result.solutions.iter().flat_map(|solution| self.phases_of(solution)).collect();
        (phases, result.open.is_empty() && result.stopped.is_none())
    }

    fn phases_of(&self, solution: &BlockSolution) -> Vec<Phase> {
        let mut phase = self.phase.clone();
        for ((hinge, _), force) in self.hinges.iter().zip(&solution.reactions) {
            phase.hinges[*hinge].force =
                force.map(|component| component * self.instant.hinges[*hinge].units.force);
        }
        let mut all = vec![phase];
        for (index, (k, _)) in self.contacts.iter().enumerate() {
            let options = match solution.states[index] {
                ContactState::Gap => vec![ContactPhase::PreloadGap],
                _ if solution.forces[index].abs() <= BOUNDARY => self.question.sides[*k].clone(),
                ContactState::Positive => vec![ContactPhase::Pressed(Side::Positive)],
                ContactState::Negative => vec![ContactPhase::Pressed(Side::Negative)],
            };
            let options: Vec<ContactPhase> =
                options.into_iter().filter(|option| self.question.sides[*k].contains(option)).collect();
            let with = |phase: &Phase, option: &ContactPhase| {
                let mut phase = phase.clone();
                phase.contacts[*k] = *option;
                phase
            };
            all =
                all.iter().flat_map(|phase| options.iter().map(move |option| with(phase, option))).collect();
        }
        all
    }

    /// Whether `det(I - H D)` is negative in the phase, so that no mechanism with elastic guides and pins can follow it
    /// (theory of hinges, section 5); false where a contact is between its faces.
    pub(super) fn is_unattainable(&self) -> bool {
        let size = self.base.len();
        let mut jacobian = DMatrix::identity(size, size);
        for (index, (k, _)) in self.contacts.iter().enumerate() {
            let ContactPhase::Pressed(side) = self.phase.contacts[*k] else { return false };
            let [response, _] = self.friction(index, side);
            jacobian.column_mut(index).axpy(-side.sign(), &response, 1.0);
        }
        for (index, (hinge, _)) in self.hinges.iter().enumerate() {
            let response = self.couple(index);
            for (part, along) in direction(self.phase.hinges[*hinge].force).into_iter().enumerate() {
                jacobian.column_mut(self.contacts.len() + 2 * index + part).axpy(-along, &response, 1.0);
            }
        }
        jacobian.determinant() < 0.0
    }
}

/// What holds those that stick.
struct Held {
    /// The rows of their accelerations, and how all outputs respond to a force at each.
    rows: Vec<usize>,
    responses: DMatrix<f64>,
    wanted: DVector<f64>,
    mobility: nalgebra::LU<f64, nalgebra::Dyn, nalgebra::Dyn>,
}

impl Held {
    fn new(
        instant: &Instant<'_>,
        question: &Question<'_>,
        (phase, group): (&Phase, &Group),
        work: Work<'_>,
    ) -> Option<Self> {
        let sticks = |number: &usize| match number.checked_sub(instant.joints.len()) {
            None => phase.joints[*number] == JointPhase::Sticking,
            Some(hinge) => phase.hinges[hinge].state == JointPhase::Sticking,
        };
        let mut held: Vec<usize> = Vec::new();
        for number in group.members(instant.joints.len()).filter(sticks) {
            if work.is_over() {
                return None;
            }
            if instant.is_movable(number, &held) {
                held.push(number);
            }
        }
        let rows: Vec<usize> = held.iter().map(|number| instant.acceleration_output(*number)).collect();
        let columns: Vec<DVector<f64>> =
            held.iter().map(|number| instant.response_to_force(*number)).collect();
        let responses =
            DMatrix::from_fn(question.outputs.base.len(), held.len(), |row, column| columns[column][row]);
        let mobility = responses.select_rows(&rows).lu();
        let wanted = DVector::from_fn(held.len(), |index, _| question.wanted[held[index]]);
        (held.is_empty() || mobility.is_invertible()).then_some(Self { rows, responses, wanted, mobility })
    }

    /// A column of outputs with the forces that hold what sticks at the wanted accelerations, times a factor.
    fn answer(&self, column: DVector<f64>, wanted: f64) -> DVector<f64> {
        if self.rows.is_empty() {
            return column;
        }
        let missing = &self.wanted * wanted - column.select_rows(&self.rows);
        match self.mobility.solve(&missing) {
            Some(forces) => column + &self.responses * forces,
            None => column,
        }
    }
}
