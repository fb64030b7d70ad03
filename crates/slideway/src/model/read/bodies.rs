//! Points and bodies.

use super::super::file::{BodyTable, Entry, ShapeTable};
use super::super::quantity::{InSpace, Name, OutlinePlace, Span, Through};
use super::super::{Attachment, Body, Inertia, Moment, NamedPoint, OutlineCorner};
use super::{Reader, Wanted};
use crate::expression::Dimension;
use crate::fault::{FaultKind, Place as FaultPlace};
use crate::ids::{BodyId, FormulaId, Frame};
use std::sync::Arc;

impl Reader<'_> {
    pub(super) fn read_points(&mut self, entries: Vec<Entry<InSpace>>) {
        for entry in entries {
            self.valid_name("point", &entry.name, &entry.span);
            let (position, z) = match &entry.contents {
                Some(written) => {
                    self.in_space(written, &format!("the point {}", entry.name), Dimension::LENGTH)
                }
                None => ([self.broken(&entry.span); 2], None),
            };
            let point = NamedPoint { name: Arc::from(entry.name.as_str()), position, z };
            self.points.insert(entry.name, point);
        }
    }

    pub(super) fn read_bodies(&mut self, entries: Vec<Entry<BodyTable>>) -> Vec<Body> {
        if entries.is_empty() && self.faults.is_empty() {
            self.faults.push(crate::fault::Fault::general(FaultKind::NoBodies));
        }
        let mut bodies = Vec::new();
        for (index, entry) in entries.into_iter().enumerate() {
            self.valid_name("body", &entry.name, &entry.span);
            let mut points = Vec::new();
            let mut inertia = Inertia::Massless;
            let mut outline = Vec::new();
            if let Some(table) = &entry.contents {
                points = self.body_points(table.points.as_deref().unwrap_or_default(), BodyId(index));
                inertia = self.inertia(table, &entry.name, &entry.span);
                outline = self.outline(table, &entry.name, &entry.span);
            } else {
                self.unread_bodies.push(BodyId(index));
            }
            let place = FaultPlace::model(entry.span);
            bodies.push(Body { name: Arc::from(entry.name), place, inertia, points, outline });
        }
        bodies
    }

    /// The corners; what an arc in front of the first one goes through belongs to the last one.
    fn outline(&mut self, table: &BodyTable, name: &str, span: &Span) -> Vec<OutlineCorner<[FormulaId; 2]>> {
        let what = format!("a corner of the outline of {name}");
        let before = self.formulas.len();
        let mut outline: Vec<OutlineCorner<[FormulaId; 2]>> = Vec::new();
        let mut in_front = None;
        let mut is_in_doubt = false;
        for place in table.outline.iter().flatten() {
            match place {
                OutlinePlace::Corner(place) => {
                    let at = self.place(place, &what);
                    outline.push(OutlineCorner { at, arc_through: None });
                }
                OutlinePlace::Through(Through { through }) => {
                    let arc = outline.last_mut().map_or(&mut in_front, |corner| &mut corner.arc_through);
                    is_in_doubt |= arc.replace(self.place(through, &what)).is_some();
                }
            }
        }
        if in_front.is_some() {
            let last = outline.last_mut().map(|corner| &mut corner.arc_through);
            is_in_doubt |= last.is_none_or(|arc| std::mem::replace(arc, in_front).is_some());
        }
        if is_in_doubt {
            self.fault(FaultKind::OutlineArcs { body: name.to_owned() }, span);
        }
        self.looks.extend((before..self.formulas.len()).map(FormulaId));
        outline
    }

    fn body_points(&mut self, names: &[Name], body: BodyId) -> Vec<NamedPoint> {
        let mut points = Vec::new();
        for name in names {
            if name.text.contains('.') {
                let kind = FaultKind::InvalidName {
                    what: "point of a body",
                    name: name.text.clone(),
                    reason: "a body lists its points without the name of a body in front",
                };
                self.fault(kind, &name.span);
                continue;
            }
            points.push(self.point(name));
            self.owners.entry(name.text.clone()).or_default().push(body);
        }
        points
    }

    fn inertia(&mut self, table: &BodyTable, name: &str, span: &Span) -> Inertia {
        let owner = format!("the body {name}");
        let massless = table.massless == Some(true);
        let Some(mass) = &table.mass else {
            if !massless {
                self.fault(
                    FaultKind::NoneOf { owner: owner.clone(), one_of: vec!["mass", "massless"] },
                    span,
                );
            }
            let beside = [
                ("moment_of_inertia", table.moment_of_inertia.is_some()),
                ("shape", table.shape.is_some()),
                ("centre_of_mass", table.centre_of_mass.is_some()),
                ("products_of_inertia", table.products_of_inertia.is_some()),
            ];
            for (second, _) in beside.into_iter().filter(|(_, given)| massless && *given) {
                self.fault(FaultKind::Both { owner: owner.clone(), first: "massless", second }, span);
            }
            return Inertia::Massless;
        };
        if massless {
            self.fault(FaultKind::Both { owner: owner.clone(), first: "mass", second: "massless" }, span);
        }
        let mass =
            self.formula(mass, Wanted::constant(format!("the mass of {name}"), Dimension::MASS).positive());
        let moment = self.moment(table, name, span);
        let centre = table.centre_of_mass.as_ref();
        match (&moment, centre) {
            (Moment::Bar(_), Some(_)) => {
                self.fault(FaultKind::Both { owner, first: "shape.bar", second: "centre_of_mass" }, span);
            }
            (Moment::Bar(_), None) | (_, Some(_)) => {}
            (_, None) => self.fault(FaultKind::NoneOf { owner, one_of: vec!["centre_of_mass"] }, span),
        }
        let centre = centre.map(|place| self.place_in_space(place, &format!("the centre of mass of {name}")));
        let what = format!("the product of inertia of {name}");
        let products = table.products_of_inertia.as_ref().map(|products| {
            products.each_ref().map(|product| {
                self.formula(product, Wanted::constant(what.clone(), Dimension::MOMENT_OF_INERTIA))
            })
        });
        let (centre_of_mass, z) = (centre.map(|(place, _)| place), centre.and_then(|(_, z)| z));
        Inertia::Massive { mass, centre_of_mass, z, products, moment }
    }

    fn moment(&mut self, table: &BodyTable, name: &str, span: &Span) -> Moment {
        let owner = format!("the body {name}");
        match (&table.moment_of_inertia, &table.shape) {
            (Some(_), Some(shape)) => {
                self.fault(FaultKind::Both { owner, first: "moment_of_inertia", second: "shape" }, span);
                self.shape(shape, name, span)
            }
            (None, None) => {
                self.fault(FaultKind::NoneOf { owner, one_of: vec!["moment_of_inertia", "shape"] }, span);
                Moment::Given(self.zero)
            }
            (Some(moment), None) => {
                let what = format!("the moment of inertia of {name}");
                let wanted = Wanted::constant(what, Dimension::MOMENT_OF_INERTIA).not_negative();
                Moment::Given(self.formula(moment, wanted))
            }
            (None, Some(shape)) => self.shape(shape, name, span),
        }
    }

    fn shape(&mut self, shape: &ShapeTable, name: &str, span: &Span) -> Moment {
        let size =
            |what: &str| Wanted::constant(format!("the {what} of {name}"), Dimension::LENGTH).not_negative();
        let given = [
            ("bar", shape.bar.is_some()),
            ("rectangle", shape.rectangle.is_some()),
            ("box", shape.cuboid.is_some()),
            ("disc", shape.disc.is_some()),
        ];
        let mut names = given.iter().filter(|(_, is_given)| *is_given).map(|(name, _)| *name);
        let owner = format!("the shape of {name}");
        match [names.next(), names.next()] {
            [None, _] => {
                let one_of = given.map(|(name, _)| name).to_vec();
                self.fault(FaultKind::NoneOf { owner, one_of }, span);
            }
            [Some(first), Some(second)] => self.fault(FaultKind::Both { owner, first, second }, span),
            [Some(_), None] => {}
        }
        if let Some([from, to]) = &shape.bar {
            let what = format!("the end of {name}");
            Moment::Bar([self.place(from, &what), self.place(to, &what)])
        } else if let Some([width, height]) = &shape.rectangle {
            Moment::Rectangle([self.formula(width, size("width")), self.formula(height, size("height"))])
        } else if let Some([width, height, depth]) = &shape.cuboid {
            Moment::Box([
                self.formula(width, size("width")),
                self.formula(height, size("height")),
                self.formula(depth, size("depth")),
            ])
        } else if let Some(radius) = &shape.disc {
            Moment::Disc(self.formula(radius, size("radius")))
        } else {
            Moment::Given(self.zero)
        }
    }

    /// A point as part of a body: "body.point", or "point" alone where that leaves no doubt.
    pub(super) fn attachment(&mut self, name: &Name) -> Attachment {
        let Some((body, point)) = name.text.split_once('.') else {
            return self.attachment_by_point(name);
        };
        let frame = self.frame(&Name { text: body.to_owned(), span: name.span.clone() });
        let known = self.points.contains_key(point);
        let NamedPoint { name: point_name, position, z } = self.point(name);
        let owners = self.owners.get(point).cloned().unwrap_or_default();
        if let (Frame::Body(body), true) = (frame, known)
            && !owners.contains(&body)
            && !self.unread_bodies.contains(&body)
        {
            let kind = FaultKind::NotOwned {
                body: self.bodies[body.index()].clone(),
                point: point.to_owned(),
                owners: owners.iter().map(|owner| self.bodies[owner.index()].clone()).collect(),
            };
            self.fault(kind, &name.span);
        }
        Attachment { frame, name: point_name, position, z }
    }

    fn attachment_by_point(&mut self, name: &Name) -> Attachment {
        let NamedPoint { name: point_name, position, z } = self.point(name);
        let owners = self.owners.get(&name.text).cloned().unwrap_or_default();
        let frame = match owners.as_slice() {
            [] => Frame::Ground,
            [body] => Frame::Body(*body),
            several => {
                let owners = several.iter().map(|owner| self.bodies[owner.index()].clone()).collect();
                self.fault(FaultKind::SeveralOwners { point: name.text.clone(), owners }, &name.span);
                Frame::Ground
            }
        };
        Attachment { frame, name: point_name, position, z }
    }
}
