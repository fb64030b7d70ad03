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
    /// `preload_share.CONTACT`, `couple.JOINT`, `acceleration.COORDINATE`, `effort.DRIVE` and the like.
    pub name: String,
    /// Its unit, "SI" where it depends on a parameter.
    pub unit: &'static str,
}

/// What of the unknowns is told besides normal forces, friction and shares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Output {
    /// Acceleration of a chosen coordinate.
    Coordinate(usize),
    /// One of the unknowns, with a sign.
    Unknown(usize, f64),
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
        if all {
            self.add_bodies(mechanism, &layout);
            self.add_hinges(mechanism, &layout);
        }
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

    /// As in the report of `solve`: forces on the first body, or on the second if the first is ground.
    fn add_hinges(&mut self, mechanism: &Mechanism, layout: &Layout) {
        for (index, joint) in mechanism.joints.iter().enumerate() {
            let JointKind::Hinge(ends) = &joint.kind else { continue };
            let sign = if ends[0].frame.body().is_some() { 1.0 } else { -1.0 };
            for (axis, word) in ["hinge_force_x", "hinge_force_y"].into_iter().enumerate() {
                if let Some(place) = layout.reaction(Reaction::Hinge(JointId(index), axis)) {
                    self.output(Output::Unknown(place, sign), format!("{word}.{}", joint.name), "N");
                }
            }
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
