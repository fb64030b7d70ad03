//! Forces, torques, springs and dampers.

use super::super::file::{Entry, ForceFrame, ForceTable, TorqueTable};
use super::super::quantity::{InSpace, Name, Quantity, Span};
use super::super::sections::LoadContents;
use super::super::{Attachment, ForceValue, Load, LoadKind};
use super::{Reader, Wanted};
use crate::expression::Dimension;
use crate::fault::{FaultKind, Place as FaultPlace};
use std::sync::Arc;

impl Reader<'_> {
    pub(super) fn read_loads(&mut self, entries: Vec<Entry<LoadContents>>) -> Vec<Load> {
        let mut loads = Vec::new();
        for entry in entries {
            self.valid_name("load", &entry.name, &entry.span);
            let Some(contents) = &entry.contents else { continue };
            let kind = self.load(contents, &entry.name, &entry.span);
            loads.push(Load { name: Arc::from(entry.name), place: FaultPlace::model(entry.span), kind });
        }
        loads
    }

    fn load(&mut self, contents: &LoadContents, name: &str, span: &Span) -> LoadKind {
        let coefficient =
            |what: &str, dimension| Wanted::moving(format!("the {what} of {name}"), dimension).not_negative();
        match contents {
            LoadContents::Force(table) => self.force(table, name, span),
            LoadContents::Torque(table) => self.torque(table, name, span),
            LoadContents::Spring(table) => {
                let free =
                    Wanted::moving(format!("the free length of {name}"), Dimension::LENGTH).not_negative();
                LoadKind::Spring {
                    between: self.ends(&table.between),
                    stiffness: self.formula(&table.stiffness, coefficient("stiffness", Dimension::STIFFNESS)),
                    free_length: table.free_length.as_ref().map(|length| self.formula(length, free)),
                }
            }
            LoadContents::Damper(table) => LoadKind::Damper {
                between: self.ends(&table.between),
                damping: self.formula(&table.damping, coefficient("damping", Dimension::DAMPING)),
            },
            LoadContents::TorsionalSpring(table) => {
                let free = Wanted::moving(format!("the free angle of {name}"), Dimension::ANGLE);
                let stiffness = coefficient("stiffness", Dimension::TORSIONAL_STIFFNESS);
                LoadKind::TorsionalSpring {
                    between: table.between.each_ref().map(|body| self.frame(body)),
                    stiffness: self.formula(&table.stiffness, stiffness),
                    free_angle: table.free_angle.as_ref().map(|angle| self.formula(angle, free)),
                }
            }
            LoadContents::TorsionalDamper(table) => LoadKind::TorsionalDamper {
                between: table.between.each_ref().map(|body| self.frame(body)),
                damping: self.formula(&table.damping, coefficient("damping", Dimension::TORSIONAL_DAMPING)),
            },
        }
    }

    fn torque(&mut self, table: &TorqueTable, name: &str, span: &Span) -> LoadKind {
        let body = self.frame(&table.body);
        let mut moment = |quantity: &Quantity| {
            self.formula(quantity, Wanted::moving(format!("the moment of {name}"), Dimension::TORQUE))
        };
        let (moment, tilt) = match (&table.moment, &table.moments) {
            (Some(written), None) => (moment(written), None),
            (None, Some([x, y, z])) => {
                let tilt = [moment(x), moment(y)];
                (moment(z), Some(tilt))
            }
            (written, _) => {
                let owner = format!("the load {name}");
                let kind = match written {
                    Some(_) => FaultKind::Both { owner, first: "moment", second: "moments" },
                    None => FaultKind::NoneOf { owner, one_of: vec!["moment", "moments"] },
                };
                self.fault(kind, span);
                (self.zero, None)
            }
        };
        let reaction = table.reaction.as_ref().map(|body| self.frame(body));
        LoadKind::Torque { body, moment, tilt, reaction }
    }

    fn ends(&mut self, between: &[Name; 2]) -> [Attachment; 2] {
        between.each_ref().map(|end| self.attachment(end))
    }

    fn force(&mut self, table: &ForceTable, name: &str, span: &Span) -> LoadKind {
        let owner = format!("the load {name}");
        let wanted = |what: &str| Wanted::moving(format!("{what} of {name}"), Dimension::FORCE);
        let mut along_z = None;
        let force = match (&table.components, &table.magnitude, &table.direction) {
            (Some(InSpace { components: [x, y], z }), None, None) => {
                along_z = z.as_ref().map(|z| self.formula(z, wanted("the z component")));
                ForceValue::Components([
                    self.formula(x, wanted("the x component")),
                    self.formula(y, wanted("the y component")),
                ])
            }
            (None, Some(magnitude), Some(direction)) => ForceValue::Along(
                self.formula(magnitude, wanted("the magnitude")),
                self.along(direction, &format!("the direction of {name}")),
            ),
            (components, magnitude, direction) => {
                let kind = match (components.is_some(), magnitude.is_some(), direction.is_some()) {
                    (true, true, _) => FaultKind::Both { owner, first: "components", second: "magnitude" },
                    (true, false, _) => FaultKind::Both { owner, first: "components", second: "direction" },
                    (false, true, _) => FaultKind::Without { owner, first: "magnitude", second: "direction" },
                    (false, false, true) => {
                        FaultKind::Without { owner, first: "direction", second: "magnitude" }
                    }
                    (false, false, false) => {
                        FaultKind::NoneOf { owner, one_of: vec!["components", "magnitude"] }
                    }
                };
                self.fault(kind, span);
                ForceValue::Components([self.zero; 2])
            }
        };
        LoadKind::Force {
            at: self.attachment(&table.at),
            force,
            along_z,
            frame: table.frame.unwrap_or(ForceFrame::World),
            reaction: table.reaction.as_ref().map(|body| self.frame(body)),
        }
    }
}
