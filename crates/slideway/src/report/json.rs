//! The report as JSON.

use super::Report;
use crate::printable;
use serde::Serialize;

/// The report as indented JSON, ending in a line end; the layout is that of [`Report`], its version in `schema`.
pub fn to_json(report: &Report) -> String {
    indented(report)
}

/// Any report as indented JSON, ending in a line end. Characters that are not seen are escaped.
pub(crate) fn indented<T: Serialize>(report: &T) -> String {
    debug_assert!(super::finite(report).is_ok(), "{:?}", super::finite(report).err());
    let text = serde_json::to_string_pretty(report).expect("a report holds only plain data with text keys");
    let mut text = printable::json(&text).into_owned();
    text.push('\n');
    text
}
