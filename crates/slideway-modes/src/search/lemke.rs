//! Lemke's method, in floating point: a pattern that should have a solution.

use nalgebra::{DMatrix, DVector};

use crate::dense::Pace;
use crate::problem::{ContactState, ScaledProblem};

/// Entries below this fraction of the largest in their column are not pivoted on.
const PIVOT: f64 = 1e-9;
/// Ratios closer than this are equal, and decided by the next entries of their rows.
const TIE: f64 = 1e-11;

/// A pattern that has a solution, apart from rounding errors, which the caller has to exclude; `None` if the
/// method ends in a ray, or once `proceed` is `false`. For a monotone problem it ends in a ray only if there
/// is no solution (Cottle, Pang and Stone (1992), section 4.4). Jumps are not considered.
pub(super) fn lemke(problem: &ScaledProblem, proceed: &mut dyn FnMut() -> bool) -> Option<Vec<ContactState>> {
    let mut pace = Pace::new(proceed);
    let mut tableau = Tableau::new(problem, &mut pace)?;
    let right = tableau.table.column(tableau.right());
    if right.iter().all(|&value| value >= 0.0) {
        return tableau.pattern();
    }
    let mut entering = tableau.cover(&mut pace)?;
    // Each basis occurs once; most problems take about as many steps as there are contacts.
    for _ in 0..200 * (tableau.contacts + 1) {
        let row = tableau.leaving(entering)?;
        let leaving = tableau.pivot(row, entering, &mut pace)?;
        if leaving == tableau.artificial() {
            return tableau.pattern();
        }
        entering = tableau.partner(leaving);
    }
    None
}

/// The equations `C^+ y^+ + C^- y^- = b + d z_0`, solved for the basic unknowns.
struct Tableau {
    contacts: usize,
    /// Columns of `y^+`, `y^-` and `z_0`, and the right-hand side.
    table: DMatrix<f64>,
    /// The basic unknown of each row.
    basic: Vec<usize>,
    /// The first basic unknowns, whose columns decide between equal ratios.
    first: Vec<usize>,
}

impl Tableau {
    /// Solved for one unknown of each pair, with the largest pivots.
    fn new(problem: &ScaledProblem, pace: &mut Pace<'_>) -> Option<Self> {
        let contacts = problem.contacts();
        let sides = ContactState::PRESSED.into_iter();
        let mut columns: Vec<DVector<f64>> =
            sides.flat_map(|side| (0..contacts).map(move |contact| problem.column(contact, side))).collect();
        columns.push(DVector::zeros(contacts));
        columns.push(problem.system(&vec![ContactState::Positive; contacts]).1);
        let table = DMatrix::from_columns(&columns);
        let mut tableau = Self { contacts, table, basic: vec![usize::MAX; contacts], first: Vec::new() };
        for _ in 0..contacts {
            let (row, column) = tableau.largest_pivot()?;
            tableau.pivot(row, column, pace)?;
        }
        tableau.first.clone_from(&tableau.basic);
        Some(tableau)
    }

    /// The largest entry in the rows and pairs without a basic unknown.
    fn largest_pivot(&self) -> Option<(usize, usize)> {
        let is_free = |contact: usize| {
            !self.basic.iter().any(|&basic| basic == contact || basic == contact + self.contacts)
        };
        let columns = (0..self.contacts).filter(|&contact| is_free(contact));
        let columns: Vec<usize> = columns.flat_map(|contact| [contact, contact + self.contacts]).collect();
        let rows = (0..self.contacts).filter(|&row| self.basic[row] == usize::MAX);
        let places = rows.flat_map(|row| columns.iter().map(move |&column| (row, column)));
        let largest =
            places.max_by(|&one, &other| self.table[one].abs().total_cmp(&self.table[other].abs()))?;
        (self.table[largest] != 0.0).then_some(largest)
    }

    /// Adds `z_0` so that all basic unknowns become nonnegative, and returns the next entering unknown.
    fn cover(&mut self, pace: &mut Pace<'_>) -> Option<usize> {
        self.table.column_mut(self.artificial()).fill(-1.0);
        let row = self.table.column(self.right()).imin();
        let leaving = self.pivot(row, self.artificial(), pace)?;
        Some(self.partner(leaving))
    }

    /// The row whose basic unknown is the first to vanish as another one enters, and lexicographically the first
    /// of several; `None` if none does.
    fn leaving(&self, entering: usize) -> Option<usize> {
        let column = self.table.column(entering);
        let least = PIVOT * column.amax();
        let rows: Vec<usize> = (0..self.contacts).filter(|&row| column[row] > least).collect();
        let ratio = |row: usize, at: usize| self.table[(row, at)] / column[row];
        let mut tied = with_least(rows, |row| ratio(row, self.right()).max(0.0));
        if let Some(&row) = tied.iter().find(|&&row| self.basic[row] == self.artificial()) {
            return Some(row);
        }
        for &at in &self.first {
            if tied.len() <= 1 {
                break;
            }
            tied = with_least(tied, |row| ratio(row, at));
        }
        tied.first().copied()
    }

    /// Exchanges the basic unknown of a row, which is returned.
    fn pivot(&mut self, row: usize, entering: usize, pace: &mut Pace<'_>) -> Option<usize> {
        if !pace.allows(self.table.len()) {
            return None;
        }
        let inverse = self.table[(row, entering)].recip();
        self.table.row_mut(row).scale_mut(inverse);
        let mut factors = self.table.column(entering).into_owned();
        factors[row] = 0.0;
        for mut column in self.table.column_iter_mut() {
            let scale = column[row];
            if scale != 0.0 {
                column.axpy(-scale, &factors, 1.0);
            }
        }
        Some(std::mem::replace(&mut self.basic[row], entering))
    }

    /// The side of each contact that is basic.
    fn pattern(&self) -> Option<Vec<ContactState>> {
        let state = |contact: usize| {
            let is_basic = |at: usize| self.basic.contains(&at);
            match [is_basic(contact), is_basic(contact + self.contacts)] {
                [true, false] => Some(ContactState::Positive),
                [false, true] => Some(ContactState::Negative),
                _ => None,
            }
        };
        (0..self.contacts).map(state).collect()
    }

    fn partner(&self, unknown: usize) -> usize {
        if unknown < self.contacts { unknown + self.contacts } else { unknown - self.contacts }
    }

    fn artificial(&self) -> usize {
        2 * self.contacts
    }

    fn right(&self) -> usize {
        2 * self.contacts + 1
    }
}

/// The rows for which a number is least.
fn with_least(rows: Vec<usize>, number: impl Fn(usize) -> f64) -> Vec<usize> {
    let least = rows.iter().map(|&row| number(row)).fold(f64::INFINITY, f64::min);
    rows.into_iter().filter(|&row| number(row) <= least + TIE * least.abs().max(1.0)).collect()
}
