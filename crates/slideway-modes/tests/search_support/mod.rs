//! Random problems, and the comparison of a search with the enumeration of all patterns.
#![allow(dead_code, reason = "each test uses a part of it")]

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};
use slideway_modes::{
    Arguments, Completeness, ContactState, Limits, ModeProblem, SearchOptions, SearchResult, SingularMode,
    SolutionSet, StateKind, enumerate, search,
};

/// Numbers from a linear congruential generator (Knuth's MMIX constants).
pub(crate) struct Random {
    state: u64,
}

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Self { state: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) };
        random.number();
        random.number();
        random
    }

    /// From -1 to 1.
    pub(crate) fn number(&mut self) -> f64 {
        self.state =
            self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// From 0 to less than `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (0..count).rfind(|&at| f64::midpoint(self.number(), 1.0) < 1.0 / (at + 1) as f64).unwrap_or(0)
    }

    /// A whole number from `-most` to `most`.
    pub(crate) fn integer(&mut self, most: usize) -> f64 {
        self.below(2 * most + 1) as f64 - most as f64
    }

    pub(crate) fn vector(&mut self, size: usize) -> DVector<f64> {
        DVector::from_fn(size, |_, _| self.number())
    }

    pub(crate) fn matrix(&mut self, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |_, _| self.number())
    }

    pub(crate) fn sparse_matrix(&mut self, size: usize, density: f64) -> DMatrix<f64> {
        DMatrix::from_fn(size, size, |_, _| {
            let (value, kept) = (self.number(), f64::midpoint(self.number(), 1.0) < density);
            if kept { value } else { 0.0 }
        })
    }

    /// About half of the columns are zero.
    pub(crate) fn some_columns(&mut self, size: usize) -> DMatrix<f64> {
        let mut matrix = self.matrix(size, size);
        for mut column in matrix.column_iter_mut() {
            if self.number() < 0.0 {
                column.fill(0.0);
            }
        }
        matrix
    }
}

/// `(sigma - ...) y` with a diagonal and a coupling of the given rank, two column versions.
pub(crate) fn low_rank(random: &mut Random, size: usize, rank: usize, strength: f64) -> ModeProblem {
    let left = random.matrix(size, rank);
    let [positive, negative] = [1.0, -1.0].map(|sign| {
        let diagonal = random.vector(size) * 0.3;
        DMatrix::from_diagonal(&diagonal.map(|value| sign + value))
            + &left * random.matrix(rank, size) * (strength / (size as f64).sqrt())
    });
    let none = DMatrix::zeros(size, size);
    ModeProblem::new(positive, negative, none.clone(), none, random.vector(size)).expect("shapes fit")
}

/// All arguments, and each of them switched off.
pub(crate) fn switches() -> [SearchOptions; 6] {
    let all = Arguments::default();
    let none = Arguments {
        groups: false,
        propagation: false,
        uniqueness: false,
        low_rank: false,
        faces: false,
        every_pattern: false,
    };
    [
        all,
        Arguments { groups: false, ..all },
        Arguments { propagation: false, ..all },
        Arguments { uniqueness: false, ..all },
        Arguments { groups: false, uniqueness: false, ..all },
        none,
    ]
    .map(|arguments| SearchOptions { arguments, ..SearchOptions::default() })
}

pub(crate) fn run(problem: &ModeProblem, options: &SearchOptions) -> SearchResult {
    search(problem, options, &mut |_| ControlFlow::Continue(()))
}

fn close(one: &DVector<f64>, other: &DVector<f64>) -> bool {
    (one - other).amax() <= 1e-6 * (1.0 + one.amax().min(other.amax()))
}

/// Points of one list are those of the other, each as often.
fn same_points(one: &[DVector<f64>], other: &[DVector<f64>]) -> bool {
    let times =
        |point: &DVector<f64>, list: &[DVector<f64>]| list.iter().filter(|at| close(point, at)).count();
    one.len() == other.len() && one.iter().all(|point| times(point, one) == times(point, other))
}

/// What a singular set admits beyond the solutions listed apart.
fn is_own_set(mode: &SingularMode) -> bool {
    match mode.set {
        SolutionSet::Empty | SolutionSet::NotComputed => false,
        SolutionSet::Point(_) => mode.shares_vary || mode.contains.is_empty(),
        _ => true,
    }
}

/// The search finds the same solutions and gap states as the enumeration of all patterns, and
/// as many singular sets; where the problem splits into groups, continua may be listed by other
/// patterns, and only isolated states are compared if there are any.
pub(crate) fn assert_same_as_enumeration(problem: &ModeProblem, options: &SearchOptions, seed: usize) {
    let contacts = problem.contacts();
    let expected = enumerate(problem, &Limits::default()).expect("within the limits");
    let found = run(problem, options);
    let context = format!("seed {seed}, {contacts} contacts, {}, {options:?}\n{problem:?}", found.strategy());
    assert!(matches!(found.completeness, Completeness::Proven | Completeness::NotProven), "{context}");
    let split = found.groups.len() > 1;

    let points = |kind: StateKind| -> Vec<DVector<f64>> {
        let states = found.product.states().filter(|state| state.kind() == kind);
        states.filter_map(|state| state.normal_force(contacts)).collect()
    };
    let solutions: Vec<_> = expected.solutions.iter().map(|solution| solution.normal_force.clone()).collect();
    let singular = expected.singular.iter().filter(|mode| is_own_set(mode)).count();
    let points_of_sets: Vec<&DVector<f64>> = expected
        .singular
        .iter()
        .filter(|mode| is_own_set(mode))
        .filter_map(|mode| if let SolutionSet::Point(point) = &mode.set { Some(point) } else { None })
        .collect();
    if !split || singular == 0 {
        assert!(
            same_points(&points(StateKind::Solution), &solutions),
            "{context}\n{:?}\n{solutions:?}",
            points(StateKind::Solution)
        );
        // The enumeration lists a gap state and the point of a singular pattern that is the same, the search one of them.
        let is_apart = |force: &DVector<f64>| !points_of_sets.iter().any(|point| close(point, force));
        let gaps = expected.gaps.iter().map(|gap| gap.normal_force.clone());
        let gaps: Vec<_> = gaps.filter(is_apart).collect();
        let found_gaps: Vec<_> = points(StateKind::Gap).into_iter().filter(is_apart).collect();
        assert!(same_points(&found_gaps, &gaps), "{context}\n{:?}\n{gaps:?}", points(StateKind::Gap));
    }
    if split {
        assert_eq!(found.counts().singular.is_zero(), singular == 0, "{context}");
    } else {
        let found_gaps = points(StateKind::Gap);
        let is_gap = |force: &DVector<f64>| found_gaps.iter().any(|gap| close(gap, force));
        let expected = singular - points_of_sets.iter().filter(|point| is_gap(point)).count();
        let also_gaps = points(StateKind::Singular).iter().filter(|point| is_gap(point)).count();
        let found = found.counts().singular.to_u64().map(|count| count - also_gaps as u64);
        assert_eq!(found, Some(expected as u64), "{context}");
    }
}

/// Every list of one state per contact, with gap states where the right-hand side jumps.
pub(crate) fn patterns(problem: &ModeProblem) -> Vec<Vec<ContactState>> {
    let mut all = vec![Vec::new()];
    for contact in 0..problem.contacts() {
        let states = [ContactState::Positive, ContactState::Negative, ContactState::Gap];
        let states = &states[..if problem.has_jump(contact) { 3 } else { 2 }];
        let extended = |pattern: &Vec<ContactState>| {
            let pattern = pattern.clone();
            states.iter().map(move |&state| [pattern.as_slice(), &[state]].concat())
        };
        all = all.iter().flat_map(extended).collect();
    }
    all
}
