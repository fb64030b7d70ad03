//! Guides with play in motion: each face by itself, which the block may leave.

use super::{Contact, Joint, JointKind, Mechanism, Slider, rot90};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::JointId;
use crate::model::{CarriedBy, SliderKind};
use std::borrow::Cow;

/// What the names of both faces of a loose guide end with: of the one that presses towards `n`, and of the other.
pub(crate) const LOOSE_FACES: [&str; 2] = ["plus", "minus"];

impl Mechanism {
    /// Returns the mechanism with two joints in the place of each loose guide, `NAME.plus`, whose face presses the block towards
    /// `n`, and `NAME.minus` behind all others. In the drawing the block is apart from both.
    ///
    /// # Errors
    /// A fault for each contact that does not fit between its faces.
    pub(crate) fn with_loose_faces(&self) -> Result<Cow<'_, Self>, Faults> {
        let loose: Vec<(JointId, &Slider)> = self.sliders().filter(|(_, slider)| slider.loose).collect();
        if loose.is_empty() {
            return Ok(Cow::Borrowed(self));
        }
        let of_loose: Vec<usize> =
            loose.iter().flat_map(|(_, slider)| &slider.contacts).map(|contact| contact.index()).collect();
        let (mut faces, mut faults) = (self.without_contacts(&of_loose), Faults::default());
        for (id, slider) in loose {
            let Joint { name, place, .. } = &self.joints[id.index()];
            for (side, sign) in LOOSE_FACES.into_iter().zip([1.0, -1.0]) {
                let joint = if sign > 0.0 { id } else { JointId(faces.joints.len()) };
                let face = self.face_of(slider, (joint, side, sign));
                for contact in face.apart.iter().filter(|contact| contact.gap <= 0.0) {
                    let kind = FaultKind::OutOfRange {
                        what: format!(
                            "the gap of {}, half its play less what the guide is misaligned,",
                            contact.name
                        ),
                        wanted: "greater than zero",
                        value: self.units.of("m").show(contact.gap),
                    };
                    faults.push(Fault::new(kind, place.clone()));
                }
                let face = Joint {
                    name: format!("{name}.{side}").into(),
                    place: place.clone(),
                    carries: [false; 3],
                    kind: JointKind::Slider(face),
                };
                if sign > 0.0 { faces.joints[id.index()] = face } else { faces.joints.push(face) }
            }
        }
        faces.excess = faces.found_excess();
        faults.or(Cow::Owned(faces))
    }

    /// The face of a guide on which the block presses with a normal force of this sign, `height/2` from its centre line.
    fn face_of(&self, slider: &Slider, (joint, side, sign): (JointId, &str, f64)) -> Slider {
        let tangent = slider.tangent * sign;
        let number = usize::from(sign < 0.0);
        let gap = |contact: &Contact| contact.play / 2.0 - sign * contact.misalignment;
        // A corner of the guide is where it is drawn, as far from the face of the block.
        let behind =
            |contact: &Contact| if contact.carried_by == CarriedBy::Guide { gap(contact) } else { 0.0 };
        let face = |contact: &Contact, offset: f64, end: &str| Contact {
            name: format!("{}{end}.{side}", contact.name).into(),
            joint,
            offset: sign * offset,
            mu: [contact.mu[number], 0.0],
            law: [contact.law[number], None],
            mu_static: [contact.mu_static[number], 0.0],
            play: 0.0,
            misalignment: 0.0,
            opens: true,
            gap: gap(contact),
            aside: [-behind(contact), contact.aside[1]],
            ..contact.clone()
        };
        let contacts = slider.contacts.iter().map(|contact| &self.contacts[contact.index()]);
        let half = slider.length / 2.0;
        Slider {
            kind: if slider.kind == SliderKind::Pin { SliderKind::Pin } else { SliderKind::Block },
            at: slider.at - rot90(tangent) * (slider.height / 2.0),
            tangent,
            height: 0.0,
            around: false,
            apart: match slider.kind {
                SliderKind::Guided => contacts
                    .flat_map(|contact| [face(contact, half, ".front"), face(contact, -half, ".rear")])
                    .collect(),
                SliderKind::Block | SliderKind::Pin => {
                    contacts.map(|contact| face(contact, contact.offset, "")).collect()
                }
            },
            contacts: Vec::new(),
            ..slider.clone()
        }
    }
}
