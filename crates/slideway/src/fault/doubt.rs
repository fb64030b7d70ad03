//! Warnings: input that makes sense, but is perhaps not what was meant.

use super::{CommandLine, Face};

/// Kind of input that is perhaps not meant, with its values.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message above each variant says what it and its values mean")]
pub enum Doubt {
    #[error("{what} is {value} rad, more than a full turn: a number without a unit is in radians")]
    BareAngle { what: String, value: f64 },
    #[error("{what} is {value} {si}, while the model uses {unit}: a number without a unit is in SI units")]
    BareNumber { what: String, value: f64, si: String, unit: String },
    #[error("the lengths of the model differ by a factor of {factor}: from {least} to {greatest}")]
    LengthsFarApart { factor: String, least: String, greatest: String },
    #[error("{what} is {length}, {factor} times the next smaller length of the model, {next}")]
    LengthTowers { what: String, length: String, factor: String, next: String },
    #[error(
        "the drawing leaves {joint} open by {gap}: to close it, the bodies were moved out of their places"
    )]
    GapClosed { joint: String, gap: String },
    #[error("{body} is {distance} from its place in the drawing, {sizes} times the size of the mechanism")]
    FarFromDrawing { body: String, distance: String, sizes: String },
    #[error("{what} is {value}: dry friction rarely exceeds 1")]
    GreatFriction { what: String, value: String },
    #[error(
        "the friction circle of {hinge} has a radius of {radius}, and the hinge {other} of {body} is {distance} from its centre: every force through {other} passes inside the circle"
    )]
    WideFrictionCircle { hinge: String, radius: String, body: String, other: String, distance: String },
    #[error("the gravity is {value}, more than ten times that of the Earth")]
    GreatGravity { value: String },
    #[error("{body} lies {}behind the face of {joint}", if *.partly { "partly " } else { "" })]
    BehindFace { body: String, joint: String, partly: bool },
    #[error(
        "the model has neither gravity nor a load nor a drive: nothing but its own motion presses its contacts"
    )]
    NoLoads,
    #[error("nothing presses any guide: all contact forces are zero, and friction has nothing to act on")]
    NothingPresses,
    #[error("{corner} lies on the face of {joint} and has no contact there")]
    BareCorner { corner: String, joint: String, wanted: &'static str },
    #[error(
        "{name} is known from {from} to {to}: where one value is needed, this takes the middle, {middle}"
    )]
    RangeAtMiddle { name: String, from: String, to: String, middle: String },
    #[error(
        "{name} is varied: its own value, {value}, is not allowed beside the others, and {taken} stands for it"
    )]
    VariedValue { name: String, value: String, taken: String },
}

impl Doubt {
    /// Its kind in one word, for programs.
    pub fn name(&self) -> &'static str {
        match self {
            Self::BareAngle { .. } => "bare_angle",
            Self::BareNumber { .. } => "bare_number",
            Self::LengthsFarApart { .. } => "lengths_far_apart",
            Self::LengthTowers { .. } => "length_towers",
            Self::GapClosed { .. } => "gap_closed",
            Self::FarFromDrawing { .. } => "far_from_drawing",
            Self::GreatFriction { .. } => "great_friction",
            Self::WideFrictionCircle { .. } => "wide_friction_circle",
            Self::GreatGravity { .. } => "great_gravity",
            Self::BehindFace { .. } => "behind_face",
            Self::NoLoads => "no_loads",
            Self::NothingPresses => "nothing_presses",
            Self::BareCorner { .. } => "bare_corner",
            Self::RangeAtMiddle { .. } => "range_at_middle",
            Self::VariedValue { .. } => "varied_value",
        }
    }

    /// Whether it concerns what is drawn and not what is computed of it: a motion that comes to such a corner ends there.
    pub fn concerns_drawing(&self) -> bool {
        matches!(self, Self::BareCorner { .. })
    }

    /// Returns a hint in the words of the command line.
    pub fn hint(&self) -> String {
        self.hint_for(&CommandLine)
    }

    /// Returns a hint in the words of an interface.
    pub fn hint_for(&self, face: &dyn Face) -> String {
        match self {
            Self::BareAngle { value, .. } => {
                format!("write `{value} deg`, or `{value} rad` if that is meant")
            }
            Self::BareNumber { value, unit, si, .. } => {
                format!("write `{value} {unit}`, or `{value} {si}` if that is meant")
            }
            Self::LengthsFarApart { .. } | Self::LengthTowers { .. } => {
                "look for a wrong or missing unit".to_owned()
            }
            Self::GapClosed { .. } => {
                "draw both points of the joint at the same place, for instance with one name".to_owned()
            }
            Self::FarFromDrawing { .. } => "look for a wrong or missing unit in the coordinates".to_owned(),
            Self::GreatFriction { .. } => {
                "if a percentage is meant, write its sign: `30 %` is 0.3".to_owned()
            }
            Self::WideFrictionCircle { .. } => {
                "look for a wrong or missing unit in its `radius` or `friction_radius`".to_owned()
            }
            Self::BareCorner { wanted, .. } => {
                format!("if it may press there, add a `{wanted}`; a base with two corners is a `block_on_face`")
            }
            Self::RangeAtMiddle { name, from, to, .. } => format!(
                "`{}` tells what holds for the whole range; ask here with each end, `{name}={from}` and `{name}={to}`",
                face.question("solve")
            ),
            Self::VariedValue { name, .. } => {
                format!("a static coefficient is not below its kinetic one: set `{name}`, too")
            }
            Self::GreatGravity { .. } => {
                "look for a wrong or missing unit: `9.81 m/s^2` and `9810 mm/s^2` are that of the Earth".to_owned()
            }
            Self::BehindFace { partly: true, .. } => {
                "look at the place of the joint: the corners of its base touch the face, and nothing of it is behind"
                    .to_owned()
            }
            Self::BehindFace { .. } => {
                "turn the face round, by 180 deg in `along` or with the two ends of `face` exchanged: what touches it \
                 is on its left side"
                    .to_owned()
            }
            Self::NoLoads => "add `gravity = \"9.81 m/s^2\"`, or the load that it has to carry".to_owned(),
            Self::NothingPresses => {
                "so it moves as without friction, but only exactly here: try a load or place a little beside; if a \
                load is missing, add the resistance, the weight or the acceleration that the drive works against"
                    .to_owned()
            }
        }
    }
}
