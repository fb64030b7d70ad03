//! The corners of bodies as they are drawn, and those with which a body may reach a face where the model has no contact.

use super::{Body, Contact, Mechanism, Shape, Slider, length, rot90};
use crate::ids::{BodyId, Frame, JointId};
use crate::model::SliderKind;
use crate::model::outline::polygon;
use nalgebra::Vector2;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Places closer to each other than this part of the size of the mechanism are one: outlines are typed for looks.
const SAME_PLACE: f64 = 1e-6;

/// A corner or disc of a body that may reach a face on which the body touches elsewhere, and that has no contact there.
#[derive(Debug, Clone)]
pub(crate) struct BareCorner {
    /// Its name.
    pub(crate) name: String,
    /// The joint whose face it is.
    pub(crate) joint: JointId,
    /// The joint that would be there ...
    pub(crate) slider: Slider,
    /// ... and its contact, which is apart from the face in the drawing.
    pub(crate) contact: Contact,
}

impl BareCorner {
    /// Returns whether it lies on the face in the drawing of its mechanism.
    pub(crate) fn is_on_face(&self, mechanism: &Mechanism) -> bool {
        self.contact.gap.abs() <= mechanism.same_place()
    }

    /// The type of a joint that gives it a contact.
    pub(crate) fn wanted(&self) -> &'static str {
        match (&self.slider.round, self.slider.is_disc()) {
            (Some(_), _) => "disc_on_disc",
            (None, true) => "disc_on_face",
            (None, false) => "corner_on_face",
        }
    }
}

impl Mechanism {
    /// The distance within which two places of the drawing are one (m): also that of a corner from the face on which it is drawn.
    pub(crate) fn same_place(&self) -> f64 {
        SAME_PLACE * self.size
    }

    /// Returns the corners of a body that is drawn with corners (m, in the drawing): of its outline, or of its rectangle.
    pub fn corners(&self, id: BodyId) -> Option<Vec<Vector2<f64>>> {
        let body = &self.bodies[id.index()];
        if !body.outline.is_empty() {
            return Some(polygon(&body.outline));
        }
        let Some(Shape::Rectangle([width, height])) = body.shape else { return None };
        let (sin, cos) = self.lean(id).sin_cos();
        let (along, across) =
            (Vector2::new(cos, sin) * (0.5 * width), Vector2::new(-sin, cos) * (0.5 * height));
        let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        Some(signs.map(|(a, b)| body.centre_of_mass + along * a + across * b).to_vec())
    }

    /// Returns by how much (rad) a rectangle is turned in the drawing: it lies along the guide of its body, as the moment of
    /// inertia leaves that open.
    pub fn lean(&self, body: BodyId) -> f64 {
        let of_body = |slider: &&Slider| slider.block == Frame::Body(body) && slider.kind != SliderKind::Pin;
        let mut all = self.sliders().map(|(_, slider)| slider);
        let tangent = all.find(of_body).map_or(Vector2::x(), |slider| slider.tangent);
        let angle = tangent.y.atan2(tangent.x);
        angle - FRAC_PI_2 * (angle / FRAC_PI_2).round()
    }

    /// Returns whether a joint is apart from a face that another joint of its block has, too.
    pub fn is_apart_from_shared_face(&self, joint: JointId) -> bool {
        // In motion all contacts are there, those that are drawn apart, too.
        let is_apart =
            |slider: &Slider| slider.contacts.iter().all(|contact| self.contacts[contact.index()].gap > 0.0);
        let Some(slider) = self.slider(joint).filter(|slider| is_apart(slider)) else { return false };
        let shares = |(other, face): (JointId, &Slider)| {
            other != joint
                && self.may_lift_off(face)
                && self.is_one_face(slider, face)
                && (other < joint || !is_apart(face))
        };
        self.sliders().any(shares)
    }

    /// The corners without contact of each body against each face on which it has one.
    pub(crate) fn bare_corners(&self) -> Vec<BareCorner> {
        let faces: Vec<(JointId, &Slider)> =
            self.sliders().filter(|(_, slider)| self.may_lift_off(slider) && !slider.loose).collect();
        let mut found = Vec::new();
        for (index, &(joint, face)) in faces.iter().enumerate() {
            // A part of a face that another joint has, too, is watched there.
            let covers = |(_, other): &(JointId, &Slider)| {
                let ([from, to], [least, greatest]) = (ends_of(face), ends_of(other));
                let near = self.same_place();
                self.is_one_face(face, other) && least <= from + near && to - near <= greatest
            };
            if faces[..index].iter().any(covers) {
                continue;
            }
            let Some(body) = face.block.body().filter(|_| !self.hangs_on(face)) else { continue };
            let of_face = faces.iter().filter(|(_, other)| self.is_one_face(face, other));
            let contacts: Vec<(Vector2<f64>, f64)> = of_face
                .flat_map(|(_, slider)| self.all_of(slider).map(|one| (one.position(slider), slider.rim())))
                .collect();
            let near = self.same_place();
            let has_contact = |(place, radius): &(Vector2<f64>, f64)| {
                contacts.iter().any(|(centre, rim)| length(place - centre) + radius <= rim + near)
            };
            let bare = self.extremes(body).into_iter().filter(|extreme| !has_contact(extreme));
            let bare = bare.filter_map(|extreme| self.bare_corner((joint, face), body, extreme));
            // What lies on the face between contacts is kept off it by them.
            let places = contacts.iter().map(|(place, _)| place.dot(&face.tangent));
            let [least, greatest] = places
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], place| {
                    [least.min(place), greatest.max(place)]
                });
            let is_between = |corner: &BareCorner| {
                corner.is_on_face(self) && (least..=greatest).contains(&corner.slider.at.dot(&face.tangent))
            };
            found.extend(bare.filter(|corner| !is_between(corner)));
        }
        found
    }

    /// Corners, ends and rims of a body as it is drawn: centres and radii (m). Where it has neither outline nor shape, those of
    /// its points count that are not between others.
    fn extremes(&self, id: BodyId) -> Vec<(Vector2<f64>, f64)> {
        let body = &self.bodies[id.index()];
        let sharp = |place| (place, 0.0);
        match (self.corners(id), body.shape) {
            (Some(corners), _) => corners.into_iter().map(sharp).collect(),
            (None, Some(Shape::Bar(ends))) => ends.map(sharp).to_vec(),
            (None, Some(Shape::Disc(radius))) => vec![(body.centre_of_mass, radius)],
            (None, _) => {
                let places: Vec<Vector2<f64>> = body.points.iter().map(|(_, place)| *place).collect();
                let is_corner = |place: &&Vector2<f64>| is_corner(**place, &places, self.same_place());
                places.iter().filter(is_corner).map(|place| sharp(*place)).collect()
            }
        }
    }

    /// All contacts of a joint that may lift off, those that are apart, too.
    fn all_of<'m>(&'m self, slider: &'m Slider) -> impl Iterator<Item = &'m Contact> {
        slider.contacts.iter().map(|contact| &self.contacts[contact.index()]).chain(&slider.apart)
    }

    /// Returns whether two joints of one block have one face, each perhaps a part of it.
    fn is_one_face(&self, one: &Slider, other: &Slider) -> bool {
        let near = self.same_place();
        let of_same = (one.block, one.guide) == (other.block, other.guide);
        of_same
            && match (&one.round, &other.round) {
                (None, None) => {
                    let off = rot90(one.tangent).dot(&(other.at - one.at)) + self.off_face(one)
                        - self.off_face(other);
                    length(one.tangent - other.tangent) <= SAME_PLACE && off.abs() <= near
                }
                (Some(round), Some(beside)) => {
                    let apart = Vector2::from(round.centre) - Vector2::from(beside.centre);
                    length(apart) <= near && (round.radius - beside.radius).abs() <= near
                }
                _ => false,
            }
    }

    /// The distance of the place of a joint from its straight face in the drawing (m).
    fn off_face(&self, slider: &Slider) -> f64 {
        slider.rim() + self.all_of(slider).next().map_or(0.0, |contact| contact.gap)
    }

    /// The bodies that lie behind a face that they touch, each with the joint of it, and whether only a part does: all that is drawn
    /// of them but what touches, or a corner between the contacts of a base, where the face is for certain. Not what hangs on its
    /// face, beside it: its centre of mass is behind, and its weight presses.
    pub(crate) fn behind_faces(&self) -> Vec<(JointId, BodyId, bool)> {
        let near = self.same_place();
        let behind = |(joint, face): (JointId, &Slider)| {
            let body = face.block.body().filter(|_| self.may_lift_off(face) && !self.hangs_on(face))?;
            let extremes = self.extremes(body);
            let gap = |extreme: &(Vector2<f64>, f64)| self.gap_in_drawing(face, *extreme);
            let offsets = || self.all_of(face).map(|contact| contact.offset);
            let [least, greatest] = [offsets().fold(0.0, f64::min), offsets().fold(0.0, f64::max)];
            let is_over_base = |(place, _): &(Vector2<f64>, f64)| {
                let along = face.tangent.dot(&(place - face.at));
                greatest > least && least - near <= along && along <= greatest + near && face.round.is_none()
            };
            let is_behind = |extreme: &&(Vector2<f64>, f64)| gap(extreme) < -near;
            let partly = extremes.iter().any(|extreme| gap(extreme) > near);
            let warns = if partly {
                extremes.iter().filter(is_behind).any(is_over_base)
            } else {
                extremes.iter().any(|extreme| is_behind(&extreme))
            };
            warns.then_some((joint, body, partly))
        };
        self.sliders().filter_map(behind).collect()
    }

    /// Whether the weight of a block presses it on a straight face that is above its centre of mass in the drawing.
    fn hangs_on(&self, face: &Slider) -> bool {
        let Some(body) = face.block.body().filter(|_| face.round.is_none()) else { return false };
        let (body, away) = (&self.bodies[body.index()], rot90(face.tangent));
        let weight = body.mass * away.dot(&self.gravity);
        weight < 0.0 && self.gap_in_drawing(face, (body.centre_of_mass, 0.0)) < 0.0
    }

    /// The distance of a corner or rim from a face in the drawing (m).
    fn gap_in_drawing(&self, face: &Slider, (place, radius): (Vector2<f64>, f64)) -> f64 {
        match &face.round {
            None => rot90(face.tangent).dot(&(place - face.at)) + self.off_face(face) - radius,
            Some(round) => {
                let distance = length(place - Vector2::from(round.centre));
                if round.inside { round.radius - radius - distance } else { distance - round.radius - radius }
            }
        }
    }

    /// A corner against a face; none where the body overlaps the face in the drawing already.
    fn bare_corner(
        &self,
        (joint, face): (JointId, &Slider),
        body: BodyId,
        (place, radius): (Vector2<f64>, f64),
    ) -> Option<BareCorner> {
        let gap = self.gap_in_drawing(face, (place, radius));
        if gap < -self.same_place() {
            return None;
        }
        let contact = self.all_of(face).next()?;
        let along = face.tangent.dot(&place);
        let slider = Slider {
            kind: SliderKind::Pin,
            at: place,
            height: 2.0 * radius,
            travel: face.travel.map(|_| ends_of(face).map(|end| end - along)),
            ..face.clone()
        };
        let contact = Contact { offset: 0.0, gap, ..contact.clone() };
        Some(BareCorner {
            name: self.name_of_corner(&self.bodies[body.index()], (place, radius)),
            joint,
            slider,
            contact,
        })
    }

    /// "ladder.head", "the corner of ladder at (2 m, 3 m) in the drawing" or "the rim of wheel".
    fn name_of_corner(&self, body: &Body, (place, radius): (Vector2<f64>, f64)) -> String {
        if radius > 0.0 {
            return format!("the rim of {}", body.name);
        }
        let is_here = |(_, point): &&(_, Vector2<f64>)| length(place - point) <= self.same_place();
        if let Some((point, _)) = body.points.iter().find(is_here) {
            return format!("{}.{point}", body.name);
        }
        let unit = self.units.of("m");
        let [x, y] = [place.x, place.y].map(|value| unit.brief(value));
        format!("the corner of {} at ({x}, {y}) in the drawing", body.name)
    }
}

/// Where a straight face begins and ends along its tangent in the drawing (m), infinite where it has no ends.
fn ends_of(face: &Slider) -> [f64; 2] {
    let at = face.tangent.dot(&face.at);
    face.face_ends().map(|end| at + end)
}

/// Returns whether a place is a corner of what lies between several places, each nearer than `near` counting as it: in some
/// directions, more than half of all, there is none of the others.
fn is_corner(place: Vector2<f64>, places: &[Vector2<f64>], near: f64) -> bool {
    let others = places.iter().map(|other| other - place).filter(|way| length(*way) > near);
    let mut directions: Vec<f64> = others.map(|way| way.y.atan2(way.x)).collect();
    directions.sort_unstable_by(f64::total_cmp);
    let round = directions.first().map(|first| first + TAU);
    let next = directions.iter().copied().skip(1).chain(round);
    directions.is_empty() || directions.iter().zip(next).any(|(one, next)| next - one > PI + SAME_PLACE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_between_others_is_no_corner() {
        let places = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [1.0, 1.0], [0.7, 0.3]].map(Vector2::from);
        let corners = places.iter().filter(|place| is_corner(**place, &places, 1e-9)).count();
        assert_eq!(corners, 3);
        assert!(is_corner(places[0], &places[..1], 1e-9) && is_corner(places[0], &places[..2], 1e-9));
    }
}
