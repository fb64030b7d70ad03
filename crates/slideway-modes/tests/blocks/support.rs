//! Problems for tests, and what every answer must satisfy.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};
use slideway_modes::blocks::{BlockProblem, BlockResult, BlockSolution, search_turned};
use slideway_modes::certificate::Sign;
use slideway_modes::{BySide, Proof, SearchOptions};

/// Numbers from -1 to 1.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn vector(&mut self, rows: usize) -> DVector<f64> {
        DVector::from_fn(rows, |_, _| self.next())
    }

    pub(crate) fn matrix(&mut self, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |_, _| self.next())
    }
}

/// A problem as plain numbers.
#[derive(Debug, Clone)]
pub(crate) struct Plain {
    pub(crate) contacts: usize,
    pub(crate) positive: DMatrix<f64>,
    pub(crate) negative: DMatrix<f64>,
    pub(crate) load: DVector<f64>,
}

impl Plain {
    /// The same columns on both sides.
    pub(crate) fn same(contacts: usize, response: DMatrix<f64>, load: DVector<f64>) -> Self {
        Self { contacts, negative: response.clone(), positive: response, load }
    }

    /// Random columns of this size, of contacts with two versions.
    pub(crate) fn random(numbers: &mut Numbers, contacts: usize, hinges: usize, size: f64) -> Self {
        let (rows, columns) = (contacts + 2 * hinges, contacts + hinges);
        let positive = numbers.matrix(rows, columns) * size;
        let mut negative = positive.clone();
        for contact in 0..contacts {
            for row in 0..rows {
                negative[(row, contact)] += 0.2 * size * numbers.next();
            }
        }
        Self { contacts, positive, negative, load: numbers.vector(rows) }
    }

    /// Random columns, whose own blocks oppose the load: problems with many solutions.
    pub(crate) fn opposed(numbers: &mut Numbers, contacts: usize, hinges: usize) -> Self {
        let mut plain = Self::random(numbers, contacts, hinges, 0.12);
        for block in 0..contacts + hinges {
            let rows = if block < contacts {
                block..block + 1
            } else {
                2 * block - contacts..2 * block - contacts + 2
            };
            let length = plain.load.rows(rows.start, rows.len()).norm();
            let size = 1.3 + 0.3 * numbers.next();
            for row in rows {
                let opposed = -size * plain.load[row] / length;
                plain.positive[(row, block)] += opposed;
                plain.negative[(row, block)] += opposed;
            }
        }
        plain
    }

    pub(crate) fn hinges(&self) -> usize {
        self.positive.ncols() - self.contacts
    }

    pub(crate) fn problem(&self) -> BlockProblem {
        let jumps = DMatrix::zeros(self.load.len(), self.contacts);
        let response = BySide { positive: self.positive.clone(), negative: self.negative.clone() };
        BlockProblem::new(response, BySide::same(jumps), self.load.clone()).unwrap()
    }

    pub(crate) fn solve(&self) -> BlockResult {
        self.solve_turned(0.0)
    }

    /// The answer for another first division of directions.
    pub(crate) fn solve_turned(&self, angle: f64) -> BlockResult {
        let problem = self.problem();
        let options = SearchOptions::default();
        let result = search_turned(&problem, &options, &mut |_| ControlFlow::Continue(()), angle);
        result.solutions.iter().for_each(|solution| self.check(solution));
        result
    }

    /// The column of a block at `x`.
    pub(crate) fn column(&self, block: usize, x: &DVector<f64>) -> DVector<f64> {
        let negative = block < self.contacts && x[block] < 0.0;
        if negative {
            self.negative.column(block).into_owned()
        } else {
            self.positive.column(block).into_owned()
        }
    }

    pub(crate) fn lengths(&self, x: &DVector<f64>) -> Vec<f64> {
        let s = self.contacts;
        let hinge = |at: usize| x[s + 2 * at].hypot(x[s + 2 * at + 1]);
        (0..s).map(|at| x[at].abs()).chain((0..self.hinges()).map(hinge)).collect()
    }

    /// `x - b - H |x|`.
    pub(crate) fn residual(&self, x: &DVector<f64>) -> DVector<f64> {
        let lengths = self.lengths(x);
        let start = x - &self.load;
        (0..lengths.len()).fold(start, |rest, block| rest - self.column(block, x) * lengths[block])
    }

    /// `I - H D` at `x`.
    pub(crate) fn jacobian(&self, x: &DVector<f64>) -> DMatrix<f64> {
        let lengths = self.lengths(x);
        let mut matrix = DMatrix::identity(x.len(), x.len());
        for (block, length) in lengths.into_iter().enumerate() {
            let column = self.column(block, x);
            let s = self.contacts;
            let rows = if block < s { block..block + 1 } else { 2 * block - s..2 * block - s + 2 };
            for row in rows {
                let slope = if length > 0.0 { x[row] / length } else { 0.0 };
                matrix.column_mut(row).axpy(-slope, &column, 1.0);
            }
        }
        matrix
    }

    /// A solution satisfies the equations, and has the orientation that the determinant at it has.
    fn check(&self, solution: &BlockSolution) {
        let x = unknowns(solution);
        let size = x.amax().max(1e-300);
        let within =
            self.residual(&x).amax() <= 1e-12 * size * (1.0 + self.positive.amax() + self.negative.amax());
        assert!(within, "{:?}: {}", solution, self.residual(&x).amax());
        assert!(solution.enclosure.iter().zip(&x).all(|(bound, value)| bound.contains(*value)));
        let certain = solution.on_boundary.is_empty() && solution.unloaded.is_empty();
        if let Some(sign) = solution.orientation.filter(|_| certain) {
            let determinant = self.jacobian(&x).determinant();
            assert_eq!(sign == Sign::Positive, determinant > 0.0, "{determinant}");
        }
    }
}

/// `x` of a solution, row by row.
pub(crate) fn unknowns(solution: &BlockSolution) -> DVector<f64> {
    let values = solution.forces.iter().chain(solution.reactions.as_flattened()).copied();
    DVector::from_vec(values.collect())
}

/// The sum of the orientations.
pub(crate) fn degree(result: &BlockResult) -> i32 {
    let orientation = |solution: &BlockSolution| match solution.orientation.unwrap() {
        Sign::Positive => 1,
        _ => -1,
    };
    result.solutions.iter().map(orientation).sum()
}

/// The answer is complete and proven.
pub(crate) fn assert_proven(result: &BlockResult) {
    assert!(result.open.is_empty(), "{:?}", result.open);
    assert_eq!(result.complete, Proof::Proven);
}

/// Both answers hold the same solutions.
pub(crate) fn assert_same(one: &BlockResult, other: &BlockResult) {
    assert_eq!(one.solutions.len(), other.solutions.len());
    for solution in &one.solutions {
        let x = unknowns(solution);
        let near = |other: &BlockSolution| (unknowns(other) - &x).amax() <= 1e-9 * x.amax();
        assert!(other.solutions.iter().any(near), "{solution:?} is missing");
    }
}
