//! One hinge against its closed form, in rational numbers.
//!
//! Squaring `|b + e w| = w` gives `(1 - |e|^2) w^2 - 2 (b.e) w - |b|^2 = 0`, whose roots `w > 0` are the
//! solutions. Its coefficients and its discriminant `|b|^2 - (b x e)^2` (times 4) are exact for small integers over 16,
//! so that the number of positive roots follows without rounding.

use nalgebra::{DMatrix, DVector};

use crate::support::{Numbers, Plain, assert_proven};

/// Twice the coefficients and the discriminant, in units of 16^-4: exact.
struct Quadratic {
    square: i64,
    product: i64,
    load: i64,
    discriminant: i64,
}

impl Quadratic {
    fn new(b: [i64; 2], e: [i64; 2]) -> Self {
        let unit = 256;
        let load = b[0] * b[0] + b[1] * b[1];
        let cross = b[0] * e[1] - b[1] * e[0];
        Self {
            square: unit - e[0] * e[0] - e[1] * e[1],
            product: b[0] * e[0] + b[1] * e[1],
            load,
            discriminant: unit * load - cross * cross,
        }
    }

    /// The number of positive roots; `None` if two merge.
    ///
    /// `|e| < 1`: one. `|e| = 1`: one if `b.e < 0`. `|e| > 1`: two if `b.e < 0` and the discriminant is positive.
    fn count(&self) -> Option<usize> {
        match self.square.signum() {
            1 => Some(1),
            0 => Some(usize::from(self.product < 0)),
            _ if self.product >= 0 || self.discriminant < 0 => Some(0),
            _ => (self.discriminant > 0).then_some(2),
        }
    }
}

#[test]
fn the_number_of_solutions_is_that_of_the_closed_form() {
    let mut numbers = Numbers(1);
    #[expect(clippy::cast_possible_truncation, reason = "these are small integers")]
    let mut integer = |most: f64| (numbers.next() * most).round() as i64;
    let mut counts = [0; 3];
    for _ in 0..2000 {
        let (b, e) = ([integer(40.0), integer(40.0)], [integer(40.0), integer(40.0)]);
        let exact = Quadratic::new(b, e);
        // No load, folds, and loads along a locking direction have tests of their own.
        let Some(count) = exact.count().filter(|_| exact.load > 0 && exact.square != 0) else { continue };
        let vector = |of: [i64; 2]| of.map(|value| value as f64 / 16.0);
        let response = DMatrix::from_column_slice(2, 1, &vector(e));
        let result = Plain::same(0, response, DVector::from_column_slice(&vector(b))).solve();
        assert_proven(&result);
        assert_eq!(result.solutions.len(), count, "{b:?} {e:?}");
        counts[count] += 1;
        for solution in &result.solutions {
            let w = solution.magnitudes[0] * 16.0;
            let [square, product, load] = [exact.square, exact.product, exact.load].map(|value| value as f64);
            let value = square / 256.0 * w * w - product / 8.0 * w - load;
            let size = square.abs() / 256.0 * w * w + product.abs() / 8.0 * w + load;
            // The value at a point within `radius` of the root in both components, and its rounding.
            let slope = (square / 128.0 * w - product / 8.0).abs();
            let within = slope * 16.0 * 2.0 * solution.radius + 8.0 * f64::EPSILON * size;
            assert!(value.abs() <= within && solution.radius <= 1e-9 * w, "{value} {within}");
        }
    }
    assert!(counts.iter().all(|&count| count > 50), "{counts:?}");
}
