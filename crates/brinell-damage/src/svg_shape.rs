//! One SVG element to a path in its own units: shapes, transforms, lengths.

use kurbo::{Affine, BezPath, Circle, Ellipse, Rect, RoundedRect, RoundedRectRadii, Shape};
use roxmltree::Node;

use crate::error::{DamageError, excerpt};
use crate::kind::FileKind;

/// Numbers above this in a drawing are a mistake, and would keep the curve routines busy for ever.
const MAX_NUMBER: f64 = 1e7;
/// Ellipses become cubics this close to them, relative to their radius: much closer than the four-piece ones of
/// editors.
const ROUND: f64 = 1e-6;

/// "line 12, `path` #spall".
pub(crate) fn place(node: Node<'_, '_>) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    let id = node.attribute("id").map_or(String::new(), |id| format!(" #{}", excerpt(id)));
    format!("line {line}, `{}`{id}", excerpt(node.tag_name().name()))
}

pub(crate) fn broken(node: Node<'_, '_>, why: impl Into<String>) -> DamageError {
    DamageError::Broken { kind: FileKind::Svg, at: place(node), why: why.into() }
}

/// The outline of a shape element; `None` for an element that is no shape.
pub(crate) fn outline(node: Node<'_, '_>) -> Result<Option<BezPath>, DamageError> {
    let number = |name: &str| number(node, name);
    let path = match node.tag_name().name() {
        "path" => {
            let data = node.attribute("d").unwrap_or_default();
            check_numbers(node, data)?;
            BezPath::from_svg(data).map_err(|error| broken(node, format!("its path data: {error}")))?
        }
        "rect" => {
            let (x, y) = (number("x")?, number("y")?);
            let rect = Rect::new(x, y, x + number("width")?, y + number("height")?);
            if rect.width() <= 0.0 || rect.height() <= 0.0 {
                return Err(broken(node, "its width and height must be above 0"));
            }
            rounded(node, rect)?
        }
        "circle" => {
            let radius = number("r")?;
            positive(node, radius, "r")?;
            Circle::new((number("cx")?, number("cy")?), radius).to_path(ROUND * radius)
        }
        "ellipse" => {
            let radii = (number("rx")?, number("ry")?);
            positive(node, radii.0, "rx")?;
            positive(node, radii.1, "ry")?;
            let centre = (number("cx")?, number("cy")?);
            Ellipse::new(centre, radii, 0.0).to_path(ROUND * radii.0.max(radii.1))
        }
        name @ ("polygon" | "polyline") => {
            let data = node.attribute("points").unwrap_or_default();
            let values = numbers(node, data)?;
            let mut path = BezPath::new();
            for (i, pair) in values.chunks_exact(2).enumerate() {
                let point = (pair[0], pair[1]);
                if i == 0 {
                    path.move_to(point);
                } else {
                    path.line_to(point);
                }
            }
            if name == "polygon" && values.len() >= 2 {
                path.close_path();
            }
            path
        }
        _ => return Ok(None),
    };
    Ok(Some(path))
}

fn positive(node: Node<'_, '_>, value: f64, name: &str) -> Result<(), DamageError> {
    if value > 0.0 {
        return Ok(());
    }
    Err(broken(node, format!("its {name} must be above 0")))
}

fn rounded(node: Node<'_, '_>, rect: Rect) -> Result<BezPath, DamageError> {
    let given = |name: &str| node.attribute(name).filter(|v| *v != "auto");
    let (rx, ry) = match (given("rx"), given("ry")) {
        (None, None) => return Ok(rect.to_path(0.1)),
        (Some(_), None) => (number(node, "rx")?, number(node, "rx")?),
        (None, Some(_)) => (number(node, "ry")?, number(node, "ry")?),
        (Some(_), Some(_)) => (number(node, "rx")?, number(node, "ry")?),
    };
    let (rx, ry) = (rx.min(0.5 * rect.width()), ry.min(0.5 * rect.height()));
    if rx <= 0.0 || ry <= 0.0 {
        return Ok(rect.to_path(0.1));
    }
    // Circular corners, stretched.
    let stretch = Affine::scale_non_uniform(1.0, ry / rx);
    let flat = Rect::new(rect.x0, rect.y0 * rx / ry, rect.x1, rect.y1 * rx / ry);
    let shape = RoundedRect::from_rect(flat, RoundedRectRadii::from_single_radius(rx));
    Ok(stretch * shape.to_path(ROUND * rx))
}

/// An attribute that is a length in user units, 0 where it is missing; `px` is a user unit.
pub(crate) fn number(node: Node<'_, '_>, name: &str) -> Result<f64, DamageError> {
    let Some(text) = node.attribute(name) else {
        return Ok(0.0);
    };
    let Some((value, unit)) = length(text) else {
        return Err(broken(node, format!("{name} = \"{}\" is not a number", excerpt(text))));
    };
    // CSS: 96 px to the inch.
    let factor = match unit {
        "" | "px" => 1.0,
        other => match mm_per(other) {
            Some(mm) => mm * 96.0 / 25.4,
            None => {
                return Err(DamageError::Unsupported {
                    at: place(node),
                    what: format!("{name} = \"{}\"", excerpt(text)),
                    way_out: "use plain numbers",
                });
            }
        },
    };
    checked(node, value * factor)
}

/// `12.5mm` as 12.5 and `mm`.
pub(crate) fn length(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| c.is_alphabetic() || c == '%');
    // The `e` of an exponent cannot end a number, so nothing of it is lost.
    let value: f64 = digits.trim_end().parse().ok()?;
    value.is_finite().then(|| (value, &text[digits.len()..]))
}

/// Physical units in mm.
pub(crate) fn mm_per(unit: &str) -> Option<f64> {
    Some(match unit {
        "mm" => 1.0,
        "cm" => 10.0,
        "Q" => 0.25,
        "in" => 25.4,
        "pt" => 25.4 / 72.0,
        "pc" => 25.4 / 6.0,
        _ => return None,
    })
}

fn checked(node: Node<'_, '_>, value: f64) -> Result<f64, DamageError> {
    if value.abs() <= MAX_NUMBER {
        return Ok(value);
    }
    Err(DamageError::TooLarge {
        what: "a number in the drawing",
        value: format!("{value:e} ({})", place(node)),
        limit: format!("{MAX_NUMBER:e}"),
        way_out: "draw near the page",
    })
}

/// Numbers between commas and blanks.
pub(crate) fn numbers(node: Node<'_, '_>, text: &str) -> Result<Vec<f64>, DamageError> {
    text.split(|c: char| c == ',' || c.is_ascii_whitespace())
        .filter(|word| !word.is_empty())
        .map(|word| match word.parse::<f64>() {
            Ok(value) => checked(node, value),
            Err(_) => Err(broken(node, format!("`{}` is not a number", excerpt(word)))),
        })
        .collect()
}

/// Refuses path data with absurd numbers, before anything is computed from them.
fn check_numbers(node: Node<'_, '_>, data: &str) -> Result<(), DamageError> {
    let bytes = data.as_bytes();
    let mut i = 0;
    while i < bytes.len() {
        let start = i;
        while i < bytes.len() && (bytes[i].is_ascii_digit() || bytes[i] == b'.') {
            i += 1;
        }
        if i > start && i < bytes.len() && matches!(bytes[i], b'e' | b'E') {
            i += 1;
            while i < bytes.len() && (bytes[i].is_ascii_digit() || matches!(bytes[i], b'+' | b'-')) {
                i += 1;
            }
        }
        if i == start {
            i += 1;
        } else if let Ok(value) = data[start..i].parse::<f64>() {
            checked(node, value)?;
        }
    }
    Ok(())
}

/// An element's `transform`.
pub(crate) fn transform(node: Node<'_, '_>) -> Result<Affine, DamageError> {
    let mut total = Affine::IDENTITY;
    let mut rest = node.attribute("transform").unwrap_or_default().trim();
    while !rest.is_empty() {
        let wrong = || broken(node, format!("transform `{}` is not understood", excerpt(rest)));
        let (name, tail) = rest.split_once('(').ok_or_else(wrong)?;
        let (inside, tail) = tail.split_once(')').ok_or_else(wrong)?;
        let v = numbers(node, inside)?;
        total *= match (name.trim(), v.as_slice()) {
            ("matrix", &[a, b, c, d, e, f]) => Affine::new([a, b, c, d, e, f]),
            ("translate", &[x]) => Affine::translate((x, 0.0)),
            ("translate", &[x, y]) => Affine::translate((x, y)),
            ("scale", &[k]) => Affine::scale(k),
            ("scale", &[x, y]) => Affine::scale_non_uniform(x, y),
            ("rotate", &[angle]) => Affine::rotate(angle.to_radians()),
            ("rotate", &[angle, x, y]) => Affine::rotate_about(angle.to_radians(), (x, y)),
            ("skewX", &[angle]) => Affine::skew(angle.to_radians().tan(), 0.0),
            ("skewY", &[angle]) => Affine::skew(0.0, angle.to_radians().tan()),
            _ => return Err(wrong()),
        };
        rest = tail.trim_start_matches(|c: char| c == ',' || c.is_ascii_whitespace());
    }
    Ok(total)
}
