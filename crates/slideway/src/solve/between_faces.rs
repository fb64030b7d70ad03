//! States in which a guided slider is between its faces and no sign pattern tells it ([`super::faces`]).

use super::{SolveOptions, Stages, solve_in};
use crate::fault::Faults;
use crate::model::Model;
use crate::progress::Callback;
use crate::report::Solution;

/// The states with `N = 0` and `C = 0` at a guided slider, whose preload then rubs on both faces, in a model
/// and its stages. Those with a normal force above `greatest` (N) do not count.
///
/// # Errors
/// Whatever `solve` refuses.
pub(crate) fn states_between_faces(
    model: &Model,
    stages: &Stages,
    greatest: Option<f64>,
    options: &SolveOptions,
    progress: &mut Callback<'_>,
) -> Result<Vec<Solution>, Faults> {
    let free = stages.parts()?.with_free_faces();
    if free.is_empty() {
        return Ok(Vec::new());
    }
    let mut report = solve_in(model, stages, options, progress)?;
    let greatest = greatest.unwrap_or(f64::INFINITY);
    report.preload_gap_states.retain(|state| {
        free.iter().any(|&contact| state.contacts[contact].preload_share.is_some())
            && state.contacts.iter().all(|contact| contact.normal_force.abs() <= greatest)
    });
    Ok(report.preload_gap_states)
}
