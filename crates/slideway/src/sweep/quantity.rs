//! Varied quantities: parameters, coordinates, rates, the time, all friction together.

use crate::fault::{AxisProblem, Fault, FaultKind, Faults, nearest};
use crate::limits::FRICTION;
use crate::model::{Model, Setting, SettingKind, Settings, Value};

/// Suffix of the name of a coordinate whose rate is meant.
const RATE: &str = ".rate";

/// The units that columns of parameters may have.
const UNITS: [&str; 14] = [
    "m",
    "rad",
    "kg",
    "s",
    "N",
    "N m",
    "m/s",
    "rad/s",
    "m/s^2",
    "kg m^2",
    "N/m",
    "N s/m",
    "N m/rad",
    "N m s/rad",
];
/// The name of the time of the state.
pub(super) const TIME: &str = "time";

/// Kind of varied quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A parameter, by its number.
    Parameter(usize),
    /// The value of a coordinate, by its number.
    Coordinate(usize),
    /// The rate of a coordinate.
    Rate(usize),
    /// The time of the state.
    Time,
    /// The factor of all coefficients of friction.
    Friction,
}

/// Something that is varied.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Quantity {
    /// Its name, as it was written.
    pub(super) name: String,
    pub(super) kind: Kind,
}

impl Quantity {
    /// The quantity of this name: a parameter, a coordinate, `coordinate.rate`, `friction`, `time`.
    ///
    /// # Errors
    /// An unknown name.
    pub(super) fn find(model: &Model, name: &str) -> Result<Self, Faults> {
        let parameter = |name: &str| model.parameters.iter().position(|other| &*other.name == name);
        let coordinate = |name: &str| model.coordinates.iter().position(|other| &*other.name == name);
        let rate = || coordinate(name.strip_suffix(RATE)?);
        let kind = parameter(name).map(Kind::Parameter);
        let kind = kind.or_else(|| coordinate(name).map(Kind::Coordinate));
        let kind = kind.or_else(|| rate().map(Kind::Rate)).or(match name {
            FRICTION => Some(Kind::Friction),
            TIME => Some(Kind::Time),
            _ => None,
        });
        match kind {
            Some(kind) => Ok(Self { name: name.to_owned(), kind }),
            None => Err(unknown(model, name)),
        }
    }

    /// A value in SI units.
    ///
    /// # Errors
    /// A text that is no quantity of the right dimension.
    pub(super) fn value_of(&self, model: &Model, value: &Value) -> Result<f64, AxisProblem> {
        let name = self.name.strip_suffix(RATE).filter(|_| matches!(self.kind, Kind::Rate(_)));
        let kind = match self.kind {
            Kind::Friction => return factor(value),
            Kind::Parameter(_) => {
                dimension(model, &self.name, value)?;
                SettingKind::Parameter
            }
            Kind::Coordinate(_) => SettingKind::Position,
            Kind::Rate(_) => SettingKind::Rate,
            Kind::Time => SettingKind::Time,
        };
        let setting = Setting::new(kind, name.unwrap_or(&self.name), value.clone());
        model.setting_value(&setting).map_err(|faults| AxisProblem::of(&faults))
    }

    /// Whether negative values make no sense because it is friction.
    pub(super) fn is_friction(&self, model: &Model) -> bool {
        self.kind == Kind::Friction || model.is_friction_coefficient(&self.name)
    }

    /// Whether it is a coefficient of friction itself, not something from which one is computed.
    pub(super) fn is_itself_friction(&self, model: &Model) -> bool {
        matches!(self.kind, Kind::Parameter(_)) && model.is_itself_friction(&self.name)
    }

    /// Its SI unit; "1" for the factor of friction, "SI" for a parameter that has no unit, or a rare one.
    pub(super) fn unit(&self, model: &Model) -> &'static str {
        let is_angle = |index: usize| model.coordinates[index].kind.is_angle();
        match self.kind {
            Kind::Parameter(_) => {
                let unit = model.parameter_unit(&self.name);
                UNITS.into_iter().find(|known| *known == unit).unwrap_or("SI")
            }
            Kind::Coordinate(index) if is_angle(index) => "rad",
            Kind::Coordinate(_) => "m",
            Kind::Rate(index) if is_angle(index) => "rad/s",
            Kind::Rate(_) => "m/s",
            Kind::Time => "s",
            Kind::Friction => "1",
        }
    }
}

/// A parameter may be of any dimension, but what uses it may not; a number is in SI units whatever it is.
fn dimension(model: &Model, name: &str, value: &Value) -> Result<(), AxisProblem> {
    if matches!(value, Value::Number(_)) {
        return Ok(());
    }
    let Err(faults) = model.with(&Settings::default().parameter(name, value.clone())) else { return Ok(()) };
    let wrong = |kind: &FaultKind| matches!(kind, FaultKind::WrongDimension { .. });
    if faults.sorted().iter().any(|fault| wrong(&fault.kind)) {
        return Err(AxisProblem::of(&faults));
    }
    Ok(())
}

/// A factor of all friction: a plain number, not below zero.
fn factor(value: &Value) -> Result<f64, AxisProblem> {
    match value.plain_number() {
        Some(value) if value < 0.0 => Err(AxisProblem::NegativeFriction { value }),
        Some(value) if value.is_finite() => Ok(value),
        _ => {
            let message = format!("`{value}` is not a factor of friction, which is a plain number");
            Err(AxisProblem::Value { message, hint: None })
        }
    }
}

fn unknown(model: &Model, name: &str) -> Faults {
    let parameters = model.parameters.iter().map(|parameter| parameter.name.to_string());
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.name.to_string());
    let rates = model.coordinates.iter().map(|coordinate| format!("{}{RATE}", coordinate.name));
    let known: Vec<String> =
        parameters.chain(coordinates).chain(rates).chain([FRICTION.to_owned(), TIME.to_owned()]).collect();
    let kind = FaultKind::UnknownName {
        what: "parameter, coordinate or rate",
        name: name.to_owned(),
        nearest: nearest(name, known.iter().map(String::as_str)),
        known,
    };
    Fault::general(kind).into()
}
