//! The residual of a solution in the equations as given.

use std::borrow::Cow;

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};

use super::RawProblem;
use super::range::nearest;
use crate::problem::{ModeProblem, Side};

/// The factor of a matrix in the equations, for an unknown `N` with share `lambda` of the positive jump.
#[derive(Clone, Copy)]
enum Multiplier {
    Signed,
    Size,
    /// `max(N, 0)`.
    Positive,
    /// `max(-N, 0)`.
    Negative,
    Share,
    /// `1 - lambda`.
    OtherShare,
}

/// `sum of matrices times factors = load`, without using the mode problem for types whose unknowns have the same
/// matrices.
pub(super) struct Equations<'a> {
    terms: Vec<(Cow<'a, DMatrix<f64>>, Multiplier)>,
    load: &'a DVector<f64>,
}

impl<'a> Equations<'a> {
    pub(super) fn of(raw: &'a RawProblem, problem: &'a ModeProblem) -> Self {
        let given = |matrix: &'a DMatrix<f64>, factor| (Cow::Borrowed(matrix), factor);
        let negated = |matrix: &DMatrix<f64>, factor| (Cow::Owned(-matrix), factor);
        match raw {
            // w - M z = q
            RawProblem::LinearComplementarity { m, q } => {
                let identity = DMatrix::identity(q.len(), q.len());
                let terms =
                    vec![(Cow::Owned(identity), Multiplier::Negative), negated(m, Multiplier::Positive)];
                Self { terms, load: q }
            }
            // A x + B |x| = b
            RawProblem::AbsoluteValue { a, b, right_hand_side } => Self {
                terms: vec![given(a, Multiplier::Signed), given(b, Multiplier::Size)],
                load: right_hand_side,
            },
            // A w - B z = q
            RawProblem::HorizontalComplementarity { a, b, q } => Self {
                terms: vec![given(a, Multiplier::Negative), negated(b, Multiplier::Positive)],
                load: q,
            },
            // sum c_k y_k - sum d_k = N(0)
            RawProblem::MixedLinearComplementarity { .. }
            | RawProblem::MixedComplementarity { .. }
            | RawProblem::Game { .. }
            | RawProblem::BlockAbsoluteValue(_)
            | RawProblem::Modes(_) => Self {
                terms: vec![
                    given(problem.columns(Side::Positive), Multiplier::Positive),
                    given(problem.columns(Side::Negative), Multiplier::Negative),
                    negated(problem.jumps(Side::Positive), Multiplier::Share),
                    negated(problem.jumps(Side::Negative), Multiplier::OtherShare),
                ],
                load: problem.right_hand_side(),
            },
        }
    }

    /// The residual for these `N` and shares, relative to the largest sum of sizes of terms in an equation;
    /// `None` if numbers overflow or underflow.
    pub(super) fn residual(&self, signed: &[f64], shares: &[f64]) -> Option<f64> {
        let factor = |factor, at: usize| match factor {
            Multiplier::Signed => signed[at],
            Multiplier::Size => signed[at].abs(),
            Multiplier::Positive => signed[at].max(0.0),
            Multiplier::Negative => (-signed[at]).max(0.0),
            Multiplier::Share => shares[at],
            Multiplier::OtherShare => 1.0 - shares[at],
        };
        let mut sum = -self.load;
        let mut size = self.load.abs();
        for (matrix, kind) in &self.terms {
            let factors = DVector::from_fn(self.load.len(), |at, _| factor(*kind, at));
            sum += &**matrix * &factors;
            size += matrix.abs() * factors.abs();
        }
        let (sum, size) = (sum.amax(), size.amax());
        (sum.is_finite() && size.is_normal() && size < f64::MAX).then(|| sum / size)
    }

    /// Returns the residual for these `N` and shares, relative to the largest sum of sizes of terms in an
    /// equation, computed in exact arithmetic; `None` if a number of the equations is not finite.
    pub(super) fn exact_residual(&self, signed: &[RBig], shares: &[RBig]) -> Option<f64> {
        let size = |value: &RBig| if *value < RBig::ZERO { -value } else { value.clone() };
        let above_zero = |value: RBig| if value < RBig::ZERO { RBig::ZERO } else { value };
        let factor = |factor, at: usize| match factor {
            Multiplier::Signed => signed[at].clone(),
            Multiplier::Size => size(&signed[at]),
            Multiplier::Positive => above_zero(signed[at].clone()),
            Multiplier::Negative => above_zero(-&signed[at]),
            Multiplier::Share => shares[at].clone(),
            Multiplier::OtherShare => RBig::ONE - &shares[at],
        };
        let factors: Vec<Vec<RBig>> = self
            .terms
            .iter()
            .map(|(_, kind)| (0..signed.len()).map(|at| factor(*kind, at)).collect())
            .collect();
        let (mut most_left, mut most) = (RBig::ZERO, RBig::ZERO);
        for row in 0..signed.len() {
            let mut left = -exact(self.load[row])?;
            let mut sizes = size(&left);
            for ((matrix, _), factors) in self.terms.iter().zip(&factors) {
                for (column, factor) in factors.iter().enumerate() {
                    let entry = matrix[(row, column)];
                    if entry != 0.0 && !factor.is_zero() {
                        let term = exact(entry)? * factor;
                        sizes += size(&term);
                        left += term;
                    }
                }
            }
            most_left = most_left.max(size(&left));
            most = most.max(sizes);
        }
        Some(if most.is_zero() { 0.0 } else { nearest(&(most_left / most)) })
    }
}

/// A number as a fraction, if it is finite.
pub(super) fn exact(value: f64) -> Option<RBig> {
    RBig::try_from(value).ok()
}
