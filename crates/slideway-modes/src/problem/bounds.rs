//! The numbers of a mode problem: exact, or within bounds.

use nalgebra::DMatrix;

use crate::interval::{Interval, add_up};
use crate::interval_matrix::IntervalMatrix;
use crate::problem::mode_problem::{ModeProblem, ModeProblemError};
use crate::problem::pattern::ContactState;
use crate::problem::radii::Radii;
use crate::problem::side::{BySide, ProblemPart, Side};

/// Bounds that do not define a mode problem.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum IntervalModeProblemError {
    /// The midpoint of the bounds is not a mode problem.
    #[error(transparent)]
    Problem(#[from] ModeProblemError),
    /// A radius is negative, infinite or not a number.
    #[error("{part}: radius {value} is not a finite number from 0 on")]
    Radius {
        /// The part that holds the entry.
        part: ProblemPart,
        /// The radius.
        value: f64,
    },
    /// The right-hand side is not a column vector.
    #[error("right-hand side: expected one column, found {columns}")]
    RightHandSideColumns {
        /// The number of columns given.
        columns: usize,
    },
}

/// All mode problems `sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k}, y >= 0` whose numbers lie within
/// bounds, independently of each other.
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalModeProblem {
    centre: ModeProblem,
    radii: Radii,
}

impl IntervalModeProblem {
    /// The problems with columns `c_k` (r x r, column `k` belongs to contact `k`), jump vectors `d_k`
    /// (r x r, likewise) and right-hand side `N(0)` (r x 1) within bounds.
    ///
    /// # Errors
    /// [`IntervalModeProblemError`], for the first fault found.
    ///
    /// ```
    /// use nalgebra::{dmatrix, DMatrix};
    /// use slideway_modes::certificate::{decide, Decision, IntervalMatrix, IntervalModeProblem};
    /// use slideway_modes::{BySide, ContactState};
    /// // One slider, eq. (9): (sigma - mu eta s) y = N(0), with mu eta s between 0.1 and 0.3.
    /// let range = |low, high| IntervalMatrix::from_bounds(&dmatrix![low], &dmatrix![high]).expect("in order");
    /// let problem = IntervalModeProblem::new(
    ///     &BySide { positive: range(0.7, 0.9), negative: range(-1.3, -1.1) },
    ///     &BySide::same(IntervalMatrix::exact(DMatrix::zeros(1, 1))),
    ///     &IntervalMatrix::exact(dmatrix![4.0]),
    /// )?;
    /// let Decision::Solution { unknowns, .. } = decide(&problem, &[ContactState::Positive]).decision else {
    ///     panic!("the solution persists for all values");
    /// };
    /// assert!(unknowns[0].contains(4.0 / 0.7) && unknowns[0].contains(4.0 / 0.9));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        columns: &BySide<IntervalMatrix>,
        jumps: &BySide<IntervalMatrix>,
        right_hand_side: &IntervalMatrix,
    ) -> Result<Self, IntervalModeProblemError> {
        if right_hand_side.shape().1 != 1 {
            let columns = right_hand_side.shape().1;
            return Err(IntervalModeProblemError::RightHandSideColumns { columns });
        }
        let centre = ModeProblem::new(
            columns.positive.centre().clone(),
            columns.negative.centre().clone(),
            jumps.positive.centre().clone(),
            jumps.negative.centre().clone(),
            right_hand_side.centre().column(0).into_owned(),
        )?;
        let radii = Radii {
            columns: columns.map(|side| side.radius().clone()),
            jumps: jumps.map(|side| side.radius().clone()),
            right_hand_side: right_hand_side.radius().column(0).into_owned(),
        };
        Ok(Self { centre, radii })
    }

    /// A problem in which every number may be off by `relative` times its size; zeros stay zero.
    ///
    /// # Errors
    /// [`IntervalModeProblemError::Radius`] if `relative` is negative, not finite, or so large that a
    /// radius overflows.
    pub fn widened(problem: &ModeProblem, relative: f64) -> Result<Self, IntervalModeProblemError> {
        let part = ProblemPart::RightHandSide;
        if !(0.0..f64::INFINITY).contains(&relative) {
            return Err(IntervalModeProblemError::Radius { part, value: relative });
        }
        let radius = |value: f64| if value == 0.0 { 0.0 } else { (value.abs() * relative).next_up() };
        // Rounding changed the size of a column by less than one part in 2^52.
        let of_columns = |side: Side| {
            let plain = problem.columns(side).map(radius);
            match problem.remainder(side) {
                None => plain,
                Some(lost) => plain.zip_map(lost, |radius, lost| {
                    add_up(radius * (1.0 + 2.0 * f64::EPSILON), lost.abs()).next_up()
                }),
            }
        };
        let radii = Radii {
            columns: BySide::of(of_columns),
            jumps: BySide::of(|side| problem.jumps(side).map(radius)),
            right_hand_side: problem.right_hand_side().map(radius),
        };
        match radii.first_not_finite() {
            Some((part, value)) => Err(IntervalModeProblemError::Radius { part, value }),
            None => Ok(Self { centre: problem.rounded(), radii }),
        }
    }

    /// The problem at the midpoint of the bounds.
    pub fn centre(&self) -> &ModeProblem {
        &self.centre
    }
}

/// The subject of proofs: one problem with exact numbers, or all problems within bounds.
///
/// Created from a reference to a [`ModeProblem`] or to an [`IntervalModeProblem`].
#[derive(Debug, Clone, Copy)]
pub struct ProblemView<'a> {
    pub(crate) centre: &'a ModeProblem,
    /// The maximum distance of numbers from those of `centre`; for an exact problem, the size of its
    /// remainder.
    pub(crate) radii: Option<&'a Radii>,
    /// Whether the problem is `centre` itself, with its remainder.
    pub(crate) exact: bool,
}

impl<'a> From<&'a ModeProblem> for ProblemView<'a> {
    fn from(problem: &'a ModeProblem) -> Self {
        Self { centre: problem, radii: problem.remainder_radii(), exact: true }
    }
}

impl<'a> From<&'a IntervalModeProblem> for ProblemView<'a> {
    fn from(problem: &'a IntervalModeProblem) -> Self {
        Self { centre: &problem.centre, radii: Some(&problem.radii), exact: false }
    }
}

/// One column of the data: its midpoint and its maximum error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Column<'a> {
    pub(crate) centre: &'a [f64],
    pub(crate) radius: Option<&'a [f64]>,
    /// If present, the column is exactly `centre + remainder`, and `radius` is the size of the remainder.
    remainder: Option<&'a [f64]>,
}

impl Column<'_> {
    /// The terms whose sum is the column: one, or two if it is exact but its midpoint is rounded.
    pub(crate) fn terms(self) -> impl Iterator<Item = Self> {
        let radius = self.radius.filter(|_| self.remainder.is_none());
        let rest = self.remainder.map(|centre| Self { centre, radius: None, remainder: None });
        std::iter::once(Self { radius, remainder: None, ..self }).chain(rest)
    }

    pub(crate) fn entry(&self, row: usize) -> Interval {
        let radius = self.radius.map_or(0.0, |radius| radius[row]);
        Interval::around(self.centre[row], radius)
    }
}

impl<'a> ProblemView<'a> {
    pub(crate) fn contacts(self) -> usize {
        self.centre.contacts()
    }

    /// The same problem, as an exact one if all radii are zero.
    pub(crate) fn without_zero_radii(self) -> Self {
        let radii = self.radii.filter(|radii| !radii.are_zero());
        Self { exact: self.exact || radii.is_none(), radii, ..self }
    }

    /// `c_k^{side}`.
    pub(crate) fn column(self, contact: usize, side: Side) -> Column<'a> {
        Column {
            centre: column_slice(self.centre.columns(side), contact),
            radius: self.radii.map(|radii| column_slice(radii.columns.get(side), contact)),
            remainder: self.centre.remainder(side).map(|lost| column_slice(lost, contact)),
        }
    }

    /// `d_k^{side}`.
    pub(crate) fn jump(self, contact: usize, side: Side) -> Column<'a> {
        Column {
            centre: column_slice(self.centre.jumps(side), contact),
            radius: self.radii.map(|radii| column_slice(radii.jumps.get(side), contact)),
            remainder: None,
        }
    }

    /// `N(0)`.
    pub(crate) fn load(self) -> Column<'a> {
        Column {
            centre: self.centre.right_hand_side().as_slice(),
            radius: self.radii.map(|radii| radii.right_hand_side.as_slice()),
            remainder: None,
        }
    }

    /// Whether the right-hand side may jump where this contact changes its side: whether `d_k^+` and `d_k^-`
    /// differ for some value within the bounds.
    pub(crate) fn has_jump(self, contact: usize) -> bool {
        let [one, other] = Side::BOTH.map(|side| self.jump(contact, side));
        let spread = |column: Column<'_>| column.radius.is_some_and(|r| r.iter().any(|&value| value > 0.0));
        one.centre != other.centre || spread(one) || spread(other)
    }

    /// Whether an entry of a column or a jump vector differs from zero for some value within the bounds.
    pub(crate) fn couples(self, contact: usize, row: usize) -> bool {
        let nonzero = |column: Column<'_>| {
            column.centre[row] != 0.0 || column.radius.is_some_and(|radius| radius[row] != 0.0)
        };
        Side::BOTH
            .into_iter()
            .any(|side| nonzero(self.column(contact, side)) || nonzero(self.jump(contact, side)))
    }

    /// Whether `d_k^+` and `d_k^-` differ in a row for some value within the bounds.
    pub(crate) fn jumps_in_row(self, contact: usize, row: usize) -> bool {
        let [one, other] = Side::BOTH.map(|side| self.jump(contact, side));
        let spread = |column: Column<'_>| column.radius.is_some_and(|radius| radius[row] != 0.0);
        one.centre[row] != other.centre[row] || spread(one) || spread(other)
    }

    /// The side whose jump vector is in the constant part of the right-hand side; for a contact in its gap,
    /// this is the negative one.
    pub(crate) fn constant_jump_side(state: ContactState) -> Side {
        state.side().unwrap_or(Side::Negative)
    }
}

pub(crate) fn column_slice(matrix: &DMatrix<f64>, column: usize) -> &[f64] {
    let rows = matrix.nrows();
    &matrix.as_slice()[column * rows..(column + 1) * rows]
}
