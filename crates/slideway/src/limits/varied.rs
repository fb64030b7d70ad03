//! Varied quantity: a parameter, a coordinate, or all coefficients of friction together.

use crate::configuration::Follower;
use crate::enclosure::{EnclosedBlockProblem, UncertainParameters, enclosed_block_problem, enclosure_within};
use crate::expression::Degree;
use crate::fault::{AxisProblem, Fault, FaultKind, Faults, nearest};
use crate::interval::Interval;
use crate::kinetics::coordinate_rows;
use crate::mechanism::{Coordinate, Mechanism};
use crate::model::{Dependence, FRICTION, Model, Setting, SettingKind, Value};
use crate::modes::blocks::{self, BlockProblem, BlockResult, BlockSolution};
use crate::modes::branches::{Branch, BranchForces, Instance, NoInstance};
use crate::modes::existence::ModeProblemLine;
use crate::modes::{OpenContacts, search};
use crate::problem::TurningHinge;
use crate::progress::{Progress, Work};
use crate::report::{Proof, Solution, SolveReport};
use crate::solve::{
    Parts, SolveOptions, Stages, block_instance, certain_counts, check_none_stands, counted, solve_in,
    states_between_faces, turning_hinges, unknowns_of,
};
use crate::units::Unit;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Kind of quantity that is varied in a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// The factor of all coefficients of friction.
    Friction,
    /// A parameter.
    Parameter,
    /// The value of a coordinate.
    Coordinate,
}

/// A model and what is varied in it.
pub(crate) struct Varied {
    model: Model,
    pub(crate) name: String,
    /// The argument that says that it is varied: faults of its values lie there.
    argument: Arc<str>,
    kind: Kind,
    /// The unit in which its values are shown.
    pub(crate) shown_in: Unit,
    /// The stages that a factor of friction leaves as they are.
    stages: Option<Stages>,
    /// The positions at the last values.
    follower: Mutex<Follower>,
}

/// A quantity that can be varied.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its present value, with its unit.
    pub value: String,
}

/// The quantities of a model that [`Vary`](super::Vary) can name, with their present values: parameters and coordinates in the order
/// of the file, at last [`FRICTION`], the factor on all coefficients of friction.
///
/// ```
/// use slideway::{Model, gallery, limits};
///
/// let drawer = Model::parse(gallery::find("drawer").expect("in the gallery").text)?;
/// let all = limits::variables(&drawer)?;
/// assert_eq!((all[0].name.as_str(), all[0].value.as_str()), ("L", "0.4 m"));
/// assert_eq!(all.last().map(|last| last.name.as_str()), Some("friction"));
/// # Ok::<(), slideway::Faults>(())
/// ```
///
/// # Errors
/// Values of the model that are not allowed.
pub fn variables(model: &Model) -> Result<Vec<Variable>, Faults> {
    let parameters = model.parameters.iter().map(|parameter| &*parameter.name);
    let coordinates = model.coordinates.iter().map(|coordinate| &*coordinate.name);
    let one = |name: &str| {
        let varied = Varied::at_rest(model, name)?;
        Ok(Variable { name: name.to_owned(), value: varied.shown_in.show(varied.present()?) })
    };
    parameters.chain(coordinates).chain([FRICTION]).map(one).collect()
}

impl Varied {
    /// # Errors
    /// An unknown name; with a factor of friction whatever `solve` refuses.
    pub(crate) fn new(model: &Model, name: &str) -> Result<Self, Faults> {
        let mut varied = Self::at_rest(model, name)?;
        if varied.is_friction_factor() {
            varied.stages = Some(Stages::of_any_model(model)?);
        }
        Ok(varied)
    }

    /// Makes a varied model for questions of rest, which need no inertia.
    ///
    /// # Errors
    /// An unknown name.
    pub(crate) fn at_rest(model: &Model, name: &str) -> Result<Self, Faults> {
        let parameter = model.parameters.iter().any(|parameter| &*parameter.name == name);
        let coordinate = model.coordinates.iter().any(|coordinate| &*coordinate.name == name);
        let kind = match (parameter, coordinate, name) {
            (true, _, _) => Kind::Parameter,
            (_, true, _) => Kind::Coordinate,
            (_, _, FRICTION) => Kind::Friction,
            _ => return Err(unknown(model, name)),
        };
        let shown_in = match kind {
            Kind::Friction => Unit::default(),
            Kind::Parameter => model.units.parameter(name, &model.parameter_unit(name)),
            Kind::Coordinate => model.units.of(coordinate_unit(model, name)),
        };
        let (argument, follower) = (Arc::from(name), Mutex::default());
        Ok(Self {
            model: model.clone(),
            name: name.to_owned(),
            argument,
            kind,
            shown_in,
            stages: None,
            follower,
        })
    }

    /// Returns the varied model with faults that lie in this argument.
    pub(super) fn given_by(self, argument: &str) -> Self {
        Self { argument: Arc::from(argument), ..self }
    }

    /// Shows values in the unit of both ends of a range as they were typed, if they have one.
    pub(crate) fn typed_as(mut self, range: Option<&[Value; 2]>) -> Self {
        let unit = range.and_then(|[from, to]| from.unit().filter(|unit| to.unit().as_ref() == Some(unit)));
        if let Some(unit) = unit {
            self.shown_in = self.model.units.typed_as(unit);
        }
        self
    }

    /// Whether all coefficients of friction are scaled together.
    pub(crate) fn is_friction_factor(&self) -> bool {
        self.kind == Kind::Friction
    }

    /// Whether it is a coefficient of friction itself, not something from which one is computed.
    pub(crate) fn is_itself_friction(&self) -> bool {
        self.kind == Kind::Parameter && self.model.is_itself_friction(&self.name)
    }

    /// Returns its name with its kind: "the parameter mu".
    pub(crate) fn in_words(&self) -> String {
        match self.kind {
            Kind::Friction => "the factor of all coefficients of friction".to_owned(),
            Kind::Parameter => format!("the parameter {}", self.name),
            Kind::Coordinate => format!("the coordinate {}", self.name),
        }
    }

    /// The present value.
    ///
    /// # Errors
    /// Values of the model that are not allowed.
    pub(crate) fn present(&self) -> Result<f64, Faults> {
        Ok(match self.kind {
            Kind::Friction => 1.0,
            Kind::Parameter => {
                let values = self.model.parameter_values(&self.model.constants()?);
                let index = self.model.parameters.iter().position(|parameter| *parameter.name == *self.name);
                index.map_or(0.0, |index| values[index])
            }
            Kind::Coordinate => {
                let mechanism = Mechanism::new(&self.model)?;
                let same = |coordinate: &&Coordinate| *coordinate.name == *self.name;
                mechanism.coordinates.iter().find(same).map_or(0.0, |coordinate| coordinate.value)
            }
        })
    }

    /// A value in SI units.
    ///
    /// # Errors
    /// A text that is no quantity of the right dimension; the places are those of a setting.
    pub(crate) fn value_of(&self, value: &Value) -> Result<f64, Faults> {
        let kind = match self.kind {
            Kind::Friction => return self.factor(value),
            Kind::Parameter => SettingKind::Parameter,
            Kind::Coordinate => SettingKind::Position,
        };
        self.model.setting_value(&Setting::new(kind, &self.name, value.clone()))
    }

    /// A factor of friction: a plain number, not below zero.
    fn factor(&self, value: &Value) -> Result<f64, Faults> {
        let fault =
            |problem| Fault::general(FaultKind::Axis { text: format!("{}={value}", self.name), problem });
        match value.plain_number() {
            Some(value) if value < 0.0 => Err(fault(AxisProblem::NegativeFriction { value }).into()),
            Some(value) if value.is_finite() => Ok(value),
            Some(_) => {
                let message = format!("`{value}` is not finite");
                Err(fault(AxisProblem::Value { message, hint: None }).into())
            }
            None => {
                let (text, name) = (value.to_string(), self.name.clone());
                Err(Fault::general(FaultKind::MalformedRange { text, name }).into())
            }
        }
    }

    /// How the mode problem depends on it, decided from the model.
    pub(crate) fn dependence(&self) -> Dependence {
        let index = self.model.parameters.iter().position(|parameter| *parameter.name == *self.name);
        match (self.kind, index) {
            (Kind::Parameter, Some(index)) => self.model.dependence(index),
            (kind, _) => Dependence {
                problem: if kind == Kind::Friction { Degree::Affine } else { Degree::Other },
                conditions: Degree::Constant,
                at_rest: false,
            },
        }
    }

    /// The numbers of solutions and of preload-gap states that are proven for all values between two, if they
    /// are, and what that took: nodes of the search, which ends with the work. States with a normal force
    /// above `greatest` do not count. Beside friction in the hinges of these circles nothing is proven of guided sliders,
    /// which may tip.
    pub(crate) fn certain_counts(
        &self,
        (bounds, circles): ([f64; 2], &[usize]),
        greatest: Option<f64>,
        options: &SolveOptions,
        work: Work<'_>,
    ) -> (Option<[usize; 2]>, u64) {
        let mut goes_on = |_: &Progress| work.flow();
        if circles.is_empty() {
            let enclosed = self.enclosed(bounds, |model, uncertain, stages| {
                enclosure_within(model, uncertain, (&stages.mechanism, &stages.configuration), work).ok()
            });
            let Some(enclosed) = enclosed else { return (None, 1) };
            let result = search(&enclosed.problem, &options.search, &mut goes_on);
            return (certain_counts(&enclosed, &result, options, greatest), result.nodes());
        }
        if self.model.has_guided_sliders() {
            return (None, 1);
        }
        let enclosed = self.enclosed(bounds, |model, uncertain, stages| {
            let hinges = turning_hinges(stages, circles).ok()?;
            let state = (&stages.mechanism, &stages.configuration);
            enclosed_block_problem(model, uncertain, state, &hinges, work).ok()
        });
        let Some(EnclosedBlockProblem { problem, open, .. }) = enclosed else { return (None, 1) };
        let unique = blocks::unique_for_every_load(&problem);
        if greatest.is_none() && unique.is_some() {
            return (Some([1, 0]), 1);
        }
        let result = blocks::search_all_or_nothing(&problem, unique, &options.search, &mut goes_on);
        (certain_block_counts((&problem, &open), &result, greatest), result.nodes)
    }

    /// Evaluates `question` on the model, the bounds of what is varied, and the stages in the middle of them.
    /// Returns `None` if there are no such stages.
    fn enclosed<R>(
        &self,
        [from, to]: [f64; 2],
        question: impl Fn(&Model, &UncertainParameters, &Stages) -> Option<R>,
    ) -> Option<R> {
        let bounds = Interval::new(from, to)?;
        let uncertain = UncertainParameters::default();
        if let Some(stages) = &self.stages {
            stages.check_moving().ok()?;
            return question(&self.model, &uncertain.with_friction(bounds), stages);
        }
        let model = self.model_at(bounds.middle()).ok()?;
        let uncertain = match self.kind {
            Kind::Coordinate => uncertain.with_coordinate(&self.name, bounds),
            _ => uncertain.with(&self.name, bounds),
        };
        let stages = Stages::following(&mut self.follower(), Mechanism::new(&model).ok()?).ok()?;
        question(&model, &uncertain, &stages)
    }

    /// The friction circles that have an extent somewhere in a range, as far as a few values show it.
    pub(crate) fn rough_circles(&self, [from, to]: [f64; 2]) -> Vec<usize> {
        let present = self.present().ok().filter(|value| (from..=to).contains(value));
        let values = [from, f64::midpoint(from, to), to].into_iter().chain(present);
        let rough = |value: f64| -> Option<Vec<usize>> {
            let mechanism = Mechanism::new(&self.model_at(value).ok()?).ok()?;
            Some(mechanism.rough_hinges().map(|(circle, _)| circle).collect())
        };
        let mut circles: Vec<usize> = values.filter_map(rough).flatten().collect();
        circles.sort_unstable();
        circles.dedup();
        circles
    }

    /// Whether the friction circles of hinges alone depend on it.
    pub(crate) fn varies_friction_circles(&self) -> bool {
        let index = self.model.parameters.iter().position(|parameter| *parameter.name == *self.name);
        self.kind == Kind::Parameter && index.is_some_and(|index| self.model.varies_friction_circles(index))
    }

    /// The radius of a friction circle at a value; none if the model does not allow it.
    pub(crate) fn friction_radius(&self, value: f64, circle: usize) -> Option<f64> {
        Some(Mechanism::new(&self.model_at(value).ok()?).ok()?.friction_circles[circle].radius)
    }

    /// The block problem at a value, with friction in the hinges of these circles.
    ///
    /// # Errors
    /// Whatever `solve` refuses there.
    pub(crate) fn block_instance(&self, value: f64, circles: &[usize]) -> Result<Instance, Faults> {
        self.with_hinges(value, circles, block_instance)
    }

    /// Evaluates `question` on the stages at a value, and on the hinges of these friction circles.
    ///
    /// # Errors
    /// Whatever `solve` refuses there, and those of the question.
    pub(crate) fn with_hinges<R>(
        &self,
        value: f64,
        circles: &[usize],
        question: impl Fn(&Stages, &[TurningHinge]) -> Result<R, Faults>,
    ) -> Result<R, Faults> {
        self.at(value, |stages| question(stages, &turning_hinges(stages, circles)?))
    }

    /// The forces of a branch at a value; none if they are not found.
    pub(crate) fn branch_forces(
        &self,
        value: f64,
        circles: &[usize],
        branch: &Branch,
    ) -> Option<BranchForces> {
        branch.solution(value, &|at| self.block_instance(at, circles).map_err(|_| NoInstance::Other))
    }

    /// The accelerations of the coordinates along a branch.
    pub(crate) fn branch_accelerations(
        &self,
        value: f64,
        circles: &[usize],
        branch: &Branch,
    ) -> Option<Vec<f64>> {
        let forces = self.branch_forces(value, circles, branch)?;
        let accelerations = |stages: &Stages, hinges: &[TurningHinge]| {
            let unknowns = unknowns_of(stages, hinges, (&branch.states, &forces));
            let rows = coordinate_rows(&stages.mechanism, &stages.configuration);
            Ok(rows.iter().map(|row| row.times(&unknowns) - row.right_hand_side).collect())
        };
        self.with_hinges(value, circles, accelerations).ok()
    }

    /// The states with a guided slider between its faces that `solve` finds at a value and with so many times
    /// the friction, and no sign pattern tells; none where there is no mode problem, and when the work is to
    /// end. States with a normal force above `greatest` do not count.
    pub(crate) fn states_between_faces(
        &self,
        value: f64,
        rougher: f64,
        greatest: Option<f64>,
        work: Work<'_>,
    ) -> Vec<Solution> {
        if work.is_over() || !self.model.has_guided_sliders() {
            return Vec::new();
        }
        let options = SolveOptions::default();
        let Ok(model) = self.model_at(value).map(|model| model.with_friction(rougher)) else {
            return Vec::new();
        };
        let found = self.at(value, |stages| {
            let mut goes_on = |_: &Progress| work.flow();
            states_between_faces(&model, &stages.with_friction(rougher), greatest, &options, &mut goes_on)
        });
        found.unwrap_or_default()
    }

    /// The certified solutions at a value.
    ///
    /// # Errors
    /// Whatever `solve` refuses there.
    pub(crate) fn solved(&self, value: f64, work: Work<'_>) -> Result<SolveReport, Faults> {
        let model = self.model_at(value)?;
        let options = SolveOptions::default();
        self.at_any(value, |stages| {
            let mut goes_on = |_: &Progress| work.flow();
            solve_in(&model, stages, &options, &mut goes_on)
        })
    }

    /// The fault that it needs a range.
    pub(crate) fn range_needed(&self) -> Faults {
        let kind = FaultKind::RangeNeeded { what: self.in_words(), name: self.name.clone() };
        Fault::general(kind).into()
    }

    fn follower(&self) -> MutexGuard<'_, Follower> {
        self.follower.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The unit in which the model has it, or things of its kind, if it was typed.
    pub(crate) fn typed_unit(&self) -> Option<Unit> {
        match self.kind {
            Kind::Friction => None,
            Kind::Parameter => self.model.units.typed_parameter(&self.name).cloned(),
            Kind::Coordinate => self.model.units.typed(coordinate_unit(&self.model, &self.name)),
        }
    }

    /// Whether it is an angle, which a parameter is by the unit in which it was typed.
    pub(crate) fn is_angle(&self) -> bool {
        self.typed_unit().is_some_and(|unit| unit.si() == "rad")
    }

    /// The SI unit, empty for pure numbers.
    pub(crate) fn unit(&self) -> String {
        match self.kind {
            Kind::Friction => String::new(),
            Kind::Parameter => self.model.parameter_unit(&self.name),
            Kind::Coordinate => coordinate_unit(&self.model, &self.name).to_owned(),
        }
    }

    /// The setting that gives it this value, and the argument in which its faults lie; none for a factor of
    /// friction, which is no setting.
    pub(crate) fn setting(&self, value: f64) -> Option<(Setting, Arc<str>)> {
        let kind = match self.kind {
            Kind::Friction => return None,
            Kind::Parameter => SettingKind::Parameter,
            Kind::Coordinate => SettingKind::Position,
        };
        Some((Setting::new(kind, &self.name, value), self.argument.clone()))
    }

    /// The model at a value.
    ///
    /// # Errors
    /// A value that the model does not allow.
    pub(crate) fn model_at(&self, value: f64) -> Result<Model, Faults> {
        match self.setting(value) {
            None => Ok(self.model.clone().with_friction(value)),
            Some(setting) => self.model.varied_with(&[setting]),
        }
    }

    /// The mode problem at a value.
    ///
    /// # Errors
    /// Whatever `solve` refuses there.
    pub(crate) fn parts(&self, value: f64) -> Result<Parts, Faults> {
        self.at(value, Stages::parts)
    }

    /// Evaluates a question on the stages at a value.
    ///
    /// # Errors
    /// Whatever `solve` refuses there, contacts that stand still while the rest moves, and those of the question.
    pub(crate) fn at<R>(
        &self,
        value: f64,
        question: impl Fn(&Stages) -> Result<R, Faults>,
    ) -> Result<R, Faults> {
        self.at_any(value, |stages| {
            stages.check_moving()?;
            question(stages)
        })
    }

    /// Whether contacts stand still there while the rest moves.
    ///
    /// # Errors
    /// Whatever `solve` refuses there.
    pub(crate) fn stands(&self, value: f64) -> Result<bool, Faults> {
        self.at_any(value, |stages| Ok(!stages.standing.is_empty()))
    }

    /// Refuses contacts that stand still there while the rest moves, for what is not known of them.
    ///
    /// # Errors
    /// A fault that names them, if there are some.
    pub(crate) fn check_none_stands(&self, value: f64, question: &'static str) -> Result<(), Faults> {
        self.at_any(value, |stages| Ok(check_none_stands(stages, question))).unwrap_or(Ok(()))
    }

    /// [`Varied::at`], where contacts may stand still.
    ///
    /// # Errors
    /// Whatever `solve` refuses there, and those of the question.
    pub(crate) fn at_any<R>(
        &self,
        value: f64,
        question: impl Fn(&Stages) -> Result<R, Faults>,
    ) -> Result<R, Faults> {
        if let Some(stages) = &self.stages {
            return question(&stages.with_friction(value));
        }
        let mechanism = Mechanism::new(&self.model_at(value)?)?;
        question(&Stages::following_with_standing(&mut self.follower(), mechanism)?)
    }

    /// The line of mode problems from no friction (`t = 0`) to the friction at a value (`t = 1`).
    ///
    /// # Errors
    /// Whatever `solve` refuses there.
    pub(crate) fn growing_friction(&self, value: f64) -> Result<ModeProblemLine, Faults> {
        self.at(value, |stages| stages.data().growing_friction(&|_| true))
    }

    /// The mechanism at a value.
    ///
    /// # Errors
    /// A value that the model does not allow.
    pub(crate) fn mechanism(&self, value: f64) -> Result<Mechanism, Faults> {
        match &self.stages {
            Some(stages) => Ok(stages.mechanism.clone()),
            None => Mechanism::new(&self.model_at(value)?),
        }
    }

    /// The model in which it is varied.
    pub(crate) fn model(&self) -> &Model {
        &self.model
    }

    /// Whether it is the value of a coordinate.
    pub(crate) fn is_coordinate(&self) -> bool {
        self.kind == Kind::Coordinate
    }
}

/// The numbers of solutions and gap states that are proven for all problems within bounds, if they are; none where a
/// normal force may be above `greatest`, or may not.
fn certain_block_counts(
    (problem, open): (&BlockProblem, &OpenContacts),
    result: &BlockResult,
    greatest: Option<f64>,
) -> Option<[usize; 2]> {
    if result.complete != Proof::Proven {
        return None;
    }
    let state = |BlockSolution { states, on_boundary, enclosure, .. }: &BlockSolution| {
        let is_certain = !on_boundary.iter().any(|&contact| problem.has_jump(contact));
        is_certain.then(|| (states.clone(), enclosure.iter().map(|force| force.abs()).collect()))
    };
    counted(open, greatest, result.solutions.iter().map(state))
}

/// The mechanism of a model with these values of what is varied.
///
/// # Errors
/// Values that the model does not allow.
pub(crate) fn mechanism_with(model: &Model, values: &[(&Varied, f64)]) -> Result<Mechanism, Faults> {
    let number = |varied: &Varied| model.parameters.iter().position(|other| *other.name == *varied.name);
    let of_kind = |kind: Kind| values.iter().filter(move |(varied, _)| varied.kind == kind);
    let given = of_kind(Kind::Parameter).filter_map(|(varied, value)| Some((number(varied)?, *value)));
    let mut mechanism = Mechanism::with_parameters(model, &given.collect::<Vec<_>>())?;
    for (varied, value) in of_kind(Kind::Coordinate) {
        let same = |other: &&mut Coordinate| *other.name == *varied.name;
        mechanism.coordinates.iter_mut().filter(same).for_each(|coordinate| coordinate.value = *value);
    }
    for (_, factor) in of_kind(Kind::Friction) {
        mechanism.multiply_friction(*factor);
    }
    Ok(mechanism)
}

/// The SI unit of a coordinate.
fn coordinate_unit(model: &Model, name: &str) -> &'static str {
    let coordinate = model.coordinates.iter().find(|coordinate| *coordinate.name == *name);
    coordinate.map_or("", |coordinate| if coordinate.kind.is_angle() { "rad" } else { "m" })
}

fn unknown(model: &Model, name: &str) -> Faults {
    let parameters = model.parameters.iter().map(|parameter| &*parameter.name);
    let coordinates = model.coordinates.iter().map(|coordinate| &*coordinate.name);
    let known = parameters.chain(coordinates).chain([FRICTION]);
    let kind = FaultKind::UnknownName {
        what: "parameter or coordinate",
        name: name.to_owned(),
        nearest: nearest(name, known.clone()),
        known: known.map(str::to_owned).collect(),
    };
    Fault::general(kind).into()
}
