//! On what the mode problem depends, decided from the formulas and from where they stand in the mechanism.
//!
//! The numbers of the mode problem, eq. (6), are affine in a parameter where it stands in these places only,
//! each formula being affine in it while all others keep their values:
//!
//! | place | what is affine |
//! |---|---|
//! | coefficients of friction | the columns `c_k` |
//! | preloads | the jumps `d_k` |
//! | forces, moments, gravity, springs, dampers, prescribed accelerations | the right-hand side `N(0)` |
//! | masses and moments of inertia, if every coordinate is driven | the right-hand side: all accelerations are prescribed |
//!
//! A product such as weight or stiffness times elongation is affine if one of its factors is and the other is
//! constant.

use super::{ForceValue, Gravity, HingeFriction, Inertia, JointKind, LoadKind, Model, Moment, Slider};
use crate::expression::{Degree, Symbol, Values};
use crate::ids::FormulaId;
use std::collections::BTreeSet;

/// How the mode problem depends on a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Dependence {
    /// Degree of its numbers.
    pub(crate) problem: Degree,
    /// Degree of the values that only have to be allowed: static friction above kinetic, travel, stiffness of
    /// guides, pads.
    pub(crate) conditions: Degree,
    /// Whether static friction, which counts at rest alone, depends on it.
    pub(crate) at_rest: bool,
}

impl Model {
    /// How the mode problem depends on a parameter in a fixed state, the parameter itself having a value of
    /// its own.
    pub(crate) fn dependence(&self, parameter: usize) -> Dependence {
        let mut places = Places { model: self, parameters: self.degrees(parameter), seen: BTreeSet::new() };
        let loads = places.loads().max(places.weights()).max(places.accelerations());
        let affine = places.friction().max(places.fits()).max(loads);
        let at_rest = places.static_friction();
        let conditions = at_rest.max(places.conditions());
        let elsewhere = if places.others() == Degree::Constant { Degree::Constant } else { Degree::Other };
        Dependence { problem: affine.max(elsewhere), conditions, at_rest: at_rest != Degree::Constant }
    }

    /// Whether the mode problem depends on a parameter by the radii of friction circles alone, each of which is affine
    /// in the parameter, or follows from a coefficient of friction that is.
    pub(crate) fn varies_friction_circles(&self, parameter: usize) -> bool {
        let mut places = Places { model: self, parameters: self.degrees(parameter), seen: BTreeSet::new() };
        let loads = places.loads().max(places.weights()).max(places.accelerations());
        let others = loads.max(places.friction()).max(places.fits()).max(places.static_friction());
        let others = others.max(places.conditions());
        places.hinges() == Degree::Affine && others.max(places.others()) == Degree::Constant
    }

    /// The constant and the slope of a formula that does not depend on the motion and is affine in a
    /// parameter `p`, `constant + slope p`; none if it is not affine.
    pub(crate) fn line_of(&self, formula: FormulaId, parameter: usize) -> Option<[f64; 2]> {
        let mut places = Places { model: self, parameters: self.degrees(parameter), seen: BTreeSet::new() };
        if places.degree(formula) == Degree::Other {
            return None;
        }
        let [at_zero, at_one] = [0.0, 1.0].map(|value| self.value_at(formula, parameter, value));
        let constant = at_zero?;
        Some([constant, at_one? - constant])
    }

    /// The value that a formula of parameters would have with a value of one of them, whether or not it is
    /// allowed.
    fn value_at(&self, formula: FormulaId, parameter: usize, value: f64) -> Option<f64> {
        let mut parameters = vec![0.0; self.parameters.len()];
        let evaluate = |id: FormulaId, parameters: &[f64]| {
            let values = Values::of_parameters(parameters);
            self.formula(id).expression.evaluate(&values)
        };
        for &index in &self.evaluation_order {
            let own = self.parameters[index].value;
            // One without a value is not used, or has been refused before.
            let following = || evaluate(own, &parameters).unwrap_or(f64::NAN);
            parameters[index] = if index == parameter { value } else { following() };
        }
        evaluate(formula, &parameters).ok()
    }

    /// How all parameters depend on one.
    fn degrees(&self, parameter: usize) -> Vec<Degree> {
        let mut degrees = vec![Degree::Constant; self.parameters.len()];
        for &index in &self.evaluation_order {
            let formula = self.formula(self.parameters[index].value);
            degrees[index] = if index == parameter {
                Degree::Affine
            } else {
                formula.expression.degree(&|symbol| of_symbol(symbol, &degrees))
            };
        }
        degrees
    }
}

/// Coordinates, rates, sliding speeds and the time of a state are constants there.
fn of_symbol(symbol: Symbol, parameters: &[Degree]) -> Degree {
    match symbol {
        Symbol::Parameter(index) => parameters[index],
        Symbol::Coordinate(_) | Symbol::Rate(_) | Symbol::Time | Symbol::SlidingSpeed => Degree::Constant,
    }
}

/// A walk over all places where formulas stand.
struct Places<'m> {
    model: &'m Model,
    parameters: Vec<Degree>,
    seen: BTreeSet<FormulaId>,
}

impl Places<'_> {
    fn degree(&mut self, id: FormulaId) -> Degree {
        self.seen.insert(id);
        self.model.formula(id).expression.degree(&|symbol| of_symbol(symbol, &self.parameters))
    }

    fn greatest(&mut self, ids: impl IntoIterator<Item = FormulaId>) -> Degree {
        ids.into_iter().fold(Degree::Constant, |degree, id| degree.max(self.degree(id)))
    }

    fn friction(&mut self) -> Degree {
        let contacts = self.model.contacts();
        let ids =
            contacts.flat_map(|contact| contact.mu.into_iter().chain(contact.preload.into_iter().flatten()));
        self.greatest(ids.collect::<Vec<_>>())
    }

    /// Returns the degree of the play, misalignment and compliance of redundant contacts; the compliance is
    /// the inverse of the stiffness.
    fn fits(&mut self) -> Degree {
        let contacts = || self.model.contacts();
        let fits = contacts().flat_map(|contact| contact.play.into_iter().chain(contact.misalignment));
        let (fits, stiffness): (Vec<_>, Vec<_>) =
            (fits.collect(), contacts().filter_map(|contact| contact.stiffness).collect());
        match (self.greatest(fits), self.greatest(stiffness)) {
            (_, Degree::Affine | Degree::Other) if self.model.is_redundant() => Degree::Other,
            (fits, _) => fits,
        }
    }

    fn static_friction(&mut self) -> Degree {
        let own = |contact: &super::Contact| {
            let pairs = contact.mu_static.into_iter().zip(contact.mu);
            pairs
                .filter(|(mu_static, mu)| mu_static != mu)
                .map(|(mu_static, _)| mu_static)
                .collect::<Vec<_>>()
        };
        self.greatest(self.model.contacts().flat_map(own).collect::<Vec<_>>())
    }

    /// Kinetic friction in hinges; static friction counts at rest alone.
    fn hinges(&mut self) -> Degree {
        let mut greatest = Degree::Constant;
        for friction in self.model.hinge_friction().collect::<Vec<_>>() {
            self.greatest(friction.kinetic_and_static());
            let kinetic = self.degree(friction.kinetic_and_static()[0]);
            let degree = match friction {
                HingeFriction::Circle(_) | HingeFriction::End(_) | HingeFriction::Collar(_) => kinetic,
                HingeFriction::Pin { radius, .. } => match (kinetic, self.degree(radius)) {
                    (one, Degree::Constant) | (Degree::Constant, one) => one,
                    _ => Degree::Other,
                },
            };
            greatest = greatest.max(degree);
        }
        greatest
    }

    fn loads(&mut self) -> Degree {
        let pads = self.pads();
        self.model.loads.iter().fold(pads, |degree, load| degree.max(self.load(&load.kind)))
    }

    /// Pads at ends of travels: whether one pushes may change with any of its numbers.
    fn pads(&mut self) -> Degree {
        let sliders = self.model.joints.iter().filter_map(|joint| match &joint.kind {
            JointKind::Slider(slider) => Some(slider),
            JointKind::Hinge(_) => None,
        });
        let numbers = |slider: &Slider| {
            let ends = slider.travel.into_iter().flatten().zip(slider.stops);
            let pads = ends.filter_map(|(end, stop)| Some((end, stop?.pad()?)));
            pads.flat_map(|(end, [stiffness, damping])| [end, stiffness, damping]).collect::<Vec<_>>()
        };
        match self.greatest(sliders.flat_map(|slider| numbers(slider)).collect::<Vec<_>>()) {
            Degree::Constant => Degree::Constant,
            _ => Degree::Other,
        }
    }

    fn load(&mut self, load: &LoadKind) -> Degree {
        match load {
            LoadKind::Force { force: ForceValue::Components(components), along_z, .. } => {
                self.greatest(components.iter().copied().chain(*along_z).collect::<Vec<_>>())
            }
            LoadKind::Force { force: ForceValue::Along(magnitude, _), .. } => self.degree(*magnitude),
            LoadKind::Torque { moment, tilt, .. } => {
                self.greatest(tilt.iter().flatten().copied().chain([*moment]).collect::<Vec<_>>())
            }
            LoadKind::Damper { damping, .. } | LoadKind::TorsionalDamper { damping, .. } => {
                self.degree(*damping)
            }
            LoadKind::Spring { stiffness, free_length: free, .. }
            | LoadKind::TorsionalSpring { stiffness, free_angle: free, .. } => {
                let stiffness = self.degree(*stiffness);
                stiffness.times(self.greatest(*free))
            }
        }
    }

    /// Gravity, and inertia if no acceleration is unknown.
    fn weights(&mut self) -> Degree {
        let gravity = match self.model.gravity {
            Gravity::None => Degree::Constant,
            Gravity::Down(magnitude) => self.degree(magnitude),
            Gravity::Components(components, z) => {
                self.greatest(components.into_iter().chain(z).collect::<Vec<_>>())
            }
        };
        if self.model.drives.len() < self.model.coordinates.len() {
            return gravity;
        }
        let bodies = self.model.bodies.iter().map(|body| match &body.inertia {
            Inertia::Massless => gravity,
            Inertia::Massive { mass, moment, .. } => {
                let mass = self.degree(*mass);
                let moment = match moment {
                    Moment::Given(moment) => self.degree(*moment),
                    Moment::Bar(_) | Moment::Rectangle(_) | Moment::Box(_) | Moment::Disc(_) => mass,
                };
                gravity.times(mass).max(moment)
            }
        });
        bodies.fold(gravity, Degree::max)
    }

    fn accelerations(&mut self) -> Degree {
        self.greatest(self.model.drives.iter().filter_map(|drive| drive.acceleration).collect::<Vec<_>>())
    }

    fn conditions(&mut self) -> Degree {
        let stiffness: Vec<FormulaId> =
            self.model.contacts().filter_map(|contact| contact.stiffness).collect();
        let pads = self.model.contacts().filter_map(|contact| contact.pad);
        let pads: Vec<FormulaId> = pads.flat_map(|pad| pad.length.into_iter().chain([pad.width])).collect();
        let travel = self.model.joints.iter().flat_map(|joint| match &joint.kind {
            JointKind::Slider(slider) => {
                slider.travel.into_iter().flatten().chain(slider.restitutions()).collect()
            }
            JointKind::Hinge(_) => Vec::new(),
        });
        let travel: Vec<FormulaId> = travel.collect();
        let events = self.model.events.iter().map(|event| event.zero_of);
        self.greatest(stiffness.into_iter().chain(pads).chain(travel).chain(events).collect::<Vec<_>>())
    }

    /// Whatever stands elsewhere; parameters count where they are used, and looks and contacts that are apart do not count at
    /// all.
    fn others(&mut self) -> Degree {
        let apart = self.model.sliders().flat_map(|slider| &slider.apart);
        self.seen.extend(apart.flat_map(|contact| contact.friction().chain(contact.stiffness)));
        self.seen.extend(self.model.parameters.iter().map(|parameter| parameter.value));
        self.seen.extend(&self.model.looks);
        let all = (0..self.model.formulas.len()).map(FormulaId);
        let others: Vec<FormulaId> = all.filter(|id| !self.seen.contains(id)).collect();
        self.greatest(others)
    }
}
