//! Subtrees of a large tree, which threads share.
//!
//! The first nodes are visited one after the other. What is still open then is divided into a fixed number of
//! subtrees, each of which knows what was found before the division, and nothing of the others. So neither
//! nodes nor results depend on the number of threads. The subtrees are visited in rounds, each with twice as
//! many nodes for every subtree as the one before, up to a maximum: limits of nodes and solutions are shared, and
//! solutions are reported, between rounds.

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};

use super::leaf::Leaves;
use super::monitor::Monitor;
use super::proof_log::ProofLog;
use super::report::StopReason;
use super::states::{StateSet, all_states, fraction_of_patterns};
use super::tree::{BASES_OF_WAITING, Node, Tree, TreeReport};
use crate::progress::Progress;

/// Nodes that are visited before a tree is divided: in less time, threads are not worth starting.
const ALONE: u64 = 1024;
/// The number of subtrees.
const SUBTREES: usize = 64;
/// A thread tells how it proceeds once in so many calls: each time another thread wakes up.
const CALLS: u64 = 64;
/// Nodes of each subtree in the first round, ...
const FIRST_ROUND: u64 = 64;
/// ... and in the longest: about a second of one thread, after which solutions are reported.
const LONGEST_ROUND: u64 = 1024;

struct Subtree<'t, 'l> {
    tree: Tree<'t>,
    open: Vec<Node>,
    leaves: Leaves<'l>,
    stopped: Option<StopReason>,
}

/// The progress of a subtree, sent while it is visited.
struct Told {
    subtree: usize,
    nodes: u64,
    fraction: f64,
    found: u64,
}

impl Tree<'_> {
    /// Visits nodes until none is left or the monitor stops the search; `leaves` receives the remaining
    /// patterns.
    pub(super) fn run(self, leaves: &mut Leaves<'_>, monitor: &mut Monitor<'_>) -> TreeReport {
        let root = all_states(self.problem);
        self.run_from(root, (leaves, monitor)).0
    }

    /// [`run`](Self::run) from a node on, with what was written.
    ///
    /// A tree with many nodes is divided into subtrees, which threads share. What they are does not depend on
    /// the number of threads. A proof is written in the order of one thread.
    pub(super) fn run_from(
        mut self,
        states: Vec<StateSet>,
        (leaves, monitor): (&mut Leaves<'_>, &mut Monitor<'_>),
    ) -> (TreeReport, Option<ProofLog>) {
        let root = Node { states, basis: None };
        let mut open = vec![root];
        let alone = if self.log.is_some() { u64::MAX } else { ALONE };
        self.work(&mut open, alone, (leaves, monitor));
        if !open.is_empty() && !monitor.has_ended() {
            self.widen(&mut open, (leaves, monitor));
            open = solve(&mut self, open, (leaves, monitor));
        }
        self.report.shares.unexplored +=
            open.iter().map(|node| fraction_of_patterns(self.problem, &node.states)).sum::<f64>();
        (self.report, self.log)
    }

    /// Visits the nodes with most patterns until there are enough subtrees.
    fn widen(&mut self, open: &mut Vec<Node>, (leaves, monitor): (&mut Leaves<'_>, &mut Monitor<'_>)) {
        let size = |node: &Node| fraction_of_patterns(self.problem, &node.states);
        let mut sizes: Vec<f64> = open.iter().map(size).collect();
        while open.len() < SUBTREES
            && let Some(largest) = (0..open.len()).max_by(|&one, &other| sizes[one].total_cmp(&sizes[other]))
        {
            let node = open.remove(largest);
            sizes.remove(largest);
            if !self.visit_next(node, open, (leaves, monitor)) {
                break;
            }
            sizes.extend(
                open[sizes.len()..].iter().map(|node| fraction_of_patterns(self.problem, &node.states)),
            );
        }
    }
}

/// Visits all subtrees; the results are added to the tree and to `leaves`. Returns the nodes that are still open
/// if the monitor stops the search.
fn solve<'t, 'l>(
    tree: &mut Tree<'t>,
    open: Vec<Node>,
    (leaves, monitor): (&mut Leaves<'l>, &mut Monitor<'_>),
) -> Vec<Node> {
    let subtree =
        |node| Subtree { tree: tree.subtree(), open: vec![node], leaves: leaves.another(), stopped: None };
    // As from a stack: the latest nodes first.
    let mut subtrees: Vec<Subtree<'t, 'l>> = open.into_iter().rev().map(subtree).collect();
    let mut most = FIRST_ROUND;
    while !monitor.has_ended() {
        let unfinished = subtrees.iter_mut().filter(|subtree| !subtree.open.is_empty());
        let mut unfinished: Vec<&mut Subtree<'t, 'l>> = unfinished.collect();
        if unfinished.is_empty() {
            break;
        }
        let share = monitor.remaining() / unfinished.len() as u64;
        if share == 0 {
            monitor.use_up();
            break;
        }
        let known = (tree.report().shares.done(), leaves.found() as u64);
        round(&mut unfinished, share.min(most), tree.threads(), (known, monitor));
        most = (2 * most).min(LONGEST_ROUND);
        unfinished.iter_mut().for_each(|subtree| subtree.leaves.tell(monitor));
        let reason = unfinished.iter().find_map(|subtree| subtree.stopped);
        reason.into_iter().for_each(|reason| monitor.stop(reason));
    }
    let mut left = Vec::new();
    for subtree in subtrees {
        tree.add(subtree.tree);
        left.extend(subtree.open);
        if let Err(reason) = leaves.absorb(subtree.leaves) {
            monitor.stop(reason);
        }
    }
    left
}

/// Visits up to `most` nodes of each subtree.
fn round<'t, 'l>(
    subtrees: &mut [&mut Subtree<'t, 'l>],
    most: u64,
    threads: usize,
    ((done, known), monitor): ((f64, u64), &mut Monitor<'_>),
) {
    let before: u64 = subtrees.iter().map(|subtree| subtree.tree.report().nodes).sum();
    let mut latest: Vec<(u64, f64, u64)> = vec![(0, 0.0, 0); subtrees.len()];
    let tasks: Vec<Mutex<&mut Subtree<'t, 'l>>> =
        subtrees.iter_mut().map(|subtree| Mutex::new(&mut **subtree)).collect();
    let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (sender, receiver) = channel();
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, tasks.len()) {
            let (tasks, next, stop, sender) = (&tasks, &next, &stop, sender.clone());
            scope.spawn(move || {
                while let Some((at, Ok(mut task))) = {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    tasks.get(at).map(|task| (at, task.lock()))
                } {
                    task.work(most, (at, &sender), stop);
                }
            });
        }
        drop(sender);
        for Told { subtree, nodes, fraction, found } in receiver {
            latest[subtree] = (nodes, fraction, found);
            let sum =
                latest.iter().fold((0, done, known), |sum, at| (sum.0 + at.0, sum.1 + at.1, sum.2 + at.2));
            if !monitor.tell(sum.0, sum.1, sum.2) {
                stop.store(true, Ordering::Relaxed);
            }
        }
    });
    drop(tasks);
    let after: u64 = subtrees.iter().map(|subtree| subtree.tree.report().nodes).sum();
    monitor.count_nodes(after - before);
}

impl Subtree<'_, '_> {
    fn work(&mut self, most: u64, (at, sender): (usize, &Sender<Told>), stop: &AtomicBool) {
        let mut calls = 0_u64;
        let mut callback = |progress: &Progress| {
            if calls.is_multiple_of(CALLS) {
                // The receiver lives as long as the threads.
                let _ = sender.send(Told {
                    subtree: at,
                    nodes: progress.done,
                    fraction: progress.fraction.unwrap_or(0.0),
                    found: progress.found.unwrap_or(0),
                });
            }
            calls += 1;
            if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let mut monitor = Monitor::new(u64::MAX, &mut callback);
        self.tree.work(&mut self.open, most, (&mut self.leaves, &mut monitor));
        self.tree.drop_bases(&mut self.open, BASES_OF_WAITING);
        // A stop of the whole search is known to its own monitor.
        self.stopped = monitor.stopped().filter(|reason| *reason != StopReason::Cancelled);
    }
}
