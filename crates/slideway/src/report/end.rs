//! The ends of modes.

use serde::Serialize;
use slideway_modes::existence::EndCause;

/// The cause of the end of a mode where something is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ModeEndCause {
    /// Nothing: it lasts however much friction grows.
    Nothing,
    /// The range that was looked at.
    Range,
    /// Its determinant vanishes, so its normal forces grow without bound, and beyond there is no solution:
    /// friction locks the mechanism.
    Locking,
    /// Its determinant vanishes, so its normal forces grow without bound, but beyond there is another solution.
    WithoutBound,
    /// A normal force vanishes: a contact changes side.
    SideChange,
    /// A normal force vanishes: a contact that was closed lifts off.
    LiftsOff,
    /// The acceleration of a gap vanishes: a contact that opened stays closed.
    Touches,
    /// A preload gap closes.
    GapCloses,
    /// A guided slider tips.
    Tipping,
    /// A normal force reaches the greatest one that is allowed.
    GreatestReaction,
    /// Two solutions merge.
    Fold,
    /// The force of a hinge with friction vanishes.
    HingeUnloaded,
    /// It was not followed any further.
    NotFollowed,
    /// Sliding or turning reverses.
    Reversal,
    /// Beyond there is no mode problem: the mechanism cannot be assembled or solved, or the model is not
    /// allowed.
    NoModeProblem,
}

impl ModeEndCause {
    /// Its name in words, as "side change".
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Range => "range",
            Self::Locking => "it jams",
            Self::WithoutBound => "grows without bound",
            Self::SideChange => "side change",
            Self::LiftsOff => "lifts off",
            Self::Touches => "touches",
            Self::GapCloses => "gap closes",
            Self::Tipping => "it tips",
            Self::GreatestReaction => "greatest reaction",
            Self::Fold => "fold",
            Self::HingeUnloaded => "hinge force vanishes",
            Self::NotFollowed => "not followed",
            Self::Reversal => "reversal",
            Self::NoModeProblem => "no mode problem",
        }
    }
}

impl ModeEndCause {
    /// Words for contacts at an end by a change of side: "lifts off", or of several "lift off".
    pub fn of_contacts(self, several: bool) -> &'static str {
        match (self, several) {
            (Self::LiftsOff, true) => "lift off",
            (Self::LiftsOff, false) => "lifts off",
            (Self::Touches, true) => "stay closed",
            (Self::Touches, false) => "stays closed",
            (_, true) => "change side",
            (_, false) => "changes side",
        }
    }

    /// Of the contacts of an end by a change of side those that the cause is said of: where some lift off, these, and else those
    /// that touch, if there are any.
    pub(crate) fn of_those(contacts: &[usize], closed: impl Fn(usize) -> Option<bool>) -> Vec<usize> {
        let are = |state| contacts.iter().copied().filter(|&k| closed(k) == Some(state)).collect::<Vec<_>>();
        let said = [are(true), are(false)].into_iter().find(|contacts| !contacts.is_empty());
        said.unwrap_or_else(|| contacts.to_vec())
    }

    /// The cause of an end beyond which there is no solution at all, or another one; `closed` says of a contact that may
    /// lift off whether it is closed in the mode.
    pub(crate) fn new(
        cause: &EndCause,
        nothing_is_left: bool,
        closed: impl Fn(usize) -> Option<bool>,
    ) -> Self {
        match cause {
            // Others that change side there do so because it lifts off.
            EndCause::SideChange(contacts) if contacts.iter().any(|&k| closed(k) == Some(true)) => {
                Self::LiftsOff
            }
            EndCause::SideChange(contacts) if contacts.iter().any(|&k| closed(k) == Some(false)) => {
                Self::Touches
            }
            EndCause::Range => Self::Range,
            EndCause::Singular if nothing_is_left => Self::Locking,
            EndCause::Singular => Self::WithoutBound,
            EndCause::SideChange(_) => Self::SideChange,
            EndCause::GapCloses(_) => Self::GapCloses,
            EndCause::OutputBound(_) => Self::Tipping,
            EndCause::GreatestNormalForce(_) => Self::GreatestReaction,
            EndCause::Fold => Self::Fold,
            EndCause::HingeUnloaded(_) => Self::HingeUnloaded,
            EndCause::NotFollowed => Self::NotFollowed,
            EndCause::Reversal => Self::Reversal,
            EndCause::NoProblem => Self::NoModeProblem,
        }
    }
}
