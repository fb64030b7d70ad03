//! Why a motion ends, as a kind and as a sentence.

use super::stick_slip::stick_slip;
use crate::fault::{Fault, FaultKind};
use crate::ids::JointId;
use crate::motion::moving::cause::Cause;
use crate::motion::options::SimulateOptions;
use crate::motion::record::event::{Event, is_wedged, moving};
use crate::motion::record::history::{End, History, PhaseInterval};
use crate::report::{SHOWN_BY, capital, it_tips};

/// The end in a sentence, and that a block tips on the way.
pub(super) fn end_in_words(history: &History, options: &SimulateOptions) -> String {
    let end = end(history, options);
    tipping(history).map_or(end.clone(), |tips| format!("{end} {tips}"))
}

/// "It tips (shoes) from 0 s on.", "It tips (shoes), first at 0.2 s."; none where nothing does, or the end says so.
fn tipping(history: &History) -> Option<String> {
    let mechanism = &history.mechanism;
    let tipped = |interval: &PhaseInterval| {
        let is_closed = |k: usize| !interval.phase.is_open(mechanism, k);
        // What rattles between both faces of its guide does not tip.
        let is_loose =
            |k: usize| mechanism.slider(mechanism.contacts[k].joint).is_some_and(|slider| slider.loose);
        mechanism.tipped_where(|k| (mechanism.contacts[k].opens && !is_loose(k)).then(|| is_closed(k)))
    };
    let ends = matches!(history.end, End::OutOfPlane(_) | End::Tips(_));
    let mut later = history.phases.iter().map(|interval| (interval.from, tipped(interval)));
    let (from, joints) = later.find(|(_, joints)| !joints.is_empty()).filter(|_| !ends)?;
    let (tips, at) = (capital(&it_tips(&joints)), mechanism.units.of("s").brief(from));
    let goes_on = later.all(|(_, joints)| !joints.is_empty());
    Some(if goes_on { format!("{tips} from {at} on.") } else { format!("{tips}, first at {at}.") })
}

fn end(history: &History, options: &SimulateOptions) -> String {
    let mechanism = &history.mechanism;
    let time = history.mechanism.units.of("s").brief(history.stop());
    let joint = |joint: &JointId| &mechanism.joints[joint.index()].name;
    match &history.end {
        End::Finished => finished(history, &time),
        End::TravelLimit(id) if mechanism.leaves_its_face(*id) => {
            format!("It ends at {time}: {} reaches the end of its face.", moving(mechanism, *id))
        }
        End::TravelLimit(id) => format!(
            "It ends at {time}: {} reaches the end of its travel{}, and {} has no stop there.",
            moving(mechanism, *id),
            at_speed(history, *id),
            joint(id)
        ),
        End::OverlapVanished(id) => {
            format!("It ends at {time}: {} leaves its guide.", moving(mechanism, *id))
        }
        End::BesideFace(id) => format!(
            "It ends at {time}: {} passes the line of its face beyond its end, and what it meets there is not in the model.",
            mechanism.contacts[id.index()].name
        ),
        End::OutOfPlane(id) => {
            let contact = &mechanism.contacts[id.index()];
            let body = moving(mechanism, contact.joint);
            format!(
                "It tips at {time}: {} lifts off, and {body} leaves the plane of its motion, where it is not followed.",
                contact.name
            )
        }
        End::BareCorner { wanted } => format!(
            "It ends at {time}: {}, where the model has no contact. Add a `{wanted}` there, with its `face` and \
             `closed = false`.",
            last_words(history)
        ),
        End::ReactionLimit(id) => format!(
            "It ends at {time}: the normal force of {} reaches its limit, which counts as a jam.",
            mechanism.contacts[id.index()].name
        ),
        End::UserEvent(_) => format!("It ends at {time}, as the model asks: {}.", last_words(history)),
        End::NoSuchBranch { branching } => format!(
            "It ends at {time}: at decision {branching} there is no branch with the number asked for."
        ),
        End::Tips(id) => {
            format!("It ends at {time}: {}, {SHOWN_BY}.", it_tips(&[joint(id).to_string()]))
        }
        End::NoContinuation => format!("It ends at {time}: it can neither stick nor start to slide."),
        End::Jammed if history.stop() == history.start() => {
            format!("It jams at once, at {time}: no motion can follow, not even after an impulse.")
        }
        End::Jammed => format!("It jams at {time}: no motion can follow, not even after an impulse."),
        End::Accumulation => format!("It ends at {time}: events follow each other faster and faster."),
        End::StepLimit => format!(
            "Not finished: it was followed to {time}, in {} steps, the most allowed. The equations are stiff there, or the \
             tolerance is small.",
            options.most_steps
        ),
        End::EventLimit => format!(
            "Not finished: it was followed to {time}, over {} events, the most allowed.",
            options.most_events
        ),
        End::NoValue(faults) => format!("It ends at {time}: {}.", first(faults)),
        End::Undecided(faults) if faults.sorted().first().copied().is_some_and(is_blocked) => {
            format!("It ends at {time}: {}.", first(faults))
        }
        End::Undecided(faults) => format!("Not decided what follows after {time}: {}.", first(faults)),
        End::Interrupted => {
            format!("Not finished: it was followed to {time}, then interrupted. Allow it more time.")
        }
    }
}

/// The end of a motion that was followed to the requested time: whether it is at rest, and since when.
fn finished(history: &History, time: &str) -> String {
    let jams: Vec<f64> = history.events.iter().filter(|event| jams(event)).map(|event| event.time).collect();
    // What sticks may turn about the corner with which it does; what has no friction never sticks.
    let is_still = history.last.is_still;
    let rest = history.phases.last().filter(|interval| is_still && interval.phase.sticks());
    let Some(rest) = rest else {
        let jams = jams_on_the_way(jams.len());
        if is_still {
            return format!("Nothing moves at {time}.{jams}");
        }
        let repeats = stick_slip(history).map_or(String::new(), |words| words + " ");
        return format!("{repeats}It is still moving at {time}.{jams}");
    };
    let from = history.mechanism.units.of("s").brief(rest.from);
    if jams.last() == Some(&rest.from) {
        let before = jams_on_the_way(jams.len() - 1);
        return format!("It jams at {from} and stays at rest until {time}.{before}");
    }
    let jams = jams_on_the_way(jams.len());
    if rest.from <= history.start() {
        return format!("It stays at rest until {time}{}.{jams}", held_by_drives(history));
    }
    let wedged = is_wedged(&history.mechanism, &rest.phase);
    let wedged = if wedged { ", wedged between both faces of its guide," } else { "" };
    format!("It comes to rest at {from}{wedged} and stays so until {time}.{jams}")
}

/// ", as the drive motor prescribes", where drives prescribe all motion: what rests then does so with or without friction.
fn held_by_drives(history: &History) -> String {
    let mechanism = &history.mechanism;
    let names: Vec<&str> = mechanism.drives.iter().map(|drive| &*drive.name).collect();
    match names.as_slice() {
        [] => String::new(),
        all if all.len() < mechanism.coordinates.len() => String::new(),
        [one] => format!(", as the drive {one} prescribes"),
        several => format!(", as the drives {} prescribe", several.join(", ")),
    }
}

/// " with 628 mm/s", of the last state.
fn at_speed(history: &History, joint: JointId) -> String {
    let mechanism = &history.mechanism;
    let Some(slider) = mechanism.slider(joint) else { return String::new() };
    let speed = history.at_end().0.sliding(mechanism, slider).1.abs();
    format!(" with {}", mechanism.units.of("m/s").brief(speed))
}

fn jams(event: &Event) -> bool {
    event.causes.iter().any(|cause| matches!(cause, Cause::Jams { .. }))
}

fn jams_on_the_way(jams: usize) -> String {
    match jams {
        0 => String::new(),
        1 => " It jams once on the way.".to_owned(),
        jams => format!(" It jams {jams} times on the way."),
    }
}

/// The words of the last event.
fn last_words(history: &History) -> &str {
    history.events.last().map_or("an event", |event| &event.words)
}

/// Whether a drive meets what stops it.
fn is_blocked(fault: &Fault) -> bool {
    matches!(fault.kind, FaultKind::DriveBlocked { .. })
}

fn first(faults: &crate::fault::Faults) -> String {
    faults.sorted().first().map_or_else(String::new, |fault| fault.kind.to_string())
}
