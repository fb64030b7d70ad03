//! A model and what is changed in it.

use clap::Args;
use slideway::fault::{Fault, FaultKind};
use slideway::model::{Setting, SettingKind, Settings};
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

    /// Time of the state, `t` in expressions.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    time: Option<String>,
}

impl ModelArguments {
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
                match setting(kind, text) {
                    Some(setting) => settings = settings.with(setting),
                    None => faults.push(Fault::general(FaultKind::MalformedSetting { text: text.clone() })),
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
