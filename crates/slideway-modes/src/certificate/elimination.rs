//! Fraction-free elimination of a pattern's equations, in integers.

use dashu_int::IBig;
use dashu_ratio::RBig;
use nalgebra::DMatrix;

use crate::interval::Sign;
use crate::problem::{ContactState, ModeProblem, ProblemView};

/// Equations `A z = b` as integers, row by row `[A | b]`. Rows are scaled by powers of two.
pub(super) struct IntegerSystem {
    rows: Vec<Vec<IBig>>,
    unknowns: usize,
}

/// The system after elimination: the first `pivots.len()` rows are independent, row `i` has its first nonzero
/// entry in column `pivots[i]`, and the others are zero except for the right-hand side.
pub(super) struct Echelon {
    rows: Vec<Vec<IBig>>,
    unknowns: usize,
    pivots: Vec<usize>,
    swaps_are_odd: bool,
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

    /// [`eliminate_while`](Self::eliminate_while) without interruption.
    pub(super) fn eliminate(self) -> Echelon {
        let Some(echelon) = self.eliminate_while(&mut || true) else { unreachable!("nothing stops it") };
        echelon
    }

    /// Bareiss's elimination: after each step, all entries are minors of the original matrix, so division by
    /// the previous pivot leaves no remainder. `None` once `proceed` is `false`.
    pub(super) fn eliminate_while(self, proceed: &mut dyn FnMut() -> bool) -> Option<Echelon> {
        let Self { mut rows, unknowns } = self;
        let equations = rows.len();
        let mut pivots = Vec::new();
        let mut swaps_are_odd = false;
        let mut previous = IBig::ONE;
        for column in 0..unknowns {
            let rank = pivots.len();
            let Some(found) = (rank..equations)
                .filter(|&row| !rows[row][column].is_zero())
                .min_by_key(|&row| bit_length(&rows[row][column]))
            else {
                continue;
            };
            if found != rank {
                rows.swap(found, rank);
                swaps_are_odd = !swaps_are_odd;
            }
            let (above, below) = rows.split_at_mut(rank + 1);
            let pivot_row = &above[rank];
            for row in below {
                if !proceed() {
                    return None;
                }
                eliminate_row(row, pivot_row, column, &previous);
            }
            previous.clone_from(&pivot_row[column]);
            pivots.push(column);
        }
        Some(Echelon { rows, unknowns, pivots, swaps_are_odd })
    }
}

fn eliminate_row(row: &mut [IBig], pivot_row: &[IBig], column: usize, previous: &IBig) {
    let pivot = &pivot_row[column];
    let factor = std::mem::take(&mut row[column]);
    for (entry, eliminated) in row[column + 1..].iter_mut().zip(&pivot_row[column + 1..]) {
        let kept = &*entry * pivot;
        let minor = if factor.is_zero() || eliminated.is_zero() { kept } else { kept - &factor * eliminated };
        *entry = if previous.is_one() || minor.is_zero() { minor } else { minor / previous };
    }
}

impl Echelon {
    /// Whether no two solutions differ.
    pub(super) fn is_regular(&self) -> bool {
        self.pivots.len() == self.unknowns
    }

    /// The sign of the determinant, with as many equations as unknowns.
    pub(super) fn determinant_sign(&self) -> Sign {
        if !self.is_regular() {
            return Sign::Zero;
        }
        let Some(last) = self.rows.last() else { return Sign::Positive };
        let sign = sign_of(&last[self.rows.len() - 1]);
        if self.swaps_are_odd { -sign } else { sign }
    }

    /// The values of the pivot columns' unknowns, in the order of [`pivots`](Self::pivots), that solve the
    /// independent equations with column `column` as right-hand side (`b` is the column after the last
    /// unknown), as numerators over the last pivot.
    ///
    /// By Cramer's rule the numerators are integers, so no fraction has to be reduced.
    pub(super) fn solve(&self, column: usize) -> (Vec<IBig>, IBig) {
        let rank = self.pivots.len();
        let denominator = self.pivots.last().map_or(IBig::ONE, |&last| self.rows[rank - 1][last].clone());
        let mut numerators = vec![IBig::ZERO; rank];
        for index in (0..rank).rev() {
            let row = &self.rows[index];
            let mut sum = &row[column] * &denominator;
            for later in index + 1..rank {
                sum -= &row[self.pivots[later]] * &numerators[later];
            }
            numerators[index] = sum / &row[self.pivots[index]];
        }
        (numerators, denominator)
    }

    /// [`solve`](Self::solve) as reduced fractions.
    pub(super) fn solve_reduced(&self, column: usize) -> Vec<RBig> {
        let (numerators, denominator) = self.solve(column);
        numerators.into_iter().map(|numerator| ratio(numerator, &denominator)).collect()
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

fn bit_length(value: &IBig) -> usize {
    use dashu_int::ops::BitTest;
    value.bit_len()
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
    let parts: Vec<Vec<(i64, i32)>> =
        entries.iter().map(|terms| terms.iter().map(|&term| mantissa_and_exponent(term)).collect()).collect();
    let exponents =
        parts.iter().flatten().filter(|(mantissa, _)| *mantissa != 0).map(|&(_, exponent)| exponent);
    let smallest = exponents.min().unwrap_or(0);
    let integer = |&(mantissa, exponent): &(i64, i32)| {
        // Zero has the exponent 0, which may be below the smallest one.
        let shift = usize::try_from(exponent - smallest).unwrap_or(0);
        IBig::from(mantissa) << shift
    };
    (parts.iter().map(|terms| terms.iter().map(integer).sum()).collect(), -smallest)
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
