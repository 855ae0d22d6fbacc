//! Following a signal costs no memory: after construction, pushing samples allocates nothing. A program of its own for
//! its allocator, which counts.

#[path = "common/counting.rs"]
#[allow(dead_code, unreachable_pub, reason = "shared with test programs that use more of it")]
mod counting;

use brinell_signal::{Band, Blocks, LineSearch, StreamSpectra};
use counting::{Counting, allocations};

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn prop_pushing_samples_allocates_nothing() {
    let fs = 25_600.0;
    let band = Band::above(2000.0);
    let mut blocks = Blocks::new();
    let mut spectra = StreamSpectra::new(fs, 4096, band, &[LineSearch::new(250.0)]);

    let before = allocations();
    for i in 0..400_000_u32 {
        let x = (f64::from(i % 102) * -0.05).exp() * f64::from(i % 7);
        blocks.push(x);
        if i % 853 == 0 {
            blocks.end_block();
        }
        spectra.push(x);
    }
    assert_eq!(allocations() - before, 0);

    // The count does count, and the work was done.
    let spectra = spectra.finish();
    assert!(spectra.spectrum.is_some() && spectra.envelope.is_some() && spectra.lines[0].is_some());
    assert!(allocations() > before);
    assert_eq!(blocks.record().count(), 400_000);
}
