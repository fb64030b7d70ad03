//! States in which a mechanism that moves can go on: the signs of the accelerations of joints and hinges at rest, sides of
//! contacts, directions of the forces of hinges (theory of hinges, section 9).

use super::directions::{directions, most_directions};
use super::rest::{Over, possible, static_friction};
use super::setup::Setup;
use super::state::{Pattern, State, StateQuestion, side_options, sides};
use super::turning::turning_states;
use super::{MOST_STATES, held_motions};
use crate::fault::{Fault, FaultKind, Faults};
use crate::pattern::{AffineExpression, ContactPhase, JointPhase, Unsolved};
use crate::progress::Work;
use nalgebra::DMatrix;

/// A state in which a mechanism that moves can go on.
pub(crate) struct MotionState {
    /// What joints, hinges and contacts do.
    pub(crate) pattern: Pattern,
    /// Accelerations of the bodies, or jumps of their velocities: (x, y, angle) of each.
    pub(crate) accelerations: Vec<f64>,
    /// The force of each hinge with friction on its first body (N).
    pub(crate) forces: Vec<[f64; 2]>,
    /// The force with which the stop of each sliding joint pushes it while it slides (N), else zero.
    pub(crate) pushes: Vec<f64>,
}

const QUESTION: StateQuestion = StateQuestion { moving: true, factor: Some(0.0), wedged: false };

/// All such states; with them the number of patterns that were not decided. Bounds of friction in what sticks beside hinges
/// that turn are left to [`whole_slack`]. What begins to move may do so without an acceleration yet, at the threshold of
/// its friction: whether it really begins shows in what follows.
/// Once the work is to end nothing more is decided.
///
/// # Errors
/// More states than are tried.
pub(crate) fn motion_states(setup: &Setup, work: Work<'_>) -> Result<(Vec<MotionState>, usize), Faults> {
    let motions = held_motions(setup);
    let sides = sides_within(setup, &motions)?;
    let mut over = Over { found: Vec::new(), undecided: 0 };
    let mut note = |states: Option<(Vec<MotionState>, bool)>| {
        let (states, decided) = states.unwrap_or_default();
        over.found.extend(states);
        over.undecided += usize::from(!decided);
    };
    for signs in directions(setup, &motions, true) {
        if signs.hinges.iter().any(|hinge| *hinge != JointPhase::Sticking) {
            let states = turning_states(setup, &signs, &motions, &mut |_| work.flow());
            note(states.map(|states| (states.list, states.decided)));
            if work.is_over() {
                break;
            }
            continue;
        }
        for sides in &sides {
            let pattern = Pattern { contacts: sides.clone(), ..signs.clone() };
            note(state_of(setup, &pattern).map(|state| (Vec::from_iter(state), true)).ok());
        }
    }
    Ok((over.found, over.undecided))
}

/// All combinations of sides, if there are not too many states.
fn sides_within(setup: &Setup, motions: &DMatrix<f64>) -> Result<Vec<Vec<ContactPhase>>, Faults> {
    let options = side_options(setup);
    let all = options.iter().fold(1_u64, |sides, options| sides.saturating_mul(options.len() as u64));
    let at_rest = setup.known.iter().filter(|known| known.sign.is_none()).count();
    let states = most_directions(motions.ncols(), at_rest).saturating_mul(all);
    if states > MOST_STATES {
        return Err(Fault::general(FaultKind::TooManyStates { states, limit: MOST_STATES }).into());
    }
    Ok(sides(setup))
}

/// The state of a pattern in which no hinge with friction turns.
fn state_of(setup: &Setup, pattern: &Pattern) -> Result<Option<MotionState>, Unsolved> {
    let Some(state) = State::new(setup, pattern, QUESTION) else { return Ok(None) };
    let Some(region) = possible(state.region(&static_friction(setup)))? else { return Ok(None) };
    let (_, point) = region.highest()?;
    let at = |function: &AffineExpression| state.function(function).at(&point);
    let push = |(slider, push): (usize, Option<AffineExpression>)| {
        let push = push.filter(|_| setup.known[slider].pushed);
        push.map_or(0.0, |push| setup.units.force * at(&push))
    };
    Ok(Some(MotionState {
        pushes: state.pushes().into_iter().enumerate().map(push).collect(),
        pattern: pattern.clone(),
        accelerations: state.accelerations().iter().map(at).collect(),
        forces: state.hinge_forces().iter().map(|force| force.each_ref().map(at)).collect(),
    }))
}

/// By how much the forces of a pattern in which joints or hinges stick stay within all bounds, over the sides of the
/// contacts that stick: the greatest least slack, in units of the setup; nothing where they cannot, or where that is not
/// decided. The forces of the hinges that turn are taken in these directions.
pub(crate) fn whole_slack(setup: &Setup, pattern: &Pattern, directions: &[[f64; 2]]) -> Option<f64> {
    let sticks = |k: usize| {
        let joint = setup.sliders.iter().position(|slider| slider.contacts.contains(&k));
        joint.is_some_and(|joint| pattern.joints[joint] == JointPhase::Sticking)
    };
    let agrees =
        |sides: &Vec<ContactPhase>| (0..sides.len()).all(|k| sticks(k) || sides[k] == pattern.contacts[k]);
    let slack = |sides: Vec<ContactPhase>| {
        let pattern = Pattern { contacts: sides, ..pattern.clone() };
        let state = State::turning(setup, &pattern, (QUESTION, Some(directions)))?;
        state.region(&static_friction(setup)).highest().ok().map(|(slack, _)| slack)
    };
    let slacks = sides(setup).into_iter().filter(agrees).filter_map(slack);
    slacks.reduce(f64::max)
}
