//! Text to the terminal: what was read from files cannot steer it, and a text that cannot be written is not passed
//! over. Where nobody reads on (a closed pipe), the command continues quietly.

use anstyle::AnsiColor;
pub(crate) use brinell_report::{plural, short, shown_unit, twelve_digits};
use serde::Serialize;
use std::borrow::Cow;
use std::fmt::Arguments;
use std::io::{ErrorKind, Result, Write};
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Why standard output did not take something; the first reason.
static FAILED: OnceLock<std::io::Error> = OnceLock::new();

/// Whether standard output was closed when the process began (`>&-`).
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Rust opens /dev/null in the place of a closed standard output before `main`, and what is said would be lost without
/// a word. So this looks before that does.
#[cfg(target_os = "linux")]
mod before_main {
    use super::{CLOSED, Ordering};

    extern "C" fn look() {
        // SAFETY: fcntl with F_GETFD reads a flag of the descriptor and touches no memory.
        let flags = unsafe { libc::fcntl(libc::STDOUT_FILENO, libc::F_GETFD) };
        CLOSED.store(flags == -1, Ordering::Relaxed);
    }

    // SAFETY: the section holds pointers to functions that the loader calls once each, and this is one.
    #[used]
    #[unsafe(link_section = ".init_array")]
    static LOOK: extern "C" fn() = look;
}

/// Writes one line of words to standard output.
pub(crate) fn line(text: Arguments) {
    put(&printable(&text.to_string(), |c| format!("\\u{{{:x}}}", u32::from(c))));
}

/// Writes JSON or TOML to standard output. Control characters are in strings there, and get these languages' own
/// escape.
pub(crate) fn document(text: &str) {
    put(&printable(text, |c| format!("\\u{:04x}", u32::from(c))));
}

/// Writes JSON to standard output.
pub(crate) fn json(value: &impl Serialize) {
    document(pretty(value).trim_end());
}

/// Which files were written, a line each.
pub(crate) fn wrote(files: impl IntoIterator<Item = impl AsRef<Path>>) {
    for path in files {
        line(format_args!("  wrote {}", path.as_ref().display()));
    }
}

/// JSON as files hold it.
pub(crate) fn pretty(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}

fn put(text: &str) {
    note(writeln!(std::io::stdout().lock(), "{text}"));
}

/// Keeps what became of a text for standard output.
pub(crate) fn note(result: Result<()>) {
    keep(not_closed(result));
}

fn not_closed(result: Result<()>) -> Result<()> {
    match CLOSED.load(Ordering::Relaxed) {
        true => Err(std::io::Error::other("it is closed")),
        false => result,
    }
}

fn keep(result: Result<()>) {
    if let Err(error) = result
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _ = FAILED.set(error);
    }
}

/// That everything said has arrived.
///
/// # Errors
/// Where standard output did not take it, a closed pipe aside: what it said.
pub(crate) fn arrived() -> std::result::Result<(), String> {
    keep(std::io::stdout().flush());
    FAILED.get().map_or(Ok(()), |error| Err(error.to_string()))
}

/// Writes one line of words to standard output, for a command that goes on without end.
///
/// # Errors
/// Where it did not arrive, a closed pipe not aside: what the system said.
pub(crate) fn at_once(text: &str) -> std::result::Result<(), String> {
    let mut out = std::io::stdout().lock();
    not_closed(writeln!(out, "{text}").and_then(|()| out.flush())).map_err(|error| error.to_string())
}

/// Writes one line to standard error.
pub(crate) fn complaint(text: Arguments) {
    let text = text.to_string();
    let text = printable(&text, |c| format!("\\u{{{:x}}}", u32::from(c)));
    // In colour where a terminal shows it, and NO_COLOR does not forbid it.
    let _ = writeln!(anstream::stderr().lock(), "{}", coloured(&text));
}

/// The words that begin a complaint's lines, in the colours that other commands have for them.
fn coloured(text: &str) -> String {
    const BEGINNINGS: [(&str, AnsiColor); 2] = [("error", AnsiColor::Red), ("warning", AnsiColor::Yellow)];
    const PLACE: &str = "-->";
    let line = |line: &str| {
        for (word, colour) in BEGINNINGS {
            let Some(rest) = line.strip_prefix(word) else {
                continue;
            };
            let style = colour.on_default().bold();
            if let Some(rest) = rest.strip_prefix(':') {
                return format!("{style}{word}:{style:#}{rest}");
            }
            if rest.starts_with(", line ") {
                return format!("{style}{word}{style:#}{rest}");
            }
        }
        let marks = line.split_once(" | ").is_some_and(|(gutter, rest)| {
            gutter.trim().is_empty() && !rest.trim().is_empty() && rest.trim_matches([' ', '^']).is_empty()
        });
        let blue = AnsiColor::Blue.on_default().bold();
        match line.split_once(PLACE) {
            Some((gutter, place)) if gutter.trim().is_empty() => {
                format!("{gutter}{blue}{PLACE}{blue:#}{place}")
            }
            _ if marks => {
                let red = AnsiColor::Red.on_default().bold();
                let (gutter, rest) = line.split_once('^').unwrap_or((line, ""));
                format!("{gutter}{red}^{rest}{red:#}")
            }
            _ => line.to_owned(),
        }
    };
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

/// Whether a terminal would act upon it: control characters, and those that turn the direction of writing (Unicode's
/// Bidi_Control).
fn acts(c: char) -> bool {
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || c.is_control() && !matches!(c, '\n' | '\t')
}

/// The text without control characters but line breaks and tabs, which a terminal would act upon.
fn printable(text: &str, escaped: impl Fn(char) -> String) -> Cow<'_, str> {
    if !text.contains(acts) {
        return text.into();
    }
    let one = |c: char| if acts(c) { escaped(c) } else { c.into() };
    text.chars().map(one).collect::<String>().into()
}

/// A name that somebody gave, on one line.
pub(crate) fn one_line(name: &str) -> String {
    name.replace('\n', "\\u{a}").replace('\t', "\\u{9}")
}

/// Says a line on standard output.
macro_rules! say {
    ($($arg:tt)*) => { crate::say::line(format_args!($($arg)*)) };
}
pub(crate) use say;

/// Says a line on standard error.
macro_rules! complain {
    ($($arg:tt)*) => { crate::say::complaint(format_args!($($arg)*)) };
}
pub(crate) use complain;

/// [`twelve_digits`] in words.
pub(crate) fn plain_number(x: f64) -> String {
    let rounded = twelve_digits(x);
    let size = rounded.abs();
    match size >= 1e6 || (size > 0.0 && size < 1e-3) {
        true => format!("{rounded:e}"),
        false => rounded.to_string(),
    }
}

/// [`short`], with 0 for what is the solver's error beside `scale`.
pub(crate) fn significant(x: f64, scale: f64, digits: usize) -> String {
    // The static balance leaves 1e-10 of the forces over.
    const ROUND_OFF: f64 = 1e-9;
    short(if x.abs() < ROUND_OFF * scale.abs() { 0.0 } else { x }, digits)
}

#[cfg(test)]
mod tests {
    use super::{coloured, one_line, printable};

    #[test]
    fn prop_colour_marks_what_begins_a_complaint_and_changes_no_word() {
        let text = "error: a: b\n  --> s.toml:1:2\n  1 | error: x\n    |   ^^^\nwarning: c\nerrors 2\nerror, line 2: d";
        let shown = coloured(text);
        assert_eq!(anstream::adapter::strip_str(&shown).to_string(), text);
        let red = "\u{1b}[1m\u{1b}[31m";
        let lines: Vec<&str> = shown.lines().collect();
        assert!(lines[0].starts_with(red) && lines[3].contains(red), "{shown:?}");
        assert!(lines[4].starts_with("\u{1b}[1m\u{1b}[33mwarning:"), "{shown:?}");
        assert_eq!((lines[2], lines[5]), ("  1 | error: x", "errors 2"));
        assert!(lines[6].starts_with("\u{1b}[1m\u{1b}[31merror\u{1b}[0m, line 2"), "{shown:?}");
    }

    #[test]
    fn prop_nothing_that_a_terminal_acts_upon_is_printed() {
        let words = |text: &str| printable(text, |c| format!("\\u{{{:x}}}", u32::from(c))).into_owned();
        assert_eq!(words("µm\t1\n"), "µm\t1\n");
        assert_eq!(words("a\u{1b}]52;c;x\u{7}"), "a\\u{1b}]52;c;x\\u{7}");
        for code in 0..0x2100_u32 {
            let Some(c) = char::from_u32(code) else {
                continue;
            };
            let turns = matches!(code, 0x61c | 0x200e | 0x200f | 0x202a..=0x202e | 0x2066..=0x2069);
            let acts = turns || c.is_control() && c != '\n' && c != '\t';
            assert_eq!(words(&c.to_string()).contains(c), !acts, "{code:x}");
            assert!(!one_line(&words(&c.to_string())).contains(char::is_control));
        }
    }
}
