//! Polyhedra of solutions: their corners, dimension and support, exactly.
//!
//! # Files
//! `dictionary.rs` finds a point and the unknowns that are positive somewhere, and splits the rest into
//! independent blocks; `double_description.rs` finds the extreme rays of each.

mod dictionary;
mod double_description;

use dashu_int::IBig;
use dashu_ratio::RBig;

use self::dictionary::{Block, Dictionary, Ended, Witness};
use self::double_description::extreme_rays;
use super::elimination::ratio;
use super::polyhedron::{ExactSet, scaled_to_one};

/// The polyhedron `{y >= 0 : sum_j c_j y_j = b}`: the product of its parts, which vary independently.
///
/// ```
/// use slideway_modes::certificate::{Cell, ExactSet};
/// // y_0 + y_1 = 1, y_2 + y_3 = 2, y_4 + y_5 = 0: a rectangle.
/// let column = |row: usize| (0..3).map(|at| i32::from(at == row).into()).collect::<Vec<_>>();
/// let columns: Vec<_> = [0, 0, 1, 1, 2, 2].map(column).into();
/// let cell = Cell::of_columns(&columns, &[1.into(), 2.into(), 0.into()], 100, &mut || true).expect("small");
/// assert_eq!((cell.dimension(), cell.support()), (Some(2), vec![0, 1, 2, 3]));
/// assert!(cell.parts().iter().all(|part| matches!(part.set, ExactSet::Segment { .. })));
/// assert_eq!(cell.set(100).vertices().len(), 4);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    unknowns: usize,
    /// `None` if it is empty.
    parts: Option<Vec<CellPart>>,
    witnesses: Vec<Witness>,
}

/// Some of the unknowns of a [`Cell`], which vary independently of the others. Each is positive somewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct CellPart {
    /// The unknowns, in increasing order; points have one entry for each.
    pub unknowns: Vec<usize>,
    /// The dimension of the part; it is a single point if that is zero.
    pub dimension: usize,
    /// One of its vertices.
    pub vertex: Vec<RBig>,
    /// All its vertices and extreme directions; [`ExactSet::NotComputed`] if there are too many.
    pub set: ExactSet,
}

impl Cell {
    /// The cell of the given columns `c_j` and right-hand side `b`; `None` once `proceed` is `false`, which is
    /// called now and then.
    ///
    /// Corners of a part are not computed if it has more than `most`, or if the method has to hold more than
    /// that in between; dimension, support and a vertex are always known. They follow from linear programs in
    /// integers, the corners from the double description method.
    ///
    /// # Panics
    /// If a column does not have as many entries as `right`.
    pub fn of_columns(
        columns: &[Vec<IBig>],
        right: &[IBig],
        most: usize,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        assert!(columns.iter().all(|column| column.len() == right.len()), "one entry per equation");
        let unknowns = columns.len();
        let mut dictionary = match Dictionary::of_support(columns, right, proceed) {
            Ok(dictionary) => dictionary,
            Err(Ended::Infeasible) => return Some(Self { unknowns, parts: None, witnesses: Vec::new() }),
            Err(Ended::Interrupted) => return None,
        };
        let blocks = dictionary.blocks();
        let mut parts: Vec<CellPart> =
            blocks.iter().map(|block| CellPart::new(&dictionary, block, most, proceed)).collect();
        parts.sort_by(|one, other| one.unknowns.cmp(&other.unknowns));
        let witnesses = dictionary.take_witnesses();
        proceed().then_some(Self { unknowns, parts: Some(parts), witnesses })
    }

    /// Whether it contains no point.
    pub fn is_empty(&self) -> bool {
        self.parts.is_none()
    }

    /// The dimension of its affine hull; `None` if it is empty.
    pub fn dimension(&self) -> Option<usize> {
        self.parts.as_ref().map(|parts| parts.iter().map(|part| part.dimension).sum())
    }

    /// The unknowns that are positive somewhere in it, in increasing order.
    pub fn support(&self) -> Vec<usize> {
        let mut support: Vec<usize> = self.parts().iter().flat_map(|part| part.unknowns.clone()).collect();
        support.sort_unstable();
        support
    }

    /// A point inside it, where every unknown of its support is positive; `None` if it is empty. It is the mean of at
    /// most as many points as there are unknowns.
    pub fn inside(&self) -> Option<Vec<RBig>> {
        (!self.is_empty()).then(|| Witness::mean(&self.witnesses, self.unknowns))
    }

    /// Its parts; all other unknowns are zero. Those that are the same everywhere are parts of dimension 0.
    pub fn parts(&self) -> &[CellPart] {
        self.parts.as_deref().unwrap_or(&[])
    }

    /// All vertices and extreme directions, with one entry per unknown: combinations of those of the parts.
    /// [`ExactSet::NotComputed`] if there are more than `most`, or if those of a part were not computed.
    pub fn set(&self, most: usize) -> ExactSet {
        if self.is_empty() {
            return ExactSet::Empty;
        }
        let zero = vec![RBig::ZERO; self.unknowns];
        let (mut vertices, mut directions) = (vec![zero.clone()], Vec::new());
        for part in self.parts() {
            let (own, own_directions) = (part.set.vertices(), part.set.directions());
            let corners = vertices.len().saturating_mul(own.len());
            if part.set == ExactSet::NotComputed || corners + directions.len() + own_directions.len() > most {
                return ExactSet::NotComputed;
            }
            let combined = vertices.iter().flat_map(|base| own.iter().map(|point| part.placed(base, point)));
            vertices = combined.collect();
            directions.extend(own_directions.into_iter().map(|direction| part.placed(&zero, direction)));
        }
        ExactSet::from_corners(vertices, directions)
    }
}

/// Of equations without a solution `y >= 0`, columns whose products with a vector that proves this are zero and which
/// determine it; `None` if there is a solution, or once `proceed` is `false`.
pub(super) fn contradiction(
    columns: &[Vec<IBig>],
    right: &[IBig],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<usize>> {
    Dictionary::contradiction(columns, right, proceed)
}

/// A basis of the null space of a symmetric matrix without negative eigenvalues, in integers; `None` if it has
/// one, or once `proceed` is `false`.
pub(super) fn null_space_of_semidefinite(
    matrix: &[Vec<IBig>],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<Vec<IBig>>> {
    Some(Dictionary::of_semidefinite(matrix, proceed)?.homogeneous_solutions())
}

impl CellPart {
    fn new(dictionary: &Dictionary, block: &Block, most: usize, proceed: &mut dyn FnMut() -> bool) -> Self {
        let basic = block.rows.iter().map(|&row| dictionary.basic(row));
        let unsorted: Vec<usize> =
            basic.chain(block.columns.iter().map(|&column| dictionary.nonbasic(column))).collect();
        let mut order: Vec<usize> = (0..unsorted.len()).collect();
        order.sort_by_key(|&at| unsorted[at]);
        let set = Homogeneous::of_block(dictionary, block, &order).set(most, proceed);
        let vertex = order.iter().map(|&at| match block.rows.get(at) {
            Some(&row) => ratio(dictionary.value(row).clone(), dictionary.denominator()),
            None => RBig::ZERO,
        });
        Self {
            unknowns: order.iter().map(|&at| unsorted[at]).collect(),
            dimension: block.columns.len(),
            vertex: vertex.collect(),
            set: set.unwrap_or(ExactSet::NotComputed),
        }
    }

    /// The point with the unknowns of this part replaced.
    fn placed(&self, base: &[RBig], own: &[RBig]) -> Vec<RBig> {
        let mut point = base.to_vec();
        self.unknowns.iter().zip(own).for_each(|(&at, value)| point[at].clone_from(value));
        point
    }
}

/// The cone `{(y, s) >= 0 : sum_j c_j y_j = s b}`: its rays with `s > 0` are the vertices `y / s` of a block,
/// those with `s = 0` its directions.
struct Homogeneous {
    /// One vector for each nonbasic unknown, and one for `s`, which is the last coordinate.
    start: Vec<Vec<IBig>>,
    /// The coordinates that only one of them has.
    simplex: Vec<usize>,
}

impl Homogeneous {
    /// `order` gives for each coordinate which of the block's unknowns it is: basic ones first, then nonbasic.
    fn of_block(dictionary: &Dictionary, block: &Block, order: &[usize]) -> Self {
        let rows = block.rows.len();
        let unit = |at: usize, own: usize| {
            if at == own { dictionary.denominator().clone() } else { IBig::ZERO }
        };
        let along = |own: usize| -> Vec<IBig> {
            let entry = |&at: &usize| match block.rows.get(at) {
                Some(&row) => -dictionary.entry(row, block.columns[own]),
                None => unit(at, rows + own),
            };
            order.iter().map(entry).chain([IBig::ZERO]).collect()
        };
        let vertex = order.iter().map(|&at| match block.rows.get(at) {
            Some(&row) => dictionary.value(row).clone(),
            None => IBig::ZERO,
        });
        let mut start: Vec<Vec<IBig>> = (0..block.columns.len()).map(along).collect();
        start.push(vertex.chain([dictionary.denominator().clone()]).collect());
        let nonbasic =
            (0..block.columns.len()).filter_map(|own| order.iter().position(|&at| at == rows + own));
        Self { start, simplex: nonbasic.chain([order.len()]).collect() }
    }

    /// Vertices and extreme directions, in the order of their coordinates.
    fn set(self, most: usize, proceed: &mut dyn FnMut() -> bool) -> Option<ExactSet> {
        let rays = extreme_rays(self.start, &self.simplex, most, proceed)?;
        let (mut vertices, mut directions): (Vec<Vec<RBig>>, Vec<Vec<RBig>>) = (Vec::new(), Vec::new());
        for mut ray in rays {
            match ray.pop() {
                Some(scale) if !scale.is_zero() => {
                    vertices.push(ray.into_iter().map(|entry| ratio(entry, &scale)).collect());
                }
                _ => directions.extend(scaled_to_one(ray.into_iter().map(RBig::from).collect())),
            }
        }
        vertices.sort();
        directions.sort();
        Some(ExactSet::from_corners(vertices, directions))
    }
}
