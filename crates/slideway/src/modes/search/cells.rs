//! The patterns that can occur where the coupling is of low rank: cells of a hyperplane arrangement.
//!
//! Every cell of an arrangement in `q` dimensions whose normals span the space has an edge, which lies
//! on a line where `q - 1` hyperplanes meet. Walking along all these lines, contact after contact
//! changes its side, and the pattern's `q x q` equations
//!
//! ```text
//! (I + sum_k v_k u_k^T / delta_k) z = sum_k v_k b_k / delta_k
//! ```
//!
//! change by a matrix of rank one. A pattern is a candidate if its `z` lies in its cell, up to a
//! tolerance far above rounding; candidates are then solved with the full equations.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};

use super::low_rank::LowRank;
use super::monitor::Monitor;

/// A sign of `s_i` may be wrong by this fraction of the size of its terms.
const SLACK: f64 = 1e-8;
/// Normals closer to orthogonal than this are parallel to the line.
const PARALLEL: f64 = 1e-10;
/// Determinants below this make a pattern a candidate without further tests.
const SINGULAR: f64 = 1e-10;
/// The most contacts that may change side on the same line for it to be walked.
const MOST_ON_LINE: usize = 8;

/// The most candidates: more means that singular patterns abound.
const MOST_CANDIDATES: usize = 20_000;

/// Patterns by the index of each contact's side.
pub(super) type Candidates = BTreeSet<Vec<u8>>;

/// What the walk along all lines found.
pub(super) struct Walked {
    pub(super) candidates: Candidates,
    pub(super) patterns: u64,
    /// The part of the lines that was walked before the monitor said stop.
    pub(super) fraction: f64,
}

/// A point in space and the equations of its pattern.
#[derive(Clone)]
struct Equations {
    matrix: DMatrix<f64>,
    load: DVector<f64>,
}

struct Line {
    /// Contacts whose `s` is zero all along the line, either side of which has cells.
    fixed: Vec<usize>,
    /// Contacts whose `s` changes its sign, with the place, in the order of places.
    crossings: Vec<(f64, usize)>,
    /// The sides at the beginning.
    sides: Vec<u8>,
}

/// Candidates of all cells; none if the arrangement is too degenerate for this walk.
pub(super) fn walk(problem: &LowRank, monitor: &mut Monitor<'_>) -> Option<Walked> {
    let contacts = problem.load.len();
    let mut walked = Walked { candidates: Candidates::new(), patterns: 0, fraction: 0.0 };
    let count = if problem.rank() == 1 { 1 } else { contacts };
    // The first hyperplane of each line; further ones come after it.
    for first in 0..count {
        if !monitor.visit(walked.fraction, walked.candidates.len()) {
            return Some(walked);
        }
        for chosen in subsets(first, contacts, problem.rank() - 1) {
            if let Some(line) = Line::new(problem, &chosen)? {
                line.walk(problem, &mut walked);
            }
            if walked.candidates.len() > MOST_CANDIDATES {
                return None;
            }
        }
        walked.fraction = (first + 1) as f64 / count as f64;
    }
    Some(walked)
}

/// The sets of `size` contacts whose least is `first`, for a size of up to 2.
fn subsets(first: usize, contacts: usize, size: usize) -> Vec<Vec<usize>> {
    match size {
        0 => vec![Vec::new()],
        1 => vec![vec![first]],
        _ => (first + 1..contacts).map(|second| vec![first, second]).collect(),
    }
}

impl Line {
    /// The line on which the `s` of the chosen contacts are zero: `Some(None)` if they are not
    /// independent, `None` if too many others are zero there as well.
    #[expect(clippy::option_option, reason = "no line, and giving up, are two things")]
    fn new(problem: &LowRank, chosen: &[usize]) -> Option<Option<Self>> {
        let Some((point, direction)) = meeting(problem, chosen) else { return Some(None) };
        let mut line = Self { fixed: Vec::new(), crossings: Vec::new(), sides: Vec::new() };
        for contact in 0..problem.load.len() {
            let normal = problem.left.row(contact);
            let offset = problem.load[contact] - normal.dot(&point.transpose());
            let slope = normal.dot(&direction.transpose());
            let size = problem.load[contact].abs() + normal.norm() * point.norm();
            let mut positive = offset > 0.0;
            if chosen.contains(&contact) {
                line.fixed.push(contact);
            } else if slope.abs() > PARALLEL * normal.norm() {
                line.crossings.push((offset / slope, contact));
                positive = slope > 0.0;
            } else if offset.abs() <= PARALLEL * size {
                line.fixed.push(contact);
            }
            line.sides.push(u8::from(problem.side(contact, positive) == 1));
        }
        line.crossings.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        (line.fixed.len() <= MOST_ON_LINE).then_some(Some(line))
    }

    fn walk(mut self, problem: &LowRank, walked: &mut Walked) {
        let mut equations = Equations::new(problem, &self.sides);
        for step in 0..=self.crossings.len() {
            self.try_sides(problem, &equations, step, walked);
            if let Some(&(_, contact)) = self.crossings.get(step) {
                equations.flip(problem, contact, &mut self.sides);
            }
        }
    }

    /// Tries the cells around one segment: both sides of each contact on the line.
    fn try_sides(&self, problem: &LowRank, equations: &Equations, step: usize, walked: &mut Walked) {
        let ends = [step.wrapping_sub(1), step];
        let ends: Vec<usize> =
            ends.iter().filter_map(|&at| self.crossings.get(at)).map(|&(_, contact)| contact).collect();
        for choice in 0..1_usize << self.fixed.len() {
            let (mut sides, mut equations) = (None, equations.clone());
            for (bit, &contact) in self.fixed.iter().enumerate() {
                if choice >> bit & 1 == 1 {
                    let sides = sides.get_or_insert_with(|| self.sides.clone());
                    equations.flip(problem, contact, sides);
                }
            }
            let sides = sides.as_deref().unwrap_or(&self.sides);
            walked.patterns += 1;
            if equations.solution_in_cell(problem, sides, &[&self.fixed, &ends]) {
                walked.candidates.insert(sides.to_vec());
            }
        }
    }
}

/// A point of the line on which some `s` are zero, and the line's direction.
fn meeting(problem: &LowRank, chosen: &[usize]) -> Option<(DVector<f64>, DVector<f64>)> {
    let rank = problem.rank();
    let normals: Vec<DVector<f64>> =
        chosen.iter().map(|&contact| problem.left.row(contact).transpose()).collect();
    let mut direction = match normals.as_slice() {
        [] => DVector::from_element(1, 1.0),
        [only] => DVector::from_vec(vec![-only[1], only[0]]),
        [one, other, ..] => one.cross(other),
    };
    let size: f64 = normals.iter().map(DVector::norm).product();
    if direction.norm() <= PARALLEL * size {
        return None;
    }
    direction.normalize_mut();
    let mut matrix = DMatrix::zeros(rank, rank);
    let mut offsets = DVector::zeros(rank);
    for (row, (normal, &contact)) in normals.iter().zip(chosen).enumerate() {
        matrix.set_row(row, &normal.transpose());
        offsets[row] = problem.load[contact];
    }
    matrix.set_row(rank - 1, &direction.transpose());
    Some((matrix.lu().solve(&offsets)?, direction))
}

impl Equations {
    fn new(problem: &LowRank, sides: &[u8]) -> Self {
        let rank = problem.rank();
        let mut equations = Self { matrix: DMatrix::identity(rank, rank), load: DVector::zeros(rank) };
        for (contact, &side) in sides.iter().enumerate() {
            equations.add(problem, contact, usize::from(side), 1.0);
        }
        equations
    }

    fn add(&mut self, problem: &LowRank, contact: usize, side: usize, factor: f64) {
        let weight = factor / problem.diagonal[side][contact];
        let load = problem.load[contact];
        for row in 0..problem.rank() {
            let entry = weight * problem.right[side][(row, contact)];
            self.load[row] += entry * load;
            for column in 0..problem.rank() {
                self.matrix[(row, column)] += entry * problem.left[(contact, column)];
            }
        }
    }

    /// Puts a contact on its other side.
    fn flip(&mut self, problem: &LowRank, contact: usize, sides: &mut [u8]) {
        self.add(problem, contact, usize::from(sides[contact]), -1.0);
        sides[contact] ^= 1;
        self.add(problem, contact, usize::from(sides[contact]), 1.0);
    }

    /// Whether the solution has the signs of its pattern; `first` are the contacts to look at
    /// before all others.
    fn solution_in_cell(&self, problem: &LowRank, sides: &[u8], first: &[&[usize]]) -> bool {
        let Some(z) = solved(&self.matrix, &self.load) else { return true };
        let rank = problem.rank();
        let fits = |contact: usize| {
            let (mut s, mut size) = (problem.load[contact], problem.load[contact].abs());
            for (at, z) in z.iter().enumerate().take(rank) {
                let term = problem.left[(contact, at)] * z;
                s -= term;
                size += term.abs();
            }
            let y = s * problem.diagonal[usize::from(sides[contact])][contact].signum();
            y >= -SLACK * size
        };
        first.iter().copied().flatten().all(|&contact| fits(contact)) && (0..sides.len()).all(fits)
    }
}

/// Cramer's rule for up to three unknowns; none if the determinant is nearly zero.
fn solved(matrix: &DMatrix<f64>, load: &DVector<f64>) -> Option<[f64; 3]> {
    let rank = load.len();
    let mut columns = [[0.0; 3]; 3];
    for (at, column) in columns.iter_mut().enumerate() {
        for (row, entry) in column.iter_mut().enumerate() {
            *entry = if at < rank && row < rank { matrix[(row, at)] } else { f64::from(u8::from(at == row)) };
        }
    }
    let mut right = [0.0; 3];
    right[..rank].copy_from_slice(load.as_slice());
    let [a, b, c] = columns;
    let determinant = triple(a, b, c);
    let size: f64 =
        columns.iter().map(|column| column.iter().map(|entry| entry * entry).sum::<f64>()).product();
    if determinant.abs() <= SINGULAR * size.sqrt() {
        return None;
    }
    let solution = [triple(right, b, c), triple(a, right, c), triple(a, b, right)];
    Some(solution.map(|value| value / determinant))
}

/// The determinant of three columns.
fn triple(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}
