//! `slideway new`

mod dialogue;

use super::models::list;
use crate::arguments::{Arguments, Destination, NewArguments};
use crate::columns::wrapped;
use crate::failure::Failure;
use crate::faulty_input::FaultyInput;
use crate::files::Files;
use crate::outcome::Outcome;
use crate::output::Output;
use clap::Parser;
use slideway::fault::{Faults, nearest};
use slideway::gallery::{self, GalleryModel, MODELS};
use slideway::model::Settings;
use slideway::printable;
use slideway::template::{FILE, TEMPLATES, Template};
use std::ffi::OsString;
use std::fmt::Write;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

/// Writes a model from a template, and answers its first question.
pub(crate) fn new(arguments: &NewArguments, output: &Output) -> Result<Outcome, Failure> {
    if arguments.list {
        let templates =
            TEMPLATES.iter().map(|one| (one.name, one.summary(), format!("Rule: {}", one.rule())));
        output.write(
            &(list(templates)
                + "`slideway new NAME` writes one, `slideway new NAME --help` says what can be set.\n"),
        )?;
        return Ok(Outcome::Done);
    }
    if let Some(name) = arguments.unknown.clone() {
        let nearest = nearest(&name, TEMPLATES.iter().map(|template| template.name));
        let begins = |model: &&GalleryModel| model.name.split('-').next() == Some(name.as_str());
        let named = gallery::find(&name).or_else(|| MODELS.iter().find(begins));
        let model = named.map(|model| model.name);
        return Err(Failure::UnknownTemplate { name, nearest, model });
    }
    let asks = io::stdin().is_terminal() && io::stdout().is_terminal();
    let template = match arguments.template {
        Some(template) => template,
        None if asks => dialogue::template(output.color())?,
        None => return Err(Failure::NoTemplate),
    };
    let given = arguments.destination.as_ref();
    let to_file = |file: &Path, force: bool| {
        let destination = Destination { output: Some(file.to_owned()), force };
        Files::new(output, &destination, None).answer()
    };
    let force = given.is_some_and(|destination| destination.force);
    let named = given.and_then(|destination| destination.output.clone());
    let asks = asks && arguments.settings.entries().is_empty() && named.as_deref() != Some(Path::new("-"));
    let (settings, file, to_file) = if asks {
        dialogue::answers(template, named.as_deref().map(|file| (file, force)), output.color(), &to_file)?
    } else {
        let file = named.unwrap_or_else(|| PathBuf::from(format!("{}.toml", template.name)));
        let to_file = to_file(&file, force)?;
        (arguments.settings.clone(), file, to_file)
    };
    let shown = if file == Path::new("-") { format!("{}.toml", template.name) } else { quoted(&file) };
    let text = template.model(&settings, &shown).map_err(|faults| refused(template, &settings, faults))?;
    to_file.write(&text)?;
    if file != Path::new("-") {
        output.write(&written(template, &settings, &shown, output.style().width))?;
        answer(template, &file, output)?;
    }
    Ok(Outcome::Done)
}

/// The first of the template's commands, run as if it had been typed.
fn answer(template: &Template, file: &Path, output: &Output) -> Result<(), Failure> {
    let Some(command) = template.commands().next() else { return Ok(()) };
    let words = command.split_whitespace().map(|word| match word {
        FILE => Path::new(".").join(file).into_os_string(),
        word => OsString::from(word),
    });
    let arguments = Arguments::try_parse_from(words).unwrap_or_else(|error| error.exit());
    crate::run(&arguments.command, output)?;
    Ok(())
}

/// Builds the message that says what is in the file, and which command is run on it.
fn written(template: &Template, settings: &Settings, file: &str, width: usize) -> String {
    let given = |name: &str| settings.entries().iter().any(|setting| setting.name == name);
    let others: Vec<String> = template
        .parameters()
        .filter(|parameter| !given(parameter.name))
        .map(|parameter| format!("{} = {}", parameter.name, parameter.value))
        .collect();
    let mut text = format!("Wrote {}", printable::line(file));
    if !others.is_empty() {
        let _ = write!(text, ". Kept from the template: {}", others.join(", "));
    }
    let _ = write!(text, ".\nRule: {}\nReturn: {}", template.rule(), template.way_back());
    let mut text: String =
        text.lines().flat_map(|line| wrapped(line, width)).map(|line| line + "\n").collect();
    if let Some(command) = template.commands().next() {
        let _ = writeln!(text, "\n$ {}", command.replace(FILE, &printable::line(file)));
    }
    text
}

/// A path as a word of a command line, which no command takes for an option.
fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    let text = if text.starts_with('-') { format!("./{text}") } else { text };
    let plain = |c: char| c.is_alphanumeric() || "-_./".contains(c);
    if text.chars().all(plain) { text } else { format!("'{}'", text.replace('\'', r"'\''")) }
}

/// Builds the failure of a template that makes no sense with these settings.
fn refused(template: &Template, settings: &Settings, faults: Faults) -> Failure {
    Failure::Input(Box::new(FaultyInput {
        name: format!("the template {}", template.name),
        text: template.text.to_owned(),
        settings: settings.clone(),
        parameter_option: "--",
        faults,
    }))
}
