//! How far a mechanism is from tipping as friction grows.

use crate::mechanism::Mechanism;
use crate::modes::existence::{EndCause, Existence, ModeEnd, ModeInterval, ends, is_same_end};

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
        Self::towards(existence, mechanism, ends_above, 1.0)
    }

    /// With less, down to none, where there is such a mode now; none if nothing happens.
    pub(crate) fn below(existence: &Existence, mechanism: &Mechanism) -> Option<Self> {
        let at_once = Self {
            until: FALLING[1],
            tips: tips_beyond((existence, mechanism), (FALLING[1], &EndCause::Range), -1.0),
        };
        let below = Self::towards(existence, mechanism, ends_below, -1.0);
        below.or(Some(at_once)).filter(|upright| upright.until > FALLING[0])
    }

    /// Ends are those near the friction of the model, and far from it; the way is up or down.
    fn towards(existence: &Existence, mechanism: &Mechanism, of: Ends, way: f64) -> Option<Self> {
        let mut modes: Vec<&ModeInterval> = upright(existence, mechanism).collect();
        let near = |mode: &ModeInterval| way * of(mode)[0].at;
        modes.sort_by(|one, other| near(one).total_cmp(&near(other)));
        let until = modes.iter().fold(None, |end: Option<f64>, mode| {
            let reached = end.unwrap_or(GROWING[0]);
            let [near, far] = of(mode).map(|end| end.at);
            let goes_on = way * near <= way * reached || is_same_end(near.max(reached), near.min(reached));
            if goes_on { Some(if way * far > way * reached { far } else { reached }) } else { end }
        })?;
        let there = modes.into_iter().map(|mode| of(mode)[1]);
        let there = there.filter(|end| is_same_end(until.max(end.at), until.min(end.at)));
        let tips =
            there.flat_map(|end| tips_beyond((existence, mechanism), (until, &end.cause), way)).collect();
        Some(Self { until, tips: distinct(tips) })
    }
}

/// The ends of a mode: the nearer one on the way and the farther one.
type Ends = fn(&ModeInterval) -> [&ModeEnd; 2];

/// On the way up.
fn ends_above(mode: &ModeInterval) -> [&ModeEnd; 2] {
    [&mode.from, &mode.to]
}

/// On the way down.
fn ends_below(mode: &ModeInterval) -> [&ModeEnd; 2] {
    [&mode.to, &mode.from]
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

/// What happens over a stretch between two ends of modes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Happens {
    /// There is a state in which nothing tips.
    Moves,
    /// These joints tip in every state; guided sliders, which have no such state, where there is no other.
    Tips(Vec<String>),
    /// No state is known.
    Nothing,
}

/// What happens between two neighbouring ends of modes. `same` says whether an end of a mode is one of them.
pub(crate) fn happens(
    (existence, mechanism): (&Existence, &Mechanism),
    [from, to]: [f64; 2],
    same: impl Fn(f64, f64) -> bool,
) -> Happens {
    let inside = if to.is_finite() { f64::midpoint(from, to) } else { 2.0 * from + 1.0 };
    let here = existence.modes.iter().filter(|mode| mode.from.at < inside && inside < mode.to.at);
    let tipped: Vec<Vec<String>> = here.map(|mode| mechanism.tipped(&mode.pattern)).collect();
    let is_empty = tipped.is_empty();
    let tips = if is_empty { guided(existence, mechanism, [from, to], same) } else { tipped };
    if tips.iter().any(Vec::is_empty) {
        return Happens::Moves;
    }
    match distinct(tips.concat()) {
        tips if tips.is_empty() => Happens::Nothing,
        tips => Happens::Tips(tips),
    }
}

/// The guided sliders that tip where modes end at the ends of a stretch without modes.
pub(crate) fn guided(
    existence: &Existence,
    mechanism: &Mechanism,
    [from, to]: [f64; 2],
    same: impl Fn(f64, f64) -> bool,
) -> Vec<Vec<String>> {
    let ends = existence.modes.iter().flat_map(|mode| [(&mode.to, from), (&mode.from, to)]);
    let here = ends.filter(|(end, at)| same(end.at.max(*at), end.at.min(*at)));
    here.filter_map(|(end, _)| match &end.cause {
        EndCause::OutputBound(bounds) => Some(mechanism.guided_sliders(bounds)),
        _ => None,
    })
    .collect()
}

/// The joints that tip just beyond a place where a mode ends in which nothing tips, up (1) or down (-1): the guided sliders that
/// end it, else what tips in the modes that go on. None where nothing goes on, as it jams, and where something else does.
fn tips_beyond(
    (existence, mechanism): (&Existence, &Mechanism),
    (at, cause): (f64, &EndCause),
    way: f64,
) -> Vec<String> {
    if let EndCause::OutputBound(bounds) = cause {
        return mechanism.guided_sliders(bounds);
    }
    let beyond = ends(&existence.modes).filter(|end| way * end > way * at);
    let beyond = beyond.filter(|end| !is_same_end(end.max(at), end.min(at)));
    let Some(next) = beyond.min_by(|one, other| (way * one).total_cmp(&(way * other))) else {
        return Vec::new();
    };
    match happens((existence, mechanism), [at.min(next), at.max(next)], is_same_end) {
        Happens::Tips(joints) => joints,
        Happens::Moves | Happens::Nothing => Vec::new(),
    }
}
