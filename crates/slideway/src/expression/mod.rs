//! Expressions with units.
