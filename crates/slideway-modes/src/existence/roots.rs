//! Zeros of determinants and of Cramer numerators along a line of parameters.

use nalgebra::{Complex, DMatrix, DVector, Dyn, LU, Schur};

use super::line::{Condition, Line, Value, pivot_ratio};

/// An eigenvalue whose imaginary part is below this fraction of it may be a double real one.
const REAL: f64 = 1e-5;
/// Tolerances of the iteration for eigenvalues, which are polished afterwards: larger ones are used if it
/// fails.
const TOLERANCES: [f64; 3] = [f64::EPSILON, 8.0 * f64::EPSILON, 64.0 * f64::EPSILON];
/// Iteration steps per eigenvalue.
const STEPS: usize = 300;

/// A parameter at which a function may vanish.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(super) struct Root(pub(super) f64);

/// The equations reduced to the `m` columns that vary. With `tau = t - base`, `X = A(base)^-1 A_1` for those
/// columns, `K` the rows of `X` that belong to them, and `z_0`, `z_1` the solutions for `b(base)` and `b_1`,
///
/// ```text
/// z = z_0 + tau z_1 - tau X (I + tau K)^-1 (z_0 + tau z_1)_varying,     det A(t) = det A(base) det(I + tau K)
/// ```
pub(super) struct Reduced {
    pub(super) base: f64,
    pub(super) k: DMatrix<f64>,
    /// The varying part of `z_0` and `z_1`.
    pub(super) sources: [DVector<f64>; 2],
    /// `w . X` of every condition.
    pub(super) couplings: DMatrix<f64>,
    /// `w . z_0 + offset` and `w . z_1`.
    pub(super) values: [DVector<f64>; 2],
    /// `|w| . |z_0| + |offset|`.
    pub(super) magnitudes: DVector<f64>,
}

impl Reduced {
    /// Reduces the equations at a base point with the given factorization.
    pub(super) fn new(
        line: &Line,
        conditions: &[Condition],
        base: f64,
        lu: &LU<f64, Dyn, Dyn>,
    ) -> Option<Self> {
        let slope = &line.matrix[1];
        let varying: Vec<usize> =
            (0..slope.ncols()).filter(|&column| slope.column(column).amax() > 0.0).collect();
        let x = lu.solve(&slope.select_columns(&varying))?;
        let start = lu.solve(&line.right_hand_side_at(base))?;
        let constant_load = line.right_hand_side[1].iter().all(|&entry| entry == 0.0);
        let rate =
            if constant_load { DVector::zeros(start.len()) } else { lu.solve(&line.right_hand_side[1])? };
        let all_finite = x.iter().chain(start.iter()).chain(rate.iter()).all(|value| value.is_finite());
        let list = |value: &dyn Fn(&Condition) -> f64| {
            DVector::from_iterator(conditions.len(), conditions.iter().map(value))
        };
        all_finite.then(|| Self {
            base,
            k: x.select_rows(&varying),
            sources: [start.select_rows(&varying), rate.select_rows(&varying)],
            couplings: DMatrix::from_fn(conditions.len(), varying.len(), |row, column| {
                conditions[row].times(x.column(column).as_slice())
            }),
            values: [
                list(&|condition| condition.times(start.as_slice()) + condition.offset),
                list(&|condition| condition.times(rate.as_slice())),
            ],
            magnitudes: list(&|condition| condition.magnitude(start.as_slice()) + condition.offset.abs()),
        })
    }

    pub(super) fn conditions(&self) -> usize {
        self.magnitudes.len()
    }

    /// The conditions, ordered so that those violated at most places of the range come first.
    pub(super) fn order(&self, range: [f64; 2]) -> Vec<usize> {
        let places = [0.13, 0.41, 0.66, 0.94].map(|fraction| range[0] + fraction * (range[1] - range[0]));
        let met = |condition: usize| {
            places.iter().filter(|&&at| self.value(condition, at).is_some_and(Value::is_met)).count()
        };
        let mut order: Vec<(usize, usize)> = (0..self.conditions()).map(|c| (met(c), c)).collect();
        order.sort_unstable();
        order.into_iter().map(|(_, condition)| condition).collect()
    }

    /// `det(I + tau K)`.
    pub(super) fn determinant(&self, at: f64) -> f64 {
        self.matrix(at - self.base).determinant()
    }

    fn matrix(&self, tau: f64) -> DMatrix<f64> {
        DMatrix::identity(self.k.nrows(), self.k.nrows()) + &self.k * tau
    }

    /// The value of a condition; `None` if the equations are singular.
    pub(super) fn value(&self, condition: usize, at: f64) -> Option<Value> {
        let tau = at - self.base;
        let constant = self.values[0][condition];
        let linear = tau * self.values[1][condition];
        let (mut correction, mut size) = (0.0, 0.0);
        match self.k.nrows() {
            0 => {}
            1 => {
                let source = self.sources[0][0] + tau * self.sources[1][0];
                correction = tau * self.couplings[(condition, 0)] * source / (1.0 + tau * self.k[(0, 0)]);
                size = correction.abs();
            }
            _ => {
                let source = &self.sources[0] + &self.sources[1] * tau;
                let answer = self.matrix(tau).lu().solve(&source)?;
                for (coupling, answer) in self.couplings.row(condition).iter().zip(answer.iter()) {
                    correction += tau * coupling * answer;
                    size += (tau * coupling * answer).abs();
                }
            }
        }
        let value = constant + linear - correction;
        let magnitude = self.magnitudes[condition] + linear.abs() + size;
        value.is_finite().then_some(Value { value, magnitude })
    }

    /// The places at which a condition that is an equality at all of them is one for all parameters: the numerator of its value
    /// has at most one degree more than there are varying columns.
    pub(super) fn places(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
        let places = self.k.nrows() + 2;
        (0..places).map(move |index| from + (to - from) * (index as f64 + 0.5) / places as f64)
    }

    /// Where `det A(t)` may vanish: `tau = -1 / (eigenvalue of K)`. `None` if the eigenvalues could not be
    /// computed.
    pub(super) fn poles(&self) -> Option<Vec<Root>> {
        let places = reciprocals(&self.k)?.into_iter().map(|tau| Root(self.base + tau));
        Some(sorted(places.collect()))
    }

    /// Where a condition may vanish: zeros of `(w . z + offset) det(I + tau K)`, the determinant of
    /// `[[I + tau K, source], [tau w . X, value]]`. `None` if the eigenvalues could not be computed.
    pub(super) fn zeros(&self, condition: usize) -> Option<Vec<Root>> {
        let [constant, linear] = [0, 1].map(|power| self.values[power][condition]);
        let taus = match self.k.nrows() {
            0 => quadratic(0.0, linear, constant),
            1 => {
                let (k, coupling) = (self.k[(0, 0)], self.couplings[(condition, 0)]);
                let [s0, s1] = [0, 1].map(|power| self.sources[power][0]);
                quadratic(k * linear - coupling * s1, linear + k * constant - coupling * s0, constant)
            }
            _ => self.pencil_zeros(condition)?,
        };
        Some(sorted(taus.into_iter().map(|tau| Root(self.base + tau)).collect()))
    }

    /// Zeros of `det(P + tau Q)`, shifted to a place where `P` is regular.
    fn pencil_zeros(&self, condition: usize) -> Option<Vec<f64>> {
        let size = self.k.nrows();
        let mut constant = DMatrix::identity(size + 1, size + 1);
        let mut slope = DMatrix::zeros(size + 1, size + 1);
        slope.view_mut((0, 0), (size, size)).copy_from(&self.k);
        slope.view_mut((size, 0), (1, size)).copy_from(&self.couplings.row(condition));
        for (power, matrix) in [&mut constant, &mut slope].into_iter().enumerate() {
            matrix.view_mut((0, size), (size, 1)).copy_from(&self.sources[power]);
            matrix[(size, size)] = self.values[power][condition];
        }
        // The last column has the unit of the load: scaling it does not move any zero.
        let scale = constant.column(size).amax().max(slope.column(size).amax());
        if scale == 0.0 || !scale.is_finite() {
            return Some(Vec::new());
        }
        constant.column_mut(size).scale_mut(scale.recip());
        slope.column_mut(size).scale_mut(scale.recip());
        let extent = slope.amax().max(f64::MIN_POSITIVE).recip();
        let mut best: Option<(f64, f64, DMatrix<f64>)> = None;
        for shift in [0.0, 0.618 * extent, -0.382 * extent, 2.618 * extent] {
            let lu = (&constant + &slope * shift).lu();
            let ratio = pivot_ratio(&lu);
            if best.as_ref().is_none_or(|(known, ..)| ratio > *known)
                && let Some(matrix) = lu.solve(&slope)
            {
                best = Some((ratio, shift, matrix));
            }
            if ratio > 1e-4 {
                break;
            }
        }
        let (_, shift, matrix) = best?;
        Some(reciprocals(&matrix)?.into_iter().map(|tau| shift + tau).collect())
    }
}

/// `-1 / eigenvalue` for every eigenvalue that is real or nearly so.
fn reciprocals(matrix: &DMatrix<f64>) -> Option<Vec<f64>> {
    let size = matrix.nrows();
    if size == 0 {
        return Some(Vec::new());
    }
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    if size == 1 {
        let value = matrix[(0, 0)];
        return Some(if value == 0.0 { Vec::new() } else { vec![-value.recip()] });
    }
    // The iteration occasionally fails without any defect of the matrix: its transpose has the same
    // eigenvalues.
    let attempts = TOLERANCES.iter().flat_map(|&tolerance| {
        [matrix.clone(), matrix.transpose()].map(|matrix| Schur::try_new(matrix, tolerance, STEPS * size))
    });
    let schur = attempts.flatten().next()?;
    let greatest = matrix.amax();
    let usable = |value: &&Complex<f64>| {
        value.norm() > f64::EPSILON * f64::EPSILON * greatest && value.im.abs() <= REAL * value.norm()
    };
    let values = schur.complex_eigenvalues();
    Some(values.iter().filter(usable).map(|value| -value.inv().re).filter(|root| root.is_finite()).collect())
}

/// The real zeros of `a x^2 + b x + c`, without cancellation.
fn quadratic(a: f64, b: f64, c: f64) -> Vec<f64> {
    let finite = |root: f64| if root.is_finite() { Some(root) } else { None };
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return Vec::new();
    }
    let half = -0.5 * (b + discriminant.sqrt().copysign(b));
    [c / half, half / a].into_iter().filter_map(finite).collect()
}

fn sorted(mut roots: Vec<Root>) -> Vec<Root> {
    roots.sort_by(|one, other| one.0.total_cmp(&other.0));
    roots.dedup();
    roots
}
