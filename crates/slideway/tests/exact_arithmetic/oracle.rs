//! All states of a raw problem by elimination in rational numbers, pattern by pattern.

use std::collections::BTreeSet;

use dashu_ratio::RBig;
use nalgebra::DMatrix;
use slideway::modes::Side;
use slideway::raw_problem::RawProblem;

pub(crate) fn exact(value: f64) -> RBig {
    RBig::try_from(value).expect("finite")
}

/// `sum_k column_k y_k = load + sum_k jump_k`, with two versions of each column and jump.
struct Equations {
    columns: [Vec<Vec<RBig>>; 2],
    jumps: [Vec<Vec<RBig>>; 2],
    load: Vec<RBig>,
}

impl Equations {
    fn of(raw: &RawProblem) -> Self {
        let columns = |matrix: &DMatrix<f64>| -> Vec<Vec<RBig>> {
            matrix.column_iter().map(|column| column.iter().map(|&entry| exact(entry)).collect()).collect()
        };
        let combined = |one: &DMatrix<f64>, sign: i32, other: &DMatrix<f64>| -> Vec<Vec<RBig>> {
            let sign = RBig::from(sign);
            let pairs = columns(one).into_iter().zip(columns(other));
            pairs.map(|(one, other)| one.iter().zip(&other).map(|(a, b)| &sign * a + b).collect()).collect()
        };
        let zero = |n: usize| DMatrix::<f64>::zeros(n, n);
        match raw {
            RawProblem::LinearComplementarity { m, q } => {
                let n = q.len();
                Self {
                    columns: [combined(m, -1, &zero(n)), columns(&DMatrix::identity(n, n))],
                    jumps: [columns(&zero(n)), columns(&zero(n))],
                    load: q.iter().map(|&entry| exact(entry)).collect(),
                }
            }
            RawProblem::AbsoluteValue { a, b, right_hand_side } => {
                let n = right_hand_side.len();
                Self {
                    columns: [combined(a, 1, b), combined(a, -1, b)],
                    jumps: [columns(&zero(n)), columns(&zero(n))],
                    load: right_hand_side.iter().map(|&entry| exact(entry)).collect(),
                }
            }
            RawProblem::HorizontalComplementarity { a, b, q } => {
                let n = q.len();
                Self {
                    columns: [combined(b, -1, &zero(n)), columns(a)],
                    jumps: [columns(&zero(n)), columns(&zero(n))],
                    load: q.iter().map(|&entry| exact(entry)).collect(),
                }
            }
            // These have tests of their own, which do not use the mode problem.
            RawProblem::MixedLinearComplementarity { .. }
            | RawProblem::MixedComplementarity { .. }
            | RawProblem::BlockAbsoluteValue(_)
            | RawProblem::Game { .. } => unreachable!("no family has them"),
            RawProblem::Modes(problem) => Self {
                columns: Side::BOTH.map(|side| columns(problem.columns(side))),
                jumps: Side::BOTH.map(|side| columns(problem.jumps(side))),
                load: problem.right_hand_side().iter().map(|&entry| exact(entry)).collect(),
            },
        }
    }
}

/// A state: the signed values, and of each unknown that is zero the share of its positive jump (0 if it has
/// none). The same state of several patterns is the same here.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct State {
    pub(crate) signed: Vec<RBig>,
    pub(crate) shares: Vec<RBig>,
}

impl State {
    pub(crate) fn in_gap(&self, at: usize) -> bool {
        self.shares[at] != RBig::ZERO && self.shares[at] != RBig::ONE
    }

    pub(crate) fn is_gap_state(&self) -> bool {
        (0..self.shares.len()).any(|at| self.in_gap(at))
    }
}

/// What there is.
#[derive(Debug, Default)]
pub(crate) struct Truth {
    pub(crate) states: BTreeSet<State>,
    /// Whether some singular pattern admits more than one state.
    pub(crate) continuum: bool,
}

/// All states; none if some singular pattern is more than this oracle describes: equations that leave more
/// than one unknown free, or a share.
pub(crate) fn truth(raw: &RawProblem) -> Option<Truth> {
    let equations = Equations::of(raw);
    let n = equations.load.len();
    let has_jump: Vec<bool> = (0..n).map(|k| equations.jumps[0][k] != equations.jumps[1][k]).collect();
    let mut truth = Truth::default();
    let mut pattern = vec![0; n];
    loop {
        examine(&equations, &has_jump, &pattern, &mut truth)?;
        let Some(at) = (0..n).find(|&at| pattern[at] + 1 < if has_jump[at] { 3 } else { 2 }) else {
            return Some(truth);
        };
        pattern[at] += 1;
        pattern[..at].fill(0);
    }
}

/// Files what one pattern admits: 0 is the positive side, 1 the negative one, 2 the gap.
fn examine(equations: &Equations, has_jump: &[bool], pattern: &[usize], truth: &mut Truth) -> Option<()> {
    let n = pattern.len();
    let mut rows: Vec<Vec<RBig>> = vec![Vec::new(); n];
    for (row, entries) in rows.iter_mut().enumerate() {
        let mut right = equations.load[row].clone();
        for (k, &state) in pattern.iter().enumerate() {
            let jump = [&equations.jumps[0][k][row], &equations.jumps[1][k][row]];
            entries.push(if state == 2 {
                jump[1] - jump[0]
            } else {
                equations.columns[state][k][row].clone()
            });
            right += jump[state.min(1)];
        }
        entries.push(right);
    }
    let free = reduce(&mut rows, n);
    if rows.iter().any(|row| row[..n].iter().all(RBig::is_zero) && !row[n].is_zero()) {
        return Some(());
    }
    let most = |k: usize| (pattern[k] == 2).then_some(RBig::ONE);
    let mut file = |values: &[RBig]| {
        let signed = values.iter().zip(pattern).map(|(value, &state)| match state {
            0 => value.clone(),
            1 => -value,
            _ => RBig::ZERO,
        });
        let share = |k: usize| match pattern[k] {
            _ if !has_jump[k] || pattern[k] < 2 && !values[k].is_zero() => RBig::ZERO,
            0 => RBig::ONE,
            1 => RBig::ZERO,
            _ => values[k].clone(),
        };
        truth.states.insert(State { signed: signed.collect(), shares: (0..n).map(share).collect() });
    };
    match free[..] {
        [] => {
            let values: Vec<RBig> = (0..n).map(|k| rows[k][n].clone()).collect();
            let inside = |k: usize| values[k] >= RBig::ZERO && most(k).is_none_or(|most| values[k] <= most);
            if (0..n).all(inside) {
                file(&values);
            }
            Some(())
        }
        [parameter] => {
            // Every other unknown is constant - slope t, for t from `low` to `high`.
            let line: Vec<(RBig, RBig)> = (0..n)
                .map(|k| {
                    let pivot = rows.iter().find(|row| (0..n).find(|&at| !row[at].is_zero()) == Some(k));
                    pivot.map_or((RBig::ZERO, -RBig::ONE), |row| (row[n].clone(), row[parameter].clone()))
                })
                .collect();
            let (mut low, mut high): (Option<RBig>, Option<RBig>) = (None, None);
            for (k, (constant, slope)) in line.iter().enumerate() {
                let mut limit = |constant: RBig, slope: &RBig| {
                    // constant >= slope t
                    if slope.is_zero() {
                        return constant >= RBig::ZERO;
                    }
                    let at = constant / slope;
                    if *slope > RBig::ZERO {
                        high = Some(high.take().map_or(at.clone(), |high| high.min(at)));
                    } else {
                        low = Some(low.take().map_or(at.clone(), |low| low.max(at)));
                    }
                    true
                };
                let fits = limit(constant.clone(), slope)
                    && most(k).is_none_or(|most| limit(most - constant, &-slope.clone()));
                if !fits {
                    return Some(());
                }
            }
            match (low, high) {
                (Some(low), Some(high)) if low > high => Some(()),
                _ if pattern.contains(&2) => None,
                (Some(low), Some(high)) if low == high => {
                    let values: Vec<RBig> =
                        line.iter().map(|(constant, slope)| constant - slope * &low).collect();
                    file(&values);
                    Some(())
                }
                _ => {
                    truth.continuum = true;
                    Some(())
                }
            }
        }
        _ => None,
    }
}

/// Gauss-Jordan elimination: the unknowns without a pivot. Row `k` has the pivot 1 of the `k`-th other
/// unknown.
fn reduce(rows: &mut [Vec<RBig>], n: usize) -> Vec<usize> {
    let mut free = Vec::new();
    let mut done = 0;
    for column in 0..n {
        let Some(found) = (done..n).find(|&row| !rows[row][column].is_zero()) else {
            free.push(column);
            continue;
        };
        rows.swap(done, found);
        let pivot = rows[done][column].clone();
        for entry in &mut rows[done][column..] {
            *entry /= &pivot;
        }
        let pivot_row = rows[done].clone();
        for (row, entries) in rows.iter_mut().enumerate() {
            if row != done && !entries[column].is_zero() {
                let factor = entries[column].clone();
                for (entry, eliminated) in entries[column..].iter_mut().zip(&pivot_row[column..]) {
                    if !eliminated.is_zero() {
                        *entry -= &factor * eliminated;
                    }
                }
            }
        }
        done += 1;
    }
    free
}
