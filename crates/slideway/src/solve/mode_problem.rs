//! From a mechanism's influence coefficients to the pure numbers of its mode problem.

use super::no_sliding::why;
use super::parts::Parts;
use super::resting::may_lift_off;
use super::tolerant::StatesWithinTolerances;
use crate::configuration::{Configuration, staying};
use crate::fault::{Fault, FaultKind, Faults, NoSliding};
use crate::ids::{ContactId, JointId};
use crate::influence::{ContactFriction, Influence};
use crate::kinetics::ConstraintRow;
use crate::mechanism::{FrictionCircle, Mechanism};
use crate::modes::blocks::BlockProblem;
use crate::modes::existence::ModeProblemLine;
use crate::modes::{BySide, InfluenceCoefficients, ModeProblem};
use crate::problem::{NO_INFLUENCE, TurningHinge, friction_of_contacts, preload_columns, without_rounding};
use crate::progress::Progress;
use crate::sharing::{check_assembly, shared_load, stress_force};
use nalgebra::{DMatrix, DVector};
use std::ops::{ControlFlow, Range};

/// What is asked of contacts that stand still.
const STANDING: &str = "the friction of contacts that stand still";

/// Velocities of sliding and turning below this multiple of the greatest velocity count as zero.
pub(super) const AT_REST: f64 = 1e-12;

/// The signs s_k of the sliding velocities; 0 is possible only where there is no friction.
///
/// # Errors
/// A fault for the contacts with friction that do not slide: eq. (2) does not say their friction.
pub fn velocity_signs(mechanism: &Mechanism, configuration: &Configuration) -> Result<DVector<f64>, Faults> {
    let Sliding { signs, standing } = Sliding::of(mechanism, configuration)?;
    none_stands(mechanism, &standing)?;
    Ok(signs)
}

/// Which contacts slide in which sense, and which do not.
pub(crate) struct Sliding {
    /// The signs of the sliding velocities; 0 where a contact stands, or has no friction.
    pub(crate) signs: DVector<f64>,
    /// The contacts with friction that do not slide: all of them if some of them may lift off, else those that the drives keep at
    /// rest while the rest moves.
    pub(crate) standing: Vec<ContactId>,
}

impl Sliding {
    /// # Errors
    /// A fault for the contacts with friction that do not slide now but may begin to, where the forces decide that; none beside those
    /// that may lift off, as then all states are tried.
    pub(crate) fn of(mechanism: &Mechanism, configuration: &Configuration) -> Result<Self, Faults> {
        let signs = sliding_signs(mechanism, configuration);
        let still = (0..signs.len()).filter(|&k| signs[k] == 0.0 && mechanism.contacts[k].may_hold());
        let still: Vec<ContactId> = still.map(ContactId).collect();
        if still.is_empty() {
            return Ok(Self { signs, standing: still });
        }
        if may_lift_off(mechanism, &still) {
            mechanism.check_planar(STANDING, still.iter().copied())?;
            return Ok(Self { signs, standing: still });
        }
        let joints: Vec<JointId> = still.iter().map(|id| mechanism.contacts[id.index()].joint).collect();
        let is_at_rest = configuration.rates.iter().all(|rate| *rate == 0.0);
        let staying = if is_at_rest { Vec::new() } else { staying(mechanism, configuration, &joints)? };
        let stays = |id: &ContactId| staying.contains(&mechanism.contacts[id.index()].joint);
        let (standing, undefined): (Vec<ContactId>, Vec<ContactId>) = still.into_iter().partition(stays);
        let Some(first) = undefined.first() else {
            mechanism.check_planar(STANDING, standing.iter().copied())?;
            return Ok(Self { signs, standing });
        };
        let first_slides =
            |state: &Configuration| vec![sliding_signs(mechanism, state)[first.index()] != 0.0];
        let why = why(mechanism, configuration, (1, &first_slides)).pop();
        Err(does_not_slide(mechanism, &undefined, why.map_or(NoSliding::Here, |why| why.reason)))
    }
}

/// Refuses contacts that stand still while the rest moves.
///
/// # Errors
/// A fault for them.
pub(super) fn none_stands(mechanism: &Mechanism, standing: &[ContactId]) -> Result<(), Faults> {
    if standing.is_empty() { Ok(()) } else { Err(stands(mechanism, standing)) }
}

/// The fault of contacts that stand still while the rest moves.
pub(super) fn stands(mechanism: &Mechanism, standing: &[ContactId]) -> Faults {
    let why = if may_lift_off(mechanism, standing) { NoSliding::Starts } else { NoSliding::Stands };
    does_not_slide(mechanism, standing, why)
}

/// The fault of contacts that do not slide, at the joint of the first.
pub(super) fn does_not_slide(mechanism: &Mechanism, contacts: &[ContactId], why: NoSliding) -> Faults {
    let of = |id: &ContactId| &mechanism.contacts[id.index()];
    let names = contacts.iter().map(|id| of(id).name.to_string()).collect();
    let place = contacts.first().map(|id| mechanism.joints[of(id).joint.index()].place.clone());
    let kind = FaultKind::ZeroSlidingVelocity { contacts: names, why };
    place.map_or_else(|| Fault::general(kind.clone()), |place| Fault::new(kind.clone(), place)).into()
}

/// The signs of the sliding velocities, 0 where they vanish within rounding, and of what sticks.
pub(crate) fn sliding_signs(mechanism: &Mechanism, configuration: &Configuration) -> DVector<f64> {
    let contacts = (0..mechanism.contacts.len()).map(ContactId);
    let sliding: Vec<f64> =
        contacts.map(|contact| configuration.contact(mechanism, contact).sliding_velocity).collect();
    let speeds =
        configuration.velocities.iter().map(|v| v.linear.norm().max(v.angular.abs() * mechanism.size));
    let greatest = sliding.iter().map(|v| v.abs()).chain(speeds).fold(0.0, f64::max);
    let at_rest = |velocity: f64| velocity.abs() <= AT_REST * greatest;
    let sign = |velocity: &f64| if at_rest(*velocity) { 0.0 } else { velocity.signum() };
    let mut signs = DVector::from_iterator(sliding.len(), sliding.iter().map(sign));
    let sticking = mechanism.sticking().flat_map(|(_, slider)| &slider.contacts);
    sticking.for_each(|contact| signs[contact.index()] = 0.0);
    signs
}

/// The mode problem of a mechanism, eqs. (6) and (8): its unknowns are the |N_k|.
///
/// Of redundant guides, the rows of the contacts that are cut say how they share their load instead.
///
/// # Errors
/// A fault if a number is beyond the range of floating point, or if nothing says how redundant guides share
/// their load, or if rigid ones cannot be assembled.
pub fn mode_problem(
    mechanism: &Mechanism,
    influence: &Influence,
    velocity_signs: &DVector<f64>,
) -> Result<ModeProblem, Faults> {
    let data = ProblemData { mechanism, influence, velocity_signs };
    let coefficients = data.coefficients(&[], &[])?;
    if let Some(shared) = &coefficients.shared {
        check_assembly(mechanism, shared)?;
    }
    ModeProblem::from_influence(&coefficients).map_err(|_| overflow())
}

/// The stages from which a problem is made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProblemData<'a> {
    /// Its contacts have their coefficients of friction and preloads.
    pub(crate) mechanism: &'a Mechanism,
    /// How forces answer to friction.
    pub(crate) influence: &'a Influence,
    /// The signs of the sliding velocities.
    pub(crate) velocity_signs: &'a DVector<f64>,
}

impl ProblemData<'_> {
    /// Returns the coefficients of the problem of the contacts and of these hinges, in floating point, with
    /// these functions of the unknowns as outputs.
    ///
    /// # Errors
    /// Nothing says how redundant guides share their load.
    pub(crate) fn coefficients(
        self,
        hinges: &[TurningHinge],
        outputs: &[ConstraintRow],
    ) -> Result<InfluenceCoefficients, Faults> {
        let Self { mechanism, influence, velocity_signs } = self;
        let circles: Vec<&FrictionCircle> =
            hinges.iter().map(|hinge| &mechanism.friction_circles[hinge.circle]).collect();
        let own = influence.block_rows(&circles);
        let rows = own.len() + outputs.len();
        let entry = |row: usize, unknowns: &DVector<f64>| match row.checked_sub(own.len()) {
            None => unknowns[own[row]],
            Some(output) => outputs[output].times(unknowns),
        };
        let answers = |rows: Range<usize>, face: usize| {
            let columns = &influence.columns;
            DMatrix::from_fn(rows.len(), columns.len(), |row, k| entry(rows.start + row, &columns[k][face]))
        };
        let upper = without_rounding(mechanism, [0, 1].map(|face| answers(0..own.len(), face)));
        let lower = BySide { positive: answers(own.len()..rows, 0), negative: answers(own.len()..rows, 1) };
        let eta = BySide::of(|side| stacked(upper.get(side), lower.get(side)));
        let [mu, preload] = friction_of_contacts(mechanism, &|_| true);
        let stresses = &influence.self_stresses;
        let self_stress = DMatrix::from_fn(rows, stresses.len(), |row, column| {
            let force = entry(row, &stresses[column]);
            if row < own.len() { stress_force(force) } else { force }
        });
        let without_friction = |row: usize| {
            let given = row.checked_sub(own.len()).map_or(0.0, |output| outputs[output].right_hand_side);
            entry(row, &influence.frictionless) - given
        };
        let turning = |hinge: &TurningHinge| {
            let answers = DVector::from_fn(rows, |row, _| entry(row, &influence.couples[hinge.circle]));
            (answers, hinge.leverage(&mechanism.friction_circles[hinge.circle]))
        };
        Ok(InfluenceCoefficients {
            eta_preload: preload_columns(mechanism, &eta),
            eta,
            mu,
            preload,
            velocity_signs: velocity_signs.clone(),
            frictionless: DVector::from_fn(rows, |row, _| without_friction(row)),
            shared: shared_load(mechanism, self_stress)?,
            one_sided: influence.one_sided(|opening| {
                DVector::from_fn(rows, |row, _| {
                    let part = entry(row, opening);
                    if row < own.len() && part.abs() <= NO_INFLUENCE { 0.0 } else { part }
                })
            }),
            turning: hinges.iter().map(turning).collect(),
        })
    }

    /// All unknowns without friction and preloads. Contacts that would have to pull lift off then, so that these are those of
    /// the only state without friction; of the closed contacts if drives leave none or several.
    pub(crate) fn without_friction(self) -> DVector<f64> {
        let closed = &self.influence.frictionless;
        if self.mechanism.one_sided().next().is_none() {
            return closed.clone();
        }
        let mut smooth = self.mechanism.clone();
        smooth.multiply_friction_of_contacts(|_| 0.0);
        smooth.contacts.iter_mut().for_each(|contact| contact.preload = [0.0; 2]);
        let none = vec![ContactFriction::default(); smooth.contacts.len()];
        let found = ProblemData { mechanism: &smooth, ..self }.problem().ok().and_then(|problem| {
            let mut goes_on = |_: &Progress| ControlFlow::Continue(());
            StatesWithinTolerances::of(&problem, &smooth.excess.open, &mut goes_on)
        });
        match found.as_ref().map(|found| found.states.as_slice()) {
            Some([state]) => self.influence.unknowns(&none, &state.force),
            _ => closed.clone(),
        }
    }

    /// The mode problem.
    ///
    /// # Errors
    /// A fault if a number is beyond the range of floating point, or nothing says how redundant guides share
    /// their load.
    pub(crate) fn problem(self) -> Result<ModeProblem, Faults> {
        ModeProblem::from_influence(&self.coefficients(&[], &[])?).map_err(|_| overflow())
    }

    /// The block mode problem of the contacts and these hinges.
    ///
    /// # Errors
    /// As [`Self::problem`].
    pub(crate) fn block_problem(self, hinges: &[TurningHinge]) -> Result<BlockProblem, Faults> {
        self.coefficients(hinges, &[])?.numbers().problem().map_err(|_| overflow())
    }

    /// The numbers of the mode problem with the couples of guided sliders and then these functions of the
    /// unknowns as outputs.
    ///
    /// # Errors
    /// As [`Self::problem`].
    pub(crate) fn parts(self, others: Vec<ConstraintRow>) -> Result<Parts, Faults> {
        Parts::new(self, others)
    }

    /// The line from no friction of these contacts (`t = 0`) to their present friction (`t = 1`), with the
    /// couples as outputs.
    ///
    /// # Errors
    /// As [`Self::problem`].
    pub(crate) fn growing_friction(self, grows: &dyn Fn(usize) -> bool) -> Result<ModeProblemLine, Faults> {
        let mut smooth = self.mechanism.clone();
        smooth.multiply_friction_of_contacts(|k| if grows(k) { 0.0 } else { 1.0 });
        let without = ProblemData { mechanism: &smooth, ..self }.parts(Vec::new())?;
        Ok(without.line_to(&self.parts(Vec::new())?))
    }
}

/// Two matrices of as many columns, one below the other.
fn stacked(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let mut both = above.clone().resize_vertically(above.nrows() + below.nrows(), 0.0);
    both.rows_mut(above.nrows(), below.nrows()).copy_from(below);
    both
}

/// The normal forces of the self-stresses, without rounding: a row for each contact.
pub(crate) fn self_stresses(influence: &Influence) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> =
        influence.self_stresses.iter().map(|all| influence.normal_part(all).map(stress_force)).collect();
    if columns.is_empty() {
        DMatrix::zeros(influence.columns.len(), 0)
    } else {
        DMatrix::from_columns(&columns)
    }
}

/// Both versions of eta, without the rounding that would stand where friction has no influence; equal where
/// the theory says so, which rounding would hide: for guided sliders, whose couple takes up the moment of
/// friction, and wherever the moment of friction has no influence.
pub(crate) fn sides(mechanism: &Mechanism, influence: &Influence) -> BySide<DMatrix<f64>> {
    without_rounding(mechanism, [0, 1].map(|side| influence.eta(side)))
}

/// The fault of numbers beyond the range of floating point.
pub(super) fn overflow() -> Faults {
    Fault::general(FaultKind::Overflow { quantity: "a coefficient of the mode problem".to_owned() }).into()
}
