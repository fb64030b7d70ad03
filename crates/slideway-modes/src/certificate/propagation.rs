//! Bounds on the normal forces of all solutions.

use nalgebra::DVector;

use super::preconditioned::{BaseSystem, Preconditioned};
use crate::dense::solution;
use crate::interval::{Interval, Sign};
use crate::interval_matrix::{upper_product, upper_sum};
use crate::problem::{ContactState, ProblemView};

/// Maximum number of times that bounds are tightened.
const SWEEPS: usize = 8;
/// Tightening stops when no bound improves by more than this fraction of the width.
const WORTHWHILE: f64 = 0.05;

/// The result of [`propagate`].
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub enum Propagation {
    /// No pattern with the given states has a solution.
    Empty,
    /// Every solution has its unknowns in these intervals, one per contact: `N_k` for an undecided contact,
    /// otherwise `y_k`, or the share `lambda_k` in a gap. An undecided contact whose interval is positive is
    /// pressed on the positive side in every solution; likewise for negative.
    Bounds(Vec<Interval>),
    /// No bounds were found.
    Unknown,
}

/// Proves bounds on the normal forces of all solutions of the patterns with the given states.
///
/// The search has a faster implementation of its own. This one is slow and independent of it; tests and
/// benchmarks compare the two, so it is not part of the documentation.
///
/// `partial` has one entry per contact: its state, or `None` for a contact that may be pressed on either side
/// or rest in its gap. With the equations preconditioned to `x = R b + (I - R A) x - R B |x| + R j tau`,
/// `-1 <= tau <= 1` (where `A`, `B` and `j` are, for undecided contacts, half the difference and half the sum
/// of both columns, and half the difference of both jumps), the first bound is the `e` with
///
/// ```text
/// |R b| + |R j| 1 + (|I - R A| + |R B|) e <= e
/// ```
///
/// if there is one (theory, section 4 (a)). It is then tightened by evaluating the right-hand side with what
/// is already known about `x`, `|x|` and `tau`. Both versions of columns and jumps are covered, and all
/// rounding.
///
/// # Panics
/// If `partial` does not have one entry per contact.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::certificate::{propagate, Propagation, Sign};
/// use slideway_modes::ModeProblem;
/// let (identity, b) = (dmatrix![1.0, 0.0; 0.0, 1.0], dmatrix![0.1, 0.2; -0.2, 0.1]);
/// let problem = ModeProblem::from_absolute_value_equation(&identity, &b, dvector![1.0, -2.0])?;
/// let Propagation::Bounds(bounds) = propagate(&problem, &[None, None]) else { panic!("weak coupling") };
/// assert_eq!(bounds[0].sign(), Some(Sign::Positive));
/// assert_eq!(bounds[1].sign(), Some(Sign::Negative));
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
#[doc(hidden)]
pub fn propagate<'a>(problem: impl Into<ProblemView<'a>>, partial: &[Option<ContactState>]) -> Propagation {
    let problem = problem.into();
    assert_eq!(partial.len(), problem.contacts(), "one entry per contact");
    let equations = BaseSystem::new(problem, partial).and_then(|base| base.preconditioned());
    let Some(equations) = equations else { return Propagation::Unknown };
    let Some(largest) = largest_sizes(&equations) else { return Propagation::Unknown };
    let mut bounds = Vec::with_capacity(partial.len());
    for (&state, &size) in partial.iter().zip(&largest) {
        match Interval::around(0.0, size).intersection(admissible(state)) {
            Some(bound) => bounds.push(bound),
            None => return Propagation::Empty,
        }
    }
    for _ in 0..SWEEPS {
        match tighten(&equations, partial, &mut bounds) {
            None => return Propagation::Empty,
            Some(gain) if gain < WORTHWHILE => break,
            Some(_) => {}
        }
    }
    Propagation::Bounds(bounds)
}

/// The range in which the unknown of a contact may lie at all.
fn admissible(state: Option<ContactState>) -> Interval {
    match state {
        None => Interval::REAL_LINE,
        Some(ContactState::Gap) => Interval::ZERO.hull(Interval::point(1.0)),
        Some(ContactState::Positive | ContactState::Negative) => {
            Interval::new(0.0, f64::INFINITY).unwrap_or(Interval::REAL_LINE)
        }
    }
}

/// `e` with `|x| <= e` for all `x` that satisfy the equations.
///
/// Every such `x` has `|x| <= g + H |x|`, `H = |I - R A| + |R B|`, `g = |R b| + |R j| 1`. If
/// `g + H e <= e` for an `e > 0` and `g > 0`, then `H e < e`, so the spectral radius of `H` is below 1
/// and `|x| <= (I - H)^-1 g <= e`.
fn largest_sizes(equations: &Preconditioned) -> Option<DVector<f64>> {
    let contacts = equations.right_hand_side.len();
    let load = equations.right_hand_side.map(Interval::magnitude);
    let jumps = upper_product(&equations.jump_size, &DVector::repeat(contacts, 1.0));
    let constant = upper_sum(&[&load, &jumps]);
    let coupling = &equations.defect + &equations.absolute_size;
    let image = |trial: &DVector<f64>| {
        let [defect, absolute] =
            [&equations.defect, &equations.absolute_size].map(|m| upper_product(m, trial));
        upper_sum(&[&constant, &defect, &absolute])
    };
    let system = nalgebra::DMatrix::identity(contacts, contacts) - coupling;
    // Slightly more than the solution, so that rounding does not matter; the test below is what counts.
    let floor = constant.amax().max(f64::MIN_POSITIVE);
    let trial = solution(system, &constant.map(|value| value * 1.000_001 + floor * 1e-9))?;
    let holds = |(image, trial): (&f64, &f64)| *trial > 0.0 && image <= trial && trial.is_finite();
    image(&trial).iter().zip(&trial).all(holds).then_some(trial)
}

/// One evaluation of the right-hand side for every unknown. `None` if that leaves no value for one of them,
/// otherwise the largest relative improvement.
fn tighten(
    equations: &Preconditioned,
    partial: &[Option<ContactState>],
    bounds: &mut [Interval],
) -> Option<f64> {
    let mut gain: f64 = 0.0;
    for row in 0..bounds.len() {
        let mut value = equations.right_hand_side[row];
        for (contact, &state) in partial.iter().enumerate() {
            let known = bounds[contact];
            let defect = Interval::around(0.0, equations.defect[(row, contact)]);
            value += defect * known;
            if state.is_none() {
                value = value - equations.absolute.entry(row, contact) * known.abs()
                    + equations.jumps.entry(row, contact) * jump_factor(known);
            }
        }
        let tightened = bounds[row].intersection(value)?;
        if tightened.width() < bounds[row].width() {
            gain = gain.max(1.0 - tightened.width() / bounds[row].width());
        }
        bounds[row] = tightened;
    }
    Some(gain)
}

/// The range of `tau`, given bounds on the normal force.
fn jump_factor(normal_force: Interval) -> Interval {
    match normal_force.sign() {
        Some(Sign::Positive) => Interval::point(1.0),
        Some(Sign::Negative) => Interval::point(-1.0),
        Some(Sign::Zero) | None => Interval::around(0.0, 1.0),
    }
}
