//! A mechanism with friction in hinges as a block problem of what is varied, and its forces along a branch.

use super::super::friction::friction;
use super::super::mode_problem::overflow;
use super::super::parts::couples;
use super::super::stages::Stages;
use super::spin::{does_not_turn, senses};
use super::states::hinge_states;
use crate::fault::Faults;
use crate::kinetics::ConstraintRow;
use crate::mechanism::FrictionCircle;
use crate::modes::branches::{BranchForces, Instance};
use crate::modes::existence::OutputBound;
use crate::modes::{ContactState, InfluenceCoefficients};
use crate::problem::{TurningHinge, rougher, with_circles};
use nalgebra::DVector;

/// The hinges of these friction circles, with the sense in which each turns; one that has no friction here may stand.
///
/// # Errors
/// A fault for each hinge with friction that does not turn.
pub(crate) fn turning_hinges(stages: &Stages, circles: &[usize]) -> Result<Vec<TurningHinge>, Faults> {
    let Stages { mechanism, configuration, influence, .. } = stages;
    let mut faults = Faults::default();
    let mut turning = Vec::new();
    for (&circle, sense) in circles.iter().zip(senses((mechanism, configuration), influence, circles)) {
        let FrictionCircle { joint, radius, .. } = mechanism.friction_circles[circle];
        let is_smooth = radius == 0.0;
        match sense {
            Ok(sense) => turning.push(TurningHinge { circle, joint, sense }),
            Err(_) if is_smooth => turning.push(TurningHinge { circle, joint, sense: 1.0 }),
            Err(why) => faults.push(does_not_turn(mechanism, circle, why)),
        }
    }
    faults.or(turning)
}

/// The block problem of these hinges, with the couples of guided sliders as outputs.
///
/// # Errors
/// Nothing says how redundant guides share their load; numbers beyond the range of floating point.
pub(crate) fn block_instance(stages: &Stages, hinges: &[TurningHinge]) -> Result<Instance, Faults> {
    GrowingFriction::new(stages, hinges)?.at(1.0)
}

/// The block problem of a mechanism, whose coefficients of friction may be multiplied by a factor.
pub(crate) struct GrowingFriction {
    /// With the couples of guided sliders as outputs.
    coefficients: InfluenceCoefficients,
    hinges: Vec<(TurningHinge, FrictionCircle)>,
    bounds: Vec<OutputBound>,
    senses: Vec<i8>,
}

impl GrowingFriction {
    /// # Errors
    /// Nothing says how redundant guides share their load.
    pub(crate) fn new(stages: &Stages, hinges: &[TurningHinge]) -> Result<Self, Faults> {
        let (bounds, rows): (Vec<OutputBound>, Vec<usize>) =
            couples(&stages.mechanism, &stages.influence).into_iter().unzip();
        let turning = hinges.iter().map(|hinge| hinge.sense);
        let sense = |sign: f64| i8::from(sign > 0.0) - i8::from(sign < 0.0);
        let senses = stages.velocity_signs.iter().copied().chain(turning).map(sense).collect();
        let rows: Vec<ConstraintRow> = rows.into_iter().map(ConstraintRow::unknown).collect();
        let coefficients = stages.data().coefficients(hinges, &rows)?;
        let hinges = with_circles(hinges, &stages.mechanism);
        Ok(Self { coefficients, hinges, bounds, senses })
    }

    /// With this factor.
    ///
    /// # Errors
    /// Numbers beyond the range of floating point.
    pub(crate) fn at(&self, factor: f64) -> Result<Instance, Faults> {
        let numbers = rougher(&self.coefficients, &self.hinges, factor).numbers();
        let unknowns = numbers.load.len() - self.bounds.len();
        if !numbers.are_finite() {
            return Err(overflow());
        }
        Ok(Instance {
            problem: numbers.rows(0..unknowns).problem().map_err(|_| overflow())?,
            outputs: numbers.rows(unknowns..numbers.load.len()),
            bounds: self.bounds.clone(),
            senses: self.senses.clone(),
        })
    }
}

/// All unknowns of a solution with these states of the contacts.
pub(crate) fn unknowns_of(
    stages: &Stages,
    hinges: &[TurningHinge],
    (states, forces): (&[ContactState], &BranchForces),
) -> DVector<f64> {
    let Stages { mechanism, influence, velocity_signs, .. } = stages;
    let normal = DVector::from_column_slice(&forces.normal);
    let mut shares = vec![None; states.len()];
    forces.gaps.iter().for_each(|share| shares[share.contact] = Some(share.lambda));
    let of_contacts = friction(mechanism, velocity_signs, states, &normal, &shares);
    let of_hinges = hinge_states(mechanism, hinges, &forces.hinges);
    influence.unknowns(&of_contacts, &normal) + influence.of_couples(&of_hinges)
}
