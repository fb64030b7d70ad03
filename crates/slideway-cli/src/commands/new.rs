//! `slideway new`

use super::models::list;
use crate::arguments::{Arguments, Destination, NewArguments};
use crate::failure::Failure;
use crate::faulty_input::FaultyInput;
use crate::files::Files;
use crate::outcome::Outcome;
use crate::output::{Output, complain};
use anstream::ColorChoice;
use clap::Parser;
use slideway::fault::{Faults, nearest};
use slideway::model::Settings;
use slideway::printable;
use slideway::template::{self, FILE, TEMPLATES, Template};
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
    let asks = io::stdin().is_terminal() && io::stdout().is_terminal();
    let template = match arguments.template {
        Some(template) => template,
        None if asks => which(output.color())?,
        None => return Err(Failure::NoTemplate),
    };
    let file = file(template, arguments.destination.as_ref());
    let force = arguments.destination.as_ref().is_some_and(|destination| destination.force);
    let destination = Destination { output: Some(file.clone()), force };
    let to_file = Files::new(output, &destination, None).answer()?;
    let settings = if asks && arguments.settings.entries().is_empty() && file != Path::new("-") {
        dimensions(template, output.color())?
    } else {
        arguments.settings.clone()
    };
    let shown = if file == Path::new("-") { format!("{}.toml", template.name) } else { quoted(&file) };
    let text = template.model(&settings, &shown).map_err(|faults| refused(template, &settings, faults))?;
    to_file.write(&text)?;
    if file != Path::new("-") {
        output.write(&written(template, &settings, &shown))?;
        answer(template, &file, output)?;
    }
    Ok(Outcome::Done)
}

/// The file of the model: the one that is named, or that of the template's name.
fn file(template: &Template, destination: Option<&Destination>) -> PathBuf {
    let named = destination.and_then(|destination| destination.output.clone());
    named.unwrap_or_else(|| PathBuf::from(format!("{}.toml", template.name)))
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

/// What is in the file, and the command that is run on it.
fn written(template: &Template, settings: &Settings, file: &str) -> String {
    let given = |name: &str| settings.entries().iter().any(|setting| setting.name == name);
    let others: Vec<String> = template
        .parameters()
        .filter(|parameter| !given(parameter.name))
        .map(|parameter| format!("{} = {}", parameter.name, parameter.value))
        .collect();
    let mut text = format!("Wrote {}", printable::line(file));
    if !others.is_empty() {
        let _ = write!(text, ", as in the template: {}", others.join(", "));
    }
    let _ = writeln!(text, ".\nRule: {}\nReturn: {}", template.rule(), template.way_back());
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

/// That the template makes no sense with these settings.
fn refused(template: &Template, settings: &Settings, faults: Faults) -> Failure {
    Failure::Input(Box::new(FaultyInput {
        name: format!("the template {}", template.name),
        text: template.text.to_owned(),
        settings: settings.clone(),
        parameter_option: "--",
        faults,
    }))
}

/// Asks which template is wanted until there is one.
fn which(color: ColorChoice) -> Result<&'static Template, Failure> {
    let mut question = String::from("What slides?\n");
    for template in TEMPLATES {
        let _ = writeln!(question, "  {:12}  {}", template.name, template.summary());
    }
    complain(question.trim_end(), color);
    loop {
        let Some(name) = reply("Name: ")? else { return Err(Failure::NoTemplate) };
        if let Some(template) = template::find(&name) {
            return Ok(template);
        }
        let nearest = nearest(&name, TEMPLATES.iter().map(|template| template.name));
        complain(&Failure::UnknownTemplate { name, nearest }.to_string(), color);
    }
}

/// Asks for every parameter of a template; those that are not answered stay as they are.
///
/// A value is checked with those before it, so that what is wrong can be put right at once.
fn dimensions(template: &Template, color: ColorChoice) -> Result<Settings, Failure> {
    complain(
        &format!("{}\nRule: {}\nEnter keeps what stands in brackets.", template.summary(), template.rule()),
        color,
    );
    let mut settings = Settings::default();
    for parameter in template.parameters() {
        loop {
            let prompt = format!("{}, {} [{}]: ", parameter.name, parameter.meaning, parameter.value);
            let Some(value) = reply(&prompt)? else { return Ok(settings) };
            if value.is_empty() {
                break;
            }
            let with = settings.clone().parameter(parameter.name, value);
            match template.model(&with, FILE) {
                Ok(_) => {
                    settings = with;
                    break;
                }
                Err(faults) => complain(&refused(template, &with, faults).to_string(), color),
            }
        }
    }
    Ok(settings)
}

/// What is typed at a prompt; none at the end of the input.
fn reply(prompt: &str) -> Result<Option<String>, Failure> {
    let mut line = String::new();
    let mut stream = io::stderr();
    let prompted = io::Write::write_all(&mut stream, prompt.as_bytes());
    let read = prompted.and_then(|()| io::stdin().read_line(&mut line));
    let bytes = read.map_err(|error| Failure::CannotRead { path: PathBuf::from("standard input"), error })?;
    Ok((bytes > 0).then(|| line.trim().to_owned()))
}
