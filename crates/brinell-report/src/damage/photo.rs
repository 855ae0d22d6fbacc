//! The photo of damage with the outline that was read from it.

use super::{DamageView, heading};
use crate::font;
use crate::layout::Layout;
use crate::number::{round_below, short};
use crate::picture::{Anchor, Paint, Picture, Rect, Shape, Text, ink};

/// Largest photo on a page, px.
const TALLEST: f64 = 560.0;
/// Narrowest picture, px: its title stays a few lines.
const LEAST: f64 = 240.0;
/// Share of the photo's width that the scale bar takes at most.
const BAR: f64 = 0.3;

/// The photo, the outline over it and a scale bar; `None` where the damage has no photo.
pub fn damage_photo(view: &DamageView, index: usize, layout: Layout) -> Option<Picture> {
    let photo = view.photo.as_ref()?;
    let rows = photo.grey.len().checked_div(photo.columns).filter(|rows| *rows > 0)?;
    let (width, font) = (layout.size(0.0).width, layout.size(0.0).font);
    let scale = (width / photo.columns as f64).min(TALLEST / rows as f64);
    let right = scale * photo.columns as f64;
    // As wide as the photo; print is as wide as was asked.
    let width = match layout {
        Layout::Wide | Layout::Narrow => right.max(LEAST),
        Layout::Print(_) => width,
    };
    let title = format!("{}. The photo {} and the outline read from it", view.title, photo.file);
    let mut picture = Picture::new(&format!("damage-{}-photo", index + 1), &title, width, 0.0);
    let top = heading(&mut picture, &title, 0.0, width, font);
    let place = Rect { left: 0.0, top, right, bottom: top + scale * rows as f64 };
    // A phone needs half of the pixels.
    let step = if layout == Layout::Narrow && photo.columns > 400 { 2 } else { 1 };
    let line = |row: usize| {
        let line = &photo.grey[row * photo.columns..(row + 1) * photo.columns];
        line.iter().step_by(step).map(|&v| [v; 3])
    };
    picture.shapes.push(Shape::Image {
        place,
        columns: photo.columns.div_ceil(step),
        pixels: (0..rows).step_by(step).flat_map(line).collect(),
    });
    let at = |p: &[f64; 2]| (scale * p[0], top + scale * p[1]);
    let lines: Vec<Vec<(f64, f64)>> = photo.rings_px.iter().map(|ring| ring.iter().map(at).collect()).collect();
    // Seen on dark and on light ground.
    for paint in [Paint::line("#ffffff", 3.0).faded(0.7), Paint::line(ink::VERMILLION, 1.5)] {
        picture.shapes.push(Shape::Path { lines: lines.clone(), close: true, paint, clip: Some(place) });
    }
    scale_bar(&mut picture, place, scale / photo.mm_per_pixel, font);
    picture.height = place.bottom;
    Some(picture)
}

/// A length of 1, 2 or 5 times a power of ten in the lower left corner.
fn scale_bar(picture: &mut Picture, place: Rect, px_per_mm: f64, font: f64) {
    let most = BAR * place.width() / px_per_mm;
    if !(most.is_finite() && most > 0.0) {
        return;
    }
    let mm = round_below(most);
    let words = match mm < 0.1 {
        true => format!("{} \u{3bc}m", short(1e3 * mm, 2)),
        false => format!("{} mm", short(mm, 2)),
    };
    let (left, bottom) = (place.left + 10.0, place.bottom - 10.0);
    let bar = mm * px_per_mm;
    let room = bar.max(font::width(&words, font, false));
    let back = Rect { left: left - 5.0, top: bottom - 1.9 * font, right: left + room + 5.0, bottom: bottom + 5.0 };
    picture.rect(back, Paint::fill("#ffffff", 0.8));
    picture.path(&[(left, bottom), (left + bar, bottom)], Paint::line(ink::BLACK, 3.0));
    picture.text(Text::new(left, bottom - 0.55 * font, font, Anchor::Start, &words));
}
