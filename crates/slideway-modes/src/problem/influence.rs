//! Mode problems and block mode problems with dry friction, from their influence coefficients: exact, or within bounds.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::interval::{Interval, Real};
use crate::interval_matrix::IntervalMatrix;
use crate::problem::bounds::{IntervalModeProblem, IntervalModeProblemError};
use crate::problem::mode_problem::{ModeProblem, ModeProblemError, check};
use crate::problem::shared_load::SharedLoad;
use crate::problem::side::{BySide, ProblemPart, Side};

/// Influence coefficients and friction parameters of `r` contacts, and of hinges that turn with friction, exact or within
/// bounds.
///
/// ```text
/// c_k^{sigma} = sigma e_k - mu_k^{sigma} s_k eta_k^{sigma},   d_k^{sigma} = s_k F_k0^{sigma} eta_preload_k^{sigma}
/// ```
///
/// (Klepp (2002), eq. (6)). There may be further rows below those of the contacts: first of both components of the force of
/// each hinge, then of other unknowns. A mode problem has none.
#[derive(Debug, Clone, PartialEq)]
pub struct InfluenceCoefficients<T: Real = f64> {
    /// `eta_jk`, change of `N_j` per unit friction at contact `k` (r x r, dimensionless);
    /// column `k` of a side is for contact `k` pressed on that side.
    pub eta: BySide<DMatrix<T>>,
    /// Changes of `N_j` per unit friction on the line of the preload (equal to `eta` in the paper).
    pub eta_preload: BySide<DMatrix<T>>,
    /// Coefficients of friction `mu_k` (r).
    pub mu: BySide<DVector<T>>,
    /// Preload friction `F_k0` (r, force).
    pub preload: BySide<DVector<T>>,
    /// `s_k = sign(ds_k)` of the sliding velocities (r): -1, 0 or 1.
    pub velocity_signs: DVector<f64>,
    /// `N(0)`, normal forces without friction (r, force).
    pub frictionless: DVector<T>,
    /// How contacts share a load that equilibrium leaves open, with self-stresses in all rows; `None` if none
    /// do.
    pub shared: Option<SharedLoad<T>>,
    /// The contacts that open in place of pressing another face, where `N < 0` stands for: each with what a unit of
    /// `y_k` adds in all rows, 1 or -1 in its own. There `y_k` is the acceleration of its gap, times the force that
    /// a unit of it takes,
    ///
    /// ```text
    /// c_k^- = -(dN/dg''_k) / |dN_k/dg''_k|,    y_k = |dN_k/dg''_k| g''_k
    /// ```
    pub one_sided: Vec<(usize, DVector<T>)>,
    /// The hinges that turn with friction: what a unit couple on the first body of each adds in all rows, and the couple by
    /// a unit of its force, `-r_j sgn(omega_j)` (theory of hinges, section 1).
    pub turning: Vec<(DVector<T>, T)>,
}

/// The numbers of `x = b + d^sigma + H^sigma w`, or of outputs `o` in place of `x`, with one row each.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockNumbers<T: Real = f64> {
    /// `H^sigma`, what the magnitudes add: a column for each contact, then for each hinge.
    pub response: BySide<DMatrix<T>>,
    /// `d^sigma`, what the jumps of the contacts add: a column for each.
    pub jumps: BySide<DMatrix<T>>,
    /// `b`, the rest.
    pub load: DVector<T>,
}

impl<T: Real> BlockNumbers<T> {
    /// No rows, for so many contacts and blocks.
    pub fn none(contacts: usize, blocks: usize) -> Self {
        Self {
            response: BySide::same(DMatrix::from_fn(0, blocks, |_, _| T::zero())),
            jumps: BySide::same(DMatrix::from_fn(0, contacts, |_, _| T::zero())),
            load: DVector::from_fn(0, |_, _| T::zero()),
        }
    }

    /// Those in some rows.
    #[must_use]
    pub fn rows(&self, rows: Range<usize>) -> Self {
        let part = |matrix: &DMatrix<T>| matrix.rows_range(rows.clone()).into_owned();
        Self {
            response: self.response.map(part),
            jumps: self.jumps.map(part),
            load: self.load.rows_range(rows.clone()).into_owned(),
        }
    }

    /// Whether no number is infinite or undefined.
    pub fn are_finite(&self) -> bool {
        let sides = [&self.response, &self.jumps].map(|both| both.positive.iter().chain(&both.negative));
        sides.into_iter().flatten().chain(&self.load).all(|number| number.is_finite())
    }
}

impl<T: Real> InfluenceCoefficients<T> {
    /// The number `r` of contacts.
    pub fn contacts(&self) -> usize {
        self.velocity_signs.len()
    }

    /// Returns the columns `c_k^sigma` of both sides in all rows; where contacts share a load, with their
    /// compatibility.
    pub fn columns(&self) -> BySide<DMatrix<T>> {
        self.sides(Self::column)
    }

    /// Returns the jumps `d_k^sigma` of both sides in all rows; in those of compatibility the play of
    /// contacts that share a load.
    pub fn jumps(&self) -> BySide<DMatrix<T>> {
        self.sides(Self::jump)
    }

    /// Returns the right-hand side in all rows.
    pub fn right_hand_side(&self) -> DVector<T> {
        let load = |row: usize| {
            let given = self.frictionless[row];
            self.shared.as_ref().map_or(given, |shared| shared.load(row, given))
        };
        DVector::from_fn(self.frictionless.len(), |row, _| load(row))
    }

    /// The numbers of the block mode problem, in all rows.
    pub fn numbers(&self) -> BlockNumbers<T> {
        let (rows, contacts) = (self.frictionless.len(), self.contacts());
        let response = |side: Side, row: usize, block: usize| match block.checked_sub(contacts) {
            None => self.response(side, row, block),
            Some(hinge) => self.response_to_hinge(row, hinge),
        };
        let blocks = contacts + self.turning.len();
        BlockNumbers {
            response: BySide::of(|side| {
                DMatrix::from_fn(rows, blocks, |row, block| response(side, row, block))
            }),
            jumps: self.jumps(),
            load: self.right_hand_side(),
        }
    }

    fn sides(&self, entry: fn(&Self, Side, usize, usize) -> T) -> BySide<DMatrix<T>> {
        let (rows, contacts) = (self.frictionless.len(), self.contacts());
        BySide::of(|side| DMatrix::from_fn(rows, contacts, |row, k| entry(self, side, row, k)))
    }

    /// `mu_k s_k eta_jk`, the force that a unit of `|N_k|` adds by friction in a row.
    fn friction(&self, side: Side, row: usize, contact: usize) -> T {
        let mu = self.mu.get(side)[contact];
        self.eta.get(side)[(row, contact)] * mu * T::exactly(self.velocity_signs[contact])
    }

    /// The force that a unit of `y_k` adds in a row, beside `sigma` in its own: by friction, or where the contact opens by the
    /// motion of its gap.
    fn added(&self, side: Side, row: usize, contact: usize) -> T {
        let opening = self.one_sided.iter().find(|(opens, _)| *opens == contact && side == Side::Negative);
        match opening {
            Some((_, opening)) if row == contact => opening[row] - T::one(),
            Some((_, opening)) => opening[row],
            None => self.friction(side, row, contact),
        }
    }

    fn column(&self, side: Side, row: usize, contact: usize) -> T {
        let unit = T::exactly(if row == contact { side.sign() } else { 0.0 });
        let given = unit - self.added(side, row, contact);
        self.shared.as_ref().map_or(given, |shared| shared.column(side, row, contact, given))
    }

    /// `H_k^sigma` of `x = b + d^sigma + H^sigma |x|` in a row: `sigma e_k - c_k^sigma`.
    fn response(&self, side: Side, row: usize, contact: usize) -> T {
        let given = self.added(side, row, contact);
        self.shared.as_ref().map_or(given, |shared| shared.response(side, row, contact, given))
    }

    /// `-r_j sgn(omega_j)` times the answer to a unit couple; compatibility of deflections knows no couples.
    fn response_to_hinge(&self, row: usize, hinge: usize) -> T {
        let is_cut = self.shared.as_ref().is_some_and(|shared| shared.cut.contains(&row));
        let (answers, leverage) = &self.turning[hinge];
        if is_cut { T::zero() } else { answers[row] * *leverage }
    }

    /// `s_k F_k0 eta_preload_jk`, the force that the friction of the preload adds in a row.
    pub fn preload_friction(&self, side: Side, row: usize, contact: usize) -> T {
        let force = self.preload.get(side)[contact] * T::exactly(self.velocity_signs[contact]);
        self.eta_preload.get(side)[(row, contact)] * force
    }

    fn jump(&self, side: Side, row: usize, contact: usize) -> T {
        let given = self.preload_friction(side, row, contact);
        self.shared.as_ref().map_or(given, |shared| shared.jump(side, row, contact, given))
    }

    fn check(&self) -> Result<(), ModeProblemError> {
        let contacts = self.contacts();
        if !self.turning.is_empty() {
            let (part, expected) = (ProblemPart::Columns(Side::Positive), (contacts, contacts));
            let found = (contacts, contacts + self.turning.len());
            return Err(ModeProblemError::Shape { part, expected, found });
        }
        let is_sign = |sign: f64| sign == 0.0 || sign.abs() == 1.0;
        if let Some((contact, &value)) = self.velocity_signs.iter().enumerate().find(|&(_, &s)| !is_sign(s)) {
            return Err(ModeProblemError::VelocitySign { contact, value });
        }
        check(ProblemPart::RightHandSide, &self.frictionless, (contacts, 1))?;
        for side in Side::BOTH {
            for (part, matrix) in
                [(ProblemPart::Columns(side), &self.eta), (ProblemPart::Jumps(side), &self.eta_preload)]
            {
                check(part, matrix.get(side), (contacts, contacts))?;
            }
            for (part, vector) in
                [(ProblemPart::Friction(side), &self.mu), (ProblemPart::Preload(side), &self.preload)]
            {
                check(part, vector.get(side), (contacts, 1))?;
            }
        }
        self.shared.as_ref().map_or(Ok(()), |shared| shared.check(contacts))
    }
}

impl ModeProblem {
    /// The problem of contacts with dry friction, from their influence coefficients.
    ///
    /// # Errors
    /// [`ModeProblemError`] for shapes, for entries that are not finite, and for velocity signs other than
    /// -1, 0, 1.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::{enumerate, BySide, InfluenceCoefficients, Limits, ModeProblem};
    /// // A single slider with eta = 0.5, mu = 0.4, moving forwards: eq. (9) gives 4 / (1 - 0.2).
    /// let eta = BySide::same(dmatrix![0.5]);
    /// let problem = ModeProblem::from_influence(&InfluenceCoefficients {
    ///     eta: eta.clone(),
    ///     eta_preload: eta,
    ///     mu: BySide::same(dvector![0.4]),
    ///     preload: BySide::same(dvector![0.0]),
    ///     velocity_signs: dvector![1.0],
    ///     frictionless: dvector![4.0],
    ///     shared: None,
    ///     one_sided: vec![],
    ///     turning: vec![],
    /// })?;
    /// let solutions = enumerate(&problem, &Limits::default())?;
    /// assert!((solutions.solutions[0].normal_force[0] - 5.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// Contacts that share a load have rows of compatibility in place of those of the cut contacts. The play
    /// is a jump of the right-hand side there, and what is called a contact in its gap is one that is open.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector, DMatrix, DVector};
    /// use slideway_modes::{enumerate, BySide, InfluenceCoefficients, Limits, ModeProblem, SharedLoad};
    /// // Two parallel pads of equal stiffness carry 10 N without friction, the first with 2 mm of play at each face.
    /// let none = BySide::same(DVector::zeros(2));
    /// let problem = ModeProblem::from_influence(&InfluenceCoefficients {
    ///     eta: BySide::same(DMatrix::zeros(2, 2)),
    ///     eta_preload: BySide::same(DMatrix::zeros(2, 2)),
    ///     mu: none.clone(),
    ///     preload: none,
    ///     velocity_signs: dvector![1.0, 1.0],
    ///     frictionless: dvector![10.0, 0.0],
    ///     shared: Some(SharedLoad {
    ///         cut: vec![1],
    ///         self_stress: dmatrix![-1.0; 1.0],
    ///         compliance: dvector![1e-3, 1e-3],
    ///         clearance: dvector![2e-3, 0.0],
    ///         misalignment: dvector![0.0, 0.0],
    ///         press_fits: vec![],
    ///     }),
    ///     one_sided: vec![],
    ///     turning: vec![],
    /// })?;
    /// let solutions = enumerate(&problem, &Limits::default())?;
    /// assert!((&solutions.solutions[0].normal_force - dvector![4.0, 6.0]).amax() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_influence(influence: &InfluenceCoefficients) -> Result<Self, ModeProblemError> {
        influence.check()?;
        let (columns, jumps) = (influence.columns(), influence.jumps());
        let load = influence.right_hand_side();
        Self::new(columns.positive, columns.negative, jumps.positive, jumps.negative, load)
    }
}

impl IntervalModeProblem {
    /// The problems of contacts with dry friction, from bounds of their influence coefficients, without loss
    /// by rounding. All entries of the result may vary independently, so one `mu_k` with wide bounds counts
    /// as a different one in each equation: what is proved holds, but more may be left undecided than
    /// necessary.
    ///
    /// # Errors
    /// [`IntervalModeProblemError`] for shapes, for velocity signs other than -1, 0, 1, and for
    /// numbers that overflow.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::certificate::{decide, Decision, Interval, IntervalModeProblem};
    /// use slideway_modes::{BySide, ContactState, InfluenceCoefficients};
    /// // A single slider with eta = 0.5, moving forwards, with mu between 0.1 and 0.15.
    /// let eta = BySide::same(dmatrix![Interval::point(0.5)]);
    /// let problem = IntervalModeProblem::from_influence(&InfluenceCoefficients {
    ///     eta: eta.clone(),
    ///     eta_preload: eta,
    ///     mu: BySide::same(dvector![Interval::new(0.1, 0.15).expect("in order")]),
    ///     preload: BySide::same(dvector![Interval::ZERO]),
    ///     velocity_signs: dvector![1.0],
    ///     frictionless: dvector![Interval::point(4.0)],
    ///     shared: None,
    ///     one_sided: vec![],
    ///     turning: vec![],
    /// })?;
    /// let decision = decide(&problem, &[ContactState::Positive]).decision;
    /// assert!(matches!(decision, Decision::Solution { .. }), "it persists for all mu");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_influence(
        influence: &InfluenceCoefficients<Interval>,
    ) -> Result<Self, IntervalModeProblemError> {
        influence.check()?;
        let bounded = |part: ProblemPart, entries: &DMatrix<Interval>| {
            IntervalMatrix::from_intervals(entries)
                .ok_or(IntervalModeProblemError::Radius { part, value: f64::INFINITY })
        };
        let columns =
            influence.columns().try_map(|side, entries| bounded(ProblemPart::Columns(side), entries))?;
        let jumps = influence.jumps().try_map(|side, entries| bounded(ProblemPart::Jumps(side), entries))?;
        let load = DMatrix::from_columns(&[influence.right_hand_side()]);
        Self::new(&columns, &jumps, &bounded(ProblemPart::RightHandSide, &load)?)
    }
}
