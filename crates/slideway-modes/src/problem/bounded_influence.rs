//! Mode problems of contacts whose influence coefficients are known within bounds.

use nalgebra::{DMatrix, DVector};

use crate::interval::Interval;
use crate::interval_matrix::IntervalMatrix;
use crate::problem::bounds::{IntervalModeProblem, IntervalModeProblemError};
use crate::problem::mode_problem::ModeProblemError;
use crate::problem::side::{BySide, ProblemPart, Side};

/// Influence coefficients and friction parameters of `r` contacts within bounds: what
/// [`IntervalModeProblem::from_influence`] needs. Each part may be exact.
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalInfluence {
    /// `eta_jk`, change of `N_j` per unit friction at contact `k` (r x r, dimensionless).
    pub eta: BySide<IntervalMatrix>,
    /// The same for the line on which the preload friction acts.
    pub eta_preload: BySide<IntervalMatrix>,
    /// Coefficients of friction `mu_k` (r x 1).
    pub mu: BySide<IntervalMatrix>,
    /// Preload friction `F_k0` (r x 1, force).
    pub preload: BySide<IntervalMatrix>,
    /// `s_k = sign(ds_k)` of the sliding velocities (r): -1, 0 or 1.
    pub velocity_signs: DVector<f64>,
    /// `N(0)`, normal forces without friction (r x 1, force).
    pub frictionless: IntervalMatrix,
}

impl IntervalModeProblem {
    /// The problems of contacts with dry friction, from bounds of their influence coefficients:
    ///
    /// ```text
    /// c_k^{sigma} = sigma e_k - mu_k^{sigma} s_k eta_k^{sigma},   d_k^{sigma} = s_k F_k0^{sigma} eta_preload_k^{sigma}
    /// ```
    ///
    /// (Klepp (2002), eq. (6)), without loss by rounding. All entries of the result may vary independently,
    /// so one `mu_k` with wide bounds counts as a different one in each equation: what is proved holds, but
    /// more may be left undecided than necessary.
    ///
    /// # Errors
    /// [`IntervalModeProblemError`] for shapes, for velocity signs other than -1, 0, 1, and for
    /// numbers that overflow.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::certificate::{decide, Decision};
    /// use slideway_modes::certificate::{IntervalInfluence, IntervalMatrix, IntervalModeProblem};
    /// use slideway_modes::{BySide, ContactState};
    /// // A single slider with eta = 0.5, moving forwards, with mu between 0.1 and 0.15.
    /// let eta = BySide::same(IntervalMatrix::exact(dmatrix![0.5]));
    /// let mu = IntervalMatrix::from_bounds(&dmatrix![0.1], &dmatrix![0.15]).expect("in order");
    /// let problem = IntervalModeProblem::from_influence(&IntervalInfluence {
    ///     eta: eta.clone(),
    ///     eta_preload: eta,
    ///     mu: BySide::same(mu),
    ///     preload: BySide::same(IntervalMatrix::exact(dmatrix![0.0])),
    ///     velocity_signs: dvector![1.0],
    ///     frictionless: IntervalMatrix::exact(dmatrix![4.0]),
    /// })?;
    /// let decision = decide(&problem, &[ContactState::Positive]).decision;
    /// assert!(matches!(decision, Decision::Solution { .. }), "it persists for all mu");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_influence(influence: &IntervalInfluence) -> Result<Self, IntervalModeProblemError> {
        influence.check()?;
        let signs = &influence.velocity_signs;
        // c_k^{sigma} = sigma e_k - mu_k s_k eta_k^{sigma}
        let columns = |side: Side| {
            let (eta, mu) = (influence.eta.get(side), influence.mu.get(side));
            let entry = |row: usize, contact: usize| {
                let unit = if row == contact { side.sign() } else { 0.0 };
                let friction = mu.entry(contact, 0) * Interval::point(signs[contact]);
                Interval::point(unit) - friction * eta.entry(row, contact)
            };
            bounded(ProblemPart::Columns(side), signs.len(), entry)
        };
        // d_k^{sigma} = s_k F_k0 eta_k^{sigma}
        let jumps = |side: Side| {
            let (eta, preload) = (influence.eta_preload.get(side), influence.preload.get(side));
            let entry = |row: usize, contact: usize| {
                preload.entry(contact, 0) * Interval::point(signs[contact]) * eta.entry(row, contact)
            };
            bounded(ProblemPart::Jumps(side), signs.len(), entry)
        };
        Self::new(
            &BySide { positive: columns(Side::Positive)?, negative: columns(Side::Negative)? },
            &BySide { positive: jumps(Side::Positive)?, negative: jumps(Side::Negative)? },
            &influence.frictionless,
        )
    }
}

impl IntervalInfluence {
    fn check(&self) -> Result<(), ModeProblemError> {
        let contacts = self.velocity_signs.len();
        let is_sign = |sign: f64| sign == 0.0 || sign.abs() == 1.0;
        if let Some((contact, &value)) = self.velocity_signs.iter().enumerate().find(|&(_, &s)| !is_sign(s)) {
            return Err(ModeProblemError::VelocitySign { contact, value });
        }
        let mut parts = vec![(ProblemPart::RightHandSide, &self.frictionless, 1)];
        for side in Side::BOTH {
            parts.push((ProblemPart::Columns(side), self.eta.get(side), contacts));
            parts.push((ProblemPart::Jumps(side), self.eta_preload.get(side), contacts));
            parts.push((ProblemPart::Friction(side), self.mu.get(side), 1));
            parts.push((ProblemPart::Preload(side), self.preload.get(side), 1));
        }
        for (part, matrix, columns) in parts {
            let expected = (contacts, columns);
            if matrix.shape() != expected {
                return Err(ModeProblemError::Shape { part, expected, found: matrix.shape() });
            }
        }
        Ok(())
    }
}

/// The matrix with the given entries; an error if one of them has overflowed.
fn bounded(
    part: ProblemPart,
    contacts: usize,
    entry: impl Fn(usize, usize) -> Interval,
) -> Result<IntervalMatrix, IntervalModeProblemError> {
    IntervalMatrix::from_intervals(&DMatrix::from_fn(contacts, contacts, entry))
        .ok_or(IntervalModeProblemError::Radius { part, value: f64::INFINITY })
}
