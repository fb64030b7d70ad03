//! Checks of a model that need no motion: circles of parameters, dimensions, ranges of values, relations
//! between values, and how its parts are connected.

use super::{
    Along, BODY_LIMIT, Contact, Formula, Joint, JointKind, LoadKind, Model, Slider, SliderKind, Touches,
};
use crate::expression::{Dimension, Inferred, Names, Symbol};
use crate::fault::{Fault, FaultKind, Faults, Place, Source};
use crate::ids::{FormulaId, Frame};
use crate::interval::{Interval, Real};
use crate::units::precise;
use std::sync::Arc;

impl Model {
    /// All faults of the model as a whole; also settles the order in which the parameters are evaluated.
    ///
    /// Connections are judged only in a `complete` model: where a joint could not be read, a body is no
    /// further fault for lacking it.
    pub(super) fn check(&mut self, complete: bool) -> Faults {
        let mut faults = Faults::default();
        if self.bodies.len() > BODY_LIMIT {
            let kind = FaultKind::TooManyBodies { bodies: self.bodies.len(), limit: BODY_LIMIT };
            faults.push(Fault::new(kind, self.bodies[BODY_LIMIT].place.clone()));
        }
        self.order_parameters(&mut faults);
        self.check_dimensions(&mut faults);
        let values = self.allowed_values(&[], &mut faults);
        self.split_press_fits(&values);
        self.check_relations(&values, &mut faults);
        if complete {
            self.check_connections(&values, &mut faults);
        }
        faults
    }

    /// The names that an expression of this model may use.
    pub(super) fn names(&self) -> Names {
        let mut names = Names::new();
        for parameter in &self.parameters {
            names.parameter(&parameter.name);
        }
        for coordinate in &self.coordinates {
            names.coordinate(&coordinate.name);
        }
        names
    }

    /// Dimension of a parameter's present value, if it is known.
    pub(super) fn parameter_dimension(&self, index: usize) -> Option<Dimension> {
        match self.inferred_parameters()[index] {
            Inferred::Known(dimension) => Some(dimension),
            _ => None,
        }
    }

    /// The values of all formulas that do not depend on the motion; 0 for the others.
    ///
    /// # Errors
    /// A fault for each value that is not finite or not allowed.
    pub fn constants(&self) -> Result<Vec<f64>, Faults> {
        self.constants_with(&[])
    }

    /// [`Self::constants`] with other values of some parameters.
    ///
    /// # Errors
    /// As [`Self::constants`].
    pub(crate) fn constants_with(&self, given: &[(usize, f64)]) -> Result<Vec<f64>, Faults> {
        let mut faults = Faults::default();
        let values = self.allowed_values(given, &mut faults);
        self.check_relations(&values, &mut faults);
        faults.or(values.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// The parameters that are computed from some of these, in an order in which each uses only those before
    /// it.
    pub(crate) fn following(&self, parameters: &[usize]) -> Vec<usize> {
        let follows = |index: &usize| {
            let own = parameters.contains(index);
            !own && parameters.iter().any(|&wanted| self.uses(self.parameters[*index].value, wanted))
        };
        self.evaluation_order.iter().copied().filter(follows).collect()
    }

    /// Intervals that hold the exact values of all formulas that do not depend on the motion, 0 for the
    /// others; `given` has the values of the parameters whose own formulas do not count.
    ///
    /// # Errors
    /// A fault for each formula that has no finite or allowed value for some of the numbers within bounds.
    pub(crate) fn enclosed_constants(&self, given: &[(usize, Interval)]) -> Result<Vec<Interval>, Faults> {
        let mut faults = Faults::default();
        let values = self.allowed_values(given, &mut faults);
        faults.or(values.into_iter().map(|value| value.unwrap_or(Interval::ZERO)).collect())
    }

    /// The values of the parameters among those of all formulas.
    pub fn parameter_values<T: Real>(&self, constants: &[T]) -> Vec<T> {
        self.parameters.iter().map(|parameter| constants[parameter.value.index()]).collect()
    }

    /// The SI unit of a parameter: empty for pure numbers, for angles that were typed without a unit, and where
    /// its dimension does not follow from the model.
    pub fn parameter_unit(&self, parameter: &str) -> String {
        if let Some(unit) = self.units.typed_parameter(parameter) {
            return unit.si().to_owned();
        }
        let index = self.parameters.iter().position(|other| &*other.name == parameter);
        index.and_then(|index| self.parameter_dimension(index)).map_or_else(String::new, Dimension::unit)
    }

    /// Whether some coefficient of friction is this parameter, or computed from it.
    pub fn is_friction_coefficient(&self, parameter: &str) -> bool {
        let Some(wanted) = self.parameters.iter().position(|other| &*other.name == parameter) else {
            return false;
        };
        let of_hinges = self.hinge_friction().filter_map(|friction| friction.coefficients());
        let kinetic = self.contacts().flat_map(|contact| contact.mu).chain(of_hinges.map(|[mu, _]| mu));
        kinetic.into_iter().any(|mu| self.uses(mu, wanted))
    }

    /// Whether some coefficient of friction is this parameter itself, perhaps through others that are nothing
    /// but it, so that its negative values make no sense.
    pub(crate) fn is_itself_friction(&self, parameter: &str) -> bool {
        let mut coefficients = self.friction_coefficients();
        let wanted = self.parameters.iter().find(|other| &*other.name == parameter);
        wanted.is_some_and(|wanted| coefficients.any(|id| self.same_as(id).any(|same| same == wanted.value)))
    }

    /// The least and the greatest value that a friction coefficient can have beside the others as they are: a static one is not
    /// below its kinetic one. Nothing for what is no coefficient itself, where a parameter has no value that is allowed, and
    /// where less than two values are left.
    pub fn friction_range(&self, parameter: &str) -> Option<[f64; 2]> {
        let wanted = self.parameters.iter().position(|other| &*other.name == parameter)?;
        if !self.is_itself_friction(parameter) {
            return None;
        }
        let mut faults = Faults::default();
        let values = self.allowed_values::<f64>(&[], &mut faults);
        faults.or(()).ok()?;
        let mut range = [0.0, f64::INFINITY];
        let is_it = |id| self.same_as(id).any(|same| same == self.parameters[wanted].value);
        let bound = |id: FormulaId| (!self.uses(id, wanted)).then(|| values[id.index()]).flatten();
        for [kinetic, at_rest] in self.pairs_of_coefficients() {
            if is_it(kinetic) {
                range[1] = bound(at_rest).map_or(range[1], |most| most.min(range[1]));
            } else if is_it(at_rest) {
                range[0] = bound(kinetic).map_or(range[0], |least| least.max(range[0]));
            }
        }
        Some(range).filter(|[least, greatest]| least < greatest)
    }

    /// The kinetic and static friction coefficients of all contacts and hinges.
    pub(crate) fn friction_coefficients(&self) -> impl Iterator<Item = FormulaId> {
        self.pairs_of_coefficients().flatten()
    }

    /// The kinetic friction coefficient of each side of each contact and of each hinge, with its static one.
    fn pairs_of_coefficients(&self) -> impl Iterator<Item = [FormulaId; 2]> {
        let of_hinges = self.hinge_friction().filter_map(|friction| friction.coefficients());
        let of_contacts = self
            .contacts()
            .flat_map(|contact| [0, 1].map(|side| [contact.mu[side], contact.mu_static[side]]));
        of_contacts.chain(of_hinges)
    }

    /// The formulas that this one is nothing but, through parameters: first itself, last that with the number.
    fn same_as(&self, formula: FormulaId) -> impl Iterator<Item = FormulaId> + '_ {
        std::iter::successors(Some(formula), |&id| match self.formula(id).expression.only_symbol()? {
            Symbol::Parameter(index) => Some(self.parameters[index].value),
            _ => None,
        })
    }

    /// The formula with the number or the expression that this one takes its value from unchanged.
    pub(crate) fn source_of(&self, formula: FormulaId) -> FormulaId {
        self.same_as(formula).last().unwrap_or(formula)
    }

    /// Whether a parameter changes nothing but coefficients of friction and preloads.
    pub(crate) fn changes_friction_or_pins_alone(&self, parameter: usize) -> bool {
        let of_hinges = self.hinge_friction().flat_map(super::hinge::HingeFriction::formulas);
        let of_contacts = self.contacts_and_apart().flat_map(Contact::friction);
        self.changes_nothing_but(&of_contacts.chain(of_hinges).collect::<Vec<_>>(), parameter)
    }

    /// Whether nothing but the friction of contacts and hinges depends on a parameter, counted from 0.
    pub(crate) fn changes_friction_and_pins_alone(&self, parameter: usize) -> bool {
        let of_hinges = self.hinge_friction().flat_map(|friction| friction.kinetic_and_static());
        let of_contacts = self.contacts_and_apart().flat_map(Contact::friction);
        self.changes_nothing_but(&of_contacts.chain(of_hinges).collect::<Vec<_>>(), parameter)
    }

    fn changes_nothing_but(&self, formulas: &[FormulaId], parameter: usize) -> bool {
        let own = self.parameters.iter().map(|parameter| parameter.value);
        let left_out: Vec<FormulaId> = own.chain(formulas.iter().copied()).collect();
        let mut others = (0..self.formulas.len()).map(FormulaId).filter(|id| !left_out.contains(id));
        !others.any(|id| self.uses(id, parameter))
    }

    /// Refuses a model without drives, of which nothing that needs an effort can be asked.
    ///
    /// # Errors
    /// No drive.
    pub(crate) fn has_drives(&self) -> Result<(), Faults> {
        if self.drives.is_empty() {
            let coordinate = self.coordinates.first().map(|coordinate| coordinate.name.to_string());
            return Err(Fault::general(FaultKind::NoDrives { coordinate }).into());
        }
        Ok(())
    }

    /// Whether no drive moves a coordinate, counted from 0.
    pub(crate) fn is_free(&self, coordinate: usize) -> bool {
        self.drives.iter().all(|drive| drive.coordinate.index() != coordinate)
    }

    /// Whether the joints have more equations than the coordinates leave room for: redundant guides.
    pub(crate) fn is_redundant(&self) -> bool {
        let equations = |joint: &Joint| match &joint.kind {
            JointKind::Slider(slider) if slider.touches != Touches::All => slider.contacts.len(),
            JointKind::Slider(slider) if slider.kind == SliderKind::Pin => 1,
            // Further supports of a block count, too.
            JointKind::Slider(slider) => slider.contacts.len().max(2),
            JointKind::Hinge(_) => 2,
        };
        let sticks = |joint: &&Joint| matches!(&joint.kind, JointKind::Slider(slider) if slider.sticks);
        let rows: usize = self.joints.iter().map(equations).sum();
        rows + self.joints.iter().filter(sticks).count() + self.coordinates.len() > 3 * self.bodies.len()
    }

    /// Whether it says something of the space out of the drawing.
    pub(crate) fn is_spatial(&self) -> bool {
        let body = |body: &super::Body| {
            let of_inertia = match &body.inertia {
                super::Inertia::Massless => false,
                super::Inertia::Massive { z, products, moment, .. } => {
                    z.is_some() || products.is_some() || matches!(moment, super::Moment::Box(_))
                }
            };
            of_inertia || body.points.iter().any(|point| point.z.is_some())
        };
        let joint = |joint: &Joint| {
            let of_kind = match &joint.kind {
                JointKind::Hinge(hinge) => {
                    hinge.collar.is_some()
                        || hinge.raised.is_some()
                        || hinge.between.iter().any(|end| end.z.is_some())
                }
                JointKind::Slider(slider) => slider.z.is_some(),
            };
            of_kind || joint.carries.is_some()
        };
        let contact = |contact: &Contact| {
            contact.one_sided
                || contact.along_z
                || contact.aside != [None; 2]
                || contact.normal.or(contact.height).is_some()
        };
        let load = |load: &super::Load| match &load.kind {
            LoadKind::Force { at, along_z, .. } => at.z.or(*along_z).is_some(),
            LoadKind::Torque { tilt, .. } => tilt.is_some(),
            LoadKind::Spring { between, .. } | LoadKind::Damper { between, .. } => {
                between.iter().any(|end| end.z.is_some())
            }
            LoadKind::TorsionalSpring { .. } | LoadKind::TorsionalDamper { .. } => false,
        };
        let drive =
            |drive: &super::Drive| matches!(&drive.effort, super::Effort::Force { at, .. } if at.z.is_some());
        matches!(self.gravity, super::Gravity::Components(_, Some(_)))
            || self.bodies.iter().any(body)
            || self.joints.iter().any(joint)
            || self.contacts_and_apart().any(contact)
            || self.loads.iter().any(load)
            || self.drives.iter().any(drive)
    }

    /// The contacts of all sliding joints, in the order of the mechanism's.
    pub(crate) fn contacts(&self) -> impl Iterator<Item = &Contact> {
        self.sliders().flat_map(|slider| &slider.contacts)
    }

    /// These, and the contacts that do not touch in the state to be solved.
    fn contacts_and_apart(&self) -> impl Iterator<Item = &Contact> {
        self.sliders().flat_map(|slider| slider.contacts.iter().chain(&slider.apart))
    }

    /// The sliding joints.
    pub(super) fn sliders(&self) -> impl Iterator<Item = &Slider> {
        self.joints.iter().filter_map(|joint| match &joint.kind {
            JointKind::Slider(slider) => Some(&**slider),
            JointKind::Hinge(_) => None,
        })
    }

    /// Whether a formula uses a parameter, by way of others if need be; there are no circles.
    pub(crate) fn uses(&self, formula: FormulaId, wanted: usize) -> bool {
        self.used_parameters(formula)
            .any(|used| used == wanted || self.uses(self.parameters[used].value, wanted))
    }

    /// The place of the setting (`--set`, `--at`) on which these formulas depend, of several the last one; nothing
    /// if they depend on the file alone.
    pub(crate) fn setting_of(&self, formulas: &[FormulaId]) -> Option<Place> {
        let parameters = self.parameters.iter().enumerate();
        let used = parameters.filter(|(index, _)| formulas.iter().any(|&id| self.uses(id, *index)));
        let ids = used.map(|(_, parameter)| parameter.value).chain(formulas.iter().copied());
        let places = ids.map(|id| self.formula(id).origin.place());
        places
            .filter(|place| place.source != Source::Model)
            .max_by(|one, other| one.source.cmp(&other.source))
    }

    fn used_parameters(&self, formula: FormulaId) -> impl Iterator<Item = usize> + '_ {
        self.formula(formula).expression.symbols().filter_map(|(symbol, _)| match symbol {
            Symbol::Parameter(index) => Some(index),
            _ => None,
        })
    }

    /// Depth-first search over the parameters; a parameter met again on its own path closes a circle.
    fn order_parameters(&mut self, faults: &mut Faults) {
        let state = vec![State::New; self.parameters.len()];
        let mut search = Search { model: self, state, order: vec![], circles: vec![] };
        for index in 0..self.parameters.len() {
            search.visit(index);
        }
        let Search { order, circles, .. } = search;
        let formulas = Arc::make_mut(&mut self.formulas);
        for circle in circles {
            let mut cycle: Vec<String> =
                circle.iter().map(|&i| self.parameters[i].name.to_string()).collect();
            cycle.push(cycle[0].clone());
            let place = formulas[self.parameters[circle[0]].value.index()].origin.place();
            faults.push(Fault::new(FaultKind::CircularParameters { cycle }, place));
            for index in circle {
                formulas[self.parameters[index].value.index()].broken = true;
            }
        }
        self.evaluation_order = order;
        self.spread_broken();
    }

    /// A formula that uses a broken parameter is broken, too: what follows from it is no further fault.
    fn spread_broken(&mut self) {
        let mut formulas = std::mem::take(&mut self.formulas);
        let list = Arc::make_mut(&mut formulas);
        let values: Vec<usize> = self.parameters.iter().map(|parameter| parameter.value.index()).collect();
        let spread = |list: &mut Vec<super::Formula>, id: usize| {
            let broken = list[id]
                .expression
                .symbols()
                .any(|(symbol, _)| matches!(symbol, Symbol::Parameter(index) if list[values[index]].broken));
            list[id].broken |= broken;
        };
        for &index in &self.evaluation_order {
            spread(list, values[index]);
        }
        for id in 0..list.len() {
            spread(list, id);
        }
        self.formulas = formulas;
    }

    pub(super) fn inferred_parameters(&self) -> Vec<Inferred> {
        let mut inferred = vec![Inferred::Any; self.parameters.len()];
        for &index in &self.evaluation_order {
            let of = |symbol| self.inferred(symbol, &inferred);
            let formula = self.formula(self.parameters[index].value);
            // A setting keeps the dimension of what it replaces: if it has another one, that is its fault
            // alone.
            if let Some(wanted) = formula.wanted {
                inferred[index] = Inferred::Known(wanted);
                continue;
            }
            inferred[index] = match formula.expression.dimension(&of) {
                Ok(Inferred::Known(dimension)) => Inferred::Known(dimension),
                _ => Inferred::Any,
            };
        }
        inferred
    }

    pub(super) fn inferred(&self, symbol: Symbol, parameters: &[Inferred]) -> Inferred {
        let coordinate = |index: usize, position| {
            self.coordinates.get(index).map_or(Inferred::Any, |coordinate| {
                Inferred::Known(super::settings::dimension_of(coordinate, position))
            })
        };
        match symbol {
            Symbol::Parameter(index) => parameters[index],
            Symbol::Coordinate(index) => coordinate(index, true),
            Symbol::Rate(index) => coordinate(index, false),
            Symbol::Time => Inferred::Known(Dimension::TIME),
            Symbol::SlidingSpeed => Inferred::Known(Dimension::VELOCITY),
        }
    }

    fn check_dimensions(&self, faults: &mut Faults) {
        let inferred = self.inferred_parameters();
        let of = |symbol| self.inferred(symbol, &inferred);
        for (index, formula) in self.formulas.iter().enumerate().filter(|(_, formula)| !formula.broken) {
            let found = formula.check(&of, &|symbol| self.symbol_name(symbol));
            faults.extend(found.into_iter().map(|fault| self.blame_setting(FormulaId(index), fault)));
        }
    }

    /// Every way in which a formula that is not in the model is not what is wanted.
    pub(super) fn check_formula(&self, formula: &Formula) -> Vec<Fault> {
        let inferred = self.inferred_parameters();
        formula.check(&|symbol| self.inferred(symbol, &inferred), &|symbol| self.symbol_name(symbol))
    }

    fn symbol_name(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Parameter(index) => self.parameters[index].name.to_string(),
            Symbol::Coordinate(index) => self.coordinates[index].name.to_string(),
            Symbol::Rate(index) => format!("rate({})", self.coordinates[index].name),
            Symbol::Time => "t".to_owned(),
            Symbol::SlidingSpeed => "sliding_speed".to_owned(),
        }
    }

    /// The values of all formulas that have one without the motion; the parameters in `given` have theirs
    /// from there.
    pub(super) fn allowed_values<T: Real>(
        &self,
        given: &[(usize, T)],
        faults: &mut Faults,
    ) -> Vec<Option<T>> {
        let mut parameters = vec![T::zero(); self.parameters.len()];
        let mut values = vec![None; self.formulas.len()];
        for &(index, value) in given {
            values[self.parameters[index].value.index()] = Some(value);
        }
        let mut unknown = vec![false; self.parameters.len()];
        for &index in &self.evaluation_order {
            let id = self.parameters[index].value;
            if let Some(value) = values[id.index()] {
                parameters[index] = value;
                continue;
            }
            unknown[index] = self.formula(id).broken || self.used_parameters(id).any(|used| unknown[used]);
            if unknown[index] || self.formula(id).moves() {
                continue;
            }
            match self.formula(id).constant(&parameters) {
                Ok(value) => {
                    parameters[index] = value;
                    values[id.index()] = Some(value);
                }
                Err(fault) => {
                    unknown[index] = true;
                    faults.push(fault);
                }
            }
        }
        let is_parameter = |id: FormulaId| self.parameters.iter().any(|parameter| parameter.value == id);
        for (index, formula) in self.formulas.iter().enumerate() {
            let id = FormulaId(index);
            if values[index].is_some() {
                continue;
            }
            if formula.broken || formula.moves() || self.used_parameters(id).any(|used| unknown[used]) {
                continue;
            }
            match formula.constant(&parameters) {
                Ok(value) => values[index] = Some(value),
                Err(_) if is_parameter(id) => {}
                Err(fault) => faults.push(self.blame_setting(id, fault)),
            }
        }
        values
    }

    /// A value that is not allowed because of a parameter from a setting is a fault of the setting.
    fn blame_setting(&self, formula: FormulaId, fault: Fault) -> Fault {
        let mut used =
            self.used_parameters(formula).map(|index| &self.formula(self.parameters[index].value).origin);
        match used.find(|origin| origin.source != Source::Model) {
            Some(origin) => Fault::new(fault.kind, origin.place()),
            None => fault,
        }
    }

    /// Relations between values: static and kinetic friction, travel limits, points that give a direction.
    fn check_relations(&self, values: &[Option<f64>], faults: &mut Faults) {
        self.check_ranges(values, faults);
        let value = |id: FormulaId| values[id.index()];
        for joint in &self.joints {
            let slider = match &joint.kind {
                JointKind::Slider(slider) => slider,
                JointKind::Hinge(hinge) => {
                    let friction = hinge.friction.into_iter().chain(hinge.collar);
                    let pairs = friction.map(|friction| friction.kinetic_and_static());
                    faults.extend(
                        pairs.filter_map(|pair| self.static_below_kinetic(&joint.name, pair, &value)),
                    );
                    continue;
                }
            };
            self.check_static_friction(slider, &value, faults);
            check_direction(&slider.along, &joint.place, &value, faults);
            for restitution in slider.restitutions() {
                let formula = self.formula(restitution);
                if let Some(value) = value(restitution).filter(|value| *value > 1.0) {
                    let what = formula.what.to_string();
                    let kind = FaultKind::OutOfRange { what, wanted: "at most one", value: precise(value) };
                    faults.push(Fault::new(kind, formula.origin.place()));
                }
            }
            if let Some([Some(least), Some(greatest)]) = slider.travel.map(|travel| travel.map(value))
                && least >= greatest
            {
                let kind = FaultKind::ReversedTravel { joint: joint.name.to_string(), least, greatest };
                faults.push(Fault::new(kind, joint.place.clone()));
            }
        }
        for load in &self.loads {
            if let LoadKind::Force { force: super::ForceValue::Along(_, along), .. } = &load.kind {
                check_direction(along, &load.place, &value, faults);
            }
        }
        for drive in &self.drives {
            if let super::Effort::Force { direction, .. } = &drive.effort {
                check_direction(direction, &drive.place, &value, faults);
            }
        }
    }

    fn check_static_friction(
        &self,
        slider: &Slider,
        value: &dyn Fn(FormulaId) -> Option<f64>,
        faults: &mut Faults,
    ) {
        let mut reported: Vec<Option<Place>> = Vec::new();
        for contact in &slider.contacts {
            for side in 0..2 {
                let pair = [contact.mu[side], contact.mu_static[side]];
                let Some(fault) = self.static_below_kinetic(&contact.name, pair, value) else { continue };
                let place = fault.place.clone();
                if !reported.contains(&place) {
                    faults.push(fault);
                    reported.push(place);
                }
            }
        }
    }

    /// Returns a fault if the static value of friction is smaller than the kinetic one.
    pub(crate) fn static_below_kinetic(
        &self,
        name: &str,
        pair: [FormulaId; 2],
        value: &dyn Fn(FormulaId) -> Option<f64>,
    ) -> Option<Fault> {
        let (kinetic, at_rest) = (value(pair[0])?, value(pair[1])?);
        if at_rest >= kinetic {
            return None;
        }
        let owner = name.to_owned();
        let kind = if self.formula(pair[1]).wanted == Some(Dimension::LENGTH) {
            FaultKind::StaticRadiusBelowKinetic { hinge: owner, radius: kinetic, static_radius: at_rest }
        } else {
            FaultKind::StaticBelowKinetic { contact: owner, mu: kinetic, mu_static: at_rest }
        };
        let in_file = || self.formula(pair[1]).origin.place();
        Some(Fault::new(kind, self.setting_of(&pair).unwrap_or_else(in_file)))
    }

    /// Joints of a body with itself, doubled joints, bodies without a way to ground.
    fn check_connections(&self, values: &[Option<f64>], faults: &mut Faults) {
        let mut group: Vec<usize> = (0..=self.bodies.len()).collect();
        for (index, joint) in self.joints.iter().enumerate() {
            let [first, second] = joined(&joint.kind);
            if first == second {
                let kind =
                    FaultKind::SelfJoint { joint: joint.name.to_string(), body: self.frame_name(first) };
                faults.push(Fault::new(kind, joint.place.clone()));
                // It was meant to connect the body with something.
                let from = group[node(first)];
                let to = group[0];
                group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
                continue;
            }
            let mut before = self.joints[..index].iter();
            if let Some(other) = before.find(|other| doubles(&joint.kind, &other.kind, values)) {
                let kind =
                    FaultKind::DoubledJoint { joint: joint.name.to_string(), other: other.name.to_string() };
                faults.push(Fault::new(kind, joint.place.clone()));
            }
            let (from, to) = (group[node(first)], group[node(second)]);
            group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
        }
        let floating: Vec<usize> =
            (1..group.len()).filter(|&body| group[body] != group[0]).map(|n| n - 1).collect();
        if let Some(&first) = floating.first() {
            let bodies = floating.iter().map(|&body| self.bodies[body].name.to_string()).collect();
            faults.push(Fault::new(FaultKind::FloatingBodies { bodies }, self.bodies[first].place.clone()));
        }
    }

    /// Name of a frame, for messages.
    pub fn frame_name(&self, frame: Frame) -> String {
        frame.body().map_or("ground".to_owned(), |body| self.bodies[body.index()].name.to_string())
    }
}

/// Places (m) nearer to each other than a rounding error of this one are the same in every mechanism.
const SHORTEST: f64 = 1e-40;

/// Two points that give a direction must differ.
fn check_direction(
    along: &Along,
    place: &Place,
    value: &dyn Fn(FormulaId) -> Option<f64>,
    faults: &mut Faults,
) {
    let at = |place: [FormulaId; 2]| Some([value(place[0])?, value(place[1])?]);
    let (places, names) = match along {
        Along::Angle(_) => return,
        Along::Points(points) => {
            let [from, to] = points.as_ref();
            ([from.position, to.position], [&*from.name, &*to.name])
        }
        Along::Across(places) => (*places, ["one centre", "the other"]),
    };
    let [from, to] = places;
    let rounding = |a: [f64; 2], b: [f64; 2]| 1e-12 * a[0].hypot(a[1]).max(b[0].hypot(b[1])).max(SHORTEST);
    if let (Some(a), Some(b)) = (at(from), at(to))
        && (b[0] - a[0]).hypot(b[1] - a[1]) <= rounding(a, b)
    {
        let kind = FaultKind::CoincidentPoints { first: names[0].to_owned(), second: names[1].to_owned() };
        faults.push(Fault::new(kind, place.clone()));
    }
}

/// The two frames that a joint joins.
fn joined(joint: &JointKind) -> [Frame; 2] {
    match joint {
        JointKind::Hinge(hinge) => hinge.between.each_ref().map(|end| end.frame),
        JointKind::Slider(slider) => [slider.block, slider.guide],
    }
}

/// Whether two joints do the same: hinges of the same bodies at the same place, or sliding joints of the
/// same block on the same guide at the same place in the same direction.
fn doubles(joint: &JointKind, other: &JointKind, values: &[Option<f64>]) -> bool {
    let place = |at: [FormulaId; 2]| Some([values[at[0].index()]?, values[at[1].index()]?]);
    match (joint, other) {
        (JointKind::Hinge(a), JointKind::Hinge(b)) => {
            let mut frames = [a, b].map(|hinge| hinge.between.each_ref().map(|end| end.frame));
            for pair in &mut frames {
                pair.sort();
            }
            let at = |hinge: &super::Hinge| place(hinge.between[0].position);
            // At another height it is a bearing of the same pin.
            let height = |hinge: &super::Hinge| {
                let raised = hinge.raised.map_or(Some(0.0), |(times, id)| Some(times * values[id.index()]?));
                Some(hinge.between[0].z.map_or(Some(0.0), |z| values[z.index()])? + raised?)
            };
            frames[0] == frames[1] && at(a).is_some() && at(a) == at(b) && height(a) == height(b)
        }
        (JointKind::Slider(a), JointKind::Slider(b)) => {
            let direction = |along: &Along| match along {
                Along::Angle(angle) => values[angle.index()],
                Along::Points(points) => {
                    let [from, to] = [place(points[0].position)?, place(points[1].position)?];
                    Some((to[1] - from[1]).atan2(to[0] - from[0]))
                }
                Along::Across(ends) => {
                    let [from, to] = [place(ends[0])?, place(ends[1])?];
                    Some((to[1] - from[1]).atan2(to[0] - from[0]))
                }
            };
            a.kind == b.kind
                && (a.block, a.guide) == (b.block, b.guide)
                && place(a.at).is_some()
                && place(a.at) == place(b.at)
                && direction(&a.along).is_some()
                && direction(&a.along) == direction(&b.along)
        }
        _ => false,
    }
}

/// Ground is node 0, body k node k + 1.
fn node(frame: Frame) -> usize {
    frame.body().map_or(0, |body| body.index() + 1)
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    OnPath,
    Done,
}

/// Depth-first search with a stack of its own: a chain of parameters may be as long as the file.
struct Search<'m> {
    model: &'m Model,
    state: Vec<State>,
    order: Vec<usize>,
    circles: Vec<Vec<usize>>,
}

impl Search<'_> {
    fn visit(&mut self, start: usize) {
        let mut path: Vec<(usize, Vec<usize>)> = Vec::new();
        self.enter(start, &mut path);
        while let Some((index, pending)) = path.last_mut() {
            if let Some(used) = pending.pop() {
                self.enter(used, &mut path);
            } else {
                self.state[*index] = State::Done;
                self.order.push(*index);
                path.pop();
            }
        }
    }

    fn enter(&mut self, index: usize, path: &mut Vec<(usize, Vec<usize>)>) {
        match self.state[index] {
            State::Done => {}
            State::OnPath => {
                let start = path.iter().position(|(on_path, _)| *on_path == index).unwrap_or(0);
                self.circles.push(path[start..].iter().map(|(on_path, _)| *on_path).collect());
            }
            State::New => {
                self.state[index] = State::OnPath;
                path.push((index, self.model.used_parameters(self.model.parameters[index].value).collect()));
            }
        }
    }
}
