//! Coupling through few quantities: `C = diagonal + low rank + remainder`.
//!
//! ```text
//! c_k^{sigma} = delta_k^{sigma} e_k + U v_k^{sigma} + E_k^{sigma},   U: r x q,   q <= 6
//! delta_i^{sigma_i} y_i = s_i(z) - epsilon_i,   s_i(z) = b_i - u_i . z,   z = sum_k v_k^{sigma_k} y_k
//! ```
//!
//! with `u_i` the rows of `U`, and `epsilon_i` the combined effect of the remainder and the bounds of the
//! right-hand side. `U`, `v` and `delta` are exactly the numbers stored here, so `z` is defined without
//! rounding; `E` is the remainder, bounded entry by entry. If `delta_i^+` and `delta_i^-` have opposite
//! signs, the side of every contact follows from the sign of `s_i(z) - epsilon_i` (theory, section 4 (e)).
//!
//! # Bounds of the errors
//! With `t = 1 / max(1, |z|)` and everything multiplied by `t`, no entry of `w = t z` exceeds 1, and
//!
//! ```text
//! t y_i <= (|b_i| + sum_j |u_ij| + t |epsilon_i|) / min |delta_i|
//! t |epsilon_i| <= radius(b_i) + sum_k |E_ik| t y_k
//! ```
//!
//! If the largest row sum of `|E_ik| / min |delta_i|` is at most 2/5, the largest `t y` is at most 5/3 of its
//! value without `E`; this bounds all `t |epsilon_i|`. For columns that are known within bounds, these are
//! added to `|E|`.

use nalgebra::{DMatrix, DVector};

use crate::problem::{ContactState, ScaledProblem, power_of_two_above};

/// The highest rank that is considered.
pub(super) const LARGEST_RANK: usize = 6;
/// Entries below this fraction of the largest entry count as zero.
const ZERO: f64 = 1e-11;
/// The decomposition must hold to this fraction of the largest entry.
const ACCURACY: f64 = 1e-10;
/// Rounding error of a sum of `LARGEST_RANK + 2` products, relative to its terms, with a wide margin.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The decomposition of both versions of the columns; `[positive, negative]`.
#[derive(Debug, Clone)]
pub(super) struct LowRank {
    /// `U` (r x q), scaled so that `u_i . z` and `b_i` have the same size where `|z|` is about 1.
    pub(super) left: DMatrix<f64>,
    /// `v_k` as columns (q x r).
    pub(super) right: [DMatrix<f64>; 2],
    /// `delta` (r).
    pub(super) diagonal: [DVector<f64>; 2],
    /// `b` (r).
    pub(super) load: DVector<f64>,
    /// Bounds on `|epsilon_i| / max(1, |z|)` (r).
    pub(super) error: DVector<f64>,
}

impl LowRank {
    /// The decomposition of a problem without jumps, for all right-hand sides within `load_error`, if its
    /// coupling has a rank from 1 to 6 and the sides follow from the signs of `s_i`.
    pub(super) fn of(problem: &ScaledProblem, load_error: &DVector<f64>) -> Option<Self> {
        if problem.has_jump.iter().any(|&jump| jump) {
            return None;
        }
        let contacts = problem.contacts();
        let columns = ContactState::PRESSED.map(|state| {
            let columns: Vec<_> = (0..contacts).map(|contact| problem.column(contact, state)).collect();
            DMatrix::from_columns(&columns)
        });
        let size = columns.iter().fold(0.0, |most: f64, matrix| most.max(off_diagonal_size(matrix)));
        let pivots = pivot_columns(&columns, ZERO * size)?;
        let mut left = left_factor(&columns, &pivots)?;
        let mut right = [right_factor(&columns[0], &left)?, right_factor(&columns[1], &left)?];
        let unit = unit_of_coordinates(&left, problem.base());
        left *= unit;
        right = right.map(|right| right / unit);
        let diagonal = [0, 1].map(|side| {
            DVector::from_fn(contacts, |k, _| {
                columns[side][(k, k)] - left.row(k).dot(&right[side].column(k).transpose())
            })
        });
        let holds = [0, 1]
            .into_iter()
            .all(|side| off_diagonal_size(&(&columns[side] - &left * &right[side])) <= ACCURACY * size);
        let decides = |(up, down): (&f64, &f64)| up * down < 0.0 && up.abs().min(down.abs()) > 1e-6;
        let decided = diagonal[0].iter().zip(&diagonal[1]).all(decides);
        let load = problem.base().clone();
        let mut found = Self { left, right, diagonal, load, error: load_error.clone() };
        let remainder = found.remainder(&columns, problem.column_radii());
        found.error = found.bound_errors(&remainder, load_error).filter(|_| holds && decided)?;
        Some(found)
    }

    pub(super) fn rank(&self) -> usize {
        self.left.ncols()
    }

    /// The index of the side (0 positive, 1 negative) of a contact for which `s` is positive or not.
    pub(super) fn side(&self, contact: usize, positive: bool) -> usize {
        usize::from((self.diagonal[0][contact] > 0.0) != positive)
    }

    /// Bounds on all `|epsilon_i| / max(1, |z|)`; `None` if the remainder is too large.
    fn bound_errors(&self, remainder: &DMatrix<f64>, load_error: &DVector<f64>) -> Option<DVector<f64>> {
        let contacts = self.load.len();
        let least = self.diagonal[0].abs().inf(&self.diagonal[1].abs());
        let without = DVector::from_fn(contacts, |i, _| {
            (self.load[i].abs() + self.left.row(i).abs().sum() + load_error[i]) / least[i]
        });
        let gain = remainder.column_sum().component_div(&least).amax();
        // The factor 2.5 instead of 5/3 covers the rounding errors here.
        let largest = 2.5 * without.amax();
        let error = (load_error + remainder.column_sum() * largest) * (1.0 + contacts as f64 * ROUNDING);
        (gain <= 0.4 && error.iter().all(|value| value.is_finite())).then_some(error)
    }

    /// Bounds on `|E|` for both sides, where columns have an error up to a radius.
    fn remainder(&self, columns: &[DMatrix<f64>; 2], radii: Option<&[DMatrix<f64>; 2]>) -> DMatrix<f64> {
        let [positive, negative] = [0, 1].map(|side| {
            let diagonal = DMatrix::from_diagonal(&self.diagonal[side]);
            let left_over = (&columns[side] - &diagonal - &self.left * &self.right[side]).abs();
            let terms = columns[side].abs() + diagonal.abs() + self.left.abs() * self.right[side].abs();
            let rounded = (left_over + terms * ROUNDING).map(|value| value + f64::MIN_POSITIVE);
            radii.map_or_else(|| rounded.clone(), |radii| &rounded + &radii[side])
        });
        positive.sup(&negative)
    }
}

/// The power of two by which `U` is multiplied.
fn unit_of_coordinates(left: &DMatrix<f64>, load: &DVector<f64>) -> f64 {
    let size = left.abs().column_sum().amax();
    let unit = power_of_two_above(load.amax()) / power_of_two_above(size);
    unit.clamp((-100.0_f64).exp2(), 100.0_f64.exp2())
}

fn off_diagonal_size(matrix: &DMatrix<f64>) -> f64 {
    let mut size: f64 = 0.0;
    for column in 0..matrix.ncols() {
        for row in (0..matrix.nrows()).filter(|&row| row != column) {
            size = size.max(matrix[(row, column)].abs());
        }
    }
    size
}

/// Columns (contact and side) that span the coupling, by elimination with complete pivoting in a block
/// without diagonal entries: the rows of the first half of the contacts and the columns of the second half.
/// `None` if the rank is 0 or too high.
fn pivot_columns(columns: &[DMatrix<f64>; 2], zero: f64) -> Option<Vec<(usize, usize)>> {
    let contacts = columns[0].nrows();
    let half = contacts / 2;
    let later = contacts - half;
    let mut block =
        DMatrix::from_fn(half, 2 * later, |row, at| columns[at / later][(row, half + at % later)]);
    let mut pivots = Vec::new();
    while !block.is_empty() {
        let (row, at) = block.icamax_full();
        let pivot = block[(row, at)];
        if pivot.abs() <= zero {
            break;
        }
        if pivots.len() == LARGEST_RANK {
            return None;
        }
        pivots.push((half + at % later, at / later));
        let (pivot_row, pivot_column) = (block.row(row) / pivot, block.column(at).into_owned());
        block -= pivot_column * pivot_row;
    }
    if pivots.is_empty() { None } else { Some(pivots) }
}

/// `U`: the pivot columns, orthonormalized. Rows in which a pivot column has its diagonal entry are computed
/// from the other columns.
fn left_factor(columns: &[DMatrix<f64>; 2], pivots: &[(usize, usize)]) -> Option<DMatrix<f64>> {
    let contacts = columns[0].nrows();
    let missing: Vec<usize> = pivots.iter().map(|&(contact, _)| contact).collect();
    let known = DMatrix::from_fn(contacts, pivots.len(), |row, at| {
        if missing.contains(&row) { 0.0 } else { columns[pivots[at].1][(row, pivots[at].0)] }
    });
    let mut left = known.qr().q();
    // The v of all columns whose own row is known, and from them the missing rows by least squares.
    let others: Vec<usize> = (0..contacts).filter(|contact| !missing.contains(contact)).collect();
    let mut right = Vec::new();
    for matrix in columns {
        right.push(fitted(matrix, &left, &missing)?);
    }
    for &row in &missing {
        let (mut gram, mut moment) =
            (DMatrix::zeros(pivots.len(), pivots.len()), DVector::zeros(pivots.len()));
        for (side, matrix) in columns.iter().enumerate() {
            for &contact in &others {
                let v = right[side].column(contact);
                gram += v * v.transpose();
                moment += v * matrix[(row, contact)];
            }
        }
        left.set_row(row, &gram.lu().solve(&moment)?.transpose());
    }
    Some(left)
}

fn right_factor(matrix: &DMatrix<f64>, left: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    fitted(matrix, left, &[])
}

/// `v_k` of every column by least squares over all rows except its own and those left out.
fn fitted(matrix: &DMatrix<f64>, left: &DMatrix<f64>, left_out: &[usize]) -> Option<DMatrix<f64>> {
    let mut kept = left.clone();
    for &row in left_out {
        kept.row_mut(row).fill(0.0);
    }
    let gram = kept.transpose() * &kept;
    let moments = kept.transpose() * matrix;
    let mut right = DMatrix::zeros(left.ncols(), matrix.ncols());
    for column in 0..matrix.ncols() {
        let own = kept.row(column).transpose();
        let moment = moments.column(column) - &own * matrix[(column, column)];
        right.set_column(column, &(&gram - &own * own.transpose()).lu().solve(&moment)?);
    }
    Some(right)
}
