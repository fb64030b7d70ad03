//! The metadata of this run in a table.

use crate::input::Input;
use slideway_tables::{Metadata, quoted};
use std::ffi::OsString;

/// Arguments that do not change a table.
const LEFT_OUT: [&str; 2] = ["--resume", "--force"];

/// The command of this run and its model.
pub(crate) fn metadata(input: &Input) -> Metadata {
    Metadata { command: command(std::env::args_os()), model: input.text() }
}

/// The command of the sweep that this run computes a shard of, without its output.
#[cfg(feature = "parquet")]
pub(crate) fn command_of_shards() -> String {
    command(of_sweep(std::env::args_os()))
}

/// The arguments that all shards of a sweep have in common.
#[cfg(any(feature = "parquet", test))]
fn of_sweep(arguments: impl Iterator<Item = OsString>) -> impl Iterator<Item = OsString> {
    // Those with a value in which the shards of one sweep may differ, and the short form of the first one.
    const OF_SHARDS: [&str; 3] = ["--output", "--shard", "--time-limit"];
    const OUTPUT: &str = "-o";
    let mut is_value = false;
    arguments.filter(move |word| {
        if std::mem::take(&mut is_value) {
            return false;
        }
        let word = word.to_string_lossy();
        is_value = word == OUTPUT || OF_SHARDS.iter().any(|name| word == *name);
        let holds_value = |name: &str| word.strip_prefix(name).is_some_and(|rest| rest.starts_with('='));
        !(is_value || word.starts_with(OUTPUT) || OF_SHARDS.into_iter().any(holds_value))
    })
}

/// The command as it may be given again, on one line.
fn command(arguments: impl Iterator<Item = OsString>) -> String {
    let kept = arguments.skip(1).filter(|word| !LEFT_OUT.iter().any(|left_out| word == left_out));
    kept.fold("slideway".to_owned(), |command, word| format!("{command} {}", quoted(&word)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_of_one_sweep_have_one_command() {
        for words in [
            &["--shard", "2/3", "--output", "results", "--vary", "mu=0..1:11", "--time-limit=1h"][..],
            &["--vary", "mu=0..1:11", "-oresults", "--shard=3/3", "--resume", "--force"],
            &["--vary", "mu=0..1:11", "--shard", "1/3", "-o", "results", "--time-limit", "2h"],
        ] {
            let words = ["slideway", "sweep", "drawer.toml"].iter().chain(words).map(OsString::from);
            assert_eq!(command(of_sweep(words)), "slideway sweep drawer.toml --vary mu=0..1:11");
        }
    }

    #[test]
    fn a_command_stays_on_one_line() {
        let words =
            ["slideway", "sweep", "it's.toml", "a\nb'\u{1b}]0;\u{9b}.toml", "--force", "--vary", "mu=0..1"];
        let told = command(words.into_iter().map(OsString::from));
        assert_eq!(told, r"slideway sweep 'it'\''s.toml' $'a\nb\'\033]0;\302\233.toml' --vary mu=0..1");
    }
}
