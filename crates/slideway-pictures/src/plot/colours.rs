//! Colours of contact modes: a mode has the same colour in every plot of a mechanism.

/// The colours of the series that modes have before any is used twice; the grey one behind them is for what is no
/// mode.
const OF_MODES: usize = 6;

/// The colours of the modes of a figure.
#[derive(Debug, Default)]
pub(super) struct ModeColours {
    given: Vec<(String, usize)>,
}

impl ModeColours {
    /// The colour of a mode, as an index into the series of a theme: its signs as a binary number, "-" being 1; where
    /// another mode of the figure has that colour the next one that is free.
    pub(super) fn of(&mut self, pattern: &str) -> usize {
        if let Some((_, colour)) = self.given.iter().find(|(known, _)| known == pattern) {
            return *colour;
        }
        let digit = |number: usize, sign: char| (2 * number + usize::from(sign == '-')) % OF_MODES;
        let wanted = pattern.chars().fold(0, digit);
        let is_free = |colour: &usize| self.given.iter().all(|(_, other)| other != colour);
        let mut all = (0..OF_MODES).map(|step| (wanted + step) % OF_MODES);
        let colour = all.find(is_free).unwrap_or(self.given.len());
        self.given.push((pattern.to_owned(), colour));
        colour
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mode_keeps_its_colour_whatever_else_is_shown() {
        let of = |patterns: &[&str], wanted: &str| {
            let mut colours = ModeColours::default();
            patterns.iter().for_each(|pattern| {
                colours.of(pattern);
            });
            colours.of(wanted)
        };
        assert_eq!(of(&["+-", "++"], "-+"), of(&["-+"], "-+"));
        assert_eq!(of(&[], "-+"), of(&["--", "+-"], "-+"));
        assert_eq!([of(&[], "++"), of(&[], "+-"), of(&[], "-+"), of(&[], "--")], [0, 1, 2, 3]);
    }

    #[test]
    fn no_two_modes_of_a_figure_share_a_colour() {
        let mut colours = ModeColours::default();
        let patterns = ["+++", "--+", "---", "+-+", "0++", "+-0", "-++"];
        let found: Vec<usize> = patterns.iter().map(|pattern| colours.of(pattern)).collect();
        let mut distinct = found.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), patterns.len(), "{found:?}");
    }
}
