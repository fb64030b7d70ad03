//! Patterns that have the columns of the same contacts in common: static condensation modulo primes.
//!
//! A free contact has opposite columns, so that its sides change no more than signs. With its columns eliminated once, every
//! pattern of the others is left with as many equations as there are others, and the unknowns of free contacts follow by
//! one product.

use dashu_int::IBig;

use super::cramer::{Cramer, primes_for};
use super::lifted::{LiftedSystem, make_primitive};
use super::residues::{Combined, Field};
use crate::problem::ContactState;

/// The lifted equations, solved for the unknowns of the free contacts on their positive sides.
pub(crate) struct Condensed {
    free: Vec<usize>,
    others: Vec<usize>,
    /// Whether the order of free contacts and others is an odd permutation of that of all.
    is_odd: bool,
    residues: Vec<Residues>,
}

/// The equations modulo one prime.
struct Residues {
    field: Field,
    /// First the equations that are solved for the free unknowns, then those of the others, each with the coefficients of all
    /// positive sides of the others, the right-hand side, and the coefficients of all negative sides. The latter are zero in
    /// the former equations of a mixed problem.
    rows: Vec<Vec<u64>>,
    /// That of the columns of free contacts.
    determinant: u64,
}

impl Condensed {
    /// Without jumps only. `None`, too, if the columns of free contacts are dependent, or once `proceed` is `false`.
    pub(crate) fn new(
        system: &LiftedSystem,
        free: Vec<usize>,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        let contacts = system.contacts();
        if system.rows() != contacts {
            return None;
        }
        let others: Vec<usize> = (0..contacts).filter(|contact| !free.contains(contact)).collect();
        let positive = free.iter().chain(&others).map(|&contact| system.column(contact));
        let negative = others.iter().map(|contact| system.column(contacts + contact));
        let columns: Vec<&[IBig]> = positive.chain([system.right()]).chain(negative).collect();
        let row = |row: usize| columns.iter().map(move |column| &column[row]);
        let primes = primes_for((0..contacts).map(row));
        let (mut residues, mut vanishing) = (Vec::with_capacity(primes), 0);
        let mut fields = Field::all();
        while residues.len() < primes {
            let field = fields.next().filter(|_| vanishing <= primes && proceed())?;
            let mut rows: Vec<Vec<u64>> =
                (0..contacts).map(|at| row(at).map(|entry| field.residue(entry)).collect()).collect();
            let reduced = field.reduce(&mut rows, free.len());
            if reduced.pivots.len() == free.len() {
                rows.iter_mut().for_each(|row| drop(row.drain(..free.len())));
                residues.push(Residues { field, rows, determinant: reduced.determinant });
            } else {
                vanishing += 1;
            }
        }
        let before = |contact: &usize| others.iter().filter(|other| *other < contact).count();
        let is_odd = free.iter().map(before).sum::<usize>() % 2 == 1;
        Some(Self { free, others, is_odd, residues })
    }

    /// The solution of a pattern's equations, with free contacts on their positive sides; `None` if its determinant is zero
    /// modulo one of the primes.
    pub(crate) fn solve(&self, pattern: &[ContactState]) -> Option<Cramer> {
        let size = self.others.len();
        let place = |(at, &contact): (usize, &usize)| match pattern[contact] {
            ContactState::Negative => size + 1 + at,
            _ => at,
        };
        let own: Vec<usize> = self.others.iter().enumerate().map(place).chain([size]).collect();
        let mut combined = Combined::new(1 + pattern.len());
        for Residues { field, rows, determinant } in &self.residues {
            let (solved, left) = rows.split_at(self.free.len());
            let mut left: Vec<Vec<u64>> =
                left.iter().map(|row| own.iter().map(|&at| row[at]).collect()).collect();
            let reduced = field.reduce(&mut left, size);
            if reduced.pivots.len() < size {
                return None;
            }
            let determinant = field.times(*determinant, reduced.determinant);
            let factor =
                field.multiplier(if self.is_odd { field.minus(0, determinant) } else { determinant });
            let mut residues = vec![factor.times(1); 1 + pattern.len()];
            let mut multipliers = Vec::with_capacity(size);
            for (&contact, row) in self.others.iter().zip(&left) {
                residues[1 + contact] = factor.times(row[size]);
                multipliers.push(field.multiplier(row[size]));
            }
            for (&contact, row) in self.free.iter().zip(solved) {
                let terms = own.iter().zip(&multipliers).map(|(&at, value)| value.times(row[at]));
                let value = terms.fold(row[size], |rest, term| field.minus(rest, term));
                residues[1 + contact] = factor.times(value);
            }
            combined.add(*field, &residues);
        }
        let mut integers = combined.integers().into_iter();
        Some(Cramer { determinant: integers.next()?, numerators: vec![integers.collect()] })
    }

    /// The equations of the others, times the determinant of the columns of free contacts: those columns are zero.
    pub(crate) fn left(&self, system: &LiftedSystem) -> LiftedSystem {
        let size = self.others.len();
        let mut combined = Combined::new(size * (2 * size + 1));
        for Residues { field, rows, determinant } in &self.residues {
            let factor = field.multiplier(*determinant);
            let entries = rows[self.free.len()..].iter().flatten().map(|&entry| factor.times(entry));
            combined.add(*field, &entries.collect::<Vec<_>>());
        }
        let mut entries = combined.integers().into_iter();
        let mut rows: Vec<Vec<IBig>> =
            (0..size).map(|_| entries.by_ref().take(2 * size + 1).collect()).collect();
        rows.iter_mut().for_each(|row| make_primitive(row));
        let column = |at: usize| -> Vec<IBig> { rows.iter().map(|row| row[at].clone()).collect() };
        let mut columns = vec![vec![IBig::ZERO; size]; system.width()];
        for (at, &contact) in self.others.iter().enumerate() {
            columns[contact] = column(at);
            columns[system.contacts() + contact] = column(size + 1 + at);
        }
        system.with_equations(columns, column(size))
    }
}
