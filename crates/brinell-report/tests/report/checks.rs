//! What holds for every page and picture.

use super::sample::Report;
use brinell_report::{Layout, pictures};

/// What a page must hold whatever its data, and what it must not.
pub(crate) fn check(page: &str) {
    let mut from = 0;
    for heading in [
        "<h1>",
        ">Waveform</h2>",
        ">Spectrum</h2>",
        ">Envelope spectrum</h2>",
        ">Spectrogram</h2>",
        ">Passing the defect</h2>",
        ">Load distribution</h2>",
        ">The bearing in motion</h2>",
        ">Cage orbit</h2>",
        ">Indicators</h2>",
        ">Slip</h2>",
        ">Assumptions</h2>",
        ">Appendix: audits</h2>",
        ">Appendix: solver work</h2>",
        ">Appendix: scenario</h2>",
    ] {
        let at = page[from..].find(heading);
        from += at.unwrap_or_else(|| panic!("{heading} is missing or out of order"));
    }
    for (open, close) in
        [("<svg", "</svg>"), ("<table", "</table>"), ("<figure>", "</figure>"), ("<script", "</script>")]
    {
        assert_eq!(page.matches(open).count(), page.matches(close).count(), "{open}");
    }
    for part in page.match_indices("url(").map(|(at, _)| &page[at..at + 9]) {
        assert!(part.starts_with("url(data:") || part.starts_with("url(#"), "{part}");
    }
    let plain = without_base64(page);
    for never in ["http:", "https:", "@import", "<link", "<iframe", " src=\"", "NaN", ":inf", ",inf"] {
        assert!(!plain.contains(never), "{never} in the page");
    }
}

/// Samples and images travel in base64, which may spell anything.
fn without_base64(text: &str) -> String {
    let text = text.replace(";base64,", "\"values\":\"");
    let parts = text.split("\"values\":\"").enumerate();
    parts.map(|(k, part)| if k == 0 { part } else { part.split_once('"').map_or("", |p| p.1) }).collect()
}

pub(crate) fn check_pictures(report: &Report) {
    for picture in pictures(&report.page(), Layout::Wide) {
        let svg = picture.svg();
        let tree = roxmltree::Document::parse(&svg);
        assert!(tree.is_ok(), "{}: {tree:?}", picture.name);
        let plain = without_base64(&svg);
        assert!(!plain.contains("NaN") && !plain.contains("inf\""), "{}", picture.name);
    }
}
