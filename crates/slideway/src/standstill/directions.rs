//! Which way every joint may begin to move: the signs that sliding and turning take over all motions. Of contacts that may
//! lift off each set of open ones leaves motions of its own, those that open all their gaps.
//!
//! Of `n` motions that joints and drives leave, the signs of `m` joints are those of `m` linear functions on `R^n`: far
//! fewer than `3^m` of a closed loop, whose joints move together.

use super::TOLERANCE;
use super::held_motions;
use super::setup::Setup;
use super::state::Pattern;
use crate::configuration::null_space;
use crate::pattern::{Affine, JointPhase, Region};
use nalgebra::{DMatrix, RowDVector};

/// How joints may begin to move together.
pub(super) struct Direction {
    /// What joints and hinges do; its contacts are left out. A joint that lifts off as a whole sticks.
    pub(super) signs: Pattern,
    /// The contacts that lift off.
    pub(super) open: Vec<usize>,
}

/// The motions that go on from some joints' signs: any combination of the columns of `motions`.
#[derive(Clone)]
struct Branch {
    signs: Vec<f64>,
    /// Motions in which every joint with the sign 0 is at rest, one in each column.
    motions: DMatrix<f64>,
}

/// No more signs than these are those of so many joints over so many motions: `sum_i C(joints, i) 2^i` for `i` up to the
/// number of motions, each sign vector being that of a motion which `i` independent joints determine.
pub(super) fn most_directions(motions: usize, joints: usize) -> u64 {
    let mut term = 1_u64;
    let mut sum = 1_u64;
    for i in 0..motions.min(joints) {
        term = term.saturating_mul(2 * (joints - i) as u64) / (i as u64 + 1);
        sum = sum.saturating_add(term);
    }
    sum
}

/// What joints and hinges do in some motion, with every set of contacts that may lift off.
pub(super) fn directions(setup: &Setup) -> Vec<Direction> {
    openings(setup).into_iter().flat_map(|open| directions_while(setup, &open)).collect()
}

/// All sets of contacts that may lift off together, the empty one first.
fn openings(setup: &Setup) -> Vec<Vec<usize>> {
    let with = |sets: Vec<Vec<usize>>, contact: usize| {
        let larger: Vec<Vec<usize>> =
            sets.iter().map(|set| set.iter().copied().chain([contact]).collect()).collect();
        [sets, larger].concat()
    };
    setup.one_sided().into_iter().fold(vec![Vec::new()], with)
}

/// What joints and hinges do in some motion in which these contacts lift off.
fn directions_while(setup: &Setup, open: &[usize]) -> Vec<Direction> {
    let mut rows = rows(setup);
    for (slider, row) in setup.sliders.iter().zip(&mut rows) {
        // What lifts off as a whole has no friction that a direction decides.
        if !slider.contacts.is_empty() && slider.contacts.iter().all(|contact| open.contains(contact)) {
            row.fill(0.0);
        }
    }
    let moving = rows.len();
    rows.extend(open.iter().map(|&k| setup.gap_row(k) / setup.units.length));
    let mut branches = vec![Branch { signs: Vec::new(), motions: held_motions(setup, open) }];
    for (index, row) in rows.iter().enumerate() {
        branches = branches.iter().flat_map(|branch| extended(&rows, row, branch)).collect();
        branches.retain(|branch| index < moving || branch.signs[index] > 0.0);
    }
    let phase = |sign: &f64| JointPhase::of_sign(*sign);
    let direction = |branch: Branch| {
        let (joints, hinges) = branch.signs[..moving].split_at(setup.sliders.len());
        let signs = Pattern {
            joints: joints.iter().map(phase).collect(),
            hinges: hinges.iter().map(phase).collect(),
            contacts: Vec::new(),
        };
        Direction { signs, open: open.to_vec() }
    };
    branches.into_iter().map(direction).collect()
}

/// How each sliding joint and hinge with friction moves with the bodies, in units in which motions are of order one.
fn rows(setup: &Setup) -> Vec<RowDVector<f64>> {
    let sliders = setup.sliders.len();
    let lever = |joint: usize| joint.checked_sub(sliders).map_or(1.0, |circle| setup.lever(circle));
    let row = |joint: usize| setup.row(joint) / (setup.units.length / lever(joint));
    (0..sliders + setup.mechanism.friction_circles.len()).map(row).collect()
}

/// The branches that the next joint's signs leave.
fn extended(rows: &[RowDVector<f64>], row: &RowDVector<f64>, branch: &Branch) -> Vec<Branch> {
    let with = |sign: f64, motions: DMatrix<f64>| {
        let signs = branch.signs.iter().copied().chain([sign]).collect();
        Branch { signs, motions }
    };
    let moves = row * &branch.motions;
    if moves.iter().all(|value| value.abs() <= TOLERANCE * row.amax() * branch.motions.amax()) {
        return vec![with(0.0, branch.motions.clone())];
    }
    let still = with(0.0, &branch.motions * null_space(&DMatrix::from_rows(&[moves])));
    let next = [still, with(1.0, branch.motions.clone()), with(-1.0, branch.motions.clone())];
    next.into_iter().filter(|next| is_possible(rows, next)).collect()
}

/// Whether some motion has all the signs; where the linear program is not solved, it may.
fn is_possible(rows: &[RowDVector<f64>], branch: &Branch) -> bool {
    let moving = rows.iter().zip(&branch.signs).filter(|(_, sign)| **sign != 0.0);
    let slack = |(row, sign): (&RowDVector<f64>, &f64)| Affine {
        coefficients: (row * &branch.motions).iter().map(|value| sign * value).collect(),
        constant: 0.0,
    };
    let highest = Region::new(branch.motions.ncols(), moving.map(slack).collect()).highest();
    highest.map_or(true, |(slack, _)| slack > TOLERANCE)
}
