//! The command on scenarios that name files of damage.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

fn brinell(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_brinell"))
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn regress_examples_from_files_run_and_their_results_run_again_without_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    for (name, file) in [("photo", "photo-spall.png"), ("scan", "scan.csv")] {
        let scenario = examples()
            .join(format!("{name}.toml"))
            .display()
            .to_string();
        let run = |scenario: &str, out: &str| {
            let result = brinell(&[
                "run",
                scenario,
                "-o",
                out,
                "--signals",
                "csv",
                "--no-report",
                "--set",
                "simulation.duration_s=0.005",
            ]);
            assert!(
                result.status.success(),
                "{name}: {}",
                String::from_utf8_lossy(&result.stderr)
            );
        };
        let (first, second) = (at(&format!("{name}-1")), at(&format!("{name}-2")));
        run(&scenario, &first);
        let resolved = format!("{first}/scenario.toml");
        let text = std::fs::read_to_string(&resolved).unwrap();
        assert!(text.contains(&format!("read from {file}")), "{name}");
        run(&resolved, &second);
        let signals = |out: &str| std::fs::read(format!("{out}/signals.csv")).unwrap();
        assert!(
            signals(&first) == signals(&second),
            "{name}: another signal without the file"
        );
    }
}

#[test]
fn regress_a_bad_file_ends_with_2_and_names_key_and_file() {
    let scenario = examples().join("photo.toml").display().to_string();
    for (set, wanted) in [
        ("defects.0.shape.image.file=none.png", "none.png"),
        (
            "defects.0.shape.image.file=scan.csv",
            "cannot be read as an image",
        ),
        ("defects.0.shape.image.mm_per_pixel=0", "out of range"),
        (
            "defects.0.shape.image.mm_per_pixel=0.1",
            "off the raceway's edge",
        ),
    ] {
        let result = brinell(&["check", &scenario, "--set", set]);
        let words = String::from_utf8_lossy(&result.stderr).into_owned();
        assert_eq!(result.status.code(), Some(2), "{set}: {words}");
        assert!(
            words.contains(wanted) && words.contains("defects.0.shape.image"),
            "{words}"
        );
    }
}
