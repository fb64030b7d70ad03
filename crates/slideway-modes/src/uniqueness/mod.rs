//! Whether a problem has exactly one solution for every load.

mod proofs;

use std::ops::ControlFlow;

use nalgebra::DMatrix;

use self::proofs::Family;
use crate::certificate::determinant_sign;
use crate::interval::Sign;
use crate::problem::{ContactState, ModeProblem, ScaledProblem, Side};
use crate::progress::{Callback, Progress};

/// From this number of undecided contacts on, the proofs are tried on a part of the tree.
const PROOF_SIZE: usize = 7;
/// Added wherever numbers could have underflowed.
const UNDERFLOW: f64 = 1e-300;

/// The permitted cost of a decision about uniqueness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UniquenessLimits {
    /// Largest number of nodes visited in the tree of patterns.
    pub nodes: u64,
    /// Largest number of determinants that are computed exactly.
    pub exact: u64,
    /// Largest number of contacts: one path through the tree keeps 16/3 `r^3` bytes.
    pub contacts: usize,
}

impl Default for UniquenessLimits {
    /// 50 million nodes, 1000 exact determinants, 400 contacts (340 MB).
    fn default() -> Self {
        Self { nodes: 50_000_000, exact: 1000, contacts: 400 }
    }
}

/// Whether every load has exactly one solution; see [`uniqueness`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Uniqueness {
    /// Every load has exactly one solution.
    Unique {
        /// The sign of all `p(sigma)`, 1 or -1.
        sign: i8,
    },
    /// Some loads have several solutions, or none: two modes with `p` of opposite sign.
    NotUnique {
        /// A pattern with `p > 0`.
        positive: Vec<Side>,
        /// A pattern with `p < 0`.
        negative: Vec<Side>,
    },
    /// Some loads have no solution or a continuum: a mode with `D = 0`, exactly.
    Singular {
        /// The pattern.
        pattern: Vec<Side>,
    },
    /// Everything except determinants too close to zero indicates that there is exactly one solution.
    InDoubt {
        /// The first pattern whose sign could not be decided.
        pattern: Vec<Side>,
    },
    /// A limit would be exceeded, or the work was ended on request.
    NotComputed(Unfinished),
    /// The right-hand side jumps, so nothing follows from the determinants.
    JumpsPresent {
        /// The first contact with a jump.
        contact: usize,
    },
}

/// Why uniqueness was not decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unfinished {
    /// More nodes than [`UniquenessLimits::nodes`].
    Nodes(u64),
    /// More contacts than [`UniquenessLimits::contacts`].
    Contacts(usize),
    /// The callback ended it.
    Cancelled,
}

/// Whether the problem has exactly one solution for every right-hand side `N(0)`.
///
/// This is the case if and only if `p(sigma) = D(sigma) prod_k sigma_k` has the same nonzero sign, positive
/// or negative, for every pattern (theory, section 5). With jumps, the statement does not hold. For a linear
/// complementarity problem, it says whether `M` is a P-matrix.
///
/// The decision refers to the given numbers (sums of two matrices unrounded), and is rigorous. Two sufficient
/// conditions are tried first (a spectral radius, a largest singular value), for the whole tree of patterns
/// and for large parts of it. The tree's eliminations carry error bounds. If these leave a sign open, the
/// determinants are computed exactly. In general the question is co-NP-hard: beyond the limits, the answer is
/// [`Uniqueness::NotComputed`] or [`Uniqueness::InDoubt`].
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::{ModeProblem, Side, Uniqueness, UniquenessLimits, uniqueness};
/// // x + b |x| = c: unique for |b| < 1.
/// let problem = |b: f64| {
///     ModeProblem::from_absolute_value_equation(&dmatrix![1.0], &dmatrix![b], dvector![0.0])
/// };
/// let limits = UniquenessLimits::default();
/// assert_eq!(uniqueness(&problem(0.9)?, &limits), Uniqueness::Unique { sign: 1 });
/// assert_eq!(uniqueness(&problem(1.0)?, &limits), Uniqueness::Singular { pattern: vec![Side::Negative] });
/// assert_eq!(
///     uniqueness(&problem(2.0)?, &limits),
///     Uniqueness::NotUnique { positive: vec![Side::Positive], negative: vec![Side::Negative] },
/// );
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn uniqueness(problem: &ModeProblem, limits: &UniquenessLimits) -> Uniqueness {
    uniqueness_with(problem, limits, &mut |_| ControlFlow::Continue(()))
}

/// [`uniqueness`], with a callback at every node of the tree, which ends the work by breaking.
pub fn uniqueness_with(
    problem: &ModeProblem,
    limits: &UniquenessLimits,
    progress: &mut Callback<'_>,
) -> Uniqueness {
    let contacts = problem.contacts();
    if let Some(contact) = (0..contacts).find(|&contact| problem.has_jump(contact)) {
        return Uniqueness::JumpsPresent { contact };
    }
    if contacts > limits.contacts {
        return Uniqueness::NotComputed(Unfinished::Contacts(limits.contacts));
    }
    let mut tree = SignTree::new(problem, limits, progress);
    match tree.descend(0, 1, false) {
        Err(Ended::Opposite) | Ok(()) => tree.conclusion(),
        Err(Ended::Singular) => Uniqueness::Singular { pattern: tree.pattern },
        Err(Ended::Unfinished(why)) => Uniqueness::NotComputed(why),
    }
}

/// Why a search ends early.
enum Ended {
    Opposite,
    Singular,
    Unfinished(Unfinished),
}

/// The rows and columns that remain at one level, row by row; each undecided contact has two columns, `c_k^+`
/// and `-c_k^-`, so that determinants are `p`.
struct Level {
    values: Vec<f64>,
    /// The maximum error of each value.
    errors: Vec<f64>,
}

struct SignTree<'p, 'c> {
    problem: &'p ModeProblem,
    progress: &'p mut Callback<'c>,
    limit: u64,
    contacts: usize,
    levels: Vec<Level>,
    pattern: Vec<Side>,
    /// Patterns with `p > 0` and with `p < 0`.
    found: [Option<Vec<Side>>; 2],
    in_doubt: Option<Vec<Side>>,
    nodes: u64,
    exact: u64,
}

impl<'p, 'c> SignTree<'p, 'c> {
    fn new(problem: &'p ModeProblem, limits: &UniquenessLimits, progress: &'p mut Callback<'c>) -> Self {
        let contacts = problem.contacts();
        let scaled = ScaledProblem::within(problem.into());
        let mut levels: Vec<Level> = (0..contacts)
            .map(|level| {
                let size = 2 * (contacts - level) * (contacts - level);
                Level { values: vec![0.0; size], errors: vec![0.0; size] }
            })
            .collect();
        for contact in 0..contacts {
            for (side, state) in ContactState::PRESSED.into_iter().enumerate() {
                for (row, &entry) in scaled.column(contact, state).iter().enumerate() {
                    let at = 2 * (row * contacts + contact) + side;
                    levels[0].values[at] = state.sign() * entry;
                    levels[0].errors[at] =
                        scaled.column_radii().map_or(0.0, |radii| radii[side][(row, contact)]);
                }
            }
        }
        Self {
            problem,
            progress,
            limit: limits.nodes,
            contacts,
            levels,
            pattern: vec![Side::Positive; contacts],
            found: [None, None],
            in_doubt: None,
            nodes: 0,
            exact: limits.exact,
        }
    }

    /// Visits all patterns with the given sides of the contacts before `level`, or only one of them if they
    /// are known to have one sign. `sign` is that of the pivots above.
    fn descend(&mut self, level: usize, sign: i8, one_sign: bool) -> Result<(), Ended> {
        if level == self.contacts {
            return self.file(sign);
        }
        let rest = self.contacts - level;
        let try_proof = level == 0 || rest >= PROOF_SIZE;
        let one_sign = one_sign || (try_proof && self.family(level).has_one_sign());
        let sides = if one_sign { &Side::BOTH[..1] } else { &Side::BOTH[..] };
        for (index, &side) in sides.iter().enumerate() {
            self.visit()?;
            self.pattern[level] = side;
            match self.eliminate(level, index) {
                Some(pivot_sign) => self.descend(level + 1, sign * pivot_sign, one_sign)?,
                None => self.examine_all_below(level + 1, one_sign)?,
            }
        }
        Ok(())
    }

    /// Counts a node, and asks whether to continue.
    fn visit(&mut self) -> Result<(), Ended> {
        if self.nodes == self.limit {
            return Err(Ended::Unfinished(Unfinished::Nodes(self.limit)));
        }
        self.nodes += 1;
        let progress = Progress { counted: "nodes", done: self.nodes, fraction: None, found: None };
        match (self.progress)(&progress) {
            ControlFlow::Break(()) => Err(Ended::Unfinished(Unfinished::Cancelled)),
            ControlFlow::Continue(()) => Ok(()),
        }
    }

    fn file(&mut self, sign: i8) -> Result<(), Ended> {
        let place = usize::from(sign < 0);
        if self.found[place].is_none() {
            self.found[place] = Some(self.pattern.clone());
        }
        if self.found.iter().all(Option::is_some) { Err(Ended::Opposite) } else { Ok(()) }
    }

    fn family(&self, level: usize) -> Family {
        let rest = self.contacts - level;
        let Level { values, errors } = &self.levels[level];
        let at = |row: usize, column: usize, side: usize| 2 * (row * rest + column) + side;
        Family {
            sides: [0, 1]
                .map(|side| DMatrix::from_fn(rest, rest, |row, column| values[at(row, column, side)])),
            errors: DMatrix::from_fn(rest, rest, |row, column| {
                errors[at(row, column, 0)] + errors[at(row, column, 1)]
            }),
        }
    }

    /// Eliminates a column with row pivoting and bounds on all errors. Returns the sign with which the pivot
    /// enters the determinant; `None` if every possible pivot may be zero.
    fn eliminate(&mut self, level: usize, side: usize) -> Option<i8> {
        let rest = self.contacts - level;
        let width = 2 * rest;
        let (above, below) = self.levels.split_at_mut(level + 1);
        let Level { values, errors } = &above[level];
        let sure = |row: usize| values[row * width + side].abs() - errors[row * width + side];
        let mut pivot_row = 0;
        for row in 1..rest {
            if sure(row) > sure(pivot_row) {
                pivot_row = row;
            }
        }
        let size = sure(pivot_row);
        if size.is_nan() || size <= UNDERFLOW {
            return None;
        }
        let pivot_values = &values[pivot_row * width..][..width];
        let pivot_errors = &errors[pivot_row * width..][..width];
        let (pivot, pivot_error) = (pivot_values[side], pivot_errors[side]);
        let sign = if pivot_row == 0 { 1 } else { -1 };
        let sign = if pivot > 0.0 { sign } else { -sign };
        let Some(child) = below.first_mut() else { return Some(sign) };
        for row in 1..rest {
            // The pivot row and the first row are exchanged.
            let source = if row == pivot_row { 0 } else { row };
            let row_values = &values[source * width..][..width];
            let row_errors = &errors[source * width..][..width];
            let target = (row - 1) * (width - 2);
            let child_values = &mut child.values[target..][..width - 2];
            let child_errors = &mut child.errors[target..][..width - 2];
            if row_values[side] == 0.0 && row_errors[side] == 0.0 {
                child_values.copy_from_slice(&row_values[2..]);
                child_errors.copy_from_slice(&row_errors[2..]);
                continue;
            }
            // |f - f_exact| <= (e_row + |f| e_pivot) / (|pivot| - e_pivot) + eps |f|
            let factor = row_values[side] / pivot;
            let factor_error = ((row_errors[side] + factor.abs() * pivot_error) / size
                + f64::EPSILON * factor.abs())
                * (1.0 + 1e-12)
                + UNDERFLOW;
            for at in 0..width - 2 {
                let (entry, pivot_entry) = (row_values[at + 2], pivot_values[at + 2]);
                let product = factor * pivot_entry;
                let value = entry - product;
                let terms = row_errors[at + 2]
                    + factor.abs() * pivot_errors[at + 2]
                    + factor_error * (pivot_entry.abs() + pivot_errors[at + 2]);
                let rounding = f64::EPSILON * (product.abs() + value.abs());
                child_values[at] = value;
                child_errors[at] = (terms + rounding) * (1.0 + 1e-12) + UNDERFLOW;
            }
        }
        Some(sign)
    }

    /// Decides, individually and exactly, the patterns with the given sides of the contacts before `first`.
    fn examine_all_below(&mut self, first: usize, one_sign: bool) -> Result<(), Ended> {
        if self.exact == 0 {
            self.leave_in_doubt();
            return Ok(());
        }
        if first < self.contacts {
            let sides = if one_sign { &Side::BOTH[..1] } else { &Side::BOTH[..] };
            for &side in sides {
                self.visit()?;
                self.pattern[first] = side;
                self.examine_all_below(first + 1, one_sign)?;
            }
            return Ok(());
        }
        self.exact -= 1;
        let pattern: Vec<ContactState> = self.pattern.iter().map(|&side| side.into()).collect();
        let negative = self.pattern.iter().filter(|side| **side == Side::Negative).count();
        let orientation = if negative % 2 == 0 { 1 } else { -1 };
        match determinant_sign(self.problem, &pattern) {
            Sign::Zero => Err(Ended::Singular),
            Sign::Positive => self.file(orientation),
            Sign::Negative => self.file(-orientation),
        }
    }

    fn leave_in_doubt(&mut self) {
        if self.in_doubt.is_none() {
            self.in_doubt = Some(self.pattern.clone());
        }
    }

    fn conclusion(self) -> Uniqueness {
        match (self.found, self.in_doubt) {
            ([Some(positive), Some(negative)], _) => Uniqueness::NotUnique { positive, negative },
            (_, Some(pattern)) => Uniqueness::InDoubt { pattern },
            ([_, None], None) => Uniqueness::Unique { sign: 1 },
            ([None, _], None) => Uniqueness::Unique { sign: -1 },
        }
    }
}
