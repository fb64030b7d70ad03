//! Block problems as they are given in files: absolute value equations of blocks.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::raw_problem::{
    BlockEquation, EveryAnswer, RawProblem, RawReport, solve, solve_streaming,
};
use slideway_modes::{ModeProblemError, Proof, SearchOptions};

use crate::support::{Numbers, Plain, unknowns};

fn answer(raw: &RawProblem) -> RawReport {
    solve(raw, &SearchOptions::default(), 100, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn values(report: &RawReport) -> Vec<&[f64]> {
    report.solutions.iter().map(|solution| solution.unknowns.named()[0].1).collect()
}

/// `x + B |x| = b` as `A x + A B |x| = A b` for an `A` of small integers, with the blocks in another order.
#[test]
fn an_equation_has_the_solutions_of_the_block_problem() {
    let mut numbers = Numbers(5);
    for _ in 0..4 {
        // Multiples of 1/64, so that the products with the integers of `A` are not rounded.
        let round = |value: f64| (value * 64.0).round() / 64.0;
        let plain = Plain::opposed(&mut numbers, 1, 2);
        let response = plain.positive.map(round);
        let load = plain.load.map(round);
        let plain = Plain::same(1, response.clone(), load.clone());
        let expected = plain.solve();
        // Components of a hinge, the contact, the other hinge; and the blocks in that order.
        let (rows, blocks) = ([1, 2, 0, 3, 4], [1, 0, 2]);
        let b = -response.select_rows(&rows).select_columns(&blocks);
        let right = load.select_rows(&rows);
        let a = DMatrix::from_fn(5, 5, |row, column| match row.abs_diff(column) {
            0 => 3.0,
            1 => 1.0,
            _ => 0.0,
        });
        for (a, b, right) in [(None, b.clone(), right.clone()), (Some(a.clone()), &a * b, &a * right)] {
            let equation = BlockEquation::new(a, b, right, &[2, 1, 2]).unwrap();
            let report = answer(&RawProblem::BlockAbsoluteValue(Box::new(equation)));
            assert_eq!(report.complete, Proof::Proven);
            assert_eq!(report.count, expected.solutions.len().to_string());
            for solution in &expected.solutions {
                let x = unknowns(solution).select_rows(&rows);
                let near =
                    |found: &&[f64]| (DVector::from_column_slice(found) - &x).amax() <= 1e-9 * x.amax();
                assert!(values(&report).iter().any(near), "{x}");
            }
            let residuals = report.solutions.iter().map(|solution| solution.residual.unwrap());
            assert!(residuals.fold(0.0, f64::max) < 1e-14);
        }
    }
}

/// With blocks of one: 2 x + 3 |x| = 1 has x = 1/5 and x = -1 (columns 5 and -1 by the sign).
#[test]
fn blocks_of_one_are_an_absolute_value_equation() {
    let equation = BlockEquation::new(Some(dmatrix![2.0]), dmatrix![3.0], dvector![1.0], &[1]).unwrap();
    let raw = RawProblem::BlockAbsoluteValue(Box::new(equation));
    let ordinary =
        RawProblem::AbsoluteValue { a: dmatrix![2.0], b: dmatrix![3.0], right_hand_side: dvector![1.0] };
    for report in [answer(&raw), answer(&ordinary)] {
        let mut found: Vec<f64> = values(&report).iter().map(|x| x[0]).collect();
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), 2);
        assert!((found[0] + 1.0).abs() < 1e-15 && (found[1] - 0.2).abs() < 1e-15, "{found:?}");
    }
    assert_eq!(raw.mode_problem(), Err(ModeProblemError::Blocks));
}

/// `|e| < 1`: one solution for every load; `|e| > 1`: two or none (theory of hinges, section 2).
#[test]
fn one_solution_for_every_right_hand_side_is_proven_by_norms() {
    for (e, expected) in [(0.5, EveryAnswer::One), (2.0, EveryAnswer::NotComputed)] {
        let equation = BlockEquation::new(None, dmatrix![-e; 0.0], dvector![-1.0, 0.0], &[2]).unwrap();
        let raw = RawProblem::BlockAbsoluteValue(Box::new(equation));
        let every = raw.every_right_hand_side(&mut |_| ControlFlow::Continue(())).unwrap();
        assert_eq!(every.answer, expected);
    }
}

#[test]
fn a_stream_tells_every_solution_and_then_how_many() {
    let raw = RawProblem::from_json(br#"{"B": [[-2], [0]], "b": [-1, 0], "blocks": [2]}"#).unwrap();
    let mut lines = 0;
    let go = &mut |_: &_| ControlFlow::Continue(());
    let conclusion = solve_streaming(&raw, &SearchOptions::default(), 10, go, &mut |_| {
        lines += 1;
        ControlFlow::Continue(())
    });
    let conclusion = conclusion.unwrap();
    assert_eq!((lines, conclusion.lines, conclusion.report.count.as_str()), (2, 2, "2"));
    assert!(conclusion.all_written);
}

#[test]
fn what_is_no_equation_is_refused() {
    let new =
        |a, sizes: &[usize]| BlockEquation::new(a, DMatrix::zeros(3, 2), dvector![1.0, 2.0, 3.0], sizes);
    assert_eq!(new(None, &[3, 0]), Err(ModeProblemError::BlockSize { block: 0, size: 3 }));
    assert_eq!(new(None, &[2, 2]), Err(ModeProblemError::BlockSizes { found: 4, components: 3 }));
    assert_eq!(new(Some(DMatrix::zeros(3, 3)), &[1, 2]), Err(ModeProblemError::NotRegular));
    assert!(matches!(new(Some(DMatrix::zeros(2, 2)), &[1, 2]), Err(ModeProblemError::Shape { .. })));
}

/// Regular matrices that intervals do not show to be regular. In the first, `x = (-2 + 5 s/2, (2 - 1e300 x_1)/7, s)` with
/// `s = 5.5e-300` but for 1e-150 of it, by elimination in rationals for either sign of `x_1`; the second is off a
/// singular one by one rounding, with `x = (-1, 1)`; in the third `x_2` is beyond the range, in units of its own.
#[test]
fn a_matrix_in_doubt_is_decided_exactly() {
    let last = 1.0 + f64::EPSILON;
    let cases = [
        (
            dmatrix![5.0, 0.0, 2e300; 1e300, 7.0, 0.0; -1.0, 0.0, 1e154],
            dmatrix![0.0, 0.0; 0.0, 0.0; 0.5, 0.0],
            dvector![1.0, 2.0, 3.0],
            vec![1, 2],
            vec![-2.0, 2e300 / 7.0],
        ),
        (
            dmatrix![1.0, 1.0; 1.0, last],
            DMatrix::zeros(2, 1),
            dvector![0.0, f64::EPSILON],
            vec![2],
            vec![-1.0, 1.0],
        ),
        (dmatrix![1.0, 0.0; 1e300, 1e-300], DMatrix::zeros(2, 2), dvector![1.0, 1.0], vec![1, 1], vec![1.0]),
    ];
    for (a, b, right, sizes, expected) in cases {
        let equation = BlockEquation::new(Some(a), b, right, &sizes).unwrap();
        let report = answer(&RawProblem::BlockAbsoluteValue(Box::new(equation)));
        assert_eq!((report.complete, report.count.as_str()), (Proof::Proven, "1"));
        for (found, expected) in values(&report)[0].iter().zip(expected) {
            assert!((found - expected).abs() <= 1e-15 * expected.abs(), "{found} {expected}");
        }
    }
    let singular = BlockEquation::new(
        Some(dmatrix![1e300, 2e300; 1.0, 2.0]),
        DMatrix::zeros(2, 1),
        dvector![1.0, 1.0],
        &[2],
    );
    assert_eq!(singular, Err(ModeProblemError::NotRegular));
}

/// `x = (-5e-324, 2e-300)`, where bounds on the first component leave its sign open: so does the text.
#[test]
fn a_component_beyond_the_range_is_told_with_both_signs_if_its_sign_is_open() {
    let json = br#"{"type": "block_ave", "blocks": [2], "B": [[0], [-1e-300]], "b": [-5e-324, 2e-300]}"#;
    let report = answer(&RawProblem::from_json(json).unwrap());
    let [solution] = report.solutions.as_slice() else { panic!("one solution") };
    let [beyond] = solution.beyond_range.as_slice() else { panic!("one component") };
    let least = f64::MIN_POSITIVE;
    let expected = match solution.signs[0] {
        -1 => format!("between 0 and -{least:e}"),
        0 => format!("between -{least:e} and {least:e}"),
        sign => panic!("sign {sign}"),
    };
    assert_eq!((beyond.index, &beyond.value), (0, &expected));
}
