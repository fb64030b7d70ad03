//! Continua of solutions: the part in which no guided slider tips, and between which values forces and motion lie.

use super::answer::Answer;
use super::distinct::SAME_STATE;
use super::state::{State, pattern, signs};
use crate::ids::ContactId;
use crate::kinetics::Reaction;
use crate::law::COUPLE_TOLERANCE;
use crate::mechanism::Coordinate;
use crate::modes::{ContactState, SingularMode, SolutionSet};
use crate::report::{Continuum, DrivenMotion, OpenRange, Undetermined};
use nalgebra::DVector;

/// A part of a continuum that is shorter than this multiple of it is a point within the tolerance.
const POINT: f64 = 1e-6;

impl Answer<'_> {
    /// A singular mode as it is told; none if it has no continuum.
    pub(super) fn continuum(&self, mode: &SingularMode) -> Option<Continuum> {
        let forces = |vector: &DVector<f64>| {
            self.mechanism.forces_at_faces(&mode.pattern, vector.iter().copied().collect())
        };
        let list = |vectors: Vec<&DVector<f64>>| vectors.into_iter().map(forces).collect();
        let (vertices, directions) = (mode.set.vertices(), mode.set.directions());
        // The shares of a preload between its faces are not those of the normal forces alone.
        let is_told = |(k, state): (usize, &ContactState)| {
            *state != ContactState::Gap || !self.mechanism.preload_jumps(ContactId(k))
        };
        let told = mode.pattern.iter().enumerate().all(is_told);
        let start = vertices.first().filter(|_| told).copied();
        let motion = start.map_or_else(Vec::new, |_| {
            vertices.iter().map(|vertex| self.driven_motion(&self.unknowns_at(mode, vertex))).collect()
        });
        let along = |start: &DVector<f64>, direction: &DVector<f64>| {
            let size = start.amax().max(1.0);
            let end = start + direction * size;
            self.growth(&self.unknowns_at(mode, start), &self.unknowns_at(mode, &end), size)
        };
        mode.set.is_continuum().then(|| Continuum {
            pattern: pattern(&mode.pattern),
            rests: false,
            motion,
            motion_along: start.map_or_else(Vec::new, |start| {
                directions.iter().map(|direction| along(start, direction)).collect()
            }),
            vertices: list(vertices),
            directions: list(directions),
            tipping: self.tipping_in(mode),
            couple: None,
            held: Vec::new(),
        })
    }

    /// What so much of a direction adds to the motion, by the unknowns at its beginning and its end.
    pub(super) fn growth(&self, start: &DVector<f64>, end: &DVector<f64>, size: f64) -> DrivenMotion {
        let change = (end - start) / size;
        let rounding = SAME_STATE * change.amax();
        self.driven_motion(&change.map(|part| if part.abs() <= rounding { 0.0 } else { part }))
    }

    /// All unknowns at a point of a continuum.
    fn unknowns_at(&self, mode: &SingularMode, normal_force: &DVector<f64>) -> DVector<f64> {
        self.influence.unknowns(&self.friction(&vertex(mode, normal_force)), normal_force)
    }

    /// The efforts and accelerations among all unknowns.
    pub(super) fn driven_motion(&self, unknowns: &DVector<f64>) -> DrivenMotion {
        DrivenMotion {
            efforts: self.drives(unknowns).into_iter().map(|drive| drive.effort + 0.0).collect(),
            accelerations: self.equations.coordinate_accelerations(unknowns),
        }
    }

    /// Between which values the forces and the motion of continua lie; none if that is not known of one of them.
    pub(super) fn undetermined(&self, continua: &[Continuum]) -> Option<Undetermined> {
        let is_known = |continuum: &Continuum| !continuum.motion.is_empty();
        if continua.is_empty() || !continua.iter().all(is_known) {
            return None;
        }
        let ranges = |names: Vec<(String, &'static str)>, at: &Values<'_>, along: &Values<'_>| {
            let each = |(index, (name, unit))| {
                let values = |of: &Values<'_>| -> Vec<f64> {
                    continua.iter().flat_map(|one| of(one, index)).collect()
                };
                range((name, unit), &values(at), &values(along))
            };
            names.into_iter().enumerate().map(each).collect::<Vec<OpenRange>>()
        };
        let motion = |all: &[DrivenMotion], of: fn(&DrivenMotion) -> &[f64], index: usize| -> Vec<f64> {
            all.iter().map(|one| of(one)[index]).collect()
        };
        let list = |all: &[Vec<f64>], index: usize| all.iter().map(|one| one[index]).collect();
        let efforts: fn(&DrivenMotion) -> &[f64] = |motion| &motion.efforts;
        let accelerations: fn(&DrivenMotion) -> &[f64] = |motion| &motion.accelerations;
        let contacts = self.mechanism.contacts.iter().map(|contact| (contact.name.to_string(), "N"));
        let normal_forces =
            ranges(contacts.collect(), &|one, index| list(&one.vertices, index), &|one, index| {
                list(&one.directions, index)
            });
        let mut sharing: Vec<String> = Vec::new();
        for (k, contact) in self.mechanism.contacts.iter().enumerate() {
            let joint = &self.mechanism.joints[contact.joint.index()].name;
            let is_open = self.mechanism.excess.shares(ContactId(k)) && !normal_forces[k].is_one_value();
            if is_open && !sharing.iter().any(|name| *name == **joint) {
                sharing.push(joint.to_string());
            }
        }
        let acceleration = |coordinate: &Coordinate| {
            let unit = if coordinate.kind.is_angle() { "rad/s^2" } else { "m/s^2" };
            (coordinate.name.to_string(), unit)
        };
        let held: Vec<(String, &'static str)> = continua.first().map_or_else(Vec::new, |one| {
            one.held.iter().map(|held| (held.name.clone(), held.unit)).collect()
        });
        Some(Undetermined {
            sharing,
            friction: ranges(held, &|one, index| one.held[index].at.clone(), &|one, index| {
                one.held[index].along.clone()
            }),
            efforts: ranges(
                self.mechanism
                    .drives
                    .iter()
                    .map(|drive| (drive.name.to_string(), drive.effort.unit()))
                    .collect(),
                &|one, index| motion(&one.motion, efforts, index),
                &|one, index| motion(&one.motion_along, efforts, index),
            ),
            accelerations: ranges(
                self.mechanism.coordinates.iter().map(acceleration).collect(),
                &|one, index| motion(&one.motion, accelerations, index),
                &|one, index| motion(&one.motion_along, accelerations, index),
            ),
            normal_forces,
        })
    }

    /// A singular mode with its continuum cut to where |C| <= |N| L / 2 holds for every guided slider.
    ///
    /// In one mode the sign of N is fixed and everything is affine, so that both bounds on C cut a segment or
    /// ray at one point each. Continua of more dimensions are left as they are; see [`Self::tipping_in`].
    pub(super) fn without_tipping(&self, mode: &SingularMode) -> SingularMode {
        let (from, step, end) = match &mode.set {
            SolutionSet::Segment { from, to } => (from, to - from, 1.0),
            SolutionSet::Ray { from, direction } => {
                (from, direction * from.amax().max(direction.amax()), f64::INFINITY)
            }
            _ => return mode.clone(),
        };
        let (first, last) = self.slack_interval(mode, from, &step, end);
        if (first, last) == (0.0, end) {
            return mode.clone();
        }
        let at = |t: f64| from + &step * t;
        let set = if first > last {
            SolutionSet::Empty
        } else if last - first <= POINT {
            SolutionSet::Point(at(first))
        } else if last.is_infinite() {
            SolutionSet::Ray { from: at(first), direction: &step / step.amax() }
        } else {
            SolutionSet::Segment { from: at(first), to: at(last) }
        };
        let mut clipped = mode.clone();
        clipped.set = set;
        clipped.contains.clear();
        clipped
    }

    /// The values of t from 0 to `end` for which no couple at `from + t step` exceeds its limit; empty if the
    /// first is greater than the last.
    fn slack_interval(
        &self,
        mode: &SingularMode,
        from: &DVector<f64>,
        step: &DVector<f64>,
        end: f64,
    ) -> (f64, f64) {
        let (slack, next) = (self.slack(mode, from), self.slack(mode, &(from + step)));
        let scale = slack.iter().chain(&next).map(|slack| slack.abs()).fold(0.0, f64::max);
        let (mut first, mut last) = (0.0_f64, end);
        for (at_start, at_next) in slack.iter().zip(&next) {
            let (value, slope) = (at_start + COUPLE_TOLERANCE * scale, at_next - at_start);
            if slope.abs() <= COUPLE_TOLERANCE * scale {
                if value < 0.0 {
                    return (1.0, 0.0);
                }
            } else if slope > 0.0 {
                first = first.max(-value / slope);
            } else {
                last = last.min(-value / slope);
            }
        }
        (first, last)
    }

    /// What is left of the couple of each guided slider in both directions, |N| L / 2 - C and |N| L / 2 + C.
    fn slack(&self, mode: &SingularMode, normal_force: &DVector<f64>) -> Vec<f64> {
        let state = vertex(mode, normal_force);
        let unknowns = self.unknowns_at(mode, normal_force);
        let both = |(joint, slider): (_, &crate::mechanism::Slider)| {
            let contact = slider.contacts[0].index();
            let limit = state.pattern[contact].sign() * normal_force[contact] * slider.greatest_couple(1.0);
            let index = self.influence.layout().reaction(Reaction::Couple(joint));
            let couple = index.map_or(0.0, |index| unknowns[index]);
            [limit - couple, limit + couple]
        };
        self.guided_sliders().flat_map(both).collect()
    }

    /// The guided sliders that would tip at some vertex of a continuum of more dimensions than one.
    pub(super) fn tipping_in(&self, mode: &SingularMode) -> Vec<String> {
        if !matches!(mode.set, SolutionSet::Polytope { .. }) {
            return Vec::new();
        }
        let rejected = mode.set.vertices().into_iter().filter_map(|point| self.tipping_at(mode, point));
        let mut names: Vec<String> = rejected.map(|rejection| rejection.joint).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// The guided slider that would tip at a point of a continuum.
    pub(super) fn tipping_at(
        &self,
        mode: &SingularMode,
        normal_force: &DVector<f64>,
    ) -> Option<crate::report::Rejection> {
        self.tipping(&vertex(mode, normal_force), &self.unknowns_at(mode, normal_force))
    }
}

/// A quantity of a continuum at its vertices or along its directions.
type Values<'a> = dyn Fn(&Continuum, usize) -> Vec<f64> + 'a;

/// From the least to the greatest of the values at vertices, without bound where it grows along a direction.
fn range((name, unit): (String, &'static str), at: &[f64], along: &[f64]) -> OpenRange {
    let [least, greatest] = at.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], value| {
        [least.min(*value), greatest.max(*value)]
    });
    // Values that differ by rounding alone are one.
    let one = greatest - least <= SAME_STATE * least.abs().max(greatest.abs());
    let [least, greatest] = if one { [f64::midpoint(least, greatest) + 0.0; 2] } else { [least, greatest] };
    let is_bounded = |sense: f64| along.iter().all(|growth| sense * growth <= 0.0);
    OpenRange { name, unit, from: is_bounded(-1.0).then_some(least), to: is_bounded(1.0).then_some(greatest) }
}

/// A point of a continuum as a state.
fn vertex<'s>(mode: &'s SingularMode, normal_force: &'s DVector<f64>) -> State<'s> {
    State {
        pattern: &mode.pattern,
        patterns: Vec::new(),
        normal_force,
        shares: vec![None; mode.pattern.len()],
        signs: signs(&mode.pattern),
        on_boundary: false,
        determinant: 0.0,
        certificate: &mode.certificate,
        hinges: &[],
        held: &[],
    }
}
