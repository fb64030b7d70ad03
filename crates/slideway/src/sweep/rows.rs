//! Rows of a sweep: one for each state of each point.

use crate::choice::worded;
use crate::report::Verdict;

worded! {
    /// What became of a point.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum PointStatus {
        /// No solution: friction locks the mechanism.
        None = "none",
        /// Exactly one.
        One = "one",
        /// Several, each in its own contact mode.
        Several = "several",
        /// Infinitely many.
        Continuum = "continuum",
        /// No solution, but a state in a preload gap.
        PreloadGap = "preload_gap",
        /// Nothing was found, but not every pattern could be decided.
        Unknown = "unknown",
        /// The mechanism cannot be assembled there, or lies outside of its travel.
        NoPosition = "no_position",
        /// `solve` refuses the point for another reason.
        Refused = "refused",
    }
}

impl PointStatus {
    /// Whether there is an answer at the point.
    pub fn is_solved(self) -> bool {
        !matches!(self, Self::NoPosition | Self::Refused)
    }
}

worded! {
    /// What a row tells of.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum RowKind {
        /// A point without any state.
        #[default]
        Nothing = "",
        /// A solution inside of its contact mode.
        Solution = "solution",
        /// A solution with some normal force or determinant that is zero within rounding.
        Boundary = "boundary",
        /// A state with a contact between its faces.
        PreloadGap = "preload_gap",
        /// A corner of infinitely many solutions.
        Continuum = "continuum",
        /// A mode of which it cannot be told whether it has a solution.
        Undecided = "undecided",
        /// A solution that stays at rest.
        Rest = "rest",
        /// A corner of the forces with which it stays at rest.
        RestRange = "rest_range",
    }
}

worded! {
    /// What is exact about a point that was inserted: where a mode begins or ends.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum Breakpoint {
        /// An ordinary point.
        #[default]
        No = "",
        /// A determinant vanishes, and no solution is left on the other side: friction locks the mechanism.
        Locking = "locking",
        /// A determinant vanishes, so normal forces of a mode grow without bound; there are other solutions on
        /// both sides.
        WithoutBound = "without_bound",
        /// A normal force vanishes.
        SideChange = "side_change",
        /// The preload friction has moved to one face.
        GapCloses = "gap_closes",
        /// A guided slider tips.
        Tipping = "tipping",
        /// Two solutions with friction in hinges merge and end; the point lies 1e-10 of the range inside, where both exist.
        Fold = "fold",
        /// The force of a hinge with friction vanishes.
        HingeUnloaded = "hinge_unloaded",
        /// Beyond it there is no position, or a value that is not allowed; the point has no states itself.
        NotSolved = "not_solved",
    }
}

impl RowKind {
    /// Whether it stays at rest in the state of the row.
    pub fn rests(self) -> bool {
        matches!(self, Self::Rest | Self::RestRange)
    }
}

/// One row, but for its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowHead {
    /// Number of the point, from 0, inserted ones included.
    pub point: u64,
    /// Reason for which a mode begins or ends exactly at the point, if one does.
    pub breakpoint: Breakpoint,
    /// Whether the point was inserted, because it is none of the sweep's own.
    pub inserted: bool,
    /// Outcome at the point.
    pub status: PointStatus,
    /// Number of its solutions.
    pub solutions: u32,
    /// Number of its states with a contact between its faces.
    pub gap_states: u32,
    /// Number of solutions that a guided slider rejects because it would tip.
    pub rejected: u32,
    /// Whether a block tips in its state.
    pub tips: bool,
    /// Kind of state in the row.
    pub kind: RowKind,
    /// Number of the branch, from 1; 0 if there is none.
    pub branch: u32,
    /// Whether the state is attainable.
    pub verdict: Verdict,
    /// Whether the determinant of the mode is negative; nothing if it is not known.
    pub negative_determinant: Option<bool>,
}

impl RowHead {
    /// The row of a point of which nothing else is known.
    pub const fn of_point(point: u64, status: PointStatus) -> Self {
        Self {
            point,
            breakpoint: Breakpoint::No,
            inserted: false,
            status,
            solutions: 0,
            gap_states: 0,
            rejected: 0,
            tips: false,
            kind: RowKind::Nothing,
            branch: 0,
            verdict: Verdict::NotComputed,
            negative_determinant: None,
        }
    }

    /// The sign of the determinant of the mode in tables; nothing if it is not known.
    pub fn determinant_sign(&self) -> &'static str {
        self.negative_determinant.map_or("", |is_negative| if is_negative { "-" } else { "+" })
    }
}

/// A point that is not solved.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    /// Its number.
    pub point: u64,
    /// Obstacle, by its kind ...
    pub status: PointStatus,
    /// ... and in words.
    pub reason: String,
}

/// Rows of neighbouring points, in their order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rows {
    /// Contacts of the mechanism.
    pub contacts: usize,
    /// Varied quantities.
    pub varied: usize,
    /// Numbers in each row: the varied quantities, then what [`super::Sweep::columns`] lists.
    pub width: usize,
    /// One for each row.
    pub heads: Vec<RowHead>,
    /// `width` numbers for each row; not a number where there is none.
    pub numbers: Vec<f64>,
    /// One character of each row for each contact: "+", "-", "0" in a gap; blank where there is no state.
    pub patterns: Vec<u8>,
    /// Points that are not solved.
    pub refusals: Vec<Refusal>,
    /// How many points there are.
    pub points: u64,
}

impl Rows {
    /// No rows yet.
    pub fn new(contacts: usize, varied: usize, width: usize) -> Self {
        Self { contacts, varied, width, ..Self::default() }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.heads.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.heads.is_empty()
    }

    /// The numbers of a row.
    pub fn numbers(&self, row: usize) -> &[f64] {
        &self.numbers[row * self.width..][..self.width]
    }

    /// The pattern of a row.
    pub fn pattern(&self, row: usize) -> &[u8] {
        &self.patterns[row * self.contacts..][..self.contacts]
    }

    /// Makes room for the rows of so many points.
    pub(super) fn reserve(&mut self, points: usize) {
        let rows = points + points / 2;
        self.heads.reserve(rows);
        self.numbers.reserve(rows * self.width);
        self.patterns.reserve(rows * self.contacts);
    }

    /// Number of rows of the point whose first row this is.
    pub(super) fn states_from(&self, first: usize) -> usize {
        let point = self.heads[first].point;
        self.heads[first..].iter().take_while(|head| head.point == point).count()
    }

    /// Forgets all rows but the first ones.
    pub(super) fn truncate(&mut self, rows: usize) {
        self.heads.truncate(rows);
        self.numbers.truncate(rows * self.width);
        self.patterns.truncate(rows * self.contacts);
    }

    /// Adds a row without a state: its varied quantities are known alone.
    pub(super) fn push_empty(&mut self, head: RowHead, varied: &[f64]) {
        self.heads.push(head);
        self.numbers.extend_from_slice(varied);
        self.numbers.resize(self.heads.len() * self.width, f64::NAN);
        self.patterns.resize(self.heads.len() * self.contacts, b' ');
    }
}
