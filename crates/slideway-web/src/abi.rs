//! The interface of the WebAssembly module: one buffer for question and answer, one function that is called
//! back. No generated code on either side, so that any host can use it.
//!
//! The host calls [`buffer`] with the length of the question, writes it as UTF-8 to the place it gets, calls
//! [`ask`], which returns the length of the answer, and reads that at [`place`]. During the work the module
//! calls the import `host.progress(done, fraction, name, length)`: the number of things done, the part of the
//! work done (negative if that is not known), and the place and length of what is counted. If it returns
//! anything but 0 the work ends.
//!
//! A panic ends the module by a trap; `host.panicked(message, length)` is called before it.

#![allow(unsafe_code, reason = "names of exports and imports; no memory is touched by pointers")]

use slideway::progress::Progress;
use std::cell::RefCell;
use std::ops::ControlFlow;

#[link(wasm_import_module = "host")]
unsafe extern "C" {
    safe fn progress(done: f64, fraction: f64, name: *const u8, length: usize) -> i32;
    safe fn panicked(message: *const u8, length: usize);
}

thread_local! {
    static BUFFER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// The place for a question of this length.
#[unsafe(no_mangle)]
pub extern "C" fn buffer(length: usize) -> *mut u8 {
    BUFFER.with_borrow_mut(|buffer| {
        *buffer = vec![0; length];
        buffer.as_mut_ptr()
    })
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn place() -> *const u8 {
    BUFFER.with_borrow(|buffer| buffer.as_ptr())
}

/// Answers the question in the buffer; the length of the answer, which takes its place.
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> usize {
    std::panic::set_hook(Box::new(|panic| {
        let message = panic.to_string();
        panicked(message.as_ptr(), message.len());
    }));
    let question = BUFFER.take();
    let answer = crate::answer(&String::from_utf8_lossy(&question), &mut tell).into_bytes();
    let length = answer.len();
    BUFFER.set(answer);
    length
}

fn tell(told: &Progress) -> ControlFlow<()> {
    let name = told.counted;
    let fraction = told.fraction.unwrap_or(-1.0);
    match progress(told.done as f64, fraction, name.as_ptr(), name.len()) {
        0 => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    }
}
