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
use dashu_ratio::RBig;

use super::cell::{Cell, null_space_of_semidefinite};
use super::elimination::IntegerSystem;
use super::lifted::LiftedSystem;
use crate::problem::{ContactState, ModeProblem};

/// A problem without jumps that is monotone if a pattern is regular.
pub(crate) struct Monotone<'p> {
    problem: &'p ModeProblem,
    /// What `u` changes in `y^+`, then in `y^-`, for a basis of `S l = 0`.
    changes: Vec<Vec<IBig>>,
}

impl<'p> Monotone<'p> {
    /// Proves that `S` has no negative eigenvalue; `None` if it has one, or once `proceed` is `false`.
    pub(crate) fn prove(problem: &'p ModeProblem, proceed: &mut dyn FnMut() -> bool) -> Option<Self> {
        let system = LiftedSystem::new(problem.into());
        let (positive, negative) = system.columns().split_at(problem.contacts());
        let null_space = null_space_of_semidefinite(&symmetric_form(positive, negative, proceed)?, proceed)?;
        let change = |multipliers: &Vec<IBig>| {
            negative.iter().chain(positive).map(|column| scalar_product(column, multipliers)).collect()
        };
        Some(Self { problem, changes: null_space.iter().map(change).collect() })
    }

    /// A pattern that has all solutions of the problem, from one that has a solution; `None` if that one is
    /// not regular or has none, or once `proceed` is `false`.
    pub(crate) fn pattern_of_all_solutions(
        &self,
        known: &[ContactState],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<ContactState>> {
        let echelon = IntegerSystem::new(self.problem, known).eliminate_while(proceed)?;
        let unknowns = echelon.is_regular().then(|| echelon.solve_reduced(known.len()))?;
        if unknowns.iter().any(|value| *value < RBig::ZERO) {
            return None;
        }
        let mut pattern = known.to_vec();
        let is_degenerate = unknowns.iter().any(RBig::is_zero);
        if !is_degenerate || self.changes.is_empty() {
            return Some(pattern);
        }
        for contact in self.changing_sides(known, &unknowns, proceed)? {
            pattern[contact] = partner(known[contact]);
        }
        Some(pattern)
    }

    /// The contacts that have a positive unknown on the other side in some solution.
    fn changing_sides(
        &self,
        known: &[ContactState],
        unknowns: &[RBig],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<usize>> {
        let contacts = known.len();
        // y_j - sum_i changes_ij (t_i - t'_i) = known y_j, with y_j = 0 for the partners of positive unknowns.
        let rows = ContactState::PRESSED.into_iter().flat_map(|side| (0..contacts).map(move |k| (k, side)));
        let rows: Vec<(usize, ContactState)> = rows.collect();
        let is_own = |&(contact, side): &(usize, ContactState)| known[contact] == side;
        let value =
            |row: &(usize, ContactState)| if is_own(row) { unknowns[row.0].clone() } else { RBig::ZERO };
        let right: Vec<IBig> = rows.iter().map(|row| value(row).numerator().clone()).collect();
        let scales: Vec<IBig> = rows.iter().map(|row| IBig::from(value(row).denominator().clone())).collect();
        let open: Vec<usize> =
            (0..rows.len()).filter(|&at| is_own(&rows[at]) || unknowns[rows[at].0].is_zero()).collect();
        let unit = |&own: &usize| -> Vec<IBig> {
            (0..rows.len()).map(|at| if at == own { scales[at].clone() } else { IBig::ZERO }).collect()
        };
        let scaled = |change: &Vec<IBig>, sign: i32| -> Vec<IBig> {
            change.iter().zip(&scales).map(|(entry, scale)| entry * scale * IBig::from(sign)).collect()
        };
        let along = self.changes.iter().flat_map(|change| [scaled(change, -1), scaled(change, 1)]);
        let columns: Vec<Vec<IBig>> = open.iter().map(unit).chain(along).collect();
        let support = Cell::of_columns(&columns, &right, 0, proceed)?.support();
        let positive = support.into_iter().filter_map(|at| open.get(at)).map(|&at| rows[at]);
        Some(positive.filter(|row| !is_own(row)).map(|(contact, _)| contact).collect())
    }
}

/// `-(C^+ C^-^T + C^- C^+^T)`.
fn symmetric_form(
    positive: &[Vec<IBig>],
    negative: &[Vec<IBig>],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<Vec<IBig>>> {
    let size = positive.len();
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
