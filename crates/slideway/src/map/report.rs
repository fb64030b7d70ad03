//! Report on a map: plain data, which are the JSON output.

use super::class::{ClassKey, ClassMeaning};
use super::evaluate::Evaluator;
use super::refine::Raster;
use super::{Axis, ColourBy, MapOptions, effort};
use crate::limits::Naming;
use crate::model::Model;
use crate::progress::Work;
use crate::report::number::number;
use crate::report::page::Page;
use crate::report::{Answered, NO_DRIVE, Report, SpeedChange, Style, indented, precise, spaced};
use crate::units::Unit;
use crate::units::number::{brief, counted};
use serde::Serialize;

/// Version of the layout of a [`MapReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/map/1";

/// A map of pixels and what their classes mean.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct MapReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// The title of the model.
    pub title: Option<String>,
    /// Property that the colours show.
    pub colour_by: ColourBy,
    /// From left to right.
    pub x: MapAxis,
    /// From bottom to top.
    pub y: MapAxis,
    /// The classes that occur.
    pub classes: Vec<MapClass>,
    /// Number of points that were solved.
    pub points: usize,
    /// Account, in words, of what can have been missed.
    pub guarantee: String,
    /// Remark on what its colours do not show; absent if there is nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remark: Option<String>,
    /// Rows of pixels from bottom to top: each as pairs of a class, counted from 0, and the number of pixels
    /// it has on end.
    pub rows: Vec<Vec<[usize; 2]>>,
}

/// An axis of a map.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct MapAxis {
    /// Its name.
    pub name: String,
    /// Where it begins (SI units).
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Its value in the model.
    pub value: f64,
    /// Number of pixels.
    pub pixels: usize,
    /// The unit in which it is to be shown; empty for pure numbers.
    pub unit: String,
    /// Size of that unit in SI units.
    pub scale: f64,
    /// Unit for texts and pictures: `unit` and `scale` in one.
    #[serde(skip)]
    pub shown_in: Unit,
}

/// A class of points.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct MapClass {
    /// Property that its points have in common.
    pub meaning: ClassMeaning,
    /// Words for that property.
    pub words: String,
    /// For modes: each of them in words.
    pub modes: Vec<String>,
    /// Number of its pixels.
    pub pixels: usize,
}

impl MapReport {
    /// The class of a pixel, counted from the lower left corner.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn class_at(&self, column: usize, row: usize) -> usize {
        let mut end = 0;
        let run = self.rows[row].iter().find(|[_, length]| {
            end += length;
            column < end
        });
        run.expect("a pixel of the map")[0]
    }

    /// The classes of all pixels, row by row from the bottom.
    pub fn pixels(&self) -> Vec<usize> {
        let runs = self.rows.iter().flatten();
        runs.flat_map(|&[class, length]| std::iter::repeat_n(class, length)).collect()
    }
}

/// So many classes are named in the answer.
const NAMED: usize = 3;

impl Report for MapReport {
    /// The classes with the greatest shares: "66.7 % of the map: one solution. 33.3 %: no solution, friction locks it."
    fn answer(&self) -> String {
        let pixels = (self.x.pixels * self.y.pixels) as f64;
        let mut classes: Vec<&MapClass> = self.classes.iter().collect();
        classes.sort_by_key(|class| std::cmp::Reverse(class.pixels));
        let one = |(place, class): (usize, &&MapClass)| {
            let of = if place == 0 { " of the map" } else { "" };
            let share = brief(100.0 * class.pixels as f64 / pixels);
            format!("{share} %{of}: {}.", class.words.replace(": ", ", "))
        };
        let mut sentences: Vec<String> = classes.iter().enumerate().take(NAMED).map(one).collect();
        if classes.len() > NAMED {
            sentences.push(match classes.len() - NAMED {
                1 => "One more class.".to_owned(),
                more => format!("{more} more classes."),
            });
        }
        sentences.join(" ")
    }

    /// The axes, and which part of the plane each class has.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        if let Some(title) = &self.title {
            text.headline(title);
        }
        for axis in [&self.x, &self.y] {
            let (from, to) = (axis.shown_in.precise_number(axis.from), axis.shown_in.precise(axis.to));
            text.line(&format!("{} from {from} to {to}", axis.name));
        }
        text.line("");
        text.headline(&self.answer());
        let pixels = (self.x.pixels * self.y.pixels) as f64;
        for class in &self.classes {
            let share = number(100.0 * class.pixels as f64 / pixels);
            text.line(&format!("  {share:>9} %  {}", class.words));
            class.modes.iter().for_each(|mode| text.line(&format!("               {mode}")));
        }
        text.line(match (text.is_verbose(), self.points == self.x.pixels * self.y.pixels) {
            (true, _) => &self.guarantee,
            (false, true) => "Every pixel was solved.",
            (false, false) => "Sampled: a small region between the points that were solved can be missed.",
        });
        self.remark.iter().for_each(|remark| text.line(remark));
        text.text()
    }

    /// Indented but for the rows, of which each has a line.
    fn json(&self) -> String {
        let row = |row: &Vec<[usize; 2]>| serde_json::to_string(row).unwrap_or_default();
        let rows: Vec<String> = self.rows.iter().map(row).collect();
        let empty = indented(&Answered::of(&Self { rows: Vec::new(), ..self.clone() }));
        empty.replace("\"rows\": []", &format!("\"rows\": [\n    {}\n  ]", rows.join(",\n    ")))
    }
}

/// The report of a raster; its rows end where the work is to end.
pub(super) fn report(
    (model, options): (&Model, &MapOptions),
    axes: &[Axis; 2],
    evaluator: &Evaluator<'_>,
    raster: &Raster<ClassKey>,
    work: Work<'_>,
) -> MapReport {
    let names = Naming::new(model).ok();
    let mut order: Vec<usize> = (0..raster.classes.len()).collect();
    let meaning = |index: usize| &raster.classes[index].0;
    order.sort_by(|&one, &other| {
        meaning(one).partial_cmp(meaning(other)).unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(new, &old)| place[old] = new);
    let mut counts = vec![0; order.len()];
    let row = |classes: &[u32]| -> Vec<[usize; 2]> {
        let row = runs(classes).into_iter().map(|[class, length]| [place[class], length]);
        row.inspect(|&[class, length]| counts[class] += length).collect()
    };
    let lines = raster.pixels.chunks(raster.grid.width).take_while(|_| !work.is_over());
    let rows = lines.map(row).collect();
    let classes = order
        .iter()
        .zip(&counts)
        .map(|(&old, &pixels)| MapClass {
            words: words(meaning(old), model),
            modes: modes(meaning(old), names.as_ref()),
            meaning: meaning(old).clone(),
            pixels,
        })
        .collect();
    let axis = |axis: &Axis, pixels: usize| MapAxis {
        name: axis.varied.name.clone(),
        from: axis.range[0],
        to: axis.range[1],
        value: axis.varied.present().unwrap_or_default(),
        pixels,
        unit: axis.varied.shown_in.name().to_owned(),
        scale: axis.varied.shown_in.scale(),
        shown_in: axis.varied.shown_in.clone(),
    };
    MapReport {
        schema: SCHEMA,
        title: model.title.clone(),
        colour_by: options.colour_by,
        x: axis(&axes[0], raster.grid.width),
        y: axis(&axes[1], raster.grid.height),
        classes,
        points: raster.solved,
        remark: remark(model, options.colour_by),
        guarantee: guarantee(raster, options.colour_by, evaluator.is_bilinear()),
        rows,
    }
}

/// Locking and margins against it are questions to motions that are prescribed.
fn remark(model: &Model, colour_by: ColourBy) -> Option<String> {
    let of_locking = matches!(colour_by, ColourBy::Jam | ColourBy::Margin);
    (of_locking && model.drives.is_empty()).then(|| NO_DRIVE.to_owned())
}

fn guarantee(raster: &Raster<ClassKey>, colour_by: ColourBy, is_bilinear: bool) -> String {
    let source = if colour_by == ColourBy::Hold {
        "Whether it holds was decided at every point, without the rates and drives of the model."
    } else if is_bilinear {
        "The equations are linear in each of both quantities, so their numbers were interpolated."
    } else {
        "The mechanism was assembled at every point."
    };
    let missed = match raster.grid.probe {
        1 => "Every pixel was solved.".to_owned(),
        probe => format!(
            "A point was solved every {probe} pixels and midway between: a region between such points that touches no known boundary is missed."
        ),
    };
    format!("{source} {missed}")
}

/// Pairs of a class and a number of pixels.
fn runs(row: &[u32]) -> Vec<[usize; 2]> {
    let runs = row.chunk_by(|one, next| one == next);
    runs.map(|run| [run[0] as usize, run.len()]).collect()
}

fn words(meaning: &ClassMeaning, model: &Model) -> String {
    let without = |tips: bool| if tips { "a guided slider tips" } else { "friction locks it" };
    match meaning {
        ClassMeaning::Locked => format!("no solution: {}", without(false)),
        ClassMeaning::Tips => format!("no solution: {} (model it as a block slider)", without(true)),
        ClassMeaning::Solutions { solutions, preload_gap_states, tipping } => {
            let gaps = match preload_gap_states {
                0 => String::new(),
                1 => ", one preload-gap state".to_owned(),
                several => format!(", {} preload-gap states", counted(*several)),
            };
            match (solutions, tipping) {
                (0, _) => format!("no solution{gaps}"),
                (several, 0) => format!("{}{gaps}", solutions_in_words(*several)),
                (several, _) => {
                    format!("{}{gaps}: {}", solutions_in_words(*several), tips(*tipping, *several))
                }
            }
        }
        ClassMeaning::Modes { patterns } => {
            patterns.iter().map(|pattern| spaced(pattern)).collect::<Vec<_>>().join(" | ")
        }
        ClassMeaning::Starts { starts } => starts.join(" | "),
        ClassMeaning::Margin { from: 1.0, to: Some(to) } => {
            format!("one solution; friction may grow up to {} times", precise(*to))
        }
        ClassMeaning::Margin { from, to: Some(to) } => {
            format!("one solution; friction may grow {} to {} times", precise(*from), precise(*to))
        }
        ClassMeaning::Margin { from, to: None } => {
            format!("one solution; friction may grow more than {} times", precise(*from))
        }
        ClassMeaning::Effort { from, to } => effort(model, *from, *to),
        ClassMeaning::Moves { as_in_model: true, opposite: true, .. } => {
            "can move in both directions".to_owned()
        }
        ClassMeaning::Moves { as_in_model: true, opposite: false, tips_opposite, .. } => {
            format!("can only move as in the model; in the opposite direction {}", without(*tips_opposite))
        }
        ClassMeaning::Moves { opposite: true, tips_as_in_model, .. } => {
            format!("can only move in the opposite direction; as in the model {}", without(*tips_as_in_model))
        }
        ClassMeaning::Moves { tips_as_in_model, tips_opposite, .. } if tips_as_in_model == tips_opposite => {
            format!("{} in both directions", without(*tips_opposite))
        }
        ClassMeaning::Moves { tips_as_in_model, tips_opposite, .. } => {
            let [there, back] = [tips_as_in_model, tips_opposite].map(|tips| without(*tips));
            format!("{there} as in the model, {back} in the opposite direction")
        }
        ClassMeaning::Motion { solutions, tipping } => {
            let of_solution = |changes: &Vec<SpeedChange>| {
                changes.iter().map(|change| change.in_words()).collect::<Vec<_>>().join(", ")
            };
            let each: Vec<String> = solutions.iter().map(of_solution).collect();
            let number = solutions_in_words(each.len());
            let tips = tips(*tipping, each.len());
            let changes = if each.iter().all(String::is_empty) { String::new() } else { each.join(" | ") };
            let parts: Vec<String> = [changes, tips].into_iter().filter(|part| !part.is_empty()).collect();
            format!("{number}: {}", parts.join("; "))
        }
        ClassMeaning::Rest { holds: Some(true), may_slip: true } => {
            "holds only if something has wedged it: do not rely on it".to_owned()
        }
        ClassMeaning::Rest { holds: Some(true), .. } => "holds".to_owned(),
        ClassMeaning::Rest { holds: Some(false), .. } => "does not hold".to_owned(),
        ClassMeaning::Rest { holds: None, .. } => "whether it holds is not decided".to_owned(),
        ClassMeaning::Undecided => "not decided: it is on the verge of jamming; take it as jammed".to_owned(),
        ClassMeaning::Continuum => "infinitely many solutions".to_owned(),
        ClassMeaning::TooLarge => "not decided: too many patterns".to_owned(),
        ClassMeaning::NotSolved { reason } => (*reason).to_owned(),
    }
}

/// "one solution", "three solutions"
fn solutions_in_words(solutions: usize) -> String {
    if solutions == 1 { "one solution".to_owned() } else { format!("{} solutions", counted(solutions)) }
}

/// "it tips", "it tips in 1 of them"; empty if it does not.
fn tips(tipping: usize, solutions: usize) -> String {
    match tipping {
        0 => String::new(),
        _ if tipping == solutions => "it tips".to_owned(),
        _ => format!("it tips in {tipping} of them"),
    }
}

/// Returns what the first drive needs: "push needs 20 to 25 N".
fn effort(model: &Model, from: Option<f64>, to: Option<f64>) -> String {
    let unit = effort::unit(model);
    let range = match (from, to) {
        (Some(from), Some(to)) => format!("{} to {}", unit.precise_number(from), unit.precise(to)),
        (Some(from), None) => format!("{} or more", unit.precise(from)),
        (None, Some(to)) => format!("less than {}", unit.precise(to)),
        (None, None) => format!("some {}", if unit.si() == "N" { "force" } else { "torque" }),
    };
    let name = model.drives.first().map_or_else(String::new, |drive| drive.name.to_string());
    format!("{name} needs {range}")
}

/// The contact modes of a class, one by one.
fn modes(meaning: &ClassMeaning, names: Option<&Naming>) -> Vec<String> {
    let (ClassMeaning::Modes { patterns }, Some(names)) = (meaning, names) else { return Vec::new() };
    patterns.iter().map(|pattern| names.in_words(pattern)).collect()
}
