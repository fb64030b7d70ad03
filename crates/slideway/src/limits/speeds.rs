//! Changes of the speeds of the coordinates along each mode.
//!
//! Between two places at which an acceleration changes its sign there is one answer, which the certified
//! solution in the middle gives. Where modes were found from zeros of determinants these places are zeros of
//! the accelerations, found likewise; elsewhere they are bisected between values that were tried. With
//! friction in hinges the solution is the one whose forces are those of the branch.

use super::closed_form::value_at;
use super::found::{Method, ModesFound};
use super::report::SpeedLimits;
use super::varied::Varied;
use crate::modes::branches::{Branch, BranchForces};
use crate::modes::existence::{ModeInterval, ModeProblemLine};
use crate::progress::Work;
use crate::report::{Solution, SpeedChange};
use crate::scan::bisect;
use crate::solve::{Stages, pattern};

/// For each mode what becomes of the speed of each coordinate that no drive moves, from value to value; none
/// from where the work is to end.
pub(super) fn speeds(varied: &Varied, found: &ModesFound, work: Work<'_>) -> Vec<Vec<SpeedLimits>> {
    let model = varied.model();
    let free: Vec<usize> = (0..model.coordinates.len()).filter(|&index| model.is_free(index)).collect();
    let modes = found.existence.modes.iter().enumerate();
    let all = found.existence.modes.len();
    let of_mode = |(index, mode): (usize, &ModeInterval)| {
        let branch = found.branches.get(index);
        let along = Along { varied, found, mode, branch, work: work.part(index, all) };
        free.iter().flat_map(|&coordinate| along.speeds(coordinate)).collect()
    };
    modes.map(of_mode).collect()
}

/// A mode over its interval.
struct Along<'a> {
    varied: &'a Varied,
    found: &'a ModesFound,
    mode: &'a ModeInterval,
    /// Its branch, with friction in hinges.
    branch: Option<&'a Branch>,
    work: Work<'a>,
}

impl Along<'_> {
    /// Returns the change of the speed of a coordinate, from value to value.
    fn speeds(&self, coordinate: usize) -> Vec<SpeedLimits> {
        let name = &self.varied.model().coordinates[coordinate].name;
        let cuts = match self.found.method {
            Method::Bracketing | Method::Hinge => self.bisected(coordinate),
            Method::ClosedForm | Method::Same { .. } => self.zeros(coordinate),
        };
        let ends = [vec![self.mode.from.at], cuts, vec![self.mode.to.at]].concat();
        let mut speeds: Vec<SpeedLimits> = Vec::new();
        for pair in ends.windows(2).filter(|pair| pair[0] < pair[1]) {
            if self.work.is_over() {
                break;
            }
            let (speed, friction_exceeds_loads) = self.speed(coordinate, f64::midpoint(pair[0], pair[1]));
            match speeds.last_mut() {
                Some(last) if last.speed == speed => {
                    last.to = pair[1];
                    last.friction_exceeds_loads |= friction_exceeds_loads;
                }
                _ => speeds.push(SpeedLimits {
                    coordinate: name.to_string(),
                    from: pair[0],
                    to: pair[1],
                    speed,
                    friction_exceeds_loads,
                }),
            }
        }
        speeds
    }

    /// Returns the change of the speed in the certified solution at a value, and whether friction takes more
    /// there than the loads give.
    fn speed(&self, coordinate: usize, at: f64) -> (SpeedChange, bool) {
        let sought = pattern(&self.mode.pattern);
        let found = self.varied.solved(at, self.work).ok();
        let states =
            found.iter().flat_map(|report| report.solutions.iter().chain(&report.preload_gap_states));
        let mut states = states.filter(|state| state.patterns.contains(&sought) || state.pattern == sought);
        let state = match self.branch {
            None => states.next(),
            Some(branch) => self.varied.branch_forces(at, &self.found.circles, branch).and_then(|forces| {
                let distance = |state: &&Solution| distance(state, &forces);
                states.min_by(|one, other| distance(one).total_cmp(&distance(other)))
            }),
        };
        let speed = state.and_then(|state| state.coordinates[coordinate].speed);
        (speed.unwrap_or(SpeedChange::Undecided), state.is_some_and(|state| state.friction_exceeds_loads))
    }

    /// The zeros of the acceleration inside the interval, on the lines between mode problems on which the
    /// modes were found.
    fn zeros(&self, coordinate: usize) -> Vec<f64> {
        let (from, to) = (self.mode.from.at, self.mode.to.at);
        let mut cuts = Vec::new();
        for piece in self.found.tried.chunks_exact(2) {
            let [start, end] =
                [piece[0], piece[1]].map(|at| self.varied.at(at, Stages::parts_with_accelerations));
            let (Ok(start), Ok(end)) = (start, end) else { continue };
            let line = start.line_to(&end);
            let zeros = line.output_zeros(&self.mode.pattern, start.couples() + coordinate, [0.0, 1.0]);
            cuts.extend(zeros.unwrap_or_default().into_iter().map(|t| value_at([piece[0], piece[1]], t)));
            cuts.push(piece[1]);
        }
        cuts.retain(|&at| from < at && at < to);
        cuts
    }

    /// Where the acceleration changes its sign between values that were tried. It is zero over a stretch if it
    /// is zero within rounding at two values on end; one alone is near a change of sign.
    fn bisected(&self, coordinate: usize) -> Vec<f64> {
        let (from, to) = (self.mode.from.at, self.mode.to.at);
        let inside = self.found.tried.iter().copied().filter(|&at| from < at && at < to);
        let all: Vec<(f64, Option<i8>)> = inside.map(|at| (at, self.sign(coordinate, at))).collect();
        let is_zero =
            |index: Option<usize>| index.and_then(|index| all.get(index)).is_some_and(|one| one.1 == Some(0));
        let is_alone = |k: usize| is_zero(Some(k)) && !is_zero(k.checked_sub(1)) && !is_zero(Some(k + 1));
        let tried: Vec<_> = (0..all.len()).filter(|&k| !is_alone(k)).map(|k| all[k]).collect();
        let change = |pair: &[(f64, Option<i8>)]| {
            let [(inside, one), (outside, other)] = [pair[0], pair[1]];
            let is_inside = |at: f64| match (one, other) {
                (Some(one @ (1 | -1)), Some(1 | -1)) => {
                    self.acceleration(coordinate, at).is_some_and(|value| value * f64::from(one) > 0.0)
                }
                _ => self.sign(coordinate, at) == one,
            };
            (one != other).then(|| bisect(inside, outside, is_inside)[0])
        };
        tried.windows(2).filter_map(change).collect()
    }

    /// The sign of the acceleration at a value, 0 where it is zero within rounding.
    fn sign(&self, coordinate: usize, at: f64) -> Option<i8> {
        if self.branch.is_some() {
            let value = self.acceleration(coordinate, at)?;
            return Some(i8::from(value > 0.0) - i8::from(value < 0.0));
        }
        let (line, output) = self.line(coordinate, at)?;
        line.output_sign(&self.mode.pattern, output, 0.0)
    }

    fn acceleration(&self, coordinate: usize, at: f64) -> Option<f64> {
        if let Some(branch) = self.branch {
            let accelerations = self.varied.branch_accelerations(at, &self.found.circles, branch)?;
            return accelerations.get(coordinate).copied();
        }
        let (line, output) = self.line(coordinate, at)?;
        Some(line.unknowns(&self.mode.pattern, 0.0)?[line.contacts() + output])
    }

    /// The mode problem at a value, and the output that the acceleration is.
    fn line(&self, coordinate: usize, at: f64) -> Option<(ModeProblemLine, usize)> {
        if self.work.is_over() {
            return None;
        }
        let parts = self.varied.at(at, Stages::parts_with_accelerations).ok()?;
        Some((parts.line_to(&parts), parts.couples() + coordinate))
    }
}

/// How far a solution is from forces of the same mode.
fn distance(state: &Solution, forces: &BranchForces) -> f64 {
    let normal =
        state.contacts.iter().zip(&forces.normal).map(|(contact, force)| contact.normal_force - force);
    let rough = state.hinges.iter().filter(|hinge| hinge.friction.is_some());
    let hinges = rough
        .zip(&forces.hinges)
        .flat_map(|(hinge, force)| [hinge.force[0] - force[0], hinge.force[1] - force[1]]);
    normal.chain(hinges).map(f64::abs).fold(0.0, f64::max)
}
