//! How far a mechanism is from tipping as friction grows.

use super::margins::GROWING;
use crate::mechanism::Mechanism;
use crate::modes::ContactState;
use crate::modes::existence::{EndCause, Existence, ModeEnd, ModeInterval, is_same_end};

/// The modes in which nothing tips: a block that may lift off keeps all of its corners on its face, or none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Upright {
    /// Up to this factor of friction one of them exists without interruption, from the friction of the model on.
    pub(crate) until: f64,
    /// The joints that tip there; none where it jams, and where nothing happens.
    pub(crate) tips: Vec<String>,
}

impl Upright {
    /// None if no such mode exists now.
    pub(crate) fn of(existence: &Existence, mechanism: &Mechanism) -> Option<Self> {
        let mut modes: Vec<&ModeInterval> = upright(existence, mechanism).collect();
        modes.sort_by(|one, other| one.from.at.total_cmp(&other.from.at));
        let until = modes.iter().fold(None, |end: Option<f64>, mode| {
            let reached = end.unwrap_or(GROWING[0]);
            let (from, to) = (mode.from.at, mode.to.at);
            let goes_on = from <= reached || is_same_end(from, reached);
            if goes_on { Some(reached.max(to)) } else { end }
        })?;
        let there = modes.into_iter().filter(|mode| is_same_end(until, mode.to.at));
        let mut tips: Vec<String> =
            there.flat_map(|mode| tips_at_end(mechanism, (&mode.pattern, &mode.to))).collect();
        tips.sort_unstable();
        tips.dedup();
        Some(Self { until, tips })
    }
}

/// The modes in which nothing tips.
pub(crate) fn upright<'e>(
    existence: &'e Existence,
    mechanism: &'e Mechanism,
) -> impl Iterator<Item = &'e ModeInterval> {
    existence.modes.iter().filter(|mode| mechanism.tipped(&mode.pattern).is_empty())
}

/// The joints that tip where a mode ends.
pub(crate) fn tips_at_end(mechanism: &Mechanism, (pattern, end): (&[ContactState], &ModeEnd)) -> Vec<String> {
    match &end.cause {
        EndCause::OutputBound(bounds) => mechanism.guided_sliders(bounds),
        EndCause::SideChange(contacts) => mechanism.tipped_by(pattern, contacts),
        _ => Vec::new(),
    }
}
