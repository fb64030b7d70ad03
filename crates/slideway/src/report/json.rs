//! A report as JSON.

use super::Report;
use crate::printable;
use serde::Serialize;

/// A report with its answer behind it: the version of the layout comes first.
#[derive(Serialize)]
pub(crate) struct Answered<'r, R> {
    #[serde(flatten)]
    report: &'r R,
    #[serde(skip_serializing_if = "String::is_empty")]
    answer: String,
}

impl<'r, R: Report> Answered<'r, R> {
    pub(crate) fn of(report: &'r R) -> Self {
        Self { answer: report.answer(), report }
    }
}

/// Any report as indented JSON, ending in a line end. Characters that are not seen are escaped. All JSON is
/// written here: a number that is not finite, for which there would be `null`, is refused.
pub(crate) fn indented<T: Serialize>(report: &T) -> String {
    written(report, serde_json::to_string_pretty)
}

/// Writes a report as JSON in one line.
pub(crate) fn in_one_line<T: Serialize>(report: &T) -> String {
    written(report, serde_json::to_string)
}

fn written<T: Serialize>(report: &T, write: fn(&T) -> serde_json::Result<String>) -> String {
    let report = super::finite(report).unwrap_or_else(|faults| panic!("{faults}"));
    let text = write(report).expect("a report holds only plain data with text keys");
    let mut text = printable::json(&text).into_owned();
    text.push('\n');
    text
}
