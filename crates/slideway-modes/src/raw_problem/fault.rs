//! Faults of a raw problem: every kind, with its values.

use std::fmt;

use super::kind::RawKind;
use super::shape::Shape;
use crate::printable;
use crate::problem::ModeProblemError;

/// Everything that is wrong with a raw problem; never empty when returned as an error.
#[derive(Debug, Clone, PartialEq)]
pub struct RawFaults {
    list: Vec<RawFault>,
}

impl RawFaults {
    /// `None` if there is no fault.
    pub(super) fn some(list: Vec<RawFault>) -> Option<Self> {
        (!list.is_empty()).then_some(Self { list })
    }

    /// The faults, in the order in which they were found.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &RawFault> {
        self.list.iter()
    }
}

impl From<RawFault> for RawFaults {
    fn from(fault: RawFault) -> Self {
        Self { list: vec![fault] }
    }
}

impl fmt::Display for RawFaults {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, fault) in self.list.iter().enumerate() {
            let line = fault.to_string();
            write!(formatter, "{}{}", if at == 0 { "" } else { "\n" }, printable::line(&line))?;
        }
        Ok(())
    }
}

impl std::error::Error for RawFaults {}

/// One thing that is wrong. Rows and columns are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RawFault {
    /// The input is empty.
    #[error("the problem is empty")]
    Empty,
    /// More bytes than permitted for a problem.
    #[error("the problem is larger than {} MiB", limit >> 20)]
    TooLarge {
        /// The maximum number of bytes.
        limit: u64,
    },
    /// More unknowns than permitted for a problem, with those that its bounds require.
    #[error("the problem has {found} unknowns; at most {limit} are accepted")]
    TooManyUnknowns {
        /// Their number.
        found: usize,
        /// The maximum number.
        limit: usize,
    },
    /// The text is not JSON.
    #[error("line {line}, column {column}: {message}")]
    Json {
        /// Line of the fault, from 1.
        line: usize,
        /// Column of the fault, from 1.
        column: usize,
        /// The fault in words.
        message: String,
    },
    /// A number that JSON cannot represent.
    #[error("line {line}: `{word}` is not a valid number")]
    NotFiniteWord {
        /// Line of the word, from 1.
        line: usize,
        /// `NaN`, `Infinity` or the like.
        word: &'static str,
    },
    /// The text is JSON, but not an object.
    #[error("the problem is {found}, not an object with the matrices under their names")]
    NotAnObject {
        /// The kind of value that it is instead, in words.
        found: &'static str,
    },
    /// A name is given twice.
    #[error("`{key}` is given twice")]
    DuplicateKey {
        /// The name.
        key: String,
    },
    /// A name that a problem of this type does not have.
    #[error("unknown name `{key}` in a problem of type {kind}")]
    UnknownKey {
        /// The name.
        key: String,
        /// The type of the problem.
        kind: RawKind,
        /// The most similar known name, if one is similar and not already given.
        nearest: Option<String>,
    },
    /// A name that a problem of this type must have.
    #[error("`{key}` is missing: a problem of type {kind} has {}", listed(kind.required()))]
    MissingKey {
        /// The name.
        key: &'static str,
        /// The type of the problem.
        kind: RawKind,
    },
    /// No type is given, and the names do not match exactly one type.
    #[error("the type of the problem is missing, and cannot be inferred from the names {}", listed(present))]
    MissingType {
        /// The names that are given.
        present: Vec<String>,
    },
    /// An unknown type.
    #[error("unknown type `{found}` of problem")]
    UnknownType {
        /// The given type.
        found: String,
        /// The most similar known type, if one is similar.
        nearest: Option<String>,
    },
    /// The type is not a text.
    #[error("`type` is {found}, not a text")]
    TypeNotText {
        /// The kind of value that it is instead, in words.
        found: String,
    },
    /// Something other than an array of numbers.
    #[error("`{key}` is {found}, not an array of numbers")]
    NotAnArray {
        /// The name.
        key: String,
        /// The kind of value that it is instead, in words.
        found: String,
    },
    /// An entry that is not a number.
    #[error("`{key}`: {} is {found}, not a number", place(*row, *column))]
    NotANumber {
        /// The name.
        key: String,
        /// Row of the entry, or its index in a vector.
        row: usize,
        /// Column of the entry; `None` in a vector.
        column: Option<usize>,
        /// The kind of value that it is instead, in words.
        found: &'static str,
    },
    /// Rows of different lengths.
    #[error("`{key}`: row {row} has {}, row 0 has {expected} (counted from 0)", entries(*found))]
    Ragged {
        /// The name.
        key: String,
        /// The first row that differs.
        row: usize,
        /// Number of entries in row 0.
        expected: usize,
        /// Number of entries in the row.
        found: usize,
    },
    /// A matrix or vector of the wrong shape.
    #[error("`{key}` is {found}, but must be {expected}{}", because(references))]
    Shape {
        /// The name.
        key: String,
        /// The required shape.
        expected: Shape,
        /// The shape found.
        found: Shape,
        /// The vectors that determine the shape, and the numbers of their entries.
        references: Vec<(&'static str, usize)>,
    },
    /// An entry that is infinite or NaN.
    #[error("`{key}`: {} is {value}", place(*row, *column))]
    NotFinite {
        /// The name.
        key: String,
        /// Row of the entry, or its index in a vector.
        row: usize,
        /// Column of the entry; `None` in a vector.
        column: Option<usize>,
        /// The entry.
        value: f64,
    },
    /// A lower bound above the upper one.
    #[error(
        "`l` and `u`: entry {at} (counted from 0): the lower bound {lower} is above the upper bound {upper}"
    )]
    BoundsCross {
        /// Index of the unknown.
        at: usize,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// A block of neither one nor two components.
    #[error("`blocks`: entry {row} (counted from 0) is {value}; a block has 1 or 2 components")]
    BlockSize {
        /// Index of the block.
        row: usize,
        /// Its given size.
        value: f64,
    },
    /// An equation of blocks that is none.
    #[error("{0}")]
    Blocks(ModeProblemError),
    /// `A + B` or `B - A` is beyond the range of floating-point numbers.
    #[error("`A` and `B`: row {row}, column {column} of their sum or difference overflows")]
    Overflow {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
    },
    /// The file is not an archive of arrays.
    #[error("the .npz archive cannot be read: {reason}")]
    Archive {
        /// The reader's message.
        reason: String,
    },
    /// A file in the archive is not an array.
    #[error("`{key}` in the .npz archive is not a NumPy array: {reason}")]
    Npy {
        /// The name.
        key: String,
        /// The fault of the file, in words.
        reason: &'static str,
    },
    /// An array with entries other than real numbers.
    #[error("`{key}` holds entries of the NumPy type '{found}', not real numbers")]
    EntryType {
        /// The name.
        key: String,
        /// The type in NumPy's notation.
        found: String,
    },
}

impl RawFault {
    /// Returns what to do about it, if there is more to say than the message itself.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Empty | Self::NotAnObject { .. } => {
                Some(r#"for instance {"type": "lcp", "M": [[2, 1], [1, 2]], "q": [-1, 1]}"#.to_owned())
            }
            Self::Json { line: 1, column: 0..=2, .. } => {
                Some("a problem given by matrices is JSON; a model of a mechanism, in TOML, is another kind of file".to_owned())
            }
            Self::UnknownKey { nearest: Some(nearest), .. }
            | Self::UnknownType { nearest: Some(nearest), .. } => Some(format!("did you mean `{nearest}`?")),
            Self::UnknownKey { kind, .. } => Some(format!("known here: {}", listed(&kind.names()))),
            Self::UnknownType { .. } | Self::MissingType { .. } | Self::TypeNotText { .. } => {
                let kinds = RawKind::ALL.map(|kind| format!("{kind} ({})", kind.required().join(", ")));
                Some(format!("the types and their arrays: {}", kinds.join("; ")))
            }
            Self::NotFiniteWord { .. } => Some(
                "every entry must be a finite number; in `l` and `u` of type mcp, null means no bound"
                    .to_owned(),
            ),
            Self::NotANumber { found: "a text", .. } => Some(
                r#"write numbers without quotation marks, or as a fraction of two integers, such as "-2/3""#
                    .to_owned(),
            ),
            Self::NotFinite { key, value, .. }
                if value.is_infinite() && matches!(key.as_str(), "l" | "u") =>
            {
                Some("no number lies within this bound".to_owned())
            }
            Self::Blocks(ModeProblemError::BlockSizes { .. }) => Some(
                "`blocks` lists how many components of `b` belong to each block, such as [1, 2]".to_owned(),
            ),
            Self::Shape { expected: Shape::Matrix(..), .. } => {
                Some("a matrix is a list of rows, each a list of numbers".to_owned())
            }
            Self::EntryType { .. } => {
                Some("save it as float64, for instance with A.astype(float)".to_owned())
            }
            Self::Archive { .. } => {
                Some("numpy.savez and numpy.savez_compressed write such files".to_owned())
            }
            _ => None,
        }
    }
}

fn place(row: usize, column: Option<usize>) -> String {
    match column {
        Some(column) => format!("the entry in row {row}, column {column} (counted from 0)"),
        None => format!("entry {row} (counted from 0)"),
    }
}

fn because(references: &[(&'static str, usize)]) -> String {
    let told: Vec<String> =
        references.iter().map(|(key, size)| format!("`{key}` has {}", entries(*size))).collect();
    if told.is_empty() { String::new() } else { format!(", as {}", told.join(" and ")) }
}

fn entries(count: usize) -> String {
    if count == 1 { "1 entry".to_owned() } else { format!("{count} entries") }
}

/// So many names are listed; of more only their number.
const MOST_LISTED: usize = 20;

/// "`A`, `B` and `b`"
fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let (shown, left) = names.split_at(names.len().min(MOST_LISTED));
    let mut listed: Vec<String> = shown.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    if !left.is_empty() {
        listed.push(format!("{} more", left.len()));
    }
    match listed.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        listed => listed.concat(),
    }
}
