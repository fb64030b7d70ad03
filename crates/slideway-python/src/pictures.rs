//! Pictures apart from answers: the colours of all of them, and drawings as pixels.

use crate::plot::theme as named;
use crate::to_python::to_python;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// The colours of the theme "light" or "dark".
#[pyfunction]
#[pyo3(signature = (name) -> "reports.Theme")]
pub(crate) fn theme<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    to_python(py, named(name)?)
}

/// A text with its characters that are not seen as their numbers, so that it cannot affect the page that shows it.
#[pyfunction]
pub(crate) fn printable(text: &str) -> String {
    slideway::printable::lines(text)
}

/// A drawing as PNG, with so many pixels for each unit of the SVG.
#[pyfunction]
pub(crate) fn png<'py>(py: Python<'py>, svg: &str, scale: f64) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = py.detach(|| slideway_pictures::raster::png(svg, scale));
    bytes.map(|bytes| PyBytes::new(py, &bytes)).map_err(|fault| PyValueError::new_err(fault.to_string()))
}
