//! The curve of a branch: steps along its arc, and its ends.

use nalgebra::{DMatrix, DVector};

use super::conditions::{self, are_met, conditions, slack};
use super::family::{Family, Instance};
use super::place::{Equations, Place};
use crate::existence::EndCause;
use crate::interval::Sign;

/// Steps of Newton's method.
const NEWTON: usize = 25;
/// A step of this length is the last one.
const LAST: f64 = 4.0 * f64::EPSILON;
/// On the way to an end a step of this share of the step along the curve is the last one.
const ROUGH: f64 = 1e-5;
/// Steps that are not halved any more have reached rounding, if they are below this.
const SMALL: f64 = 1e-10;
/// The longest step along the arc, of unit vectors `z` and of the way to the goal.
const LONGEST: f64 = 0.2;
/// Where a shorter one would be needed the curve is not followed any further.
const SHORTEST: f64 = 1e-9;
/// Steps along an arc.
const STEPS: usize = 2000;
/// Ends are located to this share of the step that leads beyond them, in at most one evaluation more than halving it
/// so many times takes.
const LOCATED: f64 = f64::EPSILON;
const HALVINGS: i32 = 51;
/// By how much an estimate of an end is shifted towards the middle of the bracket, as a share of its squared width.
const SHIFT: f64 = 0.2;
/// Places this near to the goal, as a share of the way, are there.
const AT_GOAL: f64 = 1e-7;
/// A step that is longer than predicted by more than this share is too long: its direction is off by more than
/// `acos(1 / 1.005)`, 5.7 degrees.
const TURN: f64 = 0.005;
/// Where a step of Newton's method is longer than this share of the one before, the step along the curve is too long
/// (Deuflhard, A stepsize control for continuation methods, 1979).
const CONTRACTION: f64 = 0.1;
/// Differences of the parameter for derivatives, as a share of the way to the goal.
const DIFFERENCE: f64 = 1e-4;
/// Below this `lambda` the determinant vanishes together with it.
const NEAR_INFINITY: f64 = 1e-7;
/// Hinge forces below this share of the largest unknown vanish.
const NO_FORCE: f64 = 1e-6;

/// How far a branch goes towards a goal.
#[derive(Debug, Clone)]
pub(super) enum Way {
    /// To the goal.
    Reaches(Place),
    /// To an end before it: the last place, and why.
    Ends(Place, EndCause),
}

/// The curve of a branch.
pub(super) struct Curve<'c> {
    pub(super) family: &'c Family<'c>,
    pub(super) equations: Equations,
    /// The greatest normal force that counts.
    pub(super) greatest: Option<f64>,
    pub(super) orientation: Sign,
}

/// A direction along a curve: of `z`, and of the parameter in units of the way to the goal.
type Tangent = DVector<f64>;

/// The direction of a step, with the derivative of the equations at fixed `z` by the parameter: that of a place nearby
/// does, as Newton's method corrects what it misses.
struct Along {
    tangent: Tangent,
    slope: DVector<f64>,
}

/// A place this far along a step.
struct Probe {
    length: f64,
    place: Place,
    /// By how much each condition, and the orientation, is met.
    room: Vec<f64>,
}

/// A walk along a curve, whose parameter counts from its start in units of the way to its goal.
struct Walk<'c> {
    curve: &'c Curve<'c>,
    from: f64,
    way: f64,
    /// By how much each condition may be missed.
    slack: Vec<f64>,
}

impl Curve<'_> {
    /// The same in the unit of a problem: loads may be much greater elsewhere on the curve, and steps are measured in
    /// the unit.
    fn in_unit_of(&self, instance: &Instance) -> Self {
        Self { equations: self.equations.with_unit(instance.unit()), ..*self }
    }

    /// The solution at a value near one that is known; none if Newton's method does not converge.
    pub(super) fn solution(&self, at: f64, near: &Place) -> Option<Place> {
        let instance = (self.family)(at).ok()?;
        let curve = self.in_unit_of(&instance);
        let near = self.equations.converted(near, &curve.equations);
        let found = curve.solution_of(&instance, at, &near)?;
        Some(curve.equations.converted(&found, &self.equations))
    }

    fn solution_of(&self, instance: &Instance, at: f64, near: &Place) -> Option<Place> {
        let normal = near.z.transpose();
        let mut z = near.z.clone();
        let rows = z.len() - 1;
        let mut right = DVector::zeros(rows + 1);
        right[rows] = 1.0;
        let mut last = f64::INFINITY;
        for _ in 0..NEWTON {
            let mut matrix = self.equations.matrix(instance, &z).insert_row(rows, 0.0);
            matrix.set_row(rows, &normal);
            let next = matrix.lu().solve(&right)?;
            let step = (&next - &z).amax();
            z = next;
            if !step.is_finite() {
                return None;
            }
            if step <= LAST || step <= SMALL && 2.0 * step >= last {
                return Some(Place { at, z: z.normalize() });
            }
            last = step;
        }
        None
    }

    /// Whether a place is part of the branch, apart from rounding.
    pub(super) fn holds(&self, instance: &Instance, place: &Place) -> bool {
        let curve = self.in_unit_of(instance);
        let place = self.equations.converted(place, &curve.equations);
        curve.equations.orientation(instance, &place.z) == self.orientation
            && are_met(&conditions(&curve.equations, instance, &place, self.greatest))
    }

    /// How far the branch goes from a place towards a value.
    pub(super) fn walk(&self, start: &Place, goal: f64) -> Way {
        if start.at == goal {
            return Way::Reaches(start.clone());
        }
        let Ok(instance) = (self.family)(start.at) else {
            return Way::Ends(start.clone(), EndCause::NotFollowed);
        };
        let curve = self.in_unit_of(&instance);
        let start = self.equations.converted(start, &curve.equations);
        let here = conditions(&curve.equations, &instance, &start, self.greatest);
        let slack = here.iter().map(slack).collect();
        let back = |place: Place| curve.equations.converted(&place, &self.equations);
        match (Walk { curve: &curve, from: start.at, way: goal - start.at, slack }).walk(&start) {
            Way::Reaches(place) => Way::Reaches(back(place)),
            Way::Ends(place, cause) => Way::Ends(back(place), cause),
        }
    }
}

impl Walk<'_> {
    fn walk(&self, start: &Place) -> Way {
        let mut place = start.clone();
        let mut towards = DVector::zeros(start.z.len() + 1);
        towards[start.z.len()] = 1.0;
        let mut length = LONGEST;
        for _ in 0..STEPS {
            let Some(along) = self.along(&place, &towards) else { return self.lost(place) };
            if let Some(end) = self.goal_within(&place, &along.tangent, length) {
                return Way::Reaches(end);
            }
            let (next, room) = loop {
                let next = self.step(&place, &along, length, None).map(|next| (self.room(&next), next));
                match next {
                    Some((room, next)) if self.is_ahead(&place, &next, &room) => break (next, room),
                    _ if length < SHORTEST => return self.lost(place),
                    _ => length *= 0.5,
                }
            };
            let is_within = all_met(&room);
            if is_within && !self.is_beyond(&next) {
                (place, towards) = (next, along.tangent);
                length = (1.5 * length).min(LONGEST);
                continue;
            }
            if is_within {
                return self.at_goal(&next, place);
            }
            let (inside, outside) = self.bracketed(&place, along, Probe { length, place: next, room });
            if self.is_beyond(&inside) {
                return self.at_goal(&inside, place);
            }
            let cause = self.cause(&inside, &outside);
            return Way::Ends(inside, cause);
        }
        self.lost(place)
    }

    fn goal(&self) -> f64 {
        self.from + self.way
    }

    fn is_beyond(&self, place: &Place) -> bool {
        (place.at - self.goal()) * self.way >= 0.0
    }

    /// Whether a place is nearer to the goal than the last one, as it is while the orientation stays: where it is not,
    /// two folds have been passed.
    fn is_ahead(&self, last: &Place, next: &Place, room: &[f64]) -> bool {
        let is_oriented = room.last().is_some_and(|oriented| (0.0..f64::INFINITY).contains(oriented));
        !is_oriented || (next.at - last.at) * self.way > 0.0
    }

    /// The solution at the goal that continues a place beyond it.
    fn at_goal(&self, beyond: &Place, last: Place) -> Way {
        match self.curve.solution(self.goal(), beyond) {
            Some(end) => Way::Reaches(end),
            None => self.lost(last),
        }
    }

    /// The solution at the goal, if that is less than a step away.
    fn goal_within(&self, place: &Place, tangent: &Tangent, length: f64) -> Option<Place> {
        let left = (self.goal() - place.at) / self.way;
        if length * tangent[place.z.len()] < left {
            return None;
        }
        let end = self.curve.solution(self.goal(), place)?;
        let predicted = left / tangent[place.z.len()];
        (self.follows(place, &end, predicted) && self.is_within(&end)).then_some(end)
    }

    /// Where the curve is not followed any further: where a hinge force vanishes it has a kink. Where other forces grow without
    /// bound, one on which they have no influence is small only beside them, and not beside its own load.
    fn lost(&self, place: Place) -> Way {
        if ((self.goal() - place.at) / self.way).abs() <= AT_GOAL {
            return Way::Reaches(place);
        }
        let contacts = self.curve.equations.states.len();
        let hinges = (place.z.len() - 1 - contacts) / 2;
        let small = |hinge: &usize, beside: f64| place.length(contacts, *hinge) <= NO_FORCE * beside;
        let own_load = |hinge: &usize| self.load_of_hinge(&place, contacts + 2 * hinge);
        let all: Vec<usize> = (0..hinges).filter(|hinge| small(hinge, place.z.amax())).collect();
        let unloaded: Vec<usize> =
            all.iter().copied().filter(|hinge| own_load(hinge).is_none_or(|own| small(hinge, own))).collect();
        let cause = match (&unloaded[..], &all[..]) {
            ([], []) => EndCause::NotFollowed,
            ([], _) => EndCause::Singular,
            _ => EndCause::HingeUnloaded(unloaded),
        };
        Way::Ends(place, cause)
    }

    /// The load of the hinge of this row and the next at a place, homogeneous as its force is; nothing where it has none.
    fn load_of_hinge(&self, place: &Place, row: usize) -> Option<f64> {
        let instance = (self.curve.family)(place.at).ok()?;
        let load = instance.problem.load().centre();
        let own = load[(row, 0)].hypot(load[(row + 1, 0)]);
        (own > NO_FORCE * instance.unit()).then(|| place.load().abs() * own / self.curve.equations.unit)
    }

    /// Whether nothing has ended before a place of the curve.
    fn is_within(&self, place: &Place) -> bool {
        all_met(&self.room(place))
    }

    /// By how much each condition, and last the orientation, is met at a place: what has ended is below zero. Nothing
    /// is met where there is no problem.
    fn room(&self, place: &Place) -> Vec<f64> {
        let curve = self.curve;
        let Ok(instance) = (curve.family)(place.at) else { return vec![f64::NAN; self.slack.len() + 1] };
        let all = conditions(&curve.equations, &instance, place, curve.greatest);
        let rooms = all.iter().zip(&self.slack).map(|(condition, slack)| condition.value + slack);
        let oriented = if place.load() < NEAR_INFINITY {
            f64::INFINITY
        } else {
            let sign = if curve.orientation == Sign::Negative { -1.0 } else { 1.0 };
            sign * curve.equations.determinant(&instance, &place.z)
        };
        rooms.chain([oriented]).collect()
    }

    /// Neighbouring places on a step, of which the second is beyond the end: where the least of what is not met there
    /// vanishes, by the method of interpolating, truncating and projecting (Oliveira and Takahashi, 2020).
    fn bracketed(&self, start: &Place, mut along: Along, beyond: Probe) -> (Place, Place) {
        let whole = beyond.length;
        let mut inside = Probe { length: 0.0, place: start.clone(), room: self.room(start) };
        let mut outside = beyond;
        if let Some(there) = self.along(&outside.place, &along.tangent) {
            along.slope = there.slope;
        }
        for step in 0..=HALVINGS {
            let width = outside.length - inside.length;
            if width <= 2.0 * LOCATED * whole {
                break;
            }
            let reach = LOCATED * whole * 2.0_f64.powi(HALVINGS + 1 - step) - 0.5 * width;
            // Not at an end itself, to which rounding may lead: just beside it the bracket closes.
            let least = LOCATED * whole;
            let length = between(&inside, &outside, whole, reach)
                .max(inside.length + least)
                .min(outside.length - least);
            if length <= inside.length || length >= outside.length {
                break;
            }
            let share = (length - inside.length) / width;
            let mix = |one: f64, other: f64| one + share * (other - one);
            let near = Place {
                at: mix(inside.place.at, outside.place.at),
                z: inside.place.z.zip_map(&outside.place.z, mix),
            };
            let Some(place) = self.step(start, &along, length, Some(near)) else { break };
            let probe = Probe { length, room: self.room(&place), place };
            if all_met(&probe.room) {
                inside = probe;
            } else {
                outside = probe;
            }
        }
        (inside.place, outside.place)
    }

    fn cause(&self, inside: &Place, outside: &Place) -> EndCause {
        let at = |place: &Place| {
            let instance = (self.curve.family)(place.at).ok()?;
            Some(conditions(&self.curve.equations, &instance, place, self.curve.greatest))
        };
        let (Some(here), Some(beyond)) = (at(inside), at(outside)) else { return EndCause::NoProblem };
        if inside.load().abs() <= NEAR_INFINITY {
            return EndCause::Singular;
        }
        conditions::cause(&here, &beyond).unwrap_or(EndCause::Fold)
    }

    /// The place this far along a tangent: the solution on the plane across it; none if there is none nearby. To
    /// rounding if one is given that is near.
    fn step(&self, place: &Place, along: &Along, length: f64, near: Option<Place>) -> Option<Place> {
        let Along { tangent, slope } = along;
        let size = place.z.len();
        let rows = size - 1;
        let guess = Place {
            at: place.at + length * tangent[size] * self.way,
            z: &place.z + tangent.rows(0, size) * length,
        };
        let (enough, slowest) =
            if near.is_some() { (LAST, f64::INFINITY) } else { (ROUGH * length, CONTRACTION) };
        let Place { mut z, mut at } = near.unwrap_or_else(|| guess.clone());
        let mut last = f64::INFINITY;
        for _ in 0..NEWTON {
            let instance = (self.curve.family)(at).ok()?;
            let matrix = self.curve.equations.matrix(&instance, &z);
            let residual = &matrix * &z;
            let mut right = DVector::zeros(size + 1);
            right.rows_mut(0, rows).copy_from(&-residual);
            right[rows] = 1.0 - guess.z.dot(&z) / guess.z.norm();
            right[size] =
                -(tangent.rows(0, size).dot(&(&z - &guess.z)) + tangent[size] * (at - guess.at) / self.way);
            let step = bordered(&matrix, slope, &guess.z, tangent).lu().solve(&right)?;
            z += step.rows(0, size);
            at += step[size] * self.way;
            let moved = step.amax();
            if !moved.is_finite() {
                return None;
            }
            if moved <= enough || moved <= SMALL && 2.0 * moved >= last {
                let found = Place { at, z: z.normalize() };
                return self.follows(place, &found, length).then_some(found);
            }
            if moved > SMALL && moved > slowest * last {
                return None;
            }
            last = moved;
        }
        None
    }

    /// Whether a place is about where a step of this length was to lead.
    fn follows(&self, start: &Place, place: &Place, length: f64) -> bool {
        let way = (&place.z - &start.z).norm().hypot((place.at - start.at) / self.way);
        way <= (1.0 + TURN) * length && !self.turns_back(start, place)
    }

    /// Whether a hinge force has turned by more than a right angle.
    fn turns_back(&self, one: &Place, other: &Place) -> bool {
        let contacts = self.curve.equations.states.len();
        let hinges = (one.z.len() - 1 - contacts) / 2;
        let least = NO_FORCE * one.z.amax();
        (0..hinges).any(|hinge| {
            let of = |place: &Place| [0, 1].map(|axis| place.z[contacts + 2 * hinge + axis]);
            let ([x, y], [u, v]) = (of(one), of(other));
            x * u + y * v < 0.0 && x.hypot(y).max(u.hypot(v)) > least * SMALL
        })
    }

    /// The unit tangent at a place that continues a direction, with the derivative by the parameter, by differences.
    fn along(&self, place: &Place, towards: &Tangent) -> Option<Along> {
        let equations = &self.curve.equations;
        let instance = (self.curve.family)(place.at).ok()?;
        let matrix = equations.matrix(&instance, &place.z);
        let here = &matrix * &place.z;
        let slope = [DIFFERENCE, -DIFFERENCE].into_iter().find_map(|difference| {
            let beside = (self.curve.family)(place.at + difference * self.way).ok()?;
            Some((equations.matrix(&beside, &place.z) * &place.z - &here) / difference)
        })?;
        let mut right = DVector::zeros(place.z.len() + 1);
        right[place.z.len()] = 1.0;
        let tangent = bordered(&matrix, &slope, &place.z, towards).lu().solve(&right)?;
        let length = tangent.norm();
        (length.is_finite() && length > 0.0).then(|| Along { tangent: tangent / length, slope })
    }
}

fn all_met(room: &[f64]) -> bool {
    room.iter().all(|value| *value >= 0.0)
}

/// A place between two of a step, of the whole of which `whole` is the length: where the least of what is not met at the
/// second would vanish linearly, a little towards the middle, and no farther than `reach` from that.
fn between(inside: &Probe, outside: &Probe, whole: f64, reach: f64) -> f64 {
    let left = inside.room.iter().zip(&outside.room).filter(|(_, beyond)| **beyond < 0.0);
    let least = |pair: [f64; 2], (here, beyond): (&f64, &f64)| [pair[0].min(*here), pair[1].min(*beyond)];
    let [here, beyond] = left.fold([f64::INFINITY; 2], least);
    let width = outside.length - inside.length;
    let middle = inside.length + 0.5 * width;
    let estimate = inside.length + width * here / (here - beyond);
    if !estimate.is_finite() {
        return middle;
    }
    let (towards, away) = ((middle - estimate).signum(), (middle - estimate).abs());
    let shifted = (away - SHIFT / whole * width * width).max(0.0);
    middle - towards * shifted.min(reach.max(0.0))
}

/// The equations with the derivative by the parameter, and the rows of both planes.
fn bordered(
    matrix: &DMatrix<f64>,
    slope: &DVector<f64>,
    normal: &DVector<f64>,
    tangent: &Tangent,
) -> DMatrix<f64> {
    let size = normal.len();
    let mut whole = DMatrix::zeros(size + 1, size + 1);
    whole.view_mut((0, 0), (size - 1, size)).copy_from(matrix);
    whole.view_mut((0, size), (size - 1, 1)).copy_from(slope);
    whole.view_mut((size - 1, 0), (1, size)).copy_from(&(normal.transpose() / normal.norm()));
    whole.set_row(size, &tangent.transpose());
    whole
}
