//! Bounds of what else follows from the friction forces: the couples of guided sliders, to prove whether they
//! tip, accelerations and power.

use super::EnclosedModeProblem;
use crate::interval::Interval;
use crate::modes::{BySide, ContactState, Side};

/// Bounds of what an output is made of that is affine in the friction forces: `C = C(0) + sum_k gamma_k F_k`.
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedOutput {
    /// `C(0)`, its value without friction.
    pub frictionless: Interval,
    /// `gamma_k`, what a unit friction force of each contact adds, at either of its faces.
    pub influence: BySide<Vec<Interval>>,
    /// The same for the friction of the preload.
    pub influence_preload: BySide<Vec<Interval>>,
    /// What a unit normal force of each cut contact adds, with the contact: of redundant guides.
    pub self_stress: Vec<(usize, Interval)>,
}

/// Bounds of the couple of a guided slider.
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedCouple {
    /// The slider's only contact, from 0.
    pub contact: usize,
    /// Half of the length of its pressed face (m).
    pub half_length: Interval,
    /// The couple (N m); friction at either face of a contact adds the same but for the slider's own contact.
    pub couple: EnclosedOutput,
}

impl EnclosedOutput {
    /// An output to which friction at both faces of a contact adds the same.
    pub(super) fn of_either_face(frictionless: Interval, influence: Vec<Interval>) -> Self {
        let both = BySide { positive: influence.clone(), negative: influence };
        Self { frictionless, influence_preload: both.clone(), influence: both, self_stress: Vec::new() }
    }
}

/// Whether some guided slider tips.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tipping {
    /// None, for all values within bounds: `|C| <= |N| L / 2` everywhere.
    Never,
    /// It differs between values within bounds, or could not be decided.
    Open,
    /// One does for all values.
    Always,
}

impl EnclosedModeProblem {
    /// Whether a guided slider tips in a state with these bounds of `y_k = |N_k|`, or of the share of a
    /// contact in its gap (theory, section 1).
    ///
    /// # Panics
    /// If `pattern` and `y` do not have one entry for each contact.
    pub fn tipping(&self, pattern: &[ContactState], y: &[Interval]) -> Tipping {
        let worst = self.couples.iter().map(|couple| self.tipping_of(couple, pattern, y));
        worst.max().unwrap_or(Tipping::Never)
    }

    fn tipping_of(&self, couple: &EnclosedCouple, pattern: &[ContactState], y: &[Interval]) -> Tipping {
        let size = self.output(&couple.couple, pattern, y).abs();
        let k = couple.contact;
        let pressure = if pattern[k] == ContactState::Gap { Interval::ZERO } else { y[k] };
        let slack = couple.half_length * pressure - size;
        if slack.lower() >= 0.0 {
            Tipping::Never
        } else if slack.upper() < 0.0 {
            Tipping::Always
        } else {
            Tipping::Open
        }
    }

    /// Bounds of an output in a state with these bounds of `y_k = |N_k|`, or of the share of a contact in its
    /// gap: `C(0) + sum_k gamma_k F_k`, and what the normal forces of cut contacts add.
    ///
    /// # Panics
    /// If `pattern` and `y` do not have one entry for each contact.
    pub fn output(&self, output: &EnclosedOutput, pattern: &[ContactState], y: &[Interval]) -> Interval {
        let terms = (0..pattern.len()).map(|k| self.of_friction(output, k, pattern[k], y[k]));
        let of_normal_force = |&(k, stress): &(usize, Interval)| {
            pattern[k].side().map_or(Interval::ZERO, |side| stress * y[k] * Interval::point(side.sign()))
        };
        let stresses = output.self_stress.iter().map(of_normal_force);
        terms.chain(stresses).fold(output.frictionless, |sum, term| sum + term)
    }

    /// `gamma_k F_k` with `F_k = (mu_k |N_k| + F_k0) s_k`, eq. (2); in a gap `F_k0` is shared by both faces.
    fn of_friction(&self, output: &EnclosedOutput, k: usize, state: ContactState, y: Interval) -> Interval {
        let influence = &self.influence;
        let preload =
            |side: Side| output.influence_preload.get(side)[k] * influence.preload.get(side).entry(k, 0);
        let force = if let Some(side) = state.side() {
            output.influence.get(side)[k] * influence.mu.get(side).entry(k, 0) * y + preload(side)
        } else {
            let [positive, negative] = Side::BOTH.map(preload);
            negative + y * (positive - negative)
        };
        force * Interval::point(influence.velocity_signs[k])
    }
}
