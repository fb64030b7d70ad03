//! Faults as exceptions of Python, with every fault as an object.

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use slideway::Faults;
use slideway::fault::{Fault, FaultKind, Source};
use slideway::model::{SettingKind, Settings};
use slideway::printable;
use std::io;
use std::path::Path;

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
        values.set_item("hint", fault.kind.hint().map(|hint| printable::lines(&in_python(&hint))))?;
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

/// What is wrong with a file, as the `OSError` of its kind with the file's name.
pub(crate) fn file_error(path: &Path, error: &io::Error) -> PyErr {
    let whole = error.to_string();
    // The number is an argument of its own.
    let words = whole.split(" (os error").next().unwrap_or_default().to_owned();
    match error.raw_os_error() {
        Some(number) => PyOSError::new_err((number, words, path.to_string_lossy().into_owned())),
        None => PyOSError::new_err(format!("{}: {words}", path.display())),
    }
}

/// What is wrong with the model in a file, with the file's name.
pub(crate) fn in_file(py: Python<'_>, path: &Path, error: PyErr) -> PyErr {
    let named = error.value(py).setattr("filename", path.to_string_lossy());
    named.err().unwrap_or(error)
}

/// A text with what Python calls options and commands of the command line: `--max-steps` is `max_steps`,
/// `--samples 10000` in a code span is `samples=10000`, `--rate x=1` is `rate={"x": 1}`, and `slideway hold` is
/// `model.hold()`.
pub(crate) fn in_python(text: &str) -> String {
    let spans = text.split('`').enumerate().map(|(index, span)| match index % 2 {
        0 => option_names(span),
        _ => code(span),
    });
    spans.collect::<Vec<_>>().join("`")
}

/// Options without their dashes, in words.
fn option_names(words: &str) -> String {
    let mut parts = words.split("--");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |told, part| {
        let end = part.find(|c: char| !(c.is_ascii_lowercase() || c == '-')).unwrap_or(part.len());
        told + &part[..end].replace('-', "_") + &part[end..]
    })
}

/// A part of a command line.
fn code(span: &str) -> String {
    match span.strip_prefix("slideway ") {
        Some("models") => return "slideway.gallery_models()".to_owned(),
        Some(command) => return format!("model.{command}()"),
        None if !span.starts_with("--") => return span.to_owned(),
        None => (),
    }
    let words: Vec<&str> = span.split_whitespace().collect();
    let entry = |value: &str| value.split_once('=').map(|(name, value)| format!("\"{name}\": {value}"));
    let entries: Vec<String> = words.iter().filter_map(|word| entry(word)).collect();
    match *words {
        [option, ..] if !entries.is_empty() => {
            format!("{}={{{}}}", option_names(option), entries.join(", "))
        }
        [option, value] if value.parse::<f64>().is_ok() => format!("{}={value}", option_names(option)),
        [option, value] => format!("{}=\"{value}\"", option_names(option)),
        _ => option_names(span),
    }
}
