//! Small mode problems from bytes: whole numbers and awkward fractions.

use nalgebra::{DMatrix, DVector};
use slideway::modes::{Arguments, ContactState, ModeProblem, SearchOptions};
use slideway::raw_problem::RawKind;

/// What a byte stands for; small whole numbers are the most frequent.
const AWKWARD: [f64; 32] = [
    0.5,
    -0.5,
    0.1,
    -0.1,
    1.0 / 3.0,
    0.3,
    1.0 + f64::EPSILON,
    1.0 - f64::EPSILON,
    -1.0 - f64::EPSILON,
    f64::EPSILON,
    -f64::EPSILON,
    1e-9,
    -1e-9,
    1e-12,
    -1e-12,
    1e-16,
    1e-30,
    -1e-30,
    1e-150,
    1e-300,
    -1e-300,
    f64::MIN_POSITIVE,
    5e-324,
    -5e-324,
    -0.0,
    1e9,
    -1e9,
    1e16,
    9_007_199_254_740_993.0,
    1e150,
    -1e300,
    f64::MAX,
];
const MOST_CONTACTS: usize = 4;

fn entry(byte: u8) -> f64 {
    match byte {
        0..=223 => f64::from(byte % 7) - 3.0,
        _ => AWKWARD[usize::from(byte - 224)],
    }
}

/// A small mode problem and options from bytes: the size, the form, then entries; what is missing is 0.
pub(crate) fn problem(bytes: &[u8]) -> Option<(ModeProblem, SearchOptions)> {
    let (&head, rest) = bytes.split_first()?;
    let (&switches, entries) = rest.split_first()?;
    let size = 1 + usize::from(head) % MOST_CONTACTS;
    let mut entries = entries.iter().copied().map(entry).chain(std::iter::repeat(0.0));
    let mut matrix = || DMatrix::from_iterator(size, size, entries.by_ref().take(size * size));
    let (one, other) = (matrix(), matrix());
    let jumps = match head / 4 % 4 {
        3 => [matrix(), matrix()],
        _ => [DMatrix::zeros(size, size), DMatrix::zeros(size, size)],
    };
    let load = DVector::from_iterator(size, entries.by_ref().take(size));
    let problem = match head / 4 % 4 {
        0 => ModeProblem::from_linear_complementarity(&one, load),
        1 => ModeProblem::from_absolute_value_equation(&one, &other, load),
        _ => {
            let [positive, negative] = jumps;
            ModeProblem::new(one, other, positive, negative, load)
        }
    };
    let arguments = Arguments {
        groups: switches & 1 == 0,
        propagation: switches & 2 == 0,
        uniqueness: switches & 4 == 0,
        low_rank: switches & 8 == 0,
        every_pattern: switches & 16 == 0,
        faces: switches & 32 == 0,
    };
    let options = SearchOptions { nodes: 2000, arguments, ..SearchOptions::default() };
    Some((problem.ok()?, options))
}

/// The arrays of a raw problem of a type, with sizes from 1 to 3, from bytes; what is missing is 0.
pub(crate) fn arrays(
    kind: RawKind,
    [n, m]: [usize; 2],
    bytes: &[u8],
) -> Vec<(&'static str, Vec<usize>, Vec<f64>)> {
    let mut entries = bytes.iter().copied().map(entry).chain(std::iter::repeat(0.0));
    // One block of one component, the others of two.
    let components = 2 * n - 1;
    let sizes = |name| match (kind, name) {
        (_, "blocks") => vec![n],
        (RawKind::BlockAve, "b") => vec![components],
        (RawKind::BlockAve, "B") => vec![components, n],
        (RawKind::BlockAve, _) => vec![components, components],
        (RawKind::Game, _) | (RawKind::Mlcp, "C") => vec![n, m],
        (RawKind::Mlcp, "B") => vec![m, m],
        (RawKind::Mlcp, "D") => vec![m, n],
        (RawKind::Mlcp, "b") => vec![m],
        (_, "a" | "b" | "q" | "l" | "u" | "right_hand_side") => vec![n],
        _ => vec![n, n],
    };
    let mut array = |name| {
        let sizes: Vec<usize> = sizes(name);
        let values: Vec<f64> = match name {
            "blocks" => (0..n).map(|block| if block == 0 { 1.0 } else { 2.0 }).collect(),
            _ => entries.by_ref().take(sizes.iter().product()).collect(),
        };
        (name, sizes, values)
    };
    kind.names().into_iter().map(&mut array).collect()
}

/// All patterns, with the gap where there is a jump.
pub(crate) fn patterns(problem: &ModeProblem) -> Vec<Vec<ContactState>> {
    let mut all = vec![Vec::new()];
    for contact in 0..problem.contacts() {
        let mut states = vec![ContactState::Positive, ContactState::Negative];
        if problem.has_jump(contact) {
            states.push(ContactState::Gap);
        }
        all = all
            .iter()
            .flat_map(|pattern| states.iter().map(|&state| [pattern.as_slice(), &[state]].concat()))
            .collect();
    }
    all
}
