//! The unknowns without friction and per unit of friction in one elimination, for states that follow one
//! another.
//!
//! [`super::KineticEquations`] factors once and solves as often as is asked for. Here all right-hand sides
//! are known beforehand, so that elimination takes them along, row by row in one block of memory. The scales
//! are those of an earlier state.

use super::system::{equilibration, without_noise};
use super::{Assembled, ConstraintRow, Layout, Opening, Reaction};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::mechanism::Mechanism;
use nalgebra::{DMatrix, DVector};

/// Pivots below this multiple of the greatest need the factorization with full pivoting.
const WELL_CONDITIONED: f64 = 1e-8;
/// Rounding of a state's numbers, as a part of the condition of its equations.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// How well normal forces are known: rounding leaves something of what should cancel out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Accuracy {
    /// As a part of themselves.
    pub(crate) part: f64,
    /// Or of this load (N), if that is greater.
    pub(crate) of_load: f64,
}

/// How the unknowns answer to friction.
#[derive(Debug, Clone)]
pub(crate) struct Influences {
    pub(crate) layout: Layout,
    /// All unknowns without friction.
    pub(crate) frictionless: DVector<f64>,
    /// For each contact: what a unit friction force adds, for both faces.
    pub(crate) columns: Vec<[DVector<f64>; 2]>,
    /// Contribution of a unit friction couple of each friction circle to all unknowns.
    pub(crate) couples: Vec<DVector<f64>>,
    /// Contribution of a unit normal force of each cut contact to all unknowns.
    pub(crate) self_stresses: Vec<DVector<f64>>,
    /// Those of the contacts that may lift off.
    pub(crate) openings: Vec<Opening>,
    /// Ratio of the greatest to the least pivot.
    pub(crate) condition: f64,
    /// The greatest applied force (N).
    pub(crate) greatest_load: f64,
    /// The greatest unknown without friction in the scale of the equations, as a normal force (N).
    greatest_unknown: f64,
    coordinate_rows: Vec<ConstraintRow>,
}

/// Scales and memory that neighbouring states share.
#[derive(Debug, Clone, Default)]
pub(crate) struct Elimination {
    rows: DVector<f64>,
    columns: DVector<f64>,
    /// Matrix and right-hand sides, row by row; scaled, to be eliminated, and as they were.
    work: Vec<f64>,
    original: Vec<f64>,
    order: Vec<usize>,
    solution: Vec<f64>,
}

impl Influences {
    /// How well the normal forces are known: a part, and of which force (N) at least.
    pub(crate) fn accuracy(&self) -> Accuracy {
        Accuracy { part: ROUNDING * self.condition, of_load: self.greatest_load.max(self.greatest_unknown) }
    }

    /// The acceleration of a chosen coordinate, or what is `added` to it.
    pub(crate) fn coordinate(&self, index: usize, unknowns: &DVector<f64>, added: bool) -> f64 {
        self.coordinate_rows[index].acceleration(unknowns, added)
    }

    /// The influences of a mechanism in a state; none if its equations are not certainly well-conditioned:
    /// then [`super::KineticEquations`] has to tell.
    ///
    /// # Errors
    /// Loads without a value or direction.
    pub(crate) fn new(
        mechanism: &Mechanism,
        configuration: &Configuration,
        elimination: &mut Elimination,
    ) -> Result<Option<Self>, Faults> {
        let assembled = Assembled::new(mechanism, configuration)?;
        // What has no mass may be without inertia once a contact has lifted off.
        let is_massless = |body: &crate::mechanism::Body| body.mass == 0.0;
        if !assembled.layout.one_sided.is_empty() && mechanism.bodies.iter().any(is_massless) {
            return Ok(None);
        }
        let Some((condition, places)) = elimination.solve(&assembled) else { return Ok(None) };
        let size = assembled.layout.len();
        let width = elimination.solution.len() / size.max(1);
        let solution =
            |place: usize| DVector::from_fn(size, |row, _| elimination.solution[row * width + place]);
        let answer = |place: usize| without_noise(&solution(place), &elimination.columns);
        let columns = places.iter().map(|places| places.map(solution)).collect();
        let openings = width - assembled.layout.one_sided.len();
        let cut = openings - assembled.layout.cut.len();
        let self_stresses = (cut..openings).map(answer).collect();
        let openings = assembled.layout.openings((openings..width).map(answer).collect());
        if openings.iter().any(|opening| !opening.acceleration.is_finite()) {
            return Ok(None);
        }
        let couples = (cut - assembled.couples.len()..cut).map(solution).collect();
        let frictionless = if width == 0 { DVector::zeros(0) } else { answer(0) };
        Ok(Some(Self {
            greatest_unknown: as_normal_force(&assembled.layout, &frictionless, &elimination.columns),
            frictionless,
            columns,
            couples,
            self_stresses,
            openings,
            condition,
            greatest_load: assembled.applied.iter().map(|load| load.force.norm()).fold(0.0, f64::max),
            layout: assembled.layout,
            coordinate_rows: assembled.coordinate_rows,
        }))
    }
}

impl Elimination {
    /// Solves for the load and all unit frictions: gives the condition, and the place of both solutions of
    /// each contact.
    fn solve(&mut self, assembled: &Assembled<f64>) -> Option<(f64, Vec<[usize; 2]>)> {
        let size = assembled.layout.len();
        let mut sides: Vec<&DVector<f64>> = vec![&assembled.load];
        let mut places = Vec::with_capacity(assembled.friction.len());
        for [positive, negative] in &assembled.friction {
            let first = sides.len();
            sides.push(positive);
            if positive != negative {
                sides.push(negative);
            }
            places.push([first, sides.len() - 1]);
        }
        sides.extend(&assembled.couples);
        let units: Vec<DVector<f64>> = assembled.layout.cut_units();
        sides.extend(&units);
        let openings: Vec<DVector<f64>> = assembled.layout.opening_units();
        sides.extend(&openings);
        if self.rows.len() != size {
            (self.rows, self.columns) = equilibration(&assembled.matrix);
        }
        self.fill(&assembled.matrix, &sides);
        let condition = self.eliminate(size, sides.len())?;
        self.refine(size, sides.len());
        Some((condition, places))
    }

    fn fill(&mut self, matrix: &DMatrix<f64>, sides: &[&DVector<f64>]) {
        let size = matrix.nrows();
        let width = size + sides.len();
        self.original.clear();
        self.original.resize(size * width, 0.0);
        for (column, entries) in matrix.column_iter().enumerate() {
            for (row, entry) in entries.iter().enumerate() {
                self.original[row * width + column] = self.rows[row] * entry * self.columns[column];
            }
        }
        for (place, side) in sides.iter().enumerate() {
            for (row, entry) in side.iter().enumerate() {
                self.original[row * width + size + place] = self.rows[row] * entry;
            }
        }
    }

    /// Elimination with row pivoting; multipliers are kept where zeros would be. None if a pivot is too
    /// small.
    fn eliminate(&mut self, size: usize, sides: usize) -> Option<f64> {
        let width = size + sides;
        self.work.clear();
        self.work.extend_from_slice(&self.original);
        self.order.clear();
        self.order.extend(0..size);
        let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
        for step in 0..size {
            let mut pivot_at = step;
            for row in step + 1..size {
                if self.work[row * width + step].abs() > self.work[pivot_at * width + step].abs() {
                    pivot_at = row;
                }
            }
            let pivot = self.work[pivot_at * width + step];
            least = least.min(pivot.abs());
            greatest = greatest.max(pivot.abs());
            // The least and the greatest one pass over what is not a number.
            if pivot.is_nan() || least <= WELL_CONDITIONED * greatest {
                return None;
            }
            if pivot_at != step {
                let (above, below) = self.work.split_at_mut(pivot_at * width);
                above[step * width..][..width].swap_with_slice(&mut below[..width]);
                self.order.swap(step, pivot_at);
            }
            let (above, below) = self.work.split_at_mut((step + 1) * width);
            let pivot_row = &above[step * width..][..width];
            for row in below.chunks_exact_mut(width) {
                if row[step] != 0.0 {
                    let factor = row[step] / pivot;
                    row[step] = factor;
                    for (entry, eliminated) in row[step + 1..].iter_mut().zip(&pivot_row[step + 1..]) {
                        *entry -= factor * eliminated;
                    }
                }
            }
        }
        self.solution.clear();
        self.solution.resize(size * sides, 0.0);
        for row in 0..size {
            self.solution[row * sides..][..sides].copy_from_slice(&self.work[row * width + size..][..sides]);
        }
        back_substitute(&self.work, &mut self.solution, (size, sides));
        Some(if size == 0 { 1.0 } else { greatest / least })
    }

    /// One step of iterative refinement; then back to the units of the unknowns.
    fn refine(&mut self, size: usize, sides: usize) {
        let width = size + sides;
        let mut residual = vec![0.0; size * sides];
        for (place, &row) in self.order.iter().enumerate() {
            let original = &self.original[row * width..][..width];
            let target = &mut residual[place * sides..][..sides];
            target.copy_from_slice(&original[size..]);
            for (column, entry) in original[..size].iter().enumerate().filter(|(_, entry)| **entry != 0.0) {
                let solution = &self.solution[column * sides..][..sides];
                target.iter_mut().zip(solution).for_each(|(sum, solution)| *sum -= entry * solution);
            }
        }
        // The multipliers of the elimination, in its order.
        for row in 0..size {
            let (above, below) = residual.split_at_mut(row * sides);
            let target = &mut below[..sides];
            for (step, known) in above.chunks_exact(sides).enumerate() {
                let factor = self.work[row * width + step];
                if factor != 0.0 {
                    target.iter_mut().zip(known).for_each(|(sum, known)| *sum -= factor * known);
                }
            }
        }
        back_substitute(&self.work, &mut residual, (size, sides));
        for (row, scale) in self.columns.iter().enumerate() {
            let solution = &mut self.solution[row * sides..][..sides];
            let correction = &residual[row * sides..][..sides];
            solution.iter_mut().zip(correction).for_each(|(value, more)| *value = (*value + more) * scale);
        }
    }
}

/// The greatest unknown where all have the scale of their columns, in that of the normal forces.
fn as_normal_force(layout: &Layout, unknowns: &DVector<f64>, columns: &DVector<f64>) -> f64 {
    let normals = (0..).map_while(|contact| layout.reaction(Reaction::Normal(ContactId(contact))));
    let scale = normals.map(|place| columns[place]).fold(0.0, f64::max);
    unknowns.iter().zip(columns).map(|(unknown, column)| (unknown / column).abs()).fold(0.0, f64::max) * scale
}

/// Solves with the upper triangle for all right-hand sides at once.
fn back_substitute(work: &[f64], solution: &mut [f64], (size, sides): (usize, usize)) {
    let width = size + sides;
    for row in (0..size).rev() {
        let (known, below) = solution.split_at_mut((row + 1) * sides);
        let target = &mut known[row * sides..];
        for (column, later) in (row + 1..size).zip(below.chunks_exact(sides)) {
            let factor = work[row * width + column];
            if factor != 0.0 {
                target.iter_mut().zip(later).for_each(|(sum, later)| *sum -= factor * later);
            }
        }
        let pivot = work[row * width + row];
        target.iter_mut().for_each(|value| *value /= pivot);
    }
}

impl super::KineticEquations {
    /// Returns the influences by factored equations, for equations that need full pivoting.
    pub(crate) fn influences(&self) -> Influences {
        let sides: Vec<&DVector<f64>> =
            std::iter::once(&self.load).chain(self.friction.iter().flatten()).chain(&self.couples).collect();
        let mut solutions = self.factorization.solve(&sides).into_iter();
        let mut next = || solutions.next().expect("every side has a solution");
        let frictionless = self.without_noise(&next());
        let columns = self.contacts.iter().map(|_| [next(), next()]).collect();
        let couples = self.couples.iter().map(|_| next()).collect();
        Influences {
            greatest_unknown: as_normal_force(&self.layout, &frictionless, self.factorization.column_scale()),
            layout: self.layout.clone(),
            frictionless,
            columns,
            couples,
            self_stresses: self.self_stresses(),
            openings: self.layout.openings(self.gap_accelerations()),
            condition: self.condition(),
            greatest_load: self.applied.iter().map(|load| load.force.norm()).fold(0.0, f64::max),
            coordinate_rows: self.coordinate_rows.clone(),
        }
    }
}
