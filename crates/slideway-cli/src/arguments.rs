//! The arguments of the command line.

use crate::failure::Failure;
use anstream::ColorChoice;
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use slideway::fault::Fault;
use slideway::model::{SettingKind, Settings};
use slideway::modes::SearchOptions;
use std::path::PathBuf;
use std::time::Duration;

/// All solutions of planar mechanisms with dry friction in sliding joints.
///
/// Friction can lock a sliding mechanism, or leave it several ways to move. slideway tries every contact mode and
/// lists all solutions: forces, accelerations, and on which side each slider touches its guide.
#[derive(Debug, Parser)]
#[command(name = "slideway", version, max_term_width = 100, after_help = AFTER_HELP)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,

    /// Whether to colour the output; `auto` does so on terminals, and respects NO_COLOR and CLICOLOR_FORCE.
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN", display_order = 900)]
    pub(crate) color: Color,
}

const AFTER_HELP: &str = "\
Examples:
  slideway models                               list the models to start from
  slideway models drawer > drawer.toml          write one of them to a file
  slideway solve drawer.toml                    all solutions of its kinetic problem
  slideway solve drawer.toml --set mu=0.7       with more friction
  slideway limits drawer.toml --vary mu         at which friction it jams
  slideway hold drawer.toml                     whether it stays at rest
  slideway modes problem.json                   all solutions of an LCP or the like

Exit codes: 0 done, 1 no solution (friction locks the mechanism), 2 faulty input, 3 undecided.";

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Find all solutions of a mechanism in its state
    #[command(after_help = SOLVE_HELP)]
    Solve(SolveArguments),
    /// Say for which friction, load or size each contact mode exists, and where it locks
    #[command(after_help = LIMITS_HELP)]
    Limits(LimitsArguments),
    /// Say what a model consists of and whether it is sound
    #[command(after_help = CHECK_HELP)]
    Check(CheckArguments),
    /// Say whether a mechanism stays at rest, and how it begins to move if not
    #[command(after_help = HOLD_HELP)]
    Hold(HoldArguments),
    /// Find all solutions of an LCP or the like, given by its matrices
    #[command(after_help = MODES_HELP)]
    Modes(ModesArguments),
    /// List the gallery of models, or write one of them
    #[command(after_help = MODELS_HELP)]
    Models(ModelsArguments),
    /// Print the JSON Schema of model files, for editors
    #[command(after_help = SCHEMA_HELP)]
    Schema,
    /// Print a completion script for a shell
    #[command(after_help = COMPLETIONS_HELP)]
    Completions {
        /// The shell.
        shell: Shell,
    },
}

const SOLVE_HELP: &str = "\
Examples:
  slideway solve klepp-2002.toml
  slideway solve klepp-2002.toml --set F_20=0 --set direction=-1
  slideway solve klepp-2002.toml --set F_20=\"m*g\" --set alpha=\"75 deg\"
  slideway solve slider-crank.toml --at phi=\"-75 deg\" --rate phi=\"20 rad/s\"
  slideway solve drawer.toml --format json --output drawer.json
  slideway models drawer | slideway solve -

Exit codes:
  0  solved: one solution, several, infinitely many, or a state with the preload between the faces
  1  no solution: friction locks the mechanism
  2  faulty input: the model, the settings, the files or the arguments
  3  unknown: nothing was found, but not every contact mode could be decided";

const LIMITS_HELP: &str = "\
Examples:
  slideway limits klepp-2002.toml --vary mu_1=0..0.8
  slideway limits klepp-2002.toml --vary mu_1 --set F_20=0 --both-directions
  slideway limits drawer.toml --vary friction        all coefficients of friction together
  slideway limits drawer.toml --vary L=\"0.2 m..0.5 m\"
  slideway limits slider-crank.toml --vary phi=\"-80 deg..80 deg\"

Exit codes:
  0  done
  2  faulty input: the model, the settings, the name or the range, the arguments";

const CHECK_HELP: &str = "\
Examples:
  slideway check drawer.toml
  slideway check bracket-on-pole.toml --set mu=0.3
  slideway check drawer.toml --format json

Exit codes:
  0  the model is sound: `slideway solve` accepts it
  2  faulty input, or a finding for which `slideway solve` would refuse it";

const HOLD_HELP: &str = "\
Examples:
  slideway hold bracket-on-pole.toml
  slideway hold bracket-on-pole.toml --load W
  slideway hold bracket-on-pole.toml --load W --vary mu_static
  slideway hold cam-follower.toml --load cam
  slideway hold slider-crank.toml --at phi=\"0 deg\" --load gas

The rates of the model are taken as zero. With --load NAME the load is multiplied by a factor, 1 being the load of the
model; all that is told besides holds for the factor 1. The name of a drive stands for its effort, counted in N or N m,
and all that is told besides holds without it. A load comes before a drive of the same name.

Exit codes:
  0  it can stay at rest
  1  it cannot stay at rest
  2  faulty input: the model, the settings, the files or the arguments
  3  unknown: no state of rest was found, but not every state could be decided";

const MODES_HELP: &str = "\
Types of problems and their arrays:
  lcp    M, q       w = M z + q, w >= 0, z >= 0, w_k z_k = 0
  ave    A, B, b    A x + B |x| = b
  hlcp   A, B, q    A w - B z = q, w >= 0, z >= 0, w_k z_k = 0
  modes  columns_positive, columns_negative, right_hand_side,
         perhaps jumps_positive, jumps_negative

As JSON, a matrix being a list of rows:
  {\"type\": \"lcp\", \"M\": [[2, 1], [1, 2]], \"q\": [-1, 1]}
or as a NumPy archive, written by numpy.savez(\"problem.npz\", M=M, q=q).

Examples:
  slideway modes problem.json
  slideway modes problem.npz --output result.npz
  slideway modes problem.json --time-limit 30s --format json
  slideway modes - < problem.json

Exit codes:
  0  solutions were found: one, several, infinitely many, or a state in a preload gap
  1  no solution, and the search was complete
  2  faulty input: the problem, the files or the arguments
  3  unknown: nothing was found, but the search was not complete";

const MODELS_HELP: &str = "\
Examples:
  slideway models                               list them
  slideway models drawer                        print one
  slideway models drawer --output mine.toml     write it to a new file
  slideway models telescopic-boom --stages 5    a boom with 5 stages";

const SCHEMA_HELP: &str = "\
Example:
  slideway schema > slideway.schema.json
and then as the first line of a model file, for editors that understand it:
  #:schema ./slideway.schema.json";

const COMPLETIONS_HELP: &str = "\
Examples:
  slideway completions bash > ~/.local/share/bash-completion/completions/slideway
  slideway completions zsh > ~/.zfunc/_slideway
  slideway completions fish > ~/.config/fish/completions/slideway.fish";

/// Arguments of `slideway solve`.
#[derive(Debug, Args)]
pub(crate) struct SolveArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Form of the answer.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,

    #[command(flatten)]
    pub(crate) search: SearchArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// Arguments of `slideway limits`.
#[derive(Debug, Args)]
pub(crate) struct LimitsArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// What to vary: a parameter, a coordinate, or `friction` for the factor of all coefficients of friction.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: String,

    /// Look at motion in the opposite direction, too.
    #[arg(long)]
    pub(crate) both_directions: bool,

    /// Modes end where a normal force exceeds this (N).
    #[arg(long, value_name = "N", value_parser = positive)]
    pub(crate) max_reaction: Option<f64>,

    /// Form of the answer.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// A positive number.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("it must be a positive number".to_owned()),
    }
}

/// Arguments of `slideway check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Form of the findings.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// Arguments of `slideway hold`.
#[derive(Debug, Args)]
pub(crate) struct HoldArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Multiply this load by a factor, and say which factors are held.
    #[arg(long, value_name = "NAME")]
    pub(crate) load: Option<String>,

    /// Find the value of this parameter of static friction from which on the load is held however great it is;
    /// without it, the factor of all static coefficients.
    #[arg(long, value_name = "NAME", requires = "load")]
    pub(crate) vary: Option<String>,

    /// What the drives do.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) drives: Drives,

    /// Form of the answer.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// What drives do at rest.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Drives {
    /// They are absent.
    #[default]
    Release,
    /// They hold their coordinates, with whatever effort it takes.
    Hold,
}

/// Arguments of `slideway modes`.
#[derive(Debug, Args)]
pub(crate) struct ModesArguments {
    /// The problem (JSON or .npz), or `-` for standard input.
    #[arg(value_name = "PROBLEM")]
    pub(crate) file: PathBuf,

    /// Form of the answer; without it the ending of the output file tells (.json, .npz), else text.
    #[arg(long, value_enum)]
    format: Option<ModesFormat>,

    #[command(flatten)]
    pub(crate) search: SearchArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// What a search for solutions may cost, and how much of it is told.
#[derive(Debug, Args)]
pub(crate) struct SearchArguments {
    /// List at most so many solutions; all are counted.
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub(crate) max_solutions: usize,

    /// End the search after so many nodes; the answer is then partial.
    #[arg(long, value_name = "N")]
    max_nodes: Option<u64>,

    /// End the search after this time (30s, 500ms, 2min, 1.5h); the answer is then partial.
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time_limit: Option<Duration>,
}

impl SearchArguments {
    /// The options of the search.
    pub(crate) fn options(&self) -> SearchOptions {
        let defaults = SearchOptions::default();
        SearchOptions { nodes: self.max_nodes.unwrap_or(defaults.nodes), ..defaults }
    }
}

impl ModesArguments {
    /// The form that is asked for.
    pub(crate) fn format(&self) -> ModesFormat {
        let ending = self.destination.output.as_ref().and_then(|path| path.extension()?.to_str());
        self.format.unwrap_or(match ending {
            Some("json") => ModesFormat::Json,
            Some("npz") => ModesFormat::Npz,
            _ => ModesFormat::Text,
        })
    }
}

/// A time such as 30s, 500ms, 2min, 1.5h; seconds without a unit.
fn duration(text: &str) -> Result<Duration, String> {
    let number = text.trim_end_matches(char::is_alphabetic);
    let factor = match &text[number.len()..] {
        "ms" => 1e-3,
        "s" | "" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        unit => return Err(format!("the unit `{unit}` is none of ms, s, min, h")),
    };
    let seconds = number.trim_end().parse::<f64>().map_err(|_| format!("`{number}` is not a number"))?;
    Duration::try_from_secs_f64(seconds * factor).map_err(|_| "it must be a positive time".to_owned())
}

/// Arguments of `slideway models`.
#[derive(Debug, Args)]
pub(crate) struct ModelsArguments {
    /// The model to write; without it they are listed.
    pub(crate) name: Option<String>,

    /// Number of stages of the telescopic boom, 1 to 1000.
    #[arg(long, value_name = "N", requires = "name")]
    pub(crate) stages: Option<usize>,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// A model and what is changed in it.
#[derive(Debug, Args)]
pub(crate) struct ModelArguments {
    /// The model file (TOML), or `-` for standard input.
    #[arg(value_name = "MODEL")]
    pub(crate) file: PathBuf,

    /// Give a parameter another value: a number, a quantity with a unit, or an expression of parameters.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,

    /// Move the mechanism to this value of a coordinate.
    #[arg(long, value_name = "COORDINATE=VALUE")]
    at: Vec<String>,

    /// Give a coordinate this rate of change.
    #[arg(long, value_name = "COORDINATE=VALUE")]
    rate: Vec<String>,

    /// Time of the state, `t` in expressions.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    time: Option<String>,
}

impl ModelArguments {
    /// Sees to it that the output does not take the place of the model.
    ///
    /// # Errors
    /// If both are the same file.
    pub(crate) fn spare(&self, destination: &Destination) -> Result<(), Failure> {
        let Some(output) = &destination.output else { return Ok(()) };
        match (self.file.canonicalize(), output.canonicalize()) {
            (Ok(model), Ok(file)) if model == file => Err(Failure::OverwritesModel { path: output.clone() }),
            _ => Ok(()),
        }
    }

    /// The settings, and the faults of those that are not of the form name=value.
    pub(crate) fn settings(&self) -> (Settings, Vec<Fault>) {
        let mut settings = Settings::default();
        let mut faults = Vec::new();
        let kinds = [
            (SettingKind::Parameter, &self.set),
            (SettingKind::Position, &self.at),
            (SettingKind::Rate, &self.rate),
        ];
        for (kind, texts) in kinds {
            for text in texts {
                faults.extend(settings.push(kind, text).err());
            }
        }
        match &self.time {
            Some(time) => (settings.time(time), faults),
            None => (settings, faults),
        }
    }
}

/// Where the answer goes.
#[derive(Debug, Args)]
pub(crate) struct Destination {
    /// Write to this file instead of standard output; the file is written whole or not at all.
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,

    /// Overwrite the output file if it exists.
    #[arg(long, requires = "output")]
    pub(crate) force: bool,
}

/// Form of an answer.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Words and aligned numbers, for people.
    #[default]
    Text,
    /// The whole report, for programs.
    Json,
    /// One row for each number, for tables.
    Csv,
}

/// Form of the findings of a check.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    /// Words, for people.
    #[default]
    Text,
    /// The whole report, for programs.
    Json,
}

/// Form of the answer to a problem given by matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ModesFormat {
    /// Words and aligned numbers, for people.
    Text,
    /// The whole report, for programs.
    Json,
    /// A NumPy archive.
    Npz,
}

/// When to use colours.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    /// On terminals.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

impl From<Color> for ColorChoice {
    fn from(color: Color) -> Self {
        match color {
            Color::Auto => Self::Auto,
            Color::Always => Self::Always,
            Color::Never => Self::Never,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units() {
        let table =
            [("30s", 30.0), ("500ms", 0.5), ("2min", 120.0), ("1.5h", 5400.0), ("7", 7.0), ("0", 0.0)];
        for (text, seconds) in table {
            assert_eq!(duration(text), Ok(Duration::from_secs_f64(seconds)), "{text}");
        }
        for text in ["", "s", "-1s", "1 day", "1e400", "nan", "inf", "s30"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }
}
