//! Settings as what is pickled of them: kind, name and value of each.

use super::Model;
use crate::arguments::value;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use slideway::choice::Choice;
use slideway::model::{Setting, SettingKind, Settings, Value};

/// The words of the kinds of settings; other ones are parameters.
const KINDS: [(SettingKind, &str); 3] =
    [(SettingKind::Position, "at"), (SettingKind::Rate, "rate"), (SettingKind::Time, "time")];

/// Text, settings, units and file of a model.
type Kept<'py, 'm> = (&'m str, Bound<'py, PyTuple>, Option<&'static str>, &'m str);

impl Model {
    /// Returns the parts of the model that are pickled.
    pub(super) fn kept<'py>(&self, py: Python<'py>) -> PyResult<Kept<'py, '_>> {
        let settings: Vec<_> = self.asked.settings.entries().iter().map(kept).collect();
        Ok((&self.asked.text, PyTuple::new(py, settings)?, self.units.map(Choice::word), &self.file))
    }
}

/// A setting as what is pickled of it.
pub(super) fn kept(setting: &Setting) -> (&'static str, String, KeptValue) {
    let word = KINDS.iter().find(|(kind, _)| *kind == setting.kind).map_or("", |(_, word)| word);
    let kept = match &setting.value {
        Value::Number(number) => KeptValue::Number(*number),
        other => KeptValue::Text(other.to_string()),
    };
    (word, setting.name.clone(), kept)
}

/// The settings that were pickled.
pub(super) fn settings(kept: Vec<(String, String, Bound<'_, PyAny>)>) -> PyResult<Settings> {
    let mut settings = Settings::default();
    for (word, name, given) in kept {
        let kind = KINDS.iter().find(|(_, known)| *known == word);
        let kind = kind.map_or(SettingKind::Parameter, |(kind, _)| *kind);
        settings = settings.with(Setting::new(kind, &name, value(&name, &given)?));
    }
    Ok(settings)
}

/// A value as what is pickled of it.
#[derive(IntoPyObject)]
pub(super) enum KeptValue {
    Number(f64),
    Text(String),
}
