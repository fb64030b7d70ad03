//! Limits, progress and cancellation of a search.

use super::product::CombinedState;
use super::report::StopReason;
use crate::progress::{Callback, Progress};
use std::ops::ControlFlow;

/// Receives states as they are found; breaks to end the search.
pub type StateCallback<'c> = dyn FnMut(&CombinedState<'_>) -> ControlFlow<()> + 'c;

/// Counts nodes, reports to the caller, and records why the search, or the present attempt, ends early.
pub(super) struct Monitor<'a> {
    progress: &'a mut Callback<'a>,
    node_limit: u64,
    nodes: u64,
    /// The present attempt is given up before it visits this node.
    budget_end: u64,
    out_of_budget: bool,
    states_found: u64,
    /// The fraction of the work that is done, and the fraction that the current group makes up.
    done: f64,
    share: f64,
    /// The latest report.
    told: Progress,
    stopped: Option<StopReason>,
    enough: Enough,
    /// Receives states as they are found, if they are wanted.
    states: Option<&'a mut StateCallback<'a>>,
}

/// Flags for groups that have as many solutions as are wanted.
#[derive(Default)]
struct Enough {
    /// The current group.
    current: bool,
    /// Any group.
    some: bool,
    /// Any group before the present attempt.
    before_attempt: bool,
}

impl<'a> Monitor<'a> {
    pub(super) fn new(node_limit: u64, progress: &'a mut Callback<'a>) -> Self {
        let told = Progress { counted: "nodes", done: 0, fraction: Some(0.0), found: Some(0) };
        Self {
            progress,
            node_limit,
            nodes: 0,
            budget_end: u64::MAX,
            out_of_budget: false,
            states_found: 0,
            done: 0.0,
            share: 1.0,
            told,
            stopped: None,
            enough: Enough::default(),
            states: None,
        }
    }

    /// The same, telling states as they are found.
    pub(super) fn telling(self, states: &'a mut StateCallback<'a>) -> Self {
        Self { states: Some(states), ..self }
    }

    /// Whether states are to be reported as they are found.
    pub(super) fn wants_states(&self) -> bool {
        self.states.is_some()
    }

    /// Stops reporting states: from now on they are those of groups.
    pub(super) fn tell_no_states(&mut self) {
        self.states = None;
    }

    /// Tells a state that is proven.
    pub(super) fn tell_state(&mut self, state: &CombinedState<'_>) {
        if self.states.as_mut().is_some_and(|tell| tell(state).is_break()) {
            self.stop(StopReason::Cancelled);
        }
    }

    /// Nodes visited so far.
    pub(super) fn nodes(&self) -> u64 {
        self.nodes
    }

    /// Number of states counted so far.
    pub(super) fn states_found(&self) -> u64 {
        self.states_found
    }

    /// Begins an attempt that may visit so many nodes.
    pub(super) fn begin_attempt(&mut self, budget: u64) {
        self.budget_end = self.nodes.saturating_add(budget);
        self.enough.before_attempt = self.enough.some;
    }

    /// Ends the present attempt as if its budget were used up; the search goes on with another one.
    pub(super) fn give_up(&mut self) {
        self.out_of_budget = self.stopped.is_none();
    }

    /// Ends an attempt, before which so many states had been found; whether it was given up.
    pub(super) fn end_attempt(&mut self, states_found_before: u64) -> bool {
        self.budget_end = u64::MAX;
        let given_up = std::mem::take(&mut self.out_of_budget);
        if given_up {
            self.states_found = states_found_before;
            self.enough.some = self.enough.before_attempt;
        }
        given_up
    }

    /// Whether the search of the current group, or the present attempt, has ended early.
    pub(super) fn has_ended(&self) -> bool {
        self.out_of_budget || self.stopped().is_some()
    }

    /// Why the search of the current group must end.
    pub(super) fn stopped(&self) -> Option<StopReason> {
        self.stopped.or(self.enough.current.then_some(StopReason::SolutionLimit))
    }

    /// Why the search did not go to its end.
    pub(super) fn reason(&self) -> Option<StopReason> {
        self.stopped.or(self.enough.some.then_some(StopReason::SolutionLimit))
    }

    /// Ends the search, unless only the present attempt has ended; the search of the current group alone if it has
    /// solutions enough, since without those of the others these would be solutions of nothing.
    pub(super) fn stop(&mut self, reason: StopReason) {
        if self.out_of_budget {
            return;
        }
        if reason == StopReason::SolutionLimit {
            self.enough.current = true;
            self.enough.some = true;
        } else {
            self.stopped.get_or_insert(reason);
        }
    }

    /// The next group makes up this share of the work.
    pub(super) fn start_group(&mut self, done: f64, share: f64) {
        self.done = done;
        self.share = share;
    }

    /// The search of the current group is over.
    pub(super) fn end_group(&mut self) {
        self.enough.current = false;
    }

    /// Whether the search of some group ended because it had enough, from now on as if none had: what that left open
    /// matters only if all parts beside the group have solutions.
    pub(super) fn take_enough(&mut self) -> bool {
        std::mem::take(&mut self.enough.some)
    }

    /// Puts back what [`take_enough`](Self::take_enough) returned; `true` where not every combination of solutions is looked for,
    /// since there are as many as are wanted.
    pub(super) fn add_enough(&mut self, taken: bool) {
        self.enough.some |= taken;
    }

    pub(super) fn count_found(&mut self, states: usize) {
        self.states_found += states as u64;
    }

    /// Counts a node; `false` if the search must end before it. `fraction` is the completed part of the
    /// group's patterns.
    pub(super) fn visit(&mut self, fraction: f64, found_in_group: usize) -> bool {
        if self.has_ended() {
            return false;
        }
        if self.nodes >= self.node_limit {
            self.stop(StopReason::NodeLimit);
            return false;
        }
        if self.nodes >= self.budget_end {
            self.give_up();
            return false;
        }
        self.nodes += 1;
        self.told = Progress {
            counted: "nodes",
            done: self.nodes,
            // Of the pattern space within a group of contacts, and of the contacts over all groups.
            // An attempt begins anew.
            fraction: Some(
                (self.done + self.share * fraction).min(1.0).max(self.told.fraction.unwrap_or(0.0)),
            ),
            found: Some(self.states_found + found_in_group as u64),
        };
        self.goes_on()
    }

    /// Nodes that may still be visited.
    pub(super) fn remaining(&self) -> u64 {
        self.node_limit.min(self.budget_end).saturating_sub(self.nodes)
    }

    /// Ends the search, or the present attempt, because its nodes are used up.
    pub(super) fn use_up(&mut self) {
        if self.budget_end < self.node_limit { self.give_up() } else { self.stop(StopReason::NodeLimit) }
    }

    /// Counts nodes that were visited elsewhere.
    pub(super) fn count_nodes(&mut self, nodes: u64) {
        self.nodes += nodes;
    }

    /// Tells of nodes that are being visited elsewhere, and are not counted yet; `false` if the search must end.
    pub(super) fn tell(&mut self, nodes: u64, fraction: f64, found_in_group: u64) -> bool {
        self.told.done = self.nodes + nodes;
        self.told.fraction = Some((self.done + self.share * fraction).min(1.0));
        self.told.found = Some(self.states_found + found_in_group);
        self.goes_on()
    }

    /// `false` if the search must end. Also called during long steps.
    pub(super) fn goes_on(&mut self) -> bool {
        if !self.has_ended() && (self.progress)(&self.told).is_break() {
            self.stop(StopReason::Cancelled);
        }
        !self.has_ended()
    }
}
