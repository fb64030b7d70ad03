//! The findings as they are reported: states that are the same are listed once, and those that are part of
//! others are marked.

use std::collections::{BTreeSet, HashMap, HashSet};

use crate::findings::candidate::{Candidate, solve_pattern};
use crate::findings::collection::{Findings, canonical};
use crate::findings::degenerate::same_point;
use crate::findings::found::{Found, gaps_in, sides};
use crate::problem::{ContactState, SolutionSet};
use crate::solutions::{
    ClosestMode, ContactSet, GapState, ModeSolution, SingularMode, Solutions, Support, oriented,
};

impl Findings<'_> {
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
    ///
    /// If singular patterns admit one state only and a regular one gives the same, it is that of the fewest gaps, and
    /// of as many, the regular one, which has bounds. The singular ones are dropped then.
    fn known_exactly(&mut self, gaps: &[Found], ordinary: &[Found]) -> Vec<bool> {
        let support = |found: &Found| found.support(&self.problem.has_jump);
        let sets = || self.singular.iter().map(|mode| &mode.support);
        let states = self.singular.iter().filter(|mode| is_one_state(mode));
        let states: HashMap<&Support, usize> =
            states.map(|mode| (&mode.support, gaps_in(&mode.pattern))).collect();
        let other_sets = sets().filter(|set| !states.contains_key(set)).cloned();
        let mut reported: HashSet<Support> = ordinary.iter().map(support).chain(other_sets).collect();
        let mut order: Vec<usize> = (0..gaps.len()).collect();
        order.sort_by_key(|&at| gaps[at].gaps());
        let mut known = vec![false; gaps.len()];
        let mut in_place_of_singular = HashSet::new();
        for at in order {
            let own = support(&gaps[at]);
            let is_end = !gaps[at].candidate.at_end.is_empty();
            let singular = states.get(&own);
            known[at] = is_end && sets().any(|set| own.is_part_of(set))
                || singular.is_some_and(|&gaps_there| gaps_there < gaps[at].gaps())
                || !reported.insert(own.clone());
            if !known[at] && singular.is_some() {
                in_place_of_singular.insert(own);
            }
        }
        self.singular.retain(|mode| !in_place_of_singular.contains(&mode.support));
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

/// Whether a singular pattern admits one state only.
fn is_one_state(mode: &SingularMode) -> bool {
    matches!(mode.set, SolutionSet::Point(_)) && !mode.shares_vary
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
