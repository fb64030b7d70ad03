//! From determinants to bit masks, for blocks of points.
//!
//! By Cramer's rule, `y_k = D_k / D`, where `D_k` has the right-hand side in column `k`. A pattern therefore
//! has a solution if no `D_k` has the opposite sign to `D`, which needs no division and no branch.

use super::determinants::{FrictionPoints, Workspace, numerator_index};
use super::lanes::{LANES, Lanes};
use super::{BatchSolutions, MOST_CONTACTS, words_per_point};
use std::ops::Range;

/// Column sums outside this range (and loads outside its fifth power) may lose more to underflow than the
/// rounding error bound covers.
const COLUMN_RANGE: (f64, f64) = (1e-12, 1e12);
const LOAD_RANGE: (f64, f64) = (1e-60, 1e60);
const SIGN_BIT: u32 = 63;

/// A solution of a point.
#[derive(Debug, Clone, Copy)]
pub struct BatchState<'y> {
    /// The index of the point, in the given order.
    pub point: usize,
    /// The pattern: bit k is set if contact k is on its negative side.
    pub pattern: usize,
    /// `y_k = |N_k|`.
    pub y: &'y [f64],
    /// Whether the determinant of the pattern's equations is negative.
    pub negative_determinant: bool,
}

/// Receives each solution.
pub(super) type Visitor<'a> = &'a mut dyn FnMut(BatchState<'_>);

/// Computes masks and doubts for all points.
pub(super) fn run(points: &FrictionPoints<'_>, solutions: &mut BatchSolutions, visitor: Option<Visitor<'_>>) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        #[expect(
            unsafe_code,
            reason = "1.4 times as fast in benches/batch.rs; the processor has just been asked"
        )]
        unsafe {
            run_avx2(points, solutions, visitor);
        }
        return;
    }
    run_baseline(points, solutions, visitor);
}

/// The same, using only instructions that every processor of the target has.
pub(super) fn run_baseline(
    points: &FrictionPoints<'_>,
    solutions: &mut BatchSolutions,
    visitor: Option<Visitor<'_>>,
) {
    run_any::<false>(points, solutions, visitor);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn run_avx2(points: &FrictionPoints<'_>, solutions: &mut BatchSolutions, visitor: Option<Visitor<'_>>) {
    run_any::<true>(points, solutions, visitor);
}

#[inline(always)]
fn run_any<const FUSED: bool>(
    points: &FrictionPoints<'_>,
    solutions: &mut BatchSolutions,
    mut visitor: Option<Visitor<'_>>,
) {
    let (contacts, both_sides, count) = (points.contacts(), points.both_sides(), points.points());
    let words = words_per_point(contacts);
    let mut work = points.workspace();
    let told = Told::new(contacts, both_sides, points.load_unit());
    for first in (0..count).step_by(LANES) {
        // The last block repeats the last point.
        let mut block_points = [0; LANES];
        for (lane, point) in block_points.iter_mut().enumerate() {
            *point = (first + lane).min(count - 1);
        }
        points.evaluate::<FUSED>(&block_points, &mut work);
        let block = judge_any(contacts, both_sides, &work);
        let used = LANES.min(count - first);
        if words == 1 {
            solutions.masks[first..first + used].copy_from_slice(&block.masks[0][..used]);
        } else {
            let rows = solutions.masks[first * words..].chunks_exact_mut(words);
            for (lane, row) in rows.enumerate().take(used) {
                for (word, masks) in row.iter_mut().zip(&block.masks) {
                    *word = masks[lane];
                }
            }
        }
        let in_doubt = &mut solutions.in_doubt[first..first + used];
        for (in_doubt, bits) in in_doubt.iter_mut().zip(&block.in_doubt) {
            *in_doubt = bits >> SIGN_BIT == 1;
        }
        if let Some(visitor) = &mut visitor {
            told.tell(first..first + used, &work, &block, visitor);
        }
    }
}

#[inline(always)]
fn judge_any(contacts: usize, both_sides: bool, work: &Workspace) -> Block {
    match (contacts, both_sides) {
        (1, false) => judge::<1, false>(work),
        (2, false) => judge::<2, false>(work),
        (3, false) => judge::<3, false>(work),
        (4, false) => judge::<4, false>(work),
        (5, false) => judge::<5, false>(work),
        (6, false) => judge::<6, false>(work),
        (7, false) => judge::<7, false>(work),
        (8, false) => judge::<8, false>(work),
        (1, true) => judge::<1, true>(work),
        (2, true) => judge::<2, true>(work),
        (3, true) => judge::<3, true>(work),
        (4, true) => judge::<4, true>(work),
        (5, true) => judge::<5, true>(work),
        (6, true) => judge::<6, true>(work),
        (7, true) => judge::<7, true>(work),
        (8, true) => judge::<8, true>(work),
        _ => unreachable!("{contacts} contacts are refused by the constructors"),
    }
}

struct Block {
    masks: [[u64; LANES]; 4],
    /// In the sign bit.
    in_doubt: [u64; LANES],
}

/// Error bounds of `D` and of every `D_k`: `prod |c_k|_1` bounds `|det|` and the sums of the sizes of its
/// terms.
///
/// Sets `in_doubt` where numbers are outside the range in which this holds.
#[inline(always)]
fn bounds<const CONTACTS: usize>(
    work: &Workspace,
    in_doubt: &mut [u64; LANES],
) -> (Lanes, [Lanes; CONTACTS]) {
    let mut determinant = Lanes::ZERO;
    let mut numerators = [Lanes::ZERO; CONTACTS];
    for lane in 0..LANES {
        let load = work.load_size.0[lane];
        let mut outside = u64::from(!(load > LOAD_RANGE.0 && load < LOAD_RANGE.1));
        let mut before = work.relative_error;
        for contact in 0..CONTACTS {
            let size = work.column_sizes[contact].0[lane];
            outside |= u64::from(!(size > COLUMN_RANGE.0 && size < COLUMN_RANGE.1));
            numerators[contact].0[lane] = before * load;
            before *= size;
        }
        determinant.0[lane] = before;
        let mut after = 1.0;
        for contact in (0..CONTACTS).rev() {
            numerators[contact].0[lane] *= after;
            after *= work.column_sizes[contact].0[lane];
        }
        in_doubt[lane] = outside << SIGN_BIT;
    }
    (determinant, numerators)
}

#[inline(always)]
fn judge<const CONTACTS: usize, const BOTH_SIDES: bool>(work: &Workspace) -> Block {
    let mut block = Block { masks: [[0; LANES]; 4], in_doubt: [0; LANES] };
    let (determinant_bound, bounds) = bounds::<CONTACTS>(work, &mut block.in_doubt);
    let (determinants, numerators) = work.values.split_at(1 << CONTACTS);
    for (pattern, determinant) in determinants.iter().enumerate() {
        let mut above = [&Lanes::ZERO; CONTACTS];
        for (contact, numerator) in above.iter_mut().enumerate() {
            *numerator = &numerators[numerator_index(CONTACTS, BOTH_SIDES, contact, pattern)];
        }
        let masks = &mut block.masks[pattern / 64];
        for lane in 0..LANES {
            let below = determinant.0[lane];
            let (mut excluded, mut doubtful) = (0, 0);
            for contact in 0..CONTACTS {
                // All in sign bits: too small to be certain; opposite to D.
                let unsure = (above[contact].0[lane].abs() - bounds[contact].0[lane]).to_bits();
                let opposite = above[contact].0[lane].to_bits() ^ below.to_bits();
                excluded |= opposite & !unsure;
                doubtful |= unsure;
            }
            let singular = (below.abs() - determinant_bound.0[lane]).to_bits();
            block.in_doubt[lane] |= (doubtful & !excluded) | singular;
            masks[lane] |= (!(excluded | doubtful) >> SIGN_BIT) << (pattern % 64);
        }
    }
    // Points in doubt get no mask that could be mistaken for an answer.
    for masks in &mut block.masks {
        for lane in 0..LANES {
            masks[lane] &= (block.in_doubt[lane] >> SIGN_BIT).wrapping_sub(1);
        }
    }
    block
}

/// How solutions are reported.
struct Told {
    contacts: usize,
    /// For each pattern, where the numerators of the contacts are.
    numerators: Vec<[usize; MOST_CONTACTS]>,
    load_unit: f64,
}

impl Told {
    fn new(contacts: usize, both_sides: bool, load_unit: f64) -> Self {
        let patterns = 1 << contacts;
        let of = |pattern: usize| {
            let mut places = [0; MOST_CONTACTS];
            for (contact, place) in places[..contacts].iter_mut().enumerate() {
                *place = patterns + numerator_index(contacts, both_sides, contact, pattern);
            }
            places
        };
        Self { contacts, numerators: (0..patterns).map(of).collect(), load_unit }
    }

    /// Passes the solutions of a block to the visitor.
    #[inline(never)]
    fn tell(&self, points: Range<usize>, work: &Workspace, block: &Block, visitor: Visitor<'_>) {
        let mut y = [0.0; MOST_CONTACTS];
        let y = &mut y[..self.contacts];
        for (lane, point) in points.enumerate() {
            for (word, masks) in block.masks.iter().enumerate().take(words_per_point(self.contacts)) {
                let mut rest = masks[lane];
                while rest != 0 {
                    let pattern = word * 64 + rest.trailing_zeros() as usize;
                    rest &= rest - 1;
                    let determinant = work.values[pattern].0[lane];
                    for (y, at) in y.iter_mut().zip(&self.numerators[pattern]) {
                        *y = work.values[*at].0[lane] / determinant * self.load_unit;
                    }
                    visitor(BatchState { point, pattern, y, negative_determinant: determinant < 0.0 });
                }
            }
        }
    }
}
