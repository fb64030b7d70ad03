//! How friction locks a mechanism that has no solution: the forces that keep each other in balance.

use super::answer::joint_modes;
use super::friction::friction;
use super::margins::{AT_ONCE, locking_mode};
use super::mode_problem::ProblemData;
use super::parts::contact_couples;
use super::stages::Stages;
use super::state::{pattern, signs, states};
use crate::configuration::Configuration;
use crate::dense::singular_values;
use crate::mechanism::Mechanism;
use crate::modes::{ContactState, ModeProblem, Side};
use crate::report::{JointMode, LockedMode, SolveReport, Status};
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
/// determined. No other mode locks between that friction and the present one. Where guides share a load, contacts that
/// touch neither face have no forces.
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
    /// Couples of all contacts about the middle of the pressed face, 0 of those that have none, as multiples of the
    /// greatest normal force times 1 m.
    pub couples: Vec<f64>,
    /// Efforts of all drives, as multiples of the greatest normal force (torques: times 1 m).
    pub efforts: Vec<f64>,
    /// Whether drives prescribe the whole motion: then nothing but these forces is in the balance, no inertia.
    pub is_balance: bool,
}

/// The mode that locks a mechanism for which a report says that there is no solution; that of the report, if its margins
/// were asked for.
///
/// None where friction is not the reason (a guided slider tips), and where it is not known: with friction in hinges, and
/// with more than 256 patterns.
pub fn locking(
    report: &SolveReport,
    mechanism: &Mechanism,
    configuration: &Configuration,
) -> Option<Locking> {
    let has_rough_hinges = mechanism.rough_hinges().next().is_some();
    if report.status != Status::None || !report.rejected.is_empty() || has_rough_hinges {
        return None;
    }
    let (stages, _) = Stages::with_equations(mechanism.clone(), configuration.clone()).ok()?;
    let followed = |locked: &LockedMode| (states(&locked.pattern), locked.factor);
    let (mode, factor) = match &report.margins {
        Some(margins) => margins.locking.as_ref().map(followed),
        None => locking_mode(stages.data()),
    }?;
    balance(&stages, &mode, factor)
}

/// The normal forces without any load in a mode whose determinant vanishes, the greatest of them 1 or -1; none if they
/// contradict the mode.
fn normal_forces(problem: &ModeProblem, mode: &[ContactState]) -> Option<DVector<f64>> {
    let columns = mode.iter().enumerate().map(|(k, state)| match state.side() {
        Some(side) => problem.columns(side).column(k).into_owned(),
        // An open contact, or one in its preload gap, moves from one face to the other.
        None => problem.jumps(Side::Negative).column(k) - problem.jumps(Side::Positive).column(k),
    });
    let columns: Vec<DVector<f64>> = columns.collect();
    // Columns differ in their units: so each is taken in its own size. A contact that locks by itself has none.
    let size = |column: &DVector<f64>| Some(column.norm()).filter(|size| *size > 0.0).unwrap_or(1.0);
    let sizes: Vec<f64> = columns.iter().map(size).collect();
    let entry = |row: usize, k: usize| columns[k][row] / sizes[k];
    let found = singular_values(&DMatrix::from_fn(mode.len(), mode.len(), entry), [false, true])?;
    let (last, _) = found.singular_values.argmin();
    let shares = found.v_t?.row(last).transpose();
    let pressures = DVector::from_fn(mode.len(), |k, _| mode[k].sign().abs() * shares[k] / sizes[k]);
    let greatest = pressures[pressures.icamax()];
    // Contacts without force have none but for rounding.
    let scaled = (pressures / greatest).map(|y: f64| if y.abs() <= AT_ONCE { 0.0 } else { y });
    let presses = scaled.iter().all(|y| *y >= 0.0);
    presses.then(|| DVector::from_fn(mode.len(), |k, _| mode[k].sign() * scaled[k]))
}

fn balance(stages: &Stages, mode: &[ContactState], factor: f64) -> Option<Locking> {
    let Stages { mechanism, configuration, influence, velocity_signs, .. } = stages;
    let mut rough = mechanism.clone();
    rough.multiply_friction(factor);
    let problem = ProblemData { mechanism: &rough, ..stages.data() }.problem().ok()?;
    let forces = normal_forces(&problem, mode)?;
    // Preloads are loads.
    rough.contacts.iter_mut().for_each(|contact| contact.preload = [0.0; 2]);
    let friction = friction(&rough, velocity_signs, mode, &forces, &vec![None; mode.len()]);
    let unknowns = influence.of_forces(&friction, &forces);
    let signs: Vec<i8> =
        signs(mode).iter().zip(&forces).map(|(sign, force)| if *force == 0.0 { 0 } else { *sign }).collect();
    let at_faces = |forces: Vec<f64>| mechanism.forces_at_faces(mode, forces);
    Some(Locking {
        pattern: pattern(mode),
        joints: joint_modes(mechanism, configuration, &signs),
        factor,
        friction_forces: at_faces(friction.iter().map(|friction| friction.total()).collect()),
        couples: contact_couples(mechanism, influence, &unknowns),
        normal_forces: at_faces(forces.iter().copied().collect()),
        efforts: influence.efforts(&unknowns),
        is_balance: mechanism.drives.len() >= mechanism.coordinates.len(),
    })
}
