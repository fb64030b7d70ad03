//! Some bodies of a mechanism, as a mechanism of their own.

use super::{
    Attachment, Contact, Coordinate, CoordinateKind, Drive, Effort, Excess, FrictionCircle, Joint, JointKind,
    Load, LoadKind, Mechanism, Slider, loaded_bodies,
};
use crate::ids::{BodyId, ContactId, Frame, JointId};
use nalgebra::Vector2;

/// Bodies of a mechanism that nothing connects with the others.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    /// They alone, with what acts on them. Coordinates and formulas are those of the whole; a coordinate of other bodies
    /// stands still.
    pub(crate) mechanism: Mechanism,
    /// Which bodies of the whole they are.
    pub(crate) bodies: Vec<BodyId>,
    /// Their joints.
    pub(crate) joints: Vec<JointId>,
    /// Their contacts.
    pub(crate) contacts: Vec<ContactId>,
}

impl Part {
    /// These bodies of a mechanism without redundant guides.
    pub(crate) fn new(whole: &Mechanism, bodies: Vec<BodyId>) -> Self {
        let mut part = Self { mechanism: whole.clone(), bodies, joints: Vec::new(), contacts: Vec::new() };
        let joints = (0..whole.joints.len()).map(JointId);
        part.joints = joints.filter(|joint| part.has_some_of(&frames_of(whole, *joint))).collect();
        let contacts = (0..whole.contacts.len()).map(ContactId);
        let has = |contact: &ContactId| part.joints.contains(&whole.contacts[contact.index()].joint);
        part.contacts = contacts.filter(has).collect();
        part.mechanism = part.alone(whole);
        part
    }

    fn alone(&self, whole: &Mechanism) -> Mechanism {
        let joints = self.joints.iter().map(|joint| whole.joints[joint.index()].clone());
        let contacts = self.contacts.iter().map(|contact| whole.contacts[contact.index()].clone());
        let circles = whole.friction_circles.iter().filter(|circle| self.joints.contains(&circle.joint));
        let acts =
            |load: &&Load| loaded_bodies(whole, &load.kind).iter().any(|body| self.bodies.contains(body));
        let loads = whole.loads.iter().filter(acts).cloned();
        let drives = whole.drives.iter().filter(|drive| self.has_drive(whole, drive)).cloned();
        Mechanism {
            bodies: self.bodies.iter().map(|body| whole.bodies[body.index()].clone()).collect(),
            joints: joints.map(|joint| Joint { kind: self.joint_kind(joint.kind), ..joint }).collect(),
            contacts: contacts.map(|contact| self.contact_alone(contact)).collect(),
            friction_circles: circles
                .map(|circle| FrictionCircle { joint: self.joint(circle.joint), ..*circle })
                .collect(),
            loads: loads.map(|load| Load { kind: self.load_kind(load.kind), ..load }).collect(),
            drives: drives.map(|drive| Drive { effort: self.effort(drive.effort), ..drive }).collect(),
            coordinates: whole
                .coordinates
                .iter()
                .map(|coordinate| self.coordinate(whole, coordinate))
                .collect(),
            excess: Excess::default(),
            ..whole.clone()
        }
    }

    fn contact_alone(&self, mut contact: Contact) -> Contact {
        contact.joint = self.joint(contact.joint);
        if let Some(face) = &mut contact.face {
            face.other = self.contact(face.other);
        }
        contact
    }

    /// Whether some of these frames belong to it.
    fn has_some_of(&self, frames: &[Frame]) -> bool {
        frames.iter().filter_map(|frame| frame.body()).any(|body| self.bodies.contains(&body))
    }

    fn has_drive(&self, whole: &Mechanism, drive: &Drive) -> bool {
        let moved = whole.coordinates[drive.coordinate.index()].kind.frames(whole);
        self.has_some_of(&[drive.effort.frames(), moved].concat())
    }

    fn frame(&self, frame: Frame) -> Frame {
        let place = frame.body().and_then(|body| self.bodies.iter().position(|other| *other == body));
        place.map_or(Frame::Ground, |place| Frame::Body(BodyId(place)))
    }

    fn attachment(&self, attachment: Attachment) -> Attachment {
        Attachment { frame: self.frame(attachment.frame), ..attachment }
    }

    fn joint(&self, joint: JointId) -> JointId {
        JointId(self.joints.iter().position(|other| *other == joint).expect("a part has all its joints"))
    }

    fn contact(&self, contact: ContactId) -> ContactId {
        let place = self.contacts.iter().position(|other| *other == contact);
        ContactId(place.expect("a part has all contacts of its joints"))
    }

    fn joint_kind(&self, kind: JointKind) -> JointKind {
        match kind {
            JointKind::Hinge(ends) => JointKind::Hinge(ends.map(|end| self.attachment(end))),
            JointKind::Slider(slider) => JointKind::Slider(Slider {
                block: self.frame(slider.block),
                guide: self.frame(slider.guide),
                contacts: slider.contacts.iter().map(|contact| self.contact(*contact)).collect(),
                ..slider
            }),
        }
    }

    fn load_kind(&self, mut kind: LoadKind) -> LoadKind {
        match &mut kind {
            LoadKind::Force { at, reaction, .. } => {
                *at = self.attachment(*at);
                *reaction = reaction.map(|frame| self.frame(frame));
            }
            LoadKind::Torque { body, reaction, .. } => {
                *body = self.frame(*body);
                *reaction = reaction.map(|frame| self.frame(frame));
            }
            LoadKind::Spring { between, .. } | LoadKind::Damper { between, .. } => {
                *between = between.map(|end| self.attachment(end));
            }
            LoadKind::TorsionalSpring { between, .. } | LoadKind::TorsionalDamper { between, .. } => {
                *between = between.map(|frame| self.frame(frame));
            }
            LoadKind::Pad(pad) => pad.joint = self.joint(pad.joint),
        }
        kind
    }

    fn effort(&self, mut effort: Effort) -> Effort {
        match &mut effort {
            Effort::Force { at, reaction, .. } => {
                *at = self.attachment(*at);
                *reaction = reaction.map(|frame| self.frame(frame));
            }
            Effort::Torque { body, reaction } => {
                *body = self.frame(*body);
                *reaction = reaction.map(|frame| self.frame(frame));
            }
        }
        effort
    }

    fn coordinate(&self, whole: &Mechanism, coordinate: &Coordinate) -> Coordinate {
        let frames = coordinate.kind.frames(whole);
        let of_others = |frame: &Frame| frame.body().is_some_and(|body| !self.bodies.contains(&body));
        let kind = match coordinate.kind {
            _ if frames.iter().any(of_others) => {
                let fixed = Attachment { frame: Frame::Ground, position: Vector2::zeros() };
                CoordinateKind::Displacement(fixed, Vector2::zeros())
            }
            CoordinateKind::Slide(joint) => CoordinateKind::Slide(self.joint(joint)),
            CoordinateKind::Rotation(body, against) => match self.frame(Frame::Body(body)) {
                Frame::Body(body) => CoordinateKind::Rotation(body, self.frame(against)),
                Frame::Ground => coordinate.kind,
            },
            CoordinateKind::Displacement(point, axis) => {
                CoordinateKind::Displacement(self.attachment(point), axis)
            }
        };
        Coordinate { kind, ..coordinate.clone() }
    }
}

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
