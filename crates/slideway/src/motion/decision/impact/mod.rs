//! Impacts on faces and on end stops: the impulses of contacts whose gaps close, with friction impulses at all sliding joints and
//! turning hinges.
//!
//! What is asked of an impact is here; its course is in `course.rs`.

mod course;

use super::impulse::AT_REST;
use super::joints::TOUCHES;
use super::lifting::least_flights;
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, JointId};
use crate::mechanism::{EndStop, Mechanism};
use crate::model::SliderKind;
use crate::motion::moving::connected::parts_of_contacts;
use crate::motion::moving::energy::kinetic;
use crate::motion::options::ImpactLaw;
use crate::progress::Work;
use course::Impact as Course;

/// The effect of an impact on end stops.
#[derive(Debug, Clone)]
pub struct Impact {
    /// The mechanism afterwards: the same positions, new velocities.
    pub after: Configuration,
    /// The blows, one for each set of joints that are connected with one another; they are independent.
    pub blows: Vec<Blow>,
}

/// The impact of joints that act on one another.
#[derive(Debug, Clone)]
pub struct Blow {
    /// The joints, each with the impulse with which its stop pushes (N s).
    pub stops: Vec<(JointId, f64)>,
    /// Kinetic energy before minus kinetic energy afterwards (J).
    pub energy_lost: f64,
}

/// The impact of sliding joints that move towards end stops, each with Newton's coefficient of restitution
/// `e`: its sliding velocity changes from `v` to `-e v`, or less: the impact is over at latest when the stops have
/// returned the work that they have taken, so that kinetic energy never grows.
///
/// A stop is a face across the centre line of the guide, without friction, which the middle of the block may leave. It pushes with
/// an impulse `P` that grows during the impact (E. J. Routh, Dynamics of a System of Rigid Bodies, Elementary Part, chapter IV). Loads
/// and preloads are negligible; meanwhile velocities change according to
///
/// ```text
/// M v' - G^T Lambda' - B U' - sum_k W_k Phi_k' - sum_j e_j K_j' = sum_i W_stop,i P_i'      G v' = 0      C v' = 0      P_i' >= 0
/// Phi_k' = mu_k |Lambda_k'| s_k of joints that slide,    |Phi_k'| <= mu_static_k |Lambda_k'| of those at rest that stay so
/// K_j' = -r_j |R_j'| sgn(omega_j) of hinges that turn,   |K_j'| <= r_static_j |R_j'| of those at rest that stay so
/// ```
///
/// which is the mode problem of impulses. It is constant until a sliding or angular velocity reaches zero, and is then
/// decided anew. A joint slides first against its stop and then away from it, so its friction reverses within
/// the impact. If there are several possible answers, the one with the greatest margin is used; where hinges turn with
/// friction, that in which more of what is at rest stays so. Coefficients of friction are those at the velocities before the impact.
///
/// Where pushing makes a joint faster towards its stop, since friction of another turns it round, that goes on until a
/// sliding or angular velocity reaches zero. Where no impulse of the stop is possible friction wedges the mechanism, as in
/// a [`jam`](super::jam()), and what comes to rest so is not thrown back.
///
/// Stops that are reached together act together: the velocities `v_i` towards them change to `-e_i v_i` in
/// proportion. A stop may also exert no impulse, if the others move its joint away from it at least as fast:
/// `P_i >= 0` and `-w_i >= e_i v_i` for the velocity `w_i` afterwards are complementary (J. J. Moreau). Where they would return
/// more work than they have taken, all `e_i` are reduced in proportion until they return as much.
/// Without friction this is a linear complementarity problem with a unique outcome, which removes a kinetic
/// energy of `sum_i P_i (1 - e_i) v_i/2`. All choices of the stops that push are tried.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, more states than are
/// tried, an impact in which friction leaves the stops no impulse, one in which a guided slider would tip, and one with several
/// possible outcomes.
pub fn impact(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stops: &[(JointId, f64)],
) -> Result<Impact, Faults> {
    impact_within(mechanism, configuration, stops, Work::undisturbed())
}

/// The same in work that may end: then it comes to nothing.
///
/// # Errors
/// As [`impact`].
pub(in crate::motion) fn impact_within(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stops: &[(JointId, f64)],
    work: Work<'_>,
) -> Result<Impact, Faults> {
    mechanism.check_no_one_sided("an impact on an end stop")?;
    let (whole, ends) = mechanism.with_faces_of_stops();
    let mut whole = whole.into_owned();
    for (contact, EndStop { joint, .. }) in whole.contacts[mechanism.contacts.len()..].iter_mut().zip(&ends) {
        let given = stops.iter().find(|(given, _)| given == joint);
        given.iter().for_each(|(_, restitution)| contact.restitution = *restitution);
    }
    let faces = mechanism.contacts.len();
    let Landing { after, blows } = landing((&whole, faces), configuration, ImpactLaw::Course, work)?;
    let blow = |found: FaceBlow| Blow {
        stops: found.of_stops(mechanism, &ends).map(|(stop, impulse)| (stop.joint, impulse)).collect(),
        energy_lost: found.energy_lost,
    };
    Ok(Impact { after, blows: blows.into_iter().map(blow).collect() })
}

/// The state after an impact, and its blows.
#[derive(Debug, Clone)]
pub(in crate::motion) struct Landing {
    pub(in crate::motion) after: Configuration,
    /// One for each set of bodies that are connected; they are independent.
    pub(in crate::motion) blows: Vec<FaceBlow>,
}

/// The impact of contacts between bodies that are connected.
#[derive(Debug, Clone)]
pub(in crate::motion) struct FaceBlow {
    /// The contacts whose gaps have closed, each with its impulse (N s).
    pub(in crate::motion) contacts: Vec<(ContactId, f64)>,
    /// Kinetic energy before minus kinetic energy afterwards (J).
    pub(in crate::motion) energy_lost: f64,
}

impl FaceBlow {
    /// Its end stops, each with its impulse (N s): their contacts are behind those of the mechanism.
    pub(in crate::motion) fn of_stops(
        &self,
        mechanism: &Mechanism,
        stops: &[EndStop],
    ) -> impl Iterator<Item = (EndStop, f64)> {
        let own = mechanism.contacts.len();
        let of_stops = self.contacts.iter().filter(move |(contact, _)| contact.index() >= own);
        of_stops.map(move |(contact, impulse)| (stops[contact.index() - own], *impulse))
    }
}

/// The impact of the contacts whose gaps are zero and close, of a mechanism whose end stops are contacts from a number on: what rests
/// at its stop stays or leaves like any joint at rest.
///
/// # Errors
/// Two sliders that are pressed by nothing, an impact that friction turns into a jam, one in which a guided slider would tip, one
/// with several outcomes, more states than are tried.
pub(in crate::motion) fn landing(
    (mechanism, first_stop): (&Mechanism, usize),
    configuration: &Configuration,
    law: ImpactLaw,
    work: Work<'_>,
) -> Result<Landing, Faults> {
    let touching = rates(mechanism, configuration);
    let fastest = touching.iter().map(|(_, rate)| rate.abs()).fold(0.0, f64::max);
    let parts = parts_of_contacts(mechanism);
    let takes_part = |(k, rate): &&(usize, f64)| *k < first_stop || *rate < -AT_REST * fastest;
    let mut left: Vec<usize> = touching.iter().filter(takes_part).map(|(k, _)| *k).collect();
    let mut found = Landing { after: configuration.clone(), blows: Vec::new() };
    for &(contact, rate) in &touching {
        if rate >= -AT_REST * fastest || !left.contains(&contact) {
            continue;
        }
        let (own, others) = left.into_iter().partition(|k| parts[*k] == parts[contact]);
        left = others;
        let before = found.after.clone();
        let course = Course::new(mechanism, &before, (own, law, work));
        let (after, impulses) = followed(course)?;
        let energy_lost = kinetic(mechanism, &before) - kinetic(mechanism, &after);
        let closes = |(k, _): &(usize, f64)| {
            touching.iter().any(|(other, rate)| other == k && *rate < -AT_REST * fastest)
        };
        let contacts = impulses.into_iter().filter(closes).map(|(k, impulse)| (ContactId(k), impulse));
        found.blows.push(FaceBlow { contacts: contacts.collect(), energy_lost });
        found.after = after;
    }
    Ok(found)
}

/// The outcome of an impact in which what would leave for a flight that rounding of places hides has come to rest.
fn followed(mut course: Course<'_>) -> Result<(Configuration, Vec<(usize, f64)>), Faults> {
    let least = least_flights(course.mechanism, course.before)?;
    loop {
        let after = match course.outcome() {
            Err(faults) => return Err(tipping(course, faults)),
            Ok(after) => after,
        };
        let flies = rates(course.mechanism, &after.configuration);
        let rests = |(k, rate): &(usize, f64)| {
            course.own.contains(k) && !course.resting.contains(k) && *rate > 0.0 && *rate <= least[*k]
        };
        let further: Vec<usize> = flies.into_iter().filter(rests).map(|(k, _)| k).collect();
        if further.is_empty() {
            return Ok((after.configuration, after.impulses));
        }
        course.resting.extend(further);
    }
}

/// What keeps an impact from having an outcome: guided sliders that would tip, each that does so by itself, else all that do so
/// together.
fn tipping(mut course: Course<'_>, faults: Faults) -> Faults {
    let Some(joints) = faults.sorted().iter().find_map(|fault| match &fault.kind {
        FaultKind::ImpactWedges { joints } => Some(joints.clone()),
        _ => None,
    }) else {
        return faults;
    };
    let mechanism = course.mechanism;
    let guided = mechanism.sliders().filter(|(_, slider)| slider.kind == SliderKind::Guided);
    let guided: Vec<JointId> = guided.map(|(joint, _)| joint).collect();
    let mut tips = |upright: &[JointId]| {
        course.upright = upright.to_vec();
        course.outcome().is_ok()
    };
    let alone: Vec<JointId> = guided.iter().copied().filter(|joint| tips(&[*joint])).collect();
    let all = if alone.is_empty() && tips(&guided) { guided } else { alone };
    if all.is_empty() {
        return faults;
    }
    let tipping = all.iter().map(|joint| mechanism.joints[joint.index()].name.to_string()).collect();
    Fault::general(FaultKind::ImpactTips { joints, tipping }).into()
}

/// The contacts whose gaps are zero, with the rates of these (m/s).
fn rates(mechanism: &Mechanism, configuration: &Configuration) -> Vec<(usize, f64)> {
    let gaps = mechanism.one_sided().map(|contact| (contact.index(), configuration.gap(mechanism, contact)));
    let touching = gaps.filter(|(_, [gap, _])| *gap <= TOUCHES * mechanism.size);
    touching.map(|(k, [_, rate])| (k, rate)).collect()
}
