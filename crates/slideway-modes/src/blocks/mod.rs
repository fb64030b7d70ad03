//! Mode problems whose unknowns are blocks of one or two components: contacts and hinges with friction.

mod problem;
mod result;

pub use problem::BlockProblem;
pub use result::{BlockResult, BlockSolution, OpenLabel, OpenRegion, UniqueForEveryLoad};
