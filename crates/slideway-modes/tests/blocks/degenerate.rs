//! Folds, locking directions, curves of solutions, and parts on which nothing acts.

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::Proof;
use slideway_modes::blocks::OpenLabel;

use crate::support::{Numbers, Plain, assert_proven, assert_same, unknowns};

fn one_hinge(e: [f64; 2], b: [f64; 2]) -> Plain {
    Plain::same(0, DMatrix::from_column_slice(2, 1, &e), DVector::from_column_slice(&b))
}

/// With `b = (-1, 0)` and `e = (2 cos t, 2 sin t)` the fold `|b x e| = |b|` is at `sin t = 1/2`; here `e = (3, 1)`:
/// `|b x e| = 1` exactly.
#[test]
fn an_exact_fold_is_told() {
    let result = one_hinge([3.0, 1.0], [-1.0, 0.0]).solve();
    assert_eq!(result.complete, Proof::NotProven);
    assert_eq!(result.open.len(), 1, "{:?}", result.open);
    let fold = &result.open[0];
    assert_eq!(fold.label, OpenLabel::Fold);
    // w = -|b|^2 / (b.e) = 1/3, x = b + e w = (0, 1/3)
    assert!((fold.point[0]).abs() < 1e-5 && (fold.point[1] - 1.0 / 3.0).abs() < 1e-5, "{:?}", fold.point);
    assert!(result.nodes < 400, "{}", result.nodes);
}

/// `e = (3, 1 -+ d)`: two solutions, or none.
#[test]
fn near_a_fold_solutions_are_told_apart() {
    for distance in [1e-2, 1e-5, 1e-8, 1e-10] {
        let two = one_hinge([3.0, 1.0 - distance], [-1.0, 0.0]).solve();
        assert_proven(&two);
        assert_eq!(two.solutions.len(), 2, "{distance}");
        let none = one_hinge([3.0, 1.0 + distance], [-1.0, 0.0]).solve();
        assert_proven(&none);
        assert_eq!(none.solutions.len(), 0, "{distance}");
    }
}

/// `|e| = 1`: solutions run to infinity along `e`. With `b.e < 0` one is left, otherwise none; the direction itself is told.
#[test]
fn a_locking_direction_is_told() {
    for (load, count) in [([0.5, -1.0], 1), ([0.5, 1.0], 0), ([1.0, 0.0], 0)] {
        let result = one_hinge([0.0, 1.0], load).solve();
        assert_eq!(result.solutions.len(), count, "{load:?}");
        assert!(result.open.len() <= 1 && result.nodes < 400, "{:?}", result.open);
        for region in &result.open {
            assert_eq!(region.label, OpenLabel::LockingDirection, "{load:?}");
            let [first, last] = region.sectors[0].unwrap();
            assert!(first[0] >= 0.0 && last[0] <= 0.0 && first[1] > 0.0 && region.half_angle < 1e-6);
        }
    }
}

/// Near `|e| = 1` the answer is that of the closed form.
#[test]
fn near_a_locking_direction_solutions_are_decided() {
    for distance in [1e-3, 1e-6, 1e-9] {
        for (size, load, count) in [
            (1.0 - distance, -1.0, 1),
            (1.0 - distance, 1.0, 1),
            (1.0 + distance, -1.0, 2),
            (1.0 + distance, 1.0, 0),
        ] {
            let result = one_hinge([0.6 * size, 0.8 * size], [0.6 * load, 0.8 * load]).solve();
            assert_proven(&result);
            assert_eq!(result.solutions.len(), count, "{distance} {size} {load}");
        }
    }
}

/// Without load: zero alone, or with rays `x = e w` if `|e| = 1`.
#[test]
fn without_load_there_are_zero_and_rays() {
    for size in [0.5, 1.5, 3.0] {
        let result = one_hinge([0.6 * size, 0.8 * size], [0.0, 0.0]).solve();
        assert_proven(&result);
        assert_eq!(result.solutions.len(), 1);
        assert_eq!((&result.solutions[0].unloaded[..], result.solutions[0].magnitudes[0]), (&[0][..], 0.0));
    }
    let ray = one_hinge([0.0, 1.0], [0.0, 0.0]).solve();
    assert_eq!((ray.solutions.len(), ray.open.len()), (1, 1), "{:?}", ray.open);
    assert_eq!(ray.open[0].label, OpenLabel::LockingDirection);
    let point = &ray.open[0].point;
    assert!(point[0].abs() < 1e-5 && point[1] == 1.0, "{point:?}");
}

/// `R_1 = -a + a |R_2|`, `R_2 = a - a |R_1|` with a unit vector `a`: every `|R_1| + |R_2| = 1`.
#[test]
fn a_curve_of_solutions_is_told() {
    let response = dmatrix![0.0, 1.0; 0.0, 0.0; -1.0, 0.0; 0.0, 0.0];
    let plain = Plain::same(0, response, dvector![-1.0, 0.0, 1.0, 0.0]);
    let result = plain.solve();
    assert_eq!(result.complete, Proof::NotProven);
    let curve = result.open.iter().find(|region| region.label == OpenLabel::Continuum).unwrap();
    let point = DVector::from_column_slice(&curve.point);
    assert!(plain.residual(&point).amax() < 1e-12, "{point}");
    assert!(result.nodes < 20_000, "{}", result.nodes);
}

/// A second hinge without load on which the first does not act: its reaction vanishes.
#[test]
fn parts_on_which_nothing_acts_are_at_rest() {
    let response = dmatrix![2.0, 0.3; 0.0, 0.4; 0.0, 1.7; 0.0, 0.2];
    let result = Plain::same(0, response, dvector![-1.0, 0.1, 0.0, 0.0]).solve();
    assert_proven(&result);
    assert_eq!(result.solutions.len(), 2);
    for solution in &result.solutions {
        assert_eq!(solution.reactions[1], [0.0; 2]);
        assert_eq!(solution.unloaded, [1]);
    }
}

#[test]
fn the_answer_does_not_depend_on_units() {
    let mut numbers = Numbers(17);
    for _ in 0..5 {
        let plain = Plain::random(&mut numbers, 1, 2, 1.0);
        let one = plain.solve();
        for factor in [1e-30, 1e-3, 1e6, 1e100] {
            let other = Plain { load: &plain.load * factor, ..plain.clone() }.solve();
            assert_eq!((one.nodes, one.complete), (other.nodes, other.complete));
            for (one, other) in one.solutions.iter().zip(&other.solutions) {
                let (one, other) = (unknowns(one), unknowns(other) / factor);
                assert!((&one - other).amax() <= 1e-9 * one.amax());
            }
            assert_eq!(one.solutions.len(), other.solutions.len());
        }
    }
}

/// Turning the frame of a hinge turns its reaction, and changes nothing else.
#[test]
fn the_answer_turns_with_the_frame() {
    let mut numbers = Numbers(19);
    for _ in 0..5 {
        let plain = Plain::random(&mut numbers, 1, 2, 1.0);
        // An exact rotation by a quarter turn, and a reflection, of the first hinge.
        for turn in [[0.0, -1.0, 1.0, 0.0], [1.0, 0.0, 0.0, -1.0]] {
            let mut frame = DMatrix::identity(5, 5);
            for (at, value) in turn.into_iter().enumerate() {
                frame[(1 + at / 2, 1 + at % 2)] = value;
            }
            let turned = Plain {
                contacts: 1,
                positive: &frame * &plain.positive,
                negative: &frame * &plain.negative,
                load: &frame * &plain.load,
            };
            let (one, mut other) = (plain.solve(), turned.solve());
            for solution in &mut other.solutions {
                let back = frame.transpose() * unknowns(solution);
                solution.reactions[0] = [back[1], back[2]];
            }
            assert_same(&one, &other);
        }
    }
}
