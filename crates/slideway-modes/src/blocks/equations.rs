//! The equations on a piece of the unknowns: `x - b - d - H w = 0` with the slopes of `w`.

use nalgebra::{DMatrix, DVector};

use super::problem::BlockProblem;
use super::sector::{Sector, Vector, unit};
use crate::interval::Real;
use crate::interval_matrix::IntervalMatrix;
use crate::problem::{ContactState, Side};

/// A part of the unknowns: a node of the search.
///
/// The equations of a contact in a known state are continued linearly to the other side (`|N_k|` becomes
/// `sigma_k N_k`); the unknown of a contact in its gap is its share `lambda_k`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Piece {
    /// The state of each contact; `None` if it may be pressed on either side, or be in its gap.
    pub(super) states: Vec<Option<ContactState>>,
    /// The directions of each hinge's reaction.
    pub(super) sectors: Vec<Sector>,
}

impl Piece {
    /// All unknowns.
    pub(super) fn all(problem: &BlockProblem) -> Self {
        Self { states: vec![None; problem.contacts()], sectors: vec![Sector::All; problem.hinges()] }
    }

    /// Half the angle of the widest sector, in rad.
    pub(super) fn half_angle(&self) -> f64 {
        self.sectors.iter().fold(0.0, |most, sector| sector.half_angle().max(most))
    }

    /// Whether a contact that may jump is open.
    pub(super) fn may_jump(&self, problem: &BlockProblem) -> bool {
        (0..problem.contacts()).any(|contact| self.states[contact].is_none() && problem.has_jump(contact))
    }
}

/// Slopes of `w`: those of `|N_k|` of open contacts (others are not used), and of `|R_j|`.
pub(crate) struct Slopes {
    pub(crate) contacts: Vec<f64>,
    pub(crate) hinges: Vec<Vector>,
}

/// An entry of the data.
pub(super) fn entry<T: Real>(matrix: &IntervalMatrix, row: usize, column: usize) -> T {
    T::around(matrix.centre()[(row, column)], matrix.radius()[(row, column)])
}

/// The matrix of slopes of the equations: `I - H D`; of an open contact
///
/// ```text
/// e_k - (H_k^+ - H_k^-) / 2 - t (H_k^+ + H_k^-) / 2,   t the slope of |N_k|
/// ```
///
/// and of one in its gap `-(d_k^+ - d_k^-)`.
pub(crate) fn matrix(
    problem: &BlockProblem,
    states: &[Option<ContactState>],
    slopes: &Slopes,
) -> DMatrix<f64> {
    let rows = problem.rows();
    let mut matrix = DMatrix::zeros(rows, rows);
    let [positive, negative] = Side::BOTH.map(|side| problem.response(side));
    for (contact, state) in states.iter().enumerate() {
        for row in 0..rows {
            let of = |part: &IntervalMatrix| part.centre()[(row, contact)];
            let identity = if row == contact { 1.0 } else { 0.0 };
            matrix[(row, contact)] = match state {
                Some(ContactState::Positive) => identity - of(positive),
                Some(ContactState::Negative) => identity + of(negative),
                Some(ContactState::Gap) => {
                    of(problem.jumps(Side::Negative)) - of(problem.jumps(Side::Positive))
                }
                None => {
                    let (plus, minus) =
                        (0.5 * (of(positive) + of(negative)), 0.5 * (of(positive) - of(negative)));
                    identity - minus - slopes.contacts[contact] * plus
                }
            };
        }
    }
    for (hinge, slope) in slopes.hinges.iter().enumerate() {
        for (component, at) in problem.rows_of_hinge(hinge).into_iter().enumerate() {
            for row in 0..rows {
                let identity = if row == at { 1.0 } else { 0.0 };
                let response = positive.centre()[(row, problem.contacts() + hinge)];
                matrix[(row, at)] = identity - response * slope[component];
            }
        }
    }
    matrix
}

impl BlockProblem {
    /// Returns `I - H D` in a solution with these states of the contacts and reactions of the hinges, with the directions
    /// `x_j / |x_j|` of the blocks on the diagonal of `D` (theory of hinges, section 4); the column of a contact in its gap is
    /// that of its share, `d_k^- - d_k^+`.
    pub fn slopes(&self, states: &[ContactState], reactions: &[[f64; 2]]) -> DMatrix<f64> {
        let states: Vec<_> = states.iter().copied().map(Some).collect();
        let hinges = reactions.iter().copied().map(unit).collect();
        matrix(self, &states, &Slopes { contacts: vec![0.0; self.contacts()], hinges })
    }
}

/// `b + d`: the right-hand side for the states of a piece, in which no contact that jumps is open.
pub(crate) fn load<T: Real>(problem: &BlockProblem, states: &[Option<ContactState>]) -> DVector<T> {
    let jump = |row: usize, contact: usize, state: Option<ContactState>| {
        let side = state.map_or(Side::Positive, BlockProblem::constant_jump);
        entry::<T>(problem.jumps(side), row, contact)
    };
    DVector::from_fn(problem.rows(), |row, _| {
        let jumps = states.iter().enumerate().map(|(contact, &state)| jump(row, contact, state));
        jumps.fold(entry::<T>(problem.load(), row, 0), |sum, jump| sum + jump)
    })
}

/// The residual `x - b - d - H w` of a point.
pub(super) fn residual<T: Real>(
    problem: &BlockProblem,
    states: &[Option<ContactState>],
    point: &DVector<f64>,
) -> DVector<T> {
    let exact = point.map(T::exactly);
    let mut residual = -load::<T>(problem, states);
    for (contact, state) in states.iter().enumerate() {
        let value = exact[contact];
        let side = if point[contact] >= 0.0 { ContactState::Positive } else { ContactState::Negative };
        let (identity, part, factor) = match state.unwrap_or(side) {
            ContactState::Positive => (value, problem.response(Side::Positive), value),
            ContactState::Negative => (value, problem.response(Side::Negative), -value),
            ContactState::Gap => (T::zero(), problem.jumps(Side::Positive), value),
        };
        residual[contact] += identity;
        for row in 0..problem.rows() {
            residual[row] -= entry::<T>(part, row, contact) * factor;
            if *state == Some(ContactState::Gap) {
                residual[row] += entry::<T>(problem.jumps(Side::Negative), row, contact) * factor;
            }
        }
    }
    for hinge in 0..problem.hinges() {
        let [one, other] = problem.rows_of_hinge(hinge);
        let length = exact[one].hypot(exact[other]);
        residual[one] += exact[one];
        residual[other] += exact[other];
        for row in 0..problem.rows() {
            residual[row] -=
                entry::<T>(problem.response(Side::Positive), row, problem.contacts() + hinge) * length;
        }
    }
    residual
}
