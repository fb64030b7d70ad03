//! The class `slideway.Model`: a model with its settings, and a method for each question.
//!
//! # Files
//! `state.rs` is what it holds, and how it is asked; `options.rs` what questions take besides, `size.rs` and
//! `simulation.rs` for those that take much, `pickle.rs` what is pickled.

mod options;
mod pickle;
mod simulation;
mod size;
mod state;

use crate::answer::{Answer, Asked};
use crate::arguments::{choice, count, optional_count, settings, varied, varied_one, vary};
use crate::fault::file_error;
use crate::plot::theme as named;
use crate::work::Watch;
use crate::{gallery, shards, sweep};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyTuple};
use simulation::MotionQuestion;
use size::Demand;
use slideway::limits::curves_with;
use slideway::map::map_with;
use slideway::modes::SearchOptions;
use slideway::size::size_with;
use slideway::solve::solve_with;
use slideway::standstill::hold_with;
use slideway::{DriveOptions, LimitsOptions, SolveOptions, UnitSystem};
use slideway_pictures::drawing::Shown;
use state::UNTITLED;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::PathBuf;
use std::sync::Arc;

/// A planar mechanism with dry friction, in one state: a model file and what was changed in it. It never changes;
/// `with_` gives another one.
#[pyclass(frozen, module = "slideway", name = "Model")]
#[derive(Clone)]
pub(crate) struct Model {
    asked: Asked,
    units: Option<UnitSystem>,
    /// The file of the text, for the command lines that tables tell.
    file: Arc<str>,
}

#[pymethods]
impl Model {
    #[doc = include_str!("../../docs/parse.txt")]
    #[staticmethod]
    fn parse(py: Python<'_>, text: &str) -> PyResult<Self> {
        Self::new(py, text)
    }

    #[doc = include_str!("../../docs/load.txt")]
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::of_file(py, &path)
    }

    #[doc = include_str!("../../docs/gallery.txt")]
    #[staticmethod]
    fn gallery(py: Python<'_>, name: &str) -> PyResult<Self> {
        Ok(Self::new(py, gallery::text(name)?)?.in_file(&format!("{name}.toml")))
    }

    #[doc = include_str!("../../docs/template.txt")]
    #[staticmethod]
    #[pyo3(signature = (name, /, **sizes: "Value"))]
    fn template(py: Python<'_>, name: &str, sizes: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Ok(Self::new(py, &gallery::filled_in(py, name, sizes)?)?.in_file(&format!("{name}.toml")))
    }

    /// The text of the model, with what was changed.
    #[getter]
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        self.changed_text(py)
    }

    /// The present values of its parameters in SI units, each with its unit.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.quantities(py)
    }

    #[doc = include_str!("../../docs/save.txt")]
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        std::fs::write(&path, self.changed_text(py)?).map_err(|error| file_error(&path, &error))
    }

    /// Its title, if it has one.
    #[getter]
    fn title(&self) -> Option<&str> {
        self.asked.model.title.as_deref()
    }

    /// The names of its parameters.
    #[getter]
    fn parameters(&self) -> Vec<&str> {
        self.asked.model.parameters.iter().map(|parameter| &*parameter.name).collect()
    }

    /// The parameters as texts: name, value, and the range between whose ends it is known, if it has one.
    #[pyo3(signature = () -> "list[tuple[str, str, str]]")]
    fn _parameter_texts(&self, py: Python<'_>) -> PyResult<Vec<(String, String, String)>> {
        self.parameter_texts(py)
    }

    /// The names of its coordinates.
    #[getter]
    fn coordinates(&self) -> Vec<&str> {
        self.asked.model.coordinates.iter().map(|coordinate| &*coordinate.name).collect()
    }

    /// What was changed in the text, such as `["mu=0.5", "at alpha=75 deg"]`.
    #[getter]
    fn settings(&self) -> Vec<String> {
        self.setting_texts()
    }

    #[doc = include_str!("../../docs/with_.txt")]
    #[pyo3(signature = (*, at: "Mapping[str, Value] | None" = None, rate: "Mapping[str, Value] | None" = None, time: "Value | None" = None, units: "UnitsName | None" = None, **values: "Value"))]
    fn with_(
        &self,
        py: Python<'_>,
        at: Option<&Bound<'_, PyDict>>,
        rate: Option<&Bound<'_, PyDict>>,
        time: Option<&Bound<'_, PyAny>>,
        units: Option<&str>,
        values: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let settings = settings(&self.asked.model, values, [at, rate], time)?;
        self.changed(py, &settings)?.in_units(units)
    }

    #[doc = include_str!("../../docs/check.txt")]
    #[pyo3(signature = () -> "reports.CheckReport")]
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let report = py.detach(|| slideway::check(&self.asked.model));
        let report = report.map_err(|faults| self.refused(py, &faults))?;
        Answer::object(py, "CheckReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../../docs/solve.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (*, margins = true, max_solutions = 100, max_nodes = None, max_found = None,
        time_limit = None, progress: "Progress | None" = None) -> "reports.SolveReport")]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        margins: bool,
        max_solutions: i64,
        max_nodes: Option<i64>,
        max_found: Option<i64>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (nodes, found) =
            (optional_count("max_nodes", max_nodes)?, optional_count("max_found", max_found)?);
        let options = SolveOptions::default().margins(margins).most(count("max_solutions", max_solutions)?);
        let options = options.search(SearchOptions::within(nodes, found));
        let model = &self.asked.model;
        let watch = Watch::new(time_limit, progress)?;
        let report = watch.run(py, |callback| solve_with(model, &options, callback))?;
        let report = report.answer(|faults| self.refused(py, &faults))?;
        Answer::object(py, "SolveReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../../docs/limits.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (vary_name = None, start: "Value | Range | None" = None, stop: "Value | None" = None, *, max_reaction = None, both_directions = false,
        effort = 800, quantity: "QuantityName" = "normal-force", time_limit = None,
        progress: "Progress | None" = None, **ranges: "Range | None") -> "reports.LimitsReport")]
    fn limits<'py>(
        &self,
        py: Python<'py>,
        vary_name: Option<&str>,
        start: Option<&Bound<'_, PyAny>>,
        stop: Option<&Bound<'_, PyAny>>,
        max_reaction: Option<f64>,
        both_directions: bool,
        effort: i64,
        quantity: &str,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        ranges: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        // Signatures show numbers only if they stand there.
        const { assert!(slideway::limits::EFFORT == 800) };
        let options = LimitsOptions::new(vary(vary_name, [start, stop], ranges)?)
            .max_reaction(max_reaction)
            .both_directions(both_directions)
            .effort(count("effort", effort)?);
        let quantity = choice("quantity", quantity)?;
        let found = self.ask(py, (time_limit, progress), |model, callback| {
            curves_with(model, &options, quantity, callback)
        })?;
        Answer::with_curves(py, "LimitsReport", found, self.asked.clone())
    }

    #[doc = include_str!("../../docs/hold.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (load = None, *, vary = None, drives: "DrivesAtRest" = "release", time_limit = None,
        progress: "Progress | None" = None, **ranges: "Range | None") -> "reports.HoldReport")]
    fn hold<'py>(
        &self,
        py: Python<'py>,
        load: Option<String>,
        vary: Option<String>,
        drives: &str,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        ranges: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = options::hold(load, vary, drives)?;
        if let Some(range) = varied_one(None, [None, None], ranges)? {
            if options.vary.is_some() {
                return Err(PyTypeError::new_err("vary and a range cannot be given together"));
            }
            return self.rest_limits_over(py, (&range, &options), (time_limit, progress));
        }
        let report =
            self.ask(py, (time_limit, progress), |model, callback| hold_with(model, &options, callback))?;
        Answer::object(py, "HoldReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../../docs/rest_limits.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (vary_name = None, start: "Value | Range | None" = None, stop: "Value | None" = None, *, load = None,
        drives: "DrivesAtRest" = "release", time_limit = None, progress: "Progress | None" = None,
        **ranges: "Range | None") -> "reports.RestLimitsReport")]
    fn rest_limits<'py>(
        &self,
        py: Python<'py>,
        vary_name: Option<&str>,
        start: Option<&Bound<'_, PyAny>>,
        stop: Option<&Bound<'_, PyAny>>,
        load: Option<String>,
        drives: &str,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        ranges: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = options::hold(load, None, drives)?;
        let range = vary(vary_name, [start, stop], ranges)?;
        self.rest_limits_over(py, (&range, &options), (time_limit, progress))
    }

    #[doc = include_str!("../../docs/size.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (vary_name = None, start: "Value | Range | None" = None, stop: "Value | None" = None, *, margin: "Value | None" = None,
        max_effort: "Value | None" = None, max_normal_force: "Value | None" = None, max_pressure: "Value | None" = None,
        min_efficiency: "Value | None" = None, against: "MarginAgainst" = "locking", load = None, both_directions = false,
        time_limit = None, progress: "Progress | None" = None, **ranges: "Range | None") -> "reports.SizeReport")]
    fn size<'py>(
        &self,
        py: Python<'py>,
        vary_name: Option<&str>,
        start: Option<&Bound<'_, PyAny>>,
        stop: Option<&Bound<'_, PyAny>>,
        margin: Option<&Bound<'_, PyAny>>,
        max_effort: Option<&Bound<'_, PyAny>>,
        max_normal_force: Option<&Bound<'_, PyAny>>,
        max_pressure: Option<&Bound<'_, PyAny>>,
        min_efficiency: Option<&Bound<'_, PyAny>>,
        against: &str,
        load: Option<String>,
        both_directions: bool,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        ranges: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let demand = Demand::new([margin, max_effort, max_normal_force, max_pressure, min_efficiency])?;
        let against = demand.against(choice("against", against)?, load, &self.asked.model);
        let against = against.map_err(|faults| self.refused(py, &faults))?;
        let options = demand.options(vary(vary_name, [start, stop], ranges)?).against(against);
        let options = options.both_directions(both_directions);
        let report =
            self.ask(py, (time_limit, progress), |model, callback| size_with(model, &options, callback))?;
        Answer::object(py, "SizeReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../../docs/drive.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (vary = None, between: "Range | None" = None, *, rows = 41, time_limit = None,
        progress: "Progress | None" = None, **ranges: "Range | None") -> "reports.DriveReport")]
    fn drive<'py>(
        &self,
        py: Python<'py>,
        vary: Option<&str>,
        between: Option<&Bound<'_, PyAny>>,
        rows: i64,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        ranges: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let rows = options::within("rows", rows, 2..=slideway::drive::GREATEST_ROWS)?;
        let vary = varied_one(vary, [between, None], ranges)?;
        let options = DriveOptions::default().vary(vary).rows(rows);
        let report = self.ask(py, (time_limit, progress), |model, callback| {
            slideway::drive::drive_with(model, &options, callback)
        })?;
        Answer::object(py, "DriveReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../../docs/map.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (*, colour_by: "ColourBy" = "solutions", size = None, probe = None, time_limit = None,
        progress: "Progress | None" = None, **axes: "Range | None") -> "reports.MapReport")]
    fn map<'py>(
        &self,
        py: Python<'py>,
        colour_by: &str,
        size: Option<(i64, i64)>,
        probe: Option<i64>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        axes: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = options::map(axes, choice("colour_by", colour_by)?, (size, probe))?;
        let report =
            self.ask(py, (time_limit, progress), |model, callback| map_with(model, &options, callback))?;
        Answer::object(py, "MapReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../../docs/sweep.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (*, samples = None, sampling: "SamplingName" = "random", seed = 0, breakpoints = false,
        attainability = false, all_columns = false, shard = None, time_limit = None, progress: "Progress | None" = None,
        **values: "str | ArrayLike | Sequence[Value]") -> "_sweep.Sweep")]
    fn sweep<'py>(
        &self,
        py: Python<'py>,
        samples: Option<i64>,
        sampling: &str,
        seed: i128,
        breakpoints: bool,
        attainability: bool,
        all_columns: bool,
        shard: Option<(i64, i64)>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        values: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let sampling = choice("sampling", sampling)?;
        let question = sweep::Question { samples, sampling, seed, breakpoints, attainability, all_columns };
        let options = question.options(&|faults| self.refused(py, &faults), values)?;
        let shard = shard.map(sweep::shard).transpose()?;
        let watch = Watch::new(time_limit, progress)?;
        sweep::table(py, &self.asked, (&options, shard), &watch)?.object(py)
    }

    #[doc = include_str!("../../docs/write_shard.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (output, shard, *, samples = None, sampling: "SamplingName" = "random", seed = 0, breakpoints = false,
        attainability = false, all_columns = false, time_limit = None, progress: "Progress | None" = None,
        **values: "str | ArrayLike | Sequence[Value]"))]
    fn write_shard(
        &self,
        py: Python<'_>,
        output: PathBuf,
        shard: (i64, i64),
        samples: Option<i64>,
        sampling: &str,
        seed: i128,
        breakpoints: bool,
        attainability: bool,
        all_columns: bool,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        values: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PathBuf> {
        let sampling = choice("sampling", sampling)?;
        let question = sweep::Question { samples, sampling, seed, breakpoints, attainability, all_columns };
        let options = question.options(&|faults| self.refused(py, &faults), values)?;
        let watch = Watch::new(time_limit, progress)?;
        let part = (&options, sweep::shard(shard)?);
        shards::write_shard(py, (&self.file, &self.asked), part, (&output, &watch))
    }

    #[doc = include_str!("../../docs/simulate.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (until: "Value", *, mode = None, branches: "Sequence[int] | None" = None, prefer: "Preference" = "rule",
        impacts: "ImpactLaw" = "course", all_branches = None, tolerance = 1e-8, longest_step: "Value | None" = None, max_steps = 1_000_000, max_events = 100_000, max_reaction = None,
        time_limit = None, progress: "Progress | None" = None) -> "_motion.Motion")]
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        until: &Bound<'py, PyAny>,
        mode: Option<&str>,
        branches: Option<Vec<i64>>,
        prefer: &str,
        impacts: &str,
        all_branches: Option<i64>,
        tolerance: f64,
        longest_step: Option<&Bound<'py, PyAny>>,
        max_steps: i64,
        max_events: i64,
        max_reaction: Option<f64>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let limits = (max_steps, max_events, max_reaction);
        let way = (mode, branches.unwrap_or_default(), prefer, choice("impacts", impacts)?);
        let motion = MotionQuestion { until, way, steps: (tolerance, longest_step), limits, all_branches };
        motion.computed(py, self, &Watch::new(time_limit, progress)?)
    }

    #[doc = include_str!("../../docs/report.txt")]
    #[pyo3(signature = (*, time_limit = None, progress: "Progress | None" = None, **ranges: "Range | None") -> "_display.Page")]
    fn report<'py>(
        &self,
        py: Python<'py>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        ranges: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let page = self.page(py, varied(ranges)?, (time_limit, progress))?;
        display(py)?.getattr("Page")?.call1((page, self.title().unwrap_or(UNTITLED)))
    }

    #[doc = include_str!("../../docs/draw.txt")]
    #[pyo3(signature = (solution = None, *, theme: "ThemeName" = "light") -> "_display.Drawing")]
    fn draw<'py>(slf: &Bound<'py, Self>, solution: Option<i64>, theme: &str) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let Some(solution) = solution else {
            let svg = slf.get().asked.drawing(py, None, (Shown::Mechanism, named(theme)?))?;
            return display(py)?.getattr("Drawing")?.call1((svg,));
        };
        let options = [("margins", false)].into_py_dict(py)?;
        let answer = slf.call_method("solve", (), Some(&options))?;
        let theme = [("theme", theme)].into_py_dict(py)?;
        answer.call_method("draw", (solution,), Some(&theme))
    }

    /// What a notebook shows: the drawing, parameters, coordinates and warnings.
    #[pyo3(signature = () -> "str")]
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        display(slf.py())?.call_method1("model_html", (slf,))
    }

    /// The coordinates as texts: name, value and rate.
    #[pyo3(signature = () -> "list[tuple[str, str, str]]")]
    fn _coordinate_texts(&self, py: Python<'_>) -> PyResult<Vec<(String, String, String)>> {
        self.coordinate_texts(py)
    }

    fn __repr__(&self) -> String {
        let title = self.asked.model.title.clone().unwrap_or_else(|| "without a title".to_owned());
        let settings = self.settings();
        let with = if settings.is_empty() { "" } else { ", with " };
        format!("<slideway.Model: {title}{with}{}>", settings.join(", "))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.identity() == other.get().identity())
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (&self.asked.text, self.setting_texts()).hash(&mut hasher);
        hasher.finish()
    }

    fn __copy__(&self) -> Self {
        self.clone()
    }

    #[pyo3(signature = (_memo: "object") -> "Model")]
    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.clone()
    }

    #[pyo3(signature = () -> "tuple[object, ...]")]
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (py.get_type::<Self>().getattr("_restore")?, self.kept(py)?).into_pyobject(py)
    }

    /// The model that was pickled.
    #[staticmethod]
    #[pyo3(signature = (text, kept_settings: "Sequence[tuple[str, str, Value]]", units_name, file))]
    fn _restore(
        py: Python<'_>,
        text: &str,
        kept_settings: Vec<(String, String, Bound<'_, PyAny>)>,
        units_name: Option<&str>,
        file: &str,
    ) -> PyResult<Self> {
        let model = Self::new(py, text)?.in_file(file).changed(py, &pickle::settings(kept_settings)?)?;
        model.in_units(units_name)
    }
}

/// Imports the module that makes what notebooks show.
fn display(py: Python<'_>) -> PyResult<Bound<'_, PyModule>> {
    py.import("slideway._display")
}
