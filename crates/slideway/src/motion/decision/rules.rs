//! What the simulation asks at an event: how the motion can go on.

use crate::configuration::{Configuration, Velocity};
use crate::fault::Faults;
use crate::ids::{ContactId, JointId};
use crate::mechanism::Mechanism;
use crate::pattern::Phase;
use crate::report::Verdict;

/// A mechanism at the instant of an event.
#[derive(Debug, Clone, Copy)]
pub struct EventInstant<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its state.
    pub configuration: &'a Configuration,
    /// For each sliding joint the sign of its sliding velocity from now on: 1, -1, or 0 where it has stopped.
    pub signs: &'a [f64],
    /// Contacts whose normal force has just reached zero, or whose preload gap ends: that is exactly so.
    pub zero: &'a [ContactId],
    /// What rounding leaves of the greatest forces so far where they vanish (N).
    pub rounding: f64,
    /// The phase that has just ended; nothing at the start and after an impulse.
    pub previous: Option<&'a Phase>,
}

/// A phase in which the motion can go on.
#[derive(Debug, Clone, PartialEq)]
pub struct Continuation {
    /// The phase.
    pub phase: Phase,
    /// Whether a real mechanism can take it (theory, section 7).
    pub verdict: Verdict,
    /// Whether it continues the present motion without a jump of forces.
    pub continues: bool,
}

/// The phases in which the motion can go on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Continuations {
    /// The one to be taken first, and so on; none if there is none.
    pub list: Vec<Continuation>,
    /// Whether some in which fewer joints stick may be missing.
    pub left_out: bool,
}

/// An impulse that ends a dynamic jam.
#[derive(Debug, Clone, PartialEq)]
pub struct HaltingImpulse {
    /// The velocities after it.
    pub velocities: Vec<Velocity>,
    /// The kinetic energy that is lost (J).
    pub energy_lost: f64,
}

/// Decides how a motion goes on (theory, section 8).
pub trait Decisions {
    /// The phases in which the motion can go on.
    ///
    /// # Errors
    /// Whatever keeps the forces at the instant from being computed.
    fn successors(&mut self, instant: &EventInstant<'_>) -> Result<Continuations, Faults>;

    /// Where nothing can follow, the guided sliders that would tip.
    ///
    /// # Errors
    /// Whatever keeps the forces at the instant from being computed.
    fn tipping(&mut self, _instant: &EventInstant<'_>) -> Result<Vec<JointId>, Faults> {
        Ok(Vec::new())
    }

    /// The impulse of a mechanism that cannot go on moving; nothing if there is none.
    ///
    /// # Errors
    /// Whatever keeps the impulse from being computed.
    fn jam(&mut self, instant: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults>;

    /// At least zero while the joints that stick in the phase can stick.
    ///
    /// # Errors
    /// Whatever keeps the forces at the instant from being computed.
    fn sticking_margin(
        &mut self,
        mechanism: &Mechanism,
        configuration: &Configuration,
        phase: &Phase,
    ) -> Result<f64, Faults>;

    /// The normal force of each contact in a phase in which joints stick (N), nothing where statics does not
    /// determine it.
    ///
    /// # Errors
    /// Whatever keeps the forces at the instant from being computed.
    fn normal_forces(
        &mut self,
        mechanism: &Mechanism,
        _configuration: &Configuration,
        _phase: &Phase,
    ) -> Result<Vec<Option<f64>>, Faults> {
        Ok(vec![None; mechanism.contacts.len()])
    }

    /// What looks ahead in time for the bodies that stand still and stay as long as joints stick; nothing if
    /// nothing does.
    ///
    /// # Errors
    /// Whatever keeps the forces at the instant from being computed.
    fn hold<'m>(
        &mut self,
        _mechanism: &'m Mechanism,
        _configuration: &Configuration,
        _resting: Resting<'_>,
    ) -> Result<Option<Box<dyn Hold + 'm>>, Faults> {
        Ok(None)
    }
}

/// What stands still.
#[derive(Debug, Clone, Copy)]
pub struct Resting<'a> {
    /// What all joints and contacts do.
    pub phase: &'a Phase,
    /// For each body whether it stands still and stays as long as joints stick.
    pub bodies: &'a [bool],
}

/// What is known of the time ahead of what stands still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlook {
    /// Until this time (s) it is proven that nothing slips.
    pub proven: f64,
    /// Whether something slips then.
    pub slips: bool,
}

/// What stands still while its loads change.
pub trait Hold {
    /// When the joints that stick cannot any longer, and until when that is proven, in a span of time.
    ///
    /// # Errors
    /// Whatever keeps the forces from being computed.
    fn outlook(&mut self, span: [f64; 2]) -> Result<Outlook, Faults>;

    /// What [`Decisions::sticking_margin`] is of the joints between these bodies at a time.
    ///
    /// # Errors
    /// Whatever keeps the forces from being computed.
    fn margin(&mut self, time: f64) -> Result<f64, Faults>;
}
