//! Questions of `slideway new` on a terminal: which template, its dimensions, the name of the file. A slip
//! costs one line.

use crate::columns;
use crate::failure::Failure;
use crate::output::{Output, complain};
use crate::own_file::free_name;
use anstream::ColorChoice;
use slideway::fault::{Doubt, FaultKind, Faults, nearest};
use slideway::model::Settings;
use slideway::printable;
use slideway::template::{self, FILE, TEMPLATES, Template, TemplateParameter};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Asks which template is wanted until there is one.
pub(super) fn template(color: ColorChoice) -> Result<&'static Template, Failure> {
    let numbered = TEMPLATES.iter().enumerate();
    let rows: Vec<(String, String)> = numbered
        .map(|(index, one)| (format!("{:2}  {}", index + 1, one.name), one.summary().to_owned()))
        .collect();
    complain(&format!("What slides?\n{}", columns::list(&rows, 0)), color);
    loop {
        let Some(name) = reply("Number or name: ")? else { return Err(Failure::NoTemplate) };
        let number = name.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
        let found = number.map_or_else(|| template::find(&name), |index| TEMPLATES.get(index));
        match found {
            Some(template) => return Ok(template),
            None if name.is_empty() => {}
            None => say(&no_template(&name), color),
        }
    }
}

/// Builds the message that no template has this number or name.
fn no_template(name: &str) -> String {
    match nearest(name, TEMPLATES.iter().map(|template| template.name)) {
        Some(nearest) => format!("There is no template `{name}`: did you mean `{nearest}`?"),
        None => {
            format!("There is no template `{name}`: type a number from 1 to {}, or a name.", TEMPLATES.len())
        }
    }
}

/// A function that opens a file for writing; `true` lets it overwrite an existing one.
type ToFile<'f> = &'f dyn Fn(&Path, bool) -> Result<Output, Failure>;

/// Asks for the dimensions of a template and, unless it is named, for the file; gives them and what writes the file.
pub(super) fn answers(
    template: &Template,
    named: Option<(&Path, bool)>,
    color: ColorChoice,
    to_file: ToFile<'_>,
) -> Result<(Settings, PathBuf, Output), Failure> {
    // Better said before the questions than after them.
    let early =
        named.map(|(file, force)| Ok::<_, Failure>((file.to_owned(), to_file(file, force)?))).transpose()?;
    let settings = dimensions(template, color)?;
    let (path, output) = early.map_or_else(|| file(template, color, to_file), Ok)?;
    Ok((settings, path, output))
}

/// Asks for every parameter of a template; those that are not answered stay as they are.
///
/// A value is checked with those before it, so that what is wrong can be put right at once.
fn dimensions(template: &Template, color: ColorChoice) -> Result<Settings, Failure> {
    let rule = format!("{} Rule: {}", template.summary(), template.rule());
    let rule = columns::wrapped(&rule, columns::WIDTH).join("\n");
    complain(&format!("\n{rule}\n\nEnter keeps the value in brackets."), color);
    let mut settings = Settings::default();
    for parameter in template.parameters() {
        match dimension(template, parameter, &settings, color)? {
            Answer::Value(with) => settings = with,
            Answer::Kept => {}
            Answer::Ended => break,
        }
    }
    Ok(settings)
}

/// The answer to the question for a parameter.
enum Answer {
    /// A value, which is among these settings now.
    Value(Settings),
    /// The value of the template is right.
    Kept,
    /// The input has ended.
    Ended,
}

/// Asks for a parameter until the answer makes sense with the settings before it.
fn dimension(
    template: &Template,
    parameter: TemplateParameter,
    settings: &Settings,
    color: ColorChoice,
) -> Result<Answer, Failure> {
    // Another value in answer to a question.
    let mut typed = None;
    loop {
        let prompt = format!("{}, {} [{}]: ", parameter.name, parameter.meaning, parameter.value);
        let value = if typed.is_some() { typed.take() } else { reply(&prompt)? };
        let Some(value) = value else { return Ok(Answer::Ended) };
        if value.is_empty() {
            return Ok(Answer::Kept);
        }
        let with = |value: &str| settings.clone().parameter(parameter.name, value);
        let Err(faults) = template.model(&with(&value), FILE) else {
            return Ok(Answer::Value(with(&value)));
        };
        let Some(value) = with_unit(&faults) else {
            say(&slip(&faults), color);
            continue;
        };
        let answer = reply(&format!("{value}? [Enter: yes] "))?;
        match answer.as_deref() {
            None => return Ok(Answer::Ended),
            Some("n" | "N" | "no") => {}
            Some("" | "y" | "Y" | "yes") => match template.model(&with(&value), FILE) {
                Ok(_) => return Ok(Answer::Value(with(&value))),
                Err(faults) => say(&slip(&faults), color),
            },
            Some(_) => typed = answer,
        }
    }
}

/// A number without a unit with the one that was meant, if it is the only thing that is wrong.
fn with_unit(faults: &Faults) -> Option<String> {
    match faults.sorted().as_slice() {
        [one] => match &one.kind {
            FaultKind::Doubt(Doubt::BareNumber { value, unit, .. }) => Some(format!("{value} {unit}")),
            _ => None,
        },
        _ => None,
    }
}

/// The first fault in one line.
fn slip(faults: &Faults) -> String {
    faults.sorted().first().map_or_else(String::new, |first| {
        let hint = first.kind.hint().map_or_else(String::new, |hint| format!(" ({hint})"));
        format!("Not possible: {}{hint}.", first.kind)
    })
}

/// Asks for the name of the file until it can be written; gives it and what writes it.
fn file(template: &Template, color: ColorChoice, to_file: ToFile<'_>) -> Result<(PathBuf, Output), Failure> {
    let usual = free_name(Path::new(template.name), ".toml", false);
    loop {
        let answer = reply(&format!("File [{}]: ", usual.display()))?.unwrap_or_default();
        let mut path = if answer.is_empty() { usual.clone() } else { PathBuf::from(answer) };
        if path.extension().is_none() {
            path.set_extension("toml");
        }
        let failure = match to_file(&path, false) {
            Ok(output) => return Ok((path, output)),
            Err(failure) => failure,
        };
        if matches!(failure, Failure::OutputExists { .. }) {
            let prompt = format!("{} exists. Overwrite it? [y/N] ", path.display());
            if matches!(reply(&prompt)?.as_deref(), Some("y" | "Y" | "yes")) {
                return to_file(&path, true).map(|output| (path, output));
            }
        } else {
            say(&sentence(&failure), color);
        }
    }
}

/// A failure as a sentence.
fn sentence(failure: &Failure) -> String {
    let line = failure.in_one_line();
    let mut letters = line.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    let end = if line.ends_with(['.', '?']) { "" } else { "." };
    format!("{first}{}{end}", letters.as_str())
}

/// Says something in one line.
fn say(text: &str, color: ColorChoice) {
    complain(&printable::line(text), color);
}

/// Reads what is typed at a prompt. Returns `None` at the end of the input.
fn reply(prompt: &str) -> Result<Option<String>, Failure> {
    let mut line = String::new();
    let mut stream = io::stderr();
    let prompted = stream.write_all(printable::line(prompt).as_bytes());
    let read = prompted.and_then(|()| io::stdin().read_line(&mut line));
    let bytes = read.map_err(|error| Failure::CannotRead { path: PathBuf::from("standard input"), error })?;
    if bytes == 0 {
        let _ = stream.write_all(b"\n");
    }
    Ok((bytes > 0).then(|| line.trim().to_owned()))
}
