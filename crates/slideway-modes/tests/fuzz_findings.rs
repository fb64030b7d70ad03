//! What fuzzing found (`fuzz/`), so that it is not found again.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::certificate::{Decision, decide};
use slideway_modes::{
    Arguments, Completeness, ContactState, ModeProblem, SearchOptions, StateKind, exhaustive, search,
};

/// With `z_1` and `w_2, w_3` the equations are regular and solved by 0. The pivot of the last column is the
/// least of its scaled row by far.
#[test]
fn proof_of_all_patterns_keeps_a_boundary_behind_a_tiny_pivot() {
    for large in [1e10, 1e20, 1e300] {
        let m = -dmatrix![large, 0.0, 0.0; 3.0, 0.0, 0.0; large, 0.0, 0.0];
        let problem = ModeProblem::from_linear_complementarity(&m, DVector::zeros(3)).unwrap();
        let pattern = [ContactState::Positive, ContactState::Negative, ContactState::Negative];
        let expected = decide(&problem, &pattern);
        assert!(matches!(expected.decision, Decision::Boundary { .. }));
        assert!(
            exhaustive::prove(&problem)
                .contains(&(exhaustive::Pattern { gap: 0, negative: 0b110 }, expected)),
            "{large}"
        );
    }
}

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
