//! The arguments of the command line: one file for each command, and what commands share.

mod check;
mod destination;
mod draw;
mod drive;
mod hold;
mod import;
mod limits;
mod map;
mod model;
mod models;
mod modes;
mod new;
mod open;
mod plot;
mod questions;
mod report;
mod search;
mod simulate;
mod size;
mod solve;
mod sweep;
mod time;
mod values;

pub(crate) use check::CheckArguments;
pub(crate) use destination::{CheckFormat, Destination, Format};
pub(crate) use draw::{DrawArguments, Which};
pub(crate) use drive::DriveArguments;
pub(crate) use hold::{Drives, HoldArguments};
pub(crate) use import::ImportArguments;
pub(crate) use limits::LimitsArguments;
pub(crate) use map::MapArguments;
pub(crate) use model::ModelArguments;
pub(crate) use models::ModelsArguments;
pub(crate) use modes::{ModesArguments, ModesFormat};
pub(crate) use new::NewArguments;
pub(crate) use open::OpenArguments;
pub(crate) use plot::{PictureTheme, PlotArguments};
pub(crate) use questions::TEXT as QUESTIONS;
pub(crate) use report::ReportArguments;
pub(crate) use search::SearchArguments;
pub(crate) use simulate::{Preference, SimulateArguments};
pub(crate) use size::SizeArguments;
pub(crate) use solve::SolveArguments;
pub(crate) use sweep::{SweepArguments, table_endings};
pub(crate) use time::TimeArguments;

use anstream::ColorChoice;
use clap::{Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use std::path::PathBuf;

/// All solutions of planar mechanisms with dry friction in sliding joints.
///
/// Friction can lock a sliding mechanism or leave it several ways to move. slideway tries every contact mode
/// and lists all solutions: forces, accelerations, and on which side each slider touches its guide.
#[derive(Debug, Parser)]
#[command(name = "slideway", version, max_term_width = 100, after_help = AFTER_HELP)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,

    /// When to use colours; `auto` does so on terminals, and respects NO_COLOR and CLICOLOR_FORCE.
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN", display_order = 900)]
    pub(crate) color: Color,

    /// Show the details, too: signs, determinants, residuals, how the answer was found
    #[arg(long, short, global = true, display_order = 901)]
    pub(crate) verbose: bool,
}

const AFTER_HELP: &str = "\
Examples:
  slideway new                                    asks for a first model
  slideway new drawer --L 400mm --a 150mm         or writes it from a template
  slideway models drawer > drawer.toml            or from the gallery
  slideway solve drawer.toml                      does it jam, and which forces
  slideway solve drawer.toml --set mu=0.7         with more friction
  slideway limits drawer.toml --vary mu           at which friction it jams
  slideway size drawer.toml --vary L --margin 2   how long its guide must be
  slideway drive drawer.toml                      what push it needs
  slideway hold drawer.toml                       whether it stays at rest
  slideway simulate drawer.toml --until 1s        its motion over time
  slideway draw drawer.toml --open                a picture
  slideway report drawer.toml --open              all of it as a page
  slideway map drawer.toml --x mu=0..1 --y a=0..0.5      two quantities
  slideway sweep drawer.toml --vary mu=0..1:101          a table
  slideway import drawing.dxf -o drawer.toml      a model from a DXF drawing
  slideway modes problem.json                     an LCP or a similar problem
  slideway help questions                         which command for what

Exit codes: 0 done, 1 no solution (friction locks the mechanism),
2 invalid input, 3 undecided or out of time, 130 interrupted.";

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Write a model from a template, and answer its first question
    #[command(after_help = new::HELP)]
    New(NewArguments),
    /// Find all solutions of a mechanism: whether it moves, and the forces
    #[command(after_help = solve::HELP)]
    Solve(SolveArguments),
    /// Find at which friction, load or size it jams
    #[command(after_help = limits::HELP)]
    Limits(LimitsArguments),
    /// Find the dimension for a margin against jams and tipping
    #[command(after_help = size::HELP)]
    Size(SizeArguments),
    // Words that others use for the same are understood, but stand nowhere.
    /// Find the force or torque that each drive needs, and the efficiency
    #[command(after_help = drive::HELP, alias = "effort")]
    Drive(DriveArguments),
    /// Draw a map over two quantities: solutions, jams or margins
    #[command(after_help = map::HELP)]
    Map(MapArguments),
    /// Write a table of the solutions over a grid or random samples
    #[command(after_help = sweep::HELP, override_usage = sweep::USAGE, mut_arg("file", sweep::unless_merging))]
    Sweep(SweepArguments),
    /// Show what a model consists of and which questions it can answer
    #[command(after_help = check::HELP)]
    Check(CheckArguments),
    /// Decide whether a mechanism stays at rest, and under which loads
    #[command(after_help = hold::HELP, aliases = ["rest", "standstill"])]
    Hold(HoldArguments),
    /// Simulate a mechanism over time: it slides, sticks, tips and jams
    #[command(after_help = simulate::HELP)]
    Simulate(SimulateArguments),
    /// Draw a mechanism and its solutions as SVG or PNG
    #[command(after_help = draw::HELP)]
    Draw(DrawArguments),
    /// Write a page with drawing, solutions and limits, to mail or print
    #[command(after_help = report::HELP)]
    Report(ReportArguments),
    /// Find all solutions of an LCP or a similar problem, from matrices
    #[command(after_help = modes::HELP, aliases = ["matrices", "lcp"])]
    Modes(ModesArguments),
    /// List the gallery of models, or write one of them
    #[command(after_help = models::HELP)]
    Models(ModelsArguments),
    /// Make a model to complete from a DXF drawing
    #[command(after_help = import::HELP)]
    Import(ImportArguments),
    /// Print the JSON Schema of model files, for editors
    #[command(after_help = SCHEMA_HELP)]
    Schema,
    /// Say which command and which kind of model answers which question
    #[command(long_about = questions::TEXT, help_template = "{about}\n")]
    Questions,
    /// Print a completion script for a shell
    #[command(after_help = COMPLETIONS_HELP)]
    Completions {
        /// The shell.
        shell: Shell,
    },
    /// Write the manual pages of all commands, for packages
    #[command(hide = true)]
    Man {
        /// The folder for them, which must not exist.
        folder: PathBuf,
    },
}

const SCHEMA_HELP: &str = "\
Example:
  slideway schema > slideway.schema.json
and then as the first line of a model file, for editors that understand it:
  #:schema ./slideway.schema.json";

const COMPLETIONS_HELP: &str = "\
Examples:
  slideway completions bash > \\
    ~/.local/share/bash-completion/completions/slideway
  slideway completions zsh > ~/.zfunc/_slideway
  slideway completions fish > ~/.config/fish/completions/slideway.fish";

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
