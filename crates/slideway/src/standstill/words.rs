//! The motion of a sliding joint on release, in words.

use super::setup::{Setup, SlidingJoint};
use crate::pattern::{ContactPhase, sliding_in_words, sticking_in_words};

/// "sticks", "does not slip", "bracket slides along (0, -1)", "tips over base.rear", "lifts off"
pub(super) fn release_in_words(
    setup: &Setup,
    joint: &SlidingJoint,
    contacts: &[ContactPhase],
    slip: i8,
) -> String {
    let slider = setup.mechanism.slider(joint.joint);
    let slides = slider
        .filter(|_| slip != 0)
        .map(|slider| sliding_in_words(&setup.mechanism, &setup.configuration, slider, slip));
    let closed =
        |k: &&usize| !setup.mechanism.contacts[**k].opens || contacts[**k] != ContactPhase::PreloadGap;
    let closed: Vec<usize> = joint.contacts.iter().filter(closed).copied().collect();
    match closed.as_slice() {
        [] => "lifts off".to_owned(),
        [corner] if joint.contacts.len() > 1 => {
            let tips = format!("tips over {}", setup.mechanism.contacts[*corner].name);
            slides.map_or(tips.clone(), |slides| format!("{tips}, {slides}"))
        }
        _ => slides.unwrap_or_else(|| slider.map_or("sticks", sticking_in_words).to_owned()),
    }
}
