//! Absolute value equations of blocks, `A x + B |x| = b`.

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};

use super::block_units::{self, interval_times_power, times_power};
use super::range::TOGETHER;
use crate::blocks::BlockProblem;
use crate::certificate::{IntervalMatrix, enclose_solution, solve_matrix_exactly};
use crate::interval::Interval;
use crate::problem::{BySide, ModeProblemError, ProblemPart, Side, check};

/// An absolute value equation whose unknowns come in blocks of one or two components,
///
/// ```text
/// A x + B |x| = b,   |x|_j = |x_j|, the length of block j
/// ```
///
/// With blocks of one it is an ordinary absolute value equation. Blocks of two are joint forces of hinges with
/// friction, or whatever else enters by its length in the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockEquation {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    right_hand_side: DVector<f64>,
    /// The first component of each block in the order of [`BlockProblem`]: blocks of one first, and the number of the
    /// block.
    order: Vec<(usize, usize)>,
    /// The unit of each block in that order is this power of two.
    units: Vec<i32>,
    problem: BlockProblem,
}

impl BlockEquation {
    /// The equation with `n` components in `m` blocks of the given sizes, 1 or 2: `a` (n x n; the identity if it is
    /// absent), `b` (n x m) and the right-hand side (n).
    ///
    /// # Errors
    /// Shapes that do not match, entries that are not finite, sizes of blocks other than 1 and 2 or that do not add up
    /// to `n`, and a matrix `A` that is not proven to be regular: one that is singular, or close to it with many rows.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::raw_problem::BlockEquation;
    /// // |x| = 5 and x = (3, 4) - 0.1 (1, 0) |x| has one solution near (2.5, 4).
    /// let equation = BlockEquation::new(None, dmatrix![0.1; 0.0], dvector![3.0, 4.0], &[2])?;
    /// assert_eq!((equation.problem().contacts(), equation.problem().hinges()), (0, 1));
    /// # Ok::<(), slideway_modes::ModeProblemError>(())
    /// ```
    pub fn new(
        a: Option<DMatrix<f64>>,
        b: DMatrix<f64>,
        right_hand_side: DVector<f64>,
        sizes: &[usize],
    ) -> Result<Self, ModeProblemError> {
        let size = right_hand_side.len();
        let order = order(sizes, size)?;
        let identity = DMatrix::identity(size, size);
        let a = a.unwrap_or_else(|| identity.clone());
        let right = DMatrix::from_column_slice(size, 1, right_hand_side.as_slice());
        let columns = ProblemPart::Columns(Side::Positive);
        check(columns, &a, (size, size))?;
        check(columns, &b, (size, sizes.len()))?;
        check(ProblemPart::RightHandSide, &right, (size, 1))?;
        let rows: Vec<usize> = order.iter().flat_map(|&(first, block)| first..first + sizes[block]).collect();
        let blocks: Vec<usize> = order.iter().map(|(_, block)| *block).collect();
        let sides = [(-&b).select_columns(&blocks), right];
        let within_bounds = if a == identity {
            Some(sides.clone().map(IntervalMatrix::exact))
        } else {
            let matrix = IntervalMatrix::exact(a.clone());
            let solved =
                |side: &DMatrix<f64>| enclose_solution(&matrix, &IntervalMatrix::exact(side.clone()));
            let [response, load] = sides.each_ref().map(solved);
            response.zip(load).map(|(response, load)| [response.solution, load.solution])
        };
        let (units, problem) = match within_bounds {
            Some(found) => {
                let [response, load] = found.each_ref().map(|matrix| with_rows(matrix, &rows));
                let no_jumps =
                    BySide::same(IntervalMatrix::exact(DMatrix::zeros(size, 2 * blocks.len() - size)));
                block_units::in_own_units(BlockProblem::within_bounds(
                    BySide::same(response),
                    no_jumps,
                    load,
                )?)
            }
            None => solved_exactly(&a, &sides, &rows).ok_or(ModeProblemError::NotRegular)?,
        };
        Ok(Self { a, b, right_hand_side, order, units, problem })
    }

    /// The block mode problem with the same solutions, blocks of one first; within bounds unless `A` is the identity. Each
    /// block is a multiple of a power of two, so that numbers of every size can be computed with.
    pub fn problem(&self) -> &BlockProblem {
        &self.problem
    }

    /// The number `n` of components.
    pub(super) fn size(&self) -> usize {
        self.right_hand_side.len()
    }

    /// `x` in the order of the equation, from the rows of a point of [`BlockProblem`]; infinite, or zero, if it is beyond the
    /// range of floating-point numbers.
    pub(super) fn unknowns(&self, rows: &[f64]) -> Vec<f64> {
        self.in_order(rows, 0.0, times_power)
    }

    /// The largest components of a direction are of the size of one.
    pub(super) fn direction(&self, rows: &[f64]) -> Vec<f64> {
        let largest = self.units.iter().copied().max().unwrap_or(0);
        self.in_order(rows, 0.0, |value, unit| times_power(value, unit - largest))
    }

    /// Returns bounds on `x` in the order of the equation, from bounds on the rows of a point.
    pub(super) fn enclosures(&self, rows: &[Interval]) -> Vec<Interval> {
        self.in_order(rows, Interval::ZERO, interval_times_power)
    }

    fn in_order<T: Copy>(&self, rows: &[T], zero: T, scaled: impl Fn(T, i32) -> T) -> Vec<T> {
        let mut x = vec![zero; self.size()];
        let contacts = self.problem.contacts();
        let sizes = (0..self.order.len()).map(|block| if block < contacts { 1 } else { 2 });
        let units = self.order.iter().zip(&self.units).zip(sizes);
        let places =
            units.flat_map(|((&(first, _), &unit), size)| (first..first + size).map(move |at| (at, unit)));
        for ((at, unit), &value) in places.zip(rows) {
            x[at] = scaled(value, unit);
        }
        x
    }

    /// The residual of a solution with these lengths of blocks in the order of [`BlockProblem`], relative to the
    /// largest sum of sizes of terms in an equation; `None` if numbers overflow or underflow.
    pub(super) fn residual(&self, x: &[f64], lengths: &[f64]) -> Option<f64> {
        let x = DVector::from_column_slice(x);
        let mut of_blocks = DVector::zeros(self.order.len());
        for ((&(_, block), &length), &unit) in self.order.iter().zip(lengths).zip(&self.units) {
            of_blocks[block] = times_power(length, unit);
        }
        let sum = &self.a * &x + &self.b * &of_blocks - &self.right_hand_side;
        let sizes = self.a.abs() * x.abs() + self.b.abs() * &of_blocks + self.right_hand_side.abs();
        let (sum, size) = (sum.amax(), sizes.amax());
        match size {
            0.0 => Some(0.0),
            _ => (sum.is_finite() && size.is_normal()).then(|| sum / size),
        }
    }
}

/// The first component and the number of each block, blocks of one first.
fn order(sizes: &[usize], components: usize) -> Result<Vec<(usize, usize)>, ModeProblemError> {
    if let Some((block, &size)) = sizes.iter().enumerate().find(|(_, size)| !(1..=2).contains(*size)) {
        return Err(ModeProblemError::BlockSize { block, size });
    }
    let found = sizes.iter().sum();
    if found != components {
        return Err(ModeProblemError::BlockSizes { found, components });
    }
    let mut first = 0;
    let mut order: Vec<(usize, usize)> = Vec::new();
    for (block, size) in sizes.iter().enumerate() {
        order.push((first, block));
        first += size;
    }
    order.sort_by_key(|(_, block)| sizes[*block]);
    Ok(order)
}

/// The units of the blocks and the problem in these, from exact numbers: these rows of `A^-1` times these columns. `None` if
/// `A` is singular, too large for that, or numbers overflow.
fn solved_exactly(
    a: &DMatrix<f64>,
    sides: &[DMatrix<f64>; 2],
    rows: &[usize],
) -> Option<(Vec<i32>, BlockProblem)> {
    if a.nrows() > TOGETHER {
        return None;
    }
    let in_order = |column: Vec<RBig>| rows.iter().map(|&row| column[row].clone()).collect();
    let solved = sides.iter().map(|side| solve_matrix_exactly(a, side)).collect::<Option<Vec<_>>>()?;
    let columns: Vec<Vec<RBig>> = solved.into_iter().flatten().map(in_order).collect();
    block_units::exactly_in_own_units(&columns)
}

/// These rows.
fn with_rows(matrix: &IntervalMatrix, rows: &[usize]) -> IntervalMatrix {
    let of = |part: &DMatrix<f64>| part.select_rows(rows);
    IntervalMatrix::around(of(matrix.centre()), of(matrix.radius()))
        .expect("parts of an interval matrix are one")
}
