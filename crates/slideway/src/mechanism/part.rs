//! Which bodies belong together: those of joints, drives and coordinates.

use super::{CoordinateKind, Effort, JointKind, Mechanism};
use crate::ids::{BodyId, Frame, JointId};

/// Both sides of a joint.
pub(crate) fn frames_of(mechanism: &Mechanism, joint: JointId) -> [Frame; 2] {
    match &mechanism.joints[joint.index()].kind {
        JointKind::Hinge(ends) => ends.each_ref().map(|end| end.frame),
        JointKind::Slider(slider) => [slider.block, slider.guide],
    }
}

/// A body that a joint holds: the first that is not the ground.
pub(crate) fn body_of(mechanism: &Mechanism, joint: JointId) -> Option<BodyId> {
    frames_of(mechanism, joint).into_iter().find_map(Frame::body)
}

impl Effort {
    /// Returns the frames on which it acts, that of the reaction included.
    pub(crate) fn frames(&self) -> Vec<Frame> {
        let (frame, reaction) = match self {
            Self::Force { at, reaction, .. } => (at.frame, *reaction),
            Self::Torque { body, reaction } => (*body, *reaction),
        };
        [Some(frame), reaction].into_iter().flatten().collect()
    }
}

impl CoordinateKind {
    /// Returns the frames on whose motion it depends.
    pub(crate) fn frames(&self, mechanism: &Mechanism) -> Vec<Frame> {
        match self {
            Self::Slide(joint) => frames_of(mechanism, *joint).to_vec(),
            Self::Rotation(body, frame) => vec![Frame::Body(*body), *frame],
            Self::Displacement(attachment, _) => vec![attachment.frame],
        }
    }
}
