//! Which forces of contacts and hinges statics determines while something sticks.

use super::BOUNDARY;
use super::assessment::{MOST_SIDES, assess_system, sticking_sides, with_sides};
use super::instant::Instant;
use super::outputs::Group;
use super::system::{Question, System};
use super::units::Units;
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::pattern::Phase;

/// The forces that statics determines in a phase; `None` where they depend on how what sticks shares its friction.
pub(in crate::motion) struct DeterminedForces {
    /// The normal force and the friction of each contact (N); friction is positive against positive sliding.
    pub(in crate::motion) contacts: Vec<[Option<f64>; 2]>,
    /// Both components of the force of each hinge with friction on its first body (N), and its friction couple there (N m).
    pub(in crate::motion) hinges: Vec<[Option<f64>; 3]>,
}

/// The forces of a phase that statics determines. The equations leave others open for some admissible sides of the
/// sticking contacts, or these differ between choices of sides by more than what decisions count as zero.
///
/// # Errors
/// As [`sticking_margin`](super::sticking_margin).
pub(in crate::motion) fn determined_forces(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Result<DeterminedForces, Faults> {
    if (0..phase.contacts.len()).any(|k| phase.is_open(mechanism, k)) {
        return super::lifting::determined_forces(mechanism, configuration, phase);
    }
    let instant = Instant::new(mechanism, configuration)?;
    instant.check(phase)?;
    let stopped = vec![false; instant.rubbing()];
    let question = instant.question(&stopped, Some(phase));
    let mut forces = DeterminedForces {
        contacts: vec![[None; 2]; phase.contacts.len()],
        hinges: vec![[None; 3]; phase.hinges.len()],
    };
    for group in &instant.groups {
        let Some(found) = of_group(&instant, &question, (phase, group)) else { continue };
        for (&k, both) in group.contacts.iter().zip(found.contacts) {
            forces.contacts[k] = both.map(|force| force.map(|force| force * instant.units_of(k).force));
        }
        for (&hinge, all) in group.hinges.iter().zip(found.hinges) {
            let Units { force, length, .. } = instant.hinges[hinge].units;
            let mut units = [force, force, force * length].into_iter();
            forces.hinges[hinge] = all.map(|value| units.next().and_then(|unit| Some(value? * unit)));
        }
    }
    Ok(forces)
}

/// The forces of a group, in units; `None` if no state was found, or if not all sides could be tried.
fn of_group(
    instant: &Instant<'_>,
    question: &Question<'_>,
    (phase, group): (&Phase, &Group),
) -> Option<DeterminedForces> {
    let sticking = sticking_sides(question, phase, (instant, group));
    let mut common: Option<DeterminedForces> = None;
    for number in 0..=MOST_SIDES {
        let Some(phase) = with_sides(phase, &sticking, number) else { return common };
        let Some(system) = System::new(instant, question, &phase, group) else { continue };
        if assess_system(&system).ok()?.least() < -BOUNDARY {
            continue;
        }
        let mut found = DeterminedForces {
            contacts: group.contacts.iter().map(|&k| system.determined_forces(k)).collect(),
            hinges: group.hinges.iter().map(|&hinge| system.determined_forces_of_hinge(hinge)).collect(),
        };
        if let Some(before) = &common {
            found.contacts.iter_mut().zip(&before.contacts).for_each(|(one, other)| keep_same(one, other));
            found.hinges.iter_mut().zip(&before.hinges).for_each(|(one, other)| keep_same(one, other));
        }
        common = Some(found);
    }
    None
}

/// Keeps the values that others agree with.
fn keep_same(values: &mut [Option<f64>], others: &[Option<f64>]) {
    for (value, other) in values.iter_mut().zip(others) {
        *value = value.zip(*other).filter(|(one, other)| (one - other).abs() <= BOUNDARY).map(|(one, _)| one);
    }
}
