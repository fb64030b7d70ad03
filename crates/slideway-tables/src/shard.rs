//! The metadata that a shard of a sweep carries.

use crate::Metadata;
use crate::command::{command, typed_options, typed_settings};
use serde::{Deserialize, Serialize};
use slideway::fault::Faults;
use slideway::model::{Model, Settings};
use slideway::sweep::{Breakpoints, Shard, Sweep, SweepOptions, Tally};
use std::path::{Path, PathBuf};

/// A sweep that is computed in shards: all that is needed to compute it again.
#[derive(Debug, Clone, PartialEq)]
pub struct ShardedSweep {
    /// The text of the model, and the command, which every shard and the merged table tell of themselves.
    /// Nothing depends on the command.
    pub metadata: Metadata,
    /// The changes of the model.
    pub settings: Settings,
    /// The options of the sweep: the quantities that are varied, and what is computed.
    pub options: SweepOptions,
}

impl ShardedSweep {
    /// Returns a sweep of the model in a file, as the command line receives it: with values as texts. If
    /// there is no such command, its tables name `otherwise` in its place.
    pub fn typed(
        (file, model): (&str, &str),
        (settings, options): (&Settings, &SweepOptions),
        otherwise: &str,
    ) -> Self {
        let (settings, options) = (typed_settings(settings), typed_options(options));
        let command = command(file, &settings, &options).unwrap_or_else(|| otherwise.to_owned());
        Self { metadata: Metadata { command, model: model.to_owned() }, settings, options }
    }

    /// The whole sweep, with exact ends of modes that were found before.
    ///
    /// # Errors
    /// As [`Sweep::new`].
    pub fn sweep(&self, breakpoints: Breakpoints) -> Result<Sweep, Faults> {
        let model =
            Model::parse(&self.metadata.model)?.with_varied(&self.settings, &self.options.points.names())?;
        Sweep::with_breakpoints(&model, &self.options, breakpoints)
    }
}

/// Which part of which sweep the rows of a table are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Which shard it is.
    pub shard: Shard,
    /// The number of its first point, from 0.
    pub first_point: u64,
    /// How many points it has ...
    pub points: u64,
    /// ... of so many.
    pub points_of_sweep: u64,
    /// The changes of the model.
    pub settings: Settings,
    /// The options of the sweep: the quantities that are varied, and what is computed.
    pub options: SweepOptions,
    /// The exact ends of modes that are inserted into the whole sweep.
    pub breakpoints: Breakpoints,
}

impl Part {
    /// A shard of a sweep, which is `whole`.
    #[cfg(feature = "parquet")]
    pub(crate) fn new(sharded: &ShardedSweep, whole: &Sweep, shard: Shard) -> Self {
        let range = whole.shard(shard).range();
        Self {
            shard,
            first_point: range.start,
            points: range.end - range.start,
            points_of_sweep: whole.points(),
            settings: sharded.settings.clone(),
            options: sharded.options.clone(),
            breakpoints: whole.breakpoints().clone(),
        }
    }
}

/// The metadata in the file of a shard, as JSON, besides the text of the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Which part of which sweep it is.
    pub part: Part,
    /// Numbers of its points, of their rows and of kinds of outcome.
    pub tally: Tally,
}

/// The file of a shard in its folder: `shard-03-of-64.parquet`, so that files in the order of their names
/// have points in their order.
pub fn shard_path(folder: &Path, shard: Shard) -> PathBuf {
    let of = shard.of().to_string();
    folder.join(format!("shard-{:0width$}-of-{of}.parquet", shard.number(), width = of.len()))
}

/// The shard whose file bears this name.
#[cfg(feature = "parquet")]
pub(crate) fn shard_of_name(name: &str) -> Option<Shard> {
    let (number, of) = name.strip_prefix("shard-")?.strip_suffix(".parquet")?.split_once("-of-")?;
    let shard = Shard::new(number.parse().ok()?, of.parse().ok()?).ok()?;
    (shard_path(Path::new(""), shard) == Path::new(name)).then_some(shard)
}

/// Ascending numbers as ranges, "3,7-9", as job schedulers take them.
#[cfg(feature = "parquet")]
pub(crate) fn ranges(numbers: &[u32]) -> String {
    let runs = numbers.chunk_by(|one, next| one + 1 == *next);
    let word = |run: &[u32]| match run {
        [first, .., last] => format!("{first}-{last}"),
        one => one.iter().map(u32::to_string).collect(),
    };
    runs.map(word).collect::<Vec<_>>().join(",")
}

#[cfg(all(test, feature = "parquet"))]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_read_as_they_are_written() {
        for (shard, name) in [("3/64", "shard-03-of-64.parquet"), ("1/1", "shard-1-of-1.parquet")] {
            let shard: Shard = shard.parse().expect("a shard");
            assert_eq!(shard_path(Path::new("results"), shard), Path::new("results").join(name));
            assert_eq!(shard_of_name(name), Some(shard));
        }
        for name in
            ["shard-3-of-64.parquet", "shard-00-of-64.parquet", "shard-65-of-64.parquet", "all.parquet"]
        {
            assert_eq!(shard_of_name(name), None, "{name}");
        }
    }

    #[test]
    fn ranges_are_short() {
        assert_eq!(ranges(&[3, 7, 8, 9, 11, 12]), "3,7-9,11-12");
        assert_eq!(ranges(&[1]), "1");
    }
}
