//! A motion as readable text: a log of events, and the accuracy.

use super::report::{EventReport, Named, SimulateReport};
use super::tree::TreeReport;
use crate::report::number::{against, number};
use crate::report::page::Page;
use crate::report::{Report, Style, Verdict, count, followed, spaced};
use crate::units::Unit;

/// Energies below this fraction of the greatest are rounding.
const LITTLE: f64 = 1e-13;
/// From a longer log, this many events are shown at the beginning, ...
const FIRST: usize = 40;
/// ... and this many at the end.
const LAST: usize = 10;

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
    text.events(all_events);
    text.line("");
    text.headline(&report.end.words);
    report.hints.iter().for_each(|hint| text.line(&format!("Hint: {hint}")));
    text.last_state();
    text.energy();
    text.quality();
    text
}

/// How each motion ends, then the logs.
impl Report for TreeReport {
    fn answer(&self) -> String {
        let number = count(self.histories.len(), "motion", "motions");
        let completeness = if self.complete { "these are all" } else { "there are more" };
        format!("{number}; {completeness}.")
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
        let parts = [
            count(model.degrees_of_freedom, "degree of freedom", "degrees of freedom"),
            count(model.bodies, "body", "bodies"),
            count(model.contacts, "contact", "contacts"),
        ];
        let [start, until] = [report.start, report.until].map(|time| self.seconds().show(time));
        self.line(&format!("{}; from {start} to {until}", parts.join(", ")));
        self.line("");
        self.state("At the start", &report.initial);
        if let Some(steps) = report.steps_from_drawing {
            self.line(&followed(steps));
        }
    }

    fn state(&mut self, when: &str, state: &[crate::report::CoordinateState]) {
        let rates =
            self.report.initial.iter().chain(&self.report.last).map(|coordinate| coordinate.rate.abs());
        let greatest = rates.fold(1e-6, f64::max);
        let one = |coordinate: &crate::report::CoordinateState| {
            // What is left of a velocity at rest is only rounding.
            let rate = if against(coordinate.rate, greatest) == "0" { 0.0 } else { coordinate.rate };
            crate::report::CoordinateState { rate, ..coordinate.clone() }.in_words(&self.report.model.units)
        };
        let parts: Vec<String> = state.iter().map(one).collect();
        self.line(&format!("{when}: {}", parts.join("; ")));
    }

    fn last_state(&mut self) {
        self.state("At the end", &self.report.last);
    }

    fn events(&mut self, all: bool) {
        let events = &self.report.events;
        self.line("");
        let names: Vec<&str> =
            self.report.contacts.iter().chain(&self.report.hinges).map(String::as_str).collect();
        self.headline(&format!("Events (modes of {})", names.join(", ")));
        let all = all || events.len() <= FIRST + LAST;
        let (first, last) = if all { (events.len(), events.len()) } else { (FIRST, events.len() - LAST) };
        let shown = || events[..first].iter().chain(&events[last..]);
        let modes = shown().filter_map(|event| event.mode.as_ref()).map(|mode| spaced(mode).len());
        let widths = (
            shown().map(|event| when(event, &self.seconds()).len()).max().unwrap_or(0),
            modes.max().unwrap_or(0),
        );
        events[..first].iter().for_each(|event| self.event(event, widths));
        if !all {
            let left_out = count(last - first, "event is", "events are");
            self.line(&format!("  ... {left_out} omitted here; --all-events prints all of them"));
            events[last..].iter().for_each(|event| self.event(event, widths));
        }
    }

    /// The unit of times.
    fn seconds(&self) -> Unit {
        self.report.model.units.of("s")
    }

    fn event(&mut self, event: &EventReport, (time, mode): (usize, usize)) {
        let pattern = event.mode.as_deref().map(spaced).unwrap_or_default();
        self.line(&format!("  {:>time$}   {pattern:mode$}   {}", when(event, &self.seconds()), event.words));
        for branch in event.branches.iter().filter(|branch| !branch.taken) {
            let jump = if branch.continues { "" } else { ", with a jump" };
            let text = format!(
                "could also continue as {}{jump}{} (branch {})",
                spaced(&branch.mode),
                verdict(branch.attainable),
                branch.number
            );
            self.line(&format!("  {:time$}   {:mode$}     {text}", "", ""));
        }
        if event.branches_left_out {
            let text =
                "there may be further continuations in which fewer joints stick: not all states were tried";
            self.line(&format!("  {:time$}   {:mode$}     {text}", "", ""));
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
        let mut add = |what: &str, list: &[Named]| {
            for Named { name, value } in list.iter().filter(|named| named.value.abs() > LITTLE * greatest) {
                rows.push(row(&format!("{what} {name}"), vec![String::new(), unit.number(*value)]));
            }
        };
        add("dissipated by friction at", &energy.friction);
        add("dissipated by friction in", &energy.hinges);
        add("work of", &energy.loads);
        add("work of", &energy.drives);
        if energy.impulses != 0.0 {
            rows.push(row("lost in impulses", vec![String::new(), unit.number(energy.impulses)]));
        }
        self.table(&["", "start", "end"], &rows);
    }

    fn quality(&mut self) {
        let report = self.report;
        self.line("");
        let (unit, part) = (report.model.units.of("J"), report.energy.relative_error);
        let error = unit.with(&format!("{:.1e}", unit.number_of(report.energy.error)));
        self.line(&match part {
            _ if report.energy.error == 0.0 => "The energy balance closes.".to_owned(),
            Some(part) => format!("The energy balance closes to {error}, {part:.1e} of the greatest term."),
            None => format!("The energy balance closes to {error}."),
        });
        self.line(&format!(
            "Joints had drifted by at most {:.1e} of the size of the mechanism before each correction.",
            report.position_drift
        ));
        let statistics = &report.statistics;
        if let Some(sampled) = &statistics.sampled {
            self.line(&format!(
                "For a total of {} joints stuck under loads that change with time without a proof that they can: this was checked four \
                 times in each step, the longest of {}.",
                self.seconds().show(sampled.time),
                self.seconds().show(sampled.longest_step)
            ));
        }
        self.line(&format!(
            "{} ({} repeated), {} of the equations, {}; tolerance {}.",
            count(statistics.steps, "step", "steps"),
            statistics.repeated,
            format_args!("{} evaluations", statistics.evaluations),
            count(statistics.events, "event", "events"),
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

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Attainable => ", attainable",
        Verdict::Unattainable => ", unattainable",
        Verdict::Flutter => ", with flutter",
        Verdict::Undecided | Verdict::NotComputed => "",
    }
}
