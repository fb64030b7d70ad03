//! A design as text for people.

use super::report::{MarginKind, MetEnd, MetInterval, SampleKind, SizeReport};
use super::words::{level, subject};
use crate::limits::could_be_missed;
use crate::report::effort::times;
use crate::report::number::precise;
use crate::report::page::Page;
use crate::report::{CoordinateState, Report, Style};

impl Report for SizeReport {
    fn answer(&self) -> String {
        self.conclusion.iter().take(2).cloned().collect::<Vec<_>>().join(" ")
    }

    /// The conclusion, where the margin is met, and a table of margins.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        text.intervals();
        text.margins();
        text.text()
    }
}

impl Page<'_, SizeReport> {
    fn heading(&mut self) {
        let report = self.report;
        if let Some(title) = &report.title {
            self.headline(title);
        }
        let vary = &report.vary;
        self.line(&vary.shown_in.range(&vary.name, [vary.from, vary.to]));
        let at = |one: &CoordinateState| match report.against {
            MarginKind::SelfLocking | MarginKind::Hold => {
                format!("At rest at {} = {}", one.name, report.units.of(one.unit).show(one.value))
            }
            _ => one.in_words(&report.units),
        };
        report.state.iter().for_each(|one| self.line(&at(one)));
        self.line("");
        for sentence in &report.conclusion {
            self.headline(sentence);
        }
        if self.is_verbose() {
            self.line(&report.guarantee);
        } else {
            let step = report.vary.shown_in.brief(report.narrowest);
            self.line(&could_be_missed(&step));
        }
    }

    fn intervals(&mut self) {
        let report = self.report;
        if report.met.is_empty() || !self.is_verbose() {
            return;
        }
        self.line("");
        let (what, limit) = (subject(report), level(report, report.margin));
        let side = if report.against.is_greatest() { "at most" } else { "at least" };
        self.headline(&format!("Where the {what} is {side} {limit}"));
        let rows: Vec<Vec<String>> = report.met.iter().map(|interval| row(report, interval)).collect();
        let [from, to] = ["from", "to"].map(|end| report.vary.shown_in.title(end));
        self.table(&[&from, &to, "begins with", "ends with"], &rows);
    }

    fn margins(&mut self) {
        let report = self.report;
        let is_constant = report
            .samples
            .windows(2)
            .all(|pair| (pair[0].is, pair[0].margin) == (pair[1].is, pair[1].margin));
        if is_constant && !self.is_verbose() {
            return;
        }
        self.line("");
        let what = subject(report);
        self.headline(&if report.against.is_limit() {
            format!("The {what}")
        } else {
            "Safety factors".to_owned()
        });
        let unit = &report.vary.shown_in;
        let name = unit.title(&report.vary.name);
        let margin = |sample: &super::Sample| match (sample.is, sample.margin) {
            (SampleKind::Infinite, _) => "infinite".to_owned(),
            (SampleKind::WithoutBound, _) => "without bound".to_owned(),
            (SampleKind::NeedsFriction, _) => "none".to_owned(),
            (_, Some(margin)) => report.limit_shown_in.precise_number(margin),
            (SampleKind::NoSolution, _) => report.against.nothing().to_owned(),
            _ => "no answer".to_owned(),
        };
        let header = report.limit_shown_in.title(&what);
        let needs = report.samples.iter().any(|sample| sample.least_friction.is_some());
        let row = |sample: &super::Sample| {
            let least = sample.least_friction.map_or_else(String::new, times);
            let least = needs.then_some(least);
            [unit.precise_number(sample.at), margin(sample)].into_iter().chain(least).collect()
        };
        let mut rows: Vec<Vec<String>> = report.samples.iter().map(row).collect();
        rows.dedup();
        let titles = [&*name, &header, "tips or jams below"];
        self.table(&titles[..if needs { 3 } else { 2 }], &rows);
    }
}

fn row(report: &SizeReport, interval: &MetInterval) -> Vec<String> {
    vec![
        report.vary.shown_in.precise_number(interval.from),
        report.vary.shown_in.precise_number(interval.to),
        cause(report, interval.from_is, interval.from_jumps_to),
        cause(report, interval.to_is, interval.to_jumps_to),
    ]
}

fn cause(report: &SizeReport, is: MetEnd, jumps_to: Option<f64>) -> String {
    match (is, jumps_to) {
        (MetEnd::Range, _) => "end of the range".to_owned(),
        (MetEnd::Margin, _) if report.against.is_limit() => "the limit".to_owned(),
        (MetEnd::Margin, _) => format!("safety factor {}", precise(report.margin)),
        (MetEnd::Jump, Some(margin)) => {
            format!("a jump of the {} to {}", subject(report), level(report, margin))
        }
        (MetEnd::Jump, None) => format!("a jump of the {}", subject(report)),
        _ => "no answer".to_owned(),
    }
}
