//! The page of a calibration: what is in it, whatever the data.

use brinell_report::{CalibrationReport, FittedKey, Tried, calibration_html};

fn key(log: bool, interval: Option<(f64, f64)>) -> FittedKey {
    FittedKey {
        name: "support.outer_stiffness_n_per_m".into(),
        unit: "N/m".into(),
        bounds: (1e5, 1e7),
        log,
        best: 2e6,
        interval,
    }
}

fn run(value: f64, chi_square: f64, alone: bool) -> Tried {
    Tried { values: vec![value], chi_square, alone: vec![alone] }
}

fn report(key: FittedKey, tried: Vec<Tried>) -> CalibrationReport {
    CalibrationReport { title: "Calibration of <x>".into(), keys: vec![key], tried, ..CalibrationReport::default() }
}

#[test]
fn regress_targets_that_are_not_met_are_reported_first() {
    let tried = vec![run(1e6, 30.0, false), run(2e6, 8.0, true), run(3e6, 12.0, true)];
    let mut report = report(key(true, Some((1.5e6, 2.5e6))), tried);
    report.verdict = vec!["a < b".into()];
    let page = calibration_html(&report);
    assert!(page.contains("The targets are not met within the bounds."));
    assert!(page.contains("Calibration of &lt;x&gt;") && page.contains("a &lt; b"));
    assert!(!page.contains("Runs that failed"));
    report.met = true;
    report.failures = vec![("3: a = 1".into(), "too <wide>".into())];
    let page = calibration_html(&report);
    assert!(!page.contains("The targets are not met"));
    assert!(page.contains("too &lt;wide&gt;"));
    // An open dot for the run elsewhere, filled ones on the line through the best; for a desktop and for a phone.
    let keys = page.split("<section id=").find(|part| part.starts_with("\"keys\"")).unwrap();
    assert_eq!(keys.matches("<circle").count(), 2 * 3);
}

#[test]
fn prop_no_numbers_break_the_pictures() {
    let runs = [
        vec![],
        vec![run(1e6, f64::INFINITY, true)],
        vec![run(1e6, 0.0, true)],
        vec![run(1e6, 0.0, true), run(1e7, 1e300, false), run(1e5, f64::NAN, true)],
        vec![run(2e6, 5.0, true), run(2e6, 5.0, true)],
    ];
    for tried in runs {
        for log in [false, true] {
            for interval in [None, Some((1e5, 1e7)), Some((2e6, 2e6))] {
                let report = report(key(log, interval), tried.clone());
                let page = calibration_html(&report);
                assert!(!page.contains("NaN") && !page.contains("inf\""), "{tried:?}");
            }
        }
    }
}
