//! End stops as contacts: a face across the centre line of the guide, which the block may leave.

use super::{Contact, Joint, JointKind, Mechanism, Slider, rot90};
use crate::ids::{ContactId, JointId};
use crate::model::{CarriedBy, PreloadLine, SliderKind, Stop};
use nalgebra::Vector2;
use std::borrow::Cow;
use std::sync::Arc;

/// An end of a guide with a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct EndStop {
    /// The sliding joint.
    pub(crate) joint: JointId,
    /// Whether it is the stop at the greatest displacement.
    pub(crate) greatest: bool,
}

impl Mechanism {
    /// Returns the mechanism with a contact without friction that may lift off in the place of each stop that is no pad, behind all
    /// other contacts, and these stops in the same order. Its face goes through the end of the travel, across the centre line of the
    /// guide; its point is the middle of the block.
    pub(crate) fn with_faces_of_stops(&self) -> (Cow<'_, Self>, Vec<EndStop>) {
        let mut stops = Vec::new();
        let mut whole = Cow::Borrowed(self);
        for (joint, slider) in self.sliders() {
            for (end, stop) in slider.stops.into_iter().enumerate() {
                let (Some(restitution), Some(travel)) = (stop.and_then(Stop::restitution), slider.travel)
                else {
                    continue;
                };
                let greatest = end == 1;
                stops.push(EndStop { joint, greatest });
                let whole = whole.to_mut();
                let contact = ContactId(whole.contacts.len());
                let id = JointId(whole.joints.len());
                let Joint { name, place, .. } = &self.joints[joint.index()];
                // Its normal points from the stop to the block.
                let away = if greatest { -slider.tangent } else { slider.tangent };
                let gap = if greatest { travel[end] } else { -travel[end] };
                let face = face_of(slider, -rot90(away), contact);
                let kind = JointKind::Slider(face);
                whole.joints.push(Joint {
                    name: name.clone(),
                    place: place.clone(),
                    carries: [false; 3],
                    kind,
                });
                whole.contacts.push(contact_of((name, id), restitution, gap));
                if let JointKind::Slider(slider) = &mut whole.joints[joint.index()].kind {
                    slider.stops[end] = None;
                }
            }
        }
        (whole, stops)
    }
}

/// The face of a stop, with this tangent in the drawing.
fn face_of(slider: &Slider, tangent: Vector2<f64>, contact: ContactId) -> Slider {
    Slider {
        kind: SliderKind::Pin,
        tangent,
        length: 0.0,
        height: 0.0,
        apart: Vec::new(),
        sticks: false,
        around: false,
        loose: false,
        travel: None,
        stops: [None; 2],
        contacts: vec![contact],
        ..slider.clone()
    }
}

/// The contact of a stop: its gap is zero at the end of the travel.
fn contact_of((name, joint): (&Arc<str>, JointId), restitution: f64, gap: f64) -> Contact {
    Contact {
        name: name.clone(),
        joint,
        offset: 0.0,
        aside: [0.0; 2],
        lean: None,
        height: None,
        carried_by: CarriedBy::Block,
        mu: [0.0; 2],
        law: [None; 2],
        mu_static: [0.0; 2],
        preload: [0.0; 2],
        preload_line: PreloadLine::Pressed,
        stiffness: None,
        play: 0.0,
        misalignment: 0.0,
        misalignment_law: None,
        pad: None,
        face: None,
        opens: true,
        restitution,
        gap,
    }
}
