//! The elimination tree over all patterns.

use nalgebra::DVector;

use crate::findings::{Findings, TooManySolutions};
use crate::problem::{ContactState, ModeProblem, ScaledProblem};
use crate::solutions::{Limits, Solutions};

/// A pivot below this fraction of its column's largest entry makes the patterns below suspect.
pub(crate) const SUSPECT_PIVOT: f64 = 1e-7;
/// Negative values within this fraction of the size of their terms are left to the careful solution.
pub(crate) const SLACK: f64 = 1e-9;

/// A problem too large for the limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EnumerationError {
    /// More contacts than the limit.
    #[error("{contacts} contacts, but the limit for trying all patterns is {limit}")]
    TooManyContacts {
        /// Contacts of the problem.
        contacts: usize,
        /// [`Limits::contacts`], or 63 if that is less.
        limit: usize,
    },
    /// More patterns than the limit, because of contacts with a jump.
    #[error(
        "{patterns} patterns of {contacts} contacts, {with_jump} of them with preload gaps, but the limit is {limit}"
    )]
    TooManyPatterns {
        /// Contacts of the problem.
        contacts: usize,
        /// Contacts at which the right-hand side jumps.
        with_jump: usize,
        /// `2^(r-j) 3^j`.
        patterns: u64,
        /// [`Limits::patterns`].
        limit: u64,
    },
    /// More solutions than the limit.
    #[error("more than {limit} patterns give a solution")]
    TooManySolutions {
        /// [`Limits::solutions`].
        limit: usize,
    },
}

impl From<TooManySolutions> for EnumerationError {
    fn from(TooManySolutions { limit }: TooManySolutions) -> Self {
        Self::TooManySolutions { limit }
    }
}

/// All solutions of a mode problem, and the outcome of every pattern.
///
/// Tries every `sigma` of `sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k}, y >= 0` (Klepp
/// (2002), eqs. (6) and (8)) and, for contacts at which the right-hand side jumps, the states
/// between their faces. Forces in the result have the unit of `N(0)`. The module's documentation
/// states tolerances.
///
/// # Errors
/// [`EnumerationError`] if the problem is larger than `limits`.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::{enumerate, Limits, ModeProblem};
/// // w = M z + q with the solutions z = (0, 0), (1, 0), (0, 1) and (1, 1).
/// let m = dmatrix![-1.0, 0.0; 0.0, -1.0];
/// let problem = ModeProblem::from_linear_complementarity(&m, dvector![1.0, 1.0])?;
/// let solutions = enumerate(&problem, &Limits::default())?;
/// assert_eq!(solutions.counts.total(), 4);
/// assert_eq!(solutions.solutions.len(), 4);
/// assert_eq!(solutions.solutions[1].normal_force, dvector![1.0, -1.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn enumerate(problem: &ModeProblem, limits: &Limits) -> Result<Solutions, EnumerationError> {
    let contacts = problem.contacts();
    // Patterns are held in the bits of a u64.
    let limit = limits.contacts.min(63);
    if contacts > limit {
        return Err(EnumerationError::TooManyContacts { contacts, limit });
    }
    let scaled = ScaledProblem::new(problem);
    let (_, patterns) = scaled.patterns_from(0);
    if patterns > limits.patterns {
        let with_jump = scaled.has_jump.iter().filter(|&&jump| jump).count();
        let limit = limits.patterns;
        return Err(EnumerationError::TooManyPatterns { contacts, with_jump, patterns, limit });
    }
    let mut tree = PatternTree::new(&scaled, limits);
    if contacts == 0 {
        tree.leaf()?;
    } else {
        tree.descend(0)?;
    }
    Ok(tree.findings.into_solutions())
}

/// The equations that remain at one level, and the pivot row of the branch that is being followed.
///
/// A row holds the right-hand side first and then the columns of the undecided contacts, the last
/// contact first, so that the row of the next level is the beginning of the row of this one.
struct Level {
    rows: Vec<f64>,
    width: usize,
    pivot_row: Vec<f64>,
    pivot: f64,
    /// Position of the chosen column in the rows of earlier levels, and its sign.
    column: usize,
    orientation: f64,
    /// Position of `d_k^+ - d_k^-`, if it is part of the right-hand side.
    jump: Option<usize>,
    /// Product of the pivots above this level.
    determinant: f64,
}

struct PatternTree<'a> {
    problem: &'a ScaledProblem,
    /// Where the columns of each contact start in a row: `c_k^+`, `c_k^-`, and `d_k^+ - d_k^-` if there is a
    /// jump.
    starts: Vec<usize>,
    /// The smallest pivot that is not suspect, per contact and column.
    smallest_pivots: Vec<[f64; 3]>,
    levels: Vec<Level>,
    pattern: Vec<ContactState>,
    in_gap: usize,
    largest_load: f64,
    y: Vec<f64>,
    sizes: Vec<f64>,
    findings: Findings<'a>,
}

impl<'a> PatternTree<'a> {
    fn new(problem: &'a ScaledProblem, limits: &Limits) -> Self {
        let contacts = problem.contacts();
        let mut starts = vec![1; contacts];
        for contact in (0..contacts.saturating_sub(1)).rev() {
            starts[contact] = starts[contact + 1] + problem.states(contact + 1).len();
        }
        let width = starts.first().map_or(1, |start| start + problem.states(0).len());
        let mut levels: Vec<Level> = (0..=contacts)
            .map(|level| {
                let width = if level == 0 { width } else { starts[level - 1] };
                Level::new(contacts - level, width, starts.get(level).copied().unwrap_or(0))
            })
            .collect();
        let mut smallest_pivots = vec![[0.0; 3]; contacts];
        for contact in 0..contacts {
            for (index, &state) in problem.states(contact).iter().enumerate() {
                let column = problem.column(contact, state);
                smallest_pivots[contact][index] = SUSPECT_PIVOT * column.amax();
                // The tree carries d_k^+ - d_k^-; `Level::orientation` gives the sign of a gap's column.
                let sign = state_orientation(state);
                write_column(&mut levels[0].rows, width, starts[contact] + index, &(column * sign));
            }
        }
        write_column(&mut levels[0].rows, width, 0, problem.base());
        Self {
            problem,
            starts,
            smallest_pivots,
            levels,
            pattern: vec![ContactState::Positive; contacts],
            in_gap: 0,
            largest_load: problem.load_size().amax(),
            y: vec![0.0; contacts],
            sizes: vec![0.0; contacts],
            findings: Findings::new(problem, limits),
        }
    }

    /// Visits all patterns with the given states of the contacts before `level`.
    fn descend(&mut self, level: usize) -> Result<(), EnumerationError> {
        for (index, &state) in self.problem.states(level).iter().enumerate() {
            self.pattern[level] = state;
            self.in_gap += usize::from(state == ContactState::Gap);
            if !self.eliminate(level, index, state) {
                self.findings.examine_all_below(&mut self.pattern, level + 1)?;
            } else if level + 1 == self.pattern.len() {
                self.leaf()?;
            } else {
                self.descend(level + 1)?;
            }
            self.in_gap -= usize::from(state == ContactState::Gap);
        }
        Ok(())
    }

    /// Eliminates the column of a state from the rows of a level, with row pivoting. Returns `false` if the
    /// pivot is suspect.
    fn eliminate(&mut self, level: usize, index: usize, state: ContactState) -> bool {
        let start = self.starts[level];
        let (above, below) = self.levels.split_at_mut(level + 1);
        let (node, child) = (&mut above[level], &mut below[0]);
        let width = node.width;
        node.column = start + index;
        node.orientation = state_orientation(state);
        let with_jump = state == ContactState::Positive && self.problem.has_jump[level];
        node.jump = with_jump.then_some(start + 2);

        let (pivot_at, size) = largest_entry(&node.rows, width, node.column);
        if size <= self.smallest_pivots[level][index] {
            return false;
        }
        let pivot_row = &node.rows[pivot_at * width..][..width];
        let pivot = pivot_row[node.column];
        node.pivot = pivot * node.orientation;
        node.pivot_row.copy_from_slice(&pivot_row[..start]);
        if let Some(jump) = node.jump {
            node.pivot_row[0] += pivot_row[jump];
        }
        // The pivot row changes places with the first one.
        let swap = if pivot_at == 0 { 1.0 } else { -1.0 };
        child.determinant =
            node.determinant * swap * node.pivot * self.problem.determinant_factor(level, state);

        let rows = node.rows.chunks_exact(width).enumerate().skip(1);
        for ((at, row), target) in rows.zip(child.rows.chunks_exact_mut(start)) {
            let row = if at == pivot_at { &node.rows[..width] } else { row };
            let factor = row[node.column] / pivot;
            for ((target, &entry), &eliminated) in target.iter_mut().zip(row).zip(&node.pivot_row) {
                *target = entry - factor * eliminated;
            }
            if let Some(jump) = node.jump {
                target[0] += row[jump];
            }
        }
        true
    }

    fn leaf(&mut self) -> Result<(), EnumerationError> {
        if self.in_gap == 0 {
            self.findings.offer_closest(&self.pattern, self.levels[self.pattern.len()].determinant);
        }
        if self.findings.count_unloaded(&self.pattern) {
            Ok(())
        } else if self.may_be_solution() {
            Ok(self.findings.examine_candidate(&self.pattern, &mut || true)?)
        } else {
            self.findings.count_no_solution(self.in_gap > 0);
            Ok(())
        }
    }

    /// Back-substitution that stops at the first `y` that is certainly out of range.
    fn may_be_solution(&mut self) -> bool {
        let contacts = self.pattern.len();
        for contact in (0..contacts).rev() {
            let node = &self.levels[contact];
            let mut value = node.pivot_row[0];
            let mut size = value.abs().max(self.largest_load);
            for later in contact + 1..contacts {
                let choice = &self.levels[later];
                let coefficient = choice.orientation * node.pivot_row[choice.column];
                value -= coefficient * self.y[later];
                size += coefficient.abs() * self.sizes[later];
                if let Some(jump) = choice.jump {
                    value += node.pivot_row[jump];
                }
            }
            let (y, size) = (value / node.pivot, size / node.pivot.abs());
            let beyond_gap = self.pattern[contact] == ContactState::Gap && y > 1.0 + SLACK * (1.0 + size);
            if y < -SLACK * size || beyond_gap {
                return false;
            }
            self.y[contact] = y;
            self.sizes[contact] = size;
        }
        true
    }
}

impl Level {
    fn new(row_count: usize, width: usize, child_width: usize) -> Self {
        Self {
            rows: vec![0.0; row_count * width],
            width,
            pivot_row: vec![0.0; child_width],
            pivot: 1.0,
            column: 0,
            orientation: 1.0,
            jump: None,
            determinant: 1.0,
        }
    }
}

/// The sign with which the carried column of a state enters the equations: a contact in its gap
/// has the column `-(d_k^+ - d_k^-)`.
fn state_orientation(state: ContactState) -> f64 {
    if state == ContactState::Gap { -1.0 } else { 1.0 }
}

/// Row and size of the largest entry of a column.
fn largest_entry(rows: &[f64], width: usize, column: usize) -> (usize, f64) {
    let mut largest = (0, 0.0);
    for (at, row) in rows.chunks_exact(width).enumerate() {
        if row[column].abs() > largest.1 {
            largest = (at, row[column].abs());
        }
    }
    largest
}

fn write_column(rows: &mut [f64], width: usize, column: usize, values: &DVector<f64>) {
    for (row, &value) in rows.chunks_exact_mut(width).zip(values) {
        row[column] = value;
    }
}
