//! The frame of every page: its head with style and typefaces, the heading and what is said under it, figures, the end.

use std::fmt::Write as _;

use crate::embedded::SCRIPT;
use crate::encode::base64;
use crate::font;
use crate::layout::Layout;
use crate::markup::escape;
use crate::number::{Height, runs, shown_unit};
use crate::picture::Picture;
use sha2::{Digest, Sha256};

/// At the foot of pages with curves.
pub(crate) const THINNED: &str = "Of long curves a column of pixels, or of the values that the page keeps for zooming (65 536 at most), shows its smallest and largest value, in spectra its largest.";

/// A page up to the end of its header: title, a line under it, the version of the program that `done` it ("Simulated");
/// both may be empty. `warning`: a few words in bold, and what is to be said of them.
pub(crate) fn open(
    title: &str,
    subtitle: &str,
    (done, version): (&str, &str),
    warning: Option<(&str, &str)>,
) -> String {
    let mut page = String::with_capacity(1 << 20);
    head(&mut page, title);
    if !subtitle.is_empty() {
        let _ = writeln!(page, "<p class=\"subtitle\">{}</p>", escape(subtitle));
    }
    if !version.is_empty() {
        let _ = writeln!(page, "<p class=\"version\">{} by brinell {}</p>", done, escape(version));
    }
    if let Some((strong, words)) = warning {
        alert(&mut page, strong, words);
    }
    page.push_str("</header>\n");
    page
}

/// The list of contents, of places and names, and the beginning of `main`.
pub(crate) fn contents<'a>(page: &mut String, chapters: impl Iterator<Item = (&'a str, &'a str)>) {
    page.push_str("<nav aria-label=\"Contents\"><ul>");
    for (id, name) in chapters {
        let _ = write!(page, "<li><a href=\"#{id}\">{}</a></li>", escape(name));
    }
    page.push_str("</ul></nav>\n<main>\n");
}

/// The result in a sentence, the first of `main`; may be empty.
pub(crate) fn lead(page: &mut String, words: &str) {
    if !words.is_empty() {
        let _ = writeln!(page, "<p class=\"lead\">{}</p>", escape(words));
    }
}

/// What must not be overlooked.
pub(crate) fn alert(page: &mut String, strong: &str, words: &str) {
    page.push_str("<p class=\"partial\" role=\"alert\">");
    if !strong.is_empty() {
        let _ = write!(page, "<strong>{}</strong> ", escape(strong));
    }
    let _ = writeln!(page, "{}</p>", escape(words));
}

/// The end of a page whose `main` is open; `script` is what it runs beside what every page does.
pub(crate) fn close(mut page: String, footer: &str, script: &[&str]) -> String {
    let _ = writeln!(page, "</main>\n<footer>{} To cite brinell: <code>brinell cite</code>.</footer>", escape(footer));
    let parts = [&SCRIPT[..], script, &[include_str!("script/frame.js")]];
    // A script within the page is no module.
    let script = format!("\n{}", parts.concat().concat()).replace("\nexport ", "\n");
    let _ = writeln!(page, "<script>{script}</script>");
    page.push_str("</body>\n</html>\n");
    let policy = policy(&script);
    if let Some(place) = page.find(CHARSET) {
        page.insert_str(place + CHARSET.len(), &policy);
    }
    page
}

/// The page's first element after `<head>`.
const CHARSET: &str = "<meta charset=\"utf-8\">\n";

/// What the page may do: run this one script, and show what is inside it. Whatever else is in it, from a scenario or a
/// measured file, is not run and loads nothing. Pictures carry styles in their elements.
fn policy(script: &str) -> String {
    let script = format!("'sha256-{}'", base64(&Sha256::digest(script)));
    format!(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {script}; style-src 'unsafe-inline'; \
         img-src data:; font-src data:; base-uri 'none'; form-action 'none'\">\n"
    )
}

/// From the first byte to the heading; `header` stays open.
fn head(page: &mut String, title: &str) {
    let title = escape(title);
    let _ = write!(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n{CHARSET}\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title} · brinell</title>\n<style>\n",
    );
    for bold in [false, true] {
        page.push_str(&font::css(bold));
    }
    page.push_str(include_str!("script/page.css"));
    let _ = write!(page, "</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n");
}

/// A section with its heading, which may be empty, and what `write` puts under it.
pub(crate) fn section(page: &mut String, id: &str, title: &str, write: &mut dyn FnMut(&mut String)) {
    let _ = writeln!(page, "<section id=\"{id}\">");
    if !title.is_empty() {
        let _ = writeln!(page, "<h2>{}</h2>", escape(title));
    }
    write(page);
    page.push_str("</section>\n");
}

/// The same, which its heading opens.
pub(crate) fn folded(page: &mut String, id: &str, title: &str, write: &mut dyn FnMut(&mut String)) {
    let _ = writeln!(page, "<section id=\"{id}\">");
    details(page, "h2", title, false, write);
    page.push_str("</section>\n");
}

/// What its heading, of this level, opens and closes.
pub(crate) fn details(page: &mut String, level: &str, title: &str, open: bool, write: &mut dyn FnMut(&mut String)) {
    let open = if open { " open" } else { "" };
    let _ = writeln!(page, "<details{open}><summary><{level}>{}</{level}></summary>", escape(title));
    write(page);
    page.push_str("</details>\n");
}

/// Text as written in a file.
pub(crate) fn code(page: &mut String, text: &str) {
    let _ = writeln!(page, "<pre><code>{}</code></pre>", escape(text));
}

pub(crate) fn none(page: &mut String, words: &str) {
    let _ = writeln!(page, "<p class=\"none\">{words}</p>");
}

/// A unit with raised exponents.
pub(crate) fn unit_html(unit: &str) -> String {
    runs(shown_unit(unit))
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

#[cfg(test)]
mod tests {
    use super::*;

    fn page(script: &[&str]) -> String {
        let title = "a <meta charset=\"utf-8\">\n page";
        close(open(title, "", ("", ""), None), "", script)
    }

    #[test]
    fn prop_a_page_runs_its_own_script_and_no_other() {
        let with = page(&["let a = 1;\n", "let b = 2;\n"]);
        let (before, rest) = with.split_once("<script>").unwrap();
        let script = rest.split_once("</script>").unwrap().0;
        let hash = base64(&Sha256::digest(script));
        assert!(before.contains(&format!("script-src 'sha256-{hash}';")));
        for page in [with, page(&[])] {
            // Before anything that it is about.
            let at = page.find("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';");
            let first = ["<style", "<script", "<title"].map(|tag| page.find(tag));
            assert!(first.into_iter().flatten().all(|tag| at.unwrap() < tag));
            assert_eq!(page.matches("Content-Security-Policy").count(), 1);
        }
    }

    /// `printf 'alert(1)' | openssl dgst -sha256 -binary | base64`.
    #[test]
    fn xval_the_hash_of_a_script() {
        let hash = "'sha256-bhHHL3z2vDgxUt0W3dWQOrprscmda2Y5pLsLg4GF+pI='";
        assert!(policy("alert(1)").contains(hash));
    }
}
