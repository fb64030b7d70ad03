//! The efforts over a parameter, a coordinate or friction.

use super::efforts::{Efforts, GROWTH};
use super::peak::{SAME_ROW, peaks};
use super::report::{
    Approach, BlowUp, CourseDirection, CourseMode, CourseRow, DriveSolution, LockedRange, Sense, TipsOver,
};
use super::state::{self, AllEfforts, growing_ends};
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::limits::{Method, ModesFound, Naming, RangeWithoutProblem, StateAt, Varied, find, guarantee};
use crate::mechanism::Mechanism;
use crate::modes::ContactState;
use crate::modes::existence::{EndCause, ModeEnd, ModeInterval, cells, ends};
use crate::progress::Work;
use crate::report::{Status, Verdict, joints_in_words};
use crate::scan::{bisect_until, evenly};
use crate::solve::{Happens, Stages, happens, pattern};
use std::ops::ControlFlow;

/// Places nearer to zero than this share of the range are zero.
const ROUNDING: f64 = 1e-12;
/// Steps between which efforts that pass through infinity, and changes of the number of solutions, are sought.
pub(super) const STEPS: usize = 500;

/// Account of what the search can miss.
pub(super) struct Guarantee {
    /// Whether changes were sought between sampled values.
    pub(super) sampled: bool,
    pub(super) words: String,
}

/// The efforts in one direction of motion, and what can be missed.
///
/// # Errors
/// Too many modes; a fault if nothing varies.
pub(super) fn direction(
    varied: &Varied,
    (range, steps): ([f64; 2], usize),
    direction: Sense,
    work: Work<'_>,
) -> Result<(Guarantee, CourseDirection), Faults> {
    let found = find(varied, range, None, 0, work.part(0, 2))?;
    let efforts = |value: f64| {
        let goes_on = !work.part(1, 2).is_over();
        if goes_on { Efforts::at(varied, value).ok() } else { None }
    };
    let stages = Stages::new(varied.model())?;
    let mut blow_ups = growing_ends(&found.existence, &stages, efforts);
    let places: Vec<(f64, Option<Efforts>)> =
        evenly(range, STEPS).map(|value| (value, efforts(value))).collect();
    blow_ups.extend(poles((&places, efforts), range, &found));
    blow_ups.sort_by(|one, other| one.at.total_cmp(&other.at));
    let naming = Naming::new(varied.model())?;
    let course = Tabulated {
        varied,
        efforts: &efforts,
        range,
        found: &found,
        blow_ups: &blow_ups,
        naming: &naming,
        work,
    };
    let rows = course.rows(steps);
    let modes = modes(&rows, &naming);
    let peaks = peaks(&places, (&found, &rows, &blow_ups), efforts);
    let (tips, locked) = stops(&found, &naming.mechanism);
    let without_mode_problem = RangeWithoutProblem::of(&found);
    let sampled = found.method == Method::Bracketing;
    Ok((
        Guarantee { sampled, words: guarantee(&found, &varied.shown_in) },
        CourseDirection { direction, rows, modes, blow_ups, peaks, tips, locked, without_mode_problem },
    ))
}

/// The ranges in which joints tip in every state, and those in which it jams.
fn stops(found: &ModesFound, mechanism: &Mechanism) -> (Vec<TipsOver>, Vec<LockedRange>) {
    let (mut tips, mut locked): (Vec<TipsOver>, Vec<LockedRange>) = (Vec::new(), Vec::new());
    let same = |one: f64, other: f64| found.same_ends.are_one(one.min(other), one.max(other));
    for count in &found.counts {
        let inside = ends(&found.existence.modes).filter(|end| count.from < *end && *end < count.to);
        for cell in cells(inside.chain([count.from, count.to]), same) {
            let [from, to] = cell.map(|end| found.same_ends.told(end));
            match happens((&found.existence, mechanism), cell, same) {
                Happens::Tips(joints) => match tips.last_mut() {
                    Some(last) if last.joints == joints && last.to == from => last.to = to,
                    _ => tips.push(TipsOver { from, to, joints }),
                },
                Happens::Nothing if count.is_empty() => locked.push(LockedRange { from, to }),
                Happens::Nothing | Happens::Moves => {}
            }
        }
    }
    (tips, locked)
}

/// The modes of rows, each once, in words: those of a block that floats, where it does so in every row.
pub(super) fn modes(rows: &[CourseRow], naming: &Naming) -> Vec<CourseMode> {
    let mut modes: Vec<CourseMode> = Vec::new();
    for pattern in rows.iter().filter_map(|row| row.pattern.as_ref()) {
        if modes.iter().all(|known| known.pattern != *pattern) {
            let mut floating = rows.iter().filter(|row| row.pattern.as_ref() == Some(pattern));
            let floating = floating.try_fold(String::new(), |_, row| row.floating.clone());
            let words = floating.unwrap_or_else(|| naming.in_words(pattern));
            modes.push(CourseMode { pattern: pattern.clone(), words });
        }
    }
    modes
}

/// Where an effort passes through infinity inside a mode, as at a dead centre of what is driven: it changes
/// its sign between evenly spaced values without vanishing.
fn poles(
    (places, at): (&[(f64, Option<Efforts>)], impl Fn(f64) -> Option<Efforts>),
    [from, to]: [f64; 2],
    found: &ModesFound,
) -> Vec<BlowUp> {
    let mut poles = Vec::new();
    for mode in &found.existence.modes {
        let inside = places.iter().filter(|(value, _)| mode.from.at < *value && *value < mode.to.at);
        let known =
            inside.filter_map(|(value, efforts)| Some((*value, efforts.as_ref()?.of(&mode.pattern)?)));
        let known: Vec<(f64, Vec<f64>)> = known.collect();
        for pair in known.windows(2) {
            let effort = |drive: usize, value: f64| Some(at(value)?.of(&mode.pattern)?[drive]);
            let ends = [pair[0].0, pair[1].0];
            let pole = |drive: usize| {
                pole([(ends[0], pair[0].1[drive]), (ends[1], pair[1].1[drive])], |value| effort(drive, value))
            };
            let places: Vec<Option<f64>> = (0..pair[0].1.len()).map(pole).collect();
            let Some(place) = places.iter().flatten().next().copied() else { continue };
            // A change of sign within rounding of zero is at zero.
            let place = if place.abs() <= ROUNDING * (to - from) { 0.0 } else { place };
            let sign = |values: &[f64]| -> Vec<i8> {
                let one = |(place, value): (&Option<f64>, &f64)| match place {
                    None => 0,
                    Some(_) if *value > 0.0 => 1,
                    Some(_) => -1,
                };
                places.iter().zip(values).map(one).collect()
            };
            for (side, efforts) in [(Approach::Below, &pair[0].1), (Approach::Above, &pair[1].1)] {
                let efforts = sign(efforts);
                poles.push(BlowUp {
                    at: place,
                    pattern: pattern(&mode.pattern),
                    side,
                    efforts,
                    contacts: Vec::new(),
                });
            }
        }
    }
    poles
}

/// Where a function changes its sign through infinity between two values; none where it does not, or
/// vanishes.
fn pole([low, high]: [(f64, f64); 2], function: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    if low.1 * high.1 >= 0.0 {
        return None;
    }
    let is_below = |middle: f64| match function(middle) {
        Some(value) if value != 0.0 => ControlFlow::Continue(value * low.1 > 0.0),
        Some(_) => ControlFlow::Break(None),
        None => ControlFlow::Break(Some(middle)),
    };
    let below = match bisect_until(low.0, high.0, is_below) {
        ControlFlow::Continue([below, _]) => below,
        ControlFlow::Break(pole) => return pole,
    };
    let greatest = low.1.abs().max(high.1.abs());
    (function(below)?.abs() > GROWTH * greatest).then_some(below)
}

/// Data from which the rows are made.
struct Tabulated<'c> {
    varied: &'c Varied,
    efforts: &'c dyn Fn(f64) -> Option<Efforts>,
    range: [f64; 2],
    found: &'c ModesFound,
    blow_ups: &'c [BlowUp],
    naming: &'c Naming,
    work: Work<'c>,
}

impl Tabulated<'_> {
    /// Evenly spaced values, and those of blow-ups.
    fn rows(&self, steps: usize) -> Vec<CourseRow> {
        let [from, to] = self.range;
        let room = SAME_ROW * (to - from);
        let is_free = |value: &f64| self.blow_ups.iter().all(|blow_up| (blow_up.at - value).abs() > room);
        // There one solution grows without bound, and others may go on.
        let goes_on = |row: &CourseRow| {
            let grows = |blow_up: &BlowUp| Some(&blow_up.pattern) == row.pattern.as_ref();
            row.efforts.is_some()
                && !self.blow_ups.iter().any(|one| (one.at - row.at).abs() <= room && grows(one))
        };
        let even = evenly(self.range, steps).map(|value| (self.rows_at(value), is_free(&value)));
        let rows =
            even.flat_map(|(rows, is_free)| rows.into_iter().filter(move |row| is_free || goes_on(row)));
        let rows = rows.collect();
        with_blow_ups(rows, self.blow_ups)
    }

    fn rows_at(&self, value: f64) -> Vec<CourseRow> {
        let Some(efforts) = (self.efforts)(value) else { return vec![nothing(value)] };
        let [from, to] = self.range;
        let is_same = |one: f64, other: f64| (one - other).abs() <= SAME_ROW * (to - from);
        let is_end = value == from || value == to;
        let present = self.found.existence.modes.iter().filter(|mode| {
            let within = mode.from.at < value && value < mode.to.at;
            within || is_end && (is_same(mode.from.at, value) || is_same(mode.to.at, value))
        });
        let present: Vec<&ModeInterval> = present.collect();
        // Rounded numbers do not tell whether modes on their boundaries are one solution, or infinitely many.
        if present.iter().any(|mode| efforts.is_on_boundary(&mode.pattern))
            && let Ok(report) = self.varied.solved(value, self.work)
            && report.status != Status::Unknown
        {
            return rows_of(value, state::efforts(&report, &efforts.velocities));
        }
        let row = |pattern: String, verdict: Verdict, of: Vec<f64>, floating: Option<String>| {
            let (power, efficiency) = efforts.power(&of);
            CourseRow {
                at: value,
                pattern: Some(pattern),
                attainability: Some(verdict),
                grows: vec![0; of.len()],
                efforts: Some(of),
                frictionless: Some(efforts.frictionless.clone()),
                power: Some(power),
                efficiency: Some(efficiency),
                range: None,
                floating,
            }
        };
        let state = StateAt::new(self.varied, value).ok();
        let of_mode = |mode: &ModeInterval| {
            let verdict = state.as_ref().map_or(Verdict::NotComputed, |state| state.verdict(&mode.pattern));
            let floating = self.floating(&efforts, &mode.pattern);
            Some(row(pattern(&mode.pattern), verdict, efforts.of(&mode.pattern)?, floating))
        };
        let pressed = present.into_iter().filter_map(of_mode);
        let between_faces = self.varied.states_between_faces(value, 1.0, None, self.work);
        let between_faces = between_faces.into_iter().map(|state| {
            let of_drives = state.drives.iter().map(|drive| drive.effort + 0.0).collect();
            row(state.pattern, state.attainability.verdict, of_drives, None)
        });
        let rows: Vec<CourseRow> = pressed.chain(between_faces).collect();
        // Where modes end and others begin there is one state, which is on the boundary of each.
        let ends_here = |end: &&ModeEnd| {
            let is_boundary = matches!(end.cause, EndCause::SideChange(_) | EndCause::OutputBound(_));
            is_boundary && is_same(end.at, value)
        };
        let boundary = || {
            let ended = |mode: &&ModeInterval| [&mode.from, &mode.to].iter().any(ends_here);
            of_mode(self.found.existence.modes.iter().find(ended)?)
        };
        if let Some(row) = rows.is_empty().then(boundary).flatten() {
            return vec![row];
        }
        if rows.is_empty() {
            return vec![CourseRow { frictionless: Some(efforts.frictionless), ..nothing(value) }];
        }
        rows
    }

    /// The contact modes in words, if a block floats within its play: where contacts share no load, they are open.
    fn floating(&self, efforts: &Efforts, mode: &[ContactState]) -> Option<String> {
        let forces = efforts.normal_forces(mode)?;
        let floats = |k: usize| efforts.mechanism.excess.shares(ContactId(k)) && forces[k] == 0.0;
        let told = pattern(mode);
        let told = told.chars().enumerate().map(|(k, sign)| if floats(k) { '0' } else { sign });
        let told: String = told.collect();
        (0..mode.len()).any(floats).then(|| self.naming.in_words(&told))
    }
}

/// Rows with those at which efforts grow without bound among them, in order.
pub(super) fn with_blow_ups(mut rows: Vec<CourseRow>, blow_ups: &[BlowUp]) -> Vec<CourseRow> {
    rows.extend(blow_ups.iter().map(|blow_up| CourseRow {
        at: blow_up.at,
        pattern: Some(blow_up.pattern.clone()),
        grows: blow_up.efforts.clone(),
        ..nothing(blow_up.at)
    }));
    rows.sort_by(|one, other| one.at.total_cmp(&other.at));
    rows
}

/// The rows of a value with all that is known there: of infinitely many solutions one, then each other one.
pub(super) fn rows_of(value: f64, all: AllEfforts) -> Vec<CourseRow> {
    let AllEfforts { solutions, range, are_unknown, frictionless } = all;
    let frictionless = Some(frictionless.efforts).filter(|_| !are_unknown);
    let row = |solution: DriveSolution| CourseRow {
        at: value,
        floating: solution.floats.then(|| joints_in_words(&solution.joints)),
        pattern: Some(solution.pattern),
        attainability: Some(solution.attainability),
        grows: vec![0; solution.efforts.len()],
        efforts: Some(solution.efforts),
        frictionless: frictionless.clone(),
        power: Some(solution.power),
        efficiency: Some(solution.efficiency),
        range: None,
    };
    let range = (range.is_some() || solutions.is_empty()).then(|| CourseRow {
        frictionless: frictionless.clone(),
        range,
        ..nothing(value)
    });
    range.into_iter().chain(solutions.into_iter().map(row)).collect()
}

/// A row of a value at which nothing is known.
pub(super) fn nothing(value: f64) -> CourseRow {
    CourseRow { at: value, ..CourseRow::default() }
}
