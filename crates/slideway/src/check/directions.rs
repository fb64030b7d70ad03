//! Which way joints and coordinates count as positive.

use crate::configuration::Configuration;
use crate::mechanism::{Mechanism, Slider};
use crate::model::{Attachment, Coordinate, CoordinateKind, Model};
use crate::pattern::sliding_in_words;

/// "drawer slides along (1, 0)"
pub(super) fn of_joint(mechanism: &Mechanism, configuration: &Configuration, slider: &Slider) -> String {
    sliding_in_words(mechanism, configuration, slider, 1)
}

/// "crank turns counter-clockwise", "block.P moves along (1, 0)", or as the sliding joint.
pub(super) fn of_coordinate(
    (model, mechanism): (&Model, &Mechanism),
    configuration: &Configuration,
    coordinate: &Coordinate,
) -> String {
    let name = |frame| mechanism.frame_name(frame);
    let point =
        |point: &Attachment, axis: &str| format!("{}.{} moves along {axis}", name(point.frame), point.name);
    match &coordinate.kind {
        CoordinateKind::Slide(joint) => mechanism
            .slider(*joint)
            .map_or_else(String::new, |slider| of_joint(mechanism, configuration, slider)),
        CoordinateKind::Rotation { body, relative_to } => {
            let against = match relative_to.body() {
                Some(_) => format!(" against {}", name(*relative_to)),
                None => String::new(),
            };
            format!("{} turns counter-clockwise{against}", model.bodies[body.index()].name)
        }
        CoordinateKind::X(attachment) => point(attachment, "(1, 0)"),
        CoordinateKind::Y(attachment) => point(attachment, "(0, 1)"),
    }
}
