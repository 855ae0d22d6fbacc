//! The command on scenarios that name files of damage.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

fn brinell(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_brinell")).args(arguments).output().unwrap()
}

#[test]
fn regress_examples_from_files_run_and_their_results_run_again_without_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    for (name, file) in [("photo", "photo-spall.png"), ("scan", "scan.csv")] {
        let scenario = examples().join(format!("{name}.toml")).display().to_string();
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
            assert!(result.status.success(), "{name}: {}", String::from_utf8_lossy(&result.stderr));
        };
        let (first, second) = (at(&format!("{name}-1")), at(&format!("{name}-2")));
        run(&scenario, &first);
        // Its own results, with what they say of the file, give way.
        run(&scenario, &first);
        let resolved = format!("{first}/scenario.toml");
        let text = std::fs::read_to_string(&resolved).unwrap();
        assert!(text.contains(&format!("read from {file}")), "{name}");
        run(&resolved, &second);
        let signals = |out: &str| std::fs::read(format!("{out}/signals.csv")).unwrap();
        assert!(signals(&first) == signals(&second), "{name}: another signal without the file");
    }
}

#[test]
fn regress_a_written_scenario_says_what_was_assumed_of_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let list = |scenario: &str, more: &[&str]| {
        let result = brinell(&[&["check", scenario, "--assumptions"], more].concat());
        assert!(result.status.success(), "{result:?}");
        let text = String::from_utf8(result.stdout).unwrap();
        let list = text.split("Assumed, because it was not given:\n").nth(1);
        list.unwrap().to_owned()
    };
    for (name, of_file) in
        [("photo", &["threshold = 0.67", "blur_px = 1.5 px", "speck_mm2"][..]), ("scan", &["depth_map.zero"])]
    {
        let scenario = examples().join(format!("{name}.toml"));
        let scenario = scenario.display().to_string();
        let out = folder.path().join(name).display().to_string();
        let short = "simulation.duration_s=0.005";
        let run = ["run", &scenario, "-o", &out, "-q", "--no-report", "--set", short];
        assert!(brinell(&run).status.success());
        let written = format!("{out}/scenario.toml");
        let source = list(&scenario, &[]);
        for words in of_file {
            assert!(source.contains(words), "no {words} in {source}");
        }
        assert_eq!(list(&written, &[]), source);
        // Geometry of its author's own came of no file.
        let own = "defects.0.shape={rectangle={length_mm=1.0,width_mm=2.0}}";
        let own = list(&written, &["--set", own]);
        assert!(!own.contains("defects.0.shape"), "{own}");
    }
}

#[test]
fn regress_a_bad_file_ends_with_2_and_names_key_and_file() {
    let scenario = examples().join("photo.toml").display().to_string();
    for (set, wanted) in [
        ("defects.0.shape.image.file=none.png", "none.png"),
        ("defects.0.shape.image.file=scan.csv", "cannot be read as an image"),
        ("defects.0.shape.image.mm_per_pixel=0", "out of range"),
        ("defects.0.shape.image.mm_per_pixel=0.1", "off the raceway's edge"),
    ] {
        let result = brinell(&["check", &scenario, "--set", set]);
        let words = String::from_utf8_lossy(&result.stderr).into_owned();
        assert_eq!(result.status.code(), Some(2), "{set}: {words}");
        assert!(words.contains(wanted) && words.contains("defects.0.shape.image"), "{words}");
    }
}

#[test]
fn regress_a_file_that_is_no_damage_is_reported_with_its_line_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("empty.png"), "").unwrap();
    std::fs::write(at("drawing.png"), "<svg xmlns=\"http://www.w3.org/2000/svg\"/>").unwrap();
    std::fs::write(at("ragged.csv"), "1,2,3\n1,2\n1,2,3\n").unwrap();
    let holes = ["nan,1,nan,nan"; 4].join("\n");
    std::fs::write(at("holes.csv"), holes).unwrap();
    let photo = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/photo-spall.png");
    std::fs::copy(photo, at("spall.png")).unwrap();
    let image = |file: &str, scale: f64| format!("image = {{ file = \"{file}\", mm_per_pixel = {scale} }}");
    let scan = |file: &str| format!("depth_map = {{ file = \"{file}\", ds_mm = 0.1, dz_mm = 0.1 }}");
    for (shape, words) in [
        (image("empty.png", 0.02), "the file is empty"),
        (image("drawing.png", 0.02), "should be PNG, but its content is SVG"),
        (image("nowhere.png", 0.02), "cannot read"),
        (image("spall.png", 5.0), "its size follows from mm_per_pixel = 5"),
        (image("spall.png", 1e-6), "check `mm_per_pixel` = 0.000001"),
        (scan("ragged.csv"), "line 2 has 2 values where the first row has 3"),
        (scan("holes.csv"), "12 of 16 points are missing"),
    ] {
        let depth = if shape.starts_with("image") { "depth_um = 8\n" } else { "" };
        let text = format!(
            "name = \"t\"\n[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800.0\nload_n = [300.0, 0.0]\n\
             [[defects]]\non = \"outer-raceway\"\n{depth}shape = {{ {shape} }}\n[simulation]\nduration_s = 0.1\n"
        );
        let path = at("bad.toml");
        std::fs::write(&path, &text).unwrap();
        let line = text.lines().position(|l| l.starts_with("shape")).unwrap() + 1;
        let to = at("out");
        for command in [&["defect", "preview"][..], &["run"]] {
            let output = Command::new(env!("CARGO_BIN_EXE_brinell"))
                .args(command)
                .args([&path, Path::new("-o"), &to])
                .output()
                .unwrap();
            let error = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{shape}: {error}");
            let place = format!("error, line {line}: defects.0.shape.");
            assert!(error.contains(words) && error.contains(&place), "{shape}: {error}");
            assert!(!to.exists(), "{shape}");
        }
    }
}
