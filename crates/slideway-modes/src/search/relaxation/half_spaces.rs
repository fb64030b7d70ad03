//! Relaxations within half-spaces that bound all unknowns, for proofs of coupling of low rank.

use super::{Relaxation, Relaxed};
use crate::problem::power_of_two_above;
use crate::simplex::{Basis, Bounds, LinearOutcome, LinearProgram};

impl Relaxation {
    /// The same, where the last contacts are slacks of half-spaces ([`ModeProblem::within_half_spaces`]). The first
    /// one limits a sum of all other unknowns, with positive weights, to one side.
    ///
    /// [`ModeProblem::within_half_spaces`]: crate::ModeProblem::within_half_spaces
    pub(in super::super) fn within_half_spaces(self, slacks: usize) -> Self {
        let row = self.first.len() - slacks;
        let factor = power_of_two_above(self.load[..row].iter().fold(0.0, |most, load| load.abs().max(most)));
        let right: Vec<f64> = self.load.iter().map(|load| load / factor).collect();
        // The slack of the limit has about the size of the other unknowns.
        let (program, slack) = (self.program, self.first[row]);
        let program = program.with_multiple_of_column(slack, power_of_two_above(right[row].abs()));
        let is_far = right[row] < 0.0;
        let far = is_far.then(|| {
            let without =
                right.iter().enumerate().map(|(at, load)| if at < row { 0.0 } else { load * factor });
            program.clone().with_right_hand_side(without.collect())
        });
        Self { program: program.with_right_hand_side(right), far, slacks, ..self }
    }

    /// How many of the contacts are slacks of half-spaces.
    pub(in super::super) fn slacks(&self) -> usize {
        self.slacks
    }

    /// Whether unknowns are known to be large.
    pub(in super::super) fn is_far(&self) -> bool {
        self.far.is_some()
    }

    /// A Farkas vector whose products with the columns of all sides are smaller, by a multiple of the weights of the
    /// sum that the first half-space limits; the same one if there is no half-space.
    ///
    /// With `sum <= Gamma` the entry of this half-space may decrease: products change by `-step` times the weights,
    /// and `v . b` by `-step Gamma`. With `-sum <= -Gamma` it may increase, to the same effect, up to zero.
    pub(super) fn deepened(&self, mut farkas: Vec<f64>) -> Vec<f64> {
        if self.slacks > 0 {
            let row = self.first.len() - self.slacks;
            // The simplex method takes small entries for zeros: those of slacks are not to be positive.
            farkas[row..].iter_mut().for_each(|entry| *entry = entry.min(0.0));
            let room = if self.is_far() { -farkas[row] } else { f64::INFINITY };
            let step = (self.load_product(&farkas) / self.load[row].abs()).clamp(0.0, room.max(0.0));
            farkas[row] -= 0.5 * step * self.load[row].signum();
        }
        farkas
    }

    /// The relaxation without loads, where unknowns are known to be large: a vector that excludes it depends on that, and
    /// so can be deepened. Children of a node that it does not exclude are excluded by it sooner or later.
    pub(super) fn without_loads(
        &self,
        far: &LinearProgram,
        bounds: &Bounds,
        basis: &mut Basis,
        iterations: &mut u64,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Relaxed {
        match far.solve(basis, bounds, iterations, proceed) {
            LinearOutcome::Feasible(values) => Relaxed::Feasible(self.contacts(&values, basis)),
            LinearOutcome::Infeasible(farkas) => self
                .verified(self.deepened(farkas), bounds, Some(basis))
                .map_or(Relaxed::Undecided, Relaxed::Excluded),
            LinearOutcome::Undecided => Relaxed::Undecided,
        }
    }

    /// Whether an unknown is the slack of a half-space.
    pub(in super::super) fn is_slack(&self, variable: usize) -> bool {
        variable >= self.first.get(self.first.len() - self.slacks).copied().unwrap_or(usize::MAX)
    }
}
