//! How friction locks a mechanism that has no solution: the forces that keep each other in balance.

use super::answer::joint_modes;
use super::margins::{AT_ONCE, locking_mode};
use super::stages::Stages;
use super::state::pattern;
use crate::configuration::Configuration;
use crate::influence::ContactFriction;
use crate::mechanism::Mechanism;
use crate::modes::{ContactState, ModeProblem, Side};
use crate::report::{JointMode, SolveReport, Status};
use nalgebra::{DMatrix, DVector};

/// The contact mode that locks a mechanism, with forces that are in balance without any load.
///
/// At `factor` times the friction of the model the equations of the mode have a solution without load,
///
/// ```text
/// N_j = -factor sum_k c_jk |N_k|,   N not zero
/// ```
///
/// which remains one when it is multiplied by any positive number: only the proportions of its forces are
/// determined. No other mode locks between that friction and the present one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Locking {
    /// The pattern of the mode.
    pub pattern: String,
    /// The contact mode of each sliding joint.
    pub joints: Vec<JointMode>,
    /// The part of the friction of the model at which the mode locks, at most 1.
    pub factor: f64,
    /// Normal forces of all contacts, as multiples of the greatest.
    pub normal_forces: Vec<f64>,
    /// Friction forces of all contacts, positive against positive sliding, as multiples of the greatest normal force.
    pub friction_forces: Vec<f64>,
    /// Efforts of all drives, as multiples of the greatest normal force (torques: times 1 m).
    pub efforts: Vec<f64>,
    /// Whether drives prescribe the whole motion: then nothing but these forces is in the balance, no inertia.
    pub is_balance: bool,
}

/// The mode that locks a mechanism for which a report says that there is no solution.
///
/// None where friction is not the reason (a guided slider tips), and where it is not known: with friction in hinges, in
/// redundant guides, with more than 256 patterns.
pub fn locking(
    report: &SolveReport,
    mechanism: &Mechanism,
    configuration: &Configuration,
) -> Option<Locking> {
    let is_known = mechanism.rough_hinges().next().is_none() && mechanism.excess.is_empty();
    if report.status != Status::None || !report.rejected.is_empty() || !is_known {
        return None;
    }
    let (stages, _) = Stages::with_equations(mechanism.clone(), configuration.clone()).ok()?;
    let (mode, factor) = locking_mode(stages.data())?;
    let sides: Vec<Side> = mode.iter().map(|state| state.side()).collect::<Option<_>>()?;
    let pressures = pressures(&stages.data().problem().ok()?, &sides, factor)?;
    Some(balance(&stages, &mode, &pressures, factor))
}

/// The `y = |N| >= 0` with `(S + factor C) y = 0`, its greatest entry 1.
fn pressures(problem: &ModeProblem, sides: &[Side], factor: f64) -> Option<DVector<f64>> {
    let count = sides.len();
    let matrix = DMatrix::from_fn(count, count, |j, k| {
        let sign = if j == k { sides[k].sign() } else { 0.0 };
        sign + factor * problem.columns(sides[k])[(j, k)]
    });
    let rows = matrix.try_svd(false, true, f64::EPSILON, 0)?;
    let (last, _) = rows.singular_values.argmin();
    let vector = rows.v_t?.row(last).transpose();
    let greatest = vector[vector.icamax()];
    // Contacts without force have none but for rounding.
    let scaled = (vector / greatest).map(|y: f64| if y.abs() <= AT_ONCE { 0.0 } else { y });
    scaled.iter().all(|y| *y >= 0.0).then_some(scaled)
}

fn balance(stages: &Stages, mode: &[ContactState], pressures: &DVector<f64>, factor: f64) -> Locking {
    let Stages { mechanism, configuration, influence, velocity_signs, .. } = stages;
    let friction = |k: usize| {
        let [positive, negative] = mechanism.contacts[k].mu;
        let force = |mu: f64| factor * mu * pressures[k] * velocity_signs[k];
        match mode[k] {
            ContactState::Positive => ContactFriction { positive_face: force(positive), negative_face: 0.0 },
            _ => ContactFriction { positive_face: 0.0, negative_face: force(negative) },
        }
    };
    let friction: Vec<ContactFriction> = (0..mode.len()).map(friction).collect();
    let unknowns = influence.of_friction(&friction);
    let normal_forces: Vec<f64> =
        mode.iter().zip(pressures.iter()).map(|(state, size)| state.sign() * size).collect();
    #[expect(clippy::cast_possible_truncation, reason = "a sign")]
    let signs: Vec<i8> =
        normal_forces.iter().map(|force| if *force == 0.0 { 0 } else { force.signum() as i8 }).collect();
    Locking {
        pattern: pattern(mode),
        joints: joint_modes(mechanism, configuration, &signs),
        factor,
        normal_forces,
        friction_forces: friction.iter().map(|friction| friction.total()).collect(),
        efforts: influence.efforts(&unknowns),
        is_balance: mechanism.drives.len() >= mechanism.coordinates.len(),
    }
}
