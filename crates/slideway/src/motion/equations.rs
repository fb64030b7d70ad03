//! The equations of motion within a phase, without new memory at each evaluation.
//!
//! ```text
//! M a - G^T lambda - sum_k W_k^side mu_k s_k sigma_k N_k - B u - sum_j T_j t_j = f + sum_k W_k^side F_k0 s_k
//! G a                                                                          = gamma
//! C a                                                                          = prescribed
//! T_j^T a                                                                      = bias
//! ```
//!
//! Coulomb friction of a contact that is pressed against a known side is linear in its normal force (eq. (2)), so it
//! joins the column of that force: one matrix, not symmetric, is factored for all unknowns. In a preload gap `N_k = 0`,
//! and the share of the face of positive normal force takes the place of `N_k` among the unknowns (theory, section 3).
//! A joint that sticks adds the row that its sliding acceleration is zero, and the tangential force `t_j` on its centre
//! line, block against guide. (At another line of the same joint it would shift normal force between the two ends of
//! the block, and nothing else.)

use super::linear::{Determinant, LinearSystem};
use super::phase::{ContactPhase, JointPhase, Phase};
use super::stepper::Derivative;
use crate::configuration::{Configuration, ContactGeometry};
use crate::fault::Faults;
use crate::ids::{ContactId, DriveId, Frame, JointId};
use crate::kinetics::{
    Applied, ConstraintRow, Layout, Reaction, Wrench, effort_forces, equilibration, friction_forces,
};
use crate::mechanism::{CoordinateKind, JointKind, Mechanism, rot90};
use crate::model::PreloadLine;
use crate::modes::Side;
use nalgebra::{DMatrix, Vector2};

/// A sticking joint whose row is, but for this part of it, a combination of the others is held by them already.
const DEPENDENT: f64 = 1e-7;
/// Ratio of pivots from which on the equations count as singular.
const SINGULAR: f64 = 1e14;

/// Why the equations have no solution in a state.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Failure {
    /// Loads or drives without a value.
    Loads(Faults),
    /// The matrix is singular.
    Singular,
}

/// What the friction of a contact is within a phase.
#[derive(Debug, Clone, Copy)]
enum Rubbing {
    /// F = (mu sigma N + preload) sign, at the face of `sigma`.
    Pressed { sigma: f64, mu: f64, preload: f64, sign: f64 },
    /// N = 0, F = (share preload[0] + (1 - share) preload[1]) sign.
    Gap { preload: [f64; 2], sign: f64 },
    /// The joint sticks: its tangential force stands for all its contacts.
    Sticking,
}

/// A joint that sticks by an equation of its own.
#[derive(Debug, Clone, Copy)]
struct Stuck {
    joint: JointId,
    /// Where it sticks (m).
    displacement: f64,
}

/// The greatest violation of the joints, before a projection.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drift {
    /// Of positions (in sizes of the mechanism, or rad).
    pub position: f64,
    /// Of velocities (in sizes of the mechanism, or rad, per s).
    pub velocity: f64,
}

impl Drift {
    /// The greater of both, each by itself.
    pub(super) fn max(self, other: Self) -> Self {
        Self { position: self.position.max(other.position), velocity: self.velocity.max(other.velocity) }
    }
}

/// The equations of motion of a mechanism in a phase, at a state.
///
/// The state is a vector: (x, y, angle) of every body, their rates, then the work done so far by every contact, load
/// and drive.
pub(super) struct Equations<'m> {
    pub(super) mechanism: &'m Mechanism,
    layout: Layout,
    /// The joints that slide, in their order.
    pub(super) sliders: Vec<JointId>,
    /// Where the normal force of each contact stands among the unknowns.
    normal: Vec<usize>,
    /// Whether the work of each load is counted as potential energy.
    pub(super) conservative: Vec<bool>,
    rubbing: Vec<Rubbing>,
    stuck: Vec<Stuck>,
    /// The state of the last evaluation.
    pub(super) configuration: Configuration,
    pub(super) contacts: Vec<ContactGeometry>,
    pub(super) applied: Applied,
    /// The rows of all reactions and of the sticking joints, one after the other.
    rows: Vec<(usize, f64)>,
    row_ends: Vec<usize>,
    row: ConstraintRow,
    system: LinearSystem,
    /// Accelerations, reactions, efforts, tangential forces.
    unknowns: Vec<f64>,
    work: Vec<f64>,
    condition: f64,
    /// How often they were evaluated.
    pub(super) evaluations: u64,
}

impl<'m> Equations<'m> {
    /// The equations of a mechanism, not yet in a phase.
    pub(super) fn new(mechanism: &'m Mechanism, configuration: &Configuration) -> Self {
        let layout = Layout::of(mechanism);
        let contacts = (0..mechanism.contacts.len()).map(ContactId);
        let normal = contacts.clone().filter_map(|contact| layout.reaction(Reaction::Normal(contact)));
        Self {
            mechanism,
            sliders: sliding_joints(mechanism),
            normal: normal.collect(),
            conservative: mechanism.loads.iter().map(super::energy::is_conservative).collect(),
            rubbing: vec![Rubbing::Sticking; mechanism.contacts.len()],
            stuck: Vec::new(),
            configuration: configuration.clone(),
            contacts: contacts.map(|contact| configuration.contact(mechanism, contact)).collect(),
            applied: Applied::new(),
            rows: Vec::new(),
            row_ends: Vec::new(),
            row: ConstraintRow::empty(),
            system: LinearSystem::new(0),
            unknowns: Vec::new(),
            work: Vec::new(),
            condition: 1.0,
            evaluations: 0,
            layout,
        }
    }

    /// Components of the state.
    pub(super) fn state_size(&self) -> usize {
        let powers = self.contacts.len() + self.mechanism.loads.len() + self.mechanism.drives.len();
        6 * self.mechanism.bodies.len() + powers
    }

    /// The state vector of a configuration, without any work so far.
    pub(super) fn state_of(&self, configuration: &Configuration) -> Vec<f64> {
        let poses = configuration.poses.iter().flat_map(|p| [p.position.x, p.position.y, p.angle]);
        let rates = configuration.velocities.iter().flat_map(|v| [v.linear.x, v.linear.y, v.angular]);
        let mut state: Vec<f64> = poses.chain(rates).collect();
        state.resize(self.state_size(), 0.0);
        state
    }

    /// Enters a phase at a state: chooses the rows of sticking joints and the scales of the equations.
    ///
    /// # Errors
    /// Loads without a value there, or a matrix that is singular.
    pub(super) fn enter(&mut self, phase: &Phase, time: f64, state: &[f64]) -> Result<(), Failure> {
        self.place(time, state);
        self.choose_friction(phase);
        self.choose_stuck(phase);
        let size = self.layout.len() + self.stuck.len();
        self.system = LinearSystem::new(size);
        self.unknowns = vec![0.0; size];
        self.work = vec![0.0; size];
        self.assemble()?;
        let (rows, columns) =
            equilibration(&DMatrix::from_fn(size, size, |row, column| self.system.entry(row, column)));
        self.system.set_scales(rows.as_slice(), columns.as_slice());
        self.evaluate(time, state)
    }

    fn choose_friction(&mut self, phase: &Phase) {
        for (index, joint) in self.sliders.iter().enumerate() {
            let slider = self.mechanism.slider(*joint).expect("sliding joints slide");
            for contact in &slider.contacts {
                let k = contact.index();
                let law = &self.mechanism.contacts[k];
                self.rubbing[k] = match (phase.joints[index], phase.contacts[k]) {
                    (JointPhase::Sticking, _) => Rubbing::Sticking,
                    (JointPhase::Sliding(sign), ContactPhase::Pressed(side)) => {
                        let face = usize::from(side == Side::Negative);
                        let (mu, preload) = (law.mu[face], law.preload[face]);
                        Rubbing::Pressed { sigma: side.sign(), mu, preload, sign }
                    }
                    (JointPhase::Sliding(sign), ContactPhase::PreloadGap) => {
                        Rubbing::Gap { preload: law.preload, sign }
                    }
                };
            }
        }
    }

    /// The sticking joints whose rows say something that neither the joints nor the drives nor those before say.
    fn choose_stuck(&mut self, phase: &Phase) {
        self.stuck.clear();
        let (mechanism, size) = (self.mechanism, self.mechanism.size);
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let bodies = 3 * mechanism.bodies.len();
        // What is left of a row, of unit length, beside the rows so far; the angles are counted in sizes.
        let mut is_new = |row: &ConstraintRow| {
            let mut left = vec![0.0; bodies];
            for &(column, value) in &row.entries {
                left[column] += if column % 3 == 2 { value / size } else { value };
            }
            let length = norm(&left);
            for _ in 0..2 {
                for known in &basis {
                    let along: f64 = known.iter().zip(&left).map(|(a, b)| a * b).sum();
                    left.iter_mut().zip(known).for_each(|(value, known)| *value -= along * known);
                }
            }
            let rest = norm(&left);
            let new = rest > DEPENDENT * length;
            if new {
                for value in &mut left {
                    *value /= rest;
                }
                basis.push(left);
            }
            new
        };
        for reaction in self.layout.reactions() {
            self.row.set_constraint(mechanism, &self.configuration, &self.contacts, *reaction);
            is_new(&self.row);
        }
        for drive in &mechanism.drives {
            let kind = mechanism.coordinates[drive.coordinate.index()].kind;
            self.row.set_coordinate(mechanism, &self.configuration, kind);
            is_new(&self.row);
        }
        for (joint, state) in self.sliders.iter().zip(&phase.joints) {
            if *state == JointPhase::Sticking {
                self.row.set_coordinate(mechanism, &self.configuration, CoordinateKind::Slide(*joint));
                if is_new(&self.row) {
                    let slider = mechanism.slider(*joint).expect("sliding joints slide");
                    let (displacement, _) = self.configuration.sliding(mechanism, slider);
                    self.stuck.push(Stuck { joint: *joint, displacement });
                }
            }
        }
    }

    /// Takes over a state; cheap, and enough for whatever depends on positions and velocities alone.
    pub(super) fn place(&mut self, time: f64, state: &[f64]) {
        let bodies = self.mechanism.bodies.len();
        let (poses, rates) = state.split_at(3 * bodies);
        let configuration = &mut self.configuration;
        for (pose, values) in configuration.poses.iter_mut().zip(poses.chunks_exact(3)) {
            pose.position = Vector2::new(values[0], values[1]);
            pose.angle = values[2];
        }
        for (velocity, values) in configuration.velocities.iter_mut().zip(rates.chunks_exact(3)) {
            velocity.linear = Vector2::new(values[0], values[1]);
            velocity.angular = values[2];
        }
        configuration.time = time;
        configuration.measure(self.mechanism);
        for (k, contact) in self.contacts.iter_mut().enumerate() {
            *contact = configuration.contact(self.mechanism, ContactId(k));
        }
    }

    /// Solves the equations in a state.
    ///
    /// # Errors
    /// Loads without a value there, or a matrix that is singular.
    pub(super) fn evaluate(&mut self, time: f64, state: &[f64]) -> Result<(), Failure> {
        self.evaluations += 1;
        self.place(time, state);
        self.assemble()?;
        self.condition = self.system.factor();
        if self.condition > SINGULAR {
            return Err(Failure::Singular);
        }
        self.system.solve(&mut self.unknowns);
        if self.unknowns.iter().all(|value| value.is_finite()) { Ok(()) } else { Err(Failure::Singular) }
    }

    /// Writes the matrix, and the right-hand side in place of the unknowns.
    fn assemble(&mut self) -> Result<(), Failure> {
        self.applied.fill(self.mechanism, &self.configuration).map_err(Failure::Loads)?;
        self.system.clear();
        self.unknowns.fill(0.0);
        for (index, body) in self.mechanism.bodies.iter().enumerate() {
            for (axis, inertia) in [body.mass, body.mass, body.moment_of_inertia].into_iter().enumerate() {
                self.system.add(3 * index + axis, 3 * index + axis, inertia);
            }
        }
        for wrench in &self.applied.wrenches {
            add(&self.configuration, wrench, |row, value| self.unknowns[row] += value);
        }
        self.assemble_constraints();
        self.assemble_friction();
        self.assemble_drives()
    }

    /// G and -G^T, and the rows and columns of the sticking joints.
    fn assemble_constraints(&mut self) {
        self.rows.clear();
        self.row_ends.clear();
        let first = 3 * self.mechanism.bodies.len();
        for (index, reaction) in self.layout.reactions().iter().enumerate() {
            self.row.set_constraint(self.mechanism, &self.configuration, &self.contacts, *reaction);
            put_row(&mut self.system, &mut self.unknowns, &self.row, first + index);
            self.rows.extend_from_slice(&self.row.entries);
            self.row_ends.push(self.rows.len());
        }
        let first = self.layout.len();
        for (index, stuck) in self.stuck.iter().enumerate() {
            let kind = CoordinateKind::Slide(stuck.joint);
            self.row.set_coordinate(self.mechanism, &self.configuration, kind);
            put_row(&mut self.system, &mut self.unknowns, &self.row, first + index);
            self.rows.extend_from_slice(&self.row.entries);
            self.row_ends.push(self.rows.len());
        }
    }

    fn assemble_friction(&mut self) {
        for (k, rubbing) in self.rubbing.iter().enumerate() {
            let column = self.normal[k];
            let preload_face = |sigma: f64| match self.mechanism.contacts[k].preload_line {
                PreloadLine::Pressed => sigma,
                PreloadLine::Centre => 0.0,
            };
            let forces = |sigma: f64, friction: f64| {
                friction_forces(self.mechanism, ContactId(k), &self.contacts[k], sigma, friction)
            };
            match *rubbing {
                Rubbing::Sticking => {}
                Rubbing::Pressed { sigma, mu, preload, sign } => {
                    if mu != 0.0 {
                        for wrench in forces(sigma, mu * sigma * sign) {
                            add(&self.configuration, &wrench, |row, value| {
                                self.system.add(row, column, -value);
                            });
                        }
                    }
                    if preload != 0.0 {
                        for wrench in forces(preload_face(sigma), preload * sign) {
                            add(&self.configuration, &wrench, |row, value| self.unknowns[row] += value);
                        }
                    }
                }
                // d = share d^+ + (1 - share) d^-
                Rubbing::Gap { preload: [positive, negative], sign } => {
                    self.system.clear_column(column);
                    let at_negative = forces(preload_face(-1.0), negative * sign);
                    for wrench in &at_negative {
                        add(&self.configuration, wrench, |row, value| self.unknowns[row] += value);
                        add(&self.configuration, wrench, |row, value| self.system.add(row, column, value));
                    }
                    for wrench in &forces(preload_face(1.0), positive * sign) {
                        add(&self.configuration, wrench, |row, value| self.system.add(row, column, -value));
                    }
                }
            }
        }
    }

    fn assemble_drives(&mut self) -> Result<(), Failure> {
        for (index, drive) in self.mechanism.drives.iter().enumerate() {
            let effort = self.layout.effort(DriveId(index));
            let kind = self.mechanism.coordinates[drive.coordinate.index()].kind;
            self.row.set_coordinate(self.mechanism, &self.configuration, kind);
            for &(column, value) in &self.row.entries {
                self.system.add(effort, column, value);
            }
            for wrench in effort_forces(self.mechanism, &self.configuration, &drive.effort) {
                add(&self.configuration, &wrench, |row, value| self.system.add(row, effort, -value));
            }
            let Configuration { coordinates, rates, time, .. } = &self.configuration;
            let prescribed = self.mechanism.quantity(drive.acceleration, coordinates, rates, *time);
            self.unknowns[effort] =
                prescribed.map_err(|fault| Failure::Loads(fault.into()))? + self.row.right_hand_side;
        }
        Ok(())
    }

    /// Accelerations of the bodies at the last evaluation: (x, y, angle) of each.
    pub(super) fn accelerations(&self) -> &[f64] {
        &self.unknowns[..3 * self.mechanism.bodies.len()]
    }

    /// A reaction at the last evaluation; of contacts in a preload gap zero.
    pub(super) fn reaction(&self, reaction: Reaction) -> f64 {
        match reaction {
            Reaction::Normal(contact) => self.normal_force(contact.index()),
            _ => self.layout.reaction(reaction).map_or(0.0, |index| self.unknowns[index]),
        }
    }

    /// The normal force of a contact; for the ends of a block that sticks as if friction acted on the centre line.
    pub(super) fn normal_force(&self, k: usize) -> f64 {
        if matches!(self.rubbing[k], Rubbing::Gap { .. }) { 0.0 } else { self.unknowns[self.normal[k]] }
    }

    /// For a contact in a preload gap the share of the face of positive normal force.
    pub(super) fn share(&self, k: usize) -> Option<f64> {
        matches!(self.rubbing[k], Rubbing::Gap { .. }).then(|| self.unknowns[self.normal[k]])
    }

    /// Friction force of a contact whose joint slides, eq. (2).
    pub(super) fn friction_force(&self, k: usize) -> Option<f64> {
        let value = self.unknowns[self.normal[k]];
        match self.rubbing[k] {
            Rubbing::Pressed { sigma, mu, preload, sign } => Some((mu * sigma * value + preload) * sign),
            Rubbing::Gap { preload: [positive, negative], sign } => {
                Some((value * positive + (1.0 - value) * negative) * sign)
            }
            Rubbing::Sticking => None,
        }
    }

    /// Effort of a drive.
    pub(super) fn effort(&self, drive: DriveId) -> f64 {
        self.unknowns[self.layout.effort(drive)]
    }

    /// The tangential force on the block of a joint that sticks by a row of its own, counted among those (N).
    #[cfg(test)]
    pub(super) fn tangential_force(&self, index: usize) -> f64 {
        self.unknowns[self.layout.len() + index]
    }

    /// The determinant of the mode at the last evaluation.
    pub(super) fn determinant(&self) -> Determinant {
        self.system.determinant()
    }

    /// The greatest force among loads and normal forces (N), couples divided by the size of the mechanism.
    pub(super) fn greatest_force(&self) -> f64 {
        let size = self.mechanism.size;
        let loads = self.applied.wrenches.iter();
        let loads = loads.map(|wrench| wrench.force.amax().max(wrench.couple.abs() / size));
        let normal = (0..self.contacts.len()).map(|k| self.normal_force(k).abs());
        loads.chain(normal).fold(0.0, f64::max)
    }

    /// Brings a state back on the joints, with the factors of the last evaluation, which was there: the corrections
    /// are those that reactions of the phase would cause. Returns how far it was away.
    pub(super) fn project(&mut self, state: &mut [f64]) -> Drift {
        let bodies = 3 * self.mechanism.bodies.len();
        let mut drift = Drift::default();
        self.work.fill(0.0);
        for index in 0..self.row_ends.len() {
            let (gap, scale) = self.gap(index);
            drift.position = drift.position.max(gap.abs() / scale);
            let row = self.row_place(index);
            self.work[row] = -gap;
        }
        self.system.solve(&mut self.work);
        state[..bodies].iter_mut().zip(&self.work).for_each(|(value, correction)| *value += correction);
        self.work.fill(0.0);
        for index in 0..self.row_ends.len() {
            let from = if index == 0 { 0 } else { self.row_ends[index - 1] };
            let entries = &self.rows[from..self.row_ends[index]];
            let rate: f64 = entries.iter().map(|&(column, value)| value * state[bodies + column]).sum();
            drift.velocity = drift.velocity.max(rate.abs() / self.gap_scale(index));
            let row = self.row_place(index);
            self.work[row] = -rate;
        }
        self.system.solve(&mut self.work);
        state[bodies..2 * bodies].iter_mut().zip(&self.work).for_each(|(value, change)| *value += change);
        drift
    }

    fn row_place(&self, index: usize) -> usize {
        let reactions = self.layout.reactions().len();
        if index < reactions {
            3 * self.mechanism.bodies.len() + index
        } else {
            self.layout.len() + index - reactions
        }
    }

    fn gap_scale(&self, index: usize) -> f64 {
        let is_angle = matches!(self.layout.reactions().get(index), Some(Reaction::Couple(_)));
        if is_angle { 1.0 } else { self.mechanism.size }
    }

    /// By how much a scalar constraint is violated (m or rad), and the scale of that.
    fn gap(&self, index: usize) -> (f64, f64) {
        let (mechanism, configuration) = (self.mechanism, &self.configuration);
        let gap = match self.layout.reactions().get(index) {
            Some(Reaction::Hinge(joint, axis)) => match &mechanism.joints[joint.index()].kind {
                JointKind::Hinge(ends) => {
                    let [first, second] = ends.each_ref().map(|end| configuration.position(mechanism, end));
                    (first - second)[*axis]
                }
                JointKind::Slider(_) => 0.0,
            },
            Some(Reaction::Normal(contact)) => self.normal_gap(*contact),
            Some(Reaction::Couple(joint)) => mechanism
                .slider(*joint)
                .map_or(0.0, |slider| configuration.angle(slider.block) - configuration.angle(slider.guide)),
            None => {
                let stuck = &self.stuck[index - self.layout.reactions().len()];
                mechanism
                    .slider(stuck.joint)
                    .map_or(0.0, |slider| configuration.sliding(mechanism, slider).0 - stuck.displacement)
            }
        };
        (gap, self.gap_scale(index))
    }

    /// Distance of the block's line from that of the guide at a contact, along n.
    fn normal_gap(&self, contact: ContactId) -> f64 {
        let (mechanism, configuration) = (self.mechanism, &self.configuration);
        let joint = mechanism.contacts[contact.index()].joint;
        let Some(slider) = mechanism.slider(joint) else { return 0.0 };
        let geometry = &self.contacts[contact.index()];
        let middle = |frame: Frame| {
            let attachment = crate::mechanism::Attachment { frame, position: slider.at };
            configuration.position(mechanism, &attachment)
        };
        let block = middle(slider.block);
        let at_middle = geometry.normal.dot(&(block - middle(slider.guide)));
        if slider.contacts.len() < 2 {
            return at_middle;
        }
        let turn = configuration.angle(slider.block) - configuration.angle(slider.guide);
        at_middle + geometry.tangent.dot(&(geometry.point - block)) * turn
    }
}

impl Derivative for Equations<'_> {
    type Failure = Failure;

    fn derivative(&mut self, time: f64, state: &[f64], rate: &mut [f64]) -> Result<(), Failure> {
        self.evaluate(time, state)?;
        let bodies = 3 * self.mechanism.bodies.len();
        rate[..bodies].copy_from_slice(&state[bodies..2 * bodies]);
        rate[bodies..2 * bodies].copy_from_slice(self.accelerations());
        super::energy::powers(self, &mut rate[2 * bodies..]);
        Ok(())
    }
}

/// The sliding joints of a mechanism, in their order.
pub(super) fn sliding_joints(mechanism: &Mechanism) -> Vec<JointId> {
    let joints = (0..mechanism.joints.len()).map(JointId);
    joints.filter(|joint| mechanism.slider(*joint).is_some()).collect()
}

/// Adds a force or couple on a body to the three equations of that body.
fn add(configuration: &Configuration, wrench: &Wrench, mut add: impl FnMut(usize, f64)) {
    let Some(body) = wrench.frame.body() else { return };
    let row = 3 * body.index();
    let arm = configuration.arm(wrench.frame, wrench.place);
    add(row, wrench.force.x);
    add(row + 1, wrench.force.y);
    add(row + 2, rot90(arm).dot(&wrench.force) + wrench.couple);
}

/// A row of constraints, its force as a column, and its right-hand side.
fn put_row(system: &mut LinearSystem, right_hand_side: &mut [f64], row: &ConstraintRow, place: usize) {
    for &(column, value) in &row.entries {
        system.add(place, column, value);
        system.add(column, place, -value);
    }
    right_hand_side[place] = row.right_hand_side;
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|value| value * value).sum::<f64>().sqrt()
}
