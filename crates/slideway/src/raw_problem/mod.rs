//! Problems given as matrices, told as text and JSON: see [`slideway_modes::raw_problem`].

mod text;

pub use slideway_modes::raw_problem::*;
