//! What is chosen by a word: the command line and Python take the same words.

/// One of a few, chosen by its word.
///
/// ```
/// use slideway::choice::Choice;
/// use slideway::map::ColourBy;
///
/// assert_eq!(ColourBy::of_word("jam"), Some(ColourBy::Jam));
/// assert_eq!(ColourBy::Jam.word(), "jam");
/// assert_eq!(ColourBy::of_word("colour"), None);
/// ```
pub trait Choice: Copy + PartialEq + 'static {
    /// All of them, each with its word and what it means.
    const CHOICES: &'static [(Self, &'static str, &'static str)];

    /// Its word.
    fn word(self) -> &'static str {
        Self::CHOICES.iter().find(|(choice, ..)| *choice == self).map_or("", |(_, word, _)| word)
    }

    /// The one of this word, written in small letters or capitals.
    fn of_word(word: &str) -> Option<Self> {
        let found = Self::CHOICES.iter().find(|(_, known, _)| known.eq_ignore_ascii_case(word));
        found.map(|(choice, ..)| *choice)
    }
}
