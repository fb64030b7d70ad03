//! The whole pipeline: all solutions of the kinetic problem of a mechanism in its state.
//!
//! ```
//! use slideway::model::{Model, Settings};
//! use slideway::report::Status;
//!
//! let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
//! let model = Model::parse(text)?;
//! let report = slideway::solve::solve(&model)?;
//! assert_eq!(report.status, Status::Several);
//! assert_eq!(report.solutions.len(), 3);
//!
//! // Moving to the left without preload it jams at this friction.
//! let settings = Settings::default().parameter("F_20", "0").parameter("direction", "-1");
//! let report = slideway::solve::solve(&model.with(&settings)?)?;
//! assert_eq!(report.status, Status::None);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```

mod answer;
mod continuum;
mod distinct;
mod equilibrium;
mod mode_problem;
mod state;
mod words;

pub use mode_problem::mode_problem;
pub(crate) use mode_problem::{check_size, velocity_signs};
pub use words::mode_in_words;

use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::modes::{self, Limits};
use crate::report::Report;

/// All solutions of the kinetic problem of a model in its state, with their contact modes.
///
/// # Errors
/// Whatever makes no sense in the model or its state. That there is no solution is no error, but
/// [`crate::report::Status::None`].
pub fn solve(model: &Model) -> Result<Report, Faults> {
    solve_within(model, &Limits::default())
}

/// [`solve`] with limits on the work.
///
/// # Errors
/// As [`solve`].
pub fn solve_within(model: &Model, limits: &Limits) -> Result<Report, Faults> {
    let mechanism = Mechanism::new(model)?;
    check_size(&mechanism, limits)?;
    let configuration = Configuration::new(&mechanism)?;
    let equations = KineticEquations::new(&mechanism, &configuration)?;
    let influence = Influence::new(&equations);
    let velocity_signs = velocity_signs(&mechanism, &configuration)?;
    let problem = mode_problem(&mechanism, &influence, &velocity_signs)?;
    let solutions = modes::enumerate(&problem, limits).map_err(|error| mode_problem::too_large(&error))?;
    let answer = answer::Answer {
        mechanism: &mechanism,
        configuration: &configuration,
        equations: &equations,
        influence: &influence,
        velocity_signs: &velocity_signs,
    };
    answer.report(&solutions)
}
