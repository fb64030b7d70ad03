//! The answer to a raw problem within small limits.

use std::ops::ControlFlow;

use slideway::Report;
use slideway::modes::{Limits, SearchOptions};
use slideway::raw_problem::{RawProblem, solve, to_npz};
use slideway::report::Style;

/// Solves the problem and writes the answer in all forms.
pub(crate) fn answer(problem: &RawProblem) {
    let limits = Limits { solutions: 100, singular: 20, bases: 1000, ..Limits::default() };
    let options = SearchOptions { nodes: 200, limits, ..SearchOptions::default() };
    let Ok(report) = solve(problem, &options, 10, &mut |_| ControlFlow::Continue(())) else { return };
    // JSON refuses numbers that are not finite by itself; `null` stands for what is told in `beyond_range`.
    let _ = (report.json(), report.text(Style::default()), to_npz(&report));
}
