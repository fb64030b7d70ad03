//! What is varied: a parameter, a coordinate, or all coefficients of friction together.

use crate::fault::{AxisProblem, Fault, FaultKind, Faults, nearest};
use crate::mechanism::Mechanism;
use crate::model::{Model, Setting, SettingKind, Settings};
use crate::solve::{Parts, Stages};

/// The name under which all coefficients of friction are scaled together.
pub const FRICTION: &str = "friction";

/// What is varied in a model.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Kind {
    /// The factor of all coefficients of friction.
    Friction,
    /// A parameter.
    Parameter,
    /// The value of a coordinate.
    Coordinate,
}

/// A model and what is varied in it.
pub(super) struct Varied {
    model: Model,
    pub(super) name: String,
    kind: Kind,
    /// The stages that a factor of friction leaves as they are.
    stages: Option<Stages>,
}

impl Varied {
    /// # Errors
    /// An unknown name; with a factor of friction whatever `solve` refuses.
    pub(super) fn new(model: &Model, name: &str) -> Result<Self, Faults> {
        let parameter = model.parameters.iter().any(|parameter| &*parameter.name == name);
        let coordinate = model.coordinates.iter().any(|coordinate| &*coordinate.name == name);
        let kind = match (parameter, coordinate, name) {
            (true, _, _) => Kind::Parameter,
            (_, true, _) => Kind::Coordinate,
            (_, _, FRICTION) => Kind::Friction,
            _ => return Err(unknown(model, name)),
        };
        let stages = if kind == Kind::Friction { Some(Stages::new(model)?) } else { None };
        Ok(Self { model: model.clone(), name: name.to_owned(), kind, stages })
    }

    /// Whether all coefficients of friction are scaled together.
    pub(super) fn is_friction_factor(&self) -> bool {
        self.kind == Kind::Friction
    }

    /// What it is, in words.
    pub(super) fn in_words(&self) -> String {
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
    pub(super) fn present(&self) -> Result<f64, Faults> {
        Ok(match self.kind {
            Kind::Friction => 1.0,
            Kind::Parameter => {
                let values = self.model.parameter_values(&self.model.constants()?);
                let index = self.model.parameters.iter().position(|parameter| *parameter.name == *self.name);
                index.map_or(0.0, |index| values[index])
            }
            Kind::Coordinate => {
                let mechanism = Mechanism::new(&self.model)?;
                let same = |coordinate: &&crate::mechanism::Coordinate| *coordinate.name == *self.name;
                mechanism.coordinates.iter().find(same).map_or(0.0, |coordinate| coordinate.value)
            }
        })
    }

    /// The value that a text stands for, in SI units.
    ///
    /// # Errors
    /// A text that is no quantity of the right dimension.
    pub(super) fn value_of(&self, text: &str) -> Result<f64, Faults> {
        let value = match self.kind {
            Kind::Friction => {
                return text.trim().parse().map_err(|_| {
                    let (text, name) = (text.to_owned(), self.name.clone());
                    Fault::general(FaultKind::MalformedRange { text, name }).into()
                });
            }
            Kind::Parameter => self.model.setting_value(&self.setting(SettingKind::Parameter, text)),
            Kind::Coordinate => self.model.setting_value(&self.setting(SettingKind::Position, text)),
        };
        // Its places are those of a setting, but the range is none.
        value.map_err(|faults| {
            let text = format!("{}={}", self.name, text.trim());
            Fault::general(FaultKind::Axis { text, problem: AxisProblem::of(&faults) }).into()
        })
    }

    fn setting(&self, kind: SettingKind, value: &str) -> Setting {
        Setting { kind, name: self.name.clone(), value: value.trim().to_owned() }
    }

    fn with(&self, value: &str) -> Result<Model, Faults> {
        let settings = Settings::default();
        self.model.with(&match self.kind {
            Kind::Friction => settings,
            Kind::Parameter => settings.parameter(&self.name, value),
            Kind::Coordinate => settings.position(&self.name, value),
        })
    }

    /// The mode problem at a value.
    ///
    /// # Errors
    /// Whatever `solve` refuses there.
    pub(super) fn parts(&self, value: f64) -> Result<Parts, Faults> {
        match &self.stages {
            Some(stages) => stages.parts(value),
            None => Stages::new(&self.with(&format!("{value:e}"))?)?.parts(1.0),
        }
    }
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
