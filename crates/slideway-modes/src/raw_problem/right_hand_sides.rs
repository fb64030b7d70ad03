//! Whether a raw problem has exactly one solution for every right-hand side.

use serde::Serialize;

use super::{RawKind, RawProblem, block_answer};
use crate::problem::{ModeProblemError, Side};
use crate::progress::Callback;
use crate::uniqueness::{Unfinished, Uniqueness, UniquenessLimits, uniqueness_with};

/// Exact determinants are computed only for up to this many unknowns: one with 60 takes a fifth of a second.
const EXACT_UNKNOWNS: usize = 60;

/// Whether there is exactly one solution for every right-hand side (`q`, `b`, `right_hand_side`), with the
/// matrices as given: theory, section 5.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct EveryRightHandSide {
    /// The answer.
    pub answer: EveryAnswer,
    /// Sign patterns that show it: for `not_one`, two whose oriented determinants have opposite signs; for
    /// `singular`, one whose determinant is zero; for `in_doubt`, one whose sign was not decided; otherwise
    /// none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub patterns: Vec<String>,
    /// Why it was not decided, in words; empty if it was.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub reason: String,
}

/// See [`EveryRightHandSide`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EveryAnswer {
    /// Exactly one solution for every right-hand side: proven.
    One,
    /// Several solutions or none for some right-hand sides: proven.
    NotOne,
    /// No solution or infinitely many for some right-hand sides: proven.
    Singular,
    /// Undecided because determinants are too close to zero.
    InDoubt,
    /// Not decided within the limits.
    NotComputed,
    /// Not decided: preloads jump with the sign.
    Jumps,
}

impl EveryAnswer {
    /// The word for it in JSON and archives.
    pub fn word(self) -> &'static str {
        match self {
            Self::One => "one",
            Self::NotOne => "not_one",
            Self::Singular => "singular",
            Self::InDoubt => "in_doubt",
            Self::NotComputed => "not_computed",
            Self::Jumps => "jumps",
        }
    }
}

impl RawProblem {
    /// Decides whether the problem has exactly one solution for every right-hand side. For a linear
    /// complementarity problem, this is whether `M` is a P-matrix; for an absolute value equation, whether
    /// `A + B diag(d)` is regular for all `d` between -1 and 1.
    ///
    /// `progress` is called at every node, and ends the work by breaking.
    ///
    /// # Errors
    /// If shapes do not match, an entry is not finite, or `A + B` overflows.
    ///
    /// ```
    /// use slideway_modes::raw_problem::{EveryAnswer, RawProblem};
    /// use std::ops::ControlFlow;
    ///
    /// let m = nalgebra::dmatrix![1.0, 2.0; 2.0, 1.0];
    /// let problem = RawProblem::LinearComplementarity { m, q: nalgebra::dvector![1.0, 1.0] };
    /// let every = problem.every_right_hand_side(&mut |_| ControlFlow::Continue(()))?;
    /// // The minor of both is 1 - 4.
    /// assert_eq!(every.answer, EveryAnswer::NotOne);
    /// # Ok::<(), slideway_modes::ModeProblemError>(())
    /// ```
    pub fn every_right_hand_side(
        &self,
        progress: &mut Callback<'_>,
    ) -> Result<EveryRightHandSide, ModeProblemError> {
        if let Self::BlockAbsoluteValue(equation) = self {
            return Ok(block_answer::every_right_hand_side(equation));
        }
        let Some(problem) = self.problem_of_every_right_hand_side() else {
            let reason = "a game has no right-hand side".to_owned();
            return Ok(EveryRightHandSide { answer: EveryAnswer::NotComputed, patterns: Vec::new(), reason });
        };
        let problem = problem?;
        let mut limits = UniquenessLimits::default();
        if problem.contacts() > EXACT_UNKNOWNS {
            limits.exact = 0;
        }
        Ok(told(self.kind(), uniqueness_with(&problem, &limits, progress)))
    }
}

fn told(kind: RawKind, answer: Uniqueness) -> EveryRightHandSide {
    let (answer, patterns, reason) = match answer {
        Uniqueness::Unique { .. } => (EveryAnswer::One, Vec::new(), String::new()),
        Uniqueness::NotUnique { positive, negative } => {
            (EveryAnswer::NotOne, vec![signs(&positive), signs(&negative)], String::new())
        }
        Uniqueness::Singular { pattern } => (EveryAnswer::Singular, vec![signs(&pattern)], String::new()),
        Uniqueness::InDoubt { pattern } => {
            let reason = "a determinant is too close to zero".to_owned();
            (EveryAnswer::InDoubt, vec![signs(&pattern)], reason)
        }
        Uniqueness::NotComputed(why) => (EveryAnswer::NotComputed, Vec::new(), unfinished(why)),
        Uniqueness::JumpsPresent { contact } => {
            let name = kind.optional().first().unwrap_or(&"jumps");
            let reason = format!("column {} of `{name}` jumps with the sign", contact + 1);
            (EveryAnswer::Jumps, Vec::new(), reason)
        }
    };
    EveryRightHandSide { answer, patterns, reason }
}

fn unfinished(why: Unfinished) -> String {
    match why {
        Unfinished::Nodes(limit) => format!("it takes more than {limit} nodes"),
        Unfinished::Contacts(limit) => format!("there are more than {limit} unknowns"),
        Unfinished::Cancelled => "ended by a time limit or on request".to_owned(),
    }
}

/// "+-+"
fn signs(pattern: &[Side]) -> String {
    pattern.iter().map(|side| if *side == Side::Positive { '+' } else { '-' }).collect()
}
