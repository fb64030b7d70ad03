//! Motion in time, with the contact mode as part of the state (theory, section 8).
//!
//! Between events every sliding joint and contact keeps what it does, its [`Phase`], and the motion is smooth.

pub mod decision;
mod phase;

pub use phase::{ContactPhase, JointPhase, Phase};
