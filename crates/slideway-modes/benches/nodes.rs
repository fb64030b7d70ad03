//! Nodes, cells and times of the search on problems with continua, monotone problems, chained groups and random
//! ones. One thread, at most 20 s for each.
//!
//! ```text
//! cargo bench -p slideway-modes --bench nodes             all
//! cargo bench -p slideway-modes --bench nodes -- pile     those whose name contains a word
//! cargo bench -p slideway-modes --bench nodes -- --two    with two threads
//! cargo bench -p slideway-modes --bench nodes -- --prove  with proof files: their sizes and times
//! NODES_PROOFS=folder cargo bench ... -- --prove          which are written there, with the problems
//! ```
#![allow(clippy::print_stdout, reason = "a program that prints a table")]

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use instances::structured::{
    clamped_without_friction, game_with_two_costs, market, mixed, one_cell_of_low_rank, ones, pile,
    pushed_without_friction, subset_sum, weights_with_subset, without_free,
};
use instances::{chained_blocks, low_rank, planted_blocks, planted_complementarity, random_with_jumps};
use slideway_modes::raw_problem::exact_json;
use slideway_modes::{CombinedState, ModeProblem, SearchOptions, prove, search};

mod instances;

const TIME_LIMIT: Duration = Duration::from_secs(20);

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    // `cargo test` starts benchmarks, too, without `--bench`.
    let few = !std::env::args().any(|argument| argument == "--bench");
    let given = |option: &str| std::env::args().any(|argument| argument == option);
    let options = SearchOptions { threads: 1 + usize::from(given("--two")), ..SearchOptions::default() };
    println!("| instance | solutions | sets | maximal | nodes | time (ms) | |");
    println!("|---|---:|---:|---:|---:|---:|---|");
    for (name, make) in table().into_iter().take(if few { 1 } else { usize::MAX }) {
        if words.is_empty() || words.iter().any(|word| name.contains(word.as_str())) {
            println!("{}", line(name, &make(), &options));
            if given("--prove") {
                println!("{}", proof_line(name, &make()));
            }
        }
    }
}

type Make = fn() -> ModeProblem;

/// The instances by name.
fn table() -> Vec<(&'static str, Make)> {
    vec![
        ("ones 12, q = 0", || ones(12, 0.0)),
        ("ones 40, q = 0", || ones(40, 0.0)),
        ("ones 12, q = -1", || ones(12, -1.0)),
        ("ones 20, q = -1", || ones(20, -1.0)),
        ("pile 1", || pile(1)),
        ("pile 2", || pile(2)),
        ("pile 3", || pile(3)),
        ("rank 9 of 18", || one_cell_of_low_rank(18, 9, 1)),
        ("clamped 12 of 6", || clamped_without_friction(12, 6, 1)),
        ("pushed 40 of 20", || pushed_without_friction(40, 20, 1)),
        ("market 20", || market(20, 1)),
        ("market 40", || market(40, 1)),
        ("market 60", || market(60, 1)),
        ("game 6 x 6", || game_with_two_costs(6, 1)),
        ("game 9 x 9", || game_with_two_costs(9, 1)),
        ("subset 14", || subset(14)),
        ("subset 18", || subset(18)),
        ("subset 20", || subset(20)),
        ("chained 60, strength 1", || chained_blocks(60, 1.0)),
        ("chained 60, strength 1.5", || chained_blocks(60, 1.5)),
        ("planted 24", || planted_complementarity(24, 1)),
        ("planted 36", || planted_complementarity(36, 1)),
        ("jumps 10", || random_with_jumps(10, 1)),
        ("jumps 14", || random_with_jumps(14, 1)),
        ("ave 1 28", || planted_blocks(28, 28, 1.0, 1)),
        ("ave 1 36", || planted_blocks(36, 36, 1.0, 1)),
        ("free 20, pairs 12", || mixed(20, 12, 1)),
        ("free 60, pairs 12", || mixed(60, 12, 1)),
        ("free 60, pairs 12, without", || without_free(60, 12, 1)),
        ("low rank 1 of 60", || low_rank(60, 1)),
        ("low rank 2 of 16", || low_rank(16, 2)),
        ("low rank 2 of 20", || low_rank(20, 2)),
        ("low rank 2 of 24", || low_rank(24, 2)),
        ("low rank 2 of 40", || low_rank(40, 2)),
        ("ave 1 56", || planted_blocks(56, 56, 1.0, 1)),
    ]
}

/// `subset_sum` with weights up to 10^5 + 1.
fn subset(items: usize) -> ModeProblem {
    let (weights, target) = weights_with_subset(items, 50_000, 1);
    subset_sum(&weights, target)
}

/// One line of the table.
fn line(name: &str, problem: &ModeProblem, options: &SearchOptions) -> String {
    let start = Instant::now();
    let result = search(problem, options, &mut |_| {
        if start.elapsed() < TIME_LIMIT { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let milliseconds = 1e3 * start.elapsed().as_secs_f64();
    let counts = result.counts();
    let maximal = result.product.states().filter(CombinedState::is_maximal).take(10_000).count();
    let (solutions, sets, nodes) = (counts.solutions, counts.singular, result.nodes());
    format!(
        "| {name} | {solutions} | {sets} | {maximal} | {nodes} | {milliseconds:.1} | {} |",
        result.completeness
    )
}

/// A further line on the proof file: its cells, nodes and time, and its size.
fn proof_line(name: &str, problem: &ModeProblem) -> String {
    let start = Instant::now();
    let proof = prove(problem, &SearchOptions::default(), &mut |_| {
        if start.elapsed() < TIME_LIMIT { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let milliseconds = 1e3 * start.elapsed().as_secs_f64();
    match proof {
        Ok(proof) => {
            let size = proof.text.len() as f64 / 1e3;
            if let (Ok(folder), Some(numbers)) = (std::env::var("NODES_PROOFS"), exact_json(problem)) {
                let file = |ending: &str| format!("{folder}/{}.{ending}", name.replace(' ', "_"));
                std::fs::write(file("json"), numbers).expect("the folder is there");
                std::fs::write(file("txt"), &proof.text).expect("the folder is there");
            }
            format!(
                "| proof file | | | {:?} | {} | {milliseconds:.1} | {size:.1} kB |",
                proof.cells, proof.nodes
            )
        }
        Err(fault) => format!("| proof file | | | | | {milliseconds:.1} | {fault} |"),
    }
}
