//! What becomes of a mechanism that starts beside an unattainable solution: the fast motion, piecewise
//! linear.
//!
//! With the gaps `g` and the damping `delta` of the contacts,
//!
//! ```text
//! N = -K (g + delta g'),    Y g'' = sum_k c_k^sigma |N_k| - N(0) - sum_k d_k^sigma,    sigma = sign N
//! ```
//!
//! is linear as long as no contact changes side, opens or closes: redundant contacts have gaps `E g + d0`, and
//! forces only beyond their clearance. There the motion is exact: powers of one matrix exponential
//! for steps that are halved until the change of side lies within the last.

use super::shared::SharedGaps;
use super::spectrum::{eigenvalues, is_real};
use crate::modes::{ContactState, ModeProblem, Side};
use nalgebra::{DMatrix, DVector, LU};
use std::collections::HashMap;

/// Steps are this fraction of the time in which the fastest motion changes, and halved so many times.
const STEP: f64 = 0.5;
const HALVINGS: usize = 12;
/// Steps without a change of side after which they are doubled, and the greatest doubling.
const QUIET: usize = 8;
const DOUBLINGS: usize = 6;
/// Multiplications in one motion.
const WORK: usize = 400_000;
/// A solution counts as reached within this multiple of the distance that was gone.
const NEAR: f64 = 1e-2;
/// Reactions this many times those of all solutions have grown beyond all bounds.
const BEYOND: f64 = 1e4;
/// How far the motion starts, as a share of the way to the first change of side.
const START: f64 = 0.5;

/// A state of rest of the fast motion: a solution.
#[derive(Debug, Clone)]
pub(super) struct Rest<'s> {
    pub(super) states: &'s [ContactState],
    pub(super) normal_force: &'s DVector<f64>,
    /// The gaps, of redundant contacts those that are not cut.
    pub(super) gap: DVector<f64>,
}

/// How a motion ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// At the target of this index.
    Target(usize),
    /// Nowhere: the reactions grow beyond all bounds.
    Beyond,
    /// Not within the limit of work.
    Open,
}

/// The fast motion with damped contacts.
pub(super) struct FastMotion<'p> {
    problem: &'p ModeProblem,
    /// Y^-1, with a little inertia where there is none.
    mobility: DMatrix<f64>,
    stiffness: Vec<f64>,
    shared: Option<&'p SharedGaps>,
    /// delta (s).
    damping: f64,
    steps: HashMap<Vec<ContactState>, Steps>,
}

/// exp(A h) for steps h, the greatest first: (g, g', 1) to (g, g', 1).
struct Steps {
    powers: Vec<DMatrix<f64>>,
}

impl<'p> FastMotion<'p> {
    /// With half of the critical damping of the slowest motion without friction; none if that is not known.
    pub(super) fn new(
        problem: &'p ModeProblem,
        mobility: DMatrix<f64>,
        stiffness: &[f64],
        shared: Option<&'p SharedGaps>,
    ) -> Option<Self> {
        let frictionless = &mobility
            * match shared {
                Some(shared) => shared.stiff(&shared.gaps.transpose(), stiffness),
                None => DMatrix::from_diagonal(&DVector::from_column_slice(stiffness)),
            };
        let slowest = eigenvalues(&frictionless)?.iter().map(|value| value.re).fold(f64::INFINITY, f64::min);
        let damping = 1.0 / slowest.sqrt();
        let stiffness = stiffness.to_vec();
        let steps = HashMap::new();
        damping.is_finite().then_some(Self { problem, mobility, stiffness, shared, damping, steps })
    }

    /// Where the motion leads to on both sides of a solution with one unstable motion: started along that
    /// motion. None if there is no such motion or several.
    pub(super) fn ends(&mut self, from: &Rest<'_>, targets: &[Rest<'_>]) -> Option<[End; 2]> {
        let (lambda, gaps) = self.unstable(from.states)?;
        // s^2 + lambda (1 + delta s) = 0, lambda < 0
        let damped = self.damping * lambda;
        let rate = f64::midpoint(-damped, (damped * damped - 4.0 * lambda).sqrt());
        let factor = -(1.0 + self.damping * rate);
        let (deflections, opened) = (self.deflections(&from.gap), self.of_gaps(&gaps));
        Some([1.0, -1.0].map(|direction| {
            // The first contact that changes side, opens or closes on the straight way.
            let ways = (0..opened.len()).map(|k| match from.states[k] {
                ContactState::Gap => {
                    let change = -direction * factor * opened[k];
                    (self.clearance(k).copysign(change) - deflections[k]) / change
                }
                _ => -from.normal_force[k] / (direction * factor * self.stiffness[k] * opened[k]),
            });
            let way = ways.filter(|way| *way > 0.0).fold(f64::INFINITY, f64::min);
            if way.is_infinite() {
                return End::Beyond;
            }
            let amount = direction * START * way;
            let gap = &gaps * amount + &from.gap;
            self.end(&gap, &(&gaps * (amount * rate)), from, targets)
        }))
    }

    /// The only unstable motion of a mode: lambda < 0 and the gaps; none if there is none or several.
    fn unstable(&self, states: &[ContactState]) -> Option<(f64, DVector<f64>)> {
        let matrix = &self.mobility * self.stiff(states);
        let mut unstable = eigenvalues(&matrix)?.into_iter().filter(|value| value.re <= 0.0);
        let (lambda, more) = (unstable.next()?, unstable.next());
        if more.is_some() || !is_real(lambda) || lambda.re == 0.0 {
            return None;
        }
        // Inverse iteration.
        let shift = DMatrix::identity(matrix.nrows(), matrix.nrows()) * (lambda.re * (1.0 + 1e-9));
        let factors = LU::new(&matrix - shift);
        let mut gaps = DVector::from_fn(matrix.nrows(), |k, _| 1.0 / (1.0 + k as f64));
        for _ in 0..3 {
            gaps = factors.solve(&gaps)?;
            gaps /= gaps.amax();
        }
        gaps.iter().all(|gap| gap.is_finite()).then_some((lambda.re, gaps))
    }

    /// The gaps of all contacts from those that are not cut.
    fn of_gaps(&self, gaps: &DVector<f64>) -> DVector<f64> {
        self.shared.map_or_else(|| gaps.clone(), |shared| &shared.gaps * gaps)
    }

    /// The deflections of all contacts.
    fn deflections(&self, gaps: &DVector<f64>) -> DVector<f64> {
        self.shared.map_or_else(|| gaps.clone(), |shared| &shared.gaps * gaps + &shared.offset)
    }

    fn clearance(&self, k: usize) -> f64 {
        self.shared.map_or(0.0, |shared| shared.clearance[k])
    }

    /// C S K of a mode; of redundant contacts `(C S)_kept K E`.
    fn stiff(&self, states: &[ContactState]) -> DMatrix<f64> {
        if let Some(shared) = self.shared {
            let mode = super::mode_matrix(self.problem, states).select_rows(&shared.kept);
            return shared.stiff(&mode, &self.stiffness);
        }
        let mut matrix = super::mode_matrix(self.problem, states);
        for (mut column, stiffness) in matrix.column_iter_mut().zip(&self.stiffness) {
            column *= *stiffness;
        }
        matrix
    }

    fn end(&mut self, gap: &DVector<f64>, rate: &DVector<f64>, from: &Rest<'_>, targets: &[Rest<'_>]) -> End {
        let contacts = gap.len();
        let mut state = DVector::from_element(2 * contacts + 1, 1.0);
        state.rows_mut(0, contacts).copy_from(gap);
        state.rows_mut(contacts, contacts).copy_from(rate);
        let scale =
            targets.iter().map(|rest| rest.normal_force.amax()).fold(from.normal_force.amax(), f64::max);
        let (mut level, mut quiet) = (DOUBLINGS, 0);
        let mut work = 0;
        while work < WORK {
            let pressed = self.states(&state);
            if !self.steps.contains_key(&pressed) {
                let steps = self.steps_of(&pressed);
                self.steps.insert(pressed.clone(), steps);
            }
            let steps = &self.steps[&pressed];
            let next = &steps.powers[level] * &state;
            work += state.len() * state.len();
            if self.states(&next) == pressed {
                state = next;
                quiet += 1;
            } else if level + 1 < steps.powers.len() {
                level += 1;
                quiet = 0;
                continue;
            } else {
                state = next;
                level = DOUBLINGS;
                quiet = 0;
            }
            if quiet >= QUIET && level > 0 {
                level -= 1;
                quiet = 0;
            }
            if let Some(end) = self.has_ended(&state, &pressed, scale, from, targets) {
                return end;
            }
        }
        End::Open
    }

    fn has_ended(
        &self,
        state: &DVector<f64>,
        states: &[ContactState],
        scale: f64,
        from: &Rest<'_>,
        targets: &[Rest<'_>],
    ) -> Option<End> {
        let forces: Vec<f64> = (0..states.len()).map(|k| self.force(state, k)).collect();
        let greatest = forces.iter().map(|force| force.abs()).fold(0.0, f64::max);
        if greatest > BEYOND * scale {
            return Some(End::Beyond);
        }
        let rates = self.of_gaps(&rates(state));
        let is_near = |target: &Rest<'_>| {
            let distance = NEAR * (target.normal_force - from.normal_force).amax();
            (0..states.len()).all(|k| {
                let rate = self.stiffness[k] * self.damping * rates[k];
                states[k] == target.states[k]
                    && (forces[k] - target.normal_force[k]).abs() <= distance
                    && rate.abs() <= distance
            })
        };
        targets.iter().position(is_near).map(End::Target)
    }

    /// g + delta g' of a contact.
    fn damped(&self, state: &DVector<f64>, k: usize) -> f64 {
        let gaps = (state.len() - 1) / 2;
        let kept = |gap: usize| state[gap] + self.damping * state[gaps + gap];
        match self.shared {
            None => kept(k),
            Some(shared) => {
                let terms = (0..gaps).map(|gap| shared.gaps[(k, gap)] * kept(gap));
                shared.offset[k] + terms.sum::<f64>()
            }
        }
    }

    /// What a contact does: it is pressed where g + delta g' is beyond its clearance, a face of a press fit on its own
    /// side alone.
    fn state(&self, state: &DVector<f64>, k: usize) -> ContactState {
        let (damped, clearance) = (self.damped(state, k), self.clearance(k));
        let side = if damped <= -clearance {
            ContactState::Positive
        } else if damped >= clearance {
            ContactState::Negative
        } else {
            return ContactState::Gap;
        };
        let only = self.shared.and_then(|shared| shared.only_side(k));
        if only.is_none_or(|only| only == side) { side } else { ContactState::Gap }
    }

    fn states(&self, state: &DVector<f64>) -> Vec<ContactState> {
        (0..self.stiffness.len()).map(|k| self.state(state, k)).collect()
    }

    /// N_k = -kappa (g + delta g' + sigma clearance)
    fn force(&self, state: &DVector<f64>, k: usize) -> f64 {
        match self.state(state, k).side() {
            None => 0.0,
            Some(side) => -self.stiffness[k] * (self.damped(state, k) + side.sign() * self.clearance(k)),
        }
    }

    /// What acts where all gaps are closed: N(0) + sum d_k, and the forces of misalignment and clearance.
    fn load(&self, states: &[ContactState]) -> DVector<f64> {
        let mut load = self.problem.right_hand_side().clone();
        for (k, state) in states.iter().enumerate() {
            let jump = |side: Side| self.problem.jumps(side).column(k);
            match state.side() {
                Some(side) => load += jump(side),
                None => load += (jump(Side::Positive) + jump(Side::Negative)) / 2.0,
            }
        }
        let Some(shared) = self.shared else { return load };
        let closed = DVector::from_fn(states.len(), |k, _| {
            let sign = states[k].side().map_or(0.0, Side::sign);
            self.stiffness[k] * (shared.offset[k] + sign * shared.clearance[k])
        });
        (load + super::mode_matrix(self.problem, states) * closed).select_rows(&shared.kept)
    }

    fn steps_of(&self, states: &[ContactState]) -> Steps {
        let stiff = &self.mobility * self.stiff(states);
        let gaps = stiff.nrows();
        let load = self.load(states);
        let mut generator = DMatrix::zeros(2 * gaps + 1, 2 * gaps + 1);
        generator.view_mut((0, gaps), (gaps, gaps)).fill_with_identity();
        generator.view_mut((gaps, 0), (gaps, gaps)).copy_from(&-&stiff);
        generator.view_mut((gaps, gaps), (gaps, gaps)).copy_from(&(&stiff * -self.damping));
        generator.view_mut((gaps, 2 * gaps), (gaps, 1)).copy_from(&(&self.mobility * -load));
        let step = STEP / stiff.norm().sqrt();
        let mut powers = vec![exponential(&(generator * (step / f64::from(1 << HALVINGS))))];
        for _ in 0..HALVINGS + DOUBLINGS {
            let last = &powers[powers.len() - 1];
            powers.push(last * last);
        }
        powers.reverse();
        Steps { powers }
    }
}

/// g' of a state (g, g', 1).
fn rates(state: &DVector<f64>) -> DVector<f64> {
    let gaps = (state.len() - 1) / 2;
    state.rows(gaps, gaps).into_owned()
}

/// exp of a small matrix by its series.
fn exponential(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let mut sum = DMatrix::identity(matrix.nrows(), matrix.ncols());
    let mut term = sum.clone();
    for order in 1..=6 {
        term = &term * matrix / f64::from(order);
        sum += &term;
    }
    sum
}
