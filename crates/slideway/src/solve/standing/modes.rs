//! The forces of each mode, affine in the friction that is free, and where it satisfies all inequalities.

use super::super::mode_problem::overflow;
use super::super::parts::couples;
use super::super::stages::Stages;
use super::circle::within_circle;
use super::free::Free;
use super::polyhedron::{Extremes, Polyhedron};
use crate::fault::Faults;
use crate::kinetics::ConstraintRow;
use crate::law::COUPLE_TOLERANCE;
use crate::modes::existence::OutputBound;
use crate::modes::{BlockNumbers, Side};
use crate::problem::{NO_INFLUENCE, TurningHinge};
use nalgebra::{DMatrix, DVector};

/// Modes whose determinant is below this are singular within rounding.
const SINGULAR: f64 = 1e-12;

/// The equations of all modes. Their unknowns are the normal forces, then the force of a hinge that stands; below them
/// stand the couples of guided sliders, which follow from these.
pub(super) struct Modes<'a> {
    stages: &'a Stages,
    free: &'a [Free],
    numbers: BlockNumbers,
    /// Places of the rows among all unknowns.
    places: Vec<usize>,
    bounds: Vec<OutputBound>,
}

/// One mode.
pub(super) struct Mode {
    pub(super) sides: Vec<Side>,
    /// The rows without free forces, then what a unit of each adds.
    rows: Vec<DVector<f64>>,
    /// Where all inequalities hold, with and without those of tipping, for free forces in these units.
    upright: Polyhedron,
    all: Polyhedron,
    units: DVector<f64>,
    unknowns: usize,
}

impl<'a> Modes<'a> {
    /// # Errors
    /// Numbers beyond the range of floating point.
    pub(super) fn new(stages: &'a Stages, free: &'a [Free]) -> Result<Self, Faults> {
        let hinges: Vec<TurningHinge> = free
            .iter()
            .filter_map(|free| if let Free::Hinge(hinge) = free { Some(*hinge) } else { None })
            .collect();
        let circles: Vec<_> =
            hinges.iter().map(|hinge| &stages.mechanism.friction_circles[hinge.circle]).collect();
        let (bounds, below): (Vec<OutputBound>, Vec<usize>) =
            couples(&stages.mechanism, &stages.influence).into_iter().unzip();
        let outputs: Vec<ConstraintRow> = below.iter().copied().map(ConstraintRow::unknown).collect();
        let numbers = stages.data().coefficients(&hinges, &outputs)?.numbers();
        let mut places = stages.influence.block_rows(&circles);
        places.extend(below);
        let is_finite = numbers.are_finite();
        is_finite.then_some(Self { stages, free, numbers, places, bounds }).ok_or_else(overflow)
    }

    /// A mode; none if it is singular.
    ///
    /// # Errors
    /// Numbers beyond the range of floating point.
    pub(super) fn mode(&self, sides: Vec<Side>) -> Result<Option<Mode>, Faults> {
        let unknowns = self.places.len() - self.bounds.len();
        let response = |row: usize, k: usize| {
            if k < sides.len() {
                self.numbers.response.get(sides[k])[(row, k)] * sides[k].sign()
            } else {
                0.0
            }
        };
        let matrix = DMatrix::from_fn(unknowns, unknowns, |row, k| {
            if row == k { 1.0 - response(row, k) } else { -response(row, k) }
        });
        if matrix.determinant().abs() <= SINGULAR {
            return Ok(None);
        }
        let factors = matrix.lu();
        let jumps = (0..sides.len()).map(|k| self.numbers.jumps.get(sides[k]).column(k).into_owned());
        let load = jumps.fold(self.numbers.load.clone(), |load, jump| load + jump);
        let added = |free: &Free| {
            let unit = free.unit(&self.stages.influence, &sides);
            DVector::from_iterator(self.places.len(), self.places.iter().map(|&place| unit[place]))
        };
        let solved = |mut row: DVector<f64>| {
            let solution = factors.solve(&row.rows(0, unknowns).into_owned())?;
            for below in unknowns..row.len() {
                row[below] += (0..unknowns).map(|k| response(below, k) * solution[k]).sum::<f64>();
            }
            row.rows_mut(0, unknowns).copy_from(&solution);
            row.iter().all(|entry| entry.is_finite()).then_some(row)
        };
        let rows: Option<Vec<_>> =
            std::iter::once(load).chain(self.free.iter().map(added)).map(solved).collect();
        rows.map(|rows| Some(self.with_inequalities(sides, rows))).ok_or_else(overflow)
    }

    /// The inequalities of a mode: the sides of all contacts, the limits of friction, `|C| <= |N| L / 2`.
    fn with_inequalities(&self, sides: Vec<Side>, mut rows: Vec<DVector<f64>>) -> Mode {
        let unknowns = self.places.len() - self.bounds.len();
        let mechanism = &self.stages.mechanism;
        let greatest = rows[0].rows(0, unknowns).amax();
        let force = if greatest > 0.0 { greatest } else { 1.0 };
        let couple = force * mechanism.size;
        let of_free = |free: &Free| if let Free::Hinge(_) = free { couple } else { force };
        let units =
            DVector::from_iterator(rows.len(), std::iter::once(1.0).chain(self.free.iter().map(of_free)));
        let of_row = |row: usize| if row < unknowns { force } else { couple };
        for (part, unit) in rows.iter_mut().zip(&units) {
            for row in 0..part.len() {
                if (part[row] * unit).abs() <= NO_INFLUENCE * of_row(row) {
                    part[row] = 0.0;
                }
            }
        }
        let row =
            |row: usize| DVector::from_fn(rows.len(), |part, _| rows[part][row] * units[part] / of_row(row));
        let own = |part: usize, value: f64| {
            DVector::from_fn(rows.len(), |other, _| if other == part { value } else { 0.0 })
        };
        let pressure = |k: usize| row(k) * sides[k].sign();
        let mut inequalities: Vec<DVector<f64>> = (0..sides.len()).map(pressure).collect();
        for (index, free) in self.free.iter().enumerate() {
            let Some((k, [mu, preload])) = free.limit(mechanism, &sides) else { continue };
            let limit = pressure(k) * mu + own(0, preload / force);
            inequalities.extend([1.0, -1.0].map(|sense| &limit - own(index + 1, sense)));
        }
        let all = Polyhedron::new(self.free.len(), inequalities.iter().cloned());
        for bound in &self.bounds {
            let arm = bound.factor / mechanism.size;
            let limit = pressure(bound.contact) * arm + own(0, 2.0 * arm * COUPLE_TOLERANCE);
            let couple = row(unknowns + bound.output);
            inequalities.extend([1.0, -1.0].map(|sense| &limit - &couple * sense));
        }
        let upright = Polyhedron::new(self.free.len(), inequalities.into_iter());
        Mode { sides, rows, upright, all, units, unknowns }
    }
}

impl Mode {
    /// The parts in which the free forces satisfy all inequalities, or all but those of tipping.
    pub(super) fn parts(&self, free: &[Free], stages: &Stages, are_upright: bool) -> Vec<Extremes> {
        let polyhedron = if are_upright { &self.upright } else { &self.all };
        let mut extremes = polyhedron.extremes();
        let units = self.units.rows(1, free.len()).into_owned();
        extremes.corners.iter_mut().for_each(|corner| corner.component_mul_assign(&units));
        match free {
            [Free::Hinge(hinge)] => {
                let radius = stages.mechanism.friction_circles[hinge.circle].static_radius;
                let force = |part: &DVector<f64>| [0, 1].map(|axis| part[self.sides.len() + axis] * radius);
                let within = within_circle(force(&self.rows[0]), force(&self.rows[1]));
                within.into_iter().filter_map(|range| cut(&extremes, range)).collect()
            }
            _ if extremes.corners.is_empty() => Vec::new(),
            _ => vec![extremes],
        }
    }

    /// Normal forces, and the force of a hinge that stands, with these free forces.
    pub(super) fn forces(&self, free: &DVector<f64>) -> DVector<f64> {
        let at = free
            .iter()
            .zip(&self.rows[1..])
            .fold(self.rows[0].clone(), |sum, (force, row)| sum + row * *force);
        at.rows(0, self.unknowns).into_owned()
    }

    /// Whether all mixtures of these corners and growths are in this mode, too, within rounding.
    pub(super) fn contains(&self, part: &Extremes) -> bool {
        let scaled = |first: f64, free: &DVector<f64>| {
            DVector::from_fn(self.units.len(), |index, _| match index.checked_sub(1) {
                None => first,
                Some(index) => free[index] / self.units[index + 1],
            })
        };
        part.corners.iter().all(|corner| self.upright.contains(&scaled(1.0, corner)))
            && part.growths.iter().all(|growth| self.upright.contains(&scaled(0.0, growth)))
    }
}

/// The part of an interval that is within a range, if there is one; without corners it has no end on either side.
fn cut(interval: &Extremes, range: [f64; 2]) -> Option<Extremes> {
    let corners = || interval.corners.iter().map(|corner| corner[0]);
    let is_endless = |sense: f64| interval.growths.iter().any(|growth| growth[0] * sense > 0.0);
    if interval.corners.is_empty() && !(is_endless(1.0) && is_endless(-1.0)) {
        return None;
    }
    let from = if is_endless(-1.0) { f64::NEG_INFINITY } else { corners().fold(f64::INFINITY, f64::min) };
    let to = if is_endless(1.0) { f64::INFINITY } else { corners().fold(f64::NEG_INFINITY, f64::max) };
    let (from, to) = (from.max(range[0]), to.min(range[1]));
    let point = |value: f64| DVector::from_element(1, value);
    (from <= to).then(|| {
        let (corners, ends): (Vec<f64>, Vec<f64>) = [from, to].into_iter().partition(|end| end.is_finite());
        Extremes {
            corners: corners.into_iter().map(point).collect(),
            growths: ends.into_iter().map(|end| point(end.signum())).collect(),
        }
    })
}
