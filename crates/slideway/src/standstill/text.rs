//! The analysis of standstill as text for people.

use super::answer::{self, wedges, without_inertia};
use super::ranges::{greatest, is_one_value, words};
use super::report::{HoldReport, HoldVerdict, LoadReport, Range, Reactions, Release, Threshold};
use crate::report::number::number;
use crate::report::page::Page;
use crate::report::{Report, Style, count, followed, spaced};
use crate::units::Unit;
use anstyle::AnsiColor;
use std::fmt::Write;

impl Report for HoldReport {
    /// The verdict on rest, and which loads it holds: "It holds."
    fn answer(&self) -> String {
        answer::answer(self)
    }

    /// The verdict first, then load, reactions and release.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        text.verdict();
        text.wedging();
        text.remarks();
        text.at_rest();
        for (index, release) in self.releases.iter().enumerate() {
            text.release(index, release);
        }
        text.tried();
        text.text()
    }
}

impl HoldReport {
    /// Which drives are taken as absent or hold, whether it stays at rest, and what is known of the load that
    /// is varied, in lines of words.
    pub fn verdict_in_words(&self) -> String {
        let mut text = Page::new(self, Style::PLAIN);
        self.drives_in_words().iter().for_each(|line| text.line(line));
        text.verdict();
        text.wedging();
        text.remarks();
        text.text().trim().to_owned()
    }

    /// "Without the drive push", "Held by the drives lift, swing"
    fn drives_in_words(&self) -> Vec<String> {
        let drives = |how: &str, names: &[String]| {
            let what = if names.len() == 1 { "drive" } else { "drives" };
            (!names.is_empty()).then(|| format!("{how} the {what} {}", names.join(", ")))
        };
        let kinds = [drives("Without", &self.released_drives), drives("Held by", &self.holding_drives)];
        kinds.into_iter().flatten().collect()
    }
}

type Text<'r> = Page<'r, HoldReport>;

impl Text<'_> {
    fn heading(&mut self) {
        let report = self.report;
        if let Some(title) = &report.title {
            self.headline(title);
        }
        let values =
            report.state.iter().map(|c| format!("{} = {}", c.name, report.units.of(c.unit).show(c.value)));
        let rates = if report.rates_ignored { " (its rates are ignored)" } else { "" };
        self.line(&format!("At rest at {}{rates}", values.collect::<Vec<_>>().join(", ")));
        report.drives_in_words().iter().for_each(|line| self.line(line));
        if self.is_verbose() {
            report.steps_from_drawing.iter().for_each(|steps| self.line(&followed(*steps)));
            for line in report.sharing.iter().flat_map(|sharing| sharing.in_words(&report.units)) {
                self.line(&line);
            }
        }
        self.line("");
    }

    fn verdict(&mut self) {
        let colour = match self.report.verdict {
            HoldVerdict::Holds | HoldVerdict::MayHold | HoldVerdict::HoldsUntilPushed => AnsiColor::Green,
            HoldVerdict::HoldsOrSlips => AnsiColor::Yellow,
            HoldVerdict::Moves | HoldVerdict::Neither | HoldVerdict::DoesNotHold => AnsiColor::Red,
        };
        self.painted(colour.on_default().bold(), &self.report.answer());
        self.what_holds();
    }

    fn wedging(&mut self) {
        let Some(wedging) = &self.report.wedging else { return };
        let details = self.is_verbose();
        let lines = wedges(wedging);
        lines.iter().for_each(|line| self.line(line));
        if let Some(coefficients) = coefficients_in_words(&wedging.threshold).filter(|_| details) {
            self.line(&format!("The friction from which they can: {coefficients}."));
        }
    }

    /// Remarks on what the answer leaves open, and with details from which coefficients on it is
    /// self-locking.
    fn remarks(&mut self) {
        let report = self.report;
        without_inertia(report).iter().for_each(|line| self.line(line));
        report.one_face_hints.iter().for_each(|hint| self.line(&hint.words));
        if !self.is_verbose() {
            return;
        }
        for motion in &report.motions_without_inertia {
            self.hung(&format!("  without mass: {motion}"), "without mass: ");
        }
        if let Some(load) = report.load.as_ref().filter(|load| load.threshold.undecided == 0) {
            let coefficients = coefficients_in_words(&load.threshold).map(|list| format!(": {list}"));
            self.line(&format!("{}{}.", threshold_in_words(load), coefficients.unwrap_or_default()));
        }
    }

    /// The cause of rest, if that is not the friction which its loads cause.
    fn what_holds(&mut self) {
        let Some(rest) = &self.report.at_rest else { return };
        if rest.without_preloads == Some(false) {
            self.line("Its preloads hold it: without them it would move.");
        }
        // Of redundant guides it is said from which friction on.
        if !rest.wedging.is_empty() && self.report.wedging.is_none() {
            self.line(&format!(
                "It can wedge: {} can press against each other without any load, however hard.",
                rest.wedging.join(", ")
            ));
        }
    }

    fn at_rest(&mut self) {
        let Some(rest) = &self.report.at_rest else { return };
        self.line("");
        let factor = self.report.load.as_ref().map_or(String::new(), at_factor);
        self.headline(&format!("Reactions at rest{factor}"));
        self.signs(&rest.patterns);
        self.reactions(&rest.reactions);
        let ranges = rest.reactions.ranges();
        let scale = greatest(&ranges);
        if ranges.iter().any(|range| !is_one_value(*range, scale)) {
            self.line("  Which of these values it has depends on how it came to rest.");
        }
    }

    /// The sides of all contacts, if there are any.
    fn signs(&mut self, patterns: &[String]) {
        if !self.is_verbose() {
            return;
        }
        let signs: Vec<String> = patterns.iter().map(|pattern| spaced(pattern)).collect();
        if signs.iter().any(|signs| !signs.is_empty()) {
            self.line(&format!("  signs {}", signs.join(" or ")));
        }
    }

    fn release(&mut self, index: usize, release: &Release) {
        self.line("");
        let title = match self.report.releases.len() {
            1 => "Start of the motion".to_owned(),
            all => format!("Start of the motion, {} of {all}", index + 1),
        };
        self.headline(&title);
        for joint in &release.joints {
            self.line(&format!("  {}: {}", joint.name, joint.words));
        }
        self.signs(&release.patterns);
        let gaps = release.gaps.iter().map(|gap| gap.acceleration);
        let accelerations: Vec<Range> =
            release.coordinates.iter().map(|c| c.acceleration).chain(gaps).collect();
        let scale = greatest(&accelerations);
        let units = &self.report.units;
        let sliding = release.joints.iter().filter(|joint| joint.slip != 0);
        let rows: Vec<Vec<String>> = sliding
            .map(|joint| {
                let unit = units.of("m/s^2");
                let value = words(joint.acceleration, scale, &unit);
                vec![joint.name.clone(), "sliding".to_owned(), value, unit.name().to_owned()]
            })
            .chain(release.gaps.iter().map(|gap| {
                let unit = units.of("m/s^2");
                let value = words(gap.acceleration, scale, &unit);
                vec![gap.contact.clone(), "gap".to_owned(), value, unit.name().to_owned()]
            }))
            .chain(release.coordinates.iter().map(|coordinate| {
                let unit = units.of(coordinate.unit);
                let value = words(coordinate.acceleration, scale, &unit);
                vec![coordinate.name.clone(), "coordinate".to_owned(), value, unit.name().to_owned()]
            }))
            .collect();
        self.gap();
        self.table(&["", "", "acceleration", "unit"], &rows);
        self.gap();
        self.reactions(&release.reactions);
    }

    fn reactions(&mut self, reactions: &Reactions) {
        // Where nothing presses, what is left of forces is rounding beside the loads.
        let scale = greatest(&reactions.ranges()).max(self.report.force);
        let has_couple = reactions.contacts.iter().any(|contact| contact.couple.is_some());
        let [force, torque] = ["N", "N m"].map(|si| self.report.units.of(si));
        let mut header = vec!["contact".to_owned(), force.title("normal force"), force.title("friction")];
        header.extend(has_couple.then(|| torque.title("couple")));
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let rows = reactions.contacts.iter().map(|contact| {
            let mut row = vec![
                contact.name.clone(),
                in_parts(contact.normal_forces(), scale, &force),
                words(contact.friction_force, scale, &force),
            ];
            row.extend(
                has_couple
                    .then(|| contact.couple.map_or(String::new(), |couple| words(couple, scale, &torque))),
            );
            row
        });
        let rows: Vec<Vec<String>> = rows.collect();
        if !rows.is_empty() {
            self.table(&header, &rows);
        }
        let has_friction = reactions.hinges.iter().any(|hinge| hinge.couple.is_some());
        let hinges = reactions.hinges.iter().map(|hinge| {
            let what = format!("hinge force on {}", hinge.on);
            let [x, y] = hinge.force.map(|component| words(component, scale, &force));
            let couple = hinge.couple.map_or(String::new(), |couple| words(couple, scale, &torque));
            [vec![hinge.name.clone(), what, x, y], if has_friction { vec![couple] } else { Vec::new() }]
                .concat()
        });
        let rows: Vec<Vec<String>> = hinges.collect();
        if !rows.is_empty() {
            let mut header = vec![String::new(), String::new(), force.title("x"), force.title("y")];
            header.extend(has_friction.then(|| torque.title("friction couple")));
            let header: Vec<&str> = header.iter().map(String::as_str).collect();
            if !reactions.contacts.is_empty() {
                self.gap();
            }
            self.table(&header, &rows);
        }
        for drive in &reactions.drives {
            let unit = self.report.units.of(drive.unit);
            let effort = unit.with(&words(drive.effort, scale, &unit));
            self.line(&format!("  {}: {effort}", drive.name));
        }
    }

    /// How it is known.
    fn tried(&mut self) {
        let report = self.report;
        self.line("");
        self.line(match report.undecided {
            0 => "Computed, not proven: every state of joints and contacts was examined.",
            _ => "Some states of joints and contacts could not be examined.",
        });
        if !self.is_verbose() {
            return;
        }
        let mut line = match report.rest_patterns {
            1 => "The only pattern of contact sides was tried for rest".to_owned(),
            all => format!("All {all} patterns of contact sides were tried for rest"),
        };
        if report.motions_without_inertia.is_empty() {
            let states = count(report.release_patterns, "state", "states");
            let _ = write!(line, ", and {states} of joints and sides for sliding");
        }
        line.push('.');
        if report.undecided > 0 {
            let programs = count(report.undecided, "of them was", "of them were");
            let _ = write!(line, " {programs} not decided: a linear program was not solved.");
        }
        self.line(&line);
    }
}

fn at_factor(load: &LoadReport) -> String {
    if load.unit.is_empty() { String::new() } else { format!(" without {}", load.name) }
}

/// From which friction on the load alone is held, however great.
fn threshold_in_words(LoadReport { name, threshold, .. }: &LoadReport) -> String {
    match threshold.value {
        None => format!("{name} alone is not held by any {}, however great", threshold.varied),
        Some(0.0) => format!("{name} alone is held without friction, however great"),
        Some(value) if threshold.varied == "static friction" => {
            format!(
                "{name} alone is held, however great, from {} times this static friction on",
                number(value)
            )
        }
        Some(value) => {
            let (at, now) = (number(value), number(threshold.present));
            format!("{name} alone is held, however great, from {} = {at} on (now {now})", threshold.varied)
        }
    }
}

/// The static coefficients at the threshold, "mu_static = 0.5"; none without contacts, or where no friction is needed.
fn coefficients_in_words(threshold: &Threshold) -> Option<String> {
    let Threshold { coefficients, friction_in_hinges, .. } = threshold;
    if coefficients.is_empty() || threshold.value == Some(0.0) {
        return None;
    }
    let list = |[plus, minus]: [f64; 2]| {
        if plus == minus { number(plus) } else { format!("{} (+), {} (-)", number(plus), number(minus)) }
    };
    let mut found: Vec<String> = coefficients.iter().map(|c| list(c.mu_static)).collect();
    found.dedup();
    let coefficients = if let [one] = found.as_slice() {
        one.clone()
    } else {
        let named = coefficients.iter().map(|c| format!("{} ({})", list(c.mu_static), c.contact));
        named.collect::<Vec<_>>().join(", ")
    };
    // Hinges have coefficients of their own, or friction circles without any.
    let whose = if *friction_in_hinges { " of the sliding joints" } else { "" };
    Some(format!("mu_static{whose} = {coefficients}"))
}

/// "any", "-118 or less, or 47.2 or more"
fn in_parts(parts: &[Range], scale: f64, unit: &Unit) -> String {
    parts.iter().map(|part| words(*part, scale, unit)).collect::<Vec<_>>().join(", or ")
}
