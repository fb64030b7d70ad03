//! Reference cases of `reference/hinges.toml` as models: drawn in their state.

use nalgebra::{Rotation2, Vector2};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use slideway::Model;
use std::fmt::Write as _;
use std::path::Path;

#[derive(Deserialize)]
struct File {
    case: Vec<Case>,
}

#[derive(Deserialize)]
pub(crate) struct Case {
    pub(crate) name: String,
    gravity: [f64; 2],
    bodies: Vec<Body>,
    pub(crate) hinges: Vec<Hinge>,
    #[serde(default)]
    contacts: Vec<Contact>,
    #[serde(default)]
    forces: Vec<Force>,
    drive: Option<Drive>,
    /// Absent of cases at rest.
    pub(crate) count: Option<usize>,
    #[serde(default)]
    pub(crate) solution: Vec<Solution>,
}

#[derive(Deserialize)]
struct Body {
    name: String,
    m: f64,
    #[serde(rename = "J")]
    inertia: f64,
    pose: [f64; 3],
    vel: [f64; 3],
}

#[derive(Deserialize)]
pub(crate) struct Hinge {
    a: String,
    pa: [f64; 2],
    b: String,
    pb: [f64; 2],
    pub(crate) r: f64,
}

#[derive(Deserialize)]
struct Contact {
    guide: String,
    angle: f64,
    block: String,
    #[serde(rename = "P")]
    point: [f64; 2],
    half_height: f64,
    mu: f64,
}

#[derive(Deserialize)]
struct Force {
    body: String,
    at: [f64; 2],
    #[serde(rename = "F")]
    components: [f64; 2],
    torque: f64,
}

#[derive(Deserialize)]
struct Drive {
    body: String,
    angular_acceleration: f64,
}

/// Forces of hinges act on b, its second body.
#[derive(Deserialize)]
pub(crate) struct Solution {
    pub(crate) sides: Vec<i32>,
    #[serde(rename = "N")]
    pub(crate) normal: Vec<f64>,
    #[serde(rename = "R")]
    pub(crate) hinge: Vec<[f64; 2]>,
    pub(crate) acceleration: Vec<f64>,
    #[serde(rename = "det_I_minus_HD")]
    pub(crate) determinant: f64,
    pub(crate) drive_torque: Option<f64>,
}

/// From where a case is looked at.
pub(crate) struct View {
    pub(crate) turn: f64,
    pub(crate) mirror: bool,
}

impl View {
    fn sense(&self) -> f64 {
        if self.mirror { -1.0 } else { 1.0 }
    }

    fn of(&self, vector: Vector2<f64>) -> Vector2<f64> {
        Rotation2::new(self.turn) * Vector2::new(vector.x, self.sense() * vector.y)
    }
}

/// What a type takes of the reference.
pub(crate) fn reference<T: DeserializeOwned>() -> T {
    read("hinges.toml")
}

/// What a type takes of a file of references.
pub(crate) fn read<T: DeserializeOwned>(name: &str) -> T {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../reference").join(name);
    toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The cases in motion.
pub(crate) fn moving() -> Vec<Case> {
    let cases: Vec<Case> = reference::<File>().case.into_iter().filter(|case| case.count.is_some()).collect();
    assert!(cases.len() >= 8, "the reference is gone");
    cases
}

impl Case {
    /// The friction radius of every hinge is multiplied by a factor.
    pub(crate) fn model(&self, factor: f64) -> Model {
        self.seen(factor, &View { turn: 0.0, mirror: false })
    }

    /// The same turned by an angle, and before that in the mirror image, `y` to `-y`.
    pub(crate) fn seen(&self, factor: f64, view: &View) -> Model {
        Model::parse(&self.text(factor, view)).unwrap_or_else(|faults| panic!("{}: {faults:?}", self.name))
    }

    /// The radius of the only friction circle is the parameter `r`.
    pub(crate) fn over_radius(&self, view: &View) -> Model {
        Model::parse(&self.with_radius(view)).unwrap()
    }

    /// The same where the formula of the gravity has the radius, too, and its value does not change.
    pub(crate) fn over_radius_and_load(&self) -> Model {
        let text = self.with_radius(&View { turn: 0.0, mirror: false });
        let [x, y] = self.gravity;
        let given = format!("gravity = [{x:?}, {y:?}]");
        assert!(text.contains(&given));
        Model::parse(&text.replacen(&given, &format!("gravity = [\"{x:?} + (r*r - r^2)\", {y:?}]"), 1))
            .unwrap()
    }

    fn with_radius(&self, view: &View) -> String {
        let [hinge] = self.hinges.as_slice() else { panic!("{} has several hinges", self.name) };
        let given = format!("friction_radius = {:?}", hinge.r);
        let text = self.text(1.0, view).replacen(&given, "friction_radius = \"r\"", 1);
        format!("{text}[parameters]\nr = {:?}\n", hinge.r)
    }

    fn text(&self, factor: f64, view: &View) -> String {
        let gravity = view.of(self.gravity.into());
        let mut text = format!("gravity = [{:?}, {:?}]\n", gravity.x, gravity.y);
        let mut points = String::from("[points]\n");
        let mut owned: Vec<Vec<String>> = vec![Vec::new(); self.bodies.len()];
        let mut point = |name: String, body: &str, at: [f64; 2]| {
            let place = view.of(self.world(body, at));
            writeln!(points, "{name} = [{:?}, {:?}]", place.x, place.y).unwrap();
            if let Some(index) = self.bodies.iter().position(|other| other.name == body) {
                owned[index].push(format!("{name:?}"));
            }
            format!("{body}.{name}")
        };
        let mut joints = String::new();
        for (index, hinge) in self.hinges.iter().enumerate() {
            let ends = [
                point(format!("b{index}"), &hinge.b, hinge.pb),
                point(format!("a{index}"), &hinge.a, hinge.pa),
            ];
            let radius = hinge.r * factor;
            writeln!(
                joints,
                "[joints.hinge{index}]\ntype = \"hinge\"\nbetween = {ends:?}\nfriction_radius = {radius:?}"
            )
            .unwrap();
        }
        self.write_sliders(&mut joints, view);
        let mut loads = String::new();
        for (index, Force { body, at, components, torque }) in self.forces.iter().enumerate() {
            let at = point(format!("f{index}"), body, *at);
            let components: [f64; 2] = view.of((*components).into()).into();
            let torque = view.sense() * torque;
            writeln!(
                loads,
                "[loads.force{index}]\ntype = \"force\"\nat = {at:?}\ncomponents = {components:?}"
            )
            .unwrap();
            writeln!(loads, "[loads.torque{index}]\ntype = \"torque\"\nbody = {body:?}\nmoment = {torque:?}")
                .unwrap();
        }
        text += &points;
        for (body, owned) in self.bodies.iter().zip(owned) {
            let [x, y]: [f64; 2] = view.of(Vector2::new(body.pose[0], body.pose[1])).into();
            let inertia = if body.m == 0.0 {
                "massless = true".to_owned()
            } else {
                format!(
                    "mass = {:?}\nmoment_of_inertia = {:?}\ncentre_of_mass = [{x:?}, {y:?}]",
                    body.m, body.inertia
                )
            };
            writeln!(text, "[bodies.{}]\npoints = [{}]\n{inertia}", body.name, owned.join(", ")).unwrap();
        }
        text += &joints;
        text += &loads;
        let Body { name, vel, .. } = &self.bodies[0];
        writeln!(text, "[coordinates.phi]\nrotation = {name:?}\nrate = {:?}", view.sense() * vel[2]).unwrap();
        if let Some(Drive { body, angular_acceleration }) = &self.drive {
            writeln!(
                text,
                "[drives.motor]\ncoordinate = \"phi\"\nacceleration = {angular_acceleration:?}\ntorque = {{ body = {body:?} }}"
            )
            .unwrap();
        }
        text
    }

    pub(crate) fn contacts(&self) -> usize {
        self.contacts.len()
    }

    /// A contact by itself is a pin in a slot, two of one block are a block slider.
    fn write_sliders(&self, joints: &mut String, view: &View) {
        let mut index = 0;
        while let Some(contact) = self.contacts.get(index) {
            let partner = self.contacts.get(index + 1).filter(|other| other.block == contact.block);
            let first = view.of(self.world(&contact.block, contact.point));
            let last = partner.map_or(first, |other| view.of(self.world(&other.block, other.point)));
            let (at, length) = ((first + last) / 2.0, (first - last).norm());
            let Contact { guide, block, half_height, mu, .. } = contact;
            let angle = view.turn + view.sense() * contact.angle;
            writeln!(
                joints,
                "[joints.slider{index}]\nblock = {block:?}\nguide = {guide:?}\nat = [{:?}, {:?}]\nalong = {angle:?}\nmu = {mu:?}",
                at.x, at.y
            )
            .unwrap();
            if partner.is_some() {
                writeln!(
                    joints,
                    "type = \"block_slider\"\nlength = {length:?}\nheight = {:?}",
                    2.0 * half_height
                )
                .unwrap();
            } else {
                joints.push_str("type = \"pin_in_slot\"\n");
            }
            index += 1 + usize::from(partner.is_some());
        }
    }

    fn world(&self, body: &str, [x, y]: [f64; 2]) -> Vector2<f64> {
        let pose = self.bodies.iter().find(|other| other.name == body).map_or([0.0; 3], |body| body.pose);
        Vector2::new(pose[0], pose[1]) + Rotation2::new(pose[2]) * Vector2::new(x, y)
    }
}
