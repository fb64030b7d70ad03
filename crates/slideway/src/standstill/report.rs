//! What the analysis of standstill tells, as plain data.

use crate::one_face::NormalForces;
use crate::report::{CoordinateState, LoadSharing, OneFaceHint};
use crate::units::Units;
use serde::Serialize;

/// Ends of intervals that differ by less than this, relative to the greater, are the same.
const SAME_END: f64 = 1e-9;

/// Version of the layout of a [`HoldReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/hold/1";

/// Whether a mechanism stays at rest, begins to move, may do both, or neither.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum HoldVerdict {
    /// It stays at rest; no state of sliding is possible.
    Holds,
    /// It stays at rest, but once pushed it goes on sliding, as kinetic friction is below static friction.
    HoldsUntilPushed,
    /// Friction may hold it, and yet it may begin to slide even against static friction (Painleve's paradox
    /// at rest).
    HoldsOrSlips,
    /// It cannot stay at rest, and begins to move.
    Moves,
    /// It can neither stay at rest nor begin to move with finite accelerations.
    Neither,
    /// It stays at rest; whether it also keeps sliding once pushed is not known, since motions are without inertia.
    MayHold,
    /// It cannot stay at rest; motions without inertia keep its accelerations from being known.
    DoesNotHold,
}

impl HoldVerdict {
    /// Whether some state of rest is possible.
    pub fn holds(self) -> bool {
        matches!(self, Self::Holds | Self::HoldsUntilPushed | Self::HoldsOrSlips | Self::MayHold)
    }
}

/// All values from `least` to `greatest`; nothing where there is no bound.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Range {
    /// The least value.
    pub least: Option<f64>,
    /// The greatest value.
    pub greatest: Option<f64>,
}

/// Whether a mechanism stays at rest, under which loads, and how it begins to move.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct HoldReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// The model's title.
    pub title: Option<String>,
    /// The units in which texts show its numbers.
    #[serde(skip)]
    pub units: Units,
    /// The answer.
    pub verdict: HoldVerdict,
    /// Whether it can stay at rest: of the verdict.
    pub holds: bool,
    /// Values of the chosen coordinates.
    pub state: Vec<CoordinateValue>,
    /// In how many steps the positions were followed from the drawing, each proven to stay on its assembly
    /// branch; absent where they are those of the drawing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_from_drawing: Option<usize>,
    /// Whether the model gives rates that were taken as zero.
    pub rates_ignored: bool,
    /// Drives that are taken as absent.
    pub released_drives: Vec<String>,
    /// Drives that hold their coordinate.
    pub holding_drives: Vec<String>,
    /// How redundant guides share their load; absent if no constraint is redundant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sharing: Option<LoadSharing>,
    /// Whether redundant guides can be wedged; absent if no constraint is redundant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wedging: Option<Wedging>,
    /// The load that is varied, if one is.
    pub load: Option<LoadReport>,
    /// How much static friction the loads need as they are; absent with a varied load, and without friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<FrictionNeeded>,
    /// The states of rest, if there is one of which the reactions were decided.
    pub at_rest: Option<AtRest>,
    /// Every state in which it begins to move; empty also where motions without inertia kept them from being
    /// sought.
    pub releases: Vec<Release>,
    /// The joints of two faces of which rest, or the start of the motion, needs the one that the thing itself may not have.
    /// Absent if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub one_face_hints: Vec<OneFaceHint>,
    /// Motions of the joints without inertia; if there are any, `releases` was not sought.
    pub motions_without_inertia: Vec<String>,
    /// The greatest force of its loads (N): what of a reaction is 10 digits below it is left over by the linear programs.
    #[serde(skip)]
    pub(super) force: f64,
    /// Patterns of contact sides that were tried for rest.
    pub rest_patterns: usize,
    /// States of joints and contact sides that were tried for release.
    pub release_patterns: usize,
    /// Patterns of both kinds, and of those of the load, of friction and of wedging, of which a linear program could not be solved.
    pub undecided: usize,
}

impl HoldReport {
    /// Whether it is known that it holds, or that it does not: what is open concerns the varied load or wedging at most.
    pub fn is_decided(&self) -> bool {
        let of_load = self.load.as_ref().map_or(0, |load| load.undecided + load.threshold.undecided);
        let of_wedging = self.wedging.as_ref().map_or(0, |wedging| wedging.threshold.undecided);
        let of_friction = self.friction.as_ref().map_or(0, |friction| friction.threshold.undecided);
        self.holds || self.undecided == of_load + of_wedging + of_friction
    }

    /// The normal forces at rest, or where it begins to move.
    pub(super) fn normal_forces(&self) -> Vec<NormalForces> {
        let rest = self.at_rest.iter().map(|rest| &rest.reactions);
        let states = rest.chain(self.releases.iter().map(|release| &release.reactions));
        let forces = |contact: &ContactRange| {
            let Range { least, greatest } = contact.normal_force;
            [least.unwrap_or(f64::NEG_INFINITY), greatest.unwrap_or(f64::INFINITY)]
        };
        states.map(|reactions| reactions.contacts.iter().map(forces).collect()).collect()
    }

    /// Has its forces and moments shown in units in which they read well.
    pub(super) fn suit_units(&mut self) {
        let reactions = self.at_rest.iter().map(|rest| &rest.reactions);
        let reactions = reactions.chain(self.releases.iter().map(|release| &release.reactions));
        let load = self.load.iter().filter(|load| !load.unit.is_empty());
        let held = load.flat_map(|load| load.held.iter().map(|range| (load.unit, *range)));
        let ranges = reactions.flat_map(Reactions::with_units).chain(held);
        let ends = ranges.flat_map(|(unit, Range { least, greatest })| {
            [least, greatest].into_iter().flatten().map(move |end| (unit, end))
        });
        let values: Vec<(&'static str, f64)> = ends.collect();
        self.units = std::mem::take(&mut self.units).suited_to(values);
    }
}

/// A coordinate.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CoordinateValue {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
}

impl From<CoordinateState> for CoordinateValue {
    fn from(state: CoordinateState) -> Self {
        Self { name: state.name, unit: state.unit, value: state.value }
    }
}

/// What is known of a load that is multiplied by a factor.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LoadReport {
    /// Its name.
    pub name: String,
    /// Unit of the factor: empty for a load, "N" or "N m" for the effort of a drive.
    pub unit: &'static str,
    /// The factor at which everything else in the report is told: 1 for a load, 0 for a drive.
    pub factor: f64,
    /// The resultant of the load as it is (N); absent of a drive, and where its forces balance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force: Option<f64>,
    /// The factors with which it can stay at rest, in ascending order.
    pub held: Vec<Range>,
    /// What it begins to do just beyond each end of these ranges, where contacts may lift off; absent without.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beyond: Vec<BeyondHeld>,
    /// Patterns of contact sides in which that was not decided: they may hold it with others.
    pub undecided: usize,
    /// Whether it can stay at rest with every factor that is great enough.
    pub self_locking: bool,
    /// From which static friction on it is held alone, however great: at least where the guides are wedged.
    pub threshold: Threshold,
    /// From which value of the same on it holds by itself, since there it cannot slide, not even where nothing wedged it
    /// before; nothing if it never does, or where that was not sought.
    pub certain_from: Option<f64>,
}

/// What begins beyond an end of what is held.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BeyondHeld {
    /// The end, as a factor of the load, or the effort of the drive (N or N m).
    pub at: f64,
    /// Whether it is the upper end of a range.
    pub above: bool,
    /// In words: "it tips over shoes.front".
    pub words: String,
}

/// The static friction that the loads need as they are.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FrictionNeeded {
    /// From which static friction on they can be held: at least where something has wedged the guides before.
    pub threshold: Threshold,
    /// From which value of the same on they are held for certain, since there it cannot slide; nothing if they never are.
    pub certain_from: Option<f64>,
    /// By how much all static friction may be divided until it may slide, below 1 where it may already: the inverse of
    /// `certain_from`. Nothing where that is nothing, or 0: no friction is needed.
    pub safety_factor: Option<f64>,
}

/// Whether redundant guides can be wedged: pressed against each other without any load, however hard.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Wedging {
    /// Whether they can with the friction of the model: then nothing bounds the loads that it can hold.
    pub possible: bool,
    /// From which static friction on they can.
    pub threshold: Threshold,
}

/// The static friction from which on the load alone, however great, is held, or all loads as they are, or guides wedge.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Threshold {
    /// What is varied: "static friction" for a factor on every static coefficient, or the name of a
    /// parameter.
    pub varied: String,
    /// Its value in the model: 1 for the factor.
    pub present: f64,
    /// Of the factor: the parameter to which all of this friction is proportional, and its value, where there is just one.
    #[serde(skip)]
    pub(crate) parameter: Option<(String, f64)>,
    /// Where the threshold lies: self-locking, or wedged, from this value on, free below it; 0 if friction is not
    /// needed, nothing if no friction suffices.
    pub value: Option<f64>,
    /// Patterns of contact sides in which that was not decided: with them it may lie lower, or there may be one.
    pub undecided: usize,
    /// Static coefficients of every contact at the threshold.
    pub coefficients: Vec<Coefficients>,
    /// Whether hinges have static friction, too, so that these coefficients are not all of it.
    #[serde(skip)]
    pub friction_in_hinges: bool,
}

/// Static coefficients of a contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Coefficients {
    /// Its name.
    pub contact: String,
    /// Where the normal force is positive, and where it is negative.
    pub mu_static: [f64; 2],
}

/// All states of rest together.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct AtRest {
    /// The sign patterns of the normal forces that are possible; 0 for a contact in its gap, or open.
    pub patterns: Vec<String>,
    /// Reactions, over all these patterns.
    pub reactions: Reactions,
    /// The contacts whose normal forces have no bound: pressed against each other they are in equilibrium without
    /// any load, so that it can be wedged.
    pub wedging: Vec<String>,
    /// Whether it could stay at rest without the preloads of its contacts; absent if there are none, or where that
    /// was not decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_preloads: Option<bool>,
}

/// Ranges of reactions.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Reactions {
    /// Of the contacts.
    pub contacts: Vec<ContactRange>,
    /// Of the hinges.
    pub hinges: Vec<HingeRange>,
    /// Of the drives that hold.
    pub drives: Vec<DriveRange>,
}

/// Reactions of a contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ContactRange {
    /// Its name.
    pub name: String,
    /// Normal force on the block, along n (N).
    pub normal_force: Range,
    /// The parts of that range in which it can lie; absent where no value between is impossible.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub normal_force_parts: Vec<Range>,
    /// Friction force on the block, against u (N); of a round end that of both of its contacts, at the one along n.
    pub friction_force: Range,
    /// Couple of a guided slider (N m).
    pub couple: Option<Range>,
}

/// Force of a hinge.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct HingeRange {
    /// Its name.
    pub name: String,
    /// The body on which it is counted.
    pub on: String,
    /// Its components along x and y (N).
    pub force: [Range; 2],
    /// The couple of its friction, with that of its collar, on the same body (N m); nothing if it has none.
    pub couple: Option<Range>,
}

/// Effort of a drive that holds.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DriveRange {
    /// Its name.
    pub name: String,
    /// "N" or "N m".
    pub unit: &'static str,
    /// Its effort.
    pub effort: Range,
}

/// A state in which the mechanism begins to move.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Release {
    /// What each sliding joint does.
    pub joints: Vec<JointRelease>,
    /// The sign patterns of the normal forces with which it is possible; 0 for a contact in its gap, or open.
    pub patterns: Vec<String>,
    /// The contacts that lift off; absent if none does.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gaps: Vec<GapRange>,
    /// Accelerations of the chosen coordinates.
    pub coordinates: Vec<CoordinateRange>,
    /// Reactions.
    pub reactions: Reactions,
}

/// What a sliding joint does on release.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct JointRelease {
    /// Its name.
    pub name: String,
    /// 0 if it sticks, 1 if the block begins to slide along u, -1 if against it.
    pub slip: i8,
    /// The same in words.
    pub words: String,
    /// Acceleration of the block against the guide along u (m/s^2).
    pub acceleration: Range,
    /// Its contacts that lift off; absent if none does.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub open: Vec<String>,
}

/// How a contact lifts off.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct GapRange {
    /// Its name.
    pub contact: String,
    /// Acceleration of its gap (m/s^2).
    pub acceleration: Range,
}

/// Acceleration of a coordinate.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CoordinateRange {
    /// Its name.
    pub name: String,
    /// "m/s^2" or "rad/s^2".
    pub unit: &'static str,
    /// Its acceleration.
    pub acceleration: Range,
}

impl Range {
    /// A range in other units.
    pub(super) fn times(self, unit: f64) -> Self {
        // Adding zero turns -0 into 0.
        let one = |end: Option<f64>| end.map(|value| value * unit + 0.0);
        Self { least: one(self.least), greatest: one(self.greatest) }
    }

    /// The least range that holds both.
    pub(super) fn hull(self, other: Self) -> Self {
        Self {
            least: self.least.zip(other.least).map(|(a, b)| a.min(b)),
            greatest: self.greatest.zip(other.greatest).map(|(a, b)| a.max(b)),
        }
    }

    /// The opposite values.
    pub(super) fn negated(self) -> Self {
        Self { least: self.greatest, greatest: self.least }.times(-1.0)
    }
}

/// The union of intervals, in ascending order.
pub(super) fn union(mut intervals: Vec<Range>) -> Vec<Range> {
    let least = |range: &Range| range.least.unwrap_or(f64::NEG_INFINITY);
    let greatest = |range: &Range| range.greatest.unwrap_or(f64::INFINITY);
    intervals.sort_by(|a, b| least(a).total_cmp(&least(b)));
    let mut union: Vec<Range> = Vec::new();
    for interval in intervals {
        let touches = |last: &&mut Range| {
            let end = greatest(last);
            least(&interval) <= end + SAME_END * end.abs().min(f64::MAX)
        };
        match union.last_mut().filter(touches) {
            Some(last) => *last = last.hull(interval),
            None => union.push(interval),
        }
    }
    union
}

impl ContactRange {
    /// The parts in which its normal force can lie: one, unless values between are impossible.
    pub(super) fn normal_forces(&self) -> &[Range] {
        if self.normal_force_parts.is_empty() {
            std::slice::from_ref(&self.normal_force)
        } else {
            &self.normal_force_parts
        }
    }
}

impl Reactions {
    /// The contacts whose normal forces have no bound.
    pub(super) fn unbounded(&self) -> Vec<String> {
        let is_unbounded = |contact: &&ContactRange| {
            contact.normal_force.least.is_none() || contact.normal_force.greatest.is_none()
        };
        self.contacts.iter().filter(is_unbounded).map(|contact| contact.name.clone()).collect()
    }

    /// The least ranges that hold both.
    pub(super) fn hull(mut self, other: &Self) -> Self {
        for (one, other) in self.contacts.iter_mut().zip(&other.contacts) {
            let parts = union([one.normal_forces(), other.normal_forces()].concat());
            one.normal_force_parts = if parts.len() > 1 { parts } else { Vec::new() };
            one.normal_force = one.normal_force.hull(other.normal_force);
            one.friction_force = one.friction_force.hull(other.friction_force);
            one.couple = one.couple.zip(other.couple).map(|(a, b)| a.hull(b));
        }
        for (one, other) in self.hinges.iter_mut().zip(&other.hinges) {
            one.force = [one.force[0].hull(other.force[0]), one.force[1].hull(other.force[1])];
        }
        for (one, other) in self.drives.iter_mut().zip(&other.drives) {
            one.effort = one.effort.hull(other.effort);
        }
        self
    }

    /// All ranges with their SI units.
    pub(super) fn with_units(&self) -> Vec<(&'static str, Range)> {
        let contacts = self.contacts.iter().flat_map(|contact| {
            let forces = [contact.normal_force, contact.friction_force].map(|force| ("N", force));
            forces.into_iter().chain(contact.couple.map(|couple| ("N m", couple)))
        });
        let hinges = self.hinges.iter().flat_map(|hinge| hinge.force.map(|force| ("N", force)));
        contacts.chain(hinges).chain(self.drives.iter().map(|drive| (drive.unit, drive.effort))).collect()
    }

    /// All ranges.
    pub(super) fn ranges(&self) -> Vec<Range> {
        self.with_units().into_iter().map(|(_, range)| range).collect()
    }
}
