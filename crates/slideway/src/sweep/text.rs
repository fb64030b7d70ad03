//! The summary of a sweep as text for people.

use super::{PointStatus, Probability, Sweep, SweepState};
use crate::report::number::number;
use crate::report::page::Page;
use crate::report::{Status, Style};
use crate::units::number::brief;

/// The advice on guided sliders that tip.
const AS_BLOCK: &str = "Model it as a block slider to see whether it still moves.";

impl Sweep {
    /// How many of the points jam, or with samples the probability of it: "It jams at 34 of 101 points."
    pub fn answer(&self, state: &SweepState) -> String {
        let tally = &state.tally;
        let all = tally.points - tally.breakpoints;
        if tally.solved() == 0 {
            return format!("None of {} could be solved.", counted(all, "point"));
        }
        let without = tally.with_status(PointStatus::None);
        // A guided slider that tips shows no solution, which does not mean that friction locks it.
        let (what, advice) = match tally.tipping {
            0 => ("It jams", None),
            tipping if tipping == without => ("A guided slider tips", Some(AS_BLOCK)),
            _ => ("It jams, or a guided slider tips,", Some(AS_BLOCK)),
        };
        let probability = if self.has_branches() { None } else { tally.probability_of_jamming() };
        let rests: u64 = tally.rests.values().sum();
        let holds = (rests > 0).then(|| match rests {
            count if count == all => format!("It holds at all {}.", counted(all, "point")),
            count => format!("It holds at {count} of {}.", counted(all, "point")),
        });
        let jams = match probability {
            Some(Probability { share, interval }) => {
                let [from, to] = interval.map(|end| brief(100.0 * end));
                format!(
                    "{what} with a probability of {} % ({from} to {to} % with 95 % confidence).",
                    brief(100.0 * share)
                )
            }
            None => match without {
                0 => format!("{what} at none of {}.", counted(all, "point")),
                count if count == all => format!("{what} at all {}.", counted(all, "point")),
                count => format!("{what} at {count} of {}.", counted(all, "point")),
            },
        };
        // Of what holds or tips nobody expects that it jams.
        let tips = (tally.tips > 0).then(|| match tally.tips {
            count if count == all => format!("It tips at all {}.", counted(all, "point")),
            count => format!("It tips at {count} of {}.", counted(all, "point")),
        });
        let jams = (without > 0 || holds.is_none() && tips.is_none()).then_some(jams);
        let mut sentences: Vec<String> = holds.into_iter().chain(tips).chain(jams).collect();
        sentences.extend(advice.map(str::to_owned));
        let several: u64 =
            tally.solutions.iter().filter(|(solutions, _)| **solutions > 1).map(|(_, count)| count).sum();
        let unsolved = all - tally.solved();
        let [of, ending] =
            if self.has_branches() { ["of them", ""] } else { ["of the samples", " (not counted)"] };
        sentences.extend((several > 0).then(|| format!("Several solutions at {several} {of}.")));
        let open = tally.with_status(PointStatus::Unknown);
        sentences.extend((open > 0).then(|| format!("Not decided at {open} {of}.")));
        sentences.extend((unsolved > 0).then(|| format!("Could not be solved at {unsolved} {of}{ending}.")));
        sentences.join(" ")
    }

    /// A summary of the points that are done, as text for people. With samples also the probability that it
    /// jams.
    pub fn text(&self, state: &SweepState, style: Style) -> String {
        let mut text = Page::new(state, style);
        text.shard(self);
        let jams = state.tally.with_status(PointStatus::None) > 0;
        text.status(if jams { Status::None } else { Status::One }, &self.answer(state));
        text.points(self);
        text.solutions();
        text.remarks(self);
        text.text()
    }
}

impl Page<'_, SweepState> {
    fn shard(&mut self, sweep: &Sweep) {
        let Some(shard) = sweep.of_shard() else { return };
        let range = sweep.range();
        let which = match range.end.checked_sub(1).filter(|last| *last >= range.start) {
            Some(last) => format!("points {} to {last}", range.start),
            None => "no points".to_owned(),
        };
        self.headline(&format!("Shard {shard}, {which}:"));
    }

    fn points(&mut self, sweep: &Sweep) {
        let tally = &self.report.tally;
        let own = tally.points - tally.breakpoints;
        let what = if sweep.has_branches() { "point" } else { "sample" };
        let inserted = match tally.breakpoints {
            0 => String::new(),
            1 => " and 1 exact end of a state between them".to_owned(),
            count => format!(" and {count} exact ends of states between them"),
        };
        let branches = if sweep.numbers_branches() {
            format!(", {}", counted(u64::from(self.report.branches()), "branch"))
        } else {
            String::new()
        };
        let rows = counted(tally.rows, "row");
        self.line(&format!("{}{inserted}: {rows}{branches}", counted(own, what)));
    }

    fn solutions(&mut self) {
        let tally = &self.report.tally;
        let share = |count: u64| {
            let all = (tally.points - tally.breakpoints).max(1);
            format!("{} %", number(100.0 * count as f64 / all as f64))
        };
        let rests: u64 = tally.rests.values().sum();
        let mut lines: Vec<(String, u64)> = Vec::new();
        if rests > 0 {
            lines.push(("it holds".to_owned(), rests));
        }
        if tally.tips > 0 {
            lines.push(("it tips (counted below, too)".to_owned(), tally.tips));
        }
        for (&solutions, &count) in &tally.solutions {
            let what = match solutions {
                0 => continue,
                1 => "1 solution".to_owned(),
                more => format!("{more} solutions"),
            };
            lines.push((what, count));
        }
        let jams = tally.with_status(PointStatus::None).saturating_sub(tally.tipping);
        for (what, count) in [("friction locks it", jams), ("a guided slider tips", tally.tipping)] {
            if count > 0 {
                lines.push((format!("no solution: {what}"), count));
            }
        }
        for (status, what) in [
            (PointStatus::PreloadGap, "no solution, but a state in a preload gap"),
            (PointStatus::Unknown, "undecided"),
            (PointStatus::NoPosition, "no position"),
            (PointStatus::Refused, "refused"),
        ] {
            let count = tally.with_status(status);
            // Continua count among their numbers of solutions.
            if count > 0 {
                lines.push((what.to_owned(), count));
            }
        }
        let resting = tally.rests.get(&PointStatus::Continuum).copied().unwrap_or(0);
        let continua = tally.with_status(PointStatus::Continuum) - resting;
        if continua > 0 {
            lines.push(("infinitely many solutions (some of them counted above)".to_owned(), continua));
        }
        for (what, count) in lines {
            self.line(&format!("  {count:>9}  {:>9}  {what}", share(count)));
        }
    }

    fn remarks(&mut self, sweep: &Sweep) {
        for (name, part) in sweep.cut_off() {
            self.line(&format!(
                "  Friction is never negative: {} % of the distribution of {name} lay below zero and was cut off.",
                number(100.0 * part)
            ));
        }
        let tally = &self.report.tally;
        if tally.boundary_rows > 0 && self.is_verbose() {
            let rows = counted(tally.boundary_rows, "row");
            self.line(&format!(
                "  {rows} where nothing presses a contact: its normal force is zero within rounding."
            ));
        }
        if let Some(reason) = sweep.without_breakpoints() {
            self.line(&format!("  No exact ends of states were inserted: {}", in_one_line(reason)));
        }
        for (status, (point, reason)) in &tally.refusals {
            let count = tally.with_status(*status);
            let others = if count > 1 { format!(", and {} more", count - 1) } else { String::new() };
            self.line(&format!("  Point {point}{others}: {}", in_one_line(reason)));
        }
    }
}

/// "1 point", "2 points", "2 branches"
fn counted(count: u64, what: &str) -> String {
    let ending = if what.ends_with("ch") { "es" } else { "s" };
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}{ending}") }
}

/// Several faults, each on its own line, as one.
fn in_one_line(faults: &str) -> String {
    faults.replace('\n', "; ")
}
