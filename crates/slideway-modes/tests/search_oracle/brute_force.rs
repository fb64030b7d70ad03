//! All maximal cells of solutions of a small problem in whole numbers, by trying every set of positive unknowns.
//!
//! With unknowns `y_k^+, y_k^- >= 0` for the sides of a contact, and `lambda_k + rest_k = 1` where the right-hand
//! side jumps,
//!
//! ```text
//! sum_k c_k^+ y_k^+ + c_k^- y_k^- = N(0) + sum_k lambda_k d_k^+ + rest_k d_k^-
//! ```
//!
//! is a polyhedron. Its solutions are the points without a forbidden pair of positive unknowns: `(y_k^+, y_k^-)`,
//! `(y_k^+, rest_k)`, `(y_k^-, lambda_k)`. A vertex is a point whose positive unknowns determine it, a direction one
//! of the homogeneous equations; every point of a face is a mean of its vertices plus a sum of its directions. So
//! the positive unknowns of all solutions of a pattern are those of the vertices and directions that it allows.

use std::collections::BTreeSet;

use slideway_modes::{ModeProblem, Side};

/// Unknowns of one contact: `y^+`, `y^-`, `lambda`, `rest`.
pub(crate) const UNKNOWNS: usize = 4;

/// Positive unknowns as bits; those of contact `k` from bit `4 k` on.
pub(crate) type Unknowns = u64;

/// What may be positive in a vertex for a contact with and without a jump, and in a direction.
const OF_VERTICES: [&[Unknowns]; 2] = [&[0b0000, 0b0001, 0b0010], &[0b0100, 0b1000, 0b1100, 0b0101, 0b1010]];
const OF_DIRECTIONS: &[Unknowns] = &[0b0000, 0b0001, 0b0010];
/// What may be positive in the states of a contact with and without a jump.
const OF_STATES: [&[Unknowns]; 2] = [&[0b0001, 0b0010], &[0b0101, 0b1010, 0b1100]];

/// The positive unknowns of each maximal cell. The numbers of the problem must be multiples of 1/4.
pub(crate) fn maximal_cells(problem: &ModeProblem) -> BTreeSet<Unknowns> {
    let rows = equations(problem);
    let jumps: Vec<usize> =
        (0..problem.contacts()).map(|contact| usize::from(problem.has_jump(contact))).collect();
    let allowed =
        |of: &dyn Fn(usize) -> &'static [Unknowns]| combinations(jumps.iter().map(|&jump| of(jump)));
    let mut vertices = allowed(&|jump| OF_VERTICES[jump]);
    vertices.retain(|&unknowns| is_vertex(&rows, unknowns));
    let mut directions = allowed(&|_| OF_DIRECTIONS);
    directions.retain(|&unknowns| is_direction(&rows, unknowns));
    let cells: BTreeSet<Unknowns> = allowed(&|jump| OF_STATES[jump])
        .into_iter()
        .filter_map(|state| {
            let within = |unknowns: &&Unknowns| *unknowns & !state == 0;
            let corners = vertices.iter().filter(within).copied().reduce(|one, other| one | other)?;
            Some(directions.iter().filter(within).fold(corners, |all, unknowns| all | unknowns))
        })
        .collect();
    let is_maximal = |cell: &Unknowns| cells.iter().all(|other| other == cell || cell & !other != 0);
    cells.iter().filter(|cell| is_maximal(cell)).copied().collect()
}

/// All ways to choose one of the sets of each contact.
fn combinations(choices: impl Iterator<Item = &'static [Unknowns]>) -> Vec<Unknowns> {
    choices.enumerate().fold(vec![0], |all, (contact, sets)| {
        let with = |known: &Unknowns| {
            let known = *known;
            sets.iter().map(move |set| known | set << (UNKNOWNS * contact))
        };
        all.iter().flat_map(with).collect()
    })
}

/// The equations with the right-hand side as the last column.
fn equations(problem: &ModeProblem) -> Vec<Vec<i128>> {
    let contacts = problem.contacts();
    let width = UNKNOWNS * contacts + 1;
    let mut rows: Vec<Vec<i128>> = (0..contacts)
        .map(|row| {
            let mut equation = vec![0; width];
            equation[width - 1] = whole(problem.right_hand_side()[row]);
            for contact in 0..contacts {
                let [up, down] = Side::BOTH.map(|side| whole(problem.jumps(side)[(row, contact)]));
                for (at, side) in Side::BOTH.into_iter().enumerate() {
                    equation[UNKNOWNS * contact + at] = whole(problem.columns(side)[(row, contact)]);
                }
                if problem.has_jump(contact) {
                    (equation[UNKNOWNS * contact + 2], equation[UNKNOWNS * contact + 3]) = (-up, -down);
                } else {
                    equation[width - 1] += up;
                }
            }
            equation
        })
        .collect();
    for contact in (0..contacts).filter(|&contact| problem.has_jump(contact)) {
        let mut shares = vec![0; width];
        for at in [UNKNOWNS * contact + 2, UNKNOWNS * contact + 3, width - 1] {
            shares[at] = 1;
        }
        rows.push(shares);
    }
    rows
}

/// Four times a multiple of 1/4.
#[expect(clippy::cast_possible_truncation, reason = "checked")]
fn whole(value: f64) -> i128 {
    let scaled = 4.0 * value;
    assert!(scaled.fract() == 0.0 && scaled.abs() < 1e6, "{value}");
    scaled as i128
}

fn columns(unknowns: Unknowns) -> Vec<usize> {
    (0..64).filter(|at| unknowns >> at & 1 == 1).collect()
}

/// Whether exactly these unknowns are positive in a vertex: they are positive, and determined by the equations.
fn is_vertex(rows: &[Vec<i128>], unknowns: Unknowns) -> bool {
    let columns = columns(unknowns);
    let table = rows.iter().map(|row| {
        let right = row[row.len() - 1];
        columns.iter().map(|&at| row[at]).chain([right]).collect()
    });
    has_one_positive_solution(table.collect())
}

/// Whether exactly these unknowns are positive in an extreme direction: the last one determines the others.
fn is_direction(rows: &[Vec<i128>], unknowns: Unknowns) -> bool {
    let columns = columns(unknowns);
    let Some((&last, others)) = columns.split_last() else { return false };
    let table = rows.iter().map(|row| others.iter().map(|&at| row[at]).chain([-row[last]]).collect());
    has_one_positive_solution(table.collect())
}

/// Whether `[A | b]` has exactly one solution and that is positive, by elimination in whole numbers (Bareiss 1968).
fn has_one_positive_solution(mut table: Vec<Vec<i128>>) -> bool {
    let width = table.first().map_or(0, |row| row.len() - 1);
    let mut divisor = 1;
    for step in 0..width {
        let Some(found) = (step..table.len()).find(|&row| table[row][step] != 0) else { return false };
        table.swap(step, found);
        let pivot_row = table[step].clone();
        for (_, row) in table.iter_mut().enumerate().filter(|(at, _)| *at != step) {
            let factor = row[step];
            for (value, other) in row.iter_mut().zip(&pivot_row) {
                *value = (*value * pivot_row[step] - factor * other) / divisor;
            }
        }
        divisor = pivot_row[step];
    }
    let right = |row: &Vec<i128>| row[width];
    table[width..].iter().all(|row| right(row) == 0)
        && table[..width].iter().enumerate().all(|(at, row)| right(row).signum() * row[at].signum() > 0)
}
