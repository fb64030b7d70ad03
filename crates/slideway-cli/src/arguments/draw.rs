//! `slideway draw`

use super::values::positive;
use super::{Destination, ModelArguments, OpenArguments, PictureTheme, TimeArguments};
use clap::Args;

pub(super) const HELP: &str = "\
Examples:
  slideway draw drawer.toml                       on a terminal: into drawer.svg
  slideway draw drawer.toml --open                and shows it
  slideway draw drawer.toml --theme dark --output drawer.png
  slideway draw klepp-2002.toml --solution 2 --output two.png --width 1200
  slideway draw slider-crank.toml --at phi=\"150 deg\" --solution none

On a terminal, a drawing without --output goes into a new file that has the
name of the model. In a pipe it goes to standard output.

Exit codes:
  0    done
  2    invalid input: the model, the settings, the files or the arguments
  3    nothing was found within --time-limit
  130  interrupted (Ctrl-C)

After a time limit or an interruption, what was found is drawn, and the drawing
says that it is partial.";

/// Arguments of `slideway draw`.
#[derive(Debug, Args)]
pub(crate) struct DrawArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Which solutions to draw: the one with this number, `all` (the default), or `none` for the mechanism alone.
    #[arg(long, value_name = "N|all|none", value_parser = which)]
    pub(crate) solution: Option<Which>,

    /// Colours of the picture.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) theme: PictureTheme,

    /// Width of the picture in pixels. By default letters are 15 pixels high, and 30 in a PNG.
    #[arg(long, value_name = "PIXELS", value_parser = positive)]
    pub(crate) width: Option<f64>,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) open: OpenArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// Which solutions are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Which {
    /// All.
    All,
    /// None.
    None,
    /// The one of this number.
    Number(usize),
}

fn which(text: &str) -> Result<Which, String> {
    match text {
        "all" => Ok(Which::All),
        "none" => Ok(Which::None),
        number => match number.parse() {
            Ok(number) if number > 0 => Ok(Which::Number(number)),
            _ => Err("it must be the number of a solution, counted from 1, or `all` or `none`".to_owned()),
        },
    }
}
