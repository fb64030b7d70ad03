//! The contents of a model, and how it is asked.

use super::{Model, pickle};
use crate::answer::{Answer, Asked};
use crate::arguments::{choice, value};
use crate::fault::{Texts, file_error, in_file};
use crate::plot::not_finite;
use crate::work::Watch;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use slideway::fault::{Fault, FaultKind};
use slideway::limits::{Vary, rest_limits_with};
use slideway::model::{Parameter, Setting, SettingKind, Settings};
use slideway::progress::Callback;
use slideway::{Faults, HoldOptions, UnitSystem};
use slideway_pictures::page::{Findings, Origin};
use std::path::Path;
use std::sync::Arc;

/// The file that command lines name for a text without one.
const UNNAMED: &str = "model.toml";
/// Name of a model without a title on pages.
pub(super) const UNTITLED: &str = "model";

impl Model {
    /// The model of a text.
    pub(crate) fn new(py: Python<'_>, text: &str) -> PyResult<Self> {
        Self::read(py, text, || slideway::Model::parse(text))
    }

    /// The model that is read from a text.
    pub(super) fn read(
        py: Python<'_>,
        text: &str,
        read: impl FnOnce() -> Result<slideway::Model, Faults> + Send,
    ) -> PyResult<Self> {
        let settings = Settings::default();
        match py.detach(read) {
            Ok(model) => {
                let (model, text) = (Arc::new(model), Arc::from(text));
                Ok(Self { asked: Asked { model, text, settings }, units: None, file: Arc::from(UNNAMED) })
            }
            Err(faults) => Err(Texts { model: text, settings: &settings }.error(py, &faults)),
        }
    }

    pub(super) fn refused(&self, py: Python<'_>, faults: &Faults) -> PyErr {
        self.asked.refused(py, faults)
    }

    /// Runs a question, and raises what is wrong with it, or that its time was up.
    pub(super) fn ask<T: Send>(
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

    pub(super) fn changed(&self, py: Python<'_>, settings: &Settings) -> PyResult<Self> {
        let refused = |faults| Texts { model: &self.asked.text, settings }.error(py, &faults);
        let model = self.asked.model.with(settings).map_err(refused)?;
        let mut all = self.asked.settings.clone();
        for setting in settings.entries() {
            all = all.with(setting.clone());
        }
        let asked = Asked { model: Arc::new(model), text: self.asked.text.clone(), settings: all };
        Ok(Self { asked, ..self.clone() })
    }

    pub(super) fn in_file(mut self, file: &str) -> Self {
        self.file = Arc::from(file);
        self
    }

    /// It in the system of units of this name, if there is one.
    pub(super) fn in_units(self, name: Option<&str>) -> PyResult<Self> {
        let Some(name) = name else { return Ok(self) };
        let system = choice("units", name)?;
        let model = slideway::Model::clone(&self.asked.model).with_units(system);
        Ok(Self { asked: Asked { model: Arc::new(model), ..self.asked }, units: Some(system), ..self })
    }

    /// Everything that makes two models the same.
    pub(super) fn identity(&self) -> (&str, &[Setting], Option<UnitSystem>) {
        (&self.asked.text, self.asked.settings.entries(), self.units)
    }

    /// A time of an argument (s).
    pub(super) fn time(&self, py: Python<'_>, name: &str, given: &Bound<'_, PyAny>) -> PyResult<f64> {
        let setting = Setting::new(SettingKind::Time, name, value(name, given)?);
        let settings = Settings::default().with(setting.clone());
        let refused = |faults| Texts { model: &self.asked.text, settings: &settings }.error(py, &faults);
        self.asked.model.setting_value(&setting).map_err(refused)
    }

    /// The model of a file.
    pub(super) fn of_file(py: Python<'_>, path: &Path) -> PyResult<Self> {
        let too_large =
            || Faults::from(Fault::general(FaultKind::TooLarge { limit: slideway::model::SIZE_LIMIT }));
        let nothing = Texts { model: "", settings: &Settings::default() };
        let unread = |error| file_error(path, &error);
        if std::fs::metadata(path).map_err(unread)?.len() > slideway::model::SIZE_LIMIT {
            return Err(in_file(py, path, nothing.error(py, &too_large())));
        }
        let bytes = std::fs::read(path).map_err(unread)?;
        let read = Self::read(py, &String::from_utf8_lossy(&bytes), || slideway::Model::parse_bytes(&bytes));
        let read = read.map_err(|error| in_file(py, path, error))?;
        Ok(read.in_file(&path.to_string_lossy()))
    }

    /// The text with what was changed.
    pub(super) fn changed_text(&self, py: Python<'_>) -> PyResult<String> {
        let settings = self.asked.settings.entries();
        if settings.is_empty() {
            return Ok(self.asked.text.to_string());
        }
        let units = |setting: &Setting| match setting.kind {
            SettingKind::Parameter => self.asked.model.parameter_unit(&setting.name),
            _ => String::new(),
        };
        let changes = settings.iter().map(|setting| (pickle::kept(setting), units(setting)));
        let changes = PyTuple::new(py, changes.collect::<Vec<_>>())?;
        py.import("slideway._text")?.getattr("changed")?.call1((&*self.asked.text, changes))?.extract()
    }

    /// The values of the parameters in SI units with these units, by name.
    pub(super) fn quantities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let model = &self.asked.model;
        let values = model.constants().map(|constants| model.parameter_values(&constants));
        let values = values.map_err(|faults| self.refused(py, &faults))?;
        let entry = |(parameter, value): (&Parameter, f64)| {
            (parameter.name.to_string(), value, model.parameter_unit(&parameter.name))
        };
        let entries: Vec<_> = model.parameters.iter().zip(values).map(entry).collect();
        Ok(py.import("slideway._values")?.getattr("quantities")?.call1((entries,))?.cast_into()?)
    }

    /// The limits of rest over a range.
    pub(super) fn rest_limits_over<'py>(
        &self,
        py: Python<'py>,
        (range, options): (&Vary, &HoldOptions),
        watched: (Option<f64>, Option<Py<PyAny>>),
    ) -> PyResult<Bound<'py, PyAny>> {
        let report =
            self.ask(py, watched, |model, callback| rest_limits_with(model, range, options, callback))?;
        Answer::object(py, "RestLimitsReport", report, Some(self.asked.clone()))
    }

    /// The report as a page.
    pub(super) fn page(
        &self,
        py: Python<'_>,
        ranges: Vec<Vary>,
        watched: (Option<f64>, Option<Py<PyAny>>),
    ) -> PyResult<String> {
        let findings = self.ask(py, watched, |model, callback| Findings::of(model, ranges, callback))?;
        let origin = Origin {
            command: "Model.report of slideway for Python",
            name: self.asked.model.title.as_deref().unwrap_or(UNTITLED),
            text: &self.asked.text,
            settings: &self.asked.settings,
        };
        py.detach(|| findings.to_html(&origin)).map_err(not_finite)
    }

    /// The parameters as texts: name, value, and the range between whose ends it is known, if it has one.
    pub(super) fn parameter_texts(&self, py: Python<'_>) -> PyResult<Vec<(String, String, String)>> {
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

    /// The coordinates as texts: name, value and rate.
    pub(super) fn coordinate_texts(&self, py: Python<'_>) -> PyResult<Vec<(String, String, String)>> {
        let model = &self.asked.model;
        let report = slideway::check(model).map_err(|faults| self.refused(py, &faults))?;
        let texts = report.coordinates.into_iter().map(|coordinate| {
            let (unit, of_rate) = (model.units.of(coordinate.unit), model.units.of_rate(coordinate.unit));
            (coordinate.name, unit.show(coordinate.value), of_rate.show(coordinate.rate))
        });
        Ok(texts.collect())
    }

    /// Returns the changes of the text, such as `mu=0.5` and `at alpha=75 deg`.
    pub(super) fn setting_texts(&self) -> Vec<String> {
        let told = |setting: &Setting| match setting.kind {
            SettingKind::Position => format!("at {}", setting.text()),
            SettingKind::Rate => format!("rate {}", setting.text()),
            _ => setting.text(),
        };
        self.asked.settings.entries().iter().map(told).collect()
    }
}
