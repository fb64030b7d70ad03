//! Contacts that share a load: the same problem as contacts alone, for another search.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};
use slideway_modes::blocks::{BlockProblem, BlockResult, search};
use slideway_modes::{
    BySide, ContactState, InfluenceCoefficients, Limits, ModeProblem, SearchOptions, SharedLoad, Side,
    enumerate,
};

use crate::support::{Numbers, assert_proven};

const CONTACTS: usize = 4;
/// How many of them are cut.
const CUT: usize = 2;

/// Four contacts of which the last two are cut; rigid faces have no compliance.
fn shared(numbers: &mut Numbers, is_rigid: bool) -> SharedLoad {
    let free = numbers.matrix(CONTACTS - CUT, CUT);
    let positive = |numbers: &mut Numbers| DVector::from_fn(CONTACTS, |_, _| 0.6 + 0.4 * numbers.next());
    SharedLoad {
        cut: (CONTACTS - CUT..CONTACTS).collect(),
        self_stress: DMatrix::from_fn(CONTACTS, CUT, |row, stress| match row.checked_sub(CONTACTS - CUT) {
            None => free[(row, stress)],
            Some(cut) => f64::from(u8::from(cut == stress)),
        }),
        compliance: if is_rigid { DVector::zeros(CONTACTS) } else { positive(numbers) * 1e-5 },
        clearance: positive(numbers) * 1e-4,
        misalignment: numbers.vector(CONTACTS) * 0.2e-4,
        press_fits: Vec::new(),
    }
}

/// What friction of each contact adds in each row, on either side: nothing in those of the cut ones.
fn friction(numbers: &mut Numbers) -> BySide<DMatrix<f64>> {
    let mut side = || {
        let mut response = numbers.matrix(CONTACTS, CONTACTS) * 0.5;
        response.rows_mut(CONTACTS - CUT, CUT).fill(0.0);
        response
    };
    BySide { positive: side(), negative: side() }
}

fn as_contacts(friction: &BySide<DMatrix<f64>>, load: &DVector<f64>, shared: &SharedLoad) -> ModeProblem {
    ModeProblem::from_influence(&InfluenceCoefficients {
        eta: friction.clone(),
        eta_preload: friction.clone(),
        mu: BySide::same(DVector::from_element(CONTACTS, 1.0)),
        preload: BySide::same(DVector::zeros(CONTACTS)),
        velocity_signs: DVector::from_element(CONTACTS, 1.0),
        frictionless: load.clone(),
        shared: Some(shared.clone()),
        one_sided: vec![],
        turning: vec![],
    })
    .unwrap()
}

fn as_blocks(friction: &BySide<DMatrix<f64>>, load: &DVector<f64>, shared: &SharedLoad) -> BlockResult {
    let matrix = |entry: &dyn Fn(usize, usize) -> f64| DMatrix::from_fn(CONTACTS, CONTACTS, entry);
    let response = |side: Side| matrix(&|row, k| shared.response(side, row, k, friction.get(side)[(row, k)]));
    let jumps = |side: Side| matrix(&|row, k| shared.jump(side, row, k, 0.0));
    let by_side = |part: &dyn Fn(Side) -> DMatrix<f64>| BySide {
        positive: part(Side::Positive),
        negative: part(Side::Negative),
    };
    let load = DVector::from_fn(CONTACTS, |row, _| shared.load(row, load[row]));
    let problem = BlockProblem::new(by_side(&response), by_side(&jumps), load).unwrap();
    search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()))
}

/// Every pattern by itself finds the states that the search of blocks finds, which proves them all: elastic faces, and
/// rigid ones, of which no pattern with more closed contacts than statics needs is regular.
#[test]
fn contacts_that_share_a_load_are_blocks_whose_response_changes_its_sign() {
    let mut numbers = Numbers(2026);
    let mut open = 0;
    for round in 0..120 {
        let shared = shared(&mut numbers, round % 3 == 0);
        let (friction, mut load) = (friction(&mut numbers), numbers.vector(CONTACTS) * 10.0);
        load.rows_mut(CONTACTS - CUT, CUT).fill(0.0);
        let result = as_blocks(&friction, &load, &shared);
        assert_proven(&result);
        let expected = enumerate(&as_contacts(&friction, &load, &shared), &Limits::default()).unwrap();
        let in_gap = expected.gaps.iter().map(|state| state.normal_force.clone());
        let pressed = expected.solutions.iter().map(|solution| solution.normal_force.clone());
        let expected: Vec<DVector<f64>> = pressed.chain(in_gap).collect();
        assert_eq!(result.solutions.len(), expected.len(), "{round}");
        for solution in &result.solutions {
            let forces = DVector::from_column_slice(&solution.forces);
            let near = |other: &DVector<f64>| (other - &forces).amax() <= 1e-9 * forces.amax();
            assert!(expected.iter().any(near), "{round}: {forces} is not among {expected:?}");
            open += usize::from(solution.states.contains(&ContactState::Gap));
        }
    }
    assert!(open > 60, "{open}");
}
