//! Sweeps that are ready to be computed, and their plots.

use crate::answer::Asked;
use crate::plot::Plot;
use crate::work::{Ended, Watch};
use pyo3::exceptions::{PyTimeoutError, PyValueError};
use pyo3::prelude::*;
use slideway::limits::Quantity;
use slideway::progress::{Callback, Progress};
use slideway::sweep::{Rows, Sweep, SweepOptions, SweepState};
use slideway_pictures::plot::{SamplesPlot, SweepPlot};

/// A sweep of a model that is ready to be computed, with its exact ends of modes.
pub(crate) fn prepared(
    py: Python<'_>,
    asked: &Asked,
    options: &SweepOptions,
    watch: &Watch,
) -> PyResult<Sweep> {
    let model = &asked.model;
    let sweep = watch.run_beside(py, |callback| Sweep::new_with(model, options, callback).transpose())?;
    sweep.whole()?.map_err(|faults| asked.refused(py, &faults))
}

/// The plot of a quantity along every branch of a sweep, or of its distribution over samples.
pub(crate) fn plot(
    py: Python<'_>,
    (asked, options): (&Asked, &SweepOptions),
    quantity: Quantity,
    watch: &Watch,
) -> PyResult<Plot> {
    // Strokes tell of attainability.
    let options = options.clone().attainability(true);
    let sweep = prepared(py, asked, &options, watch)?;
    if sweep.line().is_none() && sweep.has_branches() {
        let needed = "a plot needs one varied quantity with ascending values, or random samples";
        return Err(PyValueError::new_err(format!("{needed}; map() shows two quantities")));
    }
    let title = asked.model.title.as_deref();
    let nothing = || PyValueError::new_err("the model has no such quantity to plot");
    let figure = if sweep.has_branches() {
        let mut plot = SweepPlot::new(&sweep, quantity).ok_or_else(nothing)?;
        let extractor = plot.extractor();
        let state = run(py, &sweep, watch, |rows| extractor.rows(rows), |part| plot.add(part))?;
        plot.set_branches(state.branches());
        plot.figure(title)
    } else {
        let mut plot = SamplesPlot::new(&sweep, quantity).ok_or_else(nothing)?;
        let taker = plot.clone();
        let state = run(py, &sweep, watch, |rows| taker.rows(rows), |part| plot.add(&part))?;
        plot.figure(title, &state)
    };
    Ok(Plot { figure: figure.changed_by(&asked.settings) })
}

/// Takes what a plot needs of all rows.
fn run<T: Send>(
    py: Python<'_>,
    sweep: &Sweep,
    watch: &Watch,
    take: impl Fn(&Rows) -> T + Sync,
    mut add: impl FnMut(T) + Send,
) -> PyResult<SweepState> {
    let mut state = sweep.start();
    let ended = watch.run_beside(py, |callback: &mut Callback<'_>| {
        sweep.run(&mut state, &take, &mut |parts, state| {
            parts.into_iter().for_each(&mut add);
            callback(&Progress::of("points", state.done, sweep.points()))
        });
    })?;
    match ended {
        Ended::Done(()) => Ok(state),
        Ended::TimeUp(()) => Err(PyTimeoutError::new_err("the sweep was not done within time_limit")),
    }
}
