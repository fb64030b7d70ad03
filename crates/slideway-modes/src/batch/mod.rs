//! One structure, very many points: all modes of each point as a bit mask, computed for several
//! points at a time.
//!
//! [`FrictionBatch`] varies some friction coefficients of one structure, as in a sweep or a Monte Carlo
//! study, for 1 to 8 contacts, with one or two versions of the columns and with jumps. If other numbers
//! change, [`screen`](crate::screen) processes one point after the other.
//!
//! # Method
//! `y_k = D_k / D` by Cramer's rule, so the signs of determinants decide, without division. `D` and `D_k` are
//! multi-affine in the friction coefficients (theory, section 5): their coefficients are computed once, and
//! one contraction for each varied `mu_k` gives all patterns together, for 32 points at a time, with AVX2 and
//! FMA instructions if the processor has them. Nothing is allocated per point.
//!
//! # Accuracy
//! Every determinant is compared with a bound on its rounding errors,
//! `(r (r + 1) / 2 + 6 r) eps prod_k |c_k|_1`. A point is *in doubt* if some `D` is within its bound (a mode
//! that may be singular), or some `D_k` that decides about a solution is (a contact that may be about to
//! change sides): its mask is empty, and it is to be solved with [`enumerate`](super::enumerate). Masks of
//! other points are certain: they hold for the numbers as given, rounding included. The bound is that of the
//! computation, narrower than the tolerance with which `enumerate` places a contact on the boundary. Points
//! whose numbers are not finite or far from 1 (a column sum outside 1e-12 to 1e12, loads outside 1e-60 to
//! 1e60) are in doubt. So is a point at which some `y_k` vanishes for any friction.
//!
//! A mask shows which patterns have a solution; states between the faces of a contact with preload (gap
//! states) are not searched for.
//!
//! Patterns are numbers: bit `k` is set if contact `k` is pressed on its negative side.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled without the chosen instructions")]
#![expect(clippy::needless_range_loop, reason = "loops over lanes run through several arrays at once")]

mod contraction;
mod determinants;
mod friction;
mod kernel;
mod lanes;

pub use friction::FrictionBatch;
pub use kernel::BatchState;

use crate::problem::{ModeProblemError, Side};

/// Largest number of contacts of a batch.
pub const MOST_CONTACTS: usize = 8;

/// A batch that cannot be solved.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum BatchError {
    /// No contacts, or more than [`MOST_CONTACTS`].
    #[error("{contacts} contacts, but a batch takes 1 to {MOST_CONTACTS}")]
    Contacts {
        /// Contacts of the structure.
        contacts: usize,
    },
    /// A contact that does not exist or is listed twice.
    #[error("varied contact {contact} (counted from 0) does not exist or is listed twice")]
    Varied {
        /// The contact, from 0.
        contact: usize,
    },
    /// A list of numbers with the wrong length.
    #[error("expected {expected} numbers, found {found}")]
    Length {
        /// The number that the contacts and points require.
        expected: usize,
        /// The number that was given.
        found: usize,
    },
    /// The structure's numbers do not define a mode problem.
    #[error(transparent)]
    Problem(#[from] ModeProblemError),
}

/// For every point of a batch, the patterns that have a solution.
///
/// Reuse it for the next batch, so that no memory is allocated again.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct BatchSolutions {
    contacts: usize,
    masks: Vec<u64>,
    in_doubt: Vec<bool>,
}

impl BatchSolutions {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.in_doubt.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.in_doubt.is_empty()
    }

    /// The masks of all points: bit `p` is set if pattern `p` has a solution. Each point has one word, or 2
    /// for 7 contacts and 4 for 8. Points in doubt have no bit set.
    pub fn masks(&self) -> &[u64] {
        &self.masks
    }

    /// Whether rounding errors could change the mask of this point; if so, solve it with
    /// [`enumerate`](super::enumerate).
    ///
    /// # Panics
    /// If there is no such point, as in all methods.
    pub fn is_in_doubt(&self, point: usize) -> bool {
        self.in_doubt[point]
    }

    /// All points in doubt.
    pub fn doubtful_points(&self) -> impl Iterator<Item = usize> {
        self.in_doubt.iter().enumerate().filter(|(_, in_doubt)| **in_doubt).map(|(point, _)| point)
    }

    /// Number of solutions of a point; `None` if it is in doubt.
    pub fn count(&self, point: usize) -> Option<u32> {
        let ones = self.words(point).iter().map(|word| word.count_ones()).sum();
        (!self.in_doubt[point]).then_some(ones)
    }

    /// The patterns of a point that have a solution, in increasing order.
    pub fn patterns(&self, point: usize) -> impl Iterator<Item = usize> {
        let words = self.words(point).iter().enumerate();
        words.flat_map(|(at, word)| {
            (0..64).filter(move |bit| word >> bit & 1 == 1).map(move |bit| at * 64 + bit)
        })
    }

    fn words(&self, point: usize) -> &[u64] {
        let words = words_per_point(self.contacts);
        &self.masks[point * words..][..words]
    }

    fn reset(&mut self, contacts: usize, points: usize) {
        self.contacts = contacts;
        self.masks.clear();
        self.masks.resize(points * words_per_point(contacts), 0);
        self.in_doubt.clear();
        self.in_doubt.resize(points, false);
    }
}

/// The sides of the contacts in a pattern.
///
/// ```
/// use slideway_modes::{Side, batch};
/// assert_eq!(batch::sides(0b10, 2), [Side::Positive, Side::Negative]);
/// ```
pub fn sides(pattern: usize, contacts: usize) -> Vec<Side> {
    (0..contacts).map(|contact| Side::BOTH[pattern >> contact & 1]).collect()
}

fn words_per_point(contacts: usize) -> usize {
    (1_usize << contacts).div_ceil(64)
}
