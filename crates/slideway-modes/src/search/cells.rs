//! The patterns that can occur if the coupling has low rank, by subdivision.
//!
//! # What is covered
//! With the decomposition of [`low_rank`](super::low_rank), every solution is a point `x = (t, t z)`,
//! `t = 1 / max(1, |z|)`, on the surface of the cube of the `q + 1` homogeneous coordinates, so that no bound
//! of `z` is needed. On it, with `a_i = (b_i, -u_i)`,
//!
//! ```text
//! delta_i^{sigma_i} t y_i = s_i - e_i,   s_i = a_i . x,   |e_i| <= error_i
//! t z = sum_k v_k^{sigma_k} t y_k = sum_k phi_k(s_k - e_k),   phi_k(s) = g_k^+ s where s >= 0, else g_k^- s
//! ```
//!
//! where `g_k^+` and `g_k^-` are `v_k / delta_k` of the side that corresponds to the sign. These are `q`
//! equations on a surface of `q` dimensions. All their solutions lie in the boxes that remain when the
//! following is applied to the faces of the cube and their parts.
//!
//! # One box
//! Contacts for which `s_i`, reduced by `error_i`, has one sign all over the box are decided. For the others,
//! `phi_k(s) = (g^+ + g^-) / 2 s + (g^+ - g^-) / 2 |s|`, and `|s|` lies between `m s` and the chord `m s + c`
//! on the range of `s`. The equations are therefore linear up to a noise that shrinks faster than the box:
//! `G x + h` is within `noise` of zero. The box is dropped if that is impossible, is narrowed by a Krawczyk
//! step, and is otherwise halved. If all contacts are decided, or the box is so small that its noise cannot
//! be distinguished from the errors, every remaining pattern becomes a candidate.
//!
//! # One candidate
//! The `q x q` equations of the pattern are solved with bounds; it is dropped if some `s_i` certainly has the
//! wrong sign. The rest is decided with the full equations.
//!
//! # Rounding
//! All sums have at most `r` products of numbers that are bounded on the cube. Their rounding error is at
//! most a multiple of `r eps` of the sum of all terms, which is added to the error of each `s_i` and to the
//! noise at the start; the multiple is chosen far too large.

use std::collections::{BTreeSet, HashSet};

use super::inverse::{Inverse, ROUNDING, Vector};
use super::low_rank::{LARGEST_RANK, LowRank};
use super::monitor::Monitor;

/// Number of homogeneous coordinates.
const SPACE: usize = LARGEST_RANK + 1;
/// Boxes with few undecided contacts and a radius below this are left to the test of candidates.
const SMALL: f64 = 1.0 / 1024.0;
/// The most undecided contacts in a small box.
const FEW: usize = 4;
/// The most undecided contacts in a box that cannot be divided further.
const MOST_UNDECIDED: usize = 12;
/// Boxes are not divided below this radius.
const SMALLEST: f64 = 1e-13;
/// A box is narrowed again if this has shrunk it by this factor.
const WORTHWHILE: f64 = 0.7;
/// The most boxes.
const MOST_BOXES: u64 = 4_000_000;
/// The most candidates: if there are more, there are many singular patterns.
const MOST_CANDIDATES: usize = 20_000;

/// The most patterns that are tested one by one.
const MOST_TESTED: usize = 100_000;

/// Patterns by the index of each contact's side.
pub(super) type Candidates = BTreeSet<Vec<u8>>;

type Point = [f64; SPACE];

/// The candidates of all boxes.
pub(super) struct Covered {
    pub(super) candidates: Candidates,
    pub(super) boxes: u64,
    /// The part of the cube's surface that was covered before the monitor stopped the work.
    pub(super) fraction: f64,
}

/// A contact's hyperplane and its contribution to the equations on either side.
struct Hyperplane {
    /// `a_i`.
    normal: Point,
    /// Bound of the error of `s_i`, rounding included.
    error: f64,
    /// `g_i` where `s_i` is positive, and where it is not.
    slopes: [Vector; 2],
}

/// Part of a face of the cube.
#[derive(Clone)]
struct Patch {
    centre: Point,
    radius: Point,
    /// The coordinate that is 1 or -1.
    pinned: usize,
    /// Contacts that were not decided in the part from which this one was cut.
    undecided: Vec<usize>,
    /// The equations of all others.
    decided: [Point; LARGEST_RANK],
    /// The share of the cube's surface.
    share: f64,
}

/// The equations `|G x + h| <= noise` on a part.
struct ImageBounds {
    gradient: [Point; LARGEST_RANK],
    constant: Vector,
    noise: Vector,
}

/// All solutions of a problem as points on the cube.
pub(super) struct Cover<'a> {
    problem: &'a LowRank,
    rank: usize,
    hyperplanes: Vec<Hyperplane>,
    /// The combined errors and rounding in each equation.
    noise: Vector,
    open: Vec<Patch>,
    tested: HashSet<Vec<u8>>,
    covered: Covered,
}

/// Candidates for all solutions; `None` if there are too many of them, or too many boxes.
pub(super) fn cover(problem: &LowRank, monitor: &mut Monitor<'_>) -> Option<Covered> {
    let mut cover = Cover::new(problem);
    // If numbers overflow, nothing can be decided.
    if !cover.noise.iter().all(|noise| noise.is_finite()) {
        return None;
    }
    while let Some(part) = cover.open.pop() {
        let covered = &mut cover.covered;
        if !monitor.visit(covered.fraction, covered.candidates.len()) {
            return Some(cover.covered);
        }
        covered.boxes += 1;
        let too_many = cover.tested.len() > MOST_TESTED || covered.candidates.len() > MOST_CANDIDATES;
        if too_many || covered.boxes > MOST_BOXES {
            return None;
        }
        cover.visit(part)?;
    }
    cover.covered.fraction = 1.0;
    Some(cover.covered)
}

impl<'a> Cover<'a> {
    fn new(problem: &'a LowRank) -> Self {
        let (rank, contacts) = (problem.rank(), problem.load.len());
        let hyperplanes: Vec<Hyperplane> =
            (0..contacts).map(|contact| Hyperplane::new(problem, contact)).collect();
        let mut noise = [0.0; LARGEST_RANK];
        let mut terms = [1.0; LARGEST_RANK];
        for plane in &hyperplanes {
            for row in 0..rank {
                let steepest = plane.slopes[0][row].abs().max(plane.slopes[1][row].abs());
                noise[row] += steepest * plane.error;
                terms[row] += steepest * (plane.error + plane.normal.iter().map(|a| a.abs()).sum::<f64>());
            }
        }
        for row in 0..rank {
            noise[row] = (noise[row] + terms[row] * contacts as f64 * ROUNDING) * (1.0 + 1e-9);
        }
        let covered = Covered { candidates: Candidates::new(), boxes: 0, fraction: 0.0 };
        let open = faces(rank, contacts);
        Self { problem, rank, hyperplanes, noise, open, tested: HashSet::new(), covered }
    }

    /// Drops a part, records its candidates, or leaves smaller parts; `None` if that is not possible.
    fn visit(&mut self, mut part: Patch) -> Option<()> {
        let ranges = self.decide_contacts(&mut part);
        let equations = self.linearised(&part, &ranges);
        let before = part.widest();
        if equations.excludes(&part, self.rank) || !equations.narrow(&mut part, self.rank) {
            self.covered.fraction += part.share;
            return Some(());
        }
        let after = part.widest();
        let undecided = part.undecided.len();
        let is_few = undecided <= FEW && after < SMALL;
        if undecided == 0 || is_few || after < SMALLEST || self.is_lost_in_noise(&part, &equations) {
            self.covered.fraction += part.share;
            return (undecided <= MOST_UNDECIDED).then(|| self.file(&part));
        }
        if after < WORTHWHILE * before {
            self.open.push(part);
        } else {
            let axis = self.axis_to_halve(&part);
            self.open.extend(part.halves(axis));
        }
        Some(())
    }

    /// Moves contacts that are decided all over a part into its equations; returns midpoint and radius of the
    /// `s` of the others.
    fn decide_contacts(&self, part: &mut Patch) -> Vec<(f64, f64)> {
        let mut ranges = Vec::with_capacity(part.undecided.len());
        let mut undecided = std::mem::take(&mut part.undecided);
        undecided.retain(|&contact| {
            let plane = &self.hyperplanes[contact];
            let (middle, radius) = plane.range(&part.centre, &part.radius);
            if middle.abs() <= radius {
                ranges.push((middle, radius));
                return true;
            }
            let slope = &plane.slopes[usize::from(middle < 0.0)];
            add_product(&mut part.decided, slope, &plane.normal);
            false
        });
        part.undecided = undecided;
        ranges
    }

    fn linearised(&self, part: &Patch, ranges: &[(f64, f64)]) -> ImageBounds {
        let mut equations =
            ImageBounds { gradient: part.decided, constant: [0.0; LARGEST_RANK], noise: self.noise };
        for (&contact, &(middle, radius)) in part.undecided.iter().zip(ranges) {
            let plane = &self.hyperplanes[contact];
            let [up, down] = &plane.slopes;
            // m s <= |s| <= m s + c for s from middle - radius to middle + radius.
            let (m, c) = (middle / radius, (radius - middle.abs()) * (radius + middle.abs()) / radius);
            let mut slope = [0.0; LARGEST_RANK];
            for row in 0..LARGEST_RANK {
                let (mean, bend) = (0.5 * (up[row] + down[row]), 0.5 * (up[row] - down[row]));
                slope[row] = mean + m * bend;
                equations.constant[row] += 0.5 * bend * c;
                equations.noise[row] += 0.5 * (bend * c).abs();
            }
            add_product(&mut equations.gradient, &slope, &plane.normal);
        }
        equations
    }

    /// Whether the equations change less over a part than their uncertainty.
    fn is_lost_in_noise(&self, part: &Patch, equations: &ImageBounds) -> bool {
        (0..self.rank).all(|row| reach(&equations.gradient[row], &part.radius) <= 2.0 * self.noise[row])
    }

    /// The coordinate along which undecided contacts bend the equations most.
    fn axis_to_halve(&self, part: &Patch) -> usize {
        let mut bends = [0.0; SPACE];
        for &contact in &part.undecided {
            let plane = &self.hyperplanes[contact];
            let [up, down] = &plane.slopes;
            let bend: f64 = up.iter().zip(down).map(|(up, down)| (up - down).abs()).sum();
            for (total, normal) in bends.iter_mut().zip(&plane.normal) {
                *total += bend * normal.abs();
            }
        }
        let effect = |axis: &usize| bends[*axis] * part.radius[*axis];
        let widest = part.widest();
        let free = (0..=self.rank).filter(|&axis| part.radius[axis] > 0.01 * widest);
        free.max_by(|one, other| effect(one).total_cmp(&effect(other))).unwrap_or(0)
    }

    /// Tests every pattern that can occur in a part.
    fn file(&mut self, part: &Patch) {
        let sides_at_centre = self.hyperplanes.iter().enumerate().map(|(contact, plane)| {
            u8::from(self.problem.side(contact, inner(&plane.normal, &part.centre) > 0.0) == 1)
        });
        let at_centre: Vec<u8> = sides_at_centre.collect();
        for choice in 0..1_usize << part.undecided.len() {
            let mut sides = at_centre.clone();
            for (bit, &contact) in part.undecided.iter().enumerate() {
                sides[contact] = u8::from(choice >> bit & 1 == 1);
            }
            if self.tested.insert(sides.clone()) && self.may_be_solved(&sides) {
                self.covered.candidates.insert(sides);
            }
        }
    }

    /// `false` if the equations of a pattern certainly have no solution on the right side of every
    /// hyperplane.
    fn may_be_solved(&self, sides: &[u8]) -> bool {
        let mut gradient = unit_equations(self.rank);
        let signs: Vec<usize> = sides
            .iter()
            .enumerate()
            .map(|(contact, &side)| usize::from(self.problem.side(contact, true) != usize::from(side)))
            .collect();
        for (plane, &sign) in self.hyperplanes.iter().zip(&signs) {
            add_product(&mut gradient, &plane.slopes[sign], &plane.normal);
        }
        let Some((z, deviation)) = self.enclosed_coordinates(&gradient) else { return true };
        let size = z.iter().zip(&deviation).fold(1.0, |most: f64, (z, d)| most.max(z.abs() + d));
        self.hyperplanes.iter().zip(&signs).all(|(plane, &sign)| {
            let s = inner(&plane.normal, &z);
            let unknown = reach(&plane.normal, &deviation) + plane.error * size;
            let value = if sign == 0 { s } else { -s };
            value >= -unknown
        })
    }

    /// `(1, z)` of a pattern and its maximum error; `None` if that cannot be bounded.
    fn enclosed_coordinates(&self, gradient: &[Point; LARGEST_RANK]) -> Option<(Point, Point)> {
        let mut matrix = [[0.0; LARGEST_RANK]; LARGEST_RANK];
        for row in 0..LARGEST_RANK {
            matrix[row].copy_from_slice(&gradient[row][1..]);
        }
        let inverse = Inverse::new(&matrix, self.rank)?;
        let constant = gradient.map(|row| row[0]);
        let (middle, spread) = (inverse.times(&constant), inverse.size_times(&self.noise));
        let rounded = inverse.size_times(&constant.map(|value| value.abs() * ROUNDING));
        // |z - middle| <= spread max(1, |z|) + defect |z| + rounded
        let most = |vector: &Vector| vector.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let defect = inverse.defect_times(&[1.0; LARGEST_RANK]);
        let (gain, start) = (most(&spread) + most(&defect), most(&middle) + most(&rounded));
        if !(gain < 0.5 && start.is_finite()) {
            return None;
        }
        let size = (2.0 * (start + most(&spread))).max(1.0);
        let (mut z, mut deviation) = ([0.0; SPACE], [0.0; SPACE]);
        z[0] = 1.0;
        for row in 0..self.rank {
            z[row + 1] = -middle[row];
            deviation[row + 1] = ((spread[row] + defect[row]) * size + rounded[row]) * (1.0 + 1e-9);
        }
        Some((z, deviation))
    }
}

impl Hyperplane {
    fn new(problem: &LowRank, contact: usize) -> Self {
        let mut normal = [0.0; SPACE];
        normal[0] = problem.load[contact];
        for at in 0..problem.rank() {
            normal[at + 1] = -problem.left[(contact, at)];
        }
        let slopes = [true, false].map(|positive| {
            let side = problem.side(contact, positive);
            let mut slope = [0.0; LARGEST_RANK];
            for (row, value) in slope.iter_mut().enumerate().take(problem.rank()) {
                *value = problem.right[side][(row, contact)] / problem.diagonal[side][contact];
            }
            slope
        });
        let size: f64 = normal.iter().map(|value| value.abs()).sum();
        let error = problem.error[contact] * (1.0 + ROUNDING) + ROUNDING * size + f64::MIN_POSITIVE;
        Self { normal, error, slopes }
    }

    /// Midpoint and radius of the values of `s - e` on a part.
    fn range(&self, centre: &Point, radius: &Point) -> (f64, f64) {
        (inner(&self.normal, centre), reach(&self.normal, radius) + self.error)
    }
}

impl Patch {
    fn widest(&self) -> f64 {
        self.radius.iter().fold(0.0, |most: f64, &radius| most.max(radius))
    }

    /// Two parts that cover this one.
    fn halves(self, axis: usize) -> [Self; 2] {
        let mut halves = [self.clone(), self];
        for (half, direction) in halves.iter_mut().zip([-0.5, 0.5]) {
            half.centre[axis] += direction * half.radius[axis];
            half.radius[axis] = 0.5 * half.radius[axis] + ROUNDING * f64::EPSILON.max(half.radius[axis]);
            half.radius[axis] += f64::EPSILON;
            half.share *= 0.5;
        }
        halves
    }
}

impl ImageBounds {
    /// Whether some equation has no solution on a part.
    fn excludes(&self, part: &Patch, rank: usize) -> bool {
        (0..rank).any(|row| {
            let value = inner(&self.gradient[row], &part.centre) + self.constant[row];
            value.abs() > (self.noise[row] + reach(&self.gradient[row], &part.radius)) * (1.0 + ROUNDING)
        })
    }

    /// Cuts off what a Krawczyk step excludes; `false` if nothing is left.
    ///
    /// From `A d = theta - f`, `d = x - centre` in the free coordinates, `f = G centre + h`,
    /// `|theta| <= noise`, and an approximate inverse `R` of `A`:
    /// `d = -R f + R theta + (I - R A) d`.
    fn narrow(&self, part: &mut Patch, rank: usize) -> bool {
        let mut free = [0; LARGEST_RANK];
        for (axis, at) in (0..=rank).filter(|&axis| axis != part.pinned).zip(&mut free) {
            *at = axis;
        }
        let (mut matrix, mut value) = ([[0.0; LARGEST_RANK]; LARGEST_RANK], [0.0; LARGEST_RANK]);
        let mut radius = [0.0; LARGEST_RANK];
        for row in 0..rank {
            for column in 0..rank {
                matrix[row][column] = self.gradient[row][free[column]];
            }
            value[row] = inner(&self.gradient[row], &part.centre) + self.constant[row];
            radius[row] = part.radius[free[row]];
        }
        let Some(inverse) = Inverse::new(&matrix, rank) else { return true };
        let step = inverse.times(&value);
        let unknown: Vector = std::array::from_fn(|row| self.noise[row] + value[row].abs() * ROUNDING);
        let (unknown, defect) = (inverse.size_times(&unknown), inverse.defect_times(&radius));
        for row in 0..rank {
            let off = (unknown[row] + defect[row]) * (1.0 + ROUNDING) + 4.0 * f64::EPSILON;
            if !off.is_finite() || !step[row].is_finite() {
                continue;
            }
            let (low, high) = ((-step[row] - off).max(-radius[row]), (-step[row] + off).min(radius[row]));
            if low > high {
                return false;
            }
            part.centre[free[row]] += f64::midpoint(low, high);
            part.radius[free[row]] = 0.5 * (high - low) * (1.0 + ROUNDING) + 2.0 * f64::EPSILON;
        }
        true
    }
}

/// The faces of the cube with `t >= 0`.
fn faces(rank: usize, contacts: usize) -> Vec<Patch> {
    let undecided: Vec<usize> = (0..contacts).collect();
    let share = 1.0 / (2 * rank + 1) as f64;
    let face = |pinned: usize, value: f64| {
        let (mut centre, mut radius) = ([0.0; SPACE], [0.0; SPACE]);
        radius[1..=rank].fill(1.0);
        (centre[0], radius[0]) = (0.5, 0.5);
        (centre[pinned], radius[pinned]) = (value, 0.0);
        let decided = unit_equations(rank);
        Patch { centre, radius, pinned, undecided: undecided.clone(), decided, share }
    };
    let mut faces = vec![face(0, 1.0)];
    faces.extend((1..=rank).flat_map(|axis| [face(axis, 1.0), face(axis, -1.0)]));
    faces
}

/// The part `-t z` of the equations.
fn unit_equations(rank: usize) -> [Point; LARGEST_RANK] {
    let mut equations = [[0.0; SPACE]; LARGEST_RANK];
    for (row, equation) in equations.iter_mut().enumerate().take(rank) {
        equation[row + 1] = -1.0;
    }
    equations
}

fn inner(normal: &Point, point: &Point) -> f64 {
    normal.iter().zip(point).map(|(a, x)| a * x).sum()
}

/// `|normal| . radius`.
fn reach(normal: &Point, radius: &Point) -> f64 {
    normal.iter().zip(radius).map(|(a, x)| a.abs() * x).sum()
}

fn add_product(equations: &mut [Point; LARGEST_RANK], slope: &Vector, normal: &Point) {
    for (equation, slope) in equations.iter_mut().zip(slope) {
        for (entry, normal) in equation.iter_mut().zip(normal) {
            *entry += slope * normal;
        }
    }
}

#[cfg(test)]
mod tests;
