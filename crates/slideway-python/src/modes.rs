//! Problems given by matrices: private half of `slideway.modes`.

use crate::answer::Answer;
use crate::arguments::numbers;
use crate::work::Watch;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use slideway::modes::SearchOptions;
use slideway::raw_problem::{self, RawFaults, RawKind, RawProblem};

/// An array of Python as its name, sizes and entries.
type Array<'n> = (&'n str, Vec<usize>, Vec<f64>);

/// An array with its name.
fn array<'n>(name: &'n str, given: &Bound<'_, PyAny>) -> PyResult<Array<'n>> {
    let called = as_called(name);
    let (sizes, entries) = numbers(&called, given)?;
    if sizes.len() > 2 {
        let message =
            format!("{called} must be a vector or a matrix, not an array of {} dimensions", sizes.len());
        return Err(PyValueError::new_err(message));
    }
    Ok((name, sizes, entries))
}

/// Limits of a search, and options for what is listed.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    max_solutions: usize,
    max_nodes: Option<u64>,
    max_found: Option<usize>,
    uniqueness: bool,
    time_limit: Option<f64>,
    progress: Option<Py<PyAny>>,
}

/// A text with the names of arrays as callers wrote them.
fn as_called(text: &str) -> String {
    text.replace("jumps_positive", "jumps[0]").replace("jumps_negative", "jumps[1]")
}

/// All solutions of a problem of a type, given by its arrays with their names; those that it may lack may be None.
#[pyfunction]
#[pyo3(signature = (kind: "str", arrays: "list[tuple[str, ArrayLike | None]]", options: "dict[str, Any]") -> "reports.RawReport")]
pub(crate) fn matrices<'py>(
    py: Python<'py>,
    kind: &str,
    arrays: Vec<(String, Bound<'_, PyAny>)>,
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    let unknown = || PyValueError::new_err(format!("there is no type {kind:?}"));
    let kind = RawKind::ALL.into_iter().find(|known| known.word() == kind).ok_or_else(unknown)?;
    let is_given = |(name, given): &&(String, Bound<'_, PyAny>)| {
        !(given.is_none() && kind.optional().contains(&name.as_str()))
    };
    let arrays = arrays.iter().filter(is_given).map(|(name, given)| array(name, given));
    let arrays = arrays.collect::<PyResult<Vec<_>>>()?;
    // In a mixed problem an empty list is a matrix without rows or columns.
    if let Some((name, ..)) = arrays.iter().find(|(.., entries)| entries.is_empty() && kind != RawKind::Mlcp)
    {
        return Err(PyValueError::new_err(as_called(&format!("{name} must not be empty"))));
    }
    let refused = |faults: RawFaults| PyValueError::new_err(as_called(&faults.to_string()));
    let problem = RawProblem::from_arrays(kind, arrays).map_err(refused)?;
    let search = SearchOptions::within(options.max_nodes, options.max_found);
    let watch = Watch::new(options.time_limit, options.progress)?;
    let report = watch.run(py, |callback| {
        let mut report = raw_problem::solve(&problem, &search, options.max_solutions, callback)?;
        if options.uniqueness {
            report.every_right_hand_side = problem.every_right_hand_side(callback).ok();
        }
        Ok::<_, slideway_modes::ModeProblemError>(report)
    })?;
    let report = report.so_far().map_err(|error| PyValueError::new_err(error.to_string()))?;
    Answer::object(py, "RawReport", report, None)
}
