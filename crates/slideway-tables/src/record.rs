//! Rows as records of a fixed size, little-endian: the elements of a NumPy array with named fields, and what
//! a Parquet file is made from.

use crate::Layout;
use slideway::report::Verdict;
use slideway::report::defined;
use slideway::sweep::{Breakpoint, PointStatus, RowKind, Rows};

/// A field of a record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) meaning: Meaning,
    pub(crate) kind: FieldKind,
}

/// The quantity of a row that a field holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meaning {
    Point,
    /// One of the row's numbers.
    Number(usize),
    Breakpoint,
    Status,
    Solutions,
    GapStates,
    Rejected,
    Kind,
    Branch,
    DeterminantSign,
    Pattern,
    Attainability,
}

/// The type of a field. It holds no word as an empty word, no branch as 0, and no number as not a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FieldKind {
    /// The number of a point: 8 bytes.
    Point,
    /// How many there are: 4 bytes.
    Count,
    /// The number of a branch, from 1: 4 bytes.
    Branch,
    /// A number: 8 bytes.
    Number,
    /// A word of at most so many bytes, filled with zeros.
    Word(usize),
}

impl FieldKind {
    /// Bytes of the field.
    pub(crate) fn size(self) -> usize {
        match self {
            Self::Point | Self::Number => 8,
            Self::Count | Self::Branch => 4,
            Self::Word(size) => size,
        }
    }
}

/// The fields of a record in their order.
pub(crate) fn fields(layout: &Layout) -> Vec<Field> {
    let field = |name: &str, meaning, kind| Field { name: name.to_owned(), meaning, kind };
    let number = |(at, (name, _)): (usize, &(String, &'static str))| {
        field(name, Meaning::Number(at), FieldKind::Number)
    };
    let word = |(name, meaning): (&str, Meaning)| field(name, meaning, FieldKind::Word(longest(meaning)));
    let count = |(name, meaning)| field(name, meaning, FieldKind::Count);
    let varied = layout.varied.len();
    let mut fields = vec![field("point", Meaning::Point, FieldKind::Point)];
    fields.extend(layout.varied.iter().enumerate().map(number));
    fields.extend([("breakpoint", Meaning::Breakpoint), ("status", Meaning::Status)].map(word));
    let counts = [
        ("solutions", Meaning::Solutions),
        ("gap_states", Meaning::GapStates),
        ("rejected", Meaning::Rejected),
    ];
    fields.extend(counts.map(count));
    fields.push(word(("kind", Meaning::Kind)));
    fields.push(if layout.numbered {
        field("branch", Meaning::Branch, FieldKind::Branch)
    } else {
        word(("determinant_sign", Meaning::DeterminantSign))
    });
    fields.push(field("pattern", Meaning::Pattern, FieldKind::Word(layout.contacts.max(1))));
    if layout.attainability {
        fields.push(word(("attainability", Meaning::Attainability)));
    }
    let behind = |(at, column)| number((varied + at, column));
    fields.extend(layout.numbers.iter().enumerate().map(behind));
    fields
}

/// Bytes of the longest word that tells this of a row.
fn longest(meaning: Meaning) -> usize {
    let lengths: Vec<usize> = match meaning {
        Meaning::Breakpoint => Breakpoint::ALL.iter().map(|breakpoint| breakpoint.word().len()).collect(),
        Meaning::Status => PointStatus::ALL.iter().map(|status| status.word().len()).collect(),
        Meaning::Kind => RowKind::ALL.iter().map(|kind| kind.word().len()).collect(),
        Meaning::Attainability => Verdict::ALL.iter().map(|verdict| verdict.word().len()).collect(),
        Meaning::DeterminantSign => vec![1],
        _ => Vec::new(),
    };
    lengths.into_iter().max().unwrap_or(0)
}

/// Bytes of a record.
pub(crate) fn size(layout: &Layout) -> usize {
    fields(layout).iter().map(|field| field.kind.size()).sum()
}

/// The records of rows.
pub(crate) fn rows(layout: &Layout, rows: &Rows) -> Vec<u8> {
    let fields = fields(layout);
    let mut out = Vec::with_capacity(rows.len() * size(layout));
    for (row, head) in rows.heads.iter().enumerate() {
        let numbers = rows.numbers(row);
        for field in &fields {
            let end = out.len() + field.kind.size();
            match field.meaning {
                Meaning::Point => out.extend_from_slice(&head.point.to_le_bytes()),
                Meaning::Number(at) => {
                    let number = defined(numbers[at]).unwrap_or(f64::NAN);
                    out.extend_from_slice(&number.to_le_bytes());
                }
                Meaning::Solutions => out.extend_from_slice(&head.solutions.to_le_bytes()),
                Meaning::GapStates => out.extend_from_slice(&head.gap_states.to_le_bytes()),
                Meaning::Rejected => out.extend_from_slice(&head.rejected.to_le_bytes()),
                Meaning::Branch => out.extend_from_slice(&head.branch.to_le_bytes()),
                Meaning::Breakpoint => out.extend_from_slice(head.breakpoint.word().as_bytes()),
                Meaning::Status => out.extend_from_slice(head.status.word().as_bytes()),
                Meaning::Kind => out.extend_from_slice(head.kind.word().as_bytes()),
                Meaning::DeterminantSign => out.extend_from_slice(head.determinant_sign().as_bytes()),
                Meaning::Pattern => out.extend_from_slice(rows.pattern(row).trim_ascii()),
                Meaning::Attainability => out.extend_from_slice(head.verdict.word().as_bytes()),
            }
            // Words are filled with zeros.
            out.resize(end, 0);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use slideway::sweep::RowHead;

    /// Every word stands whole in its field.
    #[test]
    fn words_are_not_cut() {
        let layout = Layout {
            varied: Vec::new(),
            numbers: Vec::new(),
            contacts: 1,
            attainability: true,
            numbered: true,
        };
        let head = RowHead::of_point(0, PointStatus::None);
        let heads: Vec<RowHead> = (Breakpoint::ALL.iter().map(|&breakpoint| RowHead { breakpoint, ..head }))
            .chain(PointStatus::ALL.iter().map(|&status| RowHead { status, ..head }))
            .chain(RowKind::ALL.iter().map(|&kind| RowHead { kind, ..head }))
            .chain(Verdict::ALL.iter().map(|&verdict| RowHead { verdict, ..head }))
            .collect();
        let patterns = vec![b'+'; heads.len()];
        let table = Rows {
            contacts: 1,
            varied: 0,
            width: 0,
            heads,
            numbers: Vec::new(),
            patterns,
            refusals: Vec::new(),
            points: 0,
        };
        let records = rows(&layout, &table);
        for (head, record) in table.heads.iter().zip(records.chunks_exact(size(&layout))) {
            let words = [head.breakpoint.word(), head.status.word(), head.kind.word(), head.verdict.word()];
            let text: Vec<u8> = record.iter().copied().filter(|byte| *byte != 0).collect();
            let expected = [words[0], words[1], words[2], "+", words[3]].concat();
            assert_eq!(String::from_utf8_lossy(&text), expected);
        }
    }
}
