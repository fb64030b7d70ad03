//! The report of a motion: plain data, which are the JSON output.

use super::end::end_in_words;
use super::series::Series;
use crate::choice::kinds;
use crate::configuration::{Configuration, unit};
use crate::ids::ContactId;
use crate::mechanism::{Mechanism, Pad};
use crate::motion::decision::rules::Continuation;
use crate::motion::decision::verdict_on;
use crate::motion::moving::cause::{Cause, CauseKind};
use crate::motion::moving::energy::{kinetic, potential};
use crate::motion::options::SimulateOptions;
use crate::motion::record::event::{Event, modes_in_words};
use crate::motion::record::history::{End, Energy, History, PhaseInterval, Reader};
use crate::pattern::phase::JointPhase;
use crate::report::{CoordinateState, ModelSummary, Verdict};
use serde::Serialize;
use std::sync::Arc;

/// Version of the layout of a [`SimulateReport`]; it changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/simulate/1";

/// A motion in time.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SimulateReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// Summary of the model.
    pub model: ModelSummary,
    /// The names of the contacts, in the order of their signs in modes.
    pub contacts: Vec<String>,
    /// The names of the hinges with friction, whose signs follow those of the contacts in modes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hinges: Vec<String>,
    /// Relative error permitted for each step.
    pub tolerance: f64,
    /// When it begins (s).
    pub start: f64,
    /// When it was requested to end (s).
    pub until: f64,
    /// When it actually ends (s).
    pub stop: f64,
    /// Coordinates and rates at the start.
    pub initial: Vec<CoordinateState>,
    /// Number of steps in which the initial positions were followed from the drawing, each step proven to
    /// stay on its assembly branch; absent if the positions are those of the drawing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_from_drawing: Option<usize>,
    /// Coordinates and rates at the end.
    pub last: Vec<CoordinateState>,
    /// What happened, in chronological order.
    pub events: Vec<EventReport>,
    /// The phases, in chronological order.
    pub phases: Vec<PhaseReport>,
    /// How it ends.
    pub end: EndReport,
    /// Suggestions for a better model, in words.
    pub hints: Vec<String>,
    /// Where the energy went.
    pub energy: EnergyReport,
    /// The greatest violation of the joints before each projection: of positions, in sizes of the mechanism
    /// or rad.
    pub position_drift: f64,
    /// The same for velocities, per second.
    pub velocity_drift: f64,
    /// Computational cost.
    pub statistics: StatisticsReport,
    /// The motion as a table, if requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<Series>,
}

/// Something that happened at an instant.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EventReport {
    /// When (s).
    pub time: f64,
    /// All simultaneous causes.
    pub causes: Vec<CauseReport>,
    /// What happened, in words.
    pub words: String,
    /// The mode that follows; absent if the motion ends.
    pub mode: Option<String>,
    /// Whether a real mechanism can follow that mode; absent if the motion ends, and where it was not computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub attainable: Option<Verdict>,
    /// All possible modes, in order of preference, if there were several.
    pub branches: Vec<BranchReport>,
    /// Whether further modes, in which fewer joints stick, may be possible: there are too many states to try
    /// all.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub branches_left_out: bool,
    /// Energy lost in impulses (J).
    pub energy_lost: f64,
}

/// Why a phase ended, or what is to be reported.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CauseReport {
    /// The kind of cause.
    pub kind: CauseKind,
    /// The joint, contact or function.
    pub of: Option<String>,
}

/// A mode in which the motion could continue.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BranchReport {
    /// Its number, counted from 1.
    pub number: usize,
    /// The mode.
    pub mode: String,
    /// Where each sliding joint touches its guide in it, or that it sticks.
    pub words: String,
    /// Whether it was taken.
    pub taken: bool,
    /// Whether it continues the motion without a jump in the forces.
    pub continues: bool,
    /// Whether a real mechanism can follow it.
    pub attainable: Verdict,
}

/// A phase and its time span.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PhaseReport {
    /// Its start (s).
    pub from: f64,
    /// Its end (s).
    pub to: f64,
    /// The mode: for each contact `+` or `-`, `0` in a preload gap, `=` where its joint sticks; then for each hinge with
    /// friction `+` or `-` for the sense in which its first body turns against the second, `=` where it sticks.
    pub mode: String,
    /// For each sliding joint the sign of its velocity, 0 where it sticks.
    pub sliding: Vec<i8>,
    /// For each hinge with friction the sign of its angular velocity, 0 where it sticks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub turning: Vec<i8>,
}

kinds! {
    End =>
    /// Why a motion ends.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
    #[serde(rename_all = "snake_case")]
    #[non_exhaustive]
    pub enum EndKind {
        /// The requested time has been reached.
        Finished,
        /// A joint reaches a limit of its travel.
        TravelLimit,
        /// A block leaves its guide.
        OverlapVanished,
        /// A contact that was open reaches the line of its face beyond the ends of the face.
        BesideFace,
        /// A contact lifts off in space, and its body leaves the plane of its motion.
        OutOfPlane,
        /// A corner reaches a face where the model has no contact.
        BareCorner,
        /// A normal force reaches its limit.
        ReactionLimit,
        /// An event of the model that stops the motion.
        UserEvent,
        /// The requested branch does not exist.
        NoSuchBranch,
        /// A guided slider tips.
        Tips,
        /// At rest, neither sticking nor sliding is possible.
        NoContinuation,
        /// It jams, and no impulse leads to a state from which it can continue.
        Jammed,
        /// Events come closer and closer together.
        Accumulation,
        /// The permitted number of steps is reached.
        StepLimit,
        /// The permitted number of events is reached.
        EventLimit,
        /// A load or drive has no value.
        NoValue,
        /// What follows cannot be decided.
        Undecided,
        /// It was interrupted.
        Interrupted,
    }
}

/// How a motion ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EndReport {
    /// Why it ends.
    pub kind: EndKind,
    /// In words.
    pub words: String,
    /// Whether friction locks the mechanism, so that it cannot continue to move.
    pub locked: bool,
}

/// Where the energy went (J).
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EnergyReport {
    /// Kinetic energy at the start and at the end.
    pub kinetic: [f64; 2],
    /// Potential energy at the start and at the end.
    pub potential: [f64; 2],
    /// Dissipated by the friction of each contact.
    pub friction: Vec<Named>,
    /// Dissipated by the friction of each hinge that has some.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hinges: Vec<Named>,
    /// Work of each load other than constant springs; of a pad what its damper takes, as a negative number.
    pub loads: Vec<Named>,
    /// The part of the potential energy that the spring of each pad stores at the end.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pads: Vec<Named>,
    /// Work of each drive.
    pub drives: Vec<Named>,
    /// Lost in impulses.
    pub impulses: f64,
    /// The greatest error of the energy balance at any step.
    pub error: f64,
    /// That error relative to the greatest kinetic energy, work or dissipation; null if these are no greater
    /// than the error, because they are only rounding.
    pub relative_error: Option<f64>,
}

/// A number with its name.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Named {
    /// Its name.
    pub name: String,
    /// J
    pub value: f64,
}

impl Named {
    /// The name and the number.
    pub(super) fn parts(&self) -> (&str, f64) {
        (&self.name, self.value)
    }
}

/// Cost of a simulation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct StatisticsReport {
    /// Steps that were accepted.
    pub steps: usize,
    /// Steps that were repeated with a shorter length.
    pub repeated: usize,
    /// Evaluations of the equations.
    pub evaluations: u64,
    /// Events.
    pub events: usize,
    /// Unproven rest under loads that vary with time, if there is any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sampled: Option<SampledReport>,
}

/// Rest that was not proven, but checked at four times in each step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SampledReport {
    /// Total duration (s).
    pub time: f64,
    /// The longest step (s).
    pub longest_step: f64,
}

/// The report of a motion that was simulated with these options.
pub fn report(history: &History, options: &SimulateOptions) -> SimulateReport {
    let mechanism = &history.mechanism;
    let (last, energies) = history.at_end();
    let events = event_reports(history);
    SimulateReport {
        schema: SCHEMA,
        model: ModelSummary {
            title: mechanism.title.clone(),
            degrees_of_freedom: mechanism.coordinates.len(),
            bodies: mechanism.bodies.len(),
            contacts: mechanism.contacts.len(),
            drives: mechanism.drives.len(),
            size: mechanism.size,
            units: mechanism.units.clone(),
        },
        contacts: mechanism.contacts.iter().map(|contact| contact.name.to_string()).collect(),
        hinges: names_of_hinges(mechanism),
        tolerance: options.tolerance,
        start: history.start(),
        until: history.start() + options.duration,
        stop: history.stop(),
        initial: state(history, &history.initial),
        steps_from_drawing: history.initial.steps_from_drawing(),
        last: state(history, &last),
        phases: phases(history),
        end: end_report(history, options, &events),
        hints: hints(history),
        energy: energy(history, (&last, &energies)),
        position_drift: history.drift.position,
        velocity_drift: history.drift.velocity,
        statistics: StatisticsReport {
            steps: history.statistics.steps,
            repeated: history.statistics.rejected,
            evaluations: history.statistics.evaluations,
            events: events.len(),
            sampled: (history.statistics.sampled > 0.0).then_some(SampledReport {
                time: history.statistics.sampled,
                longest_step: history.statistics.sampled_step,
            }),
        },
        events,
        samples: None,
    }
}

/// The names of the hinges with friction.
fn names_of_hinges(mechanism: &Mechanism) -> Vec<String> {
    (0..mechanism.friction_circles.len()).map(|circle| mechanism.circle_name(circle)).collect()
}

/// A load that jumps with a rate is friction without a state of rest; a limit on normal forces does not
/// detect those that are not determined.
fn hints(history: &History) -> Vec<String> {
    let mechanism = &history.mechanism;
    let relations = mechanism.relations().into_iter();
    let mut loads: Vec<String> = relations
        .filter(|relation| relation.kind.jumps && relation.kind.of_rates)
        .map(|relation| relation.owner.to_string())
        .collect();
    loads.dedup();
    let hint = |load: String| {
        format!(
            "{load} jumps where a rate passes zero, as friction does, but cannot hold anything at rest: where the motion stops, steps become ever shorter. Give the joint friction of its own (`mu`, `mu_static`, preload) instead."
        )
    };
    let mut hints: Vec<String> = loads.into_iter().map(hint).collect();
    if !history.undetermined.is_empty() {
        let name = |contact: &ContactId| mechanism.contacts[contact.index()].name.to_string();
        let names: Vec<String> = history.undetermined.iter().map(name).collect();
        hints.push(format!(
            "while joints stick, statics does not determine the normal forces of {}; the limit on normal forces is not checked for them then.",
            names.join(", ")
        ));
    }
    hints
}

fn state(history: &History, configuration: &Configuration) -> Vec<CoordinateState> {
    let values = configuration.coordinates.iter().zip(&configuration.rates);
    let coordinates = history.mechanism.coordinates.iter().zip(values);
    coordinates
        .map(|(coordinate, (value, rate))| CoordinateState {
            name: coordinate.name.to_string(),
            unit: unit(&coordinate.kind),
            value: *value,
            rate: *rate,
        })
        .collect()
}

fn end_report(history: &History, options: &SimulateOptions, events: &[EventReport]) -> EndReport {
    let locked =
        matches!(history.end, End::NoContinuation | End::Jammed | End::Tips(_) | End::ReactionLimit(_));
    let follows = |verdict: Verdict| events.iter().any(|event| event.attainable == Some(verdict));
    let mut words = end_in_words(history, options);
    if follows(Verdict::Unattainable) {
        words += " On the way it is in an unstable state, which a real mechanism leaves.";
    } else if follows(Verdict::Flutter) {
        words += " On the way it may vibrate by itself (flutter) unless its contacts are damped.";
    }
    EndReport { kind: history.end.kind(), words, locked }
}

fn event_reports(history: &History) -> Vec<EventReport> {
    let mut reader = history.reader();
    let reported = history.events.iter().filter(|event| event.is_reported());
    reported.map(|event| event_report(history, event, &mut reader)).collect()
}

/// The verdict on what follows an event: that of the decision, where it found one.
fn attainable(history: &History, event: &Event, reader: &mut Reader<'_>) -> Option<Verdict> {
    let decided = event.taken.and_then(|taken| event.successors.get(taken)).map(|taken| taken.verdict);
    let verdict = match (decided, &event.phase) {
        (Some(verdict), _) if verdict != Verdict::NotComputed => verdict,
        (_, Some(phase))
            if !phase.is_at_rest(&history.mechanism) && phase.open(&history.mechanism).is_empty() =>
        {
            verdict_on(&history.mechanism, reader.configuration(event.time)?, phase)
        }
        _ => Verdict::NotComputed,
    };
    (verdict != Verdict::NotComputed).then_some(verdict)
}

fn event_report(history: &History, event: &Event, reader: &mut Reader<'_>) -> EventReport {
    let mechanism = &history.mechanism;
    let attainable = attainable(history, event, reader);
    let branches = if event.successors.len() > 1 { branches(history, event, reader) } else { Vec::new() };
    let lost = event.causes.iter().map(|cause| match cause {
        Cause::Jams { energy_lost } => *energy_lost,
        Cause::Hits { energy_lost, .. } | Cause::Lands { energy_lost, .. } => energy_lost.unwrap_or(0.0),
        _ => 0.0,
    });
    EventReport {
        time: event.time,
        causes: event
            .causes
            .iter()
            .map(|cause| CauseReport {
                kind: cause.kind(),
                of: cause.subject(mechanism).map(ToOwned::to_owned),
            })
            .collect(),
        words: event.words.clone(),
        mode: event.phase.as_ref().map(|phase| phase.pattern(mechanism)),
        attainable,
        branches,
        branches_left_out: event.left_out,
        energy_lost: lost.sum(),
    }
}

/// The modes in which the motion could go on after an event.
/// How the words of a branch begin that an impulse without collision begins.
pub(super) const JAMS: &str = "it jams: an impulse stops it";

fn branches(history: &History, event: &Event, reader: &mut Reader<'_>) -> Vec<BranchReport> {
    let mechanism = &history.mechanism;
    let configuration = reader.configuration(event.time).unwrap_or(&history.initial);
    let words = |successor: &Continuation| {
        let words = modes_in_words(mechanism, configuration, &successor.phase);
        match &successor.impulse {
            None => words,
            Some(impulse) => {
                let lost = mechanism.units.of("J").brief(impulse.energy_lost);
                format!("{JAMS} and dissipates {lost}; {words}")
            }
        }
    };
    let branch = |(index, successor): (usize, &Continuation)| BranchReport {
        number: index + 1,
        mode: successor.phase.pattern(mechanism),
        words: words(successor),
        taken: event.taken == Some(index),
        continues: successor.continues,
        attainable: successor.verdict,
    };
    event.successors.iter().enumerate().map(branch).collect()
}

fn phases(history: &History) -> Vec<PhaseReport> {
    let one = |interval: &PhaseInterval| PhaseReport {
        from: interval.from,
        to: interval.to,
        mode: interval.phase.pattern(&history.mechanism),
        sliding: interval.phase.joints.iter().map(|joint| sign(*joint)).collect(),
        turning: interval.phase.hinges.iter().map(|hinge| sign(hinge.state)).collect(),
    };
    history.phases.iter().map(one).collect()
}

/// The sign of a velocity, 0 where a joint sticks.
fn sign(joint: JointPhase) -> i8 {
    match joint {
        JointPhase::Sliding(sign) if sign < 0.0 => -1,
        JointPhase::Sliding(_) => 1,
        JointPhase::Sticking => 0,
    }
}

fn energy(history: &History, (last, stop): (&Configuration, &Energy)) -> EnergyReport {
    let mechanism = &history.mechanism;
    // Before any impulse at the start.
    let initial = &history.initial;
    let named = |names: Vec<String>, values: &[f64]| {
        names.into_iter().zip(values).map(|(name, value)| Named { name, value: *value }).collect()
    };
    let contacts = mechanism.contacts.iter().map(|contact| contact.name.to_string()).collect();
    let loads = mechanism.loads.iter().map(|load| load.name.to_string()).collect();
    let drives = mechanism.drives.iter().map(|drive| drive.name.to_string()).collect();
    let stored = |(name, pad): (&Arc<str>, &Pad)| Named {
        name: name.to_string(),
        value: pad.elastic(last.depth(mechanism, pad))[0],
    };
    EnergyReport {
        kinetic: [kinetic(mechanism, initial), stop.kinetic],
        potential: [potential(mechanism, initial), stop.potential],
        friction: named(contacts, &stop.friction),
        hinges: named(names_of_hinges(mechanism), &stop.hinges),
        loads: named(loads, &stop.loads),
        drives: named(drives, &stop.drives),
        pads: mechanism.pads().map(stored).collect(),
        impulses: stop.impulses,
        error: history.energy_error,
        relative_error: match (history.energy_error, history.energy_scale) {
            (0.0, _) => Some(0.0),
            (error, scale) if error < scale => Some(error / scale),
            _ => None,
        },
    }
}
