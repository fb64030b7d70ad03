//! Numbers of solutions where modes are on their boundaries throughout.
//!
//! Where a condition of a mode is an equality for all values, as for rigid guides of equal play and without any load,
//! rounded numbers do not tell which modes are one solution, and whether there are infinitely many between them. Between
//! the ends of modes that is the same everywhere: the certified search tells it at one value.

use super::found::{Elsewhere, Knowledge, ModesFound, PATTERNS, cells_within};
use super::varied::Varied;
use crate::modes::existence::{CountInterval, EndCause, ExistenceOptions, ModeInterval};
use crate::progress::Work;
use crate::report::{Solution, SolveReport, Status};
use crate::solve::pattern;
use nalgebra::DVector;

/// Counts solutions anew where modes are on their boundaries, and leaves out modes that are a solution of another mode
/// everywhere. States with a normal force above `greatest` do not count.
pub(super) fn recount(varied: &Varied, greatest: Option<f64>, found: &mut ModesFound, work: Work<'_>) {
    let recount = Recount { varied, greatest, work };
    let mut copies: Vec<Option<bool>> = vec![None; found.existence.modes.len()];
    let mut counts: Vec<CountInterval> = Vec::new();
    let mut all_known: Vec<Knowledge> = Vec::new();
    for (interval, known) in found.counts.iter().zip(&found.known) {
        let whole = [interval.from, interval.to];
        let same = |next, kept| found.same_ends.are_one(kept, next);
        for cell in cells_within(&found.existence.modes, whole, same) {
            let at = f64::midpoint(cell[0], cell[1]);
            let is_present = |mode: &ModeInterval| mode.from.at < at && at < mode.to.at;
            let modes = &found.existence.modes;
            let present: Vec<usize> = (0..modes.len()).filter(|&index| is_present(&modes[index])).collect();
            let there: Vec<&ModeInterval> = present.iter().map(|&index| &modes[index]).collect();
            let (count, known) = match recount.at(at, &there) {
                None => (CountInterval { from: cell[0], to: cell[1], ..*interval }, known.clone()),
                Some(Certified { numbers, copied, is_decided }) => {
                    for (&index, copied) in present.iter().zip(copied) {
                        copies[index] = Some(copies[index].unwrap_or(true) && copied);
                    }
                    let elsewhere = if is_decided { known.elsewhere } else { Elsewhere::Contradicted };
                    let count = CountInterval { from: cell[0], to: cell[1], ..numbers };
                    (count, Knowledge { elsewhere, ..known.clone() })
                }
            };
            match counts.last_mut().zip(all_known.last()) {
                Some((last, before)) if last.to == count.from && last.is_like(&count) && *before == known => {
                    last.to = count.to;
                }
                _ => {
                    counts.push(count);
                    all_known.push(known);
                }
            }
        }
    }
    (found.counts, found.known) = (counts, all_known);
    let mut copies = copies.into_iter();
    found.existence.modes.retain(|_| copies.next().flatten() != Some(true));
}

struct Recount<'r> {
    varied: &'r Varied,
    greatest: Option<f64>,
    work: Work<'r>,
}

/// Result of the certified search at a value.
struct Certified {
    numbers: CountInterval,
    /// Whether each of the modes there is a solution that is reported with another mode.
    copied: Vec<bool>,
    is_decided: bool,
}

impl Recount<'_> {
    /// Counts the solutions at a value by the certified search. Returns `None` if all of these modes are off
    /// their boundaries.
    fn at(&self, at: f64, modes: &[&ModeInterval]) -> Option<Certified> {
        let parts = self.varied.parts(at).ok()?;
        let line = parts.line_to(&parts);
        let options =
            ExistenceOptions { range: [0.0, 1.0], greatest_normal_force: self.greatest, patterns: PATTERNS };
        let on_boundary: Vec<bool> =
            modes.iter().map(|mode| line.cause_at(&mode.pattern, 0.0, &options) != EndCause::Range).collect();
        // States with a guided slider between its faces are counted by themselves.
        if !on_boundary.contains(&true) || !parts.with_free_faces().is_empty() {
            return None;
        }
        let report = self.varied.solved(at, self.work).ok()?;
        let greatest = self.greatest.unwrap_or(f64::INFINITY);
        let counts =
            |state: &&Solution| state.contacts.iter().all(|contact| contact.normal_force.abs() <= greatest);
        let [solutions, gaps] = [&report.solutions, &report.preload_gap_states]
            .map(|states| states.iter().filter(counts).collect::<Vec<&Solution>>());
        let told: Vec<&str> = solutions.iter().chain(&gaps).map(|state| state.pattern.as_str()).collect();
        let is_told = |index: usize| told.contains(&pattern(&modes[index].pattern).as_str());
        let forces: Vec<Option<DVector<f64>>> =
            modes.iter().map(|mode| line.normal_force(&mode.pattern, 0.0)).collect();
        let is_same = |one: usize, other: usize| match (&forces[one], &forces[other]) {
            (Some(force), Some(others)) => {
                parts.is_same((&modes[one].pattern, force), (&modes[other].pattern, others))
            }
            _ => false,
        };
        // Of modes with the same solution that stays which the search tells, else the first.
        let precedes = |other: usize, one: usize| (!is_told(other), other) < (!is_told(one), one);
        let copied = |one: usize| {
            on_boundary[one] && (0..modes.len()).any(|other| precedes(other, one) && is_same(one, other))
        };
        Some(Certified {
            numbers: CountInterval {
                from: at,
                to: at,
                solutions: solutions.len(),
                gap_states: gaps.len(),
                continuum: report.status == Status::Continuum,
            },
            copied: (0..modes.len()).map(copied).collect(),
            is_decided: is_decided(&report, self.greatest),
        })
    }
}

/// Whether the numbers are those of all states; those of a continuum within greatest normal forces are known if all of it
/// is within them.
fn is_decided(report: &SolveReport, greatest: Option<f64>) -> bool {
    let within = |greatest: f64| {
        let vertices = report.continua.iter().flat_map(|continuum| continuum.vertices.iter().flatten());
        let is_bounded = report.continua.iter().all(|continuum| continuum.directions.is_empty());
        is_bounded && vertices.map(|force| force.abs()).all(|force| force <= greatest)
    };
    report.status != Status::Unknown && !report.partial && greatest.is_none_or(within)
}
