//! Bad plans are refused with key, line and range.

use super::refusals;

#[test]
fn regress_bad_plans_are_reported_with_key_line_and_range() {
    let long = ["a"; 40].join(".");
    let long = format!("[vary]\n\"{long}\" = 1");
    let keys: String = (0..3000).map(|k| format!("k{k} = 1\n")).collect();
    let many = format!("[vary]\n{keys}");
    let head = "base = 'b'\nruns = 3\n";
    for (plan, parts) in [
        (many.as_str(), vec!["vary: 3000 keys vary", "allowed: at most 2000 keys"]),
        (long.as_str(), vec!["the path of a key has 40 parts; there are at most 32"]),
        ("run_per_file = 3", vec!["line 3: run_per_file = 3: unknown key; did you mean `runs_per_file`?"]),
        ("design = 'sobl'", vec!["design = \"sobl\": unknown word; did you mean \"sobol\"?"]),
        ("signals = []", vec!["a data set without signals"]),
        ("vary = 3", vec!["expected a section [vary]"]),
        (
            "vary.a.b = { uniform = [3, 1] }",
            vec!["line 3: vary.a.b = { uniform = [3, 1] }: the ends are reversed; [1.0, 3.0] is meant"],
        ),
        ("vary.a.b = [0, { uniform = [3, 3] }]", vec!["vary.a.b.1 = { uniform = [3, 3] }: the ends are equal"]),
        ("vary.a.b = { log = [0, 1] }", vec!["a logarithm needs ends above 0"]),
        ("vary.a.b = { normal = [0, 0] }", vec!["the standard deviation is not positive"]),
        ("vary.a.b = { normal = [0, 1], within = [90, 99] }", vec!["less than a millionth"]),
        ("vary.a.b = { uniform = [0, 1], within = [0, 1] }", vec!["`uniform` has no option `within`"]),
        ("vary.a.b = { uniform = [0, 1], log = [1, 2] }", vec!["`uniform` and `log` at once"]),
        ("vary.a.b = { choice = [1, 2], weights = [1] }", vec!["a weight of 0 or more for each value"]),
        (
            "vary.a.b = { grid = '1:2' }",
            vec!["a range has three parts", "\n  allowed: a list, or a range \"FROM:TO:STEP\""],
        ),
        ("vary.simulation.record = ['a']", vec!["`signals` says what is recorded"]),
        (
            "vary.a.b = { grid = [1, 2, 3, 4] }",
            vec![
                "runs = 3: class \"all\" has 3 of the plan's 3 runs, and its grids have 4 combinations",
                "about 4 runs",
            ],
        ),
        ("[[classes]]\nname = 'a'\n[[classes]]\nname = 'a'", vec!["classes.1.name = \"a\": the name comes twice"]),
        ("[[classes]]\nname = 'a'\nshare = 0", vec!["every class has a share of 0"]),
        (
            "vary.defects.0.depth_um = 3\n[[classes]]\nname = 'a'\ndefects = []",
            vec!["this class has defects of its own"],
        ),
        ("vary.a.b = 3\n[[classes]]\nname = 'a'\nvary.a.b = 4", vec!["classes.0.vary.a.b: set in [vary] too"]),
    ] {
        let said = refusals(&format!("{head}{plan}")).join("\n");
        for part in parts {
            assert!(said.contains(part), "{plan}\n--\n{said}");
        }
    }
    assert!(refusals("runs = 3")[0].contains("base: missing: a string in quotes is required"));
    let none = refusals("base = 'b'\nruns = 0").join("\n");
    assert!(none.contains("line 2: runs = 0: out of range") && none.contains("allowed: 1 to 1e6"), "{none}");
}
