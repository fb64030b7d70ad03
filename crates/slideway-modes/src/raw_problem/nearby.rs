//! Whether a problem without a solution has one within rounding of its numbers.
//!
//! Numbers that were computed or converted are rounded, and if a matrix ought to be singular, like that of a
//! frictionless pile, rounding alone may remove every solution. `y >= 0` solves the equations of a pattern
//! for some numbers within bounds exactly if `|C y - b| <= R y + s`, row by row, where `R` and `s` are the
//! radii of the bounds (Oettli and Prager, 1964). The search within the bounds excludes patterns without a
//! solution for any of these numbers, and finds candidates for this criterion, which is evaluated in exact
//! arithmetic.

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};

use super::RawProblem;
use super::correspondence::Correspondence;
use super::report::{WithinRounding, WithinRoundingAnswer};
use super::residual::exact;
use super::values::Sums;
use crate::dense::singular_values;
use crate::interval_matrix::IntervalMatrix;
use crate::problem::{BySide, IntervalModeProblem, ModeProblem, Side};
use crate::progress::{Callback, Progress};
use crate::search::{Arguments, CombinedState, Completeness, GroupState, SearchOptions, search};
use crate::solutions::Limits;

/// Every number may be off by this fraction of its size, `2^-50`: `TOLD` is reported, which leaves room for
/// the rounding of `A + B` and `B - A`.
const RELATIVE: f64 = 4.0 * f64::EPSILON;
const TOLD: f64 = 1e-15;
/// The search within bounds ends after this many states, ...
const STATES: usize = 64;
/// ... and may visit this many more nodes than the search for the numbers as given.
const MORE_NODES: u64 = 1000;
/// At most this many vertices of a continuum are tried.
const VERTICES: usize = 16;
/// Candidates are tried in exact arithmetic only for up to this many unknowns.
const LARGEST: usize = 200;

/// Finds whether the problem has a solution within rounding of its numbers. Returns `None` if the right-hand
/// side jumps, for unknowns between bounds, for games, which have a solution always, or if numbers are too
/// large.
pub(super) fn within_rounding(
    (raw, correspondence): (&RawProblem, &Correspondence),
    problem: &ModeProblem,
    (options, nodes): (&SearchOptions, u64),
    progress: &mut Callback<'_>,
) -> Option<WithinRounding> {
    let bounds = Nearby::new(raw, problem)?;
    let limits = Limits { solutions: STATES, ..options.limits };
    let nodes = options.nodes.min(nodes.saturating_add(MORE_NODES));
    // Relaxations exclude singular patterns for all numbers within bounds; individual decisions do not.
    let arguments = Arguments { every_pattern: false, ..options.arguments };
    let options = SearchOptions { nodes, limits, arguments, keep_exclusions: false, ..*options };
    let result = search(&bounds.problem()?, &options, progress);
    let size = problem.contacts();
    let candidates = result.product.states().take(STATES).flat_map(|state| points(&state, size));
    let told = Progress { counted: "nodes", done: result.nodes(), fraction: Some(1.0), found: None };
    let candidates = candidates.take_while(|_| size <= LARGEST && progress(&told).is_continue());
    let mut tried = candidates.flat_map(|point| [bounds.refined(&point), Some(point)]).flatten();
    let found = tried.find(|point| bounds.admits(point));
    let nothing = result.product.states().next().is_none();
    let answer = match found {
        Some(_) => WithinRoundingAnswer::Solution,
        None if nothing && result.completeness == Completeness::Proven => WithinRoundingAnswer::None,
        None => WithinRoundingAnswer::Unknown,
    };
    let unknowns = found.map(|point| correspondence.unknowns(point.as_slice(), &Sums::default()));
    Some(WithinRounding { relative: TOLD, answer, unknowns })
}

/// The numbers of a problem without jumps, and their maximum errors.
struct Nearby<'a> {
    problem: &'a ModeProblem,
    /// Sizes of the given numbers; their radius is `RELATIVE` times these.
    sizes: BySide<DMatrix<f64>>,
}

impl<'a> Nearby<'a> {
    fn new(raw: &RawProblem, problem: &'a ModeProblem) -> Option<Self> {
        let size = problem.contacts();
        let (positive, negative) = match raw {
            // w = M z + q: the columns of w are not rounded.
            RawProblem::LinearComplementarity { m, .. } => (m.abs(), DMatrix::zeros(size, size)),
            RawProblem::AbsoluteValue { a, b, .. } => (a.abs() + b.abs(), a.abs() + b.abs()),
            RawProblem::HorizontalComplementarity { a, b, .. } => (b.abs(), a.abs()),
            // A u + C z + a = 0, w = D u + B z + b: the columns of w are not rounded.
            RawProblem::MixedLinearComplementarity { free, .. } => {
                let mut negative = problem.columns(Side::Negative).abs();
                negative.columns_mut(*free, size - free).fill(0.0);
                (problem.columns(Side::Positive).abs(), negative)
            }
            RawProblem::MixedComplementarity { .. }
            | RawProblem::Game { .. }
            | RawProblem::BlockAbsoluteValue(_) => return None,
            RawProblem::Modes(_) => {
                (problem.columns(Side::Positive).abs(), problem.columns(Side::Negative).abs())
            }
        };
        let jumps = Side::BOTH.iter().any(|&side| problem.jumps(side).amax() > 0.0);
        (!jumps).then_some(Self { problem, sizes: BySide { positive, negative } })
    }

    fn problem(&self) -> Option<IntervalModeProblem> {
        let around =
            |centre: DMatrix<f64>, size: &DMatrix<f64>| IntervalMatrix::around(centre, size * RELATIVE);
        let columns = |side: Side| around(self.problem.columns(side).clone(), self.sizes.get(side));
        let columns = BySide { positive: columns(Side::Positive)?, negative: columns(Side::Negative)? };
        let load = self.problem.right_hand_side();
        let load = DMatrix::from_column_slice(load.len(), 1, load.as_slice());
        let load_size = load.abs();
        let none = IntervalMatrix::exact(DMatrix::zeros(self.problem.contacts(), self.problem.contacts()));
        IntervalModeProblem::new(&columns, &BySide::same(none), &around(load, &load_size)?).ok()
    }

    /// The matrix of the nonzero unknowns with these signed values, which unknowns these are, and the sizes
    /// of the matrix's numbers.
    fn columns(&self, signed: &DVector<f64>) -> (DMatrix<f64>, Vec<usize>, DMatrix<f64>) {
        let present: Vec<usize> = (0..signed.len()).filter(|&at| signed[at] != 0.0).collect();
        let side = |at: usize| if signed[at] > 0.0 { Side::Positive } else { Side::Negative };
        let rows = signed.len();
        let matrix = DMatrix::from_fn(rows, present.len(), |row, column| {
            self.problem.columns(side(present[column]))[(row, present[column])]
        });
        let sizes = DMatrix::from_fn(rows, present.len(), |row, column| {
            self.sizes.get(side(present[column]))[(row, present[column])]
        });
        (matrix, present, sizes)
    }

    /// The least-squares solution of minimum size with the same signs; `None` if there is none.
    fn refined(&self, signed: &DVector<f64>) -> Option<DVector<f64>> {
        let (matrix, present, _) = self.columns(signed);
        if present.is_empty() {
            return None;
        }
        let factors = singular_values(&matrix, [true; 2])?;
        let smallest = factors.singular_values.amax() * RELATIVE * signed.len() as f64;
        let load = self.problem.right_hand_side();
        let mut y = factors.solve(load, smallest).ok()?;
        y += factors.solve(&(load - &matrix * &y), smallest).ok()?;
        let mut refined = DVector::zeros(signed.len());
        for (&at, &value) in present.iter().zip(&y) {
            refined[at] = signed[at].signum() * value;
        }
        y.iter().all(|&value| value >= 0.0).then_some(refined)
    }

    /// Whether some numbers within the bounds have this solution, without rounding carrying the load: the
    /// effect of rounding on the terms of an equation must be less than half of the largest load.
    fn admits(&self, signed: &DVector<f64>) -> bool {
        let (matrix, present, sizes) = self.columns(signed);
        let y: Option<Vec<RBig>> = present.iter().map(|&at| exact(signed[at].abs())).collect();
        let (Some(y), Some(relative)) = (y, exact(RELATIVE)) else { return false };
        let load = self.problem.right_hand_side();
        let Some(most) = exact(load.amax() / 2.0) else { return false };
        let sum = |row: usize, of: &DMatrix<f64>| {
            let mut terms = y.iter().enumerate().filter(|(column, _)| of[(row, *column)] != 0.0);
            terms.try_fold(RBig::ZERO, |sum, (column, y)| Some(sum + exact(of[(row, column)])? * y))
        };
        (0..load.len()).all(|row| {
            let (Some(left), Some(size), Some(right)) =
                (sum(row, &matrix), sum(row, &sizes), exact(load[row]))
            else {
                return false;
            };
            let radius = &relative * (size.clone() + magnitude(right.clone()));
            magnitude(left - right) <= radius && &relative * size < most
        })
    }
}

fn magnitude(value: RBig) -> RBig {
    if value < RBig::ZERO { -value } else { value }
}

/// The signed values of a state, or some vertices of it.
fn points(state: &CombinedState<'_>, size: usize) -> Vec<DVector<f64>> {
    if let Some(point) = state.normal_force(size) {
        return vec![point];
    }
    match state.joined(size, 1) {
        GroupState::Singular(mode) => mode.set.vertices().into_iter().take(VERTICES).cloned().collect(),
        _ => Vec::new(),
    }
}
