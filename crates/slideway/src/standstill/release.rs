//! States in which a mechanism begins to move: every joint sticks or slips one way or the other.

use super::TOLERANCE;
use super::reactions::{range, reactions};
use super::report::{CoordinateRange, JointRelease, Range, Release};
use super::rest::{Over, possible, static_coefficients, symbols, until_over};
use super::setup::{Setup, SlidingJoint};
use super::state::{State, StateQuestion, sides};
use super::words::slip_in_words;
use crate::configuration::unit;
use crate::pattern::{JointPhase, Phase, Region, Unsolved};
use crate::progress::Work;

/// Two states are the same if no number differs by more than this, relative to the units of the programs.
const SAME: f64 = 1e-7;

/// All states in which something begins to move, with a factor of the varied load.
///
/// Without `at_rest` the state in which all joints stick is tried, too: bodies may begin to move in hinges
/// alone.
pub(super) fn releases(setup: &Setup, factor: f64, at_rest: bool, work: Work<'_>) -> Over<Vec<Release>> {
    let mut over = Over { found: Vec::new(), undecided: 0 };
    let states = sliding_states(setup.sliders.len());
    let all = states.len();
    for (index, sliding) in states.into_iter().enumerate() {
        if at_rest && sliding.iter().all(|joint| *joint == JointPhase::Sticking) {
            continue;
        }
        for sides in until_over(sides(setup), work.part(index, all)) {
            let pattern = Phase { joints: sliding.clone(), contacts: sides };
            match release(setup, &pattern, factor) {
                Ok(Some(release)) => add(&mut over.found, release, setup),
                Ok(None) => {}
                Err(Unsolved) => over.undecided += 1,
            }
        }
    }
    over
}

/// Every combination of sticking and slipping either way.
fn sliding_states(joints: usize) -> Vec<Vec<JointPhase>> {
    let mut all = vec![Vec::new()];
    for _ in 0..joints {
        let extended = |states: Vec<JointPhase>| {
            let options = [JointPhase::Sticking, JointPhase::Sliding(1.0), JointPhase::Sliding(-1.0)];
            options.into_iter().map(move |option| states.iter().copied().chain([option]).collect())
        };
        all = all.into_iter().flat_map(extended).collect();
    }
    all
}

fn release(setup: &Setup, pattern: &Phase, factor: f64) -> Result<Option<Release>, Unsolved> {
    let question = StateQuestion { moving: true, ..StateQuestion::rest(Some(factor)) };
    let Some(state) = State::new(setup, pattern, question) else { return Ok(None) };
    let Some(region) = possible(state.region(&static_coefficients(setup)))? else { return Ok(None) };
    let Some(region) = really_slipping(setup, pattern, &state, region)? else { return Ok(None) };
    let of_joint = |(index, slider): (usize, &SlidingJoint)| {
        let expression = state.sliding_acceleration(index);
        let (slip, acceleration) = match pattern.joints[index] {
            JointPhase::Sticking => (0, Range { least: Some(0.0), greatest: Some(0.0) }),
            JointPhase::Sliding(sign) => {
                let range = range(&state, &region, &expression, setup.units.acceleration)?;
                (if sign < 0.0 { -1 } else { 1 }, range)
            }
        };
        Ok(JointRelease {
            name: setup.mechanism.joints[slider.joint.index()].name.to_string(),
            slip,
            words: slip_in_words(setup, slider.joint, slip),
            acceleration,
        })
    };
    let joints = setup.sliders.iter().enumerate().map(of_joint).collect::<Result<_, _>>()?;
    let reactions = reactions(setup, &state, &region)?;
    Ok(Some(Release {
        joints,
        patterns: vec![symbols(setup, pattern, &reactions)],
        coordinates: coordinates(setup, &state, &region)?,
        reactions,
    }))
}

/// The region, unless a joint that should slip does not accelerate anywhere in it. Where no joint slips some
/// coordinate must accelerate.
fn really_slipping(
    setup: &Setup,
    pattern: &Phase,
    state: &State<'_>,
    region: Region,
) -> Result<Option<Region>, Unsolved> {
    let mut some = false;
    for (index, joint) in pattern.joints.iter().enumerate() {
        let JointPhase::Sliding(sign) = joint else { continue };
        some = true;
        let acceleration = state.sliding_acceleration(index).times(*sign);
        let [_, greatest] = region.extent(&state.function(&acceleration))?;
        if greatest.is_some_and(|greatest| greatest <= TOLERANCE) {
            return Ok(None);
        }
    }
    if !some && coordinates(setup, state, &region)?.iter().all(|coordinate| is_zero(coordinate, setup)) {
        return Ok(None);
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

fn coordinates(setup: &Setup, state: &State<'_>, region: &Region) -> Result<Vec<CoordinateRange>, Unsolved> {
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
        let slips = other.joints.iter().zip(&release.joints).all(|(a, b)| a.slip == b.slip);
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
