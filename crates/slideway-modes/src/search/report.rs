//! How a search proceeded: methods, counts of what each argument excluded, and how reliable the answer is.

use std::fmt;

use super::states::StateSet;
use crate::solutions::{ClosestMode, Limits, PatternCounts, SingularMode, Solutions};

/// The means that a search may use, and to what extent.
///
/// Undocumented fields turn off parts of the search or record what it did: tests, benchmarks and fuzz targets
/// use them for comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SearchOptions {
    /// Largest number of nodes, over all groups of contacts.
    pub nodes: u64,
    /// Limits on what is found and examined. [`Limits::contacts`] and [`Limits::patterns`] do not apply to a
    /// search.
    pub limits: Limits,
    /// Threads that share large trees; nodes and answer are the same for any number of them. 0 counts as 1.
    pub threads: usize,
    /// Which arguments the search may use; by default all of them.
    #[doc(hidden)]
    pub arguments: Arguments,
    /// Whether the outcome of every pattern that is solved is also decided by proof, for the numbers as
    /// given. Otherwise nothing is [`Completeness::Proven`].
    #[doc(hidden)]
    pub certify: bool,
    /// Whether every excluded node is kept with its proof, in [`GroupReport::exclusions`].
    #[doc(hidden)]
    pub keep_exclusions: bool,
}

impl Default for SearchOptions {
    /// 100 million nodes, one thread.
    fn default() -> Self {
        Self {
            nodes: 100_000_000,
            threads: 1,
            limits: Limits::default(),
            arguments: Arguments::default(),
            certify: true,
            keep_exclusions: false,
        }
    }
}

impl SearchOptions {
    /// A search that may use so many nodes, and ends once a group of contacts has more solutions than `found`, or, if
    /// that is 1, at the first one; by default as without these limits.
    #[must_use]
    pub fn within(nodes: Option<u64>, found: Option<usize>) -> Self {
        let Self { nodes: most_nodes, limits, .. } = Self::default();
        let limits = Limits { solutions: found.unwrap_or(limits.solutions), ..limits };
        Self { nodes: nodes.unwrap_or(most_nodes), limits, ..Self::default() }
    }
}

/// The arguments that a search may use besides the linear relaxation.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "six independent switches")]
pub struct Arguments {
    /// Splitting into groups of contacts.
    pub groups: bool,
    /// Interval propagation.
    pub propagation: bool,
    /// Proofs that there is exactly one solution.
    pub uniqueness: bool,
    /// Cells of a hyperplane arrangement where the coupling is of low rank.
    pub low_rank: bool,
    /// Settling whole faces of the relaxation.
    pub faces: bool,
    /// Trying every pattern of groups of few contacts.
    pub every_pattern: bool,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            groups: true,
            propagation: true,
            uniqueness: true,
            low_rank: true,
            faces: true,
            every_pattern: true,
        }
    }
}

/// Why a search ended early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopReason {
    /// [`SearchOptions::nodes`].
    NodeLimit,
    /// [`Limits::solutions`].
    SolutionLimit,
    /// The callback requested it.
    Cancelled,
}

impl fmt::Display for StopReason {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::NodeLimit => "the limit of nodes was reached",
            Self::SolutionLimit => "the limit of solutions was reached",
            Self::Cancelled => "the search was cancelled",
        })
    }
}

/// How a group of contacts was solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// The problem is monotone: all solutions are those of one pattern.
    Monotone {
        /// Whether there is exactly one solution for every right-hand side.
        strictly: bool,
    },
    /// Every pattern that can occur, by the cells of a hyperplane arrangement.
    Cells {
        /// The rank of the coupling.
        rank: usize,
    },
    /// Branch and bound with interval propagation and linear relaxation.
    BranchAndBound,
    /// Every pattern decided individually, because there are few.
    EveryPattern,
}

impl fmt::Display for Method {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Monotone { strictly: true } => {
                formatter.write_str("one solution, because it is strictly monotone")
            }
            Self::Monotone { strictly: false } => {
                formatter.write_str("one pattern has all solutions, because it is monotone")
            }
            Self::Cells { rank } => write!(formatter, "cells of an arrangement, coupling of rank {rank}"),
            Self::BranchAndBound => formatter.write_str("branch and bound with linear relaxation"),
            Self::EveryPattern => formatter.write_str("every pattern"),
        }
    }
}

/// The fractions of a group's patterns (including gap states) that were settled by each argument. They add up
/// to 1. Multiplied by `2^`[`GroupReport::log2_patterns`], they are numbers of patterns.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PatternShares {
    /// Excluded by a proof that one pattern has all solutions.
    pub uniqueness: f64,
    /// Excluded because they are not cells of the arrangement.
    pub cells: f64,
    /// Excluded by interval propagation.
    pub propagation: f64,
    /// Excluded by the linear relaxation.
    pub relaxation: f64,
    /// Not solved one by one, because all their solutions are those of another pattern: a face of the linear
    /// relaxation.
    pub faces: f64,
    /// Solved one by one.
    pub examined: f64,
    /// Not settled, because the search ended early.
    pub unexplored: f64,
}

impl PatternShares {
    /// The fraction of settled patterns.
    pub fn done(&self) -> f64 {
        self.uniqueness + self.cells + self.propagation + self.relaxation + self.faces + self.examined
    }

    /// Adds the fractions of another part of the same patterns.
    pub(super) fn add(&mut self, other: &Self) {
        self.uniqueness += other.uniqueness;
        self.cells += other.cells;
        self.propagation += other.propagation;
        self.relaxation += other.relaxation;
        self.faces += other.faces;
        self.examined += other.examined;
        self.unexplored += other.unexplored;
    }

    fn mean(&self, other: &Self, weight: f64) -> Self {
        let mean = |one: f64, other: f64| weight * one + (1.0 - weight) * other;
        Self {
            uniqueness: mean(self.uniqueness, other.uniqueness),
            cells: mean(self.cells, other.cells),
            propagation: mean(self.propagation, other.propagation),
            relaxation: mean(self.relaxation, other.relaxation),
            faces: mean(self.faces, other.faces),
            examined: mean(self.examined, other.examined),
            unexplored: mean(self.unexplored, other.unexplored),
        }
    }
}

/// An excluded node and why it contains no solution.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub struct Exclusion {
    /// The states that every contact of the group could still take.
    pub states: Vec<StateSet>,
    /// The proof.
    pub argument: ExclusionArgument,
}

/// Why a node contains no solution.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub enum ExclusionArgument {
    /// Interval propagation leaves a contact without a state.
    Propagation,
    /// A vector `v` with `v . (left side) < v . (right side)` for everything that the states allow, for the
    /// equations in the problem's own units.
    Farkas(Vec<f64>),
}

/// The outcome of every pattern of a group.
#[derive(Debug, Clone, PartialEq)]
pub struct PatternOutcomes {
    /// Outcomes of the patterns without gap states.
    pub counts: PatternCounts,
    /// Outcomes of the patterns with gap states.
    pub gap_counts: PatternCounts,
    /// Singular patterns that admit nothing, and those that were not examined.
    pub locked: Vec<SingularMode>,
    /// Up to four regular patterns with the smallest `|D|`, if the group has no solution.
    pub closest: Vec<ClosestMode>,
}

impl PatternOutcomes {
    pub(super) fn of(solutions: &Solutions) -> Self {
        let locked = solutions.singular.iter().filter(|mode| !mode.set.has_points());
        Self {
            counts: solutions.counts,
            gap_counts: solutions.gap_counts,
            locked: locked.cloned().collect(),
            closest: solutions.closest.clone(),
        }
    }
}

/// How one group of contacts was searched.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupReport {
    /// The contacts, from 0, in increasing order.
    pub contacts: Vec<usize>,
    /// The method that produced the answer.
    pub method: Method,
    /// Binary logarithm of the number of patterns, gap states included.
    pub log2_patterns: f64,
    /// Nodes visited, or patterns tried with [`Method::EveryPattern`] and [`Method::Cells`] (which may
    /// encounter a cell several times).
    pub nodes: u64,
    /// Pivots of the linear programs.
    pub pivots: u64,
    /// The outcome of the patterns.
    pub shares: PatternShares,
    /// Number of right-hand sides with which the group was searched.
    pub loads: u64,
    /// Number of right-hand sides for which the group admits nothing: no solution, no gap state, no singular
    /// set.
    pub barren_loads: u64,
    /// The outcome of every pattern; only if each was tried, with one right-hand side.
    pub outcomes: Option<PatternOutcomes>,
    /// Number of patterns whose outcome is known only within tolerances.
    pub unproven_patterns: u64,
    /// Whether every exclusion and every outcome is established with error bounds, for the
    /// right-hand sides as given.
    pub proven: bool,
    /// Excluded nodes, if [`SearchOptions::keep_exclusions`] is set.
    #[doc(hidden)]
    pub exclusions: Vec<Exclusion>,
}

impl GroupReport {
    /// Adds the report on the same group for another right-hand side; shares become means.
    pub(super) fn add(&mut self, other: &Self) {
        let weight = self.loads as f64 / (self.loads + other.loads) as f64;
        self.shares = self.shares.mean(&other.shares, weight);
        self.loads += other.loads;
        self.barren_loads += other.barren_loads;
        self.outcomes = None;
        self.nodes += other.nodes;
        self.pivots += other.pivots;
        self.unproven_patterns += other.unproven_patterns;
        self.proven &= other.proven;
        self.exclusions.extend(other.exclusions.iter().cloned());
        if self.method != other.method {
            self.method = Method::BranchAndBound;
        }
    }
}

/// Whether the list is complete.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Completeness {
    /// Every exclusion and every pattern's outcome is established with error bounds.
    Proven,
    /// The search is complete, but not every step of it is established with error bounds.
    NotProven,
    /// Some patterns were not settled.
    Partial(StopReason),
    /// Some singular patterns were not examined within the limits.
    Unexamined,
}

impl Completeness {
    /// Greater for lists of which less is known.
    pub(super) fn severity(self) -> u8 {
        match self {
            Self::Proven => 0,
            Self::NotProven => 1,
            Self::Unexamined => 2,
            Self::Partial(_) => 3,
        }
    }
}

impl fmt::Display for Completeness {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proven => formatter.write_str("complete: proven"),
            Self::NotProven => formatter.write_str("complete: not proven"),
            Self::Partial(reason) => write!(formatter, "partial: {reason}"),
            Self::Unexamined => formatter.write_str("partial: singular patterns were not examined"),
        }
    }
}
