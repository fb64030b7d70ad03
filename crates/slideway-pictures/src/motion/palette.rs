//! The colours of a GIF.

use std::collections::HashMap;

/// Red, green, blue.
pub(super) type Colour = [u8; 3];

/// At most so many colours; the last index of a GIF's table is left to pixels that do not change.
const MOST: usize = 255;

/// The colours that all frames share.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Palette {
    colours: Vec<Colour>,
}

impl Palette {
    /// The colours of `always`, fewer than 255, and of the counted ones the most frequent that are not within
    /// some distance of one taken before, in every channel; with a distance so small that 255 colours just
    /// suffice.
    pub(super) fn of(always: &[Colour], counts: &HashMap<Colour, u64>) -> Self {
        let mut ordered: Vec<(Colour, u64)> =
            counts.iter().map(|(colour, count)| (*colour, *count)).collect();
        ordered.sort_unstable_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));
        let mut distinct: Vec<Colour> = Vec::new();
        for colour in always {
            if !distinct.contains(colour) {
                distinct.push(*colour);
            }
        }
        let (mut near, mut far) = (0, u8::MAX);
        while near < far {
            let middle = near + (far - near) / 2;
            if cover(&distinct, &ordered, middle).is_some() {
                far = middle;
            } else {
                near = middle + 1;
            }
        }
        let colours = cover(&distinct, &ordered, near).unwrap_or(distinct);
        Self { colours }
    }

    /// The index of pixels that do not change, behind those of the colours.
    #[expect(clippy::cast_possible_truncation, reason = "at most 255")]
    pub(super) fn unchanged(&self) -> u8 {
        self.colours.len() as u8
    }

    /// The table of a GIF, with an entry for [`Self::unchanged`].
    pub(super) fn table(&self) -> Vec<u8> {
        self.colours.iter().chain(&[[0; 3]]).flatten().copied().collect()
    }

    /// The index of the nearest colour, the first of equally near ones.
    #[expect(clippy::cast_possible_truncation, reason = "at most 255")]
    pub(super) fn nearest(&self, colour: Colour) -> u8 {
        let squared = |other: &Colour| -> u32 {
            (0..3).map(|channel| u32::from(colour[channel].abs_diff(other[channel])).pow(2)).sum()
        };
        (0..self.colours.len()).min_by_key(|index| squared(&self.colours[*index])).unwrap_or(0) as u8
    }
}

/// Colours of which one is within a distance of each counted colour, in every channel; none if it takes too
/// many.
fn cover(always: &[Colour], ordered: &[(Colour, u64)], distance: u8) -> Option<Vec<Colour>> {
    let mut taken = always.to_vec();
    for (colour, _) in ordered {
        let is_near =
            |other: &Colour| (0..3).all(|channel| colour[channel].abs_diff(other[channel]) <= distance);
        if !taken.iter().any(is_near) {
            if taken.len() == MOST {
                return None;
            }
            taken.push(*colour);
        }
    }
    Some(taken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_stay_as_they_are() {
        let counts: HashMap<Colour, u64> = (0..200).map(|grey| ([grey; 3], u64::from(grey))).collect();
        let palette = Palette::of(&[[255, 0, 0]], &counts);
        assert_eq!(palette.unchanged(), 201);
        for colour in counts.keys() {
            assert_eq!(palette.colours[usize::from(palette.nearest(*colour))], *colour);
        }
    }

    /// 1000 colours on a grid of spacing 25. Below that distance each needs an entry of its own; with it
    /// every second one in each direction suffices, 125. A taken colour within 25 in every channel is within
    /// 43.3, and so is the nearest; on the grid its channels differ by 25 at most.
    #[test]
    fn many_colours_have_one_nearby() {
        let grid = (0..1000_u64).map(|number| {
            let channel = |power: u32| u8::try_from(number / 10_u64.pow(power) % 10 * 25).expect("below 226");
            ([channel(0), channel(1), channel(2)], 1 + number)
        });
        let counts: HashMap<Colour, u64> = grid.collect();
        let rare = [0, 0, 0];
        let palette = Palette::of(&[rare], &counts);
        assert!(palette.unchanged() < u8::MAX, "{}", palette.unchanged());
        assert_eq!(palette.colours[0], rare);
        assert_eq!(palette.colours[1], [225; 3], "the most frequent");
        for colour in counts.keys() {
            let near = palette.colours[usize::from(palette.nearest(*colour))];
            assert!(
                (0..3).all(|channel| colour[channel].abs_diff(near[channel]) <= 25),
                "{colour:?}: {near:?}"
            );
        }
    }
}
