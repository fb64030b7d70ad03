//! What patterns admit, gathered: solutions that several patterns share are one, and every pattern is
//! counted.
//!
//! `collection.rs` gathers, `found.rs` is one state on the way; a pattern is filed as it is decided by proof
//! (`decided.rs`), or within tolerances: `candidate.rs` solves a regular one, `degenerate.rs` looks closer at
//! a singular one, and `admitted.rs` is what that admits.

mod admitted;
mod candidate;
mod collection;
mod decided;
mod degenerate;
mod found;

pub(crate) use collection::{Findings, TooManySolutions};
pub(crate) use decided::Filed;
