//! The coefficients of friction and preloads that follow from varied parameters, without the rest of the
//! model.

use super::quantity::Kind;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::FormulaId;
use crate::mechanism::{FrictionCircle, Mechanism};
use crate::model::{HingeFriction, Model};
use std::sync::Arc;

/// Coefficients of friction and preload of a contact at its two faces, before the common factor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Friction {
    pub(super) mu: [f64; 2],
    pub(super) preload: [f64; 2],
}

impl Friction {
    /// Returns the friction of every contact.
    pub(super) fn of(mechanism: &Mechanism) -> Vec<Self> {
        let contacts = mechanism.contacts.iter();
        contacts.map(|contact| Self { mu: contact.mu, preload: contact.preload }).collect()
    }
}

/// Which formulas to evaluate anew at a point.
#[derive(Debug, Clone)]
pub(super) struct FrictionFormulas {
    /// The varied parameters: their number, and their place among the varied quantities.
    given: Vec<(usize, usize)>,
    /// Parameters that follow from them, in the order in which they are evaluated.
    following: Vec<usize>,
    /// Coefficients and preloads that follow from them.
    contacts: Vec<ContactFormulas>,
    /// Friction of hinges that follows from them, with the number of its friction circle.
    circles: Vec<(usize, HingeFriction)>,
    /// All parameters in the model's own state.
    pub(super) parameters: Vec<f64>,
}

#[derive(Debug, Clone)]
struct ContactFormulas {
    contact: usize,
    name: Arc<str>,
    mu: [FormulaId; 2],
    mu_static: [FormulaId; 2],
    /// Where the preload varies.
    preload: [Option<FormulaId>; 2],
}

impl FrictionFormulas {
    /// The formulas of friction that the varied parameters change; none if they change something else, too,
    /// or if friction depends on sliding speeds, or is divided among the faces of press fits.
    ///
    /// # Errors
    /// Values of the model that are not allowed.
    pub(super) fn new(model: &Model, varied: &[Kind]) -> Result<Option<Self>, Faults> {
        let given: Vec<(usize, usize)> = varied
            .iter()
            .enumerate()
            .filter_map(
                |(place, kind)| if let Kind::Parameter(index) = kind { Some((*index, place)) } else { None },
            )
            .collect();
        let uses = |id: FormulaId| given.iter().any(|(index, _)| model.uses(id, *index));
        let mut contacts = Vec::new();
        let depends_on_speed = model.contacts().flat_map(|contact| contact.mu);
        let depends_on_speed = depends_on_speed.into_iter().any(|mu| model.formula(mu).depends_on_speed());
        let has_press_fits = model.contacts().any(|contact| contact.face.is_some());
        if depends_on_speed
            || has_press_fits
            || given.iter().any(|(index, _)| !model.changes_friction_or_pins_alone(*index))
        {
            return Ok(None);
        }
        for (number, contact) in model.contacts().enumerate() {
            if contact.friction().any(uses) {
                contacts.push(ContactFormulas {
                    contact: number,
                    name: contact.name.clone(),
                    mu: contact.mu,
                    mu_static: contact.mu_static,
                    preload: contact.preload.map(|id| id.filter(|id| uses(*id))),
                });
            }
        }
        let changes = |friction: &HingeFriction| friction.formulas().any(uses);
        let circles = model.hinge_friction().enumerate().filter(|(_, friction)| changes(friction)).collect();
        let numbers: Vec<usize> = given.iter().map(|(index, _)| *index).collect();
        let following = model.following(&numbers);
        let parameters = model.parameter_values(&model.constants()?);
        Ok(Some(Self { given, following, contacts, circles, parameters }))
    }

    /// Puts the radii of a point into the friction circles; `parameters` are its own.
    ///
    /// # Errors
    /// Values that are not allowed.
    pub(super) fn put_circles(
        &self,
        model: &Model,
        parameters: &[f64],
        mechanism: &Mechanism,
        circles: &mut [FrictionCircle],
    ) -> Result<(), Faults> {
        for (index, friction) in &self.circles {
            let mut values = Vec::new();
            for id in friction.formulas() {
                values.push((id, model.formula(id).constant(parameters)?));
            }
            let value =
                |id: FormulaId| values.iter().find(|(other, _)| *other == id).map(|(_, value)| *value);
            let circle = &mut circles[*index];
            let name = &mechanism.joints[circle.joint.index()].name;
            if let Some(fault) = model.static_below_kinetic(name, friction.kinetic_and_static(), &value) {
                return Err(fault.into());
            }
            let raw = FrictionCircle::new(circle.joint, friction, |id| value(id).unwrap_or(f64::NAN));
            *circle = raw.times(model.friction);
        }
        Ok(())
    }

    /// Puts the friction of a point into that of all contacts; `parameters` are those of another point.
    ///
    /// # Errors
    /// Values that are not allowed.
    pub(super) fn apply(
        &self,
        model: &Model,
        values: &[f64],
        parameters: &mut [f64],
        friction: &mut [Friction],
    ) -> Result<(), Faults> {
        for (index, place) in &self.given {
            parameters[*index] = values[*place];
        }
        for index in &self.following {
            if self.given.iter().all(|(given, _)| given != index) {
                parameters[*index] = model.formula(model.parameters[*index].value).constant(parameters)?;
            }
        }
        for formulas in &self.contacts {
            let contact = &mut friction[formulas.contact];
            let value = |id: FormulaId| model.formula(id).constant(parameters);
            for side in 0..2 {
                let is_same = side == 1 && formulas.mu[1] == formulas.mu[0];
                contact.mu[side] =
                    if is_same { contact.mu[0] } else { model.friction * value(formulas.mu[side])? };
                if let Some(preload) = formulas.preload[side] {
                    contact.preload[side] = value(preload)?;
                }
                if formulas.mu_static[side] != formulas.mu[side] {
                    formulas.check_static(side, model, parameters, contact.mu[side])?;
                }
            }
        }
        Ok(())
    }
}

impl ContactFormulas {
    /// Refuses a static coefficient below the kinetic one.
    fn check_static(&self, side: usize, model: &Model, parameters: &[f64], mu: f64) -> Result<(), Faults> {
        let formula = model.formula(self.mu_static[side]);
        let mu_static = model.friction * formula.constant(parameters)?;
        if mu_static >= mu {
            return Ok(());
        }
        let kind = FaultKind::StaticBelowKinetic { contact: self.name.to_string(), mu, mu_static };
        Err(Fault::new(kind, formula.origin.place()).into())
    }
}
