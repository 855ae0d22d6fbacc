//! Runs draw what their distributions say, each its own and always the same.

use super::{BASE, PLAN, draws, numbers};
use brinell_study::design::{OutOfRange, Survey, Value};
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;

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
fn prop_a_bearings_waves_are_others_in_every_run() {
    let seeds = |base: &str, plan: &str| -> std::collections::BTreeSet<u64> {
        let draws = draws(plan);
        (0..20).map(|run| draws.scenario(base, run).unwrap().0.scenario.simulation.seed).collect()
    };
    let wavy = BASE.replace("[bearing]", "[bearing]\nwaviness = { amplitude_um = 0.1 }");
    assert_eq!(seeds(&wavy, PLAN).len(), 20);
    let fixed = PLAN.replace("[vary]", "[vary]\nsimulation.seed = 9");
    assert_eq!(seeds(&wavy, &fixed), [9].into());
    assert!(draws(PLAN).is_seed("simulation.seed") && !draws(&fixed).is_seed("simulation.seed"));
    // Smooth surfaces have no phases.
    assert_eq!(seeds(BASE, PLAN), [1].into());
}

#[test]
fn prop_a_sensors_noise_is_another_in_every_run() {
    let seeds = |base: &str, plan: &str| -> Vec<u64> {
        let draws = draws(plan);
        let seed = |run| draws.scenario(base, run).unwrap().0.scenario.sensor.noise_seed;
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
    let more = draws(&PLAN.replace("[vary]", "[vary]\nbearing.radial_clearance_um = { uniform = [1, 2] }"));
    assert_eq!(numbers(&one, "operation.speed_rpm"), numbers(&more, "operation.speed_rpm"));
}

#[test]
fn analytic_distributions_have_their_moments() {
    // 4000 independent runs: means within 4.5 standard errors of the distributions'.
    let plan = PLAN.replace("runs = 60", "runs = 6000").replace(", within = [300, 700]", "");
    let draws = draws(&plan);
    let check = |key: &str, of: fn(f64) -> f64, mean: f64, deviation: f64| {
        let x: Vec<f64> = numbers(&draws, key).into_iter().map(of).collect();
        let n = x.len() as f64;
        let found = x.iter().sum::<f64>() / n;
        assert!((found - mean).abs() < 4.5 * deviation / n.sqrt(), "{key}: mean {found}");
        let spread = (x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt();
        assert!((spread / deviation - 1.0).abs() < 0.06, "{key}: deviation {spread}");
    };
    check("operation.speed_rpm", |x| x, 2000.0, 2000.0 / 12_f64.sqrt());
    check("operation.load_n.0", |x| x, 500.0, 100.0);
    check("defects.0.depth_um", f64::log10, 1.0, 2.0 / 12_f64.sqrt());
}

#[test]
fn prop_designs_fill_each_distribution_evenly() {
    // 64 runs of one class: a Latin hypercube and a Sobol sequence have one in each 64th part, independent draws have
    // not.
    let plan = |design: &str| {
        format!(
            "base = 'b'\nruns = 64\ndesign = '{design}'\n[vary]\noperation.speed_rpm = {{ uniform = [0, 64] }}\n\
             operation.load_n = [{{ uniform = [0, 64] }}, {{ uniform = [0, 64] }}]\n"
        )
    };
    for (design, even) in [("latin-hypercube", true), ("sobol", true), ("random", false)] {
        let draws = draws(&plan(design));
        for key in ["operation.speed_rpm", "operation.load_n.0", "operation.load_n.1"] {
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
            format!("[[classes]]\nname = 'c{k}'\nvary.bearing.radial_clearance_um = {{ uniform = [1, 2] }}\n")
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
        *counts.entry((of("operation.speed_rpm"), of("simulation.model"))).or_insert(0) += 1;
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
    let k = draws.parameters().iter().position(|p| p.key == "bearing.preset").unwrap();
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
    assert!(slices.iter().all(|n| (n - 1000_i32).abs() < 123), "{slices:?}");
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
        Survey::of(&draws(&plan(policy)), BASE, one, NonZeroUsize::new(threads).unwrap(), &AtomicBool::new(false))
    };
    let found = survey("refuse", 1);
    assert_eq!(found, survey("refuse", 2));
    // A Latin hypercube puts exactly half of the runs below the median.
    assert_eq!((found.runs, found.unfit, found.hopeless), (1000, 500, 500));
    let [miss] = &found.errors[..] else { panic!("{:?}", found.errors) };
    assert_eq!(miss.problem.key, "lubricant.viscosity_pa_s");
    assert_eq!((miss.count, miss.problem.allowed.as_deref()), (500, Some(">= 0")));
    assert!(!found.is_sound(OutOfRange::Refuse) && found.is_sound(OutOfRange::Fail));
    let redrawn = survey("redraw", 2);
    assert_eq!((redrawn.unfit, redrawn.hopeless), (500, 0));
    assert!(redrawn.is_sound(OutOfRange::Redraw));
    // What is drawn again fits, and follows the half normal: its mean is sqrt(2/pi).
    let draws = draws(&plan("redraw"));
    let eta = |run| draws.scenario(BASE, run).unwrap().0.scenario.lubricant.viscosity_pa_s;
    let mean = (0..1000).map(eta).inspect(|x| assert!(*x >= 0.0)).sum::<f64>() / 1000.0;
    let (expected, error) = ((2.0 / std::f64::consts::PI).sqrt(), 0.603 / 1000_f64.sqrt());
    assert!((mean - expected).abs() < 4.5 * error, "{mean}");
}
