//! The arguments of the command line.

use crate::failure::Failure;
use anstream::ColorChoice;
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use slideway::fault::Fault;
use slideway::model::{SettingKind, Settings};
use std::path::PathBuf;

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

Exit codes: 0 done, 1 no solution (friction locks the mechanism), 2 faulty input, 3 undecided.";

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Find all solutions of a mechanism in its state
    #[command(after_help = SOLVE_HELP)]
    Solve(SolveArguments),
    /// Say what a model consists of and whether it is sound
    #[command(after_help = CHECK_HELP)]
    Check(CheckArguments),
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

const CHECK_HELP: &str = "\
Examples:
  slideway check drawer.toml
  slideway check bracket-on-pole.toml --set mu=0.3
  slideway check drawer.toml --format json

Exit codes:
  0  the model is sound: `slideway solve` accepts it
  2  faulty input, or a finding for which `slideway solve` would refuse it";

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
    pub(crate) destination: Destination,
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
