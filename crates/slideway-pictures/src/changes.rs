//! The settings of a model, in words.

use slideway::model::{Setting, SettingKind, Settings};

/// The changes of a model by settings, in words; empty where they change nothing.
pub(crate) fn changes(settings: &Settings) -> String {
    in_words(settings.entries().iter())
}

/// The same beside the state, which has places, rates and the time.
pub(crate) fn changes_beside_state(settings: &Settings) -> String {
    let is_of_state =
        |kind: SettingKind| matches!(kind, SettingKind::Position | SettingKind::Rate | SettingKind::Time);
    in_words(settings.entries().iter().filter(|setting| !is_of_state(setting.kind)))
}

fn in_words<'s>(settings: impl Iterator<Item = &'s Setting>) -> String {
    let change = |setting: &Setting| {
        let Setting { name, value, kind, .. } = setting;
        match kind {
            SettingKind::Rate => format!("rate of {name} = {value}"),
            SettingKind::Time => format!("t = {value}"),
            _ => format!("{name} = {value}"),
        }
    };
    let changes: Vec<String> = settings.map(change).collect();
    if changes.is_empty() { String::new() } else { format!("With {}", changes.join(", ")) }
}
