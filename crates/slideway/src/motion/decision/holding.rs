//! Mechanisms that stand still: only their loads change.

use super::BOUNDARY;
use super::assessment::assess;
use super::instant::Instant;
use super::sticking::{ENOUGH, NONE};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::motion::Phase;

/// A mechanism without drives that stands still in a phase: equations and influence coefficients are computed once.
pub(crate) struct Holding<'m> {
    instant: Instant<'m>,
    /// With the sides of the last margin.
    phase: Phase,
    stopped: Vec<bool>,
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
        Ok(Self { instant, phase: phase.clone(), stopped })
    }

    /// [`sticking_margin`](super::sticking_margin) at the time of this configuration; sides that have left enough at
    /// the last time are tried first.
    ///
    /// # Errors
    /// Loads without a value.
    pub(crate) fn margin(&mut self, configuration: &Configuration) -> Result<f64, Faults> {
        self.instant.change_loads(configuration)?;
        let question = self.instant.question(&self.stopped, Some(&self.phase));
        let found = assess(&self.instant, &question, &self.phase, (BOUNDARY, ENOUGH)).ok().flatten();
        Ok(found.map_or(NONE, |assessment| {
            self.phase = assessment.phase;
            assessment.margin
        }))
    }
}
