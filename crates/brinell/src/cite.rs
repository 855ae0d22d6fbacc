//! What to cite of a result: this program, and the paper whose model it implements. CITATION.cff has the same facts.

use crate::made_by::commit;

const DEVELOPERS: &str = "The brinell developers";
const TITLE: &str = "brinell: vibration of rolling bearings with real damage";
/// Of this version.
const YEAR: u32 = 2026;

/// Family and given names of the paper's authors.
const AUTHORS: [(&str, &str); 6] =
    [("Li", "Xinbin"), ("Liu", "Jing"), ("Ding", "Shizhao"), ("Xu", "Yajun"), ("Zhang", "Yu"), ("Xia", "Min")];
const PAPER: &str =
    "Dynamic modeling and vibration analysis of double row cylindrical roller bearings with irregular-shaped defects";
const JOURNAL: &str = "Nonlinear Dynamics";
const PAPER_YEAR: u32 = 2023;
const DOI: &str = "10.1007/s11071-023-09164-5";

/// As BibTeX.
pub fn bibtex() -> String {
    let note = match commit() {
        Some(commit) => format!("Commit {commit}"),
        None => "Commit unknown: built without one".into(),
    };
    let authors = AUTHORS.map(|(family, given)| format!("{family}, {given}")).join(" and ");
    format!(
        "@software{{brinell,
  author  = {{{{{DEVELOPERS}}}}},
  title   = {{{TITLE}}},
  version = {{{}}},
  year    = {{{YEAR}}},
  note    = {{{note}}}
}}

@article{{li2023irregular,
  author  = {{{authors}}},
  title   = {{{PAPER}}},
  journal = {{{JOURNAL}}},
  year    = {{{PAPER_YEAR}}},
  doi     = {{{DOI}}}
}}",
        crate::VERSION
    )
}

/// As text, a line each: of what this version of the program made.
pub fn text(version: &str) -> String {
    let initial = |given: &str| given.chars().next().map_or(String::new(), String::from);
    let authors = AUTHORS.map(|(family, given)| format!("{family}, {}.", initial(given)));
    let (last, first) = authors.split_last().map_or(("", &[][..]), |(last, first)| (last, first));
    format!(
        "{DEVELOPERS} ({YEAR}). {TITLE} (version {version}) [software].\n{}, & {last} ({PAPER_YEAR}). {PAPER}. {JOURNAL}. doi:{DOI}",
        first.join(", ")
    )
}
