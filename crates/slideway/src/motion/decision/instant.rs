//! A mechanism at one instant: how normal forces, sliding accelerations and couples respond to friction.

use super::joints::{
    RoughHinge, SlidingJoint, put_gaps, rough_hinges, set_units, sliding_joints, touching_gaps,
};
use super::outputs::{Group, Outputs, Rubbing, groups, outputs};
use super::scale::{Scale, rounding, scale};
use super::units::Units;
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, JointId};
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::{Contact, Mechanism, body_of};
use crate::pattern::{Law, Phase};
use nalgebra::DVector;
use std::borrow::Cow;
use std::ops::Range;

/// A mechanism at one instant.
#[derive(Debug, Clone)]
pub(super) struct Instant<'m> {
    /// The mechanism.
    pub(super) mechanism: &'m Mechanism,
    /// Its contacts, with the friction at their sliding speeds.
    contacts: Cow<'m, [Contact]>,
    /// Its kinetic equations.
    pub(super) equations: KineticEquations,
    /// How its unknowns respond to friction.
    pub(super) influence: Influence,
    /// Its sliding joints.
    pub(super) joints: Vec<SlidingJoint>,
    /// Its hinges with friction.
    pub(super) hinges: Vec<RoughHinge>,
    /// Units of the whole mechanism.
    pub(super) units: Units,
    /// The least units of force (N), for the whole mechanism and for what is connected with each joint.
    least_forces: Vec<f64>,
    /// The outputs on which decisions are based.
    pub(super) outputs: Outputs,
    /// The difference of these from what the loads give, see [`Self::vanish`].
    pub(super) shift: DVector<f64>,
    /// The sliding joints and hinges with friction, in groups that are decided separately.
    pub(super) groups: Vec<Group>,
}

/// The source of the least units of force.
#[derive(Clone, Copy)]
enum Least<'l> {
    /// Determined from the configuration.
    Now(Scale),
    /// Taken from an earlier instant.
    Before(&'l [f64]),
}

impl<'m> Instant<'m> {
    /// A mechanism in a configuration, in units of its forces there.
    ///
    /// # Errors
    /// Whatever [`KineticEquations::new`] refuses, and friction without a value.
    pub(super) fn new(mechanism: &'m Mechanism, configuration: &Configuration) -> Result<Self, Faults> {
        let equations = KineticEquations::new(mechanism, configuration)?;
        let touching = touching_gaps(mechanism, configuration);
        Self::of(mechanism, (configuration, equations), (Least::Now(rounding), touching))
    }

    /// The same in units of the forces that will arise: those of the instant may vanish, and then their
    /// development decides.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn looking_ahead(
        mechanism: &'m Mechanism,
        configuration: &Configuration,
    ) -> Result<Self, Faults> {
        mechanism.check_no_press_fit("what follows in time")?;
        mechanism.check_determinate("what follows in time")?;
        let equations = KineticEquations::new(mechanism, configuration)?;
        let touching = touching_gaps(mechanism, configuration);
        Self::of(mechanism, (configuration, equations), (Least::Now(scale), touching))
    }

    /// The same in units of at least what rounding leaves of forces on each body (N): where all forces vanish at once, as
    /// at a dead centre without loads, that does not count.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn in_units_of_at_least(
        self,
        rounding: &[f64],
        configuration: &Configuration,
    ) -> Result<Self, Faults> {
        let of = |joint: JointId| {
            let body = body_of(self.mechanism, joint);
            body.and_then(|body| rounding.get(body.index()).copied()).unwrap_or(0.0)
        };
        let forces = self.joints.iter().map(|joint| (joint.id, joint.units.force));
        let forces = forces.chain(self.hinges.iter().map(|hinge| (hinge.id, hinge.units.force)));
        let (of_joints, small): (Vec<f64>, Vec<bool>) =
            forces.map(|(joint, force)| (of(joint), force < of(joint))).unzip();
        if !small.contains(&true) {
            return Ok(self);
        }
        // The first is that of the whole mechanism.
        let whole = rounding.iter().copied().fold(0.0, f64::max);
        let rounding = std::iter::once(whole).chain(of_joints);
        let least: Vec<f64> =
            self.least_forces.iter().zip(rounding).map(|(least, rounding)| least.max(rounding)).collect();
        let touching = self.touching();
        Self::of(self.mechanism, (configuration, self.equations), (Least::Before(&least), touching))
    }

    /// The mechanism a little later, with the same least units and the same difference from what the loads
    /// give.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn later(&self, configuration: &Configuration) -> Result<Self, Faults> {
        let equations = self.equations.near(self.mechanism, configuration)?;
        let least = Least::Before(&self.least_forces);
        let mut later = Self::of(self.mechanism, (configuration, equations), (least, self.touching()))?;
        later.change_base(&self.shift);
        Ok(later)
    }

    /// Of each sliding joint the contacts that are apart, whose gaps were zero at first.
    fn touching(&self) -> Vec<Vec<usize>> {
        self.joints.iter().map(|joint| joint.gaps.iter().map(|(number, _)| *number).collect()).collect()
    }

    fn of(
        mechanism: &'m Mechanism,
        (configuration, equations): (&Configuration, KineticEquations),
        (least, touching): (Least<'_>, Vec<Vec<usize>>),
    ) -> Result<Self, Faults> {
        let influence = Influence::new(&equations);
        let mut joints = sliding_joints(mechanism, configuration, &equations);
        put_gaps(&mut joints, &touching, (mechanism, configuration));
        let (now, mut least_forces) = match least {
            Least::Now(scale) => (Some((configuration, scale)), Vec::new()),
            Least::Before(forces) => (None, forces.to_vec()),
        };
        let mut hinges = rough_hinges(mechanism, configuration, &equations);
        let both = (&mut joints[..], &mut hinges[..]);
        let units = set_units(mechanism, (&influence, &equations), now, (both, &mut least_forces));
        let rubbing = Rubbing { contacts: mechanism.contacts.len(), joints: &joints, hinges: &hinges };
        let outputs = outputs(mechanism, &influence, rubbing);
        let groups = groups(rubbing, &outputs);
        let shift = DVector::zeros(outputs.base.len());
        let contacts = contacts_at_speeds(mechanism, configuration, &equations)?;
        Ok(Self {
            mechanism,
            contacts,
            equations,
            influence,
            joints,
            hinges,
            units,
            least_forces,
            outputs,
            shift,
            groups,
        })
    }

    /// # Errors
    /// A fault if a list does not have one entry for each sliding joint.
    pub(super) fn check_joints(&self, found: usize) -> Result<(), Faults> {
        wrong_count("sliding joints", self.joints.len(), found)
    }

    /// # Errors
    /// A fault if a phase is not one of this mechanism.
    pub(super) fn check(&self, phase: &Phase) -> Result<(), Faults> {
        self.check_joints(phase.joints.len())?;
        wrong_count("hinges with friction", self.hinges.len(), phase.hinges.len())?;
        wrong_count("contacts", self.mechanism.contacts.len(), phase.contacts.len())
    }

    /// The response to friction impulses alone, without loads.
    pub(super) fn impulse_outputs(&self) -> Outputs {
        Outputs { base: DVector::zeros(self.outputs.base.len()), ..self.outputs.clone() }
    }

    /// The outputs for changes of all unknowns.
    pub(super) fn response(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        let contacts = self.mechanism.contacts.len();
        Rubbing { contacts, joints: &self.joints, hinges: &self.hinges }.response(&self.influence, unknowns)
    }

    /// The units of a contact.
    pub(super) fn units_of(&self, k: usize) -> Units {
        self.joint_of(k).map_or(self.units, |joint| self.joints[joint].units)
    }

    /// Adds to the frictionless outputs, in units.
    pub(super) fn change_base(&mut self, shift: &DVector<f64>) {
        self.outputs.base += shift;
        self.shift += shift;
    }

    /// A contact by its number.
    pub(super) fn contact(&self, k: usize) -> &Contact {
        &self.contacts[k]
    }

    /// Coulomb's law of a contact, in units.
    pub(super) fn law(&self, k: usize, has_preload: bool) -> Law {
        let contact = self.contact(k);
        let holds = contact.mu_static.map(|mu| mu > 0.0);
        Law::new(self.mechanism, (k, contact), (self.units_of(k).force, has_preload), holds)
    }

    /// The mechanism with the friction at the sliding speeds.
    pub(super) fn mechanism_at_speeds(&self) -> Cow<'_, Mechanism> {
        match &self.contacts {
            Cow::Borrowed(_) => Cow::Borrowed(self.mechanism),
            Cow::Owned(contacts) => {
                let mut mechanism = self.mechanism.clone();
                mechanism.contacts.clone_from(contacts);
                Cow::Owned(mechanism)
            }
        }
    }

    /// The sliding joint of a contact.
    pub(super) fn joint_of(&self, k: usize) -> Option<usize> {
        self.joints.iter().position(|joint| joint.contacts.contains(&k))
    }

    /// The index of a sliding joint's acceleration among the outputs.
    pub(super) fn sliding_output(&self, joint: usize) -> usize {
        self.mechanism.contacts.len() + joint
    }

    /// The index of the angular acceleration of a hinge with friction among the outputs; those of both components of
    /// its force follow.
    pub(super) fn turning_output(&self, hinge: usize) -> usize {
        self.outputs.base.len() - 3 * (self.hinges.len() - hinge)
    }

    /// Number of sliding joints and hinges with friction.
    pub(super) fn rubbing(&self) -> usize {
        self.joints.len() + self.hinges.len()
    }

    /// The number of a hinge with friction among the sliding joints and these.
    pub(super) fn number_of(&self, hinge: usize) -> usize {
        self.joints.len() + hinge
    }

    /// Whether one of the sliding joints and hinges with friction can stick.
    pub(super) fn may_stick(&self, number: usize) -> bool {
        self.joints.get(number).is_none_or(|joint| joint.has_friction)
    }

    /// The velocity of one of the sliding joints and hinges with friction (m/s); that of hinges in sizes of the mechanism.
    pub(super) fn velocity(&self, number: usize) -> f64 {
        let hinge = || self.hinges[number - self.joints.len()].velocity * self.units.length;
        self.joints.get(number).map_or_else(hinge, |joint| joint.velocity)
    }

    /// The change of this velocity with those of the bodies.
    pub(super) fn change(&self, number: usize, jumps: &DVector<f64>) -> f64 {
        let hinge = || self.hinges[number - self.joints.len()].acceleration(jumps) * self.units.length;
        self.joints.get(number).map_or_else(hinge, |joint| joint.row.change(jumps))
    }

    /// The units of one of the sliding joints and hinges with friction.
    pub(super) fn units_of_rubbing(&self, number: usize) -> Units {
        self.joints
            .get(number)
            .map_or_else(|| self.hinges[number - self.joints.len()].units, |joint| joint.units)
    }

    /// The joint of one of the sliding joints and hinges with friction.
    pub(super) fn id_of(&self, rubbing: usize) -> Option<JointId> {
        let hinge = || self.hinges.get(rubbing - self.joints.len()).map(|hinge| hinge.id);
        self.joints.get(rubbing).map_or_else(hinge, |joint| Some(joint.id))
    }

    /// The index of the acceleration of each gap of a sliding joint among the outputs.
    pub(super) fn gap_outputs(&self, joint: usize) -> Range<usize> {
        let gaps = |joints: &[SlidingJoint]| joints.iter().map(|joint| joint.gaps.len()).sum::<usize>();
        let couples = self.joints.iter().filter(|joint| joint.couple.is_some()).count();
        let first = self.mechanism.contacts.len() + self.joints.len() + couples + gaps(&self.joints[..joint]);
        first..first + self.joints[joint].gaps.len()
    }

    /// The index of each guided slider's couple among the outputs.
    pub(super) fn couple_outputs(&self) -> impl Iterator<Item = (usize, &SlidingJoint)> {
        let first = self.mechanism.contacts.len() + self.joints.len();
        let guided = self.joints.iter().filter(|joint| joint.couple.is_some());
        guided.enumerate().map(move |(index, joint)| (first + index, joint))
    }
}

fn wrong_count(what: &'static str, expected: usize, found: usize) -> Result<(), Faults> {
    if found == expected {
        return Ok(());
    }
    Err(Fault::general(FaultKind::WrongCount { what, expected, found }).into())
}

/// The contacts with the friction at their sliding speeds.
pub(super) fn contacts_at_speeds<'m>(
    mechanism: &'m Mechanism,
    configuration: &Configuration,
    equations: &KineticEquations,
) -> Result<Cow<'m, [Contact]>, Faults> {
    let mut contacts = Cow::Borrowed(&mechanism.contacts[..]);
    for k in (0..contacts.len()).filter(|&k| mechanism.contacts[k].depends_on_speed()) {
        let speed = equations.contacts[k].sliding_velocity.abs();
        contacts.to_mut()[k].mu =
            mechanism.friction_of(ContactId(k), speed, configuration.pieces.as_deref())?;
    }
    Ok(contacts)
}
