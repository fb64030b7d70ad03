//! How far friction may grow before the answer changes.

use super::mode_problem::ProblemData;
use super::stages::Stages;
use super::state::{pattern, signs};
use super::upright::{FALLING, GROWING, Upright, distinct, guided, upright};
use crate::enclosure::EnclosedModeProblem;
use crate::interval::{Interval, Sign};
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::modes::certificate::{IntervalModeProblem, proven_determinant_sign};
use crate::modes::existence::{
    CountInterval, EndCause, Existence, ExistenceOptions, ModeEnd, ModeInterval, ModeProblemLine, counts,
    is_same_end, nothing_is_left,
};
use crate::modes::{ContactState, InfluenceCoefficients, ModeProblem};
use crate::problem::rougher;
use crate::report::{
    self, CriticalContact, Margins, MarginsMissing, SolveReport, Status, TippingLimit, TippingRange,
    Unlocking,
};

/// The most patterns for which margins are computed.
pub(super) const PATTERNS: u64 = 256;
/// Ends closer to the present friction than this belong to it: the state is on a boundary.
pub(crate) const AT_ONCE: f64 = 1e-9;

/// Adds the margins to a report, if there are few enough modes, and each can be followed. The one of every
/// load needs bounds of the exact numbers.
pub(super) fn add(
    report: &mut SolveReport,
    data: ProblemData<'_>,
    enclosed: Option<&EnclosedModeProblem>,
    joints: &dyn Fn(&[i8]) -> Vec<report::JointMode>,
) {
    if report.status == Status::Continuum {
        report.margins_missing = Some(MarginsMissing::Undetermined);
        return;
    }
    let Some(all) = Growth::along(data, &|_| true) else {
        report.margins_missing = Some(MarginsMissing::TooManyModes);
        return;
    };
    let mechanism = data.mechanism;
    // A guided slider between its faces, or just at one of them, hangs on a normal force that is zero: no
    // mode that could be followed.
    let is_free = |k: usize| data.free_face(&all.line.has_jump, k).is_some();
    let hanging = |state: &report::Solution| {
        if !state.floating.is_empty() {
            return Some(MarginsMissing::Floats);
        }
        let free = (0..state.signs.len()).filter(|&k| state.signs[k] == 0 && is_free(k));
        let is_between =
            |k: usize| state.contacts[k].couple.is_some() && state.contacts[k].preload_share.is_some();
        free.map(
            |k| if is_between(k) { MarginsMissing::BetweenFaces } else { MarginsMissing::NothingPresses },
        )
        .next()
    };
    report.margins_missing = report.solutions.iter().chain(&report.preload_gap_states).find_map(hanging);
    if report.margins_missing.is_some() {
        return;
    }
    for solution in report.solutions.iter_mut().chain(&mut report.preload_gap_states) {
        let margin = |mode: &ModeInterval| {
            let nothing_is_left = nothing_is_left(&all.counts, mode.to.at, false, is_same_end);
            mode_margin(mechanism, (&mode.pattern, &mode.to), nothing_is_left)
        };
        solution.margin = all.end_of(&solution.pattern).map(margin);
    }
    let falling = Growth::over(FALLING, data, &|_| true);
    // Where there is no solution, less friction may leave one.
    let is_jammed = all.counts.first().is_some_and(CountInterval::is_empty);
    let stands = falling.as_ref().filter(|falling| {
        falling.existence.not_computed.is_empty() && Upright::of(&all.existence, mechanism).is_some()
    });
    let below = stands.and_then(|falling| Upright::below(&falling.existence, mechanism));
    let tips_between = falling.as_ref().and_then(|falling| all.tips_between(falling, mechanism));
    let falling = falling.filter(|_| is_jammed);
    report.margins = Some(Margins {
        mu: common_coefficient(mechanism),
        another_count: all.another_count(),
        no_solution: all.no_solution(),
        tips: all.tips(mechanism),
        tipping: all.tipping(mechanism),
        below: below.map(|Upright { until, tips }| TippingLimit { factor: until, joints: tips }),
        tips_between,
        solutions_again: all.solutions_again(),
        uniqueness: enclosed.and_then(|enclosed| uniqueness(data, &all, enclosed)),
        moves_below: falling.as_ref().and_then(|falling| falling.moves_below(mechanism)),
        locking: falling
            .and_then(Growth::locking_mode)
            .map(|(mode, factor)| locking_in_words(&mode, factor, joints)),
        critical_contact: critical_contact(data),
    });
}

/// The factor up to which every load has exactly one solution, where a determinant is proven to change its sign;
/// none if there is no such factor, or with jumps of preloads. Of redundant guides, whatever their play,
/// misalignment and stiffness: these decide which determinate part of the mechanism carries alone, and the
/// determinants of all of these parts count, each with one face of a press fit at most.
fn uniqueness(data: ProblemData<'_>, all: &Growth, enclosed: &EnclosedModeProblem) -> Option<f64> {
    let mut coefficients = enclosed.coefficients.clone();
    if data.mechanism.has_one_sided() {
        match unique_without_friction(&coefficients) {
            Some(true) => {}
            Some(false) => return Some(0.0),
            None => return None,
        }
    }
    let Some(shared) = &mut coefficients.shared else {
        let jumps = all.line.has_jump.contains(&true);
        return (!jumps).then(|| first_locking(&all.line, &coefficients)).flatten();
    };
    shared.clearance.fill(Interval::ONE);
    shared.press_fits.clear();
    let mut determinate = data.coefficients(&[], &[]).ok()?;
    determinate.shared = None;
    if ModeProblem::from_influence(&determinate).ok()?.jumps_of_contacts().contains(&true) {
        return None;
    }
    let mut loose = data.mechanism.clone();
    for contact in &mut loose.contacts {
        (contact.play, contact.misalignment, contact.stiffness) = (2.0, 0.0, Some(1.0));
        contact.face = None;
    }
    let line = ProblemData { mechanism: &loose, ..data }.growing_friction(&|_| true).ok()?;
    first_locking(&line, &coefficients)
}

/// Returns whether without friction every load has exactly one solution: whether the determinants of all patterns are proven to
/// have the orientation of the pattern (theory, section 5). Where each contact has two faces they do; of contacts that may lift
/// off it depends on what drives hold. `None` if a sign is not proven.
fn unique_without_friction(coefficients: &InfluenceCoefficients<Interval>) -> Option<bool> {
    let smooth = IntervalModeProblem::from_influence(&rougher(coefficients, &[], Interval::ZERO)).ok()?;
    let contacts = coefficients.contacts();
    let patterns =
        1_u64.checked_shl(u32::try_from(contacts).ok()?).filter(|patterns| *patterns <= PATTERNS)?;
    let mut all_proven = true;
    for number in 0..patterns {
        let is_negative = |contact: usize| number >> contact & 1 == 1;
        let state =
            |contact| if is_negative(contact) { ContactState::Negative } else { ContactState::Positive };
        let pattern: Vec<ContactState> = (0..contacts).map(state).collect();
        let expected = if number.count_ones() % 2 == 0 { Sign::Positive } else { Sign::Negative };
        match proven_determinant_sign(&smooth, &pattern) {
            Some(sign) if sign == expected => {}
            Some(Sign::Positive | Sign::Negative) => return Some(false),
            _ => all_proven = false,
        }
    }
    all_proven.then_some(true)
}

/// The factor at which a determinant along a line is proven to change its sign, with bounds of the same numbers.
fn first_locking(line: &ModeProblemLine, enclosed: &InfluenceCoefficients<Interval>) -> Option<f64> {
    let sign_at = |factor: f64, pattern: &[ContactState]| {
        let rougher = rougher(enclosed, &[], Interval::point(factor));
        proven_determinant_sign(&IntervalModeProblem::from_influence(&rougher).ok()?, pattern)
    };
    line.first_locking(PATTERNS, &sign_at).ok()?.map(|(factor, _)| factor)
}

/// Returns the last factor on all friction, of those that margins name, at which the number of solutions
/// changes. Returns `None` if nothing changes, or that is not computed, or contacts have other coefficients
/// than `only`, if that is given.
pub(crate) fn last_change(model: &Model, only: Option<f64>) -> Option<f64> {
    let stages = Stages::of_any_model(model).ok()?;
    if stages.mechanism.rough_hinges().next().is_some()
        || !stages.standing.is_empty()
        || only.is_some() && common_coefficient(&stages.mechanism) != only
    {
        return None;
    }
    let growth = Growth::along(stages.data(), &|_| true)?;
    growth.another_count().into_iter().chain(growth.no_solution()).reduce(f64::max)
}

/// The modes as friction grows by a factor.
struct Growth {
    line: ModeProblemLine,
    existence: Existence,
    counts: Vec<CountInterval>,
}

/// The coefficient of all contacts that have friction; none where they differ, and where none has.
pub(crate) fn common_coefficient(mechanism: &Mechanism) -> Option<f64> {
    let mut coefficients = mechanism.contacts.iter().flat_map(|contact| contact.mu).filter(|mu| *mu > 0.0);
    let first = coefficients.next()?;
    coefficients.all(|mu| mu == first).then_some(first)
}

/// A mode that locks, in words.
fn locking_in_words(
    mode: &[ContactState],
    factor: f64,
    joints: &dyn Fn(&[i8]) -> Vec<report::JointMode>,
) -> report::LockedMode {
    report::LockedMode { joints: joints(&signs(mode)), pattern: pattern(mode), factor }
}

/// Of a mechanism without solution: the mode that locks last as all friction grows to the present one, and at what part
/// of it; none if none locks, or past the limit of work.
pub(super) fn locking_mode(data: ProblemData<'_>) -> Option<(Vec<ContactState>, f64)> {
    Growth::over(FALLING, data, &|_| true)?.locking_mode()
}

/// The contact whose friction alone changes the number of solutions at the smallest factor.
fn critical_contact(data: ProblemData<'_>) -> Option<CriticalContact> {
    let contacts = data.mechanism.contacts.iter().enumerate();
    let rough = contacts.filter(|(_, contact)| contact.mu != [0.0; 2] && !contact.is_second_face());
    let factor = |(k, contact): (usize, &crate::mechanism::Contact)| {
        let other_face = contact.face.map(|face| face.other.index());
        let factor =
            Growth::along(data, &|other| other == k || Some(other) == other_face)?.another_count()?;
        Some(CriticalContact { contact: contact.place().to_owned(), factor })
    };
    rough.filter_map(factor).min_by(|one, other| one.factor.total_cmp(&other.factor))
}

impl Growth {
    /// To what all friction would have to fall for a solution, with friction that falls to none; none if there is none
    /// down to no friction at all, or one comes at once.
    fn moves_below(&self, mechanism: &Mechanism) -> Option<Unlocking> {
        let last = self.counts.iter().rfind(|count| !count.is_empty())?;
        let factor = last.to;
        let mu = common_coefficient(mechanism).map(|mu| factor * mu);
        (factor < 1.0 - AT_ONCE).then_some(Unlocking { factor, mu })
    }

    /// The mode that locks last, and at what factor; none if none locks.
    fn locking_mode(self) -> Option<(Vec<ContactState>, f64)> {
        let ends = self.existence.modes.into_iter().flat_map(|mode| {
            let ModeInterval { pattern, from, to } = mode;
            [(pattern.clone(), from), (pattern, to)]
        });
        let locking = ends.filter(|(_, end)| end.cause == EndCause::Singular);
        locking.map(|(pattern, end)| (pattern, end.at)).max_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// The modes while the friction of some contacts grows; none past the limit of work.
    fn along(data: ProblemData<'_>, grows: &dyn Fn(usize) -> bool) -> Option<Self> {
        Self::over(GROWING, data, grows)
    }

    /// The modes over a range of factors of the friction of some contacts; none past the limit of work.
    fn over(range: [f64; 2], data: ProblemData<'_>, grows: &dyn Fn(usize) -> bool) -> Option<Self> {
        let line = data.growing_friction(grows).ok()?;
        let options = ExistenceOptions { range, greatest_normal_force: None, patterns: PATTERNS };
        let existence = line.existence(&options).ok()?;
        let counts = counts(&line, &existence, range);
        Some(Self { line, existence, counts })
    }

    /// The factor at which there is another number of solutions, gap states counted apart.
    fn another_count(&self) -> Option<f64> {
        self.counts.get(1).map(|next| next.from)
    }

    /// The factor just beyond which there is neither a solution nor a gap state.
    fn no_solution(&self) -> Option<f64> {
        self.counts.iter().find(|count| count.is_empty()).map(|count| count.from)
    }

    /// The guided sliders that tip at that factor.
    fn tips(&self, mechanism: &Mechanism) -> Vec<String> {
        let Some(at) = self.no_solution() else { return Vec::new() };
        distinct(guided(&self.existence, mechanism, [at, f64::INFINITY], is_same_end).concat())
    }

    /// The blocks that lift off a corner and tip before that, and from where on.
    fn tipping(&self, mechanism: &Mechanism) -> Option<TippingLimit> {
        let Upright { until, tips } = Upright::of(&self.existence, mechanism)?;
        let is_before = self.no_solution().is_none_or(|jams| !is_same_end(jams, until));
        (is_before && !tips.is_empty()).then_some(TippingLimit { factor: until, joints: tips })
    }

    /// Between which factors a block tips that does as it is: from where nothing tips with less friction, up to where nothing
    /// does with more; none where nothing tips, and of an end that is not there.
    fn tips_between(&self, falling: &Self, mechanism: &Mechanism) -> Option<TippingRange> {
        let tips = |mode: &&ModeInterval| !mechanism.tipped(&mode.pattern).is_empty();
        let now = |mode: &&ModeInterval| mode.from.at <= 1.0 + AT_ONCE;
        self.existence.modes.iter().filter(now).find(tips)?;
        if Upright::of(&self.existence, mechanism).is_some() {
            return None;
        }
        let from = upright(&falling.existence, mechanism).map(|mode| mode.to.at).reduce(f64::max);
        let to = upright(&self.existence, mechanism).map(|mode| mode.from.at).reduce(f64::min);
        Some(TippingRange { from, to })
    }

    /// The factor beyond that from which on there are solutions or gap states again.
    fn solutions_again(&self) -> Option<f64> {
        let beyond = self.counts.iter().skip_while(|count| !count.is_empty());
        beyond.skip_while(|count| count.is_empty()).map(|count| count.from).next()
    }

    /// The interval of a mode that exists now.
    fn end_of(&self, pattern: &str) -> Option<&ModeInterval> {
        let same =
            |mode: &&ModeInterval| self::pattern(&mode.pattern) == pattern && mode.from.at <= 1.0 + AT_ONCE;
        self.existence.modes.iter().find(same)
    }
}

/// The factor of friction at which a mode ends, and what ends it.
pub(super) fn mode_margin(
    mechanism: &Mechanism,
    (pattern, end): (&[ContactState], &ModeEnd),
    nothing_is_left: bool,
) -> report::ModeMargin {
    let names = |contacts: &[usize]| -> Vec<String> {
        contacts.iter().map(|&k| mechanism.contacts[k].name.to_string()).collect()
    };
    let closed = |contact| mechanism.is_closed(pattern, contact);
    let cause = &end.cause;
    let ends_with = match cause {
        EndCause::Range | EndCause::Reversal | EndCause::NoProblem => report::ModeEndCause::Nothing,
        cause => report::ModeEndCause::new(cause, nothing_is_left, closed),
    };
    let contacts = match cause {
        EndCause::SideChange(contacts) => names(&report::ModeEndCause::of_those(contacts, closed)),
        EndCause::GapCloses(contacts) | EndCause::GreatestNormalForce(contacts) => names(contacts),
        _ => Vec::new(),
    };
    report::ModeMargin { factor: end.at.is_finite().then_some(end.at), ends_with, contacts }
}
