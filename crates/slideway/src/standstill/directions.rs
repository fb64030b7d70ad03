//! Which way every joint may begin to move: the signs that sliding and turning take over all motions.
//!
//! Of `n` motions that joints and drives leave, the signs of `m` joints are those of `m` linear functions on `R^n`: far
//! fewer than `3^m` of a closed loop, whose joints move together.

use super::TOLERANCE;
use super::setup::Setup;
use super::state::Pattern;
use crate::configuration::null_space;
use crate::pattern::{Affine, JointPhase, Region};
use nalgebra::{DMatrix, RowDVector};

/// The motions that go on from some joints' signs.
#[derive(Clone)]
struct Branch {
    signs: Vec<f64>,
    /// The motions in which every joint with the sign 0 is at rest, one in each column.
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

/// What joints and hinges do in some motion, their contacts left out; the motions are one in each column.
pub(super) fn directions(setup: &Setup, motions: &DMatrix<f64>) -> Vec<Pattern> {
    let rows = rows(setup);
    let mut branches = vec![Branch { signs: Vec::new(), motions: motions.clone() }];
    for joint in 0..rows.len() {
        let mut next = Vec::new();
        for branch in branches {
            next.extend(extended(&rows, joint, &branch));
        }
        branches = next;
    }
    let phase = |sign: &f64| if *sign == 0.0 { JointPhase::Sticking } else { JointPhase::Sliding(*sign) };
    let pattern = |branch: Branch| {
        let (joints, hinges) = branch.signs.split_at(setup.sliders.len());
        Pattern {
            joints: joints.iter().map(phase).collect(),
            hinges: hinges.iter().map(phase).collect(),
            contacts: Vec::new(),
        }
    };
    branches.into_iter().map(pattern).collect()
}

/// How sliders slide and hinges with friction turn with the motions of the bodies, in units in which motions are of order
/// one.
fn rows(setup: &Setup) -> Vec<RowDVector<f64>> {
    let equations = setup.equations_of_motion();
    let sliding = setup.sliders.iter().map(|slider| {
        let Some(&k) = slider.contacts.first() else { return RowDVector::zeros(equations) };
        let [positive, negative] = &setup.assembled.friction[k];
        RowDVector::from_fn(equations, |_, column| {
            -f64::midpoint(positive[column], negative[column]) / setup.units.length
        })
    });
    let turning = setup.mechanism.friction_circles.iter().map(|circle| {
        let mut row = RowDVector::zeros(equations);
        for (column, sign) in setup.couple(circle) {
            row[column] += sign;
        }
        row
    });
    sliding.chain(turning).collect()
}

/// The branches that the next joint's signs leave.
fn extended(rows: &[RowDVector<f64>], joint: usize, branch: &Branch) -> Vec<Branch> {
    let moves = &rows[joint] * &branch.motions;
    let with = |sign: f64, motions: DMatrix<f64>| {
        let signs = branch.signs.iter().copied().chain([sign]).collect();
        Branch { signs, motions }
    };
    let size = rows[joint].amax() * branch.motions.amax();
    if moves.iter().all(|value| value.abs() <= TOLERANCE * size) {
        return vec![with(0.0, branch.motions.clone())];
    }
    let still = &branch.motions * null_space(&DMatrix::from_rows(&[moves]));
    let options = [(0.0, still), (1.0, branch.motions.clone()), (-1.0, branch.motions.clone())];
    let next = options.into_iter().map(|(sign, motions)| with(sign, motions));
    next.filter(|next| is_possible(rows, next)).collect()
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
