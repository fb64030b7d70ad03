//! Compares each bound with the worst case of numbers within their errors, which attains it except for
//! rounding.

use super::kernel::{Equation, Unknown};
use super::lanes::Lanes;
use super::layout::{CRAMER, LEVELS};
use super::leaf::{LeafErrors, error_of_determinants};
use super::level::{Level, Pivot, Row, bound_below};

const E: f64 = 1.0 / 1024.0;
/// Powers of two on both sides of the errors.
const SIZES: [f64; 5] = [0.0, 1.0 / 1024.0, 0.125, 1.0, 64.0];

fn all(value: f64) -> Lanes {
    Lanes([value; 8])
}

/// Bounds may exceed the worst case by rounding, but must not be below it.
fn check_attained(bound: f64, worst: f64) {
    assert!(bound >= worst * (1.0 - 1e-12), "{bound} is below {worst}");
    assert!(bound <= worst * 1.02 + 1e-9, "{bound} is far above {worst}");
}

/// `a - (c / p) r` with `a = 0`, `p = 1`, `c = -L`: all errors act in one direction.
#[test]
fn elimination_is_wrong_by_its_bound_at_most() {
    for factor in [0.0, 0.25, 1.0] {
        for row in SIZES {
            let worst = E + (factor + E) / (1.0 - E) * (row + E) - factor * row;
            let bound = bound_below(E, factor, 1.0 / (1.0 - E), row, 0.0, f64::EPSILON);
            check_attained(bound, worst);
        }
    }
}

/// If the entries are exact, the first step has the rounding errors of the factor, the product and the
/// difference.
#[test]
fn roundings_of_an_elimination_are_within_its_bound() {
    let u = f64::EPSILON / 2.0;
    for (factor, row, node) in [(1.0, 1.0, 1.0), (0.5, 8.0, 1.0), (1.0, 1.0, 64.0)] {
        let worst = 2.0 * u * row + u * factor * row + u * (node + factor * row);
        assert!(bound_below(0.0, factor, 1.0, row, node, f64::EPSILON) > worst);
    }
}

fn pivot(size: f64) -> Pivot {
    let entries: Row = [all(size); 2 * LEVELS + 1];
    let (inverse, bound) = (all(1.0), all(E));
    Pivot { entries, inverse, bound, guard: all(1.0 / (1.0 - E)), size: all(size) }
}

/// `y = b + k c y'` with a pivot of 1, where `b`, `c`, `y'` grow and the pivot shrinks.
#[test]
fn back_substitution_is_wrong_by_its_bound_at_most() {
    for size in SIZES {
        for (largest, error) in [(0.0, E), (1.0, 0.0), (1.0, 0.125), (100.0, E), (E, 4.0)] {
            for others in [0_u8, 1, 5, 11] {
                let count = f64::from(others);
                let y = size + count * size * largest;
                let worst = (size + E + count * (size + E) * (largest + error)) / (1.0 - E) - y;
                let bound = pivot(size).error_of_y(count, all(y), all(largest), all(error));
                check_attained(bound.0[7], worst);

                let unknowns: Vec<Unknown> = (0..others).map(|_| Unknown { value: largest, error }).collect();
                let equation = Equation { load: size, pivot: 1.0, bound: E };
                let solved = equation.solve(std::iter::repeat(-size), &unknowns);
                assert_eq!(solved.value, y);
                check_attained(solved.error, worst);
            }
        }
    }
}

#[test]
fn an_unknown_whose_pivot_may_be_zero_may_be_anything() {
    for bound in [1.0, 2.0, f64::INFINITY] {
        let equation = Equation { load: -1.0, pivot: 1.0, bound };
        assert_eq!(equation.solve(std::iter::empty(), &[]).error, f64::INFINITY);
    }
}

fn determinant(m: [[f64; 3]; 3]) -> f64 {
    let minor = |i: usize, j: usize| m[1][i] * m[2][j] - m[1][j] * m[2][i];
    m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
}

/// Half of the bound would be insufficient for the largest determinant with entries `+-1`.
#[test]
fn determinants_are_wrong_by_their_bound_at_most() {
    let signs = [[1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];
    for a in SIZES {
        for e in [0.001, 1.0, 8.0] {
            let of_size = |size: f64| determinant(signs.map(|row| row.map(|sign| sign * size)));
            let worst = of_size(a + e) - of_size(a);
            let bound = error_of_determinants(all(a), all(e)).0[0];
            assert!(bound >= worst && bound < 1.6 * worst, "{bound}, {worst}");
        }
    }
}

/// `p x = b D + sum c_i x_i` with `p = 1`, for the greatest `D` and `x_i` that the bounds allow.
#[test]
fn multiples_of_the_determinant_are_wrong_by_their_bounds_at_most() {
    for (size, entry, bound) in [(0.001, 1.0, E), (1.0, 0.125, E), (4.0, 1.0, 1e-9), (0.0, 1.0, E)] {
        let node = Level { rows: vec![[all(entry); 2 * LEVELS + 1]; 3], bound: all(bound), size: all(entry) };
        let bounds = LeafErrors::new(&node, &vec![pivot(size); LEVELS]);
        let (mut x, mut error) = (6.0 * entry.powi(3), bounds.determinant.0[0]);
        for (place, later) in (CRAMER..).zip(bounds.later) {
            let terms = place as f64 + 1.0;
            let value = terms * size * x;
            let worst = terms * (size + E) * (x + error) / (1.0 - E) - value;
            check_attained(later.0[0], worst);
            (x, error) = (x.max(value / (1.0 - E)), error.max(later.0[0]));
        }
    }
}
