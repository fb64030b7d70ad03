//! Writes the steps of a tree as lines of a proof file (book, "Proof files").

use std::collections::VecDeque;
use std::fmt::Write as _;

use dashu_int::IBig;

use super::states::StateSet;
use crate::certificate::{Decision, LiftedSystem, decide_while};
use crate::problem::{ContactState, ProblemView};

/// Vectors that are tried again at later nodes.
const TRIED_AGAIN: usize = 8;

/// The proof of one group, as far as it is written.
#[derive(Clone)]
pub(super) struct ProofLog {
    text: String,
    /// The exponents of the powers of two by which the file multiplies the rows.
    rows: Vec<i32>,
    cells: Vec<Vec<ContactState>>,
    vectors: u64,
    recent: VecDeque<(u64, Vec<f64>)>,
    /// Whether something could not be written.
    has_gap: bool,
}

impl ProofLog {
    /// An empty proof for equations whose rows are multiplied by powers of two with these exponents.
    pub(super) fn new(rows: Vec<i32>) -> Self {
        let (text, cells, recent) = (String::new(), Vec::new(), VecDeque::new());
        Self { text, rows, cells, vectors: 0, recent, has_gap: false }
    }

    /// The lines, and the number of cells; `None` if some step could not be written.
    pub(super) fn into_text(self) -> Option<(String, usize)> {
        (!self.has_gap).then_some((self.text, self.cells.len()))
    }

    /// The number of a recent vector that passes a test.
    pub(super) fn known(&self, test: impl Fn(&[f64]) -> bool) -> Option<u64> {
        self.recent.iter().rev().find(|(_, vector)| test(vector)).map(|(number, _)| *number)
    }

    /// `l`: a node is excluded by a vector that is written already.
    pub(super) fn exclude_again(&mut self, vector: u64) {
        let _ = writeln!(self.text, "l {vector}");
    }

    /// `f`: a node is excluded by a vector for the rows of the file.
    pub(super) fn exclude(&mut self, vector: Vec<f64>) {
        let whole: Vec<IBig> =
            vector.iter().map(|&entry| IBig::try_from(entry).unwrap_or_default()).collect();
        self.write_vector('f', &whole);
        self.recent.push_back((self.vectors - 1, vector));
        if self.recent.len() > TRIED_AGAIN {
            self.recent.pop_front();
        }
    }

    /// `f`: a node is excluded by a vector for the lifted equations in integers.
    pub(super) fn exclude_exactly(&mut self, system: &LiftedSystem, vector: &[IBig]) {
        let vector = self.for_rows(system, vector);
        self.write_vector('f', &vector);
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

    /// A node that allows only the columns of one pattern: `c` if it has solutions, otherwise `x` or `f`.
    pub(super) fn pattern(
        &mut self,
        system: &LiftedSystem,
        problem: ProblemView<'_>,
        pattern: &[ContactState],
        excluding: &mut dyn FnMut(&[StateSet]) -> Option<Vec<IBig>>,
    ) {
        if let Some(known) = self.cells.iter().position(|cell| cell == pattern) {
            let _ = writeln!(self.text, "c {known}");
            return;
        }
        let decision = decide_while(problem, pattern, &mut || true).map(|verdict| verdict.decision);
        if let Some(Decision::NoSolution { .. }) = decision {
            self.text.push_str("x\n");
            return;
        }
        match decision.and_then(|decision| corners(pattern, &decision)) {
            Some(corners) if !corners.is_empty() => {
                self.cell(system, pattern, &corners);
                let _ = writeln!(self.text, "c {}", self.cells.len() - 1);
            }
            Some(_) => {
                let states: Vec<StateSet> = pattern.iter().map(|&state| StateSet::only(state)).collect();
                match excluding(&states) {
                    Some(vector) => self.exclude_exactly(system, &vector),
                    None => self.has_gap = true,
                }
            }
            None => self.has_gap = true,
        }
    }

    /// `cell` and `m`: all solutions of a monotone problem are those of a pattern. Returns the states that are
    /// left; `None`, with nothing written, if the solutions have too many corners.
    pub(super) fn monotone(
        &mut self,
        system: &LiftedSystem,
        problem: ProblemView<'_>,
        pattern: &[ContactState],
    ) -> Option<Vec<StateSet>> {
        let decision = decide_while(problem, pattern, &mut || true)?.decision;
        let corners = corners(pattern, &decision).filter(|corners| !corners.is_empty())?;
        let positive = self.cell(system, pattern, &corners);
        let _ = writeln!(self.text, "m {}", self.cells.len() - 1);
        let left = |(&state, positive): (&ContactState, &[bool; 2])| {
            if positive[0] { StateSet::only(state) } else { StateSet::undecided(false) }
        };
        Some(pattern.iter().zip(&positive).map(left).collect())
    }

    /// `cell`: a pattern and the unknowns that are positive at some of its points and directions. Returns which
    /// are positive at one of those that are written.
    fn cell(
        &mut self,
        system: &LiftedSystem,
        pattern: &[ContactState],
        corners: &[Vec<[bool; 2]>],
    ) -> Vec<[bool; 2]> {
        self.text.push_str("cell");
        let columns = |keep: &dyn Fn(usize, usize) -> bool| -> String {
            let contacts = pattern.iter().enumerate().flat_map(|(contact, &state)| {
                let columns = system.columns_of(contact, state).enumerate();
                columns.filter(move |&(at, _)| keep(contact, at)).map(|(_, column)| column)
            });
            contacts.fold(String::new(), |mut line, column| {
                let _ = write!(line, " {column}");
                line
            })
        };
        self.text.push_str(&columns(&|_, _| true));
        let mut covered = vec![[false; 2]; pattern.len()];
        for corner in corners {
            // More than what shows all columns and one point of the cell is not needed.
            let is_new = covered.iter().zip(corner).any(|(all, own)| (0..2).any(|at| own[at] && !all[at]));
            if is_new || corner == &corners[0] {
                self.text.push_str(" /");
                self.text.push_str(&columns(&|contact, at| corner[contact][at]));
                covered
                    .iter_mut()
                    .zip(corner)
                    .for_each(|(all, own)| (0..2).for_each(|at| all[at] |= own[at]));
            }
        }
        self.text.push('\n');
        self.cells.push(pattern.to_vec());
        covered
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

    fn write_vector(&mut self, step: char, vector: &[IBig]) {
        self.text.push(step);
        let end = vector.iter().rposition(|entry| !entry.is_zero()).map_or(0, |last| last + 1);
        for entry in &vector[..end] {
            let _ = write!(self.text, " {entry}");
        }
        self.text.push('\n');
        self.vectors += 1;
    }
}

/// The unknowns of each contact (`y`, or `lambda` in a gap, and then the share of its jump, or `1 - lambda`)
/// that are positive at the points and directions of a decided pattern, points first; `None` if unknown.
fn corners(pattern: &[ContactState], decision: &Decision) -> Option<Vec<Vec<[bool; 2]>>> {
    let in_gap = |contact: usize| pattern[contact] == ContactState::Gap;
    match decision {
        Decision::NoSolution { .. } => Some(Vec::new()),
        Decision::Solution { .. } => Some(vec![vec![[true; 2]; pattern.len()]]),
        Decision::Boundary { zero, full_share, .. } => {
            let positive = |contact| [!zero.contains(&contact), !full_share.contains(&contact)];
            Some(vec![(0..pattern.len()).map(positive).collect()])
        }
        Decision::Singular { set } => {
            if *set == crate::certificate::ExactSet::NotComputed {
                return None;
            }
            let at = |point: &Vec<dashu_ratio::RBig>, is_point: bool| {
                let one = |(contact, value): (usize, &dashu_ratio::RBig)| {
                    let rest = if in_gap(contact) { !value.is_one() } else { true };
                    [!value.is_zero(), is_point && rest]
                };
                point.iter().enumerate().map(one).collect()
            };
            let points = set.vertices().into_iter().map(|point| at(point, true));
            Some(points.chain(set.directions().into_iter().map(|point| at(point, false))).collect())
        }
        Decision::Undecided { .. } => None,
    }
}
