//! The answer of `hold`, in sentences.

use super::TOLERANCE;
use super::ranges::{greatest, words};
use super::report::{
    BeyondHeld, CoordinateRange, FrictionNeeded, HoldReport, HoldVerdict, JointRelease, LoadReport, Range,
    Release, Threshold, Wedging,
};
use crate::report::capital;
use crate::units::number::brief;

/// The verdict on rest, and which loads it holds: "It holds.", "Self-locking: it holds any `screw` from
/// mu_static = 0.1667 (now 0.2)."
pub(super) fn answer(report: &HoldReport) -> String {
    let Some(load) = &report.load else {
        let friction = report.friction.as_ref().filter(|_| report.is_decided());
        let needed = friction.and_then(|friction| needed(report.verdict, friction));
        let verdict = verdict(report);
        return match needed {
            None => verdict,
            Some(Needed::Clause(clause)) => verdict.replacen("It holds", &format!("It holds {clause}"), 1),
            Some(Needed::Sentence(sentence)) => format!("{verdict} {sentence}"),
        };
    };
    let is_all = load.held == [Range { least: None, greatest: None }];
    let mut sentences = Vec::new();
    // That it holds is said by what it holds.
    if !(report.holds && is_sure(load) && is_all) {
        let verdict = verdict(report);
        sentences.push(match verdict.strip_prefix("It ") {
            // A drive is a load that is absent.
            Some(rest) if !load.unit.is_empty() => format!("Without `{}` it {rest}", load.name),
            _ => verdict,
        });
    }
    if !is_all {
        sentences.push(held(report, load));
        sentences.extend(beyond(report, load));
    }
    sentences.push(locks(load, is_all));
    sentences.join(" ")
}

/// The verdict on rest.
fn verdict(report: &HoldReport) -> String {
    if !report.is_decided() {
        return "Not decided: no state of rest was found, but some states could not be examined. Ask again with \
                slightly more or less friction or load."
            .to_owned();
    }
    match report.verdict {
        HoldVerdict::Holds | HoldVerdict::MayHold => "It holds.".to_owned(),
        HoldVerdict::HoldsUntilPushed => {
            "It holds. Once pushed it keeps sliding: kinetic friction is lower than static.".to_owned()
        }
        HoldVerdict::HoldsOrSlips => {
            let may = "It may hold, or it may start to slide: do not rely on it.";
            format!("{may}{}", if report.falls_freely() { FALLS_FREELY } else { "" })
        }
        HoldVerdict::Moves => moves(report),
        HoldVerdict::Neither => {
            "It can neither stay at rest nor start to slide with finite accelerations.".to_owned()
        }
        HoldVerdict::DoesNotHold => "It does not hold.".to_owned(),
    }
}

/// What is said of the static friction that the loads need as they are.
enum Needed {
    /// Behind "It holds".
    Clause(String),
    Sentence(String),
}

/// "with a safety factor of 1.8", "It would hold from mu_static = 0.36 (now 0.3)."
fn needed(verdict: HoldVerdict, friction: &FrictionNeeded) -> Option<Needed> {
    let FrictionNeeded { threshold: known, certain_from, .. } = friction;
    match (verdict, *certain_from) {
        (HoldVerdict::Holds | HoldVerdict::HoldsUntilPushed | HoldVerdict::MayHold, certain) => {
            let certain = certain.filter(|from| *from <= known.present * (1.0 + TOLERANCE))?;
            let factor = brief(known.present / certain);
            Some(Needed::Clause(match factor.as_str() {
                _ if certain == 0.0 => "even without friction".to_owned(),
                "1" if known.parameter.is_some() => {
                    format!("only just, {}: with any less it slips", from(known, certain))
                }
                "1" => "only just: with any less friction it slips".to_owned(),
                factor => format!("with a safety factor of {factor}"),
            }))
        }
        (HoldVerdict::Neither, _) => None,
        (HoldVerdict::HoldsOrSlips, certain) => {
            Some(Needed::Sentence(format!("It holds for certain {}.", from(known, certain?))))
        }
        (_, Some(certain)) => Some(Needed::Sentence(format!("It would hold {}.", from(known, certain)))),
        (_, None) if known.value.is_none() && known.undecided == 0 => {
            Some(Needed::Sentence("More friction would not hold it.".to_owned()))
        }
        (_, None) => None,
    }
}

/// Why something may slide that would hold: what a designer of a bracket that carries its own weight has to know.
const FALLS_FREELY: &str = " While it slides nothing presses its guides; let down gently it holds.";

/// Forces up to this part of the greatest at rest press nothing.
const NOTHING: f64 = 1e-12;

impl HoldReport {
    /// Whether in every motion that begins no contact is pressed, and at rest all forces have bounds: they grow with the loads
    /// then, so that it holds while the loads are let on little by little.
    pub(crate) fn falls_freely(&self) -> bool {
        let is_zero = |range: &Range| {
            let ends = [range.least, range.greatest];
            ends.into_iter().all(|end| end.is_some_and(|end| end.abs() <= NOTHING * self.force))
        };
        let nothing_presses = |release: &Release| {
            let contacts = &release.reactions.contacts;
            !contacts.is_empty() && contacts.iter().all(|contact| contact.normal_forces().iter().all(is_zero))
        };
        let rest = self.at_rest.as_ref();
        let is_wedged = self.sharing.is_some() || rest.is_none_or(|rest| !rest.wedging.is_empty());
        !is_wedged && !self.releases.is_empty() && self.releases.iter().all(nothing_presses)
    }
}

/// "It does not hold: it starts to slide (x: -4 m/s^2)."
fn moves(report: &HoldReport) -> String {
    let acceleration = |release: &Release| {
        let scale = greatest(&release.coordinates.iter().map(|one| one.acceleration).collect::<Vec<_>>());
        let rests = |one: &CoordinateRange| words(one.acceleration, scale, &report.units.of(one.unit)) == "0";
        let mut moving = release.coordinates.iter().filter(|one| !rests(one));
        let (Some(only), None) = (moving.next(), moving.next()) else { return None };
        let unit = report.units.of(only.unit);
        let ends = only.acceleration.least.zip(only.acceleration.greatest)?;
        let [least, greatest] = [ends.0, ends.1].map(|end| unit.brief(end));
        (least == greatest).then(|| format!(" ({}: {least})", only.name))
    };
    match report.releases.as_slice() {
        [only] if !only.gaps.is_empty() => format!("It does not hold: {}.", begins(only)),
        [only] => {
            format!("It does not hold: {}{}.", begins(only), acceleration(only).unwrap_or_default())
        }
        several => {
            let slides = several.iter().all(|release| release.gaps.is_empty());
            let starts = if slides { "slide" } else { "move" };
            format!("It does not hold: it starts to {starts}, in one of {} ways.", several.len())
        }
    }
}

/// "it tips over base.rear and slides", "head lifts off", "it starts to slide"
pub(super) fn begins(release: &Release) -> String {
    if release.gaps.is_empty() {
        let slides = release.joints.iter().any(|joint| joint.slip != 0);
        return format!("it starts to {}", if slides { "slide" } else { "move" });
    }
    let words = |joint: &JointRelease| match joint.words.strip_prefix("tips over ") {
        Some(over) => {
            let corner = over.split_once(", ").map_or(over, |(corner, _)| corner);
            format!("it tips over {corner}{}", if joint.slip == 0 { "" } else { " and slides" })
        }
        None => format!("{} {}", joint.name, joint.words),
    };
    let lifting = release.joints.iter().filter(|joint| !joint.open.is_empty());
    lifting.map(words).collect::<Vec<_>>().join(", ")
}

/// Whether every load that is great enough is held by itself: it cannot slide, whether or not it was wedged before.
fn is_sure(load: &LoadReport) -> bool {
    let reached = |from: f64| from <= load.threshold.present * (1.0 + TOLERANCE);
    load.self_locking && load.certain_from.is_some_and(reached)
}

/// The loads that it holds: "It holds with `cam` from 193 to 286.1 N.", "It holds -1.2 to 1.2 times `W`.",
/// "It would hold with 3 times `W` or less." where it does not hold `W` itself.
fn held(report: &HoldReport, load: &LoadReport) -> String {
    let unit = report.units.of(load.unit);
    let name = &load.name;
    let one = |range: &Range| match (range.least, range.greatest, load.unit) {
        (None, None, _) => format!("any `{name}`, reversed as well"),
        (Some(0.0), None, _) => format!("any `{name}`"),
        (None, Some(0.0), _) => format!("any reversed `{name}`"),
        (Some(0.0), Some(greatest), "") => format!("up to {} times `{name}`", brief(greatest)),
        (Some(least), None, "") if least < 0.0 => {
            format!("any `{name}`, and reversed up to {} times it", brief(-least))
        }
        (Some(least), None, "") => format!("{} times `{name}` or more", brief(least)),
        (None, Some(greatest), "") if greatest < 0.0 => {
            format!("reversed, {} times it or more", brief(-greatest))
        }
        (None, Some(greatest), "") => format!("{} times `{name}` or less", brief(greatest)),
        (Some(least), Some(greatest), "") if least == greatest => {
            format!("exactly {} times `{name}`", brief(least))
        }
        (Some(least), Some(greatest), "") if least < 0.0 && greatest > 0.0 => {
            let [back, on] = [-least, greatest].map(brief);
            let reversed = if back == on { "as well".to_owned() } else { format!("up to {back} times") };
            format!("up to {on} times `{name}`, reversed {reversed}")
        }
        (Some(least), Some(greatest), "") => {
            format!("{} to {} times `{name}`", brief(least), brief(greatest))
        }
        (Some(least), None, _) => format!("`{name}` from {} on", unit.brief(least)),
        (None, Some(greatest), _) if greatest < 0.0 => {
            format!("reversed `{name}` from {} on", unit.brief(-greatest))
        }
        (None, Some(greatest), _) => format!("`{name}` up to {}", unit.brief(greatest)),
        (Some(least), Some(greatest), _) if least == greatest => {
            format!("`{name}` of {} only", unit.brief(least))
        }
        (Some(least), Some(greatest), _) => {
            format!("`{name}` from {} to {}", unit.brief_number(least), unit.brief(greatest))
        }
    };
    let is_open = load.undecided > 0;
    let holds = match (load.unit, report.holds) {
        (_, true) if is_open => "holds at least",
        (_, false) if is_open => "would hold at least with",
        ("", true) => "holds",
        ("", false) => "would hold with",
        _ => "holds with",
    };
    match load.held.as_slice() {
        [] if is_open => format!("Which `{name}` it holds was not decided."),
        [] if load.unit.is_empty() => format!("It does not hold with any multiple of `{name}`."),
        [] => format!("No `{name}` holds it."),
        held if holds_none(held) && !is_open => format!("It holds no `{name}`, however small."),
        ranges => {
            // What acts as it was named comes before what is reversed.
            let (named, reversed): (Vec<&Range>, Vec<&Range>) =
                ranges.iter().partition(|range| range.greatest.is_none_or(|greatest| greatest > 0.0));
            let with_force = |range: &Range| one(range) + &in_newtons(report, load, range);
            let all: Vec<String> = named.into_iter().chain(reversed).map(with_force).collect();
            format!("It {holds} {}.", all.join(", or "))
        }
    }
}

/// The forces at the ends of a range of factors: " (90 N)", " (20 to 90 N)". Empty of a drive, and where it has no end.
fn in_newtons(report: &HoldReport, load: &LoadReport, range: &Range) -> String {
    let Some(force) = load.force else { return String::new() };
    let unit = report.units.of("N");
    let ends = [range.least, range.greatest].map(|end| end.filter(|end| *end != 0.0).map(|end| end * force));
    match ends {
        [Some(least), Some(greatest)] if brief(least.abs()) != brief(greatest.abs()) => {
            format!(" ({} to {})", unit.brief_number(least), unit.brief(greatest))
        }
        [None, None] => String::new(),
        [least, greatest] => {
            let end = greatest.or(least).unwrap_or_default();
            format!(" ({})", unit.brief(end.abs()))
        }
    }
}

/// "Beyond, it tips over shoes.front.", "Above 88.29 N it tips over shoes.front, below -88.29 N it starts to slide."
fn beyond(report: &HoldReport, load: &LoadReport) -> Option<String> {
    let first = load.beyond.first()?;
    let ends = load.held.iter().flat_map(|range| [range.least, range.greatest]).flatten().count();
    if ends == load.beyond.len() && load.beyond.iter().all(|end| end.words == first.words) {
        return Some(format!("Beyond, {}.", first.words));
    }
    let unit = report.units.of(load.unit);
    let one = |end: &BeyondHeld| {
        let side = if end.above { "above" } else { "below" };
        let at = if load.unit.is_empty() { format!("{} times", brief(end.at)) } else { unit.brief(end.at) };
        format!("{side} {at} {}", end.words)
    };
    Some(capital(&load.beyond.iter().map(one).collect::<Vec<_>>().join(", ")) + ".")
}

/// True if only none of the load is held.
fn holds_none(held: &[Range]) -> bool {
    held == [Range { least: Some(0.0), greatest: Some(0.0) }]
}

/// The friction from which on it is self-locking, and whether it is now: with any load that is great enough, and by itself.
fn locks(load: &LoadReport, holds_all: bool) -> String {
    let (name, known) = (&load.name, &load.threshold);
    let Some(first) = known.value else { return never_locks(load) };
    let is_same = |certain: f64| certain <= first * (1.0 + TOLERANCE);
    let at = |value: f64| if value == 0.0 { "even without friction".to_owned() } else { from(known, value) };
    if let Some(certain) = load.certain_from.filter(|&certain| is_sure(load) || is_same(certain)) {
        let (from, is_just) = (at(certain), certain >= known.present * (1.0 - TOLERANCE));
        return match (load.self_locking, load.held.as_slice()) {
            // Together with the other loads it does not hold every multiple of this one.
            (true, _) if !holds_all => format!("By itself `{name}` is held, however great, {from}."),
            (true, _) if is_just => {
                format!("Just self-locking: it holds any `{name}` {from}; with any less it slips.")
            }
            (true, _) => format!("Self-locking: it holds any `{name}` {from}."),
            // That a great enough one moves it has been said.
            (false, []) => format!("`{name}` alone would be held, however great, {from}."),
            (false, held) if load.undecided > 0 || holds_none(held) => {
                format!("It would be self-locking {from}.")
            }
            (false, _) => {
                format!(
                    "Not self-locking: `{name}` moves it if great enough. It would be self-locking {from}."
                )
            }
        };
    }
    let holds = if load.self_locking { "holds" } else { "would hold" };
    let (wedged, by_itself) = match load.certain_from {
        Some(certain) => ("Wedged", format!("; without a knock only from {}", value_of(known, certain))),
        None => ("Only wedged", String::new()),
    };
    format!("{wedged} by a knock it {holds} any `{name}` {}{by_itself}.", at(first))
}

/// That no friction was found with which a load is held, however great.
fn never_locks(
    LoadReport { name, threshold: Threshold { varied, undecided, .. }, self_locking, .. }: &LoadReport,
) -> String {
    match (self_locking, undecided) {
        (true, 0) => format!("Self-locking: it holds any `{name}`, but not with `{name}` as the only load."),
        (true, _) => format!("Self-locking: it holds any `{name}`. From which {varied} on was not decided."),
        (false, 0) => format!("Not self-locking at any {varied}."),
        (false, _) => format!("Whether any {varied} makes it self-locking was not decided."),
    }
}

/// From which friction on guides that share a load wedge.
pub(super) fn wedges(Wedging { possible, threshold: known }: &Wedging) -> Vec<String> {
    let Some(value) = known.value else {
        return vec![match known.undecided {
            0 => format!("No {} wedges the guides.", known.varied),
            _ => format!("Whether any {} wedges the guides was not decided.", known.varied),
        }];
    };
    let from = from(known, value);
    let mut sentences = vec![match (possible, known.undecided) {
        (true, _) => format!("The guides can wedge, {from}."),
        (false, 0) => format!("The guides cannot wedge; they could {from}."),
        (false, _) => format!("The guides could wedge {from}."),
    }];
    if *possible {
        sentences.push(
            "Pressed against each other they then stay so without any load. Whether that holds a load depends on how it came \
             to rest."
                .to_owned(),
        );
    }
    sentences
}

/// "from mu_static = 0.1667 (now 0.2)", "at the latest from mu_static = 0.1667 (now 0.2)" where some patterns are open.
fn from(known: &Threshold, value: f64) -> String {
    let at_the_latest = if known.undecided > 0 { "at the latest " } else { "" };
    format!("{at_the_latest}from {}", threshold(known, value))
}

/// "mu = 0.6 (now 0.3)", "mu_static = 0.1667 (now 0.2)", "1.2 times this static friction"
fn threshold(known: &Threshold, value: f64) -> String {
    let told = value_of(known, value);
    match coefficient(known, value).map(|(_, at, present)| [at, present].map(brief)) {
        Some([at, present]) if at == present => format!("{told}, its present value"),
        Some([_, present]) => format!("{told} (now {present})"),
        None => told,
    }
}

/// "mu = 0.6", "1.2 times this static friction"
fn value_of(known: &Threshold, value: f64) -> String {
    match coefficient(known, value) {
        Some((name, at, _)) => format!("{name} = {}", brief(at)),
        None => format!("{} times this static friction", brief(value)),
    }
}

/// The coefficient that all static friction is, its value there and its present one; none where there are several.
fn coefficient(known: &Threshold, value: f64) -> Option<(&str, f64, f64)> {
    if known.varied != "static friction" {
        return Some((&known.varied, value, known.present));
    }
    if let Some((name, present)) = &known.parameter {
        return Some((name, present * value, *present));
    }
    let mut coefficients = known.coefficients.iter().flat_map(|one| one.mu_static);
    let first = coefficients.next().filter(|_| !known.friction_in_hinges)?;
    let present = first / known.value.unwrap_or(value);
    coefficients.all(|other| other == first).then_some(("mu_static", present * value, present))
}

/// That motions without inertia leave the start of the motion open.
pub(super) fn without_inertia(report: &HoldReport) -> Option<String> {
    let is_open = !report.motions_without_inertia.is_empty();
    is_open.then(|| "The moving parts have no mass, so only the forces at rest are examined.".to_owned())
}
