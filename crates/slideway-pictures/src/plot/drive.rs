//! The figure of driven motion: efforts and efficiency over what is varied.

use super::colours::ModeColours;
use super::figure::{Axis, Branch, Curve, End, Figure, Hatching, MarkedValue, Panel, Stroke, Zone, headline};
use super::limits::{in_parentheses, in_words, present, stroke_of, without_empty_ends};
use crate::drawing::signs;
use slideway::drive::{Approach, BlowUp, Course, CourseDirection, CourseRow, DriveReport, Sense};
use slideway::report::{Verdict, precise};

/// The figure of a [`DriveReport`] with a course: for each unit a panel with the efforts, with and without friction, and
/// one with the efficiency, each with both directions of motion, which markers tell apart; none without a course. Its
/// rows should be dense.
pub fn drive_figure(report: &DriveReport) -> Option<Figure> {
    let course = report.course.as_ref()?;
    let mut builder = Builder { report, course, branches: Vec::new(), colours: ModeColours::default() };
    // Modes have the colours that they have in other plots before anything else has one.
    for mode in course.directions.iter().flat_map(|direction| &direction.modes) {
        builder.colours.of(&mode.pattern);
    }
    let mut units: Vec<&str> = report.drives.iter().map(|drive| drive.unit).collect();
    units.dedup();
    let mut panels: Vec<Panel> = units.iter().map(|unit| builder.efforts(unit)).collect();
    panels.extend(Some(builder.efficiency()).filter(|panel| !panel.curves.is_empty()));
    without_empty_ends(&mut panels);
    let shown = format!("effort over {}", in_words(&course.vary.name));
    Some(Figure {
        title: headline(report.title.as_deref(), &shown),
        subtitle: "Modes: signs of the normal forces of all contacts in their order".to_owned(),
        panels,
        branches: builder.branches,
        quantities: quantities(report, course),
        one_legend: true,
    })
}

/// Returns the meanings of the markers of curves: the drives in each direction of motion.
fn quantities(report: &DriveReport, course: &Course) -> Vec<String> {
    let is_single = report.drives.len() == 1;
    let of_direction = |direction: &CourseDirection| {
        let way = way(direction);
        let name = |drive: &slideway::drive::DriveName| match (is_single, course.directions.len()) {
            (_, 1) => drive.name.clone(),
            (true, _) => format!("moving {way}"),
            (false, _) => format!("{}, moving {way}", drive.name),
        };
        report.drives.iter().map(name).collect::<Vec<_>>()
    };
    course.directions.iter().flat_map(of_direction).collect()
}

fn way(direction: &CourseDirection) -> &'static str {
    match direction.direction {
        Sense::Model => "as in the model",
        Sense::Reversed => "backwards with the same loads",
    }
}

struct Builder<'r> {
    report: &'r DriveReport,
    course: &'r Course,
    branches: Vec<Branch>,
    colours: ModeColours,
}

/// Rows of one mode at values that follow one another, and what its ends are.
struct Stretch<'r> {
    pattern: &'r str,
    rows: Vec<&'r CourseRow>,
    ends: [End; 2],
}

impl Stretch<'_> {
    /// The parts in which the mode has one stroke, each from the last row of the one before on.
    fn by_stroke(&self) -> Vec<Self> {
        let mut parts = Vec::new();
        let mut start = 0;
        for run in self.rows.chunk_by(|one, next| stroke(one) == stroke(next)) {
            let end = start + run.len();
            let ends = [
                if start == 0 { self.ends[0] } else { End::Plain },
                if end == self.rows.len() { self.ends[1] } else { End::Plain },
            ];
            let rows = self.rows[start.saturating_sub(1)..end].to_vec();
            parts.push(Self { pattern: self.pattern, rows, ends });
            start = end;
        }
        parts
    }

    /// Returns the behaviour along it of a mechanism with slightly elastic guides.
    fn verdict(&self) -> Verdict {
        self.rows.last().and_then(|row| row.attainability).unwrap_or(Verdict::NotComputed)
    }
}

/// The stroke of the mode of a row.
fn stroke(row: &CourseRow) -> Stroke {
    stroke_of(row.attainability.unwrap_or(Verdict::NotComputed))
}

impl Builder<'_> {
    fn efforts(&mut self, unit: &str) -> Panel {
        let (report, course) = (self.report, self.course);
        let shown = report.units.of(unit);
        let all = report.drives.iter().enumerate();
        let drives: Vec<usize> =
            all.filter(|(_, drive)| drive.unit == unit).map(|(index, _)| index).collect();
        let mut curves = Vec::new();
        for (number, direction) in course.directions.iter().enumerate() {
            let first = number * report.drives.len();
            for stretch in stretches(direction) {
                let branch = self.branch(&stretch, direction);
                for &drive in &drives {
                    let value =
                        |row: &CourseRow| row.efforts.as_ref().map(|efforts| shown.number_of(efforts[drive]));
                    curves.push(self.curve(&stretch.rows, (branch, first + drive), stretch.ends, value));
                }
            }
            let frictionless = self.entry("without friction", 6, Stroke::Dotted);
            for &drive in &drives {
                let value = |row: &CourseRow| {
                    row.frictionless.as_ref().map(|efforts| shown.number_of(efforts[drive]))
                };
                let rows: Vec<&CourseRow> = direction.rows.iter().collect();
                curves.push(self.curve(&rows, (frictionless, first + drive), [End::Plain; 2], value));
            }
        }
        let name = match &report.drives[..] {
            [only] => format!("effort of {}", only.name),
            _ => "effort".to_owned(),
        };
        let y = Axis { name, unit: shown.name().to_owned(), ..Axis::default() };
        let marked = self.marked().into_iter().chain(present(&self.course.vary)).collect();
        Panel { marked, curves, ..self.panel("Effort".to_owned(), y) }
    }

    /// The efficiency in per cent, where it has a meaning.
    fn efficiency(&mut self) -> Panel {
        let course = self.course;
        let mut curves = Vec::new();
        let mut title = "Efficiency".to_owned();
        for (number, direction) in course.directions.iter().enumerate() {
            let quantity = number * self.report.drives.len();
            for stretch in stretches(direction) {
                let branch = self.branch(&stretch, direction);
                let value = |row: &CourseRow| Some(100.0 * row.efficiency?.value?);
                let curve = self.curve(&stretch.rows, (branch, quantity), [End::Plain; 2], value);
                curves.extend(Some(curve).filter(|curve| curve.points.len() > 1));
            }
            for (pattern, why) in without_efficiency(direction) {
                title.extend(["; ", &*signs(pattern), ": ", why]);
            }
        }
        let y = Axis { name: "efficiency".to_owned(), unit: "%".to_owned(), ..Axis::default() };
        let marked = present(&self.course.vary).into_iter().collect();
        Panel { marked, curves, ..self.panel(title, y) }
    }

    fn panel(&self, title: String, y: Axis) -> Panel {
        let vary = &self.course.vary;
        let scale = vary.shown_in.scale();
        let x = Axis {
            name: vary.name.clone(),
            unit: vary.shown_in.name().to_owned(),
            range: Some([vary.from / scale, vary.to / scale]),
            logarithmic: false,
        };
        let zones = self.course.directions.iter().flat_map(|direction| self.zones(direction)).collect();
        Panel { title, x, y, zones, ..Panel::default() }
    }

    fn curve(
        &self,
        rows: &[&CourseRow],
        (branch, quantity): (usize, usize),
        ends: [End; 2],
        value: impl Fn(&CourseRow) -> Option<f64>,
    ) -> Curve {
        let points =
            rows.iter().filter_map(|row| Some([row.at / self.course.vary.shown_in.scale(), value(row)?]));
        Curve { branch, quantity, points: points.collect(), ends }
    }

    /// The branch of a mode, with its words.
    fn branch(&mut self, stretch: &Stretch<'_>, direction: &CourseDirection) -> usize {
        let Stretch { pattern, .. } = *stretch;
        let mode = direction.modes.iter().find(|mode| mode.pattern == pattern);
        let words = mode.map_or_else(String::new, |mode| format!(":\u{a0}{}", mode.words));
        let verdict = stretch.verdict();
        // A mode of both directions has a colour of its own backwards.
        let occurs = |direction: &CourseDirection| direction.modes.iter().any(|mode| mode.pattern == pattern);
        let [before, behind] = match direction.direction {
            Sense::Reversed if self.course.directions.iter().all(occurs) => ["backwards, ", "<"],
            _ => [""; 2],
        };
        let name = format!("{before}{}{words}{}", signs(pattern), in_parentheses(std::iter::once(verdict)));
        let colour = self.colours.of(&format!("{pattern}{behind}"));
        self.entry(&name, colour, stroke_of(verdict))
    }

    fn entry(&mut self, name: &str, colour: usize, stroke: Stroke) -> usize {
        let known = self.branches.iter().position(|branch| branch.name == name);
        known.unwrap_or_else(|| {
            self.branches.push(Branch { name: name.to_owned(), colour, stroke });
            self.branches.len() - 1
        })
    }

    fn marked(&self) -> Vec<MarkedValue> {
        let mut marked: Vec<MarkedValue> = Vec::new();
        for blow_up in self.course.directions.iter().flat_map(|direction| &direction.blow_ups) {
            let at = blow_up.at / self.course.vary.shown_in.scale();
            if marked.iter().all(|known| known.at != at) {
                let label = format!("{}: grows without bound", precise(at).replace('-', "\u{2212}"));
                marked.push(MarkedValue { at, label, asymptote: true });
            }
        }
        marked
    }

    /// Values without a solution, up to the growth without bound beside them, and those without a position.
    fn zones(&self, direction: &CourseDirection) -> Vec<Zone> {
        let scale = self.course.vary.shown_in.scale();
        let is_single = self.course.directions.len() == 1;
        let way = if is_single { String::new() } else { format!(" moving {}", way(direction)) };
        // What is excluded in one direction is not in the other.
        let no_solution = if is_single { "excluded: no solution" } else { "no solution" };
        let zone = |from: f64, to: f64, hatching: Hatching, meaning: &str| Zone {
            from: from / scale,
            to: to / scale,
            hatching,
            meaning: format!("{meaning}{way}"),
        };
        let is_locked =
            |row: &CourseRow| row.pattern.is_none() && row.range.is_none() && row.frictionless.is_some();
        let runs = direction.rows.chunk_by(|one, other| is_locked(one) == is_locked(other));
        let mut before: Option<&CourseRow> = None;
        let mut zones = Vec::new();
        let mut runs = runs.peekable();
        while let Some(run) = runs.next() {
            let grown = |row: &CourseRow| row.efforts.is_none() && row.pattern.is_some();
            if is_locked(&run[0]) {
                let after = runs.peek().map(|next| &next[0]).filter(|row| grown(row));
                let from = before.filter(|row| grown(row)).map_or(run[0].at, |row| row.at);
                let to = after.map_or(run[run.len() - 1].at, |row| row.at);
                zones.push(zone(from, to, Hatching::Rising, no_solution));
            }
            before = run.last();
        }
        let is_open = |row: &CourseRow| row.range.is_some();
        let runs = direction.rows.chunk_by(|one, other| is_open(one) == is_open(other));
        let meaning = "infinitely many solutions: efforts undetermined";
        zones.extend(
            runs.filter(|run| is_open(&run[0]))
                .map(|run| zone(run[0].at, run[run.len() - 1].at, Hatching::Dotted, meaning)),
        );
        zones.extend(direction.without_mode_problem.iter().map(|range| {
            zone(range.from, range.to, Hatching::Falling, "excluded: cannot be assembled or solved")
        }));
        zones
    }
}

/// The modes that have no efficiency at some value, and why, each once.
fn without_efficiency(direction: &CourseDirection) -> Vec<(&str, &'static str)> {
    let mut without: Vec<(&str, &'static str)> = Vec::new();
    for row in &direction.rows {
        let why = row.efficiency.filter(|efficiency| efficiency.value.is_none()).map(|one| one.is.in_words());
        let found = row.pattern.as_deref().zip(why).filter(|one| !without.contains(one));
        without.extend(found);
    }
    without
}

/// The rows of each mode, cut where it is missing at a value and where its efforts grow without bound.
fn stretches(direction: &CourseDirection) -> Vec<Stretch<'_>> {
    let mut stretches: Vec<(usize, bool, Stretch<'_>)> = Vec::new();
    // Values at which there is only growth without bound are between two places.
    let mut place = 0;
    for rows in direction.rows.chunk_by(|one, other| one.at == other.at) {
        let is_between = rows.iter().all(|row| row.pattern.is_some() && row.efforts.is_none());
        for row in rows {
            let Some(pattern) = row.pattern.as_deref() else { continue };
            let open = stretches.iter_mut().rev().find(|(next, is_open, stretch)| {
                *is_open && *next == place && is_continued(stretch, row, rows)
            });
            let open = open.filter(|_| !comes_from_infinity(direction, row));
            let next = if is_between { place } else { place + 1 };
            match (open, row.efforts.is_none()) {
                (Some((end, _, stretch)), false) => {
                    *end = next;
                    stretch.rows.push(row);
                }
                (Some((_, is_open, stretch)), true) => {
                    *is_open = false;
                    stretch.ends[1] = End::Diverges;
                    // Beyond, the same mode may come from infinity.
                    stretches.push((next, true, from_infinity(pattern)));
                }
                (None, true) => stretches.push((next, true, from_infinity(pattern))),
                (None, false) => {
                    let stretch = Stretch { pattern, rows: vec![row], ends: [End::Plain; 2] };
                    stretches.push((next, true, stretch));
                }
            }
        }
        place += usize::from(!is_between);
    }
    let all = stretches.into_iter().map(|(.., stretch)| stretch).filter(|stretch| stretch.rows.len() > 1);
    all.flat_map(|stretch| stretch.by_stroke()).filter(|part| part.rows.len() > 1).collect()
}

/// Whether a row continues a stretch: with friction in hinges a mode may have several at one value, of which the one with
/// the nearest efforts does, from infinity that with the greatest.
fn is_continued(stretch: &Stretch<'_>, row: &CourseRow, rows: &[CourseRow]) -> bool {
    let last = stretch.rows.last().and_then(|last| last.efforts.as_deref());
    let distance = |other: &CourseRow| {
        let efforts = other.efforts.as_deref().unwrap_or_default();
        match last {
            Some(last) => {
                last.iter().zip(efforts).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
            }
            None => -efforts.iter().map(|effort| effort.abs()).fold(0.0, f64::max),
        }
    };
    let same = |other: &&CourseRow| other.pattern.as_deref() == Some(stretch.pattern);
    same(&row) && rows.iter().filter(same).all(|other| distance(row) <= distance(other))
}

/// Whether a row is where efforts grow without bound only from above.
fn comes_from_infinity(direction: &CourseDirection, row: &CourseRow) -> bool {
    let here = |blow_up: &&BlowUp| blow_up.at == row.at && row.pattern.as_ref() == Some(&blow_up.pattern);
    let is_above = |blow_up: &BlowUp| blow_up.side == Approach::Above;
    row.efforts.is_none() && direction.blow_ups.iter().filter(here).all(is_above)
}

fn from_infinity(pattern: &str) -> Stretch<'_> {
    Stretch { pattern, rows: Vec::new(), ends: [End::Diverges, End::Plain] }
}
