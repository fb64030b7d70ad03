//! States in which a mechanism begins to move: every joint sticks or slips one way or the other.

use super::directions::Direction;
use super::reactions::{range, reactions};
use super::report::{CoordinateRange, GapRange, JointRelease, Range, Release};
use super::rest::{Over, possible, static_friction, symbols, until_over};
use super::setup::{Setup, SlidingJoint};
use super::state::{Pattern, State, StateQuestion, sides};
use super::turning::{TurningState, TurningStates, turning_states};
use super::words::release_in_words;
use super::{TOLERANCE, held_motions};
use crate::configuration::unit;
use crate::pattern::{JointPhase, Region, Unsolved, direction};
use crate::progress::Work;
use nalgebra::DMatrix;

/// Two states are the same if no number differs by more than this, relative to the units of the programs.
const SAME: f64 = 1e-7;

/// All states in which something begins to move in one of these directions, with the nominal factor of the varied load.
///
/// Without `at_rest` the state in which all joints stick is tried, too: bodies may begin to move in hinges
/// without friction alone.
pub(super) fn releases(
    setup: &Setup,
    directions: &[Direction],
    at_rest: bool,
    work: Work<'_>,
) -> Over<Vec<Release>> {
    let mut over = Over { found: Vec::new(), undecided: 0 };
    let motions = held_motions(setup, &[]);
    let all = directions.len();
    for (index, Direction { signs, open }) in directions.iter().enumerate() {
        let mut joints = signs.joints.iter().chain(&signs.hinges);
        if at_rest && open.is_empty() && joints.all(|joint| *joint == JointPhase::Sticking) {
            continue;
        }
        let work = work.part(index, all);
        if let Some(states) = isolated(setup, signs, &motions, work) {
            over.undecided += usize::from(!states.decided);
            for (state, piece) in until_over(states.list, work) {
                over.note(setup, turned(setup, &state, piece).map(Vec::from_iter));
            }
            continue;
        }
        for (sides, piece) in until_over(sides(setup, open), work) {
            over.note(setup, released(setup, &Pattern { contacts: sides, ..signs.clone() }, piece));
        }
    }
    over
}

/// Whether something begins to move in one of these directions in which a joint slips.
pub(super) fn is_released(setup: &Setup, directions: &[Direction], work: Work<'_>) -> bool {
    let all = directions.len();
    (0..all).any(|at| !releases(setup, &directions[at..=at], true, work.part(at, all)).found.is_empty())
}

impl Over<Vec<Release>> {
    fn note(&mut self, setup: &Setup, releases: Result<Vec<Release>, Unsolved>) {
        match releases {
            Ok(releases) => releases.into_iter().for_each(|release| add(&mut self.found, release, setup)),
            Err(Unsolved) => self.undecided += 1,
        }
    }
}

/// The states with these signs if hinges turn in them, the friction of what sticks is determined, guides share no load and
/// nothing may lift off, so that their forces are isolated: then the search of the block mode problem finds all of them, or says that it does not.
fn isolated(setup: &Setup, signs: &Pattern, motions: &DMatrix<f64>, work: Work<'_>) -> Option<TurningStates> {
    let may_lift_off = setup.mechanism.has_one_sided();
    if setup.shared.is_some()
        || may_lift_off
        || signs.hinges.iter().all(|hinge| *hinge == JointPhase::Sticking)
    {
        return None;
    }
    let states = turning_states(setup, signs, motions, &mut |told| work.tell(told))?;
    states.determinate.then_some(states)
}

/// How a mechanism begins to move in a state in which hinges turn.
fn turned(setup: &Setup, state: &TurningState, work: Work<'_>) -> Result<Option<Release>, Unsolved> {
    let directions: Vec<[f64; 2]> = state.forces.iter().map(|force| direction(*force)).collect();
    let question = (question(setup), Some(&directions[..]));
    let Some(linear) = State::turning(setup, &state.pattern, question) else { return Ok(None) };
    release(setup, &state.pattern, &linear, linear.region(&static_friction(setup)).watched(work))
}

fn question(setup: &Setup) -> StateQuestion {
    let factor = setup.load.as_ref().map_or(1.0, |load| load.nominal);
    StateQuestion { moving: true, ..StateQuestion::rest(Some(factor)) }
}

/// The ways in which a mechanism begins to move with a pattern: one for each part into which turning hinges divide its
/// region.
fn released(setup: &Setup, pattern: &Pattern, work: Work<'_>) -> Result<Vec<Release>, Unsolved> {
    let Some(state) = State::new(setup, pattern, question(setup)) else { return Ok(Vec::new()) };
    let parts = state.region(&static_friction(setup)).watched(work).parts()?;
    let all = parts.len();
    let of_part = |(index, part): (usize, Region<'_>)| {
        release(setup, pattern, &state, part.watched(work.part(index, all)))
    };
    let releases = parts.into_iter().enumerate().map(of_part);
    releases.filter_map(Result::transpose).collect()
}

fn release(
    setup: &Setup,
    pattern: &Pattern,
    state: &State<'_>,
    region: Region<'_>,
) -> Result<Option<Release>, Unsolved> {
    let Some(region) = possible(region)? else { return Ok(None) };
    let Some(region) = really_slipping(setup, state, region)? else { return Ok(None) };
    let open: Vec<usize> = state.open().collect();
    let name = |k: usize| setup.mechanism.contacts[k].name.to_string();
    let of_joint = |(index, slider): (usize, &SlidingJoint)| {
        let expression = state.sliding_acceleration(index);
        let (slip, acceleration) = match pattern.joints[index] {
            JointPhase::Sticking => (0, Range { least: Some(0.0), greatest: Some(0.0) }),
            JointPhase::Sliding(sign) => {
                let range = range(state, &region, &expression, setup.units.acceleration)?;
                (if sign < 0.0 { -1 } else { 1 }, range)
            }
        };
        Ok(JointRelease {
            name: setup.mechanism.joints[slider.joint.index()].name.to_string(),
            slip,
            words: release_in_words(setup, slider, &pattern.contacts, slip),
            acceleration,
            open: slider.contacts.iter().filter(|&&k| open.contains(&k)).map(|&k| name(k)).collect(),
        })
    };
    let touching = setup.sliders.iter().enumerate().filter(|(_, slider)| !slider.contacts.is_empty());
    let joints = touching.map(of_joint).collect::<Result<_, _>>()?;
    let reactions = reactions(setup, state, &region)?;
    Ok(Some(Release {
        joints,
        patterns: vec![symbols(setup, pattern, &reactions)],
        gaps: open.iter().map(|&k| gap(setup, state, &region, k)).collect::<Result<_, _>>()?,
        coordinates: coordinates(setup, state, &region)?,
        reactions,
    }))
}

/// How a contact lifts off.
fn gap(setup: &Setup, state: &State<'_>, region: &Region<'_>, k: usize) -> Result<GapRange, Unsolved> {
    Ok(GapRange {
        contact: setup.mechanism.contacts[k].name.to_string(),
        acceleration: range(state, region, &state.gap_acceleration(k), setup.units.acceleration)?,
    })
}

/// The region, unless a joint that should slip does not accelerate anywhere in it. Where no joint slips some
/// coordinate must accelerate.
fn really_slipping<'w>(
    setup: &Setup,
    state: &State<'_>,
    region: Region<'w>,
) -> Result<Option<Region<'w>>, Unsolved> {
    let Some(region) = really_beginning(state, region)? else { return Ok(None) };
    let slips = !state.beginning().is_empty();
    let rests = |region| {
        let coordinates = coordinates(setup, state, region)?;
        Ok(coordinates.iter().all(|coordinate| is_zero(coordinate, setup)))
    };
    Ok(if slips || !rests(&region)? { Some(region) } else { None })
}

/// The region, unless a joint that should begin to move does not accelerate anywhere in it.
fn really_beginning<'w>(state: &State<'_>, region: Region<'w>) -> Result<Option<Region<'w>>, Unsolved> {
    for acceleration in &state.beginning() {
        let [_, greatest] = region.extent(&state.function(acceleration))?;
        if greatest.is_some_and(|greatest| greatest <= TOLERANCE) {
            return Ok(None);
        }
    }
    Ok(Some(region))
}

fn is_zero(coordinate: &CoordinateRange, setup: &Setup) -> bool {
    let limit = TOLERANCE * acceleration_unit(setup, coordinate.unit);
    [coordinate.acceleration.least, coordinate.acceleration.greatest]
        .iter()
        .all(|end| end.is_some_and(|end| end.abs() <= limit))
}

fn acceleration_unit(setup: &Setup, unit: &str) -> f64 {
    let units = &setup.units;
    if unit == "rad/s^2" { units.acceleration / units.length } else { units.acceleration }
}

fn coordinates(
    setup: &Setup,
    state: &State<'_>,
    region: &Region<'_>,
) -> Result<Vec<CoordinateRange>, Unsolved> {
    let pairs = setup.mechanism.coordinates.iter().zip(setup.assembled.coordinate_rows());
    let one = |(coordinate, row): (&crate::mechanism::Coordinate, &[(usize, f64)])| {
        let in_words = if unit(&coordinate.kind) == "rad" { "rad/s^2" } else { "m/s^2" };
        let scale = acceleration_unit(setup, in_words);
        let expression = state.of_accelerations(row.iter().copied(), scale);
        Ok(CoordinateRange {
            name: coordinate.name.to_string(),
            unit: in_words,
            acceleration: range(state, region, &expression, scale)?,
        })
    };
    pairs.map(one).collect()
}

/// Adds a state, or its patterns to one that differs from it by nothing else.
fn add(found: &mut Vec<Release>, release: Release, setup: &Setup) {
    let force = SAME * setup.units.force * setup.units.length.max(1.0);
    let same = |other: &&mut Release| {
        let mut joints = other.joints.iter().zip(&release.joints);
        let slips = joints.all(|(a, b)| a.slip == b.slip && a.open == b.open);
        let motion = other
            .coordinates
            .iter()
            .zip(&release.coordinates)
            .all(|(a, b)| close(a.acceleration, b.acceleration, SAME * acceleration_unit(setup, a.unit)));
        let ranges = other.reactions.ranges().into_iter().zip(release.reactions.ranges());
        slips && motion && ranges.into_iter().all(|(a, b)| close(a, b, force))
    };
    match found.iter_mut().find(same) {
        Some(other) => {
            let new = release.patterns.into_iter().filter(|pattern| !other.patterns.contains(pattern));
            let new: Vec<String> = new.collect();
            other.patterns.extend(new);
        }
        None => found.push(release),
    }
}

fn close(one: Range, other: Range, tolerance: f64) -> bool {
    let near = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= tolerance,
        (None, None) => true,
        _ => false,
    };
    near(one.least, other.least) && near(one.greatest, other.greatest)
}
