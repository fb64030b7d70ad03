//! Impulses: what jams and impacts have in common. Positions stay, and loads and preloads do not count, while
//! velocities jump.

use super::assessment::{Assessment, PRESSED, assess_group};
use super::instant::Instant;
use super::outputs::{Group, Outputs};
use super::successors::combinations;
use super::system::Question;
use super::{BOUNDARY, MOST_STATES};
use crate::configuration::{Configuration, Velocity};
use crate::fault::{Fault, FaultKind, Faults};
use crate::influence::ContactFriction;
use crate::pattern::{ContactPhase, JointPhase, Phase};
use nalgebra::{DVector, Vector2};

/// Sliding velocities below this multiple of the greatest count as zero.
pub(super) const AT_REST: f64 = 1e-9;

/// A mechanism at an instant at which velocities jump.
pub(super) struct Impulses<'s> {
    pub(super) instant: &'s Instant<'s>,
    outputs: Outputs,
    /// The greatest sliding velocity (m/s).
    pub(super) speed: f64,
}

/// Admissible states of a group, and the number of undecided patterns.
#[derive(Default)]
pub(super) struct Admissible {
    pub(super) list: Vec<Assessment>,
    pub(super) unsolved: usize,
}

impl<'s> Impulses<'s> {
    pub(super) fn new(instant: &'s Instant<'s>) -> Self {
        let speed = instant.joints.iter().map(|joint| joint.velocity.abs()).fold(0.0, f64::max);
        Self { instant, outputs: instant.impulse_outputs(), speed }
    }

    /// The sliding velocities (m/s), exactly zero where they are only rounding.
    pub(super) fn velocities(&self) -> Vec<f64> {
        let velocities = self.instant.joints.iter().map(|joint| joint.velocity);
        velocities.map(|velocity| self.without_rounding(velocity)).collect()
    }

    pub(super) fn without_rounding(&self, velocity: f64) -> f64 {
        if velocity.abs() <= AT_REST * self.speed { 0.0 } else { velocity }
    }

    /// The time in which the unit of acceleration produces the greatest sliding velocity (s).
    fn time(&self) -> f64 {
        self.speed / self.instant.units.acceleration
    }

    /// The question for a state in which sliding velocities jump by these amounts (m/s) where joints stick or
    /// are pushed by their stops.
    pub(super) fn question<'q>(&'q self, jumps: &[f64], stopped: &'q [bool]) -> Question<'q> {
        let joints = self.instant.joints.iter().zip(jumps);
        Question {
            outputs: &self.outputs,
            wanted: joints.map(|(joint, jump)| jump / (joint.units.acceleration * self.time())).collect(),
            has_preload: false,
            sides: vec![PRESSED.to_vec(); self.outputs.columns[0].ncols()],
            stopped,
            opposes: None,
            pushed: Vec::new(),
        }
    }

    /// What a joint with this sliding velocity can do during an impulse: a sliding joint continues, a resting
    /// one may stay.
    pub(super) fn options(&self, joint: usize, velocity: f64) -> Vec<JointPhase> {
        if velocity != 0.0 {
            vec![JointPhase::Sliding(velocity.signum())]
        } else if self.instant.joints[joint].has_friction {
            vec![JointPhase::Sticking, JointPhase::Sliding(1.0), JointPhase::Sliding(-1.0)]
        } else {
            vec![JointPhase::Sliding(1.0)]
        }
    }

    /// The admissible states of a group in which each joint does one of the given things.
    ///
    /// # Errors
    /// More states than are tried.
    pub(super) fn admissible(
        &self,
        question: &Question<'_>,
        options: &[Vec<JointPhase>],
        group: &Group,
    ) -> Result<Admissible, Faults> {
        let mut found = Admissible::default();
        for phase in self.states(options, group)? {
            match assess_group(self.instant, question, (&phase, group), f64::INFINITY) {
                Err(_) => found.unsolved += 1,
                Ok(Some(state)) if state.least() >= -BOUNDARY => found.list.push(state),
                Ok(_) => {}
            }
        }
        Ok(found)
    }

    /// All states of a group in which each joint does one of the given things, with all sides of the sliding
    /// contacts; the sides of sticking contacts are found later, and other groups do not matter.
    fn states(&self, options: &[Vec<JointPhase>], group: &Group) -> Result<Vec<Phase>, Faults> {
        let inside = |joint: usize| group.joints.contains(&joint);
        let joints: Vec<Vec<JointPhase>> = options
            .iter()
            .enumerate()
            .map(|(joint, all)| all[..if inside(joint) { all.len() } else { 1 }].to_vec())
            .collect();
        let of_joint = |joint: &usize| {
            let contacts = &self.instant.joints[*joint].contacts;
            let slides = contacts.iter().fold(1_u64, |sides, _| sides.saturating_mul(PRESSED.len() as u64));
            let states = joints[*joint].iter().map(|phase| match phase {
                JointPhase::Sticking => 1,
                JointPhase::Sliding(_) => slides,
            });
            states.fold(0, u64::saturating_add)
        };
        let states = group.joints.iter().map(of_joint).fold(1, u64::saturating_mul);
        if states > MOST_STATES {
            return Err(Fault::general(FaultKind::TooManyStates { states, limit: MOST_STATES }).into());
        }
        let mut all = Vec::new();
        for joints in combinations(&joints) {
            let sides = |k: usize| {
                let joint = self.instant.joint_of(k).filter(|joint| inside(*joint));
                let slides = joint.is_some_and(|joint| joints[joint] != JointPhase::Sticking);
                PRESSED[..if slides { 2 } else { 1 }].to_vec()
            };
            let sides: Vec<Vec<ContactPhase>> = (0..self.outputs.columns[0].ncols()).map(sides).collect();
            let phases = combinations(&sides).into_iter();
            all.extend(phases.map(|contacts| Phase { joints: joints.clone(), contacts, hinges: Vec::new() }));
        }
        Ok(all)
    }

    /// The unit of the impulses of a contact (N s).
    pub(super) fn unit(&self, k: usize) -> f64 {
        self.instant.units_of(k).force * self.time()
    }

    /// The impulses of friction and of stops in a state (N s).
    pub(super) fn frictions(&self, state: &Assessment) -> Vec<ContactFriction> {
        let frictions = state.forces.frictions.iter().enumerate();
        frictions.map(|(k, friction)| friction.times(self.unit(k))).collect()
    }

    /// The configuration with these jumps of the velocities; what rounding leaves of a velocity is set to
    /// zero.
    pub(super) fn moved(&self, configuration: &Configuration, jumps: &DVector<f64>) -> Configuration {
        let mut after = jumped(configuration, jumps.as_slice(), 1.0);
        let rates = self.instant.equations.coordinate_jumps(jumps);
        for (rate, jump) in after.rates.iter_mut().zip(rates) {
            *rate = sum(*rate, jump);
        }
        after
    }
}

/// The configuration with a part of the jumps of the bodies' velocities, its coordinates as before; what rounding leaves of a
/// velocity is zero.
pub(super) fn jumped(configuration: &Configuration, jumps: &[f64], part: f64) -> Configuration {
    let mut after = configuration.clone();
    for (Velocity { linear, angular }, jump) in after.velocities.iter_mut().zip(jumps.chunks_exact(3)) {
        *linear = Vector2::new(sum(linear.x, part * jump[0]), sum(linear.y, part * jump[1]));
        *angular = sum(*angular, part * jump[2]);
    }
    after
}

/// A sum that is exactly zero where its terms cancel within rounding.
fn sum(velocity: f64, jump: f64) -> f64 {
    let sum = velocity + jump;
    if sum.abs() <= AT_REST * velocity.abs() { 0.0 } else { sum }
}
