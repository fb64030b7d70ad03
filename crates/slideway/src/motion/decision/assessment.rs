//! How far a phase is from what bounds it: the slack of each of its inequalities, and what it does to the mechanism.

use super::instant::Instant;
use super::program::{Affine, Unsolved, highest};
use super::system::{Inequality, Question, Subject, System};
use crate::ids::ContactId;
use crate::modes::Side;
use crate::motion::{ContactPhase, JointPhase, Phase};

/// Slacks below this are rounding.
const ROUNDING: f64 = 1e-11;

/// An inequality that decides, with its slack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slack {
    /// What it is about; of inequalities that hang together through what statics leaves open, the friction of all
    /// joints that stick.
    pub(super) subject: Decisive,
    /// In units; negative if it is violated.
    pub(super) value: f64,
}

/// What a slack is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decisive {
    /// One inequality.
    One(Subject),
    /// All that depend on what statics leaves open.
    Open,
}

/// A phase with the sides of its sticking contacts and the reactions that leave most slack.
pub(super) struct Assessment {
    /// The phase; contacts that stick have the sides that leave most slack.
    pub(super) phase: Phase,
    /// What statics leaves open.
    pub(super) open: Vec<f64>,
    /// Slacks of its inequalities.
    pub(super) slacks: Vec<Slack>,
    /// The least slack of what concerns the joints that stick; infinite if none does.
    pub(super) margin: f64,
    /// Whether some of its equations follow from others, so that they could contradict each other at another instant.
    pub(super) redundant: bool,
}

impl Assessment {
    /// The least slack.
    pub(super) fn least(&self) -> f64 {
        self.slacks.iter().map(|slack| slack.value).fold(f64::INFINITY, f64::min)
    }

    fn is_better_than(&self, other: &Self, tolerance: f64) -> bool {
        let [this, that] = [self, other].map(|one| one.least() >= -tolerance);
        match (this, that) {
            (true, true) => self.margin > other.margin,
            (false, false) => self.least() > other.least(),
            _ => this,
        }
    }
}

/// A phase at an instant, with the sides of its sticking contacts that leave most slack; nothing if its equations
/// contradict each other for all of them.
///
/// # Errors
/// If a linear program was not solved.
pub(super) fn assess(
    instant: &Instant<'_>,
    question: &Question<'_>,
    phase: &Phase,
    tolerance: f64,
) -> Result<Option<Assessment>, Unsolved> {
    best_sides(instant, question, phase, (tolerance, f64::INFINITY))
}

/// The same, but no further sides are tried once an admissible state has this margin.
///
/// # Errors
/// If a linear program was not solved.
pub(super) fn best_sides(
    instant: &Instant<'_>,
    question: &Question<'_>,
    phase: &Phase,
    (tolerance, enough): (f64, f64),
) -> Result<Option<Assessment>, Unsolved> {
    let mut best: Option<Assessment> = None;
    for sides in sticking_sides(instant, phase) {
        let phase = with_sides(phase, &sides);
        let Some(found) = assess_sides(instant, question, phase)? else { continue };
        if best.as_ref().is_none_or(|best| found.is_better_than(best, tolerance)) {
            let done = found.margin >= enough && found.least() >= -tolerance;
            best = Some(found);
            if done {
                break;
            }
        }
    }
    Ok(best)
}

/// The system of an assessment that is there.
pub(super) fn system_of<'s>(
    instant: &'s Instant<'s>,
    question: &'s Question<'s>,
    assessment: &'s Assessment,
) -> Option<System<'s>> {
    System::new(instant, question, &assessment.phase)
}

/// A phase with the sides that it names; nothing if its equations contradict each other.
///
/// # Errors
/// If a linear program was not solved.
pub(super) fn assess_sides(
    instant: &Instant<'_>,
    question: &Question<'_>,
    phase: Phase,
) -> Result<Option<Assessment>, Unsolved> {
    let Some(system) = System::new(instant, question, &phase) else { return Ok(None) };
    let dimension = system.dimension();
    let inequalities = system.inequalities();
    let redundant = system.is_redundant();
    let depends = |inequality: &&Inequality| inequality.slack.coefficients.iter().any(|a| *a != 0.0);
    let together: Vec<Affine> =
        inequalities.iter().filter(depends).map(|inequality| inequality.slack.clone()).collect();
    let mut slacks = Vec::with_capacity(inequalities.len());
    let open = if together.is_empty() {
        vec![0.0; dimension]
    } else {
        let (value, open) = highest(&together, dimension)?;
        slacks.push(Slack { subject: Decisive::Open, value: without_rounding(value) });
        open
    };
    for inequality in inequalities.iter().filter(|inequality| !depends(inequality)) {
        let value = without_rounding(inequality.slack.constant);
        slacks.push(Slack { subject: Decisive::One(inequality.subject), value });
    }
    let sticks = |subject: &Decisive| match subject {
        Decisive::Open => true,
        Decisive::One(Subject::Pressure(k) | Subject::Couple(k) | Subject::Friction(k)) => {
            instant.joint_of(*k).is_some_and(|joint| phase.joints[joint] == JointPhase::Sticking)
        }
        Decisive::One(Subject::Share(_) | Subject::Slip(_)) => false,
    };
    let margins = slacks.iter().filter(|slack| sticks(&slack.subject)).map(|slack| slack.value);
    let margin = margins.fold(f64::INFINITY, f64::min);
    Ok(Some(Assessment { phase, open, slacks, margin, redundant }))
}

fn without_rounding(slack: f64) -> f64 {
    if slack.abs() <= ROUNDING { 0.0 } else { slack }
}

/// The sides that a contact may take: a gap only where the friction of its preload jumps.
pub(super) fn side_options(instant: &Instant<'_>, k: usize) -> &'static [ContactPhase] {
    const PRESSED: [ContactPhase; 2] =
        [ContactPhase::Pressed(Side::Positive), ContactPhase::Pressed(Side::Negative)];
    const ALL: [ContactPhase; 3] = [
        ContactPhase::Pressed(Side::Positive),
        ContactPhase::Pressed(Side::Negative),
        ContactPhase::PreloadGap,
    ];
    if instant.mechanism.preload_jumps(ContactId(k)) { &ALL } else { &PRESSED }
}

/// All combinations of sides of the contacts that stick; the phase's own one first.
fn sticking_sides(instant: &Instant<'_>, phase: &Phase) -> Vec<Vec<(usize, ContactPhase)>> {
    let mut all = vec![Vec::new()];
    for (joint, state) in phase.joints.iter().enumerate() {
        if *state != JointPhase::Sticking {
            continue;
        }
        for &k in &instant.joints[joint].contacts {
            let mut options = side_options(instant, k).to_vec();
            options.sort_by_key(|option| *option != phase.contacts[k]);
            all = all
                .into_iter()
                .flat_map(|sides: Vec<(usize, ContactPhase)>| {
                    options
                        .iter()
                        .map(move |side| [sides.as_slice(), &[(k, *side)]].concat())
                        .collect::<Vec<_>>()
                })
                .collect();
        }
    }
    all
}

fn with_sides(phase: &Phase, sides: &[(usize, ContactPhase)]) -> Phase {
    let mut changed = phase.clone();
    for (k, side) in sides {
        changed.contacts[*k] = *side;
    }
    changed
}
