//! The frame of every page: its head with style and typefaces, the heading and what is said under it, figures, the end.

use std::fmt::Write as _;

use crate::embedded::base64;
use crate::font;
use crate::number::{Height, runs};
use crate::picture::{Picture, escape};
use crate::plots::Layout;

/// At the foot of pages with curves.
pub(crate) const THINNED: &str = "Curves are thinned to the pixels of the page: each column keeps its smallest and largest value, in spectra its largest.";

/// A page up to the end of its header: title, a line under it, the version of the program that `done` it ("Simulated"); both may be empty.
/// Each of `alerts` is a few words that stand out, and what is to be said of them; either may be empty.
pub(crate) fn open<'a>(
    title: &str,
    subtitle: &str,
    (done, version): (&str, &str),
    alerts: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> String {
    let mut page = String::with_capacity(1 << 20);
    head(&mut page, title);
    if !subtitle.is_empty() {
        let _ = writeln!(page, "<p class=\"subtitle\">{}</p>", escape(subtitle));
    }
    if !version.is_empty() {
        let _ = writeln!(
            page,
            "<p class=\"version\">{} by brinell {}</p>",
            done,
            escape(version)
        );
    }
    for (strong, words) in alerts {
        alert(&mut page, strong, words);
    }
    page.push_str("</header>\n");
    page
}

/// Warnings as [`open`] takes them.
pub(crate) fn plain(warnings: &[String]) -> impl Iterator<Item = (&str, &str)> {
    warnings.iter().map(|words| ("", words.as_str()))
}

/// What must not be overlooked.
pub(crate) fn alert(page: &mut String, strong: &str, words: &str) {
    page.push_str("<p class=\"partial\" role=\"alert\">");
    if !strong.is_empty() {
        let _ = write!(page, "<strong>{}</strong> ", escape(strong));
    }
    let _ = writeln!(page, "{}</p>", escape(words));
}

/// The end of a page whose `main` is open; `script` may be empty.
pub(crate) fn close(mut page: String, footer: &str, script: &[&str]) -> String {
    let _ = writeln!(page, "</main>\n<footer>{}</footer>", escape(footer));
    if !script.is_empty() {
        let _ = writeln!(page, "<script>\n{}</script>", script.concat());
    }
    page.push_str("</body>\n</html>\n");
    page
}

/// From the first byte to the heading; `header` stays open.
fn head(page: &mut String, title: &str) {
    let title = escape(title);
    let _ = write!(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title} · brinell</title>\n<style>\n",
    );
    for (weight, face) in [(400, font::REGULAR), (600, font::SEMI_BOLD)] {
        let _ = writeln!(
            page,
            "@font-face {{ font-family: Inter; font-weight: {weight}; src: url(data:font/otf;base64,{}) format(\"opentype\"); }}",
            base64(face)
        );
    }
    page.push_str(include_str!("page.css"));
    let _ = write!(
        page,
        "</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n"
    );
}

/// A section with its heading, and what `write` puts under it.
pub(crate) fn section(page: &mut String, id: &str, title: &str, write: impl FnOnce(&mut String)) {
    let _ = writeln!(page, "<section id=\"{id}\">\n<h2>{}</h2>", escape(title));
    write(page);
    page.push_str("</section>\n");
}

/// A scenario under a heading, where there is one.
pub(crate) fn scenario(page: &mut String, title: &str, toml: &str) {
    if !toml.is_empty() {
        section(page, "scenario", title, |page| code(page, toml));
    }
}

/// Text as it stands in a file.
pub(crate) fn code(page: &mut String, text: &str) {
    let _ = writeln!(page, "<pre><code>{}</code></pre>", escape(text));
}

pub(crate) fn none(page: &mut String, words: &str) {
    let _ = writeln!(page, "<p class=\"none\">{words}</p>");
}

/// A unit with raised exponents.
pub(crate) fn unit_html(unit: &str) -> String {
    runs(unit)
        .iter()
        .map(|run| {
            let text = escape(&run.text);
            match run.height {
                Height::Line => text,
                Height::Raised => format!("<sup>{text}</sup>"),
                Height::Lowered => format!("<sub>{text}</sub>"),
            }
        })
        .collect()
}

/// The picture for wide and for narrow pages, with words under it.
pub(crate) fn figure(page: &mut String, id: &str, draw: impl Fn(Layout) -> Picture, caption: &str) {
    let wide = draw(Layout::Wide).inline(&format!("{id}-w"), "wide");
    let narrow = draw(Layout::Narrow).inline(&format!("{id}-n"), "narrow");
    let _ = write!(page, "<figure>\n{wide}{narrow}");
    if !caption.is_empty() {
        let _ = write!(page, "<figcaption>{caption}</figcaption>");
    }
    page.push_str("</figure>\n");
}
