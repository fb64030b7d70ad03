//! Modes that are found in a range.

use crate::fault::Faults;
use crate::modes::branches::Branch;
use crate::modes::existence::{
    CountInterval, Existence, ModeInterval, cells, ends, is_same_end, nothing_is_left,
};
use crate::scan::HALVINGS;

/// Bisected ends nearer to each other than this share of the range are one.
const SAME: f64 = 1e-9;
/// The most patterns whose limits are computed.
pub(super) const PATTERNS: u64 = 1 << 14;

/// The modes of one direction of motion.
pub(crate) struct ModesFound {
    pub(crate) existence: Existence,
    pub(crate) counts: Vec<CountInterval>,
    /// How the number of solutions of each of `counts` is known.
    pub(crate) known: Vec<Knowledge>,
    /// For each of `counts` how each state starts, in words, where contacts that may lift off are at rest. Empty if nowhere.
    pub(crate) starts: Vec<Option<Vec<String>>>,
    pub(crate) gaps: Vec<Gap>,
    pub(crate) method: Method,
    /// Every value at which the mode problem was made.
    pub(crate) tried: Vec<f64>,
    pub(crate) same_ends: SameEnds,
    /// The states with a guided slider between its faces at single values.
    pub(crate) between_faces: SingleValues,
    /// With friction in hinges the branch of each of the modes, else none.
    pub(crate) branches: Vec<Branch>,
    /// The friction circles of their hinges.
    pub(crate) circles: Vec<usize>,
}

impl ModesFound {
    /// Modes with these numbers of solutions in between, of which nothing is proven; from values that were tried, unless more
    /// is said.
    pub(super) fn new(
        (existence, counts): (Existence, Vec<CountInterval>),
        elsewhere: Elsewhere,
        same_ends: SameEnds,
    ) -> Self {
        Self {
            known: vec![Knowledge { proven: Vec::new(), elsewhere }; counts.len()],
            existence,
            counts,
            starts: Vec::new(),
            gaps: Vec::new(),
            method: Method::Bracketing,
            tried: Vec::new(),
            same_ends,
            between_faces: SingleValues::Impossible,
            branches: Vec::new(),
            circles: Vec::new(),
        }
    }

    /// Whether there is no solution just beyond the end of a mode, as far as numbers of solutions are known.
    pub(super) fn nothing_is_left(&self, end: f64, begins: bool) -> bool {
        nothing_is_left(&self.counts, end, begins, |next, kept| self.same_ends.are_one(kept, next))
    }
}

/// Which ends in a range were taken for one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SameEnds {
    /// Ends nearer to each other than this.
    pub(crate) within: f64,
    /// The ends of the range and zero, each with the distance within which an end is reported as it.
    landmarks: [(f64, f64); 3],
}

impl SameEnds {
    /// Ends that were bisected between values of a range.
    pub(crate) fn bisected([from, to]: [f64; 2]) -> Self {
        let within = SAME * (to - from);
        Self { within, landmarks: [from, to, 0.0].map(|value| (value, within)) }
    }

    /// Zeros of determinants, which are reported as they are. Only the ends of what the model allows of the
    /// range were bisected: within what halving can resolve they are reported as the end of the range or the
    /// zero that they lead to.
    pub(super) fn zeros([from, to]: [f64; 2], allowed: [f64; 2]) -> Self {
        let resolution = (to - from) * 0.5_f64.powi(HALVINGS);
        let reach = |value: f64| {
            let distances = allowed.map(|end| (end - value).abs());
            distances.into_iter().filter(|distance| *distance <= resolution).fold(0.0, f64::max)
        };
        Self { within: 0.0, landmarks: [from, to, 0.0].map(|value| (value, reach(value))) }
    }

    /// Whether what lies between two ends has an extent.
    pub(super) fn are_two(&self, from: f64, to: f64) -> bool {
        to - from > self.within
    }

    /// Whether two ends are one, or as near to each other as zeros of determinants that are one.
    pub(crate) fn are_one(&self, from: f64, to: f64) -> bool {
        is_same_end(to, from) || !self.are_two(from, to)
    }

    /// Returns an end as it is reported: as the end of the range or the zero that it is the same as.
    pub(crate) fn told(&self, at: f64) -> f64 {
        let same = self.landmarks.iter().find(|(value, reach)| (at - value).abs() <= *reach);
        same.map_or(at, |(value, _)| *value)
    }
}

/// How the ends of modes were found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    /// As zeros of determinants.
    ClosedForm,
    /// The forces in each mode are affine in the couple of the only hinge with friction, whose radius is varied.
    Hinge,
    /// The mode problem is the same everywhere; `at_rest` if static friction is not.
    Same { at_rest: bool },
    /// From values that were tried.
    Bracketing,
}

/// States with a guided slider between its faces at single values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SingleValues {
    /// There can be none, or none outside of intervals that have them throughout.
    Impossible,
    /// They were sought where normal forces vanish, and found at these values.
    At(Vec<f64>),
    /// They were not sought.
    LeftOut,
}

impl SingleValues {
    /// The values.
    pub(crate) fn values(&self) -> &[f64] {
        match self {
            Self::At(values) => values,
            Self::Impossible | Self::LeftOut => &[],
        }
    }
}

/// Evidence for the number of solutions in an interval.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Knowledge {
    /// The stretches for all values of which the number is proven, both ends included; no two of them touch.
    pub(crate) proven: Vec<[f64; 2]>,
    pub(crate) elsewhere: Elsewhere,
}

/// Evidence for the number of solutions outside the proven stretches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Elsewhere {
    /// All of the interval is proven, but for what is next to ends of modes, as [`super::examine::MARGIN`]
    /// says.
    Nothing,
    /// The number follows from zeros of determinants.
    ClosedForm,
    /// It was found at values, the greatest distance between which is this.
    Sampled(f64),
    /// The certified search finds another number at some value.
    Contradicted,
}

/// A range in which there is no mode problem, and why: the faults in its middle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Gap {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) faults: Faults,
}

/// The cells between the ends of modes and of gaps in a range.
pub(super) fn cells_between(
    modes: &[ModeInterval],
    gaps: &[Gap],
    range: [f64; 2],
    same: impl Fn(f64, f64) -> bool,
) -> Vec<[f64; 2]> {
    cells(ends(modes).chain(gaps.iter().flat_map(|gap| [gap.from, gap.to])).chain(range), same)
}

/// The cells between the ends of modes within an interval, and its own.
pub(super) fn cells_within(
    modes: &[ModeInterval],
    [from, to]: [f64; 2],
    same: impl Fn(f64, f64) -> bool,
) -> Vec<[f64; 2]> {
    cells(ends(modes).filter(|end| from < *end && *end < to).chain([from, to]), same)
}

/// The widest part of an interval that is not proven; all of it if nothing is.
pub(super) fn left_out([from, to]: [f64; 2], proven: &[[f64; 2]]) -> f64 {
    let ends: Vec<f64> = std::iter::once(from).chain(proven.iter().flatten().copied()).chain([to]).collect();
    ends.chunks_exact(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

impl Gap {
    /// Whether the middle of a cell is within none of these.
    pub(super) fn none_covers(gaps: &[Self], [from, to]: [f64; 2]) -> bool {
        let middle = f64::midpoint(from, to);
        !gaps.iter().any(|gap| gap.from < middle && middle < gap.to)
    }

    /// The first reason, in words.
    pub(crate) fn reason(&self) -> String {
        self.faults.sorted().first().map_or_else(String::new, |fault| fault.kind.of_range())
    }
}
