//! Proof files, checked by the plain Python program of `reference/`.

use std::io::Write as _;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use nalgebra::{DMatrix, DVector};
use slideway_modes::raw_problem::RawProblem;
use slideway_modes::{CombinedState, ModeProblem, NoProof, SearchOptions, Side, prove};

use super::instances;
use super::instances::structured::{game_with_two_costs, ones, pile};
use super::search_support::{Random, low_rank, run};

const CHECKER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../reference/check_proof.py");

/// A problem as a file of type `modes`. The columns of an absolute value equation may be sums that are not
/// numbers of a file.
fn json(problem: &ModeProblem) -> String {
    let rows = |matrix: &DMatrix<f64>| -> Vec<Vec<f64>> {
        matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
    };
    let [positive, negative] = Side::BOTH.map(|side| rows(problem.columns(side)));
    let [up, down] = Side::BOTH.map(|side| rows(problem.jumps(side)));
    format!(
        r#"{{"type": "modes", "columns_positive": {positive:?}, "columns_negative": {negative:?},
            "jumps_positive": {up:?}, "jumps_negative": {down:?}, "right_hand_side": {:?}}}"#,
        problem.right_hand_side().as_slice()
    )
}

/// What the checker says of a proof, and whether it accepts it.
fn checked(problem: &Path, proof: &str) -> (bool, String) {
    let mut checker = Command::new("python3")
        .args([Path::new(CHECKER), problem, Path::new("-")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("python3 runs");
    checker.stdin.take().expect("a pipe").write_all(proof.as_bytes()).expect("the checker reads");
    let output = checker.wait_with_output().expect("the checker ends");
    let said = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&said).into_owned())
}

/// Proves a problem, has the proof checked, and returns the lines of the proof.
fn proven(problem: &ModeProblem, name: &str) -> String {
    let proof = prove(problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
    let proof = proof.unwrap_or_else(|fault| panic!("{name}: {fault}\n{problem:?}"));
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.json"));
    std::fs::write(&path, json(problem)).expect("the folder of tests is writable");
    let (accepted, said) = checked(&path, &proof.text);
    assert!(accepted, "{name}: {said}\n{}\n{}", proof.text, json(problem));
    assert!(!said.contains("part of others") && !said.contains("or less"), "{said}\n{}", proof.text);
    proof.text
}

fn integers(random: &mut Random, size: usize, most: usize) -> DMatrix<f64> {
    DMatrix::from_fn(size, size, |_, _| random.integer(most))
}

#[test]
fn the_checker_accepts_proofs_of_degenerate_problems() {
    for seed in 0..30 {
        let mut random = Random::new(seed);
        let size = 1 + random.below(4);
        let m = integers(&mut random, size, 1);
        let q = DVector::from_fn(size, |_, _| random.integer(1));
        let problem = ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit");
        proven(&problem, "degenerate");
    }
}

#[test]
fn the_checker_accepts_proofs_with_jumps() {
    for seed in 0..30 {
        let mut random = Random::new(100 + seed);
        let size = 1 + random.below(3);
        let whole = seed % 2 == 0;
        let mut matrix = || if whole { integers(&mut random, size, 2) } else { random.matrix(size, size) };
        let (positive, negative, up, down) = (matrix(), matrix(), matrix(), matrix());
        let load = DVector::from_fn(size, |_, _| random.integer(2));
        let problem = ModeProblem::new(positive, negative, up, down, load).expect("shapes fit");
        proven(&problem, "jumps");
    }
}

#[test]
fn the_checker_accepts_proofs_of_random_problems_and_of_their_parts() {
    for (seed, size) in [(1, 8), (2, 12), (3, 16)] {
        let mut random = Random::new(seed);
        let m = random.matrix(size, size);
        let problem = ModeProblem::from_linear_complementarity(&m, random.vector(size)).expect("shapes fit");
        proven(&problem, "random");
        // Two groups, one of which acts on the other, and two that do not depend on each other.
        for acts in [true, false] {
            let half = size / 2;
            let apart = |row: usize, column: usize| row / half != column / half;
            let m = DMatrix::from_fn(size, size, |row, column| match apart(row, column) {
                true if acts && row < half => m[(row, column)],
                true => 0.0,
                false => m[(row, column)],
            });
            let problem =
                ModeProblem::from_linear_complementarity(&m, random.vector(size)).expect("shapes fit");
            let text = proven(&problem, "parts");
            assert!(text.contains("\np "), "{text}");
        }
    }
}

/// The parts of the space of the coupling's quantities: near, far, and where no contact has its share.
#[test]
fn coupling_of_low_rank_takes_few_nodes() {
    let small = |seed, contacts, rank| low_rank(&mut Random::new(seed), contacts, rank, 1.0);
    let problems = [(small(4, 14, 2), 2), (small(5, 13, 1), 1), (instances::low_rank(20, 2), 2)];
    for (problem, rank) in problems {
        let contacts = problem.contacts();
        let text = proven(&problem, &format!("low_rank_{contacts}"));
        let declares = |line: &&str| line.starts_with("cell") || line.starts_with('g');
        let steps = text.lines().filter(|line| !declares(line)).count();
        // Nothing like the 2^contacts patterns: a contact's share takes five steps, a cell of the arrangement a few.
        let cells: usize = (0..=rank).map(|chosen| binomial(contacts, chosen)).sum();
        assert!(steps < 6 * contacts + 10 * cells, "{contacts}: {steps} steps, {cells} cells");
    }
}

fn binomial(of: usize, chosen: usize) -> usize {
    (0..chosen).fold(1, |product, at| product * (of - at) / (at + 1))
}

#[test]
fn a_cell_of_many_dimensions_and_a_point_of_many_patterns_take_few_lines() {
    for (size, load) in [(12, -1.0), (12, 0.0)] {
        let m = DMatrix::from_element(size, size, 1.0);
        let problem = ModeProblem::from_linear_complementarity(&m, DVector::from_element(size, load));
        let text = proven(&problem.expect("shapes fit"), "ones");
        assert!(text.lines().count() < 5 * size, "{text}");
    }
}

#[test]
fn the_listed_cells_are_the_largest_ones() {
    let market = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
    let market = ModeProblem::from_linear_complementarity(&market, DVector::zeros(2));
    let problems = [pile(1), pile(2), game_with_two_costs(5, 1), ones(6, 0.0), market.expect("shapes fit")];
    for problem in problems {
        let text = proven(&problem, "largest");
        let listed = text.lines().filter(|line| line.starts_with("cell")).count();
        let result = run(&problem, &SearchOptions::default());
        assert_eq!(listed, result.product.states().filter(CombinedState::is_maximal).count(), "{text}");
    }
}

#[test]
fn another_problem_is_not_proven() {
    let m = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 1.0]);
    let problem = |q: f64| {
        ModeProblem::from_linear_complementarity(&m, DVector::from_element(2, q)).expect("shapes fit")
    };
    let text = proven(&problem(-1.0), "species");
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("other_species.json");
    std::fs::write(&path, json(&problem(1.0))).expect("the folder of tests is writable");
    let (accepted, said) = checked(&path, &text);
    assert!(!accepted, "{said}");
}

#[test]
fn an_interrupted_search_proves_nothing() {
    let mut random = Random::new(5);
    let m = random.matrix(12, 12);
    let problem = ModeProblem::from_linear_complementarity(&m, random.vector(12)).expect("shapes fit");
    let stopped = prove(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(NoProof::Stopped(_))));
    assert!(run(&problem, &SearchOptions::default()).nodes() > 0);
}

/// All z from 0 to 1 with a sum of at most 8 solve this: more corners than are described. That there is no proof is said at
/// the first node that shows it, and not after the search, which takes more than 1,000 nodes.
#[test]
fn sets_with_too_many_corners_end_a_proof_at_once() {
    let size = 16;
    let rows = size + 1;
    let a = DMatrix::from_fn(rows, size, |row, column| f64::from(row == size || row == column));
    let mut m = DMatrix::zeros(size + rows, size + rows);
    m.view_mut((size, 0), (rows, size)).copy_from(&-&a);
    m.view_mut((0, size), (size, rows)).copy_from(&a.transpose());
    let q = DVector::from_fn(size + rows, |row, _| match row {
        _ if row < size => 0.0,
        _ if row < 2 * size => 1.0,
        _ => 8.0,
    });
    let problem = ModeProblem::from_linear_complementarity(&m, q).expect("finite");
    let options = SearchOptions::within(Some(100), None);
    let found = prove(&problem, &options, &mut |_| ControlFlow::Continue(()));
    assert_eq!(found.err(), Some(NoProof::Open));
}

#[test]
fn a_monotone_problem_takes_one_node() {
    // M = B^T B + K with a skew K is positive semidefinite, and singular, as B has three rows only.
    let mut random = Random::new(6);
    let b = DMatrix::from_fn(3, 9, |_, _| random.integer(3));
    let skew = integers(&mut random, 9, 3);
    let m = b.transpose() * &b + &skew - skew.transpose();
    let z = DVector::from_fn(9, |row, _| f64::from(u8::from(row % 2 == 0)));
    let q = DVector::from_fn(9, |row, _| f64::from(u8::from(row % 2 == 1))) - &m * z;
    let problem = ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit");
    let text = proven(&problem, "monotone");
    assert!(text.contains("\nm 0\n") && !text.contains("\nb "), "{text}");
}

/// Numbers of very different sizes need vectors of long integers, which are found all the same.
#[test]
fn problems_of_great_scales_have_proofs() {
    let problems = [
        r#"{"type": "game", "A": [[536870912], [0]]}"#,
        r#"{"type": "game", "A": [[1e300, 1], [-1e-300, 3]], "B": [[1, -1e16], [2, 1e9]]}"#,
        r#"{"type": "lcp", "M": [[1e-300, 0, 1], [0, 1, 1e200], [2, 1e-9, 1]], "q": [-1e10, -1, 1]}"#,
        r#"{"type": "hlcp", "A": [[2, 1e-9], [0, 1e160]], "B": [[1, -1e16], [3, 1]], "q": [1e-300, 2]}"#,
        r#"{"type": "mcp", "M": [[2, 1], [1, -1]], "q": [-1, 1e9], "l": [-1e20, 0], "u": [1e20, 1e12]}"#,
    ];
    for (at, text) in problems.into_iter().enumerate() {
        let raw = RawProblem::from_json(text.as_bytes()).expect("a problem");
        proven(&raw.mode_problem().expect("finite"), &format!("great_scales_{at}"));
    }
}

/// w = z - 1 and w = 2 z - 1 have the same proof but for the digest.
#[test]
fn a_proof_is_about_one_problem() {
    let problem = |m: f64| {
        let (m, q) = (DMatrix::from_element(1, 1, m), DVector::from_element(1, -1.0));
        ModeProblem::from_linear_complementarity(&m, q).expect("finite")
    };
    let text = proven(&problem(1.0), "digest");
    let other = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("digest_other.json");
    std::fs::write(&other, json(&problem(2.0))).expect("the folder of tests is writable");
    let (accepted, said) = checked(&other, &text);
    assert!(!accepted && said.contains("the proof is about another problem"), "{said}");
    let without: String = text.split_inclusive('\n').filter(|line| !line.starts_with("digest")).collect();
    assert!(checked(&other, &without).0);
}
