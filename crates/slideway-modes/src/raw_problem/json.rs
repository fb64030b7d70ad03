//! Raw problems as JSON text.

use std::fmt;

use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use serde::de::{Deserialize, Deserializer, IgnoredAny, MapAccess, Visitor};
use serde_json::Value;

use super::assemble::{Given, GivenType};
use super::fault::RawFault;
use super::range::nearest;
use super::shape::Array;

/// The names and arrays of a JSON text; faults of single arrays are added to `faults`.
pub(super) fn read(bytes: &[u8], faults: &mut Vec<RawFault>) -> Result<Given, RawFault> {
    let object = match serde_json::from_slice(bytes) {
        Ok(Entries(entries)) => entries,
        Err(error) if error.is_data() => return Err(no_object(bytes)),
        Err(error) => return Err(syntax(bytes, &error)),
    };
    let mut given = Given::default();
    for (key, value) in object {
        if given.has(&key) {
            faults.push(RawFault::DuplicateKey { key });
        } else if key == "type" {
            given.kind = match value {
                Value::String(text) => GivenType::Text(text),
                other => GivenType::Other(word(&other).to_owned()),
            };
        } else {
            match array(&key, &value) {
                Ok(array) => given.add(key, Some(array)),
                Err(fault) => given.set_faulty(key, fault, faults),
            }
        }
    }
    Ok(given)
}

/// The entries of an object in their order, including repeated names.
struct Entries(Vec<(String, Value)>);

impl<'de> Deserialize<'de> for Entries {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OfObject;

        impl<'de> Visitor<'de> for OfObject {
            type Value = Entries;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Entries, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Entries(entries))
            }
        }

        deserializer.deserialize_map(OfObject)
    }
}

/// Why a text is no object, in JSON or not.
fn no_object(bytes: &[u8]) -> RawFault {
    if let Err(error) = serde_json::from_slice::<IgnoredAny>(bytes) {
        return syntax(bytes, &error);
    }
    let found = match bytes.trim_ascii_start().first() {
        Some(b'[') => Value::Array(Vec::new()),
        Some(b'"') => Value::String(String::new()),
        Some(b'n') => Value::Null,
        Some(b't' | b'f') => Value::Bool(true),
        _ => Value::from(0),
    };
    RawFault::NotAnObject { found: word(&found) }
}

/// A number, a vector or a matrix.
fn array(key: &str, value: &Value) -> Result<Array, RawFault> {
    let not_an_array = || RawFault::NotAnArray { key: key.to_owned(), found: word(value).to_owned() };
    let entries = match value {
        Value::Number(number) => {
            let number = number.as_f64().ok_or_else(not_an_array)?;
            return Ok(Array { sizes: Vec::new(), values: vec![number] });
        }
        Value::Array(entries) => entries,
        _ => return Err(not_an_array()),
    };
    if !entries.iter().any(Value::is_array) {
        let values = numbers(key, entries, None)?;
        return Ok(Array { sizes: vec![values.len()], values });
    }
    let mut values = Vec::new();
    let mut columns = None;
    for (row, entry) in entries.iter().enumerate() {
        let Value::Array(entry) = entry else {
            let found = word(entry);
            return Err(RawFault::NotAnArray { key: format!("{key}[{row}]"), found: found.to_owned() });
        };
        let expected = *columns.get_or_insert(entry.len());
        if entry.len() != expected {
            return Err(RawFault::Ragged { key: key.to_owned(), row, expected, found: entry.len() });
        }
        values.extend(numbers(key, entry, Some(row))?);
    }
    Ok(Array { sizes: vec![entries.len(), columns.unwrap_or(0)], values })
}

/// The numbers of a vector, or of one row of a matrix.
fn numbers(key: &str, entries: &[Value], row: Option<usize>) -> Result<Vec<f64>, RawFault> {
    let number = |(at, entry): (usize, &Value)| {
        let no_bound = || no_bound(key).filter(|_| entry.is_null() && row.is_none());
        let fraction = || entry.as_str().and_then(fraction);
        entry.as_f64().or_else(fraction).or_else(no_bound).ok_or_else(|| RawFault::NotANumber {
            key: key.to_owned(),
            row: row.unwrap_or(at),
            column: row.map(|_| at),
            found: word(entry),
        })
    };
    entries.iter().enumerate().map(number).collect()
}

/// The number nearest to a fraction of integers of any length, such as "-2/3".
fn fraction(text: &str) -> Option<f64> {
    let (numerator, denominator) = text.split_once('/')?;
    let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    if !is_whole(numerator.strip_prefix('-').unwrap_or(numerator)) || !is_whole(denominator) {
        return None;
    }
    let (numerator, denominator): (IBig, UBig) = (numerator.parse().ok()?, denominator.parse().ok()?);
    (!denominator.is_zero()).then(|| nearest(&RBig::from_parts(numerator, denominator)))
}

/// Returns the infinite bound that `null` stands for in `l` and `u`. Returns `None` for other keys.
fn no_bound(key: &str) -> Option<f64> {
    match key {
        "l" => Some(f64::NEG_INFINITY),
        "u" => Some(f64::INFINITY),
        _ => None,
    }
}

fn word(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "a truth value",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

/// Translates a parser's error; words that Python writes for numbers that JSON does not have get a separate
/// message.
fn syntax(bytes: &[u8], error: &serde_json::Error) -> RawFault {
    let (line, column) = (error.line(), error.column());
    let text = bytes.split(|&byte| byte == b'\n').nth(line.saturating_sub(1)).unwrap_or_default();
    let near = text.get(column.saturating_sub(2)..).unwrap_or_default();
    for word in ["NaN", "Infinity", "-Infinity", "nan", "inf", "-inf"] {
        let here =
            [0, 1].iter().any(|&skip| near.get(skip..).is_some_and(|near| near.starts_with(word.as_bytes())));
        if here {
            return RawFault::NotFiniteWord { line, word };
        }
    }
    let message = error.to_string();
    let end = message.rfind(" at line ").unwrap_or(message.len());
    RawFault::Json { line, column, message: message[..end].to_owned() }
}
