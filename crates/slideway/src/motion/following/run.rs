//! The loop: a phase, an event, a decision, and so on.

use super::smooth::{Ended, Smooth};
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::ContactId;
use crate::mechanism::{EndStop, Mechanism};
use crate::model::Stop;
use crate::motion::decision::rules::{Continuation, Continuations, Decisions, EventInstant, HaltingImpulse};
use crate::motion::moving::cause::Cause;
use crate::motion::moving::equations::{Drift, Equations, Failure};
use crate::motion::options::SimulateOptions;
use crate::motion::record::event::{Event, Words};
use crate::motion::record::history::{
    End, Energy, History, ImpulseLoss, LastState, PhaseInterval, Statistics, Step,
};
use crate::pattern::phase::{JointPhase, Phase};
use crate::progress::{Progress, Work};
use crate::report::spaced;

/// So many impulses at one instant are tried.
const MOST_IMPULSES: usize = 16;
/// So many events in a row within a short time are an accumulation, ...
const CROWD: usize = 40;
/// ... and this part of the time in which the mechanism moves through its own size is a short time.
const SHORT: f64 = 5e-5;

/// Where forces grow beyond all bounds, steps end before the end of a mode: friction is by this part short of what holds there.
const BEFORE_THE_END: f64 = 1e-3;

/// Solutions whose hinge forces have directions with cosines this close to 1 are those that meet at a fold.
const NEAR_FOLD: f64 = 1e-4;

/// The displacement at which a joint has a stop at an end of its travel (m); none if the motion ends there.
pub(super) fn stop_at(mechanism: &Mechanism, EndStop { joint, greatest }: EndStop) -> Option<f64> {
    let slider = mechanism.slider(joint)?;
    let end = usize::from(greatest);
    slider.stops[end].and_then(Stop::restitution)?;
    slider.travel.map(|travel| travel[end])
}

/// A simulation under way.
pub(in crate::motion) struct Run<'a, 'm> {
    pub(super) options: &'a SimulateOptions,
    decisions: &'a mut dyn Decisions,
    pub(super) smooth: Smooth<'a, 'm>,
    pub(super) phase: Option<Phase>,
    history: History,
    branchings: usize,
    pub(super) work: Work<'a>,
}

impl<'a, 'm> Run<'a, 'm> {
    /// A simulation at its start.
    pub(in crate::motion) fn new(
        (mechanism, configuration): (&'m Mechanism, &Configuration),
        options: &'a SimulateOptions,
        decisions: &'a mut dyn Decisions,
        work: Work<'a>,
    ) -> Self {
        let equations = Equations::new(mechanism, configuration);
        let state = equations.state_of(configuration);
        let history = History {
            mechanism: mechanism.clone(),
            events: Vec::new(),
            phases: Vec::new(),
            end: End::Finished,
            drift: Drift::default(),
            energy_error: 0.0,
            energy_scale: 0.0,
            statistics: Statistics::default(),
            steps: Vec::new(),
            dense: Vec::new(),
            size: state.len(),
            directions: Vec::new(),
            impulses: Vec::new(),
            undetermined: Vec::new(),
            initial: configuration.clone(),
            last: LastState { time: configuration.time, state: state.clone(), is_still: false },
        };
        let smooth = Smooth::new(equations, state, configuration.time, options);
        Self { options, decisions, smooth, phase: None, history, branchings: 0, work }
    }

    /// Follows the mechanism to the end.
    ///
    /// # Errors
    /// A state from which it cannot begin.
    pub(in crate::motion) fn follow(mut self) -> Result<History, Faults> {
        let total = self.energy().total();
        let end = match self.decide(vec![Cause::Start])? {
            None => self.phases(total),
            Some(end) => end,
        };
        self.history.end = end;
        self.history.last = LastState {
            time: self.smooth.time,
            state: self.smooth.state.clone(),
            is_still: self.smooth.is_still(),
        };
        self.history.statistics.evaluations = self.smooth.equations.evaluations;
        self.history.undetermined = self.smooth.undetermined.iter().copied().collect();
        if let Some(interval) = self.history.phases.last_mut() {
            interval.to = self.smooth.time;
        }
        Ok(self.history)
    }

    /// Phase after phase.
    fn phases(&mut self, total: f64) -> End {
        loop {
            let Some(phase) = self.phase.clone() else { return End::NoContinuation };
            let causes = match self.phase(&phase, total) {
                // A load has a kink.
                Ended::Event(causes) if causes.is_empty() => continue,
                Ended::Event(causes) => causes,
                Ended::End(end) => return end,
            };
            if let Some(end) = self.terminal(&causes) {
                self.tell(causes, Continuations::default(), None);
                return end;
            }
            if causes.iter().any(Cause::ends_phase) {
                match self.decide(causes.clone()) {
                    Ok(None) => {}
                    Ok(Some(end)) => return end,
                    Err(faults) => {
                        self.tell(causes, Continuations::default(), None);
                        return End::Undecided(faults);
                    }
                }
            } else {
                self.note(causes, Some(phase), Continuations::default(), None);
            }
            if self.history.events.len() >= self.options.most_events {
                return End::EventLimit;
            }
            if self.accumulates() {
                return End::Accumulation;
            }
        }
    }

    /// One phase, until it ends.
    fn phase(&mut self, phase: &Phase, total: f64) -> Ended {
        let begun = self.smooth.enter(phase, self.decisions);
        let exceeded = match begun.and_then(|()| self.smooth.exceeded_reactions(phase, self.decisions)) {
            Ok(exceeded) => exceeded,
            Err(Failure::Loads(faults)) => return Ended::End(End::NoValue(faults)),
            Err(Failure::Singular | Failure::Fold) => return Ended::End(End::Jammed),
        };
        if !exceeded.is_empty() {
            return Ended::Event(exceeded);
        }
        loop {
            if self.smooth.is_over() {
                return Ended::End(End::Finished);
            }
            if self.history.statistics.steps >= self.options.most_steps {
                return Ended::End(End::StepLimit);
            }
            let from = self.smooth.time;
            let step = self.smooth.step(phase, self.decisions, &mut self.history);
            let to = self.smooth.time;
            if to > from {
                let phase = self.history.phases.len() - 1;
                self.history.steps.push(Step { time: from, length: to - from, phase });
                self.history.directions.extend(self.smooth.equations.directions());
                self.history.statistics.steps += 1;
                if self.smooth.rests_unproven() {
                    let statistics = &mut self.history.statistics;
                    statistics.sampled += to - from;
                    statistics.sampled_step = statistics.sampled_step.max(to - from);
                }
                self.balance(total);
            }
            if let Some(ended) = step {
                return ended;
            }
            if self.work.tell(&self.progress()).is_break() {
                return Ended::End(End::Interrupted);
            }
        }
    }

    fn progress(&self) -> Progress {
        let fraction = (self.smooth.time - self.history.initial.time) / self.options.duration;
        let done = self.history.statistics.steps as u64;
        Progress { counted: "steps", done, fraction: Some(fraction), found: None }
    }

    fn energy(&self) -> Energy {
        let lost = self.history.impulses.last().map_or(0.0, |loss| loss.energy);
        let equations = &self.smooth.equations;
        Energy::of(equations.mechanism, &equations.configuration, &self.smooth.state, lost)
    }

    /// Takes note of the error of the energy balance.
    fn balance(&mut self, total: f64) {
        self.smooth.equations.place(self.smooth.time, &self.smooth.state);
        let energy = self.energy();
        let friction = energy.friction.iter().chain(&energy.hinges);
        let works = friction.chain(&energy.loads).chain(&energy.drives);
        let scale = works.fold(energy.kinetic, |scale, work| scale.max(work.abs()));
        self.history.energy_scale = self.history.energy_scale.max(scale);
        self.history.energy_error = self.history.energy_error.max((energy.total() - total).abs());
    }

    /// Why the simulation ends with these causes, if it does.
    fn terminal(&self, causes: &[Cause]) -> Option<End> {
        causes.iter().find_map(|cause| match cause {
            &Cause::TravelLimit { joint, greatest } => {
                let mechanism = self.smooth.equations.mechanism;
                let stops = stop_at(mechanism, EndStop { joint, greatest }).is_some();
                (!stops).then_some(End::TravelLimit(joint))
            }
            Cause::OverlapVanishes(joint) => Some(End::OverlapVanished(*joint)),
            Cause::Touches(contact) if self.is_beside(*contact) => Some(End::BesideFace(*contact)),
            Cause::BareCorner { wanted, .. } => Some(End::BareCorner { wanted }),
            Cause::ReactionLimit(contact) => Some(End::ReactionLimit(*contact)),
            Cause::User(index, _) => self.options.events[*index].ends.then_some(End::UserEvent(*index)),
            _ => None,
        })
    }

    /// Decides how the motion goes on, unless the work is to end; returns why the motion ends, if it does.
    fn decide(&mut self, causes: Vec<Cause>) -> Result<Option<End>, Faults> {
        let events = self.history.events.len();
        let decided = self.decided(causes.clone());
        if !self.work.is_over() {
            return decided;
        }
        if self.history.events.len() == events {
            self.tell(causes, Continuations::default(), None);
        }
        Ok(Some(End::Interrupted))
    }

    /// Decides how the motion goes on, after impulses if it must; nothing is decided once the work is to end.
    fn decided(&mut self, mut causes: Vec<Cause>) -> Result<Option<End>, Faults> {
        let mut previous = self.phase.as_ref().map(|phase| self.smooth.equations.with_present_forces(phase));
        if self.land(&mut causes)? {
            previous = None;
        }
        for _ in 0..MOST_IMPULSES {
            let stopped = self.stopped(&causes, previous.as_ref());
            if let Some(previous) = &previous {
                self.smooth.settle(previous, &stopped);
            }
            let signs = self.signs(&stopped);
            let (signs, spins) = signs.split_at(self.smooth.equations.sliders.len());
            let zero: Vec<ContactId> = causes.iter().filter_map(Cause::vanishing_contact).collect();
            let (time, state) = (self.smooth.time, &self.smooth.state);
            self.smooth.equations.place(time, state);
            let configuration = self.smooth.equations.configuration.clone();
            let mechanism = self.smooth.equations.mechanism;
            let rounding = self.smooth.rounding();
            let instant = EventInstant {
                mechanism,
                configuration: &configuration,
                signs,
                spins,
                zero: &zero,
                rounding: &rounding,
                previous: previous.as_ref(),
                work: self.work,
            };
            let mut successors = self.decisions.successors(&instant)?;
            if self.work.is_over() {
                return Ok(None);
            }
            without_ended(&self.smooth.equations, &mut successors.list, &causes, previous.as_ref());
            if !successors.list.is_empty() {
                if causes.contains(&Cause::Locks) && mechanism.has_one_sided() {
                    successors.list.extend(self.after_jam(&instant)?);
                }
                let taken = self.choose(&successors.list)?;
                let impulse = taken.and_then(|taken| successors.list[taken].impulse.clone());
                impulse.into_iter().for_each(|impulse| self.jam(&impulse, &mut causes));
                // Where its normal force vanishes, so does the room of a guided slider to tip: it goes on at the other face.
                causes.retain(|cause| !matches!(cause, Cause::Tips(_)));
                self.tell(causes, successors, taken);
                if let Some(contact) = self.out_of_plane() {
                    return Ok(Some(End::OutOfPlane(contact)));
                }
                let branching = self.branchings;
                return Ok(if taken.is_some() { None } else { Some(End::NoSuchBranch { branching }) });
            }
            if let Some(&joint) = self.decisions.tipping(&instant)?.first() {
                if !causes.contains(&Cause::Tips(joint)) {
                    causes.push(Cause::Tips(joint));
                }
                self.tell(causes, Continuations::default(), None);
                return Ok(Some(End::Tips(joint)));
            }
            if stopped.iter().all(|stopped| *stopped) {
                self.tell(causes, Continuations::default(), None);
                return Ok(Some(End::NoContinuation));
            }
            let jam = self.decisions.jam(&instant)?;
            if self.work.is_over() {
                return Ok(None);
            }
            let Some(jam) = jam else { break };
            self.jam(&jam, &mut causes);
            previous = None;
        }
        self.tell(causes, Continuations::default(), None);
        Ok(Some(End::Jammed))
    }

    /// Returns a contact that is open in space: what follows is no motion in the plane.
    fn out_of_plane(&self) -> Option<ContactId> {
        let mechanism = self.smooth.equations.mechanism;
        mechanism.space.as_ref()?;
        self.phase.as_ref()?.open(mechanism).first().copied().map(ContactId)
    }

    /// Lets the impulse of a jam act.
    fn jam(&mut self, impulse: &HaltingImpulse, causes: &mut Vec<Cause>) {
        self.smooth.set_velocities(&impulse.velocities);
        self.note_impulse(impulse.energy_lost);
        causes.retain(|cause| !matches!(cause, Cause::Stops(_) | Cause::StopsTurning(_)));
        causes.push(Cause::Jams { energy_lost: impulse.energy_lost });
    }

    /// The phases after a jam, where a contact that may lift off comes to the end of a mode with a force beyond all bounds: its
    /// impulse is finite, and what follows is open.
    ///
    /// # Errors
    /// Whatever keeps the impulse or what follows it from being decided.
    fn after_jam(&mut self, instant: &EventInstant<'_>) -> Result<Vec<Continuation>, Faults> {
        // Where the mobility of a tip vanishes the impulse that stops it takes just as much friction as there is.
        let mut at_end = instant.mechanism.clone();
        for contact in at_end.contacts.iter_mut().filter(|contact| contact.opens) {
            contact.mu_static = contact.mu_static.map(|mu| mu * (1.0 + BEFORE_THE_END));
        }
        let at_end = EventInstant { mechanism: &at_end, ..*instant };
        let Some(impulse) = self.decisions.jam(&at_end)? else { return Ok(Vec::new()) };
        self.smooth.set_velocities(&impulse.velocities);
        let configuration = self.smooth.equations.configuration.clone();
        let signs = self.signs(&self.stopped(&[], None));
        let (signs, spins) = signs.split_at(self.smooth.equations.sliders.len());
        let after = EventInstant {
            configuration: &configuration,
            signs,
            spins,
            zero: &[],
            previous: None,
            ..*instant
        };
        let found = self.decisions.successors(&after);
        self.smooth.set_velocities(&instant.configuration.velocities);
        let with = |one: Continuation| Continuation { impulse: Some(impulse.clone()), ..one };
        Ok(found?.list.into_iter().map(with).collect())
    }

    pub(super) fn note_impulse(&mut self, energy_lost: f64) {
        let before = self.history.impulses.last().map_or(0.0, |loss| loss.energy);
        self.history.impulses.push(ImpulseLoss { time: self.smooth.time, energy: before + energy_lost });
    }

    /// The number of the phase that is taken; nothing where the branch that is wanted does not exist.
    fn choose(&mut self, successors: &[Continuation]) -> Result<Option<usize>, Faults> {
        let mechanism = self.smooth.equations.mechanism;
        if self.phase.is_none()
            && let Some(wanted) = &self.options.initial
        {
            let patterns: Vec<String> =
                successors.iter().map(|successor| successor.phase.pattern(mechanism)).collect();
            let Some(found) = patterns.iter().position(|pattern| pattern == wanted) else {
                let possible = patterns.iter().map(|pattern| spaced(pattern)).collect();
                return Err(Fault::general(FaultKind::ContradictoryPhase {
                    wanted: spaced(wanted),
                    possible,
                })
                .into());
            };
            return Ok(Some(found));
        }
        if successors.len() < 2 {
            return Ok(Some(0));
        }
        let preferred = if self.options.prefers_sliding { fewest_sticking(successors) } else { 0 };
        let wanted = self.options.branches.get(self.branchings).copied().unwrap_or(preferred);
        self.branchings += 1;
        Ok((wanted < successors.len()).then_some(wanted))
    }

    /// Which sliding joints, then which hinges with friction, have no velocity.
    fn stopped(&self, causes: &[Cause], previous: Option<&Phase>) -> Vec<bool> {
        let equations = &self.smooth.equations;
        let stop = equations.sliders.iter().map(|joint| Cause::Stops(*joint));
        let stop_turning = equations.hinge_joints().map(Cause::StopsTurning);
        let stop = stop.chain(stop_turning).map(|cause| causes.contains(&cause));
        let sticks = |index| {
            previous.is_some_and(|phase| phase.joints_and_hinges().nth(index) == Some(JointPhase::Sticking))
        };
        let velocities = self.velocities().zip(self.smooth.little_velocities());
        let all = velocities.zip(stop).enumerate();
        all.map(|(index, ((velocity, little), stops))| stops || velocity.abs() <= little || sticks(index))
            .collect()
    }

    /// The velocities of all sliding joints, then of the hinges with friction (m/s or rad/s).
    fn velocities(&self) -> impl Iterator<Item = f64> {
        let equations = &self.smooth.equations;
        let sliders = (0..equations.sliders.len()).map(|joint| equations.sliding_velocity(joint));
        sliders.chain((0..equations.mechanism.friction_circles.len()).map(|hinge| equations.spin(hinge)))
    }

    /// The signs of the velocities of all sliding joints, then of the hinges with friction.
    fn signs(&self, stopped: &[bool]) -> Vec<f64> {
        let one = |(velocity, stopped): (f64, &bool)| if *stopped { 0.0 } else { velocity.signum() };
        self.velocities().zip(stopped).map(one).collect()
    }

    /// Records an event after which these phases are possible, and begins the one that is taken.
    fn tell(&mut self, causes: Vec<Cause>, successors: Continuations, taken: Option<usize>) {
        let phase = taken.map(|taken| successors.list[taken].phase.clone());
        if let Some(phase) = &phase {
            self.smooth.equations.follow(phase.hinges.iter().map(|hinge| hinge.force));
        }
        self.note(causes, phase, successors, taken);
    }

    fn note(
        &mut self,
        causes: Vec<Cause>,
        phase: Option<Phase>,
        successors: Continuations,
        taken: Option<usize>,
    ) {
        let time = self.smooth.time;
        let equations = &self.smooth.equations;
        let words = Words {
            mechanism: equations.mechanism,
            configuration: &equations.configuration,
            sliders: &equations.sliders,
        };
        let words = words.event(&causes, self.phase.as_ref(), phase.as_ref());
        let folds = causes.contains(&Cause::Folds);
        let Continuations { list: successors, left_out } = successors;
        let event = Event { time, causes, phase: phase.clone(), successors, left_out, taken, words };
        self.history.events.push(event);
        let goes_on = match (&phase, &self.phase) {
            (Some(one), Some(other)) => !folds && one.has_states_of(other),
            (one, other) => one.is_none() && other.is_none(),
        };
        if !goes_on {
            if let Some(interval) = self.history.phases.last_mut() {
                interval.to = time;
            }
            if let Some(phase) = &phase {
                let phase = phase.clone();
                self.history.phases.push(PhaseInterval { phase, from: time, to: time });
            }
        }
        self.phase = phase;
    }

    /// Returns whether the last events came within a very short time; bouncing at a stop and rocking come to rest by themselves.
    fn accumulates(&self) -> bool {
        let events = &self.history.events;
        let Some(first) = events.len().checked_sub(CROWD) else { return false };
        let hits = |cause: &Cause| matches!(cause, Cause::Hits { .. } | Cause::Lands { .. });
        let bounces = events[first..].iter().any(|event| event.causes.iter().any(hits));
        !bounces && self.smooth.time - events[first].time < SHORT * self.smooth.time_scale()
    }
}

/// Without the phases that have just come to their end: in which all joints stick that cannot any longer, or
/// whose determinant vanishes.
fn without_ended(
    equations: &Equations<'_>,
    successors: &mut Vec<Continuation>,
    causes: &[Cause],
    previous: Option<&Phase>,
) {
    let Some(previous) = previous else { return };
    let mechanism = equations.mechanism;
    let stuck = |phase: &Phase| {
        let open = |phase: &Phase| phase.open(mechanism);
        phase.joints_and_hinges().eq(previous.joints_and_hinges()) && open(phase) == open(previous)
    };
    if causes.contains(&Cause::Slips) {
        successors.retain(|successor| !stuck(&successor.phase));
    }
    let pattern = previous.pattern(equations.mechanism);
    let same = |phase: &Phase| stuck(phase) && phase.pattern(equations.mechanism) == pattern;
    if causes.contains(&Cause::Locks) {
        successors.retain(|successor| !same(&successor.phase));
    }
    if causes.contains(&Cause::Folds) {
        successors.retain(|successor| !(same(&successor.phase) && is_near(&successor.phase, equations)));
    }
}

/// Whether the forces of the hinges that turn have nearly the directions in which they acted last.
fn is_near(phase: &Phase, equations: &Equations<'_>) -> bool {
    let hinges = phase.hinges.iter().zip(equations.directions());
    let mut turning = hinges.filter(|(hinge, _)| hinge.state != JointPhase::Sticking);
    turning.all(|(hinge, [x, y])| {
        let [along, length] = [hinge.force[0] * x + hinge.force[1] * y, hinge.force[0].hypot(hinge.force[1])];
        along >= (1.0 - NEAR_FOLD) * length
    })
}

/// The first of the phases in which the fewest joints stick.
fn fewest_sticking(successors: &[Continuation]) -> usize {
    let sticking = |successor: &Continuation| {
        successor.phase.joints_and_hinges().filter(|joint| *joint == JointPhase::Sticking).count()
    };
    (0..successors.len()).min_by_key(|index| sticking(&successors[*index])).unwrap_or(0)
}
