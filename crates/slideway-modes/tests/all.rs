//! The tests of the library from outside.
//!
//! One program, so that the library is linked once for all of them. A file of this folder is a module here, a
//! folder with a `main.rs` is a program of its own; `architecture.rs` sees to it that none is forgotten.

mod existence;
mod fuzz_findings;
mod games;
#[path = "../benches/instances/mod.rs"]
mod instances;
mod interval_functions;
mod klepp_example;
mod large_cells;
mod mixed_continua;
mod mixed_problems;
mod modes;
mod modes_degenerate;
mod modes_klepp_2002;
mod modes_uniqueness;
mod proofs;
mod search;
mod search_extremes;
mod search_groups;
mod search_low_rank;
mod search_monotone;
mod search_oracle;
mod search_proofs;
mod search_rules;
mod search_support;
mod search_within_bounds;
mod streams;
mod versoft;
