//! The stages of a model up to the numbers of its mode problem.

use super::mode_problem::{ProblemData, Sliding, mode_problem, none_stands, self_stresses};
use super::parts::Parts;
use super::resting::{may_lift_off, mode_problem_at_rest};
use super::trail::Trail;
use crate::configuration::{Configuration, Follower};
use crate::fault::Faults;
use crate::ids::{ContactId, DriveId};
use crate::influence::Influence;
use crate::kinetics::{Accuracy, ConstraintRow, Influences, KineticEquations, coordinate_rows};
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::modes::{ModeProblem, SharedLoad};
use crate::report::Elasticity;
use crate::sharing::{check_assembly, elasticity, shared_load};
use nalgebra::DVector;

/// The mode problem of a model in floating point: a problem with exact numbers, which differ from those of the
/// mechanism by rounding. Its unknowns are those of the contacts, and behind them two for each joint that does not slide, first `p` of
/// all, then `q` of all (theory, section 12).
///
/// # Errors
/// Whatever [`solve`](crate::solve::solve) refuses; friction in hinges; of what does not slide static friction above kinetic friction,
/// faces of different heights, and forces that are left open where all sticks.
pub fn exact_mode_problem(model: &Model) -> Result<ModeProblem, Faults> {
    let mechanism = Mechanism::new(model)?;
    mechanism.check_size()?;
    mechanism.check_frictionless_hinges()?;
    let configuration = Configuration::new(&mechanism)?;
    let (stages, equations) = Stages::with_standing(mechanism, configuration)?;
    if !stages.standing.is_empty() {
        return mode_problem_at_rest(&stages, &equations);
    }
    mode_problem(&stages.mechanism, &stages.influence, &stages.velocity_signs)
}

/// A model in its state, ready for its mode problem.
#[derive(Clone)]
pub(crate) struct Stages {
    /// With the friction of its sliding speeds.
    pub(crate) mechanism: Mechanism,
    pub(crate) configuration: Configuration,
    pub(crate) influence: Influence,
    pub(crate) velocity_signs: DVector<f64>,
    /// The contacts with friction that stand still while the rest moves; none unless a constructor says that there may be.
    pub(crate) standing: Vec<ContactId>,
    pub(crate) accuracy: Accuracy,
}

impl Stages {
    /// # Errors
    /// Whatever `solve` refuses.
    pub(crate) fn new(model: &Model) -> Result<Self, Faults> {
        let mechanism = Mechanism::new(model)?;
        mechanism.check_frictionless_hinges()?;
        Self::following(&mut Follower::default(), mechanism)
    }

    /// Those of a mechanism, its positions from those of the last ones if these are near.
    ///
    /// # Errors
    /// Whatever `solve` refuses.
    pub(crate) fn following(follower: &mut Follower, mechanism: Mechanism) -> Result<Self, Faults> {
        let stages = Self::following_with_standing(follower, mechanism)?;
        stages.check_moving()?;
        Ok(stages)
    }

    /// [`Stages::following`], in which contacts may stand still while the rest moves.
    ///
    /// # Errors
    /// Whatever `solve` refuses.
    pub(crate) fn following_with_standing(
        follower: &mut Follower,
        mechanism: Mechanism,
    ) -> Result<Self, Faults> {
        mechanism.check_size()?;
        let configuration = follower.configuration(&mechanism)?;
        Ok(Self::with_standing(mechanism, configuration)?.0)
    }

    /// Those of a model whose hinges may have friction, and in which contacts may stand still while the rest moves.
    ///
    /// # Errors
    /// Whatever `solve` refuses.
    pub(crate) fn of_any_model(model: &Model) -> Result<Self, Faults> {
        Self::following_with_standing(&mut Follower::default(), Mechanism::new(model)?)
    }

    /// Those of a mechanism, from the states of the last ones if these are near; contacts may stand still while the
    /// rest moves.
    ///
    /// # Errors
    /// Whatever `solve` refuses.
    pub(crate) fn along(trail: &mut Trail, mechanism: Mechanism) -> Result<Self, Faults> {
        mechanism.check_size()?;
        let (configuration, influences) = trail.state(&mechanism)?;
        Self::of(mechanism, configuration, influences)
    }

    /// Those of a mechanism in a configuration, and its kinetic equations.
    ///
    /// # Errors
    /// Whatever `solve` refuses of equations and friction; contacts that stand still while the rest moves.
    pub(crate) fn with_equations(
        mechanism: Mechanism,
        configuration: Configuration,
    ) -> Result<(Self, KineticEquations), Faults> {
        let (stages, equations) = Self::with_standing(mechanism, configuration)?;
        stages.check_moving()?;
        Ok((stages, equations))
    }

    /// [`Stages::with_equations`], in which contacts may stand still while the rest moves.
    ///
    /// # Errors
    /// Whatever `solve` refuses of equations and friction.
    pub(crate) fn with_standing(
        mechanism: Mechanism,
        configuration: Configuration,
    ) -> Result<(Self, KineticEquations), Faults> {
        Self::with_standing_while(mechanism, configuration, &mut || true)
    }

    /// [`Stages::with_standing`]; a fault once `proceed` is `false`.
    ///
    /// # Errors
    /// As [`Stages::with_standing`], or [`FaultKind::WorkEnded`](crate::fault::FaultKind::WorkEnded).
    pub(crate) fn with_standing_while(
        mechanism: Mechanism,
        configuration: Configuration,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<(Self, KineticEquations), Faults> {
        let equations = KineticEquations::new_while(&mechanism, &configuration, proceed)?;
        let stages = Self::of(mechanism, configuration, equations.influences())?;
        Ok((stages, equations))
    }

    /// The kinetic equations know nothing of friction: its coefficients at the sliding speeds come behind
    /// them, here for all that is made of these stages.
    fn of(
        mut mechanism: Mechanism,
        configuration: Configuration,
        influences: Influences,
    ) -> Result<Self, Faults> {
        configuration.put_friction(&mut mechanism)?;
        let accuracy = influences.accuracy();
        let influence = Influence::of(influences);
        let Sliding { signs: velocity_signs, standing } = Sliding::of(&mechanism, &configuration)?;
        let stages = Self { mechanism, configuration, influence, velocity_signs, standing, accuracy };
        if let Some(shared) = stages.shared_load()? {
            check_assembly(&stages.mechanism, &shared)?;
        }
        Ok(stages)
    }

    /// Refuses contacts that stand still while the rest moves.
    ///
    /// # Errors
    /// A fault for them.
    pub(crate) fn check_moving(&self) -> Result<(), Faults> {
        none_stands(&self.mechanism, &self.standing)
    }

    /// Returns whether it is at rest on contacts that may lift off.
    pub(crate) fn is_at_rest(&self) -> bool {
        let rests = self.configuration.rates.iter().all(|rate| *rate == 0.0);
        rests && may_lift_off(&self.mechanism, &self.standing)
    }

    /// How redundant guides share their load; none if nothing is in excess.
    ///
    /// # Errors
    /// Nothing says how.
    pub(crate) fn shared_load(&self) -> Result<Option<SharedLoad>, Faults> {
        shared_load(&self.mechanism, self_stresses(&self.influence))
    }

    /// What is taken for the elasticity of redundant guides.
    ///
    /// # Errors
    /// As [`Self::shared_load`].
    pub(crate) fn elasticity(&self) -> Result<Option<Elasticity>, Faults> {
        if self.mechanism.excess.is_empty() {
            return Ok(None);
        }
        elasticity(&self.mechanism, &self_stresses(&self.influence)).map(Some)
    }

    /// What its mode problem is made of.
    pub(crate) fn data(&self) -> ProblemData<'_> {
        ProblemData {
            mechanism: &self.mechanism,
            influence: &self.influence,
            velocity_signs: &self.velocity_signs,
        }
    }

    /// With all friction multiplied by a factor.
    pub(crate) fn with_friction(&self, factor: f64) -> Self {
        let mut stages = self.clone();
        stages.mechanism.multiply_friction(factor);
        stages
    }

    /// The mode problem.
    ///
    /// # Errors
    /// A fault if a number is beyond the range of floating point.
    pub(crate) fn parts(&self) -> Result<Parts, Faults> {
        self.data().parts(Vec::new())
    }

    /// The same with the efforts of the drives as further outputs, behind the couples.
    ///
    /// # Errors
    /// As [`Stages::parts`].
    pub(crate) fn parts_with_efforts(&self) -> Result<Parts, Faults> {
        let drives = 0..self.mechanism.drives.len();
        let effort = |drive: usize| ConstraintRow::unknown(self.influence.layout().effort(DriveId(drive)));
        self.data().parts(drives.map(effort).collect())
    }

    /// The same with the accelerations of the coordinates as further outputs.
    ///
    /// # Errors
    /// As [`Stages::parts`].
    pub(crate) fn parts_with_accelerations(&self) -> Result<Parts, Faults> {
        self.data().parts(coordinate_rows(&self.mechanism, &self.configuration))
    }
}
