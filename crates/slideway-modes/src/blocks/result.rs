//! What a search of a block problem returns.

use crate::certificate::Sign;
use crate::interval::Interval;
use crate::problem::ContactState;
use crate::search::StopReason;
use crate::solutions::GapShare;
use crate::status::Proof;

/// One solution of a block problem, proven to exist, with no other one near it.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockSolution {
    /// The state of each contact; of one whose side is not certain (`on_boundary`), that of the computed value.
    pub states: Vec<ContactState>,
    /// Normal forces `N_k`, with their signs.
    pub forces: Vec<f64>,
    /// Reactions `R_j` of the hinges.
    pub reactions: Vec<[f64; 2]>,
    /// `w`: `|N_k|` of the contacts, then `|R_j|` of the hinges.
    pub magnitudes: Vec<f64>,
    /// The shares of contacts in their gap.
    pub gaps: Vec<GapShare>,
    /// The contacts whose normal force may be zero: on the boundary between two sides.
    pub on_boundary: Vec<usize>,
    /// The hinges whose reaction may be zero.
    pub unloaded: Vec<usize>,
    /// The proven sign of `det(I - H D)`, where `D` holds the directions `x_j / |x_j|`: 1 or -1. `None` if the
    /// solution lies where directions or sides are not certain and the signs differ.
    pub orientation: Option<Sign>,
    /// Enclosures of the unknowns `x`, row by row: the solution lies within. Contacts in their gap have the
    /// share `lambda` in place of the normal force.
    pub enclosure: Vec<Interval>,
    /// The greatest distance of a component from the computed one in this enclosure.
    pub radius: f64,
}

/// What stands in the way of a decision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpenLabel {
    /// Two solutions merge, or nearly so.
    Fold,
    /// A direction in which solutions run to infinity: `|H w| = w` in every block, for `w` that is not zero.
    LockingDirection,
    /// A curve of solutions.
    Continuum,
    /// A hinge whose reaction vanishes, where the equations are not regular.
    UnloadedHinge,
    /// A contact between two sides, where the equations are not regular or the right-hand side jumps.
    Boundary,
    /// Too small to decide within rounding or the bounds of the data.
    TooSmall,
}

impl OpenLabel {
    /// The label in words.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::LockingDirection => "locking direction",
            Self::Continuum => "continuum",
            Self::UnloadedHinge => "unloaded hinge",
            Self::Boundary => "boundary",
            Self::TooSmall => "too small to decide",
        }
    }
}

/// A region in which it is open whether there are solutions.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenRegion {
    /// What is seen there.
    pub label: OpenLabel,
    /// The states of contacts; `None` if any is possible.
    pub states: Vec<Option<ContactState>>,
    /// For each hinge two directions between which, counted counterclockwise from the first, its reaction
    /// lies; `None` if any is possible.
    pub sectors: Vec<Option<[[f64; 2]; 2]>>,
    /// A point of the region, or near it: `x`, row by row; of a locking direction, a vector along it.
    pub point: Vec<f64>,
    /// Half the angle of the widest sector, in rad; pi if any direction is possible.
    pub half_angle: f64,
}

/// Why there is exactly one solution for every load (theory of hinges, section 3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UniqueForEveryLoad {
    /// The spectral radius of the matrix of block norms is below 1.
    BlockNorms,
    /// The largest singular value of every pattern, scaled by Perron vectors, is below 1.
    ScaledNorm,
}

/// The answer of a search.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockResult {
    /// All solutions that were found, each proven, ordered by states and then by forces and reactions.
    pub solutions: Vec<BlockSolution>,
    /// The regions that were not decided.
    pub open: Vec<OpenRegion>,
    /// Whether `solutions` is proven complete: nothing is open and the search went to its end.
    pub complete: Proof,
    /// Why the search ended early, if it did.
    pub stopped: Option<StopReason>,
    /// Nodes of the search; 1 if a proof of uniqueness settled everything.
    pub nodes: u64,
    /// Why there is exactly one solution for every load, if that is proven.
    pub unique_for_every_load: Option<UniqueForEveryLoad>,
}
