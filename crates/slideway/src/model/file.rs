//! The shape of a model file: one type for each table, from which both the reader and the JSON Schema come.
//!
//! The doc comments of this file, and those of `test_schema.rs`, are what an editor shows for each key.
//! `schema.json` is what they give; a test holds it to them.

use super::quantity::{Components, Direction, InSpace, Name, OutlinePlace, PerSide, Place, Quantity, Span};
#[cfg(test)]
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A function of one argument, linear between its values.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct TableTable {
    /// The arguments, numbers with or without a unit, which must not fall; the value jumps where two are
    /// equal.
    pub(super) argument: Vec<Quantity>,
    /// The value at each argument.
    pub(super) value: Vec<Quantity>,
    /// Outside the arguments: "hold" the first and last value (default), or "repeat" the table.
    pub(super) beyond: Option<BeyondName>,
}

/// What a table says outside its arguments.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(super) enum BeyondName {
    /// The first value before them, the last after them.
    Hold,
    /// The table again.
    Repeat,
}

/// Something that happens when a quantity passes through zero.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct EventTable {
    /// The quantity, of coordinates, rates and time.
    pub(super) zero_of: Quantity,
    /// Whether it happens where the quantity is "rising", "falling" or "both" (default).
    pub(super) direction: Option<CrossingDirection>,
    /// `true`: the motion ends there. Default: `false`.
    pub(super) stops: Option<bool>,
}

/// In which direction a quantity passes through zero.
#[derive(Deserialize, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum CrossingDirection {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Either.
    #[default]
    Both,
}

/// A rigid body.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct BodyTable {
    /// The points that move with the body.
    pub(super) points: Option<Vec<Name>>,
    /// Mass, greater than zero (kg).
    pub(super) mass: Option<Quantity>,
    /// Moment of inertia about the centre of mass (kg m^2); or give a `shape`.
    pub(super) moment_of_inertia: Option<Quantity>,
    /// Shape of a homogeneous body, from which its moment of inertia follows.
    pub(super) shape: Option<ShapeTable>,
    /// Products of inertia [D_x, D_y] = [int x z dm, int y z dm] about the centre of mass, in the axes of the drawing
    /// (kg m^2). Default: 0.
    pub(super) products_of_inertia: Option<Components>,
    /// Centre of mass: a point's name, [x, y] or [x, y, z]. The middle of a bar unless given.
    pub(super) centre_of_mass: Option<Place>,
    /// `true` for a body without mass.
    pub(super) massless: Option<bool>,
    /// What the body looks like in drawings: corners, each a point's name or [x, y], joined by straight
    /// lines, or by an arc where { through = place } stands between them. It moves with the body, and no
    /// answer depends on it.
    #[cfg_attr(test, schemars(length(min = 3)))]
    pub(super) outline: Option<Vec<OutlinePlace>>,
}

/// Shape of a homogeneous body: exactly one of the keys.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct ShapeTable {
    /// A thin bar between two points: m l^2/12.
    pub(super) bar: Option<[Place; 2]>,
    /// A rectangle [width, height] about the centre of mass: m (w^2 + h^2)/12.
    pub(super) rectangle: Option<Components>,
    /// A box [width, height, depth] about the centre of mass, with its depth along z: m (w^2 + h^2)/12.
    #[serde(rename = "box")]
    pub(super) cuboid: Option<[Quantity; 3]>,
    /// A disc of this radius about the centre of mass: m r^2/2.
    pub(super) disc: Option<Quantity>,
}

/// A hinge, without friction unless it is given.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct HingeTable {
    /// The two hinged points, each as "body.point". The hinge force is counted on the first body.
    pub(super) between: [Name; 2],
    /// Kinetic friction coefficient of the pin; needs `radius`. Default: no friction.
    pub(super) mu: Option<Quantity>,
    /// Static friction coefficient of the pin, not below `mu`. Default: `mu`.
    pub(super) mu_static: Option<Quantity>,
    /// Radius of the pin (m).
    pub(super) radius: Option<Quantity>,
    /// How the radius of the friction circle follows from `mu` and `radius`. Default: "total_reaction".
    pub(super) law: Option<PinLaw>,
    /// Radius of the friction circle (m), in place of `mu` and `radius`: friction couple per reaction.
    pub(super) friction_radius: Option<Quantity>,
    /// Radius of the friction circle at rest (m), not below `friction_radius`. Default: `friction_radius`.
    pub(super) static_friction_radius: Option<Quantity>,
    /// What it carries out of the drawing: "all" (default), the force along "z" alone, the couples of "tilt" alone,
    /// or "nothing".
    pub(super) carries: Option<HingeCarries>,
    /// Distance of both bearings of its pin along z, each with the friction given, which carry the couples: two hinges,
    /// `NAME.upper` and `NAME.lower`, at half of it above and below. Default: one, at the height of its points.
    pub(super) bearings: Option<Quantity>,
    /// The collar by which it carries along z, with friction of its own. Default: none, without friction.
    pub(super) collar: Option<CollarTable>,
}

/// The collar of a pin: a ring that carries the force along z.
#[derive(Deserialize, Debug)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct CollarTable {
    /// Friction couple per force along z (m): for a narrow ring its friction coefficient times its mean radius.
    pub(super) friction_radius: Quantity,
    /// The same at rest (m), not below `friction_radius`. Default: `friction_radius`.
    pub(super) static_friction_radius: Option<Quantity>,
}

/// What a hinge carries out of the drawing.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(super) enum HingeCarries {
    /// A force along z and couples about x and y.
    All,
    /// A force along z: a ball.
    Z,
    /// Couples about x and y: a cylinder.
    Tilt,
    /// None of them.
    Nothing,
}

/// What a sliding joint carries out of the drawing without friction.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(super) enum SliderCarries {
    /// A force along z.
    Z,
    /// A couple about the direction of sliding.
    Roll,
    /// A couple about the normal in the drawing.
    Pitch,
}

/// How the radius of the friction circle follows from the friction coefficient mu and the radius rho of a pin.
#[derive(Deserialize, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PinLaw {
    /// A loose pin touches along a line, and the reaction is the total one: rho sin(atan mu).
    #[default]
    TotalReaction,
    /// The textbooks' approximation: mu rho.
    MuRho,
}

/// A sliding joint: what the tables of all three kinds may have between them. `test_schema.rs` says which has what.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct SliderTable {
    /// The body that is the block or carries the pin, or "ground".
    pub(super) block: Name,
    /// The body that is the guide or has the slot. Default: "ground".
    pub(super) guide: Option<Name>,
    /// Middle of the block on the guide's centre line, or the pin, in the drawing: a point's name or [x, y].
    #[serde(alias = "centre")]
    pub(super) at: Place,
    /// The radius of a disc, which `test_schema.rs` has.
    #[cfg_attr(test, schemars(skip))]
    pub(super) radius: Option<Quantity>,
    /// What touches, which `test_schema.rs` has.
    #[cfg_attr(test, schemars(skip))]
    pub(super) closed: Option<Closed>,
    /// Whether it slips, which `test_schema.rs` has.
    #[cfg_attr(test, schemars(skip))]
    pub(super) sticks: Option<bool>,
    /// Direction of positive sliding: an angle from the x axis, or two points `["from", "to"]`.
    pub(super) along: Option<Direction>,
    /// The ends of a face, which `test_schema.rs` has.
    #[cfg_attr(test, schemars(skip))]
    pub(super) face: Option<[Name; 2]>,
    /// Distance of the two contacts of a block in the drawing; for a guided slider the length of the pressed face: its
    /// couple is at most normal force times half of it.
    pub(super) length: Option<Quantity>,
    /// Distance of the two rubbing faces. Default: 0.
    pub(super) height: Option<Quantity>,
    /// "round": the guide is a rod, which both ends of the block press in any direction across it. Default: flat faces.
    pub(super) section: Option<CrossSection>,
    /// "inside": the block is inside the guide (default); "around": it surrounds the guide.
    pub(super) fit: Option<Fit>,
    /// Limits [least, greatest] of the slide displacement.
    pub(super) travel: Option<Components>,
    /// `true`: `simulate` takes each face by itself, and the block rattles within its `play`. Default: `false`.
    pub(super) loose: Option<bool>,
    /// What stops the block at the ends of its travel: { restitution = .. } or { stiffness = .., damping = ..
    /// }. Default: the motion ends there.
    pub(super) stop: Option<StopTable>,
    /// The contact at the end in the direction of `along`: what differs there.
    #[cfg_attr(test, schemars(with = "Option<super::test_schema::EndTable>"))]
    pub(super) front: Option<ContactTable>,
    /// The contact at the other end: what differs there.
    #[cfg_attr(test, schemars(with = "Option<super::test_schema::EndTable>"))]
    pub(super) rear: Option<ContactTable>,
    /// What it carries out of the drawing without friction, such as ball rails: any of "z", "roll" and "pitch".
    /// Default: nothing but what its contacts carry.
    pub(super) carries: Option<Vec<SliderCarries>>,
    /// Corners that carry along z, in place of `supports` with `normal = "90 deg"`: `rests_on = { width = "0.5 m" }`.
    pub(super) rests_on: Option<RestsOnTable>,
    /// Further contacts by their names, such as `middle = { at = "20 mm" }`: they are redundant, and share the load
    /// by play, stiffness and misalignment.
    #[cfg_attr(test, schemars(with = "Option<BTreeMap<String, super::test_schema::SupportTable>>"))]
    pub(super) supports: Option<BTreeMap<String, ContactTable>>,
}

/// The cross-section of a guide.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(super) enum CrossSection {
    /// A rod.
    Round,
}

/// What of a joint that may lift off touches in the state to be solved.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(untagged)]
pub(super) enum Closed {
    /// All of it, or nothing.
    All(bool),
    /// The corner of a block with this name.
    One([End; 1]),
}

/// An end of a block.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(super) enum End {
    /// The end in the direction of sliding.
    Front,
    /// The other end.
    Rear,
}

/// A disc on a disc, or in a hole, which it may leave.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct DiscOnDiscTable {
    /// The centres of both discs, each as "body.point": the block's, then the guide's.
    pub(super) centres: [Name; 2],
    /// Their radii, in the same order.
    pub(super) radii: Components,
    /// `true`: the guide has a hole, and the disc is inside it. Default: `false`.
    pub(super) inside: Option<bool>,
    /// `false`: they are apart in the state to be solved. Default: `true`.
    pub(super) closed: Option<bool>,
    /// `true`: the disc rolls in the state to be solved, so that it needs one coordinate less. Default: `false`.
    pub(super) sticks: Option<bool>,
}

/// A contact of a sliding joint, or what all of its contacts have in common.
#[derive(Deserialize, Default)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct ContactTable {
    /// Its place in the drawing: how far from the middle of the block in the direction of `along`.
    pub(super) at: Option<Quantity>,
    /// How far it is from the guide's line along n, rot90 of `along`. Default: 0.
    #[cfg_attr(test, schemars(skip))]
    pub(super) aside: Option<Quantity>,
    /// How far it is out of the drawing. Default: 0.
    #[cfg_attr(test, schemars(skip))]
    pub(super) z: Option<Quantity>,
    /// Distance of its two faces along its normal. Default: that of the joint, 0 where the normal leans out of the drawing.
    #[cfg_attr(test, schemars(skip))]
    pub(super) height: Option<Quantity>,
    /// Direction of its normal in the cross-section, an angle from n towards z: "90 deg" carries along z. Default: 0.
    #[cfg_attr(test, schemars(skip))]
    pub(super) normal: Option<Quantity>,
    /// Whether it has one face, which it may leave.
    #[cfg_attr(test, schemars(skip))]
    pub(super) one_sided: Option<bool>,
    /// "block": the contact travels with the block (default); "guide": it stays at a place of the guide.
    pub(super) carried_by: Option<CarriedBy>,
    /// Kinetic friction coefficient, or { plus = .., minus = .. } by the side of contact.
    pub(super) mu: Option<PerSide>,
    /// Static friction coefficient, not below `mu`. Default: `mu`.
    pub(super) mu_static: Option<PerSide>,
    /// Preload: friction force at zero normal force, F0 of eq. (2). Default: 0.
    pub(super) preload: Option<PerSide>,
    /// Where the preload's friction acts: at the "pressed" face (default) or at the "centre" line.
    pub(super) preload_line: Option<PreloadLine>,
    /// Stiffness of the guide or slot at a contact (N/m).
    pub(super) stiffness: Option<Quantity>,
    /// Total play between the two faces (m), which counts where redundant contacts share a load; negative for a
    /// press fit. Default: 0.
    pub(super) play: Option<Quantity>,
    /// How far the guide's line is displaced towards +n there (m), which counts where redundant contacts share
    /// a load; may depend on coordinates. Default: 0.
    pub(super) misalignment: Option<Quantity>,
    /// Coefficient of restitution of the faces of a `loose` guide, from 0 to 1. Default: 0.
    pub(super) restitution: Option<Quantity>,
    /// Area in contact, for the bearing pressure: { length = .., width = .. }; a guided slider's has the length of
    /// its pressed face unless it is given.
    pub(super) pad: Option<PadTable>,
}

/// The area in contact at a contact.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct PadTable {
    /// Its length in the direction of sliding (m). Default: the length of a guided slider; for other joints
    /// it must be given.
    pub(super) length: Option<Quantity>,
    /// Its width across the plane of the mechanism (m).
    pub(super) width: Quantity,
}

/// The corners by which a block rests on its guide.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct RestsOnTable {
    /// Distance of the left corners from the right ones; they are at half of it from the guide's line.
    pub(super) width: Quantity,
    /// Distance of the front corners from the rear ones. Default: the length of the block.
    pub(super) length: Option<Quantity>,
    /// 4 (default): `front_left`, `front_right`, `rear_left` and `rear_right`, which share the load; 3: both in front, and
    /// `rear_middle`.
    pub(super) corners: Option<u8>,
    /// `true`: nothing holds it down, so that it may lift off and tip. Default: `false`.
    pub(super) one_sided: Option<bool>,
    /// How far the corners are out of the drawing. Default: 0.
    pub(super) z: Option<Quantity>,
    /// Kinetic friction coefficient. Default: that of the joint.
    pub(super) mu: Option<PerSide>,
    /// Static friction coefficient, not below `mu`. Default: `mu`.
    pub(super) mu_static: Option<PerSide>,
    /// Stiffness of each corner (N/m).
    pub(super) stiffness: Option<Quantity>,
}

/// What stops a block at both ends of its travel, or at one.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct StopTable {
    /// Coefficient of restitution, from 0 to 1: the part of the velocity with which the block comes back.
    pub(super) restitution: Option<Quantity>,
    /// Stiffness of a pad (N/m), in place of `restitution`.
    pub(super) stiffness: Option<Quantity>,
    /// Damping coefficient of the pad (N s/m). Default: 0.
    pub(super) damping: Option<Quantity>,
    /// The stop at the least displacement.
    #[cfg_attr(test, schemars(with = "Option<super::test_schema::StopAtEndTable>"))]
    pub(super) least: Option<Box<StopTable>>,
    /// The stop at the greatest displacement.
    #[cfg_attr(test, schemars(with = "Option<super::test_schema::StopAtEndTable>"))]
    pub(super) greatest: Option<Box<StopTable>>,
}

impl StopTable {
    /// Whether it says nothing for both ends.
    pub(super) fn is_empty(&self) -> bool {
        self.restitution.is_none() && self.stiffness.is_none() && self.damping.is_none()
    }
}

/// How block and guide lie in each other.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(super) enum Fit {
    /// The block is inside the guide.
    Inside,
    /// The block surrounds the guide: a sleeve on a rod.
    Around,
}

/// What a contact at the end of a block travels with.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum CarriedBy {
    /// The contact is a material point of the block.
    Block,
    /// The contact stays at a place of the guide, such as the mouth of a carcass.
    Guide,
}

/// Where the friction that comes from the preload acts.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PreloadLine {
    /// At the face that is pressed, as in the paper.
    Pressed,
    /// In the middle between the faces: a packing or pre-stressed gib that rubs on both.
    Centre,
}

/// A force at a point of a body.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct ForceTable {
    /// Where the force acts, as "body.point".
    pub(super) at: Name,
    /// Components [x, y] or [x, y, z] (N); or give `magnitude` and `direction`.
    pub(super) components: Option<InSpace>,
    /// Magnitude along `direction` (N).
    pub(super) magnitude: Option<Quantity>,
    /// Direction of the force: an angle from the x axis, or two points `["from", "to"]` of the drawing.
    pub(super) direction: Option<Direction>,
    /// "world": the direction is fixed in space (default); "body": it turns with the body.
    pub(super) frame: Option<ForceFrame>,
    /// The body on which the opposite force acts at the same place. Default: none.
    pub(super) reaction: Option<Name>,
}

/// In which frame a force's direction is fixed.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ForceFrame {
    /// Fixed in space.
    World,
    /// Turns with the body.
    Body,
}

/// A torque on a body, counter-clockwise positive.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct TorqueTable {
    /// The body on which it acts.
    pub(super) body: Name,
    /// Its moment (N m); or give `moments`.
    pub(super) moment: Option<Quantity>,
    /// Its moments [M_x, M_y, M_z] about the axes of the drawing and out of it (N m).
    pub(super) moments: Option<[Quantity; 3]>,
    /// The body on which the opposite torque acts. Default: none.
    pub(super) reaction: Option<Name>,
}

/// A linear spring between two points.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct SpringTable {
    /// Its end points, each as "body.point".
    pub(super) between: [Name; 2],
    /// Stiffness (N/m).
    pub(super) stiffness: Quantity,
    /// Length without force. Default: its length in the drawing.
    pub(super) free_length: Option<Quantity>,
}

/// A linear damper between two points.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct DamperTable {
    /// Its end points, each as "body.point".
    pub(super) between: [Name; 2],
    /// Damping coefficient (N s/m).
    pub(super) damping: Quantity,
}

/// A linear torsional spring between two bodies.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct TorsionalSpringTable {
    /// The two bodies; one may be "ground".
    pub(super) between: [Name; 2],
    /// Torsional stiffness (N m per rad).
    pub(super) stiffness: Quantity,
    /// Rotation of the first body against the second without torque, counted from the drawing. Default: 0.
    pub(super) free_angle: Option<Quantity>,
}

/// A linear torsional damper between two bodies.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct TorsionalDamperTable {
    /// The two bodies; one may be "ground".
    pub(super) between: [Name; 2],
    /// Torsional damping coefficient (N m s per rad).
    pub(super) damping: Quantity,
}

/// A prescribed motion and the unknown force or torque that produces it.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct DriveTable {
    /// The coordinate whose motion is prescribed.
    pub(super) coordinate: Name,
    /// Its prescribed acceleration. Default: 0.
    pub(super) acceleration: Option<Quantity>,
    /// The unknown force's line of action; or give `torque`.
    pub(super) force: Option<DriveForceTable>,
    /// The unknown torque's body; or give `force`.
    pub(super) torque: Option<DriveTorqueTable>,
}

/// Line of action of a drive's force.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct DriveForceTable {
    /// Where the force acts, as "body.point".
    pub(super) at: Name,
    /// Its direction: an angle from the x axis, or two points `["from", "to"]` of the drawing.
    pub(super) direction: Direction,
    /// "world": the direction is fixed in space (default); "body": it turns with the body.
    pub(super) frame: Option<ForceFrame>,
    /// The body on which the opposite force acts at the same place. Default: none.
    pub(super) reaction: Option<Name>,
}

/// The bodies on which a drive's torque acts.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct DriveTorqueTable {
    /// The body on which it acts.
    pub(super) body: Name,
    /// The body on which the opposite torque acts. Default: none.
    pub(super) reaction: Option<Name>,
}

/// A chosen coordinate: exactly one of `slide`, `rotation`, `x`, `y`.
#[derive(Deserialize)]
#[cfg_attr(test, derive(JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct CoordinateTable {
    /// Displacement of the block of this sliding joint against its guide, positive in the direction `along`.
    pub(super) slide: Option<Name>,
    /// Rotation of this body, counter-clockwise positive.
    pub(super) rotation: Option<Name>,
    /// Displacement of this point, "body.point", in the direction of x.
    pub(super) x: Option<Name>,
    /// Displacement of this point, "body.point", in the direction of y.
    pub(super) y: Option<Name>,
    /// The body against which a `rotation` is counted. Default: "ground".
    pub(super) relative_to: Option<Name>,
    /// Value of the coordinate in the drawing. Default: 0.
    pub(super) drawn_at: Option<Quantity>,
    /// Value of the coordinate in the state to be solved. Default: `drawn_at`.
    pub(super) value: Option<Quantity>,
    /// Its rate of change in that state. Default: 0.
    pub(super) rate: Option<Quantity>,
}

/// One entry of a section: its name, its place and, unless it is faulty, its contents.
pub(super) struct Entry<T> {
    pub(super) name: String,
    pub(super) span: Span,
    pub(super) contents: Option<T>,
}
