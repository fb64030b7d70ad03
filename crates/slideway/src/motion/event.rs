//! What happens between the phases of a motion, and in words.

use super::phase::{ContactPhase, JointPhase, Phase};
use super::rules::Successor;
use super::watch::Watched;
use crate::configuration::Configuration;
use crate::ids::{ContactId, JointId};
use crate::mechanism::Mechanism;
use crate::modes::Side;
use crate::report::number::number;
use crate::solve::mode_in_words;
use nalgebra::Vector2;
use serde::Serialize;

/// The words of an event that changes nothing.
pub(super) const NOTHING: &str = "it goes on as before";

/// Why a phase ends, or what is told.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// The motion begins.
    Start,
    /// The normal force of a contact has reached zero.
    NormalForceZero(ContactId),
    /// A contact leaves its preload gap, towards this side.
    PreloadGapEnds(ContactId, Side),
    /// The sliding velocity of a joint has reached zero.
    Stops(JointId),
    /// The joints that stick cannot do so any longer.
    Slips,
    /// The determinant of the mode has reached zero.
    Locks,
    /// The normal force of a contact has reached the limit.
    ReactionLimit(ContactId),
    /// The couple of a guided slider has reached what its pressure can give.
    Tips(JointId),
    /// A block leaves its guide.
    OverlapVanishes(JointId),
    /// A sliding joint has reached a limit of its travel: the greatest, or the least.
    TravelLimit {
        /// The joint.
        joint: JointId,
        /// Whether it is the greatest displacement.
        greatest: bool,
    },
    /// A sliding joint hits the stop at an end of its travel.
    Hits {
        /// The joint.
        joint: JointId,
        /// Whether it is the stop at the greatest displacement.
        greatest: bool,
        /// Kinetic energy that is lost (J); of joints that act on one another the first has that of all.
        energy_lost: Option<f64>,
    },
    /// A sliding joint meets the pad at an end of its travel, which begins to push.
    MeetsPad {
        /// The joint.
        joint: JointId,
        /// Whether it is the pad at the greatest displacement.
        greatest: bool,
    },
    /// A sliding joint leaves such a pad, which has ceased to push.
    LeavesPad {
        /// The joint.
        joint: JointId,
        /// Whether it is the pad at the greatest displacement.
        greatest: bool,
    },
    /// A load or drive jumps: a relation in its formula, or a table, passes to its next piece.
    LoadJumps(String),
    /// A function of the user has passed zero; its number and its name.
    User(usize, String),
    /// The mechanism could not go on moving: an impulse has stopped it, at a loss of kinetic energy (J).
    Jams {
        /// J
        energy_lost: f64,
    },
}

/// What an event tells of, in reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CauseKind {
    /// The motion begins.
    Start,
    /// A normal force vanishes.
    NormalForceZero,
    /// A preload gap closes.
    PreloadGapEnds,
    /// A joint stops sliding.
    Stops,
    /// Sticking joints begin to slip.
    Slips,
    /// The mode locks.
    Locks,
    /// A normal force reaches its limit.
    ReactionLimit,
    /// A guided slider tips.
    Tips,
    /// A block leaves its guide.
    OverlapVanishes,
    /// A joint reaches a limit of its travel.
    TravelLimit,
    /// A joint hits its stop.
    Hits,
    /// A joint meets the pad of its stop.
    MeetsPad,
    /// A joint leaves the pad of its stop.
    LeavesPad,
    /// A load or drive jumps.
    LoadJumps,
    /// A function that is watched vanishes.
    User,
    /// It jams, and an impulse acts.
    Jams,
}

impl Cause {
    /// The cause that a watched function is; none for relations, of which only jumps are told, and where it takes a decision to name it.
    pub(super) fn of(watched: Watched, sliders: &[JointId], names: impl Fn(usize) -> String) -> Option<Self> {
        Some(match watched {
            Watched::NormalForce(contact) => Self::NormalForceZero(contact),
            // The share of the positive face has vanished: the negative one presses.
            Watched::Share(contact, Side::Positive) => Self::PreloadGapEnds(contact, Side::Negative),
            Watched::Share(contact, Side::Negative) => Self::PreloadGapEnds(contact, Side::Positive),
            Watched::Between(contact, side) => Self::PreloadGapEnds(contact, side),
            Watched::Velocity(index, _) => Self::Stops(sliders[index]),
            Watched::Determinant => Self::Locks,
            Watched::ReactionLimit(contact) => Self::ReactionLimit(contact),
            Watched::Couple(joint) => Self::Tips(joint),
            Watched::Sticking => Self::Slips,
            Watched::Overlap(joint) => Self::OverlapVanishes(joint),
            Watched::Travel(joint, end) => Self::TravelLimit { joint, greatest: end > 0.0 },
            Watched::User(index, _) => Self::User(index, names(index)),
            Watched::Relation(_) | Watched::HeldReactions => return None,
        })
    }

    /// Its name in reports.
    pub fn kind(&self) -> CauseKind {
        match self {
            Self::Start => CauseKind::Start,
            Self::NormalForceZero(_) => CauseKind::NormalForceZero,
            Self::PreloadGapEnds(..) => CauseKind::PreloadGapEnds,
            Self::Stops(_) => CauseKind::Stops,
            Self::Slips => CauseKind::Slips,
            Self::Locks => CauseKind::Locks,
            Self::ReactionLimit(_) => CauseKind::ReactionLimit,
            Self::Tips(_) => CauseKind::Tips,
            Self::OverlapVanishes(_) => CauseKind::OverlapVanishes,
            Self::TravelLimit { .. } => CauseKind::TravelLimit,
            Self::Hits { .. } => CauseKind::Hits,
            Self::MeetsPad { .. } => CauseKind::MeetsPad,
            Self::LeavesPad { .. } => CauseKind::LeavesPad,
            Self::LoadJumps(_) => CauseKind::LoadJumps,
            Self::User(..) => CauseKind::User,
            Self::Jams { .. } => CauseKind::Jams,
        }
    }

    /// The joint, contact or function of which it tells.
    pub fn subject<'a>(&'a self, mechanism: &'a Mechanism) -> Option<&'a str> {
        match self {
            Self::NormalForceZero(contact)
            | Self::PreloadGapEnds(contact, _)
            | Self::ReactionLimit(contact) => Some(&mechanism.contacts[contact.index()].name),
            Self::Stops(joint)
            | Self::Tips(joint)
            | Self::OverlapVanishes(joint)
            | Self::TravelLimit { joint, .. }
            | Self::Hits { joint, .. }
            | Self::MeetsPad { joint, .. }
            | Self::LeavesPad { joint, .. } => Some(&mechanism.joints[joint.index()].name),
            Self::User(_, name) | Self::LoadJumps(name) => Some(name),
            Self::Start | Self::Slips | Self::Locks | Self::Jams { .. } => None,
        }
    }

    /// The contact whose normal force, or whose preload gap, has come to its end.
    pub(super) fn vanishing_contact(&self) -> Option<ContactId> {
        match self {
            Self::NormalForceZero(contact) | Self::PreloadGapEnds(contact, _) => Some(*contact),
            _ => None,
        }
    }

    /// Whether the phase cannot simply go on.
    pub(super) fn ends_phase(&self) -> bool {
        !matches!(self, Self::User(..) | Self::LeavesPad { .. })
    }
}

/// Something that happened at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// When (s).
    pub time: f64,
    /// Everything that came together.
    pub causes: Vec<Cause>,
    /// The phase that follows; nothing where the motion ends.
    pub phase: Option<Phase>,
    /// All phases that were possible, in their order.
    pub successors: Vec<Successor>,
    /// Whether some in which fewer joints stick may be missing: there are too many states to try all.
    pub left_out: bool,
    /// Which of them was taken.
    pub taken: Option<usize>,
    /// What happened, in words.
    pub words: String,
}

/// Tells events of a mechanism.
pub(super) struct Words<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) configuration: &'a Configuration,
    pub(super) sliders: &'a [JointId],
}

impl Words<'_> {
    /// What happens at an event between two phases.
    pub(super) fn event(&self, causes: &[Cause], before: Option<&Phase>, after: Option<&Phase>) -> String {
        let mut parts: Vec<String> = causes.iter().filter_map(|cause| self.cause(cause, after)).collect();
        if let Some(after) = after {
            match before {
                Some(before) => parts.extend(self.changes(causes, before, after)),
                None => parts.extend(self.sliders.iter().enumerate().map(|(index, joint)| {
                    format!("{} {}", self.name(*joint), self.state("is", index, *joint, after))
                })),
            }
        }
        if parts.is_empty() { NOTHING.to_owned() } else { parts.join("; ") }
    }

    fn cause(&self, cause: &Cause, after: Option<&Phase>) -> Option<String> {
        let told = match cause {
            Cause::Start | Cause::PreloadGapEnds(..) => return None,
            // The change of side is told instead.
            Cause::NormalForceZero(contact) => match after {
                Some(_) => return None,
                None => format!("the normal force of {} vanishes", self.contact(*contact)),
            },
            Cause::Stops(joint) => match after {
                Some(_) => return None,
                None => format!("{} stops", self.name(*joint)),
            },
            Cause::Slips => match after {
                Some(_) => return None,
                None => "what sticks can stick no longer".to_owned(),
            },
            Cause::Locks => "the contact mode locks: its determinant vanishes".to_owned(),
            Cause::ReactionLimit(contact) => {
                format!("the normal force of {} reaches its limit", self.contact(*contact))
            }
            Cause::Tips(joint) => format!("{} begins to tip in its guide", self.name(*joint)),
            Cause::OverlapVanishes(joint) => format!("{} leaves its guide", self.name(*joint)),
            Cause::TravelLimit { joint, greatest } => {
                format!("{} reaches the {} displacement of its travel", self.name(*joint), end(*greatest))
            }
            Cause::Hits { joint, greatest, energy_lost } => {
                let hits =
                    format!("{} hits the stop at its {} displacement", self.name(*joint), end(*greatest));
                match energy_lost {
                    Some(energy) => format!("{hits}, which takes {} J", number(*energy)),
                    None => format!("{hits} in the same impact"),
                }
            }
            Cause::MeetsPad { joint, greatest } => {
                format!("{} meets the pad at its {} displacement", self.name(*joint), end(*greatest))
            }
            Cause::LeavesPad { joint, greatest } => {
                format!("{} leaves the pad at its {} displacement", self.name(*joint), end(*greatest))
            }
            Cause::LoadJumps(name) => format!("{name} jumps"),
            Cause::User(_, name) => format!("{name} passes zero"),
            Cause::Jams { energy_lost } => {
                format!("it jams: an impulse stops it and takes {} J", number(*energy_lost))
            }
        };
        Some(told)
    }

    /// What differs between two phases, joint by joint.
    fn changes(&self, causes: &[Cause], before: &Phase, after: &Phase) -> Vec<String> {
        let one = |(index, joint): (usize, &JointId)| {
            let name = self.name(*joint);
            let stops = causes.contains(&Cause::Stops(*joint));
            let told = match (before.joints[index], after.joints[index]) {
                (JointPhase::Sliding(_), JointPhase::Sticking) => format!("{name} stops and sticks"),
                (JointPhase::Sticking, JointPhase::Sliding(_)) => {
                    format!("{name} starts to slide: it {}", self.state("is now", index, *joint, after))
                }
                (JointPhase::Sliding(old), JointPhase::Sliding(new)) if old != new => {
                    // Nothing happens where a joint without friction turns round: the next event tells.
                    let now = stops
                        || causes
                            .iter()
                            .any(|cause| matches!(cause, Cause::Hits { .. } | Cause::Jams { .. }));
                    let reverses = if now { "reverses" } else { "has reversed since the last event" };
                    format!("{name} {reverses}: it {}", self.state("is now", index, *joint, after))
                }
                (JointPhase::Sliding(_), JointPhase::Sliding(_)) => {
                    let slider = self.mechanism.slider(*joint)?;
                    let changed = slider
                        .contacts
                        .iter()
                        .any(|k| before.contacts[k.index()] != after.contacts[k.index()]);
                    if changed {
                        format!("{name} changes side: it {}", self.mode("is now", *joint, after))
                    } else if stops {
                        format!("{name} stands for an instant and slides on")
                    } else {
                        return None;
                    }
                }
                (JointPhase::Sticking, JointPhase::Sticking) => return None,
            };
            Some(told)
        };
        self.sliders.iter().enumerate().filter_map(one).collect()
    }

    /// What a sliding joint does: "is now on the upper side of the slot, sliding to the right".
    fn state(&self, verb: &str, index: usize, joint: JointId, phase: &Phase) -> String {
        match (phase.joints[index], self.mechanism.slider(joint)) {
            (JointPhase::Sliding(sign), Some(slider)) => {
                let tangent = self.configuration.slide(self.mechanism, slider).tangent;
                format!("{}, sliding {}", self.mode(verb, joint, phase), direction_in_words(tangent * sign))
            }
            _ => "sticks".to_owned(),
        }
    }

    /// Where a sliding joint touches its guide: "is now on the upper side of the slot".
    fn mode(&self, verb: &str, joint: JointId, phase: &Phase) -> String {
        let Some(slider) = self.mechanism.slider(joint) else { return String::new() };
        let sign = |contact: &ContactId| match phase.contacts[contact.index()] {
            ContactPhase::Pressed(Side::Positive) => 1,
            ContactPhase::Pressed(Side::Negative) => -1,
            ContactPhase::PreloadGap => 0,
        };
        let signs: Vec<i8> = slider.contacts.iter().map(sign).collect();
        let tangent = self.configuration.slide(self.mechanism, slider).tangent;
        let in_gap = |k: &&ContactId| phase.contacts[k.index()] == ContactPhase::PreloadGap;
        let gaps: Vec<&str> = slider.contacts.iter().filter(in_gap).map(|k| self.contact(*k)).collect();
        let mode = format!("{verb} {}", mode_in_words(slider, tangent, &signs));
        if gaps.is_empty() {
            mode
        } else {
            format!("{mode}, with the preload of {} between both faces", gaps.join(" and "))
        }
    }

    fn name(&self, joint: JointId) -> &str {
        &self.mechanism.joints[joint.index()].name
    }

    fn contact(&self, contact: ContactId) -> &str {
        &self.mechanism.contacts[contact.index()].name
    }
}

/// Which end of a travel.
fn end(greatest: bool) -> &'static str {
    if greatest { "greatest" } else { "least" }
}

/// Where something moves, as one looks at the drawing.
fn direction_in_words(direction: Vector2<f64>) -> &'static str {
    if direction.y.abs() > direction.x.abs() * (1.0 + 1e-9) {
        if direction.y > 0.0 { "up" } else { "down" }
    } else if direction.x > 0.0 {
        "to the right"
    } else {
        "to the left"
    }
}
