//! What is remembered of a motion: its events in words, its phases, its steps and its energies.

pub(in crate::motion) mod event;
pub(in crate::motion) mod history;
