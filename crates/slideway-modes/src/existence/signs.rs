//! Signs that a determinant and Cramer numerators keep throughout a range: if a sign is certain, there is no
//! zero to search for.

use super::line::TOLERANCE;
use super::roots::Reduced;
use nalgebra::{DMatrix, DVector};

/// Maximum number of varying columns for which polynomials are formed.
const MOST_COLUMNS: usize = 4;
/// Number of coefficients of the polynomials: the degree of a numerator is one more than the number of
/// varying columns.
const LENGTH: usize = MOST_COLUMNS + 2;

/// Coefficients, the constant first.
type Polynomial = [f64; LENGTH];

/// 1 or -1; `None` if the sign changes, or is too close to changing to tell.
type CertainSign = Option<f64>;

/// Signs throughout a range.
pub(super) struct Signs {
    /// The sign of `det(I + tau K)`.
    pub(super) determinant: CertainSign,
    /// The signs of the conditions' numerators, which are their values times that determinant.
    pub(super) numerators: Vec<CertainSign>,
}

impl Signs {
    /// Whether some condition is violated throughout.
    pub(super) fn exclude(&self) -> bool {
        self.determinant
            .is_some_and(|determinant| self.numerators.iter().any(|sign| *sign == Some(-determinant)))
    }
}

/// `det(I + tau K)` and `adj(I + tau K) s` for the sources `s`, by the recursion of Faddeev and LeVerrier:
///
/// ```text
/// e_0 = 1,  B_0 = I,  e_j = tr(K B_(j-1)) / j,  B_j = e_j I - K B_(j-1)
/// det(I + tau K) = sum e_j tau^j,  adj(I + tau K) = sum B_j tau^j
/// ```
struct Expansion {
    determinant: Polynomial,
    /// `B_j s_0` and `B_j s_1`.
    answers: Vec<[DVector<f64>; 2]>,
}

impl Expansion {
    fn new(k: &DMatrix<f64>, sources: &[DVector<f64>; 2]) -> Self {
        let size = k.nrows();
        let mut determinant = [0.0; LENGTH];
        determinant[0] = 1.0;
        let mut answers = Vec::with_capacity(size);
        let mut adjugate = DMatrix::identity(size, size);
        for (power, coefficient) in determinant.iter_mut().enumerate().take(size + 1).skip(1) {
            answers.push([&adjugate * &sources[0], &adjugate * &sources[1]]);
            let product = k * &adjugate;
            *coefficient = product.trace() / power as f64;
            adjugate = -product;
            (0..size).for_each(|place| adjugate[(place, place)] += *coefficient);
        }
        Self { determinant, answers }
    }
}

impl Reduced {
    /// The signs in a range that contains the base point; nothing is certain if there are many varying
    /// columns.
    pub(super) fn signs(&self, range: [f64; 2]) -> Signs {
        let columns = self.k.nrows();
        if columns > MOST_COLUMNS {
            return Signs { determinant: None, numerators: vec![None; self.conditions()] };
        }
        let taus = range.map(|at| at - self.base);
        let reach = taus[0].abs().max(taus[1].abs());
        let expansion = Expansion::new(&self.k, &self.sources);
        // |det(I + tau K)| <= growth^m, and entries of its adjugate are at most growth^(m-1).
        let growth = 1.0 + reach * columns as f64 * self.k.amax();
        let power = |count: usize| (0..count).map(|_| growth).product::<f64>();
        let source = self.sources[0].lp_norm(1) + reach * self.sources[1].lp_norm(1);
        let numerator = |condition: usize| {
            if self.equalities[condition] {
                return None;
            }
            let linear = reach * self.values[1][condition].abs();
            let coupling = reach * self.couplings.row(condition).lp_norm(1);
            let size = (self.magnitudes[condition] + linear) * power(columns)
                + coupling * power(columns.saturating_sub(1)) * source;
            sign(&self.numerator(condition, &expansion), columns + 1, taus, size)
        };
        Signs {
            determinant: sign(&expansion.determinant, columns, taus, power(columns)),
            numerators: (0..self.conditions()).map(numerator).collect(),
        }
    }

    /// `(w . z + offset) det(I + tau K)
    /// = (value_0 + tau value_1) det(I + tau K) - tau (w . X) adj(I + tau K) (s_0 + tau s_1)`.
    fn numerator(&self, condition: usize, expansion: &Expansion) -> Polynomial {
        let mut numerator = [0.0; LENGTH];
        for (power, coefficient) in expansion.determinant[..LENGTH - 1].iter().enumerate() {
            numerator[power] += self.values[0][condition] * coefficient;
            numerator[power + 1] += self.values[1][condition] * coefficient;
        }
        let coupling = self.couplings.row(condition);
        for (power, answers) in expansion.answers.iter().enumerate() {
            for (rise, answer) in answers.iter().enumerate() {
                let product: f64 = coupling.iter().zip(answer).map(|(one, other)| one * other).sum();
                numerator[power + 1 + rise] -= product;
            }
        }
        numerator
    }
}

/// The sign of a polynomial whose terms have this size, throughout an interval: the common sign of all its
/// Bernstein coefficients.
fn sign(polynomial: &Polynomial, degree: usize, [from, to]: [f64; 2], size: f64) -> CertainSign {
    let mut shifted = *polynomial;
    // Horner's scheme: in powers of tau - from.
    for first in 0..degree {
        for power in (first..degree).rev() {
            shifted[power] += from * shifted[power + 1];
        }
    }
    // In powers of s = (tau - from) / (to - from), divided by binomial coefficients; the Bernstein
    // coefficients are then sums of (i over k) times these.
    let mut scale = 1.0;
    for (power, coefficient) in shifted.iter_mut().enumerate().take(degree + 1) {
        *coefficient *= scale;
        scale *= (to - from) * (power as f64 + 1.0) / (degree - power).max(1) as f64;
    }
    for first in 0..degree {
        for power in (first + 1..=degree).rev() {
            shifted[power] += shifted[power - 1];
        }
    }
    let (least, greatest) =
        shifted[..=degree].iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, greatest), &one| {
            (least.min(one), greatest.max(one))
        });
    // A condition counts as violated beyond its tolerance.
    let slack = 4.0 * TOLERANCE * size;
    if least > slack {
        Some(1.0)
    } else if greatest < -slack {
        Some(-1.0)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::line::{Condition, Line, TOLERANCE};
    use super::*;
    use crate::random_numbers::random_numbers;

    /// The oracle consists of determinants and solutions computed by elimination at many places.
    #[test]
    fn certain_signs_are_those_of_determinants_and_solutions() {
        let mut random = random_numbers(11);
        let (mut certain, mut excluded, mut open) = (0, 0, 0);
        for round in 0..2000 {
            let (size, varying) = (1 + round % 5, 1 + round % 4);
            let matrix = DMatrix::from_fn(size, size, |i, k| random() + if i == k { 1.5 } else { 0.0 });
            let slope = DMatrix::from_fn(size, size, |_, k| if k < varying { random() } else { 0.0 });
            let right_hand_side = [0, 1].map(|_| DVector::from_fn(size, |_, _| random()));
            let line = Line { matrix: [matrix, slope], right_hand_side };
            let conditions: Vec<Condition> = (0..size)
                .map(|k| Condition { weights: [(k, 1.0), (0, 0.3 * random())], offset: 0.2 * random() })
                .collect();
            let (base, range) = (0.3, [0.0, 1.2]);
            let lu = line.matrix_at(base).lu();
            let Some(reduced) = Reduced::new(&line, &conditions, base, &lu) else { continue };
            let signs = reduced.signs(range);
            let at_base = line.matrix_at(base).determinant();
            for step in 0..=60 {
                let at = 0.02 * f64::from(step);
                let determinant = line.matrix_at(at).determinant() / at_base;
                let Some(solution) = line.solution(at) else { continue };
                if let Some(sign) = signs.determinant {
                    assert!(sign * determinant > 0.0, "round {round} at {at}: {determinant}");
                }
                let values: Vec<f64> = conditions
                    .iter()
                    .map(|condition| condition.times(solution.as_slice()) + condition.offset)
                    .collect();
                for (value, sign) in values.iter().zip(&signs.numerators) {
                    let Some(sign) = sign else { continue };
                    assert!(sign * value * determinant > 0.0, "round {round} at {at}: {value}");
                }
                let is_met = values.iter().all(|value| *value >= -TOLERANCE);
                assert!(!(signs.exclude() && is_met), "round {round}: a solution at {at}");
            }
            certain += signs.numerators.iter().flatten().count();
            open += signs.numerators.iter().filter(|sign| sign.is_none()).count();
            excluded += usize::from(signs.exclude());
        }
        assert!(certain > 3000 && open > 500 && excluded > 500, "{certain}, {open}, {excluded}");
    }

    /// (1 - tau)(3 - tau) touches or crosses zero in intervals containing 1 or 3, and is negative between
    /// them.
    #[test]
    fn signs_of_a_parabola() {
        let parabola = [3.0, -4.0, 1.0, 0.0, 0.0, 0.0];
        let sign_in = |from: f64, to: f64| sign(&parabola, 2, [from, to], 10.0);
        assert_eq!(sign_in(-1.0, 0.9), Some(1.0));
        assert_eq!(sign_in(1.1, 2.9), Some(-1.0));
        assert_eq!(sign_in(3.1, 50.0), Some(1.0));
        assert_eq!(sign_in(0.0, 1.0), None);
        assert_eq!(sign_in(0.5, 1.5), None);
        assert_eq!(sign(&[1e-12, 0.0, 0.0, 0.0, 0.0, 0.0], 2, [0.0, 1.0], 1.0), None);
    }
}
