//! Bounds of the couples of guided sliders, to prove whether they tip.

use super::EnclosedModeProblem;
use crate::interval::Interval;
use crate::modes::{ContactState, Side};

/// Bounds of what the couple of a guided slider is made of: `C = C(0) + sum_k gamma_k F_k`. Friction has the same
/// influence at both faces of its contact (the couple between them stays in its own joint).
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedCouple {
    /// The slider's only contact, from 0.
    pub contact: usize,
    /// Half of the length of its pressed face (m).
    pub half_length: Interval,
    /// `C(0)`, the couple without friction (N m).
    pub frictionless: Interval,
    /// `gamma_k`, what a unit friction force of each contact adds (m).
    pub influence: Vec<Interval>,
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
    /// Whether a guided slider tips in a state with these bounds of `y_k = |N_k|` (theory, section 1); what stands for a
    /// contact in its gap does not count.
    ///
    /// # Panics
    /// If `pattern` and `y` do not have one entry for each contact.
    pub fn tipping(&self, pattern: &[ContactState], y: &[Interval]) -> Tipping {
        let friction: Vec<Interval> =
            pattern.iter().enumerate().map(|(k, state)| self.friction(k, *state, y[k])).collect();
        let pressure = |k: usize| if pattern[k] == ContactState::Gap { Interval::ZERO } else { y[k] };
        let worst = self.couples.iter().map(|couple| couple.tipping(&friction, pressure(couple.contact)));
        worst.max().unwrap_or(Tipping::Never)
    }

    /// `F_k = (mu_k |N_k| + F_k0) s_k`, eq. (2); in a gap something between the preloads of both faces.
    fn friction(&self, contact: usize, state: ContactState, y: Interval) -> Interval {
        let influence = &self.influence;
        let preload = |side: Side| influence.preload.get(side).entry(contact, 0);
        let size = match state.side() {
            Some(side) => influence.mu.get(side).entry(contact, 0) * y + preload(side),
            None => preload(Side::Positive).hull(preload(Side::Negative)),
        };
        size * Interval::point(influence.velocity_signs[contact])
    }
}

impl EnclosedCouple {
    fn tipping(&self, friction: &[Interval], y: Interval) -> Tipping {
        let terms = self.influence.iter().zip(friction);
        let couple = terms.fold(self.frictionless, |sum, (&gamma, &force)| sum + gamma * force);
        let slack = self.half_length * y - couple.abs();
        if slack.lower() >= 0.0 {
            Tipping::Never
        } else if slack.upper() < 0.0 {
            Tipping::Always
        } else {
            Tipping::Open
        }
    }
}
