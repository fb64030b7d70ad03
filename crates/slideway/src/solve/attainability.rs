//! The attainability of the solutions of a report.

#[cfg(test)]
mod tests;

use super::answer::Answer;
use super::mode_problem::ProblemData;
use super::state::states;
use crate::attainability::{Candidate, ElasticGuides};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::modes::{ContactState, ModeProblem};
use crate::report::{Attainability, Fate, Solution, Verdict};
use nalgebra::DVector;
use std::collections::BTreeMap;

/// Of a state that is yet to be examined, or never is.
pub(super) fn not_computed(reason: &str) -> Attainability {
    Attainability::without_eigenvalues(Verdict::NotComputed, reason)
}

/// A mechanism in which the contacts that lift off are not there, with its equations and its mode problem.
pub(crate) struct Closed {
    mechanism: Mechanism,
    equations: KineticEquations,
    problem: ModeProblem,
    /// The contacts that are there.
    kept: Vec<usize>,
}

impl Closed {
    /// # Errors
    /// Drives that cannot act on what is left; numbers beyond the range of floating point.
    pub(crate) fn new(
        data: ProblemData<'_>,
        (configuration, equations): (&Configuration, &KineticEquations),
        open: &[usize],
    ) -> Result<Self, Faults> {
        let kept = (0..data.mechanism.contacts.len()).filter(|k| !open.contains(k)).collect();
        if open.is_empty() {
            let (mechanism, equations) = (data.mechanism.clone(), equations.clone());
            return Ok(Self { mechanism, equations, problem: data.problem()?, kept });
        }
        let mechanism = data.mechanism.without_contacts(open);
        let equations = KineticEquations::new(&mechanism, configuration)?;
        let influence = Influence::new(&equations);
        let velocity_signs = &data.velocity_signs.select_rows(&kept);
        let problem =
            ProblemData { mechanism: &mechanism, influence: &influence, velocity_signs }.problem()?;
        Ok(Self { mechanism, equations, problem, kept })
    }

    /// The verdict on the mode with these states of all contacts. What no contact holds follows its loads.
    pub(crate) fn verdict_on(&self, states: &[ContactState]) -> Verdict {
        if self.kept.is_empty() {
            Verdict::Attainable
        } else {
            self.guides().verdict_on(&self.states(states))
        }
    }

    /// Its guides, slightly elastic.
    fn guides(&self) -> ElasticGuides<'_> {
        ElasticGuides::new(&self.mechanism, &self.equations, &self.problem)
    }

    /// The states of the contacts that are there, from those of all.
    fn states(&self, states: &[ContactState]) -> Vec<ContactState> {
        self.kept.iter().map(|&k| states[k]).collect()
    }

    fn candidate(&self, solution: &Solution) -> Candidate {
        let contact = |&k: &usize| &solution.contacts[k];
        let forces = self.kept.iter().map(|k| contact(k).normal_force);
        Candidate {
            states: self.states(&states(&solution.pattern)),
            normal_force: DVector::from_iterator(self.kept.len(), forces),
            deflections: self.kept.iter().map(|k| contact(k).deflection).collect(),
        }
    }
}

impl Answer<'_> {
    /// Examines all solutions that lie within a mode.
    pub(super) fn examine(&self, solutions: &mut [Solution]) -> Result<(), Faults> {
        for solution in solutions.iter_mut() {
            solution.attainability = not_computed(if solution.floating.is_empty() {
                "a contact is about to change side"
            } else {
                "the block floats within its play"
            });
        }
        let may_open = self.mechanism.has_one_sided();
        if solutions.iter().all(is_on_boundary) && self.shared.is_none() && !may_open {
            return Ok(());
        }
        let mut groups: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for (index, solution) in solutions.iter().enumerate() {
            groups
                .entry(self.mechanism.opening(&states(&solution.pattern)).collect())
                .or_default()
                .push(index);
        }
        for (open, members) in groups {
            self.examine_closed(solutions, &open, &members)?;
        }
        Ok(())
    }

    /// Examines solutions in which these contacts lift off.
    fn examine_closed(
        &self,
        solutions: &mut [Solution],
        open: &[usize],
        members: &[usize],
    ) -> Result<(), Faults> {
        let closed = Closed::new(self.data(), (self.configuration, self.equations), open)?;
        if closed.kept.is_empty() && !open.is_empty() {
            for &index in members {
                solutions[index].oriented_determinant = 1.0;
                solutions[index].attainability = Attainability {
                    reason: None,
                    ..Attainability::without_eigenvalues(Verdict::Attainable, "")
                };
            }
            return Ok(());
        }
        let guides = closed.guides();
        for &index in members {
            let states = closed.states(&states(&solutions[index].pattern));
            if !open.is_empty() {
                solutions[index].oriented_determinant = guides.oriented_determinant(&states);
            } else if let Some(mean) = guides.oriented_mean(&states) {
                solutions[index].oriented_determinant = mean;
            }
        }
        let inside: Vec<usize> =
            members.iter().copied().filter(|&index| !is_on_boundary(&solutions[index])).collect();
        let candidates: Vec<Candidate> =
            inside.iter().map(|&index| closed.candidate(&solutions[index])).collect();
        // What lies beside a solution is followed between faces that press on both sides only.
        let all = if self.mechanism.has_one_sided() {
            candidates.iter().map(|candidate| guides.of(&candidate.states)).collect()
        } else {
            guides.attainability(&candidates)
        };
        for (&index, mut attainability) in inside.iter().zip(all) {
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
        solution.signs.iter().zip(states(&solution.pattern)).filter(|(_, state)| *state != ContactState::Gap);
    solution.on_boundary || solution.determinant == 0.0 || pressed.into_iter().any(|(sign, _)| *sign == 0)
}
