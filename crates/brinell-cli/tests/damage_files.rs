//! The command on scenarios that name files of damage.

use crate::common::{brinell, example, typed};
use std::path::Path;

#[test]
fn regress_examples_from_files_run_and_their_results_run_again_without_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for (name, file) in [("photo", "photo-spall.png"), ("scan", "scan.csv")] {
        let scenario = example(&format!("{name}.toml"));
        let run = |scenario: &str, out: &str| {
            let args = typed(
                "run --signals csv --no-report --set simulation.duration_s=0.005 --set simulation.laws=li2023 -o",
            );
            brinell(here, &[&args[..], &[out, scenario]].concat()).exits(0);
        };
        let (first, second) = (format!("{name}-1"), format!("{name}-2"));
        run(&scenario, &first);
        // Its own results, with what they say of the file, give way.
        run(&scenario, &first);
        let resolved = format!("{first}/scenario.toml");
        let text = std::fs::read_to_string(here.join(&resolved)).unwrap();
        assert!(text.contains(&format!("read from {file}")), "{name}");
        run(&resolved, &second);
        let signals = |out: &str| std::fs::read(here.join(out).join("signals.csv")).unwrap();
        assert!(signals(&first) == signals(&second), "{name}: another signal without the file");
    }
}

#[test]
fn regress_a_written_scenario_says_what_was_assumed_of_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let list = |scenario: &str, more: &[&str]| {
        let check = ["check", scenario, "--assumptions", "--set", "simulation.laws=li2023"];
        let call = brinell(folder.path(), &[&check, more].concat()).exits(0);
        let list = call.out.split("Assumed, because it was not given:\n").nth(1);
        list.unwrap().to_owned()
    };
    for (name, of_file) in [
        ("photo", &["threshold = 0.67", "blur_px = 1.5 px", "speck_mm2"][..]),
        ("scan", &["depth_map.zero", "depth_map.radius_mm = 27."]),
    ] {
        let scenario = example(&format!("{name}.toml"));
        let short = "simulation.duration_s=0.005";
        let laws = "simulation.laws=li2023";
        let run = ["run", &scenario, "-o", name, "-q", "--no-report", "--set", short, "--set", laws];
        brinell(folder.path(), &run).exits(0);
        let written = format!("{name}/scenario.toml");
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
    for (set, wanted) in [
        ("defects.0.shape.image.file=none.png", "none.png"),
        ("defects.0.shape.image.file=scan.csv", "cannot be read as an image"),
        ("defects.0.shape.image.mm_per_pixel=0", "out of range"),
        ("defects.0.shape.image.mm_per_pixel=0.5", "off the raceway's edge"),
    ] {
        brinell(Path::new("."), &["check", &example("photo.toml"), "--set", set])
            .exits(2)
            .complains(&[wanted, "defects.0.shape.image"]);
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
    std::fs::copy(example("photo-spall.png"), at("spall.png")).unwrap();
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
             [[defects]]\non = \"outer-raceway\"\n{depth}shape = {{ {shape} }}\n[simulation]\nlaws = \"li2023\"\nduration_s = 0.1\n"
        );
        std::fs::write(at("bad.toml"), &text).unwrap();
        let line = text.lines().position(|l| l.starts_with("shape")).unwrap() + 1;
        for args in ["defect preview bad.toml -o out", "run bad.toml -o out"] {
            let place = format!("error, line {line}: defects.0.shape.");
            brinell(folder.path(), &typed(args)).exits(2).complains(&[words, &place]);
            assert!(!at("out").exists(), "{shape}");
        }
    }
}
