//! Collects what the tree finds: merges solutions that several patterns share, and counts every pattern.

use std::collections::HashMap;

use crate::findings::admitted::Admitted;
use crate::findings::candidate::{Candidate, determinant, solve_pattern};
use crate::findings::degenerate::{Examined, examine};
use crate::findings::found::Found;
use crate::problem::{ContactState, ScaledProblem};
use crate::solutions::{
    Certificate, ContactSet, Limits, PatternCounts, SingularMode, Support, UndecidedPattern,
};

/// Number of patterns close to locking that are reported.
const CLOSEST: usize = 4;
/// A pattern whose matrix has a condition number above this may be singular.
pub(crate) const SUSPECT_CONDITION: f64 = 1e7;

/// More solutions than [`Limits::solutions`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct TooManySolutions {
    pub(crate) limit: usize,
}

/// The common part of patterns with the same boundary solution: the states of the contacts that are not free
/// to change sides, and which contacts are free.
#[derive(PartialEq, Eq, Hash)]
struct SharedPattern {
    states: Vec<ContactState>,
    free: ContactSet,
}

pub(crate) struct Findings<'a> {
    pub(crate) problem: &'a ScaledProblem,
    pub(crate) limits: Limits,
    pub(super) counts: PatternCounts,
    pub(super) gap_counts: PatternCounts,
    pub(super) found: Vec<Found>,
    shared: HashMap<SharedPattern, usize>,
    pub(super) singular: Vec<SingularMode>,
    /// Indices in `singular` of nonempty sets. The sets that patterns admit are faces of one polyhedron, so
    /// those with the same support are equal.
    singular_places: HashMap<Support, usize>,
    pub(crate) undecided: Vec<UndecidedPattern>,
    /// Whether findings are exact apart from rounding, so that nothing is merged within tolerances.
    pub(super) exact: bool,
    pub(crate) examined: usize,
    pub(crate) bases: u64,
    pub(super) closest: Vec<(f64, Vec<ContactState>)>,
}

impl<'a> Findings<'a> {
    pub(crate) fn new(problem: &'a ScaledProblem, limits: &Limits) -> Self {
        Self {
            problem,
            limits: *limits,
            counts: PatternCounts::default(),
            gap_counts: PatternCounts::default(),
            found: Vec::new(),
            shared: HashMap::new(),
            singular: Vec::new(),
            singular_places: HashMap::new(),
            undecided: Vec::new(),
            exact: false,
            examined: 0,
            bases: limits.bases,
            closest: Vec::with_capacity(CLOSEST + 1),
        }
    }

    /// Nothing yet, for the same problem.
    pub(crate) fn another(&self) -> Self {
        Self { exact: self.exact, ..Self::new(self.problem, &self.limits) }
    }

    /// Adds what was found elsewhere in the same problem.
    pub(crate) fn absorb(&mut self, other: Self) -> Result<(), TooManySolutions> {
        self.counts.add(&other.counts);
        self.gap_counts.add(&other.gap_counts);
        self.examined += other.examined;
        for (determinant, pattern) in other.closest {
            self.offer_closest(&pattern, determinant);
        }
        self.undecided.extend(other.undecided);
        for mode in other.singular {
            self.add_singular(mode);
        }
        for found in other.found {
            self.add(found);
            self.check_limit()?;
        }
        Ok(())
    }

    /// Whether the maximum number of (nearly) singular patterns has been examined.
    pub(crate) fn has_examined_enough(&self) -> bool {
        self.examined >= self.limits.singular
    }

    /// Whether a pattern may be singular, within tolerances; also `true` once `proceed` is `false`.
    pub(crate) fn is_suspect(&self, pattern: &[ContactState], proceed: &mut dyn FnMut() -> bool) -> bool {
        solve_pattern(self.problem, pattern, proceed).is_none_or(|found| found.condition >= SUSPECT_CONDITION)
    }

    /// Whether findings are exact apart from rounding.
    pub(crate) fn is_exact(&self) -> bool {
        self.exact
    }

    /// Everything recorded is proven for exact data: nothing is merged within tolerances.
    pub(crate) fn exact(self) -> Self {
        Self { exact: true, ..self }
    }

    pub(crate) fn counts_of(&mut self, pattern: &[ContactState]) -> &mut PatternCounts {
        if pattern.contains(&ContactState::Gap) { &mut self.gap_counts } else { &mut self.counts }
    }

    /// Number of solutions, gap states and singular sets found so far.
    pub(crate) fn found(&self) -> usize {
        self.found.len() + self.singular.len() + self.undecided.len()
    }

    /// The solutions and gap states, and the singular sets, after the first so many of each, in the order in which they
    /// were found.
    pub(crate) fn after(&self, (found, singular): (usize, usize)) -> (&[Found], &[SingularMode]) {
        (&self.found[found.min(self.found.len())..], &self.singular[singular.min(self.singular.len())..])
    }

    /// Sorts the findings into the order of enumeration, whatever the order in which they were found.
    pub(crate) fn sort(&mut self) {
        self.found.sort_by(|one, other| one.pattern().cmp(other.pattern()));
        self.singular.sort_by(|one, other| one.pattern.cmp(&other.pattern));
        self.undecided.sort_by(|one, other| one.pattern.cmp(&other.pattern));
    }

    pub(crate) fn count_no_solution(&mut self, with_gap: bool) {
        let counts = if with_gap { &mut self.gap_counts } else { &mut self.counts };
        counts.no_solution += 1;
    }

    /// Whether there is a solution without gaps.
    pub(crate) fn has_solutions(&self) -> bool {
        self.found.iter().any(|found| !found.has_gap())
    }

    /// Whether one solution is enough and there is one, or a set of them without gaps.
    pub(crate) fn has_enough(&self) -> bool {
        let is_set =
            |mode: &SingularMode| mode.set.has_points() && !mode.pattern.contains(&ContactState::Gap);
        self.limits.solutions == 1 && (self.has_solutions() || self.singular.iter().any(is_set))
    }

    /// Keeps a pattern that was not found to be singular if its determinant is among the smallest.
    pub(crate) fn offer_if_regular(&mut self, pattern: &[ContactState]) {
        let is_it = |other: &Vec<ContactState>| other == pattern;
        if !self.singular.iter().any(|mode| mode.patterns.iter().any(is_it)) {
            let determinant = determinant(self.problem, pattern, &mut || true);
            determinant.into_iter().for_each(|determinant| self.offer_closest(pattern, determinant));
        }
    }

    /// Keeps a regular pattern if its determinant is among the smallest.
    pub(crate) fn offer_closest(&mut self, pattern: &[ContactState], determinant: f64) {
        let size = determinant.abs();
        if self.closest.last().is_some_and(|(largest, _)| self.closest.len() == CLOSEST && size >= *largest) {
            return;
        }
        let at = self.closest.partition_point(|(other, _)| *other <= size);
        self.closest.insert(at, (size, pattern.to_vec()));
        self.closest.truncate(CLOSEST);
    }

    /// Solves a pattern carefully and records its outcome.
    pub(crate) fn examine_candidate(
        &mut self,
        pattern: &[ContactState],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<(), TooManySolutions> {
        let Some(candidate) = solve_pattern(self.problem, pattern, proceed) else {
            self.counts_of(pattern).not_examined += 1;
            return Ok(());
        };
        self.file_candidate(pattern, candidate)
    }

    /// Decides one pattern: solved carefully if it is well-conditioned, otherwise examined more closely. What
    /// a singular pattern admits is left open once `proceed` is `false`.
    pub(crate) fn examine_leaf(
        &mut self,
        pattern: &[ContactState],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<(), TooManySolutions> {
        match solve_pattern(self.problem, pattern, proceed) {
            Some(candidate) if candidate.condition < SUSPECT_CONDITION => {
                self.file_candidate(pattern, candidate)
            }
            _ if self.has_examined_enough() => {
                self.leave_unexamined(pattern, pattern.len());
                Ok(())
            }
            _ => self.examine_suspect(pattern, proceed),
        }
    }

    /// Examines a pattern that may be singular more closely.
    pub(crate) fn examine_suspect(
        &mut self,
        pattern: &[ContactState],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<(), TooManySolutions> {
        self.examined += 1;
        match examine(self.problem, pattern, &mut self.bases, proceed) {
            Examined::Regular => self.examine_candidate(pattern, proceed),
            Examined::Singular(admitted) => {
                self.file_singular(pattern, admitted, Certificate::NotProven);
                Ok(())
            }
        }
    }

    fn file_candidate(
        &mut self,
        pattern: &[ContactState],
        candidate: Candidate,
    ) -> Result<(), TooManySolutions> {
        let counts = self.counts_of(pattern);
        if !candidate.admissible {
            counts.no_solution += 1;
            return Ok(());
        }
        self.file_admissible(pattern, candidate, Certificate::NotProven)?;
        Ok(())
    }

    /// Records a solution.
    pub(crate) fn file_admissible(
        &mut self,
        pattern: &[ContactState],
        candidate: Candidate,
        certificate: Certificate,
    ) -> Result<(), TooManySolutions> {
        let counts = self.counts_of(pattern);
        let in_doubt = matches!(certificate, Certificate::OnBoundaryWithinBounds { .. });
        if candidate.zero.is_empty() && candidate.at_end.is_empty() && !in_doubt {
            counts.solution += 1;
        } else {
            counts.boundary += 1;
        }
        self.add(Found::new(pattern, candidate, certificate));
        self.check_limit()
    }

    /// Drops the latest state if there are too many.
    fn check_limit(&mut self) -> Result<(), TooManySolutions> {
        if self.found.len() > self.limits.solutions {
            self.found.pop();
            let known = self.found.len();
            self.shared.retain(|_, index| *index < known);
            return Err(TooManySolutions { limit: self.limits.solutions });
        }
        Ok(())
    }

    fn add(&mut self, new: Found) {
        let free = self.free_contacts(&new.candidate);
        let key = SharedPattern { states: canonical(new.pattern(), &free), free };
        match self.shared.get(&key) {
            // Contacts that are exactly zero drop out of the equations, and the other contacts have the same
            // equations.
            Some(&index) if self.exact || self.found[index].agrees_with(&new) => {
                self.found[index].absorb(new, self.limits.listed);
            }
            _ => {
                self.shared.insert(key, self.found.len());
                self.found.push(new);
            }
        }
    }

    /// Contacts with `y_k = 0` at which the right-hand side does not jump: they may be on either side.
    pub(super) fn free_contacts(&self, candidate: &Candidate) -> ContactSet {
        let mut free = candidate.zero.clone();
        let jumps = self.problem.has_jump.iter().enumerate().filter(|(_, jump)| **jump);
        jumps.for_each(|(contact, _)| free.remove(contact));
        free
    }

    pub(crate) fn leave_unexamined(&mut self, pattern: &[ContactState], first: usize) {
        let (pressed, all) = self.problem.patterns_from(first);
        if pattern[..first].contains(&ContactState::Gap) {
            self.gap_counts.not_examined += all;
        } else {
            self.counts.not_examined += pressed;
            self.gap_counts.not_examined += all - pressed;
        }
    }

    pub(crate) fn file_singular(
        &mut self,
        pattern: &[ContactState],
        Admitted { set, support, shares, shares_vary }: Admitted,
        certificate: Certificate,
    ) {
        self.counts_of(pattern).count_set(&set);
        self.add_singular(SingularMode {
            pattern: pattern.to_vec(),
            patterns: vec![pattern.to_vec()],
            pattern_count: 1,
            set,
            shares,
            shares_vary,
            contains: Vec::new(),
            maximal: true,
            support,
            certificate,
        });
    }

    /// Records a singular pattern, or those that admit the same set.
    fn add_singular(&mut self, new: SingularMode) {
        if new.set.has_points() {
            if let Some(&place) = self.singular_places.get(&new.support) {
                let mode = &mut self.singular[place];
                mode.pattern_count += new.pattern_count;
                let room = self.limits.listed.saturating_sub(mode.patterns.len());
                mode.patterns.extend(new.patterns.into_iter().take(room));
                return;
            }
            self.singular_places.insert(new.support.clone(), self.singular.len());
        }
        self.singular.push(new);
    }
}

/// The pattern with all free contacts on their positive side.
pub(super) fn canonical(pattern: &[ContactState], free: &ContactSet) -> Vec<ContactState> {
    let state = |(contact, &state)| if free.contains(contact) { ContactState::Positive } else { state };
    pattern.iter().enumerate().map(state).collect()
}
