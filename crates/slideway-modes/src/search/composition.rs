//! Solves connected groups of contacts one after the other and combines their solutions.

use std::collections::HashMap;
use std::sync::Arc;

use super::count::BigCount;
use super::group::{GroupAnswer, search_group};
use super::groups::Groups;
use super::load::{Load, LoadedProblem};
use super::monitor::Monitor;
use super::product::{Alternative, Factor, GroupState, SolutionProduct};
use super::report::{GroupReport, SearchOptions};
use crate::interval::Interval;
use crate::problem::{ContactState, ProblemView, Side, SolutionSet};
use crate::solutions::{Certificate, Limits, SingularMode, Solutions, UndecidedPattern};

/// Maximum number of group answers that are kept for reuse with the same right-hand side.
const MOST_KEPT: usize = 10_000;

/// A group is barren if it admits nothing for more than half of more right-hand sides than this.
const BARREN_FROM: u64 = 64;

/// A piece of the work: the fraction done before it, and the fraction that it makes up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) done: f64,
    pub(super) share: f64,
}

/// Ends an attempt to solve groups one after the other once it has visited so many nodes and some group is barren.
const UNTIL_BARREN: u64 = 1000;

/// A group's contacts and the right-hand side of its equations, bit by bit.
type GroupKey = (Vec<usize>, Vec<u64>);

pub(super) struct Composer<'p, 'm, 'c> {
    problem: ProblemView<'p>,
    options: &'p SearchOptions,
    groups: &'p Groups,
    monitor: &'m mut Monitor<'c>,
    /// Whether to give up once there is a barren group.
    until_barren: bool,
    first_node: u64,
    solved: HashMap<GroupKey, Arc<SolvedGroup>>,
    /// Reports of all groups; those of one group with several right-hand sides are added up.
    pub(super) reports: Vec<GroupReport>,
    /// Whether every solution that other groups depend on is enclosed by proof.
    pub(super) chain_proven: bool,
    pub(super) all_examined: bool,
}

impl<'p, 'm, 'c> Composer<'p, 'm, 'c> {
    pub(super) fn new(
        problem: ProblemView<'p>,
        options: &'p SearchOptions,
        groups: &'p Groups,
        monitor: &'m mut Monitor<'c>,
        until_barren: bool,
    ) -> Self {
        Self {
            first_node: monitor.nodes(),
            problem,
            options,
            groups,
            monitor,
            until_barren,
            solved: HashMap::new(),
            reports: Vec::new(),
            chain_proven: true,
            all_examined: true,
        }
    }

    /// The solutions of some groups, given in increasing order, where `load` is the right-hand side including
    /// everything that acts on them.
    fn solve_groups(&mut self, groups: &[usize], load: &Load, work: Piece) -> SolutionProduct {
        let contacts = |part: &[usize]| -> usize { part.iter().map(|&g| self.groups.members[g].len()).sum() };
        let total = contacts(groups).max(1) as f64;
        let parts: Vec<(Vec<usize>, f64)> = self
            .groups
            .independent_parts(groups)
            .into_iter()
            .map(|part| {
                let share = work.share * contacts(&part) as f64 / total;
                (part, share)
            })
            .collect();
        let mut product = SolutionProduct::default();
        let (mut done, mut is_barren, mut enough) = (work.done, false, false);
        let enough_before = self.monitor.take_enough();
        for (part, share) in parts {
            let factor = self.solve_part(&part, load, Piece { done, share });
            let ended_early = self.monitor.take_enough();
            is_barren |= factor.alternatives.is_empty() && !ended_early;
            enough |= ended_early;
            product.factors.push(factor);
            done += share;
        }
        // If one part has no solution, none is missing in the others.
        self.monitor.add_enough(enough_before || (enough && !is_barren));
        product
    }

    /// The solutions of connected groups: those of the first, and for each of them those of the others.
    pub(super) fn solve_part(&mut self, part: &[usize], load: &Load, work: Piece) -> Factor {
        let rest = &part[1..];
        let first = self.groups.members[part[0]].clone();
        let part_size: usize = part.iter().map(|&group| self.groups.members[group].len()).sum();
        let own = work.share * first.len() as f64 / part_size.max(1) as f64;
        self.monitor.start_group(work.done, own);
        let answer = self.solve_group(&first, load, rest.is_empty());
        if rest.is_empty() {
            return Factor { alternatives: answer.alternatives(), contacts: first };
        }
        let left = Piece { done: work.done + own, share: work.share - own };
        if answer.admits_sets {
            // The others would have to be solved for a whole set of loads.
            return self.solve_together(part, load, left);
        }
        let share = left.share / answer.states.len().max(1) as f64;
        let mut done = left.done;
        let mut alternatives = Vec::new();
        let mut found = BigCount::default();
        for (at, state) in answer.states.iter().enumerate() {
            let acting = self.load_with(&first, state, load);
            if !acting.is_finite() {
                // No floating-point number can represent what acts on the others.
                return self.solve_together(part, load, left);
            }
            let dependents = self.solve_groups(rest, &acting, Piece { done, share });
            // A state for which the others have no solution is not a solution, and there may be very many of
            // them.
            if !dependents.is_empty() {
                found = found.plus(&dependents.counts().solutions);
                alternatives.push(Alternative { state: Arc::clone(state), dependents });
            }
            // All answers may be known already, and combinations are very many.
            if !self.monitor.goes_on() {
                break;
            }
            let enough = found.to_u64().is_none_or(|found| found >= self.options.limits.solutions as u64);
            if enough && at + 1 < answer.states.len() {
                self.monitor.add_enough(true);
                break;
            }
            done += share;
        }
        Factor { contacts: first, alternatives }
    }

    /// The solutions of connected groups, searched as one.
    fn solve_together(&mut self, part: &[usize], load: &Load, work: Piece) -> Factor {
        let mut contacts: Vec<usize> =
            part.iter().flat_map(|&group| &self.groups.members[group]).copied().collect();
        contacts.sort_unstable();
        self.monitor.start_group(work.done, work.share);
        let answer = self.solve_group(&contacts, load, true);
        Factor { alternatives: answer.alternatives(), contacts }
    }

    /// The solutions of one group's equations; each right-hand side is solved once.
    ///
    /// The limit of solutions holds for groups on which no others depend (`is_last`): of others, any solution may
    /// be one for which those have none.
    fn solve_group(&mut self, contacts: &[usize], load: &Load, is_last: bool) -> Arc<SolvedGroup> {
        let bits = |&contact: &usize| [load.middle[contact].to_bits(), load.radius[contact].to_bits()];
        let key = (contacts.to_vec(), contacts.iter().flat_map(bits).collect::<Vec<u64>>());
        if let Some(answer) = self.solved.get(&key) {
            return Arc::clone(answer);
        }
        let restricted = LoadedProblem::restricted(self.problem, contacts, load);
        let mut options = *self.options;
        if !is_last {
            options.limits.solutions = options.limits.solutions.max(Limits::default().solutions);
        }
        let GroupAnswer { solutions, mut report, depends_on_ancestors } =
            search_group(&restricted, &options, self.monitor);
        self.monitor.end_group();
        self.monitor.count_found(solutions.solutions.len() + solutions.gaps.len());
        report.contacts = contacts.to_vec();
        self.all_examined &= solutions.is_complete();
        self.file_report(&report);
        if self.until_barren
            && self.monitor.nodes() - self.first_node >= UNTIL_BARREN
            && self.barren_groups().next().is_some()
        {
            self.monitor.give_up();
        }
        let answer = Arc::new(SolvedGroup::of(solutions));
        // Results that were decided together with other contacts hold only for the states of these contacts.
        if !depends_on_ancestors && self.solved.len() < MOST_KEPT {
            self.solved.insert(key, Arc::clone(&answer));
        }
        answer
    }

    fn file_report(&mut self, report: &GroupReport) {
        let same = |known: &&mut GroupReport| known.contacts == report.contacts;
        match self.reports.iter_mut().rev().find(same) {
            Some(known) => known.add(report),
            None => self.reports.push(report.clone()),
        }
    }

    /// The first contacts of groups that admit nothing for most of many right-hand sides.
    pub(super) fn barren_groups(&self) -> impl Iterator<Item = usize> {
        let barren =
            |report: &&GroupReport| report.loads > BARREN_FROM && 2 * report.barren_loads > report.loads;
        self.reports.iter().filter(barren).map(|report| report.contacts[0])
    }

    /// The right-hand side with `sum_k d_k - c_k y_k` of a group's contacts.
    fn load_with(&mut self, contacts: &[usize], state: &GroupState, load: &Load) -> Load {
        let mut load = load.clone();
        let unknowns = state.unknowns();
        self.chain_proven &= unknowns.is_some();
        let force = state.normal_force();
        for (at, (&contact, state)) in contacts.iter().zip(state.pattern()).enumerate() {
            let bounds = unknowns.map(|unknowns| non_negative(unknowns[at]));
            let y = match (force, bounds) {
                (Some(force), _) => force[at].abs(),
                (None, Some(bounds)) => bounds.middle(),
                (None, None) => 0.0,
            };
            let radius = bounds.map_or(0.0, |bounds| distance(bounds, y));
            load.add_contact(self.problem, contact, state, (y, radius));
        }
        self.add_doubts(contacts, state, &mut load);
        load
    }

    /// Adds the effect of contacts that may just have changed sides, in patterns that were merged with that
    /// of the state.
    fn add_doubts(&self, contacts: &[usize], state: &GroupState, load: &mut Load) {
        let Some(Certificate::OnBoundaryWithinBounds { unknowns: Some(unknowns), in_doubt }) =
            state.certificate()
        else {
            return;
        };
        let pattern = state.pattern();
        for &at in in_doubt {
            let other = match pattern[at] {
                ContactState::Positive => Side::Negative,
                ContactState::Negative => Side::Positive,
                ContactState::Gap => continue,
            };
            load.add_doubt(self.problem, contacts[at], other, unknowns[at].magnitude());
        }
    }
}

/// The nonnegative part of an interval; zero if there is none.
fn non_negative(interval: Interval) -> Interval {
    let all = Interval::new(0.0, f64::INFINITY).unwrap_or(Interval::REAL_LINE);
    interval.intersection(all).unwrap_or(Interval::ZERO)
}

/// The maximum distance of a number within bounds from `y`, rounded up.
fn distance(bounds: Interval, y: f64) -> f64 {
    let largest = (bounds.upper() - y).max(y - bounds.lower());
    if largest > 0.0 { largest.next_up() } else { 0.0 }
}

/// The solutions of a group.
struct SolvedGroup {
    states: Vec<Arc<GroupState>>,
    /// Whether there is anything besides states whose unknowns are known up to errors.
    admits_sets: bool,
}

impl SolvedGroup {
    fn of(solutions: Solutions) -> Self {
        let admits_sets = admits_sets(&solutions);
        let singular: Vec<GroupState> = solutions.singular.iter().filter_map(singular_state).collect();
        let states = solutions.solutions.into_iter().map(GroupState::Solution);
        let states = states.chain(solutions.gaps.into_iter().map(GroupState::Gap));
        let states = states.chain(singular);
        let states = states.chain(solutions.undecided.into_iter().map(GroupState::Undecided));
        Self { states: states.map(Arc::new).collect(), admits_sets }
    }

    /// The states as alternatives without dependents.
    fn alternatives(&self) -> Vec<Alternative> {
        let alternative =
            |state| Alternative { state: Arc::clone(state), dependents: SolutionProduct::default() };
        self.states.iter().map(alternative).collect()
    }
}

/// Returns the state that a singular pattern admits. Returns `None` if that is empty or already a solution. A
/// set in which only shares vary is more than the solutions at its ends; within bounds, it need not be a set
/// for other values.
fn singular_state(mode: &SingularMode) -> Option<GroupState> {
    let within_bounds = matches!(mode.certificate, Certificate::OnBoundaryWithinBounds { .. });
    let is_one_state = !mode.shares_vary || within_bounds;
    match mode.set {
        SolutionSet::Empty | SolutionSet::NotComputed => None,
        SolutionSet::Point(_) if is_one_state && !mode.contains.is_empty() => {
            // For other values within bounds it may be another solution.
            let undecided = UndecidedPattern::new(&mode.pattern, None, Vec::new());
            let undecided = UndecidedPattern { patterns: mode.patterns.clone(), ..undecided };
            mode.certificate.has_open_determinant().then_some(GroupState::Undecided(undecided))
        }
        _ => Some(GroupState::Singular(mode.clone())),
    }
}

/// Whether there is anything besides states whose unknowns are known up to errors.
fn admits_sets(solutions: &Solutions) -> bool {
    solutions.singular.iter().any(|mode| mode.set != SolutionSet::Empty)
        || solutions.undecided.iter().any(|undecided| undecided.unknowns.is_none())
        || solutions.solutions.iter().any(|solution| solution.certificate.has_open_determinant())
        || solutions.gaps.iter().any(|gap| gap.certificate.has_open_determinant())
}
