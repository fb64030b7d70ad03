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
    let (sizes, entries) = numbers(name, given)?;
    if sizes.len() > 2 {
        let message =
            format!("{name} must be a vector or a matrix, not an array of {} dimensions", sizes.len());
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

fn answer<'py>(
    py: Python<'py>,
    kind: RawKind,
    arrays: Vec<PyResult<Array<'_>>>,
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    let arrays = arrays.into_iter().collect::<PyResult<Vec<_>>>()?;
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

/// All solutions of `A x + B |x| = b`.
#[pyfunction]
#[pyo3(signature = (a: "ArrayLike", b: "ArrayLike", right_hand_side: "ArrayLike", options: "dict[str, Any]") -> "reports.RawReport")]
pub(crate) fn solve<'py>(
    py: Python<'py>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    right_hand_side: &Bound<'_, PyAny>,
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    let arrays = vec![array("A", a), array("B", b), array("b", right_hand_side)];
    answer(py, RawKind::Ave, arrays, options)
}

/// All solutions of `A x + B |x| = b` with the lengths of blocks.
#[pyfunction]
#[pyo3(signature = (matrices: "tuple[ArrayLike, ArrayLike | None]", right_hand_side: "ArrayLike", blocks: "ArrayLike", options: "dict[str, Any]") -> "reports.RawReport")]
pub(crate) fn blocks<'py>(
    py: Python<'py>,
    matrices: (Bound<'_, PyAny>, Option<Bound<'_, PyAny>>),
    right_hand_side: &Bound<'_, PyAny>,
    blocks: &Bound<'_, PyAny>,
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    let (b, a) = matrices;
    let arrays = vec![array("B", &b), array("b", right_hand_side), array("blocks", blocks)];
    answer(py, RawKind::BlockAve, a.iter().map(|a| array("A", a)).chain(arrays).collect(), options)
}

/// All solutions of `w = M z + q`.
#[pyfunction]
#[pyo3(signature = (m: "ArrayLike", q: "ArrayLike", options: "dict[str, Any]") -> "reports.RawReport")]
pub(crate) fn lcp<'py>(
    py: Python<'py>,
    m: &Bound<'_, PyAny>,
    q: &Bound<'_, PyAny>,
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    answer(py, RawKind::Lcp, vec![array("M", m), array("q", q)], options)
}

/// All solutions of `A w - B z = q`.
#[pyfunction]
#[pyo3(signature = (a: "ArrayLike", b: "ArrayLike", q: "ArrayLike", options: "dict[str, Any]") -> "reports.RawReport")]
pub(crate) fn hlcp<'py>(
    py: Python<'py>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    q: &Bound<'_, PyAny>,
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    answer(py, RawKind::Hlcp, vec![array("A", a), array("B", b), array("q", q)], options)
}

/// All solutions of `A u + C z + a = 0`, `w = D u + B z + b`.
#[pyfunction]
#[pyo3(signature = (matrices: "tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike]", vectors: "tuple[ArrayLike, ArrayLike]", options: "dict[str, Any]")
    -> "reports.RawReport")]
pub(crate) fn mlcp<'py>(
    py: Python<'py>,
    matrices: [Bound<'_, PyAny>; 4],
    vectors: [Bound<'_, PyAny>; 2],
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    let named = ["A", "B", "C", "D", "a", "b"].into_iter().zip(matrices.iter().chain(&vectors));
    answer(py, RawKind::Mlcp, named.map(|(name, given)| array(name, given)).collect(), options)
}

/// All solutions of `w = M z + q` within bounds.
#[pyfunction]
#[pyo3(signature = (m: "ArrayLike", q: "ArrayLike", bounds: "tuple[ArrayLike, ArrayLike]", options: "dict[str, Any]") -> "reports.RawReport")]
pub(crate) fn mcp<'py>(
    py: Python<'py>,
    m: &Bound<'_, PyAny>,
    q: &Bound<'_, PyAny>,
    bounds: [Bound<'_, PyAny>; 2],
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    let [lower, upper] = &bounds;
    let arrays = vec![array("M", m), array("q", q), array("l", lower), array("u", upper)];
    answer(py, RawKind::Mcp, arrays, options)
}

/// All equilibria of a bimatrix game.
#[pyfunction]
#[pyo3(signature = (a: "ArrayLike", b: "ArrayLike | None", options: "dict[str, Any]") -> "reports.RawReport")]
pub(crate) fn game<'py>(
    py: Python<'py>,
    a: &Bound<'_, PyAny>,
    b: Option<Bound<'_, PyAny>>,
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    let second = b.iter().map(|b| array("B", b));
    answer(py, RawKind::Game, [array("A", a)].into_iter().chain(second).collect(), options)
}

/// All solutions of a mode problem.
#[pyfunction]
#[pyo3(signature = (columns_positive: "ArrayLike", columns_negative: "ArrayLike", right_hand_side: "ArrayLike", jumps: "tuple[ArrayLike, ArrayLike] | None", options: "dict[str, Any]")
    -> "reports.RawReport")]
pub(crate) fn mode_problem<'py>(
    py: Python<'py>,
    columns_positive: &Bound<'_, PyAny>,
    columns_negative: &Bound<'_, PyAny>,
    right_hand_side: &Bound<'_, PyAny>,
    jumps: Option<(Bound<'_, PyAny>, Bound<'_, PyAny>)>,
    options: Options,
) -> PyResult<Bound<'py, PyAny>> {
    let mut arrays = vec![
        array("columns_positive", columns_positive),
        array("columns_negative", columns_negative),
        array("right_hand_side", right_hand_side),
    ];
    if let Some((positive, negative)) = &jumps {
        let named = [("jumps[0]", "jumps_positive", positive), ("jumps[1]", "jumps_negative", negative)];
        let renamed =
            |(called, name, given)| array(called, given).map(|(_, sizes, entries)| (name, sizes, entries));
        arrays.extend(named.map(renamed));
    }
    answer(py, RawKind::Modes, arrays, options)
}
