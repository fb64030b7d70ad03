//! Hinges and the three sliding joints.

use super::super::file::{
    CarriedBy, Closed, ContactTable, End, Entry, Fit, PadTable, PreloadLine, RestsOnTable, SliderCarries,
    SliderTable, StopTable,
};
use super::super::quantity::{Direction, PerSide, Quantity, Span};
use super::super::sections::{JointContents, SliderContents};
use super::super::{
    Along, Contact, HingeFriction, Joint, JointKind, Pad, RoundEnd, Slider, SliderKind, Stop, Touches,
};
use super::{Reader, Varies, Wanted};
use crate::expression::Dimension;
use crate::fault::{FaultKind, Place as FaultPlace};
use crate::ids::FormulaId;
use std::sync::Arc;

/// Which contacts of a joint touch.
fn touches(joint: &SliderTable) -> Touches {
    match joint.closed {
        None | Some(Closed::All(true)) => Touches::All,
        Some(Closed::All(false)) => Touches::Nothing,
        Some(Closed::One([End::Front])) => Touches::Front,
        Some(Closed::One([End::Rear])) => Touches::Rear,
    }
}

/// What a sliding joint carries out of the drawing, if it says so.
fn carried(contents: &JointContents) -> Option<[bool; 3]> {
    match contents {
        JointContents::Slider(slider) => slider.joint.carries.as_ref().map(|carries| {
            [SliderCarries::Z, SliderCarries::Roll, SliderCarries::Pitch].map(|one| carries.contains(&one))
        }),
        JointContents::Hinge(_) | JointContents::DiscOnDisc(_) => None,
    }
}

/// The friction of one contact, and its other properties, as they were read.
#[derive(Clone, Copy, Default)]
pub(super) struct ReadFriction {
    mu: Option<[FormulaId; 2]>,
    mu_static: Option<[FormulaId; 2]>,
    preload: Option<[FormulaId; 2]>,
    preload_line: Option<PreloadLine>,
    stiffness: Option<FormulaId>,
    play: Option<FormulaId>,
    misalignment: Option<FormulaId>,
    restitution: Option<FormulaId>,
    pad: Option<Pad>,
    carried_by: Option<CarriedBy>,
}

impl ReadFriction {
    /// Completes the properties written at the end of a block by those of the joint; the former win.
    fn or(self, joint: Self) -> Self {
        Self {
            mu: self.mu.or(joint.mu),
            mu_static: self.mu_static.or(joint.mu_static),
            preload: self.preload.or(joint.preload),
            preload_line: self.preload_line.or(joint.preload_line),
            stiffness: self.stiffness.or(joint.stiffness),
            play: self.play.or(joint.play),
            misalignment: self.misalignment.or(joint.misalignment),
            restitution: self.restitution.or(joint.restitution),
            pad: self.pad.or(joint.pad),
            carried_by: self.carried_by,
        }
    }
}

impl Reader<'_> {
    pub(super) fn read_joints(&mut self, entries: Vec<Entry<JointContents>>) -> Vec<Joint> {
        let mut joints = Vec::new();
        for entry in entries {
            self.valid_name("joint", &entry.name, &entry.span);
            let kind = match &entry.contents {
                None => continue,
                Some(JointContents::Hinge(table)) => {
                    let place = FaultPlace::model(entry.span.clone());
                    let bearings = self.bearings(table, &entry.name, &entry.span).into_iter();
                    joints.extend(bearings.map(|(end, carries, hinge)| Joint {
                        name: Arc::from(entry.name.clone() + end),
                        place: place.clone(),
                        carries,
                        kind: JointKind::Hinge(Box::new(hinge)),
                    }));
                    continue;
                }
                Some(JointContents::Slider(slider)) => {
                    JointKind::Slider(Box::new(self.slider(slider, &entry.name, &entry.span)))
                }
                Some(JointContents::DiscOnDisc(discs)) => {
                    JointKind::Slider(Box::new(self.disc_on_disc(discs, &entry.name, &entry.span)))
                }
            };
            let carries = entry.contents.as_ref().and_then(carried);
            let place = FaultPlace::model(entry.span);
            joints.push(Joint { name: Arc::from(entry.name), place, carries, kind });
        }
        joints
    }

    fn slider(&mut self, written: &SliderContents, name: &str, span: &Span) -> Slider {
        let SliderContents { kind, opens, joint, contacts } = written;
        let all = self.friction(contacts, *kind == SliderKind::Guided, name, span);
        let mut contacts = match kind {
            SliderKind::Block => self.contacts_of_block(joint, all, name, span),
            SliderKind::Guided | SliderKind::Pin => vec![self.contact(all, name.to_owned(), name, span)],
        };
        let ends = if joint.section.is_some() {
            self.round_ends(joint, &mut contacts, name, span)
        } else {
            Vec::new()
        };
        self.check_loose(joint, &contacts, (*opens, name, span));
        let touches = touches(joint);
        let apart = if *opens { self.open(&mut contacts, touches) } else { Vec::new() };
        let length = Wanted::constant(format!("the length of {name}"), Dimension::LENGTH).positive();
        let (at, z) = self.place_in_space(&joint.at, &format!("the place of {name}"));
        Slider {
            kind: *kind,
            block: self.frame(&joint.block),
            guide: self.frame_or_ground(joint.guide.as_ref()),
            at,
            z,
            along: self.along_of(joint, name, span),
            length: joint.length.as_ref().map(|quantity| self.formula(quantity, length)),
            height: self.height(joint.height.as_ref(), name),
            radius: joint.radius.as_ref().map(|radius| self.radius(radius, name)),
            round: None,
            touches,
            sticks: self.sticks(joint.sticks, touches, name, span),
            around: joint.fit == Some(Fit::Around),
            loose: joint.loose == Some(true),
            travel: self.travel(joint.travel.as_ref(), name),
            has_ends: joint.face.is_some(),
            stops: self.stops(joint, name, span),
            contacts,
            apart,
            ends,
        }
    }

    /// Checks that a guide whose faces are taken one by one has play and nothing that needs both at once, and that no other has
    /// impacts at its faces.
    fn check_loose(
        &mut self,
        joint: &SliderTable,
        contacts: &[Contact],
        (opens, name, span): (bool, &str, &Span),
    ) {
        let table = format!("joints.{name}");
        let any = |has: &dyn Fn(&Contact) -> bool| contacts.iter().any(has);
        if joint.loose != Some(true) {
            if !opens && any(&|contact| contact.restitution.is_some()) {
                self.fault(FaultKind::MissingKey { key: "loose".into(), table }, span);
            }
            return;
        }
        if any(&|contact| contact.play.is_none()) {
            self.fault(FaultKind::MissingKey { key: "play".into(), table }, span);
        }
        for misalignment in contacts.iter().filter_map(|contact| contact.misalignment) {
            self.formulas[misalignment.index()].varies = Varies::Never;
        }
        let both = [
            ("stiffness", any(&|contact| contact.stiffness.is_some())),
            ("preload", any(&|contact| contact.preload != [None; 2])),
            ("supports", joint.supports.is_some()),
            ("travel", joint.travel.is_some()),
        ];
        for (second, _) in both.into_iter().filter(|(_, is_there)| *is_there) {
            self.fault(FaultKind::Both { owner: name.to_owned(), first: "loose = true", second }, span);
        }
    }

    /// The direction of a joint: its own, or from one end of its face to the other.
    fn along_of(&mut self, joint: &SliderTable, name: &str, span: &Span) -> Along {
        let what = format!("the direction of {name}");
        let kind = match (&joint.along, &joint.face) {
            (Some(along), None) => return self.along(along, &what),
            (None, Some(ends)) => return self.along(&Direction::Points(ends.clone()), &what),
            (Some(_), Some(_)) => FaultKind::Both { owner: name.to_owned(), first: "along", second: "face" },
            (None, None) => FaultKind::NoneOf { owner: name.to_owned(), one_of: vec!["along", "face"] },
        };
        self.fault(kind, span);
        Along::Angle(self.broken(span))
    }

    /// The contacts at both ends of a block, then its further ones: what stands at one wins over what all have.
    fn contacts_of_block(
        &mut self,
        joint: &SliderTable,
        all: ReadFriction,
        name: &str,
        span: &Span,
    ) -> Vec<Contact> {
        let nothing = ContactTable::default();
        let ends = [("front", &joint.front), ("rear", &joint.rear)];
        let ends = ends.map(|(end, table)| (end, table.as_ref().unwrap_or(&nothing)));
        let supports = joint.supports.iter().flatten().map(|(support, table)| (support.as_str(), table));
        let mut contacts: Vec<Contact> = Vec::new();
        for (place, table) in ends.into_iter().chain(supports) {
            self.valid_name("support", place, span);
            let contact = format!("{name}.{place}");
            self.new_contact(&contacts, &contact, span);
            let friction = self.friction(table, false, &contact, span).or(all);
            let wanted = Wanted::constant(format!("the place of {contact}"), Dimension::LENGTH);
            let offset = table.at.as_ref().map(|at| self.formula(at, wanted));
            let of = |what: &str, dimension| Wanted::constant(format!("the {what} of {contact}"), dimension);
            let mut read = |written: &Option<Quantity>, wanted: Wanted| {
                written.as_ref().map(|written| self.formula(written, wanted))
            };
            let aside = [
                read(&table.aside, of("distance aside", Dimension::LENGTH)),
                read(&table.z, of("distance along z", Dimension::LENGTH)),
            ];
            let normal = read(&table.normal, of("normal", Dimension::ANGLE));
            let height = read(&table.height, of("height", Dimension::LENGTH).not_negative());
            let mut rest = self.contact(friction, contact, name, span);
            if table.one_sided == Some(true) {
                self.make_one_sided(&mut rest, span);
            }
            contacts.push(Contact { offset, aside, normal, height, ..rest });
        }
        if let Some(rests_on) = &joint.rests_on {
            self.corners(rests_on, all, (&mut contacts, name, span));
        }
        contacts
    }

    /// Refuses the name of a contact that another one of its block has.
    fn new_contact(&mut self, contacts: &[Contact], name: &str, span: &Span) {
        if contacts.iter().any(|other| *other.name == *name) {
            self.fault(FaultKind::SharedContact { name: name.to_owned() }, span);
        }
    }

    /// The corners by which a block rests on its guide, behind its other contacts.
    fn corners(
        &mut self,
        written: &RestsOnTable,
        all: ReadFriction,
        (contacts, name, span): (&mut Vec<Contact>, &str, &Span),
    ) {
        let of =
            |what: &str| Wanted::constant(format!("the {what} of the corners of {name}"), Dimension::LENGTH);
        let width = self.formula(&written.width, of("width").positive());
        let length = written.length.as_ref().map(|length| self.formula(length, of("length").positive()));
        let z = written.z.as_ref().map(|z| self.formula(z, of("distance along z")));
        let [front, rear, left, right, middle] = [0.5, -0.5, 0.5, -0.5, 0.0];
        let ends: &[(&str, [f64; 2])] = match written.corners {
            None | Some(4) => &[
                ("front_left", [front, left]),
                ("front_right", [front, right]),
                ("rear_left", [rear, left]),
                ("rear_right", [rear, right]),
            ],
            Some(3) => &[
                ("front_left", [front, left]),
                ("front_right", [front, right]),
                ("rear_middle", [rear, middle]),
            ],
            Some(other) => {
                self.fault(FaultKind::Corners { joint: name.to_owned(), corners: other }, span);
                return;
            }
        };
        let table = ContactTable {
            mu: written.mu.clone(),
            mu_static: written.mu_static.clone(),
            stiffness: written.stiffness.clone(),
            ..ContactTable::default()
        };
        let friction = self.friction(&table, false, &format!("the corners of {name}"), span).or(all);
        for &(end, corner) in ends {
            let contact = format!("{name}.{end}");
            self.new_contact(contacts, &contact, span);
            let mut rest = self.contact(friction, contact, name, span);
            if written.one_sided == Some(true) {
                self.make_one_sided(&mut rest, span);
            }
            let aside = [Some(width), z];
            contacts.push(Contact { offset: length, aside, corner: Some(corner), ..rest });
        }
    }

    /// Makes round ends of the contacts whose normal is not given; each gets another one along z, behind all of them.
    fn round_ends(
        &mut self,
        joint: &SliderTable,
        contacts: &mut Vec<Contact>,
        name: &str,
        span: &Span,
    ) -> Vec<RoundEnd> {
        let refused = [("height", joint.height.is_some()), ("loose", joint.loose == Some(true))];
        self.refuse_on_rod(name, &refused, span);
        let mut ends = Vec::new();
        for at in 0..contacts.len() {
            let contact = contacts[at].clone();
            if contact.normal.is_some() || contact.corner.is_some() {
                continue;
            }
            let needs_face = [
                ("height", contact.height.is_some()),
                ("one_sided", contact.one_sided),
                ("play", contact.play.is_some()),
                ("preload", contact.preload != [None; 2]),
                ("misalignment", contact.misalignment.is_some()),
                ("pad", contact.pad.is_some()),
                ("mu = { plus, minus }", contact.mu[0] != contact.mu[1]),
            ];
            self.refuse_on_rod(&contact.name, &needs_face, span);
            let [mu, mu_static] = [contact.mu[0], contact.mu_static[0]];
            self.formulas[mu.index()].varies = Varies::Never;
            let friction = HingeFriction::End([mu, mu_static]);
            ends.push(RoundEnd { contacts: [at, contacts.len()], friction });
            (contacts[at].mu, contacts[at].mu_static) = ([self.zero; 2], [self.zero; 2]);
            let name = Arc::from(format!("{}.z", contact.name));
            contacts.push(Contact { name, along_z: true, ..contacts[at].clone() });
        }
        ends
    }

    fn refuse_on_rod(&mut self, owner: &str, keys: &[(&'static str, bool)], span: &Span) {
        for (second, _) in keys.iter().filter(|(_, given)| *given) {
            let kind = FaultKind::Both { owner: owner.to_owned(), first: "section = \"round\"", second };
            self.fault(kind, span);
        }
    }

    /// Takes the face away that a contact presses where its normal force is negative.
    fn make_one_sided(&mut self, contact: &mut Contact, span: &Span) {
        let needs_two = [
            ("play", contact.play.is_some()),
            ("preload", contact.preload != [None; 2]),
            ("misalignment", contact.misalignment.is_some()),
        ];
        for (second, _) in needs_two.into_iter().filter(|(_, is_there)| *is_there) {
            let owner = contact.name.to_string();
            self.fault(FaultKind::Both { owner, first: "one_sided = true", second }, span);
        }
        // Without a second face there is no friction at it.
        (contact.opens, contact.mu[1], contact.mu_static[1]) = (true, self.zero, self.zero);
        contact.one_sided = true;
    }

    /// Makes contacts that may lift off of these, leaves those that touch, and returns the others.
    pub(super) fn open(&self, contacts: &mut Vec<Contact>, touches: Touches) -> Vec<Contact> {
        for contact in &mut *contacts {
            // Without a second face there is no friction at it.
            (contact.opens, contact.mu[1], contact.mu_static[1]) = (true, self.zero, self.zero);
        }
        let mut end = 0;
        let leaves = |_: &mut Contact| {
            end += 1;
            match touches {
                Touches::All => false,
                Touches::Front => end != 1,
                Touches::Rear => end != 2,
                Touches::Nothing => true,
            }
        };
        contacts.extract_if(.., leaves).collect()
    }

    /// Reads whether a joint does not slip, which only what touches can.
    pub(super) fn sticks(
        &mut self,
        written: Option<bool>,
        touches: Touches,
        name: &str,
        span: &Span,
    ) -> bool {
        let sticks = written == Some(true);
        if sticks && touches == Touches::Nothing {
            let kind =
                FaultKind::Both { owner: name.to_owned(), first: "sticks = true", second: "closed = false" };
            self.fault(kind, span);
        }
        sticks
    }

    fn radius(&mut self, radius: &Quantity, name: &str) -> FormulaId {
        let wanted = Wanted::constant(format!("the radius of {name}"), Dimension::LENGTH);
        self.formula(radius, wanted.positive())
    }

    fn height(&mut self, height: Option<&Quantity>, name: &str) -> Option<FormulaId> {
        let wanted = Wanted::constant(format!("the height of {name}"), Dimension::LENGTH).not_negative();
        height.map(|height| self.formula(height, wanted))
    }

    fn travel(&mut self, travel: Option<&[Quantity; 2]>, name: &str) -> Option<[FormulaId; 2]> {
        let what = format!("the travel limit of {name}");
        travel.map(|limits| {
            limits
                .each_ref()
                .map(|limit| self.formula(limit, Wanted::constant(what.clone(), Dimension::LENGTH)))
        })
    }

    /// The stops at both ends: what stands at an end wins over what stands for both.
    fn stops(&mut self, joint: &SliderTable, name: &str, span: &Span) -> [Option<Stop<FormulaId>>; 2] {
        let Some(both) = &joint.stop else { return [None; 2] };
        let ends = [("least", &both.least), ("greatest", &both.greatest)];
        let table = format!("joints.{name}.stop");
        if joint.travel.is_none() {
            self.fault(FaultKind::MissingKey { key: "travel".into(), table: format!("joints.{name}") }, span);
        }
        let for_both = if both.is_empty() && ends.iter().any(|(_, end)| end.is_some()) {
            None
        } else {
            self.stop(both, &table, name, span)
        };
        ends.map(|(end, written)| match written {
            Some(stop) => self.stop(stop, &format!("{table}.{end}"), name, span),
            None => for_both,
        })
    }

    /// The stop that a table describes.
    fn stop(&mut self, written: &StopTable, table: &str, name: &str, span: &Span) -> Option<Stop<FormulaId>> {
        let of =
            |what: &str, dimension| Wanted::constant(format!("the {what} of the stop of {name}"), dimension);
        match written {
            StopTable { restitution: Some(restitution), stiffness: None, damping: None, .. } => {
                let wanted = of("restitution", Dimension::NONE).not_negative();
                Some(Stop::Impact { restitution: self.formula(restitution, wanted) })
            }
            StopTable { restitution: None, stiffness: Some(stiffness), damping, .. } => {
                let stiffness = self.formula(stiffness, of("stiffness", Dimension::STIFFNESS).positive());
                let wanted = of("damping", Dimension::DAMPING).not_negative();
                let damping = damping.as_ref().map_or(self.zero, |damping| self.formula(damping, wanted));
                Some(Stop::Pad { stiffness, damping })
            }
            StopTable { restitution, stiffness, .. } => {
                let owner = format!("the stop of {name}");
                let kind = match (restitution, stiffness) {
                    (Some(_), Some(_)) => {
                        FaultKind::Both { owner, first: "restitution", second: "stiffness" }
                    }
                    (Some(_), None) => FaultKind::Both { owner, first: "restitution", second: "damping" },
                    _ if written.is_empty() => {
                        FaultKind::NoneOf { owner, one_of: vec!["restitution", "stiffness"] }
                    }
                    _ => FaultKind::MissingKey { key: "stiffness".into(), table: table.to_owned() },
                };
                self.fault(kind, span);
                None
            }
        }
    }

    /// The friction of a contact; a pad that may be as long as the joint (`has_face`) needs no length.
    pub(super) fn friction(
        &mut self,
        written: &ContactTable,
        has_face: bool,
        name: &str,
        span: &Span,
    ) -> ReadFriction {
        let mut sides = |value: Option<&PerSide>, wanted: &dyn Fn() -> Wanted| {
            value.map(|value| self.sides(value, &|| wanted().not_negative()))
        };
        let of = |what: &str| format!("the {what} of {name}");
        let mu =
            sides(written.mu.as_ref(), &|| Wanted::with_speed(of("friction coefficient"), Dimension::NONE));
        let mu_static = sides(written.mu_static.as_ref(), &|| {
            Wanted::constant(of("static friction coefficient"), Dimension::NONE)
        });
        let preload = sides(written.preload.as_ref(), &|| Wanted::constant(of("preload"), Dimension::FORCE));
        let mut quantity = |value: &Option<Quantity>, wanted: Wanted| {
            value.as_ref().map(|value| self.formula(value, wanted))
        };
        let guide = format!("the stiffness of the guide at {name}");
        let stiffness =
            quantity(&written.stiffness, Wanted::constant(guide, Dimension::STIFFNESS).positive());
        let play = quantity(&written.play, Wanted::constant(of("play"), Dimension::LENGTH));
        let misalignment =
            quantity(&written.misalignment, Wanted::moving(of("misalignment"), Dimension::LENGTH));
        let restitution = Wanted::constant(of("restitution"), Dimension::NONE).not_negative();
        let restitution = quantity(&written.restitution, restitution);
        let ContactTable { preload_line, carried_by, .. } = *written;
        let pad = written.pad.as_ref().map(|pad| self.pad(pad, has_face, name, span));
        ReadFriction {
            mu,
            mu_static,
            preload,
            preload_line,
            stiffness,
            play,
            misalignment,
            restitution,
            pad,
            carried_by,
        }
    }

    fn pad(&mut self, pad: &PadTable, has_face: bool, name: &str, span: &Span) -> Pad {
        if pad.length.is_none() && !has_face {
            self.fault(
                FaultKind::MissingKey { key: "length".into(), table: format!("joints.{name}.pad") },
                span,
            );
        }
        let of = |what: &str| {
            Wanted::constant(format!("the {what} of the pad of {name}"), Dimension::LENGTH).positive()
        };
        Pad {
            length: pad.length.as_ref().map(|length| self.formula(length, of("length"))),
            width: self.formula(&pad.width, of("width")),
        }
    }

    pub(super) fn contact(
        &mut self,
        friction: ReadFriction,
        name: String,
        joint: &str,
        span: &Span,
    ) -> Contact {
        let mu = friction.mu.unwrap_or_else(|| {
            let kind = FaultKind::MissingKey { key: "mu".into(), table: format!("joints.{joint}") };
            self.fault(kind, span);
            [self.broken(span); 2]
        });
        Contact {
            name: Arc::from(name),
            carried_by: friction.carried_by.unwrap_or(CarriedBy::Block),
            mu,
            mu_static: friction.mu_static.unwrap_or(mu),
            preload: friction.preload.map_or([None; 2], |preload| preload.map(Some)),
            preload_line: friction.preload_line.unwrap_or(PreloadLine::Pressed),
            offset: None,
            aside: [None; 2],
            corner: None,
            along_z: false,
            normal: None,
            height: None,
            stiffness: friction.stiffness,
            play: friction.play,
            misalignment: friction.misalignment,
            restitution: friction.restitution,
            pad: friction.pad,
            face: None,
            opens: false,
            one_sided: false,
        }
    }

    fn sides(&mut self, written: &PerSide, wanted: &dyn Fn() -> Wanted) -> [FormulaId; 2] {
        match written {
            PerSide::Both(quantity) => [self.formula(quantity, wanted()); 2],
            PerSide::Each(sides) => {
                [self.formula(&sides.plus, wanted()), self.formula(&sides.minus, wanted())]
            }
        }
    }
}
