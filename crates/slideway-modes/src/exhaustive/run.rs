//! Distributes the tree among threads.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use rayon::prelude::*;

use super::instructions::Instructions;
use super::kernel::Kernel;
use super::lanes::LANES;
use super::layout::{Layout, ScaledEquations};
use super::pattern::Pattern;
use super::upper::Node;
use crate::problem::ProblemView;
use crate::progress::Progress;

/// Levels of the tree that are expanded before its subtrees are distributed among threads.
const SHARED_LEVELS: usize = 6;

/// The processing of the patterns that a subtree leaves.
pub(super) type Examine<'a, T> = &'a (dyn Fn(Vec<Pattern>) -> Vec<T> + Sync);

/// The outcome of a walk over the patterns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tally {
    /// Patterns that the visitor received, or would have received in the subtree at which it stopped.
    pub visited: u64,
    /// Patterns that were proved to have no solution.
    pub excluded: u64,
    /// Whether the walk was completed, so that the two counts add up to all patterns.
    pub complete: bool,
}

/// One walk over all patterns.
pub(super) struct Run<'a, T> {
    layout: Layout,
    examine: Examine<'a, T>,
    progress: &'a (dyn Fn(&Progress) -> ControlFlow<()> + Sync),
    total: u64,
    done: AtomicU64,
    stopped: AtomicBool,
}

impl<'a, T: Send> Run<'a, T> {
    pub(super) fn new(
        problem: ProblemView<'_>,
        instructions: Instructions,
        examine: Examine<'a, T>,
        progress: &'a (dyn Fn(&Progress) -> ControlFlow<()> + Sync),
    ) -> Self {
        assert!(problem.contacts() <= 60, "patterns are held in the bits of a u64");
        let layout = Layout::new(problem, instructions);
        let total = layout.patterns_below(layout.places());
        assert!(total.is_some(), "patterns are counted in a u64");
        let total = total.unwrap_or_default();
        Self { layout, examine, progress, total, done: AtomicU64::new(0), stopped: AtomicBool::new(false) }
    }

    /// Passes the remaining patterns to the visitor, subtree after subtree.
    pub(super) fn visit_all(
        &self,
        problem: ProblemView<'_>,
        visit: &mut dyn FnMut(T) -> ControlFlow<()>,
    ) -> Tally {
        let root = Node::root(&ScaledEquations::new(problem, &self.layout), &self.layout);
        let mut tally = Tally { visited: 0, excluded: 0, complete: true };
        if self.visit_below(&root, visit, &mut tally).is_break() {
            tally.complete = false;
        }
        tally
    }

    /// Number of places of the subtrees that make up one piece of work: they fill the lanes of the kernel
    /// once.
    fn subtree_places(&self) -> usize {
        self.layout.places().min(self.layout.kernel_places() + LANES.ilog2() as usize)
    }

    fn visit_below(
        &self,
        node: &Node,
        visit: &mut dyn FnMut(T) -> ControlFlow<()>,
        tally: &mut Tally,
    ) -> ControlFlow<()> {
        if node.places > self.subtree_places() + SHARED_LEVELS {
            return node.children(&self.layout).try_for_each(|child| self.visit_below(&child, visit, tally));
        }
        let mut nodes = vec![node.clone()];
        for _ in self.subtree_places()..node.places {
            nodes = nodes.par_iter().flat_map_iter(|node| node.children(&self.layout)).collect();
        }
        let results: Vec<Option<Vec<T>>> = nodes
            .par_iter()
            .map_init(|| Kernel::new(&self.layout), |kernel, node| self.screen_subtree(kernel, node))
            .collect();
        for (node, result) in nodes.iter().zip(results) {
            let Some(result) = result else { return ControlFlow::Break(()) };
            let patterns = self.layout.patterns_below(node.places).unwrap_or_default();
            tally.excluded += patterns - result.len() as u64;
            tally.visited += result.len() as u64;
            result.into_iter().try_for_each(&mut *visit)?;
        }
        ControlFlow::Continue(())
    }

    /// The remaining patterns of a subtree; `None` if the walk was stopped.
    fn screen_subtree(&self, kernel: &mut Kernel, node: &Node) -> Option<Vec<T>> {
        if self.stopped.load(Ordering::Relaxed) {
            return None;
        }
        descend(node, kernel, &self.layout);
        let result = (self.examine)(kernel.take_remaining(&self.layout));
        let patterns = self.layout.patterns_below(node.places).unwrap_or_default();
        let examined = self.done.fetch_add(patterns, Ordering::Relaxed) + patterns;
        if (self.progress)(&Progress::of("patterns", examined, self.total)).is_break() {
            self.stopped.store(true, Ordering::Relaxed);
        }
        Some(result)
    }
}

fn descend(node: &Node, kernel: &mut Kernel, layout: &Layout) {
    if node.irregular {
        keep_all_below(node.pattern, node.places, kernel, layout);
    } else if node.places > layout.kernel_places() {
        for child in node.children(layout) {
            descend(&child, kernel, layout);
        }
    } else {
        kernel.push(node, layout);
    }
}

/// Keeps every pattern that agrees with the decided states of `pattern`.
fn keep_all_below(pattern: Pattern, places: usize, kernel: &mut Kernel, layout: &Layout) {
    let Some(place) = places.checked_sub(1) else { return kernel.keep(pattern) };
    for &state in layout.states(place) {
        keep_all_below(pattern.with(place, state), place, kernel, layout);
    }
}
