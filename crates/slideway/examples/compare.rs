//! Times the searches of this library on files of problems, for `reference/comparison/compare.py`.
//!
//! ```text
//! compare solve [--time-limit SECONDS] [--listed MOST] FILE...
//! compare boom STAGES [PARAMETER=VALUE]...
//! compare example
//! ```
//!
//! `solve` reads problems as `slideway modes` does and prints one line of JSON for each, with the time of
//! `modes::search`. Reading is not timed. `boom` prints the mode problem of the gallery's telescopic boom.
#![allow(clippy::print_stdout, reason = "a program that prints its results")]

use std::error::Error;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use nalgebra::{DMatrix, DVector};
use serde_json::{Value, json};
use slideway::configuration::Configuration;
use slideway::gallery;
use slideway::ids::ContactId;
use slideway::influence::Influence;
use slideway::kinetics::KineticEquations;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::modes::certificate::{Propagation, propagate};
use slideway::modes::{Completeness, ModeProblem, SearchOptions, SearchResult, Side, StateKind, search};
use slideway::raw_problem::RawProblem;
use slideway::solve::mode_problem;

/// Runs shorter than this are repeated.
const SHORT: Duration = Duration::from_millis(200);
/// A run is repeated at most so often; the median is told.
const RUNS: usize = 9;
/// Bounds of all solutions are computed for up to so many unknowns.
const BOUNDED: usize = 400;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    match arguments.next().as_deref() {
        Some("solve") => solve(arguments),
        Some("boom") => boom(arguments),
        // What a run of all examples tries.
        None | Some("example") => example(),
        Some(other) => Err(format!("unknown command `{other}`: it is `solve` or `boom`").into()),
    }
}

/// What to do with every file.
struct Options {
    time_limit: Duration,
    listed: usize,
}

fn solve(mut arguments: impl Iterator<Item = String>) -> Result<(), Box<dyn Error>> {
    let mut options = Options { time_limit: Duration::from_mins(1), listed: 10_000 };
    let mut files = Vec::new();
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or_else(|| format!("`{argument}` needs a value"));
        match argument.as_str() {
            "--time-limit" => options.time_limit = Duration::try_from_secs_f64(value()?.parse()?)?,
            "--listed" => options.listed = value()?.parse()?,
            _ => files.push(argument),
        }
    }
    for file in files {
        let raw = RawProblem::from_bytes(&std::fs::read(&file)?)?;
        println!("{}", timed(&raw.mode_problem()?, &options));
    }
    Ok(())
}

/// Times of one problem, and its solutions.
fn timed(problem: &ModeProblem, options: &Options) -> Value {
    let contacts = problem.contacts();
    let (seconds, result) = median(|| limited(problem, options.time_limit));
    let counts = result.counts();
    let list = |state: &slideway::modes::CombinedState<'_>| {
        state.normal_force(contacts).map(|force| force.as_slice().to_vec())
    };
    let solutions: Vec<_> = result
        .product
        .states()
        .filter(|state| state.kind() == StateKind::Solution)
        .filter_map(|state| list(&state))
        .take(options.listed)
        .collect();
    let cells: Vec<_> = result
        .product
        .states()
        .filter(slideway::modes::CombinedState::is_maximal)
        .map(|state| signs(&state, contacts))
        .take(options.listed)
        .collect();
    json!({
        "unknowns": contacts,
        "search": {
            "seconds": seconds,
            "complete": matches!(result.completeness, Completeness::Proven | Completeness::NotProven),
            "proven": result.completeness == Completeness::Proven,
            "outcome": result.completeness.to_string(),
            "count": counts.solutions.to_string(),
            "gap_states": counts.gap_states.to_string(),
            "singular": counts.singular.to_string(),
            "nodes": result.nodes(),
            "strategy": result.strategy(),
            "solutions": solutions,
            "cells": cells,
        },
        "bounds": bounds(problem),
    })
}

/// The signs of the unknowns in a set of solutions: `+` or `-` where they are nonzero somewhere in it.
fn signs(state: &slideway::modes::CombinedState<'_>, contacts: usize) -> String {
    let sign = |positive: [bool; 4]| match positive {
        [true, ..] => '+',
        [_, true, ..] => '-',
        _ => '0',
    };
    state.positive_unknowns(contacts).into_iter().map(sign).collect()
}

/// A search that ends at the time limit.
fn limited(problem: &ModeProblem, time_limit: Duration) -> SearchResult {
    let start = Instant::now();
    let options = SearchOptions { nodes: u64::MAX, ..SearchOptions::default() };
    search(problem, &options, &mut |_| {
        if start.elapsed() < time_limit { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    })
}

/// The median time of some runs in seconds, and the last result.
fn median<T>(mut run: impl FnMut() -> T) -> (f64, T) {
    let mut times = Vec::new();
    let mut total = Duration::ZERO;
    loop {
        let start = Instant::now();
        let result = run();
        let time = start.elapsed();
        total += time;
        times.push(time);
        if times.len() == RUNS || total > SHORT {
            times.sort_unstable();
            return (times[times.len() / 2].as_secs_f64(), result);
        }
    }
}

/// A bound of the size of every unknown in all solutions, if interval propagation finds one.
fn bounds(problem: &ModeProblem) -> Option<Vec<f64>> {
    if problem.contacts() > BOUNDED {
        return None;
    }
    match propagate(problem, &vec![None; problem.contacts()]) {
        Propagation::Bounds(bounds) => Some(bounds.iter().map(|bound| bound.magnitude()).collect()),
        Propagation::Empty | Propagation::Unknown => None,
    }
}

fn boom(mut arguments: impl Iterator<Item = String>) -> Result<(), Box<dyn Error>> {
    let stages = arguments.next().ok_or("`boom` needs a number of stages")?.parse()?;
    let mut settings = Settings::default();
    for argument in arguments {
        let (name, value) = argument.split_once('=').ok_or("a parameter is set by NAME=VALUE")?;
        settings = settings.parameter(name, value);
    }
    let text = gallery::telescopic_boom(stages).ok_or("no such number of stages")?;
    println!("{}", raw_modes(&mode_problem_of(&Model::parse(&text)?.with(&settings)?)?));
    Ok(())
}

/// The mode problem of a model in its state, which must not be at rest.
fn mode_problem_of(model: &Model) -> Result<ModeProblem, Box<dyn Error>> {
    let mechanism = Mechanism::new(model)?;
    let configuration = Configuration::new(&mechanism)?;
    let equations = KineticEquations::new(&mechanism, &configuration)?;
    let influence = Influence::new(&equations);
    let signs = DVector::from_fn(mechanism.contacts.len(), |at, _| {
        configuration.contact(&mechanism, ContactId(at)).sliding_velocity.signum()
    });
    Ok(mode_problem(&mechanism, &influence, &signs)?)
}

/// The problem as `slideway modes` reads it.
fn raw_modes(problem: &ModeProblem) -> Value {
    let rows = |matrix: &DMatrix<f64>| -> Vec<Vec<f64>> {
        matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
    };
    json!({
        "type": "modes",
        "columns_positive": rows(problem.columns(Side::Positive)),
        "columns_negative": rows(problem.columns(Side::Negative)),
        "jumps_positive": rows(problem.jumps(Side::Positive)),
        "jumps_negative": rows(problem.jumps(Side::Negative)),
        "right_hand_side": problem.right_hand_side().as_slice(),
    })
}

fn example() -> Result<(), Box<dyn Error>> {
    let problem = RawProblem::from_json(br#"{"type": "lcp", "M": [[1, 2], [2, 1]], "q": [-1, -1]}"#)?;
    let options = Options { time_limit: Duration::from_secs(1), listed: 10 };
    println!("{}", timed(&problem.mode_problem()?, &options));
    Ok(())
}
