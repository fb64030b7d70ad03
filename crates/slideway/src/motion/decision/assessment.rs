//! How far a phase is from its bounds: the slack of each of its inequalities, and what the phase does to the
//! mechanism.

use super::BOUNDARY;
use super::instant::Instant;
use super::outputs::Group;
use super::system::{Forces, Inequality, Question, Subject, System};
use crate::influence::ContactFriction;
use crate::modes::Side;
use crate::pattern::{Affine, ContactPhase, JointPhase, Phase, Region, Unsolved};

/// Slacks below this are rounding.
const ROUNDING: f64 = 1e-11;
/// Beyond this number, combinations of sides of the sticking contacts in a group are not tried.
pub(super) const MOST_SIDES: usize = 4096;

/// A deciding inequality, with its slack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slack {
    /// What it is about; for inequalities that are linked through what statics leaves open, the friction of
    /// all sticking joints.
    pub(super) subject: Decisive,
    /// In units; negative if it is violated.
    pub(super) value: f64,
}

/// What a slack is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decisive {
    /// One inequality.
    One(Subject),
    /// All inequalities that depend on what statics leaves open, in the group of joints that begins with this
    /// one.
    Open(usize),
}

/// A phase, or what a group of joints does in it, with the sides of its sticking contacts and the reactions
/// that leave the most slack.
#[derive(Debug, Clone)]
pub(super) struct Assessment {
    /// The phase; sticking contacts have the sides that leave the most slack.
    pub(super) phase: Phase,
    /// Forces of the contacts, in units.
    pub(super) forces: Forces,
    /// Number of reactions that statics leaves open.
    pub(super) indeterminate: usize,
    /// Slacks of its inequalities.
    pub(super) slacks: Vec<Slack>,
    /// The least slack of the inequalities that concern sticking joints; infinite if there are none.
    pub(super) margin: f64,
    /// Whether some of its equations follow from others, so that they could contradict each other at another
    /// instant.
    pub(super) redundant: bool,
}

impl Assessment {
    /// A phase about which nothing has been decided.
    pub(super) fn nothing(phase: &Phase) -> Self {
        let contacts = phase.contacts.len();
        let none = ContactFriction { positive_face: 0.0, negative_face: 0.0 };
        Self {
            phase: phase.clone(),
            forces: Forces {
                frictions: vec![none; contacts],
                normal: vec![0.0; contacts],
                shares: vec![None; contacts],
                couples: vec![0.0; phase.hinges.len()],
            },
            indeterminate: 0,
            slacks: Vec::new(),
            margin: f64::INFINITY,
            redundant: false,
        }
    }

    /// The same assessment, with a group's part taken from another one.
    pub(super) fn with(mut self, group: &Group, part: &Self) -> Self {
        for &joint in &group.joints {
            self.phase.joints[joint] = part.phase.joints[joint];
        }
        for &k in &group.contacts {
            self.phase.contacts[k] = part.phase.contacts[k];
            self.forces.frictions[k] = part.forces.frictions[k];
            self.forces.normal[k] = part.forces.normal[k];
            self.forces.shares[k] = part.forces.shares[k];
        }
        for &hinge in &group.hinges {
            self.phase.hinges[hinge] = part.phase.hinges[hinge];
            self.forces.couples[hinge] = part.forces.couples[hinge];
        }
        self.indeterminate += part.indeterminate;
        self.slacks.extend(&part.slacks);
        self.margin = self.margin.min(part.margin);
        self.redundant |= part.redundant;
        self
    }

    /// The least slack.
    pub(super) fn least(&self) -> f64 {
        self.slacks.iter().map(|slack| slack.value).fold(f64::INFINITY, f64::min)
    }

    fn is_better_than(&self, other: &Self) -> bool {
        let [this, that] = [self, other].map(|one| one.least() >= -BOUNDARY);
        match (this, that) {
            (true, true) => self.margin > other.margin,
            (false, false) => self.least() > other.least(),
            _ => this,
        }
    }
}

#[cfg(test)]
thread_local! {
    /// How many patterns have been assessed on this thread.
    pub(in crate::motion) static ASSESSED: std::cell::Cell<u64> = const { std::cell::Cell::new(0) };
}

/// Assesses a phase at an instant, with the sides of its sticking contacts that leave the most slack; `None`
/// if its equations contradict each other for all sides. Once an admissible state of a group has a sufficient
/// margin, no further sides are tried for the group.
///
/// # Errors
/// If a linear program was not solved.
pub(super) fn assess(
    instant: &Instant<'_>,
    question: &Question<'_>,
    phase: &Phase,
    enough: f64,
) -> Result<Option<Assessment>, Unsolved> {
    let mut whole = Assessment::nothing(phase);
    for group in &instant.groups {
        let Some(part) = assess_group(instant, question, (phase, group), enough)? else {
            return Ok(None);
        };
        whole = whole.with(group, &part);
    }
    Ok(Some(whole))
}

/// The same for a group of joints.
///
/// # Errors
/// If a linear program was not solved.
pub(super) fn assess_group(
    instant: &Instant<'_>,
    question: &Question<'_>,
    (phase, group): (&Phase, &Group),
    enough: f64,
) -> Result<Option<Assessment>, Unsolved> {
    let mut best: Option<Assessment> = None;
    let sticking = sticking_sides(question, phase, (instant, group));
    for number in 0.. {
        if number > MOST_SIDES {
            return Err(Unsolved);
        }
        let Some(phase) = with_sides(phase, &sticking, number) else { break };
        let Some(found) = assess_sides(instant, question, (phase, group))? else { continue };
        if best.as_ref().is_none_or(|best| found.is_better_than(best)) {
            let done = found.margin >= enough && found.least() >= -BOUNDARY;
            best = Some(found);
            if done {
                break;
            }
        }
    }
    Ok(best)
}

fn assess_sides(
    instant: &Instant<'_>,
    question: &Question<'_>,
    (phase, group): (Phase, &Group),
) -> Result<Option<Assessment>, Unsolved> {
    #[cfg(test)]
    ASSESSED.set(ASSESSED.get() + 1);
    System::new(instant, question, &phase, group).map(|system| assess_system(&system)).transpose()
}

/// The slacks of a pattern, and the reactions that leave the most slack.
pub(super) fn assess_system(system: &System<'_>) -> Result<Assessment, Unsolved> {
    let System { instant, phase, group, .. } = *system;
    let mut found = Assessment::nothing(phase);
    let inequalities = system.inequalities();
    let depends = |inequality: &&Inequality| inequality.slack.varies();
    let together: Vec<Affine> =
        inequalities.iter().filter(depends).map(|inequality| inequality.slack.clone()).collect();
    found.indeterminate = system.dimension();
    found.redundant = system.is_redundant();
    let pins = system.open_pins();
    let open = if together.is_empty() && pins.is_empty() {
        vec![0.0; found.indeterminate]
    } else {
        let (value, open) = Region::new(found.indeterminate, together).with_pins(pins).highest()?;
        let subject = Decisive::Open(group.members(instant.joints.len()).next().unwrap_or_default());
        found.slacks.push(Slack { subject, value: without_rounding(value) });
        open
    };
    for inequality in inequalities.iter().filter(|inequality| !depends(inequality)) {
        let value = without_rounding(inequality.slack.constant);
        found.slacks.push(Slack { subject: Decisive::One(inequality.subject), value });
    }
    let sticks = |slack: &&Slack| match slack.subject {
        Decisive::Open(_) => true,
        Decisive::One(subject) => concerns_sticking((instant, phase), subject),
    };
    let margins = found.slacks.iter().filter(sticks).map(|slack| slack.value);
    found.margin = margins.fold(f64::INFINITY, f64::min);
    system.write_forces(&open, &mut found.forces, &mut found.phase);
    Ok(found)
}

/// Whether an inequality concerns a joint that sticks in a phase.
pub(super) fn concerns_sticking((instant, phase): (&Instant<'_>, &Phase), subject: Subject) -> bool {
    match subject {
        Subject::Pressure(k) | Subject::Couple(k) | Subject::Friction(k) => {
            instant.joint_of(k).is_some_and(|joint| phase.joints[joint] == JointPhase::Sticking)
        }
        Subject::Circle(_) => true,
        Subject::Share(_) | Subject::Slip(_) | Subject::Gap(_) => false,
    }
}

fn without_rounding(slack: f64) -> f64 {
    if slack.abs() <= ROUNDING { 0.0 } else { slack }
}

/// The sides of a contact during an impulse, for which preloads do not count.
pub(super) const PRESSED: [ContactPhase; 2] =
    [ContactPhase::Pressed(Side::Positive), ContactPhase::Pressed(Side::Negative)];

/// The sticking contacts of a group with their possible sides, that of the phase first.
pub(super) fn sticking_sides(
    question: &Question<'_>,
    phase: &Phase,
    (instant, group): (&Instant<'_>, &Group),
) -> Vec<(usize, Vec<ContactPhase>)> {
    let sticks = |joint: &&usize| phase.joints[**joint] == JointPhase::Sticking;
    let contacts = group.joints.iter().filter(sticks).flat_map(|joint| &instant.joints[*joint].contacts);
    let options = |k: &usize| {
        let mut options = question.sides[*k].clone();
        options.sort_by_key(|option| *option != phase.contacts[*k]);
        (*k, options)
    };
    contacts.map(options).collect()
}

/// The sliding contacts of a group with their possible sides.
pub(super) fn sliding_sides(
    question: &Question<'_>,
    phase: &Phase,
    (instant, group): (&Instant<'_>, &Group),
) -> Vec<(usize, Vec<ContactPhase>)> {
    let slides =
        |k: usize| instant.joint_of(k).is_some_and(|joint| phase.joints[joint] != JointPhase::Sticking);
    let sliding = group.contacts.iter().filter(|k| slides(**k));
    sliding.map(|k| (*k, question.sides[*k].clone())).collect()
}

/// A phase with the combination of sides of this number; `None` beyond the last.
pub(super) fn with_sides(
    phase: &Phase,
    sides: &[(usize, Vec<ContactPhase>)],
    mut number: usize,
) -> Option<Phase> {
    let mut changed = phase.clone();
    for (k, options) in sides.iter().rev() {
        changed.contacts[*k] = options[number % options.len()];
        number /= options.len();
    }
    (number == 0).then_some(changed)
}
