//! Problems given as matrices, told as text and JSON: see [`slideway_modes::raw_problem`].

mod text;

pub use slideway_modes::raw_problem::*;
pub use text::to_text;

/// The report as indented JSON, ending in a line end; the layout is that of [`RawReport`].
pub fn to_json(report: &RawReport) -> String {
    crate::report::indented_json(report)
}
