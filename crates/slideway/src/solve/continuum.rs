//! The part of a continuum of solutions in which no guided slider tips.

use super::answer::Answer;
use super::state::{State, signs};
use crate::kinetics::Reaction;
use crate::mechanism::COUPLE_TOLERANCE;
use crate::modes::{SingularMode, SolutionSet};
use nalgebra::DVector;

/// A part of a continuum that is shorter than this multiple of it is a point within the tolerance.
const POINT: f64 = 1e-6;

impl Answer<'_> {
    /// A singular mode with its continuum cut to where |C| <= |N| L / 2 holds for every guided slider.
    ///
    /// In one mode the sign of N is fixed and everything is affine, so that both bounds on C cut a segment or
    /// ray at one point each. Continua of more dimensions are left as they are; see [`Self::tipping_in`].
    pub(super) fn without_tipping(&self, mode: &SingularMode) -> SingularMode {
        let (from, step, end) = match &mode.set {
            SolutionSet::Segment { from, to } => (from, to - from, 1.0),
            SolutionSet::Ray { from, direction } => {
                (from, direction * from.amax().max(direction.amax()), f64::INFINITY)
            }
            _ => return mode.clone(),
        };
        let (first, last) = self.slack_interval(mode, from, &step, end);
        if (first, last) == (0.0, end) {
            return mode.clone();
        }
        let at = |t: f64| from + &step * t;
        let set = if first > last {
            SolutionSet::Empty
        } else if last - first <= POINT {
            SolutionSet::Point(at(first))
        } else if last.is_infinite() {
            SolutionSet::Ray { from: at(first), direction: &step / step.amax() }
        } else {
            SolutionSet::Segment { from: at(first), to: at(last) }
        };
        let mut clipped = mode.clone();
        clipped.set = set;
        clipped.contains.clear();
        clipped
    }

    /// The values of t from 0 to `end` for which no couple at `from + t step` exceeds its limit; empty if the
    /// first is greater than the last.
    fn slack_interval(
        &self,
        mode: &SingularMode,
        from: &DVector<f64>,
        step: &DVector<f64>,
        end: f64,
    ) -> (f64, f64) {
        let (slack, next) = (self.slack(mode, from), self.slack(mode, &(from + step)));
        let scale = slack.iter().chain(&next).map(|slack| slack.abs()).fold(0.0, f64::max);
        let (mut first, mut last) = (0.0_f64, end);
        for (at_start, at_next) in slack.iter().zip(&next) {
            let (value, slope) = (at_start + COUPLE_TOLERANCE * scale, at_next - at_start);
            if slope.abs() <= COUPLE_TOLERANCE * scale {
                if value < 0.0 {
                    return (1.0, 0.0);
                }
            } else if slope > 0.0 {
                first = first.max(-value / slope);
            } else {
                last = last.min(-value / slope);
            }
        }
        (first, last)
    }

    /// What is left of the couple of each guided slider in both directions, |N| L / 2 - C and |N| L / 2 + C.
    fn slack(&self, mode: &SingularMode, normal_force: &DVector<f64>) -> Vec<f64> {
        let state = vertex(mode, normal_force);
        let unknowns = self.influence.unknowns(&self.friction(&state), normal_force);
        let both = |(joint, slider): (_, &crate::mechanism::Slider)| {
            let contact = slider.contacts[0].index();
            let limit = state.pattern[contact].sign() * normal_force[contact] * slider.length / 2.0;
            let index = self.influence.layout().reaction(Reaction::Couple(joint));
            let couple = index.map_or(0.0, |index| unknowns[index]);
            [limit - couple, limit + couple]
        };
        self.guided_sliders().flat_map(both).collect()
    }

    /// The guided sliders that would tip at some vertex of a continuum of more dimensions than one.
    pub(super) fn tipping_in(&self, mode: &SingularMode) -> Vec<String> {
        if !matches!(mode.set, SolutionSet::Polytope { .. }) {
            return Vec::new();
        }
        let rejected = mode.set.vertices().into_iter().filter_map(|point| self.tipping_at(mode, point));
        let mut names: Vec<String> = rejected.map(|rejection| rejection.joint).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// The guided slider that would tip at a point of a continuum.
    pub(super) fn tipping_at(
        &self,
        mode: &SingularMode,
        normal_force: &DVector<f64>,
    ) -> Option<crate::report::Rejection> {
        let state = vertex(mode, normal_force);
        let unknowns = self.influence.unknowns(&self.friction(&state), normal_force);
        self.tipping(&state, &unknowns)
    }
}

/// A point of a continuum as a state.
fn vertex<'s>(mode: &'s SingularMode, normal_force: &'s DVector<f64>) -> State<'s> {
    State {
        pattern: &mode.pattern,
        patterns: Vec::new(),
        normal_force,
        shares: vec![None; mode.pattern.len()],
        signs: signs(&mode.pattern),
        on_boundary: false,
        determinant: 0.0,
        certificate: &mode.certificate,
        hinges: &[],
    }
}
