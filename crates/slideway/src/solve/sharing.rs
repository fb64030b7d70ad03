//! How redundant guides share their load, and whether other stiffnesses would change the answer.

use super::mode_problem::self_stresses;
use super::stages::Stages;
use super::tolerant::StatesWithinTolerances;
use crate::attainability::ratios;
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::influence::Influence;
use crate::mechanism::Mechanism;
use crate::modes::{InfluenceCoefficients, ModeProblem, OpenContacts, SharedLoad};
use crate::report::{Elasticity, LoadSharing, SolveReport, StiffnessRatios};
use crate::sharing;
use nalgebra::DVector;
use std::collections::BTreeSet;
use std::ops::ControlFlow;

/// Adds what is said of redundant guides to a report; nothing for determinate mechanisms. Other stiffnesses are
/// tried if `ratios` are asked for.
pub(super) fn add(report: &mut SolveReport, stages: &Stages, ratios: bool) -> Result<(), Faults> {
    let Some(mut sharing) = load_sharing(&stages.mechanism, &stages.influence)? else { return Ok(()) };
    let ratios = ratios && sharing.self_stresses > 0 && sharing.elasticity != Elasticity::Rigid;
    if let (Some(shared), true) = (stages.shared_load()?, ratios) {
        sharing.stiffness_ratios = stiffness_ratios(stages, &shared)?;
    }
    report.sharing = Some(sharing);
    Ok(())
}

/// How redundant guides share their load; none if nothing is in excess.
///
/// # Errors
/// Nothing says how.
pub(crate) fn load_sharing(
    mechanism: &Mechanism,
    influence: &Influence,
) -> Result<Option<LoadSharing>, Faults> {
    sharing::load_sharing(mechanism, &self_stresses(influence))
}

/// The contact modes for other ratios of the stiffnesses of the contacts that share a load; none if they are not all
/// found.
fn stiffness_ratios(stages: &Stages, shared: &SharedLoad) -> Result<Option<StiffnessRatios>, Faults> {
    let contacts = stages.data().coefficients(&[], &[])?;
    let patterns = |shared: &SharedLoad| {
        let contacts = InfluenceCoefficients { shared: Some(shared.clone()), ..contacts.clone() };
        patterns(&contacts, &stages.mechanism.excess.open)
    };
    let Some(as_given) = patterns(shared) else { return Ok(None) };
    let places = stages.mechanism.places().map(ContactId::index);
    let sharing: Vec<usize> = places.filter(|&k| shared.shares(k)).collect();
    let mut others = BTreeSet::new();
    let (mut tried, mut same) = (0, true);
    for factors in ratios(sharing.len()) {
        let mut compliance: DVector<f64> = shared.compliance.clone();
        sharing.iter().zip(&factors).for_each(|(&k, factor)| compliance[k] /= *factor);
        shared.press_fits.iter().for_each(|&[face, other]| compliance[other] = compliance[face]);
        let Some(found) = patterns(&SharedLoad { compliance, ..shared.clone() }) else {
            return Ok(None);
        };
        tried += 1;
        same &= found == as_given;
        others.extend(found.difference(&as_given).cloned());
    }
    Ok(Some(StiffnessRatios { tried, same, others: others.into_iter().collect() }))
}

/// The patterns of all states, in rounded numbers. Returns `None` if the search did not come to its end.
fn patterns(contacts: &InfluenceCoefficients, open: &OpenContacts) -> Option<BTreeSet<String>> {
    let problem = ModeProblem::from_influence(contacts).ok()?;
    let found = StatesWithinTolerances::of(&problem, open, &mut |_| ControlFlow::Continue(()))?;
    Some(found.states.iter().map(|state| super::pattern(&state.sides)).collect())
}
