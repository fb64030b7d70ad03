//! Numbers without a unit that have a dimension all the same: which it is follows from where they are used.

use super::{Formula, Model};
use crate::expression::{Dimension, Inferred, Symbol};
use crate::fault::{Place, Source};
use crate::ids::FormulaId;
use std::collections::{BTreeMap, BTreeSet};

/// A number without a unit that stands for a quantity with a dimension, and is taken in SI units.
#[derive(Debug, Clone)]
pub(crate) struct BareNumber {
    /// The formula in which it stands.
    pub(crate) formula: FormulaId,
    /// Its value, in the SI unit.
    pub(crate) value: f64,
    /// Where it stands.
    pub(crate) place: Place,
    /// Whether the formula is nothing else.
    pub(crate) is_all: bool,
}

/// Uses of the parameters: in which formulas each stands.
struct Uses {
    /// The parameter that a formula is the value of.
    parameter: Vec<Option<usize>>,
    /// The formulas in which a parameter stands.
    users: Vec<Vec<FormulaId>>,
    /// The place of a parameter in the order of evaluation.
    rank: Vec<usize>,
}

impl Model {
    /// The bare numbers that have this dimension: the model makes sense if they have it, and none if they are pure
    /// numbers. Of each formula that with the greatest magnitude. Zero has no unit, and numbers that come from programs
    /// are in SI units on purpose.
    pub(crate) fn bare_numbers(&self, dimension: Dimension) -> Vec<BareNumber> {
        let uses = self.all_uses();
        let inferred = self.inferred_parameters();
        let makes_sense = |id: FormulaId, step: usize, dimension: Dimension| {
            self.makes_sense((id, step, dimension), &uses, &inferred)
        };
        let one = |id: FormulaId| {
            let formula = self.formula(id);
            let found = formula.expression.bare_numbers().filter(|(step, value, _)| {
                *value != 0.0 && makes_sense(id, *step, dimension) && !makes_sense(id, *step, Dimension::NONE)
            });
            let (_, value, span) = found.max_by(|one, other| one.1.abs().total_cmp(&other.1.abs()))?;
            let alone = formula.expression.bare_number();
            let place = if alone.is_some() { formula.origin.place() } else { formula.origin.part(&span) };
            Some(BareNumber { formula: id, value: alone.unwrap_or(value), place, is_all: alone.is_some() })
        };
        (0..self.formulas.len())
            .map(FormulaId)
            .filter(|id| self.formula(*id).is_written())
            .filter_map(one)
            .collect()
    }

    /// Whether all dimensions fit if one number of a formula has this one.
    fn makes_sense(
        &self,
        (id, step, dimension): (FormulaId, usize, Dimension),
        uses: &Uses,
        inferred: &[Inferred],
    ) -> bool {
        let mut changed: BTreeMap<usize, Inferred> = BTreeMap::new();
        // Parameters whose users are to be looked at, in the order of evaluation: everything they use is settled.
        let mut next: BTreeSet<(usize, usize)> = BTreeSet::new();
        let assumed = self.formula(id).expression.assuming(step, Inferred::Known(dimension));
        let mut formulas = vec![(id, &assumed)];
        loop {
            for (id, expression) in formulas {
                let of = |symbol| match symbol {
                    Symbol::Parameter(index) if changed.contains_key(&index) => changed[&index],
                    _ => self.inferred(symbol, inferred),
                };
                let Ok(found) = expression.dimension(&of) else { return false };
                if self.formula(id).wanted.is_some_and(|wanted| !found.fits(wanted)) {
                    return false;
                }
                if let Some(parameter) =
                    uses.parameter[id.index()].filter(|_| self.formula(id).wanted.is_none())
                    && matches!(found, Inferred::Known(_))
                {
                    changed.insert(parameter, found);
                    next.insert((uses.rank[parameter], parameter));
                }
            }
            let Some((_, parameter)) = next.pop_first() else { return true };
            formulas =
                uses.users[parameter].iter().map(|&user| (user, &self.formula(user).expression)).collect();
        }
    }

    fn all_uses(&self) -> Uses {
        let mut uses = Uses {
            parameter: vec![None; self.formulas.len()],
            users: vec![Vec::new(); self.parameters.len()],
            rank: vec![0; self.parameters.len()],
        };
        for (index, parameter) in self.parameters.iter().enumerate() {
            uses.parameter[parameter.value.index()] = Some(index);
        }
        for (rank, &index) in self.evaluation_order.iter().enumerate() {
            uses.rank[index] = rank;
        }
        for (id, formula) in self.formulas.iter().enumerate() {
            for (symbol, _) in formula.expression.symbols() {
                if let Symbol::Parameter(index) = symbol {
                    uses.users[index].push(FormulaId(id));
                }
            }
        }
        uses
    }
}

impl Formula {
    /// Whether somebody wrote it: in the file, or as the text of a setting.
    fn is_written(&self) -> bool {
        !self.origin.span.is_empty()
            && (self.origin.source == Source::Model || self.origin.expression_start.is_some())
    }
}
