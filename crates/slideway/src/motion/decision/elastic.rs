//! Attainability of phases (theory, section 7): sticking joints are treated as locks.

use super::instant::Instant;
use crate::attainability::ElasticGuides;
use crate::configuration::Configuration;
use crate::ids::CoordinateId;
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::{Attachment, Coordinate, CoordinateKind, Drive, Effort, Mechanism, Quantity, Slider};
use crate::modes::ContactState;
use crate::pattern::{ContactPhase, JointPhase, Phase};
use crate::report::{Attainability, Verdict};
use crate::solve::mode_problem;
use nalgebra::DVector;
use std::borrow::Cow;

const STICKS: &str = "every joint sticks: no friction follows the normal forces";
const ROLLS: &str = "a disc rolls";
const IN_GAP: &str = "a contact is between its faces";
const OUT_OF_RANGE: &str = "a coefficient is beyond the range of floating point";

/// The attainability of a phase whose sides are known, without finding what an unattainable phase separates.
///
/// Sticking joints are locked at the middle of the block, as far as the locks are independent, and their
/// contacts have no friction there.
pub(super) fn attainability(
    instant: &Instant<'_>,
    configuration: &Configuration,
    phase: &Phase,
) -> Attainability {
    let ask = |guides: &ElasticGuides<'_>, states: &[ContactState]| guides.of(states);
    examine(instant, configuration, phase, ask)
        .unwrap_or_else(|reason| Attainability::without_eigenvalues(Verdict::NotComputed, reason))
}

/// The verdict on a phase that was followed; not computed where it has no equations.
pub(in crate::motion) fn verdict_on(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Verdict {
    let instant = Instant::looking_ahead(mechanism, configuration);
    instant.map_or(Verdict::NotComputed, |instant| verdict(&instant, configuration, phase))
}

/// Only the verdict of [`attainability`].
pub(super) fn verdict(instant: &Instant<'_>, configuration: &Configuration, phase: &Phase) -> Verdict {
    let ask = |guides: &ElasticGuides<'_>, states: &[ContactState]| guides.verdict_on(states);
    examine(instant, configuration, phase, ask).unwrap_or(Verdict::NotComputed)
}

/// Examines a phase with elastic guides, or gives the reason why there is no answer.
fn examine<T>(
    instant: &Instant<'_>,
    configuration: &Configuration,
    phase: &Phase,
    ask: impl Fn(&ElasticGuides<'_>, &[ContactState]) -> T,
) -> Result<T, &'static str> {
    let sticks = |joint: usize| phase.joints[joint] == JointPhase::Sticking;
    if !phase.joints.is_empty() && (0..phase.joints.len()).all(sticks) {
        return Err(STICKS);
    }
    let rolls = |joint: &usize| {
        sticks(*joint) && instant.mechanism.slider(instant.joints[*joint].id).is_some_and(Slider::is_disc)
    };
    if (0..phase.joints.len()).any(|joint| rolls(&joint)) {
        return Err(ROLLS);
    }
    let sliding_gap = (0..phase.contacts.len()).any(|k| {
        phase.contacts[k] == ContactPhase::PreloadGap
            && instant.joint_of(k).is_some_and(|joint| !sticks(joint))
    });
    if sliding_gap {
        return Err(IN_GAP);
    }
    let stuck = (0..phase.joints.len()).filter(|&joint| sticks(joint));
    let (mechanism, equations) = locked(instant, configuration, stuck);
    let influence = match &equations {
        Cow::Borrowed(_) => Cow::Borrowed(&instant.influence),
        Cow::Owned(equations) => Cow::Owned(Influence::new(equations)),
    };
    let signs =
        DVector::from_fn(phase.contacts.len(), |k, _| match instant.joint_of(k).map(|j| phase.joints[j]) {
            Some(JointPhase::Sliding(sign)) => sign,
            _ => 0.0,
        });
    let problem = mode_problem(&mechanism, &influence, &signs).map_err(|_| OUT_OF_RANGE)?;
    let states: Vec<ContactState> = phase
        .contacts
        .iter()
        .map(|contact| match contact {
            ContactPhase::Pressed(side) => ContactState::from(*side),
            ContactPhase::PreloadGap => ContactState::Positive,
        })
        .collect();
    Ok(ask(&ElasticGuides::new(&mechanism, &equations, &problem), &states))
}

/// The mechanism with these joints locked, as far as the locks are independent.
fn locked<'i>(
    instant: &'i Instant<'_>,
    configuration: &Configuration,
    stuck: impl Iterator<Item = usize>,
) -> (Cow<'i, Mechanism>, Cow<'i, KineticEquations>) {
    let mut found = (instant.mechanism_at_speeds(), Cow::Borrowed(&instant.equations));
    for joint in stuck {
        let id = instant.joints[joint].id;
        let Some(slider) = instant.mechanism.slider(id) else { continue };
        let mut mechanism = found.0.clone().into_owned();
        lock(&mut mechanism, slider, &instant.mechanism.joints[id.index()], id);
        if let Ok(equations) = KineticEquations::new(&mechanism, configuration) {
            found = (Cow::Owned(mechanism), Cow::Owned(equations));
        }
    }
    found
}

/// Locks a sliding joint by a force between block and guide along the centre line.
fn lock(
    mechanism: &mut Mechanism,
    slider: &Slider,
    joint: &crate::mechanism::Joint,
    id: crate::ids::JointId,
) {
    let coordinate = CoordinateId(mechanism.coordinates.len());
    mechanism.coordinates.push(Coordinate {
        name: joint.name.clone(),
        place: joint.place.clone(),
        kind: CoordinateKind::Slide(id),
        drawn_at: 0.0,
        value: 0.0,
        rate: 0.0,
    });
    mechanism.drives.push(Drive {
        name: joint.name.clone(),
        place: joint.place.clone(),
        coordinate,
        acceleration: Quantity::Constant(0.0),
        effort: Effort::Force {
            // A point of the guide on its centre line, so that the direction rotates with the guide.
            at: Attachment { frame: slider.guide, position: slider.at, z: slider.z },
            direction: -slider.tangent,
            turns: true,
            reaction: Some(slider.block),
        },
    });
}
