//! A mechanism with numbers: every formula of a model that does not depend on the motion is evaluated.
//!
//! Second stage of the pipeline: [`Model`] in, [`Mechanism`] out. Positions are those of the reference
//! drawing, in metres; loads may still hold formulas of coordinates, rates and time.

use crate::expression::Values;
use crate::fault::{Fault, FaultKind, Faults, Place};
use crate::ids::{BodyId, ContactId, CoordinateId, FormulaId, Frame, JointId};
use crate::model::{
    self, Along, CarriedBy, Effort as ModelEffort, ForceFrame, Formula, Gravity, Inertia,
    LoadKind as ModelLoadKind, Model, Moment, PreloadLine, SliderKind,
};
use nalgebra::Vector2;
use std::sync::Arc;

/// Magnitudes in SI units with which every product of the equations stays within the range of floating point.
const MAGNITUDES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// A mechanism in its reference drawing.
#[derive(Debug, Clone)]
pub struct Mechanism {
    /// One line that says what it is.
    pub title: Option<String>,
    /// Acceleration of free fall (m/s^2).
    pub gravity: Vector2<f64>,
    /// Time of the state (s).
    pub time: f64,
    /// The moving bodies.
    pub bodies: Vec<Body>,
    /// The joints.
    pub joints: Vec<Joint>,
    /// The contacts with friction, in the order of their joints.
    pub contacts: Vec<Contact>,
    /// The loads.
    pub loads: Vec<Load>,
    /// The drives.
    pub drives: Vec<Drive>,
    /// The chosen coordinates.
    pub coordinates: Vec<Coordinate>,
    /// The greatest distance between two of its places (m); 1 if they all coincide.
    pub size: f64,
    parameters: Vec<f64>,
    formulas: Arc<Vec<Formula>>,
}

/// A rigid body.
#[derive(Debug, Clone)]
pub struct Body {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// Mass (kg), zero for a massless body.
    pub mass: f64,
    /// Moment of inertia about the centre of mass (kg m^2).
    pub moment_of_inertia: f64,
    /// Centre of mass in the drawing; for a massless body the mean of the places of its joints.
    pub centre_of_mass: Vector2<f64>,
    /// Its named points in the drawing.
    pub points: Vec<(Arc<str>, Vector2<f64>)>,
}

/// A point that moves with a frame.
#[derive(Debug, Clone, Copy)]
pub struct Attachment {
    /// What it moves with.
    pub frame: Frame,
    /// Its place in the drawing.
    pub position: Vector2<f64>,
}

/// A joint.
#[derive(Debug, Clone)]
pub struct Joint {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// What it is.
    pub kind: JointKind,
}

/// The kinds of joint.
#[derive(Debug, Clone)]
pub enum JointKind {
    /// A frictionless hinge.
    Hinge([Attachment; 2]),
    /// A sliding joint.
    Slider(Slider),
}

/// A sliding joint (theory, section 1).
#[derive(Debug, Clone)]
pub struct Slider {
    /// Which of the three kinds.
    pub kind: SliderKind,
    /// The block.
    pub block: Frame,
    /// The guide.
    pub guide: Frame,
    /// Middle of the block in the drawing, on the centre line of the guide.
    pub at: Vector2<f64>,
    /// Tangent u of the guide in the drawing; the normal is n = rot90(u).
    pub tangent: Vector2<f64>,
    /// Distance of the contacts or length of the pressed face in the drawing (m).
    pub length: f64,
    /// Distance of the rubbing faces (m), negative where the block surrounds the guide.
    pub height: f64,
    /// Whether the block surrounds the guide, so that the opposite faces press.
    pub around: bool,
    /// Limits of the displacement (m).
    pub travel: Option<[f64; 2]>,
    /// Its contacts: front and rear of a block slider, else the only one.
    pub contacts: Vec<ContactId>,
}

/// A contact with friction.
#[derive(Debug, Clone)]
pub struct Contact {
    /// "joint", "joint.front" or "joint.rear".
    pub name: Arc<str>,
    /// The sliding joint it belongs to.
    pub joint: JointId,
    /// Distance from the middle of the block along the tangent in the drawing (m).
    pub offset: f64,
    /// What it travels with.
    pub carried_by: CarriedBy,
    /// Kinetic friction coefficient where the normal force is positive, and where it is negative.
    pub mu: [f64; 2],
    /// Static friction coefficient, likewise.
    pub mu_static: [f64; 2],
    /// Preload (N), likewise.
    pub preload: [f64; 2],
    /// Where the preload's friction acts.
    pub preload_line: PreloadLine,
    /// Stiffness of the guide (N/m), if the model gives it.
    pub stiffness: Option<f64>,
}

impl Contact {
    /// Whether the contact has neither friction nor preload.
    pub fn is_frictionless(&self) -> bool {
        self.mu == [0.0; 2] && self.preload == [0.0; 2]
    }
}

/// A number that may depend on the motion.
#[derive(Debug, Clone, Copy)]
pub enum Quantity {
    /// A constant.
    Constant(f64),
    /// A formula of coordinates, rates and time.
    Varying(FormulaId),
}

/// A load.
#[derive(Debug, Clone)]
pub struct Load {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// What it is.
    pub kind: LoadKind,
}

/// The kinds of load.
#[derive(Debug, Clone)]
pub enum LoadKind {
    /// A force at a point.
    Force {
        /// Where it acts.
        at: Attachment,
        /// Components: along x and y, or along the drawn direction and zero.
        components: [Quantity; 2],
        /// The directions of the components in the drawing.
        axes: [Vector2<f64>; 2],
        /// Whether the directions turn with the body.
        turns: bool,
        /// What the opposite force acts on.
        reaction: Option<Frame>,
    },
    /// A torque.
    Torque {
        /// The body.
        body: Frame,
        /// Its moment (N m).
        moment: Quantity,
        /// What the opposite torque acts on.
        reaction: Option<Frame>,
    },
    /// A spring.
    Spring {
        /// Its ends.
        between: [Attachment; 2],
        /// Stiffness (N/m).
        stiffness: Quantity,
        /// Length without force (m).
        free_length: Quantity,
    },
    /// A damper.
    Damper {
        /// Its ends.
        between: [Attachment; 2],
        /// Damping coefficient (N s/m).
        damping: Quantity,
    },
    /// A torsional spring.
    TorsionalSpring {
        /// The bodies.
        between: [Frame; 2],
        /// Torsional stiffness (N m).
        stiffness: Quantity,
        /// Rotation without torque, from the drawing (rad).
        free_angle: Quantity,
    },
    /// A torsional damper.
    TorsionalDamper {
        /// The bodies.
        between: [Frame; 2],
        /// Torsional damping coefficient (N m s).
        damping: Quantity,
    },
}

/// A prescribed motion.
#[derive(Debug, Clone)]
pub struct Drive {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// The coordinate whose motion is prescribed.
    pub coordinate: CoordinateId,
    /// The prescribed acceleration.
    pub acceleration: Quantity,
    /// The unknown effort.
    pub effort: Effort,
}

/// The unknown force or torque of a drive.
#[derive(Debug, Clone, Copy)]
pub enum Effort {
    /// A force (N) along a line of action.
    Force {
        /// Where it acts.
        at: Attachment,
        /// Its direction in the drawing.
        direction: Vector2<f64>,
        /// Whether the direction turns with the body.
        turns: bool,
        /// What the opposite force acts on.
        reaction: Option<Frame>,
    },
    /// A torque (N m).
    Torque {
        /// The body on which it acts.
        body: Frame,
        /// What the opposite torque acts on.
        reaction: Option<Frame>,
    },
}

/// A chosen coordinate.
#[derive(Debug, Clone)]
pub struct Coordinate {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// What it measures.
    pub kind: CoordinateKind,
    /// Its value in the drawing (m or rad).
    pub drawn_at: f64,
    /// Its value in the state.
    pub value: f64,
    /// Its rate in the state.
    pub rate: f64,
}

/// What a coordinate measures.
#[derive(Debug, Clone, Copy)]
pub enum CoordinateKind {
    /// Displacement of a sliding joint.
    Slide(JointId),
    /// Rotation of a body against a frame.
    Rotation(BodyId, Frame),
    /// Displacement of a point in a direction.
    Displacement(Attachment, Vector2<f64>),
}

impl CoordinateKind {
    /// Whether the coordinate is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Rotation(..))
    }
}

impl Mechanism {
    /// The mechanism that a model describes, with the present values of its parameters.
    ///
    /// # Errors
    /// Every value that is not finite or not allowed, or too large or small to compute with.
    pub fn new(model: &Model) -> Result<Self, Faults> {
        let mechanism = Evaluation::new(model)?.mechanism();
        mechanism.check_magnitudes()?;
        Ok(mechanism)
    }

    /// Products of a few quantities must stay within the range of floating point.
    fn check_magnitudes(&self) -> Result<(), Faults> {
        let mut faults = Faults::default();
        let mut check = |what: String, place: Option<&Place>, values: &[f64]| {
            let is_usual = |value: &f64| *value == 0.0 || MAGNITUDES.contains(&value.abs());
            if !values.iter().all(is_usual) {
                let kind = FaultKind::Overflow { quantity: what };
                faults.push(
                    place.map_or(Fault::general(kind.clone()), |place| Fault::new(kind, place.clone())),
                );
            }
        };
        check("the size of the mechanism".into(), None, &[self.size]);
        check("gravity".into(), None, self.gravity.as_slice());
        for body in &self.bodies {
            let values = [body.mass, body.moment_of_inertia, body.centre_of_mass.x, body.centre_of_mass.y];
            check(
                format!("the mass, the moment of inertia or the place of {}", body.name),
                Some(&body.place),
                &values,
            );
        }
        for joint in &self.joints {
            let JointKind::Slider(slider) = &joint.kind else { continue };
            check(format!("the size of {}", joint.name), Some(&joint.place), &[slider.length, slider.height]);
        }
        for contact in &self.contacts {
            let place = &self.joints[contact.joint.index()].place;
            let values = [contact.mu, contact.mu_static, contact.preload].concat();
            check(format!("the friction of {}", contact.name), Some(place), &values);
        }
        for coordinate in &self.coordinates {
            let values = [coordinate.value, coordinate.drawn_at, coordinate.rate];
            check(format!("the value or the rate of {}", coordinate.name), Some(&coordinate.place), &values);
        }
        faults.or(())
    }

    /// The sliding joint with this number, if it is one.
    pub fn slider(&self, joint: JointId) -> Option<&Slider> {
        match &self.joints[joint.index()].kind {
            JointKind::Slider(slider) => Some(slider),
            JointKind::Hinge(_) => None,
        }
    }

    /// Name of a frame.
    pub fn frame_name(&self, frame: Frame) -> &str {
        frame.body().map_or("ground", |body| &self.bodies[body.index()].name)
    }

    /// Value of a quantity in a state.
    ///
    /// # Errors
    /// A fault if a formula has no finite or allowed value there.
    pub fn quantity(
        &self,
        quantity: Quantity,
        coordinates: &[f64],
        rates: &[f64],
        time: f64,
    ) -> Result<f64, Fault> {
        match quantity {
            Quantity::Constant(value) => Ok(value),
            Quantity::Varying(id) => {
                let values = Values { parameters: &self.parameters, coordinates, rates, time };
                self.formulas[id.index()].value(&values)
            }
        }
    }
}

/// A model beside the values of its formulas.
struct Evaluation<'m> {
    model: &'m Model,
    values: Vec<f64>,
}

impl<'m> Evaluation<'m> {
    fn new(model: &'m Model) -> Result<Self, Faults> {
        Ok(Self { model, values: model.constants()? })
    }

    fn mechanism(&self) -> Mechanism {
        let model = self.model;
        let mut contacts = Vec::new();
        let numbered = model.joints.iter().enumerate();
        let joints: Vec<Joint> =
            numbered.map(|(index, joint)| self.joint(JointId(index), joint, &mut contacts)).collect();
        let bodies = (0..model.bodies.len()).map(|index| self.body(BodyId(index), &joints)).collect();
        let coordinates = model.coordinates.iter().map(|coordinate| self.coordinate(coordinate)).collect();
        let mut mechanism = Mechanism {
            title: model.title.clone(),
            gravity: self.gravity(),
            time: model.time.map_or(0.0, |time| self.value(time)),
            bodies,
            joints,
            contacts,
            loads: model.loads.iter().map(|load| self.load(load)).collect(),
            drives: model.drives.iter().map(|drive| self.drive(drive)).collect(),
            coordinates,
            size: 1.0,
            parameters: model.parameter_values(&self.values),
            formulas: Arc::clone(&model.formulas),
        };
        mechanism.size = size(&mechanism);
        mechanism
    }

    fn value(&self, id: FormulaId) -> f64 {
        self.values[id.index()]
    }

    fn quantity(&self, id: FormulaId) -> Quantity {
        if self.model.formula(id).moves() {
            Quantity::Varying(id)
        } else {
            Quantity::Constant(self.value(id))
        }
    }

    fn vector(&self, components: [FormulaId; 2]) -> Vector2<f64> {
        Vector2::new(self.value(components[0]), self.value(components[1]))
    }

    fn gravity(&self) -> Vector2<f64> {
        match self.model.gravity {
            Gravity::None => Vector2::zeros(),
            Gravity::Down(magnitude) => Vector2::new(0.0, -self.value(magnitude)),
            Gravity::Components(components) => self.vector(components),
        }
    }

    fn attachment(&self, attachment: &model::Attachment) -> Attachment {
        Attachment { frame: attachment.frame, position: self.vector(attachment.position) }
    }

    /// Unit vector of a direction; the model has made sure that two points differ.
    fn direction(&self, along: &Along) -> Vector2<f64> {
        match along {
            Along::Angle(angle) => unit_vector(self.value(*angle)),
            Along::Points(points) => {
                let [from, to] = points.as_ref();
                (self.vector(to.position) - self.vector(from.position)).normalize()
            }
        }
    }

    fn body(&self, id: BodyId, joints: &[Joint]) -> Body {
        let body = &self.model.bodies[id.index()];
        let (mass, moment_of_inertia, centre_of_mass) = match &body.inertia {
            Inertia::Massless => (0.0, 0.0, mean_joint_place(Frame::Body(id), joints)),
            Inertia::Massive { mass, centre_of_mass, moment } => {
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
        }
    }

    /// Moment of inertia about the centre of mass, and the middle of a bar.
    fn moment_of_inertia(&self, moment: &Moment, mass: f64) -> (f64, Vector2<f64>) {
        match moment {
            Moment::Given(moment) => (self.value(*moment), Vector2::zeros()),
            Moment::Bar([from, to]) => {
                let (from, to) = (self.vector(*from), self.vector(*to));
                (mass * (to - from).norm_squared() / 12.0, (from + to) / 2.0)
            }
            Moment::Rectangle(sides) => (mass * self.vector(*sides).norm_squared() / 12.0, Vector2::zeros()),
            Moment::Disc(radius) => (mass * self.value(*radius).powi(2) / 2.0, Vector2::zeros()),
        }
    }

    fn joint(&self, id: JointId, joint: &model::Joint, contacts: &mut Vec<Contact>) -> Joint {
        let kind = match &joint.kind {
            model::JointKind::Hinge(ends) => {
                JointKind::Hinge(ends.each_ref().map(|end| self.attachment(end)))
            }
            model::JointKind::Slider(slider) => JointKind::Slider(self.slider(slider, id, contacts)),
        };
        Joint { name: joint.name.clone(), place: joint.place.clone(), kind }
    }

    fn slider(&self, slider: &model::Slider, joint: JointId, contacts: &mut Vec<Contact>) -> Slider {
        let length = slider.length.map_or(0.0, |length| self.value(length));
        let height = slider.height.map_or(0.0, |height| self.value(height));
        let offsets: &[f64] = if slider.kind == SliderKind::Block { &[0.5, -0.5] } else { &[0.0] };
        let first = contacts.len();
        for (contact, offset) in slider.contacts.iter().zip(offsets) {
            contacts.push(Contact {
                name: contact.name.clone(),
                joint,
                offset: offset * length,
                carried_by: contact.carried_by,
                mu: contact.mu.map(|mu| self.value(mu)),
                mu_static: contact.mu_static.map(|mu| self.value(mu)),
                preload: contact.preload.map(|preload| preload.map_or(0.0, |preload| self.value(preload))),
                preload_line: contact.preload_line,
                stiffness: contact.stiffness.map(|stiffness| self.value(stiffness)),
            });
        }
        Slider {
            kind: slider.kind,
            block: slider.block,
            guide: slider.guide,
            at: self.vector(slider.at),
            tangent: self.direction(&slider.along),
            length,
            height: if slider.around { -height } else { height },
            around: slider.around,
            travel: slider.travel.map(|travel| travel.map(|limit| self.value(limit))),
            contacts: (first..contacts.len()).map(ContactId).collect(),
        }
    }

    fn load(&self, load: &model::Load) -> Load {
        let kind = match &load.kind {
            ModelLoadKind::Force { at, force, frame, reaction } => {
                let (components, axes) = match force {
                    model::ForceValue::Components(components) => {
                        (components.map(|id| self.quantity(id)), [Vector2::x(), Vector2::y()])
                    }
                    model::ForceValue::Along(magnitude, along) => {
                        let axis = self.direction(along);
                        ([self.quantity(*magnitude), Quantity::Constant(0.0)], [axis, rot90(axis)])
                    }
                };
                let turns = *frame == ForceFrame::Body;
                LoadKind::Force { at: self.attachment(at), components, axes, turns, reaction: *reaction }
            }
            ModelLoadKind::Torque { body, moment, reaction } => {
                LoadKind::Torque { body: *body, moment: self.quantity(*moment), reaction: *reaction }
            }
            ModelLoadKind::Spring { between, stiffness, free_length } => {
                let between = between.each_ref().map(|end| self.attachment(end));
                let drawn = (between[0].position - between[1].position).norm();
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
                free_angle: free_angle.map_or(Quantity::Constant(0.0), |angle| self.quantity(angle)),
            },
            ModelLoadKind::TorsionalDamper { between, damping } => {
                LoadKind::TorsionalDamper { between: *between, damping: self.quantity(*damping) }
            }
        };
        Load { name: load.name.clone(), place: load.place.clone(), kind }
    }

    fn drive(&self, drive: &model::Drive) -> Drive {
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
            acceleration: drive.acceleration.map_or(Quantity::Constant(0.0), |id| self.quantity(id)),
            effort,
        }
    }

    fn coordinate(&self, coordinate: &model::Coordinate) -> Coordinate {
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
        let drawn_at = coordinate.drawn_at.map_or(0.0, |id| self.value(id));
        Coordinate {
            name: coordinate.name.clone(),
            place: coordinate.place.clone(),
            kind,
            drawn_at,
            value: coordinate.value.map_or(drawn_at, |id| self.value(id)),
            rate: coordinate.rate.map_or(0.0, |id| self.value(id)),
        }
    }
}

/// The unit vector at an angle; exact along the axes, so that a guide at 90 degrees is truly vertical.
fn unit_vector(angle: f64) -> Vector2<f64> {
    let quarters = angle / std::f64::consts::FRAC_PI_2;
    let nearest = quarters.round();
    if (quarters - nearest).abs() > 1e-15 * quarters.abs() {
        return Vector2::new(angle.cos(), angle.sin());
    }
    match nearest.rem_euclid(4.0) {
        0.0 => Vector2::new(1.0, 0.0),
        1.0 => Vector2::new(0.0, 1.0),
        2.0 => Vector2::new(-1.0, 0.0),
        _ => Vector2::new(0.0, -1.0),
    }
}

/// A vector turned by a right angle counter-clockwise: n = rot90(u).
pub fn rot90(vector: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-vector.y, vector.x)
}

fn mean_joint_place(frame: Frame, joints: &[Joint]) -> Vector2<f64> {
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
    if count > 0.0 { sum / count } else { sum }
}

/// The greatest extent of the drawing.
fn size(mechanism: &Mechanism) -> f64 {
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
