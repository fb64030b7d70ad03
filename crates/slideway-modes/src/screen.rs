//! Small problems one after another in reused memory.
//!
//! A sweep asks for the solutions of very many problems with the same few contacts. Nearly all of them are
//! far from any boundary, where elimination alone decides every pattern. This tree allocates nothing, and
//! gives up the whole problem as soon as a pattern is within [`SLACK`] of a boundary or of `D = 0`: such a
//! problem needs the careful search.

use crate::problem::{ContactState, ModeProblem, OpenContacts, Side};

/// Largest number of contacts.
pub const MOST_CONTACTS: usize = 8;
/// Unknowns within this fraction of the size of their terms are in doubt.
pub const SLACK: f64 = 1e-9;
/// A pivot below this fraction of its column's largest entry leaves the problem in doubt.
const SUSPECT_PIVOT: f64 = 1e-7;
/// The right-hand side, and three columns for each contact.
const WIDTH: usize = 1 + 3 * MOST_CONTACTS;

type Square = [[f64; MOST_CONTACTS]; MOST_CONTACTS];

/// The numbers of a mode problem, rewritten for every problem. The first index is that of the contact.
#[derive(Debug, Clone)]
pub struct SmallProblem {
    contacts: usize,
    /// `c_k^+` and `c_k^-`.
    pub columns: [Square; 2],
    /// `d_k^+` and `d_k^-`.
    pub jumps: [Square; 2],
    /// `N(0)`.
    pub right_hand_side: [f64; MOST_CONTACTS],
    /// The size to which the relative accuracy of `N(0)` refers, if it is greater than `N(0)` itself.
    pub load: f64,
}

/// A state of all contacts that solves the problem, strictly inside its pattern.
#[derive(Debug, Clone, Copy)]
pub struct SmallState {
    /// The state of every contact.
    pub pattern: [ContactState; MOST_CONTACTS],
    /// `y_k`, or the share `lambda_k` of a contact in its gap.
    pub unknowns: [f64; MOST_CONTACTS],
    /// Whether the determinant of the pattern's equations is negative.
    pub negative_determinant: bool,
}

/// A pattern is too close to a boundary, or to `D = 0`, for elimination to decide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InDoubt;

impl SmallProblem {
    /// A problem of zeros.
    ///
    /// # Panics
    /// If there are more than [`MOST_CONTACTS`].
    pub fn new(contacts: usize) -> Self {
        assert!(contacts <= MOST_CONTACTS, "a small problem");
        Self {
            contacts,
            columns: [[[0.0; MOST_CONTACTS]; MOST_CONTACTS]; 2],
            jumps: [[[0.0; MOST_CONTACTS]; MOST_CONTACTS]; 2],
            right_hand_side: [0.0; MOST_CONTACTS],
            load: 0.0,
        }
    }

    /// Takes over the numbers of a mode problem with as many contacts; [`Self::load`] stays.
    pub fn copy(&mut self, problem: &ModeProblem) {
        for (index, side) in Side::BOTH.into_iter().enumerate() {
            let (columns, jumps) = (problem.columns(side), problem.jumps(side));
            for contact in 0..self.contacts {
                for row in 0..self.contacts {
                    self.columns[index][contact][row] = columns[(row, contact)];
                    self.jumps[index][contact][row] = jumps[(row, contact)];
                }
            }
        }
        let load = problem.right_hand_side().iter().take(self.contacts);
        self.right_hand_side.iter_mut().zip(load).for_each(|(target, load)| *target = *load);
    }

    fn has_jump(&self, contact: usize) -> bool {
        let [positive, negative] = [0, 1].map(|side| &self.jumps[side][contact][..self.contacts]);
        positive != negative
    }

    /// Matrix (columns) and right-hand side of a pattern.
    fn system(&self, pattern: &[ContactState]) -> (Square, [f64; MOST_CONTACTS]) {
        let mut matrix = [[0.0; MOST_CONTACTS]; MOST_CONTACTS];
        let mut load = self.right_hand_side;
        for (contact, state) in pattern.iter().enumerate() {
            let side = match state {
                ContactState::Positive => 0,
                ContactState::Negative | ContactState::Gap => 1,
            };
            for row in 0..self.contacts {
                load[row] += self.jumps[side][contact][row];
                matrix[contact][row] = if *state == ContactState::Gap {
                    self.jumps[1][contact][row] - self.jumps[0][contact][row]
                } else {
                    self.columns[side][contact][row]
                };
            }
        }
        (matrix, load)
    }
}

/// The equations that remain at one level. A row holds the right-hand side first and then the columns of the
/// undecided contacts, the last contact first, so that the row of the next level is the beginning of the row
/// of this one.
#[derive(Debug, Clone)]
struct Level {
    rows: [[f64; WIDTH]; MOST_CONTACTS],
    pivot_row: [f64; WIDTH],
    pivot: f64,
    /// Position of the chosen column in the rows of earlier levels.
    column: usize,
    /// Position of `d_k^+ - d_k^-`, if it is part of the right-hand side.
    jump: Option<usize>,
    negative: bool,
}

/// Reused memory, with the results found in it.
#[derive(Debug, Clone)]
pub struct Screen {
    contacts: usize,
    levels: Vec<Level>,
    has_jump: [bool; MOST_CONTACTS],
    smallest_pivots: [[f64; 3]; MOST_CONTACTS],
    largest_load: f64,
    slack: f64,
    pattern: [ContactState; MOST_CONTACTS],
    states: Vec<SmallState>,
    open: OpenContacts,
}

impl Screen {
    /// Memory for problems with this many contacts.
    pub fn new(contacts: usize) -> Self {
        let level = Level {
            rows: [[0.0; WIDTH]; MOST_CONTACTS],
            pivot_row: [0.0; WIDTH],
            pivot: 1.0,
            column: 0,
            jump: None,
            negative: false,
        };
        Self {
            contacts,
            levels: vec![level; contacts + 1],
            has_jump: [false; MOST_CONTACTS],
            smallest_pivots: [[0.0; 3]; MOST_CONTACTS],
            largest_load: 0.0,
            slack: SLACK,
            pattern: [ContactState::Positive; MOST_CONTACTS],
            states: Vec::new(),
            open: OpenContacts::default(),
        }
    }

    /// Leaves out the patterns whose open contacts leave the others unable to hold: their determinants vanish.
    #[must_use]
    pub fn with_open(mut self, open: OpenContacts) -> Self {
        self.open = open;
        self
    }

    /// All solutions and gap states in the order of enumeration, if every pattern is far from any boundary.
    /// `accuracy` is the relative accuracy of the problem's numbers.
    ///
    /// # Errors
    /// [`InDoubt`] if some pattern is close to a boundary.
    pub fn states(&mut self, problem: &SmallProblem, accuracy: f64) -> Result<&[SmallState], InDoubt> {
        self.states.clear();
        self.slack = SLACK.max(accuracy);
        self.load(problem);
        self.descend(0)?;
        for index in 0..self.states.len() {
            let pattern = self.states[index].pattern;
            let pattern = &pattern[..self.contacts];
            refine(problem, pattern, &mut self.states[index])?;
        }
        Ok(&self.states)
    }

    fn start(&self, contact: usize) -> usize {
        1 + 3 * (self.contacts - 1 - contact)
    }

    fn load(&mut self, problem: &SmallProblem) {
        let contacts = self.contacts;
        self.largest_load = problem.load;
        for contact in 0..contacts {
            self.has_jump[contact] = problem.has_jump(contact);
        }
        for row in 0..contacts {
            let mut base = problem.right_hand_side[row];
            let mut size = base.abs();
            for contact in 0..contacts {
                let [positive, negative] = [0, 1].map(|side| problem.jumps[side][contact][row]);
                base += negative;
                size += positive.abs().max(negative.abs());
                let start = self.start(contact);
                let target = &mut self.levels[0].rows[row];
                target[start] = problem.columns[0][contact][row];
                target[start + 1] = problem.columns[1][contact][row];
                target[start + 2] = if self.has_jump[contact] { positive - negative } else { 0.0 };
            }
            self.levels[0].rows[row][0] = base;
            self.largest_load = self.largest_load.max(size);
        }
        for contact in 0..contacts {
            let start = self.start(contact);
            for index in 0..3 {
                let rows = self.levels[0].rows[..contacts].iter();
                let size = rows.map(|row| row[start + index].abs()).fold(0.0, f64::max);
                self.smallest_pivots[contact][index] = SUSPECT_PIVOT * size;
            }
        }
    }

    fn descend(&mut self, level: usize) -> Result<(), InDoubt> {
        if level == self.contacts {
            return self.leaf();
        }
        for (index, state) in ContactState::ALL.into_iter().enumerate() {
            if state == ContactState::Gap && !self.has_jump[level] {
                continue;
            }
            self.pattern[level] = state;
            if state == ContactState::Gap && !self.open.holds(&self.pattern[..=level]) {
                continue;
            }
            self.eliminate(level, index)?;
            self.descend(level + 1)?;
        }
        Ok(())
    }

    fn eliminate(&mut self, level: usize, index: usize) -> Result<(), InDoubt> {
        let start = self.start(level);
        let count = self.contacts - level;
        let with_jump = index == 0 && self.has_jump[level];
        let smallest = self.smallest_pivots[level][index];
        let (above, below) = self.levels.split_at_mut(level + 1);
        let (node, child) = (&mut above[level], &mut below[0]);
        node.column = start + index;
        node.jump = with_jump.then_some(start + 2);
        let mut pivot_at = 0;
        for row in 1..count {
            if node.rows[row][node.column].abs() > node.rows[pivot_at][node.column].abs() {
                pivot_at = row;
            }
        }
        let pivot = node.rows[pivot_at][node.column];
        if pivot.abs() <= smallest || !pivot.is_finite() {
            return Err(InDoubt);
        }
        // A contact in its gap has the column -(d_k^+ - d_k^-).
        node.pivot = if index == 2 { -pivot } else { pivot };
        child.negative = node.negative ^ (node.pivot < 0.0) ^ (pivot_at != 0);
        node.pivot_row[..start].copy_from_slice(&node.rows[pivot_at][..start]);
        if let Some(jump) = node.jump {
            node.pivot_row[0] += node.rows[pivot_at][jump];
        }
        for at in 1..count {
            let row = &node.rows[if at == pivot_at { 0 } else { at }];
            let factor = row[node.column] / pivot;
            let target = &mut child.rows[at - 1];
            for ((target, entry), eliminated) in
                target[..start].iter_mut().zip(&row[..start]).zip(&node.pivot_row[..start])
            {
                *target = entry - factor * eliminated;
            }
            if let Some(jump) = node.jump {
                target[0] += row[jump];
            }
        }
        Ok(())
    }

    /// Back-substitution that stops at the first unknown that is certainly out of range.
    fn leaf(&mut self) -> Result<(), InDoubt> {
        let mut unknowns = [0.0; MOST_CONTACTS];
        let mut sizes = [0.0; MOST_CONTACTS];
        let mut in_doubt = false;
        for contact in (0..self.contacts).rev() {
            let node = &self.levels[contact];
            let mut value = node.pivot_row[0];
            let mut size = value.abs().max(self.largest_load);
            for later in contact + 1..self.contacts {
                let choice = &self.levels[later];
                let sign = if self.pattern[later] == ContactState::Gap { -1.0 } else { 1.0 };
                let coefficient = sign * node.pivot_row[choice.column];
                value -= coefficient * unknowns[later];
                size += coefficient.abs() * sizes[later];
                if let Some(jump) = choice.jump {
                    value += node.pivot_row[jump];
                }
            }
            let (unknown, size) = (value / node.pivot, size / node.pivot.abs());
            let slack = self.slack * size;
            let is_gap = self.pattern[contact] == ContactState::Gap;
            let slack = if is_gap { slack + self.slack } else { slack };
            if unknown < -slack || is_gap && unknown > 1.0 + slack {
                return Ok(());
            }
            // NaN is in doubt, too.
            let inside = unknown > slack && (!is_gap || unknown < 1.0 - slack);
            in_doubt |= !inside;
            unknowns[contact] = unknown;
            sizes[contact] = size;
        }
        if in_doubt {
            return Err(InDoubt);
        }
        let negative_determinant = self.levels[self.contacts].negative;
        self.states.push(SmallState { pattern: self.pattern, unknowns, negative_determinant });
        Ok(())
    }
}

/// Solves the equations of a pattern again, with partial pivoting and one step of iterative refinement.
fn refine(problem: &SmallProblem, pattern: &[ContactState], state: &mut SmallState) -> Result<(), InDoubt> {
    let count = pattern.len();
    let (matrix, load) = problem.system(pattern);
    let mut residual = [0.0; MOST_CONTACTS];
    for row in 0..count {
        let product: f64 = (0..count).map(|k| matrix[k][row] * state.unknowns[k]).sum();
        residual[row] = load[row] - product;
    }
    let correction = solve(matrix, residual, count).ok_or(InDoubt)?;
    for (unknown, correction) in state.unknowns.iter_mut().zip(correction) {
        *unknown += correction;
    }
    if state.unknowns[..count].iter().all(|unknown| unknown.is_finite() && *unknown > 0.0) {
        Ok(())
    } else {
        Err(InDoubt)
    }
}

/// Gaussian elimination with partial pivoting; `None` if a pivot vanishes.
fn solve(mut matrix: Square, mut load: [f64; MOST_CONTACTS], count: usize) -> Option<[f64; MOST_CONTACTS]> {
    for step in 0..count {
        let mut pivot_at = step;
        for row in step + 1..count {
            if matrix[step][row].abs() > matrix[step][pivot_at].abs() {
                pivot_at = row;
            }
        }
        if matrix[step][pivot_at] == 0.0 {
            return None;
        }
        if pivot_at != step {
            matrix[step..count].iter_mut().for_each(|column| column.swap(step, pivot_at));
            load.swap(step, pivot_at);
        }
        for row in step + 1..count {
            let factor = matrix[step][row] / matrix[step][step];
            for column in &mut matrix[step + 1..count] {
                column[row] -= factor * column[step];
            }
            load[row] -= factor * load[step];
        }
    }
    for step in (0..count).rev() {
        load[step] /= matrix[step][step];
        for row in 0..step {
            load[row] -= matrix[step][row] * load[step];
        }
    }
    Some(load)
}

impl SmallState {
    /// The normal force of a contact.
    pub fn normal_force(&self, contact: usize) -> f64 {
        match self.pattern[contact].side() {
            Some(Side::Positive) => self.unknowns[contact],
            Some(Side::Negative) => -self.unknowns[contact],
            None => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enumeration::enumerate;
    use crate::random_numbers::random_numbers;
    use crate::solutions::Limits;
    use nalgebra::{DMatrix, DVector};

    fn small(problem: &ModeProblem) -> SmallProblem {
        let mut small = SmallProblem::new(problem.contacts());
        small.copy(problem);
        small
    }

    /// The oracle is the enumeration, which solves every pattern by a separate factorization.
    #[test]
    fn it_finds_what_the_enumeration_finds() {
        let mut random = random_numbers(7);
        let (mut decided, mut found, mut gaps) = (0, 0, 0);
        for round in 0..3000 {
            let contacts = 1 + round % 5;
            let mut matrix = |diagonal: f64, size: f64| {
                DMatrix::from_fn(contacts, contacts, |i, k| {
                    if i == k { diagonal + size * random() } else { size * random() }
                })
            };
            let columns = [matrix(1.0, 0.9), matrix(-1.0, 0.9)];
            let jumps = if round % 2 == 0 {
                [matrix(0.0, 0.0), matrix(0.0, 0.0)]
            } else {
                [matrix(0.0, 0.5), matrix(0.0, 0.5)]
            };
            let load = DVector::from_fn(contacts, |_, _| random());
            let [cp, cn] = columns;
            let [dp, dn] = jumps;
            let problem = ModeProblem::new(cp, cn, dp, dn, load).expect("finite numbers");
            let mut screen = Screen::new(contacts);
            let Ok(states) = screen.states(&small(&problem), 0.0) else { continue };
            decided += 1;
            let all = enumerate(&problem, &Limits::default()).expect("few patterns");
            let (in_gap, pressed): (Vec<&SmallState>, Vec<&SmallState>) =
                states.iter().partition(|state| state.pattern[..contacts].contains(&ContactState::Gap));
            assert_eq!((pressed.len(), in_gap.len()), (all.solutions.len(), all.gaps.len()), "round {round}");
            for (state, solution) in pressed.iter().zip(&all.solutions) {
                for k in 0..contacts {
                    let error = (state.normal_force(k) - solution.normal_force[k]).abs();
                    assert!(error <= solution.tolerance.max(1e-13), "round {round}: {error}");
                }
                assert_eq!(state.negative_determinant, solution.determinant < 0.0, "round {round}");
            }
            for (state, gap) in in_gap.iter().zip(&all.gaps) {
                for share in &gap.shares {
                    assert!((state.unknowns[share.contact] - share.lambda).abs() < 1e-9, "round {round}");
                }
            }
            found += pressed.len();
            gaps += in_gap.len();
        }
        assert!(decided > 2900 && found > 2000 && gaps > 500, "{decided}, {found}, {gaps}");
    }

    #[test]
    fn boundaries_and_locking_are_in_doubt() {
        let mut problem = SmallProblem::new(1);
        problem.columns = [1.0, -1.0].map(|sign| {
            let mut columns = [[0.0; MOST_CONTACTS]; MOST_CONTACTS];
            columns[0][0] = sign;
            columns
        });
        assert!(Screen::new(1).states(&problem, 0.0).is_err(), "no load: the contact is between its sides");
        problem.right_hand_side[0] = 1.0;
        assert!(Screen::new(1).states(&problem, 0.0).is_ok());
        problem.load = 2e9;
        assert!(
            Screen::new(1).states(&problem, 0.0).is_err(),
            "what is left of loads that balance each other"
        );
        problem.load = 0.0;
        problem.columns[0][0][0] = 0.0;
        assert!(Screen::new(1).states(&problem, 0.0).is_err(), "the determinant vanishes");
        problem.columns[0][0][0] = f64::NAN;
        assert!(Screen::new(1).states(&problem, 0.0).is_err(), "not a number");
    }
}
