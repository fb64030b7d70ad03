//! The lower part of the tree: the last levels in `f64`, unrolled and vectorised, with the instructions of the
//! processor at hand.

use super::PatternBits;
use super::upper::bound_below;

/// Levels that the kernel takes over from the upper part.
pub(super) const LEAF_LEVELS: usize = 10;
/// Entries of a row: right-hand side and two columns for each contact, rounded up to whole vectors.
const STRIDE: usize = 24;

type Row = [f64; STRIDE];

/// Unit roundoff of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The equation from which the normal force of a decided contact follows once those below are known.
#[derive(Clone)]
pub(super) struct PivotRow {
    entries: Vec<f64>,
    pivot: f64,
    bound: f64,
}

impl PivotRow {
    /// Entries (right-hand side, then both columns of each contact), pivot, and the bound on their errors.
    pub(super) fn new(entries: Vec<f64>, pivot: f64, bound: f64) -> Self {
        Self { entries, pivot, bound }
    }
}

struct Level {
    rows: [Row; LEAF_LEVELS],
    /// Bound on the error of every entry.
    bound: f64,
    /// Bound on the size of every entry.
    size: f64,
}

/// Workspace of one thread.
pub(super) struct Kernel {
    levels: Vec<Level>,
    /// Pivot row of each contact that has been decided.
    pivots: Vec<PivotRow>,
    sides: Vec<usize>,
    y: Vec<f64>,
    pattern: PatternBits,
    remaining: Vec<PatternBits>,
}

impl Kernel {
    /// A workspace for problems with this number of contacts.
    pub(super) fn new(contacts: usize) -> Self {
        let empty = PivotRow::new(vec![0.0; STRIDE], 1.0, 0.0);
        Self {
            levels: (0..=LEAF_LEVELS)
                .map(|_| Level { rows: [[0.0; STRIDE]; LEAF_LEVELS], bound: 0.0, size: 0.0 })
                .collect(),
            pivots: vec![empty; contacts],
            sides: vec![0; contacts],
            y: vec![0.0; contacts],
            pattern: 0,
            remaining: Vec::new(),
        }
    }

    /// All patterns that were kept.
    pub(super) fn into_remaining(self) -> Vec<PatternBits> {
        self.remaining
    }

    /// Keeps every pattern that shares the decided sides of `pattern`.
    pub(super) fn keep_all_below(&mut self, undecided: usize, pattern: PatternBits) {
        self.remaining.extend((0..1_u64 << undecided).map(|below| pattern | below));
    }

    /// Screens all patterns below a node of the upper part.
    pub(super) fn screen(&mut self, rows: &[Vec<f64>], bound: f64, above: &[PivotRow], pattern: PatternBits) {
        let undecided = rows.len();
        let level = &mut self.levels[undecided];
        for (target, row) in level.rows.iter_mut().zip(rows) {
            target[..row.len()].copy_from_slice(row);
        }
        level.bound = bound;
        level.size = rows.iter().flatten().fold(0.0, |size: f64, entry| size.max(entry.abs()));
        for (depth, pivot) in above.iter().enumerate() {
            let contact = self.pivots.len() - 1 - depth;
            self.pivots[contact] = pivot.clone();
            self.sides[contact] = usize::from(pattern >> contact & 1 == 1);
        }
        self.pattern = pattern;
        descend(self, undecided);
    }

    /// Back-substitution from the two contacts of a leaf: whether some `y` is certainly negative.
    fn is_excluded(&mut self, mut error: f64) -> bool {
        let mut largest = self.y[0].max(self.y[1]);
        for contact in 2..self.pivots.len() {
            let PivotRow { entries, pivot, bound } = &self.pivots[contact];
            let mut value = entries[0];
            let mut size = value.abs();
            let mut width = 0.0;
            for below in 0..contact {
                let coefficient = entries[1 + 2 * below + self.sides[below]];
                value -= coefficient * self.y[below];
                size += (coefficient * self.y[below]).abs();
                width += coefficient.abs();
            }
            let count = contact as f64;
            let error_of_value =
                bound + width * error + count * bound * (largest + error) + (count + 4.0) * UNIT * size;
            let y = value / pivot;
            let error_of_y =
                1.001 * (error_of_value + y.abs() * bound) / (pivot.abs() - bound) + 2.0 * UNIT * y.abs();
            if y < -error_of_y {
                return true;
            }
            self.y[contact] = y;
            error = error.max(error_of_y);
            largest = largest.max(y.abs());
        }
        false
    }
}

/// One elimination step at a node with `M` undecided contacts: the last of them goes to `side`. False if its pivot
/// is too small.
#[expect(clippy::inline_always, reason = "compiled once for each set of instructions")]
#[inline(always)]
fn step<const M: usize, const FUSED: bool>(kernel: &mut Kernel, side: usize) -> bool {
    let width = const { (2 * M - 1).next_multiple_of(4) };
    let column = 1 + 2 * (M - 1) + side;
    let (below, here) = kernel.levels.split_at_mut(M);
    let (child, node) = (&mut below[M - 1], &here[0]);
    let mut at = 0;
    let mut size = node.rows[0][column].abs();
    for (index, row) in node.rows.iter().enumerate().take(M).skip(1) {
        let candidate = row[column].abs();
        if candidate > size {
            (at, size) = (index, candidate);
        }
    }
    if size <= 2.0 * node.bound || size == 0.0 {
        return false;
    }
    let pivot_row = node.rows[at];
    let pivot = pivot_row[column];
    let inverse = 1.0 / pivot;
    for target in 0..M - 1 {
        let row = &node.rows[if target == at { M - 1 } else { target }];
        let factor = row[column] * inverse;
        for j in 0..width {
            child.rows[target][j] =
                if FUSED { (-factor).mul_add(pivot_row[j], row[j]) } else { row[j] - factor * pivot_row[j] };
        }
    }
    let largest = pivot_row[..2 * M - 1].iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    child.bound = bound_below(node.bound, size, largest, node.size, 2.0 * UNIT);
    child.size = node.size + largest;
    let stored = &mut kernel.pivots[M - 1];
    stored.entries[..width].copy_from_slice(&pivot_row[..width]);
    stored.pivot = pivot;
    stored.bound = node.bound;
    kernel.sides[M - 1] = side;
    kernel.pattern = kernel.pattern & !(1 << (M - 1)) | (side as u64) << (M - 1);
    true
}

/// The last two contacts: all four patterns by Cramer's rule.
#[expect(clippy::inline_always, reason = "compiled once for each set of instructions")]
#[inline(always)]
fn leaf(kernel: &mut Kernel) {
    let Level { rows: [first, second, ..], bound, .. } = &kernel.levels[2];
    let (first, second, bound) = (*first, *second, *bound);
    let cross = |i: usize, j: usize| first[i] * second[j] - first[j] * second[i];
    let largest =
        first[..5].iter().chain(&second[..5]).fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let error =
        4.0 * largest * bound + 2.0 * bound * bound + 8.0 * UNIT * largest * largest + f64::MIN_POSITIVE;
    let with_second = [cross(0, 3), cross(0, 4)];
    let with_first = [cross(1, 0), cross(2, 0)];
    for (side_1, with_second) in with_second.into_iter().enumerate() {
        for (side_0, with_first) in with_first.into_iter().enumerate() {
            let determinant = cross(1 + side_0, 3 + side_1);
            let numerators = [with_second, with_first];
            let sign = 1.0_f64.copysign(determinant);
            let regular = determinant.abs() > error;
            if regular && (numerators[0] * sign < -error || numerators[1] * sign < -error) {
                continue;
            }
            kernel.keep_unless_excluded(regular, numerators, determinant, error, [side_0, side_1]);
        }
    }
}

impl Kernel {
    #[inline(never)]
    fn keep_unless_excluded(
        &mut self,
        regular: bool,
        numerators: [f64; 2],
        determinant: f64,
        error: f64,
        sides: [usize; 2],
    ) {
        let pattern = self.pattern & !3 | sides[0] as u64 | (sides[1] as u64) << 1;
        if regular {
            let y = numerators.map(|numerator| numerator / determinant);
            let largest = y[0].abs().max(y[1].abs());
            self.y[0] = y[0];
            self.y[1] = y[1];
            self.sides[0] = sides[0];
            self.sides[1] = sides[1];
            let error_of_y =
                1.001 * error * (1.0 + largest) / (determinant.abs() - error) + 2.0 * UNIT * largest;
            if self.is_excluded(error_of_y) {
                return;
            }
        }
        self.remaining.push(pattern);
    }
}

macro_rules! descent {
    ($(#[$attribute:meta])* $name:ident, $fused:literal) => {
        /// Visits all patterns below a node with `undecided` contacts left.
        $(#[$attribute])*
        fn $name(kernel: &mut Kernel, undecided: usize) {
            if undecided == 2 {
                return leaf(kernel);
            }
            for side in 0..2 {
                let regular = match undecided {
                    3 => step::<3, $fused>(kernel, side),
                    4 => step::<4, $fused>(kernel, side),
                    5 => step::<5, $fused>(kernel, side),
                    6 => step::<6, $fused>(kernel, side),
                    7 => step::<7, $fused>(kernel, side),
                    8 => step::<8, $fused>(kernel, side),
                    9 => step::<9, $fused>(kernel, side),
                    _ => step::<LEAF_LEVELS, $fused>(kernel, side),
                };
                if regular {
                    $name(kernel, undecided - 1);
                } else {
                    let contact = undecided - 1;
                    let pattern = kernel.pattern >> undecided << undecided | (side as u64) << contact;
                    kernel.keep_all_below(contact, pattern);
                }
            }
        }
    };
}

descent!(descend_baseline, false);

#[cfg(target_arch = "x86_64")]
descent!(
    #[target_feature(enable = "avx2,fma")]
    descend_avx2,
    true
);

/// Visits all patterns below a node, with the best instructions that this processor has.
fn descend(kernel: &mut Kernel, undecided: usize) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        // SAFETY: the processor was just found to have both features.
        #[expect(unsafe_code, reason = "twice as fast as generic x86-64, chosen at run time")]
        return unsafe { descend_avx2(kernel, undecided) };
    }
    descend_baseline(kernel, undecided);
}
