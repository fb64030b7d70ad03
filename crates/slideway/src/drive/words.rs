//! The sentences on driven motion.

use super::report::{
    Approach, BlowUp, CourseDirection, DriveDirection, DriveName, DriveReport, DriveSolution, Efficiency,
    EfficiencyKind, EffortRange, PeakEffort, Sense,
};
use crate::limits::VariedQuantity;
use crate::report::effort::{self, least_friction, times, times_friction, unsettled, which_way};
use crate::report::{
    JointMode, OnFace, SHOWN_BY, Status, Verdict, capital, it_tips, it_would_tip, spaced, with_less,
};
use crate::units::number::{brief, number};
use crate::units::precise;

/// Greatest number of states whose efforts are listed in a sentence.
const TOLD: usize = 4;

/// The sentences of both directions of motion, and what makes an undetermined effort determinate.
pub(super) fn conclusion(report: &DriveReport) -> Vec<String> {
    at_rest(report)
        .chain(report.directions.iter().flat_map(|direction| sentences(report, direction)))
        .chain(advice(report))
        .chain(greatest(report))
        .collect()
}

/// With which efforts it stays at rest: "At rest it holds with `push` from -1.254 to 7.963 N."
pub(super) fn at_rest(report: &DriveReport) -> impl Iterator<Item = String> + '_ {
    report.held.iter().map(|held| format!("At rest: {}", held.words))
}

/// Where it jams or tips, and the greatest efforts: "Over h from 200 to 5000 mm, it tips (shoes) from 1500 mm on.",
/// "Over phi from 5 to 175 deg, motor is greatest at 77 deg: 1275 N m." Nothing of an effort that hardly varies.
pub(super) fn greatest(report: &DriveReport) -> Vec<String> {
    let Some(course) = &report.course else { return Vec::new() };
    let vary = &course.vary;
    let range = vary.shown_in.range(&vary.name, [vary.from, vary.to]);
    let one = |direction: &CourseDirection, peak: &PeakEffort| {
        let drive = &report.drives[peak.drive];
        let unit = report.units.of(drive.unit);
        let shown = |effort: f64| unit.brief(effort.abs());
        let efforts = direction.rows.iter().filter_map(|row| row.efforts.as_ref());
        let varies = efforts.into_iter().any(|row| shown(row[peak.drive]) != shown(peak.effort));
        let place = vary.shown_in.brief(peak.at);
        let told = format!("{} is greatest at {place}: {}.", drive.name, unit.brief(peak.effort));
        varies.then(|| match direction.direction {
            Sense::Model => format!("Over {range}, {told}"),
            Sense::Reversed => format!("Backwards, over {range}, {told}"),
        })
    };
    let stops = |way: &CourseDirection| {
        let over = if way.direction == Sense::Model { "Over" } else { "Backwards, over" };
        let jams = way.locked.iter().map(|jams| ([jams.from, jams.to], "jams".to_owned()));
        let tips = way
            .tips
            .iter()
            .map(|tips| ([tips.from, tips.to], it_tips(&tips.joints).trim_start_matches("it ").to_owned()));
        let mut stops: Vec<([f64; 2], String)> = jams.chain(tips).collect();
        stops.sort_by(|one, other| one.0[0].total_cmp(&other.0[0]));
        let told: Vec<String> =
            stops.iter().map(|(ends, what)| format!("{what} {}", stretch(vary, *ends))).collect();
        (!told.is_empty()).then(|| format!("{over} {range}, it {}.", in_turn(&told)))
    };
    let peaks = course.directions.iter().flat_map(|way| way.peaks.iter().map(move |peak| (way, peak)));
    course.directions.iter().filter_map(stops).chain(peaks.filter_map(|(way, peak)| one(way, peak))).collect()
}

/// "jams below 2 m and tips from 4 m on", with commas between more.
fn in_turn(parts: &[String]) -> String {
    match parts {
        [first @ .., before, last] => {
            let first = first.iter().chain([before]).map(String::as_str).collect::<Vec<_>>().join(", ");
            format!("{first} and {last}")
        }
        parts => parts.concat(),
    }
}

/// A part of the range: "from 1524 mm on", "below 20 mm", "from 1524 to 1658 mm", "throughout".
fn stretch(vary: &VariedQuantity, [from, to]: [f64; 2]) -> String {
    let shown = |value: f64| vary.shown_in.brief(value);
    match (from <= vary.from, to >= vary.to) {
        (true, true) => "throughout".to_owned(),
        (true, false) => format!("below {}", shown(to)),
        (false, true) => format!("from {} on", shown(from)),
        (false, false) => format!("from {} to {}", vary.shown_in.brief_number(from), shown(to)),
    }
}

/// The advice that makes an undetermined effort determinate.
pub(super) fn advice(report: &DriveReport) -> Option<String> {
    let ranges = report.directions.iter().filter_map(|direction| direction.range.as_ref());
    ranges.filter_map(|range| range.undetermined.advice()).map(str::to_owned).next()
}

/// The needs of one direction of motion, and whether it jams: "push needs 36.36 N (20 N without friction):
/// efficiency 55 %.", "It would jam from mu = 0.6667 (2.222 times this friction)."
pub(super) fn sentences(report: &DriveReport, direction: &DriveDirection) -> Vec<String> {
    let whole = |clause: String| match direction.direction {
        Sense::Reversed => format!("Backwards, {clause}"),
        // All but names of drives and joints.
        Sense::Model
            if ["it ", "infinitely ", "friction holds ", "from ", "with less "]
                .iter()
                .any(|word| clause.starts_with(word)) =>
        {
            capital(&clause)
        }
        Sense::Model => clause,
    };
    // The advice on a joint that tips is given once, for the motion of the model.
    let is_advised = direction.direction == Sense::Reversed
        && report
            .directions
            .iter()
            .any(|other| other.direction == Sense::Model && other.tips == direction.tips);
    std::iter::once(needs(report, direction, is_advised))
        .chain(tipping(direction))
        .chain(outlook(report, direction, is_advised))
        .chain(direction.below.iter().map(|limit| with_less(limit, direction.mu) + "."))
        .map(whole)
        .collect()
}

/// The efforts and the efficiency, or that it jams.
fn needs(report: &DriveReport, direction: &DriveDirection, is_advised: bool) -> String {
    if let Some(range) = &direction.range {
        return undetermined(report, direction, range);
    }
    match (direction.solutions.as_slice(), direction.status) {
        (_, Status::Continuum) => {
            "infinitely many states are possible, and their efforts are not known.".to_owned()
        }
        ([], Status::Unknown) => {
            "it is not decided whether it moves: it is on the verge of jamming. Take it as jammed.".to_owned()
        }
        ([], _) => stuck(report, direction, is_advised),
        ([only], _) => settled(report, direction, only),
        _ => needs_several(report, direction),
    }
}

/// The efforts of the state that it takes: "push needs 27.3 N (20 N without friction): efficiency 73.26 %. foot lifts off.",
/// "it tips (shoes); push needs 206.6 N (0 N without friction)."
fn settled(report: &DriveReport, direction: &DriveDirection, only: &DriveSolution) -> String {
    let needs = needs_one(report, direction, only);
    let tips = tips(only);
    let needs = if tips.is_empty() { needs } else { format!("{}; {needs}", it_tips(&tips)) };
    format!("{needs}.{}{}", lifts(only), unsettled(only.attainability))
}

/// The joints that tip in a state.
fn tips(state: &DriveSolution) -> Vec<String> {
    let tips = state.joints.iter().filter(|joint| joint.face == Some(OnFace::Tips));
    tips.map(|joint: &JointMode| joint.name.clone()).collect()
}

/// "it jams: no force moves it.", "it tips (bed), which only a block slider can show."
fn stuck(report: &DriveReport, direction: &DriveDirection, is_advised: bool) -> String {
    if !direction.tips.is_empty() && is_advised {
        return format!("{}, too.", it_tips(&direction.tips));
    }
    if !direction.tips.is_empty() {
        return format!("{}, {SHOWN_BY}.", it_tips(&direction.tips));
    }
    format!("it jams: no {} moves it.", kind_of_all(report))
}

/// "force", "torque", or "effort" of drives of several kinds.
fn kind_of_all(report: &DriveReport) -> &'static str {
    let kinds: Vec<Option<&str>> = report.drives.iter().map(|drive| effort::kind(drive.unit)).collect();
    let is_one = kinds.windows(2).all(|pair| pair[0] == pair[1]);
    kinds.first().copied().flatten().filter(|_| is_one).unwrap_or("effort")
}

/// "push needs 36.36 N (20 N without friction): efficiency 55 %"
fn needs_one(report: &DriveReport, direction: &DriveDirection, only: &DriveSolution) -> String {
    // Both directions are one.
    let is_at_rest = report.directions.len() == 1;
    let may_be_idle = report.drives.len() == 1 && !is_at_rest;
    let lifts_off = only.joints.iter().any(|joint| matches!(joint.face, Some(OnFace::Opens | OnFace::Tips)));
    let is_idle = only.efficiency.is == EfficiencyKind::NoPower && may_be_idle;
    let one = |(drive, (with, without)): (&DriveName, (&f64, &f64))| {
        let unit = report.units.of(drive.unit);
        // The power of one drive has the sign of its effort; where the loads push nobody wonders.
        if lifts_off && report.drives.len() == 1 && only.power < 0.0 && with * without <= 0.0 {
            return effort::held_back(&drive.name, &unit.brief(with.abs()));
        }
        let with = unit.brief(*with);
        // One drive that does no work without friction has no effort then.
        if is_idle {
            format!("{} needs {with}", drive.name)
        } else {
            effort::needs(&drive.name, &with, &unit.brief(*without), lifts_off)
        }
    };
    let efforts = only.efforts.iter().zip(&direction.frictionless.efforts);
    let needs: Vec<String> = report.drives.iter().zip(efforts).map(one).collect();
    let gain = match (only.efficiency.is, only.efficiency.value) {
        _ if is_idle && only.efforts.iter().all(|effort| *effort == 0.0) => ": nothing resists it".to_owned(),
        _ if is_idle && lifts_off => String::new(),
        _ if is_idle => ", all of it against friction".to_owned(),
        (EfficiencyKind::Driving, Some(value)) => format!(": efficiency {}", percent(value)),
        (EfficiencyKind::Braking, Some(value)) => {
            let comma = if needs.iter().any(|need| need.ends_with("friction")) { "," } else { "" };
            format!("{comma} to brake the load: efficiency {}", percent(value))
        }
        (EfficiencyKind::HeldByFriction, _) => {
            return format!("friction holds the load: to move it, {}", needs.join(", "));
        }
        (EfficiencyKind::NoPower, _) if is_at_rest => String::new(),
        (EfficiencyKind::NoPower, _) => "; without friction the motion needs no power".to_owned(),
        _ => "; without friction the drives push, with it they brake".to_owned(),
    };
    needs.join(", ") + &gain
}

/// " foot lifts off.", of joints that open.
fn lifts(only: &DriveSolution) -> String {
    let opens = only.joints.iter().filter(|joint| joint.face == Some(OnFace::Opens));
    let opens: Vec<String> = opens.map(|joint| format!(" {} lifts off.", joint.name)).collect();
    opens.concat()
}

/// "push needs 9.091 N (20 N without friction) to brake the load: efficiency 45.45 %. Another state, at -100 N, is unstable.",
/// "2 states are possible: push needs 9.091 N, or 12 N."
fn needs_several(report: &DriveReport, direction: &DriveDirection) -> String {
    let states = &direction.solutions;
    let ([drive], 0..=TOLD) = (report.drives.as_slice(), states.len()) else {
        return format!("it can go on in {} ways, each with its own efforts.", states.len());
    };
    let unit = report.units.of(drive.unit);
    let efforts = |states: &[&DriveSolution], between: &str| {
        let note = |state: &DriveSolution| match state.attainability {
            _ if !tips(state).is_empty() && states.len() > 1 => format!(" where {}", it_tips(&tips(state))),
            Verdict::Flutter => " (it may vibrate)".to_owned(),
            _ => String::new(),
        };
        let one = |state: &&DriveSolution| unit.brief(state.efforts[0]) + &note(state);
        states.iter().map(one).collect::<Vec<_>>().join(between)
    };
    let (unstable, stable): (Vec<_>, Vec<_>) =
        states.iter().partition(|state| state.attainability == Verdict::Unattainable);
    let needs = match stable.as_slice() {
        [] => {
            let efforts = efforts(&unstable, ", or ");
            return format!("all {} states are unstable: {} needs {efforts}.", states.len(), drive.name);
        }
        [only] => settled(report, direction, only),
        several => {
            let efforts = efforts(several, ", or ");
            let which = which_way(several.iter().map(|state| state.attainability));
            format!("it can go on in {} ways, and {which}: {} needs {efforts}.", several.len(), drive.name)
        }
    };
    match unstable.as_slice() {
        [] => needs,
        [one] => format!("{needs} Another state, at {}, is unstable.", efforts(&[one], "")),
        several => {
            format!("{needs} {} other states, at {}, are unstable.", several.len(), efforts(several, " and "))
        }
    }
}

/// "belt needs 25 to 50 N (20 N without friction), efficiency 40 to 80 %; how left, right share the load is
/// undetermined."
fn undetermined(report: &DriveReport, direction: &DriveDirection, range: &EffortRange) -> String {
    let efforts = range.undetermined.efforts.iter().zip(&direction.frictionless.efforts);
    let needs = efforts.map(|(range, without)| {
        let without = report.units.of(range.unit).brief(*without);
        effort::needs(&range.name, &range.in_brief(&report.units), &without, false)
    });
    let mut parts: Vec<String> = needs.collect();
    parts.extend(range.efficiency.map(|ends| format!("efficiency {}", percents(ends))));
    let further = match direction.solutions.len() {
        0 => "",
        1 => " One more state has its own effort.",
        _ => " More states have their own efforts.",
    };
    format!("{}; {}.{further}", parts.join(", "), range.undetermined.cause())
}

/// "it would tip (shoes) from mu = 0.45 (1.5 times this friction)."
fn tipping(direction: &DriveDirection) -> Option<String> {
    let limit = direction.tipping.as_ref()?;
    let at = times_friction(limit.factor, direction.mu.map(|mu| limit.factor * mu));
    Some(it_would_tip(&limit.joints, &at) + ".")
}

/// When other states appear or it would jam, or that it never does; nothing where that is not known.
fn outlook(report: &DriveReport, direction: &DriveDirection, is_advised: bool) -> Vec<String> {
    let at = |factor: f64| times_friction(factor, direction.mu.map(|mu| factor * mu));
    let others = direction.another_count.map(|changes| {
        let both = if direction.direction == Sense::Reversed { " --both-directions" } else { "" };
        let range = format!("1..{}", (2.0 * changes).ceil());
        format!(
            "from {} it can also move in another way (`limits --vary friction={range}{both}` shows it)",
            at(changes)
        )
    });
    match jam(report, direction, is_advised) {
        Some(never) if direction.never_jams => {
            vec![never + &others.map_or_else(String::new, |others| format!(", but {others}")) + "."]
        }
        jam => others.into_iter().chain(jam).map(|clause| clause + ".").collect(),
    }
}

/// When it would jam, or that it never does; none where that is not known.
fn jam(report: &DriveReport, direction: &DriveDirection, is_advised: bool) -> Option<String> {
    if let Some(below) = &direction.moves_below {
        let what = if direction.tips.is_empty() { "it moves" } else { "it does not tip" };
        return Some(format!("{what} below {}", least_friction(below.factor, below.mu)));
    }
    let [.., last] = direction.solutions.as_slice() else { return None };
    let Some(factor) = direction.no_solution else {
        if let Some(factor) = direction.unique_at_least {
            return Some(if effort::is_any_friction(factor) {
                "it does not jam, whatever the friction".to_owned()
            } else {
                format!("it does not jam even with {}", times(factor))
            });
        }
        let settles = !matches!(last.attainability, Verdict::Unattainable | Verdict::Flutter);
        let never = direction.never_jams && direction.solutions.len() == 1 && settles;
        return never.then(|| "it does not jam at any friction while it moves".to_owned());
    };
    // What tips before it jams has been told to tip.
    if direction.tipping.is_some() {
        return None;
    }
    let at = times_friction(factor, direction.mu.map(|mu| factor * mu));
    if !direction.tips.is_empty() {
        let advice = if is_advised { String::new() } else { format!(", {SHOWN_BY}") };
        return Some(it_would_tip(&direction.tips, &at) + &advice);
    }
    // A jam that no growing effort announces.
    let grows = |blow_ups: &Vec<BlowUp>| blow_ups.iter().any(|one| precise(one.at) == precise(factor));
    let is_sudden = direction.blow_ups.as_ref().is_some_and(|blow_ups| !grows(blow_ups));
    let warning = if is_sudden {
        format!(", suddenly: up to there the {} stays finite", kind_of_all(report))
    } else {
        String::new()
    };
    Some(format!("it would jam from {at}{warning}"))
}

/// "40 to 80 %"
pub(super) fn percents([from, to]: [f64; 2]) -> String {
    if from == to { percent(from) } else { format!("{} to {}", brief(100.0 * from), percent(to)) }
}

fn percent(share: f64) -> String {
    format!("{} %", brief(100.0 * share))
}

/// An efficiency as a cell of a table: "68.966 % (braking)".
pub(super) fn share(efficiency: Efficiency) -> String {
    let percent = |value: f64| format!("{} %", number(100.0 * value));
    match (efficiency.is, efficiency.value) {
        (EfficiencyKind::Driving, Some(value)) => percent(value),
        (EfficiencyKind::Braking, Some(value)) => format!("{} (braking)", percent(value)),
        (is, _) => is.in_words().to_owned(),
    }
}

/// The verdict on stability, as a cell of a table.
pub(super) fn is_stable(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Attainable => "yes",
        Verdict::Unattainable => "no",
        Verdict::Flutter => "may vibrate",
        Verdict::Undecided => "not decided",
        Verdict::NotComputed => "not computed",
    }
}

/// "Just below mu = 0.5 the force of push grows without limit"; with details also which normal forces do, and the signs.
pub(super) fn without_limit(report: &DriveReport, blow_up: &BlowUp, at: &str, details: bool) -> String {
    let growing = report.drives.iter().zip(&blow_up.efforts).filter(|(_, sign)| **sign != 0);
    let growing: Vec<String> = growing
        .map(|(drive, _)| format!("the {} of {}", effort::kind(drive.unit).unwrap_or("effort"), drive.name))
        .collect();
    let verb = if growing.len() == 1 { "grows" } else { "grow" };
    let side = match blow_up.side {
        Approach::Below => "below",
        Approach::Above => "above",
    };
    let what = format!("Just {side} {at} {} {verb} without limit", growing.join(" and "));
    if !details {
        return what;
    }
    let also = match blow_up.contacts.as_slice() {
        [] => String::new(),
        [one] => format!("; so does the normal force of {one}"),
        contacts => format!("; so do the normal forces of {}", contacts.join(", ")),
    };
    // Hinges alone have no signs.
    match blow_up.pattern.as_str() {
        "" => what + &also,
        pattern => format!("{what} (signs {}){also}", spaced(pattern)),
    }
}
