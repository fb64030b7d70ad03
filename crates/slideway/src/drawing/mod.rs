//! Mechanisms in code: what a model file says, with typed handles in place of names.
//!
//! A [`Drawing`] collects bodies, joints, loads and coordinates in the order in which they are added, and
//! becomes a [`Model`] by the way of every model file. So it has the same defaults, the same meaning and the
//! same faults, and [`Drawing::to_toml`] is its file. Numbers are in SI units; a text may hold a unit or an
//! expression of parameters.
//!
//! ```
//! use slideway::{Drawing, GROUND, solve};
//!
//! let mut d = Drawing::new();
//! let drawer = d.body("drawer").mass(2.0).centre([0.0, 0.1]).inertia(0.05).id();
//! let rail = d.block_slider("rail", drawer, GROUND).at([0.0, 0.0]).length(0.4).mu(0.3).id();
//! d.force("push", drawer).at([-0.2, 0.15]).components([20.0, 0.0]);
//! d.slide("x", rail).rate(1.0);
//! let answer = solve(&d.build()?)?;
//! // Moments about the middle of the rail, with N_f + N_r = 0: the push has the lever 0.15 m, inertia 0.1 m.
//! for solution in &answer.solutions {
//!     let front = solution.contact(rail.front()).normal_force;
//!     let friction = 0.3 * 2.0 * front.abs();
//!     assert!((front * 0.4 - (20.0 * 0.15 - 0.1 * (20.0 - friction))).abs() < 1e-12);
//! }
//! assert_eq!(answer.solutions.len(), 1);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```

#![expect(
    clippy::return_self_not_must_use,
    reason = "what is said is written at once, and a handle is not always needed"
)]

mod entry;
mod joint;
mod load;
mod quantity;

pub use joint::{
    BetweenFaces, BlockOnFace, BlockSlider, ContactBuilder, CornerOnFace, DiscOnDisc, DiscOnFace,
    GuidedSlider, HasLength, HingeBuilder, MayLiftOff, OnLine, OneContact, PinInSlot, Slider, SliderBuilder,
    SliderKind, TwoContacts, kind,
};
pub use load::{DriveBuilder, ForceBuilder, LoadBuilder};
pub use quantity::Quantity;

use crate::fault::Faults;
use crate::ids::{BodyId, CoordinateId, DriveId, Frame, JointId};
use crate::model::Model;
pub(crate) use entry::written_key;
use entry::{Entries, Table, line};
use serde::{Deserialize, Serialize};

/// The fixed frame, where a body is expected.
pub const GROUND: Frame = Frame::Ground;

/// A text in quotation marks, as a model file has it.
pub(crate) fn quoted(value: &str) -> String {
    quantity::text(value).written().to_owned()
}

/// A mechanism that is being put together. See the [module](self) for an example.
///
/// Serialized, it keeps the order in which things were added, so that handles stay valid; the layout is this version's.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Drawing {
    /// Title, gravity, time.
    head: Table,
    parameters: Table,
    points: Table,
    bodies: Entries,
    /// The points of each body.
    owned: Vec<Vec<String>>,
    joints: Entries,
    loads: Entries,
    drives: Entries,
    coordinates: Entries,
    contacts: usize,
}

/// Declares the methods that begin a sliding joint along a line between two bodies.
macro_rules! sliding_joints {
    ($($(#[$about:meta])* $name:ident($block:ident, $guide:ident): $kind:ident;)+) => {
        $(
            $(#[$about])*
            pub fn $name(
                &mut self,
                name: &str,
                $block: impl Into<Frame>,
                $guide: impl Into<Frame>,
            ) -> SliderBuilder<'_, kind::$kind> {
                SliderBuilder::new(self, name, [$block.into(), $guide.into()])
            }
        )+
    };
}

impl Drawing {
    /// An empty drawing.
    pub fn new() -> Self {
        Self::default()
    }

    /// One line that says what the mechanism is.
    pub fn title(&mut self, title: &str) -> &mut Self {
        self.head.set("title", quantity::text(title));
        self
    }

    /// Acceleration of free fall along -y (m/s^2). Default: none.
    pub fn gravity(&mut self, magnitude: impl Into<Quantity>) -> &mut Self {
        self.head.set("gravity", magnitude.into());
        self
    }

    /// Components of the acceleration of free fall (m/s^2).
    pub fn gravity_components(&mut self, components: [impl Into<Quantity>; 2]) -> &mut Self {
        self.head.set("gravity", quantity::pair(components));
        self
    }

    /// Time of the state, `t` in expressions (s). Default: 0.
    pub fn time(&mut self, time: impl Into<Quantity>) -> &mut Self {
        self.head.set("time", time.into());
        self
    }

    /// A named number, for expressions and for [`Settings`](crate::model::Settings).
    pub fn parameter(&mut self, name: &str, value: impl Into<Quantity>) -> &mut Self {
        self.parameters.add(name, value.into());
        self
    }

    /// A rigid body.
    pub fn body(&mut self, name: &str) -> BodyBuilder<'_> {
        self.owned.push(Vec::new());
        let id = BodyId(self.bodies.add(name));
        BodyBuilder { drawing: self, id }
    }

    /// A hinge between two bodies, or a body and [`GROUND`]. The hinge force is counted on the
    /// first body.
    pub fn hinge(
        &mut self,
        name: &str,
        first: impl Into<Frame>,
        second: impl Into<Frame>,
    ) -> HingeBuilder<'_> {
        HingeBuilder::new(self, name, [first.into(), second.into()])
    }

    sliding_joints! {
        /// A carriage, sledge or bushing with a contact at each end.
        block_slider(block, guide): Block;
        /// A slider pressed on one side along its whole length: one normal force and a couple.
        guided_slider(block, guide): Guided;
        /// A corner of the first body on a straight face of the second, which it may leave.
        corner_on_face(block, guide): Corner;
        /// A disc of the first body on a straight face of the second, which it may leave.
        disc_on_face(disc, guide): Disc;
        /// A block on a straight face of the second body, which both of its corners may leave.
        block_on_face(block, guide): OnFace;
        /// A pin of the first body in a slot of the second: one contact.
        pin_in_slot(pin, slot): Pin;
    }

    /// A disc of the first body on a disc of the second, or in a hole of it, which it may leave.
    pub fn disc_on_disc(
        &mut self,
        name: &str,
        disc: impl Into<Frame>,
        other: impl Into<Frame>,
    ) -> SliderBuilder<'_, kind::Discs> {
        SliderBuilder::of_discs(self, name, [disc.into(), other.into()])
    }

    /// A force on a body.
    pub fn force(&mut self, name: &str, body: impl Into<Frame>) -> ForceBuilder<'_> {
        ForceBuilder::new(self, name, body.into())
    }

    /// A torque on a body, counter-clockwise positive (N m).
    pub fn torque(
        &mut self,
        name: &str,
        body: impl Into<Frame>,
        moment: impl Into<Quantity>,
    ) -> LoadBuilder<'_> {
        let body = self.frame(body.into());
        LoadBuilder::new(self, name, "torque").set("body", body).set("moment", moment.into())
    }

    /// A linear spring between places of two bodies in the drawing, with its stiffness (N/m). Without force
    /// at its length in the drawing unless [`LoadBuilder::free_length`] says another.
    pub fn spring<P: Into<Quantity>>(
        &mut self,
        name: &str,
        ends: [(Frame, [P; 2]); 2],
        stiffness: impl Into<Quantity>,
    ) -> LoadBuilder<'_> {
        let ends = self.ends(name, ends);
        LoadBuilder::new(self, name, "spring").set("between", ends).set("stiffness", stiffness.into())
    }

    /// A linear damper between places of two bodies in the drawing, with its coefficient (N s/m).
    pub fn damper<P: Into<Quantity>>(
        &mut self,
        name: &str,
        ends: [(Frame, [P; 2]); 2],
        damping: impl Into<Quantity>,
    ) -> LoadBuilder<'_> {
        let ends = self.ends(name, ends);
        LoadBuilder::new(self, name, "damper").set("between", ends).set("damping", damping.into())
    }

    /// A torsional spring between two bodies (N m per rad), without torque in the drawing.
    pub fn torsional_spring(
        &mut self,
        name: &str,
        between: [Frame; 2],
        stiffness: impl Into<Quantity>,
    ) -> LoadBuilder<'_> {
        let between = quantity::list(between.map(|frame| self.frame(frame)));
        LoadBuilder::new(self, name, "torsional_spring")
            .set("between", between)
            .set("stiffness", stiffness.into())
    }

    /// A torsional damper between two bodies (N m s per rad).
    pub fn torsional_damper(
        &mut self,
        name: &str,
        between: [Frame; 2],
        damping: impl Into<Quantity>,
    ) -> LoadBuilder<'_> {
        let between = quantity::list(between.map(|frame| self.frame(frame)));
        LoadBuilder::new(self, name, "torsional_damper")
            .set("between", between)
            .set("damping", damping.into())
    }

    /// The displacement of a block against its guide as a chosen coordinate (m).
    pub fn slide(&mut self, name: &str, slider: impl Into<JointId>) -> CoordinateBuilder<'_> {
        let joint = self.joints.name(slider.into().index());
        self.coordinate(name, "slide", joint)
    }

    /// The rotation of a body as a chosen coordinate (rad).
    pub fn rotation(&mut self, name: &str, body: impl Into<Frame>) -> CoordinateBuilder<'_> {
        let body = self.frame(body.into());
        self.coordinate(name, "rotation", body)
    }

    fn coordinate(&mut self, name: &str, what: &str, of: Quantity) -> CoordinateBuilder<'_> {
        let id = CoordinateId(self.coordinates.add(name));
        self.coordinates.table(id.index()).set(what, of);
        CoordinateBuilder { drawing: self, id }
    }

    /// A prescribed motion of a coordinate by an unknown force on a body, at a place of the drawing (m), in a
    /// direction that is given by the angle from the x axis (rad).
    pub fn drive_by_force<P: Into<Quantity>>(
        &mut self,
        name: &str,
        coordinate: CoordinateId,
        (body, at, direction): (impl Into<Frame>, [P; 2], impl Into<Quantity>),
    ) -> DriveBuilder<'_> {
        let id = self.drive(name, coordinate);
        let at = self.point(body.into(), name, quantity::pair(at));
        DriveBuilder::new(self, id, "force").set("at", quantity::text(&at)).set("direction", direction.into())
    }

    /// A prescribed motion of a coordinate by an unknown torque on a body.
    pub fn drive_by_torque(
        &mut self,
        name: &str,
        coordinate: CoordinateId,
        body: impl Into<Frame>,
    ) -> DriveBuilder<'_> {
        let id = self.drive(name, coordinate);
        let body = self.frame(body.into());
        DriveBuilder::new(self, id, "torque").set("body", body)
    }

    fn drive(&mut self, name: &str, coordinate: CoordinateId) -> DriveId {
        let id = DriveId(self.drives.add(name));
        let coordinate = self.coordinates.name(coordinate.index());
        self.drives.table(id.index()).set("coordinate", coordinate);
        id
    }

    /// The model.
    ///
    /// # Errors
    /// Everything that is wrong with it, as [`Model::parse`] would say of its file,
    /// [`to_toml`](Self::to_toml): names that are no names or are used twice, missing values, wrong
    /// dimensions.
    pub fn build(&self) -> Result<Model, Faults> {
        Model::parse(&self.to_toml())
    }

    /// The model file that says the same.
    pub fn to_toml(&self) -> String {
        let mut text = self.head.lines();
        for (section, table) in [("parameters", &self.parameters), ("points", &self.points)] {
            if !table.is_empty() {
                text += &line(&[section]);
                text += &table.lines();
            }
        }
        let mut bodies = self.bodies.clone();
        for (index, owned) in self.owned.iter().enumerate().filter(|(_, owned)| !owned.is_empty()) {
            bodies.table(index).set("points", quantity::list(owned.iter().map(|name| quantity::text(name))));
        }
        let sections = [
            ("bodies", &bodies),
            ("joints", &self.joints),
            ("loads", &self.loads),
            ("coordinates", &self.coordinates),
            ("drives", &self.drives),
        ];
        for (section, entries) in sections {
            text += &entries.text(section);
        }
        text
    }

    /// The name of a body or ground, as a text.
    fn frame(&self, frame: Frame) -> Quantity {
        match frame {
            Frame::Ground => quantity::text("ground"),
            Frame::Body(body) => self.bodies.name(body.index()),
        }
    }

    /// A new point that moves with a frame, named after what it is for: "body.point".
    fn point(&mut self, frame: Frame, name: &str, place: Quantity) -> String {
        let mut point = name.to_owned();
        let mut count = 1;
        while self.points.has(&point) {
            count += 1;
            point = format!("{name}_{count}");
        }
        self.points.add(&point, place);
        let Frame::Body(body) = frame else { return format!("ground.{point}") };
        if let Some(owned) = self.owned.get_mut(body.index()) {
            owned.push(point.clone());
        }
        format!("{}.{point}", self.bodies.plain_name(body.index()))
    }

    fn ends<P: Into<Quantity>>(&mut self, name: &str, ends: [(Frame, [P; 2]); 2]) -> Quantity {
        let ends = ends.map(|(frame, place)| self.point(frame, name, quantity::pair(place)));
        quantity::list(ends.map(|end| quantity::text(&end)))
    }
}

/// A body of a [`Drawing`].
#[derive(Debug)]
pub struct BodyBuilder<'d> {
    drawing: &'d mut Drawing,
    id: BodyId,
}

impl BodyBuilder<'_> {
    fn set(self, key: &str, value: Quantity) -> Self {
        self.drawing.bodies.table(self.id.index()).set(key, value);
        self
    }

    /// Its mass, greater than zero (kg).
    pub fn mass(self, mass: impl Into<Quantity>) -> Self {
        self.set("mass", mass.into())
    }

    /// Its moment of inertia about the centre of mass (kg m^2).
    pub fn inertia(self, moment: impl Into<Quantity>) -> Self {
        self.set("moment_of_inertia", moment.into())
    }

    /// Its centre of mass in the drawing (m).
    pub fn centre(self, place: [impl Into<Quantity>; 2]) -> Self {
        self.set("centre_of_mass", quantity::pair(place))
    }

    /// A homogeneous rectangle about the centre of mass, with its width and height (m), in place of a moment
    /// of inertia.
    pub fn rectangle(self, size: [impl Into<Quantity>; 2]) -> Self {
        self.drawing.bodies.table(self.id.index()).inner("shape").set("rectangle", quantity::pair(size));
        self
    }

    /// A homogeneous disc about the centre of mass, with its radius (m), in place of a moment of inertia.
    pub fn disc(self, radius: impl Into<Quantity>) -> Self {
        self.drawing.bodies.table(self.id.index()).inner("shape").set("disc", radius.into());
        self
    }

    /// A thin bar between two places of the drawing (m), in place of a moment of inertia and a centre of
    /// mass.
    pub fn bar<P: Into<Quantity>>(self, ends: [[P; 2]; 2]) -> Self {
        let ends = quantity::list(ends.map(quantity::pair));
        self.drawing.bodies.table(self.id.index()).inner("shape").set("bar", ends);
        self
    }

    /// Sets the looks of the body: the corners of a polygon in the drawing (m), at least three. No answer
    /// depends on it.
    pub fn outline<P: Into<Quantity>>(self, corners: impl IntoIterator<Item = [P; 2]>) -> Self {
        let corners = quantity::list(corners.into_iter().map(quantity::pair));
        self.set("outline", corners)
    }

    /// A body without mass.
    pub fn massless(self) -> Self {
        self.set("massless", Quantity::truth(true))
    }

    /// The handle.
    pub fn id(self) -> BodyId {
        self.id
    }
}

/// A chosen coordinate of a [`Drawing`].
#[derive(Debug)]
pub struct CoordinateBuilder<'d> {
    drawing: &'d mut Drawing,
    id: CoordinateId,
}

impl CoordinateBuilder<'_> {
    fn set(self, key: &str, value: Quantity) -> Self {
        self.drawing.coordinates.table(self.id.index()).set(key, value);
        self
    }

    /// Its value in the drawing. Default: 0.
    pub fn drawn_at(self, value: impl Into<Quantity>) -> Self {
        self.set("drawn_at", value.into())
    }

    /// Its value in the state. Default: that in the drawing.
    pub fn value(self, value: impl Into<Quantity>) -> Self {
        self.set("value", value.into())
    }

    /// Its rate of change in the state. Default: 0.
    pub fn rate(self, rate: impl Into<Quantity>) -> Self {
        self.set("rate", rate.into())
    }

    /// The body against which a rotation is counted. Default: ground.
    pub fn relative_to(self, body: impl Into<Frame>) -> Self {
        let body = self.drawing.frame(body.into());
        self.set("relative_to", body)
    }

    /// The handle.
    pub fn id(self) -> CoordinateId {
        self.id
    }
}
