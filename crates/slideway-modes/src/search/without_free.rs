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
use crate::certificate::{Condensed, ExactSolution, IntervalMatrix, LiftedSystem, make_primitive};
use crate::problem::{BySide, ContactState, IntervalModeProblem};
use crate::solutions::ContactSet;

/// The lifted equations with and without the free unknowns.
pub(super) struct WithoutFree {
    system: Arc<LiftedSystem>,
    /// The columns of the free contacts.
    free: ContactSet,
    /// The equations that are left, computed when they are first needed; `None` within if there was no time
    /// for it.
    left: OnceLock<Option<Left>>,
    /// The equations of all patterns without the free unknowns, likewise.
    condensed: OnceLock<Option<Condensed>>,
    /// Whether vectors are those of all equations, also where they are found without the free unknowns.
    for_all: bool,
}

/// The equations without the free unknowns.
struct Left {
    system: LiftedSystem,
    /// `K`: of which equations each of them is the sum, if vectors of all equations are wanted.
    sums: Option<Vec<Vec<IBig>>>,
}

impl WithoutFree {
    pub(super) fn new(system: &Arc<LiftedSystem>, free: &[bool]) -> Self {
        let mut columns = ContactSet::none_of(system.width());
        for contact in (0..free.len()).filter(|&contact| free[contact]) {
            [contact, system.contacts() + contact].into_iter().for_each(|column| columns.insert(column));
        }
        Self::with(system, columns)
    }

    fn with(system: &Arc<LiftedSystem>, free: ContactSet) -> Self {
        let system = Arc::clone(system);
        Self { system, free, left: OnceLock::new(), condensed: OnceLock::new(), for_all: false }
    }

    /// The same, with vectors of all equations, for a proof.
    pub(super) fn for_all(&self) -> Self {
        Self { for_all: true, ..Self::with(&self.system, self.free.clone()) }
    }

    /// A verified vector for some columns, as [`separate`] returns: of all equations where that is wanted, otherwise perhaps of
    /// those that are left.
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
        Some(left.combined(vector, self.system.rows()))
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

    /// The solution of a pattern's equations, for which the free unknowns are not eliminated again; `None` if it is not known that
    /// there is exactly one, with jumps, or if there is no time.
    pub(super) fn solve(
        &self,
        pattern: &[ContactState],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<ExactSolution> {
        let mut solution = ExactSolution::from(self.condensed(proceed)?.solve(pattern)?);
        let negative = |contact: &usize| pattern[*contact] == ContactState::Negative;
        self.free_contacts().into_iter().filter(negative).for_each(|contact| solution.turn(contact));
        Some(solution)
    }

    fn free_contacts(&self) -> Vec<usize> {
        self.free.iter().filter(|&column| column < self.system.contacts()).collect()
    }

    fn condensed(&self, proceed: &mut dyn FnMut() -> bool) -> Option<&Condensed> {
        let condensed = || Condensed::new(&self.system, self.free_contacts(), proceed);
        self.condensed.get_or_init(condensed).as_ref()
    }

    fn left(&self, proceed: &mut dyn FnMut() -> bool) -> Option<&Left> {
        let eliminated = || {
            let condensed = if self.for_all { None } else { self.condensed(proceed) };
            if let Some(condensed) = condensed {
                return Some(Left { system: condensed.left(&self.system), sums: None });
            }
            // Those of the other sides are opposite.
            let sums = self.system.left_null_space(&self.free_contacts(), proceed)?;
            Some(Left { system: self.system.summed(&sums), sums: Some(sums) })
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

    /// `sum_i t_i K_i`, without common factor; `t` if the sums are not known.
    fn combined(&self, vector: Vec<IBig>, rows: usize) -> Vec<IBig> {
        let Some(sums) = &self.sums else { return vector };
        let mut all = vec![IBig::ZERO; rows];
        for (factor, sum) in vector.iter().zip(sums).filter(|(factor, _)| !factor.is_zero()) {
            all.iter_mut().zip(sum).for_each(|(all, entry)| *all += factor * entry);
        }
        make_primitive(&mut all);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_problems::Numbers;
    use super::*;
    use crate::problem::patterns;

    /// The same decisions, with the same bounds, as those of all equations of each pattern.
    #[test]
    fn patterns_are_solved_without_free_unknowns() {
        for seed in 0..20_usize {
            let is_free: Vec<bool> = (0..6).map(|contact| contact == seed % 6 || contact == 3).collect();
            let problem = Numbers::new(seed as u64).problem_with_free(&is_free);
            let system = Arc::new(LiftedSystem::new((&problem).into()));
            let without_free = WithoutFree::new(&system, &is_free);
            for pattern in patterns(&problem.jumps_of_contacts(), u64::MAX).expect("no limit") {
                let solved = without_free.solve(&pattern, &mut || true).expect("regular");
                let alone = ExactSolution::of_pattern(&problem, &pattern, &mut || true).expect("regular");
                let decision = solved.decide(&pattern);
                assert_eq!(decision, alone.decide(&pattern));
            }
        }
    }

    /// The planes of columns are known: three columns, of which the third is the sum of the others.
    #[test]
    fn null_spaces_are_those_of_dependent_columns() {
        let mut numbers = Numbers::new(1);
        let problem = numbers.problem(5, 1.5, false);
        let [mut positive, negative] =
            crate::problem::Side::BOTH.map(|side| problem.columns(side).map(|entry| (64.0 * entry).round()));
        let sum = positive.column(0) + positive.column(1);
        positive.set_column(2, &sum);
        let none = DMatrix::zeros(5, 5);
        let load = problem.right_hand_side().clone();
        let problem = crate::problem::ModeProblem::new(positive, negative, none.clone(), none, load);
        let system = LiftedSystem::new((&problem.expect("shapes fit")).into());
        for (columns, dimension) in [(vec![], 5), (vec![0, 1], 3), (vec![0, 1, 2], 3), (vec![2, 7, 0, 1], 2)]
        {
            let basis = system.left_null_space(&columns, &mut || true).expect("nothing stops it");
            assert_eq!(basis.len(), dimension);
            for vector in &basis {
                for &column in &columns {
                    let product: IBig = vector.iter().zip(system.column(column)).map(|(a, b)| a * b).sum();
                    assert!(product.is_zero() && vector.iter().any(|entry| !entry.is_zero()));
                }
            }
        }
    }
}
