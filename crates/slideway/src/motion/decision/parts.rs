//! What a group of joints can do at an instant, decided independently of the others.

use super::assessment::{Assessment, Decisive, assess_group, sliding_sides, with_sides};
use super::elastic::verdict;
use super::instant::Instant;
use super::outputs::Group;
use super::rules;
use super::sieve::SlidingSieve;
use super::state::{PhaseState, is_same_phase, state};
use super::sticking::ENOUGH;
use super::successors::{Successors, TippingPhase};
use super::system::{Question, Subject};
use super::turning::Turning;
use super::{BOUNDARY, MOST_STATES};
use crate::fault::{Fault, FaultKind, Faults};
use crate::pattern::{HingePhase, JointPhase, Phase, Unsolved};
use crate::report::Verdict;
use std::cell::RefCell;
use std::cmp::Reverse;

/// Accelerations and forces that differ by less than this, in units, count as equal.
pub(super) const SAME: f64 = 1e-6;
/// Once a state has been found, at most this many are tried in all, ...
const FURTHER_STATES: u64 = 10_000;
/// ... and with more joints at rest than this, no state in which fewer stick than in one that is at no
/// boundary.
const FEW_RESTING: usize = 4;
/// If more joints of one group are at rest than this, the rest only stick.
const MOST_RESTING: usize = 60;

/// How much is to be determined about the phases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Detail {
    /// Everything.
    Everything,
    /// Only what decides their order.
    Order,
}

/// What a group of joints can do.
#[derive(Debug, Clone)]
pub(super) struct GroupPhase {
    /// Forces of this group.
    pub(super) assessment: Assessment,
    /// Whether it is what the group did before.
    pub(super) is_present: bool,
    /// Whether accelerations and normal forces stay the same.
    pub(super) continues: bool,
    /// Whether it is attainable if all other groups are locked; computed only when its place in the order is
    /// needed.
    pub(super) verdict: Verdict,
}

/// The search for what groups of joints can do.
pub(super) struct PhaseSearch<'s> {
    pub(super) instant: &'s Instant<'s>,
    pub(super) event: &'s rules::EventInstant<'s>,
    pub(super) question: &'s Question<'s>,
    pub(super) detail: Detail,
}

impl PhaseSearch<'_> {
    /// What each group did before, and whether nothing happens in it.
    fn undisturbed(&self) -> (Vec<Option<Assessment>>, Vec<bool>) {
        let groups = &self.instant.groups;
        let before: Vec<Option<Assessment>> = groups.iter().map(|group| self.before(group)).collect();
        let goes_on = |(group, before): (&Group, &Option<Assessment>)| {
            before.as_ref().is_some_and(|before| self.is_undisturbed(group, before))
        };
        let undisturbed = groups.iter().zip(&before).map(goes_on).collect();
        (before, undisturbed)
    }

    /// For each group of joints, what it can do, not yet in order.
    ///
    /// # Errors
    /// More states than are tried.
    pub(super) fn parts(&self, found: &mut Successors) -> Result<Vec<Vec<GroupPhase>>, Faults> {
        let (before, undisturbed) = self.undisturbed();
        let nothing_happens = undisturbed.iter().all(|undisturbed| *undisturbed);
        let mut parts = Vec::with_capacity(self.instant.groups.len());
        for (index, group) in self.instant.groups.iter().enumerate() {
            parts.push(match &before[index] {
                Some(before) if undisturbed[index] && !nothing_happens => vec![before.clone()],
                _ => self.admissible(group, found)?,
            });
        }
        let alone = self.detail == Detail::Order && parts.iter().all(|parts| parts.len() == 1);
        let groups = self.instant.groups.iter().zip(&before);
        Ok(groups
            .zip(parts)
            .map(|((group, before), parts)| self.compared(group, parts, (before.as_ref(), alone)))
            .collect())
    }

    /// A phase with those joints sliding that certainly slide.
    pub(super) fn any_phase(&self) -> Phase {
        let does = |number: usize| match self.event.sign_of(number) {
            0.0 if self.instant.may_stick(number) => JointPhase::Sticking,
            sign => JointPhase::Sliding(if sign < 0.0 { -1.0 } else { 1.0 }),
        };
        let joints = self.instant.joints.len();
        let hinges = (joints..self.instant.rubbing()).map(does);
        Phase {
            joints: (0..joints).map(does).collect(),
            hinges: hinges.map(|state| HingePhase { state, force: [0.0; 2] }).collect(),
            contacts: self.question.sides.iter().map(|sides| sides[0]).collect(),
        }
    }

    /// What a group did before, assessed at this instant.
    fn before(&self, group: &Group) -> Option<Assessment> {
        let previous = self.event.previous?;
        self.assess(previous, group).ok()?
    }

    fn assess(&self, phase: &Phase, group: &Group) -> Result<Option<Assessment>, Unsolved> {
        let enough = if self.detail == Detail::Order { ENOUGH } else { f64::INFINITY };
        assess_group(self.instant, self.question, (phase, group), enough)
    }

    /// Whether nothing happens in a group: none of its joints has just stopped or reversed, and what it did
    /// is at no boundary.
    fn is_undisturbed(&self, group: &Group, before: &Assessment) -> bool {
        let keeps = |number: usize| match before.phase.of(number) {
            JointPhase::Sticking => self.event.sign_of(number) == 0.0,
            JointPhase::Sliding(sign) => {
                self.event.sign_of(number) == sign || !self.instant.may_stick(number)
            }
        };
        self.members(group).all(keeps) && before.least() > BOUNDARY && !before.redundant
    }

    /// All admissible states of a group, or only those in which most joints stick, which are tried first.
    fn admissible(&self, group: &Group, found: &mut Successors) -> Result<Vec<Assessment>, Faults> {
        let mut list: Vec<Assessment> = Vec::new();
        let can_sieve = self.detail == Detail::Order && group.hinges.is_empty();
        let mut sieve = can_sieve.then(|| SlidingSieve::new(self.question, self.instant, group));
        let stuck = |phase: &Phase| {
            self.members(group).filter(|number| phase.of(*number) == JointPhase::Sticking).count()
        };
        let is_large = stuck(&self.any_phase()) > FEW_RESTING;
        let mut most = 0;
        let undecided = RefCell::new(Vec::new());
        let (mut tried, mut refused) = (0, 0);
        for phase in self.patterns(group, &undecided) {
            if self.event.work.is_over() {
                break;
            }
            let counted = if phase.is_ok() { &mut tried } else { &mut refused };
            *counted += 1;
            let limit = if list.is_empty() { MOST_STATES } else { FURTHER_STATES };
            let fewer = |phase: &Phase| is_large && stuck(phase) < most;
            if tried > limit || refused > MOST_STATES || phase.as_ref().is_ok_and(fewer) {
                if list.is_empty() {
                    let states = tried.max(refused);
                    return Err(Fault::general(FaultKind::TooManyStates { states, limit }).into());
                }
                found.complete = false;
                break;
            }
            let Ok(phase) = phase else { continue };
            if sieve.as_mut().is_some_and(|sieve| sieve.excludes(&phase)) {
                continue;
            }
            match self.assess(&phase, group) {
                Err(_) => found.unsolved.push(phase),
                Ok(None) => {}
                Ok(Some(assessment)) if assessment.least() >= -BOUNDARY => {
                    if assessment.least() > BOUNDARY && !assessment.redundant {
                        most = most.max(stuck(&phase));
                    }
                    list.push(assessment);
                }
                Ok(Some(assessment)) => {
                    let violated = assessment.slacks.iter().filter(|slack| slack.value < -BOUNDARY);
                    let subjects = violated.map(|slack| slack.subject);
                    found.tipping.extend(self.instant.tipping(&assessment.phase, subjects));
                }
            }
        }
        found.unsolved.extend(undecided.take());
        Ok(list)
    }

    /// The members of a group, by their numbers among the sliding joints and hinges with friction.
    fn members<'g>(&self, group: &'g Group) -> impl Iterator<Item = usize> + 'g {
        group.members(self.instant.joints.len())
    }

    /// All states of the joints and hinges of a group with all sides of the sliding contacts and all forces of the hinges
    /// that turn, those with most sticking first; sticking contacts have any side. Those that cannot begin are
    /// errors, and those whose forces remain undecided are noted.
    fn patterns<'p>(
        &'p self,
        group: &'p Group,
        undecided: &'p RefCell<Vec<Phase>>,
    ) -> impl Iterator<Item = Result<Phase, Phase>> + 'p {
        let rests = |number: &usize| self.event.sign_of(*number) == 0.0 && self.instant.may_stick(*number);
        let resting: Vec<usize> = self.members(group).filter(rests).collect();
        let most = u32::try_from(resting.len().min(MOST_RESTING)).unwrap_or(0);
        (0..=most).flat_map(move |count| subsets(most, count)).flat_map(move |slips| {
            let tried = resting.iter().take(MOST_RESTING).enumerate();
            let slipping: Vec<usize> =
                tried.filter(|(place, _)| slips >> place & 1 == 1).map(|(_, number)| *number).collect();
            let senses = (0..1_u64 << slipping.len()).map(move |senses| {
                let mut phase = self.any_phase();
                for (place, &number) in slipping.iter().enumerate() {
                    phase.set(number, JointPhase::Sliding(if senses >> place & 1 == 1 { -1.0 } else { 1.0 }));
                }
                phase
            });
            senses.flat_map(|phase| -> Box<dyn Iterator<Item = Result<Phase, Phase>> + 'p> {
                if self.can_begin(group, &phase) {
                    Box::new(self.with_forces(group, phase, undecided).map(Ok))
                } else {
                    Box::new(std::iter::once(Err(phase)))
                }
            })
        })
    }

    /// A phase with all sides of its sliding contacts; where hinges turn, those of all solutions for their forces.
    fn with_forces<'p>(
        &'p self,
        group: &'p Group,
        phase: Phase,
        undecided: &RefCell<Vec<Phase>>,
    ) -> Box<dyn Iterator<Item = Phase> + 'p> {
        if group.turns(&phase) {
            let turning = Turning::new(self.instant, self.question, (&phase, group), self.event.work);
            let (phases, decided) =
                turning.map_or((Vec::new(), false), |turning| turning.phases(self.event.work));
            undecided.borrow_mut().extend((!decided).then_some(phase));
            return Box::new(phases.into_iter());
        }
        let sides = sliding_sides(self.question, &phase, (self.instant, group));
        Box::new((0..).map_while(move |number| with_sides(&phase, &sides, number)))
    }

    /// Whether the members that begin to move can do so: none depends on those that stick, and members that
    /// depend on one another move in matching directions. Beside hinges with friction what no motion moves at once may begin
    /// to move a little later, at a dead centre.
    fn can_begin(&self, group: &Group, phase: &Phase) -> bool {
        let held: Vec<usize> =
            self.members(group).filter(|number| phase.of(*number) == JointPhase::Sticking).collect();
        let begins = |number: usize| match phase.of(number) {
            JointPhase::Sliding(sign) if self.instant.may_stick(number) => {
                (self.event.sign_of(number) == 0.0).then_some((number, sign))
            }
            _ => None,
        };
        // With hundreds of members each of these questions takes a while. Once the work is to end nothing begins: whoever
        // asks sees that, and stops.
        let is_over = || self.event.work.is_over();
        let moves = |number: usize| {
            phase.of(number) != JointPhase::Sticking && !is_over() && self.instant.is_movable(number, &held)
        };
        let later = !group.hinges.is_empty() && self.members(group).any(moves);
        let slipping: Vec<(usize, f64)> = self.members(group).filter_map(begins).collect();
        let mut pairs = slipping
            .iter()
            .enumerate()
            .flat_map(|(index, one)| slipping[..index].iter().map(move |other| [*one, *other]));
        (later || !slipping.iter().any(|(number, _)| is_over() || self.instant.is_held(*number, &held)))
            && pairs.all(|pair| self.instant.can_begin_together(pair))
            && !is_over()
    }

    /// What a group can do compared with what it did before; whether motions are continued is not determined
    /// if only one phase can follow.
    fn compared(
        &self,
        group: &Group,
        list: Vec<Assessment>,
        (before, alone): (Option<&Assessment>, bool),
    ) -> Vec<GroupPhase> {
        let state_before = before.filter(|_| !alone).map(|before| state(self.instant, before));
        let part = |assessment: Assessment| {
            let same =
                |before: &Assessment| is_same_phase(self.instant, group, [&before.phase, &assessment.phase]);
            let is_present = before.is_some_and(same);
            let continued = |before: &PhaseState| self.is_continued(group, before, &assessment);
            let continues = is_present || state_before.as_ref().is_some_and(continued);
            GroupPhase { assessment, is_present, continues, verdict: Verdict::NotComputed }
        };
        list.into_iter().map(part).collect()
    }

    /// Determines the verdict on what each group can do; returns for each group the place of each of its
    /// parts in the order of preference.
    pub(super) fn order(&self, parts: &mut [Vec<GroupPhase>]) -> Vec<Vec<usize>> {
        let groups = self.instant.groups.iter().zip(parts);
        groups.map(|(group, parts)| self.order_of(group, parts)).collect()
    }

    fn order_of(&self, group: &Group, parts: &mut [GroupPhase]) -> Vec<usize> {
        for part in &mut *parts {
            part.verdict = self.verdict(group, &part.assessment.phase);
        }
        let continues_unattainable =
            |part: &GroupPhase| part.continues && !part.is_present && part.verdict == Verdict::Unattainable;
        let follows_unattainable = parts.iter().any(continues_unattainable)
            && self
                .event
                .previous
                .is_some_and(|previous| self.verdict(group, previous) == Verdict::Unattainable);
        let mut numbers: Vec<usize> = (0..parts.len()).collect();
        numbers.sort_by_key(|&number| self.rank(group, &parts[number], follows_unattainable));
        let mut places = vec![0; parts.len()];
        numbers.into_iter().enumerate().for_each(|(place, number)| places[number] = place);
        places
    }

    /// The verdict on what a group does while all others are locked.
    fn verdict(&self, group: &Group, phase: &Phase) -> Verdict {
        if !group.hinges.is_empty() {
            let turning = Turning::new(self.instant, self.question, (phase, group), self.event.work);
            let is_unattainable = turning.is_some_and(|turning| turning.is_unattainable());
            return if is_unattainable { Verdict::Unattainable } else { Verdict::NotComputed };
        }
        let mut phase = phase.clone();
        for (joint, found) in phase.joints.iter_mut().enumerate() {
            if !group.joints.contains(&joint) {
                *found = JointPhase::Sticking;
            }
        }
        verdict(self.instant, self.event.configuration, &phase)
    }

    /// Whether accelerations and the normal forces of joints that continue to slide stay the same.
    fn is_continued(&self, group: &Group, before: &PhaseState, assessment: &Assessment) -> bool {
        let previous = self.event.previous.map(|previous| &previous.joints[..]).unwrap_or_default();
        let slides = |joint: usize| {
            let slides = |phase: &JointPhase| matches!(phase, JointPhase::Sliding(_));
            slides(&assessment.phase.joints[joint]) && previous.get(joint).is_some_and(slides)
        };
        let state = state(self.instant, assessment);
        let small = |k: &usize| {
            (state.normal_forces[*k] - before.normal_forces[*k]).abs()
                <= SAME * self.instant.units_of(*k).force
        };
        let mut contacts = group.contacts.iter().filter(|k| self.instant.joint_of(**k).is_some_and(slides));
        self.is_same_motion(group, [&state, before]) && contacts.all(small)
    }

    /// Whether accelerations are the same.
    pub(super) fn is_same_motion(&self, group: &Group, [one, other]: [&PhaseState; 2]) -> bool {
        let Some(first) = self.members(group).next() else { return true };
        let units = self.instant.units_of_rubbing(first);
        (0..3 * self.instant.mechanism.bodies.len()).all(|index| {
            let unit = if index % 3 == 2 { units.acceleration / units.length } else { units.acceleration };
            (one.unknowns[index] - other.unknowns[index]).abs() <= SAME * unit
        })
    }

    /// Place in the order of preference.
    fn rank(
        &self,
        group: &Group,
        part: &GroupPhase,
        follows_unattainable: bool,
    ) -> (Reverse<[usize; 2]>, [u8; 2]) {
        let sticks = |phase: &Phase, number: usize| phase.of(number) == JointPhase::Sticking;
        let stuck = || self.members(group).filter(|number| sticks(&part.assessment.phase, *number));
        let before = |number: &usize| self.event.previous.is_some_and(|previous| sticks(previous, *number));
        let verdict = match part.verdict {
            Verdict::Attainable => 0,
            Verdict::Flutter => 1,
            Verdict::NotComputed => 2,
            Verdict::Undecided => 3,
            Verdict::Unattainable => 4,
        };
        let class = match part {
            GroupPhase { is_present: true, .. } => 0,
            GroupPhase { continues: true, .. } if verdict < 4 || follows_unattainable => 1,
            _ if verdict == 4 => 3,
            _ => 2,
        };
        (Reverse([stuck().filter(before).count(), stuck().count()]), [class, verdict])
    }
}

impl Instant<'_> {
    /// The guided sliders that would tip in a phase that violates only these inequalities.
    pub(super) fn tipping(
        &self,
        phase: &Phase,
        violated: impl Iterator<Item = Decisive>,
    ) -> Option<TippingPhase> {
        let mut joints = Vec::new();
        for subject in violated {
            let Decisive::One(Subject::Couple(k)) = subject else { return None };
            let joint = self.contact(k).joint;
            if !joints.contains(&joint) {
                joints.push(joint);
            }
        }
        (!joints.is_empty()).then(|| TippingPhase { phase: phase.clone(), joints })
    }
}

/// All subsets with this many of the first numbers, as bits.
fn subsets(of: u32, count: u32) -> impl Iterator<Item = u64> {
    let first = (1_u64 << count) - 1;
    // R. W. Gosper: the next number with the same number of bits (M. Beeler, R. W. Gosper, R. Schroeppel,
    // HAKMEM, item 175, 1972).
    let next = |set: &u64| {
        let lowest = set & set.wrapping_neg();
        let carried = set + lowest;
        (lowest > 0).then(|| carried | (((set ^ carried) >> 2) / lowest))
    };
    std::iter::successors(Some(first), next).take_while(move |set| *set < 1 << of)
}
