//! The result of a simulation: the motion at any time, its events and phases, and how good it is.

use super::event::Event;
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::{ContactId, DriveId, JointId};
use crate::mechanism::Mechanism;
use crate::motion::moving::energy::{kinetic, potential};
use crate::motion::moving::equations::{Drift, Equations};
use crate::motion::moving::stepper::{DENSE, within};
use crate::pattern::phase::Phase;

/// A motion in time.
#[derive(Debug, Clone)]
pub struct History {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What happened, in its order.
    pub events: Vec<Event>,
    /// The phases, one after the other.
    pub phases: Vec<PhaseInterval>,
    /// Why it ends.
    pub end: End,
    /// How far the joints were violated before each projection: the greatest.
    pub drift: Drift,
    /// The greatest error of the energy balance at any step (J).
    pub energy_error: f64,
    /// The greatest of kinetic energy, work and dissipation (J), to compare that error with.
    pub energy_scale: f64,
    /// What it cost.
    pub statistics: Statistics,
    pub(in crate::motion) steps: Vec<Step>,
    /// The solution within each step.
    pub(in crate::motion) dense: Vec<f64>,
    /// Components of the state.
    pub(in crate::motion) size: usize,
    /// The directions of the forces of the hinges with friction at the end of each step, one after the other.
    pub(in crate::motion) directions: Vec<[f64; 2]>,
    pub(in crate::motion) impulses: Vec<ImpulseLoss>,
    /// Contacts whose normal forces were asked for while joints stuck, and are not determined then.
    pub(in crate::motion) undetermined: Vec<ContactId>,
    pub(in crate::motion) initial: Configuration,
    pub(in crate::motion) last: LastState,
}

/// Energy lost in impulses.
#[derive(Debug, Clone, Copy)]
pub(in crate::motion) struct ImpulseLoss {
    /// At this time (s) ...
    pub(in crate::motion) time: f64,
    /// ... and before it (J).
    pub(in crate::motion) energy: f64,
}

/// Where a motion ends.
#[derive(Debug, Clone)]
pub(in crate::motion) struct LastState {
    pub(in crate::motion) time: f64,
    pub(in crate::motion) state: Vec<f64>,
    /// Whether nothing moves, within rounding.
    pub(in crate::motion) is_still: bool,
}

/// A phase and when it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct PhaseInterval {
    /// The phase.
    pub phase: Phase,
    /// Its start (s).
    pub from: f64,
    /// Its end (s).
    pub to: f64,
}

/// A step of the solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::motion) struct Step {
    pub(in crate::motion) time: f64,
    pub(in crate::motion) length: f64,
    pub(in crate::motion) phase: usize,
}

/// What a simulation cost.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Steps that were accepted.
    pub steps: usize,
    /// Steps that were repeated with a shorter length.
    pub rejected: usize,
    /// Evaluations of the equations.
    pub evaluations: u64,
    /// For how long (s) joints stuck under loads that change with time without a proof that they could: that
    /// was looked at at four times in each step.
    pub sampled: f64,
    /// The longest of these steps (s).
    pub sampled_step: f64,
}

/// Why a simulation ends.
#[derive(Debug, Clone, PartialEq)]
pub enum End {
    /// The duration is over.
    Finished,
    /// A sliding joint has reached a limit of its travel.
    TravelLimit(JointId),
    /// A block has left its guide.
    OverlapVanished(JointId),
    /// A contact that was open reaches the line of its face beyond the ends of the face.
    BesideFace(ContactId),
    /// A contact lifts off in space, and its body leaves the plane of its motion.
    OutOfPlane(ContactId),
    /// A corner reaches a face where the model has no contact; the type of a joint that gives it one.
    BareCorner {
        /// The type.
        wanted: &'static str,
    },
    /// The normal force of a contact has reached the limit that was given.
    ReactionLimit(ContactId),
    /// A function of the user has passed zero; its number.
    UserEvent(usize),
    /// The branch that was wanted after an event does not exist; the number of the branching, counted from 1.
    NoSuchBranch {
        /// Counted from 1.
        branching: usize,
    },
    /// A guided slider tips: it has no state for what follows.
    Tips(JointId),
    /// At rest neither sticking nor sliding is possible.
    NoContinuation,
    /// Impulses do not bring it into a state from which it can go on.
    Jammed,
    /// Events come closer and closer together, or phases take no time.
    Accumulation,
    /// As many steps as were permitted.
    StepLimit,
    /// As many events as were permitted.
    EventLimit,
    /// A load, a drive or a function of the user has no value from here on.
    NoValue(Faults),
    /// What follows cannot be decided.
    Undecided(Faults),
    /// The progress function has ended it.
    Interrupted,
}

/// A motion at one time.
#[derive(Debug, Clone)]
pub struct Sample {
    /// Number of the phase.
    pub phase: usize,
    /// Positions, velocities, coordinates, time.
    pub configuration: Configuration,
    /// Accelerations (x, y, angle) of every body.
    pub accelerations: Vec<[f64; 3]>,
    /// The contacts.
    pub contacts: Vec<ContactSample>,
    /// The hinges with friction.
    pub hinges: Vec<HingeSample>,
    /// Effort of every drive (N or N m).
    pub efforts: Vec<f64>,
    /// Energies.
    pub energy: Energy,
}

/// A contact at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSample {
    /// N. While the joint sticks the two ends of a block share it as if friction acted on the centre line.
    pub normal_force: f64,
    /// N; nothing while the joint sticks: [`History::forces`] has it where statics determines it.
    pub friction_force: Option<f64>,
    /// m/s
    pub sliding_velocity: f64,
    /// In a preload gap the share of the face of positive normal force.
    pub share: Option<f64>,
}

/// A hinge with friction at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HingeSample {
    /// On its first body (N).
    pub force: [f64; 2],
    /// Whether the equations of the phase determine the force: not while sliding joints stick. A [series](History::series)
    /// contains it there, too, if statics determines it.
    pub is_determined: bool,
    /// The friction couple on its first body (N m); nothing where it sticks and statics does not determine it.
    pub couple: Option<f64>,
    /// Angular velocity of its first body against the second (rad/s).
    pub spin: f64,
}

/// Energies up to one time (J).
#[derive(Debug, Clone, PartialEq)]
pub struct Energy {
    /// Of motion.
    pub kinetic: f64,
    /// Of weights and springs.
    pub potential: f64,
    /// Dissipated by the friction of each contact.
    pub friction: Vec<f64>,
    /// Dissipated by the friction of each hinge that has some.
    pub hinges: Vec<f64>,
    /// Work of each load; zero for springs whose energy is potential, negative for dampers.
    pub loads: Vec<f64>,
    /// Work of each drive.
    pub drives: Vec<f64>,
    /// Lost in impulses.
    pub impulses: f64,
}

impl Energy {
    /// What stays constant: energy and dissipation less work.
    pub fn total(&self) -> f64 {
        let dissipated: f64 = self.friction.iter().chain(&self.hinges).sum::<f64>() + self.impulses;
        let work: f64 = self.loads.iter().chain(&self.drives).sum();
        self.kinetic + self.potential + dissipated - work
    }

    /// Energies at a state.
    pub(in crate::motion) fn of(
        mechanism: &Mechanism,
        configuration: &Configuration,
        state: &[f64],
        impulses: f64,
    ) -> Self {
        let works = &state[6 * mechanism.bodies.len()..];
        let (friction, others) = works.split_at(mechanism.contacts.len());
        let (loads, others) = others.split_at(mechanism.loads.len());
        let (drives, hinges) = others.split_at(mechanism.drives.len());
        Self {
            kinetic: kinetic(mechanism, configuration),
            potential: potential(mechanism, configuration),
            friction: friction.to_vec(),
            hinges: hinges.to_vec(),
            loads: loads.to_vec(),
            drives: drives.to_vec(),
            impulses,
        }
    }
}

impl History {
    /// When it begins (s).
    pub fn start(&self) -> f64 {
        self.initial.time
    }

    /// When it ends (s).
    pub fn stop(&self) -> f64 {
        self.last.time
    }

    /// The times of the solver's steps, the end included (s).
    pub fn times(&self) -> impl Iterator<Item = f64> + '_ {
        self.steps.iter().map(|step| step.time).chain([self.last.time])
    }

    /// Its state at the end, and the energies up to there. They follow from the state alone, so that no equations are
    /// solved.
    pub(in crate::motion) fn at_end(&self) -> (Configuration, Energy) {
        let LastState { time, state, .. } = &self.last;
        let mut equations = Equations::new(&self.mechanism, &self.initial);
        equations.place(*time, state);
        let energy = Energy::of(&self.mechanism, &equations.configuration, state, self.lost_until(*time));
        (equations.configuration, energy)
    }

    /// Energy lost in impulses up to a time (J).
    fn lost_until(&self, time: f64) -> f64 {
        self.impulses.iter().rfind(|loss| loss.time <= time).map_or(0.0, |loss| loss.energy)
    }

    /// The directions of the forces of the hinges with friction near a time in a phase: those at the end of its step, or
    /// those with which the phase begins if it has no step there.
    fn directions_at(&self, time: f64, phase: usize) -> Vec<[f64; 2]> {
        let hinges = self.mechanism.friction_circles.len();
        let step = self.steps.partition_point(|step| step.time <= time).saturating_sub(1);
        if self.steps.get(step).is_some_and(|step| step.phase == phase) {
            return self.directions[step * hinges..][..hinges].to_vec();
        }
        self.phases[phase].phase.hinges.iter().map(|hinge| hinge.force).collect()
    }

    /// A reader of the motion at any time; it is quickest when asked in order.
    pub fn reader(&self) -> Reader<'_> {
        Reader {
            history: self,
            equations: Equations::new(&self.mechanism, &self.initial),
            state: vec![0.0; self.size],
            entered: None,
        }
    }
}

/// Reads a history at any time.
pub struct Reader<'h> {
    history: &'h History,
    equations: Equations<'h>,
    state: Vec<f64>,
    entered: Option<usize>,
}

impl Reader<'_> {
    /// Positions and velocities at a time; nothing outside the history. At an event what follows it.
    pub fn configuration(&mut self, time: f64) -> Option<&Configuration> {
        self.locate(time)?;
        Some(&self.equations.configuration)
    }

    /// Everything at a time; nothing outside the history, or where its equations have no solution. At an event what
    /// follows it.
    pub fn at(&mut self, time: f64) -> Option<Sample> {
        let phase = self.locate(time)?;
        // Of several solutions those that were followed there, not those with which the phase began.
        self.equations.follow(self.history.directions_at(time, phase));
        if self.entered != Some(phase) {
            self.equations.enter(&self.history.phases[phase].phase, time, &self.state).ok()?;
            self.entered = Some(phase);
        }
        self.equations.evaluate(time, &self.state).ok()?;
        let equations = &self.equations;
        let contact = |k: usize| ContactSample {
            normal_force: equations.normal_force(k),
            friction_force: equations.friction_force(k),
            sliding_velocity: equations.contacts[k].sliding_velocity,
            share: equations.share(k),
        };
        let is_determined = equations.room_of_sticking(&self.history.phases[phase].phase).is_some();
        let hinge = |hinge: usize| HingeSample {
            is_determined,
            force: equations.hinge_force(hinge).unwrap_or_default(),
            couple: equations.hinge_couple(hinge),
            spin: equations.spin(hinge),
        };
        let impulses = self.history.lost_until(time);
        let accelerations = equations.accelerations().chunks_exact(3);
        Some(Sample {
            phase,
            accelerations: accelerations.map(|body| [body[0], body[1], body[2]]).collect(),
            contacts: (0..equations.contacts.len()).map(contact).collect(),
            hinges: (0..equations.mechanism.friction_circles.len()).map(hinge).collect(),
            efforts: (0..equations.mechanism.drives.len()).map(|d| equations.effort(DriveId(d))).collect(),
            energy: Energy::of(&self.history.mechanism, &equations.configuration, &self.state, impulses),
            configuration: equations.configuration.clone(),
        })
    }

    /// Places the equations at a time; returns the number of the phase.
    fn locate(&mut self, time: f64) -> Option<usize> {
        let history = self.history;
        let LastState { time: end, state: last, .. } = &history.last;
        let phase = if time == *end {
            self.state.copy_from_slice(last);
            history.phases.len().checked_sub(1)?
        } else {
            let index = history.steps.partition_point(|step| step.time <= time).checked_sub(1)?;
            let step = history.steps.get(index).filter(|_| time < *end)?;
            let first = index * DENSE * history.size;
            let dense = &history.dense[first..first + DENSE * history.size];
            within(dense, (time - step.time) / step.length, &mut self.state);
            step.phase
        };
        self.equations.place(time, &self.state);
        Some(phase)
    }
}
