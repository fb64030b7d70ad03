//! Problems given directly as matrices, without a mechanism.
//!
//! Many questions lead to a system of linear equations in which each unknown switches between two versions of
//! its coefficients, depending on its sign. Slideway finds *all* solutions of such a system, and says whether
//! it is proven that there are no others. Eight forms are read:
//!
//! | type | arrays | problem | source |
//! |---|---|---|---|
//! | `lcp` | `M`, `q` | `w = M z + q`, `w >= 0`, `z >= 0`, `w_k z_k = 0` | linear complementarity problem (Cottle, Pang, Stone, The Linear Complementarity Problem, 1992) |
//! | `ave` | `A`, `B`, `b` | `A x + B abs(x) = b` | absolute value equation (Rohn, 2004; Mangasarian, 2007) |
//! | `block_ave` | `B`, `b`, `blocks`, and perhaps `A` | `A x + B abs(x) = b`, where `abs(x)` has the lengths of blocks of one or two components, whose sizes are `blocks`; without `A`, `A = I` | hinges with friction: [`blocks`](crate::blocks) |
//! | `hlcp` | `A`, `B`, `q` | `A w - B z = q`, `w >= 0`, `z >= 0`, `w_k z_k = 0` | horizontal linear complementarity problem (Sznajder and Gowda, 1995); with `A = I` an LCP with `M = B` |
//! | `mlcp` | `A`, `B`, `C`, `D`, `a`, `b` | `A u + C z + a = 0`, `w = D u + B z + b`, `w >= 0`, `z >= 0`, `w_k z_k = 0`; `u` free | mixed linear complementarity problem (Cottle, Pang, Stone, 1992) |
//! | `mcp` | `M`, `q`, `l`, `u` | `w = M z + q`, `l <= z <= u`, `w_k >= 0` where `z_k < u_k`, `w_k <= 0` where `z_k > l_k` | mixed complementarity problem with a linear function (Dirkse and Ferris, 1995) |
//! | `game` | `A`, and perhaps `B` | all Nash equilibria of a bimatrix game: `x` maximises `x^T A y`, `y` maximises `x^T B y`; without `B`, `B = -A` | Lemke and Howson (1964) |
//! | `modes` | `columns_positive`, `columns_negative`, `right_hand_side`, and perhaps `jumps_positive`, `jumps_negative` | [`ModeProblem`] | Klepp (2002), eqs. (6), (8) |
//!
//! The data flow: bytes -> [`RawProblem`] -> [`solve`] -> [`RawReport`] -> text, JSON or `.npz`.
//!
//! ```
//! use std::ops::ControlFlow;
//! use slideway_modes::{Proof, SearchOptions};
//! use slideway_modes::raw_problem::{RawProblem, solve};
//!
//! let problem = RawProblem::from_json(br#"{"type": "lcp", "M": [[1, 2], [2, 1]], "q": [-1, -1]}"#)?;
//! let report = solve(&problem, &SearchOptions::default(), 10, &mut |_| ControlFlow::Continue(()))?;
//! assert_eq!(report.count, "3");
//! assert_eq!(report.complete, Proof::Proven);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Numbers
//! Every number is a 64-bit floating-point number; decimal fractions, large integers and, in JSON, fractions such as
//! `"2/3"` are rounded to the nearest one. Proofs refer to these numbers, taken as exact; sums of two of them are not rounded. An
//! unknown whose value is beyond the range of such numbers has none, and is reported as text:
//! [`BeyondRange`].

mod answer;
#[cfg(any(feature = "json", feature = "npz"))]
mod assemble;
mod block_answer;
mod block_equation;
mod block_units;
mod continuum;
mod correspondence;
#[cfg(feature = "json")]
mod exact_file;
#[cfg(any(feature = "json", feature = "npz"))]
mod fault;
mod free;
mod game;
#[cfg(feature = "json")]
mod json;
mod kind;
mod listing;
mod mixed;
mod nearby;
#[cfg(feature = "npz")]
mod npy;
#[cfg(feature = "npz")]
mod npz;
mod range;
mod report;
mod residual;
mod right_hand_sides;
#[cfg(any(feature = "json", feature = "npz"))]
mod shape;
mod stream;
#[cfg(feature = "npz")]
mod tables;
mod values;

pub use answer::solve;
pub use block_equation::BlockEquation;
#[cfg(feature = "json")]
pub use exact_file::exact_json;
#[cfg(any(feature = "json", feature = "npz"))]
pub use fault::{RawFault, RawFaults};
pub use kind::RawKind;
pub use report::{
    BeyondRange, ContinuumPart, GapShare, NamedRange, RawConclusion, RawContinuum, RawGroup, RawLine,
    RawReport, RawShares, RawSolution, RawUnknown, SCHEMA, Unknowns, WithinRounding, WithinRoundingAnswer,
};
pub use right_hand_sides::{EveryAnswer, EveryRightHandSide};
#[cfg(any(feature = "json", feature = "npz"))]
pub use shape::Shape;
pub use stream::solve_streaming;
#[cfg(feature = "npz")]
pub use tables::to_npz;

use nalgebra::{DMatrix, DVector};

use crate::problem::{ModeProblem, ModeProblemError};

/// The maximum number of bytes of a problem.
#[cfg(any(feature = "json", feature = "npz"))]
pub const SIZE_LIMIT: u64 = 64 << 20;
/// The maximum number of unknowns of a problem.
#[cfg(any(feature = "json", feature = "npz"))]
pub const GREATEST_SIZE: usize = 2000;

/// A problem as given. Matrices are n x n, vectors have n entries.
#[derive(Debug, Clone, PartialEq)]
pub enum RawProblem {
    /// `w = M z + q`, `w >= 0`, `z >= 0`, `w_k z_k = 0`.
    LinearComplementarity {
        /// The matrix.
        m: DMatrix<f64>,
        /// The constant part.
        q: DVector<f64>,
    },
    /// `A x + B |x| = b`, `|x|` entry by entry.
    AbsoluteValue {
        /// The matrix of `x`.
        a: DMatrix<f64>,
        /// The matrix of `|x|`.
        b: DMatrix<f64>,
        /// The right-hand side `b`.
        right_hand_side: DVector<f64>,
    },
    /// `A x + B |x| = b`, `|x|` block by block.
    BlockAbsoluteValue(Box<BlockEquation>),
    /// `A w - B z = q`, `w >= 0`, `z >= 0`, `w_k z_k = 0`.
    HorizontalComplementarity {
        /// The matrix of `w`.
        a: DMatrix<f64>,
        /// The matrix of `z`.
        b: DMatrix<f64>,
        /// The right-hand side.
        q: DVector<f64>,
    },
    /// `w = M z + q` with free `z_k` for which `w_k = 0`, and others with `w_k >= 0`, `z_k >= 0`,
    /// `w_k z_k = 0`: `M = [[A, C], [D, B]]`, `q = (a, b)`, `z = (u, z)`.
    MixedLinearComplementarity {
        /// The matrix.
        m: DMatrix<f64>,
        /// The constant part.
        q: DVector<f64>,
        /// The number of free unknowns, which come first.
        free: usize,
    },
    /// `w = M z + q`, `l <= z <= u`, `w_k >= 0` where `z_k < u_k`, `w_k <= 0` where `z_k > l_k`.
    MixedComplementarity {
        /// The matrix.
        m: DMatrix<f64>,
        /// The constant part.
        q: DVector<f64>,
        /// The lower bounds; minus infinity for none.
        lower: DVector<f64>,
        /// The upper bounds, not below the lower ones; infinity for none.
        upper: DVector<f64>,
    },
    /// Nash equilibria in mixed strategies: `x` maximises `x^T A y`, and `y` maximises `x^T B y`.
    Game {
        /// The payoffs of the first player, who chooses rows.
        a: DMatrix<f64>,
        /// The payoffs of the second player, who chooses columns.
        b: DMatrix<f64>,
    },
    /// The mode problem itself.
    Modes(ModeProblem),
}

impl RawProblem {
    /// The problem in a file: a NumPy archive if it starts like one, otherwise JSON.
    ///
    /// # Errors
    /// Everything that is wrong with it, as far as reading could continue.
    #[cfg(all(feature = "json", feature = "npz"))]
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, RawFaults> {
        if bytes.starts_with(b"PK") { Self::from_npz(bytes) } else { Self::from_json(bytes) }
    }

    /// The problem in a JSON text: an object with `type` and the arrays of that type, where a matrix is a
    /// list of rows, and a number may be a fraction of integers as text, `"2/3"`. `type` may be absent if the names of the arrays determine it.
    ///
    /// # Errors
    /// Everything that is wrong with it, as far as reading could continue.
    ///
    /// ```
    /// use slideway_modes::raw_problem::{RawFault, RawProblem, Shape};
    ///
    /// let faults = RawProblem::from_json(br#"{"type": "lcp", "M": [[1, 2]], "q": [0, 1]}"#).unwrap_err();
    /// assert_eq!(faults.to_string(), "`M` is a 1 x 2 matrix, but must be a 2 x 2 matrix, as `q` has 2 entries");
    /// ```
    #[cfg(feature = "json")]
    pub fn from_json(bytes: &[u8]) -> Result<Self, RawFaults> {
        check_length(bytes)?;
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err(RawFault::Empty.into());
        }
        // Some editors start a file with a byte order mark.
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut faults = Vec::new();
        json::read(bytes, &mut faults)?.assemble(faults)
    }

    /// The problem in a NumPy archive (`.npz`): arrays with the same names as in JSON. Entries may be 32-bit
    /// or 64-bit floating-point numbers or integers, stored by rows or by columns. `type`, a text, may be
    /// absent if the names of the arrays determine it.
    ///
    /// # Errors
    /// Everything that is wrong with it, as far as reading could continue.
    #[cfg(feature = "npz")]
    pub fn from_npz(bytes: &[u8]) -> Result<Self, RawFaults> {
        check_length(bytes)?;
        let mut faults = Vec::new();
        npz::read(bytes, &mut faults)?.assemble(faults)
    }

    /// The problem with these arrays: name, sizes (none for a number), and entries row by row.
    ///
    /// # Errors
    /// Names, shapes and values that do not make a problem of this type.
    ///
    /// ```
    /// use slideway_modes::raw_problem::{RawKind, RawProblem};
    ///
    /// let arrays = [("M", vec![2, 2], vec![1.0, 2.0, 2.0, 1.0]), ("q", vec![3], vec![0.0; 3])];
    /// let faults = RawProblem::from_arrays(RawKind::Lcp, arrays).unwrap_err();
    /// assert_eq!(faults.to_string(), "`M` is a 2 x 2 matrix, but must be a 3 x 3 matrix, as `q` has 3 entries");
    /// ```
    ///
    /// # Panics
    /// If there are not as many entries as the sizes say.
    #[cfg(any(feature = "json", feature = "npz"))]
    pub fn from_arrays<'a>(
        kind: RawKind,
        arrays: impl IntoIterator<Item = (&'a str, Vec<usize>, Vec<f64>)>,
    ) -> Result<Self, RawFaults> {
        let array = |(name, sizes, values): (&str, Vec<usize>, Vec<f64>)| {
            assert_eq!(sizes.iter().product::<usize>(), values.len(), "entries of {name}");
            (name.to_owned(), Some(shape::Array { sizes, values }))
        };
        let kind = assemble::GivenType::Text(kind.word().to_owned());
        let mut given = assemble::Given::default();
        given.kind = kind;
        arrays.into_iter().map(array).for_each(|(name, array)| given.add(name, array));
        given.assemble(Vec::new())
    }

    /// Its type.
    pub fn kind(&self) -> RawKind {
        match self {
            Self::LinearComplementarity { .. } => RawKind::Lcp,
            Self::AbsoluteValue { .. } => RawKind::Ave,
            Self::BlockAbsoluteValue(_) => RawKind::BlockAve,
            Self::HorizontalComplementarity { .. } => RawKind::Hlcp,
            Self::MixedLinearComplementarity { .. } => RawKind::Mlcp,
            Self::MixedComplementarity { .. } => RawKind::Mcp,
            Self::Game { .. } => RawKind::Game,
            Self::Modes(_) => RawKind::Modes,
        }
    }

    /// The mode problem with the same solutions. Its signed `N` is `z - w`, or `x`; with bounds, and of a
    /// game, it has further unknowns.
    ///
    /// # Errors
    /// If shapes do not match, an entry is not finite, or `A + B` overflows; [`ModeProblemError::Blocks`] for an
    /// equation of blocks, which has a [`BlockProblem`](crate::blocks::BlockProblem) instead.
    pub fn mode_problem(&self) -> Result<ModeProblem, ModeProblemError> {
        match self {
            Self::LinearComplementarity { m, q } => ModeProblem::from_linear_complementarity(m, q.clone()),
            Self::AbsoluteValue { a, b, right_hand_side } => {
                ModeProblem::from_absolute_value_equation(a, b, right_hand_side.clone())
            }
            Self::BlockAbsoluteValue(_) => Err(ModeProblemError::Blocks),
            Self::HorizontalComplementarity { a, b, q } => {
                ModeProblem::from_horizontal_complementarity(a, b, q.clone())
            }
            Self::MixedLinearComplementarity { m, q, free } => {
                mixed::Bounds::of_free(*free, q.len()).mode_problem(m, q)
            }
            Self::MixedComplementarity { m, q, lower, upper } => {
                mixed::Bounds::new(lower, upper).mode_problem(m, q)
            }
            Self::Game { a, b } => game::mode_problem(a, b),
            Self::Modes(problem) => Ok(problem.clone()),
        }
    }

    /// The problem whose determinants say whether every right-hand side has exactly one solution; `None` for a
    /// game, which has no right-hand side.
    fn problem_of_every_right_hand_side(&self) -> Option<Result<ModeProblem, ModeProblemError>> {
        match self {
            Self::MixedComplementarity { m, q, lower, upper } => {
                Some(mixed::Bounds::new(lower, upper).at_zero().mode_problem(m, q))
            }
            Self::Game { .. } => None,
            _ => Some(self.mode_problem()),
        }
    }

    /// Whether `A + B` and `B - A`, the columns of an absolute value equation, are finite, and whether there
    /// are not too many bounds.
    #[cfg(any(feature = "json", feature = "npz"))]
    fn check_range(&self) -> Result<(), RawFault> {
        let (a, b) = match self {
            Self::AbsoluteValue { a, b, .. } => (a, b),
            Self::MixedComplementarity { m, q, lower, upper } => {
                let found = mixed::Bounds::new(lower, upper).unknowns(m, q);
                let limit = GREATEST_SIZE;
                return if found > limit { Err(RawFault::TooManyUnknowns { found, limit }) } else { Ok(()) };
            }
            _ => return Ok(()),
        };
        let overflows = |at: &usize| !(a[*at] + b[*at]).is_finite() || !(b[*at] - a[*at]).is_finite();
        match (0..a.len()).find(overflows) {
            Some(at) => Err(RawFault::Overflow { row: at % a.nrows(), column: at / a.nrows() }),
            None => Ok(()),
        }
    }
}

#[cfg(any(feature = "json", feature = "npz"))]
fn check_length(bytes: &[u8]) -> Result<(), RawFault> {
    if bytes.is_empty() {
        return Err(RawFault::Empty);
    }
    if bytes.len() as u64 > SIZE_LIMIT {
        return Err(RawFault::TooLarge { limit: SIZE_LIMIT });
    }
    Ok(())
}
