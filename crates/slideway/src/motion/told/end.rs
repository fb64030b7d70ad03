//! Why a motion ends, as a kind and as a sentence.

use super::report::{EndKind, EndReport};
use crate::motion::moving::cause::Cause;
use crate::motion::options::SimulateOptions;
use crate::motion::record::history::{End, History};

/// How a motion ends.
pub(super) fn end_report(history: &History, options: &SimulateOptions) -> EndReport {
    let (kind, words) = end_in_words(history, options);
    let locked =
        matches!(history.end, End::NoContinuation | End::Jammed | End::Tips(_) | End::ReactionLimit(_));
    EndReport { kind, words, locked }
}

/// The kind of the end for reports, and a sentence.
fn end_in_words(history: &History, options: &SimulateOptions) -> (EndKind, String) {
    let mechanism = &history.mechanism;
    let time = history.mechanism.units.of("s").show(history.stop());
    let joint = |joint: &crate::ids::JointId| &mechanism.joints[joint.index()].name;
    match &history.end {
        End::Finished => (EndKind::Finished, finished(history, &time)),
        End::TravelLimit(id) => (
            EndKind::TravelLimit,
            format!("It ends at {time}, where {} reaches a limit of its travel.", joint(id)),
        ),
        End::OverlapVanished(id) => {
            (EndKind::OverlapVanished, format!("It ends at {time}, where {} leaves its guide.", joint(id)))
        }
        End::ReactionLimit(id) => {
            let contact = &mechanism.contacts[id.index()].name;
            let words = format!(
                "It ends at {time}: the normal force of {contact} has reached its limit, so the mechanism counts as locked."
            );
            (EndKind::ReactionLimit, words)
        }
        End::UserEvent(_) => (
            EndKind::UserEvent,
            format!("It ends at {time}, at an event that stops it: {}.", last_words(history)),
        ),
        End::NoSuchBranch { branching } => (
            EndKind::NoSuchBranch,
            format!("It ends at {time}: the branch requested at decision {branching} does not exist there."),
        ),
        End::Tips(id) => (
            EndKind::Tips,
            format!(
                "It ends at {time}: {} tips in its guide, which a guided slider cannot show: model it as a block slider.",
                joint(id)
            ),
        ),
        End::NoContinuation => (
            EndKind::NoContinuation,
            format!("It ends at {time}: at rest neither sticking nor sliding is possible."),
        ),
        End::Jammed => {
            let words = format!(
                "It ends at {time}: it jams, and no impulse leads to a state in which it can continue."
            );
            (EndKind::Jammed, words)
        }
        End::Accumulation => {
            let words = format!("It ends at {time}, where events come closer and closer together.");
            (EndKind::Accumulation, words)
        }
        End::StepLimit => {
            let words = format!(
                "It ends at {time}, after the {} steps that were permitted: the equations are stiff there, or the tolerance is small.",
                options.most_steps
            );
            (EndKind::StepLimit, words)
        }
        End::EventLimit => {
            let words =
                format!("It ends at {time}, after the {} events that were permitted.", options.most_events);
            (EndKind::EventLimit, words)
        }
        End::NoValue(faults) => (EndKind::NoValue, format!("It ends at {time}: {}.", first(faults))),
        End::Undecided(faults) => (
            EndKind::Undecided,
            format!("It ends at {time}: what follows cannot be decided: {}.", first(faults)),
        ),
        End::Interrupted => (EndKind::Interrupted, format!("It was interrupted at {time}.")),
    }
}

/// The end of a motion that was followed to the requested time: whether it is at rest, and since when.
fn finished(history: &History, time: &str) -> String {
    let jams = history.events.iter().flat_map(|event| &event.causes);
    let jams = match jams.filter(|cause| matches!(cause, Cause::Jams { .. })).count() {
        0 => String::new(),
        1 => " It has jammed once.".to_owned(),
        count => format!(" It has jammed {count} times."),
    };
    match history.phases.last() {
        Some(interval) if interval.phase.is_at_rest() => {
            let from = history.mechanism.units.of("s").show(interval.from);
            let joints = match (interval.phase.joints.is_empty(), interval.phase.hinges.is_empty()) {
                (_, true) => "all sliding joints",
                (true, false) => "all hinges with friction",
                (false, false) => "all sliding joints and hinges with friction",
            };
            format!("At {time} the end is reached; {joints} have been sticking since {from}.{jams}")
        }
        _ => {
            let bodies = 3 * history.mechanism.bodies.len();
            let moves = history.last.state[bodies..2 * bodies].iter().any(|velocity| *velocity != 0.0);
            let told = if moves { "it is still moving" } else { "nothing moves" };
            format!("At {time} the end is reached; {told}.{jams}")
        }
    }
}

/// The words of the last event.
fn last_words(history: &History) -> &str {
    history.events.last().map_or("an event", |event| &event.words)
}

fn first(faults: &crate::fault::Faults) -> String {
    faults.sorted().first().map_or_else(String::new, |fault| fault.kind.to_string())
}
