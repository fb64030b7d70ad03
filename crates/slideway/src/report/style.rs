//! The look of a report as text.

/// How the text of a report looks: with colours or without, how wide, with or without the details.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Style {
    /// True if it has ANSI colours, for terminals.
    pub colour: bool,
    /// True if it holds the details: signs, determinants, residuals, how an answer was found.
    pub verbose: bool,
    /// Columns of a line; prose and tables are wrapped to fit.
    pub width: usize,
}

impl Style {
    /// Without colours and details, in lines of 100 columns: for files and pipes.
    pub const PLAIN: Self = Self { colour: false, verbose: false, width: 100 };

    /// Lines are never narrower: a terminal of ten columns gets longer ones.
    const NARROWEST: usize = 40;

    /// With ANSI colours, or without.
    #[must_use]
    pub const fn colour(self, colour: bool) -> Self {
        Self { colour, ..self }
    }

    /// With the details, or without.
    #[must_use]
    pub const fn verbose(self, verbose: bool) -> Self {
        Self { verbose, ..self }
    }

    /// In lines of so many columns, at least 40.
    #[must_use]
    pub const fn width(self, width: usize) -> Self {
        Self { width: if width < Self::NARROWEST { Self::NARROWEST } else { width }, ..self }
    }
}

impl Default for Style {
    fn default() -> Self {
        Self::PLAIN
    }
}
