//! The attainability of the solutions of a report.

#[cfg(test)]
mod tests;

use super::answer::Answer;
use super::mode_problem::ProblemData;
use super::state::states;
use crate::attainability::{Candidate, ElasticGuides, ElasticJoints};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::influence::Influence;
use crate::kinetics::{KineticEquations, Reaction};
use crate::mechanism::Mechanism;
use crate::modes::{ContactState, ModeProblem};
use crate::problem::TurningHinge;
use crate::report::{Attainability, Fate, Solution, Verdict};
use nalgebra::{DMatrix, DVector};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::AddAssign;

/// Of a state that is yet to be examined, or never is.
pub(super) fn not_computed(reason: &str) -> Attainability {
    Attainability::without_eigenvalues(Verdict::NotComputed, reason)
}

/// A mechanism in which the contacts that lift off are not there, with its equations.
pub(super) struct Left<'a> {
    pub(super) mechanism: Cow<'a, Mechanism>,
    pub(super) equations: Cow<'a, KineticEquations>,
    pub(super) influence: Cow<'a, Influence>,
    pub(super) velocity_signs: Cow<'a, DVector<f64>>,
    /// The contacts that are there.
    pub(super) kept: Vec<usize>,
}

impl<'a> Left<'a> {
    /// # Errors
    /// Drives that cannot act on what is left.
    pub(super) fn new(
        ProblemData { mechanism, influence, velocity_signs }: ProblemData<'a>,
        (configuration, equations): (&Configuration, &'a KineticEquations),
        open: &[usize],
    ) -> Result<Self, Faults> {
        let kept: Vec<usize> = (0..mechanism.contacts.len()).filter(|k| !open.contains(k)).collect();
        if open.is_empty() {
            return Ok(Self {
                mechanism: Cow::Borrowed(mechanism),
                equations: Cow::Borrowed(equations),
                influence: Cow::Borrowed(influence),
                velocity_signs: Cow::Borrowed(velocity_signs),
                kept,
            });
        }
        let mechanism = mechanism.without_contacts(open);
        let equations = KineticEquations::new(&mechanism, configuration)?;
        Ok(Self {
            influence: Cow::Owned(Influence::new(&equations)),
            velocity_signs: Cow::Owned(velocity_signs.select_rows(&kept)),
            mechanism: Cow::Owned(mechanism),
            equations: Cow::Owned(equations),
            kept,
        })
    }

    fn data(&self) -> ProblemData<'_> {
        let Self { mechanism, influence, velocity_signs, .. } = self;
        ProblemData { mechanism, influence, velocity_signs }
    }

    /// The states of the contacts that are there, from those of all.
    pub(super) fn states(&self, states: &[ContactState]) -> Vec<ContactState> {
        self.kept.iter().map(|&k| states[k]).collect()
    }
}

/// The attainability of a solution with friction in these hinges, which carry these forces: among the contacts that do not
/// lift off.
pub(crate) fn attainability_with_hinges(
    data: ProblemData<'_>,
    state: (&Configuration, &KineticEquations),
    hinges: &[TurningHinge],
    (states, reactions): (&[ContactState], &[[f64; 2]]),
) -> Attainability {
    let open: Vec<usize> = data.mechanism.opening(states).collect();
    let of_left = |left: Left<'_>| {
        let states = left.states(states);
        let slopes = left.data().block_problem(hinges)?.slopes(&states, reactions);
        let (slopes, forces) = with_ends_once(&left.mechanism, slopes, hinges);
        Ok::<_, Faults>(ElasticJoints::new(&left.mechanism, &left.equations, &forces).of(slopes, &states))
    };
    Left::new(data, state, &open).and_then(of_left).unwrap_or_else(|_| not_computed(NOT_DRIVEN))
}

/// The slopes in which the components of round ends, which are contacts, too, stand once, as those, and the force of a collar once;
/// and the forces of hinges.
fn with_ends_once(
    mechanism: &Mechanism,
    mut slopes: DMatrix<f64>,
    hinges: &[TurningHinge],
) -> (DMatrix<f64>, Vec<Reaction>) {
    let contacts = mechanism.contacts.len();
    let mut kept: Vec<usize> = (0..contacts).collect();
    let mut forces = Vec::new();
    for (index, hinge) in hinges.iter().enumerate() {
        let own = [0, 1].map(|component| contacts + 2 * index + component);
        let circle = &mechanism.friction_circles[hinge.circle];
        let mut add = |from: usize, to: usize| {
            let more = slopes.column(from).into_owned();
            slopes.column_mut(to).add_assign(&more);
        };
        if let Some(end) = circle.end {
            end.into_iter().zip(own).for_each(|(contact, column)| add(column, contact.index()));
        } else if circle.is_collar() {
            add(own[1], own[0]);
            kept.push(own[0]);
            forces.push(circle.reactions()[0]);
        } else {
            kept.extend(own);
            forces.extend(circle.reactions());
        }
    }
    (slopes.select_rows(&kept).select_columns(&kept), forces)
}

/// Why nothing is said of what is left when contacts have lifted off.
pub(super) const NOT_DRIVEN: &str = "drives cannot act on what is left";

/// A mechanism in which the contacts that lift off are not there, with its equations and its mode problem.
pub(crate) struct Closed<'a> {
    left: Left<'a>,
    problem: ModeProblem,
}

impl<'a> Closed<'a> {
    /// # Errors
    /// Drives that cannot act on what is left; numbers beyond the range of floating point.
    pub(crate) fn new(
        data: ProblemData<'a>,
        state: (&Configuration, &'a KineticEquations),
        open: &[usize],
    ) -> Result<Self, Faults> {
        let left = Left::new(data, state, open)?;
        let problem = left.data().problem()?;
        Ok(Self { left, problem })
    }

    /// The verdict on the mode with these states of all contacts. What no contact holds follows its loads.
    pub(crate) fn verdict_on(&self, states: &[ContactState]) -> Verdict {
        if self.left.kept.is_empty() {
            Verdict::Attainable
        } else {
            self.guides().verdict_on(&self.left.states(states))
        }
    }

    /// Its guides, slightly elastic.
    fn guides(&self) -> ElasticGuides<'_> {
        ElasticGuides::new(&self.left.mechanism, &self.left.equations, &self.problem)
    }

    fn candidate(&self, solution: &Solution) -> Candidate {
        let contact = |&k: &usize| &solution.contacts[k];
        let kept = &self.left.kept;
        let forces = kept.iter().map(|k| contact(k).normal_force);
        Candidate {
            states: self.left.states(&states(&solution.pattern)),
            normal_force: DVector::from_iterator(kept.len(), forces),
            deflections: kept.iter().map(|k| contact(k).deflection).collect(),
        }
    }
}

impl Answer<'_> {
    /// Examines all solutions that lie within a mode.
    pub(super) fn examine(&self, solutions: &mut [Solution]) -> Result<(), Faults> {
        for solution in solutions.iter_mut() {
            solution.attainability = if solution.floating.is_empty() {
                not_computed(&unloaded_in_words(self.mechanism, solution))
            } else {
                not_computed("the block floats within its play")
            };
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
        if closed.left.kept.is_empty() && !open.is_empty() {
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
            let states = closed.left.states(&states(&solutions[index].pattern));
            if !open.is_empty() {
                solutions[index].oriented_determinant = guides.oriented_determinant(&states);
            } else if let Some(mean) = guides.oriented_mean(&states) {
                solutions[index].oriented_determinant = mean;
            }
        }
        let is_inside = |index: &usize| !is_on_boundary(self.mechanism, &solutions[*index]);
        let inside: Vec<usize> = members.iter().copied().filter(is_inside).collect();
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
        for &index in members.iter().filter(|index| !inside.contains(index)) {
            let solution = &solutions[index];
            let Some(unpressed) = self.unpressed(solution, &closed.left.kept) else { continue };
            let states = closed.left.states(&states(&solution.pattern));
            if let Some(attainability) = guides.of_unpressed(&states, &unpressed) {
                solutions[index].attainability = attainability;
            }
        }
        Ok(())
    }

    /// The contacts among these that nothing presses, where these alone are why a solution belongs to several modes: both sides of
    /// each are the same state.
    fn unpressed(&self, solution: &Solution, kept: &[usize]) -> Option<Vec<usize>> {
        let is_plain =
            |k: usize| !self.mechanism.contacts[k].opens && !self.mechanism.excess.shares(ContactId(k));
        let contacts: Vec<usize> = unloaded(solution).collect();
        let are_all = solution.floating.is_empty() && solution.determinant != 0.0 && !contacts.is_empty();
        if !are_all || !contacts.iter().all(|&k| is_plain(k)) {
            return None;
        }
        contacts.into_iter().map(|k| kept.iter().position(|&other| other == k)).collect()
    }
}

/// The contacts between faces that nothing presses.
fn unloaded(solution: &Solution) -> impl Iterator<Item = usize> + '_ {
    let sides = solution.signs.iter().zip(states(&solution.pattern)).enumerate();
    sides.filter(|(_, (sign, state))| **sign == 0 && *state != ContactState::Gap).map(|(k, _)| k)
}

/// Whether a solution belongs to several modes, or to a singular one. Without friction both sides of a contact are one.
fn is_on_boundary(mechanism: &Mechanism, solution: &Solution) -> bool {
    let mut contacts = unloaded(solution).peekable();
    let hides_side = solution.on_boundary && contacts.peek().is_none();
    hides_side || solution.determinant == 0.0 || contacts.any(|k| mechanism.contacts[k].mu != [0.0; 2])
}

/// "nothing presses rail.f, rail.r"
fn unloaded_in_words(mechanism: &Mechanism, solution: &Solution) -> String {
    let rough = unloaded(solution).filter(|&k| mechanism.contacts[k].mu != [0.0; 2]);
    let names: Vec<&str> = rough.map(|k| &*mechanism.contacts[k].name).collect();
    let what = if names.is_empty() { "a contact".to_owned() } else { names.join(", ") };
    format!("nothing presses {what}")
}
