//! The outcome of single patterns, and whether it is proven.

use std::collections::HashMap;

use super::load::LoadedProblem;
use super::report::StopReason;
use crate::modes::certificate::{Decision, ExactSet, Interval, IntervalModeProblem, decide};
use crate::modes::findings::{Findings, PatternOutcome};
use crate::modes::solutions::ContactState;

/// Proven bounds of the unknowns of each pattern that has a solution.
pub(super) type Enclosures = HashMap<Vec<ContactState>, Vec<Interval>>;

/// What proofs refer to.
enum Proofs<'a> {
    None,
    Exact(&'a LoadedProblem),
    /// All right-hand sides within bounds.
    Within(Box<IntervalModeProblem>),
}

/// Solves patterns one by one.
pub(super) struct Leaves<'a> {
    proofs: Proofs<'a>,
    findings: Findings<'a>,
    enclosures: Enclosures,
    /// Patterns whose outcome is not proven.
    unproven: u64,
}

impl<'a> Leaves<'a> {
    /// Patterns of `problem`, of which `findings` has the scaled form.
    pub(super) fn new(problem: &'a LoadedProblem, findings: Findings<'a>, certify: bool) -> Self {
        let proofs = if !certify {
            Proofs::None
        } else if problem.is_exact() {
            Proofs::Exact(problem)
        } else {
            problem.within_bounds().map_or(Proofs::None, |problem| Proofs::Within(Box::new(problem)))
        };
        Self { proofs, findings, enclosures: Enclosures::new(), unproven: 0 }
    }

    /// Files what a pattern admits.
    pub(super) fn examine(&mut self, mut pattern: Vec<ContactState>) -> Result<(), StopReason> {
        let outcome = self.findings.examine_leaf(&mut pattern).map_err(|_| StopReason::SolutionLimit)?;
        let verdict = match &self.proofs {
            Proofs::None => None,
            Proofs::Exact(loaded) => Some(decide(&loaded.problem, &pattern)),
            Proofs::Within(problem) => Some(decide(problem.as_ref(), &pattern)),
        };
        match verdict.map(|verdict| verdict.decision).filter(|decision| confirms(decision, &outcome)) {
            None => self.unproven += 1,
            Some(Decision::Solution { unknowns, .. } | Decision::Boundary { unknowns, .. }) => {
                self.enclosures.insert(pattern, unknowns);
            }
            Some(_) => {}
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

    pub(super) fn into_findings(self) -> (Findings<'a>, Enclosures) {
        (self.findings, self.enclosures)
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
