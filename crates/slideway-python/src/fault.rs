//! Faults as exceptions of Python, with every fault as an object.

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use slideway::Faults;
use slideway::fault::{Face, Fault, FaultKind, Source};
use slideway::model::{SettingKind, Settings};
use slideway::printable;
use std::io;
use std::path::Path;

/// The texts in which faults have their places.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Texts<'t> {
    /// The model's.
    pub(crate) model: &'t str,
    /// The changes of that text.
    pub(crate) settings: &'t Settings,
}

impl Texts<'_> {
    /// Builds the `slideway.ModelError` with these faults.
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
        values.set_item("hint", fault.kind.hint_for(&InPython).as_deref().map(printable::lines))?;
        values.set_item("is_warning", matches!(fault.kind, FaultKind::Doubt(_)))?;
        if let Some(place) = &fault.place {
            let (argument, text) = match &place.source {
                Source::Model => (None, self.model.to_owned()),
                Source::Setting(index) => self.setting(*index),
                Source::Argument(text) => {
                    (Some(text.split('=').next().unwrap_or_default().to_owned()), text.to_string())
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

/// Builds the `OSError` for an error with a file: of the kind of the error, with the file's name.
pub(crate) fn file_error(path: &Path, error: &io::Error) -> PyErr {
    let whole = error.to_string();
    // The number is an argument of its own.
    let words = whole.split(" (os error").next().unwrap_or_default().to_owned();
    match error.raw_os_error() {
        Some(number) => PyOSError::new_err((number, words, path.to_string_lossy().into_owned())),
        None => PyOSError::new_err(format!("{}: {words}", path.display())),
    }
}

/// Adds the name of a file to an error of the model in it.
pub(crate) fn in_file(py: Python<'_>, path: &Path, error: PyErr) -> PyErr {
    let named = error.value(py).setattr("filename", path.to_string_lossy());
    named.err().unwrap_or(error)
}

/// Python: options are arguments, questions are methods.
pub(crate) struct InPython;

impl Face for InPython {
    fn option(&self, name: &str) -> String {
        name.replace('-', "_")
    }

    fn option_with(&self, name: &str, value: &str) -> String {
        let quote = if value.parse::<f64>().is_ok() { "" } else { "\"" };
        format!("{}={quote}{value}{quote}", self.option(name))
    }

    fn rates(&self, coordinates: &[String]) -> String {
        let rates: Vec<String> = coordinates.iter().map(|name| format!("\"{name}\": 1")).collect();
        format!("rate={{{}}}", rates.join(", "))
    }

    fn question(&self, name: &str) -> String {
        if name == "models" { "slideway.gallery_models()".to_owned() } else { format!("model.{name}()") }
    }
}
