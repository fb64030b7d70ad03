//! Coupling of low rank: proven answers by subdivision, the same as those of branch and bound and of
//! the enumeration of all patterns.

use crate::search_support::{Random, assert_same_as_enumeration, low_rank, run};
use nalgebra::{DMatrix, DVector};
use slideway_modes::{Arguments, Completeness, Method, ModeProblem, SearchOptions};

fn with_cells() -> SearchOptions {
    let arguments = Arguments { uniqueness: false, ..Arguments::default() };
    SearchOptions { arguments, ..SearchOptions::default() }
}

fn without_cells() -> SearchOptions {
    let arguments = Arguments { uniqueness: false, low_rank: false, ..Arguments::default() };
    SearchOptions { arguments, ..SearchOptions::default() }
}

#[test]
fn answers_are_proven_and_those_of_branch_and_bound() {
    let mut several = 0;
    for seed in 0..12 {
        let mut random = Random::new(100 + seed);
        let (size, rank) = (13, 1 + random.below(4));
        let problem = low_rank(&mut random, size, rank, 4.0);
        let cells = run(&problem, &with_cells());
        assert_eq!(cells.groups[0].method, Method::Cells { rank });
        assert_eq!(cells.completeness, Completeness::Proven);
        let tree = run(&problem, &without_cells());
        assert_eq!(tree.completeness, Completeness::Proven);
        assert_eq!(cells.counts(), tree.counts());
        several += u64::from(cells.counts().solutions.to_u64() > Some(1));
    }
    assert!(several > 0);
}

#[test]
fn many_contacts_are_proven() {
    for (rank, most) in [(1, 100), (2, 2000), (3, 10_000)] {
        let problem = low_rank(&mut Random::new(rank as u64), 120, rank, 3.0);
        let result = run(&problem, &with_cells());
        assert_eq!(result.groups[0].method, Method::Cells { rank });
        assert_eq!(result.completeness, Completeness::Proven);
        assert!(result.nodes() < most, "{}", result.nodes());
    }
}

#[test]
fn equal_and_parallel_hyperplanes() {
    for seed in 0..6_usize {
        let mut random = Random::new(40 + seed as u64);
        let size = 13;
        let left = DMatrix::from_fn(size, 2, |row, _| if row < 4 { 1.0 } else { random.integer(2) });
        let [positive, negative] = [4.0, -4.0].map(|sign| {
            let right = DMatrix::from_fn(2, size, |_, _| random.integer(2));
            DMatrix::from_diagonal_element(size, size, sign) + &left * right
        });
        let load = DVector::from_fn(size, |row, _| if row < 2 { 3.0 } else { random.integer(6) + 0.5 });
        let none = DMatrix::zeros(size, size);
        let problem = ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit");
        assert_same_as_enumeration(&problem, &SearchOptions::default(), seed);
    }
}

#[test]
fn jumps_are_left_to_branch_and_bound() {
    let mut random = Random::new(8);
    let plain = low_rank(&mut random, 13, 1, 1.0);
    let [positive, negative] = slideway_modes::Side::BOTH.map(|side| plain.columns(side).clone());
    let mut jumps = DMatrix::zeros(13, 13);
    jumps.set_column(3, &(random.vector(13) * 0.2));
    let load = plain.right_hand_side().clone();
    let problem =
        ModeProblem::new(positive, negative, jumps, DMatrix::zeros(13, 13), load).expect("shapes fit");
    let result = run(&problem, &with_cells());
    assert_eq!(result.groups[0].method, Method::BranchAndBound);
    assert_eq!(result.counts(), run(&problem, &without_cells()).counts());
}

#[test]
fn loads_that_follow_from_other_contacts_are_bounds() {
    // A contact of its own acts on all others with 1/3 of its force, which is rounded.
    let mut random = Random::new(21);
    let block = low_rank(&mut random, 14, 2, 3.0);
    let [positive, negative] = slideway_modes::Side::BOTH.map(|side| {
        let mut columns = block.columns(side).clone().insert_row(0, 0.0).insert_column(0, 1.0 / 7.0);
        columns[(0, 0)] = side.sign() * 3.0;
        columns
    });
    let load = block.right_hand_side().clone().insert_row(0, 1.0);
    let none = DMatrix::zeros(15, 15);
    let problem = ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit");
    let result = run(&problem, &with_cells());
    assert!(result.groups.iter().any(|group| matches!(group.method, Method::Cells { .. })));
    assert_eq!(result.completeness, Completeness::Proven);
    assert_eq!(result.counts(), run(&problem, &without_cells()).counts());
}
