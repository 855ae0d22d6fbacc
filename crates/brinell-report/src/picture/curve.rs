//! What a picture's curves are drawn from, as tables of numbers.

/// What an axis represents: "Frequency", "Hz".
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Axis {
    pub(crate) label: String,
    pub(crate) unit: String,
}

/// Points that a picture draws a line, an area's edge or marks through; not thinned.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Curve {
    /// Of several on the same axes, which one; may be empty.
    pub(crate) name: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) xs: Vec<f64>,
    pub(crate) ys: Vec<f64>,
}

/// Curves over the same values of x.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveTable {
    /// Name for a file: the picture's, numbered where it needs several.
    pub name: String,
    /// x first, then the curves: "Frequency (Hz)", "Envelope amplitude (m/s^2)", each once; the unit; the values.
    pub columns: Vec<(String, String, Vec<f64>)>,
}

/// "Cage slip: row 1 (%)".
fn heading(axis: &Axis, name: &str) -> String {
    let label = match (axis.label.is_empty(), name.is_empty()) {
        (_, true) => axis.label.clone(),
        (true, false) => name.to_owned(),
        (false, false) => format!("{}: {name}", axis.label),
    };
    let words = match axis.unit.is_empty() {
        true => label,
        false => format!("{label} ({})", axis.unit),
    };
    // What no header of a table can hold.
    let plain = |c: char| match c {
        ',' => ';',
        '"' => ' ',
        c if c.is_control() => ' ',
        c => c,
    };
    let words: String = words.chars().map(plain).collect();
    match words.split_whitespace().collect::<Vec<_>>().join(" ") {
        empty if empty.is_empty() => "Value".into(),
        words => words,
    }
}

pub(super) fn tables(picture: &str, curves: &[Curve]) -> Vec<CurveTable> {
    let same = |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
    let mut groups: Vec<Vec<&Curve>> = vec![];
    for curve in curves.iter().filter(|curve| !curve.xs.is_empty()) {
        match groups.iter_mut().find(|group| group[0].x == curve.x && same(&group[0].xs, &curve.xs)) {
            Some(group) => group.push(curve),
            None => groups.push(vec![curve]),
        }
    }
    let alone = groups.len() == 1;
    let table = |(index, group): (usize, Vec<&Curve>)| {
        let first = group[0];
        let mut columns = vec![(heading(&first.x, ""), first.x.unit.clone(), first.xs.clone())];
        for curve in group {
            let words = heading(&curve.y, &curve.name);
            let taken = |name: &str| columns.iter().any(|column| column.0 == name);
            let name = (1..)
                .map(|k| if k == 1 { words.clone() } else { format!("{words} {k}") })
                .find(|name| !taken(name))
                .unwrap_or_default();
            columns.push((name, curve.y.unit.clone(), curve.ys.clone()));
        }
        CurveTable {
            name: match alone {
                true => picture.to_owned(),
                false => format!("{picture}-{}", index + 1),
            },
            columns,
        }
    };
    groups.into_iter().enumerate().map(table).collect()
}
