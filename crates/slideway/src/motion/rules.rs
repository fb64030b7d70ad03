//! What the simulation asks at an event: how the motion can go on.

use super::phase::Phase;
use crate::configuration::{Configuration, Velocity};
use crate::fault::Faults;
use crate::mechanism::Mechanism;

/// A mechanism at the instant of an event.
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its state.
    pub configuration: &'a Configuration,
    /// For each sliding joint, whether its sliding velocity is zero.
    pub stopped: &'a [bool],
    /// The phase that has just ended; nothing at the start and after an impulse.
    pub previous: Option<&'a Phase>,
}

/// A phase in which the motion can go on.
#[derive(Debug, Clone, PartialEq)]
pub struct Successor {
    /// The phase.
    pub phase: Phase,
    /// Whether a real mechanism can take it (theory, section 7), in words; empty where that was not asked.
    pub verdict: String,
    /// Whether it continues the present motion without a jump of forces.
    pub continues: bool,
}

/// An impulse that ends a dynamic jam.
#[derive(Debug, Clone, PartialEq)]
pub struct Jam {
    /// The velocities after it.
    pub velocities: Vec<Velocity>,
    /// The kinetic energy that is lost (J).
    pub energy_lost: f64,
}

/// Decides how a motion goes on (theory, section 8).
pub trait Decisions {
    /// The phases in which the motion can go on, the one to be taken first; none if there is none.
    ///
    /// # Errors
    /// Whatever keeps the forces at the instant from being computed.
    fn successors(&mut self, instant: &Instant<'_>) -> Result<Vec<Successor>, Faults>;

    /// The impulse of a mechanism that cannot go on moving.
    ///
    /// # Errors
    /// Whatever keeps the impulse from being computed.
    fn jam(&mut self, instant: &Instant<'_>) -> Result<Jam, Faults>;

    /// At least zero while the joints that stick in the phase can stick.
    fn sticking_margin(&mut self, mechanism: &Mechanism, configuration: &Configuration, phase: &Phase)
    -> f64;
}
