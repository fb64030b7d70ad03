//! What is told of limits: plain data, which are the JSON output.

use super::conclusion::conclusion;
use super::find::{Elsewhere, Found, Knowledge, Method, left_out};
use super::guarantee::guarantee;
use super::varied::Varied;
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::mechanism::{JointKind, Mechanism, Slider};
use crate::model::Model;
use crate::modes::ContactState;
use crate::modes::existence::{CountInterval, EndCause, Limit, ModeEnd, ModeInterval};
use crate::report::{JointMode, ModeEndCause, locked};
use crate::solve::{mode_in_words, pattern, signs};
use serde::Serialize;

/// Version of the layout of a [`LimitsReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/limits/2";

/// For which values each mode exists.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LimitsReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// The title of the model.
    pub title: Option<String>,
    /// What is varied.
    pub vary: VariedQuantity,
    /// In how many steps the positions were followed from the drawing, each proven to stay on its assembly branch; absent
    /// where they are those of the drawing, and where a coordinate is varied: then `guarantee` tells of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_from_drawing: Option<usize>,
    /// How the ends of modes were found.
    pub method: LimitsMethod,
    /// What the method can miss, in words.
    pub guarantee: String,
    /// The modes in the direction of the model's rates.
    pub modes: Vec<ModeLimits>,
    /// Numbers of solutions in that direction.
    pub counts: Vec<CountLimits>,
    /// Ranges in which the mechanism cannot be assembled or solved, or the model is not allowed, in that direction.
    pub without_mode_problem: Vec<RangeWithoutProblem>,
    /// Single values at which a guided slider is between its faces, in that direction; absent if none was found.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub between_faces_at: Vec<f64>,
    /// The opposite direction, if it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reversed: Option<Direction>,
    /// What it comes to, in words.
    pub conclusion: Vec<String>,
}

/// How the ends of modes were found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum LimitsMethod {
    /// As zeros of determinants.
    #[serde(rename = "closed form")]
    ClosedForm,
    /// Between values that were tried.
    Bracketing,
    /// Nothing depends on what is varied.
    Independent,
}

/// What is varied, in SI units.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct VariedQuantity {
    /// Its name.
    pub name: String,
    /// Its unit; empty where there is none, or none is known.
    pub unit: String,
    /// Where the range begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Its value in the model.
    pub value: f64,
}

impl VariedQuantity {
    pub(crate) fn new(varied: &Varied, [from, to]: [f64; 2], value: f64) -> Self {
        Self { name: varied.name.clone(), unit: varied.unit(), from, to, value }
    }
}

/// The modes of the opposite direction of motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Direction {
    /// The modes.
    pub modes: Vec<ModeLimits>,
    /// Numbers of solutions.
    pub counts: Vec<CountLimits>,
    /// Ranges in which the mechanism cannot be assembled or solved, or the model is not allowed.
    pub without_mode_problem: Vec<RangeWithoutProblem>,
    /// Single values at which a guided slider is between its faces; absent if none was found.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub between_faces_at: Vec<f64>,
}

/// An interval in which a mode has a solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModeLimits {
    /// Its pattern: "+" and "-" for the signs of the normal forces, "0" in a preload gap.
    pub pattern: String,
    /// The same as numbers.
    pub signs: Vec<i8>,
    /// Whether a contact rests in its preload gap.
    pub preload_gap: bool,
    /// The contact mode of each sliding joint, as the mechanism lies in the model's state.
    pub joints: Vec<JointMode>,
    /// Where it begins.
    pub from: Option<f64>,
    /// Where it ends.
    pub to: Option<f64>,
    /// Why it begins there.
    pub from_is: ModeEndCause,
    /// Why it ends there.
    pub to_is: ModeEndCause,
    /// The contacts or guided sliders that begin it.
    pub from_at: Vec<String>,
    /// The contacts or guided sliders that end it.
    pub to_at: Vec<String>,
    /// What the normal force of each contact does towards both ends.
    pub reactions: Vec<EndReaction>,
}

/// What a normal force does towards both ends of an interval.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EndReaction {
    /// The contact.
    pub contact: String,
    /// Its limit towards the beginning (N); null where it grows without bound or was not computed.
    pub from: Option<f64>,
    /// Its limit towards the end, likewise.
    pub to: Option<f64>,
    /// 1 or -1 where it grows without bound towards the beginning with this sign, else 0.
    pub from_grows: i8,
    /// The same towards the end.
    pub to_grows: i8,
}

/// An interval with the same number of solutions throughout.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CountLimits {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Number of solutions.
    pub solutions: usize,
    /// Number of preload-gap states, which are counted apart.
    pub preload_gap_states: usize,
    /// How these numbers are known.
    pub known: Known,
    /// The stretches for all values of which they are proven, both ends included. If `known` is `proven` nothing of the interval lies
    /// between them but what is next to ends of modes: [`CountLimits::left_out`].
    pub proven: Vec<[f64; 2]>,
    /// Where they were sampled: the greatest distance between neighbouring values; else null.
    pub spacing: Option<f64>,
}

/// How the numbers of solutions in an interval are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Known {
    /// By the certified search for all values but those next to ends of modes: for all of [`CountLimits::proven`].
    Proven,
    /// Outside [`CountLimits::proven`] by zeros of determinants, which were computed in rounded numbers.
    ClosedForm,
    /// Outside [`CountLimits::proven`] at values that were tried.
    Sampled,
    /// Not at all: at some value there is another number.
    Undecided,
}

impl CountLimits {
    /// The widest part of the interval that is not proven; all of it if nothing is.
    pub fn left_out(&self) -> f64 {
        left_out([self.from, self.to], &self.proven)
    }
}

/// A range in which there is no mode problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RangeWithoutProblem {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Why: what is at fault in its middle.
    pub reason: String,
}

impl RangeWithoutProblem {
    pub(crate) fn of(found: &Found) -> Vec<Self> {
        let range = |gap: &super::find::Gap| Self { from: gap.from, to: gap.to, reason: gap.reason() };
        found.gaps.iter().map(range).collect()
    }
}

/// The names of a mechanism's parts, and how its guides lie.
pub(crate) struct Naming {
    pub(super) mechanism: Mechanism,
    configuration: Configuration,
}

impl Naming {
    /// # Errors
    /// A model that cannot be assembled in its state.
    pub(crate) fn new(model: &Model) -> Result<Self, Faults> {
        let mechanism = Mechanism::new(model)?;
        let configuration = Configuration::new(&mechanism)?;
        Ok(Self { mechanism, configuration })
    }

    fn joint_modes(&self, signs: &[i8]) -> Vec<JointMode> {
        let one = |(_, name, slider): (JointId, &str, &Slider)| {
            let tangent = self.configuration.slide(&self.mechanism, slider).tangent;
            let signs: Vec<i8> = slider.contacts.iter().map(|contact| signs[contact.index()]).collect();
            JointMode { name: name.to_owned(), mode: mode_in_words(slider, tangent, &signs) }
        };
        self.sliders().map(one).collect()
    }

    /// The contact modes of all joints in a pattern, in words.
    pub(crate) fn in_words(&self, pattern: &str) -> String {
        let sign = |sign: char| match sign {
            '+' => 1,
            '-' => -1,
            _ => 0,
        };
        let signs: Vec<i8> = pattern.chars().map(sign).collect();
        let words =
            self.joint_modes(&signs).into_iter().map(|joint| format!("{} {}", joint.name, joint.mode));
        words.collect::<Vec<_>>().join("; ")
    }

    fn sliders(&self) -> impl Iterator<Item = (JointId, &str, &Slider)> {
        self.mechanism.joints.iter().enumerate().filter_map(|(index, joint)| match &joint.kind {
            JointKind::Slider(slider) => Some((JointId(index), &*joint.name, slider)),
            JointKind::Hinge(_) => None,
        })
    }

    fn contacts(&self, contacts: &[usize]) -> Vec<String> {
        contacts.iter().map(|&k| self.mechanism.contacts[k].name.to_string()).collect()
    }

    /// The guided sliders with these bounds, which are numbered in the order of the joints.
    fn guided(&self, bounds: &[usize]) -> Vec<String> {
        let guided = self.sliders().filter(|(_, _, slider)| slider.kind == crate::model::SliderKind::Guided);
        let names: Vec<&str> = guided.map(|(_, name, _)| name).collect();
        bounds.iter().filter_map(|&bound| names.get(bound)).map(|name| (*name).to_owned()).collect()
    }

    fn mode(&self, mode: &ModeInterval) -> ModeLimits {
        let signs = signs(&mode.pattern);
        let reaction = |(k, contact): (usize, &crate::mechanism::Contact)| {
            let ((from, from_grows), (to, to_grows)) = (limit(&mode.from, k), limit(&mode.to, k));
            EndReaction { contact: contact.name.to_string(), from, to, from_grows, to_grows }
        };
        ModeLimits {
            pattern: pattern(&mode.pattern),
            preload_gap: mode.pattern.contains(&ContactState::Gap),
            joints: self.joint_modes(&signs),
            signs,
            from: finite(mode.from.at),
            to: finite(mode.to.at),
            from_is: (&mode.from.cause).into(),
            to_is: (&mode.to.cause).into(),
            from_at: self.ends_at(&mode.from.cause),
            to_at: self.ends_at(&mode.to.cause),
            reactions: self.mechanism.contacts.iter().enumerate().map(reaction).collect(),
        }
    }

    /// The contacts or guided sliders at which a mode ends.
    fn ends_at(&self, cause: &EndCause) -> Vec<String> {
        match cause {
            EndCause::SideChange(contacts)
            | EndCause::GapCloses(contacts)
            | EndCause::GreatestNormalForce(contacts) => self.contacts(contacts),
            EndCause::OutputBound(bounds) => self.guided(bounds),
            EndCause::Range | EndCause::Locking | EndCause::Reversal | EndCause::NoProblem => Vec::new(),
        }
    }

    fn direction(&self, found: &Found) -> Direction {
        let count = |(interval, known): (&CountInterval, &Knowledge)| CountLimits {
            from: interval.from,
            to: interval.to,
            solutions: interval.solutions,
            preload_gap_states: interval.gap_states,
            known: match known.elsewhere {
                Elsewhere::Nothing => Known::Proven,
                Elsewhere::ClosedForm => Known::ClosedForm,
                Elsewhere::Sampled(_) => Known::Sampled,
                Elsewhere::Contradicted => Known::Undecided,
            },
            proven: known.proven.clone(),
            spacing: if let Elsewhere::Sampled(spacing) = known.elsewhere { Some(spacing) } else { None },
        };
        Direction {
            modes: found.existence.modes.iter().map(|mode| self.mode(mode)).collect(),
            counts: found.counts.iter().zip(&found.known).map(count).collect(),
            without_mode_problem: RangeWithoutProblem::of(found),
            between_faces_at: found.between_faces.values().to_vec(),
        }
    }
}

/// The report on both directions, of which the opposite one may be absent.
pub(super) fn report(
    naming: &Naming,
    varied: &Varied,
    range: [f64; 2],
    (found, reversed): (&Found, Option<&Found>),
) -> LimitsReport {
    let forwards = naming.direction(found);
    let reversed = reversed.map(|found| naming.direction(found));
    let locked = locked(varied.model().has_guided_sliders());
    let conclusion = conclusion((&varied.name, found.method), locked, &forwards, reversed.as_ref());
    let value = varied.present().unwrap_or_default();
    let mut guarantee = guarantee(found);
    if varied.is_coordinate() {
        guarantee += " Each position was followed from the drawing by steps that are proven to stay on its assembly branch.";
    }
    LimitsReport {
        schema: SCHEMA,
        title: naming.mechanism.title.clone(),
        vary: VariedQuantity::new(varied, range, value),
        steps_from_drawing: naming.configuration.steps_from_drawing().filter(|_| !varied.is_coordinate()),
        method: match found.method {
            Method::ClosedForm => LimitsMethod::ClosedForm,
            Method::Same { .. } => LimitsMethod::Independent,
            Method::Bracketing => LimitsMethod::Bracketing,
        },
        guarantee,
        modes: forwards.modes,
        counts: forwards.counts,
        without_mode_problem: forwards.without_mode_problem,
        between_faces_at: forwards.between_faces_at,
        reversed,
        conclusion,
    }
}

fn limit(end: &ModeEnd, contact: usize) -> (Option<f64>, i8) {
    match end.normal_force.as_ref().and_then(|force| force.get(contact)) {
        // Adding zero turns -0 into 0.
        Some(Limit::Finite(value)) => (finite(value + 0.0), 0),
        Some(Limit::Infinite(sign)) => (None, if *sign > 0.0 { 1 } else { -1 }),
        None => (None, 0),
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
