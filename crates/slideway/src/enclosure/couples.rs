//! Bounds of the couples of guided sliders, to prove whether they tip.

use super::EnclosedModeProblem;
use crate::interval::Interval;
use crate::modes::{BySide, ContactState, Side};

/// Bounds of what the couple of a guided slider is made of: `C = C(0) + sum_k gamma_k F_k`.
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedCouple {
    /// The slider's only contact, from 0.
    pub contact: usize,
    /// Half of the length of its pressed face (m).
    pub half_length: Interval,
    /// `C(0)`, the couple without friction (N m).
    pub frictionless: Interval,
    /// `gamma_k`, what a unit friction force of each contact adds (m), at either of its faces: the same but
    /// for the slider's own contact.
    pub influence: BySide<Vec<Interval>>,
    /// The same for the friction of the preload.
    pub influence_preload: BySide<Vec<Interval>>,
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
        let terms = (0..pattern.len()).map(|k| self.couple_of_friction(couple, k, pattern[k], y[k]));
        let size = terms.fold(couple.frictionless, |sum, term| sum + term).abs();
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

    /// `gamma_k F_k` with `F_k = (mu_k |N_k| + F_k0) s_k`, eq. (2); in a gap `F_k0` is shared by both faces.
    fn couple_of_friction(
        &self,
        couple: &EnclosedCouple,
        k: usize,
        state: ContactState,
        y: Interval,
    ) -> Interval {
        let influence = &self.influence;
        let preload =
            |side: Side| couple.influence_preload.get(side)[k] * influence.preload.get(side).entry(k, 0);
        let force = if let Some(side) = state.side() {
            couple.influence.get(side)[k] * influence.mu.get(side).entry(k, 0) * y + preload(side)
        } else {
            let [positive, negative] = Side::BOTH.map(preload);
            negative + y * (positive - negative)
        };
        force * Interval::point(influence.velocity_signs[k])
    }
}
