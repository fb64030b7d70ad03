//! The report of a raw problem: plain data, which are the JSON output.

use std::ops::Range;

use serde::{Serialize, Serializer};

use super::kind::RawKind;
use super::right_hand_sides::EveryRightHandSide;
use crate::status::{Proof, Status};

/// Version of the layout of a [`RawReport`]; it changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/modes/3";

/// All solutions of a raw problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RawReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// Type of the problem.
    #[serde(rename = "type")]
    pub kind: RawKind,
    /// Number n of unknowns (of components in an equation of blocks; of pairs of them in a complementarity problem; of the pure strategies of both
    /// players in a game).
    pub size: usize,
    /// Of these, the free unknowns of a mixed linear complementarity problem, or the first player's strategies;
    /// they come first. Zero for other types.
    #[serde(skip)]
    pub first: usize,
    /// How many solutions there are; if the search ended early, how many were found.
    pub status: Status,
    /// Whether the list of solutions is proven complete.
    pub complete: Proof,
    /// Whether the search ended before all possibilities were examined.
    pub partial: bool,
    /// The questions that remain open, in words; empty if `complete` is [`Proof::Proven`].
    pub open: Vec<String>,
    /// Number of solutions found that are not part of a continuum, as decimal text, because it may exceed any
    /// integer type. Gap states are not included.
    pub count: String,
    /// Number of states with an unknown in its preload gap that are not part of a continuum, nor of gap states
    /// whose shares vary, as decimal text.
    pub gap_state_count: String,
    /// Number of continua that are not part of larger ones, as decimal text.
    pub continuum_count: String,
    /// Whether there is a solution within rounding of the numbers; present only if there is none for the
    /// numbers themselves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within_rounding: Option<WithinRounding>,
    /// Whether every right-hand side has exactly one solution, if requested:
    /// [`RawProblem::every_right_hand_side`](super::RawProblem::every_right_hand_side).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub every_right_hand_side: Option<EveryRightHandSide>,
    /// The solutions that are not part of a continuum, up to the requested number.
    pub solutions: Vec<RawSolution>,
    /// States with an unknown in its preload gap, up to the requested number (theory, section 3).
    pub gap_states: Vec<RawSolution>,
    /// Infinite sets of solutions that are not part of larger ones, up to the requested number.
    pub continua: Vec<RawContinuum>,
    /// How they were found: groups of unknowns and methods, in words.
    pub strategy: String,
    /// Number of nodes visited by the search.
    pub nodes: u64,
    /// The groups of unknowns that were searched separately.
    pub groups: Vec<RawGroup>,
}

/// A line of an answer that is written state by state: [`solve_streaming`](super::solve_streaming).
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum RawLine {
    /// A solution.
    Solution(RawSolution),
    /// A state with an unknown in its preload gap.
    GapState(RawSolution),
    /// An infinite set of solutions.
    Continuum(RawContinuum),
    /// The last line.
    Conclusion(Box<RawConclusion>),
}

/// The conclusion of an answer that is written state by state.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RawConclusion {
    /// Counts, how they were found, and whether they are complete; the lists are empty.
    #[serde(flatten)]
    pub report: RawReport,
    /// The number of lines before this one.
    pub lines: u64,
    /// Whether every state that the report counts is in one of them.
    pub all_written: bool,
    /// Lines, from 1, with a state that is part of a larger set in another line; the report counts the others.
    pub part_of_others: Vec<u64>,
    /// Seconds since the start, if the caller measures them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

/// The unknowns, with the names that the problem's type has for them. NaN (`null` in JSON) means no value:
/// see [`BeyondRange`].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Unknowns {
    /// For a linear or horizontal complementarity problem, or one with bounds.
    Complementary {
        /// `z`.
        #[serde(serialize_with = "known_values")]
        z: Vec<f64>,
        /// `w`.
        #[serde(serialize_with = "known_values")]
        w: Vec<f64>,
    },
    /// For a mixed linear complementarity problem.
    Mixed {
        /// `u`, the free unknowns.
        #[serde(serialize_with = "known_values")]
        u: Vec<f64>,
        /// `z`.
        #[serde(serialize_with = "known_values")]
        z: Vec<f64>,
        /// `w`.
        #[serde(serialize_with = "known_values")]
        w: Vec<f64>,
    },
    /// For a game; a part of a continuum is one player's strategy, with the payoff of the other.
    Strategies {
        /// `x`; of a game, the probabilities of the rows, the first player's strategies.
        #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "known_values")]
        x: Vec<f64>,
        /// `y_k = |N_k|`; of a game, the probabilities of the columns, the second player's strategies.
        #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "known_values")]
        y: Vec<f64>,
        /// The first player's payoff, which depends on `y`.
        #[serde(skip_serializing_if = "Option::is_none", serialize_with = "known_payoff")]
        payoff_1: Option<f64>,
        /// The second player's payoff, which depends on `x`.
        #[serde(skip_serializing_if = "Option::is_none", serialize_with = "known_payoff")]
        payoff_2: Option<f64>,
    },
    /// For an absolute value equation, of blocks or not.
    AbsoluteValue {
        /// `x`.
        #[serde(serialize_with = "known_values")]
        x: Vec<f64>,
    },
    /// For a mode problem.
    Modes {
        /// Signed normal forces `N_k = sigma_k y_k`.
        #[serde(serialize_with = "known_values")]
        normal_forces: Vec<f64>,
        /// `y_k = |N_k|`.
        #[serde(serialize_with = "known_values")]
        y: Vec<f64>,
    },
}

/// Numbers, with `null` for those beyond the range of floating-point numbers, which are NaN here.
fn known_values<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(values.iter().map(|value| (!value.is_nan()).then_some(*value)))
}

/// Serializes one number; `null` if it is NaN, beyond the range of floating-point numbers.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn known_value<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    (!value.is_nan()).then_some(*value).serialize(serializer)
}

/// Serializes the payoff of a player; `null` if it is NaN, beyond the range of floating-point numbers.
#[allow(clippy::ref_option)]
fn known_payoff<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    value.filter(|value| !value.is_nan()).serialize(serializer)
}

impl Unknowns {
    /// Names and values, in the order of [`RawReport::names`].
    pub fn named(&self) -> Vec<(&'static str, &[f64])> {
        match self {
            Self::Complementary { z, w } => vec![("z", z), ("w", w)],
            Self::Mixed { u, z, w } => vec![("u", u), ("z", z), ("w", w)],
            Self::Strategies { x, y, payoff_1, payoff_2 } => {
                vec![("x", x), ("y", y), ("payoff_1", payoff_1.as_slice()), ("payoff_2", payoff_2.as_slice())]
            }
            Self::AbsoluteValue { x } => vec![("x", x)],
            Self::Modes { normal_forces, y } => vec![("normal_forces", normal_forces), ("y", y)],
        }
    }
}

/// A name of unknowns, and their indices among all unknowns; none for the payoffs of a game.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedRange {
    /// The name.
    pub name: &'static str,
    /// The indices, which count what has a sign.
    pub indices: Option<Range<usize>>,
}

impl RawReport {
    /// The names of the unknowns, in the order of [`Unknowns::named`].
    pub fn names(&self) -> Vec<NamedRange> {
        let (first, size) = (self.first, self.size);
        let (all, own, others) = (Some(0..size), Some(0..first), Some(first..size));
        let ranges: &[(&'static str, Option<Range<usize>>)] = match self.kind {
            RawKind::Lcp | RawKind::Hlcp | RawKind::Mcp => &[("z", all.clone()), ("w", all)],
            RawKind::Mlcp => &[("u", own), ("z", others.clone()), ("w", others)],
            RawKind::Game => &[("x", own), ("y", others), ("payoff_1", None), ("payoff_2", None)],
            RawKind::Ave | RawKind::BlockAve => &[("x", all)],
            RawKind::Modes => &[("normal_forces", all.clone()), ("y", all)],
        };
        ranges.iter().map(|(name, indices)| NamedRange { name, indices: indices.clone() }).collect()
    }
}

/// Solutions for numbers that differ from the given ones only by rounding.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WithinRounding {
    /// Every number may differ by this fraction of its size.
    pub relative: f64,
    /// Whether such numbers have a solution.
    pub answer: WithinRoundingAnswer,
    /// The solution.
    #[serde(flatten)]
    pub unknowns: Option<Unknowns>,
}

/// Whether numbers that differ from the given ones only by rounding have a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum WithinRoundingAnswer {
    /// Some such numbers have the reported solution.
    Solution,
    /// No such numbers have a solution, which is proven.
    None,
    /// Neither was established.
    Unknown,
}

impl WithinRoundingAnswer {
    /// "solution", "none" or "unknown"
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Solution => "solution",
            Self::None => "none",
            Self::Unknown => "unknown",
        }
    }
}

/// One solution, or one state with an unknown in its gap.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RawSolution {
    /// The unknowns.
    #[serde(flatten)]
    pub unknowns: Unknowns,
    /// Sign of every `z_k - w_k`, `x_k` (of blocks, too: component by component, and 0 where the sign is not certain) or `N_k`; 0 where it vanishes. With two bounds: -1 where `z_k = l_k`, 1
    /// where `z_k = u_k`, 0 between, and for free and fixed `z_k`. Of a mixed problem, the signs of `u` come
    /// first. Of a game: for the pure strategies of both players, 1 if it is played, 0 if it is another best
    /// response, -1 if not.
    pub signs: Vec<i8>,
    /// Whether the solution is on the boundary between patterns: both unknowns of a pair vanish, or an unknown whose
    /// coefficients depend on its sign, outside a gap. A free unknown that is zero is on no boundary. Of blocks: whether some
    /// block may be zero.
    pub on_boundary: bool,
    /// Maximum distance of the unknowns that have a number from the exact solution for the given numbers;
    /// absent if it was not determined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub enclosure_radius: Option<f64>,
    /// The residual of the problem's equations, relative to the largest sum of sizes of terms in an equation;
    /// absent if an unknown has no value at all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual: Option<f64>,
    /// Unknowns that exist but have no floating-point number; their value is `null`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beyond_range: Vec<BeyondRange>,
    /// Unknowns in their gap.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gaps: Vec<GapShare>,
    /// Whether the shares in `gaps` are those of one of many states whose values are otherwise equal.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub shares_vary: bool,
}

/// A nonzero unknown beyond the range of floating-point numbers of full precision: larger than 1.8e308, or
/// smaller than 2.2e-308, in size.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct BeyondRange {
    /// The name of the unknown.
    pub name: RawUnknown,
    /// The index of the unknown, from 0.
    pub index: usize,
    /// The exact value rounded to 17 digits ("1.5e310"), or words if it was not computed.
    pub value: String,
}

/// The names of unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RawUnknown {
    /// `z` of a complementarity problem.
    Z,
    /// `w` of a complementarity problem.
    W,
    /// `u` of a mixed linear complementarity problem.
    U,
    /// `x` of an absolute value equation, or of a game.
    X,
    /// The signed normal forces of a mode problem.
    NormalForces,
    /// `y`, the sizes of the normal forces, or of a game.
    Y,
    /// The first player's payoff.
    #[serde(rename = "payoff_1")]
    Payoff1,
    /// The second player's payoff.
    #[serde(rename = "payoff_2")]
    Payoff2,
    /// The share lambda of an unknown in its gap.
    Lambda,
}

impl RawUnknown {
    /// "z", "w", "u", "x", "`normal_forces`", "y", "`payoff_1`", "`payoff_2`" or "lambda"
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Z => "z",
            Self::W => "w",
            Self::U => "u",
            Self::X => "x",
            Self::NormalForces => "normal_forces",
            Self::Y => "y",
            Self::Payoff1 => "payoff_1",
            Self::Payoff2 => "payoff_2",
            Self::Lambda => "lambda",
        }
    }
}

/// An unknown in its preload gap.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct GapShare {
    /// The index of the unknown, from 0.
    pub index: usize,
    /// The share lambda of `jumps_positive`, from 0 to 1; NaN (`null`) if it is beyond the range.
    #[serde(serialize_with = "known_value")]
    pub lambda: f64,
}

/// Infinitely many solutions: the unknowns of each part are in its set, independently of the other parts. NaN
/// (`null` in JSON) is a nonzero value beyond the range of floating-point numbers, like that of a
/// [`BeyondRange`]; its sign is that of the pattern.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RawContinuum {
    /// "+", "-" or "0" for every unknown, as the `signs` of a solution inside the set: "0" is zero throughout, or in its
    /// gap, and "*" a free unknown that has both signs.
    pub pattern: String,
    /// Its parts: unknowns that vary together and, last, those that are fixed, if any.
    pub parts: Vec<ContinuumPart>,
}

/// Unknowns that vary together: all convex combinations of the vertices plus all nonnegative multiples of the
/// directions. A set that contains lines, which takes free unknowns, has no vertices: these are points of its smallest
/// faces then, and the directions contain both ones of lines that span all of its lines.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ContinuumPart {
    /// The unknowns, from 0, as `signs` counts them; vertices and directions have one entry for each.
    pub indices: Vec<usize>,
    /// The vertices, up to the requested number: the ends of a segment, or the end of a ray.
    pub vertices: Vec<Unknowns>,
    /// Directions in which the set is unbounded, up to the requested number.
    pub directions: Vec<Unknowns>,
    /// Total number of vertices.
    pub vertex_count: usize,
    /// Total number of directions.
    pub direction_count: usize,
    /// If there are more than 4096 vertices and directions, counting those that have to be held on the way to them,
    /// none are listed or counted; this is the dimension of the part then, ...
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dimension: Option<usize>,
    /// ... and this is a point inside it: what is zero here is zero in the whole part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inside: Option<Unknowns>,
}

/// A group of unknowns that was searched separately.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RawGroup {
    /// Its unknowns, from 0.
    pub indices: Vec<usize>,
    /// The method, in words.
    pub method: String,
    /// Nodes visited.
    pub nodes: u64,
    /// The fractions of its patterns that were settled by each argument; they add up to 1.
    pub patterns: RawShares,
    /// Whether every exclusion and every outcome is proven.
    pub proven: bool,
}

/// Fractions of the patterns of a group; they add up to 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RawShares {
    /// Excluded by a proof that there is exactly one solution.
    pub uniqueness: f64,
    /// Excluded because they are not cells of a hyperplane arrangement.
    pub cells: f64,
    /// Excluded by interval propagation.
    pub propagation: f64,
    /// Excluded by a linear relaxation.
    pub relaxation: f64,
    /// Not solved one by one, because all their solutions are those of another pattern.
    pub faces: f64,
    /// Solved one by one.
    pub examined: f64,
    /// Not settled.
    pub unexplored: f64,
}
