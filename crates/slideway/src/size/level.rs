//! The greatest effort, normal force or bearing pressure of all solutions at a value, or their least
//! efficiency.

use super::Against;
use crate::drive::{EfficiencyKind, Efforts};
use crate::fault::{Fault, FaultKind, Faults};
use crate::limits::Varied;
use crate::mechanism::Contact;
use crate::modes::existence::TooManyModes;
use crate::progress::Work;
use crate::report::{Continuum, DrivenMotion, Solution, SolveReport};

/// Forces of a solution that count: efforts of the drives, normal forces of the contacts.
struct Forces {
    efforts: Vec<f64>,
    normal_forces: Vec<f64>,
}

/// The greatest of an effort, normal force or bearing pressure, or the least efficiency, over all solutions
/// at a value; none without a solution, infinite where infinitely many leave it without bound.
///
/// # Errors
/// Whatever keeps the mechanism from being assembled or solved there; too many modes; a drive or contact that
/// the model does not have.
pub(super) fn level(
    varied: &Varied,
    against: &Against,
    value: f64,
    work: Work<'_>,
) -> Result<Option<f64>, Faults> {
    let (efforts, stands) = Efforts::at_any(varied, value)?;
    let picked = picked(varied, against, &efforts)?;
    let worst = |states: &mut dyn Iterator<Item = Forces>| -> Result<Option<f64>, Faults> {
        let levels: Vec<f64> =
            states.map(|forces| of_forces(against, picked, &efforts, &forces)).collect::<Result<_, _>>()?;
        let worst = if matches!(against, Against::Efficiency) { f64::min } else { f64::max };
        Ok(levels.into_iter().reduce(worst))
    };
    let certified = || -> Result<Option<f64>, Faults> {
        let found = varied.solved(value, work)?;
        let continua = of_continua(&found)?;
        if continua.iter().any(|continuum| grows(against, picked, &efforts, continuum)) {
            return Ok(Some(f64::INFINITY));
        }
        let corners = continua.into_iter().flat_map(|continuum| continuum.corners);
        worst(&mut found.solutions.iter().chain(&found.preload_gap_states).map(forces_of).chain(corners))
    };
    // What stands still has a range of friction, which is no pattern's.
    if stands || !varied.rough_circles([value, value]).is_empty() {
        return certified();
    }
    let goes_on = || !work.is_over();
    let patterns = efforts.present(&goes_on).map_err(|TooManyModes { contacts, limit, .. }| {
        Faults::from(Fault::general(FaultKind::TooManyModes { contacts, limit }))
    })?;
    // Rounded numbers do not tell whether modes on their boundaries are one solution, or infinitely many.
    if patterns.iter().any(|pattern| efforts.is_on_boundary(pattern)) {
        return certified();
    }
    let of_pattern = |pattern: &Vec<_>| {
        Some(Forces { efforts: efforts.of(pattern)?, normal_forces: efforts.normal_forces(pattern)? })
    };
    let between_faces = varied.states_between_faces(value, 1.0, None, work);
    worst(&mut patterns.iter().filter_map(of_pattern).chain(between_faces.iter().map(forces_of)))
}

fn forces_of(state: &Solution) -> Forces {
    Forces {
        efforts: state.drives.iter().map(|drive| drive.effort).collect(),
        normal_forces: state.contacts.iter().map(|contact| contact.normal_force).collect(),
    }
}

/// Infinitely many solutions: all mixtures of the corners, and any amount of the growths beside them. A greatest or least
/// level is that of a corner.
struct Mixtures {
    corners: Vec<Forces>,
    growths: Vec<Forces>,
}

/// # Errors
/// Continua whose efforts are not known.
fn of_continua(found: &SolveReport) -> Result<Vec<Mixtures>, Faults> {
    if !found.continua.is_empty() && found.undetermined.is_none() {
        return Err(Fault::general(FaultKind::LimitsNotComputed { modes: found.continua.len() }).into());
    }
    let forces = |(normal_forces, motion): (&Vec<f64>, &DrivenMotion)| Forces {
        efforts: motion.efforts.clone(),
        normal_forces: normal_forces.clone(),
    };
    let mixtures = |continuum: &Continuum| Mixtures {
        corners: continuum.vertices.iter().zip(&continuum.motion).map(forces).collect(),
        growths: continuum.directions.iter().zip(&continuum.motion_along).map(forces).collect(),
    };
    Ok(found.continua.iter().map(mixtures).collect())
}

/// Whether a level grows without bound in infinitely many solutions; efficiencies fall to nothing then.
fn grows(against: &Against, picked: Option<usize>, at: &Efforts, continuum: &Mixtures) -> bool {
    let is_picked = |values: &[f64]| {
        let counts =
            |(index, value): (usize, &f64)| *value != 0.0 && picked.is_none_or(|picked| picked == index);
        values.iter().enumerate().any(counts)
    };
    continuum.growths.iter().any(|growth| match against {
        Against::NormalForce { .. } => is_picked(&growth.normal_forces),
        Against::Pressure { .. } => {
            let contacts = at.mechanism.contacts.iter().zip(&growth.normal_forces);
            is_picked(
                &contacts.map(|(one, force)| one.pressure(*force).unwrap_or_default()).collect::<Vec<_>>(),
            )
        }
        Against::Efficiency => at.power(&growth.efforts).0 != 0.0,
        _ => is_picked(&growth.efforts),
    })
}

/// The place of the drive or contact that is named among all; none if all of them count.
fn picked(varied: &Varied, against: &Against, at: &Efforts) -> Result<Option<usize>, Faults> {
    let names = |counts: &dyn Fn(&Contact) -> bool| -> Vec<Option<&str>> {
        at.mechanism.contacts.iter().map(|contact| counts(contact).then_some(&*contact.name)).collect()
    };
    let (name, what, names) = match against {
        Against::Effort { drive } => {
            (drive, "drive", varied.model().drives.iter().map(|drive| Some(&*drive.name)).collect())
        }
        Against::NormalForce { contact } => (contact, "contact", names(&|_| true)),
        Against::Pressure { contact } => (contact, "contact", names(&|contact| contact.pad.is_some())),
        _ => return Ok(None),
    };
    let Some(name) = name else { return Ok(None) };
    let index = names.iter().position(|other| *other == Some(name.as_str()));
    let unknown = || {
        let known = names.iter().copied().flatten();
        let nearest = crate::fault::nearest(name, known.clone());
        let known = known.map(str::to_owned).collect();
        Fault::general(FaultKind::UnknownName { what, name: name.clone(), nearest, known })
    };
    index.map(Some).ok_or_else(|| unknown().into())
}

/// The greatest absolute effort, normal force or bearing pressure of a solution, or its efficiency.
fn of_forces(against: &Against, picked: Option<usize>, at: &Efforts, forces: &Forces) -> Result<f64, Faults> {
    let greatest = |values: &[f64]| match picked {
        Some(index) => values[index].abs(),
        None => values.iter().fold(0.0, |most: f64, value| most.max(value.abs())),
    };
    match against {
        Against::Effort { .. } => Ok(greatest(&forces.efforts)),
        Against::NormalForce { .. } => Ok(greatest(&forces.normal_forces)),
        Against::Pressure { .. } => {
            // Where there is no pad there is none.
            let contacts = at.mechanism.contacts.iter().zip(&forces.normal_forces);
            let pressures = contacts.map(|(contact, force)| contact.pressure(*force).unwrap_or_default());
            let pressure = greatest(&pressures.collect::<Vec<_>>());
            let overflow = || FaultKind::Overflow { quantity: "the bearing pressure".to_owned() };
            if pressure.is_finite() { Ok(pressure) } else { Err(Fault::general(overflow()).into()) }
        }
        _ => {
            let (_, efficiency) = at.power(&forces.efforts);
            match (efficiency.is, efficiency.value) {
                (_, Some(value)) => Ok(value),
                // Friction takes all that the load would give: nothing of it arrives.
                (EfficiencyKind::HeldByFriction, None) => Ok(0.0),
                _ => Err(Fault::general(FaultKind::NoEfficiency).into()),
            }
        }
    }
}
