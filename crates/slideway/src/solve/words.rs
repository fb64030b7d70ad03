//! Contact modes in words: which face of its guide a slider touches, and where.
//!
//! Faces are named by where they lie as one looks at the drawing: lower and upper for a guide that is nearer
//! to the horizontal, left and right for one that is nearer to the vertical.

use crate::ids::ContactId;
use crate::mechanism::{Contact, Mechanism, Slider};
use crate::model::SliderKind;
use crate::report::{ModeInWords, OnFace};
use nalgebra::Vector2;

/// The contact mode of a sliding joint.
///
/// `signs` are the signs of its normal forces, 0 where one vanishes; `tangent` is the direction of its guide.
pub fn mode_in_words(slider: &Slider, tangent: Vector2<f64>, signs: &[i8]) -> String {
    let guide = GuideInWords { tangent, around: slider.around };
    match (slider.kind, signs) {
        (_, signs) if signs.iter().all(|sign| *sign == 0) => "no contact force".to_owned(),
        (SliderKind::Pin, [sign, ..]) => format!("on the {} side of the slot", guide.face(*sign)),
        (SliderKind::Block, [front, rear]) => match (front, rear) {
            (0, sign) => format!("on the {} corner only", guide.corner(*sign, -1.0)),
            (sign, 0) => format!("on the {} corner only", guide.corner(*sign, 1.0)),
            (front, rear) if front == rear => guide.flat(*front),
            (front, rear) => {
                format!("touching at {} and {}", guide.corner(*front, 1.0), guide.corner(*rear, -1.0))
            }
        },
        (_, [sign, ..]) => guide.flat(*sign),
        (_, []) => String::new(),
    }
}

/// The contact mode of a sliding joint, as [`mode_in_words`] has it; of one that shares its load with others
/// and has other contacts than the two ends of a block, what each of them does, "open" where its normal force is 0. Press fits
/// are on one face or on both. On a face that it may leave what it does there, and the corner that stays.
pub(crate) fn joint_mode(
    mechanism: &Mechanism,
    slider: &Slider,
    tangent: Vector2<f64>,
    signs: &[i8],
) -> ModeInWords {
    if mechanism.space.is_some() && slider.kind == SliderKind::Block && !mechanism.may_lift_off(slider) {
        return in_cross_section(mechanism, slider, tangent, signs);
    }
    if slider.contacts.iter().any(|contact| mechanism.contacts[contact.index()].opens) {
        let (face, place) = GuideInWords { tangent, around: slider.around }.on_face(signs);
        return ModeInWords { face: Some(face), place, line: None };
    }
    ModeInWords { place: on_guide(mechanism, slider, tangent, signs), ..ModeInWords::default() }
}

/// A contact with the sign of its normal force.
type Pressed<'a> = (&'a Contact, i8);

/// The contact mode in space: the contacts whose normals lie in the drawing as in the plane, then on which of the others the
/// block rests, from which it hangs, and how it is turned where it does both; where it lifts off, and about which line it tips
/// then.
fn in_cross_section(
    mechanism: &Mechanism,
    slider: &Slider,
    tangent: Vector2<f64>,
    signs: &[i8],
) -> ModeInWords {
    let guide = GuideInWords { tangent, around: slider.around };
    let all = slider.contacts.iter().zip(signs.iter().copied());
    let flat = all.filter(|(contact, _)| !mechanism.is_part_of_end(contact.index()));
    let (leaning, upright): (Vec<Pressed<'_>>, Vec<Pressed<'_>>) = flat
        .map(|(contact, sign)| (&mechanism.contacts[contact.index()], sign))
        .partition(|(contact, _)| contact.lean.is_some());
    let mut words: Vec<String> = on_rod(mechanism, slider, &guide, signs).into_iter().collect();
    words.extend(match upright.as_slice() {
        [] => Vec::new(),
        [(_, 0), (_, 0)] if leaning.iter().any(|(_, sign)| *sign != 0) => Vec::new(),
        [(first, front), (second, rear)] if !first.opens && !second.opens => {
            vec![mode_in_words(slider, tangent, &[*front, *rear])]
        }
        more => {
            let place = |(contact, sign): &Pressed<'_>| match sign {
                0 => "without force".to_owned(),
                -1 if contact.opens => "off its face".to_owned(),
                sign => format!("on the {} face", guide.face(*sign)),
            };
            more.iter().map(|pressed| format!("{} {}", pressed.0.place_in_joint(), place(pressed))).collect()
        }
    });
    let [rests, hangs, lifts] = [(1, false), (-1, false), (-1, true)].map(|(side, opens)| {
        let does = |(contact, sign): &&Pressed<'_>| *sign == side && (side == 1 || contact.opens == opens);
        leaning.iter().filter(does).map(|(contact, _)| *contact).collect::<Vec<_>>()
    });
    let named = |contacts: &[&Contact], between: &str| {
        contacts.iter().map(|contact| contact.place_in_joint()).collect::<Vec<_>>().join(between)
    };
    for (verb, contacts) in [("resting on", &rests), ("hanging from", &hangs), ("lifting off at", &lifts)] {
        words.extend((!contacts.is_empty()).then(|| format!("{verb} {}", named(contacts, ", "))));
    }
    let differ = |distance: &dyn Fn(&Contact) -> f64| {
        let mean = |contacts: &[&Contact]| {
            contacts.iter().map(|one| distance(one)).sum::<f64>() / contacts.len() as f64
        };
        (mean(&rests) - mean(&hangs)).abs() > 1e-9 * mechanism.size
    };
    if !rests.is_empty() && !hangs.is_empty() {
        words.extend(differ(&|contact| contact.offset).then(|| "pitched".to_owned()));
        words.extend(differ(&|contact| contact.aside[0]).then(|| "rolled".to_owned()));
    }
    let mut opening = slider.contacts.iter().zip(signs);
    let opens = opening.any(|(contact, sign)| *sign == -1 && mechanism.contacts[contact.index()].opens);
    let holds = !rests.is_empty() || !hangs.is_empty();
    let face = opens.then_some(if holds { OnFace::Tips } else { OnFace::Opens });
    let line = (rests.len() == 2 && hangs.is_empty()).then(|| named(&rests, " - "));
    ModeInWords { face, place: words.join(", "), line }
}

/// Where the ends of a block are pushed by a round rod, if it is on one.
fn on_rod(mechanism: &Mechanism, slider: &Slider, guide: &GuideInWords, signs: &[i8]) -> Option<String> {
    let sign = |contact: ContactId| {
        let place = slider.contacts.iter().position(|other| *other == contact)?;
        signs.get(place).copied()
    };
    let pushed = |end: [ContactId; 2]| {
        let [along_n, along_z] = end.map(sign);
        let name = mechanism.contacts[end[0].index()].place_in_joint();
        Some((name, guide.pushed(along_n?, along_z?)))
    };
    let is_of_slider = |end: &[ContactId; 2]| slider.contacts.contains(&end[0]);
    let ends = mechanism.friction_circles.iter().filter_map(|circle| circle.end).filter(is_of_slider);
    let ends: Vec<(&str, String)> = ends.filter_map(pushed).collect();
    let [(_, first), others @ ..] = ends.as_slice() else { return None };
    if others.iter().all(|(_, towards)| towards == first) {
        return Some(format!("pushed {first} by the rod"));
    }
    let each: Vec<String> = ends.iter().map(|(name, towards)| format!("{name} {towards}")).collect();
    Some(format!("pushed by the rod: {}", each.join(", ")))
}

fn on_guide(mechanism: &Mechanism, slider: &Slider, tangent: Vector2<f64>, signs: &[i8]) -> String {
    let guide = GuideInWords { tangent, around: slider.around };
    if !slider.contacts.iter().any(|contact| mechanism.excess.shares(*contact)) {
        return mode_in_words(slider, tangent, signs);
    }
    let first = slider.contacts.first().map_or(0, |contact| contact.index());
    let of_place = |contact: ContactId| {
        let Contact { face, .. } = &mechanism.contacts[contact.index()];
        let sign = |contact: ContactId| signs.get(contact.index() - first).copied().unwrap_or_default();
        match face.map(|face| [sign(contact), sign(face.other)]) {
            Some([1, -1]) => None,
            Some([-1, 1]) => Some(0),
            // Where the force of a face vanishes the other one tells.
            Some([0, sign] | [sign, _]) => Some(sign),
            None => Some(sign(contact)),
        }
    };
    let contacts: Vec<(&str, Option<i8>)> = mechanism
        .places_of(slider)
        .map(|contact| (mechanism.contacts[contact.index()].place(), of_place(contact)))
        .collect();
    // Two ends on a face each, or one in the air, are the corners of a block as anywhere else.
    if let (SliderKind::Block, [(_, Some(front)), (_, Some(rear))]) = (slider.kind, contacts.as_slice())
        && [*front, *rear] != [0; 2]
    {
        return mode_in_words(slider, tangent, &[*front, *rear]);
    }
    let place = |sign: Option<i8>| match (slider.kind, sign) {
        (_, Some(0)) => "open".to_owned(),
        (SliderKind::Pin, Some(sign)) => format!("on the {} side of the slot", guide.face(sign)),
        (SliderKind::Pin, None) => "on both sides of the slot".to_owned(),
        (_, Some(sign)) => format!("on the {} face", guide.face(sign)),
        (_, None) => "on both faces".to_owned(),
    };
    match contacts.as_slice() {
        [(_, sign)] => place(*sign),
        [(_, first), others @ ..] if others.iter().all(|(_, sign)| sign == first) => match first {
            Some(sign) if *sign != 0 => guide.flat(*sign),
            _ => place(*first),
        },
        _ => {
            let each = contacts.iter().map(|(contact, sign)| format!("{} {}", end_of(contact), place(*sign)));
            each.collect::<Vec<_>>().join(", ")
        }
    }
}

/// The name of a contact within its joint.
fn end_of(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(_, end)| end)
}

impl Contact {
    fn place_in_joint(&self) -> &str {
        end_of(&self.name)
    }
}

struct GuideInWords {
    tangent: Vector2<f64>,
    around: bool,
}

impl GuideInWords {
    fn is_vertical(&self) -> bool {
        // A guide at exactly 45 degrees, within rounding, counts as horizontal.
        self.tangent.y.abs() > self.tangent.x.abs() * (1.0 + 1e-9)
    }

    /// What a corner or a block does on a face that it may leave, and where it stays there.
    fn on_face(&self, signs: &[i8]) -> (OnFace, String) {
        match signs {
            [-1] | [-1, -1] => (OnFace::Opens, String::new()),
            [0] | [0, 0] => (OnFace::Closed, "without contact force".to_owned()),
            [-1, _] => (OnFace::Tips, format!("on its {} corner", self.end(-1.0))),
            [_, -1] => (OnFace::Tips, format!("on its {} corner", self.end(1.0))),
            _ => (OnFace::Closed, String::new()),
        }
    }

    /// Where a rod pushes the block: "up and out of the drawing".
    fn pushed(&self, along_n: i8, along_z: i8) -> String {
        // n = rot90(u) = (-u_y, u_x)
        let n = f64::from(along_n) * if self.is_vertical() { -self.tangent.y } else { self.tangent.x };
        let in_drawing = match (self.is_vertical(), n) {
            (_, 0.0) => None,
            (true, n) => Some(if n > 0.0 { "right" } else { "left" }),
            (false, n) => Some(if n > 0.0 { "up" } else { "down" }),
        };
        let across = match along_z {
            0 => None,
            sign => Some(if sign > 0 { "out of the drawing" } else { "into the drawing" }),
        };
        match (in_drawing, across) {
            (Some(one), Some(other)) => format!("{one} and {other}"),
            (one, other) => one.or(other).unwrap_or("nowhere").to_owned(),
        }
    }

    fn flat(&self, sign: i8) -> String {
        let face = self.face(sign);
        if self.around {
            format!("flat on the {face} face of the guide")
        } else {
            format!("flat on the {face} guide")
        }
    }

    /// The face that presses: on the side opposite to the normal force, or on the same side for a block that
    /// surrounds its guide.
    fn face(&self, sign: i8) -> &'static str {
        let towards = f64::from(sign) * if self.around { 1.0 } else { -1.0 };
        // n = rot90(u) = (-u_y, u_x)
        if self.is_vertical() {
            if -self.tangent.y * towards > 0.0 { "right" } else { "left" }
        } else if self.tangent.x * towards > 0.0 {
            "upper"
        } else {
            "lower"
        }
    }

    /// The end of the block in the direction of the tangent (`end` = 1) or against it (-1).
    fn end(&self, end: f64) -> &'static str {
        if self.is_vertical() {
            if self.tangent.y * end > 0.0 { "upper" } else { "lower" }
        } else if self.tangent.x * end > 0.0 {
            "right"
        } else {
            "left"
        }
    }

    fn corner(&self, sign: i8, end: f64) -> String {
        let (face, end) = (self.face(sign), self.end(end));
        if self.is_vertical() { format!("{end} {face}") } else { format!("{face} {end}") }
    }
}
