//! Following a run costs no memory: after construction, pushing samples allocates nothing.

use std::alloc::{GlobalAlloc, Layout, System};
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering};

use brinell::signal::{Band, Blocks, Decimator, LineSearch, StreamSpectra};

struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is handed on to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's contract is the system allocator's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's contract is the system allocator's.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

// One test in this file: the count is of the whole process.
#[test]
fn prop_pushing_samples_allocates_nothing() {
    let fs = 25_600.0;
    let band = Band::above(2000.0);
    let mut decimator = Decimator::new(2);
    let mut blocks = Blocks::new();
    let mut spectra = StreamSpectra::new(fs, 4096, band, &[LineSearch::new(250.0)]);

    let before = ALLOCATIONS.load(Ordering::Relaxed);
    let mut last = 0.0;
    for i in 0..400_000_u32 {
        let x = (f64::from(i % 102) * -0.05).exp() * f64::from(i % 7);
        if let Some(frame) = decimator.push(&[x, -x]) {
            last = frame[0];
        }
        blocks.push(x);
        if i % 853 == 0 {
            blocks.end_block();
        }
        spectra.push(x);
    }
    black_box(last);
    assert_eq!(ALLOCATIONS.load(Ordering::Relaxed) - before, 0);

    // The count does count, and the work was done.
    let spectra = spectra.finish();
    assert!(spectra.spectrum.is_some() && spectra.envelope.is_some() && spectra.lines[0].is_some());
    assert!(ALLOCATIONS.load(Ordering::Relaxed) > before);
    assert_eq!(blocks.whole().count(), 400_000);
}
