//! From determinants to bit masks, for blocks of points.
//!
//! By Cramer's rule `y_k = D_k / D`, where `D_k` has the right-hand side in column `k`. So a pattern
//! has a solution if no `D_k` has the sign opposite to `D`: no division and no branch.

use super::lanes::{LANES, Lanes};
use super::{BatchSolutions, MOST_CONTACTS, words_per_point};

/// Column sums outside of this range (and loads outside of its fifth power) may lose more to
/// underflow than the bound of rounding errors tells.
const COLUMN_RANGE: (f64, f64) = (1e-12, 1e12);
const LOAD_RANGE: (f64, f64) = (1e-60, 1e60);
const SIGN_BIT: u32 = 63;

/// Where the determinants of a block of points come from.
pub(super) trait Determinants {
    fn contacts(&self) -> usize;
    fn points(&self) -> usize;
    /// Whether the numerators `D_k` are held for both sides of contact `k`.
    fn both_sides(&self) -> bool;
    /// Buffers, and whatever is the same for all points.
    fn workspace(&self) -> Workspace;
    /// `D` and `D_k` of all patterns, and the sums that their error bounds are made of.
    fn evaluate<const FUSED: bool>(&self, points: &[usize; LANES], work: &mut Workspace);
    /// The unit of `D_k / D`.
    fn load_unit(&self) -> f64;
}

/// Buffers for one block of points.
pub(super) struct Workspace {
    /// `D` of every pattern, then `D_0` of every pattern, `D_1`, ...
    pub(super) values: Vec<Lanes>,
    /// Coefficients of the points.
    pub(super) loaded: Vec<Lanes>,
    pub(super) scratch: Vec<Vec<Lanes>>,
    /// `s_k >= |c_k|_1` for both sides.
    pub(super) column_sizes: [Lanes; MOST_CONTACTS],
    /// At least the 1-norm of every right-hand side.
    pub(super) load_size: Lanes,
}

/// What is told of a solution: point, pattern, `y`.
pub(super) type Visitor<'a> = &'a mut dyn FnMut(usize, usize, &[f64]);

/// Number of the numerator `D_k` of a pattern, counted from the first one.
#[inline(always)]
pub(super) fn numerator_index(contacts: usize, both_sides: bool, contact: usize, pattern: usize) -> usize {
    if both_sides {
        return (contact << contacts) + pattern;
    }
    // D_k does not depend on the side of contact k: its bit is left out.
    let below = pattern & ((1 << contact) - 1);
    (contact << (contacts - 1)) + (below | (pattern >> 1 & !((1 << contact) - 1)))
}

/// Factor on the unit roundoff in the bound of the errors of a determinant.
///
/// Expansion by columns makes `j` roundings at column `j`; the right-hand side is a sum of `r + 1` vectors, and
/// columns and their combinations are rounded a few times: `r (r + 1) / 2 + 6 r` at most. The bound has twice as
/// much.
fn rounding(contacts: usize) -> f64 {
    ((contacts * (contacts + 1)) / 2 + 6 * contacts) as f64 * f64::EPSILON
}

/// Fills masks and doubts of all points.
pub(super) fn run(source: &impl Determinants, solutions: &mut BatchSolutions, visitor: Option<Visitor<'_>>) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        #[expect(unsafe_code, reason = "AVX2 triples the speed; the processor has just been asked for it")]
        unsafe {
            run_avx2(source, solutions, visitor);
        }
        return;
    }
    run_baseline(source, solutions, visitor);
}

/// The same, with the instructions that every processor of the target has.
pub(super) fn run_baseline(
    source: &impl Determinants,
    solutions: &mut BatchSolutions,
    visitor: Option<Visitor<'_>>,
) {
    run_any::<false>(source, solutions, visitor);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn run_avx2(source: &impl Determinants, solutions: &mut BatchSolutions, visitor: Option<Visitor<'_>>) {
    run_any::<true>(source, solutions, visitor);
}

#[inline(always)]
fn run_any<const FUSED: bool>(
    source: &impl Determinants,
    solutions: &mut BatchSolutions,
    visitor: Option<Visitor<'_>>,
) {
    match (source.contacts(), source.both_sides()) {
        (1, false) => run_sized::<FUSED, 1, false>(source, solutions, visitor),
        (2, false) => run_sized::<FUSED, 2, false>(source, solutions, visitor),
        (3, false) => run_sized::<FUSED, 3, false>(source, solutions, visitor),
        (4, false) => run_sized::<FUSED, 4, false>(source, solutions, visitor),
        (5, false) => run_sized::<FUSED, 5, false>(source, solutions, visitor),
        (6, false) => run_sized::<FUSED, 6, false>(source, solutions, visitor),
        (7, false) => run_sized::<FUSED, 7, false>(source, solutions, visitor),
        (8, false) => run_sized::<FUSED, 8, false>(source, solutions, visitor),
        (1, true) => run_sized::<FUSED, 1, true>(source, solutions, visitor),
        (2, true) => run_sized::<FUSED, 2, true>(source, solutions, visitor),
        (3, true) => run_sized::<FUSED, 3, true>(source, solutions, visitor),
        (4, true) => run_sized::<FUSED, 4, true>(source, solutions, visitor),
        (5, true) => run_sized::<FUSED, 5, true>(source, solutions, visitor),
        (6, true) => run_sized::<FUSED, 6, true>(source, solutions, visitor),
        (7, true) => run_sized::<FUSED, 7, true>(source, solutions, visitor),
        (8, true) => run_sized::<FUSED, 8, true>(source, solutions, visitor),
        (contacts, _) => unreachable!("{contacts} contacts are refused by the constructors"),
    }
}

#[inline(always)]
fn run_sized<const FUSED: bool, const CONTACTS: usize, const BOTH_SIDES: bool>(
    source: &impl Determinants,
    solutions: &mut BatchSolutions,
    mut visitor: Option<Visitor<'_>>,
) {
    let words = words_per_point(CONTACTS);
    let count = source.points();
    let mut work = source.workspace();
    for first in (0..count).step_by(LANES) {
        // The last block repeats the last point.
        let mut points = [0; LANES];
        for (lane, point) in points.iter_mut().enumerate() {
            *point = (first + lane).min(count - 1);
        }
        source.evaluate::<FUSED>(&points, &mut work);
        let block = judge::<CONTACTS, BOTH_SIDES>(&work);
        let used = LANES.min(count - first);
        for (lane, &in_doubt) in block.in_doubt.iter().enumerate().take(used) {
            let point = first + lane;
            for word in 0..words {
                solutions.masks[point * words + word] = block.masks[word][lane];
            }
            solutions.in_doubt[point] = in_doubt >> SIGN_BIT == 1;
        }
        if let Some(visitor) = &mut visitor {
            tell::<CONTACTS, BOTH_SIDES>(&work, &block, first..first + used, source.load_unit(), visitor);
        }
    }
}

struct Block {
    masks: [[u64; LANES]; 4],
    /// In the sign bit.
    in_doubt: [u64; LANES],
}

/// Error bounds of `D` and of every `D_k`: `|det| <= prod |c_k|_1`, and so are the sums of the terms' sizes.
#[inline(always)]
fn bounds<const CONTACTS: usize>(work: &Workspace) -> (Lanes, [Lanes; CONTACTS]) {
    let mut numerators = [Lanes::splat(rounding(CONTACTS)); CONTACTS];
    let mut before = Lanes::splat(1.0);
    for contact in 0..CONTACTS {
        numerators[contact] = numerators[contact].times(&before).times(&work.load_size);
        before = before.times(&work.column_sizes[contact]);
    }
    let mut after = Lanes::splat(1.0);
    for contact in (0..CONTACTS).rev() {
        numerators[contact] = numerators[contact].times(&after);
        after = after.times(&work.column_sizes[contact]);
    }
    (before.times(&Lanes::splat(rounding(CONTACTS))), numerators)
}

#[inline(always)]
fn judge<const CONTACTS: usize, const BOTH_SIDES: bool>(work: &Workspace) -> Block {
    let (determinant_bound, numerator_bounds) = bounds::<CONTACTS>(work);
    let mut block = Block { masks: [[0; LANES]; 4], in_doubt: [0; LANES] };
    for lane in 0..LANES {
        let load = work.load_size.0[lane];
        let mut within = load > LOAD_RANGE.0 && load < LOAD_RANGE.1;
        for size in &work.column_sizes[..CONTACTS] {
            within &= size.0[lane] > COLUMN_RANGE.0 && size.0[lane] < COLUMN_RANGE.1;
        }
        block.in_doubt[lane] = u64::from(!within) << SIGN_BIT;
    }
    let (determinants, numerators) = work.values.split_at(1 << CONTACTS);
    let numerators = &numerators[..CONTACTS << (CONTACTS - usize::from(!BOTH_SIDES))];
    for (pattern, determinant) in determinants.iter().enumerate() {
        let mut excluded = [0_u64; LANES];
        let mut doubtful = [0_u64; LANES];
        for (contact, bound) in numerator_bounds.iter().enumerate() {
            let numerator = &numerators[numerator_index(CONTACTS, BOTH_SIDES, contact, pattern)];
            for lane in 0..LANES {
                // All in sign bits: too small to be sure of; opposite to D.
                let unsure = (numerator.0[lane].abs() - bound.0[lane]).to_bits();
                let opposite = numerator.0[lane].to_bits() ^ determinant.0[lane].to_bits();
                excluded[lane] |= opposite & !unsure;
                doubtful[lane] |= unsure;
            }
        }
        let (word, bit) = (pattern / 64, pattern % 64);
        for lane in 0..LANES {
            let singular = (determinant.0[lane].abs() - determinant_bound.0[lane]).to_bits();
            block.in_doubt[lane] |= (doubtful[lane] & !excluded[lane]) | singular;
            block.masks[word][lane] |= (!(excluded[lane] | doubtful[lane]) >> SIGN_BIT) << bit;
        }
    }
    // What is in doubt has no mask that someone could take for an answer.
    for lane in 0..LANES {
        let sure = (block.in_doubt[lane] >> SIGN_BIT).wrapping_sub(1);
        for mask in &mut block.masks {
            mask[lane] &= sure;
        }
    }
    block
}

/// Hands the solutions of a block to the visitor.
#[inline(never)]
fn tell<const CONTACTS: usize, const BOTH_SIDES: bool>(
    work: &Workspace,
    block: &Block,
    points: std::ops::Range<usize>,
    load_unit: f64,
    visitor: &mut dyn FnMut(usize, usize, &[f64]),
) {
    for (lane, point) in points.enumerate() {
        for (word, masks) in block.masks.iter().enumerate() {
            let mut rest = masks[lane];
            while rest != 0 {
                let pattern = word * 64 + rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let mut y = [0.0; CONTACTS];
                for (contact, y) in y.iter_mut().enumerate() {
                    let at = (1 << CONTACTS) + numerator_index(CONTACTS, BOTH_SIDES, contact, pattern);
                    *y = work.values[at].0[lane] / work.values[pattern].0[lane] * load_unit;
                }
                visitor(point, pattern, &y);
            }
        }
    }
}
