//! How far levels hang on what is assumed: each bar is the run made by hand.

use crate::common::{brinell, json, typed, with_blocks};
use std::path::Path;

const KEY: &str = "contact.damping_time_us";

fn rms(summary: &Path) -> f64 {
    json(summary)["quantities"]["sensor_ax.rms"]["value"].as_f64().unwrap()
}

#[test]
fn prop_a_bar_of_the_spread_is_the_run_made_by_hand() {
    let folder = with_blocks("a.toml");
    let here = folder.path();
    let run = "run a.toml --no-report --no-healthy --signals none --set simulation.laws=mechanics --set defects=[]";
    brinell(here, &typed(&format!("{run} -o spread --spread"))).exits(0).says(&["by what is assumed"]);
    let found = json(&here.join("spread/summary.json"));
    let of = |list: &str, is: &str, name: &str| {
        found["spread"][list].as_array().unwrap().iter().find(|one| one[is] == name).unwrap().clone()
    };
    let [key, level] = [of("assumed", "key", KEY), of("levels", "name", "sensor_ax.rms")];
    let bar = level["by"].as_array().unwrap().iter().find(|bar| bar["key"] == KEY).unwrap().clone();
    for (end, at) in [("low", "at_low"), ("high", "at_high")] {
        let value = key[end].as_f64().unwrap();
        brinell(here, &typed(&format!("{run} -o {end} --set {KEY}={value}"))).exits(0);
        assert_eq!(rms(&here.join(end).join("summary.json")), bar[at].as_f64().unwrap(), "{end}");
    }
    let number = |name: &str| level[name].as_f64().unwrap();
    let reached = ["at_low", "at_high"].map(|at| bar[at].as_f64().unwrap());
    assert_eq!(number("value"), rms(&here.join("spread/summary.json")));
    assert!(number("low") <= reached[0].min(reached[1]) && number("high") >= reached[0].max(reached[1]), "{level}");
}

#[test]
fn prop_a_ratio_of_a_scenario_to_itself_survives_and_is_one() {
    let folder = with_blocks("a.toml");
    let set = "--set simulation.laws=mechanics --set defects=[]";
    let args = format!("compare a.toml --variant same:simulation.seed=1 --spread -o out {set} --json");
    brinell(folder.path(), &typed(&args)).exits(0);
    let found = json(&folder.path().join("out/compare.json"));
    let ratios = found["spread"]["sides"][0]["ratios"].as_array().unwrap();
    assert!(!ratios.is_empty());
    for ratio in ratios {
        assert_eq!([&ratio["value"], &ratio["low"], &ratio["high"]].map(|x| x.as_f64().unwrap()), [1.0; 3], "{ratio}");
    }
    // On the page and in the table, too.
    let page = std::fs::read_to_string(folder.path().join("out/compare.html")).unwrap();
    assert!(page.contains("What assumed values do to the ratios"));
    let table = std::fs::read_to_string(folder.path().join("out/compare.csv")).unwrap();
    assert!(table.lines().next().unwrap().ends_with("same.ratio.assumed_low,same.ratio.assumed_high"));
}
