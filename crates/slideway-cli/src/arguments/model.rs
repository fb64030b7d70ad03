//! A model and what is changed in it.

use super::values::choice;
use clap::Args;
use slideway::choice::Choice;
use slideway::fault::{Fault, FaultKind};
use slideway::model::{Setting, SettingKind, Settings};
use slideway::units::UnitSystem;
use std::path::PathBuf;

/// A model and what is changed in it.
#[derive(Debug, Args)]
pub(crate) struct ModelArguments {
    /// The model file (TOML), or `-` for standard input.
    #[arg(value_name = "MODEL")]
    pub(crate) file: PathBuf,

    /// Set a parameter: a number, a quantity with a unit, or an expression in parameters.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,

    /// Move the mechanism to this value of a coordinate.
    #[arg(long, value_name = "COORDINATE=VALUE")]
    at: Vec<String>,

    /// Set the rate of change of a coordinate.
    #[arg(long, value_name = "COORDINATE=VALUE")]
    rate: Vec<String>,

    /// Set the time of the state, `t` in expressions.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    time: Option<String>,

    /// Units of the text output, in place of the `units` in the model file. JSON and tables are always in SI units.
    #[arg(long, value_name = "UNITS", ignore_case = true, value_parser = choice::<UnitSystem>())]
    units: Option<UnitSystem>,

    /// Treat warnings as errors.
    #[arg(long)]
    pub(crate) strict: bool,
}

impl ModelArguments {
    /// The option for units as it was given.
    pub(crate) fn units_option(&self) -> Option<String> {
        Some(format!("--units {}", self.units?.word()))
    }

    /// The units that are asked for.
    pub(crate) fn units(&self) -> Option<UnitSystem> {
        self.units
    }

    /// The settings, and the faults of those that are not of the form name=value.
    pub(crate) fn settings(&self) -> (Settings, Vec<Fault>) {
        let mut settings = Settings::default();
        let mut faults = Vec::new();
        let kinds = [
            (SettingKind::Parameter, &self.set),
            (SettingKind::Position, &self.at),
            (SettingKind::Rate, &self.rate),
        ];
        for (kind, texts) in kinds {
            for text in texts {
                if let Some(setting) = setting(kind, text) {
                    settings = settings.with(setting);
                } else {
                    let kind = FaultKind::MalformedSetting { text: text.clone() };
                    faults.push(Fault::of_argument(kind, text, 0..text.len()));
                }
            }
        }
        match &self.time {
            Some(time) => (settings.time(time.as_str()), faults),
            None => (settings, faults),
        }
    }
}

/// A setting that is written as `name=value`; none if there is no `=`, or nothing on one side of it.
fn setting(kind: SettingKind, text: &str) -> Option<Setting> {
    let (name, value) = text.split_once('=')?;
    let (name, value) = (name.trim(), value.trim());
    (!name.is_empty() && !value.is_empty()).then(|| Setting::new(kind, name, value))
}
