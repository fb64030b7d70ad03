//! What a pattern admits, by rational numbers and brute force.

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use slideway_modes::{ContactState, ModeProblem, Side};

pub(crate) const STATES: [ContactState; 3] =
    [ContactState::Positive, ContactState::Negative, ContactState::Gap];

pub(crate) fn rational(value: f64) -> RBig {
    RBig::try_from(value).expect("finite")
}

/// `[A | b]` of a pattern, followed by `lambda_k + complement_k = 1` for every contact in its gap.
fn equations(problem: &ModeProblem, pattern: &[ContactState]) -> Vec<Vec<RBig>> {
    let contacts = pattern.len();
    let in_gap: Vec<usize> = (0..contacts).filter(|&k| pattern[k] == ContactState::Gap).collect();
    let width = contacts + in_gap.len();
    let mut rows = vec![vec![RBig::ZERO; width + 1]; width];
    for (row, equation) in rows[..contacts].iter_mut().enumerate() {
        equation[width] = rational(problem.right_hand_side()[row]);
        for (k, state) in pattern.iter().enumerate() {
            let jump = |side: Side| rational(problem.jumps(side)[(row, k)]);
            equation[k] = match state.side() {
                Some(side) => rational(problem.columns(side)[(row, k)]),
                None => jump(Side::Negative) - jump(Side::Positive),
            };
            equation[width] += jump(state.side().unwrap_or(Side::Negative));
        }
    }
    for (index, &k) in in_gap.iter().enumerate() {
        let row = &mut rows[contacts + index];
        row[k] = RBig::ONE;
        row[contacts + index] = RBig::ONE;
        row[width] = RBig::ONE;
    }
    rows
}

/// The only solution of `[A | b]` with the given columns of `A`; none if there is no or no unique one.
fn solve(rows: &[Vec<RBig>], columns: &[usize]) -> Option<Vec<RBig>> {
    let last = rows.first().map_or(0, |row| row.len() - 1);
    let mut table: Vec<Vec<RBig>> =
        rows.iter().map(|row| columns.iter().chain([&last]).map(|&at| row[at].clone()).collect()).collect();
    for step in 0..columns.len() {
        let found = (step..table.len()).find(|&row| !table[row][step].is_zero())?;
        table.swap(step, found);
        let pivot_row = table[step].clone();
        for (_, row) in table.iter_mut().enumerate().filter(|(at, _)| *at != step) {
            let factor = &row[step] / &pivot_row[step];
            if !factor.is_zero() {
                row.iter_mut().zip(&pivot_row).for_each(|(value, other)| *value -= &factor * other);
            }
        }
    }
    let consistent = table[columns.len()..].iter().all(|row| row[columns.len()].is_zero());
    consistent.then(|| (0..columns.len()).map(|at| &table[at][columns.len()] / &table[at][at]).collect())
}

/// The unknowns of a regular pattern; none if it is singular.
pub(crate) fn unknowns(problem: &ModeProblem, pattern: &[ContactState]) -> Option<Vec<RBig>> {
    let rows: Vec<Vec<RBig>> = equations(problem, pattern);
    let contacts = pattern.len();
    let width = rows.len();
    let square: Vec<Vec<RBig>> = rows[..contacts]
        .iter()
        .map(|row| row[..contacts].iter().chain([&row[width]]).cloned().collect())
        .collect();
    solve(&square, &(0..contacts).collect::<Vec<_>>())
}

/// All vertices of what a pattern admits. A pattern admits something exactly if there is a vertex.
pub(crate) fn vertices(problem: &ModeProblem, pattern: &[ContactState]) -> Vec<Vec<RBig>> {
    let mut found: Vec<Vec<RBig>> = Vec::new();
    for mut point in basic_solutions(&equations(problem, pattern)) {
        point.truncate(pattern.len());
        if !found.contains(&point) {
            found.push(point);
        }
    }
    found
}

/// All vertices of `{y >= 0, A y = b}`, found by trying every set of columns of `[A | b]`.
pub(crate) fn basic_solutions(rows: &[Vec<RBig>]) -> Vec<Vec<RBig>> {
    let width = rows.first().map_or(0, |row| row.len() - 1);
    let mut found: Vec<Vec<RBig>> = Vec::new();
    for set in 0..1_u32 << width {
        let columns: Vec<usize> = (0..width).filter(|&at| set >> at & 1 == 1).collect();
        let Some(values) = solve(rows, &columns) else { continue };
        if values.iter().any(|value| *value < RBig::ZERO) {
            continue;
        }
        let mut point = vec![RBig::ZERO; width];
        columns.iter().zip(values).for_each(|(&at, value)| point[at] = value);
        if !found.contains(&point) {
            found.push(point);
        }
    }
    found
}

/// Signed normal forces.
pub(crate) fn forces(unknowns: &[RBig], pattern: &[ContactState]) -> Vec<RBig> {
    let signed = |(value, state): (&RBig, &ContactState)| match state {
        ContactState::Positive => value.clone(),
        ContactState::Negative => -value.clone(),
        ContactState::Gap => RBig::ZERO,
    };
    unknowns.iter().zip(pattern).map(signed).collect()
}

/// Every list of one of the `states` per contact.
pub(crate) fn patterns(contacts: usize, states: &[ContactState]) -> Vec<Vec<ContactState>> {
    let mut all = vec![Vec::new()];
    for _ in 0..contacts {
        all = all
            .iter()
            .flat_map(|pattern: &Vec<ContactState>| {
                states.iter().map(move |&state| pattern.iter().copied().chain([state]).collect())
            })
            .collect();
    }
    all
}

/// Whether a pattern has the given states where they are given.
pub(crate) fn agrees(pattern: &[ContactState], partial: &[Option<ContactState>]) -> bool {
    pattern.iter().zip(partial).all(|(state, given)| given.is_none_or(|given| given == *state))
}

/// Numbers between -1 and 1, with few or many digits.
fn entry(digits: Digits) -> BoxedStrategy<f64> {
    match digits {
        Digits::Many => (-1.0..1.0_f64).boxed(),
        Digits::Few => (-2..=2_i32).prop_map(|value| f64::from(value) / 2.0).boxed(),
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Digits {
    /// Generic numbers.
    Many,
    /// -1, -1/2, 0, 1/2, 1: degenerate more often than not.
    Few,
}

fn matrix(contacts: usize, digits: Digits) -> impl Strategy<Value = DMatrix<f64>> {
    prop::collection::vec(entry(digits), contacts * contacts)
        .prop_map(move |entries| DMatrix::from_vec(contacts, contacts, entries))
}

/// Problems with `contacts` contacts and with or without jumps. With `coupling`, columns are
/// `+-e_k` plus that times random numbers; without, random.
pub(crate) fn problem(
    contacts: usize,
    digits: Digits,
    jumps: bool,
    coupling: Option<f64>,
) -> impl Strategy<Value = ModeProblem> {
    let parts = (
        matrix(contacts, digits),
        matrix(contacts, digits),
        matrix(contacts, digits),
        matrix(contacts, digits),
        prop::collection::vec(entry(digits), contacts),
    );
    parts.prop_map(move |(plus, minus, jump_plus, jump_minus, right)| {
        let identity = DMatrix::<f64>::identity(contacts, contacts);
        let columns = |random: DMatrix<f64>, sign: f64| match coupling {
            Some(size) => &identity * sign + random * size,
            None => random,
        };
        let jump = |random: DMatrix<f64>| if jumps { random * 0.5 } else { random * 0.0 };
        ModeProblem::new(
            columns(plus, 1.0),
            columns(minus, -1.0),
            jump(jump_plus),
            jump(jump_minus),
            DVector::from_vec(right),
        )
        .expect("finite numbers")
    })
}
