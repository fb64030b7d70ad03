//! Vectors in integers that separate the right-hand side from what some columns of the lifted equations can
//! reach.
//!
//! Such a vector `v` has `v . C_j <= 0` for all columns `C_j`. If `v . b > 0`, the equations have no
//! solution (Farkas). If `v . b >= 0`, the unknowns of all columns with `v . C_j < 0` vanish in every
//! solution. A linear program finds the vector with the largest margin, which is rounded to as few bits as
//! the margin allows and then verified in integers. Columns with `v . C_j = 0` for every such vector leave no
//! margin; the multipliers of the linear program name them, and the search goes on in the null space of these
//! columns.

use dashu_int::IBig;

use crate::certificate::{LiftedSystem, make_primitive};
use crate::simplex::{Bounds, LinearOutcome, LinearProgram, dot};

/// A margin below this is taken for zero.
const NO_MARGIN: f64 = 1e-9;
/// Multipliers above this name a column without a margin.
const TIGHT: f64 = 1e-9;
/// Bits added to those that the margin asks for, until the vector is verified.
const MORE_BITS: [f64; 3] = [1.0, 6.0, 20.0];

/// The statement that a vector is to prove.
#[derive(Debug, Clone, Copy)]
pub(super) enum Separated<'a> {
    /// The equations have no solution.
    Infeasible,
    /// The unknowns of these columns vanish in every solution.
    Vanishing(&'a [usize]),
}

/// A verified vector for some columns of a system; `None` if none was found, or once `proceed` is `false`.
/// `tight` are columns whose unknowns are positive in some solution.
pub(super) fn separate(
    system: &LiftedSystem,
    (allowed, tight): (&[usize], &[usize]),
    wanted: Separated<'_>,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<IBig>> {
    let mut tight = tight.to_vec();
    loop {
        let strict: Vec<usize> = allowed.iter().copied().filter(|column| !tight.contains(column)).collect();
        let coordinates = Coordinates::new(system, &tight, &strict, proceed)?;
        let rows = Rows::new(&coordinates, &strict, wanted)?;
        let Best { weights, margin, multipliers } = rows.largest_margin(proceed)?;
        if margin > NO_MARGIN {
            let fewest = (coordinates.basis.len() as f64 / margin).log2().ceil();
            let vectors = MORE_BITS.iter().map(|more| coordinates.rounded(&weights, fewest + more));
            return vectors.into_iter().find(|vector| verifies(system, allowed, vector, wanted));
        }
        let before = tight.len();
        tight.extend(rows.columns.iter().zip(&multipliers).filter(|(_, m)| **m > TIGHT).map(|(at, _)| at.0));
        if tight.len() == before {
            return None;
        }
    }
}

/// Whether a vector proves what is wanted.
fn verifies(system: &LiftedSystem, allowed: &[usize], vector: &[IBig], wanted: Separated<'_>) -> bool {
    let vector: Vec<(usize, &IBig)> =
        vector.iter().enumerate().filter(|(_, entry)| !entry.is_zero()).collect();
    let product = |column: &[IBig]| -> IBig { vector.iter().map(|&(row, entry)| entry * &column[row]).sum() };
    let must_vanish =
        |column: &usize| matches!(wanted, Separated::Vanishing(which) if which.contains(column));
    let sides = allowed.iter().all(|column| {
        let product = product(system.column(*column));
        product < IBig::ZERO || product.is_zero() && !must_vanish(column)
    });
    let right = product(system.right());
    sides && (right > IBig::ZERO || right.is_zero() && matches!(wanted, Separated::Vanishing(_)))
}

/// The vectors with zero products with some columns, `v = sum_i t_i 2^e_i K_i`.
struct Coordinates {
    /// `K_i`: the entries that are not zero.
    basis: Vec<Vec<(usize, IBig)>>,
    /// `e`: the largest product of `2^e_i K_i` with one of the other columns has a size of about 1.
    exponents: Vec<i32>,
    /// The products of all `2^e_i K_i` with each of these columns and, last, with the right-hand side.
    products: Vec<Vec<f64>>,
    rows: usize,
}

impl Coordinates {
    /// `None` if there are no such vectors.
    fn new(
        system: &LiftedSystem,
        tight: &[usize],
        others: &[usize],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        let rows = system.rows();
        let basis = system.left_null_space(tight, proceed)?;
        if basis.is_empty() {
            return None;
        }
        let nonzero = |vector: Vec<IBig>| {
            vector.into_iter().enumerate().filter(|(_, entry)| !entry.is_zero()).collect::<Vec<_>>()
        };
        let basis: Vec<Vec<(usize, IBig)>> = basis.into_iter().map(nonzero).collect();
        let vectors = || others.iter().map(|&column| system.column(column)).chain([system.right()]);
        let mut exponents = Vec::with_capacity(basis.len());
        let mut products = vec![Vec::with_capacity(basis.len()); others.len() + 1];
        for vector in &basis {
            let exact: Vec<IBig> = vectors().map(|column| sparse_product(vector, column)).collect();
            let exponent = -exact.iter().map(log2).max().unwrap_or(0);
            products.iter_mut().zip(&exact).for_each(|(of, product)| of.push(scaled(product, exponent)));
            exponents.push(exponent);
        }
        Some(Self { basis, exponents, products, rows })
    }

    /// The vector with coordinates rounded to multiples of `2^-bits`, times a power of two.
    fn rounded(&self, weights: &[f64], bits: f64) -> Vec<IBig> {
        let least = self.exponents.iter().copied().min().unwrap_or(0);
        let mut sum = vec![IBig::ZERO; self.rows];
        for ((vector, &exponent), weight) in self.basis.iter().zip(&self.exponents).zip(weights) {
            let Ok(factor) = IBig::try_from((weight * bits.exp2()).round()) else { continue };
            let factor = factor << usize::try_from(exponent - least).unwrap_or(0);
            for (row, entry) in vector.iter().filter(|_| !factor.is_zero()) {
                sum[*row] += &factor * entry;
            }
        }
        make_primitive(&mut sum);
        sum
    }
}

fn sparse_product(vector: &[(usize, IBig)], column: &[IBig]) -> IBig {
    let terms = vector.iter().filter(|(row, _)| !column[*row].is_zero());
    terms.fold(IBig::ZERO, |sum, (row, entry)| sum + entry * &column[*row])
}

/// The conditions `g_j . t <= -margin w_j`, with `w_j` the size of `g_j`.
struct Rows<'a> {
    /// The columns, with `g_j`.
    columns: Vec<(usize, &'a [f64])>,
    /// `-h` of the right-hand side, if it must be exceeded.
    right: Option<Vec<f64>>,
    coordinates: usize,
}

/// The coordinates with the largest margin.
struct Best {
    weights: Vec<f64>,
    margin: f64,
    /// The multipliers of the columns.
    multipliers: Vec<f64>,
}

impl<'a> Rows<'a> {
    /// `None` if some condition cannot be met.
    fn new(coordinates: &'a Coordinates, strict: &[usize], wanted: Separated<'_>) -> Option<Self> {
        let is_zero = |products: &[f64]| products.iter().all(|&product| product == 0.0);
        let (right, all) = coordinates.products.split_last()?;
        let columns = strict.iter().copied().zip(all.iter().map(Vec::as_slice));
        let (zero, columns): (Vec<_>, Vec<_>) = columns.partition(|(_, products)| is_zero(products));
        let impossible = match wanted {
            Separated::Vanishing(which) => zero.iter().any(|(column, _)| which.contains(column)),
            Separated::Infeasible => is_zero(right),
        };
        if impossible {
            return None;
        }
        let exceeded = matches!(wanted, Separated::Infeasible);
        let right = exceeded.then(|| right.iter().map(|product| -product).collect());
        Some(Self { columns, right, coordinates: coordinates.basis.len() })
    }

    /// The coordinates `-1 <= t <= 1` with the largest margin, and the multipliers of the columns.
    ///
    /// They are the multipliers of `min sum p + m` with `sum_j g_j x_j + p - m = 0`, `sum_j w_j x_j = 1`.
    fn largest_margin(&self, proceed: &mut dyn FnMut() -> bool) -> Option<Best> {
        let vectors = || self.columns.iter().map(|(_, products)| *products).chain(self.right.as_deref());
        let with_size = |products: &[f64]| products.iter().copied().chain([largest(products)]).collect();
        let mut columns: Vec<Vec<f64>> = vectors().map(with_size).collect();
        let mut cost = vec![0.0; columns.len()];
        for coordinate in 0..self.coordinates {
            for sign in [1.0, -1.0] {
                let mut column = vec![0.0; self.coordinates + 1];
                column[coordinate] = sign;
                columns.push(column);
                cost.push(1.0);
            }
        }
        let mut right = vec![0.0; self.coordinates + 1];
        right[self.coordinates] = 1.0;
        let bounds = Bounds { lower: vec![0.0; columns.len()], upper: vec![f64::INFINITY; columns.len()] };
        let program = LinearProgram::new(&columns, right, cost);
        let mut basis = program.artificial_basis();

        let LinearOutcome::Feasible(values) = program.solve(&mut basis, &bounds, &mut 0, proceed) else {
            return None;
        };
        let mut weights = basis.multipliers(&program);
        weights.truncate(self.coordinates);
        let margins = vectors().map(|products| -dot(products, &weights) / largest(products));
        let margin = margins.fold(f64::INFINITY, f64::min);
        Some(Best { weights, margin, multipliers: values[..self.columns.len()].to_vec() })
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// About the binary logarithm of a size; very small for zero.
pub(super) fn log2(value: &IBig) -> i32 {
    use dashu_int::ops::BitTest;
    if value.is_zero() { i32::MIN / 4 } else { i32::try_from(value.bit_len()).unwrap_or(i32::MAX / 4) }
}

/// `value 2^exponent`, rounded: off by less than one part in `2^52`, unless that is beyond the range of numbers.
pub(super) fn scaled(value: &IBig, exponent: i32) -> f64 {
    use dashu_int::ops::BitTest;
    // Kept to 64 bits first, so that nothing overflows.
    let excess = value.bit_len().saturating_sub(64);
    let short = (value >> excess).to_f64().value();
    let power = exponent.saturating_add(i32::try_from(excess).unwrap_or(i32::MAX / 4));
    short * f64::from(power.clamp(-1060, 1000)).exp2()
}
