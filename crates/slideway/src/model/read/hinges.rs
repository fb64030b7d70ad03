//! Hinges, and the two ways to give their friction.

use super::super::file::{CollarTable, HingeCarries, HingeTable};
use super::super::quantity::{Quantity, Span};
use super::super::{Hinge, HingeFriction};
use super::{Reader, Wanted};
use crate::expression::Dimension;
use crate::fault::FaultKind;
use crate::ids::FormulaId;

/// What the names of both bearings of a pin end with.
pub(super) const ENDS: [&str; 2] = [".upper", ".lower"];

/// The end of the name of a hinge, what it carries out of the drawing if that is given, and the hinge.
type Bearing = (&'static str, Option<[bool; 3]>, Hinge);

/// What a hinge carries out of the drawing: along z, and about x and y.
fn carried(carries: HingeCarries) -> [bool; 3] {
    match carries {
        HingeCarries::All => [true; 3],
        HingeCarries::Z => [true, false, false],
        HingeCarries::Tilt => [false, true, true],
        HingeCarries::Nothing => [false; 3],
    }
}

impl Reader<'_> {
    /// A hinge, or the two bearings of its pin, each with the end of its name and what it carries, if that is given: the couples
    /// are carried by both together, the force along z by the lower one.
    pub(super) fn bearings(&mut self, table: &HingeTable, name: &str, span: &Span) -> Vec<Bearing> {
        let hinge = self.hinge(table, name, span);
        let Some(distance) = &table.bearings else {
            return vec![("", table.carries.map(carried), hinge)];
        };
        let wanted = Wanted::constant(format!("the distance of the bearings of {name}"), Dimension::LENGTH);
        let distance = self.formula(distance, wanted.positive());
        let along_z = table.carries.is_none_or(|carries| carried(carries)[0]);
        let upper = Hinge { raised: Some((0.5, distance)), collar: None, ..hinge.clone() };
        let lower = Hinge { raised: Some((-0.5, distance)), ..hinge };
        [(ENDS[0], false, upper), (ENDS[1], along_z, lower)]
            .map(|(end, along_z, hinge)| (end, Some([along_z, false, false]), hinge))
            .into()
    }

    fn hinge(&mut self, table: &HingeTable, name: &str, span: &Span) -> Hinge {
        let [first, second] = &table.between;
        let between = [self.attachment(first), self.attachment(second)];
        let collar = table.collar.as_ref().and_then(|collar| self.collar(collar, table.carries, name, span));
        Hinge { between, friction: self.hinge_friction(table, name, span), raised: None, collar }
    }

    /// The friction of a collar, which carries what the hinge does along z.
    fn collar(
        &mut self,
        table: &CollarTable,
        carries: Option<HingeCarries>,
        name: &str,
        span: &Span,
    ) -> Option<HingeFriction> {
        if matches!(carries, Some(HingeCarries::Tilt | HingeCarries::Nothing)) {
            self.fault(FaultKind::IdleCollar { joint: name.to_owned() }, span);
        }
        let written = [&Some(table.friction_radius.clone()), &table.static_friction_radius];
        let names = ["friction radius of the collar", "static friction radius of the collar"];
        let keys = ["friction_radius", "static_friction_radius"];
        self.kinetic_and_static(written, keys, names, Dimension::LENGTH, (name, span))
            .map(HingeFriction::Collar)
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
