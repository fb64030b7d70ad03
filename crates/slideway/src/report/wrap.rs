//! Lines in pieces that fit a width.

use crate::units::Unit;
use textwrap::core::Word;
use textwrap::{Options, WordSeparator, WordSplitter, wrap};

/// A line in pieces of a width at most, but for words that are longer; all but the first are indented. A
/// value stays with its name, and a number with its unit.
pub fn wrapped(line: &str, indent: &str, width: usize) -> Vec<String> {
    if line.is_empty() {
        return vec![String::new()];
    }
    let blanks = line.len() - line.trim_start().len();
    let options = Options::new(width)
        .initial_indent(&line[..blanks])
        .subsequent_indent(indent)
        .break_words(false)
        .word_separator(WordSeparator::Custom(words))
        .word_splitter(WordSplitter::NoHyphenation)
        .wrap_algorithm(textwrap::WrapAlgorithm::FirstFit);
    wrap(line.trim_start(), options).into_iter().map(std::borrow::Cow::into_owned).collect()
}

/// The pieces between which a line may be broken: words, but "mu = 0.3" is one, and "55 %", "2 N m", "(0, 1)".
fn words(line: &str) -> Box<dyn Iterator<Item = Word<'_>> + '_> {
    let mut pieces = Vec::new();
    let (mut start, mut end, mut last) = (0, 0, "=");
    let mut follows_number = false;
    for word in WordSeparator::AsciiSpace.find_words(line) {
        let is_unit = follows_number && is_unit(word.word);
        let is_second = is_first_component(last);
        if !(last == "=" || word.word == "=" || is_unit || is_second) {
            pieces.push(Word::from(&line[start..end]));
            start = end;
        }
        end += word.word.len() + word.whitespace.len();
        last = word.word;
        follows_number = is_unit && word.word.ends_with(char::is_alphanumeric) || is_number(word.word);
    }
    pieces.push(Word::from(&line[start..end]));
    Box::new(pieces.into_iter())
}

/// True for "0.3", "(2" and "-1e5".
fn is_number(word: &str) -> bool {
    let first = word.trim_start_matches(['(', '-']).chars().next();
    first.is_some_and(|first| first.is_ascii_digit()) && word.ends_with(|last: char| last.is_ascii_digit())
}

/// True for "(0," of the vector "(0, 1)".
fn is_first_component(word: &str) -> bool {
    word.starts_with('(') && word.strip_suffix(',').is_some_and(is_number)
}

/// True for units without blanks: "mm", "N/mm", "m/s^2", "%".
fn is_unit(word: &str) -> bool {
    let word = word.trim_end_matches(['.', ',', ';', ':', ')']);
    !word.is_empty() && Unit::of_text(word).is_some()
}
