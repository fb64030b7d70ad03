//! Impulses: what jams and impacts have in common. Positions stay, and loads and preloads do not count, while
//! velocities jump.

use super::assessment::{Assessment, PRESSED, assess_group, sliding_sides, with_sides};
use super::instant::Instant;
use super::joints::SlidingJoint;
use super::outputs::{Group, Outputs};
use super::successors::combinations;
use super::system::Question;
use super::turning::Turning;
use super::units::Units;
use super::{BOUNDARY, MOST_STATES};
use crate::configuration::{Configuration, Velocity};
use crate::fault::{Fault, FaultKind, Faults};
use crate::influence::{ContactFriction, Influence};
use crate::mechanism::Contact;
use crate::pattern::{ContactPhase, HingePhase, JointPhase, Phase};
use crate::progress::Work;
use nalgebra::{DVector, Vector2};

/// Sliding velocities below this multiple of the greatest count as zero.
pub(super) const AT_REST: f64 = 1e-9;

/// A mechanism at an instant at which velocities jump.
pub(super) struct Impulses<'s> {
    pub(super) instant: &'s Instant<'s>,
    outputs: Outputs,
    /// For each sliding joint and hinge with friction the greatest velocity in its group (m/s), beside which velocities are
    /// rounding.
    pub(super) speeds: Vec<f64>,
    pub(super) work: Work<'s>,
}

/// Admissible states of a group, and the number of undecided patterns.
#[derive(Default)]
pub(super) struct Admissible {
    pub(super) list: Vec<Assessment>,
    pub(super) unsolved: usize,
}

impl<'s> Impulses<'s> {
    /// Those at an instant; once the work is to end, what is left of it counts as undecided.
    pub(super) fn new(instant: &'s Instant<'s>, work: Work<'s>) -> Self {
        let mut speeds = vec![0.0; instant.rubbing()];
        for group in &instant.groups {
            let members = || group.members(instant.joints.len());
            let greatest = members().map(|number| instant.velocity(number).abs()).fold(0.0, f64::max);
            members().for_each(|number| speeds[number] = greatest);
        }
        Self { instant, outputs: instant.impulse_outputs(), speeds, work }
    }

    /// Counts velocities of at least this magnitude, and those of one another, in what velocities of these joints and hinges are
    /// rounding beside (m/s).
    pub(super) fn count_velocities_of(&mut self, speed: f64, among: impl Fn(usize) -> bool) {
        let own = self.speeds.iter_mut().enumerate().filter(|(number, _)| among(*number));
        let own: Vec<&mut f64> = own.map(|(_, speed)| speed).collect();
        let greatest = own.iter().fold(speed, |greatest, speed| greatest.max(**speed));
        own.into_iter().for_each(|speed| *speed = greatest);
    }

    /// Puts jumps without friction in the place of what loads are otherwise, and to the changes of gaps their rates before;
    /// these are given by joint and number (m/s).
    pub(super) fn put_base(&mut self, jumps: &DVector<f64>, rate: impl Fn(usize, usize) -> f64) {
        let instant = self.instant;
        self.outputs.base = instant.response(jumps);
        let contacts = instant.mechanism.contacts.len();
        let couples = instant.couple_outputs().map(|(row, joint)| (row, joint.id)).collect::<Vec<_>>();
        for joint in 0..instant.joints.len() {
            let SlidingJoint { contacts: own, gaps, id, units, .. } = &instant.joints[joint];
            let couple = couples.iter().filter(|(_, other)| other == id).map(|(row, _)| *row);
            let rows = own.iter().copied().chain([contacts + joint]).chain(couple);
            for row in rows {
                self.outputs.base[row] /= self.time(joint);
            }
            for (row, (number, _)) in instant.gap_outputs(joint).zip(gaps) {
                let before = rate(joint, *number) / units.acceleration;
                self.outputs.base[row] = (self.outputs.base[row] + before) / self.time(joint);
            }
        }
        for hinge in 0..instant.hinges.len() {
            let first = instant.turning_output(hinge);
            let time = self.time(instant.number_of(hinge));
            self.outputs.base.rows_mut(first, 3).unscale_mut(time);
        }
    }

    /// Puts the velocities of sliding joints and hinges after the impulses in the place of their changes: what sticks has none, and
    /// friction opposes the others.
    pub(super) fn put_velocities_after(&mut self, before: &[f64]) {
        for (number, velocity) in before.iter().enumerate() {
            self.outputs.base[self.instant.acceleration_output(number)] += velocity / self.speeds[number];
        }
    }

    /// The velocities of the sliding joints and hinges with friction (m/s), exactly zero where they are only rounding.
    pub(super) fn velocities(&self) -> Vec<f64> {
        let velocities = (0..self.instant.rubbing()).map(|number| self.instant.velocity(number));
        velocities.enumerate().map(|(number, velocity)| self.without_rounding(number, velocity)).collect()
    }

    /// A velocity of a joint or hinge, exactly zero where it is only rounding.
    pub(super) fn without_rounding(&self, number: usize, velocity: f64) -> f64 {
        if velocity.abs() <= AT_REST * self.speeds[number] { 0.0 } else { velocity }
    }

    /// The time in which the unit of acceleration of a joint or hinge produces the greatest velocity in its group (s).
    fn time(&self, number: usize) -> f64 {
        self.speeds[number] / self.instant.units_of_rubbing(number).acceleration
    }

    /// The question for a state in which sliding velocities jump by these amounts (m/s) where joints stick.
    pub(super) fn question<'q>(&'q self, jumps: &[f64], stopped: &'q [bool]) -> Question<'q> {
        let wanted =
            jumps.iter().zip(&self.speeds).map(|(jump, speed)| if *jump == 0.0 { 0.0 } else { jump / speed });
        let sides = |contact: &Contact| {
            if contact.opens { ContactPhase::CLOSED.to_vec() } else { PRESSED.to_vec() }
        };
        Question {
            outputs: &self.outputs,
            wanted: wanted.collect(),
            has_preload: false,
            sides: self.instant.mechanism.contacts.iter().map(sides).collect(),
            stopped,
            opposes: None,
        }
    }

    /// What a joint or hinge with this velocity can do during an impulse: a sliding joint continues, a resting
    /// one may stay.
    pub(super) fn options(&self, joint: usize, velocity: f64) -> Vec<JointPhase> {
        if velocity != 0.0 {
            vec![JointPhase::Sliding(velocity.signum())]
        } else if self.instant.may_stick(joint) {
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
        for phase in self.states(question, options, (group, &mut found.unsolved))? {
            if self.work.is_over() {
                found.unsolved += 1;
                break;
            }
            match assess_group(self.instant, question, (&phase, group), f64::INFINITY) {
                Err(_) => found.unsolved += 1,
                Ok(Some(state)) if state.least() >= -BOUNDARY => found.list.push(state),
                Ok(_) => {}
            }
        }
        Ok(found)
    }

    /// All states of a group in which each joint and hinge does one of the given things, with all sides of the sliding
    /// contacts and all forces of the hinges that turn; the sides of sticking contacts are found later, and other groups do
    /// not matter. Undecided patterns are counted.
    fn states(
        &self,
        question: &Question<'_>,
        options: &[Vec<JointPhase>],
        (group, undecided): (&Group, &mut usize),
    ) -> Result<Vec<Phase>, Faults> {
        let instant = self.instant;
        let members: Vec<usize> = group.members(instant.joints.len()).collect();
        let of_member = |number: &usize| {
            let contacts = instant.joints.get(*number).map_or(0, |joint| joint.contacts.len());
            let slides = (PRESSED.len() as u64).saturating_pow(u32::try_from(contacts).unwrap_or(u32::MAX));
            let states = options[*number].iter().map(|phase| match phase {
                JointPhase::Sticking => 1,
                JointPhase::Sliding(_) => slides,
            });
            states.fold(0, u64::saturating_add)
        };
        let states = members.iter().map(of_member).fold(1, u64::saturating_mul);
        if states > MOST_STATES {
            return Err(Fault::general(FaultKind::TooManyStates { states, limit: MOST_STATES }).into());
        }
        let options_of: Vec<Vec<JointPhase>> =
            members.iter().map(|number| options[*number].clone()).collect();
        let any = Phase {
            joints: options[..instant.joints.len()].iter().map(|options| options[0]).collect(),
            contacts: vec![PRESSED[0]; self.outputs.columns[0].ncols()],
            hinges: options[instant.joints.len()..]
                .iter()
                .map(|options| HingePhase { state: options[0], force: [0.0; 2] })
                .collect(),
        };
        let mut all = Vec::new();
        for does in combinations(&options_of) {
            let mut phase = any.clone();
            members.iter().zip(does).for_each(|(number, does)| phase.set(*number, does));
            if group.turns(&phase) {
                let turning = Turning::new(instant, question, (&phase, group), self.work);
                let (phases, decided) =
                    turning.map_or((Vec::new(), false), |turning| turning.phases(self.work));
                *undecided += usize::from(!decided);
                all.extend(phases);
            } else {
                let sides = sliding_sides(question, &phase, (instant, group));
                all.extend((0..).map_while(|number| with_sides(&phase, &sides, number)));
            }
        }
        Ok(all)
    }

    /// The unit of the impulses of a contact (N s).
    pub(super) fn unit(&self, k: usize) -> f64 {
        self.instant.joint_of(k).map_or(0.0, |joint| self.instant.units_of(k).force * self.time(joint))
    }

    /// The impulses of friction and of stops in a state (N s).
    pub(super) fn frictions(&self, state: &Assessment) -> Vec<ContactFriction> {
        let frictions = state.forces.frictions.iter().enumerate();
        frictions.map(|(k, friction)| friction.times(self.unit(k))).collect()
    }

    /// The jumps of all unknowns in a state.
    pub(super) fn jumps(&self, state: &Assessment) -> DVector<f64> {
        let Influence { couples, .. } = &self.instant.influence;
        let mut jumps = self.instant.influence.of_friction(&self.frictions(state));
        for ((number, couple), column) in state.forces.couples.iter().enumerate().zip(couples) {
            let Units { force, length, .. } = self.instant.hinges[number].units;
            let time = self.time(self.instant.number_of(number));
            jumps.axpy(couple * force * length * time, column, 1.0);
        }
        jumps
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
