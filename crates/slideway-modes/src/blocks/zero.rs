//! Newton's method, and proofs that a point has exactly one solution near it.

use nalgebra::{DMatrix, DVector};

use super::equations::{Piece, Slopes, load, matrix, residual};
use super::frames::{Ball, Frame, matrix_in_frames};
use super::problem::BlockProblem;
use super::sector::{Vector, unit};
use crate::certificate::{Sign, enclose_solution_while};
use crate::dense::{inverse, solution};
use crate::interval::{Interval, Real};
use crate::interval_matrix::IntervalMatrix;
use crate::problem::ContactState;

/// Steps of Newton's method.
const STEPS: usize = 40;
/// A step of this relative length is the last one, ...
const LAST: f64 = 4.0 * f64::EPSILON;
/// ... and so is one below this length that is not shorter than the one before.
const NEAR: f64 = 1e-3;
/// Relative radii of the boxes that are tried: a large one holds more slopes, a small one less rounding.
const RADII: [f64; 11] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];

/// How much larger a box about vanishing forces is than what rounding leaves of them; times the largest of [`RADII`].
const ROOM: f64 = 1e4;

/// A zero of the equations with the given states of contacts, continued linearly where a state is given.
#[derive(Debug, Clone)]
pub(super) struct Zero {
    pub(super) states: Vec<Option<ContactState>>,
    pub(super) point: DVector<f64>,
    /// Contains the zero.
    pub(super) enclosure: Vec<Interval>,
    /// Contains no other zero.
    pub(super) isolation: Vec<Interval>,
    /// The common sign of the determinants of all slopes in `isolation`; `None` if it is not known.
    pub(super) determinant: Option<Sign>,
}

impl Zero {
    /// Zero itself, the solution without load.
    pub(super) fn at_rest(problem: &BlockProblem) -> Self {
        let states = vec![None; problem.contacts()];
        let point = DVector::zeros(problem.rows());
        let determinant = prove(problem, &states, &point).and_then(|zero| zero.determinant);
        let exact = vec![Interval::ZERO; problem.rows()];
        Self { states, point, enclosure: exact.clone(), isolation: exact, determinant }
    }

    /// The only solution of a problem without blocks.
    pub(super) fn of_nothing() -> Self {
        Self {
            states: Vec::new(),
            point: DVector::zeros(0),
            enclosure: Vec::new(),
            isolation: Vec::new(),
            determinant: Some(Sign::Positive),
        }
    }

    /// What of a contact's unknown is certain: its sign, or of a share whether it is from 0 to 1; `None` if
    /// neither it nor its opposite is certain.
    pub(super) fn agrees(&self, contact: usize, state: ContactState) -> Option<bool> {
        let value = self.enclosure[contact];
        match state {
            ContactState::Positive | ContactState::Negative => {
                let signed = value * Interval::point(state.sign());
                (signed.lower() > 0.0 || signed.upper() < 0.0).then_some(signed.lower() > 0.0)
            }
            ContactState::Gap if value.lower() >= 0.0 && value.upper() <= 1.0 => Some(true),
            ContactState::Gap if value.lower() > 1.0 || value.upper() < 0.0 => Some(false),
            ContactState::Gap => None,
        }
    }
}

/// The only solution of a problem that has exactly one; `None` if it is not found, or not proven, or once `proceed` is
/// `false`.
pub(super) fn proven_everywhere(problem: &BlockProblem, proceed: &mut dyn FnMut() -> bool) -> Option<Zero> {
    if problem.has_no_load() {
        return Some(Zero::at_rest(problem));
    }
    let everything = Piece::all(problem);
    let point = newton_while(problem, &everything.states, start(problem, &everything)?, proceed)?;
    prove_while(problem, &everything.states, &point, proceed)
}

/// A zero of the equations by Newton's method from a point (theory of hinges, section 8, 2); `None` if it does not
/// converge.
pub(super) fn newton(
    problem: &BlockProblem,
    states: &[Option<ContactState>],
    start: DVector<f64>,
) -> Option<DVector<f64>> {
    newton_while(problem, states, start, &mut || true)
}

/// [`newton`]; `None`, too, once `proceed` is `false`, which is asked before each step.
fn newton_while(
    problem: &BlockProblem,
    states: &[Option<ContactState>],
    start: DVector<f64>,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<DVector<f64>> {
    let load = load::<f64>(problem, states);
    let mut point = start;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        if !proceed() {
            return None;
        }
        let next = solution(matrix(problem, states, &slopes_at(problem, &point)), &load)?;
        let step = (&next - &point).amax();
        let size = next.amax();
        if !size.is_finite() {
            return None;
        }
        point = next;
        // Near locking rounding may be large: the proof decides whether a point is good enough.
        if step <= LAST * size || (step <= NEAR * size && step >= last) {
            return Some(point);
        }
        last = step;
    }
    None
}

/// The zero of the linear equations with the slopes in the middle of a piece.
pub(super) fn start(problem: &BlockProblem, piece: &Piece) -> Option<DVector<f64>> {
    let hinges = piece.sectors.iter().map(|sector| sector.disc().0).collect();
    let slopes = Slopes { contacts: vec![0.0; problem.contacts()], hinges };
    solution(matrix(problem, &piece.states, &slopes), &load(problem, &piece.states))
}

/// The slopes at a point; of contacts and hinges without force zero.
pub(super) fn slopes_at(problem: &BlockProblem, point: &DVector<f64>) -> Slopes {
    let sign = |value: f64| if value == 0.0 { 0.0 } else { value.signum() };
    let hinge = |hinge| unit(problem.rows_of_hinge(hinge).map(|row| point[row]));
    Slopes {
        contacts: (0..problem.contacts()).map(|contact| sign(point[contact])).collect(),
        hinges: (0..problem.hinges()).map(hinge).collect(),
    }
}

/// Proves that there is exactly one zero near a point; `None` if that fails.
///
/// `A (x - x') = F(x) - F(x')` for any two points of a box, with some `A` in the set of slopes over the box.
/// If every such `A` is regular, there is at most one zero in it, and the determinants have one sign. If
/// moreover all `-A^-1 F(x_0)` lie within the box about `x_0`, then no zero of `F - (1 - t) F(x_0)` crosses
/// its border as `t` goes from 0 to 1, so that the degree in it, one in size at `t = 0`, stays: there is a zero.
pub(super) fn prove(
    problem: &BlockProblem,
    states: &[Option<ContactState>],
    point: &DVector<f64>,
) -> Option<Zero> {
    prove_while(problem, states, point, &mut || true)
}

/// [`prove`]; `None`, too, once `proceed` is `false`.
fn prove_while(
    problem: &BlockProblem,
    states: &[Option<ContactState>],
    point: &DVector<f64>,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Zero> {
    let residual = residual::<Interval>(problem, states, point);
    let right = IntervalMatrix::from_intervals(&DMatrix::from_fn(point.len(), 1, |row, _| -residual[row]))?;
    // Bounds on the solutions of the linear equations for all values within the bounds: no smaller box proves anything.
    let inverse = inverse(matrix(problem, states, &slopes_at(problem, point)), proceed)?;
    let bounds = inverse.abs() * residual.map(Interval::magnitude);
    let sizes = sizes(problem, states, point, ROOM * bounds.amax());
    let least = bounds.component_div(&sizes).max();
    RADII.iter().filter(|radius| **radius > least).find_map(|radius| {
        let isolation: Vec<Interval> =
            point.iter().zip(&sizes).map(|(&at, size)| Interval::around(at, radius * size)).collect();
        let of_hinge = |hinge: usize| {
            let rows = problem.rows_of_hinge(hinge);
            frame(rows.map(|row| point[row]), rows.map(|row| isolation[row]))
        };
        let frames: Vec<Frame> = (0..problem.hinges()).map(of_hinge).collect();
        let matrix = matrix_in_frames(problem, states, &contact_slopes(problem, &isolation), &frames)?;
        let steps = enclose_solution_while(&matrix, &right, proceed)?;
        let mut enclosure: Vec<Interval> = (0..point.len()).map(|row| steps.solution.entry(row, 0)).collect();
        for (hinge, frame) in frames.iter().enumerate() {
            let rows = problem.rows_of_hinge(hinge);
            let step = rows.map(|row| enclosure[row]);
            for (component, row) in rows.into_iter().enumerate() {
                let [along, across] = frame.vectors.map(|vector| Interval::point(vector[component]));
                enclosure[row] = step[0] * along + step[1] * across;
            }
        }
        for (value, &at) in enclosure.iter_mut().zip(point) {
            *value += Interval::point(at);
        }
        let is_inside = enclosure
            .iter()
            .zip(&isolation)
            .all(|(inner, outer)| outer.lower() < inner.lower() && inner.upper() < outer.upper());
        is_inside.then(|| Zero {
            states: states.to_vec(),
            point: DVector::from_iterator(point.len(), enclosure.iter().map(|value| value.middle())),
            enclosure,
            isolation,
            determinant: Some(steps.determinant),
        })
    })
}

/// Whether the unknown of a row is the share of a contact in its gap.
fn is_share(states: &[Option<ContactState>], row: usize) -> bool {
    states.get(row) == Some(&Some(ContactState::Gap))
}

/// What the radii of boxes are shares of: the largest component of the forces, or `least` where they vanish within rounding, and of
/// the share of a contact in its gap one.
fn sizes(
    problem: &BlockProblem,
    states: &[Option<ContactState>],
    point: &DVector<f64>,
    least: f64,
) -> DVector<f64> {
    let forces = (0..problem.rows()).filter(|&row| !is_share(states, row)).map(|row| point[row].abs());
    let largest = forces.fold(least.max(f64::MIN_POSITIVE), f64::max);
    DVector::from_fn(problem.rows(), |row, _| if is_share(states, row) { 1.0 } else { largest })
}

/// Bounds on the slopes of contacts between any two points of a box.
fn contact_slopes(problem: &BlockProblem, isolation: &[Interval]) -> Vec<Ball> {
    let slope = |value: &Interval| match value.sign() {
        Some(Sign::Positive) => Ball::point(1.0),
        Some(Sign::Negative) => Ball::point(-1.0),
        _ => Ball::ANY_SLOPE,
    };
    isolation[..problem.contacts()].iter().map(slope).collect()
}

/// The frame of a hinge along its reaction at a point, and bounds on the slopes over a box: those of the directions in
/// it.
fn frame(reaction: Vector, isolation: [Interval; 2]) -> Frame {
    let [x, y] = isolation;
    if x.contains(0.0) && y.contains(0.0) {
        return Frame::of_components([Ball::ANY_SLOPE; 2]);
    }
    let [a, b] = unit(reaction);
    let vectors = [[a, b], [-b, a]];
    let [along, across] = vectors.map(|vector| {
        let [a, b] = vector.map(Interval::point);
        a * x + b * y
    });
    let length = Interval::point(a).hypot(Interval::point(b));
    let slopes = [component_of_direction(along, across), component_of_direction(across, along)];
    Frame { vectors, slopes: slopes.map(|slope| Ball::from(slope * length)) }
}

/// `x / sqrt(x^2 + y^2)` over a box without zero: it grows with `x`, and its size falls with `|y|`.
fn component_of_direction(x: Interval, y: Interval) -> Interval {
    let size = y.abs();
    let at = |x: f64, y: f64| {
        if x == 0.0 {
            return Interval::ZERO;
        }
        let (x, y) = (Interval::point(x), Interval::point(y));
        x / x.hypot(y)
    };
    let lower = at(x.lower(), if x.lower() >= 0.0 { size.upper() } else { size.lower() });
    let upper = at(x.upper(), if x.upper() >= 0.0 { size.lower() } else { size.upper() });
    lower.hull(upper)
}
