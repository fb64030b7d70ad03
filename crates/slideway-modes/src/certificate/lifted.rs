//! The lifted equations, in integers: every contact with the unknowns of all its states at once.
//!
//! ```text
//! sum_k c_k^+ y_k^+ + c_k^- y_k^- - d_k^+ lambda_k - d_k^- lambda'_k = N(0) + sum_k d_k    (d_k: without a jump)
//! lambda_k + lambda'_k = 1                                                                (with a jump)
//! y^+, y^-, lambda, lambda' >= 0
//! ```
//!
//! The solutions of the mode problem are the faces of this polyhedron in which no two of the unknowns of
//! different states of a contact are positive (theory, section 4 (b)).

use dashu_int::ops::{BitTest, Gcd, UnsignedAbs};
use dashu_int::{IBig, UBig};

use super::cell::contradiction;
use super::cramer;
use super::elimination::integers_of_row;
use super::residues::Field;
use crate::problem::{ContactState, ProblemView, Side};

/// The columns and the right-hand side of the lifted equations of an exact problem; every row is multiplied
/// by a power of two.
///
/// The column of `y_k^+` is `k`, that of `y_k^-` is `n + k`; those of `lambda` and `lambda'` of the contacts
/// with a jump follow in pairs.
pub(crate) struct LiftedSystem {
    contacts: usize,
    rows: usize,
    columns: Vec<Vec<IBig>>,
    right: Vec<IBig>,
    /// Each row is that of the problem times 2 to this power.
    exponents: Vec<i32>,
    /// The column of `lambda_k` of the contacts with a jump.
    share: Vec<Option<usize>>,
}

impl LiftedSystem {
    /// Of a problem with exact numbers.
    pub(crate) fn new(problem: ProblemView<'_>) -> Self {
        let contacts = problem.contacts();
        let jumping: Vec<usize> = (0..contacts).filter(|&contact| problem.has_jump(contact)).collect();
        let mut share = vec![None; contacts];
        for (at, &contact) in jumping.iter().enumerate() {
            share[contact] = Some(2 * (contacts + at));
        }
        let width = 2 * (contacts + jumping.len());
        let mut columns = vec![Vec::with_capacity(contacts + jumping.len()); width];
        let mut right = Vec::with_capacity(contacts + jumping.len());
        let mut exponents = Vec::with_capacity(contacts + jumping.len());
        for row in 0..contacts {
            let (mut entries, exponent) = integers_of_row(&lifted_row(problem, &jumping, row));
            exponents.push(exponent);
            right.extend(entries.pop());
            columns.iter_mut().zip(entries).for_each(|(column, entry)| column.push(entry));
        }
        for &contact in &jumping {
            for (at, column) in columns.iter_mut().enumerate() {
                let share = share[contact].unwrap_or(width);
                column.push(IBig::from(u8::from(at == share || at == share + 1)));
            }
            right.push(IBig::ONE);
            exponents.push(0);
        }
        Self { contacts, rows: right.len(), columns, right, exponents, share }
    }

    /// Sums of the equations, with these factors each; not multiplied further.
    pub(crate) fn summed(&self, sums: &[Vec<IBig>]) -> Self {
        let summed =
            |column: &Vec<IBig>| -> Vec<IBig> { sums.iter().map(|sum| product(sum, column)).collect() };
        self.with_equations(self.columns.iter().map(summed).collect(), summed(&self.right))
    }

    /// Other equations for the same unknowns; not multiplied further.
    pub(super) fn with_equations(&self, columns: Vec<Vec<IBig>>, right: Vec<IBig>) -> Self {
        let exponents = vec![0; right.len()];
        Self { rows: right.len(), columns, right, exponents, share: self.share.clone(), ..*self }
    }

    /// The number of contacts.
    pub(crate) fn contacts(&self) -> usize {
        self.contacts
    }

    /// The number of columns.
    pub(crate) fn width(&self) -> usize {
        self.columns.len()
    }

    /// The number of equations.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// `C_j`.
    pub(crate) fn column(&self, column: usize) -> &[IBig] {
        &self.columns[column]
    }

    /// All columns.
    pub(super) fn columns(&self) -> &[Vec<IBig>] {
        &self.columns
    }

    /// `b`.
    pub(crate) fn right(&self) -> &[IBig] {
        &self.right
    }

    /// The powers of two by which the rows of the problem are multiplied.
    pub(crate) fn exponents(&self) -> &[i32] {
        &self.exponents
    }

    /// The columns of a contact in a state.
    pub(crate) fn columns_of(&self, contact: usize, state: ContactState) -> impl Iterator<Item = usize> {
        let share = self.share[contact];
        let rest = share.map(|share| share + 1);
        let pair = match state {
            ContactState::Positive => [Some(contact), share],
            ContactState::Negative => [Some(self.contacts + contact), rest],
            ContactState::Gap => [share, rest],
        };
        pair.into_iter().flatten()
    }

    /// Some `v` with `v . C_j <= 0` for the given columns and `v . b > 0`, so that their unknowns solve the equations for no
    /// `y >= 0`: by the simplex method in integers of any length, however different the numbers are in size. `None` if
    /// there is a solution, or once `proceed` is `false`.
    pub(crate) fn farkas(&self, columns: &[usize], proceed: &mut dyn FnMut() -> bool) -> Option<Vec<IBig>> {
        let own: Vec<Vec<IBig>> = columns.iter().map(|&column| self.columns[column].clone()).collect();
        let zero = contradiction(&own, &self.right, proceed)?;
        let zero: Vec<usize> = zero.into_iter().map(|at| columns[at]).collect();
        // All vectors of the basis with another product with `b` than zero prove the same: they differ by sums of
        // equations in which nothing is left.
        let basis = self.left_null_space(&zero, proceed)?;
        let mut vector = basis.into_iter().find(|vector| !product(vector, &self.right).is_zero())?;
        if product(&vector, &self.right) < IBig::ZERO {
            vector.iter_mut().for_each(|entry| *entry = -std::mem::take(entry));
        }
        Some(vector)
    }

    /// A basis of all `v` with `v . C_j = 0` for some columns, in integers without common factor; `None` once
    /// `proceed` is `false`.
    ///
    /// Each equation that depends on others in these columns gives a vector: it, minus those others. Which do is found modulo
    /// a prime. It is so in integers, too, if all products vanish; otherwise the prime divides some determinant.
    pub(crate) fn left_null_space(
        &self,
        columns: &[usize],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<Vec<IBig>>> {
        let entries = |row: usize| columns.iter().map(move |&column| &self.columns[column][row]);
        let mut rows: Vec<usize> = (0..self.rows).collect();
        // Sums of short equations are short.
        rows.sort_by_key(|&row| entries(row).map(BitTest::bit_len).sum::<usize>());
        for field in Field::all() {
            if !proceed() {
                return None;
            }
            let mut residues: Vec<Vec<u64>> = columns
                .iter()
                .map(|&column| rows.iter().map(|&row| field.residue(&self.columns[column][row])).collect())
                .collect();
            let reduced = field.reduce(&mut residues, self.rows);
            let rank = reduced.pivots.len();
            let used: Vec<usize> = reduced.pivots.iter().map(|&at| rows[at]).collect();
            let others: Vec<usize> = rows.iter().copied().filter(|row| !used.contains(row)).collect();
            let (own, dependent) = reduced.order.split_at(rank);
            let equations: Vec<Vec<IBig>> = own
                .iter()
                .map(|&at| &self.columns[columns[at]])
                .map(|column| used.iter().chain(&others).map(|&row| column[row].clone()).collect())
                .collect();
            let Some(solved) = cramer::solve(&equations, rank, proceed) else { continue };
            let vector = |(at, &row): (usize, &usize)| {
                let mut vector = vec![IBig::ZERO; self.rows];
                // Without equations, there are no right-hand sides either.
                let numerators = solved.numerators.get(at).into_iter().flatten();
                used.iter().zip(numerators).for_each(|(&row, entry)| vector[row] = -entry);
                vector[row].clone_from(&solved.determinant);
                make_primitive(&mut vector);
                vector
            };
            let basis: Vec<Vec<IBig>> = others.iter().enumerate().map(vector).collect();
            let dependent: Vec<&Vec<IBig>> = dependent.iter().map(|&at| &self.columns[columns[at]]).collect();
            if basis.iter().all(|vector| dependent.iter().all(|column| product(vector, column).is_zero())) {
                return Some(basis);
            }
        }
        None
    }
}

fn product(one: &[IBig], other: &[IBig]) -> IBig {
    one.iter().zip(other).filter(|(a, b)| !a.is_zero() && !b.is_zero()).map(|(a, b)| a * b).sum()
}

/// The numbers of a row whose sums are its entries, with the right-hand side last.
fn lifted_row(problem: ProblemView<'_>, jumping: &[usize], row: usize) -> Vec<Vec<f64>> {
    // No term is no number, too.
    let terms = |contact: usize, side: Side| -> Vec<f64> {
        let terms = problem.column(contact, side).terms().map(|term| term.centre[row]);
        terms.filter(|term| *term != 0.0).collect()
    };
    let side = |side: Side| (0..problem.contacts()).map(move |contact| terms(contact, side));
    let jump = |contact: usize, side: Side| problem.jump(contact, side).centre[row];
    let shares = jumping.iter().flat_map(|&contact| Side::BOTH.map(|side| vec![-jump(contact, side)]));
    let constant = (0..problem.contacts()).filter(|contact| !jumping.contains(contact));
    let right = std::iter::once(problem.load().centre[row]).chain(constant.map(|k| jump(k, Side::Negative)));
    side(Side::Positive).chain(side(Side::Negative)).chain(shares).chain([right.collect()]).collect()
}

/// Divides by the greatest common divisor.
pub(crate) fn make_primitive(row: &mut [IBig]) {
    let mut common = UBig::ZERO;
    for entry in row.iter().filter(|entry| !entry.is_zero()) {
        common = if common.is_zero() { entry.clone().unsigned_abs() } else { common.gcd(entry) };
        if common.is_one() {
            return;
        }
    }
    if !common.is_zero() {
        let common = IBig::from(common);
        row.iter_mut().filter(|entry| !entry.is_zero()).for_each(|entry| *entry = &*entry / &common);
    }
}
