//! The cross-section of a guide: its faces, its block, and all forces across it.

use super::loads::RING;
use super::outline::capsule;
use super::scene::{Anchor, Bounds, Class, Point, Scene, Shape, Text};
use super::slide::BAR;
use super::{ContactStates, Painter, SceneOptions, VALUE_SIZE, View, labels};
use nalgebra::Vector2;
use slideway::configuration::Configuration;
use slideway::ids::{BodyId, ContactId, Frame, JointId};
use slideway::kinetics::load_wrenches;
use slideway::mechanism::{Attachment, Contact, Effort, LoadKind, Mechanism, Shape as BodyShape, Slider};

/// Width and height for the section of a body.
const SIZE: [f64; 2] = [300.0, 220.0];
/// Half the length of a face, its distance from the middle of a contact, and half the size of a pad.
const FACE: f64 = 15.0;
const GAP: f64 = 5.0;
const PAD: f64 = 5.0;
/// How far the arrows of contacts at the rear stand beside those at the front.
const ASIDE: f64 = 6.0;
/// Radius of a round rod.
const ROD: f64 = 9.0;
/// Length of the arrows of axes.
const AXIS: f64 = 26.0;

/// The sliding joints whose contacts do not all lie in the drawing.
pub(super) fn joints_in_space(mechanism: &Mechanism) -> impl Iterator<Item = JointId> + '_ {
    let is_there = |slider: &Slider| {
        let mut contacts = slider.contacts.iter().map(|contact| &mechanism.contacts[contact.index()]);
        contacts.any(|contact| contact.lean.is_some() || contact.aside != [0.0; 2])
    };
    mechanism.sliders().filter(move |(_, slider)| is_there(slider)).map(|(joint, _)| joint)
}

/// A place in the section: along n and along z (m), from the middle of the block.
type Place = Vector2<f64>;

/// A force on the block: its name, where it acts, its components along n and z, and along the guide (N).
struct Load {
    name: String,
    place: Place,
    across: Vector2<f64>,
    along: f64,
}

/// The section of a joint, seen against the direction of sliding, and its drawing units for a metre.
pub(super) fn section(
    mechanism: &Mechanism,
    configuration: &Configuration,
    states: &ContactStates,
    (view, options): (&View, &SceneOptions),
    joint: JointId,
) -> (Scene, f64) {
    let Some(slider) = mechanism.slider(joint) else { return (Scene::default(), view.scale) };
    let mut painter = Painter {
        mechanism,
        actual: configuration,
        configuration,
        play: None,
        magnification: None,
        states,
        view,
        options,
        looks: Vec::new(),
        sliders: Vec::new(),
        scene: Scene::default(),
        labels: Vec::new(),
    };
    let middle = Attachment { frame: slider.block, position: slider.at, z: slider.z };
    let section = Section {
        slider,
        middle: configuration.position(mechanism, &middle),
        tangent: configuration.slide(mechanism, slider).tangent,
        scale: 1.0,
    };
    let loads = painter.loads_in_section(&section);
    let scale = painter.scale_of_section(&section, &loads);
    painter.draw_section(&Section { scale, ..section }, loads);
    let Painter { scene, labels, .. } = painter;
    (labels::labelled(scene, labels, None), scale)
}

/// The cross-section of a sliding joint.
struct Section<'a> {
    slider: &'a Slider,
    /// The middle of the block (m).
    middle: Vector2<f64>,
    /// The direction of sliding.
    tangent: Vector2<f64>,
    /// Drawing units for a metre.
    scale: f64,
}

impl Section<'_> {
    fn normal(&self) -> Vector2<f64> {
        Vector2::new(-self.tangent.y, self.tangent.x)
    }

    /// A place of the drawing at a height, in the section.
    fn place(&self, place: Vector2<f64>, z: f64) -> Place {
        Place::new((place - self.middle).dot(&self.normal()), z - self.slider.z)
    }

    fn drawn(&self, place: Place) -> Point {
        direction(place) * self.scale
    }

    /// Half the distance between the faces of a contact (m).
    fn half_height(&self, contact: &Contact) -> f64 {
        (contact.height.unwrap_or(self.slider.height) / 2.0).abs()
    }

    /// How far the faces of a contact are drawn from its middle: where they are, or close by if the contact has no height.
    fn reach(&self, contact: &Contact) -> f64 {
        (self.half_height(contact) * self.scale).max(GAP)
    }

    /// The side of a contact on which its face lies that presses with a positive normal force.
    fn pressing_side(&self) -> f64 {
        if self.slider.around { 1.0 } else { -1.0 }
    }
}

/// In the drawing, where y points down.
fn direction(across: Vector2<f64>) -> Point {
    Point::new(across.x, -across.y)
}

impl<'a> Painter<'a> {
    /// The contacts of the block, each with its place.
    fn in_section(&self, section: &Section<'_>) -> Vec<(usize, &'a Contact, Place)> {
        let mechanism = self.mechanism;
        let contacts = section.slider.contacts.iter();
        contacts
            .map(|&id: &ContactId| {
                let geometry = self.configuration.contact(mechanism, id);
                let place = section.place(geometry.point, geometry.z);
                (id.index(), &mechanism.contacts[id.index()], place)
            })
            .collect()
    }

    /// The corners of the body of the block, where its shape is known in space.
    fn outline_in_section(&self, section: &Section<'_>) -> Option<[Place; 2]> {
        let body = section.slider.block.body()?;
        let (about, of) = (&self.mechanism.bodies[body.index()], self.mechanism.space.as_ref()?);
        let of = &of.bodies[body.index()];
        let (BodyShape::Rectangle([width, height]), [about_x, about_y]) = (about.shape?, of.tilt?) else {
            return None;
        };
        // Of a box, I_x + I_y - I_z = m d^2/6.
        let depth = (6.0 * (about_x + about_y - about.moment_of_inertia) / about.mass).max(0.0).sqrt();
        let axes =
            [Vector2::x(), Vector2::y()].map(|axis| self.configuration.direction(section.slider.block, axis));
        let reach = [width, height]
            .into_iter()
            .zip(axes)
            .map(|(side, axis)| side * axis.dot(&section.normal()).abs());
        let half = Place::new(reach.sum(), depth) * 0.5;
        let middle = section.place(self.centre_of(body), of.z);
        Some([middle - half, middle + half])
    }

    fn centre_of(&self, body: BodyId) -> Vector2<f64> {
        let centre = self.mechanism.bodies[body.index()].centre_of_mass;
        self.configuration.position(self.mechanism, &Attachment::new(Frame::Body(body), centre))
    }

    fn scale_of_section(&self, section: &Section<'_>, loads: &[Load]) -> f64 {
        let faces = |(_, contact, place): (usize, &Contact, Place)| {
            let half = Place::from(contact.normal_across()) * section.half_height(contact);
            [place - half, place + half]
        };
        let contacts = self.in_section(section).into_iter().flat_map(faces);
        let loads = loads.iter().map(|load| load.place);
        let corners = self.outline_in_section(section).into_iter().flatten();
        let bounds = Bounds::around(contacts.chain(loads).chain(corners));
        let size = bounds.map_or(Point::zeros(), |bounds| bounds.size());
        let scale = (SIZE[0] / size.x).min(SIZE[1] / size.y);
        if scale.is_finite() { scale } else { self.view.scale }
    }

    fn draw_section(&mut self, section: &Section<'_>, loads: Vec<Load>) {
        self.body_in_section(section, &loads);
        let contacts = self.in_section(section);
        let ends: Vec<[usize; 2]> = self
            .mechanism
            .friction_circles
            .iter()
            .filter_map(|circle| circle.end.map(|end| end.map(ContactId::index)))
            .collect();
        let end_of = |k: usize| ends.iter().find(|end| end.contains(&k));
        for (k, contact, place) in &contacts {
            match end_of(*k) {
                None => self.faces_of(section, contact, section.drawn(*place)),
                Some([along_n, _]) if along_n == k => self.rod(section.drawn(*place)),
                Some(_) => {}
            }
        }
        for (k, contact, place) in &contacts {
            match end_of(*k) {
                None => self.force_in_section(section, (*k, contact), section.drawn(*place)),
                Some(end) if end[0] == *k => {
                    self.force_of_end((*end, contact), section.drawn(*place));
                }
                Some(_) => {}
            }
        }
        let mut signs: Vec<Point> = Vec::new();
        for load in loads {
            let place = section.drawn(load.place);
            if load.across.norm() > 0.0 {
                let length = self.options.force_scale.map_or(1.0, |scale| scale * load.across.norm());
                let text = format!("{} {}", load.name, self.shown(load.across.norm(), "N"));
                let arrow = direction(load.across / load.across.norm()) * length;
                self.arrow_of_force(Class::Load, (place, false), arrow, text);
            }
            if load.along != 0.0 {
                // Beside each other where several act at one place.
                let mut at = place;
                while signs.iter().any(|sign| (sign - at).norm() < 2.0 * RING) {
                    at.x += 2.4 * RING;
                }
                signs.push(at);
                let text = format!("{} {}", load.name, self.shown(load.along.abs(), "N"));
                self.out_of_drawing(Class::Load, at, load.along > 0.0, text);
            }
        }
        self.axes_of_section();
    }

    /// The body of the block, with an arm to each load outside of it.
    fn body_in_section(&mut self, section: &Section<'_>, loads: &[Load]) {
        let outline = self.outline_in_section(section);
        let [least, greatest] = outline.unwrap_or([Place::zeros(); 2]);
        let box_of = |[least, greatest]: [Place; 2]| {
            [least, Place::new(greatest.x, least.y), greatest, Place::new(least.x, greatest.y)]
                .map(|corner| section.drawn(corner))
                .to_vec()
        };
        let mut parts: Vec<Vec<Point>> = outline.map(box_of).into_iter().collect();
        for load in loads {
            let nearest = load.place.sup(&least).inf(&greatest);
            if nearest != load.place {
                parts.push(capsule(section.drawn(nearest), section.drawn(load.place), BAR));
            }
        }
        self.union(&parts);
    }

    /// The pad of a contact, and the faces on which it may press.
    fn faces_of(&mut self, section: &Section<'_>, contact: &Contact, at: Point) {
        let [cos, sin] = contact.normal_across();
        let normal = direction(Vector2::new(cos, sin));
        let across = Point::new(-normal.y, normal.x);
        let reach = section.reach(contact);
        // One pad between faces that are close, else one at each.
        let pads: &[f64] = if reach > GAP { &[-1.0, 1.0] } else { &[0.0] };
        for pad in pads {
            let middle = at + normal * (pad * (reach - 0.5 * PAD));
            let corner = |one: f64, other: f64| middle + normal * (one * 0.5 * PAD) + across * (other * PAD);
            self.area(
                Class::Pad,
                vec![corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0), corner(-1.0, 1.0)],
            );
        }
        let sides: &[f64] = if contact.opens { &[1.0] } else { &[1.0, -1.0] };
        for side in sides {
            let out = normal * (*side * section.pressing_side());
            let along = Point::new(-out.y, out.x) * FACE;
            let [from, to] = [-1.0, 1.0].map(|end| at + out * reach + along * end);
            self.line(Class::Wall, vec![from, to]);
            if section.slider.guide == Frame::Ground {
                self.hatching(from, to);
            }
        }
    }

    /// A round rod, and the ring of the block around it.
    fn rod(&mut self, at: Point) {
        self.circle(Class::Pad, at, ROD + GAP);
        self.circle(Class::Wall, at, ROD);
    }

    /// The force of a round rod on an end of the block, across it.
    fn force_of_end(&mut self, (parts, contact): ([usize; 2], &Contact), at: Point) {
        let forces = parts.map(|k| self.states.contacts.get(k).and_then(|state| state.forces));
        let ([Some(along_n), Some(along_z)], Some(scale)) = (forces, self.options.force_scale) else {
            return;
        };
        let force = Vector2::new(along_n.normal, along_z.normal);
        if force.norm() == 0.0 {
            return;
        }
        let name = contact.name.rsplit_once('.').map_or(&*contact.name, |(_, end)| end);
        let text = format!("{name} {}", self.shown(force.norm(), "N"));
        let towards = direction(force / force.norm());
        let from = (at + towards * ROD, false);
        self.arrow_of_force(Class::Reaction, from, towards * (force.norm() * scale), text);
    }

    /// The normal force of a contact on the block.
    fn force_in_section(&mut self, section: &Section<'_>, (k, contact): (usize, &Contact), at: Point) {
        let Some(state) = self.states.contacts.get(k).copied() else { return };
        let name = contact.name.rsplit_once('.').map_or(&*contact.name, |(_, end)| end).to_owned();
        let [cos, sin] = contact.normal_across();
        let normal = direction(Vector2::new(cos, sin));
        if let Some(acceleration) = state.gap_acceleration {
            self.circle(Class::Opening, at, 4.0);
            let text = format!("{name} lifts off, {}", self.shown(acceleration, "m/s^2"));
            return self.value_along(Class::Opening, text, [at, at], -normal);
        }
        let (Some(forces), Some(scale)) = (state.forces, self.options.force_scale) else { return };
        if forces.normal == 0.0 {
            return;
        }
        let across = Point::new(-normal.y, normal.x);
        let aside = if contact.offset < 0.0 { across * ASIDE } else { Point::zeros() };
        let text = format!("{name} {}", self.shown(forces.normal.abs(), "N"));
        let arrow = normal * (forces.normal * scale);
        let reach = section.reach(contact);
        let face = if reach > GAP { reach * section.pressing_side() * forces.normal.signum() } else { 0.0 };
        let at = at + normal * face;
        self.arrow_of_force(Class::Reaction, (at + aside, !section.slider.around), arrow, text);
    }

    /// Loads, drives and weight on the block.
    fn loads_in_section(&self, section: &Section<'_>) -> Vec<Load> {
        let (mechanism, block) = (self.mechanism, section.slider.block);
        let load =
            |name: &str, (place, z): (Vector2<f64>, f64), (force, along_z): (Vector2<f64>, f64)| Load {
                name: name.to_owned(),
                place: section.place(place, z),
                across: Vector2::new(force.dot(&section.normal()), along_z),
                along: force.dot(&section.tangent),
            };
        let mut loads = Vec::new();
        for one in mechanism.loads.iter().filter(|one| matches!(one.kind, LoadKind::Force { .. })) {
            let wrenches = load_wrenches(mechanism, self.configuration, one).unwrap_or_default();
            for wrench in wrenches.iter().filter(|wrench| wrench.frame == block) {
                loads.push(load(&one.name, (wrench.place, wrench.z), (wrench.force, wrench.along_z)));
            }
        }
        for (drive, effort) in mechanism.drives.iter().zip(&self.states.efforts) {
            let Effort::Force { at, direction, turns, .. } = drive.effort else { continue };
            if at.frame == block {
                let direction =
                    if turns { self.configuration.direction(at.frame, direction) } else { direction };
                let place = (self.configuration.position(mechanism, &at), at.z);
                loads.push(load(&drive.name, place, (direction * *effort, 0.0)));
            }
        }
        if let (Some(body), Some(space)) = (block.body(), &mechanism.space) {
            let mass = mechanism.bodies[body.index()].mass;
            let place = (self.centre_of(body), space.bodies[body.index()].z);
            let weight = load("weight", place, (mechanism.gravity * mass, space.gravity * mass));
            if weight.across.norm() > 0.0 || weight.along != 0.0 {
                loads.push(weight);
            }
        }
        loads
    }

    /// The directions of n and z, below on the left.
    fn axes_of_section(&mut self) {
        let Some(bounds) = self.scene.bounds() else { return };
        let corner = Point::new(bounds.least.x - 2.0 * AXIS, bounds.greatest.y);
        for (name, along, beside) in [
            ("n", Point::new(AXIS, 0.0), Point::new(8.0, 4.0)),
            ("z", Point::new(0.0, -AXIS), Point::new(0.0, -8.0)),
        ] {
            self.scene.add(Class::Dimension, Shape::Arrow { from: corner, to: corner + along });
            let at = corner + along + beside;
            let text = Text { text: name.to_owned(), at, anchor: Anchor::Middle, size: VALUE_SIZE };
            self.scene.write(Class::Dimension, text);
        }
    }
}
