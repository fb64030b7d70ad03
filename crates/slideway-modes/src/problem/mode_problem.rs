//! The mode problem as pure numbers: two versions of every column and of every jump vector.

use nalgebra::allocator::Allocator;
use nalgebra::{DMatrix, DVector, DefaultAllocator, Dim, Dyn, OMatrix};

use crate::error_free::sum_remainder;
use crate::interval::Real;
use crate::problem::radii::Radii;
use crate::problem::side::{BySide, ProblemPart, Side};

/// Data that do not define a mode problem.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ModeProblemError {
    /// A matrix or vector does not match the number of contacts.
    #[error("{part}: expected {} x {}, found {} x {}", expected.0, expected.1, found.0, found.1)]
    Shape {
        /// The part that does not fit.
        part: ProblemPart,
        /// Rows and columns that the right-hand side requires.
        expected: (usize, usize),
        /// Rows and columns found.
        found: (usize, usize),
    },
    /// An entry is infinite or NaN.
    #[error("{part}: entry in row {row}, column {column} (counted from 0) is {value}")]
    NotFinite {
        /// The part that holds the entry.
        part: ProblemPart,
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        column: usize,
        /// The entry.
        value: f64,
    },
    /// The sign of a sliding velocity is not -1, 0 or 1.
    #[error("velocity sign of contact {contact} (counted from 0) is {value}; it must be -1, 0 or 1")]
    VelocitySign {
        /// The contact, from 0.
        contact: usize,
        /// The value found.
        value: f64,
    },
    /// The column of a hinge differs between the sides.
    #[error("columns of both sides: column {column} (counted from 0) is that of a hinge and must not differ")]
    HingeColumn {
        /// The column, from 0.
        column: usize,
    },
    /// A block of neither one nor two components.
    #[error("block {block} (counted from 0) has {size} components; a block has 1 or 2")]
    BlockSize {
        /// The block, from 0.
        block: usize,
        /// The number of its components.
        size: usize,
    },
    /// Blocks that do not add up to the number of components.
    #[error("the blocks have {found} components, the right-hand side has {components}")]
    BlockSizes {
        /// The components of all blocks.
        found: usize,
        /// The entries of the right-hand side.
        components: usize,
    },
    /// A matrix that has to be regular, and is not proven to be.
    #[error("`A` is singular, or too close to it to be solved for x")]
    NotRegular,
    /// A problem with blocks of two components, whose lengths are no linear functions.
    #[error("a problem with blocks of two components is no mode problem")]
    Blocks,
}

/// The mode problem of `r` contacts,
///
/// ```text
/// sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k},   y >= 0,   sigma in {-1, +1}^r
/// ```
///
/// (Klepp (2002), eqs. (6) and (8); theory, section 3). `y_k = |N_k|`, and both the column `c_k`
/// and the jump vector `d_k` have one version for each side of contact `k`.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeProblem {
    columns: BySide<DMatrix<f64>>,
    jumps: BySide<DMatrix<f64>>,
    right_hand_side: DVector<f64>,
    has_jump: Vec<bool>,
    remainder: Option<Box<Remainder>>,
}

/// The rounding errors of columns that are sums: the exact columns are `columns + remainder`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Remainder {
    pub(crate) columns: BySide<DMatrix<f64>>,
    /// Their sizes, as the radii of a problem within bounds.
    pub(crate) radii: Radii,
}

impl Remainder {
    /// `None` if nothing was rounded.
    fn new(columns: BySide<DMatrix<f64>>) -> Option<Box<Self>> {
        let radii = Radii { columns: columns.map(DMatrix::abs), ..Radii::zero(columns.positive.nrows()) };
        (!radii.are_zero()).then(|| Box::new(Self { columns, radii }))
    }
}

impl ModeProblem {
    /// The problem with the given columns `c_k` (r x r, column `k` belongs to contact `k`), jump
    /// vectors `d_k` (r x r, likewise) and right-hand side `N(0)` (r).
    ///
    /// `d` and `N(0)` have the same unit (a force), which is also the unit of `y` if the columns are
    /// dimensionless.
    ///
    /// # Errors
    /// [`ModeProblemError::Shape`] and [`ModeProblemError::NotFinite`], for the first fault found.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector, DMatrix};
    /// use slideway_modes::ModeProblem;
    /// // One slider, eq. (9): (sigma - mu eta s) y = N(0), with mu eta s = 0.2.
    /// let none = DMatrix::zeros(1, 1);
    /// let problem = ModeProblem::new(dmatrix![0.8], dmatrix![-1.2], none.clone(), none, dvector![4.0])?;
    /// assert_eq!(problem.contacts(), 1);
    /// # Ok::<(), slideway_modes::ModeProblemError>(())
    /// ```
    pub fn new(
        columns_positive: DMatrix<f64>,
        columns_negative: DMatrix<f64>,
        jumps_positive: DMatrix<f64>,
        jumps_negative: DMatrix<f64>,
        right_hand_side: DVector<f64>,
    ) -> Result<Self, ModeProblemError> {
        let contacts = right_hand_side.len();
        let columns = BySide { positive: columns_positive, negative: columns_negative };
        let jumps = BySide { positive: jumps_positive, negative: jumps_negative };
        check(ProblemPart::RightHandSide, &right_hand_side, (contacts, 1))?;
        for side in Side::BOTH {
            check(ProblemPart::Columns(side), columns.get(side), (contacts, contacts))?;
            check(ProblemPart::Jumps(side), jumps.get(side), (contacts, contacts))?;
        }
        Ok(Self::unchecked(columns, jumps, right_hand_side))
    }

    /// The problem whose signed solutions `N` are all solutions `x` of `A x + B |x| = b`:
    /// columns `sigma A_k + B_k`, no jumps. `a` and `b` are r x r, `right_hand_side` has r entries.
    ///
    /// # Errors
    /// [`ModeProblemError::Shape`] and [`ModeProblemError::NotFinite`].
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::{enumerate, Limits, ModeProblem};
    /// // x + 2 |x| = 3 has the solutions 1 and -3.
    /// let problem = ModeProblem::from_absolute_value_equation(&dmatrix![1.0], &dmatrix![2.0], dvector![3.0])?;
    /// let solutions = enumerate(&problem, &Limits::default())?;
    /// assert_eq!(solutions.solutions[0].normal_force[0], 1.0);
    /// assert_eq!(solutions.solutions[1].normal_force[0], -3.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_absolute_value_equation(
        a: &DMatrix<f64>,
        b: &DMatrix<f64>,
        right_hand_side: DVector<f64>,
    ) -> Result<Self, ModeProblemError> {
        let contacts = right_hand_side.len();
        check(ProblemPart::Columns(Side::Positive), a, (contacts, contacts))?;
        check(ProblemPart::Columns(Side::Negative), b, (contacts, contacts))?;
        let none = DMatrix::zeros(contacts, contacts);
        let mut problem = Self::new(a + b, b - a, none.clone(), none, right_hand_side)?;
        let lost = |one: &DMatrix<f64>, other: &DMatrix<f64>, sum: &DMatrix<f64>| {
            one.zip_zip_map(other, sum, sum_remainder)
        };
        problem.remainder = Remainder::new(BySide {
            positive: lost(a, b, &problem.columns.positive),
            negative: lost(b, &-a, &problem.columns.negative),
        });
        Ok(problem)
    }

    /// The problem that lists all solutions of the linear complementarity problem
    /// `w = M z + q, w >= 0, z >= 0, w^T z = 0`.
    ///
    /// On the positive side of contact `k`, the unknown `y_k` is `z_k` (column `-M_k`); on the negative side
    /// it is `w_k` (column `e_k`); the right-hand side is `q`. Thus `z` is the positive part of the signed
    /// solution `N`, and `w` its negative part.
    ///
    /// # Errors
    /// [`ModeProblemError::Shape`] and [`ModeProblemError::NotFinite`].
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::{enumerate, Limits, ModeProblem};
    /// // w = 2 z - 4: only z = 2, w = 0.
    /// let problem = ModeProblem::from_linear_complementarity(&dmatrix![2.0], dvector![-4.0])?;
    /// let solutions = enumerate(&problem, &Limits::default())?;
    /// assert_eq!(solutions.solutions.len(), 1);
    /// assert_eq!(solutions.solutions[0].normal_force[0], 2.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_linear_complementarity(m: &DMatrix<f64>, q: DVector<f64>) -> Result<Self, ModeProblemError> {
        let contacts = q.len();
        let none = DMatrix::zeros(contacts, contacts);
        Self::new(-m, DMatrix::identity(contacts, contacts), none.clone(), none, q)
    }

    /// The problem whose solutions are all `(w, z)` of the horizontal linear complementarity problem
    /// `A w - B z = q, w >= 0, z >= 0, w^T z = 0` (the form of Sznajder and Gowda, Linear Algebra and
    /// its Applications 223/224 (1995)). With `A = I` it is the linear complementarity problem of `B`.
    ///
    /// On the positive side of contact `k`, the unknown `y_k` is `z_k` (column `-B_k`); on the negative side
    /// it is `w_k` (column `A_k`), as in [`Self::from_linear_complementarity`].
    ///
    /// # Errors
    /// [`ModeProblemError::Shape`] and [`ModeProblemError::NotFinite`].
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::{enumerate, Limits, ModeProblem};
    /// // 2 w - 3 z = 6: only w = 3, z = 0.
    /// let problem = ModeProblem::from_horizontal_complementarity(&dmatrix![2.0], &dmatrix![3.0], dvector![6.0])?;
    /// let solutions = enumerate(&problem, &Limits::default())?;
    /// assert_eq!(solutions.solutions.len(), 1);
    /// assert_eq!(solutions.solutions[0].normal_force[0], -3.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_horizontal_complementarity(
        a: &DMatrix<f64>,
        b: &DMatrix<f64>,
        q: DVector<f64>,
    ) -> Result<Self, ModeProblemError> {
        let none = DMatrix::zeros(q.len(), q.len());
        Self::new(-b, a.clone(), none.clone(), none, q)
    }

    /// The number `r` of contacts.
    pub fn contacts(&self) -> usize {
        self.right_hand_side.len()
    }

    /// The equations and columns of only some contacts, with their entries of `right_hand_side`, which are
    /// finite.
    pub(crate) fn restricted(&self, contacts: &[usize], right_hand_side: &DVector<f64>) -> Self {
        let size = contacts.len();
        let of = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(size, size, |row, column| matrix[(contacts[row], contacts[column])])
        };
        let by_side = |part: &BySide<DMatrix<f64>>| part.map(of);
        let right_hand_side = DVector::from_fn(size, |row, _| right_hand_side[contacts[row]]);
        let remainder = self.remainder.as_ref().and_then(|lost| Remainder::new(by_side(&lost.columns)));
        Self { remainder, ..Self::unchecked(by_side(&self.columns), by_side(&self.jumps), right_hand_side) }
    }

    /// The problem with another contact for each half-space `sum_j a_j y_j <= gamma`: its positive side is the slack
    /// `s` of `sum_j a_j y_j + s = gamma`. The entries `a_j` of all positive sides come first, then those of the
    /// negative ones.
    pub(crate) fn within_half_spaces(&self, half_spaces: &[(DVector<f64>, f64)]) -> Self {
        let (contacts, size) = (self.contacts(), self.contacts() + half_spaces.len());
        let widened = |matrix: &DMatrix<f64>| matrix.clone().resize(size, size, 0.0);
        let columns = |side: usize, slack: f64, own: &DMatrix<f64>| {
            let mut columns = widened(own);
            for (at, (form, _)) in (contacts..).zip(half_spaces) {
                columns.view_mut((at, 0), (1, contacts)).tr_copy_from(&form.rows(side * contacts, contacts));
                columns[(at, at)] = slack;
            }
            columns
        };
        let limits = half_spaces.iter().map(|(_, limit)| *limit);
        let right: Vec<f64> = self.right_hand_side.iter().copied().chain(limits).collect();
        let by_side = |part: &BySide<DMatrix<f64>>| part.map(widened);
        let both = BySide {
            positive: columns(0, 1.0, &self.columns.positive),
            negative: columns(1, -1.0, &self.columns.negative),
        };
        let remainder = self.remainder.as_ref().and_then(|lost| Remainder::new(by_side(&lost.columns)));
        Self { remainder, ..Self::unchecked(both, by_side(&self.jumps), right.into()) }
    }

    /// The problem from finite numbers in matching matrices.
    fn unchecked(
        columns: BySide<DMatrix<f64>>,
        jumps: BySide<DMatrix<f64>>,
        right_hand_side: DVector<f64>,
    ) -> Self {
        let jumps_at = |contact| jumps.positive.column(contact) != jumps.negative.column(contact);
        let has_jump = (0..right_hand_side.len()).map(jumps_at).collect();
        Self { columns, jumps, right_hand_side, has_jump, remainder: None }
    }

    /// The columns `c_k` of one side (r x r); rounded if they are sums of two matrices: see
    /// [`Self::remainder`].
    pub fn columns(&self, side: Side) -> &DMatrix<f64> {
        self.columns.get(side)
    }

    /// The exact rounding errors of [`Self::columns`] (r x r); `None` if there are none. The problem is the
    /// one with the columns `columns + remainder`.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::{ModeProblem, Side};
    /// let problem = ModeProblem::from_absolute_value_equation(&dmatrix![1.0], &dmatrix![1e-20], dvector![1.0])?;
    /// assert_eq!(problem.columns(Side::Positive)[0], 1.0);
    /// assert_eq!(problem.remainder(Side::Positive).map(|lost| lost[0]), Some(1e-20));
    /// # Ok::<(), slideway_modes::ModeProblemError>(())
    /// ```
    pub fn remainder(&self, side: Side) -> Option<&DMatrix<f64>> {
        self.remainder.as_ref().map(|lost| lost.columns.get(side))
    }

    /// The sizes of the remainder as radii of the rounded columns; `None` if nothing was rounded.
    pub(crate) fn remainder_radii(&self) -> Option<&Radii> {
        self.remainder.as_ref().map(|lost| &lost.radii)
    }

    /// The problem with the rounded columns.
    pub(crate) fn rounded(&self) -> Self {
        Self { remainder: None, ..self.clone() }
    }

    /// The jump vectors `d_k` of one side (r x r).
    pub fn jumps(&self, side: Side) -> &DMatrix<f64> {
        self.jumps.get(side)
    }

    /// The right-hand side `N(0)` (r).
    pub fn right_hand_side(&self) -> &DVector<f64> {
        &self.right_hand_side
    }

    /// Whether the right-hand side jumps where this contact changes its side: `d_k^+ != d_k^-`, exactly.
    ///
    /// # Panics
    /// If there is no such contact.
    pub fn has_jump(&self, contact: usize) -> bool {
        self.has_jump[contact]
    }

    /// [`has_jump`](Self::has_jump) of every contact.
    pub fn jumps_of_contacts(&self) -> Vec<bool> {
        self.has_jump.clone()
    }
}

/// Refuses a part of the wrong shape or with an entry that is not finite.
pub(crate) fn check<T: Real, C: Dim>(
    part: ProblemPart,
    matrix: &OMatrix<T, Dyn, C>,
    expected: (usize, usize),
) -> Result<(), ModeProblemError>
where
    DefaultAllocator: Allocator<Dyn, C>,
{
    if matrix.shape() != expected {
        return Err(ModeProblemError::Shape { part, expected, found: matrix.shape() });
    }
    match matrix.iter().position(|entry| !entry.is_finite()) {
        Some(at) => {
            let (row, column) = (at % expected.0, at / expected.0);
            let value = matrix[(row, column)].middle();
            Err(ModeProblemError::NotFinite { part, row, column, value })
        }
        None => Ok(()),
    }
}
