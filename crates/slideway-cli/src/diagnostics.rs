//! Faults as a person reads them: the message, the place with the text underlined, and the hint.
//!
//! They tell of names and texts from elsewhere. All of them become printable here, before colours come in.

use crate::columns::{self, wrapped};
use crate::faulty_input::FaultyInput;
use annotate_snippets::{
    Annotation, AnnotationKind, Group, Level, Message, Origin, Renderer, Snippet, Title,
};
use slideway::fault::{Fault, FaultKind, Place, Source};
use slideway::model::SettingKind;
use slideway::printable;
use slideway::raw_problem::{RawFault, RawFaults};
use slideway::report::Style;
use std::borrow::Cow;
use std::io;
use std::ops::Range;
use terminal_size::{Width, terminal_size_of};

/// At most so many faults are shown in full.
const SHOWN: usize = 50;
/// Columns before a message: `warning: `.
const TITLE: usize = 9;
/// Columns before a hint: ` = help: ` behind the number of a line.
const HINT: usize = 12;
/// How the texts of arguments are called.
const COMMAND_LINE: &str = "command line";

/// A message without a place.
pub(crate) struct Note {
    /// The fault in words.
    pub(crate) message: String,
    /// The advice what to do about it, if there is any.
    pub(crate) hint: Option<String>,
}

/// The message with its hint; coloured, for a stream that strips colours where they are not wanted.
pub(crate) fn note(note: &Note) -> String {
    let group =
        Group::with_title(title(Level::ERROR, &note.message)).elements(note.hint.as_deref().map(help));
    Renderer::styled().render(&[group])
}

/// Builds the line that says what is wrong.
fn title(level: Level<'static>, message: &str) -> Title<'static> {
    let width = terminal_width().unwrap_or(usize::MAX);
    level.primary_title(in_lines(message, width.saturating_sub(TITLE)))
}

/// Builds the line that says what to do about it.
fn help(hint: &str) -> Message<'static> {
    let width = terminal_width().unwrap_or(Style::PLAIN.width);
    Level::HELP.message(in_lines(hint, width.saturating_sub(HINT)))
}

/// Returns the width of the terminal, none elsewhere: a message stays on its line where programs look for it.
fn terminal_width() -> Option<usize> {
    terminal_size_of(io::stderr()).map(|(Width(columns), _)| usize::from(columns)).filter(|width| *width > 0)
}

/// A text on as many lines of at most this width as it needs.
fn in_lines(text: &str, width: usize) -> String {
    wrapped(&printable::line(text), width).join("\n")
}

/// Where it is.
fn origin(name: &str) -> Origin<'static> {
    Origin::path(printable::line(name).into_owned())
}

/// All faults of an input in the order of their places, and how many there are.
pub(crate) fn faults(faulty: &FaultyInput) -> String {
    let texts = Texts::of(faulty);
    let sorted = faulty.faults.sorted();
    let renderer = Renderer::styled();
    // Warnings beside faults may be the reason for them; by themselves they have been made faults.
    let (warnings, others): (Vec<&Fault>, Vec<&Fault>) = sorted.iter().partition(|fault| is_warning(fault));
    let counted = if others.is_empty() { warnings } else { others };
    let part = |fault: &&Fault| {
        let level = if counted.contains(fault) { Level::ERROR } else { Level::WARNING };
        renderer.render(&[texts.group(fault, level)])
    };
    let mut parts: Vec<String> = sorted.iter().take(SHOWN).map(part).collect();
    let closing = closing_line(&counted, &texts.model_name);
    parts.push(renderer.render(&[Group::with_title(title(Level::ERROR, &closing))]));
    parts.join("\n\n")
}

/// All warnings of an input in the order of their places.
pub(crate) fn warnings(doubtful: &FaultyInput) -> String {
    let texts = Texts::of(doubtful);
    let renderer = Renderer::styled();
    let part = |fault: &&Fault| renderer.render(&[texts.group(fault, Level::WARNING)]) + "\n";
    doubtful.faults.sorted().iter().map(part).collect::<Vec<_>>().join("\n")
}

/// All faults of a problem given by matrices, and how many there are.
pub(crate) fn raw_faults(name: &str, faults: &RawFaults) -> String {
    let renderer = Renderer::styled();
    let part = |fault: &RawFault| {
        let group = Group::with_title(title(Level::ERROR, &fault.to_string())).element(origin(name));
        renderer.render(&[group.elements(fault.hint().as_deref().map(help))])
    };
    let mut parts: Vec<String> = faults.iter().take(SHOWN).map(part).collect();
    let count = faults.iter().len();
    let more = if count > SHOWN { format!(", of which {SHOWN} are shown") } else { String::new() };
    let count = if count == 1 { "1 fault".to_owned() } else { format!("{count} faults") };
    parts.push(
        renderer.render(&[Group::with_title(title(Level::ERROR, &format!("{count} in {name}{more}")))]),
    );
    parts.join("\n\n")
}

/// The texts in which faults have their places.
struct Texts {
    model_name: String,
    model: String,
    /// Each setting as it stands on the command line, and where its own text begins there.
    settings: Vec<Shown>,
}

impl Texts {
    fn of(faulty: &FaultyInput) -> Self {
        let settings = faulty.settings.entries().iter().map(|setting| {
            let option = match setting.kind {
                SettingKind::Parameter => faulty.parameter_option,
                SettingKind::Position => "--at ",
                SettingKind::Rate => "--rate ",
                // Its text is time=VALUE.
                _ => "--",
            };
            (format!("{option}{}", setting.text()), option.len())
        });
        Self { model_name: faulty.name.clone(), model: faulty.text.clone(), settings: settings.collect() }
    }

    fn group(&self, fault: &Fault, level: Level<'static>) -> Group<'static> {
        let group = Group::with_title(title(level, &fault.kind.to_string()));
        let group = match self.shown(fault) {
            Some((path, text, span)) => {
                let span = within(&text, &span);
                group.element(snippet(&text, span).path(printable::line(path).into_owned()))
            }
            None => group.element(origin(&self.model_name)),
        };
        group.elements(fault.kind.hint().as_deref().map(help))
    }

    /// The name of the text in which a fault lies, the text, and the place in it; none if it has none.
    fn shown(&self, fault: &Fault) -> Option<(&str, Cow<'_, str>, Range<usize>)> {
        let behind = |offset: usize, span: &Range<usize>| span.start + offset..span.end + offset;
        if let Some(((text, offset), span)) = argument(fault) {
            return Some((COMMAND_LINE, text.into(), behind(offset, &span)));
        }
        let Place { source, span } = fault.place.as_ref()?;
        if let Source::Setting(index) = source {
            let (text, offset) = self.settings.get(*index)?;
            return Some((COMMAND_LINE, text.as_str().into(), behind(*offset, span)));
        }
        Some((self.model_name.as_str(), self.model.as_str().into(), span.clone()))
    }
}

/// The lines around a span, which is underlined; only these, since a file may be long and have many faults.
fn snippet(text: &str, span: Range<usize>) -> Snippet<'static, Annotation<'static>> {
    let start = text[..span.start].rfind('\n').map_or(0, |end| end + 1);
    let end = text[span.end..].find('\n').map_or(text.len(), |length| span.end + length);
    let line = text[..start].matches('\n').count() + 1;
    let [before, within, after] =
        [&text[start..span.start], &text[span.clone()], &text[span.end..end]].map(printable::lines);
    let underlined = AnnotationKind::Primary.span(before.len()..before.len() + within.len());
    Snippet::source(before + &within + &after).line_start(line).annotation(underlined)
}

/// `span` widened to whole characters of `text`.
fn within(text: &str, span: &Range<usize>) -> Range<usize> {
    let start = text.floor_char_boundary(span.start);
    let end = text.ceil_char_boundary(span.end.max(span.start));
    start..end
}

fn is_warning(fault: &Fault) -> bool {
    matches!(fault.kind, FaultKind::Doubt(_))
}

fn on_command_line(fault: &Fault) -> bool {
    argument(fault).is_some() || fault.place.as_ref().is_some_and(|place| place.source != Source::Model)
}

/// An argument with its option, and where its own text begins there.
type Shown = (String, usize);

/// The argument in which a fault lies that is no setting, and the place in it: that of the fault, or a name
/// without a place that stands on the command line by itself, such as that of a load.
fn argument(fault: &Fault) -> Option<(Shown, Range<usize>)> {
    match (&fault.place, &fault.kind) {
        (Some(Place { source: Source::Argument(text), span }), _) => {
            Some((with_option(text).unwrap_or_else(|| (text.to_string(), 0)), span.clone()))
        }
        (None, FaultKind::UnknownName { name, .. }) => Some((with_option(name)?, 0..name.len())),
        _ => None,
    }
}

/// The argument of the command line that says the same, blanks aside, with the option before it.
fn with_option(text: &str) -> Option<Shown> {
    let bare = |text: &str| text.split_whitespace().collect::<String>();
    let arguments: Vec<String> =
        std::env::args_os().map(|argument| argument.to_string_lossy().into_owned()).collect();
    let option = arguments.windows(2).find_map(|pair| {
        let joined = pair[1].split_once('=').filter(|(option, _)| option.starts_with("--"));
        match joined {
            Some((option, value)) if bare(value) == bare(text) => Some(option.to_owned()),
            _ if pair[0].starts_with('-') && bare(&pair[1]) == bare(text) => Some(pair[0].clone()),
            _ => None,
        }
    })?;
    Some((format!("{option} {text}"), option.len() + 1))
}

/// "3 faults in drawer.toml"
fn closing_line(faults: &[&Fault], model: &str) -> String {
    let in_settings = faults.iter().filter(|fault| on_command_line(fault)).count();
    let are_warnings = faults.iter().all(|fault| is_warning(fault));
    let [one, several] = if are_warnings { ["warning", "warnings"] } else { ["fault", "faults"] };
    let count = if faults.len() == 1 { format!("1 {one}") } else { format!("{} {several}", faults.len()) };
    let strict = match faults.len() {
        _ if !are_warnings => "",
        1 => ", treated as an error",
        _ => ", treated as errors",
    };
    let place = match in_settings {
        0 => format!("in {model}"),
        all if all == faults.len() => "on the command line".to_owned(),
        _ => format!("in {model} and on the command line"),
    };
    let more = if faults.len() > SHOWN { format!(", of which {SHOWN} are shown") } else { String::new() };
    format!("{count} {place}{more}{strict}")
}

/// A complaint, and below it a list of what there is.
pub(crate) fn listing(note: &Note, all: Vec<(String, String)>) -> String {
    let all: Vec<(String, String)> = all
        .into_iter()
        .map(|(name, meaning)| (printable::line(&name).into_owned(), printable::line(&meaning).into_owned()))
        .collect();
    format!("{}\n\n{}", self::note(note), columns::list(&all, 2).trim_end())
}
