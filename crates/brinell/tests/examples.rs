//! The scenarios in `examples/` at the top of the repository: each reads without a word and runs as it is.
//!
//! Two of them name a file of damage, which the core does not open: `crates/brinell-damage/tests/resolve.rs` runs
//! those.

use brinell::document::{Loaded, read};
use brinell::model::Model;
use std::path::Path;

/// The first 5 ms hold the whole start-up drop and, in the rectangle case, the first impact.
const SHORT: f64 = 5e-3;

/// Examples whose damage is a file's, by the file.
const FROM_FILES: [(&str, &str); 2] = [("photo", "photo-spall.png"), ("scan", "scan.csv")];

/// File stem and scenario of every example.
fn examples() -> Vec<(String, Loaded)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut paths: Vec<_> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    paths.sort();
    assert!(!paths.is_empty(), "no examples in {}", folder.display());
    paths
        .iter()
        .map(|path| {
            let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
            let text = std::fs::read_to_string(path).unwrap();
            match read(&text, &[]) {
                Ok(loaded) => (stem, loaded),
                Err(problems) => {
                    let words: Vec<_> = problems.iter().map(ToString::to_string).collect();
                    panic!("{stem}: {}", words.join("\n"));
                }
            }
        })
        .collect()
}

#[test]
fn regress_examples_read_without_warnings_under_their_own_names() {
    let examples = examples();
    let stems: Vec<&str> = examples.iter().map(|(stem, _)| stem.as_str()).collect();
    assert_eq!(
        stems,
        [
            "ball-6205",
            "circle",
            "healthy",
            "inner-race",
            "irregular",
            "motor",
            "one-sided",
            "photo",
            "rectangle",
            "roller",
            "run-up",
            "scan",
            "sensor",
            "single-row",
        ]
    );
    for (stem, loaded) in &examples {
        assert_eq!(&loaded.scenario.name, stem);
        assert_eq!(loaded.warnings, [], "{stem}");
    }
}

#[test]
fn prop_examples_run() {
    for (stem, mut loaded) in examples() {
        if let Some((_, file)) = FROM_FILES.iter().find(|(name, _)| *name == stem) {
            assert_eq!(loaded.scenario.defects[0].shape.file(), Some(*file));
            let refused = Model::new(&loaded.scenario).err().map(|e| e.to_string());
            let words = refused.unwrap_or_default();
            assert!(words.contains("read it first"), "{stem}: {words}");
            continue;
        }
        loaded.scenario.simulation.duration_s = SHORT;
        let (rows, outcome) = crate::common::simulate(&loaded.scenario);
        assert_eq!(outcome.rows, rows.data[0].len() as u64, "{stem}");
        for (name, column) in rows.names.iter().zip(&rows.data) {
            assert!(column.iter().all(|x| x.is_finite()), "{stem}: {name}");
        }
        let ring = if loaded.scenario.machine.is_some() { "bearing1.outer_ax" } else { "outer_ax" };
        let moved = rows.column(ring).iter().any(|a| *a != 0.0);
        assert!(moved, "{stem}: the outer ring does not move");
    }
}

/// A newcomer types what comes first: one command that does the main job, one that passes the tests.
#[test]
fn regress_readme_begins_with_its_two_commands() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../README.md");
    let text = std::fs::read_to_string(readme).unwrap();
    let blocks: Vec<&str> = text.split("```").skip(1).step_by(2).take(2).collect();
    let run = "sh\ncargo run --release -- run examples/rectangle.toml -o out/rectangle\n";
    assert_eq!(blocks, [run, "sh\ncargo test\n"]);
}
