//! Batches in which only friction coefficients vary.

use super::determinants::{Determinants, FrictionPoints};
use super::kernel::{self, BatchState, Visitor};
use super::{BatchError, BatchSolutions, MOST_CONTACTS};
use crate::problem::{InfluenceCoefficients, ModeProblem};

/// A structure for which some friction coefficients take very many values.
#[derive(Debug, Clone)]
pub struct FrictionBatch {
    influence: InfluenceCoefficients,
    determinants: Determinants,
}

impl FrictionBatch {
    /// From a structure and the contacts whose friction coefficients vary. The values of these in
    /// `influence.mu` do not matter; in the batch, one value applies to both sides of a contact.
    ///
    /// Built once for all batches of a structure: with `r` contacts, all varied, this takes `3^r + r 3^(r-1)`
    /// determinants (54 for 3 contacts, 24 057 for 8).
    ///
    /// # Errors
    /// [`BatchError`] if the structure has no contacts, has too many, or does not define a mode problem, or
    /// if a varied contact does not exist.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::batch::{BatchSolutions, FrictionBatch};
    /// use slideway_modes::{BySide, InfluenceCoefficients};
    /// // A single slider, eq. (9): N = N(0) / (sigma - mu eta) has a solution for each sign
    /// // that agrees. It locks at mu = 1 / eta = 2, and from there on there is none.
    /// let influence = InfluenceCoefficients {
    ///     eta: BySide::same(dmatrix![0.5]),
    ///     eta_preload: BySide::same(dmatrix![0.5]),
    ///     mu: BySide::same(dvector![0.0]),
    ///     preload: BySide::same(dvector![0.0]),
    ///     velocity_signs: dvector![1.0],
    ///     frictionless: dvector![4.0],
    /// };
    /// let batch = FrictionBatch::new(&influence, &[0])?;
    /// let mut solutions = BatchSolutions::default();
    /// batch.solve(&[&[0.0, 1.0, 2.0, 3.0]], &mut solutions)?;
    /// assert_eq!([0, 1, 2, 3].map(|point| solutions.count(point)), [Some(1), Some(1), None, Some(0)]);
    /// # Ok::<(), slideway_modes::batch::BatchError>(())
    /// ```
    pub fn new(influence: &InfluenceCoefficients, varied: &[usize]) -> Result<Self, BatchError> {
        let contacts = influence.frictionless.len();
        if !(1..=MOST_CONTACTS).contains(&contacts) {
            return Err(BatchError::Contacts { contacts });
        }
        for (at, &contact) in varied.iter().enumerate() {
            if contact >= contacts || varied[..at].contains(&contact) {
                return Err(BatchError::Varied { contact });
            }
        }
        ModeProblem::from_influence(influence)?;
        let mut influence = influence.clone();
        set_friction(&mut influence, varied, |_| 0.0);
        let problem = ModeProblem::from_influence(&influence)?;
        let determinants = Determinants::new(&influence, &problem, varied);
        Ok(Self { influence, determinants })
    }

    /// The same for a structure whose numbers are known to `accuracy`, relative to the 1-norm of their
    /// column: then more points are in doubt. For each of the `r` numbers of a column, a determinant of `r`
    /// columns changes by `r` times this fraction of the product of their norms.
    #[must_use]
    pub fn known_to(mut self, accuracy: f64) -> Self {
        self.determinants.known_to(accuracy);
        self
    }

    /// Whether the friction of preload depends on the side at some contact: then gap states may occur, too.
    pub fn has_jump(&self) -> bool {
        self.determinants.both_sides
    }

    /// Finds the patterns that have a solution at every point. `friction` contains, for each varied contact
    /// in the given order, its friction coefficient at all points.
    ///
    /// # Errors
    /// [`BatchError::Length`] if there is not one list for each varied contact, or if the lists have
    /// different lengths.
    pub fn solve(&self, friction: &[&[f64]], solutions: &mut BatchSolutions) -> Result<(), BatchError> {
        self.run(friction, solutions, None)
    }

    /// The same, calling `visit(point, pattern, y)` for each solution, with points and patterns in increasing
    /// order. `y_k = |N_k|` has the unit of `N(0)` and an error of at most
    /// `(r (r + 1) / 2 + 6 r) eps (y_k prod_j |c_j|_1 + |b|_1 prod_{j != k} |c_j|_1) / |D|`.
    ///
    /// # Errors
    /// As for [`solve`](Self::solve).
    pub fn solve_each(
        &self,
        friction: &[&[f64]],
        solutions: &mut BatchSolutions,
        mut visit: impl FnMut(usize, usize, &[f64]),
    ) -> Result<(), BatchError> {
        self.run(friction, solutions, Some(&mut |state| visit(state.point, state.pattern, state.y)))
    }

    /// The same, with the sign of each determinant.
    ///
    /// # Errors
    /// As for [`solve`](Self::solve).
    pub fn solve_states(
        &self,
        friction: &[&[f64]],
        solutions: &mut BatchSolutions,
        mut visit: impl FnMut(BatchState<'_>),
    ) -> Result<(), BatchError> {
        self.run(friction, solutions, Some(&mut visit))
    }

    /// The mode problem of one point, to be passed to [`enumerate`](crate::enumerate) for a point in doubt.
    ///
    /// # Errors
    /// [`BatchError::Length`], and [`BatchError::Problem`] if a coefficient is not finite.
    pub fn problem_at(&self, friction: &[f64]) -> Result<ModeProblem, BatchError> {
        if friction.len() != self.determinants.varied.len() {
            return Err(BatchError::Length {
                expected: self.determinants.varied.len(),
                found: friction.len(),
            });
        }
        let mut influence = self.influence.clone();
        set_friction(&mut influence, &self.determinants.varied, |at| friction[at]);
        Ok(ModeProblem::from_influence(&influence)?)
    }

    fn run(
        &self,
        friction: &[&[f64]],
        solutions: &mut BatchSolutions,
        visitor: Option<Visitor<'_>>,
    ) -> Result<(), BatchError> {
        let points = self.checked(friction)?;
        solutions.reset(self.determinants.contacts, points.points());
        kernel::run(&points, solutions, visitor);
        Ok(())
    }

    /// [`solve`](Self::solve) without instructions that some processors lack, for comparison.
    ///
    /// # Errors
    /// As for [`solve`](Self::solve).
    #[doc(hidden)]
    pub fn solve_baseline(
        &self,
        friction: &[&[f64]],
        solutions: &mut BatchSolutions,
    ) -> Result<(), BatchError> {
        let points = self.checked(friction)?;
        solutions.reset(self.determinants.contacts, points.points());
        kernel::run_baseline(&points, solutions, None);
        Ok(())
    }

    fn checked<'a>(&'a self, friction: &'a [&'a [f64]]) -> Result<FrictionPoints<'a>, BatchError> {
        if friction.len() != self.determinants.varied.len() {
            return Err(BatchError::Length {
                expected: self.determinants.varied.len(),
                found: friction.len(),
            });
        }
        let count = friction.first().map_or(1, |values| values.len());
        match friction.iter().find(|values| values.len() != count) {
            Some(values) => Err(BatchError::Length { expected: count, found: values.len() }),
            None => Ok(self.determinants.at(friction, count)),
        }
    }
}

fn set_friction(influence: &mut InfluenceCoefficients, varied: &[usize], value: impl Fn(usize) -> f64) {
    for (at, &contact) in varied.iter().enumerate() {
        influence.mu.positive[contact] = value(at);
        influence.mu.negative[contact] = value(at);
    }
}
