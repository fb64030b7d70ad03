//! The engine of slideway's page: a question as JSON in, its answer as JSON out.
//!
//! The page runs it as WebAssembly in a worker (`abi.rs`); [`answer`] is all there is to it. Like the command
//! line it only converts and shows: every answer is a report of the library or a picture of
//! `slideway-pictures`, with the faults in the words of the command line.
//!
//! ```
//! use std::ops::ControlFlow;
//!
//! let text = slideway::gallery::find("drawer").expect("in the gallery").text;
//! let question = serde_json::json!({ "ask": "solve", "text": text, "settings": [] }).to_string();
//! let answer = slideway_web::answer(&question, &mut |_| ControlFlow::Continue(()));
//! assert!(answer.starts_with(r#"{"answer":{"json":"#));
//! ```
//!
//! # Files
//! `question.rs` is what can be asked, `reply.rs` asks the library, `look.rs` is what the page shows of a
//! state, `state.rs` that state and how it is drawn, `quantity.rs` what can be changed in it and between which ends, `told_fault.rs` what is wrong,
//! `saved.rs` the text with what was changed,
//! `library.rs` models to begin with.

#[cfg(target_family = "wasm")]
pub mod abi;
mod kept;
mod library;
mod look;
mod quantity;
mod question;
mod reply;
mod saved;
mod state;
mod told_fault;

use question::Question;
use serde::Serialize;
use slideway::progress::Callback;
use told_fault::ToldFault;

/// The reply to a question.
#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum Reply<T> {
    /// The answer.
    Answer(T),
    /// The faults of the model or of what is asked of it.
    Faults(Vec<ToldFault>),
    /// The callback ended the work, and there is nothing to tell of a part of it.
    Stopped(()),
    /// The question itself makes no sense: a fault of the page.
    Malformed(String),
}

impl<T: Serialize> Reply<T> {
    fn json(&self) -> String {
        serde_json::to_string(self).expect("plain data with text keys")
    }
}

/// The answer to a question: `{"answer": ..}`, `{"faults": [..]}`, `{"stopped": null}` or
/// `{"malformed": ".."}`. The callback learns of the progress and can end the work.
pub fn answer(question: &str, callback: &mut Callback<'_>) -> String {
    match serde_json::from_str::<Question>(question) {
        Ok(question) => reply::reply(&question, callback),
        Err(error) => Reply::<()>::Malformed(error.to_string()).json(),
    }
}
