//! A motion as readable text: a log of events, and the accuracy.

use super::log::{LogLine, lines};
use super::report::{EndKind, EventReport, JAMS, Named, SimulateReport};
use super::tree::TreeReport;
use crate::report::number::{beside, number};
use crate::report::page::Page;
use crate::report::{Report, Status, Style, Verdict, count, followed, spaced};
use crate::units::Unit;

/// Energies below this fraction of the greatest are rounding.
const LITTLE: f64 = 1e-13;

/// The start, the events, the end, the energies. Of a long log, only the beginning and the end are shown.
impl Report for SimulateReport {
    fn answer(&self) -> String {
        self.end.words.clone()
    }

    fn text(&self, style: Style) -> String {
        page(self, style, false).text()
    }
}

impl SimulateReport {
    /// As readable text, with all events of a long log.
    pub fn text_with_all_events(&self, style: Style) -> String {
        page(self, style, true).text()
    }
}

fn page(report: &SimulateReport, style: Style, all_events: bool) -> Page<'_, SimulateReport> {
    let mut text = Page::new(report, style);
    text.heading();
    text.end();
    report.hints.iter().for_each(|hint| text.line(&format!("Hint: {hint}")));
    // Where nothing happens there is nothing to list.
    if report.stop > report.start || !report.events.is_empty() {
        text.events(all_events);
        text.line("");
        text.state("At the end", &report.last);
        text.energy();
        text.quality();
    }
    text
}

/// How each motion ends, then the logs.
impl Report for TreeReport {
    fn answer(&self) -> String {
        let motions = self.histories.len();
        match (motions, self.complete) {
            (1, true) => "One motion is possible: this is the only one.".to_owned(),
            (all, true) => format!("{all} motions are possible: these are all."),
            (found, false) => format!("{} found; there may be more.", count(found, "motion", "motions")),
        }
    }

    fn text(&self, style: Style) -> String {
        all_motions(self, style, false)
    }
}

impl TreeReport {
    /// As readable text, with all events of long logs.
    pub fn text_with_all_events(&self, style: Style) -> String {
        all_motions(self, style, true)
    }
}

fn all_motions(report: &TreeReport, style: Style, all_events: bool) -> String {
    let mut text = Page::new(report, style);
    text.headline(&report.answer());
    for (index, history) in report.histories.iter().enumerate() {
        text.line(&format!(
            "  {} ({}): {}",
            index + 1,
            branches(&history.branches),
            history.motion.end.words
        ));
    }
    for (index, history) in report.histories.iter().enumerate() {
        text.line("");
        text.headline(&format!("Motion {} ({})", index + 1, branches(&history.branches)));
        text.append(&page(&history.motion, style, all_events));
    }
    text.text()
}

/// "branches 1, 2"
fn branches(branches: &[usize]) -> String {
    let numbers: Vec<String> = branches.iter().map(ToString::to_string).collect();
    match numbers.as_slice() {
        [] => "without branches".to_owned(),
        [one] => format!("branch {one}"),
        several => format!("branches {}", several.join(", ")),
    }
}

impl Page<'_, SimulateReport> {
    fn heading(&mut self) {
        let report = self.report;
        let model = &report.model;
        if let Some(title) = &model.title {
            self.headline(title);
        }
        let [start, until] = [report.start, report.until].map(|time| self.seconds().show(time));
        self.state(&format!("From {start} to {until}"), &report.initial);
        if self.is_verbose() {
            let parts = [
                count(model.degrees_of_freedom, "degree of freedom", "degrees of freedom"),
                count(model.bodies, "body", "bodies"),
                count(model.contacts, "contact", "contacts"),
            ];
            self.line(&parts.join(", "));
            report.steps_from_drawing.iter().for_each(|steps| self.line(&followed(*steps)));
        }
        self.line("");
    }

    /// How it ends.
    fn end(&mut self) {
        let end = &self.report.end;
        let status = match end.kind {
            _ if end.locked => Status::None,
            EndKind::Finished | EndKind::UserEvent | EndKind::TravelLimit | EndKind::OverlapVanished => {
                Status::One
            }
            _ => Status::Unknown,
        };
        self.status(status, &end.words);
    }

    fn state(&mut self, when: &str, state: &[crate::report::CoordinateState]) {
        let rates =
            self.report.initial.iter().chain(&self.report.last).map(|coordinate| coordinate.rate.abs());
        let greatest = rates.fold(1e-6, f64::max);
        let one = |coordinate: &crate::report::CoordinateState| {
            // What is left of a velocity at rest is only rounding.
            let rate = beside(coordinate.rate, greatest);
            let size = if coordinate.unit == "m" { self.report.model.size } else { 1.0 };
            let value = beside(coordinate.value, size);
            crate::report::CoordinateState { value, rate, ..coordinate.clone() }
                .in_words(&self.report.model.units)
        };
        let parts: Vec<String> = state.iter().map(one).collect();
        self.line(&format!("{when}: {}", parts.join("; ")));
    }

    fn events(&mut self, all: bool) {
        let events = &self.report.events;
        self.line("");
        let names: Vec<&str> =
            self.report.contacts.iter().chain(&self.report.hinges).map(String::as_str).collect();
        if self.is_verbose() {
            self.headline(&format!("Events (signs of {})", names.join(", ")));
        } else {
            self.headline("Events");
        }
        let lines = lines(events, all || self.is_verbose());
        let shown = || {
            lines.iter().filter_map(|line| if let LogLine::Event(event) = line { Some(*event) } else { None })
        };
        let modes = shown().filter_map(|event| event.mode.as_ref()).map(|mode| spaced(mode).len());
        let widths = (
            shown().map(|event| when(event, &self.seconds()).len()).max().unwrap_or(0),
            modes.max().unwrap_or(0),
        );
        for line in &lines {
            match line {
                LogLine::Event(event) => self.event(event, widths),
                LogLine::LeftOut(events) => {
                    let left_out = count(*events, "event is", "events are");
                    self.line(&format!("  ... {left_out} left out here; --all-events shows them"));
                }
                LogLine::Bounces { hits, .. } => self.line(&format!(
                    "  ... it hits there {hits} times more, ever less; --all-events shows them"
                )),
            }
        }
    }

    /// The unit of times.
    fn seconds(&self) -> Unit {
        self.report.model.units.of("s")
    }

    fn event(&mut self, event: &EventReport, (time, mode): (usize, usize)) {
        let pattern = event.mode.as_deref().map(spaced).unwrap_or_default();
        let details = self.is_verbose();
        let columns = |when: &str, pattern: &str| {
            if details { format!("{when:>time$}   {pattern:mode$}   ") } else { format!("{when:>time$}   ") }
        };
        let first = columns(&when(event, &self.seconds()), &pattern);
        let note = event.attainable.map_or("", unsettled);
        self.hung(&format!("  {first}{}{note}", event.words), first.trim_start());
        let below = columns("", "");
        let mut line = |text: &str| self.hung(&format!("  {below}{text}"), "");
        for branch in event.branches.iter().filter(|branch| !branch.taken) {
            let jump = if branch.continues { "" } else { "; its forces jump" };
            let sticks = !branch.words.starts_with(JAMS) && branch.mode.chars().all(|sign| sign == '=');
            let otherwise = if sticks { "it could also stick" } else { &branch.words };
            let signs = if details { format!(", signs {}", spaced(&branch.mode)) } else { String::new() };
            let verdict = verdict(branch.attainable);
            line(&format!("or branch {}: {otherwise}{verdict}{signs}{jump}", branch.number));
        }
        if event.branches_left_out {
            line("there may be more ways to go on, with fewer joints sticking: not all were tried");
        }
    }

    fn energy(&mut self) {
        let energy = &self.report.energy;
        self.line("");
        let unit = self.report.model.units.of("J");
        self.headline(&format!("Energy ({})", unit.name()));
        let greatest = energy.kinetic.iter().chain(&energy.potential).fold(0.0_f64, |a, b| a.max(b.abs()));
        let shown = |value: f64| unit.against(value, greatest);
        let [kinetic, potential] =
            [energy.kinetic, energy.potential].map(|[start, stop]| vec![shown(start), shown(stop)]);
        let mut rows = vec![row("kinetic", kinetic), row("potential", potential)];
        let mut add = |what: &str, list: &mut dyn Iterator<Item = (&str, f64)>| {
            for (name, value) in list.filter(|(_, value)| value.abs() > LITTLE * greatest) {
                rows.push(row(&format!("{what} {name}"), vec![String::new(), unit.number(value)]));
            }
        };
        let is_pad = |named: &&Named| energy.pads.iter().any(|pad| pad.name == named.name);
        let (pads, loads): (Vec<&Named>, Vec<&Named>) = energy.loads.iter().partition(is_pad);
        add("  of which stored in", &mut energy.pads.iter().map(Named::parts));
        add("dissipated by friction at", &mut energy.friction.iter().map(Named::parts));
        add("dissipated by friction in", &mut energy.hinges.iter().map(Named::parts));
        add("dissipated by the damper of", &mut pads.into_iter().map(|pad| (pad.name.as_str(), -pad.value)));
        add("work of", &mut loads.into_iter().map(Named::parts));
        add("work of", &mut energy.drives.iter().map(Named::parts));
        if energy.impulses != 0.0 {
            rows.push(row("lost in impulses", vec![String::new(), unit.number(energy.impulses)]));
        }
        self.table(&["", "start", "end"], &rows);
    }

    /// How well it is known.
    fn quality(&mut self) {
        let report = self.report;
        self.line("");
        let (unit, part) = (report.model.units.of("J"), report.energy.relative_error);
        let error = unit.with(&format!("{:.1e}", unit.number_of(report.energy.error)));
        let part = part.filter(|_| self.is_verbose() && report.energy.error != 0.0);
        let part = part.map_or_else(String::new, |part| format!(", {part:.1e} of its greatest part"));
        let closes = match report.energy.error {
            0.0 => "the energy balance closes".to_owned(),
            _ => format!("the energy balance closes to {error}{part}"),
        };
        self.line(&format!("Computed step by step, not proven: {closes}."));
        let statistics = &report.statistics;
        if statistics.sampled.is_some() {
            self.line(
                "Sampled: whether joints can stick under loads that change was checked four times a step.",
            );
        }
        if !self.is_verbose() {
            return;
        }
        if let Some(sampled) = &statistics.sampled {
            self.line(&format!(
                "Joints stuck so for {} in all; the longest step took {}.",
                self.seconds().show(sampled.time),
                self.seconds().show(sampled.longest_step)
            ));
        }
        self.line(&format!(
            "Before each correction joints were open by at most {} of the size of the mechanism.",
            if report.position_drift == 0.0 {
                "0".to_owned()
            } else {
                format!("{:.1e}", report.position_drift)
            }
        ));
        self.line(&format!(
            "{} ({} repeated), {} evaluations of the equations, {}; tolerance {}.",
            count(statistics.steps, "step", "steps"),
            statistics.repeated,
            statistics.evaluations,
            count(statistics.events, "event with the start", "events with the start"),
            number(report.tolerance)
        ));
    }
}

fn when(event: &EventReport, unit: &Unit) -> String {
    unit.precise(event.time)
}

fn row(name: &str, mut values: Vec<String>) -> Vec<String> {
    values.insert(0, name.to_owned());
    values
}

/// A remark on the mode that follows if a mechanism does not settle on it.
fn unsettled(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Unattainable => " (unstable: a real mechanism leaves this state)",
        Verdict::Flutter => " (it may vibrate by itself (flutter) unless its contacts are damped)",
        _ => "",
    }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Attainable => " (stable)",
        Verdict::Unattainable => " (unstable: it leaves this state)",
        Verdict::Flutter => " (it may vibrate)",
        Verdict::Undecided | Verdict::NotComputed => "",
    }
}
