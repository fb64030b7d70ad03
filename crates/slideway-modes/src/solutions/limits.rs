//! How much is searched for, and how much is kept.

/// How much work an enumeration may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Largest number of contacts.
    pub contacts: usize,
    /// Largest number of patterns, `2^(r-j) 3^j` with `j` contacts at which the right-hand side jumps.
    pub patterns: u64,
    /// Largest number of solutions and gap states; one shared by several patterns counts once. A search goes on until
    /// it has more, so an answer with exactly so many can be complete. If this is 1, it ends at the first solution:
    /// whether there are others is then not known.
    pub solutions: usize,
    /// Largest number of patterns listed with one solution or one singular set.
    pub listed: usize,
    /// Largest number of (nearly) singular patterns that are examined; further ones are only counted.
    pub singular: usize,
    /// Largest number of bases tried, over all singular patterns, to describe what they admit within
    /// tolerances. Exact sets have a limit of their own: 4096 corners.
    pub bases: u64,
}

impl Default for Limits {
    /// 24 contacts, 50 million patterns, 100 000 solutions.
    fn default() -> Self {
        Self {
            contacts: 24,
            patterns: 50_000_000,
            solutions: 100_000,
            listed: 1024,
            singular: 10_000,
            bases: 200_000,
        }
    }
}
