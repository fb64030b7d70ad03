//! Labels above the frame that stand beside vertical lines like flags, without touching each other.

use super::figure::MarkedValue;
use super::svg::width;

/// Space between a line and its label, and behind a label (px).
const GAP: f64 = 4.0;

/// A label and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Flag<'f> {
    pub(super) value: &'f MarkedValue,
    /// Place of its line.
    pub(super) x: f64,
    /// Where the text begins.
    pub(super) text: f64,
    /// Row above the frame, from 0.
    pub(super) row: usize,
}

impl Flag<'_> {
    fn end(&self, size: f64) -> f64 {
        self.text + width(&self.value.label, size)
    }

    /// Whether the label stands to the right or to the left of its line, not above it.
    pub(super) fn is_beside(&self, size: f64) -> bool {
        self.text > self.x || self.end(size) < self.x
    }

    /// Whether the line of another, on its way to its own label, runs through this label.
    fn is_crossed_by(&self, other: &Self, size: f64) -> bool {
        other.row >= self.row && self.text - GAP < other.x && other.x < self.end(size) + GAP
    }

    fn touches(&self, other: &Self, size: f64) -> bool {
        self.row == other.row && self.text < other.end(size) + GAP && other.text < self.end(size) + GAP
    }
}

/// Places labels to the right of their lines, from right to left, and before that to the left of them those
/// that would leave the picture or stand among such, from left to right: a line that rises to a higher row
/// then passes the labels that were placed before. Each has the lowest row in which least is crossed.
pub(super) fn flags(mut values: Vec<(f64, &MarkedValue)>, right: f64, size: f64) -> Vec<Flag<'_>> {
    values.sort_by(|one, other| other.0.total_cmp(&one.0));
    let space = |value: &MarkedValue| GAP + width(&value.label, size);
    let fits = |(x, value): &(f64, &MarkedValue)| x + space(value) <= right;
    let (mut to_the_right, mut to_the_left): (Vec<_>, Vec<_>) = values.into_iter().partition(fits);
    // From right to left: what stands within labels that reach to the left does as they do.
    let mut begin = to_the_left.iter().map(|(x, value)| x - space(value)).fold(f64::INFINITY, f64::min);
    to_the_right.retain(|&(x, value)| {
        let joins = x + GAP > begin && x - space(value) >= 0.0;
        if joins {
            begin = begin.min(x - space(value));
            to_the_left.push((x, value));
        }
        !joins
    });
    to_the_left.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut flags: Vec<Flag<'_>> = Vec::new();
    for (x, value) in to_the_left {
        let space = width(&value.label, size);
        let text = if x - GAP - space >= 0.0 { x - GAP - space } else { right - space };
        place(&Flag { value, x, text, row: 0 }, &mut flags, size);
    }
    for (x, value) in to_the_right {
        place(&Flag { value, x, text: x + GAP, row: 0 }, &mut flags, size);
    }
    flags
}

/// Adds a label in the lowest row in which it touches none and least is crossed.
fn place<'f>(flag: &Flag<'f>, flags: &mut Vec<Flag<'f>>, size: f64) {
    let rows = flags.iter().map(|flag| flag.row + 1).max().unwrap_or(0);
    let crossings = |flag: &Flag<'f>| {
        let of = |other: &Flag<'f>| {
            usize::from(flag.is_crossed_by(other, size)) + usize::from(other.is_crossed_by(flag, size))
        };
        flags.iter().map(of).sum::<usize>()
    };
    let best = (0..=rows)
        .map(|row| Flag { row, ..flag.clone() })
        .filter(|flag| !flags.iter().any(|other| flag.touches(other, size)))
        .min_by_key(crossings);
    flags.extend(best);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_touch_each_other_or_lines() {
        let labels = ["a long label here", "short", "another label", "the last"];
        assert_eq!(rows_of([100.0, 130.0, 300.0, 690.0], labels), [0, 0, 0, 1]);
        // Close to the right edge: the labels stand to the left of their lines, each above those on its left.
        assert_eq!(
            rows_of([640.0, 650.0, 660.0, 690.0], labels.map(|_| "much too long for this place")),
            [0, 1, 2, 3]
        );
        // A short one among them does as they do.
        assert_eq!(rows_of([500.0, 650.0, 660.0, 690.0], labels), [0, 1, 2, 0]);
    }

    /// The rows in the order in which the labels are placed, after a look at all pairs.
    fn rows_of(places: [f64; 4], labels: [&str; 4]) -> Vec<usize> {
        let value = |label: &str| MarkedValue { at: 0.0, label: label.to_owned(), asymptote: false };
        let labels = labels.map(value);
        let flags = flags(places.into_iter().zip(&labels).collect(), 700.0, 12.0);
        for one in &flags {
            let end = one.text + width(&one.value.label, 12.0);
            assert!(end <= 700.0);
            for other in flags.iter().filter(|other| other.x != one.x) {
                let apart = other.text >= end || other.text + width(&other.value.label, 12.0) <= one.text;
                assert!(one.row != other.row || apart, "{one:?} {other:?}");
                let crossed = other.row > one.row && one.text < other.x && other.x < end;
                assert!(!crossed, "the line of {other:?} crosses {one:?}");
            }
        }
        flags.iter().map(|flag| flag.row).collect()
    }
}
