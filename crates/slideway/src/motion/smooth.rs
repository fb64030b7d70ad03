//! The motion within a phase: steps, projections, and where the phase ends.

mod reactions;

use super::decision::{Outlook, scale_of_forces};
use super::equations::{Drift, Equations, Failure, joint_rests};
use super::event::Cause;
use super::history::{End, History};
use super::options::SimulateOptions;
use super::phase::{JointPhase, Phase};
use super::resolution::Resolution;
use super::root::{dip, falling_root};
use super::rules::{Decisions, Hold};
use super::stepper::{DENSE, SAMPLES, StepControl, Stepper, within};
use super::switching::{Switch, Switching};
use super::watch::{Needs, Watch, Watched};
use crate::configuration::Velocity;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, JointId};
use std::collections::BTreeSet;

/// Where the equations have no solution at a sample within a step, it is this part of the way nearer to the one before.
const BESIDE: f64 = 0.1;
/// Part of a step within which zeros count as one event.
const SAME_INSTANT: f64 = 1e-9;
/// A sliding velocity counts as zero below this part of its greatest value in the step, or below the errors of steps.
const STOPPED: f64 = 0.01;
/// Accuracy of a zero, as part of a step.
const ROOT_TOLERANCE: f64 = 1e-13;
/// Part of the way to a zero over which the slope there is taken: the square root of what numbers resolve.
const SLOPE: f64 = 1e-8;
/// A function of the user that is below this multiple of its next value has just passed zero.
const USER_ZERO: f64 = 1e-9;
/// Velocities below this part of what the greatest force gives the mechanism on its own size do not count.
const LITTLE_VELOCITY: f64 = 1e-2;
/// Velocities are set to zero where that changes none by more than this multiple of the tolerance, ...
const SETTLED: f64 = 100.0;
/// ... which counts as at least this.
const LEAST_TOLERANCE: f64 = 1e-10;
/// Bodies that are slower than this part of the greatest velocity stand still.
const REST: f64 = 1e-10;
/// Energies below this part of the greatest force times the size of the mechanism do not count.
const LITTLE_ENERGY: f64 = 1e-2;

/// What is known of the time ahead as long as nobody has looked.
const NOTHING_KNOWN: Outlook = Outlook { proven: f64::NEG_INFINITY, slips: false };

/// Why a phase is over.
pub(super) enum Ended {
    /// Something happened.
    Event(Vec<Cause>),
    /// The simulation ends.
    End(End),
}

/// A motion within a phase.
pub(super) struct Smooth<'o, 'm> {
    pub(super) equations: Equations<'m>,
    pub(super) time: f64,
    pub(super) state: Vec<f64>,
    end: f64,
    longest: f64,
    tolerance: f64,
    stepper: Stepper,
    control: StepControl,
    /// The length that is tried next (s).
    next: f64,
    scale: Vec<f64>,
    energy: f64,
    /// Of all bodies (kg).
    mass: f64,
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
    pub(super) undetermined: BTreeSet<ContactId>,
}

impl<'o, 'm> Smooth<'o, 'm> {
    /// A motion at its start, not yet in a phase.
    pub(super) fn new(
        equations: Equations<'m>,
        state: Vec<f64>,
        time: f64,
        options: &'o SimulateOptions,
    ) -> Self {
        let size = state.len();
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
            mass: equations.mechanism.bodies.iter().map(|body| body.mass).sum(),
            watch: Watch::new(&options.events, options.reaction_limit),
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
        smooth.watch.magnitudes.force =
            scale_of_forces(smooth.equations.mechanism, &smooth.equations.configuration);
        smooth.notice_velocity();
        smooth
    }

    /// Whether the duration is over.
    pub(super) fn is_over(&self) -> bool {
        self.time >= self.end
    }

    /// The greatest velocity so far (m/s), rotations times the size of the mechanism.
    pub(super) fn greatest_velocity(&self) -> f64 {
        self.watch.magnitudes.velocity
    }

    /// Forces below this are rounding beside the greatest so far (N).
    pub(super) fn rounding(&self) -> f64 {
        self.watch.rounding()
    }

    /// The time in which the greatest velocity so far goes through the mechanism (s).
    pub(super) fn time_scale(&self) -> f64 {
        self.equations.mechanism.size / self.greatest_velocity()
    }

    /// Enters a phase.
    ///
    /// # Errors
    /// Equations that cannot be solved.
    pub(super) fn enter(&mut self, phase: &Phase, decisions: &mut dyn Decisions) -> Result<(), Failure> {
        self.equations.enter(phase, self.time, &self.state)?;
        self.watch.begin(phase, &self.equations, &self.switching);
        self.equations.write_rates(&self.state, self.stepper.start());
        self.notice_force();
        self.hold = None;
        self.outlook = NOTHING_KNOWN;
        let rests = self.equations.resting(REST * self.greatest_velocity());
        if rests.contains(&true) {
            let Equations { mechanism, configuration, sliders, .. } = &self.equations;
            self.hold = decisions.hold(mechanism, configuration, (phase, &rests)).map_err(Failure::Loads)?;
            let sticking =
                sliders.iter().zip(&phase.joints).filter(|(_, state)| **state == JointPhase::Sticking);
            self.holds_all = sticking.into_iter().all(|(joint, _)| joint_rests(mechanism, *joint, &rests));
        }
        let mut values = std::mem::take(&mut self.values);
        self.watch_all(phase, decisions, &mut values[0])?;
        self.values = values;
        if self.next == 0.0 {
            self.next = self.first_step();
        }
        Ok(())
    }

    /// A step within which neither positions nor velocities change much.
    fn first_step(&mut self) -> f64 {
        let size = self.equations.mechanism.size;
        let acceleration = self.equations.accelerations().chunks_exact(3);
        let greatest = acceleration
            .fold(0.0, |a: f64, body| a.max(body[0].abs()).max(body[1].abs()).max(body[2].abs() * size));
        let velocity = self.watch.magnitudes.velocity.max((greatest * size).sqrt());
        self.watch.magnitudes.velocity = velocity;
        let times = [size / velocity, velocity / greatest];
        0.02 * times.into_iter().filter(|time| *time > 0.0).fold(self.longest, f64::min)
    }

    fn notice_velocity(&mut self) {
        let size = self.equations.mechanism.size;
        let bodies = 3 * self.equations.mechanism.bodies.len();
        let rates = self.state[bodies..2 * bodies].chunks_exact(3);
        let greatest =
            rates.fold(0.0, |v: f64, body| v.max(body[0].abs()).max(body[1].abs()).max(body[2].abs() * size));
        self.watch.magnitudes.velocity = self.watch.magnitudes.velocity.max(greatest);
        let works = self.state[2 * bodies..].iter();
        self.energy = works.fold(self.energy, |energy, work| energy.max(work.abs()));
    }

    /// Takes note of the greatest force, and of a velocity that it could cause: at rest there is no other scale.
    fn notice_force(&mut self) {
        let magnitudes = &mut self.watch.magnitudes;
        magnitudes.force = magnitudes.force.max(self.equations.greatest_force());
        if self.mass > 0.0 {
            let velocity = (magnitudes.force * self.equations.mechanism.size / self.mass).sqrt();
            magnitudes.velocity = magnitudes.velocity.max(LITTLE_VELOCITY * velocity);
        }
    }

    /// The errors of the components that are permitted in a step.
    fn set_scale(&mut self) {
        let size = self.equations.mechanism.size;
        let bodies = 3 * self.equations.mechanism.bodies.len();
        let velocity = self.watch.magnitudes.velocity.max(f64::MIN_POSITIVE / self.tolerance);
        let energy = self.energy.max(LITTLE_ENERGY * self.watch.magnitudes.force * size);
        let energy = energy.max(f64::MIN_POSITIVE / self.tolerance);
        for (index, scale) in self.scale.iter_mut().enumerate() {
            let greatest = match index {
                _ if index >= 2 * bodies => energy,
                _ if index >= bodies && index % 3 == 2 => velocity / size,
                _ if index >= bodies => velocity,
                _ if index % 3 == 2 => 1.0,
                _ => size,
            };
            *scale = self.tolerance * greatest;
        }
    }

    /// One step, shorter if something happens; returns what.
    pub(super) fn step(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        history: &mut History,
    ) -> Option<Ended> {
        self.set_scale();
        let due = self.due();
        if !due.is_empty() {
            return Some(self.switch(&due, Vec::new()));
        }
        match self.look_ahead() {
            Ok(true) => return Some(Ended::Event(vec![Cause::Slips])),
            Ok(false) => {}
            Err(faults) => return Some(Ended::End(End::NoValue(faults))),
        }
        let (step, error) = match self.accepted_step(phase, decisions, history) {
            Ok(accepted) => accepted,
            Err(Failure::Loads(faults)) => return Some(Ended::End(End::NoValue(faults))),
            Err(Failure::Singular) => return Some(Ended::Event(vec![Cause::Locks])),
        };
        let first = history.dense.len() - DENSE * self.state.len();
        match self.first_event(phase, decisions, &history.dense[first..], step) {
            Ok(None) => {
                self.next = step * self.control.accepted(error);
                self.advance(step);
                self.values.swap(0, 3);
                None
            }
            Ok(Some((fraction, watched))) => {
                let dense = history.dense.split_off(first);
                self.next = step;
                let mut causes = self.causes(&watched);
                let place = (fraction, watched[0]);
                match self.stop_at(phase, decisions, (&dense, step), place, history) {
                    Ok(length) if length > 0.0 && self.still_slides(phase, &causes) => {
                        self.go_on(length, phase, decisions)
                    }
                    Ok(_) => {
                        match self.held_causes(&watched, phase, decisions) {
                            Ok(reached) => causes.extend(reached),
                            Err(Failure::Loads(faults)) => return Some(Ended::End(End::NoValue(faults))),
                            Err(Failure::Singular) => return Some(Ended::Event(vec![Cause::Locks])),
                        }
                        let mut switches = self.due();
                        switches.extend(watched.iter().filter_map(|watched| match watched {
                            Watched::Relation(switch) => Some(*switch),
                            _ => None,
                        }));
                        Some(self.switch(&switches, causes))
                    }
                    Err(Failure::Loads(faults)) => Some(Ended::End(End::NoValue(faults))),
                    Err(Failure::Singular) => Some(Ended::Event(vec![Cause::Locks])),
                }
            }
            Err(Failure::Loads(faults)) => {
                history.dense.truncate(first);
                Some(Ended::End(End::NoValue(faults)))
            }
            Err(Failure::Singular) => {
                history.dense.truncate(first);
                Some(Ended::Event(vec![Cause::Locks]))
            }
        }
    }

    /// What the watched functions that have passed zero are the causes of.
    fn causes(&self, watched: &[Watched]) -> Vec<Cause> {
        let name = |index: usize| self.options.events[index].name.clone();
        watched.iter().filter_map(|watched| Cause::of(*watched, &self.equations.sliders, name)).collect()
    }

    /// Puts relations on their next pieces; the loads and drives that jump there, and pads, are causes of the event.
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

    /// Chooses the time beyond which the next step does not go; whether something slips now that has stood still.
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

    /// Tries steps until one is accurate, projects its end, evaluates what is watched there, and describes it.
    fn accepted_step(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        history: &mut History,
    ) -> Result<(f64, f64), Failure> {
        loop {
            let rest = self.stop - self.time;
            let wanted = self.next.min(self.longest);
            // No tiny last step.
            let step = if wanted >= rest {
                rest
            } else if wanted > 0.5 * rest {
                rest / 2.0
            } else {
                wanted
            };
            let step = self.resolved(step);
            let least = self.least_step();
            let attempt = self.try_step(step, phase, decisions, history);
            match attempt {
                Ok(error) if error <= 1.0 => {
                    let state = &self.state;
                    self.stepper.describe(step, state, &mut history.dense);
                    return Ok((step, error));
                }
                Ok(error) if step > least => self.next = step * self.control.rejected(error),
                Err(_) if step > least => self.next = step * self.control.rejected(f64::INFINITY),
                Ok(_) => return Err(self.without_bounds(phase)),
                Err(failure) => return Err(failure),
            }
            history.statistics.rejected += 1;
        }
    }

    /// Whether it is known of all joints that stick until when they do.
    fn is_held(&self) -> bool {
        self.hold.is_some() && self.holds_all
    }

    /// Whether joints have stuck until now under loads that change with time, and nothing has proven that they could.
    pub(super) fn rests_unproven(&self) -> bool {
        let is_proven = self.is_held() && self.time <= self.outlook.proven + self.least_step();
        self.watch.list.contains(&Watched::Sticking) && !is_proven && !self.resolution.is_empty()
    }

    /// A step that sees what the loads do meanwhile; while everything stands still they only decide how long that lasts, which is known.
    fn resolved(&mut self, step: f64) -> f64 {
        if self.resolution.is_empty() {
            return step;
        }
        let is_proven = self.is_held() && self.time + step <= self.outlook.proven + self.least_step();
        if is_proven && self.watch.list.iter().all(|watched| watched.needs() != Needs::Forces) {
            return step;
        }
        self.equations.place(self.time, &self.state);
        let velocity = self.watch.magnitudes.velocity;
        let velocities = [velocity, self.tolerance * velocity];
        self.resolution.step(&self.equations.configuration, velocities, [step, self.least_step()])
    }

    /// Why no step is short enough: the mode locks, or the loads grow beyond all bounds.
    fn without_bounds(&self, phase: &Phase) -> Failure {
        let determinant = self.watch.value(Watched::Determinant, phase, &self.equations);
        if self.watch.magnitudes.force > 0.0 && determinant.is_ok_and(|determinant| determinant > 0.0) {
            return Failure::Loads(Fault::general(FaultKind::LoadsWithoutBounds).into());
        }
        Failure::Singular
    }

    fn try_step(
        &mut self,
        step: f64,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        history: &mut History,
    ) -> Result<f64, Failure> {
        let error = self.stepper.attempt(&mut self.equations, [self.time, step], &self.state, &self.scale)?;
        if error <= 1.0 {
            let mut values = std::mem::take(&mut self.values);
            let watched = self.watch_all(phase, decisions, &mut values[3]);
            self.values = values;
            watched?;
            self.notice_force();
            let drift = self.equations.project(&mut self.stepper.end);
            history.drift = history.drift.max(drift);
        }
        Ok(error)
    }

    /// Ends the step where something happens on the solution within it, by a step of that length, which is more accurate; returns
    /// the length.
    fn stop_at(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        (dense, step): (&[f64], f64),
        (fraction, watched): (f64, Watched),
        history: &mut History,
    ) -> Result<f64, Failure> {
        if fraction <= 0.0 {
            return Ok(0.0);
        }
        // It may happen where the step was to end in any case.
        let is_end = fraction > 1.0 - SAME_INSTANT;
        let mut length = if is_end { step } else { fraction * step };
        let drift = self.attempt(length)?;
        history.drift = history.drift.max(drift);
        if !is_end {
            if let Ok(corrected) = self.corrected(phase, decisions, (dense, step), (fraction, watched)) {
                length = corrected;
            } else {
                self.attempt(length)?;
            }
        }
        self.stepper.describe(length, &self.state, &mut history.dense);
        self.advance(length);
        Ok(length)
    }

    /// A step of a given length to a state on the joints, whatever its error is.
    fn attempt(&mut self, step: f64) -> Result<Drift, Failure> {
        self.stepper.attempt(&mut self.equations, [self.time, step], &self.state, &self.scale)?;
        Ok(self.equations.project(&mut self.stepper.end))
    }

    /// Whether a joint that should have stopped at the end of the step slides on, much faster than errors of steps are: its
    /// stop was found on a solution within a longer step that did not resolve it.
    fn still_slides(&self, phase: &Phase, causes: &[Cause]) -> bool {
        let little = self.tolerance * self.watch.magnitudes.velocity;
        let only_stops = causes.iter().all(|cause| matches!(cause, Cause::Stops(_)));
        only_stops
            && self.watch.list.iter().enumerate().any(|(index, watched)| {
                let Watched::Velocity(joint, _) = *watched else { return false };
                let samples = self.values.iter().filter_map(|values| values.get(index));
                let greatest = samples.fold(0.0, |greatest: f64, value| greatest.max(*value));
                let stops = causes.contains(&Cause::Stops(self.equations.sliders[joint]));
                let velocity = self.watch.value(*watched, phase, &self.equations).unwrap_or(0.0);
                stops && velocity > little && velocity > STOPPED * greatest
            })
    }

    /// Goes on in the same phase from where a shortened step has ended, in steps of half its length.
    fn go_on(&mut self, step: f64, phase: &Phase, decisions: &mut dyn Decisions) -> Option<Ended> {
        self.next = step / 2.0;
        let mut values = std::mem::take(&mut self.values);
        let watched = self.watch_all(phase, decisions, &mut values[0]);
        self.values = values;
        match watched {
            Ok(()) => None,
            Err(Failure::Loads(faults)) => Some(Ended::End(End::NoValue(faults))),
            Err(Failure::Singular) => Some(Ended::Event(vec![Cause::Locks])),
        }
    }

    fn advance(&mut self, step: f64) {
        self.time = if step >= self.stop - self.time { self.stop } else { self.time + step };
        self.stepper.advance(&mut self.state);
        self.notice_velocity();
    }

    /// Values of all watched functions at the last evaluation.
    fn watch_all(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        values: &mut Vec<f64>,
    ) -> Result<(), Failure> {
        values.clear();
        for index in 0..self.watch.list.len() {
            values.push(self.value(self.watch.list[index], phase, decisions)?);
        }
        Ok(())
    }

    /// The value of one watched function at the last evaluation.
    fn value(
        &mut self,
        watched: Watched,
        phase: &Phase,
        decisions: &mut dyn Decisions,
    ) -> Result<f64, Failure> {
        let equations = &self.equations;
        if let Watched::Relation(switch) = watched {
            return Ok(self.switching.margin(&equations.configuration, switch));
        }
        if watched == Watched::HeldReactions {
            return self.room_of_held(phase, decisions);
        }
        let equations = &self.equations;
        if watched == Watched::Sticking {
            let configuration = &equations.configuration;
            let known = self.outlook.proven + self.least_step();
            let margin = match &mut self.hold {
                // It is known when it ends.
                Some(_) if self.holds_all && configuration.time <= known => return Ok(1.0),
                Some(hold) if self.holds_all => hold.margin(configuration.time),
                _ => decisions.sticking_margin(equations.mechanism, configuration, phase),
            };
            return margin.map_err(Failure::Loads);
        }
        self.watch.value(watched, phase, equations).map_err(|fault| Failure::Loads(fault.into()))
    }

    /// The first instant within the step at which something falls through zero, as a fraction, and all that does.
    fn first_event(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        dense: &[f64],
        step: f64,
    ) -> Result<Option<(f64, Vec<Watched>)>, Failure> {
        let mut places = SAMPLES;
        let mut falls = Vec::new();
        for part in 0..SAMPLES.len() - 1 {
            if part < SAMPLES.len() - 2 {
                self.sample(phase, decisions, (dense, step), (part + 1, &mut places))?;
            }
            falls = self.falls_between([places[part], places[part + 1]], part);
            if !falls.is_empty() {
                break;
            }
        }
        let until = falls.first().map_or(1.0, |fall| fall.ends[0]);
        if until > 0.0 && places == SAMPLES {
            self.add_dips(phase, decisions, (dense, step), (until, &mut falls))?;
        }
        if falls.is_empty() {
            return Ok(None);
        }
        self.locate(phase, decisions, (dense, step), &falls).map(Some)
    }

    /// Values of all watched functions at a sample within the step.
    fn sample(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        (dense, step): (&[f64], f64),
        (sample, places): (usize, &mut [f64; 4]),
    ) -> Result<(), Failure> {
        match self.evaluate_within(dense, places[sample], step, Needs::Forces) {
            // Exactly where the equations have no solution; a little before they have one.
            Err(Failure::Singular) => {
                places[sample] -= BESIDE * (places[sample] - places[sample - 1]);
                self.evaluate_within(dense, places[sample], step, Needs::Forces)?;
            }
            evaluated => evaluated?,
        }
        let mut values = std::mem::take(&mut self.values);
        let watched = self.watch_all(phase, decisions, &mut values[sample]);
        self.values = values;
        watched
    }

    /// What has fallen from one sample of the step to the next.
    fn falls_between(&self, ends: [f64; 2], part: usize) -> Vec<Fall> {
        let one = |index: usize| {
            let values = [self.values[part][index], self.values[part + 1][index]];
            Fall { index, ends, values }
        };
        (0..self.watch.list.len()).map(one).filter(|fall| self.is_below(fall)).collect()
    }

    /// Adds what falls and rises again between two samples, before something else has fallen.
    fn add_dips(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        (dense, step): (&[f64], f64),
        (until, falls): (f64, &mut Vec<Fall>),
    ) -> Result<(), Failure> {
        for index in 0..self.watch.list.len() {
            let samples = std::array::from_fn(|sample| self.values[sample][index]);
            let Some(place) = dip(samples).filter(|place| *place < until) else { continue };
            let watched = self.watch.list[index];
            self.evaluate_within(dense, place, step, watched.needs())?;
            let value = self.value(watched, phase, decisions)?;
            let before = SAMPLES.iter().rposition(|fraction| *fraction < place).unwrap_or(0);
            let fall =
                Fall { index, ends: [SAMPLES[before], place], values: [self.values[before][index], value] };
            falls.extend(self.is_below(&fall).then_some(fall));
        }
        Ok(())
    }

    /// Whether a function is below zero at the end, beyond rounding where it was not above zero before.
    fn is_below(&self, fall: &Fall) -> bool {
        let [before, after] = fall.values;
        match self.watch.list[fall.index] {
            // It may be below zero; just behind one of its zeros it is zero within rounding.
            Watched::User(..) => return after <= 0.0 && before > USER_ZERO * after.abs(),
            // Just behind the end of its piece it is on the next one, and above zero: if it falls from zero, however that was rounded,
            // the step before has ended at the end of the piece.
            Watched::Relation(_) => return after < 0.0 && before > -USER_ZERO * after.abs(),
            _ => {}
        }
        let tolerance = self.watch.tolerance(self.watch.list[fall.index], &self.equations);
        if self.watch.list[fall.index] == Watched::Sticking {
            // What just reaches the limit sticks.
            return after < -tolerance && after < before;
        }
        if before > tolerance { after <= 0.0 } else { after < -tolerance && after < before }
    }

    /// The least of the zeros of what falls, and everything that vanishes there.
    fn locate(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        (dense, step): (&[f64], f64),
        falls: &[Fall],
    ) -> Result<(f64, Vec<Watched>), Failure> {
        let mut zeros: Vec<(f64, Watched)> = Vec::with_capacity(falls.len());
        for &Fall { index, ends, values } in falls {
            let watched = self.watch.list[index];
            let first = zeros.iter().map(|(zero, _)| *zero).fold(f64::INFINITY, f64::min);
            let mut function =
                |fraction: f64| match self.evaluate_within(dense, fraction, step, watched.needs()) {
                    // Where the equations have no solution forces are beyond all bounds: not before the zero.
                    Err(Failure::Singular) => Ok(0.0),
                    evaluated => evaluated.and_then(|()| self.value(watched, phase, decisions)),
                };
            let same = first + SAME_INSTANT;
            if values[0] > 0.0 && same > ends[0] && same < ends[1] && function(same)? > 0.0 {
                // It falls later.
                continue;
            }
            let bracket = if values[0] > 0.0 {
                Some((ends, values))
            } else {
                rising_part(ends, values[1], &mut function)?
            };
            let zero = match bracket {
                Some((ends, values)) => falling_root(ends, values, ROOT_TOLERANCE, function)?,
                None => ends[0],
            };
            zeros.push((zero, watched));
        }
        let first = zeros.iter().map(|(zero, _)| *zero).fold(f64::INFINITY, f64::min);
        zeros.retain(|(zero, _)| *zero <= first + SAME_INSTANT);
        zeros.sort_by(|one, other| one.0.total_cmp(&other.0));
        Ok((first, zeros.into_iter().map(|(_, watched)| watched).collect()))
    }

    /// Corrects the length of the step that has just been attempted, to where a function vanishes on the solution within a longer step, so
    /// that the function does so at its very end: Newton's method, at first with the slope on that solution. The length changes by a
    /// part `e` that is of the order of the errors of steps; going on along the step's own solution, which is smooth, costs an
    /// error of `e^2` of them, so that the step need not be repeated unless `e^3` is seen.
    fn corrected(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        (dense, step): (&[f64], f64),
        (fraction, watched): (f64, Watched),
    ) -> Result<f64, Failure> {
        let beside = fraction * (1.0 - SLOPE);
        self.evaluate_within(dense, beside, step, watched.needs())?;
        let mut slope = self.value(watched, phase, decisions)? / ((beside - fraction) * step);
        let mut length = fraction * step;
        let mut value = self.value_at_end(phase, decisions, (length, watched))?;
        let mut before = Vec::new();
        loop {
            let change = -value / slope;
            let next = length + change;
            let matters = change.abs() > ROOT_TOLERANCE * step;
            if !(matters && next > 0.0 && next <= self.stop - self.time) {
                return Ok(length);
            }
            self.stepper.end.clone_into(&mut before);
            if (change / length).abs().powi(3) > ROOT_TOLERANCE {
                self.attempt(next)?;
            } else {
                self.stepper.prolong(length, change, &self.state);
            }
            let found = self.value_at_end(phase, decisions, (next, watched))?;
            if found.abs() >= value.abs() {
                self.stepper.end.copy_from_slice(&before);
                self.value_at_end(phase, decisions, (length, watched))?;
                return Ok(length);
            }
            slope = (found - value) / change;
            (length, value) = (next, found);
        }
    }

    /// The value of a watched function at the end of the step that was tried last, of this length.
    fn value_at_end(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        (length, watched): (f64, Watched),
    ) -> Result<f64, Failure> {
        self.stepper.finish(&mut self.equations, self.time + length)?;
        self.value(watched, phase, decisions)
    }

    /// Puts the equations at a fraction of the step.
    fn evaluate_within(
        &mut self,
        dense: &[f64],
        fraction: f64,
        step: f64,
        needs: Needs,
    ) -> Result<(), Failure> {
        within(dense, fraction, &mut self.inside);
        let time = self.time + fraction * step;
        if needs == Needs::Forces {
            self.equations.evaluate(time, &self.inside)
        } else {
            self.equations.place(time, &self.inside);
            Ok(())
        }
    }

    /// Makes the sliding velocities of joints that have stopped exactly zero, as an impulse on their lines would; unless that
    /// changes more than errors of steps do: at a dead centre the joint stands while the mechanism moves on.
    pub(super) fn settle(&mut self, phase: &Phase, stopped: &[bool]) {
        if !stopped.contains(&true) {
            return;
        }
        let mut held = phase.clone();
        for (joint, stopped) in held.joints.iter_mut().zip(stopped) {
            if *stopped {
                *joint = JointPhase::Sticking;
            }
        }
        if self.equations.enter(&held, self.time, &self.state).is_err() {
            return;
        }
        let mut settled = self.state.clone();
        self.equations.project(&mut settled);
        let size = self.equations.mechanism.size;
        let bodies = 3 * self.equations.mechanism.bodies.len();
        let rates = settled[bodies..2 * bodies].iter().zip(&self.state[bodies..2 * bodies]);
        let change = rates.enumerate().fold(0.0_f64, |greatest, (index, (new, old))| {
            let scale = if index % 3 == 2 { size } else { 1.0 };
            greatest.max(scale * (new - old).abs())
        });
        let permitted = SETTLED * self.tolerance.max(LEAST_TOLERANCE);
        if change <= permitted * self.watch.magnitudes.velocity {
            self.state = settled;
        }
        self.equations.place(self.time, &self.state);
        let sliders = self.equations.sliders.iter().zip(stopped);
        let stops = |joint: JointId| sliders.clone().any(|(slider, stopped)| *slider == joint && *stopped);
        self.switching.settle(&self.equations.configuration, &stops);
        self.equations.hold(&self.switching);
    }

    /// Brings a joint exactly to a displacement at which an event has found it, within errors of steps, as reactions would.
    pub(super) fn put_at(&mut self, phase: &Phase, joint: JointId, displacement: f64) {
        let mut held = phase.clone();
        let sliders = self.equations.sliders.iter().zip(&mut held.joints);
        sliders.filter(|(id, _)| **id == joint).for_each(|(_, state)| *state = JointPhase::Sticking);
        if self.equations.enter(&held, self.time, &self.state).is_err() {
            return;
        }
        self.equations.hold_at(joint, displacement);
        let mut moved = self.state.clone();
        self.equations.project(&mut moved);
        let places = 3 * self.equations.mechanism.bodies.len();
        self.state[..places].copy_from_slice(&moved[..places]);
    }

    /// Velocities after an impulse.
    pub(super) fn set_velocities(&mut self, velocities: &[Velocity]) {
        let bodies = 3 * velocities.len();
        let rates = velocities.iter().flat_map(|v| [v.linear.x, v.linear.y, v.angular]);
        self.state[bodies..2 * bodies].iter_mut().zip(rates).for_each(|(value, rate)| *value = rate);
        self.equations.place(self.time, &self.state);
        self.switching.jump(&self.equations.configuration);
        self.equations.hold(&self.switching);
    }
}

/// A watched function that is below zero at the end of a part of a step.
#[derive(Debug, Clone, Copy)]
struct Fall {
    /// Its number in the list.
    index: usize,
    /// Where the part begins and ends, as fractions of the step.
    ends: [f64; 2],
    /// Its values there.
    values: [f64; 2],
}

/// Two places, and the values of a function there.
type Bracket = ([f64; 2], [f64; 2]);

/// A part of the way on which a function that begins with zero, or below it within rounding, and ends below zero falls
/// from above zero; none if it does not rise first.
fn rising_part(
    [left, mut right]: [f64; 2],
    mut at_right: f64,
    function: &mut impl FnMut(f64) -> Result<f64, Failure>,
) -> Result<Option<Bracket>, Failure> {
    while right - left > SAME_INSTANT {
        let middle = f64::midpoint(left, right);
        let value = function(middle)?;
        if value > 0.0 {
            return Ok(Some(([middle, right], [value, at_right])));
        }
        (right, at_right) = (middle, value);
    }
    Ok(None)
}
