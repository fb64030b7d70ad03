//! Motion in time, with the contact mode as part of the state (theory, section 8).
//!
//! Between events every sliding joint and contact keeps what it does, its [`Phase`], and the motion is smooth: an explicit
//! Runge-Kutta method of order 5 follows positions and velocities of all bodies, and every step is projected back on the
//! joints. An event ends the phase; a [decision](Decisions) says how the motion goes on. Energy is accounted for: work and
//! dissipation are integrated beside the motion, and the error of the balance is told.
//!
//! # What is watched
//! Within a phase: normal forces, shares in preload gaps, sliding velocities, the determinant of the mode, couples of
//! guided sliders, how much friction is left to joints that stick, overlaps, travel limits, functions of the user. They
//! are evaluated at both ends of each step and at its thirds, and where the cubic through these values has a minimum near
//! zero; where one has fallen below zero its zero is found on the solution within the step. A function that swings faster than
//! that, so that no cubic shows it, can be missed: [`SimulateOptions::longest_step`] bounds that.
//!
//! ```
//! use slideway::model::{Model, Settings};
//! use slideway::motion::{End, SimulateOptions, simulate};
//!
//! let crank = Model::parse(slideway::gallery::find("slider-crank").expect("in the gallery").text)?;
//! let history = simulate(&crank, &SimulateOptions::new(0.05))?;
//! assert_eq!(history.end, End::Finished);
//! // The piston reverses at its dead centre.
//! assert!(history.events.iter().any(|event| event.words.contains("cylinder reverses")));
//! # Ok::<(), slideway::fault::Faults>(())
//! ```
//!
//! # Files
//! `motion` follows a mechanism in time, phase by phase: `equations/` are the equations within a phase
//! (`linear.rs` factors them, `rest.rs` says which bodies stand still), `stepper.rs` one step, `watch.rs`
//! what can end a phase, `root.rs` where it does and where it might between samples, `smooth.rs` a phase step
//! by step (`smooth/reactions.rs` the limit of normal forces), `amounts.rs` the loads as functions of time at
//! rest, `resolution.rs` whether a step sees what they do, `run.rs` the loop of phases, events and decisions,
//! `stop.rs` what happens at end stops, `rules.rs` what it asks of `decision/`, `energy.rs` the balance,
//! `history.rs` the result, `event.rs` its words. On top of a history stand `series.rs` (a table),
//! `report.rs` and `text.rs` (what is told), and `tree.rs`, which follows every branch.

mod amounts;
pub mod decision;
mod energy;
mod equations;
mod event;
mod history;
mod linear;
mod options;
mod report;
mod resolution;
mod root;
mod rules;
mod run;
mod series;
mod smooth;
mod stepper;
mod stop;
mod switching;
mod text;
mod tree;
mod watch;

#[cfg(test)]
mod tests;

use crate::pattern::phase;
pub use crate::pattern::phase::{ContactPhase, JointPhase, Phase};
pub use equations::Drift;
pub use event::{Cause, CauseKind, Event};
pub use history::{ContactSample, End, Energy, History, PhaseInterval, Reader, Sample, Statistics};
pub use options::{Crossing, EventFunction, SimulateOptions, UserEvent};
pub use report::{
    BranchReport, CauseReport, EndKind, EndReport, EnergyReport, EventReport, Named, PhaseReport, SCHEMA,
    SampledReport, SimulateReport, StatisticsReport, report,
};
pub use rules::{Decisions, Hold, Instant, Jam, Successor, Successors, Thorough};
pub use series::{Column, Series};
pub use tree::{Branching, BranchingReport, Tree, TreeReport, simulate_all, tree_report};

use crate::configuration::{Configuration, Pose};
use crate::fault::{Fault, FaultKind, Faults};
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::progress::Callback;
use run::Run;
use std::ops::ControlFlow;

/// The motion of a model from its state on, with the events of the model.
///
/// # Errors
/// Options that make no sense, and a state in which the motion cannot begin. What goes wrong later ends the history.
pub fn simulate(model: &Model, options: &SimulateOptions) -> Result<History, Faults> {
    check(options)?;
    let mechanism = Mechanism::new(model)?;
    let configuration = Configuration::new(&mechanism)?;
    let options = options.clone().with_events_of(&mechanism);
    simulate_with(&mechanism, &configuration, &options, &mut Thorough, &mut |_| ControlFlow::Continue(()))
}

/// The motion of a mechanism from a state on, with these decisions at its events; `progress` is told after every
/// step how much of the time is over, and ends the simulation when it breaks.
///
/// # Errors
/// Options that make no sense, and a state in which the motion cannot begin. What goes wrong later ends the history.
pub fn simulate_with(
    mechanism: &Mechanism,
    configuration: &Configuration,
    options: &SimulateOptions,
    decisions: &mut dyn Decisions,
    progress: &mut Callback<'_>,
) -> Result<History, Faults> {
    check(options)?;
    check_tolerance(mechanism, configuration, options.tolerance)?;
    Run::new(mechanism, configuration, options, decisions).follow(progress)
}

/// A step ends in numbers that are rounded to the machine epsilon of their magnitude, so that no step is more accurate than
/// that: of positions in relation to the size of the mechanism, of angles to one radian.
///
/// # Errors
/// A smaller tolerance.
fn check_tolerance(
    mechanism: &Mechanism,
    configuration: &Configuration,
    tolerance: f64,
) -> Result<(), Faults> {
    let magnitude = |pose: &Pose| (pose.position.amax() / mechanism.size).max(pose.angle.abs());
    let greatest = configuration.poses.iter().map(magnitude).fold(1.0, f64::max);
    let least = f64::EPSILON * greatest;
    if tolerance < least {
        return Err(Fault::general(FaultKind::ToleranceTooSmall { tolerance, least }).into());
    }
    Ok(())
}

fn check(options: &SimulateOptions) -> Result<(), Faults> {
    let mut faults = Faults::default();
    let mut positive = |what: &'static str, value: f64| {
        if !(value > 0.0 && value.is_finite()) {
            faults.push(Fault::general(FaultKind::OutOfRange {
                what: what.to_owned(),
                wanted: "greater than zero",
                value,
            }));
        }
    };
    positive("the duration", options.duration);
    positive("the tolerance", options.tolerance);
    positive("the longest step", options.longest_step.unwrap_or(1.0));
    positive("the limit of the normal forces", options.reaction_limit.unwrap_or(1.0));
    faults.or(())
}
