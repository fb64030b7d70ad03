//! Steps: tried until one is accurate, projected, and ended where something happens.

use super::Smooth;
use super::events::{ROOT_TOLERANCE, SAME_INSTANT, StepSolution};
use crate::fault::{Fault, FaultKind};
use crate::ids::JointId;
use crate::motion::decision::rules::Decisions;
use crate::motion::moving::cause::Cause;
use crate::motion::moving::equations::{Drift, Failure};
use crate::motion::moving::watch::{Needs, Watched};
use crate::motion::record::history::History;
use crate::pattern::phase::Phase;

/// A sliding velocity or a normal force counts as zero below this part of its greatest value in the step, or below the
/// errors of steps.
const VANISHED: f64 = 0.01;
/// Part of the way to a zero over which the slope there is taken: the square root of what numbers resolve.
const SLOPE: f64 = 1e-8;

/// Where a watched function passes zero within a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Zero {
    /// As a fraction of the step.
    pub(super) fraction: f64,
    pub(super) watched: Watched,
}

impl Smooth<'_, '_> {
    /// Tries steps until one is accurate, projects its end, evaluates what is watched there, and describes
    /// it.
    pub(super) fn accepted_step(
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

    /// Whether joints have stuck until now under loads that change with time, and nothing has proven that
    /// they could.
    pub(in crate::motion) fn rests_unproven(&self) -> bool {
        let is_proven = self.is_held() && self.time <= self.outlook.proven + self.least_step();
        self.watch.list.contains(&Watched::Sticking) && !is_proven && !self.resolution.is_empty()
    }

    /// A step that sees what the loads do meanwhile; while everything stands still they only decide how long
    /// that lasts, which is known.
    fn resolved(&mut self, step: f64) -> f64 {
        if self.resolution.is_empty() {
            return step;
        }
        let is_proven = self.is_held() && self.time + step <= self.outlook.proven + self.least_step();
        if is_proven && self.watch.list.iter().all(|watched| watched.needs() != Needs::Forces) {
            return step;
        }
        self.equations.place(self.time, &self.state);
        let magnitudes = &self.watch.magnitudes;
        let velocities = (|body| magnitudes.of_body(body).velocity, self.tolerance);
        self.resolution.step(&self.equations.configuration, velocities, [step, self.least_step()])
    }

    /// Why no step is short enough: the mode locks, or the loads grow beyond all bounds.
    fn without_bounds(&self, phase: &Phase) -> Failure {
        let determinant = self.watch.value(Watched::Determinant, phase, &self.equations);
        if self.watch.magnitudes.greatest().force > 0.0
            && determinant.is_ok_and(|determinant| determinant > 0.0)
        {
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
            self.watch_all(phase, decisions, 3)?;
            self.watch.magnitudes.notice_forces(&self.equations);
            let drift = self.equations.project(&mut self.stepper.end);
            history.drift = history.drift.max(drift);
        }
        Ok(error)
    }

    /// Ends the step where something happens on the solution within it, by a step of that length, which is
    /// more accurate; returns the length.
    pub(super) fn stop_at(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        solution: StepSolution<'_>,
        zero: Zero,
        history: &mut History,
    ) -> Result<f64, Failure> {
        let fraction = zero.fraction;
        if fraction <= 0.0 {
            return Ok(0.0);
        }
        // It may happen where the step was to end in any case.
        let is_end = fraction > 1.0 - SAME_INSTANT;
        let mut length = if is_end { solution.length } else { fraction * solution.length };
        let drift = self.attempt(length)?;
        history.drift = history.drift.max(drift);
        if !is_end {
            if let Ok(corrected) = self.corrected(phase, decisions, solution, zero) {
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

    /// Whether a joint that should have stopped at the end of the step slides on, much faster than errors of
    /// steps are: its stop was found on a solution within a longer step that did not resolve it.
    pub(super) fn still_slides(&self, phase: &Phase, causes: &[Cause]) -> bool {
        let mechanism = self.equations.mechanism;
        let little = |joint| self.tolerance * self.watch.magnitudes.of_joint(mechanism, joint).velocity;
        let only_stops = causes.iter().all(|cause| matches!(cause, Cause::Stops(_) | Cause::StopsTurning(_)));
        let hinges: Vec<JointId> = self.equations.hinge_joints().collect();
        only_stops
            && self.watch.list.iter().enumerate().any(|(index, watched)| {
                let (cause, little) = match *watched {
                    Watched::Velocity(joint, _) => {
                        let joint = self.equations.sliders[joint];
                        (Cause::Stops(joint), little(joint))
                    }
                    Watched::Spin(hinge, _) => {
                        let joint = hinges[hinge];
                        (Cause::StopsTurning(joint), little(joint) / mechanism.size)
                    }
                    _ => return false,
                };
                let velocity = self.watch.value(*watched, phase, &self.equations).unwrap_or(0.0);
                causes.contains(&cause) && self.is_far_from_zero(index, velocity, little)
            })
    }

    /// Returns whether a watched function, by its number, is not zero at the end of the step with this value there, compared with
    /// what is little, and with its greatest value in the step.
    fn is_far_from_zero(&self, index: usize, value: f64, little: f64) -> bool {
        let samples = self.values.iter().filter_map(|values| values.get(index));
        let greatest = samples.fold(0.0, |greatest: f64, value| greatest.max(*value));
        value > little && value > VANISHED * greatest
    }

    /// Returns whether a normal force that should have vanished at the end of the step is far from zero: it is not continuous
    /// within what the errors of steps permit, since the determinant of the mode vanishes there.
    pub(super) fn jumps_through_zero(&self, watched: &[Watched], phase: &Phase) -> bool {
        let mut forces = watched.iter().filter(|watched| matches!(watched, Watched::NormalForce(_)));
        forces.any(|watched| {
            let Some(index) = self.watch.list.iter().position(|one| one == watched) else { return false };
            let force = self.watch.value(*watched, phase, &self.equations).unwrap_or(0.0).abs();
            self.is_far_from_zero(index, force, self.watch.tolerance(*watched, &self.equations))
        })
    }

    /// Goes on in the same phase from where a shortened step has ended, in steps of half its length.
    pub(super) fn go_on(
        &mut self,
        step: f64,
        phase: &Phase,
        decisions: &mut dyn Decisions,
    ) -> Result<(), Failure> {
        self.next = step / 2.0;
        self.watch_all(phase, decisions, 0)
    }

    pub(super) fn advance(&mut self, step: f64) {
        self.time = if step >= self.stop - self.time { self.stop } else { self.time + step };
        self.stepper.advance(&mut self.state);
        self.notice_velocity();
    }

    /// Corrects the length of the step that has just been attempted, to where a function vanishes on the
    /// solution within a longer step, so that the function does so at its very end: Newton's method, at first
    /// with the slope on that solution. The length changes by a part `e` that is of the order of the errors
    /// of steps; going on along the step's own solution, which is smooth, costs an error of `e^2` of them, so
    /// that the step need not be repeated unless `e^3` is seen.
    fn corrected(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        solution: StepSolution<'_>,
        Zero { fraction, watched }: Zero,
    ) -> Result<f64, Failure> {
        let step = solution.length;
        let beside = fraction * (1.0 - SLOPE);
        self.evaluate_within(solution, beside, watched.needs())?;
        let mut slope = self.value(watched, phase, decisions)? / ((beside - fraction) * step);
        let mut length = fraction * step;
        let mut value = self.value_at_end(phase, decisions, length, watched)?;
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
            let found = self.value_at_end(phase, decisions, next, watched)?;
            if found.abs() >= value.abs() {
                self.stepper.end.copy_from_slice(&before);
                self.value_at_end(phase, decisions, length, watched)?;
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
        length: f64,
        watched: Watched,
    ) -> Result<f64, Failure> {
        self.stepper.finish(&mut self.equations, self.time + length)?;
        self.value(watched, phase, decisions)
    }
}
