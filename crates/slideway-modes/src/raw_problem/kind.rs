//! The types of raw problems and the names of their arrays.

use std::fmt;

use serde::Serialize;

/// The type of a raw problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RawKind {
    /// Linear complementarity problem.
    Lcp,
    /// Absolute value equation.
    Ave,
    /// Absolute value equation of blocks of one or two components.
    #[serde(rename = "block_ave")]
    BlockAve,
    /// Horizontal linear complementarity problem.
    Hlcp,
    /// Mixed linear complementarity problem: some unknowns are free.
    Mlcp,
    /// Mixed complementarity problem with a linear function: every unknown between two bounds.
    Mcp,
    /// Bimatrix game.
    Game,
    /// Mode problem.
    Modes,
}

impl RawKind {
    /// All types.
    pub const ALL: [Self; 8] =
        [Self::Lcp, Self::Ave, Self::BlockAve, Self::Hlcp, Self::Mlcp, Self::Mcp, Self::Game, Self::Modes];

    /// The word for it in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Lcp => "lcp",
            Self::Ave => "ave",
            Self::BlockAve => "block_ave",
            Self::Hlcp => "hlcp",
            Self::Mlcp => "mlcp",
            Self::Mcp => "mcp",
            Self::Game => "game",
            Self::Modes => "modes",
        }
    }

    /// Returns the name of the type in words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Lcp => "Linear complementarity problem",
            Self::Ave => "Absolute value equation",
            Self::BlockAve => "Absolute value equation of blocks",
            Self::Hlcp => "Horizontal linear complementarity problem",
            Self::Mlcp => "Mixed linear complementarity problem",
            Self::Mcp => "Mixed complementarity problem",
            Self::Game => "Bimatrix game",
            Self::Modes => "Mode problem",
        }
    }

    /// Returns the equations and conditions to be solved, as text.
    pub fn equation(self) -> &'static str {
        match self {
            Self::Lcp => "w = M z + q,  w >= 0,  z >= 0,  w_k z_k = 0",
            Self::Ave => "A x + B |x| = b",
            Self::BlockAve => "A x + B |x| = b,  |x|_j the length of block j",
            Self::Hlcp => "A w - B z = q,  w >= 0,  z >= 0,  w_k z_k = 0",
            Self::Mlcp => "A u + C z + a = 0,  w = D u + B z + b,  w >= 0,  z >= 0,  w_k z_k = 0",
            Self::Mcp => "w = M z + q,  l <= z <= u,  w_k >= 0 where z_k < u_k,  w_k <= 0 where z_k > l_k",
            Self::Game => {
                "x maximises x^T A y,  y maximises x^T B y (B = -A if not given),  x >= 0,  y >= 0,  sum x = sum y = 1"
            }
            Self::Modes => "sum_k c_k y_k = N(0) + sum_k d_k,  y >= 0,  columns by the signs of N",
        }
    }

    /// The arrays that are required.
    pub fn required(self) -> &'static [&'static str] {
        match self {
            Self::Lcp => &["M", "q"],
            Self::Ave => &["A", "B", "b"],
            Self::BlockAve => &["B", "b", "blocks"],
            Self::Hlcp => &["A", "B", "q"],
            Self::Mlcp => &["A", "B", "C", "D", "a", "b"],
            Self::Mcp => &["M", "q", "l", "u"],
            Self::Game => &["A"],
            Self::Modes => &["columns_positive", "columns_negative", "right_hand_side"],
        }
    }

    /// The optional arrays: all of them or none.
    pub fn optional(self) -> &'static [&'static str] {
        match self {
            Self::Modes => &["jumps_positive", "jumps_negative"],
            Self::Game => &["B"],
            Self::BlockAve => &["A"],
            _ => &[],
        }
    }

    /// The vectors whose lengths are the sizes of the problem: two for a mixed linear complementarity problem and for blocks,
    /// none for a game, whose sizes are the rows and columns of `A`.
    pub fn size_vectors(self) -> &'static [&'static str] {
        match self {
            Self::Lcp | Self::Hlcp | Self::Mcp => &["q"],
            Self::Ave => &["b"],
            Self::BlockAve => &["b", "blocks"],
            Self::Mlcp => &["a", "b"],
            Self::Game => &[],
            Self::Modes => &["right_hand_side"],
        }
    }

    /// Which sizes, by number, are the rows and the columns of an array; no columns of a vector.
    #[cfg(any(feature = "json", feature = "npz"))]
    pub(super) fn dimensions(self, name: &str) -> (usize, Option<usize>) {
        match (self, name) {
            (Self::Mlcp, "b") | (Self::BlockAve, "blocks") => (1, None),
            (Self::Mlcp, "B") => (1, Some(1)),
            (Self::Mlcp, "D") => (1, Some(0)),
            (Self::Mlcp, "C") | (Self::BlockAve, "B") | (Self::Game, _) => (0, Some(1)),
            (_, "a" | "b" | "q" | "l" | "u" | "right_hand_side") => (0, None),
            _ => (0, Some(0)),
        }
    }

    /// Whether an array holds bounds, which may be infinite.
    #[cfg(any(feature = "json", feature = "npz"))]
    pub(super) fn is_bound(self, name: &str) -> bool {
        self == Self::Mcp && matches!(name, "l" | "u")
    }

    /// Whether a file may leave out the type if it has these names: those of a game may be those of an
    /// equation without its right-hand side.
    #[cfg(any(feature = "json", feature = "npz"))]
    pub(super) fn is_told_by_names(self) -> bool {
        self != Self::Game
    }

    /// The names of all its arrays.
    pub fn names(self) -> Vec<&'static str> {
        [self.required(), self.optional()].concat()
    }
}

impl fmt::Display for RawKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.word())
    }
}
