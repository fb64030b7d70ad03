//! The linear relaxation of a node: undecided contacts may press on both sides at once.
//!
//! ```text
//! sum_k c_k^+ y_k^+ + c_k^- y_k^- - (d_k^+ - d_k^-) lambda_k = N(0) + sum_k d_k^-
//! y_k^+, y_k^- >= 0,   0 <= lambda_k <= 1
//! ```
//!
//! (theory, section 4 (b)), where `y_k^-` is zero and `lambda_k = 1` once contact `k` is known to be on its
//! positive side, and so on; in its gap, both `y` are zero. The condition that one of `y_k^+` and `y_k^-` is
//! zero is dropped. If this has no solution, the node has none.

mod half_spaces;

use nalgebra::DVector;

use super::UNDERFLOW;
use super::states::StateSet;
use crate::problem::{ContactState, ScaledProblem};
use crate::simplex::{Basis, Bounds, LinearOutcome, LinearProgram, dot};
use crate::solutions::ContactSet;

/// A Farkas vector must exclude by this fraction of the size of its terms, which is the tolerance for
/// solutions on a boundary.
const MARGIN: f64 = 1e-11;
/// Entries of a Farkas vector below this are set to zero, so that products with coefficients do not
/// underflow.
const SMALLEST_WEIGHT: f64 = f64::from_bits((1023 - 400) << 52);
/// Maximum number of shifts of a Farkas vector to make its verification strict.
const SHIFTS: usize = 2;
/// Relative difference that [`ModeProblem`](crate::ModeProblem) does not treat as a jump.
const IGNORED_JUMP: f64 = 1e-12;

pub(super) struct Relaxation {
    pub(super) program: LinearProgram,
    /// The variable `y_k^+` of each contact; `y_k^-` follows, and `lambda_k` where there is a jump.
    first: Vec<usize>,
    has_jump: Vec<bool>,
    /// `b`: that of the program but for a factor.
    load: Vec<f64>,
    /// The program without loads, for unknowns that are known to be large.
    far: Option<LinearProgram>,
    /// The power of two that multiplies each column of the program.
    column_scale: Vec<f64>,
    /// Size of the terms of the right-hand side, and how much of them rounding may have changed.
    load_size: Vec<f64>,
    load_error: Vec<f64>,
    /// Maximum error of each column of the program, row by row; empty if it is exact.
    spread: Vec<Vec<f64>>,
    /// The sums of sizes of the entries of each column, and of their maximum errors.
    column_sums: Vec<[f64; 2]>,
    /// Bounds on `y_k` that hold for every solution.
    largest: Vec<f64>,
    /// How many of the last contacts are slacks of half-spaces, of which the first bounds the unknowns.
    slacks: usize,
}

/// The relaxed solution for one contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct RelaxedContact {
    pub(super) positive: f64,
    pub(super) negative: f64,
    pub(super) share: f64,
    /// If both sides press: a lower bound on how much the least cost grows without the positive or the
    /// negative side; infinite if that side is indispensable.
    pub(super) cost_without: [f64; 2],
}

impl RelaxedContact {
    /// How far the contact is from being in one of the given states.
    pub(super) fn violation(&self, set: StateSet) -> f64 {
        let Self { positive, negative, share, .. } = *self;
        let violation = positive.min(negative);
        if set.len() > 2 || set.contains(ContactState::Gap) {
            violation.max(positive.min(1.0 - share)).max(negative.min(share))
        } else {
            violation
        }
    }
}

/// The outcome of the relaxation for a node.
pub(super) enum Relaxed {
    Feasible(Vec<RelaxedContact>),
    /// The node has no solution, as proven by a vector `v` with `v . (left side) < v . (right side)` for
    /// everything that its states allow.
    Excluded(Vec<f64>),
    Undecided,
}

impl Relaxation {
    /// The relaxation with `y_k <= largest_k` for every solution, for all right-hand sides within
    /// `load_radius`.
    pub(super) fn new(problem: &ScaledProblem, load_radius: &DVector<f64>, largest: Vec<f64>) -> Self {
        let contacts = problem.contacts();
        let (mut columns, mut cost, mut first) = (Vec::new(), Vec::new(), Vec::new());
        let (mut column_scale, mut spread) = (Vec::new(), Vec::new());
        for contact in 0..contacts {
            first.push(columns.len());
            for &state in problem.states(contact) {
                let column = problem.column(contact, state);
                let scale = power_of_two_below(column.amax()).recip();
                columns.push((column * scale).as_slice().to_vec());
                let radius = problem.column_radius(contact, state);
                spread.push(radius.map_or_else(Vec::new, |radius| (radius * scale).as_slice().to_vec()));
                column_scale.push(scale);
                cost.push(uneven_cost(cost.len()) * if state == ContactState::Gap { 0.01 } else { 1.0 });
            }
        }
        let both_sums =
            |(column, spread): (&Vec<f64>, &Vec<f64>)| [sum_of_sizes(column), sum_of_sizes(spread)];
        let column_sums = columns.iter().zip(&spread).map(both_sums).collect();
        let load_size = problem.load_size().as_slice().to_vec();
        let load_error = load_error(problem, load_radius).as_slice().to_vec();
        Self {
            program: LinearProgram::new(&columns, problem.base().as_slice().to_vec(), cost),
            first,
            has_jump: problem.has_jump.clone(),
            load: problem.base().as_slice().to_vec(),
            far: None,
            column_scale,
            load_size,
            load_error,
            spread,
            column_sums,
            largest,
            slacks: 0,
        }
    }

    /// `v . b`.
    pub(super) fn load_product(&self, vector: &[f64]) -> f64 {
        dot(vector, &self.load)
    }

    /// `b`.
    pub(super) fn load(&self) -> &[f64] {
        &self.load
    }

    pub(super) fn first_basis(&self) -> Basis {
        self.program.artificial_basis()
    }

    /// The most numbers that a basis holds.
    pub(super) fn size_of_basis(&self) -> usize {
        self.load.len() * self.program.columns()
    }

    /// Solves the relaxation of a node from the basis of its parent, and returns the basis with which its children
    /// begin. The result is undecided once `proceed` is `false`.
    pub(super) fn solve(
        &self,
        states: &[StateSet],
        mut basis: Basis,
        iterations: &mut u64,
        proceed: &mut dyn FnMut() -> bool,
    ) -> (Relaxed, Basis) {
        let bounds = self.bounds(states);
        basis.restrict(&bounds);
        let relaxed = match self.program.solve(&mut basis, &bounds, iterations, proceed) {
            LinearOutcome::Feasible(values) => Relaxed::Feasible(self.contacts(&values, &basis)),
            LinearOutcome::Infeasible(farkas) => {
                match (self.verified(self.deepened(farkas), &bounds, Some(&basis)), &self.far) {
                    (Some(farkas), _) => Relaxed::Excluded(farkas),
                    (None, Some(far)) => self.without_loads(far, &bounds, &mut basis, iterations, proceed),
                    (None, None) => Relaxed::Undecided,
                }
            }
            LinearOutcome::Undecided => return (Relaxed::Undecided, self.first_basis()),
        };
        (relaxed, basis)
    }

    /// A vector that excludes a node, apart from rounding errors; `None` if the relaxation may have a
    /// solution, or once `proceed` is `false`.
    pub(super) fn farkas(&self, states: &[StateSet], proceed: &mut dyn FnMut() -> bool) -> Option<Vec<f64>> {
        let bounds = self.bounds(states);
        let mut basis = self.first_basis();
        basis.restrict(&bounds);
        match self.program.solve(&mut basis, &bounds, &mut 0, proceed) {
            LinearOutcome::Infeasible(farkas) => Some(farkas),
            LinearOutcome::Feasible(_) | LinearOutcome::Undecided => None,
        }
    }

    pub(super) fn bounds(&self, states: &[StateSet]) -> Bounds {
        let mut bounds =
            Bounds { lower: vec![0.0; self.program.columns()], upper: vec![0.0; self.program.columns()] };
        for (contact, &set) in states.iter().enumerate() {
            let at = self.first[contact];
            for (offset, state) in ContactState::PRESSED.into_iter().enumerate() {
                if set.contains(state) {
                    let most = self.largest[contact] / self.column_scale[at + offset];
                    bounds.upper[at + offset] = most.max(f64::MIN_POSITIVE);
                }
            }
        }
        for (variable, least, most) in self.shares(states) {
            bounds.lower[variable] = least;
            bounds.upper[variable] = most;
        }
        bounds
    }

    /// The unknowns of each contact that are positive inside the face of all solutions of a node that was
    /// solved with this basis; `None` if that was not found.
    pub(super) fn inside(
        &self,
        states: &[StateSet],
        basis: &Basis,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<Positive>> {
        let bounds = self.bounds(states);
        let inside = basis.inside(&self.program, &bounds, proceed)?;
        let positive = |(contact, &at): (usize, &usize)| {
            let shares = match (self.has_jump[contact], states[contact].share()) {
                (false, _) => [false; 2],
                (true, (least, most)) if least == most => [least > 0.0, most < 1.0],
                (true, _) => inside[at + 2],
            };
            Positive { sides: [inside[at][0], inside[at + 1][0]], shares }
        };
        Some(self.first.iter().enumerate().map(positive).collect())
    }

    fn contacts(&self, values: &[f64], basis: &Basis) -> Vec<RelaxedContact> {
        let value = |variable: usize| values[variable] * self.column_scale[variable];
        let relaxed = |(&at, &jump): (&usize, &bool)| {
            let (positive, negative) = (value(at), value(at + 1));
            let sides = if positive > 0.0 && negative > 0.0 { Some([at, at + 1]) } else { None };
            RelaxedContact {
                positive,
                negative,
                share: if jump { value(at + 2) } else { 0.0 },
                cost_without: sides.map_or([0.0; 2], |sides| sides.map(|side| basis.cost_of_zero(side))),
            }
        };
        self.first.iter().zip(&self.has_jump).map(relaxed).collect()
    }

    /// The columns of the lifted equations (`k` for the positive and `n + k` for the negative side of contact `k`)
    /// without which a vector excludes every node, with rounding errors accounted for, as long as the unknowns
    /// are unbounded; with jumps, as far as sides are concerned. `None` if it excludes none.
    pub(super) fn not_excluded_by(&self, vector: &[f64]) -> Option<ContactSet> {
        let vector = of_size_one(vector.to_vec())?;
        let sizes: Vec<f64> = vector.iter().map(|entry| entry.abs()).collect();
        let jumps = self.has_jump.iter().filter(|jump| **jump).count();
        if jumps == 0 && !self.excludes(&vector, &sizes, 0.0, 0.0) {
            return None;
        }
        let largest = sizes.iter().fold(0.0, |most: f64, &size| most.max(size));
        let combined = self.program.row_combination(&vector);
        let contacts = self.first.len();
        let mut left = ContactSet::none_of(2 * (contacts + jumps));
        for (contact, &first) in self.first.iter().enumerate() {
            for side in [0, 1] {
                // The product with the column of a slack is one entry times a power of two.
                let is_exact = self.is_slack(first);
                let error = if is_exact { 0.0 } else { largest * self.largest_error(first + side) };
                let high = combined[first + side] + error;
                if high > 0.0 || high.is_nan() {
                    left.insert(side * contacts + contact);
                }
            }
        }
        Some(left)
    }

    /// The unknowns of those columns of the lifted equations that are sides of contacts.
    pub(super) fn variables_of_sides(&self, columns: &ContactSet) -> impl Iterator<Item = usize> {
        let contacts = self.first.len();
        let sides = columns.iter().take_while(move |&column| column < 2 * contacts);
        sides.map(move |column| self.first[column % contacts] + column / contacts)
    }

    /// The unknown of each share, with its bounds.
    pub(super) fn shares(&self, states: &[StateSet]) -> Vec<(usize, f64, f64)> {
        let share = |(contact, &first): (usize, &usize)| {
            let ((least, most), scale) = (states[contact].share(), self.column_scale[first + 2]);
            (first + 2, least / scale, most / scale)
        };
        let jumping = self.first.iter().enumerate().filter(|&(contact, _)| self.has_jump[contact]);
        jumping.map(share).collect()
    }

    /// The sum of the sizes of the entries of a column.
    pub(super) fn column_sum(&self, variable: usize) -> f64 {
        self.column_sums[variable][0]
    }

    /// The maximum error of the product of a column with a vector whose entries have at most size 1.
    fn largest_error(&self, variable: usize) -> f64 {
        let [sizes, spread] = self.column_sums[variable];
        self.rounding() * sizes + 1.01 * spread
    }

    /// Relative rounding error of sums over all rows.
    fn rounding(&self) -> f64 {
        (self.first.len() + 4) as f64 * f64::EPSILON
    }

    /// A Farkas vector that excludes the node with rounding errors accounted for. The columns of basic
    /// variables, for which the vector gives exactly zero, are moved to the safe side, if the basis is given.
    fn verified(&self, mut farkas: Vec<f64>, bounds: &Bounds, basis: Option<&Basis>) -> Option<Vec<f64>> {
        for _ in 0..=SHIFTS {
            farkas = of_size_one(farkas)?;
            let (combined, terms) =
                (self.program.row_combination(&farkas), self.program.sizes_of_terms(&farkas));
            let sizes: Vec<f64> = farkas.iter().map(|entry| entry.abs()).collect();
            let rounding = self.rounding();
            let mut shifted = false;
            let (mut most, mut size) = (0.0, 0.0);
            let mut shift = vec![0.0; farkas.len()];
            for (variable, &entry) in combined.iter().enumerate() {
                if bounds.lower[variable] == 0.0 && bounds.upper[variable] == 0.0 {
                    continue;
                }
                let error = rounding * terms[variable] + 1.01 * size_of_terms(&self.spread[variable], &sizes);
                let (low, high) = (entry - error, entry + error);
                if high.is_nan() {
                    return None;
                }
                if high > 0.0 && bounds.upper[variable] == f64::INFINITY {
                    let row = basis?.row_of(&self.program, variable)?;
                    crate::simplex::add_multiple(&mut shift, -2.0 * high, &row);
                    shifted = true;
                } else if high > 0.0 {
                    most += high * bounds.upper[variable];
                    size += (high - low) * bounds.upper[variable];
                }
                if high <= 0.0 && bounds.lower[variable] > 0.0 {
                    most += high * bounds.lower[variable];
                }
            }
            if !shifted {
                return self.excludes(&farkas, &sizes, most, size).then_some(farkas);
            }
            crate::simplex::add_multiple(&mut farkas, 1.0, &shift);
        }
        None
    }

    /// `v . b` exceeds what the left side can reach.
    fn excludes(&self, farkas: &[f64], sizes: &[f64], most: f64, size: f64) -> bool {
        let load = self.load_product(farkas);
        let terms = size_of_terms(&self.load_size, sizes);
        let error = size_of_terms(&self.load_error, sizes);
        let slack = 2.0 * error + (self.rounding() + MARGIN) * (terms + size + most.abs());
        load - most > slack + UNDERFLOW
    }
}

/// A vector times a power of two, with entries up to about 1 and none too small for products; `None` if that
/// is not possible.
fn of_size_one(mut vector: Vec<f64>) -> Option<Vec<f64>> {
    let size = vector.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
    if !vector.iter().all(|entry| entry.is_finite()) || size == 0.0 {
        return None;
    }
    let scale = power_of_two_below(size).recip();
    for entry in &mut vector {
        *entry *= scale;
        if entry.abs() < SMALLEST_WEIGHT {
            *entry = 0.0;
        }
    }
    Some(vector)
}

/// `sum |a_i|`.
pub(super) fn sum_of_sizes(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).sum()
}

/// `sum |a_i| s_i` with sizes `s_i >= 0`.
fn size_of_terms(values: &[f64], sizes: &[f64]) -> f64 {
    values.iter().zip(sizes).map(|(value, size)| value.abs() * size).sum()
}

/// The maximum error of the right-hand side: `load_radius`, and what rounding and negligible jumps can have
/// changed in `N(0) + sum d^-`.
pub(super) fn load_error(problem: &ScaledProblem, load_radius: &DVector<f64>) -> DVector<f64> {
    let terms = problem.base().zip_map(problem.load_size(), |base, size| base.abs() != size);
    let jumps_contribute = terms.iter().any(|&contributes| contributes);
    let share =
        if jumps_contribute { IGNORED_JUMP + (problem.contacts() + 4) as f64 * f64::EPSILON } else { 0.0 };
    problem.load_size() * share + load_radius
}

/// Costs that differ between variables, so that the dual program is not degenerate.
fn uneven_cost(variable: usize) -> f64 {
    // The fractional parts of multiples of the golden ratio are evenly distributed.
    1.0 + 0.2 * (variable as f64 * 0.618_033_988_749_895).fract()
}

fn power_of_two_below(size: f64) -> f64 {
    if size == 0.0 { 1.0 } else { size.log2().floor().clamp(-1000.0, 1000.0).exp2() }
}

/// The unknowns of one contact that are positive inside a face: `y^+`, `y^-`, `lambda`, `1 - lambda`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Positive {
    pub(super) sides: [bool; 2],
    pub(super) shares: [bool; 2],
}

impl Positive {
    /// Whether all positive unknowns belong to this state.
    pub(super) fn agrees_with(self, state: ContactState) -> bool {
        let [positive, negative] = self.sides;
        let [share, rest] = self.shares;
        match state {
            ContactState::Positive => !negative && !rest,
            ContactState::Negative => !positive && !share,
            ContactState::Gap => !positive && !negative,
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::super::states::all_states;
    use super::super::test_problems::{Numbers, admitted, holds};
    use super::*;
    use crate::problem::ModeProblem;

    fn relaxation(problem: &ModeProblem, load_radius: f64) -> (ScaledProblem, Relaxation) {
        let scaled = ScaledProblem::new(problem);
        let radius = scaled.scaled_load_radius(&DVector::repeat(problem.contacts(), load_radius));
        let largest = vec![f64::INFINITY; problem.contacts()];
        let relaxation = Relaxation::new(&scaled, &radius, largest);
        (scaled, relaxation)
    }

    /// Random states of some contacts.
    fn some_states(numbers: &mut Numbers, all: &[StateSet]) -> Vec<StateSet> {
        let choose = |&set: &StateSet| {
            let states: Vec<ContactState> = set.iter().collect();
            match numbers.below(6) {
                at @ 0..=2 => StateSet::only(states[at % states.len()]),
                3 if states.len() > 2 => set.without(states[numbers.below(3)]),
                _ => set,
            }
        };
        all.iter().map(choose).collect()
    }

    #[test]
    fn excluded_nodes_admit_nothing() {
        let mut excluded = 0;
        for seed in 0..150 {
            let mut numbers = Numbers::new(seed);
            let problem = numbers.problem(3, 1.5, seed % 2 == 0);
            let radius = if seed % 3 == 0 { 0.2 } else { 0.0 };
            let (scaled, relaxation) = relaxation(&problem, radius);
            let nearby = numbers.with_load_off_by(&problem, radius);
            let admitted = admitted(&nearby);
            for _ in 0..12 {
                let states = some_states(&mut numbers, &all_states(&scaled));
                let (relaxed, _) = relaxation.solve(&states, relaxation.first_basis(), &mut 0, &mut || true);
                if matches!(relaxed, Relaxed::Excluded(_)) {
                    excluded += 1;
                    assert!(!admitted.iter().any(|(pattern, _)| holds(&states, pattern)), "{problem:?}");
                }
            }
        }
        assert!(excluded > 200, "{excluded}");
    }

    #[test]
    fn wrong_vectors_exclude_nothing() {
        let mut verified = 0;
        for seed in 0..60 {
            let mut numbers = Numbers::new(500 + seed);
            let problem = numbers.problem(3, 1.0, seed % 2 == 0);
            let (scaled, relaxation) = relaxation(&problem, 0.0);
            let admitted = admitted(&problem);
            for _ in 0..40 {
                let states = some_states(&mut numbers, &all_states(&scaled));
                let bounds = relaxation.bounds(&states);
                let weights: Vec<f64> = (0..3).map(|_| numbers.number()).collect();
                if relaxation.verified(weights, &bounds, None).is_some() {
                    verified += 1;
                    assert!(!admitted.iter().any(|(pattern, _)| holds(&states, pattern)), "{problem:?}");
                }
            }
        }
        assert!(verified > 20, "{verified}");
    }

    /// Whether a vector excludes that both of two contacts are on their positive sides.
    fn excludes(columns: [f64; 4], load: [f64; 2], weights: [f64; 2]) -> bool {
        let columns = DMatrix::from_row_slice(2, 2, &columns);
        let (negative, none) = (DMatrix::from_element(2, 2, -1.0), DMatrix::zeros(2, 2));
        let load = DVector::from_column_slice(&load);
        let problem = ModeProblem::new(columns, negative, none.clone(), none, load).expect("shapes fit");
        let (_, relaxation) = relaxation(&problem, 0.0);
        let bounds = relaxation.bounds(&[StateSet::only(ContactState::Positive); 2]);
        relaxation.verified(weights.to_vec(), &bounds, None).is_some()
    }

    #[test]
    fn products_within_rounding_of_zero_exclude_nothing() {
        // (1 + 2^-30)^2 - (1 + 2^-29) is 2^-60, but 0 if it is rounded.
        let entry = 1.0 + 2_f64.powi(-30);
        let columns = [entry, -1.0, 1.0, 1.0];
        assert!(!excludes(columns, [1.0, 0.0], [entry, -1.0 - 2_f64.powi(-29)]));
        assert!(excludes(columns, [1.0, 0.0], [entry, -1.0 - 2_f64.powi(-28)]));
    }

    #[test]
    fn loads_within_the_margin_of_zero_exclude_nothing() {
        let columns = [1.0, -1.0, 1.5, 1.0];
        assert!(!excludes(columns, [1.0, 1.0 - 1e-12], [1.0, -1.0]));
        assert!(excludes(columns, [1.0, 1.0 - 1e-9], [1.0, -1.0]));
    }
}
