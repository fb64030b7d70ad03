//! Scale and place that the drawings of one answer hand on to those of the next.

use serde::{Deserialize, Serialize};
use slideway_pictures::drawing::{Bounds, Held, Point};

/// Scale and place of the drawings, which the page sends back with its next question of the same model.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct Kept {
    /// The force (N) whose arrow has the usual length.
    pub(crate) longest_force: Option<f64>,
    /// Least x and y, then greatest.
    pub(crate) place: [f64; 4],
    /// The part of its usual room that the mechanism has.
    pub(crate) room: f64,
}

impl From<Held> for Kept {
    fn from(Held { longest_force, place: Bounds { least, greatest }, room }: Held) -> Self {
        Self { longest_force, place: [least.x, least.y, greatest.x, greatest.y], room }
    }
}

impl From<Kept> for Held {
    fn from(Kept { longest_force, place: [left, top, right, bottom], room }: Kept) -> Self {
        let place = Bounds { least: Point::new(left, top), greatest: Point::new(right, bottom) };
        Self { longest_force, place, room }
    }
}
