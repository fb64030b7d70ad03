//! Which bodies joints connect.

use crate::ids::JointId;
use crate::mechanism::{Mechanism, frames_of};

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

/// Puts what two members belong to together.
pub(in crate::motion) fn join(parts: &mut [usize], one: usize, other: usize) {
    let (kept, dissolved) = (parts[one], parts[other]);
    parts.iter_mut().filter(|part| **part == dissolved).for_each(|part| *part = kept);
}
