//! Every state of joints and contacts is tried.

use super::holding::Holding;
use super::jam::jam_within;
use super::lifting::Touching;
use super::rules::{
    Continuation, Continuations, Decisions, EventInstant, HaltingImpulse, Hold, Outlook, Resting,
};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::mechanism::{Mechanism, body_of};
use crate::motion::moving::amounts::Amounts;
use crate::motion::moving::equations::independent;
use crate::pattern::Phase;

impl Hold for Holding<'_> {
    fn outlook(&mut self, span: [f64; 2]) -> Result<Outlook, Faults> {
        self.outlook(span)
    }

    fn margin(&mut self, time: f64) -> Result<f64, Faults> {
        self.margin(time)
    }
}

/// The decisions of this module: every state of joints and contacts is tried.
#[derive(Debug, Clone, Copy, Default)]
pub struct Thorough;

impl Decisions for Thorough {
    fn successors(&mut self, instant: &EventInstant<'_>) -> Result<Continuations, Faults> {
        if instant.mechanism.has_one_sided() {
            return super::lifting::continuations(instant);
        }
        continuations(instant)
    }

    fn tipping(&mut self, instant: &EventInstant<'_>) -> Result<Vec<JointId>, Faults> {
        if instant.mechanism.has_one_sided() {
            return super::lifting::tipping(instant);
        }
        let found = super::continuations(instant)?;
        Ok(found.tipping.into_iter().flat_map(|tipping| tipping.joints).collect())
    }

    fn jam(&mut self, instant: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults> {
        if instant.mechanism.has_one_sided() {
            return super::lifting::jam(instant);
        }
        let rests = |number: usize| instant.sign_of(number) == 0.0;
        let found = jam_within(instant.mechanism, instant.configuration, (&rests, instant.work))?;
        let super::Jam::Stops(impulses) = found else { return Ok(None) };
        let blocked = super::continuations(instant)?.blocked;
        let stops = |impulse: &super::Impulse| blocked.is_empty() || blocked.contains(&impulse.wedged);
        Ok(impulses.into_iter().find(stops).map(HaltingImpulse::from))
    }

    fn sticking_margin(
        &mut self,
        mechanism: &Mechanism,
        configuration: &Configuration,
        phase: &Phase,
    ) -> Result<f64, Faults> {
        if mechanism.has_one_sided() {
            let touching = Touching::in_phase(mechanism, phase);
            return super::sticking_margin(&touching.mechanism, configuration, &touching.part_of(phase));
        }
        super::sticking_margin(mechanism, configuration, phase)
    }

    fn normal_forces(
        &mut self,
        mechanism: &Mechanism,
        configuration: &Configuration,
        phase: &Phase,
    ) -> Result<Vec<Option<f64>>, Faults> {
        let forces = super::determined_forces(mechanism, configuration, phase)?;
        Ok(forces.contacts.into_iter().map(|[normal, _]| normal).collect())
    }

    fn hold<'m>(
        &mut self,
        mechanism: &'m Mechanism,
        configuration: &Configuration,
        resting: Resting<'_>,
    ) -> Result<Option<Box<dyn Hold + 'm>>, Faults> {
        // Which contacts are open may change while bodies rest.
        if mechanism.has_one_sided() {
            return Ok(None);
        }
        // Friction of hinges is not affine in the loads: what has it is known to stay at rest if nothing changes.
        let parts = independent(mechanism);
        let circles = mechanism.friction_circles.iter();
        let rough: Vec<usize> = circles
            .filter_map(|circle| body_of(mechanism, circle.joint))
            .map(|body| parts[body.index()])
            .collect();
        let of = |is_rough: bool| -> Vec<bool> {
            let rests = resting.bodies.iter().zip(&parts);
            rests.map(|(rests, part)| *rests && rough.contains(part) == is_rough).collect()
        };
        if Amounts::new(mechanism, configuration, &of(true)).units().next().is_some() {
            return Ok(None);
        }
        let smooth = Resting { bodies: &of(false), ..resting };
        Ok(Some(Box::new(Holding::new(mechanism, configuration, smooth)?)))
    }
}

/// The phases in which a mechanism can go on.
fn continuations(instant: &EventInstant<'_>) -> Result<Continuations, Faults> {
    let found = super::continuations(instant)?;
    let one = |successor: super::Successor| Continuation {
        phase: successor.phase,
        verdict: successor.attainability.verdict,
        continues: successor.continues,
        impulse: None,
    };
    let left_out = !found.complete || !found.unsolved.is_empty();
    Ok(Continuations { left_out, list: found.list.into_iter().map(one).collect() })
}
