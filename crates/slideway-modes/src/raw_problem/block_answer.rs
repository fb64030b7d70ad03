//! All solutions of a block equation, as a report.

use super::answer::stopped;
use super::block_equation::BlockEquation;
use super::kind::RawKind;
use super::range::{in_range, told as words};
use super::report::{BeyondRange, RawReport, RawSolution, RawUnknown, SCHEMA, Unknowns};
use super::right_hand_sides::{EveryAnswer, EveryRightHandSide};
use crate::blocks::{BlockResult, BlockSolution, OpenLabel, OpenRegion, search, unique_for_every_load};
use crate::interval::Interval;
use crate::progress::Callback;
use crate::search::SearchOptions;
use crate::status::{Proof, Status};

/// Maximum number of open regions that are listed one by one.
const MOST_REGIONS: usize = 8;

/// All solutions of a block equation, of which up to `most` are listed.
pub(super) fn solve(
    equation: &BlockEquation,
    options: &SearchOptions,
    most: usize,
    progress: &mut Callback<'_>,
) -> RawReport {
    let result = search(equation.problem(), options, progress);
    let listed = result.solutions.iter().take(most);
    RawReport {
        schema: SCHEMA,
        kind: RawKind::BlockAve,
        size: equation.size(),
        first: 0,
        status: status(&result),
        complete: result.complete,
        partial: result.stopped.is_some(),
        open: open(equation, &result, options),
        count: result.solutions.len().to_string(),
        gap_state_count: "0".to_owned(),
        continuum_count: "0".to_owned(),
        within_rounding: None,
        every_right_hand_side: None,
        solutions: listed.map(|solution| told(equation, solution)).collect(),
        gap_states: Vec::new(),
        continua: Vec::new(),
        strategy: strategy(equation, &result),
        nodes: result.nodes,
        groups: Vec::new(),
    }
}

/// Whether every right-hand side has exactly one solution: proven by norms, or not known (theory of hinges, section
/// 3).
pub(super) fn every_right_hand_side(equation: &BlockEquation) -> EveryRightHandSide {
    let (answer, reason) = match unique_for_every_load(equation.problem()) {
        Some(_) => (EveryAnswer::One, String::new()),
        None => (EveryAnswer::NotComputed, "the norms of the blocks are too large for a proof".to_owned()),
    };
    EveryRightHandSide { answer, patterns: Vec::new(), reason }
}

fn status(result: &BlockResult) -> Status {
    match result.solutions.len() {
        0 if result.complete == Proof::Proven => Status::None,
        0 => Status::Unknown,
        1 => Status::One,
        _ => Status::Several,
    }
}

fn strategy(equation: &BlockEquation, result: &BlockResult) -> String {
    let problem = equation.problem();
    if result.unique_for_every_load.is_some() {
        return "proof that there is exactly one solution for every right-hand side".to_owned();
    }
    format!(
        "directions of the blocks of two components ({}) in sectors, signs of those of one ({})",
        problem.hinges(),
        problem.contacts()
    )
}

/// Returns the reasons, in words, why the list is not proven complete; empty if it is.
fn open(equation: &BlockEquation, result: &BlockResult, options: &SearchOptions) -> Vec<String> {
    let region = |region: &OpenRegion| {
        let (place, x) = match region.label {
            OpenLabel::LockingDirection => ("along", equation.direction(&region.point)),
            _ => ("near", equation.unknowns(&region.point)),
        };
        let x: Vec<String> =
            x.iter().map(|value| format!("{:.6e}", value.clamp(f64::MIN, f64::MAX))).collect();
        format!("{}: not decided {place} x = ({})", region.label.as_str(), x.join(", "))
    };
    let mut open: Vec<String> = result.stopped.map(|reason| stopped(reason, options)).into_iter().collect();
    open.extend(result.open.iter().take(MOST_REGIONS).map(region));
    if result.open.len() > MOST_REGIONS {
        open.push(format!("{} more regions are not decided", result.open.len() - MOST_REGIONS));
    }
    open
}

fn told(equation: &BlockEquation, solution: &BlockSolution) -> RawSolution {
    let rows: Vec<f64> = solution.forces.iter().chain(solution.reactions.as_flattened()).copied().collect();
    let x = equation.unknowns(&rows);
    let bounds = equation.enclosures(&solution.enclosure);
    let sign = |bounds: &Interval| i8::from(bounds.lower() > 0.0) - i8::from(bounds.upper() < 0.0);
    let signs: Vec<i8> = bounds.iter().map(sign).collect();
    // A number that is not zero and rounds to it has none.
    let has_number = |at: usize| in_range(x[at]) && (x[at] != 0.0 || signs[at] == 0);
    let distance = |at: usize| (bounds[at] - Interval::point(x[at])).magnitude();
    let radius = (0..x.len()).filter(|&at| has_number(at)).map(distance).fold(0.0, f64::max);
    let beyond = |at: usize| BeyondRange {
        name: RawUnknown::X,
        index: at,
        value: words(f64::from(signs[at]), x[at], None),
    };
    RawSolution {
        on_boundary: !solution.on_boundary.is_empty() || !solution.unloaded.is_empty(),
        enclosure_radius: radius.is_finite().then_some(radius),
        residual: equation.residual(&x, &solution.magnitudes),
        beyond_range: (0..x.len()).filter(|&at| !has_number(at)).map(beyond).collect(),
        unknowns: Unknowns::AbsoluteValue {
            x: (0..x.len()).map(|at| if has_number(at) { x[at] + 0.0 } else { f64::NAN }).collect(),
        },
        signs,
        gaps: Vec::new(),
        shares_vary: false,
    }
}
