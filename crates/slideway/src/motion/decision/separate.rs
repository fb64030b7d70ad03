//! Parts of a mechanism that have nothing to do with one another. Beside hinges with friction each is decided by itself, so
//! that none changes what is decided of another; parts without such hinges are decided as mechanisms of their own.

use super::impact::Impact;
use super::rules::{Continuation, Continuations, EventInstant, HaltingImpulse};
use super::successors::{MOST_COMBINATIONS, choices, severity};
use super::{hinged, successors};
use crate::configuration::{Configuration, Velocity};
use crate::fault::Faults;
use crate::ids::{BodyId, ContactId, JointId};
use crate::mechanism::{Mechanism, Part};
use crate::modes::Side;
use crate::motion::moving::equations::independent;
use crate::pattern::phase::sliding_joints;
use crate::pattern::{ContactPhase, HingePhase, JointPhase, Phase};
use crate::report::Verdict;

/// A part, and which sliding joints and hinges with friction of the whole it has.
pub(super) struct Separate {
    pub(super) part: Part,
    sliders: Vec<usize>,
    hinges: Vec<usize>,
}

/// The parts in which something can slide, or turn with friction; nothing where there are no hinges with friction, or
/// everything is one part.
pub(super) fn separate(mechanism: &Mechanism) -> Option<Vec<Separate>> {
    if mechanism.friction_circles.is_empty() || !mechanism.excess.contacts.is_empty() {
        return None;
    }
    let numbers = independent(mechanism);
    let all = (0..mechanism.bodies.len())
        .filter(|body| numbers[..*body].iter().all(|other| *other != numbers[*body]));
    let bodies = all.map(|first| {
        (first..numbers.len()).filter(|body| numbers[*body] == numbers[first]).map(BodyId).collect()
    });
    let parts: Vec<Separate> = bodies.map(|bodies| Separate::new(mechanism, bodies)).collect();
    let moving: Vec<Separate> =
        parts.into_iter().filter(|part| part.sliders.len() + part.hinges.len() > 0).collect();
    (moving.len() > 1).then_some(moving)
}

impl Separate {
    fn new(whole: &Mechanism, bodies: Vec<BodyId>) -> Self {
        let part = Part::new(whole, bodies);
        let sliders = sliding_joints(whole).into_iter().enumerate();
        let circles = whole.friction_circles.iter().enumerate();
        Self {
            sliders: sliders
                .filter(|(_, joint)| part.joints.contains(joint))
                .map(|(index, _)| index)
                .collect(),
            hinges: {
                circles
                    .filter(|(_, circle)| part.joints.contains(&circle.joint))
                    .map(|(index, _)| index)
                    .collect()
            },
            part,
        }
    }

    /// Whether hinges of it have friction.
    pub(super) fn is_rough(&self) -> bool {
        !self.hinges.is_empty()
    }

    /// The part in a configuration of the whole.
    pub(super) fn configuration(&self, whole: &Configuration) -> Configuration {
        let bodies = || self.part.bodies.iter().map(|body| body.index());
        Configuration {
            poses: bodies().map(|body| whole.poses[body]).collect(),
            velocities: bodies().map(|body| whole.velocities[body]).collect(),
            ..whole.clone()
        }
    }

    /// What it does in a phase of the whole.
    pub(super) fn phase(&self, whole: &Phase) -> Phase {
        Phase {
            joints: self.sliders.iter().map(|joint| whole.joints[*joint]).collect(),
            contacts: self.part.contacts.iter().map(|contact| whole.contacts[contact.index()]).collect(),
            hinges: self.hinges.iter().map(|hinge| whole.hinges[*hinge]).collect(),
        }
    }

    /// Puts what it does into a phase of the whole.
    fn put(&self, phase: &Phase, whole: &mut Phase) {
        self.sliders.iter().zip(&phase.joints).for_each(|(joint, does)| whole.joints[*joint] = *does);
        let contacts = self.part.contacts.iter().zip(&phase.contacts);
        contacts.for_each(|(contact, does)| whole.contacts[contact.index()] = *does);
        self.hinges.iter().zip(&phase.hinges).for_each(|(hinge, does)| whole.hinges[*hinge] = *does);
    }

    /// Asks about it at the instant of an event of the whole.
    pub(super) fn at<T>(&self, whole: &EventInstant<'_>, ask: impl FnOnce(&EventInstant<'_>) -> T) -> T {
        let signs: Vec<f64> = self.sliders.iter().map(|joint| whole.signs[*joint]).collect();
        let spins: Vec<f64> = self.hinges.iter().map(|hinge| whole.spins[*hinge]).collect();
        let contacts = self.part.contacts.iter().enumerate();
        let zero: Vec<ContactId> =
            contacts.filter(|(_, id)| whole.zero.contains(id)).map(|(index, _)| ContactId(index)).collect();
        let bodies = self.part.bodies.iter();
        let rounding: Vec<f64> =
            bodies.filter_map(|body| whole.rounding.get(body.index()).copied()).collect();
        let (configuration, previous) =
            (self.configuration(whole.configuration), whole.previous.map(|phase| self.phase(phase)));
        ask(&EventInstant {
            mechanism: &self.part.mechanism,
            configuration: &configuration,
            signs: &signs,
            spins: &spins,
            zero: &zero,
            rounding: &rounding,
            previous: previous.as_ref(),
            work: whole.work,
        })
    }

    /// A joint of it by its number in the whole.
    pub(super) fn in_whole(&self, joint: JointId) -> JointId {
        self.part.joints[joint.index()]
    }

    /// Puts the velocities of its bodies among those of the whole.
    fn put_velocities(&self, of_part: &[Velocity], whole: &mut [Velocity]) {
        self.part.bodies.iter().zip(of_part).for_each(|(body, velocity)| whole[body.index()] = *velocity);
    }
}

/// The phases in which parts can go on together. One in which nothing happens goes on as before, unless that is true of all.
///
/// # Errors
/// Those of a part.
pub(super) fn continuations(
    parts: &[Separate],
    event: &EventInstant<'_>,
    mut decide: impl FnMut(&EventInstant<'_>) -> Result<Continuations, Faults>,
) -> Result<Continuations, Faults> {
    let goes_on = |part: &Separate| part.at(event, |event| is_undisturbed(part, event));
    let undisturbed: Vec<bool> = parts.iter().map(goes_on).collect::<Result<_, _>>()?;
    let nothing_happens = undisturbed.iter().all(|undisturbed| *undisturbed);
    let mut found = Continuations::default();
    let mut lists: Vec<Vec<Continuation>> = Vec::with_capacity(parts.len());
    for (part, undisturbed) in parts.iter().zip(undisturbed) {
        let goes_on = event.previous.filter(|_| undisturbed && !nothing_happens);
        lists.push(if let Some(previous) = goes_on {
            vec![Continuation { phase: part.phase(previous), verdict: Verdict::NotComputed, continues: true }]
        } else {
            let Continuations { list, left_out } = part.at(event, &mut decide)?;
            found.left_out |= left_out;
            list
        });
    }
    let states = lists.iter().fold(1_usize, |product, list| product.saturating_mul(list.len()));
    let is_few = states <= MOST_COMBINATIONS;
    found.left_out |= !is_few;
    let in_order = || -> Vec<Vec<usize>> { lists.iter().map(|list| (0..list.len()).collect()).collect() };
    let order = if is_few { None } else { Some(in_order()) };
    let choices = choices(&lists, order.as_deref());
    found.list = choices.into_iter().map(|chosen| together((parts, &lists), event, &chosen)).collect();
    Ok(found)
}

/// One phase of the whole of one of each part.
fn together(
    (parts, lists): (&[Separate], &[Vec<Continuation>]),
    event: &EventInstant<'_>,
    chosen: &[usize],
) -> Continuation {
    let mut whole = Continuation { phase: any_phase(event), verdict: Verdict::NotComputed, continues: true };
    for ((part, list), number) in parts.iter().zip(lists).zip(chosen) {
        let Continuation { phase, verdict, continues } = &list[*number];
        part.put(phase, &mut whole.phase);
        if severity(*verdict) > severity(whole.verdict) {
            whole.verdict = *verdict;
        }
        whole.continues &= continues;
    }
    whole
}

/// A phase to be filled in.
fn any_phase(event: &EventInstant<'_>) -> Phase {
    let hinge = HingePhase { state: JointPhase::Sticking, force: [0.0; 2] };
    Phase {
        joints: vec![JointPhase::Sticking; event.signs.len()],
        contacts: vec![ContactPhase::Pressed(Side::Positive); event.mechanism.contacts.len()],
        hinges: vec![hinge; event.spins.len()],
    }
}

/// Whether nothing happens in a part: nothing has just stopped or reversed there, and what it did is at no boundary.
fn is_undisturbed(part: &Separate, event: &EventInstant<'_>) -> Result<bool, Faults> {
    if !event.zero.is_empty() {
        return Ok(false);
    }
    if part.is_rough() { hinged::is_undisturbed(event) } else { successors::is_undisturbed(event) }
}

/// The impulse of the first part that cannot go on.
///
/// # Errors
/// Those of a part.
pub(super) fn jam(
    parts: &[Separate],
    event: &EventInstant<'_>,
    mut decide: impl FnMut(&EventInstant<'_>) -> Result<Continuations, Faults>,
    mut halt: impl FnMut(&EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults>,
) -> Result<Option<HaltingImpulse>, Faults> {
    for part in parts {
        if !part.at(event, &mut decide)?.list.is_empty() {
            continue;
        }
        let Some(impulse) = part.at(event, &mut halt)? else { return Ok(None) };
        let mut velocities = event.configuration.velocities.clone();
        part.put_velocities(&impulse.velocities, &mut velocities);
        return Ok(Some(HaltingImpulse { velocities, ..impulse }));
    }
    Ok(None)
}

/// The impacts of parts, each by itself.
///
/// # Errors
/// Those of a part.
pub(super) fn impact(
    parts: &[Separate],
    (mechanism, configuration): (&Mechanism, &Configuration),
    stops: &[(JointId, f64)],
    mut impact: impl FnMut(&Mechanism, &Configuration, &[(JointId, f64)]) -> Result<Impact, Faults>,
) -> Result<Impact, Faults> {
    let mut whole = Impact { after: configuration.clone(), blows: Vec::new() };
    for part in parts {
        let joint = |joint: &JointId| part.part.joints.iter().position(|other| other == joint).map(JointId);
        let own: Vec<(JointId, f64)> =
            stops.iter().filter_map(|(id, restitution)| Some((joint(id)?, *restitution))).collect();
        if own.is_empty() {
            continue;
        }
        let found = impact(&part.part.mechanism, &part.configuration(configuration), &own)?;
        part.put_velocities(&found.after.velocities, &mut whole.after.velocities);
        for mut blow in found.blows {
            blow.stops.iter_mut().for_each(|(joint, _)| *joint = part.in_whole(*joint));
            whole.blows.push(blow);
        }
    }
    whole.after.measure(mechanism);
    Ok(whole)
}
