//! The contents of a map, for those who draw it by other means than SVG.

use super::colours::paint;
use super::{draws_model, shown, told, untold_modes};
use crate::changes::changes;
use crate::plot::figure::headline;
use crate::plot::{Axis, Hatching};
use crate::theme::Theme;
use serde::Serialize;
use slideway::map::{MapAxis, MapReport};
use slideway::model::Settings;

/// A map in words and colours; its pixels are those of the report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnMap {
    /// Headline.
    pub(crate) title: String,
    /// A line below it that tells what was changed in the model; may be empty.
    pub(crate) subtitle: String,
    /// The horizontal axis, with its range.
    pub(crate) x: Axis,
    /// The vertical axis, with its range.
    pub(crate) y: Axis,
    /// The classes, in the order of the report.
    pub(crate) classes: Vec<DrawnClass>,
    /// The meanings of signs of modes that no class states, for the end of the legend.
    pub(crate) modes: Vec<String>,
    /// The values of the model, in the units of the axes; absent if they are not on the map.
    pub(crate) model: Option<[f64; 2]>,
}

/// A class of points.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DrawnClass {
    /// Its colour, as a CSS colour.
    pub(crate) fill: &'static str,
    /// How it is hatched, if it is.
    pub(crate) hatching: Option<Hatching>,
    /// Its meaning and its share of the map, for the legend.
    pub(crate) text: String,
}

/// The map of a model with these settings in words and colours.
pub fn drawn(report: &MapReport, settings: &Settings, theme: &Theme) -> DrawnMap {
    let all = report.classes.iter().map(|class| class.pixels).sum();
    let classes = report.classes.iter().map(|class| {
        let paint = paint(&report.classes, class, theme);
        DrawnClass { fill: paint.fill, hatching: paint.hatching, text: told(class, all) }
    });
    DrawnMap {
        title: headline(report.title.as_deref(), &shown(report)),
        subtitle: changes(settings),
        x: axis(&report.x),
        y: axis(&report.y),
        classes: classes.collect(),
        modes: untold_modes(report),
        model: draws_model(report).then(|| [&report.x, &report.y].map(|axis| axis.value / axis.scale)),
    }
}

fn axis(axis: &MapAxis) -> Axis {
    Axis {
        name: axis.name.clone(),
        unit: axis.unit.clone(),
        range: Some([axis.from / axis.scale, axis.to / axis.scale]),
        logarithmic: false,
    }
}
