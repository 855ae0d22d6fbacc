//! A speed that was given wrongly, by the sidebands that the shaft's true speed leaves.

use crate::analysis::{Damage, damaged};
use brinell_signal::analysis::{NamedBearing, Options, Verdict, analyze};

/// What an inner race at 29.95 turns a second shows to whoever believes in half as many again: lines where BPFO would
/// be, with sidebands at two thirds of that speed. At the true speed it is the inner race.
#[test]
fn prop_sidebands_of_another_speed_leave_the_part_open() {
    let (fs, shaft) = (20_000.0, 29.95);
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    for seed in 0..4 {
        let inner = Damage { order: 5.4152, modulation: 1.0, jitter: 0.001, snr_db: 6.0 };
        let x = damaged(fs, 4.0, seed, &inner);
        let told = |shaft: f64| analyze(&x, fs, &Options::new(shaft, orders)).unwrap();
        let right = told(shaft);
        assert!(right.verdict().starts_with("Inner race damage, very clear"), "{}", right.verdict());
        assert!(right.families.iter().all(|f| f.other_spacing.is_none()));
        let wrong = told(1.5 * shaft);
        assert_eq!(wrong.conclusion(), Verdict::CannotTell, "{}", wrong.verdict());
        let spacing = wrong.families.iter().find_map(|f| f.other_spacing).unwrap();
        assert!((spacing / shaft - 1.0).abs() < 0.01, "{spacing}");
    }
}
