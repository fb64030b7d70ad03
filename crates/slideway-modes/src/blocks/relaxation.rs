//! The linear relaxation of a piece, and proofs that a piece has no solution.
//!
//! Mixtures `(x_j, w_j)` of rays contain `(x_j, |x_j|)` for all `x_j` of a sector, so that a solution is a
//! mixture of columns, as in the mode problem:
//!
//! ```text
//! sum_g lambda_g (x_g - H_j w_g) = mu (b + d),   lambda >= 0,   mu = 1
//! ```
//!
//! The program looks for the least sum of errors of these equations with `sum lambda + mu = 1` instead of
//! `mu = 1`, which includes solutions at infinity. If it is positive, its multipliers `v` have a positive
//! product with every column and a negative one with every load. The equations of small pieces are combined so
//! that the columns of each thin sector are far apart; otherwise the sum of errors would fall with the square of
//! its angle, below what the simplex method tells from zero. Whether `v` proves anything is then decided
//! for the sectors themselves, in interval arithmetic (theory of hinges, section 8, (i), (ii)).

use nalgebra::{DMatrix, DVector};

use super::equations::{Piece, Slopes, matrix};
use super::problem::BlockProblem;
use super::sector::length;
use crate::dense::singular_values;
use crate::interval::Interval;
use crate::interval_matrix::{IntervalMatrix, inner_product};
use crate::problem::{ContactState, Side, column_slice, pressed_sides};
use crate::simplex::{Bounds, LinearOutcome, LinearProgram};

/// A piece is not excluded if the least sum of errors is below this.
const LEAST: f64 = 1e-15;

/// Equations are combined where all sectors have at most this half angle, in rad.
const SMALL: f64 = 0.3;

/// A point of the relaxation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RelaxedPoint {
    /// `x`, row by row, divided by `mu`, unless that is nearly zero: then a direction.
    pub(super) unknowns: Vec<f64>,
    /// The share `mu` of the load: nearly zero if the point is at infinity.
    pub(super) load: f64,
    /// How far each contact is from being on one side, and each hinge from `w = |R|`.
    pub(super) gaps: Vec<f64>,
}

/// What the relaxation says of a piece.
pub(super) enum Relaxed {
    /// It is proven to hold no solution; without load, none but zero.
    Empty,
    /// It may hold solutions.
    Point(RelaxedPoint),
    /// The program was not solved.
    Unsolved,
}

/// What a column of the program stands for.
enum Meaning {
    /// A contact pressed on a side.
    Pressed(usize, Side),
    /// A ray of a hinge.
    Ray(usize, [f64; 2], f64),
    /// `mu`.
    Load,
    /// The share of a jump vector, or an error.
    Other,
}

/// The columns of the program.
struct Columns<'p> {
    /// What combines the equations.
    combination: Option<&'p DMatrix<f64>>,
    meanings: Vec<(Meaning, f64)>,
    vectors: Vec<Vec<f64>>,
    cost: Vec<f64>,
    /// How many equations there are, with those of the sums.
    all: usize,
}

impl Columns<'_> {
    /// A column of the equations, combined, with room for the sums.
    fn combined(&self, column: impl ExactSizeIterator<Item = f64>) -> Vec<f64> {
        let mut combined = Vec::with_capacity(self.all);
        match self.combination {
            Some(combination) => {
                combined.resize(combination.nrows(), 0.0);
                for (value, part) in column.zip(combination.column_iter()) {
                    combined.iter_mut().zip(&part).for_each(|(sum, entry)| *sum += value * entry);
                }
            }
            None => combined.extend(column),
        }
        combined
    }

    /// Adds a combined column, scaled by a factor.
    fn add(&mut self, meaning: Meaning, factor: f64, mut column: Vec<f64>, cost: f64) {
        column.iter_mut().for_each(|value| *value *= factor);
        column.resize(self.all, 0.0);
        self.vectors.push(column);
        self.meanings.push((meaning, factor));
        self.cost.push(cost);
    }

    /// Adds a column of the equations, scaled so that its largest entry is one, as is its part of the sum of all shares.
    fn add_share(&mut self, meaning: Meaning, column: impl ExactSizeIterator<Item = f64>) {
        let mut column = self.combined(column);
        let size = largest(&column);
        column.push(size);
        self.add(meaning, 1.0 / size, column, 0.0);
    }
}

/// The largest size of an entry, and not zero.
pub(super) fn largest(entries: &[f64]) -> f64 {
    entries.iter().fold(f64::MIN_POSITIVE, |most, value| most.max(value.abs()))
}

/// The relaxation of a piece; `pivots` counts those of the simplex method. It is not solved once `proceed` is `false`.
pub(super) fn relax(
    problem: &BlockProblem,
    piece: &Piece,
    pivots: &mut u64,
    proceed: &mut dyn FnMut() -> bool,
) -> Relaxed {
    let jumping: Vec<usize> =
        (0..problem.contacts()).filter(|&contact| shares(problem, piece, contact)).collect();
    let combination = combination(problem, piece);
    let equations = combination.as_ref().map_or(problem.rows(), DMatrix::nrows);
    let columns = columns(problem, piece, &jumping, combination.as_ref());
    let mut right = vec![0.0; columns.all];
    right[equations] = 1.0;
    let program = LinearProgram::new(&columns.vectors, right, columns.cost);
    let count = program.columns();
    let bounds = Bounds { lower: vec![0.0; count], upper: vec![f64::INFINITY; count] };
    let mut basis = program.artificial_basis();
    let LinearOutcome::Feasible(values) = program.solve(&mut basis, &bounds, pivots, proceed) else {
        return Relaxed::Unsolved;
    };
    let errors: f64 = values[count - 2 * equations..].iter().sum();
    if errors > LEAST {
        let multipliers = basis.multipliers(&program);
        let vector = -DVector::from_column_slice(&multipliers[..equations]);
        let vector = combination.as_ref().map_or(vector.clone(), |combination| combination.tr_mul(&vector));
        if excludes(problem, piece, vector.as_slice()) {
            return Relaxed::Empty;
        }
    }
    Relaxed::Point(point(problem, &columns.meanings, &values))
}

/// Whether a contact contributes a mixture of both jump vectors to the load.
pub(super) fn shares(problem: &BlockProblem, piece: &Piece, contact: usize) -> bool {
    problem.has_jump(contact) && piece.states[contact].is_none_or(|state| state == ContactState::Gap)
}

/// The combination `P` of the equations of a small piece: the inverse of the slopes in its middle, and for each
/// hinge the component along its sector, and the one across it divided by the half angle.
///
/// Where those slopes are nearly singular, as near locking and folds, the inverse would be the same equation many times:
/// `u . A = 0`, with the left singular vector `u`. It stands alone then, divided by the square of the half angle, by which it
/// varies in the piece, and the pseudo-inverse leaves it out of the others.
fn combination(problem: &BlockProblem, piece: &Piece) -> Option<DMatrix<f64>> {
    let half_angle = piece.half_angle();
    // Without hinges nothing is curved.
    if half_angle > SMALL || piece.sectors.is_empty() {
        return None;
    }
    let hinges = piece.sectors.iter().map(|sector| sector.disc().0).collect();
    let slopes = Slopes { contacts: vec![0.0; problem.contacts()], hinges };
    let slopes = matrix(problem, &piece.states, &slopes);
    let spread = half_angle.powi(2);
    let is_regular = |inverse: &DMatrix<f64>| inverse.norm() * slopes.norm() * spread < 1.0;
    let (mut combination, alone) = match slopes.clone().try_inverse().filter(is_regular) {
        Some(inverse) => (inverse, DMatrix::zeros(0, problem.rows())),
        None => divided(slopes, spread)?,
    };
    for (hinge, sector) in piece.sectors.iter().enumerate() {
        let ([x, y], [one, other]) = (sector.middle(), problem.rows_of_hinge(hinge));
        if [x, y] != [0.0; 2] {
            let half_angle = sector.half_angle();
            let (first, second) = (combination.row(one).into_owned(), combination.row(other).into_owned());
            combination.set_row(one, &(&first * x + &second * y));
            combination.set_row(other, &((second * x - first * y) / half_angle));
        }
    }
    let all = DMatrix::from_fn(problem.rows() + alone.nrows(), problem.rows(), |row, column| {
        row.checked_sub(problem.rows()).map_or_else(|| combination[(row, column)], |row| alone[(row, column)])
    });
    all.iter().all(|value| value.is_finite()).then_some(all)
}

/// The pseudo-inverse of a matrix without the singular values below this share of the greatest, and their left vectors divided
/// by that share.
fn divided(matrix: DMatrix<f64>, share: f64) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let size = matrix.amax();
    if !size.is_normal() {
        return None;
    }
    let svd = singular_values(&(matrix / size), [true; 2])?;
    let cut = share * svd.singular_values.max();
    let small: Vec<usize> =
        (0..svd.singular_values.len()).filter(|&at| svd.singular_values[at] <= cut).collect();
    let alone = svd.u.as_ref()?.select_columns(&small).transpose() / (share * size);
    Some((svd.pseudo_inverse(cut).ok()? / size, alone))
}

/// The columns of the program, with combined equations.
fn columns<'p>(
    problem: &BlockProblem,
    piece: &Piece,
    jumping: &[usize],
    combination: Option<&'p DMatrix<f64>>,
) -> Columns<'p> {
    let rows = problem.rows();
    let equations = combination.map_or(rows, DMatrix::nrows);
    let all = equations + 1 + jumping.len();
    // Of both sides of contacts, the rays of hinges, the load with its jumps, and errors.
    let most = 4 * rows + 2 * equations + 1 + 2 * jumping.len();
    let mut columns = Columns {
        combination,
        meanings: Vec::with_capacity(most),
        vectors: Vec::with_capacity(most),
        cost: Vec::with_capacity(most),
        all,
    };
    for (contact, &state) in piece.states.iter().enumerate() {
        for &side in pressed_sides(state) {
            let response = centre(problem.response(side), contact).iter().enumerate();
            let own = |row: usize| if row == contact { side.sign() } else { 0.0 };
            columns.add_share(Meaning::Pressed(contact, side), response.map(|(row, value)| own(row) - value));
        }
    }
    for (hinge, sector) in piece.sectors.iter().enumerate() {
        let response = centre(problem.response(Side::Positive), problem.contacts() + hinge);
        let [first, second] = problem.rows_of_hinge(hinge);
        for (direction, length) in sector.rays() {
            let own = |row: usize| match row {
                _ if row == first => direction[0],
                _ if row == second => direction[1],
                _ => 0.0,
            };
            let column = response.iter().enumerate().map(|(row, value)| own(row) - value * length);
            columns.add_share(Meaning::Ray(hinge, direction, length), column);
        }
    }
    add_loads(&mut columns, problem, piece, jumping);
    for row in 0..equations {
        for sign in [1.0, -1.0] {
            let mut column = vec![0.0; all];
            column[row] = sign;
            columns.add(Meaning::Other, 1.0, column, 1.0);
        }
    }
    columns
}

/// `-mu (b + d)`, where shares of both jump vectors of a contact add up to `mu`.
fn add_loads(columns: &mut Columns<'_>, problem: &BlockProblem, piece: &Piece, jumping: &[usize]) {
    if problem.has_no_load() {
        return;
    }
    let first = columns.all - jumping.len();
    let mut load: Vec<f64> = centre(problem.load(), 0).iter().map(|value| -value).collect();
    for (contact, &state) in piece.states.iter().enumerate().filter(|(contact, _)| !jumping.contains(contact))
    {
        let side = state.map_or(Side::Positive, BlockProblem::constant_jump);
        for (load, jump) in load.iter_mut().zip(centre(problem.jumps(side), contact)) {
            *load -= jump;
        }
    }
    let mut load = columns.combined(load.into_iter());
    let jump = |&contact: &usize| {
        let negated = |side| centre(problem.jumps(side), contact).iter().map(|value| -value);
        Side::BOTH.map(|side| columns.combined(negated(side)))
    };
    let jumps: Vec<[Vec<f64>; 2]> = jumping.iter().map(jump).collect();
    let size = jumps.iter().flatten().fold(largest(&load), |most, jump| most.max(largest(jump)));
    load.push(size);
    load.extend(jumps.iter().map(|_| -size));
    for (at, both) in jumps.into_iter().enumerate() {
        for mut column in both {
            column.resize(columns.all, 0.0);
            column[first + at] = size;
            columns.add(Meaning::Other, 1.0 / size, column, 0.0);
        }
    }
    columns.add(Meaning::Load, 1.0 / size, load, 0.0);
}

/// The point of the unknowns for the values of the columns.
fn point(problem: &BlockProblem, meanings: &[(Meaning, f64)], values: &[f64]) -> RelaxedPoint {
    let contacts = problem.contacts();
    let mut unknowns = vec![0.0; problem.rows()];
    let mut pressed = vec![[0.0; 2]; contacts];
    let mut lengths = vec![0.0; problem.hinges()];
    let mut load = 0.0;
    for ((meaning, factor), value) in meanings.iter().zip(values) {
        let amount = value * factor;
        match *meaning {
            Meaning::Pressed(contact, side) => {
                unknowns[contact] += side.sign() * amount;
                pressed[contact][usize::from(side == Side::Negative)] += amount;
            }
            Meaning::Ray(hinge, direction, length) => {
                lengths[hinge] += length * amount;
                for (row, component) in problem.rows_of_hinge(hinge).into_iter().zip(direction) {
                    unknowns[row] += component * amount;
                }
            }
            // The share of the sum, which is 1.
            Meaning::Load => load = (*value).max(0.0),
            Meaning::Other => {}
        }
    }
    let of_hinge = |(hinge, whole): (usize, &f64)| {
        (whole - length(problem.rows_of_hinge(hinge).map(|row| unknowns[row]))).abs()
    };
    let gaps: Vec<f64> = pressed
        .iter()
        .map(|[one, other]| one.min(*other))
        .chain(lengths.iter().enumerate().map(of_hinge))
        .collect();
    let scale = meanings.iter().zip(values).find_map(|((meaning, factor), value)| {
        (matches!(meaning, Meaning::Load) && *value > f64::MIN_POSITIVE).then(|| value * factor)
    });
    if let Some(scale) = scale.filter(|_| load > 1e-12) {
        unknowns.iter_mut().for_each(|value| *value /= scale);
    }
    RelaxedPoint { unknowns, load, gaps }
}

/// Whether a vector proves that a piece holds no solution; without load, none but zero.
///
/// For a solution the products of `v` with all `x_j - H_j |x_j|` add up to `v . (b + d)`. No one may be
/// negative while the latter is; without load, all must be positive unless `x_j` is zero.
fn excludes(problem: &BlockProblem, piece: &Piece, vector: &[f64]) -> bool {
    let strict = problem.has_no_load();
    let is_fine = |least: f64| if strict { least > 0.0 } else { least >= 0.0 };
    let contacts = piece.states.iter().enumerate().all(|(contact, &state)| {
        pressed_sides(state).iter().all(|&side| {
            let own = Interval::point(vector[contact]) * Interval::point(side.sign());
            is_fine((own - times(vector, problem.response(side), contact)).lower())
        })
    });
    let hinges = piece.sectors.iter().enumerate().all(|(hinge, sector)| {
        let response = times(vector, problem.response(Side::Positive), problem.contacts() + hinge);
        let own = sector.least(problem.rows_of_hinge(hinge).map(|row| vector[row]));
        is_fine((Interval::point(own) - response).lower())
    });
    if !contacts || !hinges || strict {
        return contacts && hinges;
    }
    load_product(problem, piece, vector).upper() < 0.0
}

/// Bounds of the product of a vector with all loads `b + d` of a piece.
pub(super) fn load_product(problem: &BlockProblem, piece: &Piece, vector: &[f64]) -> Interval {
    let jump = |(contact, &state): (usize, &Option<ContactState>)| {
        let [positive, negative] = Side::BOTH.map(|side| times(vector, problem.jumps(side), contact));
        match state {
            _ if shares(problem, piece, contact) => positive.hull(negative),
            Some(ContactState::Negative | ContactState::Gap) => negative,
            Some(ContactState::Positive) | None => positive,
        }
    };
    piece.states.iter().enumerate().map(jump).fold(times(vector, problem.load(), 0), |sum, part| sum + part)
}

/// Bounds of the product of a vector with a column.
fn times(vector: &[f64], part: &IntervalMatrix, column: usize) -> Interval {
    inner_product(vector, centre(part, column), Some(column_slice(part.radius(), column)))
}

fn centre(part: &IntervalMatrix, column: usize) -> &[f64] {
    column_slice(part.centre(), column)
}
