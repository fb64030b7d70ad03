//! The block mode problem: exact, or within bounds.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::interval::Interval;
use crate::interval_matrix::IntervalMatrix;
use crate::problem::{BlockNumbers, BySide, ContactState, ModeProblemError, ProblemPart, Side, check};

/// The mode problem of `s` contacts and `h` hinges with friction,
///
/// ```text
/// x = b + d^sigma + H^sigma w,   w_j = |x_j|
/// ```
///
/// where the block `x_k` of a contact is its normal force `N_k`, a number, and the block `x_j` of a hinge is
/// its reaction `R_j`, a vector of two components, with its length `w_j` (theory of hinges, section 1).
/// Contacts come first: rows `0..s` belong to them, and rows `s + 2 j` and `s + 2 j + 1` to hinge `j`; column
/// `k < s` of `H` belongs to contact `k` and has a version for each side, column `s + j` to hinge `j`. The
/// jump vectors `d_k^sigma` have one version for each side, too; a contact whose versions differ may rest in
/// its gap, where `N_k = 0` and `d_k = lambda d_k^+ + (1 - lambda) d_k^-`, `0 <= lambda <= 1`.
///
/// A linear term `A x` in place of `x`, which differs from it in the columns of contacts, is the part
/// `sigma (I - A)` of `H^sigma`: so stand contacts here that share a load
/// ([`SharedLoad::response`](crate::SharedLoad::response)).
#[derive(Debug, Clone, PartialEq)]
pub struct BlockProblem {
    response: BySide<IntervalMatrix>,
    jumps: BySide<IntervalMatrix>,
    load: IntervalMatrix,
    has_jump: Vec<bool>,
    forceless: Vec<usize>,
}

impl BlockProblem {
    /// The problem with the given response `H` ((s + 2 h) x (s + h)), jump vectors ((s + 2 h) x s) and load `b`
    /// (s + 2 h). The numbers of contacts and hinges follow from the shape of `H`.
    ///
    /// # Errors
    /// [`ModeProblemError`] for shapes that do not match, entries that are not finite, and columns of hinges
    /// that differ between the sides.
    ///
    /// ```
    /// use nalgebra::{DMatrix, dmatrix, dvector};
    /// use slideway_modes::BySide;
    /// use slideway_modes::blocks::BlockProblem;
    /// // One hinge: R = b + e |R|.
    /// let none = BySide::same(DMatrix::zeros(2, 0));
    /// let problem = BlockProblem::new(BySide::same(dmatrix![0.1; 0.2]), none, dvector![3.0, 4.0])?;
    /// assert_eq!((problem.contacts(), problem.hinges()), (0, 1));
    /// # Ok::<(), slideway_modes::ModeProblemError>(())
    /// ```
    pub fn new(
        response: BySide<DMatrix<f64>>,
        jumps: BySide<DMatrix<f64>>,
        load: DVector<f64>,
    ) -> Result<Self, ModeProblemError> {
        let exact = |part: BySide<DMatrix<f64>>| part.map(|side| IntervalMatrix::exact(side.clone()));
        let load = DMatrix::from_vec(load.len(), 1, load.data.into());
        Self::within_bounds(exact(response), exact(jumps), IntervalMatrix::exact(load))
    }

    /// All problems whose numbers lie within bounds, independently of each other, except that the columns of
    /// hinges are the same on both sides. What is proven holds for each of them.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn within_bounds(
        response: BySide<IntervalMatrix>,
        jumps: BySide<IntervalMatrix>,
        load: IntervalMatrix,
    ) -> Result<Self, ModeProblemError> {
        let rows = load.shape().0;
        let columns = response.positive.shape().1.clamp(rows.div_ceil(2), rows);
        let contacts = 2 * columns - rows;
        check(ProblemPart::RightHandSide, load.centre(), (rows, 1))?;
        for side in Side::BOTH {
            check(ProblemPart::Columns(side), response.get(side).centre(), (rows, columns))?;
            check(ProblemPart::Jumps(side), jumps.get(side).centre(), (rows, contacts))?;
        }
        let differs = |part: &BySide<IntervalMatrix>, column: usize| {
            let parts = [&part.positive, &part.negative];
            let [one, other] = parts.map(|part| (part.centre().column(column), part.radius().column(column)));
            one != other
        };
        if let Some(column) = (contacts..columns).find(|&column| differs(&response, column)) {
            return Err(ModeProblemError::HingeColumn { column });
        }
        let uncertain = |side: Side, contact| jumps.get(side).radius().column(contact).amax() > 0.0;
        let has_jump = (0..contacts).map(|contact| {
            differs(&jumps, contact) || Side::BOTH.into_iter().any(|side| uncertain(side, contact))
        });
        let forceless = (0..contacts).filter(|&row| is_forceless(&response, row)).collect();
        Ok(Self { has_jump: has_jump.collect(), forceless, response, jumps, load })
    }

    /// The problem with the column of each block of `H` multiplied by its factor, where the numbers are exact.
    ///
    /// # Errors
    /// Entries that are not finite then.
    pub fn with_response_times(&self, factors: &[f64]) -> Result<Self, ModeProblemError> {
        let response = self.response.try_map(|side, given| {
            let matrix = IntervalMatrix::exact(times(given.centre().clone(), factors));
            check(ProblemPart::Columns(side), matrix.centre(), matrix.shape()).map(|()| matrix)
        })?;
        Ok(Self { response, ..self.clone() })
    }

    /// The number `s` of contacts.
    pub fn contacts(&self) -> usize {
        self.has_jump.len()
    }

    /// The number `h` of hinges.
    pub fn hinges(&self) -> usize {
        self.blocks() - self.contacts()
    }

    /// Whether the right-hand side may jump where this contact changes its side.
    ///
    /// # Panics
    /// If there is no such contact.
    pub fn has_jump(&self, contact: usize) -> bool {
        self.has_jump[contact]
    }

    /// The rows in which no force stands: those of contacts with `H_k^sigma = sigma e_k`.
    pub(super) fn forceless(&self) -> &[usize] {
        &self.forceless
    }

    /// The response `H` with the columns of contacts on one side.
    pub fn response(&self, side: Side) -> &IntervalMatrix {
        self.response.get(side)
    }

    /// The jump vectors of one side.
    pub fn jumps(&self, side: Side) -> &IntervalMatrix {
        self.jumps.get(side)
    }

    /// The load `b`, one column.
    pub fn load(&self) -> &IntervalMatrix {
        &self.load
    }

    /// The number of blocks, `s + h`.
    pub(crate) fn blocks(&self) -> usize {
        self.response.positive.shape().1
    }

    /// The number of equations, `s + 2 h`.
    pub(super) fn rows(&self) -> usize {
        self.load.shape().0
    }

    /// The rows of a block: one or two.
    pub(crate) fn rows_of(&self, block: usize) -> Range<usize> {
        rows_of_block(self.contacts(), block)
    }

    /// Both rows of a hinge.
    pub(super) fn rows_of_hinge(&self, hinge: usize) -> [usize; 2] {
        let first = self.contacts() + 2 * hinge;
        [first, first + 1]
    }

    /// Whether a block acts on any, for some value within the bounds.
    pub(super) fn has_friction(&self, block: usize) -> bool {
        let parts = [&self.response.positive, &self.response.negative];
        let largest = |part: &IntervalMatrix| {
            part.centre().column(block).amax().max(part.radius().column(block).amax())
        };
        parts.into_iter().any(|part| largest(part) > 0.0)
    }

    /// Whether the load is zero for every pattern of sides.
    pub(super) fn has_no_load(&self) -> bool {
        let zero =
            |part: &IntervalMatrix| part.centre().iter().chain(part.radius()).all(|&value| value == 0.0);
        zero(&self.load) && Side::BOTH.into_iter().all(|side| zero(self.jumps.get(side)))
    }

    /// The largest bound on an error relative to the largest number of its part; zero for an exact problem.
    pub(super) fn relative_radius(&self) -> f64 {
        let largest =
            |matrix: &DMatrix<f64>| matrix.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let relative = |part: &IntervalMatrix| match largest(part.radius()) {
            0.0 => 0.0,
            radius => radius / largest(part.centre()).max(f64::MIN_POSITIVE),
        };
        let of_response = Side::BOTH.map(|side| relative(self.response.get(side)));
        of_response.into_iter().fold(relative(&self.load), f64::max)
    }

    /// The jump vector in the load of a contact in a known state; of one in its gap, that of the negative side.
    pub(super) fn constant_jump(state: ContactState) -> Side {
        state.side().unwrap_or(Side::Negative)
    }
}

impl BlockNumbers {
    /// The problem of exact numbers.
    ///
    /// # Errors
    /// As [`BlockProblem::new`].
    pub fn problem(self) -> Result<BlockProblem, ModeProblemError> {
        BlockProblem::new(self.response, self.jumps, self.load)
    }
}

impl BlockNumbers<Interval> {
    /// The problem of numbers within bounds. Returns `None` if one has none.
    pub fn problem(&self) -> Option<BlockProblem> {
        let both = |sides: &BySide<DMatrix<Interval>>| {
            sides.try_map(|_, side| IntervalMatrix::from_intervals(side).ok_or(())).ok()
        };
        let load = DMatrix::from_columns(std::slice::from_ref(&self.load));
        let load = IntervalMatrix::from_intervals(&load)?;
        BlockProblem::within_bounds(both(&self.response)?, both(&self.jumps)?, load).ok()
    }
}

/// The rows of a block behind so many contacts: one or two.
pub(crate) fn rows_of_block(contacts: usize, block: usize) -> Range<usize> {
    match block.checked_sub(contacts) {
        None => block..block + 1,
        Some(hinge) => contacts + 2 * hinge..contacts + 2 * hinge + 2,
    }
}

/// True if no force stands in the row of a contact.
fn is_forceless(response: &BySide<IntervalMatrix>, row: usize) -> bool {
    Side::BOTH.into_iter().all(|side| {
        let own = |column: usize| if column == row { side.sign() } else { 0.0 };
        let part = response.get(side);
        (0..part.shape().1)
            .all(|column| part.centre()[(row, column)] == own(column) && part.radius()[(row, column)] == 0.0)
    })
}

/// A matrix with each column multiplied by its factor.
pub(crate) fn times(mut matrix: DMatrix<f64>, factors: &[f64]) -> DMatrix<f64> {
    for (mut column, factor) in matrix.column_iter_mut().zip(factors) {
        column.scale_mut(*factor);
    }
    matrix
}
