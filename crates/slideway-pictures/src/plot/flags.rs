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

/// Places labels from right to left, each in the lowest row that is free: a line that rises to a higher row passes on the
/// left of all labels that were placed before.
pub(super) fn flags(mut values: Vec<(f64, &MarkedValue)>, right: f64, size: f64) -> Vec<Flag<'_>> {
    values.sort_by(|one, other| other.0.total_cmp(&one.0));
    let mut flags: Vec<Flag<'_>> = Vec::new();
    let mut begins: Vec<f64> = Vec::new();
    for (x, value) in values {
        let space = width(&value.label, size);
        // At the right edge the label ends there and stands above its line.
        let text = (x + GAP).min(right - space);
        let row = begins.iter().position(|&begin| text + space + GAP <= begin).unwrap_or(begins.len());
        let begin = text.min(x);
        // Rows below are closed on the right of this line, so that no later label is crossed by it.
        if row == begins.len() {
            begins.push(begin);
        }
        for below in &mut begins[..=row] {
            *below = below.min(begin);
        }
        flags.push(Flag { value, x, text, row });
    }
    flags
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_touch_each_other_or_lines() {
        let value = |label: &str| MarkedValue { at: 0.0, label: label.to_owned(), asymptote: false };
        let labels = [value("a long label here"), value("short"), value("another label"), value("the last")];
        let places = [100.0, 130.0, 300.0, 690.0];
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
        assert_eq!(flags.iter().map(|flag| flag.row).collect::<Vec<_>>(), [0, 0, 0, 1]);
    }
}
