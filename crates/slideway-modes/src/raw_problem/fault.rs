//! What can be wrong with a raw problem: every kind of fault with its values.

use std::fmt;

use super::kind::RawKind;
use super::shape::Shape;
use crate::printable;

/// Everything that is wrong with a raw problem; never empty where it is returned as an error.
#[derive(Debug, Clone, PartialEq)]
pub struct RawFaults {
    list: Vec<RawFault>,
}

impl RawFaults {
    /// None if there is no fault.
    pub(super) fn some(list: Vec<RawFault>) -> Option<Self> {
        (!list.is_empty()).then_some(Self { list })
    }

    /// The faults, in the order in which they were met.
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
    /// There is nothing at all.
    #[error("the problem is empty")]
    Empty,
    /// More bytes than a problem may have.
    #[error("the problem is larger than {} MiB", limit >> 20)]
    TooLarge {
        /// The most bytes.
        limit: u64,
    },
    /// More unknowns than a problem may have.
    #[error("`{key}` has {found} entries; a problem may have up to {limit} unknowns")]
    TooManyUnknowns {
        /// The vector that tells the size of the problem.
        key: String,
        /// Its entries.
        found: usize,
        /// The most.
        limit: usize,
    },
    /// The text is no JSON.
    #[error("line {line}, column {column}: {message}")]
    Json {
        /// Line of the fault, from 1.
        line: usize,
        /// Column of the fault, from 1.
        column: usize,
        /// What is wrong there.
        message: String,
    },
    /// A number that JSON cannot write.
    #[error("line {line}: `{word}` is not a valid number")]
    NotFiniteWord {
        /// Line of the word, from 1.
        line: usize,
        /// `NaN`, `Infinity` or the like.
        word: &'static str,
    },
    /// The text is JSON, but no object.
    #[error("the problem is {found}, not an object with the matrices under their names")]
    NotAnObject {
        /// What it is.
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
        /// The known name that it is most like, if it is like one and that one is not given.
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
    /// No type is given, and the names are not those of one type.
    #[error("the type of the problem is missing, and cannot be inferred from the names {}", listed(present))]
    MissingType {
        /// The names that are given.
        present: Vec<String>,
    },
    /// A type that is none.
    #[error("unknown type `{found}` of problem")]
    UnknownType {
        /// What was given.
        found: String,
        /// The known type that it is most like, if it is like one.
        nearest: Option<String>,
    },
    /// The type is no text.
    #[error("`type` is {found}, not a text")]
    TypeNotText {
        /// What it is.
        found: String,
    },
    /// What should be an array of numbers is something else.
    #[error("`{key}` is {found}, not an array of numbers")]
    NotAnArray {
        /// The name.
        key: String,
        /// What it is.
        found: String,
    },
    /// An entry that is no number.
    #[error("`{key}`: {} is {found}, not a number", place(*row, *column))]
    NotANumber {
        /// The name.
        key: String,
        /// Row of the entry, or its place in a vector.
        row: usize,
        /// Column of the entry; none in a vector.
        column: Option<usize>,
        /// What it is.
        found: &'static str,
    },
    /// Rows of different lengths.
    #[error("`{key}`: row {row} has {}, row 0 has {expected} (counted from 0)", entries(*found))]
    Ragged {
        /// The name.
        key: String,
        /// The first row that differs.
        row: usize,
        /// Entries of row 0.
        expected: usize,
        /// Entries of the row.
        found: usize,
    },
    /// A matrix or vector of the wrong shape.
    #[error("`{key}` is {found}, but must be {expected}{}", because(reference.as_ref()))]
    Shape {
        /// The name.
        key: String,
        /// What it must be.
        expected: Shape,
        /// What it is.
        found: Shape,
        /// The vector that tells the size of the problem, and its entries.
        reference: Option<(&'static str, usize)>,
    },
    /// An entry that is infinite or not a number.
    #[error("`{key}`: {} is {value}", place(*row, *column))]
    NotFinite {
        /// The name.
        key: String,
        /// Row of the entry, or its place in a vector.
        row: usize,
        /// Column of the entry; none in a vector.
        column: Option<usize>,
        /// The entry.
        value: f64,
    },
    /// `A + B` or `B - A` is beyond the range of floating-point numbers.
    #[error("`A` and `B`: row {row}, column {column} of their sum or difference overflows")]
    Overflow {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
    },
    /// The file is no archive of arrays.
    #[error("the .npz archive cannot be read: {reason}")]
    Archive {
        /// What its reader says.
        reason: String,
    },
    /// A file in the archive is no array.
    #[error("`{key}` in the .npz archive is not a NumPy array: {reason}")]
    Npy {
        /// The name.
        key: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// An array of something else than real numbers.
    #[error("`{key}` holds entries of the NumPy type '{found}', not real numbers")]
    EntryType {
        /// The name.
        key: String,
        /// The type as NumPy writes it.
        found: String,
    },
}

impl RawFault {
    /// What to do about it, where there is something better to say than the message itself.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Empty | Self::NotAnObject { .. } => {
                Some(r#"for instance {"type": "lcp", "M": [[2, 1], [1, 2]], "q": [-1, 1]}"#.to_owned())
            }
            Self::UnknownKey { nearest: Some(nearest), .. }
            | Self::UnknownType { nearest: Some(nearest), .. } => Some(format!("did you mean `{nearest}`?")),
            Self::UnknownKey { kind, .. } => Some(format!("known here: {}", listed(&kind.names()))),
            Self::UnknownType { .. } | Self::MissingType { .. } | Self::TypeNotText { .. } => {
                let kinds = RawKind::ALL.map(|kind| format!("{kind} ({})", kind.required().join(", ")));
                Some(format!("the types and their arrays: {}", kinds.join("; ")))
            }
            Self::NotFiniteWord { .. } => Some("every entry must be a finite number".to_owned()),
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

fn because(reference: Option<&(&'static str, usize)>) -> String {
    reference.map_or(String::new(), |(key, size)| format!(", as `{key}` has {}", entries(*size)))
}

fn entries(count: usize) -> String {
    if count == 1 { "1 entry".to_owned() } else { format!("{count} entries") }
}

/// "`A`, `B` and `b`"
fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    match quoted.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        names => names.concat(),
    }
}
