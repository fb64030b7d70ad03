//! Loads and drives of a drawing.

use super::quantity::{self, Quantity};
use super::{Drawing, Frame};
use crate::ids::DriveId;

/// A force of a [`Drawing`].
#[derive(Debug)]
pub struct ForceBuilder<'d> {
    drawing: &'d mut Drawing,
    index: usize,
    name: String,
    body: Frame,
}

impl<'d> ForceBuilder<'d> {
    pub(super) fn new(drawing: &'d mut Drawing, name: &str, body: Frame) -> Self {
        let index = drawing.loads.add(name);
        Self { drawing, index, name: name.to_owned(), body }.set("type", quantity::text("force"))
    }

    fn set(self, key: &str, value: Quantity) -> Self {
        self.drawing.loads.table(self.index).set(key, value);
        self
    }

    /// Where it acts, as a place of the drawing that moves with the body (m).
    pub fn at(self, place: [impl Into<Quantity>; 2]) -> Self {
        let point = self.drawing.point(self.body, &self.name, quantity::pair(place));
        self.set("at", quantity::text(&point))
    }

    /// Its components (N).
    pub fn components(self, components: [impl Into<Quantity>; 2]) -> Self {
        self.set("components", quantity::pair(components))
    }

    /// Its magnitude (N), along a [`direction`](Self::direction).
    pub fn magnitude(self, magnitude: impl Into<Quantity>) -> Self {
        self.set("magnitude", magnitude.into())
    }

    /// Its direction: the angle from the x axis (rad).
    pub fn direction(self, angle: impl Into<Quantity>) -> Self {
        self.set("direction", angle.into())
    }

    /// It turns with the body. Default: its direction is fixed in space.
    pub fn turning(self) -> Self {
        self.set("frame", quantity::text("body"))
    }

    /// The opposite force acts on this body at the same place. Default: on none.
    pub fn reaction(self, body: impl Into<Frame>) -> Self {
        let body = self.drawing.frame(body.into());
        self.set("reaction", body)
    }
}

/// A load of a [`Drawing`] other than a force.
#[derive(Debug)]
pub struct LoadBuilder<'d> {
    drawing: &'d mut Drawing,
    index: usize,
}

impl<'d> LoadBuilder<'d> {
    pub(super) fn new(drawing: &'d mut Drawing, name: &str, kind: &str) -> Self {
        let index = drawing.loads.add(name);
        Self { drawing, index }.set("type", quantity::text(kind))
    }

    pub(super) fn set(self, key: &str, value: Quantity) -> Self {
        self.drawing.loads.table(self.index).set(key, value);
        self
    }

    /// The length at which a spring has no force (m).
    pub fn free_length(self, length: impl Into<Quantity>) -> Self {
        self.set("free_length", length.into())
    }

    /// The rotation of the first body against the second at which a torsional spring has no torque, from the
    /// drawing (rad).
    pub fn free_angle(self, angle: impl Into<Quantity>) -> Self {
        self.set("free_angle", angle.into())
    }

    /// The opposite torque acts on this body. Default: on none.
    pub fn reaction(self, body: impl Into<Frame>) -> Self {
        let body = self.drawing.frame(body.into());
        self.set("reaction", body)
    }
}

/// A drive of a [`Drawing`]: a prescribed motion, and the unknown force or torque that produces it.
#[derive(Debug)]
pub struct DriveBuilder<'d> {
    drawing: &'d mut Drawing,
    id: DriveId,
    /// "force" or "torque".
    effort: &'static str,
}

impl<'d> DriveBuilder<'d> {
    pub(super) fn new(drawing: &'d mut Drawing, id: DriveId, effort: &'static str) -> Self {
        Self { drawing, id, effort }
    }

    /// Sets a key in the table of the force or torque.
    pub(super) fn set(self, key: &str, value: Quantity) -> Self {
        self.drawing.drives.table(self.id.index()).inner(self.effort).set(key, value);
        self
    }

    /// The prescribed acceleration of the coordinate. Default: 0.
    pub fn acceleration(self, acceleration: impl Into<Quantity>) -> Self {
        self.drawing.drives.table(self.id.index()).set("acceleration", acceleration.into());
        self
    }

    /// The direction of the force turns with the body. Default: it is fixed in space.
    pub fn turning(self) -> Self {
        self.set("frame", quantity::text("body"))
    }

    /// The opposite force or torque acts on this body. Default: on none.
    pub fn reaction(self, body: impl Into<Frame>) -> Self {
        let body = self.drawing.frame(body.into());
        self.set("reaction", body)
    }

    /// The handle.
    pub fn id(self) -> DriveId {
        self.id
    }
}
