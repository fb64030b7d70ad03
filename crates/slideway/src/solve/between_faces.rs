//! How many states there are in which a guided slider is between its faces and no sign pattern tells it ([`super::faces`]).

use super::answer::Answer;
use super::found::Found;
use super::parts::{Stages, rougher};
use super::{SolveOptions, mode_problem, searched};
use crate::enclosure::{UncertainParameters, enclosure};
use crate::fault::Faults;
use crate::interval::Interval;
use crate::kinetics::KineticEquations;
use crate::mechanism::{JointKind, Mechanism};
use crate::model::{Model, SliderKind};
use crate::progress::Callback;
use crate::report::{Contact, Solution};

/// The number of states with `N = 0` and `C = 0` at a guided slider, whose preload then rubs on both faces, in a model and its
/// stages with all coefficients of friction multiplied by a factor. Those with a normal force above `greatest` (N) do not count.
///
/// # Errors
/// Whatever `solve` refuses.
pub(crate) fn states_between_faces(
    model: &Model,
    (stages, friction): (&Stages, f64),
    greatest: Option<f64>,
    options: &SolveOptions,
    progress: &mut Callback<'_>,
) -> Result<usize, Faults> {
    let Stages { configuration, influence, velocity_signs, .. } = stages;
    let mechanism = rougher(&stages.mechanism, &|_| friction);
    let jumps = mode_problem(&mechanism, influence, velocity_signs)?.jumps_of_contacts();
    if !may_be_between_faces(&mechanism, &jumps) {
        return Ok(0);
    }
    let equations = KineticEquations::new(&mechanism, configuration)?;
    let uncertain = UncertainParameters::default().with_friction(Interval::point(friction));
    let enclosed = enclosure(model, &uncertain, &stages.mechanism, configuration);
    let (result, jumps) =
        searched(&enclosed, (&mechanism, influence, velocity_signs), &options.search, progress)?;
    let answer = Answer {
        mechanism: &mechanism,
        configuration,
        equations: &equations,
        influence,
        velocity_signs,
        jumps,
        enclosed: enclosed.as_ref().ok(),
    };
    let found = Found { result: &result, rounded: enclosed.as_ref().err(), most: options.most };
    let report = answer.report(&found)?;
    let is_between = |(k, contact): (usize, &Contact)| {
        contact.couple.is_some() && contact.preload_share.is_some() && answer.has_free_face(k)
    };
    let greatest = greatest.unwrap_or(f64::INFINITY);
    let counts = |state: &&Solution| {
        state.contacts.iter().enumerate().any(is_between)
            && state.contacts.iter().all(|contact| contact.normal_force.abs() <= greatest)
    };
    Ok(report.preload_gap_states.iter().filter(counts).count())
}

/// Whether there is a guided slider whose preload rubs on another face on the other side, but changes no normal force by that.
fn may_be_between_faces(mechanism: &Mechanism, jumps: &[bool]) -> bool {
    let guided = mechanism.joints.iter().filter_map(|joint| match &joint.kind {
        JointKind::Slider(slider) if slider.kind == SliderKind::Guided => Some(&slider.contacts),
        _ => None,
    });
    guided.flatten().any(|&contact| mechanism.preload_jumps(contact) && !jumps[contact.index()])
}
