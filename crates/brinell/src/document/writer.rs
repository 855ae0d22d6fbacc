//! The walk that writes a scenario as TOML: with every default filled in, or as a template to edit.

use std::collections::HashMap;

use super::field::{Field, Words};
use super::machine::tables::{OF_ALL, OF_THE_SHAFT};
use super::provenance::{Origin, Provenance};
use super::spec::Spec;
use super::walk::{Case, Fallback, Keys, Offers, Tables, Walk};

/// What the comments say, and which keys are live.
pub(crate) struct Style<'a> {
    pub(crate) provenance: HashMap<&'a str, &'a Provenance>,
    /// Every key explained, and those that the file need not give commented out; otherwise those that are assumed have
    /// their reason.
    pub(crate) template: bool,
}

/// Which of a file's sections are written.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Part {
    /// All, of the file of one bearing.
    All,
    /// Of a machine's file: its name.
    Name,
    /// What is around its bearings.
    Around,
    /// Where bearing `k` is, from 0: begins its table.
    Seat(usize),
    /// The keys of a bearing, in the table that was begun.
    Bearing,
    /// What all bearings share.
    OfAll,
}

impl Part {
    /// Whether it has a key or section of the top of the file.
    fn has(self, name: &str) -> bool {
        match self {
            Self::All => true,
            Self::Name => name == "name",
            Self::Around => name != "bearing",
            Self::Seat(_) => name == "bearing",
            Self::Bearing => !["name", "operation", "housing", "sensor", "simulation"].contains(&name),
            Self::OfAll => OF_ALL.contains(&name),
        }
    }

    /// Whether it has a key of a section: in a machine loads are the shaft's.
    fn has_key(self, section: &str, name: &str) -> bool {
        self != Self::OfAll || section != "operation" || !OF_THE_SHAFT.contains(&name)
    }

    /// The header of what is called so in the file of one bearing.
    fn header(self, path: &str) -> String {
        if self == Self::Bearing { format!("bearing.{path}") } else { path.to_owned() }
    }
}

struct Line {
    code: String,
    comment: String,
}

pub(crate) struct Writer<'a> {
    style: Style<'a>,
    part: Part,
    /// Where bearings are left out of what is around them.
    bearings_at: usize,
    out: String,
    lines: Vec<Line>,
    path: Vec<String>,
    /// Keys of the inline table being written.
    inline: Option<Vec<String>>,
    /// Explanations of an inline table's keys, and reasons of its assumed values.
    comments: Vec<String>,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(style: Style<'a>) -> Writer<'a> {
        Self::of_part(style, Part::All)
    }

    pub(crate) fn of_part(style: Style<'a>, part: Part) -> Writer<'a> {
        Writer {
            part,
            bearings_at: 0,
            style,
            out: String::new(),
            lines: Vec::new(),
            path: Vec::new(),
            inline: None,
            comments: Vec::new(),
        }
    }

    pub(crate) fn finish(mut self) -> String {
        self.flush();
        self.out
    }

    /// What comes before the bearings, and what after them.
    pub(crate) fn finish_at_bearings(mut self) -> [String; 2] {
        self.flush();
        let after = self.out.split_off(self.bearings_at);
        [self.out, after]
    }

    /// Whether what the walk names is of another part.
    fn skips(&self, name: &str) -> bool {
        match &self.path[..] {
            [] => !self.part.has(name),
            [section] => !self.part.has_key(section, name),
            _ => false,
        }
    }

    fn path_of(&self, name: &str) -> String {
        let mut path = self.path.join(".");
        if !path.is_empty() {
            path.push('.');
        }
        path + name
    }

    fn provenance(&self, name: &str) -> Option<&'a Provenance> {
        self.style.provenance.get(self.path_of(name).as_str()).copied()
    }

    /// Comment of one key.
    fn remark(&self, spec: &Spec, range: Words) -> String {
        let provenance = self.provenance(spec.name);
        let text = if self.style.template {
            let origin = match provenance {
                Some(provenance) if provenance.assumed => "; assumed",
                Some(Provenance { origin: Origin::Preset { .. }, .. }) => "; catalogue",
                _ => "",
            };
            explain(spec, range) + origin
        } else {
            match provenance {
                Some(provenance) if provenance.assumed => format!("assumed, {}", provenance.reason()),
                Some(provenance) if matches!(provenance.origin, Origin::DamageFile(_)) => provenance.reason(),
                _ => String::new(),
            }
        };
        text.replace(['\n', '\r'], " ")
    }

    fn add(&mut self, spec: &Spec, range: Words, value: &str, live: bool) {
        if self.skips(spec.name) {
            return;
        }
        let code = format!("{} = {value}", spec.name);
        let remark = self.remark(spec, range);
        if let Some(inline) = &mut self.inline {
            inline.push(code);
            if !remark.is_empty() {
                self.comments.push(format!("{}: {remark}", spec.name));
            }
            return;
        }
        let code = if live { code } else { format!("# {code}") };
        self.lines.push(Line { code, comment: remark });
    }

    /// Explains a key that has no value: beside the inline table that would hold it, or on a line of its own.
    fn comment(&mut self, text: String) {
        if self.inline.is_some() {
            self.comments.push(text);
        } else {
            let line = Line { code: String::new(), comment: text };
            self.lines.push(line);
        }
    }

    /// Writes the lines gathered, their comments in one column where the values are short.
    fn flush(&mut self) {
        const WIDEST: usize = 52;
        let width = |line: &Line| line.code.chars().count();
        let commented = self.lines.iter().filter(|line| !line.comment.is_empty());
        let column = commented.map(width).filter(|w| *w <= WIDEST).max().unwrap_or(0);
        for line in std::mem::take(&mut self.lines) {
            self.out.push_str(&line.code);
            if !line.comment.is_empty() {
                if !line.code.is_empty() {
                    let gap = column.saturating_sub(width(&line)) + 2;
                    self.out.push_str(&" ".repeat(gap));
                }
                self.out.push_str("# ");
                self.out.push_str(&line.comment);
            }
            self.out.push('\n');
        }
    }

    /// What a walk writes between the braces of table `name`; what there is to say of its keys is left in `comments`.
    fn inline(&mut self, name: &str, walk: impl FnOnce(&mut Self)) -> String {
        self.path.push(name.to_string());
        self.inline = Some(Vec::new());
        self.comments.clear();
        walk(self);
        self.path.pop();
        self.inline.take().unwrap_or_default().join(", ")
    }

    fn header(&mut self, bracketed: String, doc: &str) {
        self.flush();
        self.out.push('\n');
        self.out.push_str(&bracketed);
        if self.style.template {
            self.out.push_str("  # ");
            self.out.push_str(doc);
        }
        self.out.push('\n');
    }
}

/// Meaning, range and unit in one phrase.
fn explain(spec: &Spec, range: Words) -> String {
    let mut text = spec.doc.to_string();
    let range = range(spec);
    let bounded = !range.is_empty() && range != super::spec::Range::ANY.to_string();
    match (bounded, spec.unit) {
        (false, "") => {}
        (false, unit) => text.push_str(&format!("; {unit}")),
        (true, "") => text.push_str(&format!("; {range}")),
        (true, unit) => text.push_str(&format!("; {range} {unit}")),
    }
    text
}

impl Walk for Writer<'_> {
    fn at_key(&mut self, spec: Spec, _: Fallback<&dyn Field>, value: &mut dyn Field) -> bool {
        let given = self
            .provenance(spec.name)
            .is_some_and(|provenance| matches!(provenance.origin, Origin::File | Origin::Override));
        let live = !self.style.template || given;
        self.add(&spec, value.kind().range, &value.write(), live);
        false
    }

    fn at_optional(&mut self, spec: Spec, given: bool, value: &mut dyn Field) -> bool {
        if given {
            self.add(&spec, value.kind().range, &value.write(), true);
        } else if self.style.template {
            self.comment(format!("{}: {}", spec.name, explain(&spec, value.kind().range)));
        }
        given
    }

    fn at_only_where(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut dyn Field) {
        let range = value.kind().range;
        if wanted {
            return self.add(&spec, range, &value.write(), true);
        }
        if self.style.template && (self.inline.is_some() || !value.fits(&spec)) {
            self.comment(format!("{}: {}; only where {case}", spec.name, explain(&spec, range)));
        } else if self.style.template {
            self.add(&spec, range, &value.write(), false);
            if let Some(line) = self.lines.last_mut() {
                line.comment.push_str(&format!("; only where {case}"));
            }
        }
    }

    fn at_key_where(
        &mut self,
        spec: Spec,
        (wanted, case): Case,
        fallback: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        if wanted {
            self.at_key(spec, fallback, value);
        } else if self.style.template {
            self.comment(format!("{}: {}; only where {case}", spec.name, explain(&spec, value.kind().range)));
        }
        false
    }

    fn at_section(&mut self, spec: Spec, keys: &mut dyn FnMut(&mut Keys)) {
        self.flush();
        let before = self.out.len();
        if self.skips(spec.name) {
            return;
        }
        if (self.part, spec.name) != (Part::Bearing, "bearing") {
            self.header(format!("[{}]", self.part.header(spec.name)), spec.doc);
        }
        let bare = self.out.len();
        self.path.push(spec.name.to_string());
        keys(self);
        self.path.pop();
        // A section without a key says nothing.
        if self.lines.is_empty() && self.out.len() == bare {
            self.out.truncate(before);
        }
    }

    fn at_tables(&mut self, spec: Spec, items: &mut dyn Tables) {
        if items.count() == 0 && self.style.template && !self.path.is_empty() {
            self.comment(format!("[[{}]]: {}", self.path_of(spec.name), spec.doc));
        }
        if self.skips(spec.name) {
            self.flush();
            self.bearings_at = self.out.len();
            return;
        }
        let first = if let Part::Seat(k) = self.part { k } else { 0 };
        for i in 0..items.count() {
            self.header(format!("[[{}]]", self.part.header(&self.path_of(spec.name))), spec.doc);
            self.path.push(spec.name.to_string());
            self.path.push((first + i).to_string());
            items.walk(i, self);
            self.path.truncate(self.path.len() - 2);
        }
    }

    fn at_one_of(&mut self, spec: Spec, value: &mut dyn Offers) {
        let all = value.all();
        let (chosen, _) = all[value.chosen()];
        self.path.push(spec.name.to_string());
        if self.style.template {
            let say = |writer: &mut Self, comment: String| {
                writer.lines.push(Line { code: String::new(), comment });
            };
            say(self, format!("{}: {}; one of", spec.name, spec.doc));
            for (i, (name, doc)) in all.into_iter().enumerate() {
                self.inline(name, |writer| value.walk_blank(i, writer));
                say(self, format!("  {name}: {doc}"));
                for comment in std::mem::take(&mut self.comments) {
                    say(self, format!("    {comment}"));
                }
            }
        }
        let inner = self.inline(chosen, |writer| value.walk(writer));
        self.path.pop();
        let comment = match self.style.template {
            true => String::new(),
            false => std::mem::take(&mut self.comments).join("; "),
        };
        self.lines.push(Line { code: format!("{} = {{ {chosen} = {{ {inner} }} }}", spec.name), comment });
    }
}
