//! Following a run costs no memory: after construction, pushing samples allocates nothing.

mod common;

use std::hint::black_box;

use brinell::signal::{Band, Blocks, Decimator, LineSearch, StreamSpectra};
use common::counting::{Counting, allocations};

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn prop_pushing_samples_allocates_nothing() {
    let fs = 25_600.0;
    let band = Band::above(2000.0);
    let mut decimator = Decimator::new(2);
    let mut blocks = Blocks::new();
    let mut spectra = StreamSpectra::new(fs, 4096, band, &[LineSearch::new(250.0)]);

    let before = allocations();
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
    assert_eq!(allocations() - before, 0);

    // The count does count, and the work was done.
    let spectra = spectra.finish();
    assert!(spectra.spectrum.is_some() && spectra.envelope.is_some() && spectra.lines[0].is_some());
    assert!(allocations() > before);
    assert_eq!(blocks.record().count(), 400_000);
}
