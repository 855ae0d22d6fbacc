//! What `brinell analyze` warns of, and what it says of levels and frequencies that may be read wrong.

use crate::common::{FS, GIVEN, brinell, column, impacts, json, typed};
use std::fs;
use tempfile::tempdir;

#[test]
fn regress_a_low_speed_without_a_unit_may_be_in_hz() {
    let folder = tempdir().unwrap();
    let long: Vec<f64> =
        impacts(6.0).iter().cycle().take(40 * FS as usize).enumerate().map(|(i, v)| v + 1e-6 * i as f64).collect();
    column(&folder.path().join("long.csv"), &long);
    let call = |speed: &str| {
        let args = format!("analyze long.csv --rate 12000 --unit g --bearing 6205 --speed {speed}");
        brinell(folder.path(), &typed(&args)).exits(0)
    };
    call("29.94").complains(&["--speed 29.94: 29.94 r/min is 0.50 Hz; if it is in Hz write 29.94Hz"]);
    assert!(!call("29.94Hz").err.contains("in Hz"));
    assert!(!call("99rpm").err.contains("in Hz"));
    let text: String = long.iter().fold("acc,speed\n".to_owned(), |text, v| text + &format!("{v:.4},30\n"));
    fs::write(folder.path().join("rig.csv"), text).unwrap();
    let args = "analyze rig.csv --channel acc --rate 12000 --unit g --bearing 6205 --speed-channel speed";
    brinell(folder.path(), &typed(args))
        .exits(0)
        .complains(&["taken as r/min, one value throughout: a mean of 30.0000 r/min is 0.50 Hz; if it is in Hz let the channel say so"]);
}

#[test]
fn regress_the_bearing_found_for_another_name_is_said_with_it() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("outer.csv"), &impacts(6.0));
    let call = |bearing: &str| {
        let args = format!("analyze outer.csv --rate 12000 --unit g --speed 1800 --bearing {bearing}");
        brinell(folder.path(), &typed(&args)).exits(0)
    };
    let backwards = typed("analyze outer.csv --rate 12000 --unit g --speed -1800 --bearing 6205");
    brinell(folder.path(), &backwards).exits(0).says(&["-1800 r/min"]);
    call("6205XYZZY").says(&["bearing: 6205: ", "(found for 6205XYZZY)"]);
    assert!(!call("6205").out.contains("found for"));
}

#[test]
fn regress_peak_and_crest_factor_are_the_records_on_terminal_page_and_json() {
    let folder = tempdir().unwrap();
    let mut x = impacts(6.0);
    x[9_000] = 60.0;
    column(&folder.path().join("outer.csv"), &x);
    let args: Vec<&str> = ["analyze", "outer.csv"].into_iter().chain(GIVEN).chain(["-o", "look"]).collect();
    let done =
        brinell(folder.path(), &args).exits(0).says(&[", peak 5", " g, crest factor ", ", mean peak of a revolution "]);
    let found = json(&folder.path().join("look/analysis.json"));
    let value = |name: &str| found["indicators"][name]["value"].as_f64().unwrap();
    assert!((value("record_crest_factor") - value("record_peak") / value("rms")).abs() < 1e-9);
    assert!(value("record_crest_factor") > 2.0 * value("crest_factor"), "{}", done.out);
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    for words in
        ["Peak of the record", "Crest factor: that over RMS", "Mean peak of a revolution", "Mean peak over RMS"]
    {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn regress_frequencies_of_a_speed_that_was_followed_are_orders() {
    let folder = tempdir().unwrap();
    let x = impacts(6.0);
    let speed = |i: usize| 1800.0 + 40.0 * (i as f64 / x.len() as f64 - 0.5);
    let text = (x.iter().enumerate())
        .fold("acc,speed\n".to_owned(), |text, (i, v)| text + &format!("{v:.5},{:.3}\n", speed(i)));
    fs::write(folder.path().join("ramp.csv"), text).unwrap();
    let args = "analyze ramp.csv --channel acc --rate 12000 --unit g --bearing 6205 --speed-channel speed -o look";
    let said = "their frequencies in Hz are orders times the mean speed, 30.000 Hz (1800.0 r/min)";
    let done = brinell(folder.path(), &typed(args)).exits(0).says(&[said]);
    assert!(!done.out.contains("record of the speed would tell"), "{}", done.out);
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(page.contains("Order × mean speed") && page.contains(said));
}

#[test]
fn regress_times_are_known_by_their_unit_and_german_thousands_are_read() {
    let folder = tempdir().unwrap();
    let x = impacts(6.0);
    let german = |v: f64| {
        let milli = (1000.0 * v).round() as i64;
        let sign = if milli < 0 { "-" } else { "" };
        match milli.abs() {
            m if m < 1000 => format!("{sign}{m}"),
            m => format!("{sign}{}.{:03}", m / 1000, m % 1000),
        }
    };
    let line =
        |(i, v): (usize, &f64)| format!("{};{}\n", format!("{:.8}", i as f64 / FS).replace('.', ","), german(*v));
    let text: String = x.iter().enumerate().map(line).collect();
    fs::write(folder.path().join("de.csv"), format!("Messdauer [s];acc [mg]\n{text}")).unwrap();
    brinell(folder.path(), &typed("analyze de.csv --bearing 6205 --speed 1800")).exits(0).keeps_quiet().says(&[
        "sample rate 12000 Hz, from the times in `Messdauer [s]`",
        "channel acc [mg]",
        "Outer race damage",
    ]);
}

#[test]
fn regress_levels_far_from_those_of_machines_ask_for_the_unit() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("outer.csv"), &impacts(6.0));
    let call = |rest: &str| {
        brinell(folder.path(), &typed(&format!("analyze outer.csv --rate 12000 --speed 1800 --bearing 6205 {rest}")))
    };
    assert!(!call("--unit g").exits(0).err.contains("are unit and sensitivity right?"));
    let high = "of machines, as a rule up to a few g: are unit and sensitivity right?";
    call("--unit V --sensitivity 10mV/g").exits(0).complains(&["an RMS of ", high]);
    let low = "below those of running machines, as a rule 0.1 mm/s and more: are unit and sensitivity right?";
    call("--unit mm/s^2").exits(0).complains(&["an RMS velocity of ", low]);
}

#[test]
fn regress_a_geometry_in_metres_and_a_point_between_thousands_are_pointed_to() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("outer.csv"), &impacts(6.0));
    let call = |rest: &str| brinell(folder.path(), &typed(&format!("analyze outer.csv --rate 12000 --unit g {rest}")));
    call("--speed 1800 --rollers 9 --pitch 0.03904 --diameter 0.00794")
        .exits(2)
        .complains(&["--pitch 0.03904: expected mm", "If it is in metres write 39.04 --diameter 7.94"]);
    call("--speed 1.797 --bearing 6205")
        .exits(2)
        .complains(&["a speed in Hz is written 1.80Hz", "if the point divides thousands 1797"]);
}
