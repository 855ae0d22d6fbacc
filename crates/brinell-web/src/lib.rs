//! [`Studio`] as WebAssembly: three functions and the memory, without imports.
//!
//! The page writes a request at the place that [`give`] gives, calls [`ask`], reads the answer and calls [`release`].
//! One instance has one studio.

use brinell_studio::Studio;
use std::cell::RefCell;

thread_local! {
    static STUDIO: RefCell<Studio> = RefCell::default();
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Room for a request of `length` bytes.
#[unsafe(no_mangle)]
pub extern "C" fn give(length: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(length, 0);
        request.as_mut_ptr()
    })
}

/// Answers the request that was written there. At the place that is returned are the answer's length (four bytes, the
/// least first) and the answer.
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> *const u8 {
    let request = REQUEST.take();
    let answer = STUDIO.with_borrow_mut(|studio| studio.ask(&request));
    ANSWER.with_borrow_mut(|kept| {
        kept.clear();
        kept.extend((answer.len() as u32).to_le_bytes());
        kept.extend(answer);
        kept.as_ptr()
    })
}

/// Frees the last answer.
#[unsafe(no_mangle)]
pub extern "C" fn release() {
    ANSWER.take();
}
