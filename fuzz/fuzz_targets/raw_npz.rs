//! Any bytes as a raw problem (npz): no panic, and what is accepted is answered within the limits.
#![no_main]

use libfuzzer_sys::fuzz_target;
use slideway::raw_problem::RawProblem;

fuzz_target!(|bytes: &[u8]| {
    match RawProblem::from_npz(bytes) {
        Ok(problem) => slideway_fuzz::answer(&problem),
        Err(faults) => assert!(!faults.to_string().is_empty()),
    }
});
