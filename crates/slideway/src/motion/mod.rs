//! Motion in time, with the contact mode as part of the state (theory, section 8).
//!
//! Between events every sliding joint, contact and hinge with friction keeps what it does, its [`Phase`], and the motion is
//! smooth: an explicit Runge-Kutta method of order 5 follows positions and velocities of all bodies, and
//! every step is projected back on the joints. An event ends the phase; a [decision](Decisions) says how the
//! motion goes on. Energy is accounted for: work and dissipation are integrated beside the motion, and the
//! error of the balance is told.
//!
//! # What is watched
//! Within a phase: normal forces, shares in preload gaps, sliding velocities, the determinant of the mode,
//! couples of guided sliders, angular velocities of hinges with friction, how much friction is left to what sticks,
//! overlaps, travel limits, functions of the user. They are evaluated at both ends of each step and at its thirds, and where the cubic
//! through these values has a minimum near zero; where one has fallen below zero its zero is found on the
//! solution within the step. A function that swings faster than that, so that no cubic shows it, can be
//! missed: [`SimulateOptions::longest_step`] bounds that.
//!
//! ```
//! use slideway::model::{Model, Settings};
//! use slideway::motion::{End, SimulateOptions, simulate};
//!
//! let crank = Model::parse(slideway::gallery::find("slider-crank").expect("in the gallery").text)?;
//! let history = simulate(&crank, &SimulateOptions::new(0.05))?;
//! assert_eq!(history.end, End::Finished);
//! // The piston reverses at its dead centre.
//! assert!(history.events.iter().any(|event| event.words.contains("piston reverses")));
//! # Ok::<(), slideway::fault::Faults>(())
//! ```
//!
//! # Files
//! `moving/` is what moves: equations, steps, what is watched. `decision/` says how the motion goes on at an
//! event. `record/` is what is remembered, `following/` the loop of phases, events and decisions, `told/`
//! what is told. Each uses only those before it.

pub mod decision;
mod following;
mod moving;
mod options;
mod record;
mod told;

#[cfg(test)]
mod tests;

pub use crate::pattern::phase::{ContactPhase, HingePhase, JointPhase, Phase};
pub use decision::rules::{
    Continuation, Continuations, Decisions, EventInstant, HaltingImpulse, Hold, Outlook, Resting,
};
pub use decision::thorough::Thorough;
pub use following::{simulate, simulate_with};
pub use moving::cause::{Cause, CauseKind};
pub use moving::equations::Drift;
pub use options::{Crossing, EventFunction, ImpactLaw, SimulateOptions, UserEvent};
pub use record::event::{Event, modes_in_words, phase_in_words};
pub use record::history::{
    ContactSample, End, Energy, HingeSample, History, PhaseInterval, Reader, Sample, Statistics,
};
pub use told::report::{
    BranchReport, CauseReport, EndKind, EndReport, EnergyReport, EventReport, Named, PhaseReport, SCHEMA,
    SampledReport, SimulateReport, StatisticsReport, report,
};
pub use told::series::{Column, Series};
pub use told::tree::{Branching, BranchingReport, Tree, TreeReport, simulate_all, tree_report};
