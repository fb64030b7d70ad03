//! Impacts of contacts that may lift off and have reached their faces, without restitution.
//!
//! ```text
//! pushes   N_i' >= 0, the rate of its gap goes to zero         is left   N_i = 0, the rate of its gap ends at zero or above
//! ```
//!
//! Each set of contacts that are left is tried, with the mechanism as it touches without them. The contacts that push are rows
//! of it, and the rates of their gaps go to zero in proportion; what belongs to that without friction stands in the place of the
//! loads, and friction is that of [`impulses`](super::super::impulse). This lasts until something that slides stops, and is then
//! decided anew. A contact that would leave for a flight which rounding of places hides has come to rest: the rate of its gap
//! goes to zero, too.

use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::ContactId;
use crate::mechanism::Mechanism;
use crate::motion::decision::assessment::Assessment;
use crate::motion::decision::impulse::{AT_REST, Impulses};
use crate::motion::decision::instant::Instant;
use crate::motion::decision::joints::TOUCHES;
use crate::motion::decision::lifting::{Touching, least_flight, subsets};
use crate::motion::decision::parts::SAME;
use crate::motion::moving::energy::kinetic;
use crate::pattern::{ContactPhase, JointPhase};
use crate::progress::Work;
use nalgebra::DVector;

/// The state after an impact, and the kinetic energy that is lost (J).
#[derive(Debug, Clone)]
pub(in crate::motion) struct Landing {
    pub(in crate::motion) after: Configuration,
    pub(in crate::motion) energy_lost: f64,
}

/// How velocities change until all gaps that close have ceased to, or something stops.
struct Part {
    /// The jumps of all velocities of the bodies.
    jumps: DVector<f64>,
    /// The part of the whole change after which something stops that has slid; at most one.
    length: f64,
}

/// The impact of the contacts whose gaps are zero and close.
///
/// # Errors
/// Two sliders that are pressed by nothing, an impact that friction turns into a jam, one with several outcomes, more states than
/// are tried.
pub(in crate::motion) fn landing(
    mechanism: &Mechanism,
    configuration: &Configuration,
    work: Work<'_>,
) -> Result<Landing, Faults> {
    let least = least_flight(mechanism, configuration)?;
    let mut resting = Vec::new();
    loop {
        let after = course(mechanism, configuration, (&resting, work))?;
        let rests = |(k, rate): &(usize, f64)| !resting.contains(k) && *rate > 0.0 && *rate <= least;
        let further: Vec<usize> =
            rates(mechanism, &after).into_iter().filter(rests).map(|(k, _)| k).collect();
        if further.is_empty() {
            let energy_lost = kinetic(mechanism, configuration) - kinetic(mechanism, &after);
            return Ok(Landing { after, energy_lost });
        }
        resting.extend(further);
    }
}

/// The contacts whose gaps are zero, with the rates of these (m/s).
fn rates(mechanism: &Mechanism, configuration: &Configuration) -> Vec<(usize, f64)> {
    let gaps = mechanism.one_sided().map(|contact| (contact.index(), configuration.gap(mechanism, contact)));
    let touching = gaps.filter(|(_, [gap, _])| *gap <= TOUCHES * mechanism.size);
    touching.map(|(k, [_, rate])| (k, rate)).collect()
}

/// The state after an impact in which some contacts come to rest.
fn course(
    mechanism: &Mechanism,
    configuration: &Configuration,
    (resting, work): (&[usize], Work<'_>),
) -> Result<Configuration, Faults> {
    let mut after = configuration.clone();
    let fastest = rates(mechanism, configuration).iter().map(|(_, rate)| rate.abs()).fold(0.0, f64::max);
    for _ in 0..4 * mechanism.joints.len() + 2 {
        let touching = rates(mechanism, &after);
        let is_over = |(k, rate): &(usize, f64)| {
            let ends = if resting.contains(k) { -rate.abs() } else { *rate };
            ends >= -AT_REST * fastest
        };
        if touching.iter().all(is_over) {
            return Ok(after);
        }
        let part = part(mechanism, &after, (&touching, resting, work))?;
        after = moved(&after, &part, mechanism);
    }
    Err(wedges(mechanism, &rates(mechanism, &after)))
}

fn moved(configuration: &Configuration, part: &Part, mechanism: &Mechanism) -> Configuration {
    let mut after = super::super::impulse::jumped(configuration, part.jumps.as_slice(), part.length);
    after.measure(mechanism);
    after
}

fn names(mechanism: &Mechanism, touching: &[(usize, f64)]) -> Vec<String> {
    let closing = touching.iter().any(|(_, rate)| *rate < 0.0);
    let named = touching.iter().filter(|(_, rate)| *rate < 0.0 || !closing);
    named.map(|(k, _)| mechanism.contacts[*k].name.to_string()).collect()
}

fn wedges(mechanism: &Mechanism, touching: &[(usize, f64)]) -> Faults {
    Fault::general(FaultKind::ImpactWedges { joints: names(mechanism, touching) }).into()
}

/// The next part of an impact, the only one over all sets of contacts that are left.
fn part(
    mechanism: &Mechanism,
    configuration: &Configuration,
    (touching, resting, work): (&[(usize, f64)], &[usize], Work<'_>),
) -> Result<Part, Faults> {
    let all: Vec<usize> = mechanism.one_sided().map(ContactId::index).collect();
    let apart = all.into_iter().filter(|k| !touching.iter().any(|(other, _)| other == k));
    let apart: Vec<usize> = apart.collect();
    let options: Vec<usize> = touching.iter().map(|(k, _)| *k).filter(|k| !resting.contains(k)).collect();
    let mut found: Vec<Part> = Vec::new();
    for left in subsets(&options)? {
        let other = Touching::new(mechanism, &apart, &left);
        let other = part_with(&other, configuration, (touching, resting, work))?;
        let bodies = 3 * mechanism.bodies.len();
        let differs = |part: &Part, other: &Part| {
            let [one, other] = [part, other].map(|part| part.jumps.rows(0, bodies).into_owned());
            (&one - &other).amax() > SAME * one.amax().max(other.amax())
        };
        for other in other {
            if found.iter().all(|part| differs(part, &other)) {
                found.push(other);
            }
        }
    }
    if found.len() > 1 {
        return Err(Fault::general(FaultKind::SeveralImpacts { joints: names(mechanism, touching) }).into());
    }
    found.pop().ok_or_else(|| wedges(mechanism, touching))
}

/// The parts with a set of contacts that are left.
fn part_with(
    touching: &Touching<'_>,
    configuration: &Configuration,
    (rates, resting, work): (&[(usize, f64)], &[usize], Work<'_>),
) -> Result<Vec<Part>, Faults> {
    let mechanism = &touching.mechanism;
    let instant = Instant::new(mechanism, configuration)?;
    let rate_of = |k: usize| rates.iter().find(|(other, _)| *other == k).map_or(0.0, |(_, rate)| *rate);
    // The jumps without friction: the gaps of what pushes cease to close.
    let mut base = DVector::zeros(instant.influence.frictionless.len());
    let answers = instant.equations.gap_accelerations();
    for (contact, answer) in mechanism.one_sided().zip(answers) {
        base.axpy(-rate_of(touching.number(contact)), &answer, 1.0);
    }
    let fastest = rates.iter().map(|(_, rate)| rate.abs()).fold(0.0, f64::max);
    let mut impulses = Impulses::new(&instant, work);
    impulses.count_velocities_of(fastest);
    let velocities = impulses.velocities();
    let stopped: Vec<bool> = velocities.iter().map(|velocity| *velocity == 0.0).collect();
    let rests = |k: usize| instant.joint_of(k).is_some_and(|joint| stopped[joint]);
    mechanism.check_no_disc_at_rest(rests)?;
    let gap = |joint: usize, number: usize| {
        let slider = mechanism.slider(instant.joints[joint].id);
        let gap = slider.and_then(|slider| configuration.gaps(mechanism, slider).nth(number));
        gap.map_or(0.0, |[_, rate]| rate)
    };
    impulses.put_base(&base, gap);
    let options: Vec<Vec<JointPhase>> =
        velocities.iter().enumerate().map(|(joint, velocity)| impulses.options(joint, *velocity)).collect();
    let mut question = impulses.question(&vec![0.0; velocities.len()], &stopped);
    for contact in mechanism.one_sided() {
        if !resting.contains(&touching.number(contact)) {
            question.sides[contact.index()] = ContactPhase::CLOSED.to_vec();
        }
    }
    let mut all: Vec<Option<Assessment>> = vec![None];
    for group in &instant.groups {
        let found = impulses.admissible(&question, &options, group)?;
        if found.unsolved > 0 {
            let joints = names(touching.whole, rates);
            return Err(Fault::general(FaultKind::UnsolvedImpact { joints }).into());
        }
        let with = |before: &Option<Assessment>| {
            let joined = found.list.iter().map(|one| match before {
                Some(before) => Some(before.clone().with(group, one)),
                None => Some(Assessment::nothing(&one.phase).with(group, one)),
            });
            joined.collect::<Vec<_>>()
        };
        all = all.iter().flat_map(with).collect();
    }
    let part = |state: Assessment| {
        let jumps = &base + impulses.jumps(&state);
        let until = |(number, velocity): (usize, &f64)| {
            let slides = state.phase.of(number) != JointPhase::Sticking && instant.may_stick(number);
            let part = -velocity / instant.change(number, &jumps);
            (slides && *velocity != 0.0 && part > 0.0).then_some(part)
        };
        let length = velocities.iter().enumerate().filter_map(until).fold(1.0, f64::min);
        Part { jumps, length }
    };
    Ok(all.into_iter().flatten().map(part).collect())
}
