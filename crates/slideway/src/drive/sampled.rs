//! The efforts over a parameter or a coordinate with friction in hinges, or where contacts stand still while the
//! rest moves: each row is solved by itself, and where the number of solutions changes, as about a dead centre,
//! is sought between evenly spaced values.

use super::course::{Guarantee, STEPS, modes, nothing, rows_of, with_blow_ups};
use super::efforts::{grows, velocities};
use super::report::{Approach, BlowUp, CourseDirection, CourseRow, DriveSolution, LockedRange, Sense};
use super::state::{self, AllEfforts};
use crate::fault::Faults;
use crate::limits::{Naming, Varied};
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::progress::{Progress, Work};
use crate::report::{SolveReport, Status};
use crate::scan::{bisect_until, evenly, samples};
use crate::solve::{LastSolution, SolveOptions, Stages, Trail, block_states, solve_in};
use std::ops::ControlFlow;

/// How near to an end growth is judged, as fractions of the range.
const NEAR: [f64; 2] = [1e-4, 1e-6];

/// Says what the search can miss.
fn guarantee() -> Guarantee {
    let words = format!(
        "Every row is solved by itself, and so are {} evenly spaced values. Where the number of solutions differs between two of them, the change is found by bisection. What begins and ends between two of these values is missed.",
        STEPS + 1
    );
    Guarantee { sampled: true, words }
}

/// The efforts in one direction of motion, and what can be missed.
///
/// # Errors
/// A value in the middle of the range that `solve` refuses, if it refuses all.
pub(super) fn direction(
    varied: &Varied,
    (range, steps): ([f64; 2], usize),
    direction: Sense,
    work: Work<'_>,
) -> Result<(Guarantee, CourseDirection), Faults> {
    let course = Sampled { varied, range, work };
    let rows = samples(evenly(range, steps), work.part(0, 2), |value, _| course.rows_at(value));
    let rows: Vec<CourseRow> = rows.into_iter().flat_map(|row| row.found).collect();
    if rows.iter().all(|row| row.frictionless.is_none()) {
        course.at(f64::midpoint(range[0], range[1]))?;
    }
    let Changes { locked, others } = course.changes(work.part(1, 2));
    let sides = |at: f64| [(at, -1.0, Approach::Below), (at, 1.0, Approach::Above)];
    let of_locked = locked.iter().flat_map(|locked| [sides(locked.from)[0], sides(locked.to)[1]]);
    let mut blow_ups: Vec<BlowUp> = of_locked
        .chain(others.iter().flat_map(|&at| sides(at)))
        .filter_map(|approached| course.blow_up(approached))
        .collect();
    blow_ups.sort_by(|one, other| one.at.total_cmp(&other.at));
    let rows = with_blow_ups(rows, &blow_ups);
    let modes = modes(&rows, &Naming::new(varied.model())?);
    let without_mode_problem = Vec::new();
    Ok((
        guarantee(),
        CourseDirection {
            direction,
            rows,
            modes,
            blow_ups,
            peaks: Vec::new(),
            tips: Vec::new(),
            locked,
            without_mode_problem,
        },
    ))
}

/// Where the number of solutions changes.
#[derive(Default)]
struct Changes {
    /// The ranges without a solution.
    locked: Vec<LockedRange>,
    /// Changes from some solutions to another number of them.
    others: Vec<f64>,
}

struct Sampled<'c> {
    varied: &'c Varied,
    range: [f64; 2],
    work: Work<'c>,
}

impl Sampled<'_> {
    /// The efforts of all solutions at a value, and those without friction.
    ///
    /// # Errors
    /// Whatever `solve` refuses there.
    fn at(&self, value: f64) -> Result<AllEfforts, Faults> {
        let model = self.varied.model_at(value)?;
        let stages = Stages::of_any_model(&model)?;
        let report = self.solved(&model, &stages)?;
        Ok(state::efforts(&report, &velocities(&stages)))
    }

    fn solved(&self, model: &Model, stages: &Stages) -> Result<SolveReport, Faults> {
        let mut goes_on = |_: &Progress| self.work.flow();
        solve_in(model, stages, &SolveOptions::default(), &mut goes_on)
    }

    fn rows_at(&self, value: f64) -> Vec<CourseRow> {
        self.at(value).map_or_else(|_| vec![nothing(value)], |all| rows_of(value, all))
    }

    /// How many solutions there are at a value; none where there is no answer.
    fn number(&self, value: f64, before: &mut (Trail, LastSolution)) -> Option<usize> {
        let model = self.varied.model_at(value).ok()?;
        let stages = Stages::along(&mut before.0, Mechanism::new(&model).ok()?).ok()?;
        if stages.standing.is_empty() && !model.has_guided_sliders() {
            let mut goes_on = |_: &Progress| self.work.flow();
            let found = block_states(
                (stages.data(), &stages.configuration),
                stages.accuracy,
                &mut before.1,
                &mut goes_on,
            )
            .ok()?;
            if let Some(states) = found {
                return Some(states.len());
            }
        }
        let report = self.solved(&model, &stages).ok()?;
        match report.status {
            Status::Unknown => None,
            Status::None => Some(0),
            // A state in a preload gap, or a continuum, does not lock either.
            _ => Some((report.solutions.len() + report.preload_gap_states.len()).max(1)),
        }
    }

    /// Where the number of solutions changes.
    fn changes(&self, work: Work<'_>) -> Changes {
        let mut before = (Trail::default(), LastSolution::default());
        let mut changes = Changes::default();
        let mut open: Option<f64> = None;
        let mut last: Option<(f64, usize)> = None;
        for (index, value) in evenly(self.range, STEPS).enumerate() {
            if work.piece("values", index, STEPS + 1).is_break() {
                break;
            }
            let number = self.number(value, &mut before);
            match (last, number) {
                (Some((known, was)), Some(is)) if was != is => {
                    let at = self.change([known, value], is, &mut before);
                    match (was, is) {
                        (_, 0) => open = Some(at),
                        (0, _) => {
                            changes.locked.extend(open.take().map(|from| LockedRange { from, to: at }));
                        }
                        _ => changes.others.push(at),
                    }
                }
                (None, Some(0)) => open = Some(value),
                (Some((known, 0)), None) => {
                    changes.locked.extend(open.take().map(|from| LockedRange { from, to: known }));
                }
                _ => {}
            }
            last = number.map(|number| (value, number));
        }
        changes.locked.extend(open.map(|from| LockedRange { from, to: self.range[1] }));
        changes
    }

    /// Where the number of solutions changes between two values; `after` is that at the second.
    fn change(&self, [low, high]: [f64; 2], after: usize, before: &mut (Trail, LastSolution)) -> f64 {
        let has_changed = |middle: f64| match self.number(middle, before) {
            Some(is) => ControlFlow::Continue(is == after),
            None => ControlFlow::Break(middle),
        };
        match bisect_until(high, low, has_changed) {
            ControlFlow::Continue([high, low]) => f64::midpoint(low, high),
            ControlFlow::Break(middle) => middle,
        }
    }

    /// The solution whose efforts grow without bound towards a value from one side.
    fn blow_up(&self, (at, sense, side): (f64, f64, Approach)) -> Option<BlowUp> {
        let [from, to] = self.range;
        if at <= from || to <= at {
            return None;
        }
        let [far, close] = NEAR.map(|share| self.at(at + sense * share * (to - from)).ok());
        let (far, close) = (far?.solutions, close?.solutions);
        let growing = |solution: &DriveSolution| {
            // Of several solutions of a mode only one has grown beyond all that they were.
            let before = far.iter().filter(|other| other.pattern == solution.pattern);
            let greatest = before
                .map(|other| other.efforts.iter().map(|effort| effort.abs()).collect::<Vec<_>>())
                .reduce(|one, other| one.iter().zip(&other).map(|(a, b)| a.max(*b)).collect())?;
            let efforts = grows(&greatest, &solution.efforts);
            let any = efforts.iter().any(|sign| *sign != 0);
            any.then(|| BlowUp { at, pattern: solution.pattern.clone(), side, efforts, contacts: Vec::new() })
        };
        close.iter().find_map(growing)
    }
}
