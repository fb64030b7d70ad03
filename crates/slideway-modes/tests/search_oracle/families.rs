//! Degenerate problems in small whole numbers and halves.

use nalgebra::{DMatrix, DVector};
use slideway_modes::ModeProblem;

use crate::search_support::Random;

/// Problems of one kind, with so many contacts or unknowns at most.
pub(crate) struct Family {
    pub(crate) name: &'static str,
    pub(crate) problem: fn(&mut Random, usize) -> ModeProblem,
}

pub(crate) const FAMILIES: [Family; 15] = [
    Family { name: "ones", problem: ones },
    Family { name: "planted degenerate points", problem: planted },
    Family { name: "piles", problem: pile },
    Family { name: "low rank", problem: low_rank },
    Family { name: "entries -1, 0, 1", problem: small },
    Family { name: "equal rows or columns", problem: duplicates },
    Family { name: "zero columns", problem: zero_columns },
    Family { name: "coordination games", problem: coordination_game },
    Family { name: "degenerate games", problem: degenerate_game },
    Family { name: "border of the P-matrices", problem: border_of_p },
    Family { name: "Z-matrices", problem: z_matrix },
    Family { name: "singular positive semidefinite", problem: semidefinite },
    Family { name: "skew-symmetric", problem: skew },
    Family { name: "jumps", problem: jumps },
    Family { name: "chained groups", problem: chained },
];

fn integers(random: &mut Random, rows: usize, columns: usize, most: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.integer(most))
}

fn complementarity(m: &DMatrix<f64>, q: DVector<f64>) -> ModeProblem {
    ModeProblem::from_linear_complementarity(m, q).expect("shapes fit")
}

/// `q` such that some `z` and `w`, of which many entries are zero, are a solution.
fn with_solution(random: &mut Random, m: &DMatrix<f64>) -> ModeProblem {
    let x = DVector::from_fn(m.nrows(), |_, _| random.integer(1));
    let q = x.map(|x| (-x).max(0.0)) - m * x.map(|x| x.max(0.0));
    complementarity(m, q)
}

/// With a solution for every other problem.
fn loaded(random: &mut Random, m: &DMatrix<f64>) -> ModeProblem {
    if random.below(2) == 0 {
        return with_solution(random, m);
    }
    complementarity(m, DVector::from_fn(m.nrows(), |_, _| random.integer(1)))
}

/// `M` of ones, `q` constant or random.
fn ones(random: &mut Random, size: usize) -> ModeProblem {
    let (constant, varies) = (random.integer(1), random.below(3) == 0);
    let q = DVector::from_fn(size, |_, _| if varies { random.integer(1) } else { constant });
    complementarity(&DMatrix::from_element(size, size, 1.0), q)
}

fn planted(random: &mut Random, size: usize) -> ModeProblem {
    let m = integers(random, size, size, 2);
    with_solution(random, &m)
}

/// Contacts of bodies of unit mass, with friction as long as there are four unknowns for it (Stewart and Trinkle
/// 1996: normal force, friction in both directions, sliding speed), otherwise without.
fn pile(random: &mut Random, size: usize) -> ModeProblem {
    let freedoms = 1 + random.below(3);
    // The row of the Jacobian matrix of each unknown; none for sliding speeds.
    let mut directions: Vec<Option<DVector<f64>>> = Vec::new();
    let mut friction = Vec::new();
    while directions.len() < size {
        let normal = DVector::from_fn(freedoms, |_, _| random.integer(1));
        if directions.len() + 4 <= size && random.below(4) > 0 {
            let tangent = DVector::from_fn(freedoms, |_, _| random.integer(1));
            friction.push(directions.len());
            directions.extend([Some(normal), Some(tangent.clone()), Some(-tangent), None]);
        } else {
            directions.push(Some(normal));
        }
    }
    let mut m = DMatrix::from_fn(size, size, |row, column| match (&directions[row], &directions[column]) {
        (Some(one), Some(other)) => one.dot(other),
        _ => 0.0,
    });
    for first in friction {
        m[(first + 3, first)] = 0.5;
        for tangent in [first + 1, first + 2] {
            (m[(tangent, first + 3)], m[(first + 3, tangent)]) = (1.0, -1.0);
        }
    }
    let free = DVector::from_fn(freedoms, |_, _| random.integer(1));
    let q = DVector::from_fn(size, |row, _| directions[row].as_ref().map_or(0.0, |row| row.dot(&free)));
    complementarity(&m, q)
}

fn low_rank(random: &mut Random, size: usize) -> ModeProblem {
    let rank = 1 + random.below(size.div_ceil(2));
    let m = integers(random, size, rank, 1) * integers(random, rank, size, 1);
    loaded(random, &m)
}

/// Both versions of all columns.
fn two_versions(random: &mut Random, [positive, negative]: [DMatrix<f64>; 2]) -> ModeProblem {
    let size = positive.nrows();
    let none = DMatrix::zeros(size, size);
    let load = DVector::from_fn(size, |_, _| random.integer(1));
    ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit")
}

fn small(random: &mut Random, size: usize) -> ModeProblem {
    let columns = [0, 1].map(|_| integers(random, size, size, 1));
    two_versions(random, columns)
}

fn duplicates(random: &mut Random, size: usize) -> ModeProblem {
    let mut m = integers(random, size, size, 2);
    let (from, to) = (random.below(size), random.below(size));
    match random.below(3) {
        0 => m.set_row(to, &m.row(from).into_owned()),
        1 => m.set_column(to, &m.column(from).into_owned()),
        _ => m.set_column(to, &-m.column(from)),
    }
    loaded(random, &m)
}

fn zero_columns(random: &mut Random, size: usize) -> ModeProblem {
    let columns = [0, 1].map(|_| {
        let mut columns = integers(random, size, size, 2);
        columns.set_column(random.below(size), &DVector::zeros(size));
        columns
    });
    two_versions(random, columns)
}

/// The complementarity problem of a game with costs, [`crate::instances::structured::game_with_two_costs`].
fn game(
    random: &mut Random,
    size: usize,
    cost: impl Fn(&mut Random, usize, usize, bool) -> f64,
) -> ModeProblem {
    let first = if size < 2 { size } else { 1 + random.below(size - 1) };
    let mut m = DMatrix::zeros(size, size);
    for one in 0..first {
        for other in first..size {
            m[(one, other)] = cost(random, one, other - first, true);
            m[(other, one)] = cost(random, one, other - first, false);
        }
    }
    complementarity(&m, DVector::from_element(size, -1.0))
}

/// Both players pay less if they choose the same.
fn coordination_game(random: &mut Random, size: usize) -> ModeProblem {
    let shift = random.below(2);
    game(random, size, |_, one, other, _| if one == other + shift { 1.0 } else { 2.0 })
}

fn degenerate_game(random: &mut Random, size: usize) -> ModeProblem {
    game(random, size, |random, _, _, _| 1.0 + random.below(2) as f64)
}

/// Some principal minors are zero, none is negative: triangular in another order, with ones and zeros in the
/// diagonal.
fn border_of_p(random: &mut Random, size: usize) -> ModeProblem {
    let mut order: Vec<usize> = (0..size).collect();
    (1..size).for_each(|at| order.swap(at, random.below(at + 1)));
    let m = DMatrix::from_fn(size, size, |row, column| match order[row].cmp(&order[column]) {
        std::cmp::Ordering::Less => random.integer(2),
        std::cmp::Ordering::Equal => random.below(2) as f64,
        std::cmp::Ordering::Greater => 0.0,
    });
    loaded(random, &m)
}

fn z_matrix(random: &mut Random, size: usize) -> ModeProblem {
    let m = DMatrix::from_fn(size, size, |row, column| {
        if row == column { random.integer(2) } else { -(random.below(3) as f64) }
    });
    loaded(random, &m)
}

fn semidefinite(random: &mut Random, size: usize) -> ModeProblem {
    let rank = 1 + random.below(size);
    let factor = integers(random, size, rank, 1);
    loaded(random, &(&factor * factor.transpose()))
}

fn skew(random: &mut Random, size: usize) -> ModeProblem {
    let upper = integers(random, size, size, 1).upper_triangle();
    loaded(random, &(&upper - upper.transpose()))
}

/// Preloads: the right-hand side jumps where a contact changes sides.
fn jumps(random: &mut Random, size: usize) -> ModeProblem {
    let size = size.min(4);
    let [positive, negative] =
        [1.0, -1.0].map(|sign| integers(random, size, size, 1) / 2.0 + DMatrix::identity(size, size) * sign);
    let mut jumps = integers(random, size, size, 1);
    for contact in 0..size {
        if random.below(3) == 0 {
            jumps.column_mut(contact).fill(0.0);
        }
    }
    let load = DVector::from_fn(size, |_, _| random.integer(2));
    ModeProblem::new(positive, negative, jumps.clone(), -jumps, load).expect("shapes fit")
}

/// Lower triangular in blocks of one or two: groups that depend on earlier ones.
fn chained(random: &mut Random, size: usize) -> ModeProblem {
    let width = 1 + random.below(2);
    let mut columns = || {
        DMatrix::from_fn(size, size, |row, column| {
            let entry = random.integer(1);
            if column / width <= row / width { entry } else { 0.0 }
        })
    };
    let columns = [columns(), columns()];
    two_versions(random, columns)
}
