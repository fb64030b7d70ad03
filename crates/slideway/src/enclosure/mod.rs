//! Rigorous bounds of a mechanism's influence coefficients, so that proofs speak of the mechanism itself.
//!
//! The other stages compute with rounded numbers. This one repeats what they did in interval arithmetic: the
//! formulas of the model (a number such as 0.1 is the decimal that is written), the positions on the joints
//! by an interval Newton operator around the computed ones, the velocities and the kinetic equations by
//! verified linear solutions. What it returns holds for the exact mechanism that the model file describes,
//! and for every value of parameters that are only known within bounds, in the one configuration near the
//! computed one that has the coordinates of the model.
//!
//! ```
//! use slideway::configuration::Configuration;
//! use slideway::enclosure::{UncertainParameters, enclosure};
//! use slideway::interval::Interval;
//! use slideway::mechanism::Mechanism;
//! use slideway::model::Model;
//! use slideway::modes::ContactState::{Negative, Positive};
//! use slideway::modes::certificate::{Decision, decide};
//!
//! let model = Model::parse(slideway::gallery::find("klepp-2002").expect("in the gallery").text)?;
//! let mechanism = Mechanism::new(&model)?;
//! let configuration = Configuration::new(&mechanism)?;
//! let range = Interval::new(0.5, 0.51).expect("bounds in order");
//! let uncertain = UncertainParameters::default().with("mu_1", range);
//! let enclosed = enclosure(&model, &uncertain, &mechanism, &configuration)?;
//! // This solution persists for all friction coefficients from 0.5 to 0.51.
//! let decision = decide(&enclosed.problem, &[Positive, Negative, Positive]).decision;
//! assert!(matches!(decision, Decision::Solution { .. }));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod coefficients;
mod motion;
mod outputs;

pub use outputs::{EnclosedOutputs, Tipping};

use crate::configuration::Configuration;
use crate::fault::{Faults, nearest};
use crate::ids::JointId;
use crate::interval::Interval;
use crate::kinetics::Assembled;
use crate::mechanism::{Coordinate, FrictionCircle, Mechanism};
use crate::model::Model;
use crate::modes::blocks::BlockProblem;
use crate::modes::certificate::{
    IntervalMatrix, IntervalModeProblem, IntervalModeProblemError, enclose_solution_while,
};
use crate::modes::{InfluenceCoefficients, OpenContacts};
use crate::problem::{TurningHinge, with_circles};
use crate::progress::{Callback, Progress, Work, undisturbed, watched};
use coefficients::Coefficients;
use nalgebra::DMatrix;

/// Parameters of a model that are known only within bounds (SI units). Each formula that uses one is
/// evaluated for the whole range; the formula of the parameter itself does not count.
///
/// Every parameter may be uncertain, those that change positions, too, as long as the joints hold for the
/// whole range. So may the values of coordinates, and a factor of all coefficients of friction.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct UncertainParameters {
    entries: Vec<(String, Interval)>,
    coordinates: Vec<(String, Interval)>,
    friction: Option<Interval>,
}

impl UncertainParameters {
    /// Adds the bounds of a parameter; later ones replace earlier ones.
    #[must_use]
    pub fn with(mut self, name: &str, bounds: Interval) -> Self {
        self.entries.retain(|(other, _)| other != name);
        self.entries.push((name.to_owned(), bounds));
        self
    }

    /// Adds the bounds of the value of a coordinate (m or rad).
    #[must_use]
    pub fn with_coordinate(mut self, name: &str, bounds: Interval) -> Self {
        self.coordinates.push((name.to_owned(), bounds));
        self
    }

    /// Sets the bounds of a factor by which all coefficients of friction are multiplied.
    #[must_use]
    pub fn with_friction(mut self, factor: Interval) -> Self {
        self.friction = Some(factor);
        self
    }

    /// Whether everything has the values of the model.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty() && self.coordinates.is_empty() && self.friction.is_none()
    }

    /// Whether each is one number: then bounds of what follows from them are as wide as rounding makes them.
    fn are_numbers(&self) -> bool {
        let bounds =
            self.entries.iter().chain(&self.coordinates).map(|(_, bounds)| bounds).chain(&self.friction);
        bounds.into_iter().all(|bounds| bounds.lower() == bounds.upper())
    }

    /// Puts the bounds of coordinates into a mechanism.
    fn put_coordinates(&self, mechanism: &mut Mechanism<Interval>) -> Result<(), NotEnclosed> {
        for (name, bounds) in &self.coordinates {
            let known = |coordinate: &&mut Coordinate<Interval>| *coordinate.name == **name;
            let coordinate = mechanism.coordinates.iter_mut().find(known);
            coordinate.ok_or_else(|| NotEnclosed::UnknownCoordinate { name: name.clone() })?.value = *bounds;
        }
        let unbounded = self.coordinates.iter().find(|(_, bounds)| !bounds.magnitude().is_finite());
        match unbounded {
            Some((name, _)) => Err(NotEnclosed::Unbounded { name: name.clone() }),
            None => Ok(()),
        }
    }

    /// Puts friction at the sliding speeds of a configuration into a mechanism, and the bounds of its factor.
    fn put_friction(
        &self,
        mechanism: &mut Mechanism<Interval>,
        configuration: &Configuration<Interval>,
    ) -> Result<(), NotEnclosed> {
        if let Some(factor) = self.friction {
            mechanism.multiply_friction(factor);
        }
        configuration.put_friction(mechanism).map_err(NotEnclosed::Values)
    }

    /// The bounds by the number of the parameter.
    fn of(&self, model: &Model) -> Result<Vec<(usize, Interval)>, NotEnclosed> {
        let number = |(name, bounds): &(String, Interval)| {
            let known = || model.parameters.iter().map(|parameter| &*parameter.name);
            let index = known().position(|other| other == name).ok_or_else(|| {
                NotEnclosed::UnknownParameter { name: name.clone(), nearest: nearest(name, known()) }
            })?;
            if bounds.magnitude().is_finite() {
                Ok((index, *bounds))
            } else {
                Err(NotEnclosed::Unbounded { name: name.clone() })
            }
        };
        self.entries.iter().map(number).collect()
    }
}

/// Bounds of the problem of an exact mechanism, or of one with uncertain parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosed<P> {
    /// Bounds of the influence coefficients, and of what follows from the forces.
    pub outputs: EnclosedOutputs,
    /// The problem with these numbers, eq. (6). Where `d_k^+` and `d_k^-` are equal by theory both are
    /// moved to the right-hand side, so that they do not look like a jump.
    pub problem: P,
    /// Which contacts may be open: others between their faces are in preload gaps.
    pub(crate) open: OpenContacts,
    /// The coefficients of its numbers.
    pub(crate) coefficients: InfluenceCoefficients<Interval>,
    /// The hinges that turn with friction.
    pub(crate) hinges: Vec<(TurningHinge, FrictionCircle<Interval>)>,
}

/// The mode problem of contacts, within bounds.
pub type EnclosedModeProblem = Enclosed<IntervalModeProblem>;

/// The block mode problem of contacts and hinges that turn, within bounds.
pub(crate) type EnclosedBlockProblem = Enclosed<BlockProblem>;

/// Why the numbers of a mechanism could not be enclosed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotEnclosed {
    /// Bounds are stated for a parameter that the model does not have.
    #[error("there is no parameter `{name}`{}", nearest.as_ref().map_or(String::new(), |name| format!("; did you mean `{name}`?")))]
    UnknownParameter {
        /// The name.
        name: String,
        /// The name most like it.
        nearest: Option<String>,
    },
    /// Bounds are stated for a coordinate that the model does not have.
    #[error("there is no coordinate `{name}`")]
    UnknownCoordinate {
        /// The name.
        name: String,
    },
    /// A parameter or coordinate has an infinite bound.
    #[error("the bounds of {name} are not finite")]
    Unbounded {
        /// The parameter.
        name: String,
    },
    /// A formula or load has no value, or one that is not allowed, for some of the numbers within bounds.
    #[error("within the bounds of the parameters and of rounding: {0}")]
    Values(Faults),
    /// No neighbourhood of the computed positions was proven to hold exactly one solution of the joint
    /// equations.
    #[error(
        "the positions could not be enclosed: the joint equations are too near to a singular position, or the parameters too uncertain"
    )]
    Positions,
    /// The equations of the velocities were not proven to be regular.
    #[error(
        "the velocities could not be enclosed: the joint equations are too near to a singular position, or the parameters too uncertain"
    )]
    Velocities,
    /// The kinetic equations were not proven to be regular.
    #[error(
        "the kinetic equations could not be enclosed: they are too ill-conditioned, or the parameters too uncertain"
    )]
    Equations,
    /// The direction in which a contact slides is not certain.
    #[error(
        "the direction in which {contact} slides is not certain: its sliding velocity is from {:e} to {:e} m/s",
        velocity.lower(), velocity.upper()
    )]
    SlidingDirection {
        /// The contact.
        contact: String,
        /// Bounds of its sliding velocity (m/s).
        velocity: Interval,
    },
    /// The sense in which a hinge turns is not certain.
    #[error(
        "the sense in which {hinge} turns is not certain: its angular velocity is from {:e} to {:e} rad/s",
        spin.lower(), spin.upper()
    )]
    SenseOfRotation {
        /// The hinge.
        hinge: String,
        /// Bounds of the angular velocity of its first body against the second (rad/s).
        spin: Interval,
    },
    /// A number of the mode problem has no finite bounds.
    #[error("the mode problem could not be enclosed: {0}")]
    Problem(#[from] IntervalModeProblemError),
    /// The work was ended before.
    #[error("the work was ended before the equations were enclosed")]
    Ended,
}

/// What is told while equations are enclosed.
const BEFORE_SEARCH: Progress = Progress { counted: "nodes", done: 0, fraction: None, found: None };

/// Bounds of the mode problem of the mechanism that `model` describes, for all values of the parameters in
/// `uncertain`.
///
/// `mechanism` and `configuration` are what the earlier stages made of the same model. The configuration
/// meant is the one near `configuration` in which the coordinates have the values of the model; that there is
/// exactly one for each value of the parameters is proven. Units are those of the model (N).
///
/// # Errors
/// [`NotEnclosed`] if it could not be proven; nothing is known then.
pub fn enclosure(
    model: &Model,
    uncertain: &UncertainParameters,
    mechanism: &Mechanism,
    configuration: &Configuration,
) -> Result<EnclosedModeProblem, NotEnclosed> {
    undisturbed(|work| enclosure_within(model, uncertain, (mechanism, configuration), work))
}

/// What is enclosed before a search, unless a callback breaks meanwhile.
///
/// # Errors
/// Those of the enclosure; [`NotEnclosed::Ended`].
pub(crate) fn enclosed_while<T>(
    progress: &mut Callback<'_>,
    enclose: impl FnOnce(Work<'_>) -> Result<T, NotEnclosed>,
) -> Result<T, NotEnclosed> {
    watched(&mut |_| progress(&BEFORE_SEARCH), enclose)?.ok_or(NotEnclosed::Ended)
}

/// [`enclosure`] as long as the work goes on.
///
/// # Errors
/// As [`enclosure`]; any once the work is to end.
pub(crate) fn enclosure_within(
    model: &Model,
    uncertain: &UncertainParameters,
    state: (&Mechanism, &Configuration),
    work: Work<'_>,
) -> Result<EnclosedModeProblem, NotEnclosed> {
    enclosed(model, uncertain, state, &[], work, |coefficients| {
        Ok(IntervalModeProblem::from_influence(coefficients)?)
    })
}

/// Bounds of the block mode problem of the mechanism that `model` describes, for all values of the parameters
/// in `uncertain`; `hinges` are those with friction, with the sense in which they turn.
///
/// # Errors
/// As [`enclosure`]; any once the work is to end.
pub(crate) fn enclosed_block_problem(
    model: &Model,
    uncertain: &UncertainParameters,
    state: (&Mechanism, &Configuration),
    hinges: &[TurningHinge],
    work: Work<'_>,
) -> Result<EnclosedBlockProblem, NotEnclosed> {
    enclosed(model, uncertain, state, hinges, work, |coefficients| {
        coefficients.numbers().problem().ok_or(NotEnclosed::Equations)
    })
}

/// Bounds of the coefficients of a mechanism of which these joints do not slide, with their accelerations of sliding as further rows,
/// and what is made of them.
///
/// # Errors
/// As [`enclosure`]; any once the work is to end.
pub(crate) fn enclosed_at_rest<P>(
    model: &Model,
    uncertain: &UncertainParameters,
    state: (&Mechanism, &Configuration),
    joints: &[JointId],
    work: Work<'_>,
    make: impl FnOnce(&InfluenceCoefficients<Interval>, &Mechanism<Interval>) -> Result<P, NotEnclosed>,
) -> Result<P, NotEnclosed> {
    within(model, uncertain, (state, joints), work, |within| {
        let unknowns = within.unknowns(work).ok_or(NotEnclosed::Equations)?;
        make(&within.problem_at_rest(&unknowns)?, within.mechanism)
    })
}

/// The problem that is made of coefficients within intervals, with what follows from its solutions.
fn enclosed<P>(
    model: &Model,
    uncertain: &UncertainParameters,
    state: (&Mechanism, &Configuration),
    hinges: &[TurningHinge],
    work: Work<'_>,
    make: impl FnOnce(&InfluenceCoefficients<Interval>) -> Result<P, NotEnclosed>,
) -> Result<Enclosed<P>, NotEnclosed> {
    within(model, uncertain, (state, &[]), work, |within| {
        let rubbing = within.rubbing(hinges)?;
        let unknowns = within.unknowns(work).ok_or(NotEnclosed::Equations)?;
        let (coefficients, outputs) = within.problem(&unknowns, hinges, &rubbing)?;
        let hinges = with_circles(hinges, within.mechanism);
        let open = within.mechanism.excess.open.clone();
        Ok(Enclosed { problem: make(&coefficients)?, outputs, open, coefficients, hinges })
    })
}

/// What is made of a mechanism in its configuration within intervals, of which these joints do not slide.
fn within<R>(
    model: &Model,
    uncertain: &UncertainParameters,
    ((mechanism, configuration), at_rest): ((&Mechanism, &Configuration), &[JointId]),
    work: Work<'_>,
    make: impl FnOnce(&Coefficients<'_>) -> Result<R, NotEnclosed>,
) -> Result<R, NotEnclosed> {
    let given = uncertain.of(model)?;
    let mut mechanism = Mechanism::enclosing(mechanism, model, &given).map_err(NotEnclosed::Values)?;
    uncertain.put_coordinates(&mut mechanism)?;
    let configuration = motion::enclosed(&mechanism, configuration, work)?;
    uncertain.put_friction(&mut mechanism, &configuration)?;
    let equations = Assembled::new(&mechanism, &configuration).map_err(NotEnclosed::Values)?;
    make(&Coefficients {
        model,
        mechanism: &mechanism,
        configuration: &configuration,
        equations: &equations,
        are_numbers: uncertain.are_numbers(),
        at_rest,
    })
}

/// Bounds of the solutions of a linear system; none if it is not proven to be regular, or once the work is to end.
fn solution(
    matrix: &DMatrix<Interval>,
    right_hand_side: &DMatrix<Interval>,
    work: Work<'_>,
) -> Option<IntervalMatrix> {
    let matrix = IntervalMatrix::from_intervals(matrix)?;
    let right_hand_side = IntervalMatrix::from_intervals(right_hand_side)?;
    let mut proceed = || !work.is_over();
    Some(enclose_solution_while(&matrix, &right_hand_side, &mut proceed)?.solution)
}
