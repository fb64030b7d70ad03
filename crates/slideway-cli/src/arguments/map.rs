//! `slideway map`

use super::values::choice;
use super::{Destination, ModelArguments, OpenArguments, PictureTheme, TimeArguments};
use clap::Args;
use slideway::choice::Choice;
use slideway::map::{ColourBy, GREATEST_SIZE};

pub(super) const HELP: &str = "\
Examples:
  slideway map drawer.toml --x mu=0..1 --y L=\"200 mm..500 mm\" --open
  slideway map klepp-2002.toml --x mu_1=0..0.8 --y mu_2=0..0.4 -o map.svg
  slideway map slider-crank.toml --x phi=\"-180 deg..180 deg\" --y mu=0..1 \\
    --colour-by jam --output crank.json
  slideway map bracket-on-pole.toml --x mu_static=0..0.5 --y x=\"0.1 m..0.5 m\" \\
    --colour-by hold --output hold.png

Exit codes:
  0    done
  2    invalid input: the model, the settings, the names, the ranges or the
       arguments
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway map`.
#[derive(Debug, Args)]
pub(crate) struct MapArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// From left to right: a parameter, a coordinate, or `friction` for a factor on all coefficients of
    /// friction. Without it, the quantities of the model are listed.
    #[arg(long, value_name = "NAME=FROM..TO")]
    pub(crate) x: Option<String>,

    /// From bottom to top: the same choices.
    #[arg(long, value_name = "NAME=FROM..TO")]
    pub(crate) y: Option<String>,

    /// What the colours show.
    #[arg(long, default_value = ColourBy::default().word(), value_parser = choice::<ColourBy>(), alias = "color-by")]
    pub(crate) colour_by: ColourBy,

    /// Pixels from left to right and from bottom to top.
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "400x400", value_parser = size)]
    pub(crate) size: [usize; 2],

    /// Pixels between probes: narrower regions may be missed; 1 solves every pixel.
    #[arg(long, value_name = "PIXELS", default_value_t = 8, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) probe: u16,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    /// Colours of the picture.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) theme: PictureTheme,

    #[command(flatten)]
    pub(crate) open: OpenArguments,

    /// Write to this file; its extension selects the format (.svg, .png or .json). By default it is an SVG file: on a
    /// terminal NAME-map.svg, elsewhere standard output.
    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// A size such as 400x300.
fn size(text: &str) -> Result<[usize; 2], String> {
    let wanted = || format!("it must be WIDTHxHEIGHT, each from 1 to {GREATEST_SIZE}, such as 400x300");
    let (width, height) = text.split_once('x').ok_or_else(wanted)?;
    let side = |text: &str| match text.trim().parse::<usize>() {
        Ok(side) if (1..=GREATEST_SIZE).contains(&side) => Ok(side),
        _ => Err(wanted()),
    };
    Ok([side(width)?, side(height)?])
}
