//! Changes of a model before it is solved, made by a command: parameters, coordinate values and rates.

use super::formula::{Allowed, Formula, Origin, Varies};
use super::range::{Parsed, parse_value};
use super::{Coordinate, Model, Value};
use crate::expression::{Dimension, Expression, parse};
use crate::fault::{Doubt, Fault, FaultKind, Faults, Place, Source, nearest};
use crate::ids::FormulaId;
use crate::units::precise;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The name that a setting of the time bears.
const TIME: &str = "time";

/// Changes to a model, in the order in which they were given; a later one wins.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Settings {
    entries: Vec<Setting>,
}

/// One change.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Setting {
    /// Kind of quantity that is changed.
    pub kind: SettingKind,
    /// Name of the parameter or coordinate.
    pub name: String,
    /// Its new value: a number, a quantity with a unit, or an expression of parameters.
    pub value: Value,
}

impl Setting {
    /// A change of what bears this name.
    pub fn new(kind: SettingKind, name: &str, value: impl Into<Value>) -> Self {
        Self { kind, name: name.to_owned(), value: value.into() }
    }

    /// The text to which the places of its faults refer.
    pub fn text(&self) -> String {
        format!("{}={}", self.name, self.value)
    }
}

/// Kind of quantity that a setting changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum SettingKind {
    /// A parameter (`--set`).
    Parameter,
    /// The value of a coordinate (`--at`).
    Position,
    /// The rate of a coordinate (`--rate`).
    Rate,
    /// The time of the state (`--time`).
    Time,
}

impl Settings {
    /// Adds a value for a parameter.
    #[must_use]
    pub fn parameter(self, name: &str, value: impl Into<Value>) -> Self {
        self.with(Setting::new(SettingKind::Parameter, name, value))
    }

    /// Adds a value for a coordinate.
    #[must_use]
    pub fn position(self, name: &str, value: impl Into<Value>) -> Self {
        self.with(Setting::new(SettingKind::Position, name, value))
    }

    /// Adds a value for the rate of a coordinate.
    #[must_use]
    pub fn rate(self, name: &str, value: impl Into<Value>) -> Self {
        self.with(Setting::new(SettingKind::Rate, name, value))
    }

    /// Sets the time of the state.
    #[must_use]
    pub fn time(self, value: impl Into<Value>) -> Self {
        self.with(Setting::new(SettingKind::Time, TIME, value))
    }

    /// Adds a change.
    #[must_use]
    pub fn with(mut self, setting: Setting) -> Self {
        self.entries.push(setting);
        self
    }

    /// The settings; [`Source::Setting`] counts them.
    pub fn entries(&self) -> &[Setting] {
        &self.entries
    }
}

impl Model {
    /// The model with parameters, coordinate values, rates or the time replaced.
    ///
    /// # Errors
    /// Every unknown name, expression that cannot be read, dimension that has changed, and circle of
    /// parameters, each with its place in the text of the setting.
    pub fn with(&self, settings: &Settings) -> Result<Self, Faults> {
        self.with_varied(settings, &[])
    }

    /// As [`Self::with`], where the parameters of these names are going to be varied, so that their own values do not matter:
    /// where a friction coefficient is not allowed beside the others, the nearest one that is allowed takes its place, with a
    /// warning.
    ///
    /// # Errors
    /// As [`Self::with`].
    pub fn with_varied(&self, settings: &Settings, varied: &[String]) -> Result<Self, Faults> {
        let numbered = settings.entries().iter().enumerate();
        let changes = numbered.map(|(index, setting)| (setting, Source::Setting(index)));
        let mut model = self.changed(changes, varied)?;
        model.doubts.extend(self.bare_settings(settings));
        Ok(model)
    }

    /// It with these changes, each with the text in which its faults have their places, and as in [`Self::with_varied`].
    pub(super) fn changed<'a>(
        &self,
        changes: impl Iterator<Item = (&'a Setting, Source)>,
        varied: &[String],
    ) -> Result<Self, Faults> {
        let mut model = self.clone();
        let mut faults = Faults::default();
        for (setting, source) in changes {
            if let Err(fault) = model.change(setting, &source) {
                faults.append(fault);
            }
        }
        faults.append(model.check(true));
        let faults = faults.without_consequences();
        if !faults.is_empty() && varied.iter().any(|name| model.allow(name)) && model.check(true).is_empty() {
            return Ok(model);
        }
        faults.or(model)
    }

    /// Gives a friction coefficient the allowed value that is nearest to its own; false if its own is allowed.
    fn allow(&mut self, name: &str) -> bool {
        let Some([least, greatest]) = self.friction_range(name) else { return false };
        let Some(parameter) = self.parameters.iter().find(|other| &*other.name == name) else { return false };
        let id = parameter.value;
        let own = self.allowed_values(&[], &mut Faults::default())[id.index()];
        let Some(own) = own.filter(|own| !(least..=greatest).contains(own)) else { return false };
        let taken = own.clamp(least, greatest);
        let setting = Setting::new(SettingKind::Parameter, name, taken);
        let doubt = Doubt::VariedValue { name: name.to_owned(), value: precise(own), taken: precise(taken) };
        self.doubts.push(Fault::new(FaultKind::Doubt(doubt), self.formula(id).origin.place()));
        self.change(&setting, &Source::Argument(Arc::from(setting.text()))).is_ok()
    }

    /// The model with all rates of its coordinates reversed, formulas of parameters among them.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut model = self.clone();
        let formulas = Arc::make_mut(&mut model.formulas);
        for id in self.coordinates.iter().filter_map(|coordinate| coordinate.rate) {
            let formula = &mut formulas[id.index()];
            formula.expression = std::mem::take(&mut formula.expression).negated();
        }
        model
    }

    /// The warnings of settings, which may be the reason for their faults: numbers that are typed without a
    /// unit where the model has another one than that of the SI.
    pub fn warnings_of(&self, settings: &Settings) -> Faults {
        let mut found = Faults::default();
        found.extend(self.bare_settings(settings));
        found
    }

    fn bare_settings(&self, settings: &Settings) -> Vec<Fault> {
        let numbered = settings.entries().iter().enumerate();
        numbered.filter_map(|(index, setting)| self.bare_setting(setting, Source::Setting(index))).collect()
    }

    fn bare_setting(&self, setting: &Setting, source: Source) -> Option<Fault> {
        let coordinate = || self.coordinates.iter().find(|coordinate| *coordinate.name == *setting.name);
        let unit = match setting.kind {
            SettingKind::Parameter => self.units.typed_parameter(&setting.name).cloned(),
            SettingKind::Position => {
                self.units.typed(if coordinate()?.kind.is_angle() { "rad" } else { "m" })
            }
            SettingKind::Rate => {
                self.units.typed(if coordinate()?.kind.is_angle() { "rad/s" } else { "m/s" })
            }
            SettingKind::Time => self.units.typed("s"),
        };
        let doubt = setting.value.without_unit(&setting.name, unit)?;
        let place = Place { source, span: setting.name.len() + 1..setting.text().len() };
        Some(Fault::new(FaultKind::Doubt(doubt), place))
    }

    fn change(&mut self, setting: &Setting, source: &Source) -> Result<(), Faults> {
        let name = setting.name.as_str();
        match setting.kind {
            SettingKind::Parameter => {
                let Some(index) = self.parameters.iter().position(|p| p.name.as_ref() == name) else {
                    return Err(unknown(
                        "parameter",
                        setting,
                        source,
                        self.parameters.iter().map(|p| &*p.name),
                    ));
                };
                let old = self.parameter_dimension(index);
                let formula = self.setting_formula(setting, source, old)?;
                self.replace_formula(Some(self.parameters[index].value), formula);
                if let Some(unit) = setting.value.unit() {
                    self.units = std::mem::take(&mut self.units).with_parameter(name, unit);
                }
            }
            SettingKind::Position | SettingKind::Rate => {
                let Some(index) = self.coordinates.iter().position(|c| c.name.as_ref() == name) else {
                    return Err(unknown(
                        "coordinate",
                        setting,
                        source,
                        self.coordinates.iter().map(|c| &*c.name),
                    ));
                };
                let position = setting.kind == SettingKind::Position;
                let wanted = dimension_of(&self.coordinates[index], position);
                let formula = self.setting_formula(setting, source, Some(wanted))?;
                let coordinate = &self.coordinates[index];
                let old = if position { coordinate.value } else { coordinate.rate };
                let id = Some(self.replace_formula(old, formula));
                let coordinate = &mut self.coordinates[index];
                if position { coordinate.value = id } else { coordinate.rate = id }
            }
            SettingKind::Time => {
                let formula = self.setting_formula(setting, source, Some(Dimension::TIME))?;
                self.time = Some(self.replace_formula(self.time, formula));
            }
        }
        Ok(())
    }

    /// The value that a parameter, coordinate, rate or the time would have by a setting (SI units), whether
    /// or not the model makes sense with it.
    ///
    /// # Errors
    /// An expression that cannot be read or has no value, or one of another dimension than it has now.
    pub fn setting_value(&self, setting: &Setting) -> Result<f64, Faults> {
        // A number is in SI units: its own value, and no expression that would have to be read.
        if let Value::Number(number) = setting.value
            && number.is_finite()
        {
            return Ok(number);
        }
        let (parameters, coordinates) = (&self.parameters, &self.coordinates);
        let wanted = if setting.kind == SettingKind::Parameter {
            let index = parameters.iter().position(|parameter| *parameter.name == *setting.name);
            index.and_then(|index| self.parameter_dimension(index))
        } else if setting.kind == SettingKind::Time {
            Some(Dimension::TIME)
        } else {
            let coordinate = coordinates.iter().find(|coordinate| *coordinate.name == *setting.name);
            coordinate.map(|found| dimension_of(found, setting.kind == SettingKind::Position))
        };
        let formula = self.setting_formula(setting, &Source::Setting(0), wanted)?;
        let mut faults = Faults::default();
        faults.extend(self.check_formula(&formula));
        faults.or(())?;
        Ok(formula.constant(&self.parameter_values(&self.constants()?))?)
    }

    fn setting_formula(
        &self,
        setting: &Setting,
        source: &Source,
        wanted: Option<Dimension>,
    ) -> Result<Formula, Faults> {
        let start = setting.name.len() + 1;
        let expression_start = matches!(setting.value, Value::Text(_)).then_some(start);
        let span = match source {
            Source::Argument(text) if text.len() <= start => 0..text.len(),
            Source::Argument(text) => start..text.len(),
            _ => start..setting.text().len(),
        };
        let origin = Origin { source: source.clone(), span, expression_start };
        let what: Arc<str> = Arc::from(format!("the value of {}", setting.name));
        let propose = |mut faults: Faults| {
            faults.propose_units(|_| wanted);
            faults
        };
        let (expression, range) = self.parsed(setting, &origin, &what).map_err(propose)?;
        Ok(Formula {
            expression,
            range,
            wanted,
            allowed: Allowed::Any,
            varies: Varies::Never,
            broken: false,
            what,
            origin,
        })
    }

    /// The expression of a new value, or the middle of its range.
    fn parsed(&self, setting: &Setting, origin: &Origin, what: &Arc<str>) -> Result<Parsed, Faults> {
        let text = match &setting.value {
            Value::Number(value) if value.is_finite() => {
                return Ok((Expression::decimal(*value, &format!("{value:e}")), None));
            }
            Value::Number(_) => {
                let kind = FaultKind::NotFinite { what: what.to_string() };
                return Err(Fault::new(kind, origin.place()).into());
            }
            Value::Text(text) => text,
        };
        let parsed = match setting.kind {
            SettingKind::Parameter => parse_value(text, &self.names()),
            _ => parse(text, &self.names()).map(|expression| (expression, None)),
        };
        parsed.map_err(|list| {
            let mut faults = Faults::default();
            faults.extend(list.into_iter().map(|fault| origin.fault(fault)));
            faults
        })
    }

    /// Puts a formula in the place of an old one, which must not be evaluated any more, or adds it.
    fn replace_formula(&mut self, old: Option<FormulaId>, formula: Formula) -> FormulaId {
        let formulas = Arc::make_mut(&mut self.formulas);
        if let Some(old) = old {
            formulas[old.index()] = formula;
            return old;
        }
        formulas.push(formula);
        FormulaId(formulas.len() - 1)
    }
}

/// Dimension of a coordinate's value, or of its rate.
pub(super) fn dimension_of(coordinate: &Coordinate, position: bool) -> Dimension {
    match (coordinate.kind.is_angle(), position) {
        (true, true) => Dimension::ANGLE,
        (true, false) => Dimension::ANGULAR_VELOCITY,
        (false, true) => Dimension::LENGTH,
        (false, false) => Dimension::VELOCITY,
    }
}

fn unknown<'a>(
    what: &'static str,
    setting: &Setting,
    source: &Source,
    known: impl Iterator<Item = &'a str> + Clone,
) -> Faults {
    let kind = FaultKind::UnknownName {
        what,
        name: setting.name.clone(),
        nearest: nearest(&setting.name, known.clone()),
        known: known.map(str::to_owned).collect(),
    };
    Fault::new(kind, Place { source: source.clone(), span: 0..setting.name.len() }).into()
}
