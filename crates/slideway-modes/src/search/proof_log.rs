//! Writes the steps of a tree as lines of a proof file (book, "Proof files").

use std::collections::VecDeque;
use std::fmt::{Display, Write as _};
use std::sync::Arc;

use dashu_int::IBig;

use super::proof_cells::{Cell, ProofCells, corners};
use super::share_entries::ShareEntries;
use super::short_vector::{integer, small_integers};
use super::states::StateSet;
use crate::certificate::{Decision, LiftedSystem};
use crate::problem::ContactState;
use crate::solutions::ContactSet;

/// Vectors that are tried again at later nodes.
const TRIED_AGAIN: usize = 256;

/// The proof of one group, as far as it is written.
///
/// Within half-spaces, the systems that are passed to it have another contact for each half-space, whose positive side
/// is the slack: [`ModeProblem::within_half_spaces`](crate::ModeProblem::within_half_spaces).
#[derive(Clone)]
pub(super) struct ProofLog {
    text: String,
    /// The equations without half-spaces.
    own: Arc<LiftedSystem>,
    /// The exponents of the powers of two by which the file multiplies the rows.
    rows: Vec<i32>,
    /// Which of the half-spaces of the node are those of the systems.
    half_spaces: Vec<usize>,
    cells: ProofCells,
    vectors: u64,
    /// The numbers of vectors that exclude nodes, with the columns that they do not exclude.
    recent: VecDeque<(u64, ContactSet)>,
    /// For vectors of problems with jumps; `None` if their numbers are too long.
    shares: Option<ShareEntries>,
    /// Whether something could not be written.
    has_gap: bool,
}

impl ProofLog {
    /// An empty proof for equations whose rows are multiplied by powers of two with these exponents.
    pub(super) fn new(system: LiftedSystem, rows: Vec<i32>) -> Self {
        let shares = ShareEntries::new(&system, &rows);
        let (text, cells, recent) = (String::new(), ProofCells::default(), VecDeque::new());
        let (own, half_spaces) = (Arc::new(system), Vec::new());
        Self { text, own, rows, half_spaces, cells, vectors: 0, recent, shares, has_gap: false }
    }

    /// `g`: a linear form of the unknowns, in integers.
    pub(super) fn form(&mut self, entries: &[IBig]) {
        self.write_line("g", entries);
    }

    /// `s`: a node is divided by whether a combination of forms is at most a limit, or at least.
    pub(super) fn split(&mut self, limit: &IBig, weights: &[IBig]) {
        self.write_line(&format!("s {limit}"), weights);
    }

    /// `f`: a node is excluded by a vector of integers with entries for all of its half-spaces.
    pub(super) fn exclude_within(&mut self, vector: &[IBig]) {
        self.write_line("f", vector);
    }

    /// From now on, the systems are those within some of the half-spaces of a node.
    pub(super) fn enter(&mut self, half_spaces: Vec<usize>) {
        self.rows.truncate(self.own.rows());
        self.rows.resize(self.own.rows() + half_spaces.len(), 0);
        self.half_spaces = half_spaces;
        self.recent.clear();
    }

    /// Whether some step could not be written, so that there will be no proof.
    pub(super) fn has_gap(&self) -> bool {
        self.has_gap
    }

    /// The lines, and the number of cells; `None` if some step could not be written.
    pub(super) fn into_text(self) -> Option<(String, usize)> {
        (!self.has_gap).then(|| self.cells.into_text(&self.text))
    }

    /// `l`: a node is excluded by a vector that is written already. Returns whether there is one.
    pub(super) fn exclude_again(&mut self, allowed: &ContactSet) -> bool {
        let known = self.recent.iter().rev().find(|(_, left)| left.is_disjoint(allowed));
        if let Some((number, _)) = known {
            let _ = writeln!(self.text, "l {number}");
        }
        known.is_some()
    }

    /// `f`: a node is excluded by a vector of integers for the rows of the file that do not belong to shares. It is
    /// known to exclude the allowed sides, and others except those left. Returns whether it could be written:
    /// with jumps, entries for the rows of shares have to be found.
    pub(super) fn exclude(
        &mut self,
        system: &LiftedSystem,
        vector: &[f64],
        mut left: ContactSet,
        allowed: &ContactSet,
    ) -> bool {
        if system.rows() == vector.len() {
            self.write_integers(vector);
        } else if let Some(shares) = &self.shares
            && let Some(vector) = shares.completed(vector, allowed, &mut left)
        {
            self.write_vector('f', &vector);
        } else {
            return false;
        }
        self.try_again(left);
        true
    }

    /// `f`: a node is excluded by a vector whose entries are those of small integers, if they are; for problems
    /// without jumps. Returns whether it is.
    pub(super) fn exclude_by_ratios(
        &mut self,
        system: &LiftedSystem,
        vector: &[f64],
        allowed: &ContactSet,
    ) -> bool {
        if system.rows() != vector.len() || !self.half_spaces.is_empty() {
            return false;
        }
        let Some(whole) = small_integers(vector) else { return false };
        let shift = |row: usize| self.rows[row] - system.exponents()[row];
        let least = (0..whole.len()).map(shift).min().unwrap_or(0);
        let lifted = whole.iter().enumerate().map(|(row, &entry)| {
            IBig::try_from(entry).unwrap_or_default() << usize::try_from(shift(row) - least).unwrap_or(0)
        });
        let lifted: Vec<IBig> = lifted.collect();
        let excess: IBig = lifted.iter().zip(system.right()).map(|(a, b)| a * b).sum();
        let left = not_excluded(system, &lifted);
        if excess <= IBig::ZERO || !left.is_disjoint(allowed) {
            return false;
        }
        self.write_integers(&whole);
        self.try_again(left);
        true
    }

    /// `f`: a node is excluded by a vector for the lifted equations in integers.
    pub(super) fn exclude_exactly(&mut self, system: &LiftedSystem, vector: &[IBig]) {
        let left = not_excluded(system, vector);
        let vector = self.for_rows(system, vector);
        self.write_vector('f', &vector);
        self.try_again(left);
    }

    /// Keeps the vector that was written last, unless it has entries for half-spaces.
    fn try_again(&mut self, left: ContactSet) {
        if !self.half_spaces.is_empty() {
            return;
        }
        self.recent.push_back((self.vectors - 1, left));
        if self.recent.len() > TRIED_AGAIN {
            self.recent.pop_front();
        }
    }

    /// `z`: the unknowns of columns with a negative product vanish. Returns whether the node goes on: the vector
    /// may even exclude it.
    pub(super) fn remove(&mut self, system: &LiftedSystem, vector: &[IBig]) -> bool {
        let right: IBig = vector.iter().zip(system.right()).map(|(a, b)| a * b).sum();
        let step = if right.is_zero() { 'z' } else { 'f' };
        let vector = self.for_rows(system, vector);
        self.write_vector(step, &vector);
        step == 'z'
    }

    /// `b`: a node is divided by the states of a contact, in this order.
    pub(super) fn branch(&mut self, contact: usize, order: &[ContactState]) {
        let letter = |state: &ContactState| match state {
            ContactState::Positive => '+',
            ContactState::Negative => '-',
            ContactState::Gap => '0',
        };
        let order: String = order.iter().map(letter).collect();
        let plain = order == "+-" || order == "+-0";
        let _ = if plain {
            writeln!(self.text, "b {contact}")
        } else {
            writeln!(self.text, "b {contact} {order}")
        };
    }

    /// Whether a pattern has a cell already.
    pub(super) fn has_cell(&self, pattern: &[ContactState]) -> bool {
        self.cells.number_of(pattern).is_some()
    }

    /// `c`: a node whose allowed columns are those of a pattern that has a cell. `reducing` finds the vector that
    /// takes away those of the allowed columns that are positive nowhere in the cell.
    pub(super) fn close(
        &mut self,
        system: &LiftedSystem,
        pattern: &[ContactState],
        allowed: &ContactSet,
        reducing: &mut dyn FnMut(&ContactSet) -> Option<Vec<IBig>>,
    ) {
        let Some(number) = self.cells.number_of(pattern) else { return };
        let support = self.cells.support(number).clone();
        if !self.half_spaces.is_empty() {
            if !self.without_slacks(allowed).is_within(&support) {
                self.cells.keep_pattern(number);
            }
        } else if !allowed.is_within(&support) {
            match reducing(&support) {
                Some(vector) if !self.remove(system, &vector) => return,
                Some(_) => {}
                None => self.cells.keep_pattern(number),
            }
        }
        self.cells.refer('c', number, self.text.len());
    }

    /// A pattern that is decided, for a node that allows only its columns: `x` or `f` if it has no solutions.
    /// Returns whether it has a cell now, for [`close`](Self::close).
    pub(super) fn decided(
        &mut self,
        system: &LiftedSystem,
        pattern: &[ContactState],
        decision: &Decision,
        excluding: &mut dyn FnMut() -> Option<Vec<IBig>>,
    ) -> bool {
        if let Decision::NoSolution { .. } = decision {
            self.text.push_str("x\n");
            return false;
        }
        let Some(corners) = corners(pattern, decision) else {
            self.has_gap = true;
            return false;
        };
        if let Some(cell) = Cell::of(&self.own, pattern, &corners) {
            self.cells.add(pattern, cell);
            return true;
        }
        match excluding() {
            Some(vector) => self.exclude_exactly(system, &vector),
            None => self.has_gap = true,
        }
        false
    }

    /// `m`: all solutions of a monotone problem are those of a pattern. Returns the states that are left;
    /// `None`, with nothing written, if the solutions have too many corners.
    pub(super) fn monotone(
        &mut self,
        pattern: &[ContactState],
        decision: &Decision,
    ) -> Option<Vec<StateSet>> {
        let own = &self.own;
        let cell = Cell::of(own, pattern, &corners(pattern, decision)?)?;
        let is_positive = |contact: usize, state: ContactState| {
            own.columns_of(contact, state).next().is_some_and(|column| cell.support.contains(column))
        };
        let left = pattern.iter().enumerate().map(|(contact, &state)| {
            if is_positive(contact, state) { StateSet::only(state) } else { StateSet::undecided(false) }
        });
        let left = left.collect();
        let number = self.cells.add(pattern, cell);
        self.cells.refer('m', number, self.text.len());
        Some(left)
    }

    /// A vector for the lifted equations as one for the rows of the file, in integers.
    fn for_rows(&self, system: &LiftedSystem, vector: &[IBig]) -> Vec<IBig> {
        let shift = |row: usize| system.exponents()[row] - self.rows[row];
        let least = (0..vector.len()).filter(|&row| !vector[row].is_zero()).map(shift).min().unwrap_or(0);
        let moved = vector.iter().enumerate().map(|(row, entry)| match usize::try_from(shift(row) - least) {
            Ok(shift) => entry << shift,
            // Only where the entry is zero.
            Err(_) => IBig::ZERO,
        });
        let mut moved: Vec<IBig> = moved.collect();
        crate::certificate::make_primitive(&mut moved);
        moved
    }

    /// `f` with a vector of integers of at most 63 bits.
    fn write_integers(&mut self, vector: &[f64]) {
        let integers: Vec<i64> = vector.iter().map(|&entry| integer(entry)).collect();
        self.write_vector('f', &integers);
    }

    /// A vector for the rows of the file and for those of its half-spaces that the systems have.
    fn write_vector<T: Display + Default + PartialEq + Clone>(&mut self, step: char, vector: &[T]) {
        let (own, within) = vector.split_at(vector.len() - self.half_spaces.len());
        let mut entries = own.to_vec();
        for (&at, entry) in self.half_spaces.iter().zip(within) {
            entries.resize(own.len() + at, T::default());
            entries.push(entry.clone());
        }
        let is_numbered = entries[own.len()..].iter().all(|entry| *entry == T::default());
        self.vectors += u64::from(is_numbered);
        self.write_line(&step.to_string(), &entries);
    }

    /// A step with numbers, of which zeros at the end are omitted.
    fn write_line<T: Display + Default + PartialEq>(&mut self, step: &str, numbers: &[T]) {
        self.text.push_str(step);
        let end = numbers.iter().rposition(|number| *number != T::default()).map_or(0, |last| last + 1);
        for number in &numbers[..end] {
            let _ = write!(self.text, " {number}");
        }
        self.text.push('\n');
    }

    /// The columns of the problem among those of a system within half-spaces; without jumps.
    fn without_slacks(&self, columns: &ContactSet) -> ContactSet {
        let contacts = self.own.contacts();
        let size = contacts + self.half_spaces.len();
        let mut real = ContactSet::none_of(self.own.width());
        columns
            .iter()
            .filter(|column| column % size < contacts)
            .for_each(|column| real.insert(column / size * contacts + column % size));
        real
    }
}

/// The columns whose products with a vector are positive.
fn not_excluded(system: &LiftedSystem, vector: &[IBig]) -> ContactSet {
    let mut left = ContactSet::none_of(system.width());
    let entries: Vec<(usize, &IBig)> =
        vector.iter().enumerate().filter(|(_, entry)| !entry.is_zero()).collect();
    for column in 0..system.width() {
        let entries_of_column = system.column(column);
        let terms = entries.iter().filter(|(row, _)| !entries_of_column[*row].is_zero());
        if terms.map(|&(row, entry)| entry * &entries_of_column[row]).sum::<IBig>() > IBig::ZERO {
            left.insert(column);
        }
    }
    left
}
