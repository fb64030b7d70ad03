//! Collects what the tree finds: merges solutions that several patterns share, and counts every pattern.

use std::collections::{BTreeSet, HashMap, HashSet};

use crate::findings::admitted::Admitted;
use crate::findings::candidate::{Candidate, determinant, solve_pattern};
use crate::findings::degenerate::{Examined, examine, same_point};
use crate::findings::found::{Found, sides};
use crate::problem::{ContactState, ScaledProblem};
use crate::solutions::{
    Certificate, ClosestMode, ContactSet, GapState, Limits, ModeSolution, PatternCounts, SingularMode,
    Solutions, Support, UndecidedPattern, oriented,
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

/// What patterns with the same boundary solution have in common: the states of the contacts that are not free
/// to change sides, and which contacts are free.
#[derive(PartialEq, Eq, Hash)]
struct SharedPattern {
    states: Vec<ContactState>,
    free: ContactSet,
}

pub(crate) struct Findings<'a> {
    pub(crate) problem: &'a ScaledProblem,
    pub(crate) limits: Limits,
    counts: PatternCounts,
    gap_counts: PatternCounts,
    found: Vec<Found>,
    shared: HashMap<SharedPattern, usize>,
    singular: Vec<SingularMode>,
    /// Indices in `singular` of nonempty sets. The sets that patterns admit are faces of one polyhedron, so
    /// those with the same support are equal.
    singular_places: HashMap<Support, usize>,
    pub(crate) undecided: Vec<UndecidedPattern>,
    /// Whether findings are exact apart from rounding, so that nothing is merged within tolerances.
    exact: bool,
    pub(crate) examined: usize,
    pub(crate) bases: u64,
    closest: Vec<(f64, Vec<ContactState>)>,
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

    /// Counts a regular pattern of a problem without loads, once its solution `y = 0` has been found. Returns
    /// `false` if it has not been found, or if there are loads.
    pub(crate) fn count_unloaded(&mut self, pattern: &[ContactState]) -> bool {
        let [zero] = &mut self.found[..] else { return false };
        if self.problem.load_size().amax() != 0.0 {
            return false;
        }
        self.counts.boundary += 1;
        zero.pattern_count += 1;
        if zero.patterns.len() < self.limits.listed {
            zero.patterns.push(pattern.to_vec());
        }
        true
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
    fn free_contacts(&self, candidate: &Candidate) -> ContactSet {
        let mut free = candidate.zero.clone();
        let jumps = self.problem.has_jump.iter().enumerate().filter(|(_, jump)| **jump);
        jumps.for_each(|(contact, _)| free.remove(contact));
        free
    }

    /// Examines individually all patterns with the given states of the contacts before `first`.
    pub(crate) fn examine_all_below(
        &mut self,
        pattern: &mut [ContactState],
        first: usize,
    ) -> Result<(), TooManySolutions> {
        if self.has_examined_enough() {
            self.leave_unexamined(pattern, first);
            return Ok(());
        }
        if first < pattern.len() {
            for &state in self.problem.states(first) {
                pattern[first] = state;
                self.examine_all_below(pattern, first + 1)?;
            }
            return Ok(());
        }
        self.examine_suspect(pattern, &mut || true)
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

    pub(crate) fn into_solutions(mut self) -> Solutions {
        if !self.exact {
            self.merge_neighbours();
        }
        let (gaps, ordinary): (Vec<Found>, Vec<Found>) =
            std::mem::take(&mut self.found).into_iter().partition(Found::has_gap);
        let known = if self.exact {
            self.known_exactly(&gaps, &ordinary)
        } else {
            gaps.iter().map(|gap| self.is_known(gap, &ordinary, &gaps)).collect()
        };
        let mut new_gaps = Vec::new();
        for (gap, known) in gaps.into_iter().zip(known) {
            if known {
                self.undecided.extend(gap.into_undecided());
            } else {
                new_gaps.push(gap.into_gap_state(&self.problem.has_jump));
            }
        }
        let mut gaps = new_gaps;
        let solution = |found: Found| found.into_mode_solution(&self.problem.has_jump);
        let mut solutions: Vec<ModeSolution> = ordinary.into_iter().map(solution).collect();
        let mut singular = std::mem::take(&mut self.singular);
        for mode in &mut singular {
            let vertices = mode.set.vertices();
            let is_vertex = |solution: &ModeSolution| {
                if self.exact {
                    mode.set.has_points() && solution.support.is_within(&mode.support)
                } else {
                    vertices.iter().any(|vertex| same_point(vertex, &solution.normal_force))
                }
            };
            let contained = solutions.iter().enumerate().filter(|(_, solution)| is_vertex(solution));
            let contained = contained.map(|(index, _)| index).collect();
            mode.contains = contained;
        }
        mark_parts(&mut solutions, &mut gaps, &mut singular);
        let closest = if solutions.is_empty() { self.closest_modes() } else { Vec::new() };
        let (counts, gap_counts, undecided) = (self.counts, self.gap_counts, self.undecided);
        Solutions { counts, gap_counts, solutions, gaps, singular, undecided, closest }
    }

    /// Merges boundary solutions with the solution of a neighbour that was not quite on the boundary within
    /// its own tolerance.
    fn merge_neighbours(&mut self) {
        let merged = self.merging_neighbours();
        if merged.iter().all(Option::is_none) {
            return;
        }
        let mut kept: Vec<Found> = Vec::with_capacity(self.found.len());
        let mut places = Vec::with_capacity(self.found.len());
        for (found, merged) in std::mem::take(&mut self.found).into_iter().zip(merged) {
            if let Some(into) = merged {
                let place: usize = places[into];
                kept[place].absorb(found, self.limits.listed);
                places.push(place);
            } else {
                places.push(kept.len());
                kept.push(found);
            }
        }
        self.found = kept;
    }

    /// For each finding, an earlier one with which it agrees and from which it differs only in contacts that
    /// are free in one of the two.
    fn merging_neighbours(&self) -> Vec<Option<usize>> {
        let free: Vec<ContactSet> =
            self.found.iter().map(|found| self.free_contacts(&found.candidate)).collect();
        let masks: BTreeSet<&ContactSet> = free.iter().filter(|mask| !mask.is_empty()).collect();
        let mut merged: Vec<Option<usize>> = vec![None; self.found.len()];
        for mask in masks {
            let mut groups: HashMap<Vec<ContactState>, Vec<usize>> = HashMap::new();
            for (index, found) in self.found.iter().enumerate() {
                let group = groups.entry(canonical(found.pattern(), mask)).or_default();
                let earlier = group.iter().copied().find(|&earlier| {
                    (&free[earlier] == mask || &free[index] == mask) && self.found[earlier].agrees_with(found)
                });
                merged[index] = merged[index].or(earlier);
                group.push(index);
            }
        }
        merged
    }

    /// Which gap states are already reported: as a solution, as what a singular pattern admits, as a gap state with
    /// fewer gaps, or, with a share of 0 or 1, as a vertex of a set. Faces with the same support are equal.
    fn known_exactly(&self, gaps: &[Found], ordinary: &[Found]) -> Vec<bool> {
        let support = |found: &Found| found.support(&self.problem.has_jump);
        let sets = || self.singular.iter().map(|mode| &mode.support);
        let mut reported: HashSet<Support> = ordinary.iter().map(support).chain(sets().cloned()).collect();
        let mut order: Vec<usize> = (0..gaps.len()).collect();
        order.sort_by_key(|&at| gaps[at].gaps());
        let mut known = vec![false; gaps.len()];
        for at in order {
            let own = support(&gaps[at]);
            let is_end = !gaps[at].candidate.at_end.is_empty();
            known[at] = is_end && sets().any(|set| own.is_part_of(set)) || !reported.insert(own);
        }
        known
    }

    /// Whether a gap state with a share of 0 or 1 is already reported, within tolerances: as a solution, as a gap
    /// state with fewer gaps, or as a vertex of what a singular pattern admits.
    fn is_known(&self, gap: &Found, ordinary: &[Found], gaps: &[Found]) -> bool {
        if gap.candidate.at_end.is_empty() {
            return false;
        }
        let mut vertices = self.singular.iter().flat_map(|mode| mode.set.vertices());
        let ends_at = |other: &Found| gap.closes_to(other, &self.problem.has_jump) && gap.agrees_with(other);
        ordinary.iter().chain(gaps).any(ends_at)
            || vertices.any(|vertex| same_point(vertex, &gap.normal_force))
    }

    fn closest_modes(&self) -> Vec<ClosestMode> {
        let solved = self.closest.iter().filter_map(|(_, pattern)| {
            let Candidate { unknowns, determinant, .. } = solve_pattern(self.problem, pattern, &mut || true)?;
            let pattern = sides(pattern);
            let oriented_determinant = oriented(determinant, &pattern);
            Some(ClosestMode { pattern, determinant, oriented_determinant, y: unknowns })
        });
        solved.collect()
    }
}

/// Marks states that are part of a larger set.
fn mark_parts(solutions: &mut [ModeSolution], gaps: &mut [GapState], singular: &mut [SingularMode]) {
    let sets = singular.iter().filter(|mode| mode.set.is_continuum() || mode.shares_vary);
    let mut supports: Vec<&Support> = sets.map(|mode| &mode.support).collect();
    supports.sort_by_key(|support| std::cmp::Reverse(support.len()));
    let mut largest: Vec<Support> = Vec::new();
    for support in supports {
        if !largest.iter().any(|other| support.is_part_of(other)) {
            largest.push(support.clone());
        }
    }
    let is_maximal = |support: &Support| !largest.iter().any(|other| support.is_part_of(other));
    solutions.iter_mut().for_each(|solution| solution.maximal = is_maximal(&solution.support));
    gaps.iter_mut().for_each(|gap| gap.maximal = is_maximal(&gap.support));
    singular.iter_mut().for_each(|mode| mode.maximal = is_maximal(&mode.support));
}

/// The pattern with all free contacts on their positive side.
fn canonical(pattern: &[ContactState], free: &ContactSet) -> Vec<ContactState> {
    let state = |(contact, &state)| if free.contains(contact) { ContactState::Positive } else { state };
    pattern.iter().enumerate().map(state).collect()
}
