//! How much friction is left to sticking joints.

use super::assessment::assess;
use super::instant::Instant;
use super::state::{PhaseState, state};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::pattern::Phase;

/// The margin if no distribution of forces is admissible whatever the friction, or if none was found.
pub(super) const NONE: f64 = -1.0;
/// From this margin on, other sides of the sticking contacts are not tried.
pub(super) const ENOUGH: f64 = 0.01;

/// A phase with sticking joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Sticking {
    /// The margin, see [`sticking_margin`].
    pub margin: f64,
    /// The phase with the sides to which its sticking contacts are pressed; pass it on next time, so that
    /// these are tried first.
    pub phase: Phase,
    /// Accelerations and the reactions that attain the margin.
    pub state: PhaseState,
}

/// How much friction is left to the sticking joints of a phase: not negative as long as they can stick.
///
/// It is the greatest `t` for which forces exist with
///
/// ```text
/// mu_static_k |N_k| + F_k0 - |F_k| >= t f,    |N_k| >= t f,    |N| L/2 - |C| >= t f L_mechanism    and    t <= 1
/// ```
///
/// at every contact of the sticking joints, where `f` is the greatest force of the instant (load, preload or
/// inertia), but at least so large that what the rounding of positions makes of springs is negligible beside
/// it. It is the greatest over all sides of these contacts and varies continuously with the state, as long as
/// the sides of sliding contacts do not change. If the sides of `phase` leave at least 0.01, however, other
/// sides, which could leave more, are not tried. At an instant at which a contact of a sticking joint has no
/// load and no preload, the margin is zero without becoming negative. It is infinite if no joint sticks, and
/// -1 if the joints cannot all stick at their velocities or a linear program was not solved. When it reaches
/// zero, [`successors`](super::successors) determines which joint slips in which direction.
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
    let stopped = vec![false; instant.rubbing()];
    let found = assess(&instant, &instant.question(&stopped, Some(phase)), phase, ENOUGH);
    Ok(found.ok().flatten().map_or(NONE, |assessment| assessment.margin))
}

/// [`sticking_margin`] with the accelerations and reactions that attain it; `None` if the joints cannot all
/// stick at their velocities.
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
    let stopped = vec![false; instant.rubbing()];
    let question = instant.question(&stopped, Some(phase));
    let Ok(Some(assessment)) = assess(&instant, &question, phase, f64::INFINITY) else {
        return Ok(None);
    };
    let state = state(&instant, &assessment);
    Ok(Some(Sticking { margin: assessment.margin, phase: assessment.phase, state }))
}

/// Accelerations and reactions of a phase while it lasts, whether it is admissible or not; `None` if its
/// equations contradict each other (a mode with D = 0, or joints that cannot all stick at their velocities).
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
