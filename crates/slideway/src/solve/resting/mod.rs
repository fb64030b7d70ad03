//! Contacts that may lift off and do not slide at the start (theory, section 12): each joint of them sticks, begins to slide
//! one way or the other, or lifts off, a block with one corner or with both. What else is at rest beside them sticks or begins to
//! slide, pressed on either side.
//!
//! With all contacts closed the unknowns of the kinetic equations are affine in the forces. For a pattern of states
//!
//! ```text
//! x = x_0 + sum_k z_k x_k + sum_j T_j t_j        z_k: |N_k| where closed, the acceleration of the gap where open
//! N_k(x) = sigma_k z_k closed, 0 open            v_j'(x) = 0 of joints that stick
//! z_k >= 0       |T_j| <= sum_k mu_static_k z_k  of joints that stick       s_j v_j'(x) >= 0 of joints that slip
//! ```
//!
//! is one system of linear equations, and all patterns are tried: four for a corner at rest, ten for a block, three for each choice
//! of sides of a joint with two faces, two for each contact that slides. Where the equations leave forces open, what the inequalities leave is a polyhedron. As a
//! mode problem (`absolute.rs`), which a proof file proves, they have patterns beside that no state has; the native states also have
//! static friction above kinetic.

mod absolute;
mod elastic;
mod jam;
mod patterns;

use super::answer::{Answer, Tipped, joint_modes, status};
use super::attainability::{Closed, NOT_DRIVEN, not_computed};
use super::distinct::distinct;
use super::mode_problem::ProblemData;
use super::stages::Stages;
use super::standing::check_standing;
use super::standing::polyhedron::{Extremes, Polyhedron};
use super::state::{Held, State, pattern, signs};
use crate::enclosure::UncertainParameters;
use crate::fault::Faults;
use crate::ids::{ContactId, JointId};
use crate::influence::{ContactFriction, Influence};
use crate::kinetics::{KineticEquations, SlidingRow};
use crate::mechanism::{Contact, Mechanism, Slider};
use crate::model::Model;
use crate::modes::{Certificate, ContactState, SearchOptions};
use crate::pattern::{Affine, AffineSet, sliding_in_words, sticking_in_words};
use crate::progress::Callback;
use crate::report::{
    Attainability, Continuum, DrivenMotion, HeldFriction, JointMode, Proof, Solution, SolveReport,
    SpeedChange, Verdict,
};
pub(super) use absolute::mode_problem as mode_problem_at_rest;
pub(super) use jam::impulses as jam_impulses;
use nalgebra::DVector;
use patterns::{Stuck, System, face_of};
use std::cell::OnceCell;

/// Inequalities that are missed by this part of the greatest force or acceleration count as satisfied.
const TOLERANCE: f64 = 1e-9;
/// More patterns of states are refused.
const MOST_PATTERNS: u64 = 100_000;

/// A joint that does not slide at the start.
struct RestingJoint {
    joint: JointId,
    contacts: Vec<usize>,
    row: SlidingRow,
    /// Its rate without any unknown: part of the velocities in its acceleration; in a jam the velocity before the impulse.
    before: f64,
}

impl RestingJoint {
    /// Its rate with these unknowns: the acceleration of sliding, in a jam the velocity afterwards.
    fn rate(&self, unknowns: &DVector<f64>) -> f64 {
        self.before + self.row.change(unknowns)
    }
}

/// What a joint at rest does that touches.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Start {
    Sticks,
    Slips(f64),
}

/// What all contacts and all joints at rest do; none of a joint that lifts off as a whole.
#[derive(Clone)]
struct Pattern {
    states: Vec<ContactState>,
    starts: Vec<Option<Start>>,
}

/// The joints of which one of these contacts is a part; `before` has the rate of each without any unknown.
fn joints_of(
    Stages { mechanism, configuration, .. }: &Stages,
    contacts: &[ContactId],
    before: impl Fn(&SlidingRow, ContactId) -> f64,
) -> Vec<RestingJoint> {
    let of_joint = |(joint, slider): (JointId, &Slider)| {
        let first = *slider.contacts.iter().find(|contact| contacts.contains(contact))?;
        let row = SlidingRow::new(mechanism, configuration, slider);
        Some(RestingJoint {
            joint,
            before: before(&row, first),
            row,
            contacts: slider.contacts.iter().map(|contact| contact.index()).collect(),
        })
    };
    mechanism.sliders().filter_map(of_joint).collect()
}

/// Returns whether contacts that may lift off are among those that do not slide.
pub(super) fn may_lift_off(mechanism: &Mechanism, standing: &[ContactId]) -> bool {
    standing.iter().any(|contact| mechanism.contacts[contact.index()].opens)
}

/// All states of a mechanism of which contacts that may lift off do not slide at the start; proven, where that is asked for and their
/// forces are determined.
///
/// # Errors
/// Guided sliders or preloads among what stands still, guides that share a load, more patterns of states than are tried.
pub(super) fn of_contacts(
    (model, proven): (&Model, Option<&UncertainParameters>),
    (stages, equations): (&Stages, &KineticEquations),
    options: &SearchOptions,
    progress: &mut Callback<'_>,
) -> Result<SolveReport, Faults> {
    check_standing(&stages.mechanism, &stages.standing)?;
    let joints = joints_of(stages, &stages.standing, |row, _| row.of_velocities());
    let force = greatest_force(&stages.influence);
    let answer = Answer::determinate(stages, equations);
    let resting = Resting::new(&answer, joints, force);
    let mut report = resting.report()?;
    if report.continua.is_empty()
        && let Some(uncertain) = proven
        && resting.are_all(&report.solutions, (model, uncertain), options, progress)
    {
        report.complete = Proof::Proven;
        report.open.clear();
    }
    Ok(report)
}

/// The greatest normal force with all contacts closed and without friction, or 1 N.
fn greatest_force(influence: &Influence) -> f64 {
    let greatest = influence.normal_forces().amax();
    if greatest > 0.0 { greatest } else { 1.0 }
}

/// A mechanism of which some joints are at rest.
pub(super) struct Resting<'a> {
    answer: &'a Answer<'a>,
    joints: Vec<RestingJoint>,
    /// The mechanism without friction, where it is asked for.
    smooth: OnceCell<Mechanism>,
    /// The unit of forces (N), in a jam of impulses (N s).
    force: f64,
}

/// A point of what a pattern leaves.
struct Point {
    pattern: Pattern,
    normal_force: DVector<f64>,
    held: Vec<Held>,
    signs: Vec<i8>,
    /// The oriented determinant of its pattern; 0 where it is not known or not asked for.
    oriented: f64,
}

/// Steps of refinement of the forces of a pattern.
const REFINEMENTS: usize = 2;

impl<'a> Resting<'a> {
    fn new(answer: &'a Answer<'a>, joints: Vec<RestingJoint>, force: f64) -> Self {
        Self { answer, joints, smooth: OnceCell::new(), force }
    }

    /// The normal forces of a state of a mechanism of which no joint is at rest, refined where contacts lift off.
    pub(super) fn refined_forces(
        answer: &'a Answer<'a>,
        states: &[ContactState],
        normal_force: &DVector<f64>,
    ) -> DVector<f64> {
        if !answer.can_be_refined(states) {
            return normal_force.clone();
        }
        let pattern = Pattern { states: states.to_vec(), starts: Vec::new() };
        let sliding = Self::new(answer, Vec::new(), greatest_force(answer.influence));
        let forces = sliding.refined(&sliding.system(pattern, answer.mechanism), normal_force.abs());
        DVector::from_fn(forces.len(), |k, _| states[k].sign() * forces[k])
    }

    /// The unknowns of a pattern after some steps of iterative refinement, where contacts lift off: what great forces of closed
    /// contacts leave where they cancel is known from the equations themselves, not from the influences.
    fn refined(&self, system: &System, mut unknowns: DVector<f64>) -> DVector<f64> {
        let states = &system.pattern.states;
        if !self.answer.can_be_refined(states) {
            return unknowns;
        }
        let factors = self.matrix(system).lu();
        for _ in 0..REFINEMENTS {
            let all = self.answer.refined(&self.at_above(0.0, system, &unknowns).state());
            let left = DVector::from_fn(unknowns.len(), |row, _| match row.checked_sub(states.len()) {
                None if self.is_open(&system.pattern, row) => all[self.place(row)] / self.force,
                None => (all[self.place(row)] - states[row].sign() * unknowns[row]) / self.force,
                Some(stuck) => match system.sticking[stuck] {
                    Stuck { joint, is_first: true, .. } => {
                        self.joints[joint].rate(&all) / self.acceleration(joint)
                    }
                    Stuck { .. } => 0.0,
                },
            });
            let Some(step) = factors.solve(&left) else { break };
            unknowns -= step * self.force;
        }
        unknowns
    }

    fn report(&self) -> Result<SolveReport, Faults> {
        let all = self.patterns(MOST_PATTERNS)?;
        let open = vec![format!(
            "the states of {}, at rest at the start, are computed in floating point",
            self.names()
        )];
        let (mut found, mut continua, mut tipped) = (Vec::new(), Vec::new(), Tipped::default());
        let nodes = all.len() as u64;
        let mut every_load_has_one_state = self.may_be_unique().then_some(true);
        for pattern in all {
            let system = self.system(pattern, self.answer.mechanism);
            every_load_has_one_state = every_load_has_one_state
                .and_then(|all| Some(all && self.oriented(&system).map(|oriented| oriented > 0.0)?));
            let Some(set) = self.equations(&system) else { continue };
            if set.dimension() == 0 {
                let unknowns = set.particular() * self.force;
                if let Some((least, begins)) = self.least_slack(&unknowns, &self.slacks(&system, &set)) {
                    let point = self.point(&system, &self.refined(&system, unknowns));
                    let solution = self.solution(&point, &mut tipped);
                    found.extend(solution.map(|solution| (solution, least, begins)));
                }
            } else {
                continua.extend(self.continuum(&system, &set));
            }
        }
        // What begins within rounding is an end of states of rest, where there are such.
        let begins = found.into_iter().filter(|(.., begins)| *begins || continua.is_empty());
        let solutions: Vec<(Solution, f64)> = begins.map(|(solution, least, _)| (solution, least)).collect();
        let solutions = distinct(self.without_bounds(&solutions), &[]);
        Ok(SolveReport {
            status: status(false, solutions.len(), 0, continua.len()),
            complete: Proof::NotProven,
            count: solutions.len().to_string(),
            strategy: "every state of the contacts at rest".to_owned(),
            nodes,
            undetermined: self.answer.undetermined(&continua),
            at_rest: self.joints.iter().map(|joint| self.name(joint).to_owned()).collect(),
            every_load_has_one_state,
            solutions,
            continua,
            rejected: tipped.rejected,
            ..self.answer.report_without_solutions(open)
        })
    }

    /// Solutions with their least slacks, without those that miss an inequality by rounding where another one, which has the
    /// same forces to ten times that, misses less: about the end of one state both hold within the tolerance.
    fn without_bounds(&self, solutions: &[(Solution, f64)]) -> Vec<Solution> {
        let forces = |solution: &Solution| -> Vec<f64> {
            solution
                .contacts
                .iter()
                .flat_map(|contact| [contact.normal_force, contact.friction_force])
                .collect()
        };
        let is_same = |one: &Solution, other: &Solution| {
            let (one, other) = (forces(one), forces(other));
            let scale = one.iter().chain(&other).map(|force| force.abs()).fold(self.force, f64::max);
            one.iter().zip(&other).all(|(one, other)| (one - other).abs() <= 10.0 * TOLERANCE * scale)
        };
        let is_kept = |(index, (solution, least)): &(usize, &(Solution, f64))| {
            let beside = |(number, (other, slack)): (usize, &(Solution, f64))| {
                (*slack > *least || *slack == *least && number < *index) && is_same(solution, other)
            };
            *least >= 0.0 || !solutions.iter().enumerate().any(beside)
        };
        solutions.iter().enumerate().filter(is_kept).map(|(_, (solution, _))| solution.clone()).collect()
    }

    fn name(&self, joint: &RestingJoint) -> &str {
        &self.answer.mechanism.joints[joint.joint.index()].name
    }

    fn names(&self) -> String {
        self.joints.iter().map(|joint| self.name(joint)).collect::<Vec<_>>().join(", ")
    }

    /// The least slack of the inequalities of a pattern that has one point, in the units in which they count; none if one is
    /// missed. What begins does so at any rate, since sticking may be missed by rounding only; within that it misses what tells
    /// it from rest, and the second value is false.
    fn least_slack(
        &self,
        unknowns: &DVector<f64>,
        [beginning, slacks]: &[Vec<Affine>; 2],
    ) -> Option<(f64, bool)> {
        let rounding = TOLERANCE * unknowns.amax().max(self.force) / self.force;
        let begins = beginning.iter().map(|slack| slack.constant).fold(f64::INFINITY, f64::min);
        let least = slacks.iter().map(|slack| slack.constant).fold(f64::INFINITY, f64::min);
        let is_told = begins > rounding;
        let least = if is_told { least } else { least.min(begins - rounding) };
        (begins > 0.0 && least >= -rounding).then_some((least, is_told))
    }

    /// The state of the contacts with these unknowns, with the oriented determinant.
    fn point(&self, system: &System, unknowns: &DVector<f64>) -> Point {
        Point { oriented: self.oriented(system).unwrap_or(0.0), ..self.at(system, unknowns) }
    }

    /// The state of the contacts with these unknowns. Forces that are rounding are none.
    fn at(&self, system: &System, unknowns: &DVector<f64>) -> Point {
        self.at_above(TOLERANCE * unknowns.amax().max(self.force), system, unknowns)
    }

    /// The state of the contacts with these unknowns. Forces up to `nothing` are none.
    fn at_above(&self, nothing: f64, system: &System, unknowns: &DVector<f64>) -> Point {
        let mechanism = self.answer.mechanism;
        let Pattern { states, starts } = &system.pattern;
        let contacts = states.len();
        let force = |k: usize| if unknowns[k].abs() <= nothing { 0.0 } else { unknowns[k] };
        let mut held = Vec::new();
        for (index, (joint, start)) in self.joints.iter().zip(starts).enumerate() {
            for &k in joint.contacts.iter().filter(|&&k| !self.is_open(&system.pattern, k)) {
                let Contact { mu, preload, .. } = &mechanism.contacts[k];
                let face = face_of(states[k]);
                let friction = match start {
                    Some(Start::Slips(sign)) => sign * (mu[face] * force(k) + preload[face]),
                    Some(Start::Sticks) => {
                        let of_joint = |stuck: &Stuck| stuck.joint == index && stuck.contacts.contains(&k);
                        let unknown = system.sticking.iter().position(of_joint);
                        unknown.map_or(0.0, |unknown| {
                            let limit = |&k: &usize| self.limit(&system.pattern, k, force(k));
                            let all: f64 = system.sticking[unknown].contacts.iter().map(limit).sum();
                            let whole = unknowns[contacts + unknown];
                            if all > 0.0 { whole * limit(&k) / all } else { 0.0 }
                        })
                    }
                    None => 0.0,
                };
                let mut faces = [0.0; 2];
                faces[face] = friction;
                let [positive_face, negative_face] = faces;
                held.push(Held { contact: k, friction: ContactFriction { positive_face, negative_face } });
            }
        }
        let sign = |(k, sign): (usize, i8)| if force(k) == 0.0 { 0 } else { sign };
        Point {
            normal_force: DVector::from_fn(contacts, |k, _| states[k].sign() * force(k)),
            signs: signs(states).into_iter().enumerate().map(sign).collect(),
            held,
            oriented: 0.0,
            pattern: system.pattern.clone(),
        }
    }

    fn solution(&self, point: &Point, tipped: &mut Tipped) -> Option<Solution> {
        let mut kept = self.answer.kept(&point.state(), tipped)?;
        kept.attainability = self.attainability(point);
        kept.joints = self.words(point);
        self.tell_speeds(&mut kept);
        let accelerations: Vec<f64> = kept.coordinates.iter().map(|one| one.acceleration).collect();
        kept.rests = self.stands(&point.pattern) && self.rest(&accelerations);
        Some(kept)
    }

    /// Returns whether in a pattern every joint of the mechanism that friction may hold sticks, and no contact opens.
    fn stands(&self, pattern: &Pattern) -> bool {
        let mechanism = self.answer.mechanism;
        let may_hold = |contact: &ContactId| mechanism.contacts[contact.index()].may_hold();
        let held = mechanism.sliders().filter(|(_, slider)| slider.contacts.iter().any(may_hold));
        let joints: Vec<JointId> = self.joints.iter().map(|joint| joint.joint).collect();
        held.map(|(joint, _)| joint).all(|joint| joints.contains(&joint))
            && pattern.starts.iter().all(|start| *start == Some(Start::Sticks))
            && !(0..pattern.states.len()).any(|k| self.is_open(pattern, k))
    }

    /// The acceleration of a coordinate without its rounding.
    fn without_rounding(&self, acceleration: f64, is_angle: bool) -> f64 {
        let Mechanism { bodies, size, .. } = self.answer.mechanism;
        let masses = bodies.iter().map(|body| body.mass).filter(|mass| *mass > 0.0);
        let rounding = TOLERANCE * self.force / masses.min_by(f64::total_cmp).unwrap_or(1.0);
        let rounding = if is_angle { rounding / size } else { rounding };
        if acceleration.abs() <= rounding { 0.0 } else { acceleration }
    }

    /// Returns whether no coordinate with these accelerations moves or begins to move, nor a drive moves one.
    fn rest(&self, accelerations: &[f64]) -> bool {
        let mechanism = self.answer.mechanism;
        let rests = |(index, acceleration): (usize, &f64)| {
            let coordinate = &mechanism.coordinates[index];
            let told = self.without_rounding(*acceleration, coordinate.kind.is_angle());
            mechanism.is_free(index) && [coordinate.rate, told] == [0.0; 2]
        };
        accelerations.iter().enumerate().all(rests)
    }

    /// Tells what becomes of the coordinates at rest from their accelerations, which have no bounds here. Where contacts lift off
    /// the motion is not that of the coordinates alone.
    fn tell_speeds(&self, solution: &mut Solution) {
        let opens = solution.contacts.iter().any(|contact| contact.gap_acceleration.is_some());
        for (one, coordinate) in solution.coordinates.iter_mut().zip(&self.answer.mechanism.coordinates) {
            if one.speed != Some(SpeedChange::MayStart) {
                continue;
            }
            let told = self.without_rounding(one.acceleration, coordinate.kind.is_angle());
            let speed = SpeedChange::of(0.0, Some([told; 2]));
            one.speed = (!opens || speed != SpeedChange::StaysAtRest).then_some(speed);
        }
    }

    /// Judges whether a state persists if contacts are slightly elastic, where they are closed along n, and along u where they stick:
    /// not where the oriented determinant is negative, which an odd number of unstable motions is. Springs alone are stable.
    fn attainability(&self, point: &Point) -> Attainability {
        let Answer { mechanism, configuration, influence, .. } = *self.answer;
        let (signs, states) = (self.signs(&point.pattern), &point.pattern.states);
        let open: Vec<usize> = (0..states.len()).filter(|&k| self.is_open(&point.pattern, k)).collect();
        let is_closed = |k: &usize| !open.contains(k);
        let rubs = |k: usize| signs[k] != 0.0 && mechanism.contacts[k].may_hold();
        let sticks = point.pattern.starts.contains(&Some(Start::Sticks));
        let told =
            |verdict| Attainability { reason: None, ..Attainability::without_eigenvalues(verdict, "") };
        if point.signs.contains(&0) {
            not_computed("a contact is about to open or to touch")
        } else if point.oriented < 0.0 {
            told(Verdict::Unattainable)
        } else if mechanism.drives.is_empty() && !(0..states.len()).filter(is_closed).any(rubs) {
            told(Verdict::Attainable)
        } else if sticks {
            self.with_springs(point)
        } else {
            let data = ProblemData { mechanism, influence, velocity_signs: &signs };
            let closed = Closed::new(data, (configuration, self.answer.equations), &open);
            closed.map_or_else(|_| not_computed(NOT_DRIVEN), |closed| told(closed.verdict_on(states)))
        }
    }

    /// What each sliding joint does, those at rest with how they start.
    fn words(&self, point: &Point) -> Vec<JointMode> {
        let Answer { mechanism, configuration, .. } = *self.answer;
        let mut modes = joint_modes(mechanism, configuration, &point.signs);
        for (joint, start) in self.joints.iter().zip(&point.pattern.starts) {
            let name = self.name(joint);
            let Some(mode) = modes.iter_mut().find(|mode| mode.name == name) else { continue };
            match (start, mechanism.slider(joint.joint)) {
                (Some(Start::Slips(sign)), Some(slider)) => {
                    let slip = if *sign < 0.0 { -1 } else { 1 };
                    mode.slides(slip, &sliding_in_words(mechanism, configuration, slider, slip));
                }
                (Some(Start::Sticks), Some(slider)) => mode.sticks(sticking_in_words(slider)),
                _ => {}
            }
        }
        modes
    }

    /// What the inequalities of a pattern leave of forces that its equations leave open.
    fn continuum(&self, system: &System, set: &AffineSet) -> Option<Continuum> {
        let [beginning, slacks] = self.slacks(system, set);
        let row = |slack: &Affine| {
            DVector::from_iterator(
                1 + slack.coefficients.len(),
                std::iter::once(slack.constant).chain(slack.coefficients.iter().copied()),
            )
        };
        let Extremes { corners, growths } =
            Polyhedron::new(set.dimension(), slacks.iter().chain(&beginning).map(row)).extremes();
        let begins = |slack: &Affine| {
            let at = corners.iter().map(|corner| slack.at(corner.as_slice()));
            let along = growths.iter().map(|growth| slack.at(growth.as_slice()) - slack.constant);
            at.chain(along).any(|value| value > TOLERANCE)
        };
        if !beginning.iter().all(begins) {
            return None;
        }
        let first = corners.first()?;
        let unknowns = |free: &DVector<f64>| set.at(free) * self.force;
        let point = |free: &DVector<f64>| self.at(system, &unknowns(free));
        let all = |free: &DVector<f64>| self.answer.unknowns(&point(free).state());
        let list = |point: &Point| {
            let mut forces: Vec<f64> = point.normal_force.iter().map(|force| force + 0.0).collect();
            self.answer.mechanism.put_out_of_open(&point.pattern.states, &mut forces, 0.0);
            forces
        };
        let along = |growth: &DVector<f64>| point(&(first + growth));
        let growth = |growth: &DVector<f64>| self.answer.growth(&all(first), &all(&(first + growth)), 1.0);
        let difference = |growth: &DVector<f64>| {
            let (at, further) = (list(&point(first)), list(&along(growth)));
            further.iter().zip(&at).map(|(further, at)| further - at).collect()
        };
        let held = |k: usize, free: &DVector<f64>| {
            let point = point(free);
            point.held.iter().find(|held| held.contact == k).map_or(0.0, |held| held.friction.total() + 0.0)
        };
        let stuck = system.sticking.iter().filter(|stuck| stuck.is_first);
        let stuck = stuck.flat_map(|stuck| self.joints[stuck.joint].contacts.clone());
        let of_contact = |k: usize| HeldFriction {
            name: self.answer.mechanism.contacts[k].name.to_string(),
            unit: "N",
            at: corners.iter().map(|corner| held(k, corner)).collect(),
            along: growths.iter().map(|growth| held(k, &(first + growth)) - held(k, first)).collect(),
        };
        let motion: Vec<DrivenMotion> =
            corners.iter().map(|corner| self.answer.driven_motion(&all(corner))).collect();
        Some(Continuum {
            pattern: pattern(&system.pattern.states),
            rests: self.stands(&system.pattern) && motion.iter().all(|one| self.rest(&one.accelerations)),
            vertices: corners.iter().map(|corner| list(&point(corner))).collect(),
            directions: growths.iter().map(difference).collect(),
            motion,
            motion_along: growths.iter().map(growth).collect(),
            tipping: Vec::new(),
            couple: None,
            held: stuck.map(of_contact).collect(),
        })
    }
}

impl Point {
    fn state(&self) -> State<'_> {
        let states = &self.pattern.states;
        let orientation: f64 = states.iter().map(|state| state.sign()).product();
        State {
            pattern: states,
            patterns: vec![pattern(states)],
            normal_force: &self.normal_force,
            shares: vec![None; states.len()],
            signs: self.signs.clone(),
            on_boundary: self.signs.contains(&0),
            determinant: self.oriented * orientation,
            certificate: &Certificate::NotProven,
            hinges: &[],
            held: &self.held,
        }
    }
}
