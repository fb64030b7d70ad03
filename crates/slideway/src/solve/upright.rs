//! How far a mechanism is from tipping as friction grows.

use crate::mechanism::Mechanism;
use crate::modes::ContactState;
use crate::modes::existence::{EndCause, Existence, ModeEnd, ModeInterval, is_same_end};

/// From the present friction without end, as a factor.
pub(crate) const GROWING: [f64; 2] = [1.0, f64::INFINITY];
/// From no friction to that of the model, as a factor.
pub(crate) const FALLING: [f64; 2] = [0.0, 1.0];

/// How far friction may change before something tips or it jams: a block that may lift off keeps all of its corners on its
/// face, or none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Upright {
    /// Up to this factor of friction a mode in which nothing tips exists without interruption, from the friction of the model
    /// on: the greatest factor with more friction, the least one with less.
    pub(crate) until: f64,
    /// The joints that tip there; none where it jams, and where nothing happens.
    pub(crate) tips: Vec<String>,
}

impl Upright {
    /// With more friction than in the model; none if no such mode exists now.
    pub(crate) fn of(existence: &Existence, mechanism: &Mechanism) -> Option<Self> {
        Self::towards(existence, mechanism, |mode| [&mode.from, &mode.to], 1.0)
    }

    /// With less, down to none, where there is such a mode now; none if nothing happens.
    pub(crate) fn below(existence: &Existence, mechanism: &Mechanism) -> Option<Self> {
        let at_once = Self { until: FALLING[1], tips: Vec::new() };
        let below = Self::towards(existence, mechanism, |mode| [&mode.to, &mode.from], -1.0);
        let mut below = below.or(Some(at_once)).filter(|upright| upright.until > FALLING[0])?;
        if below.tips.is_empty() {
            // It ends without a corner that lifts off: what tips in the modes that are left.
            let left = existence.modes.iter().filter(|mode| {
                let [from, to] = [mode.from.at, mode.to.at];
                from < below.until && (to >= below.until || is_same_end(below.until, to))
            });
            below.tips = distinct(left.flat_map(|mode| mechanism.tipped(&mode.pattern)).collect());
        }
        Some(below)
    }

    /// Ends are those near the friction of the model, and far from it; the way is up or down.
    fn towards(
        existence: &Existence,
        mechanism: &Mechanism,
        ends: impl Fn(&ModeInterval) -> [&ModeEnd; 2],
        way: f64,
    ) -> Option<Self> {
        let mut modes: Vec<&ModeInterval> = upright(existence, mechanism).collect();
        let near = |mode: &ModeInterval| way * ends(mode)[0].at;
        modes.sort_by(|one, other| near(one).total_cmp(&near(other)));
        let until = modes.iter().fold(None, |end: Option<f64>, mode| {
            let reached = end.unwrap_or(GROWING[0]);
            let [near, far] = ends(mode).map(|end| end.at);
            let goes_on = way * near <= way * reached || is_same_end(near.max(reached), near.min(reached));
            if goes_on { Some(if way * far > way * reached { far } else { reached }) } else { end }
        })?;
        let there = modes.into_iter().map(|mode| (mode, ends(mode)[1]));
        let there = there.filter(|(_, end)| is_same_end(until.max(end.at), until.min(end.at)));
        let tips = there.flat_map(|(mode, end)| tips_at_end(mechanism, (&mode.pattern, end))).collect();
        Some(Self { until, tips: distinct(tips) })
    }
}

/// Names in order, each once.
pub(crate) fn distinct(mut names: Vec<String>) -> Vec<String> {
    names.sort_unstable();
    names.dedup();
    names
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
