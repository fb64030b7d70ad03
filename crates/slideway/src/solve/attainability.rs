//! The attainability of the solutions of a report.

#[cfg(test)]
mod tests;

use super::answer::Answer;
use crate::attainability::{Candidate, ElasticGuides};
use crate::fault::Faults;
use crate::modes::ContactState;
use crate::report::{Attainability, Fate, Solution, Verdict};
use nalgebra::DVector;

/// Of a state that is yet to be examined, or never is.
pub(super) fn not_computed(reason: &str) -> Attainability {
    Attainability::without_eigenvalues(Verdict::NotComputed, reason)
}

impl Answer<'_> {
    /// Examines all solutions that lie within a mode.
    pub(super) fn examine(&self, solutions: &mut [Solution]) -> Result<(), Faults> {
        let inside: Vec<usize> =
            (0..solutions.len()).filter(|&index| !is_on_boundary(&solutions[index])).collect();
        for solution in solutions.iter_mut() {
            solution.attainability = not_computed(if solution.floating.is_empty() {
                "a contact is about to change side"
            } else {
                "the block floats within its play"
            });
        }
        if inside.is_empty() && self.shared.is_none() {
            return Ok(());
        }
        let problem = self.data().problem()?;
        let guides = ElasticGuides::new(self.mechanism, self.equations, &problem);
        for solution in solutions.iter_mut() {
            if let Some(mean) = guides.oriented_mean(&states(solution)) {
                solution.oriented_determinant = mean;
            }
        }
        let candidates: Vec<Candidate> = inside.iter().map(|&index| candidate(&solutions[index])).collect();
        for (&index, mut attainability) in inside.iter().zip(guides.attainability(&candidates)) {
            attainability.separates = attainability.separates.map(|fates| {
                fates.map(|fate| match fate {
                    Fate::Solution(number) => Fate::Solution(inside[number - 1] + 1),
                    other => other,
                })
            });
            solutions[index].attainability = attainability;
        }
        Ok(())
    }
}

/// Whether a solution belongs to several modes, or to a singular one.
fn is_on_boundary(solution: &Solution) -> bool {
    let pressed =
        solution.signs.iter().zip(states(solution)).filter(|(_, state)| *state != ContactState::Gap);
    solution.on_boundary || solution.determinant == 0.0 || pressed.into_iter().any(|(sign, _)| *sign == 0)
}

fn states(solution: &Solution) -> Vec<ContactState> {
    let state = |state: char| match state {
        '+' => ContactState::Positive,
        '-' => ContactState::Negative,
        _ => ContactState::Gap,
    };
    solution.pattern.chars().map(state).collect()
}

fn candidate(solution: &Solution) -> Candidate {
    Candidate {
        states: states(solution),
        normal_force: DVector::from_iterator(
            solution.contacts.len(),
            solution.contacts.iter().map(|contact| contact.normal_force),
        ),
        deflections: solution.contacts.iter().map(|contact| contact.deflection).collect(),
    }
}
