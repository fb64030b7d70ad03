//! Proofs about patterns, against an elimination in rational numbers that shares no code with them.

mod cells;
mod decisions;
mod degenerate;
mod exclusions;
mod intervals;
mod oracle;
