//! The equations of a cell solved for some of its unknowns, in integers.

use dashu_int::IBig;
use dashu_ratio::RBig;

use crate::certificate::elimination::ratio;
use crate::certificate::lifted::make_primitive;

/// Equations `D y_i + sum_f t_if y_f = t_i`, one for each basic unknown `y_i`; the unknowns `y_f` are
/// nonbasic, and `D > 0`. All numbers are minors of the original equations, so each division by the previous
/// pivot leaves no remainder (Edmonds; Azulay and Pique, A revised simplex method with integer Q-matrices,
/// ACM Trans. Math. Softw. 27 (2001)).
pub(super) struct Dictionary {
    denominator: IBig,
    /// The entries of the nonbasic unknowns, and `t_i` last.
    rows: Vec<Vec<IBig>>,
    basic: Vec<usize>,
    nonbasic: Vec<usize>,
    /// Points of the cell; what is positive somewhere is positive in one of them.
    witnesses: Vec<Witness>,
}

/// A point: the positive unknowns, times the denominator.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Witness {
    positive: Vec<(usize, IBig)>,
    denominator: IBig,
}

impl Witness {
    /// The mean of several points.
    pub(super) fn mean(points: &[Self], unknowns: usize) -> Vec<RBig> {
        let mut sum = vec![RBig::ZERO; unknowns];
        for point in points {
            let denominator = &point.denominator * IBig::from(points.len());
            for (unknown, value) in &point.positive {
                sum[*unknown] += ratio(value.clone(), &denominator);
            }
        }
        sum
    }
}

/// The knowledge about an unknown: whether it is positive somewhere in the cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Known {
    Nothing,
    Positive,
    Zero,
}

/// Why there is no dictionary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ended {
    /// No `y >= 0` solves the equations.
    Infeasible,
    /// `proceed` was `false`.
    Interrupted,
}

/// Independent unknowns and the equations between them: indices of rows and columns of a [`Dictionary`].
pub(super) struct Block {
    pub(super) rows: Vec<usize>,
    pub(super) columns: Vec<usize>,
}

impl Dictionary {
    /// Solves `sum_j columns_j y_j = right` for a basis with `y >= 0` in which each unknown that is left is
    /// positive somewhere in the cell; those that are zero everywhere are left out.
    pub(super) fn of_support(
        columns: &[Vec<IBig>],
        right: &[IBig],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Ended> {
        let mut dictionary = Self::solved(columns, right, proceed)?;
        dictionary.make_feasible(proceed)?;
        let known = dictionary.find_support(columns.len(), proceed)?;
        dictionary.leave_out(&known, proceed)?;
        Ok(dictionary)
    }

    /// Of equations without a solution `y >= 0`, columns whose products with a vector that proves this are zero: those of
    /// all other basic unknowns than the one whose row has a negative value and no negative entry, or of all unknowns if
    /// the equations contradict each other for any signs. `None` if there is a solution, or once `proceed` is `false`.
    pub(super) fn contradiction(
        columns: &[Vec<IBig>],
        right: &[IBig],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<usize>> {
        let mut dictionary = match Self::solved(columns, right, proceed) {
            Ok(dictionary) => dictionary,
            Err(Ended::Infeasible) => return Some((0..columns.len()).collect()),
            Err(Ended::Interrupted) => return None,
        };
        if dictionary.make_feasible(proceed) != Err(Ended::Infeasible) {
            return None;
        }
        let contradicts = |row: &usize| {
            *dictionary.value(*row) < IBig::ZERO && dictionary.least_negative(*row, |_| true).is_none()
        };
        let row = (0..dictionary.rows.len()).find(contradicts)?;
        let others = dictionary.basic.iter().enumerate().filter(|(at, _)| *at != row);
        Some(others.map(|(_, &unknown)| unknown).collect())
    }

    /// The independent equations, solved for as many unknowns.
    fn solved(
        columns: &[Vec<IBig>],
        right: &[IBig],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Ended> {
        let row = |at: usize| -> Vec<IBig> {
            primitive(columns.iter().map(|column| column[at].clone()).chain([right[at].clone()]).collect())
        };
        // Each equation begins with an unknown of its own, y_i = t_i - sum t_if y_f, which then leaves.
        let own = columns.len();
        let mut dictionary = Self {
            denominator: IBig::ONE,
            rows: (0..right.len()).map(row).collect(),
            basic: (own..own + right.len()).collect(),
            nonbasic: (0..own).collect(),
            witnesses: Vec::new(),
        };
        while let Some(row) = dictionary.basic.iter().position(|&unknown| unknown >= own) {
            let Some(column) = dictionary.entries(row).iter().position(|entry| !entry.is_zero()) else {
                if !dictionary.value(row).is_zero() {
                    return Err(Ended::Infeasible);
                }
                dictionary.remove_row(row);
                continue;
            };
            dictionary.pivot(row, column, proceed)?;
            dictionary.remove_column(column);
        }
        Ok(dictionary)
    }

    /// Solves `S x = 0` for a symmetric matrix without negative eigenvalues; `None` if it has one, or once
    /// `proceed` is `false`.
    ///
    /// After each pivot on the diagonal, the other rows are a positive multiple of the Schur complement, which
    /// must be semidefinite as well: no diagonal entry is negative, and where it is zero, so is its row.
    pub(super) fn of_semidefinite(matrix: &[Vec<IBig>], proceed: &mut dyn FnMut() -> bool) -> Option<Self> {
        let own = matrix.len();
        let mut dictionary = Self {
            denominator: IBig::ONE,
            rows: matrix.iter().map(|row| row.iter().cloned().chain([IBig::ZERO]).collect()).collect(),
            basic: (own..2 * own).collect(),
            nonbasic: (0..own).collect(),
            witnesses: Vec::new(),
        };
        loop {
            let left = (0..dictionary.rows.len()).filter(|&row| dictionary.basic[row] >= own);
            let diagonal = |row: usize| {
                let at =
                    dictionary.nonbasic.iter().position(|&unknown| unknown == dictionary.basic[row] - own)?;
                Some((row, at))
            };
            let diagonals: Vec<(usize, usize)> = left.filter_map(diagonal).collect();
            if diagonals.iter().any(|&(row, at)| dictionary.rows[row][at] < IBig::ZERO) {
                return None;
            }
            let Some(&(row, at)) = diagonals.iter().find(|&&(row, at)| !dictionary.rows[row][at].is_zero())
            else {
                break;
            };
            dictionary.pivot(row, at, proceed).ok()?;
            dictionary.remove_column(at);
        }
        while let Some(row) = dictionary.basic.iter().position(|&unknown| unknown >= own) {
            if dictionary.entries(row).iter().any(|entry| !entry.is_zero()) {
                return None;
            }
            dictionary.remove_row(row);
        }
        Some(dictionary)
    }

    /// A basis of the solutions if all `t_i` are zero: the vectors in which one nonbasic unknown is not zero.
    pub(super) fn homogeneous_solutions(&self) -> Vec<Vec<IBig>> {
        let unknowns = self.basic.len() + self.nonbasic.len();
        let along = |(column, &own): (usize, &usize)| {
            let mut solution = vec![IBig::ZERO; unknowns];
            solution[own].clone_from(&self.denominator);
            for (row, &unknown) in self.rows.iter().zip(&self.basic) {
                solution[unknown] = -&row[column];
            }
            primitive(solution)
        };
        self.nonbasic.iter().enumerate().map(along).collect()
    }

    /// Pivots until all basic unknowns are nonnegative: the dual simplex method for a zero objective, with the
    /// least index that is negative and the least that can help, which ends (Bland, New finite pivoting rules
    /// for the simplex method, Math. Oper. Res. 2 (1977)).
    fn make_feasible(&mut self, proceed: &mut dyn FnMut() -> bool) -> Result<(), Ended> {
        let negative = |this: &Self| {
            let rows = (0..this.rows.len()).filter(|&row| *this.value(row) < IBig::ZERO);
            rows.min_by_key(|&row| this.basic[row])
        };
        while let Some(row) = negative(self) {
            // All t_if >= 0 and t_i < 0: the row itself proves that there is no y >= 0.
            let column = self.least_negative(row, |_| true).ok_or(Ended::Infeasible)?;
            self.pivot(row, column, proceed)?;
        }
        Ok(())
    }

    /// For every unknown, whether it is positive somewhere: the simplex method with Bland's rule increases one
    /// unknown after the other from zero, until it is positive or its row proves that it stays zero.
    fn find_support(
        &mut self,
        unknowns: usize,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Vec<Known>, Ended> {
        let mut known = vec![Known::Nothing; unknowns];
        self.note_positive(&mut known);
        for unknown in 0..unknowns {
            while known[unknown] == Known::Nothing {
                let improving = match self.basic.iter().position(|&basic| basic == unknown) {
                    Some(row) => self.least_negative(row, |other| known[other] != Known::Zero).ok_or(row),
                    None => Ok(self.nonbasic.iter().take_while(|&&nonbasic| nonbasic != unknown).count()),
                };
                match improving {
                    Ok(column) => self.increase(column, &mut known, proceed)?,
                    Err(row) => self.note_zero(row, &mut known),
                }
            }
        }
        Ok(known)
    }

    /// Increases a nonbasic unknown from zero until a basic one, of least index, becomes zero.
    fn increase(
        &mut self,
        column: usize,
        known: &mut [Known],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<(), Ended> {
        let Some(row) = self.first_to_vanish(column) else {
            known[self.nonbasic[column]] = Known::Positive;
            let growing = (0..self.rows.len()).filter(|&row| self.rows[row][column] < IBig::ZERO);
            growing.for_each(|row| known[self.basic[row]] = Known::Positive);
            self.witness(Some(column));
            return Ok(());
        };
        self.pivot(row, column, proceed)?;
        self.note_positive(known);
        Ok(())
    }

    /// The row whose unknown is the first to vanish when a nonbasic one increases; `None` if none does.
    fn first_to_vanish(&self, column: usize) -> Option<usize> {
        // t_i / t_if as a product, because both t_if are positive.
        let earlier = |&one: &usize, &other: &usize| {
            let (left, right) =
                (self.value(one) * &self.rows[other][column], self.value(other) * &self.rows[one][column]);
            left.cmp(&right).then(self.basic[one].cmp(&self.basic[other]))
        };
        (0..self.rows.len()).filter(|&row| self.rows[row][column] > IBig::ZERO).min_by(earlier)
    }

    fn note_positive(&mut self, known: &mut [Known]) {
        let mut is_new = false;
        for (row, &unknown) in self.basic.iter().enumerate() {
            if !self.value(row).is_zero() {
                is_new |= known[unknown] != Known::Positive;
                known[unknown] = Known::Positive;
            }
        }
        if is_new {
            self.witness(None);
        }
    }

    /// Keeps the present vertex, or the point where a nonbasic unknown that may grow without bound is 1.
    fn witness(&mut self, growing: Option<usize>) {
        let value = |row: usize| match growing {
            Some(column) => self.value(row) - &self.rows[row][column],
            None => self.value(row).clone(),
        };
        let basic = self.basic.iter().enumerate().map(|(row, &unknown)| (unknown, value(row)));
        let grown = growing.map(|column| (self.nonbasic[column], self.denominator.clone()));
        let positive = basic.chain(grown).filter(|(_, value)| !value.is_zero()).collect();
        let denominator = self.denominator.clone();
        self.witnesses.push(Witness { positive, denominator });
    }

    /// Takes points of the cell: what is positive somewhere in it is positive in one of them.
    pub(super) fn take_witnesses(&mut self) -> Vec<Witness> {
        std::mem::take(&mut self.witnesses)
    }

    /// `D y_i + sum t_if y_f = 0` with `t_if >= 0`: the unknowns with positive factors are zero.
    fn note_zero(&self, row: usize, known: &mut [Known]) {
        known[self.basic[row]] = Known::Zero;
        for (entry, &unknown) in self.entries(row).iter().zip(&self.nonbasic) {
            if !entry.is_zero() {
                known[unknown] = Known::Zero;
            }
        }
    }

    /// Removes the unknowns that are zero everywhere.
    fn leave_out(&mut self, known: &[Known], proceed: &mut dyn FnMut() -> bool) -> Result<(), Ended> {
        let is_zero = |unknown: usize| known[unknown] == Known::Zero;
        while let Some(column) = self.nonbasic.iter().position(|&unknown| is_zero(unknown)) {
            self.remove_column(column);
        }
        while let Some(row) = self.basic.iter().position(|&unknown| is_zero(unknown)) {
            if let Some(column) = self.entries(row).iter().position(|entry| !entry.is_zero()) {
                // An equation between the others; its value is zero, so that no other value changes.
                self.pivot(row, column, proceed)?;
                self.remove_column(column);
            } else {
                self.remove_row(row);
            }
        }
        Ok(())
    }

    /// The nonbasic unknown of least index that increases the basic unknown of a row, among those allowed.
    fn least_negative(&self, row: usize, allowed: impl Fn(usize) -> bool) -> Option<usize> {
        let entries = self.entries(row);
        let columns = (0..entries.len()).filter(|&at| entries[at] < IBig::ZERO && allowed(self.nonbasic[at]));
        columns.min_by_key(|&at| self.nonbasic[at])
    }

    /// Exchanges a basic and a nonbasic unknown.
    fn pivot(&mut self, row: usize, column: usize, proceed: &mut dyn FnMut() -> bool) -> Result<(), Ended> {
        let mut own = std::mem::take(&mut self.rows[row]);
        let pivot = std::mem::replace(&mut own[column], self.denominator.clone());
        for (_, other) in self.rows.iter_mut().enumerate().filter(|(at, _)| *at != row) {
            if !proceed() {
                return Err(Ended::Interrupted);
            }
            let factor = std::mem::take(&mut other[column]);
            for (at, (entry, eliminated)) in other.iter_mut().zip(&own).enumerate() {
                if at != column && !(entry.is_zero() && (factor.is_zero() || eliminated.is_zero())) {
                    *entry = (&*entry * &pivot - &factor * eliminated) / &self.denominator;
                }
            }
            other[column] = -factor;
        }
        self.rows[row] = own;
        self.denominator = pivot;
        std::mem::swap(&mut self.basic[row], &mut self.nonbasic[column]);
        if self.denominator < IBig::ZERO {
            self.denominator = -std::mem::take(&mut self.denominator);
            self.rows.iter_mut().flatten().for_each(|entry| *entry = -std::mem::take(entry));
        }
        Ok(())
    }

    fn remove_row(&mut self, row: usize) {
        self.rows.swap_remove(row);
        self.basic.swap_remove(row);
    }

    fn remove_column(&mut self, column: usize) {
        self.nonbasic.remove(column);
        for row in &mut self.rows {
            row.remove(column);
        }
    }

    /// The entries of the nonbasic unknowns.
    fn entries(&self, row: usize) -> &[IBig] {
        &self.rows[row][..self.nonbasic.len()]
    }

    /// The basic unknown of a row, times the [denominator](Self::denominator), where all nonbasic ones vanish.
    pub(super) fn value(&self, row: usize) -> &IBig {
        &self.rows[row][self.nonbasic.len()]
    }

    /// Returns the coefficient of a nonbasic unknown in a row: the loss of the basic unknown per unit of it,
    /// times the [denominator](Self::denominator).
    pub(super) fn entry(&self, row: usize, column: usize) -> &IBig {
        &self.rows[row][column]
    }

    pub(super) fn denominator(&self) -> &IBig {
        &self.denominator
    }

    pub(super) fn basic(&self, row: usize) -> usize {
        self.basic[row]
    }

    pub(super) fn nonbasic(&self, column: usize) -> usize {
        self.nonbasic[column]
    }

    /// The blocks of unknowns that share no equation. They are the same for every basis: the connected
    /// components of the matroid of the columns (Oxley, Matroid Theory, chapter 4).
    pub(super) fn blocks(&self) -> Vec<Block> {
        let mut blocks: Vec<Block> = Vec::new();
        for row in 0..self.rows.len() {
            let meets = |column: &usize| !self.rows[row][*column].is_zero();
            let (joined, apart): (Vec<Block>, Vec<Block>) =
                blocks.into_iter().partition(|block| block.columns.iter().any(meets));
            let known: Vec<usize> = joined.iter().flat_map(|block| block.columns.iter().copied()).collect();
            let new = (0..self.nonbasic.len()).filter(|column| meets(column) && !known.contains(column));
            let rows = joined.iter().flat_map(|block| block.rows.iter().copied()).chain([row]).collect();
            let columns = known.iter().copied().chain(new).collect();
            blocks = apart;
            blocks.push(Block { rows, columns });
        }
        let met: Vec<usize> = blocks.iter().flat_map(|block| block.columns.iter().copied()).collect();
        let free = (0..self.nonbasic.len()).filter(|column| !met.contains(column));
        blocks.extend(free.map(|column| Block { rows: Vec::new(), columns: vec![column] }));
        blocks
    }
}

/// The integers divided by their greatest common divisor.
pub(super) fn primitive(mut numbers: Vec<IBig>) -> Vec<IBig> {
    make_primitive(&mut numbers);
    numbers
}
