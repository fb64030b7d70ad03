//! Faces of guides that share a load: each lies where its play and misalignment have it, and gives way where it
//! is pressed.

use super::Painter;
use super::looks::Look;
use super::outline::{Local, upper_side};
use super::scene::{Class, Point};
use super::slide::{Slide, Station, WALL};
use slideway::ids::ContactId;
use slideway::mechanism::Slider;
use slideway::model::CarriedBy;

/// Over what length beyond the outermost contact a face that gave way comes back to where it was.
const TAPER: f64 = 14.0;
/// Half the length and the depth of a pad of a block with more than two.
const HALF_PAD: f64 = 6.0;
const PAD_DEPTH: f64 = 4.0;

/// Values at places along a line, and straight between them.
struct Polyline(Vec<[f64; 2]>);

impl Polyline {
    /// The value at a place; beyond the ends as at them, or on along the last pieces.
    fn at(&self, along: f64, goes_on: bool) -> f64 {
        let between = |[from, to]: [[f64; 2]; 2]| {
            let run = to[0] - from[0];
            if run > 0.0 { from[1] + (to[1] - from[1]) * (along - from[0]) / run } else { to[1] }
        };
        let (Some(first), Some(last)) = (self.0.first(), self.0.last()) else { return 0.0 };
        if !goes_on && (along <= first[0] || along >= last[0]) {
            return if along <= first[0] { first[1] } else { last[1] };
        }
        let mut pieces = self.0.windows(2).map(|piece| [piece[0], piece[1]]);
        let piece = pieces.clone().find(|piece| along <= piece[1][0]).or(pieces.next_back());
        piece.map_or(first[1], between)
    }
}

impl Slide {
    /// From a place along the outer part to that along the guide.
    fn shift(&self) -> f64 {
        if self.around { (self.block.origin - self.guide.origin).dot(&self.guide.along) } else { 0.0 }
    }

    fn polyline(&self, value: impl Fn(&Station) -> f64) -> Polyline {
        Polyline(self.stations.iter().map(|station| [station.along, value(station)]).collect())
    }

    /// How far the line of the guide is displaced at a place along it.
    fn offset(&self, along: f64) -> f64 {
        self.polyline(|station| station.offset).at(along, true)
    }

    /// How far a face (`side` is 1 or -1) lies across the outer part at a place along it.
    pub(super) fn outer_face(&self, along: f64, side: f64) -> f64 {
        if self.stations.is_empty() {
            return side * self.half_channel();
        }
        let along = along + self.shift();
        // A sleeve is pressed where the rod is, on the other side of its own displacement.
        let pressed = if self.around { -side } else { side };
        let mut dents = self.polyline(|station| (pressed * station.yielding).max(0.0));
        if let [first, .., last] = self.stations[..] {
            dents.0.insert(0, [first.along - TAPER, 0.0]);
            dents.0.push([last.along + TAPER, 0.0]);
        }
        let clearance = self.polyline(|station| station.clearance).at(along, false);
        let offset = if self.around { 0.0 } else { self.offset(along) };
        offset + side * (0.5 * self.height + clearance + dents.at(along, false))
    }

    /// A face of the outer part from one place along it to another, `beyond` further out.
    pub(super) fn face_line(&self, [from, to]: [f64; 2], side: f64, beyond: f64) -> Vec<Point> {
        let (_, local, _) = self.outer();
        let mut places = vec![from];
        places.extend(self.bends().map(|along| along - self.shift()).filter(|at| from < *at && *at < to));
        places.push(to);
        let at = |along: f64| local.at(along, self.outer_face(along, side) + side * beyond);
        places.into_iter().map(at).collect()
    }

    /// Returns the outline of the space between the faces of the outer part, or `beyond` further out.
    pub(super) fn between_faces(&self, reach: [f64; 2], beyond: f64) -> Vec<Point> {
        let mut outline = self.face_line(reach, -1.0, beyond);
        outline.extend(self.face_line(reach, 1.0, beyond).into_iter().rev());
        outline
    }

    /// A face of the guide, where that is the inner part.
    pub(super) fn rod_line(&self, [from, to]: [f64; 2], side: f64) -> Vec<Point> {
        let mut places = vec![from];
        places.extend(self.bends().filter(|at| from < *at && *at < to));
        places.push(to);
        places.into_iter().map(|along| self.guide.at(along, self.inner_face(along, side))).collect()
    }

    /// The guide, where that is the inner part.
    pub(super) fn rod(&self, reach: [f64; 2]) -> Vec<Point> {
        let mut outline = self.rod_line(reach, -1.0);
        outline.extend(self.rod_line(reach, 1.0).into_iter().rev());
        outline
    }

    /// How far a face lies across the inner part at a place along it.
    pub(super) fn inner_face(&self, along: f64, side: f64) -> f64 {
        let offset = if self.around { self.offset(along) } else { 0.0 };
        offset + side * 0.5 * self.height
    }

    /// The end of the guide at a place along it, as the origin of its frame.
    pub(super) fn guide_end(&self, along: f64) -> Local {
        Local { origin: self.guide.origin + self.guide.across * self.offset(along), ..self.guide }
    }

    /// Where faces bend, along the guide.
    fn bends(&self) -> impl Iterator<Item = f64> {
        let first = self.stations.first().map(|station| station.along - TAPER);
        let last = self.stations.last().map(|station| station.along + TAPER);
        first.into_iter().chain(self.stations.iter().map(|station| station.along)).chain(last)
    }
}

impl Painter<'_> {
    /// Returns the geometry of a joint's guide at its contacts, along the guide; empty unless they share a
    /// load.
    pub(super) fn stations(&self, slider: &Slider, guide: &Local) -> Vec<Station> {
        let Some(magnification) = self.magnification.filter(|_| self.states.has_deflections(slider)) else {
            return Vec::new();
        };
        let units = magnification * self.view.scale;
        let station = |id: ContactId| {
            let contact = &self.mechanism.contacts[id.index()];
            let clearance = 0.5 * contact.play.max(0.0) * units;
            let deflection = self.states.deflection(self.mechanism, id) * units;
            Station {
                along: (self.contact_place(id) - guide.origin).dot(&guide.along),
                offset: contact.misalignment * units,
                clearance,
                yielding: (deflection.abs() - clearance).max(0.0) * deflection.signum(),
            }
        };
        let mut stations: Vec<Station> = self.mechanism.places_of(slider).map(station).collect();
        stations.sort_by(|one, other| one.along.total_cmp(&other.along));
        stations
    }

    pub(super) fn contact_place(&self, contact: ContactId) -> Point {
        self.view.place(self.configuration.contact(self.mechanism, contact).point)
    }

    /// The place of a face (`side` is 1 where the block is pressed towards +n, -1 where towards -n) at a contact,
    /// as it is drawn: on whatever carries the contact; in the middle of that if it is not pressed at all.
    pub(super) fn face(&self, slide: &Slide, contact: ContactId, side: f64) -> Point {
        if self.mechanism.contacts[contact.index()].lean.is_some() {
            return self.contact_place(contact);
        }
        let is_of_block = self.mechanism.contacts[contact.index()].carried_by == CarriedBy::Block;
        let carrier = match (is_of_block, slide.is_disc) {
            (false, _) => slide.guide,
            (true, false) => slide.block,
            // It turns under its contact.
            (true, true) => Local { origin: slide.block.origin, ..slide.guide },
        };
        let along = (self.contact_place(contact) - carrier.origin).dot(&carrier.along);
        if side == 0.0 {
            return carrier.at(along, 0.0);
        }
        let side = if slide.around { side.signum() } else { -side.signum() };
        let is_outer = is_of_block == slide.around;
        let face = if is_outer { slide.outer_face(along, side) } else { slide.inner_face(along, side) };
        carrier.at(along, face)
    }

    /// The word "open" at each contact that touches neither face.
    pub(super) fn open_contacts(&mut self) {
        for index in 0..self.states.contacts.len().min(self.mechanism.contacts.len()) {
            let joint = self.mechanism.contacts[index].joint;
            if let Some(slide) = self.slide(joint).filter(|_| self.states.contacts[index].is_open) {
                let (_, outer, _) = slide.outer();
                let side = upper_side(outer.across);
                let along = (self.contact_place(ContactId(index)) - outer.origin).dot(&outer.along);
                let face = outer.at(along, slide.outer_face(along, side));
                self.value(Class::Words, "open".to_owned(), face, outer.across * side);
            }
        }
    }

    /// The pads of blocks that have more than two.
    pub(super) fn supports(&mut self) {
        let mechanism = self.mechanism;
        let has_supports = |slider: &Slider| mechanism.places_of(slider).count() > 2;
        for (joint, slider) in mechanism.sliders().filter(|(_, slider)| has_supports(slider)) {
            let Some(slide) = self.slide(joint).filter(|slide| slide.look != Look::Rollers) else { continue };
            let faced = if let Look::Face(side) = slide.look { side } else { 0.0 };
            for contact in mechanism.places_of(slider) {
                for side in [1.0, -1.0].into_iter().filter(|side| side * faced >= 0.0) {
                    let pad = self.support_pad(&slide, contact, side);
                    self.area(Class::Pad, pad);
                }
            }
        }
    }

    /// A pad on what carries a contact, with its face where the block is pressed to that side.
    fn support_pad(&self, slide: &Slide, contact: ContactId, side: f64) -> Vec<Point> {
        let is_of_block = self.mechanism.contacts[contact.index()].carried_by == CarriedBy::Block;
        let carrier = if is_of_block { slide.block } else { slide.guide };
        let is_outer = is_of_block == slide.around;
        let outwards = if slide.around { side } else { -side };
        let depth = if is_outer { PAD_DEPTH.min(WALL) } else { -PAD_DEPTH.min(0.25 * slide.height) };
        let local = Local { origin: self.face(slide, contact, side), ..carrier };
        let along = (local.origin - carrier.origin).dot(&carrier.along);
        let [from, to] = if is_of_block { slide.block_reach } else { slide.guide_reach };
        let reach = [(-HALF_PAD).max(from - along), HALF_PAD.min(to - along)];
        local.rectangle(reach, [0.0, outwards * depth])
    }
}
