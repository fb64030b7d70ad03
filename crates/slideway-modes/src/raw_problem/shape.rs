//! Arrays of numbers before they become matrices and vectors.

use std::fmt;

/// The shape of an array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Shape {
    /// A single number.
    Number,
    /// A vector with this number of entries.
    Vector(usize),
    /// A matrix with this number of rows and columns.
    Matrix(usize, usize),
    /// An array with this number of dimensions, three or more.
    Deeper(usize),
}

impl Shape {
    pub(super) fn of(sizes: &[usize]) -> Self {
        match sizes {
            [] => Self::Number,
            [length] => Self::Vector(*length),
            [rows, columns] => Self::Matrix(*rows, *columns),
            deeper => Self::Deeper(deeper.len()),
        }
    }

    /// The number of entries of a vector or matrix.
    pub(super) fn entries(&self) -> usize {
        match self {
            Self::Number | Self::Deeper(_) => 1,
            Self::Vector(length) => *length,
            Self::Matrix(rows, columns) => rows * columns,
        }
    }
}

impl fmt::Display for Shape {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number => formatter.write_str("a single number"),
            Self::Vector(length) => write!(formatter, "a vector of length {length}"),
            Self::Matrix(rows, columns) => write!(formatter, "a {rows} x {columns} matrix"),
            Self::Deeper(dimensions) => write!(formatter, "an array of {dimensions} dimensions"),
        }
    }
}

/// Numbers row by row, with their arrangement.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Array {
    pub(super) sizes: Vec<usize>,
    pub(super) values: Vec<f64>,
}

impl Array {
    pub(super) fn shape(&self) -> Shape {
        Shape::of(&self.sizes)
    }
}
