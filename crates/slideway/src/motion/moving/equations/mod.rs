//! The equations of motion within a phase, without new memory at each evaluation.
//!
//! ```text
//! M a - G^T lambda - sum_k W_k^side mu_k s_k sigma_k N_k - B u - sum_j T_j t_j = f + sum_k W_k^side F_k0 s_k
//! G a                                                                          = gamma
//! C a                                                                          = prescribed
//! T_j^T a                                                                      = bias
//! ```
//!
//! Coulomb friction of a contact that is pressed against a known side is linear in its normal force (eq.
//! (2)), so it joins the column of that force: one matrix, not symmetric, is factored for all unknowns. In a
//! preload gap `N_k = 0`, and the share of the face of positive normal force takes the place of `N_k` among
//! the unknowns (theory, section 3). In that of a guided slider with height `C = 0`, too, and the share,
//! which acts like a couple, takes its place; that `N_k` is zero without it is watched. A joint that sticks
//! adds the row that its sliding acceleration is zero, and the tangential force `t_j` on its centre line,
//! block against guide. (At another line of the same joint it would shift normal force between the two ends
//! of the block, and nothing else.) Where a contact that may lift off is open, `N_k = 0` takes the place of its row.
//!
//! The couple of a hinge that turns with friction is `-r |R| sgn(omega)`, and the force `R` of the hinge is among the
//! unknowns (`hinges.rs`). One that sticks adds the row that its angular acceleration is zero, and its couple.

mod assembly;
mod hinges;
mod phase;
mod projection;
mod rest;
mod room;

use hinges::{RoughHinge, norm};
pub(in crate::motion) use rest::{bodies_of_drive, independent, joint_rests};

use crate::configuration::{Configuration, ContactGeometry, Pose};
use crate::fault::Faults;
use crate::ids::{BodyId, ContactId, DriveId, JointId};
use crate::kinetics::{Applied, ConstraintRow, Layout, Reaction, equilibration};
use crate::mechanism::{Mechanism, body_of};
use crate::modes::Side;
use crate::motion::moving::linear::{Determinant, LinearSystem};
use crate::motion::moving::stepper::Derivative;
use crate::motion::moving::switching::Switching;
use crate::pattern::phase::Phase;
pub(in crate::motion) use crate::pattern::phase::sliding_joints;
use nalgebra::{DMatrix, Vector2};

/// Ratio of pivots from which on the equations count as singular.
const SINGULAR: f64 = 1e14;

/// Why the equations have no solution in a state.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::motion) enum Failure {
    /// Loads or drives without a value.
    Loads(Faults),
    /// The matrix is singular.
    Singular,
    /// With friction in hinges: the solution that was followed has met another one, and both have come to their end.
    Fold,
}

/// What the friction of a contact is within a phase.
#[derive(Debug, Clone, Copy)]
enum Rubbing {
    /// At each face so many times |N|, and a constant.
    Pressed { side: Side, sign: f64, faces: [[f64; 2]; 2] },
    /// N = 0; at each face so many times the share, which stands in this column of the unknowns, and a
    /// constant.
    Gap { faces: [[f64; 2]; 2], share: usize },
    /// The joint sticks: its tangential force stands for all its contacts.
    Sticking,
    /// The contact is open: in the place of its row stands N = 0.
    Open,
}

/// What sticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sticks {
    /// A sliding joint.
    Slider(JointId),
    /// A hinge with friction, by its number among these.
    Hinge(usize),
}

/// A joint or hinge that sticks by an equation of its own.
#[derive(Debug, Clone, Copy)]
struct Stuck {
    what: Sticks,
    /// Where it sticks (m or rad).
    place: f64,
}

/// The greatest violation of the joints, before a projection.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drift {
    /// Of positions (in sizes of the mechanism, or rad).
    pub(crate) position: f64,
    /// Of velocities (in sizes of the mechanism, or rad, per s).
    pub(crate) velocity: f64,
}

impl Drift {
    /// The greater of both, each by itself.
    pub(in crate::motion) fn max(self, other: Self) -> Self {
        Self { position: self.position.max(other.position), velocity: self.velocity.max(other.velocity) }
    }
}

/// The equations of motion of a mechanism in a phase, at a state.
///
/// In space each body has three accelerations more, which are zero; they stand behind those in the plane.
///
/// The state is a vector: (x, y, angle) of every body, their rates, then the work done so far by every
/// contact, load, drive and hinge with friction.
pub(in crate::motion) struct Equations<'m> {
    pub(in crate::motion) mechanism: &'m Mechanism,
    layout: Layout,
    /// The joints that slide, in their order.
    pub(in crate::motion) sliders: Vec<JointId>,
    /// Where the normal force of each contact stands among the unknowns.
    normal: Vec<usize>,
    /// Whether the work of each load is counted as potential energy.
    pub(in crate::motion) conservative: Vec<bool>,
    rubbing: Vec<Rubbing>,
    /// The mechanism of a phase in which contacts that may lift off are open.
    touching: Option<Box<Mechanism>>,
    stuck: Vec<Stuck>,
    hinges: Vec<RoughHinge>,
    /// The sign of the determinant where the phase begins, if hinges turn with friction.
    orientation: Option<f64>,
    /// The state of the last evaluation.
    pub(in crate::motion) configuration: Configuration,
    pub(in crate::motion) contacts: Vec<ContactGeometry>,
    pub(in crate::motion) applied: Applied,
    /// The rows of all reactions and of the sticking joints, one after the other.
    rows: Vec<(usize, f64)>,
    row_ends: Vec<usize>,
    row: ConstraintRow,
    system: LinearSystem,
    /// Accelerations, reactions, efforts, tangential forces.
    unknowns: Vec<f64>,
    work: Vec<f64>,
    /// How often they were evaluated.
    pub(in crate::motion) evaluations: u64,
}

impl<'m> Equations<'m> {
    /// The equations of a mechanism, not yet in a phase.
    pub(in crate::motion) fn new(mechanism: &'m Mechanism, configuration: &Configuration) -> Self {
        let layout = Layout::of(mechanism);
        let contacts = (0..mechanism.contacts.len()).map(ContactId);
        let normal = contacts.clone().filter_map(|contact| layout.reaction(Reaction::Normal(contact)));
        Self {
            mechanism,
            sliders: sliding_joints(mechanism),
            normal: normal.collect(),
            conservative: mechanism
                .loads
                .iter()
                .map(crate::motion::moving::energy::is_conservative)
                .collect(),
            rubbing: vec![Rubbing::Sticking; mechanism.contacts.len()],
            touching: None,
            stuck: Vec::new(),
            hinges: hinges::rough_hinges(mechanism, &layout),
            orientation: None,
            configuration: configuration.clone(),
            contacts: contacts.map(|contact| configuration.contact(mechanism, contact)).collect(),
            applied: Applied::new(),
            rows: Vec::new(),
            row_ends: Vec::new(),
            row: ConstraintRow::empty(),
            system: LinearSystem::new(0),
            unknowns: Vec::new(),
            work: Vec::new(),
            evaluations: 0,
            layout,
        }
    }

    /// Components of the state.
    pub(in crate::motion) fn state_size(&self) -> usize {
        let powers = self.contacts.len()
            + self.mechanism.loads.len()
            + self.mechanism.drives.len()
            + self.hinges.len();
        6 * self.mechanism.bodies.len() + powers
    }

    /// The state vector of a configuration, without any work so far.
    pub(in crate::motion) fn state_of(&self, configuration: &Configuration) -> Vec<f64> {
        let poses = configuration.poses.iter().flat_map(|p| [p.position.x, p.position.y, p.angle()]);
        let rates = configuration.velocities.iter().flat_map(|v| [v.linear.x, v.linear.y, v.angular]);
        let mut state: Vec<f64> = poses.chain(rates).collect();
        state.resize(self.state_size(), 0.0);
        state
    }

    /// Enters a phase at a state: chooses the rows of sticking joints and the scales of the equations, and
    /// solves them there.
    ///
    /// # Errors
    /// Loads without a value there, or a matrix that is singular.
    pub(in crate::motion) fn enter(
        &mut self,
        phase: &Phase,
        time: f64,
        state: &[f64],
    ) -> Result<(), Failure> {
        self.place(time, state);
        let open = phase.open(self.mechanism);
        self.touching = (!open.is_empty()).then(|| Box::new(self.mechanism.touching(&open, |_| false)));
        self.choose_friction(phase);
        self.choose_stuck(phase);
        let size = self.layout.len() + self.stuck.len();
        self.system = LinearSystem::new(size);
        let inertias = self.mechanism.bodies.iter().flat_map(|body| [body.mass, body.moment_of_inertia]);
        // With a search the acceleration of what sticks is zero to the last bit, not only beside those of
        // forces that balance.
        let in_plane = self.mechanism.space.is_none();
        let is_uncoupled =
            in_plane && self.stuck.is_empty() && inertias.into_iter().all(|inertia| inertia > 0.0);
        if is_uncoupled {
            self.system.uncouple(3 * self.mechanism.bodies.len());
        }
        self.unknowns = vec![0.0; size];
        self.work = vec![0.0; size];
        self.orientation = None;
        self.assemble()?;
        if is_uncoupled {
            self.system.set_scales_of_uncoupled();
        } else {
            let matrix = DMatrix::from_fn(size, size, |row, column| self.system.entry(row, column));
            let (rows, columns) = equilibration(&matrix);
            self.system.set_scales(rows.as_slice(), columns.as_slice());
        }
        self.solve()?;
        self.orientation = self.turns().then(|| self.system.determinant().sign());
        Ok(())
    }

    /// Takes over a state; cheap, and enough for whatever depends on positions and velocities alone.
    pub(in crate::motion) fn place(&mut self, time: f64, state: &[f64]) {
        let bodies = self.mechanism.bodies.len();
        let (poses, rates) = state.split_at(3 * bodies);
        let configuration = &mut self.configuration;
        for (pose, values) in configuration.poses.iter_mut().zip(poses.chunks_exact(3)) {
            *pose = Pose::new(Vector2::new(values[0], values[1]), values[2]);
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

    /// Holds the relations of loads and drives on the pieces on which they are.
    pub(in crate::motion) fn hold(&mut self, switching: &Switching<'_>) {
        self.configuration.pieces = switching.pieces();
    }

    /// Solves the equations in a state.
    ///
    /// # Errors
    /// Loads without a value there, a matrix that is singular, or no solution that continues the one before.
    pub(in crate::motion) fn evaluate(&mut self, time: f64, state: &[f64]) -> Result<(), Failure> {
        self.place(time, state);
        self.assemble()?;
        self.solve()
    }

    /// Solves the equations that have been assembled.
    fn solve(&mut self) -> Result<(), Failure> {
        self.evaluations += 1;
        self.solve_once()?;
        self.turn_friction()
    }

    /// Solves them with the directions in which hinge forces have been taken to act.
    fn solve_once(&mut self) -> Result<(), Failure> {
        if self.system.factor() > SINGULAR {
            return Err(Failure::Singular);
        }
        self.system.solve(&mut self.unknowns);
        if self.unknowns.iter().all(|value| value.is_finite()) { Ok(()) } else { Err(Failure::Singular) }
    }

    /// The rates of the components of a state at which the equations have just been solved.
    pub(in crate::motion) fn write_rates(&self, state: &[f64], rates: &mut [f64]) {
        let bodies = 3 * self.mechanism.bodies.len();
        rates[..bodies].copy_from_slice(&state[bodies..2 * bodies]);
        rates[bodies..2 * bodies].copy_from_slice(self.accelerations());
        crate::motion::moving::energy::powers(self, &mut rates[2 * bodies..]);
    }

    /// Accelerations of the bodies at the last evaluation: (x, y, angle) of each.
    pub(in crate::motion) fn accelerations(&self) -> &[f64] {
        &self.unknowns[..3 * self.mechanism.bodies.len()]
    }

    /// A reaction at the last evaluation; of contacts in a preload gap zero.
    pub(in crate::motion) fn reaction(&self, reaction: Reaction) -> f64 {
        match reaction {
            Reaction::Normal(contact) => self.normal_force(contact.index()),
            Reaction::Couple(joint) if self.is_between_faces(joint) => 0.0,
            _ => self.layout.reaction(reaction).map_or(0.0, |index| self.unknowns[index]),
        }
    }

    /// The normal force of a contact; for the ends of a block that sticks as if friction acted on the centre
    /// line. In the preload gap of a guided slider it is what would have to be zero.
    pub(in crate::motion) fn normal_force(&self, k: usize) -> f64 {
        let normal = self.normal[k];
        let is_taken = matches!(self.rubbing[k], Rubbing::Gap { share, .. } if share == normal);
        if is_taken { 0.0 } else { self.unknowns[normal] }
    }

    /// Returns whether a contact that may lift off is open.
    pub(in crate::motion) fn is_open(&self, k: usize) -> bool {
        matches!(self.rubbing[k], Rubbing::Open)
    }

    /// The mechanism as it touches in the phase.
    fn touching(&self) -> &Mechanism {
        self.touching.as_deref().unwrap_or(self.mechanism)
    }

    /// The sliding velocity of a sliding joint by its number among these (m/s): of what may lift off that of the contact
    /// with the least gap.
    pub(in crate::motion) fn sliding_velocity(&self, index: usize) -> f64 {
        let slider = self.mechanism.slider(self.sliders[index]).expect("sliding joints slide");
        let gap = |contact: &&ContactId| self.configuration.gap(self.mechanism, **contact)[0];
        let nearest = || slider.contacts.iter().min_by(|one, other| gap(one).total_cmp(&gap(other)));
        let lifts = slider.contacts.len() > 1 && self.mechanism.may_lift_off(slider);
        let contact = if lifts { nearest() } else { slider.contacts.first() };
        contact.map_or(0.0, |contact| self.contacts[contact.index()].sliding_velocity)
    }

    /// How far a sliding joint is from its least (-1) or greatest (1) displacement (m); what may lift off with the first of
    /// its contacts that touch.
    pub(in crate::motion) fn room_to_slide(&self, joint: JointId, end: f64) -> f64 {
        let (mechanism, configuration) = (self.mechanism, &self.configuration);
        let Some(slider) = mechanism.slider(joint) else { return f64::INFINITY };
        let room = |displacement: f64, [least, greatest]: [f64; 2]| {
            if end < 0.0 { displacement - least } else { greatest - displacement }
        };
        if !mechanism.may_lift_off(slider) {
            return room(configuration.sliding(mechanism, slider).0, slider.limits());
        }
        let closed = slider.contacts.iter().filter(|contact| !self.is_open(contact.index()));
        let room = |contact: &ContactId| {
            configuration.room_on_face(mechanism, slider, &mechanism.contacts[contact.index()], end)
        };
        closed.map(room).fold(f64::INFINITY, f64::min)
    }

    /// For a contact in a preload gap the share of the face of positive normal force.
    pub(in crate::motion) fn share(&self, k: usize) -> Option<f64> {
        match self.rubbing[k] {
            Rubbing::Gap { share, .. } => Some(self.unknowns[share]),
            _ => None,
        }
    }

    /// Whether the share of a guided slider that is between its faces stands in place of its couple.
    fn is_between_faces(&self, joint: JointId) -> bool {
        let couple = self.layout.reaction(Reaction::Couple(joint));
        self.rubbing.iter().any(|law| matches!(law, Rubbing::Gap { share, .. } if Some(*share) == couple))
    }

    /// Friction force of a contact whose joint slides, eq. (2).
    pub(in crate::motion) fn friction_force(&self, k: usize) -> Option<f64> {
        let (value, faces) = match self.rubbing[k] {
            Rubbing::Pressed { side, faces, .. } => (side.sign() * self.normal_force(k), faces),
            Rubbing::Gap { faces, share } => (self.unknowns[share], faces),
            Rubbing::Sticking => return None,
            Rubbing::Open => return Some(0.0),
        };
        Some(faces.iter().map(|[factor, constant]| factor * value + constant).sum())
    }

    /// Effort of a drive.
    pub(in crate::motion) fn effort(&self, drive: DriveId) -> f64 {
        self.unknowns[self.layout.effort(drive)]
    }

    /// The tangential force on the block of a joint that sticks by a row of its own, counted among those (N).
    #[cfg(test)]
    pub(in crate::motion) fn tangential_force(&self, index: usize) -> f64 {
        self.unknowns[self.layout.len() + index]
    }

    /// The determinant of the mode at the last evaluation.
    pub(in crate::motion) fn determinant(&self) -> Determinant {
        self.system.determinant()
    }

    /// The greatest force at the last evaluation (N).
    #[cfg(test)]
    pub(in crate::motion) fn greatest_force(&self) -> f64 {
        let mut greatest = 0.0_f64;
        self.each_force(|_, force| greatest = greatest.max(force));
        greatest
    }

    /// Tells loads, normal forces and forces of hinges with friction at the last evaluation (N), each with a body on which it
    /// acts; couples are divided by the size of the mechanism.
    pub(in crate::motion) fn each_force(&self, mut tell: impl FnMut(BodyId, f64)) {
        let size = self.mechanism.size;
        for wrench in &self.applied.wrenches {
            let force = wrench.force.amax().max(wrench.couple.abs() / size);
            wrench.frame.body().into_iter().for_each(|body| tell(body, force));
        }
        let normal = self.mechanism.contacts.iter().enumerate();
        let normal = normal.map(|(k, contact)| (contact.joint, self.normal_force(k).abs()));
        let hinges = self.hinges.iter().enumerate();
        let hinges = hinges.map(|(index, hinge)| (hinge.joint, self.hinge_force(index).map_or(0.0, norm)));
        for (joint, force) in normal.chain(hinges) {
            body_of(self.mechanism, joint).into_iter().for_each(|body| tell(body, force));
        }
    }
}

impl Derivative for Equations<'_> {
    type Failure = Failure;

    fn derivative(&mut self, time: f64, state: &[f64], rate: &mut [f64]) -> Result<(), Failure> {
        self.evaluate(time, state)?;
        self.write_rates(state, rate);
        Ok(())
    }
}
