//! Report on limits: plain data, which are the JSON output.

use super::found::left_out;
use crate::report::{CoordinateState, JointMode, ModeEndCause, SpeedChange, Tipping, without_solution};
use crate::standstill::CoordinateValue;
use crate::units::{Unit, Units};
use serde::Serialize;

/// Version of the layout of a [`LimitsReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/limits/2";

/// For which values each mode exists.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LimitsReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// The title of the model.
    pub title: Option<String>,
    /// Varied quantity, with its range.
    pub vary: VariedQuantity,
    /// The coordinates for which it holds, but for one that is varied.
    pub state: Vec<CoordinateState>,
    /// The units in which texts show them.
    #[serde(skip)]
    pub units: Units,
    /// In how many steps the positions were followed from the drawing, each proven to stay on its assembly
    /// branch; absent where they are those of the drawing, and where a coordinate is varied: then `guarantee`
    /// tells of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_from_drawing: Option<usize>,
    /// How the ends of modes were found.
    pub method: LimitsMethod,
    /// Account, in words, of what the method can miss.
    pub guarantee: String,
    /// The modes in the direction of the model's rates.
    pub modes: Vec<ModeLimits>,
    /// Numbers of solutions in that direction.
    pub counts: Vec<CountLimits>,
    /// Ranges in which the mechanism cannot be assembled or solved, or the model is not allowed, in that
    /// direction.
    pub without_mode_problem: Vec<RangeWithoutProblem>,
    /// Single values at which a guided slider is between its faces, in that direction; absent if none was
    /// found.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub between_faces_at: Vec<f64>,
    /// The opposite direction, if it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reversed: Option<Direction>,
    /// Conclusion in words: a sentence for each stretch.
    pub conclusion: Vec<String>,
    /// The limit in one sentence, if there is one only.
    #[serde(skip)]
    pub(super) summary: Option<String>,
    /// Whether the other sentences of the conclusion only repeat it.
    #[serde(skip)]
    pub(super) summary_says_all: bool,
    /// Sentences on what was left out; absent if nothing was.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub not_examined: Vec<String>,
}

/// How the ends of modes were found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum LimitsMethod {
    /// As zeros of determinants; of one hinge with friction over its radius as zeros of linear functions of its
    /// couple.
    #[serde(rename = "closed form")]
    ClosedForm,
    /// Between values that were tried.
    Bracketing,
    /// Nothing depends on what is varied.
    Independent,
}

/// Varied quantity, in SI units.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct VariedQuantity {
    /// Its name.
    pub name: String,
    /// Its unit; empty where there is none, or none is known.
    pub unit: String,
    /// Where the range begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Its value in the model.
    pub value: f64,
    /// The unit in which texts show it.
    #[serde(skip)]
    pub shown_in: Unit,
}

/// The modes of the opposite direction of motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Direction {
    /// The modes.
    pub modes: Vec<ModeLimits>,
    /// Numbers of solutions.
    pub counts: Vec<CountLimits>,
    /// Ranges in which the mechanism cannot be assembled or solved, or the model is not allowed.
    pub without_mode_problem: Vec<RangeWithoutProblem>,
    /// Single values at which a guided slider is between its faces; absent if none was found.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub between_faces_at: Vec<f64>,
}

/// An interval in which a mode has a solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModeLimits {
    /// Its pattern: "+" and "-" for the signs of the normal forces, "0" in a preload gap.
    pub pattern: String,
    /// The pattern as numbers: 1 and -1 for the signs, 0 in a preload gap.
    pub signs: Vec<i8>,
    /// Whether a contact rests in its preload gap.
    pub preload_gap: bool,
    /// The contact mode of each sliding joint, as the mechanism lies in the model's state.
    pub joints: Vec<JointMode>,
    /// Where it begins.
    pub from: Option<f64>,
    /// Where it ends.
    pub to: Option<f64>,
    /// Why it begins there.
    pub from_is: ModeEndCause,
    /// Why it ends there.
    pub to_is: ModeEndCause,
    /// The contacts or guided sliders that begin it.
    pub from_at: Vec<String>,
    /// The contacts or guided sliders that end it.
    pub to_at: Vec<String>,
    /// Limits of the normal force of each contact towards both ends.
    pub reactions: Vec<EndReaction>,
    /// With friction in hinges the sign of `det(I - H D)`, 1 or -1: solutions of one mode that merge in a fold have
    /// opposite ones, and the mechanism never settles where it is negative. Absent without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<i8>,
    /// Limits of the force of each hinge with friction towards both ends; absent without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hinge_forces: Vec<EndHingeForce>,
    /// Change of the speed of each coordinate that no drive moves, from value to value.
    pub speeds: Vec<SpeedLimits>,
}

/// An interval of a mode in which the speed of a coordinate changes one way.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SpeedLimits {
    /// The coordinate.
    pub coordinate: String,
    /// Where it begins.
    pub from: f64,
    /// Where it ends: where the acceleration vanishes, or the mode ends.
    pub to: f64,
    /// Change of its speed in the interval.
    pub speed: SpeedChange,
    /// Whether it is proven somewhere in the interval that the loads push the motion and friction takes more power
    /// than they give; never with drives.
    pub friction_exceeds_loads: bool,
}

/// Limits of a normal force towards both ends of an interval, or its growth without bound.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EndReaction {
    /// The contact.
    pub contact: String,
    /// Its limit towards the beginning (N); null where it grows without bound or was not computed.
    pub from: Option<f64>,
    /// Its limit towards the end, likewise.
    pub to: Option<f64>,
    /// 1 or -1 where it grows without bound towards the beginning with this sign, else 0.
    pub from_grows: i8,
    /// 1 or -1 where it grows without bound towards the end with this sign, else 0.
    pub to_grows: i8,
}

/// Limits of the force of a hinge with friction towards both ends of an interval, or its growth without
/// bound.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EndHingeForce {
    /// The hinge.
    pub hinge: String,
    /// The limit of its magnitude towards the beginning (N); null where it grows without bound or was not
    /// computed.
    pub from: Option<f64>,
    /// Its limit towards the end, likewise.
    pub to: Option<f64>,
    /// Whether it grows without bound towards the beginning.
    pub from_grows: bool,
    /// Whether it grows without bound towards the end.
    pub to_grows: bool,
}

/// An interval with the same number of solutions throughout.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CountLimits {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Number of solutions.
    pub solutions: usize,
    /// Number of preload-gap states, which are counted apart.
    pub preload_gap_states: usize,
    /// Whether there are infinitely many solutions, besides these.
    pub continuum: bool,
    /// How these numbers are known.
    pub known: Known,
    /// Guided sliders that tip where there is no solution; absent where none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tipping: Option<Tipping>,
    /// The stretches for all values of which they are proven, both ends included. If `known` is `proven`
    /// nothing of the interval lies between them but what is next to ends of modes:
    /// [`CountLimits::left_out`].
    pub proven: Vec<[f64; 2]>,
    /// Where they were sampled: the greatest distance between neighbouring values; else null.
    pub spacing: Option<f64>,
    /// How each state starts, in words, where contacts that may lift off are at rest; absent elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub starts: Option<Vec<String>>,
}

/// How the numbers of solutions in an interval are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Known {
    /// By the certified search for all values but those next to ends of modes: for all of
    /// [`CountLimits::proven`].
    Proven,
    /// Outside [`CountLimits::proven`] by zeros of determinants, which were computed in rounded numbers.
    ClosedForm,
    /// Outside [`CountLimits::proven`] at values that were tried.
    Sampled,
    /// Not at all: at some value there is another number.
    Undecided,
}

impl CountLimits {
    /// Returns the meaning of no solution, in words: "it jams", or what tips.
    pub(super) fn without_solution(&self) -> String {
        without_solution(self.tipping.as_ref())
    }

    /// Whether there is neither a solution nor a preload-gap state.
    pub fn is_empty(&self) -> bool {
        self.solutions + self.preload_gap_states == 0 && !self.continuum
    }

    /// The widest part of the interval that is not proven; all of it if nothing is.
    pub fn left_out(&self) -> f64 {
        left_out([self.from, self.to], &self.proven)
    }
}

/// Evenly spaced values at which rest is decided: a heuristic.
pub(super) const STEPS: usize = 100;

/// Version of the layout of a [`RestLimitsReport`]; changes whenever a field is renamed or removed.
pub const REST_SCHEMA: &str = "slideway/hold-limits/1";

/// For which values a mechanism can stay at rest.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RestLimitsReport {
    /// Version of this layout: [`REST_SCHEMA`].
    pub schema: &'static str,
    /// The title of the model.
    pub title: Option<String>,
    /// Varied quantity, with its range.
    pub vary: VariedQuantity,
    /// The coordinates for which it holds, but for one that is varied.
    pub state: Vec<CoordinateValue>,
    /// The units in which texts show them.
    #[serde(skip)]
    pub units: Units,
    /// The load that was named, if one was: with its present magnitude, the effort of a drive with none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load: Option<String>,
    /// The stretches, one after another.
    pub spans: Vec<SpanOfRest>,
    /// Account, in words, of what may have been missed.
    pub guarantee: String,
}

/// A stretch with one answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SpanOfRest {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Whether it can stay at rest; null where that was not decided, and where there is no answer.
    pub holds: Option<bool>,
    /// Whether it can also begin to slide: it rests only where something wedged it before. Absent if not.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub may_slip: bool,
    /// Why there is no answer, if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// A range in which there is no mode problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RangeWithoutProblem {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Why: what is at fault in its middle.
    pub reason: String,
}
