//! The class `slideway.Model`: a model with its settings, and a method for each question.

use crate::answer::{Answer, Asked, not_finite, theme as named};
use crate::arguments::{search, settings, units, value, varied, vary, vary_between};
use crate::fault::Texts;
use crate::motion::{self, Motion};
use crate::work::Watch;
use crate::{shards, sweep};
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyTuple};
use slideway::fault::{Fault, FaultKind, nearest};
use slideway::limits::{curves_with, rest_limits_with};
use slideway::map::{ColourBy, GREATEST_SIZE, map_with};
use slideway::mechanism::Mechanism;
use slideway::model::{Setting, SettingKind, Settings};
use slideway::motion::{Thorough, simulate_all, simulate_with};
use slideway::progress::Callback;
use slideway::size::{Against, size_with};
use slideway::solve::solve_with;
use slideway::standstill::{hold_with, only_load};
use slideway::template::{self, TEMPLATES};
use slideway::units::Unit;
use slideway::{
    DriveOptions, Faults, HoldOptions, LimitsOptions, MapOptions, SimulateOptions, SizeOptions, SolveOptions,
    UnitSystem, gallery,
};
use slideway_pictures::drawing::Shown;
use slideway_pictures::page::{Findings, Origin};
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::Arc;

/// A planar mechanism with dry friction, in one state: a model file and what was changed in it. It never changes;
/// `with_` gives another one.
#[pyclass(frozen, module = "slideway", name = "Model")]
#[derive(Clone)]
pub(crate) struct Model {
    asked: Asked,
    units: Option<UnitSystem>,
}

impl Model {
    /// The model of a text.
    pub(crate) fn new(py: Python<'_>, text: &str) -> PyResult<Self> {
        Self::read(py, text, || slideway::Model::parse(text))
    }

    /// The model that is read from a text.
    fn read(
        py: Python<'_>,
        text: &str,
        read: impl FnOnce() -> Result<slideway::Model, Faults> + Send,
    ) -> PyResult<Self> {
        let settings = Settings::default();
        match py.detach(read) {
            Ok(model) => {
                let (model, text) = (Arc::new(model), Arc::from(text));
                Ok(Self { asked: Asked { model, text, settings }, units: None })
            }
            Err(faults) => Err(Texts { model: text, settings: &settings }.error(py, &faults)),
        }
    }

    fn refused(&self, py: Python<'_>, faults: &Faults) -> PyErr {
        self.asked.refused(py, faults)
    }

    /// Runs a question, and raises what is wrong with it, or that its time was up.
    fn ask<T: Send>(
        &self,
        py: Python<'_>,
        (time_limit, progress): (Option<f64>, Option<Py<PyAny>>),
        question: impl FnOnce(&slideway::Model, &mut Callback<'_>) -> Result<Option<T>, Faults> + Send,
    ) -> PyResult<T> {
        let model = &self.asked.model;
        let ended = Watch::new(time_limit, progress)?
            .run_beside(py, |callback| question(model, callback).transpose())?;
        ended.whole()?.map_err(|faults| self.refused(py, &faults))
    }

    fn changed(&self, py: Python<'_>, settings: &Settings) -> PyResult<Self> {
        let refused = |faults| Texts { model: &self.asked.text, settings }.error(py, &faults);
        let model = self.asked.model.with(settings).map_err(refused)?;
        let mut all = self.asked.settings.clone();
        for setting in settings.entries() {
            all = all.with(setting.clone());
        }
        let asked = Asked { model: Arc::new(model), text: self.asked.text.clone(), settings: all };
        Ok(Self { asked, units: self.units })
    }

    fn in_system(&self, system: UnitSystem) -> Self {
        let model = slideway::Model::clone(&self.asked.model).with_units(system);
        Self { asked: Asked { model: Arc::new(model), ..self.asked.clone() }, units: Some(system) }
    }

    /// Everything that makes two models the same.
    fn identity(&self) -> (&str, &[Setting], Option<UnitSystem>) {
        (&self.asked.text, self.asked.settings.entries(), self.units)
    }

    /// A time of an argument (s).
    fn time(&self, py: Python<'_>, name: &str, given: &Bound<'_, PyAny>) -> PyResult<f64> {
        let setting = Setting::new(SettingKind::Time, name, value(name, given)?);
        let settings = Settings::default().with(setting.clone());
        let refused = |faults| Texts { model: &self.asked.text, settings: &settings }.error(py, &faults);
        self.asked.model.setting_value(&setting).map_err(refused)
    }
}

#[pymethods]
impl Model {
    #[doc = include_str!("../docs/parse.txt")]
    #[staticmethod]
    fn parse(py: Python<'_>, text: &str) -> PyResult<Self> {
        Self::new(py, text)
    }

    #[doc = include_str!("../docs/load.txt")]
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let too_large =
            || Faults::from(Fault::general(FaultKind::TooLarge { limit: slideway::model::SIZE_LIMIT }));
        let nothing = Texts { model: "", settings: &Settings::default() };
        if std::fs::metadata(&path)?.len() > slideway::model::SIZE_LIMIT {
            return Err(nothing.error(py, &too_large()));
        }
        let bytes = std::fs::read(&path)?;
        Self::read(py, &String::from_utf8_lossy(&bytes), || slideway::Model::parse_bytes(&bytes))
    }

    #[doc = include_str!("../docs/gallery.txt")]
    #[staticmethod]
    fn gallery(py: Python<'_>, name: &str) -> PyResult<Self> {
        let names = gallery::MODELS.iter().map(|model| model.name);
        let unknown = || unknown(&format!("there is no model {name:?} in the gallery"), nearest(name, names));
        Self::new(py, gallery::find(name).ok_or_else(unknown)?.text)
    }

    #[doc = include_str!("../docs/template.txt")]
    #[staticmethod]
    #[pyo3(signature = (name, /, **sizes: "Value"))]
    fn template(py: Python<'_>, name: &str, sizes: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let names = TEMPLATES.iter().map(|template| template.name);
        let unknown = || unknown(&format!("there is no template {name:?}"), nearest(name, names));
        let template = template::find(name).ok_or_else(unknown)?;
        let mut settings = Settings::default();
        for (name, given) in sizes.into_iter().flatten() {
            let name: String = name.extract()?;
            settings = settings.parameter(&name, value(&name, &given)?);
        }
        let refused = |faults| Texts { model: template.text, settings: &settings }.error(py, &faults);
        let text = template.model(&settings, &format!("{name}.toml")).map_err(refused)?;
        Self::new(py, &text)
    }

    /// The text of the model, without what was changed.
    #[getter]
    fn text(&self) -> &str {
        &self.asked.text
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
        let model = &self.asked.model;
        let refused = |faults| self.refused(py, &faults);
        let values = model.parameter_values(&model.constants().map_err(refused)?);
        let ranges = model.ranges().map_err(refused)?;
        let texts = model.parameters.iter().zip(values).map(|(parameter, value)| {
            let name = parameter.name.to_string();
            let unit = model.units.parameter(&name, &model.parameter_unit(&name));
            let range = ranges.iter().find(|range| range.name == name);
            let range = range.map(|range| format!("{} to {}", unit.show(range.from), unit.show(range.to)));
            (name, unit.show(value), range.unwrap_or_default())
        });
        Ok(texts.collect())
    }

    /// The names of its coordinates.
    #[getter]
    fn coordinates(&self) -> Vec<&str> {
        self.asked.model.coordinates.iter().map(|coordinate| &*coordinate.name).collect()
    }

    /// What was changed in the text, such as `["mu=0.5", "at alpha=75 deg"]`.
    #[getter]
    fn settings(&self) -> Vec<String> {
        let told = |setting: &Setting| match setting.kind {
            SettingKind::Position => format!("at {}", setting.text()),
            SettingKind::Rate => format!("rate {}", setting.text()),
            _ => setting.text(),
        };
        self.asked.settings.entries().iter().map(told).collect()
    }

    #[doc = include_str!("../docs/with_.txt")]
    #[pyo3(signature = (*, at: "Mapping[str, Value] | None" = None, rate: "Mapping[str, Value] | None" = None, time: "Value | None" = None, units = None, **values: "Value"))]
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
        let changed = self.changed(py, &settings)?;
        match units {
            Some(name) => Ok(changed.in_system(crate::arguments::units(name)?)),
            None => Ok(changed),
        }
    }

    #[doc = include_str!("../docs/check.txt")]
    #[pyo3(signature = () -> "reports.CheckReport")]
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let report = py.detach(|| slideway::check(&self.asked.model));
        let report = report.map_err(|faults| self.refused(py, &faults))?;
        Answer::object(py, "CheckReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../docs/solve.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (*, margins = true, max_solutions = 100, max_nodes = None, max_found = None,
        time_limit = None, progress: "Progress | None" = None) -> "reports.SolveReport")]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        margins: bool,
        max_solutions: usize,
        max_nodes: Option<u64>,
        max_found: Option<usize>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = SolveOptions::default().margins(margins).most(max_solutions);
        let options = options.search(search(max_nodes, max_found));
        let model = &self.asked.model;
        let watch = Watch::new(time_limit, progress)?;
        let report = watch.run(py, |callback| solve_with(model, &options, callback))?.so_far();
        let report = report.map_err(|faults| self.refused(py, &faults))?;
        Answer::object(py, "SolveReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../docs/limits.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (vary_name, start: "Value | None" = None, stop: "Value | None" = None, *, max_reaction = None, both_directions = false,
        effort: "int" = slideway::limits::EFFORT, quantity = "normal-force", time_limit = None,
        progress: "Progress | None" = None) -> "reports.LimitsReport")]
    fn limits<'py>(
        &self,
        py: Python<'py>,
        vary_name: &str,
        start: Option<&Bound<'_, PyAny>>,
        stop: Option<&Bound<'_, PyAny>>,
        max_reaction: Option<f64>,
        both_directions: bool,
        effort: u64,
        quantity: &str,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = LimitsOptions::new(vary(vary_name, [start, stop])?)
            .max_reaction(max_reaction)
            .both_directions(both_directions)
            .effort(effort);
        let quantity = crate::arguments::plotted(quantity)?;
        let found = self.ask(py, (time_limit, progress), |model, callback| {
            curves_with(model, &options, quantity, callback)
        })?;
        Answer::with_curves(py, "LimitsReport", found, self.asked.clone())
    }

    #[doc = include_str!("../docs/hold.txt")]
    #[pyo3(signature = (load = None, *, vary = None, drives = "release", time_limit = None,
        progress: "Progress | None" = None) -> "reports.HoldReport")]
    fn hold<'py>(
        &self,
        py: Python<'py>,
        load: Option<String>,
        vary: Option<String>,
        drives: &str,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = hold_options(load, vary, drives)?;
        let report =
            self.ask(py, (time_limit, progress), |model, callback| hold_with(model, &options, callback))?;
        Answer::object(py, "HoldReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../docs/rest_limits.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (vary_name, start: "Value", stop: "Value", *, load = None, drives = "release", time_limit = None,
        progress: "Progress | None" = None) -> "reports.RestLimitsReport")]
    fn rest_limits<'py>(
        &self,
        py: Python<'py>,
        vary_name: &str,
        start: &Bound<'_, PyAny>,
        stop: &Bound<'_, PyAny>,
        load: Option<String>,
        drives: &str,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = hold_options(load, None, drives)?;
        let vary = vary(vary_name, [Some(start), Some(stop)])?;
        let report = self.ask(py, (time_limit, progress), |model, callback| {
            rest_limits_with(model, &vary, &options, callback)
        })?;
        Answer::object(py, "RestLimitsReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../docs/size.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (vary_name, start: "Value | None" = None, stop: "Value | None" = None, *, margin: "Value | None" = None, max_effort: "Value | None" = None,
        max_normal_force: "Value | None" = None, max_pressure: "Value | None" = None, min_efficiency: "Value | None" = None, against = "locking", load = None,
        both_directions = false, time_limit = None, progress: "Progress | None" = None) -> "reports.SizeReport")]
    fn size<'py>(
        &self,
        py: Python<'py>,
        vary_name: &str,
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
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [
            ("margin", margin),
            ("max_effort", max_effort),
            ("max_normal_force", max_normal_force),
            ("max_pressure", max_pressure),
            ("min_efficiency", min_efficiency),
        ];
        let given: Vec<_> = given.into_iter().filter_map(|(name, value)| Some((name, value?))).collect();
        let [(name, wanted)] = *given else {
            let names = "margin, max_effort, max_normal_force, max_pressure and min_efficiency";
            return Err(PyTypeError::new_err(format!("exactly one of {names} must be given")));
        };
        let (wanted, typed_in) = limit(name, wanted)?;
        let (load, is_load_used) = (load.clone(), load.is_some() && name == "min_efficiency");
        if is_load_used {
            let fault = Fault::general(FaultKind::LoadUnused { load: load.unwrap_or_default() });
            return Err(self.refused(py, &fault.into()));
        }
        let against = match name {
            "max_effort" => Against::Effort { drive: load },
            "max_normal_force" => Against::NormalForce { contact: load },
            "max_pressure" => Against::Pressure { contact: load },
            "min_efficiency" => Against::Efficiency,
            _ => self.against(py, against, load)?,
        };
        let options = SizeOptions::new(vary(vary_name, [start, stop])?, wanted)
            .against(against)
            .both_directions(both_directions)
            .typed_in(typed_in);
        let report =
            self.ask(py, (time_limit, progress), |model, callback| size_with(model, &options, callback))?;
        Answer::object(py, "SizeReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../docs/drive.txt")]
    #[pyo3(signature = (vary = None, between: "Range | None" = None, *, rows = 41, time_limit = None,
        progress: "Progress | None" = None) -> "reports.DriveReport")]
    fn drive<'py>(
        &self,
        py: Python<'py>,
        vary: Option<&str>,
        between: Option<&Bound<'_, PyAny>>,
        rows: usize,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        within("rows", rows, 2..=slideway::drive::GREATEST_ROWS)?;
        let vary = vary.map(|name| vary_between(name, between)).transpose()?;
        let options = DriveOptions::default().vary(vary).rows(rows);
        let report = self.ask(py, (time_limit, progress), |model, callback| {
            slideway::drive::drive_with(model, &options, callback)
        })?;
        Answer::object(py, "DriveReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../docs/map.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (*, colour_by = "solutions", size = None, probe = None, time_limit = None,
        progress: "Progress | None" = None, **axes: "Range | None") -> "reports.MapReport")]
    fn map<'py>(
        &self,
        py: Python<'py>,
        colour_by: &str,
        size: Option<(usize, usize)>,
        probe: Option<usize>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        axes: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let Ok([x, y]) = <[_; 2]>::try_from(varied(axes)?) else {
            return Err(PyTypeError::new_err(
                "two quantities must be given, such as map(mu=(0, 1), x=(0, 0.3))",
            ));
        };
        let mut options = MapOptions::new(x, y).colour_by(colours(colour_by)?);
        if let Some((width, height)) = size {
            within("width and height in size", width, 1..=GREATEST_SIZE)?;
            within("width and height in size", height, 1..=GREATEST_SIZE)?;
            options = options.size(width, height);
        }
        if let Some(pixels) = probe {
            options = options.probe(pixels);
        }
        let report =
            self.ask(py, (time_limit, progress), |model, callback| map_with(model, &options, callback))?;
        Answer::object(py, "MapReport", report, Some(self.asked.clone()))
    }

    #[doc = include_str!("../docs/sweep.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (*, samples = None, sampling = "random", seed = 0, breakpoints = false,
        attainability = false, all_columns = false, shard = None, time_limit = None, progress: "Progress | None" = None,
        **values: "str | ArrayLike | Sequence[Value]") -> "_sweep.Sweep")]
    fn sweep<'py>(
        &self,
        py: Python<'py>,
        samples: Option<u64>,
        sampling: &str,
        seed: u64,
        breakpoints: bool,
        attainability: bool,
        all_columns: bool,
        shard: Option<(u32, u32)>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        values: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let sampling = sweep::spread(sampling)?;
        let question = sweep::Question { samples, sampling, seed, breakpoints, attainability, all_columns };
        let options = question.options(&|faults| self.refused(py, &faults), values)?;
        let shard = shard.map(sweep::shard).transpose()?;
        let watch = Watch::new(time_limit, progress)?;
        sweep::table(py, &self.asked, (&options, shard), &watch)?.object(py)
    }

    #[doc = include_str!("../docs/write_shard.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (output, shard, *, samples = None, sampling = "random", seed = 0, breakpoints = false,
        attainability = false, all_columns = false, time_limit = None, progress: "Progress | None" = None,
        **values: "str | ArrayLike | Sequence[Value]"))]
    fn write_shard(
        &self,
        py: Python<'_>,
        output: PathBuf,
        shard: (u32, u32),
        samples: Option<u64>,
        sampling: &str,
        seed: u64,
        breakpoints: bool,
        attainability: bool,
        all_columns: bool,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        values: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PathBuf> {
        let sampling = sweep::spread(sampling)?;
        let question = sweep::Question { samples, sampling, seed, breakpoints, attainability, all_columns };
        let options = question.options(&|faults| self.refused(py, &faults), values)?;
        let watch = Watch::new(time_limit, progress)?;
        shards::write_shard(py, &self.asked, (options, sweep::shard(shard)?), (&output, &watch))
    }

    #[doc = include_str!("../docs/simulate.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (until: "Value", *, mode = None, branches: "Sequence[int] | None" = None, prefer = "rule", all_branches = None,
        tolerance = 1e-8, longest_step: "Value | None" = None, max_steps = 1_000_000, max_events = 100_000, max_reaction = None,
        time_limit = None, progress: "Progress | None" = None) -> "_motion.Motion")]
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        until: &Bound<'_, PyAny>,
        mode: Option<&str>,
        branches: Option<Vec<usize>>,
        prefer: &str,
        all_branches: Option<usize>,
        tolerance: f64,
        longest_step: Option<&Bound<'_, PyAny>>,
        max_steps: usize,
        max_events: usize,
        max_reaction: Option<f64>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let refused = |faults: Faults| self.refused(py, &faults);
        let mechanism = Mechanism::new(&self.asked.model).map_err(refused)?;
        let (start, end) = (mechanism.time, self.time(py, "until", until)?);
        if end <= start {
            return Err(refused(Fault::general(FaultKind::NothingToSimulate { start, end }).into()));
        }
        let prefers_sliding = match prefer {
            "rule" => false,
            "sliding" => true,
            _ => {
                return Err(PyValueError::new_err(format!(
                    "prefer must be 'rule' or 'sliding', not {prefer:?}"
                )));
            }
        };
        let branches = branches.unwrap_or_default();
        if branches.contains(&0) {
            return Err(PyValueError::new_err("branches are counted from 1"));
        }
        let longest_step = longest_step.map(|step| self.time(py, "longest_step", step)).transpose()?;
        let mut options = SimulateOptions::new(end - start)
            .tolerance(tolerance)
            .longest_step(longest_step)
            .most_steps(max_steps)
            .most_events(max_events)
            .reaction_limit(max_reaction)
            .branches(branches.iter().map(|branch| branch - 1))
            .prefers_sliding(prefers_sliding)
            .with_events_of(&mechanism);
        options.initial = mode.map(|mode| initial(&mechanism, mode)).transpose().map_err(refused)?;
        let configuration = slideway::configuration::Configuration::new(&mechanism).map_err(refused)?;
        let watch = Watch::new(time_limit, progress)?;
        let asked = self.asked.clone();
        if let Some(most) = all_branches {
            let tree = watch.run(py, |callback| {
                simulate_all(&mechanism, &configuration, &options, (&mut Thorough, most), callback)
            })?;
            return motion::tree(py, &tree.so_far().map_err(refused)?, &options, asked);
        }
        let history = watch.run(py, |callback| {
            simulate_with(&mechanism, &configuration, &options, &mut Thorough, callback)
        })?;
        Motion::object(py, history.so_far().map_err(refused)?, options, asked)
    }

    #[doc = include_str!("../docs/report.txt")]
    #[pyo3(signature = (*, time_limit = None, progress: "Progress | None" = None, **ranges: "Range | None") -> "_display.Page")]
    fn report<'py>(
        &self,
        py: Python<'py>,
        time_limit: Option<f64>,
        progress: Option<Py<PyAny>>,
        ranges: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let wanted = varied(ranges)?;
        let findings =
            self.ask(py, (time_limit, progress), |model, callback| Findings::of(model, wanted, callback))?;
        let title = self.title().unwrap_or("model");
        let origin = Origin {
            command: "Model.report of slideway for Python",
            name: title,
            text: &self.asked.text,
            settings: &self.asked.settings,
        };
        let page = py.detach(|| findings.to_html(&origin)).map_err(not_finite)?;
        display(py)?.getattr("Page")?.call1((page, title))
    }

    #[doc = include_str!("../docs/draw.txt")]
    #[pyo3(signature = (solution = None, *, theme = "light") -> "_display.Drawing")]
    fn draw<'py>(
        slf: &Bound<'py, Self>,
        solution: Option<usize>,
        theme: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
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
        let model = &self.asked.model;
        let report = slideway::check(model).map_err(|faults| self.refused(py, &faults))?;
        let texts = report.coordinates.into_iter().map(|coordinate| {
            let (unit, of_rate) = (model.units.of(coordinate.unit), model.units.of_rate(coordinate.unit));
            (coordinate.name, unit.show(coordinate.value), of_rate.show(coordinate.rate))
        });
        Ok(texts.collect())
    }

    fn __repr__(&self) -> String {
        let title = self.asked.model.title.clone().unwrap_or_else(|| "without a title".to_owned());
        let settings = self.settings();
        let settings =
            if settings.is_empty() { String::new() } else { format!(", with {}", settings.join(", ")) };
        format!("<slideway.Model: {title}{settings}>")
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.identity() == other.get().identity())
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.asked.text.hash(&mut hasher);
        for setting in self.asked.settings.entries() {
            setting.text().hash(&mut hasher);
        }
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
        let settings = PyTuple::new(py, self.asked.settings.entries().iter().map(kept).collect::<Vec<_>>())?;
        let units = self.units.map(|units| match units {
            UnitSystem::Si => "SI",
            UnitSystem::Millimetres => "mm",
            UnitSystem::AsTyped => "as-typed",
        });
        let restore = py.get_type::<Self>().getattr("_restore")?;
        (restore, (self.text(), settings, units)).into_pyobject(py)
    }

    /// The model that was pickled.
    #[staticmethod]
    #[pyo3(signature = (text, kept_settings: "Sequence[tuple[str, str, Value]]", units_name))]
    fn _restore(
        py: Python<'_>,
        text: &str,
        kept_settings: Vec<(String, String, Bound<'_, PyAny>)>,
        units_name: Option<&str>,
    ) -> PyResult<Self> {
        let mut settings = Settings::default();
        for (kind, name, given) in kept_settings {
            let kind = match &*kind {
                "at" => SettingKind::Position,
                "rate" => SettingKind::Rate,
                "time" => SettingKind::Time,
                _ => SettingKind::Parameter,
            };
            settings = settings.with(Setting::new(kind, &name, value(&name, &given)?));
        }
        let model = Self::new(py, text)?.changed(py, &settings)?;
        match units_name {
            Some(name) => Ok(model.in_system(units(name)?)),
            None => Ok(model),
        }
    }
}

impl Model {
    fn against(&self, py: Python<'_>, against: &str, load: Option<String>) -> PyResult<Against> {
        let load_at_rest = |load: Option<String>| match load {
            Some(load) => Ok(load),
            None => only_load(&self.asked.model).map_err(|faults| self.refused(py, &faults)),
        };
        match (against, load) {
            ("locking", None) => Ok(Against::Locking),
            ("locking", Some(load)) => {
                Err(self.refused(py, &Fault::general(FaultKind::LoadUnused { load }).into()))
            }
            ("self-locking", load) => Ok(Against::SelfLocking { load: load_at_rest(load)? }),
            ("hold", load) => Ok(Against::Hold { load: load_at_rest(load)? }),
            _ => {
                let known = "'locking', 'self-locking' or 'hold'";
                Err(PyValueError::new_err(format!("against must be {known}, not {against:?}")))
            }
        }
    }
}

/// What notebooks show.
fn display(py: Python<'_>) -> PyResult<Bound<'_, PyModule>> {
    py.import("slideway._display")
}

/// A setting as what is pickled of it.
fn kept(setting: &Setting) -> (&'static str, String, KeptValue) {
    let kind = match setting.kind {
        SettingKind::Position => "at",
        SettingKind::Rate => "rate",
        SettingKind::Time => "time",
        _ => "",
    };
    let kept = match &setting.value {
        slideway::Value::Number(number) => KeptValue::Number(*number),
        other => KeptValue::Text(other.to_string()),
    };
    (kind, setting.name.clone(), kept)
}

/// A value as what is pickled of it.
#[derive(IntoPyObject)]
enum KeptValue {
    Number(f64),
    Text(String),
}

/// A limit, with the unit in which it was typed.
fn limit(name: &str, given: &Bound<'_, PyAny>) -> PyResult<(f64, Option<Unit>)> {
    let (number, unit) = match value(name, given)? {
        slideway::Value::Number(number) => (number, None),
        text => {
            let text = text.to_string();
            let read = Unit::of_quantity(&text);
            let read = read.ok_or_else(|| PyValueError::new_err(format!("{name} cannot be {text:?}")))?;
            (read.0, Some(read.1))
        }
    };
    let is_allowed = number > 0.0 && (name != "min_efficiency" || number <= 1.0);
    let wanted = if name == "min_efficiency" { "above 0 and at most 1" } else { "greater than zero" };
    if is_allowed {
        Ok((number, unit))
    } else {
        Err(PyValueError::new_err(format!("{name} must be {wanted}")))
    }
}

/// Refuses a count outside of its range.
fn within(name: &str, count: usize, range: RangeInclusive<usize>) -> PyResult<()> {
    if range.contains(&count) {
        return Ok(());
    }
    let (least, most) = range.into_inner();
    Err(PyValueError::new_err(format!("{name} must be from {least} to {most}, not {count}")))
}

fn hold_options(load: Option<String>, vary: Option<String>, drives: &str) -> PyResult<HoldOptions> {
    let holds = match drives {
        "release" => false,
        "hold" => true,
        _ => {
            return Err(PyValueError::new_err(format!("drives must be 'release' or 'hold', not {drives:?}")));
        }
    };
    let mut options = HoldOptions::default().hold_drives(holds);
    (options.load, options.vary) = (load, vary);
    Ok(options)
}

fn colours(name: &str) -> PyResult<ColourBy> {
    match name {
        "solutions" => Ok(ColourBy::Solutions),
        "modes" => Ok(ColourBy::Modes),
        "margin" => Ok(ColourBy::Margin),
        "jam" => Ok(ColourBy::Jam),
        "motion" => Ok(ColourBy::Motion),
        "hold" => Ok(ColourBy::Hold),
        _ => {
            let known = "'solutions', 'modes', 'margin', 'jam', 'motion' or 'hold'";
            Err(PyValueError::new_err(format!("colour_by must be {known}, not {name:?}")))
        }
    }
}

/// A contact mode without its blanks.
fn initial(mechanism: &Mechanism, mode: &str) -> Result<String, Faults> {
    let pattern: String = mode.chars().filter(|sign| !sign.is_whitespace()).collect();
    let contacts = &mechanism.contacts;
    if pattern.len() == contacts.len() && pattern.chars().all(|sign| "+-0=".contains(sign)) {
        return Ok(pattern);
    }
    let contacts = contacts.iter().map(|contact| contact.name.to_string()).collect();
    Err(Fault::general(FaultKind::MalformedMode { text: mode.to_owned(), contacts }).into())
}

/// That there is nothing of a name, and which one is perhaps meant.
fn unknown(message: &str, nearest: Option<String>) -> PyErr {
    let meant = nearest.map(|near| format!("; did you mean {near:?}?"));
    PyKeyError::new_err(format!("{message}{}", meant.unwrap_or_default()))
}

#[doc = include_str!("../docs/templates.txt")]
#[pyfunction]
#[pyo3(signature = () -> "dict[str, str]")]
pub(crate) fn templates(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let templates = PyDict::new(py);
    for template in TEMPLATES {
        templates.set_item(template.name, template.summary())?;
    }
    Ok(templates)
}

#[doc = include_str!("../docs/gallery_models.txt")]
#[pyfunction]
#[pyo3(signature = () -> "dict[str, str]")]
pub(crate) fn gallery_models(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let models = PyDict::new(py);
    for model in gallery::MODELS {
        models.set_item(model.name, model.summary())?;
    }
    Ok(models)
}
