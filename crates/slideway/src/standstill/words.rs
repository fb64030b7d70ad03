//! What a sliding joint does on release, in words.

use super::setup::Setup;
use crate::ids::JointId;
use crate::report::number::against;

/// "sticks", or "bracket slides along (0, -1)".
///
/// Where the block is ground, it is the guide that is said to slide.
pub(super) fn slip_in_words(setup: &Setup, joint: JointId, slip: i8) -> String {
    let Some(slider) = setup.mechanism.slider(joint).filter(|_| slip != 0) else {
        return "sticks".to_owned();
    };
    let tangent = setup.configuration.slide(&setup.mechanism, slider).tangent;
    let name = |frame| setup.mechanism.frame_name(frame);
    let (moving, against_what, sign) = if slider.block.body().is_some() {
        (name(slider.block), slider.guide, 1.0)
    } else {
        (name(slider.guide), slider.block, -1.0)
    };
    let direction = tangent * (sign * f64::from(slip));
    let place =
        if against_what.body().is_some() { format!(" on {}", name(against_what)) } else { String::new() };
    format!("{moving} slides along ({}, {}){place}", against(direction.x, 1.0), against(direction.y, 1.0))
}
