//! Hinges and the three sliding joints.

use super::super::file::{
    BlockSliderTable, CarriedBy, EndTable, Entry, Fit, GuidedSliderTable, PadTable, PinInSlotTable,
    PreloadLine, StopAtEndTable, StopTable, SupportTable,
};
use super::super::quantity::{Components, Direction, Name, PerSide, Place, Quantity, Span};
use super::super::sections::JointContents;
use super::super::{Contact, Joint, JointKind, Pad, Slider, SliderKind, Stop};
use super::{Reader, Wanted};
use crate::expression::Dimension;
use crate::fault::{FaultKind, Place as FaultPlace};
use crate::ids::FormulaId;
use std::sync::Arc;

/// The friction of one contact, and its other properties, as they are written.
#[derive(Clone, Copy, Default)]
struct WrittenFriction<'a> {
    mu: Option<&'a PerSide>,
    mu_static: Option<&'a PerSide>,
    preload: Option<&'a PerSide>,
    preload_line: Option<PreloadLine>,
    stiffness: Option<&'a Quantity>,
    play: Option<&'a Quantity>,
    misalignment: Option<&'a Quantity>,
    pad: Option<&'a PadTable>,
    /// Whether the pad may be as long as the joint.
    has_face: bool,
    carried_by: Option<CarriedBy>,
}

/// The friction of one contact, and its other properties, as they were read.
#[derive(Clone, Copy, Default)]
struct ReadFriction {
    mu: Option<[FormulaId; 2]>,
    mu_static: Option<[FormulaId; 2]>,
    preload: Option<[FormulaId; 2]>,
    preload_line: Option<PreloadLine>,
    stiffness: Option<FormulaId>,
    play: Option<FormulaId>,
    misalignment: Option<FormulaId>,
    pad: Option<Pad>,
    carried_by: Option<CarriedBy>,
}

impl ReadFriction {
    /// What is written at the end of a block wins over what is written for the joint.
    fn or(self, joint: Self) -> Self {
        Self {
            mu: self.mu.or(joint.mu),
            mu_static: self.mu_static.or(joint.mu_static),
            preload: self.preload.or(joint.preload),
            preload_line: self.preload_line.or(joint.preload_line),
            stiffness: self.stiffness.or(joint.stiffness),
            play: self.play.or(joint.play),
            misalignment: self.misalignment.or(joint.misalignment),
            pad: self.pad.or(joint.pad),
            carried_by: self.carried_by,
        }
    }
}

impl<'a> WrittenFriction<'a> {
    fn at_end(end: Option<&'a EndTable>) -> Self {
        let Some(end) = end else { return Self::default() };
        Self {
            mu: end.mu.as_ref(),
            mu_static: end.mu_static.as_ref(),
            preload: end.preload.as_ref(),
            preload_line: end.preload_line,
            stiffness: end.stiffness.as_ref(),
            play: end.play.as_ref(),
            misalignment: end.misalignment.as_ref(),
            pad: end.pad.as_ref(),
            has_face: false,
            carried_by: end.carried_by,
        }
    }
}

impl<'a> WrittenFriction<'a> {
    fn at_support(table: &'a SupportTable) -> Self {
        Self {
            mu: table.mu.as_ref(),
            mu_static: table.mu_static.as_ref(),
            preload: table.preload.as_ref(),
            preload_line: table.preload_line,
            stiffness: table.stiffness.as_ref(),
            play: table.play.as_ref(),
            misalignment: table.misalignment.as_ref(),
            pad: table.pad.as_ref(),
            has_face: false,
            carried_by: table.carried_by,
        }
    }
}

/// A stop as it is written, for both ends or for one.
#[derive(Clone, Copy)]
struct WrittenStop<'a> {
    restitution: &'a Option<Quantity>,
    stiffness: &'a Option<Quantity>,
    damping: &'a Option<Quantity>,
}

impl WrittenStop<'_> {
    fn is_empty(&self) -> bool {
        self.restitution.is_none() && self.stiffness.is_none() && self.damping.is_none()
    }
}

impl<'a> From<&'a StopAtEndTable> for WrittenStop<'a> {
    fn from(table: &'a StopAtEndTable) -> Self {
        Self { restitution: &table.restitution, stiffness: &table.stiffness, damping: &table.damping }
    }
}

/// What the tables of the three sliding joints have in common.
struct WrittenSlider<'a> {
    kind: SliderKind,
    block: &'a Name,
    guide: Option<&'a Name>,
    at: &'a Place,
    along: &'a Direction,
    length: Option<&'a Quantity>,
    height: Option<&'a Quantity>,
    fit: Option<Fit>,
    travel: Option<&'a Components>,
    stop: Option<&'a StopTable>,
    friction: WrittenFriction<'a>,
}

impl<'a> From<&'a BlockSliderTable> for WrittenSlider<'a> {
    fn from(table: &'a BlockSliderTable) -> Self {
        Self {
            kind: SliderKind::Block,
            block: &table.block,
            guide: table.guide.as_ref(),
            at: &table.at,
            along: &table.along,
            length: Some(&table.length),
            height: table.height.as_ref(),
            fit: table.fit,
            travel: table.travel.as_ref(),
            stop: table.stop.as_ref(),
            friction: WrittenFriction {
                mu: table.mu.as_ref(),
                mu_static: table.mu_static.as_ref(),
                preload: table.preload.as_ref(),
                preload_line: table.preload_line,
                stiffness: table.stiffness.as_ref(),
                play: table.play.as_ref(),
                misalignment: table.misalignment.as_ref(),
                pad: table.pad.as_ref(),
                has_face: false,
                carried_by: None,
            },
        }
    }
}

impl<'a> From<&'a GuidedSliderTable> for WrittenSlider<'a> {
    fn from(table: &'a GuidedSliderTable) -> Self {
        Self {
            kind: SliderKind::Guided,
            block: &table.block,
            guide: table.guide.as_ref(),
            at: &table.at,
            along: &table.along,
            length: Some(&table.length),
            height: table.height.as_ref(),
            fit: table.fit,
            travel: table.travel.as_ref(),
            stop: table.stop.as_ref(),
            friction: WrittenFriction {
                mu: table.mu.as_ref(),
                mu_static: table.mu_static.as_ref(),
                preload: table.preload.as_ref(),
                preload_line: table.preload_line,
                stiffness: table.stiffness.as_ref(),
                play: table.play.as_ref(),
                misalignment: table.misalignment.as_ref(),
                pad: table.pad.as_ref(),
                has_face: true,
                carried_by: None,
            },
        }
    }
}

impl<'a> From<&'a PinInSlotTable> for WrittenSlider<'a> {
    fn from(table: &'a PinInSlotTable) -> Self {
        Self {
            kind: SliderKind::Pin,
            block: &table.block,
            guide: table.guide.as_ref(),
            at: &table.at,
            along: &table.along,
            length: None,
            height: None,
            fit: None,
            travel: table.travel.as_ref(),
            stop: table.stop.as_ref(),
            friction: WrittenFriction {
                mu: table.mu.as_ref(),
                mu_static: table.mu_static.as_ref(),
                preload: table.preload.as_ref(),
                stiffness: table.stiffness.as_ref(),
                play: table.play.as_ref(),
                misalignment: table.misalignment.as_ref(),
                pad: table.pad.as_ref(),
                ..WrittenFriction::default()
            },
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
                    JointKind::Hinge(Box::new(self.hinge(table, &entry.name, &entry.span)))
                }
                Some(JointContents::BlockSlider(table)) => self.block_slider(table, &entry.name, &entry.span),
                Some(JointContents::GuidedSlider(table)) => {
                    self.slider_of_one_contact(&table.as_ref().into(), &entry.name, &entry.span)
                }
                Some(JointContents::PinInSlot(table)) => {
                    self.slider_of_one_contact(&table.as_ref().into(), &entry.name, &entry.span)
                }
            };
            joints.push(Joint { name: Arc::from(entry.name), place: FaultPlace::model(entry.span), kind });
        }
        joints
    }

    fn block_slider(&mut self, table: &BlockSliderTable, name: &str, span: &Span) -> JointKind {
        let written = WrittenSlider::from(table);
        let both = self.friction(written.friction, name, span);
        let ends = [("front", table.front.as_ref()), ("rear", table.rear.as_ref())];
        let mut contacts: Vec<Contact> = Vec::new();
        for (end, table) in ends {
            let contact = format!("{name}.{end}");
            let friction = self.friction(WrittenFriction::at_end(table), &contact, span).or(both);
            contacts.push(self.contact(friction, contact, name, span));
        }
        for (support, table) in table.supports.iter().flatten() {
            self.valid_name("support", support, span);
            let contact = format!("{name}.{support}");
            if contacts.iter().any(|other| *other.name == *contact) {
                self.fault(FaultKind::SharedName { name: contact.clone() }, span);
            }
            let friction = self.friction(WrittenFriction::at_support(table), &contact, span).or(both);
            let wanted = Wanted::constant(format!("the place of {contact}"), Dimension::LENGTH);
            let offset = Some(self.formula(&table.at, wanted));
            contacts.push(Contact { offset, ..self.contact(friction, contact, name, span) });
        }
        self.slider(&written, contacts, name, span)
    }

    fn slider_of_one_contact(&mut self, written: &WrittenSlider<'_>, name: &str, span: &Span) -> JointKind {
        let friction = self.friction(written.friction, name, span);
        let contact = self.contact(friction, name.to_owned(), name, span);
        self.slider(written, vec![contact], name, span)
    }

    fn slider(
        &mut self,
        written: &WrittenSlider<'_>,
        contacts: Vec<Contact>,
        name: &str,
        span: &Span,
    ) -> JointKind {
        let length = Wanted::constant(format!("the length of {name}"), Dimension::LENGTH).positive();
        JointKind::Slider(Box::new(Slider {
            kind: written.kind,
            block: self.frame(written.block),
            guide: self.frame_or_ground(written.guide),
            at: self.place(written.at, &format!("the place of {name}")),
            along: self.along(written.along, &format!("the direction of {name}")),
            length: written.length.map(|quantity| self.formula(quantity, length)),
            height: self.height(written.height, name),
            around: written.fit == Some(Fit::Around),
            travel: self.travel(written.travel, name),
            stops: self.stops(written, name, span),
            contacts,
        }))
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
    fn stops(
        &mut self,
        written: &WrittenSlider<'_>,
        name: &str,
        span: &Span,
    ) -> [Option<Stop<FormulaId>>; 2] {
        let Some(stop) = written.stop else { return [None; 2] };
        let ends = [("least", &stop.least), ("greatest", &stop.greatest)];
        let both = WrittenStop {
            restitution: &stop.restitution,
            stiffness: &stop.stiffness,
            damping: &stop.damping,
        };
        let table = format!("joints.{name}.stop");
        if written.travel.is_none() {
            self.fault(FaultKind::MissingKey { key: "travel".into(), table: format!("joints.{name}") }, span);
        }
        let for_both = if both.is_empty() && ends.iter().any(|(_, end)| end.is_some()) {
            None
        } else {
            self.stop(both, &table, name, span)
        };
        ends.map(|(end, written)| match written {
            Some(end_table) => self.stop(end_table.into(), &format!("{table}.{end}"), name, span),
            None => for_both,
        })
    }

    /// The stop that a table describes.
    fn stop(
        &mut self,
        written: WrittenStop<'_>,
        table: &str,
        name: &str,
        span: &Span,
    ) -> Option<Stop<FormulaId>> {
        let of =
            |what: &str, dimension| Wanted::constant(format!("the {what} of the stop of {name}"), dimension);
        match written {
            WrittenStop { restitution: Some(restitution), stiffness: None, damping: None } => {
                let wanted = of("restitution", Dimension::NONE).not_negative();
                Some(Stop::Impact { restitution: self.formula(restitution, wanted) })
            }
            WrittenStop { restitution: None, stiffness: Some(stiffness), damping } => {
                let stiffness = self.formula(stiffness, of("stiffness", Dimension::STIFFNESS).positive());
                let wanted = of("damping", Dimension::DAMPING).not_negative();
                let damping = damping.as_ref().map_or(self.zero, |damping| self.formula(damping, wanted));
                Some(Stop::Pad { stiffness, damping })
            }
            WrittenStop { restitution, stiffness, .. } => {
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

    fn friction(&mut self, written: WrittenFriction<'_>, name: &str, span: &Span) -> ReadFriction {
        let mut sides = |value: Option<&PerSide>, wanted: &dyn Fn() -> Wanted| {
            value.map(|value| self.sides(value, &|| wanted().not_negative()))
        };
        let of = |what: &str| format!("the {what} of {name}");
        let mu = sides(written.mu, &|| Wanted::with_speed(of("friction coefficient"), Dimension::NONE));
        let mu_static = sides(written.mu_static, &|| {
            Wanted::constant(of("static friction coefficient"), Dimension::NONE)
        });
        let preload = sides(written.preload, &|| Wanted::constant(of("preload"), Dimension::FORCE));
        let stiffness = written.stiffness.map(|stiffness| {
            let what = format!("the stiffness of the guide at {name}");
            self.formula(stiffness, Wanted::constant(what, Dimension::STIFFNESS).positive())
        });
        let play =
            written.play.map(|play| self.formula(play, Wanted::constant(of("play"), Dimension::LENGTH)));
        let misalignment = written.misalignment.map(|misalignment| {
            self.formula(misalignment, Wanted::moving(of("misalignment"), Dimension::LENGTH))
        });
        let WrittenFriction { preload_line, carried_by, has_face, .. } = written;
        let pad = written.pad.map(|pad| self.pad(pad, has_face, name, span));
        ReadFriction { mu, mu_static, preload, preload_line, stiffness, play, misalignment, pad, carried_by }
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

    fn contact(&mut self, friction: ReadFriction, name: String, joint: &str, span: &Span) -> Contact {
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
            stiffness: friction.stiffness,
            play: friction.play,
            misalignment: friction.misalignment,
            pad: friction.pad,
            face: None,
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
