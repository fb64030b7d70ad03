//! What is returned of branches.

use super::curve::Curve;
use super::family::Family;
use super::place::Place;
use crate::blocks::BlockProblem;
use crate::existence::{EndCause, Limit, ModeEnd};
use crate::interval::Sign;
use crate::problem::ContactState;
use crate::solutions::GapShare;

/// How close to an end at which forces grow without bound the others are evaluated, as a share of the interval.
const NEAR: f64 = 1e-7;
/// What is above this share there grows.
const GROWS: f64 = 1e-6;

/// An interval of the parameter in which a solution exists, with the same states of the contacts and orientation.
#[derive(Debug, Clone)]
pub struct Branch {
    /// The states of the contacts; of one without normal force throughout, as computed.
    pub states: Vec<ContactState>,
    /// The sign of `det(I - H D)`, 1 or -1: with slightly elastic joints the mechanism never settles where it is
    /// negative.
    pub orientation: i8,
    /// Where it begins.
    pub from: BranchEnd,
    /// Where it ends.
    pub to: BranchEnd,
    /// Places along it, its ends among them.
    pub(super) trail: Vec<Place>,
    pub(super) equations: super::place::Equations,
}

/// An end of a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchEnd {
    /// Where, why, and the normal forces towards it.
    pub end: ModeEnd,
    /// The magnitudes of the hinge forces towards it; `None` if they could not be computed.
    pub hinge_force: Option<Vec<Limit>>,
}

/// A stretch of the parameter without a problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// A value in it at which there is none.
    pub inside: f64,
}

/// All branches in a range.
#[derive(Debug, Clone, Default)]
pub struct Branches {
    /// The branches, by states, orientation and then by where they begin.
    pub branches: Vec<Branch>,
    /// The values at which all solutions were found.
    pub tried: Vec<f64>,
    /// The stretches without a problem.
    pub gaps: Vec<Gap>,
}

impl Branches {
    /// The branches of another parameter, of which this one is an increasing function; `at` is its inverse.
    #[must_use]
    pub fn of(mut self, at: impl Fn(f64) -> f64) -> Self {
        for branch in &mut self.branches {
            branch.from.end.at = at(branch.from.end.at);
            branch.to.end.at = at(branch.to.end.at);
            branch.trail.iter_mut().for_each(|place| place.at = at(place.at));
        }
        self.tried.iter_mut().for_each(|value| *value = at(*value));
        self
    }
}

impl Branch {
    /// By states, orientation and then by where they begin.
    pub(super) fn order(one: &Self, other: &Self) -> std::cmp::Ordering {
        let key = |branch: &Self| (branch.states.clone(), -branch.orientation);
        key(one).cmp(&key(other)).then(one.from.end.at.total_cmp(&other.from.end.at))
    }

    /// The solution of the branch at a value in its interval; none if it is not found.
    pub fn solution(&self, at: f64, family: &Family<'_>) -> Option<BranchForces> {
        let after = self.trail.partition_point(|place| place.at < at);
        let near = [after.checked_sub(1), Some(after)].into_iter().flatten();
        let near: Vec<&Place> = near.filter_map(|index| self.trail.get(index)).collect();
        let orientation = if self.orientation < 0 { Sign::Negative } else { Sign::Positive };
        let curve = Curve { family, equations: self.equations.clone(), greatest: None, orientation };
        let between = |one: &Place, other: &Place| {
            let share = (at - one.at) / (other.at - one.at);
            Place { at, z: &one.z * (1.0 - share) + &other.z * share }
        };
        let interpolated = match near[..] {
            [one, other] if other.at > one.at => Some(between(one, other)),
            _ => None,
        };
        let starts = interpolated.into_iter().chain(near.into_iter().cloned());
        let instance = family(at).ok()?;
        let found = starts
            .filter_map(|start| curve.solution(at, &start))
            .find(|place| curve.holds(&instance, place))?;
        Some(self.forces(&instance.problem, &found))
    }

    fn forces(&self, problem: &BlockProblem, place: &Place) -> BranchForces {
        let contacts = problem.contacts();
        let force = |row: usize| place.z[row] / place.load() * self.equations.unit;
        let in_gap = |contact: &usize| self.states[*contact] == ContactState::Gap;
        BranchForces {
            normal: (0..contacts).map(|k| if in_gap(&k) { 0.0 } else { force(k) }).collect(),
            hinges: (0..problem.hinges())
                .map(|hinge| [0, 1].map(|axis| force(contacts + 2 * hinge + axis)))
                .collect(),
            gaps: (0..contacts)
                .filter(in_gap)
                .map(|contact| GapShare { contact, lambda: place.z[contact] / place.load() })
                .collect(),
        }
    }
}

/// The forces of a solution.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchForces {
    /// Normal forces, with their signs.
    pub normal: Vec<f64>,
    /// Hinge forces.
    pub hinges: Vec<[f64; 2]>,
    /// The shares of contacts in their gap.
    pub gaps: Vec<GapShare>,
}

impl BranchEnd {
    /// An end at a place of a curve, with forces from a place nearby where they grow without bound.
    pub(super) fn new(curve: &Curve<'_>, place: &Place, cause: EndCause, other: f64) -> Self {
        let contacts = curve.equations.states.len();
        let hinges = (place.z.len() - 1 - contacts) / 2;
        let is_infinite = cause == EndCause::Singular;
        let near = if is_infinite {
            curve.solution(place.at + NEAR * (other - place.at), place)
        } else {
            Some(place.clone())
        };
        let limit = |value: f64, near: f64| {
            if is_infinite && value.abs() > GROWS {
                Limit::Infinite(value.signum())
            } else {
                Limit::Finite(near)
            }
        };
        let forces = near.filter(|near| near.load() != 0.0).map(|near| {
            let per_load = curve.equations.unit / near.load();
            let normal = (0..contacts).map(|k| match curve.equations.states[k] {
                Some(ContactState::Gap) => Limit::Finite(0.0),
                _ => limit(place.z[k], near.z[k] * per_load),
            });
            let length =
                |hinge: usize| limit(place.length(contacts, hinge), near.length(contacts, hinge) * per_load);
            (normal.collect(), (0..hinges).map(length).collect())
        });
        let (normal_force, hinge_force) = forces.unzip();
        Self { end: ModeEnd { at: place.at, cause, normal_force }, hinge_force }
    }
}
