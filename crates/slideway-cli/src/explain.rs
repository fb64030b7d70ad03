//! Complaints about the arguments, in the words of [`clap`]; where a name is not known, with all that there
//! are.

use crate::arguments::{Arguments, Destination};
use crate::diagnostics::{Note, listing, note};
use crate::outcome::Outcome;
use crate::output::{Look, Output, complain};
use crate::refuse;
use anstream::ColorChoice;
use clap::builder::Styles;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Args, Command, CommandFactory};
use slideway::fault::nearest;
use slideway::printable;
use slideway::template::TEMPLATES;
use std::borrow::Cow;
use std::ffi::OsString;
use std::io::{self, Write};

/// Says what is wrong with the arguments, or the help or version that they ask for, and ends the program.
///
/// A complaint quotes arguments as they are. If one of them is not printable, it is written without colours,
/// so that whatever is still in it comes from the arguments.
pub(crate) fn explain(error: &clap::Error) -> ! {
    let is_printable = |word: OsString| matches!(printable::line(&word.to_string_lossy()), Cow::Borrowed(_));
    if !error.use_stderr() {
        let printed = error.print().and_then(|()| io::stdout().flush());
        let told = Output::standard(Look { color: ColorChoice::Auto, verbose: false })
            .told(printed)
            .map(|()| Outcome::Done);
        let outcome = told.unwrap_or_else(|failure| refuse(&failure, ColorChoice::Auto));
        std::process::exit(i32::from(outcome as u8));
    }
    if let Some(text) = with_all_names(error) {
        complain(&text, ColorChoice::Auto);
        std::process::exit(error.exit_code());
    }
    if std::env::args_os().all(is_printable) {
        error.exit();
    }
    let plain = Arguments::command().styles(Styles::plain()).try_get_matches().err();
    let text = plain.map_or_else(String::new, |plain| plain.render().ansi().to_string());
    complain(printable::lines(&text).trim_end(), ColorChoice::Never);
    std::process::exit(error.exit_code());
}

/// Builds the complaint that there is no such command, or that a template has no such dimension, with a list
/// of those that there are. Returns `None` for other errors.
fn with_all_names(error: &clap::Error) -> Option<String> {
    let (command, path) = command(std::env::args_os());
    let quoted = |kind| match error.get(kind) {
        Some(ContextValue::String(name)) => Some(name.clone()),
        _ => None,
    };
    let (message, hint, all) = match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let name = quoted(ContextKind::InvalidSubcommand)?;
            let commands: Vec<&Command> =
                command.get_subcommands().filter(|one| !one.is_hide_set()).collect();
            let hint =
                meant(nearest(&name, commands.iter().map(|one| one.get_name())), "slideway help questions");
            let all = commands.iter().map(|one| row(one.get_name(), one.get_about())).collect();
            (format!("there is no command `{name}`"), hint, all)
        }
        // Whose options come behind its name.
        ErrorKind::UnknownArgument
            if path == ["new"] && is_of_all_templates(&quoted(ContextKind::InvalidArg)?) =>
        {
            let templates = TEMPLATES.iter().map(|one| (one.name.to_owned(), one.summary().to_owned()));
            let hint = "`slideway new NAME --output FILE` writes one of these".to_owned();
            ("which template? None is named".to_owned(), hint, templates.collect())
        }
        ErrorKind::MissingRequiredArgument if path == ["simulate"] && misses_the_end(error) => {
            let message = "until when? The end of the motion is missing".to_owned();
            let hint = "for instance `--until 1s`, and longer if it is still moving then".to_owned();
            return Some(note(&Note { message, hint: Some(hint) }));
        }
        ErrorKind::UnknownArgument if path.first().is_some_and(|first| first == "new") && path.len() == 2 => {
            let name = quoted(ContextKind::InvalidArg)?;
            let options: Vec<&Arg> = command.get_arguments().filter(|one| is_dimension(one)).collect();
            let bare = name.trim_start_matches('-').to_owned();
            let near = nearest(&bare, options.iter().filter_map(|one| one.get_long()));
            let hint =
                meant(near.map(|near| format!("--{near}")), &format!("slideway new {} --help", path[1]));
            let long = |one: &Arg| format!("--{}", one.get_long().unwrap_or_default());
            let all = options.iter().map(|one| row(&long(one), one.get_help())).collect();
            (format!("the template {} has no `{name}`", path[1]), hint, all)
        }
        ErrorKind::UnknownArgument if !path.is_empty() => {
            let name = quoted(ContextKind::InvalidArg)?;
            return name.starts_with('-').then(|| unknown_option(&command, &path.join(" "), &name));
        }
        ErrorKind::InvalidValue => {
            let (value, option) = (quoted(ContextKind::InvalidValue)?, quoted(ContextKind::InvalidArg)?);
            let Some(ContextValue::Strings(possible)) = error.get(ContextKind::ValidValue) else {
                return None;
            };
            let hint = (!possible.is_empty()).then(|| format!("write {}", one_of(possible)))?;
            let message = format!("`{value}` is no value of `{option}`");
            return Some(note(&Note { message, hint: Some(hint) }));
        }
        _ => return None,
    };
    Some(listing(&Note { message, hint: Some(hint) }, all))
}

/// Whether an option is one of every template, to say where the model goes.
fn is_of_all_templates(option: &str) -> bool {
    let name = option.trim_start_matches('-').split('=').next().unwrap_or_default();
    Destination::augment_args(Command::new("new")).get_arguments().any(|one| {
        one.get_long() == Some(name) || one.get_short().is_some_and(|short| name.starts_with(short))
    })
}

/// Whether `--until` alone is missing.
fn misses_the_end(error: &clap::Error) -> bool {
    let missing = error.get(ContextKind::InvalidArg);
    matches!(missing, Some(ContextValue::Strings(names)) if matches!(&names[..], [name] if name.starts_with("--until")))
}

/// The complaint that a question has no such option, with the one that is meant: another of this name, or one that has this
/// value.
fn unknown_option(command: &Command, path: &str, name: &str) -> String {
    let bare = name.trim_start_matches('-');
    let visible = || command.get_arguments().filter(|one| !one.is_hide_set());
    let has_value =
        |option: &&Arg| option.get_possible_values().iter().any(|value| value.matches(bare, true));
    let of_value = visible().find(has_value).and_then(Arg::get_long).map(|long| format!("--{long} {bare}"));
    let of_name = || nearest(bare, visible().filter_map(Arg::get_long)).map(|long| format!("--{long}"));
    let hint = match of_value.or_else(of_name) {
        _ if bare.starts_with(|first: char| first.is_ascii_digit()) => {
            format!("write a value that begins with a minus after `=`, as in `--margin={name}`")
        }
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("`slideway {path} --help` lists its options"),
    };
    note(&Note { message: format!("`slideway {path}` has no option `{name}`"), hint: Some(hint) })
}

/// "a, b or c"
fn one_of(values: &[String]) -> String {
    match values {
        [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        values => values.concat(),
    }
}

fn meant(near: Option<String>, help: &str) -> String {
    match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("`{help}` says more about these"),
    }
}

fn row(name: &str, meaning: Option<&clap::builder::StyledStr>) -> (String, String) {
    (name.to_owned(), meaning.map(ToString::to_string).unwrap_or_default())
}

/// Whether an option of a template stands for a dimension, not for what all commands have.
fn is_dimension(option: &Arg) -> bool {
    option.get_value_names().is_some_and(|names| names.iter().any(|name| name.as_str() == "VALUE"))
}

/// The command that is named, and the words that name it.
fn command(words: impl Iterator<Item = OsString>) -> (Command, Vec<String>) {
    let mut command = Arguments::command();
    let mut path = Vec::new();
    let mut is_value = false;
    for word in words.skip(1) {
        let word = word.to_string_lossy().into_owned();
        match command.find_subcommand(&word).cloned() {
            Some(found) => {
                command = found;
                path.push(word);
            }
            None if word.starts_with('-') || is_value => is_value = !is_value,
            None => break,
        }
    }
    (command, path)
}
