//! Which bodies joints connect.

use crate::ids::{Frame, JointId};
use crate::mechanism::{Contact, Mechanism, frames_of};

/// For each body a number that it shares with the bodies that are connected with it by joints.
pub(in crate::motion) fn connected(mechanism: &Mechanism) -> Vec<usize> {
    let mut parts: Vec<usize> = (0..mechanism.bodies.len()).collect();
    for joint in (0..mechanism.joints.len()).map(JointId) {
        let [one, other] = frames_of(mechanism, joint);
        if let (Some(one), Some(other)) = (one.body(), other.body()) {
            join(&mut parts, one.index(), other.index());
        }
    }
    parts
}

/// For each contact a number that it shares with those between bodies that are connected with its own.
pub(in crate::motion) fn parts_of_contacts(mechanism: &Mechanism) -> Vec<Option<usize>> {
    let parts = connected(mechanism);
    let part = |contact: &Contact| {
        let body = frames_of(mechanism, contact.joint).into_iter().find_map(Frame::body);
        body.map(|body| parts[body.index()])
    };
    mechanism.contacts.iter().map(part).collect()
}

/// Puts what two members belong to together.
pub(in crate::motion) fn join(parts: &mut [usize], one: usize, other: usize) {
    let (kept, dissolved) = (parts[one], parts[other]);
    parts.iter_mut().filter(|part| **part == dissolved).for_each(|part| *part = kept);
}
