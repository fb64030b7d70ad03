//! What a simulation is asked for, and what it may cost.

use crate::choice::Choice;
use crate::configuration::Configuration;
use crate::expression::Expression;
use crate::fault::{Fault, FaultKind, Faults};
use crate::mechanism::{Mechanism, Quantity};
use crate::model::CrossingDirection;
use serde::Serialize;

/// What a simulation is asked for, and what it may cost.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SimulateOptions {
    /// How long the mechanism is followed (s).
    pub duration: f64,
    /// Relative error of each step: of positions against the size of the mechanism, of velocities against the
    /// greatest.
    pub tolerance: f64,
    /// The longest step (s); a thousandth of the duration if nothing is given. What passes zero and returns
    /// within a third of a step is found where the cubic through four values in the step shows it. Steps are
    /// shorter where loads or drives change faster than that by themselves, and the rest of bodies that stand
    /// still is proven whatever the steps are.
    pub longest_step: Option<f64>,
    /// Steps after which the simulation ends.
    pub most_steps: usize,
    /// Events after which the simulation ends.
    pub most_events: usize,
    /// Normal force (N) from which on the mechanism counts as locked.
    pub reaction_limit: Option<f64>,
    /// Functions of coordinates, rates and time that are watched; the events of a model are among them if
    /// [`SimulateOptions::with_events_of`] adds them.
    pub events: Vec<UserEvent>,
    /// The phase to begin with, as its [pattern](super::Phase::pattern).
    pub initial: Option<String>,
    /// Which of the possible phases is taken at each branching, in their order, counted from 0; the first
    /// where the list ends. A branching is an event after which several phases are possible.
    pub branches: Vec<usize>,
    /// Whether at a branching behind the list the phase is taken in which the fewest joints stick, instead of
    /// the first: what could wedge itself at rest then slides on as long as it can.
    pub prefers_sliding: bool,
    /// The law of friction in impacts on faces.
    pub impacts: ImpactLaw,
}

/// The law of friction in impacts on faces.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ImpactLaw {
    /// It opposes the slip at each moment of the course of the impact (E. J. Routh, Dynamics of a System of Rigid
    /// Bodies, Elementary Part, chapter IV).
    #[default]
    Course,
    /// It opposes the slip after the impact (J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, 1988).
    Moreau,
}

impl Choice for ImpactLaw {
    const CHOICES: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Course, "course", "Friction opposes the slip at each moment of the impact"),
        (
            Self::Moreau,
            "moreau",
            "Friction opposes the slip after the impact, as Siconos and much of the literature have it",
        ),
    ];
}

impl SimulateOptions {
    /// The defaults for a duration: tolerance 1e-8, at most 1 000 000 steps and 100 000 events.
    pub fn new(duration: f64) -> Self {
        Self {
            duration,
            tolerance: 1e-8,
            longest_step: None,
            most_steps: 1_000_000,
            most_events: 100_000,
            reaction_limit: None,
            events: Vec::new(),
            initial: None,
            branches: Vec::new(),
            prefers_sliding: false,
            impacts: ImpactLaw::default(),
        }
    }

    /// With another relative error of each step.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// With steps that are no longer than this (s).
    #[must_use]
    pub fn longest_step(mut self, step: impl Into<Option<f64>>) -> Self {
        self.longest_step = step.into();
        self
    }

    /// Ends after so many steps.
    #[must_use]
    pub fn most_steps(mut self, steps: usize) -> Self {
        self.most_steps = steps;
        self
    }

    /// Ends after so many events.
    #[must_use]
    pub fn most_events(mut self, events: usize) -> Self {
        self.most_events = events;
        self
    }

    /// Counts the mechanism as locked from this normal force (N) on.
    #[must_use]
    pub fn reaction_limit(mut self, force: impl Into<Option<f64>>) -> Self {
        self.reaction_limit = force.into();
        self
    }

    /// Begins in the phase of this [pattern](super::Phase::pattern).
    #[must_use]
    pub fn initial(mut self, pattern: &str) -> Self {
        self.initial = Some(pattern.to_owned());
        self
    }

    /// The same, after what a person types: blanks between the signs do not count.
    ///
    /// # Errors
    /// If there is not one of "+", "-", "0" and "=" for each contact, then for each hinge with friction.
    pub fn initial_of(self, typed: &str, mechanism: &Mechanism) -> Result<Self, Faults> {
        let pattern: String = typed.chars().filter(|sign| !sign.is_whitespace()).collect();
        let contacts = mechanism.contacts.iter().map(|contact| contact.name.to_string());
        let hinges = mechanism.friction_circles.iter().enumerate().filter(|(_, circle)| circle.is_rough());
        let hinges = hinges.map(|(circle, _)| mechanism.circle_name(circle));
        let names: Vec<String> = contacts.chain(hinges).collect();
        if pattern.len() == names.len() && pattern.chars().all(|sign| "+-0=".contains(sign)) {
            return Ok(self.initial(&pattern));
        }
        Err(Fault::general(FaultKind::MalformedMode { text: typed.to_owned(), contacts: names }).into())
    }

    /// Takes these phases at the branchings, counted from 0.
    #[must_use]
    pub fn branches(mut self, branches: impl IntoIterator<Item = usize>) -> Self {
        self.branches = branches.into_iter().collect();
        self
    }

    /// Whether at a branching behind those that are given the phase is taken in which the fewest joints
    /// stick.
    #[must_use]
    pub fn prefers_sliding(mut self, prefers: bool) -> Self {
        self.prefers_sliding = prefers;
        self
    }

    /// With another law of impacts on faces.
    #[must_use]
    pub fn impacts(mut self, law: ImpactLaw) -> Self {
        self.impacts = law;
        self
    }

    /// Watches a function, too.
    #[must_use]
    pub fn event(mut self, event: UserEvent) -> Self {
        self.events.push(event);
        self
    }

    /// With the events of a model.
    #[must_use]
    pub fn with_events_of(mut self, mechanism: &Mechanism) -> Self {
        self.events.extend(mechanism.events.iter().map(|event| UserEvent {
            name: event.name.to_string(),
            function: EventFunction::OfModel(event.zero_of),
            crossing: match event.direction {
                CrossingDirection::Rising => Crossing::Rising,
                CrossingDirection::Falling => Crossing::Falling,
                CrossingDirection::Both => Crossing::Any,
            },
            ends: event.stops,
        }));
        self
    }
}

/// In which direction a function of the user passes zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Crossing {
    /// Either.
    #[default]
    Any,
    /// From below.
    Rising,
    /// From above.
    Falling,
}

/// A function of coordinates, rates and time whose zeros are events.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct UserEvent {
    /// Its name.
    pub name: String,
    /// The function.
    pub function: EventFunction,
    /// Which zeros count.
    pub crossing: Crossing,
    /// Whether the simulation ends there.
    pub ends: bool,
}

/// What is watched for zeros.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum EventFunction {
    /// A quantity of the mechanism.
    OfModel(Quantity),
    /// An expression of its own.
    Expression(Expression),
}

impl UserEvent {
    /// Every zero of a function; the simulation goes on.
    pub fn new(name: &str, function: EventFunction) -> Self {
        Self { name: name.to_owned(), function, crossing: Crossing::Any, ends: false }
    }

    /// Only zeros in this direction.
    #[must_use]
    pub fn crossing(mut self, crossing: Crossing) -> Self {
        self.crossing = crossing;
        self
    }

    /// Whether the simulation ends there.
    #[must_use]
    pub fn ends(mut self, ends: bool) -> Self {
        self.ends = ends;
        self
    }

    pub(super) fn value(&self, mechanism: &Mechanism, configuration: &Configuration) -> Result<f64, Fault> {
        let Configuration { coordinates, rates, time, .. } = configuration;
        match &self.function {
            EventFunction::OfModel(quantity) => mechanism.quantity(*quantity, coordinates, rates, *time),
            EventFunction::Expression(expression) => expression
                .evaluate(&mechanism.values(coordinates, rates, *time))
                .map_err(|fault| Fault::general(FaultKind::Expression(fault.kind))),
        }
    }
}
