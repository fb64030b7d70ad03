//! Options that are chosen by a word: the command line and Python take the same words.

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

/// Declares an enumeration whose members have a word each in tables.
macro_rules! worded {
    ($(#[$about:meta])* pub enum $name:ident { $($(#[$meaning:meta])* $member:ident = $word:literal),+ $(,)? }) => {
        $(#[$about])*
        pub enum $name {
            $($(#[$meaning])* $member),+
        }

        impl $name {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$member),+];

            /// Its word in tables.
            pub fn word(self) -> &'static str {
                match self {
                    $(Self::$member => $word),+
                }
            }

            /// The one of this word.
            pub fn of_word(word: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|member| member.word() == word)
            }
        }
    };
}
pub(crate) use worded;

/// Declares the kinds of another enumeration: its members, of the same names, without their values.
macro_rules! kinds {
    ($whole:ident => $(#[$about:meta])* pub enum $name:ident { $($(#[$meaning:meta])* $member:ident),+ $(,)? }) => {
        $(#[$about])*
        pub enum $name {
            $($(#[$meaning])* $member),+
        }

        impl $whole {
            /// Its name in reports.
            pub fn kind(&self) -> $name {
                match self {
                    $(Self::$member { .. } => $name::$member),+
                }
            }
        }
    };
}
pub(crate) use kinds;
