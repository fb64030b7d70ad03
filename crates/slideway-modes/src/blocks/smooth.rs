//! Blocks without friction: they act on no other, so that their forces follow from those of the others.
//!
//! In the search they would only add equations that exclude nothing, and rounding.

use super::equations::load;
use super::open::Undecided;
use super::parts::{embed, part};
use super::problem::BlockProblem;
use super::result::OpenLabel;
use super::tree::Found;
use super::zero::{Zero, prove};
use crate::certificate::Sign;
use crate::interval::{Interval, Real};
use crate::problem::{ContactState, Side};

/// The blocks that act on any or jump, and the problem of them alone; `None` if there are no others.
pub(super) fn part_with_friction(problem: &BlockProblem) -> Option<(Vec<usize>, BlockProblem)> {
    let jumps = |block: usize| block < problem.contacts() && problem.has_jump(block);
    let rough: Vec<usize> =
        (0..problem.blocks()).filter(|&block| problem.has_friction(block) || jumps(block)).collect();
    if rough.len() == problem.blocks() {
        return None;
    }
    let alone = part(problem, &rough);
    Some((rough, alone))
}

/// What was found for the rough blocks alone, with the forces of the others: `x = b + d + H w`.
///
/// The matrix of slopes is triangular in the blocks, with ones in the rows of the smooth blocks: its determinant is that
/// of the rough ones.
pub(super) fn with_smooth_blocks(problem: &BlockProblem, rough: &[usize], found: Found) -> Found {
    let mut all = embed(problem, rough, found, Some(Sign::Positive));
    let smooth = (0..problem.blocks()).filter(|block| !rough.contains(block));
    let rows: Vec<usize> = smooth.flat_map(|block| problem.rows_of(block)).collect();
    for mut zero in std::mem::take(&mut all.zeros) {
        if tell_sides(problem, &mut zero) {
            add_forces(problem, rough, &rows, &mut zero);
            all.zeros.push(zero);
        } else {
            all.undecided.push(Undecided::at(&zero, OpenLabel::Boundary));
        }
    }
    for open in &mut all.undecided {
        let load = load::<f64>(problem, &open.piece.states);
        let unknowns: Vec<Interval> = open.point.iter().copied().map(Interval::point).collect();
        for &row in &rows {
            let is_direction = open.label == OpenLabel::LockingDirection;
            let share = if is_direction { 0.0 } else { load[row] };
            open.point[row] = share + effect(problem, rough, &open.piece.states, &unknowns, row).middle();
        }
    }
    all
}

/// Tells the sides of contacts that jump on smooth blocks only, of which the problem without them knows nothing; `false` if one
/// may rest in its gap.
fn tell_sides(problem: &BlockProblem, zero: &mut Zero) -> bool {
    (0..problem.contacts()).filter(|&contact| problem.has_jump(contact)).all(|contact| {
        zero.states[contact] = zero.states[contact].or_else(|| pressed(zero.enclosure[contact]));
        zero.states[contact].is_some()
    })
}

/// The side on which a contact with a force within bounds is pressed; `None` if that is not certain.
fn pressed(force: Interval) -> Option<ContactState> {
    match force.sign() {
        Some(Sign::Positive) => Some(ContactState::Positive),
        Some(Sign::Negative) => Some(ContactState::Negative),
        _ => None,
    }
}

/// Adds the forces of the smooth blocks to a zero. Of problems within bounds a proof for all equations at once bounds them more
/// narrowly, as it keeps how the others depend on each other.
fn add_forces(problem: &BlockProblem, rough: &[usize], rows: &[usize], zero: &mut Zero) {
    let load = load::<Interval>(problem, &zero.states);
    for &row in rows {
        zero.enclosure[row] = load[row] + effect(problem, rough, &zero.states, &zero.enclosure, row);
        zero.point[row] = zero.enclosure[row].middle();
        zero.isolation[row] = Interval::REAL_LINE;
    }
    if problem.relative_radius() == 0.0 {
        return;
    }
    let is_same = |narrow: &Zero| {
        narrow.isolation.iter().zip(&zero.enclosure).all(|(outer, inner)| outer.encloses(*inner))
    };
    if let Some(narrow) = prove(problem, &zero.states, &zero.point).filter(is_same) {
        for &row in rows {
            let both = zero.enclosure[row].intersection(narrow.enclosure[row]);
            zero.enclosure[row] = both.unwrap_or(zero.enclosure[row]);
            zero.point[row] = zero.enclosure[row].middle();
        }
    }
}

/// A row of `H w`, and of a contact in its gap with the share `lambda` the part `lambda (d^+ - d^-)` of its jump: of all
/// unknowns within bounds.
fn effect(
    problem: &BlockProblem,
    blocks: &[usize],
    states: &[Option<ContactState>],
    unknowns: &[Interval],
    row: usize,
) -> Interval {
    let of_contact = |contact: usize| {
        let on_side = |side: Side| problem.response(side).entry(row, contact);
        let jump = |side: Side| problem.jumps(side).entry(row, contact);
        let value = unknowns[contact];
        match states[contact].or_else(|| pressed(value)) {
            Some(ContactState::Positive) => on_side(Side::Positive) * value,
            Some(ContactState::Negative) => on_side(Side::Negative) * -value,
            Some(ContactState::Gap) => (jump(Side::Positive) - jump(Side::Negative)) * value,
            None => on_side(Side::Positive).hull(on_side(Side::Negative)) * value.abs(),
        }
    };
    let of_block = |&block: &usize| match block.checked_sub(problem.contacts()) {
        None => of_contact(block),
        Some(hinge) => {
            let [one, other] = problem.rows_of_hinge(hinge).map(|row| unknowns[row]);
            problem.response(Side::Positive).entry(row, block) * one.hypot(other)
        }
    };
    blocks.iter().map(of_block).fold(Interval::ZERO, |sum, part| sum + part)
}
