//! The scenarios in `examples/` at the top of the repository: each reads without a word and runs as it is.

mod common;

use brinell::document::{Loaded, read};
use std::path::Path;

/// The first 5 ms hold the whole start-up drop and, in the rectangle case, the first impact.
const SHORT: f64 = 5e-3;

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
            "circle",
            "healthy",
            "inner-race",
            "irregular",
            "rectangle",
            "roller",
            "run-up",
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
        loaded.scenario.simulation.duration_s = SHORT;
        let (rows, outcome) = common::simulate(&loaded.scenario);
        assert_eq!(outcome.rows, rows.data[0].len() as u64, "{stem}");
        for (name, column) in rows.names.iter().zip(&rows.data) {
            assert!(column.iter().all(|x| x.is_finite()), "{stem}: {name}");
        }
        let moved = rows.column("outer_ax").iter().any(|a| *a != 0.0);
        assert!(moved, "{stem}: the outer ring stands still");
    }
}
