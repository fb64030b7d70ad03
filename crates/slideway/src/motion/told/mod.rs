//! How a motion is reported: a report (`report.rs`) with the reason why it ends (`end.rs`, `stick_slip.rs`), and its text (`text.rs`) with the
//! log of events (`log.rs`), a table (`series.rs`), and the tree of all branches (`tree.rs`).

mod end;
mod log;
pub(in crate::motion) mod report;
pub(in crate::motion) mod series;
mod stick_slip;
pub(in crate::motion) mod text;
pub(in crate::motion) mod tree;
