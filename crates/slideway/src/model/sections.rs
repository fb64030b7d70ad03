//! The sections of a model file: TOML text to the tables of [`super::file`], entry by entry, so that one
//! faulty entry hides no other.

use super::SliderKind;
use super::file::{
    BodyTable, ContactTable, CoordinateTable, DamperTable, DiscOnDiscTable, DriveTable, Entry, EventTable,
    ForceTable, HingeTable, SliderTable, SpringTable, TableTable, TorqueTable, TorsionalDamperTable,
    TorsionalSpringTable,
};
use super::quantity::{Gravity, InSpace, Name, Quantity};
use super::structure::StructureCheck;
use crate::expression::ExpressionFaultKind;
use crate::fault::{Fault, FaultKind, Faults, Place};
use crate::units::UnitSystem;
use serde::de::DeserializeOwned;
use std::sync::OnceLock;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// Everything a model file says, not yet checked against itself.
pub(super) struct Sections {
    pub(super) title: Option<Name>,
    pub(super) gravity: Option<Gravity>,
    pub(super) time: Option<Quantity>,
    pub(super) units: Option<UnitSystem>,
    pub(super) parameters: Vec<Entry<Quantity>>,
    pub(super) tables: Vec<Entry<TableTable>>,
    pub(super) points: Vec<Entry<InSpace>>,
    pub(super) bodies: Vec<Entry<BodyTable>>,
    pub(super) joints: Vec<Entry<JointContents>>,
    pub(super) loads: Vec<Entry<LoadContents>>,
    pub(super) drives: Vec<Entry<DriveTable>>,
    pub(super) coordinates: Vec<Entry<CoordinateTable>>,
    pub(super) events: Vec<Entry<EventTable>>,
}

/// A joint between two bodies.
pub(super) enum JointContents {
    Hinge(Box<HingeTable>),
    Slider(Box<SliderContents>),
    DiscOnDisc(Box<(DiscOnDiscTable, ContactTable)>),
}

/// A sliding joint: one table of the file, read as that of the joint and as that of its contacts.
pub(super) struct SliderContents {
    pub(super) kind: SliderKind,
    /// Whether its contacts lift off their face in place of pressing another one.
    pub(super) opens: bool,
    pub(super) joint: SliderTable,
    pub(super) contacts: ContactTable,
}

/// A force, torque, spring or damper.
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[cfg_attr(test, schemars(tag = "type", rename_all = "snake_case", rename = "LoadTable"))]
pub(super) enum LoadContents {
    /// A force at a point.
    Force(ForceTable),
    /// A torque on a body.
    Torque(TorqueTable),
    /// A linear spring between two points.
    Spring(SpringTable),
    /// A linear damper between two points.
    Damper(DamperTable),
    /// A linear torsional spring between two bodies.
    TorsionalSpring(TorsionalSpringTable),
    /// A linear torsional damper between two bodies.
    TorsionalDamper(TorsionalDamperTable),
}

/// Reads all sections; the faults are those of syntax and structure.
pub(super) fn sections(text: &str) -> (Sections, Faults) {
    static SCHEMA: OnceLock<serde_json::Value> = OnceLock::new();
    let schema = SCHEMA.get_or_init(super::json_schema);
    let (document, errors) = DeTable::parse_recoverable(text);
    let (mut faults, broken_lines) = syntax_faults(text, document.get_ref(), &errors);
    let mut check = StructureCheck::new(schema, broken_lines);
    check.root(document.get_ref());
    let mut reader = SectionReader { check, text, faults: Faults::default() };
    let mut root = document.into_inner();
    let sections = Sections {
        title: reader.single(&mut root, "title"),
        gravity: reader.single(&mut root, "gravity"),
        time: reader.single(&mut root, "time"),
        units: reader.single(&mut root, "units"),
        parameters: reader.section(&mut root, "parameters", deserialize),
        tables: reader.section(&mut root, "tables", deserialize),
        points: reader.section(&mut root, "points", deserialize),
        bodies: reader.section(&mut root, "bodies", deserialize),
        joints: reader.section(&mut root, "joints", joint),
        loads: reader.section(&mut root, "loads", load),
        drives: reader.section(&mut root, "drives", deserialize),
        coordinates: reader.section(&mut root, "coordinates", deserialize),
        events: reader.section(&mut root, "events", deserialize),
    };
    faults.append(reader.faults);
    faults.append(reader.check.into_faults());
    (sections, faults)
}

/// The faults of syntax, one for each line, and the stretches that could not be read.
///
/// A list that is never closed swallows what follows it: it is one fault, not one for each line.
fn syntax_faults(
    text: &str,
    document: &DeTable<'_>,
    errors: &[toml::de::Error],
) -> (Faults, Vec<std::ops::Range<usize>>) {
    let mut places: Vec<(std::ops::Range<usize>, &str)> =
        errors.iter().map(|error| (within(text, error.span().unwrap_or(0..0)), error.message())).collect();
    places.sort_by_key(|(span, _)| span.start);
    let mut faults = Faults::default();
    let mut broken = Vec::new();
    let mut push = |span, message: &str| {
        let kind = FaultKind::Syntax { message: message.to_owned() };
        faults.push(Fault::new(kind, Place::model(span)));
    };
    let assignment = places.iter().find(|(_, message)| message.starts_with("unexpected `=` in array"));
    let unclosed = assignment.and_then(|(span, _)| list_around(document, span.start));
    let end = unclosed.as_ref().map_or(text.len(), |list| list.start);
    for (index, (span, message)) in places.iter().enumerate() {
        let line = line_around(text, span.start);
        let first = !places[..index].iter().any(|(other, _)| line.start <= other.start);
        if first && span.start <= end {
            push(span.clone(), message);
        }
        broken.push(line);
    }
    if let Some(list) = unclosed {
        push(list.start..list.start + 1, "this list is never closed, expected `]`");
        broken.push(list.start..text.len());
    }
    (faults, broken)
}

/// The innermost list of the document around a place.
fn list_around(table: &DeTable<'_>, place: usize) -> Option<std::ops::Range<usize>> {
    table.values().find_map(|value| {
        let span = value.span();
        match value.get_ref() {
            DeValue::Table(table) => list_around(table, place),
            DeValue::Array(_) if span.start <= place && place <= span.end => Some(span),
            _ => None,
        }
    })
}

struct SectionReader<'t, 's> {
    check: StructureCheck<'s>,
    text: &'t str,
    faults: Faults,
}

impl SectionReader<'_, '_> {
    fn single<T: DeserializeOwned>(&mut self, root: &mut DeTable<'_>, key: &str) -> Option<T> {
        let mut value = root.remove(key)?;
        if !self.check.mend(&[key], &mut value) {
            return None;
        }
        self.keep(deserialize(value))
    }

    /// The entries of a section in the order of the file; faulty ones keep their names.
    fn section<'i, T>(
        &mut self,
        root: &mut DeTable<'i>,
        key: &str,
        contents: fn(Spanned<DeValue<'i>>) -> Result<T, toml::de::Error>,
    ) -> Vec<Entry<T>> {
        let Some(section) = root.remove(key) else { return Vec::new() };
        let DeValue::Table(table) = section.into_inner() else { return Vec::new() };
        if !self.check.has_entries(key) {
            return Vec::new();
        }
        let mut entries: Vec<Entry<T>> = table
            .into_iter()
            .map(|(name, mut value)| {
                let readable = self.check.mend(&[key, name.get_ref()], &mut value);
                let span = within(self.text, name.span());
                let contents = if readable { self.keep(contents(value)) } else { None };
                Entry { name: name.into_inner().into_owned(), span, contents }
            })
            .collect();
        entries.sort_by_key(|entry| entry.span.start);
        entries
    }

    /// Records what the schema let through but the types refuse, such as an integer beyond 64 bits. Returns
    /// `None` for it.
    fn keep<T>(&mut self, result: Result<T, toml::de::Error>) -> Option<T> {
        result
            .map_err(|error| {
                let span = error.span().unwrap_or(0..0);
                if self.check.is_broken(span.start) {
                    return;
                }
                let kind = if error.message().contains("overflow") {
                    FaultKind::Expression(ExpressionFaultKind::NumberTooLarge)
                } else {
                    FaultKind::Syntax { message: error.message().to_owned() }
                };
                self.faults.push(Fault::new(kind, Place::model(within(self.text, span))));
            })
            .ok()
    }
}

fn deserialize<T: DeserializeOwned>(value: Spanned<DeValue<'_>>) -> Result<T, toml::de::Error> {
    T::deserialize(ValueDeserializer::from(value))
}

/// Takes the `type` out of a table that the structure check has passed.
fn type_of(value: Spanned<DeValue<'_>>) -> (String, Spanned<DeValue<'_>>) {
    let span = value.span();
    match value.into_inner() {
        DeValue::Table(mut table) => {
            let kind = table.remove("type").and_then(|kind| kind.get_ref().as_str().map(str::to_owned));
            (kind.unwrap_or_default(), Spanned::new(span, DeValue::Table(table)))
        }
        other => (String::new(), Spanned::new(span, other)),
    }
}

fn joint(value: Spanned<DeValue<'_>>) -> Result<JointContents, toml::de::Error> {
    let (kind, value) = type_of(value);
    let (kind, opens) = match kind.as_str() {
        "hinge" => return Ok(JointContents::Hinge(Box::new(deserialize(value)?))),
        "block_slider" => (SliderKind::Block, false),
        "block_on_face" => (SliderKind::Block, true),
        "guided_slider" => (SliderKind::Guided, false),
        "corner_on_face" | "disc_on_face" => (SliderKind::Pin, true),
        "disc_on_disc" => {
            let contents = (deserialize(value.clone())?, deserialize(value)?);
            return Ok(JointContents::DiscOnDisc(Box::new(contents)));
        }
        _ => (SliderKind::Pin, false),
    };
    let joint = deserialize(value.clone())?;
    let contacts = deserialize(without_place(value))?;
    Ok(JointContents::Slider(Box::new(SliderContents { kind, opens, joint, contacts })))
}

/// Takes the place of a joint out of its table: that of a contact is another kind of value.
fn without_place(mut joint: Spanned<DeValue<'_>>) -> Spanned<DeValue<'_>> {
    if let DeValue::Table(table) = joint.get_mut() {
        table.remove("at");
    }
    joint
}

fn load(value: Spanned<DeValue<'_>>) -> Result<LoadContents, toml::de::Error> {
    let (kind, value) = type_of(value);
    Ok(match kind.as_str() {
        "force" => LoadContents::Force(deserialize(value)?),
        "torque" => LoadContents::Torque(deserialize(value)?),
        "spring" => LoadContents::Spring(deserialize(value)?),
        "damper" => LoadContents::Damper(deserialize(value)?),
        "torsional_spring" => LoadContents::TorsionalSpring(deserialize(value)?),
        _ => LoadContents::TorsionalDamper(deserialize(value)?),
    })
}

/// `span` cut to the text and to whole characters.
fn within(text: &str, span: std::ops::Range<usize>) -> std::ops::Range<usize> {
    let floor = |mut offset: usize| {
        offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        offset
    };
    floor(span.start)..floor(span.end.max(span.start))
}

/// The line that contains `offset`, with its line end.
fn line_around(text: &str, offset: usize) -> std::ops::Range<usize> {
    let offset = within(text, offset..offset).start;
    let start = text[..offset].rfind('\n').map_or(0, |at| at + 1);
    let end = text[offset..].find('\n').map_or(text.len(), |at| offset + at + 1);
    start..end
}
