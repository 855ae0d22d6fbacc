//! `brinell analyze` of several files, or of a folder of them.

use crate::common::{GIVEN, brinell, column, files, impacts, json, parsed};
use std::fs;
use tempfile::{TempDir, tempdir};

/// `records/` with r1 (noise), r2 (empty), r10 (damage), and what is no signal.
fn records() -> TempDir {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join("records").join(name);
    fs::create_dir(folder.path().join("records")).unwrap();
    column(&at("r1.csv"), &impacts(0.0));
    fs::write(at("r2.csv"), "").unwrap();
    column(&at("r10.csv"), &impacts(6.0));
    fs::write(at("notes.txt"), "not a signal").unwrap();
    fs::write(at(".r3.csv"), "").unwrap();
    folder
}

fn call<'a>(what: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [&["analyze"], what, &GIVEN, more].concat()
}

#[test]
fn regress_a_folder_is_a_row_a_file_and_a_bad_one_stops_nothing() {
    let folder = records();
    let more = ["-o", "look", "--json", "all.json", "--machine-class", "2-rigid"];
    let done = brinell(folder.path(), &call(&["records"], &more))
        .exits(1)
        .complains(&["error: 1 of 3 files could not be analysed"])
        .says(&["wrote look/report.html", "wrote all.json"]);
    let rows: Vec<&str> = done.out.lines().filter(|l| l.starts_with('r')).collect();
    assert_eq!(rows.len(), 3, "{}", done.out);
    assert!(rows[0].starts_with("r1.csv") && rows[0].contains("no damage found"));
    assert!(rows[1].starts_with("r2.csv ") && rows[1].contains("no result: the file is empty"));
    assert!(rows[2].starts_with("r10.csv") && rows[2].contains("outer race"));
    // White noise of 1 g RMS up to 6 kHz has 6.3 mm/s from 10 Hz up.
    assert!(rows[0].trim_end().ends_with('D'));

    let all = json(&folder.path().join("all.json"));
    let records = all["records"].as_array().unwrap();
    assert_eq!(records.len(), 3);
    assert_eq!(records[0]["verdict"]["says"], "nothing_found");
    assert_eq!(records[1]["file"]["path"], "records/r2.csv");
    assert!(records[1]["error"].as_str().unwrap().contains("empty"));
    assert_eq!(records[2]["verdict"]["damage"][0], "outer_race");
    assert!(records[2]["severity"]["velocity_rms_10_1000_hz"]["value"].is_number());

    let listed = json(&folder.path().join("look/analysis.json"));
    let mut names: Vec<&str> =
        (listed["files"].as_array().unwrap().iter()).map(|name| name.as_str().unwrap()).collect();
    names.sort_unstable();
    assert_eq!(names, files(&folder.path().join("look")));
    assert!(names.contains(&"plots/trend-rms.svg") && names.contains(&"plots/trend-score.svg"));
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    for part in ["r10.csv", "Files without a result", "Detection score"] {
        assert!(page.contains(part), "{part}");
    }
    // Again into the same folder: these are of the same files.
    brinell(folder.path(), &call(&["records"], &["-o", "look"])).exits(1);
    brinell(folder.path(), &call(&["records/r1.csv"], &["-o", "look"]))
        .exits(2)
        .complains(&["holds results of another signal"]);
}

#[test]
fn regress_several_files_keep_their_order() {
    let folder = records();
    let named = ["records/r10.csv", "records/r1.csv"];
    let done = brinell(folder.path(), &call(&named, &["--json", "-"])).exits(0);
    let all = parsed(&done.out);
    for (record, path) in all["records"].as_array().unwrap().iter().zip(named) {
        assert_eq!(record["file"]["path"], path);
    }
    // One alone is what it always was.
    let one = brinell(folder.path(), &call(&named[..1], &["--json", "-"])).exits(0);
    let one = parsed(&one.out);
    assert_eq!(one["verdict"], all["records"][0]["verdict"]);
}

#[test]
fn regress_what_no_file_can_do_without_is_requested_once() {
    let folder = records();
    brinell(folder.path(), &["analyze", "records"])
        .exits(2)
        .complains(&["none of the 3 files could be analysed; the first, r1.csv: 4 things have to be given"]);
    fs::create_dir(folder.path().join("none")).unwrap();
    brinell(folder.path(), &call(&["none"], &[]))
        .exits(2)
        .complains(&["none is a folder without files of signals (csv, "]);
    brinell(folder.path(), &call(&["records"], &["--json", "records/r10.csv"]))
        .exits(2)
        .complains(&["is an input of this command"]);
}

/// Each beside the same record: its level in brackets and on the trend, and lines that it had already.
#[test]
fn regress_several_files_beside_one_healthy_record() {
    let folder = records();
    let other = ["--against", "records/r1.csv", "--against-rate", "12000", "--against-unit", "g", "--healthy"];
    let more = ["-o", "look", "--machine-class", "2-rigid"];
    let named = ["records/r1.csv", "records/r10.csv"];
    let done = brinell(folder.path(), &call(&named, &[&other[..], &more].concat())).exits(0);
    let rows: Vec<&str> = done.out.lines().filter(|l| l.starts_with('r')).collect();
    assert!(rows[0].contains(" g (x 1.00) ") && rows[1].contains(" g (x 1."), "{}", done.out);
    let found = json(&folder.path().join("look/analysis.json"));
    assert_eq!(found["records"][1]["against"]["path"], "records/r1.csv");
    let drawn = |name: &str| fs::read_to_string(folder.path().join("look/plots").join(name)).unwrap();
    assert!(drawn("trend-rms.svg").contains(">the other<"));
    assert!(drawn("trend-score.svg").contains(">high 14.5<"));
    let velocity = drawn("trend-velocity.svg");
    assert!(velocity.contains(">A/B 1.4<") && velocity.contains(">C/D 4.5<"));
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(page.contains("In brackets: the RMS over that of records/r1.csv"));
}

#[test]
fn regress_what_contradicts_what_was_given_is_on_the_page_of_several_files_too() {
    let folder = tempdir().unwrap();
    for name in ["w1.csv", "w2.csv"] {
        let rows: String = impacts(6.0).iter().map(|v| format!("{v:.4}\n")).collect();
        fs::write(folder.path().join(name), format!("acc [mg]\n{rows}")).unwrap();
    }
    let call = brinell(folder.path(), &call(&["w1.csv", "w2.csv"], &["-o", "look"])).exits(0);
    let warned = "--unit g was taken, but the file says mg";
    assert_eq!(call.err.matches(warned).count(), 2, "{}", call.err);
    let listed = json(&folder.path().join("look/analysis.json"));
    assert!(listed["records"][1]["file"]["warnings"].to_string().contains(warned), "{listed}");
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert_eq!(page.matches(warned).count(), 1);
    assert!(page.contains("(in 2 of 2 files looked at, the first of them file w1.csv)"));
}

/// Impacts at times that no frequency explains: headline, table, page and JSON say so.
#[test]
fn regress_impacts_that_no_line_explains_head_no_clean_bill() {
    let folder = tempdir().unwrap();
    let mut x = impacts(0.0);
    // Steps of no pattern.
    let mut at = 100;
    let mut step = 1_usize;
    while at < x.len() {
        x[at] += 15.0;
        step = step * 1_103 % 997;
        at += 20 + step;
    }
    column(&folder.path().join("a.csv"), &x);
    column(&folder.path().join("b.csv"), &impacts(0.0));
    brinell(folder.path(), &call(&["a.csv"], &[])).exits(0).says(&["Cannot tell: the record has impacts (kurtosis "]);
    let done = brinell(folder.path(), &call(&["a.csv", "b.csv"], &["--json", "all.json", "-o", "look"])).exits(0);
    let rows: Vec<&str> = done.out.lines().filter(|l| l.starts_with("a.csv") || l.starts_with("b.csv")).collect();
    assert!(rows[0].contains("cannot tell, impacts") && rows[1].contains("no damage found"), "{}", done.out);
    let all = json(&folder.path().join("all.json"));
    let verdict = &all["records"][0]["verdict"];
    assert_eq!((&verdict["says"], &verdict["unexplained"]), (&"cannot_tell".into(), &"impacts".into()));
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(page.contains("cannot tell, impacts (kurtosis "));
}

#[test]
fn regress_several_channels_are_a_row_each_and_the_clearest_leads() {
    let folder = tempdir().unwrap();
    let rows = impacts(0.0).into_iter().zip(impacts(6.0)).map(|(x, y)| format!("{x},{y}\n"));
    fs::write(folder.path().join("rig.csv"), format!("radial,axial\n{}", rows.collect::<String>())).unwrap();
    let more = ["--channel", "radial", "--channel", "2", "--json", "all.json", "-o", "look"];
    let done = brinell(folder.path(), &call(&["rig.csv"], &more)).exits(0);
    done.says(&["signal", "no damage found", "2 leads: Outer race damage"]);
    let all = json(&folder.path().join("all.json"));
    let channels: Vec<&str> =
        all["records"].as_array().unwrap().iter().map(|r| r["file"]["channel"].as_str().unwrap()).collect();
    assert_eq!(channels, ["radial", "axial"]);
    assert!(all["leading"].as_str().unwrap().starts_with("2 leads: Outer race damage"));
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(page.contains("2 channels, damage called in 1") && page.contains("2 leads: Outer race"));
    // One that is not there, beside one that is; and calibrate fits to one.
    let more = ["--channel", "radial", "--channel", "tangential"];
    brinell(folder.path(), &call(&["rig.csv"], &more))
        .exits(1)
        .complains(&["error: 1 of 2 signals could not be analysed"]);
}

/// The page, and of each channel that has one what is under its heading: its name, the verdict's colour, and the rest.
fn shown(folder: &TempDir) -> (String, Vec<(String, String, String)>) {
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap().replace("<wbr>", "");
    let verdicts = page.split("<section id=\"verdicts\">").nth(1).unwrap().split("<section id=").next().unwrap();
    let one = |block: &str| {
        let (name, rest) = block.split_once("</h3>").unwrap();
        let class = rest.split("<p class=\"verdict ").nth(1).unwrap().split('"').next().unwrap();
        (name.to_owned(), class.to_owned(), rest.to_owned())
    };
    let all = verdicts.split("<h3>").skip(1).map(one).collect();
    (page, all)
}

#[test]
fn prop_every_channel_shows_what_its_verdict_rests_on_the_damaged_first() {
    let folder = tempdir().unwrap();
    let rows = impacts(0.0).into_iter().zip(impacts(6.0)).map(|(x, y)| format!("{x},{y}\n"));
    fs::write(folder.path().join("rig.csv"), format!("radial,axial\n{}", rows.collect::<String>())).unwrap();
    let more = ["--channel", "radial", "--channel", "axial", "-o", "look"];
    brinell(folder.path(), &call(&["rig.csv"], &more)).exits(0);
    let (page, all) = shown(&folder);
    let heads: Vec<(&str, &str)> = all.iter().map(|(name, class, _)| (&**name, &**class)).collect();
    assert_eq!(heads, [("axial", "bad"), ("radial", "good")]);
    for ((_, _, block), (number, open, says)) in
        all.iter().zip([(2, "<details open>", "Outer race damage, clear"), (1, "<details>", "No damage found")])
    {
        // The verdict above, the rest under a line that opens it: lanes of the four frequencies, and their table.
        let (verdict, rest) = block.split_once(open).unwrap();
        assert!(verdict.contains(says), "{verdict}");
        let id = format!("envelope-{number}");
        for part in [&*format!("data-plot=\"{id}\""), &format!("data-chart=\"{id}\""), "BPFO", "BPFI", "inner race"] {
            assert!(rest.contains(part), "{part}");
        }
        assert!(folder.path().join(format!("look/plots/envelope-spectrum-{number}.svg")).is_file());
    }
    // Damage alone runs through the plot, and each verdict is told once.
    assert_eq!(all.iter().map(|(_, _, block)| block.contains("damage, clear</td>")).collect::<Vec<_>>(), [true, false]);
    assert_eq!(page.matches("No damage found").count(), 1);
    assert!(page.contains("the same command with its <code>--channel</code> alone"));
}

#[test]
fn prop_of_many_files_the_most_telling_are_shown_and_the_page_stays_small() {
    let folder = tempdir().unwrap();
    let records = folder.path().join("records");
    fs::create_dir(&records).unwrap();
    for k in 1..=11 {
        // Two are damaged, the later one more.
        let strength = match k {
            6 => 4.0,
            10 => 8.0,
            _ => 0.0,
        };
        column(&records.join(format!("r{k}.csv")), &impacts(strength));
    }
    column(&records.join("short.csv"), &impacts(6.0)[..2000]);
    brinell(folder.path(), &call(&["records"], &["-o", "look"])).exits(0);
    let (page, all) = shown(&folder);
    let names: Vec<&str> = all.iter().map(|(name, ..)| &**name).collect();
    assert_eq!(names, ["r10.csv", "r6.csv", "r1.csv", "r2.csv", "r3.csv", "r4.csv", "r5.csv", "r7.csv"]);
    assert!(page.contains("Of 11, the 8 whose verdicts say most") && page.contains("with its file alone"), "{page}");
    let others = page.split("Other verdicts").nth(1).unwrap().split("</table>").next().unwrap();
    let told = ["r8.csv", "r9.csv", "r11.csv", "short.csv"].map(|name| others.matches(name).count());
    assert_eq!((told, others.matches("r10.csv").count()), ([1; 4], 0));
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
}
