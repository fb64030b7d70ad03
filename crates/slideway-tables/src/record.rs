//! Rows as records of a fixed size, little-endian: the elements of a NumPy array with named fields, and what
//! a Parquet file is made from.

use crate::Layout;
use slideway::report::defined;
use slideway::sweep::Rows;

/// Bytes of a word of a status, a kind, a verdict.
pub(crate) const WORD: usize = 12;

/// A field of a record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) kind: FieldKind,
}

/// What a field holds. No word, no branch and no number stand in it as an empty word, as 0 and as not a
/// number.
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
    let field = |name: &str, kind| Field { name: name.to_owned(), kind };
    let number = |(name, _): &(String, &'static str)| field(name, FieldKind::Number);
    let word = |name: &str| field(name, FieldKind::Word(WORD));
    let mut fields = vec![field("point", FieldKind::Point)];
    fields.extend(layout.varied.iter().map(number));
    fields.extend(["breakpoint", "status"].map(word));
    fields.extend(["solutions", "gap_states", "rejected"].map(|name| field(name, FieldKind::Count)));
    fields.push(word("kind"));
    fields.push(field("branch", FieldKind::Branch));
    fields.push(field("pattern", FieldKind::Word(layout.contacts.max(1))));
    if layout.attainability {
        fields.push(word("attainability"));
    }
    fields.extend(layout.numbers.iter().map(number));
    fields
}

/// Bytes of a record.
pub(crate) fn size(layout: &Layout) -> usize {
    fields(layout).iter().map(|field| field.kind.size()).sum()
}

/// The records of rows.
pub(crate) fn rows(layout: &Layout, rows: &Rows) -> Vec<u8> {
    let mut out = Vec::with_capacity(rows.len() * size(layout));
    let word = |out: &mut Vec<u8>, word: &[u8], size: usize| {
        let end = out.len() + size;
        out.extend_from_slice(&word[..word.len().min(size)]);
        out.resize(end, 0);
    };
    let number = |out: &mut Vec<u8>, value: f64| {
        out.extend_from_slice(&defined(value).unwrap_or(f64::NAN).to_le_bytes());
    };
    for (row, head) in rows.heads.iter().enumerate() {
        let (varied, numbers) = rows.numbers(row).split_at(rows.varied);
        out.extend_from_slice(&head.point.to_le_bytes());
        varied.iter().for_each(|value| number(&mut out, *value));
        word(&mut out, head.breakpoint.word().as_bytes(), WORD);
        word(&mut out, head.status.word().as_bytes(), WORD);
        for count in [head.solutions, head.gap_states, head.rejected] {
            out.extend_from_slice(&count.to_le_bytes());
        }
        word(&mut out, head.kind.word().as_bytes(), WORD);
        out.extend_from_slice(&head.branch.to_le_bytes());
        word(&mut out, rows.pattern(row).trim_ascii(), layout.contacts.max(1));
        if layout.attainability {
            word(&mut out, head.verdict.word().as_bytes(), WORD);
        }
        numbers.iter().for_each(|value| number(&mut out, *value));
    }
    out
}
