//! Unknowns between bounds: the mode problem of a mixed complementarity problem.
//!
//! `w = M z + q`, `l <= z <= u`, `w_k >= 0` where `z_k < u_k`, and `w_k <= 0` where `z_k > l_k` (Dirkse and
//! Ferris, Optimization Methods and Software 5 (1995); a bound may be infinite). With `y >= 0`:
//!
//! | bounds | unknowns |
//! |---|---|
//! | only `l_k` | `z_k = l_k + y+`, `w_k = y-` |
//! | only `u_k` | `z_k = u_k - y+`, `w_k = -y-` |
//! | both | `z_k = l_k + y+`, `w_k = y- - y'-`, `y'+ = u_k - z_k`, where `y'` is a second pair |
//! | none | `z_k = y+ - y-`, `w_k = 0` |
//! | `l_k = u_k` | `z_k = l_k`, `w_k = y+ - y-` |
//!
//! Of both bounds, `y+ = 0` excludes `y'+ = 0`, so that `y'- = 0` there, and conversely.
//!
//! Nothing is rounded. The constants of the rows, `q + M s` (`s_k`: the bound from which `z_k` is counted) and
//! `u - l`, are used if they are floating-point numbers. Otherwise each `|s_k|` becomes an unknown of its own,
//! with the row `t_k = |s_k|`, and enters the others through its column, which is that of `z_k`.

use nalgebra::{DMatrix, DVector};

use super::correspondence::Role;
use crate::error_free::{product_remainder, sum_remainder};
use crate::problem::{ModeProblem, ModeProblemError};

/// Below this size, the error of a product may not be a floating-point number.
const SMALLEST_PRODUCT: f64 = 1e-250;

/// The bounds of all unknowns.
pub(super) struct Bounds {
    lower: DVector<f64>,
    upper: DVector<f64>,
}

/// The rows and columns of the mode problem. The first `n` belong to the unknowns `z`.
struct Layout {
    /// Unknowns that have a second pair.
    boxed: Vec<usize>,
    /// Unknowns whose bound has a column of its own.
    shifted: Vec<usize>,
    right_hand_side: DVector<f64>,
}

impl Bounds {
    pub(super) fn new(lower: &DVector<f64>, upper: &DVector<f64>) -> Self {
        Self { lower: lower.clone(), upper: upper.clone() }
    }

    /// No bounds for the first `free` unknowns, and zero as the lower bound of the others.
    pub(super) fn of_free(free: usize, size: usize) -> Self {
        let lower = |at: usize, _| if at < free { f64::NEG_INFINITY } else { 0.0 };
        Self { lower: DVector::from_fn(size, lower), upper: DVector::from_element(size, f64::INFINITY) }
    }

    /// Bounds with the same determinants: zero as the lower bound of every unknown that has any bound. For
    /// every `q` there is exactly one solution if the determinants of all patterns have the same sign (Robinson,
    /// Mathematics of Operations Research 17 (1992)), and the patterns of a box, each unknown at a bound
    /// or between, have the same determinants.
    pub(super) fn at_zero(&self) -> Self {
        let fixed = |at: usize| self.lower[at] == self.upper[at];
        let free = |at: usize| self.lower[at].is_infinite() && self.upper[at].is_infinite();
        let lower = |at: usize, _| if free(at) { f64::NEG_INFINITY } else { 0.0 };
        let upper = |at: usize, _| if fixed(at) { 0.0 } else { f64::INFINITY };
        let size = self.lower.len();
        Self { lower: DVector::from_fn(size, lower), upper: DVector::from_fn(size, upper) }
    }

    /// The bound from which an unknown is counted; zero without one.
    fn start(&self, at: usize) -> f64 {
        let bounds = [self.lower[at], self.upper[at]];
        bounds.into_iter().find(|bound| bound.is_finite()).unwrap_or(0.0)
    }

    fn role(&self, at: usize) -> Role {
        match (self.lower[at], self.upper[at]) {
            (lower, upper) if lower == upper => Role::Fixed(at, lower),
            (lower, _) if lower.is_finite() => Role::Above(at, lower),
            (_, upper) if upper.is_finite() => Role::Below(at, upper),
            _ => Role::Free(at),
        }
    }

    fn boxed(&self) -> Vec<usize> {
        let is_boxed = |at: &usize| {
            let (lower, upper) = (self.lower[*at], self.upper[*at]);
            lower.is_finite() && upper.is_finite() && lower < upper
        };
        (0..self.lower.len()).filter(is_boxed).collect()
    }

    /// Returns the roles of the unknowns of the mode problem.
    pub(super) fn roles(&self, m: &DMatrix<f64>, q: &DVector<f64>) -> Vec<Role> {
        let Layout { boxed, shifted, .. } = self.layout(m, q);
        let own = (0..q.len()).map(|at| self.role(at));
        let ceilings = boxed.into_iter().map(|at| Role::Ceiling(at, self.upper[at]));
        own.chain(ceilings)
            .chain(shifted.into_iter().map(|at| Role::Constant(self.start(at).abs())))
            .collect()
    }

    /// The number of unknowns of the mode problem.
    #[cfg(any(feature = "json", feature = "npz"))]
    pub(super) fn unknowns(&self, m: &DMatrix<f64>, q: &DVector<f64>) -> usize {
        self.layout(m, q).right_hand_side.len()
    }

    fn layout(&self, m: &DMatrix<f64>, q: &DVector<f64>) -> Layout {
        let boxed = self.boxed();
        // q + M s and u - l
        let row = |at: usize| exact_sum(q[at], (0..q.len()).map(|k| (m[(at, k)], self.start(k))));
        let width = |at: &usize| exact_sum(self.upper[*at], [(-1.0, self.lower[*at])]);
        if let Some(entries) =
            (0..q.len()).map(row).chain(boxed.iter().map(width)).collect::<Option<Vec<f64>>>()
        {
            return Layout { boxed, shifted: Vec::new(), right_hand_side: DVector::from_vec(entries) };
        }
        let shifted: Vec<usize> = (0..q.len()).filter(|&at| self.start(at) != 0.0).collect();
        let entries = q.iter().copied();
        let entries = entries.chain(boxed.iter().map(|&at| self.upper[at]));
        let entries = entries.chain(shifted.iter().map(|&at| self.start(at).abs()));
        Layout {
            right_hand_side: DVector::from_iterator(q.len() + boxed.len() + shifted.len(), entries),
            boxed,
            shifted,
        }
    }

    /// The mode problem with the solutions of `w = M z + q` within the bounds.
    ///
    /// # Errors
    /// If shapes do not match or an entry is not finite.
    pub(super) fn mode_problem(
        &self,
        m: &DMatrix<f64>,
        q: &DVector<f64>,
    ) -> Result<ModeProblem, ModeProblemError> {
        let Layout { boxed, shifted, right_hand_side } = self.layout(m, q);
        let (n, size) = (q.len(), right_hand_side.len());
        let ceiling = |at: usize| boxed.binary_search(&at).ok().map(|place| n + place);
        let (mut positive, mut negative) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
        // w_i - sum_k M_ik z_k = q_i, and z_k + y'+ = u_k with a second pair: the column of z_k.
        let column = |matrix: &mut DMatrix<f64>, place: usize, at: usize, sign: f64| {
            (0..n).for_each(|row| matrix[(row, place)] = -sign * m[(row, at)]);
            ceiling(at).into_iter().for_each(|row| matrix[(row, place)] = sign);
        };
        for at in 0..n {
            match self.role(at) {
                Role::Below(..) => {
                    column(&mut positive, at, at, -1.0);
                    negative[(at, at)] = -1.0;
                }
                Role::Free(_) => {
                    column(&mut positive, at, at, 1.0);
                    column(&mut negative, at, at, -1.0);
                }
                Role::Fixed(..) => {
                    positive[(at, at)] = 1.0;
                    negative[(at, at)] = -1.0;
                }
                _ => {
                    column(&mut positive, at, at, 1.0);
                    negative[(at, at)] = 1.0;
                }
            }
        }
        for (place, &at) in (n..).zip(&boxed) {
            positive[(place, place)] = 1.0;
            negative[(at, place)] = -1.0;
        }
        for (place, &at) in (n + boxed.len()..).zip(&shifted) {
            for (matrix, sign) in [(&mut positive, 1.0), (&mut negative, -1.0)] {
                column(matrix, place, at, sign * self.start(at).signum());
                matrix[(place, place)] = sign;
            }
        }
        let none = DMatrix::zeros(size, size);
        ModeProblem::new(positive, negative, none.clone(), none, right_hand_side)
    }
}

/// `start + sum of products`, if no step of this sum is rounded.
fn exact_sum(start: f64, products: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    products.into_iter().filter(|(one, other)| *one != 0.0 && *other != 0.0).try_fold(
        start,
        |sum, (one, other)| {
            let product = one * other;
            let is_exact = product.is_finite()
                && product.abs() >= SMALLEST_PRODUCT
                && product_remainder(one, other, product) == 0.0;
            let next = sum + product;
            (is_exact && next.is_finite() && sum_remainder(sum, product, next) == 0.0).then_some(next)
        },
    )
}
