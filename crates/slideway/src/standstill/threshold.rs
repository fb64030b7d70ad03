//! From which static friction on a load alone, however great, is held, or all loads as they are, or guides that share a load
//! wedge.
//!
//! The load can grow without bound where the cone of recession of the states of rest reaches in its
//! direction:
//!
//! ```text
//! -G^T lambda - B u - sum_k W_k F_k = load     |F_k| <= mu_static_k |N_k|     |C_j| <= |N_j| L_j / 2
//! ```
//!
//! without weights, other loads and preloads, which are negligible beside a load that is great enough. More
//! static friction only widens this cone, so that there is one threshold, found by bisection of the linear
//! programs' feasibility and polished by a secant: self-locking from there on, free below. The accuracy is
//! about 1e-12. Where a block wedges in its guide the reactions grow without bound as the inverse of the
//! distance from the threshold: there it is 1e-11, and 1e-9 beside hinges with friction.
//!
//! Redundant guides *wedge* where the cone without any load holds normal forces that do not vanish: friction then
//! keeps them pressed against each other, however hard. Play and misalignment are negligible beside the deflections of
//! such forces, so that they move no threshold; rigid guides keep theirs.

use super::directions::directions;
use super::release::is_released;
use super::report::{Coefficients, Threshold};
use super::rest::{Over, resting, static_friction, until_over};
use super::setup::Setup;
use super::state::{Pattern, State, StateQuestion, StaticFriction, sides};
use super::{HoldOptions, with_inertia};
use crate::fault::{Fault, FaultKind, Faults, nearest};
use crate::ids::FormulaId;
use crate::mechanism::{FrictionCircle, Mechanism};
use crate::model::{FRICTION, Model};
use crate::pattern::Unsolved;
use crate::progress::{Progress, Work};

/// Feasible within rounding, as a part of the greatest term: what the programs leave over at the exact
/// threshold.
const ROUNDING: f64 = 1e-13;
/// The bisection ends at this relative width, ...
const WIDTH: f64 = 1e-14;
/// ... and at this one where friction circles would decide the sign of what is missed nearer to the root,
/// with ever more sectors. Roots of secants are no farther from the bracket.
const NEAR: f64 = 1e-9;
/// Distances from the bracket, relative to it, of the points of a secant below it, and of one above it.
const BELOW: [f64; 2] = [1e-6, 1e-8];
const ABOVE: [f64; 2] = [1e-4, 1e-6];
/// Greater values of what is varied are not tried.
const GREATEST: f64 = 1e6;
/// A coefficient beyond this (a friction angle of 89.4 deg) is that of no surfaces: what needs more does not hold by itself.
const GREATEST_COEFFICIENT: f64 = 100.0;

/// Static friction as a function `constant + slope p` of what is varied.
struct Law {
    varied: String,
    present: f64,
    /// Of a factor: the only parameter to which all of this friction is proportional, with its value, if there is one.
    parameter: Option<(String, f64)>,
    /// The coefficients of each contact and side.
    lines: Vec<[[f64; 2]; 2]>,
    /// The coefficient of each pin, or the radius of a friction circle that is given.
    hinges: Vec<[f64; 2]>,
}

impl Law {
    fn coefficients(&self, value: f64) -> Vec<[f64; 2]> {
        self.lines.iter().map(|sides| sides.map(|line| on(line, value))).collect()
    }

    /// The same, of both contacts of a round end that of the end.
    fn with_ends(&self, mechanism: &Mechanism, value: f64) -> Vec<[f64; 2]> {
        let mut coefficients = self.coefficients(value);
        for (circle, line) in mechanism.friction_circles.iter().zip(&self.hinges) {
            for contact in circle.end.into_iter().flatten() {
                coefficients[contact.index()] = [on(*line, value); 2];
            }
        }
        coefficients
    }

    /// The greatest coefficient of a contact.
    fn greatest(&self, mechanism: &Mechanism, value: f64) -> f64 {
        self.with_ends(mechanism, value).into_iter().flatten().fold(0.0, f64::max)
    }

    fn friction(&self, setup: &Setup, value: f64) -> StaticFriction {
        let circles = setup.mechanism.friction_circles.iter().zip(&self.hinges);
        StaticFriction {
            mu: self.coefficients(value),
            radii: circles.map(|(circle, line)| circle.static_radius_with(on(*line, value))).collect(),
        }
    }
}

/// Friction on a line; it is never negative.
fn on([constant, slope]: [f64; 2], value: f64) -> f64 {
    (constant + slope * value).max(0.0)
}

/// The threshold for the varied load of a setup alone, or, if none is varied, for all loads and preloads as they are, and from
/// which value on that holds by itself.
///
/// # Errors
/// A parameter that is unknown, or on which other things than friction coefficients depend.
pub(super) fn threshold(
    model: &Model,
    options: &HoldOptions,
    setup: &Setup,
    work: Work<'_>,
) -> Result<(Threshold, Option<f64>), Faults> {
    let law = law(model, options, setup)?;
    let loaded = setup.load.as_ref().map_or_else(|| setup.clone(), |load| setup.alone(load.forces.clone()));
    let least = least_value(&loaded, &law, StateQuestion::rest(Some(0.0)), work.part(0, 2));
    let certain = match least.found {
        Some(from) => certain_from(&loaded, &law, from, work.part(1, 2))?,
        None => None,
    };
    Ok((told(setup, &law, &least), certain))
}

/// The threshold from which on guides that share a load wedge; nothing if there are none.
///
/// # Errors
/// As [`threshold`].
pub(super) fn wedging(
    model: &Model,
    options: &HoldOptions,
    setup: &Setup,
    work: Work<'_>,
) -> Result<Option<Threshold>, Faults> {
    if setup.shared.is_none() {
        return Ok(None);
    }
    let law = law(model, options, setup)?;
    let unloaded = setup.alone(setup.given.map(|_| 0.0));
    let wedged = StateQuestion { wedged: true, ..StateQuestion::rest(Some(0.0)) };
    let least = least_value(&unloaded, &law, wedged, work);
    Ok(Some(told(setup, &law, &least)))
}

/// Returns whether a name stands for a factor on all friction, not for a parameter.
fn is_factor(model: &Model, name: &str) -> bool {
    name == FRICTION && model.parameters.iter().all(|one| &*one.name != name)
}

/// That what is varied without a range is friction, whatever the load.
///
/// # Errors
/// A name that is unknown, or on which other things than friction depend.
pub(super) fn check_varied(model: &Model, name: &str) -> Result<(), Faults> {
    if is_factor(model, name) { Ok(()) } else { friction_parameter(model, name).map(|_| ()) }
}

/// How static friction depends on what is varied.
fn law(model: &Model, options: &HoldOptions, setup: &Setup) -> Result<Law, Faults> {
    match options.vary.as_deref().filter(|name| !is_factor(model, name)) {
        None => Ok(Law {
            varied: "static friction".to_owned(),
            present: 1.0,
            parameter: only_parameter(model, setup),
            lines: static_friction(setup).mu.iter().map(|mu| mu.map(|mu| [0.0, mu])).collect(),
            hinges: {
                let circles = setup.mechanism.friction_circles.iter();
                circles.map(|circle| [0.0, circle.static_friction()]).collect()
            },
        }),
        Some(name) => parameter_law(model, setup, name),
    }
}

fn told(setup: &Setup, law: &Law, &Over { found: value, undecided }: &Over<Option<f64>>) -> Threshold {
    let Mechanism { contacts, friction_circles, .. } = &setup.mechanism;
    let coefficients = value.map_or_else(Vec::new, |value| law.with_ends(&setup.mechanism, value));
    let named = contacts.iter().zip(coefficients).map(|(contact, mu_static)| {
        // A contact that may lift off has one face.
        (contact, if contact.opens { [mu_static[0]; 2] } else { mu_static })
    });
    let is_hinge = |circle: &FrictionCircle| circle.end.is_none() && circle.is_rough();
    Threshold {
        varied: law.varied.clone(),
        present: law.present,
        parameter: law.parameter.clone(),
        value,
        undecided,
        coefficients: named
            .map(|(contact, mu_static)| Coefficients { contact: contact.name.to_string(), mu_static })
            .collect(),
        friction_in_hinges: friction_circles.iter().any(is_hinge),
    }
}

/// The least value, from `from` on, at which the loads cannot make it slide: there it holds by itself. With kinetic friction as
/// great as the static one, it slides in some state below. Nothing if that is so at every value tried, up to
/// [`GREATEST_COEFFICIENT`].
///
/// # Errors
/// As [`Setup::new`].
fn certain_from(alone: &Setup, law: &Law, from: f64, work: Work<'_>) -> Result<Option<f64>, Faults> {
    let directions = directions(alone);
    let mut rough = with_inertia(alone)?;
    let mut slides = |value: f64| {
        let StaticFriction { mu, radii } = law.friction(alone, value);
        for (contact, mu) in rough.mechanism.contacts.iter_mut().zip(mu) {
            (contact.mu, contact.mu_static) = (mu, mu);
        }
        for (circle, radius) in rough.mechanism.friction_circles.iter_mut().zip(radii) {
            (circle.radius, circle.static_radius) = (radius, radius);
        }
        is_released(&rough, &directions, work)
    };
    let (mut below, mut above) = (from, (from * (1.0 + NEAR)).max(f64::MIN_POSITIVE));
    while slides(above) {
        (below, above) = (above, 2.0 * above);
        if above > GREATEST || law.greatest(&alone.mechanism, above) > GREATEST_COEFFICIENT || work.is_over()
        {
            return Ok(None);
        }
    }
    if below == from {
        return Ok(Some(from));
    }
    while above - below > NEAR * above && !work.is_over() {
        let middle = f64::midpoint(below, above);
        if slides(middle) { below = middle } else { above = middle }
    }
    Ok(Some(above))
}

/// The least value for which some pattern answers the question.
///
/// Patterns that never do are tried with ever more friction, which a linear program may not be solved for. They are
/// tried again up to what the others need.
fn least_value(alone: &Setup, law: &Law, question: StateQuestion, work: Work<'_>) -> Over<Option<f64>> {
    let mut found: Option<f64> = None;
    let mut undecided = 0;
    let mut again = Vec::new();
    for (sides, piece) in until_over(sides(alone, &[]), work.part(0, 2)) {
        let pattern = resting(alone, sides);
        match least_in(alone, &pattern, law, (question, found), piece) {
            Ok(least) => found = least.or(found),
            Err(Unsolved) => again.push(pattern),
        }
    }
    for (pattern, piece) in until_over(again, work.part(1, 2)) {
        match least_in(alone, &pattern, law, (question, found), piece) {
            Ok(least) => found = least.or(found),
            Err(Unsolved) => undecided += 1,
        }
    }
    Over { found, undecided }
}

/// The least value for which a pattern answers the question, if it is less than the one already found.
fn least_in(
    alone: &Setup,
    pattern: &Pattern,
    law: &Law,
    (question, found): (StateQuestion, Option<f64>),
    work: Work<'_>,
) -> Result<Option<f64>, Unsolved> {
    let Some(state) = State::new(alone, pattern, question) else { return Ok(None) };
    let missed = |value, enough: f64| {
        let region = state.region(&law.friction(alone, value)).watched(work);
        let (slack, point) = region.highest_from(-enough)?;
        let greatest_term = region.greatest_term(&point);
        Ok(Missed { part: -slack / greatest_term, greatest_term })
    };
    let width = if law.hinges.is_empty() { WIDTH } else { NEAR };
    least_of((found.unwrap_or(GREATEST), width), missed, work)
}

/// By how much the load is not held.
#[derive(Clone, Copy)]
struct Missed {
    /// The greatest slack that is missed, as a part of the greatest term: positive where the load is not
    /// held.
    part: f64,
    /// The greatest term of any slack there, or 1: it grows without bound towards the friction from which a
    /// block wedges.
    greatest_term: f64,
}

/// The least value from 0 to `best` where a load is held, to a relative width if no secant tells it; of what
/// is missed by more than the second argument of `missed` it is enough to know that.
fn least_of(
    (best, width): (f64, f64),
    missed: impl Fn(f64, f64) -> Result<Missed, Unsolved>,
    work: Work<'_>,
) -> Result<Option<f64>, Unsolved> {
    let is_held = |value| Ok(missed(value, ROUNDING)?.part <= ROUNDING);
    if is_held(0.0)? {
        return Ok(Some(0.0));
    }
    let (mut below, mut above) = (0.0, 1.0_f64.min(best));
    while !is_held(above)? {
        if above >= best {
            return Ok(None);
        }
        below = above;
        above = (4.0 * above).min(best);
    }
    while above - below > width * above {
        let middle = f64::midpoint(below, above);
        if middle <= below || middle >= above {
            break;
        }
        let digits = ((above - below) / above).ln() / width.ln();
        let progress = Progress { fraction: Some(digits), ..Progress::of("states", 0, 1) };
        if work.tell(&progress).is_break() {
            return Err(Unsolved);
        }
        match is_held(middle) {
            Ok(true) => above = middle,
            Ok(false) => below = middle,
            // Beside the friction from which a block wedges, forces may be too great for a linear program.
            Err(Unsolved) => {
                let root = missed_at([below, above], &missed).or_else(|| wedged_at([below, above], &missed));
                return root.map(Some).ok_or(Unsolved);
            }
        }
    }
    Ok(Some(missed_at([below, above], &missed).unwrap_or(above)))
}

/// The root in a bracket, or near it, from the secant through two points below it, where what is missed is
/// well above rounding: the bisection ends where that falls below [`ROUNDING`], not at its root.
fn missed_at(bracket: [f64; 2], missed: &impl Fn(f64, f64) -> Result<Missed, Unsolved>) -> Option<f64> {
    let points = BELOW.map(|distance| bracket[0] * (1.0 - distance));
    secant(bracket, points, |value| Some(missed(value, f64::INFINITY).ok()?.part))
}

/// The root from two points above the bracket, where forces are well below their infinity at the root.
fn wedged_at(bracket: [f64; 2], missed: &impl Fn(f64, f64) -> Result<Missed, Unsolved>) -> Option<f64> {
    let points = ABOVE.map(|distance| bracket[1] * (1.0 + distance));
    secant(bracket, points, |value| Some(missed(value, ROUNDING).ok()?.greatest_term.recip()))
}

fn secant(
    [below, above]: [f64; 2],
    [first, second]: [f64; 2],
    function: impl Fn(f64) -> Option<f64>,
) -> Option<f64> {
    let (at_first, at_second) = (function(first)?, function(second)?);
    let root = second + at_second * (second - first) / (at_first - at_second);
    (below * (1.0 - NEAR)..=above * (1.0 + NEAR)).contains(&root).then_some(root)
}

/// How the static coefficients depend on a parameter: they must be `constant + slope p` with a slope that is
/// not negative, which their formulas tell, and nothing else but friction may depend on it.
fn parameter_law(model: &Model, setup: &Setup, name: &str) -> Result<Law, Faults> {
    let parameter = friction_parameter(model, name)?;
    let refused = || not_only_friction(name);
    let line = |formula: FormulaId| {
        let line = model.line_of(formula, parameter).filter(|[_, slope]| *slope >= 0.0)?;
        Some(line.map(|number| model.friction * number))
    };
    let lines: Option<Vec<[[f64; 2]; 2]>> = model
        .contacts()
        .map(|contact| {
            let [positive, negative] = contact.mu_static.map(line);
            Some([positive?, negative?])
        })
        .collect();
    let lines = lines.filter(|lines| lines.len() == setup.mechanism.contacts.len()).ok_or_else(refused)?;
    let of_hinges = model.hinge_friction().map(|friction| line(friction.kinetic_and_static()[1]));
    let hinges: Vec<[f64; 2]> = of_hinges.collect::<Option<_>>().ok_or_else(refused)?;
    if lines.iter().flatten().chain(&hinges).all(|[_, slope]| *slope == 0.0) {
        return Err(refused());
    }
    let present = model.parameter_values(&model.constants()?)[parameter];
    Ok(Law { varied: name.to_owned(), present, parameter: None, lines, hinges })
}

/// The only parameter to which all static friction is proportional, with its value, if there is one.
fn only_parameter(model: &Model, setup: &Setup) -> Option<(String, f64)> {
    let laws = model.parameters.iter().filter_map(|one| parameter_law(model, setup, &one.name).ok());
    let is_proportional =
        |law: &Law| law.lines.iter().flatten().chain(&law.hinges).all(|[constant, _]| *constant == 0.0);
    let mut proportional = laws.filter(is_proportional);
    let only = proportional.next()?;
    proportional.next().is_none().then_some((only.varied, only.present))
}

/// The number of a parameter on which nothing but friction depends.
///
/// # Errors
/// Another name.
fn friction_parameter(model: &Model, name: &str) -> Result<usize, Faults> {
    let known = || model.parameters.iter().map(|parameter| &*parameter.name);
    match known().position(|other| other == name) {
        Some(parameter) if model.changes_friction_and_pins_alone(parameter) => Ok(parameter),
        None if model.coordinates.iter().all(|one| &*one.name != name) => {
            let kind = FaultKind::UnknownName {
                what: "parameter",
                name: name.to_owned(),
                nearest: nearest(name, known()),
                known: known().map(str::to_owned).collect(),
            };
            Err(Fault::general(kind).into())
        }
        _ => Err(not_only_friction(name)),
    }
}

fn not_only_friction(name: &str) -> Faults {
    Fault::general(FaultKind::NotOnlyFriction { parameter: name.to_owned() }).into()
}
