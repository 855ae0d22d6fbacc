//! ISO 5436-2: a zip archive with `main.xml` and, beside it or within it, the heights. Lengths in m.

use super::archive::Archive;
use super::{broken, map, points, spacing, unsupported};
use crate::error::{DamageError, excerpt};
use crate::kind::FileKind;
use crate::scan::Raw;
use brinell_io::Number;
use roxmltree::{Document, Node, ParsingOptions};

const KIND: FileKind = FileKind::X3p;
const MAIN: &str = "main.xml";
/// Bytes of `main.xml`, heights within it included.
const MOST_TEXT: usize = 64 << 20;
const MOST_NODES: u32 = 20_000_000;

pub(crate) fn read(bytes: &[u8]) -> Result<Raw, DamageError> {
    let mut archive = Archive::open(bytes)?;
    let text = archive.file(MAIN, MOST_TEXT)?;
    let text = std::str::from_utf8(&text).map_err(|_| broken(KIND, MAIN, "not UTF-8"))?;
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| broken(KIND, MAIN, e.to_string()))?;
    let root = document.root_element();
    match text_of(root, "FeatureType").as_deref() {
        Some("SUR") | None => {}
        Some(other) => {
            let what = format!("the feature type `{}`", excerpt(other));
            return Err(unsupported(KIND, what, "save one surface on a grid (SUR)"));
        }
    }
    let axis = |name: &str| child(root, name).ok_or_else(|| broken(KIND, name, "it is missing"));
    let side = |name: &'static str| -> Result<usize, DamageError> {
        let text = text_of(root, name).unwrap_or_default();
        text.parse().map_err(|_| broken(KIND, name, format!("`{}`", excerpt(&text))))
    };
    let (columns, rows) = (side("SizeX")?, side("SizeY")?);
    if side("SizeZ").unwrap_or(1) > 1 {
        return Err(unsupported(KIND, "several layers", "save one surface alone"));
    }
    let count = points(columns, rows)?;
    let between = |name: &'static str| -> Result<f64, DamageError> {
        let axis = axis(name)?;
        if text_of(axis, "AxisType").as_deref() == Some("A") {
            return Err(unsupported(KIND, "points with places of their own", "save them on a grid"));
        }
        spacing(KIND, name, decimal(axis, "Increment")?.unwrap_or(f64::NAN))
    };
    let spacing_mm = [between("CX")?, between("CY")?];
    let z = axis("CZ")?;
    let number = match text_of(z, "DataType").as_deref() {
        Some("I") => Number::I16,
        Some("L") => Number::I32,
        Some("F") => Number::F32,
        Some("D") | None => Number::F64,
        Some(other) => return Err(broken(KIND, "CZ", format!("the type `{}`", excerpt(other)))),
    };
    let scale = decimal(z, "Increment")?.unwrap_or(1.0);
    let offset = decimal(z, "Offset")?.unwrap_or(0.0);
    let mut values = match text_of(root, "PointDataLink") {
        Some(link) => linked(&mut archive, root, &link, number, count)?,
        None => listed(root, count)?,
    };
    values.iter_mut().for_each(|v| *v = offset + scale * *v);
    Ok(map(columns, spacing_mm, values))
}

/// The first element of a name below another.
fn child<'a, 'b>(of: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    of.descendants().find(|n| n.is_element() && n.tag_name().name() == name)
}

fn text_of(of: Node<'_, '_>, name: &str) -> Option<String> {
    let text = child(of, name)?.text()?.trim().to_owned();
    (!text.is_empty()).then_some(text)
}

fn decimal(of: Node<'_, '_>, name: &'static str) -> Result<Option<f64>, DamageError> {
    let Some(text) = text_of(of, name) else {
        return Ok(None);
    };
    let value = text.parse::<f64>().ok().filter(|v| v.is_finite());
    value.map(Some).ok_or_else(|| broken(KIND, name, format!("`{}`", excerpt(&text))))
}

/// Heights in a file of the archive; points that are not valid are missing.
fn linked(
    archive: &mut Archive<'_>,
    root: Node<'_, '_>,
    link: &str,
    number: Number,
    count: usize,
) -> Result<Vec<f64>, DamageError> {
    let wanted = count * number.bytes();
    let data = archive.file(link, wanted)?;
    if data.len() != wanted {
        let why = format!("{} bytes where {count} points need {wanted}", data.len());
        return Err(broken(KIND, link, why));
    }
    let mut values = Vec::with_capacity(count);
    number.decode(false, &data, &mut values);
    if let Some(link) = text_of(root, "ValidPointsLink") {
        let valid = archive.file(&link, count.div_ceil(8) + 8)?;
        if valid.len() < count.div_ceil(8) {
            return Err(broken(KIND, &link, "it is too short"));
        }
        for (i, value) in values.iter_mut().enumerate() {
            if valid[i / 8] >> (i % 8) & 1 == 0 {
                *value = f64::NAN;
            }
        }
    }
    Ok(values)
}

/// Heights within `main.xml`: the last number of each entry; an empty entry is a missing point.
fn listed(root: Node<'_, '_>, count: usize) -> Result<Vec<f64>, DamageError> {
    let list = child(root, "DataList").ok_or_else(|| broken(KIND, "DataList", "there are no heights"))?;
    let mut values = Vec::new();
    for entry in list.children().filter(|n| n.tag_name().name() == "Datum").take(count + 1) {
        let text = entry.text().unwrap_or_default();
        let word = text.rsplit(';').next().unwrap_or_default().trim();
        let value = match word.is_empty() {
            true => f64::NAN,
            false => word
                .parse()
                .map_err(|_| broken(KIND, &format!("height {}", values.len() + 1), format!("`{}`", excerpt(word))))?,
        };
        values.push(value);
    }
    if values.len() != count {
        return Err(broken(KIND, "DataList", format!("{} heights where {count} belong", values.len())));
    }
    Ok(values)
}
