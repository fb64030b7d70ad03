//! The mode problem of a bimatrix game.
//!
//! Mixed strategies `x` (of `m` rows) and `y` (of `n` columns) are an equilibrium with the payoffs `v` and `v'`
//! if every pure strategy that is played is a best response (Nash, 1951; as a complementarity problem: Lemke and Howson, 1964):
//!
//! ```text
//! r = v - A y >= 0,     x >= 0,   x_i r_i = 0,   sum x = 1
//! s = v' - B^T x >= 0,  y >= 0,   y_j s_j = 0,   sum y = 1
//! ```
//!
//! The usual linear complementarity problem has strategies that are not normalised, positive payoffs and the
//! artificial solution zero; this system has neither. In an equilibrium `v` is a mean of entries of `A`:
//! with a number `c` below all entries, `p = v - c > 0` is an unknown that never changes its sign, and
//! `r_i - p + (A y)_i = c` has no rounded coefficient.

use nalgebra::{DMatrix, DVector};

use super::correspondence::Role;
use crate::problem::{ModeProblem, ModeProblemError};

/// The mode problem with the unknowns `x - r`, `y - s`, `p` and `p'`.
///
/// # Errors
/// If shapes do not match or an entry is not finite.
pub(super) fn mode_problem(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Result<ModeProblem, ModeProblemError> {
    let (m, n) = a.shape();
    let size = m + n + 2;
    let (mut positive, mut negative) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
    // Rows: r_i - p + (A y)_i = c, s_j - p' + (B^T x)_j = c', sum y = 1, sum x = 1.
    for (row, column) in (0..m).flat_map(|row| (0..n).map(move |column| (row, column))) {
        positive[(row, m + column)] = a[(row, column)];
        positive[(m + column, row)] = b[(row, column)];
    }
    for at in 0..m + n {
        let (payoff, sum) = if at < m { (m + n, m + n + 1) } else { (m + n + 1, m + n) };
        positive[(sum, at)] = 1.0;
        negative[(at, at)] = 1.0;
        positive[(at, payoff)] = -1.0;
        negative[(at, payoff)] = 1.0;
    }
    let entry = |at: usize, _| match at {
        at if at < m => below(a),
        at if at < m + n => below(b),
        _ => 1.0,
    };
    let none = DMatrix::zeros(size, size);
    ModeProblem::new(positive, negative, none.clone(), none, DVector::from_fn(size, entry))
}

/// Returns the roles of the unknowns of the mode problem.
pub(super) fn roles(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Vec<Role> {
    let strategies = (0..a.nrows() + a.ncols()).map(|at| Role::Above(at, 0.0));
    strategies.chain([Role::Payoff(0, below(a)), Role::Payoff(1, below(b))]).collect()
}

/// A number below all payoffs, of their size.
fn below(payoffs: &DMatrix<f64>) -> f64 {
    let size = payoffs.amax();
    let least = payoffs.min() - if size == 0.0 { 1.0 } else { size };
    // Payoffs as large as floating-point numbers can be: `p` is zero where the least of all is paid.
    least.max(f64::MIN)
}
