//! `brinell analyze -o FILE.html --pdf FILE.pdf`: the customer's report, and what it does not take.

use crate::common::{GIVEN, brinell, column, files, impacts, json, normal};
use ::brinell::random::Random;
use std::fmt::Write as _;
use std::fs;
use tempfile::{TempDir, tempdir};

/// A folder with a damaged and a quiet record.
fn records() -> TempDir {
    let folder = tempdir().unwrap();
    column(&folder.path().join("bad.csv"), &impacts(6.0));
    column(&folder.path().join("good_2026-03-02.csv"), &impacts(0.0));
    folder
}

fn call<'a>(what: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [&["analyze"], what, &GIVEN, more].concat()
}

/// The texts of a page, one after the other.
fn words(html: &str) -> String {
    let texts = html.split("<text").skip(1).filter_map(|rest| rest.split_once('>')?.1.split("</text>").next());
    texts.collect::<Vec<_>>().join(" ")
}

#[test]
fn regress_damage_that_was_seen_outranks_a_record_that_does_not_show_it() {
    let folder = records();
    let told = |more: &str| {
        let more: Vec<&str> = more.split_whitespace().collect();
        brinell(folder.path(), &call(&["good_2026-03-02.csv"], &more)).exits(0);
        words(&fs::read_to_string(folder.path().join("r.html")).unwrap())
    };
    let unseen = told("-o r.html --overwrite");
    assert!(unseen.contains("Go on with the usual interval") && !unseen.contains("Damage was seen"), "{unseen}");
    let seen = told("-o r.html --damage-kind forced-fracture --overwrite");
    for words in ["No damage found", "Not graded:", "Damage was seen: act on what was seen", "page 2 of 2"] {
        assert!(seen.contains(words), "{words}: {seen}");
    }
    for words in ["Go on with the usual interval", "Inconspicuous", "Do not exchange the bearing"] {
        assert!(!seen.contains(words), "{words}: {seen}");
    }
}

#[test]
fn regress_the_report_as_html_and_pdf_with_what_was_given() {
    let folder = records();
    let named = ["--title", "Pump check", "--point", "drive end", "--author", "A. Writer"];
    let rest = "-o report.html --pdf report.pdf --machine P-301 --date 2026-03-02 --damage-kind false-brinelling \
                --machine-class 2-rigid --size --json all.json";
    let given = [&named[..], &rest.split_whitespace().collect::<Vec<_>>()].concat();
    let done = brinell(folder.path(), &call(&["bad.csv"], &given));
    done.exits(0).keeps_quiet().says(&["Outer race damage", "wrote all.json", "wrote report.html", "wrote report.pdf"]);
    let html = fs::read_to_string(folder.path().join("report.html")).unwrap();
    let said = words(&html);
    for part in [
        "Pump check",
        "P-301",
        "drive end",
        "2026-03-02",
        "A. Writer",
        "1800 r/min, as given",
        "The outer race is damaged",
        "false brinelling (ISO 15243:2017, 5.3.3.3)",
        "of ISO 20816-3 for group 2, rigid support",
        "Length:",
        "bad.csv",
        "95 % interval",
        "page 1 of 2",
        "page 2 of 2",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert_eq!(html.matches("class=\"sheet\"").count(), 2);
    let pdf = fs::read(folder.path().join("report.pdf")).unwrap();
    let pdf = String::from_utf8_lossy(&pdf).into_owned();
    assert!(pdf.starts_with("%PDF-1.") && pdf.matches("/Type /Page\n").count() == 2);
    assert!(pdf.contains("/Title (Pump check)") && pdf.contains("/Author (A. Writer)"));
    assert_eq!(json(&folder.path().join("all.json"))["verdict"]["says"], "damage");
    // Nothing else is left, and another report takes the place of this one.
    assert_eq!(files(folder.path()), ["all.json", "bad.csv", "good_2026-03-02.csv", "report.html", "report.pdf"]);
    let again = call(&["good_2026-03-02.csv"], &["-o", "report.html", "--pdf", "report.pdf", "-q"]);
    brinell(folder.path(), &again).exits(0).keeps_quiet();
    let said = words(&fs::read_to_string(folder.path().join("report.html")).unwrap());
    for part in
        ["No damage found", "2026-03-02, by the name of the", "not stated", "the class of the machine was not given"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn regress_a_pdf_alone_and_beside_a_folder() {
    let folder = records();
    brinell(folder.path(), &call(&["bad.csv"], &["--pdf", "a.pdf"])).exits(0).says(&["wrote a.pdf"]);
    brinell(folder.path(), &call(&["bad.csv"], &["--pdf", "b.pdf", "-o", "look"])).exits(0).keeps_quiet();
    assert_eq!(fs::read(folder.path().join("a.pdf")).unwrap(), fs::read(folder.path().join("b.pdf")).unwrap());
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(page.contains("id=\"kurtogram\""), "the folder has the whole page");
}

#[test]
fn prop_several_channels_are_one_report_and_the_clearest_leads() {
    let folder = tempdir().unwrap();
    let mut noise = Random::new(3);
    let mut text = String::from("quiet,loud,flat\n");
    for value in impacts(6.0) {
        let _ = writeln!(text, "{:.4},{value:.4},1", normal(&mut noise));
    }
    fs::write(folder.path().join("two.csv"), text).unwrap();
    let of = ["--channel", "quiet", "--channel", "loud", "--channel", "flat", "-o", "r.html", "--pdf", "r.pdf"];
    let done = brinell(folder.path(), &call(&["two.csv"], &of));
    done.exits(1).complains(&["1 of 3 signals could not be analysed"]).says(&["wrote r.html", "wrote r.pdf"]);
    let said = words(&fs::read_to_string(folder.path().join("r.html")).unwrap());
    for part in ["Channel that leads loud", "The outer race is damaged", "no damage found", "no result:"] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn prop_letters_that_the_pdf_lacks_are_told() {
    let folder = records();
    let given = ["-o", "r.html", "--pdf", "r.pdf", "--machine", "泵 3"];
    brinell(folder.path(), &call(&["bad.csv"], &given)).exits(0).complains(&["? in place of letters", "泵"]);
    assert!(words(&fs::read_to_string(folder.path().join("r.html")).unwrap()).contains("泵 3"));
}

#[test]
fn regress_what_a_report_does_not_take() {
    let folder = records();
    fs::write(folder.path().join("mine.html"), "<p>mine</p>").unwrap();
    fs::write(folder.path().join("mine.pdf"), "%PDF-1.7 mine").unwrap();
    let short: Vec<f64> = impacts(6.0).into_iter().take(2000).collect();
    column(&folder.path().join("short.csv"), &short);
    let before = files(folder.path());
    let both = &["bad.csv", "good_2026-03-02.csv"][..];
    let one = &["bad.csv"][..];
    let cases: [(&[&str], &[&str], &str); 18] = [
        (one, &["--title", "x"], "--title: no report to put it in; give -o REPORT.html or --pdf REPORT.pdf"),
        (one, &["--author", "x", "-o", "look"], "--author: no report to put it in"),
        (one, &["--damage-kind", "overload"], "--damage-kind: no report to put it in"),
        (one, &["--date", "2026-03-02"], "or --trend for records over time"),
        (one, &["--damage-kind", "rust", "-o", "r.html"], "moisture-corrosion"),
        (one, &["-o", "mine.html"], "mine.html: a file that is no customer's report of brinell's is there"),
        (one, &["--pdf", "mine.pdf"], "mine.pdf: a file that is no customer's report of brinell's is there"),
        (one, &["--pdf", "report.html"], "--pdf report.html: expected a name that ends in .pdf"),
        (one, &["--pdf", "none/r.pdf"], "none"),
        (one, &["-o", "look", "--pdf", "look/r.pdf"], "it lies in the folder of -o"),
        (one, &["-o", "r.html", "--json", "r.html"], "expected another file than the report's"),
        (one, &["-o", "r.html", "--plots", "png"], "pictures go to a folder"),
        (one, &["-o", "r.html", "--date", "tomorrow"], "expected a date as 2024-02-12T10:32:39"),
        (one, &["-o", "r.html", "--date", "2026-03-02", "--date", "2026-03-03"], "--date: 2 dates, expected one"),
        (both, &["-o", "r.html"], "2 files: the customer's report is of one record"),
        (
            both,
            &["-o", "r.html", "--trend", "--date", "2026-03-01", "--date", "2026-03-02"],
            "--trend: the customer's report is of one",
        ),
        (&["short.csv"], &["--pdf", "r.pdf"], "The customer's report takes a verdict"),
        (
            &["short.csv"],
            &["--pdf", "r.pdf", "--channel", "1", "--channel", "acc"],
            "The customer's report takes a verdict",
        ),
    ];
    for (what, more, part) in cases {
        let done = brinell(folder.path(), &call(what, more)).exits(2);
        assert!(done.err.contains(part), "{more:?}: no {part:?} in {}", done.err);
        assert_eq!(files(folder.path()), before, "{more:?}");
    }
    assert_eq!(fs::read_to_string(folder.path().join("mine.html")).unwrap(), "<p>mine</p>");
}
