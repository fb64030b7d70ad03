//! From named arrays to a problem: its type, the names that belong to it, shapes and values.

use nalgebra::{DMatrix, DVector};

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
    pub(super) arrays: Vec<(String, Option<Array>)>,
}

/// What a file states about its type.
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
        typed || self.arrays.iter().any(|(name, _)| name == key)
    }

    /// Records the name of an array that cannot be read.
    pub(super) fn set_faulty(&mut self, key: String, fault: RawFault, faults: &mut Vec<RawFault>) {
        faults.push(fault);
        self.arrays.push((key, None));
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
                    kind.required().iter().all(|name| self.has(name))
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
        let [matrices @ .., vector] = kind.required() else { unreachable!("every type has arrays") };
        let size = self.size(vector)?;
        let optional = kind.optional().iter().filter(|name| self.has(name));
        for name in matrices.iter().chain(optional) {
            self.check_matrix(name, (*vector, size), &mut faults);
        }
        match RawFaults::some(faults) {
            Some(faults) => Err(faults),
            None => self.problem(kind, size),
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

    /// The number of unknowns, determined by the vector.
    fn size(&self, key: &'static str) -> Result<usize, RawFault> {
        let found = self.array(key).map_or(Shape::Vector(0), Array::shape);
        let (Shape::Vector(size) | Shape::Matrix(size, 1)) = found else {
            let expected = match found {
                Shape::Matrix(1, size) | Shape::Matrix(size, _) => Shape::Vector(size),
                _ => Shape::Vector(1),
            };
            return Err(RawFault::Shape { key: key.to_owned(), expected, found, reference: None });
        };
        match size {
            0 => Err(RawFault::Empty),
            size if size > GREATEST_SIZE => {
                Err(RawFault::TooManyUnknowns { key: key.to_owned(), found: size, limit: GREATEST_SIZE })
            }
            size => {
                let mut faults = Vec::new();
                self.check_finite(key, &mut faults);
                faults.pop().map_or(Ok(size), Err)
            }
        }
    }

    fn check_matrix(&self, key: &str, reference: (&'static str, usize), faults: &mut Vec<RawFault>) {
        let Some(array) = self.array(key) else { return };
        let (found, expected) = (array.shape(), Shape::Matrix(reference.1, reference.1));
        if found == expected {
            self.check_finite(key, faults);
        } else {
            faults.push(RawFault::Shape { key: key.to_owned(), expected, found, reference: Some(reference) });
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
    fn problem(&self, kind: RawKind, size: usize) -> Result<RawProblem, RawFaults> {
        let matrix = |key: &str| match self.array(key) {
            Some(array) => DMatrix::from_row_slice(size, size, &array.values),
            None => DMatrix::zeros(size, size),
        };
        let vector =
            |key: &str| DVector::from_vec(self.array(key).map_or(Vec::new(), |array| array.values.clone()));
        let problem = match kind {
            RawKind::Lcp => RawProblem::LinearComplementarity { m: matrix("M"), q: vector("q") },
            RawKind::Ave => {
                RawProblem::AbsoluteValue { a: matrix("A"), b: matrix("B"), right_hand_side: vector("b") }
            }
            RawKind::Hlcp => {
                RawProblem::HorizontalComplementarity { a: matrix("A"), b: matrix("B"), q: vector("q") }
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
