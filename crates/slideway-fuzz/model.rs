//! Any text as a model file: no panic, and what is accepted is solved within limits or refused with faults.

use slideway::Report;
use slideway::check;
use slideway::model::Model;
use slideway::modes::{Limits, SearchOptions};
use slideway::report::Style;
use slideway::solve::{SolveOptions, solve_with};
use std::ops::ControlFlow;

/// A search with many contacts ends early instead of taking long.
fn options() -> SolveOptions {
    let limits = Limits { solutions: 100, singular: 20, bases: 1000, ..Limits::default() };
    let search = SearchOptions { nodes: 200, limits, ..SearchOptions::default() };
    SolveOptions::default().search(search).most(10).margins(false)
}

/// Checks any text as a model file.
pub fn model(text: &str) {
    let model = match Model::parse(text) {
        Ok(model) => model,
        Err(faults) => {
            assert!(!faults.to_string().is_empty());
            return;
        }
    };
    let _ = check::check(&model);
    if let Ok(answer) = solve_with(&model, &options(), &mut |_| ControlFlow::Continue(())) {
        // JSON refuses numbers that are not finite by itself.
        let _ = (answer.text(Style::default()), answer.csv(), answer.json());
    }
}
