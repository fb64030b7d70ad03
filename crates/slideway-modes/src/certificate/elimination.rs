//! The equations of a pattern, in integers.

use dashu_int::IBig;
use dashu_ratio::RBig;
use nalgebra::DMatrix;

use super::cramer::{self, Cramer};
use crate::interval::Sign;
use crate::problem::{ContactState, ModeProblem, ProblemView};

/// Equations `A z = b` as integers, row by row `[A | b]`. Rows are scaled by powers of two.
pub(super) struct IntegerSystem {
    rows: Vec<Vec<IBig>>,
    unknowns: usize,
}

impl IntegerSystem {
    /// The equations of one pattern, without rounding.
    pub(super) fn new(problem: &ModeProblem, pattern: &[ContactState]) -> Self {
        let all: Vec<usize> = (0..pattern.len()).collect();
        Self::of(problem, pattern, &all, &all)
    }

    /// Some of the equations, with some of the unknowns.
    pub(super) fn of(
        problem: &ModeProblem,
        pattern: &[ContactState],
        rows: &[usize],
        columns: &[usize],
    ) -> Self {
        let view = ProblemView::from(problem);
        let row = |&row: &usize| {
            let mut all = dyadic_row(view, pattern, row);
            let own = columns.iter().copied().chain([pattern.len()]);
            integers_of_row(&own.map(|at| std::mem::take(&mut all[at])).collect::<Vec<_>>()).0
        };
        Self { rows: rows.iter().map(row).collect(), unknowns: columns.len() }
    }

    /// The equations `A X = R`: the columns of `R` stand behind those of `A`.
    pub(super) fn of_matrices(matrix: &DMatrix<f64>, right: &DMatrix<f64>) -> Self {
        let row = |row: usize| {
            let [left, right] = [matrix, right].map(|part| part.row(row));
            integers_of_row(&left.iter().chain(&right).map(|&entry| vec![entry]).collect::<Vec<_>>()).0
        };
        Self { rows: (0..matrix.nrows()).map(row).collect(), unknowns: matrix.ncols() }
    }

    /// The columns of `A`, and `b`.
    pub(super) fn columns(&self) -> (Vec<Vec<IBig>>, Vec<IBig>) {
        let column = |at: usize| self.rows.iter().map(|row| row[at].clone()).collect();
        ((0..self.unknowns).map(column).collect(), column(self.unknowns))
    }

    /// The solution of the equations; `None` if the columns are dependent, or once `proceed` is `false`.
    pub(super) fn solve_while(&self, proceed: &mut dyn FnMut() -> bool) -> Option<Cramer> {
        cramer::solve(&self.rows, self.unknowns, proceed)
    }

    /// [`solve_while`](Self::solve_while) without interruption.
    pub(super) fn solve(&self) -> Option<Cramer> {
        self.solve_while(&mut || true)
    }
}

impl Cramer {
    /// The sign of the determinant.
    pub(super) fn determinant_sign(&self) -> Sign {
        sign_of(&self.determinant)
    }

    /// The unknowns of each right-hand side as reduced fractions.
    pub(super) fn fractions(self) -> Vec<Vec<RBig>> {
        let Self { determinant, numerators } = self;
        let fraction = |numerator: IBig| ratio(numerator, &determinant);
        numerators.into_iter().map(|side| side.into_iter().map(fraction).collect()).collect()
    }
}

pub(super) fn ratio(numerator: IBig, denominator: &IBig) -> RBig {
    RBig::from_parts_signed(numerator, denominator.clone())
}

pub(super) fn sign_of(value: &IBig) -> Sign {
    if value.is_zero() {
        Sign::Zero
    } else if *value > IBig::ZERO {
        Sign::Positive
    } else {
        Sign::Negative
    }
}

/// Every entry of a row as a sum of plain numbers, with the right-hand side last.
fn dyadic_row(view: ProblemView<'_>, pattern: &[ContactState], row: usize) -> Vec<Vec<f64>> {
    let mut entries: Vec<Vec<f64>> = pattern
        .iter()
        .enumerate()
        .map(|(contact, &state)| {
            view.matrix_terms(contact, state).map(|(term, sign)| sign * term.centre[row]).collect()
        })
        .collect();
    let jumps = pattern
        .iter()
        .enumerate()
        .map(|(contact, &state)| view.jump(contact, ProblemView::constant_jump_side(state)).centre[row]);
    entries.push(std::iter::once(view.load().centre[row]).chain(jumps).collect());
    entries
}

/// The row multiplied by the power of two that makes all its numbers integers without a common factor 2, and
/// the exponent of that power.
pub(super) fn integers_of_row(entries: &[Vec<f64>]) -> (Vec<IBig>, i32) {
    let terms = entries.iter().flatten().filter(|term| **term != 0.0);
    let smallest = terms.map(|&term| mantissa_and_exponent(term).1).min().unwrap_or(0);
    let integer = |&term: &f64| {
        let (mantissa, exponent) = mantissa_and_exponent(term);
        // Zero has the exponent 0, which may be below the smallest one.
        IBig::from(mantissa) << usize::try_from(exponent - smallest).unwrap_or(0)
    };
    (entries.iter().map(|terms| terms.iter().map(integer).sum()).collect(), -smallest)
}

/// `value = mantissa 2^exponent` with an odd mantissa; both 0 for zero.
pub(crate) fn mantissa_and_exponent(value: f64) -> (i64, i32) {
    if value == 0.0 {
        return (0, 0);
    }
    let bits = value.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)).cast_signed();
    let (size, exponent) = if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    let zeros = size.trailing_zeros();
    let mantissa = size >> zeros;
    (if value < 0.0 { -mantissa } else { mantissa }, exponent + zeros.cast_signed())
}
