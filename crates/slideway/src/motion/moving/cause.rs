//! Why a phase ends.

use super::watch::Watched;
use crate::choice::kinds;
use crate::ids::{ContactId, JointId};
use crate::mechanism::Mechanism;
use crate::modes::Side;
use serde::Serialize;

/// Why a phase ends, or what is told.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// The motion begins.
    Start,
    /// The normal force of a contact has reached zero.
    NormalForceZero(ContactId),
    /// A contact leaves its preload gap, towards this side.
    PreloadGapEnds(ContactId, Side),
    /// A contact that was open reaches its face.
    Touches(ContactId),
    /// A contact lands on its face.
    Lands {
        /// The contact.
        contact: ContactId,
        /// How fast its gap closes before (m/s).
        speed: f64,
        /// Kinetic energy that is lost (J); of contacts that land together the first has that of all.
        energy_lost: Option<f64>,
    },
    /// A corner without contact reaches a face.
    BareCorner {
        /// Its name.
        corner: String,
        /// The joint whose face it is.
        joint: JointId,
        /// The type of a joint that gives it a contact.
        wanted: &'static str,
    },
    /// The sliding velocity of a joint has reached zero.
    Stops(JointId),
    /// The joints that stick cannot do so any longer.
    Slips,
    /// The angular velocity of a hinge with friction has reached zero.
    StopsTurning(JointId),
    /// The determinant of the mode has reached zero.
    Locks,
    /// With friction in hinges: the solution of the mode has met another one, and both have come to their end, while all
    /// forces are finite.
    Folds,
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
        /// How fast it arrives and how fast it bounces back (m/s).
        speeds: [f64; 2],
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

kinds! {
    Cause =>
    /// The name of the cause of an event in reports.
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
        /// A contact that was open reaches its face.
        Touches,
        /// A contact lands on its face.
        Lands,
        /// A corner without contact reaches a face.
        BareCorner,
        /// A joint stops sliding.
        Stops,
        /// Sticking joints begin to slip.
        Slips,
        /// A hinge with friction stops turning.
        StopsTurning,
        /// The mode locks.
        Locks,
        /// The solution of the mode ends at a fold.
        Folds,
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
}

impl Cause {
    /// The cause that a watched function is; none for relations, of which only jumps are told, and where it
    /// takes a decision to name it.
    pub(in crate::motion) fn of(
        watched: Watched,
        [sliders, hinges]: [&[JointId]; 2],
        names: impl Fn(usize) -> String,
    ) -> Option<Self> {
        Some(match watched {
            Watched::NormalForce(contact) => Self::NormalForceZero(contact),
            // The share of the positive face has vanished: the negative one presses.
            Watched::Share(contact, Side::Positive) => Self::PreloadGapEnds(contact, Side::Negative),
            Watched::Share(contact, Side::Negative) => Self::PreloadGapEnds(contact, Side::Positive),
            Watched::Between(contact, side) => Self::PreloadGapEnds(contact, side),
            Watched::Gap(contact) => Self::Touches(contact),
            Watched::Velocity(index, _) => Self::Stops(sliders[index]),
            Watched::Spin(hinge, _) => Self::StopsTurning(hinges[hinge]),
            Watched::Determinant => Self::Locks,
            Watched::ReactionLimit(contact) => Self::ReactionLimit(contact),
            Watched::Couple(joint) => Self::Tips(joint),
            Watched::Sticking | Watched::Room => Self::Slips,
            Watched::Overlap(joint) => Self::OverlapVanishes(joint),
            Watched::Travel(joint, end) => Self::TravelLimit { joint, greatest: end > 0.0 },
            Watched::User(index, _) => Self::User(index, names(index)),
            Watched::Relation(_) | Watched::HeldReactions | Watched::BareCorner(_) => return None,
        })
    }

    /// The joint, contact or function of which it tells.
    pub fn subject<'a>(&'a self, mechanism: &'a Mechanism) -> Option<&'a str> {
        match self {
            Self::NormalForceZero(contact)
            | Self::PreloadGapEnds(contact, _)
            | Self::Touches(contact)
            | Self::Lands { contact, .. }
            | Self::ReactionLimit(contact) => Some(&mechanism.contacts[contact.index()].name),
            Self::Stops(joint)
            | Self::StopsTurning(joint)
            | Self::Tips(joint)
            | Self::OverlapVanishes(joint)
            | Self::TravelLimit { joint, .. }
            | Self::Hits { joint, .. }
            | Self::MeetsPad { joint, .. }
            | Self::LeavesPad { joint, .. } => Some(&mechanism.joints[joint.index()].name),
            Self::User(_, name) | Self::LoadJumps(name) | Self::BareCorner { corner: name, .. } => Some(name),
            Self::Start | Self::Slips | Self::Locks | Self::Folds | Self::Jams { .. } => None,
        }
    }

    /// The contact whose normal force, or whose preload gap, has come to its end.
    pub(in crate::motion) fn vanishing_contact(&self) -> Option<ContactId> {
        match self {
            Self::NormalForceZero(contact) | Self::PreloadGapEnds(contact, _) => Some(*contact),
            _ => None,
        }
    }

    /// Whether the phase cannot simply go on.
    pub(in crate::motion) fn ends_phase(&self) -> bool {
        !matches!(self, Self::User(..) | Self::LeavesPad { .. })
    }
}
