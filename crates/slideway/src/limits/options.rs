//! Options of a search for limits.

use super::vary::Vary;

/// Certified searches that are made by default to prove numbers of solutions.
pub const EFFORT: u64 = 800;

/// Options of a search for limits: the varied quantity, and which modes count.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LimitsOptions {
    /// Quantity that is varied, over the usual ranges of [`crate::SizeOptions::vary`].
    pub vary: Vary,
    /// Modes count only where no normal force exceeds this (N).
    pub max_reaction: Option<f64>,
    /// Whether motion in the opposite direction is looked at, too.
    pub both_directions: bool,
    /// How many certified searches may be made in each direction to prove numbers of solutions over
    /// intervals; one that visits many nodes counts as several. With 0 nothing is proven.
    pub effort: u64,
}

impl LimitsOptions {
    /// The limits of what is named, in the direction of the model, whatever the reactions, with the usual
    /// effort.
    pub fn new(vary: Vary) -> Self {
        Self { vary, max_reaction: None, both_directions: false, effort: EFFORT }
    }

    /// Modes count only where no normal force exceeds this (N).
    #[must_use]
    pub fn max_reaction(mut self, force: impl Into<Option<f64>>) -> Self {
        self.max_reaction = force.into();
        self
    }

    /// Whether motion in the opposite direction is looked at, too.
    #[must_use]
    pub fn both_directions(mut self, both: bool) -> Self {
        self.both_directions = both;
        self
    }

    /// With so many certified searches in each direction at most.
    #[must_use]
    pub fn effort(mut self, searches: u64) -> Self {
        self.effort = searches;
        self
    }
}
