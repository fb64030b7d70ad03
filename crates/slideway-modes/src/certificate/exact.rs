//! The exact outcome of one pattern, in rational numbers.

use std::cmp::Ordering;

use dashu_int::ops::BitTest;
use dashu_int::{IBig, UBig};
use dashu_ratio::{RBig, Relaxed};
use nalgebra::DMatrix;

use super::cramer::Cramer;
use super::elimination::{IntegerSystem, sign_of};
use super::enclosure::enclose_solution;
use super::polyhedron::ExactSet;
use crate::interval::{Interval, Sign};
use crate::interval_matrix::IntervalMatrix;
use crate::problem::{ContactState, ModeProblem, ProblemView};

/// The exact solutions of the equations of one pattern.
#[derive(Debug, Clone, PartialEq)]
pub enum ExactOutcome {
    /// `D != 0`: one solution of the equations, admissible or not.
    Regular {
        /// The sign of `D`: `Negative` or `Positive`.
        determinant: Sign,
        /// `y_k`, or the share `lambda_k` of a contact in its gap.
        unknowns: Vec<RBig>,
    },
    /// `D = 0`, and these solutions are admissible.
    Singular(ExactSet),
}

/// Solves the equations of one pattern in rational arithmetic, for the numbers as given.
///
/// `unknowns` are in the order of the contacts. If the pattern is singular, its set of admissible solutions
/// (`y >= 0`, `0 <= lambda <= 1`) is described by up to `most` vertices and extreme directions; if it has
/// more, or more have to be held in between, it is an [`ExactSet::Product`]. Numbers grow to about `53 r`
/// bits, and the work for a regular pattern grows about like `r^4` to `r^5`.
///
/// # Panics
/// If the pattern does not have one state per contact.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::certificate::{solve_exactly, ExactOutcome, ExactSet};
/// use slideway_modes::{ContactState, ModeProblem};
/// let problem =
///     ModeProblem::from_linear_complementarity(&dmatrix![1.0, -1.0; -1.0, 1.0], dvector![-1.0, 1.0])?;
/// let outcome = solve_exactly(&problem, &[ContactState::Positive; 2], 1000);
/// assert!(matches!(outcome, ExactOutcome::Singular(ExactSet::Ray { .. })));
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn solve_exactly(problem: &ModeProblem, pattern: &[ContactState], most: usize) -> ExactOutcome {
    assert_eq!(pattern.len(), problem.contacts(), "one state per contact");
    let system = IntegerSystem::new(problem, pattern);
    if let Some(solved) = system.solve() {
        let determinant = solved.determinant_sign();
        return ExactOutcome::Regular { determinant, unknowns: solved.fractions().concat() };
    }
    let Some(set) = ExactSet::of_system(&system, pattern, most, &mut || true) else {
        unreachable!("nothing stops it")
    };
    ExactOutcome::Singular(set)
}

/// Solves `A X = R` in rational arithmetic, for the numbers as given: the columns of `X`. Returns `None` if `A` is singular.
pub(crate) fn solve_matrix_exactly(matrix: &DMatrix<f64>, right: &DMatrix<f64>) -> Option<Vec<Vec<RBig>>> {
    IntegerSystem::of_matrices(matrix, right).solve().map(Cramer::fractions)
}

/// The exact unknowns of a solution of a pattern's equations that is known but for rounding, for one contact and those
/// that act on it.
///
/// `is_zero` says which unknowns are exactly zero; the columns of the others must be independent, as those of a vertex
/// and of a regular pattern are. Returns contacts in increasing order, each with `y_k`, or the share `lambda_k` in its
/// gap; `None` if more than `most` have to be solved for together, or if the columns are dependent.
///
/// # Panics
/// If the pattern does not have one state per contact.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::certificate::solve_part_exactly;
/// use slideway_modes::{ContactState, ModeProblem};
/// // The second pair does not act on the first.
/// let m = dmatrix![2.0, 0.0; 1.0, 1.0];
/// let problem = ModeProblem::from_linear_complementarity(&m, dvector![-4.0, -1.0])?;
/// let pattern = [ContactState::Positive, ContactState::Negative];
/// let part = solve_part_exactly(&problem, &pattern, &[false; 2], 0, 48).expect("few contacts");
/// assert_eq!((part.len(), part[0].0, part[0].1.to_f64().value()), (1, 0, 2.0));
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn solve_part_exactly(
    problem: &ModeProblem,
    pattern: &[ContactState],
    is_zero: &[bool],
    contact: usize,
    most: usize,
) -> Option<Vec<(usize, RBig)>> {
    assert_eq!(pattern.len(), problem.contacts(), "one state per contact");
    let own = closed_part(problem, (pattern, is_zero), contact, most)?;
    let all: Vec<usize> = (0..pattern.len()).collect();
    let others: Vec<usize> = all.iter().copied().filter(|&contact| !is_zero[contact]).collect();
    // Of a singular pattern, further equations may be needed to tell the unknowns apart.
    let systems = [(own.clone(), own), (all, others)].into_iter().filter(|(rows, _)| rows.len() <= most);
    for (rows, columns) in systems {
        if let Some(solved) = IntegerSystem::of(problem, pattern, &rows, &columns).solve() {
            return Some(columns.into_iter().zip(solved.fractions().concat()).collect());
        }
    }
    None
}

/// A contact and all others that act on it in a pattern, directly or through others, but not those whose unknowns are
/// zero, in increasing order; `None` if they are more than `most`.
fn closed_part(
    problem: &ModeProblem,
    (pattern, is_zero): (&[ContactState], &[bool]),
    contact: usize,
    most: usize,
) -> Option<Vec<usize>> {
    let view = ProblemView::from(problem);
    let acts = |other: usize, row: usize| {
        view.matrix_terms(other, pattern[other]).any(|(term, _)| term.centre[row] != 0.0)
    };
    let mut part = vec![contact];
    let mut followed = 0;
    while let Some(&row) = part.get(followed).filter(|_| part.len() <= most) {
        let acting = (0..is_zero.len()).filter(|&other| !is_zero[other] && acts(other, row));
        let new: Vec<usize> = acting.filter(|other| !part.contains(other)).collect();
        part.extend(new);
        followed += 1;
    }
    part.sort_unstable();
    (part.len() <= most).then_some(part)
}

/// Encloses `b_k + s_k y_k` for one contact and those that act on it, given the numbers `b_k` and signs `s_k` of all: of a
/// solution of a regular pattern, as [`solve_part_exactly`], for any number of contacts.
///
/// These sums are the unknowns of the equations, with `sum c_k s_k b_k` on the right-hand side: what is large in both
/// cancels before anything is rounded.
pub(crate) fn enclose_sums(
    problem: &ModeProblem,
    (pattern, is_zero): (&[ContactState], &[bool]),
    contact: usize,
    shifts: &[(f64, f64)],
) -> Option<Vec<(usize, Interval)>> {
    let own = closed_part(problem, (pattern, is_zero), contact, usize::MAX)?;
    let system = IntegerSystem::of(problem, pattern, &own, &own);
    let (columns, right) = system.columns();
    let exact = |value: f64| RBig::try_from(value).ok();
    let shifts: Vec<(f64, RBig)> =
        own.iter().map(|&at| Some((shifts[at].1, exact(shifts[at].0)?))).collect::<Option<_>>()?;
    // Rows of integers, divided by the size of their largest entry.
    let bits = |row: usize| columns.iter().map(|column| column[row].bit_len()).max().unwrap_or(0);
    let units: Vec<RBig> =
        (0..own.len()).map(|row| RBig::from_parts(IBig::ONE, UBig::ONE << bits(row))).collect();
    let load = |row: usize| {
        let terms = columns.iter().zip(&shifts).filter(|(_, (_, bound))| !bound.is_zero());
        let terms = terms.map(|(column, (sign, bound))| {
            let term = RBig::from(column[row].clone()) * bound;
            if *sign < 0.0 { -term } else { term }
        });
        Interval::around_ratio(
            &(terms.fold(RBig::from(right[row].clone()), |sum, term| sum + term) * &units[row]),
        )
    };
    let entry = |row: usize, column: usize| {
        let entry = Interval::around_ratio(&(RBig::from(columns[column][row].clone()) * &units[row]));
        if shifts[column].0 < 0.0 { -entry } else { entry }
    };
    let size = own.len();
    let matrix = IntervalMatrix::from_intervals(&DMatrix::from_fn(size, size, entry))?;
    let right = IntervalMatrix::from_intervals(&DMatrix::from_fn(size, 1, |row, _| load(row)))?;
    let solution = enclose_solution(&matrix, &right)?.solution;
    Some(own.into_iter().enumerate().map(|(at, contact)| (contact, solution.entry(at, 0))).collect())
}

/// The sign of `D`.
pub(crate) fn determinant_sign(problem: &ModeProblem, pattern: &[ContactState]) -> Sign {
    IntegerSystem::new(problem, pattern).solve().map_or(Sign::Zero, |solved| solved.determinant_sign())
}

/// The signs that decide a regular pattern, without fractions.
pub(crate) struct ExactSolution {
    numerators: Vec<IBig>,
    /// Positive.
    denominator: IBig,
    /// The sign of `D`.
    determinant: Sign,
}

impl ExactSolution {
    /// The equations of one pattern, solved; `None` if they are singular, or once `proceed` is `false`.
    pub(crate) fn of_pattern(
        problem: &ModeProblem,
        pattern: &[ContactState],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        IntegerSystem::new(problem, pattern).solve_while(proceed).map(Self::from)
    }

    pub(super) fn determinant(&self) -> Sign {
        self.determinant
    }

    /// The sign of the unknown of a contact.
    pub(crate) fn sign(&self, contact: usize) -> Sign {
        sign_of(&self.numerators[contact])
    }

    /// The sign of the unknown of a contact minus 1.
    pub(super) fn sign_above_one(&self, contact: usize) -> Sign {
        sign_of(&(&self.numerators[contact] - &self.denominator))
    }

    /// Gives a contact the opposite column.
    pub(crate) fn turn(&mut self, contact: usize) {
        let numerator = &mut self.numerators[contact];
        *numerator = -std::mem::take(numerator);
        self.determinant = -self.determinant;
    }

    /// The narrowest intervals around the unknowns.
    pub(super) fn enclosures(&self) -> Vec<Interval> {
        let ratio =
            |numerator: &IBig| Relaxed::from_parts_signed(numerator.clone(), self.denominator.clone());
        self.numerators.iter().map(|numerator| Interval::around_relaxed(&ratio(numerator))).collect()
    }
}

impl From<Cramer> for ExactSolution {
    /// For the first right-hand side.
    fn from(solved: Cramer) -> Self {
        let determinant = solved.determinant_sign();
        let Cramer { determinant: denominator, mut numerators } = solved;
        let mut numerators = if numerators.is_empty() { Vec::new() } else { numerators.swap_remove(0) };
        if determinant == Sign::Negative {
            numerators.iter_mut().for_each(|numerator| *numerator = -std::mem::take(numerator));
        }
        let denominator = if determinant == Sign::Negative { -denominator } else { denominator };
        Self { numerators, denominator, determinant }
    }
}

impl Interval {
    /// The midpoint; if that would be zero by underflow, the least number on the interval's side of zero. The
    /// sign is therefore that of the enclosed value, and a number too large for `f64` is infinite.
    pub(crate) fn nonzero_middle(self) -> f64 {
        match self.middle() {
            0.0 if self.lower() == 0.0 => self.upper(),
            0.0 if self.upper() == 0.0 => self.lower(),
            middle => middle,
        }
    }

    /// The narrowest interval with `f64` bounds that contains a rational number.
    ///
    /// ```
    /// use dashu_ratio::RBig;
    /// use slideway_modes::certificate::Interval;
    /// let third = Interval::around_ratio(&RBig::from_parts(1.into(), 3_u8.into()));
    /// assert_eq!(third.lower().next_up(), third.upper());
    /// ```
    pub fn around_ratio(value: &RBig) -> Self {
        Self::around_relaxed(value.as_relaxed())
    }

    /// [`around_ratio`](Self::around_ratio) for a fraction that need not be reduced.
    fn around_relaxed(value: &Relaxed) -> Self {
        let nearest = value.to_f64().value();
        let side = match Relaxed::try_from(nearest) {
            Ok(exact) => exact.cmp(value),
            // It overflowed.
            Err(_) if nearest > 0.0 => Ordering::Greater,
            Err(_) => Ordering::Less,
        };
        let (lower, upper) = match side {
            Ordering::Less => (nearest, nearest.next_up()),
            Ordering::Equal => (nearest, nearest),
            Ordering::Greater => (nearest.next_down(), nearest),
        };
        Self::new(lower, upper).unwrap_or(Self::REAL_LINE)
    }
}
