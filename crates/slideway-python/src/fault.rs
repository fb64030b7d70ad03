//! Faults as exceptions of Python, with every fault as an object.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use slideway::Faults;
use slideway::fault::{Fault, FaultKind, Source};
use slideway::model::{SettingKind, Settings};
use slideway::printable;

/// The texts in which faults have their places.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Texts<'t> {
    /// The model's.
    pub(crate) model: &'t str,
    /// What was changed in it.
    pub(crate) settings: &'t Settings,
}

impl Texts<'_> {
    /// What is wrong, as `slideway.ModelError`.
    pub(crate) fn error(self, py: Python<'_>, faults: &Faults) -> PyErr {
        self.exception(py, faults).unwrap_or_else(|error| error)
    }

    fn exception(self, py: Python<'_>, faults: &Faults) -> PyResult<PyErr> {
        let module = py.import("slideway._errors")?;
        let class = module.getattr("Fault")?;
        let one = |fault: &&Fault| self.fault(&class, fault);
        let list = faults.sorted().iter().map(one).collect::<PyResult<Vec<_>>>()?;
        let error = module.getattr("ModelError")?.call1((PyTuple::new(py, list)?,))?;
        Ok(PyErr::from_value(error))
    }

    fn fault<'py>(self, class: &Bound<'py, PyAny>, fault: &Fault) -> PyResult<Bound<'py, PyAny>> {
        let values = PyDict::new(class.py());
        values.set_item("message", printable::lines(&fault.kind.to_string()))?;
        values.set_item("hint", fault.kind.hint().as_deref().map(printable::lines))?;
        values.set_item("is_warning", matches!(fault.kind, FaultKind::Doubt(_)))?;
        if let Some(place) = &fault.place {
            let (argument, text) = match place.source {
                Source::Model => (None, self.model.to_owned()),
                Source::Setting(index) => self.setting(index),
                Source::Argument => {
                    let text = fault.argument.as_deref().unwrap_or_default().to_owned();
                    (Some(text.split('=').next().unwrap_or_default().to_owned()), text)
                }
            };
            let start = text.floor_char_boundary(place.span.start);
            let end = text.ceil_char_boundary(place.span.end).max(start);
            let before = &text[..start];
            values.set_item("argument", argument)?;
            values.set_item("text", &text[start..end])?;
            values.set_item("line", before.matches('\n').count() + 1)?;
            let line_start = before.rfind('\n').map_or(0, |end| end + 1);
            values.set_item("column", before[line_start..].chars().count() + 1)?;
        }
        class.call((), Some(&values))
    }

    /// A setting as the argument of Python that it comes from, and its text.
    fn setting(self, index: usize) -> (Option<String>, String) {
        let Some(setting) = self.settings.entries().get(index) else { return (None, String::new()) };
        let name = &setting.name;
        let argument = match setting.kind {
            SettingKind::Position => format!("at[{name:?}]"),
            SettingKind::Rate => format!("rate[{name:?}]"),
            SettingKind::Time => "time".to_owned(),
            _ => name.clone(),
        };
        (Some(argument), setting.text())
    }
}
