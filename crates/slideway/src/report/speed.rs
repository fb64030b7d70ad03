//! The speed of a motion, as a solution changes it.

use serde::Serialize;

/// The change of the speed of a coordinate, from the signs of its rate and of proven bounds of its
/// acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum SpeedChange {
    /// Its acceleration has the direction of its rate.
    SpeedsUp,
    /// Its acceleration is zero within rounding.
    KeepsItsSpeed,
    /// Its acceleration is opposite to its rate.
    SlowsDown,
    /// Its rate is zero, its acceleration positive.
    StartsForwards,
    /// Its rate is zero, its acceleration negative.
    StartsBackwards,
    /// Its rate is zero, and its acceleration is zero within rounding.
    StaysAtRest,
    /// Its acceleration has no proven bounds.
    Undecided,
    /// Its rate is zero, and its acceleration has no proven bounds.
    MayStart,
}

impl SpeedChange {
    /// The change for a coordinate with this rate and these bounds of its acceleration.
    pub fn of(rate: f64, acceleration: Option<[f64; 2]>) -> Self {
        let sign = |[least, greatest]: [f64; 2]| i8::from(least > 0.0) - i8::from(greatest < 0.0);
        Self::of_sign(rate, acceleration.map(sign))
    }

    /// The change for a coordinate with this rate and this sign of its acceleration, if that is known.
    pub(crate) fn of_sign(rate: f64, sign: Option<i8>) -> Self {
        let direction = i8::from(rate > 0.0) - i8::from(rate < 0.0);
        let Some(sign) = sign else { return if direction == 0 { Self::MayStart } else { Self::Undecided } };
        match (direction, direction * sign) {
            (0, _) if sign > 0 => Self::StartsForwards,
            (0, _) if sign < 0 => Self::StartsBackwards,
            (0, _) => Self::StaysAtRest,
            (_, 1) => Self::SpeedsUp,
            (_, -1) => Self::SlowsDown,
            _ => Self::KeepsItsSpeed,
        }
    }

    /// In words, after "it" or a name: "slows down".
    pub fn in_words(self) -> &'static str {
        match self {
            Self::SpeedsUp => "speeds up",
            Self::KeepsItsSpeed => "keeps its speed",
            Self::SlowsDown => "slows down",
            Self::StartsForwards => "starts forwards",
            Self::StartsBackwards => "starts backwards",
            Self::StaysAtRest => "stays at rest",
            Self::Undecided => "may speed up or slow down: its acceleration has no proven bounds",
            Self::MayStart => "may start to move or stay at rest: its acceleration has no proven bounds",
        }
    }
}

/// Of a solution that slows down although the loads push it: how to ask whether it jams.
pub(crate) const FRICTION_EXCEEDS_LOADS: &str = "It slows down because friction exceeds the loads. Whether a push keeps it moving: give the push as a drive, or ask `slideway hold`.";

/// Of limits where no drive prescribes the motion: what asks whether it jams.
pub(crate) const NO_DRIVE: &str = "Without a drive it slows down where friction exceeds the loads. Whether a push keeps it moving: give the push as a drive, or ask `slideway hold`.";

/// When and where a coordinate stops if its acceleration stays as it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Stopping {
    /// The time until then: t = |v|/|a| (s).
    pub time: f64,
    /// The way until then: v^2 / (2 |a|) (m or rad).
    pub distance: f64,
}

impl Stopping {
    /// Of a rate and an acceleration against it; none where a number is beyond the range of floating point.
    pub(crate) fn of(rate: f64, acceleration: f64) -> Option<Self> {
        let time = (rate / acceleration).abs();
        let stop = Self { time, distance: 0.5 * time * rate.abs() };
        (stop.time.is_finite() && stop.distance.is_finite()).then_some(stop)
    }
}

/// The effect of the loads on a mechanism that has stopped, by the analysis of standstill in the same position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum FromRest {
    /// It stays at rest.
    Rests,
    /// It may stay at rest, and may begin to move.
    RestsOrMoves,
    /// It begins to move in the direction of its rate.
    MovesOn,
    /// It begins to move against its rate.
    MovesBack,
    /// It begins to move; in which direction is not one answer.
    Moves,
    /// It can neither stay at rest nor begin to move with finite accelerations.
    Neither,
    /// Rounding leaves some states of rest open.
    Undecided,
    /// It has more states of joints and contacts than modes for which margins are computed.
    NotExamined,
}

impl FromRest {
    /// In words, after "at rest in this position,": "these loads would not move it".
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Rests => "these loads would not move it",
            Self::RestsOrMoves => "these loads may move it or not",
            Self::MovesOn => "these loads would move it on",
            Self::MovesBack => "these loads would move it back",
            Self::Moves => "these loads would move it",
            Self::Neither => "it could neither stay so nor begin to move",
            Self::Undecided => "it is not decided whether these loads would move it",
            Self::NotExamined => "these loads may move it or not; ask `slideway hold`",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::SpeedChange::{
        KeepsItsSpeed, SlowsDown, SpeedsUp, StartsBackwards, StartsForwards, StaysAtRest, Undecided,
    };
    use super::{SpeedChange, Stopping};

    #[test]
    fn signs_of_rate_and_acceleration_decide() {
        let table = [
            (1.0, [0.5, 1.0], SpeedsUp),
            (-1.0, [-1.0, -0.5], SpeedsUp),
            (1.0, [-1.0, -0.5], SlowsDown),
            (-1.0, [0.5, 1.0], SlowsDown),
            (2.0, [-1e-16, 1e-16], KeepsItsSpeed),
            (-2.0, [0.0, 0.0], KeepsItsSpeed),
            (0.0, [0.5, 1.0], StartsForwards),
            (-0.0, [-1.0, -0.5], StartsBackwards),
            (0.0, [-1e-16, 0.0], StaysAtRest),
        ];
        for (rate, bounds, change) in table {
            assert_eq!(SpeedChange::of(rate, Some(bounds)), change, "{rate} {bounds:?}");
        }
        assert_eq!(SpeedChange::of(1.0, None), Undecided);
    }

    /// t = v/a = 0.5/4 s, v^2/(2a) = 0.25/8 m: numbers without rounding.
    #[test]
    fn a_stop_is_that_of_uniform_deceleration() {
        let stop = Stopping::of(-0.5, 4.0);
        assert_eq!(stop, Some(Stopping { time: 0.125, distance: 0.03125 }));
        assert_eq!(Stopping::of(1.0, -1e-320), None);
    }
}
