//! The greatest effort, normal force or bearing pressure of all solutions at a value, or their least
//! efficiency.

use super::Against;
use crate::drive::{EfficiencyKind, Efforts};
use crate::fault::{Fault, FaultKind, Faults};
use crate::limits::Varied;
use crate::mechanism::Contact;
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
    let between = |state: &Solution| Forces {
        efforts: state.drives.iter().map(|drive| drive.effort).collect(),
        normal_forces: state.contacts.iter().map(|contact| contact.normal_force).collect(),
    };
    let picked = picked(varied, against, &efforts)?;
    let worst = |states: &mut dyn Iterator<Item = Forces>| -> Result<Option<f64>, Faults> {
        let levels: Vec<f64> =
            states.map(|forces| of_forces(against, picked, &efforts, &forces)).collect::<Result<_, _>>()?;
        let worst = if matches!(against, Against::Efficiency) { f64::min } else { f64::max };
        Ok(levels.into_iter().reduce(worst))
    };
    if !varied.rough_circles([value, value]).is_empty() {
        let found = varied.solved(value, work)?;
        if !found.continua.is_empty() {
            return Err(Fault::general(FaultKind::LimitsNotComputed { modes: found.continua.len() }).into());
        }
        return worst(&mut found.solutions.iter().chain(&found.preload_gap_states).map(between));
    }
    let goes_on = || !work.is_over();
    let patterns = efforts.present(&goes_on).map_err(|TooManyModes { contacts, limit, .. }| {
        Faults::from(Fault::general(FaultKind::TooManyModes { contacts, limit }))
    })?;
    let of_pattern = |pattern: &Vec<_>| {
        Some(Forces { efforts: efforts.of(pattern)?, normal_forces: efforts.normal_forces(pattern)? })
    };
    let between_faces = varied.states_between_faces(value, 1.0, None, work);
    worst(&mut patterns.iter().filter_map(of_pattern).chain(between_faces.iter().map(between)))
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
