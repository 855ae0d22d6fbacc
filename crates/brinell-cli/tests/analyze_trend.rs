//! `brinell analyze --trend`: records of one machine over time.

use crate::common::{GIVEN, brinell, column, files, impacts, json, normal, parsed};
use brinell::random::Random;
use std::fs;
use std::path::Path;
use tempfile::{TempDir, tempdir};

/// Ten records, six of them without damage, named by `name`; each has its own noise.
fn records(name: impl Fn(usize) -> String) -> TempDir {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("records")).unwrap();
    for k in 0..10usize {
        let height = [1.5, 3.0, 6.0, 12.0].get(k.wrapping_sub(6)).copied().unwrap_or(0.0);
        let mut random = Random::new(k as u64);
        let damage = impacts(height).into_iter().zip(impacts(0.0)).map(|(x, noise)| x - noise);
        let x: Vec<f64> = damage.map(|x| x + normal(&mut random)).collect();
        column(&folder.path().join("records").join(name(k)), &x);
    }
    folder
}

fn trend(folder: &Path, more: &[&str]) -> crate::common::Call {
    brinell(folder, &[&["analyze", "records", "--trend"], &GIVEN[..], more].concat())
}

#[test]
fn regress_dated_records_have_a_trend_on_the_terminal_in_files_and_on_a_page() {
    let folder = records(|k| format!("2024.03.{:02}.06.00.00", 1 + 2 * k));
    let more = ["--limit", "kurtosis=4", "--limit", "rms=40", "--limit", "rms=1.5", "-o", "look", "--json", "all.json"];
    let done = trend(folder.path(), &more).exits(0).says(&[
        "10 records, 2024-03-01 06:00 to 2024-03-19 06:00, by the names of the files",
        "RMS of the latest record is above its limit, 1.5 g. ",
        "Damage of the outer race is called in ",
        " of 10 records, first at 2024-03-1",
        "limit kurtosis 4: first above at 2024-03-",
        "limit rms 1.5 g: first above at 2024-03-19 06:00",
        "limit rms 40 g: no record is above; ",
        "wrote look/trend.csv",
    ]);
    let line = |name: &str| done.out.lines().find(|l| l.starts_with(&format!("{name} "))).unwrap().to_owned();
    assert!(line("peak").contains("grows from 2024-03-1"), "{}", done.out);
    assert!(line("score_cage").contains("or less is needed)"), "{}", done.out);

    let all = json(&folder.path().join("all.json"));
    let trend = &all["trend"];
    assert_eq!(all["records"].as_array().unwrap().len(), 10);
    assert_eq!(trend["records"][7]["date"], "2024-03-15T06:00:00");
    assert_eq!(trend["records"][9]["says"], "damage");
    let level = |name: &str| {
        let all = trend["levels"].as_array().unwrap();
        all.iter().find(|level| level["name"] == name).unwrap().clone()
    };
    let kurtosis = level("kurtosis");
    assert_eq!(kurtosis["values"].as_array().unwrap().len(), 10);
    let change = &level("peak")["changes"][0];
    assert_eq!(change["kind"], "growth");
    let [low, value, high] = ["low", "value", "high"].map(|end| change["doubling"][end].as_f64().unwrap());
    assert!(0.0 < low && low < value && value < high, "{change}");
    assert_eq!(kurtosis["limits"][0]["records"][0], "below");
    assert_eq!(kurtosis["limits"][0]["records"][9], "above");
    assert_eq!(level("rms")["limits"][1]["first_above"], serde_json::Value::Null);

    let table = fs::read_to_string(folder.path().join("look/trend.csv")).unwrap();
    assert!(table.starts_with("file,date,at,says,damage,not_compared,rms [g],rms_low [g],rms_high [g],"), "{table}");
    assert_eq!(table.lines().count(), 11);
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    for part in ["Trend of one machine", "What changed", "Levels over time", ">2024-03-16<", "limit 4"] {
        assert!(page.contains(part), "{part}");
    }
    assert!(files(&folder.path().join("look")).contains(&"plots/trend-kurtosis.svg".to_owned()));
}

#[test]
fn regress_times_are_given_or_counted() {
    let folder = records(|k| format!("acc_{:05}.csv", k + 1));
    let at = |more: &[&str]| {
        let done = trend(folder.path(), &[more, &["--json", "-"]].concat()).exits(0);
        let trend = parsed(&done.out)["trend"].clone();
        let last = trend["records"][9]["at"].as_f64().unwrap();
        (last, trend["time"]["source"].as_str().unwrap().to_owned())
    };
    assert_eq!(at(&[]), (10.0, "the numbers in the names of the files".into()));
    assert_eq!(at(&["--date-unit", "h"]), (10.0, "the numbers in the names of the files, in hours".into()));
    let rows: Vec<String> = (1..=10).map(|k| format!("acc_{k:05}.csv,2024-03-{:02}\n", 21 - k)).collect();
    fs::write(folder.path().join("dates.csv"), format!("file,date\n{}", rows.concat())).unwrap();
    // The last file is of the first day.
    let done = trend(folder.path(), &["--date", "dates.csv", "--json", "-"]).exits(0);
    let found = parsed(&done.out)["trend"].clone();
    assert_eq!(found["records"][0]["file"], "acc_00010.csv");
    assert_eq!(found["records"][9]["date"], "2024-03-20T00:00:00");

    fs::write(folder.path().join("dates.csv"), "acc_00001.csv,2024-03-01\n").unwrap();
    for (more, words) in [
        (&["--date", "dates.csv"][..], "dates.csv: no row for records/acc_00002.csv"),
        (&["--date", "2024-03-01", "--date", "2024-03-02"], "--date: 2 for 10 files"),
        (&["--limit", "rms_speed=4"], "rms_speed: no such level; expected one of rms, rms_velocity, "),
        (&["--limit", "rms=4g"], "4g: expected a number in the level's unit"),
        (&["--limit", "size=4"], "--limit size: no such level; these records have rms, "),
        (&["--channel", "1", "--channel", "1"], "--trend: 2 channels, expected one"),
        (&["--together"], "cannot be used with"),
    ] {
        trend(folder.path(), more).exits(2).complains(&[words]);
    }
    brinell(folder.path(), &[&["analyze", "records/acc_00001.csv", "--trend"], &GIVEN[..]].concat())
        .exits(2)
        .complains(&["--trend: one record, expected two or more"]);
}

/// Records of another rate are shown, and no change rests on them.
#[test]
fn regress_records_that_cannot_be_compared_are_said() {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("records")).unwrap();
    for k in 1..4 {
        let header = if k == 3 { "acc [m/s^2]" } else { "acc [g]" };
        let x: Vec<String> = impacts(0.0).iter().map(|v| format!("{v:.5}\n")).collect();
        fs::write(folder.path().join(format!("records/2024-03-0{k}.csv")), format!("{header}\n{}", x.concat()))
            .unwrap();
    }
    let given = ["--rate", "12000", "--bearing", "6205", "--speed", "1800"];
    brinell(folder.path(), &[&["analyze", "records", "--trend"], &given[..]].concat())
        .exits(0)
        .complains(&[
            "1 of 3 records are not compared with the others",
            "2024-03-03.csv: its unit is m/s^2, most have g",
        ])
        .says(&["1.0 times the first; too few records to test for a change: 2 of 8"]);
}
