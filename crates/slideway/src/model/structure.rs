//! Compares the tables of a model file with the JSON Schema of the format, and reports every difference.
//!
//! The schema is made from the types in [`super::file`], so reader, editor support and error messages cannot
//! disagree about which keys exist.

use super::quantity::Span;
use crate::fault::{Fault, FaultKind, Faults, Place, nearest};
use serde_json::Value as Schema;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Text of the values that stand in for missing and faulty ones, so that the rest of their table can be read.
///
/// It means nothing but where a fault has been recorded, and no model with a fault is ever used.
pub(super) const STAND_IN: &str = "\u{1}";

/// Walks a parsed file beside its schema.
///
/// Lines with a syntax error are passed over: what the parser made of them is not what was meant.
pub(super) struct StructureCheck<'s> {
    root: &'s Schema,
    broken_lines: Vec<Span>,
    faults: Faults,
    /// The keys that lead to the value under examination.
    path: Vec<String>,
    mends: Vec<Mend<'s>>,
}

/// How the value at the end of a path of keys becomes readable.
struct Mend<'s> {
    path: Vec<String>,
    with: StandIn<'s>,
}

/// Stand-in that takes the place of a value.
#[derive(Clone, Copy)]
enum StandIn<'s> {
    Text,
    /// This word.
    Word(&'s str),
    Pair,
    True,
    /// Nothing: the key is taken out.
    Removed,
    /// There is none: the whole entry cannot be read.
    Impossible,
}

impl<'s> StructureCheck<'s> {
    /// A check against the whole schema `root`, in which references are looked up.
    pub(super) fn new(root: &'s Schema, broken_lines: Vec<Span>) -> Self {
        Self { root, broken_lines, faults: Faults::default(), path: Vec::new(), mends: Vec::new() }
    }

    /// Checks a whole file.
    pub(super) fn root(&mut self, document: &DeTable<'_>) {
        self.table(document, &(0..0), self.root, "");
    }

    /// Puts stand-ins for what is missing or faulty in the value at the end of `path`; whether it can be read
    /// then.
    pub(super) fn mend(&self, path: &[&str], value: &mut Spanned<DeValue<'_>>) -> bool {
        let within = |mend: &&Mend<'_>| mend.path.iter().zip(path).all(|(key, wanted)| key == wanted);
        self.mends.iter().filter(within).all(|mend| match mend.path.get(path.len()..) {
            Some(keys) => mend.apply(keys, value),
            None => false,
        })
    }

    /// Whether a section consists of entries, as it should.
    pub(super) fn has_entries(&self, section: &str) -> bool {
        !self.mends.iter().any(|mend| mend.path == [section])
    }

    /// Whether a place lies in what could not be read.
    pub(super) fn is_broken(&self, place: usize) -> bool {
        self.broken_lines.iter().any(|line| line.start <= place && place < line.end)
    }

    /// Records a fault, and how the value at the present path is to be mended.
    fn push(&mut self, kind: FaultKind, span: Span, with: StandIn<'s>) {
        self.mends.push(Mend { path: self.path.clone(), with });
        self.record(kind, span);
    }

    fn record(&mut self, kind: FaultKind, span: Span) {
        if !self.is_broken(span.start) {
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
            if let Some(fitting) = fitting {
                return self.value(value, fitting, place);
            }
            let wanted = alternatives.iter().flat_map(|a| self.kinds(a)).collect();
            return self.wrong_type(value, wanted, place, self.stand_in(schema));
        }
        let kinds = self.kinds(schema);
        let found = kind(value.get_ref());
        if !kinds.is_empty() && !kinds.contains(&found) {
            return self.wrong_type(value, kinds, place, self.stand_in(schema));
        }
        if let Some(words) = schema.get("enum").and_then(Schema::as_array) {
            let words: Vec<&str> = words.iter().filter_map(Schema::as_str).collect();
            return self.word(value, &words, place, StandIn::Removed);
        }
        match value.get_ref() {
            DeValue::Table(table) => self.table(table, &value.span(), schema, place),
            DeValue::Array(items) => self.array(items, &value.span(), schema, place),
            _ => (),
        }
    }

    /// Checks the keys of a table; `span` is that of its heading.
    fn table(&mut self, table: &DeTable<'_>, span: &Span, schema: &'s Schema, place: &str) {
        let schema = self.resolve(schema);
        if self.path.len() == 1 && self.lacks_headings(table, span, schema, place) {
            return;
        }
        let properties = schema.get("properties").and_then(Schema::as_object);
        let mut misspelt = Vec::new();
        for (key, value) in table {
            let name: &str = key.get_ref();
            let inner = if place.is_empty() { name.to_owned() } else { format!("{place}.{name}") };
            let of_map = schema.get("additionalProperties").filter(|s| s.is_object());
            match properties.and_then(|properties| properties.get(name)).or(of_map) {
                Some(tag) if tag.get("const").is_some() => (),
                Some(schema) => {
                    self.path.push(name.to_owned());
                    self.value(value, schema, &inner);
                    self.path.pop();
                }
                None => misspelt.extend(self.unknown_key(key, properties, place)),
            }
        }
        let required = schema.get("required").and_then(Schema::as_array);
        let required = required.into_iter().flatten().filter_map(Schema::as_str);
        // The tag of an alternative is the affair of `tagged`.
        let is_tag = |key: &str| properties.is_some_and(|all| all[key].get("const").is_some());
        let missing: Vec<&str> = required.filter(|key| !table.contains_key(*key) && !is_tag(key)).collect();
        // A mistyped key is one fault, even where the key that was meant is required.
        let absent = missing.iter().filter(|key| !misspelt.iter().any(|meant| meant == *key));
        for key in absent {
            let kind = FaultKind::MissingKey { key: (*key).to_owned(), table: place.to_owned() };
            if place.is_empty() {
                self.faults.push(Fault::general(kind));
            } else {
                self.record(kind, span.clone());
            }
        }
        let meant = misspelt.iter().map(String::as_str);
        for key in missing.iter().copied().chain(meant).filter(|key| !table.contains_key(*key)) {
            let schema = properties.and_then(|properties| properties.get(key));
            let with = schema.map_or(StandIn::Impossible, |schema| self.stand_in(schema));
            let with = if missing.contains(&key) { with } else { with.if_text() };
            let path = self.path.iter().cloned().chain([key.to_owned()]).collect();
            self.mends.push(Mend { path, with });
        }
    }

    /// Whether a section of named tables holds values of its own, as if the name were missing in its heading.
    fn lacks_headings(&mut self, table: &DeTable<'_>, span: &Span, schema: &'s Schema, place: &str) -> bool {
        let of_entry = schema.get("additionalProperties").filter(|s| s.is_object());
        let is_table = |schema| {
            let resolved = self.resolve(schema);
            let tagged = resolved.get("oneOf").and_then(Schema::as_array).and_then(|all| tagged(all));
            tagged.is_some() || self.kinds(schema) == ["table"]
        };
        let values = table.values().any(|value| value.get_ref().as_table().is_none());
        let lacking = values && of_entry.is_some_and(is_table);
        if lacking {
            let kind = FaultKind::NoHeading { section: place.to_owned() };
            self.push(kind, span.clone(), StandIn::Impossible);
        }
        lacking
    }

    /// Returns the stand-in for a value of this schema.
    fn stand_in(&self, schema: &'s Schema) -> StandIn<'s> {
        let schema = self.resolve(schema);
        if schema.get("enum").is_some() {
            return StandIn::Removed;
        }
        let inner = schema.get("anyOf").and_then(Schema::as_array);
        if let Some(alternatives) = inner {
            let all = alternatives.iter().filter(|a| a["type"] != "null").map(|a| self.stand_in(a));
            return all.reduce(StandIn::simpler).unwrap_or(StandIn::Impossible);
        }
        if schema.get("oneOf").is_some() {
            let words =
                schema["oneOf"].as_array().is_some_and(|all| all.iter().all(|a| a["const"].is_string()));
            return if words { StandIn::Removed } else { StandIn::Impossible };
        }
        let kinds = self.kinds(schema);
        if kinds.contains(&"text") {
            StandIn::Text
        } else if kinds.contains(&"list") && schema["minItems"] == 2 {
            StandIn::Pair
        } else if kinds.contains(&"true or false") {
            StandIn::True
        } else {
            StandIn::Impossible
        }
    }

    fn unknown_key(
        &mut self,
        key: &Spanned<std::borrow::Cow<'_, str>>,
        properties: Option<&serde_json::Map<String, Schema>>,
        place: &str,
    ) -> Option<String> {
        let known: Vec<&str> = properties.into_iter().flat_map(|p| p.keys()).map(String::as_str).collect();
        let nearest = nearest(key.get_ref(), known.iter().copied());
        let kind = FaultKind::UnknownKey {
            key: key.get_ref().to_string(),
            table: place.to_owned(),
            nearest: nearest.clone(),
            known: known.iter().map(ToString::to_string).collect(),
        };
        self.record(kind, key.span());
        nearest
    }

    fn array(&mut self, items: &[Spanned<DeValue<'_>>], span: &Span, schema: &'s Schema, place: &str) {
        let least = schema.get("minItems").and_then(Schema::as_u64).unwrap_or(0);
        let most = schema.get("maxItems").and_then(Schema::as_u64).unwrap_or(u64::MAX);
        if !(least..=most).contains(&(items.len() as u64)) {
            let (place, found) = (place.to_owned(), items.len());
            let kind = if most == u64::MAX {
                FaultKind::TooShort { place, least, found }
            } else {
                FaultKind::WrongLength { place, wanted: least, found }
            };
            self.push(kind, span.clone(), self.stand_in(schema));
            return;
        }
        let Some(of_item) = schema.get("items") else { return };
        let before = self.mends.len();
        for item in items {
            self.value(item, of_item, place);
        }
        // A stand-in takes the place of the whole list.
        let with = self.stand_in(schema);
        self.mends[before..].iter_mut().for_each(|mend| mend.with = with);
    }

    fn tagged(&mut self, value: &Spanned<DeValue<'_>>, tags: &[(&'s str, &'s Schema)], place: &str) {
        let DeValue::Table(table) = value.get_ref() else {
            return self.wrong_type(value, vec!["table"], place, StandIn::Impossible);
        };
        let names: Vec<&str> = tags.iter().map(|(tag, _)| *tag).collect();
        let meant = self.meant(table, tags);
        let with = meant.map_or(StandIn::Impossible, |(word, _)| StandIn::Word(word));
        self.path.push("type".to_owned());
        if let Some(tag) = table.get("type") {
            self.word(tag, &names, &format!("{place}.type"), with);
        } else {
            let kind = FaultKind::MissingType { table: place.to_owned(), known: owned(&names) };
            self.push(kind, value.span(), with);
        }
        self.path.pop();
        if let Some((_, schema)) = meant {
            self.table(table, &value.span(), schema, place);
        }
    }

    /// Returns the alternative that the `type` of a table names or nearly names, else the only one that has all keys that
    /// were written: its other faults are told beside that of its type.
    fn meant(&self, table: &DeTable<'_>, tags: &[(&'s str, &'s Schema)]) -> Option<(&'s str, &'s Schema)> {
        let written = table.get("type").and_then(|tag| tag.get_ref().as_str());
        let nearest = written.and_then(|word| nearest(word, tags.iter().map(|(tag, _)| *tag)));
        let named = |word: &str| tags.iter().find(|(tag, _)| *tag == word).copied();
        if let Some(found) = written.and_then(named).or(nearest.as_deref().and_then(named)) {
            return Some(found);
        }
        let has_all = |schema: &Schema| {
            let keys = self.resolve(schema).get("properties").and_then(Schema::as_object);
            keys.is_some_and(|keys| table.keys().all(|key| keys.contains_key(key.get_ref().as_ref())))
        };
        let mut fitting = tags.iter().filter(|(_, schema)| has_all(schema));
        fitting.next().filter(|_| fitting.next().is_none()).copied()
    }

    /// One of several words, each with its description (an enumeration with documented variants).
    fn choice(&mut self, value: &Spanned<DeValue<'_>>, alternatives: &'s [Schema], place: &str) {
        let words: Vec<&str> = alternatives.iter().filter_map(|a| a["const"].as_str()).collect();
        self.word(value, &words, place, StandIn::Removed);
    }

    fn word(&mut self, value: &Spanned<DeValue<'_>>, words: &[&str], place: &str, with: StandIn<'s>) {
        let Some(text) = value.get_ref().as_str() else {
            return self.wrong_type(value, vec!["text"], place, with);
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
        self.push(kind, value.span(), with);
    }

    fn wrong_type(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        wanted: Vec<&'static str>,
        place: &str,
        with: StandIn<'s>,
    ) {
        let mut unique: Vec<&str> = Vec::new();
        for kind in wanted.into_iter().filter(|kind| *kind != "nothing").map(with_article) {
            if !unique.contains(&kind) {
                unique.push(kind);
            }
        }
        let wanted = match unique.split_last() {
            Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
            _ => unique.concat(),
        };
        let found = with_article(kind(value.get_ref()));
        self.push(FaultKind::WrongType { place: place.to_owned(), wanted, found }, value.span(), with);
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

impl StandIn<'_> {
    /// The one that fits where both would.
    fn simpler(self, other: Self) -> Self {
        match (self, other) {
            (Self::Text, _) | (_, Self::Text) => Self::Text,
            (Self::Impossible, other) => other,
            (first, _) => first,
        }
    }

    /// An optional key that was mistyped gets a stand-in only if a text can be one.
    fn if_text(self) -> Self {
        if matches!(self, Self::Text) { self } else { Self::Removed }
    }
}

impl Mend<'_> {
    /// Mends the value at the end of `keys`; whether that was possible.
    fn apply(&self, keys: &[String], value: &mut Spanned<DeValue<'_>>) -> bool {
        let span = value.span();
        let text = || Spanned::new(span.clone(), DeValue::String(STAND_IN.into()));
        let stand_in = match self.with {
            StandIn::Word(word) => DeValue::String(word.to_owned().into()),
            StandIn::Text => text().into_inner(),
            StandIn::Pair => DeValue::Array([text(), text()].into_iter().collect()),
            StandIn::True => DeValue::Boolean(true),
            StandIn::Removed => DeValue::Boolean(false),
            StandIn::Impossible => return false,
        };
        let [others @ .., last] = keys else {
            *value = Spanned::new(span, stand_in);
            return !matches!(self.with, StandIn::Removed);
        };
        let Some(DeValue::Table(table)) = inner(value, others).map(Spanned::get_mut) else { return false };
        match table.iter_mut().find(|(key, _)| key.get_ref() == last) {
            Some((_, value)) => *value.get_mut() = stand_in,
            None => {
                table.insert(Spanned::new(span.clone(), last.clone().into()), Spanned::new(span, stand_in));
            }
        }
        if matches!(self.with, StandIn::Removed) {
            table.remove(last.as_str());
        }
        true
    }
}

/// The value at the end of a path of keys.
fn inner<'v, 'i>(
    value: &'v mut Spanned<DeValue<'i>>,
    keys: &[String],
) -> Option<&'v mut Spanned<DeValue<'i>>> {
    keys.iter().try_fold(value, |value, key| match value.get_mut() {
        DeValue::Table(table) => {
            table.iter_mut().find(|(name, _)| name.get_ref() == key).map(|(_, value)| value)
        }
        _ => None,
    })
}

fn with_article(kind: &'static str) -> &'static str {
    match kind {
        "number" => "a number",
        "date" => "a date",
        "list" => "a list",
        "table" => "a table",
        other => other,
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
