//! The margin at one value of what is varied.

use super::Against;
use super::level::level;
use crate::fault::{Fault, FaultKind, Faults};
use crate::limits::Varied;
use crate::modes::existence::{Existence, ExistenceOptions, ModeProblemLine, TooManyModes};
use crate::problem::TurningHinge;
use crate::progress::Work;
use crate::report::{Status, Tipping};
use crate::solve::{FALLING, GROWING, Stages, Upright, distinct, locking_factor, upright};
use crate::standstill::self_locking_factor;

/// The most patterns for which a margin is computed.
const PATTERNS: u64 = 1 << 12;
/// Factors between those two at which states between faces are sought: a heuristic.
const TRIED: u32 = 8;
/// Margins closer than this, relative to the greater one, are the same.
pub(super) const SAME: f64 = 1e-9;

/// How far friction is from a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Margin {
    /// This factor.
    Finite(f64),
    /// No friction reaches the limit.
    Infinite,
    /// It needs friction: it tips or jams with less than this factor of that of the model.
    Needs(f64),
    /// The quantity that has to keep the limit is without bound in infinitely many solutions.
    Unbounded,
}

impl Margin {
    /// Wanted over present margin: 1 where it is just met, below where it is exceeded. Continuous where
    /// margins become infinite.
    pub(super) fn demand(self, wanted: f64) -> f64 {
        match self {
            Self::Infinite => 0.0,
            Self::Unbounded | Self::Needs(_) => f64::INFINITY,
            Self::Finite(factor) if factor <= 0.0 => f64::INFINITY,
            Self::Finite(factor) => wanted / factor,
        }
    }

    pub(super) fn meets(self, wanted: f64) -> bool {
        match self {
            Self::Infinite => true,
            Self::Unbounded | Self::Needs(_) => false,
            Self::Finite(factor) => factor >= wanted,
        }
    }

    fn least(self, other: Self) -> Self {
        match (self, other) {
            (Self::Finite(one), Self::Finite(other)) => Self::Finite(one.min(other)),
            (Self::Unbounded, _) | (_, Self::Unbounded) => Self::Unbounded,
            (Self::Needs(one), Self::Needs(other)) => Self::Needs(one.max(other)),
            (needs @ Self::Needs(_), _) | (_, needs @ Self::Needs(_)) => needs,
            (Self::Infinite, finite) | (finite, Self::Infinite) => finite,
        }
    }

    /// The factor; nothing where there is none.
    pub(super) fn factor(self) -> Option<f64> {
        match self {
            Self::Finite(factor) => Some(factor),
            Self::Infinite | Self::Unbounded | Self::Needs(_) => None,
        }
    }
}

/// Varied quantity, and which margin is asked for.
pub(super) struct MarginQuestion<'v> {
    pub(super) varied: &'v Varied,
    /// The varied quantity with all rates reversed, if both directions count.
    pub(super) reversed: Option<&'v Varied>,
    pub(super) against: &'v Against,
    /// Limit that an effort, normal force, bearing pressure or efficiency has to keep.
    pub(super) limit: f64,
}

impl MarginQuestion<'_> {
    /// The margin at a value; with both directions the smaller one.
    ///
    /// # Errors
    /// Whatever keeps the mechanism from being assembled or solved there.
    pub(super) fn margin(&self, value: f64, work: Work<'_>) -> Result<Margin, Faults> {
        match self.against {
            Against::Locking => self.both(|varied| against_locking(varied, value, work)),
            Against::Effort { .. }
            | Against::NormalForce { .. }
            | Against::Pressure { .. }
            | Against::Efficiency => {
                self.both(|varied| Ok(self.kept(level(varied, self.against, value, work)?)))
            }
            Against::SelfLocking { load } => {
                let threshold = self.threshold((Some(load), false), value, work)?;
                Ok(threshold.map_or(Margin::Infinite, Margin::Finite))
            }
            Against::Hold { load } => Ok(match self.threshold((load.as_deref(), true), value, work)? {
                None => Margin::Finite(0.0),
                Some(0.0) => Margin::Infinite,
                Some(factor) => Margin::Finite(factor.recip()),
            }),
        }
    }

    /// The margin of holding at a value while something has wedged it, if that is greater than this one, by itself.
    pub(super) fn wedged(&self, value: f64, by_itself: Margin, work: Work<'_>) -> Option<f64> {
        let Against::Hold { load } = self.against else { return None };
        let factor = self.threshold((load.as_deref(), false), value, work).ok().flatten()?;
        let by_itself = by_itself.factor()?;
        (factor > 0.0 && by_itself * factor < 1.0 - SAME).then(|| factor.recip())
    }

    /// Returns the guided sliders that tip at a value, if there is no solution for that reason.
    pub(super) fn tipping(&self, value: f64, work: Work<'_>) -> Option<Tipping> {
        let is_asked = self.varied.model().has_guided_sliders()
            && !matches!(self.against, Against::SelfLocking { .. } | Against::Hold { .. });
        let directions = std::iter::once(self.varied).chain(self.reversed).filter(|_| is_asked);
        let without = directions
            .filter_map(|varied| varied.solved(value, work).ok())
            .filter(|report| report.status == Status::None);
        Tipping::of(without.map(|report| report.tipping().map_or_else(Vec::new, |tipping| tipping.joints)))
    }

    /// What tips in the model as its friction grows to the margin against locking, or as it is.
    pub(super) fn tips(&self, value: f64, work: Work<'_>) -> Vec<String> {
        let is_asked =
            *self.against == Against::Locking && self.varied.rough_circles([value, value]).is_empty();
        let directions = std::iter::once(self.varied).chain(self.reversed).filter(|_| is_asked);
        let found = directions.filter_map(|varied| locking_margin(varied, value, work).ok());
        let nearest = found.min_by(|(one, _), (other, _)| other.demand(1.0).total_cmp(&one.demand(1.0)));
        nearest.map_or_else(Vec::new, |(_, tips)| tips)
    }

    /// The smaller margin of both directions, if both count.
    fn both(&self, margin: impl Fn(&Varied) -> Result<Margin, Faults>) -> Result<Margin, Faults> {
        let forwards = margin(self.varied)?;
        match self.reversed {
            Some(reversed) => Ok(forwards.least(margin(reversed)?)),
            None => Ok(forwards),
        }
    }

    /// How many times a level keeps its limit; not at all without a solution.
    fn kept(&self, level: Option<f64>) -> Margin {
        match (level, self.against) {
            (None, _) => Margin::Finite(0.0),
            (Some(level), _) if level.is_infinite() => Margin::Unbounded,
            (Some(level), Against::Efficiency) => Margin::Finite(level / self.limit),
            (Some(0.0), _) => Margin::Infinite,
            (Some(level), _) => Margin::Finite(self.limit / level),
        }
    }

    /// The factor of static friction from which on a load is held, however great, or all loads as they are: where the guides are wedged, or certainly.
    fn threshold(
        &self,
        asked: (Option<&str>, bool),
        value: f64,
        work: Work<'_>,
    ) -> Result<Option<f64>, Faults> {
        let (threshold, undecided) = self_locking_factor(&self.varied.model_at(value)?, asked, work)?;
        if undecided > 0 {
            let what = asked.0.unwrap_or("it").to_owned();
            return Err(Fault::general(FaultKind::UndecidedAtRest { what }).into());
        }
        Ok(threshold.filter(|factor| factor.is_finite()))
    }
}

/// States with a guided slider between its faces are no modes that could be followed: where there is one
/// there is no answer.
fn against_locking(varied: &Varied, value: f64, work: Work<'_>) -> Result<Margin, Faults> {
    let circles = varied.rough_circles([value, value]);
    if !circles.is_empty() {
        let factor = |stages: &Stages, hinges: &[TurningHinge]| locking_factor(stages, hinges, work);
        let not_computed = || Fault::general(FaultKind::LimitsNotComputed { modes: 1 });
        let factor = varied.with_hinges(value, &circles, factor)?.ok_or_else(not_computed)?;
        return Ok(if factor.is_infinite() { Margin::Infinite } else { Margin::Finite(factor) });
    }
    let (margin, _) = locking_margin(varied, value, work)?;
    let is_between = |rougher: f64| !varied.states_between_faces(value, rougher, None, work).is_empty();
    // Where it is locked, from the friction to which it would have to fall.
    let from = margin.factor().unwrap_or(1.0).min(1.0);
    let tried = if from < 1.0 { TRIED } else { 0 };
    let less = (0..tried).map(|step| from + (1.0 - from) * (f64::from(step) + 0.5) / f64::from(tried));
    if less.chain([1.0]).any(is_between) {
        return Err(Fault::general(FaultKind::BetweenFaces).into());
    }
    Ok(margin)
}

/// The factor by which friction may grow before something tips, or there is neither a solution nor a preload-gap state;
/// where one of both is so as it is, the factor to which it has to fall. Friction may always be less than it is taken for,
/// down to none: where that tips or jams it, it needs friction, however much more there may be. And what tips there, or as it
/// is.
fn locking_margin(varied: &Varied, value: f64, work: Work<'_>) -> Result<(Margin, Vec<String>), Faults> {
    let line = varied.growing_friction(value)?;
    let mechanism = varied.mechanism(value)?;
    let growing = existence(&line, GROWING, work)?;
    let now = Upright::of(&growing, &mechanism);
    let falling = match existence(&line, FALLING, work) {
        // Modes that are not known with less friction leave only open whether that jams it.
        Err(_) if now.is_some() && !mechanism.may_tip() => Existence::default(),
        falling => falling?,
    };
    let is_known = now.is_some() && !falling.modes.is_empty();
    let below = if is_known { Upright::below(&falling, &mechanism) } else { None };
    if let Some(Upright { until, tips }) = below {
        return Ok((Margin::Needs(until), tips));
    }
    Ok(match now {
        Some(Upright { until, tips }) if until.is_infinite() => (Margin::Infinite, tips),
        Some(Upright { until, tips }) => (Margin::Finite(until), tips),
        None => {
            let less = upright(&falling, &mechanism).map(|mode| mode.to.at).reduce(f64::max);
            let more = upright(&growing, &mechanism).map(|mode| mode.from.at).reduce(f64::min);
            let now = growing.modes.iter().filter(|mode| mode.from.at <= GROWING[0]);
            let tips = distinct(now.flat_map(|mode| mechanism.tipped(&mode.pattern)).collect());
            let margin = match (less, more) {
                (None, Some(more)) => Margin::Needs(more),
                (less, _) => Margin::Finite(less.unwrap_or(0.0)),
            };
            (margin, tips)
        }
    })
}

fn existence(line: &ModeProblemLine, range: [f64; 2], work: Work<'_>) -> Result<Existence, Faults> {
    let options = ExistenceOptions { range, greatest_normal_force: None, patterns: PATTERNS };
    let found = line.existence_with(&options, &mut |progress| work.tell(progress));
    let existence =
        found.map(Option::unwrap_or_default).map_err(|TooManyModes { contacts, limit, .. }| {
            Fault::general(FaultKind::TooManyModes { contacts, limit })
        })?;
    match existence.not_computed.len() {
        0 => Ok(existence),
        modes => Err(Fault::general(FaultKind::LimitsNotComputed { modes }).into()),
    }
}
