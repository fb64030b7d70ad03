//! The answer for a mechanism whose friction is multiplied by a factor: no model describes it.

use super::answer::Answer;
use super::found::SearchFound;
use super::hinges;
use super::stages::{ProblemData, RougherStages, Stages, rougher};
use super::{SolveOptions, searched, standing};
use crate::enclosure::{UncertainParameters, enclosed_while, enclosure_within};
use crate::fault::Faults;
use crate::interval::Interval;
use crate::kinetics::KineticEquations;
use crate::model::Model;
use crate::progress::Callback;
use crate::report::{SolveReport, finite};

/// The answer of [`super::solve`] for a model and its stages with more or less friction,
/// without margins and uncertainty.
///
/// # Errors
/// Whatever `solve` refuses.
pub(crate) fn solve_with_friction(
    model: &Model,
    RougherStages { stages, factor }: RougherStages<'_>,
    options: &SolveOptions,
    progress: &mut Callback<'_>,
) -> Result<SolveReport, Faults> {
    let Stages { configuration, influence, velocity_signs, .. } = stages;
    if stages.mechanism.rough_hinges().next().is_some() && factor > 0.0 {
        let stages = stages.with_friction(factor);
        let equations = KineticEquations::new(&stages.mechanism, configuration)?;
        let uncertain = UncertainParameters::default().with_friction(Interval::point(factor));
        let options = options.margins(false);
        let report = hinges::solve(model, (&uncertain, &[]), (&stages, &equations), &options, progress)?;
        return finite(report);
    }
    if !stages.standing.is_empty() {
        let stages = stages.with_friction(factor);
        let equations = KineticEquations::new(&stages.mechanism, configuration)?;
        return finite(standing::of_contacts(&stages, &equations)?);
    }
    let mechanism = rougher(&stages.mechanism, &|_| factor);
    let equations = KineticEquations::new(&mechanism, configuration)?;
    let uncertain = UncertainParameters::default().with_friction(Interval::point(factor));
    let enclosed = enclosed_while(progress, |work| {
        enclosure_within(model, &uncertain, (&stages.mechanism, configuration), work)
    });
    let data = ProblemData { mechanism: &mechanism, ..stages.data() };
    let (result, jumps) = searched(&enclosed, data, &options.search, progress)?;
    let answer = Answer {
        mechanism: &mechanism,
        configuration,
        equations: &equations,
        influence,
        velocity_signs,
        jumps,
        elasticity: stages.elasticity()?,
        shared: stages.shared_load()?,
        enclosed: enclosed.as_ref().ok().map(|enclosed| &enclosed.outputs),
    };
    let found = SearchFound { result: &result, rounded: enclosed.as_ref().err(), most: options.most };
    finite(answer.report(&found)?)
}
