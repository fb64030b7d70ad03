//! Problems with continua, monotone problems and chained groups, in small whole numbers and halves: everything
//! said about their solutions holds exactly.

use std::collections::HashMap;

use nalgebra::{DMatrix, DVector};
use slideway_modes::ModeProblem;
use slideway_modes::raw_problem::RawProblem;

use super::random_numbers;

/// Whole numbers from `-most` to `most`.
fn whole_numbers(seed: u64, most: u32) -> impl FnMut() -> f64 {
    let mut random = random_numbers(seed);
    let width = f64::from(2 * most + 1);
    move || (f64::midpoint(random(), 1.0) * width).floor().min(width - 1.0) - f64::from(most)
}

fn complementarity(m: &DMatrix<f64>, q: DVector<f64>) -> ModeProblem {
    ModeProblem::from_linear_complementarity(m, q).expect("shapes fit")
}

/// `w = 1 1^T z + q 1`. `q = 0`: only `z = 0`. `q = -1`: the simplex `sum z = 1`, of dimension `unknowns - 1`.
pub(crate) fn ones(unknowns: usize, q: f64) -> ModeProblem {
    complementarity(&DMatrix::from_element(unknowns, unknowns, 1.0), DVector::from_element(unknowns, q))
}

/// Boxes that rest on one another, each on the two corners of its base, loaded by weight 1 and a horizontal force
/// of 1/8; `mu = 1/2`. Velocities and impulses by Stewart and Trinkle (1996): for each contact the unknowns are
/// the normal force `n`, friction `t+` and `t-`, and the sliding speed.
///
/// The forces of a box at rest are the polytope `t1+ - t1- + t2+ - t2- = H`, `t_i+ + t_i- <= mu n_i`, `t >= 0`
/// with given `n_i` and `H > 0`: dimension 3, 6 facets, simple, thus 8 vertices. Those of all boxes multiply:
/// one cell of dimension `3 boxes`, with `27^boxes` faces.
pub(crate) fn pile(boxes: usize) -> ModeProblem {
    const FRICTION: f64 = 0.5;
    const HORIZONTAL: f64 = 0.125;
    let contacts = 2 * boxes;
    // Rows: normal and tangential velocity of each contact; columns: both velocities and the spin of each box.
    let mut jacobian = DMatrix::zeros(2 * contacts, 3 * boxes);
    for contact in 0..contacts {
        let (above, x) = (contact / 2, if contact % 2 == 0 { -1.0 } else { 1.0 });
        let below = above.checked_sub(1);
        for (body, sign, y) in [(Some(above), 1.0, -0.5), (below, -1.0, 0.5)] {
            let Some(body) = body else { continue };
            let (normal, tangential) = ([0.0, 1.0, x], [1.0, 0.0, -y]);
            for axis in 0..3 {
                jacobian[(2 * contact, 3 * body + axis)] = sign * normal[axis];
                jacobian[(2 * contact + 1, 3 * body + axis)] = sign * tangential[axis];
            }
        }
    }
    // Mass 1, moment of inertia 1/2.
    let mobility = DMatrix::from_diagonal(&DVector::from_fn(3 * boxes, |at, _| [1.0, 1.0, 2.0][at % 3]));
    let free = DVector::from_fn(3 * boxes, |at, _| [HORIZONTAL, -1.0, 0.0][at % 3]);
    let response = &jacobian * mobility * jacobian.transpose();
    let velocity = &jacobian * free;
    // The row of the Jacobian matrix and the sign of each unknown; the speed has none.
    let row = |unknown: usize| match unknown % 4 {
        0 => Some((unknown / 4 * 2, 1.0)),
        1 => Some((unknown / 4 * 2 + 1, 1.0)),
        2 => Some((unknown / 4 * 2 + 1, -1.0)),
        _ => None,
    };
    let m = DMatrix::from_fn(4 * contacts, 4 * contacts, |at, unknown| match (row(at), row(unknown)) {
        (Some((one, sign)), Some((other, factor))) => sign * factor * response[(one, other)],
        _ if at / 4 != unknown / 4 => 0.0,
        (Some(_), None) => f64::from(u8::from(at % 4 != 0)),
        (None, Some(_)) => {
            if unknown % 4 == 0 {
                FRICTION
            } else {
                -1.0
            }
        }
        (None, None) => 0.0,
    });
    let q = DVector::from_fn(4 * contacts, |at, _| row(at).map_or(0.0, |(row, sign)| sign * velocity[row]));
    complementarity(&m, q)
}

/// A matrix of whole numbers whose rows add up to zero, so that `G u >= 0` only if `G u = 0`.
fn balanced_rows(rows: usize, columns: usize, seed: u64) -> DMatrix<f64> {
    let mut random = whole_numbers(seed, 3);
    let mut matrix = DMatrix::from_fn(rows, columns, |_, _| random());
    let sum = matrix.rows(0, rows - 1).row_sum();
    matrix.set_row(rows - 1, &-sum);
    matrix
}

/// `M = L R` of this rank, whole numbers, `q = -M 1`. The rows of `L` add up to zero, so that `w = 0` in every
/// solution: one cell `{z >= 0 : R z = R 1}` of dimension `unknowns - rank`.
pub(crate) fn one_cell_of_low_rank(unknowns: usize, rank: usize, seed: u64) -> ModeProblem {
    let left = balanced_rows(unknowns, rank, seed);
    let mut random = whole_numbers(seed + 1, 3);
    let right = DMatrix::from_fn(rank, unknowns, |_, _| random());
    let m = left * right;
    let q = -&m * DVector::from_element(unknowns, 1.0);
    complementarity(&m, q)
}

/// Contacts without friction on bodies with so many degrees of freedom, held from all sides: `M = G G^T` and
/// `q = -M 1` as in [`one_cell_of_low_rank`]: one cell of dimension `contacts - freedoms`.
pub(crate) fn clamped_without_friction(contacts: usize, freedoms: usize, seed: u64) -> ModeProblem {
    let normals = balanced_rows(contacts, freedoms, seed);
    let m = &normals * normals.transpose();
    let q = -&m * DVector::from_element(contacts, 1.0);
    complementarity(&m, q)
}

/// The same with random normals and a random load `q = G v`, from which the bodies can move away: the velocity is
/// unique, and so are the forces unless more contacts carry than there are degrees of freedom.
pub(crate) fn pushed_without_friction(contacts: usize, freedoms: usize, seed: u64) -> ModeProblem {
    let mut random = whole_numbers(seed, 3);
    let normals = DMatrix::from_fn(contacts, freedoms, |_, _| random());
    let velocity = DVector::from_fn(freedoms, |_, _| random());
    complementarity(&(&normals * normals.transpose()), normals * velocity)
}

/// An equilibrium of supply and demand, half of the unknowns activities `x`, half prices `p`:
///
/// ```text
/// c + D x - A^T p >= 0, x >= 0        no activity earns more than it costs
/// A x + E p - d >= 0, p >= 0          no good is in short supply
/// ```
///
/// each line complementary; `D` diagonal with some zeros, `E` positive semidefinite of half the rank: `M` is
/// monotone, and the solutions form one convex set. (Cottle, Pang and Stone, The Linear Complementarity Problem,
/// section 1.2.) `c` and `d` are such that some `x` and `p` with about half of their entries positive are a
/// solution.
pub(crate) fn market(unknowns: usize, seed: u64) -> ModeProblem {
    let (half, mut random) = (unknowns / 2, whole_numbers(seed, 4));
    let technology = DMatrix::from_fn(half, half, |_, _| random());
    let factor = DMatrix::from_fn(half, half / 2, |_, _| random());
    let costs = DVector::from_fn(half, |_, _| random().max(0.0));
    let mut m = DMatrix::zeros(2 * half, 2 * half);
    m.view_mut((0, 0), (half, half)).set_diagonal(&costs);
    m.view_mut((0, half), (half, half)).copy_from(&-technology.transpose());
    m.view_mut((half, 0), (half, half)).copy_from(&technology);
    m.view_mut((half, half), (half, half)).copy_from(&(&factor * factor.transpose()));
    let solution = DVector::from_fn(2 * half, |_, _| random());
    let q = solution.map(|value| (-value).max(0.0)) - &m * solution.map(|value| value.max(0.0));
    complementarity(&m, q)
}

/// Equilibria of a game with two players who have so many strategies each and costs of 1 or 2: `A y >= 1` and
/// `B^T x >= 1`, complementary to `x` and `y` (Lemke and Howson 1964). Most such games are degenerate.
pub(crate) fn game_with_two_costs(strategies: usize, seed: u64) -> ModeProblem {
    let mut random = random_numbers(seed);
    let m = DMatrix::from_fn(2 * strategies, 2 * strategies, |row, column| {
        if (row < strategies) == (column < strategies) {
            0.0
        } else if random() < 0.0 {
            1.0
        } else {
            2.0
        }
    });
    complementarity(&m, DVector::from_element(2 * strategies, -1.0))
}

/// Which of the given weights add up to `target`, as chained groups:
///
/// ```text
/// |x_k| = 1                        two states for each weight: x_k = 1 if it is taken, otherwise -1
/// |s| = sum_k a_k x_k - t          with t = 2 target - sum_k a_k
/// |s'| = t - sum_k a_k x_k         both together: the sum is t, s = s' = 0
/// ```
pub(crate) fn subset_sum(weights: &[f64], target: f64) -> ModeProblem {
    let items = weights.len();
    let a = DMatrix::from_fn(items + 2, items + 2, |row, column| {
        let sign = if row < items { 0.0 } else { [-1.0, 1.0][row - items] };
        weights.get(column).map_or(0.0, |weight| sign * weight)
    });
    let t = 2.0 * target - weights.iter().sum::<f64>();
    let load = DVector::from_fn(items + 2, |row, _| if row < items { 1.0 } else { [-t, t][row - items] });
    ModeProblem::from_absolute_value_equation(&a, &DMatrix::identity(items + 2, items + 2), load)
        .expect("shapes fit")
}

/// Whole numbers from 1 to `2 most + 1`, and the sum of about half of them.
pub(crate) fn weights_with_subset(items: usize, most: u32, seed: u64) -> (Vec<f64>, f64) {
    let mut random = whole_numbers(seed, most);
    let weights: Vec<f64> = (0..items).map(|_| random() + f64::from(most) + 1.0).collect();
    let target = weights.iter().filter(|_| random() < 0.0).sum();
    (weights, target)
}

/// How many subsets of the weights add up to `target`, by adding one weight after the other.
pub(crate) fn subsets_with_sum(weights: &[f64], target: f64) -> u64 {
    let mut ways: HashMap<u64, u64> = HashMap::from([(0.0_f64.to_bits(), 1)]);
    for weight in weights {
        for (sum, count) in ways.clone() {
            *ways.entry((f64::from_bits(sum) + weight).to_bits()).or_default() += count;
        }
    }
    ways.get(&target.to_bits()).copied().unwrap_or(0)
}

/// `w = M z + q` with entries of `M` up to 3 and a planted solution in whole numbers; the first unknowns are free.
fn mixed_numbers(free: usize, pairs: usize, seed: u64) -> (DMatrix<f64>, DVector<f64>) {
    let mut small = whole_numbers(seed, 3);
    let m = DMatrix::from_fn(free + pairs, free + pairs, |_, _| small());
    let mut wide = whole_numbers(seed + 1000, 5);
    let signed = DVector::from_fn(free + pairs, |_, _| wide());
    let z = DVector::from_fn(free + pairs, |at, _| if at < free { signed[at] } else { signed[at].max(0.0) });
    let w = &z - signed;
    let q = w - &m * z;
    (m, q)
}

/// A mixed problem with free unknowns.
pub(crate) fn mixed(free: usize, pairs: usize, seed: u64) -> ModeProblem {
    let (m, q) = mixed_numbers(free, pairs, seed);
    RawProblem::MixedLinearComplementarity { m, q, free }.mode_problem().expect("shapes fit")
}

/// What is left of [`mixed`] without its free unknowns, rounded.
pub(crate) fn without_free(free: usize, pairs: usize, seed: u64) -> ModeProblem {
    let (m, q) = mixed_numbers(free, pairs, seed);
    let block =
        |row: usize, column: usize, rows: usize, columns: usize| m.view((row, column), (rows, columns));
    let inverse = block(0, 0, free, free).into_owned().try_inverse().expect("regular");
    let factor = block(free, 0, pairs, free) * inverse;
    let own = block(free, free, pairs, pairs) - &factor * block(0, free, free, pairs);
    complementarity(&own, q.rows(free, pairs) - factor * q.rows(0, free))
}
