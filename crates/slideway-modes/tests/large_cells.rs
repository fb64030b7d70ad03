//! Sets of solutions with more corners than are listed: complete, told by parts that vary independently.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};
use slideway_modes::raw_problem::{ContinuumPart, RawProblem, RawReport, Unknowns, solve};
use slideway_modes::{Proof, SearchOptions, Status};

/// The problem whose solutions are `z >= 0` with `S z = s`, if there are any: `w = S^T K (S z - s)` with
/// `K = I + 1 1^T`. `M = S^T K S` is positive semidefinite and `K` regular, so that all solutions have the same `S z`
/// (Cottle, Pang, Stone, theorem 3.1.7). One group, because `K` is dense.
fn with_solutions(s: &DMatrix<f64>, right: &DVector<f64>) -> RawProblem {
    let k = DMatrix::identity(s.nrows(), s.nrows()) + DMatrix::repeat(s.nrows(), s.nrows(), 1.0);
    RawProblem::LinearComplementarity { m: s.transpose() * &k * s, q: -(s.transpose() * &k * right) }
}

/// `x_k + s_k = 1` for each of `dimension` unknowns.
fn cube(dimension: usize) -> DMatrix<f64> {
    DMatrix::from_fn(dimension, 2 * dimension, |row, at| f64::from(u8::from(at % dimension == row)))
}

fn only_continuum(problem: &RawProblem) -> (RawReport, Vec<ContinuumPart>) {
    let report =
        solve(problem, &SearchOptions::default(), 10, &mut |_| ControlFlow::Continue(())).expect("finite");
    assert_eq!((report.status, report.complete, report.partial), (Status::Continuum, Proof::Proven, false));
    assert_eq!((report.count.as_str(), report.continuum_count.as_str()), ("0", "1"));
    let parts = report.continua[0].parts.clone();
    (report, parts)
}

/// A cube of dimension 13 has 8192 vertices, and 13 parts, each a segment.
#[test]
fn a_cube_is_told_edge_by_edge() {
    let (_, parts) = only_continuum(&with_solutions(&cube(13), &DVector::repeat(13, 1.0)));
    assert_eq!(parts.len(), 13);
    for (at, part) in parts.iter().enumerate() {
        assert_eq!(
            (part.indices.as_slice(), part.vertex_count, part.dimension),
            (&[at, at + 13][..], 2, None)
        );
        let end = |z: [f64; 2]| Unknowns::Complementary { z: z.to_vec(), w: vec![0.0; 2] };
        assert!(part.vertices.contains(&end([0.0, 1.0])) && part.vertices.contains(&end([1.0, 0.0])));
    }
}

/// The same cube cut by `sum x <= 13/2` has no independent parts: 4096 vertices have `sum x <= 6`, and others are on
/// the cut. Beside it there is a fixed unknown.
#[test]
fn a_part_with_too_many_corners_has_a_dimension_and_a_point_inside() {
    let mut s = cube(13).resize(15, 28, 0.0);
    s.view_mut((13, 0), (1, 13)).fill(2.0);
    s[(13, 26)] = 1.0;
    s[(14, 27)] = 1.0;
    let mut right = DVector::repeat(15, 1.0);
    right[13] = 13.0;
    let (_, parts) = only_continuum(&with_solutions(&s, &right));
    let [part, fixed] = parts.as_slice() else { panic!("two parts: {parts:?}") };
    assert_eq!((&part.indices, part.dimension), (&(0..27).collect(), Some(13)));
    assert_eq!((part.vertex_count, part.direction_count, part.vertices.len()), (0, 0, 0));
    let Some(Unknowns::Complementary { z, w }) = &part.inside else { panic!("a point inside") };
    assert!(w.iter().all(|&value| value == 0.0) && z.iter().all(|&value| value > 0.0));
    let off = s.columns(0, 27) * DVector::from_column_slice(z) - right.rows(0, 15);
    assert!(off.rows(0, 14).amax() < 1e-14, "{off}");
    assert_eq!(fixed.vertices, [Unknowns::Complementary { z: vec![1.0], w: vec![0.0] }]);
}
