//! A sliding joint in drawing units, and sizes of its parts.

use super::looks::Look;
use super::outline::Local;
use super::scene::Point;
use slideway::ids::Frame;
use slideway::model::SliderKind;

/// Half the width of a bar of no particular width.
pub(super) const BAR: f64 = 5.0;
/// Height of a pedestal.
pub(super) const SUPPORT: f64 = 17.0;
/// Radius of a pin.
pub(super) const PIN: f64 = 5.5;
/// Thickness of the walls of a slot in a body.
pub(super) const WALL: f64 = 6.0;

/// A sliding joint in drawing units.
#[derive(Debug, Clone)]
pub(super) struct Slide {
    pub(super) kind: SliderKind,
    pub(super) look: Look,
    pub(super) around: bool,
    pub(super) block_frame: Frame,
    pub(super) guide_frame: Frame,
    /// Around the middle of the block, along its axis.
    pub(super) block: Local,
    /// Around the middle of the guide, along its tangent.
    pub(super) guide: Local,
    /// From where to where the block reaches along its axis.
    pub(super) block_reach: [f64; 2],
    /// From where to where the guide reaches along its tangent.
    pub(super) guide_reach: [f64; 2],
    /// Which ends of the guide, rear and front, are open: the block leaves it there.
    pub(super) open: [bool; 2],
    /// Which ends of the block are torn off, as the model does not say where they are.
    pub(super) torn: [bool; 2],
    /// The stops at the least and at the greatest displacement.
    pub(super) stops: [Option<EndStop>; 2],
    /// Drawn distance of the rubbing faces.
    pub(super) height: f64,
    /// Play on either side, the greatest where it differs.
    pub(super) gap: f64,
    /// Whether the block is a disc: of its height, about its middle.
    pub(super) is_disc: bool,
    /// The round face of the guide, if it is not straight.
    pub(super) round: Option<RoundFace>,
    /// The contacts of a guide that shares its load, by their places along it; none of any other.
    pub(super) stations: Vec<Station>,
}

/// A round face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RoundFace {
    pub(super) centre: Point,
    pub(super) radius: f64,
    /// Whether it is a hole.
    pub(super) inside: bool,
}

impl RoundFace {
    /// Its line, with the material on its left as one looks at the drawing.
    pub(super) fn line(&self) -> Vec<Point> {
        const CORNERS: i32 = 72;
        let sense = if self.inside { 1.0 } else { -1.0 };
        let corner = |index: i32| {
            let (sin, cos) =
                (sense * std::f64::consts::TAU * f64::from(index) / f64::from(CORNERS)).sin_cos();
            self.centre + Point::new(cos, sin) * self.radius
        };
        (0..=CORNERS).map(corner).collect()
    }
}

/// A stop or a pad, in places along the tangent of its guide from the middle of that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EndStop {
    /// The face that the block meets: at a pad into which it has come, where it is.
    pub(super) face: f64,
    /// The end of the guide: a pad fills what is between.
    pub(super) wall: f64,
    /// Half its width across the guide.
    pub(super) half: f64,
}

/// The geometry of a guide at one of its contacts, in drawing units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Station {
    /// Where, from the middle of the guide along its tangent.
    pub(super) along: f64,
    /// How far the line of the guide is displaced there.
    pub(super) offset: f64,
    /// Play on either side.
    pub(super) clearance: f64,
    /// By how much the block is displaced beyond its play, where a face gives way.
    pub(super) yielding: f64,
}
