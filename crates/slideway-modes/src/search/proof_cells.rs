//! The cells of a proof file.

use std::collections::HashMap;
use std::fmt::Write as _;

use crate::certificate::{Decision, ExactSet, LiftedSystem};
use crate::problem::ContactState;
use crate::solutions::ContactSet;

/// Which unknowns of each contact are positive at a point or in a direction: `y`, or `lambda` in a gap, and then the
/// share of its jump, or `1 - lambda`.
pub(super) type Corner = Vec<[bool; 2]>;

/// All solutions of one pattern.
#[derive(Clone)]
pub(super) struct Cell {
    /// The columns that are positive in some of them.
    pub(super) support: ContactSet,
    /// The columns of the pattern.
    columns: ContactSet,
    /// The columns that are positive at points and, after the first one, in directions that together use the
    /// whole support.
    generators: Vec<ContactSet>,
    /// Whether the cell contains others, as it is more than a point.
    is_continuum: bool,
    /// Whether some node that it closes allows columns beyond the support.
    keeps_pattern: bool,
}

/// The cells of a proof, and where the text refers to them.
#[derive(Clone, Default)]
pub(super) struct ProofCells {
    cells: Vec<Cell>,
    numbers: HashMap<Vec<ContactState>, usize>,
    references: Vec<Reference>,
}

/// A line that names a cell.
#[derive(Clone)]
struct Reference {
    step: char,
    cell: usize,
    /// Where in the text it belongs.
    at: usize,
}

impl Cell {
    /// The cell of a pattern with these corners; `None` if there are none.
    pub(super) fn of(system: &LiftedSystem, pattern: &[ContactState], corners: &[Corner]) -> Option<Self> {
        let columns = |keep: &dyn Fn(usize, usize) -> bool| {
            let mut columns = ContactSet::none_of(system.width());
            for (contact, &state) in pattern.iter().enumerate() {
                let kept = system.columns_of(contact, state).enumerate().filter(|&(at, _)| keep(contact, at));
                kept.for_each(|(_, column)| columns.insert(column));
            }
            columns
        };
        let (mut support, mut generators) = (ContactSet::none_of(system.width()), Vec::new());
        for corner in corners {
            let generator = columns(&|contact, at| corner[contact][at]);
            // More than what shows all columns and one point of the cell is not needed.
            if generators.is_empty() || !generator.is_within(&support) {
                generator.iter().for_each(|column| support.insert(column));
                generators.push(generator);
            }
        }
        let columns = columns(&|_, _| true);
        let is_continuum = corners.len() > 1;
        let cell = Self { support, columns, generators, is_continuum, keeps_pattern: false };
        (!corners.is_empty()).then_some(cell)
    }

    /// Adds `cell`, the columns and those of each generator.
    fn write(&self, text: &mut String) {
        let mut list = |step: &str, columns: &ContactSet| {
            text.push_str(step);
            for column in columns.iter() {
                let _ = write!(text, " {column}");
            }
        };
        let columns = if self.keeps_pattern { &self.columns } else { &self.support };
        list("cell", columns);
        if self.generators[..] != [columns.clone()] {
            self.generators.iter().for_each(|generator| list(" /", generator));
        }
        text.push('\n');
    }
}

impl ProofCells {
    /// The number of the cell of a pattern.
    pub(super) fn number_of(&self, pattern: &[ContactState]) -> Option<usize> {
        self.numbers.get(pattern).copied()
    }

    /// The columns that are positive somewhere in a cell.
    pub(super) fn support(&self, number: usize) -> &ContactSet {
        &self.cells[number].support
    }

    /// Adds the cell of a pattern and returns its number.
    pub(super) fn add(&mut self, pattern: &[ContactState], cell: Cell) -> usize {
        self.cells.push(cell);
        self.numbers.insert(pattern.to_vec(), self.cells.len() - 1);
        self.cells.len() - 1
    }

    /// Lists a cell with all columns of its pattern: some node that it closes allows more than its support.
    pub(super) fn keep_pattern(&mut self, number: usize) {
        self.cells[number].keeps_pattern = true;
    }

    /// Names a cell in a line of the given step, which follows the first `at` bytes of the text.
    pub(super) fn refer(&mut self, step: char, cell: usize, at: usize) {
        self.references.push(Reference { step, cell, at });
    }

    /// The cells that are not part of others, the text with references to them, and their number.
    pub(super) fn into_text(self, text: &str) -> (String, usize) {
        let whole = self.wholes();
        let mut numbers = vec![None; self.cells.len()];
        let (mut complete, mut count) = (String::with_capacity(text.len() + 16 * self.references.len()), 0);
        for (at, cell) in self.cells.iter().enumerate().filter(|&(at, _)| whole[at] == at) {
            cell.write(&mut complete);
            numbers[at] = Some(count);
            count += 1;
        }
        let mut written = 0;
        for Reference { step, cell, at } in self.references {
            complete.push_str(&text[written..at]);
            written = at;
            if let Some(number) = numbers[whole[cell]] {
                let _ = writeln!(complete, "{step} {number}");
            }
        }
        complete.push_str(&text[written..]);
        (complete, count)
    }

    /// The cell that takes the place of each: the cell itself, or a largest one that contains it.
    fn wholes(&self) -> Vec<usize> {
        let mut first = HashMap::new();
        let mut continua: Vec<usize> =
            (0..self.cells.len()).filter(|&at| self.cells[at].is_continuum).collect();
        continua.sort_by_key(|&at| std::cmp::Reverse(self.cells[at].support.len()));
        let whole = |at: usize| {
            let own = &self.cells[at];
            let same = *first.entry(&own.support).or_insert(at);
            let larger = continua.iter().find(|&&other| {
                let support = &self.cells[other].support;
                support != &own.support && own.support.is_within(support)
            });
            match larger {
                _ if own.keeps_pattern => at,
                Some(&larger) => larger,
                None => same,
            }
        };
        (0..self.cells.len()).map(whole).collect()
    }
}

/// The points and directions of a decided pattern, points first; `None` if they are unknown.
pub(super) fn corners(pattern: &[ContactState], decision: &Decision) -> Option<Vec<Corner>> {
    let in_gap = |contact: usize| pattern[contact] == ContactState::Gap;
    match decision {
        Decision::NoSolution { .. } => Some(Vec::new()),
        Decision::Solution { .. } => Some(vec![vec![[true; 2]; pattern.len()]]),
        Decision::Boundary { zero, full_share, .. } => {
            let positive = |contact| [!zero.contains(&contact), !full_share.contains(&contact)];
            Some(vec![(0..pattern.len()).map(positive).collect()])
        }
        Decision::Singular { set } => {
            if matches!(set, ExactSet::NotComputed | ExactSet::Product(_)) {
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
