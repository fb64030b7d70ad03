//! Regions that are not decided: what is seen there, and which of them are one.

use nalgebra::{DMatrix, DVector};

use super::equations::{Piece, Slopes, load, matrix, residual};
use super::problem::BlockProblem;
use super::relaxation::{RelaxedPoint, largest};
use super::result::{OpenLabel, OpenRegion};
use super::sector::{Sector, length};
use super::zero::{Zero, slopes_at};
use crate::dense::singular_values;

/// A share of the load below this is that of a point at infinity.
const NO_LOAD: f64 = 1e-6;
/// Forces below this share of the largest count as zero.
const NO_FORCE: f64 = 1e-8;
/// Singular values below this share of the largest count as zero: on a curve of solutions, and near a fold.
const SINGULAR_ON_CURVE: f64 = 1e-7;
const SINGULAR_NEAR_FOLD: f64 = 1e-4;
/// Residuals below this share of the forces count as zero.
const NO_RESIDUAL: f64 = 1e-14;
/// The relative length of the step along a curve of solutions.
const STEP: f64 = 1e-3;
/// Singular values below this share of the largest have no part in a step.
const CUT: f64 = 1e-6;
/// Steps of the Gauss-Newton method.
const STEPS: usize = 60;
/// Regions whose sectors are at most this many of their half angles apart are one.
const NEAR: f64 = 4.0;

/// A piece that is not decided, and a point in it or nearby.
pub(super) struct Undecided {
    pub(super) label: OpenLabel,
    pub(super) piece: Piece,
    pub(super) point: Vec<f64>,
}

impl Undecided {
    /// A small piece: what is seen there decides the label.
    pub(super) fn new(problem: &BlockProblem, piece: Piece, relaxed: Option<RelaxedPoint>) -> Self {
        let Some(relaxed) = relaxed else {
            return Self { label: OpenLabel::TooSmall, piece, point: vec![0.0; problem.rows()] };
        };
        if let Some(point) = point_of_continuum(problem, &piece) {
            return Self { label: OpenLabel::Continuum, piece, point };
        }
        let label = label(problem, &piece, &relaxed);
        let near = || gauss_newton(problem, &piece, DVector::from_column_slice(&relaxed.unknowns));
        let point = match label {
            OpenLabel::LockingDirection => Some(direction(&relaxed.unknowns)),
            OpenLabel::TooSmall => None,
            _ => near().map(|point| point.as_slice().to_vec()),
        };
        Self { label, point: point.unwrap_or(relaxed.unknowns), piece }
    }

    /// A zero of which it is open whether, or how often, it is a solution; its reactions may have any direction.
    pub(super) fn at(zero: &Zero, label: OpenLabel) -> Self {
        let (states, point) = (zero.states.clone(), zero.point.as_slice().to_vec());
        let hinges = (point.len() - states.len()) / 2;
        Self { label, piece: Piece { states, sectors: vec![Sector::All; hinges] }, point }
    }
}

fn label(problem: &BlockProblem, piece: &Piece, relaxed: &RelaxedPoint) -> OpenLabel {
    if relaxed.load < NO_LOAD {
        return OpenLabel::LockingDirection;
    }
    let point = DVector::from_column_slice(&relaxed.unknowns);
    let least = NO_FORCE * point.amax();
    let is_unloaded = |hinge| length(problem.rows_of_hinge(hinge).map(|row| point[row])) <= least;
    let is_at_border = |contact: usize| {
        piece.states[contact].is_some_and(|state| state.sign() != 0.0) && point[contact].abs() <= least
    };
    if (0..problem.hinges()).any(is_unloaded) {
        OpenLabel::UnloadedHinge
    } else if (0..problem.contacts()).any(is_at_border) {
        OpenLabel::Boundary
    } else if piece.may_jump(problem) {
        OpenLabel::TooSmall
    } else {
        let slopes = matrix(problem, &piece.states, &slopes_at(problem, &point));
        match singular_values(&slopes, [false; 2]).map(|found| found.singular_values) {
            Some(values) if values.min() <= SINGULAR_NEAR_FOLD * values.max() => OpenLabel::Fold,
            _ => OpenLabel::TooSmall,
        }
    }
}

/// A direction in which solutions run to infinity, with one as its largest component.
fn direction(unknowns: &[f64]) -> Vec<f64> {
    let largest = largest(unknowns);
    unknowns.iter().map(|value| value / largest).collect()
}

/// A point of a curve of solutions near the middle of a piece; `None` if there seems to be none.
///
/// The matrix of slopes is singular there, and a step along its null vector leads back to another solution.
pub(super) fn point_of_continuum(problem: &BlockProblem, piece: &Piece) -> Option<Vec<f64>> {
    if problem.has_no_load() || piece.may_jump(problem) {
        return None;
    }
    let hinges = piece.sectors.iter().map(|sector| sector.disc().0).collect();
    let slopes = Slopes { contacts: vec![0.0; problem.contacts()], hinges };
    let middle: DMatrix<f64> = matrix(problem, &piece.states, &slopes);
    let start = singular_values(&middle, [true; 2])?.solve(&load(problem, &piece.states), CUT).ok()?;
    let point = gauss_newton(problem, piece, start)?;
    let decomposition =
        singular_values(&matrix(problem, &piece.states, &slopes_at(problem, &point)), [false, true])?;
    let values = &decomposition.singular_values;
    let (at, least) = values.argmin();
    if least > SINGULAR_ON_CURVE * values.max() {
        return None;
    }
    let direction = decomposition.v_t?.row(at).transpose();
    let step = STEP * point.amax();
    let moved = gauss_newton(problem, piece, &point + direction * step)?;
    ((&moved - &point).norm() > 0.5 * step).then(|| point.as_slice().to_vec())
}

/// A solution by shortest Newton steps, which also exist on curves of solutions.
fn gauss_newton(problem: &BlockProblem, piece: &Piece, start: DVector<f64>) -> Option<DVector<f64>> {
    let mut point = start;
    let size = point.amax().max(load::<f64>(problem, &piece.states).amax());
    for _ in 0..STEPS {
        let error: DVector<f64> = residual(problem, &piece.states, &point);
        if error.amax() <= NO_RESIDUAL * size {
            return Some(point);
        }
        let slopes: DMatrix<f64> = matrix(problem, &piece.states, &slopes_at(problem, &point));
        let decomposition = singular_values(&slopes, [true; 2])?;
        let cut = CUT * decomposition.singular_values.max();
        point -= decomposition.solve(&error, cut).ok()?;
        if !point.amax().is_finite() {
            return None;
        }
    }
    None
}

/// The regions that undecided pieces make up.
pub(super) fn regions(pieces: Vec<Undecided>) -> Vec<OpenRegion> {
    let mut joined: Vec<Undecided> = Vec::new();
    for mut piece in pieces {
        // What was joined before may now touch others.
        while let Some((at, hull)) =
            joined.iter().enumerate().find_map(|(at, other)| Some((at, join(&piece, other)?)))
        {
            piece.piece = hull;
            let other = joined.remove(at);
            if rank(other.label) < rank(piece.label) {
                piece.label = other.label;
                piece.point = other.point;
            }
        }
        joined.push(piece);
    }
    joined.into_iter().map(region).collect()
}

fn region(piece: Undecided) -> OpenRegion {
    OpenRegion {
        label: piece.label,
        half_angle: piece.piece.half_angle(),
        sectors: piece.piece.sectors.iter().map(|sector| sector.edges()).collect(),
        states: piece.piece.states,
        point: piece.point,
    }
}

/// Which label says most about a region of several pieces.
fn rank(label: OpenLabel) -> usize {
    let order = [
        OpenLabel::Continuum,
        OpenLabel::LockingDirection,
        OpenLabel::UnloadedHinge,
        OpenLabel::Boundary,
        OpenLabel::Fold,
        OpenLabel::TooSmall,
    ];
    order.iter().position(|&other| other == label).unwrap_or(order.len())
}

/// The hull of two pieces with the same states that touch or nearly so.
fn join(one: &Undecided, other: &Undecided) -> Option<Piece> {
    if one.piece.states != other.piece.states {
        return None;
    }
    let sectors = one.piece.sectors.iter().zip(&other.piece.sectors).map(|(one, other)| {
        let slack = NEAR * one.half_angle().min(other.half_angle());
        one.joined(*other, slack)
    });
    let sectors: Option<Vec<Sector>> = sectors.collect();
    Some(Piece { states: one.piece.states.clone(), sectors: sectors? })
}
