//! A solution or gap state while results are being collected.

use nalgebra::DVector;

use crate::findings::candidate::Candidate;
use crate::problem::{ContactState, Side};
use crate::solutions::{Certificate, GapShare, GapState, ModeSolution, ModeState, Support, UndecidedPattern};

/// A solution or gap state with the patterns that give it.
#[derive(Clone)]
pub(crate) struct Found {
    pub(crate) candidate: Candidate,
    pub(crate) normal_force: DVector<f64>,
    pub(crate) patterns: Vec<Vec<ContactState>>,
    pub(crate) pattern_count: u64,
    pub(crate) certificate: Certificate,
}

impl Found {
    /// From the candidate of a pattern.
    pub(crate) fn new(pattern: &[ContactState], candidate: Candidate, certificate: Certificate) -> Self {
        let signed = pattern.iter().zip(&candidate.unknowns).map(|(state, value)| state.sign() * value);
        let normal_force = DVector::from_iterator(pattern.len(), signed);
        Self { candidate, normal_force, patterns: vec![pattern.to_vec()], pattern_count: 1, certificate }
    }

    pub(crate) fn pattern(&self) -> &[ContactState] {
        &self.patterns[0]
    }

    pub(crate) fn has_gap(&self) -> bool {
        self.pattern().contains(&ContactState::Gap)
    }

    /// The number of contacts in their gaps.
    pub(crate) fn gaps(&self) -> usize {
        gaps_in(self.pattern())
    }

    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        let tolerance = self.candidate.tolerance + other.candidate.tolerance;
        (&self.normal_force - &other.normal_force).amax() <= tolerance
    }

    pub(crate) fn absorb(&mut self, other: Self, listed: usize) {
        self.pattern_count += other.pattern_count;
        let room = listed.saturating_sub(self.patterns.len());
        self.patterns.extend(other.patterns.into_iter().take(room));
        self.certificate.absorb(other.certificate);
        for contact in other.candidate.zero.iter() {
            self.candidate.zero.insert(contact);
            self.candidate.unknowns[contact] = 0.0;
            self.normal_force[contact] = 0.0;
        }
    }

    /// Whether the pattern of another finding is this one with some gaps closed, at the face where this
    /// state's shares end.
    pub(crate) fn closes_to(&self, other: &Self, has_jump: &[bool]) -> bool {
        let states = self.pattern().iter().zip(other.pattern()).enumerate();
        let mut closed = 0;
        for (contact, (&state, &face)) in states.filter(|(contact, _)| has_jump[*contact]) {
            if state == face {
                continue;
            }
            let end = if self.candidate.unknowns[contact] == 1.0 {
                ContactState::Positive
            } else {
                ContactState::Negative
            };
            let at_end = self.candidate.at_end.contains(contact);
            if !at_end || face != end {
                return false;
            }
            closed += 1;
        }
        closed > 0
    }

    fn signs(&self) -> Vec<i8> {
        let sign = |(contact, state): (usize, &ContactState)| match state {
            _ if self.candidate.zero.contains(contact) => 0,
            ContactState::Positive => 1,
            ContactState::Negative => -1,
            ContactState::Gap => 0,
        };
        self.pattern().iter().enumerate().map(sign).collect()
    }

    pub(crate) fn support(&self, has_jump: &[bool]) -> Support {
        let Candidate { unknowns, zero, at_end, .. } = &self.candidate;
        Support::of_point(self.pattern(), unknowns, [zero, at_end], has_jump)
    }

    pub(crate) fn into_mode_solution(self, has_jump: &[bool]) -> ModeSolution {
        self.into_state(has_jump, sides)
    }

    pub(crate) fn into_gap_state(self, has_jump: &[bool]) -> GapState {
        self.into_state(has_jump, <[ContactState]>::to_vec)
    }

    fn into_state<S>(self, has_jump: &[bool], states: fn(&[ContactState]) -> Vec<S>) -> ModeState<S> {
        let in_gap = self.pattern().iter().enumerate().filter(|(_, state)| **state == ContactState::Gap);
        let share = |(contact, _)| GapShare { contact, lambda: self.candidate.unknowns[contact] };
        ModeState {
            pattern: states(self.pattern()),
            shares: in_gap.map(share).collect(),
            signs: self.signs(),
            y: self.normal_force.abs(),
            determinant: self.candidate.determinant,
            on_boundary: self.candidate.zero.iter().collect(),
            patterns: self.patterns.iter().map(|pattern| states(pattern)).collect(),
            pattern_count: self.pattern_count,
            tolerance: self.candidate.tolerance,
            maximal: true,
            support: self.support(has_jump),
            certificate: self.certificate,
            normal_force: self.normal_force,
        }
    }

    /// A state that may be separate for some values within bounds, although it coincides with another one at
    /// their midpoint.
    pub(crate) fn into_undecided(self) -> Option<UndecidedPattern> {
        let Certificate::OnBoundaryWithinBounds { unknowns, in_doubt } = self.certificate else {
            return None;
        };
        let pattern = self.patterns.first()?.clone();
        Some(UndecidedPattern { pattern, patterns: self.patterns, unknowns, in_doubt })
    }
}

/// The sides of a pattern without gaps.
pub(crate) fn sides(pattern: &[ContactState]) -> Vec<Side> {
    pattern.iter().filter_map(|state| state.side()).collect()
}

impl Certificate {
    /// Adds what is known about another pattern with the same solution.
    fn absorb(&mut self, other: Self) {
        let (
            Self::OnBoundaryWithinBounds { unknowns: Some(unknowns), in_doubt },
            Self::OnBoundaryWithinBounds { unknowns: Some(others), in_doubt: more },
        ) = (&mut *self, other)
        else {
            return;
        };
        for (interval, other) in unknowns.iter_mut().zip(others) {
            *interval = interval.hull(other);
        }
        in_doubt.extend(more);
        in_doubt.sort_unstable();
        in_doubt.dedup();
    }
}

/// The number of contacts in their gaps.
pub(super) fn gaps_in(pattern: &[ContactState]) -> usize {
    pattern.iter().filter(|state| **state == ContactState::Gap).count()
}
