//! Collects what patterns admit: a solution shared by several patterns is recorded once, and every pattern is
//! counted.
//!
//! `collection.rs` collects the findings, `reported.rs` is what is reported of them; `found.rs` is one state while they are
//! being collected. A pattern
//! is recorded as decided by proof (`decided.rs`) or within tolerances: `candidate.rs` solves a regular one,
//! `degenerate.rs` examines a singular one more closely, and `admitted.rs` is what that one admits.

mod admitted;
mod candidate;
mod collection;
mod decided;
mod degenerate;
mod found;
mod reported;

pub(crate) use collection::{Findings, TooManySolutions};
pub(crate) use decided::Filed;
pub(crate) use found::Found;
