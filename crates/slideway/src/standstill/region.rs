//! A region of points within linear inequalities, and the linear programs that ask for its extent.

use microlp::{ComparisonOp, Error, OptimizationDirection, Problem, SolveOptions, Variable};

/// Coefficients below this are rounding errors of terms of order one.
const NO_COEFFICIENT: f64 = 1e-13;
/// A finite extent beyond this is one that rounding has cut off: the region is unbounded.
const UNBOUNDED: f64 = 1e9;
/// A direction counts as one of recession if it misses no constraint by more than this.
const RECESSION: f64 = 1e-10;
/// The solver may miss a constraint by this, the least that it takes.
const FEASIBILITY: f64 = 1e-10;
/// Constraints are multiplied by this power of two, so that the solver misses them by no more than about 1e-14.
const MAGNIFIED: f64 = 8192.0;
/// Optima below this are rounding errors of terms of order one.
const NOTHING: f64 = 1e-12;

/// A function `coefficients . z + constant`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Affine {
    /// Coefficients of the unknowns.
    pub(super) coefficients: Vec<f64>,
    /// The constant.
    pub(super) constant: f64,
}

/// The points at which every one of some functions is at most zero.
#[derive(Debug, Clone)]
pub(super) struct Region {
    dimension: usize,
    constraints: Vec<Affine>,
}

/// The solver gave up, or its answer contradicts what is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Undecided;

impl Region {
    /// The points of so many coordinates at which every function is at most zero.
    pub(super) fn new(dimension: usize, constraints: Vec<Affine>) -> Self {
        let mut region = Self { dimension, constraints };
        for constraint in &mut region.constraints {
            for coefficient in &mut constraint.coefficients {
                if coefficient.abs() <= NO_COEFFICIENT {
                    *coefficient = 0.0;
                }
            }
        }
        region
    }

    /// How far the region is from empty: the least `t >= -1` with some point at which every function is at most
    /// `t`. Positive if it is empty.
    ///
    /// # Errors
    /// If the linear program, which has a solution, was not solved.
    pub(super) fn margin(&self) -> Result<f64, Undecided> {
        if self.dimension == 0 {
            return Ok(self.constraints.iter().map(|constraint| constraint.constant).fold(-1.0, f64::max));
        }
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let unknowns = free_unknowns(&mut problem, &vec![0.0; self.dimension]);
        let margin = problem.add_var(1.0, (-1.0, f64::INFINITY));
        for constraint in &self.constraints {
            let mut row = terms(&unknowns, constraint);
            row.push((margin, -MAGNIFIED));
            problem.add_constraint(&row[..], ComparisonOp::Le, -MAGNIFIED * constraint.constant);
        }
        optimum(&problem)?.ok_or(Undecided)
    }

    /// The region with every constraint relaxed by the same amount.
    pub(super) fn relaxed(mut self, amount: f64) -> Self {
        for constraint in &mut self.constraints {
            constraint.constant -= amount;
        }
        self
    }

    /// Least and greatest value of a function in the region, which must not be empty; nothing where it is unbounded.
    ///
    /// It is unbounded where the cone of recession reaches in the direction of the function, which is judged with
    /// [`RECESSION`], so that a cone which rounding has closed counts as open.
    ///
    /// # Errors
    /// If a linear program was not solved.
    pub(super) fn extent(&self, function: &Affine) -> Result<[Option<f64>; 2], Undecided> {
        let least = self.least(function, 1.0)?;
        let greatest = self.least(function, -1.0)?;
        Ok([least, greatest.map(|value| -value)])
    }

    /// Least value of `sign` times a function.
    fn least(&self, function: &Affine, sign: f64) -> Result<Option<f64>, Undecided> {
        let constant = sign * function.constant;
        if function.coefficients.iter().all(|coefficient| coefficient.abs() <= NO_COEFFICIENT) {
            return Ok(Some(constant));
        }
        if self.recedes(function, sign)? {
            return Ok(None);
        }
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let costs: Vec<f64> = function.coefficients.iter().map(|coefficient| sign * coefficient).collect();
        let unknowns = free_unknowns(&mut problem, &costs);
        for constraint in &self.constraints {
            let row = terms(&unknowns, constraint);
            if !row.is_empty() {
                problem.add_constraint(&row[..], ComparisonOp::Le, -MAGNIFIED * constraint.constant);
            }
        }
        let without_noise = |value: f64| if value.abs() <= NOTHING { 0.0 } else { value };
        let least = optimum(&problem)?.map(|least| without_noise(least + constant));
        Ok(least.filter(|least| least.abs() < UNBOUNDED))
    }

    /// Whether there is a direction in which every constraint stays satisfied and `sign` times the function falls:
    /// the least `t` with `coefficients . d <= t` for all constraints and `sign function . d = -1` is not positive.
    fn recedes(&self, function: &Affine, sign: f64) -> Result<bool, Undecided> {
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let unknowns = free_unknowns(&mut problem, &vec![0.0; self.dimension]);
        let margin = problem.add_var(1.0, (-1.0, f64::INFINITY));
        for constraint in &self.constraints {
            let mut row = terms(&unknowns, constraint);
            if !row.is_empty() {
                row.push((margin, -MAGNIFIED));
                problem.add_constraint(&row[..], ComparisonOp::Le, 0.0);
            }
        }
        problem.add_constraint(&terms(&unknowns, function)[..], ComparisonOp::Eq, -MAGNIFIED * sign);
        let margin = optimum(&problem)?.ok_or(Undecided)?;
        Ok(margin <= RECESSION)
    }
}

fn free_unknowns(problem: &mut Problem, costs: &[f64]) -> Vec<Variable> {
    costs.iter().map(|cost| problem.add_var(*cost, (f64::NEG_INFINITY, f64::INFINITY))).collect()
}

/// The terms of a function, magnified.
fn terms(unknowns: &[Variable], function: &Affine) -> Vec<(Variable, f64)> {
    let pairs = unknowns.iter().copied().zip(function.coefficients.iter().copied());
    let terms = pairs.filter(|(_, coefficient)| *coefficient != 0.0);
    terms.map(|(unknown, coefficient)| (unknown, MAGNIFIED * coefficient)).collect()
}

/// The optimum of a problem that has feasible points; nothing where it is unbounded.
fn optimum(problem: &Problem) -> Result<Option<f64>, Undecided> {
    let mut options = SolveOptions::default();
    options.tolerances.feasibility = FEASIBILITY;
    match problem.solve_with(options) {
        Ok(outcome) => {
            let solution = outcome.into_solution().ok().ok_or(Undecided)?;
            Ok(Some(solution.objective()).filter(|objective| objective.is_finite()))
        }
        Err(Error::Unbounded) => Ok(None),
        Err(_) => Err(Undecided),
    }
}
