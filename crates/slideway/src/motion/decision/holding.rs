//! Bodies that stand still while only their loads change.

use super::BOUNDARY;
use super::assessment::{Assessment, assess_group};
use super::instant::Instant;
use super::outputs::Group;
use super::plan::{Fall, GroupPattern, Plan};
use super::rules::{Outlook, Resting};
use super::sticking::{ENOUGH, NONE};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::motion::moving::amounts::Amounts;
use crate::motion::moving::equations::joint_rests;
use crate::pattern::{JointPhase, Phase};
use nalgebra::DVector;

/// Bodies that stand still in a phase: equations and influence coefficients are computed once.
pub(crate) struct Holding<'m> {
    instant: Instant<'m>,
    /// With the sides of the latest margin.
    phase: Phase,
    stopped: Vec<bool>,
    amounts: Amounts<'m>,
    /// The amounts of the loads at the time of the instant, and what one unit of each adds to the outputs.
    first: Vec<f64>,
    responses: Vec<DVector<f64>>,
    base: DVector<f64>,
    /// The groups of joints between these bodies, with forces that let them stick.
    plans: Vec<(Group, Option<Plan>)>,
}

impl<'m> Holding<'m> {
    /// The bodies of a mechanism that stand still, in the configuration in which they stay.
    ///
    /// # Errors
    /// As [`sticking_margin`](super::sticking_margin).
    pub(crate) fn new(
        mechanism: &'m Mechanism,
        configuration: &Configuration,
        Resting { phase, bodies: rests }: Resting<'_>,
    ) -> Result<Self, Faults> {
        let instant = Instant::looking_ahead(mechanism, configuration)?;
        instant.check(phase)?;
        let amounts = Amounts::new(mechanism, configuration, rests);
        let sticks = |joint: &usize| {
            phase.joints[*joint] == JointPhase::Sticking
                && joint_rests(mechanism, instant.joints[*joint].id, rests)
        };
        let groups = instant.groups.iter().filter(|group| group.joints.iter().any(sticks));
        let response = |load| {
            let unknowns = instant.equations.answer_to(mechanism, configuration, load)?;
            Ok(instant.response(&unknowns))
        };
        let responses: Result<Vec<DVector<f64>>, Faults> = amounts.units().map(response).collect();
        Ok(Self {
            stopped: vec![false; instant.rubbing()],
            first: amounts.at(configuration.time)?,
            responses: responses?,
            base: instant.outputs.base.clone(),
            plans: groups.map(|group| (group.clone(), None)).collect(),
            phase: phase.clone(),
            amounts,
            instant,
        })
    }

    /// [`sticking_margin`](super::sticking_margin) at a time, in the units of the first instant; sides that
    /// left enough friction at the latest time are tried first.
    ///
    /// # Errors
    /// Loads have no value.
    pub(crate) fn margin(&mut self, time: f64) -> Result<f64, Faults> {
        let amounts = self.amounts.at(time)?;
        let mut margin = f64::INFINITY;
        let groups: Vec<Group> = self.plans.iter().map(|(group, _)| group.clone()).collect();
        for group in groups {
            margin = margin.min(self.assess(&group, &amounts).map_or(NONE, |found| found.margin));
        }
        Ok(margin)
    }

    /// The unit of force of its margins (N), if all joints belong together.
    #[cfg(test)]
    pub(crate) fn unit(&self) -> f64 {
        self.instant.joints[0].units.force
    }

    /// What is known about a span of time.
    ///
    /// # Errors
    /// Loads have no value.
    pub(crate) fn outlook(&mut self, [from, until]: [f64; 2]) -> Result<Outlook, Faults> {
        let mut outlook = Outlook { proven: until, slips: false };
        for index in 0..self.plans.len() {
            let (group, plan) = (self.plans[index].0.clone(), self.plans[index].1.take());
            let (plan, found) = self.outlook_of(&group, plan, [from, outlook.proven])?;
            self.plans[index].1 = plan;
            if found.proven < outlook.proven || found.slips {
                outlook = found;
            }
        }
        Ok(outlook)
    }

    /// The same for a group of joints: a plan is followed as far as it is valid, then replaced by the one
    /// that leaves the most slack there.
    fn outlook_of(
        &mut self,
        group: &Group,
        plan: Option<Plan>,
        [from, until]: [f64; 2],
    ) -> Result<(Option<Plan>, Outlook), Faults> {
        let mut time = from;
        let first = match plan {
            Some(plan) => Some(plan),
            None => self.plan(group, from)?.filter(|plan| plan.margin() >= -BOUNDARY),
        };
        let Some(mut plan) = first else { return Ok((None, Outlook { proven: from, slips: false })) };
        let mut cells = 0;
        loop {
            let end = match plan.first_fall(&self.amounts, [time, until], &mut cells) {
                Fall::None => return Ok((Some(plan), Outlook { proven: until, slips: false })),
                Fall::Unknown(end) => return Ok((Some(plan), Outlook { proven: end, slips: false })),
                Fall::At(end) => end,
            };
            match self.plan(group, end)? {
                None => return Ok((None, Outlook { proven: end, slips: false })),
                Some(next) if next.margin() < -BOUNDARY => {
                    let slips = self.zero_before(group, next, [time, end])?;
                    return Ok((None, Outlook { proven: slips, slips: true }));
                }
                Some(next) => (plan, time) = (next, end),
            }
        }
    }

    /// Where the margin fell through zero before it was found to be negative: on the supporting plane of the
    /// margin, which for given sides is a concave function of the amounts, and onwards from there if that was
    /// not enough.
    fn zero_before(&mut self, group: &Group, plan: Plan, [from, end]: [f64; 2]) -> Result<f64, Faults> {
        let (mut plan, mut end) = (plan, end);
        loop {
            let zero = plan.zero_before(&self.amounts, [from, end])?;
            match self.plan(group, zero)? {
                Some(next) if next.margin() < plan.margin() / 2.0 && zero > from && zero < end => {
                    (plan, end) = (next, zero);
                }
                _ => return Ok(zero),
            }
        }
    }

    /// Forces of a group at a time, and how they vary with the amounts; `None` if there are none, or if a
    /// linear program was not solved.
    fn plan(&mut self, group: &Group, time: f64) -> Result<Option<Plan>, Faults> {
        let amounts = self.amounts.at(time)?;
        Ok(self.assess(group, &amounts).and_then(|found| {
            let system = GroupPattern { phase: &found.phase, group, stopped: &self.stopped };
            Plan::new(&mut self.instant, &system, (&amounts, &self.responses))
        }))
    }

    /// The sides of a group that leave the most slack, or enough, with these amounts of the loads.
    fn assess(&mut self, group: &Group, amounts: &[f64]) -> Option<Assessment> {
        self.instant.outputs.base.copy_from(&self.base);
        for ((amount, first), response) in amounts.iter().zip(&self.first).zip(&self.responses) {
            self.instant.outputs.base.axpy(amount - first, response, 1.0);
        }
        let question = self.instant.question(&self.stopped, Some(&self.phase));
        let found = assess_group(&self.instant, &question, (&self.phase, group), ENOUGH);
        let found = found.ok().flatten()?;
        for &k in &group.contacts {
            self.phase.contacts[k] = found.phase.contacts[k];
        }
        Some(found)
    }
}
