//! The states of joints at rest as those of a mode problem, whose search is proven (theory, section 12): two more unknowns `p`
//! and `q` for each joint that does not slide,
//!
//! ```text
//! F = (|q| - |p|)/2        p - q = 2 sum_k mu_k |N_k|        v' = rho (p^- - q^+)        N_k < 0: the gap opens
//! ```
//!
//! ```text
//! p >= 0 >= q   sticks     |F| <= mu |N|, v' = 0
//! p <= 0, q <= 0   slips forwards     F = mu |N|, v' >= 0          p >= 0, q >= 0   slips backwards     F = -mu |N|, v' <= 0
//! ```
//!
//! `p <= 0 <= q` leaves `p = q = 0`. Where all contacts of the joint are open, `p = q` is what `v'` says. Any `rho > 0` states the
//! same.

use super::patterns::lighter_mass;
use super::{Pattern, Resting, RestingJoint, Start, TOLERANCE, greatest_force, joints_of};
use crate::enclosure::{NotEnclosed, UncertainParameters, enclosed_at_rest, enclosed_while};
use crate::fault::Faults;
use crate::ids::JointId;
use crate::interval::Real;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::modes::certificate::{IntervalMatrix, IntervalModeProblem};
use crate::modes::{
    BySide, Certificate, Completeness, ContactState, InfluenceCoefficients, ModeProblem, ModeSolution,
    SearchOptions, Side, search,
};
use crate::progress::Callback;
use crate::report::Solution;
use crate::solve::answer::Answer;
use crate::solve::mode_problem::{overflow, stands};
use crate::solve::stages::Stages;
use crate::solve::standing::check_standing;
use nalgebra::{DMatrix, DVector};

/// A joint at rest in the numbers of the problem.
struct AtRest {
    joint: JointId,
    contacts: Vec<usize>,
    /// The acceleration of sliding by a unit of `p` or `q` (1/kg), a power of two.
    rho: f64,
}

/// The numbers of the problem, exact or within bounds: rows of the contacts, of the accelerations of the joints at rest as forces,
/// and of their cones; columns of the contacts, of `p` and of `q`.
struct Numbers<T: Real> {
    columns: BySide<DMatrix<T>>,
    jumps: BySide<DMatrix<T>>,
    load: DVector<T>,
}

/// The mode problem of a mechanism of which some contacts do not slide: with the unknowns of all contacts, then `p` and `q` of each
/// joint at rest, in newtons.
///
/// # Errors
/// Static friction above kinetic friction, or friction that acts at faces of different heights, of what is at rest, which have no
/// such form; forces that are left open where all sticks, of which rounded numbers would have one; what [`check_standing`] refuses;
/// numbers beyond the range of floating point.
pub(in crate::solve) fn mode_problem(
    stages: &Stages,
    equations: &KineticEquations,
) -> Result<ModeProblem, Faults> {
    let mechanism = &stages.mechanism;
    check_standing(mechanism, &stages.standing)?;
    let joints = joints_of(stages, &stages.standing, |row, _| row.of_velocities());
    let answer = Answer::determinate(stages, equations);
    let resting = Resting::new(&answer, joints, greatest_force(&stages.influence));
    let at_rest = resting.as_mode_problem().ok_or_else(|| stands(mechanism, &stages.standing))?;
    let rows: Vec<_> = resting.joints.into_iter().map(|joint| joint.row.into_equation()).collect();
    let Numbers { columns, jumps, load } =
        numbers(&stages.data().coefficients(&[], &rows)?, mechanism, &at_rest);
    ModeProblem::new(columns.positive, columns.negative, jumps.positive, jumps.negative, load)
        .map_err(|_| overflow())
}

impl Resting<'_> {
    /// The joints at rest as those of a mode problem; none where it would not state the same.
    fn as_mode_problem(&self) -> Option<Vec<AtRest>> {
        let mechanism = self.answer.mechanism;
        let is_stated = self.joints.iter().all(|joint| has_one_law(mechanism, joint));
        let at_rest = |joint: &RestingJoint| AtRest {
            joint: joint.joint,
            contacts: joint.contacts.clone(),
            rho: (10.0 / lighter_mass(mechanism, joint.joint)).log2().round().exp2(),
        };
        (is_stated && !self.may_leave_forces_open()).then(|| self.joints.iter().map(at_rest).collect())
    }

    /// Whether the forces are not determined where all contacts are closed and all joints at rest stick: the rows of any other
    /// pattern are some of these.
    fn may_leave_forces_open(&self) -> bool {
        let pattern = Pattern {
            states: vec![ContactState::Positive; self.answer.mechanism.contacts.len()],
            starts: vec![Some(Start::Sticks); self.joints.len()],
        };
        let set = self.equations(&self.system(pattern, self.answer.mechanism));
        set.is_none_or(|set| set.dimension() > 0)
    }

    /// Whether bounds of the exact mechanism prove that these are all its states: each is one of its mode problem, which has no other.
    pub(super) fn are_all(
        &self,
        solutions: &[Solution],
        (model, uncertain): (&Model, &UncertainParameters),
        options: &SearchOptions,
        progress: &mut Callback<'_>,
    ) -> bool {
        let Some(at_rest) = self.as_mode_problem() else { return false };
        let Answer { mechanism, configuration, .. } = *self.answer;
        let enclosed = enclosed_while(progress, |work| {
            let joints = at_rest.iter().map(|joint| joint.joint).collect::<Vec<_>>();
            let state = (mechanism, configuration);
            enclosed_at_rest(model, uncertain, state, &joints, work, |coefficients, mechanism| {
                within_bounds(&numbers(coefficients, mechanism, &at_rest))
            })
        });
        let Ok(problem) = enclosed else { return false };
        let found = search(&problem, options, progress);
        let lists = found.lists(solutions.len() + 1, 1);
        let is_certain = |one: &ModeSolution| matches!(one.certificate, Certificate::Proven { .. });
        found.completeness == Completeness::Proven
            && lists.gaps.is_empty()
            && lists.singular.is_empty()
            && lists.undecided.is_empty()
            && lists.solutions.len() == solutions.len()
            && lists.solutions.iter().all(is_certain)
            && solutions.iter().all(|one| lists.solutions.iter().any(|other| self.is_same(one, other)))
    }

    /// Whether the normal forces of two solutions are the same, up to what counts as rounding.
    fn is_same(&self, one: &Solution, other: &ModeSolution) -> bool {
        let scale = other.normal_force.amax().max(self.force);
        one.contacts.iter().zip(&other.normal_force).all(|(contact, force)| {
            let force = if contact.gap_acceleration.is_some() { force.max(0.0) } else { *force };
            (contact.normal_force - force).abs() <= TOLERANCE * scale
        })
    }
}

/// Whether friction of a joint at rest acts on one line, and its bound is what it is while it slips.
fn has_one_law(mechanism: &Mechanism, joint: &RestingJoint) -> bool {
    let is_flat = |contact: usize| {
        let slider = mechanism.slider(mechanism.contacts[contact].joint);
        mechanism.contacts[contact].opens || slider.is_none_or(|slider| slider.height == 0.0)
    };
    joint.contacts.iter().all(|&k| {
        let contact = &mechanism.contacts[k];
        contact.mu == contact.mu_static && contact.preload == [0.0; 2] && is_flat(k)
    })
}

/// The numbers of the problem, of coefficients with the accelerations of the joints at rest as further rows.
fn numbers<T: Real>(
    coefficients: &InfluenceCoefficients<T>,
    mechanism: &Mechanism<T>,
    at_rest: &[AtRest],
) -> Numbers<T> {
    let (contacts, joints) = (coefficients.contacts(), at_rest.len());
    let size = contacts + 2 * joints;
    let unit = |row: usize| row.checked_sub(contacts).map_or(1.0, |joint| 1.0 / at_rest[joint].rho);
    let as_forces = |matrix: &DMatrix<T>| {
        DMatrix::from_fn(contacts + joints, matrix.ncols(), |row, column| {
            matrix[(row, column)] * T::exactly(unit(row))
        })
    };
    let answers = as_forces(&coefficients.eta.positive);
    let of_contacts = coefficients.columns();
    let columns = BySide::of(|side| {
        let face = usize::from(side == Side::Negative);
        let mut all = as_forces(of_contacts.get(side)).resize(size, size, T::zero());
        for (index, joint) in at_rest.iter().enumerate() {
            let (acceleration, cone) = (contacts + index, contacts + joints + index);
            let [p, q] = [acceleration, cone];
            for row in 0..contacts + joints {
                let half = answers[(row, joint.contacts[0])] * T::exactly(0.5);
                (all[(row, p)], all[(row, q)]) = (half, -half);
            }
            match side {
                Side::Positive => all[(acceleration, q)] -= T::one(),
                Side::Negative => all[(acceleration, p)] += T::one(),
            }
            (all[(cone, p)], all[(cone, q)]) = (T::exactly(side.sign()), T::exactly(-side.sign()));
            for &k in &joint.contacts {
                let contact = &mechanism.contacts[k];
                let presses = face == 0 || !contact.opens;
                all[(cone, k)] = if presses { contact.mu[face] * T::exactly(-2.0) } else { T::zero() };
            }
        }
        all
    });
    let jumps = coefficients.jumps();
    let load = as_forces(&DMatrix::from_columns(&[coefficients.right_hand_side()]));
    Numbers {
        columns,
        jumps: BySide::of(|side| as_forces(jumps.get(side)).resize(size, size, T::zero())),
        load: load.resize_vertically(size, T::zero()).column(0).into_owned(),
    }
}

/// The problem of all numbers within these bounds.
fn within_bounds(numbers: &Numbers<crate::interval::Interval>) -> Result<IntervalModeProblem, NotEnclosed> {
    let bounded =
        |entries: &DMatrix<_>| IntervalMatrix::from_intervals(entries).ok_or(NotEnclosed::Equations);
    let sides = |both: &BySide<DMatrix<_>>| both.try_map(|_, entries| bounded(entries));
    let load = bounded(&DMatrix::from_columns(std::slice::from_ref(&numbers.load)))?;
    Ok(IntervalModeProblem::new(&sides(&numbers.columns)?, &sides(&numbers.jumps)?, &load)?)
}
