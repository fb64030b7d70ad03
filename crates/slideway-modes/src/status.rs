//! The kind of an answer.

use serde::Serialize;
use std::fmt;

/// How many solutions there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// No solution: for a mechanism, friction locks it.
    None,
    /// Exactly one.
    One,
    /// Several, each in its own contact mode.
    Several,
    /// Infinitely many: a mode with a vanishing determinant admits a continuum.
    Continuum,
    /// No solution in a sign pattern was found, but there is a state with the preload between the faces;
    /// `partial` and `undecided_modes` show what else may be open.
    PreloadGap,
    /// Nothing was found, but not every pattern could be decided.
    Unknown,
}

/// Whether a list of solutions is proven complete.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Proof {
    /// It is proven complete.
    #[serde(rename = "proven")]
    Proven,
    /// It is not proven complete.
    #[serde(rename = "not proven")]
    NotProven,
}

impl Proof {
    /// "proven" or "not proven"
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Proven => "proven",
            Self::NotProven => "not proven",
        }
    }
}

impl fmt::Display for Proof {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.as_str())
    }
}
