//! From the tables of a file to the checked model: names resolved, formulas parsed.
//!
//! A faulty part is replaced by a stand-in and its fault recorded, so that reading goes on and every fault is
//! found; a model with faults never leaves this module.

mod bodies;
mod coordinates;
mod discs;
mod hinges;
mod joints;
mod loads;
mod tables;

use super::formula::{Allowed, Formula, Origin, Varies, expression_start};
use super::quantity::{Components, Direction, Gravity as WrittenGravity, InSpace, Name, Place, Quantity};
use super::range::{Parsed, parse_value};
use super::sections::{JointContents, Sections, sections};
use super::structure::STAND_IN;
use super::{Along, Gravity, Model, NamedPoint, Parameter, Value};
use crate::expression::{
    Dimension, Expression, ExpressionFault, Names, Symbol, is_reserved, is_valid_name, parse,
};
use crate::fault::{Fault, FaultKind, Faults, Place as FaultPlace, Source, nearest};
use crate::ids::{BodyId, CoordinateId, FormulaId, Frame, JointId};
use crate::units::Units;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The model that a text describes, or all its faults.
pub(super) fn read(text: &str) -> Result<Model, Faults> {
    let (sections, faults) = sections(text);
    let unreadable = faults.has_syntax_fault();
    let system = sections.units;
    let mut reader = Reader::new(text, &sections, faults);
    let mut model = reader.model(sections);
    let mut faults = std::mem::take(&mut reader.faults);
    let complete = faults.is_empty();
    faults.append(model.check(complete));
    model.units = Units::new(system.unwrap_or_default(), model.typed_units(text));
    if unreadable {
        faults = faults.without_absences();
    }
    faults.without_names_of_unknown_sections().without_consequences().or(model)
}

/// Returns whether an entry is a joint that slides along a line; one that could not be read may be one.
fn slides(entry: &super::file::Entry<JointContents>) -> bool {
    !matches!(entry.contents, Some(JointContents::Hinge(_) | JointContents::DiscOnDisc(_)))
}

/// The names of a joint, of both bearings if it is a pin that has two, and whether it slides.
fn names_of_joint(entry: &super::file::Entry<JointContents>) -> Vec<(String, bool)> {
    let ends = match &entry.contents {
        Some(JointContents::Hinge(table)) if table.bearings.is_some() => &hinges::ENDS[..],
        _ => &[""],
    };
    ends.iter().map(|end| (entry.name.clone() + end, slides(entry))).collect()
}

/// Names of the coordinates that are angles.
fn angles(sections: &Sections) -> Vec<String> {
    let is_angle = |entry: &&super::file::Entry<super::file::CoordinateTable>| {
        entry.contents.as_ref().is_some_and(|table| table.rotation.is_some())
    };
    sections.coordinates.iter().filter(is_angle).map(|entry| entry.name.clone()).collect()
}

/// Demands on a formula: its name in messages, its dimension and values, and with what it may vary.
struct Wanted {
    what: String,
    dimension: Dimension,
    allowed: Allowed,
    varies: Varies,
}

impl Wanted {
    /// A quantity that stays constant during the motion.
    fn constant(what: impl Into<String>, dimension: Dimension) -> Self {
        Self { what: what.into(), dimension, allowed: Allowed::Any, varies: Varies::Never }
    }

    /// A quantity that may depend on coordinates, rates and time.
    fn moving(what: impl Into<String>, dimension: Dimension) -> Self {
        Self { varies: Varies::WithMotion, ..Self::constant(what, dimension) }
    }

    /// A quantity that may depend on the sliding speed of its joint.
    fn with_speed(what: impl Into<String>, dimension: Dimension) -> Self {
        Self { varies: Varies::WithSpeed, ..Self::constant(what, dimension) }
    }

    fn positive(self) -> Self {
        Self { allowed: Allowed::Positive, ..self }
    }

    fn not_negative(self) -> Self {
        Self { allowed: Allowed::NotNegative, ..self }
    }
}

/// The names of a file and what has been read so far.
struct Reader<'t> {
    text: &'t str,
    faults: Faults,
    names: Names,
    formulas: Vec<Formula>,
    points: BTreeMap<String, NamedPoint>,
    owners: BTreeMap<String, Vec<BodyId>>,
    bodies: Vec<String>,
    /// The joints and whether they are sliding joints.
    joints: Vec<(String, bool)>,
    coordinates: Vec<String>,
    /// The coordinates that are angles.
    angles: Vec<String>,
    /// The number zero, where the file gives none.
    zero: FormulaId,
    /// Whether values may stand in for faulty ones.
    mended: bool,
    /// The formulas of outlines alone.
    looks: Vec<FormulaId>,
    /// The bodies that could not be read: what points they own is unknown.
    unread_bodies: Vec<BodyId>,
}

impl<'t> Reader<'t> {
    fn new(text: &'t str, sections: &Sections, faults: Faults) -> Self {
        let mut names = Names::new();
        let mut reader = Self {
            text,
            mended: !faults.is_empty(),
            unread_bodies: Vec::new(),
            looks: Vec::new(),
            faults,
            names: Names::new(),
            formulas: Vec::new(),
            points: BTreeMap::new(),
            owners: BTreeMap::new(),
            bodies: sections.bodies.iter().map(|entry| entry.name.clone()).collect(),
            joints: sections.joints.iter().flat_map(names_of_joint).collect(),
            coordinates: sections.coordinates.iter().map(|entry| entry.name.clone()).collect(),
            angles: angles(sections),
            zero: FormulaId(0),
        };
        for entry in &sections.parameters {
            reader.valid_name("parameter", &entry.name, &entry.span);
            names.parameter(&entry.name);
        }
        for entry in &sections.coordinates {
            reader.valid_name("coordinate", &entry.name, &entry.span);
            if sections.parameters.iter().any(|parameter| parameter.name == entry.name) {
                reader.fault(FaultKind::SharedName { name: entry.name.clone() }, &entry.span);
            }
            names.coordinate(&entry.name);
        }
        reader.names = names;
        reader.read_tables(sections);
        reader.zero = reader.number(0.0, &(0..0));
        reader
    }

    fn model(&mut self, sections: Sections) -> Model {
        let parameters = self.parameters(sections.parameters);
        let gravity = self.gravity(sections.gravity.as_ref());
        let wanted = Wanted::constant("the time", Dimension::TIME);
        let time = sections.time.as_ref().map(|time| self.formula(time, wanted));
        self.read_points(sections.points);
        let bodies = self.read_bodies(sections.bodies);
        let joints = self.read_joints(sections.joints);
        let coordinates = self.read_coordinates(sections.coordinates);
        let loads = self.read_loads(sections.loads);
        let drives = self.read_drives(sections.drives);
        let events = self.read_events(sections.events);
        self.propose_units(&parameters);
        Model {
            title: sections.title.map(|title| title.text),
            parameters,
            gravity,
            time,
            bodies,
            joints,
            loads,
            drives,
            coordinates,
            events,
            formulas: Arc::new(std::mem::take(&mut self.formulas)),
            units: Units::default(),
            doubts: Vec::new(),
            evaluation_order: Vec::new(),
            friction: 1.0,
            looks: std::mem::take(&mut self.looks),
        }
    }

    /// Has unknown units propose those of what is wanted there: of a parameter, what a formula wants that is nothing but it.
    fn propose_units(&mut self, parameters: &[Parameter]) {
        let formulas = &self.formulas;
        let is_parameter = |formula: &Formula, index: usize| {
            formula.expression.only_symbol().is_some_and(|symbol| symbol == Symbol::Parameter(index))
        };
        let wanted_of = |index: usize| {
            formulas.iter().filter(|formula| is_parameter(formula, index)).find_map(|formula| formula.wanted)
        };
        self.faults.propose_units(|place| {
            let holds = |formula: &Formula| {
                let span = &formula.origin.span;
                formula.broken && span.start <= place.span.start && place.span.end <= span.end
            };
            let index = formulas.iter().position(holds)?;
            let parameter = || parameters.iter().position(|parameter| parameter.value == FormulaId(index));
            formulas[index].wanted.or_else(|| wanted_of(parameter()?))
        });
    }

    fn fault(&mut self, kind: FaultKind, span: &super::quantity::Span) {
        self.faults.push(Fault::new(kind, FaultPlace::model(span.clone())));
    }

    fn valid_name(&mut self, what: &'static str, name: &str, span: &super::quantity::Span) {
        let reason = if !is_valid_name(name) {
            "names are made of letters, digits and _, and begin with a letter"
        } else if is_reserved(name) {
            "it already means something in expressions"
        } else if what == "body" && name == "ground" {
            "the fixed frame has this name"
        } else {
            return;
        };
        self.fault(FaultKind::InvalidName { what, name: name.to_owned(), reason }, span);
    }

    fn unknown_name<'a>(
        &mut self,
        what: &'static str,
        name: &Name,
        known: impl Iterator<Item = &'a str> + Clone,
    ) {
        // Its fault has been recorded.
        if self.mended && name.text.split('.').any(|part| part == STAND_IN) {
            return;
        }
        let kind = FaultKind::UnknownName {
            what,
            name: name.text.clone(),
            nearest: nearest(&name.text, known.clone()),
            known: known.map(str::to_owned).collect(),
        };
        self.fault(kind, &name.span);
    }

    // Formulas.

    fn push(&mut self, formula: Formula) -> FormulaId {
        self.formulas.push(formula);
        FormulaId(self.formulas.len() - 1)
    }

    /// A number that stands in no file.
    fn number(&mut self, value: f64, span: &super::quantity::Span) -> FormulaId {
        self.push(Formula {
            expression: Expression::constant(value),
            range: None,
            wanted: None,
            allowed: Allowed::Any,
            varies: Varies::Never,
            broken: false,
            what: Arc::from("a number"),
            origin: Origin { source: Source::Model, span: span.clone(), expression_start: None },
        })
    }

    fn formula(&mut self, quantity: &Quantity, wanted: Wanted) -> FormulaId {
        self.any_formula(quantity, wanted.what, Some(wanted.dimension), wanted.allowed, wanted.varies)
    }

    fn any_formula(
        &mut self,
        quantity: &Quantity,
        what: String,
        dimension: Option<Dimension>,
        allowed: Allowed,
        varies: Varies,
    ) -> FormulaId {
        let origin = self.origin(quantity);
        let parsed = match &quantity.written {
            Value::Number(value) if value.is_finite() => {
                let written = self.text.get(quantity.span.clone()).unwrap_or_default();
                Some((Expression::decimal(*value, written), None))
            }
            Value::Number(_) => {
                self.fault(FaultKind::NotFinite { what: what.clone() }, &quantity.span);
                None
            }
            Value::Text(text) if self.mended && text == STAND_IN => None,
            // Only parameters have any dimension and no motion; they may have a range.
            Value::Text(text) => match self.parse(text, dimension.is_none() && varies == Varies::Never) {
                Ok(value) => Some(value),
                Err(faults) => {
                    self.faults.extend(faults.into_iter().map(|fault| origin.fault(fault)));
                    None
                }
            },
        };
        let broken = parsed.is_none();
        let (expression, range) = parsed.unwrap_or_else(|| (Expression::constant(0.0), None));
        let what = Arc::from(what);
        self.push(Formula { expression, range, wanted: dimension, allowed, varies, broken, what, origin })
    }

    fn parse(&self, text: &str, may_be_range: bool) -> Result<Parsed, Vec<ExpressionFault>> {
        if may_be_range { parse_value(text, &self.names) } else { Ok((parse(text, &self.names)?, None)) }
    }

    fn components(&mut self, components: &Components, what: &str, dimension: Dimension) -> [FormulaId; 2] {
        let [x, y] = components;
        [
            self.formula(x, Wanted::constant(format!("the x component of {what}"), dimension)),
            self.formula(y, Wanted::constant(format!("the y component of {what}"), dimension)),
        ]
    }

    /// Components in the drawing, and the one out of it if it is given.
    fn in_space(
        &mut self,
        written: &InSpace,
        what: &str,
        dimension: Dimension,
    ) -> ([FormulaId; 2], Option<FormulaId>) {
        let components = self.components(&written.components, what, dimension);
        let wanted = Wanted::constant(format!("the z component of {what}"), dimension);
        (components, written.z.as_ref().map(|z| self.formula(z, wanted)))
    }

    fn parameters(&mut self, entries: Vec<super::file::Entry<Quantity>>) -> Vec<Parameter> {
        let mut parameters = Vec::new();
        for entry in entries {
            let what = format!("the parameter {}", entry.name);
            let value = match &entry.contents {
                Some(quantity) => self.any_formula(quantity, what, None, Allowed::Any, Varies::Never),
                None => self.broken(&entry.span),
            };
            parameters.push(Parameter { name: Arc::from(entry.name), value });
        }
        parameters
    }

    fn broken(&mut self, span: &super::quantity::Span) -> FormulaId {
        let id = self.number(0.0, span);
        self.formulas[id.index()].broken = true;
        id
    }

    fn gravity(&mut self, gravity: Option<&WrittenGravity>) -> Gravity {
        match gravity {
            None => Gravity::None,
            Some(WrittenGravity::Down(quantity)) => {
                Gravity::Down(self.formula(quantity, Wanted::constant("gravity", Dimension::ACCELERATION)))
            }
            Some(WrittenGravity::Components(components)) => {
                let (components, z) = self.in_space(components, "gravity", Dimension::ACCELERATION);
                Gravity::Components(components, z)
            }
        }
    }

    // References to other entries.

    fn frame(&mut self, name: &Name) -> Frame {
        if name.text == "ground" {
            return Frame::Ground;
        }
        if let Some(index) = self.bodies.iter().position(|body| *body == name.text) {
            return Frame::Body(BodyId(index));
        }
        let known: Vec<String> = self.bodies.iter().cloned().chain(["ground".to_owned()]).collect();
        self.unknown_name("body", name, known.iter().map(String::as_str));
        Frame::Ground
    }

    fn frame_or_ground(&mut self, name: Option<&Name>) -> Frame {
        name.map_or(Frame::Ground, |name| self.frame(name))
    }

    fn sliding_joint(&mut self, name: &Name) -> JointId {
        let found = self.joints.iter().position(|(joint, slides)| *slides && *joint == name.text);
        JointId(found.unwrap_or_else(|| {
            let known: Vec<String> =
                self.joints.iter().filter(|(_, slides)| *slides).map(|(joint, _)| joint.clone()).collect();
            self.unknown_name("sliding joint", name, known.iter().map(String::as_str));
            0
        }))
    }

    fn coordinate(&mut self, name: &Name) -> CoordinateId {
        let found = self.coordinates.iter().position(|coordinate| *coordinate == name.text);
        CoordinateId(found.unwrap_or_else(|| {
            let known = self.coordinates.clone();
            self.unknown_name("coordinate", name, known.iter().map(String::as_str));
            0
        }))
    }

    /// A place of the drawing, whatever it belongs to.
    fn place(&mut self, place: &Place, what: &str) -> [FormulaId; 2] {
        self.place_in_space(place, what).0
    }

    /// A place of the drawing, and how far it is out of it if that is given.
    fn place_in_space(&mut self, place: &Place, what: &str) -> ([FormulaId; 2], Option<FormulaId>) {
        match place {
            Place::Coordinates(written) => self.in_space(written, what, Dimension::LENGTH),
            Place::Point(name) => {
                let NamedPoint { position, z, .. } = self.point(name);
                (position, z)
            }
        }
    }

    /// A named point of the drawing; a body in front of the name does not matter here.
    fn point(&mut self, name: &Name) -> NamedPoint {
        let bare = name.text.rsplit_once('.').map_or(name.text.as_str(), |(_, point)| point);
        if let Some(point) = self.points.get(bare) {
            return point.clone();
        }
        let known: Vec<String> = self.points.keys().cloned().collect();
        let unknown = Name { text: bare.to_owned(), span: name.span.clone() };
        self.unknown_name("point", &unknown, known.iter().map(String::as_str));
        let broken = self.broken(&name.span);
        NamedPoint { name: Arc::from(bare), position: [broken; 2], z: None }
    }

    fn along(&mut self, direction: &Direction, what: &str) -> Along {
        match direction {
            Direction::Angle(quantity) => {
                Along::Angle(self.formula(quantity, Wanted::constant(what, Dimension::ANGLE)))
            }
            Direction::Points([from, to]) => Along::Points(Box::new([self.point(from), self.point(to)])),
        }
    }
}
