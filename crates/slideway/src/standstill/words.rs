//! The motion of a sliding joint on release, in words.

use super::setup::Setup;
use crate::ids::JointId;
use crate::solve::sliding_in_words;

/// "sticks", or "bracket slides along (0, -1)".
pub(super) fn slip_in_words(setup: &Setup, joint: JointId, slip: i8) -> String {
    match setup.mechanism.slider(joint).filter(|_| slip != 0) {
        Some(slider) => sliding_in_words(&setup.mechanism, &setup.configuration, slider, slip),
        None => "sticks".to_owned(),
    }
}
