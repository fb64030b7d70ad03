//! The greatest of the least of some affine functions: a linear program with few unknowns.

use microlp::{ComparisonOp, OptimizationDirection, Problem};
use nalgebra::Vector3;

/// Greater values are not sought: the reactions of a wedged block may grow without bound.
const GREATEST: f64 = 1.0;
/// Functions may miss the optimum by this.
const ROUNDING: f64 = 1e-12;
/// Determinants below this are zero; the functions have coefficients of order one.
const SINGULAR: f64 = 1e-12;
/// More functions of two unknowns are left to the simplex method.
const MOST_OF_TWO: usize = 20;
/// Functions are multiplied by this power of two, so that the solver, whose tolerance is absolute, misses them less.
const MAGNIFIED: f64 = 8192.0;

/// A function `coefficients . z + constant`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Affine {
    /// Coefficients of the unknowns.
    pub(super) coefficients: Vec<f64>,
    /// The constant.
    pub(super) constant: f64,
}

impl Affine {
    /// Its value.
    pub(super) fn at(&self, z: &[f64]) -> f64 {
        self.coefficients.iter().zip(z).map(|(a, z)| a * z).sum::<f64>() + self.constant
    }
}

/// The linear program was not solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Unsolved;

/// The point at which the least of the functions is greatest, but no more than 1, and that value.
pub(super) fn highest(functions: &[Affine], dimension: usize) -> Result<(f64, Vec<f64>), Unsolved> {
    let least = |z: &[f64]| functions.iter().map(|f| f.at(z)).fold(GREATEST, f64::min);
    match dimension {
        0 => Ok((least(&[]), Vec::new())),
        1 => of_one(functions).map(|z| (least(&[z]), vec![z])).ok_or(Unsolved),
        2 if functions.len() <= MOST_OF_TWO => {
            of_two(functions).map(|z| (least(&z), z.to_vec())).ok_or(Unsolved)
        }
        _ => by_simplex(functions, dimension).map(|z| (least(&z), z)),
    }
}

/// One unknown: the optimum is where a rising and a falling function meet, or a rising one reaches the greatest value.
fn of_one(functions: &[Affine]) -> Option<f64> {
    let line = |f: &Affine| (f.coefficients[0], f.constant);
    let cap = std::iter::once((0.0, GREATEST));
    let lines: Vec<(f64, f64)> = functions.iter().map(line).chain(cap).collect();
    let least = |z: f64| lines.iter().map(|(a, b)| a * z + b).fold(f64::INFINITY, f64::min);
    let mut best: Option<(f64, f64)> = None;
    for (index, (a, b)) in lines.iter().enumerate() {
        for (c, d) in &lines[index + 1..] {
            if (a - c).abs() <= SINGULAR || a * c > 0.0 {
                continue;
            }
            let z = (d - b) / (a - c);
            let value = least(z);
            if best.is_none_or(|(other, _)| value > other) {
                best = Some((value, z));
            }
        }
    }
    best.map(|(_, z)| z)
}

/// Two unknowns: the best of the points where three functions are equal and no other is less.
fn of_two(functions: &[Affine]) -> Option<[f64; 2]> {
    let plane = |f: &Affine| Vector3::new(f.coefficients[0], f.coefficients[1], f.constant);
    let cap = std::iter::once(Vector3::new(0.0, 0.0, GREATEST));
    let planes: Vec<Vector3<f64>> = functions.iter().map(plane).chain(cap).collect();
    let mut best: Option<(f64, [f64; 2])> = None;
    for first in 0..planes.len() {
        for second in first + 1..planes.len() {
            for third in second + 1..planes.len() {
                let rows = [first, second, third].map(|index| planes[index]);
                let Some([t, x, y]) = meeting(&rows) else { continue };
                if best.is_some_and(|(other, _)| t <= other) {
                    continue;
                }
                let tolerance = ROUNDING * (1.0 + x.abs() + y.abs());
                if planes.iter().all(|p| p.x * x + p.y * y + p.z >= t - tolerance) {
                    best = Some((t, [x, y]));
                }
            }
        }
    }
    best.map(|(_, z)| z)
}

/// Where three planes have the same height: t - x a - y b = c.
fn meeting(planes: &[Vector3<f64>; 3]) -> Option<[f64; 3]> {
    let [p, q, r] = planes;
    let cross = |a: f64, b: f64, c: f64, d: f64| a * d - b * c;
    // The third plane less each of the others: (r - p) . z = p0 - r0.
    let (a, b, e) = (r.x - p.x, r.y - p.y, p.z - r.z);
    let (c, d, f) = (r.x - q.x, r.y - q.y, q.z - r.z);
    let whole = cross(a, b, c, d);
    if whole.abs() <= SINGULAR {
        return None;
    }
    let (x, y) = (cross(e, b, f, d) / whole, cross(a, e, c, f) / whole);
    Some([r.x * x + r.y * y + r.z, x, y])
}

fn by_simplex(functions: &[Affine], dimension: usize) -> Result<Vec<f64>, Unsolved> {
    let mut problem = Problem::new(OptimizationDirection::Maximize);
    let free = (f64::NEG_INFINITY, f64::INFINITY);
    let unknowns: Vec<_> = (0..dimension).map(|_| problem.add_var(0.0, free)).collect();
    let least = problem.add_var(1.0, (f64::NEG_INFINITY, GREATEST));
    for function in functions {
        let pairs = unknowns.iter().copied().zip(&function.coefficients);
        let mut row: Vec<_> = pairs.filter(|(_, a)| **a != 0.0).map(|(v, a)| (v, MAGNIFIED * a)).collect();
        row.push((least, -MAGNIFIED));
        problem.add_constraint(&row[..], ComparisonOp::Ge, -MAGNIFIED * function.constant);
    }
    let outcome = problem.solve().map_err(|_| Unsolved)?;
    let solution = outcome.into_solution().map_err(|_| Unsolved)?;
    let point: Vec<f64> = unknowns.iter().map(|unknown| solution[*unknown]).collect();
    if point.iter().all(|value| value.is_finite()) { Ok(point) } else { Err(Unsolved) }
}
