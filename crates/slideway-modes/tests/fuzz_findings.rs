//! What fuzzing found (`fuzz/`), so that it is not found again.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::ops::ControlFlow;

use nalgebra::{DMatrix, dmatrix, dvector};
use slideway_modes::{Arguments, Completeness, ModeProblem, SearchOptions, StateKind, search};

/// `2^53 y = 3` or `2^-1022 y = 3`: both have a finite solution. The ratio of the two columns is below the
/// range of floating point.
#[test]
fn search_does_not_lose_a_column_to_underflow() {
    let none = DMatrix::zeros(1, 1);
    let (one, other) = (dmatrix![9_007_199_254_740_992.0], dmatrix![f64::MIN_POSITIVE]);
    let problem = ModeProblem::new(one, other, none.clone(), none, dvector![3.0]).unwrap();
    for every_pattern in [true, false] {
        let arguments = Arguments { every_pattern, ..Arguments::default() };
        let options = SearchOptions { arguments, ..SearchOptions::default() };
        let result = search(&problem, &options, &mut |_| ControlFlow::Continue(()));
        let found = result.product.states().filter(|state| state.kind() == StateKind::Solution).count();
        assert_eq!((found, result.completeness), (2, Completeness::Proven), "{result:?}");
    }
}
