//! The tests of the library from outside, but for those that have a folder.
//!
//! One program, so that the library is linked once for all of them. A file of this folder is a module here, a
//! folder with a `main.rs` is a program of its own; `architecture.rs` sees to it that none is forgotten.

mod answers;
mod answers_solve;
mod architecture;
mod book;
mod drawing;
mod exact_arithmetic;
mod expression;
mod expression_properties;
mod extremes;
mod first_lines;
mod import;
mod limits_curves;
mod map;
mod motion_fast_loads;
mod motion_gaps;
mod motion_impacts;
mod motion_lifting;
mod motion_outcomes;
mod motion_play;
mod motion_reference;
mod motion_rolling;
mod motion_zero_force;
mod motions;
mod mutations;
mod ranges;
mod raw_extremes;
mod raw_problem;
mod settings;
mod sweep;
mod templates;
mod tipping;
mod tutorial;
mod units;
mod warnings;
