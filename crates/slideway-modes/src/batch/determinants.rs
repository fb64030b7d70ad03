//! Determinants of all patterns as multi-affine forms in the friction coefficients.

use nalgebra::DMatrix;

use super::MOST_CONTACTS;
use super::contraction::{Step, contract_first, contract_next};
use super::lanes::{LANES, Lanes, product_plus};
use crate::problem::{BySide, InfluenceCoefficients, ModeProblem, Side};

/// `D` and all `D_k` of a structure for all patterns, with the data for their error bounds.
#[derive(Debug, Clone)]
pub(super) struct Determinants {
    pub(super) contacts: usize,
    pub(super) varied: Vec<usize>,
    pub(super) both_sides: bool,
    /// `D`, then every `D_k`.
    forms: Vec<Form>,
    /// 1-norms of the columns: a constant, and the increase per unit of friction.
    column_sizes: Vec<(f64, f64)>,
    load_size: f64,
    load_unit: f64,
    /// Error of a determinant relative to the product of its columns' 1-norms.
    relative_error: f64,
}

impl Determinants {
    /// From a structure without the friction of the varied contacts, and the problem that it defines.
    pub(super) fn new(influence: &InfluenceCoefficients, problem: &ModeProblem, varied: &[usize]) -> Self {
        let contacts = problem.contacts();
        let scaled = Scaled::new(problem, influence, varied);
        let both_sides = (0..contacts).any(|contact| problem.has_jump(contact));
        let patterns = 1 << contacts;
        let mut forms = vec![scaled.form(None, 0)];
        for contact in 0..contacts {
            // A numerator whose own contact has no jump is stored once for both sides.
            let first = patterns + numerator_index(contacts, both_sides, contact, 0);
            forms.push(scaled.form(Some(contact), first));
        }
        Self {
            contacts,
            varied: varied.to_vec(),
            both_sides,
            forms,
            column_sizes: (0..contacts).map(|contact| scaled.column_size(contact)).collect(),
            load_size: scaled.load_size(),
            load_unit: scaled.load_unit,
            relative_error: rounding(contacts),
        }
    }

    /// Numbers are known to `accuracy`, relative to the 1-norm of their column.
    pub(super) fn known_to(&mut self, accuracy: f64) {
        self.relative_error += (self.contacts * self.contacts) as f64 * accuracy;
    }

    /// The values with the friction coefficients of every varied contact at all `count` points.
    pub(super) fn at<'a>(&'a self, friction: &'a [&'a [f64]], count: usize) -> FrictionPoints<'a> {
        FrictionPoints { batch: self, friction, count }
    }
}

/// A determinant for all patterns as a multi-affine form in the varied friction coefficients.
///
/// `det [.., b_k^sigma + mu_k g_k^sigma, ..]`: the axis of a varied contact has the states `b, g^+, g^-`
/// (with `b^- = -b^+`) or `b^+, b^-, g^+, g^-`; that of another contact has the states `+, -`, or a single
/// one if the contact's side does not matter. The axis of contact 0 varies fastest.
#[derive(Debug, Clone)]
struct Form {
    coefficients: Vec<f64>,
    steps: Vec<Step>,
    /// Where the values of this form begin.
    first: usize,
    /// Number of values.
    size: usize,
}

/// Buffers for one block of points.
pub(super) struct Workspace {
    /// `D` of every pattern, then `D_0` of every pattern, `D_1`, ...
    pub(super) values: Vec<Lanes>,
    /// Friction coefficients of the points.
    pub(super) loaded: Vec<Lanes>,
    pub(super) scratch: Vec<Vec<Lanes>>,
    /// `s_k >= |c_k|_1` for both sides.
    pub(super) column_sizes: [Lanes; MOST_CONTACTS],
    /// At least the 1-norm of every right-hand side.
    pub(super) load_size: Lanes,
    /// Relative error of every determinant, compared with the product of its columns' 1-norms.
    pub(super) relative_error: f64,
}

/// Index of the numerator `D_k` of a pattern, relative to the first one.
#[inline(always)]
pub(super) fn numerator_index(contacts: usize, both_sides: bool, contact: usize, pattern: usize) -> usize {
    if both_sides {
        return (contact << contacts) + pattern;
    }
    // D_k does not depend on the side of contact k, so its bit is omitted.
    let below = pattern & ((1 << contact) - 1);
    (contact << (contacts - 1)) + (below | (pattern >> 1 & !((1 << contact) - 1)))
}

/// Factor on the unit roundoff in the error bound of a determinant.
///
/// Expansion by columns makes `j` roundings at column `j`; the right-hand side is a sum of `r + 1` vectors,
/// and columns and their combinations are rounded a few times: at most `r (r + 1) / 2 + 6 r` in total. The
/// bound is twice as large.
pub(super) fn rounding(contacts: usize) -> f64 {
    ((contacts * (contacts + 1)) / 2 + 6 * contacts) as f64 * f64::EPSILON
}

/// The structure in units in which its numbers are of order 1; all factors are powers of two.
struct Scaled {
    contacts: usize,
    /// Index of each contact among the varied ones.
    parameter: Vec<Option<usize>>,
    has_jump: Vec<bool>,
    /// Columns without the varied friction.
    base: BySide<DMatrix<f64>>,
    /// The increase per unit of friction.
    slope: BySide<DMatrix<f64>>,
    jumps: BySide<DMatrix<f64>>,
    load: Vec<f64>,
    load_unit: f64,
}

/// The part of a column, and the side, that a state of an axis represents.
#[derive(Clone, Copy)]
enum ColumnPart {
    Base(Side),
    Slope(Side),
}

impl ColumnPart {
    fn side(self) -> Side {
        match self {
            Self::Base(side) | Self::Slope(side) => side,
        }
    }
}

impl Scaled {
    fn new(problem: &ModeProblem, influence: &InfluenceCoefficients, varied: &[usize]) -> Self {
        let contacts = problem.contacts();
        // g_k^sigma = -s_k eta_k^sigma
        let slope = |side: Side| -influence.eta.get(side) * DMatrix::from_diagonal(&influence.velocity_signs);
        let parts = Side::BOTH.map(|side| (problem.columns(side), slope(side)));
        let row_scale: Vec<f64> = (0..contacts)
            .map(|row| {
                let sizes = parts.iter().map(|(base, slope)| base.row(row).amax().max(slope.row(row).amax()));
                power_of_two_below(sizes.fold(0.0, f64::max).recip())
            })
            .collect();
        let scaled = |matrix: &DMatrix<f64>, unit: f64| {
            DMatrix::from_fn(contacts, contacts, |row, column| matrix[(row, column)] * row_scale[row] / unit)
        };
        let [jumps_positive, jumps_negative] = Side::BOTH.map(|side| scaled(problem.jumps(side), 1.0));
        let load: Vec<f64> =
            problem.right_hand_side().iter().zip(&row_scale).map(|(load, scale)| load * scale).collect();
        let largest = jumps_positive.amax().max(jumps_negative.amax());
        let largest = load.iter().fold(largest, |largest, load| largest.max(load.abs()));
        let load_unit = power_of_two_below(largest);
        let [(base_positive, slope_positive), (base_negative, slope_negative)] = parts;
        Self {
            contacts,
            parameter: (0..contacts).map(|k| varied.iter().position(|&contact| contact == k)).collect(),
            has_jump: (0..contacts).map(|contact| problem.has_jump(contact)).collect(),
            base: BySide { positive: scaled(base_positive, 1.0), negative: scaled(base_negative, 1.0) },
            slope: BySide { positive: scaled(&slope_positive, 1.0), negative: scaled(&slope_negative, 1.0) },
            jumps: BySide { positive: jumps_positive / load_unit, negative: jumps_negative / load_unit },
            load: load.into_iter().map(|load| load / load_unit).collect(),
            load_unit,
        }
    }

    /// `D`, or `D_k` with the right-hand side in column `k`.
    fn form(&self, replaced: Option<usize>, first: usize) -> Form {
        let axes: Vec<Vec<ColumnPart>> =
            (0..self.contacts).map(|contact| self.axis(contact, replaced)).collect();
        let size = axes.iter().map(Vec::len).product();
        let mut coefficients = Vec::with_capacity(size);
        for number in 0..size {
            let mut rest = number;
            let parts: Vec<ColumnPart> = axes
                .iter()
                .map(|axis| {
                    let part = axis[rest % axis.len()];
                    rest /= axis.len();
                    part
                })
                .collect();
            coefficients.push(self.determinant(&parts, replaced));
        }
        let mut sizes: Vec<usize> = axes.iter().map(Vec::len).collect();
        let mut steps = Vec::new();
        for contact in (0..self.contacts).rev() {
            let Some(parameter) = self.parameter[contact].filter(|_| replaced != Some(contact)) else {
                continue;
            };
            let outer = sizes[contact + 1..].iter().product();
            let inner = sizes[..contact].iter().product();
            steps.push(Step { parameter, outer, inner, split: sizes[contact] == 4 });
            sizes[contact] = 2;
        }
        Form { coefficients, steps, first, size: sizes.iter().product() }
    }

    fn axis(&self, contact: usize, replaced: Option<usize>) -> Vec<ColumnPart> {
        let (base, slope) = (Side::BOTH.map(ColumnPart::Base), Side::BOTH.map(ColumnPart::Slope));
        if replaced == Some(contact) {
            // A problem with jumps has numerators for both sides.
            let both_sides = self.has_jump.contains(&true);
            return if both_sides { base.to_vec() } else { vec![base[0]] };
        }
        if self.parameter[contact].is_none() {
            return base.to_vec();
        }
        let mirrored = self.base.positive.column(contact) == -self.base.negative.column(contact);
        let jumps = replaced.is_some() && self.has_jump[contact];
        if mirrored && !jumps { vec![base[0], slope[0], slope[1]] } else { [base, slope].concat() }
    }

    fn determinant(&self, parts: &[ColumnPart], replaced: Option<usize>) -> f64 {
        let columns: Vec<Vec<f64>> = parts
            .iter()
            .enumerate()
            .map(|(contact, &part)| match part {
                _ if replaced == Some(contact) => self.right_hand_side(parts),
                ColumnPart::Base(side) => self.base.get(side).column(contact).iter().copied().collect(),
                ColumnPart::Slope(side) => self.slope.get(side).column(contact).iter().copied().collect(),
            })
            .collect();
        determinant(&columns)
    }

    /// `N(0) + sum_k d_k^{sigma_k}`
    fn right_hand_side(&self, parts: &[ColumnPart]) -> Vec<f64> {
        let mut sum = self.load.clone();
        for (contact, part) in parts.iter().enumerate() {
            let side = if self.has_jump[contact] { part.side() } else { Side::Negative };
            for (sum, jump) in sum.iter_mut().zip(&self.jumps.get(side).column(contact)) {
                *sum += jump;
            }
        }
        sum
    }

    fn column_size(&self, contact: usize) -> (f64, f64) {
        let size = |parts: &BySide<DMatrix<f64>>| {
            let sums = Side::BOTH.map(|side| parts.get(side).column(contact).lp_norm(1));
            sums[0].max(sums[1])
        };
        let slope = if self.parameter[contact].is_some() { size(&self.slope) } else { 0.0 };
        (size(&self.base), slope)
    }

    fn load_size(&self) -> f64 {
        let load: f64 = self.load.iter().map(|load| load.abs()).sum();
        let jumps = (0..self.contacts).map(|contact| {
            let sums = Side::BOTH.map(|side| self.jumps.get(side).column(contact).lp_norm(1));
            sums[0].max(sums[1])
        });
        load + jumps.sum::<f64>()
    }
}

/// The largest power of two that does not exceed `size`, within the range where its reciprocal is finite; 1
/// for zero and for infinity.
fn power_of_two_below(size: f64) -> f64 {
    if size == 0.0 || !size.is_finite() { 1.0 } else { size.log2().floor().clamp(-1000.0, 1000.0).exp2() }
}

/// Expansion by columns over all sets of rows: without pivots, and therefore without division and with an
/// error bound that depends only on the sizes of the entries.
fn determinant(columns: &[Vec<f64>]) -> f64 {
    let size = columns.len();
    let mut minors = vec![0.0; 1 << size];
    minors[0] = 1.0;
    for rows in 1..1_usize << size {
        let column = &columns[rows.count_ones() as usize - 1];
        let mut sign = 1.0;
        for row in (0..size).rev().filter(|row| rows >> row & 1 == 1) {
            minors[rows] += sign * column[row] * minors[rows & !(1 << row)];
            sign = -sign;
        }
    }
    minors[(1 << size) - 1]
}

/// Determinants, with their points.
pub(super) struct FrictionPoints<'a> {
    batch: &'a Determinants,
    friction: &'a [&'a [f64]],
    count: usize,
}

impl FrictionPoints<'_> {
    pub(super) fn contacts(&self) -> usize {
        self.batch.contacts
    }

    pub(super) fn points(&self) -> usize {
        self.count
    }

    pub(super) fn both_sides(&self) -> bool {
        self.batch.both_sides
    }

    pub(super) fn load_unit(&self) -> f64 {
        self.batch.load_unit
    }

    pub(super) fn workspace(&self) -> Workspace {
        let batch = self.batch;
        let count = batch.forms.iter().map(|form| form.first + form.size).max().unwrap_or(0);
        let mut values = vec![Lanes::ZERO; count];
        // Invariable values are written once.
        for form in batch.forms.iter().filter(|form| form.steps.is_empty()) {
            for (value, &coefficient) in values[form.first..].iter_mut().zip(&form.coefficients) {
                *value = Lanes::splat(coefficient);
            }
        }
        let between = batch.forms.iter().flat_map(|form| form.steps.iter().map(|step| step.output()));
        let between = between.max().unwrap_or(0);
        let mut column_sizes = [Lanes::ZERO; MOST_CONTACTS];
        for (lanes, (base, _)) in column_sizes.iter_mut().zip(&batch.column_sizes) {
            *lanes = Lanes::splat(*base);
        }
        Workspace {
            values,
            loaded: vec![Lanes::ZERO; batch.varied.len()],
            scratch: vec![vec![Lanes::ZERO; between]; 2],
            column_sizes,
            load_size: Lanes::splat(batch.load_size),
            relative_error: batch.relative_error,
        }
    }

    #[inline(always)]
    pub(super) fn evaluate<const FUSED: bool>(&self, points: &[usize; LANES], work: &mut Workspace) {
        let batch = self.batch;
        for ((lanes, values), &contact) in work.loaded.iter_mut().zip(self.friction).zip(&batch.varied) {
            if points[LANES - 1] - points[0] == LANES - 1 {
                lanes.0.copy_from_slice(&values[points[0]..][..LANES]);
            } else {
                for (lane, &point) in lanes.0.iter_mut().zip(points) {
                    *lane = values[point];
                }
            }
            let (base, slope) = batch.column_sizes[contact];
            let sizes = &mut work.column_sizes[contact];
            for lane in 0..LANES {
                sizes.0[lane] = product_plus::<FUSED>(lanes.0[lane].abs(), slope, base);
            }
        }
        let [one, other] = &mut work.scratch[..] else { return };
        for form in &batch.forms {
            let values = &mut work.values[form.first..form.first + form.size];
            let Some((first, later)) = form.steps.split_first() else { continue };
            let Some((last, between)) = later.split_last() else {
                contract_first::<FUSED>(*first, &form.coefficients, &work.loaded[first.parameter], values);
                continue;
            };
            contract_first::<FUSED>(*first, &form.coefficients, &work.loaded[first.parameter], one);
            for step in between {
                contract_next::<FUSED>(*step, one, &work.loaded[step.parameter], other);
                std::mem::swap(one, other);
            }
            contract_next::<FUSED>(*last, one, &work.loaded[last.parameter], values);
        }
    }
}
