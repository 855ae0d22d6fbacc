//! Problems as they are printed, each with the line that it is about.

use super::problem::{Problem, Severity};

/// The problems of a text called `name`, each followed by the line that it is about, the place marked beneath; last how
/// many errors there are, where there are several. No line break at the end.
pub fn render_diagnostics(name: &str, text: &str, problems: &[Problem]) -> String {
    let mut rendered = Vec::new();
    let lines: Vec<&str> = match problems.iter().any(|p| p.line.is_some()) {
        true => text.lines().collect(),
        false => Vec::new(),
    };
    for problem in problems {
        rendered.push(problem.to_string());
        let (Some(line), Some(column)) = (problem.line, problem.column) else {
            continue;
        };
        let Some(source) = lines.get(line - 1) else {
            continue;
        };
        let length = problem.span.as_ref().map_or(1, |s| {
            let end = s.end.min(text.len());
            text.get(s.start..end).map_or(1, |t| t.lines().next().unwrap_or("").chars().count().max(1))
        });
        // A long line (a profile's list) is shown around the place.
        let from = column.saturating_sub(60);
        let shown: String = source.chars().skip(from).take(100).collect();
        let number = line.to_string();
        let gutter = " ".repeat(number.len());
        rendered.push(format!("  {gutter}--> {name}:{line}:{column}"));
        rendered.push(format!("  {number} | {shown}"));
        let marks = "^".repeat(length.min(100usize.saturating_sub(column - 1 - from).max(1)));
        let before = " ".repeat(column - 1 - from);
        rendered.push(format!("  {gutter} | {before}{marks}"));
    }
    let errors: usize = problems.iter().filter(|p| p.severity == Severity::Error).map(|p| p.count).sum();
    if errors > 1 {
        rendered.push(format!("{errors} errors in {name}"));
    }
    rendered.join("\n")
}

/// The errors among problems on one line, as tables have them: without the word itself.
pub fn on_one_line(problems: &[Problem]) -> String {
    let errors = problems.iter().filter(|p| p.severity == Severity::Error);
    let texts: Vec<String> =
        errors.map(|problem| one_line(problem.to_string().trim_start_matches("error: "))).collect();
    texts.join("; ")
}

/// The lines of a text behind one another.
pub fn one_line(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    lines.join("; ")
}
