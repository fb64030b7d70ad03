//! Maximal cells of degenerate problems against brute force in whole numbers, which shares no code with the search.

mod brute_force;
mod families;

use std::collections::BTreeSet;

use brute_force::{UNKNOWNS, Unknowns, maximal_cells};
use families::{FAMILIES, Family};
use slideway_modes::{Arguments, CombinedState, Completeness, ModeProblem, SearchOptions};

use crate::search_support::{Random, run};

/// What instances of a family admit.
#[derive(Debug, Default)]
struct Tally {
    problems: u64,
    cells: usize,
    /// Problems with several cells, and with none.
    several: u64,
    none: u64,
}

/// All arguments, and without those that spare the tree.
fn options() -> [SearchOptions; 3] {
    let all = Arguments::default();
    let without_patterns = Arguments { every_pattern: false, ..all };
    let tree = Arguments { groups: false, uniqueness: false, every_pattern: false, ..all };
    [all, without_patterns, tree].map(|arguments| SearchOptions { arguments, ..SearchOptions::default() })
}

fn positive_unknowns(state: &CombinedState<'_>, contacts: usize) -> Unknowns {
    let positive = state.positive_unknowns(contacts);
    let bits = positive.iter().flatten().enumerate().map(|(at, &is)| u64::from(is) << at);
    bits.fold(0, |all, bit| all | bit)
}

/// The search lists each maximal cell once, and whatever else it lists is part of one.
fn compare(problem: &ModeProblem, options: &SearchOptions, cells: &BTreeSet<Unknowns>, context: &str) {
    assert_eq!(UNKNOWNS, 4);
    let result = run(problem, options);
    let context = || format!("{context}, {:?}, {}\n{problem:?}", options.arguments, result.strategy());
    assert_eq!(result.completeness, Completeness::Proven, "{}", context());
    let mut found = BTreeSet::new();
    for state in result.product.states() {
        let positive = positive_unknowns(&state, problem.contacts());
        if state.is_maximal() {
            assert!(found.insert(positive), "{positive:#b} twice: {}", context());
        }
        assert!(cells.iter().any(|cell| positive & !cell == 0), "{positive:#b} in none: {}", context());
    }
    assert_eq!(&found, cells, "{}", context());
}

fn campaign(family: &Family, seeds: std::ops::Range<u64>, size: usize) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let mut random = Random::new(seed);
        let size = 1 + random.below(size);
        let problem = (family.problem)(&mut random, size);
        let cells = maximal_cells(&problem);
        let context = format!("{} {seed}", family.name);
        options().iter().for_each(|options| compare(&problem, options, &cells, &context));
        tally.problems += 1;
        tally.cells += cells.len();
        tally.several += u64::from(cells.len() > 1);
        tally.none += u64::from(cells.is_empty());
    }
    tally
}

#[test]
fn cells_are_those_of_brute_force() {
    for family in &FAMILIES {
        let tally = campaign(family, 0..1000, 4);
        assert!(tally.cells > 400 && tally.several > 50, "{}: {tally:?}", family.name);
    }
}

/// `cargo test --release -p slideway-modes --test all -- --ignored --nocapture long_campaign`: minutes, not seconds.
/// The variables `FROM`, `COUNT` and `SIZE` choose the instances of each family.
#[test]
#[ignore = "a long campaign"]
#[expect(clippy::print_stdout, reason = "it tells what it met")]
fn long_campaign() {
    let number = |name: &str, default| {
        std::env::var(name).map_or(default, |text| text.parse().expect("a whole number"))
    };
    let (from, count) = (number("FROM", 1_000_000), number("COUNT", 100_000));
    let size = usize::try_from(number("SIZE", 6)).expect("a small number");
    for family in &FAMILIES {
        println!("{}: {:?}", family.name, campaign(family, from..from + count, size));
    }
}
