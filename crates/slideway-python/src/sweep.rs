//! Sweeps: all solutions at many points as one table, shared with NumPy and data frames without a copy.

use crate::answer::{Asked, style};
use crate::arguments::{choice, count, numbers, value};
use crate::plot::Plot;
use crate::sweep_plot::{self, prepared};
use crate::to_python::to_python;
use crate::work::{Ended, Watch};
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use pyo3::exceptions::{PyMemoryError, PyOSError, PyTimeoutError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyString, PyTuple};
use slideway::Faults;
use slideway::model::Value;
use slideway::printable;
use slideway::progress::Progress;
use slideway::sweep::{
    GridAxis, Rows, SampledAxis, Sampling, Shard, Spread, Sweep, SweepOptions, SweepPoints, SweepState,
};
use slideway_tables::arrow::{ArrowTable, columns};
use slideway_tables::{Layout, RowSource, TableError};
use std::error::Error;
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// The options of a sweep beside its axes.
pub(crate) struct Question {
    pub(crate) samples: Option<i64>,
    pub(crate) sampling: Spread,
    pub(crate) seed: i128,
    pub(crate) breakpoints: bool,
    pub(crate) attainability: bool,
    pub(crate) all_columns: bool,
}

impl Question {
    /// Returns the options of the sweep for the library.
    pub(crate) fn options(
        &self,
        refused: &dyn Fn(Faults) -> PyErr,
        axes: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<SweepOptions> {
        let mut named = Vec::new();
        for (name, values) in axes.into_iter().flatten() {
            named.push((name.extract::<String>()?, values));
        }
        if named.is_empty() {
            return Err(PyTypeError::new_err(
                "give what is varied, such as sweep(mu=numpy.linspace(0, 1, 101))",
            ));
        }
        if let Some(given) = self.samples.filter(|given| *given < 1) {
            return Err(PyValueError::new_err(format!("samples must be at least 1, not {given}")));
        }
        let points = if let Some(samples) = self.samples {
            let axes = named.iter().map(|(name, values)| sampled(refused, name, values));
            let (count, seed) = (count("samples", samples)?, count("seed", self.seed)?);
            let sampling = Sampling { count, spread: self.sampling, seed };
            SweepPoints::Samples(sampling, axes.collect::<PyResult<_>>()?)
        } else {
            let axes = named.iter().map(|(name, values)| grid(refused, name, values));
            SweepPoints::Grid(axes.collect::<PyResult<_>>()?)
        };
        Ok(SweepOptions::over(points)
            .breakpoints(self.breakpoints)
            .attainability(self.attainability)
            .all_columns(self.all_columns))
    }
}

/// Values on a grid: a text such as "0..1:101", or a list.
fn grid(refused: &dyn Fn(Faults) -> PyErr, name: &str, values: &Bound<'_, PyAny>) -> PyResult<GridAxis> {
    if let Ok(text) = values.cast::<PyString>() {
        return format!("{name}={text}").parse().map_err(refused);
    }
    if values.len().is_ok_and(|count| count == 0) {
        return Err(PyValueError::new_err(format!("{name} must have at least one value")));
    }
    if let Ok(number) = value(name, values) {
        return Ok(GridAxis::listed(name, [number]));
    }
    if let Ok((sizes, numbers)) = numbers(name, values)
        && sizes.len() == 1
    {
        if let Some(number) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(PyValueError::new_err(format!("the values of {name} must be finite, not {number}")));
        }
        return Ok(GridAxis::listed(name, numbers));
    }
    let wanted =
        || format!("{name} must be an array or list of numbers or texts, or a text such as \"0..1:101\"");
    let items = values.try_iter().map_err(|_| PyTypeError::new_err(wanted()))?;
    let list: Vec<Value> = items.map(|item| value(name, &item?)).collect::<PyResult<_>>()?;
    Ok(GridAxis::listed(name, list))
}

/// A distribution, as a text such as "normal(0.3, 0.05)".
fn sampled(
    refused: &dyn Fn(Faults) -> PyErr,
    name: &str,
    values: &Bound<'_, PyAny>,
) -> PyResult<SampledAxis> {
    let Ok(text) = values.cast::<PyString>() else {
        let message =
            format!("with samples, {name} must be a text such as \"normal(0.3, 0.05)\" or \"0.1..0.5\"");
        return Err(PyTypeError::new_err(message));
    };
    format!("{name}={text}").parse().map_err(refused)
}

/// A part of a sweep: its number, from 1, and how many there are.
pub(crate) fn shard((number, of): (i64, i64)) -> PyResult<Shard> {
    let (number, of) = (count("shard", number)?, count("shard", of)?);
    Shard::new(number, of).map_err(|fault| PyValueError::new_err(format!("shard: {fault}")))
}

/// All solutions at the points of a sweep: private half of `slideway.Sweep`.
#[pyclass(frozen, module = "slideway._slideway")]
pub(crate) struct Table {
    pub(crate) asked: Asked,
    pub(crate) options: SweepOptions,
    pub(crate) sweep: Sweep,
    state: SweepState,
    layout: Layout,
    columns: ArrowTable,
    /// The same as records, once NumPy has asked for them.
    records: OnceLock<Vec<u8>>,
}

impl Table {
    /// As an object of `slideway.Sweep`.
    pub(crate) fn object(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        py.import("slideway._sweep")?.getattr("Sweep")?.call1((self,))
    }

    /// The rows of a source, as long as nothing ends the work.
    pub(crate) fn of(
        py: Python<'_>,
        (source, asked, options): (RowSource<'_>, Asked, SweepOptions),
        watch: &Watch,
    ) -> PyResult<Self> {
        let layout = Layout::of(source.sweep(), options.points.dimensions(), options.attainability);
        let mut state = source.sweep().start();
        let points = source.sweep().points();
        room(points, &layout)?;
        let mut table = ArrowTable::new(&layout, points);
        let ended = watch.run_beside(py, |callback| {
            let encode = |rows: &Rows| columns(&layout, rows);
            let mut appended = Ok(());
            source.run_while(&|| true, &mut state, &encode, &mut |parts, state| {
                appended = parts.iter().try_for_each(|part| table.append(part));
                if appended.is_err() {
                    return ControlFlow::Break(());
                }
                callback(&Progress::of("points", state.done, points))
            })?;
            Ok(appended.and_then(|()| table.complete()).map(|()| table))
        })?;
        let is_done = state.done == points;
        let (Ended::Done(table) | Ended::TimeUp(table)) = ended;
        match table.map_err(|error| os_error(&error))? {
            Err(error) => Err(PyMemoryError::new_err(format!("{error}; write the sweep in shards instead"))),
            Ok(columns) if is_done => {
                let sweep = source.sweep().clone();
                Ok(Self { asked, options, sweep, state, layout, columns, records: OnceLock::new() })
            }
            _ => Err(unfinished(&state, points)),
        }
    }
}

/// Asks for room for a record of so many rows, and gives it back.
///
/// # Errors
/// If the machine has none: rows are not computed until it breaks down.
fn room(rows: u64, layout: &Layout) -> PyResult<()> {
    let bytes = usize::try_from(rows).ok().and_then(|rows| rows.checked_mul(layout.record()));
    if let Some(Ok(())) = bytes.map(|bytes| Vec::<u8>::new().try_reserve_exact(bytes)) {
        return Ok(());
    }
    let size = rows as f64 * layout.record() as f64;
    let message = format!("a table of {rows} rows needs {size:.1e} bytes; write it in shards instead");
    Err(PyMemoryError::new_err(message))
}

/// Builds the `TimeoutError` of a sweep that had no time for all points.
pub(crate) fn unfinished(state: &SweepState, points: u64) -> PyErr {
    let done = state.done;
    PyTimeoutError::new_err(format!("the sweep was not done within time_limit: {done} of {points} points"))
}

/// Builds the `OSError` for an error with files.
pub(crate) fn os_error(error: &TableError) -> PyErr {
    let hint = error.source().map(|source| format!(": {source}")).unwrap_or_default();
    PyOSError::new_err(printable::lines(&format!("{error}{hint}")))
}

/// Computes a sweep, or one shard of it.
pub(crate) fn table(
    py: Python<'_>,
    asked: &Asked,
    (options, shard): (&SweepOptions, Option<Shard>),
    watch: &Watch,
) -> PyResult<Table> {
    let whole = prepared(py, asked, options, watch)?;
    let sweep = match shard {
        Some(shard) => whole.shard(shard),
        None => whole,
    };
    Table::of(py, (RowSource::Sweep(&sweep), asked.clone(), options.clone()), watch)
}

#[pymethods]
impl Table {
    /// The rows as records: an array of NumPy that shares their memory. They are made when they are first asked for.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        if self.records.get().is_none() {
            room(self.rows() as u64, &self.layout)?;
        }
        let records = py.detach(|| self.records.get_or_init(|| self.columns.records()));
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("shape", (self.rows(),))?;
        interface.set_item("typestr", format!("|V{}", self.layout.record()))?;
        interface.set_item("descr", self.layout.fields())?;
        interface.set_item("data", (records.as_ptr() as usize, true))?;
        Ok(interface)
    }

    /// The table as a stream of Arrow (the Arrow `PyCapsule` interface).
    #[pyo3(signature = (requested_schema = None) -> "object")]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // The interface lets a producer ignore what is requested.
        drop(requested_schema);
        let stream = FFI_ArrowArrayStream::new(Box::new(self.columns.reader()));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.columns.rows()
    }

    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.layout.fields().into_iter().map(|(name, _)| name).collect()
    }

    /// Number of points, inserted ones included.
    #[getter]
    fn points(&self) -> u64 {
        self.sweep.points()
    }

    /// Number of varied quantities.
    #[getter]
    fn varied(&self) -> usize {
        self.layout.varied.len()
    }

    /// The unit of each column that has one.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        for (name, unit) in self.layout.varied.iter().chain(&self.layout.numbers) {
            units.set_item(name, unit)?;
        }
        Ok(units)
    }

    /// The names of the contacts, in the order of the signs of patterns.
    #[getter]
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.sweep.contacts().collect::<Vec<_>>())
    }

    /// How many points came to what.
    #[pyo3(signature = () -> "reports.Tally")]
    fn tally<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.state.tally)
    }

    /// The plot of a quantity along every branch, or of its distribution over samples. All points are computed
    /// again: the table does not hold what a plot needs.
    #[pyo3(signature = (quantity, time_limit = None, progress = None))]
    fn plot(
        &self,
        py: Python<'_>,
        quantity: &str,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Plot> {
        if let Some(shard) = self.sweep.of_shard() {
            return Err(PyValueError::new_err(format!("shard {shard} has no plot: merge all of them")));
        }
        let watch = Watch::new(time_limit, progress)?;
        sweep_plot::plot(py, (&self.asked, &self.options), choice("quantity", quantity)?, &watch)
    }

    /// What the sweep comes to, in words.
    fn text(&self, color: bool) -> String {
        self.sweep.text(&self.state, style(color))
    }
}
