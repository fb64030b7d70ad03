//! Tables as comma-separated values. Comment lines at the top begin with `#`.

use crate::{Layout, Metadata};
use slideway::printable;
use slideway::report::defined;
use slideway::sweep::Rows;

/// Comment lines with command and model, and the line of names.
pub(crate) fn head(layout: &Layout, metadata: &Metadata) -> Vec<u8> {
    let mut text = format!("# {}\n# {}\n", Metadata::program(), metadata.command);
    let units: Vec<String> =
        layout.varied.iter().chain(&layout.numbers).map(|(name, unit)| format!("{name} ({unit})")).collect();
    text.extend(["# units: ", &units.join(", "), "\n# model:\n"]);
    for line in metadata.model.lines() {
        text.push_str(if line.is_empty() { "#" } else { "#   " });
        text.push_str(&printable::line(line));
        text.push('\n');
    }
    let mut names = vec!["point".to_owned()];
    names.extend(layout.varied.iter().map(|(name, _)| quoted(name)));
    let fixed = ["breakpoint", "status", "solutions", "gap_states", "rejected", "kind", "branch", "pattern"];
    names.extend(fixed.map(str::to_owned));
    if layout.attainability {
        names.push("attainability".to_owned());
    }
    names.extend(layout.numbers.iter().map(|(name, _)| quoted(name)));
    text.push_str(&names.join(","));
    text.push('\n');
    text.into_bytes()
}

/// A name as a field.
fn quoted(name: &str) -> String {
    if name.contains([',', '"']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.to_owned() }
}

/// One line for each row; numbers with the fewest digits that are read back as the same.
pub(crate) fn rows(layout: &Layout, rows: &Rows) -> Vec<u8> {
    let mut out = Vec::with_capacity(rows.len() * (60 + 20 * rows.width));
    let mut buffer = zmij::Buffer::new();
    let mut digits = itoa::Buffer::new();
    let mut number = |out: &mut Vec<u8>, value: f64| {
        if let Some(value) = defined(value) {
            out.extend_from_slice(buffer.format_finite(value).as_bytes());
        }
        out.push(b',');
    };
    let mut integer = |out: &mut Vec<u8>, value: u64| {
        out.extend_from_slice(digits.format(value).as_bytes());
        out.push(b',');
    };
    let text = |out: &mut Vec<u8>, text: &[u8]| {
        out.extend_from_slice(text);
        out.push(b',');
    };
    for (row, head) in rows.heads.iter().enumerate() {
        let (varied, numbers) = rows.numbers(row).split_at(rows.varied);
        integer(&mut out, head.point);
        varied.iter().for_each(|value| number(&mut out, *value));
        text(&mut out, head.breakpoint.word().as_bytes());
        text(&mut out, head.status.word().as_bytes());
        integer(&mut out, u64::from(head.solutions));
        integer(&mut out, u64::from(head.gap_states));
        integer(&mut out, u64::from(head.rejected));
        text(&mut out, head.kind.word().as_bytes());
        if head.branch == 0 {
            out.push(b',');
        } else {
            integer(&mut out, u64::from(head.branch));
        }
        text(&mut out, rows.pattern(row).trim_ascii());
        if layout.attainability {
            text(&mut out, head.verdict.word().as_bytes());
        }
        numbers.iter().for_each(|value| number(&mut out, *value));
        if let Some(last) = out.last_mut() {
            *last = b'\n';
        }
    }
    out
}
