//! Pruned search.
mod group;
mod monitor;
mod propagation;
mod relaxation;
mod report;
mod simplex;
mod states;
mod tree;
mod uniqueness;

pub use report::*;
pub use states::StateSet;

/// Temporary
pub fn search_one(problem: &super::ModeProblem, options: &SearchOptions) -> (super::Solutions, GroupReport) {
    let mut go = |_: &Progress| std::ops::ControlFlow::Continue(());
    let mut monitor = monitor::Monitor::new(options.nodes, &mut go);
    let a = group::search_group(problem, options, &mut monitor);
    (a.solutions, a.report)
}
