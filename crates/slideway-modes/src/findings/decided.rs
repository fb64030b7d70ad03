//! Records the proven outcomes of patterns.

use crate::certificate::Decision;
use crate::findings::admitted::Admitted;
use crate::findings::candidate::{Candidate, determinant, solve_pattern};
use crate::findings::collection::{Findings, SUSPECT_CONDITION, TooManySolutions};
use crate::findings::degenerate::{Examined, examine};
use crate::interval::{Interval, Sign};
use crate::problem::ContactState;
use crate::solutions::{Certificate, ContactSet, UndecidedPattern};

/// Whether a decision settled a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Filed {
    /// Recorded as decided.
    Proven,
    /// Left unexamined, because the work was ended.
    NotProven,
}

/// The outcome, at the midpoint of the bounds, of a pattern that is undecided within them.
enum Centre {
    Solution(Candidate),
    Set(Admitted),
    Nothing,
    NotExamined,
}

impl Findings<'_> {
    /// Records a pattern according to its decision. What is not yet known is left open once `proceed` is
    /// `false`.
    pub(crate) fn file_decision(
        &mut self,
        pattern: &[ContactState],
        decision: Decision,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Filed, TooManySolutions> {
        match decision {
            Decision::NoSolution { .. } => self.count_no_solution(pattern.contains(&ContactState::Gap)),
            Decision::Solution { unknowns, determinant } => {
                let Some(candidate) = self.candidate(pattern, &unknowns, determinant, proceed) else {
                    return Ok(Filed::NotProven);
                };
                self.file_admissible(pattern, candidate, Certificate::Proven { unknowns })?;
            }
            Decision::Boundary { unknowns, zero, full_share, determinant } => {
                let Some(mut candidate) = self.candidate(pattern, &unknowns, determinant, proceed) else {
                    return Ok(Filed::NotProven);
                };
                for &contact in zero.iter().chain(&full_share) {
                    let in_gap = pattern[contact] == ContactState::Gap;
                    if in_gap { &mut candidate.at_end } else { &mut candidate.zero }.insert(contact);
                }
                let certificate = Certificate::Boundary { unknowns, zero, full_share };
                self.file_admissible(pattern, candidate, certificate)?;
            }
            Decision::Singular { set } => {
                self.examined += 1;
                let admitted = Admitted::exactly(pattern, &set, &self.problem.has_jump);
                self.file_singular(pattern, admitted, Certificate::Singular);
            }
            Decision::Undecided { unknowns, in_doubt } => {
                let centre = self.centre(pattern, proceed);
                self.file_undecided(pattern, unknowns, in_doubt, centre)?;
            }
        }
        Ok(Filed::Proven)
    }

    /// Records a pattern whose outcome differs between values within bounds: as a state if it is one at the
    /// midpoint.
    fn file_undecided(
        &mut self,
        pattern: &[ContactState],
        unknowns: Option<Vec<Interval>>,
        in_doubt: Vec<usize>,
        centre: Centre,
    ) -> Result<(), TooManySolutions> {
        match centre {
            Centre::Solution(candidate) => {
                let certificate = Certificate::OnBoundaryWithinBounds { unknowns, in_doubt };
                self.file_admissible(pattern, candidate, certificate)
            }
            Centre::Set(admitted) => {
                let certificate = Certificate::OnBoundaryWithinBounds { unknowns, in_doubt };
                self.file_singular(pattern, admitted, certificate);
                Ok(())
            }
            Centre::Nothing if self.undecided.len() >= self.limits.solutions => {
                Err(TooManySolutions { limit: self.limits.solutions })
            }
            Centre::Nothing => {
                self.counts_of(pattern).undecided += 1;
                self.undecided.push(UndecidedPattern::new(pattern, unknowns, in_doubt));
                Ok(())
            }
            Centre::NotExamined => {
                self.leave_unexamined(pattern, pattern.len());
                Ok(())
            }
        }
    }

    /// Finds the solutions that the pattern admits at the midpoint of the bounds, within tolerances.
    fn centre(&mut self, pattern: &[ContactState], proceed: &mut dyn FnMut() -> bool) -> Centre {
        let judged = |candidate: Candidate| {
            if candidate.admissible { Centre::Solution(candidate) } else { Centre::Nothing }
        };
        let candidate = solve_pattern(self.problem, pattern, proceed);
        if let Some(candidate) = candidate.as_ref().filter(|found| found.condition < SUSPECT_CONDITION) {
            return judged(candidate.clone());
        }
        if self.has_examined_enough() || !proceed() {
            return Centre::NotExamined;
        }
        self.examined += 1;
        match examine(self.problem, pattern, &mut self.bases, proceed) {
            Examined::Regular => candidate.map_or(Centre::Nothing, judged),
            Examined::Singular(admitted) if !admitted.set.has_points() => Centre::Nothing,
            Examined::Singular(admitted) => Centre::Set(admitted),
        }
    }

    /// The solution at the midpoint of its enclosure; the caller handles contacts on a boundary. The pattern
    /// is left unexamined once `proceed` is `false`.
    fn candidate(
        &mut self,
        pattern: &[ContactState],
        unknowns: &[Interval],
        sign: Sign,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Candidate> {
        let Some(determinant) = determinant(self.problem, pattern, proceed) else {
            self.leave_unexamined(pattern, pattern.len());
            return None;
        };
        let pressed = pattern.iter().zip(unknowns).filter(|(state, _)| **state != ContactState::Gap);
        let none = ContactSet::none_of(pattern.len());
        let middles = unknowns.iter().map(|value| value.nonzero_middle());
        Some(Candidate {
            unknowns: nalgebra::DVector::from_iterator(unknowns.len(), middles),
            zero: none.clone(),
            at_end: none,
            admissible: true,
            determinant: if sign == Sign::Negative { -determinant.abs() } else { determinant.abs() },
            tolerance: pressed.map(|(_, value)| value.width()).fold(0.0, f64::max),
            condition: 1.0,
        })
    }
}
