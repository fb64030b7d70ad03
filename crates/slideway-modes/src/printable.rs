//! Makes external text safe to show.
//!
//! A title or a name may contain characters that are invisible but have effects: escape sequences that move
//! the cursor of a terminal or change its title, marks that reverse the order of the following text, letters
//! without width. All text from a model, a file name or an argument that is shown to a person passes through
//! [`line()`] or [`lines`].

use std::borrow::Cow;
use std::fmt::Write;

/// A text on one line in which every character is visible: invisible characters are replaced by their
/// numbers, in the notation of TOML, and line ends by `\n` and `\r`.
///
/// Invisible characters are control characters except the tab (Unicode's category Cc), line and paragraph
/// separators, characters that Unicode calls ignorable by default (including all direction marks), and
/// noncharacters. Joiners and variation selectors are kept after a non-ASCII character, which they shape.
///
/// ```
/// use slideway_modes::printable::line;
/// assert_eq!(line("Schlitten φ_1"), "Schlitten φ_1");
/// assert_eq!(line("\u{1b}]0;all is well\u{7}"), r"\u001b]0;all is well\u0007");
/// assert_eq!(line("first\nsecond"), r"first\nsecond");
/// assert_eq!(line("mu\u{202e}\u{200b}"), r"mu\u202e\u200b");
/// ```
pub fn line(text: &str) -> Cow<'_, str> {
    shown(text, |character| match character {
        '\n' => Some(r"\n".to_owned()),
        '\r' => Some(r"\r".to_owned()),
        other => is_hidden(other).then(|| number(other)),
    })
}

/// A text of several lines, each shown as by [`line()`].
///
/// ```
/// assert_eq!(slideway_modes::printable::lines("first\r\nsecond\u{9b}2J\n"), "first\nsecond\\u009b2J\n");
/// ```
pub fn lines(text: &str) -> String {
    let lines = text.split('\n').map(|part| line(part.strip_suffix('\r').unwrap_or(part)));
    lines.collect::<Vec<_>>().join("\n")
}

/// JSON without invisible characters: they are written as JSON escapes, so the parsed text stays the same.
pub fn json(text: &str) -> Cow<'_, str> {
    shown(text, |character| match character {
        '\n' | '\r' => None,
        other if is_hidden(other) => {
            let units = other.encode_utf16(&mut [0; 2]).iter().fold(String::new(), |mut escaped, unit| {
                let _ = write!(escaped, "\\u{unit:04x}");
                escaped
            });
            Some(units)
        }
        _ => None,
    })
}

/// The text with characters replaced as `instead` says; joiners and variation selectors that shape the
/// character before them are kept.
fn shown(text: &str, instead: impl Fn(char) -> Option<String>) -> Cow<'_, str> {
    let mut out: Option<String> = None;
    let mut before = ' ';
    for (at, character) in text.char_indices() {
        let shapes = is_shaping(character) && !before.is_ascii() && !is_hidden(before);
        match (instead(character).filter(|_| !shapes), &mut out) {
            (Some(other), out) => out.get_or_insert_with(|| text[..at].to_owned()).push_str(&other),
            (None, Some(out)) => out.push(character),
            (None, None) => {}
        }
        before = character;
    }
    out.map_or(Cow::Borrowed(text), Cow::Owned)
}

/// The number of a character in the notation of TOML.
fn number(character: char) -> String {
    match u32::from(character) {
        number @ ..=0xffff => format!("\\u{number:04x}"),
        number => format!("\\U{number:08x}"),
    }
}

/// Whether a character affects the shape of the one before it.
fn is_shaping(character: char) -> bool {
    matches!(character, '\u{200c}' | '\u{200d}' | '\u{fe00}'..='\u{fe0f}')
}

/// Whether a character is invisible where it stands, or changes how others are shown: such are no letters of names. (Unicode 17: general
/// category Cc, Zl and Zp, the property `Default_Ignorable_Code_Point`, annotation marks, and noncharacters.)
pub fn is_hidden(character: char) -> bool {
    match character {
        '\t' => false,
        '\u{ad}'
        | '\u{34f}'
        | '\u{61c}'
        | '\u{115f}'..='\u{1160}'
        | '\u{17b4}'..='\u{17b5}'
        | '\u{180b}'..='\u{180f}'
        | '\u{200b}'..='\u{200f}'
        | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}'
        | '\u{3164}'
        | '\u{fdd0}'..='\u{fdef}'
        | '\u{fe00}'..='\u{fe0f}'
        | '\u{feff}'
        | '\u{ffa0}'
        | '\u{fff0}'..='\u{fffb}'
        | '\u{1bca0}'..='\u{1bca3}'
        | '\u{1d173}'..='\u{1d17a}'
        | '\u{e0000}'..='\u{e0fff}' => true,
        other => other.is_control() || u32::from(other) & 0xfffe == 0xfffe,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_control_and_no_mark_of_direction_is_left() {
        let all: Vec<char> = ('\0'..=char::MAX).collect();
        let marks =
            "\u{61c}\u{200e}\u{200f}\u{202a}\u{202b}\u{202c}\u{202d}\u{202e}\u{2066}\u{2067}\u{2068}\u{2069}";
        for character in all {
            let told = line(character.encode_utf8(&mut [0; 4])).into_owned();
            let is_bare = |c: char| (c.is_control() && c != '\t') || marks.contains(c);
            assert!(!told.contains(is_bare), "{:x}", u32::from(character));
            assert_eq!(line(&told), told, "what is shown stays as it is");
        }
    }

    #[test]
    fn what_shapes_a_character_stays() {
        for text in
            ["\u{2699}\u{fe0f} gear", "\u{645}\u{6cc}\u{200c}\u{634}\u{648}\u{62f}", "\u{5d0}\u{5d1}", "a\tb"]
        {
            assert_eq!(line(text), text);
        }
        // After ASCII, or after one another, they only hide.
        assert_eq!(line("mu\u{200d}"), r"mu\u200d");
        assert_eq!(line("\u{200b}\u{200d}"), r"\u200b\u200d");
    }

    #[test]
    fn json_is_read_as_it_was() {
        let text = "C1 \u{9b}2J, \u{202e} and \u{e0041}, \u{7f}";
        let written = serde_json::to_string(text).expect("a text");
        let told = json(&written);
        assert_eq!(told, r#""C1 \u009b2J, \u202e and \udb40\udc41, \u007f""#);
        assert_eq!(serde_json::from_str::<String>(&told).expect("JSON"), text);
    }
}
