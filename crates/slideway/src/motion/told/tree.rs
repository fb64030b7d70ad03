//! All possible motions where several phases can follow an event.

use super::report::{SimulateReport, report};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::motion::decision::rules::Decisions;
use crate::motion::following::simulate_with;
use crate::motion::moving::cause::Cause;
use crate::motion::options::SimulateOptions;
use crate::motion::record::event::Event;
use crate::motion::record::history::History;
use crate::progress::{Callback, Progress};
use serde::Serialize;
use std::collections::VecDeque;

/// Version of the layout of a [`TreeReport`]; it changes whenever a field is renamed or removed.
const SCHEMA: &str = "slideway/simulate-tree/1";

/// All motions from a state.
#[derive(Debug, Clone)]
pub struct Tree {
    /// The motions; the first takes the preferred branch everywhere.
    pub histories: Vec<Branching>,
    /// Whether the list is complete.
    pub complete: bool,
}

/// A motion, and the branches that it takes.
#[derive(Debug, Clone)]
pub struct Branching {
    /// The number of the phase taken at each event with several possible phases, counted from 0.
    pub branches: Vec<usize>,
    /// The motion.
    pub history: History,
}

/// The report of all motions.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TreeReport {
    /// Version of this layout.
    pub schema: &'static str,
    /// Whether these are all motions.
    pub complete: bool,
    /// The motions.
    pub histories: Vec<BranchingReport>,
}

/// The report of one motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BranchingReport {
    /// The number of the phase taken at each event with several possible phases, counted from 1.
    pub branches: Vec<usize>,
    /// The motion.
    pub motion: SimulateReport,
}

/// All motions of a mechanism from a state on, at most `most` of them, first those that branch off earliest
/// from the motion along the preferred branches. Branches prescribed by the options are kept.
///
/// # Errors
/// As [`simulate_with`]; a progress callback that breaks ends the search.
pub fn simulate_all(
    mechanism: &Mechanism,
    configuration: &Configuration,
    options: &SimulateOptions,
    (decisions, most): (&mut dyn Decisions, usize),
    progress: &mut Callback<'_>,
) -> Result<Tree, Faults> {
    let mut open = VecDeque::from([options.branches.clone()]);
    let mut tree = Tree { histories: Vec::new(), complete: true };
    let mut interrupted = false;
    while let Some(branches) = open.pop_front() {
        if tree.histories.len() >= most || interrupted {
            tree.complete = false;
            break;
        }
        let fixed = branches.len();
        let options = SimulateOptions { branches, ..options.clone() };
        let mut watched = |at: &Progress| {
            let flow = progress(at);
            interrupted = flow.is_break();
            flow
        };
        let history = simulate_with(mechanism, configuration, &options, decisions, &mut watched)?;
        tree.complete &= !history.events.iter().any(|event| event.left_out);
        let (taken, counts) = branchings(&history, options.initial.is_some());
        for (index, count) in counts.iter().enumerate().skip(fixed) {
            for other in (0..*count).filter(|other| *other != taken[index]) {
                let mut branches = taken[..index].to_vec();
                branches.push(other);
                open.push_back(branches);
            }
        }
        tree.histories.push(Branching { branches: taken, history });
    }
    tree.complete &= !interrupted;
    Ok(tree)
}

/// The number of the phase taken at each branching, and the number of possible phases.
fn branchings(history: &History, has_initial: bool) -> (Vec<usize>, Vec<usize>) {
    let chosen =
        |event: &&Event| event.successors.len() > 1 && !(has_initial && event.causes.contains(&Cause::Start));
    let events = history.events.iter().filter(chosen);
    events.filter_map(|event| Some((event.taken?, event.successors.len()))).unzip()
}

/// The report of all motions.
pub fn tree_report(tree: &Tree, options: &SimulateOptions) -> TreeReport {
    let one = |branching: &Branching| BranchingReport {
        branches: branching.branches.iter().map(|branch| branch + 1).collect(),
        motion: report(&branching.history, options),
    };
    TreeReport {
        schema: SCHEMA,
        complete: tree.complete,
        histories: tree.histories.iter().map(one).collect(),
    }
}
