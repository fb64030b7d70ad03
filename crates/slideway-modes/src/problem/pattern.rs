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

    /// The states that a contact can take, in the order of enumeration: with its gap if the right-hand side jumps with its side.
    pub(crate) fn options(has_jump: bool) -> &'static [Self] {
        if has_jump { &Self::ALL } else { &Self::PRESSED }
    }

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

/// The next pattern, with the last contact changing fastest; `false` after the last one.
pub(crate) fn advance<'s>(
    pattern: &mut [ContactState],
    states: impl Fn(usize) -> &'s [ContactState],
) -> bool {
    for contact in (0..pattern.len()).rev() {
        match states(contact).get(pattern[contact] as usize + 1) {
            Some(&next) => {
                pattern[contact] = next;
                return true;
            }
            None => pattern[contact] = ContactState::Positive,
        }
    }
    false
}

/// All patterns of contacts, in the order of enumeration, by whether each jumps; `None` if there are more than `limit`.
pub(crate) fn patterns(has_jump: &[bool], limit: u64) -> Option<Vec<Vec<ContactState>>> {
    let states = |contact: usize| ContactState::options(has_jump[contact]);
    let count: f64 = (0..has_jump.len()).map(|contact| states(contact).len() as f64).product();
    if count > limit as f64 {
        return None;
    }
    let mut pattern = vec![ContactState::Positive; has_jump.len()];
    let mut patterns = vec![pattern.clone()];
    while advance(&mut pattern, states) {
        patterns.push(pattern.clone());
    }
    Some(patterns)
}

/// The sides on which a contact may be pressed.
pub(crate) fn pressed_sides(state: Option<ContactState>) -> &'static [Side] {
    match state {
        Some(ContactState::Positive) => &[Side::Positive],
        Some(ContactState::Negative) => &[Side::Negative],
        Some(ContactState::Gap) => &[],
        None => &Side::BOTH,
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
    /// A set with more corners than are listed, by its parts, which vary independently of one another.
    Product(Vec<SetPart<P>>),
    /// It is known within tolerances only and takes more work than [`Limits::bases`](crate::Limits::bases); or, of a
    /// part, its corners are too many.
    NotComputed,
}

/// Some contacts in a set of solutions, which vary independently of the others; points have one entry for each.
#[derive(Debug, Clone, PartialEq)]
pub struct SetPart<P> {
    /// The contacts, from 0, in increasing order.
    pub contacts: Vec<usize>,
    /// A point inside it: what is positive anywhere in the part is positive there.
    pub inside: P,
    /// The dimension, that of shares included; `None` if only the corners are known.
    pub dimension: Option<usize>,
    /// Its corners; [`SolutionSet::NotComputed`] if they are too many.
    pub set: SolutionSet<P>,
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

    /// The vertices of the set; none if it is empty, or if they are not listed.
    pub fn vertices(&self) -> Vec<&P> {
        match self {
            Self::Empty | Self::NotComputed | Self::Product(_) => Vec::new(),
            Self::Point(point) => vec![point],
            Self::Segment { from, to } => vec![from, to],
            Self::Ray { from, .. } => vec![from],
            Self::Polytope { vertices, .. } => vertices.iter().collect(),
        }
    }

    /// The extreme directions of the set; none if it is bounded, or if they are not listed.
    pub fn directions(&self) -> Vec<&P> {
        match self {
            Self::Ray { direction, .. } => vec![direction],
            Self::Polytope { directions, .. } => directions.iter().collect(),
            Self::Empty | Self::NotComputed | Self::Product(_) | Self::Point(_) | Self::Segment { .. } => {
                Vec::new()
            }
        }
    }

    /// Whether the set contains more than one point.
    pub fn is_continuum(&self) -> bool {
        matches!(self, Self::Segment { .. } | Self::Ray { .. } | Self::Polytope { .. } | Self::Product(_))
    }

    /// Whether it is known to contain a point.
    pub fn has_points(&self) -> bool {
        !matches!(self, Self::Empty | Self::NotComputed)
    }

    /// The set with the images of all points and directions under a linear map that keeps vertices and
    /// extreme directions distinct.
    pub(crate) fn map<Q>(self, image: &dyn Fn(P) -> Q) -> SolutionSet<Q> {
        let all = |points: Vec<P>| points.into_iter().map(image).collect();
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
            Self::Product(parts) => {
                SolutionSet::Product(parts.into_iter().map(|part| part.map(image)).collect())
            }
        }
    }
}

impl<P> SetPart<P> {
    fn map<Q>(self, image: &dyn Fn(P) -> Q) -> SetPart<Q> {
        let Self { contacts, inside, dimension, set } = self;
        SetPart { contacts, inside: image(inside), dimension, set: set.map(image) }
    }

    /// The same with other numbers of its contacts.
    pub(crate) fn renumbered(self, number: impl Fn(usize) -> usize) -> Self {
        Self { contacts: self.contacts.into_iter().map(number).collect(), ..self }
    }
}

impl<V: Clone> SetPart<Vec<V>> {
    /// Only the contacts from `first` on, counted from there; `None` if there are none.
    pub(crate) fn starting_at(self, first: usize) -> Option<Self> {
        self.restricted(&|contact| contact >= first).map(|part| part.renumbered(|contact| contact - first))
    }

    /// Only some of the contacts, which the others do not restrict; `None` if there are none.
    pub(crate) fn restricted(self, keeps: &dyn Fn(usize) -> bool) -> Option<Self> {
        let places: Vec<usize> = (0..self.contacts.len()).filter(|&at| keeps(self.contacts[at])).collect();
        if places.is_empty() {
            return None;
        }
        let contacts = places.iter().map(|&at| self.contacts[at]).collect();
        let part = self.map(&|point| places.iter().map(|&at| point[at].clone()).collect());
        Some(Self { contacts, ..part })
    }
}
