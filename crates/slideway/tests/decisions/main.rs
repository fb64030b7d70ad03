//! Decisions at events: what can follow, how long joints stick, what a jam does.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

mod agreement;
mod boundaries;
mod jamming;
mod klepp_2002;
mod oracle;
mod set_up;
mod textbook;
