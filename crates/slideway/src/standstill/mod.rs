//! Standstill: whether a mechanism stays at rest under its loads, and how it begins to move.
//!
//! At zero sliding velocity friction is not a number but takes what is needed within its limit. Each sliding
//! joint, the two ends of a block together, sticks or begins to slip one way or the other:
//!
//! ```text
//! sticks   |F_k| <= mu_static_k |N_k| + F_k0        sliding acceleration = 0
//! slips    F_k = (mu_k |N_k| + F_k0) s_k            s_k = sign of the sliding acceleration
//! ```
//!
//! Together with the side of every contact, and `|C| <= |N| L/2` for guided sliders, each state is a system
//! of linear equations and inequalities; all states are tried (theory, section 8). Friction at rest is
//! statically indeterminate, so that "holds" means that some admissible state exists, and reactions are
//! ranges. Each end of a range is the optimum of a linear program. Programs are solved with an accuracy of
//! about 1e-12 of the greatest force; a state that misses its inequalities by less than 1e-9 of it counts as
//! possible.
//!
//! A hinge with friction sticks while `|M| <= r_static |R|`, a set that is not convex (theory of friction in hinges,
//! section 7): a union of linear programs over directions of the reaction, so that what is held may be disconnected. Where
//! it begins to turn, `|M| = r |R|`.
//!
//! Of redundant guides a contact may also be open, and the deflections of all contacts must fit together
//! (theory, section 10). Where the guides came to rest within their play is not known: that, too, is a range. Of rigid guides
//! only the places of the faces have to fit together, which bounds what presses them against each other.
//!
//! ```
//! use slideway::model::{Model, Settings};
//! use slideway::standstill::{HoldOptions, hold};
//!
//! let bracket = Model::parse(slideway::gallery::find("bracket-on-pole").expect("in the gallery").text)?;
//! let options = HoldOptions::default().load("W");
//! let load = |settings: Settings| -> Result<_, slideway::fault::Faults> {
//!     Ok(hold(&bracket.with(&settings)?, &options)?.load.expect("it is varied"))
//! };
//! // Self-locking from the distance B / (2 mu_static) = 304.8 mm on.
//! assert!(load(Settings::default().parameter("x", "305 mm"))?.self_locking);
//! assert!(!load(Settings::default().parameter("x", "304 mm"))?.self_locking);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```
//!
//! # Files
//! `standstill` stands beside `solve` and takes `kinetics::Assembled`, the equations without factorization:
//! at rest they need no inertia. `setup.rs` is the mechanism at rest with its varied load, `state/` the equations
//! of one state of joints and contacts, and its inequalities, `directions.rs` which way joints may move together; `rest.rs`,
//! `threshold.rs` and `release.rs` are the questions, and `turning.rs` finds the states in which hinges with friction turn.

mod answer;
mod directions;
mod ranges;
mod reactions;
mod release;
mod report;
mod rest;
mod setup;
mod state;
mod text;
mod threshold;
mod turning;
mod words;

pub use report::{
    AtRest, BeyondHeld, Coefficients, ContactRange, CoordinateRange, CoordinateValue, DriveRange,
    FrictionNeeded, GapRange, HingeRange, HoldReport, HoldVerdict, JointRelease, LoadReport, Range,
    Reactions, Release, SCHEMA, Threshold, Wedging,
};

use crate::configuration::{motions_without_inertia, unit};
use crate::fault::{Fault, FaultKind, Faults};
use crate::mechanism::{Contact, FrictionCircle, Mechanism};
use crate::model::Model;
use crate::one_face::{Pressed, one_face_hints};
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::finite;
use crate::sharing::load_sharing;
use directions::{Direction, directions, most_directions};
use nalgebra::DMatrix;
use rest::Over;
use setup::Setup;
use state::side_options;

/// So far beyond an end of what is held, as a part of it, is looked at what begins there: well above rounding.
const BEYOND: f64 = 1e-4;
/// Inequalities that are missed by this multiple of the greatest force count as satisfied, and accelerations
/// below this as none.
const TOLERANCE: f64 = 1e-9;
/// More states of joints and contacts are refused.
const MOST_STATES: u64 = 100_000;

/// What is asked of a mechanism at rest.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct HoldOptions {
    /// The load that is multiplied by a factor; a drive's name means its effort as a load of 1 N or 1 N m,
    /// "gravity" all weights together.
    pub load: Option<String>,
    /// The parameter of static friction that is varied for the threshold of self-locking; without it, and with
    /// [`FRICTION`](crate::model::FRICTION), all static coefficients are multiplied by a factor. Without a load it is that
    /// for the only one, weights together being one.
    pub vary: Option<String>,
    /// Whether drives hold their coordinates; else they are taken as absent.
    pub hold_drives: bool,
}

impl HoldOptions {
    /// Multiplies a load, the effort of a drive, or all weights ("gravity") by a factor.
    #[must_use]
    pub fn load(mut self, name: &str) -> Self {
        self.load = Some(name.to_owned());
        self
    }

    /// Varies a parameter of static friction for the threshold of self-locking.
    #[must_use]
    pub fn vary(mut self, parameter: &str) -> Self {
        self.vary = Some(parameter.to_owned());
        self
    }

    /// Whether drives hold their coordinates.
    #[must_use]
    pub fn hold_drives(mut self, hold: bool) -> Self {
        self.hold_drives = hold;
        self
    }
}

/// Whether a mechanism stays at rest in its position; the rates of the model are set to zero.
///
/// # Errors
/// Whatever makes no sense in the model or its position; a load or parameter that is unknown, a load that is
/// zero, a parameter on which more than friction depends, and more states than are tried.
pub fn hold(model: &Model, options: &HoldOptions) -> Result<HoldReport, Faults> {
    undisturbed(|work| hold_within(model, options, work))
}

/// [`hold`] with a callback that is called now and then; nothing if it breaks.
///
/// # Errors
/// As [`hold`].
pub fn hold_with(
    model: &Model,
    options: &HoldOptions,
    callback: &mut Callback<'_>,
) -> Result<Option<HoldReport>, Faults> {
    watched(callback, |work| hold_within(model, options, work))
}

/// Whether [`hold`] has an answer, without seeking it.
///
/// # Errors
/// As [`hold`] without a load.
pub(crate) fn can_hold(model: &Model, work: Work<'_>) -> Result<(), Faults> {
    let setup = Setup::new(model, &HoldOptions::default(), work)?;
    check_states(&setup, MOST_STATES).map(|_| ())
}

/// [`hold`] in work that may end.
///
/// # Errors
/// As [`hold`].
pub(crate) fn hold_within(
    model: &Model,
    options: &HoldOptions,
    work: Work<'_>,
) -> Result<HoldReport, Faults> {
    let options = &with_load(model, options)?;
    let setup = Setup::new(model, options, work)?;
    let rest_patterns = check_states(&setup, MOST_STATES)?;
    let nominal = setup.load.as_ref().map_or(1.0, |load| load.nominal);
    let sharings = usize::from(setup.shared.is_some());
    let part = |index| work.part(index, 3 + sharings);
    let (rest, is_held) = rest::at_rest(&setup, nominal, part(0));
    let load = load_report(model, options, &setup, part(1))?;
    let friction =
        if setup.load.is_none() { friction_needed(model, options, &setup, part(1))? } else { None };
    let wedging = threshold::wedging(model, options, &setup, part(2))?;
    let beginning = Beginning::new(&setup, is_held, part(2 + sharings));
    let original = Mechanism::new(model)?;
    let of_load = load.as_ref().map_or(0, |load| load.undecided + load.threshold.undecided);
    let of_wedging = wedging.as_ref().map_or(0, |threshold| threshold.undecided);
    let of_friction = friction.as_ref().map_or(0, |friction| friction.threshold.undecided);
    let mut report = HoldReport {
        schema: SCHEMA,
        title: setup.mechanism.title.clone(),
        units: model.units.clone(),
        verdict: beginning.verdict,
        holds: beginning.verdict.holds(),
        state: state(&setup),
        steps_from_drawing: setup.configuration.steps_from_drawing(),
        rates_ignored: original.coordinates.iter().any(|coordinate| coordinate.rate != 0.0),
        released_drives: drives(&original, options, false),
        holding_drives: drives(&original, options, true),
        undecided: rest.undecided + beginning.releases.undecided + of_load + of_wedging + of_friction,
        sharing: match &setup.shared {
            Some(shared) => load_sharing(&setup.mechanism, &shared.self_stress)?,
            None => None,
        },
        wedging: wedging.map(told_wedging),
        load,
        friction,
        at_rest: rest.found,
        releases: beginning.releases.found,
        one_face_hints: Vec::new(),
        release_patterns: beginning.directions * rest_patterns,
        motions_without_inertia: beginning.motions_without_inertia,
        force: setup.units.force,
        rest_patterns,
    };
    let states = report.normal_forces();
    let jams = report.verdict == HoldVerdict::Neither;
    let state = (&setup.mechanism, &setup.configuration);
    report.one_face_hints = one_face_hints(model, state, &Pressed { states: &states, jams });
    report.suit_units();
    finite(report)
}

/// What a mechanism does from rest.
pub(crate) struct Beginning {
    /// Whether it holds or moves.
    pub(crate) verdict: HoldVerdict,
    /// In which states it begins to move, and how many patterns were not decided.
    releases: Over<Vec<Release>>,
    /// In how many directions joints may begin to move.
    directions: usize,
    motions_without_inertia: Vec<String>,
}

impl Beginning {
    fn new(setup: &Setup, is_held: bool, work: Work<'_>) -> Self {
        let motions_without_inertia = undriven_without_inertia(setup);
        let has_inertia = motions_without_inertia.is_empty();
        let directions = if has_inertia { directions(setup) } else { Vec::new() };
        let releases = release::releases(setup, &directions, is_held, work.part(0, 2));
        let verdict = if has_inertia {
            let moves = !releases.found.is_empty();
            verdict(is_held, moves, || slips_against_static_friction(setup, &directions, work.part(1, 2)))
        } else if is_held && slides_with_inertia(setup, work.part(1, 2)) {
            HoldVerdict::HoldsOrSlips
        } else if is_held {
            HoldVerdict::MayHold
        } else {
            HoldVerdict::DoesNotHold
        };
        Self { verdict, releases, directions: directions.len(), motions_without_inertia }
    }

    /// For each state in which it begins to move, the accelerations of the coordinates.
    pub(crate) fn accelerations(&self) -> impl Iterator<Item = &[CoordinateRange]> {
        self.releases.found.iter().map(|release| release.coordinates.as_slice())
    }
}

/// What a mechanism does from rest under its loads, refused if there are more states of joints and contacts than these;
/// none where that is not decided. The ranges of reactions at rest, which take most of the time, are not asked for.
///
/// # Errors
/// As [`hold`].
pub(crate) fn beginning_within(
    model: &Model,
    most_states: u64,
    work: Work<'_>,
) -> Result<Option<Beginning>, Faults> {
    let setup = Setup::new(model, &HoldOptions::default(), work)?;
    check_states(&setup, most_states)?;
    let Some(is_held) = rest::is_possible(&setup, 1.0, work.part(0, 2)) else { return Ok(None) };
    let beginning = Beginning::new(&setup, is_held, work.part(1, 2));
    Ok((beginning.releases.undecided == 0).then_some(beginning))
}

/// Whether a mechanism rests in its position, if that is all that is asked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Rests {
    /// Whether it can stay at rest; none where that could not be decided.
    pub(crate) holds: Option<bool>,
    /// Whether it can also begin to slide under the same loads: it rests only where something wedged it before.
    pub(crate) may_slip: bool,
}

/// Whether a mechanism rests in its position.
///
/// # Errors
/// As [`hold`].
pub(crate) fn rests(model: &Model, options: &HoldOptions, work: Work<'_>) -> Result<Rests, Faults> {
    let setup = Setup::new(model, options, work)?;
    check_states(&setup, MOST_STATES)?;
    let nominal = setup.load.as_ref().map_or(1.0, |load| load.nominal);
    let holds = rest::is_possible(&setup, nominal, work.part(0, 2));
    let may_slip = holds == Some(true) && slides_with_inertia(&setup, work.part(1, 2));
    Ok(Rests { holds, may_slip })
}

/// The factor of all static coefficients from which on a load alone, however great, is held, or without a load all loads as
/// they are; nothing if no factor suffices. With `certain` it is that from which on nothing can slide, otherwise wedged guides count, too.
/// Beside it the number of patterns that could not be decided.
///
/// # Errors
/// As [`hold`].
pub(crate) fn self_locking_factor(
    model: &Model,
    (load, certain): (Option<&str>, bool),
    work: Work<'_>,
) -> Result<(Option<f64>, usize), Faults> {
    let options = HoldOptions { load: load.map(str::to_owned), ..HoldOptions::default() };
    let setup = Setup::new(model, &options, work)?;
    check_states(&setup, MOST_STATES)?;
    let (threshold, by_itself) = threshold::threshold(model, &options, &setup, work)?;
    Ok((if certain { by_itself } else { threshold.value }, threshold.undecided))
}

/// The same question; a parameter that is varied without a load is varied for the only load.
///
/// # Errors
/// Several loads, or none, of which one would have to be named.
fn with_load(model: &Model, options: &HoldOptions) -> Result<HoldOptions, Faults> {
    let Some(varied) = options.vary.as_deref().filter(|_| options.load.is_none()) else {
        return Ok(options.clone());
    };
    threshold::check_varied(model, varied)?;
    Ok(options.clone().load(&only_load(model)?))
}

/// The name of the only load of a model, weights together being one.
///
/// # Errors
/// Several loads, or none, of which one would have to be named; values that the model must not have.
pub fn only_load(model: &Model) -> Result<String, Faults> {
    let mechanism = Mechanism::new(model)?;
    let weights = (mechanism.free_fall() > 0.0).then(|| setup::GRAVITY.to_owned());
    let loads = mechanism.loads.iter().map(|load| load.name.to_string());
    let known: Vec<String> = loads.chain(weights).collect();
    match known.as_slice() {
        [only] => Ok(only.clone()),
        _ => Err(Fault::general(FaultKind::HeldLoadNeeded { known }).into()),
    }
}

/// The number of patterns of sides, if no more states of joints and sides than these have to be tried.
fn check_states(setup: &Setup, most: u64) -> Result<usize, Faults> {
    let options = side_options(setup);
    let sides = options.iter().fold(1_u64, |sides, options| sides.saturating_mul(options.len() as u64));
    let joints = setup.sliders.len() + setup.mechanism.friction_circles.len();
    let of_motions = |motions: usize| most_directions(motions, joints).saturating_mul(sides);
    // More motions than joints make no more states, which spares most mechanisms the search for their
    // motions.
    let at_most = of_motions(joints);
    let one_sided = setup.one_sided();
    let openings = u32::try_from(one_sided.len()).ok().and_then(|count| 2_u64.checked_pow(count));
    let with_openings = |states: u64| states.saturating_mul(openings.unwrap_or(u64::MAX));
    let states = match with_openings(at_most) {
        states if states <= most => states,
        _ => with_openings(of_motions(held_motions(setup, &one_sided).ncols())),
    };
    match usize::try_from(sides) {
        Ok(sides) if states <= most => Ok(sides),
        _ => Err(Fault::general(FaultKind::TooManyStates { states, limit: most }).into()),
    }
}

fn load_report(
    model: &Model,
    options: &HoldOptions,
    setup: &Setup,
    work: Work<'_>,
) -> Result<Option<LoadReport>, Faults> {
    let Some(load) = &setup.load else { return Ok(None) };
    let (threshold, certain_from) = threshold::threshold(model, options, setup, work.part(0, 2))?;
    let held = rest::held_factors(setup, work.part(1, 2));
    Ok(Some(LoadReport {
        name: load.name.clone(),
        unit: load.unit,
        factor: load.nominal,
        force: load.resultant(setup.mechanism.bodies.len()),
        self_locking: held.found.last().is_some_and(|last| last.greatest.is_none()),
        beyond: beyond_held(setup, &held.found, work.part(1, 2)),
        held: held.found,
        undecided: held.undecided,
        threshold,
        certain_from,
    }))
}

/// What begins just beyond each end of what is held, where contacts may lift off and it is one thing.
fn beyond_held(setup: &Setup, held: &[Range], work: Work<'_>) -> Vec<BeyondHeld> {
    if !setup.mechanism.has_one_sided() {
        return Vec::new();
    }
    let ends = held.iter().flat_map(|range| [(range.least, false), (range.greatest, true)]);
    let beyond = |(at, above): (Option<f64>, bool)| {
        let (at, mut there) = (at?, setup.clone());
        if let Some(load) = &mut there.load {
            let way = if above { BEYOND } else { -BEYOND };
            load.nominal = at + way * at.abs();
        }
        let words = match &*Beginning::new(&there, false, work).releases.found {
            [only] => answer::begins(only),
            _ => return None,
        };
        Some(BeyondHeld { at, above, words })
    };
    ends.filter_map(beyond).collect()
}

/// The static friction that the loads need as they are; none if there is no static friction that could hold anything.
///
/// # Errors
/// As [`hold`].
fn friction_needed(
    model: &Model,
    options: &HoldOptions,
    setup: &Setup,
    work: Work<'_>,
) -> Result<Option<FrictionNeeded>, Faults> {
    let rubs = |contact: &Contact| contact.mu_static.iter().any(|mu| *mu > 0.0);
    let turns_hard = |circle: &FrictionCircle| circle.static_radius > 0.0;
    let Mechanism { contacts, friction_circles, .. } = &setup.mechanism;
    if !contacts.iter().any(rubs) && !friction_circles.iter().any(turns_hard) {
        return Ok(None);
    }
    let (threshold, certain_from) = threshold::threshold(model, options, setup, work)?;
    let safety_factor = certain_from.filter(|from| *from > 0.0).map(f64::recip);
    Ok(Some(FrictionNeeded { threshold, certain_from, safety_factor }))
}

/// Whether the threshold is reached.
fn told_wedging(threshold: Threshold) -> Wedging {
    let reached = |value: f64| value <= threshold.present * (1.0 + TOLERANCE);
    Wedging { possible: threshold.value.is_some_and(reached), threshold }
}

fn verdict(holds: bool, moves: bool, slips_against_static_friction: impl FnOnce() -> bool) -> HoldVerdict {
    match (holds, moves) {
        (true, false) => HoldVerdict::Holds,
        (true, true) if slips_against_static_friction() => HoldVerdict::HoldsOrSlips,
        (true, true) => HoldVerdict::HoldsUntilPushed,
        (false, true) => HoldVerdict::Moves,
        (false, false) => HoldVerdict::Neither,
    }
}

/// [`slips_against_static_friction`] in any direction, with an inertia for whatever has none.
fn slides_with_inertia(setup: &Setup, work: Work<'_>) -> bool {
    let slides = |setup: &Setup| slips_against_static_friction(setup, &directions(setup), work);
    with_inertia(setup).is_ok_and(|setup| slides(&setup))
}

/// A setup whose motions all have inertia.
///
/// # Errors
/// As [`Setup::new`].
fn with_inertia(setup: &Setup) -> Result<Setup, Faults> {
    let has_inertia = undriven_without_inertia(setup).is_empty();
    if has_inertia { Ok(setup.clone()) } else { setup.with_inertia() }
}

/// Whether it begins to slide even where kinetic friction is as great as static friction.
fn slips_against_static_friction(setup: &Setup, directions: &[Direction], work: Work<'_>) -> bool {
    let mut rough = setup.clone();
    for contact in &mut rough.mechanism.contacts {
        contact.mu = contact.mu_static;
    }
    for circle in &mut rough.mechanism.friction_circles {
        circle.radius = circle.static_radius;
    }
    release::is_released(&rough, directions, work)
}

fn state(setup: &Setup) -> Vec<CoordinateValue> {
    let values = setup.mechanism.coordinates.iter().zip(&setup.configuration.coordinates);
    let one = |(coordinate, value): (&crate::mechanism::Coordinate, &f64)| CoordinateValue {
        name: coordinate.name.to_string(),
        unit: unit(&coordinate.kind),
        value: *value,
    };
    values.map(one).collect()
}

/// The drives that hold, or those that are taken as absent; not the one whose effort is the load.
fn drives(mechanism: &Mechanism, options: &HoldOptions, holding: bool) -> Vec<String> {
    let is_load = |name: &str| {
        options.load.as_deref() == Some(name) && mechanism.loads.iter().all(|load| &*load.name != name)
    };
    let names = mechanism.drives.iter().map(|drive| drive.name.to_string());
    names.filter(|name| holding == options.hold_drives && !is_load(name)).collect()
}

/// Motions that the joints leave once all lifts off that may, and that have no kinetic energy, unless drives hold them.
fn undriven_without_inertia(setup: &Setup) -> Vec<String> {
    let motions = held_motions(setup, &setup.one_sided());
    // In the plane: where bodies may leave it, rest is not asked for.
    let in_plane = 3 * setup.mechanism.bodies.len();
    let (motions, loads) =
        (motions.rows(0, in_plane).into_owned(), setup.loads().rows(0, in_plane).into_owned());
    motions_without_inertia(&setup.mechanism, &setup.configuration, &motions, &loads)
}

/// The motions that joints and drives leave, one in each column, with these contacts open.
fn held_motions(setup: &Setup, open: &[usize]) -> DMatrix<f64> {
    let motions = setup.free_motions(open);
    let drives = setup.mechanism.drives.len();
    if drives == 0 || motions.is_empty() {
        return motions;
    }
    let rows = setup.equations_of_motion();
    let first = setup.assembled.layout.len() - drives;
    let prescribed = setup.assembled.matrix.view((first, 0), (drives, rows)) * &motions;
    let left = crate::configuration::null_space(&prescribed);
    motions * left
}
