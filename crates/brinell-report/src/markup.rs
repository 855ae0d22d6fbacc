//! Text and numbers in SVG and HTML.

/// Escapes text for element content and double-quoted attributes; characters that XML forbids become U+FFFD.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            '\n' | '\t' => escaped.push(c),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

/// The same, with what stands between backticks as code.
pub(crate) fn prose(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return escape(text);
    }
    let part = |(k, part): (usize, &&str)| match k % 2 {
        0 => escape(part),
        _ => format!("<code>{}</code>", escape(part)),
    };
    parts.iter().enumerate().map(part).collect()
}

/// A name in markup, which may be broken after its points and underscores. Numbers are left alone, and so are tags.
pub(crate) fn breakable(html: &str) -> String {
    let mut set = String::with_capacity(html.len() + 40);
    let (mut within, mut before) = (false, ' ');
    for (at, c) in html.char_indices() {
        within = c == '<' || within && before != '>';
        set.push(c);
        let next = html[at + c.len_utf8()..].chars().next().unwrap_or(' ');
        let number = before.is_ascii_digit() && next.is_ascii_digit();
        if !within && matches!(c, '.' | '_') && before.is_alphanumeric() && next.is_alphanumeric() && !number {
            set.push_str("<wbr>");
        }
        before = c;
    }
    set
}

/// A coordinate to a tenth of a pixel; nothing a picture holds may be written as NaN.
pub(crate) fn coordinate(value: f64) -> String {
    let tenths = if value.is_finite() { (value.clamp(-1e5, 1e5) * 10.0).round() as i64 } else { 0 };
    let (whole, tenth) = (tenths / 10, (tenths % 10).abs());
    let sign = if tenths < 0 && whole == 0 { "-" } else { "" };
    if tenth == 0 { format!("{whole}") } else { format!("{sign}{whole}.{tenth}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_names_break_after_points_and_underscores_alone() {
        for (given, set) in [
            ("<code>housing1.drive_end_x</code>", "<code>housing1.<wbr>drive_<wbr>end_<wbr>x</code>"),
            ("bearing.0.defects", "bearing.<wbr>0.<wbr>defects"),
            ("<a href=\"a.b_c\">3.5 mm. Then</a>", "<a href=\"a.b_c\">3.5 mm. Then</a>"),
        ] {
            assert_eq!(breakable(given), set);
        }
    }

    #[test]
    fn regress_what_stands_between_backticks_is_code() {
        assert_eq!(prose("a (`run --x`) < b"), "a (<code>run --x</code>) &lt; b");
        assert_eq!(prose("one ` alone"), "one ` alone");
    }
}
