//! All solutions of planar mechanisms with dry friction in sliding joints.
//!
//! In a mechanism with dry friction in its sliding joints the equations of motion can have no solution (it
//! jams), one, or several. This library finds all of them: the side on which each slider touches its guide,
//! its contact mode, is tried for every sign pattern, and each leaves a linear system (H. J. Klepp, Modes of
//! contact and uniqueness of solutions for systems with friction-affected sliders, Journal of Sound and
//! Vibration 254, 2002).
//!
//! ```
//! use slideway::{Drawing, GROUND, solve};
//!
//! let mut d = Drawing::new();
//! let drawer = d.body("drawer").mass(2.0).centre([0.0, 0.1]).inertia(0.05).id();
//! let rail = d.block_slider("rail", drawer, GROUND).at([0.0, 0.0]).length(0.4).mu(0.3).id();
//! d.force("push", drawer).at([-0.2, 0.15]).components([20.0, 0.0]);
//! d.slide("x", rail).rate(1.0);
//! let answer = solve(&d.build()?)?;
//! for solution in &answer.solutions {
//!     println!("{} N", solution.contact(rail.front()).normal_force);
//! }
//! # Ok::<(), slideway::Faults>(())
//! ```
//!
//! A mechanism comes from code ([`drawing`]) or from a model file ([`Model::parse`]); [`Settings`] change its
//! numbers. [`import`] makes a model to complete from a DXF drawing.
//!
//! [`solve::solve`] does everything; the data flows through the modules in this order, each arrow one pure
//! function:
//!
//! ```text
//! model file -> Model -> Mechanism -> Configuration -> KineticEquations -> Influence -> ModeProblem -> Solutions -> SolveReport
//! ```
//!
//! [`check::check`] stands beside it and says what a model consists of and what would keep it from being
//! solved; [`warning::warnings`] says what is perhaps not meant.
//!
//! [`standstill::hold`] tells whether a mechanism stays at rest, under which loads, and how it begins to
//! move.
//!
//! [`limits::limits`] finds the values of a parameter at which modes begin and end, [`size::size`] those at
//! which a wanted margin against locking is just met, and [`drive::drive`] the efforts that drives need
//! against friction.
//!
//! [`motion::simulate`] follows a mechanism in time.
//!
//! [`sweep::Sweep`] and [`map::map`] have the solutions over many points.
//!
//! Every question has options with a constructor and setters, and its answer is a [`Report`]: plain data,
//! shown as text, in the [`units`] of the model, and as JSON, in SI units.
//!
//! Long computations report their [`progress`] through a callback and can be cancelled.
//!
//! If you have matrices instead of a mechanism (an absolute value equation, a linear complementarity
//! problem), use [`modes`], or [`raw_problem`] for a file of them.

#![forbid(unsafe_code)]

pub mod attainability;
pub mod check;
pub mod choice;
pub mod configuration;
pub mod drawing;
pub mod drive;
pub mod enclosure;
pub mod expression;
pub mod fault;
pub mod gallery;
pub mod ids;
pub mod import;
pub mod influence;
pub mod kinetics;
mod law;
pub mod limits;
pub mod map;
pub mod mechanism;
pub mod model;
pub mod motion;
mod one_face;
mod pattern;
mod problem;
pub mod raw_problem;
pub mod report;
pub mod sharing;
pub mod size;
pub mod solve;
pub mod standstill;
pub mod sweep;
pub mod template;
pub mod units;
pub mod warning;

pub use check::check;
pub use drawing::{Drawing, GROUND};
pub use drive::{DriveOptions, drive};
pub use fault::Faults;
pub use limits::{LimitsOptions, Vary, limits};
pub use map::{MapOptions, map};
pub use model::{Model, Settings, Value};
pub use motion::{SimulateOptions, simulate};
pub use nalgebra;
pub use report::{Report, SolveReport};
pub use size::{SizeOptions, size};
pub use solve::{SolveOptions, solve};
pub use standstill::{HoldOptions, hold};
pub use sweep::{Sweep, SweepOptions};
pub use units::UnitSystem;

pub use slideway_modes as modes;
pub(crate) use slideway_modes::dense;
pub use slideway_modes::{interval, printable, progress, scan};

/// The examples of the README run.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

/// The examples of the book run.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/src/library.md")]
struct BookOfTheLibrary;

/// Those of its page on matrices.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/src/raw-problems.md")]
struct BookOfRawProblems;
