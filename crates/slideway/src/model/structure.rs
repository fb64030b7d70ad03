//! Compares the tables of a model file with the JSON Schema of the format, and reports every difference.
//!
//! The schema is made from the types in [`super::file`], so reader, editor support and error messages cannot
//! disagree about which keys exist.

use super::quantity::Span;
use crate::fault::{Fault, FaultKind, Faults, Place, nearest};
use serde_json::Value as Schema;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Walks a parsed file beside its schema.
///
/// Lines with a syntax error are passed over: what the parser made of them is not what was meant.
pub(super) struct StructureCheck<'s> {
    root: &'s Schema,
    broken_lines: Vec<Span>,
    faults: Faults,
    faulty: Vec<String>,
}

impl<'s> StructureCheck<'s> {
    /// A check against the whole schema `root`, in which references are looked up.
    pub(super) fn new(root: &'s Schema, broken_lines: Vec<Span>) -> Self {
        Self { root, broken_lines, faults: Faults::default(), faulty: Vec::new() }
    }

    /// Checks a whole file.
    pub(super) fn root(&mut self, document: &DeTable<'_>) {
        self.table(document, &(0..0), self.root, "");
    }

    /// Whether nothing at or below `place` is faulty.
    pub(super) fn is_sound(&self, place: &str) -> bool {
        !self.faulty.iter().any(|faulty| {
            faulty.strip_prefix(place).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        })
    }

    fn push(&mut self, kind: FaultKind, span: Span, place: &str) {
        self.faulty.push(place.to_owned());
        let broken = |line: &Span| line.start <= span.start && span.start < line.end;
        if !self.broken_lines.iter().any(broken) {
            self.faults.push(Fault::new(kind, Place::model(span)));
        }
    }

    /// All that was found.
    pub(super) fn into_faults(self) -> Faults {
        self.faults
    }

    /// Checks `value` against `schema`; `place` names it in messages.
    fn value(&mut self, value: &Spanned<DeValue<'_>>, schema: &'s Schema, place: &str) {
        let schema = self.resolve(schema);
        if let Some(alternatives) = schema.get("oneOf").and_then(Schema::as_array) {
            return match tagged(alternatives) {
                Some(tags) => self.tagged(value, &tags, place),
                None => self.choice(value, alternatives, place),
            };
        }
        if let Some(alternatives) = schema.get("anyOf").and_then(Schema::as_array) {
            let present: Vec<_> = alternatives.iter().filter(|a| a["type"] != "null").collect();
            let kind = kind(value.get_ref());
            let fitting = present.iter().find(|a| self.kinds(a).contains(&kind));
            return match fitting {
                Some(fitting) => self.value(value, fitting, place),
                None => {
                    self.wrong_type(value, alternatives.iter().flat_map(|a| self.kinds(a)).collect(), place);
                }
            };
        }
        let kinds = self.kinds(schema);
        let found = kind(value.get_ref());
        if !kinds.is_empty() && !kinds.contains(&found) {
            return self.wrong_type(value, kinds, place);
        }
        if let Some(words) = schema.get("enum").and_then(Schema::as_array) {
            return self.word(value, &words.iter().filter_map(Schema::as_str).collect::<Vec<_>>(), place);
        }
        match value.get_ref() {
            DeValue::Table(table) => self.table(table, &value.span(), schema, place),
            DeValue::Array(items) => self.array(items, &value.span(), schema, place),
            _ => (),
        }
    }

    /// Checks the keys of a table.
    fn table(&mut self, table: &DeTable<'_>, span: &Span, schema: &'s Schema, place: &str) {
        let schema = self.resolve(schema);
        let properties = schema.get("properties").and_then(Schema::as_object);
        for (key, value) in table {
            let name: &str = key.get_ref();
            let inner = if place.is_empty() { name.to_owned() } else { format!("{place}.{name}") };
            let of_map = schema.get("additionalProperties").filter(|s| s.is_object());
            match properties.and_then(|properties| properties.get(name)).or(of_map) {
                Some(schema) => self.value(value, schema, &inner),
                None => self.unknown_key(key, properties, place),
            }
        }
        let required = schema.get("required").and_then(Schema::as_array);
        for key in required.into_iter().flatten().filter_map(Schema::as_str) {
            if !table.contains_key(key) {
                let kind = FaultKind::MissingKey { key: key.to_owned(), table: place.to_owned() };
                self.push(kind, span.clone(), place);
            }
        }
    }

    fn unknown_key(
        &mut self,
        key: &Spanned<std::borrow::Cow<'_, str>>,
        properties: Option<&serde_json::Map<String, Schema>>,
        place: &str,
    ) {
        let known: Vec<&str> = properties.into_iter().flat_map(|p| p.keys()).map(String::as_str).collect();
        let kind = FaultKind::UnknownKey {
            key: key.get_ref().to_string(),
            table: place.to_owned(),
            nearest: nearest(key.get_ref(), known.iter().copied()),
            known: known.iter().map(ToString::to_string).collect(),
        };
        self.push(kind, key.span(), place);
    }

    fn array(&mut self, items: &[Spanned<DeValue<'_>>], span: &Span, schema: &'s Schema, place: &str) {
        let least = schema.get("minItems").and_then(Schema::as_u64).unwrap_or(0);
        let most = schema.get("maxItems").and_then(Schema::as_u64).unwrap_or(u64::MAX);
        if !(least..=most).contains(&(items.len() as u64)) {
            let kind = FaultKind::WrongLength { place: place.to_owned(), wanted: least, found: items.len() };
            self.push(kind, span.clone(), place);
            return;
        }
        let Some(schema) = schema.get("items") else { return };
        for item in items {
            self.value(item, schema, place);
        }
    }

    fn tagged(&mut self, value: &Spanned<DeValue<'_>>, tags: &[(&'s str, &'s Schema)], place: &str) {
        let DeValue::Table(table) = value.get_ref() else {
            return self.wrong_type(value, vec!["table"], place);
        };
        let names: Vec<&str> = tags.iter().map(|(tag, _)| *tag).collect();
        let Some(tag) = table.get("type") else {
            let kind = FaultKind::MissingType { table: place.to_owned(), known: owned(&names) };
            self.push(kind, value.span(), place);
            return;
        };
        match tags.iter().find(|(name, _)| Some(*name) == tag.get_ref().as_str()) {
            Some((_, schema)) => self.table(table, &value.span(), schema, place),
            None => self.word(tag, &names, &format!("{place}.type")),
        }
    }

    /// One of several words, each with its description (an enumeration with documented variants).
    fn choice(&mut self, value: &Spanned<DeValue<'_>>, alternatives: &'s [Schema], place: &str) {
        let words: Vec<&str> = alternatives.iter().filter_map(|a| a["const"].as_str()).collect();
        self.word(value, &words, place);
    }

    fn word(&mut self, value: &Spanned<DeValue<'_>>, words: &[&str], place: &str) {
        let Some(text) = value.get_ref().as_str() else {
            return self.wrong_type(value, vec!["text"], place);
        };
        if words.contains(&text) {
            return;
        }
        let kind = FaultKind::UnknownWord {
            place: place.to_owned(),
            word: text.to_owned(),
            nearest: nearest(text, words.iter().copied()),
            known: owned(words),
        };
        self.push(kind, value.span(), place);
    }

    fn wrong_type(&mut self, value: &Spanned<DeValue<'_>>, mut wanted: Vec<&'static str>, place: &str) {
        wanted.retain(|kind| *kind != "nothing");
        wanted.dedup();
        let kind = FaultKind::WrongType {
            place: place.to_owned(),
            wanted: wanted.join(" or "),
            found: kind(value.get_ref()),
        };
        self.push(kind, value.span(), place);
    }

    fn resolve(&self, schema: &'s Schema) -> &'s Schema {
        match schema.get("$ref").and_then(Schema::as_str) {
            Some(reference) => self.root.pointer(reference.trim_start_matches('#')).unwrap_or(schema),
            None => schema,
        }
    }

    /// The kinds of value that a schema allows, in the words of the messages.
    fn kinds(&self, schema: &'s Schema) -> Vec<&'static str> {
        let schema = self.resolve(schema);
        let inner = schema.get("anyOf").or(schema.get("oneOf")).and_then(Schema::as_array);
        match (schema.get("type"), inner) {
            (Some(Schema::String(name)), _) => vec![kind_of_schema(name)],
            (Some(Schema::Array(names)), _) => {
                names.iter().filter_map(Schema::as_str).map(kind_of_schema).collect()
            }
            (_, Some(alternatives)) => alternatives.iter().flat_map(|a| self.kinds(a)).collect(),
            _ => vec![],
        }
    }
}

fn owned(words: &[&str]) -> Vec<String> {
    words.iter().map(ToString::to_string).collect()
}

/// The alternatives of a tagged union by their `type`, or nothing if it is none.
fn tagged(alternatives: &[Schema]) -> Option<Vec<(&str, &Schema)>> {
    let tag = |a| Schema::pointer(a, "/properties/type/const").and_then(Schema::as_str);
    alternatives.iter().map(|a| tag(a).map(|tag| (tag, a))).collect()
}

/// Integers count as numbers: a quantity may be written without a decimal point.
fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "text",
        DeValue::Integer(_) | DeValue::Float(_) => "number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "date",
        DeValue::Array(_) => "list",
        DeValue::Table(_) => "table",
    }
}

fn kind_of_schema(name: &str) -> &'static str {
    match name {
        "string" => "text",
        "number" | "integer" => "number",
        "boolean" => "true or false",
        "array" => "list",
        "object" => "table",
        _ => "nothing",
    }
}
