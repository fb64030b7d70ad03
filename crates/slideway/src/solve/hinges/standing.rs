//! A hinge that never turns: its friction couple is free within the friction circle, so that the answer is a range.
//!
//! In a mode all forces are affine in the couple `M`, `x = x_0 + M x_1`, and with the hinge force `R = R_0 + M R_1`
//!
//! ```text
//! |M| <= r |R|:    (r^2 R_1.R_1 - 1) M^2 + 2 r^2 R_0.R_1 M + r^2 R_0.R_0 >= 0
//! ```
//!
//! which together with the sides of the contacts leaves at most two ranges of `M`.

use super::super::answer::{Answer, status};
use super::super::mode_problem::overflow;
use super::super::state::{State, pattern};
use super::block_coefficients;
use crate::enclosure::TurningHinge;
use crate::fault::Faults;
use crate::influence::HingeState;
use crate::modes::{BySide, Certificate, ContactState, Side};
use crate::report::{Continuum, CoupleRange, SolveReport};
use crate::solve::Stages;
use nalgebra::{DMatrix, DVector};

/// The most contacts for which every mode is examined.
pub(super) const MOST_CONTACTS: usize = 12;
/// Modes whose determinant is below this are singular within rounding.
const SINGULAR: f64 = 1e-12;

/// The ranges of all modes.
///
/// # Errors
/// Numbers beyond the range of floating point.
pub(super) fn ranges(
    answer: &Answer<'_>,
    stages: &Stages,
    hinge: TurningHinge,
) -> Result<SolveReport, Faults> {
    let numbers = block_coefficients(stages.hinged(), &[hinge]);
    let modes = Modes {
        answer,
        hinge,
        response: numbers.response(),
        jumps: numbers.jumps(),
        load: numbers.frictionless,
        couple: numbers.couples.column(0).into_owned(),
    };
    if modes.couple.iter().chain(&modes.load).any(|value| !value.is_finite()) {
        return Err(overflow());
    }
    let contacts = stages.mechanism.contacts.len();
    let name = &stages.mechanism.joints[hinge.joint.index()].name;
    let mut open =
        vec![format!("the ranges of the couple of {name}, which never turns, are computed, not proven")];
    let mut continua = Vec::new();
    for number in 0..1_usize << contacts {
        let sides: Vec<Side> = (0..contacts)
            .map(|k| if number >> k & 1 == 0 { Side::Positive } else { Side::Negative })
            .collect();
        match modes.mode(&sides) {
            Some(mode) => continua.extend(modes.ranges(&sides, &mode)),
            None => {
                open.push(format!("the mode {} is singular and was not examined", pattern(&states(&sides))));
            }
        }
    }
    Ok(SolveReport {
        status: status(open.len() > 1, 0, 0, continua.len()),
        strategy: "every mode, affine in the couple of a hinge that never turns".to_owned(),
        nodes: 1 << contacts,
        continua,
        ..answer.report_without_solutions(open)
    })
}

fn states(sides: &[Side]) -> Vec<ContactState> {
    sides.iter().map(|side| ContactState::from(*side)).collect()
}

struct Modes<'a> {
    answer: &'a Answer<'a>,
    hinge: TurningHinge,
    /// Columns of the contacts, then one of the hinge, which is not used.
    response: BySide<DMatrix<f64>>,
    jumps: BySide<DMatrix<f64>>,
    load: DVector<f64>,
    /// What a unit couple adds.
    couple: DVector<f64>,
}

/// Normal forces and hinge force in one mode: without the couple, and what a unit of it adds.
type Affine = [DVector<f64>; 2];

impl Modes<'_> {
    /// `x_0` and `x_1`; none if the mode is singular.
    fn mode(&self, sides: &[Side]) -> Option<Affine> {
        let rows = self.load.len();
        let sign = |k: usize| sides[k].sign();
        let matrix = DMatrix::from_fn(rows, rows, |row, k| {
            let friction =
                if k < sides.len() { self.response.get(sides[k])[(row, k)] * sign(k) } else { 0.0 };
            if row == k { 1.0 - friction } else { -friction }
        });
        let jumps = (0..sides.len()).map(|k| self.jumps.get(sides[k]).column(k).into_owned());
        let load = jumps.fold(self.load.clone(), |load, jump| load + jump);
        if matrix.determinant().abs() <= SINGULAR {
            return None;
        }
        let factors = matrix.lu();
        Some([factors.solve(&load)?, factors.solve(&self.couple)?])
    }

    fn ranges(&self, sides: &[Side], [start, slope]: &Affine) -> Vec<Continuum> {
        let mut pressed = [f64::NEG_INFINITY, f64::INFINITY];
        for (k, side) in sides.iter().enumerate() {
            pressed = clipped(pressed, start[k] * side.sign(), slope[k] * side.sign());
        }
        let radius = self.answer.mechanism.friction_circles[self.hinge.circle].static_radius;
        let force = |x: &DVector<f64>| [x[sides.len()] * radius, x[sides.len() + 1] * radius];
        let within = within_circle(force(start), force(slope));
        let both = within.into_iter().map(|[from, to]| [from.max(pressed[0]), to.min(pressed[1])]);
        both.filter(|[from, to]| from <= to)
            .map(|range| self.continuum(sides, [start, slope], range))
            .collect()
    }

    fn continuum(&self, sides: &[Side], [start, slope]: [&DVector<f64>; 2], range: [f64; 2]) -> Continuum {
        let contacts = sides.len();
        let couples: Vec<f64> = range.into_iter().filter(|couple| couple.is_finite()).collect();
        let mut tipping = Vec::new();
        let vertex = |couple: &f64| {
            let x = start + slope * *couple;
            tipping.extend(self.tips(sides, &x, *couple));
            x.iter().take(contacts).copied().collect()
        };
        let vertices = couples.iter().map(vertex).collect();
        tipping.dedup();
        let ends = [-1.0, 1.0].into_iter().zip(range).filter(|(_, end)| end.is_infinite());
        let directions =
            ends.map(|(sense, _)| slope.iter().take(contacts).map(|part| part * sense).collect());
        Continuum {
            pattern: pattern(&states(sides)),
            vertices,
            directions: directions.collect(),
            motion: Vec::new(),
            motion_along: Vec::new(),
            tipping,
            couple: Some(CoupleRange {
                hinge: self.answer.mechanism.joints[self.hinge.joint.index()].name.to_string(),
                couples,
            }),
        }
    }

    /// The guided slider that would tip at an end of a range, if one would.
    fn tips(&self, sides: &[Side], x: &DVector<f64>, couple: f64) -> Option<String> {
        let pressed = states(sides);
        let contacts = sides.len();
        let normal_force = x.rows(0, contacts).into_owned();
        let hinges = [HingeState {
            circle: self.hinge.circle,
            joint: self.hinge.joint,
            force: [x[contacts], x[contacts + 1]],
            couple,
        }];
        let state = State {
            pattern: &pressed,
            patterns: Vec::new(),
            normal_force: &normal_force,
            shares: vec![None; contacts],
            signs: Vec::new(),
            on_boundary: false,
            determinant: 0.0,
            certificate: &Certificate::NotProven,
            hinges: &hinges,
        };
        Some(self.answer.tipping(&state, &self.answer.unknowns(&state))?.joint)
    }
}

/// The part of a range where `start + slope t >= 0`; empty if its first end is greater than the last.
fn clipped([from, to]: [f64; 2], start: f64, slope: f64) -> [f64; 2] {
    let at = -start / slope;
    if slope > 0.0 {
        [from.max(at), to]
    } else if slope < 0.0 {
        [from, to.min(at)]
    } else if start >= 0.0 {
        [from, to]
    } else {
        [f64::INFINITY, f64::NEG_INFINITY]
    }
}

/// The ranges of `t` in which `|t| <= |start + slope t|`, both already times the radius.
fn within_circle(start: [f64; 2], slope: [f64; 2]) -> Vec<[f64; 2]> {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    // a t^2 + 2 b t + c >= 0, c >= 0
    let (a, b, c) = (dot(slope, slope) - 1.0, dot(start, slope), dot(start, start));
    let discriminant = b * b - a * c;
    let all = [f64::NEG_INFINITY, f64::INFINITY];
    if discriminant < 0.0 {
        return vec![all];
    }
    // Without cancellation: the roots are q/a and c/q.
    let q = -(b + discriminant.sqrt().copysign(b));
    let mut roots = [q / a, c / q].map(|root| if root.is_nan() { 0.0 } else { root });
    roots.sort_by(f64::total_cmp);
    if a < 0.0 {
        vec![roots]
    } else if a > 0.0 {
        vec![[all[0], roots[0]], [roots[1], all[1]]]
    } else {
        let at = -c / (2.0 * b);
        vec![if b > 0.0 {
            [at, all[1]]
        } else if b < 0.0 {
            [all[0], at]
        } else {
            all
        }]
    }
}
