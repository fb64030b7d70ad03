//! The states of a point, each solved by itself: where hinges rub, or contacts stand still while the rest
//! moves.

use super::ColourBy;
use super::class::{MARGINS, States, margin_up_to};
use crate::configuration::NO_ACCELERATION;
use crate::fault::Faults;
use crate::model::Model;
use crate::progress::{Progress, Work};
use crate::report::{Solution, SolveReport, SpeedChange, Status};
use crate::solve::{
    BlockState, LastSolution, SolveOptions, Stages, block_states, factors_with_one_solution, pattern,
    solve_in,
};

/// All states of a point, with the margin of an only solution for a map by margin. `model` makes its model for a careful
/// answer, which is given if `careful` says so: what becomes of the speeds and whether guided sliders tip needs one. None if
/// the search did not come to its end.
///
/// # Errors
/// Whatever `solve` refuses.
pub(super) fn states(
    stages: &Stages,
    model: &dyn Fn() -> Result<Model, Faults>,
    (colour_by, careful): (ColourBy, bool),
    last: &mut LastSolution,
    work: Work<'_>,
) -> Result<Option<States>, Faults> {
    let mut states = all_states(stages, model, careful, last, work)?;
    if colour_by == ColourBy::Margin
        && let Some(states) = states.as_mut().filter(|states| states.solutions.len() == 1)
    {
        let bounds = &MARGINS[..MARGINS.len() - 1];
        states.margin = factors_with_one_solution(stages, bounds, work)?.map(margin_up_to);
    }
    Ok(states)
}

fn all_states(
    stages: &Stages,
    model: &dyn Fn() -> Result<Model, Faults>,
    careful: bool,
    last: &mut LastSolution,
    work: Work<'_>,
) -> Result<Option<States>, Faults> {
    let mut goes_on = |_: &Progress| work.flow();
    if !careful
        && let Some(found) =
            block_states((stages.data(), &stages.configuration), stages.accuracy, last, &mut goes_on)?
    {
        return Ok(Some(of_found(&found)));
    }
    let report = solve_in(&model()?, stages, &SolveOptions::default(), &mut goes_on)?;
    Ok((!report.partial).then(|| of_report(&report, stages)))
}

fn of_found(found: &[BlockState]) -> States {
    let patterns = found.iter().map(|state| pattern(&state.pattern));
    States { solutions: patterns.collect(), ..States::default() }
}

fn of_report(report: &SolveReport, stages: &Stages) -> States {
    let patterns = |states: &[Solution]| states.iter().map(|state| state.pattern.clone()).collect();
    States {
        solutions: patterns(&report.solutions),
        gaps: patterns(&report.preload_gap_states),
        continuum: (report.status == Status::Continuum).then(|| report.rests()),
        starts: report.starts(),
        tips: !report.rejected.is_empty(),
        undecided: report.status == Status::Unknown,
        efforts: report.solutions.iter().filter_map(|one| Some(one.drives.first()?.effort)).collect(),
        changes: report.solutions.iter().map(|solution| changes(solution, stages)).collect(),
        ..States::default()
    }
}

/// Returns the change of the speed of each coordinate that no drive moves.
fn changes(solution: &Solution, stages: &Stages) -> Vec<SpeedChange> {
    let of_bodies = solution.bodies.iter().flat_map(|body| body.acceleration);
    let greatest = of_bodies.fold(0.0_f64, |greatest, value| greatest.max(value.abs()));
    let angular = solution.bodies.iter().map(|body| body.angular_acceleration.abs());
    let greatest_angular = angular.fold(0.0, f64::max);
    let coordinates = stages.mechanism.coordinates.iter().zip(&solution.coordinates).enumerate();
    let free = coordinates.filter(|(index, _)| stages.mechanism.is_free(*index));
    free.map(|(_, (coordinate, found))| {
        let scale = if coordinate.kind.is_angle() { greatest_angular } else { greatest };
        let least = NO_ACCELERATION * scale;
        let sign = i8::from(found.acceleration > least) - i8::from(found.acceleration < -least);
        SpeedChange::of_sign(coordinate.rate, Some(sign))
    })
    .collect()
}
