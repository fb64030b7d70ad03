//! What follows the motion: phase by phase (`run.rs`), step by step within a phase (`smooth/`), and through
//! impacts on faces and end stops (`landing.rs`).

mod landing;
pub(in crate::motion) mod run;
pub(in crate::motion) mod smooth;

use super::decision::rules::Decisions;
use super::decision::thorough::Thorough;
use super::options::SimulateOptions;
use super::record::history::History;
use crate::configuration::{Configuration, Pose};
use crate::fault::{Fault, FaultKind, Faults};
use crate::mechanism::{FrictionCircle, MAGNITUDES, Mechanism};
use crate::model::Model;
use crate::progress::{Callback, Work, as_far_as_wanted};
use crate::solve::never_turning;
use crate::units::precise;
use run::Run;
use std::borrow::Cow;
use std::ops::ControlFlow;

/// The motion of a model from its state on, with the events of the model.
///
/// # Errors
/// Options that make no sense, and a state in which the motion cannot begin. What goes wrong later ends the
/// history.
pub fn simulate(model: &Model, options: &SimulateOptions) -> Result<History, Faults> {
    check(options)?;
    let mechanism = Mechanism::new(model)?;
    let configuration = Configuration::new(&mechanism)?;
    let options = options.clone().with_events_of(&mechanism);
    simulate_with(&mechanism, &configuration, &options, &mut Thorough, &mut |_| ControlFlow::Continue(()))
}

/// The motion of a mechanism from a state on, with these decisions at its events; `progress` is told after
/// every step how much of the time is over, and ends the simulation when it breaks, within decisions, too.
///
/// # Errors
/// Options that make no sense, and a state in which the motion cannot begin. What goes wrong later ends the
/// history.
pub fn simulate_with(
    mechanism: &Mechanism,
    configuration: &Configuration,
    options: &SimulateOptions,
    decisions: &mut dyn Decisions,
    progress: &mut Callback<'_>,
) -> Result<History, Faults> {
    check(options)?;
    mechanism.check_no_press_fit("a motion in time")?;
    let mechanism = &mechanism.with_loose_faces()?;
    mechanism.check_one_sided_in_excess()?;
    mechanism.check_planar("a motion on a round rod", mechanism.ends())?;
    mechanism.check_determinate("a motion in time")?;
    check_tolerance(mechanism, configuration, options.tolerance)?;
    let mechanism = &with_rough_hinges_alone(mechanism);
    let mechanism = &mechanism.with_all_contacts();
    never_turning(mechanism, configuration)?;
    let follow = |work: Work<'_>| Run::new((mechanism, configuration), options, decisions, work).follow();
    as_far_as_wanted(progress, follow).0
}

/// The mechanism without friction circles of no size: these hinges have no friction.
fn with_rough_hinges_alone(mechanism: &Mechanism) -> Cow<'_, Mechanism> {
    let mut mechanism = Cow::Borrowed(mechanism);
    if !mechanism.friction_circles.iter().all(FrictionCircle::is_rough) {
        mechanism.to_mut().friction_circles.retain(FrictionCircle::is_rough);
    }
    mechanism
}

/// A step ends in numbers that are rounded to the machine epsilon of their magnitude, so that no step is more
/// accurate than that: of positions in relation to the size of the mechanism, of angles to one radian.
///
/// # Errors
/// A smaller tolerance.
fn check_tolerance(
    mechanism: &Mechanism,
    configuration: &Configuration,
    tolerance: f64,
) -> Result<(), Faults> {
    let magnitude = |pose: &Pose| (pose.position.amax() / mechanism.size).max(pose.angle().abs());
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
        if !MAGNITUDES.contains(&value) {
            let wanted = if value > 0.0 { "from 1e-60 to 1e60" } else { "greater than zero" };
            faults.push(Fault::general(FaultKind::OutOfRange {
                what: what.to_owned(),
                wanted,
                value: precise(value),
            }));
        }
    };
    positive("the duration", options.duration);
    positive("the tolerance", options.tolerance);
    positive("the longest step", options.longest_step.unwrap_or(1.0));
    positive("the limit of the normal forces", options.reaction_limit.unwrap_or(1.0));
    faults.or(())
}
