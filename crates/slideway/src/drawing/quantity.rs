//! Values as a model file writes them.

use crate::printable::is_hidden;
use serde::{Deserialize, Serialize};

/// A number in SI units, or a text with a unit or an expression: `0.3`, `"25 mm"`, `"2*l*cos(alpha)"`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Quantity(String);

impl Quantity {
    /// `true` or `false`
    pub(super) fn truth(value: bool) -> Self {
        Self(value.to_string())
    }

    /// As it stands in a file.
    pub(super) fn written(&self) -> &str {
        &self.0
    }

    /// A table in one line.
    pub(super) fn table<'a>(entries: impl Iterator<Item = (&'a str, &'a Quantity)>) -> Self {
        let entries: Vec<String> = entries.map(|(key, value)| format!("{key} = {}", value.0)).collect();
        Self(format!("{{ {} }}", entries.join(", ")))
    }
}

impl From<f64> for Quantity {
    fn from(value: f64) -> Self {
        // As TOML writes what is no number; the model refuses it.
        Self(if value.is_nan() { "nan".to_owned() } else { format!("{value:?}") })
    }
}

impl From<i32> for Quantity {
    fn from(value: i32) -> Self {
        Self(value.to_string())
    }
}

impl From<&str> for Quantity {
    fn from(value: &str) -> Self {
        text(value)
    }
}

impl From<String> for Quantity {
    fn from(value: String) -> Self {
        text(&value)
    }
}

/// A text in quotation marks, without characters that nobody sees.
pub(super) fn text(value: &str) -> Quantity {
    let escaped = |character: char| match character {
        '"' | '\\' => format!("\\{character}"),
        hidden if hidden.is_control() || is_hidden(hidden) => format!("\\U{:08x}", u32::from(hidden)),
        other => other.to_string(),
    };
    Quantity(format!("\"{}\"", value.chars().map(escaped).collect::<String>()))
}

/// A list.
pub(super) fn list(values: impl IntoIterator<Item = Quantity>) -> Quantity {
    let values: Vec<String> = values.into_iter().map(|value| value.0).collect();
    Quantity(format!("[{}]", values.join(", ")))
}

/// A list of two.
pub(super) fn pair(values: [impl Into<Quantity>; 2]) -> Quantity {
    list(values.map(Into::into))
}
