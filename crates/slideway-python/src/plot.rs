//! A plot as Python holds it.

use crate::to_python::to_python;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use slideway_pictures::NotFinite;
use slideway_pictures::plot::{Figure, drawn, to_svg};
use slideway_pictures::theme::{DARK, LIGHT, Theme};

/// A plot of an answer, a motion or a sweep.
#[pyclass(frozen, module = "slideway._slideway")]
pub(crate) struct Plot {
    pub(crate) figure: Figure,
}

#[pymethods]
impl Plot {
    /// The plot as plain data.
    #[pyo3(signature = () -> "reports.Figure")]
    fn figure<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.figure)
    }

    /// What its panels show in frames of this width and height (px, of which small text has 13).
    #[pyo3(signature = (width, height) -> "list[reports.DrawnPanel]")]
    fn drawn<'py>(&self, py: Python<'py>, width: f64, height: f64) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &drawn(&self.figure, [width, height]))
    }

    /// The plot as SVG.
    pub(crate) fn svg(&self, theme_name: &str) -> PyResult<String> {
        to_svg(&self.figure, theme(theme_name)?).map_err(not_finite)
    }
}

/// A picture with numbers that cannot be drawn.
pub(crate) fn not_finite(error: NotFinite) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// The theme of this name.
pub(crate) fn theme(name: &str) -> PyResult<&'static Theme> {
    match name {
        "light" => Ok(&LIGHT),
        "dark" => Ok(&DARK),
        _ => Err(PyValueError::new_err(format!("theme must be 'light' or 'dark', not {name:?}"))),
    }
}
