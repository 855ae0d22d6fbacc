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

/// A coordinate to a tenth of a pixel; nothing a picture holds may be written as NaN.
pub(crate) fn coordinate(value: f64) -> String {
    let tenths = if value.is_finite() { (value.clamp(-1e5, 1e5) * 10.0).round() as i64 } else { 0 };
    let (whole, tenth) = (tenths / 10, (tenths % 10).abs());
    let sign = if tenths < 0 && whole == 0 { "-" } else { "" };
    if tenth == 0 { format!("{whole}") } else { format!("{sign}{whole}.{tenth}") }
}
