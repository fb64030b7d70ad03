//! Limits as text for people.

use super::report::{
    CountLimits, EndHingeForce, EndReaction, Known, LimitsMethod, LimitsReport, ModeLimits,
    RangeWithoutProblem, RestLimitsReport, STEPS, SpanOfRest, SpeedLimits, VariedQuantity,
};
use crate::modes::existence::is_same_end;
use crate::report::count as count_of;
use crate::report::number::number;
use crate::report::page::Page;
use crate::report::{
    CoordinateState, ModeEndCause, Report, Style, capital, followed, joints_in_words, spaced,
};
use crate::standstill::CoordinateValue;
use crate::units::Unit;
use std::cmp::Ordering;

impl Report for LimitsReport {
    fn answer(&self) -> String {
        self.summary.clone().unwrap_or_else(|| self.conclusion.join(" "))
    }

    /// The conclusion, the modes, the numbers of solutions.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        text.direction("", (&self.modes, &self.counts, &self.without_mode_problem));
        if let Some(reversed) = &self.reversed {
            let parts = (&*reversed.modes, &*reversed.counts, &*reversed.without_mode_problem);
            text.direction(", moving in the opposite direction with the same loads", parts);
        }
        text.text()
    }
}

impl Report for RestLimitsReport {
    fn answer(&self) -> String {
        self.in_sentences().join(" ")
    }

    /// Each stretch in a sentence.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        if let Some(title) = &self.title {
            text.headline(title);
        }
        let vary = &self.vary;
        let unit = &vary.shown_in;
        let (range, value) = (unit.range(&vary.name, [vary.from, vary.to]), unit.precise(vary.value));
        let at =
            |one: &CoordinateValue| format!("{} = {}", one.name, self.units.of(one.unit).show(one.value));
        let at: Vec<String> = self.state.iter().map(at).collect();
        let at = if at.is_empty() { String::new() } else { format!(" at {}", at.join(", ")) };
        text.line(&format!("At rest{at}, {range} (in the model {value})"));
        text.line("");
        self.in_sentences().iter().for_each(|sentence| text.headline(sentence));
        let narrower = unit.precise((vary.to - vary.from) / STEPS as f64);
        if text.is_verbose() {
            text.line(&self.guarantee);
        } else {
            text.line(&could_be_missed(&narrower));
        }
        text.text()
    }
}

impl RestLimitsReport {
    /// A sentence for each stretch that is wide enough to be shown; a single value beside it is not said to be in it.
    fn in_sentences(&self) -> Vec<String> {
        let shown = |at: f64| self.vary.shown_in.precise_number(at);
        let is_hidden = |span: &SpanOfRest| span.from < span.to && shown(span.from) == shown(span.to);
        let is_alone =
            |span: Option<&SpanOfRest>, at: f64| span.is_some_and(|span| [span.from, span.to] == [at; 2]);
        let spans = self.spans.iter().enumerate();
        let sentence = |(index, span): (usize, &SpanOfRest)| {
            let before = index.checked_sub(1).and_then(|before| self.spans.get(before));
            let ends = [is_alone(before, span.from), is_alone(self.spans.get(index + 1), span.to)];
            self.in_words(span, if span.from < span.to { ends } else { [false; 2] })
        };
        spans.filter(|(_, span)| self.spans.len() == 1 || !is_hidden(span)).map(sentence).collect()
    }

    /// "mu from 0.2 to 1: it holds.", "Q above 0, up to 20 N: it does not hold." where the ends that are marked do not
    /// belong to it.
    fn in_words(&self, span: &SpanOfRest, without: [bool; 2]) -> String {
        let SpanOfRest { from, to, holds, may_slip, reason } = span;
        let unit = &self.vary.shown_in;
        let verdict = match (holds, reason) {
            (_, Some(reason)) => format!("there is no answer: {reason}"),
            (Some(true), _) if *may_slip => {
                "it holds only if something has wedged it: do not rely on it".to_owned()
            }
            (Some(true), _) => "it holds".to_owned(),
            (Some(false), _) => "it does not hold".to_owned(),
            (None, _) => "not decided".to_owned(),
        };
        let place = if from == to {
            format!("{} = {}", self.vary.name, unit.precise(*from))
        } else {
            let (name, [from, to]) = (&self.vary.name, [unit.precise_number(*from), unit.precise(*to)]);
            match without {
                [false, false] => format!("{name} from {from} to {to}"),
                [true, false] => format!("{name} above {from}, up to {to}"),
                [false, true] => format!("{name} from {from} on, below {to}"),
                [true, true] => format!("{name} above {from}, below {to}"),
            }
        };
        format!("{place}: {verdict}.")
    }
}

impl Page<'_, LimitsReport> {
    fn heading(&mut self) {
        let report = self.report;
        if let Some(title) = &report.title {
            self.headline(title);
        }
        let vary = &report.vary;
        let range = vary.shown_in.range(&vary.name, [vary.from, vary.to]);
        self.line(&format!("{range} (in the model {})", vary.shown_in.precise(vary.value)));
        report.state.iter().for_each(|one: &CoordinateState| self.line(&one.in_words(&report.units)));
        if let Some(steps) = report.steps_from_drawing.filter(|_| self.is_verbose()) {
            self.line(&followed(steps));
        }
        self.line("");
        if let Some(summary) = &report.summary {
            self.headline(summary);
            let repeats = report.summary_says_all && !self.is_verbose() || report.conclusion.len() == 1;
            report.conclusion.iter().filter(|_| !repeats).for_each(|sentence| self.line(sentence));
        } else {
            report.conclusion.iter().for_each(|sentence| self.headline(sentence));
        }
        if self.is_verbose() {
            self.line(&report.guarantee);
        } else {
            self.line(&report.known_in_words());
            report.not_examined.iter().for_each(|line| self.line(line));
        }
    }

    fn direction(
        &mut self,
        which: &str,
        (modes, counts, gaps): (&[ModeLimits], &[CountLimits], &[RangeWithoutProblem]),
    ) {
        // Without contacts, a mode throughout the range says nothing more.
        let ends_in_range = |mode: &ModeLimits| [mode.from_is, mode.to_is] == [ModeEndCause::Range; 2];
        let is_whole = |mode: &ModeLimits| mode.joints.is_empty() && ends_in_range(mode);
        let verbose = self.is_verbose();
        if verbose || !modes.iter().all(is_whole) {
            self.modes(which, modes, counts);
        }
        let unit = &self.report.vary.shown_in;
        if verbose {
            self.line("");
            self.headline(&format!("Number of solutions{which}"));
            let rows: Vec<Vec<String>> = counts.iter().map(|count| count_row(count, unit)).collect();
            let [from, to] = ["from", "to"].map(|end| unit.title(end));
            self.table(&[&from, &to, "solutions", "preload gaps", "known"], &rows);
        }
        if !gaps.is_empty() {
            self.line("");
        }
        for line in no_answers(&RangeWithoutProblem::told(gaps), &self.report.vary, verbose) {
            self.line(&format!("  {line}"));
        }
    }

    /// Where each contact mode exists.
    fn modes(&mut self, which: &str, modes: &[ModeLimits], counts: &[CountLimits]) {
        self.line("");
        self.headline(&format!("Contact modes{which}"));
        let unit = &self.report.vary.shown_in;
        let [from, to] = ["from", "to"].map(|end| unit.title(end));
        let verbose = self.is_verbose();
        // The sign of their determinant tells solutions apart where some are negative.
        let has_orientation = modes.iter().any(|mode| mode.orientation == Some(-1));
        let mut titles = vec![from.as_str(), &to, "contact mode", "ends with"];
        if verbose {
            titles = vec!["signs", &from, &to, "begins with", "ends with"];
            titles.extend(has_orientation.then_some("orientation"));
        }
        let row = |mode: &ModeLimits| {
            let mut row = mode_row(mode, counts, unit, verbose);
            row.extend((verbose && has_orientation).then(|| orientation(mode).to_owned()));
            row
        };
        let mut sorted: Vec<&ModeLimits> = modes.iter().collect();
        // Their signs, which sort them, are not shown.
        if !verbose {
            sorted.sort_by(|one, other| one.from.partial_cmp(&other.from).unwrap_or(Ordering::Equal));
        }
        let rows: Vec<Vec<String>> = sorted.into_iter().map(row).collect();
        self.table(&titles, &rows);
        for mode in modes.iter().filter(|_| verbose) {
            let name = mode_name(mode);
            let parts = [joints_in_words(&mode.joints), speeds_in_words(&mode.speeds, unit)];
            let words = parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ");
            if !words.is_empty() {
                self.hung(&format!("  {name}: {words}"), "  ");
            }
        }
        if verbose && modes.iter().any(|mode| mode.orientation == Some(-1)) {
            self.line("  With slightly elastic joints the mechanism leaves solutions of negative orientation; with drives, if it is stable without friction (see `slideway solve`).");
        }
    }
}

impl LimitsReport {
    /// The limit in one sentence, where there is one, and what the stretches add to it.
    pub fn sentences(&self) -> Vec<&str> {
        let says_all = self.summary.is_some() && (self.summary_says_all || self.conclusion.len() == 1);
        let stretches = self.conclusion.iter().filter(|_| !says_all);
        self.summary.iter().chain(stretches).map(String::as_str).collect()
    }

    /// How all of this is known, in a clause: "Proven, except within 6.7e-5 of the limits.", "Computed, not proven.", "Sampled every 0.01; ..."
    pub fn known_in_words(&self) -> String {
        let unit = &self.vary.shown_in;
        let counts = || self.counts.iter().chain(self.reversed.iter().flat_map(|reversed| &reversed.counts));
        let worst = counts().map(|count| count.known).max();
        let known = match worst {
            None => String::new(),
            Some(Known::Proven) => {
                let left_out = counts().map(CountLimits::left_out).fold(0.0, f64::max);
                let except = format!("Proven, except within {} of the limits.", at_most(left_out, unit));
                if left_out > 0.0 { except } else { "Proven.".to_owned() }
            }
            Some(Known::ClosedForm) => "Computed, not proven.".to_owned(),
            Some(Known::Undecided) => "Not all of it is decided.".to_owned(),
            Some(_) => {
                let spacing = counts().filter_map(|count| count.spacing).fold(0.0, f64::max);
                could_be_missed(&at_most(spacing, unit))
            }
        };
        let same = format!("It does not depend on {}. ", self.vary.name);
        if self.method == LimitsMethod::Independent { same + &known } else { known }
    }
}

/// The sentence on what scans can miss: whatever begins and ends within this width.
pub(crate) fn could_be_missed(width: &str) -> String {
    format!("Sampled every {width}; a narrower range could be missed.")
}

/// Where there is no mode problem, and why: "At 0 and 180 deg there is no answer..." Ranges that follow each other without
/// room between them, as they are shown, are one, with the reason of the widest; with details each is there.
/// What the digits of the whole range do not show beside its ends is zero.
pub(crate) fn no_answers(ranges: &[([f64; 2], &str)], vary: &VariedQuantity, details: bool) -> Vec<String> {
    let (unit, whole) = (&vary.shown_in, vary.from.abs().max(vary.to.abs()));
    let is_seen = |at: f64| unit.precise_number(whole + at.abs()) != unit.precise_number(whole);
    let shown = |at: f64| unit.precise_number(if details || is_seen(at) { at } else { 0.0 });
    let adjoining = ranges.chunk_by(|(one, _), (next, _)| !details && shown(one[1]) == shown(next[0]));
    let joined = adjoining.filter_map(|chunk| {
        let width = |([from, to], _): &([f64; 2], &str)| to - from;
        let (_, reason) =
            chunk.iter().reduce(|one, other| if width(other) > width(one) { other } else { one })?;
        let (([from, _], _), ([_, to], _)) = (chunk.first()?, chunk.last()?);
        Some(([shown(*from), shown(*to)], *reason))
    });
    let joined: Vec<([String; 2], &str)> = joined.collect();
    let place = |([from, to], _): &([String; 2], &str)| {
        if from == to {
            format!("at {}", unit.with(from))
        } else {
            format!("from {from} to {}", unit.with(to))
        }
    };
    let sentence = |same: &[([String; 2], &str)]| {
        let places = same.iter().map(place).collect::<Vec<_>>().join(" and ");
        let places = capital(&places);
        format!("{places} there is no answer, which is no jam: {}.", same[0].1)
    };
    joined.chunk_by(|(_, one), (_, next)| one == next).map(sentence).collect()
}

fn mode_row(mode: &ModeLimits, counts: &[CountLimits], unit: &Unit, verbose: bool) -> Vec<String> {
    let end = |at: Option<f64>| at.map_or("infinity".to_owned(), |at| unit.precise_number(at));
    let contacts =
        |grows: fn(&EndReaction) -> i8| mode.reactions.iter().map(move |one| (&*one.contact, grows(one)));
    let hinges = |grows: fn(&EndHingeForce) -> bool| {
        mode.hinge_forces.iter().map(move |one| (&*one.hinge, i8::from(grows(one))))
    };
    let (from, to) = (end(mode.from), end(mode.to));
    // Beyond an end without a solution it jams, whatever ended the mode.
    let jams = |is: ModeEndCause, at: Option<f64>, other: fn(&CountLimits) -> f64| {
        let says_so = matches!(is, ModeEndCause::Locking | ModeEndCause::Tipping | ModeEndCause::Range);
        let is_there = |count: &&CountLimits| {
            let place = other(count);
            at.is_some_and(|at| is_same_end(at.max(place), at.min(place)))
        };
        let is_jam = |count: &CountLimits| count.is_empty() && count.tipping.is_none();
        let jams = !says_so && counts.iter().filter(is_there).any(is_jam);
        if jams { "it jams: " } else { "" }
    };
    let reactions = contacts(|r| r.from_grows).chain(hinges(|force| force.from_grows));
    let begins = jams(mode.from_is, mode.from, |count| count.to).to_owned()
        + &cause(mode.from_is, &mode.from_at, reactions);
    let reactions = contacts(|r| r.to_grows).chain(hinges(|force| force.to_grows));
    let ends =
        jams(mode.to_is, mode.to, |count| count.from).to_owned() + &cause(mode.to_is, &mode.to_at, reactions);
    if verbose {
        vec![spaced(&mode.pattern), from, to, begins, ends]
    } else {
        vec![from, to, joints_in_words(&mode.joints), ends]
    }
}

/// The signs of a mode, with the orientation of a solution with friction in hinges: "+ -", "+ - (orientation -)".
fn mode_name(mode: &ModeLimits) -> String {
    match (spaced(&mode.pattern), orientation(mode)) {
        (signs, "") => signs,
        (signs, sign) if signs.is_empty() => format!("orientation {sign}"),
        (signs, sign) => format!("{signs} (orientation {sign})"),
    }
}

/// The sign of a solution with friction in hinges.
fn orientation(mode: &ModeLimits) -> &'static str {
    mode.orientation.map_or("", |sign| if sign < 0 { "-" } else { "+" })
}

/// "z speeds up from 0 to 0.2, slows down from 0.2 to 1".
fn speeds_in_words(speeds: &[SpeedLimits], unit: &Unit) -> String {
    let of_coordinate = |speeds: &[SpeedLimits]| {
        let stretch = |one: &SpeedLimits| unit.range(one.speed.in_words(), [one.from, one.to]);
        let stretches: Vec<String> = speeds.iter().map(stretch).collect();
        format!("{} {}", speeds[0].coordinate, stretches.join(", "))
    };
    let coordinates = speeds.chunk_by(|one, next| one.coordinate == next.coordinate);
    coordinates.map(of_coordinate).collect::<Vec<_>>().join("; ")
}

/// Why a mode begins or ends, in words.
fn cause<'r>(is: ModeEndCause, at: &[String], grows: impl Iterator<Item = (&'r str, i8)>) -> String {
    let several = at.len() > 1;
    let at = at.join(", ");
    match is {
        ModeEndCause::Range => "end of the range".to_owned(),
        ModeEndCause::Locking | ModeEndCause::WithoutBound => {
            let mut growing: Vec<&str> = grows.filter(|(_, sign)| *sign != 0).map(|(name, _)| name).collect();
            // Both parts of a force across a rod have its name.
            growing.dedup();
            match (growing.as_slice(), is) {
                ([], ModeEndCause::Locking) => "it jams".to_owned(),
                ([], _) => "its forces grow without limit".to_owned(),
                (list, is) => {
                    let jams = if is == ModeEndCause::Locking { "it jams: " } else { "" };
                    let [forces, grow] =
                        if list.len() == 1 { ["force", "grows"] } else { ["forces", "grow"] };
                    format!("{jams}{forces} on {} {grow} without limit", list.join(", "))
                }
            }
        }
        ModeEndCause::SideChange | ModeEndCause::LiftsOff | ModeEndCause::Touches => {
            format!("{at} {}", is.of_contacts(several))
        }
        ModeEndCause::GapCloses => format!("the gap of {at} closes"),
        ModeEndCause::Tipping => format!("it tips ({at})"),
        ModeEndCause::GreatestReaction => format!("{at} at the greatest reaction"),
        ModeEndCause::Fold => "it merges with another solution".to_owned(),
        ModeEndCause::HingeUnloaded if several => format!("the forces of {at} vanish"),
        ModeEndCause::HingeUnloaded => format!("the force of {at} vanishes"),
        ModeEndCause::NotFollowed => "not followed".to_owned(),
        ModeEndCause::Reversal => "sliding reverses".to_owned(),
        _ => "no position".to_owned(),
    }
}

fn count_row(count: &CountLimits, unit: &Unit) -> Vec<String> {
    let gaps =
        if count.preload_gap_states == 0 { String::new() } else { count.preload_gap_states.to_string() };
    let [from, to] = [count.from, count.to].map(|end| unit.precise_number(end));
    let solutions =
        if count.continuum { "infinitely many".to_owned() } else { number(count.solutions as f64) };
    vec![from, to, solutions, gaps, known(count, unit)]
}

/// How numbers of solutions are known, in words.
fn known(count: &CountLimits, unit: &Unit) -> String {
    let rest = match (count.known, count.spacing) {
        (Known::Proven, _) => {
            let left_out = count.left_out();
            let except = format!("proven, except within {} of the ends", at_most(left_out, unit));
            return if left_out > 0.0 { except } else { "proven".to_owned() };
        }
        (Known::Undecided, _) => return "not decided".to_owned(),
        (Known::Sampled, Some(spacing)) => format!("sampled every {}", unit.show(spacing)),
        _ => "computed".to_owned(),
    };
    let length = |[from, to]: &[f64; 2]| to - from;
    match count.proven.iter().max_by(|one, other| length(one).total_cmp(&length(other))) {
        Some([from, to]) => {
            let further = match count.proven.len() {
                1 => String::new(),
                many => format!(" and in {}", count_of(many - 1, "shorter interval", "shorter intervals")),
            };
            format!("proven {}{further}, else {rest}", unit.range("", [*from, *to]).trim_start())
        }
        None => rest,
    }
}

/// A number with two digits, not less than it, in a unit.
pub(super) fn at_most(value: f64, shown_in: &Unit) -> String {
    let value = shown_in.number_of(value);
    let rounded = rounded_up(value).unwrap_or(value);
    let text =
        if value == 0.0 || (1e-4..1e6).contains(&value) { number(rounded) } else { format!("{rounded:.1e}") };
    shown_in.with(&text)
}

/// The least number with two significant digits that is not below a positive one; `None` if there is no such number.
fn rounded_up(value: f64) -> Option<f64> {
    let nearest = format!("{value:.1e}");
    let (mantissa, exponent) = nearest.split_once('e')?;
    let (tenths, exponent): (u32, i32) = (mantissa.replace('.', "").parse().ok()?, exponent.parse().ok()?);
    let with = |tenths: u32| format!("{tenths}e{}", exponent - 1).parse::<f64>().ok();
    [tenths, tenths + 1].into_iter().filter_map(with).find(|rounded| *rounded >= value && rounded.is_finite())
}

#[cfg(test)]
mod tests {
    use super::{VariedQuantity, at_most, no_answers};
    use crate::units::Unit;

    /// By hand: two digits, never less, also of numbers that a power of ten of their size would underflow beside.
    #[test]
    fn widths_are_rounded_up_to_two_digits() {
        for (value, told) in [
            (0.061, "0.061"),
            (0.0611, "0.062"),
            (9.91, "10"),
            (5e-324, "4.9e-324"),
            (4.9e-322, "4.9e-322"),
            (6.61e-5, "6.7e-5"),
            (9.99e-5, "1.0e-4"),
            (1.61e7, "1.7e7"),
            (f64::MAX, "1.8e308"),
            (0.0, "0"),
        ] {
            assert_eq!(at_most(value, &Unit::default()), told);
        }
    }

    #[test]
    fn ranges_without_answer_that_meet_are_one_with_the_reason_of_the_widest() {
        let near = f64::from_bits(1.0_f64.to_bits() + 1);
        let ranges =
            [([0.0, 1.0], "out of its guide"), ([1.0, near], "ill-conditioned"), ([2.0, 2.0], "singular")];
        let (name, unit) = ("phi".to_owned(), String::new());
        let vary = VariedQuantity { name, unit, from: 0.0, to: 3.0, value: 1.0, shown_in: Unit::default() };
        let told = |details| no_answers(&ranges, &vary, details);
        let joined = [
            "From 0 to 1 there is no answer, which is no jam: out of its guide.",
            "At 2 there is no answer, which is no jam: singular.",
        ];
        assert_eq!(told(false), joined);
        assert_eq!(told(true).len(), 3);
        // Seven digits of 3 do not show 2e-7.
        let little = [([0.0, 2e-7], "singular")];
        assert_eq!(
            no_answers(&little, &vary, false),
            ["At 0 there is no answer, which is no jam: singular."]
        );
    }
}
