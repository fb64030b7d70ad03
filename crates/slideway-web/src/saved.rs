//! The text of a model with what is changed in it: comments and all else stay as they are.

use crate::question::Asked;
use slideway::fault::{Faults, Source};
use slideway::ids::FormulaId;
use slideway::model::{Coordinate, Model, Setting, SettingKind};
use std::ops::Range;

/// The words that replace some bytes of a text.
struct Edit {
    span: Range<usize>,
    words: String,
}

/// The text of the model file in which the settings are written.
///
/// # Errors
/// Faults of the model and of its settings.
pub(crate) fn saved(asked: &Asked) -> Result<String, Faults> {
    let file = asked.file()?;
    asked.set(&file)?;
    let settings = asked.settings.entries();
    // Of several settings of one value the last counts.
    let is_last = |(index, setting): &(usize, &Setting)| {
        !settings[index + 1..].iter().any(|later| (later.kind, &later.name) == (setting.kind, &setting.name))
    };
    let last = settings.iter().enumerate().filter(is_last);
    let mut edits: Vec<Edit> = last.filter_map(|(_, setting)| edit(&file, &asked.text, setting)).collect();
    // From the end, so that the bytes before keep their places.
    edits.sort_by_key(|edit| std::cmp::Reverse(edit.span.start));
    let mut text = asked.text.clone();
    for Edit { span, words } in edits {
        text.replace_range(span, &words);
    }
    Ok(text)
}

fn edit(file: &Model, text: &str, setting: &Setting) -> Option<Edit> {
    match setting.kind {
        SettingKind::Parameter => {
            let parameter = file.parameters.iter().find(|parameter| *parameter.name == *setting.name)?;
            let unit = file.parameter_unit(&setting.name);
            replaced(file, text, parameter.value, &literal(&setting.value.to_string(), &unit))
        }
        SettingKind::Position | SettingKind::Rate => {
            let coordinate = file.coordinates.iter().find(|one| *one.name == *setting.name)?;
            let (key, formula) = match setting.kind {
                SettingKind::Rate => ("rate", coordinate.rate),
                _ => ("value", coordinate.value),
            };
            let value = literal(&setting.value.to_string(), "");
            match formula {
                Some(formula) => replaced(file, text, formula, &value),
                None => Some(inserted(text, coordinate, &format!("{key} = {value}"))),
            }
        }
        // The page sets no time.
        _ => None,
    }
}

/// A value as TOML: what is no number alone is a text. A unit follows a number that needs one: "0.5 m", "0.5/(1 s)".
fn literal(value: &str, unit: &str) -> String {
    match (value.trim().parse::<f64>(), unit.strip_prefix("1/")) {
        (Ok(number), _) if unit.is_empty() && number.is_finite() => format!("{number}"),
        (Ok(_), Some(unit)) => format!("\"{value}/(1 {unit})\""),
        (Ok(_), None) => format!("\"{value} {unit}\""),
        // The escapes of JSON are among those of TOML.
        _ => serde_json::to_string(value).expect("a text"),
    }
}

/// A value in the place of another. A comment behind it stays in its column if there is room.
fn replaced(file: &Model, text: &str, formula: FormulaId, value: &str) -> Option<Edit> {
    let origin = &file.formulas[formula.index()].origin;
    if origin.source != Source::Model {
        return None;
    }
    let mut span = origin.span.clone();
    let mut words = value.to_owned();
    let behind = &text[span.end..];
    let gap = behind.len() - behind.trim_start_matches(' ').len();
    if gap > 0 && behind[gap..].starts_with('#') {
        let free = (gap + span.len()).saturating_sub(words.len()).max(1);
        words.push_str(&" ".repeat(free));
        span.end += gap;
    }
    Some(Edit { span, words })
}

/// A further key of a coordinate. Its name, at its place, is the end of a heading, before an inline table, or the beginning
/// of a dotted key.
fn inserted(text: &str, coordinate: &Coordinate, entry: &str) -> Edit {
    let name = coordinate.place.span.clone();
    let behind = &text[name.end..];
    let is_before = |sign: char| behind.trim_start_matches([' ', '\t', '"', '\'']).starts_with(sign);
    let at = |place: usize, words: String| Edit { span: place..place, words };
    if is_before('=') {
        let inside = name.end + behind.find('{').map_or(0, |brace| brace + 1);
        at(inside, format!(" {entry},"))
    } else if is_before('.') {
        let line = text[..name.start].rfind('\n').map_or(0, |end| end + 1);
        at(line, format!("{}.{entry}\n", &text[line..name.end]))
    } else {
        let end = behind.find('\n').map_or(text.len(), |end| name.end + end);
        at(end, format!("\n{entry}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use slideway::model::Settings;

    fn saved(text: &str, settings: &[(SettingKind, &str, &str)]) -> String {
        let entries = settings.iter().map(|(kind, name, value)| Setting::new(*kind, name, *value));
        let settings = entries.fold(Settings::default(), Settings::with);
        super::saved(&Asked { text: text.to_owned(), settings }).expect("no faults")
    }

    #[test]
    fn values_take_the_place_of_those_in_the_file_and_comments_stay() {
        let text = slideway::gallery::find("drawer").expect("in the gallery").text;
        let changed = saved(
            text,
            &[
                (SettingKind::Parameter, "L", "0.5"),
                (SettingKind::Parameter, "mu", "0.65"),
                (SettingKind::Rate, "x", "2*v"),
            ],
        );
        let expected = text
            .replace("L = \"0.4 m\"               #", "L = \"0.5 m\"               #")
            .replace("mu = 0.3                  #", "mu = 0.65                 #")
            .replace("rate = \"v\"", "rate = \"2*v\"");
        assert_eq!(changed, expected);
    }

    /// The same state, whether it is set or written: every parameter, value and rate of every model of the gallery.
    #[test]
    fn what_is_saved_is_what_was_set() {
        for model in slideway::gallery::MODELS {
            let file = Model::parse(model.text).expect("in the gallery");
            let values = file.constants().map(|known| file.parameter_values(&known)).expect("values");
            let parameters = file.parameters.iter().zip(values);
            let mut settings: Vec<(SettingKind, &str, String)> = parameters
                .map(|(parameter, value)| (SettingKind::Parameter, &*parameter.name, value.to_string()))
                .collect();
            for coordinate in &file.coordinates {
                settings.push((SettingKind::Position, &coordinate.name, "0.01".to_owned()));
                settings.push((SettingKind::Rate, &coordinate.name, "0.25".to_owned()));
            }
            let borrowed: Vec<_> =
                settings.iter().map(|(kind, name, value)| (*kind, *name, &**value)).collect();
            let changed = Model::parse(&saved(model.text, &borrowed)).unwrap_or_else(|faults| {
                panic!("{}: {faults:?}", model.name);
            });
            let written = changed.constants().map(|known| changed.parameter_values(&known)).expect("values");
            let before = file.constants().map(|known| file.parameter_values(&known)).expect("values");
            assert_eq!(written, before, "{}", model.name);
            assert!(
                changed
                    .coordinates
                    .iter()
                    .all(|coordinate| coordinate.value.is_some() && coordinate.rate.is_some())
            );
        }
    }

    #[test]
    fn a_coordinate_in_any_form_of_table_gets_its_value() {
        let text = slideway::gallery::find("drawer").expect("in the gallery").text;
        let heading = "[coordinates.x]\nslide = \"guide\"\nrate = \"v\"\n";
        for form in [
            "[coordinates]\nx = { slide = \"guide\", rate = \"v\" }\n",
            "[coordinates]\nx.slide = \"guide\"\nx.rate = \"v\"\n",
            "[coordinates . \"x\"] # how far it is out\nslide = \"guide\"\nrate = \"v\"\n",
        ] {
            let changed = saved(&text.replace(heading, form), &[(SettingKind::Position, "x", "20 mm")]);
            let model = Model::parse(&changed).unwrap_or_else(|faults| panic!("{changed}: {faults:?}"));
            assert!(model.coordinates[0].value.is_some(), "{changed}");
        }
    }
}
