//! Faults as the page shows them: the words of the command line, and places that an editor understands.

use crate::question::Asked;
use serde::Serialize;
use slideway::fault::{Fault, FaultKind, Faults, Source};
use slideway::printable;

/// Maximum number of faults that are reported.
const MOST: usize = 200;

/// A fault, or something that is perhaps not meant.
#[derive(Debug, Serialize)]
pub(crate) struct ToldFault {
    /// The fault in words.
    message: String,
    /// The advice what to do about it, if there is any.
    hint: Option<String>,
    /// Whether it does not stand in the way.
    is_warning: bool,
    /// Where it is.
    place: Option<ToldPlace>,
}

/// Where a fault is: counted in UTF-16 units, as programs of a browser count characters.
#[derive(Debug, Serialize)]
struct ToldPlace {
    /// "model", "setting" or "argument".
    text: &'static str,
    /// Which setting it is, counted from 0.
    setting: Option<usize>,
    from: usize,
    to: usize,
}

/// The faults of a question, in the order of their places.
pub(crate) fn told(faults: &Faults, asked: &Asked) -> Vec<ToldFault> {
    faults.sorted().into_iter().take(MOST).map(|fault| ToldFault::of(fault, asked)).collect()
}

impl ToldFault {
    /// Builds a fault of the input as a whole.
    pub(crate) fn general(message: &str) -> Self {
        Self { message: printable::line(message).into_owned(), hint: None, is_warning: false, place: None }
    }

    fn of(fault: &Fault, asked: &Asked) -> Self {
        let line = |text: &str| printable::line(text).into_owned();
        Self {
            message: line(&fault.kind.to_string()),
            hint: fault.kind.hint().as_deref().map(line),
            is_warning: matches!(fault.kind, FaultKind::Doubt(_)),
            place: ToldPlace::of(fault, asked),
        }
    }
}

impl ToldPlace {
    fn of(fault: &Fault, asked: &Asked) -> Option<Self> {
        let place = fault.place.as_ref()?;
        let (text, setting, of) = match &place.source {
            Source::Model => ("model", None, asked.text.clone()),
            Source::Setting(index) => ("setting", Some(*index), asked.settings.entries().get(*index)?.text()),
            Source::Argument(text) => ("argument", None, text.to_string()),
        };
        let [from, to] = [place.span.start, place.span.end].map(|byte| utf16(&of, byte));
        Some(Self { text, setting, from, to: to.max(from) })
    }
}

/// UTF-16 units before a byte of a text.
fn utf16(text: &str, byte: usize) -> usize {
    text[..text.floor_char_boundary(byte)].encode_utf16().count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use slideway::model::Settings;

    /// Before the misspelt unit stand two characters of two bytes and one of four, which is two UTF-16 units.
    #[test]
    fn places_are_counted_as_browsers_count() {
        let text = "# öü 𝛼\n[parameters]\nL = \"3 mn\"\n";
        let asked = Asked { text: text.to_owned(), settings: Settings::default() };
        let faults = asked.model().expect_err("a unit is misspelt");
        let found = told(&faults, &asked);
        let place = found.iter().find_map(|fault| fault.place.as_ref()).expect("it has a place");
        let units: Vec<u16> = text.encode_utf16().collect();
        assert_eq!(String::from_utf16_lossy(&units[place.from..place.to]), "mn");
    }
}
