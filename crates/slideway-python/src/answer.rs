//! A report as Python holds it: plain data that become objects when they are asked for.

use crate::arguments::optional_count;
use crate::fault::Texts;
use crate::plot::{Plot, not_finite, theme};
use crate::to_python::{fields, instance, to_python};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use slideway::Report;
use slideway::configuration::Configuration;
use slideway::limits::{Curves, LimitsReport};
use slideway::map::MapReport;
use slideway::mechanism::Mechanism;
use slideway::model::Settings;
use slideway::report::{SolveReport, Style};
use slideway_pictures::drawing::svg::{self, Colours};
use slideway_pictures::drawing::{Forces, Shown, sheet};
use slideway_pictures::page::{limits_part, solve_parts};
use slideway_pictures::theme::Theme;
use std::any::Any;
use std::sync::Arc;

/// A report without its type, with what every report can do.
trait AnyReport: Send + Sync {
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>>;
    fn json(&self) -> String;
    fn answer(&self) -> String;
    fn text(&self, style: Style) -> String;
    fn any(&self) -> &dyn Any;
}

impl<R: Report + Send + Sync + 'static> AnyReport for R {
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        fields(py, self)
    }

    fn json(&self) -> String {
        Report::json(self)
    }

    fn answer(&self) -> String {
        Report::answer(self)
    }

    fn text(&self, style: Style) -> String {
        Report::text(self, style)
    }

    fn any(&self) -> &dyn Any {
        self
    }
}

/// The model of which something was asked.
#[derive(Debug, Clone)]
pub(crate) struct Asked {
    /// With its settings.
    pub(crate) model: Arc<slideway::Model>,
    /// The text of the model, and the settings, for faults and titles.
    pub(crate) text: Arc<str>,
    pub(crate) settings: Settings,
}

impl Asked {
    /// Builds the Python error for its faults.
    pub(crate) fn refused(&self, py: Python<'_>, faults: &slideway::Faults) -> PyErr {
        Texts { model: &self.text, settings: &self.settings }.error(py, faults)
    }

    /// Its drawing, with solutions if there are any.
    pub(crate) fn drawing(
        &self,
        py: Python<'_>,
        report: Option<&SolveReport>,
        (shown, theme): (Shown, &'static Theme),
    ) -> PyResult<String> {
        let mechanism = Mechanism::new(&self.model).map_err(|faults| self.refused(py, &faults))?;
        let configuration = Configuration::new(&mechanism).map_err(|faults| self.refused(py, &faults))?;
        let Some(sheet) = sheet(&mechanism, &configuration, report.map(Forces::InMotion), shown) else {
            let count = report.map_or(0, |report| report.solutions.len());
            let message = format!("solution: there is no solution of this number: {count} are listed");
            return Err(PyValueError::new_err(message));
        };
        let sheet = sheet.changed_by(&self.settings);
        svg::write(&sheet.scene, &sheet.frame(None, Colours::Theme(*theme))).map_err(not_finite)
    }
}

/// The style of a text, with colours for a terminal if wanted.
pub(crate) fn style(color: bool) -> Style {
    Style::PLAIN.colour(color)
}

/// A report, and what its pictures are made of.
#[pyclass(frozen, module = "slideway._slideway")]
pub(crate) struct Answer {
    report: Box<dyn AnyReport>,
    asked: Option<Asked>,
    curves: Option<Curves>,
}

impl Answer {
    /// The report as an object of its class in `slideway.reports`, whose attributes are made when one of them
    /// is first asked for.
    pub(crate) fn object<'py, R: Report + Send + Sync + 'static>(
        py: Python<'py>,
        class: &str,
        report: R,
        asked: Option<Asked>,
    ) -> PyResult<Bound<'py, PyAny>> {
        Self { report: Box::new(report), asked, curves: None }.in_class(py, class)
    }

    /// Returns the report as an object of its class, with the curves of its plot.
    pub(crate) fn with_curves<'py, R: Report + Send + Sync + 'static>(
        py: Python<'py>,
        class: &str,
        (report, curves): (R, Curves),
        asked: Asked,
    ) -> PyResult<Bound<'py, PyAny>> {
        Self { report: Box::new(report), asked: Some(asked), curves: Some(curves) }.in_class(py, class)
    }

    fn in_class<'py>(self, py: Python<'py>, class: &str) -> PyResult<Bound<'py, PyAny>> {
        let attributes = PyDict::new(py);
        attributes.set_item(intern!(py, "_answer"), self.into_pyobject(py)?)?;
        instance(py, class, attributes)
    }

    fn is<R: 'static>(&self) -> Option<&R> {
        self.report.any().downcast_ref()
    }

    fn asked(&self) -> PyResult<&Asked> {
        self.asked.as_ref().ok_or_else(|| PyTypeError::new_err("there is no model to draw"))
    }
}

#[pymethods]
impl Answer {
    /// The attributes of the report.
    #[pyo3(signature = () -> "dict[str, object]")]
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.report.fields(py)
    }

    /// The JSON output.
    fn json(&self, py: Python<'_>) -> String {
        py.detach(|| self.report.json())
    }

    /// The answer in a sentence or a few.
    fn answer(&self) -> String {
        self.report.answer()
    }

    /// The text output, with colours for a terminal and with how it is known if wanted.
    #[pyo3(signature = (color, verbose = false))]
    fn text(&self, py: Python<'_>, color: bool, verbose: bool) -> String {
        py.detach(|| self.report.text(style(color).verbose(verbose)))
    }

    /// A drawing of the mechanism and its solutions, of one of them, or of one state of a preload gap, counted from
    /// 1, as SVG.
    #[pyo3(signature = (theme_name, solution = None, gap_state = None))]
    fn drawing(
        &self,
        py: Python<'_>,
        theme_name: &str,
        solution: Option<i64>,
        gap_state: Option<i64>,
    ) -> PyResult<String> {
        let (solution, gap_state) =
            (optional_count("solution", solution)?, optional_count("gap_state", gap_state)?);
        let report = self.is::<SolveReport>();
        let shown = solution.map(Shown::Solution).or(gap_state.map(Shown::GapState)).unwrap_or(Shown::All);
        self.asked()?.drawing(py, report, (shown, theme(theme_name)?))
    }

    /// The answer in HTML: for solutions what they have in common, then a part for each; for limits one part.
    fn parts(&self) -> PyResult<Vec<String>> {
        let limits = self.is::<LimitsReport>().map(|report| vec![limits_part(report)]);
        let parts = limits.or_else(|| self.is::<SolveReport>().map(solve_parts));
        parts.ok_or_else(|| PyTypeError::new_err("this answer has no parts"))
    }

    /// The plot or the map as SVG.
    fn plot_svg(&self, theme_name: &str) -> PyResult<String> {
        match self.is::<MapReport>() {
            Some(map) => slideway_pictures::map::to_svg(map, &self.asked()?.settings, theme(theme_name)?)
                .map_err(not_finite),
            None => self.plot()?.svg(theme_name),
        }
    }

    /// The plot.
    fn plot(&self) -> PyResult<Plot> {
        use slideway::{drive::DriveReport, size::SizeReport};
        use slideway_pictures::plot::{drive_figure, limits_figure, size_figure};
        let figure = match (self.is::<LimitsReport>(), &self.curves) {
            (Some(report), Some(curves)) => Some(limits_figure(report, curves)),
            _ => self.is::<SizeReport>().map(size_figure),
        };
        let figure = figure.or_else(|| self.is::<DriveReport>().and_then(drive_figure));
        let figure = figure.ok_or_else(|| PyTypeError::new_err("this answer has no plot"))?;
        Ok(Plot { figure: figure.changed_by(&self.asked()?.settings) })
    }

    /// A map in words and colours.
    #[pyo3(signature = (theme_name) -> "reports.DrawnMap")]
    fn drawn_map<'py>(&self, py: Python<'py>, theme_name: &str) -> PyResult<Bound<'py, PyAny>> {
        let drawn = slideway_pictures::map::drawn(self.map()?, &self.asked()?.settings, theme(theme_name)?);
        to_python(py, &drawn)
    }

    /// The classes of the pixels of a map, row by row from the bottom.
    fn pixels(&self) -> PyResult<Vec<usize>> {
        Ok(self.map()?.pixels())
    }
}

impl Answer {
    fn map(&self) -> PyResult<&MapReport> {
        self.is().ok_or_else(|| PyTypeError::new_err("this is no map"))
    }
}
