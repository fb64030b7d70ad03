//! Hinges, and the two ways to give their friction.

use super::super::file::HingeTable;
use super::super::quantity::{Quantity, Span};
use super::super::{Hinge, HingeFriction};
use super::{Reader, Wanted};
use crate::expression::Dimension;
use crate::fault::FaultKind;
use crate::ids::FormulaId;

impl Reader<'_> {
    pub(super) fn hinge(&mut self, table: &HingeTable, name: &str, span: &Span) -> Hinge {
        let [first, second] = &table.between;
        let between = [self.attachment(first), self.attachment(second)];
        Hinge { between, friction: self.hinge_friction(table, name, span) }
    }

    /// The friction that a table gives, as that of a pin or as friction circle; nothing if it gives none.
    fn hinge_friction(&mut self, table: &HingeTable, name: &str, span: &Span) -> Option<HingeFriction> {
        let HingeTable { mu, mu_static, radius, law, friction_radius, static_friction_radius, .. } = table;
        let of_pin = [
            ("mu", mu.is_some()),
            ("radius", radius.is_some()),
            ("mu_static", mu_static.is_some()),
            ("law", law.is_some()),
        ];
        let of_circle = [
            ("friction_radius", friction_radius.is_some()),
            ("static_friction_radius", static_friction_radius.is_some()),
        ];
        let given =
            |keys: &[(&'static str, bool)]| keys.iter().find(|(_, given)| *given).map(|(key, _)| *key);
        match (given(&of_pin), given(&of_circle)) {
            (None, None) => None,
            (Some(first), Some(second)) => {
                self.fault(FaultKind::Both { owner: name.to_owned(), first, second }, span);
                None
            }
            (Some(key), None) => {
                let dimension = Dimension::NONE;
                let names = ["friction coefficient", "static friction coefficient"];
                let mu =
                    self.kinetic_and_static([mu, mu_static], ["mu", key], names, dimension, (name, span));
                let wanted = Wanted::constant(format!("the radius of the pin of {name}"), Dimension::LENGTH);
                let radius = radius.as_ref().map(|radius| self.formula(radius, wanted.not_negative()));
                if mu.is_some() && radius.is_none() {
                    self.without(name, "mu", "radius", span);
                }
                Some(HingeFriction::Pin { mu: mu?, radius: radius?, law: law.unwrap_or_default() })
            }
            (None, Some(key)) => {
                let names = ["friction radius", "static friction radius"];
                let keys = ["friction_radius", key];
                let written = [friction_radius, static_friction_radius];
                let radii = self.kinetic_and_static(written, keys, names, Dimension::LENGTH, (name, span))?;
                Some(HingeFriction::Circle(radii))
            }
        }
    }

    /// The kinetic and the static value; without the latter both are the kinetic one, and without the former what
    /// the second of `keys` gives says too little.
    fn kinetic_and_static(
        &mut self,
        [kinetic, at_rest]: [&Option<Quantity>; 2],
        [wanted_key, given_key]: [&'static str; 2],
        names: [&str; 2],
        dimension: Dimension,
        (name, span): (&str, &Span),
    ) -> Option<[FormulaId; 2]> {
        let [wanted, wanted_at_rest] =
            names.map(|what| Wanted::constant(format!("the {what} of {name}"), dimension).not_negative());
        let at_rest = at_rest.as_ref().map(|value| self.formula(value, wanted_at_rest));
        let Some(kinetic) = kinetic else {
            self.without(name, given_key, wanted_key, span);
            return None;
        };
        let kinetic = self.formula(kinetic, wanted);
        Some([kinetic, at_rest.unwrap_or(kinetic)])
    }

    fn without(&mut self, name: &str, first: &'static str, second: &'static str, span: &Span) {
        self.fault(FaultKind::Without { owner: name.to_owned(), first, second }, span);
    }
}
