//! The question of `Model.simulate`.

use super::Model;
use crate::arguments::{count, optional_count};
use crate::motion;
use crate::work::Watch;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use slideway::SimulateOptions;
use slideway::fault::{Fault, FaultKind};
use slideway::mechanism::Mechanism;
use slideway::motion::ImpactLaw;

/// A motion as it is asked for.
pub(super) struct MotionQuestion<'a, 'py> {
    pub(super) until: &'a Bound<'py, PyAny>,
    /// The mode in which it begins, its branches, counted from 1, what is preferred after them, and the law of impacts.
    pub(super) way: (Option<&'a str>, Vec<i64>, &'a str, ImpactLaw),
    /// Tolerance and longest step.
    pub(super) steps: (f64, Option<&'a Bound<'py, PyAny>>),
    /// Most steps and events, and the greatest reaction.
    pub(super) limits: (i64, i64, Option<f64>),
    pub(super) all_branches: Option<i64>,
}

impl<'py> MotionQuestion<'_, 'py> {
    /// The motion, or all of them.
    pub(super) fn computed(
        self,
        py: Python<'py>,
        model: &Model,
        watch: &Watch,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mechanism = Mechanism::new(&model.asked.model).map_err(|faults| model.refused(py, &faults))?;
        let all_branches = optional_count("all_branches", self.all_branches)?;
        let options = self.options(py, model, &mechanism)?;
        motion::computed(py, (&mechanism, model.asked.clone()), (options, all_branches), watch)
    }

    fn options(self, py: Python<'_>, model: &Model, mechanism: &Mechanism) -> PyResult<SimulateOptions> {
        let refused = |faults| model.refused(py, &faults);
        let (start, end) = (mechanism.time, model.time(py, "until", self.until)?);
        if end <= start {
            return Err(refused(Fault::general(FaultKind::NothingToSimulate { start, end }).into()));
        }
        let (mode, branches, prefer, impacts) = self.way;
        let (tolerance, longest_step) = self.steps;
        let (steps, events, reaction) = self.limits;
        let longest_step = longest_step.map(|step| model.time(py, "longest_step", step)).transpose()?;
        let options = SimulateOptions::new(end - start)
            .tolerance(tolerance)
            .longest_step(longest_step)
            .most_steps(count("max_steps", steps)?)
            .most_events(count("max_events", events)?)
            .reaction_limit(reaction)
            .branches(from_zero(branches)?)
            .prefers_sliding(prefers_sliding(prefer)?)
            .impacts(impacts)
            .with_events_of(mechanism);
        match mode {
            Some(mode) => options.initial_of(mode, mechanism).map_err(refused),
            None => Ok(options),
        }
    }
}

/// Branches as the library counts them, from 0.
fn from_zero(counted_from_one: Vec<i64>) -> PyResult<Vec<usize>> {
    let refused = |branch| PyValueError::new_err(format!("branches are counted from 1, not {branch}"));
    let index = |branch: i64| branch.checked_sub(1).and_then(|index| usize::try_from(index).ok());
    counted_from_one.into_iter().map(|branch| index(branch).ok_or_else(|| refused(branch))).collect()
}

/// Whether sliding is preferred where a motion branches.
fn prefers_sliding(prefer: &str) -> PyResult<bool> {
    match prefer {
        "rule" => Ok(false),
        "sliding" => Ok(true),
        _ => Err(PyValueError::new_err(format!("prefer must be 'rule' or 'sliding', not {prefer:?}"))),
    }
}
