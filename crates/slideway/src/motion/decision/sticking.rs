//! How much friction is left to joints that stick.

use super::assessment::assess;
use super::instant::Instant;
use super::state::{PhaseState, state};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::pattern::Phase;

/// The margin where no distribution of forces is admissible whatever the friction, or none was found.
pub(super) const NONE: f64 = -1.0;
/// A margin from which on other sides of the contacts that stick are not tried.
pub(super) const ENOUGH: f64 = 0.01;

/// A phase with joints that stick.
#[derive(Debug, Clone, PartialEq)]
pub struct Sticking {
    /// The margin, see [`sticking_margin`].
    pub margin: f64,
    /// The phase with the sides at which its sticking contacts are pressed; to be passed on next time, so
    /// that these are tried first.
    pub phase: Phase,
    /// Accelerations and the reactions that attain the margin.
    pub state: PhaseState,
}

/// How much friction is left to the joints that stick in a phase: not negative as long as they can stick.
///
/// It is the greatest `t` for which forces exist with
///
/// ```text
/// mu_static_k |N_k| + F_k0 - |F_k| >= t f,    |N_k| >= t f,    |N| L/2 - |C| >= t f L_mechanism    and    t <= 1
/// ```
///
/// at every contact of the joints that stick, `f` being the greatest force of the instant (load, preload or
/// inertia), but at least so great that what the rounding of positions makes of springs counts as zero beside
/// it. It is the greatest over all sides of these contacts and varies continuously with the state, as long as
/// the sides of contacts that slide do not change; but if the sides of `phase` leave at least 0.01, others,
/// which could leave more, are not tried. At an instant at which a contact of a joint that sticks is without
/// load and preload the margin is zero without becoming negative. It is infinite where no joint sticks, and
/// -1 where the joints cannot all stick at their velocities, or a linear program was not solved. When it
/// reaches zero, [`successors`](super::successors) says which joint slips which way.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, and a phase of another
/// mechanism.
pub fn sticking_margin(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Result<f64, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    instant.check(phase)?;
    let stopped = vec![false; instant.joints.len()];
    let found = assess(&instant, &instant.question(&stopped, Some(phase)), phase, ENOUGH);
    Ok(found.ok().flatten().map_or(NONE, |assessment| assessment.margin))
}

/// [`sticking_margin`] with the accelerations and reactions that attain it; nothing where the joints cannot
/// all stick at their velocities.
///
/// # Errors
/// As [`sticking_margin`].
pub fn sticking(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Result<Option<Sticking>, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    instant.check(phase)?;
    let stopped = vec![false; instant.joints.len()];
    let question = instant.question(&stopped, Some(phase));
    let Ok(Some(assessment)) = assess(&instant, &question, phase, f64::INFINITY) else {
        return Ok(None);
    };
    let state = state(&instant, &assessment);
    Ok(Some(Sticking { margin: assessment.margin, phase: assessment.phase, state }))
}

/// Accelerations and reactions of a phase while it lasts, whether it is admissible or not; nothing where its
/// equations contradict each other (a mode with D = 0, joints that cannot all stick at their velocities).
///
/// # Errors
/// As [`sticking_margin`].
pub fn phase_state(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Result<Option<PhaseState>, Faults> {
    Ok(sticking(mechanism, configuration, phase)?.map(|sticking| sticking.state))
}
