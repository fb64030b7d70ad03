//! Batches in which every coefficient changes from point to point.

use super::super::problem::{BySide, Side};
use super::kernel::{self, Points, Visitor, Workspace, numerator_index};
use super::lanes::{LANES, Lanes, product_plus};
use super::{BatchError, BatchSolutions, MOST_CONTACTS};

/// Mode problems of one size, which have jumps at the same contacts.
#[derive(Debug, Clone)]
pub struct CoefficientBatch {
    contacts: usize,
    /// The contacts with a jump.
    jumping: Vec<usize>,
    program: Vec<Node>,
    /// For each number of columns: the terms of every minor, sets of rows in increasing order.
    expansions: Vec<Vec<Term>>,
}

/// The numbers of all points, coefficient by coefficient: with `n` points, the entry in row `i`
/// and column `k` (both from 0) of point `p` stands at `(k r + i) n + p`.
#[derive(Debug, Clone)]
pub struct PointCoefficients<'a> {
    /// The columns `c_k` of both sides (`r r n` numbers each).
    pub columns: BySide<&'a [f64]>,
    /// The jump vectors `d_k` of both sides, likewise. Those of contacts without a jump are not
    /// looked at; may be empty if there are no jumps.
    pub jumps: BySide<&'a [f64]>,
    /// The right-hand side `N(0)` (`r n` numbers, entry `i` of point `p` at `i n + p`); it includes
    /// the jump vectors of contacts at which they are equal.
    pub right_hand_side: &'a [f64],
}

/// A column that is added to those of the node above; nodes stand in the order of a walk through
/// the tree.
#[derive(Debug, Clone, Copy)]
struct Node {
    /// How many columns there are with this one.
    columns: usize,
    /// First of the column's numbers.
    column: usize,
    /// Where the determinant belongs: twice if it holds for both sides of a contact, but has a
    /// place for each.
    values: Option<[usize; 2]>,
}

#[derive(Debug, Clone, Copy)]
struct Term {
    row: usize,
    /// The minor of one column less, without this row.
    minor: usize,
}

/// Builds the list of nodes.
struct Planner<'a> {
    contacts: usize,
    order: &'a [usize],
    both_sides: bool,
    /// Contacts with a jump whose sides are given by the bits of `chosen`.
    fixed: usize,
    chosen: usize,
    program: Vec<Node>,
}

impl Planner<'_> {
    fn descend(&mut self, level: usize, pattern: usize, replaced: Option<usize>) {
        let Some(&contact) = self.order.get(level) else { return };
        let sides = if level < self.fixed {
            let side = self.chosen >> level & 1;
            side..side + 1
        } else {
            0..2
        };
        for side in sides.clone() {
            let column = (side * self.contacts + contact) * self.contacts;
            self.add(level, column, pattern | side << contact, replaced);
        }
        if replaced.is_none() {
            let side = sides.start;
            // Right-hand sides stand after the columns, one for each choice of sides with jumps.
            let column = (2 * self.contacts + self.chosen) * self.contacts;
            self.add(level, column, pattern | side << contact, Some(contact));
        }
    }

    fn add(&mut self, level: usize, column: usize, pattern: usize, replaced: Option<usize>) {
        let is_leaf = level + 1 == self.contacts;
        let values = match replaced {
            None => [pattern; 2],
            Some(contact) => {
                let jumps = self.order[..self.fixed].contains(&contact);
                let other = if self.both_sides && !jumps { pattern | 1 << contact } else { pattern };
                [pattern, other].map(|pattern| {
                    (1 << self.contacts) + numerator_index(self.contacts, self.both_sides, contact, pattern)
                })
            }
        };
        self.program.push(Node { columns: level + 1, column, values: is_leaf.then_some(values) });
        self.descend(level + 1, pattern, replaced);
    }
}

impl CoefficientBatch {
    /// Problems with the given number of contacts, whose right-hand side jumps at `jumping`.
    ///
    /// # Errors
    /// [`BatchError`] if there are no or too many contacts, or a contact does not exist or is listed
    /// twice.
    ///
    /// ```
    /// use slideway_modes::BySide;
    /// use slideway_modes::batch::{BatchSolutions, CoefficientBatch, PointCoefficients};
    /// // x + b |x| = 3 for b = 0, 2 and -2: columns sigma + b.
    /// let batch = CoefficientBatch::new(1, &[])?;
    /// let points = PointCoefficients {
    ///     columns: BySide { positive: &[1.0, 3.0, -1.0], negative: &[-1.0, 1.0, -3.0] },
    ///     jumps: BySide::same(&[]),
    ///     right_hand_side: &[3.0; 3],
    /// };
    /// let mut solutions = BatchSolutions::default();
    /// batch.solve(&points, &mut solutions)?;
    /// assert_eq!(solutions.masks(), [0b01, 0b11, 0b00]);
    /// # Ok::<(), slideway_modes::batch::BatchError>(())
    /// ```
    pub fn new(contacts: usize, jumping: &[usize]) -> Result<Self, BatchError> {
        if !(1..=MOST_CONTACTS).contains(&contacts) {
            return Err(BatchError::Contacts { contacts });
        }
        for (at, &contact) in jumping.iter().enumerate() {
            if contact >= contacts || jumping[..at].contains(&contact) {
                return Err(BatchError::Varied { contact });
            }
        }
        // Contacts with a jump come first, so that the right-hand side is known early.
        let mut order = jumping.to_vec();
        order.extend((0..contacts).filter(|contact| !jumping.contains(contact)));
        let mut planner = Planner {
            contacts,
            order: &order,
            both_sides: !jumping.is_empty(),
            fixed: jumping.len(),
            chosen: 0,
            program: Vec::new(),
        };
        for chosen in 0..1 << jumping.len() {
            planner.chosen = chosen;
            planner.descend(0, 0, None);
        }
        let program = planner.program;
        let expansions = (0..=contacts).map(|columns| expansion(contacts, columns)).collect();
        Ok(Self { contacts, jumping: jumping.to_vec(), program, expansions })
    }

    /// Finds the patterns that have a solution at every point.
    ///
    /// # Errors
    /// [`BatchError::Length`] if a list does not fit the contacts and the number of points, which
    /// is taken from the right-hand side.
    pub fn solve(
        &self,
        points: &PointCoefficients<'_>,
        solutions: &mut BatchSolutions,
    ) -> Result<(), BatchError> {
        self.run(points, solutions, None)
    }

    /// The same, and calls `visit(point, pattern, y)` for each solution, points and patterns in
    /// increasing order; accuracy as with [`FrictionBatch`](super::FrictionBatch::solve_each).
    ///
    /// # Errors
    /// As for [`solve`](Self::solve).
    pub fn solve_each(
        &self,
        points: &PointCoefficients<'_>,
        solutions: &mut BatchSolutions,
        mut visit: impl FnMut(usize, usize, &[f64]),
    ) -> Result<(), BatchError> {
        self.run(points, solutions, Some(&mut |state| visit(state.point, state.pattern, state.y)))
    }

    fn run(
        &self,
        points: &PointCoefficients<'_>,
        solutions: &mut BatchSolutions,
        visitor: Option<Visitor<'_>>,
    ) -> Result<(), BatchError> {
        let points = self.checked(points)?;
        solutions.reset(self.contacts, points.count);
        kernel::run(&Points::All(points), solutions, visitor);
        Ok(())
    }

    fn checked<'a>(&'a self, points: &'a PointCoefficients<'a>) -> Result<AllPoints<'a>, BatchError> {
        let contacts = self.contacts;
        let found = points.right_hand_side.len();
        let count = found / contacts;
        let fits = |found: usize, expected: usize| {
            if found == expected { Ok(()) } else { Err(BatchError::Length { expected, found }) }
        };
        fits(found, count * contacts)?;
        for side in Side::BOTH {
            fits(points.columns.get(side).len(), contacts * contacts * count)?;
            if !self.jumping.is_empty() {
                fits(points.jumps.get(side).len(), contacts * contacts * count)?;
            }
        }
        Ok(AllPoints { batch: self, points, count })
    }
}

/// The terms of all minors of a number of columns: the row of the entry in the last column, from
/// the largest row down with alternating signs, and the minor of the columns before.
fn expansion(contacts: usize, columns: usize) -> Vec<Term> {
    let sets = |size: usize| (0..1_usize << contacts).filter(move |rows| rows.count_ones() as usize == size);
    let mut terms = Vec::new();
    for rows in sets(columns) {
        for row in (0..contacts).rev().filter(|row| rows >> row & 1 == 1) {
            let without = rows & !(1 << row);
            let minor = sets(columns - 1).take_while(|&other| other != without).count();
            terms.push(Term { row, minor });
        }
    }
    terms
}

/// A batch with its points.
pub(super) struct AllPoints<'a> {
    batch: &'a CoefficientBatch,
    points: &'a PointCoefficients<'a>,
    count: usize,
}

impl AllPoints<'_> {
    /// Columns of both sides, then the right-hand side for every choice of sides with jumps.
    #[inline(always)]
    fn load(&self, points: &[usize; LANES], work: &mut Workspace) {
        let contacts = self.batch.contacts;
        let square = contacts * contacts;
        let gather = |values: &[f64], at: usize, lanes: &mut Lanes| {
            for (lane, &point) in lanes.0.iter_mut().zip(points) {
                *lane = values[at * self.count + point];
            }
        };
        for (index, side) in Side::BOTH.into_iter().enumerate() {
            for at in 0..square {
                gather(self.points.columns.get(side), at, &mut work.loaded[index * square + at]);
            }
        }
        let first = 2 * square;
        for row in 0..contacts {
            gather(self.points.right_hand_side, row, &mut work.loaded[first + row]);
        }
        // N(0) + sum_k d_k^{sigma_k}: each contact with a jump doubles the list.
        work.load_size = sum_of_sizes(&work.loaded[first..first + contacts]);
        let mut filled = 1;
        for &contact in &self.batch.jumping {
            let mut sizes = [Lanes::ZERO; 2];
            for row in 0..contacts {
                let mut jumps = [Lanes::ZERO; 2];
                for (side, (jump, size)) in Side::BOTH.into_iter().zip(jumps.iter_mut().zip(&mut sizes)) {
                    gather(self.points.jumps.get(side), contact * contacts + row, jump);
                    add_size(size, jump);
                }
                for choice in 0..filled {
                    let at = first + choice * contacts + row;
                    let mut negative = work.loaded[at];
                    for lane in 0..LANES {
                        work.loaded[at].0[lane] += jumps[0].0[lane];
                        negative.0[lane] += jumps[1].0[lane];
                    }
                    work.loaded[at + filled * contacts] = negative;
                }
            }
            for lane in 0..LANES {
                work.load_size.0[lane] += larger(sizes[0].0[lane], sizes[1].0[lane]);
            }
            filled *= 2;
        }
        for contact in 0..contacts {
            let column = |side: usize| &work.loaded[side * square + contact * contacts..][..contacts];
            let (positive, negative) = (sum_of_sizes(column(0)), sum_of_sizes(column(1)));
            for lane in 0..LANES {
                work.column_sizes[contact].0[lane] = larger(positive.0[lane], negative.0[lane]);
            }
        }
    }
}

#[inline(always)]
fn sum_of_sizes(values: &[Lanes]) -> Lanes {
    let mut sum = Lanes::ZERO;
    for value in values {
        add_size(&mut sum, value);
    }
    sum
}

#[inline(always)]
fn add_size(sum: &mut Lanes, value: &Lanes) {
    for lane in 0..LANES {
        sum.0[lane] += value.0[lane].abs();
    }
}

/// The larger one; what is not a number stays so.
#[inline(always)]
fn larger(one: f64, other: f64) -> f64 {
    if one > other || one.is_nan() { one } else { other }
}

impl AllPoints<'_> {
    pub(super) fn contacts(&self) -> usize {
        self.batch.contacts
    }

    pub(super) fn points(&self) -> usize {
        self.count
    }

    pub(super) fn both_sides(&self) -> bool {
        !self.batch.jumping.is_empty()
    }

    pub(super) fn workspace(&self) -> Workspace {
        let contacts = self.batch.contacts;
        let values = (1 << contacts) + (contacts << (contacts - usize::from(!self.both_sides())));
        let loaded = contacts * (2 * contacts + (1 << self.batch.jumping.len()));
        let minors = |columns: usize| self.batch.expansions[columns].len() / columns.max(1);
        Workspace {
            values: vec![Lanes::ZERO; values],
            loaded: vec![Lanes::ZERO; loaded],
            scratch: (0..=contacts).map(|columns| vec![Lanes::ZERO; minors(columns)]).collect(),
            column_sizes: [Lanes::ZERO; MOST_CONTACTS],
            load_size: Lanes::ZERO,
            relative_error: kernel::rounding(contacts),
        }
    }

    #[inline(always)]
    pub(super) fn evaluate<const FUSED: bool>(&self, points: &[usize; LANES], work: &mut Workspace) {
        self.load(points, work);
        let contacts = self.batch.contacts;
        for node in &self.batch.program {
            let column = &work.loaded[node.column..][..contacts];
            let (above, below) = work.scratch.split_at_mut(node.columns);
            let minors = &mut below[0][..];
            let above = &above[node.columns - 1][..];
            let terms = &self.batch.expansions[node.columns][..];
            match node.columns {
                2 => expand::<FUSED, 2>(terms, column, above, minors),
                3 => expand::<FUSED, 3>(terms, column, above, minors),
                4 => expand::<FUSED, 4>(terms, column, above, minors),
                5 => expand::<FUSED, 5>(terms, column, above, minors),
                6 => expand::<FUSED, 6>(terms, column, above, minors),
                7 => expand::<FUSED, 7>(terms, column, above, minors),
                8 => expand::<FUSED, 8>(terms, column, above, minors),
                _ => minors.copy_from_slice(column),
            }
            for value in node.values.into_iter().flatten() {
                work.values[value] = minors[0];
            }
        }
    }
}

/// All minors of a number of columns, by the last one.
#[inline(always)]
fn expand<const FUSED: bool, const COLUMNS: usize>(
    terms: &[Term],
    column: &[Lanes],
    above: &[Lanes],
    minors: &mut [Lanes],
) {
    let (terms, _) = terms.as_chunks::<COLUMNS>();
    for (minor, terms) in minors.iter_mut().zip(terms) {
        let factors = terms.map(|term| (&column[term.row].0, &above[term.minor].0));
        let mut sums = Lanes::ZERO;
        for lane in 0..LANES {
            let mut sum = factors[0].0[lane] * factors[0].1[lane];
            for at in 1..COLUMNS {
                let sign = if at % 2 == 1 { -1.0 } else { 1.0 };
                sum = product_plus::<FUSED>(sign * factors[at].0[lane], factors[at].1[lane], sum);
            }
            sums.0[lane] = sum;
        }
        *minor = sums;
    }
}
