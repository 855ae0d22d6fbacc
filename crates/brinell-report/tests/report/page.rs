//! The page: what must be in it, and that nothing odd breaks it.

use super::checks::{check, check_pictures};
use super::sample::{Report, filled, ordinary};
use brinell::document::{Origin, Provenance};
use brinell_damage::Photo;
use brinell_report::{
    Chapter, Fact, Layout, MinMax, Page, Table, detail_window, headline, html, load_distribution, overview, pictures,
};
use proptest::prelude::*;

const HOSTILE: &str = "</script><img src=\"x\" onerror='y'>&\u{0}\u{2028}";

#[test]
fn regress_an_ordinary_page_is_whole_and_small() {
    let report = ordinary();
    let page = html(&report.page());
    check(&page);
    check_pictures(&report);
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    for text in ["m/s²", "Time (", "Frequency (Hz)", "Force (N)", "250.102"] {
        assert!(page.contains(text), "{text}");
    }
    // Two drawings of every figure, and data for the four that zoom.
    assert_eq!(page.matches("class=\"wide\"").count(), page.matches("class=\"narrow\"").count());
    assert_eq!(page.matches("data-chart=").count(), 4);
}

/// The result is before everything; what was assumed before what was stated, which is folded; over orders only where
/// the speed varies.
#[test]
fn regress_the_result_comes_first_and_assumptions_before_statements() {
    let mut report = ordinary();
    report.lead.clear();
    report.signals.envelope_orders.amplitude.clear();
    assert!(!html(&report.page()).contains("<p class=\"lead\">"));
    assert!(!html(&report.page()).contains("id=\"orders\""));
    report.lead = "3 × 4 mm defect <b>".into();
    let one = |key: &str, assumed| {
        let origin = Origin::Recorded(String::new());
        Provenance { key: key.into(), value: "1".into(), unit: "", origin, assumed, plausible: None }
    };
    report.assumptions = vec![one("stated.key", false), one("assumed.key", true)];
    report.signals.envelope_orders = report.signals.envelope_spectrum.clone();
    report.signals.order_markers = report.signals.markers.clone();
    let page = html(&report.page());
    check(&page);
    // Names may be broken after their points.
    let page = page.replace("<wbr>", "");
    let at = |words: &str| page.find(words).unwrap_or_else(|| panic!("{words}"));
    assert!(at("<p class=\"lead\">3 × 4 mm defect &lt;b&gt;") < at("id=\"waveform\""));
    assert!(at("<code>assumed.key") < at("<summary>1 stated values"));
    assert!(at("<summary>1 stated values") < at("<code>stated.key"));
    assert!(at("data-chart=\"orders\"") < at("id=\"spectrogram\""));
}

/// Every number of a card says what it is, a unit is no value, and names break after points and underscores.
#[test]
fn regress_cards_say_what_their_numbers_are() {
    let text = |row: [&str; 5]| row.map(String::from).to_vec();
    let heads = ["#Point", "Key", "Unit", "#one.rms (m/s^2)", "#two"];
    let table = Table::new("Numbers", heads, [text(["1", "a.b_c", "m/s^2", "-1.5 (-2 to -1)", "3"])], "By `run -x`.");
    let page = Page { chapters: vec![Chapter::table("numbers", "Numbers", table)], ..Page::default() };
    let page = html(&page);
    for part in [
        "<th scope=\"row\" data-head=\"Point\">1</th>",
        "<td class=\"unit\" data-head=\"Unit\">m/s²</td>",
        "data-head=\"one.rms (m/s²)\">−1.5 <span class=\"half\">(−2 to −1)</span></td>",
        "<th class=\"number\">one.<wbr>rms (m/s²)</th>",
        "By <code>run -x</code>.",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
}

/// On a narrow page a row of a table that has no room there is a card.
#[test]
fn regress_a_table_too_wide_for_a_phone_is_cards() {
    let of = |interval: &str| {
        let row = ["Skewness", "0.05428", interval, "mm/s"].map(String::from).to_vec();
        let table = Table::new("Levels", ["Indicator", "#Value", "#95 % interval", "Unit"], [row], "");
        html(&Page { chapters: vec![Chapter::table("levels", "Levels", table)], ..Page::default() })
    };
    assert!(of("0.03182 to 0.07673").contains("<table class=\"stack\">"));
    assert!(of("1 to 2").contains("<table><thead>"));
}

/// Without the damage: in grey behind, and a curve of its own for the page's script and for files.
#[test]
fn regress_the_healthy_bearing_lies_behind_the_damaged_one() {
    const BEHIND: &str = "Grey: the same bearing without the damage";
    let mut report = ordinary();
    assert!(!html(&report.page()).contains(BEHIND));
    let tenth = |values: &[f64]| values.iter().map(|x| 0.1 * x).collect::<Vec<f64>>();
    report.signals.healthy.waveform = tenth(&report.signals.waveform.series.values);
    report.signals.healthy.spectrum = tenth(&report.signals.spectrum.amplitude);
    report.signals.healthy.envelope_spectrum = tenth(&report.signals.envelope_spectrum.amplitude);
    let page = html(&report.page());
    check(&page);
    check_pictures(&report);
    assert_eq!(page.matches("\"drawn\":[1, 0]").count(), 3);
    assert_eq!(page.matches("{\"name\":\"healthy\"").count(), 3);
    let pictures = pictures(&report.page(), Layout::Wide);
    for name in ["waveform", "spectrum", "envelope-spectrum", "headline"] {
        let picture = pictures.iter().find(|p| p.name == name).unwrap();
        let svg = picture.svg();
        assert!(svg.contains(BEHIND), "{name}");
        // Drawn first, and so behind.
        let at = |color: &str| svg.find(&format!("stroke=\"{color}\" stroke-width=\"1.2\""));
        assert!(at("#9aa4ae") < at("#0072B2") && at("#9aa4ae").is_some(), "{name}");
        let names: Vec<String> =
            (picture.tables().iter()).flat_map(|t| t.columns.iter().map(|c| c.0.clone())).collect();
        assert!(names.iter().any(|n| n.contains("healthy")), "{name}: {names:?}");
    }
}

#[test]
fn regress_units_with_exponents_are_raised() {
    let mut report = ordinary();
    report.audits = vec![Fact::new("Stiffness", 1.898e8, "N/m^(10/9)", "")];
    let page = html(&report.page());
    assert!(page.contains("1.898×10⁸") && page.contains("N/m<sup>10/9</sup>"));
}

#[test]
fn regress_an_empty_report_says_so() {
    let page = html(&Report::default().page());
    check(&page);
    check_pictures(&Report::default());
    for words in
        ["No waveform was recorded", "No spectrum was made", "No rolling element passed a defect", "No audit was made"]
    {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("<svg"));
    let svg = load_distribution(&[], Layout::Narrow).svg();
    assert!(roxmltree::Document::parse(&svg).is_ok());
}

#[test]
fn regress_every_string_is_escaped() {
    let mut report = filled(HOSTILE, &[1.0, 2.0, 3.0, 0.5, 0.7], 0.1, 2.0);
    let photo = Photo { columns: 1, grey: vec![0], mm_per_pixel: 1.0, notes: vec!["<1>".into()], ..Photo::default() };
    report.damage[0].photo = Some(photo);
    let page = html(&report.page());
    check(&page);
    check_pictures(&report);
    assert!(!page.contains("<img") && !page.contains('\u{0}'));
    assert!(page.contains("&lt;1&gt;."), "escaped once");
}

#[test]
fn regress_the_close_up_spans_five_periods_of_the_damage() {
    let mut report = ordinary();
    let (lo, hi) = detail_window(&report.signals);
    assert!((hi - lo - 5.0 / 250.102).abs() < 1e-9 && (hi - 255_999.0 / 25_600.0).abs() < 1e-9);
    report.signals.markers.clear();
    let (lo, hi) = detail_window(&report.signals);
    assert!((hi - lo - 0.02).abs() < 1e-9);
}

/// A start that outshines the run is cut off and said to be; one that does not is shown whole.
#[test]
fn regress_the_start_does_not_flatten_the_overview() {
    let mut report = ordinary();
    let bins = |first: f64| MinMax {
        t0_s: 0.0,
        dt_s: 0.01,
        min: [vec![-first; 10], vec![-1.0; 990]].concat(),
        max: vec![1.0; 1000],
    };
    report.signals.waveform.overview = Some(bins(650.0));
    let svg = overview(&report.signals, Layout::Wide).svg();
    assert!(svg.contains("the start reaches from −650 to 1 m/s²"), "{svg}");
    report.signals.waveform.overview = Some(bins(2.5));
    assert!(!overview(&report.signals, Layout::Wide).svg().contains("Cut off"));
}

#[test]
fn regress_odd_data_is_drawn() {
    for values in [
        vec![],
        vec![0.0],
        vec![7.0],
        vec![f64::NAN; 5],
        vec![0.0; 1000],
        vec![1.0, f64::NAN, 2.0, f64::INFINITY, -3.0],
        vec![f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324],
        vec![-1.0, -2.0, -3.0],
    ] {
        for (dt, frequency) in [(0.1, 2.0), (0.0, 0.0), (f64::NAN, f64::INFINITY), (1e300, 1e-300)] {
            let report = filled("x", &values, dt, frequency);
            check(&html(&report.page()));
            check_pictures(&report);
            let png = headline(&report.signals, Layout::Wide).png(1.0);
            assert!(png.is_ok_and(|png| png.starts_with(b"\x89PNG")));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn prop_no_data_breaks_the_page(
        text in "\\PC{0,12}",
        values in prop::collection::vec(any::<f64>(), 0..200),
        dt in any::<f64>(),
        frequency in any::<f64>(),
    ) {
        let report = filled(&text, &values, dt, frequency);
        let page = html(&report.page());
        prop_assert_eq!(page.matches("<svg").count(), page.matches("</svg>").count());
        check_pictures(&report);
    }

    #[test]
    fn prop_ordinary_values_break_nothing(
        values in prop::collection::vec(prop_oneof![Just(f64::NAN), -1e3..1e3, Just(0.0)], 0..300),
        dt in 1e-6..1.0,
        frequency in 1e-3..1e5,
    ) {
        let report = filled("x", &values, dt, frequency);
        check(&html(&report.page()));
        check_pictures(&report);
    }
}
