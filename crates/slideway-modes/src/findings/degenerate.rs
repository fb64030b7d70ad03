//! Examination of singular patterns: the solutions that they admit.

use nalgebra::{DMatrix, DVector};

use crate::combinations::{binomial, combinations};
use crate::dense::Pace;
use crate::findings::admitted::Admitted;
use crate::problem::{ContactState, ScaledProblem, SolutionSet};
use crate::solutions::Support;

/// A pivot below this counts as zero, with columns scaled to a largest entry of 1.
const ZERO_PIVOT: f64 = 1e-12;
/// Equations that hold to this are consistent.
const CONSISTENT: f64 = 1e-10;
/// Values above minus this fraction of the largest count as nonnegative.
const NON_NEGATIVE: f64 = 1e-9;
/// Points closer than this fraction of their size count as one point.
const SAME_POINT: f64 = 1e-8;

/// The outcome of a closer examination of a suspect pattern.
pub(crate) enum Examined {
    /// It is regular.
    Regular,
    /// `D = 0`, and this is what it admits.
    Singular(Admitted),
}

/// Determines by elimination with complete pivoting whether a pattern is singular, and what it admits.
/// `bases` is the remaining work and is reduced. Nothing is computed once `proceed` is `false`.
pub(crate) fn examine(
    problem: &ScaledProblem,
    pattern: &[ContactState],
    bases: &mut u64,
    proceed: &mut dyn FnMut() -> bool,
) -> Examined {
    let contacts = pattern.len();
    let (mut matrix, right_hand_side) = problem.system(pattern);
    let column_sizes = scale_columns(&mut matrix);
    let not_computed = || Examined::Singular(Admitted::not_computed(contacts));
    match IndependentEquations::new(augment(&matrix, &right_hand_side), proceed) {
        None => return not_computed(),
        Some(reduced) if reduced.rank() == contacts => return Examined::Regular,
        Some(_) => {}
    }
    let (matrix, right_hand_side) = with_share_limits(&matrix, &right_hand_side, pattern, &column_sizes);
    let Some(polyhedron) = Polyhedron::new(&matrix, &right_hand_side, bases, proceed) else {
        return not_computed();
    };
    let corners = distinct(polyhedron.vertices.iter().cloned());
    let support = Support::of_corners(pattern, (&corners, &polyhedron.directions), &problem.has_jump);
    let mean_share = |contact: usize| {
        corners.iter().map(|corner| corner[contact]).sum::<f64>()
            / (corners.len() as f64 * column_sizes[contact])
    };
    // Signed normal forces from scaled unknowns; shares and their complements are omitted.
    let normal_force = |unknowns: &DVector<f64>| {
        DVector::from_fn(contacts, |contact, _| {
            pattern[contact].sign() * unknowns[contact] * problem.load_unit / column_sizes[contact]
        })
    };
    let vertices = distinct(polyhedron.vertices.iter().map(normal_force));
    let directions =
        polyhedron.directions.iter().map(normal_force).filter(|direction| direction.amax() > 0.0);
    let directions = distinct(directions.map(|direction| &direction / direction.amax()));
    let set = SolutionSet::from_corners(vertices, directions);
    Examined::Singular(Admitted::new(pattern, (set, support), (corners.len(), &mean_share)))
}

/// Divides every column by its largest entry, and returns these entries (1 for a zero column).
fn scale_columns(matrix: &mut DMatrix<f64>) -> Vec<f64> {
    matrix
        .column_iter_mut()
        .map(|mut column| {
            let size = if column.amax() > 0.0 { column.amax() } else { 1.0 };
            column /= size;
            size
        })
        .collect()
}

/// The equations together with `lambda_k + complement_k = 1` for every contact in its gap.
fn with_share_limits(
    matrix: &DMatrix<f64>,
    right_hand_side: &DVector<f64>,
    pattern: &[ContactState],
    column_sizes: &[f64],
) -> (DMatrix<f64>, DVector<f64>) {
    let contacts = pattern.len();
    let in_gap: Vec<usize> = (0..contacts).filter(|&k| pattern[k] == ContactState::Gap).collect();
    let size = contacts + in_gap.len();
    let mut extended = matrix.clone().resize(size, size, 0.0);
    let mut extended_right = right_hand_side.clone().resize_vertically(size, 0.0);
    for (index, &contact) in in_gap.iter().enumerate() {
        let row = contacts + index;
        // With z = size lambda as the unknown: z + z' = size, with each divided by size.
        extended[(row, contact)] = column_sizes[contact].recip();
        extended[(row, row)] = 1.0;
        extended_right[row] = 1.0;
    }
    (extended, extended_right)
}

fn augment(matrix: &DMatrix<f64>, right_hand_side: &DVector<f64>) -> DMatrix<f64> {
    let columns = matrix.ncols();
    let mut augmented = matrix.clone().insert_column(columns, 0.0);
    augmented.set_column(columns, right_hand_side);
    augmented
}

/// Equations reduced to independent ones by Gauss-Jordan elimination with complete pivoting.
struct IndependentEquations {
    /// The independent equations first, with the right-hand side last.
    table: DMatrix<f64>,
    basic: Vec<usize>,
}

impl IndependentEquations {
    /// `None` once `proceed` is `false`.
    fn new(mut table: DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> Option<Self> {
        let mut pace = Pace::new(proceed);
        let unknowns = table.ncols() - 1;
        let mut basic = Vec::new();
        while basic.len() < table.nrows().min(unknowns) {
            if !pace.allows(2 * table.len()) {
                return None;
            }
            let rank = basic.len();
            let rest = table.view((rank, 0), (table.nrows() - rank, unknowns));
            let (row, column) = rest.icamax_full();
            if rest[(row, column)].abs() <= ZERO_PIVOT {
                break;
            }
            table.swap_rows(rank, rank + row);
            let pivot = table[(rank, column)];
            table.row_mut(rank).scale_mut(pivot.recip());
            for other in (0..table.nrows()).filter(|&other| other != rank) {
                let factor = table[(other, column)];
                for at in 0..=unknowns {
                    let eliminated = factor * table[(rank, at)];
                    table[(other, at)] -= eliminated;
                }
            }
            basic.push(column);
        }
        Some(Self { table, basic })
    }

    fn rank(&self) -> usize {
        self.basic.len()
    }

    fn is_consistent(&self) -> bool {
        self.table
            .column(self.table.ncols() - 1)
            .iter()
            .skip(self.rank())
            .all(|rest| rest.abs() <= CONSISTENT)
    }
}

/// `{z >= 0, A z = b}` by its vertices and extreme directions. It contains no lines, so it is empty exactly
/// if it has no vertex.
struct Polyhedron {
    vertices: Vec<DVector<f64>>,
    directions: Vec<DVector<f64>>,
}

impl Polyhedron {
    /// `None` if there are more bases to try than `bases` allows, or once `proceed` is `false`.
    fn new(
        matrix: &DMatrix<f64>,
        right_hand_side: &DVector<f64>,
        bases: &mut u64,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        let reduced = IndependentEquations::new(augment(matrix, right_hand_side), proceed)?;
        if !reduced.is_consistent() {
            return Some(Self { vertices: Vec::new(), directions: Vec::new() });
        }
        let rank = reduced.rank();
        let unknowns = matrix.ncols();
        let equations = reduced.table.rows(0, rank).into_owned();
        let work = binomial(unknowns, rank).saturating_add(binomial(unknowns, rank + 1));
        *bases = bases.checked_sub(work)?;
        // Extreme directions are the vertices of {z >= 0, A z = 0, sum z = 1}.
        let mut homogeneous = equations.clone().insert_row(rank, 1.0);
        homogeneous.column_mut(unknowns).fill(0.0);
        homogeneous[(rank, unknowns)] = 1.0;
        Some(Self {
            vertices: basic_feasible_points(&equations, proceed)?,
            directions: basic_feasible_points(&homogeneous, proceed)?,
        })
    }
}

/// All points `z >= 0` that solve the independent equations with as many nonzero unknowns as there are
/// equations; `None` once `proceed` is `false`.
fn basic_feasible_points(
    equations: &DMatrix<f64>,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<DVector<f64>>> {
    let rank = equations.nrows();
    let unknowns = equations.ncols() - 1;
    let right_hand_side = equations.column(unknowns).into_owned();
    let mut points = Vec::new();
    if rank == 0 {
        return Some(vec![DVector::zeros(unknowns)]);
    }
    for basis in combinations(unknowns, rank) {
        if !proceed() {
            return None;
        }
        let factors = equations.select_columns(&basis).lu();
        let regular = factors.lu_internal().diagonal().iter().all(|pivot| pivot.abs() > CONSISTENT);
        if let Some(values) = factors.solve(&right_hand_side).filter(|_| regular) {
            let size = values.amax().max(right_hand_side.amax());
            if values.iter().all(|&value| value >= -NON_NEGATIVE * size) {
                let mut point = DVector::zeros(unknowns);
                for (&at, &value) in basis.iter().zip(&values) {
                    point[at] = if value <= NON_NEGATIVE * size { 0.0 } else { value };
                }
                points.push(point);
            }
        }
    }
    Some(points)
}

fn distinct(points: impl Iterator<Item = DVector<f64>>) -> Vec<DVector<f64>> {
    let mut kept: Vec<DVector<f64>> = Vec::new();
    for point in points {
        if !kept.iter().any(|other| same_point(other, &point)) {
            kept.push(point);
        }
    }
    kept
}

/// Whether two points agree within tolerance relative to the larger one.
pub(crate) fn same_point(one: &DVector<f64>, other: &DVector<f64>) -> bool {
    (one - other).amax() <= SAME_POINT * one.amax().max(other.amax())
}
