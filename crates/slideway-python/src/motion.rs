//! A motion as Python holds it: its report, its table, its pictures.

use crate::answer::{Answer, Asked, style};
use crate::plot::{Plot, not_finite, theme};
use crate::to_python::{frozen_array, to_python};
use crate::work::Watch;
use numpy::PyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use slideway::configuration::Configuration;
use slideway::mechanism::Mechanism;
use slideway::motion::{self, History, Series, SimulateOptions, Thorough, simulate_all, simulate_with};
use slideway::report::finite;
use slideway_pictures::motion::{AnimationOptions, animation, motion_figure, portrait_figure};
use std::sync::Arc;

/// Rows of a table that are too many to be meant.
const MOST_ROWS: f64 = 1e7;

/// A motion: private half of `slideway.Motion`.
#[pyclass(frozen, module = "slideway._slideway")]
pub(crate) struct Motion {
    history: Arc<History>,
    options: SimulateOptions,
    asked: Asked,
}

impl Motion {
    /// The motion as an object of `slideway.Motion`.
    fn object(
        py: Python<'_>,
        history: History,
        options: SimulateOptions,
        asked: Asked,
    ) -> PyResult<Bound<'_, PyAny>> {
        let report =
            finite(motion::report(&history, &options)).map_err(|faults| asked.refused(py, &faults))?;
        let report = Answer::object(py, "SimulateReport", report, Some(asked.clone()))?;
        let motion = Self { history: Arc::new(history), options, asked };
        py.import("slideway._motion")?.getattr("Motion")?.call1((motion, report))
    }

    fn series(&self, py: Python<'_>, times: &[f64]) -> Series {
        py.detach(|| self.history.series(times))
    }
}

#[pymethods]
impl Motion {
    /// The times of the steps of the solver, or those in even steps.
    #[pyo3(signature = (step = None) -> "NDArray[np.float64]")]
    fn times<'py>(&self, py: Python<'py>, step: Option<f64>) -> PyResult<Bound<'py, PyAny>> {
        let times = match step {
            None => self.history.times().collect(),
            Some(step) if step > 0.0 && (self.history.stop() - self.history.start()) / step <= MOST_ROWS => {
                self.history.times_in_steps(step)
            }
            Some(step) => {
                let message = format!("step must be positive, for at most {MOST_ROWS:e} rows, not {step}");
                return Err(PyValueError::new_err(message));
            }
        };
        frozen_array(py, times)
    }

    /// The table at these times.
    #[pyo3(signature = (times: "Sequence[float]") -> "reports.Series")]
    fn table<'py>(&self, py: Python<'py>, times: Vec<f64>) -> PyResult<Bound<'py, PyAny>> {
        let series = self.series(py, &times);
        to_python(py, &series)
    }

    /// Coordinates, then their rates, one row for each, at these times.
    #[pyo3(signature = (times: "Sequence[float]") -> "NDArray[np.float64]")]
    fn states<'py>(&self, py: Python<'py>, times: Vec<f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let series = self.series(py, &times);
        // Behind the time, the table has three columns for each coordinate: value, rate and acceleration.
        let count = self.history.mechanism.coordinates.len();
        let row = |column: usize| {
            series.columns[column].values.iter().map(|value| value.unwrap_or(f64::NAN)).collect::<Vec<_>>()
        };
        let values = (0..count).map(|index| row(1 + 3 * index));
        let rates = (0..count).map(|index| row(2 + 3 * index));
        let rows: Vec<Vec<f64>> = values.chain(rates).collect();
        PyArray2::from_vec2(py, &rows).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The report as text, with all events.
    fn text_with_all_events(&self, color: bool) -> String {
        motion::report(&self.history, &self.options).text_with_all_events(style(color))
    }

    /// The plot over time, or in the plane of coordinate and rate.
    fn plot(&self, phase_portrait: bool) -> Plot {
        let figure = if phase_portrait { portrait_figure } else { motion_figure };
        Plot { figure: figure(&self.history).changed_by(&self.asked.settings) }
    }

    /// A moving picture as a page.
    #[pyo3(signature = (theme_name, slow_motion = None))]
    fn animation(&self, py: Python<'_>, theme_name: &str, slow_motion: Option<f64>) -> PyResult<String> {
        if slow_motion.is_some_and(|factor| !(factor > 0.0 && factor.is_finite())) {
            return Err(PyValueError::new_err("slow_motion must be a positive number"));
        }
        let theme = theme(theme_name)?;
        let page = py.detach(|| animation(&self.history, &AnimationOptions { slow_motion }, theme).to_html());
        page.map_err(not_finite)
    }
}

/// The motion of a mechanism, as an object of `slideway.Motion`; with `all_branches` every motion up to so many, as an
/// object of `slideway.reports.TreeReport`.
pub(crate) fn computed<'py>(
    py: Python<'py>,
    (mechanism, asked): (&Mechanism, Asked),
    (options, all_branches): (SimulateOptions, Option<usize>),
    watch: &Watch,
) -> PyResult<Bound<'py, PyAny>> {
    let refused = |faults| asked.refused(py, &faults);
    let Some(most) = all_branches else {
        let history = watch.run(py, |callback| {
            let configuration = Configuration::with_progress(mechanism, callback)?;
            simulate_with(mechanism, &configuration, &options, &mut Thorough, callback)
        })?;
        let history = history.answer(refused)?;
        return Motion::object(py, history, options, asked);
    };
    let tree = watch.run(py, |callback| {
        let configuration = Configuration::with_progress(mechanism, callback)?;
        let tree = simulate_all(mechanism, &configuration, &options, (&mut Thorough, most), callback)?;
        finite(motion::tree_report(&tree, &options))
    })?;
    Answer::object(py, "TreeReport", tree.answer(refused)?, Some(asked))
}
