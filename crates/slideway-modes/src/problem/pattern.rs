//! The states of contacts in a pattern, and the sets of normal forces that a pattern may admit.

use nalgebra::DVector;

use crate::problem::side::Side;

/// The state of one contact in a pattern: pressed on one of its sides, or between its faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ContactState {
    /// `N > 0`.
    Positive,
    /// `N < 0`.
    Negative,
    /// `N = 0`, and the preload friction acts between the faces (theory, section 3).
    Gap,
}

impl ContactState {
    pub(crate) const PRESSED: [Self; 2] = [Self::Positive, Self::Negative];
    pub(crate) const ALL: [Self; 3] = [Self::Positive, Self::Negative, Self::Gap];

    /// The side on which the contact is pressed; `None` in the gap.
    pub fn side(self) -> Option<Side> {
        match self {
            Self::Positive => Some(Side::Positive),
            Self::Negative => Some(Side::Negative),
            Self::Gap => None,
        }
    }

    /// The sign of the normal force, 0 in the gap.
    pub fn sign(self) -> f64 {
        self.side().map_or(0.0, Side::sign)
    }
}

impl From<Side> for ContactState {
    fn from(side: Side) -> Self {
        match side {
            Side::Positive => Self::Positive,
            Side::Negative => Self::Negative,
        }
    }
}

/// The signed normal forces that a singular pattern admits.
#[derive(Debug, Clone, PartialEq)]
pub enum SolutionSet {
    /// No solution: locking of the mode.
    Empty,
    /// One solution.
    Point(DVector<f64>),
    /// All `N` between two ends.
    Segment {
        /// One end.
        from: DVector<f64>,
        /// The other end.
        to: DVector<f64>,
    },
    /// All `from + t direction`, `t >= 0`.
    Ray {
        /// The end of the ray.
        from: DVector<f64>,
        /// The direction, with a largest component of size 1.
        direction: DVector<f64>,
    },
    /// Convex combinations of the vertices plus nonnegative combinations of the directions.
    Polytope {
        /// The vertices.
        vertices: Vec<DVector<f64>>,
        /// Extreme directions, each with a largest component of size 1.
        directions: Vec<DVector<f64>>,
    },
    /// Describing the set takes more work than [`Limits::bases`](crate::Limits::bases) allows.
    NotComputed,
}

impl SolutionSet {
    /// The set with the given vertices and extreme directions, which are all different.
    pub(crate) fn from_corners(mut vertices: Vec<DVector<f64>>, mut directions: Vec<DVector<f64>>) -> Self {
        match (vertices.len(), directions.len()) {
            (0, _) => Self::Empty,
            (1, 0) => Self::Point(vertices.swap_remove(0)),
            (2, 0) => Self::Segment { to: vertices.swap_remove(1), from: vertices.swap_remove(0) },
            (1, 1) => Self::Ray { from: vertices.swap_remove(0), direction: directions.swap_remove(0) },
            _ => Self::Polytope { vertices, directions },
        }
    }

    /// The vertices of the set; none if it is empty or was not computed.
    pub fn vertices(&self) -> Vec<&DVector<f64>> {
        match self {
            Self::Empty | Self::NotComputed => Vec::new(),
            Self::Point(point) => vec![point],
            Self::Segment { from, to } => vec![from, to],
            Self::Ray { from, .. } => vec![from],
            Self::Polytope { vertices, .. } => vertices.iter().collect(),
        }
    }

    /// The extreme directions of the set; none if it is bounded or was not computed.
    pub fn directions(&self) -> Vec<&DVector<f64>> {
        match self {
            Self::Ray { direction, .. } => vec![direction],
            Self::Polytope { directions, .. } => directions.iter().collect(),
            Self::Empty | Self::NotComputed | Self::Point(_) | Self::Segment { .. } => Vec::new(),
        }
    }

    /// Whether the set contains more than one point.
    pub fn is_continuum(&self) -> bool {
        matches!(self, Self::Segment { .. } | Self::Ray { .. } | Self::Polytope { .. })
    }
}
