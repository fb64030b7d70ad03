//! The mode problem in units in which tolerances are pure numbers.

use nalgebra::{DMatrix, DVector, DVectorView};

use crate::problem::bounds::ProblemView;
use crate::problem::mode_problem::ModeProblem;
use crate::problem::pattern::ContactState;
use crate::problem::side::Side;

/// Coefficients of scaled rows below this are treated like zero in proofs: it is far enough above the least
/// number that their products with other factors do not underflow.
const NEGLIGIBLE: f64 = f64::from_bits((1023 - 500) << 52);

/// A mode problem with rows divided by their largest coefficient and loads divided by the largest load, both
/// rounded to powers of two so that scaling causes no rounding errors apart from underflow and overflow. The
/// effect of these is included in the error bounds.
///
/// Unknowns are `y_k` divided by `load_unit`, and `lambda_k` itself for a contact in its gap.
pub(crate) struct ScaledProblem {
    columns: [DMatrix<f64>; 2],
    /// `d_k^+ - d_k^-` of the contacts with a jump; other columns are zero.
    jump_difference: DMatrix<f64>,
    /// `N(0) + sum_k d_k^-`.
    base: DVector<f64>,
    /// `|N(0)| + sum_k max(|d_k^+|, |d_k^-|)`: the size of the terms of a right-hand side.
    load_size: DVector<f64>,
    row_scale: DVector<f64>,
    pub(crate) load_unit: f64,
    pub(crate) has_jump: Vec<bool>,
    /// The maximum change by scaling of the sum of all loads of a row.
    lost_load: DVector<f64>,
    /// The maximum errors of the columns; `None` if they are exact.
    column_radius: Option<[DMatrix<f64>; 2]>,
}

impl ScaledProblem {
    pub(crate) fn new(problem: &ModeProblem) -> Self {
        Self::with_jumps(problem, |contact| problem.has_jump(contact))
    }

    fn with_jumps(problem: &ModeProblem, has_jump: impl Fn(usize) -> bool) -> Self {
        let contacts = problem.contacts();
        let [positive, negative] = Side::BOTH.map(|side| problem.columns(side));
        let row_scale = DVector::from_fn(contacts, |row, _| {
            power_of_two_above(positive.row(row).amax().max(negative.row(row).amax())).recip()
        });
        let scale_rows = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(contacts, contacts, |row, column| row_scale[row] * matrix[(row, column)])
        };
        let [jumps_positive, jumps_negative] = Side::BOTH.map(|side| scale_rows(problem.jumps(side)));
        let right_hand_side = problem.right_hand_side().component_mul(&row_scale);

        let load_size = right_hand_side.abs() + jumps_positive.abs().sup(&jumps_negative.abs()).column_sum();
        let load_unit = power_of_two_above(load_size.amax());
        let lost_load = DVector::from_fn(contacts, |row, _| {
            let jumps = Side::BOTH.map(|side| problem.jumps(side)).into_iter();
            let loads = jumps.flat_map(|jumps| jumps.row(row).iter().copied().collect::<Vec<f64>>());
            let loads = loads.chain([problem.right_hand_side()[row]]);
            loads.map(|load| lost_by_scaling(load, row_scale[row], load_unit)).sum()
        });
        let has_jump: Vec<bool> = (0..contacts).map(has_jump).collect();
        let mut jump_difference = (&jumps_positive - &jumps_negative) / load_unit;
        for (contact, mut column) in jump_difference.column_iter_mut().enumerate() {
            if !has_jump[contact] {
                column.fill(0.0);
            }
        }
        Self {
            columns: [scale_rows(positive), scale_rows(negative)],
            jump_difference,
            base: (right_hand_side + jumps_negative.column_sum()) / load_unit,
            load_size: load_size / load_unit,
            row_scale,
            load_unit,
            has_jump,
            lost_load,
            column_radius: None,
        }
    }

    /// The problem at the midpoint of the bounds, with jumps wherever there may be one.
    pub(crate) fn within(problem: ProblemView<'_>) -> Self {
        let mut scaled = Self::with_jumps(problem.centre, |contact| problem.has_jump(contact));
        let radii = Side::BOTH.map(|side| scaled.scaled_radius(problem, side));
        let exact = radii.iter().flatten().all(|&radius| radius == 0.0);
        scaled.column_radius = (!exact).then_some(radii);
        scaled
    }

    /// The maximum errors of the scaled columns. Numbers too small for products are treated like zero.
    fn scaled_radius(&self, problem: ProblemView<'_>, side: Side) -> DMatrix<f64> {
        let centre = problem.centre.columns(side);
        DMatrix::from_fn(self.contacts(), self.contacts(), |row, contact| {
            let scale = self.row_scale[row];
            let radius = problem.radii.map_or(0.0, |radii| radii.columns.get(side)[(row, contact)]);
            let centre = centre[(row, contact)];
            let negligible = centre != 0.0 && (centre * scale).abs() < NEGLIGIBLE;
            if radius > 0.0 || negligible { (radius * scale).max(NEGLIGIBLE) } else { 0.0 }
        })
    }

    /// The maximum error of `A N + B |N|` with `A = (c^+ - c^-) / 2` and `B = (c^+ + c^-) / 2`, per unit of
    /// each `|N_k|`; `None` if the columns are exact.
    pub(crate) fn spread_of_columns(&self) -> Option<DMatrix<f64>> {
        self.column_radius.as_ref().map(|[positive, negative]| positive + negative)
    }

    /// The maximum errors of the columns of both sides; `None` if they are exact.
    pub(crate) fn column_radii(&self) -> Option<&[DMatrix<f64>; 2]> {
        self.column_radius.as_ref()
    }

    /// The maximum error of the column of a contact, row by row; `None` if it is exact. For a contact in its
    /// gap, it is part of the radius of the right-hand side.
    pub(crate) fn column_radius(&self, contact: usize, state: ContactState) -> Option<DVectorView<'_, f64>> {
        let side = match state {
            ContactState::Positive => 0,
            ContactState::Negative => 1,
            ContactState::Gap => return None,
        };
        self.column_radius.as_ref().map(|radii| radii[side].column(contact))
    }

    pub(crate) fn contacts(&self) -> usize {
        self.has_jump.len()
    }

    /// The states that a contact can take, in the order of enumeration.
    pub(crate) fn states(&self, contact: usize) -> &'static [ContactState] {
        ContactState::options(self.has_jump[contact])
    }

    /// Number of patterns of the contacts from `first` on: without and with gap states.
    pub(crate) fn patterns_from(&self, first: usize) -> (u64, u64) {
        (first..self.contacts()).fold((1, 1), |(pressed, all): (u64, u64), contact| {
            (pressed.saturating_mul(2), all.saturating_mul(self.states(contact).len() as u64))
        })
    }

    pub(crate) fn base(&self) -> &DVector<f64> {
        &self.base
    }

    pub(crate) fn load_size(&self) -> &DVector<f64> {
        &self.load_size
    }

    /// The column of a contact in a state: `c_k^+`, `c_k^-`, or `-(d_k^+ - d_k^-)` in its gap.
    pub(crate) fn column(&self, contact: usize, state: ContactState) -> DVector<f64> {
        match state {
            ContactState::Positive => self.columns[0].column(contact).into_owned(),
            ContactState::Negative => self.columns[1].column(contact).into_owned(),
            ContactState::Gap => -self.jump_difference.column(contact),
        }
    }

    /// Matrix and right-hand side of a pattern.
    pub(crate) fn system(&self, pattern: &[ContactState]) -> (DMatrix<f64>, DVector<f64>) {
        let mut matrix = DMatrix::zeros(self.contacts(), self.contacts());
        let mut right_hand_side = self.base.clone();
        for (contact, &state) in pattern.iter().enumerate() {
            matrix.set_column(contact, &self.column(contact, state));
            if state == ContactState::Positive {
                right_hand_side += self.jump_difference.column(contact);
            }
        }
        (matrix, right_hand_side)
    }

    /// A bound on the error of the problem's right-hand side in scaled units, including the effect of
    /// scaling.
    pub(crate) fn scaled_load_radius(&self, radius: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.contacts(), |row, _| {
            let (radius, scale) = (radius[row], self.row_scale[row]);
            radius * scale / self.load_unit
                + lost_by_scaling(radius, scale, self.load_unit)
                + self.lost_load[row]
        })
    }

    /// A combination of the scaled equations as a combination of the problem's own equations.
    pub(crate) fn unscaled_rows(&self, multipliers: &[f64]) -> Vec<f64> {
        multipliers.iter().zip(&self.row_scale).map(|(multiplier, scale)| multiplier * scale).collect()
    }

    /// The exponents of the powers of two that multiply the rows.
    pub(crate) fn row_exponents(&self) -> Vec<i32> {
        self.row_scale.iter().map(|&scale| exponent_of(scale)).collect()
    }

    /// The exponent of the power of two that divides loads.
    pub(crate) fn load_exponent(&self) -> i32 {
        exponent_of(self.load_unit)
    }

    /// The factor by which a column in the given state, and the row of the same number, enlarge the
    /// determinant of the unscaled matrix.
    pub(crate) fn determinant_factor(&self, contact: usize, state: ContactState) -> f64 {
        let column_unit = if state == ContactState::Gap { self.load_unit } else { 1.0 };
        column_unit / self.row_scale[contact]
    }
}

/// The exponent of a power of two.
pub(crate) fn exponent_of(power: f64) -> i32 {
    // The exponent field of a normal number.
    i32::try_from(power.to_bits() >> 52).map_or(0, |biased| biased - 1023)
}

/// The maximum error of `load scale / unit` with powers of two: zero, apart from underflow and overflow.
fn lost_by_scaling(load: f64, scale: f64, unit: f64) -> f64 {
    let (once, twice) = (load * scale, load * scale / unit);
    if !twice.is_finite() {
        f64::INFINITY
    } else if load == 0.0 || once.is_normal() && twice.is_normal() {
        0.0
    } else {
        f64::MIN_POSITIVE + f64::MIN_POSITIVE / unit
    }
}

/// The number of patterns, gap states included, or the largest `u64` if that is smaller.
pub(crate) fn patterns_of(problem: ProblemView<'_>) -> u64 {
    let states = (0..problem.contacts()).map(|contact| if problem.has_jump(contact) { 3 } else { 2 });
    states.fold(1, u64::saturating_mul)
}

/// The smallest power of two above `size`, kept within the range where its reciprocal is finite; 1 for zero.
pub(crate) fn power_of_two_above(size: f64) -> f64 {
    if size == 0.0 { 1.0 } else { (size.log2().floor() + 1.0).clamp(-1000.0, 1000.0).exp2() }
}
