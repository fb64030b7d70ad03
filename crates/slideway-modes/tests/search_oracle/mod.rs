//! Maximal cells of degenerate problems against brute force in whole numbers, which shares no code with the search.

mod brute_force;
mod families;

use std::collections::BTreeSet;

use brute_force::{Unknowns, maximal_cells};
use families::{FAMILIES, Family};
use slideway_modes::{Arguments, CombinedState, Completeness, ModeProblem, SearchOptions, StateKind};

use crate::search_support::{Random, run};

/// What instances of a family admit.
#[derive(Debug, Default)]
struct Tally {
    problems: u64,
    cells: usize,
    /// Problems with several cells, and with none.
    several: u64,
    none: u64,
    /// Where the search does not list the same cells.
    different: Vec<String>,
    /// Where it lists a cell twice.
    repeated: Vec<String>,
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

/// Compares the maximal cells that the search lists, and whether all else is part of one.
fn compare(
    problem: &ModeProblem,
    options: &SearchOptions,
    (cells, tally): (&BTreeSet<Unknowns>, &mut Tally),
    name: &str,
) {
    let result = run(problem, options);
    let listed: Vec<(Unknowns, StateKind, bool)> = result
        .product
        .states()
        .map(|state| (positive_unknowns(&state, problem.contacts()), state.kind(), state.is_maximal()))
        .collect();
    let maximal: Vec<Unknowns> =
        listed.iter().filter(|(.., is_maximal)| *is_maximal).map(|one| one.0).collect();
    let set: BTreeSet<Unknowns> = maximal.iter().copied().collect();
    let is_part = |positive: Unknowns| cells.iter().any(|cell| positive & !cell == 0);
    let agrees = set == *cells && listed.iter().all(|(positive, ..)| is_part(*positive));
    let context = || {
        let (how, arguments) = (result.strategy(), options.arguments);
        format!(
            "{name}, {}, {how}: {listed:x?}, not {cells:x?}\n{arguments:?}\n{problem:?}",
            result.completeness
        )
    };
    if !agrees || result.completeness != Completeness::Proven {
        tally.different.push(context());
    } else if maximal.len() > set.len() {
        tally.repeated.push(context());
    }
}

fn campaign(family: &Family, seeds: std::ops::Range<u64>, size: usize) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let mut random = Random::new(seed);
        let size = 1 + random.below(size);
        let problem = (family.problem)(&mut random, size);
        let cells = maximal_cells(&problem);
        let name = format!("{} {seed}", family.name);
        options().iter().for_each(|options| compare(&problem, options, (&cells, &mut tally), &name));
        tally.problems += 1;
        tally.cells += cells.len();
        tally.several += u64::from(cells.len() > 1);
        tally.none += u64::from(cells.is_empty());
    }
    tally
}

fn assert_same(family: &Family) {
    let tally = campaign(family, 0..1000, 4);
    assert!(tally.different.is_empty(), "{}: {}", tally.different.len(), tally.different[0]);
    assert!(tally.repeated.is_empty(), "{}: {}", tally.repeated.len(), tally.repeated[0]);
    assert!(tally.cells > 400, "{}: {tally:?}", family.name);
}

#[test]
fn cells_are_those_of_brute_force() {
    FAMILIES.iter().for_each(assert_same);
}

/// `cargo test --release -p slideway-modes-tests --test all -- --ignored --nocapture long_campaign`: minutes, not seconds.
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
        let tally = campaign(family, from..from + count, size);
        let Tally { problems, cells, several, none, different, repeated } = tally;
        println!("{}: {problems} problems, {cells} cells, {several} several, {none} none", family.name);
        println!("  different: {}, repeated: {}", different.len(), repeated.len());
        different.first().into_iter().chain(repeated.first()).for_each(|text| println!("  {text}"));
    }
}
