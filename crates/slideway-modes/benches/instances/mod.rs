//! Problems of known difficulty, for times, for numbers of nodes and for tests.
#![allow(dead_code, reason = "each program uses a part of it")]

use nalgebra::{DMatrix, DVector};
use slideway_modes::blocks::BlockProblem;
use slideway_modes::{BySide, InfluenceCoefficients, ModeProblem, SharedLoad};

pub(crate) mod structured;

/// Random columns of size `strength / sqrt(blocks)` for these numbers of contacts and hinges, and a random load.
pub(crate) fn random_block_problem(contacts: usize, hinges: usize, strength: f64, seed: u64) -> BlockProblem {
    let mut random = random_numbers(seed);
    let (rows, blocks) = (contacts + 2 * hinges, contacts + hinges);
    let size = strength / (blocks as f64).sqrt();
    let response = DMatrix::from_fn(rows, blocks, |_, _| size * random());
    block_problem(contacts, response, DVector::from_fn(rows, |_, _| random()))
}

/// Eight solutions, proven by resultants (`planted_8` of reference/block-problems.toml).
pub(crate) fn block_problem_with_eight_solutions() -> BlockProblem {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reference/block-problems.toml");
    let text = std::fs::read_to_string(path).expect("a file of the repository");
    let table: toml::Table = text.parse().expect("a table");
    let problem = &table["problem"][0];
    let numbers = |value: &toml::Value| -> Vec<f64> {
        value.as_array().into_iter().flatten().filter_map(toml::Value::as_float).collect()
    };
    let rows: Vec<Vec<f64>> = problem["H"].as_array().into_iter().flatten().map(numbers).collect();
    let response = DMatrix::from_fn(rows.len(), rows[0].len(), |row, column| rows[row][column]);
    block_problem(1, response, DVector::from_vec(numbers(&problem["b"])))
}

/// The same columns on both sides, no jumps.
fn block_problem(contacts: usize, response: DMatrix<f64>, load: DVector<f64>) -> BlockProblem {
    let jumps = DMatrix::zeros(load.len(), contacts);
    BlockProblem::new(BySide::same(response), BySide::same(jumps), load).expect("shapes fit")
}

/// Numbers from -1 to 1 by a linear congruential generator (Knuth's MMIX constants).
fn random_numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(7919).wrapping_add(12_345);
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// `x - B |x| = c` with a solution planted in each block of the given size,
/// `B = strength sqrt(3 / block) U(-1, 1)`.
pub(crate) fn planted_blocks(contacts: usize, block: usize, strength: f64, seed: u64) -> ModeProblem {
    let mut random = random_numbers(seed);
    let factor = strength * (3.0 / block as f64).sqrt();
    let b = DMatrix::from_fn(contacts, contacts, |row, column| {
        if row / block == column / block { factor * random() } else { 0.0 }
    });
    let x = DVector::from_fn(contacts, |_, _| random());
    let load = &x - &b * x.abs();
    let identity = DMatrix::identity(contacts, contacts);
    ModeProblem::from_absolute_value_equation(&identity, &-b, load).expect("shapes fit")
}

/// Blocks of ten contacts, each acting on the first contact of the next; two column versions.
pub(crate) fn chained_blocks(contacts: usize, strength: f64) -> ModeProblem {
    let mut random = random_numbers(1);
    let factor = strength * 0.3_f64.sqrt();
    let mut columns = |sign: f64| {
        DMatrix::from_fn(contacts, contacts, |row, column| match row / 10 {
            block if block == column / 10 => factor * random() + if row == column { sign } else { 0.0 },
            block if block == column / 10 + 1 && row % 10 == 0 => 0.3 * random(),
            _ => 0.0,
        })
    };
    let (positive, negative) = (columns(1.0), columns(-1.0));
    let load = DVector::from_fn(contacts, |_, _| random());
    let none = DMatrix::zeros(contacts, contacts);
    ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit")
}

/// Entries uniform in [-1, 1] with a planted solution.
pub(crate) fn planted_complementarity(contacts: usize, seed: u64) -> ModeProblem {
    let mut random = random_numbers(seed);
    let m = DMatrix::from_fn(contacts, contacts, |_, _| random());
    let x = DVector::from_fn(contacts, |_, _| random());
    let q = x.map(|x| (-x).max(0.0)) - &m * x.map(|x| x.max(0.0));
    ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit")
}

/// Random columns close to those of contacts without coupling, with jumps of every contact.
pub(crate) fn random_with_jumps(contacts: usize, seed: u64) -> ModeProblem {
    let mut random = random_numbers(seed);
    let mut matrix = |diagonal: f64| {
        DMatrix::from_fn(contacts, contacts, |row, column| {
            random() + if row == column { diagonal } else { 0.0 }
        })
    };
    let (positive, negative, up, down) = (matrix(2.0), matrix(-2.0), matrix(0.0), matrix(0.0));
    let load = DVector::from_fn(contacts, |_, _| random());
    ModeProblem::new(positive, negative, up, down, load).expect("shapes fit")
}

/// A diagonal and a coupling of low rank; two column versions.
pub(crate) fn low_rank(contacts: usize, rank: usize) -> ModeProblem {
    let mut random = random_numbers(2);
    let left = DMatrix::from_fn(contacts, rank, |_, _| random());
    let mut columns = |sign: f64| {
        let diagonal = DVector::from_fn(contacts, |_, _| sign + 0.3 * random());
        let right = DMatrix::from_fn(rank, contacts, |_, _| 2.0 * random() / (contacts as f64).sqrt());
        DMatrix::from_diagonal(&diagonal) + &left * right
    };
    let (positive, negative) = (columns(1.0), columns(-1.0));
    let load = DVector::from_fn(contacts, |_, _| random());
    let none = DMatrix::zeros(contacts, contacts);
    ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit")
}

/// Contacts that share a load: as many self-stresses as cut contacts, which are the last ones, and friction that is
/// small enough for one solution.
pub(crate) fn redundant(contacts: usize, self_stresses: usize) -> ModeProblem {
    let mut random = random_numbers(3);
    let kept = contacts - self_stresses;
    let mut matrix = |width: usize, factor: f64| DMatrix::from_fn(contacts, width, |_, _| factor * random());
    let (eta, stress) = (matrix(contacts, 0.3 / contacts as f64), matrix(self_stresses, 1.0));
    let eta = DMatrix::from_fn(contacts, contacts, |row, k| if row < kept { eta[(row, k)] } else { 0.0 });
    let load = DVector::from_fn(contacts, |row, _| if row < kept { 10.0 * random() } else { 0.0 });
    let shared = SharedLoad {
        cut: (kept..contacts).collect(),
        self_stress: DMatrix::from_fn(contacts, self_stresses, |row, column| match row.checked_sub(kept) {
            None => stress[(row, column)],
            Some(cut) => f64::from(u8::from(cut == column)),
        }),
        compliance: DVector::from_fn(contacts, |_, _| 1e-5 * (1.0 + 0.5 * random())),
        clearance: DVector::from_fn(contacts, |_, _| 1e-4 * (1.0 + 0.5 * random())),
        misalignment: DVector::from_fn(contacts, |_, _| 1e-4 * random()),
        press_fits: Vec::new(),
    };
    ModeProblem::from_influence(&InfluenceCoefficients {
        eta: BySide::same(eta.clone()),
        eta_preload: BySide::same(eta),
        mu: BySide::same(DVector::from_element(contacts, 1.0)),
        preload: BySide::same(DVector::zeros(contacts)),
        velocity_signs: DVector::from_element(contacts, 1.0),
        frictionless: load,
        shared: Some(shared),
        one_sided: vec![],
        turning: vec![],
    })
    .expect("shapes fit")
}
