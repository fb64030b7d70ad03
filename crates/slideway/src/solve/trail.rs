//! States one after another, each reached from those before it.

use crate::configuration::{Configuration, Follower};
use crate::fault::Faults;
use crate::kinetics::{Elimination, Influences, KineticEquations};
use crate::mechanism::Mechanism;

/// The states of the last points, from which the next one is reached.
#[derive(Debug, Default)]
pub(crate) struct Trail {
    follower: Follower,
    elimination: Elimination,
}

impl Trail {
    /// The configuration of a mechanism, and its answers to loads and to unit friction forces: from those of
    /// the last points if these are near.
    ///
    /// # Errors
    /// Whatever `solve` refuses, but for contacts at rest.
    pub(crate) fn state(&mut self, mechanism: &Mechanism) -> Result<(Configuration, Influences), Faults> {
        let configuration = self.follower.configuration(mechanism)?;
        let influences = match Influences::new(mechanism, &configuration, &mut self.elimination)? {
            Some(influences) => influences,
            None => KineticEquations::new(mechanism, &configuration)?.influences(),
        };
        Ok((configuration, influences))
    }
}
