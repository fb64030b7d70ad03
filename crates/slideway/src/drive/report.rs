//! Report on driven motion: plain data, which are the JSON output.

use crate::limits::{RangeWithoutProblem, VariedQuantity};
use crate::report::{
    CoordinateState, JointMode, Proof, Status, TippingLimit, Undetermined, Unlocking, Verdict,
};
use crate::standstill::Range;
use crate::units::Units;
use serde::Serialize;

/// Version of the layout of a [`DriveReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/drive/2";

/// The efforts of all drives.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DriveReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// The title of the model.
    pub title: Option<String>,
    /// The units in which texts show its numbers.
    #[serde(skip)]
    pub units: Units,
    /// The coordinates, with the rates of the model.
    pub state: Vec<CoordinateState>,
    /// The drives; all lists of efforts have their order.
    pub drives: Vec<DriveName>,
    /// Motion as in the model, and with all rates reversed; at rest on contacts that may lift off only the first.
    pub directions: Vec<DriveDirection>,
    /// At rest on contacts that may lift off: the efforts of each drive, the others absent, with which it stays at rest; any
    /// other may set it in motion. Absent elsewhere, and where `hold` does not know.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<HeldEffort>,
    /// The efforts over what is varied, if anything is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub course: Option<Course>,
    /// Sentences that sum up the answer.
    pub conclusion: Vec<String>,
}

impl DriveReport {
    /// Has its efforts and powers shown in units in which those of the model's state read well.
    pub(super) fn suit_units(&mut self) {
        let units: Vec<&'static str> = self.drives.iter().map(|drive| drive.unit).collect();
        let values = |efforts: &[f64], power: f64| -> Vec<(&'static str, f64)> {
            units.iter().copied().zip(efforts.iter().copied()).chain([("W", power)]).collect()
        };
        let of_direction = |direction: &DriveDirection| {
            let free = values(&direction.frictionless.efforts, direction.frictionless.power);
            let solutions = direction.solutions.iter().flat_map(|one| values(&one.efforts, one.power));
            let ranges = direction.range.iter().flat_map(|range| &range.undetermined.efforts);
            let ends = ranges.flat_map(|one| one.from.iter().chain(&one.to).map(|end| (one.unit, *end)));
            free.into_iter().chain(solutions).chain(ends).collect::<Vec<_>>()
        };
        let values: Vec<_> = self.directions.iter().flat_map(of_direction).collect();
        self.units = std::mem::take(&mut self.units).suited_to(values);
    }
}

/// The efforts of a drive with which a mechanism stays at rest.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct HeldEffort {
    /// The drive.
    pub drive: String,
    /// The ranges of its effort (N or N m), disjoint and in ascending order.
    pub held: Vec<Range>,
    /// In words: "It holds with `push` from -1.254 to 7.963 N."
    pub words: String,
}

/// A drive.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DriveName {
    /// Its name.
    pub name: String,
    /// Unit of its effort: "N" or "N m".
    pub unit: &'static str,
}

/// The efforts in one direction of motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DriveDirection {
    /// Which direction it is.
    pub direction: Sense,
    /// How many solutions there are.
    pub status: Status,
    /// Whether these are certainly all solutions.
    pub complete: Proof,
    /// Without friction.
    pub frictionless: Frictionless,
    /// Every solution, preload-gap states after the others.
    pub solutions: Vec<DriveSolution>,
    /// Where there are infinitely many solutions: between which values their efforts lie; absent if there are not, and
    /// if it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<EffortRange>,
    /// Just beyond this factor of friction there is no solution; absent if there always is one, or it was not
    /// computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_solution: Option<f64>,
    /// Whether there is a solution however great the friction; false also where that was not computed.
    pub never_jams: bool,
    /// Up to this factor there is the same number of solutions; absent if that never changes, but to none at `no_solution`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub another_count: Option<f64>,
    /// With friction in hinges: up to at least this factor there is exactly one solution; absent without it, and where that is
    /// not proven.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unique_at_least: Option<f64>,
    /// Where there is no solution: to what all friction would have to fall for one; absent where there is one, and
    /// where none comes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moves_below: Option<Unlocking>,
    /// The coefficient of friction of all contacts that have friction; absent if it is not the same for all of them, or
    /// depends on the sliding speed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mu: Option<f64>,
    /// The guided sliders that tip where there is no solution, or from that factor on: as block sliders they show
    /// whether it moves.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tips: Vec<String>,
    /// From where on a block that may lift off tips over one of its corners, while there is a solution; absent if none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tipping: Option<TippingLimit>,
    /// With less friction: below which it tips or jams; absent if nothing happens down to none, and where it tips or jams as it
    /// is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub below: Option<TippingLimit>,
    /// Factors of friction at which efforts grow without bound, in ascending order; absent if there are too
    /// many modes, or friction in hinges.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blow_ups: Option<Vec<BlowUp>>,
}

/// The efforts without friction.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Frictionless {
    /// Of each drive (N or N m).
    pub efforts: Vec<f64>,
    /// Of all drives together (W).
    pub power: f64,
}

/// The efforts in a solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DriveSolution {
    /// Its pattern: "+" and "-" for the signs of the normal forces, "0" in a preload gap.
    pub pattern: String,
    /// Whether a contact rests in its preload gap.
    pub preload_gap: bool,
    /// The contact mode of each sliding joint.
    pub joints: Vec<JointMode>,
    /// Whether a mechanism with slightly elastic guides settles on it.
    pub attainability: Verdict,
    /// Of each drive (N or N m).
    pub efforts: Vec<f64>,
    /// Of all drives together (W).
    pub power: f64,
    /// Against the same motion without friction.
    pub efficiency: Efficiency,
    /// Whether a block floats within its play.
    #[serde(skip)]
    pub(super) floats: bool,
}

/// The efforts of infinitely many solutions.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EffortRange {
    /// The least and the greatest effort of each drive, and what leaves them open.
    pub undetermined: Undetermined,
    /// The least and the greatest power of all drives together (W); null where it is unbounded.
    pub power: [Option<f64>; 2],
    /// The least and the greatest efficiency; absent where not all of them have one of the same kind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub efficiency: Option<[f64; 2]>,
}

/// The share of power that is not lost to friction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Efficiency {
    /// Which way power flows.
    pub is: EfficiencyKind,
    /// The share; null where it has no meaning.
    pub value: Option<f64>,
}

/// Which way power flows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EfficiencyKind {
    /// The drives push, with and without friction: power without friction over power with it.
    Driving,
    /// The load pushes and the drives brake, with and without friction: power with friction over power
    /// without it.
    Braking,
    /// Without friction the load would push; friction holds it, and the drives have to push.
    HeldByFriction,
    /// Without friction the motion takes no power.
    NoPower,
    /// Without friction the drives would push, with it they brake; possible where some motions are not
    /// prescribed.
    Undefined,
}

impl EfficiencyKind {
    /// Returns the few words that stand for it where it has no value: "held by friction".
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Driving => "driving",
            Self::Braking => "braking",
            Self::HeldByFriction => "held by friction",
            Self::NoPower => "no load",
            Self::Undefined => "none",
        }
    }
}

/// A value at which efforts grow without bound.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BlowUp {
    /// The value.
    pub at: f64,
    /// The mode in which they do.
    pub pattern: String,
    /// On which side of the value the mode exists.
    pub side: Approach,
    /// 1 or -1 for each drive whose effort grows without bound, with this sign, else 0.
    pub efforts: Vec<i8>,
    /// The contacts whose normal forces grow without bound, too.
    pub contacts: Vec<String>,
}

/// The efforts over what is varied.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Course {
    /// Varied quantity, with its range.
    pub vary: VariedQuantity,
    /// Motion as in the model, and with all rates reversed.
    pub directions: Vec<CourseDirection>,
    /// Whether the values at which something changes were sought between sampled ones, so that some may be missed.
    pub sampled: bool,
    /// Account, in words, of what can be missed.
    pub guarantee: String,
    /// Whether no solution may mean that a guided slider tips, and not that it jams.
    #[serde(skip)]
    pub(super) can_tip: bool,
}

/// The efforts over what is varied in one direction of motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CourseDirection {
    /// Which direction it is.
    pub direction: Sense,
    /// One row for each value and each solution there; a value without a solution has one row without a
    /// pattern.
    pub rows: Vec<CourseRow>,
    /// The modes of the rows, each once.
    pub modes: Vec<CourseMode>,
    /// Values at which efforts grow without bound, in ascending order.
    pub blow_ups: Vec<BlowUp>,
    /// Where the effort of each drive is greatest, by its magnitude; absent where one grows without bound, where there are
    /// several states, and with friction in hinges.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub peaks: Vec<PeakEffort>,
    /// Ranges in which joints tip in every state, in ascending order; absent where none does, and with friction in hinges.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tips: Vec<TipsOver>,
    /// Ranges without a solution: it jams.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub locked: Vec<LockedRange>,
    /// Ranges in which the mechanism cannot be assembled or solved, or the model is not allowed.
    pub without_mode_problem: Vec<RangeWithoutProblem>,
}

/// A range in which joints tip in every state.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TipsOver {
    /// Its lower end, a value of what is varied.
    pub from: f64,
    /// Its upper end.
    pub to: f64,
    /// The joints.
    pub joints: Vec<String>,
}

/// Where an effort is greatest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PeakEffort {
    /// The number of the drive.
    pub drive: usize,
    /// The value of what is varied.
    pub at: f64,
    /// The effort there (N or N m).
    pub effort: f64,
}

/// A range in which no effort moves the mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LockedRange {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

/// A mode that occurs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CourseMode {
    /// One sign for each contact.
    pub pattern: String,
    /// The contact modes of all sliding joints, in words.
    pub words: String,
}

/// The efforts in one solution at one value.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CourseRow {
    /// The value.
    pub at: f64,
    /// The mode; null where there is no solution or no position.
    pub pattern: Option<String>,
    /// Whether a mechanism with slightly elastic guides settles on it; null where there is no solution, and where
    /// efforts grow without bound.
    pub attainability: Option<Verdict>,
    /// Of each drive (N or N m); null where they grow without bound, or without a solution.
    pub efforts: Option<Vec<f64>>,
    /// 1 or -1 for each drive whose effort grows without bound there, else 0.
    pub grows: Vec<i8>,
    /// Without friction; null where there is no position, and where it is not known whether there is a solution.
    pub frictionless: Option<Vec<f64>>,
    /// Of all drives together (W).
    pub power: Option<f64>,
    /// Against the same motion without friction.
    pub efficiency: Option<Efficiency>,
    /// Where there are infinitely many solutions: between which values their efforts lie; absent elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<EffortRange>,
    /// The contact modes where a block floats within its play, which the pattern does not tell.
    #[serde(skip)]
    pub(super) floating: Option<String>,
}

/// A direction of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Sense {
    /// The direction of the model's rates.
    Model,
    /// The other one.
    Reversed,
}

/// From which side a value is approached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Approach {
    /// From below.
    Below,
    /// From above.
    Above,
}
