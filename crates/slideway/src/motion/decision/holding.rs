//! Mechanisms that stand still: only their loads change.

use super::BOUNDARY;
use super::assessment::assess;
use super::instant::Instant;
use super::sticking::{ENOUGH, NONE};
use crate::configuration::Configuration;
use crate::expression::Values;
use crate::fault::Faults;
use crate::ids::FormulaId;
use crate::interval::Interval;
use crate::mechanism::Mechanism;
use crate::motion::Phase;
use crate::motion::root::first_fall;

/// Linear programs miss their optimum by no more than this.
const MISSED: f64 = 1e-10;
/// The most formulas of loads that are varied one by one; of more only the ends of a span are seen.
const MOST_CORNERS: usize = 8;

/// A mechanism without drives that stands still in a phase: equations and influence coefficients are computed once.
pub(crate) struct Holding<'m> {
    instant: Instant<'m>,
    /// With the sides of the last margin.
    phase: Phase,
    stopped: Vec<bool>,
    /// The mechanism with values of its loads, and the formulas that vary.
    loaded: Mechanism,
    varying: Vec<FormulaId>,
    parameters: Vec<Interval>,
}

impl<'m> Holding<'m> {
    /// A mechanism in the configuration in which it stays.
    ///
    /// # Errors
    /// As [`sticking_margin`](super::sticking_margin).
    pub(crate) fn new(
        mechanism: &'m Mechanism,
        configuration: &Configuration,
        phase: &Phase,
    ) -> Result<Self, Faults> {
        let instant = Instant::new(mechanism, configuration)?;
        instant.check(phase)?;
        let stopped = vec![false; instant.joints.len()];
        let values = mechanism.values(&[], &[], 0.0);
        let parameters = values.parameters.iter().map(|value| Interval::point(*value)).collect();
        let (loaded, varying) = (mechanism.clone(), mechanism.varying_loads());
        Ok(Self { instant, phase: phase.clone(), stopped, loaded, varying, parameters })
    }

    /// [`sticking_margin`](super::sticking_margin) at the time of this configuration; sides that have left enough at
    /// the last time are tried first.
    ///
    /// # Errors
    /// Loads without a value.
    #[cfg(test)]
    pub(crate) fn margin(&mut self, configuration: &Configuration) -> Result<f64, Faults> {
        self.loaded.fix_loads(&self.instant.mechanism.loads, &[]);
        self.margin_of(configuration, false)
    }

    /// The first time after that of a configuration, and at most `until`, at which the joints cannot stick any longer; it is
    /// proven that they can before, but for times at which rounding decides.
    ///
    /// For given sides of the contacts the margin is a concave function of the loads, as the greatest value of a linear
    /// program in which they stand on the right-hand side. So it is not negative within a box of loads if it is not at its
    /// corners, with the same sides. The box is that of the values of the formulas over a span of time.
    ///
    /// # Errors
    /// Loads without a value.
    pub(crate) fn slips(&mut self, configuration: &Configuration, until: f64) -> Result<Option<f64>, Faults> {
        if self.varying.is_empty() {
            return Ok(None);
        }
        let fixed = |values: &[f64]| values.iter().map(|value| Interval::point(*value)).collect::<Vec<_>>();
        let state = [fixed(&configuration.coordinates), fixed(&configuration.rates)];
        first_fall([configuration.time, until], |times| self.enclosed(configuration, &state, times))
    }

    /// Bounds of the margin over a span of time: of its least value from below, at a single time on both sides.
    fn enclosed(
        &mut self,
        configuration: &Configuration,
        [coordinates, rates]: &[Vec<Interval>; 2],
        time: Interval,
    ) -> Result<Interval, Faults> {
        let parameters = &self.parameters;
        let values = Values { parameters, coordinates, rates, time };
        let mechanism = self.instant.mechanism;
        let pieces = configuration.pieces.as_deref();
        let range = |id: &FormulaId| Some((*id, mechanism.formula_over(*id, &values, pieces)?));
        let ranges: Option<Vec<(FormulaId, Interval)>> = self.varying.iter().map(range).collect();
        let Some(ranges) = ranges else {
            if time.width() > 0.0 {
                return Ok(Interval::REAL_LINE);
            }
            // At a single time the fault is told.
            let mut there = configuration.clone();
            there.time = time.lower();
            self.loaded.fix_loads(&mechanism.loads, &[]);
            return Ok(Interval::around(self.margin_of(&there, false)?, MISSED));
        };
        let mut least = f64::INFINITY;
        for (number, corner) in corners(&ranges, time.width() == 0.0).into_iter().enumerate() {
            self.loaded.fix_loads(&mechanism.loads, &corner);
            least = least.min(self.margin_of(configuration, number > 0)?);
            if least < MISSED {
                break;
            }
        }
        Ok(Interval::around(least, MISSED))
    }

    /// The margin with the loads that are set, with the sides of the last margin alone or with those that leave most.
    fn margin_of(&mut self, configuration: &Configuration, same_sides: bool) -> Result<f64, Faults> {
        self.instant.change_loads(&self.loaded, configuration)?;
        let mut question = self.instant.question(&self.stopped);
        if same_sides {
            question.sides = self.phase.contacts.iter().map(|contact| vec![*contact]).collect();
        }
        let found = assess(&self.instant, &question, &self.phase, (BOUNDARY, ENOUGH)).ok().flatten();
        Ok(found.map_or(NONE, |assessment| {
            self.phase = assessment.phase;
            assessment.margin
        }))
    }
}

/// The corners of a box of values; of a single time its middle.
fn corners(ranges: &[(FormulaId, Interval)], is_point: bool) -> Vec<Vec<(FormulaId, f64)>> {
    if is_point {
        return vec![ranges.iter().map(|(id, range)| (*id, range.middle())).collect()];
    }
    let end = |upper: bool, range: Interval| if upper { range.upper() } else { range.lower() };
    if ranges.len() > MOST_CORNERS {
        let all = |upper: bool| ranges.iter().map(|(id, range)| (*id, end(upper, *range))).collect();
        return vec![all(false), all(true)];
    }
    let corner = |corner: usize| {
        let ranges = ranges.iter().enumerate();
        ranges.map(|(bit, (id, range))| (*id, end(corner >> bit & 1 == 1, *range))).collect()
    };
    (0..1 << ranges.len()).map(corner).collect()
}
