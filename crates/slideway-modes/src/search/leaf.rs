//! The outcome of single patterns, and whether it is proven.

use super::load::LoadedProblem;
use super::monitor::Monitor;
use super::product::{CombinedState, GroupState};
use super::relaxation::Relaxation;
use super::report::StopReason;
use super::states::StateSet;
use crate::certificate::{Decision, ExactSolution, decide_while, proves_empty_while};
use crate::findings::{Filed, Findings, Found};
use crate::problem::{ContactState, SolutionSet};
use crate::solutions::Certificate;

/// Decides patterns one by one.
pub(super) struct Leaves<'a> {
    problem: &'a LoadedProblem<'a>,
    findings: Findings<'a>,
    certify: bool,
    /// Patterns whose outcome is not proven.
    unproven: u64,
    decided_jointly: bool,
    /// How many states, and how many singular sets, the caller knows.
    told: (usize, usize),
}

impl<'a> Leaves<'a> {
    /// Patterns of `problem`, whose scaled form is in `findings`.
    pub(super) fn new(problem: &'a LoadedProblem<'a>, findings: Findings<'a>, certify: bool) -> Self {
        let exact = certify && problem.is_part_of_exact_problem();
        let findings = if exact { findings.exact() } else { findings };
        Self { problem, findings, certify, unproven: 0, decided_jointly: false, told: (0, 0) }
    }

    /// Nothing yet, for the same problem.
    pub(super) fn another(&self) -> Self {
        let findings = self.findings.another();
        Self { findings, unproven: 0, decided_jointly: false, told: (0, 0), ..*self }
    }

    /// Adds what was found and reported elsewhere.
    pub(super) fn absorb(&mut self, other: Self) -> Result<(), StopReason> {
        self.unproven += other.unproven;
        self.decided_jointly |= other.decided_jointly;
        let absorbed = self.findings.absorb(other.findings).map_err(|_| StopReason::SolutionLimit);
        self.count_as_told();
        absorbed
    }

    /// Tells the states that are proven and new, if the caller wants them.
    pub(super) fn tell(&mut self, monitor: &mut Monitor<'_>) {
        if !monitor.wants_states() || !self.findings.is_exact() {
            return;
        }
        let contacts: Vec<usize> = (0..self.findings.problem.contacts()).collect();
        let (found, singular) = self.findings.after(self.told);
        let has_jump = &self.findings.problem.has_jump;
        let found = found.iter().filter(|found| found.certificate != Certificate::NotProven);
        let sets = singular
            .iter()
            .filter(|mode| mode.certificate != Certificate::NotProven && mode.set != SolutionSet::Empty);
        let states = found.map(|found| state_of(found, has_jump));
        for state in states.chain(sets.map(|mode| GroupState::Singular(mode.clone()))) {
            monitor.tell_state(&CombinedState { parts: vec![(&contacts, &state)] });
        }
        self.count_as_told();
    }

    fn count_as_told(&mut self) {
        let (found, singular) = self.findings.after((0, 0));
        self.told = (found.len(), singular.len());
    }

    /// Records what a pattern admits; the search ends if that is enough.
    pub(super) fn examine(
        &mut self,
        pattern: &[ContactState],
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        self.record(pattern, monitor)?;
        if self.findings.has_enough() { Err(StopReason::SolutionLimit) } else { Ok(()) }
    }

    /// [`examine`](Self::examine) for a pattern that is decided already, by [`decide`](Self::decide).
    pub(super) fn examine_decided(
        &mut self,
        pattern: &[ContactState],
        decision: Decision,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        self.record_decided(pattern, decision, monitor)?;
        if self.findings.has_enough() { Err(StopReason::SolutionLimit) } else { Ok(()) }
    }

    /// Records what a pattern admits.
    pub(super) fn record(
        &mut self,
        pattern: &[ContactState],
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        if !self.certify {
            return self.examine_within_tolerances(pattern, monitor);
        }
        // Rational arithmetic would take too long for very many patterns.
        if self.findings.has_examined_enough() && self.findings.is_suspect(pattern, &mut || monitor.goes_on())
        {
            self.findings.leave_unexamined(pattern, pattern.len());
            return Ok(());
        }
        let decision = self.decide(pattern, monitor)?;
        self.record_decided(pattern, decision, monitor)
    }

    fn record_decided(
        &mut self,
        pattern: &[ContactState],
        decision: Decision,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        if matches!(decision, Decision::Undecided { .. })
            && self.is_infeasible(pattern, &mut || monitor.goes_on())
        {
            self.exclude(pattern);
            return Ok(());
        }
        self.file(pattern, decision, monitor)
    }

    /// Whether the linear program of a pattern has no solution for any values within bounds, proven by a
    /// Farkas vector.
    ///
    /// This decides patterns whose determinant is zero in theory, such as that of a block with both ends in
    /// their preload gaps: both differences `d_k^+ - d_k^-` are couples `h F_k0`, parallel except for
    /// rounding. Shares are from 0 to 1, so such columns reach nothing across their common direction. `false`
    /// once `proceed` is `false`.
    fn is_infeasible(&self, pattern: &[ContactState], proceed: &mut dyn FnMut() -> bool) -> bool {
        let problem = self.findings.problem;
        let load_radius = problem.scaled_load_radius(&self.problem.right_hand_side_radius());
        let relaxation = Relaxation::new(problem, &load_radius, vec![f64::INFINITY; pattern.len()]);
        let states: Vec<StateSet> = pattern.iter().map(|&state| StateSet::only(state)).collect();
        let Some(farkas) = relaxation.farkas(&states, proceed) else { return false };
        let decided: Vec<Option<ContactState>> = pattern.iter().copied().map(Some).collect();
        let weights: Vec<f64> = problem.unscaled_rows(&farkas).iter().map(|entry| -entry).collect();
        proves_empty_while(self.problem.view(), &decided, &weights, proceed)
    }

    /// Where errors of the right-hand side leave a pattern open although all given numbers are exact, it is
    /// decided together with the contacts that determine the right-hand side.
    pub(super) fn decide(
        &mut self,
        pattern: &[ContactState],
        monitor: &mut Monitor<'_>,
    ) -> Result<Decision, StopReason> {
        let mut proceed = || monitor.goes_on();
        let verdict = decide_while(self.problem.view(), pattern, &mut proceed);
        let mut decision = verdict.map(|verdict| verdict.decision);
        let open = matches!(decision, Some(Decision::Undecided { .. }));
        if open && self.problem.is_part_of_exact_problem() {
            self.decided_jointly = true;
            decision = self.problem.decide_jointly(pattern, &mut proceed).or(decision);
        }
        match monitor.stopped() {
            Some(reason) => Err(reason),
            None => decision.ok_or(StopReason::Cancelled),
        }
    }

    /// The solution of a pattern's equations, for the numbers as given; `None` if they are singular, or if the monitor stops.
    pub(super) fn solve_exactly(
        &self,
        pattern: &[ContactState],
        monitor: &mut Monitor<'_>,
    ) -> Option<ExactSolution> {
        ExactSolution::of_pattern(self.problem.view().centre, pattern, &mut || monitor.goes_on())
    }

    /// Records a pattern according to its decision.
    fn file(
        &mut self,
        pattern: &[ContactState],
        decision: Decision,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        let undecided = matches!(decision, Decision::Undecided { .. });
        if undecided && self.problem.is_part_of_exact_problem() {
            return self.examine_within_tolerances(pattern, monitor);
        }
        let filed = self.findings.file_decision(pattern, decision, &mut || monitor.goes_on());
        let filed = filed.map_err(|_| StopReason::SolutionLimit)?;
        self.unproven += u64::from(filed == Filed::NotProven);
        self.tell(monitor);
        Ok(())
    }

    fn examine_within_tolerances(
        &mut self,
        pattern: &[ContactState],
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        self.unproven += 1;
        let examined = self.findings.examine_leaf(pattern, &mut || monitor.goes_on());
        examined.map_err(|_| StopReason::SolutionLimit)
    }

    /// Records the only pattern that can have a solution. Returns `false`, and records nothing, if it is not
    /// certain that the pattern has a solution for all values within bounds.
    pub(super) fn examine_only(
        &mut self,
        pattern: &[ContactState],
        monitor: &mut Monitor<'_>,
    ) -> Result<bool, StopReason> {
        if !self.certify {
            return self.examine_within_tolerances(pattern, monitor).map(|()| true);
        }
        let decision = self.decide(pattern, monitor)?;
        let certain = matches!(decision, Decision::Solution { .. } | Decision::Boundary { .. });
        if certain { self.file(pattern, decision, monitor).map(|()| true) } else { Ok(false) }
    }

    /// Counts a pattern that is proven to have no solution.
    pub(super) fn exclude(&mut self, pattern: &[ContactState]) {
        self.findings.count_no_solution(pattern.contains(&ContactState::Gap));
    }

    /// Whether there is a solution without gaps.
    pub(super) fn has_solutions(&self) -> bool {
        self.findings.has_solutions()
    }

    /// Offers a pattern as one of those closest to locking.
    pub(super) fn offer_closest(&mut self, pattern: &[ContactState]) {
        self.findings.offer_if_regular(pattern);
    }

    /// Number of solutions, gap states, singular sets and undecided patterns found so far.
    pub(super) fn found(&self) -> usize {
        self.findings.found()
    }

    /// Whether some pattern was decided together with the contacts that determine the right-hand side.
    pub(super) fn depends_on_ancestors(&self) -> bool {
        self.decided_jointly
    }

    pub(super) fn unproven(&self) -> u64 {
        self.unproven
    }

    pub(super) fn into_findings(self) -> Findings<'a> {
        self.findings
    }
}

/// A state while it is being collected.
fn state_of(found: &Found, has_jump: &[bool]) -> GroupState {
    if found.has_gap() {
        GroupState::Gap(found.clone().into_gap_state(has_jump))
    } else {
        GroupState::Solution(found.clone().into_mode_solution(has_jump))
    }
}
