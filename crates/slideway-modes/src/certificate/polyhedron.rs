//! The exact set of solutions that a singular pattern admits.

use std::collections::HashSet;

use dashu_int::IBig;
use dashu_ratio::RBig;
use nalgebra::DVector;

use super::cell::Cell;
use super::elimination::IntegerSystem;
use crate::interval::Interval;
use crate::problem::{ContactState, SolutionSet};

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
        if *self == Self::NotComputed {
            return SolutionSet::NotComputed;
        }
        let vertices = distinct(self.vertices().into_iter().map(|point| signed_forces(point, pattern)));
        let directions = distinct(self.directions().into_iter().filter_map(|direction| {
            let forces = signed_forces(direction, pattern);
            scaled_to_one(forces)
        }));
        SolutionSet::from_corners(vertices, directions)
            .map(|point| DVector::from_iterator(point.len(), point.iter().map(nearest)))
    }

    /// The admissible solutions of a pattern's equations, which are a [`Cell`]: each share has a complement
    /// `1 - lambda_k >= 0`. They are not computed if there are more than `most` vertices and extreme
    /// directions; `None` once `proceed` is `false`.
    pub(super) fn of_system(
        system: &IntegerSystem,
        pattern: &[ContactState],
        most: usize,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        let (mut columns, mut right) = system.columns();
        for (contact, _) in pattern.iter().enumerate().filter(|(_, state)| **state == ContactState::Gap) {
            columns
                .iter_mut()
                .enumerate()
                .for_each(|(at, column)| column.push(i32::from(at == contact).into()));
            let mut complement = vec![IBig::ZERO; right.len()];
            complement.push(IBig::ONE);
            columns.push(complement);
            right.push(IBig::ONE);
        }
        let set = Cell::of_columns(&columns, &right, most, proceed)?.set(most);
        Some(set.map(|point| point[..pattern.len()].to_vec()))
    }
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

fn nearest(value: &RBig) -> f64 {
    Interval::around_ratio(value).nonzero_middle()
}

fn distinct(points: impl Iterator<Item = Vec<RBig>>) -> Vec<Vec<RBig>> {
    let mut known = HashSet::new();
    points.filter(|point| known.insert(point.clone())).collect()
}
