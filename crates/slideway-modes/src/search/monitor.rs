//! Limits, progress and cancellation of a search.

use super::report::StopReason;
use crate::progress::{Callback, Progress};

/// Counts nodes, reports to the caller, and records why the search ends early.
pub(super) struct Monitor<'a> {
    progress: &'a mut Callback<'a>,
    node_limit: u64,
    nodes: u64,
    states_found: u64,
    /// The fraction of the work that is done, and the fraction that the current group makes up.
    done: f64,
    share: f64,
    /// The latest report.
    told: Progress,
    stopped: Option<StopReason>,
}

impl<'a> Monitor<'a> {
    pub(super) fn new(node_limit: u64, progress: &'a mut Callback<'a>) -> Self {
        let told = Progress { counted: "nodes", done: 0, fraction: Some(0.0), found: Some(0) };
        Self { progress, node_limit, nodes: 0, states_found: 0, done: 0.0, share: 1.0, told, stopped: None }
    }

    pub(super) fn stopped(&self) -> Option<StopReason> {
        self.stopped
    }

    pub(super) fn stop(&mut self, reason: StopReason) {
        self.stopped.get_or_insert(reason);
    }

    /// The next group makes up this share of the work.
    pub(super) fn start_group(&mut self, done: f64, share: f64) {
        self.done = done;
        self.share = share;
    }

    pub(super) fn count_found(&mut self, states: usize) {
        self.states_found += states as u64;
    }

    /// Counts a node; `false` if the search must end before it. `fraction` is the completed part of the
    /// group's patterns.
    pub(super) fn visit(&mut self, fraction: f64, found_in_group: usize) -> bool {
        if self.stopped.is_some() {
            return false;
        }
        if self.nodes >= self.node_limit {
            self.stop(StopReason::NodeLimit);
            return false;
        }
        self.nodes += 1;
        self.told = Progress {
            counted: "nodes",
            done: self.nodes,
            // Of the pattern space within a group of contacts, and of the contacts over all groups.
            fraction: Some((self.done + self.share * fraction).min(1.0)),
            found: Some(self.states_found + found_in_group as u64),
        };
        self.goes_on()
    }

    /// `false` if the search must end. Also called during long steps.
    pub(super) fn goes_on(&mut self) -> bool {
        if self.stopped.is_none() && (self.progress)(&self.told).is_break() {
            self.stop(StopReason::Cancelled);
        }
        self.stopped.is_none()
    }
}
