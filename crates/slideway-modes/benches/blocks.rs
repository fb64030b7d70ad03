//! Solutions, nodes and times of the search for block problems, with one hinge and more. At most 20 s for each.
//!
//! ```text
//! cargo bench -p slideway-modes --bench blocks
//! ```
#![allow(clippy::print_stdout, reason = "a program that prints a table")]

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use instances::{block_problem_with_eight_solutions, random_block_problem};
use slideway_modes::SearchOptions;
use slideway_modes::blocks::{BlockProblem, search};

mod instances;

const TIME_LIMIT: Duration = Duration::from_secs(20);
/// Random problems of each kind.
const SEEDS: u64 = 8;
/// Contacts, hinges and strength of random problems.
const KINDS: [(usize, usize, f64); 4] = [(3, 4, 0.5), (3, 4, 1.0), (4, 6, 0.7), (4, 6, 1.0)];

fn main() {
    // `cargo test` starts benchmarks, too, without `--bench`.
    let few = !std::env::args().any(|argument| argument == "--bench");
    println!("| instance | solutions | nodes | time (ms) | |");
    println!("|---|---:|---:|---:|---|");
    println!("{}", line("eight solutions", &block_problem_with_eight_solutions()));
    for (contacts, hinges, strength) in KINDS.into_iter().take(if few { 1 } else { KINDS.len() }) {
        for seed in 1..=if few { 1 } else { SEEDS } {
            let name = format!("random {hinges} + {contacts}, strength {strength}, {seed}");
            println!("{}", line(&name, &random_block_problem(contacts, hinges, strength, seed)));
        }
    }
}

/// One line of the table.
fn line(name: &str, problem: &BlockProblem) -> String {
    let start = Instant::now();
    let result = search(problem, &SearchOptions::default(), &mut |_| {
        if start.elapsed() < TIME_LIMIT { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let milliseconds = 1e3 * start.elapsed().as_secs_f64();
    let unique = if result.unique_for_every_load.is_some() { ", for every load" } else { "" };
    let (solutions, nodes, complete) = (result.solutions.len(), result.nodes, result.complete);
    format!("| {name} | {solutions} | {nodes} | {milliseconds:.2} | {complete:?}{unique} |")
}
