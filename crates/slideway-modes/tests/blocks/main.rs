//! Block problems: all solutions, proven, compared with closed forms, resultants and Newton's method from
//! many starts.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod branches;
mod degenerate;
mod jumps;
mod one_hinge;
mod random;
mod raw;
mod reference;
mod shared;
mod smooth;
mod support;
