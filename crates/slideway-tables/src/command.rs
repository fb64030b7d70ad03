//! The command line that asks for a sweep.

use slideway::choice::Choice;
use slideway::model::{Setting, SettingKind, Settings, Value};
use slideway::printable;
use slideway::sweep::{GridAxis, GridValues, SampledAxis, SampledValues, Spread, SweepOptions, SweepPoints};
use std::ffi::OsStr;
use std::fmt::Display;
use std::str::FromStr;

/// The longest argument of a program on Linux, in bytes with the zero at its end (`MAX_ARG_STRLEN`, execve(2)).
const LONGEST_ARGUMENT: usize = 131_072;

/// A word as a shell takes it: plain, in quotes, or, if it is not printable or no UTF-8, byte by byte where
/// it has to be.
pub fn quoted(word: &OsStr) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,+%@".contains(c);
    match word.to_str().filter(|text| printable::line(text) == *text) {
        Some(text) if !text.is_empty() && text.chars().all(plain) => text.to_owned(),
        Some(text) => format!("'{}'", text.replace('\'', "'\\''")),
        _ => {
            let bytes = word.as_encoded_bytes().iter().map(|byte| match byte {
                b'\n' => "\\n".to_owned(),
                b'\'' | b'\\' => format!("\\{}", char::from(*byte)),
                b' '..=b'~' => char::from(*byte).to_string(),
                other => format!("\\{other:03o}"),
            });
            format!("$'{}'", bytes.collect::<String>())
        }
    }
}

/// Returns the settings as the command line receives them: values as texts, those of one kind side by side.
pub(crate) fn typed_settings(settings: &Settings) -> Settings {
    let kinds = [SettingKind::Parameter, SettingKind::Position, SettingKind::Rate, SettingKind::Time];
    let of_kind = |kind| settings.entries().iter().filter(move |setting| setting.kind == kind);
    let typed = |setting: &Setting| Setting::new(setting.kind, &setting.name, text(&setting.value));
    kinds.into_iter().flat_map(of_kind).map(typed).fold(Settings::default(), Settings::with)
}

/// Returns the options of a sweep with values as texts.
pub(crate) fn typed_options(options: &SweepOptions) -> SweepOptions {
    let mut typed = options.clone();
    typed.points = match &options.points {
        SweepPoints::Grid(axes) => SweepPoints::Grid(axes.iter().map(typed_grid).collect()),
        SweepPoints::Samples(sampling, axes) => {
            SweepPoints::Samples(*sampling, axes.iter().map(typed_samples).collect())
        }
        other => other.clone(),
    };
    typed
}

fn typed_grid(axis: &GridAxis) -> GridAxis {
    match &axis.values {
        GridValues::Linear { from, to, count } => GridAxis::linear(&axis.name, text(from), text(to), *count),
        GridValues::Logarithmic { from, to, count } => {
            GridAxis::logarithmic(&axis.name, text(from), text(to), *count)
        }
        GridValues::Listed(values) => GridAxis::listed(&axis.name, values.iter().map(text)),
        _ => axis.clone(),
    }
}

fn typed_samples(axis: &SampledAxis) -> SampledAxis {
    let name = &axis.name;
    match &axis.values {
        SampledValues::Range { from, to } => SampledAxis::range(name, text(from), text(to)),
        SampledValues::Uniform { from, to } => SampledAxis::uniform(name, text(from), text(to)),
        SampledValues::Normal { mean, deviation } => SampledAxis::normal(name, text(mean), text(deviation)),
        SampledValues::LogNormal { median, deviation } => {
            SampledAxis::log_normal(name, text(median), *deviation)
        }
        _ => axis.clone(),
    }
}

fn text(value: &Value) -> Value {
    Value::Text(value.to_string())
}

/// The command that asks for a sweep of the model in a file, all in texts; none if there is no such command: if a value
/// would be read otherwise, or there are too many.
pub(crate) fn command(file: &str, settings: &Settings, options: &SweepOptions) -> Option<String> {
    let mut words = vec!["sweep".to_owned(), file.to_owned()];
    for setting in settings.entries() {
        let (option, value) = match setting.kind {
            SettingKind::Position => ("--at", setting.text()),
            SettingKind::Rate => ("--rate", setting.text()),
            SettingKind::Time => ("--time", setting.value.to_string()),
            _ => ("--set", setting.text()),
        };
        words.extend([option.to_owned(), value]);
    }
    let axes = match &options.points {
        SweepPoints::Grid(axes) => read_back(axes),
        SweepPoints::Samples(_, axes) => read_back(axes),
        _ => None,
    };
    for axis in axes? {
        words.extend(["--vary".to_owned(), axis]);
    }
    if let SweepPoints::Samples(sampling, _) = &options.points {
        words.extend(["--samples".to_owned(), sampling.count.to_string()]);
        if sampling.spread != Spread::default() {
            words.extend(["--sampling".to_owned(), sampling.spread.word().to_owned()]);
        }
        if sampling.seed != 0 {
            words.extend(["--seed".to_owned(), sampling.seed.to_string()]);
        }
    }
    let flags = [
        (!options.breakpoints && options.points.is_line(), "--no-breakpoints"),
        (options.attainability, "--attainability"),
        (options.all_columns, "--all-columns"),
    ];
    words.extend(flags.into_iter().filter(|(is_set, _)| *is_set).map(|(_, flag)| flag.to_owned()));
    let is_short = words.iter().all(|word| word.len() < LONGEST_ARGUMENT);
    let line = || {
        words.iter().fold("slideway".to_owned(), |line, word| format!("{line} {}", quoted(OsStr::new(word))))
    };
    is_short.then(line)
}

/// Axes as texts, if these are read as the same axes.
fn read_back<A: Display + FromStr + PartialEq>(axes: &[A]) -> Option<Vec<String>> {
    let texts: Vec<String> = axes.iter().map(ToString::to_string).collect();
    let is_same = texts.iter().zip(axes).all(|(text, axis)| text.parse().is_ok_and(|read: A| read == *axis));
    is_same.then_some(texts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use slideway::sweep::Sampling;

    fn told(settings: &Settings, options: &SweepOptions) -> Option<String> {
        command("it's.toml", &typed_settings(settings), &typed_options(options))
    }

    #[test]
    fn commands_have_one_order() {
        let settings =
            Settings::default().time("1 s").rate("x", 0.5).parameter("mu", 0.3).position("x", "2 mm");
        let options = SweepOptions::grid([GridAxis::listed("L", [0.1, 0.2]), GridAxis::linear("a", 0, 1, 3)]);
        assert_eq!(
            told(&settings, &options.attainability(true)).as_deref(),
            Some(
                r"slideway sweep 'it'\''s.toml' --set mu=0.3 --at 'x=2 mm' --rate x=0.5 --time '1 s' --vary L=0.1,0.2 --vary a=0..1:3 --attainability"
            )
        );
        let options = SweepOptions::grid([GridAxis::linear("a", 0, 1, 3)]).breakpoints(false);
        let line = told(&Settings::default(), &options);
        assert_eq!(line.as_deref(), Some(r"slideway sweep 'it'\''s.toml' --vary a=0..1:3 --no-breakpoints"));
        let sampling = Sampling { count: 9, spread: Spread::Halton, seed: 4 };
        let options = SweepOptions::samples(sampling, [SampledAxis::normal("a", 0.5, "1 mm")]);
        let expected = r"slideway sweep 'it'\''s.toml' --vary 'a=normal(0.5, 1 mm)' --samples 9 --sampling halton --seed 4";
        assert_eq!(told(&Settings::default(), &options).as_deref(), Some(expected));
    }

    #[test]
    fn what_would_be_read_otherwise_is_no_command() {
        let options = SweepOptions::grid([GridAxis::listed("a", ["0..1:3"])]);
        assert_eq!(told(&Settings::default(), &options), None);
        let options = SweepOptions::grid([GridAxis::listed("a", ["min(1, 2)", "3"])]).breakpoints(false);
        let line = told(&Settings::default(), &options);
        assert_eq!(
            line.as_deref(),
            Some(r"slideway sweep 'it'\''s.toml' --vary 'a=min(1, 2),3' --no-breakpoints")
        );
        let many = SweepOptions::grid([GridAxis::listed("a", (0..100_000).map(f64::from))]);
        assert_eq!(told(&Settings::default(), &many), None);
    }
}
