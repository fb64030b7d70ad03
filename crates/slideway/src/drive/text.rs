//! Driven motion as text for people.

use super::report::{
    Course, CourseDirection, CourseRow, DriveDirection, DriveName, DriveReport, DriveSolution, EffortRange,
    LockedRange, Sense,
};
use super::words::{advice, at_rest, greatest, is_stable, percents, sentences, share, without_limit};
use crate::limits::{RangeWithoutProblem, no_answers};
use crate::report::page::Page;
use crate::report::{
    OpenRange, Proof, Report, Style, Verdict, ends_in_words, joints_in_words, precise, spaced,
};
use crate::units::Unit;

impl Report for DriveReport {
    fn answer(&self) -> String {
        self.conclusion.join(" ")
    }

    /// The conclusion, the efforts in the state, and those over what is varied.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        for direction in &self.directions {
            text.direction(direction);
        }
        text.proof();
        if let Some(course) = &self.course {
            text.course(course);
        }
        text.text()
    }
}

fn title(direction: Sense) -> &'static str {
    match direction {
        Sense::Model => "As in the model",
        Sense::Reversed => "Backwards, with the same loads",
    }
}

impl Page<'_, DriveReport> {
    fn heading(&mut self) {
        let report = self.report;
        if let Some(title) = &report.title {
            self.headline(title);
        }
        let state = report.state.iter().map(|coordinate| coordinate.in_words(&report.units));
        self.line(&state.collect::<Vec<_>>().join("; "));
        self.line("");
        at_rest(report).for_each(|line| self.line(&line));
        for direction in &report.directions {
            self.status(direction.status, &sentences(report, direction).join(" "));
        }
        advice(report).into_iter().chain(greatest(report)).for_each(|line| self.line(&line));
    }

    fn direction(&mut self, direction: &DriveDirection) {
        self.line("");
        self.headline(title(direction.direction));
        let all = self.is_verbose();
        let states = &direction.solutions;
        let columns = Columns {
            signs: all,
            stable: all || states.iter().any(|one| one.attainability != Verdict::Attainable),
        };
        let mut header = vec![String::new()];
        header.extend(columns.signs.then(|| "signs".to_owned()));
        header.extend(self.effort_titles());
        header.extend([self.report.units.of("W").title("power"), "efficiency".to_owned()]);
        header.extend(columns.stable.then(|| "stable".to_owned()));
        let mut rows = vec![self.frictionless(direction, columns)];
        for (index, state) in states.iter().enumerate() {
            let name =
                if states.len() == 1 { "with friction".to_owned() } else { format!("state {}", index + 1) };
            rows.push(self.state(name, state, columns));
        }
        rows.extend(direction.range.as_ref().map(|range| self.range(range, columns)));
        self.table(&header, &rows);
        for (index, state) in states.iter().enumerate().filter(|(_, state)| !state.joints.is_empty()) {
            let name = if states.len() == 1 { String::new() } else { format!("state {}: ", index + 1) };
            self.hung(&format!("  {name}{}", joints_in_words(&state.joints)), "  ");
        }
        for blow_up in direction.blow_ups.iter().flatten().filter(|_| all) {
            let at = format!("{} times this friction", precise(blow_up.at));
            self.line(&format!("  {}.", without_limit(self.report, blow_up, &at, true)));
        }
        for factor in direction.no_solution.iter().filter(|_| all) {
            self.line(&format!(
                "  Just beyond {} times this friction there is no solution.",
                precise(*factor)
            ));
        }
    }

    /// The proof that there are no other states, or its absence.
    fn proof(&mut self) {
        let proven = self.report.directions.iter().all(|one| one.complete == Proof::Proven);
        self.line("");
        self.line(if proven {
            "Proven: there are no other states."
        } else {
            "Not proven: there may be other states."
        });
    }

    fn effort_titles(&self) -> Vec<String> {
        let title = |drive: &DriveName| self.report.units.of(drive.unit).title(&drive.name);
        self.report.drives.iter().map(title).collect()
    }

    /// The units of the efforts.
    fn effort_units(&self) -> Vec<Unit> {
        self.report.drives.iter().map(|drive| self.report.units.of(drive.unit)).collect()
    }

    fn frictionless(&self, direction: &DriveDirection, columns: Columns) -> Vec<String> {
        let mut row = columns.first("without friction".to_owned(), String::new());
        row.extend(self.numbers(&direction.frictionless.efforts, direction.frictionless.power));
        columns.last(row, String::new(), String::new())
    }

    fn state(&self, name: String, state: &DriveSolution, columns: Columns) -> Vec<String> {
        let mut row = columns.first(name, spaced(&state.pattern));
        row.extend(self.numbers(&state.efforts, state.power));
        columns.last(row, share(state.efficiency), is_stable(state.attainability).to_owned())
    }

    fn range(&self, range: &EffortRange, columns: Columns) -> Vec<String> {
        let mut row = columns.first("undetermined".to_owned(), String::new());
        row.extend(range_cells(range, &self.effort_units()));
        let power = |end: Option<f64>| end.map(|power| self.report.units.of("W").number(power));
        row.push(ends_in_words(range.power.map(power)));
        let efficiency = range.efficiency.map_or(String::new(), percents);
        columns.last(row, efficiency, String::new())
    }

    /// The efforts and their power.
    fn numbers(&self, efforts: &[f64], power: f64) -> Vec<String> {
        let efforts = efforts.iter().zip(self.effort_units()).map(|(effort, unit)| unit.number(*effort));
        efforts.chain([self.report.units.of("W").number(power)]).collect()
    }

    fn course(&mut self, course: &Course) {
        let details = self.is_verbose();
        for direction in &course.directions {
            self.line("");
            self.headline(&format!("{}, over {}", title(direction.direction), course.vary.name));
            self.course_table(course, direction);
            for blow_up in &direction.blow_ups {
                let at = format!("{} = {}", course.vary.name, course.vary.shown_in.precise(blow_up.at));
                self.line(&format!("  {}.", without_limit(self.report, blow_up, &at, details)));
            }
            for LockedRange { from, to } in direction.locked.iter().filter(|_| details) {
                let unit = &course.vary.shown_in;
                let [from, to] = [unit.precise_number(*from), unit.precise(*to)];
                self.line(&format!("  From {} = {from} to {to} it jams.", course.vary.name));
            }
            let ranges = RangeWithoutProblem::told(&direction.without_mode_problem);
            for line in no_answers(&ranges, &course.vary, details) {
                self.line(&format!("  {line}"));
            }
        }
        self.line("");
        self.line(match (details, course.sampled) {
            (true, _) => &course.guarantee,
            (false, true) => "Sampled: what begins and ends between two sampled values is missed.",
            (false, false) => "Not sampled: the values at which something changes are computed.",
        });
    }

    fn course_table(&mut self, course: &Course, direction: &CourseDirection) {
        let details = self.is_verbose();
        let units = self.effort_units();
        let rows: Vec<CourseCells> =
            direction.rows.iter().map(|row| course_row(row, course, &units)).collect();
        let with_notes = rows.iter().any(|row| !row.note.is_empty());
        let mut header = vec![course.vary.shown_in.title(&course.vary.name)];
        header.extend(details.then(|| "signs".to_owned()));
        header.extend(self.effort_titles());
        header.extend(self.report.drives.iter().map(|drive| format!("{} without friction", drive.name)));
        header.push("efficiency".to_owned());
        header.extend(with_notes.then(String::new));
        let cells = rows.into_iter().map(|row| {
            let mut cells = vec![row.at];
            cells.extend(details.then_some(row.signs));
            cells.extend(row.numbers);
            cells.extend(with_notes.then_some(row.note));
            cells
        });
        self.table(&header, &cells.collect::<Vec<_>>());
    }
}

/// The columns of a table beside efforts, power and efficiency.
#[derive(Clone, Copy)]
struct Columns {
    signs: bool,
    stable: bool,
}

impl Columns {
    /// The first cells of a row.
    fn first(self, name: String, signs: String) -> Vec<String> {
        std::iter::once(name).chain(self.signs.then_some(signs)).collect()
    }

    /// A row with its last cells.
    fn last(self, mut row: Vec<String>, efficiency: String, stable: String) -> Vec<String> {
        row.push(efficiency);
        row.extend(self.stable.then_some(stable));
        row
    }
}

/// The efforts of infinitely many solutions in these units, a cell for each drive: "25 to 50".
fn range_cells(range: &EffortRange, units: &[Unit]) -> Vec<String> {
    let one = |(effort, unit): (&OpenRange, &Unit)| {
        ends_in_words([effort.from, effort.to].map(|end| end.map(|effort| unit.number(effort))))
    };
    range.undetermined.efforts.iter().zip(units).map(one).collect()
}

/// A row of the table over what is varied.
struct CourseCells {
    at: String,
    signs: String,
    /// Efforts with and without friction, and the efficiency.
    numbers: Vec<String>,
    note: String,
}

fn course_row(row: &CourseRow, course: &Course, units: &[Unit]) -> CourseCells {
    let note = match (&row.pattern, &row.frictionless) {
        _ if row.range.is_some() => "undetermined",
        (Some(_), _) => match row.attainability {
            None | Some(Verdict::Attainable) => "",
            Some(Verdict::Unattainable) => "unstable",
            Some(Verdict::Flutter) => "may vibrate",
            Some(Verdict::Undecided | Verdict::NotComputed) => "stability not decided",
        },
        (None, Some(_)) if course.can_tip => "no solution",
        (None, Some(_)) => "it jams",
        (None, None) => "no answer",
    };
    let drives = || units.iter().enumerate();
    let ranges = row.range.as_ref().map(|range| range_cells(range, units));
    let mut numbers = ranges.unwrap_or_else(|| {
        drives()
            .map(|(drive, unit)| match (&row.efforts, row.grows.get(drive)) {
                (Some(efforts), _) => unit.number(efforts[drive]),
                (None, Some(1)) => "infinite".to_owned(),
                (None, Some(-1)) => "-infinite".to_owned(),
                _ => String::new(),
            })
            .collect()
    });
    let free = row.frictionless.as_ref();
    numbers.extend(drives().map(|(drive, unit)| free.map_or(String::new(), |all| unit.number(all[drive]))));
    let range = row.range.as_ref().and_then(|range| range.efficiency).map(percents);
    numbers.push(range.or_else(|| row.efficiency.map(share)).unwrap_or_default());
    CourseCells {
        at: course.vary.shown_in.precise_number(row.at),
        signs: row.pattern.as_deref().map(spaced).unwrap_or_default(),
        numbers,
        note: note.to_owned(),
    }
}
