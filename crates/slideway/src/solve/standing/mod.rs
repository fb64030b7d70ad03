//! What stands still while the mechanism moves: a contact that the drives keep at rest, or a hinge that never turns. Its
//! friction is free within a limit, so that the answer is a range.
//!
//! In a mode all forces are affine in the free ones `T`, `x = x_0 + sum_j T_j x_j`. The sides of the contacts, the pressure
//! that keeps guided sliders upright and the limits of contacts that stand,
//!
//! ```text
//! |T| <= mu_static |N| + F_0
//! ```
//!
//! are linear: what they leave is a polyhedron. With the force `R = R_0 + M R_1` of a hinge,
//!
//! ```text
//! |M| <= r |R|:    (r^2 R_1.R_1 - 1) M^2 + 2 r^2 R_0.R_1 M + r^2 R_0.R_0 >= 0
//! ```
//!
//! leaves at most two ranges of its couple `M`.
//!
//! # Files
//! `free.rs` has the free forces and their limits, `modes.rs` the equations and inequalities of each mode, `circle.rs` and
//! `polyhedron.rs` what satisfies them.

mod circle;
mod free;
mod modes;
pub(super) mod polyhedron;

use super::answer::{Answer, Tipped, status};
use super::attainability::not_computed;
use super::distinct::{agree, distinct};
use super::mode_problem::{does_not_slide, none_stands};
use super::resting::may_lift_off;
use super::stages::Stages;
use super::state::{Held, State, pattern, signs};
use crate::fault::{Fault, FaultKind, Faults, MOST_CONTACTS, MOST_STANDING, NoSliding};
use crate::ids::ContactId;
use crate::influence::HingeState;
use crate::kinetics::KineticEquations;
use crate::mechanism::{Mechanism, Slider};
use crate::model::SliderKind;
use crate::modes::{Certificate, ContactState, Side};
use crate::problem::TurningHinge;
use crate::report::{Continuum, CoupleRange, HeldFriction, MarginsMissing, SolveReport};
use free::Free;
use modes::{Mode, Modes};
use nalgebra::DVector;
use polyhedron::Extremes;

/// All solutions where contacts stand still while the rest moves.
///
/// # Errors
/// Too many of them, or of contacts beside them; friction in hinges, or guides that share a load, beside them; numbers
/// beyond the range of floating point.
pub(super) fn of_contacts(stages: &Stages, equations: &KineticEquations) -> Result<SolveReport, Faults> {
    check_standing(&stages.mechanism, &stages.standing)?;
    let free = free_forces(&stages.mechanism, &stages.standing);
    Standing { answer: Answer::determinate(stages, equations), stages, free }.report()
}

/// Refuses contacts that stand still beside what leaves no answer to compute: beside those at rest that may lift off, guided sliders
/// and preloads that act elsewhere than friction does.
///
/// # Errors
/// As [`of_contacts`].
pub(crate) fn check_standing(mechanism: &Mechanism, standing: &[ContactId]) -> Result<(), Faults> {
    if may_lift_off(mechanism, standing) {
        mechanism.check_determinate("how contacts at rest start")?;
        let is_refused = |id: &ContactId| {
            let contact = &mechanism.contacts[id.index()];
            let is_plain = |slider: &Slider| {
                let is_even = slider.height == 0.0 && contact.preload[0] == contact.preload[1];
                slider.kind != SliderKind::Guided && (is_even || contact.preload == [0.0; 2])
            };
            !mechanism.slider(contact.joint).is_some_and(is_plain)
        };
        let refused: Vec<ContactId> = standing.iter().copied().filter(is_refused).collect();
        if refused.is_empty() {
            return Ok(());
        }
        return Err(does_not_slide(mechanism, &refused, NoSliding::Starts));
    }
    if !standing.is_empty() {
        mechanism.check_no_one_sided("what stands still while the rest moves")?;
    }
    let is_within = free_forces(mechanism, standing).len() <= MOST_STANDING
        && mechanism.contacts.len() <= MOST_CONTACTS
        && mechanism.excess.is_empty()
        && mechanism.rough_hinges().next().is_none();
    if is_within { Ok(()) } else { none_stands(mechanism, standing) }
}

/// Refuses contacts that stand still while the rest moves, for what is not known of them.
///
/// # Errors
/// A fault that names them, if there are some.
pub(crate) fn check_none_stands(stages: &Stages, question: &'static str) -> Result<(), Faults> {
    let mechanism = &stages.mechanism;
    if may_lift_off(mechanism, &stages.standing) {
        return none_stands(mechanism, &stages.standing);
    }
    let Some(first) = stages.standing.first() else { return Ok(()) };
    let name = |contact: &ContactId| mechanism.contacts[contact.index()].name.to_string();
    let contacts = stages.standing.iter().map(name).collect();
    let joint = mechanism.contacts[first.index()].joint;
    let place = mechanism.joints[joint.index()].place.clone();
    Err(Fault::new(FaultKind::BesideStanding { question, contacts }, place).into())
}

fn free_forces(mechanism: &Mechanism, standing: &[ContactId]) -> Vec<Free> {
    standing.iter().flat_map(|contact| Free::of_contact(mechanism, *contact)).collect()
}

/// All solutions where a hinge with friction never turns, and no other has friction.
///
/// # Errors
/// Contacts that stand still while the rest moves; numbers beyond the range of floating point.
pub(super) fn of_hinge(
    stages: &Stages,
    equations: &KineticEquations,
    hinge: TurningHinge,
) -> Result<SolveReport, Faults> {
    none_stands(&stages.mechanism, &stages.standing)?;
    Standing { answer: Answer::determinate(stages, equations), stages, free: vec![Free::Hinge(hinge)] }
        .report()
}

/// A mechanism of which something stands still.
struct Standing<'a> {
    answer: Answer<'a>,
    stages: &'a Stages,
    free: Vec<Free>,
}

/// A part of a mode.
struct Part<'m> {
    mode: &'m Mode,
    extremes: Extremes,
}

/// A state with given free forces.
struct Point {
    pattern: Vec<ContactState>,
    normal_force: DVector<f64>,
    held: Vec<Held>,
    hinges: Vec<HingeState>,
}

impl Standing<'_> {
    fn report(&self) -> Result<SolveReport, Faults> {
        let contacts = self.stages.mechanism.contacts.len();
        let modes = Modes::new(self.stages, &self.free)?;
        let mut open = vec![self.not_proven()];
        open.extend(self.between_faces());
        let (always_open, mut regular) = (open.len(), Vec::new());
        for number in 0..1_usize << contacts {
            let side = |k: usize| if number >> k & 1 == 0 { Side::Positive } else { Side::Negative };
            let sides: Vec<Side> = (0..contacts).map(side).collect();
            let name = pattern(&states(&sides));
            match modes.mode(sides)? {
                Some(mode) => regular.push(mode),
                None => open.push(format!("the mode {name} is singular and was not examined")),
            }
        }
        let mut tipped = Tipped::default();
        let parts = self.parts(&regular, &mut tipped);
        let is_point =
            |part: &&Part<'_>| part.extremes.corners.len() == 1 && part.extremes.growths.is_empty();
        let (points, ranges): (Vec<&Part<'_>>, Vec<&Part<'_>>) = parts.iter().partition(is_point);
        let solutions = points.into_iter().filter_map(|part| {
            let point = self.point(part.mode, part.extremes.corners.first()?);
            let mut kept = self.answer.kept(&point.state(), &mut tipped)?;
            kept.attainability = not_computed("the friction of what stands still is free");
            Some(kept)
        });
        let solutions = distinct(solutions.collect(), &[]);
        let continua: Vec<Continuum> = ranges.into_iter().map(|part| self.continuum(part)).collect();
        Ok(SolveReport {
            status: status(open.len() > always_open, solutions.len(), 0, continua.len()),
            count: solutions.len().to_string(),
            strategy: "every mode, affine in the friction of what stands still".to_owned(),
            nodes: 1 << contacts,
            margins_missing: (!continua.is_empty()).then_some(MarginsMissing::Undetermined),
            undetermined: self.answer.undetermined(&continua),
            solutions,
            continua,
            rejected: tipped.rejected,
            ..self.answer.report_without_solutions(open)
        })
    }

    /// What satisfies all inequalities of some mode, each only once; and what would but for guided sliders that tip.
    fn parts<'m>(&self, modes: &'m [Mode], tipped: &mut Tipped) -> Vec<Part<'m>> {
        let mut parts: Vec<Part<'m>> = Vec::new();
        for mode in modes {
            let found = mode.parts(&self.free, self.stages, true);
            if found.is_empty() {
                let tipping = mode.parts(&self.free, self.stages, false);
                for corner in tipping.iter().filter_map(|part| part.corners.first()) {
                    self.answer.kept(&self.point(mode, corner).state(), tipped);
                }
            }
            for extremes in found {
                let part = Part { mode, extremes };
                if !parts.iter().any(|other| part.is_part_of(other)) {
                    parts.retain(|other| !other.is_part_of(&part));
                    parts.push(part);
                }
            }
        }
        parts
    }

    fn names(&self) -> String {
        let mechanism = &self.stages.mechanism;
        let mut names: Vec<&str> = Vec::new();
        for free in &self.free {
            let (name, _) = free.name_and_unit(mechanism);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names.join(", ")
    }

    fn not_proven(&self) -> String {
        let names = self.names();
        match self.free.as_slice() {
            [Free::Hinge(_)] => {
                format!(
                    "the ranges of the couple of {names}, which never turns, are computed in floating point"
                )
            }
            _ => format!(
                "the ranges of the friction of {names}, at rest while the rest moves, are computed in floating point"
            ),
        }
    }

    /// The contacts whose preload may rub at either face.
    fn between_faces(&self) -> Option<String> {
        let mechanism = &self.stages.mechanism;
        let jumping = (0..mechanism.contacts.len()).filter(|&k| mechanism.preload_jumps(ContactId(k)));
        let names: Vec<&str> = jumping.map(|k| &*mechanism.contacts[k].name).collect();
        let is_there = !names.is_empty();
        is_there.then(|| format!("states with {} between the faces are not examined", names.join(", ")))
    }

    fn point(&self, mode: &Mode, free: &DVector<f64>) -> Point {
        let contacts = mode.sides.len();
        let forces = mode.forces(free);
        let each = || self.free.iter().zip(free);
        let of_hinge =
            |force: &f64, free: &Free| free.hinge([forces[contacts], forces[contacts + 1]], *force);
        Point {
            pattern: states(&mode.sides),
            normal_force: forces.rows(0, contacts).into_owned(),
            held: each().filter_map(|(free, force)| free.held(*force, &mode.sides)).collect(),
            hinges: each()
                .filter(|(free, _)| matches!(free, Free::Hinge(_)))
                .filter_map(|(free, force)| of_hinge(force, free))
                .collect(),
        }
    }

    fn continuum(&self, Part { mode, extremes: Extremes { corners, growths } }: &Part<'_>) -> Continuum {
        let contacts = mode.sides.len();
        let list = |forces: DVector<f64>| forces.iter().take(contacts).map(|force| force + 0.0).collect();
        let nothing = DVector::zeros(self.free.len());
        let unknowns = |free: &DVector<f64>| self.answer.unknowns(&self.point(mode, free).state());
        let along = |start: &DVector<f64>, growth: &DVector<f64>| {
            let size = start.amax().max(1.0);
            self.answer.growth(&unknowns(start), &unknowns(&(start + growth * size)), size)
        };
        let start = corners.first();
        Continuum {
            pattern: pattern(&states(&mode.sides)),
            rests: false,
            vertices: corners.iter().map(|corner| list(mode.forces(corner))).collect(),
            directions: growths
                .iter()
                .map(|growth| list(mode.forces(growth) - mode.forces(&nothing)))
                .collect(),
            motion: corners.iter().map(|corner| self.answer.driven_motion(&unknowns(corner))).collect(),
            motion_along: start
                .map_or_else(Vec::new, |start| growths.iter().map(|growth| along(start, growth)).collect()),
            tipping: Vec::new(),
            couple: match self.free.as_slice() {
                [Free::Hinge(_)] => Some(CoupleRange {
                    hinge: self.names(),
                    couples: corners.iter().map(|corner| corner[0]).collect(),
                }),
                _ => None,
            },
            held: self.held(corners, growths),
        }
    }

    /// The friction of each contact or hinge that stands, at the corners and along the growths.
    fn held(&self, corners: &[DVector<f64>], growths: &[DVector<f64>]) -> Vec<HeldFriction> {
        let mechanism = &self.stages.mechanism;
        let mut all: Vec<HeldFriction> = Vec::new();
        for (index, free) in self.free.iter().enumerate() {
            let (name, unit) = free.name_and_unit(mechanism);
            let part = |forces: &[DVector<f64>]| -> Vec<f64> {
                forces.iter().map(|force| force[index] + 0.0).collect()
            };
            let (at, along) = (part(corners), part(growths));
            match all.last_mut().filter(|last| last.name == name) {
                // At the face and in the middle.
                Some(last) => {
                    last.at.iter_mut().zip(at).for_each(|(sum, force)| *sum += force);
                    last.along.iter_mut().zip(along).for_each(|(sum, force)| *sum += force);
                }
                None => all.push(HeldFriction { name: name.to_owned(), unit, at, along }),
            }
        }
        all
    }
}

impl Part<'_> {
    /// Whether another part has all of its states.
    fn is_part_of(&self, other: &Self) -> bool {
        let nothing = DVector::zeros(self.extremes.corners.first().map_or(0, DVector::len));
        let agree_at = |free: &DVector<f64>| {
            agree(self.mode.forces(free).as_slice(), other.mode.forces(free).as_slice())
        };
        let grows = |mode: &Mode, growth: &DVector<f64>| mode.forces(growth) - mode.forces(&nothing);
        let agree_along = |growth: &DVector<f64>| {
            agree(grows(self.mode, growth).as_slice(), grows(other.mode, growth).as_slice())
        };
        !self.extremes.corners.is_empty()
            && other.mode.contains(&self.extremes)
            && self.extremes.corners.iter().all(agree_at)
            && self.extremes.growths.iter().all(agree_along)
    }
}

impl Point {
    fn state(&self) -> State<'_> {
        let on_boundary: Vec<bool> = self.normal_force.iter().map(|force| *force == 0.0).collect();
        let sign = |(sign, is_zero): (i8, &bool)| if *is_zero { 0 } else { sign };
        State {
            pattern: &self.pattern,
            patterns: vec![pattern(&self.pattern)],
            normal_force: &self.normal_force,
            shares: vec![None; self.pattern.len()],
            signs: signs(&self.pattern).into_iter().zip(&on_boundary).map(sign).collect(),
            on_boundary: on_boundary.contains(&true),
            determinant: 0.0,
            certificate: &Certificate::NotProven,
            hinges: &self.hinges,
            held: &self.held,
        }
    }
}

fn states(sides: &[Side]) -> Vec<ContactState> {
    sides.iter().map(|side| ContactState::from(*side)).collect()
}
