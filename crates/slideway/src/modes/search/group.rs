//! The search within one group of contacts.

use nalgebra::DVector;

use super::cells::{self, Covered};
use super::leaf::{Enclosures, Leaves};
use super::load::LoadedProblem;
use super::low_rank::LowRank;
use super::monitor::Monitor;
use super::propagation::Propagation;
use super::relaxation::load_error;
use super::report::{GroupReport, Method, PatternShares, SearchOptions, StopReason};
use super::tree::{Tree, TreeReport};
use super::uniqueness;
use crate::modes::findings::Findings;
use crate::modes::scaling::ScaledProblem;
use crate::modes::solutions::{ContactState, Solutions};

/// The fewest contacts for which the cells of an arrangement are worth a look.
const CELLS_FROM: usize = 13;

/// What a group's own problem has for solutions, and how they were found.
#[derive(Debug, Clone)]
pub(super) struct GroupAnswer {
    pub(super) solutions: Solutions,
    pub(super) enclosures: Enclosures,
    pub(super) report: GroupReport,
}

/// Finds all solutions of the problem of one group with the cheapest method that applies.
pub(super) fn search_group(
    loaded: &LoadedProblem,
    options: &SearchOptions,
    monitor: &mut Monitor<'_>,
) -> GroupAnswer {
    let scaled = ScaledProblem::new(&loaded.problem);
    let load_radius = scaled.scaled_load(&loaded.radius);
    let mut leaves = Leaves::new(loaded, Findings::new(&scaled, &options.limits), options.certify);
    let arguments = options.arguments;
    let solved = if arguments.propagation || arguments.uniqueness {
        Propagation::new(&scaled, &load_radius)
    } else {
        None
    };
    let proof = solved.as_ref().filter(|_| arguments.uniqueness);
    let unique = proof.and_then(|solved| by_uniqueness(&scaled, solved, &mut leaves, monitor));
    let answered = unique.or_else(|| {
        let worthwhile = arguments.low_rank && scaled.contacts() >= CELLS_FROM;
        if worthwhile { by_cells(&scaled, &load_radius, &mut leaves, monitor) } else { None }
    });
    let (method, tree) = answered.unwrap_or_else(|| {
        let propagation = solved.as_ref().filter(|_| arguments.propagation);
        let tree = Tree::new(&scaled, propagation, &load_radius, options).run(&mut leaves, monitor);
        (Method::BranchAndBound, tree)
    });
    let unproven = leaves.unproven();
    let (mut findings, enclosures) = leaves.into_findings();
    findings.sort();
    let report = GroupReport {
        contacts: (0..scaled.contacts()).collect(),
        method,
        log2_patterns: log2_patterns(&scaled),
        nodes: tree.nodes,
        pivots: tree.pivots,
        shares: tree.shares,
        loads: 1,
        unproven_patterns: unproven,
        proven: unproven == 0,
        exclusions: tree.exclusions,
    };
    GroupAnswer { solutions: findings.into_solutions(), enclosures, report }
}

/// The only solution, if a proof says that there is exactly one.
fn by_uniqueness(
    problem: &ScaledProblem,
    solved: &Propagation,
    leaves: &mut Leaves<'_>,
    monitor: &mut Monitor<'_>,
) -> Option<(Method, TreeReport)> {
    let method = uniqueness::proof(problem, solved)?;
    let pattern = uniqueness::only_pattern(problem, solved)?;
    let mut report = TreeReport { nodes: 1, ..TreeReport::default() };
    if !monitor.visit(0.0, 0) {
        report.shares = PatternShares { unexplored: 1.0, ..PatternShares::default() };
    } else if leaves.examine(pattern).is_err() {
        monitor.stop(StopReason::SolutionLimit);
    } else {
        let examined = (-log2_patterns(problem)).exp2();
        report.shares = PatternShares { uniqueness: 1.0 - examined, examined, ..PatternShares::default() };
    }
    Some((method, report))
}

/// The solutions among the cells of an arrangement, if the coupling is of low rank.
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
        if leaves.examine(pattern).is_err() {
            monitor.stop(StopReason::SolutionLimit);
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
