//! `slideway simulate`

use super::values::{choice, positive};
use super::{CheckFormat, Destination, ModelArguments, PlotArguments, TimeArguments};
use clap::{Args, ValueEnum};
use slideway::choice::Choice;
use slideway::motion::ImpactLaw;
use std::path::PathBuf;

pub(super) const HELP: &str = "\
Examples:
  slideway simulate frictional-oscillator.toml --until 3s
  slideway simulate stick-slip.toml --until 10s --plot stick-slip.svg
  slideway simulate stick-slip.toml --until 10s --animate stick-slip.html
  slideway simulate slider-crank.toml --until 0.2s --step 0.1ms -o motion.csv
  slideway simulate klepp-2002-spring.toml --until 10s --set mu_1=0.6 \\
    --mode \"- + +\"
  slideway simulate klepp-2002-spring.toml --until 1s --set mu_1=0.6 \\
    --all-branches

Exit codes:
  0    reached the end time, an event that ends the motion, or a limit of travel
  1    friction locks the mechanism: it cannot continue; a jam after which it
       stays at rest is an event, and no end
  2    invalid input: the model, the settings, the arguments, or a load without
       a value at some time
  3    not finished: too many steps or events, no time left, or what follows
       cannot be decided
  130  interrupted (Ctrl-C)

The motion up to the end is always printed and written, unless it cannot begin.
After an interruption the table goes to FILE.partial, and there are no pictures.";

/// Arguments of `slideway simulate`.
#[derive(Debug, Args)]
pub(crate) struct SimulateArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// When to end, such as 10s, `500 ms` or an expression in parameters.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) until: String,

    /// The initial contact mode: + or - (sign of the normal force), 0 (preload gap) or = (sticks) for each
    /// contact, then + or - (sense in which it turns) or = for each hinge with friction.
    #[arg(long, value_name = "MODE", allow_hyphen_values = true)]
    pub(crate) mode: Option<String>,

    /// Which of several possible modes to take at each decision, counted from 1. Decisions after the last one take
    /// the preferred mode.
    #[arg(long, value_name = "N,M,...", value_delimiter = ',', value_parser = branch)]
    pub(crate) branch: Vec<usize>,

    /// Which of several possible modes to prefer.
    #[arg(long, value_enum, default_value_t, value_name = "WHICH")]
    pub(crate) prefer: Preference,

    /// The law of friction in impacts on the faces of contacts that may lift off.
    #[arg(long, default_value = ImpactLaw::default().word(), value_parser = choice::<ImpactLaw>(), value_name = "LAW")]
    pub(crate) impacts: ImpactLaw,

    /// Follow every branch wherever several modes are possible.
    #[arg(long)]
    pub(crate) all_branches: bool,

    /// The most motions that --all-branches follows.
    #[arg(long, value_name = "N", default_value = "32", value_parser = count, requires = "all_branches")]
    pub(crate) max_motions: usize,

    /// Write the motion as a table: FILE.csv, FILE.npz, or FILE.json for the report with the table in it.
    #[command(flatten)]
    pub(crate) destination: Destination,

    /// Step of the table, such as 1ms; by default the steps of the solver.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) step: Option<String>,

    #[command(flatten)]
    pub(crate) plot: PlotArguments,

    /// Plot the rate of each coordinate over its value.
    #[arg(long, requires = "plot")]
    pub(crate) phase_portrait: bool,

    /// Animate the mechanism, with exaggerated contact modes: FILE.html, FILE.svg, or FILE.gif for mail and
    /// slides. At most 25 frames per second and 400 in all; a GIF has at most 1000 pixels on each side.
    #[arg(long, value_name = "FILE")]
    pub(crate) animate: Option<PathBuf>,

    /// How many seconds of animation each second of motion takes.
    #[arg(long, value_name = "FACTOR", value_parser = positive, requires = "animate")]
    pub(crate) slow_motion: Option<f64>,

    /// Print all events, even of long logs.
    #[arg(long)]
    pub(crate) all_events: bool,

    /// Relative error that each step may have.
    #[arg(long, value_name = "ERROR", default_value = "1e-8", value_parser = positive)]
    pub(crate) tolerance: f64,

    /// The longest step of the solver; by default a thousandth of the duration.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) longest_step: Option<String>,

    /// End after N steps of the solver.
    #[arg(long, value_name = "N", default_value = "1000000", value_parser = count)]
    pub(crate) max_steps: usize,

    /// End after N events.
    #[arg(long, value_name = "N", default_value = "100000", value_parser = count)]
    pub(crate) max_events: usize,

    /// The mechanism counts as locked if a normal force exceeds this (N).
    #[arg(long, value_name = "N", value_parser = positive)]
    pub(crate) max_reaction: Option<f64>,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    /// Form of the report.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,
}

/// Which of several possible modes is preferred.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Preference {
    /// What continues the motion; otherwise sticking before sliding, attainable before unattainable.
    #[default]
    Rule,
    /// The mode in which the fewest joints stick.
    Sliding,
}

fn branch(text: &str) -> Result<usize, String> {
    count(text.trim()).map(|number| number - 1)
}

fn count(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err("it must be a whole number from 1 on".to_owned()),
    }
}
