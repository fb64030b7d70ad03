//! Vectors that separate ([`separate`]), sought in the equations that are left when the free unknowns are eliminated.
//!
//! Where a free contact may be on both sides, `v . p <= 0` and `-v . p <= 0` for its opposite columns `p`, `-p`, so that
//! `v . p = 0`. All such vectors are `v = sum_i t_i K_i`, with a basis `K` of the left null space of the columns `p`, and
//! `v . C_j = t . (K C_j)`: the columns `K C_j` are those of the Schur complement, in integers. There are as many equations
//! as other contacts, however many unknowns are free.

use std::sync::{Arc, OnceLock};

use dashu_int::IBig;
use dashu_int::ops::BitTest;
use nalgebra::{DMatrix, DVector};

use super::separation::{Separated, log2, scaled, separate};
use crate::certificate::{IntervalMatrix, LiftedSystem, enclose_solution_while, make_primitive};
use crate::problem::{BySide, IntervalModeProblem};
use crate::solutions::ContactSet;

/// The lifted equations with and without the free unknowns.
pub(super) struct WithoutFree {
    system: Arc<LiftedSystem>,
    /// The columns of the free contacts.
    free: ContactSet,
    /// The equations that are left, computed when they are first needed; `None` within if there was no time
    /// for it.
    left: OnceLock<Option<Left>>,
}

/// The equations without the free unknowns.
struct Left {
    system: LiftedSystem,
    /// `K`: of which equations each of them is the sum.
    sums: Vec<Vec<IBig>>,
}

impl WithoutFree {
    pub(super) fn new(system: &Arc<LiftedSystem>, free: &[bool]) -> Self {
        let mut columns = ContactSet::none_of(system.width());
        for contact in (0..free.len()).filter(|&contact| free[contact]) {
            [contact, system.contacts() + contact].into_iter().for_each(|column| columns.insert(column));
        }
        Self { system: Arc::clone(system), free: columns, left: OnceLock::new() }
    }

    /// A verified vector for some columns, as [`separate`] returns.
    pub(super) fn separate(
        &self,
        (allowed, tight): (&ContactSet, &ContactSet),
        wanted: Separated<'_>,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<IBig>> {
        let all_open = !self.free.is_empty() && self.free.is_within(allowed);
        let left = if all_open { self.left(proceed) } else { None };
        let Some(left) = left else {
            let [allowed, tight] = [allowed, tight].map(|set| set.iter().collect::<Vec<_>>());
            return separate(&self.system, (&allowed, &tight), wanted, proceed);
        };
        if let Separated::Vanishing(which) = wanted
            && which.iter().any(|&column| self.free.contains(column))
        {
            return None;
        }
        let others =
            |set: &ContactSet| set.iter().filter(|&column| !self.free.contains(column)).collect::<Vec<_>>();
        let vector = separate(&left.system, (&others(allowed), &others(tight)), wanted, proceed)?;
        Some(left.combined(&vector, self.system.rows()))
    }

    /// The mode problem of the other contacts, in their order, within bounds; `None` if the columns of the free contacts are
    /// dependent, if a contact has a jump, if the numbers differ too much in size, or if there is no time.
    ///
    /// Bounds of the Schur complement are found much sooner than its integers, which are asked where there are none.
    pub(super) fn others(&self, proceed: &mut dyn FnMut() -> bool) -> Option<IntervalModeProblem> {
        let contacts = self.system.contacts();
        let (free, others): (Vec<usize>, Vec<usize>) =
            (0..contacts).partition(|&contact| self.free.contains(contact));
        if free.is_empty() || self.system.width() > 2 * contacts {
            return None;
        }
        let columns: Vec<usize> =
            others.iter().copied().chain(others.iter().map(|contact| contacts + contact)).collect();
        if let Some(problem) = self.complement(&free, &columns, proceed).as_ref().and_then(mode_problem) {
            return Some(problem);
        }
        let left = &self.left(proceed)?.system;
        (left.rows() == others.len()).then_some(())?;
        mode_problem(&within_bounds(left, &columns)?)
    }

    /// Bounds of the Schur complement `S` of the columns `P` of the free contacts, for these columns and, last, the right-hand
    /// side, `R`. With unit columns `E` of the equations that are kept, for which `P` and `E` together are regular,
    ///
    /// ```text
    /// P X + E S = R
    /// ```
    fn complement(
        &self,
        free: &[usize],
        columns: &[usize],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<IntervalMatrix> {
        let all: Vec<usize> = free.iter().chain(columns).copied().collect();
        let all = within_bounds(&self.system, &all)?;
        let (rows, width) = all.shape();
        let (own, right) = (all.columns(0..free.len()), all.columns(free.len()..width));
        // The equations of the pivots are solved for the free unknowns; the others are kept.
        let mut order = DVector::from_fn(rows, |row, _| row);
        own.centre().clone().lu().p().permute_rows(&mut order);
        let kept = order.rows_range(free.len()..);
        let units = DMatrix::from_fn(rows, kept.len(), |row, at| f64::from(u8::from(row == kept[at])));
        let matrix = own.beside(&IntervalMatrix::exact(units));
        let solved = enclose_solution_while(&matrix, &right, proceed)?.solution;
        Some(solved.transposed().columns(free.len()..rows).transposed())
    }

    fn left(&self, proceed: &mut dyn FnMut() -> bool) -> Option<&Left> {
        let eliminated = || {
            let free: Vec<usize> = self.free.iter().collect();
            let sums = self.system.left_null_space(&free, proceed)?;
            Some(Left { system: self.system.summed(&sums), sums })
        };
        self.left.get_or_init(eliminated).as_ref()
    }
}

impl Left {
    /// `sum_i t_i K_i`, without common factor.
    fn combined(&self, vector: &[IBig], rows: usize) -> Vec<IBig> {
        let mut all = vec![IBig::ZERO; rows];
        for (factor, sum) in vector.iter().zip(&self.sums).filter(|(factor, _)| !factor.is_zero()) {
            all.iter_mut().zip(sum).for_each(|(all, entry)| *all += factor * entry);
        }
        make_primitive(&mut all);
        all
    }
}

/// Columns and, last, the right-hand side of equations, with the greatest entry of each about 1; `None` if the numbers differ too
/// much in size.
fn within_bounds(system: &LiftedSystem, columns: &[usize]) -> Option<IntervalMatrix> {
    let columns: Vec<&[IBig]> =
        columns.iter().map(|&column| system.column(column)).chain([system.right()]).collect();
    let rows = system.rows();
    let largest = |row: usize| columns.iter().map(|column| log2(&column[row])).max().unwrap_or(0);
    let exponents: Vec<i32> = (0..rows).map(|row| -largest(row)).collect();
    let (mut centre, mut radius) = (DMatrix::zeros(rows, columns.len()), DMatrix::zeros(rows, columns.len()));
    for (at, column) in columns.iter().enumerate() {
        for (row, entry) in column.iter().enumerate() {
            let value = scaled(entry, exponents[row]);
            // The quotient of two rounded numbers would not be a normal one.
            (entry.is_zero() || value.abs() > f64::MIN_POSITIVE.sqrt()).then_some(())?;
            centre[(row, at)] = value;
            if entry.bit_len() > f64::MANTISSA_DIGITS as usize {
                radius[(row, at)] = (value.abs() * f64::EPSILON).next_up();
            }
        }
    }
    IntervalMatrix::around(centre, radius)
}

/// The mode problem with these columns: all of positive sides, all of negative ones, and the right-hand side.
fn mode_problem(all: &IntervalMatrix) -> Option<IntervalModeProblem> {
    let rows = all.shape().0;
    let columns = BySide { positive: all.columns(0..rows), negative: all.columns(rows..2 * rows) };
    let none = IntervalMatrix::exact(DMatrix::zeros(rows, rows));
    IntervalModeProblem::new(&columns, &BySide::same(none), &all.columns(2 * rows..2 * rows + 1)).ok()
}
