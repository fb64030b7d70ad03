//! What the simulation asks at an event: how the motion can continue.

use crate::configuration::{Configuration, Velocity};
use crate::fault::Faults;
use crate::ids::{ContactId, JointId};
use crate::mechanism::Mechanism;
use crate::pattern::Phase;
use crate::progress::Work;
use crate::report::Verdict;
use std::fmt;

/// A mechanism at the instant of an event.
#[derive(Clone, Copy)]
pub struct EventInstant<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its state.
    pub configuration: &'a Configuration,
    /// For each sliding joint, the sign of its sliding velocity from now on: 1, -1, or 0 if it has stopped.
    pub signs: &'a [f64],
    /// The same of the angular velocity of each hinge with friction.
    pub spins: &'a [f64],
    /// Contacts whose normal force has just reached zero or whose preload gap ends; it is exactly zero.
    pub zero: &'a [ContactId],
    /// For each body, what rounding leaves of the greatest forces so far where they vanish (N); nothing if it is empty.
    pub rounding: &'a [f64],
    /// The phase that has just ended; `None` at the start and after an impulse.
    pub previous: Option<&'a Phase>,
    /// The work of which the decision is a part: once it is to end, the decision comes to nothing.
    pub work: Work<'a>,
}

impl fmt::Debug for EventInstant<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { configuration, signs, spins, zero, rounding, previous, .. } = self;
        f.debug_struct("EventInstant")
            .field("configuration", configuration)
            .field("signs", signs)
            .field("spins", spins)
            .field("zero", zero)
            .field("rounding", rounding)
            .field("previous", previous)
            .finish_non_exhaustive()
    }
}

impl<'a> EventInstant<'a> {
    /// That of a mechanism without friction in hinges, where nothing has just reached zero.
    pub(crate) fn new(
        (mechanism, configuration): (&'a Mechanism, &'a Configuration),
        signs: &'a [f64],
        previous: Option<&'a Phase>,
    ) -> Self {
        let work = Work::undisturbed();
        Self { mechanism, configuration, signs, spins: &[], zero: &[], rounding: &[], previous, work }
    }
}

impl EventInstant<'_> {
    /// The sign of the velocity of one of the sliding joints and hinges with friction.
    pub(super) fn sign_of(&self, number: usize) -> f64 {
        self.signs.get(number).copied().unwrap_or_else(|| self.spins[number - self.signs.len()])
    }
}

/// A phase in which the motion can continue.
#[derive(Debug, Clone, PartialEq)]
pub struct Continuation {
    /// The phase.
    pub phase: Phase,
    /// Whether a real mechanism can follow it (theory, section 7).
    pub verdict: Verdict,
    /// Whether it continues the present motion without a jump in the forces.
    pub(crate) continues: bool,
    /// The impulse without collision after which it begins, where there is one.
    pub(crate) impulse: Option<HaltingImpulse>,
}

/// The phases in which the motion can continue.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Continuations {
    /// The phases in order of preference; empty if there are none.
    pub list: Vec<Continuation>,
    /// Whether some phases in which fewer joints stick may be missing.
    pub left_out: bool,
}

/// An impulse that ends a dynamic jam.
#[derive(Debug, Clone, PartialEq)]
pub struct HaltingImpulse {
    /// The velocities after it.
    pub(crate) velocities: Vec<Velocity>,
    /// The kinetic energy that is lost (J).
    pub(crate) energy_lost: f64,
}

/// Decides how a motion continues (theory, section 8).
pub trait Decisions {
    /// The phases in which the motion can continue.
    ///
    /// # Errors
    /// Whatever prevents computing the forces at the instant.
    fn successors(&mut self, instant: &EventInstant<'_>) -> Result<Continuations, Faults>;

    /// If nothing can follow, the guided sliders that would tip.
    ///
    /// # Errors
    /// Whatever prevents computing the forces at the instant.
    fn tipping(&mut self, _instant: &EventInstant<'_>) -> Result<Vec<JointId>, Faults> {
        Ok(Vec::new())
    }

    /// The impulse of a mechanism that cannot continue to move; `None` if there is none.
    ///
    /// # Errors
    /// Whatever prevents computing the impulse.
    fn jam(&mut self, instant: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults>;

    /// At least zero as long as the sticking joints of the phase can stick.
    ///
    /// # Errors
    /// Whatever prevents computing the forces at the instant.
    fn sticking_margin(
        &mut self,
        mechanism: &Mechanism,
        configuration: &Configuration,
        phase: &Phase,
    ) -> Result<f64, Faults>;

    /// The normal force of each contact in a phase in which joints stick (N); `None` where statics does not
    /// determine it.
    ///
    /// # Errors
    /// Whatever prevents computing the forces at the instant.
    fn normal_forces(
        &mut self,
        mechanism: &Mechanism,
        _configuration: &Configuration,
        _phase: &Phase,
    ) -> Result<Vec<Option<f64>>, Faults> {
        Ok(vec![None; mechanism.contacts.len()])
    }

    /// Looks ahead in time for the bodies that stand still and stay so as long as joints stick; `None` if
    /// there are none.
    ///
    /// # Errors
    /// Whatever prevents computing the forces at the instant.
    fn hold<'m>(
        &mut self,
        _mechanism: &'m Mechanism,
        _configuration: &Configuration,
        _resting: Resting<'_>,
    ) -> Result<Option<Box<dyn Hold + 'm>>, Faults> {
        Ok(None)
    }
}

/// Bodies that stand still.
#[derive(Debug, Clone, Copy)]
pub struct Resting<'a> {
    /// The states of all joints and contacts.
    pub(crate) phase: &'a Phase,
    /// For each body, whether it stands still and stays so as long as joints stick.
    pub(crate) bodies: &'a [bool],
}

/// What is known about the future of bodies that stand still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlook {
    /// It is proven that nothing slips until this time (s).
    pub(crate) proven: f64,
    /// Whether something slips then.
    pub(crate) slips: bool,
}

/// Bodies that stand still while their loads change.
pub trait Hold {
    /// When the sticking joints can no longer stick, and until when that is proven, in a span of time.
    ///
    /// # Errors
    /// Whatever prevents computing the forces.
    fn outlook(&mut self, span: [f64; 2]) -> Result<Outlook, Faults>;

    /// The [`Decisions::sticking_margin`] of the joints between these bodies at a time.
    ///
    /// # Errors
    /// Whatever prevents computing the forces.
    fn margin(&mut self, time: f64) -> Result<f64, Faults>;
}
