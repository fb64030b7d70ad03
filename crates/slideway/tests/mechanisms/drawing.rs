//! A mechanism as plain numbers: written out as a model file, and transformed.

use slideway::GROUND as GROUND_FRAME;
use slideway::drawing::ContactBuilder;
use slideway::ids::{BodyId, Frame, JointId};

/// A point or vector.
pub(crate) type Vector = [f64; 2];

/// The frame of ground, in place of the number of a body.
pub(crate) const GROUND: Option<usize> = None;

/// A drawing with its state.
#[derive(Debug, Clone)]
pub(crate) struct Drawing {
    pub(crate) gravity: Vector,
    pub(crate) bodies: Vec<Body>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) loads: Vec<Load>,
    pub(crate) coordinates: Vec<Coordinate>,
    pub(crate) drives: Vec<Drive>,
}

#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub(crate) name: String,
    /// Mass and moment of inertia; nothing for a massless body.
    pub(crate) inertia: Option<[f64; 2]>,
    pub(crate) centre: Vector,
}

#[derive(Debug, Clone)]
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) kind: Kind,
}

#[derive(Debug, Clone)]
pub(crate) enum Kind {
    Hinge { between: [Option<usize>; 2], at: Vector },
    Slider(Slider),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SliderKind {
    Block,
    Guided,
    Pin,
}

#[derive(Debug, Clone)]
pub(crate) struct Slider {
    pub(crate) kind: SliderKind,
    pub(crate) block: Option<usize>,
    pub(crate) guide: Option<usize>,
    pub(crate) at: Vector,
    /// Direction of the guide (rad).
    pub(crate) along: f64,
    pub(crate) length: f64,
    pub(crate) height: f64,
    pub(crate) around: bool,
    /// Front and rear, or the only one.
    pub(crate) contacts: Vec<Contact>,
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Contact {
    /// For positive and for negative normal force.
    pub(crate) mu: [f64; 2],
    pub(crate) preload: [f64; 2],
    pub(crate) centred_preload: bool,
    pub(crate) carried_by_guide: bool,
}

#[derive(Debug, Clone)]
pub(crate) enum Load {
    Force { body: usize, at: Vector, force: Vector, turns: bool, reaction: Option<usize> },
    Torque { body: usize, moment: f64 },
    Spring { between: [Option<usize>; 2], at: [Vector; 2], stiffness: f64, free_length: f64 },
    Damper { between: [Option<usize>; 2], at: [Vector; 2], damping: f64 },
    TorsionalSpring { body: usize, stiffness: f64 },
    TorsionalDamper { body: usize, damping: f64 },
}

#[derive(Debug, Clone)]
pub(crate) struct Coordinate {
    pub(crate) name: String,
    pub(crate) what: Measured,
    pub(crate) value: f64,
    pub(crate) rate: f64,
}

/// A prescribed acceleration and what produces it.
#[derive(Debug, Clone)]
pub(crate) struct Drive {
    /// Number of the coordinate.
    pub(crate) coordinate: usize,
    pub(crate) acceleration: f64,
    pub(crate) body: usize,
    pub(crate) reaction: Option<usize>,
    pub(crate) effort: Effort,
}

/// What a drive's unknown is.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Effort {
    /// A force at a place in a direction (rad).
    Force {
        at: Vector,
        direction: f64,
        turns: bool,
    },
    Torque,
}

#[derive(Debug, Clone, Copy)]
pub(crate) enum Measured {
    /// Displacement of this joint.
    Slide(usize),
    /// Rotation of this body.
    Rotation(usize),
}

impl Drawing {
    /// The joint's slider.
    pub(crate) fn sliders(&self) -> impl Iterator<Item = (&str, &Slider)> {
        self.joints.iter().filter_map(|joint| match &joint.kind {
            Kind::Slider(slider) => Some((joint.name.as_str(), slider)),
            Kind::Hinge { .. } => None,
        })
    }

    /// All contacts in the order of the model file, each with its name and slider.
    pub(crate) fn contacts(&self) -> Vec<(String, &Slider, Contact)> {
        let ends = ["front", "rear"];
        let of = |(name, slider): (&str, &'_ Slider)| -> Vec<(String, Contact)> {
            let named = slider.contacts.iter().zip(ends).map(|(contact, end)| {
                let plain = slider.kind != SliderKind::Block;
                (if plain { name.to_owned() } else { format!("{name}.{end}") }, *contact)
            });
            named.collect()
        };
        let mut contacts = Vec::new();
        for (name, slider) in self.sliders() {
            contacts.extend(of((name, slider)).into_iter().map(|(name, contact)| (name, slider, contact)));
        }
        contacts
    }

    /// The text of its model file.
    pub(crate) fn text(&self) -> String {
        let mut drawing = slideway::Drawing::new();
        drawing.gravity_components(self.gravity);
        for body in &self.bodies {
            let drawn = drawing.body(&body.name);
            let _ = match body.inertia {
                None => drawn.massless(),
                Some([mass, moment]) => drawn.mass(mass).inertia(moment).centre(body.centre),
            };
        }
        let joints: Vec<JointId> = self.joints.iter().map(|joint| drawn_joint(joint, &mut drawing)).collect();
        for (index, load) in self.loads.iter().enumerate() {
            draw_load(load, &format!("load_{index}"), &mut drawing);
        }
        let mut coordinates = Vec::new();
        for Coordinate { name, what, value, rate } in &self.coordinates {
            let drawn = match what {
                Measured::Slide(joint) => drawing.slide(name, joints[*joint]),
                Measured::Rotation(body) => drawing.rotation(name, BodyId(*body)),
            };
            coordinates.push(drawn.value(*value).rate(*rate).id());
        }
        for (index, drive) in self.drives.iter().enumerate() {
            let (name, body) = (format!("drive_{index}"), BodyId(drive.body));
            let coordinate = coordinates[drive.coordinate];
            let mut drawn = match drive.effort {
                Effort::Force { at, direction, .. } => {
                    drawing.drive_by_force(&name, coordinate, (body, at, direction))
                }
                Effort::Torque => drawing.drive_by_torque(&name, coordinate, body),
            };
            if matches!(drive.effort, Effort::Force { turns: true, .. }) {
                drawn = drawn.turning();
            }
            if let Some(body) = drive.reaction {
                drawn = drawn.reaction(BodyId(body));
            }
            drawn.acceleration(drive.acceleration);
        }
        drawing.to_toml()
    }
}

fn frame(body: Option<usize>) -> Frame {
    body.map_or(GROUND_FRAME, |body| BodyId(body).into())
}

fn drawn_joint(joint: &Joint, drawing: &mut slideway::Drawing) -> JointId {
    let slider = match &joint.kind {
        Kind::Hinge { between: [first, second], at } => {
            return drawing.hinge(&joint.name, frame(*first), frame(*second)).at(*at).id();
        }
        Kind::Slider(slider) => slider,
    };
    let (block, guide) = (frame(slider.block), frame(slider.guide));
    let contact = &slider.contacts[0];
    let (mu, preload) = (contact.mu, contact.preload);
    match slider.kind {
        SliderKind::Pin => drawing
            .pin_in_slot(&joint.name, block, guide)
            .at(slider.at)
            .along(slider.along)
            .mu_by_side(mu[0], mu[1])
            .preload_by_side(preload[0], preload[1])
            .id()
            .into(),
        SliderKind::Guided => {
            let drawn = drawing.guided_slider(&joint.name, block, guide).at(slider.at).along(slider.along);
            let drawn = drawn.length(slider.length).height(slider.height);
            let mut drawn = drawn.mu_by_side(mu[0], mu[1]).preload_by_side(preload[0], preload[1]);
            if contact.centred_preload {
                drawn = drawn.centred_preload();
            }
            if slider.around { drawn.around() } else { drawn }.id().into()
        }
        SliderKind::Block => {
            let drawn = drawing.block_slider(&joint.name, block, guide).at(slider.at).along(slider.along);
            let drawn = drawn.length(slider.length).height(slider.height);
            let drawn = drawn
                .front(|front| draw_contact(contact, front))
                .rear(|rear| draw_contact(&slider.contacts[1], rear));
            if slider.around { drawn.around() } else { drawn }.id().into()
        }
    }
}

fn draw_contact(contact: &Contact, drawn: &mut ContactBuilder<'_>) {
    drawn.mu_by_side(contact.mu[0], contact.mu[1]).preload_by_side(contact.preload[0], contact.preload[1]);
    if contact.centred_preload {
        drawn.centred_preload();
    }
    if contact.carried_by_guide {
        drawn.carried_by_guide();
    }
}

fn draw_load(load: &Load, name: &str, drawing: &mut slideway::Drawing) {
    match *load {
        Load::Force { body, at, force, turns, reaction } => {
            let mut drawn = drawing.force(name, BodyId(body)).at(at).components(force);
            if turns {
                drawn = drawn.turning();
            }
            if let Some(body) = reaction {
                drawn.reaction(BodyId(body));
            }
        }
        Load::Torque { body, moment } => {
            drawing.torque(name, BodyId(body), moment);
        }
        Load::Spring { between, at, stiffness, free_length } => {
            let ends = [0, 1].map(|end| (frame(between[end]), at[end]));
            drawing.spring(name, ends, stiffness).free_length(free_length);
        }
        Load::Damper { between, at, damping } => {
            drawing.damper(name, [0, 1].map(|end| (frame(between[end]), at[end])), damping);
        }
        Load::TorsionalSpring { body, stiffness } => {
            drawing.torsional_spring(name, [BodyId(body).into(), GROUND_FRAME], stiffness);
        }
        Load::TorsionalDamper { body, damping } => {
            drawing.torsional_damper(name, [BodyId(body).into(), GROUND_FRAME], damping);
        }
    }
}

/// Factors of the units of length, mass and time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Units {
    pub(crate) length: f64,
    pub(crate) mass: f64,
    pub(crate) time: f64,
}

impl Units {
    pub(crate) fn force(&self) -> f64 {
        self.mass * self.acceleration()
    }

    pub(crate) fn acceleration(&self) -> f64 {
        self.length / self.time.powi(2)
    }
}

/// A vector turned by an angle.
pub(crate) fn turned([x, y]: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

impl Drawing {
    /// Applies functions to every place, every vector and every slider.
    fn map(
        &self,
        place: impl Fn(Vector) -> Vector,
        vector: impl Fn(Vector) -> Vector,
        slider: impl Fn(&mut Slider),
    ) -> Self {
        let mut drawing = self.clone();
        drawing.gravity = vector(drawing.gravity);
        for body in &mut drawing.bodies {
            body.centre = place(body.centre);
        }
        for joint in &mut drawing.joints {
            match &mut joint.kind {
                Kind::Hinge { at, .. } => *at = place(*at),
                Kind::Slider(joint) => {
                    joint.at = place(joint.at);
                    slider(joint);
                }
            }
        }
        for load in &mut drawing.loads {
            match load {
                Load::Force { at, force, .. } => (*at, *force) = (place(*at), vector(*force)),
                Load::Spring { at, .. } | Load::Damper { at, .. } => *at = at.map(&place),
                Load::Torque { .. } | Load::TorsionalSpring { .. } | Load::TorsionalDamper { .. } => {}
            }
        }
        for drive in &mut drawing.drives {
            if let Effort::Force { at, direction, .. } = &mut drive.effort {
                let [x, y] = vector([direction.cos(), direction.sin()]);
                (*at, *direction) = (place(*at), y.atan2(x));
            }
        }
        drawing
    }

    /// Turns the sign of the drives of some coordinates.
    fn turn_drives(&mut self, turned: impl Fn(&Measured) -> bool) {
        for drive in &mut self.drives {
            if turned(&self.coordinates[drive.coordinate].what) {
                drive.acceleration = -drive.acceleration;
            }
        }
    }

    /// The whole drawing turned about the origin, then shifted.
    pub(crate) fn rotated(&self, angle: f64, shift: Vector) -> Self {
        let place = |at| {
            let [x, y] = turned(at, angle);
            [x + shift[0], y + shift[1]]
        };
        self.map(place, |vector| turned(vector, angle), |slider| slider.along += angle)
    }

    /// The mirror image x -> -x. The mirrored tangent is kept, so every normal turns its sign.
    pub(crate) fn mirrored(&self) -> Self {
        let flip = |[x, y]: Vector| [-x, y];
        let mut mirrored = self.map(flip, flip, |slider| {
            slider.along = std::f64::consts::PI - slider.along;
            slider.contacts.iter_mut().for_each(Contact::swap_sides);
        });
        for load in &mut mirrored.loads {
            if let Load::Torque { moment, .. } = load {
                *moment = -*moment;
            }
        }
        for coordinate in &mut mirrored.coordinates {
            if let Measured::Rotation(_) = coordinate.what {
                coordinate.value = -coordinate.value;
                coordinate.rate = -coordinate.rate;
            }
        }
        mirrored.turn_drives(|what| matches!(what, Measured::Rotation(_)));
        mirrored
    }

    /// Everything `units` times as long, heavy and slow.
    pub(crate) fn scaled(&self, units: Units) -> Self {
        let Units { length, mass, time } = units;
        let scale = |factor: f64| move |[x, y]: Vector| [factor * x, factor * y];
        let mut scaled = self.map(
            scale(length),
            |vector| vector,
            |slider| {
                slider.length *= length;
                slider.height *= length;
                for contact in &mut slider.contacts {
                    contact.preload = scale(units.force())(contact.preload);
                }
            },
        );
        scaled.gravity = scale(units.acceleration())(scaled.gravity);
        for body in &mut scaled.bodies {
            body.inertia = body.inertia.map(|[m, moment]| [m * mass, moment * mass * length * length]);
        }
        for load in &mut scaled.loads {
            match load {
                Load::Force { force, .. } => *force = scale(units.force())(*force),
                Load::Torque { moment, .. } => *moment *= units.force() * length,
                Load::Spring { stiffness, free_length, .. } => {
                    *stiffness *= units.force() / length;
                    *free_length *= length;
                }
                Load::Damper { damping, .. } => *damping *= units.force() / length * time,
                Load::TorsionalSpring { stiffness, .. } => *stiffness *= units.force() * length,
                Load::TorsionalDamper { damping, .. } => *damping *= units.force() * length * time,
            }
        }
        for coordinate in &mut scaled.coordinates {
            let unit = if matches!(coordinate.what, Measured::Slide(_)) { length } else { 1.0 };
            coordinate.value *= unit;
            coordinate.rate *= unit / time;
        }
        for drive in &mut scaled.drives {
            let slides = matches!(scaled.coordinates[drive.coordinate].what, Measured::Slide(_));
            drive.acceleration *= if slides { units.acceleration() } else { time.powi(-2) };
        }
        scaled
    }

    /// Bodies, joints, loads and coordinates in the opposite order; hinges with their ends exchanged.
    pub(crate) fn reversed(&self) -> Self {
        let mut reversed = self.clone();
        let last_body = self.bodies.len() - 1;
        let last_joint = self.joints.len() - 1;
        let body = |body: usize| last_body - body;
        let frame = |frame: Option<usize>| frame.map(body);
        for joint in &mut reversed.joints {
            match &mut joint.kind {
                Kind::Hinge { between, .. } => *between = [frame(between[1]), frame(between[0])],
                Kind::Slider(slider) => {
                    (slider.block, slider.guide) = (frame(slider.block), frame(slider.guide));
                }
            }
        }
        for load in &mut reversed.loads {
            match load {
                Load::Force { body: on, reaction, .. } => {
                    (*on, *reaction) = (body(*on), frame(*reaction));
                }
                Load::Spring { between, at, .. } | Load::Damper { between, at, .. } => {
                    *between = [frame(between[1]), frame(between[0])];
                    at.reverse();
                }
                Load::Torque { body: on, .. }
                | Load::TorsionalSpring { body: on, .. }
                | Load::TorsionalDamper { body: on, .. } => *on = body(*on),
            }
        }
        for coordinate in &mut reversed.coordinates {
            coordinate.what = match coordinate.what {
                Measured::Slide(joint) => Measured::Slide(last_joint - joint),
                Measured::Rotation(on) => Measured::Rotation(body(on)),
            };
        }
        let last_coordinate = self.coordinates.len() - 1;
        for drive in &mut reversed.drives {
            drive.coordinate = last_coordinate - drive.coordinate;
            (drive.body, drive.reaction) = (body(drive.body), frame(drive.reaction));
        }
        reversed.drives.reverse();
        reversed.bodies.reverse();
        reversed.joints.reverse();
        reversed.loads.reverse();
        reversed.coordinates.reverse();
        reversed
    }

    /// Block and guide of every block slider exchanged: what was inside is now around, a contact that
    /// travelled with the block now travels with the guide. Normal force, sliding velocity and friction turn
    /// their signs.
    pub(crate) fn with_roles_exchanged(&self) -> Self {
        let mut exchanged = self.clone();
        for (index, joint) in exchanged.joints.iter_mut().enumerate() {
            let Kind::Slider(slider) = &mut joint.kind else { continue };
            if slider.kind != SliderKind::Block {
                continue;
            }
            std::mem::swap(&mut slider.block, &mut slider.guide);
            slider.around = !slider.around;
            for contact in &mut slider.contacts {
                contact.carried_by_guide = !contact.carried_by_guide;
                contact.swap_sides();
            }
            for coordinate in &mut exchanged.coordinates {
                if matches!(coordinate.what, Measured::Slide(joint) if joint == index) {
                    coordinate.value = -coordinate.value;
                    coordinate.rate = -coordinate.rate;
                }
            }
        }
        exchanged.turn_drives(|what| matches!(what, Measured::Slide(joint) if self.is_block_slider(*joint)));
        exchanged
    }

    fn is_block_slider(&self, joint: usize) -> bool {
        matches!(&self.joints[joint].kind, Kind::Slider(slider) if slider.kind == SliderKind::Block)
    }

    /// Every guide counted in the opposite direction: u and n turn, front and rear change places.
    pub(crate) fn with_guides_reversed(&self) -> Self {
        let mut reversed = self.clone();
        for (index, joint) in reversed.joints.iter_mut().enumerate() {
            let Kind::Slider(slider) = &mut joint.kind else { continue };
            slider.along += std::f64::consts::PI;
            slider.contacts.reverse();
            slider.contacts.iter_mut().for_each(Contact::swap_sides);
            for coordinate in &mut reversed.coordinates {
                if matches!(coordinate.what, Measured::Slide(joint) if joint == index) {
                    coordinate.value = -coordinate.value;
                    coordinate.rate = -coordinate.rate;
                }
            }
        }
        reversed.turn_drives(|what| matches!(what, Measured::Slide(_)));
        reversed
    }
}

impl Contact {
    fn swap_sides(&mut self) {
        self.mu.reverse();
        self.preload.reverse();
    }
}
