//! A state with a proof of how far its branch can be followed in one step.
//!
//! Along a [`Leg`] the joint equations `F(x; s) = 0` depend on the place `s` linearly. At a state `x0` (place
//! `s0`) let `J = D F(x0)`, `C` an approximate inverse of `J`, `t` the tangent (`J t + dF/ds` is about zero),
//! and for a way `h` and a vector `e > 0`
//!
//! ```text
//! y(s) = x0 + (s - s0) t,      X(s) = { x : |x - y(s)| <= e },      |s - s0| <= h       (componentwise)
//! ```
//!
//! the tube around the tangent. With bounds that hold in the whole tube,
//!
//! ```text
//! |C F(y(s); s)| <= b,         |I - C D F(x)| <= B,                 b + B e <= e
//! ```
//!
//! the map `x -> x - C F(x; s)` takes `X(s)` into itself, for by the mean value theorem its Lipschitz matrix
//! is B, and in the maximum norm with the weights `e` it is a contraction. So each `X(s)` holds exactly one
//! solution `x(s)`, where `D F` is regular, and `x(s)` is continuous in s: all these solutions lie on the
//! branch of `x(s0)`. (The theorem of Newton and Kantorovich in the componentwise form of Krawczyk: Ortega
//! and Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables, 1970, sections 12.4 to
//! 12.6; Neumaier, Interval Methods for Systems of Equations, 1990, section 5.1.)
//!
//! By Taylor's theorem about `x0`, with `u = h |t| + e`, with `D2 F` there and with bounds of `D3 F`
//! everywhere in the tube ([`super::curvature`]):
//!
//! ```text
//! b = |C F(x0; s0)| + h |C (J t + dF/ds)| + h^2/2 |C D2F[t, t]| + |C| (1/6 sup |D3F[h t, h t, h t]| + p + r)
//! B e = (|I - C J| + h |C D2F[t, .]|) e + |C| (sup |D2F[e, e]| + 1/2 sup |D3F[u, u, e]|)
//! ```
//!
//! `p` is what the wanted values may be beside the leg (zero, or the half width of a neighbourhood for which
//! the step is shown, too). `r` is an allowance for rounding, [`ROUNDING`] units in the last place of the
//! greatest number in an equation for each residual and each derivative; products with C have one of their
//! own. It is not an interval computation: sums of about ten products are off by less than half of it.
//! `b + B e <= 0.8 e` is asked for ([`FIT`]).
//!
//! The computed state at the end counts if it lies in the tube, nearer to its middle than 0.9 e, with a
//! residual that is rounding: by the contraction the solution in the tube is then next to it.

use super::Pose;
use super::curvature::Curvature;
use super::factors::Factors;
use super::joint_equations::JointEquations;
use super::leg::Leg;
use super::mobility::advance;
use crate::mechanism::Mechanism;
use nalgebra::{DMatrix, DVector};

/// Rounding of a residual or a derivative in units in the last place.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Part of the tube into which the proof has to bring the solution ...
const FIT: f64 = 0.8;
/// ... and part of it in which a computed state has to lie.
const INSIDE: f64 = 0.9;
/// Attempts to find the width of the tube for a way.
const WIDENINGS: usize = 6;

/// A state on a leg, and what is known of the joint equations around it.
#[derive(Debug, Clone)]
pub(super) struct Anchor {
    /// Its place on the leg.
    pub(super) place: f64,
    poses: Vec<Pose>,
    size: f64,
    curvature: Curvature,
    /// |C|
    inverse: DMatrix<f64>,
    /// t, and its absolute values.
    tangent: DVector<f64>,
    speed: DVector<f64>,
    /// |I - C J|, with its rounding.
    defect: DMatrix<f64>,
    /// |C D2F[t, .]|
    turning: DMatrix<f64>,
    /// Part of the bound `b` that does not depend on the way: |C F| and the rounding of the positions.
    offset: DVector<f64>,
    /// |C (J t + dF/ds)|
    slip: DVector<f64>,
    /// |C D2F[t, t]| / 2
    bend: DVector<f64>,
    /// p + r for each equation.
    allowance: DVector<f64>,
    rounding: f64,
}

impl Anchor {
    /// A state with positions that satisfy the joints at a place of a leg; none if its Jacobian has no
    /// inverse, or once `proceed` is `false`.
    pub(super) fn new(
        (mechanism, leg): (&Mechanism, &Leg),
        place: f64,
        poses: Vec<Pose>,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        let (equations, curvature) = JointEquations::with_curvature(mechanism, &poses, &leg.values(place));
        let jacobian = equations.jacobian;
        if !jacobian.is_square() || jacobian.is_empty() {
            return None;
        }
        let inverse = Factors::of_while(&jacobian, proceed)?.inverse();
        let residual = leg.residual(equations.residual, place);
        let slope = leg.slope(mechanism);
        let tangent = -(&inverse * &slope);
        let change = curvature.along(&tangent);
        let magnitude = greatest_number(mechanism, &poses, &curvature);
        let rounding = ROUNDING * magnitude;
        let rows = jacobian.nrows();
        let products = (rows + 2) as f64 * f64::EPSILON;
        let magnitudes = inverse.abs();
        let defect = (DMatrix::identity(rows, rows) - with_sparse(&inverse, &jacobian)).abs()
            + with_sparse(&magnitudes, &jacobian.abs()) * products;
        let anchor = Self {
            place,
            size: mechanism.size,
            offset: (&inverse * residual).abs().add_scalar(4.0 * f64::EPSILON * magnitude),
            slip: (&inverse * (&jacobian * &tangent + slope)).abs(),
            bend: (&inverse * (&change * &tangent)).abs() / 2.0,
            turning: with_sparse(&inverse, &change).abs(),
            allowance: leg.beside(mechanism).add_scalar(rounding),
            speed: tangent.abs(),
            inverse: magnitudes,
            tangent,
            defect,
            rounding,
            curvature,
            poses,
        };
        let is_finite = anchor.tangent.iter().chain(anchor.inverse.iter()).all(|entry| entry.is_finite());
        is_finite.then_some(anchor)
    }

    /// The half widths of a tube in which the branch is proven for a way in both directions; none if it was
    /// not shown.
    pub(super) fn tube(&self, way: f64) -> Option<DVector<f64>> {
        let matrix = &self.defect + &self.turning * way;
        let start = self.beside_tangent(way);
        let mut image = start.clone();
        for _ in 0..WIDENINGS {
            let tube = &image * 2.0;
            let next = &start + &matrix * &tube + &self.inverse * self.bending(way, &tube);
            if !next.iter().all(|width| width.is_finite()) {
                return None;
            }
            if next.iter().zip(&tube).all(|(image, tube)| *image <= FIT * tube) {
                return Some(tube);
            }
            image = next;
        }
        None
    }

    /// b
    fn beside_tangent(&self, way: f64) -> DVector<f64> {
        let steps = &self.speed * way;
        let mut rows = self.allowance.clone();
        self.curvature.add_third(1.0 / 6.0, &steps, &steps, &mut rows);
        &self.offset + &self.slip * way + &self.bend * (way * way) + &self.inverse * rows
    }

    /// Bounds how much each equation bends within a tube.
    fn bending(&self, way: f64, tube: &DVector<f64>) -> DVector<f64> {
        let mut rows = DVector::from_element(tube.len(), self.rounding * tube.sum());
        self.curvature.add_second(tube, tube, &mut rows);
        self.curvature.add_third(0.5, &(&self.speed * way + tube), tube, &mut rows);
        rows
    }

    /// The greatest way, within a factor of two, for which there is a tube, and that; at most `longest`.
    pub(super) fn reach(&self, guess: f64, longest: f64) -> Option<(f64, DVector<f64>)> {
        let mut way = guess.min(longest);
        let mut found = self.tube(way);
        while found.is_none() {
            way /= 2.0;
            if way < f64::EPSILON * f64::EPSILON {
                return None;
            }
            found = self.tube(way);
            if found.is_some() {
                return found.map(|tube| (way, tube));
            }
        }
        let mut tube = found?;
        while way < longest {
            let next = (2.0 * way).min(longest);
            let Some(wider) = self.tube(next) else { break };
            (way, tube) = (next, wider);
        }
        Some((way, tube))
    }

    /// y(s) at a way from here.
    pub(super) fn predicted(&self, mechanism: &Mechanism, way: f64) -> Vec<Pose> {
        let mut poses = self.poses.clone();
        advance(mechanism, &mut poses, &(&self.tangent * way));
        poses
    }

    /// Whether poses lie in a tube at a way from here.
    pub(super) fn holds(&self, way: f64, tube: &DVector<f64>, poses: &[Pose]) -> bool {
        self.poses.iter().zip(poses).enumerate().all(|(index, (from, to))| {
            let moved = (to.position - from.position) / self.size;
            let parts = [moved.x, moved.y, to.angle - from.angle];
            (0..3).all(|part| {
                let place = 3 * index + part;
                (parts[part] - way * self.tangent[place]).abs() <= INSIDE * tube[place]
            })
        })
    }
}

/// The product with a matrix most of whose entries are zero: an equation of a joint is one of two bodies.
fn with_sparse(matrix: &DMatrix<f64>, sparse: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = DMatrix::zeros(matrix.nrows(), sparse.ncols());
    for (factors, mut column) in sparse.column_iter().zip(product.column_iter_mut()) {
        for (factor, from) in factors.iter().zip(matrix.column_iter()).filter(|(factor, _)| **factor != 0.0) {
            column.axpy(*factor, &from, 1.0);
        }
    }
    product
}

/// The greatest number in a residual (sizes of the mechanism, or rad).
fn greatest_number(mechanism: &Mechanism, poses: &[Pose], curvature: &Curvature) -> f64 {
    let of = |pose: &Pose| (pose.position.amax() / mechanism.size).max(pose.angle.abs());
    1.0 + poses.iter().map(of).fold(curvature.greatest_length(), f64::max)
}
