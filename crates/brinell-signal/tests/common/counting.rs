//! An allocator that counts, for each thread by itself: the test program's own threads allocate when they like.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// To be made the program's `#[global_allocator]`.
pub struct Counting;

thread_local! {
    static CALLS: Cell<usize> = const { Cell::new(0) };
    static LIVE: Cell<isize> = const { Cell::new(0) };
}

/// Allocations of this thread so far.
pub fn allocations() -> usize {
    CALLS.get()
}

/// Bytes that this thread has allocated and not given back.
pub fn live() -> isize {
    LIVE.get()
}

// SAFETY: every call is handed on to the system's allocator unchanged, and the counters neither allocate nor need to be
// dropped.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        CALLS.set(CALLS.get() + 1);
        LIVE.set(LIVE.get() + layout.size() as isize);
        // SAFETY: the caller's contract is the system allocator's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.set(LIVE.get() - layout.size() as isize);
        // SAFETY: the caller's contract is the system allocator's.
        unsafe { System.dealloc(pointer, layout) }
    }
}
