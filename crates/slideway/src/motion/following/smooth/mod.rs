//! The motion within a phase, until it ends: what it knows, and one step after another.
//!
//! # Files
//! `steps.rs` tries steps and ends them where something happens, `events.rs` finds where that is,
//! `settling.rs` puts the state where an event says it is, `reactions.rs` has the limit of normal forces.

mod events;
mod reactions;
mod settling;
mod steps;

use self::events::StepSolution;
use self::steps::Zero;
use crate::fault::Faults;
use crate::ids::{ContactId, JointId};
use crate::motion::decision::rules::{Decisions, Hold, Resting};
use crate::motion::decision::{Outlook, scale_of_forces};
use crate::motion::moving::cause::Cause;
use crate::motion::moving::equations::{Equations, Failure, joint_rests};
use crate::motion::moving::magnitudes::{Magnitudes, in_metres};
use crate::motion::moving::resolution::Resolution;
use crate::motion::moving::stepper::{DENSE, StepControl, Stepper};
use crate::motion::moving::switching::{Switch, Switching};
use crate::motion::moving::watch::{Watch, Watched};
use crate::motion::options::SimulateOptions;
use crate::motion::record::history::{End, History};
use crate::pattern::phase::{JointPhase, Phase};
use std::collections::BTreeSet;

/// Bodies, joints and hinges that are slower than this part of the greatest velocity stand still.
const REST: f64 = 1e-10;
/// Energies below this part of the greatest force times the size of the mechanism do not count.
const LITTLE_ENERGY: f64 = 1e-2;

/// Where a mode locks forces have grown by more than this since its beginning; at a fold they stay finite.
const LOCKING: f64 = 1e4;

/// What is known of the time ahead as long as nobody has looked.
const NOTHING_KNOWN: Outlook = Outlook { proven: f64::NEG_INFINITY, slips: false };

/// Why a phase is over.
pub(in crate::motion) enum Ended {
    /// Something happened.
    Event(Vec<Cause>),
    /// The simulation ends.
    End(End),
}

/// A motion within a phase.
pub(in crate::motion) struct Smooth<'o, 'm> {
    pub(in crate::motion) equations: Equations<'m>,
    pub(in crate::motion) time: f64,
    pub(in crate::motion) state: Vec<f64>,
    end: f64,
    longest: f64,
    tolerance: f64,
    stepper: Stepper,
    control: StepControl,
    /// The length that is tried next (s).
    next: f64,
    scale: Vec<f64>,
    energy: f64,
    watch: Watch<'o>,
    switching: Switching<'m>,
    resolution: Resolution<'m>,
    options: &'o SimulateOptions,
    /// Values of the watched functions at the start of the step, inside, and at its end.
    values: [Vec<f64>; 4],
    inside: Vec<f64>,
    /// What knows when sticking ends where bodies stand still, ...
    hold: Option<Box<dyn Hold + 'm>>,
    /// ... whether that are all joints that stick, ...
    holds_all: bool,
    /// ... and what it knows.
    outlook: Outlook,
    /// No step goes beyond this time.
    stop: f64,
    /// Contacts whose normal forces were beyond what statics determines when they were asked for.
    pub(in crate::motion) undetermined: BTreeSet<ContactId>,
}

impl<'o, 'm> Smooth<'o, 'm> {
    /// A motion at its start, not yet in a phase.
    pub(in crate::motion) fn new(
        equations: Equations<'m>,
        state: Vec<f64>,
        time: f64,
        options: &'o SimulateOptions,
    ) -> Self {
        let size = state.len();
        let (mechanism, configuration) = (equations.mechanism, &equations.configuration);
        let magnitudes =
            Magnitudes::new(mechanism, |counts| scale_of_forces(mechanism, configuration, counts));
        let mut smooth = Self {
            time,
            end: time + options.duration,
            longest: options.longest_step.unwrap_or(options.duration / 1000.0).min(options.duration),
            tolerance: options.tolerance,
            stepper: Stepper::new(size),
            control: StepControl::new(),
            next: 0.0,
            scale: vec![0.0; size],
            energy: 0.0,
            watch: Watch::new(&options.events, mechanism.bare_corners(), options.reaction_limit, magnitudes),
            switching: Switching::new(equations.mechanism, &equations.configuration),
            resolution: Resolution::new(equations.mechanism),
            options,
            values: Default::default(),
            inside: vec![0.0; size],
            hold: None,
            holds_all: false,
            outlook: NOTHING_KNOWN,
            stop: time,
            undetermined: BTreeSet::new(),
            state,
            equations,
        };
        smooth.equations.hold(&smooth.switching);
        smooth.notice_velocity();
        smooth
    }

    /// Whether the duration is over.
    pub(in crate::motion) fn is_over(&self) -> bool {
        self.time >= self.end
    }

    /// Of each sliding joint (m/s), then of each hinge with friction (rad/s), the velocity below which it stands still.
    pub(in crate::motion) fn little_velocities(&self) -> Vec<f64> {
        let Equations { mechanism, sliders, .. } = &self.equations;
        let little = |joint| REST * self.watch.magnitudes.of_joint(mechanism, joint).velocity;
        let hinges = mechanism.friction_circles.iter().map(|circle| little(circle.joint) / mechanism.size);
        sliders.iter().map(|joint| little(*joint)).chain(hinges).collect()
    }

    /// Returns whether no body moves faster than what counts as rest beside the velocities so far, and those that forces could
    /// give.
    pub(in crate::motion) fn is_still(&self) -> bool {
        let Equations { mechanism, .. } = &self.equations;
        let bodies = mechanism.bodies.len();
        let mut rates = self.state[3 * bodies..6 * bodies].chunks_exact(3).enumerate();
        rates.all(|(body, rate)| {
            in_metres(rate, mechanism.size) <= REST * self.watch.magnitudes.of_body(body).velocity
        })
    }

    /// Forces below this are rounding beside the greatest so far, on each body (N).
    pub(in crate::motion) fn rounding(&self) -> Vec<f64> {
        self.watch.rounding()
    }

    /// The time in which the greatest velocity so far goes through the mechanism (s).
    pub(in crate::motion) fn time_scale(&self) -> f64 {
        self.equations.mechanism.size / self.watch.magnitudes.greatest().velocity
    }

    /// Enters a phase.
    ///
    /// # Errors
    /// Equations that cannot be solved.
    pub(in crate::motion) fn enter(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
    ) -> Result<(), Failure> {
        self.equations.enter(phase, self.time, &self.state)?;
        self.watch.begin(phase, &self.equations, &self.switching);
        self.equations.write_rates(&self.state, self.stepper.start());
        self.watch.magnitudes.begin(&self.equations);
        self.hold = None;
        self.outlook = NOTHING_KNOWN;
        let magnitudes = &self.watch.magnitudes;
        let rests = self.equations.resting(|body| REST * magnitudes.of_body(body).velocity);
        if rests.contains(&true) {
            let Equations { mechanism, configuration, sliders, .. } = &self.equations;
            self.hold = decisions
                .hold(mechanism, configuration, Resting { phase, bodies: &rests })
                .map_err(Failure::Loads)?;
            let hinges: Vec<JointId> = self.equations.hinge_joints().collect();
            let states = sliders.iter().chain(&hinges).zip(phase.joints_and_hinges());
            let mut sticking = states.filter(|(_, state)| *state == JointPhase::Sticking);
            self.holds_all =
                self.hold.is_some() && sticking.all(|(joint, _)| joint_rests(mechanism, *joint, &rests));
        }
        self.watch_all(phase, decisions, 0)?;
        if self.next == 0.0 {
            self.next = self.first_step();
        }
        Ok(())
    }

    /// A step within which neither positions nor velocities change much.
    fn first_step(&mut self) -> f64 {
        let shortest = self.watch.magnitudes.notice_accelerations(self.equations.accelerations());
        0.02 * shortest.min(self.longest)
    }

    fn notice_velocity(&mut self) {
        self.watch.magnitudes.notice_velocities(&self.state);
        let bodies = 3 * self.equations.mechanism.bodies.len();
        let works = self.state[2 * bodies..].iter();
        self.energy = works.fold(self.energy, |energy, work| energy.max(work.abs()));
    }

    /// The errors of the components that are permitted in a step.
    fn set_scale(&mut self) {
        let size = self.equations.mechanism.size;
        let bodies = 3 * self.equations.mechanism.bodies.len();
        let magnitudes = &self.watch.magnitudes;
        let velocity = |body| magnitudes.of_body(body).velocity.max(f64::MIN_POSITIVE / self.tolerance);
        let energy = self.energy.max(LITTLE_ENERGY * magnitudes.greatest().force * size);
        let energy = energy.max(f64::MIN_POSITIVE / self.tolerance);
        for (index, scale) in self.scale.iter_mut().enumerate() {
            let greatest = match index {
                _ if index >= 2 * bodies => energy,
                _ if index >= bodies && index % 3 == 2 => velocity((index - bodies) / 3) / size,
                _ if index >= bodies => velocity((index - bodies) / 3),
                _ if index % 3 == 2 => 1.0,
                _ => size,
            };
            *scale = self.tolerance * greatest;
        }
    }

    /// One step, shorter if something happens; returns what.
    pub(in crate::motion) fn step(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        history: &mut History,
    ) -> Option<Ended> {
        self.followed_step(phase, decisions, history).unwrap_or_else(|failure| Some(self.ended(failure)))
    }

    /// Where loads have no value the simulation ends; where the equations have no solution the mode does.
    fn ended(&self, failure: Failure) -> Ended {
        match failure {
            Failure::Loads(faults) => Ended::End(End::NoValue(faults)),
            Failure::Singular | Failure::Fold => Ended::Event(vec![self.end_of_mode()]),
        }
    }

    /// How a mode has ended whose determinant vanishes: with forces beyond all bounds, or at a fold.
    fn end_of_mode(&self) -> Cause {
        let grows = self.watch.magnitudes.has_grown(LOCKING);
        if self.equations.turns() && !grows { Cause::Folds } else { Cause::Locks }
    }

    fn followed_step(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        history: &mut History,
    ) -> Result<Option<Ended>, Failure> {
        self.set_scale();
        let due = self.due();
        if !due.is_empty() {
            return Ok(Some(self.switch(&due, Vec::new())));
        }
        if self.look_ahead().map_err(Failure::Loads)? {
            return Ok(Some(Ended::Event(vec![Cause::Slips])));
        }
        let (step, error) = self.accepted_step(phase, decisions, history)?;
        let first = history.dense.len() - DENSE * self.state.len();
        let solution = StepSolution { dense: &history.dense[first..], length: step };
        let event = self.first_event(phase, decisions, solution);
        if event.is_err() {
            // The step that has been described is not taken.
            history.dense.truncate(first);
        }
        let Some((fraction, watched)) = event? else {
            self.next = step * self.control.accepted(error);
            self.advance(step);
            self.values.swap(0, 3);
            return Ok(None);
        };
        let dense = history.dense.split_off(first);
        self.next = step;
        let mut causes = self.causes(&watched);
        let solution = StepSolution { dense: &dense, length: step };
        let zero = Zero { fraction, watched: watched[0] };
        let length = self.stop_at(phase, decisions, solution, zero, history)?;
        if length > 0.0 && self.still_slides(phase, &causes) {
            return self.go_on(length, phase, decisions).map(|()| None);
        }
        if length > 0.0 && self.jumps_through_zero(&watched, phase) {
            causes = vec![self.end_of_mode()];
        }
        causes.extend(self.held_causes(&watched, phase, decisions)?);
        let mut switches = self.due();
        switches.extend(watched.iter().filter_map(|watched| match watched {
            Watched::Relation(switch) => Some(*switch),
            _ => None,
        }));
        Ok(Some(self.switch(&switches, causes)))
    }

    /// What the watched functions that have passed zero are the causes of.
    fn causes(&self, watched: &[Watched]) -> Vec<Cause> {
        let name = |index: usize| self.options.events[index].name.clone();
        let hinges: Vec<JointId> = self.equations.hinge_joints().collect();
        let one = |watched: &Watched| match watched {
            Watched::Determinant => Some(self.end_of_mode()),
            Watched::BareCorner(index) => self.watch.bare_corner(*index, &self.equations),
            _ => Cause::of(*watched, [&self.equations.sliders, &hinges], name),
        };
        watched.iter().filter_map(one).collect()
    }

    /// Puts relations on their next pieces; the loads and drives that jump there, and pads, are causes of the
    /// event.
    fn switch(&mut self, switches: &[Switch], mut causes: Vec<Cause>) -> Ended {
        causes.extend(self.switching.switch(self.time, switches));
        self.equations.hold(&self.switching);
        Ended::Event(causes)
    }

    /// The relations that leave their pieces now, at a time that was known.
    fn due(&mut self) -> Vec<Switch> {
        let horizon = self.horizon();
        let is_now = self.switching.next(self.time, horizon) - self.time <= self.least_step();
        if is_now { self.switching.due() } else { Vec::new() }
    }

    /// The end, or the next time at which a load or drive jumps or has a kink, if that is known in advance.
    fn known_time(&mut self) -> f64 {
        let horizon = self.horizon();
        self.end.min(self.switching.next(self.time, horizon))
    }

    /// Chooses the time beyond which the next step does not go; whether something slips now that has stood
    /// still.
    fn look_ahead(&mut self) -> Result<bool, Faults> {
        let known = self.known_time();
        let until = known.min(self.horizon());
        self.stop = known;
        let Some(hold) = &mut self.hold else { return Ok(false) };
        if !self.outlook.slips && self.outlook.proven < until {
            self.outlook = hold.outlook([self.time.max(self.outlook.proven), until])?;
        }
        let is_now = self.outlook.proven - self.time <= self.least_step();
        if !is_now {
            self.stop = known.min(self.outlook.proven);
        }
        Ok(is_now && self.outlook.slips)
    }

    /// No step goes beyond it.
    fn horizon(&self) -> f64 {
        self.end.min(self.time + 2.0 * self.longest)
    }

    /// The shortest step that changes the time.
    fn least_step(&self) -> f64 {
        4.0 * f64::EPSILON * self.time.abs().max(self.end.abs())
    }
}
