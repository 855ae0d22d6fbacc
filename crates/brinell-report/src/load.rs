//! Load distribution around the bearing, as a polar picture.

use crate::chart::{Size, range};
use crate::data::RowLoad;
use crate::font;
use crate::layout::{Layout, legend};
use crate::number::{bin_centres, linear_ticks, tick_labels};
use crate::picture::{Anchor, Axis, Curve, Paint, Picture, Rect, Shape, Text, ink};
use crate::thin::straightened;

/// Contact force around the bearing, one circle to a row: 0° is +X, angles run counter-clockwise.
pub fn load_distribution(rows: &[RowLoad], layout: Layout) -> Picture {
    let Size { width, font, .. } = layout.size(0.0);
    let (cell, places) = layout.grid(rows.len(), 400.0);
    let entries = [
        ("largest force", Paint::line(ink::VERMILLION, 1.8).dashed(&[5.0, 3.0])),
        ("mean force", Paint::line(ink::BLUE, 1.8).filled(ink::BLUE, 0.18)),
        ("static equilibrium", Paint::line(ink::BLACK, 1.8).dashed(&[1.5, 3.5])),
    ];
    let mut picture = Picture::new("load-distribution", "Contact force around the bearing", width, 0.0);
    let top = legend(&mut picture, &entries, 12.0, width - 12.0, 2.0, font);
    picture.height = top + cell * places.last().map_or(1.0, |(_, line)| line + 1.0);
    let forces = rows.iter().flat_map(|row| {
        row.mean_n.iter().chain(&row.max_n).copied().chain(row.static_points.iter().map(|(_, force)| *force))
    });
    let largest = range(forces).map_or(0.0, |(_, hi)| hi);
    let largest = if largest > 0.0 { largest } else { 1.0 };
    let rings: Vec<f64> = linear_ticks(0.0, largest * 1.02, 5).into_iter().filter(|r| *r > 0.0).collect();
    let polar = Polar { radius: 0.5 * cell - 44.0, largest, font };
    for (row, (left, line)) in rows.iter().zip(places) {
        let (x, y) = (left + 0.5 * cell, top + cell * line + 0.5 * cell + 12.0);
        polar.grid(&mut picture, (x, y), &rings);
        polar.curves(&mut picture, (x, y), row, entries.map(|e| e.1));
        polar.numbers(&mut picture, (x, y), &rings);
        keep(&mut picture, row);
        let title = font::fitted(&row.title, font, true, cell);
        picture.text(Text::new(x, y - 0.5 * cell + 6.0, font, Anchor::Middle, &title).bold());
    }
    picture
}

/// The numbers that a circle is drawn from.
fn keep(picture: &mut Picture, row: &RowLoad) {
    let axis = |label: &str, unit: &str| Axis { label: label.to_owned(), unit: unit.to_owned() };
    let (angles, forces) = row.static_points.iter().copied().unzip();
    for (label, xs, ys) in [
        ("Mean force", &bin_centres(row.mean_n.len()), &row.mean_n),
        ("Largest force", &bin_centres(row.max_n.len()), &row.max_n),
        ("Force in static equilibrium", &angles, &forces),
    ] {
        let count = xs.len().min(ys.len());
        picture.curves.push(Curve {
            name: row.title.clone(),
            x: axis("Angle", "°"),
            y: axis(label, "N"),
            xs: xs[..count].to_vec(),
            ys: ys[..count].to_vec(),
        });
    }
}

/// Forces over angles.
struct Polar {
    /// Of the rim, px.
    radius: f64,
    /// N.
    largest: f64,
    font: f64,
}

impl Polar {
    fn at(&self, (x, y): (f64, f64), degrees: f64, force: f64) -> (f64, f64) {
        let r = self.radius * (force.max(0.0) / (self.largest * 1.04)).min(1.05);
        let (sin, cos) = degrees.to_radians().sin_cos();
        (x + r * cos, y - r * sin)
    }

    /// Spokes with their angles, circles of force, the rim.
    fn grid(&self, picture: &mut Picture, (x, y): (f64, f64), rings: &[f64]) {
        let (radius, font) = (self.radius, self.font);
        for spoke in 0..8 {
            let degrees = 45.0 * f64::from(spoke);
            let end = self.at((x, y), degrees, self.largest * 1.04);
            picture.path(&[(x, y), end], Paint::line(ink::GRID, 1.0));
            let (dx, dy) = (end.0 - x, end.1 - y);
            let reach = 1.0 + (0.5 * font + 7.0) / radius;
            let anchor = match dx {
                dx if dx > 0.3 * radius => Anchor::Start,
                dx if dx < -0.3 * radius => Anchor::End,
                _ => Anchor::Middle,
            };
            let label = format!("{degrees}°");
            let (label_x, label_y) = (x + reach * dx, y + reach * dy + 0.36 * font);
            picture.text(Text::new(label_x, label_y, font, anchor, &label).color(ink::FAINT));
        }
        let mut circle = |r: f64, color: &'static str| {
            picture.shapes.push(Shape::Circle { x, y, r, paint: Paint::line(color, 1.0) });
        };
        for ring in rings {
            circle(radius * ring / (self.largest * 1.04), ink::GRID);
        }
        circle(radius, ink::FRAME);
    }

    /// Paints are those of the largest, the mean and the static force.
    fn curves(&self, picture: &mut Picture, centre: (f64, f64), row: &RowLoad, [largest, mean, at_rest]: [Paint; 3]) {
        let mut closed = |lines: Vec<Vec<(f64, f64)>>, paint: Paint| {
            picture.shapes.push(Shape::Path { lines, close: true, paint, clip: None });
        };
        let curve = |forces: &[f64]| -> Vec<(f64, f64)> {
            let force = |force: &f64| if force.is_finite() { *force } else { 0.0 };
            let angles = bin_centres(forces.len()).into_iter();
            angles.zip(forces).map(|(angle, f)| self.at(centre, angle, force(f))).collect()
        };
        closed(vec![curve(&row.mean_n)], mean);
        closed(vec![curve(&row.max_n)], largest);
        let finite = |p: &&(f64, f64)| p.0.is_finite() && p.1.is_finite();
        let mut known: Vec<_> = row.static_points.iter().filter(finite).collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        let around = known.iter().map(|p| self.at(centre, p.0, p.1));
        closed(straightened(vec![around.collect()]), at_rest);
    }

    /// Numbers of the circles where the load usually is not: the bottom, a little aside.
    fn numbers(&self, picture: &mut Picture, centre: (f64, f64), rings: &[f64]) {
        let font = self.font;
        let (labels, power) = tick_labels(rings);
        for (ring, label) in rings.iter().zip(&labels) {
            let (x, y) = self.at(centre, 247.5, *ring);
            let scale = if power == 0 { String::new() } else { format!("·10{}", crate::number::superscript(power)) };
            let words = format!("{label}{scale} N");
            let label = Text::new(x, y + 0.36 * font, font - 1.0, Anchor::Middle, &words);
            let half = 0.5 * label.width() + 2.0;
            let (top, bottom) = (y - 0.6 * font, y + 0.6 * font);
            let back = Rect { left: x - half, right: x + half, top, bottom };
            picture.rect(back, Paint::fill("#ffffff", 0.85));
            picture.text(label.color(ink::FAINT));
        }
    }
}
