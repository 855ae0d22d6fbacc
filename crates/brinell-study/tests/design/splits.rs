//! The parts of a data set: training, validation and test.

use super::{PLAN, SECRET, draws, number, numbers, refusals};
use brinell_study::design::{Draws, Part};

#[test]
fn prop_splits_share_no_conditions_and_have_their_shares() {
    let plan = PLAN
        .replace("runs = 60", "runs = 2000")
        .replace("{ normal = [500, 100], within = [300, 700] }", "{ uniform = [300, 700] }");
    let split =
        |more: &str| draws(&plan.replace("[vary]", &format!("[split]\nvalidation = 0.1\ntest = 0.2\n{more}\n[vary]")));
    let count = |draws: &Draws, part| (0..2000).filter(|run| draws.part(*run) == part).count() as f64 / 2000.0;
    let divided = split("");
    // 64 groups of two keys in eight bands each.
    for (part, share) in [(Part::Validation, 0.1), (Part::Test, 0.2), (Part::Train, 0.7)] {
        assert!((count(&divided, part) - share).abs() < 0.03, "{part:?}");
    }
    let [speed, load] = ["operation.speed_rpm", "operation.load_n.0"].map(|key| numbers(&divided, key));
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
        refused("[split]\ntest = 0.2\nby = [\"lubricant.viscosity_pa_s\"]")[0].contains("[vary] draws no such key")
    );
    assert!(refused("[split]\ntest = 0.5\nvalidation = 0.5")[0].contains("leave none to train with"));
    assert!(refused("out_of_range = \"redraw\"\n[split]\ntest = 0.5")[0].contains("drawn again"));
    let secret = "held_out = 1.0\nsecret = \"9f86d081884c7d659a2feaa0c55ad015\"";
    assert!(refused(&format!("{secret}\n[split]\ntest = 0.2"))[0].contains("none is left to split"));
    // Groups of one run are said, where they are not asked for.
    for (runs, by, said) in [(2000, "", false), (60, "", true), (60, "by = []", false)] {
        let few = plan.replace("runs = 2000", &format!("runs = {runs}"));
        let notes = draws(&few.replace("[vary]", &format!("[split]\ntest = 0.2\n{by}\n[vary]"))).notes();
        assert_eq!(notes.iter().any(|note| note.contains("groups of like conditions")), said, "{runs} {by}: {notes:?}");
    }
}

#[test]
fn prop_runs_are_counted_by_split_and_class_and_a_split_without_a_class_is_noted() {
    // Four runs, one of them for the test.
    let plan = |by: &str| {
        PLAN.replace("[vary]", &format!("[split]\ntest = 0.3\nby = {by}\n[vary]"))
            .replace("share = 2\n", "")
            .replace("runs = 60", "runs = 4")
    };
    for by in ["[]", "[\"operation.speed_rpm\"]"] {
        let draws = draws(&plan(by));
        let splits = draws.splits();
        assert_eq!(splits.iter().map(|(part, _)| *part).collect::<Vec<_>>(), [Part::Train, Part::Test]);
        for (part, runs) in &splits {
            for (class, count) in runs.iter().enumerate() {
                let mine = (0..4).filter(|run| draws.part(*run) == *part && draws.class(*run) == class);
                assert_eq!(mine.count(), *count);
            }
            let absent = runs.contains(&0);
            let noted = format!("the split {} has no run of class", part.word());
            assert_eq!(draws.notes().iter().any(|note| note.starts_with(&noted)), absent, "{by}: {splits:?}");
        }
        // Each run by itself, one is for the test: of one class.
        assert!(by != "[]" || splits[1].1.contains(&0));
    }
    assert!(draws(PLAN).notes().is_empty());
}

#[test]
fn prop_values_with_a_unit_are_the_same_conditions_as_their_numbers() {
    let speeds = "{ choice = [\"30 Hz\", 1800, \"20 Hz\", 1200.0, \"1200 r/min\", 900] }";
    let plan = PLAN
        .replace("runs = 60", "runs = 300")
        .replace("{ uniform = [1000, 3000] }", speeds)
        .replace("{ log = [1, 100] }", "{ choice = [\"0.02 mm\", 5] }")
        .replace(
            "[vary]",
            "[split]\ntest = 0.3\nby = [\"operation.speed_rpm\"]\nseverity = [\"defects.0.depth_um\"]\nseverity_range = [19, 21]\n[vary]",
        );
    let draws = draws(&plan);
    let numeric = |key: &str| draws.parameters().iter().find(|p| p.key == key).unwrap().numeric;
    assert!(numeric("operation.speed_rpm") && numeric("defects.0.depth_um"));
    let mut of_speed = std::collections::HashMap::new();
    for run in 0..300 {
        let depth = number(&draws, run, "defects.0.depth_um");
        assert!(depth.is_none_or(|depth| [20.0, 5.0].contains(&depth)));
        if depth == Some(20.0) {
            assert_eq!(draws.part(run), Part::Test);
            continue;
        }
        let speed = number(&draws, run, "operation.speed_rpm").unwrap();
        assert_eq!(*of_speed.entry(speed as i64).or_insert(draws.part(run)), draws.part(run), "run {run}: {speed}");
    }
    let mut speeds: Vec<i64> = of_speed.into_keys().collect();
    speeds.sort_unstable();
    assert_eq!(speeds, [900, 1200, 1800]);
    // A list as a sweep has it.
    let grid = PLAN.replace("{ uniform = [1000, 3000] }", "{ grid = \"20 Hz,1500:1800:300\" }");
    let mut speeds = numbers(&self::draws(&grid), "operation.speed_rpm");
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    assert_eq!(speeds, [1200.0, 1500.0, 1800.0]);
}

#[test]
fn prop_what_a_plan_says_in_vain_is_noted() {
    let noted = |plan: &str, words: &str| {
        let notes = draws(plan).notes();
        assert!(notes.iter().any(|note| note.contains(words)), "{words}: {notes:?}");
    };
    noted(
        &PLAN.replace("share = 2", "share = 0.001"),
        "class \"outer\" has no run: its share, 0.001, is too small for 60 runs",
    );
    noted(&format!("{SECRET}\n{PLAN}"), "secret is given and held_out is 0");
    noted(
        &format!("held_out = 0.002\n{SECRET}\n{PLAN}"),
        "held_out = 0.002 holds out none of 60 runs: each is drawn by chance; with 1497 runs, or with held_out = 0.05, one or more are held out with a chance of 95 %",
    );
    let split = "[split]\ntest = 0.2\nseverity = [\"defects.0.depth_um\"]\nseverity_range = [1, 100]\n[vary]";
    noted(
        &PLAN.replace("[vary]", split),
        "the split train has no run of class \"outer\": split.severity_range holds all of its runs",
    );
}

#[test]
fn prop_no_severity_that_is_held_out_is_in_training_or_validation() {
    let plan =
        |split: &str| PLAN.replace("runs = 60", "runs = 600").replace("[vary]", &format!("[split]\n{split}\n[vary]"));
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
        ("severity = [\"defects.0.depth\"]\nseverity_range = [10, 20]", "no class draws numbers of this key"),
        ("severity = [\"defects.0.depth_um\"]\nseverity_range = [1e6, 2e6]", "no run draws a severity of this range"),
        (
            "severity = [\"defects.0.depth_um\", \"operation.speed_rpm\"]\nseverity_range = [0, 1e6]",
            "leaves no run to train with",
        ),
    ] {
        let told = refusals(&plan(split));
        assert!(told[0].contains(words), "{split}: {told:?}");
    }
}
