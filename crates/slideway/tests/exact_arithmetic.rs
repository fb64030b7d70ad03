//! Raw problems against brute force in rational numbers: near-equal jumps, numbers from all over the range of
//! floating point, sums that round, small whole numbers. The oracle shares no code with the library.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

#[path = "exact_arithmetic/compare.rs"]
mod compare;
#[path = "exact_arithmetic/families.rs"]
mod families;
#[path = "exact_arithmetic/oracle.rs"]
mod oracle;

use compare::{Tally, compare};
use families::{FAMILIES, Family, Random};

/// Compares instances of a family, and asserts that few of them are beyond the oracle.
fn campaign(family: &Family, seeds: std::ops::Range<u64>) -> Tally {
    let mut tally = Tally::default();
    let number = seeds.end - seeds.start;
    for seed in seeds {
        compare(&(family.problem)(&mut Random::new(seed)), &format!("{} {seed}", family.name), &mut tally);
    }
    assert!(tally.skipped * 4 <= number, "{}: {tally:?}", family.name);
    tally
}

fn family(name: &str) -> &'static Family {
    FAMILIES.iter().find(|family| family.name == name).unwrap()
}

#[test]
fn nearly_equal_jumps() {
    let tally = campaign(family("nearly equal jumps"), 0..400);
    assert!(tally.gap_states > 100, "{tally:?}");
}

#[test]
fn extreme_scales() {
    let tally = campaign(family("extreme scales"), 0..400);
    assert!(tally.beyond_range > 100, "{tally:?}");
}

#[test]
fn triangular_problems_of_extreme_scales() {
    let tally = campaign(family("triangular, extreme scales"), 0..40);
    assert!(tally.beyond_range > 20, "{tally:?}");
}

#[test]
fn sums_that_round() {
    let tally = campaign(family("sums that round"), 0..400);
    assert!(tally.solutions > 400, "{tally:?}");
}

#[test]
fn small_whole_numbers() {
    let tally = campaign(family("small whole numbers"), 0..400);
    assert!(tally.boundary > 50 && tally.continua > 10, "{tally:?}");
}

#[test]
fn random_numbers() {
    let tally = campaign(family("random numbers"), 0..150);
    assert!(tally.solutions > 100 && tally.none > 10, "{tally:?}");
}

/// `cargo test --release -p slideway-tests --test all exact_arithmetic -- --ignored --nocapture`: minutes, not seconds.
/// The variables `FROM` and `COUNT` choose the instances of each family.
#[test]
#[ignore = "a long campaign"]
#[expect(clippy::print_stdout, reason = "it tells what it met")]
fn long_campaign() {
    let number = |name: &str, default| std::env::var(name).map_or(default, |text| text.parse().unwrap());
    let (from, count) = (number("FROM", 1_000_000), number("COUNT", 10_000));
    for family in FAMILIES {
        println!("{}: {:?}", family.name, campaign(family, from..from + count));
    }
}
