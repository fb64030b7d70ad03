//! Follows the branch of the drawing from place to place, by steps that are shown to stay on it.
//!
//! Nearness to a state says nothing about its branch, and Newton's method goes wherever it goes. So a step
//! counts only if [`Anchor`] proves that the way has one continuous solution, and that the state at its end
//! is that one; else it is halved. Before a fold or a dead centre steps shrink in proportion to the distance
//! from it, so that it is approached to within rounding in some hundred steps, and never passed.

use super::Pose;
use super::anchor::Anchor;
use super::factors::Factors;
use super::joint_equations::JointEquations;
use super::leg::Leg;
use super::mobility::advance;
use crate::mechanism::Mechanism;
use nalgebra::DVector;

/// Steps after which a place counts as too far away.
const MOST_STEPS: usize = 5000;
/// The way that is tried first (sizes of the mechanism, or rad).
const FIRST_WAY: f64 = 0.1;
/// Newton steps after which a state counts as not found; quadratic convergence needs far fewer.
const NEWTON_STEPS: usize = 25;
/// On ways as long as this (sizes of the mechanism, or rad) rounding is as great as the mechanism itself: nothing is there.
const FARTHEST: f64 = 1.0 / f64::EPSILON;
/// A residual (sizes of the mechanism, or rad) that one more Newton step brings to rounding, in a regular
/// state.
const CLOSED: f64 = 1e-12;
/// The joint equations are certainly regular if no pivot is below this multiple of the greatest.
const REGULAR: f64 = 1e-3;

/// Positions that satisfy the joints and the wanted coordinates to rounding.
#[derive(Debug, Clone)]
pub(super) struct Settled {
    pub(super) poses: Vec<Pose>,
    /// Factors of the Jacobian there, or where a last Newton step of a residual below [`CLOSED`] began.
    pub(super) factors: Factors,
}

/// The end of a leg, or of a part of it.
#[derive(Debug, Clone)]
pub(super) struct Arrival {
    pub(super) settled: Settled,
    pub(super) steps: usize,
    /// The beginning of the last step, and how far its proof reaches.
    anchor: Anchor,
    reach: f64,
    tube: DVector<f64>,
}

impl Arrival {
    /// The positions on the tangent at a place, if the last step is shown as far as there.
    pub(super) fn predicted(&self, mechanism: &Mechanism, place: f64) -> Option<Vec<Pose>> {
        let way = place - self.anchor.place;
        (way.abs() <= self.reach).then(|| self.anchor.predicted(mechanism, way))
    }

    /// Whether positions that satisfy the equations at a place are those of the branch.
    pub(super) fn holds(&self, place: f64, poses: &[Pose]) -> bool {
        self.anchor.holds(place - self.anchor.place, &self.tube, poses)
    }
}

/// Where a leg could not be followed any further.
#[derive(Debug, Clone)]
pub(super) struct Halt {
    pub(super) place: f64,
    /// The place that was wanted.
    pub(super) end: f64,
    pub(super) poses: Vec<Pose>,
    pub(super) steps: usize,
    /// Whether the work was to end.
    pub(super) is_ended: bool,
}

impl Halt {
    /// True if the number of steps is the reason, or the end of the work, or a way that is too long; else the joint equations
    /// are singular there within rounding.
    pub(super) fn is_effort(&self) -> bool {
        self.is_ended || self.steps >= MOST_STEPS || !is_within_reach(self.end)
    }
}

fn is_within_reach(end: f64) -> bool {
    end.abs() < FARTHEST
}

/// Follows a leg from a place with known positions to another one with these values of the coordinates. It halts once
/// `proceed`, which is asked before every further step, is `false`.
pub(super) fn follow(
    (mechanism, leg): (&Mechanism, &Leg),
    (mut place, mut poses): (f64, Vec<Pose>),
    (end, values): (f64, &[f64]),
    proceed: &mut dyn FnMut() -> bool,
) -> Result<Arrival, Halt> {
    if !is_within_reach(end) {
        return Err(Halt { place, end, poses, steps: 0, is_ended: false });
    }
    let mut guess = FIRST_WAY;
    for steps in 1..=MOST_STEPS {
        let rest = end - place;
        let halt = |poses: Vec<Pose>| Halt { place, end, poses, steps: steps - 1, is_ended: false };
        if steps > 1 && !proceed() {
            return Err(Halt { is_ended: true, ..halt(poses) });
        }
        let mut is_ended = false;
        let mut asked = || {
            is_ended = !proceed();
            !is_ended
        };
        let Some(anchor) = Anchor::new((mechanism, leg), place, poses.clone(), &mut asked) else {
            return Err(Halt { is_ended, ..halt(poses) });
        };
        let longest = rest.abs().max(1.0);
        let Some((mut reach, mut tube)) = anchor.reach(guess, longest) else { return Err(halt(poses)) };
        guess = reach;
        let (next, settled) = loop {
            let arrives = rest.abs() <= reach;
            let next = if arrives { end } else { place + reach.copysign(rest) };
            let between;
            let wanted = if arrives {
                values
            } else {
                between = leg.values(next);
                &between
            };
            let way = next - place;
            let predicted = anchor.predicted(mechanism, way);
            let settled = settle(mechanism, leg, (next, wanted), predicted);
            if let Some(settled) = settled.filter(|settled| anchor.holds(way, &tube, &settled.poses)) {
                break (next, settled);
            }
            // Newton's method has not come to the solution that is there.
            reach /= 2.0;
            match anchor.tube(reach) {
                Some(narrower) if place + reach.copysign(rest) != place => tube = narrower,
                _ => return Err(halt(poses)),
            }
        };
        if next == end {
            return Ok(Arrival { settled, steps, anchor, reach, tube });
        }
        if next == place {
            return Err(halt(poses));
        }
        (place, poses) = (next, settled.poses);
    }
    Err(Halt { place, end, poses, steps: MOST_STEPS, is_ended: false })
}

/// Newton's method, from positions nearby.
pub(super) fn settle(
    mechanism: &Mechanism,
    leg: &Leg,
    (place, values): (f64, &[f64]),
    mut poses: Vec<Pose>,
) -> Option<Settled> {
    let mut last = f64::INFINITY;
    for _ in 0..NEWTON_STEPS {
        let equations = JointEquations::with_coordinates(mechanism, &poses, values);
        let residual = leg.residual(equations.residual, place);
        let size = residual.amax();
        let factors = Factors::of(&equations.jacobian);
        // As small as rounding lets it be.
        if size == 0.0 || (size < CLOSED && size > last / 2.0) {
            return Some(Settled { poses, factors });
        }
        let step = factors.solution(&-residual)?;
        if !step.iter().all(|part| part.abs() < 1.0) {
            return None;
        }
        advance(mechanism, &mut poses, &step);
        // This last step has brought the residual to rounding.
        if size < CLOSED && factors.are_regular(REGULAR) {
            return Some(Settled { poses, factors });
        }
        last = size;
    }
    None
}
