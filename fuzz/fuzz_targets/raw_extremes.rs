//! Raw problems of every type with numbers of every size: no panic, and no number that is not finite.
#![no_main]

use libfuzzer_sys::fuzz_target;
use slideway::raw_problem::{RawKind, RawProblem};

fuzz_target!(|bytes: &[u8]| {
    let [kind, rows, columns, entries @ ..] = bytes else { return };
    let kind = RawKind::ALL[usize::from(*kind) % RawKind::ALL.len()];
    let arrays = slideway_fuzz::arrays(kind, [rows, columns].map(|size| 1 + usize::from(size % 3)), entries);
    if let Ok(problem) = RawProblem::from_arrays(kind, arrays) {
        slideway_fuzz::answer(&problem);
    }
});
