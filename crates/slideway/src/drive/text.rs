//! Driven motion as text for people.

use super::report::{
    Approach, BlowUp, Course, CourseDirection, CourseRow, DriveDirection, DriveReport, Efficiency,
    EfficiencyKind, Sense,
};
use crate::limits::{RangeWithoutProblem, no_answer};
use crate::report::number::number;
use crate::report::number::precise;
use crate::report::page::Page;
use crate::report::table::table;
use crate::report::{Report, Status, Style, Verdict, spaced};

impl Report for DriveReport {
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

/// One sentence for each direction, and one for each factor of friction at which its efforts grow without
/// bound.
pub(super) fn conclusion(report: &DriveReport, locked: &str) -> Vec<String> {
    let mut sentences = Vec::new();
    for direction in &report.directions {
        sentences.push(format!("{}: {}.", moving(direction.direction), outcome(report, direction, locked)));
        let blow_ups = direction.blow_ups.iter().flatten();
        sentences.extend(blow_ups.map(|blow_up| {
            format!(
                "{}: at {} times the friction {}.",
                moving(direction.direction),
                precise(blow_up.at),
                without_bound(report, blow_up)
            )
        }));
    }
    sentences
}

fn moving(direction: Sense) -> &'static str {
    if direction == Sense::Model { "Moving as in the model" } else { "Moving in the opposite direction" }
}

/// "push needs 36.364 N instead of 20 N without friction, efficiency 55 %"
fn outcome(report: &DriveReport, direction: &DriveDirection, locked: &str) -> String {
    match (direction.solutions.as_slice(), direction.status) {
        ([], Status::Unknown) => "it is not known which effort moves it".to_owned(),
        ([], _) => format!("no effort moves it, {locked}"),
        ([only], _) => {
            let one = |(drive, (with, without)): (&super::DriveName, (&f64, &f64))| {
                format!(
                    "{} needs {} {} instead of {} {} without friction",
                    drive.name,
                    number(*with),
                    drive.unit,
                    number(*without),
                    drive.unit
                )
            };
            let efforts = only.efforts.iter().zip(&direction.frictionless.efforts);
            let needs: Vec<String> = report.drives.iter().zip(efforts).map(one).collect();
            format!("{}; {}", needs.join(", "), efficiency_in_words(only.efficiency))
        }
        (several, _) => format!("{} states are possible, each with its own efforts", several.len()),
    }
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
    let from = if blow_up.side == Approach::Above { " from above" } else { "" };
    format!(
        "the {what} of {} {verb} without bound{from} in the mode {}{also}",
        growing.join(", "),
        spaced(&blow_up.pattern)
    )
}

impl Page<'_, DriveReport> {
    fn heading(&mut self) {
        let report = self.report;
        if let Some(title) = &report.title {
            self.headline(title);
        }
        let state = report.state.iter().map(|coordinate| {
            format!(
                "{} = {} {}, rate {} {}/s",
                coordinate.name,
                number(coordinate.value),
                coordinate.unit,
                number(coordinate.rate),
                coordinate.unit
            )
        });
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
        header.extend(["power in W", "efficiency", "contact mode"].map(str::to_owned));
        let frictionless = &direction.frictionless;
        let mut rows = vec![row(["without friction", ""], &frictionless.efforts, frictionless.power)];
        rows[0].extend([String::new(), String::new()]);
        for solution in &direction.solutions {
            let mut one = row(
                [&spaced(&solution.pattern), verdict(solution.attainability)],
                &solution.efforts,
                solution.power,
            );
            let words = solution.joints.iter().map(|joint| format!("{} {}", joint.name, joint.mode));
            one.extend([share(solution.efficiency), words.collect::<Vec<_>>().join("; ")]);
            rows.push(one);
        }
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        self.lines(&table(&header, &rows, 2));
    }

    fn effort_titles(&self) -> Vec<String> {
        self.report.drives.iter().map(|drive| format!("{} in {}", drive.name, drive.unit)).collect()
    }

    fn course(&mut self, course: &Course) {
        for direction in &course.directions {
            self.line("");
            self.headline(&format!("{}, over {}", moving(direction.direction), course.vary.name));
            self.lines(&self.course_table(course, direction));
            for blow_up in &direction.blow_ups {
                let told = without_bound(self.report, blow_up);
                let unit = if course.vary.unit.is_empty() { "" } else { " " };
                self.line(&format!(
                    "  At {} = {}{unit}{} {told}.",
                    course.vary.name,
                    precise(blow_up.at),
                    course.vary.unit
                ));
            }
            for RangeWithoutProblem { from, to, reason } in &direction.without_mode_problem {
                self.line(&no_answer([*from, *to], reason));
            }
        }
        self.line("");
        self.line(&course.guarantee);
    }

    fn course_table(&self, course: &Course, direction: &CourseDirection) -> String {
        let name = match course.vary.unit.as_str() {
            "" => course.vary.name.clone(),
            unit => format!("{} in {unit}", course.vary.name),
        };
        let mut header = vec![name, "signs".to_owned()];
        header.extend(self.effort_titles());
        header.extend(self.report.drives.iter().map(|drive| format!("{} without friction", drive.name)));
        header.push("efficiency".to_owned());
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let rows: Vec<Vec<String>> =
            direction.rows.iter().map(|row| course_row(row, self.report.drives.len())).collect();
        table(&header, &rows, 0)
    }
}

fn row([signs, verdict]: [&str; 2], efforts: &[f64], power: f64) -> Vec<String> {
    let mut row = vec![signs.to_owned(), verdict.to_owned()];
    row.extend(efforts.iter().chain([&power]).copied().map(number));
    row
}

fn course_row(row: &CourseRow, drives: usize) -> Vec<String> {
    let mut cells = vec![precise(row.at)];
    cells.push(match (&row.pattern, &row.frictionless) {
        (Some(pattern), _) => spaced(pattern),
        (None, Some(_)) => "no solution".to_owned(),
        (None, None) => "no position".to_owned(),
    });
    cells.extend((0..drives).map(|drive| match (&row.efforts, row.grows.get(drive)) {
        (Some(efforts), _) => number(efforts[drive]),
        (None, Some(1)) => "without bound".to_owned(),
        (None, Some(-1)) => "-without bound".to_owned(),
        _ => String::new(),
    }));
    let frictionless =
        |drive: usize| row.frictionless.as_ref().map_or(String::new(), |all| number(all[drive]));
    cells.extend((0..drives).map(frictionless));
    cells.push(row.efficiency.map_or(String::new(), share));
    cells
}

fn share(efficiency: Efficiency) -> String {
    match (efficiency.is, efficiency.value) {
        (EfficiencyKind::Driving, Some(value)) => percent(value),
        (EfficiencyKind::Braking, Some(value)) => format!("{} braking", percent(value)),
        (EfficiencyKind::HeldByFriction, _) => "held by friction".to_owned(),
        (EfficiencyKind::NoPower, _) => "no power".to_owned(),
        _ => "none".to_owned(),
    }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Attainable => "attainable",
        Verdict::Unattainable => "unattainable",
        Verdict::Flutter => "flutter",
        Verdict::Undecided => "undecided",
        Verdict::NotComputed => "not computed",
    }
}
