//! The lower part of the tree: the last levels in `f64`, for several sibling nodes at once, with the
//! processor's vector instructions.

use std::hint::black_box;

use super::instructions::{Instructions, Set};
use super::lanes::{LANES, Lanes, Mask};
use super::layout::{CRAMER, LEVELS, Layout, SOLVED};
use super::leaf::{LeafErrors, Solved, cross, dot};
use super::level::{Level, Pivot, ROUNDED_UP, UNIT, WIDTH, bound_below};
use super::pattern::Pattern;
use super::upper::{Node, ResolvedRow};

/// The origin of a lane.
#[derive(Clone, Default)]
struct Origin {
    pattern: Pattern,
    above: Vec<ResolvedRow>,
}

/// Workspace of one thread.
pub(super) struct Kernel {
    instructions: Instructions,
    /// Places decided by the kernel.
    places: usize,
    /// How many of them, above those of Cramer's rule, hold contacts whose negative side has no solution.
    padded: usize,
    levels: Vec<Level>,
    pivots: Vec<Pivot>,
    origins: Vec<Origin>,
    used: usize,
    /// Column of the state of each place.
    columns: [usize; LEVELS],
    y: [Lanes; LEVELS],
    /// Patterns of places that could not be excluded.
    remaining: Vec<Pattern>,
}

impl Kernel {
    /// A workspace for problems of this layout.
    pub(super) fn new(layout: &Layout) -> Self {
        let places = layout.kernel_places();
        let row = [Lanes::ZERO; WIDTH];
        let level = |rows| Level { rows: vec![row; rows], bound: Lanes::ZERO, size: Lanes::ZERO };
        let zero = Lanes::ZERO;
        let pivot = Pivot { entries: row, inverse: zero, bound: zero, guard: zero, size: zero };
        Self {
            instructions: layout.instructions,
            places,
            padded: layout.padding().saturating_sub(CRAMER),
            levels: (0..=places).map(level).collect(),
            pivots: vec![pivot; places],
            origins: vec![Origin::default(); LANES],
            used: 0,
            columns: [0; LEVELS],
            y: [zero; LEVELS],
            remaining: Vec::new(),
        }
    }

    /// Keeps a pattern of places.
    pub(super) fn keep(&mut self, pattern: Pattern) {
        self.remaining.push(pattern);
    }

    /// All patterns kept since the last call.
    pub(super) fn take_remaining(&mut self, layout: &Layout) -> Vec<Pattern> {
        self.flush();
        let mut remaining: Vec<Pattern> =
            self.remaining.drain(..).filter_map(|pattern| layout.pattern(pattern)).collect();
        remaining.sort_unstable();
        remaining
    }

    /// Takes over a node whose undecided places are those of the kernel.
    pub(super) fn push(&mut self, node: &Node, layout: &Layout) {
        let lane = self.used;
        let level = &mut self.levels[self.places];
        for (target, row) in level.rows.iter_mut().zip(node.rows(layout)) {
            for (target, entry) in target.iter_mut().zip(row) {
                target.0[lane] = *entry;
            }
        }
        level.bound.0[lane] = node.bound + f64::EPSILON * node.size;
        level.size.0[lane] = node.size;
        self.origins[lane] = Origin { pattern: node.pattern, above: node.resolved(layout).collect() };
        self.used += 1;
        if self.used == LANES {
            self.flush();
        }
    }

    /// Screens the collected nodes. Unused lanes repeat the first.
    fn flush(&mut self) {
        if self.used == 0 {
            return;
        }
        let level = &mut self.levels[self.places];
        let entries = level.rows.iter_mut().flatten();
        for lanes in entries.chain([&mut level.bound, &mut level.size]) {
            let first = lanes.0[0];
            lanes.0[self.used..].fill(first);
        }
        descend(self);
        self.used = 0;
    }

    /// Visits all patterns of the kernel's places. From one pattern to the next, only the lowest places
    /// change.
    #[inline(always)]
    fn descend<const FUSED: bool>(&mut self) {
        for index in (0..1_usize << (self.places - CRAMER)).step_by(1 << self.padded) {
            let anew = if index == 0 { self.places - CRAMER } else { index.trailing_zeros() as usize + 1 };
            for place in (CRAMER..CRAMER + anew).rev() {
                let side = index >> (place - CRAMER) & 1;
                match place {
                    3 => self.decide::<FUSED, 3>(side),
                    4 => self.decide::<FUSED, 4>(side),
                    5 => self.decide::<FUSED, 5>(side),
                    6 => self.decide::<FUSED, 6>(side),
                    7 => self.decide::<FUSED, 7>(side),
                    8 => self.decide::<FUSED, 8>(side),
                    9 => self.decide::<FUSED, 9>(side),
                    10 => self.decide::<FUSED, 10>(side),
                    _ => self.decide::<FUSED, 11>(side),
                }
            }
            self.leaf::<FUSED>();
        }
    }

    /// One elimination step: the last undecided place takes `side`. Each lane has its own pivot row.
    #[inline(always)]
    fn decide<const FUSED: bool, const PLACE: usize>(&mut self, side: usize) {
        let place = PLACE;
        let width = 2 * place + 1;
        let column = width + side;
        let (below, here) = self.levels.split_at_mut(place + 1);
        let (child, node) = (&mut below[place], &here[0]);
        let stored = &mut self.pivots[place];
        let rows = &node.rows[..=PLACE];
        // Where the pivot row and the first row are exchanged.
        let mut pivot = rows[0][column];
        let mut swapped = [Mask::NONE; LEVELS];
        for row in 1..=PLACE {
            let candidate = rows[row][column];
            swapped[row - 1] = pivot.is_smaller_than(candidate);
            pivot = swapped[row - 1].select(candidate, pivot);
        }
        // Only the last one set counts.
        let mut later = Mask::NONE;
        for row in (0..PLACE).rev() {
            let first = swapped[row].without(later);
            later = later.or(first);
            swapped[row] = first;
        }
        let inverse = pivot.map(|pivot| 1.0 / pivot);
        let mut largest_factor = Lanes::ZERO;
        let mut factors = [Lanes::ZERO; LEVELS];
        for row in 0..PLACE {
            let entry = swapped[row].select(rows[0][column], rows[row + 1][column]);
            factors[row] = entry.zip(inverse, |entry, inverse| -entry * inverse);
            largest_factor = largest_factor.larger(factors[row].abs());
        }
        let mut size = Lanes::ZERO;
        for j in 0..width {
            // Vectorised lane by lane, not across entries.
            let first = black_box(&rows[0])[j];
            let mut kept = first;
            for row in 0..PLACE {
                kept = swapped[row].select(rows[row + 1][j], kept);
            }
            size = size.larger(kept.abs());
            stored.entries[j] = kept;
            for row in 0..PLACE {
                let entry = swapped[row].select(first, rows[row + 1][j]);
                child.rows[row][j] = factors[row].times_plus::<FUSED>(kept, entry);
            }
        }
        let bound = node.bound;
        let regular = bound.map(|bound| 2.0 * bound).is_smaller_than(pivot);
        let infinite = Lanes([f64::INFINITY; LANES]);
        let guard = pivot.zip(bound, |pivot, bound| ROUNDED_UP / (pivot.abs() - bound));
        let mut below = Lanes::ZERO;
        for lane in 0..LANES {
            let (size, node) = (size.0[lane], node.size.0[lane]);
            let factor = largest_factor.0[lane];
            below.0[lane] = bound_below(bound.0[lane], factor, guard.0[lane], size, node, 2.0 * UNIT);
        }
        child.bound = regular.select(below, infinite);
        child.size = node.size.zip(size, |node, row| node + row);
        stored.bound = regular.select(bound, infinite);
        stored.guard = regular.select(guard, infinite);
        stored.inverse = inverse;
        stored.size = size;
        self.columns[place] = column;
    }

    /// The last three places: all eight patterns by Cramer's rule.
    #[inline(always)]
    fn leaf<const FUSED: bool>(&mut self) {
        let node = &self.levels[CRAMER];
        let column = |j: usize| [node.rows[0][j], node.rows[1][j], node.rows[2][j]];
        let bounds = LeafErrors::new(node, &self.pivots);
        let load = column(0);
        let (zeroth, first, second) =
            ([column(1), column(2)], [column(3), column(4)], [column(5), column(6)]);
        let load_first = [cross::<FUSED>(load, first[0]), cross::<FUSED>(load, first[1])];
        let zeroth_load = [cross::<FUSED>(zeroth[0], load), cross::<FUSED>(zeroth[1], load)];
        for side_1 in 0..2 {
            for side_0 in 0..2 {
                let both = cross::<FUSED>(zeroth[side_0], first[side_1]);
                let last = dot::<FUSED>(both, load);
                for side_2 in 0..2 {
                    let determinant = dot::<FUSED>(both, second[side_2]);
                    let numerators = [
                        dot::<FUSED>(load_first[side_1], second[side_2]),
                        dot::<FUSED>(zeroth_load[side_0], second[side_2]),
                        last,
                    ];
                    let sides = [side_0, side_1, side_2];
                    let solved = self.multiples::<FUSED>(determinant, numerators, sides);
                    let excess = solved.excess(&bounds);
                    if !excess.all_positive() {
                        self.substitute::<FUSED>(&solved, &bounds, excess, sides);
                    }
                }
            }
        }
    }

    /// Back-substitution through the lowest places, without division by the determinant.
    #[inline(always)]
    fn multiples<const FUSED: bool>(
        &self,
        determinant: Lanes,
        numerators: [Lanes; CRAMER],
        sides: [usize; CRAMER],
    ) -> Solved {
        let mut multiples = [Lanes::ZERO; SOLVED];
        multiples[..CRAMER].copy_from_slice(&numerators);
        for place in CRAMER..SOLVED {
            let pivot = &self.pivots[place];
            let mut value = pivot.entries[0].times(determinant);
            for below in 0..place {
                let column = if below < CRAMER { 1 + 2 * below + sides[below] } else { self.columns[below] };
                let negative = pivot.entries[column].map(|c| -c);
                value = negative.times_plus::<FUSED>(multiples[below], value);
            }
            multiples[place] = value.times(pivot.inverse);
        }
        Solved { determinant, multiples }
    }

    /// Back-substitution through the kernel's places, until some `y` is certainly negative in every lane.
    #[inline(always)]
    fn substitute<const FUSED: bool>(
        &mut self,
        solved: &Solved,
        bounds: &LeafErrors,
        mut excess: Lanes,
        sides: [usize; CRAMER],
    ) {
        let inverse = solved.determinant.map(|determinant| 1.0 / determinant);
        let mut largest = Lanes::ZERO;
        for place in 0..CRAMER {
            self.columns[place] = 1 + 2 * place + sides[place];
        }
        for place in 0..SOLVED {
            self.y[place] = solved.multiples[place].times(inverse);
            largest = largest.larger(self.y[place].abs());
        }
        let mut error = solved.error_of_y(bounds, bounds.largest(), largest);
        for place in SOLVED..self.places {
            let pivot = &self.pivots[place];
            let mut value = pivot.entries[0];
            for below in 0..place {
                let coefficient = pivot.entries[self.columns[below]];
                value = coefficient.map(|c| -c).times_plus::<FUSED>(self.y[below], value);
            }
            let y = value.times(pivot.inverse);
            let here = pivot.error_of_y(place as f64, y, largest, error);
            excess = excess.larger(y.zip(here, |y, error| -y - error));
            if excess.all_positive() {
                return;
            }
            self.y[place] = y;
            error = error.larger(here);
            largest = largest.larger(y.abs());
        }
        self.keep_lanes(excess, solved.error_of_y(bounds, bounds.determinant, largest));
    }

    /// Keeps the patterns of the remaining lanes, unless the places above exclude them.
    #[inline(never)]
    fn keep_lanes(&mut self, excess: Lanes, error: Lanes) {
        let negative =
            (0..self.places).map(|place| (((self.columns[place] - 1) & 1) as u64) << place).sum::<u64>();
        for lane in 0..self.used {
            if excess.0[lane] > 0.0 || self.is_excluded(lane, error.0[lane]) {
                continue;
            }
            let Pattern { gap, negative: above } = self.origins[lane].pattern;
            self.remaining.push(Pattern { gap, negative: above | negative });
        }
    }

    /// Back-substitution of one lane from the places of the leaf, whose errors are given: whether some
    /// unknown is certainly out of range.
    fn is_excluded(&self, lane: usize, error: f64) -> bool {
        let mut unknowns = Vec::with_capacity(self.places + self.origins[lane].above.len());
        unknowns.extend(self.y[..CRAMER].iter().map(|y| Unknown { value: y.0[lane], error }));
        for place in CRAMER..self.places {
            let Pivot { entries, inverse, bound, .. } = &self.pivots[place];
            let coefficients = self.columns[..place].iter().map(|&column| entries[column].0[lane]);
            let equation =
                Equation { load: entries[0].0[lane], pivot: 1.0 / inverse.0[lane], bound: bound.0[lane] };
            let unknown = equation.solve(coefficients, &unknowns);
            if unknown.value < -unknown.error {
                return true;
            }
            unknowns.push(unknown);
        }
        let Origin { pattern, above } = &self.origins[lane];
        for (place, ResolvedRow { entries, pivot, bound }) in (self.places..).zip(above) {
            let (kernel, decided) = entries[1..].split_at(2 * self.places);
            let coefficients = self.columns[..self.places].iter().map(|&column| kernel[column - 1]);
            let equation = Equation { load: entries[0], pivot: *pivot, bound: *bound };
            let unknown = equation.solve(coefficients.chain(decided.iter().copied()), &unknowns);
            let in_gap = pattern.gap >> place & 1 == 1;
            if unknown.value < -unknown.error || in_gap && unknown.value > 1.0 + unknown.error {
                return true;
            }
            unknowns.push(unknown);
        }
        false
    }
}

/// A value and a bound on its error.
pub(super) struct Unknown {
    pub(super) value: f64,
    pub(super) error: f64,
}

/// One equation of the back-substitution, and a bound on the error of each of its entries.
pub(super) struct Equation {
    pub(super) load: f64,
    pub(super) pivot: f64,
    pub(super) bound: f64,
}

impl Equation {
    /// The unknown at the pivot; its error is infinite where the pivot may be zero.
    pub(super) fn solve(&self, coefficients: impl Iterator<Item = f64>, unknowns: &[Unknown]) -> Unknown {
        let (mut value, mut size) = (self.load, self.load.abs());
        let mut error = self.bound;
        for (coefficient, unknown) in coefficients.zip(unknowns) {
            value -= coefficient * unknown.value;
            size += (coefficient * unknown.value).abs();
            error += coefficient.abs() * unknown.error + self.bound * (unknown.value.abs() + unknown.error);
        }
        error += (unknowns.len() as f64 + 4.0) * UNIT * size;
        let y = value / self.pivot;
        let certain = self.pivot.abs() - self.bound;
        if certain <= 0.0 || certain.is_nan() {
            return Unknown { value: y, error: f64::INFINITY };
        }
        let error = (error + y.abs() * self.bound) / certain + 8.0 * UNIT * y.abs();
        Unknown { value: y, error: error * ROUNDED_UP + f64::MIN_POSITIVE }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,fma")]
fn descend_avx512(kernel: &mut Kernel) {
    kernel.descend::<true>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn descend_avx2(kernel: &mut Kernel) {
    kernel.descend::<true>();
}

/// Visits all patterns below the collected nodes.
fn descend(kernel: &mut Kernel) {
    match kernel.instructions.set() {
        #[cfg(target_arch = "x86_64")]
        #[expect(unsafe_code, reason = "several times as fast as generic x86-64, chosen at run time")]
        // SAFETY: `Instructions` contains only those that the processor has.
        Set::Avx512 => unsafe { descend_avx512(kernel) },
        #[cfg(target_arch = "x86_64")]
        #[expect(unsafe_code, reason = "several times as fast as generic x86-64, chosen at run time")]
        // SAFETY: as above.
        Set::Avx2 => unsafe { descend_avx2(kernel) },
        Set::Generic => kernel.descend::<false>(),
    }
}
