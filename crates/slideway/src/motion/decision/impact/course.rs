//! Impacts of contacts that may lift off and have reached their faces, along their course.
//!
//! ```text
//! pushes   N_i' >= 0, the rate of its gap goes to its end         is left   N_i = 0, the rate of its gap ends there or above
//! ```
//!
//! Where a contact has closed with the velocity `u`, the rate of its gap ends at `e u` with its coefficient of restitution
//! `e`, else at zero. Each set of contacts that are left is tried, with the mechanism as it touches without them. The contacts
//! that push are rows of it, and the rates of their gaps go to their ends in proportion; what belongs to that without friction
//! stands in the place of the loads, and friction is that of [`impulses`](super::super::impulse). This lasts until something
//! that slides stops, and is then decided anew. Where pushing makes gaps close faster, since friction turns it round, that goes
//! on until something stops. A contact that would leave for a flight which rounding of places hides has come to rest: the rate
//! of its gap goes to zero, too.
//!
//! By Moreau's law friction opposes the slip after the impact in place of that at each moment: then an impact is one such part,
//! with velocities afterwards in the place of their changes, and all its outcomes are found.
//!
//! The impact is over at latest when the contacts have returned the work that they have taken: where they would return more, all
//! `e` are reduced in proportion until they return as much, so that kinetic energy never grows.

use super::rates;
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, JointId};
use crate::kinetics::Reaction;
use crate::mechanism::{Mechanism, body_of};
use crate::motion::decision::assessment::{Assessment, PRESSED};
use crate::motion::decision::impulse::{AT_REST, Impulses, jumped};
use crate::motion::decision::instant::Instant;
use crate::motion::decision::jam::{Jam, jam_within};
use crate::motion::decision::lifting::{Touching, subsets};
use crate::motion::decision::outputs::Group;
use crate::motion::decision::parts::SAME;
use crate::motion::moving::connected::connected;
use crate::motion::moving::energy::kinetic;
use crate::motion::options::ImpactLaw;
use crate::pattern::JointPhase;
use crate::progress::Work;
use nalgebra::DVector;

/// An impact of bodies that are connected.
pub(super) struct Impact<'m> {
    pub(super) mechanism: &'m Mechanism,
    pub(super) before: &'m Configuration,
    /// The contacts whose gaps are zero.
    pub(super) own: Vec<usize>,
    /// For each joint whether it is one of bodies that are connected with those that collide.
    concerned: Vec<bool>,
    /// The greatest rate of their gaps before, beside which rates are rounding (m/s).
    fastest: f64,
    /// Of these those that come to rest at their faces.
    pub(super) resting: Vec<usize>,
    /// The guided sliders of which it does not count whether they would tip.
    pub(super) upright: Vec<JointId>,
    /// The part of all restitutions with which contacts leave their faces.
    part: f64,
    law: ImpactLaw,
    work: Work<'m>,
}

/// A contact whose gap is zero, along an impact.
#[derive(Clone, Copy)]
struct Touch {
    contact: usize,
    /// The rate of its gap (m/s).
    rate: f64,
    /// The rate with which the impact is over for it (m/s).
    end: f64,
}

/// The course of an impact until all gaps have the rates of its end.
pub(super) struct Course {
    pub(super) configuration: Configuration,
    /// Of the contacts whose gaps are zero, in their order (N s).
    pub(super) impulses: Vec<(usize, f64)>,
    /// The work that the contacts have returned, less what they have taken (J).
    returned: f64,
}

/// A change of velocities until the rates of all gaps that are pushed have their ends, or something stops.
struct Part {
    /// The jumps of all velocities of the bodies.
    jumps: DVector<f64>,
    /// The contacts that push.
    pushes: Vec<Push>,
    /// The part of the whole change after which something stops that has slid; infinite if the change has no end of its own, and
    /// nothing stops.
    length: f64,
}

/// A contact that pushes.
struct Push {
    contact: usize,
    /// Its normal impulse (N s).
    impulse: f64,
    sticks: bool,
}

/// Where the rates of the gaps of contacts that push go.
#[derive(Clone, Copy, PartialEq)]
enum Towards {
    /// To their ends.
    TheEnd,
    /// Away from them, since friction turns round what pushing does.
    Wedged,
}

impl<'m> Impact<'m> {
    /// The impact of these contacts, whose gaps are zero.
    pub(super) fn new(
        mechanism: &'m Mechanism,
        before: &'m Configuration,
        (own, law, work): (Vec<usize>, ImpactLaw, Work<'m>),
    ) -> Self {
        let (resting, upright) = (Vec::new(), Vec::new());
        let of_own = rates(mechanism, before).into_iter().filter(|(k, _)| own.contains(k));
        let fastest = of_own.map(|(_, rate)| rate.abs()).fold(0.0, f64::max);
        let parts = connected(mechanism);
        let part = |joint: JointId| body_of(mechanism, joint).map(|body| parts[body.index()]);
        let is_own = |joint| own.iter().any(|k| part(mechanism.contacts[*k].joint) == part(joint));
        let concerned = (0..mechanism.joints.len()).map(|joint| is_own(JointId(joint))).collect();
        Self { mechanism, before, own, concerned, fastest, resting, upright, part: 1.0, law, work }
    }

    /// The course in which contacts return no more work than they have taken.
    pub(super) fn outcome(&mut self) -> Result<Course, Faults> {
        self.part = 1.0;
        match self.course() {
            Ok(course) if course.returned <= 0.0 || self.law == ImpactLaw::Moreau => return Ok(course),
            Err(faults) if !self.bounces() => return Err(faults),
            _ => {}
        }
        self.part = 0.0;
        let (mut best, mut beyond) = (self.course()?, 1.0);
        let mut least = 0.0;
        for _ in 0..f64::MANTISSA_DIGITS {
            self.part = f64::midpoint(least, beyond);
            match self.course() {
                Ok(course) if course.returned <= 0.0 => (best, least) = (course, self.part),
                _ => beyond = self.part,
            }
        }
        Ok(best)
    }

    /// Returns whether a contact that closes has a restitution.
    fn bounces(&self) -> bool {
        self.law == ImpactLaw::Course && self.touches(self.before).iter().any(|touch| touch.end > 0.0)
    }

    /// The contacts whose gaps are zero.
    fn touches(&self, configuration: &Configuration) -> Vec<Touch> {
        let known = |rate: f64| if rate.abs() <= AT_REST * self.fastest { 0.0 } else { rate };
        let touch = |(contact, rate)| {
            let bounces = !self.resting.contains(&contact);
            let closed = (-known(self.before.gap(self.mechanism, ContactId(contact))[1])).max(0.0);
            let restitution = if bounces { self.mechanism.contacts[contact].restitution } else { 0.0 };
            Touch { contact, rate: known(rate), end: self.part * restitution * closed }
        };
        let own = rates(self.mechanism, configuration).into_iter().filter(|(k, _)| self.own.contains(k));
        own.map(touch).collect()
    }

    /// The course of the impact.
    fn course(&self) -> Result<Course, Faults> {
        let impulses = self.own.iter().map(|k| (*k, 0.0)).collect();
        let mut course = Course { configuration: self.before.clone(), impulses, returned: 0.0 };
        for _ in 0..4 * self.mechanism.joints.len() + 2 {
            let touches = self.touches(&course.configuration);
            let is_over = |touch: &Touch| {
                let short = touch.rate - touch.end;
                let short = if self.resting.contains(&touch.contact) { -short.abs() } else { short };
                short >= -AT_REST * self.fastest
            };
            if touches.iter().all(is_over) {
                return Ok(course);
            }
            if self.go_on(&mut course, &touches)? || self.law == ImpactLaw::Moreau {
                return Ok(course);
            }
        }
        Err(self.wedges(&self.touches(&course.configuration)))
    }

    /// Follows the next part of a course; returns whether the only contact has returned the work that it has taken, with which the
    /// course is over whatever its restitution.
    fn go_on(&self, course: &mut Course, touches: &[Touch]) -> Result<bool, Faults> {
        let mut part = self.part_of(&course.configuration, touches)?;
        let rate = |configuration: &Configuration, contact: usize| {
            configuration.gap(self.mechanism, ContactId(contact))[1]
        };
        let mut after = self.moved(&course.configuration, &part);
        let mut is_even = false;
        if let ([push], [_], ImpactLaw::Course) = (&part.pushes[..], &self.own[..], self.law) {
            let [from, to] = [&course.configuration, &after].map(|at| rate(at, push.contact));
            if let Some(even) = until_even(course.returned, push.impulse * part.length, [from, to]) {
                part.length *= even;
                after = self.moved(&course.configuration, &part);
                is_even = true;
            }
        }
        for Push { contact, impulse, .. } in &part.pushes {
            let mean = f64::midpoint(rate(&course.configuration, *contact), rate(&after, *contact));
            course.returned += impulse * part.length * mean;
            let own = course.impulses.iter_mut().find(|(k, _)| k == contact);
            own.into_iter().for_each(|(_, sum)| *sum += impulse * part.length);
        }
        if is_even {
            course.returned = 0.0;
        }
        course.configuration = after;
        Ok(is_even)
    }

    fn moved(&self, configuration: &Configuration, part: &Part) -> Configuration {
        let mut after = jumped(configuration, part.jumps.as_slice(), part.length);
        after.measure(self.mechanism);
        after
    }

    /// Returns whether a sliding joint or hinge takes part; what is not connected with it keeps its velocities.
    fn concerns(&self, instant: &Instant<'_>, number: usize) -> bool {
        instant.id_of(number).is_some_and(|joint| self.concerned[joint.index()])
    }

    fn names(&self, touches: &[Touch]) -> Vec<String> {
        let closing = touches.iter().any(|touch| touch.rate < 0.0);
        let named = touches.iter().filter(|touch| touch.rate < 0.0 || !closing);
        named.map(|touch| self.mechanism.contacts[touch.contact].name.to_string()).collect()
    }

    fn wedges(&self, touches: &[Touch]) -> Faults {
        Fault::general(FaultKind::ImpactWedges { joints: self.names(touches) }).into()
    }

    /// The next part of an impact, the only one over all sets of contacts that are left.
    fn part_of(&self, configuration: &Configuration, touches: &[Touch]) -> Result<Part, Faults> {
        let touch = |k: &usize| touches.iter().any(|touch| touch.contact == *k);
        let apart: Vec<usize> =
            self.mechanism.one_sided().map(ContactId::index).filter(|k| !touch(k)).collect();
        let options = touches.iter().map(|touch| touch.contact).filter(|k| !self.resting.contains(k));
        let sets = subsets(&options.collect::<Vec<_>>())?;
        for &towards in self.ways() {
            let mut found: Vec<Part> = Vec::new();
            for left in &sets {
                let touching = Touching::new(self.mechanism, &apart, left);
                for other in self.parts_with((&touching, left), configuration, (touches, towards))? {
                    if found.iter().all(|part| self.differs(part, &other)) {
                        found.push(other);
                    }
                }
            }
            if found.len() > 1 {
                let joints = self.names(touches);
                let outcomes = found.iter().map(|part| self.in_words(configuration, part, touches)).collect();
                return Err(Fault::general(FaultKind::SeveralImpacts { joints, outcomes }).into());
            }
            if let Some(part) = found.pop() {
                return Ok(part);
            }
        }
        self.jammed(configuration, touches, &apart)?.ok_or_else(|| self.wedges(touches))
    }

    /// The part of an impact by its course in which friction wedges what moves, while no contact that closes pushes.
    fn jammed(
        &self,
        configuration: &Configuration,
        touches: &[Touch],
        apart: &[usize],
    ) -> Result<Option<Part>, Faults> {
        let (closing, others): (Vec<&Touch>, Vec<&Touch>) =
            touches.iter().partition(|touch| touch.rate < 0.0);
        if closing.is_empty() || self.law == ImpactLaw::Moreau {
            return Ok(None);
        }
        let numbers =
            |touches: Vec<&Touch>| touches.into_iter().map(|touch| touch.contact).collect::<Vec<_>>();
        let open = [apart, &numbers(closing)].concat();
        for left in subsets(&numbers(others))? {
            let touching = Touching::new(self.mechanism, &open, &left);
            let found = match jam_within(&touching.mechanism, configuration, (&|_| false, self.work)) {
                Err(_) if touching.is_redundant(configuration) => continue,
                found => found?,
            };
            let Jam::Stops(impulses) = found else { continue };
            if let Some(impulse) = impulses.into_iter().find(|impulse| self.concerned[impulse.wedged.index()])
            {
                return Ok(Some(Part { jumps: impulse.jumps, pushes: Vec::new(), length: 1.0 }));
            }
        }
        Ok(None)
    }

    /// Where rates may go, in the order in which that is tried: by Moreau's law an impact ends as soon as it has begun.
    fn ways(&self) -> &'static [Towards] {
        match self.law {
            ImpactLaw::Course => &[Towards::TheEnd, Towards::Wedged],
            ImpactLaw::Moreau => &[Towards::TheEnd],
        }
    }

    /// Names what a part of an impact does, such as "left lifts off, right slides (1.2 J lost)".
    fn in_words(&self, configuration: &Configuration, part: &Part, touches: &[Touch]) -> String {
        let mechanism = self.mechanism;
        let after = self.moved(configuration, part);
        let does = |touch: &Touch| {
            let does = match part.pushes.iter().find(|push| push.contact == touch.contact) {
                None => "lifts off",
                Some(push) if push.sticks => "sticks",
                Some(_) => "slides",
            };
            format!("{} {does}", mechanism.contacts[touch.contact].name)
        };
        let does: Vec<String> = touches.iter().map(does).collect();
        let lost =
            mechanism.units.of("J").brief(kinetic(mechanism, configuration) - kinetic(mechanism, &after));
        format!("{} ({lost} lost)", does.join(", "))
    }

    fn differs(&self, part: &Part, other: &Part) -> bool {
        let bodies = 3 * self.mechanism.bodies.len();
        let [one, other] = [part, other].map(|part| part.jumps.rows(0, bodies).into_owned());
        (&one - &other).amax() > SAME * one.amax().max(other.amax())
    }

    /// The parts with a set of contacts that are left.
    fn parts_with(
        &self,
        (touching, left): (&Touching<'_>, &[usize]),
        configuration: &Configuration,
        (touches, towards): (&[Touch], Towards),
    ) -> Result<Vec<Part>, Faults> {
        let mechanism = &touching.mechanism;
        let mut instant = match Instant::new(mechanism, configuration) {
            Err(_) if touching.is_redundant(configuration) => return Ok(Vec::new()),
            instant => instant?,
        };
        let upright = instant.joints.iter_mut().filter(|joint| self.upright.contains(&joint.id));
        upright
            .filter_map(|joint| joint.couple.as_mut())
            .for_each(|couple| couple.half_length = f64::INFINITY);
        let instant = instant;
        let short_of = |k: usize| {
            let touch = touches.iter().find(|touch| touch.contact == k);
            touch.map_or(0.0, |touch| touch.rate - touch.end)
        };
        let sign = if towards == Towards::TheEnd { 1.0 } else { -1.0 };
        let mut base = DVector::zeros(instant.influence.frictionless.len());
        let answers = instant.equations.gap_accelerations();
        for (contact, answer) in mechanism.one_sided().zip(answers) {
            base.axpy(-sign * short_of(touching.number(contact)), &answer, 1.0);
        }
        let fastest = touches.iter().map(|touch| (touch.rate - touch.end).abs()).fold(0.0, f64::max);
        let mut impulses = Impulses::new(&instant, self.work);
        impulses.count_velocities_of(fastest, |number| self.concerns(&instant, number));
        let velocities = impulses.velocities();
        let stopped: Vec<bool> = velocities.iter().map(|velocity| *velocity == 0.0).collect();
        // What pushing makes close faster does not leave what it does not push.
        let greatest = if towards == Towards::TheEnd { f64::NEG_INFINITY } else { 0.0 };
        let short = |joint: usize, number: usize| {
            let of_joint = |k: &&usize| self.mechanism.contacts[**k].joint == instant.joints[joint].id;
            left.iter().filter(of_joint).nth(number).map_or(0.0, |k| short_of(*k).max(greatest))
        };
        impulses.put_base(&base, short);
        let (options, stopped) = match self.law {
            ImpactLaw::Course => (velocities.clone(), stopped),
            ImpactLaw::Moreau => {
                impulses.put_velocities_after(&velocities);
                (vec![0.0; velocities.len()], vec![true; velocities.len()])
            }
        };
        let states = self.states(&impulses, (touching, &options, &stopped), touches)?;
        let length = |state: &Assessment, jumps: &DVector<f64>| {
            let until = |(number, velocity): (usize, &f64)| {
                let slides = state.phase.of(number) != JointPhase::Sticking && instant.may_stick(number);
                let part = -velocity / instant.change(number, jumps);
                (slides && *velocity != 0.0 && part > 0.0).then_some(part)
            };
            if self.law == ImpactLaw::Moreau {
                return 1.0;
            }
            let most = if towards == Towards::TheEnd { 1.0 } else { f64::INFINITY };
            velocities.iter().enumerate().filter_map(until).fold(most, f64::min)
        };
        let push = |contact: ContactId, state: &Assessment, jumps: &DVector<f64>| {
            let index = instant.equations.layout.reaction(Reaction::Normal(contact))?;
            let joint = instant.joint_of(contact.index())?;
            let sticks = state.phase.of(joint) == JointPhase::Sticking;
            Some(Push { contact: touching.number(contact), impulse: jumps[index], sticks })
        };
        let part = |state: Assessment| {
            let jumps = &base + impulses.jumps(&state);
            let pushes = mechanism.one_sided().filter_map(|contact| push(contact, &state, &jumps)).collect();
            let length = length(&state, &jumps);
            Part { jumps, pushes, length }
        };
        Ok(states.into_iter().map(part).filter(|part| part.length.is_finite()).collect())
    }

    /// The admissible states of all groups in which the contacts that are not left push.
    fn states(
        &self,
        impulses: &Impulses<'_>,
        (touching, velocities, stopped): (&Touching<'_>, &[f64], &[bool]),
        touches: &[Touch],
    ) -> Result<Vec<Assessment>, Faults> {
        let options: Vec<Vec<JointPhase>> = velocities
            .iter()
            .enumerate()
            .map(|(joint, velocity)| impulses.options(joint, *velocity))
            .collect();
        let mut question = impulses.question(&vec![0.0; velocities.len()], stopped);
        for contact in touching.mechanism.one_sided() {
            if self.resting.contains(&touching.number(contact)) {
                question.sides[contact.index()] = PRESSED.to_vec();
            }
        }
        let mut all: Vec<Option<Assessment>> = vec![None];
        let instant = impulses.instant;
        let concerns =
            |group: &&Group| group.members(instant.joints.len()).any(|number| self.concerns(instant, number));
        for group in instant.groups.iter().filter(concerns) {
            let mut found = impulses.admissible(&question, &options, group)?;
            if found.unsolved > 0 {
                let joints = self.names(touches);
                return Err(Fault::general(FaultKind::UnsolvedImpact { joints }).into());
            }
            if self.law == ImpactLaw::Course {
                preferred(group, &mut found.list);
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
        Ok(all.into_iter().flatten().collect())
    }
}

/// The fraction of a part after which a contact has returned the work that it has taken, the root of `W + P (u p + (w - u) p^2/2)`
/// with its impulse `P` in the part, in which the rate of its gap goes from `u` to `w`; none if it does not.
fn until_even(returned: f64, impulse: f64, [from, to]: [f64; 2]) -> Option<f64> {
    let (a, b) = (impulse * from, impulse * (to - from) / 2.0);
    if returned > 0.0 || returned + a + b <= 0.0 {
        return None;
    }
    let root = (a * a - 4.0 * b * returned).sqrt();
    let part = if a > 0.0 { -2.0 * returned / (a + root) } else { (root - a) / (2.0 * b) };
    (0.0..1.0).contains(&part).then_some(part)
}

/// Leaves of the states of a group that with the greatest margin; where hinges turn with friction, those in which most stays at
/// rest.
fn preferred(group: &Group, states: &mut Vec<Assessment>) {
    if group.hinges.is_empty() {
        let better =
            |best: Assessment, other: Assessment| if other.least() > best.least() { other } else { best };
        *states = std::mem::take(states).into_iter().reduce(better).into_iter().collect();
        return;
    }
    let stays = |state: &Assessment| {
        let states = state.phase.joints_and_hinges();
        states.filter(|state| *state == JointPhase::Sticking).count()
    };
    let most = states.iter().map(stays).max();
    states.retain(|state| Some(stays(state)) == most);
}
