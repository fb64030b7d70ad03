//! Problems of groups of contacts: right-hand sides that follow from the solutions of other groups, with
//! bounds on their errors.

use nalgebra::{DMatrix, DVector};

use crate::certificate::{Decision, ExactOutcome, ExactSet, decide_while, solve_exactly};
use crate::interval::{Interval, Sign};
use crate::problem::{BySide, Column, ContactState, ModeProblem, ProblemView, Radii, Side};

/// The maximum number of contacts that are decided together in rational numbers.
const JOINT_CONTACTS: usize = 48;

/// A right-hand side known within `radius`, row by row.
#[derive(Debug, Clone)]
pub(super) struct Load {
    pub(super) middle: DVector<f64>,
    pub(super) radius: DVector<f64>,
    /// The contacts whose forces it includes, and their states.
    ancestors: Vec<(usize, ContactState)>,
}

/// The equations of some contacts, within bounds.
#[derive(Debug, Clone)]
pub(super) struct LoadedProblem<'p> {
    whole: ProblemView<'p>,
    contacts: &'p [usize],
    ancestors: &'p [(usize, ContactState)],
    problem: ModeProblem,
    /// `None` if all numbers are exact.
    radii: Option<Radii>,
    exact: bool,
}

impl Load {
    /// The right-hand side of a problem as given.
    pub(super) fn of(problem: ProblemView<'_>) -> Self {
        let middle = problem.centre.right_hand_side().clone();
        let radius =
            problem.radii.map_or_else(|| DVector::zeros(middle.len()), |radii| radii.right_hand_side.clone());
        Self { middle, radius, ancestors: Vec::new() }
    }

    /// Adds `d_k - c_k y_k` of a contact, for all `y_k` within bounds.
    pub(super) fn add_contact(
        &mut self,
        problem: ProblemView<'_>,
        contact: usize,
        state: ContactState,
        y: (f64, f64),
    ) {
        // The contacts that a jump reaches are in the contact's own group: elsewhere both sides are equal.
        let side = state.side().unwrap_or(Side::Negative);
        self.add(problem.jump(contact, side), (1.0, 0.0));
        if state != ContactState::Gap {
            self.add(problem.column(contact, side), (-y.0, y.1));
        }
        self.ancestors.push((contact, state));
    }

    /// Whether all bounds are finite.
    pub(super) fn is_finite(&self) -> bool {
        self.middle.iter().chain(&self.radius).all(|value| value.is_finite())
    }

    /// Widens the bounds by what a contact that may have changed to `side` adds, with `y_k` up to `most`.
    pub(super) fn add_doubt(&mut self, problem: ProblemView<'_>, contact: usize, side: Side, most: f64) {
        self.add(problem.column(contact, side), (0.0, most));
    }

    /// Adds a multiple of a column, and bounds on the effect of errors of the factor and the column and of
    /// rounding.
    fn add(&mut self, column: Column<'_>, (factor, factor_radius): (f64, f64)) {
        for (row, &entry) in column.centre.iter().enumerate() {
            let spread = column.radius.map_or(0.0, |radius| radius[row]);
            if entry == 0.0 && spread == 0.0 {
                continue;
            }
            let term = factor * entry;
            let before = self.middle[row].abs();
            self.middle[row] += term;
            // Twice the unit roundoff of each operation, which also covers the rounding of this bound.
            let rounding = 4.0 * f64::EPSILON * (before + term.abs() + f64::MIN_POSITIVE);
            let off = factor_radius * entry.abs() + spread * (factor.abs() + factor_radius);
            self.radius[row] += off * (1.0 + 8.0 * f64::EPSILON) + rounding;
            self.radius[row] = self.radius[row].next_up();
        }
    }
}

impl<'p> LoadedProblem<'p> {
    /// The equations and columns of only some contacts, with a finite load.
    pub(super) fn restricted(whole: ProblemView<'p>, contacts: &'p [usize], load: &'p Load) -> Self {
        let problem = whole.centre.restricted(contacts, &load.middle);
        let radii = Self::radii(whole, contacts, load);
        let exact = whole.exact && contacts.iter().all(|&contact| load.radius[contact] == 0.0);
        Self { whole, contacts, ancestors: &load.ancestors, problem, radii, exact }
    }

    fn radii(whole: ProblemView<'_>, contacts: &[usize], load: &Load) -> Option<Radii> {
        let size = contacts.len();
        let right_hand_side = DVector::from_fn(size, |row, _| load.radius[contacts[row]]);
        let by_side = |part: &dyn Fn(&Radii, Side) -> DMatrix<f64>| {
            BySide::of(|side| {
                whole.radii.map_or_else(|| DMatrix::zeros(size, size), |radii| part(radii, side))
            })
        };
        let radii = Radii {
            columns: by_side(&|radii, side| submatrix(radii.columns.get(side), contacts)),
            jumps: by_side(&|radii, side| submatrix(radii.jumps.get(side), contacts)),
            right_hand_side,
        };
        (!radii.are_zero()).then_some(radii)
    }

    pub(super) fn view(&self) -> ProblemView<'_> {
        ProblemView { centre: &self.problem, radii: self.radii.as_ref(), exact: self.exact }
    }

    /// Whether this is part of a problem with exact numbers, so that every pattern can be decided.
    pub(super) fn is_part_of_exact_problem(&self) -> bool {
        self.whole.exact
    }

    /// The maximum error of each entry of the right-hand side of any pattern, compared with
    /// `N(0) + sum_k d_k`.
    pub(super) fn right_hand_side_radius(&self) -> DVector<f64> {
        let view = self.view();
        let load = view.load();
        DVector::from_fn(view.contacts(), |row, _| {
            let radius = |column: Column<'_>| column.radius.map_or(0.0, |radius| radius[row]);
            let jumps = (0..view.contacts()).map(|contact| {
                let [one, other] = Side::BOTH.map(|side| view.jump(contact, side));
                radius(one).max(radius(other))
            });
            (radius(load) + jumps.sum::<f64>()) * (1.0 + 4.0 * f64::EPSILON * (view.contacts() + 2) as f64)
        })
    }

    /// Decides a pattern in exact numbers, together with the contacts that determine the right-hand side.
    /// `None` if there are too many contacts, or once `proceed` is `false`.
    pub(super) fn decide_jointly(
        &self,
        pattern: &[ContactState],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Decision> {
        let upstream = self.ancestors.len();
        if upstream + pattern.len() > JOINT_CONTACTS {
            return None;
        }
        let ancestors = self.ancestors.iter().map(|(contact, _)| *contact);
        let contacts: Vec<usize> = ancestors.chain(self.contacts.iter().copied()).collect();
        let states = self.ancestors.iter().map(|(_, state)| *state);
        let joint_pattern: Vec<ContactState> = states.chain(pattern.iter().copied()).collect();
        let problem = self.whole.centre.restricted(&contacts, self.whole.centre.right_hand_side());
        let own_sign = || match solve_exactly(&self.problem, pattern, 0) {
            ExactOutcome::Regular { determinant, .. } => determinant,
            ExactOutcome::Singular(_) => Sign::Zero,
        };
        let decision = decide_while((&problem).into(), &joint_pattern, proceed)?.decision;
        Some(match without_first(decision, upstream) {
            Decision::Solution { unknowns, .. } => Decision::Solution { unknowns, determinant: own_sign() },
            Decision::Boundary { unknowns, zero, full_share, .. } => {
                Decision::Boundary { unknowns, zero, full_share, determinant: own_sign() }
            }
            other => other,
        })
    }
}

fn submatrix(matrix: &DMatrix<f64>, contacts: &[usize]) -> DMatrix<f64> {
    let size = contacts.len();
    DMatrix::from_fn(size, size, |row, column| matrix[(contacts[row], contacts[column])])
}

/// The decision for all contacts but the first ones, which have a solution of their own.
fn without_first(decision: Decision, first: usize) -> Decision {
    let later = |contacts: Vec<usize>| -> Vec<usize> {
        contacts.into_iter().filter_map(|contact| contact.checked_sub(first)).collect()
    };
    match decision {
        Decision::Solution { unknowns, determinant } => {
            Decision::Solution { unknowns: unknowns[first..].to_vec(), determinant }
        }
        Decision::NoSolution { contact } => Decision::NoSolution { contact: contact.saturating_sub(first) },
        Decision::Boundary { unknowns, zero, full_share, determinant } => {
            let (zero, full_share) = (later(zero), later(full_share));
            let unknowns = unknowns[first..].to_vec();
            if zero.is_empty() && full_share.is_empty() {
                Decision::Solution { unknowns, determinant }
            } else {
                Decision::Boundary { unknowns, zero, full_share, determinant }
            }
        }
        Decision::Singular { set: ExactSet::Product(parts) } => {
            let later = parts.into_iter().filter_map(|part| part.starting_at(first)).collect();
            Decision::Singular { set: ExactSet::Product(later) }
        }
        Decision::Singular { set } => Decision::Singular { set: set.map(&|point| point[first..].to_vec()) },
        Decision::Undecided { unknowns, in_doubt } => Decision::Undecided {
            unknowns: unknowns.map(|all: Vec<Interval>| all[first..].to_vec()),
            in_doubt: later(in_doubt),
        },
    }
}
