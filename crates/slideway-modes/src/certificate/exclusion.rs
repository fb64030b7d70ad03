//! Proofs that no pattern of a set has a solution.

use nalgebra::{DMatrix, DVector};

use crate::dense::shortest_with_products;
use crate::interval::Interval;
use crate::interval_matrix::inner_product;
use crate::problem::{Column, ContactState, ProblemView, Side, pressed_sides};

/// Products within this fraction of the size of their terms may be zero except for rounding and the bounds of
/// the data.
const NEARLY_ZERO: f64 = 1e-3;
/// Columns whose products are below this multiple of the missing amount are also moved away from zero.
const NEARBY: f64 = 64.0;
/// The effect of the data's bounds on a product is smaller than the size of its terms by this factor.
const ABOVE_SPREAD: f64 = 1e12;
/// How far weights are moved, as multiples of the missing amount.
const STEPS: [f64; 2] = [2.0, 8.0];

/// Whether `weights` prove that no pattern with the given states has a solution.
///
/// `partial` has one entry per contact: its state, or `None` for a contact that may be pressed on either side
/// or rest in its gap. With `w` for the weights (one per equation), this verifies rigorously (Farkas; theory,
/// section 4 (b))
///
/// ```text
/// w . c_k^{sigma} >= 0                                          for every side that contact k may take
/// w . N(0) + sum_k max_{sigma allowed} w . d_k^{sigma} < 0      in a gap: both sides allowed
/// ```
///
/// Since `y >= 0` and the share of `d_k^+` in a gap is between 0 and 1, the equations then cannot hold. The
/// weights may come from any source, for example from an inaccurate linear program: wrong ones prove nothing,
/// and the answer is `false`. If products `w . c_k` miss zero only by rounding, like those of a basis of a
/// linear program, the weights are moved just far enough to make them positive, and tried again.
///
/// # Panics
/// If `partial` or `weights` does not have one entry per contact.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::certificate::proves_empty;
/// use slideway_modes::ModeProblem;
/// // w = 0 z - 1 cannot hold with w >= 0, whether z is 0 or not.
/// let problem = ModeProblem::from_linear_complementarity(&dmatrix![0.0], dvector![-1.0])?;
/// assert!(proves_empty(&problem, &[None], &[1.0]));
/// assert!(!proves_empty(&problem, &[None], &[-1.0]));
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn proves_empty<'a>(
    problem: impl Into<ProblemView<'a>>,
    partial: &[Option<ContactState>],
    weights: &[f64],
) -> bool {
    proves_empty_while(problem.into(), partial, weights, &mut || true)
}

/// [`proves_empty`]; `false` once `proceed` is `false`.
pub(crate) fn proves_empty_while(
    problem: ProblemView<'_>,
    partial: &[Option<ContactState>],
    weights: &[f64],
    proceed: &mut dyn FnMut() -> bool,
) -> bool {
    assert_eq!(partial.len(), problem.contacts(), "one entry per contact");
    assert_eq!(weights.len(), problem.contacts(), "one weight per equation");
    let Some(missing) = missing_fraction(problem, partial, weights) else { return false };
    if !opposes_right_hand_side(problem, partial, weights) {
        return false;
    }
    if missing == 0.0 {
        return true;
    }
    let nearly_zero = nearly_zero_columns(problem, partial, weights, NEARBY * missing);
    let Some(direction) = direction_inwards(&nearly_zero, weights, proceed) else { return false };
    STEPS.iter().any(|step| {
        let step = step * missing;
        let moved: Vec<f64> = weights.iter().zip(&direction).map(|(w, towards)| w + step * towards).collect();
        missing_fraction(problem, partial, &moved) == Some(0.0)
            && opposes_right_hand_side(problem, partial, &moved)
    })
}

/// `w . N(0) + sum_k max w . d_k < 0`.
fn opposes_right_hand_side(
    problem: ProblemView<'_>,
    partial: &[Option<ContactState>],
    weights: &[f64],
) -> bool {
    let weigh = |column: Column<'_>| inner_product(weights, column.centre, column.radius);
    let mut sum = weigh(problem.load());
    for (contact, &state) in partial.iter().enumerate() {
        let jumps = jump_sides(state).iter().map(|&side| weigh(problem.jump(contact, side)));
        let largest = jumps.fold(f64::NEG_INFINITY, |most, jump| most.max(jump.upper()));
        sum += Interval::new(largest, largest).unwrap_or(Interval::REAL_LINE);
    }
    sum.upper() < 0.0
}

/// The columns that a solution may use.
fn usable_columns<'a>(
    problem: ProblemView<'a>,
    partial: &[Option<ContactState>],
) -> impl Iterator<Item = Column<'a>> {
    let sides = partial.iter().map(|&state| pressed_sides(state)).enumerate();
    sides.flat_map(move |(contact, sides)| sides.iter().map(move |&side| problem.column(contact, side)))
}

/// The largest amount by which `w . c_k^{sigma} >= 0` is not verified, as a fraction of the size of its
/// terms: 0 if it is verified for all columns. `None` if it is more than rounding and the bounds of the data
/// can cause.
fn missing_fraction(
    problem: ProblemView<'_>,
    partial: &[Option<ContactState>],
    weights: &[f64],
) -> Option<f64> {
    let mut most: f64 = 0.0;
    for column in usable_columns(problem, partial) {
        let product = inner_product(weights, column.centre, column.radius);
        if product.lower() >= 0.0 || exact_where_possible(weights, column).lower() >= 0.0 {
            continue;
        }
        let missing = -product.lower() / product_size(weights, column);
        if missing > NEARLY_ZERO || missing.is_nan() {
            return None;
        }
        most = most.max(missing);
    }
    Some(most)
}

/// The nonzero columns for which `w . c_k^{sigma}` is at most a `fraction` of its size, or negative; also
/// those without entries in the equations that count, since moving the weights would not leave these products
/// at zero.
fn nearly_zero_columns<'a>(
    problem: ProblemView<'a>,
    partial: &[Option<ContactState>],
    weights: &[f64],
    fraction: f64,
) -> Vec<Column<'a>> {
    let is_nearly_zero = |column: &Column<'_>| {
        let product = inner_product(weights, column.centre, column.radius);
        let is_zero = column.centre.iter().all(|entry| *entry == 0.0)
            && column.radius.is_none_or(|radius| radius.iter().all(|entry| *entry == 0.0));
        !is_zero && product.lower() <= fraction * product_size(weights, *column)
    };
    usable_columns(problem, partial).filter(is_nearly_zero).collect()
}

/// The size of the terms of `w . c`: `|w| . |c|`, but far more than the effect of the data's bounds if there
/// is nothing else in the equations that count.
fn product_size(weights: &[f64], column: Column<'_>) -> f64 {
    let of = |values: &[f64]| weights.iter().zip(values).map(|(w, value)| (w * value).abs()).sum::<f64>();
    of(column.centre).max(column.radius.map_or(0.0, of) * ABOVE_SPREAD)
}

/// `w . c`, without rounding if every partial sum is an `f64`.
fn exact_where_possible(weights: &[f64], column: Column<'_>) -> Interval {
    (0..weights.len()).map(|row| Interval::point(weights[row]) * column.entry(row)).sum()
}

/// The shortest `v` for which `v . c_k` has the size of `w . c_k` for the given columns, or the size of all
/// their entries if these terms are all zero; `None` if the columns depend on each other, or once `proceed`
/// is `false`.
fn direction_inwards(
    columns: &[Column<'_>],
    weights: &[f64],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<f64>> {
    let rows = weights.len();
    if columns.len() > rows {
        return None;
    }
    let greatest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let size = |column: Column<'_>| match product_size(weights, column) {
        0.0 => greatest(weights) * greatest(column.centre),
        size => size,
    };
    let matrix = DMatrix::from_fn(rows, columns.len(), |row, column| columns[column].centre[row]);
    let sizes = DVector::from_iterator(columns.len(), columns.iter().map(|&column| size(column)));
    let direction = shortest_with_products(matrix, &sizes, proceed)?;
    direction.iter().all(|value| value.is_finite()).then(|| direction.as_slice().to_vec())
}

/// The sides whose jump vectors may contribute to the right-hand side.
pub(super) fn jump_sides(state: Option<ContactState>) -> &'static [Side] {
    match state {
        Some(ContactState::Gap) | None => &Side::BOTH,
        Some(ContactState::Positive) => &[Side::Positive],
        Some(ContactState::Negative) => &[Side::Negative],
    }
}
