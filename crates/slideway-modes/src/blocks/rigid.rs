//! Equations in which no force stands: compatibility of rigid guides that share a load.
//!
//! They say only which contacts are pressed, which are open, and where an open one is in its play. For most pieces they
//! contradict each other, while the other equations have self-stresses of any size: a relaxation with solutions at
//! infinity would exclude nothing.

use super::equations::{Piece, load};
use super::problem::BlockProblem;
use super::relaxation::{load_product, shares};
use crate::problem::Side;
use crate::simplex::{Bounds, LinearOutcome, LinearProgram};

/// True if equations in which no force stands prove that a piece holds no solution.
///
/// They are `sum over open k of lambda_k d_k^+ + (1 - lambda_k) d_k^- = -(b + d)` with shares `lambda_k` from 0 to 1; by
/// Farkas' lemma multipliers `v` show that there are none.
pub(super) fn is_out_of_line(
    problem: &BlockProblem,
    piece: &Piece,
    pivots: &mut u64,
    proceed: &mut dyn FnMut() -> bool,
) -> bool {
    let rows = problem.forceless();
    if rows.is_empty() {
        return false;
    }
    let open: Vec<usize> =
        (0..problem.contacts()).filter(|&contact| shares(problem, piece, contact)).collect();
    let count = rows.len() + open.len();
    let jump = |contact: usize, side: Side, row: usize| problem.jumps(side).centre()[(row, contact)];
    let fixed = load_without(problem, piece, &open);
    let size = rows.iter().map(|&row| fixed[row].abs());
    let jumps = open.iter().flat_map(|&contact| {
        rows.iter().flat_map(move |&row| Side::BOTH.map(|side| jump(contact, side, row).abs()))
    });
    let unit = size.chain(jumps).fold(f64::MIN_POSITIVE, f64::max);
    let mut columns = Vec::new();
    for (at, &contact) in open.iter().enumerate() {
        for side in Side::BOTH {
            let mut column: Vec<f64> = rows.iter().map(|&row| jump(contact, side, row) / unit).collect();
            column.resize(count, 0.0);
            column[rows.len() + at] = 1.0;
            columns.push(column);
        }
    }
    let mut cost = vec![0.0; columns.len()];
    for row in 0..rows.len() {
        for sign in [1.0, -1.0] {
            let mut column = vec![0.0; count];
            column[row] = sign;
            columns.push(column);
            cost.push(1.0);
        }
    }
    let mut right: Vec<f64> = rows.iter().map(|&row| -fixed[row] / unit).collect();
    right.resize(count, 1.0);
    let program = LinearProgram::new(&columns, right, cost);
    let bounds =
        Bounds { lower: vec![0.0; program.columns()], upper: vec![f64::INFINITY; program.columns()] };
    let mut basis = program.artificial_basis();
    let LinearOutcome::Feasible(_) = program.solve(&mut basis, &bounds, pivots, proceed) else {
        return false;
    };
    let multipliers = basis.multipliers(&program);
    let mut vector = vec![0.0; problem.rows()];
    rows.iter().zip(&multipliers).for_each(|(&row, &value)| vector[row] = value);
    let product = load_product(problem, piece, &vector);
    product.upper() < 0.0 || product.lower() > 0.0
}

/// `b + d` without the jumps of these contacts.
fn load_without(problem: &BlockProblem, piece: &Piece, open: &[usize]) -> Vec<f64> {
    let mut fixed = load::<f64>(problem, &piece.states);
    for &contact in open {
        let side = piece.states[contact].map_or(Side::Positive, BlockProblem::constant_jump);
        fixed -= problem.jumps(side).centre().column(contact);
    }
    fixed.as_slice().to_vec()
}
