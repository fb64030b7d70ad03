//! In which units drawings tell forces.

use super::loads::load_force;
use slideway::configuration::Configuration;
use slideway::mechanism::{LoadKind, Mechanism};
use slideway::report::{Solution, SolveReport};

/// The mechanism in this state, in the units of a report, in which its numbers stand; forces in the unit in which most of those that
/// are drawn read well.
pub(super) fn in_units_of(
    report: Option<&SolveReport>,
    mechanism: &Mechanism,
    configuration: &Configuration,
) -> Mechanism {
    let units = report.map_or(&mechanism.units, |report| &report.model.units).clone();
    let mut in_units = mechanism.clone();
    // Misalignments may depend on where the mechanism is. Where they are not defined, there is no solution to draw.
    if configuration.put_friction(&mut in_units).is_err() {
        in_units = mechanism.clone();
    }
    in_units.units = units.suited_to_most("N", &forces(mechanism, configuration, report));
    in_units
}

/// The forces (N) of which drawings tell the values.
fn forces(mechanism: &Mechanism, configuration: &Configuration, report: Option<&SolveReport>) -> Vec<f64> {
    let states =
        report.into_iter().flat_map(|report| report.solutions.iter().chain(&report.preload_gap_states));
    let of_state = |state: &Solution| -> Vec<f64> {
        let contacts =
            state.contacts.iter().flat_map(|contact| [contact.normal_force, contact.friction_force]);
        let rough = state.hinges.iter().filter(|hinge| hinge.friction.is_some());
        contacts
            .chain(rough.map(|hinge| hinge.force[0].hypot(hinge.force[1])))
            .chain(state.drives.iter().filter(|drive| drive.unit == "N").map(|drive| drive.effort))
            .collect()
    };
    let known = known_forces(mechanism, configuration);
    known.into_iter().chain(states.flat_map(of_state)).filter(|force| *force != 0.0).collect()
}

/// The known loads and weights (N).
pub(super) fn known_forces(mechanism: &Mechanism, configuration: &Configuration) -> Vec<f64> {
    let loads = mechanism.loads.iter().filter_map(|load| match &load.kind {
        LoadKind::Pad(pad) => configuration.pad_force(mechanism, pad),
        _ => load_force(mechanism, configuration, load).map(|force| force.norm()),
    });
    loads.chain(mechanism.bodies.iter().map(|body| (mechanism.gravity * body.mass).norm())).collect()
}
