//! The results of an enumeration.

mod contact_set;
mod limits;
mod support;

pub(crate) use contact_set::ContactSet;
pub use limits::Limits;
pub(crate) use support::Support;

use nalgebra::DVector;

use crate::interval::Interval;
use crate::problem::{ContactState, Side, SolutionSet};

/// The statement that is proven about a solution, a gap state or a singular set.
///
/// Intervals contain one unknown per contact, as returned by [`decide`](crate::certificate::decide) for the
/// state's first pattern: `y_k`, or the share `lambda_k` for a contact in its gap.
#[derive(Debug, Clone, PartialEq)]
pub enum Certificate {
    /// It exists for all values within the bounds of the data, strictly inside its pattern.
    Proven {
        /// Encloses the solution for every value.
        unknowns: Vec<Interval>,
    },
    /// The data are exact, and so is this solution on the boundary between patterns.
    Boundary {
        /// Encloses the solution.
        unknowns: Vec<Interval>,
        /// Contacts with `y_k = 0` or `lambda_k = 0`.
        zero: Vec<usize>,
        /// Contacts with `lambda_k = 1`.
        full_share: Vec<usize>,
    },
    /// The data are exact, `D = 0`, and this is everything that the pattern admits, apart from the rounding
    /// of the result.
    Singular,
    /// It is a solution at the midpoint of the bounds, but may not be one for other values within them.
    OnBoundaryWithinBounds {
        /// Encloses the solution of the pattern's equations for every value; `None` if `D = 0` could not be
        /// ruled out.
        unknowns: Option<Vec<Interval>>,
        /// Contacts whose `y_k` may be negative, or whose `lambda_k` may be outside 0 to 1; empty if
        /// `unknowns` is `None`.
        in_doubt: Vec<usize>,
    },
    /// It was found only within tolerances.
    NotProven,
}

impl Certificate {
    /// Proven bounds on the unknowns; `None` if there are none, and for singular sets.
    pub fn unknowns(&self) -> Option<&[Interval]> {
        match self {
            Self::Proven { unknowns }
            | Self::Boundary { unknowns, .. }
            | Self::OnBoundaryWithinBounds { unknowns: Some(unknowns), .. } => Some(unknowns),
            Self::Singular | Self::OnBoundaryWithinBounds { unknowns: None, .. } | Self::NotProven => None,
        }
    }
}

impl Certificate {
    /// Replaces the bounds on the unknown of a contact, if there are bounds.
    pub fn set_bounds(&mut self, contact: usize, bounds: Interval) {
        if let Self::Proven { unknowns }
        | Self::Boundary { unknowns, .. }
        | Self::OnBoundaryWithinBounds { unknowns: Some(unknowns), .. } = self
        {
            unknowns[contact] = bounds;
        }
    }

    /// Whether `D = 0` could not be ruled out for all values within bounds.
    pub fn has_open_determinant(&self) -> bool {
        matches!(self, Self::OnBoundaryWithinBounds { unknowns: None, .. })
    }
}

/// A pattern of a problem within bounds that has no solution at the midpoint of the bounds, but may have one
/// for other values within them.
#[derive(Debug, Clone, PartialEq)]
pub struct UndecidedPattern {
    /// The state of each contact.
    pub pattern: Vec<ContactState>,
    /// All patterns that this represents, at most [`Limits::listed`](crate::Limits::listed): more than one if
    /// another group of contacts is in a state that several patterns share.
    pub patterns: Vec<Vec<ContactState>>,
    /// Encloses the solution of the pattern's equations for every value: `y_k`, or `lambda_k` in a gap.
    /// `None` if `D = 0` could not be ruled out.
    pub unknowns: Option<Vec<Interval>>,
    /// Contacts whose `y_k` may be negative, or whose `lambda_k` may be outside 0 to 1; empty if `unknowns`
    /// is `None`.
    pub in_doubt: Vec<usize>,
}

impl UndecidedPattern {
    pub(crate) fn new(
        pattern: &[ContactState],
        unknowns: Option<Vec<Interval>>,
        in_doubt: Vec<usize>,
    ) -> Self {
        Self { pattern: pattern.to_vec(), patterns: vec![pattern.to_vec()], unknowns, in_doubt }
    }
}

/// A solution with every contact pressed on a side or just about to change sides.
pub type ModeSolution = ModeState<Side>;

/// A state with at least one contact between its faces (theory, section 3, "Preload gap").
pub type GapState = ModeState<ContactState>;

/// A state of all contacts that solves the equations of some patterns.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeState<S> {
    /// The first pattern, in the order of enumeration, that gives the state.
    pub pattern: Vec<S>,
    /// The contacts in their gap and the share `lambda` of `d_k^+` in their preload friction
    /// `lambda d_k^+ + (1 - lambda) d_k^-`, `0 <= lambda <= 1`; none in a solution.
    pub shares: Vec<GapShare>,
    /// Sign of every normal force, 0 in the gap and on the boundary.
    pub signs: Vec<i8>,
    /// `y_k = |N_k|`, exactly 0 in the gap and on the boundary. For an exact problem, it is infinite if `y_k`
    /// is too large for `f64`, and at least the least positive number if it is too small.
    pub y: DVector<f64>,
    /// Signed normal forces `N_k = sigma_k y_k`.
    pub normal_force: DVector<f64>,
    /// `D = det [c_k^{sigma_k}]` of `pattern`, with `-(d_k^+ - d_k^-)` as the column of a contact in its gap.
    pub determinant: f64,
    /// Pressed contacts with `y_k = 0` within `tolerance`.
    pub on_boundary: Vec<usize>,
    /// The patterns that give this state, at most [`Limits::listed`](crate::Limits::listed). A search of a large
    /// group lists those that it examined: on a boundary there may be others, whose solutions are the same.
    pub patterns: Vec<Vec<S>>,
    /// Number of patterns that give this state; of a large group, of those that were examined.
    pub pattern_count: u64,
    /// The largest error bound among the `y_k`, below which a `y_k` counts as zero.
    pub tolerance: f64,
    /// Whether it is not part of a continuum that was also found (a search of a large group examines few such
    /// parts): exactly, if the data are exact, otherwise
    /// within tolerances.
    pub maximal: bool,
    pub(crate) support: Support,
    /// The statement that is proven about it.
    pub certificate: Certificate,
}

impl ModeSolution {
    /// `p = D prod_k sigma_k` of `pattern` (theory, section 5).
    pub fn oriented_determinant(&self) -> f64 {
        oriented(self.determinant, &self.pattern)
    }
}

/// `p = D prod_k sigma_k` (theory, section 5).
pub(crate) fn oriented(determinant: f64, pattern: &[Side]) -> f64 {
    pattern.iter().fold(determinant, |product, side| product * side.sign())
}

/// How the preload friction of a contact in its gap is divided between the faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapShare {
    /// The contact, from 0.
    pub contact: usize,
    /// The share of the positive side, from 0 to 1.
    pub lambda: f64,
}

/// A pattern with `D = 0` within tolerance, and what it admits.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularMode {
    /// The first pattern, in the order of enumeration; including gap states if they were tried.
    pub pattern: Vec<ContactState>,
    /// The singular patterns that admit this set: several only if it is not empty; at most
    /// [`Limits::listed`](crate::Limits::listed). A search of a large group lists those that it examined.
    pub patterns: Vec<Vec<ContactState>>,
    /// Number of singular patterns that admit this set; of a large group, of those that were examined.
    pub pattern_count: u64,
    /// The solutions that the pattern admits. For a pattern with gap states, this is the set of its normal
    /// forces; the shares `lambda` may vary as well.
    pub set: SolutionSet,
    /// If the set is a point, the shares of the contacts in their gaps; if they vary, those of one of the
    /// states.
    pub shares: Vec<GapShare>,
    /// Whether the set is a point with several states that have these normal forces but different shares.
    pub shares_vary: bool,
    /// Indices of the entries of [`Solutions::solutions`] that are vertices of the set, and are therefore
    /// reported there as well.
    pub contains: Vec<usize>,
    /// Whether it is not part of a larger continuum that was also found (a search of a large group examines few such
    /// parts): exactly, if the data are exact,
    /// otherwise within tolerances.
    pub maximal: bool,
    pub(crate) support: Support,
    /// The statement that is proven about it.
    pub certificate: Certificate,
}

/// A regular pattern close to locking.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosestMode {
    /// The pattern.
    pub pattern: Vec<Side>,
    /// `D = det [c_k^{sigma_k}]`, not zero.
    pub determinant: f64,
    /// `p = D prod_k sigma_k`.
    pub oriented_determinant: f64,
    /// The solution of the pattern's equations; at least one `y_k` is negative.
    pub y: DVector<f64>,
}

/// Number of patterns with each outcome. Every pattern is in exactly one of the counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PatternCounts {
    /// All `y_k > 0`.
    pub solution: u64,
    /// Solutions with at least one `y_k = 0`, or a share `lambda` of 0 or 1; for data within bounds, those
    /// for which that could not be ruled out.
    pub boundary: u64,
    /// Some `y_k < 0`.
    pub no_solution: u64,
    /// `D = 0`, and no `y >= 0` solves the equations: locking of the mode.
    pub singular_empty: u64,
    /// `D = 0`, and exactly one `y >= 0` solves the equations.
    pub singular_point: u64,
    /// `D = 0`, and a continuum of `y >= 0` solves the equations.
    pub singular_continuum: u64,
    /// `D = 0`, or so close to it that only a closer examination could tell, which was not started or not
    /// completed: it would have exceeded [`Limits::singular`](crate::Limits::singular) or
    /// [`Limits::bases`](crate::Limits::bases), or numbers overflowed.
    pub not_examined: u64,
    /// For data within bounds only: [`UndecidedPattern`].
    pub undecided: u64,
}

impl PatternCounts {
    /// The sum of all counts.
    pub fn total(&self) -> u64 {
        self.solution
            + self.boundary
            + self.no_solution
            + self.singular_empty
            + self.singular_point
            + self.singular_continuum
            + self.not_examined
            + self.undecided
    }

    /// Adds the counts of other patterns.
    pub(crate) fn add(&mut self, other: &Self) {
        self.solution += other.solution;
        self.boundary += other.boundary;
        self.no_solution += other.no_solution;
        self.singular_empty += other.singular_empty;
        self.singular_point += other.singular_point;
        self.singular_continuum += other.singular_continuum;
        self.not_examined += other.not_examined;
        self.undecided += other.undecided;
    }

    pub(crate) fn count_set(&mut self, set: &SolutionSet) {
        match set {
            SolutionSet::Empty => self.singular_empty += 1,
            SolutionSet::Point(_) => self.singular_point += 1,
            SolutionSet::NotComputed => self.not_examined += 1,
            SolutionSet::Segment { .. }
            | SolutionSet::Ray { .. }
            | SolutionSet::Polytope { .. }
            | SolutionSet::Product(_) => {
                self.singular_continuum += 1;
            }
        }
    }
}

/// Everything that an enumeration found. Lists are in the order of enumeration: lexicographic by pattern,
/// with contact 0 first, and positive before negative before gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Solutions {
    /// The outcome of all `2^r` patterns.
    pub counts: PatternCounts,
    /// The outcome of the `2^(r-j) 3^j - 2^r` patterns with gap states that `j` contacts with a
    /// jump add.
    pub gap_counts: PatternCounts,
    /// Solutions of regular patterns, each reported once.
    pub solutions: Vec<ModeSolution>,
    /// Preload-gap states that are not already in `solutions`.
    pub gaps: Vec<GapState>,
    /// Singular patterns that were examined: each set is reported once, but patterns without a solution are
    /// reported individually.
    pub singular: Vec<SingularMode>,
    /// Patterns that have a solution only for some of the values within bounds, if any, and none at the
    /// midpoint.
    pub undecided: Vec<UndecidedPattern>,
    /// Up to four regular patterns with the smallest `|D|`, if `solutions` is empty.
    pub closest: Vec<ClosestMode>,
}

impl Solutions {
    /// Whether every pattern's outcome is known.
    pub fn is_complete(&self) -> bool {
        self.counts.not_examined == 0 && self.gap_counts.not_examined == 0
    }

    /// Whether there is nothing at all: no solution, no gap state, no singular pattern that admits anything,
    /// and nothing left unexamined.
    pub fn is_jammed(&self) -> bool {
        self.is_complete() && self.admits_nothing()
    }

    /// Whether nothing was found.
    pub(crate) fn admits_nothing(&self) -> bool {
        self.solutions.is_empty()
            && self.gaps.is_empty()
            && self.undecided.is_empty()
            && self.singular.iter().all(|mode| mode.set == SolutionSet::Empty)
    }
}
