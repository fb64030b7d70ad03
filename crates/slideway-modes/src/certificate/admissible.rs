//! The admissible solutions of a pattern, as an exact set.

use dashu_int::IBig;
use dashu_ratio::RBig;

use super::cell::Cell;
use super::elimination::IntegerSystem;
use super::polyhedron::ExactSet;
use crate::problem::{ContactState, SetPart};

impl ExactSet {
    /// The admissible solutions of a pattern's equations, which are a [`Cell`]: each share has a complement
    /// `1 - lambda_k >= 0`. With more than `most` vertices and extreme directions, it is a product; `None`
    /// once `proceed` is `false`.
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

    /// A cell by its parts; those that are the same everywhere are one. The first unknowns are those of the
    /// contacts, and complements depend on them.
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
