//! Blocks without friction, which act on no other.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::blocks::{BlockProblem, OpenLabel, search};
use slideway_modes::certificate::IntervalMatrix;
use slideway_modes::{BySide, Proof, SearchOptions};

use crate::support::{Numbers, Plain, assert_proven, degree, unknowns};

/// Contact 0 acts on none, hinge 0 on contact 0 alone.
fn with_smooth_blocks(numbers: &mut Numbers) -> Plain {
    let mut plain = Plain::opposed(numbers, 2, 2);
    for part in [&mut plain.positive, &mut plain.negative] {
        part.column_mut(0).fill(0.0);
        part.column_mut(2).rows_mut(1, 5).fill(0.0);
    }
    plain
}

/// Contact 1 and hinge 1 of it.
fn rough_part(plain: &Plain) -> Plain {
    let part = |matrix: &DMatrix<f64>| matrix.select_rows(&[1, 4, 5]).select_columns(&[1, 3]);
    Plain {
        contacts: 1,
        positive: part(&plain.positive),
        negative: part(&plain.negative),
        load: plain.load.select_rows(&[1, 4, 5]),
    }
}

#[test]
fn there_are_as_many_solutions_as_without_them() {
    let mut numbers = Numbers(41);
    for _ in 0..20 {
        let plain = with_smooth_blocks(&mut numbers);
        let (all, alone) = (plain.solve(), rough_part(&plain).solve());
        assert_proven(&all);
        assert_eq!(
            (all.solutions.len(), all.nodes, degree(&all)),
            (alone.solutions.len(), alone.nodes, degree(&alone))
        );
        for solution in &alone.solutions {
            let x = unknowns(solution);
            let is_it =
                |other: &DVector<f64>| (other.select_rows(&[1, 4, 5]) - &x).amax() <= 1e-12 * x.amax();
            assert!(all.solutions.iter().any(|other| is_it(&unknowns(other))), "{x}");
        }
    }
}

/// `R = (-2 - 1.5 w, 0)` has no solution. Two smooth contacts carry the couple, with rounding in all zeros.
#[test]
fn beside_smooth_contacts_and_rounding_no_solution_is_proven() {
    let tiny = 9.184_850_993_605_15e-17;
    let response = dmatrix![
        0.0, 0.0, -0.5625;
        0.0, 0.0, 0.562_499_999_999_999_9;
        0.0, 0.0, -1.5;
        0.0, 0.0, -tiny
    ];
    let load = dvector![tiny / 3.0, tiny / 3.0, -1.999_999_999_999_999_8, tiny / 1.5];
    let result = Plain::same(2, response, load).solve();
    assert_proven(&result);
    assert!(result.solutions.is_empty());
}

/// A hinge without load beside a smooth contact with a load: its reaction is zero, or runs to infinity if `|e| = 1`.
#[test]
fn the_others_may_have_no_load() {
    for (size, rays) in [(0.5, 0), (1.5, 0), (1.0, 1)] {
        let result =
            Plain::same(1, dmatrix![0.0, 0.5; 0.0, 0.0; 0.0, size], dvector![-3.0, 0.0, 0.0]).solve();
        assert_eq!((result.solutions.len(), result.open.len()), (1, rays), "{:?}", result.open);
        assert_eq!((result.solutions[0].forces[0], result.solutions[0].reactions[0]), (-3.0, [0.0; 2]));
        for ray in &result.open {
            assert_eq!(ray.label, OpenLabel::LockingDirection);
            let [contact, across, along] = ray.point[..] else { panic!("{:?}", ray.point) };
            assert!((contact - 0.5 * along).abs() <= 1e-5 * along && across.abs() <= 1e-5 * along);
        }
    }
}

/// The forces of problems within the bounds lie within those that are proven.
#[test]
fn their_forces_have_bounds() {
    let (mut numbers, radius) = (Numbers(43), 1e-4);
    let mut solved = 0;
    for _ in 0..10 {
        let plain = with_smooth_blocks(&mut numbers);
        let around = |matrix: &DMatrix<f64>| {
            IntervalMatrix::around(matrix.clone(), matrix.map(|value| value.abs() * radius)).unwrap()
        };
        let response = BySide { positive: around(&plain.positive), negative: around(&plain.negative) };
        let jumps = BySide::same(IntervalMatrix::exact(DMatrix::zeros(6, 2)));
        let load = around(&DMatrix::from_column_slice(6, 1, plain.load.as_slice()));
        let problem = BlockProblem::within_bounds(response, jumps, load).unwrap();
        let bounds = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
        if bounds.complete != Proof::Proven {
            continue;
        }
        solved += 1;
        for _ in 0..5 {
            let mut near = plain.clone();
            for part in [&mut near.positive, &mut near.negative] {
                part.columns_mut(0, 4).apply(|value| *value *= 1.0 + 0.99 * radius * numbers.next());
            }
            near.negative.columns_mut(2, 2).copy_from(&near.positive.columns(2, 2));
            near.load.apply(|value| *value *= 1.0 + 0.99 * radius * numbers.next());
            let instance = near.solve();
            assert_eq!(instance.solutions.len(), bounds.solutions.len());
            for x in instance.solutions.iter().map(unknowns) {
                let holds = |solution: &slideway_modes::blocks::BlockSolution| {
                    solution.enclosure.iter().zip(&x).all(|(bound, value)| bound.contains(*value))
                };
                assert!(bounds.solutions.iter().any(holds), "{x}");
            }
        }
    }
    assert!(solved >= 5, "{solved}");
}

/// `x = b`.
#[test]
fn without_any_friction_nothing_is_searched() {
    let load = dvector![3.0, -4.0, 0.0, 1.0];
    let result = Plain::same(2, DMatrix::zeros(4, 3), load.clone()).solve();
    assert_proven(&result);
    assert_eq!((result.nodes, degree(&result)), (1, 1));
    assert_eq!(unknowns(&result.solutions[0]), load);
}
