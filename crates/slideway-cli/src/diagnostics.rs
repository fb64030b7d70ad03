//! Faults as a person reads them: the message, the place with the text underlined, and the hint.
//!
//! They tell of names and texts from elsewhere. All of them become printable here, before colours come in.

use crate::faulty_input::FaultyInput;
use annotate_snippets::{
    Annotation, AnnotationKind, Group, Level, Message, Origin, Renderer, Snippet, Title,
};
use slideway::fault::{Fault, FaultKind, Source};
use slideway::model::SettingKind;
use slideway::printable;
use slideway::raw_problem::{RawFault, RawFaults};
use std::ops::Range;

/// At most so many faults are shown in full.
const SHOWN: usize = 50;

/// A message without a place.
pub(crate) struct Note {
    /// What is wrong.
    pub(crate) message: String,
    /// What to do about it.
    pub(crate) hint: Option<String>,
}

/// The message with its hint; coloured, for a stream that strips colours where they are not wanted.
pub(crate) fn note(note: &Note) -> String {
    let group = Group::with_title(title(&note.message)).elements(note.hint.as_deref().map(help));
    Renderer::styled().render(&[group])
}

/// What is wrong.
fn title(message: &str) -> Title<'static> {
    Level::ERROR.primary_title(printable::line(message).into_owned())
}

/// What to do about it.
fn help(hint: &str) -> Message<'static> {
    Level::HELP.message(printable::line(hint).into_owned())
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
    let mut parts: Vec<String> =
        sorted.iter().take(SHOWN).map(|fault| renderer.render(&[texts.group(fault)])).collect();
    parts.push(renderer.render(&[Group::with_title(title(&closing_line(&sorted, &texts.model_name)))]));
    parts.join("\n\n")
}

/// All faults of a problem given by matrices, and how many there are.
pub(crate) fn raw_faults(name: &str, faults: &RawFaults) -> String {
    let renderer = Renderer::styled();
    let part = |fault: &RawFault| {
        let group = Group::with_title(title(&fault.to_string())).element(origin(name));
        renderer.render(&[group.elements(fault.hint().as_deref().map(help))])
    };
    let mut parts: Vec<String> = faults.iter().take(SHOWN).map(part).collect();
    let count = faults.iter().len();
    let more = if count > SHOWN { format!(", of which {SHOWN} are shown") } else { String::new() };
    let count = if count == 1 { "1 fault".to_owned() } else { format!("{count} faults") };
    parts.push(renderer.render(&[Group::with_title(title(&format!("{count} in {name}{more}")))]));
    parts.join("\n\n")
}

/// The texts in which faults have their places.
struct Texts {
    model_name: String,
    model: String,
    /// Each setting as it stands on the command line, and where its own text begins there.
    settings: Vec<(String, usize)>,
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

    fn group(&self, fault: &Fault) -> Group<'static> {
        let group = Group::with_title(title(&fault.kind.to_string()));
        let group = match &fault.place {
            Some(place) => {
                let (path, text, offset) = match place.source {
                    Source::Model => (self.model_name.as_str(), self.model.as_str(), 0),
                    Source::Setting(index) => {
                        let (text, offset) = &self.settings[index];
                        ("command line", text.as_str(), *offset)
                    }
                };
                let span = within(text, &(place.span.start + offset..place.span.end + offset));
                group.element(snippet(text, span).path(printable::line(path).into_owned()))
            }
            None if on_command_line(fault) => group,
            None => group.element(origin(&self.model_name)),
        };
        group.elements(fault.kind.hint().as_deref().map(help))
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

fn on_command_line(fault: &Fault) -> bool {
    match &fault.place {
        Some(place) => place.source != Source::Model,
        None => matches!(fault.kind, FaultKind::MalformedSetting { .. } | FaultKind::Axis { .. }),
    }
}

/// "3 faults in drawer.toml"
fn closing_line(faults: &[&Fault], model: &str) -> String {
    let in_settings = faults.iter().filter(|fault| on_command_line(fault)).count();
    let count = if faults.len() == 1 { "1 fault".to_owned() } else { format!("{} faults", faults.len()) };
    let place = match in_settings {
        0 => format!("in {model}"),
        all if all == faults.len() => "on the command line".to_owned(),
        _ => format!("in {model} and on the command line"),
    };
    let more = if faults.len() > SHOWN { format!(", of which {SHOWN} are shown") } else { String::new() };
    format!("{count} {place}{more}")
}
