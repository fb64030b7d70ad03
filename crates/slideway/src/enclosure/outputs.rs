//! Bounds of what else follows from the friction forces: the couples of guided sliders, to prove whether they
//! tip, accelerations and power.

use crate::interval::Interval;
use crate::modes::{BlockNumbers, ContactState, InfluenceCoefficients, Side};

/// Bounds of what follows from the forces of a state of the mode problem.
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedOutputs {
    /// Bounds of the influence coefficients, friction coefficients, preloads and N(0). Both versions of a
    /// column have the same bounds where theory says that they are equal.
    pub influence: InfluenceCoefficients<Interval>,
    /// The numbers of what follows from the forces, with a row for the couple of each guided slider (N m), for the
    /// acceleration of each coordinate (m/s^2 or rad/s^2), and for the power of all loads and weights, and with friction, of
    /// both together (W).
    pub(super) numbers: BlockNumbers<Interval>,
    /// The guided sliders, in the order of the joints.
    pub(crate) couples: Vec<EnclosedCouple>,
}

/// Bounds of a guided slider.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EnclosedCouple {
    /// The slider's only contact, from 0.
    pub(crate) contact: usize,
    /// The distance of its faces (m).
    pub(super) height: Interval,
    /// Half of the length of its pressed face (m).
    pub(super) half_length: Interval,
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
        let of_couple = |(row, couple)| self.tipping_of((row, couple), pattern, y);
        self.couples.iter().enumerate().map(of_couple).max().unwrap_or(Tipping::Never)
    }

    fn tipping_of(
        &self,
        (row, couple): (usize, &EnclosedCouple),
        pattern: &[ContactState],
        y: &[Interval],
    ) -> Tipping {
        let size = self.output(row, pattern, y).abs();
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

    /// Bounds of the acceleration of a coordinate in a state, as [`Self::tipping`] has it.
    pub(crate) fn acceleration(
        &self,
        coordinate: usize,
        pattern: &[ContactState],
        y: &[Interval],
    ) -> Interval {
        self.output(self.couples.len() + coordinate, pattern, y)
    }

    /// Bounds of the power of all loads and weights, and of that which friction leaves of it in a state.
    pub(crate) fn power(&self, pattern: &[ContactState], y: &[Interval]) -> [Interval; 2] {
        let row = self.numbers.load.len() - 1;
        [self.numbers.load[row], self.output(row, pattern, y)]
    }

    /// Bounds of an output, `o + d_o^sigma + H_o^sigma w`, in a state.
    fn output(&self, row: usize, pattern: &[ContactState], y: &[Interval]) -> Interval {
        let BlockNumbers { response, jumps, load } = &self.numbers;
        let of_contact = |(k, state): (usize, &ContactState)| {
            let jump = |side: Side| jumps.get(side)[(row, k)];
            match state.side() {
                Some(side) => response.get(side)[(row, k)] * y[k] + jump(side),
                None => jump(Side::Negative) + y[k] * (jump(Side::Positive) - jump(Side::Negative)),
            }
        };
        let of_hinge = |hinge: usize| response.positive[(row, hinge)] * y[hinge];
        let terms = pattern.iter().enumerate().map(of_contact);
        terms
            .chain((pattern.len()..response.positive.ncols()).map(of_hinge))
            .fold(load[row], |sum, term| sum + term)
    }
}
