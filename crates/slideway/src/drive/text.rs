//! Driven motion as text for people.

use super::report::{
    Approach, BlowUp, Course, CourseDirection, CourseRow, DriveDirection, DriveName, DriveReport, Efficiency,
    EfficiencyKind, EffortRange, LockedRange, Sense,
};
use crate::limits::{RangeWithoutProblem, no_answer};
use crate::report::number::number;
use crate::report::number::precise;
use crate::report::page::Page;
use crate::report::{LOCKED, OpenRange, Report, Status, Style, Verdict, count, spaced, tips};
use crate::units::Unit;

impl Report for DriveReport {
    fn answer(&self) -> String {
        self.conclusion.join(" ")
    }

    /// What it comes to, the efforts in the state, and those over what is varied.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        for direction in &self.directions {
            text.direction(direction);
        }
        if let Some(course) = &self.course {
            text.course(course);
        }
        text.text()
    }
}

/// One sentence for each direction, one for each factor of friction at which its efforts grow without bound, and
/// one for the factor beyond which it locks, if no effort grows there.
pub(super) fn conclusion(report: &DriveReport) -> Vec<String> {
    let mut sentences = Vec::new();
    for direction in &report.directions {
        sentences.push(format!("{}: {}.", moving(direction.direction), outcome(report, direction)));
        let blow_ups = direction.blow_ups.iter().flatten();
        sentences.extend(blow_ups.map(|blow_up| {
            format!(
                "{}: at {} times the friction {}.",
                moving(direction.direction),
                precise(blow_up.at),
                without_bound(report, blow_up)
            )
        }));
        // A jam that no growing effort announces.
        let is_announced =
            |factor: f64| direction.blow_ups.iter().flatten().any(|blow_up| near(blow_up.at, factor));
        let comes = direction.no_solution.filter(|_| !direction.solutions.is_empty());
        sentences.extend(comes.filter(|&factor| !is_announced(factor)).map(|factor| {
            let what =
                tips(&direction.tips).unwrap_or_else(|| "no effort moves it; none grows before".to_owned());
            format!("{}: beyond {} times the friction {what}.", moving(direction.direction), precise(factor))
        }));
    }
    let ranges = report.directions.iter().filter_map(|direction| direction.range.as_ref());
    sentences.extend(ranges.filter_map(|range| range.undetermined.advice()).map(str::to_owned).next());
    sentences
}

/// Whether two factors are one, as the text tells them.
fn near(one: f64, other: f64) -> bool {
    precise(one) == precise(other)
}

fn moving(direction: Sense) -> &'static str {
    match direction {
        Sense::Model => "Moving as in the model",
        Sense::Reversed => "Moving in the opposite direction with the same loads",
    }
}

/// "push needs 36.364 N instead of 20 N without friction, efficiency 55 %"
fn outcome(report: &DriveReport, direction: &DriveDirection) -> String {
    if let Some(range) = &direction.range {
        return undetermined(report, direction, range);
    }
    match (direction.solutions.as_slice(), direction.status) {
        (_, Status::Continuum) => {
            "infinitely many states are possible, whose efforts are not known".to_owned()
        }
        ([], Status::Unknown) => "it is not known which effort moves it".to_owned(),
        ([], _) => tips(&direction.tips).unwrap_or_else(|| format!("no effort moves it, {LOCKED}")),
        ([only], _) => {
            // One drive that does no work without friction has no effort then.
            let is_idle = only.efficiency.is == EfficiencyKind::NoPower && report.drives.len() == 1;
            let one = |(drive, (with, without)): (&DriveName, (&f64, &f64))| {
                let unit = report.units.of(drive.unit);
                let (with, without) = (unit.show(*with), unit.show(*without));
                if is_idle {
                    return format!("{} needs {with}", drive.name);
                }
                format!("{} needs {with} instead of {without} without friction", drive.name)
            };
            let efforts = only.efforts.iter().zip(&direction.frictionless.efforts);
            let needs: Vec<String> = report.drives.iter().zip(efforts).map(one).collect();
            format!("{}; {}", needs.join(", "), efficiency_in_words(only.efficiency))
        }
        (several, _) => format!("{} states are possible, each with its own efforts", several.len()),
    }
}

/// "belt needs 25 to 50 N instead of 20 N without friction; how left, right share the load is undetermined"
fn undetermined(report: &DriveReport, direction: &DriveDirection, range: &EffortRange) -> String {
    let one = |(effort, without): (&OpenRange, &f64)| {
        let without = report.units.of(effort.unit).show(*without);
        format!(
            "{} needs {} instead of {without} without friction",
            effort.name,
            effort.in_words(&report.units)
        )
    };
    let efforts = range.undetermined.efforts.iter().zip(&direction.frictionless.efforts);
    let mut parts: Vec<String> = efforts.map(one).collect();
    parts.extend(range.efficiency.map(|ends| format!("efficiency {}", percents(ends))));
    parts.push(range.undetermined.cause());
    if !direction.solutions.is_empty() {
        let further = count(direction.solutions.len(), "further state has", "further states have");
        parts.push(format!("{further} their own efforts"));
    }
    parts.join("; ")
}

/// "40 to 80 %"
fn percents([from, to]: [f64; 2]) -> String {
    if from == to { percent(from) } else { format!("{} to {}", number(100.0 * from), percent(to)) }
}

fn efficiency_in_words(efficiency: Efficiency) -> String {
    match (efficiency.is, efficiency.value) {
        (EfficiencyKind::Driving, Some(value)) => format!("efficiency {}", percent(value)),
        (EfficiencyKind::Braking, Some(value)) => {
            format!("the load pushes, and {} of its power reaches the drives", percent(value))
        }
        (EfficiencyKind::HeldByFriction, _) => {
            "without friction the load would push, but friction holds it".to_owned()
        }
        (EfficiencyKind::NoPower, _) => "without friction the motion needs no power".to_owned(),
        _ => "without friction the drives would push, with it they brake".to_owned(),
    }
}

fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

/// "the effort of push grows without bound (mode + -), as do guide.front, guide.rear"
fn without_bound(report: &DriveReport, blow_up: &BlowUp) -> String {
    let growing = report.drives.iter().zip(&blow_up.efforts).filter(|(_, sign)| **sign != 0);
    let growing: Vec<&str> = growing.map(|(drive, _)| &*drive.name).collect();
    let [what, verb] = if growing.len() == 1 { ["effort", "grows"] } else { ["efforts", "grow"] };
    let also = match blow_up.contacts.as_slice() {
        [] => String::new(),
        contacts => format!(", as the normal forces of {} do", contacts.join(", ")),
    };
    let only = if blow_up.side == Approach::Above { ", which exists above it" } else { "" };
    // Hinges alone have no modes.
    let mode = match (blow_up.pattern.as_str(), blow_up.side) {
        ("", Approach::Below) => " from below".to_owned(),
        ("", Approach::Above) => " from above".to_owned(),
        (pattern, _) => format!(" in the mode {}{only}", spaced(pattern)),
    };
    format!("the {what} of {} {verb} without bound{mode}{also}", growing.join(", "))
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
        for sentence in &report.conclusion {
            self.headline(sentence);
        }
    }

    fn direction(&mut self, direction: &DriveDirection) {
        self.line("");
        self.headline(moving(direction.direction));
        let mut header = vec!["signs".to_owned(), "elastic guides".to_owned()];
        header.extend(self.effort_titles());
        let power = self.report.units.of("W").title("power");
        header.extend([power, "efficiency".to_owned(), "contact mode".to_owned()]);
        let frictionless = &direction.frictionless;
        let mut rows = vec![self.row(["without friction", ""], &frictionless.efforts, frictionless.power)];
        rows[0].extend([String::new(), String::new()]);
        for solution in &direction.solutions {
            let mut one = self.row(
                [&spaced(&solution.pattern), verdict_in_words(solution.attainability)],
                &solution.efforts,
                solution.power,
            );
            let words = solution.joints.iter().map(|joint| format!("{} {}", joint.name, joint.mode));
            one.extend([share(solution.efficiency), words.collect::<Vec<_>>().join("; ")]);
            rows.push(one);
        }
        if let Some(range) = &direction.range {
            let mut one = vec!["undetermined".to_owned(), String::new()];
            one.extend(self.range_cells(range));
            one.push(ends_in_words(
                range.power.map(|end| end.map(|power| self.report.units.of("W").number(power))),
            ));
            one.push(range.efficiency.map_or(String::new(), percents));
            one.push(String::new());
            rows.push(one);
        }
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        self.table(&header, &rows);
    }

    fn effort_titles(&self) -> Vec<String> {
        let title = |drive: &DriveName| self.report.units.of(drive.unit).title(&drive.name);
        self.report.drives.iter().map(title).collect()
    }

    /// The units of the efforts.
    fn effort_units(&self) -> Vec<Unit> {
        self.report.drives.iter().map(|drive| self.report.units.of(drive.unit)).collect()
    }

    fn row(&self, [signs, verdict]: [&str; 2], efforts: &[f64], power: f64) -> Vec<String> {
        let mut row = vec![signs.to_owned(), verdict.to_owned()];
        row.extend(efforts.iter().zip(self.effort_units()).map(|(effort, unit)| unit.number(*effort)));
        row.push(self.report.units.of("W").number(power));
        row
    }

    /// The efforts of infinitely many solutions, a cell for each drive.
    fn range_cells(&self, range: &EffortRange) -> Vec<String> {
        range_cells(range, &self.effort_units())
    }

    fn course(&mut self, course: &Course) {
        for direction in &course.directions {
            self.line("");
            self.headline(&format!("{}, over {}", moving(direction.direction), course.vary.name));
            self.course_table(course, direction);
            for blow_up in &direction.blow_ups {
                let told = without_bound(self.report, blow_up);
                let at = course.vary.shown_in.precise(blow_up.at);
                self.line(&format!("  At {} = {at} {told}.", course.vary.name));
            }
            for LockedRange { from, to } in &direction.locked {
                let unit = &course.vary.shown_in;
                let [from, to] = [unit.precise_number(*from), unit.precise(*to)];
                self.line(&format!("  From {} = {from} to {to} no effort moves it.", course.vary.name));
            }
            for RangeWithoutProblem { from, to, reason } in &direction.without_mode_problem {
                self.line(&no_answer([*from, *to], &course.vary.shown_in, reason));
            }
        }
        self.line("");
        self.line(&course.guarantee);
    }

    fn course_table(&mut self, course: &Course, direction: &CourseDirection) {
        let mut header = vec![course.vary.shown_in.title(&course.vary.name), "signs".to_owned()];
        header.extend(self.effort_titles());
        header.extend(self.report.drives.iter().map(|drive| format!("{} without friction", drive.name)));
        header.push("efficiency".to_owned());
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let units = self.effort_units();
        let row = |row: &CourseRow| course_row(row, &course.vary.shown_in, &units);
        let rows: Vec<Vec<String>> = direction.rows.iter().map(row).collect();
        self.table(&header, &rows);
    }
}

/// The efforts of infinitely many solutions in these units, a cell for each drive: "25 to 50".
fn range_cells(range: &EffortRange, units: &[Unit]) -> Vec<String> {
    let one = |(effort, unit): (&OpenRange, &Unit)| {
        ends_in_words([effort.from, effort.to].map(|end| end.map(|effort| unit.number(effort))))
    };
    range.undetermined.efforts.iter().zip(units).map(one).collect()
}

/// "25 to 50", "from 25", "up to 50", "any".
fn ends_in_words(ends: [Option<String>; 2]) -> String {
    match ends {
        [Some(from), Some(to)] if from == to => from,
        [Some(from), Some(to)] => format!("{from} to {to}"),
        [Some(from), None] => format!("from {from}"),
        [None, Some(to)] => format!("up to {to}"),
        [None, None] => "any".to_owned(),
    }
}

fn course_row(row: &CourseRow, shown_in: &Unit, units: &[Unit]) -> Vec<String> {
    let mut cells = vec![shown_in.precise_number(row.at)];
    cells.push(match (&row.pattern, &row.frictionless) {
        _ if row.range.is_some() => "undetermined".to_owned(),
        (Some(pattern), _) => {
            let verdict = row.attainability.filter(|verdict| *verdict != Verdict::Attainable);
            let words = verdict.map_or_else(String::new, |one| format!("({})", verdict_in_words(one)));
            [spaced(pattern), words].join(" ").trim().to_owned()
        }
        (None, Some(_)) => "no solution".to_owned(),
        (None, None) => "no answer".to_owned(),
    });
    let drives = || units.iter().enumerate();
    let ranges = row.range.as_ref().map(|range| range_cells(range, units));
    cells.extend(ranges.unwrap_or_else(|| {
        drives()
            .map(|(drive, unit)| match (&row.efforts, row.grows.get(drive)) {
                (Some(efforts), _) => unit.number(efforts[drive]),
                (None, Some(1)) => "without bound".to_owned(),
                (None, Some(-1)) => "-without bound".to_owned(),
                _ => String::new(),
            })
            .collect()
    }));
    cells.extend(
        drives().map(|(drive, unit)| {
            row.frictionless.as_ref().map_or(String::new(), |all| unit.number(all[drive]))
        }),
    );
    let range = row.range.as_ref().and_then(|range| range.efficiency).map(percents);
    cells.push(range.or_else(|| row.efficiency.map(share)).unwrap_or_default());
    cells
}

fn share(efficiency: Efficiency) -> String {
    match (efficiency.is, efficiency.value) {
        (EfficiencyKind::Driving, Some(value)) => percent(value),
        (EfficiencyKind::Braking, Some(value)) => format!("{} braking", percent(value)),
        (is, _) => is.in_words().to_owned(),
    }
}

fn verdict_in_words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Attainable => "attainable",
        Verdict::Unattainable => "unattainable",
        Verdict::Flutter => "flutter",
        Verdict::Undecided => "undecided",
        Verdict::NotComputed => "not computed",
    }
}
