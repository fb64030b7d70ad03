//! A mechanism as plain numbers: written out as a model file, and transformed.

use std::fmt::Write;

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

    fn name(&self, body: Option<usize>) -> &str {
        body.map_or("ground", |body| &self.bodies[body].name)
    }

    /// The text of its model file.
    pub(crate) fn text(&self) -> String {
        Writer { drawing: self, points: Vec::new(), text: String::new() }.write()
    }
}

/// Writes the sections while it collects the named points and their owners.
struct Writer<'d> {
    drawing: &'d Drawing,
    points: Vec<(Option<usize>, Vector)>,
    text: String,
}

impl Writer<'_> {
    fn write(mut self) -> String {
        self.joints();
        self.loads();
        self.coordinates();
        self.drives();
        let mut head = format!("gravity = {:?}\n[points]\n", self.drawing.gravity);
        for (index, (_, place)) in self.points.iter().enumerate() {
            writeln!(head, "p{index} = {place:?}").unwrap();
        }
        for (number, body) in self.drawing.bodies.iter().enumerate() {
            let owned = (0..self.points.len()).filter(|index| self.points[*index].0 == Some(number));
            let owned: Vec<String> = owned.map(|index| format!("p{index}")).collect();
            writeln!(head, "[bodies.{}]\npoints = {owned:?}", body.name).unwrap();
            match body.inertia {
                None => writeln!(head, "massless = true").unwrap(),
                Some([mass, moment]) => writeln!(
                    head,
                    "mass = {mass:?}\nmoment_of_inertia = {moment:?}\ncentre_of_mass = {:?}",
                    body.centre
                )
                .unwrap(),
            }
        }
        head + &self.text
    }

    /// A new point that moves with a body: "body.p7".
    fn point(&mut self, body: Option<usize>, place: Vector) -> String {
        self.points.push((body, place));
        format!("{}.p{}", self.drawing.name(body), self.points.len() - 1)
    }

    fn joints(&mut self) {
        for joint in &self.drawing.joints {
            writeln!(self.text, "[joints.{}]", joint.name).unwrap();
            match &joint.kind {
                Kind::Hinge { between, at } => {
                    let between = between.map(|body| self.point(body, *at));
                    writeln!(self.text, "type = \"hinge\"\nbetween = {between:?}").unwrap();
                }
                Kind::Slider(slider) => self.slider(slider),
            }
        }
    }

    fn slider(&mut self, slider: &Slider) {
        let kind = match slider.kind {
            SliderKind::Block => "block_slider",
            SliderKind::Guided => "guided_slider",
            SliderKind::Pin => "pin_in_slot",
        };
        let (block, guide) = (self.drawing.name(slider.block), self.drawing.name(slider.guide));
        writeln!(
            self.text,
            "type = \"{kind}\"\nblock = \"{block}\"\nguide = \"{guide}\"\nat = {:?}\nalong = {:?}",
            slider.at, slider.along
        )
        .unwrap();
        if slider.kind != SliderKind::Pin {
            let fit = if slider.around { "around" } else { "inside" };
            writeln!(
                self.text,
                "length = {:?}\nheight = {:?}\nfit = \"{fit}\"",
                slider.length, slider.height
            )
            .unwrap();
        }
        if slider.kind == SliderKind::Block {
            for (end, contact) in ["front", "rear"].iter().zip(&slider.contacts) {
                let carried_by = if contact.carried_by_guide { "guide" } else { "block" };
                writeln!(
                    self.text,
                    "{end} = {{ carried_by = \"{carried_by}\", {} }}",
                    friction(contact, ", ")
                )
                .unwrap();
            }
        } else {
            let mut contact = friction(&slider.contacts[0], "\n");
            if slider.kind == SliderKind::Pin {
                contact = contact
                    .lines()
                    .filter(|line| !line.starts_with("preload_line"))
                    .collect::<Vec<_>>()
                    .join("\n");
            }
            writeln!(self.text, "{contact}").unwrap();
        }
    }

    fn loads(&mut self) {
        for (index, load) in self.drawing.loads.iter().enumerate() {
            writeln!(self.text, "[loads.load_{index}]").unwrap();
            let lines = match load {
                Load::Force { body, at, force, turns, reaction } => {
                    let at = self.point(Some(*body), *at);
                    let frame = if *turns { "body" } else { "world" };
                    let reaction =
                        reaction.map(|body| format!("\nreaction = \"{}\"", self.drawing.name(Some(body))));
                    format!(
                        "type = \"force\"\nat = \"{at}\"\ncomponents = {force:?}\nframe = \"{frame}\"{}",
                        reaction.unwrap_or_default()
                    )
                }
                Load::Torque { body, moment } => {
                    format!(
                        "type = \"torque\"\nbody = \"{}\"\nmoment = {moment:?}",
                        self.drawing.name(Some(*body))
                    )
                }
                Load::Spring { between, at, stiffness, free_length } => {
                    let ends = [0, 1].map(|end| self.point(between[end], at[end]));
                    format!(
                        "type = \"spring\"\nbetween = {ends:?}\nstiffness = {stiffness:?}\nfree_length = {free_length:?}"
                    )
                }
                Load::Damper { between, at, damping } => {
                    let ends = [0, 1].map(|end| self.point(between[end], at[end]));
                    format!("type = \"damper\"\nbetween = {ends:?}\ndamping = {damping:?}")
                }
                Load::TorsionalSpring { body, stiffness } => {
                    let ends = [self.drawing.name(Some(*body)), "ground"];
                    format!("type = \"torsional_spring\"\nbetween = {ends:?}\nstiffness = {stiffness:?}")
                }
                Load::TorsionalDamper { body, damping } => {
                    let ends = [self.drawing.name(Some(*body)), "ground"];
                    format!("type = \"torsional_damper\"\nbetween = {ends:?}\ndamping = {damping:?}")
                }
            };
            writeln!(self.text, "{lines}").unwrap();
        }
    }

    fn coordinates(&mut self) {
        for coordinate in &self.drawing.coordinates {
            let what = match coordinate.what {
                Measured::Slide(joint) => format!("slide = \"{}\"", self.drawing.joints[joint].name),
                Measured::Rotation(body) => format!("rotation = \"{}\"", self.drawing.bodies[body].name),
            };
            let Coordinate { name, value, rate, .. } = coordinate;
            writeln!(self.text, "[coordinates.{name}]\n{what}\nvalue = {value:?}\nrate = {rate:?}").unwrap();
        }
    }
}

impl Writer<'_> {
    fn drives(&mut self) {
        for (index, drive) in self.drawing.drives.iter().enumerate() {
            let coordinate = &self.drawing.coordinates[drive.coordinate].name;
            let reaction =
                drive.reaction.map(|body| format!(", reaction = \"{}\"", self.drawing.name(Some(body))));
            let reaction = reaction.unwrap_or_default();
            let effort = match drive.effort {
                Effort::Force { at, direction, turns } => {
                    let at = self.point(Some(drive.body), at);
                    let frame = if turns { "body" } else { "world" };
                    format!(
                        "force = {{ at = \"{at}\", direction = {direction:?}, frame = \"{frame}\"{reaction} }}"
                    )
                }
                Effort::Torque => {
                    format!("torque = {{ body = \"{}\"{reaction} }}", self.drawing.name(Some(drive.body)))
                }
            };
            let acceleration = drive.acceleration;
            writeln!(
                self.text,
                "[drives.drive_{index}]\ncoordinate = \"{coordinate}\"\nacceleration = {acceleration:?}\n{effort}"
            )
            .unwrap();
        }
    }
}

fn friction(contact: &Contact, separator: &str) -> String {
    let line = if contact.centred_preload { "centre" } else { "pressed" };
    [
        format!("mu = {{ plus = {:?}, minus = {:?} }}", contact.mu[0], contact.mu[1]),
        format!("preload = {{ plus = {:?}, minus = {:?} }}", contact.preload[0], contact.preload[1]),
        format!("preload_line = \"{line}\""),
    ]
    .join(separator)
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

    /// Block and guide of every block slider exchanged: what was inside is now around, a contact that travelled
    /// with the block now travels with the guide. Normal force, sliding velocity and friction turn their signs.
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
