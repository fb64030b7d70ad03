//! Right-hand sides that jump with the sides of contacts.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::blocks::{BlockProblem, BlockResult, search, search_turned};
use slideway_modes::{BySide, ContactState, Limits, ModeProblem, SearchOptions, enumerate};

use crate::support::{Numbers, assert_proven, assert_same};

struct Jumping {
    response: BySide<DMatrix<f64>>,
    jumps: BySide<DMatrix<f64>>,
    load: DVector<f64>,
}

impl Jumping {
    fn random(numbers: &mut Numbers, contacts: usize, hinges: usize, size: f64) -> Self {
        let (rows, columns) = (contacts + 2 * hinges, contacts + hinges);
        let positive = numbers.matrix(rows, columns) * size;
        let mut negative = positive.clone();
        negative.columns_mut(0, contacts).copy_from(&(numbers.matrix(rows, contacts) * size));
        let jumps =
            BySide { positive: numbers.matrix(rows, contacts), negative: numbers.matrix(rows, contacts) };
        Self { response: BySide { positive, negative }, jumps, load: numbers.vector(rows) }
    }

    fn solve(&self, angle: f64) -> BlockResult {
        let problem =
            BlockProblem::new(self.response.clone(), self.jumps.clone(), self.load.clone()).unwrap();
        let options = SearchOptions::default();
        let result = search_turned(&problem, &options, &mut |_| ControlFlow::Continue(()), angle);
        assert_proven(&result);
        result
    }

    /// The largest residual of the solutions, relative to the forces and the load.
    fn residual(&self, result: &BlockResult) -> f64 {
        let of = |solution: &slideway_modes::blocks::BlockSolution| {
            let mut rest = -&self.load;
            for (row, value) in solution.forces.iter().chain(solution.reactions.as_flattened()).enumerate() {
                rest[row] += value;
            }
            for (block, length) in solution.magnitudes.iter().enumerate() {
                let side = solution.states.get(block).and_then(|state| state.side());
                let response = self.response.get(side.unwrap_or(slideway_modes::Side::Positive));
                rest -= response.column(block) * *length;
            }
            for (contact, state) in solution.states.iter().enumerate() {
                let share = match state {
                    ContactState::Positive => 1.0,
                    ContactState::Negative => 0.0,
                    ContactState::Gap => {
                        solution.gaps.iter().find(|gap| gap.contact == contact).unwrap().lambda
                    }
                };
                rest -= self.jumps.positive.column(contact) * share;
                rest -= self.jumps.negative.column(contact) * (1.0 - share);
            }
            rest.amax() / solution.magnitudes.iter().fold(self.load.amax(), |most, value| most.max(*value))
        };
        result.solutions.iter().map(of).fold(0.0, f64::max)
    }
}

/// Without hinges, and with hinges without friction, the answer is that of every pattern.
#[test]
fn contacts_alone_have_the_states_of_every_pattern() {
    let mut numbers = Numbers(23);
    let mut gaps = 0;
    for round in 0..60 {
        let hinges = round % 2;
        let mut plain = Jumping::random(&mut numbers, 3, hinges, 0.8);
        plain.response.positive.columns_mut(3, hinges).fill(0.0);
        plain.response.negative.columns_mut(3, hinges).fill(0.0);
        let result = plain.solve(0.0);
        let part = |matrix: &DMatrix<f64>| matrix.view((0, 0), (3, 3)).into_owned();
        let one = DMatrix::identity(3, 3);
        let expected = ModeProblem::new(
            &one - part(&plain.response.positive),
            -one - part(&plain.response.negative),
            part(&plain.jumps.positive),
            part(&plain.jumps.negative),
            plain.load.rows(0, 3).into_owned(),
        );
        let expected = enumerate(&expected.unwrap(), &Limits::default()).unwrap();
        assert_eq!(result.solutions.len(), expected.solutions.len() + expected.gaps.len());
        let in_gap = result.solutions.iter().filter(|solution| !solution.gaps.is_empty());
        gaps += in_gap.count();
        for solution in &expected.solutions {
            let near = |found: &&slideway_modes::blocks::BlockSolution| {
                let pairs = found.forces.iter().zip(&solution.normal_force);
                pairs.into_iter().all(|(one, other)| (one - other).abs() <= 1e-9 * solution.y.amax())
            };
            assert!(result.solutions.iter().any(|found| near(&found)), "{:?}", solution.normal_force);
        }
        assert!(plain.residual(&result) <= 1e-12, "{}", plain.residual(&result));
    }
    assert!(gaps > 10, "{gaps}");
}

#[test]
fn with_hinges_the_answer_does_not_depend_on_the_first_division() {
    let mut numbers = Numbers(29);
    for _ in 0..12 {
        let plain = Jumping::random(&mut numbers, 2, 2, 0.5);
        let result = plain.solve(0.0);
        assert!(plain.residual(&result) <= 1e-12);
        assert_same(&result, &plain.solve(0.3));
    }
}

/// Both contacts of a block share its preload: with both in their gaps their columns are the same, so that the slopes are
/// singular whatever the directions. Eight equations are left for seven unknowns, which no generic load satisfies: few nodes
/// prove that.
#[test]
fn both_contacts_of_a_block_in_their_gaps_are_excluded_in_few_nodes() {
    let mut numbers = Numbers(37);
    for round in 0..40 {
        let mut plain = Jumping::random(&mut numbers, 2, 2, 0.3);
        for jumps in [&mut plain.jumps.positive, &mut plain.jumps.negative] {
            let column = jumps.column(0).into_owned();
            jumps.set_column(1, &column);
        }
        let problem =
            BlockProblem::new(plain.response.clone(), plain.jumps.clone(), plain.load.clone()).unwrap();
        let options = SearchOptions::within(Some(5_000), None);
        let result = search(&problem, &options, &mut |_| ControlFlow::Continue(()));
        assert_eq!((result.stopped, result.open.len()), (None, 0), "round {round}, {} nodes", result.nodes);
        let is_in_gap = |state: &ContactState| *state == ContactState::Gap;
        assert!(result.solutions.iter().all(|solution| !solution.states.iter().all(is_in_gap)));
        assert!(plain.residual(&result) <= 1e-12);
    }
}

#[test]
fn a_search_ends_when_it_is_told_to() {
    let plain = Jumping::random(&mut Numbers(31), 3, 3, 1.0);
    let problem = BlockProblem::new(plain.response, plain.jumps, plain.load).unwrap();
    let result = search(&problem, &SearchOptions::within(Some(3), None), &mut |_| ControlFlow::Continue(()));
    assert_eq!((result.nodes, result.stopped), (3, Some(slideway_modes::StopReason::NodeLimit)));
    assert_eq!(result.complete, slideway_modes::Proof::NotProven);
}

/// Contact 0 acts on none, and contact 1 alone feels its jump, of 1 or -1: with a force of either sign that is known, and
/// without force it may rest anywhere in its gap.
#[test]
fn a_jump_that_only_a_contact_without_friction_feels() {
    let jump = |value: f64| dmatrix![0.0, 0.0; value, 0.0; 0.0, 0.0; 0.0, 0.0];
    let response = dmatrix![0.0, 0.0, 0.0; 0.0, 0.0, 0.3; 0.0, 0.0, 2.0; 0.0, 0.0, 0.0];
    let with_force = |force: f64| Jumping {
        response: BySide::same(response.clone()),
        jumps: BySide { positive: jump(1.0), negative: jump(-1.0) },
        load: dvector![force, 5.0, -1.0, 0.0],
    };
    // R = -1 + 2 |R|: -1/3, of |R| = 1/3, and 1.
    for force in [4.0, -4.0] {
        let result = with_force(force).solve(0.0);
        let forces: Vec<f64> = result.solutions.iter().map(|solution| solution.forces[1]).collect();
        assert_eq!(forces.len(), 2);
        assert!((forces.iter().sum::<f64>() - (10.0 + 2.0 * force.signum() + 0.3 * 4.0 / 3.0)).abs() < 1e-12);
    }
    let Jumping { response, jumps, load } = with_force(0.0);
    let problem = BlockProblem::new(response, jumps, load).unwrap();
    let result = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
    assert_eq!(result.complete, slideway_modes::Proof::NotProven);
}
