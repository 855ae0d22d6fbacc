//! Runs whose labels are held out: nothing that a reader has tells their class.

use super::{BASE, PLAN, SECRET, draws, numbers, refusals};
use brinell::random::mix;

#[test]
fn prop_held_out_runs_are_the_share_asked_for_and_always_the_same() {
    let plan = PLAN.replace("runs = 60", &format!("runs = 5000\nheld_out = 0.2\n{SECRET}"));
    let (one, again) = (draws(&plan), draws(&plan));
    let held: Vec<usize> = (0..5000).filter(|run| one.is_held_out(*run)).collect();
    assert!((held.len() as i32 - 1000).abs() < 130, "{}", held.len());
    assert!(held.iter().all(|run| again.is_held_out(*run)));
    assert!(!(0..60).any(|run| draws(PLAN).is_held_out(run)));
}

#[test]
fn prop_nothing_that_is_seen_of_a_held_out_run_tells_its_class() {
    const RUNS: usize = 6000;
    let plan = format!("design = 'latin-hypercube'\n{PLAN}")
        .replace("runs = 60", &format!("runs = {RUNS}\nheld_out = 0.5\n{SECRET}"))
        .replace("share = 2", "share = 1");
    let draws = draws(&plan);
    let (held, open): (Vec<usize>, Vec<usize>) = (0..RUNS).partition(|run| draws.is_held_out(*run));
    // Those that are open take turns, as if there were no others: their order has no gaps to read.
    for (n, run) in open.iter().enumerate() {
        assert_eq!(draws.class(*run), n % 2, "run {run}");
    }
    // Those held out are of either class by chance, at odd and at even places, and after either class: within four
    // standard deviations.
    for odd in [0, 1] {
        let of_these: Vec<usize> = held.iter().copied().filter(|run| run % 2 == odd).collect();
        let ones = of_these.iter().filter(|run| draws.class(**run) == 1);
        let off = ones.count() as f64 - 0.5 * of_these.len() as f64;
        assert!(off.abs() < 2.0 * (of_these.len() as f64).sqrt(), "{off}");
    }
    // The design is filled by the open runs alone: one in each slice, and no slice is left over for a run that is held
    // out.
    let speeds = numbers(&draws, "operation.speed_rpm");
    let slices = |runs: &[usize]| {
        let slice = |run: &usize| ((speeds[*run] - 1000.0) / 2000.0 * open.len() as f64) as usize;
        let slices: std::collections::HashSet<usize> = runs.iter().map(slice).collect();
        slices.len()
    };
    // Nine digits may move one over an edge.
    let filled = slices(&open);
    assert!(filled + 5 > open.len(), "{filled} of {}", open.len());
    // At random, two fall into one slice.
    assert!(slices(&held) < 3 * open.len() / 4);
}

/// x of mix(x).
fn unmix(z: u64) -> u64 {
    // Odd factors have inverses modulo 2^64 (Newton's iteration); x ^ (x >> k) is undone k bits at a time.
    let inverse = |odd: u64| (0..6).fold(odd, |x, _| x.wrapping_mul(2_u64.wrapping_sub(odd.wrapping_mul(x))));
    let unshift = |z: u64, k: u32| (0..64 / k + 1).fold(z, |x, _| z ^ (x >> k));
    let z = unshift(z, 31).wrapping_mul(inverse(0x94D0_49BB_1331_11EB));
    let z = unshift(z, 27).wrapping_mul(inverse(0xBF58_476D_1CE4_E5B9));
    unshift(z, 30).wrapping_sub(0x9E37_79B9_7F4A_7C15)
}

fn word(key: &str) -> u64 {
    let bytes = key.bytes();
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

#[test]
fn prop_who_has_the_open_runs_and_the_plan_but_not_the_secret_has_no_label() {
    const RUNS: usize = 4000;
    const KEY: &str = "defects.0.shape.random.seed";
    let with = |secret: &str| {
        PLAN.replace("seed = 5", "seed = 918273645546372")
            .replace("runs = 60", &format!("runs = {RUNS}\nheld_out = 0.5\nsecret = \"{secret}\""))
            .replace("share = 2", "share = 1")
    };
    let truth = draws(&with("9f86d081884c7d659a2feaa0c55ad015"));
    let seed_of = |run: usize| -> Option<u64> {
        let settings = truth.first(BASE, run).unwrap().settings;
        settings.into_iter().find(|(key, _)| key == KEY)?.1.parse().ok()
    };
    let open: Vec<usize> = (0..RUNS).filter(|run| !truth.is_held_out(*run)).collect();
    // The seeds of two open runs tell the plan's: their stream can be turned back.
    let seeds: Vec<(usize, u64)> = open.iter().filter_map(|run| Some((*run, seed_of(*run)?))).take(2).collect();
    let plans_seed = |run: usize, bits: u64| unmix(unmix(unmix(unmix(bits) ^ mix(word(KEY))) ^ mix(run as u64)));
    let candidates = |(run, seed): (usize, u64)| (0..1 << 11).map(move |low| plans_seed(run, seed << 11 | low));
    let first: std::collections::HashSet<u64> = candidates(seeds[0]).collect();
    let both: Vec<u64> = candidates(seeds[1]).filter(|seed| first.contains(seed)).collect();
    assert_eq!(both, [918_273_645_546_372], "the attack no longer finds what it should");
    // It tells nothing of what is held out: neither by the same stream, nor by a plan that differs in the secret alone.
    let bits = |words: &[u64]| words.iter().fold(0, |state, word| mix(state ^ mix(*word)));
    let unit = |what: &str, run: usize| bits(&[both[0], word(what), run as u64]) as f64 / 2_f64.powi(64);
    let other = draws(&with("9f86d081884c7d659a2feaa0c55ad016"));
    let held: Vec<usize> = (0..RUNS).filter(|run| truth.is_held_out(*run)).collect();
    let guesses: [(&str, &dyn Fn(usize) -> bool); 4] = [
        ("class, same stream", &|run| usize::from(unit("class", run) >= 0.5) == truth.class(run)),
        ("which, same stream", &|run| unit("held_out", run) < 0.5),
        ("class, other secret", &|run| other.class(run) == truth.class(run)),
        ("which, other secret", &|run| other.is_held_out(run)),
    ];
    for (guess, is_right) in guesses {
        let right = held.iter().filter(|run| is_right(**run)).count() as f64;
        let off = right - 0.5 * held.len() as f64;
        assert!(off.abs() < 4.0 * (0.25 * held.len() as f64).sqrt(), "{guess}: {right} of {}", held.len());
    }
    // Nor are values and seeds those of the open stream.
    let shared = held.iter().filter_map(|run| Some((*run, seed_of(*run)?)));
    for (run, seed) in shared.take(100) {
        assert_ne!(seed, bits(&[both[0], run as u64, word(KEY)]) >> 11, "run {run}");
    }
    let same =
        held.iter().filter(|run| truth.first(BASE, **run).unwrap().values == other.first(BASE, **run).unwrap().values);
    assert_eq!(same.count(), 0);
}

#[test]
fn regress_a_weak_secret_is_refused() {
    for secret in ["", "secret = \"12345\"", "secret = \"00000000000000000000000000000001\""] {
        let told = refusals(&PLAN.replace("runs = 60", &format!("runs = 60\nheld_out = 0.5\n{secret}")));
        assert!(told[0].contains("secret") && told[0].contains("openssl rand -hex 16"), "{told:?}");
    }
}
