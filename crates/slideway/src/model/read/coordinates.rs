//! Chosen coordinates and drives.

use super::super::file::{CoordinateTable, DriveTable, Entry, EventTable, ForceFrame};
use super::super::quantity::Span;
use super::super::settings::dimension_of;
use super::super::{Coordinate, CoordinateKind, Drive, Effort, EventDefinition};
use super::{Allowed, Reader, Varies, Wanted};
use crate::expression::Dimension;
use crate::fault::{FaultKind, Place as FaultPlace, nearest};
use crate::ids::{CoordinateId, Frame, JointId};
use std::sync::Arc;

impl Reader<'_> {
    pub(super) fn read_coordinates(&mut self, entries: Vec<Entry<CoordinateTable>>) -> Vec<Coordinate> {
        let mut coordinates = Vec::new();
        for entry in entries {
            let (kind, table) = match &entry.contents {
                Some(table) => (self.coordinate_kind(table, &entry.name, &entry.span), Some(table)),
                None => (CoordinateKind::Slide(JointId(0)), None),
            };
            let mut coordinate = Coordinate {
                name: Arc::from(entry.name.as_str()),
                place: FaultPlace::model(entry.span),
                kind,
                drawn_at: None,
                value: None,
                rate: None,
            };
            if let Some(table) = table {
                self.coordinate_values(&mut coordinate, table);
            }
            coordinates.push(coordinate);
        }
        coordinates
    }

    fn coordinate_values(&mut self, coordinate: &mut Coordinate, table: &CoordinateTable) {
        let name = coordinate.name.clone();
        let value = dimension_of(coordinate, true);
        let rate = dimension_of(coordinate, false);
        let mut read = |quantity: &Option<_>, what: &str, dimension| {
            let wanted = Wanted::constant(format!("{what} of {name}"), dimension);
            quantity.as_ref().map(|quantity| self.formula(quantity, wanted))
        };
        coordinate.drawn_at = read(&table.drawn_at, "the value in the drawing", value);
        coordinate.value = read(&table.value, "the value", value);
        coordinate.rate = read(&table.rate, "the rate", rate);
    }

    fn coordinate_kind(&mut self, table: &CoordinateTable, name: &str, span: &Span) -> CoordinateKind {
        let owner = format!("the coordinate {name}");
        let given: Vec<&'static str> = [
            ("slide", table.slide.is_some()),
            ("rotation", table.rotation.is_some()),
            ("x", table.x.is_some()),
            ("y", table.y.is_some()),
        ]
        .into_iter()
        .filter_map(|(key, given)| given.then_some(key))
        .collect();
        if let [first, second, ..] = given[..] {
            self.fault(FaultKind::Both { owner: owner.clone(), first, second }, span);
        }
        if table.relative_to.is_some() && table.rotation.is_none() {
            let kind = FaultKind::Without { owner: owner.clone(), first: "relative_to", second: "rotation" };
            self.fault(kind, span);
        }
        if let Some(joint) = &table.slide {
            return CoordinateKind::Slide(self.sliding_joint(joint));
        }
        if let Some(body) = &table.rotation {
            let relative_to = self.frame_or_ground(table.relative_to.as_ref());
            return match self.frame(body) {
                Frame::Body(body) => CoordinateKind::Rotation { body, relative_to },
                Frame::Ground => self.rotation_of_ground(body.text == "ground", &body.span),
            };
        }
        match (&table.x, &table.y) {
            (Some(point), _) => CoordinateKind::X(self.attachment(point)),
            (None, Some(point)) => CoordinateKind::Y(self.attachment(point)),
            (None, None) => {
                self.fault(FaultKind::NoneOf { owner, one_of: vec!["slide", "rotation", "x", "y"] }, span);
                CoordinateKind::Slide(JointId(0))
            }
        }
    }

    fn rotation_of_ground(&mut self, named: bool, span: &Span) -> CoordinateKind {
        if named {
            let known = self.bodies.clone();
            let kind = FaultKind::UnknownName {
                what: "moving body",
                name: "ground".into(),
                nearest: nearest("ground", known.iter().map(String::as_str)),
                known,
            };
            self.fault(kind, span);
        }
        CoordinateKind::Slide(JointId(0))
    }

    /// Reads the events for which a motion is watched; one without a formula that can be read is left out.
    pub(super) fn read_events(&mut self, entries: Vec<Entry<EventTable>>) -> Vec<EventDefinition> {
        let mut events = Vec::new();
        for entry in entries {
            self.valid_name("event", &entry.name, &entry.span);
            let Some(table) = entry.contents else { continue };
            let what = format!("the quantity of the event {}", entry.name);
            let zero_of = self.any_formula(&table.zero_of, what, None, Allowed::Any, Varies::WithMotion);
            events.push(EventDefinition {
                name: Arc::from(entry.name),
                place: FaultPlace::model(entry.span),
                zero_of,
                direction: table.direction.unwrap_or_default(),
                stops: table.stops.unwrap_or(false),
            });
        }
        events
    }

    pub(super) fn read_drives(&mut self, entries: Vec<Entry<DriveTable>>) -> Vec<Drive> {
        let mut driven: Vec<CoordinateId> = Vec::new();
        let mut drives = Vec::new();
        for entry in entries {
            self.valid_name("drive", &entry.name, &entry.span);
            let Some(table) = &entry.contents else { continue };
            let coordinate = self.coordinate(&table.coordinate);
            let known = self.coordinates.contains(&table.coordinate.text);
            if known && driven.contains(&coordinate) {
                let kind = FaultKind::DoubledDrive { coordinate: table.coordinate.text.clone() };
                self.fault(kind, &table.coordinate.span);
            }
            if known {
                driven.push(coordinate);
            }
            let what = format!("the prescribed acceleration of {}", table.coordinate.text);
            let acceleration = table.acceleration.as_ref().map(|acceleration| {
                let dimension = self.acceleration_dimension(&table.coordinate.text);
                self.formula(acceleration, Wanted::moving(what, dimension))
            });
            let effort = self.effort(table, &entry.name, &entry.span);
            let place = FaultPlace::model(entry.span);
            drives.push(Drive { name: Arc::from(entry.name), place, coordinate, acceleration, effort });
        }
        drives
    }

    fn acceleration_dimension(&self, coordinate: &str) -> Dimension {
        if self.angles.iter().any(|angle| angle == coordinate) {
            Dimension::ANGULAR_ACCELERATION
        } else {
            Dimension::ACCELERATION
        }
    }

    fn effort(&mut self, table: &DriveTable, name: &str, span: &Span) -> Effort {
        let owner = format!("the drive {name}");
        match (&table.force, &table.torque) {
            (Some(_), Some(_)) => {
                self.fault(FaultKind::Both { owner, first: "force", second: "torque" }, span);
            }
            (None, None) => self.fault(FaultKind::NoneOf { owner, one_of: vec!["force", "torque"] }, span),
            _ => {}
        }
        if let Some(force) = &table.force {
            return Effort::Force {
                at: self.attachment(&force.at),
                direction: self.along(&force.direction, &format!("the direction of the drive {name}")),
                frame: force.frame.unwrap_or(ForceFrame::World),
                reaction: force.reaction.as_ref().map(|body| self.frame(body)),
            };
        }
        match &table.torque {
            Some(torque) => Effort::Torque {
                body: self.frame(&torque.body),
                reaction: torque.reaction.as_ref().map(|body| self.frame(body)),
            },
            None => Effort::Torque { body: Frame::Ground, reaction: None },
        }
    }
}
