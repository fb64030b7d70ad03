//! The exact set of solutions that a singular pattern admits.

use std::collections::HashSet;

use dashu_int::IBig;
use dashu_ratio::RBig;
use nalgebra::DVector;

use super::cell::Cell;
use super::elimination::IntegerSystem;
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

    /// The admissible solutions of a pattern's equations, which are a [`Cell`]: each share has a complement
    /// `1 - lambda_k >= 0`. With more than `most` vertices and extreme directions, it is a product; `None` once
    /// `proceed` is `false`.
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
        let cell = Cell::of_columns(&columns, &right, most, proceed)?;
        Some(match cell.set(most) {
            Self::NotComputed => Self::product(&cell, pattern.len()),
            set => set.map(&|point| point[..pattern.len()].to_vec()),
        })
    }

    /// A cell by its parts; those that are the same everywhere are one. The first unknowns are those of the contacts, and
    /// complements depend on them.
    fn product(cell: &Cell, contacts: usize) -> Self {
        let Some(inside) = cell.inside() else { return Self::Empty };
        let part = |contacts: Vec<usize>, dimension: usize, set: Self| {
            let inside: Vec<RBig> = contacts.iter().map(|&contact| inside[contact].clone()).collect();
            let set = if dimension == 0 { Self::Point(inside.clone()) } else { set };
            SetPart { contacts, inside, dimension: Some(dimension), set }
        };
        let varying = cell.parts().iter().filter(|part| part.dimension > 0);
        let varying = varying.map(|own| part(own.unknowns.clone(), own.dimension, own.set.clone()));
        let mut parts: Vec<SetPart<Vec<RBig>>> =
            varying.filter_map(|part| part.restricted(&|unknown| unknown < contacts)).collect();
        let varies = |contact: &usize| parts.iter().any(|part| part.contacts.contains(contact));
        let fixed: Vec<usize> = (0..contacts).filter(|contact| !varies(contact)).collect();
        if !fixed.is_empty() {
            parts.push(part(fixed, 0, Self::Empty));
        }
        Self::Product(parts)
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
