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

/// What a singular pattern admits: points and directions of signed normal forces or, for an
/// [`ExactSet`](crate::certificate::ExactSet), of exact unknowns.
#[derive(Debug, Clone, PartialEq)]
pub enum SolutionSet<P = DVector<f64>> {
    /// No solution: locking of the mode.
    Empty,
    /// One solution.
    Point(P),
    /// All points between two ends.
    Segment {
        /// One end.
        from: P,
        /// The other end.
        to: P,
    },
    /// All `from + t direction`, `t >= 0`.
    Ray {
        /// The end of the ray.
        from: P,
        /// The direction, with a largest component of size 1.
        direction: P,
    },
    /// Convex combinations of the vertices plus nonnegative combinations of the directions.
    Polytope {
        /// The vertices.
        vertices: Vec<P>,
        /// Extreme directions, each with a largest component of size 1.
        directions: Vec<P>,
    },
    /// It has more corners than are described, or it is known within tolerances only and takes more work than
    /// [`Limits::bases`](crate::Limits::bases).
    NotComputed,
}

impl<P> SolutionSet<P> {
    /// The set with the given vertices and extreme directions, which are all different.
    pub(crate) fn from_corners(mut vertices: Vec<P>, mut directions: Vec<P>) -> Self {
        match (vertices.len(), directions.len()) {
            (0, _) => Self::Empty,
            (1, 0) => Self::Point(vertices.swap_remove(0)),
            (2, 0) => Self::Segment { to: vertices.swap_remove(1), from: vertices.swap_remove(0) },
            (1, 1) => Self::Ray { from: vertices.swap_remove(0), direction: directions.swap_remove(0) },
            _ => Self::Polytope { vertices, directions },
        }
    }

    /// The vertices of the set; none if it is empty or was not computed.
    pub fn vertices(&self) -> Vec<&P> {
        match self {
            Self::Empty | Self::NotComputed => Vec::new(),
            Self::Point(point) => vec![point],
            Self::Segment { from, to } => vec![from, to],
            Self::Ray { from, .. } => vec![from],
            Self::Polytope { vertices, .. } => vertices.iter().collect(),
        }
    }

    /// The extreme directions of the set; none if it is bounded or was not computed.
    pub fn directions(&self) -> Vec<&P> {
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

    /// The set with the images of all points and directions under a linear map that keeps vertices and
    /// extreme directions distinct.
    pub(crate) fn map<Q>(self, image: impl Fn(P) -> Q) -> SolutionSet<Q> {
        let all = |points: Vec<P>| points.into_iter().map(&image).collect();
        match self {
            Self::Empty => SolutionSet::Empty,
            Self::NotComputed => SolutionSet::NotComputed,
            Self::Point(point) => SolutionSet::Point(image(point)),
            Self::Segment { from, to } => SolutionSet::Segment { from: image(from), to: image(to) },
            Self::Ray { from, direction } => {
                SolutionSet::Ray { from: image(from), direction: image(direction) }
            }
            Self::Polytope { vertices, directions } => {
                SolutionSet::Polytope { vertices: all(vertices), directions: all(directions) }
            }
        }
    }
}
