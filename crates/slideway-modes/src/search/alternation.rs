//! Chooses which contacts are solved as one group.
//!
//! The strongly connected groups of contacts are solved one after the other, for each combination of solutions
//! of earlier groups ([`composition`](super::composition)). Where a later group admits nothing for nearly all of
//! them, as in a subset-sum problem (`2^n` combinations, of which the last equation excludes nearly all), one tree
//! over the groups together needs fewer nodes: its linear relaxation contains the last equation from the root on.
//! Where every group excludes much by itself, the groups need fewer: a tree over all of them multiplies what they
//! add. Which is the case shows only in the search.
//!
//! So both take turns. Once a group is barren, the groups are given up for a tree in which it has joined the groups
//! that act on it, and whatever else these act on. The tree may visit sixteen times as many nodes as the groups have; if
//! that is not enough, the groups may visit a quarter of that, then the tree four times as many as before, and so on,
//! until one of them finishes: barren groups are a sign that the tree is the better one. Each begins anew, so that
//! nothing but numbers of nodes decides, and the answer is the same on every machine. Beginning anew with budgets `1, 4,
//! 16, ...` costs at most 4/3 of the last one: if the joined groups need `n` nodes, at most `8/3 n` are visited after the
//! groups were given up first, and the attempts with fewer joined groups; if the groups do, at most `71/3 n`.

use super::composition::{Composer, Piece};
use super::groups::Groups;
use super::load::Load;
use super::monitor::Monitor;
use super::product::SolutionProduct;
use super::report::{Completeness, GroupReport, SearchOptions, StopReason};
use crate::problem::{ProblemView, patterns_of};

/// A problem with at most this many patterns is not split into groups, so that the outcome of each pattern is
/// known.
const WHOLE_UP_TO: u64 = 64;

/// The first budget of joined groups, as a multiple of the nodes after which groups were given up, ...
const FIRST_BUDGET: u64 = 16;
/// ... the next one, as a multiple of the last, and how many times as much it is as the next one of the groups.
const BUDGET_GROWTH: u64 = 4;

/// The solutions of all contacts, and how they were found.
pub(super) struct Composition {
    pub(super) product: SolutionProduct,
    pub(super) reports: Vec<GroupReport>,
    /// Nodes of attempts that were given up.
    pub(super) abandoned_nodes: u64,
    pub(super) completeness: Completeness,
}

/// All solutions of the problem.
///
/// The solutions are combinations of those of parts that do not depend on each other. If a part has none, there are none,
/// whatever is left open in the others.
pub(super) fn solve(
    problem: ProblemView<'_>,
    options: &SearchOptions,
    monitor: &mut Monitor<'_>,
) -> Composition {
    let few = options.arguments.every_pattern && patterns_of(problem) <= WHOLE_UP_TO;
    let split = options.arguments.groups && !few;
    let groups = if split { Groups::new(problem) } else { Groups::whole(problem) };
    let mut whole = Composition {
        product: SolutionProduct::default(),
        reports: Vec::new(),
        abandoned_nodes: 0,
        completeness: Completeness::Proven,
    };
    if groups.members.len() > 1 {
        monitor.tell_no_states();
    }
    let load = Load::of(problem);
    let mut done = 0.0;
    let mut parts: Vec<(bool, Completeness)> = Vec::new();
    for part in groups.independent_parts(&(0..groups.members.len()).collect::<Vec<_>>()) {
        let groups = groups.restricted(&part);
        let contacts: usize = groups.members.iter().map(Vec::len).sum();
        let share = contacts as f64 / problem.contacts() as f64;
        let work = Piece { done, share };
        let enough_before = monitor.take_enough();
        let alternation = Alternation { problem, options, load: &load, work, monitor, partial: None };
        let (attempt, abandoned) = alternation.solve(&groups);
        let completeness = attempt.completeness(monitor.reason());
        monitor.add_enough(enough_before);
        parts.push((attempt.product.is_empty(), completeness));
        whole.product.factors.extend(attempt.product.factors);
        whole.reports.extend(attempt.reports);
        whole.abandoned_nodes += abandoned;
        done += share;
    }
    let empty = parts.iter().filter(|(is_empty, _)| *is_empty).map(|(_, own)| *own);
    let all = parts.iter().map(|(_, own)| *own);
    let worst = all.max_by_key(|own| own.severity());
    whole.completeness = empty.min_by_key(|own| own.severity()).or(worst).unwrap_or(Completeness::Proven);
    whole
}

/// The findings and the work of one attempt.
struct Attempt {
    product: SolutionProduct,
    reports: Vec<GroupReport>,
    chain_proven: bool,
    all_examined: bool,
    nodes: u64,
    /// The first contacts of barren groups, if it was given up.
    given_up: Option<Vec<usize>>,
}

impl Attempt {
    /// Whether its list is complete, given why the search ended early if it did.
    fn completeness(&self, reason: Option<StopReason>) -> Completeness {
        match reason {
            Some(reason) => Completeness::Partial(reason),
            None if !self.all_examined => Completeness::Unexamined,
            None if self.chain_proven && self.reports.iter().all(|group| group.proven) => {
                Completeness::Proven
            }
            None => Completeness::NotProven,
        }
    }
}

/// Alternates between groups of a connected part of the contacts.
struct Alternation<'a, 'm, 'c> {
    problem: ProblemView<'a>,
    options: &'a SearchOptions,
    load: &'a Load,
    work: Piece,
    monitor: &'m mut Monitor<'c>,
    /// The latest attempt that was given up after it had found something.
    partial: Option<Attempt>,
}

impl Alternation<'_, '_, '_> {
    /// The solutions, and the number of nodes of other attempts.
    fn solve(mut self, groups: &Groups) -> (Attempt, u64) {
        let first_node = self.monitor.nodes();
        let last = self.last_attempt(groups);
        let attempt = match self.partial {
            Some(partial) if self.monitor.stopped().is_some() && last.product.is_empty() => partial,
            _ => last,
        };
        let abandoned = self.monitor.nodes() - first_node - attempt.nodes;
        (attempt, abandoned)
    }

    /// The first attempt that is not given up.
    fn last_attempt(&mut self, groups: &Groups) -> Attempt {
        let first = self.attempt(groups, u64::MAX, true);
        let Some(barren) = &first.given_up else { return first };
        let mut joined = Joined { groups: groups.clone(), steps: 1 };
        let has_ancestors = joined.join(barren);
        let mut budget = first.nodes.saturating_mul(FIRST_BUDGET);
        self.keep(first);
        if !has_ancestors {
            return self.attempt(groups, u64::MAX, false);
        }
        loop {
            let together = self.attempt_joined(&mut joined, budget);
            if together.given_up.is_none() {
                return together;
            }
            self.keep(together);
            let apart = self.attempt(groups, budget / BUDGET_GROWTH, false);
            if apart.given_up.is_none() {
                return apart;
            }
            self.keep(apart);
            budget = budget.saturating_mul(BUDGET_GROWTH);
        }
    }

    /// An attempt with joined groups; where it meets barren ones, these join their ancestors, too, and it begins
    /// anew.
    fn attempt_joined(&mut self, joined: &mut Joined, budget: u64) -> Attempt {
        loop {
            let attempt = self.attempt(&joined.groups, budget, true);
            match &attempt.given_up {
                Some(barren) if joined.join(barren) => self.keep(attempt),
                _ => return attempt,
            }
        }
    }

    /// Keeps what was found, in case the search is stopped before anything else is.
    fn keep(&mut self, attempt: Attempt) {
        if !attempt.product.is_empty() {
            self.partial = Some(attempt);
        }
    }

    /// Solves the groups within a number of nodes, and until one is barren if so asked.
    fn attempt(&mut self, groups: &Groups, budget: u64, until_barren: bool) -> Attempt {
        let (first_node, found) = (self.monitor.nodes(), self.monitor.states_found());
        self.monitor.begin_attempt(budget);
        let mut composer = Composer::new(self.problem, self.options, groups, self.monitor, until_barren);
        let part: Vec<usize> = (0..groups.members.len()).collect();
        let factor = composer.solve_part(&part, self.load, self.work);
        let barren = composer.barren_groups().collect();
        let Composer { reports, chain_proven, all_examined, .. } = composer;
        let given_up = self.monitor.end_attempt(found).then_some(barren);
        let product = SolutionProduct { factors: vec![factor] };
        let nodes = self.monitor.nodes() - first_node;
        Attempt { product, reports, chain_proven, all_examined, nodes, given_up }
    }
}

/// Groups, some of which have joined their ancestors; the next ones do within so many steps.
struct Joined {
    groups: Groups,
    steps: usize,
}

impl Joined {
    /// Joins the groups of these contacts with their ancestors; `false` if they have none.
    fn join(&mut self, contacts: &[usize]) -> bool {
        let is_chosen =
            |&group: &usize| self.groups.members[group].iter().any(|contact| contacts.contains(contact));
        let chosen: Vec<usize> = (0..self.groups.members.len()).filter(is_chosen).collect();
        let before = self.groups.members.len();
        self.groups = self.groups.joined_with_ancestors(&chosen, self.steps);
        self.steps *= 2;
        self.groups.members.len() < before
    }
}
