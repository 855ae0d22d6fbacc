//! The reproduction: what it writes, that neither threads nor a cut journal change a byte, and what it refuses.

use crate::common::{brinell, files, json, results, typed};
use std::fs;
use tempfile::tempdir;

const ONE: [&str; 6] = ["reproduce", "--figure", "9", "--turns", "3", "--quiet"];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    ONE.iter().chain(more).copied().collect()
}

#[test]
fn prop_one_figure_whole_cut_and_on_another_number_of_threads() {
    let folder = tempdir().unwrap();
    let run = |name: &str, jobs: &str| {
        brinell(
            folder.path(),
            &with(&["-o", name, "--jobs", jobs, "--plots", "svg", "--book", &format!("{name}/book")]),
        )
        .exits(0)
    };
    run("a", "1");
    run("b", "2");
    let (a, b) = (results(&folder.path().join("a")), results(&folder.path().join("b")));
    let names: Vec<&str> = a.iter().map(|f| f.0.as_str()).collect();
    for name in [
        "claims.csv",
        "claims.json",
        "reproduce.html",
        "plots/fig09-length.svg",
        "book/reproduction.md",
        "book/fig09-length.svg",
        "book/fig08-irregular.svg",
    ] {
        assert!(names.contains(&name), "{name} in {names:?}");
    }
    assert!(a == b, "the number of threads changes something");
    // A journal that lost its last line: one run is done again, and nothing changes.
    let journal = folder.path().join("a/journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 4, "a header and three runs");
    fs::write(&journal, lines[..3].join("\n") + "\n").unwrap();
    run("a", "1");
    assert_eq!(fs::read_to_string(&journal).unwrap().lines().count(), 4);
    assert!(results(&folder.path().join("a")) == a);

    // The effective lengths are exact, so their claim holds however short the runs.
    let claims = json(&folder.path().join("a/claims.json"));
    let all = claims["claims"].as_array().unwrap();
    let length = all.iter().find(|c| c["id"] == "effective-length").unwrap();
    assert_eq!(length["verdict"], "holds");
    assert!(all.iter().all(|c| c["id"] != "load-cage"), "belongs to another figure");
    let page = fs::read_to_string(folder.path().join("a/reproduce.html")).unwrap();
    // Values travel in base64, which may spell anything.
    let parts = page.split("<script");
    let seen: String = parts.filter_map(|part| part.rsplit("</script>").next()).collect();
    assert!(seen.contains("Effective contact length") && !seen.contains("NaN"));
    let book = fs::read_to_string(folder.path().join("a/book/reproduction.md")).unwrap();
    assert!(book.contains("](book/fig09-length.svg)"));
    let first = book.find("\n## ").unwrap();
    // The figure that was asked for comes first.
    assert!(book[first..].starts_with("\n## Fig"), "{}", &book[first..first + 40]);
}

#[test]
fn prop_the_start_up_is_read_and_said_with_fig_20() {
    let folder = tempdir().unwrap();
    let args = typed("reproduce --figure 20 --turns 3 --quiet -o a --book a/book");
    brinell(folder.path(), &args).exits(0);
    let claims = json(&folder.path().join("a/claims.json"));
    let all = claims["claims"].as_array().unwrap();
    let rms = all.iter().find(|c| c["id"] == "rms-values").unwrap();
    // Three statements about the steady part, three about the record from t = 0; every verdict says what it rests on.
    let statements = rms["statements"].as_array().unwrap();
    assert_eq!(statements.len(), 6);
    assert!(statements.iter().all(|s| s["verdict"] != "not computed"), "{statements:?}");
    let words = rms["in_words"].as_str().unwrap();
    assert!(words.ends_with("under our reading of Ref. [43]"), "{words}");
    let book = fs::read_to_string(folder.path().join("a/book/reproduction.md")).unwrap();
    for part in ["sufficient, not proven", "](book/fig20-start.svg)", "(paper 30.414)", "no damage, from t = 0"] {
        let picture = fs::read_to_string(folder.path().join("a/book/fig20-start.svg")).unwrap();
        assert!(book.contains(part) || picture.contains(part), "{part}");
    }
}

#[test]
fn prop_the_papers_laws_are_the_default_and_others_are_put_beside() {
    let folder = tempdir().unwrap();
    let run = |more: &str| {
        let line = format!("reproduce --figure 13 --turns 3 {more}");
        brinell(folder.path(), &typed(&line)).exits(0)
    };
    run("--quiet -o a --book a/book");
    run("--quiet -o b --book b/book --laws li2023");
    let [a, b] = ["a", "b"].map(|name| results(&folder.path().join(name)));
    assert!(a == b, "the default is another");
    assert!(a.iter().all(|file| !file.0.contains("laws.csv") && !file.0.contains("verdicts.json")));
    // The same figure under other laws, in the same folder, so with the same journal.
    let call = run("-o a --book a/book --laws mechanics --plots svg");
    assert!(call.out.contains("4 runs: "), "{}", call.out);
    assert!(call.out.contains("sentences that numbers decide"), "{}", call.out);
    let claims = json(&folder.path().join("a/claims.json"));
    assert_eq!(claims["laws"], "mechanics");
    let table = fs::read_to_string(folder.path().join("a/laws.csv")).unwrap();
    let lines: Vec<&str> = table.lines().filter(|line| line.contains("simplified-acceleration")).collect();
    assert_eq!(lines.len(), 4, "{table}");
    assert!(lines[0].contains("ratio 15.62 [15.49, 15.74]"), "{}", lines[0]);
    let book = fs::read_to_string(folder.path().join("a/book/survives.md")).unwrap();
    assert!(book.contains("\n1. The outer ring’s RMS with the simplified shape") && !book.contains("!["));
    // Again: nothing is run, and nothing changes.
    let before = results(&folder.path().join("a"));
    let call = run("-o a --book a/book --laws mechanics --plots svg");
    assert!(call.out.contains("0 runs in"), "{}", call.out);
    assert!(results(&folder.path().join("a")) == before);
}

#[test]
fn regress_what_is_refused() {
    let folder = tempdir().unwrap();
    for (args, part) in [
        (vec!["reproduce", "--figure", "7"], "allowed: 8 to 20, the figures of section 4"),
        (vec!["reproduce", "--figure", "x"], "allowed: 8 to 20"),
        (vec!["reproduce", "--turns", "2"], "expected a whole number of turns of the shaft, 3 to 100000"),
        (vec!["reproduce", "--jobs", "0"], "expected a whole number of runs at a time, 1 or more"),
        (vec!["reproduce", "--width", "90mm"], "say which with --plots"),
        (vec!["reproduce", "--figure", "9", "--sensitivity"], "cannot be used with"),
        (vec!["reproduce", "--laws", "mechanics", "--sensitivity"], "--sensitivity varies the paper's laws"),
        (vec!["reproduce", "--laws", "mechanics", "--model", "tilting"], "--model varies the paper's laws"),
    ] {
        let call = brinell(folder.path(), &args).exits(2);
        assert!(call.err.contains(part), "{args:?}: {}", call.err);
    }
    assert!(files(folder.path()).is_empty());
    // Another campaign's folder.
    fs::create_dir(folder.path().join("s")).unwrap();
    fs::write(folder.path().join("s/journal.jsonl"), "{\"campaign\":\"sweep\"}\n").unwrap();
    let call = brinell(folder.path(), &with(&["-o", "s"])).exits(2);
    assert!(call.err.contains("holds the journal of something else"), "{}", call.err);
}
