//! From the formulas of a model to the numbers of a mechanism.

use super::{
    Attachment, Body, BodyInSpace, Contact, Coordinate, CoordinateKind, Drive, Effort, EventDefinition,
    Excess, FrictionCircle, Joint, JointKind, Load, LoadKind, Mechanism, Pad, Quantity, Shape, Slider, Space,
    length, length_in_space, rot90,
};
use crate::ids::{BodyId, ContactId, FormulaId, Frame, JointId};
use crate::interval::Real;
use crate::model::{
    self, Along, Effort as ModelEffort, Face, ForceFrame, Gravity, Inertia, LoadKind as ModelLoadKind, Model,
    Moment, PreloadLine, Round, RoundEnd, SliderKind, Stop, Touches,
};
use nalgebra::Vector2;
use std::sync::Arc;

/// A model beside the values of its formulas.
pub(super) struct Evaluation<'m, T> {
    pub(super) model: &'m Model,
    pub(super) values: Vec<T>,
}

impl<T: Real> Evaluation<'_, T> {
    /// The mechanism; its size is left to be found.
    pub(super) fn mechanism(&self) -> Mechanism<T> {
        let model = self.model;
        let mut contacts = Vec::new();
        let numbered = model.joints.iter().enumerate();
        let joints: Vec<Joint<T>> =
            numbered.map(|(index, joint)| self.joint(JointId(index), joint, &mut contacts)).collect();
        let bodies = (0..model.bodies.len()).map(|index| self.body(BodyId(index), &joints)).collect();
        let coordinates = model.coordinates.iter().map(|coordinate| self.coordinate(coordinate)).collect();
        let friction_circles = self.friction_circles(&joints);
        let mut loads: Vec<Load<T>> = model.loads.iter().map(|load| self.load(load)).collect();
        loads.extend(self.pads(&joints));
        let mut mechanism = Mechanism {
            title: model.title.clone(),
            gravity: self.gravity(),
            space: self.space(),
            time: model.time.map_or(T::zero(), |time| self.value(time)),
            bodies,
            joints,
            contacts,
            friction_circles,
            loads,
            drives: model.drives.iter().map(|drive| self.drive(drive)).collect(),
            coordinates,
            events: model.events.iter().map(|event| self.event(event)).collect(),
            units: model.units.clone(),
            size: 1.0,
            excess: Excess::default(),
            friction: T::exactly(1.0),
            parameters: model.parameter_values(&self.values),
            formulas: Arc::clone(&model.formulas),
        };
        if model.friction != 1.0 {
            mechanism.multiply_friction(T::exactly(model.friction));
        }
        mechanism
    }

    fn value(&self, id: FormulaId) -> T {
        self.values[id.index()]
    }

    fn quantity(&self, id: FormulaId) -> Quantity<T> {
        if self.model.formula(id).moves() {
            Quantity::Varying(id)
        } else {
            Quantity::Constant(self.value(id))
        }
    }

    fn quantity_or_zero(&self, id: Option<FormulaId>) -> Quantity<T> {
        id.map_or(Quantity::Constant(T::zero()), |id| self.quantity(id))
    }

    /// What the model says of the space out of the drawing; nothing if it is a planar model.
    fn space(&self) -> Option<Space<T>> {
        if !self.model.is_spatial() {
            return None;
        }
        let gravity = match self.model.gravity {
            Gravity::Components(_, z) => self.or_zero(z),
            Gravity::None | Gravity::Down(_) => T::zero(),
        };
        let bodies = self.model.bodies.iter().map(|body| self.body_in_space(&body.inertia)).collect();
        Some(Space { gravity, bodies })
    }

    fn body_in_space(&self, inertia: &Inertia) -> BodyInSpace<T> {
        let none = [T::zero(); 2];
        let Inertia::Massive { mass, z, products, moment, .. } = inertia else {
            return BodyInSpace { z: T::zero(), products: none, tilt: Some([T::zero(); 2]) };
        };
        let mass = self.value(*mass);
        let tilt = match moment {
            Moment::Box(sides) => {
                let [width, height, depth] = sides.map(|side| self.value(side).square());
                Some([height + depth, width + depth].map(|sum| mass * sum / T::exactly(12.0)))
            }
            Moment::Given(_) | Moment::Bar(_) | Moment::Rectangle(_) | Moment::Disc(_) => None,
        };
        let products = products.map_or(none, |products| products.map(|product| self.value(product)));
        BodyInSpace { z: self.or_zero(*z), products, tilt }
    }

    fn vector(&self, components: [FormulaId; 2]) -> Vector2<T> {
        Vector2::new(self.value(components[0]), self.value(components[1]))
    }

    fn gravity(&self) -> Vector2<T> {
        match self.model.gravity {
            Gravity::None => Vector2::zeros(),
            Gravity::Down(magnitude) => Vector2::new(T::zero(), -self.value(magnitude)),
            Gravity::Components(components, _) => self.vector(components),
        }
    }

    fn attachment(&self, attachment: &model::Attachment) -> Attachment<T> {
        let z = self.or_zero(attachment.z);
        Attachment { frame: attachment.frame, position: self.vector(attachment.position), z }
    }

    fn or_zero(&self, formula: Option<FormulaId>) -> T {
        formula.map_or(T::zero(), |formula| self.value(formula))
    }

    /// Unit vector of a direction; the model has made sure that two points differ.
    fn direction(&self, along: &Along) -> Vector2<T> {
        match along {
            Along::Angle(angle) => self.value(*angle).direction().into(),
            Along::Points(points) => {
                let [from, to] = points.as_ref();
                let between = self.vector(to.position) - self.vector(from.position);
                between / length(between)
            }
            Along::Across([from, to]) => {
                let normal = self.vector(*to) - self.vector(*from);
                -rot90(normal / length(normal))
            }
        }
    }

    fn body(&self, id: BodyId, joints: &[Joint<T>]) -> Body<T> {
        let body = &self.model.bodies[id.index()];
        let (mass, moment_of_inertia, centre_of_mass) = match &body.inertia {
            Inertia::Massless => (T::zero(), T::zero(), mean_joint_place(Frame::Body(id), joints)),
            Inertia::Massive { mass, centre_of_mass, moment, .. } => {
                let mass = self.value(*mass);
                let (moment, middle) = self.moment_of_inertia(moment, mass);
                let centre = centre_of_mass.map_or(middle, |centre| self.vector(centre));
                (mass, moment, centre)
            }
        };
        let points =
            body.points.iter().map(|point| (point.name.clone(), self.vector(point.position))).collect();
        Body {
            name: body.name.clone(),
            place: body.place.clone(),
            mass,
            moment_of_inertia,
            centre_of_mass,
            points,
            shape: self.shape(&body.inertia),
            outline: body.outline.iter().map(|corner| corner.map(|place| self.vector(*place))).collect(),
        }
    }

    fn shape(&self, inertia: &Inertia) -> Option<Shape<T>> {
        let Inertia::Massive { moment, .. } = inertia else { return None };
        match moment {
            Moment::Given(_) => None,
            Moment::Bar(ends) => Some(Shape::Bar(ends.map(|end| self.vector(end)))),
            Moment::Rectangle(sides) => Some(Shape::Rectangle(sides.map(|side| self.value(side)))),
            Moment::Box([width, height, _]) => {
                Some(Shape::Rectangle([width, height].map(|side| self.value(*side))))
            }
            Moment::Disc(radius) => Some(Shape::Disc(self.value(*radius))),
        }
    }

    /// Moment of inertia about the centre of mass, and the middle of a bar.
    fn moment_of_inertia(&self, moment: &Moment, mass: T) -> (T, Vector2<T>) {
        match moment {
            Moment::Given(moment) => (self.value(*moment), Vector2::zeros()),
            Moment::Bar([from, to]) => {
                let (from, to) = (self.vector(*from), self.vector(*to));
                (mass * square(to - from) / T::exactly(12.0), (from + to) / T::exactly(2.0))
            }
            Moment::Rectangle(sides) => {
                (mass * square(self.vector(*sides)) / T::exactly(12.0), Vector2::zeros())
            }
            Moment::Box([width, height, _]) => {
                (mass * square(self.vector([*width, *height])) / T::exactly(12.0), Vector2::zeros())
            }
            Moment::Disc(radius) => (mass * self.value(*radius).square() / T::exactly(2.0), Vector2::zeros()),
        }
    }

    fn joint(&self, id: JointId, joint: &model::Joint, contacts: &mut Vec<Contact<T>>) -> Joint<T> {
        let kind = match &joint.kind {
            model::JointKind::Hinge(hinge) => {
                let raised = hinge.raised.map_or(T::zero(), |(times, id)| T::exactly(times) * self.value(id));
                JointKind::Hinge(hinge.between.each_ref().map(|end| {
                    let end = self.attachment(end);
                    Attachment { z: end.z + raised, ..end }
                }))
            }
            model::JointKind::Slider(slider) => JointKind::Slider(self.slider(slider, id, contacts)),
        };
        let carries = joint.carries.unwrap_or([matches!(kind, JointKind::Hinge(_)); 3]);
        Joint { name: joint.name.clone(), place: joint.place.clone(), carries, kind }
    }

    fn friction_circles(&self, joints: &[Joint<T>]) -> Vec<FrictionCircle<T>> {
        let mut circles = Vec::new();
        for (index, (written, joint)) in self.model.joints.iter().zip(joints).enumerate() {
            let friction = written.friction_of_blocks();
            let circle = |friction| FrictionCircle::new(JointId(index), friction, |id| self.value(id));
            match (&written.kind, &joint.kind) {
                (model::JointKind::Slider(written), JointKind::Slider(slider)) => {
                    let on = |end: &RoundEnd| end.contacts.map(|at| slider.contacts[at]);
                    let ends = friction.iter().zip(&written.ends);
                    circles.extend(
                        ends.map(|(friction, end)| FrictionCircle { end: Some(on(end)), ..circle(friction) }),
                    );
                }
                _ => circles.extend(friction.iter().map(circle)),
            }
        }
        circles
    }

    fn slider(&self, slider: &model::Slider, joint: JointId, contacts: &mut Vec<Contact<T>>) -> Slider<T> {
        let length = slider.length.map_or(T::zero(), |length| self.value(length));
        // The friction of a disc acts at its rim.
        let radius = slider.radius.map(|radius| self.value(radius) * T::exactly(2.0));
        let height = slider.height.map(|height| self.value(height)).or(radius).unwrap_or(T::zero());
        let corner = corner(slider.touches, length);
        let offsets: &[f64] =
            if slider.kind == SliderKind::Block && corner.is_zero() { &[0.5, -0.5] } else { &[0.0] };
        let first = contacts.len();
        for (index, contact) in slider.contacts.iter().enumerate() {
            let place = contact.face.filter(|face| !face.is_positive).map_or(index, |face| face.other);
            let place =
                slider.ends.iter().find(|end| end.contacts[1] == index).map_or(place, |end| end.contacts[0]);
            let offset = T::exactly(offsets.get(place).copied().unwrap_or(0.0)) * length;
            let mut contact = self.contact((contact, joint), first, [offset, length]);
            contact.height = contact.height.map(|height| if slider.around { -height } else { height });
            contacts.push(contact);
        }
        let tangent = self.direction(&slider.along);
        let at = self.vector(slider.at) + tangent * corner;
        let face = self.face(slider, (at, tangent), if corner.is_zero() { length } else { T::zero() });
        Slider {
            kind: if corner.is_zero() { slider.kind } else { SliderKind::Pin },
            block: slider.block,
            guide: slider.guide,
            at,
            z: self.or_zero(slider.z),
            tangent,
            length,
            height: if slider.around { -height } else { height },
            round: slider.round.map(|round| Round {
                centre: round.centre.map(|part| self.value(part)),
                radius: self.value(round.radius),
                inside: round.inside,
            }),
            apart: self.apart(slider, joint, length),
            sticks: slider.sticks,
            around: slider.around,
            loose: slider.loose,
            travel: face.or(slider.travel.map(|travel| travel.map(|limit| self.value(limit)))),
            stops: slider.stops.map(|stop| stop.map(|stop| stop.map(|id| self.value(id)))),
            contacts: (first..contacts.len()).map(ContactId).collect(),
        }
    }

    /// The displacements between which the whole length of a block is on a face with ends.
    fn face(
        &self,
        slider: &model::Slider,
        (at, tangent): (Vector2<T>, Vector2<T>),
        length: T,
    ) -> Option<[T; 2]> {
        let Along::Points(ends) = &slider.along else { return None };
        let [from, to] = ends.each_ref().map(|end| (self.vector(end.position) - at).dot(&tangent));
        let half = length / T::exactly(2.0);
        slider.has_ends.then_some([from + half, to - half])
    }

    /// A contact, with its distance from the place of the block and the length of the joint; the first of the joint has a
    /// number.
    fn contact(
        &self,
        (contact, joint): (&model::Contact, JointId),
        first: usize,
        [offset, length]: [T; 2],
    ) -> Contact<T> {
        let face = contact
            .face
            .map(|Face { is_positive, other }| Face { is_positive, other: ContactId(first + other) });
        // Each face of a press fit has half of it.
        let part = T::exactly(if face.is_some() { 0.5 } else { 1.0 });
        Contact {
            name: contact.name.clone(),
            joint,
            offset: match contact.corner {
                None => contact.offset.map_or(offset, |offset| self.value(offset)),
                Some([along, _]) => {
                    T::exactly(along) * contact.offset.map_or(length, |length| self.value(length))
                }
            },
            aside: match (contact.aside.map(|aside| self.or_zero(aside)), contact.corner) {
                (aside, None) => aside,
                ([width, z], Some([_, across])) => [T::exactly(across) * width, z],
            },
            lean: contact
                .normal
                .map(|normal| self.value(normal).direction())
                .or((contact.corner.is_some() || contact.along_z).then(|| [T::zero(), T::one()])),
            height: contact
                .height
                .map(|height| self.value(height))
                .or((contact.normal.is_some() || contact.corner.is_some() || contact.along_z).then(T::zero)),
            carried_by: contact.carried_by,
            mu: contact.mu.map(|mu| self.value(mu)),
            law: contact.mu.map(|mu| self.model.formula(mu).depends_on_speed().then_some(mu)),
            mu_static: contact.mu_static.map(|mu| self.value(mu)),
            preload: contact
                .preload
                .map(|preload| preload.map_or(T::zero(), |preload| part * self.value(preload))),
            preload_line: if face.is_some() { PreloadLine::Centre } else { contact.preload_line },
            stiffness: contact.stiffness.map(|stiffness| self.value(stiffness)),
            play: contact.play.map_or(T::zero(), |play| self.value(play)),
            misalignment: contact
                .misalignment
                .filter(|formula| !self.model.formula(*formula).moves())
                .map_or(T::zero(), |misalignment| self.value(misalignment)),
            misalignment_law: contact.misalignment.filter(|formula| self.model.formula(*formula).moves()),
            pad: contact
                .pad
                .map(|pad| [pad.length.map_or(length, |length| self.value(length)), self.value(pad.width)]),
            face,
            opens: contact.opens,
            restitution: contact.restitution.map_or(T::zero(), |restitution| self.value(restitution)),
            gap: T::zero(),
        }
    }

    /// The contacts at the corners of a block, or at a disc, that are apart from their face.
    fn apart(&self, slider: &model::Slider, joint: JointId, length: T) -> Vec<Contact<T>> {
        let gap = self.gap(slider).unwrap_or(T::zero());
        let half = length / T::exactly(2.0);
        let offsets = match slider.touches {
            Touches::All => [T::zero(); 2],
            Touches::Front => [-length; 2],
            Touches::Rear => [length; 2],
            Touches::Nothing => [half, -half],
        };
        let contacts = slider.apart.iter().zip(offsets);
        contacts
            .map(|(contact, offset)| Contact { gap, ..self.contact((contact, joint), 0, [offset, length]) })
            .collect()
    }

    /// How far a block is from the face that the drawing shows (m); none where the face follows from the block.
    fn gap(&self, slider: &model::Slider) -> Option<T> {
        let radius = slider.radius.map_or(T::zero(), |radius| self.value(radius));
        if let Some(round) = slider.round {
            let distance = length(self.vector(slider.at) - self.vector(round.centre));
            let face = self.value(round.radius);
            return Some(if round.inside { face - radius - distance } else { distance - radius - face });
        }
        let Along::Points(ends) = &slider.along else { return None };
        let way = self.vector(slider.at) - self.vector(ends[0].position);
        slider.has_ends.then(|| rot90(self.direction(&slider.along)).dot(&way) - radius)
    }

    /// How far each closed face that the drawing shows is from its block (m).
    pub(super) fn off_faces(&self) -> impl Iterator<Item = (JointId, T)> + '_ {
        self.model.joints.iter().enumerate().filter_map(|(index, joint)| {
            let model::JointKind::Slider(slider) = &joint.kind else { return None };
            let gap = self.gap(slider).filter(|_| slider.touches != Touches::Nothing)?;
            Some((JointId(index), gap))
        })
    }

    fn load(&self, load: &model::Load) -> Load<T> {
        let kind = match &load.kind {
            ModelLoadKind::Force { at, force, along_z, frame, reaction } => {
                let (components, axes) = match force {
                    model::ForceValue::Components(components) => {
                        (components.map(|id| self.quantity(id)), [Vector2::x(), Vector2::y()])
                    }
                    model::ForceValue::Along(magnitude, along) => {
                        let axis = self.direction(along);
                        ([self.quantity(*magnitude), Quantity::Constant(T::zero())], [axis, rot90(axis)])
                    }
                };
                let turns = *frame == ForceFrame::Body;
                let along_z = self.quantity_or_zero(*along_z);
                LoadKind::Force {
                    at: self.attachment(at),
                    components,
                    axes,
                    along_z,
                    turns,
                    reaction: *reaction,
                }
            }
            ModelLoadKind::Torque { body, moment, tilt, reaction } => LoadKind::Torque {
                body: *body,
                moment: self.quantity(*moment),
                tilt: [0, 1].map(|axis| self.quantity_or_zero(tilt.map(|tilt| tilt[axis]))),
                reaction: *reaction,
            },
            ModelLoadKind::Spring { between, stiffness, free_length } => {
                let between = between.each_ref().map(|end| self.attachment(end));
                let [first, second] = &between;
                let drawn = length_in_space(first.position - second.position, first.z - second.z);
                LoadKind::Spring {
                    between,
                    stiffness: self.quantity(*stiffness),
                    free_length: free_length
                        .map_or(Quantity::Constant(drawn), |length| self.quantity(length)),
                }
            }
            ModelLoadKind::Damper { between, damping } => LoadKind::Damper {
                between: between.each_ref().map(|end| self.attachment(end)),
                damping: self.quantity(*damping),
            },
            ModelLoadKind::TorsionalSpring { between, stiffness, free_angle } => LoadKind::TorsionalSpring {
                between: *between,
                stiffness: self.quantity(*stiffness),
                free_angle: free_angle.map_or(Quantity::Constant(T::zero()), |angle| self.quantity(angle)),
            },
            ModelLoadKind::TorsionalDamper { between, damping } => {
                LoadKind::TorsionalDamper { between: *between, damping: self.quantity(*damping) }
            }
        };
        Load { name: load.name.clone(), place: load.place.clone(), kind }
    }

    /// The pads at the ends of travels, as loads behind those of the model.
    fn pads(&self, joints: &[Joint<T>]) -> Vec<Load<T>> {
        let mut pads = Vec::new();
        for (index, joint) in joints.iter().enumerate() {
            let JointKind::Slider(Slider { travel: Some(travel), stops, .. }) = &joint.kind else { continue };
            for (end, name) in ["least", "greatest"].into_iter().enumerate() {
                let Some(constants) = stops[end].and_then(Stop::pad) else { continue };
                let formula = FormulaId(self.model.formulas.len() + pads.len());
                let (joint_id, greatest) = (JointId(index), end == 1);
                let pad = Pad { joint: joint_id, greatest, place: travel[end], constants, formula };
                let name = format!("{}.{name}_pad", joint.name).into();
                pads.push(Load { name, place: joint.place.clone(), kind: LoadKind::Pad(pad) });
            }
        }
        pads
    }

    fn drive(&self, drive: &model::Drive) -> Drive<T> {
        let effort = match &drive.effort {
            ModelEffort::Force { at, direction, frame, reaction } => Effort::Force {
                at: self.attachment(at),
                direction: self.direction(direction),
                turns: *frame == ForceFrame::Body,
                reaction: *reaction,
            },
            ModelEffort::Torque { body, reaction } => Effort::Torque { body: *body, reaction: *reaction },
        };
        Drive {
            name: drive.name.clone(),
            place: drive.place.clone(),
            coordinate: drive.coordinate,
            acceleration: drive.acceleration.map_or(Quantity::Constant(T::zero()), |id| self.quantity(id)),
            effort,
        }
    }

    fn event(&self, event: &model::EventDefinition) -> EventDefinition<T> {
        EventDefinition {
            name: event.name.clone(),
            place: event.place.clone(),
            zero_of: self.quantity(event.zero_of),
            direction: event.direction,
            stops: event.stops,
        }
    }

    fn coordinate(&self, coordinate: &model::Coordinate) -> Coordinate<T> {
        let kind = match &coordinate.kind {
            model::CoordinateKind::Slide(joint) => CoordinateKind::Slide(*joint),
            model::CoordinateKind::Rotation { body, relative_to } => {
                CoordinateKind::Rotation(*body, *relative_to)
            }
            model::CoordinateKind::X(point) => {
                CoordinateKind::Displacement(self.attachment(point), Vector2::x())
            }
            model::CoordinateKind::Y(point) => {
                CoordinateKind::Displacement(self.attachment(point), Vector2::y())
            }
        };
        let drawn_at = coordinate.drawn_at.map_or(T::zero(), |id| self.value(id));
        Coordinate {
            name: coordinate.name.clone(),
            place: coordinate.place.clone(),
            kind,
            drawn_at,
            value: coordinate.value.map_or(drawn_at, |id| self.value(id)),
            rate: coordinate.rate.map_or(T::zero(), |id| self.value(id)),
        }
    }
}

fn square<T: Real>(vector: Vector2<T>) -> T {
    vector.x.square() + vector.y.square()
}

fn mean_joint_place<T: Real>(frame: Frame, joints: &[Joint<T>]) -> Vector2<T> {
    let mut sum = Vector2::zeros();
    let mut count = 0.0;
    for joint in joints {
        let place = match &joint.kind {
            JointKind::Hinge(ends) => ends.iter().find(|end| end.frame == frame).map(|end| end.position),
            JointKind::Slider(slider) => {
                (slider.block == frame || slider.guide == frame).then_some(slider.at)
            }
        };
        if let Some(place) = place {
            sum += place;
            count += 1.0;
        }
    }
    if count > 0.0 { sum / T::exactly(count) } else { sum }
}

/// The greatest extent of the drawing.
pub(super) fn size(mechanism: &Mechanism) -> f64 {
    let mut places: Vec<Vector2<f64>> = Vec::new();
    for body in &mechanism.bodies {
        places.push(body.centre_of_mass);
        places.extend(body.points.iter().map(|(_, position)| position));
    }
    for joint in &mechanism.joints {
        match &joint.kind {
            JointKind::Hinge(ends) => places.extend(ends.iter().map(|end| end.position)),
            JointKind::Slider(slider) => {
                let half = slider.tangent * (slider.length / 2.0);
                places.extend([slider.at - half, slider.at + half]);
                places.extend(slider.round.map(|round| Vector2::from(round.centre)));
            }
        }
    }
    let extent = |component: usize| {
        let values = places.iter().map(|place| place[component]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    let size = extent(0).hypot(extent(1));
    if size > 0.0 { size } else { 1.0 }
}

/// Where the corner of a block that touches alone is from its middle.
fn corner<T: Real>(touches: Touches, length: T) -> T {
    let half = length / T::exactly(2.0);
    match touches {
        Touches::All | Touches::Nothing => T::zero(),
        Touches::Front => half,
        Touches::Rear => -half,
    }
}
