//! Problems given as matrices, with answers as text and JSON: see [`slideway_modes::raw_problem`].

mod faulty_line;
mod line;
mod text;

pub use faulty_line::FaultyLine;
pub use slideway_modes::raw_problem::*;
