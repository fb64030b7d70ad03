//! Which normal forces and which friction statics determines while joints stick.

use super::BOUNDARY;
use super::assessment::{MOST_SIDES, assess_system, sticking_sides, with_sides};
use super::instant::Instant;
use super::outputs::Group;
use super::system::{Question, System};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::pattern::Phase;

/// The normal force and the friction of each contact in a phase (N); `None` if it depends on how the sticking
/// joints share their friction: the equations leave it open for some admissible sides of the sticking contacts, or it
/// differs between choices of sides by more than what decisions count as zero. Friction is positive against positive
/// sliding.
///
/// # Errors
/// As [`sticking_margin`](super::sticking_margin).
pub(in crate::motion) fn determined_forces(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Result<Vec<[Option<f64>; 2]>, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    instant.check(phase)?;
    let stopped = vec![false; instant.joints.len()];
    let question = instant.question(&stopped, Some(phase));
    let mut forces = vec![[None; 2]; phase.contacts.len()];
    for group in &instant.groups {
        let found = of_group(&instant, &question, (phase, group)).unwrap_or_default();
        for (&k, both) in group.contacts.iter().zip(found) {
            forces[k] = both.map(|force| force.map(|force| force * instant.units_of(k).force));
        }
    }
    Ok(forces)
}

/// The forces of a group, in units; `None` if no state was found, or if not all sides could be tried.
fn of_group(
    instant: &Instant<'_>,
    question: &Question<'_>,
    (phase, group): (&Phase, &Group),
) -> Option<Vec<[Option<f64>; 2]>> {
    let sticking = sticking_sides(question, phase, (instant, group));
    let mut common: Option<Vec<[Option<f64>; 2]>> = None;
    for number in 0..=MOST_SIDES {
        let Some(phase) = with_sides(phase, &sticking, number) else { return common };
        let Some(system) = System::new(instant, question, &phase, group) else { continue };
        if assess_system(&system).ok()?.least() < -BOUNDARY {
            continue;
        }
        let found = group.contacts.iter().map(|&k| system.determined_forces(k));
        common = Some(match common {
            None => found.collect(),
            Some(before) => before
                .into_iter()
                .zip(found)
                .map(|(one, other)| [same(one[0], other[0]), same(one[1], other[1])])
                .collect(),
        });
    }
    None
}

fn same(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    one.zip(other).and_then(|(one, other)| ((one - other).abs() <= BOUNDARY).then_some(one))
}
