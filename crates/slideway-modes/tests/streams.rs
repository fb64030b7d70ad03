//! Solutions told as they are found: each line is one, and the lines that are not part of others are the list.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use slideway_modes::raw_problem::{RawConclusion, RawLine, RawProblem, solve, solve_streaming};
use slideway_modes::{Arguments, Proof, SearchOptions, Status};

/// More than any list of these tests.
const MOST: usize = 1000;

fn streamed(problem: &RawProblem, options: &SearchOptions) -> (Vec<RawLine>, RawConclusion) {
    let mut lines = Vec::new();
    let conclusion =
        solve_streaming(problem, options, MOST, &mut |_| ControlFlow::Continue(()), &mut |line| {
            lines.push(line.clone());
            ControlFlow::Continue(())
        });
    let conclusion = conclusion.expect("finite");
    assert_eq!(lines.len() as u64, conclusion.lines);
    (lines, conclusion)
}

/// What tells states apart, however their values are rounded.
fn key(line: &RawLine) -> String {
    match line {
        RawLine::Solution(solution) => format!("solution {:?}", solution.signs),
        RawLine::GapState(state) => format!("gap {:?} {:?}", state.signs, state.gaps),
        RawLine::Continuum(continuum) => format!("continuum {continuum:?}"),
        _ => panic!("not the last line"),
    }
}

/// The lines that are not part of others.
fn maximal(lines: &[RawLine], conclusion: &RawConclusion) -> Vec<String> {
    let is_maximal = |at: &usize| !conclusion.part_of_others.contains(&(*at as u64 + 1));
    let mut keys: Vec<String> = (0..lines.len()).filter(is_maximal).map(|at| key(&lines[at])).collect();
    keys.sort();
    keys
}

fn listed(problem: &RawProblem, options: &SearchOptions) -> Vec<String> {
    let report = solve(problem, options, MOST, &mut |_| ControlFlow::Continue(())).expect("finite");
    let lines = report.solutions.into_iter().map(RawLine::Solution);
    let lines = lines.chain(report.gap_states.into_iter().map(RawLine::GapState));
    let lines = lines.chain(report.continua.into_iter().map(RawLine::Continuum));
    let mut keys: Vec<String> = lines.map(|line| key(&line)).collect();
    keys.sort();
    keys
}

/// Whole numbers from -1 to 1: solutions are degenerate or form continua, which are found in pieces.
fn degenerate() -> impl Strategy<Value = RawProblem> {
    (2_usize..=6).prop_flat_map(|n| {
        let entries = |count: usize| prop::collection::vec(-1_i8..=1, count);
        (entries(n * n), entries(n)).prop_map(move |(m, q)| RawProblem::LinearComplementarity {
            m: DMatrix::from_iterator(n, n, m.into_iter().map(f64::from)),
            q: DVector::from_iterator(n, q.into_iter().map(f64::from)),
        })
    })
}

/// Random entries from -1 to 1 and a planted solution: one tree with some thousand nodes, so that it is divided.
fn large() -> RawProblem {
    let n = 30;
    let mut state = 7_u64;
    let mut number = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let m = DMatrix::from_fn(n, n, |_, _| number());
    let planted = DVector::from_fn(n, |_, _| number());
    let q = planted.map(|value| (-value).max(0.0)) - &m * planted.map(|value| value.max(0.0));
    RawProblem::LinearComplementarity { m, q }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn lines_that_are_not_part_of_others_are_the_list(problem in degenerate(), every_pattern in any::<bool>()) {
        let arguments = Arguments { every_pattern, ..Arguments::default() };
        let options = SearchOptions { arguments, ..SearchOptions::default() };
        let (lines, conclusion) = streamed(&problem, &options);
        prop_assert!(conclusion.all_written);
        prop_assert_eq!(conclusion.report.complete, Proof::Proven);
        prop_assert_eq!(maximal(&lines, &conclusion), listed(&problem, &options));
        let all: BTreeSet<String> = lines.iter().map(key).collect();
        prop_assert_eq!(all.len(), lines.len(), "a line twice");
    }
}

/// The order does not depend on the number of threads, and what a limit of nodes leaves is a beginning.
#[test]
fn lines_come_early_and_in_the_same_order_with_any_number_of_threads() {
    let (problem, options) = (large(), SearchOptions::default());
    let nodes = AtomicU64::new(0);
    let mut early = Vec::new();
    let conclusion = solve_streaming(
        &problem,
        &options,
        MOST,
        &mut |progress| {
            nodes.fetch_max(progress.done, Ordering::Relaxed);
            ControlFlow::Continue(())
        },
        &mut |line| {
            early.push((nodes.load(Ordering::Relaxed), line.clone()));
            ControlFlow::Continue(())
        },
    )
    .expect("finite");
    assert!(conclusion.report.nodes > 2000, "{} nodes", conclusion.report.nodes);
    assert!(early.len() > 1 && early[0].0 < conclusion.report.nodes / 2, "{early:?}");
    let lines: Vec<RawLine> = early.into_iter().map(|(_, line)| line).collect();
    assert_eq!(streamed(&problem, &SearchOptions { threads: 3, ..options }).0, lines);
    assert_eq!(maximal(&lines, &conclusion), listed(&problem, &options));
    let (some, partial) =
        streamed(&problem, &SearchOptions { nodes: conclusion.report.nodes / 2, ..options });
    assert!(partial.report.partial && some.len() <= lines.len());
    let all: BTreeSet<String> = lines.iter().map(key).collect();
    assert!(some.iter().all(|line| all.contains(&key(line))));
}

/// `w_k = 1 - z_k` for each of 100 unknowns: the combinations of 100 groups are written one by one, not held.
#[test]
fn combinations_of_groups_are_written_until_the_reader_has_enough() {
    let problem = RawProblem::LinearComplementarity {
        m: -DMatrix::identity(100, 100),
        q: DVector::from_element(100, 1.0),
    };
    let (options, mut lines) = (SearchOptions::default(), 0_u64);
    let conclusion =
        solve_streaming(&problem, &options, MOST, &mut |_| ControlFlow::Continue(()), &mut |_| {
            lines += 1;
            if lines < 10 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
    let conclusion = conclusion.expect("finite");
    assert_eq!((lines, conclusion.lines, conclusion.all_written), (10, 10, false));
    assert_eq!(conclusion.report.count, "1267650600228229401496703205376");
    assert_eq!((conclusion.report.complete, conclusion.report.status), (Proof::Proven, Status::Several));
    // Once time is up, so many more.
    let mut lines = 0;
    let ended = solve_streaming(&problem, &options, 7, &mut |_| ControlFlow::Break(()), &mut |_| {
        lines += 1;
        ControlFlow::Continue(())
    });
    let ended = ended.expect("finite");
    assert!(ended.report.partial && lines <= 7, "{lines} lines");
}
