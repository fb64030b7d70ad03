//! The phases that can follow at an instant.

use super::assessment::Assessment;
use super::elastic::{attainability, verdict};
use super::growth::{Ended, standing};
use super::instant::Instant;
use super::parts::{Detail, GroupPhase, PhaseSearch};
use super::rules;
use super::state::{PhaseState, state};
use super::vanishing::vanish;
use super::{PhaseBound, Standing};
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, JointId};
use crate::mechanism::Mechanism;
use crate::pattern::{JointPhase, Phase};
use crate::report::{Attainability, Verdict};

/// If there are more combinations of what independent groups of joints can do, they are not all listed.
const MOST_COMBINATIONS: usize = 256;

/// All phases that can follow at an instant.
#[derive(Debug, Clone, Default)]
pub struct Successors {
    /// The phases, in order of preference.
    pub list: Vec<Successor>,
    /// Phases that would be admissible except that a guided slider would tip: unlike a block slider, it has
    /// no state of its own for that.
    pub tipping: Vec<TippingPhase>,
    /// Phases for which a linear program was not solved, or not all forces of the hinges that turn were found.
    pub unsolved: Vec<Phase>,
    /// Whether the list is complete; otherwise there are so many states that some in which fewer joints stick
    /// were omitted.
    pub(crate) complete: bool,
    /// The sliding joints and hinges with friction of the groups that cannot go on, whatever others do.
    pub(super) blocked: Vec<JointId>,
}

/// A phase that can follow.
#[derive(Debug, Clone)]
pub struct Successor {
    /// The phase. Contacts of sticking joints have the sides of `state`; nothing depends on them.
    pub phase: Phase,
    /// Its accelerations and reactions at the instant.
    pub state: PhaseState,
    /// Whether it is the previous phase.
    pub is_present: bool,
    /// Whether accelerations and the normal forces of joints that continue to slide are those of the previous
    /// phase.
    pub continues: bool,
    /// How it stands to its bounds.
    pub standing: Standing,
    /// Whether it is attainable if the guides are slightly elastic; sticking joints count as locked.
    pub attainability: Attainability,
}

/// A phase that is excluded because a guided slider would tip.
#[derive(Debug, Clone, PartialEq)]
pub struct TippingPhase {
    /// The phase.
    pub(crate) phase: Phase,
    /// The sliders.
    pub(crate) joints: Vec<JointId>,
}

/// The phases that can follow at an instant, in order of preference. Groups of joints without influence on
/// one another are decided separately; within each group the order is
///
/// 1. what rests, stays: phases in which more of the joints stick that stuck before, then those in which more
///    joints stick. So a phase comes before those in which only some of its joints stick. The other rules
///    decide only between phases with equal numbers.
/// 2. the present phase, if it still exists;
/// 3. a phase that continues it: accelerations and reactions do not jump;
/// 4. attainable phases, before those with flutter or without a verdict;
/// 5. unattainable phases, unless they are the present phase or continue one that is itself unattainable.
///
/// A group in which nothing happens, because none of its joints has just stopped and its part of the previous
/// phase is admissible and at no boundary, continues as before, unless this is true of all groups.
///
/// `stopped` states for every sliding joint, in the order of the mechanism's joints, whether its velocity is
/// zero; the others slide with the sign of their velocity. Bodies may move in either case. Only what happens
/// in `previous` matters, not whether it was admissible. Joints without friction and preload always slide;
/// the sign of such a joint at rest is that of its acceleration. A joint whose motion depends on that of
/// sticking joints sticks with them.
///
/// An empty list while something moves means dynamic jamming, see [`jam`](super::jam), unless guided sliders
/// would tip.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, lists of the wrong
/// length, and more states than are tried.
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
    mechanism.check_frictionless_hinges()?;
    mechanism.check_no_one_sided("a list of what follows")?;
    let instant = Instant::looking_ahead(mechanism, configuration)?;
    instant.check_joints(stopped.len())?;
    let sign = |(joint, stopped): (&super::joints::SlidingJoint, &bool)| match joint.velocity {
        0.0 => 0.0,
        _ if *stopped => 0.0,
        velocity => velocity.signum(),
    };
    let signs: Vec<f64> = instant.joints.iter().zip(stopped).map(sign).collect();
    let event = rules::EventInstant::new((mechanism, configuration), &signs, previous);
    at(instant, &event, Detail::Everything)
}

/// The phases of [`successors`], with only what is needed to order them: patterns of sliding that are far
/// from any state are not assessed, sticking contacts have the sides of the first state with a margin, and
/// attainability is reduced to the verdict. If only one phase can follow, `continues` only says whether it is
/// the previous phase.
///
/// # Errors
/// As [`successors`].
pub(crate) fn continuations(event: &rules::EventInstant<'_>) -> Result<Successors, Faults> {
    let instant = Instant::looking_ahead(event.mechanism, event.configuration)?;
    let instant = instant.in_units_of_at_least(event.rounding, event.configuration)?;
    at(instant, event, Detail::Order)
}

/// What can follow at an instant.
fn at(
    mut instant: Instant<'_>,
    event: &rules::EventInstant<'_>,
    detail: Detail,
) -> Result<Successors, Faults> {
    instant.check_joints(event.signs.len())?;
    if let Some(previous) = event.previous {
        instant.check(previous)?;
        vanish(&mut instant, event, previous);
    }
    let instant = &instant;
    let sign = |number: usize| match event.sign_of(number) {
        0.0 => instant.passes(number).unwrap_or(0.0),
        sign => sign,
    };
    let signs: Vec<f64> = (0..instant.rubbing()).map(sign).collect();
    let stopped: Vec<bool> = signs.iter().map(|sign| *sign == 0.0).collect();
    let (signs, spins) = signs.split_at(instant.joints.len());
    let event = &rules::EventInstant { signs, spins, ..*event };
    let question = instant.question(&stopped, None);
    following(&PhaseSearch { instant, event, question: &question, detail })
}

fn following(search: &PhaseSearch<'_>) -> Result<Successors, Faults> {
    let PhaseSearch { event, detail, .. } = *search;
    let mut found = Successors { complete: true, ..Successors::default() };
    let mut parts = search.parts(&mut found)?;
    let is_few =
        parts.iter().fold(1_usize, |product, parts| product.saturating_mul(parts.len())) <= MOST_COMBINATIONS;
    found.complete &= is_few;
    let order = if is_few { None } else { Some(search.order(&mut parts)) };
    let mut outcomes: Vec<CombinedPhase> =
        choices(&parts, order.as_deref()).into_iter().map(|chosen| outcome(search, &parts, chosen)).collect();
    // Verdicts take time, so the order is determined only if several phases can follow, or none.
    let following = outcomes.iter().filter(|outcome| outcome.standing.is_ok()).count();
    if is_few && outcomes.len() > 1 && following != 1 {
        let order = search.order(&mut parts);
        let place = |outcome: &CombinedPhase| -> Vec<usize> {
            order.iter().zip(&outcome.chosen).map(|(places, part)| places[*part]).collect()
        };
        outcomes.sort_by_cached_key(place);
    }
    found.blocked = blocked(search.instant, &parts, &outcomes);
    for CombinedPhase { chosen, whole, standing } in outcomes {
        let parts: Vec<&GroupPhase> = parts.iter().zip(chosen).map(|(parts, part)| &parts[part]).collect();
        match standing {
            Ok(standing) => found.list.push(successor(search, &whole, (&parts, standing))),
            Err(Ended { violated, .. }) => {
                found.tipping.extend(search.instant.tipping(&whole.phase, violated.into_iter()));
            }
        }
    }
    // Unless there is evidence to the contrary, what has fallen to zero continues to fall.
    found.list.sort_by_key(|successor| {
        let ends = |limit: &PhaseBound| matches!(limit, PhaseBound::NormalForce(k) | PhaseBound::PreloadShare(k) if event.zero.contains(k));
        let undecided = matches!(&successor.standing, Standing::Undecided(limits) if limits.iter().any(ends));
        successor.is_present && undecided
    });
    if found.list.is_empty() && !found.complete {
        let states = parts.iter().fold(1_u64, |product, part| product.saturating_mul(part.len() as u64));
        let limit = MOST_COMBINATIONS as u64;
        return Err(Fault::general(FaultKind::TooManyStates { states, limit }).into());
    }
    without_copies(search, &mut found.list);
    if let ([alone], Detail::Order) = (&mut found.list[..], detail) {
        // Nothing was to be ordered, so that no group has a verdict.
        let rests = alone.phase.is_at_rest(search.instant.mechanism);
        let whole = || verdict(search.instant, event.configuration, &alone.phase);
        let verdict = if rests { Verdict::NotComputed } else { whole() };
        alone.attainability = Attainability::without_eigenvalues(verdict, "");
    }
    Ok(found)
}

/// The outcome of a choice of one part for each group.
struct CombinedPhase {
    chosen: Vec<usize>,
    whole: Assessment,
    standing: Result<Standing, Ended>,
}

/// The sliding joints and hinges with friction that cannot go on, whatever others do: those of groups that can do nothing, and
/// those that end every phase.
fn blocked(instant: &Instant<'_>, parts: &[Vec<GroupPhase>], outcomes: &[CombinedPhase]) -> Vec<JointId> {
    let is_empty = |number: &usize| {
        let mut groups = instant.groups.iter().zip(parts).filter(|(_, parts)| parts.is_empty());
        groups.any(|(group, _)| group.members(instant.joints.len()).any(|member| member == *number))
    };
    let ends = |number: &usize| {
        let ended = |outcome: &CombinedPhase| {
            outcome.standing.as_ref().is_err_and(|ended| ended.members.contains(number))
        };
        !outcomes.is_empty() && outcomes.iter().all(ended)
    };
    let all = 0..instant.rubbing();
    all.filter(|number| is_empty(number) || ends(number)).filter_map(|number| instant.id_of(number)).collect()
}

fn outcome(search: &PhaseSearch<'_>, parts: &[Vec<GroupPhase>], chosen: Vec<usize>) -> CombinedPhase {
    let PhaseSearch { instant, event, question, .. } = *search;
    let mut whole = Assessment::nothing(&search.any_phase());
    for (group, (parts, &part)) in instant.groups.iter().zip(parts.iter().zip(&chosen)) {
        whole = whole.with(group, &parts[part].assessment);
    }
    let standing = standing(event.configuration, (instant, question, &whole));
    CombinedPhase { chosen, whole, standing }
}

/// Every way to choose one part for each group; if there are so many that an order of preference is given,
/// only those in which all groups but at most one take their preferred part.
fn choices<T>(parts: &[Vec<T>], order: Option<&[Vec<usize>]>) -> Vec<Vec<usize>> {
    let Some(order) = order else {
        let numbers: Vec<Vec<usize>> = parts.iter().map(|parts| (0..parts.len()).collect()).collect();
        return combinations(&numbers);
    };
    let at_place = |group: usize, place: usize| order[group].iter().position(|other| *other == place);
    let first: Vec<usize> = (0..parts.len()).filter_map(|group| at_place(group, 0)).collect();
    let others = (0..parts.len()).flat_map(|group| {
        let first = &first;
        (1..parts[group].len()).filter_map(move |place| {
            let mut chosen = first.clone();
            chosen[group] = at_place(group, place)?;
            Some(chosen)
        })
    });
    std::iter::once(first.clone()).chain(others).collect()
}

fn successor(
    search: &PhaseSearch<'_>,
    assessment: &Assessment,
    (parts, standing): (&[&GroupPhase], Standing),
) -> Successor {
    let (instant, event) = (search.instant, search.event);
    let state = state(instant, assessment);
    let mut phase = assessment.phase.clone();
    for (joint, found) in phase.joints.iter_mut().enumerate() {
        let acceleration = state.sliding_accelerations[joint];
        if !instant.joints[joint].has_friction && event.signs[joint] == 0.0 && acceleration < 0.0 {
            *found = JointPhase::Sliding(-1.0);
        }
    }
    let attainability = match search.detail {
        Detail::Everything => attainability(instant, event.configuration, &phase),
        Detail::Order => {
            let worst = parts.iter().map(|part| part.verdict).max_by_key(|verdict| severity(*verdict));
            Attainability::without_eigenvalues(worst.unwrap_or(Verdict::NotComputed), "")
        }
    };
    let is_present = parts.iter().all(|part| part.is_present);
    let continues = parts.iter().all(|part| part.continues);
    Successor { phase, state, is_present, continues, standing, attainability }
}

/// Rank of a verdict: the verdict for several independent groups is the one of highest rank.
fn severity(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::NotComputed => 0,
        Verdict::Attainable => 1,
        Verdict::Flutter => 2,
        Verdict::Undecided => 3,
        Verdict::Unattainable => 4,
    }
}

/// Keeps only one of several phases that differ only in the sides of contacts at which no force acts, now or
/// in the foreseeable future, or in joints that stick in one phase and do not begin to move in the other.
/// Phases of the second kind are kept beside the previous phase, which may be at its end.
fn without_copies(search: &PhaseSearch<'_>, list: &mut Vec<Successor>) {
    let stays = |one: &Successor, limit: PhaseBound| matches!(&one.standing, Standing::Undecided(limits) if limits.contains(&limit));
    let instant = search.instant;
    let is_copy = |one: &Successor, other: &Successor| {
        let rests = |joint: usize| {
            !one.is_present
                && one.phase.of(joint) == JointPhase::Sticking
                && instant.id_of(joint).is_some_and(|id| stays(other, PhaseBound::Slip(id)))
        };
        let same_joint = |joint: usize| one.phase.of(joint) == other.phase.of(joint) || rests(joint);
        let same_contact = |k: usize| {
            let zero = PhaseBound::NormalForce(ContactId(k));
            one.phase.contacts[k] == other.phase.contacts[k]
                || (stays(one, zero) && stays(other, zero))
                || instant.joint_of(k).is_some_and(rests)
        };
        (0..instant.rubbing()).all(same_joint)
            && (0..one.phase.contacts.len()).all(same_contact)
            && instant.groups.iter().all(|group| search.is_same_motion(group, [&one.state, &other.state]))
    };
    let mut index = 1;
    while index < list.len() {
        if list[..index].iter().any(|before| is_copy(before, &list[index])) {
            list.remove(index);
        } else {
            index += 1;
        }
    }
}

/// Every way to choose one element of each list, with the last list changing fastest.
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
