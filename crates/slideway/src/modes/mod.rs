//! The mode problem.
