//! Where within a step something falls through zero.

use super::Smooth;
use crate::motion::decision::rules::Decisions;
use crate::motion::moving::equations::Failure;
use crate::motion::moving::root::{dip, falling_root};
use crate::motion::moving::stepper::{SAMPLES, within};
use crate::motion::moving::watch::{Needs, Watched};
use crate::pattern::phase::Phase;

/// Where the equations have no solution at a sample within a step, it is this part of the way nearer to the
/// one before.
const BESIDE: f64 = 0.1;
/// Part of a step within which zeros count as one event.
pub(super) const SAME_INSTANT: f64 = 1e-9;
/// Accuracy of a zero, as part of a step.
pub(super) const ROOT_TOLERANCE: f64 = 1e-13;
/// A function of the user that is below this multiple of its next value has just passed zero.
const USER_ZERO: f64 = 1e-9;

impl Smooth<'_, '_> {
    /// Takes down the values of all watched functions at the last evaluation, which was at this sample of the
    /// step.
    pub(super) fn watch_all(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        sample: usize,
    ) -> Result<(), Failure> {
        self.values[sample].clear();
        for index in 0..self.watch.list.len() {
            let value = self.value(self.watch.list[index], phase, decisions)?;
            self.values[sample].push(value);
        }
        Ok(())
    }

    /// The value of one watched function at the last evaluation.
    pub(super) fn value(
        &mut self,
        watched: Watched,
        phase: &Phase,
        decisions: &mut dyn Decisions,
    ) -> Result<f64, Failure> {
        let equations = &self.equations;
        if let Watched::Relation(switch) = watched {
            return Ok(self.switching.margin(&equations.configuration, switch));
        }
        if watched == Watched::HeldReactions {
            return self.room_of_held(phase, decisions);
        }
        let equations = &self.equations;
        if watched == Watched::Sticking {
            let configuration = &equations.configuration;
            let known = self.outlook.proven + self.least_step();
            let margin = match &mut self.hold {
                // It is known when it ends.
                Some(_) if self.holds_all && configuration.time <= known => return Ok(1.0),
                Some(hold) if self.holds_all => hold.margin(configuration.time),
                _ => {
                    let phase = equations.with_present_forces(phase);
                    decisions.sticking_margin(equations.mechanism, configuration, &phase)
                }
            };
            return margin.map_err(Failure::Loads);
        }
        self.watch.value(watched, phase, equations).map_err(|fault| Failure::Loads(fault.into()))
    }

    /// The first instant within the step at which something falls through zero, as a fraction, and all that
    /// does.
    pub(super) fn first_event(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        solution: StepSolution<'_>,
    ) -> Result<Option<(f64, Vec<Watched>)>, Failure> {
        let mut places = SAMPLES;
        let mut falls = Vec::new();
        for part in 0..SAMPLES.len() - 1 {
            if part < SAMPLES.len() - 2 {
                self.sample(phase, decisions, solution, (part + 1, &mut places))?;
            }
            falls = self.falls_between([places[part], places[part + 1]], part);
            if !falls.is_empty() {
                break;
            }
        }
        let until = falls.first().map_or(1.0, |fall| fall.ends[0]);
        if until > 0.0 && places == SAMPLES {
            self.add_dips(phase, decisions, solution, (until, &mut falls))?;
        }
        if falls.is_empty() {
            return Ok(None);
        }
        self.locate(phase, decisions, solution, &falls).map(Some)
    }

    /// Values of all watched functions at a sample within the step.
    fn sample(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        solution: StepSolution<'_>,
        (sample, places): (usize, &mut [f64; 4]),
    ) -> Result<(), Failure> {
        match self.evaluate_within(solution, places[sample], Needs::Forces) {
            // Exactly where the equations have no solution; a little before they have one.
            Err(Failure::Singular | Failure::Fold) => {
                places[sample] -= BESIDE * (places[sample] - places[sample - 1]);
                self.evaluate_within(solution, places[sample], Needs::Forces)?;
            }
            evaluated => evaluated?,
        }
        self.watch_all(phase, decisions, sample)
    }

    /// What has fallen from one sample of the step to the next.
    fn falls_between(&self, ends: [f64; 2], part: usize) -> Vec<Fall> {
        let one = |index: usize| {
            let values = [self.values[part][index], self.values[part + 1][index]];
            Fall { index, ends, values }
        };
        (0..self.watch.list.len()).map(one).filter(|fall| self.is_below(fall)).collect()
    }

    /// Adds what falls and rises again between two samples, before something else has fallen.
    fn add_dips(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        solution: StepSolution<'_>,
        (until, falls): (f64, &mut Vec<Fall>),
    ) -> Result<(), Failure> {
        for index in 0..self.watch.list.len() {
            let samples = std::array::from_fn(|sample| self.values[sample][index]);
            let Some(place) = dip(samples).filter(|place| *place < until) else { continue };
            let watched = self.watch.list[index];
            self.evaluate_within(solution, place, watched.needs())?;
            let value = self.value(watched, phase, decisions)?;
            let before = SAMPLES.iter().rposition(|fraction| *fraction < place).unwrap_or(0);
            let fall =
                Fall { index, ends: [SAMPLES[before], place], values: [self.values[before][index], value] };
            falls.extend(self.is_below(&fall).then_some(fall));
        }
        Ok(())
    }

    /// Whether a function is below zero at the end, beyond rounding where it was not above zero before.
    fn is_below(&self, fall: &Fall) -> bool {
        let [before, after] = fall.values;
        match self.watch.list[fall.index] {
            // It may be below zero; just behind one of its zeros it is zero within rounding.
            Watched::User(..) => return after <= 0.0 && before > USER_ZERO * after.abs(),
            // Just behind the end of its piece it is on the next one, and above zero: if it falls from zero,
            // however that was rounded, the step before has ended at the end of the piece.
            Watched::Relation(_) => return after < 0.0 && before > -USER_ZERO * after.abs(),
            _ => {}
        }
        let tolerance = self.watch.tolerance(self.watch.list[fall.index], &self.equations);
        if self.watch.list[fall.index] == Watched::Sticking {
            // What just reaches the limit sticks.
            return after < -tolerance && after < before;
        }
        if before > tolerance { after <= 0.0 } else { after < -tolerance && after < before }
    }

    /// The least of the zeros of what falls, and everything that vanishes there.
    fn locate(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
        solution: StepSolution<'_>,
        falls: &[Fall],
    ) -> Result<(f64, Vec<Watched>), Failure> {
        let mut zeros: Vec<(f64, Watched)> = Vec::with_capacity(falls.len());
        for &Fall { index, ends, values } in falls {
            let watched = self.watch.list[index];
            let first = zeros.iter().map(|(zero, _)| *zero).fold(f64::INFINITY, f64::min);
            let mut function = |fraction: f64| match self.evaluate_within(solution, fraction, watched.needs())
            {
                // Where the equations have no solution forces are beyond all bounds: not before the zero.
                Err(Failure::Singular | Failure::Fold) => Ok(0.0),
                evaluated => evaluated.and_then(|()| self.value(watched, phase, decisions)),
            };
            let same = first + SAME_INSTANT;
            if values[0] > 0.0 && same > ends[0] && same < ends[1] && function(same)? > 0.0 {
                // It falls later.
                continue;
            }
            let bracket = if values[0] > 0.0 {
                Some((ends, values))
            } else {
                rising_part(ends, values[1], &mut function)?
            };
            let zero = match bracket {
                Some((ends, values)) => falling_root(ends, values, ROOT_TOLERANCE, function)?,
                None => ends[0],
            };
            zeros.push((zero, watched));
        }
        let first = zeros.iter().map(|(zero, _)| *zero).fold(f64::INFINITY, f64::min);
        zeros.retain(|(zero, _)| *zero <= first + SAME_INSTANT);
        zeros.sort_by(|one, other| one.0.total_cmp(&other.0));
        Ok((first, zeros.into_iter().map(|(_, watched)| watched).collect()))
    }

    /// Puts the equations at a fraction of the step.
    pub(super) fn evaluate_within(
        &mut self,
        solution: StepSolution<'_>,
        fraction: f64,
        needs: Needs,
    ) -> Result<(), Failure> {
        within(solution.dense, fraction, &mut self.inside);
        let time = self.time + fraction * solution.length;
        // Standstill beside hinges that turn with friction depends on the directions of their forces.
        if needs == Needs::Forces || (needs == Needs::Standstill && self.equations.turns()) {
            self.equations.evaluate(time, &self.inside)
        } else {
            self.equations.place(time, &self.inside);
            Ok(())
        }
    }
}

/// The solution within a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepSolution<'d> {
    /// For [`within`].
    pub(super) dense: &'d [f64],
    /// Of the step (s).
    pub(super) length: f64,
}

/// A watched function that is below zero at the end of a part of a step.
#[derive(Debug, Clone, Copy)]
struct Fall {
    /// Its number in the list.
    index: usize,
    /// Where the part begins and ends, as fractions of the step.
    ends: [f64; 2],
    /// Its values there.
    values: [f64; 2],
}

/// Two places, and the values of a function there.
type Bracket = ([f64; 2], [f64; 2]);

/// A part of the way on which a function that begins with zero, or below it within rounding, and ends below
/// zero falls from above zero; none if it does not rise first.
fn rising_part(
    [left, mut right]: [f64; 2],
    mut at_right: f64,
    function: &mut impl FnMut(f64) -> Result<f64, Failure>,
) -> Result<Option<Bracket>, Failure> {
    while right - left > SAME_INSTANT {
        let middle = f64::midpoint(left, right);
        let value = function(middle)?;
        if value > 0.0 {
            return Ok(Some(([middle, right], [value, at_right])));
        }
        (right, at_right) = (middle, value);
    }
    Ok(None)
}
