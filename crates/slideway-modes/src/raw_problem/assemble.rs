//! From named arrays to a problem: its type, the names that belong to it, shapes and values.

use std::collections::HashSet;

use nalgebra::{DMatrix, DVector};

use super::block_equation::BlockEquation;
use super::fault::{RawFault, RawFaults};
use super::kind::RawKind;
use super::shape::{Array, Shape};
use super::{GREATEST_SIZE, RawProblem};
use crate::names::nearest;
use crate::problem::ModeProblem;

/// The contents of a file.
#[derive(Default)]
pub(super) struct Given {
    pub(super) kind: GivenType,
    /// Names and arrays; `None` for a faulty one whose fault has been recorded.
    arrays: Vec<(String, Option<Array>)>,
    /// All names, of which a file may have very many.
    names: HashSet<String>,
}

/// The type of a problem as a file states it.
#[derive(Default)]
pub(super) enum GivenType {
    #[default]
    Nothing,
    Text(String),
    /// Something other than a text, in words.
    Other(String),
}

impl Given {
    /// Whether the name is already used.
    pub(super) fn has(&self, key: &str) -> bool {
        let typed = key == "type" && !matches!(self.kind, GivenType::Nothing);
        typed || self.names.contains(key)
    }

    /// Adds an array; `None` for one that is faulty, or has a name that belongs to no problem.
    pub(super) fn add(&mut self, key: String, array: Option<Array>) {
        self.names.insert(key.clone());
        self.arrays.push((key, array));
    }

    /// Records the name of an array that cannot be read.
    pub(super) fn set_faulty(&mut self, key: String, fault: RawFault, faults: &mut Vec<RawFault>) {
        if !faults.contains(&fault) {
            faults.push(fault);
        }
        self.add(key, None);
    }

    fn array(&self, key: &str) -> Option<&Array> {
        self.arrays.iter().find(|(name, _)| name == key)?.1.as_ref()
    }

    /// The given type, otherwise the only one with these names.
    fn kind(&self) -> Result<RawKind, RawFault> {
        match &self.kind {
            GivenType::Other(found) => Err(RawFault::TypeNotText { found: found.clone() }),
            GivenType::Text(text) => {
                let known = RawKind::ALL.into_iter().find(|kind| kind.word() == text.as_str());
                known.ok_or_else(|| RawFault::UnknownType {
                    nearest: nearest(text, RawKind::ALL.map(RawKind::word)),
                    found: text.clone(),
                })
            }
            GivenType::Nothing => {
                let fits = |kind: &RawKind| {
                    kind.is_told_by_names()
                        && kind.required().iter().all(|name| self.has(name))
                        && self.arrays.iter().all(|(name, _)| kind.names().contains(&name.as_str()))
                };
                let present = || self.arrays.iter().map(|(name, _)| name.clone()).collect();
                RawKind::ALL
                    .into_iter()
                    .find(fits)
                    .ok_or_else(|| RawFault::MissingType { present: present() })
            }
        }
    }

    /// The problem.
    ///
    /// # Errors
    /// `faults`, together with all those found here.
    pub(super) fn assemble(self, mut faults: Vec<RawFault>) -> Result<RawProblem, RawFaults> {
        if self.arrays.is_empty() && matches!(self.kind, GivenType::Nothing) {
            faults.push(RawFault::Empty);
        }
        if let Some(faults) = RawFaults::some(std::mem::take(&mut faults)) {
            return Err(faults);
        }
        let kind = self.kind()?;
        self.check_names(kind, &mut faults);
        if let Some(faults) = RawFaults::some(std::mem::take(&mut faults)) {
            return Err(faults);
        }
        let sizes = self.sizes(kind)?;
        let is_sized_by = |name: &&str| kind.size_vectors().contains(name);
        for name in kind.names().into_iter().filter(|name| self.has(name) && !is_sized_by(name)) {
            self.check_shape(kind, name, &sizes, &mut faults);
        }
        match RawFaults::some(faults) {
            Some(faults) => Err(faults),
            None => self.problem(kind, &sizes),
        }
    }

    fn check_names(&self, kind: RawKind, faults: &mut Vec<RawFault>) {
        let known = kind.names();
        for (key, _) in &self.arrays {
            if !known.contains(&key.as_str()) {
                let absent = known.iter().copied().filter(|name| !self.has(name));
                let nearest = nearest(key, absent).or_else(|| {
                    let same = |name: &&&str| name.eq_ignore_ascii_case(key) && !self.has(name);
                    known.iter().find(same).map(|&name| name.to_owned())
                });
                faults.push(RawFault::UnknownKey { key: key.clone(), kind, nearest });
            }
        }
        let some_optional = kind.optional().iter().any(|name| self.has(name));
        let optional = kind.optional().iter().filter(|_| some_optional);
        let missing = kind.required().iter().chain(optional).filter(|name| !self.has(name));
        faults.extend(missing.map(|key| RawFault::MissingKey { key, kind }));
    }

    /// The sizes of the problem.
    fn sizes(&self, kind: RawKind) -> Result<Vec<usize>, RawFaults> {
        let vectors = kind.size_vectors();
        let sizes = if vectors.is_empty() {
            self.sizes_of_matrix("A")?
        } else {
            vectors.iter().map(|vector| self.length(vector)).collect::<Result<Vec<_>, _>>()?
        };
        match sizes.iter().sum() {
            0 => Err(RawFault::Empty.into()),
            found if found > GREATEST_SIZE => {
                Err(RawFault::TooManyUnknowns { found, limit: GREATEST_SIZE }.into())
            }
            _ => {
                let mut faults = Vec::new();
                vectors.iter().for_each(|vector| self.check_finite(vector, &mut faults));
                RawFaults::some(faults).map_or(Ok(sizes), Err)
            }
        }
    }

    /// The number of entries of a vector.
    fn length(&self, key: &'static str) -> Result<usize, RawFault> {
        let found = self.array(key).map_or(Shape::Vector(0), Array::shape);
        match found {
            Shape::Vector(size) | Shape::Matrix(size, 1) => Ok(size),
            Shape::Matrix(1, size) | Shape::Matrix(size, _) => Err(Shape::Vector(size)),
            _ => Err(Shape::Vector(1)),
        }
        .map_err(|expected| RawFault::Shape {
            key: key.to_owned(),
            expected,
            found,
            references: Vec::new(),
        })
    }

    /// The rows and columns of a matrix that has both.
    fn sizes_of_matrix(&self, key: &'static str) -> Result<Vec<usize>, RawFault> {
        let found = self.array(key).map_or(Shape::Vector(0), Array::shape);
        let expected = match found {
            Shape::Matrix(rows, columns) if rows * columns > 0 => return Ok(vec![rows, columns]),
            Shape::Vector(columns @ 1..) => Shape::Matrix(1, columns),
            Shape::Number => Shape::Matrix(1, 1),
            _ => return Err(RawFault::Empty),
        };
        Err(RawFault::Shape { key: key.to_owned(), expected, found, references: Vec::new() })
    }

    fn check_shape(&self, kind: RawKind, key: &str, sizes: &[usize], faults: &mut Vec<RawFault>) {
        let Some(array) = self.array(key) else { return };
        let (rows, columns) = kind.dimensions(key);
        let expected = match columns {
            Some(columns) => Shape::Matrix(sizes[rows], sizes[columns]),
            None => Shape::Vector(sizes[rows]),
        };
        let found = array.shape();
        let is_column = columns.is_none() && found == Shape::Matrix(sizes[rows], 1);
        // No list of rows tells how long rows are of which there are none.
        let is_nothing = array.values.is_empty() && expected.entries() == 0;
        if found == expected || is_column || is_nothing {
            return if kind.is_bound(key) {
                self.check_bounds(key, faults);
            } else {
                self.check_finite(key, faults);
            };
        }
        let named = kind.size_vectors().iter().zip(sizes).enumerate();
        let references = named
            .filter(|(at, _)| *at == rows || Some(*at) == columns)
            .map(|(_, (name, size))| (*name, *size))
            .collect();
        faults.push(RawFault::Shape { key: key.to_owned(), expected, found, references });
    }

    /// Records the first bound that is no number, or that no number satisfies.
    fn check_bounds(&self, key: &str, faults: &mut Vec<RawFault>) {
        let impossible = if key == "l" { f64::INFINITY } else { f64::NEG_INFINITY };
        let Some(array) = self.array(key) else { return };
        let mut entries = array.values.iter().enumerate();
        if let Some((row, &value)) = entries.find(|(_, value)| value.is_nan() || **value == impossible) {
            faults.push(RawFault::NotFinite { key: key.to_owned(), row, column: None, value });
        }
    }

    /// Records the first entry that is not finite.
    fn check_finite(&self, key: &str, faults: &mut Vec<RawFault>) {
        let Some(array) = self.array(key) else { return };
        if let Some((at, &value)) = array.values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            let (row, column) = match array.sizes.as_slice() {
                [_, columns] => (at / columns, Some(at % columns)),
                _ => (at, None),
            };
            faults.push(RawFault::NotFinite { key: key.to_owned(), row, column, value });
        }
    }

    /// The problem from checked arrays.
    fn problem(&self, kind: RawKind, sizes: &[usize]) -> Result<RawProblem, RawFaults> {
        let matrix = |key: &str| {
            let (rows, columns) = kind.dimensions(key);
            let (rows, columns) = (sizes[rows], columns.map_or(1, |columns| sizes[columns]));
            match self.array(key) {
                Some(array) => DMatrix::from_row_slice(rows, columns, &array.values),
                None => DMatrix::zeros(rows, columns),
            }
        };
        let vector = |key: &str| matrix(key).column(0).into_owned();
        let problem = match kind {
            RawKind::Lcp => RawProblem::LinearComplementarity { m: matrix("M"), q: vector("q") },
            RawKind::Ave => {
                RawProblem::AbsoluteValue { a: matrix("A"), b: matrix("B"), right_hand_side: vector("b") }
            }
            RawKind::BlockAve => {
                let a = self.has("A").then(|| matrix("A"));
                let equation =
                    BlockEquation::new(a, matrix("B"), vector("b"), &block_sizes(&vector("blocks"))?);
                RawProblem::BlockAbsoluteValue(Box::new(equation.map_err(RawFault::Blocks)?))
            }
            RawKind::Hlcp => {
                RawProblem::HorizontalComplementarity { a: matrix("A"), b: matrix("B"), q: vector("q") }
            }
            RawKind::Mlcp => RawProblem::MixedLinearComplementarity {
                m: blocks([[&matrix("A"), &matrix("C")], [&matrix("D"), &matrix("B")]]),
                q: stacked(&vector("a"), &vector("b")),
                free: sizes[0],
            },
            RawKind::Mcp => {
                let (lower, upper) = (vector("l"), vector("u"));
                check_order(&lower, &upper)?;
                RawProblem::MixedComplementarity { m: matrix("M"), q: vector("q"), lower, upper }
            }
            RawKind::Game => {
                let a = matrix("A");
                // Without the payoffs of the second player the sum of both is zero.
                let b = if self.has("B") { matrix("B") } else { -&a };
                RawProblem::Game { a, b }
            }
            RawKind::Modes => {
                let modes = ModeProblem::new(
                    matrix("columns_positive"),
                    matrix("columns_negative"),
                    matrix("jumps_positive"),
                    matrix("jumps_negative"),
                    vector("right_hand_side"),
                );
                RawProblem::Modes(modes.expect("shapes and values have been checked"))
            }
        };
        problem.check_range()?;
        Ok(problem)
    }
}

/// The sizes of blocks, which are whole numbers.
fn block_sizes(given: &DVector<f64>) -> Result<Vec<usize>, RawFault> {
    let size = |(row, &value): (usize, &f64)| match value {
        1.0 => Ok(1),
        2.0 => Ok(2),
        _ => Err(RawFault::BlockSize { row, value }),
    };
    given.iter().enumerate().map(size).collect()
}

/// `[[A, C], [D, B]]`
fn blocks([[a, c], [d, b]]: [[&DMatrix<f64>; 2]; 2]) -> DMatrix<f64> {
    let (free, size) = (a.nrows(), a.nrows() + b.nrows());
    let mut matrix = DMatrix::zeros(size, size);
    for (block, place) in [(a, (0, 0)), (c, (0, free)), (d, (free, 0)), (b, (free, free))] {
        matrix.view_mut(place, block.shape()).copy_from(block);
    }
    matrix
}

/// `(a, b)`
fn stacked(a: &DVector<f64>, b: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(a.len() + b.len(), a.iter().chain(b).copied())
}

/// Refuses lower bounds above upper ones.
fn check_order(lower: &DVector<f64>, upper: &DVector<f64>) -> Result<(), RawFaults> {
    let crossed = lower.iter().zip(upper).enumerate().filter(|(_, (lower, upper))| lower > upper);
    let fault = |(at, (&lower, &upper)): (usize, _)| RawFault::BoundsCross { at, lower, upper };
    RawFaults::some(crossed.map(fault).collect()).map_or(Ok(()), Err)
}
