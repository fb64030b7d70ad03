//! What moves: the equations within a phase, one step of them, and what may end the phase.
//!
//! # Files
//! `equations/` are the equations within a phase, `linear.rs` factors them, `stepper.rs` takes a step;
//! `watch.rs` is what can end a phase, `root.rs` where it does and where it might between samples, `cause.rs`
//! its name, `magnitudes.rs` beside what it counts. Of loads and drives `switching.rs` has the pieces of formulas that jump, `resolution.rs` says
//! whether a step sees what they do, `amounts.rs` has them as functions of time at rest. `energy.rs` has the
//! powers whose integrals the balance needs, `connected.rs` which bodies joints connect.

pub(in crate::motion) mod amounts;
pub(in crate::motion) mod cause;
pub(in crate::motion) mod connected;
pub(in crate::motion) mod energy;
pub(in crate::motion) mod equations;
pub(in crate::motion) mod linear;
pub(in crate::motion) mod magnitudes;
pub(in crate::motion) mod resolution;
pub(in crate::motion) mod root;
pub(in crate::motion) mod stepper;
pub(in crate::motion) mod switching;
pub(in crate::motion) mod watch;
