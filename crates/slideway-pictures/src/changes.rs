//! The settings of a model, in words.

use slideway::model::{Setting, SettingKind, Settings};

/// The changes of a model by settings, in words; empty where they change nothing.
pub(crate) fn changes(settings: &Settings) -> String {
    let change = |setting: &Setting| {
        let Setting { name, value, kind, .. } = setting;
        match kind {
            SettingKind::Position => format!("at {name} = {value}"),
            SettingKind::Rate => format!("rate of {name} = {value}"),
            SettingKind::Time => format!("t = {value}"),
            _ => format!("{name} = {value}"),
        }
    };
    let changes: Vec<String> = settings.entries().iter().map(change).collect();
    if changes.is_empty() { String::new() } else { format!("With {}", changes.join(", ")) }
}
