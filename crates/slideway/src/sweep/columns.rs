//! The columns of a sweep.

use super::axis::Axis;
use crate::ids::{BodyId, ContactId, DriveId, JointId};
use crate::kinetics::{Layout, Reaction};
use crate::mechanism::{Effort, JointKind, Mechanism};
use crate::model::{Model, SliderKind};

/// A column of numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Its name: that of a varied quantity, or `normal_force.CONTACT`, `friction_force.CONTACT`,
    /// `preload_share.CONTACT`, `couple.JOINT`, `acceleration.COORDINATE`, `effort.DRIVE` and the like. With
    /// friction in hinges `number_in_mode` counts the solutions of each mode of a point.
    pub name: String,
    /// Its unit, "SI" where it depends on a parameter.
    pub unit: &'static str,
}

/// Output of a row besides normal forces, friction and shares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Output {
    /// Acceleration of a chosen coordinate.
    Coordinate(usize),
    /// One of the unknowns, with a sign.
    Unknown(usize, f64),
    /// Acceleration of the gap of a contact that may lift off.
    Gap(usize),
    /// A number that is no unknown: the friction couple of a hinge, a number within a mode.
    Other,
}

/// Columns of a hinge with friction: three outputs, its force and its friction couple.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HingeColumns {
    pub(super) joint: JointId,
    /// Its friction circle among those of the mechanism.
    pub(super) circle: usize,
    /// The place of the first among the outputs.
    pub(super) output: usize,
    /// 1 if they are those on the first body, -1 if they are those on the second.
    pub(super) sign: f64,
}

/// The couple of a guided slider among the numbers of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CoupleColumn {
    pub(super) joint: JointId,
    pub(super) contact: usize,
    /// Its place among the outputs.
    pub(super) output: usize,
}

/// The numbers of a row, in their order.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Columns {
    pub(super) varied: usize,
    pub(super) contacts: usize,
    /// Contacts that have a column for the share of their preload.
    pub(super) shares: Vec<usize>,
    /// Those of guided sliders.
    pub(super) couples: Vec<CoupleColumn>,
    /// Hinges with friction.
    pub(super) hinges: Vec<HingeColumns>,
    pub(super) outputs: Vec<Output>,
    pub(super) list: Vec<Column>,
    /// Whether bodies and hinges have columns.
    pub(super) all: bool,
}

/// Names of the columns that are no numbers of a state: a varied quantity of such a name bears the prefix
/// `vary.`.
const RESERVED: [&str; 10] = [
    "point",
    "breakpoint",
    "status",
    "solutions",
    "gap_states",
    "rejected",
    "kind",
    "branch",
    "determinant_sign",
    "pattern",
];

impl Columns {
    /// The columns of a mechanism; accelerations of bodies and hinge forces only if `all` is asked for.
    pub(super) fn new(model: &Model, mechanism: &Mechanism, axes: &[Axis], all: bool) -> Self {
        let contacts = mechanism.contacts.len();
        let mut columns = Self {
            varied: axes.len(),
            contacts,
            shares: Vec::new(),
            couples: Vec::new(),
            hinges: Vec::new(),
            outputs: Vec::new(),
            list: Vec::new(),
            all,
        };
        for axis in axes {
            let name = &axis.quantity.name;
            let name = if RESERVED.contains(&name.as_str()) || name == "attainability" {
                format!("vary.{name}")
            } else {
                name.clone()
            };
            columns.add(name, axis.quantity.unit(model));
        }
        for contact in &mechanism.contacts {
            columns.add(format!("normal_force.{}", contact.name), "N");
        }
        for contact in &mechanism.contacts {
            columns.add(format!("friction_force.{}", contact.name), "N");
        }
        columns.add_shares(model, mechanism);
        columns.add_outputs(mechanism, all);
        columns
    }

    fn add(&mut self, name: String, unit: &'static str) {
        self.list.push(Column { name, unit });
    }

    /// Contacts that the model gives a preload, be it zero now.
    fn add_shares(&mut self, model: &Model, mechanism: &Mechanism) {
        let sliders = model.joints.iter().filter_map(|joint| match &joint.kind {
            crate::model::JointKind::Slider(slider) => Some(slider),
            crate::model::JointKind::Hinge(_) => None,
        });
        let contacts = sliders.flat_map(|slider| &slider.contacts).enumerate();
        for (index, _) in contacts.filter(|(_, contact)| contact.preload.iter().any(Option::is_some)) {
            self.shares.push(index);
            self.add(format!("preload_share.{}", mechanism.contacts[index].name), "1");
        }
    }

    /// Whether the preload of a guided slider is another one on its other side: the slider may be between its
    /// faces.
    pub(super) fn may_be_between_faces(&self, mechanism: &Mechanism) -> bool {
        self.couples.iter().any(|couple| mechanism.preload_jumps(ContactId(couple.contact)))
    }

    fn add_outputs(&mut self, mechanism: &Mechanism, all: bool) {
        let layout = Layout::of(mechanism);
        for (index, joint) in mechanism.joints.iter().enumerate() {
            let id = JointId(index);
            let JointKind::Slider(slider) = &joint.kind else { continue };
            if let (SliderKind::Guided, Some(place), Some(contact)) =
                (slider.kind, layout.reaction(Reaction::Couple(id)), slider.contacts.first())
            {
                let (contact, output) = (contact.index(), self.outputs.len());
                self.couples.push(CoupleColumn { joint: id, contact, output });
                self.output(Output::Unknown(place, 1.0), format!("couple.{}", joint.name), "N m");
            }
        }
        for (index, coordinate) in mechanism.coordinates.iter().enumerate() {
            let unit = if coordinate.kind.is_angle() { "rad/s^2" } else { "m/s^2" };
            self.output(Output::Coordinate(index), format!("acceleration.{}", coordinate.name), unit);
        }
        for (index, drive) in mechanism.drives.iter().enumerate() {
            let unit = if matches!(drive.effort, Effort::Force { .. }) { "N" } else { "N m" };
            let place = layout.effort(DriveId(index));
            self.output(Output::Unknown(place, 1.0), format!("effort.{}", drive.name), unit);
        }
        for contact in mechanism.one_sided() {
            let name = &mechanism.contacts[contact.index()].name;
            self.output(Output::Gap(contact.index()), format!("gap_acceleration.{name}"), "m/s^2");
        }
        let rough = |index: usize| {
            let mut circles = mechanism.friction_circles.iter();
            circles.any(|circle| circle.joint.index() == index)
        };
        for index in (0..mechanism.joints.len()).filter(|&index| rough(index)) {
            self.add_hinge(mechanism, &layout, index);
        }
        if all {
            self.add_bodies(mechanism, &layout);
            for index in (0..mechanism.joints.len()).filter(|&index| !rough(index)) {
                self.add_hinge(mechanism, &layout, index);
            }
        }
        if !self.hinges.is_empty() {
            self.output(Output::Other, "number_in_mode".to_owned(), "1");
        }
    }

    /// The places of the forces of hinges with friction in a row: with the normal forces they tell solutions apart.
    pub(super) fn hinge_forces(&self) -> Vec<usize> {
        let first = self.list.len() - self.outputs.len();
        self.hinges.iter().flat_map(|hinge| [0, 1].map(|axis| first + hinge.output + axis)).collect()
    }

    fn add_bodies(&mut self, mechanism: &Mechanism, layout: &Layout) {
        let parts =
            [("acceleration_x", "m/s^2"), ("acceleration_y", "m/s^2"), ("angular_acceleration", "rad/s^2")];
        for (index, body) in mechanism.bodies.iter().enumerate() {
            let first = layout.acceleration(BodyId(index));
            for (part, (word, unit)) in parts.into_iter().enumerate() {
                self.output(Output::Unknown(first + part, 1.0), format!("{word}.{}", body.name), unit);
            }
        }
    }

    /// As in the report of `solve`: forces on the first body, or on the second if the first is ground; of a hinge with
    /// friction its couple, too.
    fn add_hinge(&mut self, mechanism: &Mechanism, layout: &Layout, index: usize) {
        let (id, joint) = (JointId(index), &mechanism.joints[index]);
        let JointKind::Hinge(ends) = &joint.kind else { return };
        let sign = if ends[0].frame.body().is_some() { 1.0 } else { -1.0 };
        let output = self.outputs.len();
        for (axis, word) in ["hinge_force_x", "hinge_force_y"].into_iter().enumerate() {
            if let Some(place) = layout.reaction(Reaction::Hinge(id, axis)) {
                self.output(Output::Unknown(place, sign), format!("{word}.{}", joint.name), "N");
            }
        }
        if let Some(circle) = mechanism.circle_of(id) {
            self.hinges.push(HingeColumns { joint: id, circle, output, sign });
            self.output(Output::Other, format!("friction_couple.{}", joint.name), "N m");
        }
        if mechanism.collar_of(id).is_some()
            && let Some(place) = layout.reaction(Reaction::Carried(id, 0))
        {
            self.output(Output::Unknown(place, sign), format!("force_z.{}", joint.name), "N");
        }
    }

    fn output(&mut self, output: Output, name: String, unit: &'static str) {
        self.outputs.push(output);
        self.add(name, unit);
    }

    /// Numbers in a row.
    pub(super) fn width(&self) -> usize {
        self.list.len()
    }
}
