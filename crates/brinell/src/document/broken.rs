//! Why a text of TOML breaks, where people most often break it: a bracket that is not closed, text without quotes, a
//! decimal comma.

/// The place in bytes of the innermost `[` or `{` that is open where `broken` begins, if a new key or table is written
/// there: its `]` or `}` was forgotten, and each line behind is no valid list.
pub(super) fn bracket_before(text: &str, broken: usize) -> Option<usize> {
    let line = text.get(broken..)?.lines().next()?;
    let at_start = text.get(..broken)?.rsplit('\n').next()?.trim().is_empty();
    if !at_start || !begins_key_or_table(line) {
        return None;
    }
    open_brackets(text.get(..broken)?).pop()
}

/// Longest value that is repeated in a message.
const LONGEST: usize = 40;

/// What is wrong with the value of the line that breaks at `broken`, if it is text without quotes or has a decimal comma.
pub(super) fn bare_value(text: &str, broken: usize) -> Option<String> {
    let (before, after) = text.split_at_checked(broken)?;
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let end = after.find('\n').map_or(text.len(), |at| broken + at);
    let (key, value) = text[start..end].split_once('=')?;
    let value = value.split('#').next().unwrap_or_default().trim();
    let fits = is_name(key) && broken > start + key.len() && (1..=LONGEST).contains(&value.len());
    if !fits || value.contains(['"', '\'', '[', ']', '{', '}', '=', '\\']) {
        return None;
    }
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    match value.split_once(',') {
        Some((whole, part)) if digits(whole.trim_start_matches('-')) && digits(part) => {
            Some(format!("a number has a decimal point: {} = {whole}.{part}", key.trim()))
        }
        _ if value.contains(char::is_alphabetic) => {
            Some(format!("text, and a number with its unit, stand in quotes: {} = \"{value}\"", key.trim()))
        }
        _ => None,
    }
}

/// Whether a text is a key, with its dots.
fn is_name(text: &str) -> bool {
    let text = text.trim();
    !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '"' | '\''))
}

/// Whether a line is `key = …` or `[table]`.
fn begins_key_or_table(line: &str) -> bool {
    let header = line.trim_start_matches('[');
    match header.len() < line.len() {
        true => header
            .split_once(']')
            .is_some_and(|(inner, _)| is_name(inner) && !inner.starts_with(|c: char| c.is_ascii_digit())),
        false => line.split_once('=').is_some_and(|(key, _)| is_name(key)),
    }
}

/// The places of the brackets that are open at the end of `text`, outermost first; none of strings and comments.
fn open_brackets(text: &str) -> Vec<usize> {
    let mut open = Vec::new();
    let mut at = 0;
    while let Some(rest) = text.get(at..)
        && let Some(first) = rest.chars().next()
    {
        at += match first {
            '#' => rest.find('\n').unwrap_or(rest.len()),
            '"' | '\'' => string_length(rest, first),
            '[' | '{' => {
                open.push(at);
                1
            }
            ']' | '}' => {
                open.pop();
                1
            }
            _ => first.len_utf8(),
        };
    }
    open
}

/// Bytes of the string that `text` begins with; to the end of its line where it is not closed.
fn string_length(text: &str, quote: char) -> usize {
    let triple: String = std::iter::repeat_n(quote, 3).collect();
    if let Some(inner) = text.strip_prefix(&triple) {
        return inner.find(&triple).map_or(text.len(), |end| end + 6);
    }
    let mut escaped = false;
    for (k, c) in text.char_indices().skip(1) {
        match c {
            '\n' => return k,
            c if c == quote && !escaped => return k + 1,
            _ => escaped = c == '\\' && quote == '"' && !escaped,
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_the_bracket_that_was_forgotten_is_found_and_no_other() {
        let at = |text: &str, broken: &str| bracket_before(text, text.find(broken).unwrap());
        assert_eq!(at("a = [1, 2\nb = 3\n", "b ="), Some(4));
        assert_eq!(at("a = [[0, 1], [2, 3]\n\n[[table]]\n", "[[table"), Some(4));
        assert_eq!(at("a = { b = 1, c = { d = 2 }\n  [table]\n", "[table"), Some(4));
        // Brackets of strings and comments are none.
        assert_eq!(at("a = \"[\" # [\nb = '''{\n{'''\nc = [ \"\\\"]\"\nd = 1\n", "d ="), Some(30));
        assert_eq!(at("a = \"[\" # [\nb = 1\n", "b ="), None);
        // A comma is missing in a list of several lines, or within a line.
        assert_eq!(at("a = [\n  1\n  2\n]\n", "2\n"), None);
        assert_eq!(at("a = [[0, 1]\n  [2, 3]]\n", "[2"), None);
        assert_eq!(at("a = [1 b = 2\n", "b ="), None);
    }

    #[test]
    fn prop_text_without_quotes_and_decimal_commas_are_said() {
        let of = |line: &str| {
            let text = format!("a = 1\n{line}\nb = 2\n");
            bare_value(&text, 6 + line.find('=').unwrap() + 2)
        };
        for (line, said) in [
            ("preset = NU206", "preset = \"NU206\""),
            ("preset = 6205-2RS  # mine", "preset = \"6205-2RS\""),
            ("load.max = 0.5 kN", "load.max = \"0.5 kN\""),
            ("speed_rpm = -1,8", "speed_rpm = -1.8"),
        ] {
            assert!(of(line).is_some_and(|words| words.ends_with(said)), "{line}");
        }
        for line in ["a = ", "a = 1 2", "a = \"x", "a = [x", "a b = x", "a = { b = x"] {
            assert_eq!(of(line), None, "{line}");
        }
        assert_eq!(bare_value("é", 1), None);
        assert_eq!(bare_value("a", 9), None);
    }
}
