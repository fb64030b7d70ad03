//! Faults of the input: every kind with its values, its place and a hint.
//!
//! Faults are collected, so that a person learns of all of them at once.

mod axis;
mod doubt;
mod face;
mod no_sliding;

pub use axis::AxisProblem;
pub use doubt::Doubt;
pub use face::{CommandLine, Face};
pub use no_sliding::NoSliding;
pub(crate) use no_sliding::{MOST_CONTACTS, MOST_STANDING};
pub use slideway_modes::names::nearest;

use crate::expression::{Dimension, ExpressionFaultKind, ends_of_range};
use crate::printable;
use crate::units::Unit;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// A text in which a fault can lie.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    /// The model file.
    Model,
    /// The value of the n-th setting (`--set`, `--at`, `--rate`), counted from 0 in the order of
    /// [`crate::model::Settings::entries`].
    Setting(usize),
    /// An argument that is no setting, such as `mu=0..1`.
    Argument(Arc<str>),
}

/// A stretch of one of the texts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Which text.
    pub source: Source,
    /// Bytes in it.
    pub span: Range<usize>,
}

impl Place {
    /// A stretch of the model file.
    pub fn model(span: Range<usize>) -> Self {
        Self { source: Source::Model, span }
    }
}

/// One fault of the input.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// Kind of fault; its text is the message.
    pub kind: FaultKind,
    /// Where; nothing where the fault concerns the input as a whole.
    pub place: Option<Place>,
}

impl Fault {
    /// A fault at a place.
    pub fn new(kind: FaultKind, place: Place) -> Self {
        Self { kind, place: Some(place) }
    }

    /// The fault with the name of the quantity whose formula has no value.
    #[must_use]
    pub(crate) fn in_formula(self, what: &str) -> Self {
        let kind = match self.kind {
            FaultKind::Expression(kind @ ExpressionFaultKind::NotFinite { .. }) => {
                FaultKind::WithoutValue { what: what.to_owned(), kind }
            }
            kind => kind,
        };
        Self { kind, ..self }
    }

    /// A fault of an argument that is no setting.
    pub fn of_argument(kind: FaultKind, text: &str, span: Range<usize>) -> Self {
        Self::new(kind, Place { source: Source::Argument(Arc::from(text)), span })
    }

    /// A fault of the input as a whole.
    pub fn general(kind: FaultKind) -> Self {
        Self { kind, place: None }
    }
}

/// All faults that were found; never empty where it is returned as an error.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Faults {
    list: Vec<Fault>,
}

impl Faults {
    /// Those of a place among which a quantity of a dimension is wanted propose units of that dimension.
    pub(crate) fn propose_units(&mut self, wanted: impl Fn(&Place) -> Option<Dimension>) {
        for fault in &mut self.list {
            if let (FaultKind::Expression(kind), Some(place)) = (&mut fault.kind, &fault.place) {
                wanted(place).into_iter().for_each(|dimension| kind.propose_units(dimension));
            }
        }
    }

    /// Adds one.
    pub fn push(&mut self, fault: Fault) {
        self.list.push(fault);
    }

    /// Adds several.
    pub fn extend(&mut self, faults: impl IntoIterator<Item = Fault>) {
        self.list.extend(faults);
    }

    /// Whether some text could not be read at all.
    pub(crate) fn has_syntax_fault(&self) -> bool {
        self.list.iter().any(|fault| matches!(fault.kind, FaultKind::Syntax { .. }))
    }

    /// The sections of the file whose entries are not known, because their heading is misspelt or faulty.
    fn unknown_sections(&self) -> Vec<String> {
        let section = |fault: &Fault| match &fault.kind {
            FaultKind::UnknownKey { nearest: Some(nearest), table, .. } if table.is_empty() => {
                Some(nearest.clone())
            }
            FaultKind::NoHeading { section } => Some(section.clone()),
            _ => None,
        };
        self.list.iter().filter_map(section).collect()
    }

    /// Leaves out the unknown names of entries whose section is not known.
    #[must_use]
    pub(crate) fn without_names_of_unknown_sections(mut self) -> Self {
        let sections = self.unknown_sections();
        let unknown = |section: &str| sections.iter().any(|unknown| unknown == section);
        self.list.retain(|fault| match &fault.kind {
            FaultKind::UnknownName { what, .. } => !match *what {
                "point" => unknown("points"),
                "coordinate" => unknown("coordinates"),
                "body" | "moving body" => unknown("bodies"),
                _ => unknown("joints"),
            },
            FaultKind::MissingKey { key, table } => !(table.is_empty() && unknown(key)),
            FaultKind::NotOwned { .. } => !unknown("bodies"),
            FaultKind::Expression(
                ExpressionFaultKind::UnknownName { .. } | ExpressionFaultKind::UnknownUnit { .. },
            ) => !unknown("parameters") && !unknown("coordinates"),
            _ => true,
        });
        self
    }

    /// Leaves out what others bring with them: formulas without a value where some quantity has the wrong dimension, and
    /// what an entry lacks where the key for it is misspelt.
    #[must_use]
    pub(crate) fn without_consequences(mut self) -> Self {
        let is_wrong = |fault: &Fault| matches!(fault.kind, FaultKind::WrongDimension { .. });
        let has_wrong_dimension = self.list.iter().any(is_wrong);
        let misspelt = |fault: &Fault| match &fault.kind {
            FaultKind::UnknownKey { table, nearest: Some(meant), .. } => Some((table.clone(), meant.clone())),
            _ => None,
        };
        let misspelt: Vec<(String, String)> = self.list.iter().filter_map(misspelt).collect();
        let is_meant = |owner: &str, one_of: &[&str]| {
            let name = owner.rsplit(' ').next();
            misspelt.iter().any(|(table, meant)| {
                // The shape of a bar has its centre of mass.
                let gives =
                    one_of.contains(&meant.as_str()) || meant == "shape" && one_of == ["centre_of_mass"];
                gives && table.rsplit('.').next() == name
            })
        };
        self.list.retain(|fault| match &fault.kind {
            FaultKind::WithoutValue { .. } => !has_wrong_dimension,
            FaultKind::NoneOf { owner, one_of } => !is_meant(owner, one_of),
            _ => true,
        });
        self
    }

    /// Moves the faults that lie in a setting or have no place to an argument: `span` gives the place there
    /// for the one in the setting.
    #[must_use]
    pub(crate) fn in_argument(self, text: &str, span: impl Fn(Option<Range<usize>>) -> Range<usize>) -> Self {
        let moved = |fault: Fault| match fault.place {
            Some(Place { source: Source::Setting(_), span: place }) => {
                Fault::of_argument(fault.kind, text, span(Some(place)))
            }
            None => Fault::of_argument(fault.kind, text, span(None)),
            Some(_) => fault,
        };
        Self { list: self.list.into_iter().map(moved).collect() }
    }

    /// Leaves out what may only follow from text that could not be read: whatever seems to be absent.
    #[must_use]
    pub(crate) fn without_absences(mut self) -> Self {
        self.list.retain(|fault| !fault.kind.is_absence());
        self
    }

    /// Adds those of another stage.
    pub fn append(&mut self, mut other: Self) {
        self.list.append(&mut other.list);
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The faults in the order of their places, each once: those of the file, of settings, of other arguments; faults
    /// without a place come last.
    pub fn sorted(&self) -> Vec<&Fault> {
        let mut sorted: Vec<&Fault> = self.list.iter().collect();
        sorted.sort_by_key(|fault| match &fault.place {
            Some(Place { source: Source::Model, span }) => (0, 0, span.start),
            Some(Place { source: Source::Setting(index), span }) => (1, *index, span.start),
            Some(Place { source: Source::Argument(_), span }) => (2, 0, span.start),
            None => (3, 0, 0),
        });
        // What is written once for two contacts may be found at each of them.
        let mut unique: Vec<&Fault> = Vec::with_capacity(sorted.len());
        for fault in sorted {
            let mut beside = unique.iter().rev().take_while(|other| other.place == fault.place);
            if !beside.any(|other| *other == fault) {
                unique.push(fault);
            }
        }
        unique
    }

    /// `value` if nothing is wrong, else the faults.
    ///
    /// # Errors
    /// The faults, if there are any.
    pub fn or<T>(self, value: T) -> Result<T, Self> {
        if self.is_empty() { Ok(value) } else { Err(self) }
    }
}

impl From<Fault> for Faults {
    fn from(fault: Fault) -> Self {
        Self { list: vec![fault] }
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.sorted().iter().map(|fault| fault.kind.to_string()).collect();
        let printable: Vec<_> = lines.iter().map(|line| printable::line(line)).collect();
        formatter.write_str(&printable.join("\n"))
    }
}

impl std::error::Error for Faults {}

/// Kind of fault, with the values that matter.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message above each variant says what it and its values mean")]
pub enum FaultKind {
    // The text as a whole.
    #[error("the model file is empty")]
    Empty,
    #[error("the model file is not UTF-8 text: the byte 0x{byte:02X} is not part of a character here")]
    NotUtf8 { byte: u8 },
    #[error("the model file is larger than {} MiB, too large for a model", limit >> 20)]
    TooLarge { limit: u64 },
    #[error("not valid TOML: {message}")]
    Syntax { message: String },

    // Its tables and keys.
    #[error("unknown key `{key}`{}", in_table(table))]
    UnknownKey { key: String, table: String, nearest: Option<String>, known: Vec<String> },
    #[error("`{key}` is missing{}", in_table(table))]
    MissingKey { key: String, table: String },
    #[error("`{table}` has no `type`")]
    MissingType { table: String, known: Vec<String> },
    #[error("`{section}` contains tables, each with a name in its heading")]
    NoHeading { section: String },
    #[error("`{place}` cannot be \"{word}\"")]
    UnknownWord { place: String, word: String, nearest: Option<String>, known: Vec<String> },
    #[error("`{place}` must be {wanted}, not {found}")]
    WrongType { place: String, wanted: String, found: &'static str },
    #[error("`{place}` must have {wanted} values, not {found}")]
    WrongLength { place: String, wanted: u64, found: usize },
    #[error("`{place}` must have at least {least} values, not {found}")]
    TooShort { place: String, least: u64, found: usize },
    #[error("{owner} has both `{first}` and `{second}`")]
    Both { owner: String, first: &'static str, second: &'static str },
    #[error("{owner} has {}", none_of(one_of))]
    NoneOf { owner: String, one_of: Vec<&'static str> },
    #[error("{owner} has a `{first}` without a `{second}`")]
    Without { owner: String, first: &'static str, second: &'static str },
    #[error("the outline of {body} has a `{{ through = .. }}` that is not the only one between two corners")]
    OutlineArcs { body: String },

    // Names.
    #[error("there is no {what} named `{name}`")]
    UnknownName { what: &'static str, name: String, nearest: Option<String>, known: Vec<String> },
    #[error("`{name}` cannot be the name of a {what}: {reason}")]
    InvalidName { what: &'static str, name: String, reason: &'static str },
    #[error("`{name}` is the name of a parameter and of a coordinate")]
    SharedName { name: String },
    #[error("two contacts are named `{name}`")]
    SharedContact { name: String },
    #[error("`{name}` is the name of a table and of a parameter or coordinate")]
    TableSharesName { name: String },
    #[error("the point `{point}` does not belong to {body}")]
    NotOwned { body: String, point: String, owners: Vec<String> },
    #[error("the point `{point}` belongs to several bodies ({})", owners.join(", "))]
    SeveralOwners { point: String, owners: Vec<String> },

    // Quantities.
    #[error("{0}")]
    Expression(ExpressionFaultKind),
    #[error("the formula of {what} has no value: {kind}")]
    WithoutValue { what: String, kind: ExpressionFaultKind },
    #[error("{found} where {wanted} is expected")]
    WrongDimension { wanted: Dimension, found: Dimension },
    #[error("{what} cannot depend on the motion, but it uses `{symbol}`")]
    DependsOnMotion { what: String, symbol: String },
    #[error("{what} must not depend on the sliding speed, but it uses `sliding_speed`")]
    DependsOnSlidingSpeed { what: String },
    #[error("at the sliding speed {speed} m/s: {fault}")]
    AtSlidingSpeed { speed: f64, fault: Box<FaultKind> },
    #[error("parameters refer to each other circularly: {}", cycle.join(" -> "))]
    CircularParameters { cycle: Vec<String> },
    #[error("{what} must be {wanted}, but is {value}")]
    OutOfRange { what: String, wanted: &'static str, value: String },
    #[error("{relation} is needed: {meaning}")]
    NeedUnmet { relation: String, meaning: String },
    #[error("the parts do not meet with {name} = {value} ({meaning})")]
    PartsApart { name: String, value: String, meaning: String },
    #[error(
        "the tolerance {tolerance:e} is finer than floating point resolves: positions of this mechanism are rounded to {least:.1e} of its size"
    )]
    ToleranceTooSmall { tolerance: f64, least: f64 },
    #[error("`{text}` is not a value or range of {name}")]
    MalformedRange { text: String, name: String },
    #[error("{what} needs a range: {name}=FROM..TO")]
    RangeNeeded { what: String, name: String },
    #[error("the range of {what} is empty: it begins and ends at {from}")]
    EmptyRange { what: String, from: String },
    #[error("nothing in the mode problem depends on {what} between {from} and {to}")]
    NothingVaries { what: String, from: String, to: String },
    #[error("{what} cannot be both axes of a map")]
    SameAxes { what: String },
    #[error("{contacts} contacts have more contact modes than the {limit} whose limits are computed")]
    TooManyModes { contacts: usize, limit: u64 },
    #[error(
        "the table {name} has {arguments} arguments and {values} values; it needs equal numbers of both, at least one"
    )]
    TableLengths { name: String, arguments: usize, values: usize },
    #[error("the arguments of the table {name} decrease at number {row}")]
    TableFalls { name: String, row: usize },
    #[error("a table contains constants only, nothing that depends on time")]
    TableOfTime,
    #[error("{what} is not a finite number")]
    NotFinite { what: String },
    #[error("the loads or drives grow without bound")]
    LoadsWithoutBounds,
    #[error(
        "the impact of {} can have {}",
        joints.join(" and "),
        if outcomes.is_empty() { "several outcomes".to_owned() } else { format!("{} outcomes: {}", outcomes.len(), outcomes.join("; ")) }
    )]
    SeveralImpacts { joints: Vec<String>, outcomes: Vec<String> },
    #[error("the impact of {} could not be decided: not all possible impulses were found", joints.join(" and "))]
    UnsolvedImpact { joints: Vec<String> },
    #[error(
        "the impact of {} has no possible impulse: friction wedges what moves first",
        joints.join(" and ")
    )]
    ImpactWedges { joints: Vec<String> },
    #[error(
        "the impact of {} has no possible impulse: {} would tip",
        joints.join(" and "),
        tipping.join(" and ")
    )]
    ImpactTips { joints: Vec<String>, tipping: Vec<String> },
    #[error("the static friction coefficient {mu_static} of {contact} is below its kinetic one, {mu}")]
    StaticBelowKinetic { contact: String, mu: f64, mu_static: f64 },
    #[error("the static friction radius {static_radius} m of {hinge} is below its kinetic one, {radius} m")]
    StaticRadiusBelowKinetic { hinge: String, radius: f64, static_radius: f64 },
    #[error("the points `{first}` and `{second}` coincide: they give no direction")]
    CoincidentPoints { first: String, second: String },
    #[error("the travel limits of {joint} are reversed: {least} m is not below {greatest} m")]
    ReversedTravel { joint: String, least: f64, greatest: f64 },

    // Topology.
    #[error("the model has no bodies")]
    NoBodies,
    #[error("the model has {bodies} bodies; at most {limit} are accepted")]
    TooManyBodies { bodies: usize, limit: usize },
    #[error("{joint} joins {body} to itself")]
    SelfJoint { joint: String, body: String },
    #[error("{joint} duplicates {other}: the same joint of the same bodies")]
    DoubledJoint { joint: String, other: String },
    #[error("{} not connected to ground by any joint", are(bodies))]
    FloatingBodies { bodies: Vec<String> },
    #[error("two drives move the coordinate `{coordinate}`")]
    DoubledDrive { coordinate: String },

    // Settings.
    #[error("`{text}` is not of the form name=value")]
    MalformedSetting { text: String },

    #[error("`{text}`: {problem}")]
    Axis { text: String, problem: AxisProblem },

    // What makes sense, but is perhaps not meant.
    #[error("{0}")]
    Doubt(Doubt),

    // Degrees of freedom and coordinates.
    #[error("the structure is statically indeterminate: {} redundant", constraints(*excess))]
    Redundant { excess: usize, joints: Vec<String>, suggestion: Option<String> },
    #[error(
        "a stiffness is given for some of the contacts that share a load, but not for {}",
        listed(contacts)
    )]
    StiffnessOfSome { contacts: Vec<String> },
    #[error("{} share a load, but with rigid faces and no play nothing says how", listed(contacts))]
    RigidWithoutPlay { contacts: Vec<String> },
    #[error("{question} is not computed for press fits: {}", listed(contacts))]
    PressFit { question: &'static str, contacts: Vec<String> },
    #[error(
        "{question} is not computed beside contacts that stand still while the rest moves: {}",
        listed(contacts)
    )]
    BesideStanding { question: &'static str, contacts: Vec<String> },
    #[error("{question} is not computed for contacts that may lift off: {}", listed(contacts))]
    OneSided { question: &'static str, contacts: Vec<String> },
    #[error(
        "{} may lift off, but with the other joints closed nothing says what each of them carries while it slides",
        listed(contacts)
    )]
    OneSidedInExcess { contacts: Vec<String>, in_space: bool },
    #[error(
        "when {} lifted off, the acceleration could not be computed, as what moves then has no mass: {motion}",
        listed(contacts)
    )]
    LiftsWithoutInertia { contacts: Vec<String>, motion: String },
    #[error("{contact} is not on its face: it is off by {gap}")]
    OffFace { contact: String, gap: String },
    #[error("{joint} is apart from its face, but here it would be {depth} inside it")]
    Penetration { joint: String, depth: String },
    #[error("{joint} is said to be apart from its face, but it touches it, and does not leave it")]
    TouchesThoughApart { joint: String },
    #[error("nothing says how firmly these press fits grip: {}", listed(contacts))]
    PressFitWithoutStiffness { contacts: Vec<String> },
    #[error("a guided slider with a press fit is not computed: {}", listed(contacts))]
    GuidedPressFit { contacts: Vec<String> },
    #[error(
        "the preload of a press fit acts on both faces, but that of {} differs between them",
        listed(contacts)
    )]
    PreloadOfPressFit { contacts: Vec<String> },
    #[error("the play of {contact} is negative for some values only, which makes a press fit of it")]
    PlayChangesSign { contact: String },
    #[error("this question is not answered for hinges with friction: {}", listed(hinges))]
    FrictionInHinges { hinges: Vec<String> },
    #[error("{question} is not computed for guides that share a load: {}", listed(joints))]
    SharedLoad { question: &'static str, joints: Vec<String> },
    #[error(
        "the play of {contact}, {play}, is not less than the distance of the outermost contacts of its block, {distance}"
    )]
    PlayBeyondBlock { contact: String, play: String, distance: String },
    #[error("the guides cannot be assembled: {} are out of line by more than their play", listed(contacts))]
    OutOfLine { contacts: Vec<String> },
    #[error("the redundant guides do not fit together: {joint} is off by {gap}")]
    GuidesDoNotFit { joint: String, gap: String },
    #[error("the position is singular: {} lost there, so the reactions are indeterminate", constraints(*lost))]
    SingularPosition { lost: usize, joints: Vec<String> },
    #[error("{question} is not computed for loads in space")]
    InSpace { question: &'static str },
    #[error("{joint}: {what} is not known in space")]
    JointInSpace { joint: String, what: &'static str },
    #[error(
        "{joint} has friction and carries couples out of the drawing, which press each of its bearings in a way of its own"
    )]
    RoughAndTilted { joint: String },
    #[error("the collar of {joint} carries along z, which {joint} does not")]
    IdleCollar { joint: String },
    #[error(
        "what {} carry out of the drawing is not determined: {excess} of their reactions {} too many",
        listed(joints), if *excess == 1 { "is" } else { "are" }
    )]
    CarriedTwice { joints: Vec<String>, excess: usize },
    #[error(
        "when {} lifted off, {body} would turn out of the drawing, but nothing says with which moments of inertia",
        listed(contacts)
    )]
    UnknownTilt { body: String, contacts: Vec<String> },
    #[error("{joint} rests on {corners} corners, but `rests_on` has 3 or 4")]
    Corners { joint: String, corners: u8 },
    #[error("nothing keeps {body} from {motion}")]
    NotCarried { body: String, motion: String },
    #[error("the mechanism cannot move: its joints leave no degree of freedom")]
    NoFreedom { may_open: bool },
    #[error("{} of freedom, but {}", degrees(*degrees_of_freedom), coordinates(*chosen))]
    CoordinateCount { degrees_of_freedom: usize, chosen: usize, undetermined: Vec<String> },
    #[error("the chosen coordinates do not determine the motion of {}", listed(bodies))]
    DependentCoordinates { bodies: Vec<String> },

    // Assembly of the state.
    #[error("the mechanism cannot be assembled in this state: {} by {gap}", opening(joint, loop_joints))]
    NotAssembled { joint: String, loop_joints: Vec<String>, gap: String, reached: Option<String> },
    #[error("{state} is too far from the drawing: following the motion there ended at {reached}")]
    TooFar { state: String, reached: String, steps: usize },
    #[error("the work was ended before the positions of the bodies were known")]
    WorkEnded,
    #[error("{state} was not reached from the drawing: the joint equations become singular at {reached}")]
    NotFollowed { state: String, reached: String, steps: usize },
    #[error(
        "the block of {joint} is out of its guide: an overlap of {} at a displacement of {}",
        unit.precise(*overlap),
        unit.precise(*displacement)
    )]
    OverlapVanished { joint: String, overlap: f64, displacement: f64, unit: Unit },
    #[error(
        "{joint} is at a displacement of {}, outside its travel from {} to {}",
        unit.precise(*displacement),
        unit.precise(*least),
        unit.precise(*greatest)
    )]
    TravelExceeded { joint: String, displacement: f64, least: f64, greatest: f64, unit: Unit },
    #[error("the length of {load} is zero, so its force has no direction")]
    ZeroLength { load: String },

    // Kinetics.
    #[error("the acceleration cannot be computed, as the moving parts have no mass: {motion}")]
    MotionWithoutInertia { motion: String },
    #[error("the drives cannot produce their motion: {motion}")]
    DriveCannotMove { drives: Vec<String>, motion: String },
    #[error("{} drives {}, but the joints stop it", listed(drives), listed(coordinates))]
    DriveBlocked { drives: Vec<String>, coordinates: Vec<String> },
    #[error("the kinetic equations are too ill-conditioned to be solved (condition {condition:.1e})")]
    IllConditioned { condition: f64 },
    #[error(
        "the sliding velocity of {} is zero, so the direction of friction is undefined",
        listed(contacts)
    )]
    ZeroSlidingVelocity { contacts: Vec<String>, why: NoSliding },
    #[error("{hinge} does not turn, so the direction of its friction couple is undefined")]
    HingeDoesNotTurn { hinge: String, why: NoSliding },

    // Standstill.
    #[error("the load {load} is zero at rest, so no factor changes it")]
    NoLoadAtRest { load: String },
    #[error("self-locking under which load? The model has {}", if known.is_empty() { "none".to_owned() } else { known.join(", ") })]
    HeldLoadNeeded { known: Vec<String> },
    #[error(
        "the efficiency has no value: the motion takes no power without friction, or drives brake what they would push"
    )]
    NoEfficiency,
    #[error("nowhere on the map is there an answer: {reason}")]
    NoAnswerOnMap { reason: String },
    #[error("`{parameter}` needs a range: {parameter}=FROM..TO")]
    NotOnlyFriction { parameter: String },
    #[error("the joints and contacts have {} states; at most {limit} are tried", counted(*states))]
    TooManyStates { states: u64, limit: u64 },
    #[error("the mechanism has {expected} {what}, but {found} are given")]
    WrongCount { what: &'static str, expected: usize, found: usize },

    // Motion.
    #[error("the motion cannot begin in the contact mode `{wanted}`")]
    ContradictoryPhase { wanted: String, possible: Vec<String> },
    #[error("`{text}` is not a contact mode: it needs one of + - 0 = for each of {}", contacts.join(", "))]
    MalformedMode { text: String, contacts: Vec<String> },
    #[error("the end of the simulation, {end} s, is not after its start, {start} s")]
    NothingToSimulate { start: f64, end: f64 },

    // Design and drives.
    #[error("the load {load} plays no part in a margin against locking")]
    LoadUnused { load: String },
    #[error("the limit is in {typed}, which does not fit the drives")]
    LimitUnit { typed: String, wanted: &'static str },
    #[error("whether {what} is held could not be decided")]
    UndecidedAtRest { what: String },
    #[error("the limits of {} could not be computed", modes_in_words(*modes))]
    LimitsNotComputed { modes: usize },
    #[error("a guided slider is between its faces, and how its state changes with friction is not followed")]
    BetweenFaces,
    #[error("at rest there is no direction of motion to reverse")]
    NoDirectionAtRest,
    #[error("the model has no drive, so there is no drive force to find")]
    NoDrives { coordinate: Option<String> },
    #[error("{} `pad`, so there is no bearing pressure", contact.as_ref().map_or("no contact has a".to_owned(), |name| format!("the contact {name} has no")))]
    NoPad { contact: Option<String>, joint: Option<String> },

    // Search for the modes.
    #[error("{contacts} contacts with friction are more than the {limit} that can be handled")]
    TooManyContacts { contacts: usize, limit: usize },
    #[error("{quantity} is too large or too small to compute with")]
    Overflow { quantity: String },
}

impl FaultKind {
    /// As it is said of a whole range: without the place at which it was seen.
    pub(crate) fn of_range(&self) -> String {
        match self {
            Self::OverlapVanished { joint, .. } => format!("the block of {joint} is out of its guide"),
            other => other.to_string(),
        }
    }

    /// Whether a formula has no value at its arguments, as the root of a negative number.
    pub(crate) fn is_without_value(&self) -> bool {
        matches!(self, Self::Expression(ExpressionFaultKind::NotFinite { .. }) | Self::WithoutValue { .. })
    }

    /// Whether something is said to be absent.
    fn is_absence(&self) -> bool {
        matches!(
            self,
            Self::MissingKey { .. }
                | Self::MissingType { .. }
                | Self::NoneOf { .. }
                | Self::Without { .. }
                | Self::UnknownName { .. }
                | Self::NotOwned { .. }
                | Self::NoBodies
                | Self::Expression(
                    ExpressionFaultKind::UnknownName { .. }
                        | ExpressionFaultKind::UnknownUnit { .. }
                        | ExpressionFaultKind::UnknownFunction { .. }
                        | ExpressionFaultKind::NotACoordinate { .. }
                )
        )
    }

    /// Returns a hint in the words of the command line, or `None` if there is nothing better to say than the
    /// message itself.
    pub fn hint(&self) -> Option<String> {
        self.hint_for(&CommandLine)
    }

    /// Returns a hint in the words of an interface, or `None` likewise.
    pub fn hint_for(&self, face: &dyn Face) -> Option<String> {
        self.hint_of_values(face)
            .or_else(|| self.hint_of_face(face))
            .or_else(|| self.hint_in_space().or_else(|| self.fixed_hint()).map(str::to_owned))
    }

    /// Hints that depend on the values.
    fn hint_of_values(&self, face: &dyn Face) -> Option<String> {
        match self {
            Self::Expression(kind) | Self::WithoutValue { kind, .. } => kind.hint().or_else(|| expression_hint(kind)),
            Self::Axis { problem, .. } => problem.hint_for(face),
            Self::NoneOf { one_of, .. } if one_of.contains(&"massless") => Some(
                "write `mass = \"4 kg\"`, or `massless = true` if its weight and inertia do not matter".to_owned(),
            ),
            Self::NoneOf { one_of, .. } if one_of.contains(&"moment_of_inertia") => Some(
                "write the shape of the body, such as `shape = { rectangle = [\"200 mm\", \"100 mm\"] }`, in space `box` with three lengths; or `moment_of_inertia = \"0.1 kg m^2\"` about its centre of mass"
                    .to_owned(),
            ),
            Self::Doubt(doubt) => Some(doubt.hint_for(face)),
            Self::UnknownKey { nearest, known, .. } | Self::UnknownName { nearest, known, .. } => {
                choose(nearest.as_deref(), known)
            }
            Self::UnknownWord { word, nearest, known, .. } => choose_word(word, nearest.as_deref(), known),
            Self::NoHeading { section } => Some(format!("write `[{section}.NAME]` above these lines")),
            Self::MissingType { known, .. } => Some(format!("possible types: {}", known.join(", "))),
            Self::NotOwned { body, point, owners } => Some(ownership_hint(body, point, owners)),
            Self::CoordinateCount { undetermined, degrees_of_freedom, chosen } => {
                Some(coordinate_hint(*degrees_of_freedom, *chosen, undetermined))
            }
            Self::Redundant { joints, suggestion, .. } => Some(match suggestion {
                Some(suggestion) => format!("the redundancy lies among {}; {suggestion}", joints.join(", ")),
                None => format!("the redundancy lies among {}", joints.join(", ")),
            }),
            Self::ImpactTips { .. } => Some(
                "its face is not pressed enough to bear its couple: with `type = \"block_slider\"` both ends of its block bear it"
                    .to_owned(),
            ),
            Self::FrictionInHinges { .. } => Some(
                "leave their friction out, with `mu = 0` or `friction_radius = 0` at each hinge"
                    .to_owned(),
            ),
            Self::StiffnessOfSome { .. } => Some("give `stiffness` for each of them, or for none".to_owned()),
            Self::RigidWithoutPlay { .. } => Some(
                "give their `stiffness`, in N/m: then the softer one yields, and play and misalignment count against it"
                    .to_owned(),
            ),
            Self::PressFitWithoutStiffness { .. } => Some(
                "give the `stiffness` of one face, in N/m: with the negative `play` it tells the force between both faces".to_owned(),
            ),
            Self::GuidedPressFit { .. } => Some(
                "make it a block slider, whose front and rear contacts are press fits of their own".to_owned(),
            ),
            Self::OneSidedInExcess { in_space: true, .. } => {
                Some("in `rests_on` write `corners = 3`, or leave out `one_sided`; or write the corners as `supports`, each with `normal = \"90 deg\"`, `stiffness`, `play` that nothing uses up, and minus half of that as `misalignment`".to_owned())
            }
            Self::OneSidedInExcess { in_space: false, .. } => Some(
                "leave out the joints that do not carry now, or cannot touch together with the others, such as the opposite corners of a peg in its play; `hold` has the ranges of what they carry at rest"
                    .to_owned(),
            ),
            Self::LiftsWithoutInertia { .. } => Some(
                "give mass to the bodies that nothing else holds".to_owned(),
            ),
            Self::OffFace { .. } => Some("draw it where it touches its face; what is apart is `closed = false`".to_owned()),
            Self::Penetration { .. } => Some(
                "change the coordinates until there is a gap; what touches is `closed = true`, and needs one coordinate less"
                    .to_owned(),
            ),
            Self::TouchesThoughApart { .. } => Some(
                "leave out `closed`: it touches; or, where nothing else could move then, give a coordinate a value at which it is a little open: `simulate` lets it land".to_owned(),
            ),
            Self::PreloadOfPressFit { .. } => Some("give one `preload` for both faces".to_owned()),
            Self::PlayChangesSign { .. } => Some(
                "ask for plays below zero and for others one by one: a press fit has two contacts, its faces, and another fit has one"
                    .to_owned(),
            ),
            Self::PlayBeyondBlock { .. } => Some("check the unit: a block tilts little within its play".to_owned()),
            Self::OutOfLine { .. } => Some(
                "give more play or less misalignment, or the `stiffness` of their faces, which yield then".to_owned(),
            ),
            Self::GuidesDoNotFit { .. } => Some(
                "draw the guides as they should be, parallel and in line, and give what they are off by as `misalignment` of their contacts"
                    .to_owned(),
            ),
            Self::SeveralOwners { point, owners } => {
                Some(format!("say which one: \"{}.{point}\"", owners.first().map_or("body", String::as_str)))
            }
            Self::NotAssembled { reached: Some(reached), .. } => {
                Some(format!("on the path from the drawing it can be assembled up to {reached}"))
            }
            Self::ContradictoryPhase { possible, .. } if !possible.is_empty() => {
                let modes: Vec<String> = possible.iter().map(|mode| format!("`{mode}`")).collect();
                Some(format!("possible at the start: {}", modes.join(", ")))
            }
            Self::ZeroSlidingVelocity { why, .. } => Some(why.hint(face)),
            Self::HingeDoesNotTurn { why, .. } => Some(why.hint_of_hinge(face)),
            Self::LoadUnused { load } => Some(format!(
                "with `{}` or `{}` the load {load} is considered at rest",
                face.option_with("against", "self-locking"),
                face.option_with("against", "hold")
            )),
            Self::LimitUnit { wanted, .. } if !wanted.is_empty() => Some(format!("give it in {wanted}, or a multiple of it")),
            Self::NoDrives { coordinate } => Some(drive_hint(coordinate.as_deref().unwrap_or("q"))),
            Self::NoPad { joint, .. } => Some(format!(
                "add the area in contact to the table [joints.{}]: `pad = {{ length = \"20 mm\", width = \"15 mm\" }}`",
                joint.as_deref().unwrap_or("NAME")
            )),
            _ => None,
        }
    }

    /// Hints that name options and questions.
    fn hint_of_face(&self, face: &dyn Face) -> Option<String> {
        Some(match self {
            Self::InSpace { .. } => format!(
                "ask `{}`, `limits`, `drive`, `size`, `sweep` or `map`: they take it in motion, at its position and speed",
                face.question("solve")
            ),
            Self::SharedLoad { .. } => format!(
                "give them `play` and `loose = true`, and no stiffness: then each face is a contact by itself; or ask `{}` at instants of the motion, `sweep` along it, or `hold` where it stops",
                face.question("solve")
            ),
            Self::PressFit { .. } => format!(
                "give a play of zero or more; press fits that slide under a given load are for `{}`, `limits`, `drive`, `size`, `sweep` and `map`, those at rest for `hold`",
                face.question("solve")
            ),
            Self::BesideStanding { .. } => format!(
                "their friction is a range: `{} {}` says from which factor of friction on there is no solution, and `{}` with {} for which values all solutions keep a greatest force; to leave that friction out write `mu = 0` there",
                face.question("limits"),
                face.option_with("vary", "friction"),
                face.question("size"),
                face.option("max-normal-force")
            ),
            Self::OneSided { .. } => format!(
                "`{}`, `hold`, `sweep`, `map`, `limits`, `size` and `drive` know them; where they are sure to stay closed, a `pin_in_slot` or a `block_slider` may stand for them",
                face.question("solve")
            ),
            Self::ContradictoryPhase { .. } => {
                format!("it cannot begin in any mode: `{}` says why", face.question("solve"))
            }
            Self::LimitUnit { .. } => {
                format!("some drives are forces, others torques: name one with {}", face.option("load"))
            }
            Self::Empty => {
                format!("start from a model of the gallery: `{}` lists it", face.question("models"))
            }
            Self::MissingKey { key, .. } if key == "bodies" || key == "joints" => {
                format!("start from a model of the gallery: `{}` lists it", face.question("models"))
            }
            Self::SingularPosition { .. } => format!(
                "draw it in a nearby position; from a drawing that is not singular, {} can lead past this one",
                face.option("at")
            ),
            Self::OverlapVanished { .. } => {
                format!("choose {} closer to the drawing", face.option("at"))
            }
            Self::MotionWithoutInertia { .. } => format!(
                "`{}` says whether it stays at rest, and with {} from which friction on; `{}` with {} finds dimensions that hold. For its motion, add a drive or give a mass to the bodies that move",
                face.question("hold"),
                face.option("vary"),
                face.question("size"),
                face.option_with("against", "hold")
            ),
            Self::NoDirectionAtRest => format!("omit {}", face.option("both-directions")),
            Self::NothingToSimulate { .. } => {
                format!("choose a greater {}, or an earlier {}", face.option("until"), face.option("time"))
            }
            Self::HeldLoadNeeded { .. } => {
                format!(
                    "name it with {}; the name of a drive stands for its effort. To vary something else, give it a range, \
                     NAME=FROM..TO",
                    face.option("load")
                )
            }
            _ => return None,
        })
    }

    /// Returns the message and, in parentheses, the hint of the command line.
    pub fn with_hint(&self) -> String {
        let hint = self.hint().map_or_else(String::new, |hint| format!(" ({hint})"));
        format!("{self}{hint}")
    }

    /// Hints about joints in space.
    fn hint_in_space(&self) -> Option<&'static str> {
        Some(match self {
            Self::NotCarried { motion, .. } if motion.starts_with("turning about the rod") => {
                "a rod alone does not: give the joint a key beside it, `supports = { key = { at = 0, aside = \"50 mm\", normal = \"90 deg\", mu = 0 } }`, give the body a second guide, or let the joint carry it without friction: `carries = [\"roll\"]`"
            }
            Self::NotCarried { .. } => {
                "give its sliding joint `supports` with `normal = \"90 deg\"`, at different places `at`, `aside` and `z`, or let a joint carry it without friction: `carries = [\"z\", \"roll\", \"pitch\"]`; of a flat drawing leave out every third coordinate"
            }
            Self::CarriedTwice { .. } => {
                "say which of them carry less: of hinges `carries = \"z\"` (a ball), `\"tilt\"` (a cylinder) or `\"nothing\"`, of sliding joints fewer of `[\"z\", \"roll\", \"pitch\"]`"
            }
            Self::UnknownTilt { .. } => {
                "give it `shape = { box = [width, height, depth] }` in place of `moment_of_inertia`"
            }
            Self::Corners { .. } => "for others write `supports` with `normal = \"90 deg\"`",
            Self::WrongLength { place, found: 2, .. } if place.ends_with(".shape.box") => {
                "in the plane write `rectangle`, which has two lengths; the third one of a box is along z"
            }
            Self::IdleCollar { .. } => {
                "write `carries = \"z\"`; of a pin with a hinge for each bearing the collar belongs to the one that carries along z"
            }
            Self::RoughAndTilted { .. } => {
                "give the distance of both bearings of its pin, `bearings`; or each a hinge of its own, at its height: `carries = \"nothing\"`, and for one of them `\"z\"`"
            }
            Self::JointInSpace { .. } => {
                "leave it out, or leave out what makes the model one in space: third coordinates and components, `box`, `normal`, `aside`, `rests_on`, `one_sided`, `carries`, `moments`, `products_of_inertia`"
            }
            _ => return None,
        })
    }

    /// Hints that do not depend on the values.
    fn fixed_hint(&self) -> Option<&'static str> {
        match self {
            Self::NotUtf8 { .. } => Some("save it as UTF-8"),
            Self::SharedContact { .. } => {
                Some("a block has `front` and `rear` by itself, and corners of `rests_on` have names, too")
            }
            Self::MissingKey { key, .. } if key == "mu" => {
                Some("write `mu = 0` for a contact without friction")
            }
            Self::MissingKey { key, table } if key == "between" && table.starts_with("joints") => {
                Some("name the two points that it joins, as in `between = [\"ground.A\", \"crank.A\"]`")
            }
            Self::WrongDimension { wanted, found }
                if found.times(Dimension::ACCELERATION) == Some(*wanted) =>
            {
                Some("`lb`, `oz` and `kg` are units of mass; those of force are `lbf`, `ozf`, `kgf` and `N`")
            }
            Self::WrongDimension { found, .. } if *found == Dimension::NONE => Some(
                "plain numbers are in SI units (m, kg, s, N, rad) on their own, and pure numbers in products",
            ),
            Self::DependsOnMotion { .. } => {
                Some("only loads and drives may depend on coordinates, rates and the time t")
            }
            Self::DependsOnSlidingSpeed { .. } => Some(
                "only `mu` of sliding joints may depend on it, not that of hinges; a force that grows with the velocity is a damper, or a load with `rate(q)`",
            ),
            Self::Without { second: "radius" | "mu", .. } => Some(
                "a pin needs its `mu` and its `radius`; in place of both, `friction_radius` gives the radius of its friction circle",
            ),
            Self::Without { second: "friction_radius", .. } => Some(
                "`friction_radius` is the radius of the friction circle while the hinge turns, zero without friction",
            ),
            Self::AtSlidingSpeed { .. } => Some(
                "a coefficient of friction must be finite and not negative at every speed that occurs, including zero",
            ),
            Self::NeedUnmet { .. } => Some(
                "change it, or another size; for a problem of another kind change the model that the template writes",
            ),
            Self::PartsApart { .. } => Some("change it, or another size, so that the parts reach each other"),
            Self::StaticBelowKinetic { .. } => Some("omit `mu_static` to make it equal to `mu`"),
            Self::StaticRadiusBelowKinetic { .. } => {
                Some("omit `static_friction_radius` to make it equal to `friction_radius`")
            }
            Self::SeveralImpacts { joints, .. } if joints.len() > 1 => {
                Some("friction decides which of them pushes; change where one of them hits a little")
            }
            Self::FloatingBodies { .. } => Some("add a joint, or remove what is not part of the mechanism"),
            Self::Syntax { message }
                if ["must be quoted", "number prefix"].iter().any(|one| message.contains(one)) =>
            {
                Some(
                    "a quantity with a unit stands in quotes, such as `\"0.5 m\"`; so do expressions and names",
                )
            }
            Self::Syntax { message } if message.contains("invalid key-value pair") => {
                Some("a model is TOML; a problem given by matrices, in JSON, is another kind of file")
            }
            Self::SameAxes { .. } => Some("choose another quantity for one of them"),
            Self::MalformedRange { text, .. } if text.contains(':') => {
                Some("no number of values is needed: write FROM..TO")
            }
            Self::MalformedRange { text, .. } if ends_of_range(text).is_err() => {
                Some("two dots stand between the ends of a range: FROM..TO")
            }
            Self::MalformedRange { .. } => {
                Some("write a range with two dots between its ends, such as `L=200mm..800mm`")
            }
            Self::MalformedSetting { .. } => Some("for instance `mu=0.2` or `\"alpha=80 deg\"`"),
            Self::TooFar { .. } => Some("draw the mechanism closer to this state"),
            Self::NotFollowed { .. } => Some(
                "this is a dead centre of the coordinates or a point where branches meet: draw the mechanism beyond it, or choose coordinates that continue there",
            ),
            Self::NoFreedom { may_open: true } => Some(CLOSED_ALONE),
            Self::NoFreedom { may_open: false } => Some(NO_MOTION),
            Self::DependentCoordinates { .. } => {
                Some("it may be at a dead centre of these coordinates: choose others, or another position")
            }
            Self::DriveBlocked { .. } => Some(MEETS_A_STOP),
            Self::DriveCannotMove { .. } => Some("change the line of action of the drive's force or torque"),
            Self::NotAssembled { .. } => Some("its joints do not close in the drawing: check the points"),
            Self::Overflow { .. } | Self::IllConditioned { .. } => {
                Some("check for lengths, masses, forces or coefficients of absurd magnitude")
            }
            Self::Both { .. } | Self::DoubledJoint { .. } => Some("remove one of them"),
            Self::SelfJoint { .. } => Some("a joint needs two different bodies, or a body and ground"),
            Self::MalformedMode { .. } => Some(
                "+ and - are the signs of normal forces, for hinges those of angular velocities; 0 is a preload gap, = is a contact whose joint sticks, or a hinge that sticks",
            ),
            Self::NoLoadAtRest { .. } => Some("give the load a magnitude in the model"),
            Self::NotOnlyFriction { .. } => Some(
                "write both ends with units, for instance `x=50mm..200mm`; only coefficients of friction need none",
            ),
            Self::RangeNeeded { .. } => {
                Some("write both ends with units, for instance `x=-10mm..10mm` or `phi=20deg..70deg`")
            }
            Self::TooManyContacts { .. } | Self::TooManyStates { .. } => {
                Some("a guided slider or a pin in a slot has one contact where a block slider has two")
            }
            _ => None,
        }
    }
}

/// A number of states, which may be beyond what is counted.
fn counted(states: u64) -> String {
    if states == u64::MAX { format!("more than {states}") } else { states.to_string() }
}

/// What to write in place of a word.
fn choose_word(word: &str, nearest: Option<&str>, known: &[String]) -> Option<String> {
    if word == "feet" {
        let supports = "`{ at, aside, normal = \"90 deg\", mu }`; what turns on feet is not known";
        return Some(format!("feet that slide along a guide are `supports` of its block: {supports}"));
    }
    choose(nearest, known)
}

fn choose(nearest: Option<&str>, known: &[String]) -> Option<String> {
    match (nearest, known) {
        (Some(nearest), _) => Some(format!("did you mean `{nearest}`?")),
        (None, []) => None,
        (None, known) => Some(format!("known here: {}", known.join(", "))),
    }
}

fn ownership_hint(body: &str, point: &str, owners: &[String]) -> String {
    match owners {
        [] => format!("add \"{point}\" to the points of {body}; so far it belongs to ground"),
        owners => {
            format!("add \"{point}\" to the points of {body}; so far it belongs to {}", owners.join(", "))
        }
    }
}

fn coordinate_hint(degrees: usize, chosen: usize, undetermined: &[String]) -> String {
    if chosen > degrees {
        return format!("remove {} from [coordinates]", chosen - degrees);
    }
    let motion = match undetermined {
        [] => String::new(),
        bodies => format!(" for the motion of {}", bodies.join(", ")),
    };
    format!(
        "add to [coordinates]{motion}, for instance [coordinates.q] with `slide = \"JOINT\"` or `rotation = \"BODY\"`"
    )
}

fn in_table(table: &str) -> String {
    if table.is_empty() { String::new() } else { format!(" in `{table}`") }
}

fn none_of(keys: &[&str]) -> String {
    match keys {
        [key] => format!("no `{key}`"),
        [first, second] => format!("neither `{first}` nor `{second}`"),
        keys => {
            let quoted: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
            format!("none of {}", quoted.join(", "))
        }
    }
}

/// "a, b and c"
fn listed(names: &[String]) -> String {
    match names {
        [names @ .., last] if !names.is_empty() => format!("{} and {last}", names.join(", ")),
        names => names.concat(),
    }
}

fn opening(joint: &str, loop_joints: &[String]) -> String {
    if loop_joints.is_empty() {
        return format!("{joint} stays open");
    }
    format!("the loop of {} does not close, {joint} stays open", listed(loop_joints))
}

fn drive_hint(coordinate: &str) -> String {
    format!(
        "prescribe the motion of a coordinate, for instance [drives.push] with `coordinate = \"{coordinate}\"` and `force = {{ at = \"BODY.POINT\", direction = \"0 deg\" }}` or `torque = {{ body = \"BODY\" }}`"
    )
}

fn expression_hint(kind: &ExpressionFaultKind) -> Option<String> {
    matches!(kind, ExpressionFaultKind::UnknownName { .. }).then(|| {
        "expressions may use the names in [parameters] and, in loads and drives, [coordinates]".to_owned()
    })
}

fn are(bodies: &[String]) -> String {
    match bodies {
        [body] => format!("the body {body} is"),
        bodies => format!("the bodies {} are", bodies.join(", ")),
    }
}

fn constraints(count: usize) -> String {
    if count == 1 { "1 constraint is".into() } else { format!("{count} constraints are") }
}

/// The hint where a closed contact is all that keeps a mechanism from moving.
const CLOSED_ALONE: &str = "a closed contact is all that stops it: write `closed = false` there, draw it a little open or give the coordinate such a value, and ask `simulate`: it lets the contact land, and says whether it stays at rest";
/// The hint where the joints leave no motion.
const NO_MOTION: &str = "a mechanism needs at least one motion; remove a joint or constraint, or draw guides parallel that are meant to be: how far they are off is their `misalignment`";
/// The hint where a drive meets what stops it.
const MEETS_A_STOP: &str = "a drive prescribes its motion whatever it meets: what may come to rest on a stop is pushed by a force in `loads`";

fn modes_in_words(count: usize) -> String {
    if count == 1 { "1 contact mode".into() } else { format!("{count} contact modes") }
}

fn degrees(count: usize) -> String {
    if count == 1 { "1 degree".into() } else { format!("{count} degrees") }
}

fn coordinates(count: usize) -> String {
    match count {
        0 => "no coordinate is chosen".into(),
        1 => "1 coordinate is chosen".into(),
        count => format!("{count} coordinates are chosen"),
    }
}
