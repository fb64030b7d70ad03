//! Monotone problems: all solutions are those of one pattern.
//!
//! Without jumps the problem is `C y = b` with `C = [C^+ C^-]` and `y = (y^+, y^-) >= 0`, of which one of each
//! pair vanishes. It is *monotone* if
//!
//! ```text
//! q(u) = sum_k u_k^+ u_k^- >= 0  for all u with C u = 0.
//! ```
//!
//! For two solutions `y` and `y'` and `u = y - y'`, `q(u) = -sum (y_k^+ y'_k^- + y'_k^+ y_k^-) <= 0`; so both are
//! zero. Where an unknown is positive in one solution, its partner vanishes in all, and the mean of two
//! solutions is a solution. The solution with the most positive unknowns therefore belongs to a pattern that
//! has all solutions: they are one convex set (for `w = M z + q`, Cottle, Pang and Stone (1992), theorem
//! 3.1.7).
//!
//! **Test.** Let `A = (C^+ - C^-) / 2` be regular and `B = (C^+ + C^-) / 2`. On `C u = 0`, with
//! `N = u^+ - u^-` and `s = u^+ + u^-`, `N = -A^-1 B s`, so that `4 q = |s|^2 - |A^-1 B s|^2`: the problem is
//! monotone if no singular value of `A^-1 B` is above 1, that is, if
//!
//! ```text
//! S = A A^T - B B^T up to a factor 2 = -(C^+ C^-^T + C^- C^+^T)
//! ```
//!
//! has no negative eigenvalue (`M + M^T` for `w = M z + q`). If `A` were singular, `A^T l = 0` for some `l`, then
//! `0 <= l^T S l = -2 |B^T l|^2` up to that factor, so `C^+^T l = C^-^T l = 0`, and no pattern would be regular. `S` has no inverse in it,
//! and its entries are short.
//!
//! **All solutions.** `q(u) = 0` is the minimum of `q` on `C u = 0`: hence `(u^-, u^+) = C^T l` for some `l`, that
//! is, `u_k^+ = c_k^- . l`, `u_k^- = c_k^+ . l`, and `C u = 0` means `S l = 0`. Conversely such `u` have `q = 0`.
//! With one solution, the others are therefore all `y + u >= 0` with `S l = 0` in which the partners of its
//! positive unknowns vanish: a polyhedron.

use dashu_int::IBig;
use dashu_int::ops::BitTest;
use nalgebra::DMatrix;

use super::cell::{Cell, null_space_of_semidefinite};
use super::lifted::LiftedSystem;
use super::norm::is_positive_definite;
use crate::problem::{ContactState, ModeProblem};

/// A form that is not definite is examined exactly up to this size: a dense one of rank below its size takes about a
/// second.
const EXACT_SIZE: usize = 100;
/// `S` is computed if that takes up to so many products of entries: as many as of 100 contacts with dense columns.
const FORM_PRODUCTS: usize = 2_000_000;

/// Columns without jumps for which the problem is monotone, whatever its load, if a pattern is regular.
pub(crate) struct Monotone {
    contacts: usize,
    /// The changes `u` of `y^+`, then of `y^-`: one vector for each vector of a basis of `S l = 0`.
    changes: Vec<Vec<IBig>>,
}

impl Monotone {
    /// Proves that `S` has no negative eigenvalue; `None` if it has one, if that is too much work, or once `proceed` is
    /// `false`.
    pub(crate) fn prove(problem: &ModeProblem, proceed: &mut dyn FnMut() -> bool) -> Option<Self> {
        let system = LiftedSystem::new(problem.into());
        let (positive, negative) = system.columns().split_at(problem.contacts());
        let null_space = null_space(&symmetric_form(positive, negative, proceed)?, proceed)?;
        let change = |multipliers: &Vec<IBig>| {
            negative.iter().chain(positive).map(|column| scalar_product(column, multipliers)).collect()
        };
        let changes = null_space.iter().map(change).collect();
        Some(Self { contacts: problem.contacts(), changes })
    }

    /// A pattern that has all solutions of the problem, from one that is regular and has a solution, in which the
    /// unknowns of the contacts `zero` vanish; `None` once `proceed` is `false`.
    pub(crate) fn pattern_of_all_solutions(
        &self,
        known: &[ContactState],
        zero: &[usize],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<ContactState>> {
        let mut pattern = known.to_vec();
        if !zero.is_empty() && !self.changes.is_empty() {
            for contact in self.changing_sides(known, zero, proceed)? {
                pattern[contact] = partner(known[contact]);
            }
        }
        Some(pattern)
    }

    /// The contacts that have a positive unknown on the other side in some solution.
    ///
    /// Where `y_j > 0`, `y + t u` with small `t` does not leave the polyhedron of solutions, so that only the signs of the
    /// other `u_j` matter: not negative, and zero for the partners of positive unknowns.
    fn changing_sides(
        &self,
        known: &[ContactState],
        zero: &[usize],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<usize>> {
        let rows =
            ContactState::PRESSED.into_iter().flat_map(|side| (0..self.contacts).map(move |k| (k, side)));
        let is_own = |(contact, side): (usize, ContactState)| known[contact] == side;
        let vanishing = |(_, row): &(usize, (usize, ContactState))| zero.contains(&row.0) || !is_own(*row);
        let rows: Vec<(usize, (usize, ContactState))> = rows.enumerate().filter(vanishing).collect();
        let open: Vec<usize> = (0..rows.len()).filter(|&at| zero.contains(&rows[at].1.0)).collect();
        let unit = |&own: &usize| -> Vec<IBig> {
            (0..rows.len()).map(|at| IBig::from(u8::from(at == own))).collect()
        };
        let signed = |change: &Vec<IBig>, sign: i32| -> Vec<IBig> {
            rows.iter().map(|(at, _)| &change[*at] * IBig::from(sign)).collect()
        };
        // u_j - sum_i changes_ij (t_i - t'_i) = 0
        let along = self.changes.iter().flat_map(|change| [signed(change, -1), signed(change, 1)]);
        let columns: Vec<Vec<IBig>> = open.iter().map(unit).chain(along).collect();
        let support = Cell::of_columns(&columns, &vec![IBig::ZERO; rows.len()], 0, proceed)?.support();
        let positive = support.into_iter().filter_map(|at| open.get(at)).map(|&at| rows[at].1);
        Some(positive.filter(|row| !is_own(*row)).map(|(contact, _)| contact).collect())
    }
}

/// A basis of `S l = 0` for a symmetric matrix without negative eigenvalues; `None` if it has one, if it is large and
/// not definite, or once `proceed` is `false`. Rows of zeros are left out first: a second bound of an unknown has one.
fn null_space(form: &[Vec<IBig>], proceed: &mut dyn FnMut() -> bool) -> Option<Vec<Vec<IBig>>> {
    let (zero, rest): (Vec<usize>, Vec<usize>) =
        (0..form.len()).partition(|&row| form[row].iter().all(IBig::is_zero));
    let unit =
        |&row: &usize| -> Vec<IBig> { (0..form.len()).map(|at| IBig::from(u8::from(at == row))).collect() };
    let mut basis: Vec<Vec<IBig>> = zero.iter().map(unit).collect();
    let part: Vec<Vec<IBig>> =
        rest.iter().map(|&row| rest.iter().map(|&column| form[row][column].clone()).collect()).collect();
    if is_definite(&part)? {
        return Some(basis);
    }
    if part.len() > EXACT_SIZE {
        return None;
    }
    for vector in null_space_of_semidefinite(&part, proceed)? {
        let mut whole = vec![IBig::ZERO; form.len()];
        rest.iter().zip(vector).for_each(|(&at, entry)| whole[at] = entry);
        basis.push(whole);
    }
    Some(basis)
}

/// Whether floating point proves that a symmetric matrix is positive definite; `None` if a diagonal entry is negative.
fn is_definite(form: &[Vec<IBig>]) -> Option<bool> {
    if (0..form.len()).any(|at| form[at][at] < IBig::ZERO) {
        return None;
    }
    // Rows and columns are divided by powers of two, so that the diagonal is near 1.
    let half: Vec<isize> = (0..form.len()).map(|at| form[at][at].bit_len().cast_signed() / 2).collect();
    let entry = |row: usize, column: usize| rounded(&form[row][column], -half[row] - half[column]);
    Some(is_positive_definite(DMatrix::from_fn(form.len(), form.len(), entry)))
}

/// `value 2^exponent`, with a relative error below 2^-52 unless it underflows.
fn rounded(value: &IBig, exponent: isize) -> f64 {
    let dropped = value.bit_len().saturating_sub(62);
    let leading = i64::try_from(value >> dropped).unwrap_or(i64::MAX) as f64;
    leading * 2_f64.powi(i32::try_from(exponent + dropped.cast_signed()).unwrap_or(i32::MIN))
}

/// `-(C^+ C^-^T + C^- C^+^T)`; `None` if that takes too many products, or once `proceed` is `false`.
fn symmetric_form(
    positive: &[Vec<IBig>],
    negative: &[Vec<IBig>],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<Vec<IBig>>> {
    let size = positive.len();
    let entries = |column: &Vec<IBig>| column.iter().filter(|entry| !entry.is_zero()).count();
    let products: usize =
        positive.iter().zip(negative).map(|(one, other)| 2 * entries(one) * entries(other)).sum();
    if products > FORM_PRODUCTS {
        return None;
    }
    let mut form = vec![vec![IBig::ZERO; size]; size];
    for (one, other) in positive.iter().zip(negative).chain(negative.iter().zip(positive)) {
        for (row, factor) in one.iter().enumerate().filter(|(_, factor)| !factor.is_zero()) {
            if !proceed() {
                return None;
            }
            for (column, entry) in other.iter().enumerate().filter(|(_, entry)| !entry.is_zero()) {
                form[row][column] -= factor * entry;
            }
        }
    }
    Some(form)
}

fn scalar_product(one: &[IBig], other: &[IBig]) -> IBig {
    one.iter().zip(other).filter(|(_, entry)| !entry.is_zero()).map(|(one, other)| one * other).sum()
}

/// The other side.
fn partner(state: ContactState) -> ContactState {
    match state {
        ContactState::Positive => ContactState::Negative,
        _ => ContactState::Positive,
    }
}
