//! Models to complete, from drawings.

use crate::fault::InPython;
use crate::work::Watch;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use slideway::import::{DRAWING_LIMIT, ImportFault, ImportOptions, Unit, dxf_with};
use std::path::PathBuf;

/// The text of a model file with the outlines and points of a drawing, to be completed with joints, masses and
/// coordinates.
///
/// Each layer becomes a body: its greatest closed line is the outline, circles and points are its points, texts
/// beside them their names. The layer `ground` gives points of ground. What is left out stands in comments.
///
/// Parameters
/// ----------
/// path : str or path
///     The drawing, a text (ASCII) DXF file.
/// unit : str, optional
///     Unit of length of the drawing: "in", "ft", "mm", "cm", "m", "km", "um" or "dm". Default: the one that it
///     says.
/// title : str, optional
///     The title of the model. Default: the name of the file without its ending.
/// time_limit : float, optional
///     The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
/// progress : callable, optional
///     Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
///     raises.
///
/// Returns
/// -------
/// str
///     The text, for a file that an editor completes and `Model.load` reads.
///
/// Raises
/// ------
/// ValueError
///     What keeps the drawing from being read, with its line.
/// OSError
///     The file cannot be read.
/// TimeoutError
///     The work was not done within `time_limit`.
///
/// Examples
/// --------
/// >>> import pathlib, slideway, tempfile
/// >>> drawing = pathlib.Path(tempfile.mkdtemp(), "crank.dxf")
/// >>> lines = "0 SECTION 2 ENTITIES 0 CIRCLE 8 crank 10 0 20 0 40 60 0 ENDSEC 0 EOF"
/// >>> _ = drawing.write_text("\n".join(lines.split()))
/// >>> "[bodies.crank]" in slideway.import_dxf(drawing, unit="mm")
/// True
#[pyfunction]
#[pyo3(signature = (path, *, unit = None, title = None, time_limit = None, progress: "Progress | None" = None))]
pub(crate) fn import_dxf(
    py: Python<'_>,
    path: PathBuf,
    unit: Option<&str>,
    title: Option<String>,
    time_limit: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let watch = Watch::new(time_limit, progress)?;
    let refused = |fault: ImportFault| {
        let hint = fault.hint_for(&InPython).map_or_else(String::new, |hint| format!("; {hint}"));
        PyValueError::new_err(format!("{fault}{hint}"))
    };
    let unit: Option<Unit> = unit.map(str::parse).transpose().map_err(PyValueError::new_err)?;
    if std::fs::metadata(&path)?.len() > DRAWING_LIMIT {
        return Err(refused(ImportFault::DrawingTooLarge { limit: DRAWING_LIMIT }));
    }
    let text = String::from_utf8(std::fs::read(&path)?).map_err(|_| refused(ImportFault::Encoding))?;
    let stem = || path.file_stem().and_then(|stem| stem.to_str()).map(str::to_owned);
    let options = ImportOptions { title: title.or_else(stem), unit };
    let model = watch.run(py, |callback| dxf_with(&text, &options, callback).transpose())?;
    model.whole()?.map_err(refused)
}
