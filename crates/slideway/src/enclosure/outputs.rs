//! Bounds of what else follows from the friction forces: the couples of guided sliders, to prove whether they
//! tip, accelerations and power.

use crate::interval::Interval;
use crate::modes::{BySide, ContactState, InfluenceCoefficients, Side};

/// Bounds of what follows from the forces of a state of the mode problem.
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedOutputs {
    /// Bounds of the influence coefficients, friction coefficients, preloads and N(0). Both versions of a
    /// column have the same bounds where theory says that they are equal.
    pub influence: InfluenceCoefficients<Interval>,
    /// Bounds of the couples of guided sliders, in the order of the joints.
    pub(crate) couples: Vec<EnclosedCouple>,
    /// Bounds of the accelerations of the coordinates (m/s^2 or rad/s^2).
    pub(crate) accelerations: Vec<EnclosedOutput>,
    /// Bounds of the power of all loads and weights, and with friction, of both together (W).
    pub(crate) power: EnclosedOutput,
}

/// Bounds of what an output is made of that is affine in the friction forces and couples:
/// `C = C(0) + sum_k gamma_k F_k + sum_j gamma_j |R_j|`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EnclosedOutput {
    /// `C(0)`, its value without friction.
    pub(crate) frictionless: Interval,
    /// `gamma_k`, what a unit friction force of each contact adds, at either of its faces.
    pub(crate) influence: BySide<Vec<Interval>>,
    /// The same for the friction of the preload.
    pub(crate) influence_preload: BySide<Vec<Interval>>,
    /// What a unit normal force of each cut contact adds, with the contact: of redundant guides.
    pub(crate) self_stress: Vec<(usize, Interval)>,
    /// What the opening of each contact that may lift off adds, with the contact.
    pub(crate) openings: Vec<(usize, Interval)>,
    /// What a unit force of each hinge that turns with friction adds by its couple.
    pub(crate) hinges: Vec<Interval>,
}

/// Bounds of the couple of a guided slider.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EnclosedCouple {
    /// The slider's only contact, from 0.
    pub(crate) contact: usize,
    /// Half of the length of its pressed face (m).
    pub(crate) half_length: Interval,
    /// The couple (N m); friction at either face of a contact adds the same but for the slider's own contact.
    pub(crate) couple: EnclosedOutput,
}

impl EnclosedOutput {
    /// An output to which friction at both faces of a contact adds the same.
    pub(super) fn of_either_face(
        frictionless: Interval,
        influence: Vec<Interval>,
        hinges: Vec<Interval>,
    ) -> Self {
        let both = BySide { positive: influence.clone(), negative: influence };
        let influence_preload = both.clone();
        let (self_stress, openings) = (Vec::new(), Vec::new());
        Self { frictionless, influence_preload, influence: both, self_stress, openings, hinges }
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

impl EnclosedOutputs {
    /// Whether a guided slider tips in a state with these bounds of `y_k = |N_k|`, or of the share of a
    /// contact in its gap (theory, section 1), then of `|R_j|` of the hinges that turn with friction.
    ///
    /// # Panics
    /// If `pattern` does not have one entry for each contact, or `y` one for each contact and hinge.
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
    /// gap, then of `|R_j|`: `C(0) + sum_k gamma_k F_k + sum_j gamma_j |R_j|`, and what the normal forces of cut
    /// contacts add.
    ///
    /// # Panics
    /// As [`Self::tipping`].
    pub(crate) fn output(
        &self,
        output: &EnclosedOutput,
        pattern: &[ContactState],
        y: &[Interval],
    ) -> Interval {
        let terms = (0..pattern.len()).map(|k| self.of_friction(output, k, pattern[k], y[k]));
        let of_normal_force = |&(k, stress): &(usize, Interval)| {
            pattern[k].side().map_or(Interval::ZERO, |side| stress * y[k] * Interval::point(side.sign()))
        };
        let stresses = output.self_stress.iter().map(of_normal_force);
        let open = output.openings.iter().filter(|(k, _)| pattern[*k] == ContactState::Negative);
        let openings = open.map(|&(k, opening)| opening * y[k]);
        let hinges = output.hinges.iter().enumerate().map(|(hinge, unit)| *unit * y[pattern.len() + hinge]);
        terms.chain(stresses).chain(openings).chain(hinges).fold(output.frictionless, |sum, term| sum + term)
    }

    /// `gamma_k F_k` with `F_k = (mu_k |N_k| + F_k0) s_k`, eq. (2); in a gap `F_k0` is shared by both faces.
    fn of_friction(&self, output: &EnclosedOutput, k: usize, state: ContactState, y: Interval) -> Interval {
        let influence = &self.influence;
        let preload = |side: Side| output.influence_preload.get(side)[k] * influence.preload.get(side)[k];
        let force = if let Some(side) = state.side() {
            output.influence.get(side)[k] * influence.mu.get(side)[k] * y + preload(side)
        } else {
            let [positive, negative] = Side::BOTH.map(preload);
            negative + y * (positive - negative)
        };
        force * Interval::point(influence.velocity_signs[k])
    }
}
