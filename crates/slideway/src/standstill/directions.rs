//! Which way every joint may begin to move: the signs that sliding and turning take over all motions.
//!
//! Of `n` motions that joints and drives leave, the signs of `m` joints are those of `m` linear functions on `R^n`: far
//! fewer than `3^m` of a closed loop, whose joints move together.

use super::TOLERANCE;
use super::setup::Setup;
use super::state::Pattern;
use crate::configuration::null_space;
use crate::pattern::{Affine, JointPhase, Region};
use nalgebra::{DMatrix, DVector, RowDVector};

/// The motions that go on from some joints' signs: `start` and any combination of the columns of `motions`.
#[derive(Clone)]
struct Branch {
    signs: Vec<f64>,
    /// A motion in which every joint with the sign 0 is at rest; zero unless velocities decide of accelerations.
    start: DVector<f64>,
    /// What may be added to it, one in each column.
    motions: DMatrix<f64>,
    /// Joints that none of the motions moves at once, and that begin to move later: at a dead centre.
    later: Vec<usize>,
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

/// What joints and hinges do in some motion, their contacts left out; the motions are one in each column. Those whose
/// velocities are known do what these say, and the accelerations of the others decide; with `later`, those that no motion
/// moves at once may begin in either direction.
pub(super) fn directions(setup: &Setup, motions: &DMatrix<f64>, later: bool) -> Vec<Pattern> {
    let rows = rows(setup);
    let pushed = (0..rows.len()).filter(|joint| setup.known[*joint].pushed);
    let all = (acceleration_of_velocities(setup), motions.clone());
    let (start, motions) = pushed.fold(all, |(start, motions), joint| rows[joint].held(&start, &motions));
    let mut branches = vec![Branch { signs: Vec::new(), start, motions, later: Vec::new() }];
    for joint in 0..rows.len() {
        let mut next = Vec::new();
        for branch in branches {
            next.extend(extended(&rows, joint, (&branch, later)));
        }
        next.retain(|branch: &Branch| !rows[joint].is_into_stop(branch.signs[joint]));
        branches = next;
    }
    let phase = |sign: &f64| JointPhase::of_sign(*sign);
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

/// How a sliding joint or a hinge with friction moves with the bodies, in units in which motions are of order one.
struct Row {
    of_motion: RowDVector<f64>,
    /// What velocities add where motions are accelerations.
    of_velocities: f64,
    /// The sign of the velocity, 0 where it has to stick; nothing where the acceleration decides.
    sign: Option<f64>,
    /// The end stop that a sliding joint touches: 1 at its greatest displacement, -1 at its least, otherwise 0.
    stop: f64,
}

impl Row {
    fn at(&self, motion: &DVector<f64>) -> f64 {
        (&self.of_motion * motion)[0] + self.of_velocities
    }

    /// Whether it would begin to slide into its stop.
    fn is_into_stop(&self, sign: f64) -> bool {
        self.sign.is_none() && self.stop != 0.0 && sign == self.stop
    }

    /// Those of the motions that leave it at rest, or prescribe its acceleration: where they begin, and what may be added.
    /// All of them if none moves it.
    fn held(&self, start: &DVector<f64>, motions: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let moves = &self.of_motion * motions;
        if moves.amax() <= TOLERANCE * self.of_motion.amax() * motions.amax() {
            return (start.clone(), motions.clone());
        }
        let start = start - motions * moves.transpose() * (self.at(start) / moves.norm_squared());
        (start, motions * null_space(&DMatrix::from_rows(&[moves])))
    }
}

fn rows(setup: &Setup) -> Vec<Row> {
    let row = |joint: usize| {
        let length = if joint < setup.sliders.len() { setup.units.length } else { 1.0 };
        let unit = setup.units.acceleration * length / setup.units.length;
        let known = setup.known[joint];
        Row {
            of_motion: setup.row(joint) / length,
            of_velocities: known.acceleration / unit,
            sign: known.sign,
            stop: setup.stops.get(joint).copied().unwrap_or(0.0),
        }
    };
    (0..setup.known.len()).map(row).collect()
}

/// Accelerations that joints and drives ask for at the velocities of the bodies, in units of those in a size of the
/// mechanism.
fn acceleration_of_velocities(setup: &Setup) -> DVector<f64> {
    let (equations, rows) = (setup.equations_of_motion(), setup.assembled.layout.len());
    let wanted = setup.assembled.load.rows(equations, rows - equations).into_owned();
    if wanted.iter().all(|value| *value == 0.0) {
        return DVector::zeros(equations);
    }
    let joints = setup.assembled.matrix.view((equations, 0), (rows - equations, equations)).into_owned();
    let found = joints.svd(true, true).solve(&wanted, TOLERANCE).expect("both sets of vectors are computed");
    found * (setup.units.length / setup.units.acceleration)
}

/// The branches that the next joint's signs leave: the one that is known, or all.
fn extended(rows: &[Row], joint: usize, (branch, later): (&Branch, bool)) -> Vec<Branch> {
    let known = rows[joint].sign;
    let with = |sign: f64, start: DVector<f64>, motions: DMatrix<f64>| {
        let signs = branch.signs.iter().copied().chain([sign]).collect();
        Branch { signs, start, motions, later: branch.later.clone() }
    };
    let as_before = |sign: f64| with(sign, branch.start.clone(), branch.motions.clone());
    if let Some(sign) = known.filter(|sign| *sign != 0.0) {
        return vec![as_before(sign)];
    }
    let (moves, begins) = (&rows[joint].of_motion * &branch.motions, rows[joint].at(&branch.start));
    let size = rows[joint].of_motion.amax() * branch.motions.amax();
    if moves.iter().all(|value| value.abs() <= TOLERANCE * size) {
        if known.is_none() && begins.abs() > TOLERANCE * branch.start.amax().max(1.0) {
            return vec![as_before(begins.signum())];
        }
        let mut next = vec![as_before(0.0)];
        if later && known.is_none() && branch.motions.ncols() > 0 {
            next.extend([1.0, -1.0].map(as_before));
            next[1..].iter_mut().for_each(|later| later.later.push(joint));
        }
        return next;
    }
    let (start, motions) = rows[joint].held(&branch.start, &branch.motions);
    let still = with(0.0, start, motions);
    if known.is_some() {
        return vec![still];
    }
    let next = [still, as_before(1.0), as_before(-1.0)].into_iter();
    next.filter(|next| is_possible(rows, next)).collect()
}

/// Whether some motion has all the signs; where the linear program is not solved, it may.
fn is_possible(rows: &[Row], branch: &Branch) -> bool {
    let moving = rows.iter().zip(&branch.signs).enumerate();
    let moving = moving
        .filter(|(joint, (row, sign))| row.sign.is_none() && **sign != 0.0 && !branch.later.contains(joint));
    let slack = |(_, (row, sign)): (usize, (&Row, &f64))| Affine {
        coefficients: (&row.of_motion * &branch.motions).iter().map(|value| sign * value).collect(),
        constant: sign * row.at(&branch.start),
    };
    let highest = Region::new(branch.motions.ncols(), moving.map(slack).collect()).highest();
    highest.map_or(true, |(slack, _)| slack > TOLERANCE)
}
