//! Figures of a motion: quantities over time with the contact modes as bands, and the phase portrait.

use crate::drawing::signs;
use crate::plot::figure::headline;
use crate::plot::scale::{extent, range_that_shows};
use crate::plot::{
    Axis, Band, Branch, Curve, Figure, Hatching, MarkedPoint, MarkedValue, Panel, PointKind, Stroke, Zone,
};
use crate::theme::LIGHT;
use slideway::mechanism::Mechanism;
use slideway::motion::{Cause, History, JointPhase, PhaseInterval, Series, modes_in_words};
use slideway::report::precise;
use slideway::units::{Unit, Units};

/// Points of a curve, shared among the phases.
const POINTS: f64 = 1500.0;
/// Phases that are drawn one by one; of more, those for whose jumps there is no room are drawn together.
const PIECES: usize = 250;
/// Points of a phase at least: its curve in a phase portrait may be long.
const LEAST: usize = 24;
/// The end of a phase is read so much before its end, as a part of it: forces may jump there.
const BEFORE_END: f64 = 1e-9;
/// Share of a picture below which an extent counts as a point.
const POINT: f64 = 1e-6;
/// Forces that last only for this share of the time are left out, if they grow to so many times the others.
const RARE: f64 = 0.05;
/// The name of a curve that begins at 0.
const POTENTIAL: &str = "potential energy, from the start";
/// Beside what is so many times as large a curve is too flat to be read.
const MANY: f64 = 4.0;

/// The figure of a motion over time: coordinates, normal forces with the contact modes as bands, friction if joints stick
/// at times, energies. Lines mark where it jams; where joints stick and statics leaves forces open the panel is hatched.
///
/// Where normal forces grow for a short time to many times what they are else, as before a jam, the axis shows
/// the rest, and the legend tells what they reach.
pub fn motion_figure(history: &History) -> Figure {
    let samples = Samples::of(history);
    let mut builder = Builder { samples: &samples, units: &history.mechanism.units, branches: Vec::new() };
    let mechanism = &history.mechanism;
    let mut panels = Vec::new();
    for (angles, unit) in [(false, "m"), (true, "rad")] {
        let coordinates =
            mechanism.coordinates.iter().filter(|coordinate| coordinate.kind.is_angle() == angles);
        for together in samples.that_move_as_far(coordinates.map(|coordinate| coordinate.name.to_string())) {
            let curves = numbered(together.into_iter().map(|name| (name.clone(), name)));
            panels.push(match &curves[..] {
                [(name, ..)] => builder.panel(&format!("Coordinate {name}"), (name, unit), &curves),
                _ => builder.panel("Coordinates", ("coordinate", unit), &curves),
            });
        }
    }
    panels.extend(builder.gaps(history));
    panels.extend(builder.forces(history));
    panels.extend(builder.friction(history));
    let energies = [
        ("kinetic energy", "energy.kinetic"),
        (POTENTIAL, "energy.potential"),
        ("dissipated by friction", "energy.friction"),
        ("work of loads", "energy.loads"),
        ("work of drives", "energy.drives"),
        ("lost in impulses", "energy.impulses"),
    ];
    let energies = energies.iter().filter(|(_, column)| samples.is_used(column));
    let energies = numbered(energies.map(|(name, column)| ((*name).to_owned(), (*column).to_owned())));
    let mut energy = builder.panel("Energy", ("energy", "J"), &energies);
    from_zero(&mut energy.curves, &builder.branches);
    panels.push(energy);
    let jams = jams(history);
    panels.iter_mut().for_each(|panel| panel.marked.clone_from(&jams));
    Figure {
        title: headline(mechanism.title.as_deref(), "motion over time"),
        subtitle: format!("Modes: {}; = where the joint sticks", signs_of_modes(mechanism)),
        panels,
        branches: builder.branches,
        quantities: vec![String::new()],
        one_legend: false,
    }
}

/// Has the potential energy begin at 0: its height is arbitrary, and would flatten the others.
fn from_zero(curves: &mut [Curve], branches: &[Branch]) {
    let is_potential = |curve: &&mut Curve| branches[curve.branch].name == POTENTIAL;
    let mut curves: Vec<&mut Curve> = curves.iter_mut().filter(is_potential).collect();
    let start = curves.iter().flat_map(|curve| &curve.points).next().map_or(0.0, |first| first[1]);
    curves.iter_mut().flat_map(|curve| &mut curve.points).for_each(|point| point[1] -= start);
}

/// The phase portrait: the rate of every coordinate over its value, with arrowheads in the direction of time,
/// and marks where the motion begins, comes to rest, jams and ends. Where an impulse changes the rate, at a stop
/// or a jam, a dashed line leads from the rate before it to that after it.
pub fn portrait_figure(history: &History) -> Figure {
    let samples = Samples::of(history);
    let coordinates = history.mechanism.coordinates.iter();
    let units = &history.mechanism.units;
    let mut branches = Vec::new();
    let panel = |coordinate: &slideway::mechanism::Coordinate| {
        let name = coordinate.name.to_string();
        let si = if coordinate.kind.is_angle() { "rad" } else { "m" };
        let shown_in = [units.of(si), units.of_rate(si)];
        let axis = |name: String, unit: &Unit| Axis { name, unit: unit.name().to_owned(), ..Axis::default() };
        let (rate, column) = (format!("rate of {name}"), format!("{name}.rate"));
        let pieces = samples.pieces.iter();
        let mut curves: Vec<Curve> =
            pieces.map(|piece| curve(piece, [&name, &column], &shown_in, branches.len())).collect();
        branches.push(branch(&rate, 0));
        let points = points(history, &curves);
        let jumps = jumps(history, &curves, branches.len());
        if !jumps.is_empty() {
            branches.push(Branch { name: format!("{rate} jumps"), colour: 0, stroke: Stroke::Dashed });
        }
        curves.extend(jumps);
        Panel {
            x: axis(name, &shown_in[0]),
            y: axis(rate, &shown_in[1]),
            points,
            curves,
            directed: true,
            ..Panel::default()
        }
    };
    let panels = coordinates.map(panel).collect();
    Figure {
        title: headline(history.mechanism.title.as_deref(), "phase portrait"),
        panels,
        branches,
        quantities: vec![String::new()],
        ..Figure::default()
    }
}

/// Where a motion begins, comes to rest, jams and ends, in the portrait of a coordinate.
fn points(history: &History, curves: &[Curve]) -> Vec<MarkedPoint> {
    let point_size = point_size(curves);
    // A phase of no visible extent, at the rate zero, is a rest.
    let rests = |curve: &Curve| {
        let is_small = |axis: usize| {
            let extent = extent(curve.points.iter().map(|point| point[axis]));
            extent.is_some_and(|[least, greatest]| greatest - least <= point_size[axis])
        };
        is_small(0) && is_small(1) && curve.points.iter().all(|point| point[1].abs() <= point_size[1])
    };
    let mut points = Vec::new();
    let mut add =
        |at: Option<&[f64; 2]>, kind| points.extend(at.map(|at| MarkedPoint { at: *at, kind, part: None }));
    for (curve, group) in curves.iter().zip(groups(history)) {
        if rests(curve) {
            add(curve.points.first(), PointKind::Stop);
        }
        if group
            .last()
            .is_some_and(|phase| ends_by(history, phase, |cause| matches!(cause, Cause::Jams { .. })))
        {
            add(curve.points.last(), PointKind::Jam);
        }
    }
    add(curves.iter().flat_map(|curve| &curve.points).next(), PointKind::Start);
    if let Some(last) = curves.last().filter(|last| !rests(last)) {
        add(last.points.last(), PointKind::End);
    }
    points
}

/// Where a motion jams; of jams that are drawn as one piece, the last.
fn jams(history: &History) -> Vec<MarkedValue> {
    let seconds = history.mechanism.units.of("s");
    let ends = groups(history).into_iter().filter_map(|group| group.last().copied());
    let jams = ends.filter(|phase| ends_by(history, phase, |cause| matches!(cause, Cause::Jams { .. })));
    jams.map(|phase| {
        let at = seconds.number_of(phase.to);
        let label = format!("{}: jams", precise(at).replace('-', "\u{2212}"));
        MarkedValue { at, label, asymptote: false }
    })
    .collect()
}

/// The times of impacts on faces, with the energies that they take, as parts of the greatest.
fn impacts(history: &History) -> Vec<(f64, f64)> {
    let lost = |cause: &Cause| if let Cause::Lands { energy_lost, .. } = cause { *energy_lost } else { None };
    let events = history.events.iter();
    let all: Vec<(f64, f64)> =
        events.filter_map(|event| Some((event.time, event.causes.iter().find_map(lost)?))).collect();
    let greatest = all.iter().map(|(_, lost)| *lost).fold(f64::MIN_POSITIVE, f64::max);
    all.into_iter().map(|(time, lost)| (time, (lost / greatest).max(0.0))).collect()
}

/// Returns the changes that impulses make in the portrait of a coordinate, as curves from the end of one
/// piece to the beginning of the next, where they can be seen.
fn jumps(history: &History, curves: &[Curve], branch: usize) -> Vec<Curve> {
    let is_impulse =
        |cause: &Cause| matches!(cause, Cause::Jams { .. } | Cause::Hits { .. } | Cause::Lands { .. });
    let [_, least] = point_size(curves);
    let groups = groups(history);
    let pairs = curves.windows(2).zip(&groups);
    let jump = |(pair, group): (&[Curve], &Vec<&PhaseInterval>)| {
        let [from, to] = [*pair[0].points.last()?, *pair[1].points.first()?];
        let is_seen = (to[1] - from[1]).abs() > least;
        (is_seen && ends_by(history, group.last()?, is_impulse)).then(|| Curve {
            branch,
            quantity: 0,
            points: vec![from, to],
            ends: <[crate::plot::End; 2]>::default(),
        })
    };
    pairs.filter_map(jump).collect()
}

/// Whether a phase ends by some cause.
fn ends_by(history: &History, phase: &PhaseInterval, is_meant: impl Fn(&Cause) -> bool) -> bool {
    let here = history.events.iter().filter(|event| event.time == phase.to);
    here.flat_map(|event| &event.causes).any(is_meant)
}

/// Width and height of what is a point in the picture of some curves.
fn point_size(curves: &[Curve]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let all = curves.iter().flat_map(|curve| &curve.points).map(|point| point[axis]);
        extent(all).map_or(0.0, |[least, greatest]| POINT * (greatest - least))
    })
}

/// Says which quantities have the signs that name the modes.
fn signs_of_modes(mechanism: &Mechanism) -> String {
    let contacts: Vec<&str> = mechanism.contacts.iter().map(|contact| &*contact.name).collect();
    let hinges = mechanism.friction_circles.iter();
    let hinges: Vec<&str> = hinges.map(|circle| &*mechanism.joints[circle.joint.index()].name).collect();
    match (contacts.join(", "), hinges.join(", ")) {
        (contacts, hinges) if hinges.is_empty() => format!("signs of the normal forces of {contacts}"),
        (contacts, hinges) if contacts.is_empty() => format!("signs of the angular velocities of {hinges}"),
        (contacts, hinges) => {
            format!("signs of the normal forces of {contacts}, then of the angular velocities of {hinges}")
        }
    }
}

/// The range of an axis that leaves out what curves over time reach for a short time only, where that is many
/// times the rest; none where they are to be seen whole.
fn range_of_what_lasts(curves: &[Curve]) -> Option<[f64; 2]> {
    let steps = curves.iter().flat_map(|curve| curve.points.windows(2));
    let mut values: Vec<(f64, f64)> = steps.map(|pair| (pair[1][1], pair[1][0] - pair[0][0])).collect();
    values.sort_by(|one, other| one.0.total_cmp(&other.0));
    let whole: f64 = values.iter().map(|(_, time)| time).sum();
    let beyond = |share: f64| {
        let mut passed = 0.0;
        let found = values.iter().find(|(_, time)| {
            passed += time;
            passed >= share * whole
        });
        found.map(|(value, _)| *value)
    };
    let (least, greatest) = (beyond(RARE / 2.0)?.min(0.0), beyond(1.0 - RARE / 2.0)?.max(0.0));
    let all = extent(curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]))?;
    let size = greatest - least;
    let shown = [(least - size).max(all[0]), (greatest + size).min(all[1])];
    // To cut is worth it where what is shown gains as much.
    let is_cut = size > 0.0 && all[1] - all[0] > MANY * (shown[1] - shown[0]);
    is_cut.then(|| range_that_shows(shown, all))
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

    /// Coordinates in groups that can be seen in one panel: no extent is more than [`MANY`] times that of the
    /// first of its group. What does not move is seen in every panel.
    fn that_move_as_far(&self, coordinates: impl Iterator<Item = String>) -> Vec<Vec<String>> {
        let mut together: Vec<(f64, Vec<String>)> = Vec::new();
        for name in coordinates {
            let columns = self.pieces.iter().filter_map(|piece| piece.column(&name));
            let moves = extent(columns.flat_map(|column| column.values.iter().copied().flatten()))
                .map_or(0.0, |[least, greatest]| greatest - least);
            let is_alike = |other: f64| moves <= MANY * other && other <= MANY * moves;
            let group =
                together.iter_mut().find(|(other, _)| moves == 0.0 || *other == 0.0 || is_alike(*other));
            match group {
                Some((other, names)) => {
                    *other = other.max(moves);
                    names.push(name);
                }
                None => together.push((moves, vec![name])),
            }
        }
        together.into_iter().map(|(_, names)| names).collect()
    }

    /// The times in which one of these forces, given by name and column, is not determined.
    fn left_open(&self, forces: &[Named], seconds: &Unit) -> Vec<Zone> {
        let is_open = |piece: &&Series| {
            let columns = forces.iter().filter_map(|(_, column, _)| piece.column(column));
            columns.flat_map(|column| &column.values).any(Option::is_none)
        };
        let zone = |piece: &Series| {
            let times = &piece.column("t")?.values;
            let [from, to] = extent(times.iter().copied().flatten())?.map(|time| seconds.number_of(time));
            let meaning = "sticks: statics leaves forces open".to_owned();
            Some(Zone { from, to, hatching: Hatching::Falling, meaning })
        };
        self.pieces.iter().filter(is_open).filter_map(zone).collect()
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
    /// A panel with the time as its axis; curves are given by their names, columns and colours.
    fn panel(&mut self, title: &str, (name, unit): (&str, &str), curves: &[Named]) -> Panel {
        let mut drawn = Vec::new();
        let shown_in = [self.units.of("s"), self.units.of(unit)];
        for (name, column, colour) in curves {
            let index = self.branches.len();
            self.branches.push(branch(name, *colour));
            let pieces = self.samples.pieces.iter();
            drawn.extend(pieces.map(|piece| curve(piece, ["t", column], &shown_in, index)));
        }
        Panel {
            title: title.to_owned(),
            x: Axis {
                name: "t".to_owned(),
                unit: shown_in[0].name().to_owned(),
                range: Some(self.samples.range.map(|end| shown_in[0].number_of(end))),
                ..Axis::default()
            },
            y: Axis { name: name.to_owned(), unit: shown_in[1].name().to_owned(), ..Axis::default() },
            curves: drawn,
            ..Panel::default()
        }
    }

    /// The gaps of contacts that are open at times, with rings at impacts.
    fn gaps(&mut self, history: &History) -> Option<Panel> {
        let contacts = history.mechanism.contacts.iter();
        let gaps = numbered(contacts.map(|one| (one.name.to_string(), format!("{}.gap", one.name))));
        let gaps: Vec<_> = gaps.into_iter().filter(|(_, column, _)| self.samples.is_used(column)).collect();
        if gaps.is_empty() {
            return None;
        }
        let mut panel = self.panel("Gaps", ("gap", "m"), &gaps);
        let seconds = self.units.of("s");
        let ring = |(time, part)| MarkedPoint {
            at: [seconds.number_of(time), 0.0],
            kind: PointKind::Impact,
            part: Some(part),
        };
        panel.points = impacts(history).into_iter().map(ring).collect();
        Some(panel)
    }

    /// The normal forces of the contacts, and the magnitudes of the forces of hinges with friction; the first of these
    /// panels has the modes.
    fn forces(&mut self, history: &History) -> Vec<Panel> {
        let mechanism = &history.mechanism;
        let contacts = mechanism.contacts.iter();
        let contacts = contacts.map(|one| (one.name.to_string(), format!("{}.normal_force", one.name)));
        let hinges = mechanism.friction_circles.iter();
        let hinges = hinges.map(|circle| mechanism.joints[circle.joint.index()].name.to_string());
        let hinges = hinges.map(|name| (name.clone(), format!("{name}.force")));
        let (mut contacts, hinges) = (numbered(contacts), numbered(hinges));
        // What never presses is told by its gap.
        let first_of_modes = contacts.len().max(hinges.len());
        let is_pressed = |samples: &Samples, one: &Named| samples.is_used(&one.1);
        let modes = bands(history, first_of_modes);
        let presses = contacts.iter().any(|one| is_pressed(self.samples, one));
        if presses {
            contacts.retain(|one| is_pressed(self.samples, one));
        } else if hinges.is_empty() && modes.len() < 2 {
            return Vec::new();
        }
        let titles = ["Normal forces and contact modes", "Hinge forces and modes"];
        let mut panels = Vec::new();
        if !contacts.is_empty() || hinges.is_empty() {
            panels.push((titles[0], "normal force", contacts));
        }
        if !hinges.is_empty() {
            panels.push((if panels.is_empty() { titles[1] } else { "Hinge forces" }, "hinge force", hinges));
        }
        let panel = |(title, quantity, forces): (&str, &str, Vec<Named>)| {
            let mut panel = self.panel(title, (quantity, "N"), &forces);
            panel.y.range = range_of_what_lasts(&panel.curves);
            panel.zones = self.samples.left_open(&forces, &self.units.of("s"));
            panel
        };
        let mut panels: Vec<Panel> = panels.into_iter().map(panel).collect();
        panels[0].bands = modes;
        panels
    }

    /// The friction of the contacts, if some of them stick at times and statics determines it then: where all slide it is
    /// that of their normal forces.
    fn friction(&mut self, history: &History) -> Option<Panel> {
        let sticks = |interval: &PhaseInterval| {
            interval.to > interval.from && interval.phase.joints.contains(&JointPhase::Sticking)
        };
        let contacts = history.mechanism.contacts.iter();
        let frictions =
            numbered(contacts.map(|one| (one.name.to_string(), format!("{}.friction_force", one.name))));
        let frictions: Vec<_> =
            frictions.into_iter().filter(|(_, column, _)| self.samples.is_used(column)).collect();
        if frictions.is_empty() || !history.phases.iter().any(sticks) {
            return None;
        }
        let mut panel = self.panel("Friction, against positive sliding", ("friction", "N"), &frictions);
        panel.y.range = range_of_what_lasts(&panel.curves);
        panel.zones = self.samples.left_open(&frictions, &self.units.of("s"));
        Some(panel)
    }
}

/// The name of a curve, its column and its colour: a contact has the same one in all panels.
type Named = (String, String, usize);

fn numbered(curves: impl Iterator<Item = (String, String)>) -> Vec<Named> {
    curves.enumerate().map(|(colour, (name, column))| (name, column, colour)).collect()
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
/// panel. Words are those of the first time.
fn bands(history: &History, first: usize) -> Vec<Band> {
    let mechanism = &history.mechanism;
    let seconds = mechanism.units.of("s");
    let mut reader = history.reader();
    // Patterns with the same words have one colour: signs of contacts without friction tell nothing.
    let mut places: Vec<(String, usize)> = Vec::new();
    let mut meanings: Vec<(String, String)> = Vec::new();
    let mut bands: Vec<Band> = Vec::new();
    for group in groups(history) {
        let pattern = group[0].phase.pattern(mechanism);
        let is_one = group.iter().all(|phase| phase.phase.pattern(mechanism) == pattern);
        let key = if is_one { pattern } else { String::new() };
        let known = places.iter().find(|(known, _)| *known == key).map(|(_, place)| *place);
        let place = known.unwrap_or_else(|| {
            let words = reader.configuration(group[0].from);
            let words = words.map(|configuration| modes_in_words(mechanism, configuration, &group[0].phase));
            let (words, meaning) = match words.filter(|_| is_one) {
                Some(words) if words.is_empty() => (words, signs(&key)),
                Some(words) => (words.clone(), format!("{}:\u{a0}{words}", signs(&key))),
                None => (String::new(), "modes too short to be distinguished".to_owned()),
            };
            let same = meanings.iter().position(|(other, _)| *other == words && !words.is_empty());
            let place = same.unwrap_or_else(|| {
                meanings.push((words, meaning));
                meanings.len() - 1
            });
            places.push((key, place));
            place
        });
        let (colour, meaning) = (first + place, meanings[place].1.clone());
        let [from, to] = [group[0].from, group[group.len() - 1].to].map(|time| seconds.number_of(time));
        match bands.last_mut() {
            Some(last) if last.colour == colour => last.to = to,
            _ => bands.push(Band { from, to, colour, meaning }),
        }
    }
    bands
}

#[cfg(test)]
mod tests {
    use super::{Curve, range_of_what_lasts};
    use crate::plot::End;

    /// Two forces of 0.5 N and -0.5 N that end with a peak in a hundredth of the time.
    fn curves(peak: f64) -> Vec<Curve> {
        let curve = |sign: f64| {
            let points = (0..=1000).map(|step| [f64::from(step), sign * if step > 990 { peak } else { 0.5 }]);
            Curve { branch: 0, quantity: 0, points: points.collect(), ends: <[End; 2]>::default() }
        };
        vec![curve(1.0), curve(-1.0)]
    }

    /// What lasts reaches over 1 N, so that a cut shows 3 N: of 3.2 N or 10 N it would hide more than it shows better, of 60 N
    /// not.
    #[test]
    fn only_what_is_many_times_as_large_is_cut() {
        assert_eq!(range_of_what_lasts(&curves(1.6)), None);
        assert_eq!(range_of_what_lasts(&curves(5.0)), None);
        let [least, greatest] = range_of_what_lasts(&curves(30.0)).expect("a cut");
        assert!(least < -1.0 && greatest > 1.0 && greatest < 3.0, "{least} {greatest}");
    }
}
