//! The pictures of a calibration, whatever the data.

use brinell_report::{Chapter, Page, Piece, Tried, html};
use brinell_study::calibrate::{Found, Key};

fn key(log: bool, interval: Option<(f64, f64)>) -> Found {
    let key = Key { name: "support.outer_stiffness_n_per_m".into(), low: 1e5, high: 1e7, log };
    Found { key, unit: "N/m", best: 2e6, interval, place: 0.5, half_width: 0.1, open: None }
}

fn run(value: f64, chi_square: f64, alone: bool) -> Tried {
    Tried { value, chi_square, alone }
}

fn page(key: Found, tried: Vec<Tried>) -> String {
    let course = Piece::Course(tried.iter().map(|run| run.chi_square).collect());
    let chapters = vec![
        Chapter::new("keys", "Keys", "Keys", vec![Piece::Misfit(key, tried)]),
        Chapter::new("course", "Course", "Course", vec![course]),
    ];
    html(&Page { chapters, ..Page::default() })
}

#[test]
fn regress_runs_on_the_line_through_the_best_are_filled() {
    let tried = vec![run(1e6, 30.0, false), run(2e6, 8.0, true), run(3e6, 12.0, true)];
    let page = page(key(true, Some((1.5e6, 2.5e6))), tried);
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
                let page = page(key(log, interval), tried.clone());
                assert!(!page.contains("NaN") && !page.contains("inf\""), "{tried:?}");
            }
        }
    }
}
