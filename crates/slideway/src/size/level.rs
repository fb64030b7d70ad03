//! The greatest effort, normal force or bearing pressure of all solutions at a value, or their least
//! efficiency.

use super::Against;
use crate::drive::{EfficiencyKind, Efforts};
use crate::fault::{Fault, FaultKind, Faults};
use crate::limits::Varied;
use crate::modes::existence::TooManyModes;
use crate::progress::Work;
use crate::report::Solution;

/// What counts of a solution: efforts of the drives, normal forces of the contacts.
struct Forces {
    efforts: Vec<f64>,
    normal_forces: Vec<f64>,
}

/// The greatest of an effort, normal force or bearing pressure, or the least efficiency, over all solutions
/// at a value; none without a solution.
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
    let efforts = Efforts::at(varied, value)?;
    let goes_on = || !work.is_over();
    let patterns = efforts.present(&goes_on).map_err(|TooManyModes { contacts, limit, .. }| {
        Faults::from(Fault::general(FaultKind::TooManyModes { contacts, limit }))
    })?;
    let of_pattern = |pattern: &Vec<_>| {
        Some(Forces { efforts: efforts.of(pattern)?, normal_forces: efforts.normal_forces(pattern)? })
    };
    let between = |state: &Solution| Forces {
        efforts: state.drives.iter().map(|drive| drive.effort).collect(),
        normal_forces: state.contacts.iter().map(|contact| contact.normal_force).collect(),
    };
    let between_faces = varied.states_between_faces(value, 1.0, None, work);
    let states = patterns.iter().filter_map(of_pattern).chain(between_faces.iter().map(between));
    let levels = states.map(|forces| of_forces(varied, against, &efforts, &forces));
    let levels: Vec<f64> = levels.collect::<Result<_, _>>()?;
    let worst = if matches!(against, Against::Efficiency) { f64::min } else { f64::max };
    Ok(levels.into_iter().reduce(worst))
}

/// The greatest absolute effort, normal force or bearing pressure of a solution, or its efficiency.
fn of_forces(varied: &Varied, against: &Against, at: &Efforts, forces: &Forces) -> Result<f64, Faults> {
    let named = |name: &Option<String>, values: &[f64], names: &[String], what: &'static str| {
        let Some(name) = name else {
            return Ok(values.iter().fold(0.0, |most: f64, value| most.max(value.abs())));
        };
        let index = names.iter().position(|other| other == name).ok_or_else(|| {
            let nearest = crate::fault::nearest(name, names.iter().map(String::as_str));
            let kind = FaultKind::UnknownName { what, name: name.clone(), nearest, known: names.to_vec() };
            Faults::from(Fault::general(kind))
        })?;
        Ok(values[index].abs())
    };
    match against {
        Against::Effort { drive } => {
            let drives: Vec<String> =
                varied.model().drives.iter().map(|drive| drive.name.to_string()).collect();
            named(drive, &forces.efforts, &drives, "drive")
        }
        Against::NormalForce { contact } => {
            let contacts: Vec<String> = at.contacts.iter().map(|contact| contact.name.to_string()).collect();
            named(contact, &forces.normal_forces, &contacts, "contact")
        }
        Against::Pressure { contact } => {
            let with_pad =
                at.contacts.iter().zip(&forces.normal_forces).filter_map(|(contact, force)| {
                    Some((contact.name.to_string(), contact.pressure(*force)?))
                });
            let (contacts, pressures): (Vec<String>, Vec<f64>) = with_pad.unzip();
            let pressure = named(contact, &pressures, &contacts, "contact")?;
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
