//! Plans of data sets: that runs draw what their distributions say, each its own and always the same, and that bad plans are told.

use brinell::document::Problem;
use brinell::random::mix;
use brinell_study::design::{Draws, OutOfRange, Part, Plan, Survey, Value};
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;

const BASE: &str = r#"name = "base"
[bearing]
preset = "NU206"
[operation]
speed_rpm = 1500.0
load_n = [300.0, 0.0]
[simulation]
duration_s = 0.02
"#;

const PLAN: &str = r#"base = "base.toml"
runs = 60
seed = 5

[vary]
operation.speed_rpm = { uniform = [1000, 3000] }
operation.load_n = [{ normal = [500, 100], within = [300, 700] }, 0.0]

[[classes]]
name = "healthy"
defects = []

[[classes]]
name = "outer"
share = 2
[[classes.defects]]
on = "outer-raceway"
depth_um = { log = [1, 100] }
shape.random = { length_mm = { uniform = [0.5, 4] }, width_mm = 3 }
"#;

/// Of plans that hold labels out.
const SECRET: &str = "secret = \"9f86d081884c7d659a2feaa0c55ad015\"";

fn draws(plan: &str) -> Draws {
    Draws::new(Plan::read(plan).unwrap_or_else(|p| panic!("{p:?}")))
        .unwrap_or_else(|p| panic!("{p:?}"))
}

fn refusals(plan: &str) -> Vec<String> {
    let problems: Vec<Problem> = match Plan::read(plan) {
        Ok(plan) => Draws::new(plan).err().expect("the plan is bad"),
        Err(problems) => problems,
    };
    problems.iter().map(ToString::to_string).collect()
}

fn number(draws: &Draws, run: usize, key: &str) -> Option<f64> {
    let mut parameters = draws.parameters().iter();
    let k = parameters.position(|p| p.key == key).unwrap();
    draws.first(BASE, run).unwrap().values[k].as_ref()?.number
}

fn numbers(draws: &Draws, key: &str) -> Vec<f64> {
    let value = |run| number(draws, run, key);
    (0..draws.runs()).filter_map(value).collect()
}

#[test]
fn prop_every_run_makes_a_scenario_of_its_class_with_a_seed_of_its_own() {
    let draws = draws(PLAN);
    let mut seeds = std::collections::HashSet::new();
    let mut counts = [0, 0];
    for run in 0..draws.runs() {
        let (loaded, draw) = draws.scenario(BASE, run).unwrap();
        counts[draw.class] += 1;
        assert_eq!(draws.class(run), draw.class);
        let s = loaded.scenario;
        assert_eq!(s.defects.len(), draw.class);
        assert_eq!(s.simulation.record, ["sensor_ax", "sensor_ay"]);
        assert!((300.0..=700.0).contains(&s.operation.load_n[0]));
        for defect in s.defects {
            let brinell::scenario::Shape::Random { seed, width_mm, .. } = defect.shape else {
                panic!("a random spall");
            };
            assert_eq!(width_mm, 3.0);
            assert!(seeds.insert(seed), "seed {seed} comes twice");
        }
    }
    assert_eq!(counts, [20, 40]);
    // After any number of runs each class has its share to within one.
    for n in 1..=60 {
        let outer = (0..n).filter(|run| draws.class(*run) == 1).count() as f64;
        assert!((outer - 2.0 * n as f64 / 3.0).abs() <= 1.0, "{n}: {outer}");
    }
}

#[test]
fn prop_a_sensors_noise_is_another_in_every_run() {
    let seeds = |base: &str, plan: &str| -> Vec<u64> {
        let draws = draws(plan);
        let seed = |run| {
            draws
                .scenario(base, run)
                .unwrap()
                .0
                .scenario
                .sensor
                .noise_seed
        };
        let mut seeds: Vec<u64> = (0..60).map(seed).collect();
        seeds.sort_unstable();
        seeds.dedup();
        seeds
    };
    let noisy = format!("{BASE}[sensor]\nnoise_rms_m_per_s2 = 0.5\n");
    assert_eq!(seeds(&noisy, PLAN).len(), 60);
    // The base's own seed says which noise its run has, not that all runs share it; the plan's does.
    assert_eq!(seeds(&format!("{noisy}noise_seed = 4\n"), PLAN).len(), 60);
    let fixed = PLAN.replace("[vary]", "[vary]\nsensor.noise_seed = 9");
    assert_eq!(seeds(&noisy, &fixed), [9]);
    let [own, set] = [PLAN, &*fixed].map(|plan| draws(plan).is_seed("sensor.noise_seed"));
    assert!(own && !set && draws(PLAN).is_seed("defects.0.shape.random.seed"));
    assert!(!draws(PLAN).is_seed("defects.0.shape.random.length_mm"));
    // Without noise there is nothing to seed.
    assert_eq!(seeds(&format!("{BASE}[sensor]\n"), PLAN).len(), 1);
}

#[test]
fn prop_a_run_draws_the_same_whatever_else_the_plan_runs() {
    let longer = draws(&PLAN.replace("runs = 60", "runs = 90"));
    let (one, again) = (draws(PLAN), draws(PLAN));
    let other = draws(&PLAN.replace("seed = 5", "seed = 6"));
    for run in [59, 0, 17] {
        let draw = one.first(BASE, run).unwrap();
        assert_eq!(draw, again.first(BASE, run).unwrap());
        assert_eq!(draw, longer.first(BASE, run).unwrap());
        assert_ne!(draw, other.first(BASE, run).unwrap());
    }
    // A key that is added leaves the others as they were.
    let more = draws(&PLAN.replace(
        "[vary]",
        "[vary]\nbearing.radial_clearance_um = { uniform = [1, 2] }",
    ));
    assert_eq!(
        numbers(&one, "operation.speed_rpm"),
        numbers(&more, "operation.speed_rpm")
    );
}

#[test]
fn analytic_distributions_have_their_moments() {
    // 4000 independent runs: means within 4.5 standard errors of the distributions'.
    let plan = PLAN
        .replace("runs = 60", "runs = 6000")
        .replace(", within = [300, 700]", "");
    let draws = draws(&plan);
    let check = |key: &str, of: fn(f64) -> f64, mean: f64, deviation: f64| {
        let x: Vec<f64> = numbers(&draws, key).into_iter().map(of).collect();
        let n = x.len() as f64;
        let found = x.iter().sum::<f64>() / n;
        assert!(
            (found - mean).abs() < 4.5 * deviation / n.sqrt(),
            "{key}: mean {found}"
        );
        let spread = (x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt();
        assert!(
            (spread / deviation - 1.0).abs() < 0.06,
            "{key}: deviation {spread}"
        );
    };
    check("operation.speed_rpm", |x| x, 2000.0, 2000.0 / 12_f64.sqrt());
    check("operation.load_n.0", |x| x, 500.0, 100.0);
    check("defects.0.depth_um", f64::log10, 1.0, 2.0 / 12_f64.sqrt());
}

#[test]
fn prop_designs_fill_each_distribution_evenly() {
    // 64 runs of one class: a Latin hypercube and a Sobol sequence have one in each 64th part, independent draws have not.
    let plan = |design: &str| {
        format!(
            "base = 'b'\nruns = 64\ndesign = '{design}'\n[vary]\noperation.speed_rpm = {{ uniform = [0, 64] }}\n\
             operation.load_n = [{{ uniform = [0, 64] }}, {{ uniform = [0, 64] }}]\n"
        )
    };
    for (design, even) in [
        ("latin-hypercube", true),
        ("sobol", true),
        ("random", false),
    ] {
        let draws = draws(&plan(design));
        for key in [
            "operation.speed_rpm",
            "operation.load_n.0",
            "operation.load_n.1",
        ] {
            let mut parts: Vec<u64> = numbers(&draws, key).into_iter().map(|x| x as u64).collect();
            parts.sort_unstable();
            parts.dedup();
            assert_eq!(parts.len() == 64, even, "{design} {key}: {}", parts.len());
        }
    }
}

/// Were each class a design of its own, a run left out would lie in the part that its class has vacant.
#[test]
fn prop_no_vacancy_of_a_design_tells_the_class_of_a_run() {
    let plan = |design: &str| {
        let class = |k: usize| {
            format!(
                "[[classes]]\nname = 'c{k}'\nvary.bearing.radial_clearance_um = {{ uniform = [1, 2] }}\n"
            )
        };
        let classes: String = (0..4).map(class).collect();
        format!(
            "base = 'b'\nruns = 240\ndesign = '{design}'\n[vary]\noperation.speed_rpm = {{ uniform = [0, 1] }}\n\
             operation.load_n = [{{ uniform = [0, 1] }}, {{ uniform = [0, 1] }}]\n{classes}"
        )
    };
    for design in ["latin-hypercube", "sobol", "random"] {
        let draws = draws(&plan(design));
        let values: Vec<Vec<f64>> = (0..240)
            .map(|run| {
                let draw = draws.first(BASE, run).unwrap();
                let of = |v: &Option<Value>| v.as_ref().unwrap().number.unwrap();
                draw.values[..3].iter().map(of).collect()
            })
            .collect();
        // Every fourth in an order that is not the classes'.
        let left_out = |run: usize| (run / 4 + run).is_multiple_of(4);
        let mut right = 0;
        for run in (0..240).filter(|run| left_out(*run)) {
            let vacant = |class: usize| {
                let mine = |other: &usize| draws.class(*other) == class && !left_out(*other);
                let part = |x: f64| (60.0 * x) as usize;
                let vacant = |k: &usize| {
                    let mut others = (0..240).filter(mine);
                    !others.any(|other| part(values[other][*k]) == part(values[run][*k]))
                };
                (0..3).filter(vacant).count()
            };
            let guess = (0..4).max_by_key(|class| vacant(*class)).unwrap();
            right += usize::from(guess == draws.class(run));
        }
        // Binomial at chance: 15 of 60, standard deviation 3.4; beyond 4.5 of them it tells.
        assert!(right < 30, "{design}: {right} of 60");
    }
}

#[test]
fn prop_grids_are_crossed_and_come_equally_often() {
    let plan = "base = 'b'\nruns = 24\n[vary]\noperation.speed_rpm = { grid = '1000:3000:1000' }\nsimulation.model = { grid = ['full', 'lumped'] }\n\
                bearing.radial_clearance_um = { uniform = [1, 2] }\n";
    let uneven = draws(&plan.replace("24", "25"));
    let draws = draws(plan);
    let mut counts = std::collections::BTreeMap::new();
    for run in 0..24 {
        let draw = draws.first(BASE, run).unwrap();
        let of = |key: &str| draw.settings.iter().find(|s| s.0 == key).unwrap().1.clone();
        *counts
            .entry((of("operation.speed_rpm"), of("simulation.model")))
            .or_insert(0) += 1;
    }
    assert_eq!(counts.len(), 6);
    assert!(counts.values().all(|n| *n == 4));
    assert!(draws.notes().is_empty());
    assert!(uneven.notes()[0].contains("25 runs for 6 combinations"));
}

#[test]
fn prop_choices_follow_their_weights_and_whole_numbers_reach_both_ends() {
    let draws = draws(
        "base = 'b'\nruns = 4000\n[vary]\nbearing.preset = { choice = ['NU206', 'N205', 'NU205'], weights = [3, 0, 1] }\n\
         contact.slices = { whole = [3, 6] }\n",
    );
    let k = draws
        .parameters()
        .iter()
        .position(|p| p.key == "bearing.preset")
        .unwrap();
    assert!(!draws.parameters()[k].numeric);
    let (mut nu206, mut slices) = (0, [0; 4]);
    for run in 0..4000 {
        let draw = draws.first(BASE, run).unwrap();
        let preset = draw.values[k].as_ref().unwrap().words().to_owned();
        assert_ne!(preset, "N205");
        nu206 += usize::from(preset == "NU206");
        slices[draw.values[1 - k].as_ref().unwrap().number.unwrap() as usize - 3] += 1;
    }
    // Binomial: 4.5 standard deviations are 123 of 3000 +- and of 1000 +-.
    assert!((nu206 as i32 - 3000).abs() < 123, "{nu206}");
    assert!(
        slices.iter().all(|n| (n - 1000_i32).abs() < 123),
        "{slices:?}"
    );
}

#[test]
fn analytic_values_beyond_a_keys_range_are_counted() {
    // A clearance may be negative, a viscosity not: normal around 0 leaves its range half of the time.
    let plan = |policy: &str| {
        format!(
            "base = 'b'\nruns = 1000\ndesign = 'latin-hypercube'\nout_of_range = '{policy}'\n[vary]\n\
             lubricant.viscosity_pa_s = {{ normal = [0, 1] }}\noperation.speed_rpm = {{ uniform = [1000, 2000] }}\n"
        )
    };
    let survey = |policy: &str, threads: usize| {
        let one = NonZeroUsize::MIN;
        Survey::of(
            &draws(&plan(policy)),
            BASE,
            one,
            NonZeroUsize::new(threads).unwrap(),
            &AtomicBool::new(false),
        )
    };
    let found = survey("refuse", 1);
    assert_eq!(found, survey("refuse", 2));
    // A Latin hypercube puts exactly half of the runs below the median.
    assert_eq!((found.runs, found.unfit, found.hopeless), (1000, 500, 500));
    let [miss] = &found.errors[..] else {
        panic!("{:?}", found.errors)
    };
    assert_eq!(miss.problem.key, "lubricant.viscosity_pa_s");
    assert_eq!(
        (miss.count, miss.problem.allowed.as_deref()),
        (500, Some(">= 0"))
    );
    assert!(!found.is_sound(OutOfRange::Refuse) && found.is_sound(OutOfRange::Fail));
    let redrawn = survey("redraw", 2);
    assert_eq!((redrawn.unfit, redrawn.hopeless), (500, 0));
    assert!(redrawn.is_sound(OutOfRange::Redraw));
    // What is drawn again fits, and follows the half normal: its mean is sqrt(2/pi).
    let draws = draws(&plan("redraw"));
    let eta = |run| {
        draws
            .scenario(BASE, run)
            .unwrap()
            .0
            .scenario
            .lubricant
            .viscosity_pa_s
    };
    let mean = (0..1000)
        .map(eta)
        .inspect(|x| assert!(*x >= 0.0))
        .sum::<f64>()
        / 1000.0;
    let (expected, error) = ((2.0 / std::f64::consts::PI).sqrt(), 0.603 / 1000_f64.sqrt());
    assert!((mean - expected).abs() < 4.5 * error, "{mean}");
}

#[test]
fn prop_held_out_runs_are_the_share_asked_for_and_always_the_same() {
    let plan = PLAN.replace(
        "runs = 60",
        &format!("runs = 5000\nheld_out = 0.2\n{SECRET}"),
    );
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
        .replace(
            "runs = 60",
            &format!("runs = {RUNS}\nheld_out = 0.5\n{SECRET}"),
        )
        .replace("share = 2", "share = 1");
    let draws = draws(&plan);
    let (held, open): (Vec<usize>, Vec<usize>) = (0..RUNS).partition(|run| draws.is_held_out(*run));
    // Those that are open take turns, as if there were no others: their order has no gaps to read.
    for (n, run) in open.iter().enumerate() {
        assert_eq!(draws.class(*run), n % 2, "run {run}");
    }
    // Those held out are of either class by chance, at odd and at even places, and after either class: within four standard deviations.
    for odd in [0, 1] {
        let of_these: Vec<usize> = held.iter().copied().filter(|run| run % 2 == odd).collect();
        let ones = of_these.iter().filter(|run| draws.class(**run) == 1);
        let off = ones.count() as f64 - 0.5 * of_these.len() as f64;
        assert!(off.abs() < 2.0 * (of_these.len() as f64).sqrt(), "{off}");
    }
    // The design is filled by the open runs alone: one in each slice, and no slice is left over for a run that is held out.
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
    let inverse = |odd: u64| {
        (0..6).fold(odd, |x, _| {
            x.wrapping_mul(2_u64.wrapping_sub(odd.wrapping_mul(x)))
        })
    };
    let unshift = |z: u64, k: u32| (0..64 / k + 1).fold(z, |x, _| z ^ (x >> k));
    let z = unshift(z, 31).wrapping_mul(inverse(0x94D0_49BB_1331_11EB));
    let z = unshift(z, 27).wrapping_mul(inverse(0xBF58_476D_1CE4_E5B9));
    unshift(z, 30).wrapping_sub(0x9E37_79B9_7F4A_7C15)
}

fn word(key: &str) -> u64 {
    let bytes = key.bytes();
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

#[test]
fn prop_who_has_the_open_runs_and_the_plan_but_not_the_secret_has_no_label() {
    const RUNS: usize = 4000;
    const KEY: &str = "defects.0.shape.random.seed";
    let with = |secret: &str| {
        PLAN.replace("seed = 5", "seed = 918273645546372")
            .replace(
                "runs = 60",
                &format!("runs = {RUNS}\nheld_out = 0.5\nsecret = \"{secret}\""),
            )
            .replace("share = 2", "share = 1")
    };
    let truth = draws(&with("9f86d081884c7d659a2feaa0c55ad015"));
    let seed_of = |run: usize| -> Option<u64> {
        let settings = truth.first(BASE, run).unwrap().settings;
        settings
            .into_iter()
            .find(|(key, _)| key == KEY)?
            .1
            .parse()
            .ok()
    };
    let open: Vec<usize> = (0..RUNS).filter(|run| !truth.is_held_out(*run)).collect();
    // The seeds of two open runs tell the plan's: their stream can be turned back.
    let seeds: Vec<(usize, u64)> = open
        .iter()
        .filter_map(|run| Some((*run, seed_of(*run)?)))
        .take(2)
        .collect();
    let plans_seed =
        |run: usize, bits: u64| unmix(unmix(unmix(unmix(bits) ^ mix(word(KEY))) ^ mix(run as u64)));
    let candidates =
        |(run, seed): (usize, u64)| (0..1 << 11).map(move |low| plans_seed(run, seed << 11 | low));
    let first: std::collections::HashSet<u64> = candidates(seeds[0]).collect();
    let both: Vec<u64> = candidates(seeds[1])
        .filter(|seed| first.contains(seed))
        .collect();
    assert_eq!(
        both,
        [918_273_645_546_372],
        "the attack no longer finds what it should"
    );
    // It tells nothing of what is held out: neither by the same stream, nor by a plan that differs in the secret alone.
    let bits = |words: &[u64]| words.iter().fold(0, |state, word| mix(state ^ mix(*word)));
    let unit =
        |what: &str, run: usize| bits(&[both[0], word(what), run as u64]) as f64 / 2_f64.powi(64);
    let other = draws(&with("9f86d081884c7d659a2feaa0c55ad016"));
    let held: Vec<usize> = (0..RUNS).filter(|run| truth.is_held_out(*run)).collect();
    let guesses: [(&str, &dyn Fn(usize) -> bool); 4] = [
        ("class, same stream", &|run| {
            usize::from(unit("class", run) >= 0.5) == truth.class(run)
        }),
        ("which, same stream", &|run| unit("held_out", run) < 0.5),
        ("class, other secret", &|run| {
            other.class(run) == truth.class(run)
        }),
        ("which, other secret", &|run| other.is_held_out(run)),
    ];
    for (guess, is_right) in guesses {
        let right = held.iter().filter(|run| is_right(**run)).count() as f64;
        let off = right - 0.5 * held.len() as f64;
        assert!(
            off.abs() < 4.0 * (0.25 * held.len() as f64).sqrt(),
            "{guess}: {right} of {}",
            held.len()
        );
    }
    // Nor are values and seeds those of the open stream.
    let shared = held.iter().filter_map(|run| Some((*run, seed_of(*run)?)));
    for (run, seed) in shared.take(100) {
        assert_ne!(
            seed,
            bits(&[both[0], run as u64, word(KEY)]) >> 11,
            "run {run}"
        );
    }
    let same = held.iter().filter(|run| {
        truth.first(BASE, **run).unwrap().values == other.first(BASE, **run).unwrap().values
    });
    assert_eq!(same.count(), 0);
}

#[test]
fn regress_a_weak_secret_is_refused() {
    for secret in [
        "",
        "secret = \"12345\"",
        "secret = \"00000000000000000000000000000001\"",
    ] {
        let told =
            refusals(&PLAN.replace("runs = 60", &format!("runs = 60\nheld_out = 0.5\n{secret}")));
        assert!(
            told[0].contains("secret") && told[0].contains("openssl rand -hex 16"),
            "{told:?}"
        );
    }
}

#[test]
fn prop_splits_share_no_conditions_and_have_their_shares() {
    let plan = PLAN.replace("runs = 60", "runs = 2000").replace(
        "{ normal = [500, 100], within = [300, 700] }",
        "{ uniform = [300, 700] }",
    );
    let split = |more: &str| {
        draws(&plan.replace(
            "[vary]",
            &format!("[split]\nvalidation = 0.1\ntest = 0.2\n{more}\n[vary]"),
        ))
    };
    let count = |draws: &Draws, part| {
        (0..2000).filter(|run| draws.part(*run) == part).count() as f64 / 2000.0
    };
    let divided = split("");
    // 64 groups of two keys in eight bands each.
    for (part, share) in [
        (Part::Validation, 0.1),
        (Part::Test, 0.2),
        (Part::Train, 0.7),
    ] {
        assert!((count(&divided, part) - share).abs() < 0.03, "{part:?}");
    }
    let [speed, load] =
        ["operation.speed_rpm", "operation.load_n.0"].map(|key| numbers(&divided, key));
    // Bands of equal probability are here bands of equal width.
    let band = |run: usize| ((speed[run] - 1000.0) / 250.0) as usize;
    let group = |run: usize| (band(run), ((load[run] - 300.0) / 50.0) as usize);
    let mut of_group = std::collections::HashMap::new();
    for run in 0..2000 {
        let part = *of_group.entry(group(run)).or_insert(divided.part(run));
        assert_eq!(part, divided.part(run), "run {run}");
    }
    assert_eq!(of_group.len(), 64);
    // By one key, whole bands go one way.
    let by = split("by = [\"operation.speed_rpm\"]");
    let mut of_band = std::collections::HashMap::new();
    for run in 0..2000 {
        let part = *of_band.entry(band(run)).or_insert(by.part(run));
        assert_eq!(part, by.part(run), "run {run}");
    }
    // Each run by itself, and what cannot be.
    assert!((count(&split("by = []"), Part::Test) - 0.2).abs() < 0.001);
    let refused = |more: &str| refusals(&plan.replace("[vary]", &format!("{more}\n[vary]")));
    assert!(
        refused("[split]\ntest = 0.2\nby = [\"lubricant.viscosity_pa_s\"]")[0]
            .contains("[vary] draws no such key")
    );
    assert!(
        refused("[split]\ntest = 0.5\nvalidation = 0.5")[0].contains("leave none to train with")
    );
    assert!(refused("out_of_range = \"redraw\"\n[split]\ntest = 0.5")[0].contains("drawn again"));
}

#[test]
fn prop_no_severity_that_is_held_out_is_in_training_or_validation() {
    let plan = |split: &str| {
        PLAN.replace("runs = 60", "runs = 600")
            .replace("[vary]", &format!("[split]\n{split}\n[vary]"))
    };
    let key = "defects.0.depth_um";
    let range = "severity = [\"defects.0.depth_um\"]\nseverity_range = [10, 20]";
    let with = draws(&plan(&format!("validation = 0.1\ntest = 0.2\n{range}")));
    let without = draws(&plan("validation = 0.1\ntest = 0.2"));
    let (mut held, mut others) = (0, 0);
    for run in 0..600 {
        let depth = number(&with, run, key);
        let is_held = depth.is_some_and(|depth| (10.0..=20.0).contains(&depth));
        // Elsewhere groups go their way as before.
        let expected = match is_held {
            true => Part::Test,
            false => without.part(run),
        };
        assert_eq!(with.part(run), expected, "run {run}: {depth:?}");
        held += usize::from(is_held && without.part(run) == Part::Train);
        others += usize::from(depth.is_some() && with.part(run) == Part::Train);
    }
    assert!(held > 10 && others > 10, "{held}, {others}");
    // Without shares, the test is that range alone.
    let alone = draws(&plan(range));
    for run in 0..600 {
        let depth = number(&alone, run, key);
        let is_held = depth.is_some_and(|depth| (10.0..=20.0).contains(&depth));
        assert_eq!(alone.part(run) == Part::Test, is_held, "run {run}");
    }
    for (split, words) in [
        ("severity = [\"defects.0.depth_um\"]", "which severities"),
        ("severity_range = [10, 20]", "of no key"),
        (
            "severity = [\"defects.0.depth\"]\nseverity_range = [10, 20]",
            "no class draws numbers of this key",
        ),
        (
            "severity = [\"defects.0.depth_um\"]\nseverity_range = [1e6, 2e6]",
            "no run draws a severity of this range",
        ),
        (
            "severity = [\"defects.0.depth_um\", \"operation.speed_rpm\"]\nseverity_range = [0, 1e6]",
            "leaves no run to train with",
        ),
    ] {
        let told = refusals(&plan(split));
        assert!(told[0].contains(words), "{split}: {told:?}");
    }
}

#[test]
fn regress_bad_plans_are_told_with_key_line_and_range() {
    let long = ["a"; 40].join(".");
    let long = format!("base = 'b'\nruns = 3\n[vary]\n\"{long}\" = 1");
    let keys: String = (0..3000).map(|k| format!("k{k} = 1\n")).collect();
    let many = format!("base = 'b'\nruns = 3\n[vary]\n{keys}");
    for (plan, parts) in [
        (
            many.as_str(),
            vec!["vary: 3000 keys vary", "allowed: at most 2000 keys"],
        ),
        (
            long.as_str(),
            vec!["the path of a key has 40 parts; there are at most 32"],
        ),
        (
            "runs = 3",
            vec!["base: missing: a string in quotes is required"],
        ),
        (
            "base = 'b'\nruns = 0",
            vec!["line 2: runs = 0: out of range", "allowed: 1 to 1e6"],
        ),
        (
            "base = 'b'\nruns = 3\nrun_per_file = 3",
            vec!["line 3: run_per_file = 3: unknown key; did you mean `runs_per_file`?"],
        ),
        (
            "base = 'b'\nruns = 3\ndesign = 'sobl'",
            vec!["design = \"sobl\": unknown word; did you mean \"sobol\"?"],
        ),
        (
            "base = 'b'\nruns = 3\nsignals = []",
            vec!["a data set without signals"],
        ),
        (
            "base = 'b'\nruns = 3\nvary = 3",
            vec!["expected a section [vary]"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { uniform = [3, 1] }",
            vec![
                "line 3: vary.a.b = { uniform = [3, 1] }: the ends are reversed; [1.0, 3.0] is meant",
            ],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = [0, { uniform = [3, 3] }]",
            vec!["vary.a.b.1 = { uniform = [3, 3] }: the ends are equal"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { log = [0, 1] }",
            vec!["a logarithm needs ends above 0"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { normal = [0, 0] }",
            vec!["the standard deviation is not positive"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { normal = [0, 1], within = [90, 99] }",
            vec!["less than a millionth"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { uniform = [0, 1], within = [0, 1] }",
            vec!["`uniform` has no option `within`"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { uniform = [0, 1], log = [1, 2] }",
            vec!["`uniform` and `log` at once"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { choice = [1, 2], weights = [1] }",
            vec!["a weight of 0 or more for each value"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { grid = '1:2' }",
            vec![
                "a range has three parts",
                "\n  allowed: a list, or a range \"FROM:TO:STEP\"",
            ],
        ),
        (
            "base = 'b'\nruns = 3\nvary.simulation.record = ['a']",
            vec!["`signals` says what is recorded"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = { grid = [1, 2, 3, 4] }",
            vec![
                "runs = 3: class \"all\" has 3 of the plan's 3 runs, and its grids have 4 combinations",
                "about 4 runs",
            ],
        ),
        (
            "base = 'b'\nruns = 3\n[[classes]]\nname = 'a'\n[[classes]]\nname = 'a'",
            vec!["classes.1.name = \"a\": the name comes twice"],
        ),
        (
            "base = 'b'\nruns = 3\n[[classes]]\nname = 'a'\nshare = 0",
            vec!["every class has a share of 0"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.defects.0.depth_um = 3\n[[classes]]\nname = 'a'\ndefects = []",
            vec!["this class has defects of its own"],
        ),
        (
            "base = 'b'\nruns = 3\nvary.a.b = 3\n[[classes]]\nname = 'a'\nvary.a.b = 4",
            vec!["classes.0.vary.a.b: set in [vary] too"],
        ),
    ] {
        let said = refusals(plan).join("\n");
        for part in parts {
            assert!(said.contains(part), "{plan}\n--\n{said}");
        }
    }
}
