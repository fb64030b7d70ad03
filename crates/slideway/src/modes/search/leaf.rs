//! The outcome of single patterns, and whether it is proven.

use super::report::StopReason;
use crate::modes::certificate::{Decision, ExactSet, decide};
use crate::modes::findings::{Findings, PatternOutcome};
use crate::modes::problem::ModeProblem;
use crate::modes::solutions::ContactState;

/// Solves patterns one by one.
pub(super) struct Leaves<'a> {
    problem: &'a ModeProblem,
    findings: Findings<'a>,
    certify: bool,
    /// Patterns solved, and those among them whose outcome is not proven.
    examined: u64,
    unproven: u64,
}

impl<'a> Leaves<'a> {
    /// Patterns of `problem`, of which `findings` has the scaled form.
    pub(super) fn new(problem: &'a ModeProblem, findings: Findings<'a>, certify: bool) -> Self {
        Self { problem, findings, certify, examined: 0, unproven: 0 }
    }

    /// Files what a pattern admits.
    pub(super) fn examine(&mut self, mut pattern: Vec<ContactState>) -> Result<(), StopReason> {
        self.examined += 1;
        let outcome = self.findings.examine_leaf(&mut pattern).map_err(|_| StopReason::SolutionLimit)?;
        if !self.certify || !confirms(&decide(self.problem, &pattern).decision, &outcome) {
            self.unproven += 1;
        }
        Ok(())
    }

    /// How many solutions, gap states and singular sets have been found so far.
    pub(super) fn found(&self) -> usize {
        self.findings.found()
    }

    pub(super) fn unproven(&self) -> u64 {
        self.unproven
    }

    pub(super) fn into_findings(self) -> Findings<'a> {
        self.findings
    }
}

/// Whether a proven decision is what the solution within tolerances says.
fn confirms(decision: &Decision, outcome: &PatternOutcome) -> bool {
    match (decision, outcome) {
        (Decision::NoSolution { .. }, PatternOutcome::NoSolution)
        | (Decision::Singular { set: ExactSet::Empty }, PatternOutcome::Locked) => true,
        (Decision::Solution { .. }, PatternOutcome::Solution { on_boundary }) => on_boundary.is_empty(),
        (Decision::Boundary { zero, full_share, .. }, PatternOutcome::Solution { on_boundary }) => {
            let mut exact: Vec<usize> = zero.iter().chain(full_share).copied().collect();
            let mut found = on_boundary.clone();
            exact.sort_unstable();
            found.sort_unstable();
            exact == found
        }
        (Decision::Singular { set }, PatternOutcome::Singular) => {
            !matches!(set, ExactSet::Empty | ExactSet::NotComputed)
        }
        _ => false,
    }
}
