//! The limit of normal forces, where they are those of the equations and where joints stick.

use super::Smooth;
use crate::ids::ContactId;
use crate::motion::decision::rules::Decisions;
use crate::motion::moving::cause::Cause;
use crate::motion::moving::equations::{Equations, Failure};
use crate::motion::moving::watch::Watched;
use crate::pattern::phase::Phase;

impl Smooth<'_, '_> {
    /// The contacts whose normal forces are beyond the limit where the phase begins.
    ///
    /// # Errors
    /// Whatever keeps normal forces of joints that stick from being computed.
    pub(in crate::motion) fn exceeded_reactions(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
    ) -> Result<Vec<Cause>, Failure> {
        let values = self.watch.list.iter().zip(&self.values[0]);
        let limits =
            |watched: &Watched| matches!(watched, Watched::ReactionLimit(_) | Watched::HeldReactions);
        let exceeded: Vec<Watched> = values
            .filter(|(watched, value)| limits(watched) && **value <= 0.0)
            .map(|(watched, _)| *watched)
            .collect();
        let mut causes = self.causes(&exceeded);
        causes.extend(self.held_causes(&exceeded, phase, decisions)?);
        Ok(causes)
    }

    /// The contacts with the greatest of the normal forces that statics determines while joints stick, if
    /// these are what has reached its limit.
    pub(super) fn held_causes(
        &mut self,
        watched: &[Watched],
        phase: &Phase,
        decisions: &mut dyn Decisions,
    ) -> Result<Vec<Cause>, Failure> {
        if !watched.contains(&Watched::HeldReactions) {
            return Ok(Vec::new());
        }
        self.equations.place(self.time, &self.state);
        let forces = self.held_forces(phase, decisions)?;
        let greatest = forces.iter().map(|(_, force)| *force).fold(0.0, f64::max);
        let tolerance = self.watch.tolerance(Watched::HeldReactions, &self.equations);
        let reached = forces.into_iter().filter(|(_, force)| *force >= greatest - tolerance);
        Ok(reached.map(|(contact, _)| Cause::ReactionLimit(contact)).collect())
    }

    /// The magnitudes of the normal forces that statics determines while joints stick (N), at the last
    /// evaluation.
    fn held_forces(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
    ) -> Result<Vec<(ContactId, f64)>, Failure> {
        let phase = self.equations.with_present_forces(phase);
        let Equations { mechanism, configuration, .. } = &self.equations;
        let forces = decisions.normal_forces(mechanism, configuration, &phase).map_err(Failure::Loads)?;
        let mut known = Vec::new();
        for (k, force) in forces.into_iter().enumerate() {
            match force {
                Some(force) => known.push((ContactId(k), force.abs())),
                None => _ = self.undetermined.insert(ContactId(k)),
            }
        }
        Ok(known)
    }

    /// How much the greatest of them may still grow (N).
    pub(super) fn room_of_held(
        &mut self,
        phase: &Phase,
        decisions: &mut dyn Decisions,
    ) -> Result<f64, Failure> {
        let forces = self.held_forces(phase, decisions)?.into_iter().map(|(_, force)| force);
        Ok(self.watch.reaction_limit() - forces.fold(0.0, f64::max))
    }
}
