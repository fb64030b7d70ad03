//! Pictures of slideway's results.
//!
//! The library [`slideway`] computes and knows no pictures; this crate turns its values into SVG (and PNG), without
//! computing anything of mechanics. Like the library it reads no file and no clock, and prints nothing.

pub mod plot;
pub mod theme;
