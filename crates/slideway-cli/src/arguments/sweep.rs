//! `slideway sweep`

use super::values::choice;
use super::{Destination, ModelArguments, PlotArguments, TimeArguments};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Args};
use slideway::choice::Choice;
use slideway::fault::Faults;
use slideway::limits::Quantity;
use slideway::sweep::{Sampling, Shard, Spread, SweepOptions, SweepPoints};
use slideway_tables::TableFormat;
use std::path::PathBuf;
use std::str::FromStr;

pub(super) const USAGE: &str = "\
slideway sweep [OPTIONS] --vary <NAME=VALUES> <MODEL>
       slideway sweep [OPTIONS] --merge <FOLDER>";

pub(super) const HELP: &str = "\
What to vary: a parameter, a coordinate, COORDINATE.rate, `friction` for a
factor on all coefficients of friction, or `time`. Values:
  mu=0..0.8:801            801 evenly spaced values, both ends included
  mu=0.01..1:50:log        evenly spaced logarithms
  mu=0.1,0.2,0.5           these values
and with --samples:
  mu=0.1..0.5              uniform
  mu=\"uniform(0.1, 0.5)\"
  mu=\"normal(0.3, 0.05)\"   mean and standard deviation
  mu=\"lognormal(0.3, 0.2)\" median, and standard deviation of the logarithm
Distributions of friction are cut off at zero.

Examples:
  slideway sweep drawer.toml --vary mu=0..1:101 -o drawer.csv
  slideway sweep drawer.toml --vary mu=0..1:101 -o mu.csv --plot mu.svg
  slideway sweep slider-crank.toml --vary phi=\"-80 deg..80 deg:801\" -o phi.csv
  slideway sweep klepp-2002.toml --vary mu_1=0..0.8:81 --vary mu_2=0..0.4:41 \\
    --output klepp.npz
  slideway sweep drawer.toml --vary mu=\"normal(0.6, 0.05)\" --samples 100000 \\
    --output drawer.npz

On many machines, each command by any of them, in any order (needs a program
built with the feature parquet):
  slideway sweep drawer.toml --vary mu=0..1:100001 --shard 1/2 --output results/
  slideway sweep drawer.toml --vary mu=0..1:100001 --shard 2/2 --output results/
  slideway sweep --merge results/ --output drawer.npz

Exit codes:
  0    done
  2    invalid input: the model, the settings, the axes, the files or the
       arguments; or nothing is varied
  3    not done within --time-limit
  130  interrupted (Ctrl-C)

After a time limit or an interruption the finished part is kept beside --output,
and --resume continues it. A shard is continued by the same command.";

/// Arguments of `slideway sweep`.
#[derive(Debug, Args)]
pub(crate) struct SweepArguments {
    #[command(flatten)]
    pub(crate) model: Option<ModelArguments>,

    /// What to vary, and its values; may be repeated, the last one varying fastest. Without it, the quantities of the
    /// model are listed.
    #[arg(long, value_name = "NAME=VALUES")]
    pub(crate) vary: Vec<String>,

    /// Draw N random samples instead of a grid.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    samples: Option<u64>,

    /// How samples are distributed.
    #[arg(long, default_value = Spread::default().word(), value_parser = choice::<Spread>(), requires = "samples")]
    sampling: Spread,

    /// Seed of the samples: the same seed gives the same samples.
    #[arg(long, value_name = "NUMBER", default_value_t = 0, requires = "samples")]
    seed: u64,

    /// Do not insert the exact ends of modes into a sweep over one quantity.
    #[arg(long)]
    no_breakpoints: bool,

    #[command(flatten)]
    more: MoreColumns,

    /// Continue an interrupted sweep. A shard is continued without it.
    #[arg(long, requires = "output")]
    pub(crate) resume: bool,

    /// Compute one of N shards alone, K from 1, and write it as a Parquet file into the folder --output,
    /// unless it is there.
    #[arg(long, value_name = "K/N", requires = "output", conflicts_with_all = ["plot", "format"])]
    pub(crate) shard: Option<Shard>,

    /// Merge the shards in this folder into the table of the whole sweep.
    #[arg(long, value_name = "FOLDER", conflicts_with_all = NOT_FOR_MERGING)]
    pub(crate) merge: Option<PathBuf>,

    /// Form of the table; by default that of the output file's extension, else CSV.
    #[arg(long, value_parser = table_format())]
    pub(crate) format: Option<TableFormat>,

    #[command(flatten)]
    pub(crate) plot: PlotArguments,

    /// What the plot shows.
    #[arg(long, default_value = Quantity::default().word(), value_parser = choice::<Quantity>(), requires = "plot")]
    pub(crate) quantity: Quantity,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// The name of the option that merges shards.
const MERGE: &str = "merge";
/// Arguments that conflict with `--merge`: the shards carry these values themselves.
const NOT_FOR_MERGING: [&str; 8] =
    ["ModelArguments", "vary", "samples", "sampling", "seed", "no_breakpoints", "MoreColumns", "shard"];

/// The argument of the model file, which is not needed to merge shards.
pub(super) fn unless_merging(file: Arg) -> Arg {
    file.required(false).required_unless_present(MERGE)
}

/// Columns that are left out unless they are asked for.
#[derive(Debug, Args)]
struct MoreColumns {
    /// Report for each solution whether a mechanism with slightly elastic guides settles on it; --plot
    /// implies this.
    #[arg(long)]
    attainability: bool,

    /// Include accelerations of bodies and hinge forces.
    #[arg(long)]
    all_columns: bool,
}

impl SweepArguments {
    /// Returns the options of the sweep for the library.
    ///
    /// # Errors
    /// The faults of every axis that cannot be read.
    pub(crate) fn options(&self) -> Result<SweepOptions, Faults> {
        let points = match self.samples {
            None => SweepPoints::Grid(axes(&self.vary)?),
            Some(count) => SweepPoints::Samples(
                Sampling { count, spread: self.sampling, seed: self.seed },
                axes(&self.vary)?,
            ),
        };
        Ok(SweepOptions::over(points)
            .breakpoints(!self.no_breakpoints)
            // Strokes of a plot tell of it.
            .attainability(self.more.attainability || self.plot.plot.is_some())
            .all_columns(self.more.all_columns))
    }
}

/// The axes, or the faults of all that cannot be read.
fn axes<A: FromStr<Err = Faults>>(texts: &[String]) -> Result<Vec<A>, Faults> {
    let mut faults = Faults::default();
    let axes = texts.iter().filter_map(|text| text.parse().map_err(|found| faults.append(found)).ok());
    let axes = axes.collect();
    faults.or(axes)
}

/// The names of the forms of tables.
fn table_format() -> impl TypedValueParser<Value = TableFormat> {
    let names = TableFormat::ALL.iter().map(|form| PossibleValue::new(form.name()).help(form.description()));
    PossibleValuesParser::new(names).map(|name| TableFormat::named(&name).expect("one of the names"))
}

/// The endings of tables.
pub(crate) fn table_endings() -> Vec<String> {
    TableFormat::ALL.iter().map(|form| format!(".{}", form.name())).collect()
}
