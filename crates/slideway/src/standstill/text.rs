//! The analysis of standstill as text for people.

use super::report::{HoldReport, HoldVerdict, LoadReport, Range, Reactions, Release, Threshold, Wedging};
use crate::report::number::number;
use crate::report::page::Page;
use crate::report::{Report, Style, count, followed, spaced};
use crate::units::Unit;
use anstyle::AnsiColor;
use std::fmt::Write;

impl Report for HoldReport {
    /// Whether it stays at rest, in one sentence: "It holds: it stays at rest."
    fn answer(&self) -> String {
        let ways = count(self.releases.len(), "state", "states");
        match self.verdict {
            HoldVerdict::Holds => "It holds: it stays at rest.".to_owned(),
            HoldVerdict::MayHold => "It holds: it can stay at rest.".to_owned(),
            HoldVerdict::HoldsUntilPushed => {
                format!(
                    "It holds. Once pushed, it keeps sliding, since kinetic friction is below static: {ways}."
                )
            }
            HoldVerdict::HoldsOrSlips => {
                format!("It can hold, but it can also begin to slide: {ways} of sliding besides rest.")
            }
            HoldVerdict::Moves => format!("It does not hold: {ways} in which it begins to move."),
            HoldVerdict::Neither => {
                "It can neither stay at rest nor begin to move with finite accelerations.".to_owned()
            }
            HoldVerdict::DoesNotHold => "It does not hold.".to_owned(),
        }
    }

    /// The verdict first, then load, reactions and release.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        text.verdict();
        text.wedging();
        text.load();
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
        text.drives();
        text.verdict();
        text.wedging();
        text.load();
        text.text().trim().to_owned()
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
        let rates = if report.rates_ignored { "; the rates of the model are set to zero" } else { "" };
        self.line(&format!("At rest at {}{rates}", values.collect::<Vec<_>>().join(", ")));
        if let Some(steps) = report.steps_from_drawing {
            self.line(&followed(steps));
        }
        self.drives();
        for line in report.sharing.iter().flat_map(|sharing| sharing.in_words(&report.units)) {
            self.line(&line);
        }
        self.line("");
    }

    fn drives(&mut self) {
        let HoldReport { released_drives, holding_drives, .. } = self.report;
        if !released_drives.is_empty() {
            self.line(&format!("Without the drives: {}", released_drives.join(", ")));
        }
        if !holding_drives.is_empty() {
            self.line(&format!("Held by the drives: {}", holding_drives.join(", ")));
        }
    }

    fn verdict(&mut self) {
        let colour = match self.report.verdict {
            HoldVerdict::Holds | HoldVerdict::MayHold | HoldVerdict::HoldsUntilPushed => AnsiColor::Green,
            HoldVerdict::HoldsOrSlips => AnsiColor::Yellow,
            HoldVerdict::Moves | HoldVerdict::Neither | HoldVerdict::DoesNotHold => AnsiColor::Red,
        };
        self.painted(colour.on_default().bold(), &self.report.answer(), "");
        self.what_holds();
        if !self.report.motions_without_inertia.is_empty() {
            let what = if self.report.holds { "Whether it could also begin" } else { "How it begins" };
            self.line(&format!("{what} to move is not determined, since these motions have no inertia:"));
            for motion in &self.report.motions_without_inertia {
                self.line(&format!("  {motion}"));
            }
        }
    }

    fn wedging(&mut self) {
        let Some(wedging) = &self.report.wedging else { return };
        self.line("");
        for line in wedging_in_words(wedging) {
            self.line(&line);
        }
    }

    /// What holds it, if that is not the friction which its loads cause.
    fn what_holds(&mut self) {
        let Some(rest) = &self.report.at_rest else { return };
        if rest.without_preloads == Some(false) {
            self.line("Its preloads hold it: without them it would not stay at rest.");
        }
        // Of redundant guides it is said from which friction on.
        if !rest.wedging.is_empty() && self.report.wedging.is_none() {
            self.line(&format!(
                "It can be wedged: {} can press against each other without any load, however hard.",
                rest.wedging.join(", ")
            ));
        }
    }

    fn load(&mut self) {
        let Some(load) = &self.report.load else { return };
        self.line("");
        self.headline(&load_title(load));
        for line in held_in_words(self.report, load) {
            self.line(&format!("  {line}"));
        }
        for line in threshold_in_words(load) {
            self.line(&format!("  {line}"));
        }
        // Of redundant guides it was said what that depends on.
        if self.report.verdict == HoldVerdict::HoldsOrSlips && self.report.wedging.is_none() {
            self.line("  At rest it is wedged in now, and it can also begin to slide: do not rely on it.");
        }
    }

    fn at_rest(&mut self) {
        let Some(rest) = &self.report.at_rest else { return };
        self.line("");
        let factor = self.report.load.as_ref().map_or(String::new(), at_factor);
        self.headline(&format!("Reactions at rest{factor}"));
        self.signs(&rest.patterns);
        self.reactions(&rest.reactions);
        if self.report.sharing.is_some() {
            self.line("  Which of these states it is in depends on how it came to rest.");
        }
    }

    /// The sides of all contacts, if there are any.
    fn signs(&mut self, patterns: &[String]) {
        let signs: Vec<String> = patterns.iter().map(|pattern| spaced(pattern)).collect();
        if signs.iter().any(|signs| !signs.is_empty()) {
            self.line(&format!("  signs {}", signs.join(" or ")));
        }
    }

    fn release(&mut self, index: usize, release: &Release) {
        self.line("");
        let title = format!("Release {} of {}", index + 1, self.report.releases.len());
        self.headline(&title);
        for joint in &release.joints {
            self.line(&format!("  {}: {}", joint.name, joint.words));
        }
        self.signs(&release.patterns);
        let scale = release.coordinates.iter().map(|c| greatest(&[c.acceleration])).fold(0.0, f64::max);
        let units = &self.report.units;
        let sliding = release.joints.iter().filter(|joint| joint.slip != 0);
        let rows: Vec<Vec<String>> = sliding
            .map(|joint| {
                let unit = units.of("m/s^2");
                let value = words(joint.acceleration, scale, &unit);
                vec![joint.name.clone(), "sliding".to_owned(), value, unit.name().to_owned()]
            })
            .chain(release.coordinates.iter().map(|coordinate| {
                let unit = units.of(coordinate.unit);
                let value = words(coordinate.acceleration, scale, &unit);
                vec![coordinate.name.clone(), "coordinate".to_owned(), value, unit.name().to_owned()]
            }))
            .collect();
        self.table(&["", "", "acceleration", "unit"], &rows);
        self.reactions(&release.reactions);
    }

    fn reactions(&mut self, reactions: &Reactions) {
        let scale = greatest(&reactions.ranges());
        let has_couple = reactions.contacts.iter().any(|contact| contact.couple.is_some());
        let [force, torque] = ["N", "N m"].map(|si| self.report.units.of(si));
        let mut header = vec!["contact".to_owned(), force.title("normal force"), force.title("friction")];
        header.extend(has_couple.then(|| torque.title("couple")));
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let rows = reactions.contacts.iter().map(|contact| {
            let mut row = vec![
                contact.name.clone(),
                words(contact.normal_force, scale, &force),
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
            self.table(&header, &rows);
        }
        for drive in &reactions.drives {
            let unit = self.report.units.of(drive.unit);
            let effort = unit.with(&words(drive.effort, scale, &unit));
            self.line(&format!("  {}: {effort}", drive.name));
        }
    }

    fn tried(&mut self) {
        let report = self.report;
        self.line("");
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

fn load_title(load: &LoadReport) -> String {
    if load.unit.is_empty() {
        format!("The load {}, multiplied by a factor", load.name)
    } else {
        format!("The effort of the drive {} as a load", load.name)
    }
}

fn at_factor(load: &LoadReport) -> String {
    if load.unit.is_empty() { String::new() } else { format!(" without {}", load.name) }
}

fn held_in_words(report: &HoldReport, load: &LoadReport) -> Vec<String> {
    let what = if load.unit.is_empty() { "factor" } else { "effort" };
    let unit = report.units.of(load.unit);
    let one = |range: &Range| match (range.least, range.greatest) {
        (None, None) => format!("every {what}"),
        (Some(least), None) => format!("every {what} from {} on", unit.show(least)),
        (None, Some(greatest)) => format!("every {what} up to {}", unit.show(greatest)),
        (Some(least), Some(greatest)) if least == greatest => {
            format!("the {what} {} only", unit.show(least))
        }
        (Some(least), Some(greatest)) => {
            format!("{what}s from {} to {}", unit.number(least), unit.show(greatest))
        }
    };
    let mut lines = match load.held.as_slice() {
        [] => vec![format!("It holds with no {what}.")],
        held => {
            vec![format!("It holds with {}.", held.iter().map(one).collect::<Vec<_>>().join(", and with "))]
        }
    };
    // Where no sliding is possible the load itself sees to it that it is held.
    let is_sure =
        load.factor == 1.0 && matches!(report.verdict, HoldVerdict::Holds | HoldVerdict::HoldsUntilPushed);
    let is_wedged = report.at_rest.as_ref().is_some_and(|rest| !rest.wedging.is_empty());
    lines.push(match (load.self_locking, is_wedged && !is_sure) {
        (true, false) => "Self-locking: no load is too great.".to_owned(),
        (true, true) => {
            "No load is too great while it stays wedged, which need not be the load's doing.".to_owned()
        }
        (false, _) => "Not self-locking: a sufficiently large load moves it.".to_owned(),
    });
    lines
}

fn threshold_in_words(load: &LoadReport) -> Vec<String> {
    let varied = &load.threshold.varied;
    let Some(value) = load.threshold.value else {
        return vec![format!("No {varied} makes it self-locking for {} alone.", load.name)];
    };
    if value == 0.0 {
        return vec![format!("{} alone is held whatever its magnitude, without friction.", load.name)];
    }
    let what = threshold_value(&load.threshold, value);
    let mut lines = vec![format!("For {} alone: self-locking from {what} on, free below it.", load.name)];
    lines.extend(coefficients_in_words(&load.threshold));
    lines
}

/// From which friction on guides that share a load wedge.
fn wedging_in_words(wedging: &Wedging) -> Vec<String> {
    let Wedging { possible, threshold } = wedging;
    let Some(value) = threshold.value else {
        return vec![format!("No {} lets the guides be wedged.", threshold.varied)];
    };
    let what = threshold_value(threshold, value);
    let whole = if *possible {
        format!(
            "The guides can be wedged: once pressed against each other, however hard, they stay so without any load. That is \
             so from {what} on. Then nothing bounds the loads that friction can hold, and whether it holds one depends on how \
             it came to rest."
        )
    } else {
        format!(
            "The guides cannot be wedged. From {what} on they can: once pressed against each other, however hard, they stay \
             so without any load."
        )
    };
    [whole].into_iter().chain(coefficients_in_words(threshold)).collect()
}

/// "2 times the static friction of the model", "mu = 0.6 (the model has 0.3)".
fn threshold_value(threshold: &Threshold, value: f64) -> String {
    if threshold.varied == "static friction" {
        format!("{} times the static friction of the model", number(value))
    } else {
        format!("{} = {} (the model has {})", threshold.varied, number(value), number(threshold.present))
    }
}

/// The static coefficients at the threshold; nothing without contacts.
fn coefficients_in_words(threshold: &Threshold) -> Option<String> {
    let Threshold { coefficients, friction_in_hinges, .. } = threshold;
    if coefficients.is_empty() {
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
        let named = coefficients.iter().map(|c| format!("{}: {}", c.contact, list(c.mu_static)));
        named.collect::<Vec<_>>().join(", ")
    };
    // Hinges have coefficients of their own, or friction circles without any.
    let whose = if *friction_in_hinges { " of the sliding joints" } else { "" };
    Some(format!("There mu_static{whose} is {coefficients}."))
}

/// Greatest finite magnitude among the ends.
fn greatest(ranges: &[Range]) -> f64 {
    let ends = ranges.iter().flat_map(|range| [range.least, range.greatest]).flatten();
    ends.map(f64::abs).fold(0.0, f64::max)
}

/// "3", "1 to 3", "from 1 on", "up to 3" or "any".
fn words(range: Range, scale: f64, unit: &Unit) -> String {
    // What is left over by the linear programs is no range.
    let noise = 1e3 * scale;
    let number = |value: f64| unit.against(value, noise);
    match (range.least, range.greatest) {
        (Some(least), Some(greatest))
            if number(least) == number(greatest) || greatest - least <= 1e-10 * scale =>
        {
            number(f64::midpoint(least, greatest))
        }
        (Some(least), Some(greatest)) => format!("{} to {}", number(least), number(greatest)),
        (Some(least), None) => format!("from {} on", number(least)),
        (None, Some(greatest)) => format!("up to {}", number(greatest)),
        (None, None) => "any".to_owned(),
    }
}
