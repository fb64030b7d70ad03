//! One solution, followed to where it ends.

use super::branch::BranchEnd;
use super::curve::{Curve, Way};
use super::family::{Family, Instance};
use super::place::Place;
use super::samples::Found;
use crate::blocks::BlockSolution;
use crate::existence::EndCause;

/// Whether a solution of a problem keeps the bounds of its outputs.
pub fn keeps_bounds(instance: &Instance, solution: &BlockSolution) -> bool {
    Found::of(solution, 0.0, instance).meets_conditions(instance, None)
}

/// Where a solution that is known at a value ends towards a goal, which it may reach ([`EndCause::Range`]); the way is
/// followed in parts that are at most so long. None if there is no problem at the value.
pub fn end_of(
    family: &Family<'_>,
    (solution, at): (&BlockSolution, f64),
    goal: f64,
    part: f64,
) -> Option<BranchEnd> {
    let instance = family(at).ok()?;
    let found = Found::of(solution, at, &instance);
    let curve = Curve { family, equations: found.equations, greatest: None, orientation: found.orientation };
    let mut place = found.place;
    while place.at != goal {
        let left = goal - place.at;
        let next = if left.abs() <= part { goal } else { place.at + part.copysign(left) };
        match curve.walk(&place, next) {
            Way::Reaches(reached) => place = Place { at: next, ..reached },
            Way::Ends(last, cause) => return Some(BranchEnd::new(&curve, &last, cause, at)),
        }
    }
    Some(BranchEnd::new(&curve, &place, EndCause::Range, at))
}
