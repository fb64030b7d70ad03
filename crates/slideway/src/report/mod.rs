//! Reports: answers as plain data, and their forms as text, JSON and CSV.
//!
//! Last stage of the pipeline. Every face of slideway (command line, library, later Python) gets the same
//! [`SolveReport`]; its fields are the JSON output, documented in the book under "Output".

mod answer;
mod attainability;
mod csv;
pub(crate) mod effort;
mod end;
mod finite;
mod json;
mod one_face;
pub(crate) mod page;
mod sharing;
mod speed;
mod style;
mod table;
mod text;
mod tipping;
mod uncertainty;
mod undetermined;
mod wrap;

pub(crate) use crate::units::number;
pub use crate::units::precise;
pub(crate) use answer::{AT_THE_MIDDLE, HOLDS};
pub use attainability::{Attainability, EigenvalueUnit, Fate, FlutterDamping, Verdict};
pub use end::ModeEndCause;
pub use finite::{defined, finite};
pub(crate) use json::{Answered, indented};
pub use one_face::{OneFaceHint, OneFaceReason};
pub use sharing::{Elasticity, LoadSharing, PressFit, StiffnessRatios};
pub(crate) use speed::NO_DRIVE;
pub use speed::{FromRest, SpeedChange, Stopping};
pub use style::Style;
pub(crate) use text::{capital, count, ends_in_words, joints_in_words, spaced};
pub use text::{followed, of_contacts};
pub use tipping::Tipping;
pub(crate) use tipping::{SHOWN_BY, it_tips, it_would_tip, tipping, with_less, without_solution};
pub use undetermined::{OpenRange, Undetermined};
pub use wrap::wrapped;

use crate::ids::{BodyId, ContactId, CoordinateId, DriveId};
use crate::units::{Unit, Units};
use serde::Serialize;
pub use slideway_modes::{Proof, Status};

/// The forms of a report. Its fields are the JSON output.
///
/// ```
/// use slideway::report::Style;
/// use slideway::{Model, Report, gallery, solve};
///
/// let report = solve(&Model::parse(gallery::find("drawer").expect("in the gallery").text)?)?;
/// assert!(report.text(Style::PLAIN).contains("It moves: push needs 36.36 N"));
/// assert!(report.json().contains("\"status\": \"one\""));
/// # Ok::<(), slideway::Faults>(())
/// ```
pub trait Report: Serialize {
    /// The answer as one would say it to a colleague, in one or a few sentences: what the text begins with, and `answer`
    /// of the JSON. Empty for what is only read by programs.
    fn answer(&self) -> String {
        String::new()
    }

    /// As text for people: the answer, what a designer needs, and with [`Style::verbose`] how it is known.
    fn text(&self, style: Style) -> String;

    /// As indented JSON, ending in a line end; the version of its layout is in `schema`.
    ///
    /// # Panics
    /// If a number of the report is not finite, which no function that makes reports lets through
    /// ([`finite`]).
    fn json(&self) -> String
    where
        Self: Sized,
    {
        json::indented(&json::Answered::of(self))
    }

    /// JSON in one line.
    ///
    /// # Panics
    /// As [`Report::json`].
    fn json_line(&self) -> String
    where
        Self: Sized,
    {
        json::in_one_line(&json::Answered::of(self))
    }
}

/// Version of the layout of a [`SolveReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/solve/2";

/// All solutions of the kinetic problem of a mechanism in one state.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SolveReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// How many solutions there are; of those that were found if the search ended early.
    pub status: Status,
    /// Proof that these are all solutions of the mechanism, rounding included.
    pub complete: Proof,
    /// True if the search ended before every possibility was dealt with.
    pub partial: bool,
    /// The open questions, in words; empty if `complete` is [`Proof::Proven`].
    pub open: Vec<String>,
    /// Number of solutions, as decimal text: it may be beyond any integer type, and more than are listed.
    pub count: String,
    /// Number of preload-gap states, likewise.
    pub gap_state_count: String,
    /// How the solutions were found: groups of contacts and methods, in words.
    pub strategy: String,
    /// Nodes of the search that were visited.
    pub nodes: u64,
    /// A summary of the model.
    pub model: ModelSummary,
    /// The state: chosen coordinates and their rates.
    pub state: Vec<CoordinateState>,
    /// The coordinates whose rates the model does not give: they are taken as zero.
    pub rates_not_given: Vec<String>,
    /// The joints that may lift off and do not slide in the state: each solution says how they start. Absent if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at_rest: Vec<String>,
    /// Whether every load has exactly one state, where contacts that may lift off rest and nothing slides. Absent elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub every_load_has_one_state: Option<bool>,
    /// Time of the state (s).
    pub time: f64,
    /// In how many steps the positions were followed from the drawing, each proven to stay on its assembly
    /// branch; absent if they are those of the drawing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_from_drawing: Option<usize>,
    /// The outcome of all sign patterns; absent if there are so many that not each was tried by itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub patterns: Option<PatternSummary>,
    /// The solutions, in the order of their patterns.
    pub solutions: Vec<Solution>,
    /// States with a contact between its faces, in which the preload friction acts (theory, section 3).
    pub preload_gap_states: Vec<Solution>,
    /// Modes with a vanishing determinant that admit infinitely many solutions.
    pub continua: Vec<Continuum>,
    /// Between which values the forces and the motion of these lie; absent if there are none, and where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub undetermined: Option<Undetermined>,
    /// Modes on the boundary within rounding: whether they have a solution cannot be decided.
    pub undecided_modes: Vec<UndecidedMode>,
    /// Modes with a vanishing determinant that admit none: these modes are locked. Only where every pattern
    /// was tried.
    pub locked_modes: Vec<LockedMode>,
    /// Solutions of the equations that a guided slider rejects, because it would tip.
    pub rejected: Vec<Rejection>,
    /// Where there is no solution: the modes with the smallest determinants. Only where every pattern was
    /// tried.
    pub closest_modes: Vec<ClosestMode>,
    /// Where there is no solution: groups of contacts that admit none, whatever the others do.
    pub jammed_groups: Vec<Vec<String>>,
    /// Where there is no solution while contacts that may lift off slide: the impulses without collision that can act instead, of
    /// which none may be possible where drives prescribe the motion. Absent elsewhere, where they are not known, and where margins
    /// are not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jam_impulses: Option<Vec<JamImpulse>>,
    /// By which factors all friction may grow; absent if that was not computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margins: Option<Margins>,
    /// Why there are no margins; absent where there are, and where they were not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margins_missing: Option<MarginsMissing>,
    /// With friction in hinges: all friction may grow at least by this factor while every load is proven to have exactly
    /// one solution. A lower bound: beyond it nothing is known. Absent without friction in hinges, where it is not proven,
    /// and where margins were not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unique_at_least: Option<f64>,
    /// Where some coordinate slows down: what the same loads do from rest in the same position; absent where
    /// it was not asked (margins are not, drives prescribe the motion).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_rest: Option<FromRest>,
    /// The joints of two faces of which a solution, or the jam, needs the one that the thing itself may not have. Absent if
    /// there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub one_face_hints: Vec<OneFaceHint>,
    /// How redundant guides share their load; absent if no constraint is redundant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sharing: Option<LoadSharing>,
    /// The results that hold for all values of parameters known within bounds; absent if there are none. Everything else in the
    /// report holds for the middle of their ranges.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<Uncertainty>,
    /// Accelerations and normal forces without friction, and the influence coefficients.
    pub influence: InfluenceSummary,
    /// Greatest factor by which rounding in the kinetic equations may be amplified.
    pub condition: f64,
}

/// An impulse at a jam: velocities jump without a collision, until what wedges has stopped.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct JamImpulse {
    /// State of each sliding joint afterwards.
    pub joints: Vec<JointMode>,
    /// The impulses of all contacts.
    pub contacts: Vec<ContactImpulse>,
    /// The chosen coordinates, with their rates afterwards.
    pub coordinates: Vec<CoordinateState>,
    /// The kinetic energy that it takes (J).
    pub energy_lost: f64,
}

/// The impulse of a contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ContactImpulse {
    /// The contact.
    pub name: String,
    /// Impulse of its normal force (N s).
    pub normal_impulse: f64,
    /// Impulse of its friction, positive against the direction of positive sliding on the block (N s).
    pub friction_impulse: f64,
}

/// A summary of a model.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModelSummary {
    /// Its title.
    pub title: Option<String>,
    /// Degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Number of bodies.
    pub bodies: usize,
    /// Number of contacts.
    pub contacts: usize,
    /// Number of drives.
    pub drives: usize,
    /// The size of the mechanism (m): what of a length is 13 digits below it is rounding.
    #[serde(skip)]
    pub(crate) size: f64,
    /// The units in which texts show its numbers.
    #[serde(skip)]
    pub units: Units,
}

/// A chosen coordinate in the state.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CoordinateState {
    /// Its name.
    pub name: String,
    /// "m" or "rad".
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// Its rate.
    pub rate: f64,
}

impl CoordinateState {
    /// "phi = 30 deg, rate 1 rad/s"
    pub(crate) fn in_words(&self, units: &Units) -> String {
        let (value, rate) = (units.of(self.unit).show(self.value), units.of_rate(self.unit).show(self.rate));
        format!("{} = {value}, rate {rate}", self.name)
    }
}

/// How many patterns had which outcome; all but `rejected` and the gap states add up to `total`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct PatternSummary {
    /// 2^r sign patterns.
    pub total: u64,
    /// Patterns with a solution inside: every normal force differs from zero.
    pub solution: u64,
    /// Patterns with a solution on their boundary: some normal force is zero.
    pub boundary: u64,
    /// Patterns without a solution.
    pub no_solution: u64,
    /// Patterns with a vanishing determinant and no solution.
    pub singular_without_solution: u64,
    /// Patterns with a vanishing determinant and a single solution.
    pub singular_with_point: u64,
    /// Patterns with a vanishing determinant and a continuum of solutions.
    pub singular_with_continuum: u64,
    /// Patterns that could not be decided within the limits of work.
    pub undecided: u64,
    /// Solutions and gap states that a guided slider rejects because it would tip.
    pub rejected: u64,
    /// Patterns with gap states that were tried besides.
    pub gap_patterns: u64,
}

impl SolveReport {
    /// Has its forces, moments, powers and pressures shown in units in which they read well.
    pub(crate) fn suit_units(&mut self) {
        let states = self.solutions.iter().chain(&self.preload_gap_states);
        let open = self.undetermined.iter().flat_map(|undetermined| &undetermined.efforts);
        let ends = open.flat_map(|range| range.from.iter().chain(&range.to).map(|end| (range.unit, *end)));
        let values: Vec<(&'static str, f64)> = states.flat_map(Solution::efforts).chain(ends).collect();
        self.model.units = std::mem::take(&mut self.model.units).suited_to(values);
    }
}

/// One solution, or one state of a preload gap.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Solution {
    /// Its pattern: "+" and "-" for the signs of the normal forces, "0" in a preload gap.
    pub pattern: String,
    /// The patterns that were examined and give this same solution: on a boundary more than one, all of them if
    /// every pattern was tried (`patterns` of the report).
    pub patterns: Vec<String>,
    /// Whether it stays at rest, as `hold` says of it: every contact sticks, and no coordinate moves or begins to move.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub rests: bool,
    /// Sign of each normal force, 0 where it vanishes.
    pub signs: Vec<i8>,
    /// True if some contact is about to change side: its normal force is zero within rounding.
    pub on_boundary: bool,
    /// Contacts of redundant guides without normal force that do not settle where the block is within its play: it
    /// floats.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub floating: Vec<String>,
    /// The kind of its proof.
    pub certificate: CertificateKind,
    /// By which factor all friction may grow before the mode ends; absent if not computed, or if it ends at
    /// once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<ModeMargin>,
    /// Determinant D of the mode's equations, eq. (6).
    pub determinant: f64,
    /// D times the product of the signs; positive without friction (theory, section 5). Of redundant guides the mean
    /// of those of their determinate parts, 1 without friction (theory, eq. (R4)).
    pub oriented_determinant: f64,
    /// The verdict on whether a mechanism with slightly elastic guides settles on it.
    pub attainability: Attainability,
    /// The contacts, in the order of the model.
    pub contacts: Vec<Contact>,
    /// The contact mode of each sliding joint.
    pub joints: Vec<JointMode>,
    /// The hinge forces.
    pub hinges: Vec<Hinge>,
    /// The ends of blocks on round rods; absent without.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub round_ends: Vec<RoundEnd>,
    /// What joints carry out of the drawing, and the friction of their collars; absent of a planar model.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub carried: Vec<Carried>,
    /// The accelerations of the bodies.
    pub bodies: Vec<Body>,
    /// The accelerations of the chosen coordinates.
    pub coordinates: Vec<CoordinateAcceleration>,
    /// True if it is proven that the loads and weights push the motion and friction takes more power than they
    /// give; never with drives.
    pub friction_exceeds_loads: bool,
    /// The efforts of the drives.
    pub drives: Vec<Drive>,
    /// Greatest relative residual of a body's force and moment balance, recomputed independently.
    pub residual: f64,
}

impl Solution {
    /// Its forces, moments and pressures with their SI units.
    fn efforts(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        let contacts = self.contacts.iter().flat_map(|contact| {
            let forces = [contact.normal_force, contact.friction_force].map(|force| ("N", force));
            let couple = contact.couple.map(|couple| ("N m", couple));
            forces.into_iter().chain(couple).chain(contact.pressure.map(|pressure| ("Pa", pressure)))
        });
        let hinges = self.hinges.iter().flat_map(|hinge| hinge.force.map(|force| ("N", force)));
        let ends = self.round_ends.iter().map(|end| ("N", end.normal_force));
        let carried = self.carried.iter().map(|carried| (carried.unit, carried.value));
        contacts
            .chain(hinges)
            .chain(ends)
            .chain(carried)
            .chain(self.drives.iter().map(|drive| (drive.unit, drive.effort)))
    }

    /// A state at a contact.
    ///
    /// # Panics
    /// If the mechanism has no such contact.
    pub fn contact(&self, id: ContactId) -> &Contact {
        &self.contacts[id.index()]
    }

    /// The acceleration of a body.
    ///
    /// # Panics
    /// If the mechanism has no such body.
    pub fn body(&self, id: BodyId) -> &Body {
        &self.bodies[id.index()]
    }

    /// The acceleration of a chosen coordinate.
    ///
    /// # Panics
    /// If the mechanism has no such coordinate.
    pub fn coordinate(&self, id: CoordinateId) -> &CoordinateAcceleration {
        &self.coordinates[id.index()]
    }

    /// The effort of a drive.
    ///
    /// # Panics
    /// If the mechanism has no such drive.
    pub fn drive(&self, id: DriveId) -> &Drive {
        &self.drives[id.index()]
    }
}

/// The kind of proof of a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CertificateKind {
    /// It exists for the exact mechanism, inside of its mode.
    Proven,
    /// Some normal force or determinant is zero within the rounding of the mechanism's numbers.
    OnBoundary,
    /// It was found within tolerances only.
    NotProven,
}

/// A mode whose outcome is not decided within the bounds of the mechanism's numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct UndecidedMode {
    /// Its pattern.
    pub pattern: String,
    /// The contact mode of each sliding joint.
    pub joints: Vec<JointMode>,
    /// The contacts whose normal force may be zero; none if the determinant may.
    pub contacts: Vec<String>,
}

/// Why margins of friction were not computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum MarginsMissing {
    /// There are too many modes.
    TooManyModes,
    /// A guided slider is between its faces, which is no mode that could be followed.
    BetweenFaces,
    /// Nothing presses a contact, so that its preload may rub at either face.
    NothingPresses,
    /// The block floats within the play of redundant guides.
    Floats,
    /// There are infinitely many solutions.
    Undetermined,
    /// Solutions with friction in hinges are not followed all together.
    FrictionInHinges,
    /// Nor are those with friction on round rods.
    FrictionOnRods,
}

impl MarginsMissing {
    /// In words, after "because".
    pub(crate) fn in_words(self) -> &'static str {
        match self {
            Self::TooManyModes => "there are too many modes",
            Self::BetweenFaces => "a guided slider is between its faces",
            Self::Undetermined => "there are infinitely many solutions",
            Self::Floats => "the block floats within its play",
            Self::NothingPresses => "nothing presses a contact whose preload differs by side",
            Self::FrictionInHinges => {
                "hinges have friction (`slideway limits` with `--vary friction=1..10` tells when the number of solutions changes)"
            }
            Self::FrictionOnRods => {
                "round rods have friction (`slideway limits` with `--vary friction=1..10` tells when the number of solutions changes)"
            }
        }
    }
}

/// By which factors all coefficients of friction together may grow before the answer changes.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Margins {
    /// Up to this factor there is the same number of solutions (and of gap states); absent if it never
    /// changes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub another_count: Option<f64>,
    /// The coefficient of friction of all contacts, to which the factors apply; absent where contacts differ in theirs, and
    /// where none has friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mu: Option<f64>,
    /// Just beyond this factor there is no solution, so that nothing moves; absent if there always is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_solution: Option<f64>,
    /// The guided sliders that tip there, so that friction need not lock it: as block sliders they show whether it
    /// moves on.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tips: Vec<String>,
    /// From where on a block that may lift off tips over one of its corners, while there is a solution; absent if none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tipping: Option<TippingLimit>,
    /// With less friction: below which it tips or jams; absent if nothing happens down to none, and where it tips or jams as it
    /// is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub below: Option<TippingLimit>,
    /// Of what tips as it is: between which factors of friction it does; absent elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tips_between: Option<TippingRange>,
    /// From this greater factor on there are solutions again; absent if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solutions_again: Option<f64>,
    /// Up to this factor every load has exactly one solution (below 1: some other load has none or several
    /// already): there a determinant is proven to change its sign. Of redundant guides, for every play, misalignment
    /// and stiffness, too (theory, eq. (R4)). Absent if no determinant changes its sign, or if that was not asked
    /// because preloads jump with the side of contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uniqueness: Option<f64>,
    /// Where there is no solution: to what all friction would have to fall for one; absent where there is one, and
    /// where none comes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moves_below: Option<Unlocking>,
    /// Where there is no solution: the mode that locks last as all friction grows to the present one; absent where none
    /// does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub locking: Option<LockedMode>,
    /// The contact whose friction alone changes the number of solutions first; absent if none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub critical_contact: Option<CriticalContact>,
}

/// The friction from which on something tips, or below which.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TippingLimit {
    /// As a factor of that of the model.
    pub factor: f64,
    /// The joints that tip; none where it jams.
    pub joints: Vec<String>,
}

/// The factors of friction between which something tips.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TippingRange {
    /// Absent if it tips down to no friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
    /// Absent if it tips however great the friction is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
}

/// The friction below which a mechanism that is locked would move.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Unlocking {
    /// As a factor of that of the model, below 1.
    pub factor: f64,
    /// The coefficient itself; absent where contacts with friction differ in theirs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mu: Option<f64>,
}

/// The contact whose coefficient of friction matters most.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CriticalContact {
    /// Its name.
    pub contact: String,
    /// The factor by which its friction alone may grow before there is another number of solutions.
    pub factor: f64,
}

/// By which factor all friction may grow before a mode ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModeMargin {
    /// The factor; absent if the mode never ends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factor: Option<f64>,
    /// The cause of its end.
    pub ends_with: ModeEndCause,
    /// The contacts that end it.
    pub contacts: Vec<String>,
}

/// Results for all values of parameters that are known within bounds only.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Uncertainty {
    /// The parameters and their bounds.
    pub parameters: Vec<UncertainParameter>,
    /// For every value there are at least so many solutions.
    pub least_solutions: usize,
    /// For every value there are at most so many solutions; absent if that could not be proven.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub most_solutions: Option<usize>,
    /// The numbers of solutions that are proven for some values each, in ascending order.
    pub proven_counts: Vec<usize>,
    /// The number of solutions along the parameter, in ascending order of its values; empty with several parameters.
    pub stretches: Vec<CountStretch>,
    /// The modes that exist for some value, and those of which that could not be ruled out.
    pub modes: Vec<UncertainMode>,
    /// The parts into which the ranges were divided.
    pub parts: usize,
    /// Why parts of the ranges could not be searched; empty if all were.
    pub open: Vec<String>,
}

/// A part of the range of an uncertain parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CountStretch {
    /// Its least value (SI units).
    pub from: f64,
    /// Its greatest value.
    pub to: f64,
    /// For every value in it there are at least so many solutions.
    pub least_solutions: usize,
    /// For every value in it there are at most so many solutions; absent if that could not be proven.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub most_solutions: Option<usize>,
}

/// A parameter that is known within bounds.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct UncertainParameter {
    /// Its name.
    pub name: String,
    /// Its lower bound (SI units).
    pub from: f64,
    /// Its upper bound.
    pub to: f64,
    /// The value for which the rest of the report holds: the middle.
    pub value: f64,
    /// The unit in which texts show it.
    #[serde(skip)]
    pub shown_in: Unit,
}

/// A mode that exists for some values of the uncertain parameters, or perhaps does.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct UncertainMode {
    /// Its pattern.
    pub pattern: String,
    /// The contact mode of each sliding joint.
    pub joints: Vec<JointMode>,
    /// For which values it has a solution.
    pub persistence: Persistence,
    /// Proven bounds of the normal force of each contact, where the mode exists (N); absent where there are
    /// none, or some values could not be decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal_force_bounds: Option<Vec<[f64; 2]>>,
}

/// For which values of the uncertain parameters a mode has a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Persistence {
    /// For all, proven.
    AllValues,
    /// For some, proven; not for all, or that could not be proven.
    SomeValues,
    /// Whether it has one for any value could not be decided.
    Undecided,
}

/// A contact in a solution. Signs as in theory, section 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Contact {
    /// "joint", "joint.front" or "joint.rear".
    pub name: String,
    /// 1 where the normal force is positive, -1 where it is negative, 0 where it vanishes.
    pub side: i8,
    /// Normal force on the block along n (N).
    pub normal_force: f64,
    /// Proven bounds of the normal force (N); absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal_force_bounds: Option<[f64; 2]>,
    /// Friction force, positive against positive sliding (N).
    pub friction_force: f64,
    /// Sliding velocity of the block against the guide along u (m/s).
    pub sliding_velocity: f64,
    /// Couple of a guided slider about the middle of the pressed face (N m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub couple: Option<f64>,
    /// Mean bearing pressure, the normal force over length and width of the pad (Pa); absent without a pad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure: Option<f64>,
    /// In a preload gap: the share of the preload friction at the face of positive normal force.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preload_share: Option<f64>,
    /// Of a contact that shares its load with others: by how much the block is displaced against its guide there,
    /// towards +n (m); within its play where the contact is open.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deflection: Option<f64>,
    /// Of a contact that lifts off, whose `side` is -1: the acceleration of its gap (m/s^2).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap_acceleration: Option<f64>,
}

/// The contact mode of a sliding joint.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct JointMode {
    /// Its name.
    pub name: String,
    /// The mode in words: "touching at lower right and upper left".
    pub mode: String,
    /// What it does on a face that it may leave; absent on a guide that holds it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face: Option<OnFace>,
    /// How it starts from rest: 1 if it slides along its guide, -1 if against it, 0 if it sticks; absent of what is not at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slip: Option<i8>,
    /// Where it touches, in words; empty where `face` says all.
    #[serde(skip)]
    place: String,
    /// How it starts, in words without numbers: "sticks", "slides forwards".
    #[serde(skip)]
    start: &'static str,
}

/// What a corner or a block does on a face that it may leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum OnFace {
    /// It stays there.
    Closed,
    /// One corner of a block stays, the other one leaves it.
    Tips,
    /// It leaves.
    Opens,
}

/// The contact mode of a joint: what it does on a face that it may leave, where it touches, and about which line it tips.
#[derive(Debug, Default)]
pub(crate) struct ModeInWords {
    pub(crate) face: Option<OnFace>,
    pub(crate) place: String,
    pub(crate) line: Option<String>,
}

impl JointMode {
    pub(crate) fn new(name: String, ModeInWords { face, place, line }: ModeInWords) -> Self {
        let mut joint = Self { name, mode: String::new(), face, slip: None, place, start: "" };
        joint.mode = match (face, line) {
            (Some(OnFace::Tips), Some(line)) => format!("{}: it tips about the line {line}", joint.place()),
            (Some(OnFace::Tips), None) => format!("{}: it tips", joint.place()),
            _ => joint.place().to_owned(),
        };
        joint
    }

    /// Where it touches: "on its left corner", "closed".
    pub(crate) fn place(&self) -> &str {
        match self.face {
            Some(OnFace::Opens) if self.place.is_empty() => "lifts off",
            Some(OnFace::Closed) if self.place.is_empty() => "closed",
            _ => &self.place,
        }
    }

    /// Has it stick from rest, in this word for it.
    pub(crate) fn sticks(&mut self, word: &'static str) {
        self.mode = format!("{}, {word}", self.mode);
        (self.slip, self.start) = (Some(0), word);
    }

    /// Has it slide from rest in the direction of its guide or against it, which these words say with numbers.
    pub(crate) fn slides(&mut self, slip: i8, words: &str) {
        self.mode = format!("{}, {words}", self.mode);
        (self.slip, self.start) = (Some(slip), if slip > 0 { "slides forwards" } else { "slides backwards" });
    }

    /// What it does, without numbers: "on its left corner, sticks", "slides forwards".
    pub(crate) fn start(&self) -> String {
        match (&*self.place, self.start) {
            (_, "") => self.place().to_owned(),
            ("", start) => start.to_owned(),
            (place, start) => format!("{place}, {start}"),
        }
    }
}

/// An end of a block on a round rod. Among the contacts it has two parts, along n and along z.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RoundEnd {
    /// "joint.front" or "joint.rear", or with the name of a support.
    pub name: String,
    /// The force of the rod on the block across it (N).
    pub normal_force: f64,
    /// Where that pushes the block: an angle from n towards z (rad).
    pub direction: f64,
    /// Friction force, positive against positive sliding (N).
    pub friction_force: f64,
}

/// A hinge force.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Hinge {
    /// The hinge.
    pub name: String,
    /// The body on which the force is counted.
    pub on: String,
    /// Its components (N).
    pub force: [f64; 2],
    /// Its friction; absent of a hinge without friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<HingeFriction>,
}

/// Friction in a hinge that turns.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct HingeFriction {
    /// Friction couple on the body on which the force is counted (N m): radius times hinge force, against the rotation.
    pub couple: f64,
    /// Radius of the friction circle, to which the hinge force is tangent (m).
    pub radius: f64,
    /// Angular velocity of that body against the other one (rad/s).
    pub angular_velocity: f64,
}

/// A force or moment that a joint carries out of the drawing without friction.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Carried {
    /// The joint.
    pub name: String,
    /// The body on which it is counted.
    pub on: String,
    /// Which one it is.
    pub quantity: CarriedQuantity,
    /// Its value.
    pub value: f64,
    /// "N" or "N m".
    pub unit: &'static str,
}

/// What a joint carries out of the drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CarriedQuantity {
    /// A force along z, out of the drawing.
    ForceZ,
    /// The couple of friction of the collar that carries this force.
    Collar,
    /// A moment about the x axis, of a hinge.
    MomentX,
    /// A moment about the y axis, of a hinge.
    MomentY,
    /// A moment about the direction of sliding.
    Roll,
    /// A moment about the normal of a guide in the drawing.
    Pitch,
}

impl CarriedQuantity {
    /// "force along z on", "moment of roll on".
    fn in_words(self) -> &'static str {
        match self {
            Self::ForceZ => "force along z on",
            Self::Collar => "friction couple of the collar on",
            Self::MomentX => "moment about x on",
            Self::MomentY => "moment about y on",
            Self::Roll => "moment of roll on",
            Self::Pitch => "moment of pitch on",
        }
    }

    /// As JSON has it.
    fn key(self) -> &'static str {
        match self {
            Self::ForceZ => "force_z",
            Self::Collar => "collar",
            Self::MomentX => "moment_x",
            Self::MomentY => "moment_y",
            Self::Roll => "roll",
            Self::Pitch => "pitch",
        }
    }
}

/// Acceleration of a body, and what is left over in its balance.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Acceleration of the centre of mass (m/s^2).
    pub acceleration: [f64; 2],
    /// Angular acceleration (rad/s^2).
    pub angular_acceleration: f64,
    /// Of a body that lifts off or tips out of the drawing: its acceleration along z (m/s^2), and its angular accelerations
    /// about x and y (rad/s^2); absent of others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub out_of_plane: Option<[f64; 3]>,
    /// Left-over force of the recomputed balance (N).
    pub residual_force: f64,
    /// Left-over moment of the recomputed balance (N m).
    pub residual_moment: f64,
}

/// Acceleration of a chosen coordinate.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CoordinateAcceleration {
    /// The coordinate.
    pub name: String,
    /// "m/s^2" or "rad/s^2".
    pub unit: &'static str,
    /// Its acceleration.
    pub acceleration: f64,
    /// Proven bounds of its acceleration; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration_bounds: Option<[f64; 2]>,
    /// The change of its speed; absent if a drive prescribes its motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed: Option<SpeedChange>,
    /// If it slows down: when and where it stops if its acceleration stays as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<Stopping>,
}

/// The effort of a drive.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Drive {
    /// The drive.
    pub name: String,
    /// "N" or "N m".
    pub unit: &'static str,
    /// The force or torque that produces the prescribed motion.
    pub effort: f64,
    /// True if it acts against the motion.
    #[serde(skip)]
    pub(crate) holds_back: bool,
}

/// Infinitely many solutions of one mode: all convex combinations of the vertices plus all non-negative
/// multiples of the directions.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Continuum {
    /// Its pattern.
    pub pattern: String,
    /// Whether it stays at rest in all of it, as in [`Solution::rests`].
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub rests: bool,
    /// Normal forces of the contacts at each vertex (N); none if there are more than 4096 vertices and directions.
    pub vertices: Vec<Vec<f64>>,
    /// Directions in which the normal forces may grow without bound.
    pub directions: Vec<Vec<f64>>,
    /// Efforts and accelerations at each vertex; none where a preload may rub at either face.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<DrivenMotion>,
    /// The contributions of a unit of each direction to them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub motion_along: Vec<DrivenMotion>,
    /// The guided sliders that would tip in a part of it.
    pub tipping: Vec<String>,
    /// The friction couple of a hinge that never turns, if it is what is free; absent otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub couple: Option<CoupleRange>,
    /// The friction of contacts and hinges that stand still while the rest moves, if it is what is free; empty otherwise.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<HeldFriction>,
}

/// The friction of a contact or hinge that stands still while the rest moves, over a range.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct HeldFriction {
    /// The contact, or the hinge.
    pub name: String,
    /// "N", or "N m" of a hinge.
    pub unit: &'static str,
    /// At each vertex: the friction force, positive against positive sliding, or the couple on the hinge's first body.
    pub at: Vec<f64>,
    /// The contributions of a unit of each direction to it.
    pub along: Vec<f64>,
}

/// The efforts of the drives, and the accelerations of the coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DrivenMotion {
    /// Of each drive (N or N m).
    pub efforts: Vec<f64>,
    /// Of each coordinate (m/s^2 or rad/s^2).
    pub accelerations: Vec<f64>,
}

/// The friction couple of a hinge that never turns, over a range.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CoupleRange {
    /// The hinge.
    pub hinge: String,
    /// The couple on its first body at each vertex (N m).
    pub couples: Vec<f64>,
}

/// A mode with a vanishing determinant and no solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LockedMode {
    /// Its pattern.
    pub pattern: String,
    /// The part of the friction of the model at which its determinant vanishes, at most 1.
    pub factor: f64,
    /// The contact mode of each sliding joint.
    pub joints: Vec<JointMode>,
}

/// A solution of the equations that is none of the mechanism.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Rejection {
    /// Its pattern.
    pub pattern: String,
    /// The guided slider that would tip.
    pub joint: String,
    /// The couple it would need (N m).
    pub couple: f64,
    /// The greatest couple that its pressure gives: |N| L / 2 (N m).
    pub limit: f64,
    /// Normal forces of all contacts (N).
    pub normal_forces: Vec<f64>,
    /// Friction forces of all contacts, positive against positive sliding (N).
    pub friction_forces: Vec<f64>,
    /// Couples of all contacts about the middle of the pressed face, 0 of those that have none (N m).
    pub couples: Vec<f64>,
    /// Efforts of all drives (N or N m).
    pub efforts: Vec<f64>,
}

/// A mode without a solution, close to locking.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ClosestMode {
    /// Its pattern.
    pub pattern: String,
    /// Determinant D.
    pub determinant: f64,
    /// D times the product of the signs; not positive beyond locking.
    pub oriented_determinant: f64,
    /// The contact mode of each sliding joint.
    pub joints: Vec<JointMode>,
    /// The value of |N| in the equations of the mode, of each contact (N); a negative value contradicts the mode.
    pub absolute_normal_forces: Vec<f64>,
}

/// The frictionless answer and the influence coefficients.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct InfluenceSummary {
    /// Accelerations of the coordinates without friction.
    pub coordinate_accelerations: Vec<f64>,
    /// Normal forces without friction, N(0) (N).
    pub normal_forces: Vec<f64>,
    /// The drives with their efforts without friction.
    pub drives: Vec<Drive>,
    /// eta_jk for friction at the faces of positive normal force; row j is the contact that answers.
    pub eta_positive: Vec<Vec<f64>>,
    /// As above, at the faces of negative normal force.
    pub eta_negative: Vec<Vec<f64>>,
}
