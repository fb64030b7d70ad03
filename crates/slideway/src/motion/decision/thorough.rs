//! Every state of joints and contacts is tried.

use super::holding::Holding;
use super::rules::{
    Continuation, Continuations, Decisions, EventInstant, HaltingImpulse, Hold, Outlook, Resting,
};
use super::separate::{self, separate};
use super::{halting, hinged};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::pattern::Phase;

impl Hold for Holding<'_> {
    fn outlook(&mut self, span: [f64; 2]) -> Result<Outlook, Faults> {
        self.outlook(span)
    }

    fn margin(&mut self, time: f64) -> Result<f64, Faults> {
        self.margin(time)
    }
}

/// Whether hinges have friction.
fn has_rough_hinges(mechanism: &Mechanism) -> bool {
    !mechanism.friction_circles.is_empty()
}

/// The decisions of this module: every state of joints and contacts is tried.
#[derive(Debug, Clone, Copy, Default)]
pub struct Thorough;

impl Decisions for Thorough {
    fn successors(&mut self, instant: &EventInstant<'_>) -> Result<Continuations, Faults> {
        continuations(instant)
    }

    fn tipping(&mut self, instant: &EventInstant<'_>) -> Result<Vec<JointId>, Faults> {
        let found = super::continuations(instant)?;
        Ok(found.tipping.into_iter().flat_map(|tipping| tipping.joints).collect())
    }

    fn jam(&mut self, instant: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults> {
        match separate(instant.mechanism) {
            Some(parts) => separate::jam(&parts, instant, continuations, halting_impulse),
            None => halting_impulse(instant),
        }
    }

    fn sticking_margin(
        &mut self,
        mechanism: &Mechanism,
        configuration: &Configuration,
        phase: &Phase,
    ) -> Result<f64, Faults> {
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
        if !has_rough_hinges(mechanism) {
            return Ok(Some(Box::new(Holding::new(mechanism, configuration, resting)?)));
        }
        let mut of = [resting.bodies.to_vec(), vec![false; resting.bodies.len()]];
        for part in separate(mechanism).unwrap_or_default().iter().filter(|part| !part.is_rough()) {
            part.part
                .bodies
                .iter()
                .for_each(|body| of[1][body.index()] = std::mem::take(&mut of[0][body.index()]));
        }
        let [rough, smooth] = of.each_ref().map(|bodies| Resting { bodies, ..resting });
        let forever = hinged::hold(mechanism, configuration, rough);
        if forever.is_none() || !smooth.bodies.contains(&true) {
            return Ok(forever);
        }
        Ok(Some(Box::new(Holding::new(mechanism, configuration, smooth)?)))
    }
}

/// The phases in which a mechanism can go on, taken as a whole.
fn continuations(instant: &EventInstant<'_>) -> Result<Continuations, Faults> {
    let found = super::continuations(instant)?;
    let one = |successor: super::Successor| Continuation {
        phase: successor.phase,
        verdict: successor.attainability.verdict,
        continues: successor.continues,
    };
    Ok(Continuations { left_out: !found.complete, list: found.list.into_iter().map(one).collect() })
}

fn halting_impulse(instant: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults> {
    if has_rough_hinges(instant.mechanism) {
        return halting::halting_impulse(instant);
    }
    let super::Jam::Stops(impulses) = super::jam(instant.mechanism, instant.configuration)? else {
        return Ok(None);
    };
    let first = impulses.into_iter().next();
    Ok(first.map(|impulse| HaltingImpulse {
        velocities: impulse.after.velocities,
        energy_lost: impulse.energy_lost,
    }))
}
