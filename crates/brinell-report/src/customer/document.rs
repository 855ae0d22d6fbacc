//! The report as files: HTML that prints as the two pages, and PDF.

use std::fmt::Write as _;

use super::CustomerReport;
use crate::font;
use crate::markup::escape;
use crate::picture::pdf::{Info, pdf};

/// What both files say that they were made by.
pub const GENERATOR: &str = "brinell analyze";

/// On a screen the pages as sheets, on a phone one column, in print two pages of A4 and nothing else.
const STYLE: &str = "@page { size: 210mm 297mm; margin: 0; }
html, body { margin: 0; padding: 0; background: #e3e7eb; }
svg { display: block; width: 100%; height: auto; font-family: Inter, 'Helvetica Neue', Arial, sans-serif; }
.sheet { background: #fff; max-width: 840px; margin: 16px auto; box-shadow: 0 1px 6px #0003; }
.column { background: #fff; display: none; }
@media screen and (max-width: 700px) { .sheet { display: none; } .column { display: block; } }
@media print {
html, body { background: #fff; }
.sheet { width: 210mm; max-width: none; height: 297mm; margin: 0; box-shadow: none; overflow: hidden; break-inside: avoid; }
.sheet + .sheet { break-before: page; }
}
";

impl CustomerReport {
    /// One HTML file, which needs no network: two sheets of A4, and the same in one column for a phone.
    pub fn html(&self) -> String {
        let words = |text: &str| escape(&text.split_whitespace().collect::<Vec<_>>().join(" "));
        let title = words(self.title());
        let mut page = String::with_capacity(1 << 19);
        let _ = write!(
            page,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:; \
             base-uri 'none'; form-action 'none'\">\n<meta name=\"generator\" content=\"{GENERATOR}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n"
        );
        if !self.heading.author.trim().is_empty() {
            let _ = writeln!(page, "<meta name=\"author\" content=\"{}\">", words(&self.heading.author));
        }
        page.push_str("<style>\n");
        for bold in [false, true] {
            page.push_str(&font::css(bold));
        }
        let _ = write!(page, "{STYLE}</style>\n</head>\n<body>\n<main>\n");
        for (k, sheet) in self.pages().iter().enumerate() {
            let _ = writeln!(page, "<section class=\"sheet\" aria-label=\"Page {} of 2\">", k + 1);
            page.push_str(&sheet.sheet(&format!("page-{}", k + 1), "page"));
            page.push_str("</section>\n");
        }
        page.push_str("<section class=\"column\" aria-label=\"The report in one column\">\n");
        page.push_str(&self.column().sheet("column", "page"));
        page.push_str("</section>\n</main>\n</body>\n</html>\n");
        page
    }

    /// The same two pages as PDF.
    pub fn pdf(&self) -> Vec<u8> {
        let author = self.heading.author.trim();
        pdf(&self.pages(), &Info { title: self.title(), author, creator: GENERATOR })
    }

    /// Letters of what was given that the PDF's typeface lacks, each once: it shows ? in their place.
    pub fn missing_letters(&self) -> String {
        let heading = &self.heading;
        let given =
            [&heading.title, &heading.machine, &heading.point, &heading.author, &heading.remark, &self.lead.channel];
        let files = self.lead.provenance.iter().map(|(_, words)| words);
        let mut letters: Vec<char> = given.into_iter().chain(files).flat_map(|text| text.chars()).collect();
        letters.retain(|c| !c.is_whitespace() && !font::has(c.encode_utf8(&mut [0; 4]), false));
        letters.sort_unstable();
        letters.dedup();
        letters.into_iter().collect()
    }
}
