//! What the fuzz targets share.

mod answer;
mod small;

pub use answer::answer;
pub use small::{arrays, patterns, problem};
