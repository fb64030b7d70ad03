//! The search within one group of contacts.

use nalgebra::DVector;

use super::cells::{self, Covered};
use super::leaf::Leaves;
use super::load::LoadedProblem;
use super::low_rank::LowRank;
use super::monitor::Monitor;
use super::propagation::SolvedForm;
use super::relaxation::load_error;
use super::report::{GroupReport, Method, PatternOutcomes, PatternShares, SearchOptions};
use super::tree::{Tree, TreeReport};
use super::{every, monotone};
use crate::findings::Findings;
use crate::problem::{ContactState, ScaledProblem};
use crate::solutions::Solutions;

/// All patterns of a group are tried if there are at most this many. For 8 contacts without jumps this takes
/// about 0.4 ms, several times as long as branch and bound, which does not give the outcome of each pattern.
const EVERY_PATTERN_UP_TO: u64 = 256;
/// The minimum number of contacts for which cells of an arrangement are worth trying.
pub(super) const CELLS_FROM: usize = 13;

/// The solutions of a group's own problem, and how they were found.
#[derive(Debug, Clone)]
pub(super) struct GroupAnswer {
    pub(super) solutions: Solutions,
    pub(super) report: GroupReport,
    /// Whether the answer may differ for other states of the contacts that determine the right-hand side.
    pub(super) depends_on_ancestors: bool,
}

/// Finds all solutions of the problem of one group with the cheapest method that applies.
pub(super) fn search_group(
    loaded: &LoadedProblem<'_>,
    options: &SearchOptions,
    monitor: &mut Monitor<'_>,
) -> GroupAnswer {
    let scaled = ScaledProblem::within(loaded.view());
    let mut leaves = Leaves::new(loaded, Findings::new(&scaled, &options.limits), options.certify);
    let few = scaled.patterns_from(0).1 <= EVERY_PATTERN_UP_TO;
    let (method, tree) = if options.arguments.every_pattern && few {
        let tree = every::try_all(loaded, &scaled, &mut leaves, options.certify, monitor);
        (Method::EveryPattern, tree)
    } else {
        search_large_group(loaded, &scaled, options, (&mut leaves, monitor))
    };
    let (unproven, depends_on_ancestors) = (leaves.unproven(), leaves.depends_on_ancestors());
    let mut findings = leaves.into_findings();
    findings.sort();
    let solutions = findings.into_solutions();
    let report = GroupReport {
        contacts: (0..scaled.contacts()).collect(),
        method,
        log2_patterns: log2_patterns(&scaled),
        nodes: tree.nodes,
        pivots: tree.pivots,
        shares: tree.shares,
        loads: 1,
        barren_loads: u64::from(solutions.admits_nothing()),
        unproven_patterns: unproven,
        proven: unproven == 0,
        outcomes: (method == Method::EveryPattern).then(|| PatternOutcomes::of(&solutions)),
        exclusions: tree.exclusions,
    };
    GroupAnswer { solutions, report, depends_on_ancestors }
}

/// Searches a group without trying every pattern.
fn search_large_group(
    loaded: &LoadedProblem<'_>,
    scaled: &ScaledProblem,
    options: &SearchOptions,
    (leaves, monitor): (&mut Leaves<'_>, &mut Monitor<'_>),
) -> (Method, TreeReport) {
    let load_radius = scaled.scaled_load_radius(&loaded.right_hand_side_radius());
    let arguments = options.arguments;
    let unexplored = || {
        let shares = PatternShares { unexplored: 1.0, ..PatternShares::default() };
        (Method::BranchAndBound, TreeReport { shares, ..TreeReport::default() })
    };
    if !monitor.goes_on() {
        return unexplored();
    }
    let solved = if arguments.propagation || arguments.uniqueness {
        SolvedForm::new(scaled, &load_radius, &mut || monitor.goes_on())
    } else {
        None
    };
    if !monitor.goes_on() {
        return unexplored();
    }
    let continuous = scaled.has_jump.iter().all(|jump| !jump);
    let proof = solved.as_ref().filter(|_| arguments.uniqueness && continuous);
    let monotone = proof.and_then(|solved| by_monotonicity(loaded, (scaled, solved), leaves, monitor));
    let answered = monotone.or_else(|| {
        let large = scaled.contacts() >= CELLS_FROM;
        if arguments.low_rank && large { by_cells(scaled, &load_radius, leaves, monitor) } else { None }
    });
    answered.unwrap_or_else(|| {
        if !monitor.goes_on() {
            return unexplored();
        }
        let propagation = solved.as_ref().filter(|_| arguments.propagation);
        let tree = Tree::new((loaded, scaled), propagation, &load_radius, options).run(leaves, monitor);
        (Method::BranchAndBound, tree)
    })
}

/// The solutions of the only pattern that has any, if the problem is monotone.
fn by_monotonicity(
    loaded: &LoadedProblem<'_>,
    (scaled, solved): (&ScaledProblem, &SolvedForm),
    leaves: &mut Leaves<'_>,
    monitor: &mut Monitor<'_>,
) -> Option<(Method, TreeReport)> {
    let strictly = monotone::is_strict(scaled, solved, &mut || monitor.goes_on());
    let pattern = if strictly {
        monotone::only_pattern(scaled, solved, &mut || monitor.goes_on())?
    } else {
        monotone::pattern_of_all_solutions((loaded, scaled), leaves, monitor)?
    };
    let shares = if monitor.visit(0.0, 0) {
        let certain = if strictly {
            leaves.examine_only(&pattern, monitor)
        } else {
            leaves.record(&pattern, monitor).map(|()| true)
        };
        match certain {
            Ok(true) => {}
            Ok(false) => return None,
            Err(reason) => monitor.stop(reason),
        }
        let examined = (-log2_patterns(scaled)).exp2();
        PatternShares { uniqueness: 1.0 - examined, examined, ..PatternShares::default() }
    } else {
        PatternShares { unexplored: 1.0, ..PatternShares::default() }
    };
    Some((Method::Monotone { strictly }, TreeReport { nodes: 1, shares, ..TreeReport::default() }))
}

/// The solutions among the cells of an arrangement, if the coupling has low rank.
fn by_cells(
    problem: &ScaledProblem,
    load_radius: &DVector<f64>,
    leaves: &mut Leaves<'_>,
    monitor: &mut Monitor<'_>,
) -> Option<(Method, TreeReport)> {
    let low_rank = LowRank::of(problem, &load_error(problem, load_radius))?;
    let Covered { candidates, boxes, fraction } = cells::cover(&low_rank, monitor)?;
    let examined = (candidates.len() as f64).log2() - log2_patterns(problem);
    for sides in candidates {
        let pattern: Vec<ContactState> =
            sides.iter().map(|&side| ContactState::PRESSED[usize::from(side)]).collect();
        if let Err(reason) = leaves.examine(&pattern, monitor) {
            monitor.stop(reason);
            break;
        }
    }
    let shares = PatternShares {
        examined: examined.exp2(),
        cells: fraction - examined.exp2(),
        unexplored: 1.0 - fraction,
        ..PatternShares::default()
    };
    let report = TreeReport { shares, nodes: boxes, ..TreeReport::default() };
    Some((Method::Cells { rank: low_rank.rank() }, report))
}

/// Binary logarithm of the number of patterns, gap states included.
fn log2_patterns(problem: &ScaledProblem) -> f64 {
    problem.has_jump.iter().map(|&jump| if jump { 3_f64.log2() } else { 1.0 }).sum()
}
