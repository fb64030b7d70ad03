//! Points that differ in coefficients of friction alone, very many at a time ([`crate::modes::batch`]).

use super::friction::FrictionFormulas;
use super::quantity::Kind;
use super::stages::Stages;
use crate::mechanism::{Contact, Mechanism};
use crate::modes::ContactState;
use crate::modes::batch::{BatchSolutions, BatchState, FrictionBatch};
use crate::modes::screen::{MOST_CONTACTS, SLACK, SmallState};
use crate::solve::influence_coefficients;

/// What solves points together: one mode problem for all of them, without jumps, whose coefficients of
/// friction are the same at both faces of each contact.
#[derive(Debug, Clone)]
pub(super) struct Together {
    batch: FrictionBatch,
    /// Contacts whose coefficient varies.
    contacts: Vec<usize>,
}

/// Points that are solved together.
pub(super) struct PointsFound<'t> {
    together: &'t Together,
    /// Coefficients of all points, for each varied contact.
    mu: Vec<Vec<f64>>,
    solutions: BatchSolutions,
    states: Vec<SmallState>,
    /// Where the states of each point begin.
    starts: Vec<usize>,
}

impl Together {
    /// None if the points differ in more, or may have more than their solutions.
    pub(super) fn new(
        mechanism: &Mechanism,
        stages: &Stages,
        formulas: &FrictionFormulas,
        varied: &[Kind],
    ) -> Option<Self> {
        if !mechanism.excess.is_empty()
            || mechanism.contacts.len() > MOST_CONTACTS
            || stages.signs.iter().any(|sign| *sign == 0.0)
        {
            return None;
        }
        let mut contacts = formulas.contacts_with_one_coefficient()?;
        if varied.contains(&Kind::Friction) {
            if mechanism.contacts.iter().any(|contact| contact.mu[0] != contact.mu[1]) {
                return None;
            }
            contacts = (0..mechanism.contacts.len()).collect();
        }
        let coefficients = influence_coefficients(mechanism, &stages.influence, &stages.signs);
        let batch =
            FrictionBatch::new(&coefficients, &contacts).ok()?.known_to(SLACK.max(stages.accuracy.part));
        (!batch.has_jump()).then_some(Self { batch, contacts })
    }

    /// Points whose friction is not known yet.
    pub(super) fn points(&self, count: usize) -> PointsFound<'_> {
        PointsFound {
            together: self,
            // What is not a number is left in doubt.
            mu: vec![vec![f64::NAN; count]; self.contacts.len()],
            solutions: BatchSolutions::default(),
            states: Vec::new(),
            starts: Vec::with_capacity(count + 1),
        }
    }
}

impl PointsFound<'_> {
    /// Takes the friction of a point from its contacts.
    pub(super) fn take_friction(&mut self, point: usize, contacts: &[Contact]) {
        for (mu, contact) in self.mu.iter_mut().zip(&self.together.contacts) {
            mu[point] = contacts[*contact].mu[0];
        }
    }

    /// Puts the friction of a point into its contacts.
    pub(super) fn put_friction(&self, point: usize, contacts: &mut [Contact]) {
        for (mu, contact) in self.mu.iter().zip(&self.together.contacts) {
            contacts[*contact].mu = [mu[point]; 2];
        }
    }

    /// Finds the states of all points.
    pub(super) fn solve(&mut self) {
        let friction: Vec<&[f64]> = self.mu.iter().map(Vec::as_slice).collect();
        let (states, starts) = (&mut self.states, &mut self.starts);
        let visit = |found: BatchState<'_>| {
            starts.resize(found.point + 1, states.len());
            states.push(state(found));
            in_order_of_enumeration(&mut states[starts[found.point]..]);
        };
        let solved = self.together.batch.solve_states(&friction, &mut self.solutions, visit);
        debug_assert_eq!(solved, Ok(()), "as many lists as contacts, of one length");
        let points = self.solutions.len();
        starts.resize(points + 1, states.len());
    }

    /// The states of a point in the order of enumeration; none if it is in doubt.
    pub(super) fn states(&self, point: usize) -> Option<&[SmallState]> {
        if self.solutions.is_in_doubt(point) {
            return None;
        }
        Some(&self.states[self.starts[point]..self.starts[point + 1]])
    }
}

fn state(found: BatchState<'_>) -> SmallState {
    let mut state = SmallState {
        pattern: [ContactState::Positive; MOST_CONTACTS],
        unknowns: [0.0; MOST_CONTACTS],
        negative_determinant: found.negative_determinant,
    };
    for (contact, y) in found.y.iter().enumerate() {
        state.unknowns[contact] = *y;
        if found.pattern >> contact & 1 == 1 {
            state.pattern[contact] = ContactState::Negative;
        }
    }
    state
}

/// Moves the last state to its place: the first contact counts most, and its positive side comes first.
fn in_order_of_enumeration(states: &mut [SmallState]) {
    let mut last = states.len().saturating_sub(1);
    let is_negative = |state: &SmallState| state.pattern.map(|side| side == ContactState::Negative);
    while last > 0 && is_negative(&states[last]) < is_negative(&states[last - 1]) {
        states.swap(last, last - 1);
        last -= 1;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

    use super::super::{RowKind, Rows, Sweep, SweepOptions};
    use crate::gallery;
    use crate::model::{Model, Settings};
    use std::ops::ControlFlow;

    /// All rows in one list, whatever the chunks in which they were computed.
    fn rows(sweep: &Sweep) -> Rows {
        let mut all = Vec::new();
        sweep.run(&mut sweep.start(), &Rows::clone, &mut |rows, _| {
            all.extend(rows);
            ControlFlow::Continue(())
        });
        let join = |mut all: Rows, more: Rows| {
            all.heads.extend(more.heads);
            all.numbers.extend(more.numbers);
            all.patterns.extend(more.patterns);
            all.refusals.extend(more.refusals);
            all
        };
        all.into_iter().reduce(join).unwrap()
    }

    /// A sweep, and whether its points are solved together.
    fn sweep(name: &str, parameter: (&str, &str), axes: &[&str]) -> (Sweep, bool) {
        let model = Model::parse(gallery::find(name).unwrap().text).unwrap();
        let model = model.with(&Settings::default().parameter(parameter.0, parameter.1)).unwrap();
        let sweep =
            Sweep::new(&model, &SweepOptions::grid(axes.iter().map(|axis| axis.parse().unwrap()))).unwrap();
        let together = sweep.plan.together.is_some();
        (sweep, together)
    }

    /// The oracle is the elimination of each point by itself, or `solve` where that is in doubt.
    #[test]
    fn rows_are_those_of_each_point_by_itself() {
        for (name, parameter, axes, least) in [
            ("klepp-2002", ("F_20", "0"), &["mu_1=0..0.8:1501"][..], 1000),
            ("klepp-2002", ("F_20", "0"), &["mu_1=0..0.8:31", "mu_2=0..0.5:23"], 700),
            ("klepp-2002", ("F_20", "0"), &["friction=0..9:901"], 600),
            // Preload at the pressed face: there may be gap states.
            ("klepp-2002", ("F_20", "m*g"), &["mu_1=0..0.8:101"], 0),
            ("drawer", ("mu", "0.3"), &["friction=0..4:801"], 400),
            ("drawer", ("Q", "5 N"), &["mu=0..1:801"], 400),
            ("painleve-klein", ("mu", "1"), &["mu=0..5:1001"], 600),
        ] {
            let (mut sweep, together) = sweep(name, parameter, axes);
            assert_eq!(together, least > 0, "{name} {axes:?}");
            let found = rows(&sweep);
            sweep.plan.together = None;
            let expected = rows(&sweep);
            let mut states = 0;
            assert_eq!((&found.heads, &found.patterns), (&expected.heads, &expected.patterns), "{name}");
            assert_eq!(found.refusals, expected.refusals);
            for row in 0..found.len() {
                let scale = expected.numbers(row).iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
                for (one, other) in found.numbers(row).iter().zip(expected.numbers(row)) {
                    let is_close = (one - other).abs() <= 1e-9 * scale || one.is_nan() && other.is_nan();
                    assert!(is_close, "{name} {axes:?}: {one} {other}");
                }
                states += usize::from(found.heads[row].kind == RowKind::Solution);
            }
            assert!(states > least, "{name} {axes:?}: {states} states");
        }
    }
}
