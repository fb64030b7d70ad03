//! Raw problems: no panic, and no number that is not finite.

use slideway::raw_problem::{RawKind, RawProblem};

use crate::answer::answer;
use crate::small::arrays;

/// Checks a raw problem of a type, with numbers of every size: the type, the sizes, then entries.
pub fn raw_extremes(bytes: &[u8]) {
    let [kind, rows, columns, entries @ ..] = bytes else { return };
    let kind = RawKind::ALL[usize::from(*kind) % RawKind::ALL.len()];
    let arrays = arrays(kind, [rows, columns].map(|size| 1 + usize::from(size % 3)), entries);
    if let Ok(problem) = RawProblem::from_arrays(kind, arrays) {
        answer(&problem);
    }
}

/// Checks any bytes as a raw problem (json): what is accepted is answered within the limits.
pub fn raw_json(bytes: &[u8]) {
    match RawProblem::from_json(bytes) {
        Ok(problem) => answer(&problem),
        Err(faults) => assert!(!faults.to_string().is_empty()),
    }
}

/// Checks any bytes as a raw problem (npz): what is accepted is answered within the limits.
pub fn raw_npz(bytes: &[u8]) {
    match RawProblem::from_npz(bytes) {
        Ok(problem) => answer(&problem),
        Err(faults) => assert!(!faults.to_string().is_empty()),
    }
}
