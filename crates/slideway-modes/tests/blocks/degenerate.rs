//! Degenerate problems.
