//! Vectors that separate ([`separate`]), sought in the equations that are left when the free unknowns are eliminated.
//!
//! Where a free contact may be on both sides, `v . p <= 0` and `-v . p <= 0` for its opposite columns `p`, `-p`, so that
//! `v . p = 0`. All such vectors are `v = sum_i t_i K_i`, with a basis `K` of the left null space of the columns `p`, and
//! `v . C_j = t . (K C_j)`: the columns `K C_j` are those of the Schur complement, in integers. There are as many equations
//! as other contacts, however many unknowns are free.

use std::sync::{Arc, OnceLock};

use dashu_int::IBig;
use dashu_int::ops::BitTest;
use nalgebra::DMatrix;

use super::separation::{Separated, log2, scaled, separate};
use crate::certificate::{IntervalMatrix, LiftedSystem, make_primitive};
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

    /// The mode problem of the other contacts, in their order, with its integers rounded within bounds; `None` if the columns
    /// of the free contacts are dependent, if a contact has a jump, if the numbers differ too much in size, or if there is
    /// no time.
    pub(super) fn others(&self, proceed: &mut dyn FnMut() -> bool) -> Option<IntervalModeProblem> {
        let contacts = self.system.contacts();
        let others: Vec<usize> = (0..contacts).filter(|&contact| !self.free.contains(contact)).collect();
        if others.len() == contacts || self.system.width() > 2 * contacts {
            return None;
        }
        let left = self.left(proceed)?;
        (left.system.rows() == others.len()).then_some(())?;
        let negative = others.iter().map(|&contact| contacts + contact);
        let columns = others.iter().copied().chain(negative).map(|column| left.system.column(column));
        left.rounded(&columns.collect::<Vec<_>>())
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
    /// The mode problem with these columns, first all of positive sides and then all of negative ones.
    fn rounded(&self, columns: &[&[IBig]]) -> Option<IntervalModeProblem> {
        let rows = self.system.rows();
        let largest = |row: usize| columns.iter().map(|column| log2(&column[row])).max().unwrap_or(0);
        let exponents: Vec<i32> = (0..rows).map(|row| -largest(row)).collect();
        let matrix = |columns: &[&[IBig]]| {
            let (mut centre, mut radius) =
                (DMatrix::zeros(rows, columns.len()), DMatrix::zeros(rows, columns.len()));
            for (at, entry) in columns.iter().enumerate().flat_map(|(at, column)| {
                column.iter().enumerate().map(move |(row, entry)| ((row, at), entry))
            }) {
                centre[at] = scaled(entry, exponents[at.0]);
                // The quotient of two rounded numbers would not be a normal one.
                (entry.is_zero() || centre[at].abs() > f64::MIN_POSITIVE.sqrt()).then_some(())?;
                if entry.bit_len() > f64::MANTISSA_DIGITS as usize {
                    radius[at] = (centre[at].abs() * f64::EPSILON).next_up();
                }
            }
            IntervalMatrix::around(centre, radius)
        };
        let (positive, negative) = columns.split_at(rows);
        let none = IntervalMatrix::exact(DMatrix::zeros(rows, rows));
        let columns = BySide { positive: matrix(positive)?, negative: matrix(negative)? };
        IntervalModeProblem::new(&columns, &BySide::same(none), &matrix(&[self.system.right()])?).ok()
    }

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
