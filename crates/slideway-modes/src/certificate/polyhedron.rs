//! The exact set of solutions that a singular pattern admits.

use std::collections::HashSet;

use dashu_ratio::RBig;
use nalgebra::DVector;

use crate::interval::Interval;
use crate::problem::{ContactState, SetPart, SolutionSet};

/// All admissible solutions of a singular pattern's equations: `y_k >= 0`, and `0 <= lambda_k <= 1` for a
/// contact in its gap. Points and directions have one entry per contact, `y_k` or `lambda_k`.
pub type ExactSet = SolutionSet<Vec<RBig>>;

impl ExactSet {
    /// The signed normal forces `N_k = sigma_k y_k` of the set, rounded; shares are omitted, so points that
    /// differ only in them coincide.
    ///
    /// For a pattern with several contacts in their gaps, the vertices may include points that are not
    /// corners once the shares are omitted.
    pub fn normal_forces(&self, pattern: &[ContactState]) -> SolutionSet {
        match self {
            Self::NotComputed => return SolutionSet::NotComputed,
            Self::Product(parts) => {
                return SolutionSet::Product(
                    parts.iter().map(|part| forces_of_part(part, pattern)).collect(),
                );
            }
            _ => {}
        }
        let vertices = distinct(self.vertices().into_iter().map(|point| signed_forces(point, pattern)));
        let directions = distinct(self.directions().into_iter().filter_map(|direction| {
            let forces = signed_forces(direction, pattern);
            scaled_to_one(forces)
        }));
        SolutionSet::from_corners(vertices, directions).map(&rounded)
    }
}

/// A part of a set with the signed normal forces, rounded.
fn forces_of_part(part: &SetPart<Vec<RBig>>, pattern: &[ContactState]) -> SetPart<DVector<f64>> {
    let states: Vec<ContactState> = part.contacts.iter().map(|&contact| pattern[contact]).collect();
    SetPart {
        contacts: part.contacts.clone(),
        inside: rounded(signed_forces(&part.inside, &states)),
        dimension: part.dimension,
        set: part.set.normal_forces(&states),
    }
}

#[expect(clippy::needless_pass_by_value, reason = "the image of a point that is mapped")]
fn rounded(point: Vec<RBig>) -> DVector<f64> {
    DVector::from_iterator(point.len(), point.iter().map(nearest))
}

fn signed_forces(point: &[RBig], pattern: &[ContactState]) -> Vec<RBig> {
    let signed = |(value, state): (&RBig, &ContactState)| match state {
        ContactState::Positive => value.clone(),
        ContactState::Negative => -value.clone(),
        ContactState::Gap => RBig::ZERO,
    };
    point.iter().zip(pattern).map(signed).collect()
}

/// Divided by the size of the largest component; `None` if all are zero.
pub(super) fn scaled_to_one(direction: Vec<RBig>) -> Option<Vec<RBig>> {
    let size = |value: &RBig| if *value < RBig::ZERO { -value.clone() } else { value.clone() };
    let largest = direction.iter().map(size).max().filter(|largest| !largest.is_zero())?;
    Some(direction.into_iter().map(|value| value / &largest).collect())
}

/// The nearest number; one with the sign of the value if it is too small to have any.
fn nearest(value: &RBig) -> f64 {
    match value.to_f64().value() {
        0.0 => Interval::around_ratio(value).nonzero_middle(),
        number => number,
    }
}

fn distinct(points: impl Iterator<Item = Vec<RBig>>) -> Vec<Vec<RBig>> {
    let mut known = HashSet::new();
    points.filter(|point| known.insert(point.clone())).collect()
}
