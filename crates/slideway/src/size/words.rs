//! The answer of `size`, in words.

use super::margin::SAME;
use super::report::{MarginKind, MetEnd, MetInterval, Sample, SampleKind, SizeReport};
use super::search::Tried;
use crate::limits::no_answers;
use crate::report::effort::least_friction;
use crate::report::number::precise;
use crate::report::{NO_DRIVE, Tipping, TippingLimit, it_tips, tipping, with_less, without_solution};
use crate::units::{Unit, brief};

/// A report whose conclusion is sought.
pub(super) struct Words<'r> {
    pub(super) report: &'r SizeReport,
    pub(super) places: &'r [Tried],
    /// True if a drive prescribes the motion.
    pub(super) driven: bool,
}

pub(super) fn guarantee([from, to]: [f64; 2], steps: usize, against: MarginKind, shown_in: &Unit) -> String {
    let (wanted, level) = if against.is_limit() {
        ("limit", "of the quantity")
    } else {
        ("wanted safety factor", "of the safety factor")
    };
    let step = (to - from) / steps as f64;
    format!(
        "{} evenly spaced values were tried. Where the {wanted} is crossed between two of them, the place was found by bisection; dips and humps were followed to their lowest and highest points. Only a jump {level} there and back, or a second dip, within two steps of {} could be missed.",
        steps + 1,
        shown_in.show(step)
    )
}

impl Words<'_> {
    pub(super) fn conclusion(&self) -> Vec<String> {
        let report = self.report;
        let asks_for_drive =
            !self.driven && report.against == MarginKind::Locking && report.present.is != SampleKind::Finite;
        let mut sentences = if asks_for_drive && self.never_jams() {
            let tips = if report.may_tip { " or tips" } else { "" };
            let range = report.vary.shown_in.range(&report.vary.name, [report.vary.from, report.vary.to]);
            vec![format!("While it moves nothing jams{tips} it, however great the friction, at any {range}.")]
        } else {
            let constant = self.constant().filter(|_| !report.met.is_empty());
            [self.answer(), self.present()].into_iter().chain(constant).collect()
        };
        sentences.extend(asks_for_drive.then(|| NO_DRIVE.to_owned()));
        let ranges: Vec<([f64; 2], &str)> =
            report.without_position.iter().map(|gap| ([gap.from, gap.to], gap.reason.as_str())).collect();
        sentences.extend(no_answers(&ranges, &report.vary, false));
        sentences
    }

    /// "For a safety factor of 2 against jamming: L at least 0.36 m."
    fn answer(&self) -> String {
        let report = self.report;
        let wish = wish(report);
        let name = &report.vary.name;
        match report.met.as_slice() {
            [] => {
                let best = self.places.iter().filter_map(|place| Some((place.at, place.margin?)));
                let best = best.min_by(|(_, one), (_, other)| one.demand(1.0).total_cmp(&other.demand(1.0)));
                let from = report.vary.shown_in.precise_number(report.vary.from);
                let range = format!("{from} to {}", quantity(report, report.vary.to));
                let gives =
                    if report.without_position.is_empty() { "gives it" } else { "is known to give it" };
                let best =
                    best.and_then(|(at, margin)| Some((at, report.against.told(margin, report.margin).1?)));
                match best {
                    Some((_, margin)) if self.constant().is_some() && !report.against.is_limit() => {
                        format!(
                            "{wish}: no {name} from {range} {gives}; the safety factor is {} at any {name}.",
                            brief(margin)
                        )
                    }
                    Some((at, level)) if report.against.is_limit() => format!(
                        "{wish}: no {name} from {range} {gives}; {} comes nearest to it, with {}.",
                        quantity(report, at),
                        self::level(report, level)
                    ),
                    Some((at, margin)) => format!(
                        "{wish}: no {name} from {range} {gives}; the greatest safety factor that was found is {}, at {}.",
                        precise(margin),
                        quantity(report, at)
                    ),
                    None => format!("{wish}: no {name} from {range} {gives}."),
                }
            }
            [first, .., last] if let Some(gaps) = self.single_gaps() => {
                let ends = MetInterval { to: last.to, to_is: last.to_is, ..first.clone() };
                format!("{wish}: {name} {}, but for {gaps}, where there is no answer.", self.interval(&ends))
            }
            intervals => {
                let parts: Vec<String> = intervals.iter().map(|interval| self.interval(interval)).collect();
                format!("{wish}: {name} {}.", parts.join(", or "))
            }
        }
    }

    /// "100 mm", of single values without an answer, where these alone are left out; else none.
    fn single_gaps(&self) -> Option<String> {
        let between = |pair: &[MetInterval]| {
            let [end, next] = [pair[0].to, pair[1].from].map(|value| quantity(self.report, value));
            (end == next && pair[0].to_is == MetEnd::NoPosition).then_some(end)
        };
        let gaps: Option<Vec<String>> = self.report.met.windows(2).map(between).collect();
        Some(gaps?.join(", "))
    }

    /// "at least 0.36 m", "at most 30", "from a to b", "can have any value from a to b".
    fn interval(&self, interval: &MetInterval) -> String {
        let report = self.report;
        let [from, to] = [interval.from, interval.to].map(|value| quantity(report, value));
        let bare = report.vary.shown_in.precise_number(interval.from);
        // Beyond an end of the range nothing was examined: there is no answer there alone.
        let below = if interval.from == report.vary.from { "where" } else { "below which" };
        let above = if interval.to == report.vary.to { "where" } else { "above which" };
        match (interval.from_is, interval.to_is) {
            (MetEnd::Range, MetEnd::Range) => format!("can have any value from {bare} to {to}"),
            (MetEnd::NoPosition, MetEnd::Range) => {
                format!("at least {from}, {below} there is no answer (examined up to {to})")
            }
            (MetEnd::Range, MetEnd::NoPosition) => {
                format!("at most {to}, {above} there is no answer (examined down to {from})")
            }
            (_, MetEnd::Range) => format!("at least {from} (examined up to {to})"),
            (MetEnd::Range, _) => format!("at most {to} (examined down to {from})"),
            _ if interval.from == interval.to => format!("{from} alone"),
            (MetEnd::NoPosition, MetEnd::NoPosition) => {
                format!("from {from}, {below} there is no answer, to {to}, {above} there is none")
            }
            (MetEnd::NoPosition, _) => format!("from {from}, {below} there is no answer, to {to}"),
            (_, MetEnd::NoPosition) => format!("from {bare} to {to}, {above} there is no answer"),
            _ => format!("from {bare} to {to}"),
        }
    }

    /// "The model has L = 0.4 m: its safety factor is 2.222, which is enough."
    fn present(&self) -> String {
        let report = self.report;
        let model = format!("The model has {} = {}", report.vary.name, quantity(report, report.present.at));
        let Sample { is, margin, .. } = report.present;
        let what = subject(report);
        let told = match (is, margin) {
            (SampleKind::NoSolution, _) => {
                let why = report.tipping.as_ref().map(Tipping::in_words);
                let why = why.unwrap_or_else(|| report.against.nothing().to_owned());
                format!("{why}, so the limit is not kept")
            }
            (SampleKind::WithoutBound, _) => {
                format!("infinitely many solutions leave the {what} without bound; the limit is not kept")
            }
            (SampleKind::NeedsFriction, _) => self.needs_friction(),
            (_, Some(level)) if report.against.is_limit() => {
                let is_kept = if report.against.is_greatest() {
                    level <= report.margin
                } else {
                    level >= report.margin
                };
                let kept = if is_kept { "the limit is kept" } else { "the limit is not kept" };
                format!("the {what} is {}; {kept}", report.limit_shown_in.show(level))
            }
            (_, Some(margin)) if (margin - 1.0).abs() <= SAME => match report.against {
                MarginKind::Locking if report.tips.is_empty() => "it is on the verge of jamming".to_owned(),
                MarginKind::Locking => {
                    format!("it is on the verge of {}", tipping(&report.tips))
                }
                _ => format!("it just holds{}", every_load(report)),
            },
            (SampleKind::NoPosition, _) => "there is no answer there".to_owned(),
            (_, None) => never(report),
            (_, Some(margin)) => self.factor(margin),
        };
        let wedged = match report.wedged {
            None => String::new(),
            Some(margin) if margin >= 1.0 - SAME => {
                let how = if report.gently { "let down gently" } else { "wedged by a knock" };
                format!("; {how} it holds with a safety factor of {}", brief(margin))
            }
            Some(margin) => {
                let growth = brief(margin.recip());
                format!("; even wedged by a knock it needs {growth} times its static friction")
            }
        };
        format!("{model}: {told}{wedged}.")
    }

    /// "with less friction it tips (shoes): below mu = 0.05, 2 times less. No safety factor makes up for that"
    fn needs_friction(&self) -> String {
        let factor = self.report.present.least_friction.unwrap_or_default();
        let mu = self.report.mu;
        if factor >= 1.0 {
            let from = least_friction(factor, mu.map(|mu| factor * mu));
            return format!("{}; it takes more friction not to, from {from} on", it_tips(&self.report.tips));
        }
        let limit = TippingLimit { factor, joints: self.report.tips.clone() };
        format!("{}, so no safety factor makes it safe", with_less(&limit, mu))
    }

    /// The meaning of a safety factor: "its safety factor is 2.222, which is enough".
    fn factor(&self, margin: f64) -> String {
        let report = self.report;
        let load = report.load.as_deref().unwrap_or_default();
        let every = every_load(report);
        let enough = if margin >= report.margin { "which is enough" } else { "which is too little" };
        let factor = brief(margin);
        match (report.against, margin >= 1.0) {
            (MarginKind::Locking, true) if report.tips.is_empty() => {
                format!("its safety factor is {factor}, {enough}")
            }
            (MarginKind::Locking, true) => {
                format!("its safety factor is {factor} against {}, {enough}", tipping(&report.tips))
            }
            (MarginKind::Locking, false) => {
                let jams = || without_solution(report.tipping.as_ref());
                let now = if report.tips.is_empty() { jams() } else { it_tips(&report.tips) };
                format!("{now}; friction would have to fall to {factor} of its value")
            }
            (MarginKind::SelfLocking, true) => {
                format!(
                    "it would be self-locking under `{load}` at {factor} times this static friction, {enough}"
                )
            }
            (MarginKind::SelfLocking, false) => format!(
                "it is self-locking under `{load}`; static friction would have to fall to {factor} of its value"
            ),
            (_, _) if margin == 0.0 => format!("no static friction is enough to hold{every}"),
            (_, true) => format!("it holds{every} with a safety factor of {factor}, {enough}"),
            (_, false) => {
                format!(
                    "it does not hold{every}; it needs {} times its static friction",
                    brief(margin.recip())
                )
            }
        }
    }

    /// Whether no friction reaches the limit, wherever there is an answer.
    fn never_jams(&self) -> bool {
        let mut margins = self.places.iter().filter_map(|place| place.margin).peekable();
        margins.peek().is_some() && margins.all(|margin| margin.demand(1.0) == 0.0)
    }

    /// Says so if the margin is the same wherever there is one.
    fn constant(&self) -> Option<String> {
        let demands = self.places.iter().filter_map(|place| Some(place.margin?.demand(1.0)));
        let [least, greatest] =
            demands.fold([f64::INFINITY, 0.0], |[least, greatest], one| [least.min(one), greatest.max(one)]);
        let is_same = greatest >= least && greatest - least <= SAME * least;
        // A limit that no value keeps since there is no solution says nothing of how it depends.
        let never_told =
            least == f64::INFINITY && greatest == f64::INFINITY && !self.report.against.is_limit();
        if self.never_jams() && self.report.against == MarginKind::Locking {
            let tips = if self.report.may_tip { " or tips" } else { "" };
            return Some(format!("No friction, however great, jams{tips} it anywhere in this range."));
        }
        (is_same || never_told)
            .then(|| format!("The {} is the same throughout this range.", subject(self.report)))
    }
}

fn never(report: &SizeReport) -> String {
    let load = report.load.as_deref().unwrap_or_default();
    match report.against {
        MarginKind::Locking if report.may_tip => "more friction would neither jam nor tip it".to_owned(),
        MarginKind::Locking => "more friction would not jam it".to_owned(),
        MarginKind::SelfLocking => format!("no static friction, however great, holds every `{load}`"),
        MarginKind::Hold => format!("it holds{} without friction", every_load(report)),
        // These are numbers wherever there is a solution.
        MarginKind::Effort | MarginKind::NormalForce | MarginKind::Pressure | MarginKind::Efficiency => {
            "there is no number".to_owned()
        }
    }
}

/// What is to be held, however great; empty of all loads as they are.
fn every_load(report: &SizeReport) -> String {
    report.load.as_ref().map_or(String::new(), |load| format!(" every `{load}`"))
}

/// The name of the numbers of the report: "safety factor", "greatest effort of push".
pub(super) fn subject(report: &SizeReport) -> String {
    let of = report.load.as_ref().map_or(String::new(), |name| format!(" of {name}"));
    match report.against {
        MarginKind::Effort => format!("greatest effort{of}"),
        MarginKind::NormalForce => format!("greatest normal force{of}"),
        MarginKind::Pressure => format!("greatest bearing pressure{of}"),
        MarginKind::Efficiency => "least efficiency".to_owned(),
        MarginKind::Locking | MarginKind::SelfLocking | MarginKind::Hold => "safety factor".to_owned(),
    }
}

/// One of these numbers with its unit.
pub(super) fn level(report: &SizeReport, value: f64) -> String {
    report.limit_shown_in.precise(value)
}

fn wish(report: &SizeReport) -> String {
    let margin = precise(report.margin);
    let load = report.load.as_deref().unwrap_or_default();
    match report.against {
        MarginKind::Locking => {
            let tipping = if report.may_tip { " and tipping" } else { "" };
            let both = if report.both_directions { " in both directions" } else { "" };
            format!("For a safety factor of {margin} against jamming{tipping}{both}")
        }
        MarginKind::SelfLocking => {
            format!("So that `{load}` does not lock it, with a safety factor of {margin}")
        }
        MarginKind::Hold => format!("To hold{} with a safety factor of {margin}", every_load(report)),
        MarginKind::Effort | MarginKind::NormalForce | MarginKind::Pressure => {
            format!("To keep the {} at {} or less", subject(report), level(report, report.margin))
        }
        MarginKind::Efficiency => format!("To keep the efficiency at {margin} or more"),
    }
}

/// A value of what is varied, with its unit.
pub(super) fn quantity(report: &SizeReport, value: f64) -> String {
    report.vary.shown_in.precise(value)
}
