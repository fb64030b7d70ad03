//! A region of points within linear inequalities, and the linear programs that ask for its extent.

use super::friction_circle::{Pin, Pinned};
use super::simplex::{Optimum, least};
use super::{Affine, Extent, Unsolved};
use crate::progress::Work;
use nalgebra::Vector3;

/// Greater slacks are not sought: the reactions of a wedged block may grow without bound.
const GREATEST: f64 = 1.0;
/// Determinants below this are zero; the functions have coefficients of order one.
const SINGULAR: f64 = 1e-12;
/// More functions of two unknowns are left to the simplex method.
const MOST_OF_TWO: usize = 20;
/// A finite extent beyond this is one that rounding has cut off: the region is unbounded.
const UNBOUNDED: f64 = 1e9;
/// A direction counts as one of recession if it misses no constraint by more than this.
const RECESSION: f64 = 1e-10;
/// Optima below this are rounding errors of terms of order one.
pub(crate) const NOTHING: f64 = 1e-12;

/// The points at which every one of some functions, the slacks, is at least zero, and the couples of pins are within
/// their friction circles.
#[derive(Clone)]
pub(crate) struct Region<'w> {
    dimension: usize,
    slacks: Vec<Affine>,
    pins: Vec<Pin>,
    /// What may end a search over the sectors of pins.
    pub(super) work: Work<'w>,
}

/// Where a function of a region is least or greatest.
#[derive(Debug, Clone)]
pub(super) struct End {
    /// The least or greatest value; nothing where there is none.
    pub(super) value: Option<f64>,
    /// The point where the function has it, or the direction in which it grows without bound.
    pub(super) at: Vec<f64>,
    /// Whether it is a direction.
    pub(super) is_ray: bool,
}

impl End {
    /// Another function there, or how it changes in the direction.
    pub(super) fn value_of(&self, function: &Affine) -> f64 {
        function.at(&self.at) - if self.is_ray { function.constant } else { 0.0 }
    }

    fn negated(self) -> Self {
        Self { value: self.value.map(|value| -value), ..self }
    }
}

impl Region<'static> {
    /// The points of so many coordinates at which every function is at least zero.
    pub(crate) fn new(dimension: usize, slacks: Vec<Affine>) -> Self {
        Self { dimension, slacks, pins: Vec::new(), work: Work::undisturbed() }
    }
}

impl Region<'_> {
    /// The region with work that may end its searches, which are unsolved then.
    pub(crate) fn watched(self, work: Work<'_>) -> Region<'_> {
        let Self { dimension, slacks, pins, .. } = self;
        Region { dimension, slacks, pins, work }
    }

    /// The work that may end its searches.
    pub(crate) fn work(&self) -> Work<'_> {
        self.work
    }

    /// The region in which the couples of these pins, too, are within their friction circles.
    pub(crate) fn with_pins(self, pins: Vec<Pin>) -> Self {
        Self { pins, ..self }
    }

    /// The region without its turning pins, in parts that hold their couples; itself if there are none.
    ///
    /// # Errors
    /// If a linear program was not solved.
    pub(crate) fn parts(self) -> Result<Vec<Self>, Unsolved> {
        let (turning, sticking): (Vec<Pin>, Vec<Pin>) =
            self.pins.iter().cloned().partition(|pin| pin.turning.is_some());
        if turning.is_empty() {
            return Ok(vec![self]);
        }
        let parts = Pinned { convex: &self, pins: &turning }.parts()?;
        Ok(parts.into_iter().map(|part| part.with_pins(sticking.clone())).collect())
    }

    /// The part in which further slacks are at least zero, without pins.
    pub(super) fn within(&self, further: impl Iterator<Item = Affine>) -> Self {
        let slacks = self.slacks.iter().cloned().chain(further).collect();
        Self { dimension: self.dimension, slacks, pins: Vec::new(), work: self.work }
    }

    /// The point at which the least slack is greatest, but no more than 1, and that slack; negative if the
    /// region is empty. With pins it is some point of the region, unless it is empty.
    ///
    /// # Errors
    /// If the linear program, which has a solution, was not solved.
    pub(crate) fn highest(&self) -> Result<(f64, Vec<f64>), Unsolved> {
        self.highest_from(f64::NEG_INFINITY)
    }

    /// The same; of a greatest least slack below this number only that it is below.
    ///
    /// # Errors
    /// As [`Region::highest`].
    pub(crate) fn highest_from(&self, least: f64) -> Result<(f64, Vec<f64>), Unsolved> {
        if !self.pins.is_empty() {
            return Pinned { convex: self, pins: &self.pins }.highest_from(least);
        }
        let found = match self.dimension {
            0 => Some(Vec::new()),
            1 => of_one(&self.slacks).map(|z| vec![z]),
            2 if self.slacks.len() <= MOST_OF_TWO => of_two(&self.slacks).map(|z| z.to_vec()),
            _ => None,
        };
        let point = found.map_or_else(|| self.highest_by_simplex(), Ok)?;
        let slacks = self.slacks.iter().map(|slack| slack.at(&point));
        Ok((slacks.fold(GREATEST, f64::min), point))
    }

    /// The greatest term of any slack at a point, or 1: rounding is a part of that.
    pub(crate) fn greatest_term(&self, point: &[f64]) -> f64 {
        let pins = self.pins.iter().flat_map(|pin| pin.reaction.iter().chain([&pin.couple]));
        self.slacks.iter().chain(pins).map(|function| function.greatest_term(point)).fold(1.0, f64::max)
    }

    /// The greatest `t` that no slack is below, from where all unknowns are zero.
    fn highest_by_simplex(&self) -> Result<Vec<f64>, Unsolved> {
        let lowest = self.slacks.iter().map(|slack| slack.constant).fold(GREATEST, f64::min);
        let cap = Affine { coefficients: vec![0.0; self.dimension], constant: GREATEST };
        let rows: Vec<Affine> = self.slacks.iter().chain([&cap]).map(|slack| with(slack, -1.0)).collect();
        let cost = last(self.dimension, -1.0);
        match least(&cost, &rows, &last(self.dimension, lowest))? {
            Optimum::At(mut point) => {
                point.truncate(self.dimension);
                Ok(point)
            }
            Optimum::Unbounded => Err(Unsolved),
        }
    }

    /// The region, relaxed by as little as its points ask for. Returns `None` if they miss a slack by more than `tolerance`.
    ///
    /// # Errors
    /// As [`Region::highest`].
    pub(crate) fn possible(self, tolerance: f64) -> Result<Option<Self>, Unsolved> {
        let (slack, _) = self.highest()?;
        Ok((slack >= -tolerance).then(|| self.relaxed(-slack.min(0.0))))
    }

    /// The region with every slack greater by the same amount.
    pub(crate) fn relaxed(mut self, amount: f64) -> Self {
        for slack in &mut self.slacks {
            slack.constant += amount;
        }
        for pin in &mut self.pins {
            pin.allowance += amount;
        }
        self
    }

    /// The values of a function in the region, which must not be empty: intervals in ascending order, of which there is
    /// one unless friction circles divide the region.
    ///
    /// # Errors
    /// As [`Region::extent`].
    pub(crate) fn extents(&self, function: &Affine) -> Result<Vec<Extent>, Unsolved> {
        if self.pins.is_empty() {
            return Ok(vec![self.convex_extent(function)?]);
        }
        Pinned { convex: self, pins: &self.pins }.extents(function)
    }

    /// Least and greatest value of a function in the region, which must not be empty; nothing where it is
    /// unbounded.
    ///
    /// It is unbounded where the cone of recession reaches in the direction of the function, which is judged
    /// with [`RECESSION`], so that a cone which rounding has closed counts as open.
    ///
    /// # Errors
    /// If a linear program was not solved.
    pub(crate) fn extent(&self, function: &Affine) -> Result<Extent, Unsolved> {
        if self.pins.is_empty() {
            return self.convex_extent(function);
        }
        Pinned { convex: self, pins: &self.pins }.extent(function)?.ok_or(Unsolved)
    }

    /// The extent without regard to pins.
    pub(super) fn convex_extent(&self, function: &Affine) -> Result<Extent, Unsolved> {
        Ok(self.ends(function)?.map(|end| end.value))
    }

    /// Where a function is least and greatest, without regard to pins.
    pub(super) fn ends(&self, function: &Affine) -> Result<[End; 2], Unsolved> {
        Ok([self.least(function, 1.0)?, self.least(function, -1.0)?.negated()])
    }

    /// Where `sign` times a function is least.
    fn least(&self, function: &Affine, sign: f64) -> Result<End, Unsolved> {
        if !function.varies() {
            let (_, at) = self.highest()?;
            return Ok(End { value: Some(sign * function.constant), at, is_ray: false });
        }
        if let Some(at) = self.recession(function, sign)? {
            return Ok(End { value: None, at, is_ray: true });
        }
        let cost: Vec<f64> = function.coefficients.iter().map(|coefficient| sign * coefficient).collect();
        let rows: Vec<Affine> = self.slacks.iter().filter(|slack| slack.varies()).cloned().collect();
        let (_, inside) = self.highest()?;
        let Optimum::At(at) = least(&cost, &rows, &inside)? else {
            return Ok(End { value: None, at: inside, is_ray: false });
        };
        let least = sign * function.at(&at);
        let without_noise = if least.abs() <= NOTHING { 0.0 } else { least };
        Ok(End { value: Some(without_noise).filter(|least| least.abs() < UNBOUNDED), at, is_ray: false })
    }

    /// The direction in which every constraint stays satisfied and `sign` times the function falls, if there is one:
    /// the least `t` with `coefficients . d >= -t` for all slacks and `sign function . d <= -1` is not positive.
    fn recession(&self, function: &Affine, sign: f64) -> Result<Option<Vec<f64>>, Unsolved> {
        let homogeneous = |slack: &Affine| Affine { coefficients: slack.coefficients.clone(), constant: 0.0 };
        let falls = Affine {
            coefficients: function.coefficients.iter().map(|coefficient| -sign * coefficient).collect(),
            constant: -1.0,
        };
        let slope: f64 = function.coefficients.iter().map(|coefficient| coefficient * coefficient).sum();
        let mut start: Vec<f64> = falls.coefficients.iter().map(|coefficient| coefficient / slope).collect();
        let cone: Vec<Affine> = self.slacks.iter().filter(|slack| slack.varies()).map(homogeneous).collect();
        let missed = cone.iter().map(|slack| -slack.at(&start)).fold(-1.0, f64::max);
        let mut rows: Vec<Affine> = cone.iter().map(|slack| with(slack, 1.0)).collect();
        rows.push(with(&falls, 0.0));
        rows.push(Affine { coefficients: last(self.dimension, 1.0), constant: 1.0 });
        start.push(missed);
        match least(&last(self.dimension, 1.0), &rows, &start)? {
            Optimum::At(mut point) => {
                let missed = point.pop();
                Ok((missed <= Some(RECESSION)).then_some(point))
            }
            Optimum::Unbounded => Err(Unsolved),
        }
    }
}

/// A function with one more unknown.
fn with(function: &Affine, coefficient: f64) -> Affine {
    let coefficients = function.coefficients.iter().copied().chain([coefficient]).collect();
    Affine { coefficients, constant: function.constant }
}

/// Zeros, and a value for the unknown that comes last.
fn last(dimension: usize, value: f64) -> Vec<f64> {
    let mut values = vec![0.0; dimension + 1];
    values[dimension] = value;
    values
}

/// One unknown: the optimum is where a rising and a falling function meet, or a rising one reaches the
/// greatest value.
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

/// Two unknowns: the best of the points where three functions are equal.
fn of_two(functions: &[Affine]) -> Option<[f64; 2]> {
    let plane = |f: &Affine| Vector3::new(f.coefficients[0], f.coefficients[1], f.constant);
    let cap = std::iter::once(Vector3::new(0.0, 0.0, GREATEST));
    let planes: Vec<Vector3<f64>> = functions.iter().map(plane).chain(cap).collect();
    let mut best: Option<(f64, [f64; 2])> = None;
    for first in 0..planes.len() {
        for second in first + 1..planes.len() {
            for third in second + 1..planes.len() {
                let rows = [first, second, third].map(|index| planes[index]);
                let Some([height, x, y]) = meeting(&rows) else { continue };
                if best.is_some_and(|(other, _)| height <= other) {
                    continue;
                }
                let least = planes.iter().map(|p| p.x * x + p.y * y + p.z).fold(f64::INFINITY, f64::min);
                if best.is_none_or(|(other, _)| least > other) {
                    best = Some((least, [x, y]));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn affine(coefficients: &[f64], constant: f64) -> Affine {
        Affine { coefficients: coefficients.to_vec(), constant }
    }

    /// z_i >= t and 1/2 - sum z_i >= t of n unknowns: t = 1/(2 (n + 1)), all slacks being equal.
    #[test]
    fn the_highest_point_is_the_same_with_and_without_the_simplex_method() {
        for dimension in 1..5_usize {
            let one = |index: usize| {
                let mut coefficients = vec![0.0; dimension];
                coefficients[index] = 1.0;
                Affine { coefficients, constant: 0.0 }
            };
            let sum = affine(&vec![-1.0; dimension], 0.5);
            let region = Region::new(dimension, (0..dimension).map(one).chain([sum]).collect());
            let expected = 0.5 / (dimension as f64 + 1.0);
            let (slack, point) = region.highest().expect("it has a solution");
            assert!((slack - expected).abs() < 1e-13, "{dimension} {slack}");
            assert!(point.iter().all(|z| (z - expected).abs() < 1e-12), "{point:?}");
        }
    }

    #[test]
    fn slacks_that_depend_on_a_sum_alone_have_a_highest_point() {
        // z_1 + z_2 >= t, 1/2 - (z_1 + z_2) >= t: t = 1/4.
        let slacks = vec![affine(&[1.0, 1.0], 0.0), affine(&[-1.0, -1.0], 0.5)];
        let (slack, _) = Region::new(2, slacks).highest().expect("it has a solution");
        assert!((slack - 0.25).abs() < 1e-13, "{slack}");
        // Without bound it is cut off at 1, without unknowns the least constant.
        let (slack, _) = Region::new(1, vec![affine(&[2.0], 0.0)]).highest().expect("it has a solution");
        assert_eq!(slack, 1.0);
        let (slack, _) = Region::new(0, vec![affine(&[], -0.5)]).highest().expect("it has a solution");
        assert_eq!(slack, -0.5);
    }

    #[test]
    fn an_extent_ends_where_a_slack_does_or_not_at_all() {
        let slacks = vec![affine(&[1.0, 0.0], 0.0), affine(&[-1.0, 0.0], 1.0), affine(&[0.0, 1.0], 0.0)];
        let region = Region::new(2, slacks);
        assert_eq!(region.extent(&affine(&[1.0, 0.0], 2.0)), Ok([Some(2.0), Some(3.0)]));
        assert_eq!(region.extent(&affine(&[0.0, 1.0], 0.0)), Ok([Some(0.0), None]));
    }
}
