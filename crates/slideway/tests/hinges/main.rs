//! Hinges with friction, from the model file to the report.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

mod break_away;
mod cases;
mod closed_forms;
mod dead_centre;
mod from_rest;
mod gallery;
mod gaps;
mod limits;
mod margins;
mod motion;
mod random_linkages;
mod reading;
mod reference;
mod shared_loads;
mod standstill;
mod tables;
mod turning;
mod uncertainty;
mod unrelated;
mod unrelated_questions;
