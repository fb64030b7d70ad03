//! Absolute value equations of blocks, `A x + B |x| = b`.

use nalgebra::{DMatrix, DVector};

use crate::blocks::BlockProblem;
use crate::certificate::{IntervalMatrix, enclose_solution};
use crate::problem::{BySide, ModeProblemError, ProblemPart, Side};

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
    problem: BlockProblem,
}

impl BlockEquation {
    /// The equation with `n` components in `m` blocks of the given sizes, 1 or 2: `a` (n x n; the identity if it is
    /// absent), `b` (n x m) and the right-hand side (n).
    ///
    /// # Errors
    /// Shapes that do not match, entries that are not finite, sizes of blocks other than 1 and 2 or that do not add up
    /// to `n`, and a matrix `A` that is not proven to be regular.
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
        let [response, load] = if a == identity {
            [-&b, right].map(IntervalMatrix::exact)
        } else {
            let matrix = IntervalMatrix::exact(a.clone());
            let solved = |right| enclose_solution(&matrix, &IntervalMatrix::exact(right));
            let (response, load) = solved(-&b).zip(solved(right)).ok_or(ModeProblemError::NotRegular)?;
            [response.solution, load.solution]
        };
        let rows: Vec<usize> = order.iter().flat_map(|&(first, block)| first..first + sizes[block]).collect();
        let blocks: Vec<usize> = order.iter().map(|(_, block)| *block).collect();
        let [response, load] = [selected(&response, &rows, &blocks), selected(&load, &rows, &[0])];
        let contacts = sizes.iter().filter(|&&size| size == 1).count();
        let no_jumps = IntervalMatrix::exact(DMatrix::zeros(size, contacts));
        let problem = BlockProblem::within_bounds(BySide::same(response), BySide::same(no_jumps), load)?;
        Ok(Self { a, b, right_hand_side, order, problem })
    }

    /// The block mode problem with the same solutions, blocks of one first; within bounds unless `A` is the identity.
    pub fn problem(&self) -> &BlockProblem {
        &self.problem
    }

    /// The number `n` of components.
    pub(super) fn size(&self) -> usize {
        self.right_hand_side.len()
    }

    /// Blocks of one as pairs of a component and the value, blocks of two as pairs of their first component and the
    /// vector: `x` in the order of the equation.
    pub(super) fn unknowns(&self, forces: &[f64], reactions: &[[f64; 2]]) -> Vec<f64> {
        let mut x = vec![0.0; self.size()];
        for (&(first, _), &force) in self.order.iter().zip(forces) {
            x[first] = force;
        }
        for (&(first, _), reaction) in self.order[forces.len()..].iter().zip(reactions) {
            x[first..first + 2].copy_from_slice(reaction);
        }
        x
    }

    /// The residual of a solution with these lengths of blocks in the order of [`BlockProblem`], relative to the
    /// largest sum of sizes of terms in an equation; `None` if numbers overflow or underflow.
    pub(super) fn residual(&self, x: &[f64], lengths: &[f64]) -> Option<f64> {
        let x = DVector::from_column_slice(x);
        let mut of_blocks = DVector::zeros(self.order.len());
        for (&(_, block), &length) in self.order.iter().zip(lengths) {
            of_blocks[block] = length;
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

/// These rows and columns.
fn selected(matrix: &IntervalMatrix, rows: &[usize], columns: &[usize]) -> IntervalMatrix {
    let of = |part: &DMatrix<f64>| part.select_rows(rows).select_columns(columns);
    IntervalMatrix::around(of(matrix.centre()), of(matrix.radius()))
        .expect("parts of an interval matrix are one")
}

fn check(part: ProblemPart, matrix: &DMatrix<f64>, expected: (usize, usize)) -> Result<(), ModeProblemError> {
    if matrix.shape() != expected {
        return Err(ModeProblemError::Shape { part, expected, found: matrix.shape() });
    }
    match matrix.iter().position(|value| !value.is_finite()) {
        Some(at) => {
            let (row, column) = (at % expected.0, at / expected.0);
            Err(ModeProblemError::NotFinite { part, row, column, value: matrix[at] })
        }
        None => Ok(()),
    }
}
