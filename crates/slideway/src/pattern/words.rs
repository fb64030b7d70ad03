//! The senses of sliding, in words.

use crate::configuration::Configuration;
use crate::mechanism::{Mechanism, Slider};
use crate::units::number::against;

/// "drawer slides along (1, 0)", or "block slides along (0, -1) on arm": what it means that a joint slides in
/// its positive direction (`sign` = 1) or against it (-1).
///
/// Where the block is ground, it is the guide that is said to slide.
pub(crate) fn sliding_in_words(
    mechanism: &Mechanism,
    configuration: &Configuration,
    slider: &Slider,
    sign: i8,
) -> String {
    let tangent = configuration.slide(mechanism, slider).tangent;
    let name = |frame| mechanism.frame_name(frame);
    let (moving, against_what, sense) = if slider.block.body().is_some() {
        (name(slider.block), slider.guide, 1.0)
    } else {
        (name(slider.guide), slider.block, -1.0)
    };
    let direction = tangent * (sense * f64::from(sign));
    let place =
        if against_what.body().is_some() { format!(" on {}", name(against_what)) } else { String::new() };
    format!("{moving} slides along ({}, {}){place}", against(direction.x, 1.0), against(direction.y, 1.0))
}

/// "sticks", of a disc that may roll "does not slip".
pub(crate) fn sticking_in_words(slider: &Slider) -> &'static str {
    if slider.is_disc() { "does not slip" } else { "sticks" }
}
