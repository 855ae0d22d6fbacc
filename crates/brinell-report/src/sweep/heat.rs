//! An indicator over two keys: a cell for each pair of their values, darker where it is larger, with its number where
//! that fits.

use crate::chart::{Chart, Domain, SCALE_MARGIN, Shades, Spec, range};
use crate::font;
use crate::layout::Layout;
use crate::number::significant;
use crate::picture::{Anchor, Picture, Text, ink};

/// An indicator on a grid of two keys.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeatMap {
    /// Name of the picture's file.
    pub name: String,
    /// The quantity: "RMS of sensor_ax".
    pub label: String,
    /// Its unit; empty where it has none.
    pub unit: String,
    /// The key along x, with its unit.
    pub x_label: String,
    /// Its values.
    pub x_names: Vec<String>,
    /// The key along y, with its unit.
    pub y_label: String,
    /// Its values, from the bottom.
    pub y_names: Vec<String>,
    /// Row by row from the bottom; NaN where a point failed.
    pub values: Vec<f64>,
}

/// Share of the range from which on a cell is too dark for black numbers.
const DARK: f64 = 0.55;

/// The map; `None` where the values are not those of a grid, or there are none.
pub(crate) fn heat_map(map: &HeatMap, layout: Layout) -> Option<Picture> {
    let (columns, rows) = (map.x_names.len(), map.y_names.len());
    if columns == 0 || rows == 0 || map.values.len() != columns * rows {
        return None;
    }
    let (low, high) = range(map.values.iter().copied())?;
    let (low, high) = match high > low {
        true => (low, high),
        false => (low - 0.5, low + 0.5),
    };
    let mut size = layout.size(0.0);
    let axis = 3.4 * size.font;
    // Chart leaves 16 pixels of its height outside a frame without numbers.
    size.height = (28.0 * rows as f64).clamp(120.0, 420.0) + 16.0;
    let names = map.y_names.iter();
    let widest = names.map(|name| font::width(name, size.font, false));
    let left = widest.fold(0.0, f64::max).min(0.25 * size.width) + 2.6 * size.font;
    let y_label = font::fitted(&map.y_label, size.font, false, size.height);
    let mut chart = Chart::new(Spec {
        left,
        right: SCALE_MARGIN * size.font,
        x_axis: false,
        ..Spec::new(
            map.name.clone(),
            format!("{} over {} and {}", map.label, map.x_label, map.y_label),
            size,
            (Domain::exact(0.0, columns as f64), "", ""),
            (Domain::exact(0.0, rows as f64), &y_label, ""),
        )
    });
    chart.clear("ticks-x");
    chart.clear("ticks-y");
    let top_down: Vec<f64> = map.values.chunks(columns).rev().flatten().copied().collect();
    chart.shades(&Shades { columns, values: &top_down, range: (low, high), ticks: 5, head: "" });
    name(&mut chart, map, size.font);
    numbers(&mut chart, map, size.font, (low, high));
    let mut picture = chart.finish();
    picture.height += axis;
    Some(picture)
}

/// Values of both keys beside the cells, the keys under and left of them.
fn name(chart: &mut Chart, map: &HeatMap, size: f64) {
    let frame = chart.frame;
    chart.name_x(&map.x_names, 0.5, 4.0);
    for (k, words) in map.y_names.iter().enumerate() {
        let words = font::fitted(words, size, false, frame.left - 2.0 * size);
        let (x, y) = (frame.left - 6.0, chart.y.at(k as f64 + 0.5) + 0.36 * size);
        chart.picture.text(Text::new(x, y, size, Anchor::End, &words));
    }
    chart.label_x(&map.x_label);
}

/// The value of each cell, where all of them fit.
fn numbers(chart: &mut Chart, map: &HeatMap, size: f64, (low, high): (f64, f64)) {
    let columns = map.x_names.len();
    let words: Vec<String> = map
        .values
        .iter()
        .map(|v| match v.is_finite() {
            true => significant(*v, 3),
            false => "×".into(),
        })
        .collect();
    let widest = words.iter().map(|w| font::width(w, size, false));
    if widest.fold(0.0, f64::max) + 6.0 > chart.frame.width() / columns as f64
        || 1.2 * size > chart.frame.height() / map.y_names.len() as f64
    {
        return;
    }
    for (k, (value, words)) in map.values.iter().zip(&words).enumerate() {
        let x = chart.x.at((k % columns) as f64 + 0.5);
        let y = chart.y.at((k / columns) as f64 + 0.5) + 0.36 * size;
        let dark = (value - low) / (high - low) > DARK;
        let color = if dark { "#ffffff" } else { ink::BLACK };
        chart.picture.text(Text::new(x, y, size, Anchor::Middle, words).color(color));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> HeatMap {
        HeatMap {
            x_names: ["a", "b", "c"].map(String::from).to_vec(),
            y_names: ["1", "2"].map(String::from).to_vec(),
            values: vec![1.0, 2.0, 3.0, 4.0, f64::NAN, 6.5],
            ..HeatMap::default()
        }
    }

    #[test]
    fn prop_every_cell_has_its_number_and_a_failed_one_a_cross() {
        let svg = heat_map(&map(), Layout::Wide).unwrap().svg();
        for words in [">a<", ">2<", ">6.5<", ">×<"] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(!svg.contains("NaN"));
        // The lowest row is drawn lowest.
        let place = |words: &str| {
            let before = &svg[..svg.find(words).unwrap()];
            let y = &before[before.rfind("y=\"").unwrap() + 3..];
            y[..y.find('"').unwrap()].parse::<f64>().unwrap()
        };
        assert!(place(">3<") > place(">6.5<"));
    }

    #[test]
    fn prop_without_a_grid_there_is_no_map() {
        let mut short = map();
        short.values.pop();
        assert!(heat_map(&short, Layout::Narrow).is_none());
        assert!(heat_map(&HeatMap::default(), Layout::Narrow).is_none());
        let nothing = HeatMap { values: vec![f64::NAN; 6], ..map() };
        assert!(heat_map(&nothing, Layout::Wide).is_none());
    }
}
