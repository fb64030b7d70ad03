//! The phases that can follow at an instant.

use super::assessment::{Assessment, Decisive, assess, best_sides, side_options};
use super::elastic::{attainability, verdict};
use super::growth::standing;
use super::instant::Instant;
use super::sieve::Sieve;
use super::state::{PhaseState, is_same_phase, state};
use super::sticking::ENOUGH;
use super::system::{Question, Subject};
use super::{BOUNDARY, MOST_STATES, Standing};
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::modes::Side;
use crate::motion::{ContactPhase, JointPhase, Phase};
use crate::report::{Attainability, Verdict};

/// Accelerations and forces that differ by less than this, in units, are the same.
const SAME: f64 = 1e-6;
const ALONE: &str = "no other phase can follow";

/// All phases that can follow at an instant.
#[derive(Debug, Clone, Default)]
pub struct Successors {
    /// The phases, the one to be followed first.
    pub list: Vec<Successor>,
    /// Phases that would be admissible but that a guided slider would tip: it has no state of its own for that, a block
    /// slider has.
    pub tipping: Vec<Tipping>,
    /// Phases of which a linear program was not solved.
    pub unsolved: Vec<Phase>,
}

/// A phase that can follow.
#[derive(Debug, Clone)]
pub struct Successor {
    /// The phase. Contacts of joints that stick have the sides of `state`; nothing hangs on them.
    pub phase: Phase,
    /// Its accelerations and reactions at the instant.
    pub state: PhaseState,
    /// Whether it is the previous phase.
    pub is_present: bool,
    /// Whether accelerations and the normal forces of joints that go on sliding are those of the previous phase.
    pub continues: bool,
    /// How it stands to its bounds.
    pub standing: Standing,
    /// What becomes of it if the guides are slightly elastic; joints that stick count as locked.
    pub attainability: Attainability,
}

/// A phase that is none because a guided slider would tip.
#[derive(Debug, Clone, PartialEq)]
pub struct Tipping {
    /// The phase.
    pub phase: Phase,
    /// The sliders.
    pub joints: Vec<JointId>,
}

/// Every phase that can follow at an instant, in the order in which they are to be preferred:
///
/// 1. the present phase, if it still exists;
/// 2. one that continues it: accelerations and reactions do not jump;
/// 3. of the others, one in which a stopped joint sticks before those in which all stopped joints slip: static friction
///    keeps what has come to rest until it is pushed;
/// 4. attainable ones before those with flutter or without a verdict;
/// 5. unattainable ones, unless they are the present phase or continue one that is unattainable itself.
///
/// `stopped` says of every sliding joint, in the order of the mechanism's joints, whether its velocity is zero; the
/// others slide with the sign of their velocity. Bodies may move in any case. Of `previous` only what it does matters, not
/// whether it was admissible. Joints without friction and preload always slide; the sign of one at rest is that of its
/// acceleration. A joint whose motion depends on that of joints that stick sticks with them.
///
/// An empty list while something moves is dynamic jamming, see [`jam`](super::jam), unless guided sliders would tip.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, lists of the wrong length, more
/// states than are tried.
///
/// ```
/// use slideway::configuration::Configuration;
/// use slideway::mechanism::Mechanism;
/// use slideway::model::{Model, Settings};
/// use slideway::motion::decision::successors;
///
/// let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
/// let settings = Settings::default().parameter("F_20", "0").parameter("mu_1", "0.6");
/// let mechanism = Mechanism::new(&Model::parse(text)?.with(&settings)?)?;
/// let configuration = Configuration::new(&mechanism)?;
/// let found = successors(&mechanism, &configuration, &[false, false], None)?;
/// // Theory, section 7: N_1 = 0.2625 m g is attainable, N_1 = -1.8754 m g is not.
/// let forces: Vec<f64> = found.list.iter().map(|one| one.state.normal_forces[0] / 9.81).collect();
/// assert!((forces[0] - 0.2625).abs() < 1e-4 && (forces[1] + 1.8754).abs() < 1e-4);
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
pub fn successors(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stopped: &[bool],
    previous: Option<&Phase>,
) -> Result<Successors, Faults> {
    at(mechanism, configuration, (stopped, previous), Detail::Everything)
}

/// The phases of [`successors`], with no more than it takes to put them in their order: patterns of sliding that are
/// far from any state are not assessed, sides of sticking contacts are those of the first state with a margin, and of
/// attainability there is the verdict alone. Where a single phase can follow, nothing is said about its attainability, and
/// of its being continued only whether it is the previous phase.
///
/// # Errors
/// As [`successors`].
pub(crate) fn continuations(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stopped: &[bool],
    previous: Option<&Phase>,
) -> Result<Successors, Faults> {
    at(mechanism, configuration, (stopped, previous), Detail::Order)
}

fn at(
    mechanism: &Mechanism,
    configuration: &Configuration,
    (stopped, previous): (&[bool], Option<&Phase>),
    detail: Detail,
) -> Result<Successors, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    instant.check_joints(stopped.len())?;
    if let Some(previous) = previous {
        instant.check(previous)?;
    }
    let search = Search { mechanism, configuration, instant: &instant, stopped, previous, detail };
    search.run()
}

/// How much is told of the phases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Detail {
    /// Everything.
    Everything,
    /// What decides their order.
    Order,
}

struct Search<'s> {
    mechanism: &'s Mechanism,
    configuration: &'s Configuration,
    instant: &'s Instant<'s>,
    stopped: &'s [bool],
    previous: Option<&'s Phase>,
    detail: Detail,
}

impl Search<'_> {
    fn run(&self) -> Result<Successors, Faults> {
        let question = self.instant.question(self.stopped);
        let mut found = Successors::default();
        let mut sieve = (self.detail == Detail::Order).then(|| Sieve::new(&question, self.instant));
        let enough = if self.detail == Detail::Order { ENOUGH } else { f64::INFINITY };
        for phase in self.candidates()? {
            if sieve.as_mut().is_some_and(|sieve| sieve.excludes(&phase)) {
                continue;
            }
            let Ok(assessment) = best_sides(self.instant, &question, &phase, (BOUNDARY, enough)) else {
                found.unsolved.push(phase);
                continue;
            };
            let Some(assessment) = assessment else { continue };
            if let Some(tipping) = self.tipping(&assessment) {
                found.tipping.push(tipping);
                continue;
            }
            let at = (self.instant, &question, &assessment);
            let Some(standing) = standing(self.mechanism, self.configuration, at) else { continue };
            found.list.extend(self.successor(&question, &assessment, standing));
        }
        let alone = found.list.len() == 1 && self.detail == Detail::Order;
        let previous = self.previous.filter(|_| !alone);
        let before = previous.and_then(|previous| self.present(&question, previous));
        for successor in &mut found.list {
            let is_continued = |before| self.is_continued(&successor.state, &successor.phase, before);
            successor.continues = successor.is_present || before.as_ref().is_some_and(is_continued);
            successor.attainability = self.attainability(&successor.phase, alone);
        }
        let matters = |one: &Successor| {
            one.continues && !one.is_present && one.attainability.verdict == Verdict::Unattainable
        };
        let follows_unattainable = found.list.iter().any(matters)
            && self.previous.is_some_and(|previous| self.verdict(previous) == Verdict::Unattainable);
        found.list.sort_by_key(|successor| rank(successor, follows_unattainable));
        Ok(found)
    }

    fn verdict(&self, phase: &Phase) -> Verdict {
        verdict(self.instant, self.configuration, phase)
    }

    fn attainability(&self, phase: &Phase, alone: bool) -> Attainability {
        match self.detail {
            Detail::Everything => attainability(self.instant, self.configuration, phase),
            Detail::Order if alone => Attainability::without_eigenvalues(Verdict::NotComputed, ALONE),
            Detail::Order => Attainability::without_eigenvalues(self.verdict(phase), ""),
        }
    }

    /// The previous phase at this instant.
    fn present(&self, question: &Question<'_>, previous: &Phase) -> Option<PhaseState> {
        let assessment = assess(self.instant, question, previous, BOUNDARY).ok()??;
        state(self.instant, question, &assessment)
    }

    /// All states of the joints with all sides of the contacts that slide; contacts that stick have any side.
    fn candidates(&self) -> Result<Vec<Phase>, Faults> {
        let joints: Vec<Vec<JointPhase>> =
            (0..self.stopped.len()).map(|joint| self.joint_options(joint)).collect();
        let sides: Vec<_> =
            (0..self.mechanism.contacts.len()).map(|k| side_options(self.instant, k)).collect();
        let counts = joints.iter().map(Vec::len).chain(sides.iter().map(|sides| sides.len()));
        let states = counts.fold(1_u64, |product, count| product.saturating_mul(count as u64));
        if states > MOST_STATES {
            return Err(Fault::general(FaultKind::TooManyStates { states, limit: MOST_STATES }).into());
        }
        let mut all = Vec::new();
        for joints in combinations(&joints).into_iter().filter(|joints| self.can_begin(joints)) {
            let sticks = |k: usize| {
                self.instant.joint_of(k).is_some_and(|joint| joints[joint] == JointPhase::Sticking)
            };
            let options: Vec<Vec<ContactPhase>> = sides
                .iter()
                .enumerate()
                .map(
                    |(k, sides)| {
                        if sticks(k) { vec![ContactPhase::Pressed(Side::Positive)] } else { sides.to_vec() }
                    },
                )
                .collect();
            let phases = combinations(&options).into_iter();
            all.extend(phases.map(|contacts| Phase { joints: joints.clone(), contacts }));
        }
        Ok(all)
    }

    /// Whether the joints that begin to slip can do so: none depends on joints that stick, and those that depend on one
    /// another slip in the senses that belong together.
    fn can_begin(&self, joints: &[JointPhase]) -> bool {
        let held: Vec<usize> =
            (0..joints.len()).filter(|&joint| joints[joint] == JointPhase::Sticking).collect();
        let begins = |joint: usize| match joints[joint] {
            JointPhase::Sliding(sign) if self.instant.joints[joint].has_friction => {
                (self.stopped[joint] || self.velocity(joint).zero).then_some((joint, sign))
            }
            _ => None,
        };
        let slipping: Vec<(usize, f64)> = (0..joints.len()).filter_map(begins).collect();
        let mut pairs = slipping
            .iter()
            .enumerate()
            .flat_map(|(index, one)| slipping[..index].iter().map(move |other| [*one, *other]));
        !slipping.iter().any(|(joint, _)| self.instant.is_held(*joint, &held))
            && pairs.all(|pair| self.instant.can_begin_together(pair))
    }

    fn joint_options(&self, joint: usize) -> Vec<JointPhase> {
        let SlidingVelocity { sign, zero } = self.velocity(joint);
        if !self.instant.joints[joint].has_friction {
            vec![JointPhase::Sliding(sign)]
        } else if self.stopped[joint] || zero {
            vec![JointPhase::Sticking, JointPhase::Sliding(1.0), JointPhase::Sliding(-1.0)]
        } else {
            vec![JointPhase::Sliding(sign)]
        }
    }

    fn velocity(&self, joint: usize) -> SlidingVelocity {
        let velocity = self.instant.joints[joint].velocity;
        SlidingVelocity { sign: if velocity < 0.0 { -1.0 } else { 1.0 }, zero: velocity == 0.0 }
    }

    /// The guided sliders that would tip in a phase that nothing else forbids.
    fn tipping(&self, assessment: &Assessment) -> Option<Tipping> {
        let mut joints = Vec::new();
        for slack in assessment.slacks.iter().filter(|slack| slack.value < -BOUNDARY) {
            let Decisive::One(Subject::Couple(k)) = slack.subject else { return None };
            let joint = self.mechanism.contacts[k].joint;
            if !joints.contains(&joint) {
                joints.push(joint);
            }
        }
        (!joints.is_empty()).then(|| Tipping { phase: assessment.phase.clone(), joints })
    }

    fn successor(
        &self,
        question: &Question<'_>,
        assessment: &Assessment,
        standing: Standing,
    ) -> Option<Successor> {
        let state = state(self.instant, question, assessment)?;
        let mut phase = assessment.phase.clone();
        for (joint, found) in phase.joints.iter_mut().enumerate() {
            let acceleration = state.sliding_accelerations[joint];
            let at_rest = self.stopped[joint] || self.velocity(joint).zero;
            if !self.instant.joints[joint].has_friction && at_rest && acceleration < 0.0 {
                *found = JointPhase::Sliding(-1.0);
            }
        }
        let is_present = self.previous.is_some_and(|previous| is_same_phase(self.instant, previous, &phase));
        let attainability = Attainability::without_eigenvalues(Verdict::NotComputed, "");
        Some(Successor { phase, state, is_present, continues: is_present, standing, attainability })
    }

    fn is_continued(&self, state: &PhaseState, phase: &Phase, before: &PhaseState) -> bool {
        let units = &self.instant.units;
        let previous = self.previous.map(|previous| &previous.joints[..]).unwrap_or_default();
        let slides = |joint: usize| {
            let slides = |phase: &JointPhase| matches!(phase, JointPhase::Sliding(_));
            slides(&phase.joints[joint]) && previous.get(joint).is_some_and(slides)
        };
        let bodies = 0..3 * self.mechanism.bodies.len();
        let mut accelerations = bodies.map(|index| {
            let unit = if index % 3 == 2 { units.acceleration / units.length } else { units.acceleration };
            (state.unknowns[index] - before.unknowns[index]) / unit
        });
        let mut forces = (0..phase.contacts.len())
            .filter(|&k| self.instant.joint_of(k).is_some_and(slides))
            .map(|k| (state.normal_forces[k] - before.normal_forces[k]) / units.force);
        let small = |difference: f64| difference.abs() <= SAME;
        accelerations.all(small) && forces.all(small)
    }
}

struct SlidingVelocity {
    sign: f64,
    zero: bool,
}

/// Place in the order of preference.
fn rank(successor: &Successor, follows_unattainable: bool) -> [u8; 3] {
    let sticks = successor.phase.joints.contains(&JointPhase::Sticking);
    let verdict = match successor.attainability.verdict {
        Verdict::Attainable => 0,
        Verdict::Flutter => 1,
        Verdict::NotComputed => 2,
        Verdict::Undecided => 3,
        Verdict::Unattainable => 4,
    };
    let class = match successor {
        Successor { is_present: true, .. } => 0,
        Successor { continues: true, .. } if verdict < 4 || follows_unattainable => 1,
        _ if verdict == 4 => 3,
        _ => 2,
    };
    [class, u8::from(!sticks), verdict]
}

/// Every way to choose one of each list, the last list changing fastest.
pub(super) fn combinations<T: Clone>(options: &[Vec<T>]) -> Vec<Vec<T>> {
    let start = vec![Vec::new()];
    options.iter().fold(start, |all, options| {
        let extended = |chosen: &Vec<T>| {
            let one = |option: &T| [chosen.as_slice(), std::slice::from_ref(option)].concat();
            options.iter().map(one).collect::<Vec<_>>()
        };
        all.iter().flat_map(extended).collect()
    })
}
