//! Figures of a motion: quantities over time with the contact modes as bands, and the phase portrait.

use crate::drawing::signs;
use crate::plot::{Axis, Band, Branch, Curve, Figure, Panel, Stroke};
use crate::theme::LIGHT;
use slideway::motion::{History, PhaseInterval, Series};
use slideway::units::{Unit, Units};

/// Points of a curve, shared among the phases.
const POINTS: f64 = 1500.0;
/// Phases that are drawn one by one; of more, those for whose jumps there is no room are drawn together.
const PIECES: usize = 250;
/// Points of a phase at least: its curve in a phase portrait may be long.
const LEAST: usize = 24;
/// The end of a phase is read so much before its end, as a part of it: forces may jump there.
const BEFORE_END: f64 = 1e-9;

/// The figure of a motion over time: coordinates, normal forces with the contact modes as bands, energies.
pub fn motion_figure(history: &History) -> Figure {
    let samples = Samples::of(history);
    let mut builder = Builder { samples: &samples, units: &history.mechanism.units, branches: Vec::new() };
    let mechanism = &history.mechanism;
    let mut panels = Vec::new();
    for (angles, unit) in [(false, "m"), (true, "rad")] {
        let coordinates =
            mechanism.coordinates.iter().filter(|coordinate| coordinate.kind.is_angle() == angles);
        let curves: Vec<(String, String)> = coordinates
            .map(|coordinate| (coordinate.name.to_string(), coordinate.name.to_string()))
            .collect();
        if !curves.is_empty() {
            panels.push(builder.panel("Coordinates", ("coordinate", unit), &curves));
        }
    }
    let contacts = mechanism.contacts.iter();
    let forces: Vec<(String, String)> = contacts
        .map(|contact| (contact.name.to_string(), format!("{}.normal_force", contact.name)))
        .collect();
    let mut panel = builder.panel("Normal forces and contact modes", ("normal force", "N"), &forces);
    panel.bands = bands(history, builder.branches.len());
    panels.push(panel);
    let energies = [
        ("kinetic energy", "energy.kinetic"),
        ("potential energy", "energy.potential"),
        ("dissipated by friction", "energy.friction"),
        ("work of loads", "energy.loads"),
        ("work of drives", "energy.drives"),
        ("lost in impulses", "energy.impulses"),
    ];
    let energies: Vec<(String, String)> = energies
        .iter()
        .filter(|(_, column)| samples.is_used(column))
        .map(|(name, column)| ((*name).to_owned(), (*column).to_owned()))
        .collect();
    panels.push(builder.panel("Energy", ("energy", "J"), &energies));
    Figure {
        title: mechanism.title.clone().unwrap_or_default(),
        subtitle: format!(
            "Modes: signs of the normal forces of {}; = where the joint sticks",
            names(history)
        ),
        panels,
        branches: builder.branches,
        quantities: vec![String::new()],
    }
}

/// The phase portrait: the rate of every coordinate over its value.
pub fn portrait_figure(history: &History) -> Figure {
    let samples = Samples::of(history);
    let coordinates = history.mechanism.coordinates.iter().enumerate();
    let panel = |(index, coordinate): (usize, &slideway::mechanism::Coordinate)| {
        let name = &coordinate.name;
        let si = if coordinate.kind.is_angle() { "rad" } else { "m" };
        let units = &history.mechanism.units;
        let shown_in = [units.of(si), units.of_rate(si)];
        let axis = |name: String, unit: &Unit| Axis { name, unit: unit.name().to_owned(), ..Axis::default() };
        let rate = format!("{name}.rate");
        let pieces = samples.pieces.iter().map(|piece| curve(piece, [name, &rate], &shown_in, index));
        Panel {
            x: axis(name.to_string(), &shown_in[0]),
            y: axis(format!("rate of {name}"), &shown_in[1]),
            curves: pieces.collect(),
            ..Panel::default()
        }
    };
    Figure {
        title: history.mechanism.title.clone().unwrap_or_default(),
        panels: coordinates.clone().map(panel).collect(),
        branches: coordinates.map(|(index, coordinate)| branch(&coordinate.name, index)).collect(),
        quantities: vec![String::new()],
        ..Figure::default()
    }
}

fn names(history: &History) -> String {
    let names: Vec<&str> = history.mechanism.contacts.iter().map(|contact| &*contact.name).collect();
    names.join(", ")
}

/// Colours that have been used are told apart by dashes.
fn branch(name: &str, colour: usize) -> Branch {
    let stroke = if colour < LIGHT.series.len() { Stroke::Solid } else { Stroke::Dashed };
    Branch { name: name.to_owned(), colour, stroke }
}

/// A motion, phase by phase, so that jumps at events stay jumps.
struct Samples {
    pieces: Vec<Series>,
    range: [f64; 2],
}

impl Samples {
    fn of(history: &History) -> Self {
        let range = [history.start(), history.stop()];
        let whole = range[1] - range[0];
        let groups = groups(history);
        let least = if groups.iter().any(|group| group.len() > 1) { 2 } else { LEAST };
        let times = |phase: &&PhaseInterval| {
            let (from, length) = (phase.from, phase.to - phase.from);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of POINTS")]
            let points = ((POINTS * length / whole) as usize).max(least);
            let last = length * (1.0 - BEFORE_END);
            (0..=points).map(move |point| from + last * point as f64 / points as f64)
        };
        let piece =
            |group: &Vec<&PhaseInterval>| history.series(&group.iter().flat_map(times).collect::<Vec<f64>>());
        Self { pieces: groups.iter().map(piece).collect(), range }
    }

    /// Whether a column has another number than zero.
    fn is_used(&self, name: &str) -> bool {
        let columns = self.pieces.iter().filter_map(|piece| piece.column(name));
        columns.flat_map(|column| column.values.iter().flatten()).any(|value| *value != 0.0)
    }
}

/// Phases that are drawn as one piece: each by itself, or where there are too many, neighbours for whose
/// jumps there is no room.
fn groups(history: &History) -> Vec<Vec<&PhaseInterval>> {
    let phases: Vec<&PhaseInterval> = history.phases.iter().filter(|phase| phase.to > phase.from).collect();
    let shortest =
        if phases.len() > PIECES { (history.stop() - history.start()) / PIECES as f64 } else { 0.0 };
    let mut groups: Vec<Vec<&PhaseInterval>> = Vec::new();
    for phase in phases {
        match groups.last_mut() {
            Some(group) if group[group.len() - 1].to - group[0].from < shortest => group.push(phase),
            _ => groups.push(vec![phase]),
        }
    }
    groups
}

struct Builder<'s> {
    samples: &'s Samples,
    units: &'s Units,
    branches: Vec<Branch>,
}

impl Builder<'_> {
    /// A panel with the time as its axis; curves are given by their names and columns.
    fn panel(&mut self, title: &str, (name, unit): (&str, &str), curves: &[(String, String)]) -> Panel {
        let mut drawn = Vec::new();
        let shown_in = [Unit::si_unit("s"), self.units.of(unit)];
        for (name, column) in curves {
            let index = self.branches.len();
            self.branches.push(branch(name, index));
            let pieces = self.samples.pieces.iter();
            drawn.extend(pieces.map(|piece| curve(piece, ["t", column], &shown_in, index)));
        }
        Panel {
            title: title.to_owned(),
            x: Axis {
                name: "t".to_owned(),
                unit: "s".to_owned(),
                range: Some(self.samples.range),
                ..Axis::default()
            },
            y: Axis { name: name.to_owned(), unit: shown_in[1].name().to_owned(), ..Axis::default() },
            curves: drawn,
            ..Panel::default()
        }
    }
}

/// One column over another, each in its unit.
fn curve(series: &Series, [x, y]: [&str; 2], [x_unit, y_unit]: &[Unit; 2], branch: usize) -> Curve {
    let values = |name: &str| series.column(name).map_or(&[][..], |column| &column.values);
    let pairs = values(x).iter().zip(values(y));
    let points =
        pairs.filter_map(|(x, y)| Some([x_unit.number_of((*x)?), y_unit.number_of((*y)?)])).collect();
    Curve { branch, quantity: 0, points, ends: <[crate::plot::End; 2]>::default() }
}

/// The contact modes along the time, in colours from this one on: those before it are the curves' of the same
/// panel.
fn bands(history: &History, first: usize) -> Vec<Band> {
    let mut meanings: Vec<String> = Vec::new();
    let mut bands: Vec<Band> = Vec::new();
    for group in groups(history) {
        let pattern = group[0].phase.pattern(&history.mechanism);
        let is_one = group.iter().all(|phase| phase.phase.pattern(&history.mechanism) == pattern);
        let meaning = if is_one {
            format!("mode {}", signs(&pattern))
        } else {
            "modes too short to be distinguished".to_owned()
        };
        let to = group[group.len() - 1].to;
        if let Some(last) = bands.last_mut().filter(|last| last.meaning == meaning) {
            last.to = to;
            continue;
        }
        let known = meanings.iter().position(|known| *known == meaning);
        let colour = first
            + known.unwrap_or_else(|| {
                meanings.push(meaning.clone());
                meanings.len() - 1
            });
        bands.push(Band { from: group[0].from, to, colour, meaning });
    }
    bands
}
