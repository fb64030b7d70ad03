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
    /// Horizontal linear complementarity problem.
    Hlcp,
    /// Mode problem.
    Modes,
}

impl RawKind {
    /// All types.
    pub const ALL: [Self; 4] = [Self::Lcp, Self::Ave, Self::Hlcp, Self::Modes];

    /// The word for it in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Lcp => "lcp",
            Self::Ave => "ave",
            Self::Hlcp => "hlcp",
            Self::Modes => "modes",
        }
    }

    /// What it is, in words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Lcp => "Linear complementarity problem",
            Self::Ave => "Absolute value equation",
            Self::Hlcp => "Horizontal linear complementarity problem",
            Self::Modes => "Mode problem",
        }
    }

    /// What is to be solved.
    pub fn equation(self) -> &'static str {
        match self {
            Self::Lcp => "w = M z + q,  w >= 0,  z >= 0,  w_k z_k = 0",
            Self::Ave => "A x + B |x| = b",
            Self::Hlcp => "A w - B z = q,  w >= 0,  z >= 0,  w_k z_k = 0",
            Self::Modes => "sum_k c_k y_k = N(0) + sum_k d_k,  y >= 0,  columns by the signs of N",
        }
    }

    /// The arrays that are required; the last one is the vector that determines the size.
    pub fn required(self) -> &'static [&'static str] {
        match self {
            Self::Lcp => &["M", "q"],
            Self::Ave => &["A", "B", "b"],
            Self::Hlcp => &["A", "B", "q"],
            Self::Modes => &["columns_positive", "columns_negative", "right_hand_side"],
        }
    }

    /// The optional arrays: all of them or none.
    pub fn optional(self) -> &'static [&'static str] {
        match self {
            Self::Modes => &["jumps_positive", "jumps_negative"],
            _ => &[],
        }
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
