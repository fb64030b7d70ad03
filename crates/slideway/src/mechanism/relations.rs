//! The relations in the formulas of loads and drives: where these jump or have a kink.

use super::{LoadKind, Mechanism, Quantity};
use crate::expression::{Piece, RelationKind};
use crate::ids::FormulaId;
use std::sync::Arc;

/// A relation in the formula of a load or of a drive.
#[derive(Debug, Clone)]
pub(crate) struct Relation {
    /// The load or drive.
    pub(crate) owner: Arc<str>,
    /// The formula.
    pub(crate) formula: FormulaId,
    /// Its number within the formula.
    pub(crate) number: usize,
    /// What is known of it.
    pub(crate) kind: RelationKind,
}

/// The piece of every relation of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pieces {
    /// Where the relations of each formula begin.
    first: Arc<[usize]>,
    list: Vec<Piece>,
}

impl Pieces {
    /// All relations follow their arguments.
    pub(crate) fn free(mechanism: &Mechanism, relations: &[Relation]) -> Self {
        let formulas = 0..=mechanism.formulas.len();
        let first = formulas.map(|id| relations.partition_point(|relation| relation.formula.index() < id));
        Self { first: first.collect(), list: vec![Piece::Free; relations.len()] }
    }

    /// Those of a formula.
    pub(crate) fn of(&self, formula: FormulaId) -> &[Piece] {
        &self.list[self.first[formula.index()]..self.first[formula.index() + 1]]
    }

    /// That of a relation, in the order of [`Mechanism::relations`].
    pub(crate) fn piece(&self, relation: usize) -> Piece {
        self.list[relation]
    }

    /// Puts a relation on a piece.
    pub(crate) fn set(&mut self, relation: usize, piece: Piece) {
        self.list[relation] = piece;
    }
}

impl Mechanism {
    /// The relations in the formulas of loads and drives, in the order of these formulas.
    pub(crate) fn relations(&self) -> Vec<Relation> {
        let loads = self.loads.iter().flat_map(|load| {
            quantities(&load.kind).into_iter().map(|quantity| (&load.name, quantity)).collect::<Vec<_>>()
        });
        let drives = self.drives.iter().map(|drive| (&drive.name, drive.acceleration));
        let mut formulas: Vec<(FormulaId, &Arc<str>)> = loads
            .chain(drives)
            .filter_map(|(owner, quantity)| match quantity {
                Quantity::Varying(id) => Some((id, owner)),
                Quantity::Constant(_) => None,
            })
            .collect();
        formulas.sort_by_key(|(id, _)| id.index());
        formulas.dedup_by_key(|(id, _)| id.index());
        let of_formula = |(formula, owner): (FormulaId, &Arc<str>)| {
            let kinds = self.formulas[formula.index()].expression.relations().into_iter().enumerate();
            let owner = owner.clone();
            kinds.map(move |(number, kind)| Relation { owner: owner.clone(), formula, number, kind })
        };
        formulas.into_iter().flat_map(of_formula).collect()
    }
}

/// The numbers of a load that may vary.
fn quantities(kind: &LoadKind) -> Vec<Quantity> {
    match kind {
        LoadKind::Force { components, .. } => components.to_vec(),
        LoadKind::Torque { moment, .. } => vec![*moment],
        LoadKind::Spring { stiffness, free_length, .. } => vec![*stiffness, *free_length],
        LoadKind::Damper { damping, .. } | LoadKind::TorsionalDamper { damping, .. } => vec![*damping],
        LoadKind::TorsionalSpring { stiffness, free_angle, .. } => vec![*stiffness, *free_angle],
    }
}
