//! The relations in the formulas of loads, drives and friction: where these jump or have a kink.

use super::{LoadKind, Mechanism, Pad, Quantity};
use crate::expression::{Expression, Piece, RelationKind};
use crate::ids::{BodyId, ContactId, FormulaId, Frame};
use std::sync::Arc;

/// A relation in the formula of a load, of a drive, or of friction.
#[derive(Debug, Clone)]
pub(crate) struct Relation {
    /// The load, the drive, or the friction of a contact.
    pub(crate) owner: Arc<str>,
    /// The formula; that of a pad is no formula of the model.
    pub(crate) formula: FormulaId,
    /// A contact on whose sliding speed the formula depends: all that share it belong to one joint.
    pub(crate) contact: Option<ContactId>,
    /// The pad of which the formula is the force.
    pub(crate) pad: Option<Pad>,
    /// Its number within the formula.
    pub(crate) number: usize,
    /// Its dependence on time and rates, and whether its value jumps.
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
        let beyond = mechanism.pads().map(|(_, pad)| pad.formula.index() + 1);
        let formulas = 0..=beyond.fold(mechanism.formulas.len(), usize::max);
        let first = formulas.map(|id| relations.partition_point(|relation| relation.formula.index() < id));
        Self { first: first.collect(), list: vec![Piece::Free; relations.len()] }
    }

    /// Those of a formula.
    pub(crate) fn of(&self, formula: FormulaId) -> &[Piece] {
        &self.list[self.first[formula.index()]..self.first[formula.index() + 1]]
    }

    /// Returns the piece of a relation, in the order of [`Mechanism::relations`].
    pub(crate) fn piece(&self, relation: usize) -> Piece {
        self.list[relation]
    }

    /// Puts a relation on a piece.
    pub(crate) fn set(&mut self, relation: usize, piece: Piece) {
        self.list[relation] = piece;
    }
}

impl Mechanism {
    /// The pads among the loads, each with its name.
    pub(crate) fn pads(&self) -> impl Iterator<Item = (&Arc<str>, &Pad)> {
        self.loads.iter().filter_map(|load| match &load.kind {
            LoadKind::Pad(pad) => Some((&load.name, pad)),
            _ => None,
        })
    }

    /// The relations in the formulas of loads, drives and friction, in the order of these formulas, then
    /// those of pads.
    pub(crate) fn relations(&self) -> Vec<Relation> {
        let loads = self.loads.iter().flat_map(|load| {
            quantities(&load.kind).into_iter().map(|quantity| (&load.name, quantity)).collect::<Vec<_>>()
        });
        let drives = self.drives.iter().map(|drive| (&drive.name, drive.acceleration));
        let moving = loads.chain(drives).filter_map(|(owner, quantity)| match quantity {
            Quantity::Varying(id) => Some((id, owner.clone(), None)),
            Quantity::Constant(_) => None,
        });
        let laws = self.contacts.iter().enumerate().flat_map(|(k, contact)| {
            let owner: Arc<str> =
                format!("the friction of {}", self.joints[contact.joint.index()].name).into();
            contact.law.into_iter().flatten().map(move |id| (id, owner.clone(), Some(ContactId(k))))
        });
        let mut formulas: Vec<(FormulaId, Arc<str>, Option<ContactId>)> = moving.chain(laws).collect();
        formulas.sort_by_key(|(id, ..)| id.index());
        formulas.dedup_by_key(|(id, ..)| id.index());
        let of = |expression: &Expression, (formula, owner): (FormulaId, &Arc<str>), contact, pad| {
            let kinds = expression.relations().into_iter().enumerate();
            let one = |(number, kind)| Relation { owner: owner.clone(), formula, contact, pad, number, kind };
            kinds.map(one).collect::<Vec<_>>()
        };
        let of_model = formulas
            .iter()
            .flat_map(|(id, owner, contact)| of(self.expression(*id), (*id, owner), *contact, None));
        let of_pads =
            self.pads().flat_map(|(name, pad)| of(pad.law(), (pad.formula, name), None, Some(*pad)));
        of_model.chain(of_pads).collect()
    }
}

/// The bodies on which a load acts.
pub(crate) fn loaded_bodies(mechanism: &Mechanism, kind: &LoadKind) -> Vec<BodyId> {
    let frames = match kind {
        LoadKind::Force { at, reaction, .. } => [Some(at.frame), *reaction],
        LoadKind::Torque { body, reaction, .. } => [Some(*body), *reaction],
        LoadKind::Spring { between, .. } | LoadKind::Damper { between, .. } => {
            between.each_ref().map(|end| Some(end.frame))
        }
        LoadKind::TorsionalSpring { between, .. } | LoadKind::TorsionalDamper { between, .. } => {
            between.map(Some)
        }
        LoadKind::Pad(pad) => match mechanism.slider(pad.joint) {
            Some(slider) => [Some(slider.block), Some(slider.guide)],
            None => [None; 2],
        },
    };
    frames.into_iter().flatten().filter_map(Frame::body).collect()
}

/// The numbers of a load that may vary.
pub(crate) fn quantities(kind: &LoadKind) -> Vec<Quantity> {
    match kind {
        LoadKind::Force { components: [x, y], along_z, .. } => vec![*x, *y, *along_z],
        LoadKind::Torque { moment, tilt: [x, y], .. } => vec![*moment, *x, *y],
        LoadKind::Spring { stiffness, free_length, .. } => vec![*stiffness, *free_length],
        LoadKind::Damper { damping, .. } | LoadKind::TorsionalDamper { damping, .. } => vec![*damping],
        LoadKind::TorsionalSpring { stiffness, free_angle, .. } => vec![*stiffness, *free_angle],
        LoadKind::Pad(_) => Vec::new(),
    }
}
